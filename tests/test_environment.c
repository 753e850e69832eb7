/* What a program around the library may do: other rounding modes, many grids on many threads, fork. */
#define _POSIX_C_SOURCE 200809L
#include "support/grids.h"

#include <fenv.h>
#include <pthread.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

static const snow_reiter_engine engines[] = {SNOW_REITER_ENGINE_ROWS, SNOW_REITER_ENGINE_REFERENCE,
                                             SNOW_REITER_ENGINE_QUAD};

/* All that a life of a grid has to show, for comparing. */
typedef struct outcome {
    uint64_t start, grown, changed, loaded, pixels;
    double vapour, ice, defect, value;
} outcome;

static uint64_t hash_bytes(const unsigned char *bytes, size_t size)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    return hash;
}

static uint64_t draw(const snow_grid *grid)
{
    snow_view view;
    snow_view_init(&view, sizeof view);
    assert_ok(snow_view_fit(grid, 50, &view));
    size_t size = 0;
    assert_ok(snow_render(grid, &view, NULL, 0, &size));
    unsigned char *pixels = malloc(size);
    assert_non_null(pixels);
    assert_ok(snow_render(grid, &view, pixels, size, NULL));
    uint64_t hash = hash_bytes(pixels, size);
    free(pixels);
    return hash;
}

static uint64_t digest_of_a_copy(const snow_grid *grid, int64_t steps)
{
    size_t size = 0;
    assert_ok(snow_save(grid, NULL, 0, &size));
    unsigned char *bytes = malloc(size);
    assert_non_null(bytes);
    assert_ok(snow_save(grid, bytes, size, &size));
    snow_grid *copy = NULL;
    assert_ok(snow_load(bytes, size, NULL, &copy));
    free(bytes);
    assert_ok(snow_step(copy, steps));
    uint64_t digest = digest_of(copy);
    snow_destroy(copy);
    return digest;
}

static outcome live(snow_reiter_engine engine, int32_t threads)
{
    snow_reiter_params params = disc_scene(0.4, 0.013, 1, 14);
    params.noise = 0.1;
    params.engine = engine;
    snow_options options = default_options();
    options.threads = threads;
    snow_grid *grid = make_grid(&params, &options);
    outcome seen = {.start = digest_of(grid)};
    assert_ok(snow_step(grid, 30));
    seen.grown = digest_of(grid);
    set_cell(grid, SNOW_FIELD_VAPOUR, 11, -2, 0.1234567);
    snow_reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    conditions.background = 0.3;
    conditions.addition = 0.017;
    assert_ok(snow_reiter_change(grid, &conditions));
    snow_stop stop = stop_after(50);
    run_grid(grid, &stop);
    seen.changed = digest_of(grid);
    seen.loaded = digest_of_a_copy(grid, 10);
    seen.pixels = draw(grid);
    assert_ok(snow_mass(grid, &seen.vapour, &seen.ice));
    seen.defect = defect_of(grid);
    seen.value = value_at(grid, SNOW_FIELD_VALUE, 0, 0);
    snow_destroy(grid);
    return seen;
}

static void assert_same_outcome(const outcome *expected, const outcome *got)
{
    assert_true(expected->start == got->start);
    assert_true(expected->grown == got->grown);
    assert_true(expected->changed == got->changed);
    assert_true(expected->loaded == got->loaded);
    assert_true(expected->pixels == got->pixels);
    assert_same_double(expected->vapour, got->vapour);
    assert_same_double(expected->ice, got->ice);
    assert_same_double(expected->defect, got->defect);
    assert_same_double(expected->value, got->value);
}

static void the_caller_s_rounding_mode_changes_nothing(void **state)
{
    (void)state;
    static const int modes[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        for (int32_t threads = 1; threads <= 3; threads += 2) {
            outcome expected = live(engines[i], threads);
            for (size_t k = 0; k < COUNT_OF(modes); k++) {
                assert_int_equal(0, fesetround(modes[k]));
                outcome got = live(engines[i], threads);
                int mode = fegetround();
                assert_int_equal(0, fesetround(FE_TONEAREST));
                assert_int_equal(modes[k], mode);
                assert_same_outcome(&expected, &got);
            }
        }
    }
}

/* Emulators, valgrind among them, do not keep the flags. */
static bool flags_can_be_restored(void)
{
    fenv_t saved;
    feraiseexcept(FE_DIVBYZERO);
    fegetenv(&saved);
    fesetenv(FE_DFL_ENV);
    fesetenv(&saved);
    bool restored = fetestexcept(FE_DIVBYZERO) != 0;
    feclearexcept(FE_ALL_EXCEPT);
    return restored;
}

static void the_caller_s_flags_are_left_alone(void **state)
{
    (void)state;
    if (!flags_can_be_restored())
        skip();
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        feclearexcept(FE_ALL_EXCEPT);
        snow_reiter_params params = disc_scene(0.4, 0.013, 1, 10);
        params.engine = engines[i];
        snow_grid *grid = make_grid(&params, NULL);
        assert_ok(snow_step(grid, 30));
        assert_int_equal(0, fetestexcept(FE_ALL_EXCEPT));
        feraiseexcept(FE_DIVBYZERO);
        assert_ok(snow_step(grid, 3));
        assert_int_equal(FE_DIVBYZERO, fetestexcept(FE_ALL_EXCEPT));
        assert_ok(snow_run(grid, NULL, NULL));
        assert_int_equal(FE_DIVBYZERO, fetestexcept(FE_ALL_EXCEPT));
        feclearexcept(FE_ALL_EXCEPT);
        snow_destroy(grid);
    }
}

#if defined(__SSE2__)
/* Flush-to-zero and denormals-are-zero, as audio and game programs set them. */
static void flushing_to_zero_changes_nothing(void **state)
{
    (void)state;
    enum { FLUSH_BOTH = 0x8040 };
    unsigned before = _mm_getcsr();
    _mm_setcsr(before | FLUSH_BOTH);
    bool kept = (_mm_getcsr() & FLUSH_BOTH) == FLUSH_BOTH;
    _mm_setcsr(before);
    if (!kept)
        skip();
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        outcome expected = live(engines[i], 2);
        _mm_setcsr(before | FLUSH_BOTH);
        outcome got = live(engines[i], 2);
        unsigned after = _mm_getcsr();
        _mm_setcsr(before);
        assert_int_equal(FLUSH_BOTH, after & FLUSH_BOTH);
        assert_same_outcome(&expected, &got);
    }
}
#endif

/* The progress callback runs in the caller's state, not in the library's. */
static int look_at_mode(void *context, const snow_grid *grid, const snow_summary *summary)
{
    (void)grid;
    (void)summary;
    int *mode = context;
    *mode = fegetround();
    return 0;
}

static void callbacks_see_the_caller_s_rounding_mode(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 10);
    snow_grid *grid = make_grid(&params, NULL);
    int mode = -1;
    snow_stop stop = stop_after(10);
    stop.progress = look_at_mode;
    stop.progress_context = &mode;
    stop.progress_steps = 5;
    assert_int_equal(0, fesetround(FE_UPWARD));
    snow_status status = snow_run(grid, &stop, NULL);
    assert_int_equal(0, fesetround(FE_TONEAREST));
    assert_ok(status);
    assert_int_equal(FE_UPWARD, mode);
    snow_destroy(grid);
}

/* Each thread leads its own life with its own grids; no assertion there, cmocka is not made for it. */
enum { LIVES = 6 };

typedef struct life {
    snow_reiter_engine engine;
    int32_t threads;
    uint64_t digest;
    snow_status status;
} life;

static void *live_apart(void *context)
{
    life *mine = context;
    for (int round = 0; round < 5 && mine->status == SNOW_OK; round++) {
        snow_reiter_params params;
        snow_reiter_params_init(&params, sizeof params);
        params.radius = 20;
        params.addition = 0.01;
        params.engine = mine->engine;
        snow_options options;
        snow_options_init(&options, sizeof options);
        options.threads = mine->threads;
        snow_grid *grid = NULL;
        mine->status = snow_reiter_create(&params, &options, &grid);
        if (mine->status == SNOW_OK)
            mine->status = snow_step(grid, 50);
        if (mine->status == SNOW_OK)
            mine->status = snow_digest(grid, &mine->digest);
        snow_destroy(grid);
    }
    return NULL;
}

static void many_grids_on_many_threads(void **state)
{
    (void)state;
    pthread_t threads[LIVES];
    life lives[LIVES];
    for (int i = 0; i < LIVES; i++) {
        lives[i] = (life){i % 3 == 2 ? SNOW_REITER_ENGINE_REFERENCE : SNOW_REITER_ENGINE_ROWS, i % 3 + 1, 0, SNOW_OK};
        assert_int_equal(0, pthread_create(&threads[i], NULL, live_apart, &lives[i]));
    }
    for (int i = 0; i < LIVES; i++)
        assert_int_equal(0, pthread_join(threads[i], NULL));
    for (int i = 0; i < LIVES; i++) {
        assert_ok(lives[i].status);
        assert_true(lives[i].digest == lives[0].digest);
    }
}

typedef struct reading {
    const snow_grid *grid;
    uint64_t digest;
    double defect;
} reading;

static void *read_apart(void *context)
{
    reading *mine = context;
    uint64_t digest = 0;
    if (snow_digest(mine->grid, &digest) == SNOW_OK)
        mine->digest = digest;
    (void)snow_symmetry_defect(mine->grid, &mine->defect);
    double vapour, ice;
    (void)snow_mass(mine->grid, &vapour, &ice);
    size_t size = 0;
    (void)snow_save(mine->grid, NULL, 0, &size);
    return NULL;
}

/* Calls that take the grid as const may run at the same time. */
static void one_grid_is_read_by_many_threads(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(engines); k++) {
        snow_reiter_params params = disc_scene(0.4, 0.01, 1, 15);
        params.engine = engines[k];
        snow_options options = default_options();
        options.threads = 2;
        snow_grid *grid = make_grid(&params, &options);
        assert_ok(snow_step(grid, 40));
        pthread_t threads[4];
        reading readings[4];
        for (size_t i = 0; i < COUNT_OF(threads); i++) {
            readings[i] = (reading){grid, 0, -1};
            assert_int_equal(0, pthread_create(&threads[i], NULL, read_apart, &readings[i]));
        }
        for (size_t i = 0; i < COUNT_OF(threads); i++) {
            assert_int_equal(0, pthread_join(threads[i], NULL));
            assert_true(readings[i].digest == digest_of(grid));
            assert_same_double(0.0, readings[i].defect);
        }
        snow_destroy(grid);
    }
}

/* A grid may wander from thread to thread, as long as one at a time uses it. */
static void *step_apart(void *context)
{
    return snow_step(context, 20) == SNOW_OK ? context : NULL;
}

static void a_grid_may_change_its_thread(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 20);
    snow_options options = default_options();
    options.threads = 3;
    snow_grid *plain = make_grid(&params, NULL);
    snow_grid *grid = make_grid(&params, &options);
    for (int i = 0; i < 4; i++) {
        pthread_t thread;
        void *answer = NULL;
        assert_int_equal(0, pthread_create(&thread, NULL, step_apart, grid));
        assert_int_equal(0, pthread_join(thread, &answer));
        assert_ptr_equal(grid, answer);
        assert_ok(snow_step(grid, 5));
        assert_ok(snow_step(plain, 25));
        assert_same_grids(plain, grid);
    }
    snow_destroy(grid);
    snow_destroy(plain);
}

/* In a child the helpers of the parent do not exist; it goes on alone, with the same bits. */
static void a_child_process_goes_on_with_the_same_bits(void **state)
{
    (void)state;
    for (int32_t count = 1; count <= 4; count += 3) {
        snow_reiter_params params = disc_scene(0.4, 0.01, 1, 20);
        snow_options options = default_options();
        options.threads = count;
        snow_grid *grid = make_grid(&params, &options);
        assert_ok(snow_step(grid, 30));
        int ends[2];
        assert_int_equal(0, pipe(ends));
        pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) {
            uint64_t digest = 0;
            bool grown = snow_step(grid, 30) == SNOW_OK && snow_digest(grid, &digest) == SNOW_OK;
            bool told = grown && write(ends[1], &digest, sizeof digest) == (ssize_t)sizeof digest;
            snow_destroy(grid);
            _exit(told ? 0 : 1);
        }
        assert_ok(snow_step(grid, 30));
        uint64_t digest = 0;
        assert_int_equal(sizeof digest, read(ends[0], &digest, sizeof digest));
        int status = -1;
        assert_int_equal(child, waitpid(child, &status, 0));
        assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
        assert_true(digest == digest_of(grid));
        close(ends[0]);
        close(ends[1]);
        snow_destroy(grid);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_caller_s_rounding_mode_changes_nothing),
        cmocka_unit_test(the_caller_s_flags_are_left_alone),
#if defined(__SSE2__)
        cmocka_unit_test(flushing_to_zero_changes_nothing),
#endif
        cmocka_unit_test(callbacks_see_the_caller_s_rounding_mode),
        cmocka_unit_test(many_grids_on_many_threads),
        cmocka_unit_test(one_grid_is_read_by_many_threads),
        cmocka_unit_test(a_grid_may_change_its_thread),
        cmocka_unit_test(a_child_process_goes_on_with_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
