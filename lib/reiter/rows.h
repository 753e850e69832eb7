/* The ROWS engine: the fundamental part of the plane in two dense arrays of
   vapour that take turns, everything about ice beside them.

   Rows are stored in bands, whose rows are equally long and made of whole
   chunks, a chunk at the same columns in every band. One more band stands above
   the part and one below. Stored cells that are not of the part are fixed
   cells, ghosts (images of cells of the part, copied after each step) or
   padding. */
#ifndef SNOW_REITER_ROWS_H
#define SNOW_REITER_ROWS_H

#include "reiter/kernel.h"
#include "reiter/model.h"

/* What a pass has to visit is odd. */
typedef enum cell_state {
    CELL_VAPOUR = 0,
    CELL_FRONT = 1,  /* receptive, not frozen */
    CELL_FROZEN = 2, /* out of reach of all vapour */
    CELL_FED = 3,    /* frozen, and fed by a fixed cell beside it */
    CELL_OTHER = 4,  /* fixed, ghost or padding */
    CELL_JOINING = 5 /* vapour that becomes receptive in the step that is being taken; only in a pass */
} cell_state;

/* What is kept of a receptive cell. */
typedef struct receptive_cell {
    uint32_t number;
    uint32_t since;   /* the step since which it gains, modulo 2^32 */
    double collected; /* what it had and collected, without additions */
} receptive_cell;

/* Where a band is stored, and where it stands in the maps of chunks. There the
   chunk at column 0 is bit 0 of word 0, in every band. */
typedef struct stored_band {
    int32_t first; /* column */
    uint32_t stride;
    size_t base; /* number of its first cell */
    int32_t first_word;
    int32_t words;
    size_t map;           /* where its words are in a map */
    size_t first_ghost;   /* of the images of its cells */
    size_t first_segment; /* of what is computed */
    uint32_t segments;
    bool stale; /* they are not those of the active chunks */
} stored_band;

/* Bands that one task computes. Its cells have as much room in `listed` as
   there are of them: those that collect (the front, and fed ice) from `first`
   up, other ice from `end` down, what has just frozen last. The two never meet,
   so that a step needs no memory. */
typedef struct row_block {
    int32_t first_band; /* of the part */
    int32_t end_band;
    size_t first; /* of the cells, as stored */
    size_t end;
    size_t front;           /* cells that collect */
    size_t ice;             /* frozen cells that do not */
    size_t fresh;           /* those of them that froze in this step */
    size_t first_segment;   /* of what is computed */
    size_t segments;
    bool collected;  /* a cell of the front collected enough to freeze one day */
    bool unstable;   /* a cell is beyond the bound */
    bool overshoots; /* a cell is, perhaps, ice without ice beside it */
} row_block;

typedef struct ghost_cell {
    uint32_t to;
    uint32_t from;
    int32_t chunk; /* where the cell that it is an image of stands in its band */
} ghost_cell;

/* Cells are numbered as stored. */
typedef struct rows {
    const reiter_kernel *kernel;
    snow_domain part;
    size_t count;      /* stored cells */
    int32_t bands;     /* of the part; the last may reach beyond it */
    stored_band *band; /* band n of the part is band[n + 1] */
    int64_t *offset;   /* cell (q, r) is number offset[r − top + REITER_BAND] + q */
    void *vapour[2]; /* 0 where receptive; see rows_vapour.h */
    int now;         /* which of the two holds the present step */
    bool single;     /* vapour is in 32-bit multiples of the quantum, else in doubles */
    bool loose;      /* cells have been put, and are not settled yet; none is listed */
    double quantum;
    double fixed; /* of the fixed cells, where the part is not the whole */
    unsigned char *state;
    receptive_cell *listed;
    uint32_t *place; /* of receptive cells: where they are listed; while cells are loose, their `since` */
    ghost_cell *ghost; /* in the order of the cells that they are images of */
    size_t ghosts;
    bool ghosts_are_near; /* none is farther than two cells from what it is an image of */
    row_block *block;
    size_t blocks;

    /* Maps of chunks: see rows_active.c. */
    size_t map_words;
    uint64_t *valid;   /* holds cells of the part */
    uint64_t *active;  /* may change before the next look */
    uint64_t *flowing; /* changed in the step of the last look */
    uint64_t *visited; /* in a pass: holds cells that are receptive */
    int32_t reaches;   /* for so many times ROWS_LOOK_STEPS holds what is active: 1, in a long pass more */
    reiter_segment *segment;
    size_t segment_room;
    size_t listed_chunks; /* in the segments, when they were last listed */
    bool stale; /* the segments are not those of `active`, or not in order */
} rows;

static inline rows *rows_of(const snow_grid *grid)
{
    return reiter_of(grid)->cells;
}

static inline size_t rows_vapour_size(const rows *cells)
{
    return cells->single ? sizeof(int32_t) : sizeof(double);
}

/* Of a cell of the part, or next to it. */
static inline size_t rows_number(const rows *cells, int32_t q, int32_t r)
{
    return (size_t)(cells->offset[r - cells->part.top + REITER_BAND] + q);
}

/* Steps between two looks at which chunks change, but for long passes; not more
   than a chunk has columns. */
enum { ROWS_LOOK_STEPS = 8 };

/* Steps between two looks at everything, where there is a tolerance. */
enum { ROWS_FULL_LOOK_STEPS = 64 };

/* Whether the step that is being taken is one. */
static inline bool rows_looks_at_all(const snow_grid *grid)
{
    return reiter_of(grid)->params.tolerance > 0 &&
           grid->census.steps % ROWS_FULL_LOOK_STEPS == ROWS_FULL_LOOK_STEPS - 1;
}

/* How far something may come in that time, in bands; in chunks it is one. */
enum { ROWS_REACH = (ROWS_LOOK_STEPS + REITER_BAND - 1) / REITER_BAND };

/* The image of a cell that is kept; most that are asked for are it. */
static inline snow_cell rows_representative(const snow_grid *grid, int32_t q, int32_t r)
{
    if (snow_domain_has(&rows_of(grid)->part, q, r))
        return (snow_cell){q, r};
    return snow_group_representative(reiter_of(grid)->group, q, r);
}

static inline int32_t rows_chunk_floor(int32_t q)
{
    int32_t rest = q % REITER_CHUNK;
    return q - (rest < 0 ? rest + REITER_CHUNK : rest);
}

/* The words of a band in a map; its bits are numbered by chunk, from 64·first_word. */
typedef struct map_band {
    uint64_t *word;
    int32_t first_word;
    int32_t words;
} map_band;

static inline map_band rows_map(const rows *cells, uint64_t *map, int32_t band)
{
    const stored_band *stored = &cells->band[band + 1];
    return (map_band){map + stored->map, stored->first_word, stored->words};
}

static inline void rows_set_bit(map_band band, int32_t chunk)
{
    uint32_t bit = (uint32_t)(chunk - 64 * band.first_word);
    band.word[bit / 64] |= UINT64_C(1) << bit % 64;
}

/* rows_layout.c */
snow_status snow_rows_create(snow_grid *grid);
void snow_rows_destroy(snow_grid *grid);
/* The columns of a band that hold cells of the part, in whole chunks; *first >= *end: none. */
void snow_rows_columns(const rows *cells, int32_t band, int32_t *first, int32_t *end);
/* Whether a neighbour of a cell of the part is fixed. */
bool snow_rows_touches_fixed(const snow_grid *grid, int32_t q, int32_t r);
/* Ghosts get the values of the cells that they are images of. */
void snow_rows_copy_ghosts(const rows *cells, void *vapour);

/* rows_active.c */
/* Everything is computed until the next look. */
void snow_rows_wake_all(rows *cells);
/* A cell has changed otherwise than by flow. */
void snow_rows_wake(const snow_grid *grid, int32_t q, int32_t r, bool looking);
/* After a step that looked: what can change until the next. */
void snow_rows_choose_active(const snow_grid *grid);
/* What can change in ROWS_LOOK_STEPS more. */
void snow_rows_widen_active(const snow_grid *grid);
/* Lists the segments of what is active, block by block, band by band. */
void snow_rows_list_segments(rows *cells);
/* Lists those of a band anew, where there is one block. */
void snow_rows_list_band(rows *cells, int32_t band);

/* rows_pass.c */
/* How many steps, up to `most`, a pass over the cells takes from here; 0: single steps are as good. */
int64_t snow_rows_pass_steps(const snow_grid *grid, int64_t most);
/* Takes them. */
void snow_rows_pass(snow_grid *grid, int64_t steps);

/* rows.c */
/* One step from the vapour in array `now` into the other. */
reiter_flow snow_rows_flow(const snow_grid *grid, int now);
bool snow_rows_is_still(const snow_grid *grid, bool froze);

/* rows_front.c */
/* A receptive cell takes what has flowed in; whether it freezes. Notes, for the
   stop condition STILL, whether it may do so one day. */
static inline bool rows_collect_inflow(receptive_cell *cell, double inflow, double addition, uint32_t step,
                                       double threshold, bool *collected)
{
    cell->collected += inflow;
    double missing = threshold - (cell->collected + addition * (step - cell->since));
    *collected |= missing > 0 && inflow * REITER_STILL_STEPS >= missing;
    return missing <= 0;
}

/* In a pass: a cell of the front turns into ice at once. */
void snow_rows_freeze_cell(snow_grid *grid, uint32_t number, snow_cell at);
/* In a pass: a cell of vapour joins the front. */
void snow_rows_join(const snow_grid *grid, void *next, snow_cell at, bool looking);
snow_cell snow_rows_locate(const rows *cells, const row_block *block, size_t i);
/* Gives the listed cells of a block what has diffused into them, and lists
   those that freeze. */
void snow_rows_collect(const snow_grid *grid, row_block *block, void *next);
/* Lists the cells of a block that freeze although no ice is next to them. */
void snow_rows_overshoot(const snow_grid *grid, row_block *block, const void *next);
/* Turns the listed cells into ice and their neighbours into the front. */
bool snow_rows_freeze(snow_grid *grid, void *next, bool looking);
/* Whether a cell of the front has an addition that will freeze it. */
bool snow_rows_front_gains(const snow_grid *grid);
/* Lists the receptive cells. */
void snow_rows_list(snow_grid *grid);
/* Takes the lists apart; cells are loose. */
void snow_rows_unlist(rows *cells);

#endif
