/* What can be asked of particles. */
#include "aggregate/model.h"
#include "base/floating.h"

static snow_status check(const snow_grid *grid, const void *result)
{
    if (grid == NULL || result == NULL)
        return SNOW_ERROR_NULL;
    return grid->operations == &snow_aggregate_operations ? SNOW_OK : SNOW_ERROR_UNSUPPORTED;
}

uint64_t snow_aggregate_count(const snow_grid *grid)
{
    const aggregate *model = aggregate_of(grid);
    return model->scene->count != NULL ? model->scene->count(grid) : model->sites.count;
}

snow_status snow_aggregate_particles(const snow_grid *grid, uint64_t *count)
{
    snow_status status = check(grid, count);
    if (status == SNOW_OK)
        *count = snow_aggregate_count(grid);
    return status;
}

snow_status snow_aggregate_walkers(const snow_grid *grid, uint64_t *count)
{
    snow_status status = check(grid, count);
    if (status == SNOW_OK)
        *count = aggregate_of(grid)->walkers;
    return status;
}

static snow_status check_range(const snow_grid *grid, uint64_t first, const void *results, size_t count)
{
    snow_status status = count > 0 ? check(grid, results) : check(grid, grid);
    if (status != SNOW_OK)
        return status;
    uint64_t particles = snow_aggregate_count(grid);
    return first <= particles && count <= particles - first ? SNOW_OK : SNOW_ERROR_RANGE;
}

snow_status snow_aggregate_sites(const snow_grid *grid, uint64_t first, snow_site *sites, size_t count)
{
    snow_status status = check_range(grid, first, sites, count);
    if (status != SNOW_OK)
        return status;
    const aggregate *model = aggregate_of(grid);
    if (model->params.scene == SNOW_AGGREGATE_OFF_LATTICE)
        return SNOW_ERROR_UNSUPPORTED;
    if (model->scene->sites != NULL) {
        model->scene->sites(grid, first, sites, count);
        return SNOW_OK;
    }
    for (size_t i = 0; i < count; i++)
        sites[i] = snow_sites_at(&model->sites, first + i);
    return SNOW_OK;
}

snow_status snow_aggregate_obstacles(const snow_grid *grid, snow_site *sites, size_t capacity, size_t *count)
{
    snow_status status = check(grid, sites != NULL ? (const void *)sites : (const void *)count);
    if (status != SNOW_OK)
        return status;
    const snow_sites *obstacles = &aggregate_of(grid)->obstacles;
    if (count != NULL)
        *count = (size_t)obstacles->count;
    if (sites == NULL)
        return SNOW_OK;
    if (capacity < obstacles->count)
        return SNOW_ERROR_BUFFER;
    for (uint64_t i = 0; i < obstacles->count; i++)
        sites[i] = snow_sites_at(obstacles, i);
    return SNOW_OK;
}

void snow_aggregate_list_points(const snow_grid *grid, uint64_t first, snow_point *points, size_t count)
{
    const aggregate *model = aggregate_of(grid);
    if (model->scene->points != NULL) {
        model->scene->points(grid, first, points, count);
        return;
    }
    for (size_t i = 0; i < count; i++)
        points[i] = snow_aggregate_point_of(model->params.lattice, snow_sites_at(&model->sites, first + i));
}

snow_status snow_aggregate_points(const snow_grid *grid, uint64_t first, snow_point *points, size_t count)
{
    snow_status status = check_range(grid, first, points, count);
    if (status != SNOW_OK)
        return status;
    snow_floating floating;
    snow_floating_enter(&floating);
    snow_aggregate_list_points(grid, first, points, count);
    snow_floating_leave(&floating);
    return SNOW_OK;
}

snow_status snow_aggregate_order_at(const snow_grid *grid, snow_site site, int64_t *order)
{
    snow_status status = check(grid, order);
    if (status != SNOW_OK)
        return status;
    const aggregate *model = aggregate_of(grid);
    if (model->scene->count != NULL)
        return SNOW_ERROR_UNSUPPORTED;
    if (!model->params.record_order)
        return SNOW_ERROR_NOT_RECORDED;
    int32_t reach = aggregate_reach(&model->params);
    bool known = site.x > -reach && site.x < reach && site.y > -reach && site.y < reach && site.z > -reach &&
                 site.z < reach && (model->sites.space || site.z == 0);
    *order = known ? snow_order_find(&model->order, &model->sites, site) : -1;
    return SNOW_OK;
}

/* The oldest neighbour that was there before. */
static int64_t parent_of(const aggregate *model, const snow_order *order, uint64_t number)
{
    const aggregate_neighbours *around = snow_aggregate_contacts(&model->params);
    snow_site site = snow_sites_at(&model->sites, number);
    int64_t oldest = (int64_t)number;
    for (int i = 0; i < around->count; i++) {
        snow_site beside = snow_aggregate_beside(&model->params, site, around->step[i]);
        int64_t there = snow_order_find(order, &model->sites, beside);
        oldest = there >= 0 && there < oldest ? there : oldest;
    }
    return oldest < (int64_t)number ? oldest : -1;
}

static snow_status list_parents(const snow_grid *grid, int64_t *parents)
{
    const aggregate *model = aggregate_of(grid);
    snow_order order = model->order;
    snow_heap heap = grid->heap; /* the table goes back before anyone can ask how much is used */
    if (!model->params.record_order) {
        snow_status status = snow_order_reserve(&order, &heap, &model->sites, model->sites.count);
        if (status != SNOW_OK)
            return status;
        for (uint64_t i = 0; i < model->sites.count; i++)
            snow_order_add(&order, &model->sites, i);
    }
    for (uint64_t i = 0; i < model->sites.count; i++)
        parents[i] = i < model->seeds ? -1 : parent_of(model, &order, i);
    if (!model->params.record_order)
        snow_order_end(&order, &heap);
    return SNOW_OK;
}

snow_status snow_aggregate_parents(const snow_grid *grid, int64_t *parents, size_t capacity, size_t *count)
{
    snow_status status = check(grid, parents != NULL ? (const void *)parents : (const void *)count);
    if (status != SNOW_OK)
        return status;
    const aggregate *model = aggregate_of(grid);
    if (model->params.scene == SNOW_AGGREGATE_SHORE || model->params.scene == SNOW_AGGREGATE_CLUSTER_CLUSTER)
        return SNOW_ERROR_UNSUPPORTED;
    uint64_t particles = snow_aggregate_count(grid);
    if (particles > SIZE_MAX / sizeof *parents)
        return SNOW_ERROR_TOO_LARGE;
    if (count != NULL)
        *count = (size_t)particles;
    if (parents == NULL)
        return SNOW_OK;
    if (capacity < particles)
        return SNOW_ERROR_BUFFER;
    if (model->scene->parent == NULL)
        return list_parents(grid, parents);
    for (uint64_t i = 0; i < particles; i++)
        parents[i] = model->scene->parent(grid, i);
    return SNOW_OK;
}
