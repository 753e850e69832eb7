/* Steps and runs: slices, stop conditions, their order, progress and cancelling. */
#include "support/grids.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

static void steps_add_up(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.005, 1, 30);
    params.noise = 0.05;
    params.record_freeze_steps = 1;
    snow_grid *whole = make_grid(&params, NULL);
    assert_ok(snow_step(whole, 200));
    static const int64_t slices[][4] = {{200, 0, 0, 0}, {1, 199, 0, 0}, {63, 1, 1, 135}, {100, 50, 25, 25}};
    for (size_t i = 0; i < COUNT_OF(slices); i++) {
        snow_grid *grid = make_grid(&params, NULL);
        for (size_t j = 0; j < COUNT_OF(slices[i]); j++)
            assert_ok(snow_step(grid, slices[i][j]));
        assert_same_grids(whole, grid);
        snow_destroy(grid);
    }
    snow_grid *single = make_grid(&params, NULL);
    for (int64_t i = 0; i < 200; i++) {
        assert_int_equal(i, steps_of(single));
        assert_ok(snow_step(single, 1));
    }
    assert_same_grids(whole, single);
    snow_destroy(single);
    snow_destroy(whole);
}

static void a_run_of_n_steps_is_n_steps(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.005, 1, 30);
    snow_grid *stepped = make_grid(&params, NULL);
    snow_grid *ran = make_grid(&params, NULL);
    assert_ok(snow_step(stepped, 130));
    snow_stop stop = stop_after(130);
    snow_summary summary = run_grid(ran, &stop);
    assert_int_equal(SNOW_STOP_STEPS, summary.reason);
    assert_int_equal(130, summary.steps);
    assert_same_grids(stepped, ran);
    /* Started again, it is over at once. */
    summary = run_grid(ran, &stop);
    assert_int_equal(SNOW_STOP_STEPS, summary.reason);
    assert_same_grids(stepped, ran);
    snow_destroy(stepped);
    snow_destroy(ran);
}

static void a_run_in_slices_ends_like_one_run(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.005, 1, 30);
    snow_grid *whole = make_grid(&params, NULL);
    snow_summary expected = run_grid(whole, NULL);
    assert_int_equal(SNOW_STOP_RIM, expected.reason);
    snow_grid *sliced = make_grid(&params, NULL);
    snow_stop stop = default_stop();
    snow_summary summary;
    stop.max_steps = 0;
    do {
        stop.max_steps += 37;
        summary = run_grid(sliced, &stop);
    } while (summary.reason == SNOW_STOP_STEPS);
    assert_int_equal(SNOW_STOP_RIM, summary.reason);
    assert_same_grids(whole, sliced);
    summary = run_grid(sliced, NULL);
    assert_int_equal(SNOW_STOP_RIM, summary.reason);
    assert_same_grids(whole, sliced);
    snow_destroy(whole);
    snow_destroy(sliced);
}

static void defaults_are_the_documented_ones(void **state)
{
    (void)state;
    snow_stop stop = default_stop();
    assert_int_equal(sizeof stop, stop.struct_size);
    assert_int_equal(10000, stop.max_steps);
    assert_int_equal(1, stop.rim);
    assert_int_equal(1, stop.still);
    assert_same_double(0.0, stop.tip_radius);
    assert_int_equal(0, stop.frozen);
    assert_same_double(0.0, stop.seconds);
    assert_true(stop.progress == NULL);
    assert_null(stop.progress_context);
    assert_int_equal(100, stop.progress_steps);

    snow_reiter_params params = disc_scene(0, 0.5, 1, 9);
    snow_grid *left = make_grid(&params, NULL);
    snow_grid *right = make_grid(&params, NULL);
    run_grid(left, NULL);
    run_grid(right, &stop);
    assert_same_grids(left, right);
    snow_destroy(left);
    snow_destroy(right);
}

/* The paper's rim: any ice at distance >= R - 2, not a step earlier. */
static void the_rim_of_a_disc(void **state)
{
    (void)state;
    for (int32_t radius = 1; radius <= 25; radius++) {
        snow_reiter_params params = disc_scene(0.4, 0.05, 1, radius);
        snow_grid *grid = make_grid(&params, NULL);
        snow_stop stop = default_stop();
        double last_tip = 0;
        while (run_grid(grid, &stop).reason != SNOW_STOP_RIM) {
        }
        assert_true(tip_of(grid) >= radius - 2);
        int64_t steps = steps_of(grid);
        snow_destroy(grid);
        if (radius <= 2) {
            assert_int_equal(0, steps);
            continue;
        }
        grid = make_grid(&params, NULL);
        assert_ok(snow_step(grid, steps - 1));
        last_tip = tip_of(grid);
        assert_true(last_tip < radius - 2);
        snow_destroy(grid);
    }
}

/* β = 0, γ = 1: ring k freezes in step k, so that every rule can be told in advance. */
static void the_rim_of_a_hexagon(void **state)
{
    (void)state;
    for (int32_t radius = 3; radius <= 20; radius++) {
        snow_reiter_params params = hexagon_scene(0, 1, 1, radius);
        snow_grid *grid = make_grid(&params, NULL);
        snow_summary summary = run_grid(grid, NULL);
        assert_int_equal(SNOW_STOP_RIM, summary.reason);
        assert_int_equal(radius - 2, summary.steps);
        snow_destroy(grid);
    }
}

static bool in_outer_two(const snow_grid *grid, int32_t q, int32_t r)
{
    static const snow_cell across[] = {{2, 0}, {-2, 0}};
    for (size_t i = 0; i < COUNT_OF(across); i++)
        if (value_at(grid, SNOW_FIELD_INSIDE, q + across[i].q, r) == 0)
            return true;
    snow_rect bounds = bounds_of(grid);
    return r < bounds.r + 2 || r >= bounds.r + bounds.height - 2;
}

static void the_rim_of_a_rectangle(void **state)
{
    (void)state;
    static const int32_t sizes[][2] = {{9, 30}, {30, 9}, {12, 13}, {13, 12}, {5, 5}, {2, 20}, {20, 4}};
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        snow_reiter_params params = rectangle_scene(0, 1, 1, sizes[i][0], sizes[i][1]);
        snow_grid *grid = make_grid(&params, NULL);
        for (;;) {
            bool near = false;
            snow_rect bounds = bounds_of(grid);
            for (int32_t r = bounds.r; r < bounds.r + bounds.height; r++)
                for (int32_t q = bounds.q; q < bounds.q + bounds.width; q++)
                    near = near || (value_at(grid, SNOW_FIELD_FROZEN, q, r) == 1 && in_outer_two(grid, q, r));
            snow_stop stop = default_stop();
            stop.max_steps = steps_of(grid) + 1;
            int64_t before = steps_of(grid);
            snow_summary summary = run_grid(grid, &stop);
            if (near) {
                assert_int_equal(SNOW_STOP_RIM, summary.reason);
                assert_int_equal(before, summary.steps);
                break;
            }
            assert_int_equal(before + 1, summary.steps);
        }
        snow_destroy(grid);
    }
}

/* Połuszejko and Grabiński: ice in row floor(F / 35), counted from 1, or above. */
static void the_row_rule(void **state)
{
    (void)state;
    static const int32_t heights[] = {34, 35, 70, 105, 139, 140};
    for (size_t i = 0; i < COUNT_OF(heights); i++) {
        int32_t height = heights[i];
        snow_reiter_params params = rectangle_scene(0, 1, 1, 200, height);
        params.rim = SNOW_REITER_RIM_ROW;
        snow_grid *grid = make_grid(&params, NULL);
        snow_stop stop = default_stop();
        stop.max_steps = 500;
        snow_summary summary = run_grid(grid, &stop);
        int32_t row = height / 35;
        if (row == 0) {
            assert_int_not_equal(SNOW_STOP_RIM, summary.reason);
        } else {
            assert_int_equal(SNOW_STOP_RIM, summary.reason);
            /* The seed stands in row height/2 + 1, counted from 1, and one row freezes in each step. */
            assert_int_equal(height / 2 + 1 - row, summary.steps);
        }
        snow_destroy(grid);
    }
}

static void tip_radius_and_frozen_count_end_a_run(void **state)
{
    (void)state;
    snow_reiter_params params = hexagon_scene(0, 1, 1, 30);
    for (int32_t ring = 1; ring <= 12; ring++) {
        snow_grid *grid = make_grid(&params, NULL);
        snow_stop stop = default_stop();
        stop.tip_radius = ring;
        snow_summary summary = run_grid(grid, &stop);
        assert_int_equal(SNOW_STOP_RADIUS, summary.reason);
        assert_int_equal(ring, summary.steps);
        stop.tip_radius = nextafter(ring, 100);
        summary = run_grid(grid, &stop);
        assert_int_equal(ring + 1, summary.steps);
        snow_destroy(grid);

        grid = make_grid(&params, NULL);
        stop = default_stop();
        stop.frozen = 3 * (uint64_t)ring * ((uint64_t)ring + 1) + 1;
        summary = run_grid(grid, &stop);
        assert_int_equal(SNOW_STOP_FROZEN, summary.reason);
        assert_int_equal(ring, summary.steps);
        stop.frozen++;
        summary = run_grid(grid, &stop);
        assert_int_equal(ring + 1, summary.steps);
        snow_destroy(grid);
    }
}

static void a_run_can_be_over_before_its_first_step(void **state)
{
    (void)state;
    snow_reiter_params params = hexagon_scene(0.4, 0.01, 1, 10);
    snow_grid *grid = make_grid(&params, NULL);
    snow_stop stop = default_stop();
    stop.max_steps = 0;
    assert_int_equal(SNOW_STOP_STEPS, run_grid(grid, &stop).reason);
    stop.frozen = 1;
    assert_int_equal(SNOW_STOP_FROZEN, run_grid(grid, &stop).reason);
    assert_int_equal(0, steps_of(grid));
    snow_destroy(grid);
}

static void nothing_ever_changes_where_there_is_nothing_to_gain(void **state)
{
    (void)state;
    const snow_reiter_engine engines[] = {SNOW_REITER_ENGINE_ROWS, SNOW_REITER_ENGINE_REFERENCE,
                                          SNOW_REITER_ENGINE_QUAD};
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_reiter_params params = disc_scene(0, 0, 1, 12);
        params.engine = engines[i];
        snow_grid *grid = make_grid(&params, NULL);
        snow_summary summary = run_grid(grid, NULL);
        assert_int_equal(SNOW_STOP_STILL, summary.reason);
        assert_int_equal(1, summary.steps);
        assert_int_equal(1, summary.frozen);

        snow_stop stop = default_stop();
        stop.still = 0;
        stop.max_steps = 1000;
        summary = run_grid(grid, &stop);
        assert_int_equal(SNOW_STOP_STEPS, summary.reason);
        assert_int_equal(1, summary.frozen);
        assert_same_double(1.0, value_at(grid, SNOW_FIELD_VALUE, 0, 0));
        snow_destroy(grid);

        /* No ice at all. */
        params = disc_scene(0.4, 0.1, 1, 12);
        params.engine = engines[i];
        without_seeds(&params);
        grid = make_grid(&params, NULL);
        summary = run_grid(grid, NULL);
        assert_int_equal(SNOW_STOP_STILL, summary.reason);
        snow_destroy(grid);
    }
}

/* Looked for in step 1 and in each 64th, so that a full hexagon of 31 rings is found still in step 64. */
static void a_full_domain_is_still(void **state)
{
    (void)state;
    snow_reiter_params params = hexagon_scene(0, 1, 1, 32);
    snow_grid *grid = make_grid(&params, NULL);
    snow_stop stop = default_stop();
    stop.rim = 0;
    snow_summary summary = run_grid(grid, &stop);
    assert_int_equal(SNOW_STOP_STILL, summary.reason);
    assert_int_equal(64, summary.steps);
    assert_int_equal(3 * 31 * 32 + 1, summary.frozen);
    snow_destroy(grid);

    /* In slices, and with steps of which nothing is asked, at the same step. */
    grid = make_grid(&params, NULL);
    assert_ok(snow_step(grid, 61));
    for (stop.max_steps = 62; stop.max_steps < 70; stop.max_steps++) {
        summary = run_grid(grid, &stop);
        assert_int_equal(stop.max_steps < 64 ? SNOW_STOP_STEPS : SNOW_STOP_STILL, summary.reason);
    }
    assert_int_equal(64, summary.steps);
    snow_destroy(grid);
}

/* A crystal that can still freeze something must never be called still. */
static void slow_growth_is_not_still(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0, 0.0005, 1, 6);
    snow_grid *grid = make_grid(&params, NULL);
    snow_summary summary = run_grid(grid, NULL);
    assert_int_equal(SNOW_STOP_RIM, summary.reason);
    assert_int_equal(4 * 2000, summary.steps);
    snow_destroy(grid);
}

/* Every condition holds after step 64; taking away the first leaves the next. */
static void conditions_have_an_order(void **state)
{
    (void)state;
    snow_reiter_params params = hexagon_scene(0, 1, 1, 32);
    snow_stop stop = default_stop();
    stop.max_steps = 64;
    stop.tip_radius = 30;
    stop.frozen = 1000;
    const snow_stop_reason order[] = {SNOW_STOP_RIM, SNOW_STOP_RADIUS, SNOW_STOP_FROZEN, SNOW_STOP_STILL,
                                      SNOW_STOP_STEPS};
    for (size_t i = 0; i < COUNT_OF(order); i++) {
        snow_grid *grid = make_grid(&params, NULL);
        assert_ok(snow_step(grid, 64));
        assert_int_equal(order[i], run_grid(grid, &stop).reason);
        assert_int_equal(64, steps_of(grid));
        switch (order[i]) {
        case SNOW_STOP_RIM: stop.rim = 0; break;
        case SNOW_STOP_RADIUS: stop.tip_radius = 0; break;
        case SNOW_STOP_FROZEN: stop.frozen = 0; break;
        case SNOW_STOP_STILL: stop.still = 0; break;
        default: break;
        }
        snow_destroy(grid);
    }
}

/* What a progress callback saw, and when it is to say stop. */
typedef struct progress_log {
    size_t calls;
    size_t cancel_at; /* the call that answers 1; 0: none */
    int64_t last_steps;
    int64_t stride;
    double last_seconds;
} progress_log;

static int log_progress(void *context, const snow_grid *grid, const snow_summary *summary)
{
    progress_log *log = context;
    log->calls++;
    assert_int_equal(sizeof *summary, summary->struct_size);
    assert_int_equal(SNOW_STOP_NONE, summary->reason);
    assert_int_equal(steps_of(grid), summary->steps);
    assert_int_equal(frozen_of(grid), summary->frozen);
    assert_same_double(tip_of(grid), summary->tip_radius);
    assert_true(summary->seconds >= log->last_seconds);
    if (log->calls > 1)
        assert_int_equal(log->last_steps + log->stride, summary->steps);
    log->last_steps = summary->steps;
    log->last_seconds = summary->seconds;
    return log->calls == log->cancel_at;
}

static void progress_is_called_in_equal_strides(void **state)
{
    (void)state;
    static const int64_t strides[] = {1, 2, 7, 64, 100, 1000, INT64_MAX};
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 30);
    snow_grid *plain = make_grid(&params, NULL);
    assert_ok(snow_step(plain, 200));
    for (size_t i = 0; i < COUNT_OF(strides); i++) {
        progress_log log = {.stride = strides[i]};
        snow_grid *grid = make_grid(&params, NULL);
        snow_stop stop = stop_after(200);
        stop.progress = log_progress;
        stop.progress_context = &log;
        stop.progress_steps = strides[i];
        assert_int_equal(SNOW_STOP_STEPS, run_grid(grid, &stop).reason);
        assert_int_equal(200 / strides[i], log.calls);
        assert_same_grids(plain, grid);
        snow_destroy(grid);
    }
    snow_destroy(plain);
}

static void every_call_of_progress_can_cancel(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 20);
    snow_grid *plain = make_grid(&params, NULL);
    assert_ok(snow_step(plain, 60));
    for (size_t call = 1; call <= 11; call++) {
        progress_log log = {.stride = 5, .cancel_at = call};
        snow_grid *grid = make_grid(&params, NULL);
        snow_stop stop = stop_after(60);
        stop.progress = log_progress;
        stop.progress_context = &log;
        stop.progress_steps = 5;
        snow_summary summary = run_grid(grid, &stop);
        assert_int_equal(SNOW_STOP_CANCELLED, summary.reason);
        assert_int_equal(call, log.calls);
        assert_int_equal(5 * call, summary.steps);

        /* And goes on where it was. */
        log = (progress_log){.stride = 5};
        assert_int_equal(SNOW_STOP_STEPS, run_grid(grid, &stop).reason);
        assert_int_equal(12 - call, log.calls);
        assert_same_grids(plain, grid);
        snow_destroy(grid);
    }
    snow_destroy(plain);
}

/* When the last step is reached as well, it was not the callback that ended the run. */
static void cancelling_after_the_last_step_is_not_cancelling(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 20);
    snow_grid *grid = make_grid(&params, NULL);
    progress_log log = {.stride = 10, .cancel_at = 2};
    snow_stop stop = stop_after(20);
    stop.progress = log_progress;
    stop.progress_context = &log;
    stop.progress_steps = 10;
    assert_int_equal(SNOW_STOP_STEPS, run_grid(grid, &stop).reason);
    snow_destroy(grid);
}

static int count_bytes(void *context, const void *bytes, size_t size)
{
    (void)bytes;
    *(size_t *)context += size;
    return 0;
}

/* A callback that tries everything. */
static int meddle(void *context, const snow_grid *grid, const snow_summary *summary)
{
    snow_grid *mine = *(snow_grid **)context;
    (void)summary;
    assert_ptr_equal(mine, grid);
    uint64_t before = digest_of(grid);
    double number = 0.5;
    snow_rect cell = {3, 0, 1, 1};
    snow_reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    assert_status(SNOW_ERROR_BUSY, snow_step(mine, 1));
    assert_status(SNOW_ERROR_BUSY, snow_step(mine, 0));
    assert_status(SNOW_ERROR_BUSY, snow_run(mine, NULL, NULL));
    assert_status(SNOW_ERROR_BUSY, snow_reiter_change(mine, &conditions));
    assert_status(SNOW_ERROR_BUSY, snow_field_set(mine, SNOW_FIELD_VALUE, &cell, &number, 1));
    assert_status(SNOW_ERROR_BUSY, snow_field_set(mine, SNOW_FIELD_VAPOUR, &cell, &number, 1));
    assert_status(SNOW_ERROR_BUSY, snow_field_set(mine, SNOW_FIELD_ADDITION, &cell, &number, 1));
    assert_status(SNOW_ERROR_BUSY, snow_field_set(mine, SNOW_FIELD_BACKGROUND, &cell, &number, 1));

    size_t size = 0, written = 0;
    assert_ok(snow_save(grid, NULL, 0, &size));
    assert_ok(snow_save_to(grid, count_bytes, &written));
    assert_int_equal(size, written);
    void *buffer = malloc(size);
    assert_non_null(buffer);
    assert_ok(snow_save(grid, buffer, size, &size));
    snow_grid *copy = NULL;
    assert_ok(snow_load(buffer, size, NULL, &copy));
    assert_same_grids(grid, copy);
    assert_ok(snow_step(copy, 1));
    snow_destroy(copy);
    free(buffer);

    free(copy_field(grid, SNOW_FIELD_VALUE, NULL, NULL));
    double vapour, ice;
    assert_ok(snow_mass(grid, &vapour, &ice));
    assert_true(defect_of(grid) == 0);
    assert_ok(snow_reiter_conditions_of(grid, &conditions));
    assert_true(before == digest_of(grid));
    return 0;
}

static void a_callback_may_ask_but_not_change(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 15);
    snow_grid *grid = make_grid(&params, NULL);
    snow_grid *plain = make_grid(&params, NULL);
    assert_ok(snow_step(plain, 30));
    snow_stop stop = stop_after(30);
    stop.progress = meddle;
    stop.progress_context = &grid;
    stop.progress_steps = 6;
    assert_int_equal(SNOW_STOP_STEPS, run_grid(grid, &stop).reason);
    assert_same_grids(plain, grid);
    /* Free again. */
    assert_ok(snow_step(grid, 1));
    snow_destroy(grid);
    snow_destroy(plain);
}

static void a_time_budget_ends_a_run_and_it_can_go_on(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 40);
    snow_grid *whole = make_grid(&params, NULL);
    snow_summary expected = run_grid(whole, NULL);
    snow_grid *grid = make_grid(&params, NULL);
    snow_stop stop = default_stop();
    stop.seconds = 1e-9;
    snow_summary summary;
    int64_t last = 0;
    while ((summary = run_grid(grid, &stop)).reason == SNOW_STOP_TIME) {
        assert_true(summary.seconds >= stop.seconds);
        assert_true(summary.steps > last);
        last = summary.steps;
    }
    assert_int_equal(expected.reason, summary.reason);
    assert_same_grids(whole, grid);
    snow_destroy(grid);
    snow_destroy(whole);

    /* A run without another end. */
    params = disc_scene(0.4, 0.001, 1, 5);
    grid = make_grid(&params, NULL);
    stop = stop_after(-1);
    stop.seconds = 0.02;
    summary = run_grid(grid, &stop);
    assert_int_equal(SNOW_STOP_TIME, summary.reason);
    assert_true(summary.seconds >= 0.02);
    assert_true(summary.steps > 1);
    snow_destroy(grid);
}

static void conditions_that_make_no_sense_are_refused(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 5);
    snow_grid *grid = make_grid(&params, NULL);
    uint64_t digest = digest_of(grid);
    snow_summary summary;
    snow_summary_init(&summary, sizeof summary);
    const double not_finite[] = {NAN, -NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < COUNT_OF(not_finite); i++) {
        snow_stop stop = default_stop();
        stop.tip_radius = not_finite[i];
        assert_status(SNOW_ERROR_NOT_FINITE, snow_run(grid, &stop, &summary));
        stop = default_stop();
        stop.seconds = not_finite[i];
        assert_status(SNOW_ERROR_NOT_FINITE, snow_run(grid, &stop, &summary));
    }
    const int32_t bad_flags[] = {-1, 2, INT32_MAX, INT32_MIN};
    for (size_t i = 0; i < COUNT_OF(bad_flags); i++) {
        snow_stop stop = default_stop();
        stop.rim = bad_flags[i];
        assert_status(SNOW_ERROR_RANGE, snow_run(grid, &stop, &summary));
        stop = default_stop();
        stop.still = bad_flags[i];
        assert_status(SNOW_ERROR_RANGE, snow_run(grid, &stop, &summary));
    }
    const int64_t bad_counts[] = {-2, INT64_MIN};
    for (size_t i = 0; i < COUNT_OF(bad_counts); i++) {
        snow_stop stop = default_stop();
        stop.max_steps = bad_counts[i];
        assert_status(SNOW_ERROR_RANGE, snow_run(grid, &stop, &summary));
        assert_status(SNOW_ERROR_RANGE, snow_step(grid, bad_counts[i]));
    }
    const int64_t bad_strides[] = {0, -1, INT64_MIN};
    for (size_t i = 0; i < COUNT_OF(bad_strides); i++) {
        snow_stop stop = default_stop();
        stop.progress_steps = bad_strides[i];
        assert_status(SNOW_ERROR_RANGE, snow_run(grid, &stop, &summary));
    }
    snow_stop stop = default_stop();
    stop.tip_radius = -1;
    assert_status(SNOW_ERROR_RANGE, snow_run(grid, &stop, &summary));
    stop = default_stop();
    stop.seconds = -1e-300;
    assert_status(SNOW_ERROR_RANGE, snow_run(grid, &stop, &summary));
    assert_status(SNOW_ERROR_NULL, snow_run(NULL, NULL, NULL));
    assert_status(SNOW_ERROR_NULL, snow_step(NULL, 1));

    /* None of them touched anything. */
    assert_int_equal(0, summary.steps);
    assert_int_equal(SNOW_STOP_NONE, summary.reason);
    assert_true(digest == digest_of(grid));
    assert_ok(snow_run(grid, NULL, NULL));
    snow_destroy(grid);
    snow_destroy(NULL);
}

/* With α = 4 the three-coloured mode is multiplied by 1 − 0.75·4 = −2 in each step. */
static void a_field_that_grows_without_bound_is_stopped(void **state)
{
    (void)state;
    const snow_reiter_engine engines[] = {SNOW_REITER_ENGINE_ROWS, SNOW_REITER_ENGINE_REFERENCE,
                                          SNOW_REITER_ENGINE_QUAD};
    uint64_t digests[3];
    int64_t ends[3];
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_reiter_params params = disc_scene(0.4, 0.0001, 4, 20);
        params.allow_unstable = 1;
        params.noise = 0.2;
        params.engine = engines[i];
        snow_grid *grid = make_grid(&params, NULL);
        snow_stop stop = stop_after(5000);
        snow_summary summary;
        snow_summary_init(&summary, sizeof summary);
        snow_status status = snow_run(grid, &stop, &summary);
        if (status == SNOW_ERROR_UNSTABLE) {
            assert_int_equal(SNOW_STOP_UNSTABLE, summary.reason);
            assert_int_equal(steps_of(grid), summary.steps);
            uint64_t digest = digest_of(grid);
            assert_status(SNOW_ERROR_UNSTABLE, snow_step(grid, 1));
            assert_true(digest == digest_of(grid));
            assert_int_equal(summary.steps, steps_of(grid));
        } else {
            assert_ok(status);
        }
        digests[i] = digest_of(grid);
        ends[i] = steps_of(grid);
        size_t count;
        double *values = copy_field(grid, SNOW_FIELD_VALUE, NULL, &count);
        for (size_t j = 0; j < count; j++)
            assert_true(isfinite(values[j]));
        free(values);
        snow_destroy(grid);
    }
    assert_int_equal(ends[0], ends[1]);
    assert_true(digests[0] == digests[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_add_up),
        cmocka_unit_test(a_run_of_n_steps_is_n_steps),
        cmocka_unit_test(a_run_in_slices_ends_like_one_run),
        cmocka_unit_test(defaults_are_the_documented_ones),
        cmocka_unit_test(the_rim_of_a_disc),
        cmocka_unit_test(the_rim_of_a_hexagon),
        cmocka_unit_test(the_rim_of_a_rectangle),
        cmocka_unit_test(the_row_rule),
        cmocka_unit_test(tip_radius_and_frozen_count_end_a_run),
        cmocka_unit_test(a_run_can_be_over_before_its_first_step),
        cmocka_unit_test(nothing_ever_changes_where_there_is_nothing_to_gain),
        cmocka_unit_test(a_full_domain_is_still),
        cmocka_unit_test(slow_growth_is_not_still),
        cmocka_unit_test(conditions_have_an_order),
        cmocka_unit_test(progress_is_called_in_equal_strides),
        cmocka_unit_test(every_call_of_progress_can_cancel),
        cmocka_unit_test(cancelling_after_the_last_step_is_not_cancelling),
        cmocka_unit_test(a_callback_may_ask_but_not_change),
        cmocka_unit_test(a_time_budget_ends_a_run_and_it_can_go_on),
        cmocka_unit_test(conditions_that_make_no_sense_are_refused),
        cmocka_unit_test(a_field_that_grows_without_bound_is_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
