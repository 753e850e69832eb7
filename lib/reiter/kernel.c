/* Compiled once for each instruction set, with SNOW_KERNEL naming it. Written
   for the compiler's vectoriser: no branches, no order that matters. */
#include "reiter/kernel.h"

#include <math.h>

#define JOIN(a, b) a##b
#define TABLE(isa) JOIN(snow_reiter_kernel_, isa)

/* The sums are exact (doc/reiter.md), so their order is free. */
static void diffuse(double *restrict out, const double *restrict above, const double *restrict row,
                    const double *restrict below, size_t count, double weight, double rounder)
{
    const double *left = row - 1;
    const double *right = row + 1;
    const double *above_right = above + 1;
    const double *below_left = below - 1;
    for (size_t i = 0; i < count; i++) {
        double sum = (left[i] + right[i]) + (above[i] + above_right[i]) + (below_left[i] + below[i]);
        double flow = weight * (sum - 6 * row[i]);
        out[i] = row[i] + ((flow + rounder) - rounder);
    }
}

static bool exceeds(const double *row, size_t count, double limit)
{
    int beyond = 0;
    for (size_t i = 0; i < count; i++)
        beyond |= !(fabs(row[i]) <= limit);
    return beyond != 0;
}

const reiter_kernel TABLE(SNOW_KERNEL) = {.diffuse = diffuse, .exceeds = exceeds};
