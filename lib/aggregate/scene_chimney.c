/* The chimney (Shipilevsky 1989): soot rises between two walls, which may
   slant, and stays on walls and soot. */
#include "aggregate/fall.h"

/* The column of a wall in a row, rounded to the nearest. */
static int32_t wall_at(int32_t bottom, int32_t top, int32_t row, int32_t height)
{
    int64_t rows = height > 1 ? height - 1 : 1;
    int64_t way = ((int64_t)top - bottom) * row;
    int64_t half = way < 0 ? -rows : rows;
    return bottom + (int32_t)((2 * way + half) / (2 * rows));
}

static int32_t left_wall(const snow_aggregate_params *params, int32_t row)
{
    return wall_at(params->wall_left, params->wall_left_top, row, params->height);
}

static int32_t right_wall(const snow_aggregate_params *params, int32_t row)
{
    return wall_at(params->wall_right, params->wall_right_top, row, params->height);
}

static snow_status add_electrodes(snow_grid *grid, int32_t first, int32_t last, int32_t row)
{
    snow_status status = SNOW_OK;
    for (int32_t x = first; x <= last && status == SNOW_OK; x++)
        status = snow_fall_add_electrode(grid, (snow_site){x, row, 0});
    return status;
}

/* Where a wall leans inwards its rows overlap, so that nothing slips through. */
static snow_status build_walls(snow_grid *grid)
{
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    snow_status status = SNOW_OK;
    for (int32_t row = 0; row < params->height && status == SNOW_OK; row++) {
        int32_t below = row > 0 ? row - 1 : 0;
        int32_t left = left_wall(params, row);
        int32_t right = right_wall(params, row);
        int32_t left_below = left_wall(params, below);
        int32_t right_below = right_wall(params, below);
        status = add_electrodes(grid, left_below < left ? left_below : left, left, row);
        if (status == SNOW_OK)
            status = add_electrodes(grid, right, right_below > right ? right_below : right, row);
    }
    return status;
}

static snow_status create(snow_grid *grid)
{
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    snow_status status = snow_fall_create(grid, 1, 0, params->wall_left + 1, params->wall_right - 1);
    return status == SNOW_OK ? build_walls(grid) : status;
}

static bool inside(const snow_grid *grid, snow_site site)
{
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    return site.y >= 0 && site.y < params->height && site.z == 0 && site.x > left_wall(params, site.y) &&
           site.x < right_wall(params, site.y);
}

static snow_status check(const snow_grid *grid)
{
    return fall_of(grid)->launch_free > 0 ? SNOW_OK : SNOW_ERROR_AGGREGATE_LAUNCH;
}

const aggregate_scene snow_aggregate_chimney = {
    .create = create,
    .check = check,
    .prepare = snow_fall_prepare,
    .place = snow_fall_place,
    .walk = snow_fall_walk,
    .filled = snow_fall_filled,
    .inside = inside,
    .destroy = snow_fall_destroy,
};
