/* The inner loops of the ROWS engine, one table for each instruction set. */
#ifndef SNOW_REITER_KERNEL_H
#define SNOW_REITER_KERNEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Rows are computed in whole chunks of this many cells, aligned in memory. */
enum { REITER_CHUNK = 8 };

/* A run of chunks of one row. Cells of its first and last chunk that are not
   the row's own keep their values: a mask has a bit for each that is. */
typedef struct reiter_segment {
    uint32_t row;    /* number of the first cell */
    uint32_t above;  /* of the cell above it: same q, r − 1 */
    uint32_t below;  /* same q, r + 1 */
    uint32_t chunks; /* at least 1 */
    uint32_t bit;    /* where its chunks stand in a map of chunks */
    uint8_t first_mask;
    uint8_t last_mask;
} reiter_segment;

typedef struct reiter_flow {
    const double *vapour;
    double *next;
    double weight;  /* α/12 */
    double rounder; /* adding and subtracting it rounds a flow to the quantum */
    double one;     /* 1, so that the compiler does not know it */
} reiter_flow;

typedef struct reiter_kernel {
    /* One step of the vapour. */
    void (*diffuse)(const reiter_flow *flow, const reiter_segment *segments, size_t count);
    /* The same; sets the bits of the chunks in which anything flows. */
    void (*diffuse_and_look)(const reiter_flow *flow, const reiter_segment *segments, size_t count, uint64_t *flowing);
    /* Whether any cell of the segments is beyond ±limit. */
    bool (*exceeds)(const double *cells, const reiter_segment *segments, size_t count, double limit);
} reiter_kernel;

extern const reiter_kernel snow_reiter_kernel_baseline;
extern const reiter_kernel snow_reiter_kernel_avx2;
extern const reiter_kernel snow_reiter_kernel_avx512;

#endif
