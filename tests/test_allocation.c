/* Memory: everything comes from the caller's allocator, goes back to it, and keeps to the limit; the n-th allocation
   may fail for every n. */
#include "support/allocator.h"
#include "support/grids.h"

#include <stdlib.h>
#include <string.h>

static snow_grid *const untouched = (snow_grid *)(uintptr_t)0x1230;

static double flat(void *context, int32_t q, int32_t r)
{
    (void)context;
    (void)q;
    (void)r;
    return 0.25;
}

/* With everything that can be kept for a cell. */
static snow_reiter_params rich_scene(snow_reiter_engine engine)
{
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 12);
    params.record_freeze_steps = 1;
    params.addition_at = flat;
    params.engine = engine;
    return params;
}

static const snow_reiter_engine engines[] = {SNOW_REITER_ENGINE_ROWS, SNOW_REITER_ENGINE_REFERENCE,
                                             SNOW_REITER_ENGINE_QUAD};

static void everything_goes_back(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        for (int32_t threads = 1; threads <= 3; threads++) {
            test_allocator allocator = {0};
            snow_options options = allocator_options(&allocator);
            options.threads = threads;
            snow_reiter_params params = rich_scene(engines[i]);
            snow_grid *grid = make_grid(&params, &options);
            uint64_t bytes = 0;
            assert_ok(snow_memory(grid, &bytes));
            assert_int_equal(allocator.live_bytes, bytes);
            assert_ok(snow_step(grid, 20));
            assert_ok(snow_memory(grid, &bytes));
            assert_int_equal(allocator.live_bytes, bytes);
            snow_destroy(grid);
            assert_int_equal(0, allocator.live_blocks);
            assert_int_equal(0, allocator.live_bytes);
        }
    }
}

static void stepping_asks_for_none(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        test_allocator allocator = {0};
        snow_options options = allocator_options(&allocator);
        options.threads = 2;
        snow_reiter_params params = disc_scene(0.6, 0.05, 1, 20);
        params.record_freeze_steps = 1;
        params.engine = engines[i];
        snow_grid *grid = make_grid(&params, &options);
        size_t calls = allocator.calls, blocks = allocator.live_blocks;
        assert_ok(snow_step(grid, 50));
        run_grid(grid, NULL);
        digest_of(grid);
        defect_of(grid);
        free(copy_field(grid, SNOW_FIELD_VALUE, NULL, NULL));
        size_t size;
        assert_ok(snow_save(grid, NULL, 0, &size));
        assert_true(frozen_of(grid) > 100);
        assert_int_equal(calls, allocator.calls);
        assert_int_equal(blocks, allocator.live_blocks);
        snow_destroy(grid);
    }
}

static double bytes_a_cell(snow_reiter_symmetry symmetry, int32_t record)
{
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 400);
    params.record_freeze_steps = record;
    params.symmetry = symmetry;
    snow_grid *grid = make_grid(&params, NULL);
    uint64_t bytes;
    assert_ok(snow_memory(grid, &bytes));
    double each = (double)bytes / (double)cells_of(grid);
    snow_destroy(grid);
    return each;
}

/* 41 bytes a cell, 45 with freeze steps, a twelfth of that where all symmetries are used, and some for each row. */
static void memory_is_what_the_manual_says(void **state)
{
    (void)state;
    assert_near(41, bytes_a_cell(SNOW_REITER_SYMMETRY_NONE, 0), 1.5);
    assert_near(45, bytes_a_cell(SNOW_REITER_SYMMETRY_NONE, 1), 1.5);
    assert_near(41.0 / 12, bytes_a_cell(SNOW_REITER_SYMMETRY_AUTO, 0), 0.6);
    assert_near(45.0 / 12, bytes_a_cell(SNOW_REITER_SYMMETRY_AUTO, 1), 0.6);
}

/* Calls `attempt` with the n-th allocation failing, for n = 1, 2, … until it succeeds; with only that one failing,
   and with all later ones failing as well. */
typedef snow_status (*attempt_call)(const snow_options *options, void *context);

static size_t fail_every_allocation(attempt_call attempt, void *context)
{
    size_t failures = 0;
    for (int after = 0; after <= 1; after++) {
        for (size_t n = 1;; n++) {
            test_allocator allocator = {.fail_at = n, .fail_after = after == 1};
            snow_options options = allocator_options(&allocator);
            snow_status status = attempt(&options, context);
            assert_int_equal(0, allocator.live_blocks);
            if (status == SNOW_OK) {
                assert_true(allocator.calls < n);
                break;
            }
            assert_status(SNOW_ERROR_NO_MEMORY, status);
            failures++;
        }
    }
    return failures;
}

static snow_status create_and_destroy(const snow_options *options, void *context)
{
    snow_grid *grid = untouched;
    snow_status status = snow_reiter_create(context, options, &grid);
    if (status == SNOW_OK)
        snow_destroy(grid);
    else
        assert_ptr_equal(untouched, grid);
    return status;
}

static snow_status create_on_threads(const snow_options *options, void *context)
{
    snow_options threaded = *options;
    threaded.threads = 3;
    return create_and_destroy(&threaded, context);
}

static void creating_survives_any_failure(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_reiter_params params = rich_scene(engines[i]);
        snow_reiter_params before = params;
        assert_true(fail_every_allocation(create_and_destroy, &params) > 4);
        assert_true(fail_every_allocation(create_on_threads, &params) > 4);
        assert_memory_equal(&before, &params, sizeof params);
    }
}

static void creating_that_fails_otherwise_leaks_nothing(void **state)
{
    (void)state;
    static const snow_cell outside = {50, 50};
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        test_allocator allocator = {0};
        snow_options options = allocator_options(&allocator);
        options.threads = 2;
        snow_reiter_params params = rich_scene(engines[i]);
        params.seeds = &outside;
        params.seed_count = 1;
        snow_grid *grid = untouched;
        assert_status(SNOW_ERROR_REITER_SEED, snow_reiter_create(&params, &options, &grid));
        assert_ptr_equal(untouched, grid);
        assert_int_equal(0, allocator.live_blocks);
    }
}

typedef struct saved_bytes {
    unsigned char *bytes;
    size_t size;
    size_t next;
} saved_bytes;

static saved_bytes save(const snow_reiter_params *params)
{
    snow_grid *grid = make_grid(params, NULL);
    assert_ok(snow_step(grid, 10));
    saved_bytes saved = {NULL, 0, 0};
    assert_ok(snow_save(grid, NULL, 0, &saved.size));
    saved.bytes = malloc(saved.size);
    assert_non_null(saved.bytes);
    assert_ok(snow_save(grid, saved.bytes, saved.size, &saved.size));
    snow_destroy(grid);
    return saved;
}

static snow_status load_and_destroy(const snow_options *options, void *context)
{
    const saved_bytes *saved = context;
    snow_grid *grid = untouched;
    snow_status status = snow_load(saved->bytes, saved->size, options, &grid);
    if (status == SNOW_OK)
        snow_destroy(grid);
    else
        assert_ptr_equal(untouched, grid);
    return status;
}

static int read_saved(void *context, void *bytes, size_t size, size_t *got)
{
    saved_bytes *saved = context;
    size_t left = saved->size - saved->next;
    *got = left < size ? left : size;
    memcpy(bytes, saved->bytes + saved->next, *got);
    saved->next += *got;
    return 0;
}

static snow_status load_from_and_destroy(const snow_options *options, void *context)
{
    saved_bytes *saved = context;
    saved->next = 0;
    snow_grid *grid = untouched;
    snow_status status = snow_load_from(read_saved, saved, options, &grid);
    if (status == SNOW_OK)
        snow_destroy(grid);
    else
        assert_ptr_equal(untouched, grid);
    return status;
}

static void loading_survives_any_failure(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_reiter_params params = rich_scene(engines[i]);
        saved_bytes saved = save(&params);
        assert_true(fail_every_allocation(load_and_destroy, &saved) > 4);
        assert_true(fail_every_allocation(load_from_and_destroy, &saved) > 4);
        free(saved.bytes);
    }
}

/* From here on the grid exists and its allocator fails: it must stay as it was and be usable. */
static void a_set_that_gets_no_memory_changes_nothing(void **state)
{
    (void)state;
    static const snow_field fields[] = {SNOW_FIELD_VALUE, SNOW_FIELD_VAPOUR, SNOW_FIELD_ADDITION,
                                        SNOW_FIELD_BACKGROUND};
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        for (size_t k = 0; k < COUNT_OF(fields); k++) {
            test_allocator allocator = {0};
            snow_options options = allocator_options(&allocator);
            snow_reiter_params params = disc_scene(0.4, 0.01, 1, 9);
            params.engine = engines[i];
            snow_grid *grid = make_grid(&params, &options);
            snow_grid *plain = make_grid(&params, NULL);
            assert_ok(snow_step(grid, 10));
            assert_ok(snow_step(plain, 10));
            double value = 0.125;
            snow_rect rect = {fields[k] == SNOW_FIELD_BACKGROUND ? 9 : 5, 0, 1, 1};
            snow_status status = SNOW_ERROR_NO_MEMORY;
            for (size_t n = 1; status != SNOW_OK; n++) {
                size_t blocks = allocator.live_blocks;
                allocator.fail_at = allocator.calls + n;
                status = snow_field_set(grid, fields[k], &rect, &value, 1);
                if (status == SNOW_OK)
                    break;
                assert_status(SNOW_ERROR_NO_MEMORY, status);
                assert_int_equal(blocks, allocator.live_blocks);
                assert_same_grids(plain, grid);
                assert_ok(snow_step(grid, 1));
                assert_ok(snow_step(plain, 1));
            }
            allocator.fail_at = 0;
            assert_ok(snow_field_set(plain, fields[k], &rect, &value, 1));
            assert_ok(snow_step(grid, 10));
            assert_ok(snow_step(plain, 10));
            assert_same_grids(plain, grid);
            snow_destroy(plain);
            snow_destroy(grid);
            assert_int_equal(0, allocator.live_blocks);
        }
    }
}

static void a_change_works_without_memory(void **state)
{
    (void)state;
    for (size_t i = 0; i < 2 * COUNT_OF(engines); i++) {
        test_allocator allocator = {0};
        snow_options options = allocator_options(&allocator);
        snow_reiter_params params = rich_scene(engines[i / 2]);
        if (i % 2 == 1)
            params.addition_at = NULL; /* then it is computed by its symmetry */
        snow_grid *grid = make_grid(&params, &options);
        assert_ok(snow_step(grid, 10));
        allocator.fail_at = allocator.calls + 1;
        allocator.fail_after = true;
        snow_reiter_conditions conditions;
        snow_reiter_conditions_init(&conditions, sizeof conditions);
        conditions.background = 0.5;
        conditions.addition = 0.02;
        assert_ok(snow_reiter_change(grid, &conditions));
        assert_ok(snow_step(grid, 10));
        assert_same_double(0.02, value_at(grid, SNOW_FIELD_ADDITION, 2, 2));
        run_grid(grid, NULL);
        snow_destroy(grid);
        assert_int_equal(0, allocator.live_blocks);
    }
}

static void drawing_survives_any_failure(void **state)
{
    (void)state;
    test_allocator allocator = {0};
    snow_options options = allocator_options(&allocator);
    snow_reiter_params params = rich_scene(SNOW_REITER_ENGINE_AUTO);
    snow_grid *grid = make_grid(&params, &options);
    assert_ok(snow_step(grid, 30));
    snow_view view;
    snow_view_init(&view, sizeof view);
    assert_ok(snow_view_fit(grid, 60, &view));
    size_t size = 0;
    assert_ok(snow_render(grid, &view, NULL, 0, &size));
    unsigned char *expected = malloc(size), *pixels = malloc(size);
    assert_non_null(expected);
    assert_non_null(pixels);
    size_t blocks = allocator.live_blocks;
    size_t before = allocator.calls;
    assert_ok(snow_render(grid, &view, expected, size, NULL));
    size_t needed = allocator.calls - before;
    assert_int_equal(blocks, allocator.live_blocks);
    for (size_t n = 1; n <= needed; n++) {
        memset(pixels, 0xa7, size);
        allocator.fail_at = allocator.calls + n;
        assert_status(SNOW_ERROR_NO_MEMORY, snow_render(grid, &view, pixels, size, NULL));
        assert_int_equal(blocks, allocator.live_blocks);
        for (size_t i = 0; i < size; i++)
            assert_int_equal(0xa7, pixels[i]);
    }
    allocator.fail_at = 0;
    assert_ok(snow_render(grid, &view, pixels, size, NULL));
    assert_memory_equal(expected, pixels, size);
    free(expected);
    free(pixels);
    snow_destroy(grid);
    assert_int_equal(0, allocator.live_blocks);
}

/* Every limit up to the one that suffices: refused, or kept to. */
static void the_memory_limit_is_kept(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_reiter_params params = rich_scene(engines[i]);
        params.radius = 6;
        test_allocator allocator = {0};
        snow_options options = allocator_options(&allocator);
        snow_grid *grid = make_grid(&params, &options);
        uint64_t needed = allocator.peak_bytes;
        snow_destroy(grid);
        for (uint64_t limit = 1; limit <= needed; limit += limit + 64 < needed ? 61 : 1) {
            allocator = (test_allocator){0};
            options.memory_limit = limit;
            grid = untouched;
            snow_status status = snow_reiter_create(&params, &options, &grid);
            assert_true(allocator.peak_bytes <= limit);
            if (limit < needed) {
                assert_status(SNOW_ERROR_MEMORY_LIMIT, status);
                assert_ptr_equal(untouched, grid);
            } else {
                assert_ok(status);
                assert_ok(snow_step(grid, 5));
                snow_destroy(grid);
            }
            assert_int_equal(0, allocator.live_blocks);
        }
    }
}

static void a_set_beyond_the_memory_limit_changes_nothing(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 9);
    test_allocator allocator = {0};
    snow_options options = allocator_options(&allocator);
    snow_grid *grid = make_grid(&params, &options);
    uint64_t needed = allocator.peak_bytes;
    snow_destroy(grid);
    options.memory_limit = needed + 8;
    grid = make_grid(&params, &options);
    assert_ok(snow_step(grid, 5));
    uint64_t digest = digest_of(grid);
    double value = 0.5;
    assert_status(SNOW_ERROR_MEMORY_LIMIT,
                  snow_field_set(grid, SNOW_FIELD_ADDITION, &(snow_rect){0, 0, 1, 1}, &value, 1));
    assert_true(digest == digest_of(grid));
    assert_same_double(0.01, value_at(grid, SNOW_FIELD_ADDITION, 0, 0));
    assert_ok(snow_step(grid, 5));
    snow_destroy(grid);
}

/* malloc() promises boundaries of 16 bytes, no more. */
static void the_bits_do_not_depend_on_addresses(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_reiter_params params = rich_scene(engines[i]);
        snow_grid *plain = make_grid(&params, NULL);
        assert_ok(snow_step(plain, 30));
        for (size_t shift = 0; shift < 4; shift++) {
            test_allocator allocator = {.shift = 16 * shift};
            snow_options options = allocator_options(&allocator);
            snow_grid *grid = make_grid(&params, &options);
            assert_ok(snow_step(grid, 30));
            assert_same_grids(plain, grid);
            snow_destroy(grid);
            assert_int_equal(0, allocator.live_blocks);
        }
        snow_destroy(plain);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everything_goes_back),
        cmocka_unit_test(stepping_asks_for_none),
        cmocka_unit_test(memory_is_what_the_manual_says),
        cmocka_unit_test(creating_survives_any_failure),
        cmocka_unit_test(creating_that_fails_otherwise_leaks_nothing),
        cmocka_unit_test(loading_survives_any_failure),
        cmocka_unit_test(a_set_that_gets_no_memory_changes_nothing),
        cmocka_unit_test(a_change_works_without_memory),
        cmocka_unit_test(drawing_survives_any_failure),
        cmocka_unit_test(the_memory_limit_is_kept),
        cmocka_unit_test(a_set_beyond_the_memory_limit_changes_nothing),
        cmocka_unit_test(the_bits_do_not_depend_on_addresses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
