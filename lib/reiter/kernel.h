/* The inner loops of the ROWS engine, one table for each instruction set. */
#ifndef SNOW_REITER_KERNEL_H
#define SNOW_REITER_KERNEL_H

#include <snowgrowth/options.h>

#include <stdbool.h>
#include <stddef.h>

typedef struct reiter_kernel {
    /* One step of the vapour of a row of cells: out[i] from row[i] and its
       neighbours row[i ± 1], above[i], above[i + 1], below[i − 1], below[i]. */
    void (*diffuse)(double *restrict out, const double *restrict above, const double *restrict row,
                    const double *restrict below, size_t count, double weight, double rounder);
    /* Whether any of the numbers is below −limit or above limit. */
    bool (*exceeds)(const double *row, size_t count, double limit);
} reiter_kernel;

extern const reiter_kernel snow_reiter_kernel_baseline;
extern const reiter_kernel snow_reiter_kernel_avx2;
extern const reiter_kernel snow_reiter_kernel_avx512;

#endif
