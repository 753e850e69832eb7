/* What a grid is to the library: a model's operations and its state. */
#ifndef SNOW_BASE_MODEL_H
#define SNOW_BASE_MODEL_H

#include "base/bytes.h"
#include "base/domain.h"
#include "base/heap.h"
#include "base/parallel.h"

#include <snowgrowth/grid.h>

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/* What every model keeps of its frozen cells as they freeze. */
typedef struct snow_census {
    int64_t steps;
    uint64_t frozen;
    uint64_t frozen_high; /* multiples of 2^64 */
    double tip_square;    /* greatest squared distance from the origin, exact below 2^53; −1: nothing frozen */
    snow_hexagon hexagon; /* the smallest that holds the frozen cells */
    int64_t height;       /* of a deposit, in rows; for models with a floor */
    bool rim;   /* ice is within reach of the rim */
    bool full;  /* nothing more can join */
    bool still; /* no cell will freeze again; looked for in step 1 and in each 64th */
} snow_census;

/* Whether `still` is looked for in the step that leads to this step count. */
static inline bool snow_census_looks(int64_t steps)
{
    return steps == 1 || steps % 64 == 0;
}

/* Distance of the farthest frozen cell from the origin; 0: nothing frozen. */
static inline double snow_census_tip(const snow_census *census)
{
    return census->tip_square > 0 ? sqrt(census->tip_square) : 0;
}

/* The frozen cells; UINT64_MAX stands for more. */
static inline uint64_t snow_census_frozen(const snow_census *census)
{
    return census->frozen_high == 0 ? census->frozen : UINT64_MAX;
}

void snow_census_start(snow_census *census);

/* Counts a cell that froze; the model itself sets `rim` and `still`. */
void snow_census_add(snow_census *census, int32_t q, int32_t r);

/* Which of the conditions on the crystal alone holds, if any. */
snow_stop_reason snow_crystal_stops(const snow_grid *grid, const snow_stop *stop);

/* The operations of a model. Arguments are checked before they are called:
   pointers are not NULL, enumerations known, rectangles in range. Fields are
   read and written a run of cells at a time. */
typedef struct snow_model_operations {
    snow_model model;
    const char *name;
    bool binary; /* the value of a cell is 0 or 1 */

    /* Takes at least one step and at most `most`, but none after one in which a
       condition of `stop` (NULL: none) on the crystal comes true. Where a step can
       take very long it may come back without one. On failure the grid stands
       before the step that failed. */
    snow_status (*advance)(snow_grid *grid, int64_t most, const snow_stop *stop);
    /* OK, UNSUPPORTED or NOT_RECORDED. */
    snow_status (*can_read)(const snow_grid *grid, snow_field field);
    /* count values of row r from column q on; any cells. */
    void (*read)(const snow_grid *grid, snow_field field, int64_t q, int64_t r, size_t count, double *values);
    /* What the census says of frozen cells where they move: how many, their hexagon, the tip. NULL: it follows them. */
    void (*survey)(const snow_grid *grid, snow_census *census);
    /* As snow_frozen_next(). NULL: all in one part. */
    bool (*next_frozen)(const snow_grid *grid, snow_rect *part);
    /* All or nothing. */
    snow_status (*set)(snow_grid *grid, snow_field field, const snow_rect *rect, const double *values);
    /* All that makes up the crystal, beside model and step count. NULL: the values of all cells of the domain. */
    void (*digest)(const snow_grid *grid, snow_digest_state *state);
    void (*save)(const snow_grid *grid, snow_sink *sink);
    /* Makes a grid from what save wrote. */
    snow_status (*load)(snow_source *source, const snow_options *options, snow_grid **grid);
    void (*destroy)(snow_grid *grid);
} snow_model_operations;

struct snow_grid {
    const snow_model_operations *operations;
    void *state; /* the model's own */
    snow_heap heap;
    snow_options options; /* settled */
    snow_team *team;      /* NULL: one thread, or the caller's loop */
    snow_domain domain;
    snow_census census;
    bool squares; /* cells are squares, not hexagons */
    bool busy; /* a progress callback is running */
};

/* A grid with settled options and its team, but no domain and no state yet. */
snow_status snow_grid_new(const snow_model_operations *operations, const snow_options *options, snow_grid **grid);
void snow_grid_end(snow_grid *grid);
/* The end of making a grid: `result` receives it if all went well, else it is ended, unless it is NULL. Returns the status. */
snow_status snow_grid_hand_over(snow_grid *grid, snow_status status, snow_grid **result);

/* The census as the frozen cells stand now. */
snow_census snow_census_of(const snow_grid *grid);

/* Moves on from one part of the plane to the next, starting from an empty one: together they hold all frozen cells, so
   that nobody looks through the space between them. False: that was the last. Only where snow_domain_reaches(). */
bool snow_frozen_next(const snow_grid *grid, snow_rect *part);

/* Runs count tasks on the grid's threads, or the caller's. */
void snow_grid_for(const snow_grid *grid, size_t count, snow_task task, void *argument);

#endif
