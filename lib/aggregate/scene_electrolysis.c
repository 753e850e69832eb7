/* Electrolysis (Shipilevsky 1989): ions fall from the top row and stay within
   the interaction radius of cathode or deposit, next to what is nearest. */
#include "aggregate/fall.h"

static int32_t greater(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

static int32_t lesser(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static snow_status create(snow_grid *grid)
{
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    int32_t last_column = params->width - 1;
    snow_status status = snow_fall_create(grid, -1, params->interaction, greater(params->launch_first, 0),
                                          lesser(params->launch_last, last_column));
    int32_t last = lesser(params->cathode_last, last_column);
    for (int32_t x = greater(params->cathode_first, 0); x <= last && status == SNOW_OK; x++)
        status = snow_fall_add_electrode(grid, (snow_site){x, -1, 0});
    return status;
}

static bool inside(const snow_grid *grid, snow_site site)
{
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    return site.x >= 0 && site.x < params->width && site.y >= 0 && site.y < params->height && site.z == 0;
}

/* An ion that falls y rows can come y columns farther on each side. */
static bool is_reached(const fall *self, int32_t x, int32_t y)
{
    int64_t fallen = self->launch_row - y;
    int64_t width = self->attraction.width;
    int64_t first = self->launch_first - fallen;
    int64_t last = self->launch_last + fallen;
    if (x >= first && x <= last)
        return true;
    return self->attraction.periodic && (x - width >= first || x + width <= last);
}

static snow_status check(const snow_grid *grid)
{
    const fall *self = fall_of(grid);
    if (self->launch_free == 0)
        return SNOW_ERROR_AGGREGATE_LAUNCH;
    int32_t rows = lesser(self->cells.low.y + self->cells.extent.y, self->launch_row + 1);
    for (int32_t y = 0; y < rows && self->cells.mark != NULL; y++)
        for (int32_t x = 0; x < self->attraction.width; x++)
            if ((snow_cells_get(&self->cells, (snow_site){x, y, 0}) & SNOW_CELL_NEAR) && is_reached(self, x, y))
                return SNOW_OK;
    return SNOW_ERROR_AGGREGATE_PATH;
}

const aggregate_scene snow_aggregate_electrolysis = {
    .create = create,
    .check = check,
    .prepare = snow_fall_prepare,
    .place = snow_fall_place,
    .walk = snow_fall_walk,
    .filled = snow_fall_filled,
    .inside = inside,
    .destroy = snow_fall_destroy,
};
