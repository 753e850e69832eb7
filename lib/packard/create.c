#include "base/floating.h"
#include "base/structs.h"
#include "packard/model.h"

static snow_hexagon rhombus_of(const snow_packard_params *params)
{
    return (snow_hexagon){
        .least_q = -(params->width / 2),
        .greatest_q = params->width - params->width / 2 - 1,
        .least_r = -(params->height / 2),
        .greatest_r = params->height - params->height / 2 - 1,
        .least_s = INT32_MIN,
        .greatest_s = INT32_MAX,
    };
}

static snow_hexagon hexagon_of(const snow_packard_params *params)
{
    int64_t reach = params->radius - 1;
    return (snow_hexagon){-reach, reach, -reach, reach, -reach, reach};
}

static snow_status build_domain(snow_grid *grid, const snow_packard_params *params)
{
    snow_hexagon hexagon = snow_hexagon_empty();
    switch (params->domain) {
    case SNOW_PACKARD_DISC: return snow_domain_disc(&grid->domain, &grid->heap, params->radius);
    case SNOW_PACKARD_RECTANGLE:
        return snow_domain_rectangle(&grid->domain, &grid->heap, params->width, params->height);
    case SNOW_PACKARD_PLANE: snow_domain_follow(&grid->domain, &hexagon); return SNOW_OK;
    case SNOW_PACKARD_HEXAGON: hexagon = hexagon_of(params); break;
    case SNOW_PACKARD_RHOMBUS:
    case SNOW_PACKARD_TORUS: hexagon = rhombus_of(params); break;
    }
    snow_domain_fill(&grid->domain, &hexagon);
    return SNOW_OK;
}

/* Cells are put one by one at first; which engine goes on is chosen when all stand. */
static const packard_engine *first_engine(const snow_packard_params *params)
{
    return params->engine == SNOW_PACKARD_ENGINE_REFERENCE ? &snow_packard_reference : &snow_packard_tiles;
}

static snow_status build(snow_grid *grid, const snow_packard_params *params, int64_t steps)
{
    packard *model = snow_heap_get(&grid->heap, 1, sizeof *model);
    if (model == NULL)
        return grid->heap.refusal;
    grid->state = model;
    grid->census.steps = steps;
    model->params = *params;
    model->params.seeds = NULL;
    model->engine = first_engine(params);
    model->rim_distance = snow_packard_rim_distance(params);
    snow_status status = build_domain(grid, params);
    if (status == SNOW_OK)
        status = model->engine->create(grid, &model->fold, &model->cells);
    return status;
}

snow_status snow_packard_build(const snow_packard_params *params, const snow_options *options, int64_t steps,
                               snow_grid **result)
{
    snow_status status = snow_packard_params_check(params);
    snow_grid *grid = NULL;
    if (status == SNOW_OK)
        status = snow_grid_new(&snow_packard_operations, options, &grid);
    if (status == SNOW_OK)
        status = build(grid, params, steps);
    return snow_grid_hand_over(grid, status, result);
}

static void destroy(snow_grid *grid)
{
    packard *model = packard_of(grid);
    if (model->cells != NULL)
        model->engine->destroy(grid, model->cells);
    snow_packard_zones_end(grid);
    snow_heap_put(&grid->heap, model);
}

const snow_model_operations snow_packard_operations = {
    .model = SNOW_MODEL_PACKARD,
    .name = "packard",
    .binary = true,
    .advance = snow_packard_advance,
    .can_read = snow_packard_can_read,
    .read = snow_packard_read,
    .next_frozen = snow_packard_next_frozen,
    .set = snow_packard_set,
    .save = snow_packard_save,
    .load = snow_packard_load,
    .destroy = destroy,
};

snow_status snow_packard_create(const snow_packard_params *caller, const snow_options *options, snow_grid **result)
{
    if (caller == NULL || result == NULL)
        return SNOW_ERROR_NULL;
    snow_packard_params params;
    snow_status status = snow_struct_take(&params, sizeof params, caller);
    if (status != SNOW_OK)
        return status;

    snow_floating floating;
    snow_floating_enter(&floating);
    snow_grid *grid = NULL;
    status = snow_packard_build(&params, options, 0, &grid);
    if (status == SNOW_OK)
        status = snow_packard_plant(grid, &params);
    if (status == SNOW_OK)
        status = snow_packard_settle(grid);
    snow_floating_leave(&floating);
    return snow_grid_hand_over(grid, status, result);
}
