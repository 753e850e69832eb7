/* Engine, instruction set, number of threads and parallel loop change no bit. */
#include "support/grids.h"
#include "support/loops.h"

#include <stdlib.h>

static const double diffusions[] = {0, 0.25, 0.5, 1, 1.5, 2, 2.003, 2.5, 8.0 / 3.0};
static const double additions[] = {0, 0.0001, 0.001, 0.01, 0.05, 0.1, 0.3, 1};
static const int64_t strides[] = {1, 2, 3, 17, 60};

static snow_options random_options(uint64_t *random, snow_isa isa)
{
    snow_options options = default_options();
    options.isa = isa;
    options.threads = (int32_t)next_below(random, 8) + 1;
    uint32_t loop = next_below(random, (uint32_t)test_loop_count + 1);
    if (loop < test_loop_count)
        options.parallel_for = test_loops[loop].run;
    return options;
}

/* Steps both in the same strides and compares every bit after each. */
static void assert_equal_growth_in(snow_reiter_precision precision, const snow_reiter_params *scene,
                                   const snow_options *options, int64_t rounds)
{
    snow_reiter_params params = *scene;
    params.precision = precision;
    params.engine = SNOW_REITER_ENGINE_REFERENCE;
    snow_grid *reference = make_grid(&params, NULL);
    params.engine = SNOW_REITER_ENGINE_ROWS;
    snow_grid *rows = make_grid(&params, options);
    for (int64_t i = 0; i < rounds; i++) {
        assert_same_grids(reference, rows);
        int64_t stride = strides[(size_t)i % COUNT_OF(strides)];
        assert_ok(snow_step(reference, stride));
        assert_ok(snow_step(rows, stride));
    }
    assert_same_grids(reference, rows);
    snow_destroy(reference);
    snow_destroy(rows);
}

static void assert_equal_growth(const snow_reiter_params *scene, const snow_options *options, int64_t rounds)
{
    assert_equal_growth_in(SNOW_REITER_PRECISION_DOUBLE, scene, options, rounds);
    assert_equal_growth_in(SNOW_REITER_PRECISION_SINGLE, scene, options, rounds);
}

static void assert_equal_growth_everywhere(const snow_reiter_params *scene)
{
    snow_isa isas[8];
    size_t count = available_isas(isas);
    for (size_t i = 0; i < count; i++) {
        for (int32_t threads = 1; threads <= 8; threads++) {
            snow_options options = default_options();
            options.isa = isas[i];
            options.threads = threads;
            assert_equal_growth(scene, &options, 4);
            options.parallel_for = test_loops[(size_t)threads % test_loop_count].run;
            assert_equal_growth(scene, &options, 4);
        }
    }
}

static void every_isa_thread_count_and_loop_on_a_disc(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 25);
    params.noise = 0.2;
    params.record_freeze_steps = 1;
    assert_equal_growth_everywhere(&params);
}

static void every_isa_thread_count_and_loop_on_a_rectangle(void **state)
{
    (void)state;
    snow_reiter_params params = rectangle_scene(0.6, 0.05, 2.3, 29, 23);
    params.noise = 0.1;
    params.cluster = 5;
    params.record_freeze_steps = 1;
    assert_equal_growth_everywhere(&params);
}

/* Rows that are shorter than a vector, or longer by any number of cells. */
static void every_width_of_row(void **state)
{
    (void)state;
    static const int32_t heights[] = {1, 2, 3, 7};
    snow_isa isas[8];
    size_t count = available_isas(isas);
    uint64_t random = 11;
    for (int32_t width = 1; width <= 35; width++) {
        for (size_t i = 0; i < COUNT_OF(heights); i++) {
            snow_reiter_params params = rectangle_scene(0.5, 0.01, 1, width, heights[i]);
            params.noise = 0.3;
            params.record_freeze_steps = 1;
            for (size_t j = 0; j < count; j++) {
                snow_options options = random_options(&random, isas[j]);
                assert_equal_growth(&params, &options, 4);
            }
        }
    }
}

static void every_small_disc_and_hexagon(void **state)
{
    (void)state;
    snow_isa isas[8];
    size_t count = available_isas(isas);
    uint64_t random = 12;
    for (int32_t radius = 1; radius <= 12; radius++) {
        snow_reiter_params scenes[] = {disc_scene(0.4, 0.02, 1, radius), hexagon_scene(0.4, 0.02, 2.1, radius)};
        for (size_t i = 0; i < COUNT_OF(scenes); i++) {
            scenes[i].noise = 0.3;
            for (size_t j = 0; j < count; j++) {
                snow_options options = random_options(&random, isas[j]);
                assert_equal_growth(&scenes[i], &options, 5);
            }
        }
    }
}

static double patchy_background(void *context, int32_t q, int32_t r)
{
    (void)context;
    return (double)((uint32_t)(q * 7 + r * 13) % 29) / 32;
}

static double patchy_addition(void *context, int32_t q, int32_t r)
{
    (void)context;
    return (double)((uint32_t)(q * 5 + r * 3) % 7) / 100;
}

/* Up to 6 seeds that lie inside, possibly none. */
static void scatter_seeds(snow_reiter_params *params, snow_cell seeds[6], uint64_t *random)
{
    params->seeds = seeds;
    params->seed_count = 0;
    snow_grid *empty = make_grid(params, NULL);
    size_t wanted = next_below(random, 7);
    for (int tries = 0; tries < 60 && params->seed_count < wanted; tries++) {
        snow_cell cell = {(int32_t)next_below(random, 31) - 15, (int32_t)next_below(random, 31) - 15};
        if (value_at(empty, SNOW_FIELD_INSIDE, cell.q, cell.r) == 1)
            seeds[params->seed_count++] = cell;
    }
    snow_destroy(empty);
}

static snow_reiter_params random_scene(uint64_t *random, snow_cell seeds[6])
{
    double background = next_below(random, 96) / 100.0;
    double addition = additions[next_below(random, COUNT_OF(additions))];
    double diffusion = diffusions[next_below(random, COUNT_OF(diffusions))];
    int32_t size = (int32_t)next_below(random, 24) + 1;
    int32_t other = (int32_t)next_below(random, 40) + 1;
    uint32_t shape = next_below(random, 3);
    snow_reiter_params params = shape == 0   ? disc_scene(background, addition, diffusion, size)
                                : shape == 1 ? hexagon_scene(background, addition, diffusion, size)
                                             : rectangle_scene(background, addition, diffusion, size, other);
    params.record_freeze_steps = (int32_t)next_below(random, 2);
    params.random_seed = next_below(random, 1000);
    if (next_below(random, 3) == 0) {
        double room = background < 0.5 ? background : 0.99 - background;
        params.noise = room * next_below(random, 100) / 100;
        params.noise_symmetric = (int32_t)next_below(random, 2);
    }
    if (next_below(random, 5) == 0) {
        params.noise = 0;
        params.background_at = patchy_background;
    }
    if (next_below(random, 5) == 0)
        params.addition_at = patchy_addition;
    switch (next_below(random, 4)) {
    case 0:
        params.cluster = size < other ? (size + 1) / 2 : (other + 1) / 2;
        break;
    case 1:
        scatter_seeds(&params, seeds, random);
        break;
    default:
        break;
    }
    return params;
}

static void random_scenes(void **state)
{
    (void)state;
    snow_isa isas[8];
    size_t count = available_isas(isas);
    uint64_t random = 2005;
    for (int scene = 0; scene < 80; scene++) {
        snow_cell seeds[6];
        snow_reiter_params params = random_scene(&random, seeds);
        for (size_t i = 0; i < count; i++) {
            snow_options options = random_options(&random, isas[i]);
            assert_equal_growth(&params, &options, 6);
        }
    }
}

/* Takes several steps in one pass where it can, and, with two threads, single steps. */
static void assert_passes_equal_steps(const snow_reiter_params *scene)
{
    snow_options options = default_options();
    snow_grid *passes = make_grid(scene, &options);
    options.threads = 2;
    snow_grid *steps = make_grid(scene, &options);
    static const int64_t some_steps[] = {6, 17, 40};
    for (size_t i = 0; i < COUNT_OF(some_steps); i++) {
        assert_ok(snow_step(passes, some_steps[i]));
        assert_ok(snow_step(steps, some_steps[i]));
        assert_true(digest_of(steps) == digest_of(passes));
    }
    assert_int_equal(frozen_of(steps), frozen_of(passes));
    snow_destroy(passes);
    snow_destroy(steps);
}

/* More than 4 MB of vapour in motion, wider than a strip, ice on the strips' borders and mirrors through them. */
static void fields_larger_than_a_cache(void **state)
{
    (void)state;
    enum { SEEDS = 41, APART = 97 };
    snow_cell seeds[SEEDS];
    for (int32_t i = 0; i < SEEDS; i++)
        seeds[i] = (snow_cell){(i - SEEDS / 2) * APART, 0};
    snow_reiter_params noisy = rectangle_scene(0.5, 0.05, 1, 4201, 81);
    noisy.seeds = seeds;
    noisy.seed_count = SEEDS;
    noisy.noise = 0.3;
    assert_passes_equal_steps(&noisy);
    noisy.width = 8401;
    noisy.precision = SNOW_REITER_PRECISION_SINGLE;
    assert_passes_equal_steps(&noisy);
    snow_reiter_params folded = rectangle_scene(0.5, 0.05, 1, 8401, 161);
    folded.seeds = seeds;
    folded.seed_count = SEEDS;
    folded.noise = 0.3;
    folded.noise_symmetric = 1;
    assert_passes_equal_steps(&folded);
    folded.width = 16801;
    folded.precision = SNOW_REITER_PRECISION_SINGLE;
    assert_passes_equal_steps(&folded);
    snow_reiter_params disc = disc_scene(0.6, 0.2, 1.5, 1050);
    disc.noise = 0.2;
    disc.noise_symmetric = 1;
    disc.symmetry = SNOW_REITER_SYMMETRY_AUTO;
    assert_passes_equal_steps(&disc);
}

/* A run with passes ends as one with two threads does, where no pass is taken: why? */
static snow_stop_reason both_ends(const snow_reiter_params *params, const snow_stop *stop)
{
    snow_options options = default_options();
    snow_grid *passes = make_grid(params, &options);
    options.threads = 2;
    snow_grid *steps = make_grid(params, &options);
    snow_summary expected = run_grid(steps, stop);
    snow_summary summary = run_grid(passes, stop);
    assert_int_equal(expected.reason, summary.reason);
    assert_int_equal(expected.steps, summary.steps);
    assert_int_equal(expected.frozen, summary.frozen);
    assert_true(digest_of(steps) == digest_of(passes));
    snow_destroy(steps);
    snow_destroy(passes);
    return summary.reason;
}

/* A pass must not step past the end of a run. */
static void a_pass_stops_where_single_steps_stop(void **state)
{
    (void)state;
    snow_reiter_params params = rectangle_scene(0.5, 0.3, 1, 530, 530);
    params.noise = 0.3;
    const double radii[] = {20, 21.5, 33};
    for (size_t i = 0; i < COUNT_OF(radii); i++) {
        for (uint64_t frozen = 0; frozen <= 900; frozen += 900) {
            snow_stop stop = default_stop();
            stop.tip_radius = radii[i];
            stop.frozen = frozen;
            snow_stop_reason reason = both_ends(&params, &stop);
            assert_true(reason == SNOW_STOP_RADIUS || (frozen > 0 && reason == SNOW_STOP_FROZEN));
        }
    }
}

/* Nor past the step in which ice comes near the rim, however the domain says where that is. */
static void a_pass_stops_at_every_rim(void **state)
{
    (void)state;
    static const snow_cell inward[] = {{500, 0}}, low[] = {{0, -200}};
    snow_reiter_params scenes[] = {disc_scene(0.5, 0.3, 1, 530), hexagon_scene(0.5, 0.3, 1, 530),
                                   rectangle_scene(0.5, 0.3, 1, 1050, 530)};
    scenes[2].rim = SNOW_REITER_RIM_ROW;
    snow_stop stop = default_stop();
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        scenes[i].noise = 0.3;
        scenes[i].seeds = i < 2 ? inward : low;
        scenes[i].seed_count = 1;
        assert_int_equal(SNOW_STOP_RIM, both_ends(&scenes[i], &stop));
    }
}

/* Quiet on one side, where fast ice wakes the cells before it; so restless on the other that passes are worth it. */
static double half_restless(void *context, int32_t q, int32_t r)
{
    (void)context;
    return q < 0 ? 0.2 + ((q * 31 + r * 17) & 63) / 128.0 : 0.3;
}

static void ice_wakes_quiet_cells_within_a_pass(void **state)
{
    (void)state;
    static const snow_cell seeds[] = {{600, 0}, {-600, 5}};
    snow_reiter_params params = rectangle_scene(0, 1, 1, 2401, 601);
    params.background_at = half_restless;
    params.seeds = seeds;
    params.seed_count = COUNT_OF(seeds);
    assert_passes_equal_steps(&params);
}

/* The lattice in three colours, none next to itself: a cell of the first has six neighbours of the others. */
static double three_colours(void *context, int32_t q, int32_t r)
{
    const double *colours = context;
    int32_t colour = ((q - r) % 3 + 3) % 3;
    return colour == 0 ? colours[0] + (double)(q % 5) / 1024 : colours[1];
}

/* With α > 2 vapour overshoots: v′ = 1.3·mean − 0.3·v for α = 2.6. */
static snow_reiter_params overshooting_scene(double colours[2])
{
    snow_reiter_params params = disc_scene(0.5, 0.001, 2.6, 15);
    without_seeds(&params);
    params.background_at = three_colours;
    params.field_context = colours;
    params.record_freeze_steps = 1;
    return params;
}

static void assert_equal_growth_on_all_isas(const snow_reiter_params *params)
{
    snow_isa isas[8];
    size_t count = available_isas(isas);
    uint64_t random = 13;
    for (size_t i = 0; i < count; i++) {
        snow_options options = random_options(&random, isas[i]);
        assert_equal_growth(params, &options, 7);
    }
}

static void vapour_freezes_by_itself(void **state)
{
    (void)state;
    double colours[2] = {0.96, 0.99};
    snow_reiter_params params = overshooting_scene(colours);
    snow_grid *grid = make_grid(&params, NULL);
    uint64_t cells = cells_of(grid);
    assert_int_equal(0, frozen_of(grid));
    assert_ok(snow_step(grid, 1));
    /* 1.287 - 0.3 * 0.96 falls short of 1; 4/1024 less in the first colour is enough. */
    assert_true(frozen_of(grid) > cells / 60);
    assert_true(frozen_of(grid) < cells / 20);
    snow_destroy(grid);
    assert_equal_growth_on_all_isas(&params);
}

static void vapour_falls_below_zero(void **state)
{
    (void)state;
    double colours[2] = {0.9, 0.1};
    snow_reiter_params params = overshooting_scene(colours);
    snow_grid *grid = make_grid(&params, NULL);
    assert_ok(snow_step(grid, 1));
    size_t count;
    double *values = copy_field(grid, SNOW_FIELD_VALUE, NULL, &count);
    size_t below = 0;
    for (size_t i = 0; i < count; i++)
        below += values[i] < 0;
    assert_true(below > 200);
    free(values);
    snow_destroy(grid);
    assert_equal_growth_on_all_isas(&params);

    static const snow_cell seed = {2, 1};
    params.seeds = &seed;
    params.seed_count = 1;
    assert_equal_growth_on_all_isas(&params);
}

/* By REFERENCE, and by ROWS on each instruction set: until the end of a run. */
static void whole_runs(void **state)
{
    (void)state;
    snow_isa isas[8];
    size_t count = available_isas(isas);
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 60);
    params.record_freeze_steps = 1;
    params.engine = SNOW_REITER_ENGINE_REFERENCE;
    snow_grid *reference = make_grid(&params, NULL);
    snow_summary expected = run_grid(reference, NULL);
    assert_int_equal(SNOW_STOP_RIM, expected.reason);
    for (size_t i = 0; i < count; i++) {
        params.engine = SNOW_REITER_ENGINE_ROWS;
        snow_options options = default_options();
        options.isa = isas[i];
        options.threads = (int32_t)i + 2;
        snow_grid *rows = make_grid(&params, &options);
        snow_summary got = run_grid(rows, NULL);
        assert_int_equal(expected.reason, got.reason);
        assert_same_grids(reference, rows);
        snow_destroy(rows);
    }
    snow_destroy(reference);
}

static void auto_is_a_fast_engine_with_the_same_bits(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 30);
    params.engine = SNOW_REITER_ENGINE_ROWS;
    snow_grid *rows = make_grid(&params, NULL);
    params.engine = SNOW_REITER_ENGINE_AUTO;
    snow_grid *automatic = make_grid(&params, NULL);
    assert_ok(snow_step(rows, 150));
    assert_ok(snow_step(automatic, 150));
    assert_same_grids(rows, automatic);
    snow_destroy(rows);
    snow_destroy(automatic);
}

/* To the stop: which cells are ice does not depend on rounding. */
static void ice_equals_that_of_quad(void **state)
{
    (void)state;
    snow_reiter_params scenes[] = {
        disc_scene(0.4, 0.001, 1, 40),  disc_scene(0.6, 0.01, 1, 45),     disc_scene(0.95, 0.05, 1, 40),
        disc_scene(0.5, 0.001, 2.6, 40), hexagon_scene(0.4, 0.01, 0.5, 40), rectangle_scene(0.35, 0.05, 1, 50, 50),
        disc_scene(0.4, 0.005, 1, 40),
    };
    scenes[COUNT_OF(scenes) - 1].noise = 0.1;
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        scenes[i].record_freeze_steps = 1;
        scenes[i].engine = SNOW_REITER_ENGINE_QUAD;
        snow_grid *quad = make_grid(&scenes[i], NULL);
        snow_summary expected = run_grid(quad, NULL);
        scenes[i].engine = SNOW_REITER_ENGINE_AUTO;
        snow_grid *grid = make_grid(&scenes[i], NULL);
        snow_summary got = run_grid(grid, NULL);
        assert_int_equal(expected.reason, got.reason);
        assert_int_equal(expected.steps, got.steps);
        assert_same_ice(quad, grid);
        size_t count;
        double *left = copy_field(quad, SNOW_FIELD_FREEZE_STEP, NULL, &count);
        double *right = copy_field(grid, SNOW_FIELD_FREEZE_STEP, NULL, NULL);
        assert_memory_equal(left, right, count * sizeof *left);
        free(left);
        free(right);
        snow_destroy(quad);
        snow_destroy(grid);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_isa_thread_count_and_loop_on_a_disc),
        cmocka_unit_test(every_isa_thread_count_and_loop_on_a_rectangle),
        cmocka_unit_test(every_width_of_row),
        cmocka_unit_test(every_small_disc_and_hexagon),
        cmocka_unit_test(random_scenes),
        cmocka_unit_test(fields_larger_than_a_cache),
        cmocka_unit_test(a_pass_stops_where_single_steps_stop),
        cmocka_unit_test(a_pass_stops_at_every_rim),
        cmocka_unit_test(ice_wakes_quiet_cells_within_a_pass),
        cmocka_unit_test(vapour_freezes_by_itself),
        cmocka_unit_test(vapour_falls_below_zero),
        cmocka_unit_test(whole_runs),
        cmocka_unit_test(auto_is_a_fast_engine_with_the_same_bits),
        cmocka_unit_test(ice_equals_that_of_quad),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
