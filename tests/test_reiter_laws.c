/* What the model's equations promise, whatever the engine: uniform vapour, plates, mass, arm lengths. */
#include "support/grids.h"

#include <math.h>
#include <stdlib.h>

static const snow_reiter_engine engines[] = {SNOW_REITER_ENGINE_ROWS, SNOW_REITER_ENGINE_REFERENCE,
                                             SNOW_REITER_ENGINE_QUAD};

static void assert_uniform_for_10000_steps(snow_reiter_params params, snow_isa isa)
{
    without_seeds(&params);
    snow_options options = default_options();
    options.isa = isa;
    snow_grid *grid = make_grid(&params, &options);
    size_t count;
    double *inside = copy_field(grid, SNOW_FIELD_INSIDE, NULL, &count);
    double *before = copy_field(grid, SNOW_FIELD_VALUE, NULL, NULL);
    /* Half a quantum: 2^-51 of the power of two above β, eight times as much where values may overshoot. */
    double rounding = params.background * (params.diffusion > 2 ? 0x1p-47 : 0x1p-50);
    double middle = value_at(grid, SNOW_FIELD_VALUE, 0, 0);
    assert_near(params.background, middle, rounding);
    for (size_t i = 0; i < count; i++)
        if (inside[i] == 1)
            assert_same_double(middle, before[i]);
    assert_ok(snow_step(grid, 10000));
    double *after = copy_field(grid, SNOW_FIELD_VALUE, NULL, NULL);
    assert_memory_equal(before, after, count * sizeof *before);
    assert_int_equal(0, frozen_of(grid));
    free(inside);
    free(before);
    free(after);
    snow_destroy(grid);
}

static void a_uniform_medium_stays_as_it_is(void **state)
{
    (void)state;
    static const double backgrounds[] = {0.1, 0.2, 0.3, 0.4, 0.7, 0.9, 0.95, 1e-6, 1.0 / 3};
    static const double diffusions[] = {0.5, 0.501, 1, 2.003, 2.6, 8.0 / 3};
    snow_isa isas[8];
    size_t count = available_isas(isas);
    for (size_t i = 0; i < COUNT_OF(backgrounds); i++) {
        for (size_t j = 0; j < COUNT_OF(diffusions); j++) {
            snow_isa isa = isas[(i + j) % count];
            assert_uniform_for_10000_steps(disc_scene(backgrounds[i], 0.001, diffusions[j], 6), isa);
        }
        assert_uniform_for_10000_steps(rectangle_scene(backgrounds[i], 0.001, 1, 19, 5), isas[i % count]);
        assert_uniform_for_10000_steps(hexagon_scene(backgrounds[i], 0.001, 1, 4), isas[i % count]);
    }
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 5);
    params.engine = SNOW_REITER_ENGINE_REFERENCE;
    assert_uniform_for_10000_steps(params, SNOW_ISA_AUTO);
    params.radius = 3;
    params.engine = SNOW_REITER_ENGINE_QUAD;
    assert_uniform_for_10000_steps(params, SNOW_ISA_AUTO);
}

static void nothing_grows_from_nothing(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_reiter_params params = disc_scene(0, 0, 1, i == 2 ? 4 : 12);
        params.engine = engines[i];
        snow_grid *grid = make_grid(&params, NULL);
        assert_ok(snow_step(grid, 10000));
        assert_int_equal(1, frozen_of(grid));
        assert_same_double(1.0, value_at(grid, SNOW_FIELD_VALUE, 0, 0));
        assert_same_double(0.0, value_at(grid, SNOW_FIELD_VALUE, 1, 0));
        snow_destroy(grid);
    }
}

/* β = 0: nothing diffuses, and ring k freezes in step k·⌈1/γ⌉, corners and sides alike. */
static void plates_are_hexagons_that_grow_by_rings(void **state)
{
    (void)state;
    static const struct {
        double addition;
        int64_t steps_a_ring;
        int32_t rings;
    } plates[] = {{1, 1, 12},      {0.5, 2, 10},     {0.4, 3, 8},      {0.1, 10, 10},      {0.05, 20, 8},
                  {0.03, 34, 8}, {0.01, 100, 6}, {0.001, 1000, 4}, {0.0025, 400, 4}, {0.0001, 10000, 2}};
    for (size_t i = 0; i < COUNT_OF(plates); i++) {
        for (size_t k = 0; k < COUNT_OF(engines); k++) {
            int32_t rings = engines[k] == SNOW_REITER_ENGINE_QUAD ? 2 : plates[i].rings;
            snow_reiter_params params = hexagon_scene(0, plates[i].addition, 1, rings + 2);
            params.engine = engines[k];
            params.record_freeze_steps = 1;
            snow_grid *grid = make_grid(&params, NULL);
            for (int32_t ring = 1; ring <= rings; ring++) {
                assert_ok(snow_step(grid, plates[i].steps_a_ring - 1));
                assert_int_equal(3 * ring * (ring - 1) + 1, frozen_of(grid));
                assert_ok(snow_step(grid, 1));
                assert_int_equal(3 * ring * (ring + 1) + 1, frozen_of(grid));
                assert_same_double(ring, tip_of(grid));
            }
            for (int32_t r = -rings; r <= rings; r++) {
                for (int32_t q = -rings; q <= rings; q++) {
                    int32_t ring = (abs(q) + abs(r) + abs(q + r)) / 2;
                    double expected = ring <= rings ? (double)(ring * plates[i].steps_a_ring) : -1;
                    assert_same_double(expected, value_at(grid, SNOW_FIELD_FREEZE_STEP, q, r));
                }
            }
            snow_destroy(grid);
        }
    }
}

/* A whole number of additions is counted, not summed up. */
static void ice_gains_exactly_the_addition(void **state)
{
    (void)state;
    static const double additions[] = {0.1, 0.001, 0.0001, 1.0 / 3};
    for (size_t i = 0; i < COUNT_OF(additions); i++) {
        for (size_t k = 0; k < COUNT_OF(engines); k++) {
            snow_reiter_params params = disc_scene(0.4, additions[i], 1, 6);
            params.engine = engines[k];
            snow_grid *grid = make_grid(&params, NULL);
            for (int64_t steps = 100; steps <= 1000; steps += 100) {
                assert_ok(snow_step(grid, 100));
                assert_same_double(1 + additions[i] * (double)steps, value_at(grid, SNOW_FIELD_VALUE, 0, 0));
            }
            snow_destroy(grid);
        }
    }
}

static double total_mass(const snow_grid *grid)
{
    double vapour, ice;
    assert_ok(snow_mass(grid, &vapour, &ice));
    return vapour + ice;
}

/* γ = 0, and the news of the seed has not reached the rim: what one cell loses another gains. Only cells within n hex
   steps change in step n, 3n(n+1) + 1 of them, and each is rounded by half a quantum of 2^-51 at most. */
static void mass_is_conserved_while_the_rim_is_untouched(void **state)
{
    (void)state;
    static const double diffusions[] = {0.5, 1, 1.7, 2};
    for (size_t i = 0; i < COUNT_OF(diffusions); i++) {
        for (size_t k = 0; k < 2; k++) {
            snow_reiter_params params = disc_scene(0.4, 0, diffusions[i], 50);
            params.engine = engines[k];
            snow_grid *grid = make_grid(&params, NULL);
            double start = total_mass(grid);
            double bound = 4 * (nextafter(start, HUGE_VAL) - start);
            /* The disc holds all cells within 42 steps. */
            for (int64_t n = 1; n <= 42; n++) {
                assert_ok(snow_step(grid, 1));
                bound += (double)(3 * n * (n + 1) + 1) * 0x1p-52;
                assert_near(start, total_mass(grid), bound);
            }
            assert_true(bound < 1e-10);
            snow_destroy(grid);
        }
    }
}

/* With γ > 0 it grows by γ for each receptive cell. */
static void mass_grows_by_the_additions(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.05, 1, 50);
    snow_grid *grid = make_grid(&params, NULL);
    for (int n = 1; n <= 30; n++) {
        size_t count;
        double *receptive = copy_field(grid, SNOW_FIELD_RECEPTIVE, NULL, &count);
        double gain = 0;
        for (size_t i = 0; i < count; i++)
            gain += 0.05 * receptive[i];
        free(receptive);
        double before = total_mass(grid);
        assert_ok(snow_step(grid, 1));
        assert_near(before + gain, total_mass(grid), 1e-11);
    }
    assert_true(frozen_of(grid) > 30);
    snow_destroy(grid);
}

/* Ice only takes vapour, so that without noise no free cell ever gains; rounding keeps that order for α <= 2. */
static void free_vapour_only_falls(void **state)
{
    (void)state;
    static const double diffusions[] = {0.5, 1, 2};
    for (size_t i = 0; i < COUNT_OF(diffusions); i++) {
        snow_reiter_params params = disc_scene(0.4, 0.003, diffusions[i], 25);
        snow_grid *grid = make_grid(&params, NULL);
        size_t count;
        double *before = copy_field(grid, SNOW_FIELD_VAPOUR, NULL, &count);
        for (int n = 0; n < 150; n++) {
            assert_ok(snow_step(grid, 1));
            double *after = copy_field(grid, SNOW_FIELD_VAPOUR, NULL, NULL);
            for (size_t k = 0; k < count; k++)
                assert_true(after[k] <= before[k] && after[k] >= 0);
            free(before);
            before = after;
        }
        free(before);
        snow_destroy(grid);
    }
}

/* A closed pocket of vapour decays without ever becoming a subnormal number. */
static void starving_vapour_ends_at_zero(void **state)
{
    (void)state;
    snow_cell ring[24];
    size_t count = 0;
    for (int32_t q = -4; q <= 4; q++)
        for (int32_t r = -4; r <= 4; r++)
            if ((abs(q) + abs(r) + abs(q + r)) / 2 == 4)
                ring[count++] = (snow_cell){q, r};
    assert_int_equal(24, count);
    snow_reiter_params params = disc_scene(0.4, 0, 1, 9);
    params.seeds = ring;
    params.seed_count = count;
    snow_grid *grid = make_grid(&params, NULL);
    double last = 1;
    for (int n = 0; n < 200; n++) {
        assert_ok(snow_step(grid, 10));
        double middle = value_at(grid, SNOW_FIELD_VAPOUR, 0, 0);
        assert_true(middle == 0 || fabs(middle) >= 0x1p-51);
        assert_true(middle <= last);
        last = middle;
    }
    assert_near(0.0, last, 0x1p-48);
    snow_destroy(grid);
}

/* Reiter 2005, fig. 3: the arm at 10,000 steps for β = 0.1, γ = 0.0001, scanned as 29 ± 3, computed as 30. The rim of
   the paper's circle is felt: its radius is that of the scanned figures. test_slow_arms.c has the rest of the table. */
static void an_arm_of_figure_3(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.1, 0.0001, 1, 173);
    snow_grid *grid = make_grid(&params, NULL);
    assert_int_equal(SNOW_STOP_STEPS, run_grid(grid, NULL).reason);
    assert_int_equal(10000, steps_of(grid));
    assert_same_double(30, tip_of(grid));
    assert_same_double(0.0, defect_of(grid));
    snow_destroy(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_uniform_medium_stays_as_it_is),
        cmocka_unit_test(nothing_grows_from_nothing),
        cmocka_unit_test(plates_are_hexagons_that_grow_by_rings),
        cmocka_unit_test(ice_gains_exactly_the_addition),
        cmocka_unit_test(mass_is_conserved_while_the_rim_is_untouched),
        cmocka_unit_test(mass_grows_by_the_additions),
        cmocka_unit_test(free_vapour_only_falls),
        cmocka_unit_test(starving_vapour_ends_at_zero),
        cmocka_unit_test(an_arm_of_figure_3),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
