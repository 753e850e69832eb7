/* Statuses, names and versions: constant strings, and numbers that never change. */
#include "support/check.h"

#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* The ABI: a number that changed breaks programs that were compiled before. */
static const struct {
    snow_status status;
    int number;
} statuses[] = {
    {SNOW_OK, 0},
    {SNOW_ERROR_NULL, 100},
    {SNOW_ERROR_STRUCT_SIZE, 101},
    {SNOW_ERROR_STRUCT_TAIL, 102},
    {SNOW_ERROR_ENUM, 103},
    {SNOW_ERROR_BUFFER, 104},
    {SNOW_ERROR_RECTANGLE, 105},
    {SNOW_ERROR_NOT_FINITE, 106},
    {SNOW_ERROR_RANGE, 107},
    {SNOW_ERROR_UNSUPPORTED, 108},
    {SNOW_ERROR_NOT_RECORDED, 109},
    {SNOW_ERROR_BUSY, 110},
    {SNOW_ERROR_OUTSIDE, 111},
    {SNOW_ERROR_NO_MEMORY, 200},
    {SNOW_ERROR_TOO_LARGE, 201},
    {SNOW_ERROR_MEMORY_LIMIT, 202},
    {SNOW_ERROR_THREADS, 203},
    {SNOW_ERROR_ISA, 204},
    {SNOW_ERROR_FORMAT, 300},
    {SNOW_ERROR_FORMAT_VERSION, 301},
    {SNOW_ERROR_TRUNCATED, 302},
    {SNOW_ERROR_DAMAGED, 303},
    {SNOW_ERROR_WRITE, 304},
    {SNOW_ERROR_READ, 305},
    {SNOW_ERROR_UNSTABLE, 400},
    {SNOW_ERROR_STEP_LIMIT, 401},
    {SNOW_ERROR_FULL, 420},
    {SNOW_ERROR_REITER_BACKGROUND, 1000},
    {SNOW_ERROR_REITER_ADDITION, 1001},
    {SNOW_ERROR_REITER_DIFFUSION, 1002},
    {SNOW_ERROR_REITER_RADIUS, 1003},
    {SNOW_ERROR_REITER_SIDES, 1004},
    {SNOW_ERROR_REITER_SEED, 1005},
    {SNOW_ERROR_REITER_CLUSTER, 1006},
    {SNOW_ERROR_REITER_NOISE, 1007},
    {SNOW_ERROR_REITER_RIM, 1008},
    {SNOW_ERROR_REITER_RESCALE, 1009},
    {SNOW_ERROR_REITER_VAPOUR, 1010},
    {SNOW_ERROR_REITER_PRESET, 1011},
    {SNOW_ERROR_REITER_PRECISION, 1012},
    {SNOW_ERROR_REITER_TOLERANCE, 1013},
    {SNOW_ERROR_PACKARD_RULE, 2000},
    {SNOW_ERROR_PACKARD_RULE_LENGTH, 2001},
    {SNOW_ERROR_PACKARD_RULE_DIGIT, 2002},
    {SNOW_ERROR_PACKARD_RULE_MELTS, 2003},
    {SNOW_ERROR_PACKARD_RULE_LATTICE, 2004},
    {SNOW_ERROR_PACKARD_RULE_DOMAIN, 2005},
    {SNOW_ERROR_PACKARD_BIRTH, 2006},
    {SNOW_ERROR_PACKARD_RADIUS, 2007},
    {SNOW_ERROR_PACKARD_SIDES, 2008},
    {SNOW_ERROR_PACKARD_SEED, 2009},
    {SNOW_ERROR_PACKARD_CLUSTER, 2010},
    {SNOW_ERROR_PACKARD_SCATTER, 2011},
    {SNOW_ERROR_PACKARD_ENGINE, 2012},
    {SNOW_ERROR_PACKARD_ZONE, 2013},
    {SNOW_ERROR_PACKARD_RLE, 2014},
    {SNOW_ERROR_PACKARD_RLE_STATES, 2015},
    {SNOW_ERROR_AGGREGATE_LATTICE, 3000},
    {SNOW_ERROR_AGGREGATE_CONTACT, 3001},
    {SNOW_ERROR_AGGREGATE_STICKING, 3002},
    {SNOW_ERROR_AGGREGATE_HITS, 3003},
    {SNOW_ERROR_AGGREGATE_KILL, 3004},
    {SNOW_ERROR_AGGREGATE_SEED, 3005},
    {SNOW_ERROR_AGGREGATE_OBSTACLE, 3006},
    {SNOW_ERROR_AGGREGATE_OVERLAP, 3007},
    {SNOW_ERROR_AGGREGATE_LAUNCH, 3008},
    {SNOW_ERROR_AGGREGATE_PATH, 3009},
    {SNOW_ERROR_AGGREGATE_RADIUS, 3010},
    {SNOW_ERROR_AGGREGATE_SIDES, 3011},
    {SNOW_ERROR_AGGREGATE_INTERACTION, 3012},
    {SNOW_ERROR_AGGREGATE_HARDNESS, 3013},
    {SNOW_ERROR_AGGREGATE_WALLS, 3014},
    {SNOW_ERROR_AGGREGATE_PARTICLES, 3015},
    {SNOW_ERROR_AGGREGATE_DENSITY, 3016},
    {SNOW_ERROR_AGGREGATE_MOBILITY, 3017},
    {SNOW_ERROR_AGGREGATE_PRESET, 3018},
    {SNOW_ERROR_AGGREGATE_ENGINE, 3019},
};

static void status_numbers_never_change(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(statuses); i++)
        assert_int_equal(statuses[i].number, statuses[i].status);
}

static void each_status_has_its_own_text(void **state)
{
    (void)state;
    const char *unknown = snow_strerror((snow_status)99);
    assert_non_null(unknown);
    assert_true(strlen(unknown) > 0);
    for (size_t i = 0; i < COUNT_OF(statuses); i++) {
        const char *text = snow_strerror(statuses[i].status);
        assert_non_null(text);
        assert_true(strlen(text) > 0);
        assert_null(strchr(text, '\n'));
        assert_string_not_equal(text, unknown);
        for (size_t j = 0; j < i; j++)
            assert_string_not_equal(text, snow_strerror(statuses[j].status));
    }
}

static void unknown_statuses_have_a_text(void **state)
{
    (void)state;
    static const int numbers[] = {-1, 1, 112, 205, 306, 402, 421, 999, 1014, 2016, 3020, INT_MAX, INT_MIN};
    for (size_t i = 0; i < COUNT_OF(numbers); i++)
        assert_string_equal(snow_strerror((snow_status)99), snow_strerror((snow_status)numbers[i]));
}

static void stop_reasons_have_names(void **state)
{
    (void)state;
    static const struct {
        snow_stop_reason reason;
        int number;
        const char *name;
    } reasons[] = {
        {SNOW_STOP_STEPS, 1, "steps"},   {SNOW_STOP_RIM, 2, "rim"},
        {SNOW_STOP_RADIUS, 3, "radius"}, {SNOW_STOP_FROZEN, 4, "frozen"},
        {SNOW_STOP_STILL, 5, "still"},   {SNOW_STOP_TIME, 6, "time"},
        {SNOW_STOP_CANCELLED, 7, "cancelled"}, {SNOW_STOP_UNSTABLE, 8, "unstable"},
        {SNOW_STOP_FULL, 9, "full"},     {SNOW_STOP_HEIGHT, 10, "height"},
    };
    for (size_t i = 0; i < COUNT_OF(reasons); i++) {
        assert_int_equal(reasons[i].number, reasons[i].reason);
        assert_string_equal(reasons[i].name, snow_stop_name(reasons[i].reason));
    }
    assert_non_null(snow_stop_name(SNOW_STOP_NONE));
    static const int unknown[] = {-1, 11, INT_MAX, INT_MIN};
    for (size_t i = 0; i < COUNT_OF(unknown); i++)
        assert_non_null(snow_stop_name((snow_stop_reason)unknown[i]));
}

static void models_are_listed(void **state)
{
    (void)state;
    size_t count = snow_model_count();
    assert_true(count >= 1);
    bool reiter_found = false;
    for (size_t i = 0; i < count; i++) {
        snow_model model = (snow_model)-1;
        const char *name = snow_model_name(i, &model);
        assert_non_null(name);
        assert_string_equal(name, snow_model_name(i, NULL));
        if (model == SNOW_MODEL_REITER) {
            reiter_found = true;
            assert_string_equal("reiter", name);
        }
    }
    assert_true(reiter_found);

    snow_model untouched = (snow_model)77;
    assert_null(snow_model_name(count, &untouched));
    assert_null(snow_model_name(SIZE_MAX, &untouched));
    assert_int_equal(77, untouched);
}

static void instruction_sets_have_names(void **state)
{
    (void)state;
    assert_string_equal("auto", snow_isa_name(SNOW_ISA_AUTO));
    assert_string_equal("baseline", snow_isa_name(SNOW_ISA_BASELINE));
    assert_string_equal("avx2", snow_isa_name(SNOW_ISA_AVX2));
    assert_string_equal("avx512", snow_isa_name(SNOW_ISA_AVX512));
    static const int unknown[] = {-1, 4, INT_MAX, INT_MIN};
    for (size_t i = 0; i < COUNT_OF(unknown); i++) {
        assert_null(snow_isa_name((snow_isa)unknown[i]));
        assert_int_equal(0, snow_isa_available((snow_isa)unknown[i]));
    }
    assert_int_equal(1, snow_isa_available(SNOW_ISA_BASELINE));
}

static void versions_agree(void **state)
{
    (void)state;
    assert_int_equal(SNOW_VERSION, snow_version());
    assert_string_equal(SNOW_VERSION_TEXT, snow_version_text());
    char text[32];
    snprintf(text, sizeof text, "%d.%d.%d", SNOW_VERSION_MAJOR, SNOW_VERSION_MINOR, SNOW_VERSION_PATCH);
    assert_string_equal(text, snow_version_text());
    assert_true(SNOW_VERSION_NUMBER(0, 2, 0) > SNOW_VERSION_NUMBER(0, 1, 999));
    assert_true(SNOW_VERSION_NUMBER(1, 0, 0) > SNOW_VERSION_NUMBER(0, 999, 999));
}

static void presets_are_listed(void **state)
{
    (void)state;
    size_t count = 0;
    while (snow_reiter_preset_name(count) != NULL) {
        const char *name = snow_reiter_preset_name(count);
        const char *source = snow_reiter_preset_source(count);
        assert_true(strlen(name) > 0);
        assert_non_null(source);
        assert_true(strlen(source) > 0);
        for (size_t i = 0; i < count; i++)
            assert_string_not_equal(name, snow_reiter_preset_name(i));
        count++;
    }
    assert_true(count >= 4);
    assert_null(snow_reiter_preset_source(count));
    assert_null(snow_reiter_preset_name(SIZE_MAX));
    assert_null(snow_reiter_preset_source(SIZE_MAX));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(status_numbers_never_change),
        cmocka_unit_test(each_status_has_its_own_text),
        cmocka_unit_test(unknown_statuses_have_a_text),
        cmocka_unit_test(stop_reasons_have_names),
        cmocka_unit_test(models_are_listed),
        cmocka_unit_test(instruction_sets_have_names),
        cmocka_unit_test(versions_agree),
        cmocka_unit_test(presets_are_listed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
