#include "aggregate/model.h"
#include "base/floating.h"
#include "base/structs.h"

static const aggregate_scene *choose_scene(const snow_aggregate_params *params)
{
    bool jumps = params->engine == SNOW_AGGREGATE_ENGINE_JUMPS ||
                 (params->engine == SNOW_AGGREGATE_ENGINE_AUTO && !params->periodic);
    switch (params->scene) {
    case SNOW_AGGREGATE_LINE: return jumps ? &snow_aggregate_jumps : &snow_aggregate_walker;
    case SNOW_AGGREGATE_LABORATORY: return &snow_aggregate_walker;
    case SNOW_AGGREGATE_ELECTROLYSIS: return &snow_aggregate_electrolysis;
    case SNOW_AGGREGATE_SHORE: return &snow_aggregate_shore;
    case SNOW_AGGREGATE_CHIMNEY: return &snow_aggregate_chimney;
    case SNOW_AGGREGATE_SNOWFLAKE: return &snow_aggregate_snowflake;
    case SNOW_AGGREGATE_CLUSTER_CLUSTER: return &snow_aggregate_cluster_cluster;
    case SNOW_AGGREGATE_OFF_LATTICE: return &snow_aggregate_off_lattice;
    case SNOW_AGGREGATE_WITTEN_SANDER: break;
    }
    return params->engine == SNOW_AGGREGATE_ENGINE_STEPS ? &snow_aggregate_walker : &snow_aggregate_jumps;
}

static snow_status build(snow_grid *grid, const snow_aggregate_params *params)
{
    aggregate *model = snow_heap_get(&grid->heap, 1, sizeof *model);
    if (model == NULL)
        return grid->heap.refusal;
    grid->state = model;
    model->params = *params;
    model->params.seeds = NULL;
    model->params.seed_count = 0;
    model->params.obstacles = NULL;
    model->params.obstacle_count = 0;
    if (params->scene == SNOW_AGGREGATE_OFF_LATTICE)
        model->params.lattice = SNOW_AGGREGATE_SQUARE;
    model->scene = choose_scene(params);
    grid->squares = model->params.lattice != SNOW_AGGREGATE_HEXAGONAL;
    model->sites.space = aggregate_is_space(params);
    model->obstacles.space = model->sites.space;
    return SNOW_OK;
}

snow_status snow_aggregate_build(const snow_aggregate_params *params, const snow_options *options, bool loading,
                                 snow_grid **result)
{
    snow_grid *grid = NULL;
    snow_status status = snow_aggregate_params_check(params);
    if (status == SNOW_OK)
        status = snow_grid_new(&snow_aggregate_operations, options, &grid);
    if (status != SNOW_OK)
        return status;
    status = build(grid, params);
    if (status == SNOW_OK) {
        aggregate_of(grid)->loading = loading;
        status = snow_aggregate_start(grid, params);
    }
    if (status != SNOW_OK) {
        snow_grid_end(grid);
        return status;
    }
    snow_aggregate_follow(grid);
    *result = grid;
    return SNOW_OK;
}

/* The box of a scene that has one; else the particles with one site round them. */
static snow_rect cells_of(const aggregate *model)
{
    const snow_aggregate_params *params = &model->params;
    if (snow_aggregate_has_floor(params)) {
        int32_t lean = params->lattice == SNOW_AGGREGATE_HEXAGONAL ? (params->height - 1) / 2 : 0;
        return (snow_rect){-lean, 0, params->width + lean, aggregate_is_space(params) ? params->depth : params->height};
    }
    if (model->sites.count == 0)
        return (snow_rect){0, 0, 1, 1};
    return (snow_rect){model->low.x - 1, model->low.y - 1, model->high.x - model->low.x + 3,
                       model->high.y - model->low.y + 3};
}

void snow_aggregate_follow(snow_grid *grid)
{
    const aggregate *model = aggregate_of(grid);
    snow_rect cells = cells_of(model);
    if (model->params.scene == SNOW_AGGREGATE_CLUSTER_CLUSTER)
        cells.width = cells.height = snow_aggregate_box(grid);
    grid->domain = (snow_domain){
        .top = cells.r,
        .rows = cells.height,
        .cells = (uint64_t)cells.width * (uint64_t)cells.height,
        .bounds = cells,
        .hexagon = {cells.q, (int64_t)cells.q + cells.width - 1, cells.r, (int64_t)cells.r + cells.height - 1,
                    INT32_MIN, INT32_MAX},
    };
}

static void survey(const snow_grid *grid, snow_census *census)
{
    if (aggregate_of(grid)->scene->survey != NULL)
        aggregate_of(grid)->scene->survey(grid, census);
}

static void destroy(snow_grid *grid)
{
    aggregate *model = aggregate_of(grid);
    if (model->state != NULL)
        model->scene->destroy(grid);
    snow_sites_end(&model->sites, &grid->heap);
    snow_sites_end(&model->obstacles, &grid->heap);
    snow_order_end(&model->order, &grid->heap);
    snow_table_end(&model->hits, &grid->heap);
    snow_heap_put(&grid->heap, model);
}

const snow_model_operations snow_aggregate_operations = {
    .model = SNOW_MODEL_AGGREGATE,
    .name = "aggregate",
    .advance = snow_aggregate_advance,
    .can_read = snow_aggregate_can_read,
    .read = snow_aggregate_read,
    .survey = survey,
    .set = snow_aggregate_set,
    .digest = snow_aggregate_digest,
    .save = snow_aggregate_save,
    .load = snow_aggregate_load,
    .destroy = destroy,
};

snow_status snow_aggregate_create(const snow_aggregate_params *caller, const snow_options *options, snow_grid **result)
{
    if (caller == NULL || result == NULL)
        return SNOW_ERROR_NULL;
    snow_aggregate_params params;
    snow_status status = snow_struct_check(caller, sizeof params, sizeof params);
    if (status != SNOW_OK)
        return status;
    snow_struct_read(&params, sizeof params, caller);
    snow_floating floating;
    snow_floating_enter(&floating);
    status = snow_aggregate_build(&params, options, false, result);
    snow_floating_leave(&floating);
    return status;
}

snow_status snow_aggregate_params_of(const snow_grid *grid, snow_aggregate_params *caller)
{
    if (grid == NULL || caller == NULL)
        return SNOW_ERROR_NULL;
    snow_status status = snow_struct_check(caller, sizeof *caller, sizeof *caller);
    if (status != SNOW_OK)
        return status;
    if (grid->operations != &snow_aggregate_operations)
        return SNOW_ERROR_UNSUPPORTED;
    snow_struct_write(caller, &aggregate_of(grid)->params, sizeof aggregate_of(grid)->params);
    return SNOW_OK;
}
