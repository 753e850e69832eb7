/* The inner loops of the ROWS engine, one table for each instruction set. */
#ifndef SNOW_REITER_KERNEL_H
#define SNOW_REITER_KERNEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Cells are computed in whole chunks, aligned in memory: so many cells of each
   of so many rows, a band. Rows of a band share what they load: a cell is the
   right neighbour of one, and of two in the rows beside it. */
enum { REITER_CHUNK = 8, REITER_BAND = 4 };

/* Chunks side by side. Cells that are not to be computed keep their values: a
   mask for each row has a bit for each cell of a chunk that is. Segments with
   other masks than full ones are one chunk long. */
typedef struct reiter_segment {
    uint32_t row;    /* number of the first cell of the first row */
    uint32_t above;  /* of the cell above it: same q, r − 1 */
    uint32_t below;  /* of the cell below the last row: same q */
    uint32_t stride; /* from a row to the next */
    uint32_t chunks; /* at least 1 */
    uint32_t bit;    /* where they stand in a map of chunks */
    uint8_t mask[REITER_BAND];
} reiter_segment;

/* Vapour is kept as doubles or, in single precision, as 32-bit multiples of the
   quantum; limits are in the same units. */
typedef struct reiter_flow {
    const void *vapour;
    void *next;
    double weight;    /* α/12 */
    double rounder;   /* adding and subtracting it rounds a flow to the quantum; doubles only */
    double tolerance; /* flows up to this count as none when a kernel looks */
    bool backward;    /* from the last segment to the first */
} reiter_flow;

typedef struct reiter_kernel {
    /* One step of the vapour. */
    void (*diffuse)(const reiter_flow *flow, const reiter_segment *segments, size_t count);
    /* The same; sets the bits of the chunks in which anything flows. */
    void (*diffuse_and_look)(const reiter_flow *flow, const reiter_segment *segments, size_t count, uint64_t *flowing);
    /* Whether any cell of the segments is beyond ±limit. */
    bool (*exceeds)(const void *cells, const reiter_segment *segments, size_t count, double limit);
} reiter_kernel;

extern const reiter_kernel snow_reiter_double_baseline;
extern const reiter_kernel snow_reiter_double_avx2;
extern const reiter_kernel snow_reiter_double_avx512;
extern const reiter_kernel snow_reiter_single_baseline;
extern const reiter_kernel snow_reiter_single_avx2;
extern const reiter_kernel snow_reiter_single_avx512;

#endif
