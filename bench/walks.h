/*
 * Walks as small programs take them, on the square lattice by arrival: single steps with a kill radius, and jumps of
 * the continuum. They share nothing with the library.
 */
#ifndef BENCH_WALKS_H
#define BENCH_WALKS_H

#include <snowgrowth/aggregate.h>

#include <stdint.h>

typedef struct walks walks;

/* A cluster round the origin, not larger than some hundred sites across. NULL: no memory. */
walks *walks_start(const snow_site *sites, size_t count);
void walks_end(walks *self);

/* From a circle just outside the cluster, rounded to sites, by single steps; dropped beyond `kill` cluster radii. */
snow_site walks_step(walks *self, double kill);

/* The same without a kill radius, by jumps onto circles that miss the cluster, rounded to sites, and back from far
   away by the law of Brownian motion. */
snow_site walks_jump(walks *self);

#endif
