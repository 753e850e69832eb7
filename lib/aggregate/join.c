/* A particle joins: the lists, the census, and whether the scene is at its end. */
#include "aggregate/model.h"

static void widen_bounds(aggregate *model, snow_census *census, snow_site site)
{
    bool first = model->sites.count == 1;
    model->low = first ? site : snow_site_least(model->low, site);
    model->high = first ? site : snow_site_greatest(model->high, site);
    snow_hexagon_hold(&census->hexagon, site.x, site.y);
}

/* Whether growth has come to where the scene ends. */
static void look_at_rim(const aggregate *model, snow_census *census, snow_site site)
{
    const double reach = aggregate_reach(&model->params);
    const double end = model->params.end_radius;
    const double clear = model->params.launch_radius - 1; /* walkers set out farther out */
    const snow_aggregate_params *params = &model->params;
    int32_t last_row = params->height - 1;
    switch (params->scene) {
    case SNOW_AGGREGATE_LABORATORY:
        census->rim |= census->tip_square >= end * end;
        census->full |= census->tip_square >= clear * clear;
        break;
    case SNOW_AGGREGATE_LINE:
        census->rim |= aggregate_height(model, site) >= last_row;
        census->full |= census->rim;
        break;
    case SNOW_AGGREGATE_ELECTROLYSIS:
    case SNOW_AGGREGATE_CHIMNEY: census->rim |= site.y >= last_row; break;
    case SNOW_AGGREGATE_SHORE: census->rim |= site.y <= 0; break;
    case SNOW_AGGREGATE_WITTEN_SANDER:
    case SNOW_AGGREGATE_SNOWFLAKE: census->full |= census->tip_square >= reach * reach; break;
    case SNOW_AGGREGATE_CLUSTER_CLUSTER:
    case SNOW_AGGREGATE_OFF_LATTICE: break;
    }
    census->full |= model->sites.count >= AGGREGATE_MOST_PARTICLES;
}

void snow_aggregate_join(snow_grid *grid, snow_site site)
{
    aggregate *model = aggregate_of(grid);
    snow_census *census = &grid->census;
    snow_sites_add(&model->sites, site);
    if (model->params.record_order)
        snow_order_add(&model->order, &model->sites, model->sites.count - 1);
    widen_bounds(model, census, site);
    census->frozen = model->sites.count;
    double square = (double)aggregate_square(model, site);
    census->tip_square = square > census->tip_square ? square : census->tip_square;
    bool deposit = snow_aggregate_has_floor(&model->params) && model->params.scene != SNOW_AGGREGATE_SHORE;
    if (deposit && aggregate_height(model, site) >= census->height)
        census->height = aggregate_height(model, site) + 1;
    look_at_rim(model, census, site);
}

snow_status snow_aggregate_reserve(snow_grid *grid, uint64_t more)
{
    aggregate *model = aggregate_of(grid);
    snow_status status = snow_sites_reserve(&model->sites, &grid->heap, more);
    if (status == SNOW_OK && model->params.record_order)
        status = snow_order_reserve(&model->order, &grid->heap, &model->sites, more);
    return status;
}

bool snow_aggregate_hit(snow_grid *grid, snow_site site)
{
    aggregate *model = aggregate_of(grid);
    if (model->params.hits == 1)
        return true;
    uint64_t key = snow_site_pack(model->sites.space, site);
    uint32_t hits = ++*snow_table_at(&model->hits, key);
    if (hits < (uint32_t)model->params.hits)
        return false;
    snow_table_remove(&model->hits, key);
    return true;
}
