#include "base/floating.h"
#include "base/structs.h"
#include "reiter/model.h"

snow_status snow_reiter_conditions_of(const snow_grid *grid, snow_reiter_conditions *caller)
{
    if (grid == NULL || caller == NULL)
        return SNOW_ERROR_NULL;
    snow_reiter_conditions conditions;
    snow_status status = snow_struct_check(caller, sizeof conditions, sizeof conditions);
    if (status != SNOW_OK)
        return status;
    if (grid->operations != &snow_reiter_operations)
        return SNOW_ERROR_UNSUPPORTED;
    snow_struct_read(&conditions, sizeof conditions, caller);
    const snow_reiter_params *params = &reiter_of(grid)->params;
    conditions.background = params->background;
    conditions.addition = params->addition;
    conditions.diffusion = params->diffusion;
    snow_struct_write(caller, &conditions, sizeof conditions);
    return SNOW_OK;
}

/* Visits the cells that hold vapour: the fixed ones and those that are not receptive. */
typedef bool (*vapour_visitor)(snow_grid *grid, int32_t q, int32_t r, reiter_cell *cell, double factor);

static bool visit_vapour(snow_grid *grid, vapour_visitor visitor, double factor)
{
    snow_walk walks[2] = {reiter_walk_part(grid), reiter_walk_fixed(grid)};
    for (int i = 0; i < 2; i++) {
        while (snow_walk_next(&walks[i])) {
            snow_cell at = walks[i].cell;
            reiter_cell cell = reiter_of(grid)->engine->get(grid, at.q, at.r);
            if (!cell.receptive && !visitor(grid, at.q, at.r, &cell, factor))
                return false;
        }
    }
    return true;
}

static bool stays_vapour(snow_grid *grid, int32_t q, int32_t r, reiter_cell *cell, double factor)
{
    (void)grid;
    (void)q;
    (void)r;
    return cell->value * factor < reiter_threshold();
}

static bool rescale(snow_grid *grid, int32_t q, int32_t r, reiter_cell *cell, double factor)
{
    cell->value *= factor;
    cell->low *= factor;
    reiter_of(grid)->engine->put(grid, q, r, cell);
    return true;
}

static bool set_fixed(snow_grid *grid, int32_t q, int32_t r, reiter_cell *cell, double background)
{
    cell->value = background;
    cell->low = 0;
    if (!snow_domain_has(&grid->domain, q, r))
        reiter_of(grid)->engine->put(grid, q, r, cell);
    return true;
}

static snow_status change_background(snow_grid *grid, const snow_reiter_conditions *conditions)
{
    reiter *model = reiter_of(grid);
    double old = model->params.background;
    if (!conditions->rescale) {
        visit_vapour(grid, set_fixed, conditions->background);
    } else {
        if (old == 0)
            return SNOW_ERROR_REITER_RESCALE;
        double factor = conditions->background / old;
        if (!isfinite(factor) || !visit_vapour(grid, stays_vapour, factor))
            return SNOW_ERROR_REITER_VAPOUR;
        visit_vapour(grid, rescale, factor);
    }
    model->params.background = conditions->background;
    return SNOW_OK;
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
    snow_status status = SNOW_OK;
    if (conditions->background != model->params.background)
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
    snow_status status = snow_struct_check(caller, sizeof conditions, sizeof conditions);
    if (status != SNOW_OK)
        return status;
    if (grid->operations != &snow_reiter_operations)
        return SNOW_ERROR_UNSUPPORTED;
    if (grid->busy)
        return SNOW_ERROR_BUSY;
    snow_struct_read(&conditions, sizeof conditions, caller);
    if (conditions.rescale != 0 && conditions.rescale != 1)
        return SNOW_ERROR_RANGE;
    status = snow_reiter_conditions_check(conditions.background, conditions.addition, conditions.diffusion,
                                          reiter_of(grid)->params.allow_unstable != 0);
    if (status != SNOW_OK)
        return status;
    snow_floating floating;
    snow_floating_enter(&floating);
    status = change(grid, &conditions);
    snow_floating_leave(&floating);
    return status;
}
