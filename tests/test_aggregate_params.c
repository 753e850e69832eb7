/* Aggregation scenes: defaults, presets, and every way in which a scene can be wrong. */
#include "support/aggregates.h"
#include "support/grids.h"

#include <limits.h>
#include <math.h>
#include <string.h>

static snow_grid *const untouched = (snow_grid *)(uintptr_t)0x1230;

static void assert_refused(snow_status expected, const snow_aggregate_params *params)
{
    snow_grid *grid = untouched;
    assert_status(expected, snow_aggregate_create(params, NULL, &grid));
    assert_ptr_equal(untouched, grid);
}

static void defaults_are_the_documented_ones(void **state)
{
    (void)state;
    snow_aggregate_params params;
    memset(&params, 0xff, sizeof params);
    snow_aggregate_params_init(&params, sizeof params);
    assert_int_equal(sizeof params, params.struct_size);
    assert_int_equal(SNOW_AGGREGATE_WITTEN_SANDER, params.scene);
    assert_int_equal(SNOW_AGGREGATE_SQUARE, params.lattice);
    assert_int_equal(SNOW_AGGREGATE_ARRIVAL, params.contact);
    assert_int_equal(SNOW_AGGREGATE_ENGINE_AUTO, params.engine);
    assert_int_equal(0, params.random_seed);
    assert_same_double(1.0, params.sticking);
    assert_int_equal(1, params.hits);
    assert_int_equal(0, params.record_order);
    assert_null(params.seeds);
    assert_null(params.obstacles);
    assert_same_double(0.0, params.kill_radius);
    assert_int_equal(100, params.launch_radius);
    assert_int_equal(90, params.end_radius);
    assert_int_equal(256, params.width);
    assert_int_equal(256, params.height);
    assert_int_equal(64, params.depth);
    assert_int_equal(0, params.periodic);
    assert_int_equal(INT32_MIN, params.launch_first);
    assert_int_equal(INT32_MAX, params.launch_last);
    assert_int_equal(INT32_MIN, params.cathode_first);
    assert_int_equal(INT32_MAX, params.cathode_last);
    assert_same_double(0.0, params.interaction);
    assert_int_equal(1, params.hardness_least);
    assert_int_equal(3, params.hardness_greatest);
    assert_int_equal(0, params.wall_left);
    assert_int_equal(255, params.wall_right);
    assert_int_equal(10000, params.particles);
    assert_same_double(0.05, params.density);
    assert_same_double(0.0, params.mobility);
}

static void every_preset_grows(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    assert_status(SNOW_ERROR_AGGREGATE_PRESET, snow_aggregate_params_preset(&params, "no such scene"));
    assert_status(SNOW_ERROR_NULL, snow_aggregate_params_preset(&params, NULL));
    size_t count = 0;
    for (const char *name; (name = snow_aggregate_preset_name(count)) != NULL; count++) {
        assert_non_null(snow_aggregate_preset_source(count));
        assert_ok(snow_aggregate_params_preset(&params, name));
        snow_grid *grid = make_aggregate(&params, NULL);
        assert_ok(snow_step(grid, 10));
        snow_destroy(grid);
    }
    assert_true(count >= 9);
    assert_null(snow_aggregate_preset_source(count));
}

static void pointers_and_structs_are_checked(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    snow_grid *grid = untouched;
    assert_status(SNOW_ERROR_NULL, snow_aggregate_create(NULL, NULL, &grid));
    assert_status(SNOW_ERROR_NULL, snow_aggregate_create(&params, NULL, NULL));
    params.struct_size = 0;
    assert_refused(SNOW_ERROR_STRUCT_SIZE, &params);
    params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    params.seed_count = 1;
    assert_refused(SNOW_ERROR_NULL, &params);
    assert_ptr_equal(untouched, grid);
}

/* One member is wrong in a scene that is right without it. */
#define REFUSED(expected, name, member, value)                                                                       \
    do {                                                                                                             \
        snow_aggregate_params params_ = aggregate_scene(name);                                                       \
        params_.member = (value);                                                                                    \
        assert_refused((expected), &params_);                                                                        \
    } while (0)

static void numbers_out_of_range_are_refused(void **state)
{
    (void)state;
    const snow_aggregate_scene point = SNOW_AGGREGATE_WITTEN_SANDER;
    const snow_aggregate_scene bath = SNOW_AGGREGATE_ELECTROLYSIS;
    const snow_aggregate_scene free_particles = SNOW_AGGREGATE_CLUSTER_CLUSTER;
    REFUSED(SNOW_ERROR_ENUM, point, scene, (snow_aggregate_scene)99);
    REFUSED(SNOW_ERROR_ENUM, point, lattice, (snow_aggregate_lattice)99);
    REFUSED(SNOW_ERROR_ENUM, point, contact, (snow_aggregate_contact)0);
    REFUSED(SNOW_ERROR_ENUM, point, engine, (snow_aggregate_engine)99);
    REFUSED(SNOW_ERROR_RANGE, point, record_order, 2);
    REFUSED(SNOW_ERROR_RANGE, SNOW_AGGREGATE_LINE, periodic, -1);
    static const double sticking[] = {0, -0.1, 1.0000001};
    for (size_t i = 0; i < COUNT_OF(sticking); i++)
        REFUSED(SNOW_ERROR_AGGREGATE_STICKING, point, sticking, sticking[i]);
    REFUSED(SNOW_ERROR_NOT_FINITE, point, sticking, NAN);
    REFUSED(SNOW_ERROR_NOT_FINITE, bath, interaction, INFINITY);
    REFUSED(SNOW_ERROR_AGGREGATE_HITS, point, hits, 0);
    REFUSED(SNOW_ERROR_AGGREGATE_HITS, point, hits, 65537);
    REFUSED(SNOW_ERROR_AGGREGATE_HITS, SNOW_AGGREGATE_SHORE, hits, 2);
    REFUSED(SNOW_ERROR_AGGREGATE_KILL, point, kill_radius, 2);
    REFUSED(SNOW_ERROR_AGGREGATE_LATTICE, bath, lattice, SNOW_AGGREGATE_CUBIC);
    REFUSED(SNOW_ERROR_AGGREGATE_LATTICE, free_particles, lattice, SNOW_AGGREGATE_HEXAGONAL);
    REFUSED(SNOW_ERROR_AGGREGATE_CONTACT, bath, contact, SNOW_AGGREGATE_ENTRY);
    REFUSED(SNOW_ERROR_AGGREGATE_ENGINE, bath, engine, SNOW_AGGREGATE_ENGINE_JUMPS);
    REFUSED(SNOW_ERROR_AGGREGATE_RADIUS, SNOW_AGGREGATE_LABORATORY, end_radius, 100);
    REFUSED(SNOW_ERROR_AGGREGATE_RADIUS, SNOW_AGGREGATE_LABORATORY, end_radius, 0);
    REFUSED(SNOW_ERROR_AGGREGATE_SIDES, SNOW_AGGREGATE_LINE, width, 0);
    REFUSED(SNOW_ERROR_AGGREGATE_SIDES, SNOW_AGGREGATE_LINE, height, (1 << 20) + 1);
    REFUSED(SNOW_ERROR_AGGREGATE_INTERACTION, bath, interaction, -0.5);
    REFUSED(SNOW_ERROR_AGGREGATE_INTERACTION, bath, interaction, 1025);
    REFUSED(SNOW_ERROR_AGGREGATE_LAUNCH, bath, launch_first, 256);
    REFUSED(SNOW_ERROR_AGGREGATE_LAUNCH, bath, launch_last, -1);
    REFUSED(SNOW_ERROR_AGGREGATE_HARDNESS, SNOW_AGGREGATE_SHORE, hardness_least, 4);
    REFUSED(SNOW_ERROR_AGGREGATE_HARDNESS, SNOW_AGGREGATE_SHORE, hardness_least, 0);
    REFUSED(SNOW_ERROR_AGGREGATE_HARDNESS, SNOW_AGGREGATE_SHORE, hardness_greatest, 65536);
    REFUSED(SNOW_ERROR_AGGREGATE_WALLS, SNOW_AGGREGATE_CHIMNEY, wall_right, 1);
    REFUSED(SNOW_ERROR_AGGREGATE_WALLS, SNOW_AGGREGATE_CHIMNEY, wall_left_top, 255);
    REFUSED(SNOW_ERROR_AGGREGATE_PARTICLES, free_particles, particles, 0);
    REFUSED(SNOW_ERROR_AGGREGATE_PARTICLES, free_particles, particles, (UINT64_C(1) << 24) + 1);
    REFUSED(SNOW_ERROR_AGGREGATE_PARTICLES, free_particles, particles, UINT64_MAX);
    REFUSED(SNOW_ERROR_AGGREGATE_DENSITY, free_particles, density, 0);
    REFUSED(SNOW_ERROR_AGGREGATE_DENSITY, free_particles, density, 0.51);
    REFUSED(SNOW_ERROR_AGGREGATE_MOBILITY, free_particles, mobility, -1);
    REFUSED(SNOW_ERROR_AGGREGATE_MOBILITY, free_particles, mobility, 4.5);
    REFUSED(SNOW_ERROR_NOT_FINITE, free_particles, density, NAN);
    REFUSED(SNOW_ERROR_NOT_FINITE, free_particles, mobility, INFINITY);
    REFUSED(SNOW_ERROR_NOT_FINITE, point, kill_radius, NAN);
    REFUSED(SNOW_ERROR_AGGREGATE_RADIUS, SNOW_AGGREGATE_LABORATORY, launch_radius, (1 << 20) + 1);
    REFUSED(SNOW_ERROR_AGGREGATE_WALLS, SNOW_AGGREGATE_CHIMNEY, wall_left, -1);
    REFUSED(SNOW_ERROR_AGGREGATE_WALLS, SNOW_AGGREGATE_CHIMNEY, wall_right_top, 256);
}

/* Members that are wrong together. */
static void members_that_do_not_fit_are_refused(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_ELECTROLYSIS);
    params.launch_first = 20;
    params.launch_last = 19;
    assert_refused(SNOW_ERROR_AGGREGATE_LAUNCH, &params);
    params = aggregate_scene(SNOW_AGGREGATE_LINE);
    params.periodic = 1;
    params.engine = SNOW_AGGREGATE_ENGINE_JUMPS;
    assert_refused(SNOW_ERROR_AGGREGATE_ENGINE, &params);
    params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    params.engine = SNOW_AGGREGATE_ENGINE_STEPS;
    params.kill_radius = 1;
    assert_refused(SNOW_ERROR_AGGREGATE_KILL, &params);
    params.engine = SNOW_AGGREGATE_ENGINE_JUMPS;
    params.kill_radius = 2;
    assert_refused(SNOW_ERROR_AGGREGATE_KILL, &params);
    params = aggregate_scene(SNOW_AGGREGATE_LINE);
    params.lattice = SNOW_AGGREGATE_CUBIC;
    params.depth = 0;
    assert_refused(SNOW_ERROR_AGGREGATE_SIDES, &params);
    params.depth = 1025;
    assert_refused(SNOW_ERROR_AGGREGATE_SIDES, &params);
    params.depth = 64;
    params.width = 1 << 19;
    assert_refused(SNOW_ERROR_AGGREGATE_SIDES, &params);
    params = aggregate_scene(SNOW_AGGREGATE_LABORATORY);
    params.lattice = SNOW_AGGREGATE_CUBIC;
    params.launch_radius = (1 << 17) + 1;
    assert_refused(SNOW_ERROR_AGGREGATE_RADIUS, &params);
}

static void seeds_and_obstacles_are_checked(void **state)
{
    (void)state;
    static const snow_site twice[] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
    static const snow_site far[] = {{INT32_MAX, 0, 0}};
    static const snow_site deep[] = {{0, 0, 1}};
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    params.seeds = twice;
    params.seed_count = 3;
    assert_refused(SNOW_ERROR_AGGREGATE_OVERLAP, &params);
    params.seed_count = 2;
    params.obstacles = twice;
    params.obstacle_count = 1;
    assert_refused(SNOW_ERROR_AGGREGATE_OVERLAP, &params);
    params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    params.seed_count = 1;
    params.seeds = far;
    assert_refused(SNOW_ERROR_AGGREGATE_SEED, &params);
    params.seeds = deep; /* in the plane */
    assert_refused(SNOW_ERROR_AGGREGATE_SEED, &params);
    params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    params.obstacle_count = 1;
    params.obstacles = far;
    assert_refused(SNOW_ERROR_AGGREGATE_OBSTACLE, &params);
    params = aggregate_scene(SNOW_AGGREGATE_SHORE);
    params.seeds = twice;
    params.seed_count = 2;
    assert_refused(SNOW_ERROR_AGGREGATE_SEED, &params);
    params = aggregate_scene(SNOW_AGGREGATE_CHIMNEY);
    static const snow_site wall[] = {{0, 3, 0}};
    params.seeds = wall;
    params.seed_count = 1;
    assert_refused(SNOW_ERROR_AGGREGATE_SEED, &params);
    params = aggregate_scene(SNOW_AGGREGATE_ELECTROLYSIS);
    params.obstacles = wall;
    params.obstacle_count = 1;
    assert_refused(SNOW_ERROR_AGGREGATE_OBSTACLE, &params);
    params = aggregate_scene(SNOW_AGGREGATE_LINE);
    static const snow_site beside[] = {{256, 3, 0}};
    params.obstacles = beside;
    params.obstacle_count = 1;
    assert_refused(SNOW_ERROR_AGGREGATE_OBSTACLE, &params);
    params.seeds = beside;
    params.seed_count = 1;
    params.obstacle_count = 0;
    assert_refused(SNOW_ERROR_AGGREGATE_SEED, &params);
}

/* Counts beyond every list: they are refused before the list is read. */
static void too_many_seeds_are_refused(void **state)
{
    (void)state;
    static const snow_site one = {0, 0, 0};
    static const size_t counts[] = {((size_t)1 << 26) + 1, SIZE_MAX};
    for (size_t i = 0; i < COUNT_OF(counts); i++) {
        snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
        params.seeds = &one;
        params.seed_count = counts[i];
        assert_refused(SNOW_ERROR_AGGREGATE_PARTICLES, &params);
        params.seed_count = 1;
        params.obstacles = &one;
        params.obstacle_count = counts[i];
        assert_refused(SNOW_ERROR_AGGREGATE_PARTICLES, &params);
    }
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    params.seeds = &one; /* a list without sites, where a seed is needed */
    params.seed_count = 0;
    assert_refused(SNOW_ERROR_AGGREGATE_SEED, &params);
}

static void a_cluster_that_is_walled_in_is_refused(void **state)
{
    (void)state;
    static const snow_site wall[] = {{2, 0, 0}, {1, 1, 0}, {0, 2, 0}, {-1, 1, 0}, {-2, 0, 0}, {-1, -1, 0}, {0, -2, 0},
                                     {1, -1, 0}};
    static const snow_aggregate_engine engines[] = {SNOW_AGGREGATE_ENGINE_JUMPS, SNOW_AGGREGATE_ENGINE_STEPS};
    for (size_t i = 0; i < COUNT_OF(engines); i++) {
        snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
        params.engine = engines[i];
        params.obstacles = wall;
        params.obstacle_count = COUNT_OF(wall);
        assert_refused(SNOW_ERROR_AGGREGATE_PATH, &params);
        params.obstacle_count--; /* a gap */
        snow_grid *grid = make_aggregate(&params, NULL);
        assert_ok(snow_step(grid, 1));
        snow_destroy(grid);
    }
}

static void a_blocked_launch_is_refused(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_LABORATORY);
    static const snow_site on_circle[] = {{100, 0, 0}};
    params.obstacles = on_circle;
    params.obstacle_count = 1;
    assert_refused(SNOW_ERROR_AGGREGATE_LAUNCH, &params);
    static const snow_site at_the_end[] = {{0, 90, 0}};
    params.seeds = at_the_end;
    params.seed_count = 1;
    params.obstacle_count = 0;
    assert_refused(SNOW_ERROR_AGGREGATE_LAUNCH, &params);

    params = aggregate_scene(SNOW_AGGREGATE_LINE);
    static const snow_site in_top_row[] = {{5, 255, 0}};
    params.seeds = in_top_row;
    params.seed_count = 1;
    assert_refused(SNOW_ERROR_AGGREGATE_LAUNCH, &params);

    static const snow_site row[] = {{4, 9, 0}, {5, 9, 0}, {6, 9, 0}};
    params = aggregate_scene(SNOW_AGGREGATE_ELECTROLYSIS);
    params.height = 10;
    params.launch_first = 4;
    params.launch_last = 6;
    params.seeds = row;
    params.seed_count = 3;
    assert_refused(SNOW_ERROR_AGGREGATE_LAUNCH, &params);
    params.launch_last = 7; /* one is free */
    snow_grid *grid = make_aggregate(&params, NULL);
    assert_ok(snow_step(grid, 1));
    snow_destroy(grid);

    static const snow_site foot[] = {{1, 0, 0}, {2, 0, 0}};
    params = aggregate_scene(SNOW_AGGREGATE_CHIMNEY);
    params.wall_right = params.wall_right_top = 3;
    params.seeds = foot;
    params.seed_count = 2;
    assert_refused(SNOW_ERROR_AGGREGATE_LAUNCH, &params);
}

/* A roof of obstacles from wall to wall. */
static void a_roof_over_the_vessel_is_refused(void **state)
{
    (void)state;
    snow_site roof[64];
    for (int lattice = SNOW_AGGREGATE_SQUARE; lattice <= SNOW_AGGREGATE_CUBIC; lattice++) {
        bool space = lattice == SNOW_AGGREGATE_CUBIC;
        bool lean = lattice == SNOW_AGGREGATE_HEXAGONAL;
        snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_LINE);
        params.lattice = (snow_aggregate_lattice)lattice;
        params.width = 8;
        params.depth = 8;
        params.height = 12;
        params.obstacles = roof;
        params.obstacle_count = space ? 64 : 8;
        for (int32_t i = 0; i < 64; i++)
            roof[i] = space ? (snow_site){i % 8, i / 8, 6} : (snow_site){i - (lean ? 3 : 0), 6, 0};
        static const snow_aggregate_engine engines[] = {SNOW_AGGREGATE_ENGINE_JUMPS, SNOW_AGGREGATE_ENGINE_STEPS};
        for (size_t k = 0; k < COUNT_OF(engines); k++) {
            params.engine = engines[k];
            assert_refused(SNOW_ERROR_AGGREGATE_PATH, &params);
            params.obstacle_count--; /* a gap */
            snow_grid *grid = make_aggregate(&params, NULL);
            assert_ok(snow_step(grid, 3));
            snow_destroy(grid);
            params.obstacle_count++;
        }
    }
}

/* The flood that looks for a way keeps to a box of 2^28 sites. */
static void obstacles_too_far_apart_are_refused(void **state)
{
    (void)state;
    static const snow_site far_apart[] = {{20000, 20000, 0}};
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    params.obstacles = far_apart;
    params.obstacle_count = 1;
    assert_refused(SNOW_ERROR_TOO_LARGE, &params);
}

/* Ions from the left end never come to a cathode at the right one. */
static void a_cathode_out_of_reach_is_refused(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_ELECTROLYSIS);
    params.height = 16;
    params.launch_first = 0;
    params.launch_last = 5;
    params.cathode_first = 100;
    assert_refused(SNOW_ERROR_AGGREGATE_PATH, &params);
}

static void other_models_have_no_particles(void **state)
{
    (void)state;
    snow_reiter_params crystal = disc_scene(0.4, 0.001, 1, 10);
    snow_grid *grid = make_grid(&crystal, NULL);
    uint64_t count = 7;
    size_t chances = 7;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    assert_status(SNOW_ERROR_UNSUPPORTED, snow_aggregate_particles(grid, &count));
    assert_status(SNOW_ERROR_UNSUPPORTED, snow_aggregate_growth(grid, NULL, 0, &chances));
    assert_status(SNOW_ERROR_UNSUPPORTED, snow_aggregate_sample(grid, 10, 1, NULL, 0, &chances));
    assert_status(SNOW_ERROR_UNSUPPORTED, snow_aggregate_params_of(grid, &params));
    assert_int_equal(7, count);
    assert_int_equal(7, chances);
    snow_destroy(grid);
}

static void chances_say_what_they_cannot_do(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    snow_grid *grid = make_aggregate(&params, NULL);
    size_t count = 0;
    snow_aggregate_chance chances[4];
    assert_status(SNOW_ERROR_NULL, snow_aggregate_growth(grid, NULL, 0, NULL));
    assert_status(SNOW_ERROR_NULL, snow_aggregate_growth(NULL, chances, 4, &count));
    assert_status(SNOW_ERROR_BUFFER, snow_aggregate_growth(grid, chances, 3, &count));
    assert_int_equal(4, count);
    assert_status(SNOW_ERROR_RANGE, snow_aggregate_sample(grid, 0, 1, chances, 4, &count));
    snow_destroy(grid);
    params.sticking = 0.5;
    grid = make_aggregate(&params, NULL);
    assert_status(SNOW_ERROR_UNSUPPORTED, snow_aggregate_growth(grid, chances, 4, &count));
    snow_destroy(grid);
    static snow_site line[5000];
    for (int32_t i = 0; i < 5000; i++)
        line[i] = (snow_site){i, 0, 0};
    params.sticking = 1;
    params.seeds = line;
    params.seed_count = COUNT_OF(line);
    grid = make_aggregate(&params, NULL);
    assert_status(SNOW_ERROR_TOO_LARGE, snow_aggregate_growth(grid, NULL, 0, &count));
    snow_destroy(grid);
    static const snow_site corners[] = {{0, 0, 0}, {4096, 4096, 0}}; /* a box of more than 2^24 sites */
    params.seeds = corners;
    params.seed_count = 2;
    grid = make_aggregate(&params, NULL);
    assert_status(SNOW_ERROR_TOO_LARGE, snow_aggregate_growth(grid, NULL, 0, &count));
    snow_destroy(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_the_documented_ones),
        cmocka_unit_test(every_preset_grows),
        cmocka_unit_test(pointers_and_structs_are_checked),
        cmocka_unit_test(numbers_out_of_range_are_refused),
        cmocka_unit_test(members_that_do_not_fit_are_refused),
        cmocka_unit_test(seeds_and_obstacles_are_checked),
        cmocka_unit_test(too_many_seeds_are_refused),
        cmocka_unit_test(a_cluster_that_is_walled_in_is_refused),
        cmocka_unit_test(a_roof_over_the_vessel_is_refused),
        cmocka_unit_test(obstacles_too_far_apart_are_refused),
        cmocka_unit_test(a_blocked_launch_is_refused),
        cmocka_unit_test(a_cathode_out_of_reach_is_refused),
        cmocka_unit_test(other_models_have_no_particles),
        cmocka_unit_test(chances_say_what_they_cannot_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
