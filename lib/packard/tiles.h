/* The bit-parallel engine: a plane of tiles of 64 by 64 cells, a bit a cell.
   Tiles exist where frozen cells are or touch; a step visits those tiles in or
   beside which a cell froze in the step before. No other tile can change: a
   cell that its number of frozen neighbours left unfrozen stays so until that
   number changes, and frozen cells never melt. */
#ifndef SNOW_PACKARD_TILES_H
#define SNOW_PACKARD_TILES_H

#include "base/heap.h"

#include <snowgrowth/options.h>
#include <snowgrowth/status.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SNOW_TILE_SIDE = 64 };

typedef struct snow_tiles snow_tiles;

/* What zones and domain demand of the 64 by 64 cells from (q, r) on. Bit x of
   word y stands for the cell (q + x, r + y). It is called with `allowed` all
   ones and `priority` all zeros, clears the bits of cells that may not freeze,
   sets those of cells that one frozen neighbour freezes, and returns whether it
   did either. A cell that is not allowed does not freeze, priority or not. */
typedef bool (*snow_tile_mask)(const void *context, int64_t q, int64_t r, uint64_t *allowed, uint64_t *priority);

typedef struct snow_tiles_plan {
    uint8_t freezes; /* bit k: a cell with k frozen neighbours freezes; bit 7 must be 0 */
    snow_isa isa;    /* available here; AUTO: the best */

    /* A torus of cells 0 <= q < width, 0 <= r < height; 0, 0: the unbounded plane. */
    int64_t width, height;

    /* Only a twelfth of the plane is kept. Seeds and masks must have all twelve
       symmetries of the hexagon about this cell. Setting a cell sets its images. */
    bool folded;
    int64_t fold_q, fold_r;

    int64_t centre_q, centre_r; /* distances are measured from here */

    bool dated; /* keep the freeze step of each cell: four bytes a cell */

    snow_tile_mask mask; /* NULL: none */
    const void *mask_context;

    snow_parallel_for loop; /* NULL: one thread */
    void *loop_context;
    int32_t threads;
} snow_tiles_plan;

/* What is known of the frozen cells; `frozen` = 0 leaves the rest meaningless.
   A torus is measured as the rectangle that stands for it. */
typedef struct snow_tiles_census {
    uint64_t frozen;
    int64_t least_q, greatest_q, least_r, greatest_r;
    int64_t least_s, greatest_s; /* s = q + r */
    uint64_t tip_square; /* greatest squared distance from the centre; right up to a distance of 2^31 */
} snow_tiles_census;

/* The heap must outlive the tiles. OK, or the heap's refusal. */
snow_status snow_tiles_create(snow_tiles **tiles, snow_heap *heap, const snow_tiles_plan *plan);
void snow_tiles_destroy(snow_tiles *tiles);

/* Freezes a cell; on a torus coordinates wrap. OK, also when it is frozen
   already, or the heap's refusal: then nothing has changed. */
snow_status snow_tiles_set(snow_tiles *tiles, int64_t q, int64_t r);
/* The same, for a cell that froze in an earlier step. */
snow_status snow_tiles_set_dated(snow_tiles *tiles, int64_t q, int64_t r, int64_t step);

/* Makes the tiles of a rectangle and has the next step visit them. Needed, with
   a mask that bounds the plane, for rules that freeze cells without frozen
   neighbours; not for a folded plane. OK, or the heap's refusal. */
snow_status snow_tiles_cover(snow_tiles *tiles, int64_t q, int64_t r, int64_t width, int64_t height);

bool snow_tiles_get(const snow_tiles *tiles, int64_t q, int64_t r);
/* The step in which a cell froze; −1: not frozen, or not dated. */
int64_t snow_tiles_date(const snow_tiles *tiles, int64_t q, int64_t r);

/* Bits of the cells (q, r) to (q + count − 1, r), lowest first; the last word
   is filled up with zeros. */
void snow_tiles_row(const snow_tiles *tiles, int64_t q, int64_t r, size_t count, uint64_t *bits);
/* Freezes the cells whose bits are set. On failure some of them are set. Only
   the part of a folded plane that is kept is taken from the row. */
snow_status snow_tiles_put_row(snow_tiles *tiles, int64_t q, int64_t r, size_t count, const uint64_t *bits);

/* Moves on to the first cell of the first tile that is not before the one with
   this cell, row by row of tiles; it may hold frozen cells. False: there is none. Not for a folded plane. */
bool snow_tiles_next(const snow_tiles *tiles, int64_t *q, int64_t *r);

/* The steps taken; where the count starts, for dates. */
int64_t snow_tiles_steps(const snow_tiles *tiles);
void snow_tiles_set_steps(snow_tiles *tiles, int64_t steps);

/* Takes so many steps. On failure the plane stands before the step that
   failed, and snow_tiles_steps() tells where; the call may be repeated. */
snow_status snow_tiles_advance(snow_tiles *tiles, int64_t steps);

/* No cell will freeze while the mask stays what it is. */
bool snow_tiles_still(const snow_tiles *tiles);

/* Other zones from the next step on. On failure the old ones hold. */
snow_status snow_tiles_set_mask(snow_tiles *tiles, snow_tile_mask mask, const void *context);

/* Cost: proportional to the tiles that changed since it was last called. */
void snow_tiles_count(snow_tiles *tiles, snow_tiles_census *census);

/* Tiles that exist, and those that all steps visited. */
uint64_t snow_tiles_number(const snow_tiles *tiles);
uint64_t snow_tiles_visits(const snow_tiles *tiles);
snow_isa snow_tiles_isa(const snow_tiles *tiles);

#endif
