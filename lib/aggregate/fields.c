/* Cells of the plane, as the calls of grid.h see them. */
#include "aggregate/model.h"

static bool has_filled(const aggregate *model)
{
    return model->scene->filled != NULL || model->params.record_order;
}

snow_status snow_aggregate_can_read(const snow_grid *grid, snow_field field)
{
    const aggregate *model = aggregate_of(grid);
    const snow_aggregate_params *params = &model->params;
    bool plane = !aggregate_is_space(params) && params->scene != SNOW_AGGREGATE_OFF_LATTICE;
    switch (field) {
    case SNOW_FIELD_VALUE:
    case SNOW_FIELD_FROZEN:
    case SNOW_FIELD_RECEPTIVE:
        if (plane)
            return has_filled(model) ? SNOW_OK : SNOW_ERROR_NOT_RECORDED;
        break;
    case SNOW_FIELD_INSIDE: return plane ? SNOW_OK : SNOW_ERROR_UNSUPPORTED;
    case SNOW_FIELD_FREEZE_STEP:
        if (plane && params->scene != SNOW_AGGREGATE_CLUSTER_CLUSTER)
            return params->record_order ? SNOW_OK : SNOW_ERROR_NOT_RECORDED;
        break;
    case SNOW_FIELD_VAPOUR:
    case SNOW_FIELD_ADDITION:
    case SNOW_FIELD_BACKGROUND: break;
    }
    return SNOW_ERROR_UNSUPPORTED;
}

static bool is_filled(const snow_grid *grid, snow_site site)
{
    const aggregate *model = aggregate_of(grid);
    if (model->scene->filled != NULL)
        return model->scene->filled(grid, site);
    return snow_order_find(&model->order, &model->sites, site) >= 0;
}

static bool is_inside(const snow_grid *grid, snow_site site)
{
    const aggregate *model = aggregate_of(grid);
    return model->scene->inside == NULL || model->scene->inside(grid, site);
}

/* The site one step away; in a periodic box round it. */
static snow_site beside(const snow_grid *grid, snow_site site, snow_site step)
{
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    snow_site next = snow_aggregate_beside(params, site, step);
    if (params->scene != SNOW_AGGREGATE_CLUSTER_CLUSTER)
        return next;
    int32_t side = snow_aggregate_box(grid);
    return (snow_site){(next.x + side) % side, (next.y + side) % side, next.z};
}

static bool is_receptive(const snow_grid *grid, snow_site site)
{
    if (is_filled(grid, site))
        return true;
    if (!is_inside(grid, site))
        return false;
    const aggregate_neighbours *around = snow_aggregate_contacts(&aggregate_of(grid)->params);
    for (int i = 0; i < around->count; i++)
        if (is_filled(grid, beside(grid, site, around->step[i])))
            return true;
    return false;
}

/* Steps are counted from 1, particles from 0 with the seeds first. */
static double freeze_step(const aggregate *model, snow_site site)
{
    int64_t order = snow_order_find(&model->order, &model->sites, site);
    if (order < 0)
        return -1;
    return (uint64_t)order < model->seeds ? 0 : (double)((uint64_t)order - model->seeds + 1);
}

static double read_one(const snow_grid *grid, snow_field field, snow_site site)
{
    const aggregate *model = aggregate_of(grid);
    switch (field) {
    case SNOW_FIELD_VALUE:
        if (model->params.scene == SNOW_AGGREGATE_SHORE)
            return snow_aggregate_hardness(grid, site);
        return is_filled(grid, site);
    case SNOW_FIELD_FROZEN: return is_filled(grid, site);
    case SNOW_FIELD_RECEPTIVE: return is_receptive(grid, site);
    case SNOW_FIELD_INSIDE: return is_inside(grid, site);
    case SNOW_FIELD_FREEZE_STEP: return freeze_step(model, site);
    case SNOW_FIELD_VAPOUR:
    case SNOW_FIELD_ADDITION:
    case SNOW_FIELD_BACKGROUND: break;
    }
    return 0;
}

void snow_aggregate_read(const snow_grid *grid, snow_field field, int64_t q, int64_t r, size_t count, double *values)
{
    /* Beyond half the range of coordinates there is nothing, and steps to neighbours stay in range. */
    const int64_t reach = INT32_MAX / 2;
    for (size_t i = 0; i < count; i++, q++) {
        bool known = q > -reach && q < reach && r > -reach && r < reach;
        double otherwise = field == SNOW_FIELD_FREEZE_STEP ? -1 : 0;
        values[i] = known ? read_one(grid, field, (snow_site){(int32_t)q, (int32_t)r, 0}) : otherwise;
    }
}

snow_status snow_aggregate_set(snow_grid *grid, snow_field field, const snow_rect *rect, const double *values)
{
    (void)grid;
    (void)field;
    (void)rect;
    (void)values;
    return SNOW_ERROR_UNSUPPORTED;
}
