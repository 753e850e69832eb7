/* Zones of Packard's model: which cells they have, in which steps they apply, and that restriction wins. */
#include "support/packard.h"

#include <math.h>
#include <stdlib.h>

/* A plain model of its own: a rule on a square array, with the zones as a function. */
enum { REACH = 40, SIDE = 2 * REACH + 1 };

typedef struct plain_model {
    unsigned char frozen[SIDE + 2][SIDE + 2];
} plain_model;

/* 1: restricted, 2: priority. */
typedef unsigned (*plain_zone)(int64_t step, int q, int r);

static void plain_step(plain_model *model, uint32_t rule, int64_t step, plain_zone zone)
{
    static plain_model next;
    next = *model;
    for (int r = -REACH; r <= REACH; r++) {
        for (int q = -REACH; q <= REACH; q++) {
            int y = r + REACH + 1, x = q + REACH + 1;
            int count = model->frozen[y][x - 1] + model->frozen[y][x + 1] + model->frozen[y - 1][x] +
                        model->frozen[y + 1][x] + model->frozen[y - 1][x + 1] + model->frozen[y + 1][x - 1];
            unsigned demand = zone(step, q, r);
            if (demand & 1)
                continue;
            if ((rule >> count & 1) != 0 || ((demand & 2) != 0 && count > 0))
                next.frozen[y][x] = 1;
        }
    }
    *model = next;
}

static void compare(const snow_grid *grid, const plain_model *model)
{
    for (int r = -REACH; r <= REACH; r++)
        for (int q = -REACH; q <= REACH; q++)
            assert_int_equal(model->frozen[r + REACH + 1][q + REACH + 1], value_at(grid, SNOW_FIELD_FROZEN, q, r));
}

static int distance(int q, int r)
{
    int a = abs(q), b = abs(r), c = abs(q + r);
    return a > b ? (a > c ? a : c) : (b > c ? b : c);
}

/* How far a cell is from the nearest corner of its ring, along the side. */
static int from_corner(int q, int r)
{
    int a = abs(q), b = abs(r), c = abs(q + r);
    return a < b ? (a < c ? a : c) : (b < c ? b : c);
}

static const snow_packard_engine engines[] = {SNOW_PACKARD_ENGINE_REFERENCE, SNOW_PACKARD_ENGINE_TILES,
                                              SNOW_PACKARD_ENGINE_QUADTREE, SNOW_PACKARD_ENGINE_AUTO};

/* The same run in every engine and in the plain model, compared after every step. */
static void check_zones(const char *rule, const snow_packard_zone *zones, size_t count, plain_zone plain)
{
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        static plain_model model;
        model = (plain_model){.frozen = {{0}}};
        model.frozen[REACH + 1][REACH + 1] = 1;
        snow_packard_params params = packard_scene(rule);
        params.engine = engines[i];
        snow_grid *grid = make_packard(&params, NULL);
        for (size_t k = 0; k < count; k++)
            assert_ok(snow_packard_add_zone(grid, &zones[k]));
        for (int64_t step = 1; step <= 30; step++) {
            assert_ok(snow_step(grid, 1));
            plain_step(&model, params.rule, step, plain);
            compare(grid, &model);
        }
        snow_destroy(grid);
    }
}

/* Clefts about the middles of the sides, as in Liu and Zhang's fig. 4. */
static unsigned plain_clefts(int64_t step, int q, int r)
{
    int n = distance(q, r);
    bool cleft = abs(n - 2 * from_corner(q, r)) <= 2 && n >= 3;
    return step >= 5 && step <= 22 && cleft ? 1 : 0;
}

static void restrictions_hold_from_the_first_step_to_the_last(void **state)
{
    (void)state;
    snow_packard_zone zone = packard_zone_of(SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_SIDES, 5, 22);
    zone.half_width = 1;
    zone.inner = 3;
    check_zones("0110100", &zone, 1, plain_clefts);
    check_zones("0100000", &zone, 1, plain_clefts);
}

static unsigned plain_corners(int64_t step, int q, int r)
{
    return step >= 4 && step <= 5 && from_corner(q, r) == 0 ? 2 : 0;
}

static void priorities_hold_from_the_first_step_to_the_last(void **state)
{
    (void)state;
    snow_packard_zone zone = packard_zone_of(SNOW_PACKARD_PRIORITY, SNOW_PACKARD_CORNERS, 4, 5);
    check_zones("0101010", &zone, 1, plain_corners);
    check_zones("0110000", &zone, 1, plain_corners);
    check_zones("0000100", &zone, 1, plain_corners);
}

static unsigned plain_both(int64_t step, int q, int r)
{
    unsigned demand = 0;
    if (step >= 2 && step <= 9 && distance(q, r) <= 12 && from_corner(q, r) <= 3)
        demand |= 2;
    if (step >= 7 && step <= 14 && q >= -3 && q < 9 && r >= 1 && r < 21)
        demand |= 1;
    return demand;
}

static void restriction_wins(void **state)
{
    (void)state;
    snow_packard_zone zones[] = {packard_zone_of(SNOW_PACKARD_PRIORITY, SNOW_PACKARD_CORNERS, 2, 9),
                                 packard_zone_of(SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_CELLS, 7, 14)};
    zones[0].half_width = 3;
    zones[0].outer = 12;
    zones[1].rect = (snow_rect){-3, 1, 12, 20};
    check_zones("0101010", zones, 2, plain_both);
}

/* Only the corners grow, for two steps. */
static unsigned plain_tips(int64_t step, int q, int r)
{
    return step >= 7 && step <= 8 && from_corner(q, r) > 0 ? 1 : 0;
}

static void an_inverted_zone_is_all_other_cells(void **state)
{
    (void)state;
    snow_packard_zone zone = packard_zone_of(SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_CORNERS, 7, 8);
    zone.inverted = 1;
    check_zones("0110000", &zone, 1, plain_tips);
    check_zones("0101010", &zone, 1, plain_tips);
}

static int contains_odd(void *context, int32_t q, int32_t r)
{
    ++*(int *)context;
    return (q * r) & 1;
}

static unsigned plain_odd(int64_t step, int q, int r)
{
    return step >= 3 && q >= -10 && q < 20 && r >= -5 && r < 10 && ((q * r) & 1) != 0 ? 1 : 0;
}

static void masks_and_predicates_name_cells(void **state)
{
    (void)state;
    int asked = 0;
    uint8_t mask[30 * 15];
    for (int i = 0; i < 30 * 15; i++)
        mask[i] = (uint8_t)((((i % 30) - 10) * ((i / 30) - 5)) & 1);
    snow_packard_zone zone =
        packard_zone_of(SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_CELLS, 3, SNOW_PACKARD_FOREVER);
    zone.rect = (snow_rect){-10, -5, 30, 15};
    zone.contains = contains_odd;
    zone.contains_context = &asked;
    check_zones("0101010", &zone, 1, plain_odd);
    assert_int_equal(COUNT_OF(engines) * 30 * 15, asked); /* once a cell, and not again while the grid runs */
    zone.contains = NULL;
    zone.mask = mask;
    check_zones("0101010", &zone, 1, plain_odd);
}

/* Cells of a zone are seen by what a priority zone makes of a plate: with rule 0 nothing else freezes. */
static void sectors_have_the_cells_that_geometry_says(void **state)
{
    (void)state;
    const double degree = atan(1.0) / 45;
    for (int shape = SNOW_PACKARD_CORNERS; shape <= SNOW_PACKARD_SIDES; shape++) {
        for (double angle = 2.5; angle <= 30; angle += 5.5) {
            snow_packard_params params = packard_scene("1111111");
            params.domain = SNOW_PACKARD_HEXAGON;
            params.radius = 25;
            params.seeds = &(snow_cell){0, 0};
            params.seed_count = 0;
            snow_grid *grid = make_packard(&params, NULL);
            snow_packard_zone zone =
                packard_zone_of(SNOW_PACKARD_RESTRICTION, (snow_packard_zone_shape)shape, 1, SNOW_PACKARD_FOREVER);
            zone.half_angle = angle;
            zone.inner = 2;
            zone.outer = 20;
            assert_ok(snow_packard_add_zone(grid, &zone));
            assert_ok(snow_step(grid, 1));
            for (int32_t r = -24; r <= 24; r++) {
                for (int32_t q = -24; q <= 24; q++) {
                    if (value_at(grid, SNOW_FIELD_INSIDE, q, r) == 0)
                        continue;
                    double direction = atan2(r * sqrt(3.0) / 2, q + r / 2.0) / degree + 360;
                    double turned = fmod(direction + (shape == SNOW_PACKARD_CORNERS ? 30 : 0), 60);
                    bool inside = fabs(turned - 30) <= angle + 1e-9 && distance(q, r) >= 2 && distance(q, r) <= 20;
                    assert_same_double(!inside, value_at(grid, SNOW_FIELD_FROZEN, q, r));
                }
            }
            snow_destroy(grid);
        }
    }
}

static void zones_can_be_added_while_the_crystal_grows(void **state)
{
    (void)state;
    snow_grid *grids[COUNT_OF(engines)];
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_packard_params params = packard_scene("0101010");
        params.engine = engines[i];
        grids[i] = make_packard(&params, NULL);
        assert_ok(snow_step(grids[i], 20));
        uint64_t before = frozen_of(grids[i]);
        snow_packard_zone all = packard_zone_of(SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_SIDES, 1, 30);
        all.half_angle = 30;
        assert_ok(snow_packard_add_zone(grids[i], &all)); /* the whole plane, steps 21 to 30 */
        assert_ok(snow_step(grids[i], 10));
        assert_int_equal(before, frozen_of(grids[i]));
        assert_ok(snow_step(grids[i], 25));
        assert_true(frozen_of(grids[i]) > before);
        assert_same_crystals(grids[0], grids[i]);
    }
    for (size_t i = 0; i < COUNT_OF(engines); i++)
        snow_destroy(grids[i]);
}

static void the_quadtree_goes_on_where_zones_end(void **state)
{
    (void)state;
    snow_packard_params params = packard_scene("0100000");
    params.engine = SNOW_PACKARD_ENGINE_QUADTREE;
    snow_grid *tree = make_packard(&params, NULL);
    params.engine = SNOW_PACKARD_ENGINE_TILES;
    snow_grid *tiles = make_packard(&params, NULL);
    snow_packard_zone zone = packard_zone_of(SNOW_PACKARD_PRIORITY, SNOW_PACKARD_SIDES, 50, 70);
    zone.half_width = 2;
    assert_ok(snow_packard_add_zone(tree, &zone));
    assert_ok(snow_packard_add_zone(tiles, &zone));
    static const struct {
        int64_t steps;
        snow_packard_engine engine;
    } parts[] = {{30, SNOW_PACKARD_ENGINE_QUADTREE}, {35, SNOW_PACKARD_ENGINE_TILES},
                 {5, SNOW_PACKARD_ENGINE_TILES},     {300, SNOW_PACKARD_ENGINE_QUADTREE}};
    for (size_t i = 0; i < COUNT_OF(parts); i++) {
        assert_ok(snow_step(tree, parts[i].steps));
        assert_ok(snow_step(tiles, parts[i].steps));
        assert_int_equal(parts[i].engine, engine_of(tree));
        assert_same_crystals(tiles, tree);
    }
    snow_destroy(tree);
    snow_destroy(tiles);
}

/* A crystal that rests under a restriction is still only when that never ends. */
/* Zones hand the crystal from the quadtree to the tiles, which cannot go back when they have frozen too many cells. */
static void a_number_of_cells_is_met_at_its_step_beside_zones(void **state)
{
    (void)state;
    for (int64_t first = 1; first <= 9; first += 4) {
        snow_packard_zone zone = packard_zone_of(SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_CORNERS, first, 30);
        snow_packard_params params = packard_scene("0110010");
        params.engine = SNOW_PACKARD_ENGINE_REFERENCE;
        snow_grid *reference = make_packard(&params, NULL);
        params.engine = SNOW_PACKARD_ENGINE_QUADTREE;
        snow_grid *quadtree = make_packard(&params, NULL);
        assert_ok(snow_packard_add_zone(reference, &zone));
        assert_ok(snow_packard_add_zone(quadtree, &zone));
        for (uint64_t frozen = 10; frozen < 600; frozen += 70) {
            snow_stop stop = stop_after(40);
            stop.frozen = frozen;
            snow_summary expected = run_grid(reference, &stop);
            snow_summary got = run_grid(quadtree, &stop);
            assert_int_equal(expected.steps, got.steps);
            assert_int_equal(expected.reason, got.reason);
        }
        assert_same_crystals(reference, quadtree);
        snow_destroy(reference);
        snow_destroy(quadtree);
    }
}

static void still_waits_for_zones_that_may_wake_the_crystal(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        for (int ends = 0; ends < 2; ends++) {
            snow_packard_params params = packard_scene("0101010");
            params.engine = engines[i];
            snow_grid *grid = make_packard(&params, NULL);
            snow_packard_zone all =
                packard_zone_of(SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_SIDES, 10, ends ? 200 : SNOW_PACKARD_FOREVER);
            all.half_angle = 30;
            assert_ok(snow_packard_add_zone(grid, &all));
            snow_stop stop = default_stop();
            stop.max_steps = 205;
            snow_summary summary = run_grid(grid, &stop);
            assert_int_equal(ends ? SNOW_STOP_STEPS : SNOW_STOP_STILL, summary.reason);
            assert_int_equal(ends ? 205 : 64, summary.steps);
            snow_destroy(grid);
        }
    }
}

static void wrong_zones_are_refused(void **state)
{
    (void)state;
    snow_packard_params params = packard_scene("0101010");
    snow_grid *grid = make_packard(&params, NULL);
    uint64_t before, after;
    assert_ok(snow_memory(grid, &before));
    snow_packard_zone sound = packard_zone_of(SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_CELLS, 1, 9), zone;
    uint8_t mask = 1;

    zone = sound, zone.struct_size = 0;
    assert_status(SNOW_ERROR_STRUCT_SIZE, snow_packard_add_zone(grid, &zone));
    zone = sound, zone.kind = (snow_packard_zone_kind)3;
    assert_status(SNOW_ERROR_ENUM, snow_packard_add_zone(grid, &zone));
    zone = sound, zone.shape = (snow_packard_zone_shape)0;
    assert_status(SNOW_ERROR_ENUM, snow_packard_add_zone(grid, &zone));
    zone = sound, zone.inverted = 2;
    assert_status(SNOW_ERROR_RANGE, snow_packard_add_zone(grid, &zone));
    zone = sound, zone.half_width = NAN;
    assert_status(SNOW_ERROR_NOT_FINITE, snow_packard_add_zone(grid, &zone));
    zone = sound, zone.rect = (snow_rect){INT32_MAX, 0, 2, 1};
    assert_status(SNOW_ERROR_RECTANGLE, snow_packard_add_zone(grid, &zone));
    zone = sound, zone.rect.width = -1;
    assert_status(SNOW_ERROR_RECTANGLE, snow_packard_add_zone(grid, &zone));
    zone = sound, zone.half_width = -1;
    assert_status(SNOW_ERROR_PACKARD_ZONE, snow_packard_add_zone(grid, &zone));
    zone = sound, zone.half_angle = 30.5;
    assert_status(SNOW_ERROR_PACKARD_ZONE, snow_packard_add_zone(grid, &zone));
    zone = sound, zone.inner = -1;
    assert_status(SNOW_ERROR_PACKARD_ZONE, snow_packard_add_zone(grid, &zone));
    zone = sound, zone.first_step = 0;
    assert_status(SNOW_ERROR_PACKARD_ZONE, snow_packard_add_zone(grid, &zone));
    zone = sound, zone.last_step = 0;
    assert_status(SNOW_ERROR_PACKARD_ZONE, snow_packard_add_zone(grid, &zone));
    zone = sound, zone.mask = &mask, zone.contains = contains_odd;
    assert_status(SNOW_ERROR_PACKARD_ZONE, snow_packard_add_zone(grid, &zone));

    assert_ok(snow_memory(grid, &after));
    assert_int_equal(before, after);
    assert_ok(snow_step(grid, 9));
    assert_int_equal(population_after("0101010", SNOW_PACKARD_ENGINE_TILES, 9), frozen_of(grid));
    snow_destroy(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(restrictions_hold_from_the_first_step_to_the_last),
        cmocka_unit_test(priorities_hold_from_the_first_step_to_the_last),
        cmocka_unit_test(restriction_wins),
        cmocka_unit_test(an_inverted_zone_is_all_other_cells),
        cmocka_unit_test(masks_and_predicates_name_cells),
        cmocka_unit_test(sectors_have_the_cells_that_geometry_says),
        cmocka_unit_test(zones_can_be_added_while_the_crystal_grows),
        cmocka_unit_test(the_quadtree_goes_on_where_zones_end),
        cmocka_unit_test(a_number_of_cells_is_met_at_its_step_beside_zones),
        cmocka_unit_test(still_waits_for_zones_that_may_wake_the_crystal),
        cmocka_unit_test(wrong_zones_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
