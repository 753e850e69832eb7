/* Options, and the rules that all structs of callers share. */
#include "support/grids.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

static snow_grid *const untouched = (snow_grid *)(uintptr_t)0x1230;

/* The create call refuses the options and leaves its out-pointer alone. */
static void assert_refused(snow_status expected, const snow_options *options)
{
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 5);
    snow_grid *grid = untouched;
    assert_status(expected, snow_reiter_create(&params, options, &grid));
    assert_ptr_equal(untouched, grid);
}

static void assert_accepted(const snow_options *options)
{
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 5);
    snow_grid *grid = make_grid(&params, options);
    assert_ok(snow_step(grid, 3));
    snow_destroy(grid);
}

static void defaults_are_the_documented_ones(void **state)
{
    (void)state;
    snow_options options;
    memset(&options, 0xff, sizeof options);
    snow_options_init(&options, sizeof options);
    assert_int_equal(sizeof options, options.struct_size);
    assert_true(options.allocate == NULL);
    assert_true(options.release == NULL);
    assert_int_equal(0, options.memory_limit);
    assert_int_equal(1, options.threads);
    assert_int_equal(SNOW_ISA_AUTO, options.isa);
    assert_true(options.parallel_for == NULL);
    assert_accepted(&options);
    assert_accepted(NULL);
}

static void run_in_order(void *context, size_t count, snow_task task, void *argument)
{
    (void)context;
    for (size_t i = 0; i < count; i++)
        task(argument, i);
}

static void thread_counts_have_a_range(void **state)
{
    (void)state;
    static const int32_t bad[] = {-1, 1025, INT32_MAX, INT32_MIN};
    static const int32_t good[] = {0, 1, 2, 7, 64};
    snow_options options = default_options();
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        options.threads = bad[i];
        assert_refused(SNOW_ERROR_RANGE, &options);
    }
    for (size_t i = 0; i < COUNT_OF(good); i++) {
        options.threads = good[i];
        assert_accepted(&options);
    }
    /* As many as that are not to be started here. */
    options.threads = 1024;
    options.parallel_for = run_in_order;
    assert_accepted(&options);
}

static void instruction_sets_are_checked(void **state)
{
    (void)state;
    snow_options options = default_options();
    static const int unknown[] = {-1, 4, INT_MAX, INT_MIN};
    for (size_t i = 0; i < COUNT_OF(unknown); i++) {
        options.isa = (snow_isa)unknown[i];
        assert_refused(SNOW_ERROR_ENUM, &options);
    }
    for (int isa = SNOW_ISA_BASELINE; isa <= SNOW_ISA_AVX512; isa++) {
        options.isa = (snow_isa)isa;
        if (snow_isa_available(options.isa))
            assert_accepted(&options);
        else
            assert_refused(SNOW_ERROR_ISA, &options);
    }
}

static void the_grid_tells_its_instruction_set(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 5);
    snow_options options = default_options();
    snow_isa isas[8];
    size_t count = available_isas(isas);
    for (size_t i = 0; i < count; i++) {
        options.isa = isas[i];
        snow_grid *grid = make_grid(&params, &options);
        snow_isa isa = SNOW_ISA_AUTO;
        assert_ok(snow_isa_of(grid, &isa));
        assert_int_equal(isas[i], isa);
        snow_destroy(grid);
    }
    snow_grid *grid = make_grid(&params, NULL);
    snow_isa isa = SNOW_ISA_AUTO;
    assert_ok(snow_isa_of(grid, &isa));
    assert_int_not_equal(SNOW_ISA_AUTO, isa);
    assert_int_equal(1, snow_isa_available(isa));
    snow_destroy(grid);
}

static void *allocate_plainly(void *context, size_t size)
{
    (void)context;
    return malloc(size);
}

static void release_plainly(void *context, void *block)
{
    (void)context;
    free(block);
}

static void allocate_and_release_come_together(void **state)
{
    (void)state;
    snow_options options = default_options();
    options.allocate = allocate_plainly;
    assert_refused(SNOW_ERROR_RANGE, &options);
    options.release = release_plainly;
    assert_accepted(&options);
    options.allocate = NULL;
    assert_refused(SNOW_ERROR_RANGE, &options);
}

typedef struct loop_log {
    size_t loops;
    size_t most_tasks;
} loop_log;

static void logging_loop(void *context, size_t count, snow_task task, void *argument)
{
    loop_log *log = context;
    log->loops++;
    if (count > log->most_tasks)
        log->most_tasks = count;
    assert_true(count >= 1);
    for (size_t i = 0; i < count; i++)
        task(argument, i);
}

static void a_callers_loop_is_used(void **state)
{
    (void)state;
    for (int32_t threads = 1; threads <= 8; threads++) {
        loop_log log = {0, 0};
        snow_options options = default_options();
        options.threads = threads;
        options.parallel_for = logging_loop;
        options.parallel_context = &log;
        /* Noise everywhere, so that there is work for all. */
        snow_reiter_params params = disc_scene(0.4, 0.001, 1, 100);
        params.noise = 0.1;
        snow_grid *grid = make_grid(&params, &options);
        assert_ok(snow_step(grid, 10));
        if (threads > 1)
            assert_true(log.loops >= 10);
        assert_true(log.most_tasks <= 8 * (size_t)threads);
        snow_destroy(grid);
    }
}

/* What every struct of a caller goes through: an init function, then a call that reads it. */
typedef struct struct_kind {
    const char *name;
    size_t size;
    void (*init)(void *object, size_t struct_size);
    snow_status (*use)(const void *object);
    bool keeps_tail; /* what is beyond our members is the next call's concern */
} struct_kind;

static void init_options(void *object, size_t struct_size)
{
    snow_options_init(object, struct_size);
}

static snow_status use_options(const void *object)
{
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 3);
    snow_grid *grid = untouched;
    snow_status status = snow_reiter_create(&params, object, &grid);
    if (status == SNOW_OK)
        snow_destroy(grid);
    else
        assert_ptr_equal(untouched, grid);
    return status;
}

static void init_params(void *object, size_t struct_size)
{
    snow_reiter_params_init(object, struct_size);
}

static snow_status use_params(const void *object)
{
    snow_grid *grid = untouched;
    snow_status status = snow_reiter_create(object, NULL, &grid);
    if (status == SNOW_OK)
        snow_destroy(grid);
    else
        assert_ptr_equal(untouched, grid);
    return status;
}

/* A grid that the uses of the other structs are tried on; it must stay as it is when they fail. */
static snow_grid *try_on;

static void init_stop(void *object, size_t struct_size)
{
    snow_stop_init(object, struct_size);
}

static snow_status use_stop(const void *object)
{
    int64_t before = steps_of(try_on);
    snow_status status = snow_run(try_on, object, NULL);
    if (status != SNOW_OK)
        assert_int_equal(before, steps_of(try_on));
    return status;
}

static void init_summary(void *object, size_t struct_size)
{
    snow_summary_init(object, struct_size);
}

static snow_status use_summary(const void *object)
{
    int64_t before = steps_of(try_on);
    snow_stop stop = stop_after(before + 1);
    snow_status status = snow_run(try_on, &stop, (void *)(uintptr_t)object);
    assert_int_equal(before + (status == SNOW_OK), steps_of(try_on));
    return status;
}

static void init_conditions(void *object, size_t struct_size)
{
    snow_reiter_conditions_init(object, struct_size);
}

static snow_status use_conditions(const void *object)
{
    return snow_reiter_change(try_on, object);
}

static snow_status use_conditions_to_read(const void *object)
{
    return snow_reiter_conditions_of(try_on, (void *)(uintptr_t)object);
}

static void init_view(void *object, size_t struct_size)
{
    snow_view_init(object, struct_size);
}

static snow_status use_view(const void *object)
{
    return snow_render(try_on, object, NULL, 0, &(size_t){0});
}

static void init_packard(void *object, size_t struct_size)
{
    snow_packard_params_init(object, struct_size);
}

static snow_status use_packard(const void *object)
{
    snow_grid *grid = untouched;
    snow_status status = snow_packard_create(object, NULL, &grid);
    if (status == SNOW_OK)
        snow_destroy(grid);
    else
        assert_ptr_equal(untouched, grid);
    return status;
}

static void init_aggregate(void *object, size_t struct_size)
{
    snow_aggregate_params_init(object, struct_size);
}

static snow_status use_aggregate(const void *object)
{
    snow_grid *grid = untouched;
    snow_status status = snow_aggregate_create(object, NULL, &grid);
    if (status == SNOW_OK)
        snow_destroy(grid);
    else
        assert_ptr_equal(untouched, grid);
    return status;
}

static snow_status use_aggregate_for_a_preset(const void *object)
{
    return snow_aggregate_params_preset((void *)(uintptr_t)object, snow_aggregate_preset_name(0));
}

static snow_status use_aggregate_to_read(const void *object)
{
    snow_aggregate_params params;
    snow_aggregate_params_init(&params, sizeof params);
    snow_grid *grid = NULL;
    assert_ok(snow_aggregate_create(&params, NULL, &grid));
    snow_status status = snow_aggregate_params_of(grid, (void *)(uintptr_t)object);
    snow_destroy(grid);
    return status;
}

static snow_status use_params_for_a_preset(const void *object)
{
    return snow_reiter_params_preset((void *)(uintptr_t)object, snow_reiter_preset_name(0));
}

static snow_status use_packard_for_a_rule(const void *object)
{
    return snow_packard_params_rule((void *)(uintptr_t)object, "0100000");
}

static snow_status use_packard_for_a_pattern(const void *object)
{
    static const char pattern[] = "x = 1, y = 1\no!";
    snow_grid *grid = untouched;
    snow_status status = snow_packard_load_rle(pattern, sizeof pattern - 1, object, NULL, &grid);
    if (status == SNOW_OK)
        snow_destroy(grid);
    else
        assert_ptr_equal(untouched, grid);
    return status;
}

static void init_zone(void *object, size_t struct_size)
{
    snow_packard_zone_init(object, struct_size, SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_CORNERS);
}

static snow_status use_zone(const void *object)
{
    snow_packard_params params;
    snow_packard_params_init(&params, sizeof params);
    snow_grid *grid = NULL;
    assert_ok(snow_packard_create(&params, NULL, &grid));
    snow_status status = snow_packard_add_zone(grid, object);
    snow_destroy(grid);
    return status;
}

static snow_status use_view_to_fit(const void *object)
{
    return snow_view_fit(try_on, 100, (void *)(uintptr_t)object);
}

static const struct_kind kinds[] = {
    {"options", sizeof(snow_options), init_options, use_options, false},
    {"params", sizeof(snow_reiter_params), init_params, use_params, false},
    {"params for a preset", sizeof(snow_reiter_params), init_params, use_params_for_a_preset, true},
    {"stop", sizeof(snow_stop), init_stop, use_stop, false},
    {"summary", sizeof(snow_summary), init_summary, use_summary, false},
    {"conditions", sizeof(snow_reiter_conditions), init_conditions, use_conditions, false},
    {"conditions to read", sizeof(snow_reiter_conditions), init_conditions, use_conditions_to_read, false},
    {"view", sizeof(snow_view), init_view, use_view, false},
    {"view to fit", sizeof(snow_view), init_view, use_view_to_fit, false},
    {"packard params", sizeof(snow_packard_params), init_packard, use_packard, false},
    {"packard params for a rule", sizeof(snow_packard_params), init_packard, use_packard_for_a_rule, false},
    {"packard params for a pattern", sizeof(snow_packard_params), init_packard, use_packard_for_a_pattern, false},
    {"zone", sizeof(snow_packard_zone), init_zone, use_zone, false},
    {"aggregate params", sizeof(snow_aggregate_params), init_aggregate, use_aggregate, false},
    {"aggregate params for a preset", sizeof(snow_aggregate_params), init_aggregate, use_aggregate_for_a_preset, true},
    {"aggregate params to read", sizeof(snow_aggregate_params), init_aggregate, use_aggregate_to_read, false},
};

static int make_try_on(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 5);
    try_on = make_grid(&params, NULL);
    return 0;
}

static int end_try_on(void **state)
{
    (void)state;
    snow_destroy(try_on);
    return 0;
}

static void assert_use(const struct_kind *kind, snow_status expected, const void *object)
{
    snow_status got = kind->use(object);
    if (got != expected)
        print_error("struct: %s\n", kind->name);
    assert_status(expected, got);
}

/* Exactly as much memory as is meant, so that a sanitizer sees a read beyond it. */
static unsigned char *bytes_of(size_t size, int filler)
{
    unsigned char *bytes = malloc(size);
    assert_non_null(bytes);
    memset(bytes, filler, size);
    return bytes;
}

static void init_writes_no_further_than_it_may(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(kinds); i++) {
        for (size_t size = 0; size <= kinds[i].size + 24; size++) {
            unsigned char *bytes = bytes_of(size + 8, 0xa7);
            kinds[i].init(bytes, size);
            for (size_t j = size; j < size + 8; j++)
                assert_int_equal(0xa7, bytes[j]);
            for (size_t j = kinds[i].size; j < size; j++)
                assert_int_equal(0, bytes[j]);
            if (size >= sizeof(size_t))
                assert_memory_equal(&size, bytes, sizeof size);
            free(bytes);
        }
        kinds[i].init(NULL, kinds[i].size);
        kinds[i].init(NULL, 0);
    }
}

static void structs_that_were_not_initialised_are_refused(void **state)
{
    (void)state;
    static const int fillers[] = {0x00, 0x55, 0xa7, 0xff};
    for (size_t i = 0; i < COUNT_OF(kinds); i++) {
        for (size_t j = 0; j < COUNT_OF(fillers); j++) {
            unsigned char *bytes = bytes_of(kinds[i].size, fillers[j]);
            assert_use(&kinds[i], SNOW_ERROR_STRUCT_SIZE, bytes);
            free(bytes);
        }
    }
}

static void structs_that_are_too_small_are_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(kinds); i++) {
        for (size_t size = sizeof(size_t); size < kinds[i].size; size++) {
            unsigned char *bytes = bytes_of(size, 0);
            kinds[i].init(bytes, size);
            assert_use(&kinds[i], SNOW_ERROR_STRUCT_SIZE, bytes);
            free(bytes);
        }
    }
}

static void structs_of_newer_programs_are_accepted_while_their_tail_is_zero(void **state)
{
    (void)state;
    static const size_t beyond[] = {1, 8, 16, 100};
    for (size_t i = 0; i < COUNT_OF(kinds); i++) {
        for (size_t j = 0; j < COUNT_OF(beyond); j++) {
            size_t size = kinds[i].size + beyond[j];
            unsigned char *bytes = bytes_of(size, 0xa7);
            kinds[i].init(bytes, size);
            assert_use(&kinds[i], SNOW_OK, bytes);
            for (size_t tail = kinds[i].size; tail < size; tail++) {
                bytes[tail] = 1;
                assert_use(&kinds[i], kinds[i].keeps_tail ? SNOW_OK : SNOW_ERROR_STRUCT_TAIL, bytes);
                assert_int_equal(1, bytes[tail]);
                bytes[tail] = 0;
            }
            assert_use(&kinds[i], SNOW_OK, bytes);
            free(bytes);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_the_documented_ones),
        cmocka_unit_test(thread_counts_have_a_range),
        cmocka_unit_test(instruction_sets_are_checked),
        cmocka_unit_test(the_grid_tells_its_instruction_set),
        cmocka_unit_test(allocate_and_release_come_together),
        cmocka_unit_test(a_callers_loop_is_used),
        cmocka_unit_test(init_writes_no_further_than_it_may),
        cmocka_unit_test(structs_that_were_not_initialised_are_refused),
        cmocka_unit_test(structs_that_are_too_small_are_refused),
        cmocka_unit_test(structs_of_newer_programs_are_accepted_while_their_tail_is_zero),
    };
    return cmocka_run_group_tests(tests, make_try_on, end_try_on);
}
