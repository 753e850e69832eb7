/* What goes wrong outside, for every model: writers and readers that fail or give little at every byte, runs that are
   cancelled at every step or run out of time. */
#include "support/grids.h"
#include "support/lives.h"

#include <stdlib.h>
#include <string.h>

static snow_grid *const untouched = (snow_grid *)(uintptr_t)0x1230;

/* --- saving --- */

typedef struct weak_writer {
    size_t room; /* bytes until it fails */
    bool failed;
} weak_writer;

static int write_until_full(void *context, const void *bytes, size_t size)
{
    weak_writer *writer = context;
    assert_non_null(bytes);
    assert_true(size > 0);
    assert_false(writer->failed); /* it is not called again */
    writer->failed = size > writer->room;
    writer->room -= writer->failed ? 0 : size;
    return writer->failed ? -1 : 0;
}

static void a_writer_may_fail_anywhere(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_life_count; i++) {
        snow_grid *grid = start_life(&test_lives[i], false, NULL);
        assert_ok(snow_step(grid, 12));
        saved_life before = save_life(grid);
        for (size_t room = 0; room <= before.size; room++) {
            weak_writer writer = {room, false};
            snow_status status = snow_save_to(grid, write_until_full, &writer);
            assert_status(room < before.size ? SNOW_ERROR_WRITE : SNOW_OK, status);
            assert_true(writer.failed == (room < before.size));
        }
        saved_life after = save_life(grid);
        assert_same_lives(&before, &after, test_lives[i].name);
        free_life(&before);
        free_life(&after);
        snow_destroy(grid);
    }
}

/* Buffers of every size: too small ones are left alone. */
static void a_buffer_may_end_anywhere(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_life_count; i++) {
        snow_grid *grid = start_life(&test_lives[i], false, NULL);
        saved_life saved = save_life(grid);
        unsigned char *buffer = malloc(saved.size);
        assert_non_null(buffer);
        for (size_t capacity = 0; capacity < saved.size; capacity += 1 + capacity / 8) {
            memset(buffer, 0xa7, saved.size);
            size_t size = 0;
            assert_status(SNOW_ERROR_BUFFER, snow_save(grid, buffer, capacity, &size));
            assert_int_equal(saved.size, size);
            for (size_t k = 0; k < saved.size; k++)
                assert_int_equal(0xa7, buffer[k]);
        }
        free(buffer);
        free_life(&saved);
        snow_destroy(grid);
    }
}

/* --- loading --- */

typedef struct weak_reader {
    const saved_life *saved;
    size_t next;
    size_t piece; /* bytes that it gives at a time */
    size_t end;   /* where it ends, or fails */
    bool fails;
} weak_reader;

static int read_until_end(void *context, void *bytes, size_t size, size_t *got)
{
    weak_reader *reader = context;
    size_t left = reader->end - reader->next;
    *got = left < reader->piece ? left : reader->piece;
    *got = size < *got ? size : *got;
    if (*got == 0)
        return reader->fails;
    memcpy(bytes, reader->saved->bytes + reader->next, *got);
    reader->next += *got;
    return 0;
}

static saved_life grown_life(const test_life *life)
{
    snow_grid *grid = start_life(life, false, NULL);
    assert_ok(snow_step(grid, 12));
    saved_life saved = save_life(grid);
    snow_destroy(grid);
    return saved;
}

static void a_reader_may_give_little_at_a_time(void **state)
{
    (void)state;
    static const size_t pieces[] = {1, 2, 7, 4096};
    for (size_t i = 0; i < test_life_count; i++) {
        saved_life saved = grown_life(&test_lives[i]);
        for (size_t k = 0; k < COUNT_OF(pieces); k++) {
            weak_reader reader = {&saved, 0, pieces[k], saved.size, false};
            snow_grid *grid = NULL;
            assert_ok(snow_load_from(read_until_end, &reader, NULL, &grid));
            saved_life again = save_life(grid);
            assert_same_lives(&saved, &again, test_lives[i].name);
            free_life(&again);
            snow_destroy(grid);
        }
        free_life(&saved);
    }
}

/* More than a reader's text has room for at first. */
static void a_large_grid_is_read_whole(void **state)
{
    (void)state;
    size_t largest = 0;
    for (size_t i = 0; i < test_life_count; i++) {
        snow_grid *grid = start_life(&test_lives[i], true, NULL);
        assert_ok(snow_step(grid, 3));
        saved_life saved = save_life(grid);
        weak_reader reader = {&saved, 0, 50000, saved.size, false};
        snow_grid *copy = NULL;
        assert_ok(snow_load_from(read_until_end, &reader, NULL, &copy));
        assert_true(digest_of(grid) == digest_of(copy));
        assert_ok(snow_step(grid, 2));
        assert_ok(snow_step(copy, 2));
        assert_true(digest_of(grid) == digest_of(copy));
        largest = saved.size > largest ? saved.size : largest;
        free_life(&saved);
        snow_destroy(copy);
        snow_destroy(grid);
    }
    assert_true(largest > 200000);
}

static void a_reader_may_end_or_fail_anywhere(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_life_count; i++) {
        saved_life saved = grown_life(&test_lives[i]);
        for (size_t end = 0; end < saved.size; end++) {
            weak_reader reader = {&saved, 0, 1 + end % 97, end, end % 2 == 1};
            snow_grid *grid = untouched;
            snow_status status = snow_load_from(read_until_end, &reader, NULL, &grid);
            if (reader.fails)
                assert_status(SNOW_ERROR_READ, status);
            else
                assert_true(status == SNOW_ERROR_TRUNCATED || status == SNOW_ERROR_DAMAGED);
            assert_ptr_equal(untouched, grid);
        }
        free_life(&saved);
    }
}

static void damaged_bytes_are_noticed(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_life_count; i++) {
        saved_life saved = grown_life(&test_lives[i]);
        for (size_t k = 0; k < saved.size; k++) {
            unsigned char harm = (unsigned char)(1U << k % 8);
            saved.bytes[k] ^= harm;
            snow_grid *grid = untouched;
            assert_true(snow_load(saved.bytes, saved.size, NULL, &grid) != SNOW_OK);
            assert_ptr_equal(untouched, grid);
            saved.bytes[k] ^= harm;
        }
        free_life(&saved);
    }
}

/* From the first step on, whatever an engine holds by then, a grid is saved, loaded and goes on alike. */
static void a_grid_is_saved_after_every_step(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_life_count; i++) {
        snow_grid *grid = start_life(&test_lives[i], false, NULL);
        for (int step = 0; step < 24; step++) {
            saved_life saved = save_life(grid);
            snow_grid *copy = NULL;
            assert_ok(snow_load(saved.bytes, saved.size, NULL, &copy));
            free_life(&saved);
            assert_ok(snow_step(copy, 3));
            assert_ok(snow_step(grid, 1));
            snow_grid *later = NULL;
            saved = save_life(grid);
            assert_ok(snow_load(saved.bytes, saved.size, NULL, &later));
            assert_ok(snow_step(later, 2));
            assert_true(digest_of(copy) == digest_of(later));
            free_life(&saved);
            snow_destroy(copy);
            snow_destroy(later);
        }
        snow_destroy(grid);
    }
}

/* --- runs that are cut short --- */

static int cancel(void *context, const snow_grid *grid, const snow_summary *summary)
{
    (void)grid;
    (void)summary;
    ++*(int *)context;
    return 1;
}

static void a_run_may_be_cancelled_at_every_step(void **state)
{
    (void)state;
    enum { STEPS = 40 };
    for (size_t i = 0; i < test_life_count; i++) {
        snow_grid *whole = start_life(&test_lives[i], false, NULL);
        snow_grid *grid = start_life(&test_lives[i], false, NULL);
        int calls = 0;
        snow_stop stop = stop_after(STEPS);
        snow_stop all = stop;
        stop.progress = cancel;
        stop.progress_context = &calls;
        stop.progress_steps = 1;
        for (int64_t step = 1; step < STEPS; step++) {
            snow_summary summary = run_grid(grid, &stop);
            assert_int_equal(SNOW_STOP_CANCELLED, summary.reason);
            assert_int_equal(step, summary.steps);
            assert_int_equal(step, calls);
        }
        assert_int_equal(SNOW_STOP_STEPS, run_grid(grid, &stop).reason);
        assert_int_equal(SNOW_STOP_STEPS, run_grid(whole, &all).reason);
        assert_true(digest_of(whole) == digest_of(grid));
        snow_destroy(grid);
        snow_destroy(whole);
    }
}

static int do_not_cancel(void *context, const snow_grid *grid, const snow_summary *summary)
{
    (void)context;
    (void)grid;
    (void)summary;
    return 0;
}

/* However small the budget is, a run takes a step or more, so that slices come to the end; and to the same one. With a
   callback at each step no engine takes several at once, and each step ends its slice. */
static void a_run_may_run_out_of_time(void **state)
{
    (void)state;
    enum { STEPS = 40 };
    for (size_t i = 0; i < test_life_count; i++) {
        snow_grid *whole = start_life(&test_lives[i], false, NULL);
        snow_grid *grid = start_life(&test_lives[i], false, NULL);
        snow_stop stop = stop_after(STEPS);
        assert_int_equal(SNOW_STOP_STEPS, run_grid(whole, &stop).reason);
        stop.seconds = 1e-300;
        stop.progress = do_not_cancel;
        stop.progress_steps = 1;
        snow_summary summary = {.reason = SNOW_STOP_TIME};
        int slices = 0;
        for (; summary.reason == SNOW_STOP_TIME; slices++) {
            assert_true(slices <= STEPS);
            int64_t before = steps_of(grid);
            summary = run_grid(grid, &stop);
            assert_true(summary.steps > before);
        }
        assert_int_equal(SNOW_STOP_STEPS, summary.reason);
        assert_int_equal(STEPS, slices);
        assert_true(digest_of(whole) == digest_of(grid));
        snow_destroy(grid);
        snow_destroy(whole);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_writer_may_fail_anywhere),
        cmocka_unit_test(a_buffer_may_end_anywhere),
        cmocka_unit_test(a_reader_may_give_little_at_a_time),
        cmocka_unit_test(a_large_grid_is_read_whole),
        cmocka_unit_test(a_reader_may_end_or_fail_anywhere),
        cmocka_unit_test(damaged_bytes_are_noticed),
        cmocka_unit_test(a_grid_is_saved_after_every_step),
        cmocka_unit_test(a_run_may_be_cancelled_at_every_step),
        cmocka_unit_test(a_run_may_run_out_of_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
