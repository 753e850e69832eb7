/*
 * Which engine takes the next steps.
 *
 * Work is measured in cells of area, as the tiles have it: what they do in a
 * run grows with the area that the crystal comes to fill. Of the quadtree what
 * counts is what it must remember, and that is known only afterwards; so it is
 * given steps up to the next power of two at a time, and what these have taken
 * is carried forward. No clock is read: the choice is the same every time.
 */
#include "packard/model.h"

/* The tiles fill so many cells while the quadtree makes a node. */
static const double cells_a_node = 330;

/* Until it can be judged it has this to do: for each frozen cell, or for each
   cell of the hexagon, whichever is less; and it may be this part of what the
   tiles have to do. */
static const double start_for_frozen = 3e5;
static const double start_for_area = 5;
static const double start_share = 0.2;

/* Below this the tiles are through before the quadtree can show what it is good for. */
static const double least_work = 3e6;

/* The quadtree is left when it seems to take this much longer than the tiles would. */
static const double patience = 1.2;

enum {
    FIRST_CHUNK = 16,
    FIRST_LOOK = 256, /* no quadtree is judged by fewer steps */
    FEW_STEPS = 256
};

/* Crystals farther out are not taken from the quadtree to the tiles. */
static const int64_t greatest_reach = INT64_C(1) << 22;

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
    model->watched = false;
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
    return packard_is_plane(model) && !model->params.record_freeze_steps && !model->left_quadtree &&
           !snow_packard_zones_apply(model, grid->census.steps + 1);
}

/* What the quadtree will do if its work goes on growing from one doubling of
   the steps to the next as it did, less and less: as a power of their number. */
static double projected_work(const packard *model, int64_t done, int64_t steps)
{
    double growth = model->work_before > 0 ? model->work / model->work_before : 2;
    growth = growth < 1.1 ? 1.1 : growth > 4 ? 4 : growth;
    double doublings = 0;
    for (double end = 1; end < (double)done; end *= 2)
        doublings++;
    double chunk = model->work;
    double total = 0;
    double number = doublings;
    for (double end = (double)done; end < (double)done + (double)steps; end *= 2) {
        number++;
        chunk *= 1 + (growth - 1) * doublings / number;
        total += chunk;
    }
    return total;
}

/* Looks at what the last steps took of the quadtree; whether it is to go on. */
static bool goes_on(snow_grid *grid, int64_t steps)
{
    packard *model = packard_of(grid);
    if (model->watched) {
        model->work_before = model->work;
        model->work = cells_a_node * (double)(snow_packard_tree_work(model->cells) - model->nodes);
    }
    if (!model->watched || grid->census.steps < FIRST_LOOK || !fits_tiles(grid))
        return true;
    return projected_work(model, grid->census.steps, steps) <= patience * tile_work(grid, steps);
}

static void watch(snow_grid *grid)
{
    packard *model = packard_of(grid);
    if (!model->watched)
        model->work = model->work_before = 0;
    model->watched = true;
    model->nodes = snow_packard_tree_work(model->cells);
}

/* Steps up to the next power of two. */
static int64_t chunk_after(int64_t done)
{
    int64_t end = FIRST_CHUNK;
    while (end <= done)
        end *= 2;
    return end - done;
}

static snow_status choose_freely(snow_grid *grid, int64_t *steps)
{
    packard *model = packard_of(grid);
    bool tree = model->engine == &snow_packard_quadtree;
    if (!suits_quadtree(grid))
        return use(grid, &snow_packard_tiles);
    if (!tree && (tile_work(grid, *steps) < least_work || start_share * tile_work(grid, *steps) < start_work(grid)))
        return SNOW_OK;
    if (tree && *steps < FEW_STEPS && area_after(grid, 0) < least_work)
        return use(grid, &snow_packard_tiles);
    if (tree && !goes_on(grid, *steps)) {
        model->left_quadtree = true;
        return use(grid, &snow_packard_tiles);
    }
    snow_status status = use(grid, &snow_packard_quadtree);
    if (status != SNOW_OK)
        return status;
    watch(grid);
    int64_t chunk = chunk_after(grid->census.steps);
    *steps = *steps < chunk ? *steps : chunk;
    return SNOW_OK;
}

snow_status snow_packard_choose(snow_grid *grid, int64_t *steps)
{
    const packard *model = packard_of(grid);
    bool zones = snow_packard_zones_apply(model, grid->census.steps + 1);
    switch (model->params.engine) {
    case SNOW_PACKARD_ENGINE_REFERENCE:
    case SNOW_PACKARD_ENGINE_TILES: return SNOW_OK;
    case SNOW_PACKARD_ENGINE_QUADTREE: return use(grid, zones ? &snow_packard_tiles : &snow_packard_quadtree);
    case SNOW_PACKARD_ENGINE_AUTO: break;
    }
    return choose_freely(grid, steps);
}
