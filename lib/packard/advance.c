/* How a grid goes on: spans of steps in which the same zones apply, cut where
   a condition has to be looked at. */
#include "packard/model.h"

static int64_t lesser(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static int64_t greater(int64_t a, int64_t b)
{
    return a > b ? a : b;
}

/* On the plane a rule with d1 = 1 never ends: the cell beyond a corner of the
   crystal's hull has one frozen neighbour. Only a zone can hinder it. */
static bool grows_for_ever(const snow_grid *grid)
{
    const packard *model = packard_of(grid);
    return packard_is_plane(model) && (model->params.rule >> 1 & 1) != 0 &&
           !snow_hexagon_is_empty(&grid->census.hexagon) && !snow_packard_zones_apply(model, grid->census.steps + 1);
}

/* Steps until `still` is looked for the next time. */
static int64_t to_next_look(int64_t steps)
{
    return steps == 0 ? 1 : 64 - steps % 64;
}

/* So many steps that the last look is at the end of them, or less than a look away. */
static int64_t to_last_look(int64_t steps, int64_t most)
{
    int64_t last = (steps + most) / 64 * 64;
    if (last > steps)
        return last - steps;
    return steps == 0 ? 1 : most;
}

/* Steps before which no frozen cell can be at so great a distance: the tip
   moves by one at most where only neighbours of frozen cells freeze. */
static int64_t to_distance(const snow_grid *grid, double distance)
{
    double left = distance - snow_census_tip(&grid->census);
    if (packard_of(grid)->params.rule % 2 != 0 || !(left >= 2))
        return 1;
    return left < 0x1p62 ? (int64_t)left : INT64_C(1) << 62;
}

/* Cells of the smallest hexagon that holds all cells after so many steps. */
static double reachable(const snow_grid *grid, int64_t steps)
{
    const snow_hexagon *hexagon = &grid->census.hexagon;
    double width = (double)hexagon->greatest_q - (double)hexagon->least_q + 1 + 2 * (double)steps;
    double height = (double)hexagon->greatest_r - (double)hexagon->least_r + 1 + 2 * (double)steps;
    return width * height;
}

/* Steps before which so many cells cannot be frozen. */
static int64_t to_frozen(const snow_grid *grid, uint64_t frozen)
{
    if (packard_of(grid)->params.rule % 2 != 0 || snow_hexagon_is_empty(&grid->census.hexagon))
        return 1;
    int64_t steps = 1;
    while (steps < INT64_C(1) << 32 && reachable(grid, 2 * steps) < (double)frozen)
        steps *= 2;
    return steps;
}

/* How many steps may be taken before the conditions must be looked at. */
static int64_t safe_steps(const snow_grid *grid, int64_t most, const snow_stop *stop)
{
    const packard *model = packard_of(grid);
    bool looks = !grows_for_ever(grid);
    if (stop == NULL || !stop->still)
        most = looks ? to_last_look(grid->census.steps, most) : most;
    else if (looks)
        most = lesser(most, to_next_look(grid->census.steps));
    if (stop == NULL)
        return most;
    if (stop->rim && packard_has_rim(model))
        most = lesser(most, to_distance(grid, (double)model->rim_distance));
    if (stop->tip_radius > 0)
        most = lesser(most, to_distance(grid, stop->tip_radius));
    if (stop->frozen > 0 && model->engine->keep == NULL)
        most = lesser(most, to_frozen(grid, stop->frozen));
    return greater(most, 1);
}

/* How many steps the run seems to have left. */
static int64_t expected_steps(const snow_grid *grid, const snow_stop *stop)
{
    if (stop == NULL)
        return 0;
    int64_t steps = stop->max_steps >= 0 ? stop->max_steps - grid->census.steps : INT64_MAX;
    if (stop->tip_radius > 0)
        steps = lesser(steps, to_distance(grid, stop->tip_radius));
    if (stop->frozen > 0)
        steps = lesser(steps, to_frozen(grid, stop->frozen));
    return steps;
}

/* The zones of the next step, and how many steps have the same ones. */
static snow_status change_zones(snow_grid *grid)
{
    packard *model = packard_of(grid);
    int64_t step = grid->census.steps + 1;
    if (step >= model->zones_first && step <= model->zones_last)
        return SNOW_OK;
    bool none = model->zone_count == 0 || model->engine->change_zones == NULL;
    snow_status status = none ? SNOW_OK : model->engine->change_zones(model->cells);
    if (status != SNOW_OK)
        return status;
    model->zones_first = step;
    model->zones_last = snow_packard_zones_last(model, step);
    return SNOW_OK;
}

static snow_status take(snow_grid *grid, int64_t steps)
{
    packard *model = packard_of(grid);
    snow_census *census = &grid->census;
    int64_t taken = 0;
    snow_status status = model->engine->advance(model->cells, steps, &taken);
    census->steps += taken;
    snow_status counted = taken > 0 ? snow_packard_count(grid) : SNOW_OK;
    if (status == SNOW_OK && snow_census_looks(census->steps))
        census->still = !snow_packard_zones_pend(model, census->steps + 1) && !grows_for_ever(grid) &&
                        model->engine->is_still(model->cells);
    return status != SNOW_OK ? status : counted;
}

static void go_back(snow_grid *grid, const snow_census *before)
{
    const packard *model = packard_of(grid);
    model->engine->restore(model->cells);
    grid->census = *before;
    snow_domain_follow(&grid->domain, &before->hexagon);
}

/* An engine that can go back at most doubles the steps so far, and halves its
   way until it does not pass the step in which as many cells as are wanted are
   frozen. */
static snow_status take_until_frozen(snow_grid *grid, int64_t steps, const snow_stop *stop)
{
    const packard *model = packard_of(grid);
    const snow_census before = grid->census;
    steps = lesser(steps, greater(before.steps, 64));
    model->engine->keep(model->cells);
    for (;; steps /= 2) {
        snow_status status = take(grid, steps);
        if (status != SNOW_OK || steps == 1 || snow_census_frozen(&grid->census) < stop->frozen)
            return status;
        go_back(grid, &before);
    }
}

snow_status snow_packard_advance(snow_grid *grid, int64_t most, const snow_stop *stop)
{
    packard *model = packard_of(grid);
    int64_t step = grid->census.steps + 1;
    int64_t same_zones = snow_packard_zones_last(model, step) - (step - 1);
    int64_t steps = safe_steps(grid, lesser(most, same_zones), stop);
    int64_t ahead = greater(steps, lesser(same_zones, expected_steps(grid, stop)));
    snow_status status = snow_packard_choose(grid, ahead, &steps);
    steps = safe_steps(grid, steps, stop); /* an engine that cannot go back has to look sooner */
    if (status == SNOW_OK)
        status = change_zones(grid);
    if (status != SNOW_OK)
        return status;
    bool hurries = stop != NULL && stop->seconds > 0;
    if (hurries && model->engine->keep != NULL) /* in one go it may take steps for hours */
        steps = lesser(steps, greater(grid->census.steps, 64));
    bool seeks = stop != NULL && stop->frozen > 0 && model->engine->keep != NULL;
    return seeks ? take_until_frozen(grid, steps, stop) : take(grid, steps);
}
