/* The start of a scene: obstacles, then seeds. */
#include "aggregate/model.h"
#include "aggregate/vessel.h"

static double farthest(const aggregate *model, double tip, snow_site site)
{
    double distance = sqrt((double)aggregate_square(model, site));
    return distance > tip ? distance : tip;
}

static bool is_in_reach(const aggregate *model, snow_site site)
{
    int32_t reach = aggregate_reach(&model->params) / 2;
    bool near = site.x >= -reach && site.x <= reach && site.y >= -reach && site.y <= reach;
    return near && (aggregate_is_space(&model->params) ? site.z >= -reach && site.z <= reach : site.z == 0);
}

/* Whether a particle may be at a site. */
static bool is_in_domain(const snow_grid *grid, snow_site site)
{
    const aggregate *model = aggregate_of(grid);
    if (!is_in_reach(model, site))
        return false;
    return model->scene->inside == NULL || model->scene->inside(grid, site);
}

static snow_status add_once(snow_grid *grid, snow_sites *sites, snow_order *order, snow_site site)
{
    if (snow_order_find(order, sites, site) >= 0)
        return SNOW_ERROR_AGGREGATE_OVERLAP;
    snow_status status = snow_sites_reserve(sites, &grid->heap, 1);
    if (status == SNOW_OK)
        status = snow_order_reserve(order, &grid->heap, sites, 1);
    if (status != SNOW_OK)
        return status;
    snow_sites_add(sites, site);
    snow_order_add(order, sites, sites->count - 1);
    return SNOW_OK;
}

/* The sheet's circle must be free of obstacles, the row that walkers start in too. */
static bool blocks_launch(const aggregate *model, snow_site site)
{
    const snow_aggregate_params *params = &model->params;
    if (params->scene == SNOW_AGGREGATE_LABORATORY)
        return farthest(model, 0, site) >= params->launch_radius - 1;
    return params->scene == SNOW_AGGREGATE_LINE && aggregate_height(model, site) >= params->height - 1;
}

static snow_status list_obstacles(snow_grid *grid, const snow_aggregate_params *params, snow_order *barred)
{
    aggregate *model = aggregate_of(grid);
    for (size_t i = 0; i < params->obstacle_count; i++) {
        snow_site site = params->obstacles[i];
        bool inside = is_in_reach(model, site);
        if (!inside || (params->scene == SNOW_AGGREGATE_LINE && !snow_vessel_has(params, site)))
            return SNOW_ERROR_AGGREGATE_OBSTACLE;
        if (blocks_launch(model, site))
            return SNOW_ERROR_AGGREGATE_LAUNCH;
        snow_status status = add_once(grid, &model->obstacles, barred, site);
        if (status != SNOW_OK)
            return status;
        model->obstacle_tip = farthest(model, model->obstacle_tip, site);
    }
    return SNOW_OK;
}

static snow_status check_seed(const snow_grid *grid, const snow_order *barred, snow_site site)
{
    const aggregate *model = aggregate_of(grid);
    if (!is_in_domain(grid, site))
        return SNOW_ERROR_AGGREGATE_SEED;
    bool laboratory = model->params.scene == SNOW_AGGREGATE_LABORATORY;
    bool beyond = laboratory && farthest(model, 0, site) >= model->params.end_radius;
    if (beyond || blocks_launch(model, site))
        return SNOW_ERROR_AGGREGATE_LAUNCH;
    if (snow_order_find(barred, &model->obstacles, site) >= 0)
        return SNOW_ERROR_AGGREGATE_OVERLAP;
    return SNOW_OK;
}

/* `planted` finds seeds that stand on each other; it is the grid's own order where that is recorded. */
static snow_status plant(snow_grid *grid, const snow_order *barred, snow_order *planted, snow_site site)
{
    aggregate *model = aggregate_of(grid);
    snow_status status = check_seed(grid, barred, site);
    if (status == SNOW_OK && snow_order_find(planted, &model->sites, site) >= 0)
        status = SNOW_ERROR_AGGREGATE_OVERLAP;
    if (status == SNOW_OK)
        status = snow_aggregate_reserve(grid, 1);
    if (status == SNOW_OK)
        status = snow_order_reserve(planted, &grid->heap, &model->sites, 1);
    if (status == SNOW_OK)
        status = model->scene->place(grid, site);
    if (status != SNOW_OK)
        return status;
    snow_aggregate_join(grid, site);
    snow_order_add(planted, &model->sites, model->sites.count - 1);
    return SNOW_OK;
}

static snow_status plant_seeds(snow_grid *grid, const snow_aggregate_params *params, const snow_order *barred)
{
    static const snow_site origin = {0, 0, 0};
    aggregate *model = aggregate_of(grid);
    bool alone = snow_aggregate_has_floor(params) || params->scene == SNOW_AGGREGATE_CLUSTER_CLUSTER;
    const snow_site *seeds = params->seeds == NULL && !alone ? &origin : params->seeds;
    size_t count = seeds == &origin ? 1 : params->seed_count;
    if (count == 0 && !alone)
        return SNOW_ERROR_AGGREGATE_SEED;
    snow_order planted = {0};
    snow_status status = SNOW_OK;
    for (size_t i = 0; i < count && status == SNOW_OK; i++)
        status = plant(grid, barred, &planted, seeds[i]);
    snow_order_end(&planted, &grid->heap);
    model->seeds = model->sites.count;
    return status;
}

snow_status snow_aggregate_start(snow_grid *grid, const snow_aggregate_params *params)
{
    aggregate *model = aggregate_of(grid);
    snow_order barred = {0};
    snow_status status = list_obstacles(grid, params, &barred);
    if (status == SNOW_OK)
        status = model->scene->create(grid);
    if (status == SNOW_OK)
        status = plant_seeds(grid, params, &barred);
    snow_order_end(&barred, &grid->heap);
    if (status == SNOW_OK)
        status = snow_aggregate_find_path(grid);
    if (status == SNOW_OK && model->scene->check != NULL)
        status = model->scene->check(grid);
    return status;
}
