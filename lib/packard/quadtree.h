/* The quadtree engine: a crystal on the unbounded plane as a hash-consed
   quadtree, stepped by memoised results (R. W. Gosper, Exploiting regularities
   in large cellular spaces, Physica D 10, 1984). For long runs from few seeds:
   2^k steps may cost hardly more than k.

   Cells are frozen or not, and a rule is a byte whose bit k says whether a cell
   with k frozen neighbours freezes; bit 0 is clear. Regions travel as rows of
   bits: bit b of word w of row y is the cell (q + 64w + b, r + y). */
#ifndef SNOW_PACKARD_QUADTREE_H
#define SNOW_PACKARD_QUADTREE_H

#include "base/bytes.h"
#include "base/heap.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct snow_quadtree snow_quadtree;

/* An exact number: high · 2^64 + low. */
typedef struct quadtree_count {
    uint64_t high, low;
} quadtree_count;

typedef struct quadtree_measures {
    quadtree_count population;
    /* Least and greatest q, r and q + r of the frozen cells: the bounding
       hexagon. All 0 when nothing is frozen. */
    int64_t least[3], greatest[3];
    quadtree_count tip_square; /* greatest squared distance from the centre */
} quadtree_measures;

/* Greatest |q| and |r|: cells beyond are refused with SNOW_ERROR_TOO_LARGE, and
   so are steps that might lead there. Enough for 2^62 steps from 32-bit seeds. */
#define SNOW_QUADTREE_REACH (INT64_C(5) << 60)

/* An empty plane. All memory comes from the heap, and stays until destroy: when
   the heap refuses more, what is no longer needed is collected and used again.
   A call that needs much more memory than there is gives up in the end: it
   collects 32 times at most. A call that fails for want of memory (SNOW_ERROR_MEMORY_LIMIT,
   SNOW_ERROR_NO_MEMORY, or SNOW_ERROR_TOO_LARGE at 2^29 nodes) leaves the
   crystal as it was. */
snow_status snow_quadtree_create(snow_heap *heap, uint8_t rule, snow_quadtree **tree);
void snow_quadtree_destroy(snow_quadtree *tree); /* NULL: nothing */

/* From here on distances are measured from this cell, less than 2^60 from the axes; at first from the origin. */
void snow_quadtree_set_centre(snow_quadtree *tree, int64_t q, int64_t r);

/* Makes the cells of a rectangle what the bits say; stride in words. */
snow_status snow_quadtree_put(snow_quadtree *tree, int64_t q, int64_t r, int64_t width, int64_t height,
                              const uint64_t *bits, size_t stride);

/* Writes the cells of a rectangle within the reach, and zeros into the rest of each row's last word. */
void snow_quadtree_copy(const snow_quadtree *tree, int64_t q, int64_t r, int64_t width, int64_t height,
                        uint64_t *bits, size_t stride);

/* Moves on to the first of the squares of 64 by 64 cells, from multiples of 64 on, that may hold frozen cells, row by
   row of squares, and is not before the one with this cell. False: there is none. */
bool snow_quadtree_next(const snow_quadtree *tree, int64_t *q, int64_t *r);

bool snow_quadtree_get(const snow_quadtree *tree, int64_t q, int64_t r);

/* Any number of steps, as one result for each of its binary digits. */
snow_status snow_quadtree_advance(snow_quadtree *tree, uint64_t steps);

/* Whether no cell freezes in the next step, and so ever. Also false when there is no memory to find out. */
bool snow_quadtree_is_still(snow_quadtree *tree);

/* Exact. Known after an advance, found after a put. */
snow_status snow_quadtree_measure(snow_quadtree *tree, quadtree_measures *measures);

/* Keeps the crystal as it is now, in place of one kept before, and goes back to
   it, as often as is wanted. At first the empty plane is kept. Both are free. */
void snow_quadtree_keep(snow_quadtree *tree);
void snow_quadtree_restore(snow_quadtree *tree);

/* What has been done since the tree was created, on every machine the same: nodes and leaves made, results found. */
uint64_t snow_quadtree_work(const snow_quadtree *tree);

/* Writes the crystal, each different part of it once. Needs no memory; some
   results will have to be found again. Several threads may save, copy and get at once. */
void snow_quadtree_save(snow_quadtree *tree, snow_sink *sink);

/* A new tree with the crystal that was saved. SNOW_ERROR_TRUNCATED,
   SNOW_ERROR_DAMAGED; takes memory in proportion to the data. */
snow_status snow_quadtree_load(snow_heap *heap, uint8_t rule, snow_source *source, snow_quadtree **tree);

#endif
