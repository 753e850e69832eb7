/*
 * Scenes and grids of Packard's model, where any failure fails the test.
 */
#ifndef TESTS_SUPPORT_PACKARD_H
#define TESTS_SUPPORT_PACKARD_H

#include "grids.h"

/* One seed on the plane; the rule as text. */
snow_packard_params packard_scene(const char *rule);

snow_grid *make_packard(const snow_packard_params *params, const snow_options *options);

snow_packard_zone packard_zone_of(snow_packard_zone_kind kind, snow_packard_zone_shape shape, int64_t first_step,
                                  int64_t last_step);

/* A scene of any kind from a random stream: rule, domain, seeds; small enough for the reference. */
snow_packard_params random_packard_scene(uint64_t *state, snow_cell seeds[8]);

/* Adds up to three zones of any kind. */
void add_random_zones(uint64_t *state, snow_grid *const *grids, size_t count);

snow_packard_engine engine_of(const snow_grid *grid);

/* The same cells, counts and bounds, and freeze steps where both record them. */
void assert_same_crystals(const snow_grid *expected, const snow_grid *got);

/* p(n) of one seed on the plane after n steps. */
uint64_t population_after(const char *rule, snow_packard_engine engine, int64_t steps);

#endif
