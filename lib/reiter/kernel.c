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
    for (size_t i = 0; i < count; i++) {
        double sum = (row[i - 1] + row[i + 1]) + (above[i] + above[i + 1]) + (below[i - 1] + below[i]);
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
