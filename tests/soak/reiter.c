/* Reiter's model: the fast engine in several ways against the plain reading of the paper. */
#include "soak.h"

#include "../support/allocator.h"

#include <inttypes.h>

enum { MOST_SEEDS = 12, WAYS = 3 };

/* The reference first. */
typedef struct crystals {
    snow_grid *grid[WAYS];
    snow_options memory;
    int32_t extent; /* no cell of the interior lies farther from the origin, along rows and columns */
    bool large;     /* compared by digest alone */
    bool unstable;  /* the field has left its bounds */
} crystals;

/* Numbers that somebody would write, and others. */
static double any_number(uint64_t *random)
{
    switch (next_below(random, 6)) {
    case 0: return 0;
    case 1: return between(random, 0, 99) / 100.0;
    case 2: return between(random, 1, 99) / 10000.0;
    case 3: return between(random, 1, 9) / 1e9;
    case 4: return fraction(random) / 10;
    default: return fraction(random);
    }
}

/* A number for each cell that only the cell and the context decide. */
static double patchy(void *context, int32_t q, int32_t r)
{
    uint64_t state = *(const uint64_t *)context ^ ((uint64_t)(uint32_t)q << 32 | (uint32_t)r);
    (void)next_below(&state, 2);
    return between(&state, 0, 400) / 1000.0;
}

static void choose_domain(uint64_t *random, snow_reiter_params *params, crystals *all)
{
    all->large = one_in(random, 400);
    int32_t most = all->large ? 500 : one_in(random, 8) ? 110 : 35;
    int32_t least = all->large ? 450 : 1;
    params->domain = (snow_reiter_domain)between(random, SNOW_REITER_DISC, SNOW_REITER_RECTANGLE);
    params->radius = between(random, least, most);
    params->width = between(random, least, 2 * most);
    params->height = between(random, least, 2 * most);
    if (params->domain == SNOW_REITER_RECTANGLE && one_in(random, 4))
        params->rim = SNOW_REITER_RIM_ROW;
    bool round = params->domain != SNOW_REITER_RECTANGLE;
    all->extent = round ? params->radius : params->width + params->height;
}

static void choose_start(uint64_t *random, snow_reiter_params *params, snow_cell seeds[MOST_SEEDS])
{
    int32_t reach = params->domain == SNOW_REITER_RECTANGLE ? params->width / 4 : params->radius / 2;
    switch (next_below(random, 4)) {
    case 0:
        params->cluster = between(random, 1, reach / 2 + 1);
        break;
    case 1:
        params->seeds = seeds;
        params->seed_count = next_below(random, MOST_SEEDS + 1);
        for (size_t i = 0; i < params->seed_count; i++)
            seeds[i] = (snow_cell){between(random, -reach, reach), between(random, -reach, reach) / 2};
        break;
    default:
        break;
    }
    if (one_in(random, 3)) {
        double room = params->background < 0.5 ? params->background : 0.999 - params->background;
        params->noise = room * fraction(random);
        params->noise_symmetric = between(random, 0, 1);
    }
}

static void choose_scene(uint64_t *random, snow_reiter_params *params, crystals *all, snow_cell seeds[MOST_SEEDS])
{
    snow_reiter_params_init(params, sizeof *params);
    choose_domain(random, params, all);
    params->background = any_number(random);
    params->addition = one_in(random, 20) ? 1 : any_number(random);
    params->diffusion = one_in(random, 2) ? 1 : SNOW_REITER_STABLE_DIFFUSION * fraction(random);
    if (one_in(random, 12)) {
        params->allow_unstable = 1;
        params->diffusion = 2.6 + 1.4 * fraction(random);
    }
    choose_start(random, params, seeds);
    params->random_seed = next_below(random, UINT32_MAX);
    params->record_freeze_steps = between(random, 0, 1);
    if (one_in(random, 3))
        params->precision = SNOW_REITER_PRECISION_SINGLE;
    if (one_in(random, 8)) {
        params->background_at = patchy;
        params->noise = 0;
    }
    if (one_in(random, 8))
        params->addition_at = patchy;
    say("domain %d, radius %d, %d x %d; background %.17g%s, addition %.17g%s, diffusion %.17g, noise %g; cluster %d, "
        "%zu seeds, precision %d",
        (int)params->domain, params->radius, params->width, params->height, params->background,
        params->background_at != NULL ? " (patchy)" : "", params->addition,
        params->addition_at != NULL ? " (patchy)" : "", params->diffusion, params->noise, params->cluster,
        params->seed_count, (int)params->precision);
}

/* False when the scene is one that cannot be, for all engines alike. */
static bool create(uint64_t *random, snow_reiter_params *params, crystals *all)
{
    params->engine = SNOW_REITER_ENGINE_REFERENCE;
    snow_status status = snow_reiter_create(params, &all->memory, &all->grid[0]);
    for (size_t i = 1; i < WAYS; i++) {
        params->engine = one_in(random, 2) ? SNOW_REITER_ENGINE_AUTO : SNOW_REITER_ENGINE_ROWS;
        params->symmetry = one_in(random, 3) ? SNOW_REITER_SYMMETRY_NONE : SNOW_REITER_SYMMETRY_AUTO;
        snow_options options = any_options(random, &all->memory);
        say("grid %zu: engine %d, symmetry %d, instruction set %d, %d threads", i, (int)params->engine,
            (int)params->symmetry, (int)options.isa, options.threads);
        assert_status(status, snow_reiter_create(params, &options, &all->grid[i]));
    }
    return status == SNOW_OK;
}

static void step(uint64_t *random, crystals *all)
{
    int64_t steps = between(random, 0, all->large ? 20 : 60);
    say("%" PRId64 " steps", steps);
    snow_status status = snow_step(all->grid[0], steps);
    assert_true(status == SNOW_OK || status == SNOW_ERROR_UNSTABLE);
    all->unstable = status != SNOW_OK;
    for (size_t i = 1; i < WAYS; i++)
        assert_status(status, snow_step(all->grid[i], steps));
}

static void change(uint64_t *random, crystals *all)
{
    snow_reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    assert_ok(snow_reiter_conditions_of(all->grid[0], &conditions));
    if (one_in(random, 2))
        conditions.background = any_number(random);
    if (one_in(random, 2))
        conditions.addition = any_number(random);
    if (one_in(random, 3))
        conditions.diffusion = SNOW_REITER_STABLE_DIFFUSION * fraction(random);
    conditions.rescale = between(random, 0, 1);
    snow_status status = snow_reiter_change(all->grid[0], &conditions);
    say("change to background %.17g, addition %.17g, diffusion %.17g, rescale %d: %s", conditions.background,
        conditions.addition, conditions.diffusion, conditions.rescale, snow_strerror(status));
    for (size_t i = 1; i < WAYS; i++)
        assert_status(status, snow_reiter_change(all->grid[i], &conditions));
}

static void set(uint64_t *random, crystals *all)
{
    static const snow_field fields[] = {SNOW_FIELD_VALUE, SNOW_FIELD_VAPOUR, SNOW_FIELD_ADDITION,
                                        SNOW_FIELD_BACKGROUND};
    enum { SIDE = 9 };
    double values[SIDE * SIDE];
    snow_field field = fields[next_below(random, COUNT_OF(fields))];
    snow_rect rect = {between(random, -all->extent, all->extent), between(random, -all->extent, all->extent),
                      between(random, 0, SIDE), between(random, 0, SIDE)};
    size_t count = (size_t)rect.width * (size_t)rect.height;
    for (size_t i = 0; i < count; i++)
        values[i] = field == SNOW_FIELD_VALUE && one_in(random, 5) ? 1 + fraction(random) : 0.99 * fraction(random);
    snow_status status = snow_field_set(all->grid[0], field, &rect, values, count);
    say("set field %d of %d x %d cells from (%d, %d) on: %s", (int)field, rect.width, rect.height, rect.q, rect.r,
        snow_strerror(status));
    for (size_t i = 1; i < WAYS; i++)
        assert_status(status, snow_field_set(all->grid[i], field, &rect, values, count));
}

static void act(uint64_t *random, crystals *all)
{
    switch (next_below(random, 10)) {
    case 0:
        change(random, all);
        break;
    case 1:
        set(random, all);
        break;
    case 2: {
        snow_options options = any_options(random, &all->memory);
        size_t which = next_below(random, WAYS);
        say("save and load grid %zu", which);
        save_and_load(&all->grid[which], &options);
        break;
    }
    case 3: {
        snow_stop stop = any_stop(random, all->large ? 20 : 200, steps_of(all->grid[0]));
        run_alike(all->grid, WAYS, &stop);
        break;
    }
    default:
        step(random, all);
    }
}

static void compare(uint64_t *random, const crystals *all)
{
    for (size_t i = 1; i < WAYS; i++) {
        if (all->large)
            assert_true(digest_of(all->grid[0]) == digest_of(all->grid[i]));
        else
            assert_same_grids(all->grid[0], all->grid[i]);
        if (one_in(random, 6))
            assert_same_measures(all->grid[0], all->grid[i], random);
    }
}

void soak_reiter(uint64_t *random)
{
    test_allocator allocator = {0};
    crystals all = {.memory = allocator_options(&allocator)};
    snow_reiter_params params;
    snow_cell seeds[MOST_SEEDS];
    choose_scene(random, &params, &all, seeds);
    uint64_t patches = next_below(random, UINT32_MAX);
    params.field_context = &patches;
    if (create(random, &params, &all)) {
        compare(random, &all);
        for (int32_t rounds = between(random, 1, all.large ? 3 : 8); rounds > 0 && !all.unstable; rounds--) {
            act(random, &all);
            compare(random, &all);
        }
        for (size_t i = 0; i < WAYS; i++)
            snow_destroy(all.grid[i]);
    }
    assert_int_equal(0, allocator.live_blocks);
}
