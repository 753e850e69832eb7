/* What a grid answers, and what it answers to questions that make no sense. */
#include "support/grids.h"

#include <limits.h>
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

static void null_pointers_are_refused(void **state)
{
    (void)state;
    snow_grid *grid = grown();
    uint64_t digest = digest_of(grid);
    int64_t steps;
    uint64_t number;
    double real;
    size_t size;
    snow_rect rect;
    snow_hexagon hexagon;
    snow_isa isa;
    snow_model model;
    snow_reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    assert_status(SNOW_ERROR_NULL, snow_steps(NULL, &steps));
    assert_status(SNOW_ERROR_NULL, snow_steps(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_frozen(NULL, &number));
    assert_status(SNOW_ERROR_NULL, snow_frozen(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_tip_radius(NULL, &real));
    assert_status(SNOW_ERROR_NULL, snow_tip_radius(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_frozen_bounds(NULL, &rect));
    assert_status(SNOW_ERROR_NULL, snow_frozen_bounds(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_frozen_hexagon(NULL, &hexagon));
    assert_status(SNOW_ERROR_NULL, snow_frozen_hexagon(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_domain_bounds(NULL, &rect));
    assert_status(SNOW_ERROR_NULL, snow_domain_bounds(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_domain_cells(NULL, &number));
    assert_status(SNOW_ERROR_NULL, snow_domain_cells(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_mass(NULL, &real, &real));
    assert_status(SNOW_ERROR_NULL, snow_mass(grid, NULL, NULL));
    assert_status(SNOW_ERROR_NULL, snow_symmetry_defect(NULL, &real));
    assert_status(SNOW_ERROR_NULL, snow_symmetry_defect(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_digest(NULL, &number));
    assert_status(SNOW_ERROR_NULL, snow_digest(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_memory(NULL, &number));
    assert_status(SNOW_ERROR_NULL, snow_memory(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_isa_of(NULL, &isa));
    assert_status(SNOW_ERROR_NULL, snow_isa_of(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_model_of(NULL, &model));
    assert_status(SNOW_ERROR_NULL, snow_model_of(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_cell_value(NULL, SNOW_FIELD_VALUE, 0, 0, &real));
    assert_status(SNOW_ERROR_NULL, snow_cell_value(grid, SNOW_FIELD_VALUE, 0, 0, NULL));
    assert_status(SNOW_ERROR_NULL, snow_field_copy(NULL, SNOW_FIELD_VALUE, NULL, &real, 1, &size));
    assert_status(SNOW_ERROR_NULL, snow_field_copy(grid, SNOW_FIELD_VALUE, NULL, NULL, 1, NULL));
    assert_status(SNOW_ERROR_NULL, snow_field_set(NULL, SNOW_FIELD_VALUE, NULL, &real, 1));
    assert_status(SNOW_ERROR_NULL, snow_field_set(grid, SNOW_FIELD_VALUE, NULL, NULL, 1));
    assert_status(SNOW_ERROR_NULL, snow_reiter_conditions_of(NULL, &conditions));
    assert_status(SNOW_ERROR_NULL, snow_reiter_conditions_of(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_reiter_change(NULL, &conditions));
    assert_status(SNOW_ERROR_NULL, snow_reiter_change(grid, NULL));
    assert_true(digest == digest_of(grid));
    snow_destroy(grid);
}

static void the_model_is_told(void **state)
{
    (void)state;
    snow_grid *grid = grown();
    snow_model model = (snow_model)0;
    assert_ok(snow_model_of(grid, &model));
    assert_int_equal(SNOW_MODEL_REITER, model);
    snow_destroy(grid);
}

static void counts_agree_with_the_fields(void **state)
{
    (void)state;
    snow_grid *grid = grown();
    snow_rect rect = bounds_of(grid);
    uint64_t inside = 0, frozen = 0;
    int64_t tip_square = 0;
    int32_t least_q = INT32_MAX, most_q = INT32_MIN, least_r = INT32_MAX, most_r = INT32_MIN;
    int32_t least_s = INT32_MAX, most_s = INT32_MIN;
    for (int32_t r = rect.r; r < rect.r + rect.height; r++) {
        for (int32_t q = rect.q; q < rect.q + rect.width; q++) {
            inside += value_at(grid, SNOW_FIELD_INSIDE, q, r) == 1;
            if (value_at(grid, SNOW_FIELD_FROZEN, q, r) == 0)
                continue;
            frozen++;
            int64_t square = q * q + q * r + r * r;
            tip_square = square > tip_square ? square : tip_square;
            least_q = q < least_q ? q : least_q;
            most_q = q > most_q ? q : most_q;
            least_r = r < least_r ? r : least_r;
            most_r = r > most_r ? r : most_r;
            least_s = q + r < least_s ? q + r : least_s;
            most_s = q + r > most_s ? q + r : most_s;
        }
    }
    assert_int_equal(inside, cells_of(grid));
    assert_int_equal(frozen, frozen_of(grid));
    assert_true(frozen > 7);
    assert_same_double(sqrt((double)tip_square), tip_of(grid));
    snow_rect bounds;
    assert_ok(snow_frozen_bounds(grid, &bounds));
    assert_int_equal(least_q, bounds.q);
    assert_int_equal(least_r, bounds.r);
    assert_int_equal(most_q - least_q + 1, bounds.width);
    assert_int_equal(most_r - least_r + 1, bounds.height);
    snow_hexagon hexagon;
    assert_ok(snow_frozen_hexagon(grid, &hexagon));
    assert_int_equal(least_q, hexagon.least_q);
    assert_int_equal(most_q, hexagon.greatest_q);
    assert_int_equal(least_r, hexagon.least_r);
    assert_int_equal(most_r, hexagon.greatest_r);
    assert_int_equal(least_s, hexagon.least_s);
    assert_int_equal(most_s, hexagon.greatest_s);
    snow_destroy(grid);
}

static void fields_of_a_cell_belong_together(void **state)
{
    (void)state;
    snow_grid *grid = grown();
    snow_rect rect = bounds_of(grid);
    for (int32_t r = rect.r; r < rect.r + rect.height; r++) {
        for (int32_t q = rect.q; q < rect.q + rect.width; q++) {
            if (value_at(grid, SNOW_FIELD_INSIDE, q, r) == 0)
                continue;
            double value = value_at(grid, SNOW_FIELD_VALUE, q, r);
            bool frozen = value_at(grid, SNOW_FIELD_FROZEN, q, r) == 1;
            bool receptive = frozen;
            for (int i = 0; i < 6; i++)
                receptive =
                    receptive || value_at(grid, SNOW_FIELD_FROZEN, q + neighbours[i].q, r + neighbours[i].r) == 1;
            assert_int_equal(frozen, value >= 1 - SNOW_REITER_SLACK);
            assert_int_equal(receptive, value_at(grid, SNOW_FIELD_RECEPTIVE, q, r) == 1);
            assert_same_double(receptive ? 0 : value, value_at(grid, SNOW_FIELD_VAPOUR, q, r));
            assert_int_equal(frozen, value_at(grid, SNOW_FIELD_FREEZE_STEP, q, r) >= 0);
            assert_same_double(0.02, value_at(grid, SNOW_FIELD_ADDITION, q, r));
            assert_same_double(0.4, value_at(grid, SNOW_FIELD_BACKGROUND, q, r));
        }
    }
    snow_destroy(grid);
}

static void outside_is_the_fixed_medium(void **state)
{
    (void)state;
    static const snow_cell outside[] = {{15, 0},        {-15, 0},       {0, 15},        {9, 9},
                                        {1000000, 3},   {INT32_MAX, 0}, {INT32_MIN, 0}, {0, INT32_MAX},
                                        {0, INT32_MIN}, {INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN},
                                        {INT32_MIN, INT32_MAX}};
    snow_grid *grid = grown();
    for (size_t i = 0; i < COUNT_OF(outside); i++) {
        int32_t q = outside[i].q, r = outside[i].r;
        assert_near(0.4, value_at(grid, SNOW_FIELD_VALUE, q, r), 0x1p-51);
        assert_near(0.4, value_at(grid, SNOW_FIELD_VAPOUR, q, r), 0x1p-51);
        assert_near(0.4, value_at(grid, SNOW_FIELD_BACKGROUND, q, r), 0x1p-51);
        assert_same_double(0.0, value_at(grid, SNOW_FIELD_FROZEN, q, r));
        assert_same_double(0.0, value_at(grid, SNOW_FIELD_RECEPTIVE, q, r));
        assert_same_double(0.0, value_at(grid, SNOW_FIELD_INSIDE, q, r));
        assert_same_double(-1.0, value_at(grid, SNOW_FIELD_FREEZE_STEP, q, r));
        assert_same_double(0.0, value_at(grid, SNOW_FIELD_ADDITION, q, r));
    }
    snow_destroy(grid);
}

static void unknown_fields_are_refused(void **state)
{
    (void)state;
    static const int unknown[] = {0, 9, -1, INT_MAX, INT_MIN};
    snow_grid *grid = grown();
    for (size_t i = 0; i < COUNT_OF(unknown); i++) {
        double value = 77, values[4] = {77, 77, 77, 77};
        size_t count = 77;
        snow_rect rect = {0, 0, 2, 2};
        snow_field field = (snow_field)unknown[i];
        assert_status(SNOW_ERROR_ENUM, snow_cell_value(grid, field, 0, 0, &value));
        assert_status(SNOW_ERROR_ENUM, snow_field_copy(grid, field, &rect, values, 4, &count));
        assert_status(SNOW_ERROR_ENUM, snow_field_set(grid, field, &rect, values, 4));
        assert_same_double(77, value);
        assert_same_double(77, values[0]);
        assert_int_equal(77, count);
    }
    snow_destroy(grid);
}

static void freeze_steps_must_be_asked_for(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.02, 1, 5);
    snow_grid *grid = make_grid(&params, NULL);
    double value = 77;
    size_t count = 77;
    assert_status(SNOW_ERROR_NOT_RECORDED, snow_cell_value(grid, SNOW_FIELD_FREEZE_STEP, 0, 0, &value));
    assert_status(SNOW_ERROR_NOT_RECORDED, snow_field_copy(grid, SNOW_FIELD_FREEZE_STEP, NULL, NULL, 0, &count));
    assert_same_double(77, value);
    assert_int_equal(77, count);
    snow_destroy(grid);
}

static void a_copy_is_in_row_order(void **state)
{
    (void)state;
    static const snow_field fields[] = {SNOW_FIELD_VALUE,  SNOW_FIELD_VAPOUR,      SNOW_FIELD_FROZEN,
                                        SNOW_FIELD_RECEPTIVE, SNOW_FIELD_INSIDE,   SNOW_FIELD_FREEZE_STEP,
                                        SNOW_FIELD_ADDITION, SNOW_FIELD_BACKGROUND};
    /* Within, straddling each side, round everything, single rows and columns, outside. */
    static const snow_rect rects[] = {
        {-3, -2, 7, 4},  {-20, -3, 9, 5}, {10, -3, 9, 5},  {-4, -20, 6, 9}, {-4, 10, 6, 9},
        {-30, -30, 61, 61}, {0, -20, 1, 41}, {-20, 0, 41, 1}, {40, 40, 3, 3},  {-3, 2, 0, 5}, {-3, 2, 5, 0},
        {-3, 2, 0, 0},
    };
    snow_grid *grid = grown();
    for (size_t i = 0; i < COUNT_OF(rects); i++) {
        for (size_t k = 0; k < COUNT_OF(fields); k++) {
            size_t count;
            double *values = copy_field(grid, fields[k], &rects[i], &count);
            assert_int_equal((size_t)rects[i].width * (size_t)rects[i].height, count);
            for (size_t n = 0; n < count; n++) {
                int32_t q = rects[i].q + (int32_t)(n % (size_t)rects[i].width);
                int32_t r = rects[i].r + (int32_t)(n / (size_t)rects[i].width);
                assert_same_double(value_at(grid, fields[k], q, r), values[n]);
            }
            free(values);
        }
    }
    snow_destroy(grid);
}

static void no_rectangle_means_the_domain(void **state)
{
    (void)state;
    snow_grid *grid = grown();
    snow_rect bounds = bounds_of(grid);
    size_t left_count, right_count;
    double *left = copy_field(grid, SNOW_FIELD_VALUE, NULL, &left_count);
    double *right = copy_field(grid, SNOW_FIELD_VALUE, &bounds, &right_count);
    assert_int_equal(left_count, right_count);
    assert_memory_equal(left, right, left_count * sizeof *left);
    free(left);
    free(right);
    snow_destroy(grid);
}

static void buffers_that_are_too_small_stay_untouched(void **state)
{
    (void)state;
    snow_grid *grid = grown();
    snow_rect rect = {-2, -2, 5, 3};
    double values[16];
    for (size_t capacity = 0; capacity < 15; capacity++) {
        for (size_t i = 0; i < COUNT_OF(values); i++)
            values[i] = 77;
        size_t count = 0;
        assert_status(SNOW_ERROR_BUFFER, snow_field_copy(grid, SNOW_FIELD_VALUE, &rect, values, capacity, &count));
        assert_int_equal(15, count);
        assert_status(SNOW_ERROR_BUFFER, snow_field_copy(grid, SNOW_FIELD_VALUE, &rect, values, capacity, NULL));
        for (size_t i = 0; i < COUNT_OF(values); i++)
            assert_same_double(77, values[i]);
    }
    assert_ok(snow_field_copy(grid, SNOW_FIELD_VALUE, &rect, values, 15, NULL));
    assert_same_double(77, values[15]);
    assert_ok(snow_field_copy(grid, SNOW_FIELD_VALUE, &rect, values, 16, NULL));
    assert_same_double(77, values[15]);
    snow_destroy(grid);
}

static void rectangles_that_make_no_sense_are_refused(void **state)
{
    (void)state;
    static const snow_rect bad[] = {
        {0, 0, -1, 3},
        {0, 0, 3, -1},
        {0, 0, INT32_MIN, INT32_MIN},
        {2, 0, INT32_MAX, 1},
        {INT32_MAX, 0, 2, 1},
        {0, INT32_MAX, 1, 2},
        {INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX},
        {2, 0, INT32_MAX, INT32_MAX},
    };
    snow_grid *grid = grown();
    uint64_t digest = digest_of(grid);
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        double value = 77;
        size_t count = 77;
        assert_status(SNOW_ERROR_RECTANGLE, snow_field_copy(grid, SNOW_FIELD_VALUE, &bad[i], NULL, 0, &count));
        assert_status(SNOW_ERROR_RECTANGLE, snow_field_copy(grid, SNOW_FIELD_VALUE, &bad[i], &value, 1, &count));
        assert_status(SNOW_ERROR_RECTANGLE, snow_field_set(grid, SNOW_FIELD_VALUE, &bad[i], &value, 1));
        assert_same_double(77, value);
        assert_int_equal(77, count);
    }
    assert_true(digest == digest_of(grid));

    /* The far corners of the plane are fine. */
    static const snow_rect far[] = {
        {INT32_MAX, INT32_MAX, 1, 1},
        {INT32_MIN, INT32_MIN, 1, 1},
        {INT32_MAX - 3, INT32_MIN, 4, 1},
        {INT32_MAX, 5, 0, 0},
        {INT32_MIN, 0, 2, 2},
    };
    for (size_t i = 0; i < COUNT_OF(far); i++) {
        size_t count;
        double *values = copy_field(grid, SNOW_FIELD_VALUE, &far[i], &count);
        for (size_t n = 0; n < count; n++)
            assert_near(0.4, values[n], 0x1p-51);
        free(values);
    }
    size_t count = 0;
    static const snow_rect wide[] = {{INT32_MIN, 0, INT32_MAX, 1}, {1, 0, INT32_MAX, 1}, {0, 1, 1, INT32_MAX}};
    bool fits = INT32_MAX <= SIZE_MAX / sizeof(double); /* not in 32 bits */
    for (size_t i = 0; i < COUNT_OF(wide); i++) {
        assert_status(fits ? SNOW_OK : SNOW_ERROR_TOO_LARGE,
                      snow_field_copy(grid, SNOW_FIELD_VALUE, &wide[i], NULL, 0, &count));
        assert_int_equal(fits ? INT32_MAX : 0, count);
    }
    snow_rect most = {INT32_MIN, INT32_MIN, INT32_MAX, INT32_MAX};
    double value = 77;
    assert_status(SNOW_ERROR_TOO_LARGE, snow_field_copy(grid, SNOW_FIELD_VALUE, &most, &value, 1, NULL));
    assert_status(SNOW_ERROR_TOO_LARGE, snow_field_set(grid, SNOW_FIELD_VALUE, &most, &value, 1));
    assert_same_double(77, value);
    snow_destroy(grid);
}

static void masses_are_the_sums_of_the_values(void **state)
{
    (void)state;
    snow_grid *grid = grown();
    snow_rect rect = bounds_of(grid);
    long double vapour = 0, ice = 0;
    for (int32_t r = rect.r; r < rect.r + rect.height; r++) {
        for (int32_t q = rect.q; q < rect.q + rect.width; q++) {
            if (value_at(grid, SNOW_FIELD_INSIDE, q, r) == 0)
                continue;
            long double value = (long double)value_at(grid, SNOW_FIELD_VALUE, q, r);
            if (value_at(grid, SNOW_FIELD_FROZEN, q, r) == 1)
                ice += value;
            else
                vapour += value;
        }
    }
    double got_vapour = -1, got_ice = -1;
    assert_ok(snow_mass(grid, &got_vapour, &got_ice));
    assert_near((double)vapour, got_vapour, 1e-12);
    assert_near((double)ice, got_ice, 1e-12);
    double alone = -1;
    assert_ok(snow_mass(grid, &alone, NULL));
    assert_same_double(got_vapour, alone);
    assert_ok(snow_mass(grid, NULL, &alone));
    assert_same_double(got_ice, alone);
    snow_destroy(grid);
}

static void masses_are_summed_without_loss(void **state)
{
    (void)state;
    /* A million cells of 0.1: a plain sum is off by some 1e-6. */
    snow_reiter_params params = rectangle_scene(0.1, 0, 1, 1000, 1000);
    without_seeds(&params);
    snow_grid *grid = make_grid(&params, NULL);
    double value = value_at(grid, SNOW_FIELD_VALUE, 0, 0);
    double vapour, ice;
    assert_ok(snow_mass(grid, &vapour, &ice));
    assert_near(1e6 * value, vapour, 2 * 0x1p-36);
    assert_same_double(0.0, ice);
    snow_destroy(grid);
}

static void the_digest_sees_every_cell_and_the_step_count(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0, 0, 6);
    without_seeds(&params);
    snow_grid *grid = make_grid(&params, NULL);
    uint64_t start = digest_of(grid);
    assert_true(start == digest_of(grid));
    snow_rect rect = bounds_of(grid);
    for (int32_t r = rect.r; r < rect.r + rect.height; r++) {
        for (int32_t q = rect.q; q < rect.q + rect.width; q++) {
            if (value_at(grid, SNOW_FIELD_INSIDE, q, r) == 0)
                continue;
            double value = value_at(grid, SNOW_FIELD_VALUE, q, r);
            set_cell(grid, SNOW_FIELD_VALUE, q, r, value + 0x1p-51);
            assert_true(value_at(grid, SNOW_FIELD_VALUE, q, r) > value);
            assert_true(start != digest_of(grid));
            set_cell(grid, SNOW_FIELD_VALUE, q, r, value);
            assert_true(start == digest_of(grid));
        }
    }
    /* α = γ = 0: nothing but the step count changes. */
    assert_ok(snow_step(grid, 1));
    assert_true(start != digest_of(grid));
    snow_destroy(grid);
}

static void digests_of_different_scenes_differ(void **state)
{
    (void)state;
    snow_reiter_params scenes[] = {
        disc_scene(0.4, 0.001, 1, 10), disc_scene(0.4, 0.001, 1, 11),   disc_scene(0.4000000001, 0.001, 1, 10),
        disc_scene(0.4, 0.002, 1, 10), disc_scene(0.4, 0.001, 1.01, 10), hexagon_scene(0.4, 0.001, 1, 10),
        rectangle_scene(0.4, 0.001, 1, 10, 12), rectangle_scene(0.4, 0.001, 1, 12, 10),
    };
    uint64_t digests[COUNT_OF(scenes)];
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        snow_grid *grid = make_grid(&scenes[i], NULL);
        assert_ok(snow_step(grid, 10));
        digests[i] = digest_of(grid);
        for (size_t j = 0; j < i; j++)
            assert_true(digests[i] != digests[j]);
        snow_destroy(grid);
    }
}

static void conditions_are_told(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.123, 0.0456, 0.789, 5);
    snow_grid *grid = make_grid(&params, NULL);
    snow_reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    assert_same_double(0.4, conditions.background);
    assert_same_double(0.001, conditions.addition);
    assert_same_double(1.0, conditions.diffusion);
    assert_int_equal(1, conditions.rescale);
    conditions.rescale = 0;
    assert_ok(snow_reiter_conditions_of(grid, &conditions));
    assert_same_double(0.123, conditions.background);
    assert_same_double(0.0456, conditions.addition);
    assert_same_double(0.789, conditions.diffusion);
    assert_int_equal(0, conditions.rescale);
    snow_destroy(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(null_pointers_are_refused),
        cmocka_unit_test(the_model_is_told),
        cmocka_unit_test(counts_agree_with_the_fields),
        cmocka_unit_test(fields_of_a_cell_belong_together),
        cmocka_unit_test(outside_is_the_fixed_medium),
        cmocka_unit_test(unknown_fields_are_refused),
        cmocka_unit_test(freeze_steps_must_be_asked_for),
        cmocka_unit_test(a_copy_is_in_row_order),
        cmocka_unit_test(no_rectangle_means_the_domain),
        cmocka_unit_test(buffers_that_are_too_small_stay_untouched),
        cmocka_unit_test(rectangles_that_make_no_sense_are_refused),
        cmocka_unit_test(masses_are_the_sums_of_the_values),
        cmocka_unit_test(masses_are_summed_without_loss),
        cmocka_unit_test(the_digest_sees_every_cell_and_the_step_count),
        cmocka_unit_test(digests_of_different_scenes_differ),
        cmocka_unit_test(conditions_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
