#include "base/floating.h"
#include "base/model.h"

snow_status snow_model_of(const snow_grid *grid, snow_model *model)
{
    if (grid == NULL || model == NULL)
        return SNOW_ERROR_NULL;
    *model = grid->operations->model;
    return SNOW_OK;
}

snow_status snow_steps(const snow_grid *grid, int64_t *steps)
{
    if (grid == NULL || steps == NULL)
        return SNOW_ERROR_NULL;
    *steps = grid->census.steps;
    return SNOW_OK;
}

snow_status snow_frozen(const snow_grid *grid, uint64_t *cells)
{
    if (grid == NULL || cells == NULL)
        return SNOW_ERROR_NULL;
    if (grid->census.frozen_high > 0)
        return SNOW_ERROR_TOO_LARGE;
    *cells = grid->census.frozen;
    return SNOW_OK;
}

snow_status snow_tip_radius(const snow_grid *grid, double *radius)
{
    if (grid == NULL || radius == NULL)
        return SNOW_ERROR_NULL;
    snow_floating floating;
    snow_floating_enter(&floating);
    snow_census census = snow_census_of(grid);
    *radius = snow_census_tip(&census);
    snow_floating_leave(&floating);
    return SNOW_OK;
}

snow_status snow_frozen_bounds(const snow_grid *grid, snow_rect *bounds)
{
    if (grid == NULL || bounds == NULL)
        return SNOW_ERROR_NULL;
    snow_census census = snow_census_of(grid);
    if (!snow_domain_reaches(&census.hexagon))
        return SNOW_ERROR_TOO_LARGE;
    *bounds = snow_domain_rect(&census.hexagon);
    return SNOW_OK;
}

snow_status snow_frozen_hexagon(const snow_grid *grid, snow_hexagon *hexagon)
{
    if (grid == NULL || hexagon == NULL)
        return SNOW_ERROR_NULL;
    *hexagon = snow_census_of(grid).hexagon;
    return SNOW_OK;
}

snow_status snow_domain_bounds(const snow_grid *grid, snow_rect *bounds)
{
    if (grid == NULL || bounds == NULL)
        return SNOW_ERROR_NULL;
    if (grid->domain.too_large)
        return SNOW_ERROR_TOO_LARGE;
    *bounds = grid->domain.bounds;
    return SNOW_OK;
}

snow_status snow_domain_cells(const snow_grid *grid, uint64_t *cells)
{
    if (grid == NULL || cells == NULL)
        return SNOW_ERROR_NULL;
    if (grid->domain.too_large)
        return SNOW_ERROR_TOO_LARGE;
    *cells = grid->domain.cells;
    return SNOW_OK;
}

snow_status snow_memory(const snow_grid *grid, uint64_t *bytes)
{
    if (grid == NULL || bytes == NULL)
        return SNOW_ERROR_NULL;
    *bytes = grid->heap.used;
    return SNOW_OK;
}

snow_status snow_isa_of(const snow_grid *grid, snow_isa *isa)
{
    if (grid == NULL || isa == NULL)
        return SNOW_ERROR_NULL;
    *isa = grid->options.isa;
    return SNOW_OK;
}
