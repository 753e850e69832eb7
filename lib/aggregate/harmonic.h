/* Growth probabilities of a cluster, exact up to rounding. */
#ifndef SNOW_AGGREGATE_HARMONIC_H
#define SNOW_AGGREGATE_HARMONIC_H

#include "base/heap.h"

#include <snowgrowth/aggregate.h>

/* The chance of each site that the next walker from infinity can end on, by z,
   y, x, with a bound of its error; `sites` are the filled ones, at least one.
   The list comes from the heap, and is the caller's. SNOW_ERROR_TOO_LARGE for
   more than 4096 unknowns, or sites too far apart to look for ways between them. */
snow_status snow_harmonic_solve(snow_heap *heap, snow_aggregate_lattice lattice, snow_aggregate_contact contact,
                                const snow_site *sites, size_t count, snow_aggregate_chance **chances,
                                size_t *chance_count);

#endif
