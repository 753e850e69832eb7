/* The snowflake (Shipilevsky 1989): eight moves in a window one cell wider than
   the cluster, which turns walkers back. */
#include "aggregate/cells.h"
#include "aggregate/model.h"

typedef struct snowflake {
    snow_cells cells;
} snowflake;

static snowflake *snowflake_of(const snow_grid *grid)
{
    return aggregate_of(grid)->state;
}

static snow_status create(snow_grid *grid)
{
    aggregate_of(grid)->state = snow_heap_get(&grid->heap, 1, sizeof(snowflake));
    return aggregate_of(grid)->state != NULL ? SNOW_OK : grid->heap.refusal;
}

static snow_status cover(snow_grid *grid, snow_site low, snow_site high)
{
    enum { MARGIN = 2 };
    return snow_cells_cover(&snowflake_of(grid)->cells, &grid->heap, (snow_site){low.x - MARGIN, low.y - MARGIN, 0},
                            (snow_site){high.x + MARGIN, high.y + MARGIN, 0});
}

/* Particles join within one cell of those that are there. */
static snow_status prepare(snow_grid *grid)
{
    snow_site low = aggregate_of(grid)->low;
    snow_site high = aggregate_of(grid)->high;
    return cover(grid, (snow_site){low.x - 1, low.y - 1, 0}, (snow_site){high.x + 1, high.y + 1, 0});
}

static snow_status place(snow_grid *grid, snow_site site)
{
    snow_cells *cells = &snowflake_of(grid)->cells;
    snow_status status = cover(grid, site, site);
    if (status != SNOW_OK)
        return status;
    snow_cells_mark(cells, site, SNOW_CELL_FILLED);
    for (int i = 0; i < snow_aggregate_eight.count; i++)
        snow_cells_mark(cells, aggregate_moved(site, snow_aggregate_eight.step[i]), SNOW_CELL_NEAR);
    return SNOW_OK;
}

/* The k-th cell of the window's perimeter. */
static snow_site perimeter(snow_site low, snow_site high, uint32_t k)
{
    uint32_t across = (uint32_t)(high.x - low.x);
    uint32_t up = (uint32_t)(high.y - low.y);
    if (k < across)
        return (snow_site){low.x + (int32_t)k, low.y, 0};
    k -= across;
    if (k < up)
        return (snow_site){high.x, low.y + (int32_t)k, 0};
    k -= up;
    if (k < across)
        return (snow_site){high.x - (int32_t)k, high.y, 0};
    return (snow_site){low.x, high.y - (int32_t)(k - across), 0};
}

/* A step through a side of the window is turned round. */
static int32_t turned(int32_t x, int32_t step, int32_t low, int32_t high)
{
    return x + step < low || x + step > high ? x - step : x + step;
}

static bool walk(const snow_grid *grid, snow_stream *stream, snow_site *end)
{
    const aggregate *model = aggregate_of(grid);
    const snow_cells *cells = &snowflake_of(grid)->cells;
    snow_site low = {model->low.x - 1, model->low.y - 1, 0};
    snow_site high = {model->high.x + 1, model->high.y + 1, 0};
    uint32_t length = 2 * ((uint32_t)(high.x - low.x) + (uint32_t)(high.y - low.y));
    snow_site at = perimeter(low, high, snow_stream_below(stream, length));
    for (;;) {
        snow_site step = snow_aggregate_eight.step[snow_stream_below(stream, 8)];
        snow_site next = {turned(at.x, step.x, low.x, high.x), turned(at.y, step.y, low.y, high.y), 0};
        if (!(snow_cells_get(cells, next) & SNOW_CELL_FILLED))
            at = next;
        if ((snow_cells_get(cells, at) & SNOW_CELL_NEAR) && snow_stream_chance(stream, model->params.sticking))
            break;
    }
    *end = at;
    return true;
}

static bool filled(const snow_grid *grid, snow_site site)
{
    return (snow_cells_get(&snowflake_of(grid)->cells, site) & SNOW_CELL_FILLED) != 0;
}

static void destroy(snow_grid *grid)
{
    snow_cells_end(&snowflake_of(grid)->cells, &grid->heap);
    snow_heap_put(&grid->heap, snowflake_of(grid));
}

const aggregate_scene snow_aggregate_snowflake = {
    .create = create,
    .prepare = prepare,
    .place = place,
    .walk = walk,
    .filled = filled,
    .destroy = destroy,
};
