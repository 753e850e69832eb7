/* How aggregates grow: the same cluster whatever the threads, the instruction set and the pauses; every stop. */
#include "support/aggregates.h"
#include "support/allocator.h"
#include "support/grids.h"
#include "support/loops.h"

#include <inttypes.h>
#include <stdlib.h>

static void assert_same_particles(const snow_grid *expected, const snow_grid *got)
{
    uint64_t counts[2];
    assert_ok(snow_aggregate_particles(expected, &counts[0]));
    assert_ok(snow_aggregate_particles(got, &counts[1]));
    assert_int_equal(counts[0], counts[1]);
    size_t count = (size_t)counts[0];
    snow_point *points[2] = {calloc(count, sizeof(snow_point)), calloc(count, sizeof(snow_point))};
    assert_true(points[0] != NULL && points[1] != NULL);
    assert_ok(snow_aggregate_points(expected, 0, points[0], count));
    assert_ok(snow_aggregate_points(got, 0, points[1], count));
    assert_memory_equal(points[0], points[1], count * sizeof(snow_point));
    assert_int_equal(steps_of(expected), steps_of(got));
    assert_int_equal(digest_of(expected), digest_of(got));
    free(points[0]);
    free(points[1]);
}

enum { LONG_RUN = 150 };

/* A few of the scenes are full before: then the end is what is compared. */
static void grow(snow_grid *grid, int64_t steps)
{
    snow_status status = snow_step(grid, steps);
    assert_true(status == SNOW_OK || status == SNOW_ERROR_FULL);
}

/* Recorded on one machine: each other one must find the same, whatever its compiler, byte order and libm. */
static void platforms_do_not_matter(void **state)
{
    (void)state;
    static const uint64_t digests[] = {
        UINT64_C(0x7608063a9c33a84f), UINT64_C(0x04b5d0ca13d61a3b), UINT64_C(0x9934bfd4e9d3d87d), UINT64_C(0xed077cc40449a365),
        UINT64_C(0xd14b23cf05087c2f), UINT64_C(0x251e1fc3e1a8d94b), UINT64_C(0x5dd61bd0ac190d00), UINT64_C(0x18a3fcb3dea8075c),
        UINT64_C(0x900c11a5dcfff74b), UINT64_C(0xa39fb27d8599f36b), UINT64_C(0x6c8d20cda47ae976), UINT64_C(0x519185a5690822df),
        UINT64_C(0x189ed47742d05842), UINT64_C(0xa9dd1a6c4f0ac4a5), UINT64_C(0x620b67b950deea99), UINT64_C(0xb0916c971cd4a2ef),
        UINT64_C(0xeda3657d04d129ea),
    };
    assert_int_equal(COUNT_OF(digests), aggregate_kind_count);
    for (size_t i = 0; i < aggregate_kind_count; i++) {
        snow_aggregate_params params = aggregate_kind(i);
        snow_grid *grid = make_aggregate(&params, NULL);
        grow(grid, LONG_RUN);
        if (digest_of(grid) != digests[i])
            fail_msg("kind %zu: 0x%016" PRIx64, i, digest_of(grid));
        snow_destroy(grid);
    }
}

static void threads_do_not_matter(void **state)
{
    (void)state;
    for (size_t i = 0; i < aggregate_kind_count; i++) {
        snow_aggregate_params params = aggregate_kind(i);
        snow_grid *alone = make_aggregate(&params, NULL);
        grow(alone, LONG_RUN);
        for (int32_t threads = 2; threads <= 5; threads += 3) {
            snow_options options = default_options();
            options.threads = threads;
            snow_grid *together = make_aggregate(&params, &options);
            grow(together, LONG_RUN);
            assert_same_particles(alone, together);
            snow_destroy(together);
        }
        snow_destroy(alone);
    }
}

/* A larger cluster, where many walkers are ahead at once; the caller's loops run them in any order. */
static void loops_do_not_matter(void **state)
{
    (void)state;
    enum { PARTICLES = 3000 };
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    snow_grid *alone = make_aggregate(&params, NULL);
    assert_ok(snow_step(alone, PARTICLES));
    for (size_t i = 0; i < test_loop_count; i++) {
        snow_options options = default_options();
        options.threads = 4;
        options.parallel_for = test_loops[i].run;
        snow_grid *together = make_aggregate(&params, &options);
        assert_ok(snow_step(together, PARTICLES));
        assert_same_particles(alone, together);
        snow_destroy(together);
    }
    snow_destroy(alone);
}

static void instruction_sets_do_not_matter(void **state)
{
    (void)state;
    snow_isa isas[8];
    size_t count = available_isas(isas);
    for (size_t i = 0; i < aggregate_kind_count; i++) {
        snow_aggregate_params params = aggregate_kind(i);
        snow_grid *first = make_aggregate(&params, NULL);
        grow(first, LONG_RUN);
        for (size_t k = 0; k < count; k++) {
            snow_options options = default_options();
            options.isa = isas[k];
            snow_grid *forced = make_aggregate(&params, &options);
            grow(forced, LONG_RUN);
            assert_same_particles(first, forced);
            snow_destroy(forced);
        }
        snow_destroy(first);
    }
}

static void a_run_in_slices_is_the_run(void **state)
{
    (void)state;
    for (size_t i = 0; i < aggregate_kind_count; i++) {
        snow_aggregate_params params = aggregate_kind(i);
        snow_grid *whole = make_aggregate(&params, NULL);
        snow_grid *sliced = make_aggregate(&params, NULL);
        grow(whole, LONG_RUN);
        for (int step = 0; step < LONG_RUN; step++)
            grow(sliced, 1);
        assert_same_particles(whole, sliced);
        snow_destroy(sliced);
        snow_destroy(whole);
    }
}

static void save_in_the_middle_and_continue(void **state)
{
    (void)state;
    for (size_t i = 0; i < aggregate_kind_count; i++) {
        snow_aggregate_params params = aggregate_kind(i);
        snow_grid *grid = make_aggregate(&params, NULL);
        grow(grid, params.scene == SNOW_AGGREGATE_CLUSTER_CLUSTER ? 2 * LONG_RUN : LONG_RUN / 2);
        size_t size = 0;
        assert_ok(snow_save(grid, NULL, 0, &size));
        void *bytes = malloc(size);
        assert_non_null(bytes);
        assert_ok(snow_save(grid, bytes, size, &size));
        snow_grid *loaded = NULL;
        snow_options options = default_options();
        options.threads = 2;
        assert_ok(snow_load(bytes, size, &options, &loaded));
        assert_same_particles(grid, loaded);
        grow(grid, LONG_RUN / 2);
        grow(loaded, LONG_RUN / 2);
        assert_same_particles(grid, loaded);
        for (size_t cut = 0; cut < size; cut += 1 + size / 40) {
            snow_grid *none = NULL;
            assert_int_not_equal(SNOW_OK, snow_load(bytes, cut, NULL, &none));
            assert_null(none);
        }
        free(bytes);
        snow_destroy(loaded);
        snow_destroy(grid);
    }
}

static snow_summary run_to(const snow_aggregate_params *params, const snow_stop *stop, snow_grid **grid)
{
    *grid = make_aggregate(params, NULL);
    snow_summary summary;
    snow_summary_init(&summary, sizeof summary);
    assert_ok(snow_run(*grid, stop, &summary));
    return summary;
}

static void runs_end_at_a_mass(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    snow_stop stop = default_stop();
    stop.frozen = 123;
    snow_grid *grid;
    snow_summary summary = run_to(&params, &stop, &grid);
    assert_int_equal(SNOW_STOP_FROZEN, summary.reason);
    assert_int_equal(123, summary.frozen);
    assert_int_equal(122, summary.steps);
    snow_destroy(grid);
}

static void runs_end_at_a_radius(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    snow_stop stop = default_stop();
    stop.tip_radius = 12;
    snow_grid *grid;
    snow_summary summary = run_to(&params, &stop, &grid);
    assert_int_equal(SNOW_STOP_RADIUS, summary.reason);
    assert_true(summary.tip_radius >= 12 && summary.tip_radius < 13);
    size_t count = 0;
    snow_site *sites = copy_sites(grid, &count);
    for (size_t i = 0; i + 1 < count; i++) /* not one particle too late */
        assert_true(sites[i].x * sites[i].x + sites[i].y * sites[i].y < 144);
    free(sites);
    snow_destroy(grid);
}

static void runs_end_at_a_height(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_LINE);
    params.width = 50;
    snow_stop stop = default_stop();
    stop.height = 20;
    snow_grid *grid;
    snow_summary summary = run_to(&params, &stop, &grid);
    assert_int_equal(SNOW_STOP_HEIGHT, summary.reason);
    int32_t heights[50];
    size_t count = 0;
    assert_ok(snow_aggregate_profile(grid, heights, COUNT_OF(heights), &count));
    int32_t highest = 0;
    for (size_t i = 0; i < count; i++)
        highest = heights[i] > highest ? heights[i] : highest;
    assert_int_equal(20, highest);
    snow_destroy(grid);
}

static void runs_end_at_the_steps(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_SNOWFLAKE);
    snow_stop stop = stop_after(77);
    snow_grid *grid;
    snow_summary summary = run_to(&params, &stop, &grid);
    assert_int_equal(SNOW_STOP_STEPS, summary.reason);
    assert_int_equal(78, summary.frozen);
    snow_destroy(grid);
}

static void the_laboratory_ends_at_its_radius(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_LABORATORY);
    params.launch_radius = 30;
    params.end_radius = 15;
    snow_grid *grid;
    snow_summary summary = run_to(&params, NULL, &grid);
    assert_int_equal(SNOW_STOP_RIM, summary.reason);
    assert_true(summary.tip_radius >= 15 && summary.tip_radius < 16);
    snow_destroy(grid);
}

typedef struct observer {
    int64_t calls;
    int64_t between; /* of them, at a step count that is no multiple */
    int64_t stride;
    int64_t cancel_at; /* a step count */
} observer;

static int observe(void *context, const snow_grid *grid, const snow_summary *summary)
{
    observer *self = context;
    assert_int_equal(summary->steps, steps_of(grid));
    assert_int_equal(summary->frozen, frozen_of(grid));
    self->calls++;
    self->between += summary->steps % self->stride != 0;
    return summary->steps >= self->cancel_at;
}

static snow_stop observed(observer *self, int64_t stride, int64_t cancel_at)
{
    *self = (observer){.stride = stride, .cancel_at = cancel_at};
    snow_stop stop = stop_after(-1);
    stop.progress = observe;
    stop.progress_context = self;
    stop.progress_steps = stride;
    return stop;
}

static void a_callback_ends_a_run_and_it_can_go_on(void **state)
{
    (void)state;
    for (size_t i = 0; i < aggregate_kind_count; i++) {
        snow_aggregate_params params = aggregate_kind(i);
        snow_grid *whole = make_aggregate(&params, NULL);
        assert_ok(snow_step(whole, 90));
        observer watcher;
        snow_stop stop = observed(&watcher, 10, 50);
        snow_grid *grid;
        snow_summary summary = run_to(&params, &stop, &grid);
        assert_int_equal(SNOW_STOP_CANCELLED, summary.reason);
        assert_int_equal(50, summary.steps);
        assert_true(watcher.calls - watcher.between == 5);
        assert_ok(snow_step(grid, 40));
        assert_same_particles(whole, grid);
        snow_destroy(grid);
        snow_destroy(whole);
    }
}

/* Where hardly any walker comes to the cathode a caller hears of it all the same. */
static void a_callback_is_called_while_walkers_are_lost(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_ELECTROLYSIS);
    params.height = 100;
    params.cathode_first = params.cathode_last = 255;
    params.launch_first = 210;
    params.launch_last = 220;
    observer watcher;
    snow_stop stop = observed(&watcher, 1000, 3);
    snow_grid *grid;
    snow_summary summary = run_to(&params, &stop, &grid);
    assert_int_equal(SNOW_STOP_CANCELLED, summary.reason);
    assert_int_equal(3, summary.steps);
    assert_true(watcher.between > 0);
    snow_destroy(grid);
}

static void a_time_budget_ends_a_run_and_it_can_go_on(void **state)
{
    (void)state;
    for (size_t i = 0; i < aggregate_kind_count; i++) {
        snow_aggregate_params params = aggregate_kind(i);
        snow_stop stop = stop_after(90);
        snow_grid *whole;
        snow_summary expected = run_to(&params, &stop, &whole);
        snow_grid *grid = make_aggregate(&params, NULL);
        stop.seconds = 1e-9;
        snow_summary summary;
        do {
            summary = run_grid(grid, &stop);
        } while (summary.reason == SNOW_STOP_TIME);
        assert_int_equal(expected.reason, summary.reason);
        assert_same_particles(whole, grid);
        snow_destroy(grid);
        snow_destroy(whole);
    }
}

/* A run that has no other end. */
static void a_time_budget_ends_an_endless_run(void **state)
{
    (void)state;
    static const snow_aggregate_scene scenes[] = {SNOW_AGGREGATE_WITTEN_SANDER, SNOW_AGGREGATE_SNOWFLAKE,
                                                  SNOW_AGGREGATE_OFF_LATTICE};
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        snow_aggregate_params params = aggregate_scene(scenes[i]);
        snow_stop stop = stop_after(-1);
        stop.seconds = 0.01;
        snow_grid *grid;
        assert_int_equal(SNOW_STOP_TIME, run_to(&params, &stop, &grid).reason);
        snow_destroy(grid);
    }
}

/* Where each scene with a rim has it, and that a run can go on past it until nothing more can join. */
static void runs_end_at_the_rim_or_full(void **state)
{
    (void)state;
    static const snow_aggregate_scene scenes[] = {SNOW_AGGREGATE_LINE, SNOW_AGGREGATE_ELECTROLYSIS,
                                                  SNOW_AGGREGATE_CHIMNEY, SNOW_AGGREGATE_SHORE};
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        bool shore = scenes[i] == SNOW_AGGREGATE_SHORE;
        snow_aggregate_params params = aggregate_scene(scenes[i]);
        params.width = 12;
        params.height = 9;
        params.wall_right = params.wall_right_top = 11;
        snow_grid *grid;
        snow_summary summary = run_to(&params, NULL, &grid);
        bool shut = scenes[i] == SNOW_AGGREGATE_CHIMNEY && summary.reason == SNOW_STOP_FULL; /* soot fills its foot */
        assert_true(shut || summary.reason == SNOW_STOP_RIM);
        uint64_t count = 0;
        snow_site last;
        assert_ok(snow_aggregate_particles(grid, &count));
        assert_ok(snow_aggregate_sites(grid, count - 1, &last, 1));
        assert_true(shut || last.y == (shore ? 0 : 8));
        snow_stop stop = stop_after(-1);
        stop.rim = 0;
        assert_int_equal(SNOW_STOP_FULL, run_grid(grid, &stop).reason);
        assert_status(SNOW_ERROR_FULL, snow_step(grid, 1));
        snow_destroy(grid);
    }
}

/* Of several conditions that hold after one step. */
static void the_first_of_several_reasons_is_given(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    snow_stop stop = stop_after(1);
    stop.frozen = 2;
    stop.tip_radius = 1;
    snow_grid *grid;
    assert_int_equal(SNOW_STOP_RADIUS, run_to(&params, &stop, &grid).reason);
    stop.tip_radius = 0;
    assert_int_equal(SNOW_STOP_FROZEN, run_grid(grid, &stop).reason);
    stop.frozen = 0;
    assert_int_equal(SNOW_STOP_STEPS, run_grid(grid, &stop).reason);
    snow_destroy(grid);
}

/* Of walkers that come close few go as far as ten times the radius, and far more go beyond the launch circle. */
static void walkers_beyond_the_kill_radius_are_dropped(void **state)
{
    (void)state;
    uint64_t walkers[2];
    const double kill_radii[] = {1.25, 10};
    for (size_t i = 0; i < COUNT_OF(kill_radii); i++) {
        snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
        params.engine = SNOW_AGGREGATE_ENGINE_STEPS;
        params.kill_radius = kill_radii[i];
        snow_grid *grid = make_aggregate(&params, NULL);
        assert_ok(snow_step(grid, LONG_RUN));
        assert_ok(snow_aggregate_walkers(grid, &walkers[i]));
        snow_destroy(grid);
    }
    assert_true(walkers[1] > LONG_RUN); /* a plane's walker comes back for certain, but not soon */
    assert_true(walkers[0] > 2 * walkers[1]);
}

/* One allocation after the other fails once: what asks for it says so, and can be asked again. True while there was
   one to fail. */
static bool grow_with_a_failure(const snow_aggregate_params *params, const snow_grid *expected, int32_t threads,
                                size_t fail_at)
{
    test_allocator allocator = {.fail_at = fail_at};
    snow_options options = allocator_options(&allocator);
    options.threads = threads;
    snow_grid *grid = NULL;
    snow_status status = snow_aggregate_create(params, &options, &grid);
    if (status == SNOW_OK) {
        while (steps_of(grid) < steps_of(expected) && (status = snow_step(grid, 1)) == SNOW_OK)
            continue;
        if (status != SNOW_OK)
            assert_ok(snow_step(grid, steps_of(expected) - steps_of(grid)));
        assert_same_particles(expected, grid);
        snow_destroy(grid);
    } else {
        assert_null(grid);
    }
    assert_true(status == SNOW_OK || status == SNOW_ERROR_NO_MEMORY);
    assert_int_equal(0, allocator.live_blocks);
    assert_true(status == SNOW_OK || allocator.calls >= fail_at);
    return allocator.calls >= fail_at;
}

static void growth_survives_any_failure(void **state)
{
    (void)state;
    enum { LATE = 300 }; /* drifting clusters have become large ones by then */
    for (size_t i = 0; i < aggregate_kind_count; i++) {
        snow_aggregate_params params = aggregate_kind(i);
        params.record_order = 1;
        snow_grid *expected = make_aggregate(&params, NULL);
        assert_ok(snow_step(expected, params.scene == SNOW_AGGREGATE_CLUSTER_CLUSTER ? LATE : 50));
        for (int32_t threads = 1; threads <= 2; threads++) {
            size_t failures = 0;
            while (grow_with_a_failure(&params, expected, threads, failures + 1))
                failures++;
            assert_true(failures > 5);
        }
        snow_destroy(expected);
    }
}

/* A shaft of one column: soot has nowhere to go but up, and the mouth is shut by the first grain. */
static void a_full_domain_ends_the_run(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_CHIMNEY);
    params.width = 3;
    params.height = 10;
    params.wall_left = params.wall_left_top = 0;
    params.wall_right = params.wall_right_top = 2;
    snow_grid *grid;
    snow_summary summary = run_to(&params, NULL, &grid);
    assert_int_equal(SNOW_STOP_FULL, summary.reason);
    assert_int_equal(1, summary.frozen);
    assert_status(SNOW_ERROR_FULL, snow_step(grid, 1));
    snow_destroy(grid);
}

static void the_whole_shore_can_be_washed_away(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_SHORE);
    params.width = 5;
    params.height = 4;
    snow_stop stop = stop_after(-1);
    stop.rim = 0;
    snow_grid *grid;
    snow_summary summary = run_to(&params, &stop, &grid);
    assert_int_equal(SNOW_STOP_FULL, summary.reason);
    assert_int_equal(20, summary.frozen);
    snow_destroy(grid);
}

static void one_cluster_is_still(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_CLUSTER_CLUSTER);
    params.particles = 200;
    snow_grid *grid;
    snow_summary summary = run_to(&params, NULL, &grid);
    assert_int_equal(SNOW_STOP_STILL, summary.reason);
    size_t clusters = 0;
    assert_ok(snow_aggregate_clusters(grid, NULL, 0, &clusters));
    assert_int_equal(1, clusters);
    snow_destroy(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(platforms_do_not_matter),
        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(loops_do_not_matter),
        cmocka_unit_test(instruction_sets_do_not_matter),
        cmocka_unit_test(a_run_in_slices_is_the_run),
        cmocka_unit_test(save_in_the_middle_and_continue),
        cmocka_unit_test(runs_end_at_a_mass),
        cmocka_unit_test(runs_end_at_a_radius),
        cmocka_unit_test(runs_end_at_a_height),
        cmocka_unit_test(runs_end_at_the_steps),
        cmocka_unit_test(the_laboratory_ends_at_its_radius),
        cmocka_unit_test(a_callback_ends_a_run_and_it_can_go_on),
        cmocka_unit_test(a_callback_is_called_while_walkers_are_lost),
        cmocka_unit_test(a_time_budget_ends_a_run_and_it_can_go_on),
        cmocka_unit_test(a_time_budget_ends_an_endless_run),
        cmocka_unit_test(runs_end_at_the_rim_or_full),
        cmocka_unit_test(the_first_of_several_reasons_is_given),
        cmocka_unit_test(walkers_beyond_the_kill_radius_are_dropped),
        cmocka_unit_test(growth_survives_any_failure),
        cmocka_unit_test(a_full_domain_ends_the_run),
        cmocka_unit_test(the_whole_shore_can_be_washed_away),
        cmocka_unit_test(one_cluster_is_still),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
