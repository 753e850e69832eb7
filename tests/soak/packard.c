/* Packard's model: tiles, quadtree and the library's choice against a plain reading of the rule. */
#include "soak.h"

#include "../support/allocator.h"
#include "../support/packard.h"

#include <inttypes.h>
#include <stdlib.h>

enum { MOST_GRIDS = 4, MOST_SEEDS = 8 };

static const snow_packard_engine engines[MOST_GRIDS] = {SNOW_PACKARD_ENGINE_REFERENCE, SNOW_PACKARD_ENGINE_TILES,
                                                        SNOW_PACKARD_ENGINE_AUTO, SNOW_PACKARD_ENGINE_QUADTREE};

typedef struct crystals {
    snow_grid *grid[MOST_GRIDS];
    size_t count;
    snow_options memory;
    bool long_run; /* without the reference */
} crystals;

static bool suits(snow_packard_engine engine, const snow_packard_params *params, bool long_run)
{
    if (engine == SNOW_PACKARD_ENGINE_QUADTREE)
        return params->domain == SNOW_PACKARD_PLANE && !params->record_freeze_steps;
    return engine != SNOW_PACKARD_ENGINE_REFERENCE || !long_run;
}

static void create(uint64_t *random, snow_packard_params *params, crystals *all)
{
    for (size_t i = 0; i < MOST_GRIDS; i++) {
        if (!suits(engines[i], params, all->long_run))
            continue;
        params->engine = engines[i];
        snow_options options = any_options(random, &all->memory);
        say("grid %zu: engine %d, instruction set %d, %d threads", all->count, (int)engines[i], (int)options.isa,
            options.threads);
        all->grid[all->count++] = make_packard(params, &options);
    }
}

static void choose_scene(uint64_t *random, snow_packard_params *params, crystals *all, snow_cell seeds[MOST_SEEDS])
{
    *params = random_packard_scene(random, seeds);
    if (params->seeds == NULL && one_in(random, 2)) {
        params->cluster = between(random, 1, params->domain == SNOW_PACKARD_PLANE ? 12 : 3);
        params->random_seed = next_below(random, UINT32_MAX);
    }
    params->record_freeze_steps = one_in(random, 3);
    all->long_run = one_in(random, 25);
    if (all->long_run) {
        params->domain = SNOW_PACKARD_PLANE;
        params->rule = (params->rule & 0x7C) | 2;
        params->record_freeze_steps = 0;
    }
    bool bounded = params->domain != SNOW_PACKARD_PLANE;
    if (bounded && params->seeds == NULL && params->cluster == 0 && one_in(random, 3)) {
        params->scatter = between(random, 1, 20);
        params->scatter_side = between(random, 7, 60);
        params->random_seed = next_below(random, UINT32_MAX);
    }
    say("rule %#x, domain %d, radius %d, %d x %d; cluster %d, scatter %d, %zu seeds; freeze steps %d", params->rule,
        (int)params->domain, params->radius, params->width, params->height, params->cluster, params->scatter,
        params->seed_count, params->record_freeze_steps);
}

static void step(uint64_t *random, crystals *all)
{
    int64_t steps = between(random, 0, all->long_run ? 250 : 40);
    say("%" PRId64 " steps", steps);
    for (size_t i = 0; i < all->count; i++)
        assert_ok(snow_step(all->grid[i], steps));
}

static void set(uint64_t *random, crystals *all)
{
    enum { SIDE = 9 };
    double values[SIDE * SIDE];
    snow_rect rect = {between(random, -30, 30), between(random, -30, 30), between(random, 0, SIDE),
                      between(random, 0, SIDE)};
    size_t count = (size_t)rect.width * (size_t)rect.height;
    for (size_t i = 0; i < count; i++)
        values[i] = one_in(random, 3);
    snow_field field = one_in(random, 2) ? SNOW_FIELD_VALUE : SNOW_FIELD_FROZEN;
    say("set field %d of %d x %d cells from (%d, %d) on", (int)field, rect.width, rect.height, rect.q, rect.r);
    for (size_t i = 0; i < all->count; i++)
        assert_ok(snow_field_set(all->grid[i], field, &rect, values, count));
}

/* A pattern keeps the frozen cells and the rule. */
static void write_and_read_pattern(const crystals *all)
{
    say("write and read a pattern");
    const snow_grid *grid = all->grid[0];
    size_t size = 0;
    assert_ok(snow_packard_save_rle(grid, NULL, 0, &size));
    char *text = malloc(size);
    assert_non_null(text);
    assert_ok(snow_packard_save_rle(grid, text, size, &size));
    snow_grid *read = NULL;
    snow_status status = snow_packard_load_rle(text, size, NULL, &all->memory, &read);
    free(text);
    if (status == SNOW_ERROR_PACKARD_BIRTH) /* the rule is for bounded domains, which the text does not tell */
        return;
    assert_ok(status);
    assert_int_equal(steps_of(grid), steps_of(read));
    assert_int_equal(frozen_of(grid), frozen_of(read));
    snow_rect rect = bounds_of(grid);
    size_t count;
    double *left = copy_field(grid, SNOW_FIELD_FROZEN, &rect, &count);
    double *right = copy_field(read, SNOW_FIELD_FROZEN, &rect, NULL);
    assert_memory_equal(left, right, count * sizeof *left);
    free(left);
    free(right);
    snow_destroy(read);
}

static void act(uint64_t *random, crystals *all)
{
    switch (next_below(random, 10)) {
    case 0:
        say("zones");
        add_random_zones(random, all->grid, all->count);
        break;
    case 1:
        set(random, all);
        break;
    case 2: {
        snow_options options = any_options(random, &all->memory);
        size_t which = next_below(random, (uint32_t)all->count);
        say("save and load grid %zu", which);
        save_and_load(&all->grid[which], &options);
        break;
    }
    case 3: {
        snow_stop stop = any_stop(random, 100, steps_of(all->grid[0]));
        run_alike(all->grid, all->count, &stop);
        break;
    }
    case 4:
        write_and_read_pattern(all);
        break;
    default:
        step(random, all);
    }
}

static void compare(uint64_t *random, const crystals *all)
{
    for (size_t i = 1; i < all->count; i++) {
        if (all->long_run)
            assert_true(digest_of(all->grid[0]) == digest_of(all->grid[i]));
        else
            assert_same_crystals(all->grid[0], all->grid[i]);
        if (one_in(random, 6))
            assert_same_measures(all->grid[0], all->grid[i], random);
    }
}

void soak_packard(uint64_t *random)
{
    test_allocator allocator = {0};
    crystals all = {.memory = allocator_options(&allocator)};
    snow_packard_params params;
    snow_cell seeds[MOST_SEEDS];
    choose_scene(random, &params, &all, seeds);
    create(random, &params, &all);
    for (int32_t rounds = between(random, 1, all.long_run ? 3 : 8); rounds > 0; rounds--) {
        act(random, &all);
        compare(random, &all);
    }
    for (size_t i = 0; i < all.count; i++)
        snow_destroy(all.grid[i]);
    assert_int_equal(0, allocator.live_blocks);
}
