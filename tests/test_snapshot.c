/* Saving and loading: nothing is lost, and nothing in the data is trusted. */
#include "support/allocator.h"
#include "support/grids.h"

#include <stdlib.h>
#include <string.h>

typedef struct snapshot {
    unsigned char *bytes;
    size_t size;
} snapshot;

static snapshot save(const snow_grid *grid)
{
    snapshot saved = {NULL, 0};
    assert_ok(snow_save(grid, NULL, 0, &saved.size));
    assert_true(saved.size > 0);
    saved.bytes = malloc(saved.size);
    assert_non_null(saved.bytes);
    size_t size = 0;
    assert_ok(snow_save(grid, saved.bytes, saved.size, &size));
    assert_int_equal(saved.size, size);
    return saved;
}

static snow_grid *load(const snapshot *saved, const snow_options *options)
{
    snow_grid *grid = NULL;
    assert_ok(snow_load(saved->bytes, saved->size, options, &grid));
    assert_non_null(grid);
    return grid;
}

static double uneven(void *context, int32_t q, int32_t r)
{
    (void)context;
    return ((q + 3 * r) & 15) / 64.0;
}

/* Scenes that between them use all that a snapshot holds. */
enum { SCENES = 9 };

static snow_reiter_params scene(size_t index)
{
    static const snow_cell seeds[] = {{0, 0}, {3, -1}};
    snow_reiter_params scenes[SCENES] = {
        disc_scene(0.4, 0.01, 1, 12),      hexagon_scene(0.3, 0.02, 0.5, 9), rectangle_scene(0.5, 0.01, 1, 15, 11),
        disc_scene(0.4, 0.01, 2.6, 10),    disc_scene(0.4, 0.01, 1, 12),     disc_scene(0.9, 0.05, 4, 6),
        rectangle_scene(0.2, 0.5, 1, 1, 1), disc_scene(0, 0, 1, 5),
        disc_scene(0.4, 0.01, 1, 12),
    };
    scenes[1].record_freeze_steps = 1;
    scenes[1].noise = 0.1;
    scenes[2].rim = SNOW_REITER_RIM_ROW;
    scenes[2].record_freeze_steps = 1;
    scenes[3].seeds = seeds;
    scenes[3].seed_count = COUNT_OF(seeds);
    scenes[4].background_at = uneven;
    scenes[4].addition_at = uneven;
    scenes[4].record_freeze_steps = 1;
    scenes[5].allow_unstable = 1;
    without_seeds(&scenes[7]);
    scenes[8].precision = SNOW_REITER_PRECISION_SINGLE;
    return scenes[index];
}

/* A scene for an engine; the quad engine has one precision. */
static snow_reiter_params scene_for(size_t index, snow_reiter_engine engine)
{
    snow_reiter_params params = scene(index);
    params.engine = engine;
    if (engine == SNOW_REITER_ENGINE_QUAD)
        params.precision = SNOW_REITER_PRECISION_DOUBLE;
    return params;
}

static const snow_reiter_engine engines[] = {SNOW_REITER_ENGINE_ROWS, SNOW_REITER_ENGINE_REFERENCE,
                                             SNOW_REITER_ENGINE_QUAD, SNOW_REITER_ENGINE_AUTO};

static void save_load_continue_is_continue(void **state)
{
    (void)state;
    snow_isa isas[8];
    size_t isa_count = available_isas(isas);
    for (size_t i = 0; i < SCENES; i++) {
        for (size_t k = 0; k < COUNT_OF(engines); k++) {
            snow_reiter_params params = scene_for(i, engines[k]);
            snow_grid *plain = make_grid(&params, NULL);
            for (int part = 0; part < 5; part++) {
                snapshot saved = save(plain);
                snow_options options = default_options();
                options.isa = isas[(size_t)part % isa_count];
                options.threads = part + 1;
                snow_grid *loaded = load(&saved, &options);
                assert_same_grids(plain, loaded);
                assert_int_equal(records_freeze_steps(plain), records_freeze_steps(loaded));

                snapshot again = save(loaded);
                assert_int_equal(saved.size, again.size);
                assert_memory_equal(saved.bytes, again.bytes, saved.size);

                snow_status expected = snow_step(plain, 13);
                assert_status(expected, snow_step(loaded, 13));
                assert_same_grids(plain, loaded);
                snow_destroy(loaded);
                free(saved.bytes);
                free(again.bytes);
            }
            snow_destroy(plain);
        }
    }
}

static void a_loaded_run_ends_like_the_other(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.005, 1, 25);
    params.noise = 0.05;
    snow_grid *plain = make_grid(&params, NULL);
    assert_ok(snow_step(plain, 77));
    snapshot saved = save(plain);
    snow_grid *loaded = load(&saved, NULL);
    snow_summary expected = run_grid(plain, NULL);
    snow_summary got = run_grid(loaded, NULL);
    assert_int_equal(expected.reason, got.reason);
    assert_int_equal(expected.steps, got.steps);
    assert_same_grids(plain, loaded);
    free(saved.bytes);
    snow_destroy(plain);
    snow_destroy(loaded);

    /* A grid that was found still is still after loading, and one at its rim is at its rim. */
    params = disc_scene(0, 0, 1, 6);
    plain = make_grid(&params, NULL);
    assert_int_equal(SNOW_STOP_STILL, run_grid(plain, NULL).reason);
    saved = save(plain);
    loaded = load(&saved, NULL);
    got = run_grid(loaded, NULL);
    assert_int_equal(SNOW_STOP_STILL, got.reason);
    assert_int_equal(1, got.steps);
    free(saved.bytes);
    snow_destroy(plain);
    snow_destroy(loaded);
}

static void what_was_set_and_changed_is_saved(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(engines); k++) {
        snow_reiter_params params = disc_scene(0.4, 0.01, 1, 10);
        params.record_freeze_steps = 1;
        params.engine = engines[k];
        snow_grid *plain = make_grid(&params, NULL);
        assert_ok(snow_step(plain, 10));
        set_cell(plain, SNOW_FIELD_VALUE, 3, 3, 1.5);
        set_cell(plain, SNOW_FIELD_VALUE, 0, 0, 0.5);
        set_cell(plain, SNOW_FIELD_VAPOUR, -6, 0, 0.75);
        set_cell(plain, SNOW_FIELD_ADDITION, 1, 0, 0.25);
        set_cell(plain, SNOW_FIELD_BACKGROUND, 10, 0, 0.8);
        assert_ok(snow_step(plain, 5));
        snow_reiter_conditions conditions;
        snow_reiter_conditions_init(&conditions, sizeof conditions);
        assert_ok(snow_reiter_conditions_of(plain, &conditions));
        conditions.background = 0.3;
        conditions.diffusion = 1.5;
        assert_ok(snow_reiter_change(plain, &conditions));
        assert_ok(snow_step(plain, 5));

        snapshot saved = save(plain);
        snow_grid *loaded = load(&saved, NULL);
        assert_same_grids(plain, loaded);
        snow_reiter_conditions got;
        snow_reiter_conditions_init(&got, sizeof got);
        assert_ok(snow_reiter_conditions_of(loaded, &got));
        assert_same_double(0.3, got.background);
        assert_same_double(0.01, got.addition);
        assert_same_double(1.5, got.diffusion);
        conditions.background = 0.45;
        assert_ok(snow_reiter_change(plain, &conditions));
        assert_ok(snow_reiter_change(loaded, &conditions));
        assert_ok(snow_step(plain, 30));
        assert_ok(snow_step(loaded, 30));
        assert_same_grids(plain, loaded);
        free(saved.bytes);
        snow_destroy(plain);
        snow_destroy(loaded);
    }
}

static void all_engines_save_the_same_cells(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 12);
    params.symmetry = SNOW_REITER_SYMMETRY_NONE;
    params.engine = SNOW_REITER_ENGINE_ROWS;
    snow_grid *rows = make_grid(&params, NULL);
    params.engine = SNOW_REITER_ENGINE_REFERENCE;
    snow_grid *reference = make_grid(&params, NULL);
    assert_ok(snow_step(rows, 40));
    assert_ok(snow_step(reference, 40));
    snapshot left = save(rows);
    snapshot right = save(reference);
    assert_int_equal(left.size, right.size);
    size_t different = 0;
    for (size_t i = 0; i < left.size; i++)
        different += left.bytes[i] != right.bytes[i];
    /* The number of the engine, and the checksum. */
    assert_true(different <= 1 + 8);
    free(left.bytes);
    free(right.bytes);
    snow_destroy(rows);
    snow_destroy(reference);
}

static void buffers_that_are_too_small_stay_untouched(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 3);
    snow_grid *grid = make_grid(&params, NULL);
    snapshot saved = save(grid);
    unsigned char *buffer = malloc(saved.size);
    assert_non_null(buffer);
    for (size_t capacity = 0; capacity < saved.size; capacity++) {
        memset(buffer, 0xa7, saved.size);
        size_t size = 0;
        assert_status(SNOW_ERROR_BUFFER, snow_save(grid, buffer, capacity, &size));
        assert_int_equal(saved.size, size);
        for (size_t i = 0; i < saved.size; i++)
            assert_int_equal(0xa7, buffer[i]);
    }
    free(buffer);
    free(saved.bytes);
    snow_destroy(grid);
}

static int take_nothing(void *context, const void *bytes, size_t size)
{
    (void)context;
    (void)bytes;
    (void)size;
    return 1;
}

static int give_nothing(void *context, void *bytes, size_t size, size_t *got)
{
    (void)context;
    (void)bytes;
    (void)size;
    *got = 0;
    return 0;
}

static snow_grid *const untouched = (snow_grid *)(uintptr_t)0x1230;

static void null_pointers_are_refused(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 3);
    snow_grid *grid = make_grid(&params, NULL);
    char byte = 0;
    size_t size = 77;
    snow_grid *loaded = untouched;
    assert_status(SNOW_ERROR_NULL, snow_save(NULL, &byte, 1, &size));
    assert_status(SNOW_ERROR_NULL, snow_save(grid, &byte, 1, NULL));
    assert_status(SNOW_ERROR_NULL, snow_save_to(NULL, take_nothing, NULL));
    assert_status(SNOW_ERROR_NULL, snow_save_to(grid, NULL, NULL));
    assert_status(SNOW_ERROR_NULL, snow_load(NULL, 1, NULL, &loaded));
    assert_status(SNOW_ERROR_NULL, snow_load(&byte, 1, NULL, NULL));
    assert_status(SNOW_ERROR_NULL, snow_load_from(NULL, NULL, NULL, &loaded));
    assert_status(SNOW_ERROR_NULL, snow_load_from(give_nothing, NULL, NULL, NULL));
    assert_ptr_equal(untouched, loaded);
    assert_int_equal(77, size);
    snow_destroy(grid);
}

/* A writer into memory that fails once it has taken so many bytes. */
typedef struct sink {
    unsigned char *bytes;
    size_t size;
    size_t capacity;
    bool failed;
} sink;

static int write_to(void *context, const void *bytes, size_t size)
{
    sink *to = context;
    assert_true(size > 0);
    assert_false(to->failed);
    if (to->size + size > to->capacity) {
        to->failed = true;
        return 1;
    }
    memcpy(to->bytes + to->size, bytes, size);
    to->size += size;
    return 0;
}

static void writers_get_the_same_bytes_and_may_fail_anywhere(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 40);
    snow_grid *grid = make_grid(&params, NULL);
    assert_ok(snow_step(grid, 60));
    uint64_t digest = digest_of(grid);
    snapshot saved = save(grid);
    sink to = {malloc(saved.size), 0, saved.size, false};
    assert_non_null(to.bytes);
    assert_ok(snow_save_to(grid, write_to, &to));
    assert_int_equal(saved.size, to.size);
    assert_memory_equal(saved.bytes, to.bytes, saved.size);
    for (size_t capacity = 0; capacity < saved.size; capacity += capacity < 100 ? 1 : 997) {
        to = (sink){to.bytes, 0, capacity, false};
        assert_status(SNOW_ERROR_WRITE, snow_save_to(grid, write_to, &to));
    }
    to = (sink){to.bytes, 0, saved.size - 1, false};
    assert_status(SNOW_ERROR_WRITE, snow_save_to(grid, write_to, &to));
    assert_true(digest == digest_of(grid));
    free(to.bytes);
    free(saved.bytes);
    snow_destroy(grid);
}

/* A reader from memory that gives at most `most` bytes a call and fails after so many. */
typedef struct stream {
    const unsigned char *bytes;
    size_t left;
    size_t most;
    size_t fail_after; /* bytes; SIZE_MAX: never */
    size_t given;
} stream;

static int read_from(void *context, void *bytes, size_t size, size_t *got)
{
    stream *from = context;
    assert_true(size > 0);
    if (from->given >= from->fail_after)
        return 1;
    size_t now = size < from->most ? size : from->most;
    now = now < from->left ? now : from->left;
    now = now < from->fail_after - from->given ? now : from->fail_after - from->given;
    memcpy(bytes, from->bytes, now);
    from->bytes += now;
    from->left -= now;
    from->given += now;
    *got = now;
    return 0;
}

static void readers_may_give_any_number_of_bytes(void **state)
{
    (void)state;
    static const size_t portions[] = {1, 2, 3, 7, 100, 4096, 65536, SIZE_MAX};
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 60);
    snow_grid *grid = make_grid(&params, NULL);
    assert_ok(snow_step(grid, 60));
    snapshot saved = save(grid);
    for (size_t i = 0; i < COUNT_OF(portions); i++) {
        stream from = {saved.bytes, saved.size, portions[i], SIZE_MAX, 0};
        snow_grid *loaded = NULL;
        assert_ok(snow_load_from(read_from, &from, NULL, &loaded));
        assert_true(digest_of(grid) == digest_of(loaded));
        assert_ok(snow_step(loaded, 1));
        snow_destroy(loaded);
    }
    free(saved.bytes);
    snow_destroy(grid);
}

static void readers_may_fail_or_end_anywhere(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.1, 1, 3);
    snow_grid *grid = make_grid(&params, NULL);
    assert_ok(snow_step(grid, 3));
    snapshot saved = save(grid);
    for (size_t size = 0; size < saved.size; size++) {
        snow_grid *loaded = untouched;
        stream failing = {saved.bytes, saved.size, SIZE_MAX, size, 0};
        assert_status(SNOW_ERROR_READ, snow_load_from(read_from, &failing, NULL, &loaded));
        stream ending = {saved.bytes, size, 5, SIZE_MAX, 0};
        assert_status(SNOW_ERROR_TRUNCATED, snow_load_from(read_from, &ending, NULL, &loaded));
        assert_ptr_equal(untouched, loaded);
    }
    free(saved.bytes);
    snow_destroy(grid);
}

static int lie_about_size(void *context, void *bytes, size_t size, size_t *got)
{
    (void)context;
    (void)bytes;
    *got = size + 1;
    return 0;
}

static void a_reader_that_gives_more_than_was_wanted_is_refused(void **state)
{
    (void)state;
    snow_grid *loaded = untouched;
    assert_status(SNOW_ERROR_READ, snow_load_from(lie_about_size, NULL, NULL, &loaded));
    assert_ptr_equal(untouched, loaded);
}

/* Exactly as much memory as there are data, so that a sanitizer sees a read beyond them. */
static snow_status load_exactly(const unsigned char *bytes, size_t size)
{
    unsigned char *copy = malloc(size > 0 ? size : 1);
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    snow_grid *grid = untouched;
    snow_status status = snow_load(copy, size, NULL, &grid);
    if (status == SNOW_OK) {
        assert_ok(snow_step(grid, 1));
        snow_destroy(grid);
    } else {
        assert_ptr_equal(untouched, grid);
    }
    free(copy);
    return status;
}

static void every_truncation_is_noticed(void **state)
{
    (void)state;
    for (size_t i = 0; i < SCENES; i++) {
        snow_reiter_params params = scene(i);
        snow_grid *grid = make_grid(&params, NULL);
        assert_ok(snow_step(grid, 3));
        snapshot saved = save(grid);
        for (size_t size = 0; size < saved.size; size += size < 200 || size + 40 > saved.size ? 1 : 11)
            assert_status(SNOW_ERROR_TRUNCATED, load_exactly(saved.bytes, size));
        assert_ok(load_exactly(saved.bytes, saved.size));
        free(saved.bytes);
        snow_destroy(grid);
    }
}

static void bytes_after_the_end_are_noticed(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 4);
    snow_grid *grid = make_grid(&params, NULL);
    snapshot saved = save(grid);
    for (size_t extra = 1; extra <= 40; extra++) {
        unsigned char *longer = calloc(1, saved.size + extra);
        assert_non_null(longer);
        memcpy(longer, saved.bytes, saved.size);
        assert_status(SNOW_ERROR_DAMAGED, load_exactly(longer, saved.size + extra));
        free(longer);
    }
    free(saved.bytes);
    snow_destroy(grid);
}

static void every_damaged_byte_is_noticed(void **state)
{
    (void)state;
    static const unsigned char masks[] = {0x01, 0x80, 0xff};
    for (size_t i = 0; i < SCENES; i++) {
        for (size_t k = 0; k < 3; k++) {
            snow_reiter_params params = scene_for(i, engines[k]);
            params.radius = params.radius < 4 ? params.radius : 4;
            snow_grid *grid = make_grid(&params, NULL);
            assert_ok(snow_step(grid, 4));
            snapshot saved = save(grid);
            for (size_t at = 0; at < saved.size; at++) {
                unsigned char right = saved.bytes[at];
                saved.bytes[at] ^= masks[(at + k) % COUNT_OF(masks)];
                assert_true(load_exactly(saved.bytes, saved.size) != SNOW_OK);
                saved.bytes[at] = right;
            }
            free(saved.bytes);
            snow_destroy(grid);
        }
    }
}

static void what_is_not_a_saved_grid_is_told_apart(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 4);
    snow_grid *grid = make_grid(&params, NULL);
    snapshot saved = save(grid);
    static const char text[] = "\211PNG\r\n\032\n and so on, long enough to be a header of some kind, one would think";
    assert_status(SNOW_ERROR_FORMAT, load_exactly((const unsigned char *)text, sizeof text));
    assert_status(SNOW_ERROR_FORMAT, load_exactly((const unsigned char *)text, 1));
    for (size_t at = 0; at < 8; at++) {
        saved.bytes[at] ^= 0x20;
        assert_status(SNOW_ERROR_FORMAT, load_exactly(saved.bytes, saved.size));
        saved.bytes[at] ^= 0x20;
    }
    /* The version of the format follows the eight letters. */
    saved.bytes[8]++;
    assert_status(SNOW_ERROR_FORMAT_VERSION, load_exactly(saved.bytes, saved.size));
    saved.bytes[8]--;
    free(saved.bytes);
    snow_destroy(grid);
}

/* Noise over the whole of a snapshot, with a memory account: what is promised by the data is never asked for. */
static void hostile_data_never_cost_more_memory_than_they_hold(void **state)
{
    (void)state;
    uint64_t random = 99;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 5);
    params.record_freeze_steps = 1;
    snow_grid *grid = make_grid(&params, NULL);
    assert_ok(snow_step(grid, 4));
    snapshot saved = save(grid);
    unsigned char *bytes = malloc(saved.size);
    assert_non_null(bytes);
    for (int round = 0; round < 4000; round++) {
        memcpy(bytes, saved.bytes, saved.size);
        /* The scene stands in the first 120 bytes: sizes and flags. */
        for (uint32_t hit = next_below(&random, 3) + 1; hit > 0; hit--)
            bytes[8 + next_below(&random, 112)] = (unsigned char)next_below(&random, 256);
        test_allocator allocator = {0};
        snow_options options = allocator_options(&allocator);
        snow_grid *loaded = untouched;
        if (snow_load(bytes, saved.size, &options, &loaded) == SNOW_OK)
            snow_destroy(loaded);
        else
            assert_ptr_equal(untouched, loaded);
        assert_int_equal(0, allocator.live_blocks);
        assert_true(allocator.peak_bytes <= 32 * saved.size + 65536);
    }
    free(bytes);
    free(saved.bytes);
    snow_destroy(grid);
}

static void options_of_a_load_are_checked(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 20);
    snow_grid *grid = make_grid(&params, NULL);
    snapshot saved = save(grid);
    snow_grid *loaded = untouched;
    snow_options options = default_options();
    options.threads = -1;
    assert_status(SNOW_ERROR_RANGE, snow_load(saved.bytes, saved.size, &options, &loaded));
    options = default_options();
    options.isa = (snow_isa)99;
    assert_status(SNOW_ERROR_ENUM, snow_load(saved.bytes, saved.size, &options, &loaded));
    options = default_options();
    options.struct_size = 0;
    assert_status(SNOW_ERROR_STRUCT_SIZE, snow_load(saved.bytes, saved.size, &options, &loaded));
    options = default_options();
    options.memory_limit = 1000;
    assert_status(SNOW_ERROR_MEMORY_LIMIT, snow_load(saved.bytes, saved.size, &options, &loaded));
    stream from = {saved.bytes, saved.size, SIZE_MAX, SIZE_MAX, 0};
    assert_status(SNOW_ERROR_MEMORY_LIMIT, snow_load_from(read_from, &from, &options, &loaded));
    assert_ptr_equal(untouched, loaded);
    free(saved.bytes);
    snow_destroy(grid);
}

/* The first bytes of a fixed scene, so that no change of the format passes unnoticed. */
static void the_format_is_little_endian_and_versioned(void **state)
{
    (void)state;
    static const unsigned char head[] = {'S', 'N', 'O', 'W', 'G', 'R', 'I', 'D', 1, 0, 0, 0, 1, 0, 0, 0,
                                         0,   0,   0,   0,   0,   0,   0xe0, 0x3f};
    snow_reiter_params params = disc_scene(0.5, 0.01, 1, 4);
    snow_grid *grid = make_grid(&params, NULL);
    snapshot saved = save(grid);
    assert_memory_equal(head, saved.bytes, sizeof head);
    free(saved.bytes);
    snow_destroy(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(save_load_continue_is_continue),
        cmocka_unit_test(a_loaded_run_ends_like_the_other),
        cmocka_unit_test(what_was_set_and_changed_is_saved),
        cmocka_unit_test(all_engines_save_the_same_cells),
        cmocka_unit_test(buffers_that_are_too_small_stay_untouched),
        cmocka_unit_test(null_pointers_are_refused),
        cmocka_unit_test(writers_get_the_same_bytes_and_may_fail_anywhere),
        cmocka_unit_test(readers_may_give_any_number_of_bytes),
        cmocka_unit_test(readers_may_fail_or_end_anywhere),
        cmocka_unit_test(a_reader_that_gives_more_than_was_wanted_is_refused),
        cmocka_unit_test(every_truncation_is_noticed),
        cmocka_unit_test(bytes_after_the_end_are_noticed),
        cmocka_unit_test(every_damaged_byte_is_noticed),
        cmocka_unit_test(what_is_not_a_saved_grid_is_told_apart),
        cmocka_unit_test(hostile_data_never_cost_more_memory_than_they_hold),
        cmocka_unit_test(options_of_a_load_are_checked),
        cmocka_unit_test(the_format_is_little_endian_and_versioned),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
