/*
 * Which engine takes the next steps.
 *
 * Work is measured in cells of area, as the tiles have it: what they do in a
 * run grows with the area that the crystal comes to fill. Of the quadtree what
 * counts is what it must remember, and that is known only afterwards. So it is
 * given a few steps, then as many again, and so on, while it is watched what
 * each doubling of the crystal takes; that is carried forward. When it stays
 * well below what the tiles would need, the quadtree gets the rest; when it has
 * had its share and does not, it is left. No clock is read: the choice is the
 * same every time.
 */
#include "packard/model.h"

#include <math.h>

/* The tiles fill so many cells while the quadtree makes a node or finds a result. */
static const double cells_a_node = 160;

/* Making the quadtree of a crystal that stands takes so much for each frozen
   cell, or for each cell of the hexagon, whichever is less. */
static const double start_for_frozen = 3e5;
static const double start_for_area = 5;

/* These parts of what the tiles would have to do may be spent on making the
   quadtree, and on trying it. */
static const double start_share = 0.2;
static const double trial_share = 0.08;

/* Below this the tiles are through before the quadtree can show what it is good for. */
static const double least_work = 3e6;

/* The trial ends early when the quadtree will need only this part of what the tiles need. */
static const double clear_share = 0.5;

/* From one doubling to the next its work is taken to grow by a factor between these. */
static const double least_growth = 1.05;
static const double greatest_growth = 8;

/* What counts as twice the size. */
static const double doubled = 1.9;

enum {
    FIRST_TRIAL = 64, /* steps */
    FEW_STEPS = 256
};

/* Where it was left, it is tried again for so much larger crystals. */
static const double second_chance = 8;

/* Crystals farther out are not taken from the quadtree to the tiles. So they
   are not taken to it either, unless they would keep the tiles busy for hours. */
static const int64_t greatest_reach = INT64_C(1) << 22;
static const double hopeless_work = 1e15;

static bool fits_tiles(const snow_grid *grid)
{
    packard_region bounds = snow_packard_bounds(grid);
    return bounds.width <= 2 * greatest_reach && bounds.height <= 2 * greatest_reach;
}

static snow_status use(snow_grid *grid, const packard_engine *engine)
{
    packard *model = packard_of(grid);
    if (model->engine == engine)
        return SNOW_OK;
    if (engine == &snow_packard_tiles && !fits_tiles(grid))
        return SNOW_ERROR_TOO_LARGE;
    return snow_packard_convert(grid, engine);
}

/* Cells of a hexagon round the crystal after so many steps more. */
static double area_after(const snow_grid *grid, int64_t steps)
{
    packard_region bounds = snow_packard_bounds(grid);
    double grown = 2 * (double)steps;
    return 0.75 * ((double)bounds.width + grown) * ((double)bounds.height + grown);
}

static double tile_work(const snow_grid *grid, int64_t steps)
{
    double area = area_after(grid, steps) - area_after(grid, 0);
    return area / (packard_of(grid)->fold.possible ? 12 : 1) / grid->options.threads;
}

static double start_work(const snow_grid *grid)
{
    double by_frozen = start_for_frozen * (double)snow_census_frozen(&grid->census);
    double by_area = start_for_area * area_after(grid, 0);
    return by_frozen < by_area ? by_frozen : by_area;
}

/* Of bounded domains, zones and freeze steps the quadtree knows nothing. */
static bool suits_quadtree(const snow_grid *grid)
{
    const packard *model = packard_of(grid);
    return packard_is_plane(model) && !model->params.record_freeze_steps &&
           !snow_packard_zones_apply(model, grid->census.steps + 1);
}

/* As far as the crystal can reach, from its middle. */
static double size_of(const snow_grid *grid)
{
    packard_region bounds = snow_packard_bounds(grid);
    return 0.5 * (double)(bounds.width > bounds.height ? bounds.width : bounds.height);
}

static bool is_worth_a_trial(const snow_grid *grid, int64_t ahead)
{
    const packard_trial *trial = &packard_of(grid)->trial;
    double work = tile_work(grid, ahead);
    bool may_come_back = work >= hopeless_work || fits_tiles(grid);
    return work >= least_work && may_come_back && start_share * work >= start_work(grid) &&
           size_of(grid) + (double)ahead >= second_chance * trial->left_for;
}

static snow_status begin_trial(snow_grid *grid)
{
    snow_status status = use(grid, &snow_packard_quadtree);
    if (status == SNOW_OK)
        packard_of(grid)->trial = (packard_trial){.first_step = grid->census.steps, .first_size = size_of(grid)};
    return status;
}

/* To base 2, near enough, and the same on every machine: a straight line from each power to the next. */
static double logarithm(double x)
{
    int exponent;
    double part = frexp(x, &exponent);
    return exponent - 2 + 2 * part;
}

static double power(double base, double exponent)
{
    double result = exponent * logarithm(base);
    return ldexp(1 + result - floor(result), (int)floor(result));
}

/* Notes what the quadtree has done. Whether that is enough to see how its work grows. */
static bool look(const snow_grid *grid, packard_trial *trial)
{
    const packard *model = packard_of(grid);
    packard_effort *mark = trial->mark;
    trial->now = (packard_effort){trial->first_size + (double)(grid->census.steps - trial->first_step),
                                  cells_a_node * (double)snow_packard_tree_work(model->cells)};
    if (trial->now.size >= doubled * mark[0].size) {
        mark[2] = mark[1];
        mark[1] = mark[0];
        mark[0] = trial->now;
    }
    return mark[2].size > 0;
}

/* What a doubling of the size took. */
static double effort_between(const packard_effort *before, const packard_effort *after)
{
    return (after->work - before->work) / logarithm(after->size / before->size);
}

/* What the quadtree will do in the steps ahead, if from one doubling to the next its work grows as it did. */
static double tree_work(const packard_trial *trial, int64_t ahead)
{
    const packard_effort *mark = trial->mark;
    double last = effort_between(&mark[1], &mark[0]);
    double before = effort_between(&mark[2], &mark[1]);
    double ratio = last > 0 && before > 0 ? last / before : 1;
    double growth = power(ratio, 1 / logarithm(mark[0].size / mark[1].size));
    growth = growth < least_growth ? least_growth : growth > greatest_growth ? greatest_growth : growth;
    double doublings = logarithm((trial->now.size + (double)ahead) / mark[0].size);
    double sum = growth * (power(growth, doublings) - 1) / (growth - 1);
    return mark[0].work + last * sum - trial->now.work;
}

/* Tries the quadtree, or goes on with it: *steps of those ahead. */
static snow_status use_quadtree(snow_grid *grid, int64_t ahead, int64_t *steps)
{
    packard_trial *trial = &packard_of(grid)->trial;
    int64_t taken = grid->census.steps - trial->first_step;
    bool informed = taken > 0 && look(grid, trial);
    double tiles = tile_work(grid, ahead);
    double tree = informed ? tree_work(trial, ahead) : 0;
    if (informed && tree > tiles && trial->now.work >= trial_share * tiles && fits_tiles(grid)) {
        trial->left_for = trial->now.size + (double)ahead;
        return use(grid, &snow_packard_tiles);
    }
    trial->passed = trial->passed || (informed && tree <= clear_share * tiles);
    int64_t chunk = taken < FIRST_TRIAL ? FIRST_TRIAL : taken;
    if (!trial->passed && chunk < *steps)
        *steps = chunk;
    return SNOW_OK;
}

static snow_status choose_freely(snow_grid *grid, int64_t ahead, int64_t *steps)
{
    packard *model = packard_of(grid);
    bool tree = model->engine == &snow_packard_quadtree;
    bool few = ahead < FEW_STEPS && area_after(grid, 0) < least_work;
    if (!suits_quadtree(grid))
        return use(grid, &snow_packard_tiles);
    if (!tree && !is_worth_a_trial(grid, ahead))
        return SNOW_OK;
    if (tree && few)
        return use(grid, &snow_packard_tiles);
    snow_status status = tree ? SNOW_OK : begin_trial(grid);
    return status == SNOW_OK ? use_quadtree(grid, ahead, steps) : status;
}

snow_status snow_packard_choose(snow_grid *grid, int64_t ahead, int64_t *steps)
{
    const packard *model = packard_of(grid);
    bool zones = snow_packard_zones_apply(model, grid->census.steps + 1);
    switch (model->params.engine) {
    case SNOW_PACKARD_ENGINE_REFERENCE:
    case SNOW_PACKARD_ENGINE_TILES: return SNOW_OK;
    case SNOW_PACKARD_ENGINE_QUADTREE: return use(grid, zones ? &snow_packard_tiles : &snow_packard_quadtree);
    case SNOW_PACKARD_ENGINE_AUTO: break;
    }
    return choose_freely(grid, ahead, steps);
}
