#include "base/floating.h"
#include "base/structs.h"
#include "reiter/model.h"

snow_status snow_reiter_conditions_of(const snow_grid *grid, snow_reiter_conditions *caller)
{
    if (grid == NULL || caller == NULL)
        return SNOW_ERROR_NULL;
    snow_reiter_conditions conditions;
    snow_status status = snow_struct_take(&conditions, sizeof conditions, caller);
    if (status != SNOW_OK)
        return status;
    if (grid->operations != &snow_reiter_operations)
        return SNOW_ERROR_UNSUPPORTED;
    const snow_reiter_params *params = &reiter_of(grid)->params;
    conditions.background = params->background;
    conditions.addition = params->addition;
    conditions.diffusion = params->diffusion;
    snow_struct_write(caller, &conditions, sizeof conditions);
    return SNOW_OK;
}

/* How vapour follows a new background. */
typedef struct rescaling {
    double old_level; /* the old background, as the vapour holds it */
    double new_level;
    double factor;
} rescaling;

/* What holds the background holds the new one, exactly. */
static void rescale(reiter_cell *cell, const rescaling *scale)
{
    if (cell->value == scale->old_level && cell->low == 0) {
        cell->value = scale->new_level;
        return;
    }
    cell->value *= scale->factor;
    cell->low *= scale->factor;
}

/* Whether all vapour stays below the threshold; with `commit` it is changed. */
static bool rescale_cells(snow_grid *grid, snow_walk walk, const rescaling *scale, bool commit)
{
    const reiter_engine *engine = reiter_of(grid)->engine;
    while (snow_walk_next(&walk)) {
        reiter_cell cell = engine->get(grid, walk.cell.q, walk.cell.r);
        if (cell.receptive)
            continue;
        rescale(&cell, scale);
        if (!(cell.value < reiter_threshold(reiter_of(grid))))
            return false;
        if (commit)
            engine->put(grid, walk.cell.q, walk.cell.r, &cell);
    }
    return true;
}

static snow_status rescale_all(snow_grid *grid, double background)
{
    const reiter *model = reiter_of(grid);
    if (model->params.background == 0)
        return SNOW_ERROR_REITER_RESCALE;
    rescaling scale = {reiter_background(model), background, background / model->params.background};
    if (!isfinite(scale.factor) || !rescale_cells(grid, reiter_walk_part(grid), &scale, false) ||
        !rescale_cells(grid, reiter_walk_fixed(grid), &scale, false))
        return SNOW_ERROR_REITER_VAPOUR;
    rescale_cells(grid, reiter_walk_part(grid), &scale, true);
    rescale_cells(grid, reiter_walk_fixed(grid), &scale, true);
    return SNOW_OK;
}

static void set_fixed(snow_grid *grid, double background)
{
    reiter_cell cell = {.value = background};
    for (snow_walk walk = reiter_walk_fixed(grid); snow_walk_next(&walk);)
        reiter_of(grid)->engine->put(grid, walk.cell.q, walk.cell.r, &cell);
}

static snow_status change_background(snow_grid *grid, const snow_reiter_conditions *conditions)
{
    snow_status status = SNOW_OK;
    if (conditions->rescale)
        status = rescale_all(grid, conditions->background);
    else
        set_fixed(grid, conditions->background);
    if (status == SNOW_OK)
        reiter_of(grid)->params.background = conditions->background;
    return status;
}

static void change_addition(snow_grid *grid, double addition)
{
    reiter *model = reiter_of(grid);
    snow_reiter_merge_additions(grid);
    snow_heap_put(&grid->heap, model->addition_at);
    model->addition_at = NULL;
    model->params.addition = addition;
}

static snow_status change(snow_grid *grid, const snow_reiter_conditions *conditions)
{
    reiter *model = reiter_of(grid);
    snow_status status = snow_reiter_conditions_check(conditions->background, conditions->addition,
                                                      conditions->diffusion, model->params.allow_unstable != 0);
    if (status == SNOW_OK && conditions->background != model->params.background)
        status = change_background(grid, conditions);
    if (status != SNOW_OK)
        return status;
    if (conditions->addition != model->params.addition)
        change_addition(grid, conditions->addition);
    model->params.diffusion = conditions->diffusion;
    snow_reiter_choose_bound(grid);
    model->engine->settle(grid);
    grid->census.still = false;
    return SNOW_OK;
}

snow_status snow_reiter_change(snow_grid *grid, const snow_reiter_conditions *caller)
{
    if (grid == NULL || caller == NULL)
        return SNOW_ERROR_NULL;
    snow_reiter_conditions conditions;
    snow_status status = snow_struct_take(&conditions, sizeof conditions, caller);
    if (status != SNOW_OK)
        return status;
    if (grid->operations != &snow_reiter_operations)
        return SNOW_ERROR_UNSUPPORTED;
    if (grid->busy)
        return SNOW_ERROR_BUSY;
    if (conditions.rescale != 0 && conditions.rescale != 1)
        return SNOW_ERROR_RANGE;
    snow_floating floating;
    snow_floating_enter(&floating);
    status = change(grid, &conditions);
    snow_floating_leave(&floating);
    return status;
}
