/* What the frame promises of every grid, kept by Packard's model: fields, saved grids, stop conditions, memory, measures;
   and its own queries. */
#include "support/allocator.h"
#include "support/packard.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const snow_packard_engine engines[] = {SNOW_PACKARD_ENGINE_REFERENCE, SNOW_PACKARD_ENGINE_TILES,
                                              SNOW_PACKARD_ENGINE_QUADTREE, SNOW_PACKARD_ENGINE_AUTO};

static snow_grid *grown(const char *rule, snow_packard_engine engine, int64_t steps)
{
    snow_packard_params params = packard_scene(rule);
    params.engine = engine;
    snow_grid *grid = make_packard(&params, NULL);
    assert_ok(snow_step(grid, steps));
    return grid;
}

static unsigned char *save(const snow_grid *grid, size_t *size)
{
    assert_ok(snow_save(grid, NULL, 0, size));
    unsigned char *bytes = malloc(*size);
    assert_non_null(bytes);
    assert_ok(snow_save(grid, bytes, *size, size));
    return bytes;
}

static void save_load_continue_is_continue(void **state)
{
    (void)state;
    uint64_t random = 99;
    for (int scene = 0; scene < 60; scene++) {
        snow_cell seeds[8];
        snow_packard_params params = random_packard_scene(&random, seeds);
        params.record_freeze_steps = scene % 3 == 0;
        params.engine = engines[scene % 4];
        if (params.engine == SNOW_PACKARD_ENGINE_QUADTREE &&
            (params.record_freeze_steps || params.domain != SNOW_PACKARD_PLANE))
            params.engine = SNOW_PACKARD_ENGINE_AUTO;
        snow_grid *grid = make_packard(&params, NULL), *loaded = NULL;
        add_random_zones(&random, &grid, 1);
        for (int part = 0; part < 3; part++) {
            size_t size, again;
            unsigned char *bytes = save(grid, &size);
            assert_ok(snow_load(bytes, size, NULL, &loaded));
            assert_same_crystals(grid, loaded);
            assert_int_equal(engine_of(grid), engine_of(loaded));
            unsigned char *twice = save(loaded, &again);
            assert_int_equal(size, again);
            assert_memory_equal(bytes, twice, size);
            assert_ok(snow_step(grid, 11));
            assert_ok(snow_step(loaded, 11));
            assert_same_crystals(grid, loaded);
            free(bytes);
            free(twice);
            snow_destroy(loaded);
        }
        snow_destroy(grid);
    }
}

static void damaged_snapshots_are_refused(void **state)
{
    (void)state;
    for (int engine = SNOW_PACKARD_ENGINE_TILES; engine <= SNOW_PACKARD_ENGINE_QUADTREE; engine++) {
        snow_grid *grid = grown("0101010", (snow_packard_engine)engine, 40), *loaded = NULL;
        size_t size;
        unsigned char *bytes = save(grid, &size);
        snow_options options = default_options();
        options.memory_limit = 1 << 22;
        for (size_t i = 0; i < size; i++) {
            for (int bit = 0; bit < 8; bit += 3) {
                bytes[i] ^= (unsigned char)(1 << bit);
                assert_true(snow_load(bytes, size, &options, &loaded) != SNOW_OK);
                bytes[i] ^= (unsigned char)(1 << bit);
            }
            assert_true(snow_load(bytes, i, &options, &loaded) != SNOW_OK);
        }
        assert_null(loaded);
        free(bytes);
        snow_destroy(grid);
    }
}

static void a_crystal_beyond_all_bounds_is_saved(void **state)
{
    (void)state;
    snow_grid *grid = grown("0101010", SNOW_PACKARD_ENGINE_QUADTREE, INT64_C(1) << 50), *loaded = NULL;
    size_t size;
    unsigned char *bytes = save(grid, &size);
    assert_in_range(size, 100, 1 << 20);
    assert_ok(snow_load(bytes, size, NULL, &loaded));
    uint64_t high, low, again_high, again_low;
    for (int part = 0; part < 2; part++) {
        assert_ok(snow_packard_population(grid, &high, &low));
        assert_ok(snow_packard_population(loaded, &again_high, &again_low));
        assert_int_equal(high, again_high);
        assert_int_equal(low, again_low);
        assert_ok(snow_step(grid, 12345));
        assert_ok(snow_step(loaded, 12345));
    }
    free(bytes);
    snow_destroy(grid);
    snow_destroy(loaded);
}

/* A seed anywhere costs the quadtree what one at the origin does, and is saved with its place. */
static void a_crystal_off_the_origin_is_no_dearer(void **state)
{
    (void)state;
    static const snow_cell places[] = {{0, 0}, {1, 0}, {-1000003, 77}};
    uint64_t least = 0;
    for (size_t i = 0; i < COUNT_OF(places); i++) {
        snow_packard_params params = packard_scene("0100000");
        params.engine = SNOW_PACKARD_ENGINE_QUADTREE;
        params.seeds = &places[i];
        params.seed_count = 1;
        snow_grid *grid = make_packard(&params, NULL), *loaded = NULL;
        assert_ok(snow_step(grid, 1 << 14));
        uint64_t memory = 0;
        assert_ok(snow_memory(grid, &memory));
        least = i == 0 ? memory : least;
        assert_in_range(memory, least, least + least / 50);
        size_t size;
        unsigned char *bytes = save(grid, &size);
        assert_ok(snow_load(bytes, size, NULL, &loaded));
        snow_hexagon expected, got;
        for (int part = 0; part < 2; part++) {
            assert_ok(snow_frozen_hexagon(grid, &expected));
            assert_ok(snow_frozen_hexagon(loaded, &got));
            assert_memory_equal(&expected, &got, sizeof got);
            assert_int_equal(places[i].q - (1 << 14) - 100 * part, got.least_q);
            assert_int_equal(places[i].r + (1 << 14) + 100 * part, got.greatest_r);
            assert_same_double(tip_of(grid), tip_of(loaded));
            assert_ok(snow_step(grid, 100));
            assert_ok(snow_step(loaded, 100));
        }
        free(bytes);
        snow_destroy(grid);
        snow_destroy(loaded);
    }
}

static void what_is_too_large_is_said(void **state)
{
    (void)state;
    snow_grid *grid = grown("0101010", SNOW_PACKARD_ENGINE_AUTO, INT64_C(1) << 40);
    uint64_t number, high, low;
    snow_rect rect;
    size_t size;
    double real;
    snow_hexagon hexagon;
    assert_int_equal(SNOW_PACKARD_ENGINE_QUADTREE, engine_of(grid));
    assert_status(SNOW_ERROR_TOO_LARGE, snow_frozen(grid, &number));
    assert_status(SNOW_ERROR_TOO_LARGE, snow_frozen_bounds(grid, &rect));
    assert_status(SNOW_ERROR_TOO_LARGE, snow_domain_bounds(grid, &rect));
    assert_status(SNOW_ERROR_TOO_LARGE, snow_domain_cells(grid, &number));
    assert_status(SNOW_ERROR_TOO_LARGE, snow_digest(grid, &number));
    assert_status(SNOW_ERROR_TOO_LARGE, snow_mass(grid, &real, NULL));
    assert_status(SNOW_ERROR_TOO_LARGE, snow_symmetry_defect(grid, &real));
    assert_status(SNOW_ERROR_TOO_LARGE, snow_field_copy(grid, SNOW_FIELD_FROZEN, NULL, NULL, 0, &size));
    assert_status(SNOW_ERROR_TOO_LARGE, snow_packard_save_rle(grid, NULL, 0, &size));
    assert_status(SNOW_ERROR_TOO_LARGE, snow_dimension(grid, &real));
    assert_status(SNOW_ERROR_TOO_LARGE, snow_box_count(grid, 4, &number));
    assert_ok(snow_packard_population(grid, &high, &low));
    assert_true(high > 0);
    assert_ok(snow_frozen_hexagon(grid, &hexagon));
    assert_int_equal(INT64_C(1) << 40, hexagon.greatest_s);
    assert_same_double(0x1p40, tip_of(grid));
    assert_ok(snow_density(grid, &real));
    assert_near(5.0 / 6, real, 1e-9);
    assert_same_double(1, value_at(grid, SNOW_FIELD_FROZEN, 0, 0));
    uint64_t words[2];
    assert_ok(snow_packard_copy_bits(grid, (INT64_C(1) << 40) - 3, 0, 8, 1, words, 1));
    assert_int_equal(0xF, words[0]);
    snow_destroy(grid);
}

static void steps_end_at_their_limit(void **state)
{
    (void)state;
    snow_grid *grid = grown("0101010", SNOW_PACKARD_ENGINE_QUADTREE, INT64_C(1) << 62);
    assert_status(SNOW_ERROR_STEP_LIMIT, snow_step(grid, 1));
    assert_int_equal(INT64_C(1) << 62, steps_of(grid));
    snow_destroy(grid);
}

static void bits_are_the_frozen_cells(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_grid *grid = grown("0100000", engines[i], 40);
        uint64_t words[50 * 2];
        assert_ok(snow_packard_copy_bits(grid, -45, -20, 100, 50, words, COUNT_OF(words)));
        for (int32_t y = 0; y < 50; y++)
            for (int32_t x = 0; x < 128; x++)
                assert_int_equal(x < 100 && value_at(grid, SNOW_FIELD_FROZEN, x - 45, y - 20) != 0,
                                 words[2 * y + x / 64] >> (x % 64) & 1);
        assert_status(SNOW_ERROR_BUFFER, snow_packard_copy_bits(grid, 0, 0, 65, 2, words, 3));
        assert_status(SNOW_ERROR_RECTANGLE, snow_packard_copy_bits(grid, 0, 0, -1, 2, words, 3));
        assert_status(SNOW_ERROR_RECTANGLE, snow_packard_copy_bits(grid, INT64_MAX, 0, 1, 1, words, 3));
        assert_ok(snow_packard_copy_bits(grid, 0, 0, 0, 2, words, 0));
        snow_destroy(grid);
    }
}

static void no_bits_are_set_far_away(void **state)
{
    (void)state;
    static const int64_t far[] = {0, INT64_C(1) << 37, INT64_C(1) << 38, -(INT64_C(1) << 38), (INT64_C(1) << 62) - 64,
                                  -(INT64_C(1) << 62)};
    snow_packard_params params = packard_scene("0100000");
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        for (params.cluster = 0; params.cluster <= 3; params.cluster += 3) { /* with all symmetries, and with none */
            params.engine = engines[i];
            snow_grid *grid = make_packard(&params, NULL);
            assert_ok(snow_step(grid, 8));
            for (size_t k = 1; k < COUNT_OF(far) * COUNT_OF(far); k++) {
                uint64_t word = 1;
                assert_ok(snow_packard_copy_bits(grid, far[k / COUNT_OF(far)], far[k % COUNT_OF(far)], 64, 1, &word, 1));
                assert_int_equal(0, word);
            }
            snow_destroy(grid);
        }
    }
}

static void fields_are_read_as_they_should_be(void **state)
{
    (void)state;
    snow_packard_params params = packard_scene("0101010");
    params.record_freeze_steps = 1;
    snow_grid *grid = make_packard(&params, NULL);
    assert_ok(snow_step(grid, 3));
    double value;
    assert_same_double(0, value_at(grid, SNOW_FIELD_FREEZE_STEP, 0, 0));
    assert_same_double(3, value_at(grid, SNOW_FIELD_FREEZE_STEP, 3, 0));
    assert_same_double(-1, value_at(grid, SNOW_FIELD_FREEZE_STEP, 1, 1));
    assert_same_double(1, value_at(grid, SNOW_FIELD_VALUE, 3, 0));
    assert_same_double(0, value_at(grid, SNOW_FIELD_VAPOUR, 3, 0));
    assert_same_double(1, value_at(grid, SNOW_FIELD_VAPOUR, 1, 1));
    assert_same_double(1, value_at(grid, SNOW_FIELD_RECEPTIVE, 4, 0));
    assert_same_double(0, value_at(grid, SNOW_FIELD_RECEPTIVE, 5, 0));
    assert_same_double(1, value_at(grid, SNOW_FIELD_INSIDE, 4, 0));
    assert_same_double(0, value_at(grid, SNOW_FIELD_INSIDE, 5, 0));
    assert_status(SNOW_ERROR_UNSUPPORTED, snow_cell_value(grid, SNOW_FIELD_ADDITION, 0, 0, &value));
    assert_status(SNOW_ERROR_UNSUPPORTED, snow_cell_value(grid, SNOW_FIELD_BACKGROUND, 0, 0, &value));
    snow_destroy(grid);
    grid = grown("0101010", SNOW_PACKARD_ENGINE_TILES, 3);
    assert_status(SNOW_ERROR_NOT_RECORDED, snow_cell_value(grid, SNOW_FIELD_FREEZE_STEP, 0, 0, &value));
    snow_destroy(grid);
}

static void cells_can_be_frozen_and_melted(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_grid *grid = grown("0101010", engines[i], 20);
        uint64_t before = frozen_of(grid);
        set_cell(grid, SNOW_FIELD_FROZEN, 0, 0, 0);
        set_cell(grid, SNOW_FIELD_VALUE, 40, -7, 1);
        assert_int_equal(before, frozen_of(grid));
        assert_same_double(0, value_at(grid, SNOW_FIELD_FROZEN, 0, 0));
        assert_same_double(1, value_at(grid, SNOW_FIELD_FROZEN, 40, -7));
        double value = 0.5;
        assert_status(SNOW_ERROR_RANGE, snow_field_set(grid, SNOW_FIELD_VALUE, &(snow_rect){0, 0, 1, 1}, &value, 1));
        value = NAN;
        assert_status(SNOW_ERROR_NOT_FINITE,
                      snow_field_set(grid, SNOW_FIELD_VALUE, &(snow_rect){0, 0, 1, 1}, &value, 1));
        value = 1;
        assert_status(SNOW_ERROR_UNSUPPORTED,
                      snow_field_set(grid, SNOW_FIELD_VAPOUR, &(snow_rect){0, 0, 1, 1}, &value, 1));
        assert_ok(snow_step(grid, 10));
        snow_grid *expected = grown("0101010", SNOW_PACKARD_ENGINE_REFERENCE, 20);
        set_cell(expected, SNOW_FIELD_FROZEN, 0, 0, 0);
        set_cell(expected, SNOW_FIELD_FROZEN, 40, -7, 1);
        assert_ok(snow_step(expected, 10));
        assert_same_crystals(expected, grid);
        snow_destroy(grid);
        snow_destroy(expected);
    }
}

/* Every engine ends in the step in which single steps find the condition. */
static void runs_end_at_the_right_step(void **state)
{
    (void)state;
    static const struct {
        const char *rule;
        snow_packard_domain domain;
        int32_t rim;
        double tip;
        uint64_t frozen;
    } runs[] = {
        {"0100000", SNOW_PACKARD_PLANE, 1, 0, 20000},    {"0101010", SNOW_PACKARD_PLANE, 1, 77.5, 0},
        {"0101010", SNOW_PACKARD_HEXAGON, 1, 0, 0},      {"0100000", SNOW_PACKARD_DISC, 1, 0, 0},
        {"0100100", SNOW_PACKARD_RECTANGLE, 1, 0, 0},    {"0110100", SNOW_PACKARD_RHOMBUS, 1, 0, 0},
        {"0100000", SNOW_PACKARD_TORUS, 1, 0, 0},        {"0101010", SNOW_PACKARD_DISC, 0, 0, 0},
        {"0001000", SNOW_PACKARD_PLANE, 1, 0, 0},        {"0100000", SNOW_PACKARD_PLANE, 1, 90, 15000},
    };
    static const snow_cell seeds[] = {{0, 0}, {1, 0}, {0, 3}};
    for (size_t i = 0; i < COUNT_OF(runs); i++) {
        snow_summary expected = {0};
        for (size_t k = 0; k < COUNT_OF(engines); k++) {
            snow_packard_params params = packard_scene(runs[i].rule);
            params.domain = runs[i].domain;
            params.radius = params.width = params.height = 30;
            params.engine = engines[k];
            params.seeds = seeds;
            params.seed_count = COUNT_OF(seeds);
            if (engines[k] == SNOW_PACKARD_ENGINE_QUADTREE && runs[i].domain != SNOW_PACKARD_PLANE)
                continue;
            snow_stop stop = default_stop();
            stop.rim = runs[i].rim;
            stop.tip_radius = runs[i].tip;
            stop.frozen = runs[i].frozen;
            snow_grid *grid = make_packard(&params, NULL);
            snow_summary summary = run_grid(grid, &stop);
            if (k == 0)
                expected = summary;
            assert_int_equal(expected.reason, summary.reason);
            assert_int_equal(expected.steps, summary.steps);
            assert_int_equal(expected.frozen, summary.frozen);
            assert_true(summary.reason != SNOW_STOP_STEPS);
            snow_destroy(grid);
        }
    }
}

/* Cut into slices of any length, a run ends where it ended. */
static void sliced_runs_end_at_the_same_step(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(engines); k++) {
        snow_packard_params params = packard_scene("0001000");
        params.cluster = 9;
        params.engine = engines[k];
        snow_grid *grid = make_packard(&params, NULL);
        snow_stop stop = default_stop();
        snow_summary summary;
        stop.max_steps = 0;
        do {
            stop.max_steps += 7;
            summary = run_grid(grid, &stop);
        } while (summary.reason == SNOW_STOP_STEPS);
        assert_int_equal(SNOW_STOP_STILL, summary.reason);
        assert_int_equal(64, summary.steps);
        snow_destroy(grid);
    }
}

/* Steps that would take years are not taken in one go. */
static void a_time_budget_ends_a_run(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(engines); k++) {
        snow_packard_params params = packard_scene("0100000");
        params.engine = engines[k];
        snow_grid *grid = make_packard(&params, NULL);
        snow_stop stop = stop_after(INT64_C(1) << 40);
        stop.seconds = 1e-9;
        int64_t last = 0;
        for (int slice = 0; slice < 3; slice++) {
            snow_summary summary = run_grid(grid, &stop);
            assert_int_equal(SNOW_STOP_TIME, summary.reason);
            assert_in_range(summary.steps, last + 1, 100000);
            last = summary.steps;
        }
        assert_int_equal(population_after("0100000", SNOW_PACKARD_ENGINE_TILES, last), frozen_of(grid));
        snow_destroy(grid);
    }
}

static void memory_goes_back_and_failures_are_clean(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        for (size_t nth = 1;; nth++) {
            test_allocator allocator = {.fail_at = nth};
            snow_options options = allocator_options(&allocator);
            snow_packard_params params = packard_scene("0101010");
            params.engine = engines[i];
            snow_grid *grid = NULL;
            snow_status status = snow_packard_create(&params, &options, &grid);
            snow_packard_zone zone =
                packard_zone_of(SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_CELLS, 5, 9);
            zone.rect = (snow_rect){1, 1, 9, 9};
            zone.mask = (const uint8_t[81]){1};
            if (status == SNOW_OK)
                status = snow_packard_add_zone(grid, &zone);
            bool added = status == SNOW_OK;
            if (status == SNOW_OK)
                status = snow_step(grid, 70);
            bool failed = status != SNOW_OK;
            if (failed)
                assert_status(SNOW_ERROR_NO_MEMORY, status);
            if (failed && added) { /* it goes on from where it stands */
                snow_grid *plain = make_packard(&params, NULL);
                assert_ok(snow_packard_add_zone(plain, &zone));
                assert_ok(snow_step(plain, steps_of(grid)));
                assert_same_crystals(plain, grid);
                assert_ok(snow_step(plain, 20));
                assert_ok(snow_step(grid, 20));
                assert_same_crystals(plain, grid);
                snow_destroy(plain);
            }
            snow_destroy(grid);
            assert_int_equal(0, allocator.live_blocks);
            if (!failed)
                break;
        }
    }
}

static void the_memory_limit_holds(void **state)
{
    (void)state;
    for (int engine = SNOW_PACKARD_ENGINE_AUTO; engine <= SNOW_PACKARD_ENGINE_QUADTREE; engine++) {
        snow_options options = default_options();
        options.memory_limit = 80000;
        snow_packard_params params = packard_scene("0100000");
        params.cluster = 3;
        params.engine = (snow_packard_engine)engine;
        snow_grid *grid = make_packard(&params, &options);
        snow_status status = SNOW_OK;
        while (status == SNOW_OK && steps_of(grid) < 3000)
            status = snow_step(grid, 50);
        uint64_t bytes;
        assert_status(SNOW_ERROR_MEMORY_LIMIT, status);
        assert_ok(snow_memory(grid, &bytes));
        assert_in_range(bytes, 1, options.memory_limit);
        params.engine = SNOW_PACKARD_ENGINE_TILES;
        snow_grid *plain = make_packard(&params, NULL);
        assert_ok(snow_step(plain, steps_of(grid)));
        assert_same_crystals(plain, grid);
        snow_destroy(plain);
        snow_destroy(grid);
    }
}

static void measures_agree_with_the_cells(void **state)
{
    (void)state;
    snow_grid *grid = grown("0100000", SNOW_PACKARD_ENGINE_TILES, 90);
    static const double radii[] = {0, 1, 1.7, 1.8, 30, 89.5, 500};
    uint64_t masses[COUNT_OF(radii)], expected[COUNT_OF(radii)] = {0}, boxes[2], full[2] = {0, 0};
    static char marked[2][64][64];
    memset(marked, 0, sizeof marked);
    for (int32_t r = -90; r <= 90; r++) {
        for (int32_t q = -90; q <= 90; q++) {
            if (value_at(grid, SNOW_FIELD_FROZEN, q, r) == 0)
                continue;
            double distance = sqrt((double)(q * q + q * r + r * r));
            for (size_t i = 0; i < COUNT_OF(radii); i++)
                expected[i] += distance <= radii[i];
            marked[0][(r + 96) / 6][(q + 96) / 6] = 1;
            marked[1][(r + 300) / 300][(q + 300) / 300] = 1;
        }
    }
    for (size_t k = 0; k < 2; k++)
        for (size_t i = 0; i < 64 * 64; i++)
            full[k] += (uint64_t)marked[k][i / 64][i % 64];
    assert_ok(snow_mass_radius(grid, radii, COUNT_OF(radii), masses));
    for (size_t i = 0; i < COUNT_OF(radii); i++)
        assert_int_equal(expected[i], masses[i]);
    assert_ok(snow_box_count(grid, 6, &boxes[0]));
    assert_ok(snow_box_count(grid, 300, &boxes[1]));
    assert_int_equal(full[0], boxes[0]);
    assert_int_equal(full[1], boxes[1]);
    assert_ok(snow_box_count(grid, 1, &boxes[0]));
    assert_int_equal(frozen_of(grid), boxes[0]);
    double density;
    assert_ok(snow_density(grid, &density));
    assert_near((double)frozen_of(grid) / (3 * 90 * 91 + 1), density, 1e-15);
    snow_destroy(grid);
}

static void a_plate_has_dimension_2(void **state)
{
    (void)state;
    snow_grid *grid = grown("0110000", SNOW_PACKARD_ENGINE_TILES, 200);
    double dimension;
    assert_ok(snow_dimension(grid, &dimension));
    assert_near(2, dimension, 0.02);
    snow_destroy(grid);

    snow_cell row[201];
    for (int32_t i = 0; i <= 200; i++)
        row[i] = (snow_cell){i - 100, 0};
    snow_packard_params params = packard_scene("0000000");
    params.seeds = row;
    params.seed_count = 201;
    grid = make_packard(&params, NULL);
    assert_ok(snow_dimension(grid, &dimension));
    assert_near(1, dimension, 0.05);
    snow_destroy(grid);
}

static void measures_check_their_arguments(void **state)
{
    (void)state;
    snow_grid *grid = grown("0101010", SNOW_PACKARD_ENGINE_TILES, 20);
    double real, radii[] = {1, 0.5}, wrong = NAN, negative = -1;
    uint64_t masses[2];
    assert_status(SNOW_ERROR_NULL, snow_mass_radius(NULL, radii, 1, masses));
    assert_status(SNOW_ERROR_NULL, snow_mass_radius(grid, NULL, 1, masses));
    assert_status(SNOW_ERROR_NULL, snow_mass_radius(grid, radii, 1, NULL));
    assert_status(SNOW_ERROR_RANGE, snow_mass_radius(grid, radii, 2, masses));
    assert_status(SNOW_ERROR_RANGE, snow_mass_radius(grid, &negative, 1, masses));
    assert_status(SNOW_ERROR_NOT_FINITE, snow_mass_radius(grid, &wrong, 1, masses));
    assert_status(SNOW_ERROR_NULL, snow_dimension(NULL, &real));
    assert_status(SNOW_ERROR_NULL, snow_dimension(grid, NULL));
    assert_status(SNOW_ERROR_RANGE, snow_dimension(grid, &real)); /* too small */
    assert_status(SNOW_ERROR_NULL, snow_box_count(NULL, 1, masses));
    assert_status(SNOW_ERROR_NULL, snow_box_count(grid, 1, NULL));
    assert_status(SNOW_ERROR_RANGE, snow_box_count(grid, 0, masses));
    assert_status(SNOW_ERROR_NULL, snow_density(NULL, &real));
    assert_status(SNOW_ERROR_NULL, snow_density(grid, NULL));
    snow_destroy(grid);
}

static void the_choice_of_engine_is_the_expected_one(void **state)
{
    (void)state;
    static const struct {
        const char *rule;
        int64_t steps;
        int32_t seeds;
        snow_packard_engine engine;
    } scenes[] = {
        {"0100000", 100, 0, SNOW_PACKARD_ENGINE_TILES},
        {"0100000", 4000, 0, SNOW_PACKARD_ENGINE_TILES},
        {"0100000", 100000, 0, SNOW_PACKARD_ENGINE_QUADTREE},
        {"0101010", 4000, 0, SNOW_PACKARD_ENGINE_QUADTREE},
        {"0100000", 100, 3000, SNOW_PACKARD_ENGINE_TILES},
    };
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        snow_packard_params params = packard_scene(scenes[i].rule);
        params.scatter = scenes[i].seeds;
        snow_grid *grid = make_packard(&params, NULL);
        assert_ok(snow_step(grid, scenes[i].steps));
        assert_int_equal(scenes[i].engine, engine_of(grid));
        snow_destroy(grid);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(save_load_continue_is_continue),
        cmocka_unit_test(damaged_snapshots_are_refused),
        cmocka_unit_test(a_crystal_beyond_all_bounds_is_saved),
        cmocka_unit_test(a_crystal_off_the_origin_is_no_dearer),
        cmocka_unit_test(what_is_too_large_is_said),
        cmocka_unit_test(steps_end_at_their_limit),
        cmocka_unit_test(bits_are_the_frozen_cells),
        cmocka_unit_test(no_bits_are_set_far_away),
        cmocka_unit_test(fields_are_read_as_they_should_be),
        cmocka_unit_test(cells_can_be_frozen_and_melted),
        cmocka_unit_test(runs_end_at_the_right_step),
        cmocka_unit_test(sliced_runs_end_at_the_same_step),
        cmocka_unit_test(a_time_budget_ends_a_run),
        cmocka_unit_test(memory_goes_back_and_failures_are_clean),
        cmocka_unit_test(the_memory_limit_holds),
        cmocka_unit_test(measures_agree_with_the_cells),
        cmocka_unit_test(a_plate_has_dimension_2),
        cmocka_unit_test(measures_check_their_arguments),
        cmocka_unit_test(the_choice_of_engine_is_the_expected_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
