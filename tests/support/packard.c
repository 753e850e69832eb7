#include "packard.h"

#include <string.h>

snow_packard_params packard_scene(const char *rule)
{
    snow_packard_params params;
    snow_packard_params_init(&params, sizeof params);
    assert_ok(snow_packard_params_rule(&params, rule));
    return params;
}

snow_grid *make_packard(const snow_packard_params *params, const snow_options *options)
{
    snow_grid *grid = NULL;
    assert_ok(snow_packard_create(params, options, &grid));
    assert_non_null(grid);
    return grid;
}

snow_packard_zone packard_zone_of(snow_packard_zone_kind kind, snow_packard_zone_shape shape, int64_t first_step,
                                  int64_t last_step)
{
    snow_packard_zone zone;
    snow_packard_zone_init(&zone, sizeof zone, kind, shape);
    zone.first_step = first_step;
    zone.last_step = last_step;
    return zone;
}

snow_packard_params random_packard_scene(uint64_t *state, snow_cell seeds[8])
{
    snow_packard_params params;
    snow_packard_params_init(&params, sizeof params);
    params.domain = (snow_packard_domain)(SNOW_PACKARD_PLANE + (int)next_below(state, 6));
    params.rule = next_below(state, 128);
    if (params.domain == SNOW_PACKARD_PLANE)
        params.rule &= 0x7E;
    params.radius = 4 + (int32_t)next_below(state, 40);
    params.width = 9 + (int32_t)next_below(state, 90);
    params.height = 9 + (int32_t)next_below(state, 90);
    params.seed_count = 1 + next_below(state, 8);
    for (size_t i = 0; i < params.seed_count; i++)
        seeds[i] = (snow_cell){(int32_t)next_below(state, 5) - 2, (int32_t)next_below(state, 3) - 1};
    params.seeds = seeds;
    if (next_below(state, 3) == 0)
        params.seeds = NULL, params.seed_count = 0;
    return params;
}

static int checkered(void *context, int32_t q, int32_t r)
{
    (void)context;
    return (q ^ r) & 1;
}

static snow_packard_zone random_zone(uint64_t *state)
{
    int64_t first = 1 + next_below(state, 30);
    snow_packard_zone zone =
        packard_zone_of((snow_packard_zone_kind)(1 + next_below(state, 2)),
                        (snow_packard_zone_shape)(1 + next_below(state, 3)), first, first + next_below(state, 20));
    zone.half_width = next_below(state, 9) / 2.0;
    if (next_below(state, 2) == 0)
        zone.half_angle = 1 + next_below(state, 30);
    zone.inner = (int32_t)next_below(state, 10);
    if (next_below(state, 2) == 0)
        zone.outer = zone.inner + (int32_t)next_below(state, 30);
    if (next_below(state, 3) == 0)
        zone.centre = (snow_cell){(int32_t)next_below(state, 9) - 4, (int32_t)next_below(state, 9) - 4};
    zone.rect = (snow_rect){(int32_t)next_below(state, 20) - 20, (int32_t)next_below(state, 20) - 20,
                            (int32_t)next_below(state, 60), (int32_t)next_below(state, 60)};
    zone.inverted = next_below(state, 5) == 0;
    zone.contains = next_below(state, 2) == 0 ? checkered : NULL;
    return zone;
}

void add_random_zones(uint64_t *state, snow_grid *const *grids, size_t count)
{
    for (uint32_t zones = next_below(state, 4); zones > 0; zones--) {
        snow_packard_zone zone = random_zone(state);
        for (size_t i = 0; i < count; i++)
            assert_ok(snow_packard_add_zone(grids[i], &zone));
    }
}

snow_packard_engine engine_of(const snow_grid *grid)
{
    snow_packard_engine engine = SNOW_PACKARD_ENGINE_AUTO;
    assert_ok(snow_packard_engine_of(grid, &engine));
    return engine;
}

void assert_same_crystals(const snow_grid *expected, const snow_grid *got)
{
    assert_int_equal(steps_of(expected), steps_of(got));
    assert_same_field(expected, got, SNOW_FIELD_FROZEN);
    assert_same_field(expected, got, SNOW_FIELD_RECEPTIVE);
    if (records_freeze_steps(expected) && records_freeze_steps(got))
        assert_same_field(expected, got, SNOW_FIELD_FREEZE_STEP);
    assert_int_equal(frozen_of(expected), frozen_of(got));
    assert_int_equal(cells_of(expected), cells_of(got));
    assert_same_double(tip_of(expected), tip_of(got));
    snow_hexagon left, right;
    assert_ok(snow_frozen_hexagon(expected, &left));
    assert_ok(snow_frozen_hexagon(got, &right));
    assert_memory_equal(&left, &right, sizeof left);
    assert_true(digest_of(expected) == digest_of(got));
}

uint64_t population_after(const char *rule, snow_packard_engine engine, int64_t steps)
{
    snow_packard_params params = packard_scene(rule);
    params.engine = engine;
    snow_grid *grid = make_packard(&params, NULL);
    assert_ok(snow_step(grid, steps));
    uint64_t high = 1, low = 0;
    assert_ok(snow_packard_population(grid, &high, &low));
    assert_int_equal(0, high);
    snow_destroy(grid);
    return low;
}
