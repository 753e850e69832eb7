/* Growth by jumps: walkers from infinity, one after the other, each with its
   own stream, against a cluster on the square, hexagonal or cubic lattice; seeds
   anywhere in the plane or in space, or a floor between mirrors. The law is that
   of single steps: flight.h, source.h. */
#ifndef SNOW_AGGREGATE_GROWTH_H
#define SNOW_AGGREGATE_GROWTH_H

#include "base/heap.h"
#include "base/parallel.h"

#include <snowgrowth/aggregate.h>

#include <stdbool.h>
#include <stdint.h>

typedef struct snow_growth snow_growth;

typedef struct snow_growth_rules {
    snow_aggregate_lattice lattice;
    snow_aggregate_contact contact;
    double stick;       /* 0 < stick <= 1 */
    bool has_obstacles; /* snow_growth_obstruct() may be called */
    uint64_t seed;      /* key of the streams */
    snow_isa isa;       /* settled */
    /* A vessel: 0 <= x < width (space: 0 <= y < depth), rows (layers) from 0
       on, above a filled floor in row -1; walls are mirrors. Square and cubic:
       halfway between sites, so that a step through one is refused. Hexagonal:
       0 <= X <= 2 width - 1, X = 2q + r, with mirrors at both ends, on sites. */
    int32_t width; /* 0: no vessel */
    int32_t depth;
    int32_t lid; /* the highest row, a mirror above it (hexagonal: through it); negative: none */
} snow_growth_rules;

snow_status snow_growth_start(snow_growth **growth, snow_heap *heap, const snow_growth_rules *rules);
void snow_growth_end(snow_growth *growth, snow_heap *heap);

/* An empty cluster again, with other streams; tables are kept. */
snow_status snow_growth_clear(snow_growth *growth, snow_heap *heap, uint64_t seed);

/* Seeds, or the particles of a snapshot. On failure those before it are there. */
snow_status snow_growth_fill(snow_growth *growth, snow_heap *heap, const snow_site *sites, size_t count);
snow_status snow_growth_obstruct(snow_growth *growth, snow_heap *heap, const snow_site *sites, size_t count);

/* Who receives the walkers. */
typedef struct snow_growth_port {
    /* Whether a walker that ends on this site would fill it; it changes nothing. NULL: each does. */
    bool (*fills)(const void *context, snow_site site);
    /* A walker has ended there; false: none comes after it in this call. */
    bool (*arrives)(void *context, snow_site site, bool filled);
    void *context;
} snow_growth_port;

/* How walkers are sent out. */
typedef struct snow_growth_crew {
    snow_parallel_for loop;
    void *context;
    int threads; /* 1: the loop is not used */
} snow_growth_crew;

/* Sends out walkers from number *walker on, until `most` have filled a site or
   one is the last. The port hears of them in their order, from one thread at a
   time: with several threads, of the loop's ones.
   *walker becomes the number of the next one. On failure the walkers before
   that one have arrived, and it has not. */
snow_status snow_growth_run(snow_growth *growth, snow_heap *heap, const snow_growth_crew *crew, uint64_t most,
                            uint64_t *walker, const snow_growth_port *port);

/* A walker has ended there, and fills nothing; false: none comes after it. */
typedef bool (*snow_growth_ends)(void *context, snow_site site);

/* Sends out walkers of another family of streams, from number `first` on, against the cluster as it stands; they are
   told in their order. */
snow_status snow_growth_sample(const snow_growth *growth, snow_heap *heap, uint64_t key, uint64_t first, uint64_t count,
                               snow_growth_ends ends, void *context);

/* How many jumps and steps one of them takes inside the map. */
uint64_t snow_growth_probe_jumps(const snow_growth *growth, uint64_t key, uint64_t walker);

/* Walks that were done again because the cluster had changed under them, so far. */
uint64_t snow_growth_repeats(const snow_growth *growth);

#endif
