/* Aggregation: the same cluster for every number of threads, instruction set, loop, cut of the steps and detour over a
   saved grid; and the same law from jumps and from single steps. */
#include "soak.h"

#include "../support/aggregates.h"
#include "../support/allocator.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { WAYS = 3, MOST_OBSTACLES = 6 };

typedef struct clusters {
    snow_grid *grid[WAYS];
    snow_options memory;
    bool full; /* nothing more can join */
} clusters;

/* Gyration radii squared of small clusters by one engine. */
typedef struct sample {
    double count, sum, squares;
} sample;

static sample by_jumps, by_steps;

static void choose_scene(uint64_t *random, snow_aggregate_params *params, snow_site obstacles[MOST_OBSTACLES])
{
    *params = aggregate_kind(next_below(random, (uint32_t)aggregate_kind_count));
    params->random_seed = next_below(random, UINT32_MAX);
    params->record_order = between(random, 0, 1);
    if (one_in(random, 3))
        params->sticking = 0.2 + 0.8 * fraction(random);
    if (one_in(random, 4))
        params->hits = between(random, 1, 4);
    if (one_in(random, 3))
        params->contact = SNOW_AGGREGATE_ENTRY;
    params->width = between(random, 12, 80);
    params->height = between(random, 12, 80);
    params->depth = between(random, 4, 20);
    params->wall_right = params->wall_right_top = params->width - 1;
    params->periodic = between(random, 0, 1);
    params->interaction = between(random, 0, 4);
    params->hardness_greatest = between(random, 1, 9);
    params->particles = (uint64_t)between(random, 2, 400);
    params->density = 0.02 + 0.3 * fraction(random);
    params->mobility = 2 * fraction(random);
    bool takes_obstacles =
        params->scene == SNOW_AGGREGATE_WITTEN_SANDER || params->scene == SNOW_AGGREGATE_LABORATORY;
    if (takes_obstacles && one_in(random, 4)) {
        params->obstacles = obstacles;
        params->obstacle_count = next_below(random, MOST_OBSTACLES + 1);
        for (size_t i = 0; i < params->obstacle_count; i++)
            obstacles[i] = (snow_site){between(random, 2, 12), between(random, -12, 12), 0};
    }
    say("scene %d, lattice %d, contact %d, engine %d; seed %" PRIu64 ", sticking %g, hits %d; %d x %d x %d, periodic "
        "%d; %" PRIu64 " particles, density %g, mobility %g; %zu obstacles, order %d",
        (int)params->scene, (int)params->lattice, (int)params->contact, (int)params->engine, params->random_seed,
        params->sticking, params->hits, params->width, params->height, params->depth, params->periodic,
        params->particles, params->density, params->mobility, params->obstacle_count, params->record_order);
}

/* False when the scene is one that cannot be. */
static bool create(uint64_t *random, const snow_aggregate_params *params, clusters *all)
{
    snow_status status = snow_aggregate_create(params, &all->memory, &all->grid[0]);
    for (size_t i = 1; i < WAYS; i++) {
        snow_options options = any_options(random, &all->memory);
        say("grid %zu: instruction set %d, %d threads", i, (int)options.isa, options.threads);
        assert_status(status, snow_aggregate_create(params, &options, &all->grid[i]));
    }
    return status == SNOW_OK;
}

/* In one go, and in two. */
static void step(uint64_t *random, clusters *all)
{
    int64_t steps = between(random, 0, 60), first = between(random, 0, (int32_t)steps);
    say("%" PRId64 " steps", steps);
    snow_status status = snow_step(all->grid[0], steps);
    all->full = status != SNOW_OK;
    for (size_t i = 1; i < WAYS; i++) {
        snow_status part = snow_step(all->grid[i], first);
        assert_status(status, part == SNOW_OK ? snow_step(all->grid[i], steps - first) : part);
    }
}

static void act(uint64_t *random, clusters *all)
{
    switch (next_below(random, 6)) {
    case 0: {
        snow_options options = any_options(random, &all->memory);
        size_t which = next_below(random, WAYS);
        say("save and load grid %zu", which);
        save_and_load(&all->grid[which], &options);
        break;
    }
    case 1: {
        snow_stop stop = any_stop(random, 60, steps_of(all->grid[0]));
        run_alike(all->grid, WAYS, &stop);
        break;
    }
    default:
        step(random, all);
    }
}

static snow_point *copy_points(const snow_grid *grid, size_t *count)
{
    uint64_t particles = 0;
    assert_ok(snow_aggregate_particles(grid, &particles));
    *count = (size_t)particles;
    snow_point *points = calloc(*count + 1, sizeof *points);
    assert_non_null(points);
    assert_ok(snow_aggregate_points(grid, 0, points, *count));
    return points;
}

static void assert_same_parents(const snow_grid *expected, const snow_grid *got, size_t count)
{
    int64_t *left = calloc(count + 1, sizeof *left), *right = calloc(count + 1, sizeof *right);
    assert_non_null(left);
    assert_non_null(right);
    snow_status status = snow_aggregate_parents(expected, left, count, NULL);
    assert_status(status, snow_aggregate_parents(got, right, count, NULL));
    assert_memory_equal(left, right, count * sizeof *left);
    free(left);
    free(right);
}

static void assert_same_clusters(const snow_grid *expected, const snow_grid *got)
{
    size_t count, again;
    snow_point *left = copy_points(expected, &count), *right = copy_points(got, &again);
    assert_int_equal(count, again);
    assert_memory_equal(left, right, count * sizeof *left);
    free(left);
    free(right);
    uint64_t one = 0, other = 0;
    assert_ok(snow_aggregate_walkers(expected, &one));
    assert_ok(snow_aggregate_walkers(got, &other));
    assert_int_equal(one, other);
    assert_int_equal(steps_of(expected), steps_of(got));
    assert_int_equal(frozen_of(expected), frozen_of(got));
    assert_same_double(tip_of(expected), tip_of(got));
    assert_status(snow_digest(expected, &one), snow_digest(got, &other));
    assert_int_equal(one, other);
    assert_same_parents(expected, got, count);
}

static void grow_alike(uint64_t *random, const snow_aggregate_params *params)
{
    test_allocator allocator = {0};
    clusters all = {.memory = allocator_options(&allocator)};
    if (create(random, params, &all)) {
        for (int32_t rounds = between(random, 1, 8); rounds > 0 && !all.full; rounds--) {
            act(random, &all);
            for (size_t i = 1; i < WAYS; i++)
                assert_same_clusters(all.grid[0], all.grid[i]);
        }
        for (size_t i = 0; i < WAYS; i++)
            snow_destroy(all.grid[i]);
    }
    assert_int_equal(0, allocator.live_blocks);
}

static void add_cluster(uint64_t *random, snow_aggregate_engine engine, sample *to)
{
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    params.engine = engine;
    params.random_seed = (uint64_t)next_below(random, UINT32_MAX) << 32 | next_below(random, UINT32_MAX);
    snow_grid *grid = make_aggregate(&params, NULL);
    const uint64_t mass = 40;
    double radius = 0;
    assert_ok(snow_step(grid, (int64_t)mass));
    assert_ok(snow_aggregate_gyration(grid, &mass, &radius, 1));
    snow_destroy(grid);
    to->count++;
    to->sum += radius * radius;
    to->squares += radius * radius * radius * radius;
}

void soak_aggregate(uint64_t *random)
{
    if (one_in(random, 4)) {
        say("a cluster by jumps and one by single steps");
        add_cluster(random, SNOW_AGGREGATE_ENGINE_JUMPS, &by_jumps);
        add_cluster(random, SNOW_AGGREGATE_ENGINE_STEPS, &by_steps);
        return;
    }
    snow_aggregate_params params;
    snow_site obstacles[MOST_OBSTACLES];
    choose_scene(random, &params, obstacles);
    grow_alike(random, &params);
}

static double mean_of(const sample *of)
{
    return of->sum / of->count;
}

static double error_of(const sample *of)
{
    return sqrt((of->squares / of->count - mean_of(of) * mean_of(of)) / of->count);
}

void soak_judge_law(void)
{
    if (by_jumps.count < 30)
        return;
    double errors = (mean_of(&by_jumps) - mean_of(&by_steps)) / hypot(error_of(&by_jumps), error_of(&by_steps));
    printf("law       %.0f clusters of 40 particles by jumps and by steps: mean squared gyration %.4f and %.4f, %.2f "
           "standard errors apart\n",
           by_jumps.count, mean_of(&by_jumps), mean_of(&by_steps), errors);
    assert_true(fabs(errors) < 5);
}
