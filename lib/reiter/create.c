#include "base/floating.h"
#include "base/structs.h"
#include "reiter/model.h"

static const reiter_engine *choose_engine(snow_reiter_engine engine)
{
    switch (engine) {
    case SNOW_REITER_ENGINE_REFERENCE: return &snow_reiter_reference;
    case SNOW_REITER_ENGINE_QUAD: return &snow_reiter_quad;
    case SNOW_REITER_ENGINE_AUTO:
    case SNOW_REITER_ENGINE_ROWS: break;
    }
    return &snow_reiter_rows;
}

uint64_t snow_reiter_cells(const snow_reiter_params *params)
{
    switch (params->domain) {
    case SNOW_REITER_DISC: return snow_domain_disc_cells(params->radius);
    case SNOW_REITER_HEXAGON: return snow_domain_hexagon_cells(params->radius);
    case SNOW_REITER_RECTANGLE: break;
    }
    return (uint64_t)params->width * (uint64_t)params->height;
}

/* Cells are numbered in 32 bits; the hull has at most nine cells for one. */
static bool is_too_large(const snow_reiter_params *params)
{
    uint64_t cells = snow_reiter_cells(params);
    return cells > UINT32_MAX - UINT32_C(0x2000000) || cells > SIZE_MAX / 128;
}

static snow_status build_domain(snow_grid *grid, const snow_reiter_params *params)
{
    snow_domain *domain = &grid->domain;
    switch (params->domain) {
    case SNOW_REITER_DISC: return snow_domain_disc(domain, &grid->heap, params->radius);
    case SNOW_REITER_HEXAGON: return snow_domain_hexagon(domain, &grid->heap, params->radius);
    case SNOW_REITER_RECTANGLE: break;
    }
    return snow_domain_rectangle(domain, &grid->heap, params->width, params->height);
}

static snow_status build_freeze_steps(snow_grid *grid)
{
    reiter *model = reiter_of(grid);
    if (!model->params.record_freeze_steps)
        return SNOW_OK;
    size_t numbers = model->engine->numbers(grid);
    model->freeze_step = snow_heap_get_raw(&grid->heap, numbers, sizeof *model->freeze_step);
    if (model->freeze_step == NULL)
        return grid->heap.refusal;
    for (size_t i = 0; i < numbers; i++)
        model->freeze_step[i] = REITER_NEVER;
    return SNOW_OK;
}

static snow_status build(snow_grid *grid, const snow_reiter_params *params)
{
    reiter *model = snow_heap_get(&grid->heap, 1, sizeof *model);
    if (model == NULL)
        return grid->heap.refusal;
    grid->state = model;
    model->params = *params;
    model->params.seeds = NULL;
    model->params.background_at = NULL;
    model->params.addition_at = NULL;
    model->params.field_context = NULL;
    model->group = SNOW_GROUP_TRIVIAL;
    model->bound = 1;
    snow_status status = build_domain(grid, params);
    if (status == SNOW_OK)
        status = snow_domain_hull(&model->hull, &grid->heap, &grid->domain);
    return status;
}

snow_status snow_reiter_equip(snow_grid *grid, snow_group group)
{
    reiter *model = reiter_of(grid);
    model->engine = choose_engine(model->params.engine);
    model->group = model->engine->folds ? group : SNOW_GROUP_TRIVIAL;
    snow_status status = model->engine->create(grid);
    if (status == SNOW_OK)
        status = build_freeze_steps(grid);
    return status;
}

snow_status snow_reiter_build(const snow_reiter_params *params, const snow_options *options, snow_grid **result)
{
    snow_status status = snow_reiter_params_check(params);
    if (status == SNOW_OK && is_too_large(params))
        status = SNOW_ERROR_TOO_LARGE;
    snow_grid *grid = NULL;
    if (status == SNOW_OK)
        status = snow_grid_new(&snow_reiter_operations, options, &grid);
    if (status == SNOW_OK)
        status = build(grid, params);
    return snow_grid_hand_over(grid, status, result);
}

static void destroy(snow_grid *grid)
{
    reiter *model = reiter_of(grid);
    if (model->engine != NULL && model->cells != NULL)
        model->engine->destroy(grid);
    snow_heap_put(&grid->heap, model->freeze_step);
    snow_heap_put(&grid->heap, model->addition_at);
    snow_domain_end(&model->hull, &grid->heap);
    snow_heap_put(&grid->heap, model);
}

/* Whether no condition on the crystal can come true within so many steps. */
static bool is_far_from_stop(const snow_grid *grid, const snow_stop *stop, int64_t steps)
{
    if (stop == NULL)
        return true;
    if (stop->frozen > 0 || (stop->tip_radius > 0 && snow_census_tip(&grid->census) + (double)steps >= stop->tip_radius))
        return false;
    return !stop->rim || !snow_reiter_may_reach_rim(grid, steps);
}

static snow_status take_steps(snow_grid *grid, int64_t most, const snow_stop *stop)
{
    const reiter_engine *engine = reiter_of(grid)->engine;
    int64_t together = engine->pass_steps != NULL ? engine->pass_steps(grid, most) : 0;
    while (together > 0 && !is_far_from_stop(grid, stop, together))
        together = engine->pass_steps(grid, together / 2);
    if (together == 0)
        return engine->step(grid);
    engine->pass(grid, together);
    return SNOW_OK;
}

static snow_status advance(snow_grid *grid, int64_t most, const snow_stop *stop)
{
    snow_census *census = &grid->census;
    snow_status status = take_steps(grid, most, stop);
    if (status == SNOW_OK && census->steps % REITER_MERGE_STEPS == 0) {
        snow_reiter_merge_additions(grid);
        reiter_of(grid)->engine->settle(grid);
    }
    return status;
}

const snow_model_operations snow_reiter_operations = {
    .model = SNOW_MODEL_REITER,
    .name = "reiter",
    .advance = advance,
    .can_read = snow_reiter_can_read,
    .read = snow_reiter_read,
    .set = snow_reiter_set,
    .save = snow_reiter_save,
    .load = snow_reiter_load,
    .destroy = destroy,
};

snow_status snow_reiter_create(const snow_reiter_params *caller, const snow_options *options, snow_grid **result)
{
    if (caller == NULL || result == NULL)
        return SNOW_ERROR_NULL;
    snow_reiter_params params;
    snow_status status = snow_struct_take(&params, sizeof params, caller);
    if (status != SNOW_OK)
        return status;

    snow_floating floating;
    snow_floating_enter(&floating);
    snow_grid *grid = NULL;
    status = snow_reiter_build(&params, options, &grid);
    if (status == SNOW_OK)
        status = snow_reiter_scene(grid, &params);
    snow_floating_leave(&floating);
    return snow_grid_hand_over(grid, status, result);
}
