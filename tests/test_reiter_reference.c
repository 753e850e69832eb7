/* Every engine against small cases that were worked out by hand, and against a second plain reading of the paper. */
#include "support/grids.h"
#include "support/paper.h"

#include <stdlib.h>

static const snow_reiter_engine engines[] = {SNOW_REITER_ENGINE_REFERENCE, SNOW_REITER_ENGINE_ROWS,
                                             SNOW_REITER_ENGINE_QUAD, SNOW_REITER_ENGINE_AUTO};

/* Reiter 2005, fig. 2: a step with γ = 0.1 and background 0.2, of which the patch determines seven cells. */
static void figure_2_of_the_paper(void **state)
{
    (void)state;
    static const double rows[5][5] = {
        {1, 1, 1}, {0.5, 1, 1, 1}, {0.2, 0.5, 1, 1, 1}, {0.2, 0.2, 0.5, 1}, {0.2, 0.2, 0.5},
    };
    static const int32_t widths[5] = {3, 4, 5, 4, 3};
    static const int32_t first[5] = {0, -1, -2, -2, -2};
    static const struct {
        int32_t row, column; /* counted from 1, as in the paper */
        double value;
    } expected[] = {
        {2, 2, 1.1}, {2, 3, 1.1}, {3, 2, 19.0 / 30}, {3, 3, 1.1}, {3, 4, 1.1}, {4, 2, 7.0 / 20}, {4, 3, 37.0 / 60},
    };
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_reiter_params params = disc_scene(0.2, 0.1, 1, 8);
        without_seeds(&params);
        params.engine = engines[i];
        snow_grid *grid = make_grid(&params, NULL);
        for (int32_t row = 0; row < 5; row++)
            assert_ok(snow_field_set(grid, SNOW_FIELD_VALUE, &(snow_rect){first[row], row - 2, widths[row], 1},
                                     rows[row], (size_t)widths[row]));
        assert_int_equal(10, frozen_of(grid));
        assert_same_double(1.0, value_at(grid, SNOW_FIELD_RECEPTIVE, -1, 1));
        assert_same_double(0.0, value_at(grid, SNOW_FIELD_RECEPTIVE, -2, 1));
        assert_ok(snow_step(grid, 1));
        for (size_t j = 0; j < COUNT_OF(expected); j++) {
            int32_t row = expected[j].row - 1;
            int32_t q = first[row] + expected[j].column - 1;
            assert_near(expected[j].value, value_at(grid, SNOW_FIELD_VALUE, q, row - 2), 1e-14);
        }
        snow_destroy(grid);
    }
}

/* The disc of radius 2: the seed, its ring of six, and six corners at distance √3. By symmetry three numbers tell
   all. A ring cell's neighbours are the seed, two ring cells, two corners and one fixed cell; a corner's are two ring
   cells and four fixed cells. While the ring is receptive but not ice, with c = α/12, ring x and corner y:
       x′ = x + γ + c·(β + 2y),    y′ = y + c·(4β − 6y). */
typedef struct ring_and_corner {
    double ring, corner;
} ring_and_corner;

static void follow_by_hand(double diffusion, const ring_and_corner *expected, int64_t steps)
{
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_reiter_params params = disc_scene(0.4, 0.1, diffusion, 2);
        params.record_freeze_steps = 1;
        params.engine = engines[i];
        snow_grid *grid = make_grid(&params, NULL);
        assert_int_equal(13, cells_of(grid));
        for (int64_t step = 1; step <= steps; step++) {
            assert_ok(snow_step(grid, 1));
            assert_near(1 + 0.1 * (double)step, value_at(grid, SNOW_FIELD_VALUE, 0, 0), 1e-15);
            for (int side = 0; side < 6; side++) {
                snow_cell ring = neighbours[side];
                snow_cell next = neighbours[(side + 1) % 6];
                assert_near(expected[step - 1].ring, value_at(grid, SNOW_FIELD_VALUE, ring.q, ring.r), 1e-14);
                assert_near(expected[step - 1].corner,
                            value_at(grid, SNOW_FIELD_VALUE, ring.q + next.q, ring.r + next.r), 1e-14);
            }
        }
        snow_destroy(grid);
    }
}

static void thirteen_cells_by_hand(void **state)
{
    (void)state;
    /* The ring freezes in step 4. In step 5 it still collects from the fixed cells, and the corners, receptive now,
       collect 4β/12 and γ. */
    static const ring_and_corner expected[] = {
        {3.0 / 5, 1.0 / 3}, {71.0 / 90, 3.0 / 10}, {35.0 / 36, 17.0 / 60}, {83.0 / 72, 11.0 / 40},
        {463.0 / 360, 61.0 / 120},
    };
    follow_by_hand(1, expected, COUNT_OF(expected));
}

static void thirteen_cells_by_hand_with_slow_diffusion(void **state)
{
    (void)state;
    static const ring_and_corner expected[] = {
        {11.0 / 20, 11.0 / 30}, {251.0 / 360, 41.0 / 120}, {1213.0 / 1440, 31.0 / 96},
    };
    follow_by_hand(0.5, expected, COUNT_OF(expected));
}

static void thirteen_cells_by_hand_with_fast_diffusion(void **state)
{
    (void)state;
    /* The ring freezes in step 3, and the corners stand still at 4β/6 until then. */
    static const ring_and_corner expected[] = {
        {7.0 / 10, 4.0 / 15}, {43.0 / 45, 4.0 / 15}, {109.0 / 90, 4.0 / 15},
    };
    follow_by_hand(2, expected, COUNT_OF(expected));
}

static void the_step_of_freezing_is_the_one_that_reaches_1(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_reiter_params params = disc_scene(0.4, 0.1, 1, 2);
        params.record_freeze_steps = 1;
        params.engine = engines[i];
        snow_grid *grid = make_grid(&params, NULL);
        assert_ok(snow_step(grid, 3));
        assert_int_equal(1, frozen_of(grid));
        assert_ok(snow_step(grid, 1));
        assert_int_equal(7, frozen_of(grid));
        assert_same_double(0.0, value_at(grid, SNOW_FIELD_FREEZE_STEP, 0, 0));
        assert_same_double(4.0, value_at(grid, SNOW_FIELD_FREEZE_STEP, 1, 0));
        assert_same_double(-1.0, value_at(grid, SNOW_FIELD_FREEZE_STEP, 1, 1));
        snow_destroy(grid);
    }
}

/* One cell among fixed ones: u = 1 + k·(γ + 6·αβ/12). */
static void a_domain_of_one_cell(void **state)
{
    (void)state;
    const double diffusions[] = {0, 0.5, 1, 2.6};
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        for (size_t j = 0; j < COUNT_OF(diffusions); j++) {
            snow_reiter_params scenes[] = {disc_scene(0.4, 0.01, diffusions[j], 1),
                                           hexagon_scene(0.4, 0.01, diffusions[j], 1),
                                           rectangle_scene(0.4, 0.01, diffusions[j], 1, 1)};
            for (size_t k = 0; k < COUNT_OF(scenes); k++) {
                scenes[k].engine = engines[i];
                snow_grid *grid = make_grid(&scenes[k], NULL);
                assert_int_equal(1, cells_of(grid));
                assert_ok(snow_step(grid, 1000));
                double expected = 1 + 1000 * (0.01 + diffusions[j] * 0.4 / 2);
                assert_near(expected, value_at(grid, SNOW_FIELD_VALUE, 0, 0), 1000 * 0x1p-44);
                snow_destroy(grid);
            }
        }
    }
}

static void the_slack_of_2_to_minus_40(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_reiter_params params = disc_scene(0.4, 0.1, 1, 4);
        without_seeds(&params);
        params.engine = engines[i];
        snow_grid *grid = make_grid(&params, NULL);
        set_cell(grid, SNOW_FIELD_VALUE, 0, 0, 1 - 0x1p-39);
        assert_int_equal(0, frozen_of(grid));
        set_cell(grid, SNOW_FIELD_VALUE, 0, 0, 1 - 0x1p-40);
        assert_int_equal(1, frozen_of(grid));
        snow_destroy(grid);

        /* 0.95 + 0.05, and ten times 0.1. */
        params = disc_scene(0.95, 0.05, 0, 4);
        params.engine = engines[i];
        grid = make_grid(&params, NULL);
        assert_ok(snow_step(grid, 1));
        assert_int_equal(7, frozen_of(grid));
        snow_destroy(grid);

        params = disc_scene(0, 0.1, 1, 4);
        params.engine = engines[i];
        grid = make_grid(&params, NULL);
        assert_ok(snow_step(grid, 9));
        assert_int_equal(1, frozen_of(grid));
        assert_ok(snow_step(grid, 1));
        assert_int_equal(7, frozen_of(grid));
        snow_destroy(grid);
    }
}

/* Inside and bounds, from the words of the header. */
static void assert_domain(const snow_reiter_params *params)
{
    snow_grid *grid = make_grid(params, NULL);
    paper *model = paper_new(params);
    snow_rect bounds = bounds_of(grid);
    snow_rect rect = widened(widened(bounds));
    uint64_t cells = 0;
    snow_rect seen = {INT32_MAX, INT32_MAX, 0, 0};
    int32_t last_q = INT32_MIN, last_r = INT32_MIN;
    for (int32_t r = rect.r; r < rect.r + rect.height; r++) {
        for (int32_t q = rect.q; q < rect.q + rect.width; q++) {
            bool inside = paper_inside(model, q, r);
            assert_same_double(inside ? 1.0 : 0.0, value_at(grid, SNOW_FIELD_INSIDE, q, r));
            if (!inside)
                continue;
            cells++;
            seen.q = q < seen.q ? q : seen.q;
            seen.r = r < seen.r ? r : seen.r;
            last_q = q > last_q ? q : last_q;
            last_r = r > last_r ? r : last_r;
        }
    }
    seen.width = last_q - seen.q + 1;
    seen.height = last_r - seen.r + 1;
    assert_memory_equal(&seen, &bounds, sizeof bounds);
    assert_int_equal(cells, cells_of(grid));
    paper_delete(model);
    snow_destroy(grid);
}

static void domains_are_those_of_the_header(void **state)
{
    (void)state;
    for (int32_t radius = 1; radius <= 24; radius++) {
        snow_reiter_params disc = disc_scene(0.4, 0.1, 1, radius);
        snow_reiter_params hexagon = hexagon_scene(0.4, 0.1, 1, radius);
        assert_domain(&disc);
        assert_domain(&hexagon);
    }
    for (int32_t width = 1; width <= 9; width++) {
        for (int32_t height = 1; height <= 9; height++) {
            snow_reiter_params rectangle = rectangle_scene(0.4, 0.1, 1, width, height);
            assert_domain(&rectangle);
        }
    }
}

static void known_numbers_of_cells(void **state)
{
    (void)state;
    /* Squared distances below 9: 0 once, 1, 3 and 4 six times each, 7 twelve times. */
    static const struct {
        int32_t radius;
        uint64_t cells;
    } discs[] = {{1, 1}, {2, 13}, {3, 31}};
    for (size_t i = 0; i < COUNT_OF(discs); i++) {
        snow_reiter_params params = disc_scene(0.4, 0.1, 1, discs[i].radius);
        snow_grid *grid = make_grid(&params, NULL);
        assert_int_equal(discs[i].cells, cells_of(grid));
        snow_destroy(grid);
    }
    snow_reiter_params params = rectangle_scene(0.4, 0.1, 1, 600, 600);
    snow_grid *grid = make_grid(&params, NULL);
    assert_int_equal(360000, cells_of(grid));
    /* Row 0 is even and row 599 odd: the bounds in axial columns. */
    snow_rect bounds = bounds_of(grid);
    assert_int_equal(-300, bounds.r);
    assert_int_equal(600, bounds.height);
    assert_int_equal(-300 - 149, bounds.q);
    assert_int_equal(600 + 299, bounds.width);
    assert_same_double(1.0, value_at(grid, SNOW_FIELD_INSIDE, -150, -300));
    assert_same_double(0.0, value_at(grid, SNOW_FIELD_INSIDE, -151, -300));
    assert_same_double(1.0, value_at(grid, SNOW_FIELD_INSIDE, -449, 299));
    assert_same_double(0.0, value_at(grid, SNOW_FIELD_INSIDE, -450, 299));
    snow_destroy(grid);
}

static bool is_next_to_interior(const paper *model, int32_t q, int32_t r)
{
    for (int i = 0; i < 6; i++)
        if (paper_inside(model, q + neighbours[i].q, r + neighbours[i].r))
            return true;
    return false;
}

/* Both models side by side: ice cell by cell, and all values, after each stretch of steps. */
static void assert_follows_paper(const snow_reiter_params *params, int64_t steps, double tolerance)
{
    snow_grid *grid = make_grid(params, NULL);
    paper *model = paper_new(params);
    snow_rect rect = widened(bounds_of(grid));
    for (int64_t done = 0; done < steps; done += 10) {
        for (int32_t r = rect.r; r < rect.r + rect.height; r++) {
            for (int32_t q = rect.q; q < rect.q + rect.width; q++) {
                if (!paper_inside(model, q, r) && !is_next_to_interior(model, q, r))
                    continue;
                assert_int_equal(paper_is_ice(model, q, r), value_at(grid, SNOW_FIELD_FROZEN, q, r) == 1);
                assert_near((double)paper_value(model, q, r), value_at(grid, SNOW_FIELD_VALUE, q, r), tolerance);
            }
        }
        assert_ok(snow_step(grid, 10));
        paper_step(model, 10);
    }
    paper_delete(model);
    snow_destroy(grid);
}

static double wavy_background(void *context, int32_t q, int32_t r)
{
    (void)context;
    return 0.3 + (double)((q * q + 3 * r * r) % 17) / 64;
}

static double wavy_addition(void *context, int32_t q, int32_t r)
{
    (void)context;
    return (double)((2 * q * q + r * r) % 5) / 128;
}

static void follow_scenes(snow_reiter_engine engine, double tolerance)
{
    static const snow_cell scattered[] = {{0, 0}, {4, -2}, {-3, -3}, {-3, -2}};
    snow_reiter_params scenes[] = {
        disc_scene(0.4, 0.001, 1, 22),     disc_scene(0.9, 0.05, 1, 22),       disc_scene(0.35, 0.0001, 0.5, 16),
        disc_scene(0.5, 0.01, 2, 16),      disc_scene(0.4, 0.001, 2.5, 16),    hexagon_scene(0.6, 0.01, 1, 14),
        hexagon_scene(0, 0.05, 1, 8),      rectangle_scene(0.4, 0.01, 1, 9, 16),
        rectangle_scene(0.7, 0.002, 1.5, 21, 8),
        rectangle_scene(0.4, 0.01, 1, 1, 7), rectangle_scene(0.4, 0.01, 1, 7, 1),
        disc_scene(0.3, 0.01, 1, 12),      disc_scene(0.3, 0.01, 1, 12),       hexagon_scene(0.3, 0.01, 2.2, 9),
    };
    size_t count = COUNT_OF(scenes);
    scenes[count - 3].seeds = scattered;
    scenes[count - 3].seed_count = COUNT_OF(scattered);
    scenes[count - 2].background_at = wavy_background;
    scenes[count - 2].addition_at = wavy_addition;
    scenes[count - 1].background_at = wavy_background;
    for (size_t i = 0; i < count; i++) {
        scenes[i].engine = engine;
        assert_follows_paper(&scenes[i], 150, tolerance);
    }
}

/* 150 steps, each with roundings of 2^-51 in a cell and its neighbours, some ten of them. */
static void reference_follows_the_second_reading(void **state)
{
    (void)state;
    follow_scenes(SNOW_REITER_ENGINE_REFERENCE, 150 * 10 * 0x1p-51);
}

static void rows_follow_the_second_reading(void **state)
{
    (void)state;
    follow_scenes(SNOW_REITER_ENGINE_ROWS, 150 * 10 * 0x1p-51);
}

/* No quantum here, but the long doubles of the second reading may be doubles (valgrind, some platforms). */
static void quad_follows_the_second_reading(void **state)
{
    (void)state;
    follow_scenes(SNOW_REITER_ENGINE_QUAD, 150 * 10 * 0x1p-52);
}

static void double_stays_near_quad(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 20);
    params.engine = SNOW_REITER_ENGINE_REFERENCE;
    snow_grid *reference = make_grid(&params, NULL);
    params.engine = SNOW_REITER_ENGINE_QUAD;
    snow_grid *quad = make_grid(&params, NULL);
    assert_ok(snow_step(reference, 400));
    assert_ok(snow_step(quad, 400));
    assert_same_ice(quad, reference);
    size_t count;
    double *truth = copy_field(quad, SNOW_FIELD_VALUE, NULL, &count);
    double *values = copy_field(reference, SNOW_FIELD_VALUE, NULL, NULL);
    for (size_t i = 0; i < count; i++)
        assert_near(truth[i], values[i], 400 * 10 * 0x1p-51);
    free(truth);
    free(values);
    snow_destroy(reference);
    snow_destroy(quad);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figure_2_of_the_paper),
        cmocka_unit_test(thirteen_cells_by_hand),
        cmocka_unit_test(thirteen_cells_by_hand_with_slow_diffusion),
        cmocka_unit_test(thirteen_cells_by_hand_with_fast_diffusion),
        cmocka_unit_test(the_step_of_freezing_is_the_one_that_reaches_1),
        cmocka_unit_test(a_domain_of_one_cell),
        cmocka_unit_test(the_slack_of_2_to_minus_40),
        cmocka_unit_test(domains_are_those_of_the_header),
        cmocka_unit_test(known_numbers_of_cells),
        cmocka_unit_test(reference_follows_the_second_reading),
        cmocka_unit_test(rows_follow_the_second_reading),
        cmocka_unit_test(quad_follows_the_second_reading),
        cmocka_unit_test(double_stays_near_quad),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
