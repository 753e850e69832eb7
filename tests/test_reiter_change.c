/* Conditions that change as the crystal grows (paper, section 4 and fig. 7). */
#include "support/grids.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

static snow_reiter_conditions conditions_of(const snow_grid *grid)
{
    snow_reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    assert_ok(snow_reiter_conditions_of(grid, &conditions));
    return conditions;
}

static void change(snow_grid *grid, double background, double addition, int32_t rescale)
{
    snow_reiter_conditions conditions = conditions_of(grid);
    conditions.background = background;
    conditions.addition = addition;
    conditions.rescale = rescale;
    assert_ok(snow_reiter_change(grid, &conditions));
    conditions = conditions_of(grid);
    assert_same_double(background, conditions.background);
    assert_same_double(addition, conditions.addition);
}

/* Fig. 7: a plate that grows branches, and a dendrite that grows plates. */
static void figure_7_is_the_same_on_all_engines(void **state)
{
    (void)state;
    static const struct {
        double first_background, first_addition, second_background, second_addition;
        int64_t first, second;
    } figures[] = {
        {0.4, 0.5, 0.4, 0.001, 10, 250},
        {0.35, 0.0001, 0.9, 0.08, 400, 40},
        {0.9, 0.08, 0.35, 0.0001, 15, 300},
    };
    snow_isa isas[8];
    size_t isa_count = available_isas(isas);
    for (size_t i = 0; i < COUNT_OF(figures); i++) {
        snow_reiter_params params = disc_scene(figures[i].first_background, figures[i].first_addition, 1, 35);
        params.record_freeze_steps = 1;
        params.engine = SNOW_REITER_ENGINE_REFERENCE;
        snow_grid *reference = make_grid(&params, NULL);
        assert_ok(snow_step(reference, figures[i].first));
        uint64_t frozen = frozen_of(reference);
        assert_true(frozen > 1);
        change(reference, figures[i].second_background, figures[i].second_addition, 1);
        assert_int_equal(frozen, frozen_of(reference));
        assert_ok(snow_step(reference, figures[i].second));
        assert_true(frozen_of(reference) > frozen);
        assert_same_double(0.0, defect_of(reference));

        for (size_t k = 0; k < isa_count; k++) {
            params.engine = SNOW_REITER_ENGINE_ROWS;
            snow_options options = default_options();
            options.isa = isas[k];
            options.threads = (int32_t)k + 1;
            snow_grid *rows = make_grid(&params, &options);
            assert_ok(snow_step(rows, figures[i].first));
            change(rows, figures[i].second_background, figures[i].second_addition, 1);
            assert_ok(snow_step(rows, figures[i].second));
            assert_same_grids(reference, rows);
            snow_destroy(rows);
        }

        params.engine = SNOW_REITER_ENGINE_QUAD;
        snow_grid *quad = make_grid(&params, NULL);
        assert_ok(snow_step(quad, figures[i].first));
        change(quad, figures[i].second_background, figures[i].second_addition, 1);
        assert_ok(snow_step(quad, figures[i].second));
        assert_same_ice(quad, reference);
        snow_destroy(quad);
        snow_destroy(reference);
    }
}

static void rescaling_is_proportional(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.25, 0.01, 1, 20);
    snow_grid *grid = make_grid(&params, NULL);
    assert_ok(snow_step(grid, 100));
    size_t count;
    double *inside = copy_field(grid, SNOW_FIELD_INSIDE, NULL, &count);
    double *receptive = copy_field(grid, SNOW_FIELD_RECEPTIVE, NULL, NULL);
    double *before = copy_field(grid, SNOW_FIELD_VALUE, NULL, NULL);
    static const double targets[] = {0.5, 0.125, 0.75, 0.01, 0.99};
    double background = 0.25;
    for (size_t i = 0; i < COUNT_OF(targets); i++) {
        change(grid, targets[i], 0.01, 1);
        double factor = targets[i] / background;
        background = targets[i];
        double *after = copy_field(grid, SNOW_FIELD_VALUE, NULL, NULL);
        for (size_t k = 0; k < count; k++) {
            if (receptive[k] == 1)
                assert_same_double(before[k], after[k]);
            else if (inside[k] == 1)
                assert_near(before[k] * factor, after[k], 0x1p-51);
        }
        free(before);
        before = after;
        /* From 0.01 to 0.99 the rounding of 0.01 is multiplied as well. */
        assert_near(targets[i], value_at(grid, SNOW_FIELD_VALUE, 20, 0), 100 * 0x1p-51);
        assert_near(targets[i], value_at(grid, SNOW_FIELD_BACKGROUND, 20, 0), 100 * 0x1p-51);
        assert_same_double(targets[i], value_at(grid, SNOW_FIELD_BACKGROUND, 0, 0));
    }
    free(inside);
    free(receptive);
    free(before);
    snow_destroy(grid);
}

static void without_rescaling_only_the_fixed_cells_change(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.25, 0.01, 1, 20);
    snow_grid *grid = make_grid(&params, NULL);
    assert_ok(snow_step(grid, 60));
    snow_rect rect = bounds_of(grid);
    size_t count;
    double *inside = copy_field(grid, SNOW_FIELD_INSIDE, &rect, &count);
    double *before = copy_field(grid, SNOW_FIELD_VALUE, &rect, NULL);
    change(grid, 0.5, 0.01, 0);
    double *after = copy_field(grid, SNOW_FIELD_VALUE, &rect, NULL);
    for (size_t k = 0; k < count; k++) {
        if (inside[k] == 1)
            assert_near(before[k], after[k], 0x1p-51);
        else
            assert_same_double(0.5, after[k]);
    }
    assert_same_double(0.5, value_at(grid, SNOW_FIELD_VALUE, 20, 0));
    free(inside);
    free(before);
    free(after);
    snow_destroy(grid);
}

static void a_background_can_leave_and_reach_zero(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.25, 0.01, 1, 10);
    snow_grid *grid = make_grid(&params, NULL);
    assert_ok(snow_step(grid, 20));
    change(grid, 0, 0.01, 1);
    assert_same_double(0.0, value_at(grid, SNOW_FIELD_VALUE, 8, 0));
    assert_same_double(0.0, value_at(grid, SNOW_FIELD_VALUE, 10, 0));
    uint64_t digest = digest_of(grid);

    snow_reiter_conditions conditions = conditions_of(grid);
    conditions.background = 0.5;
    conditions.rescale = 1;
    assert_status(SNOW_ERROR_REITER_RESCALE, snow_reiter_change(grid, &conditions));
    assert_true(digest == digest_of(grid));
    assert_same_double(0.0, conditions_of(grid).background);

    change(grid, 0.5, 0.01, 0);
    assert_same_double(0.0, value_at(grid, SNOW_FIELD_VALUE, 8, 0));
    assert_same_double(0.5, value_at(grid, SNOW_FIELD_VALUE, 10, 0));
    assert_ok(snow_step(grid, 1));
    /* One of its neighbours is fixed. */
    assert_near(0.5 / 12, value_at(grid, SNOW_FIELD_VALUE, 9, 0), 0x1p-51);
    snow_destroy(grid);
}

static void a_new_addition_counts_from_now_on(void **state)
{
    (void)state;
    static const snow_reiter_engine engines[] = {SNOW_REITER_ENGINE_ROWS, SNOW_REITER_ENGINE_REFERENCE,
                                                 SNOW_REITER_ENGINE_QUAD};
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_reiter_params params = disc_scene(0, 0.125, 1, 10);
        params.engine = engines[i];
        snow_grid *grid = make_grid(&params, NULL);
        assert_ok(snow_step(grid, 4));
        assert_same_double(1.5, value_at(grid, SNOW_FIELD_VALUE, 0, 0));
        uint64_t digest = digest_of(grid);
        change(grid, 0, 0.25, 1);
        assert_true(digest == digest_of(grid));
        assert_ok(snow_step(grid, 1));
        assert_same_double(1.75, value_at(grid, SNOW_FIELD_VALUE, 0, 0));
        assert_same_double(0.75, value_at(grid, SNOW_FIELD_VALUE, 1, 0));
        assert_int_equal(1, frozen_of(grid));
        assert_ok(snow_step(grid, 1));
        assert_int_equal(7, frozen_of(grid));
        snow_destroy(grid);
    }
}

static double uneven(void *context, int32_t q, int32_t r)
{
    (void)context;
    return ((q + 2 * r) & 3) / 64.0;
}

static void additions_of_cells_stay_until_a_new_one_comes(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.25, 0.01, 1, 10);
    params.addition_at = uneven;
    snow_grid *grid = make_grid(&params, NULL);
    assert_ok(snow_step(grid, 10));
    change(grid, 0.5, 0.01, 1);
    for (int32_t q = -5; q <= 5; q++)
        assert_same_double(uneven(NULL, q, 1), value_at(grid, SNOW_FIELD_ADDITION, q, 1));
    change(grid, 0.5, 0.03125, 1);
    for (int32_t q = -5; q <= 5; q++)
        assert_same_double(0.03125, value_at(grid, SNOW_FIELD_ADDITION, q, 1));
    double before = value_at(grid, SNOW_FIELD_VALUE, 0, 0);
    assert_ok(snow_step(grid, 2));
    assert_near(before + 0.0625, value_at(grid, SNOW_FIELD_VALUE, 0, 0), 1e-15);
    snow_destroy(grid);
}

static void changing_nothing_changes_nothing(void **state)
{
    (void)state;
    static const snow_reiter_engine engines[] = {SNOW_REITER_ENGINE_ROWS, SNOW_REITER_ENGINE_REFERENCE,
                                                 SNOW_REITER_ENGINE_QUAD};
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_reiter_params params = disc_scene(0.4, 0.01, 1, 20);
        params.engine = engines[i];
        snow_grid *plain = make_grid(&params, NULL);
        snow_grid *grid = make_grid(&params, NULL);
        for (int round = 0; round < 4; round++) {
            snow_reiter_conditions same = conditions_of(grid);
            same.rescale = round % 2;
            assert_ok(snow_reiter_change(grid, &same));
            assert_ok(snow_step(plain, 25));
            assert_ok(snow_step(grid, 25));
            assert_same_grids(plain, grid);
        }
        snow_destroy(plain);
        snow_destroy(grid);
    }
}

static void diffusion_can_change(void **state)
{
    (void)state;
    static const double sequence[] = {0.5, 2.6, 1, 0, 2.003, 2};
    snow_reiter_params params = disc_scene(0.4, 0.005, 1, 25);
    params.engine = SNOW_REITER_ENGINE_REFERENCE;
    snow_grid *reference = make_grid(&params, NULL);
    params.engine = SNOW_REITER_ENGINE_ROWS;
    snow_grid *rows = make_grid(&params, NULL);
    for (size_t i = 0; i < COUNT_OF(sequence); i++) {
        snow_reiter_conditions conditions = conditions_of(rows);
        conditions.diffusion = sequence[i];
        assert_ok(snow_reiter_change(reference, &conditions));
        assert_ok(snow_reiter_change(rows, &conditions));
        assert_same_double(sequence[i], conditions_of(rows).diffusion);
        assert_ok(snow_step(reference, 15));
        assert_ok(snow_step(rows, 15));
        assert_same_grids(reference, rows);
        assert_same_double(0.0, defect_of(rows));
    }
    snow_destroy(reference);
    snow_destroy(rows);
}

/* A background far above the old one, and an addition with it: no sum is kept in the old, much finer quantum. */
static void from_hardly_any_vapour_to_almost_ice(void **state)
{
    (void)state;
    static const snow_reiter_precision precisions[] = {SNOW_REITER_PRECISION_DOUBLE, SNOW_REITER_PRECISION_SINGLE};
    for (size_t i = 0; i < COUNT_OF(precisions); i++) {
        snow_reiter_params params = disc_scene(9e-9, 0.0063, 1, 12);
        params.precision = precisions[i];
        params.symmetry = SNOW_REITER_SYMMETRY_NONE;
        snow_grid *rows = make_grid(&params, NULL);
        params.engine = SNOW_REITER_ENGINE_REFERENCE;
        snow_grid *reference = make_grid(&params, NULL);
        assert_ok(snow_step(rows, 47));
        assert_ok(snow_step(reference, 47));
        change(rows, 0.99, 0.046, 0);
        change(reference, 0.99, 0.046, 0);
        assert_same_grids(reference, rows);
        assert_near(0.99, value_at(rows, SNOW_FIELD_VALUE, 100, 100), 0x1p-28);
        assert_ok(snow_step(rows, 20));
        assert_ok(snow_step(reference, 20));
        assert_same_grids(reference, rows);
        snow_destroy(rows);
        snow_destroy(reference);
    }
}

static void a_grid_that_stood_still_can_be_woken(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0, 0, 1, 10);
    snow_grid *grid = make_grid(&params, NULL);
    assert_int_equal(SNOW_STOP_STILL, run_grid(grid, NULL).reason);
    change(grid, 0, 0.5, 1);
    assert_int_equal(SNOW_STOP_RIM, run_grid(grid, NULL).reason);
    assert_int_equal(1 + 8 * 2, steps_of(grid));
    snow_destroy(grid);
}

/* A call that fails leaves every bit and the conditions as they were. */
static void assert_refused(snow_grid *grid, snow_status expected, const snow_reiter_conditions *conditions)
{
    uint64_t digest = digest_of(grid);
    snow_reiter_conditions before = conditions_of(grid);
    assert_status(expected, snow_reiter_change(grid, conditions));
    snow_reiter_conditions after = conditions_of(grid);
    assert_same_double(before.background, after.background);
    assert_same_double(before.addition, after.addition);
    assert_same_double(before.diffusion, after.diffusion);
    assert_true(digest == digest_of(grid));
}

static void conditions_out_of_range_are_refused(void **state)
{
    (void)state;
    const struct {
        size_t offset;
        double number;
        snow_status status;
    } cases[] = {
        {offsetof(snow_reiter_conditions, background), NAN, SNOW_ERROR_NOT_FINITE},
        {offsetof(snow_reiter_conditions, background), INFINITY, SNOW_ERROR_NOT_FINITE},
        {offsetof(snow_reiter_conditions, background), -0.1, SNOW_ERROR_REITER_BACKGROUND},
        {offsetof(snow_reiter_conditions, background), 1, SNOW_ERROR_REITER_BACKGROUND},
        {offsetof(snow_reiter_conditions, addition), NAN, SNOW_ERROR_NOT_FINITE},
        {offsetof(snow_reiter_conditions, addition), -INFINITY, SNOW_ERROR_NOT_FINITE},
        {offsetof(snow_reiter_conditions, addition), -0.1, SNOW_ERROR_REITER_ADDITION},
        {offsetof(snow_reiter_conditions, addition), 1.1, SNOW_ERROR_REITER_ADDITION},
        {offsetof(snow_reiter_conditions, diffusion), NAN, SNOW_ERROR_NOT_FINITE},
        {offsetof(snow_reiter_conditions, diffusion), -0.1, SNOW_ERROR_REITER_DIFFUSION},
        {offsetof(snow_reiter_conditions, diffusion), 2.7, SNOW_ERROR_REITER_DIFFUSION},
    };
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 12);
    snow_grid *grid = make_grid(&params, NULL);
    snow_grid *plain = make_grid(&params, NULL);
    assert_ok(snow_step(grid, 20));
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        /* The other two are new and in range: they must not slip in. */
        snow_reiter_conditions conditions = conditions_of(grid);
        conditions.background = 0.5;
        conditions.addition = 0.5;
        conditions.diffusion = 0.5;
        *(double *)(void *)((char *)&conditions + cases[i].offset) = cases[i].number;
        assert_refused(grid, cases[i].status, &conditions);
    }
    static const int32_t flags[] = {-1, 2, INT32_MAX, INT32_MIN};
    for (size_t i = 0; i < COUNT_OF(flags); i++) {
        snow_reiter_conditions conditions = conditions_of(grid);
        conditions.rescale = flags[i];
        assert_refused(grid, SNOW_ERROR_RANGE, &conditions);
    }
    assert_ok(snow_step(plain, 50));
    assert_ok(snow_step(grid, 30));
    assert_same_grids(plain, grid);
    snow_destroy(plain);
    snow_destroy(grid);
}

static void vapour_that_would_reach_1_is_refused(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 12);
    params.noise = 0.2;
    snow_grid *grid = make_grid(&params, NULL);
    assert_ok(snow_step(grid, 1));
    snow_reiter_conditions conditions = conditions_of(grid);
    conditions.background = 0.99;
    conditions.addition = 0.5;
    assert_refused(grid, SNOW_ERROR_REITER_VAPOUR, &conditions);
    conditions.background = 1e-300;
    assert_ok(snow_reiter_change(grid, &conditions));
    conditions.background = 0.9;
    assert_ok(snow_reiter_change(grid, &conditions));
    assert_ok(snow_step(grid, 5));
    size_t count;
    double *values = copy_field(grid, SNOW_FIELD_VALUE, NULL, &count);
    for (size_t i = 0; i < count; i++)
        assert_true(isfinite(values[i]));
    free(values);
    snow_destroy(grid);

    /* A factor that overflows. */
    params = disc_scene(0x1p-1074, 0.01, 1, 12);
    grid = make_grid(&params, NULL);
    conditions = conditions_of(grid);
    conditions.background = 0.5;
    assert_refused(grid, SNOW_ERROR_REITER_VAPOUR, &conditions);
    snow_destroy(grid);
}

static void beyond_the_stable_range_only_where_it_was_allowed(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 12);
    params.allow_unstable = 1;
    snow_grid *grid = make_grid(&params, NULL);
    snow_reiter_conditions conditions = conditions_of(grid);
    conditions.diffusion = 4;
    assert_ok(snow_reiter_change(grid, &conditions));
    conditions.diffusion = nextafter(4, 5);
    assert_refused(grid, SNOW_ERROR_REITER_DIFFUSION, &conditions);
    snow_destroy(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figure_7_is_the_same_on_all_engines),
        cmocka_unit_test(rescaling_is_proportional),
        cmocka_unit_test(without_rescaling_only_the_fixed_cells_change),
        cmocka_unit_test(a_background_can_leave_and_reach_zero),
        cmocka_unit_test(a_new_addition_counts_from_now_on),
        cmocka_unit_test(additions_of_cells_stay_until_a_new_one_comes),
        cmocka_unit_test(changing_nothing_changes_nothing),
        cmocka_unit_test(diffusion_can_change),
        cmocka_unit_test(from_hardly_any_vapour_to_almost_ice),
        cmocka_unit_test(a_grid_that_stood_still_can_be_woken),
        cmocka_unit_test(conditions_out_of_range_are_refused),
        cmocka_unit_test(vapour_that_would_reach_1_is_refused),
        cmocka_unit_test(beyond_the_stable_range_only_where_it_was_allowed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
