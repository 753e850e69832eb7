/* Many grids at once: each is delivered once, with the bits that it has alone. */
#include "support/allocator.h"
#include "support/grids.h"
#include "support/loops.h"

#include <math.h>
#include <stdatomic.h>

enum { MOST = 40 };

/* What the callbacks of a sweep saw. They run on several threads: each writes only the entry of its grid. */
typedef struct sweep_log {
    atomic_int created;
    atomic_int delivered;
    int deliveries[MOST];
    snow_status status[MOST];
    snow_stop_reason reason[MOST];
    int64_t steps[MOST];
    uint64_t digest[MOST];
    int cancel_at;  /* the delivery that cancels; 0: none */
    size_t failing; /* this grid and each third after it cannot be made; SIZE_MAX: none */
    bool own_ends;  /* each run has its own number of steps */
} sweep_log;

static snow_reiter_params scene(size_t index)
{
    snow_reiter_params params;
    snow_reiter_params_init(&params, sizeof params);
    params.radius = 8 + (int32_t)(index % 5);
    params.addition = 0.01 + (double)index / 1000;
    params.noise = index % 2 == 0 ? 0 : 0.1;
    return params;
}

static bool fails(const sweep_log *log, size_t index)
{
    return log->failing != SIZE_MAX && index >= log->failing && (index - log->failing) % 3 == 0;
}

static snow_status create(void *context, size_t index, const snow_options *options, snow_stop *stop,
                          snow_grid **grid)
{
    sweep_log *log = context;
    atomic_fetch_add(&log->created, 1);
    snow_reiter_params params = scene(index);
    if (fails(log, index))
        params.background = 2;
    if (log->own_ends)
        stop->max_steps = (int64_t)index + 1;
    return snow_reiter_create(&params, options, grid);
}

static int take(void *context, size_t index, snow_status status, snow_grid *grid, const snow_summary *summary)
{
    sweep_log *log = context;
    log->deliveries[index]++;
    log->status[index] = status;
    log->reason[index] = summary->reason;
    log->steps[index] = summary->steps;
    if (grid != NULL)
        (void)snow_digest(grid, &log->digest[index]);
    return atomic_fetch_add(&log->delivered, 1) + 1 == log->cancel_at;
}

static uint64_t digest_alone(size_t index, const snow_stop *stop)
{
    snow_reiter_params params = scene(index);
    snow_grid *grid = make_grid(&params, NULL);
    run_grid(grid, stop);
    uint64_t digest = digest_of(grid);
    snow_destroy(grid);
    return digest;
}

static void each_grid_is_delivered_once_with_its_bits(void **state)
{
    (void)state;
    snow_stop stop = default_stop();
    uint64_t expected[MOST];
    for (size_t i = 0; i < MOST; i++)
        expected[i] = digest_alone(i, &stop);
    for (int32_t threads = 1; threads <= 8; threads++) {
        snow_options options = default_options();
        options.threads = threads;
        sweep_log log = {.failing = SIZE_MAX};
        assert_ok(snow_sweep(MOST, create, take, &log, &stop, &options));
        assert_int_equal(MOST, log.delivered);
        for (size_t i = 0; i < MOST; i++) {
            assert_int_equal(1, log.deliveries[i]);
            assert_ok(log.status[i]);
            assert_int_equal(SNOW_STOP_RIM, log.reason[i]);
            assert_true(expected[i] == log.digest[i]);
        }
    }
}

static void a_callers_loop_runs_a_sweep(void **state)
{
    (void)state;
    for (size_t k = 0; k < test_loop_count; k++) {
        snow_options options = default_options();
        options.threads = 3;
        options.parallel_for = test_loops[k].run;
        sweep_log log = {.failing = SIZE_MAX};
        assert_ok(snow_sweep(20, create, take, &log, NULL, &options));
        for (size_t i = 0; i < 20; i++) {
            assert_int_equal(1, log.deliveries[i]);
            assert_true(digest_alone(i, NULL) == log.digest[i]);
        }
    }
}

static void each_run_may_have_its_own_end(void **state)
{
    (void)state;
    snow_options options = default_options();
    options.threads = 2;
    sweep_log log = {.failing = SIZE_MAX, .own_ends = true};
    assert_ok(snow_sweep(20, create, take, &log, NULL, &options));
    for (size_t i = 0; i < 20; i++) {
        assert_int_equal(SNOW_STOP_STEPS, log.reason[i]);
        assert_int_equal(i + 1, log.steps[i]);
    }
}

static void grids_that_cannot_be_made_are_delivered_too(void **state)
{
    (void)state;
    for (int32_t threads = 1; threads <= 4; threads += 3) {
        snow_options options = default_options();
        options.threads = threads;
        sweep_log log = {.failing = 1};
        assert_ok(snow_sweep(20, create, take, &log, NULL, &options));
        for (size_t i = 0; i < 20; i++) {
            assert_int_equal(1, log.deliveries[i]);
            assert_status(fails(&log, i) ? SNOW_ERROR_REITER_BACKGROUND : SNOW_OK, log.status[i]);
        }
    }
}

static void a_result_can_cancel(void **state)
{
    (void)state;
    for (int32_t threads = 1; threads <= 4; threads++) {
        for (int cancel_at = 1; cancel_at <= 9; cancel_at += 4) {
            snow_options options = default_options();
            options.threads = threads;
            sweep_log log = {.failing = SIZE_MAX, .cancel_at = cancel_at};
            assert_ok(snow_sweep(MOST, create, take, &log, NULL, &options));
            /* Whatever was begun is delivered, and no more is begun than the threads hold. */
            assert_int_equal(log.created, log.delivered);
            assert_true(log.delivered >= cancel_at);
            assert_true(log.delivered < cancel_at + threads);
            for (size_t i = 0; i < MOST; i++)
                assert_true(log.deliveries[i] <= 1);
        }
    }
}

static int cancel_at_step_20(void *context, const snow_grid *grid, const snow_summary *summary)
{
    (void)context;
    (void)grid;
    return summary->steps >= 20;
}

static void progress_can_cancel(void **state)
{
    (void)state;
    for (int32_t threads = 1; threads <= 4; threads++) {
        snow_options options = default_options();
        options.threads = threads;
        snow_stop stop = stop_after(-1);
        stop.progress = cancel_at_step_20;
        stop.progress_steps = 5;
        sweep_log log = {.failing = SIZE_MAX};
        assert_ok(snow_sweep(MOST, create, take, &log, &stop, &options));
        assert_true(log.delivered >= 1 && log.delivered <= threads);
        assert_int_equal(log.created, log.delivered);
        for (size_t i = 0; i < MOST; i++)
            if (log.deliveries[i] == 1)
                assert_int_equal(SNOW_STOP_CANCELLED, log.reason[i]);
    }
}

static void nothing_to_do_is_done(void **state)
{
    (void)state;
    sweep_log log = {.failing = SIZE_MAX};
    snow_options options = default_options();
    assert_ok(snow_sweep(0, create, take, &log, NULL, NULL));
    options.threads = 3;
    assert_ok(snow_sweep(0, create, take, &log, NULL, &options));
    options.parallel_for = test_loops[0].run;
    assert_ok(snow_sweep(0, create, take, &log, NULL, &options));
    assert_int_equal(0, log.created);
    assert_int_equal(0, log.delivered);
}

static void what_makes_no_sense_is_refused_before_anything_starts(void **state)
{
    (void)state;
    sweep_log log = {.failing = SIZE_MAX};
    assert_status(SNOW_ERROR_NULL, snow_sweep(1, NULL, take, &log, NULL, NULL));
    assert_status(SNOW_ERROR_NULL, snow_sweep(1, create, NULL, &log, NULL, NULL));
    assert_status(SNOW_ERROR_RANGE, snow_sweep((size_t)1 << 20, create, take, &log, NULL, NULL));
    assert_status(SNOW_ERROR_RANGE, snow_sweep(SIZE_MAX, create, take, &log, NULL, NULL));
    snow_stop stop = default_stop();
    stop.progress_steps = 0;
    assert_status(SNOW_ERROR_RANGE, snow_sweep(1, create, take, &log, &stop, NULL));
    stop = default_stop();
    stop.tip_radius = NAN;
    assert_status(SNOW_ERROR_NOT_FINITE, snow_sweep(1, create, take, &log, &stop, NULL));
    stop = default_stop();
    stop.struct_size = 0;
    assert_status(SNOW_ERROR_STRUCT_SIZE, snow_sweep(1, create, take, &log, &stop, NULL));
    snow_options options = default_options();
    options.threads = -1;
    assert_status(SNOW_ERROR_RANGE, snow_sweep(1, create, take, &log, NULL, &options));
    options = default_options();
    options.isa = (snow_isa)77;
    assert_status(SNOW_ERROR_ENUM, snow_sweep(1, create, take, &log, NULL, &options));
    options = default_options();
    options.struct_size = 3;
    assert_status(SNOW_ERROR_STRUCT_SIZE, snow_sweep(1, create, take, &log, NULL, &options));
    assert_int_equal(0, log.created);
    assert_int_equal(0, log.delivered);
}

/* One thread, for the counting allocator is not made for several. */
static void memory_that_runs_out_is_told_and_given_back(void **state)
{
    (void)state;
    for (size_t n = 1; n <= 40; n++) {
        test_allocator allocator = {.fail_at = n};
        snow_options options = allocator_options(&allocator);
        sweep_log log = {.failing = SIZE_MAX};
        snow_status status = snow_sweep(4, create, take, &log, NULL, &options);
        assert_int_equal(0, allocator.live_blocks);
        if (status == SNOW_OK) {
            int failed = 0;
            for (size_t i = 0; i < 4; i++) {
                assert_int_equal(1, log.deliveries[i]);
                failed += log.status[i] == SNOW_ERROR_NO_MEMORY;
            }
            assert_int_equal(allocator.calls >= n, failed);
        } else {
            assert_status(SNOW_ERROR_NO_MEMORY, status);
            assert_int_equal(0, log.delivered);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_grid_is_delivered_once_with_its_bits),
        cmocka_unit_test(a_callers_loop_runs_a_sweep),
        cmocka_unit_test(each_run_may_have_its_own_end),
        cmocka_unit_test(grids_that_cannot_be_made_are_delivered_too),
        cmocka_unit_test(a_result_can_cancel),
        cmocka_unit_test(progress_can_cancel),
        cmocka_unit_test(nothing_to_do_is_done),
        cmocka_unit_test(what_makes_no_sense_is_refused_before_anything_starts),
        cmocka_unit_test(memory_that_runs_out_is_told_and_given_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
