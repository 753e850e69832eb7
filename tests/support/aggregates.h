/*
 * Grids of the aggregation model, and the clusters whose hit probabilities are known.
 */
#ifndef TESTS_SUPPORT_AGGREGATES_H
#define TESTS_SUPPORT_AGGREGATES_H

#include "check.h"

#include <stdbool.h>

snow_aggregate_params aggregate_scene(snow_aggregate_scene scene);

/* Scenes of every kind, small. */
extern const size_t aggregate_kind_count;
snow_aggregate_params aggregate_kind(size_t number);

snow_grid *make_aggregate(const snow_aggregate_params *params, const snow_options *options);

/* All particles; free() them. */
snow_site *copy_sites(const snow_grid *grid, size_t *count);

/* Growth probabilities, solved or sampled; free() them. */
snow_aggregate_chance *solve_chances(const snow_grid *grid, size_t *count);
snow_aggregate_chance *sample_chances(const snow_grid *grid, uint64_t walks, uint64_t random_seed, size_t *count);

/* How many of the walks ended on each site of a list. Fails when one ended elsewhere. */
void count_hits(const snow_grid *grid, uint64_t walks, uint64_t random_seed, const snow_aggregate_chance *list,
                size_t count, double *hits);

/* A cluster, and the chances of one site of each kind. */
typedef struct known_cluster {
    const char *name;
    snow_aggregate_lattice lattice;
    size_t size;
    snow_site sites[7];
    struct {
        snow_site site;
        double arrival;
        double entry;
    } chance[4];
} known_cluster;

extern const known_cluster known_clusters[];
extern const size_t known_cluster_count;

snow_grid *make_known(const known_cluster *cluster, snow_aggregate_contact contact, snow_aggregate_engine engine);

/* A cluster of so many particles, always the same one, as the seeds of another grid. */
snow_grid *grow_cluster(snow_aggregate_lattice lattice, snow_aggregate_contact contact, snow_aggregate_engine engine,
                        int64_t particles, double sticking);

/* Fail when the walks of an engine do not follow the solved chances: on every known cluster, on one of 300
   particles on each lattice; both by both contact rules. */
void check_known_clusters(snow_aggregate_engine engine, uint64_t plane, uint64_t space);
void check_grown_cluster(snow_aggregate_engine engine, uint64_t plane, uint64_t space);

#endif
