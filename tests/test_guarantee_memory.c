/* Every public call of every model, with its n-th allocation failing, for all n: nothing leaks, nobody's data are
   touched, and the grid is as it was, or between two steps, and goes on to the same end. */
#include "support/aggregates.h"
#include "support/allocator.h"
#include "support/grids.h"
#include "support/lives.h"
#include "support/packard.h"

#include <stdlib.h>
#include <string.h>

enum { START = 3 /* steps before the call */, UNTOUCHED = 0xa7 };

static snow_grid *const untouched = (snow_grid *)(uintptr_t)0x1230;

/* What the call makes of an undisturbed grid. */
typedef struct expectation {
    snow_status status;
    int64_t steps;
    uint64_t digest;
    test_answer answer;
} expectation;

static void expect(const test_life *life, const test_act *act, expectation *expected)
{
    snow_grid *grid = start_life(life, false, NULL);
    assert_ok(snow_step(grid, START));
    memset(&expected->answer, UNTOUCHED, sizeof expected->answer);
    expected->status = act->call(grid, &expected->answer);
    expected->steps = steps_of(grid);
    expected->digest = digest_of(grid);
    snow_destroy(grid);
}

static void assert_stands_at(const test_act *act, const snow_grid *grid, int64_t steps, uint64_t digest)
{
    if (steps_of(grid) == steps && digest_of(grid) == digest)
        return;
    print_error("%s: not the grid that it ought to be\n", act->name);
    fail();
}

/* Where the failed call has left the grid: where it was, or some steps later. */
static void assert_stands(const test_life *life, const test_act *act, const snow_grid *grid)
{
    snow_grid *plain = start_life(life, false, NULL);
    int64_t steps = steps_of(grid);
    assert_true(steps == START || act->steps);
    assert_ok(snow_step(plain, steps));
    assert_stands_at(act, grid, steps, digest_of(plain));
    snow_destroy(plain);
}

static void assert_untouched(const test_answer *answer)
{
    for (size_t i = 0; i < sizeof answer->bytes; i++)
        if (answer->bytes[i] != UNTOUCHED)
            fail();
}

/* Once more, with memory: to the same end. */
static void go_on(const test_act *act, snow_grid *grid, const expectation *expected)
{
    static test_answer answer;
    int64_t done = steps_of(grid) - START;
    memset(&answer, UNTOUCHED, sizeof answer);
    if (!act->steps) {
        assert_status(expected->status, act->call(grid, &answer));
        assert_memory_equal(&expected->answer, &answer, sizeof answer);
    } else {
        assert_ok(snow_step(grid, expected->steps - START - done));
    }
    assert_stands_at(act, grid, expected->steps, expected->digest);
}

/* Whether the n-th allocation was reached. */
static bool fail_allocation(const test_life *life, const test_act *act, size_t n, bool all_later,
                            const expectation *expected)
{
    static test_answer answer;
    test_allocator allocator = {0};
    snow_options options = allocator_options(&allocator);
    snow_grid *grid = start_life(life, false, &options);
    assert_ok(snow_step(grid, START));
    memset(&answer, UNTOUCHED, sizeof answer);
    allocator.fail_at = allocator.calls + n;
    allocator.fail_after = all_later;
    snow_status status = act->call(grid, &answer);
    bool reached = allocator.calls >= allocator.fail_at;
    allocator.fail_at = 0;
    if (status == expected->status) { /* it knew another way */
        assert_stands_at(act, grid, expected->steps, expected->digest);
        assert_memory_equal(&expected->answer, &answer, sizeof answer);
    } else {
        assert_true(reached);
        assert_status(SNOW_ERROR_NO_MEMORY, status);
        assert_untouched(&answer);
        uint64_t bytes = 0;
        assert_ok(snow_memory(grid, &bytes));
        assert_int_equal(allocator.live_bytes, bytes);
        assert_stands(life, act, grid);
        go_on(act, grid, expected);
    }
    snow_destroy(grid);
    assert_int_equal(0, allocator.live_blocks);
    return reached;
}

static void every_call_survives_any_failure(void **state)
{
    (void)state;
    static expectation expected;
    size_t failures = 0;
    for (size_t i = 0; i < test_life_count; i++) {
        for (size_t k = 0; k < test_act_count; k++) {
            expect(&test_lives[i], &test_acts[k], &expected);
            for (int all_later = 0; all_later <= 1; all_later++)
                for (size_t n = 1; fail_allocation(&test_lives[i], &test_acts[k], n, all_later == 1, &expected); n++)
                    failures++;
        }
    }
    print_message("%zu allocations failed\n", failures);
    assert_true(failures > 100);
}

/* --- calls that make a grid --- */

typedef struct making {
    const test_life *life;
    saved_life saved;
    snow_status (*make)(struct making *self, const snow_options *options, snow_grid **grid);
} making;

static snow_status make_new(making *self, const snow_options *options, snow_grid **grid)
{
    return self->life->create(false, options, grid);
}

static snow_status make_loaded(making *self, const snow_options *options, snow_grid **grid)
{
    return snow_load(self->saved.bytes, self->saved.size, options, grid);
}

static int read_saved(void *context, void *bytes, size_t size, size_t *got)
{
    saved_life *saved = context;
    size_t left = saved->size - saved->next;
    *got = left < size ? left : size;
    memcpy(bytes, saved->bytes + saved->next, *got);
    saved->next += *got;
    return 0;
}

static snow_status make_read(making *self, const snow_options *options, snow_grid **grid)
{
    self->saved.next = 0;
    return snow_load_from(read_saved, &self->saved, options, grid);
}

static snow_status make_pattern(making *self, const snow_options *options, snow_grid **grid)
{
    static const char pattern[] = "x = 400, y = 2, rule = B1/S0123456H\n200o$399bo!\n";
    (void)self;
    return snow_packard_load_rle(pattern, sizeof pattern - 1, NULL, options, grid);
}

static snow_status make_read_pattern(making *self, const snow_options *options, snow_grid **grid)
{
    self->saved.next = 0;
    return snow_packard_load_rle_from(read_saved, &self->saved, NULL, options, grid);
}

static void fail_every_allocation(making *self)
{
    for (int all_later = 0; all_later <= 1; all_later++) {
        snow_status status = SNOW_ERROR_NO_MEMORY;
        for (size_t n = 1; status != SNOW_OK; n++) {
            test_allocator allocator = {.fail_at = n, .fail_after = all_later == 1};
            snow_options options = allocator_options(&allocator);
            snow_grid *grid = untouched;
            status = self->make(self, &options, &grid);
            if (status != SNOW_OK) {
                assert_status(SNOW_ERROR_NO_MEMORY, status);
                assert_ptr_equal(untouched, grid);
                assert_int_equal(0, allocator.live_blocks);
            } else {
                assert_true(n > 1);
                allocator.fail_at = 0;
                assert_ok(snow_step(grid, 2));
                snow_destroy(grid);
            }
            assert_int_equal(0, allocator.live_blocks);
        }
    }
}

static void making_survives_any_failure(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_life_count; i++) {
        making all = {.life = &test_lives[i], .make = make_new};
        fail_every_allocation(&all);
        snow_grid *grid = start_life(&test_lives[i], false, NULL);
        assert_ok(snow_step(grid, 20));
        all.saved = save_life(grid);
        snow_destroy(grid);
        all.make = make_loaded;
        fail_every_allocation(&all);
        all.make = make_read;
        fail_every_allocation(&all);
        free_life(&all.saved);
    }
    static unsigned char text[] = "x = 3, y = 1, rule = B1/S0123456H\n3o!";
    making pattern = {.make = make_pattern, .saved = {text, sizeof text - 1, 0}};
    fail_every_allocation(&pattern);
    pattern.make = make_read_pattern;
    fail_every_allocation(&pattern);
}

/* --- limits --- */

/* Under every limit: refused, or kept to, also by the steps that follow. */
static void memory_limits_are_kept(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_life_count; i++) {
        test_allocator allocator = {0};
        snow_options options = allocator_options(&allocator);
        snow_grid *grid = start_life(&test_lives[i], false, &options);
        assert_ok(snow_step(grid, 70));
        snow_destroy(grid);
        uint64_t needed = allocator.peak_bytes;
        for (uint64_t limit = 1; limit <= needed; limit += 1 + needed / 37) {
            allocator = (test_allocator){0};
            options.memory_limit = limit;
            grid = untouched;
            snow_status status = test_lives[i].create(false, &options, &grid);
            if (status == SNOW_OK) {
                status = snow_step(grid, 70);
                uint64_t bytes = 0;
                assert_ok(snow_memory(grid, &bytes));
                assert_int_equal(allocator.live_bytes, bytes);
                snow_destroy(grid);
            } else {
                assert_ptr_equal(untouched, grid);
            }
            if (status != SNOW_OK)
                assert_status(SNOW_ERROR_MEMORY_LIMIT, status);
            assert_true(allocator.peak_bytes <= limit);
            assert_int_equal(0, allocator.live_blocks);
        }
        options.memory_limit = needed;
        grid = start_life(&test_lives[i], false, &options);
        assert_ok(snow_step(grid, 70));
        snow_destroy(grid);
    }
}

/* Two particles with much air between them: a few bytes that stand for a large map. */
static saved_life save_far_apart(void)
{
    static const snow_site seeds[] = {{0, 0, 0}, {900, 0, 0}};
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    params.lattice = SNOW_AGGREGATE_CUBIC;
    params.seeds = seeds;
    params.seed_count = COUNT_OF(seeds);
    snow_grid *grid = make_aggregate(&params, NULL);
    saved_life saved = save_life(grid);
    snow_destroy(grid);
    return saved;
}

/* Data that are sound may need more than their size: then the limit is kept. So it is by each of the things that stand
   beside each other until the grid is made: the grid, a cluster's sites, a reader's text. */
static void keep_to_limits(making *self, uint64_t things)
{
    test_allocator allocator = {0};
    snow_options options = allocator_options(&allocator);
    snow_grid *grid = NULL;
    assert_ok(self->make(self, &options, &grid));
    snow_destroy(grid);
    uint64_t needed = allocator.peak_bytes;
    for (uint64_t limit = 1; limit < needed; limit += 1 + needed / 11) {
        allocator = (test_allocator){0};
        options.memory_limit = limit;
        grid = untouched;
        snow_status status = self->make(self, &options, &grid);
        assert_true(allocator.peak_bytes <= things * limit);
        if (status == SNOW_OK) {
            assert_true(allocator.live_bytes <= limit);
            snow_destroy(grid);
        } else {
            assert_status(SNOW_ERROR_MEMORY_LIMIT, status);
            assert_ptr_equal(untouched, grid);
        }
        assert_int_equal(0, allocator.live_blocks);
    }
}

static void load_within_limits(const saved_life *saved, bool has_sites)
{
    making all = {.saved = *saved, .make = make_loaded};
    keep_to_limits(&all, has_sites ? 2 : 1);
    all.make = make_read;
    keep_to_limits(&all, has_sites ? 3 : 2);
}

static void loads_keep_to_the_limit(void **state)
{
    (void)state;
    saved_life far_apart = save_far_apart();
    assert_true(far_apart.size < 500);
    load_within_limits(&far_apart, true);
    free_life(&far_apart);
    for (size_t i = 0; i < test_life_count; i++) {
        snow_grid *grid = start_life(&test_lives[i], false, NULL);
        assert_ok(snow_step(grid, 30));
        saved_life saved = save_life(grid);
        snow_model model;
        assert_ok(snow_model_of(grid, &model));
        snow_destroy(grid);
        load_within_limits(&saved, model == SNOW_MODEL_AGGREGATE);
        free_life(&saved);
    }
    static unsigned char text[] = "x = 3, y = 1, rule = B1/S0123456H\n3o!";
    making pattern = {.make = make_read_pattern, .saved = {text, sizeof text - 1, 0}};
    keep_to_limits(&pattern, 2);
}

/* Whatever the head of a saved grid is made to say. */
static void hostile_data_cost_little(void **state)
{
    (void)state;
    enum { HEAD = 120 };
    for (size_t i = 0; i < test_life_count; i++) {
        snow_grid *grid = start_life(&test_lives[i], false, NULL);
        assert_ok(snow_step(grid, 12));
        saved_life saved = save_life(grid);
        snow_destroy(grid);
        for (size_t bit = 0; bit < 8 * HEAD && bit < 8 * saved.size; bit++) {
            test_allocator allocator = {0};
            snow_options options = allocator_options(&allocator);
            options.memory_limit = UINT64_C(1) << 30; /* this machine's own */
            saved.bytes[bit / 8] ^= (unsigned char)(1U << bit % 8);
            grid = untouched;
            assert_true(snow_load(saved.bytes, saved.size, &options, &grid) != SNOW_OK);
            assert_ptr_equal(untouched, grid);
            assert_true(allocator.peak_bytes <= 100 * saved.size + (64 << 20));
            assert_int_equal(0, allocator.live_blocks);
            saved.bytes[bit / 8] ^= (unsigned char)(1U << bit % 8);
        }
        free_life(&saved);
    }
}

/* Sides whose products are beyond 32 and 64 bits; limits that are met before them, and behind them. */
static const int32_t sides[] = {1, 1 << 10, 1 << 16, 1 << 20, 1 << 21, INT32_MAX};
static const uint64_t limits[] = {1 << 16, 1 << 24};

/* An answer at once, and no more memory than may be. */
static void assert_answer(snow_status status, snow_grid *grid, const snow_options *options)
{
    const test_allocator *allocator = options->allocator_context;
    assert_true(allocator->peak_bytes <= options->memory_limit);
    if (status == SNOW_OK)
        snow_destroy(grid);
    else
        assert_ptr_equal(untouched, grid);
    assert_int_equal(0, allocator->live_blocks);
}

static void grow_rectangle(int32_t width, int32_t height, const snow_options *options)
{
    snow_reiter_params params = rectangle_scene(0.4, 0.01, 1, width, height);
    params.record_freeze_steps = 1;
    for (int engine = SNOW_REITER_ENGINE_AUTO; engine <= SNOW_REITER_ENGINE_QUAD; engine++) {
        params.engine = (snow_reiter_engine)engine;
        snow_grid *grid = untouched;
        snow_status status = snow_reiter_create(&params, options, &grid);
        assert_answer(status, grid, options);
    }
}

static void grow_torus(int32_t width, int32_t height, const snow_options *options)
{
    static const snow_packard_domain domains[] = {SNOW_PACKARD_TORUS, SNOW_PACKARD_RECTANGLE, SNOW_PACKARD_RHOMBUS};
    snow_packard_params params = packard_scene("0100000");
    params.width = width;
    params.height = height;
    for (size_t i = 0; i < COUNT_OF(domains); i++) {
        for (int engine = SNOW_PACKARD_ENGINE_AUTO; engine <= SNOW_PACKARD_ENGINE_REFERENCE; engine++) {
            params.domain = domains[i];
            params.engine = (snow_packard_engine)engine;
            params.record_freeze_steps = engine == SNOW_PACKARD_ENGINE_REFERENCE;
            snow_grid *grid = untouched;
            snow_status status = snow_packard_create(&params, options, &grid);
            assert_answer(status, grid, options);
        }
    }
}

static void grow_box(int32_t width, int32_t height, const snow_options *options)
{
    static const size_t kinds[] = {10 /* line in space */, 11, 12, 13, 15};
    for (size_t i = 0; i < COUNT_OF(kinds); i++) {
        snow_aggregate_params params = aggregate_kind(kinds[i]);
        params.width = width;
        params.depth = width < 1024 ? width : 1024;
        params.height = height;
        params.wall_right = params.wall_right_top = width - 1;
        params.particles = (uint64_t)width * (uint64_t)height;
        params.density = 1e-6;
        snow_grid *grid = untouched;
        snow_status status = snow_aggregate_create(&params, options, &grid);
        assert_answer(status, grid, options);
    }
}

static void products_do_not_overflow(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(sides) * COUNT_OF(sides) * COUNT_OF(limits); i++) {
        int32_t width = sides[i % COUNT_OF(sides)], height = sides[i / COUNT_OF(sides) % COUNT_OF(sides)];
        test_allocator allocator = {0};
        snow_options options = allocator_options(&allocator);
        options.memory_limit = limits[i / COUNT_OF(sides) / COUNT_OF(sides)];
        grow_rectangle(width, height, &options);
        grow_torus(width, height, &options);
        grow_box(width, height, &options);
    }
}

/* Lists with more bytes than there can be, which wrap round to a few. */
static void counts_do_not_overflow(void **state)
{
    (void)state;
    static const snow_cell origin = {0, 0};
    static const snow_site site = {0, 0, 0};
    snow_reiter_params reiter = disc_scene(0.4, 0.01, 1, 5);
    reiter.seeds = &origin;
    reiter.seed_count = SIZE_MAX / sizeof origin + 2;
    snow_aggregate_params aggregate = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    aggregate.seeds = &site;
    aggregate.seed_count = SIZE_MAX / sizeof site + 2;
    snow_grid *grid = untouched;
    assert_status(SNOW_ERROR_TOO_LARGE, snow_reiter_create(&reiter, NULL, &grid));
    assert_status(SNOW_ERROR_AGGREGATE_PARTICLES, snow_aggregate_create(&aggregate, NULL, &grid));
    aggregate.seed_count = 1;
    aggregate.obstacles = &site;
    aggregate.obstacle_count = SIZE_MAX / sizeof site + 2;
    assert_status(SNOW_ERROR_AGGREGATE_PARTICLES, snow_aggregate_create(&aggregate, NULL, &grid));
    assert_ptr_equal(untouched, grid);
}

/* Seeds so far out that the sites between them are more than a size_t can count on some machines. */
static void distances_do_not_overflow(void **state)
{
    (void)state;
    static const snow_aggregate_lattice lattices[] = {SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_HEXAGONAL,
                                                      SNOW_AGGREGATE_CUBIC};
    for (size_t i = 0; i < COUNT_OF(lattices); i++) {
        for (int32_t distance = 1 << 14; distance <= 1 << 26; distance += distance / 2) {
            test_allocator allocator = {0};
            snow_options options = allocator_options(&allocator);
            options.memory_limit = 64 << 20;
            snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
            params.lattice = lattices[i];
            const snow_site seeds[] = {{0, 0, 0}, {distance, 0, 0}};
            params.seeds = seeds;
            params.seed_count = COUNT_OF(seeds);
            snow_grid *grid = untouched;
            snow_status status = snow_aggregate_create(&params, &options, &grid);
            assert_true(allocator.peak_bytes <= options.memory_limit);
            if (status == SNOW_OK) {
                assert_ok(snow_step(grid, 1));
                snow_destroy(grid);
            } else {
                assert_true(status == SNOW_ERROR_MEMORY_LIMIT || status == SNOW_ERROR_TOO_LARGE ||
                            status == SNOW_ERROR_AGGREGATE_SEED);
                assert_ptr_equal(untouched, grid);
            }
            assert_int_equal(0, allocator.live_blocks);
        }
    }
}

/* Extents whose product is a small number in 32 or 64 bits: the array is too small for them, and nothing is written. */
static void answers_do_not_overflow(void **state)
{
    (void)state;
    snow_packard_params params = packard_scene("0100000");
    snow_grid *grid = NULL;
    assert_ok(snow_packard_create(&params, NULL, &grid));
    uint64_t words[4] = {7, 7, 7, 7};
    const int64_t widths[] = {INT64_C(1) << 32, INT64_C(1) << 38, (INT64_C(1) << 38) + 64, INT64_C(1) << 60};
    const int64_t heights[] = {1, INT64_C(1) << 26, INT64_C(1) << 32, INT64_C(1) << 58, INT64_C(1) << 61};
    for (size_t i = 0; i < COUNT_OF(widths); i++)
        for (size_t k = 0; k < COUNT_OF(heights); k++)
            assert_status(SNOW_ERROR_BUFFER,
                          snow_packard_copy_bits(grid, 0, 0, widths[i], heights[k], words, COUNT_OF(words)));
    const int32_t extents[] = {1 << 16, 1 << 30, INT32_MAX};
    double values[4] = {7, 7, 7, 7};
    for (size_t i = 0; i < COUNT_OF(extents); i++) {
        for (size_t k = 0; k < COUNT_OF(extents); k++) {
            const snow_rect rect = {0, 0, extents[i], extents[k]};
            snow_status status = snow_field_copy(grid, SNOW_FIELD_FROZEN, &rect, values, COUNT_OF(values), NULL);
            assert_true(status == SNOW_ERROR_BUFFER || status == SNOW_ERROR_TOO_LARGE ||
                        status == SNOW_ERROR_RECTANGLE);
        }
    }
    snow_view view;
    snow_view_init(&view, sizeof view);
    view.width = view.height = 65535;
    view.pixel = SNOW_PIXEL_RGBA;
    size_t size = 0;
    snow_status status = snow_render(grid, &view, values, sizeof values, &size);
    assert_true(status == (SIZE_MAX > UINT32_MAX ? SNOW_ERROR_BUFFER : SNOW_ERROR_RANGE));
    for (size_t i = 0; i < COUNT_OF(words); i++) {
        assert_int_equal(7, words[i]);
        assert_same_double(7, values[i]);
    }
    snow_destroy(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_call_survives_any_failure),
        cmocka_unit_test(making_survives_any_failure),
        cmocka_unit_test(memory_limits_are_kept),
        cmocka_unit_test(loads_keep_to_the_limit),
        cmocka_unit_test(hostile_data_cost_little),
        cmocka_unit_test(products_do_not_overflow),
        cmocka_unit_test(counts_do_not_overflow),
        cmocka_unit_test(distances_do_not_overflow),
        cmocka_unit_test(answers_do_not_overflow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
