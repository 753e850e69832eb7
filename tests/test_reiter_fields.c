/* Fields that a caller sets, by callbacks when the grid is made and by rectangles later. */
#include "support/grids.h"

#include <math.h>
#include <stdlib.h>

static snow_grid *grown(void)
{
    snow_reiter_params params = disc_scene(0.4, 0.02, 1, 15);
    params.record_freeze_steps = 1;
    snow_grid *grid = make_grid(&params, NULL);
    assert_ok(snow_step(grid, 40));
    return grid;
}

static void what_was_copied_can_be_set_again(void **state)
{
    (void)state;
    static const snow_field fields[] = {SNOW_FIELD_VALUE, SNOW_FIELD_VAPOUR, SNOW_FIELD_ADDITION,
                                        SNOW_FIELD_BACKGROUND};
    for (size_t i = 0; i < COUNT_OF(fields); i++) {
        snow_grid *untouched = grown();
        snow_grid *grid = grown();
        snow_rect rect = widened(bounds_of(grid));
        size_t count;
        double *values = copy_field(grid, fields[i], &rect, &count);
        assert_ok(snow_field_set(grid, fields[i], &rect, values, count));
        assert_same_grids(untouched, grid);
        /* Values of receptive cells are set whole, which may move later roundings; the others change nothing. */
        assert_ok(snow_step(untouched, 30));
        assert_ok(snow_step(grid, 30));
        if (fields[i] == SNOW_FIELD_VAPOUR || fields[i] == SNOW_FIELD_BACKGROUND)
            assert_same_grids(untouched, grid);
        assert_same_ice(untouched, grid);
        free(values);
        snow_destroy(untouched);
        snow_destroy(grid);
    }
}

static void values_are_set_in_row_order(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.25, 0, 1, 20);
    without_seeds(&params);
    snow_grid *grid = make_grid(&params, NULL);
    snow_rect rect = {-3, 2, 5, 4};
    double values[20];
    for (size_t i = 0; i < COUNT_OF(values); i++)
        values[i] = (double)(i + 1) / 64;
    assert_ok(snow_field_set(grid, SNOW_FIELD_VALUE, &rect, values, COUNT_OF(values)));
    for (int32_t j = 0; j < rect.height; j++)
        for (int32_t i = 0; i < rect.width; i++)
            assert_same_double(values[j * rect.width + i], value_at(grid, SNOW_FIELD_VALUE, rect.q + i, rect.r + j));
    assert_same_double(0.25, value_at(grid, SNOW_FIELD_VALUE, -4, 2));
    assert_same_double(0.25, value_at(grid, SNOW_FIELD_VALUE, 2, 2));
    assert_same_double(0.25, value_at(grid, SNOW_FIELD_VALUE, -3, 1));
    assert_same_double(0.25, value_at(grid, SNOW_FIELD_VALUE, -3, 6));
    snow_destroy(grid);
}

static void vapour_is_rounded_to_the_quantum(void **state)
{
    (void)state;
    static const double numbers[] = {0.1, 0.3, 1.0 / 3, 0.4, 1e-3, 1e-9, 0x1p-51, 0x1p-60, 0x1p-1074, 0, 0.49999999};
    for (size_t i = 0; i < COUNT_OF(numbers); i++) {
        snow_grid *grid = grown();
        set_cell(grid, SNOW_FIELD_VAPOUR, 10, -2, numbers[i]);
        double got = value_at(grid, SNOW_FIELD_VAPOUR, 10, -2);
        /* The greatest value lies in (1/4, 1/2], so that the quantum is 2^-51. */
        assert_near(numbers[i], got, 0x1p-52);
        assert_same_double(got, floor(got * 0x1p51) * 0x1p-51);
        snow_destroy(grid);
    }
}

static void cells_freeze_and_melt_through_their_value(void **state)
{
    (void)state;
    snow_grid *grid = grown();
    uint64_t frozen = frozen_of(grid);
    assert_same_double(0.0, value_at(grid, SNOW_FIELD_RECEPTIVE, 11, 0));

    set_cell(grid, SNOW_FIELD_VALUE, 12, 0, 1.75);
    assert_int_equal(frozen + 1, frozen_of(grid));
    assert_same_double(1.75, value_at(grid, SNOW_FIELD_VALUE, 12, 0));
    assert_same_double(1.0, value_at(grid, SNOW_FIELD_FROZEN, 12, 0));
    assert_same_double(40.0, value_at(grid, SNOW_FIELD_FREEZE_STEP, 12, 0));
    assert_same_double(12.0, tip_of(grid));
    snow_rect bounds;
    assert_ok(snow_frozen_bounds(grid, &bounds));
    assert_int_equal(13, bounds.q + bounds.width);
    double before = value_at(grid, SNOW_FIELD_VALUE, 11, 0);
    assert_same_double(1.0, value_at(grid, SNOW_FIELD_RECEPTIVE, 11, 0));
    assert_same_double(0.0, value_at(grid, SNOW_FIELD_VAPOUR, 11, 0));
    assert_ok(snow_step(grid, 1));
    assert_near(1.77, value_at(grid, SNOW_FIELD_VALUE, 12, 0), 1e-15);
    assert_true(value_at(grid, SNOW_FIELD_VALUE, 11, 0) > before + 0.02);

    set_cell(grid, SNOW_FIELD_VALUE, 12, 0, 0.25);
    assert_int_equal(frozen, frozen_of(grid));
    assert_same_double(0.25, value_at(grid, SNOW_FIELD_VAPOUR, 12, 0));
    assert_same_double(-1.0, value_at(grid, SNOW_FIELD_FREEZE_STEP, 12, 0));
    assert_same_double(0.0, value_at(grid, SNOW_FIELD_RECEPTIVE, 11, 0));
    assert_true(tip_of(grid) < 12);

    /* The first seed, and all ice. */
    set_cell(grid, SNOW_FIELD_VALUE, 0, 0, 0.5);
    assert_int_equal(frozen - 1, frozen_of(grid));
    assert_same_double(1.0, value_at(grid, SNOW_FIELD_RECEPTIVE, 0, 0));
    assert_same_double(0.5, value_at(grid, SNOW_FIELD_VALUE, 0, 0));
    size_t count;
    double *values = copy_field(grid, SNOW_FIELD_VALUE, NULL, &count);
    for (size_t i = 0; i < count; i++)
        values[i] = 0.125;
    assert_ok(snow_field_set(grid, SNOW_FIELD_VALUE, NULL, values, count));
    free(values);
    assert_int_equal(0, frozen_of(grid));
    assert_same_double(0.0, tip_of(grid));
    assert_same_double(0.0, defect_of(grid));
    assert_ok(snow_step(grid, 10));
    assert_int_equal(0, frozen_of(grid));
    snow_destroy(grid);
}

static void ice_at_the_rim_ends_a_run_also_when_it_was_set(void **state)
{
    (void)state;
    snow_grid *grid = grown();
    set_cell(grid, SNOW_FIELD_VALUE, 14, 0, 1);
    assert_int_equal(SNOW_STOP_RIM, run_grid(grid, NULL).reason);
    assert_int_equal(40, steps_of(grid));
    set_cell(grid, SNOW_FIELD_VALUE, 14, 0, 0);
    snow_stop stop = default_stop();
    stop.max_steps = 41;
    assert_int_equal(SNOW_STOP_STEPS, run_grid(grid, &stop).reason);
    snow_destroy(grid);
}

static void vapour_is_set_only_where_it_is_free(void **state)
{
    (void)state;
    snow_grid *grid = grown();
    snow_rect rect = widened(bounds_of(grid));
    size_t count;
    double *receptive = copy_field(grid, SNOW_FIELD_RECEPTIVE, &rect, &count);
    double *inside = copy_field(grid, SNOW_FIELD_INSIDE, &rect, NULL);
    double *before = copy_field(grid, SNOW_FIELD_VALUE, &rect, NULL);
    double *values = copy_field(grid, SNOW_FIELD_VALUE, &rect, NULL);
    for (size_t i = 0; i < count; i++)
        values[i] = 0.375;
    assert_ok(snow_field_set(grid, SNOW_FIELD_VAPOUR, &rect, values, count));
    free(values);
    values = copy_field(grid, SNOW_FIELD_VALUE, &rect, NULL);
    for (size_t i = 0; i < count; i++)
        assert_same_double(inside[i] == 1 && receptive[i] == 0 ? 0.375 : before[i], values[i]);
    free(receptive);
    free(inside);
    free(before);
    free(values);
    snow_destroy(grid);
}

static void additions_are_set_cell_by_cell(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0, 0, 1, 8);
    params.record_freeze_steps = 1;
    snow_grid *grid = make_grid(&params, NULL);
    set_cell(grid, SNOW_FIELD_ADDITION, 1, 0, 0.5);
    set_cell(grid, SNOW_FIELD_ADDITION, 2, 0, 0.25);
    set_cell(grid, SNOW_FIELD_ADDITION, 0, 1, 0.125);
    assert_same_double(0.5, value_at(grid, SNOW_FIELD_ADDITION, 1, 0));
    assert_same_double(0.0, value_at(grid, SNOW_FIELD_ADDITION, -1, 0));
    assert_ok(snow_step(grid, 20));
    assert_int_equal(4, frozen_of(grid));
    assert_same_double(2.0, value_at(grid, SNOW_FIELD_FREEZE_STEP, 1, 0));
    assert_same_double(6.0, value_at(grid, SNOW_FIELD_FREEZE_STEP, 2, 0));
    assert_same_double(8.0, value_at(grid, SNOW_FIELD_FREEZE_STEP, 0, 1));
    assert_same_double(10.0, value_at(grid, SNOW_FIELD_VALUE, 1, 0));
    assert_same_double(1.0, value_at(grid, SNOW_FIELD_VALUE, 0, 0));
    snow_destroy(grid);
}

static void a_new_addition_does_not_change_what_was_gained(void **state)
{
    (void)state;
    snow_grid *grid = grown();
    double ice = value_at(grid, SNOW_FIELD_VALUE, 0, 0);
    uint64_t digest = digest_of(grid);
    set_cell(grid, SNOW_FIELD_ADDITION, 0, 0, 0.5);
    assert_true(digest == digest_of(grid));
    assert_ok(snow_step(grid, 4));
    assert_near(ice + 2, value_at(grid, SNOW_FIELD_VALUE, 0, 0), 1e-15);
    assert_near(1.8 + 2, value_at(grid, SNOW_FIELD_VALUE, 0, 0), 1e-14);
    snow_destroy(grid);
}

static void the_background_of_fixed_cells_can_be_set(void **state)
{
    (void)state;
    snow_grid *grid = grown();
    uint64_t digest = digest_of(grid);
    set_cell(grid, SNOW_FIELD_BACKGROUND, 15, 0, 0.75);
    assert_same_double(0.75, value_at(grid, SNOW_FIELD_BACKGROUND, 15, 0));
    assert_same_double(0.75, value_at(grid, SNOW_FIELD_VALUE, 15, 0));
    assert_same_double(0.75, value_at(grid, SNOW_FIELD_VAPOUR, 15, 0));
    /* Inside, and far outside, nothing is set. */
    set_cell(grid, SNOW_FIELD_BACKGROUND, 14, 0, 0.625);
    set_cell(grid, SNOW_FIELD_BACKGROUND, 40, 0, 0.625);
    assert_same_double(0.4, value_at(grid, SNOW_FIELD_BACKGROUND, 14, 0));
    assert_near(0.4, value_at(grid, SNOW_FIELD_BACKGROUND, 40, 0), 0x1p-51);
    double before = value_at(grid, SNOW_FIELD_VAPOUR, 14, 0);
    snow_grid *plain = grown();
    assert_true(digest == digest_of(plain));
    assert_ok(snow_step(plain, 1));
    assert_ok(snow_step(grid, 1));
    assert_true(before > 0);
    assert_near(value_at(plain, SNOW_FIELD_VAPOUR, 14, 0) + 0.35 / 12, value_at(grid, SNOW_FIELD_VAPOUR, 14, 0),
                1e-15);
    assert_same_double(0.75, value_at(grid, SNOW_FIELD_BACKGROUND, 15, 0));
    snow_destroy(plain);
    snow_destroy(grid);
}

static double slope(void *context, int32_t q, int32_t r)
{
    (void)context;
    return 0.25 + (q + 2 * r) / 256.0;
}

static double patches(void *context, int32_t q, int32_t r)
{
    (void)context;
    return ((q ^ r) & 7) / 256.0;
}

static double *sampled(snow_rect rect, snow_reiter_field field)
{
    double *values = malloc((size_t)rect.width * (size_t)rect.height * sizeof *values);
    assert_non_null(values);
    for (int32_t j = 0; j < rect.height; j++)
        for (int32_t i = 0; i < rect.width; i++)
            values[(size_t)j * (size_t)rect.width + (size_t)i] = field(NULL, rect.q + i, rect.r + j);
    return values;
}

static void callbacks_and_rectangles_make_the_same_grid(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.3, 0.01, 1, 16);
    params.background_at = slope;
    params.addition_at = patches;
    snow_grid *called = make_grid(&params, NULL);

    params.background_at = NULL;
    params.addition_at = NULL;
    without_seeds(&params);
    snow_grid *set = make_grid(&params, NULL);
    snow_rect rect = widened(bounds_of(set));
    size_t count = (size_t)rect.width * (size_t)rect.height;
    double *background = sampled(rect, slope);
    double *addition = sampled(rect, patches);
    assert_ok(snow_field_set(set, SNOW_FIELD_VALUE, &rect, background, count));
    assert_ok(snow_field_set(set, SNOW_FIELD_BACKGROUND, &rect, background, count));
    assert_ok(snow_field_set(set, SNOW_FIELD_ADDITION, &rect, addition, count));
    set_cell(set, SNOW_FIELD_VALUE, 0, 0, 1);
    free(background);
    free(addition);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(frozen_of(called), frozen_of(set));
        assert_true(digest_of(called) == digest_of(set));
        assert_ok(snow_step(called, 30));
        assert_ok(snow_step(set, 30));
    }
    assert_true(frozen_of(called) > 20);
    assert_same_double(slope(NULL, 16, 0), value_at(called, SNOW_FIELD_BACKGROUND, 16, 0));
    assert_same_double(slope(NULL, -16, 16), value_at(set, SNOW_FIELD_BACKGROUND, -16, 16));
    assert_same_double(patches(NULL, 5, 3), value_at(called, SNOW_FIELD_ADDITION, 5, 3));
    assert_same_double(patches(NULL, 5, 3), value_at(set, SNOW_FIELD_ADDITION, 5, 3));
    snow_destroy(called);
    snow_destroy(set);
}

static void fields_that_cannot_be_set_are_refused(void **state)
{
    (void)state;
    static const snow_field fields[] = {SNOW_FIELD_FROZEN, SNOW_FIELD_RECEPTIVE, SNOW_FIELD_INSIDE,
                                        SNOW_FIELD_FREEZE_STEP};
    snow_grid *grid = grown();
    uint64_t digest = digest_of(grid);
    for (size_t i = 0; i < COUNT_OF(fields); i++) {
        double value = 1;
        assert_status(SNOW_ERROR_UNSUPPORTED,
                      snow_field_set(grid, fields[i], &(snow_rect){0, 0, 1, 1}, &value, 1));
    }
    assert_true(digest == digest_of(grid));
    snow_destroy(grid);
}

static void counts_must_be_those_of_the_rectangle(void **state)
{
    (void)state;
    static const size_t counts[] = {0, 1, 19, 21, 400, SIZE_MAX};
    snow_grid *grid = grown();
    uint64_t digest = digest_of(grid);
    double values[20] = {0};
    for (size_t i = 0; i < COUNT_OF(counts); i++)
        assert_status(SNOW_ERROR_BUFFER,
                      snow_field_set(grid, SNOW_FIELD_VALUE, &(snow_rect){0, 0, 5, 4}, values, counts[i]));
    assert_status(SNOW_ERROR_BUFFER, snow_field_set(grid, SNOW_FIELD_VALUE, NULL, values, COUNT_OF(values)));
    assert_ok(snow_field_set(grid, SNOW_FIELD_VALUE, &(snow_rect){0, 0, 0, 4}, values, 0));
    assert_ok(snow_field_set(grid, SNOW_FIELD_VALUE, &(snow_rect){INT32_MAX, INT32_MAX, 1, 1}, values, 1));
    assert_ok(snow_field_set(grid, SNOW_FIELD_VALUE, &(snow_rect){INT32_MIN, INT32_MIN, 5, 4}, values, 20));
    assert_true(digest == digest_of(grid));
    snow_destroy(grid);
}

static void one_bad_number_leaves_everything_as_it_was(void **state)
{
    (void)state;
    const struct {
        snow_field field;
        double number;
        snow_status status;
    } cases[] = {
        {SNOW_FIELD_VALUE, NAN, SNOW_ERROR_NOT_FINITE},
        {SNOW_FIELD_VALUE, INFINITY, SNOW_ERROR_NOT_FINITE},
        {SNOW_FIELD_VALUE, -INFINITY, SNOW_ERROR_NOT_FINITE},
        {SNOW_FIELD_VALUE, -0.5, SNOW_ERROR_REITER_VAPOUR},
        {SNOW_FIELD_VALUE, -0x1p-1074, SNOW_ERROR_REITER_VAPOUR},
        {SNOW_FIELD_VAPOUR, NAN, SNOW_ERROR_NOT_FINITE},
        {SNOW_FIELD_VAPOUR, INFINITY, SNOW_ERROR_NOT_FINITE},
        {SNOW_FIELD_VAPOUR, -0.5, SNOW_ERROR_REITER_VAPOUR},
        {SNOW_FIELD_VAPOUR, 1.0, SNOW_ERROR_REITER_VAPOUR},
        {SNOW_FIELD_VAPOUR, 1e300, SNOW_ERROR_REITER_VAPOUR},
        {SNOW_FIELD_ADDITION, NAN, SNOW_ERROR_NOT_FINITE},
        {SNOW_FIELD_ADDITION, -0.5, SNOW_ERROR_REITER_ADDITION},
        {SNOW_FIELD_ADDITION, 1.5, SNOW_ERROR_REITER_ADDITION},
        {SNOW_FIELD_BACKGROUND, NAN, SNOW_ERROR_NOT_FINITE},
        {SNOW_FIELD_BACKGROUND, -0.5, SNOW_ERROR_REITER_BACKGROUND},
        {SNOW_FIELD_BACKGROUND, 1.0, SNOW_ERROR_REITER_BACKGROUND},
    };
    snow_grid *before = grown();
    snow_grid *grid = grown();
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        snow_rect rect = {9, -4, 7, 5};
        double values[35];
        for (size_t k = 0; k < COUNT_OF(values); k++)
            values[k] = 0.125;
        /* (13, 0) lies inside and is free, (15, 0) is fixed: the last row. */
        size_t last = cases[i].field == SNOW_FIELD_BACKGROUND ? 34 : 32;
        values[last] = cases[i].number;
        assert_status(cases[i].status, snow_field_set(grid, cases[i].field, &rect, values, COUNT_OF(values)));
        assert_same_grids(before, grid);
    }
    /* They go on alike. */
    assert_ok(snow_step(before, 10));
    assert_ok(snow_step(grid, 10));
    assert_same_grids(before, grid);
    snow_destroy(before);
    snow_destroy(grid);
}

static void huge_values_of_ice_stay_finite(void **state)
{
    (void)state;
    snow_grid *grid = grown();
    set_cell(grid, SNOW_FIELD_VALUE, 0, 0, 1e308);
    assert_ok(snow_step(grid, 100));
    assert_same_double(1e308, value_at(grid, SNOW_FIELD_VALUE, 0, 0));
    set_cell(grid, SNOW_FIELD_VALUE, 0, 0, 1);
    assert_ok(snow_step(grid, 1));
    snow_destroy(grid);
}

/* The step in which a cell was first seen frozen, stepping one at a time. */
static void freeze_steps_are_those_of_stepping_one_at_a_time(void **state)
{
    (void)state;
    static const snow_reiter_engine engines[] = {SNOW_REITER_ENGINE_ROWS, SNOW_REITER_ENGINE_REFERENCE,
                                                 SNOW_REITER_ENGINE_QUAD};
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_reiter_params params = disc_scene(0.4, 0.01, 1, 14);
        params.noise = 0.1;
        params.record_freeze_steps = 1;
        params.engine = engines[i];
        snow_grid *grid = make_grid(&params, NULL);
        size_t count;
        double *first = copy_field(grid, SNOW_FIELD_FREEZE_STEP, NULL, &count);
        for (int64_t step = 1; step <= 100; step++) {
            assert_ok(snow_step(grid, 1));
            double *frozen = copy_field(grid, SNOW_FIELD_FROZEN, NULL, NULL);
            for (size_t k = 0; k < count; k++)
                if (frozen[k] == 1 && first[k] < 0)
                    first[k] = (double)step;
            free(frozen);
        }
        double *recorded = copy_field(grid, SNOW_FIELD_FREEZE_STEP, NULL, NULL);
        for (size_t k = 0; k < count; k++)
            assert_same_double(first[k], recorded[k]);
        assert_true(frozen_of(grid) > 50);
        free(first);
        free(recorded);
        snow_destroy(grid);
    }
}

/* One and the same change of both grids, drawn at random. */
static void meddle(snow_grid *left, snow_grid *right, uint64_t *random)
{
    static const snow_field fields[] = {SNOW_FIELD_VALUE, SNOW_FIELD_VAPOUR, SNOW_FIELD_ADDITION,
                                        SNOW_FIELD_BACKGROUND};
    snow_field field = fields[next_below(random, COUNT_OF(fields))];
    snow_rect rect = {(int32_t)next_below(random, 30) - 15, (int32_t)next_below(random, 30) - 15,
                      (int32_t)next_below(random, 8), (int32_t)next_below(random, 8)};
    double values[64];
    size_t count = (size_t)rect.width * (size_t)rect.height;
    for (size_t i = 0; i < count; i++) {
        values[i] = next_below(random, 1000) / 1001.0;
        if (field == SNOW_FIELD_VALUE && next_below(random, 3) == 0)
            values[i] += 0.5;
        if (field == SNOW_FIELD_ADDITION)
            values[i] /= 50;
    }
    assert_ok(snow_field_set(left, field, &rect, values, count));
    assert_ok(snow_field_set(right, field, &rect, values, count));
}

static void change(snow_grid *left, snow_grid *right, uint64_t *random)
{
    snow_reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    assert_ok(snow_reiter_conditions_of(left, &conditions));
    switch (next_below(random, 4)) {
    case 0: conditions.background = next_below(random, 99) / 100.0; break;
    case 1: conditions.addition = next_below(random, 99) / 1000.0; break;
    case 2: conditions.diffusion = next_below(random, 266) / 100.0; break;
    default: break;
    }
    conditions.rescale = (int32_t)next_below(random, 2);
    snow_status expected = snow_reiter_change(left, &conditions);
    assert_status(expected, snow_reiter_change(right, &conditions));
}

static void engines_agree_whatever_is_set_and_changed(void **state)
{
    (void)state;
    snow_isa isas[8];
    size_t isa_count = available_isas(isas);
    uint64_t random = 42;
    for (int scene = 0; scene < 30; scene++) {
        snow_reiter_params params = scene % 3 == 0   ? disc_scene(0.4, 0.01, 1, 13)
                                    : scene % 3 == 1 ? hexagon_scene(0.3, 0.02, 0.7, 11)
                                                     : rectangle_scene(0.5, 0.01, 2.2, 19, 17);
        params.record_freeze_steps = 1;
        params.engine = SNOW_REITER_ENGINE_REFERENCE;
        snow_grid *reference = make_grid(&params, NULL);
        params.engine = SNOW_REITER_ENGINE_ROWS;
        snow_options options = default_options();
        options.isa = isas[(size_t)scene % isa_count];
        options.threads = scene % 4 + 1;
        snow_grid *rows = make_grid(&params, &options);
        for (int round = 0; round < 25; round++) {
            if (next_below(&random, 4) == 0)
                change(reference, rows, &random);
            else
                meddle(reference, rows, &random);
            assert_same_grids(reference, rows);
            int64_t steps = (int64_t)next_below(&random, 9);
            snow_status expected = snow_step(reference, steps);
            assert_status(expected, snow_step(rows, steps));
            assert_same_grids(reference, rows);
        }
        snow_destroy(reference);
        snow_destroy(rows);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_was_copied_can_be_set_again),
        cmocka_unit_test(values_are_set_in_row_order),
        cmocka_unit_test(vapour_is_rounded_to_the_quantum),
        cmocka_unit_test(cells_freeze_and_melt_through_their_value),
        cmocka_unit_test(ice_at_the_rim_ends_a_run_also_when_it_was_set),
        cmocka_unit_test(vapour_is_set_only_where_it_is_free),
        cmocka_unit_test(additions_are_set_cell_by_cell),
        cmocka_unit_test(a_new_addition_does_not_change_what_was_gained),
        cmocka_unit_test(the_background_of_fixed_cells_can_be_set),
        cmocka_unit_test(callbacks_and_rectangles_make_the_same_grid),
        cmocka_unit_test(fields_that_cannot_be_set_are_refused),
        cmocka_unit_test(counts_must_be_those_of_the_rectangle),
        cmocka_unit_test(one_bad_number_leaves_everything_as_it_was),
        cmocka_unit_test(huge_values_of_ice_stay_finite),
        cmocka_unit_test(freeze_steps_are_those_of_stepping_one_at_a_time),
        cmocka_unit_test(engines_agree_whatever_is_set_and_changed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
