/* A scene with the symmetry of the hexagon keeps it exactly; one without it does not get it. */
#include "support/grids.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A sixth of a turn, and a mirror image. */
static snow_cell turned(snow_cell cell)
{
    return (snow_cell){-cell.r, cell.q + cell.r};
}

static snow_cell mirrored(snow_cell cell)
{
    return (snow_cell){cell.r, cell.q};
}

/* What snow_symmetry_defect() promises, cell by cell. Every image is reached by turns and mirror images. */
static double defect_by_hand(const snow_grid *grid)
{
    snow_rect bounds = bounds_of(grid);
    double greatest = 0;
    for (int32_t r = bounds.r; r < bounds.r + bounds.height; r++) {
        for (int32_t q = bounds.q; q < bounds.q + bounds.width; q++) {
            if (value_at(grid, SNOW_FIELD_INSIDE, q, r) == 0)
                continue;
            double value = value_at(grid, SNOW_FIELD_VALUE, q, r);
            snow_cell image = {q, r};
            for (int i = 0; i < 12; i++) {
                image = i == 5 ? mirrored(image) : turned(image);
                if (value_at(grid, SNOW_FIELD_INSIDE, image.q, image.r) == 1)
                    greatest = fmax(greatest, fabs(value - value_at(grid, SNOW_FIELD_VALUE, image.q, image.r)));
            }
        }
    }
    return greatest;
}

static void assert_stays_symmetric(const snow_reiter_params *params, int64_t steps)
{
    snow_isa isas[8];
    size_t count = available_isas(isas);
    for (size_t i = 0; i < count; i++) {
        snow_options options = default_options();
        options.isa = isas[i];
        options.threads = (int32_t)(i % 3) + 1;
        snow_grid *grid = make_grid(params, &options);
        assert_same_double(0.0, defect_of(grid));
        for (int part = 0; part < 5; part++) {
            assert_ok(snow_step(grid, steps / 5));
            assert_same_double(0.0, defect_of(grid));
        }
        if (i == 0)
            assert_same_double(0.0, defect_by_hand(grid));
        assert_true(frozen_of(grid) % 6 == 1 || params->seeds != NULL);
        snow_destroy(grid);
    }
}

static void one_seed_grows_symmetrically(void **state)
{
    (void)state;
    static const double backgrounds[] = {0, 0.3, 0.4, 0.6, 0.9, 0.95};
    static const double additions[] = {0.0001, 0.001, 0.01, 0.05, 1};
    static const double diffusions[] = {0.5, 0.501, 1, 2.003, 2.6};
    for (size_t i = 0; i < COUNT_OF(backgrounds); i++) {
        for (size_t j = 0; j < COUNT_OF(additions); j++) {
            size_t k = (i + j) % COUNT_OF(diffusions);
            snow_reiter_params disc = disc_scene(backgrounds[i], additions[j], diffusions[k], 24);
            snow_reiter_params hexagon = hexagon_scene(backgrounds[i], additions[j], diffusions[k], 16);
            assert_stays_symmetric(&disc, 200);
            assert_stays_symmetric(&hexagon, 200);
        }
    }
}

static void symmetric_noise_stays_symmetric(void **state)
{
    (void)state;
    static const double diffusions[] = {0.5, 1, 2.003, 2.6};
    for (size_t i = 0; i < COUNT_OF(diffusions); i++) {
        snow_reiter_params params = disc_scene(0.4, 0.01, diffusions[i], 40);
        params.noise = 0.35;
        params.noise_symmetric = 1;
        params.random_seed = i;
        assert_stays_symmetric(&params, 200);
    }
}

static void seeds_in_a_ring_grow_symmetrically(void **state)
{
    (void)state;
    snow_cell ring[12];
    snow_cell cell = {5, 2};
    for (size_t i = 0; i < 6; i++) {
        ring[i] = cell;
        ring[i + 6] = mirrored(cell);
        cell = turned(cell);
    }
    snow_reiter_params params = disc_scene(0.5, 0.003, 1, 40);
    params.seeds = ring;
    params.seed_count = COUNT_OF(ring);
    assert_stays_symmetric(&params, 200);
}

/* A rectangle is not symmetric, but news of its sides has not reached the crystal yet. */
static void a_rectangle_is_symmetric_while_its_sides_are_out_of_sight(void **state)
{
    (void)state;
    snow_reiter_params params = rectangle_scene(0.4, 0.01, 1, 61, 67);
    assert_stays_symmetric(&params, 25);
}

static double six_sectors(void *context, int32_t q, int32_t r)
{
    (void)context;
    int32_t s = -q - r;
    return 0.3 + (double)(q * q + r * r + s * s) / 65536 + (double)(abs(q) * abs(r) * abs(s)) / 1048576;
}

static void symmetric_fields_stay_symmetric(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 30);
    params.background_at = six_sectors;
    params.addition_at = six_sectors;
    assert_stays_symmetric(&params, 100);
}

static void noise_breaks_symmetry(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 25);
    params.noise = 0.1;
    snow_grid *grid = make_grid(&params, NULL);
    for (int part = 0; part < 4; part++) {
        double defect = defect_of(grid);
        assert_true(defect > 0);
        assert_same_double(defect_by_hand(grid), defect);
        assert_ok(snow_step(grid, 15));
    }
    snow_destroy(grid);
}

static void a_seed_off_the_axes_breaks_symmetry(void **state)
{
    (void)state;
    static const snow_cell seeds[] = {{0, 0}, {7, 3}};
    snow_reiter_params params = hexagon_scene(0.4, 0.01, 1, 18);
    params.seeds = seeds;
    params.seed_count = COUNT_OF(seeds);
    snow_grid *grid = make_grid(&params, NULL);
    assert_near(0.6, defect_of(grid), 1e-15);
    assert_ok(snow_step(grid, 60));
    assert_same_double(defect_by_hand(grid), defect_of(grid));
    assert_true(defect_of(grid) > 0);
    snow_destroy(grid);
}

static void one_cell_that_differs_by_a_quantum_is_seen(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 12);
    snow_grid *grid = make_grid(&params, NULL);
    assert_ok(snow_step(grid, 20));
    double value = value_at(grid, SNOW_FIELD_VAPOUR, 9, -4);
    assert_true(value > 0);
    set_cell(grid, SNOW_FIELD_VAPOUR, 9, -4, value + 0x1p-51);
    assert_same_double(0x1p-51, defect_of(grid));
    snow_destroy(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_seed_grows_symmetrically),
        cmocka_unit_test(symmetric_noise_stays_symmetric),
        cmocka_unit_test(seeds_in_a_ring_grow_symmetrically),
        cmocka_unit_test(a_rectangle_is_symmetric_while_its_sides_are_out_of_sight),
        cmocka_unit_test(symmetric_fields_stay_symmetric),
        cmocka_unit_test(noise_breaks_symmetry),
        cmocka_unit_test(a_seed_off_the_axes_breaks_symmetry),
        cmocka_unit_test(one_cell_that_differs_by_a_quantum_is_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
