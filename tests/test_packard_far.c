/* Crystals that stand very far apart: whatever is asked of them costs what they are, not what lies between them. */
#include "support/packard.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PLACES = 4, REACH = 96, SIDE = 2 * REACH, WORDS = SIDE / 64, STEPS = 30, FAR = (1 << 30) - 400 };

/* Far apart along every axis, and two of them near each other. */
static const snow_cell seeds[] = {
    {0, 0}, {3, 1}, {FAR, -7}, {-200, FAR}, {FAR - 1000, -FAR + 123}, {FAR - 1003, -FAR + 123}};
static const snow_cell places[PLACES] = {{0, 0}, {FAR, -7}, {-200, FAR}, {FAR - 1000, -FAR + 123}};

static snow_packard_params far_scene(snow_packard_engine engine, bool dated)
{
    snow_packard_params params = packard_scene("0100000");
    params.seeds = seeds;
    params.seed_count = COUNT_OF(seeds);
    params.engine = engine;
    params.record_freeze_steps = dated;
    return params;
}

static snow_grid *far_grid(snow_packard_engine engine, bool dated)
{
    snow_packard_params params = far_scene(engine, dated);
    snow_grid *grid = make_packard(&params, NULL);
    assert_ok(snow_step(grid, STEPS));
    return grid;
}

static uint64_t population(const uint64_t *words, size_t count)
{
    uint64_t cells = 0;
    for (size_t i = 0; i < count; i++)
        for (uint64_t left = words[i]; left != 0; left &= left - 1)
            cells++;
    return cells;
}

static void copy_place(const snow_grid *grid, snow_cell place, uint64_t words[SIDE * WORDS])
{
    assert_ok(snow_packard_copy_bits(grid, (int64_t)place.q - REACH, (int64_t)place.r - REACH, SIDE, SIDE, words,
                                     (size_t)SIDE * WORDS));
}

/* The same cells about the places, and no others; the same freeze steps. */
static void assert_same_places(const snow_grid *expected, const snow_grid *got)
{
    uint64_t cells = 0;
    for (size_t i = 0; i < PLACES; i++) {
        uint64_t wanted[SIDE * WORDS], found[SIDE * WORDS];
        copy_place(expected, places[i], wanted);
        copy_place(got, places[i], found);
        assert_memory_equal(wanted, found, sizeof wanted);
        cells += population(found, (size_t)SIDE * WORDS);
        for (int32_t q = -REACH; records_freeze_steps(expected) && q < REACH; q += 3)
            assert_same_double(value_at(expected, SNOW_FIELD_FREEZE_STEP, places[i].q + q, places[i].r + 5),
                               value_at(got, SNOW_FIELD_FREEZE_STEP, places[i].q + q, places[i].r + 5));
    }
    assert_int_equal(cells, frozen_of(got));
    assert_int_equal(frozen_of(expected), frozen_of(got));
    assert_same_double(tip_of(expected), tip_of(got));
}

static const struct {
    snow_packard_engine engine;
    bool dated;
} kinds[] = {
    {SNOW_PACKARD_ENGINE_TILES, false}, {SNOW_PACKARD_ENGINE_TILES, true}, {SNOW_PACKARD_ENGINE_QUADTREE, false}};

static void all_engines_agree(void **state)
{
    (void)state;
    snow_grid *tiles = far_grid(SNOW_PACKARD_ENGINE_TILES, false);
    snow_grid *tree = far_grid(SNOW_PACKARD_ENGINE_QUADTREE, false);
    assert_same_places(tiles, tree);
    assert_same_places(tree, tiles);
    snow_destroy(tiles);
    snow_destroy(tree);
}

static snow_grid *save_and_load(const snow_grid *grid, size_t *size)
{
    snow_grid *loaded = NULL;
    assert_ok(snow_save(grid, NULL, 0, size));
    unsigned char *saved = malloc(*size);
    assert_non_null(saved);
    assert_ok(snow_save(grid, saved, *size, size));
    assert_ok(snow_load(saved, *size, NULL, &loaded));
    for (size_t cut = 0; cut < *size; cut += 97) { /* every part of it is missed */
        snow_grid *none = NULL;
        snow_status status = snow_load(saved, cut, NULL, &none);
        assert_true(status == SNOW_ERROR_TRUNCATED || status == SNOW_ERROR_DAMAGED);
    }
    free(saved);
    return loaded;
}

static void they_are_saved_and_go_on(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(kinds); i++) {
        snow_grid *grid = far_grid(kinds[i].engine, kinds[i].dated);
        size_t size;
        snow_grid *loaded = save_and_load(grid, &size);
        assert_in_range(size, 1, kinds[i].dated ? 400000 : 30000);
        assert_same_places(grid, loaded);
        assert_ok(snow_step(grid, 11));
        assert_ok(snow_step(loaded, 11));
        assert_same_places(grid, loaded);
        snow_destroy(grid);
        snow_destroy(loaded);
    }
}

/* What is saved depends on the crystal alone, not on how the engine came to it. */
static void what_is_saved_is_the_same_again(void **state)
{
    (void)state;
    snow_grid *grid = far_grid(SNOW_PACKARD_ENGINE_TILES, false);
    size_t size, again;
    snow_grid *loaded = save_and_load(grid, &size);
    unsigned char *saved = malloc(size), *resaved = malloc(size);
    assert_ok(snow_save(grid, saved, size, &size));
    assert_ok(snow_save(loaded, resaved, size, &again));
    assert_int_equal(size, again);
    assert_memory_equal(saved, resaved, size);
    free(saved);
    free(resaved);
    snow_destroy(grid);
    snow_destroy(loaded);
}

static void saved_blocks_are_not_trusted(void **state)
{
    (void)state;
    snow_grid *grid = far_grid(SNOW_PACKARD_ENGINE_TILES, false);
    size_t size;
    assert_ok(snow_save(grid, NULL, 0, &size));
    unsigned char *saved = malloc(size), *damaged = malloc(size);
    assert_ok(snow_save(grid, saved, size, &size));
    for (size_t i = 0; i < size; i += 5) {
        memcpy(damaged, saved, size);
        damaged[i] ^= 0x40;
        snow_grid *loaded = NULL;
        assert_int_not_equal(SNOW_OK, snow_load(damaged, size, NULL, &loaded));
        assert_null(loaded);
    }
    free(saved);
    free(damaged);
    snow_destroy(grid);
}

static char *save_pattern(const snow_grid *grid)
{
    size_t size;
    assert_ok(snow_packard_save_rle(grid, NULL, 0, &size));
    char *text = malloc(size + 1);
    assert_non_null(text);
    assert_ok(snow_packard_save_rle(grid, text, size, &size));
    text[size] = '\0';
    return text;
}

static void patterns_hold_the_space_between_as_numbers(void **state)
{
    (void)state;
    for (int engine = SNOW_PACKARD_ENGINE_TILES; engine <= SNOW_PACKARD_ENGINE_QUADTREE; engine++) {
        snow_grid *grid = far_grid((snow_packard_engine)engine, false);
        char *text = save_pattern(grid);
        assert_in_range(strlen(text), 1, 20000);
        snow_grid *loaded = NULL;
        assert_ok(snow_packard_load_rle(text, strlen(text), NULL, NULL, &loaded));
        assert_same_places(grid, loaded);
        free(text);
        snow_destroy(grid);
        snow_destroy(loaded);
    }
}

/* One row more, and the pattern would not be read. */
static void patterns_that_none_could_read_are_not_written(void **state)
{
    (void)state;
    const snow_cell ends[] = {{0, 0}, {(1 << 30) - 9, 0}};
    const snow_cell beyond[] = {{0, 0}, {(1 << 30) - 9, 20}}; /* x = q + r */
    const struct {
        const snow_cell *cells;
        snow_status status;
    } scenes[] = {{ends, SNOW_OK}, {beyond, SNOW_ERROR_TOO_LARGE}};
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        snow_packard_params params = packard_scene("0100000");
        params.seeds = scenes[i].cells;
        params.seed_count = 2;
        snow_grid *grid = make_packard(&params, NULL);
        size_t size;
        assert_status(scenes[i].status, snow_packard_save_rle(grid, NULL, 0, &size));
        snow_destroy(grid);
    }
    /* 5.5·10^12 cells: more than a reader takes. */
    snow_packard_params params = packard_scene("0101010");
    params.engine = SNOW_PACKARD_ENGINE_QUADTREE;
    snow_grid *grid = make_packard(&params, NULL);
    assert_ok(snow_step(grid, 1 << 20));
    size_t size;
    assert_status(SNOW_ERROR_TOO_LARGE, snow_packard_save_rle(grid, NULL, 0, &size));
    snow_destroy(grid);
}

static void a_torus_with_long_sides_is_saved_and_written(void **state)
{
    (void)state;
    const snow_cell corners[] = {{-1000000, -1000000}, {999990, 999990}, {5, -3}};
    snow_packard_params params = packard_scene("0100000");
    params.domain = SNOW_PACKARD_TORUS;
    params.width = params.height = 2000000;
    params.seeds = corners;
    params.seed_count = COUNT_OF(corners);
    snow_grid *grid = make_packard(&params, NULL);
    assert_ok(snow_step(grid, 40));
    size_t size;
    snow_grid *loaded = save_and_load(grid, &size);
    char *text = save_pattern(grid);
    snow_grid *read = NULL;
    assert_ok(snow_packard_load_rle(text, strlen(text), NULL, NULL, &read));
    uint64_t words[128 * 2], others[128 * 2];
    for (size_t i = 0; i < COUNT_OF(corners); i++) {
        assert_ok(snow_packard_copy_bits(grid, corners[i].q - 64, corners[i].r - 64, 128, 128, words, 256));
        assert_ok(snow_packard_copy_bits(loaded, corners[i].q - 64, corners[i].r - 64, 128, 128, others, 256));
        assert_memory_equal(words, others, sizeof words);
        assert_ok(snow_packard_copy_bits(read, corners[i].q - 64, corners[i].r - 64, 128, 128, others, 256));
        assert_memory_equal(words, others, sizeof words);
    }
    assert_int_equal(frozen_of(grid), frozen_of(loaded));
    assert_int_equal(frozen_of(grid), frozen_of(read));
    free(text);
    snow_destroy(grid);
    snow_destroy(loaded);
    snow_destroy(read);
}

/* Cells of a rectangle are set; all others, far and near, stay. */
static void cells_are_set(void **state)
{
    (void)state;
    enum { WIDTH = 1500, HEIGHT = 70 };
    const snow_rect rect = {-41, -20, WIDTH, HEIGHT};
    static double values[WIDTH * HEIGHT];
    uint64_t stream = 7;
    for (size_t i = 0; i < COUNT_OF(values); i++)
        values[i] = next_below(&stream, 3) == 0;
    snow_grid *grids[COUNT_OF(kinds)];
    for (size_t i = 0; i < COUNT_OF(kinds); i++) {
        grids[i] = far_grid(kinds[i].engine, kinds[i].dated);
        assert_ok(snow_field_set(grids[i], SNOW_FIELD_FROZEN, &rect, values, COUNT_OF(values)));
        assert_int_equal(kinds[i].engine, engine_of(grids[i]));
        uint64_t before[SIDE * WORDS], after[SIDE * WORDS];
        snow_grid *untouched = far_grid(kinds[i].engine, kinds[i].dated);
        for (size_t place = 1; place < PLACES; place++) {
            copy_place(untouched, places[place], before);
            copy_place(grids[i], places[place], after);
            assert_memory_equal(before, after, sizeof before);
        }
        snow_destroy(untouched);
        size_t count;
        double *got = copy_field(grids[i], SNOW_FIELD_VALUE, &rect, &count);
        assert_memory_equal(values, got, sizeof values);
        free(got);
        assert_ok(snow_step(grids[i], 5));
        assert_int_equal(frozen_of(grids[0]), frozen_of(grids[i]));
    }
    for (size_t i = 0; i < COUNT_OF(kinds); i++)
        snow_destroy(grids[i]);
}

/* Squared distances from the origin are at most 40², or at least FAR² or so. */
static void they_are_measured_and_drawn(void **state)
{
    (void)state;
    const double radii[] = {200, 0.5 * FAR, 1.5 * FAR, 3.0 * FAR};
    for (size_t i = 0; i < COUNT_OF(kinds); i++) {
        snow_grid *grid = far_grid(kinds[i].engine, kinds[i].dated);
        uint64_t masses[COUNT_OF(radii)];
        assert_ok(snow_mass_radius(grid, radii, COUNT_OF(radii), masses));
        uint64_t words[SIDE * WORDS];
        copy_place(grid, places[0], words);
        assert_int_equal(population(words, (size_t)SIDE * WORDS), masses[0]);
        assert_int_equal(masses[0], masses[1]);
        assert_int_equal(frozen_of(grid), masses[2]);
        assert_int_equal(frozen_of(grid), masses[3]);

        snow_view view;
        snow_view_init(&view, sizeof view);
        assert_status(SNOW_ERROR_RANGE, snow_view_fit(grid, 512, &view));
        view.width = view.height = 90;
        view.pixel = SNOW_PIXEL_GREY;
        view.palette = kinds[i].dated ? SNOW_PALETTE_AGE : SNOW_PALETTE_INK;
        unsigned char pixels[90 * 90];
        size_t size;
        assert_ok(snow_render(grid, &view, pixels, sizeof pixels, &size));
        assert_int_not_equal(pixels[0], pixels[45 * 90 + 45]);
        snow_destroy(grid);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_engines_agree),
        cmocka_unit_test(they_are_saved_and_go_on),
        cmocka_unit_test(what_is_saved_is_the_same_again),
        cmocka_unit_test(saved_blocks_are_not_trusted),
        cmocka_unit_test(patterns_hold_the_space_between_as_numbers),
        cmocka_unit_test(patterns_that_none_could_read_are_not_written),
        cmocka_unit_test(a_torus_with_long_sides_is_saved_and_written),
        cmocka_unit_test(cells_are_set),
        cmocka_unit_test(they_are_measured_and_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
