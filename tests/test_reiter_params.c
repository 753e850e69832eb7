/* Scenes: defaults, presets, and every way in which a parameter can be wrong. */
#include "support/grids.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static snow_grid *const untouched = (snow_grid *)(uintptr_t)0x1230;

static void assert_refused(snow_status expected, const snow_reiter_params *params)
{
    snow_grid *grid = untouched;
    assert_status(expected, snow_reiter_create(params, NULL, &grid));
    assert_ptr_equal(untouched, grid);
}

static uint64_t digest_after(const snow_reiter_params *params, int64_t steps)
{
    snow_grid *grid = make_grid(params, NULL);
    assert_ok(snow_step(grid, steps));
    uint64_t digest = digest_of(grid);
    snow_destroy(grid);
    return digest;
}

static void defaults_are_the_documented_ones(void **state)
{
    (void)state;
    snow_reiter_params params;
    memset(&params, 0xff, sizeof params);
    snow_reiter_params_init(&params, sizeof params);
    assert_int_equal(sizeof params, params.struct_size);
    assert_same_double(0.4, params.background);
    assert_same_double(0.001, params.addition);
    assert_same_double(1.0, params.diffusion);
    assert_int_equal(SNOW_REITER_DISC, params.domain);
    assert_int_equal(200, params.radius);
    assert_int_equal(600, params.width);
    assert_int_equal(600, params.height);
    assert_int_equal(SNOW_REITER_RIM_NEAR, params.rim);
    assert_null(params.seeds);
    assert_int_equal(0, params.cluster);
    assert_int_equal(0, params.noise_symmetric);
    assert_same_double(0.0, params.noise);
    assert_int_equal(0, params.random_seed);
    assert_true(params.background_at == NULL);
    assert_true(params.addition_at == NULL);
    assert_int_equal(0, params.record_freeze_steps);
    assert_int_equal(0, params.allow_unstable);
    assert_int_equal(SNOW_REITER_ENGINE_AUTO, params.engine);
    assert_int_equal(SNOW_REITER_SYMMETRY_AUTO, params.symmetry);
    assert_int_equal(SNOW_REITER_PRECISION_DOUBLE, params.precision);
    assert_same_double(0.0, params.tolerance);
}

static void precision_and_tolerance_must_fit_the_engine(void **state)
{
    (void)state;
    static const struct {
        snow_reiter_engine engine;
        snow_reiter_precision precision;
        double tolerance;
        snow_status status;
    } cases[] = {
        {SNOW_REITER_ENGINE_AUTO, SNOW_REITER_PRECISION_SINGLE, 1, SNOW_OK},
        {SNOW_REITER_ENGINE_ROWS, SNOW_REITER_PRECISION_DOUBLE, 1e-300, SNOW_OK},
        {SNOW_REITER_ENGINE_REFERENCE, SNOW_REITER_PRECISION_SINGLE, 0, SNOW_OK},
        {SNOW_REITER_ENGINE_QUAD, SNOW_REITER_PRECISION_DOUBLE, 0, SNOW_OK},
        {SNOW_REITER_ENGINE_QUAD, SNOW_REITER_PRECISION_SINGLE, 0, SNOW_ERROR_REITER_PRECISION},
        {SNOW_REITER_ENGINE_QUAD, SNOW_REITER_PRECISION_DOUBLE, 1e-9, SNOW_ERROR_REITER_TOLERANCE},
        {SNOW_REITER_ENGINE_REFERENCE, SNOW_REITER_PRECISION_DOUBLE, 1e-9, SNOW_ERROR_REITER_TOLERANCE},
        {SNOW_REITER_ENGINE_ROWS, SNOW_REITER_PRECISION_DOUBLE, -1e-9, SNOW_ERROR_REITER_TOLERANCE},
        {SNOW_REITER_ENGINE_AUTO, SNOW_REITER_PRECISION_DOUBLE, 1.5, SNOW_ERROR_REITER_TOLERANCE},
        {SNOW_REITER_ENGINE_AUTO, SNOW_REITER_PRECISION_DOUBLE, NAN, SNOW_ERROR_NOT_FINITE},
        {SNOW_REITER_ENGINE_AUTO, SNOW_REITER_PRECISION_DOUBLE, INFINITY, SNOW_ERROR_NOT_FINITE},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        snow_reiter_params params = disc_scene(0.4, 0.001, 1, 6);
        params.engine = cases[i].engine;
        params.precision = cases[i].precision;
        params.tolerance = cases[i].tolerance;
        snow_grid *grid = NULL;
        assert_status(cases[i].status, snow_reiter_create(&params, NULL, &grid));
        assert_true((grid != NULL) == (cases[i].status == SNOW_OK));
        snow_destroy(grid);
    }
}

static void the_default_scene_has_one_seed(void **state)
{
    (void)state;
    snow_reiter_params params;
    snow_reiter_params_init(&params, sizeof params);
    snow_grid *grid = make_grid(&params, NULL);
    assert_int_equal(1, frozen_of(grid));
    assert_int_equal(0, steps_of(grid));
    assert_same_double(1.0, value_at(grid, SNOW_FIELD_VALUE, 0, 0));
    assert_same_double(0.0, tip_of(grid));
    snow_destroy(grid);
}

static void null_pointers_are_refused(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 5);
    snow_grid *grid = untouched;
    assert_status(SNOW_ERROR_NULL, snow_reiter_create(NULL, NULL, &grid));
    assert_ptr_equal(untouched, grid);
    assert_status(SNOW_ERROR_NULL, snow_reiter_create(&params, NULL, NULL));
    assert_status(SNOW_ERROR_NULL, snow_reiter_create(NULL, NULL, NULL));
    assert_status(SNOW_ERROR_NULL, snow_reiter_params_preset(NULL, "thin-dendrite"));
    assert_status(SNOW_ERROR_NULL, snow_reiter_params_preset(&params, NULL));
}

static void presets_set_what_they_say_and_keep_the_rest(void **state)
{
    (void)state;
    for (size_t i = 0; snow_reiter_preset_name(i) != NULL; i++) {
        snow_reiter_params params;
        snow_reiter_params_init(&params, sizeof params);
        params.noise = 0.01;
        params.noise_symmetric = 1;
        params.random_seed = 77;
        params.record_freeze_steps = 1;
        params.engine = SNOW_REITER_ENGINE_REFERENCE;
        assert_ok(snow_reiter_params_preset(&params, snow_reiter_preset_name(i)));
        assert_same_double(0.01, params.noise);
        assert_int_equal(1, params.noise_symmetric);
        assert_int_equal(77, params.random_seed);
        assert_int_equal(1, params.record_freeze_steps);
        assert_int_equal(SNOW_REITER_ENGINE_REFERENCE, params.engine);

        params.noise = 0;
        params.engine = SNOW_REITER_ENGINE_AUTO;
        snow_grid *grid = make_grid(&params, NULL);
        assert_ok(snow_step(grid, 2));
        snow_destroy(grid);
    }
}

static void presets_do_not_depend_on_what_was_set_before(void **state)
{
    (void)state;
    for (size_t i = 0; snow_reiter_preset_name(i) != NULL; i++) {
        snow_reiter_params fresh, used;
        snow_reiter_params_init(&fresh, sizeof fresh);
        snow_reiter_params_init(&used, sizeof used);
        assert_ok(snow_reiter_params_preset(&used, "cluster-5"));
        used.background = 0.123;
        used.addition = 0.456;
        used.diffusion = 2;
        used.domain = SNOW_REITER_RECTANGLE;
        used.rim = SNOW_REITER_RIM_ROW;
        used.cluster = 7;
        assert_ok(snow_reiter_params_preset(&fresh, snow_reiter_preset_name(i)));
        assert_ok(snow_reiter_params_preset(&used, snow_reiter_preset_name(i)));
        assert_same_double(fresh.background, used.background);
        assert_same_double(fresh.addition, used.addition);
        assert_same_double(fresh.diffusion, used.diffusion);
        assert_int_equal(fresh.domain, used.domain);
        assert_int_equal(fresh.rim, used.rim);
        assert_int_equal(fresh.cluster, used.cluster);
    }
}

static void the_paper_s_presets_have_the_paper_s_numbers(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double background, addition;
    } presets[] = {
        {"thin-dendrite", 0.3, 0.0001},
        {"thick-dendrite", 0.35, 0.001},
        {"star", 0.6, 0.01},
        {"sector", 0.9, 0.05},
    };
    for (size_t i = 0; i < COUNT_OF(presets); i++) {
        snow_reiter_params params;
        snow_reiter_params_init(&params, sizeof params);
        assert_ok(snow_reiter_params_preset(&params, presets[i].name));
        assert_same_double(presets[i].background, params.background);
        assert_same_double(presets[i].addition, params.addition);
        assert_same_double(1.0, params.diffusion);
        assert_int_equal(SNOW_REITER_DISC, params.domain);
    }
}

static void unknown_presets_are_refused(void **state)
{
    (void)state;
    static const char *const names[] = {"", "nothing", "thin-dendrite ", "THIN-DENDRITE", "thin"};
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        snow_reiter_params params = disc_scene(0.123, 0.456, 1, 78);
        snow_reiter_params before = params;
        assert_status(SNOW_ERROR_REITER_PRESET, snow_reiter_params_preset(&params, names[i]));
        assert_memory_equal(&before, &params, sizeof params);
    }
}

/* One number of the scene, and what the library says to it. */
typedef struct number_case {
    size_t offset;
    double number;
    snow_status status;
} number_case;

#define AT(member) offsetof(snow_reiter_params, member)
#define EVERY_KIND_OF_NOT_FINITE(member) \
    {AT(member), NAN, SNOW_ERROR_NOT_FINITE}, {AT(member), -NAN, SNOW_ERROR_NOT_FINITE}, \
    {AT(member), INFINITY, SNOW_ERROR_NOT_FINITE}, {AT(member), -INFINITY, SNOW_ERROR_NOT_FINITE}

static void numbers_out_of_range_are_refused(void **state)
{
    (void)state;
    const number_case cases[] = {
        EVERY_KIND_OF_NOT_FINITE(background),
        {AT(background), -0.1, SNOW_ERROR_REITER_BACKGROUND},
        {AT(background), -DBL_MIN, SNOW_ERROR_REITER_BACKGROUND},
        {AT(background), -DBL_TRUE_MIN, SNOW_ERROR_REITER_BACKGROUND},
        {AT(background), 1.0, SNOW_ERROR_REITER_BACKGROUND},
        {AT(background), nextafter(1.0, 2.0), SNOW_ERROR_REITER_BACKGROUND},
        {AT(background), DBL_MAX, SNOW_ERROR_REITER_BACKGROUND},
        {AT(background), -DBL_MAX, SNOW_ERROR_REITER_BACKGROUND},
        {AT(background), -0.0, SNOW_OK},
        {AT(background), 0.0, SNOW_OK},
        {AT(background), DBL_TRUE_MIN, SNOW_OK},
        {AT(background), DBL_MIN, SNOW_OK},
        {AT(background), 1 - 0x1p-30, SNOW_OK},

        EVERY_KIND_OF_NOT_FINITE(addition),
        {AT(addition), -0.1, SNOW_ERROR_REITER_ADDITION},
        {AT(addition), -DBL_TRUE_MIN, SNOW_ERROR_REITER_ADDITION},
        {AT(addition), nextafter(1.0, 2.0), SNOW_ERROR_REITER_ADDITION},
        {AT(addition), DBL_MAX, SNOW_ERROR_REITER_ADDITION},
        {AT(addition), -0.0, SNOW_OK},
        {AT(addition), 0.0, SNOW_OK},
        {AT(addition), DBL_TRUE_MIN, SNOW_OK},
        {AT(addition), 1.0, SNOW_OK},

        EVERY_KIND_OF_NOT_FINITE(diffusion),
        {AT(diffusion), -0.1, SNOW_ERROR_REITER_DIFFUSION},
        {AT(diffusion), -DBL_TRUE_MIN, SNOW_ERROR_REITER_DIFFUSION},
        {AT(diffusion), nextafter(8.0 / 3.0, 3.0), SNOW_ERROR_REITER_DIFFUSION},
        {AT(diffusion), 2.69, SNOW_ERROR_REITER_DIFFUSION},
        {AT(diffusion), DBL_MAX, SNOW_ERROR_REITER_DIFFUSION},
        {AT(diffusion), -0.0, SNOW_OK},
        {AT(diffusion), 0.0, SNOW_OK},
        {AT(diffusion), DBL_TRUE_MIN, SNOW_OK},
        {AT(diffusion), SNOW_REITER_STABLE_DIFFUSION, SNOW_OK},

        EVERY_KIND_OF_NOT_FINITE(noise),
        {AT(noise), -0.1, SNOW_ERROR_REITER_NOISE},
        {AT(noise), -DBL_TRUE_MIN, SNOW_ERROR_REITER_NOISE},
        {AT(noise), 0.6001, SNOW_ERROR_REITER_NOISE},
        {AT(noise), 0.5, SNOW_ERROR_REITER_NOISE},
        {AT(noise), DBL_MAX, SNOW_ERROR_REITER_NOISE},
        {AT(noise), -0.0, SNOW_OK},
        {AT(noise), DBL_TRUE_MIN, SNOW_OK},
        {AT(noise), 0.4, SNOW_OK},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        snow_reiter_params params = disc_scene(0.4, 0.001, 1, 4);
        memcpy((char *)&params + cases[i].offset, &cases[i].number, sizeof(double));
        snow_grid *grid = untouched;
        snow_status status = snow_reiter_create(&params, NULL, &grid);
        if (status != cases[i].status)
            print_error("number %a at offset %zu\n", cases[i].number, cases[i].offset);
        assert_status(cases[i].status, status);
        if (status == SNOW_OK) {
            assert_ok(snow_step(grid, 50));
            snow_destroy(grid);
        } else {
            assert_ptr_equal(untouched, grid);
        }
    }
}

/* The same for whole numbers. */
typedef struct integer_case {
    snow_reiter_domain domain;
    size_t offset;
    int32_t number;
    snow_status status;
} integer_case;

static void integers_out_of_range_are_refused(void **state)
{
    (void)state;
    const snow_reiter_domain disc = SNOW_REITER_DISC;
    const snow_reiter_domain hexagon = SNOW_REITER_HEXAGON;
    const snow_reiter_domain rectangle = SNOW_REITER_RECTANGLE;
    const int32_t most_radius = 1 << 20;
    const int32_t most_side = 1 << 21;
    const integer_case cases[] = {
        {disc, AT(radius), 0, SNOW_ERROR_REITER_RADIUS},
        {disc, AT(radius), -1, SNOW_ERROR_REITER_RADIUS},
        {disc, AT(radius), INT32_MIN, SNOW_ERROR_REITER_RADIUS},
        {disc, AT(radius), INT32_MAX, SNOW_ERROR_REITER_RADIUS},
        {disc, AT(radius), most_radius + 1, SNOW_ERROR_REITER_RADIUS},
        {disc, AT(radius), most_radius, SNOW_ERROR_TOO_LARGE},
        {disc, AT(radius), 1, SNOW_OK},
        {hexagon, AT(radius), 0, SNOW_ERROR_REITER_RADIUS},
        {hexagon, AT(radius), -5, SNOW_ERROR_REITER_RADIUS},
        {hexagon, AT(radius), INT32_MIN, SNOW_ERROR_REITER_RADIUS},
        {hexagon, AT(radius), INT32_MAX, SNOW_ERROR_REITER_RADIUS},
        {hexagon, AT(radius), most_radius + 1, SNOW_ERROR_REITER_RADIUS},
        {hexagon, AT(radius), most_radius, SNOW_ERROR_TOO_LARGE},
        {hexagon, AT(radius), 1, SNOW_OK},
        {rectangle, AT(radius), -5, SNOW_OK},
        {rectangle, AT(width), 0, SNOW_ERROR_REITER_SIDES},
        {rectangle, AT(width), -1, SNOW_ERROR_REITER_SIDES},
        {rectangle, AT(width), INT32_MIN, SNOW_ERROR_REITER_SIDES},
        {rectangle, AT(width), INT32_MAX, SNOW_ERROR_REITER_SIDES},
        {rectangle, AT(width), most_side + 1, SNOW_ERROR_REITER_SIDES},
        {rectangle, AT(height), 0, SNOW_ERROR_REITER_SIDES},
        {rectangle, AT(height), -1, SNOW_ERROR_REITER_SIDES},
        {rectangle, AT(height), INT32_MIN, SNOW_ERROR_REITER_SIDES},
        {rectangle, AT(height), INT32_MAX, SNOW_ERROR_REITER_SIDES},
        {rectangle, AT(height), most_side + 1, SNOW_ERROR_REITER_SIDES},
        {disc, AT(width), -5, SNOW_OK},
        {disc, AT(height), -5, SNOW_OK},
        {disc, AT(cluster), -1, SNOW_ERROR_REITER_CLUSTER},
        {disc, AT(cluster), 1025, SNOW_ERROR_REITER_CLUSTER},
        {disc, AT(cluster), INT32_MIN, SNOW_ERROR_REITER_CLUSTER},
        {disc, AT(cluster), INT32_MAX, SNOW_ERROR_REITER_CLUSTER},
        {disc, AT(cluster), 1, SNOW_OK},
        {disc, AT(noise_symmetric), -1, SNOW_ERROR_RANGE},
        {disc, AT(noise_symmetric), 2, SNOW_ERROR_RANGE},
        {disc, AT(noise_symmetric), INT32_MIN, SNOW_ERROR_RANGE},
        {disc, AT(record_freeze_steps), -1, SNOW_ERROR_RANGE},
        {disc, AT(record_freeze_steps), 2, SNOW_ERROR_RANGE},
        {disc, AT(allow_unstable), -1, SNOW_ERROR_RANGE},
        {disc, AT(allow_unstable), 2, SNOW_ERROR_RANGE},
        {disc, AT(allow_unstable), INT32_MAX, SNOW_ERROR_RANGE},
        {disc, AT(domain), 0, SNOW_ERROR_ENUM},
        {disc, AT(domain), 4, SNOW_ERROR_ENUM},
        {disc, AT(domain), -1, SNOW_ERROR_ENUM},
        {disc, AT(domain), INT32_MAX, SNOW_ERROR_ENUM},
        {disc, AT(rim), 0, SNOW_ERROR_ENUM},
        {disc, AT(rim), 3, SNOW_ERROR_ENUM},
        {disc, AT(rim), INT32_MIN, SNOW_ERROR_ENUM},
        {disc, AT(rim), SNOW_REITER_RIM_ROW, SNOW_ERROR_REITER_RIM},
        {hexagon, AT(rim), SNOW_REITER_RIM_ROW, SNOW_ERROR_REITER_RIM},
        {rectangle, AT(rim), SNOW_REITER_RIM_ROW, SNOW_OK},
        {disc, AT(engine), 4, SNOW_ERROR_ENUM},
        {disc, AT(engine), -1, SNOW_ERROR_ENUM},
        {disc, AT(engine), INT32_MAX, SNOW_ERROR_ENUM},
        {disc, AT(symmetry), 2, SNOW_ERROR_ENUM},
        {disc, AT(symmetry), -1, SNOW_ERROR_ENUM},
        {disc, AT(symmetry), INT32_MIN, SNOW_ERROR_ENUM},
        {disc, AT(symmetry), SNOW_REITER_SYMMETRY_NONE, SNOW_OK},
        {disc, AT(precision), 2, SNOW_ERROR_ENUM},
        {disc, AT(precision), -1, SNOW_ERROR_ENUM},
        {disc, AT(precision), SNOW_REITER_PRECISION_SINGLE, SNOW_OK},
        {rectangle, AT(radius), INT32_MIN, SNOW_OK},
    };
    assert_int_equal(sizeof(int32_t), sizeof(snow_reiter_domain));
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        snow_reiter_params params = disc_scene(0.4, 0.001, 1, 6);
        params.domain = cases[i].domain;
        params.width = 50;
        params.height = 70;
        memcpy((char *)&params + cases[i].offset, &cases[i].number, sizeof(int32_t));
        snow_grid *grid = untouched;
        snow_status status = snow_reiter_create(&params, NULL, &grid);
        if (status != cases[i].status)
            print_error("number %d at offset %zu of domain %d\n", cases[i].number, cases[i].offset, cases[i].domain);
        assert_status(cases[i].status, status);
        if (status == SNOW_OK)
            snow_destroy(grid);
        else
            assert_ptr_equal(untouched, grid);
    }
}

static void sizes_that_overflow_are_refused_before_memory_is_asked_for(void **state)
{
    (void)state;
    const snow_status in_64_bits = SIZE_MAX > UINT32_MAX ? SNOW_ERROR_MEMORY_LIMIT : SNOW_ERROR_TOO_LARGE;
    const struct {
        int32_t width, height;
        snow_status status;
    } sizes[] = {
        {1 << 21, 1 << 21, SNOW_ERROR_TOO_LARGE},
        {1 << 16, 1 << 16, SNOW_ERROR_TOO_LARGE},
        {1 << 21, 1 << 11, SNOW_ERROR_TOO_LARGE},
        {1 << 11, 1 << 21, SNOW_ERROR_TOO_LARGE},
        {1 << 16, 1 << 15, in_64_bits},
        {1 << 21, 1, SNOW_ERROR_MEMORY_LIMIT},
    };
    snow_options options = default_options();
    options.memory_limit = 1 << 20;
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        snow_reiter_params params = rectangle_scene(0.4, 0.001, 1, sizes[i].width, sizes[i].height);
        snow_grid *grid = untouched;
        assert_status(sizes[i].status, snow_reiter_create(&params, &options, &grid));
        assert_ptr_equal(untouched, grid);
    }
}

static void diffusion_beyond_the_stable_range_must_be_asked_for(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 4);
    params.allow_unstable = 1;
    params.diffusion = 4;
    digest_after(&params, 1);
    params.diffusion = nextafter(8.0 / 3.0, 3.0);
    digest_after(&params, 1);
    params.diffusion = nextafter(4.0, 5.0);
    assert_refused(SNOW_ERROR_REITER_DIFFUSION, &params);
    params.diffusion = NAN;
    assert_refused(SNOW_ERROR_NOT_FINITE, &params);
}

static void negative_zero_is_zero(void **state)
{
    (void)state;
    snow_reiter_params plus = disc_scene(0.0, 0.0, 0.0, 6);
    snow_reiter_params minus = disc_scene(-0.0, -0.0, -0.0, 6);
    minus.noise = -0.0;
    assert_true(digest_after(&plus, 10) == digest_after(&minus, 10));
    plus.addition = 0.25;
    minus.addition = 0.25;
    assert_true(digest_after(&plus, 10) == digest_after(&minus, 10));
}

static void tiny_backgrounds_are_kept(void **state)
{
    (void)state;
    static const double backgrounds[] = {DBL_TRUE_MIN, 0x1p-1060, DBL_MIN, 0x1p-1000, 0x1p-600, 1e-30};
    for (size_t i = 0; i < COUNT_OF(backgrounds); i++) {
        snow_reiter_params params = disc_scene(backgrounds[i], 0.5, 1, 6);
        snow_grid *grid = make_grid(&params, NULL);
        assert_near(backgrounds[i], value_at(grid, SNOW_FIELD_VALUE, 3, 0), backgrounds[i]);
        assert_ok(snow_step(grid, 4));
        assert_int_equal(19, frozen_of(grid));
        assert_same_double(0.0, defect_of(grid));
        snow_destroy(grid);
    }
}

static void seeds_must_lie_inside(void **state)
{
    (void)state;
    static const snow_cell outside[] = {{5, 0},         {0, 5},          {-5, 0},         {3, 3},
                                        {INT32_MAX, 0}, {INT32_MIN, 0},  {0, INT32_MIN},  {INT32_MAX, INT32_MAX},
                                        {INT32_MIN, INT32_MIN}, {INT32_MAX, INT32_MIN}, {46341, 46341}};
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 5);
    for (size_t i = 0; i < COUNT_OF(outside); i++) {
        const snow_cell seeds[] = {{0, 0}, {1, 1}, outside[i]};
        params.seeds = seeds;
        params.seed_count = 3;
        assert_refused(SNOW_ERROR_REITER_SEED, &params);
        params.domain = SNOW_REITER_HEXAGON;
        assert_refused(SNOW_ERROR_REITER_SEED, &params);
        params.domain = SNOW_REITER_RECTANGLE;
        params.width = 3;
        params.height = 5;
        assert_refused(SNOW_ERROR_REITER_SEED, &params);
        params.domain = SNOW_REITER_DISC;
        params.seed_count = 2;
        digest_after(&params, 1);
    }
}

static void seeds_are_copied_and_may_repeat(void **state)
{
    (void)state;
    snow_cell seeds[] = {{2, -1}, {0, 0}, {2, -1}, {-3, 1}, {0, 0}};
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 8);
    params.seeds = seeds;
    params.seed_count = COUNT_OF(seeds);
    snow_grid *grid = make_grid(&params, NULL);
    memset(seeds, 0x7f, sizeof seeds);
    assert_int_equal(3, frozen_of(grid));
    assert_same_double(1.0, value_at(grid, SNOW_FIELD_VALUE, 2, -1));
    assert_same_double(1.0, value_at(grid, SNOW_FIELD_VALUE, 0, 0));
    assert_same_double(1.0, value_at(grid, SNOW_FIELD_VALUE, -3, 1));
    assert_same_double(sqrt(7.0), tip_of(grid));
    assert_ok(snow_step(grid, 5));
    snow_destroy(grid);
}

static void an_empty_list_of_seeds_means_no_ice(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 8);
    without_seeds(&params);
    snow_grid *grid = make_grid(&params, NULL);
    assert_int_equal(0, frozen_of(grid));
    assert_same_double(0.0, tip_of(grid));
    snow_rect bounds = {9, 9, 9, 9};
    assert_ok(snow_frozen_bounds(grid, &bounds));
    assert_int_equal(0, bounds.width);
    assert_int_equal(0, bounds.height);
    snow_destroy(grid);
}

static void clusters_exclude_seeds_and_fit_the_domain(void **state)
{
    (void)state;
    static const snow_cell seed = {0, 0};
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 30);
    params.cluster = 5;
    params.seeds = &seed;
    params.seed_count = 1;
    assert_refused(SNOW_ERROR_REITER_CLUSTER, &params);
    params.seeds = NULL;
    params.seed_count = 0;
    digest_after(&params, 1);
}

static void clusters_are_reproducible_patches(void **state)
{
    (void)state;
    for (int32_t side = 1; side <= 8; side++) {
        uint64_t all = 0;
        size_t different = 0;
        uint64_t last = 0;
        for (uint64_t seed = 0; seed < 200; seed++) {
            snow_reiter_params params = disc_scene(0.4, 0.001, 1, 10);
            params.cluster = side;
            params.random_seed = seed;
            snow_grid *grid = make_grid(&params, NULL);
            uint64_t frozen = frozen_of(grid);
            uint64_t digest = digest_of(grid);
            snow_rect bounds;
            assert_ok(snow_frozen_bounds(grid, &bounds));
            assert_true(frozen <= (uint64_t)(side * side));
            assert_true(bounds.height <= side);
            assert_true(frozen > 0);
            assert_true(bounds.r >= -(side / 2) - 1 && bounds.r + bounds.height <= side / 2 + 2);
            assert_true(tip_of(grid) <= side);
            snow_destroy(grid);
            assert_true(digest_after(&params, 0) == digest);
            different += digest != last;
            last = digest;
            all += frozen;
        }
        /* 200 side² fair coins, less the patches without any ice, which are drawn again: five standard deviations. */
        double cells = (double)side * side;
        double mean = 100 * cells / (1 - pow(0.5, cells));
        assert_near(mean, (double)all, 2.5 * sqrt(200.0) * side);
        assert_true(different > 60 || side < 3);
    }
}

static void noise_stays_within_its_amplitude(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 50);
    without_seeds(&params);
    params.noise = 0.25;
    params.random_seed = 12345;
    snow_grid *grid = make_grid(&params, NULL);
    size_t count;
    double *values = copy_field(grid, SNOW_FIELD_VALUE, NULL, &count);
    double *inside = copy_field(grid, SNOW_FIELD_INSIDE, NULL, NULL);
    double sum = 0, squares = 0;
    size_t cells = 0;
    for (size_t i = 0; i < count; i++) {
        if (inside[i] == 0) {
            assert_near(0.4, values[i], 0x1p-51);
            continue;
        }
        assert_true(values[i] >= 0.15 - 0x1p-50 && values[i] < 0.65 + 0x1p-50);
        sum += values[i] - 0.4;
        squares += (values[i] - 0.4) * (values[i] - 0.4);
        cells++;
    }
    /* Uniform in [-a, a): variance a²/3; five standard deviations of the mean and of the variance. */
    double n = (double)cells;
    double variance = 0.25 * 0.25 / 3;
    assert_near(0.0, sum / n, 5 * sqrt(variance / n));
    assert_near(variance, squares / n, 5 * sqrt(4.0 / 45.0 * pow(0.25, 4) / n));
    free(values);
    free(inside);
    snow_destroy(grid);

    uint64_t digest = digest_after(&params, 0);
    assert_true(digest == digest_after(&params, 0));
    params.random_seed++;
    assert_true(digest != digest_after(&params, 0));
    params.random_seed = UINT64_C(1) << 63;
    uint64_t high = digest_after(&params, 0);
    params.random_seed = 0;
    assert_true(high != digest_after(&params, 0));
}

static void noise_of_a_cell_does_not_depend_on_the_domain(void **state)
{
    (void)state;
    snow_reiter_params small = disc_scene(0.4, 0.001, 1, 7);
    snow_reiter_params large = hexagon_scene(0.4, 0.001, 1, 20);
    small.noise = large.noise = 0.1;
    small.random_seed = large.random_seed = 5;
    snow_grid *left = make_grid(&small, NULL);
    snow_grid *right = make_grid(&large, NULL);
    for (int32_t q = -3; q <= 3; q++)
        for (int32_t r = -3; r <= 3; r++)
            assert_same_double(value_at(left, SNOW_FIELD_VALUE, q, r), value_at(right, SNOW_FIELD_VALUE, q, r));
    snow_destroy(left);
    snow_destroy(right);
}

/* A field that is `odd` at one cell and 0.25 elsewhere, and remembers where it was asked. */
typedef struct odd_field {
    snow_cell where;
    double odd;
    size_t calls;
} odd_field;

static double odd_at(void *context, int32_t q, int32_t r)
{
    odd_field *field = context;
    field->calls++;
    return q == field->where.q && r == field->where.r ? field->odd : 0.25;
}

static void fields_of_callbacks_are_checked_cell_by_cell(void **state)
{
    (void)state;
    static const struct {
        double odd;
        snow_status background, addition;
    } cases[] = {
        {NAN, SNOW_ERROR_NOT_FINITE, SNOW_ERROR_NOT_FINITE},
        {INFINITY, SNOW_ERROR_NOT_FINITE, SNOW_ERROR_NOT_FINITE},
        {-INFINITY, SNOW_ERROR_NOT_FINITE, SNOW_ERROR_NOT_FINITE},
        {-0.5, SNOW_ERROR_REITER_BACKGROUND, SNOW_ERROR_REITER_ADDITION},
        {1.5, SNOW_ERROR_REITER_BACKGROUND, SNOW_ERROR_REITER_ADDITION},
        {1.0, SNOW_ERROR_REITER_BACKGROUND, SNOW_OK},
        {0.0, SNOW_OK, SNOW_OK},
        {0.75, SNOW_OK, SNOW_OK},
    };
    static const snow_cell cells[] = {{0, 0}, {3, 0}, {-4, 2}, {0, -4}, {0, 4}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        for (size_t j = 0; j < COUNT_OF(cells); j++) {
            odd_field field = {cells[j], cases[i].odd, 0};
            snow_reiter_params params = disc_scene(0.4, 0.001, 1, 5);
            params.field_context = &field;
            params.background_at = odd_at;
            snow_grid *grid = untouched;
            assert_status(cases[i].background, snow_reiter_create(&params, NULL, &grid));
            if (cases[i].background == SNOW_OK)
                snow_destroy(grid);
            else
                assert_ptr_equal(untouched, grid);

            params.background_at = NULL;
            params.addition_at = odd_at;
            grid = untouched;
            assert_status(cases[i].addition, snow_reiter_create(&params, NULL, &grid));
            if (cases[i].addition == SNOW_OK)
                snow_destroy(grid);
            else
                assert_ptr_equal(untouched, grid);
        }
    }
    odd_field field = {{5, 0}, 7.0, 0};
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 5);
    params.field_context = &field;
    params.background_at = odd_at;
    assert_refused(SNOW_ERROR_REITER_BACKGROUND, &params);
}

static double wandering(void *context, int32_t q, int32_t r)
{
    size_t *asked = context;
    (*asked)++;
    return 0.25 + (q - r) / 64.0;
}

static void callbacks_are_asked_once_for_each_cell(void **state)
{
    (void)state;
    size_t asked = 0;
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 5);
    params.field_context = &asked;
    params.background_at = wandering;
    snow_grid *grid = make_grid(&params, NULL);
    snow_rect rect = widened(bounds_of(grid));
    size_t next_to_interior = 0;
    for (int32_t r = rect.r; r < rect.r + rect.height; r++) {
        for (int32_t q = rect.q; q < rect.q + rect.width; q++) {
            bool touches = value_at(grid, SNOW_FIELD_INSIDE, q, r) == 1;
            for (int i = 0; i < 6; i++)
                touches = touches || value_at(grid, SNOW_FIELD_INSIDE, q + neighbours[i].q, r + neighbours[i].r) == 1;
            next_to_interior += touches;
        }
    }
    size_t asked_at_create = asked;
    assert_ok(snow_step(grid, 20));
    assert_int_equal(asked_at_create, asked);
    assert_int_equal(next_to_interior, asked);
    snow_destroy(grid);
}

static void garbage_never_makes_a_grid_go_wrong(void **state)
{
    (void)state;
    uint64_t random = 1;
    size_t made = 0;
    snow_options options = default_options();
    options.memory_limit = 1 << 22;
    for (int round = 0; round < 3000; round++) {
        /* Room behind the struct, for its size may become garbage as well. */
        union {
            snow_reiter_params params;
            unsigned char bytes[4096];
        } scene = {.bytes = {0}};
        snow_reiter_params_init(&scene.params, sizeof scene.params);
        scene.params.radius = 9;
        for (uint32_t hit = next_below(&random, 4) + 1; hit > 0; hit--) {
            uint32_t at = next_below(&random, sizeof scene.params);
            bool pointer = (at >= AT(seeds) && at < AT(cluster)) ||
                           (at >= AT(background_at) && at < AT(record_freeze_steps));
            if (!pointer)
                scene.bytes[at] = (unsigned char)next_below(&random, 256);
        }
        snow_grid *grid = untouched;
        snow_status status = snow_reiter_create(&scene.params, &options, &grid);
        if (status == SNOW_OK) {
            assert_ok(snow_step(grid, 1));
            snow_destroy(grid);
            made++;
        } else {
            assert_ptr_equal(untouched, grid);
        }
    }
    assert_true(made > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_the_documented_ones),
        cmocka_unit_test(precision_and_tolerance_must_fit_the_engine),
        cmocka_unit_test(the_default_scene_has_one_seed),
        cmocka_unit_test(null_pointers_are_refused),
        cmocka_unit_test(presets_set_what_they_say_and_keep_the_rest),
        cmocka_unit_test(presets_do_not_depend_on_what_was_set_before),
        cmocka_unit_test(the_paper_s_presets_have_the_paper_s_numbers),
        cmocka_unit_test(unknown_presets_are_refused),
        cmocka_unit_test(numbers_out_of_range_are_refused),
        cmocka_unit_test(integers_out_of_range_are_refused),
        cmocka_unit_test(sizes_that_overflow_are_refused_before_memory_is_asked_for),
        cmocka_unit_test(diffusion_beyond_the_stable_range_must_be_asked_for),
        cmocka_unit_test(negative_zero_is_zero),
        cmocka_unit_test(tiny_backgrounds_are_kept),
        cmocka_unit_test(seeds_must_lie_inside),
        cmocka_unit_test(seeds_are_copied_and_may_repeat),
        cmocka_unit_test(an_empty_list_of_seeds_means_no_ice),
        cmocka_unit_test(clusters_exclude_seeds_and_fit_the_domain),
        cmocka_unit_test(clusters_are_reproducible_patches),
        cmocka_unit_test(noise_stays_within_its_amplitude),
        cmocka_unit_test(noise_of_a_cell_does_not_depend_on_the_domain),
        cmocka_unit_test(fields_of_callbacks_are_checked_cell_by_cell),
        cmocka_unit_test(callbacks_are_asked_once_for_each_cell),
        cmocka_unit_test(garbage_never_makes_a_grid_go_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
