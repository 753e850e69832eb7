/* Where the model itself is at its limit: diffusion up to 8/3 and beyond, vapour below zero, hardly any, and none. */
#include "support/grids.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* The engines that promise the same bits, in both precisions. */
static const struct {
    snow_reiter_engine engine;
    snow_reiter_precision precision;
} exact_ways[] = {
    {SNOW_REITER_ENGINE_ROWS, SNOW_REITER_PRECISION_DOUBLE},
    {SNOW_REITER_ENGINE_REFERENCE, SNOW_REITER_PRECISION_DOUBLE},
    {SNOW_REITER_ENGINE_ROWS, SNOW_REITER_PRECISION_SINGLE},
    {SNOW_REITER_ENGINE_REFERENCE, SNOW_REITER_PRECISION_SINGLE},
};

static const snow_reiter_precision precisions[] = {SNOW_REITER_PRECISION_DOUBLE, SNOW_REITER_PRECISION_SINGLE};

/* No infinity, NaN, subnormal number or negative zero. */
static void assert_sound_field(const snow_grid *grid, snow_field field)
{
    size_t count;
    snow_rect rect = widened(bounds_of(grid));
    double *values = copy_field(grid, field, &rect, &count);
    for (size_t i = 0; i < count; i++)
        assert_true(isnormal(values[i]) || (values[i] == 0 && !signbit(values[i])));
    free(values);
}

static void assert_sound_numbers(const snow_grid *grid)
{
    assert_sound_field(grid, SNOW_FIELD_VALUE);
    assert_sound_field(grid, SNOW_FIELD_VAPOUR);
    assert_sound_field(grid, SNOW_FIELD_ADDITION);
    assert_sound_field(grid, SNOW_FIELD_BACKGROUND);
}

static double greatest_vapour(const snow_grid *grid)
{
    size_t count;
    double *vapour = copy_field(grid, SNOW_FIELD_VAPOUR, NULL, &count);
    double greatest = 0;
    for (size_t i = 0; i < count; i++)
        greatest = fmax(greatest, fabs(vapour[i]));
    free(vapour);
    return greatest;
}

static double least_vapour(const snow_grid *grid)
{
    size_t count;
    double *vapour = copy_field(grid, SNOW_FIELD_VAPOUR, NULL, &count);
    double least = 0;
    for (size_t i = 0; i < count; i++)
        least = fmin(least, vapour[i]);
    free(vapour);
    return least;
}

/* β, γ and α as they are, but for a new diffusion. */
static snow_status change_diffusion(snow_grid *grid, double diffusion)
{
    snow_reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    assert_ok(snow_reiter_conditions_of(grid, &conditions));
    conditions.diffusion = diffusion;
    return snow_reiter_change(grid, &conditions);
}

typedef struct saved {
    unsigned char *bytes;
    size_t size;
} saved;

static saved save(const snow_grid *grid)
{
    saved data = {NULL, 0};
    assert_ok(snow_save(grid, NULL, 0, &data.size));
    data.bytes = malloc(data.size);
    assert_non_null(data.bytes);
    assert_ok(snow_save(grid, data.bytes, data.size, &data.size));
    return data;
}

static snow_grid *reload(const snow_grid *grid)
{
    saved data = save(grid);
    snow_grid *copy = NULL;
    assert_ok(snow_load(data.bytes, data.size, NULL, &copy));
    free(data.bytes);
    return copy;
}

static void eight_thirds_is_the_last_diffusion_that_need_not_be_asked_for(void **state)
{
    (void)state;
    static const struct {
        double diffusion;
        bool stable, possible;
    } cases[] = {
        {0, true, true},
        {DBL_TRUE_MIN, true, true},
        {1e-310, true, true},
        {2.66, true, true},
        {8.0 / 3.0, true, true},
        {2.67, false, true},
        {2.69, false, true},
        {4, false, true},
        {4.01, false, false},
        {-DBL_TRUE_MIN, false, false},
        {-1, false, false},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        for (int allowed = 0; allowed <= 1; allowed++) {
            snow_status expected = SNOW_ERROR_REITER_DIFFUSION;
            if (cases[i].stable || (allowed && cases[i].possible))
                expected = SNOW_OK;
            snow_reiter_params params = disc_scene(0.4, 0.01, cases[i].diffusion, 8);
            params.allow_unstable = allowed;
            snow_grid *grid = NULL;
            assert_status(expected, snow_reiter_create(&params, NULL, &grid));
            snow_destroy(grid);

            params.diffusion = 1;
            grid = make_grid(&params, NULL);
            snow_grid *same = make_grid(&params, NULL);
            assert_status(expected, change_diffusion(grid, cases[i].diffusion));
            assert_ok(snow_step(grid, 10));
            assert_ok(snow_step(same, 10));
            if (expected != SNOW_OK)
                assert_same_grids(same, grid);
            snow_destroy(same);
            snow_destroy(grid);
        }
    }
}

/* The root of the sum of squares of what the vapour differs by from the fixed cells. */
static double distance_from_background(const snow_grid *grid)
{
    size_t count;
    double *values = copy_field(grid, SNOW_FIELD_VALUE, NULL, &count);
    double level = values[0]; /* a corner of the bounds of a disc */
    assert_same_double(0, value_at(grid, SNOW_FIELD_INSIDE, bounds_of(grid).q, bounds_of(grid).r));
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += (values[i] - level) * (values[i] - level);
    free(values);
    return sqrt(sum);
}

/* Without ice a step is a symmetric matrix, which multiplies no wave by more than 1 (doc/reiter.md, section 2). */
static void up_to_eight_thirds_no_wave_grows(void **state)
{
    (void)state;
    static const double diffusions[] = {1, 2, 2.003, 2.66, 8.0 / 3.0};
    for (size_t i = 0; i < COUNT_OF(diffusions); i++) {
        for (size_t k = 0; k < COUNT_OF(exact_ways); k++) {
            bool fast = exact_ways[k].engine == SNOW_REITER_ENGINE_ROWS;
            /* Many roundings of half a quantum. */
            double rounding = exact_ways[k].precision == SNOW_REITER_PRECISION_SINGLE ? 1e-5 : 1e-12;
            snow_reiter_params params = disc_scene(0.4, 0.001, diffusions[i], fast ? 24 : 12);
            params.engine = exact_ways[k].engine;
            params.precision = exact_ways[k].precision;
            params.noise = 0.1;
            without_seeds(&params);
            snow_grid *grid = make_grid(&params, NULL);
            double before = distance_from_background(grid);
            assert_true(before > 0.5);
            for (int round = 0; round < 40; round++) {
                assert_ok(snow_step(grid, fast ? 500 : 50));
                double after = distance_from_background(grid);
                assert_true(after <= before + rounding);
                before = after;
            }
            assert_int_equal(0, frozen_of(grid));
            snow_destroy(grid);
        }
    }
}

/* Beyond it the wave of three colours is multiplied by 1 − 3α/4 in each step; in a small disc, which holds no wave
   longer than itself, by a little less. */
static void beyond_eight_thirds_the_worst_wave_grows_as_foretold(void **state)
{
    (void)state;
    static const struct {
        double diffusion;
        int64_t from, steps;
        double less;
    } cases[] = {{2.67, 6000, 1000, 0.0011}, {2.69, 600, 100, 0.0018}, {3, 35, 10, 0.02}, {4, 8, 4, 0.12}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        snow_reiter_params params = disc_scene(1e-6, 0, cases[i].diffusion, 30);
        params.noise = 1e-7;
        params.allow_unstable = 1;
        without_seeds(&params);
        snow_grid *grid = make_grid(&params, NULL);
        assert_ok(snow_step(grid, cases[i].from));
        double before = distance_from_background(grid);
        assert_ok(snow_step(grid, cases[i].steps));
        double factor = pow(distance_from_background(grid) / before, 1 / (double)cases[i].steps);
        double foretold = 0.75 * cases[i].diffusion - 1;
        assert_true(factor > 1);
        assert_true(factor <= foretold * (1 + 1e-9));
        assert_near(foretold, factor, cases[i].less);
        snow_destroy(grid);
    }
}

/* Scenes whose vapour leaves its bound: in thin air nothing freezes before that. */
typedef struct wild_scene {
    double background, diffusion;
    int32_t radius;
    double noise; /* as a part of the background */
} wild_scene;

static const wild_scene wild_scenes[] = {
    {1e-6, 2.69, 20, 0}, {1e-6, 3, 12, 0.1}, {1e-3, 4, 20, 0}, {1e-3, 4, 16, 0.1}, {1e-15, 2.75, 12, 0.1},
};

static snow_reiter_params params_of(const wild_scene *scene, snow_reiter_engine engine,
                                    snow_reiter_precision precision)
{
    snow_reiter_params params = disc_scene(scene->background, 1e-5, scene->diffusion, scene->radius);
    params.noise = scene->noise * scene->background;
    params.allow_unstable = 1;
    params.engine = engine;
    params.precision = precision;
    return params;
}

/* Steps, so many at a time, until it can step no more. */
static snow_grid *grow_until_unstable(const snow_reiter_params *params, const snow_options *options, int64_t stride)
{
    snow_grid *grid = make_grid(params, options);
    snow_status status = SNOW_OK;
    while (status == SNOW_OK) {
        int64_t before = steps_of(grid);
        assert_true(before < 5000);
        status = snow_step(grid, stride);
        if (status == SNOW_OK)
            assert_int_equal(before + stride, steps_of(grid));
    }
    assert_status(SNOW_ERROR_UNSTABLE, status);
    return grid;
}

/* The same bits as a grid that was stepped to just there, in every field and in the snapshot. */
static void assert_stopped_where(const snow_grid *expected, const snow_grid *got)
{
    assert_int_equal(steps_of(expected), steps_of(got));
    assert_same_grids(expected, got);
    saved left = save(expected);
    saved right = save(got);
    assert_int_equal(left.size, right.size);
    assert_memory_equal(left.bytes, right.bytes, left.size);
    free(left.bytes);
    free(right.bytes);
}

static void assert_cannot_go_on(snow_grid *grid)
{
    int64_t steps = steps_of(grid);
    uint64_t digest = digest_of(grid);
    assert_status(SNOW_ERROR_UNSTABLE, snow_step(grid, 1));
    assert_status(SNOW_ERROR_UNSTABLE, snow_step(grid, 1000));
    assert_int_equal(steps, steps_of(grid));
    assert_true(digest == digest_of(grid));
    assert_ok(snow_step(grid, 0));
}

static void assert_run_ends_there(const snow_reiter_params *params, const snow_grid *expected)
{
    snow_grid *grid = make_grid(params, NULL);
    snow_stop stop = stop_after(1000000);
    snow_summary summary;
    snow_summary_init(&summary, sizeof summary);
    assert_status(SNOW_ERROR_UNSTABLE, snow_run(grid, &stop, &summary));
    assert_int_equal(SNOW_STOP_UNSTABLE, summary.reason);
    assert_int_equal(steps_of(expected), summary.steps);
    assert_int_equal(frozen_of(expected), summary.frozen);
    assert_stopped_where(expected, grid);
    assert_cannot_go_on(grid);
    snow_destroy(grid);
}

static void growth_ends_at_the_last_whole_step(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(wild_scenes); i++) {
        for (size_t k = 0; k < COUNT_OF(exact_ways); k++) {
            snow_reiter_params params = params_of(&wild_scenes[i], exact_ways[k].engine, exact_ways[k].precision);
            snow_grid *expected = grow_until_unstable(&params, NULL, 1);
            /* The state is that of a grid that never met the step too many. */
            snow_grid *whole = make_grid(&params, NULL);
            assert_ok(snow_step(whole, steps_of(expected)));
            assert_stopped_where(whole, expected);
            snow_destroy(whole);

            snow_grid *strides = grow_until_unstable(&params, NULL, 7);
            assert_stopped_where(expected, strides);
            snow_destroy(strides);
            assert_run_ends_there(&params, expected);

            assert_sound_numbers(expected);
            if (wild_scenes[i].noise == 0)
                assert_same_double(0, defect_of(expected));
            snow_grid *copy = reload(expected);
            assert_stopped_where(expected, copy);
            assert_cannot_go_on(copy);
            snow_destroy(copy);
            assert_cannot_go_on(expected);
            snow_destroy(expected);
        }
    }
}

/* Folded or not, with one thread or three. */
static void assert_rows_end_there(const snow_reiter_params *scene, const snow_grid *expected, snow_isa isa)
{
    for (int way = 0; way < 4; way++) {
        snow_reiter_params params = *scene;
        params.engine = SNOW_REITER_ENGINE_ROWS;
        params.symmetry = way / 2 == 0 ? SNOW_REITER_SYMMETRY_AUTO : SNOW_REITER_SYMMETRY_NONE;
        snow_options options = default_options();
        options.isa = isa;
        options.threads = way % 2 == 0 ? 1 : 3;
        snow_grid *grid = grow_until_unstable(&params, &options, 100000);
        assert_int_equal(steps_of(expected), steps_of(grid));
        assert_same_grids(expected, grid);
        snow_destroy(grid);
    }
}

static void all_ways_end_at_the_same_step(void **state)
{
    (void)state;
    snow_isa isas[8];
    size_t count = available_isas(isas);
    for (size_t i = 0; i < COUNT_OF(wild_scenes); i++) {
        for (size_t p = 0; p < COUNT_OF(precisions); p++) {
            snow_reiter_params params = params_of(&wild_scenes[i], SNOW_REITER_ENGINE_REFERENCE, precisions[p]);
            snow_grid *expected = grow_until_unstable(&params, NULL, 1);
            for (size_t k = 0; k < count; k++)
                assert_rows_end_there(&params, expected, isas[k]);
            snow_destroy(expected);
        }
    }
}

static void quad_stops_too(void **state)
{
    (void)state;
    snow_reiter_params params = params_of(&wild_scenes[2], SNOW_REITER_ENGINE_QUAD, SNOW_REITER_PRECISION_DOUBLE);
    snow_grid *stepped = grow_until_unstable(&params, NULL, 1);
    assert_run_ends_there(&params, stepped);
    assert_sound_numbers(stepped);
    assert_ok(change_diffusion(stepped, 1));
    assert_ok(snow_step(stepped, 100));
    snow_destroy(stepped);
}

/* ROWS on every instruction set, saved and loaded on the way, ends like this grid, which took 60 steps more. */
static void assert_rows_go_on_alike(const snow_reiter_params *scene, double diffusion, const snow_grid *expected)
{
    snow_isa isas[8];
    size_t count = available_isas(isas);
    for (size_t k = 0; k < count; k++) {
        snow_reiter_params params = *scene;
        params.engine = SNOW_REITER_ENGINE_ROWS;
        snow_options options = default_options();
        options.isa = isas[k];
        snow_grid *grid = grow_until_unstable(&params, &options, 1000);
        assert_ok(change_diffusion(grid, diffusion));
        assert_ok(snow_step(grid, 20));
        snow_grid *copy = reload(grid);
        assert_ok(snow_step(grid, 40));
        assert_ok(snow_step(copy, 40));
        assert_same_grids(expected, grid);
        assert_same_grids(expected, copy);
        snow_destroy(copy);
        snow_destroy(grid);
    }
}

/* Where growth was stopped, a smaller diffusion goes on: the extremes shrink, the bits are the same for all. */
static void go_on_with(const snow_reiter_params *params, double diffusion)
{
    snow_grid *grid = grow_until_unstable(params, NULL, 1);
    double start = greatest_vapour(grid);
    assert_ok(change_diffusion(grid, diffusion));
    snow_grid *copy = reload(grid);
    assert_same_grids(grid, copy);
    for (int step = 0; step < 60; step++) {
        double before = greatest_vapour(grid);
        assert_ok(snow_step(grid, 1));
        if (diffusion <= 2)
            assert_true(greatest_vapour(grid) <= before);
    }
    assert_true(greatest_vapour(grid) <= 4 * start);
    if (params->noise == 0)
        assert_same_double(0, defect_of(grid));
    assert_ok(snow_step(copy, 60));
    assert_same_grids(grid, copy);
    assert_rows_go_on_alike(params, diffusion, grid);
    snow_destroy(copy);
    snow_destroy(grid);
}

static void a_smaller_diffusion_goes_on(void **state)
{
    (void)state;
    static const double diffusions[] = {2.5, 2, 1, 0.1, 0.01, 0};
    for (size_t i = 0; i < COUNT_OF(wild_scenes); i++) {
        for (size_t p = 0; p < COUNT_OF(precisions); p++) {
            snow_reiter_params params = params_of(&wild_scenes[i], SNOW_REITER_ENGINE_REFERENCE, precisions[p]);
            for (size_t k = 0; k < COUNT_OF(diffusions); k++)
                go_on_with(&params, diffusions[k]);
        }
    }
}

/* Three colours of vapour, as far apart as they can be set: sums of both signs, near the bound. */
static snow_grid *motley(snow_reiter_engine engine, snow_reiter_precision precision, snow_isa isa, uint64_t random)
{
    snow_reiter_params params = hexagon_scene(0.9, 0, 2.6, 12);
    params.engine = engine;
    params.precision = precision;
    without_seeds(&params);
    snow_options options = default_options();
    options.isa = isa;
    snow_grid *grid = make_grid(&params, &options);
    double values[23 * 23];
    for (int32_t i = 0; i < 23 * 23; i++) {
        double size = 0.9 + 0x1p-20 * next_below(&random, 80000);
        values[i] = (i % 23 - i / 23 + 24) % 3 == 0 ? -size : size;
    }
    assert_ok(snow_field_set(grid, SNOW_FIELD_VAPOUR, &(snow_rect){-11, -11, 23, 23}, values, COUNT_OF(values)));
    return grid;
}

/* The diffusion falls below 2 while vapour is negative: sums still are exact, so that their order does not matter. */
static void outlive(snow_reiter_precision precision, double diffusion, uint64_t random)
{
    snow_isa isas[8];
    size_t count = available_isas(isas);
    snow_grid *expected = motley(SNOW_REITER_ENGINE_REFERENCE, precision, SNOW_ISA_AUTO, random);
    assert_true(least_vapour(expected) < -0.9);
    assert_ok(change_diffusion(expected, diffusion));
    assert_ok(snow_step(expected, 10));
    assert_true(diffusion == 1 || least_vapour(expected) < -0.01);
    for (size_t k = 0; k < count; k++) {
        snow_grid *grid = motley(SNOW_REITER_ENGINE_ROWS, precision, isas[k], random);
        assert_ok(change_diffusion(grid, diffusion));
        assert_ok(snow_step(grid, 5));
        snow_grid *copy = reload(grid);
        assert_ok(snow_step(grid, 5));
        assert_ok(snow_step(copy, 5));
        assert_same_grids(expected, grid);
        assert_same_grids(expected, copy);
        snow_destroy(copy);
        snow_destroy(grid);
    }
    snow_destroy(expected);
}

static void negative_vapour_outlives_its_diffusion(void **state)
{
    (void)state;
    static const double diffusions[] = {1, 0.1, 0.01};
    for (size_t i = 0; i < COUNT_OF(diffusions); i++)
        for (size_t p = 0; p < COUNT_OF(precisions); p++)
            for (uint64_t random = 1; random <= 10; random++)
                outlive(precisions[p], diffusions[i], random);
}

static void negative_vapour_belongs_to_diffusion_above_2(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(exact_ways); k++) {
        snow_reiter_params params = disc_scene(0.4, 0.01, nextafter(2, 3), 8);
        params.engine = exact_ways[k].engine;
        params.precision = exact_ways[k].precision;
        snow_grid *grid = make_grid(&params, NULL);
        double before, after;
        double level = value_at(grid, SNOW_FIELD_VAPOUR, 4, 1);
        assert_ok(snow_mass(grid, &before, NULL));
        set_cell(grid, SNOW_FIELD_VAPOUR, 4, 1, -0.5);
        assert_same_double(-0.5, value_at(grid, SNOW_FIELD_VAPOUR, 4, 1));
        assert_same_double(-0.5, value_at(grid, SNOW_FIELD_VALUE, 4, 1));
        assert_ok(snow_mass(grid, &after, NULL));
        assert_near(before - level - 0.5, after, 1e-13);
        const double too_low[] = {-1, -1.5, -DBL_MAX};
        for (size_t i = 0; i < COUNT_OF(too_low); i++) {
            uint64_t digest = digest_of(grid);
            snow_rect rect = {4, 1, 1, 1};
            assert_status(SNOW_ERROR_REITER_VAPOUR, snow_field_set(grid, SNOW_FIELD_VAPOUR, &rect, &too_low[i], 1));
            assert_status(SNOW_ERROR_REITER_VAPOUR, snow_field_set(grid, SNOW_FIELD_VALUE, &rect, &too_low[i], 1));
            assert_true(digest == digest_of(grid));
        }
        snow_destroy(grid);

        params.diffusion = 2;
        grid = make_grid(&params, NULL);
        snow_grid *same = make_grid(&params, NULL);
        double half = -0.5;
        snow_rect rect = {4, 1, 1, 1};
        assert_status(SNOW_ERROR_REITER_VAPOUR, snow_field_set(grid, SNOW_FIELD_VAPOUR, &rect, &half, 1));
        assert_status(SNOW_ERROR_REITER_VAPOUR, snow_field_set(grid, SNOW_FIELD_VALUE, &rect, &half, 1));
        assert_same_grids(same, grid);
        snow_destroy(same);
        snow_destroy(grid);
    }
}

static const double tiny_values[] = {DBL_TRUE_MIN, 1e-310, DBL_MIN, 1e-300, 0x1p-70, 0.0, -0.0};

/* A row of tiny values in the free vapour, and one on the ice and the cells beside it. */
static snow_grid *with_tiny_values(snow_reiter_engine engine, snow_reiter_precision precision, double background)
{
    snow_reiter_params params = disc_scene(background, 0x1p-10, 1, 14);
    params.engine = engine;
    params.precision = precision;
    snow_grid *grid = make_grid(&params, NULL);
    size_t count = COUNT_OF(tiny_values);
    assert_ok(snow_field_set(grid, SNOW_FIELD_VAPOUR, &(snow_rect){-3, 5, 7, 1}, tiny_values, count));
    assert_ok(snow_field_set(grid, SNOW_FIELD_VALUE, &(snow_rect){-3, -5, 7, 1}, tiny_values, count));
    for (size_t i = 0; i < COUNT_OF(neighbours); i++)
        set_cell(grid, SNOW_FIELD_VALUE, neighbours[i].q, neighbours[i].r, tiny_values[i]);
    return grid;
}

static void tiny_values_can_be_set(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(exact_ways); k++) {
        /* Beside ordinary vapour they are nothing. */
        snow_grid *grid = with_tiny_values(exact_ways[k].engine, exact_ways[k].precision, 0.4);
        for (int32_t i = 0; i < 7; i++) {
            assert_same_double(0, value_at(grid, SNOW_FIELD_VAPOUR, i - 3, 5));
            assert_same_double(0, value_at(grid, SNOW_FIELD_VALUE, i - 3, -5));
        }
        /* What a receptive cell has is kept to the last bit, but for the sign of zero. */
        for (size_t i = 0; i < COUNT_OF(neighbours); i++)
            assert_same_double(fabs(tiny_values[i]),
                               value_at(grid, SNOW_FIELD_VALUE, neighbours[i].q, neighbours[i].r));
        snow_destroy(grid);

        /* Alone, they are rounded to the least quantum, 2^-114, and 2^-92 in single precision. */
        grid = with_tiny_values(exact_ways[k].engine, exact_ways[k].precision, 0);
        for (int32_t i = 0; i < 7; i++) {
            double expected = tiny_values[i] == 0x1p-70 ? 0x1p-70 : 0;
            assert_same_double(expected, value_at(grid, SNOW_FIELD_VAPOUR, i - 3, 5));
            assert_same_double(expected, value_at(grid, SNOW_FIELD_VALUE, i - 3, -5));
        }
        snow_destroy(grid);
    }
}

static void assert_grow_alike(snow_grid *reference, snow_grid *rows)
{
    for (int round = 0; round < 5; round++) {
        assert_same_grids(reference, rows);
        assert_ok(snow_step(reference, 300));
        assert_ok(snow_step(rows, 300));
        assert_sound_field(rows, SNOW_FIELD_VAPOUR);
    }
    assert_true(frozen_of(rows) > 6);
    snow_grid *copy = reload(rows);
    assert_same_grids(rows, copy);
    snow_destroy(copy);
}

static void tiny_values_grow_alike(void **state)
{
    (void)state;
    static const double backgrounds[] = {0, DBL_TRUE_MIN, 1e-310, 1e-300, 0x1p-70, 0.4};
    for (size_t i = 0; i < COUNT_OF(backgrounds); i++) {
        for (size_t p = 0; p < COUNT_OF(precisions); p++) {
            snow_grid *rows = with_tiny_values(SNOW_REITER_ENGINE_ROWS, precisions[p], backgrounds[i]);
            snow_grid *reference = with_tiny_values(SNOW_REITER_ENGINE_REFERENCE, precisions[p], backgrounds[i]);
            assert_grow_alike(reference, rows);
            snow_destroy(reference);
            snow_destroy(rows);
        }
    }
}

/* All zero, of either sign: nothing ever flows or freezes, at any diffusion, and a run sees that at once. */
static void fields_of_zero_stay_zero(void **state)
{
    (void)state;
    static const double diffusions[] = {0, 1, 2, 8.0 / 3.0, 4};
    double zeros[21 * 21];
    for (size_t i = 0; i < COUNT_OF(zeros); i++)
        zeros[i] = i % 2 == 0 ? 0.0 : -0.0;
    for (size_t i = 0; i < COUNT_OF(diffusions); i++) {
        for (size_t k = 0; k < COUNT_OF(exact_ways); k++) {
            snow_reiter_params params = disc_scene(0.4, 0, diffusions[i], 7);
            params.engine = exact_ways[k].engine;
            params.precision = exact_ways[k].precision;
            params.allow_unstable = 1;
            snow_grid *grid = make_grid(&params, NULL);
            snow_rect all = {-10, -10, 21, 21};
            assert_ok(snow_field_set(grid, SNOW_FIELD_BACKGROUND, &all, zeros, COUNT_OF(zeros)));
            assert_ok(snow_field_set(grid, SNOW_FIELD_VALUE, &all, zeros, COUNT_OF(zeros)));
            assert_int_equal(0, frozen_of(grid));
            assert_ok(snow_step(grid, 1000));
            assert_sound_numbers(grid);
            double vapour, ice;
            assert_ok(snow_mass(grid, &vapour, &ice));
            assert_same_double(0, vapour);
            assert_same_double(0, ice);
            assert_same_double(0, defect_of(grid));
            snow_summary summary = run_grid(grid, NULL);
            assert_int_equal(SNOW_STOP_STILL, summary.reason);
            assert_true(summary.steps <= 1064);
            snow_destroy(grid);
        }
    }
}

/* α = 0: nothing flows, so every cell keeps β until ice comes to it, and ring n freezes 48 steps after ring n − 1. */
static void without_diffusion_only_additions_count(void **state)
{
    (void)state;
    static const double zeros[] = {0.0, -0.0};
    for (size_t i = 0; i < COUNT_OF(zeros); i++) {
        for (size_t k = 0; k < COUNT_OF(exact_ways); k++) {
            snow_reiter_params params = hexagon_scene(0.25, 0x1p-6, zeros[i], 10);
            params.engine = exact_ways[k].engine;
            params.precision = exact_ways[k].precision;
            params.record_freeze_steps = 1;
            snow_grid *grid = make_grid(&params, NULL);
            assert_ok(snow_step(grid, 5 * 48 + 20));
            for (int32_t r = -10; r <= 10; r++) {
                for (int32_t q = -10; q <= 10; q++) {
                    int32_t ring = (abs(q) + abs(r) + abs(q + r)) / 2;
                    if (ring > 10)
                        continue;
                    double gained = ring <= 6 ? 0x1p-6 * (5 * 48 + 20 - 48 * (ring > 0 ? ring - 1 : 0)) : 0;
                    assert_same_double((ring == 0 ? 1 : 0.25) + gained, value_at(grid, SNOW_FIELD_VALUE, q, r));
                    assert_same_double(ring <= 5 ? 48 * ring : -1, value_at(grid, SNOW_FIELD_FREEZE_STEP, q, r));
                    assert_same_double(ring <= 6 ? 0 : 0.25, value_at(grid, SNOW_FIELD_VAPOUR, q, r));
                }
            }
            snow_destroy(grid);
        }
    }
}

static void assert_same_with_a_tolerance(const snow_reiter_params *params, const snow_grid *expected, int64_t steps)
{
    snow_isa isas[8];
    size_t count = available_isas(isas);
    for (size_t k = 0; k < count; k++) {
        snow_options options = default_options();
        options.isa = isas[k];
        options.threads = 1 + 2 * (int32_t)(k % 2);
        snow_grid *grid = make_grid(params, &options);
        assert_ok(snow_step(grid, steps));
        assert_same_grids(expected, grid);
        snow_destroy(grid);
    }
}

/* What is left out makes no order, symmetry or extreme: vapour stays between 0 and β, and growth is still seen. */
static void a_tolerance_keeps_the_other_promises(void **state)
{
    (void)state;
    static const double tolerances[] = {1e-12, 1e-6, 1e-3, 1};
    for (size_t i = 0; i < COUNT_OF(tolerances) * COUNT_OF(precisions); i++) {
        snow_reiter_params params = disc_scene(0.4, 0.001, 1, 24);
        params.tolerance = tolerances[i / COUNT_OF(precisions)];
        params.precision = precisions[i % COUNT_OF(precisions)];
        snow_grid *grid = make_grid(&params, NULL);
        double level = value_at(grid, SNOW_FIELD_VAPOUR, 20, 0);
        for (int round = 0; round < 37; round++)
            assert_ok(snow_step(grid, 11));
        assert_same_with_a_tolerance(&params, grid, 37 * 11);
        assert_sound_numbers(grid);
        assert_same_double(0, defect_of(grid));
        assert_true(least_vapour(grid) >= 0 && greatest_vapour(grid) <= level);
        snow_destroy(grid);

        params = params_of(&wild_scenes[1], SNOW_REITER_ENGINE_ROWS, params.precision);
        params.tolerance = 1e-3 * params.background * tolerances[i / COUNT_OF(precisions)];
        grid = grow_until_unstable(&params, NULL, 1);
        assert_run_ends_there(&params, grid);
        snow_destroy(grid);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eight_thirds_is_the_last_diffusion_that_need_not_be_asked_for),
        cmocka_unit_test(up_to_eight_thirds_no_wave_grows),
        cmocka_unit_test(beyond_eight_thirds_the_worst_wave_grows_as_foretold),
        cmocka_unit_test(growth_ends_at_the_last_whole_step),
        cmocka_unit_test(all_ways_end_at_the_same_step),
        cmocka_unit_test(quad_stops_too),
        cmocka_unit_test(a_smaller_diffusion_goes_on),
        cmocka_unit_test(negative_vapour_outlives_its_diffusion),
        cmocka_unit_test(negative_vapour_belongs_to_diffusion_above_2),
        cmocka_unit_test(tiny_values_can_be_set),
        cmocka_unit_test(tiny_values_grow_alike),
        cmocka_unit_test(fields_of_zero_stay_zero),
        cmocka_unit_test(without_diffusion_only_additions_count),
        cmocka_unit_test(a_tolerance_keeps_the_other_promises),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
