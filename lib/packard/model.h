/* A grid of Packard's model: what its files share. */
#ifndef SNOW_PACKARD_MODEL_H
#define SNOW_PACKARD_MODEL_H

#include "base/model.h"

#include <snowgrowth/packard.h>

extern const snow_model_operations snow_packard_operations;

enum {
    PACKARD_RULES = 128,
    PACKARD_WORD = 64, /* cells in a word of bits */
    PACKARD_BLOCK = 64 /* rows and columns of a block of cells */
};

/* Words that hold so many bits. */
static inline size_t packard_words(uint64_t cells)
{
    return (size_t)((cells + PACKARD_WORD - 1) / PACKARD_WORD);
}

/* A zone, checked, its cells copied. */
typedef struct packard_zone {
    snow_packard_zone_kind kind;
    snow_packard_zone_shape shape;
    int64_t first_step, last_step;
    snow_cell centre;
    int64_t half_cells; /* twice the half-width; −1: the angle is meant */
    double half_angle;
    double tangent; /* of the half-angle */
    int64_t inner, outer;
    bool inverted;
    snow_rect rect;
    uint64_t *cells; /* rows of whole words; NULL: the whole rectangle */
} packard_zone;

/* Zones demand this of a cell. */
enum { PACKARD_RESTRICTED = 1, PACKARD_PREFERRED = 2 };

/* The cells of a rectangle as bits: bit b of word w of row y is the cell
   (q + 64w + b, r + y); bits beyond a row's end are 0. */
typedef struct packard_region {
    int64_t q, r;
    int64_t width, height;
} packard_region;

/* A scene that has all twelve symmetries of the hexagon, about a cell, and keeps
   them: an engine may compute one twelfth of it. */
typedef struct packard_fold {
    bool possible;
    int64_t q, r; /* the cell */
} packard_fold;

/* What computes the steps. The cells are the engine's own; the heap and all
   that is not cells is the grid's. */
typedef struct packard_engine {
    snow_packard_engine name;
    /* An empty plane at the grid's step count. */
    snow_status (*create)(snow_grid *grid, const packard_fold *fold, void **cells);
    void (*destroy)(snow_grid *grid, void *cells);
    /* Freezes the cells whose bits are set. On failure some are. Where cells can melt, those whose bits are not set do:
       the engine also has keep() and restore(), and is for the plane, without freeze steps. */
    bool melts;
    snow_status (*put)(void *cells, const packard_region *region, const uint64_t *words);
    /* Freezes a cell, and says when; only of grids that record it. */
    snow_status (*put_dated)(void *cells, int64_t q, int64_t r, int64_t step);
    void (*copy)(const void *cells, const packard_region *region, uint64_t *words);
    /* Cells come in blocks of 64 by 64, wherever the engine has the first one. Moves on to the first cell of the
       first block that may hold frozen cells, row by row of blocks, and not before the block with this cell. False:
       there is none. NULL: any block may hold some. Not for a fold. */
    bool (*next)(const void *cells, int64_t *q, int64_t *r);
    /* −1: not frozen. Only of grids that record it. */
    int64_t (*date)(const void *cells, int64_t q, int64_t r);
    /* Takes so many steps, in which the same zones apply, or stops after a part of them, so that a caller with little
       time is asked. *taken says how many were taken, also on failure. */
    snow_status (*advance)(void *cells, int64_t steps, int64_t *taken);
    /* Other zones apply in the next step than in the last. On failure the old ones do. */
    snow_status (*change_zones)(void *cells);
    /* Fills in the census what is known of the frozen cells. */
    snow_status (*count)(void *cells, snow_census *census);
    /* Whether no cell will freeze while the zones stay as they are. */
    bool (*is_still)(void *cells);
    /* Keeps the frozen cells as they are, and goes back to them; NULL: it cannot. */
    void (*keep)(void *cells);
    void (*restore)(void *cells);
} packard_engine;

extern const packard_engine snow_packard_reference;
extern const packard_engine snow_packard_tiles;
extern const packard_engine snow_packard_quadtree;

/* What the quadtree had done when the crystal had some size. */
typedef struct packard_effort {
    double size, work;
} packard_effort;

/* How the quadtree gets on, for the choice of engine. */
typedef struct packard_trial {
    int64_t first_step; /* when it began */
    double first_size;
    packard_effort now, mark[3]; /* and when the size had doubled, newest first; 0: not yet */
    bool passed;
    double left_for; /* the size for which it was left; 0: it was not */
} packard_trial;

typedef struct packard {
    snow_packard_params params; /* checked; pointers cleared after creation */
    packard_zone *zones;
    size_t zone_count, zone_room;
    int64_t zones_first, zones_last; /* the steps for which the engine has its zones */
    int64_t rim_distance;            /* no cell nearer to the origin is within reach of the rim */

    const packard_engine *engine;
    void *cells;
    packard_trial trial;
    packard_fold fold;
} packard;

static inline packard *packard_of(const snow_grid *grid)
{
    return grid->state;
}

/* A grid of this model, or the status that says what it is instead. */
static inline snow_status packard_check(const snow_grid *grid)
{
    if (grid == NULL)
        return SNOW_ERROR_NULL;
    return grid->operations == &snow_packard_operations ? SNOW_OK : SNOW_ERROR_UNSUPPORTED;
}

static inline bool packard_is_plane(const packard *model)
{
    return model->params.domain == SNOW_PACKARD_PLANE;
}

/* Whether cells outside the interior lie beside it. */
static inline bool packard_has_rim(const packard *model)
{
    return !packard_is_plane(model) && model->params.domain != SNOW_PACKARD_TORUS;
}

/* Whether a cell may freeze at all. */
static inline bool packard_has_cell(const snow_grid *grid, int64_t q, int64_t r)
{
    return packard_is_plane(packard_of(grid)) || snow_domain_has(&grid->domain, q, r);
}

/* params.c */
snow_status snow_packard_params_check(const snow_packard_params *params);

bool snow_packard_is_side(int32_t side);

/* rule.c */
/* Reads a rule, and with its suffix the domain. On failure the parameters are not to be used. */
snow_status snow_packard_rule_read(const char *text, snow_packard_params *params);

/* create.c */
/* A grid without frozen cells, so many steps old. */
snow_status snow_packard_build(const snow_packard_params *params, const snow_options *options, int64_t steps,
                               snow_grid **grid);

/* seeds.c */
snow_status snow_packard_plant(snow_grid *grid, const snow_packard_params *params);

/* blocks.c */
/* The first block, row by row of blocks, that may hold frozen cells and is not before the one with this cell; without
   what lies outside the bounds of all frozen cells. False: there is none.

       for (bool more = snow_packard_first_block(grid, &block); more; more = snow_packard_next_block(grid, &block)) */
bool snow_packard_block_from(const snow_grid *grid, int64_t q, int64_t r, packard_region *block);
bool snow_packard_first_block(const snow_grid *grid, packard_region *block);
bool snow_packard_next_block(const snow_grid *grid, packard_region *block);
/* Cells of row r from q on, at most so many, past those that are known not to be frozen. False: none are left. */
bool snow_packard_next_in_row(const snow_grid *grid, int64_t q, int64_t r, int64_t most, packard_region *part);
/* A snow_model_operations.next_frozen. */
bool snow_packard_next_frozen(const snow_grid *grid, snow_rect *part);
/* Far more empty cells than anyone should look through. */
bool snow_packard_is_sparse(const snow_grid *grid);

/* cells.c */
snow_status snow_packard_put(snow_grid *grid, const packard_region *region, const uint64_t *words);
/* Freezes cells of a region in one engine that are frozen in another, when they froze there. */
snow_status snow_packard_put_block(const packard *from, const packard *to, const packard_region *block,
                                   const uint64_t *words);
/* Counts the frozen cells anew; the interior of the plane follows them. */
snow_status snow_packard_count(snow_grid *grid);
/* After cells were put: counts them, and chooses the engine. */
snow_status snow_packard_settle(snow_grid *grid);
/* The region of all frozen cells, or an empty one. */
packard_region snow_packard_bounds(const snow_grid *grid);
/* Goes on with another engine. On failure nothing has changed. */
snow_status snow_packard_convert(snow_grid *grid, const packard_engine *engine);
/* From here on the scene counts as one without symmetry. On failure nothing has changed. */
snow_status snow_packard_unfold(snow_grid *grid);

/* rim.c */
int64_t snow_packard_rim_distance(const snow_packard_params *params);
/* Whether a frozen cell lies next to one outside the interior. */
bool snow_packard_is_at_rim(const snow_grid *grid);

/* engine_quadtree.c */
/* What the quadtree has done so far: nodes made and results found. */
uint64_t snow_packard_tree_work(const void *cells);
/* What a saved grid holds of a crystal in the quadtree. Where that does not stand about the origin, it says where. */
bool snow_packard_tree_is_shifted(const void *cells);
void snow_packard_tree_save(const void *cells, snow_sink *sink);
snow_status snow_packard_tree_load(snow_grid *grid, snow_source *source, bool shifted, void **cells);

/* choose.c */
/* Chooses the engine for the next steps, of which at most *steps are to be
   taken; may ask for fewer. So many steps seem to lie ahead. */
snow_status snow_packard_choose(snow_grid *grid, int64_t ahead, int64_t *steps);

/* advance.c */
snow_status snow_packard_advance(snow_grid *grid, int64_t most, const snow_stop *stop);

/* zones.c */
/* What the zones that apply in a step demand of a cell. */
unsigned snow_packard_zones_at(const packard *model, int64_t step, int64_t q, int64_t r);
/* Whether a zone that applies in a step may have cells in a region. */
bool snow_packard_zones_touch(const packard *model, int64_t step, const packard_region *region);
bool snow_packard_zones_apply(const packard *model, int64_t step);
/* The last of the steps from `step` on in which the same zones apply. */
int64_t snow_packard_zones_last(const packard *model, int64_t step);
/* Whether later steps have zones that may let cells freeze that do not freeze now. */
bool snow_packard_zones_pend(const packard *model, int64_t step);
/* Whether the zones have all symmetries of the hexagon about a cell. */
bool snow_packard_zones_are_symmetric(const packard *model, int64_t q, int64_t r);
/* A zone from the caller's description, its cells copied. */
snow_status snow_packard_zone_read(const snow_packard_zone *zone, snow_heap *heap, packard_zone *copy);
/* Takes over the zone. */
snow_status snow_packard_zone_keep(snow_grid *grid, const packard_zone *zone);
void snow_packard_zones_end(snow_grid *grid);

/* fields.c, snapshot.c */
snow_status snow_packard_can_read(const snow_grid *grid, snow_field field);
void snow_packard_read(const snow_grid *grid, snow_field field, int64_t q, int64_t r, size_t count, double *values);
snow_status snow_packard_set(snow_grid *grid, snow_field field, const snow_rect *rect, const double *values);
void snow_packard_save(const snow_grid *grid, snow_sink *sink);
snow_status snow_packard_load(snow_source *source, const snow_options *options, snow_grid **grid);

#endif
