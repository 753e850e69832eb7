/* Pictures: the frame, the hexagons, the colours. */
#include "support/allocator.h"
#include "support/grids.h"
#include "support/loops.h"

#include <fenv.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ROW_DISTANCE 0.86602540378443864676

static const snow_palette palettes[] = {SNOW_PALETTE_PAPER, SNOW_PALETTE_FROST, SNOW_PALETTE_INK, SNOW_PALETTE_AGE,
                                         SNOW_PALETTE_PHASE};
static const snow_pixel layouts[] = {SNOW_PIXEL_GREY, SNOW_PIXEL_RGB, SNOW_PIXEL_RGBA};
static const size_t layout_bytes[] = {1, 3, 4};

static snow_view default_view(void)
{
    snow_view view;
    snow_view_init(&view, sizeof view);
    return view;
}

static snow_view small_view(snow_palette palette, snow_pixel pixel)
{
    snow_view view = default_view();
    view.width = 21;
    view.height = 17;
    view.palette = palette;
    view.pixel = pixel;
    return view;
}

/* The picture, in memory for free(); nothing is written behind it. */
static unsigned char *draw(const snow_grid *grid, const snow_view *view, size_t *size)
{
    size_t wanted = 0;
    assert_ok(snow_render(grid, view, NULL, 0, &wanted));
    unsigned char *pixels = malloc(wanted + 8);
    assert_non_null(pixels);
    memset(pixels, 0xa5, wanted + 8);
    size_t got = 0;
    assert_ok(snow_render(grid, view, pixels, wanted, &got));
    assert_int_equal(wanted, got);
    for (size_t i = 0; i < 8; i++)
        assert_int_equal(0xa5, pixels[wanted + i]);
    if (size != NULL)
        *size = wanted;
    return pixels;
}

/* The colour of one point of the plane; alpha is 0 where it is not ice. */
static void look_at(const snow_grid *grid, snow_palette palette, double x, double y, unsigned char colour[4])
{
    snow_view view = default_view();
    view.width = view.height = view.samples = view.transparent = 1;
    view.scale = 1024;
    view.centre_x = x;
    view.centre_y = y;
    view.palette = palette;
    view.pixel = SNOW_PIXEL_RGBA;
    assert_ok(snow_render(grid, &view, colour, 4, NULL));
}

static bool is_ice_at(const snow_grid *grid, double x, double y)
{
    unsigned char colour[4];
    look_at(grid, SNOW_PALETTE_PAPER, x, y, colour);
    assert_true(colour[3] == 0 || colour[3] == 255);
    return colour[3] == 255;
}

static unsigned char grey_of(const snow_grid *grid, snow_palette palette, snow_cell cell)
{
    unsigned char grey = 0;
    snow_view view = default_view();
    view.width = view.height = view.samples = 1;
    view.centre_x = cell.q + 0.5 * cell.r;
    view.centre_y = cell.r * ROW_DISTANCE;
    view.palette = palette;
    view.pixel = SNOW_PIXEL_GREY;
    assert_ok(snow_render(grid, &view, &grey, 1, NULL));
    return grey;
}

/* The paper's mapping, read plainly: the nearest of 256 greys. */
static int paper_grey(double value, double greatest)
{
    if (value < 1)
        return (int)floor(127.5 * value + 0.5);
    return (int)floor(255.5 - (greatest > 1 ? 127.5 * (value - 1) / (greatest - 1) : 0));
}

static double greatest_value(const snow_grid *grid)
{
    size_t count;
    double greatest = 0;
    double *values = copy_field(grid, SNOW_FIELD_VALUE, NULL, &count);
    for (size_t i = 0; i < count; i++)
        greatest = fmax(greatest, values[i]);
    free(values);
    return greatest;
}

static snow_grid *grown_crystal(int32_t radius, int64_t steps, const snow_options *options)
{
    snow_reiter_params params = disc_scene(0.4, 0.003, 1, radius);
    params.record_freeze_steps = 1;
    snow_grid *grid = make_grid(&params, options);
    assert_ok(snow_step(grid, steps));
    assert_true(frozen_of(grid) > 60);
    return grid;
}

/* One cell of ice on a background of so much vapour. */
static snow_grid *lone_cell(double background)
{
    snow_reiter_params params = disc_scene(background, 0.001, 1, 8);
    return make_grid(&params, NULL);
}

static void defaults_are_the_documented_ones(void **state)
{
    (void)state;
    snow_view view;
    memset(&view, 0xff, sizeof view);
    snow_view_init(&view, sizeof view);
    snow_view_init(NULL, sizeof view);
    assert_int_equal(sizeof view, view.struct_size);
    assert_int_equal(512, view.width);
    assert_int_equal(512, view.height);
    assert_same_double(1.0, view.scale);
    assert_same_double(0.0, view.centre_x);
    assert_same_double(0.0, view.centre_y);
    assert_int_equal(SNOW_PALETTE_PAPER, view.palette);
    assert_int_equal(SNOW_PIXEL_RGB, view.pixel);
    assert_int_equal(2, view.samples);
    assert_int_equal(0, view.transparent);
}

static void the_size_is_told_first(void **state)
{
    (void)state;
    snow_grid *grid = grown_crystal(20, 100, NULL);
    for (size_t i = 0; i < COUNT_OF(layouts); i++) {
        snow_view view = small_view(SNOW_PALETTE_FROST, layouts[i]);
        size_t size = 0;
        assert_ok(snow_render(grid, &view, NULL, 0, &size));
        assert_int_equal(21 * 17 * layout_bytes[i], size);

        unsigned char pixels[21 * 17 * 4];
        memset(pixels, 0x5a, sizeof pixels);
        size_t needed = 0;
        assert_status(SNOW_ERROR_BUFFER, snow_render(grid, &view, pixels, size - 1, &needed));
        assert_int_equal(size, needed);
        for (size_t byte = 0; byte < sizeof pixels; byte++)
            assert_int_equal(0x5a, pixels[byte]);
        assert_ok(snow_render(grid, &view, pixels, size, NULL));
    }
    snow_view huge = default_view();
    huge.width = huge.height = 65535;
    huge.pixel = SNOW_PIXEL_RGBA;
    if (SIZE_MAX > UINT32_MAX) {
        size_t size = 0;
        assert_ok(snow_render(grid, &huge, NULL, 0, &size));
        assert_true((uint64_t)size == UINT64_C(65535) * 65535 * 4);
    }
    snow_destroy(grid);
}

static void null_pointers_are_refused(void **state)
{
    (void)state;
    snow_grid *grid = lone_cell(0.4);
    snow_view view = default_view();
    unsigned char pixel[4];
    size_t size = 77;
    assert_status(SNOW_ERROR_NULL, snow_render(NULL, &view, pixel, 4, &size));
    assert_status(SNOW_ERROR_NULL, snow_render(grid, NULL, pixel, 4, &size));
    assert_status(SNOW_ERROR_NULL, snow_render(grid, &view, NULL, 0, NULL));
    assert_status(SNOW_ERROR_NULL, snow_view_fit(NULL, 0, &view));
    assert_status(SNOW_ERROR_NULL, snow_view_fit(grid, 0, NULL));
    assert_int_equal(77, size);
    snow_destroy(grid);
}

/* Nothing is drawn and no size is told. */
static void assert_refused(snow_status expected, const snow_grid *grid, const snow_view *view)
{
    unsigned char pixel = 0x5a;
    size_t size = 77;
    assert_status(expected, snow_render(grid, view, &pixel, 1, &size));
    assert_status(expected, snow_render(grid, view, NULL, 0, &size));
    assert_int_equal(77, size);
    assert_int_equal(0x5a, pixel);
}

static void bad_numbers_are_refused(void **state)
{
    (void)state;
    static const int32_t bad_sides[] = {0, -1, 65536, INT32_MAX, INT32_MIN};
    static const int32_t bad_samples[] = {0, -1, 9, INT32_MAX, INT32_MIN};
    static const int32_t bad_flags[] = {-1, 2, INT32_MAX, INT32_MIN};
    static const double bad_scales[] = {0, -1, 1.0 / 1025, 1025, 1e300, -1e300};
    static const double infinities[] = {INFINITY, -INFINITY, NAN};
    snow_grid *grid = lone_cell(0.4);
    for (size_t i = 0; i < COUNT_OF(bad_sides); i++) {
        snow_view view = default_view();
        view.width = bad_sides[i];
        assert_refused(SNOW_ERROR_RANGE, grid, &view);
        view = default_view();
        view.height = bad_sides[i];
        assert_refused(SNOW_ERROR_RANGE, grid, &view);
        view = default_view();
        view.samples = bad_samples[i];
        assert_refused(SNOW_ERROR_RANGE, grid, &view);
    }
    for (size_t i = 0; i < COUNT_OF(bad_flags); i++) {
        snow_view view = default_view();
        view.transparent = bad_flags[i];
        assert_refused(SNOW_ERROR_RANGE, grid, &view);
    }
    for (size_t i = 0; i < COUNT_OF(bad_scales); i++) {
        snow_view view = default_view();
        view.scale = bad_scales[i];
        assert_refused(SNOW_ERROR_RANGE, grid, &view);
    }
    for (size_t i = 0; i < COUNT_OF(infinities); i++) {
        snow_view view = default_view();
        view.scale = infinities[i];
        assert_refused(SNOW_ERROR_NOT_FINITE, grid, &view);
        view = default_view();
        view.centre_x = infinities[i];
        assert_refused(SNOW_ERROR_NOT_FINITE, grid, &view);
        view = default_view();
        view.centre_y = infinities[i];
        assert_refused(SNOW_ERROR_NOT_FINITE, grid, &view);
    }
    snow_destroy(grid);
}

static void unknown_palettes_and_layouts_are_refused(void **state)
{
    (void)state;
    static const int unknown[] = {0, -1, 6, INT_MAX, INT_MIN};
    snow_grid *grid = lone_cell(0.4);
    for (size_t i = 0; i < COUNT_OF(unknown); i++) {
        snow_view view = default_view();
        view.palette = (snow_palette)unknown[i];
        assert_refused(SNOW_ERROR_ENUM, grid, &view);
        view = default_view();
        view.pixel = (snow_pixel)unknown[i];
        assert_refused(SNOW_ERROR_ENUM, grid, &view);
    }
    snow_destroy(grid);
}

static void views_that_were_not_initialised_are_refused(void **state)
{
    (void)state;
    snow_grid *grid = lone_cell(0.4);
    snow_view view;
    memset(&view, 0, sizeof view);
    assert_refused(SNOW_ERROR_STRUCT_SIZE, grid, &view);
    assert_status(SNOW_ERROR_STRUCT_SIZE, snow_view_fit(grid, 0, &view));
    memset(&view, 0xa5, sizeof view);
    assert_refused(SNOW_ERROR_STRUCT_SIZE, grid, &view);
    view = default_view();
    view.struct_size--;
    assert_refused(SNOW_ERROR_STRUCT_SIZE, grid, &view);
    assert_status(SNOW_ERROR_STRUCT_SIZE, snow_view_fit(grid, 0, &view));
    snow_destroy(grid);
}

static void newer_views_are_accepted_while_their_tail_is_zero(void **state)
{
    (void)state;
    struct {
        snow_view view;
        double more;
    } newer;
    snow_grid *grid = lone_cell(0.4);
    memset(&newer, 0xff, sizeof newer);
    snow_view_init(&newer.view, sizeof newer);
    assert_int_equal(sizeof newer, newer.view.struct_size);
    assert_same_double(0.0, newer.more);
    size_t size;
    assert_ok(snow_view_fit(grid, 100, &newer.view));
    assert_ok(snow_render(grid, &newer.view, NULL, 0, &size));
    assert_int_equal(sizeof newer, newer.view.struct_size);
    newer.more = 1;
    assert_refused(SNOW_ERROR_STRUCT_TAIL, grid, &newer.view);
    assert_status(SNOW_ERROR_STRUCT_TAIL, snow_view_fit(grid, 100, &newer.view));
    snow_destroy(grid);
}

static void age_needs_recorded_freeze_steps(void **state)
{
    (void)state;
    snow_grid *grid = lone_cell(0.4);
    snow_view view = small_view(SNOW_PALETTE_AGE, SNOW_PIXEL_RGB);
    assert_refused(SNOW_ERROR_NOT_RECORDED, grid, &view);
    view.palette = SNOW_PALETTE_PHASE;
    assert_refused(SNOW_ERROR_NOT_RECORDED, grid, &view);
    snow_destroy(grid);
    grid = grown_crystal(20, 100, NULL);
    free(draw(grid, &view, NULL));
    snow_destroy(grid);
}

/* Half a cell is left on each side, and no more. */
static void assert_frames(const snow_grid *grid, const snow_view *view)
{
    double left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY;
    snow_rect bounds = bounds_of(grid);
    for (int32_t r = bounds.r; r < bounds.r + bounds.height; r++)
        for (int32_t q = bounds.q; q < bounds.q + bounds.width; q++)
            if (value_at(grid, SNOW_FIELD_INSIDE, q, r) != 0) {
                left = fmin(left, q + 0.5 * r - 0.5);
                right = fmax(right, q + 0.5 * r + 0.5);
                top = fmin(top, r * ROW_DISTANCE - 2 * ROW_DISTANCE / 3);
                bottom = fmax(bottom, r * ROW_DISTANCE + 2 * ROW_DISTANCE / 3);
            }
    assert_near(0.5 * (left + right), view->centre_x, 1e-12);
    assert_near(0.5 * (top + bottom), view->centre_y, 1e-12);
    double width = (right - left) * view->scale;
    double height = (bottom - top) * view->scale;
    assert_true(view->width > width - 1e-5 && view->width < width + 1);
    assert_true(view->height > height - 1e-5 && view->height < height + 1);
}

static void fit_frames_the_interior(void **state)
{
    (void)state;
    static const int32_t sides[] = {0, 1, 17, 100, 512, 1001};
    snow_reiter_params scenes[] = {disc_scene(0.4, 0, 1, 20), hexagon_scene(0.4, 0, 1, 15),
                                   rectangle_scene(0.4, 0, 1, 31, 10), rectangle_scene(0.4, 0, 1, 6, 45),
                                   rectangle_scene(0.4, 0, 1, 1, 1), disc_scene(0.4, 0, 1, 1)};
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        snow_grid *grid = make_grid(&scenes[i], NULL);
        for (size_t j = 0; j < COUNT_OF(sides); j++) {
            snow_view view = default_view();
            view.palette = SNOW_PALETTE_INK;
            view.samples = 5;
            assert_ok(snow_view_fit(grid, sides[j], &view));
            assert_frames(grid, &view);
            if (sides[j] == 0)
                assert_same_double(1.0, view.scale);
            else
                assert_int_equal(sides[j], view.width > view.height ? view.width : view.height);
            assert_int_equal(SNOW_PALETTE_INK, view.palette);
            assert_int_equal(5, view.samples);
        }
        snow_destroy(grid);
    }
}

static void assert_does_not_fit(const snow_grid *grid, int32_t side)
{
    snow_view view = small_view(SNOW_PALETTE_INK, SNOW_PIXEL_GREY);
    snow_view before = view;
    assert_status(SNOW_ERROR_RANGE, snow_view_fit(grid, side, &view));
    assert_memory_equal(&before, &view, sizeof view);
}

static void sides_out_of_range_are_refused(void **state)
{
    (void)state;
    snow_grid *grid = lone_cell(0.4);
    assert_does_not_fit(grid, -1);
    assert_does_not_fit(grid, 65536);
    assert_does_not_fit(grid, INT32_MAX);
    assert_does_not_fit(grid, INT32_MIN);
    assert_does_not_fit(grid, 65535); /* More than 1024 pixels for a lattice spacing. */
    snow_destroy(grid);

    snow_reiter_params params = rectangle_scene(0.4, 0, 1, 65536, 2);
    grid = make_grid(&params, NULL);
    assert_does_not_fit(grid, 0);
    assert_does_not_fit(grid, 1); /* Less than 2^-10 pixels for a lattice spacing. */
    snow_view view = default_view();
    assert_ok(snow_view_fit(grid, 65535, &view));
    assert_int_equal(65535, view.width);
    snow_destroy(grid);
}

static void greys_are_those_of_the_paper(void **state)
{
    (void)state;
    static const struct {
        snow_cell cell;
        double value;
        int grey;
    } cells[] = {
        {{0, 0}, 1.0, 255},    {{5, 0}, 3.0, 128},      {{-5, 0}, 2.0, 191},       {{0, 3}, 1.25, 239},
        {{0, -4}, 0.0, 0},     {{3, 3}, 0.1, 13},       {{-3, -3}, 0.5, 64},       {{3, -5}, 0.9, 115},
        {{-3, 5}, 0.999, 127}, {{-3, 0}, 0.999999, 127}, {{0, 6}, 1 - 1.0 / 1099511627776.0, 255},
    };
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 8);
    without_seeds(&params);
    snow_grid *grid = make_grid(&params, NULL);
    for (size_t i = 0; i < COUNT_OF(cells); i++)
        set_cell(grid, SNOW_FIELD_VALUE, cells[i].cell.q, cells[i].cell.r, cells[i].value);
    for (size_t i = 0; i < COUNT_OF(cells); i++)
        assert_int_equal(cells[i].grey, grey_of(grid, SNOW_PALETTE_PAPER, cells[i].cell));
    assert_int_equal(51, grey_of(grid, SNOW_PALETTE_PAPER, (snow_cell){7, 0}));
    assert_int_equal(51, grey_of(grid, SNOW_PALETTE_PAPER, (snow_cell){8, 0}));
    assert_int_equal(51, grey_of(grid, SNOW_PALETTE_PAPER, (snow_cell){-1000000, 1000000}));
    snow_destroy(grid);
}

static void vapour_below_zero_is_black(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0, 0.001, 2.6, 10);
    snow_grid *grid = make_grid(&params, NULL);
    set_cell(grid, SNOW_FIELD_VALUE, 4, 1, 0.9);
    assert_ok(snow_step(grid, 1));
    assert_true(value_at(grid, SNOW_FIELD_VALUE, 4, 1) < -0.2);
    assert_int_equal(0, grey_of(grid, SNOW_PALETTE_PAPER, (snow_cell){4, 1}));
    snow_destroy(grid);
}

static void assert_colour(const snow_grid *grid, snow_palette palette, int32_t q, const unsigned char expected[4])
{
    unsigned char colour[4];
    look_at(grid, palette, q, 0, colour);
    assert_memory_equal(expected, colour, 4);
}

/* Cells of an arm whose freeze steps differ by a multiple of 16 look alike; half a period on they do not. */
static void look_at_phases(const snow_grid *grid)
{
    unsigned char colours[16][4];
    bool seen[16] = {false};
    int alike = 0;
    for (int32_t q = 0; value_at(grid, SNOW_FIELD_FROZEN, q, 0) != 0; q++) {
        int phase = (int)value_at(grid, SNOW_FIELD_FREEZE_STEP, q, 0) % 16;
        unsigned char colour[4];
        look_at(grid, SNOW_PALETTE_PHASE, q, 0, colour);
        if (seen[phase]) {
            assert_memory_equal(colours[phase], colour, 3);
            alike++;
        }
        memcpy(colours[phase], colour, sizeof colour);
        seen[phase] = true;
    }
    assert_true(alike > 0);
    for (int phase = 0; phase < 8; phase++)
        if (seen[phase] && seen[phase + 8])
            assert_memory_not_equal(colours[phase], colours[phase + 8], 3);
}

static void palettes_begin_and_end_as_documented(void **state)
{
    (void)state;
    static const unsigned char white[4] = {255, 255, 255, 255};
    snow_grid *grid = lone_cell(0.4);
    assert_colour(grid, SNOW_PALETTE_FROST, 0, white);
    snow_view view = small_view(SNOW_PALETTE_INK, SNOW_PIXEL_RGB);
    unsigned char *pixels = draw(grid, &view, NULL);
    assert_memory_equal(white, pixels, 3);
    free(pixels);
    snow_destroy(grid);

    grid = grown_crystal(20, 100, NULL);
    unsigned char first[4], last[4], old[4];
    look_at(grid, SNOW_PALETTE_AGE, 0, 0, first);
    assert_true(first[2] > first[0] && first[0] > first[1] && first[2] < 160);
    double step = 0;
    for (int32_t q = 0; value_at(grid, SNOW_FIELD_FROZEN, q, 0) != 0; q++) {
        assert_true(value_at(grid, SNOW_FIELD_FREEZE_STEP, q, 0) >= step);
        step = value_at(grid, SNOW_FIELD_FREEZE_STEP, q, 0);
        look_at(grid, SNOW_PALETTE_AGE, q, 0, last);
    }
    assert_true(last[0] > 200 && last[1] > 100);
    look_at(grid, SNOW_PALETTE_FROST, 0, 0, old);
    assert_true(old[2] > old[1] && old[1] > old[0]);
    look_at_phases(grid);
    look_at(grid, SNOW_PALETTE_INK, 0, 0, old);
    assert_true(old[2] > old[1] && old[1] > old[0] && old[2] < 100);
    snow_destroy(grid);
}

/* Along a row of cells of rising value: how the luminance of vapour and of ice goes. */
static void brightness_follows_the_value(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 50);
    without_seeds(&params);
    snow_grid *grid = make_grid(&params, NULL);
    for (int32_t q = -40; q <= 40; q++)
        set_cell(grid, SNOW_FIELD_VALUE, q, 0, 1 + q / 40.5);
    for (int32_t q = -40; q < 40; q++) {
        int paper = grey_of(grid, SNOW_PALETTE_PAPER, (snow_cell){q + 1, 0}) -
                    grey_of(grid, SNOW_PALETTE_PAPER, (snow_cell){q, 0});
        int frost = grey_of(grid, SNOW_PALETTE_FROST, (snow_cell){q + 1, 0}) -
                    grey_of(grid, SNOW_PALETTE_FROST, (snow_cell){q, 0});
        int ink = grey_of(grid, SNOW_PALETTE_INK, (snow_cell){q + 1, 0}) -
                  grey_of(grid, SNOW_PALETTE_INK, (snow_cell){q, 0});
        if (q == -1) {
            assert_true(paper > 100 && frost > 100 && ink < -100);
            continue;
        }
        assert_true(q < 0 ? paper > 0 && frost > 0 && ink == 0 : paper < 0 && frost < 0 && ink < 0);
    }
    /* All ice stands out from all vapour. */
    assert_true(grey_of(grid, SNOW_PALETTE_FROST, (snow_cell){40, 0}) >
                grey_of(grid, SNOW_PALETTE_FROST, (snow_cell){-1, 0}) + 30);
    snow_destroy(grid);
}

static void samples_fall_on_the_nearest_cell(void **state)
{
    (void)state;
    snow_grid *grid = grown_crystal(30, 250, NULL);
    double greatest = greatest_value(grid);
    uint64_t random = 7;
    for (int turn = 0; turn < 60; turn++) {
        snow_view view = small_view(SNOW_PALETTE_PAPER, SNOW_PIXEL_GREY);
        view.samples = 1;
        view.scale = exp2(next_below(&random, 11000) / 1000.0 - 5.0);
        view.centre_x = next_below(&random, 80000) / 1000.0 - 40.0;
        view.centre_y = next_below(&random, 80000) / 1000.0 - 40.0;
        unsigned char *pixels = draw(grid, &view, NULL);
        for (int32_t i = 0; i < view.width * view.height; i++) {
            double x = view.centre_x + (i % view.width + 0.5 - 0.5 * view.width) / view.scale;
            double y = view.centre_y + (i / view.width + 0.5 - 0.5 * view.height) / view.scale;
            double nearest = INFINITY, second = INFINITY;
            snow_cell cell = {0, 0};
            for (int32_t r = (int32_t)floor(y / ROW_DISTANCE) - 1, rows = 4; rows > 0; rows--, r++)
                for (int32_t q = (int32_t)floor(x - 0.5 * r) - 1, cells = 4; cells > 0; cells--, q++) {
                    double distance = hypot(x - q - 0.5 * r, y - r * ROW_DISTANCE);
                    if (distance < nearest) {
                        second = nearest;
                        nearest = distance;
                        cell = (snow_cell){q, r};
                    } else if (distance < second) {
                        second = distance;
                    }
                }
            if (second - nearest > 1e-9)
                assert_int_equal(paper_grey(value_at(grid, SNOW_FIELD_VALUE, cell.q, cell.r), greatest), pixels[i]);
        }
        free(pixels);
    }
    snow_destroy(grid);
}

static void cells_are_regular_hexagons(void **state)
{
    (void)state;
    static const snow_cell centres[] = {{0, 0}, {3, 0}, {-2, 3}, {1, -4}, {-3, -1}};
    const double degree = acos(-1.0) / 180;
    for (size_t i = 0; i < COUNT_OF(centres); i++) {
        snow_reiter_params params = disc_scene(0.2, 0.001, 1, 10);
        params.seeds = &centres[i];
        params.seed_count = 1;
        snow_grid *grid = make_grid(&params, NULL);
        double x = centres[i].q + 0.5 * centres[i].r;
        double y = centres[i].r * ROW_DISTANCE;
        for (int side = 0; side < 6; side++) {
            double to_side = 60 * side * degree, to_corner = (60 * side + 30) * degree;
            double apothem = 0.5, corner = 1 / sqrt(3.0);
            assert_true(is_ice_at(grid, x + 0.999 * apothem * cos(to_side), y + 0.999 * apothem * sin(to_side)));
            assert_false(is_ice_at(grid, x + 1.001 * apothem * cos(to_side), y + 1.001 * apothem * sin(to_side)));
            assert_true(is_ice_at(grid, x + 0.999 * corner * cos(to_corner), y + 0.999 * corner * sin(to_corner)));
            assert_false(is_ice_at(grid, x + 1.001 * corner * cos(to_corner), y + 1.001 * corner * sin(to_corner)));
        }
        snow_destroy(grid);
    }
}

static void a_hexagon_covers_its_pixels(void **state)
{
    (void)state;
    snow_grid *grid = lone_cell(0.4);
    snow_view view = default_view();
    view.width = view.height = 24;
    view.scale = 16;
    view.samples = 8;
    view.pixel = SNOW_PIXEL_RGBA;
    view.transparent = 1;
    unsigned char *pixels = draw(grid, &view, NULL);
    double area = 0;
    for (int32_t i = 0; i < view.width * view.height; i++) {
        const unsigned char *pixel = pixels + 4 * i;
        int32_t x = i % view.width, y = i / view.width;
        area += pixel[3] / 255.0;
        /* 16 wide and 18.5 high, the corners at the top and at the bottom. */
        if (x < 4 || x >= 20 || y < 2 || y >= 22)
            assert_int_equal(0, pixel[3]);
        if (x >= 4 && x < 20 && y >= 8 && y < 16)
            assert_int_equal(255, pixel[3]);
        assert_int_equal(pixel[3] > 0 ? 255 : 0, pixel[0]);
    }
    assert_true(pixels[4 * (2 * 24 + 12) + 3] > 0 && pixels[4 * (2 * 24 + 12) + 3] < 255);
    assert_near(16 * 16 * ROW_DISTANCE, area, 1.0);
    free(pixels);
    snow_destroy(grid);
}

static double decode(unsigned char byte)
{
    double srgb = byte / 255.0;
    return srgb <= 0.04045 ? srgb / 12.92 : pow((srgb + 0.055) / 1.055, 2.4);
}

static double encode(double light)
{
    return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055);
}

static void samples_are_averaged_as_light(void **state)
{
    (void)state;
    snow_grid *grid = grown_crystal(30, 250, NULL);
    for (int32_t samples = 2; samples <= 8; samples++) {
        snow_view view = small_view(SNOW_PALETTE_PAPER, SNOW_PIXEL_GREY);
        view.centre_x = 3.3;
        view.scale = 0.7;
        view.samples = samples;
        unsigned char *pixels = draw(grid, &view, NULL);
        snow_view fine = view;
        fine.width *= samples;
        fine.height *= samples;
        fine.scale *= samples;
        fine.samples = 1;
        unsigned char *points = draw(grid, &fine, NULL);
        for (int32_t i = 0; i < view.width * view.height; i++) {
            double light = 0;
            for (int32_t j = 0; j < samples * samples; j++) {
                int32_t x = i % view.width * samples + j % samples, y = i / view.width * samples + j / samples;
                light += decode(points[y * fine.width + x]);
            }
            /* To the nearest byte; light itself is rounded to 16 bits, a twentieth of the darkest byte. */
            assert_near(encode(light / (samples * samples)), pixels[i], 0.56);
        }
        free(points);
        free(pixels);
    }
    snow_destroy(grid);

    /* White beside black: half the light is the byte 188. */
    grid = lone_cell(0);
    snow_view edge = default_view();
    edge.width = edge.height = 1;
    edge.scale = 16;
    edge.centre_x = 0.5;
    edge.pixel = SNOW_PIXEL_GREY;
    unsigned char grey;
    assert_ok(snow_render(grid, &edge, &grey, 1, NULL));
    assert_int_equal(188, grey);
    snow_destroy(grid);
}

static void assert_mirrored(const unsigned char *pixels, int32_t width, int32_t height, size_t bytes)
{
    for (int32_t y = 0; y < height; y++)
        for (int32_t x = 0; x < width; x++) {
            const unsigned char *pixel = pixels + (size_t)(y * width + x) * bytes;
            assert_memory_equal(pixel, pixels + (size_t)(y * width + width - 1 - x) * bytes, bytes);
            assert_memory_equal(pixel, pixels + (size_t)((height - 1 - y) * width + x) * bytes, bytes);
        }
}

static void pictures_of_symmetric_crystals_are_symmetric(void **state)
{
    (void)state;
    static const double scales[] = {1.0 / 16, 0.3, 0.5, 1, 2, 2.7, 5, 16};
    snow_grid *grid = grown_crystal(40, 400, NULL);
    for (size_t i = 0; i < COUNT_OF(scales); i++)
        for (int32_t samples = 1; samples <= 4; samples++)
            for (int32_t odd = 0; odd < 2; odd++) {
                snow_view view = small_view(palettes[(i + (size_t)samples) % 4], SNOW_PIXEL_RGB);
                view.width = 60 + odd;
                view.height = 51 + odd;
                view.scale = scales[i];
                view.samples = samples;
                unsigned char *pixels = draw(grid, &view, NULL);
                assert_mirrored(pixels, view.width, view.height, 3);
                free(pixels);
            }
    for (size_t i = 0; i < COUNT_OF(palettes); i++) {
        snow_view view = small_view(palettes[i], SNOW_PIXEL_RGBA);
        view.transparent = 1;
        assert_ok(snow_view_fit(grid, 777, &view));
        unsigned char *pixels = draw(grid, &view, NULL);
        assert_mirrored(pixels, view.width, view.height, 4);
        free(pixels);
    }
    snow_destroy(grid);
}

static void whatever_is_not_ice_is_transparent(void **state)
{
    (void)state;
    snow_grid *grid = grown_crystal(30, 250, NULL);
    for (size_t i = 0; i < COUNT_OF(palettes); i++) {
        snow_view view = small_view(palettes[i], SNOW_PIXEL_RGBA);
        view.samples = 1;
        view.scale = 0.5;
        view.transparent = 1;
        unsigned char *cut = draw(grid, &view, NULL);
        view.transparent = 0;
        unsigned char *full = draw(grid, &view, NULL);
        view.pixel = SNOW_PIXEL_RGB;
        unsigned char *plain = draw(grid, &view, NULL);
        view.transparent = 1;
        unsigned char *ignored = draw(grid, &view, NULL);
        size_t clear = 0, covered = 0;
        for (int32_t j = 0; j < view.width * view.height; j++) {
            static const unsigned char nothing[4] = {0, 0, 0, 0};
            assert_int_equal(255, full[4 * j + 3]);
            assert_memory_equal(plain + 3 * j, full + 4 * j, 3);
            if (cut[4 * j + 3] != 0)
                assert_memory_equal(full + 4 * j, cut + 4 * j, 4);
            else
                assert_memory_equal(nothing, cut + 4 * j, 4);
            *(cut[4 * j + 3] != 0 ? &covered : &clear) += 1;
        }
        assert_true(clear > 0 && covered > 0);
        assert_memory_equal(plain, ignored, (size_t)(3 * view.width * view.height));
        free(cut);
        free(full);
        free(plain);
        free(ignored);
    }
    snow_destroy(grid);
}

static void grey_is_luminance(void **state)
{
    (void)state;
    snow_grid *grid = grown_crystal(30, 250, NULL);
    for (size_t i = 0; i < COUNT_OF(palettes); i++) {
        snow_view view = small_view(palettes[i], SNOW_PIXEL_RGB);
        unsigned char *colours = draw(grid, &view, NULL);
        view.pixel = SNOW_PIXEL_GREY;
        unsigned char *greys = draw(grid, &view, NULL);
        for (int32_t j = 0; j < view.width * view.height; j++) {
            const unsigned char *colour = colours + 3 * j;
            double light = 0.2126 * decode(colour[0]) + 0.7152 * decode(colour[1]) + 0.0722 * decode(colour[2]);
            assert_near(encode(light), greys[j], 1.5);
            if (palettes[i] == SNOW_PALETTE_PAPER)
                assert_true(colour[0] == greys[j] && colour[1] == greys[j] && colour[2] == greys[j]);
        }
        free(colours);
        free(greys);
    }
    snow_destroy(grid);
}

/* Blocks of columns, and cells read one by one where samples stand far apart, leave no seams. */
static void large_pictures_agree_with_their_parts(void **state)
{
    (void)state;
    static const double scales[] = {1.0 / 64, 1.0 / 16, 1.0 / 8, 0.9, 1.5, 8};
    snow_grid *grid = grown_crystal(60, 300, NULL);
    for (size_t i = 0; i < COUNT_OF(scales); i++) {
        snow_view view = small_view(SNOW_PALETTE_PAPER, SNOW_PIXEL_GREY);
        view.width = 1301;
        view.height = 3;
        view.scale = scales[i];
        view.samples = 3;
        unsigned char *pixels = draw(grid, &view, NULL);
        for (int32_t x = 0; x < view.width; x += 7) {
            snow_view part = view;
            part.width = 1;
            part.centre_x = (x - view.width / 2) / view.scale;
            unsigned char column[3];
            assert_ok(snow_render(grid, &part, column, 3, NULL));
            for (int32_t y = 0; y < 3; y++)
                assert_int_equal(column[y], pixels[y * view.width + x]);
        }
        free(pixels);
    }
    snow_destroy(grid);
}

static void the_medium_is_drawn_however_far_away(void **state)
{
    (void)state;
    static const double places[] = {1e3, 1e9, 3e9, 1e15, 1e300, -1e9, -1e300};
    static const double scales[] = {1.0 / 1024, 0.2, 1, 1024};
    snow_grid *grid = grown_crystal(20, 100, NULL);
    for (size_t i = 0; i < COUNT_OF(places); i++)
        for (size_t j = 0; j < COUNT_OF(scales); j++) {
            snow_view view = small_view(SNOW_PALETTE_PAPER, SNOW_PIXEL_GREY);
            view.width = 700;
            view.scale = scales[j];
            view.centre_x = places[i];
            view.centre_y = places[(i + j) % COUNT_OF(places)];
            size_t size;
            unsigned char *pixels = draw(grid, &view, &size);
            if (fabs(view.centre_x) > 1e6 || fabs(view.centre_y) > 1e6)
                for (size_t byte = 0; byte < size; byte++)
                    assert_int_equal(51, pixels[byte]);
            free(pixels);
        }
    snow_destroy(grid);
}

static void a_grid_without_ice_can_be_drawn(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 10);
    without_seeds(&params);
    params.record_freeze_steps = 1;
    snow_grid *grid = make_grid(&params, NULL);
    for (size_t i = 0; i < COUNT_OF(palettes); i++) {
        snow_view view = small_view(palettes[i], SNOW_PIXEL_RGB);
        size_t size;
        unsigned char *pixels = draw(grid, &view, &size);
        for (size_t byte = 3; byte < size; byte++)
            assert_int_equal(pixels[byte - 3], pixels[byte]);
        free(pixels);
    }
    snow_destroy(grid);
}

static void threads_and_instruction_sets_change_no_pixel(void **state)
{
    (void)state;
    snow_grid *grid = grown_crystal(40, 300, NULL);
    snow_view view = small_view(SNOW_PALETTE_FROST, SNOW_PIXEL_RGBA);
    assert_ok(snow_view_fit(grid, 200, &view));
    size_t size;
    unsigned char *expected = draw(grid, &view, &size);
    snow_destroy(grid);
    snow_isa isas[8];
    size_t count = available_isas(isas);
    for (size_t i = 0; i < count; i++)
        for (int32_t threads = 1; threads <= 4; threads++) {
            snow_options options = default_options();
            options.isa = isas[i];
            options.threads = threads;
            grid = grown_crystal(40, 300, &options);
            unsigned char *pixels = draw(grid, &view, NULL);
            assert_memory_equal(expected, pixels, size);
            free(pixels);
            snow_destroy(grid);
        }
    free(expected);
}

typedef struct shared_drawing {
    const snow_grid *grid;
    snow_view view;
    size_t size;
    unsigned char *pixels[8];
} shared_drawing;

static void draw_one(void *argument, size_t index)
{
    shared_drawing *shared = argument;
    snow_render(shared->grid, &shared->view, shared->pixels[index], shared->size, NULL);
}

/* Any number of threads may draw a grid at once; it asks for no memory. */
static void several_may_draw_at_once(void **state)
{
    (void)state;
    test_allocator allocator = {0};
    snow_options options = allocator_options(&allocator);
    snow_grid *grid = grown_crystal(40, 300, &options);
    size_t calls = allocator.calls;
    shared_drawing shared = {.grid = grid, .view = small_view(SNOW_PALETTE_AGE, SNOW_PIXEL_RGB)};
    assert_ok(snow_view_fit(grid, 150, &shared.view));
    unsigned char *expected = draw(grid, &shared.view, &shared.size);
    for (size_t i = 0; i < test_loop_count; i++) {
        for (size_t j = 0; j < 8; j++) {
            shared.pixels[j] = calloc(shared.size, 1);
            assert_non_null(shared.pixels[j]);
        }
        test_loops[i].run(NULL, 8, draw_one, &shared);
        for (size_t j = 0; j < 8; j++) {
            assert_memory_equal(expected, shared.pixels[j], shared.size);
            free(shared.pixels[j]);
        }
    }
    assert_int_equal(calls, allocator.calls);
    free(expected);
    snow_destroy(grid);
}

static int draw_and_stop(void *context, const snow_grid *grid, const snow_summary *summary)
{
    (void)summary;
    snow_view view = small_view(SNOW_PALETTE_PAPER, SNOW_PIXEL_GREY);
    assert_ok(snow_render(grid, &view, context, 21 * 17, NULL));
    return 1;
}

static void a_progress_callback_may_draw(void **state)
{
    (void)state;
    unsigned char pixels[21 * 17];
    snow_grid *grid = lone_cell(0.4);
    snow_stop stop = default_stop();
    stop.progress = draw_and_stop;
    stop.progress_context = pixels;
    stop.progress_steps = 20;
    snow_summary summary = run_grid(grid, &stop);
    assert_int_equal(SNOW_STOP_CANCELLED, summary.reason);
    snow_view view = small_view(SNOW_PALETTE_PAPER, SNOW_PIXEL_GREY);
    unsigned char *expected = draw(grid, &view, NULL);
    assert_memory_equal(expected, pixels, sizeof pixels);
    free(expected);
    snow_destroy(grid);
}

static void the_callers_rounding_does_not_matter(void **state)
{
    (void)state;
#ifdef FE_UPWARD
    snow_grid *grid = grown_crystal(30, 250, NULL);
    snow_view view = small_view(SNOW_PALETTE_FROST, SNOW_PIXEL_RGB);
    assert_ok(snow_view_fit(grid, 300, &view));
    size_t size;
    unsigned char *expected = draw(grid, &view, &size);
    assert_int_equal(0, fesetround(FE_UPWARD));
    snow_view upward = view;
    snow_status fitted = snow_view_fit(grid, 300, &upward);
    unsigned char *pixels = draw(grid, &view, NULL);
    int kept = fegetround();
    fesetround(FE_TONEAREST);
    assert_ok(fitted);
    assert_int_equal(FE_UPWARD, kept);
    assert_memory_equal(&view, &upward, sizeof view);
    assert_memory_equal(expected, pixels, size);
    free(expected);
    free(pixels);
    snow_destroy(grid);
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_the_documented_ones),
        cmocka_unit_test(the_size_is_told_first),
        cmocka_unit_test(null_pointers_are_refused),
        cmocka_unit_test(bad_numbers_are_refused),
        cmocka_unit_test(unknown_palettes_and_layouts_are_refused),
        cmocka_unit_test(views_that_were_not_initialised_are_refused),
        cmocka_unit_test(newer_views_are_accepted_while_their_tail_is_zero),
        cmocka_unit_test(age_needs_recorded_freeze_steps),
        cmocka_unit_test(fit_frames_the_interior),
        cmocka_unit_test(sides_out_of_range_are_refused),
        cmocka_unit_test(greys_are_those_of_the_paper),
        cmocka_unit_test(vapour_below_zero_is_black),
        cmocka_unit_test(palettes_begin_and_end_as_documented),
        cmocka_unit_test(brightness_follows_the_value),
        cmocka_unit_test(samples_fall_on_the_nearest_cell),
        cmocka_unit_test(cells_are_regular_hexagons),
        cmocka_unit_test(a_hexagon_covers_its_pixels),
        cmocka_unit_test(samples_are_averaged_as_light),
        cmocka_unit_test(pictures_of_symmetric_crystals_are_symmetric),
        cmocka_unit_test(whatever_is_not_ice_is_transparent),
        cmocka_unit_test(grey_is_luminance),
        cmocka_unit_test(large_pictures_agree_with_their_parts),
        cmocka_unit_test(the_medium_is_drawn_however_far_away),
        cmocka_unit_test(a_grid_without_ice_can_be_drawn),
        cmocka_unit_test(threads_and_instruction_sets_change_no_pixel),
        cmocka_unit_test(several_may_draw_at_once),
        cmocka_unit_test(a_progress_callback_may_draw),
        cmocka_unit_test(the_callers_rounding_does_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
