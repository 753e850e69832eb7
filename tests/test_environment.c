/* What a program around the library may do to floating point: other rounding modes, flags, flushing to zero. */
#include "support/grids.h"

#include <fenv.h>
#include <stdlib.h>
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_caller_s_rounding_mode_changes_nothing),
        cmocka_unit_test(the_caller_s_flags_are_left_alone),
#if defined(__SSE2__)
        cmocka_unit_test(flushing_to_zero_changes_nothing),
#endif
        cmocka_unit_test(callbacks_see_the_caller_s_rounding_mode),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
