/* What a steady source at a site of the lattice does at another one: in the
   plane the potential kernel, in space Green's function. F. Spitzer, Principles
   of Random Walk (2nd ed., 1976), sections 11-12, 15, 26. */
#ifndef SNOW_AGGREGATE_POTENTIAL_H
#define SNOW_AGGREGATE_POTENTIAL_H

#include "base/heap.h"

#include <snowgrowth/aggregate.h>

typedef struct snow_potential {
    snow_aggregate_lattice lattice;
    int32_t reach; /* the table goes to coordinates below this, at most SNOW_POTENTIAL_REACH */
    double *near;
} snow_potential;

enum { SNOW_POTENTIAL_REACH = 64 };

/* No value is farther from the truth than this. */
static const double snow_potential_error = 0x1p-47;

/* For sites whose coordinates (hexagonal: their sums, too) differ by at most so much; the table can be shorter. */
snow_status snow_potential_start(snow_potential *potential, snow_heap *heap, snow_aggregate_lattice lattice,
                                 int64_t extent);
void snow_potential_end(snow_potential *potential, snow_heap *heap);

/* In the plane the kernel a, 0 at the origin and growing like a logarithm, with
   mean(a of the neighbours) - a = 1 at the origin and 0 elsewhere. In space
   Green's function G: how often a walk from the origin visits a site. */
double snow_potential_at(const snow_potential *potential, int32_t x, int32_t y, int32_t z);

/* The table for the cubic lattice: G(x, y, z), reach > x >= y >= z >= 0, at x (x + 1) (x + 2)/6 + y (y + 1)/2 + z. */
void snow_potential_fill_space(double *near, int32_t reach);

/* G far from the origin. */
double snow_potential_far_space(double x, double y, double z);

#endif
