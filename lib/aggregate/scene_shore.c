/* Erosion of a shore (Shipilevsky 1989): waves come in the three moves and wear
   the land; a cell that has no hardness left is washed away with the wave. */
#include "aggregate/leap.h"
#include "aggregate/model.h"

typedef struct shore {
    uint16_t *hardness; /* row by row; 0: water */
    uint32_t *land;     /* cells of land in each row */
    uint64_t left;      /* cells of land */
    int32_t highest;    /* row of land; −1: none */
} shore;

static shore *shore_of(const snow_grid *grid)
{
    return aggregate_of(grid)->state;
}

static uint16_t *cell_at(const snow_grid *grid, int32_t x, int32_t y)
{
    return &shore_of(grid)->hardness[(size_t)y * (size_t)aggregate_of(grid)->params.width + (size_t)x];
}

static uint16_t first_hardness(const snow_aggregate_params *params, int32_t x, int32_t y)
{
    uint32_t range = (uint32_t)(params->hardness_greatest - params->hardness_least + 1);
    double drawn = snow_random_at(params->random_seed, SNOW_RANDOM_HARDNESS, x, y, 0);
    return (uint16_t)(params->hardness_least + (int32_t)(drawn * range));
}

static snow_status create(snow_grid *grid)
{
    aggregate *model = aggregate_of(grid);
    const snow_aggregate_params *params = &model->params;
    shore *self = snow_heap_get(&grid->heap, 1, sizeof *self);
    if (self == NULL)
        return grid->heap.refusal;
    model->state = self;
    size_t width = (size_t)params->width;
    size_t height = (size_t)params->height;
    if (width > SIZE_MAX / sizeof *self->hardness / height)
        return SNOW_ERROR_TOO_LARGE;
    self->land = snow_heap_get_raw(&grid->heap, height, sizeof *self->land);
    if (self->land == NULL)
        return grid->heap.refusal;
    self->hardness = snow_heap_get_raw(&grid->heap, width * height, sizeof *self->hardness);
    if (self->hardness == NULL)
        return grid->heap.refusal;
    for (int32_t y = 0; y < params->height; y++) {
        self->land[y] = (uint32_t)width;
        for (int32_t x = 0; x < params->width; x++)
            *cell_at(grid, x, y) = first_hardness(params, x, y);
    }
    self->left = (uint64_t)width * height;
    self->highest = params->height - 1;
    return SNOW_OK;
}

/* A cell is washed away. */
static snow_status place(snow_grid *grid, snow_site site)
{
    shore *self = shore_of(grid);
    *cell_at(grid, site.x, site.y) = 0;
    self->land[site.y]--;
    self->left--;
    while (self->highest >= 0 && self->land[self->highest] == 0)
        self->highest--;
    grid->census.full |= self->left == 0;
    return SNOW_OK;
}

/* One wave from the horizon, the row above the highest land; true when it washed a cell away. */
static bool send_wave(snow_grid *grid, snow_stream *stream, snow_site *washed)
{
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    const shore *self = shore_of(grid);
    int32_t x = (int32_t)snow_stream_below(stream, (uint32_t)params->width);
    int32_t y = self->highest + 1;
    while (y > 0) {
        int32_t moved = x + (int32_t)snow_stream_below(stream, 3) - 1;
        int32_t next = snow_leap_fold(moved, params->width, params->periodic);
        uint16_t *hardness = cell_at(grid, next, y - 1);
        if (*hardness == 0) {
            x = next;
            y--;
        } else if (snow_stream_chance(stream, params->sticking) && --*hardness == 0) {
            *washed = (snow_site){next, y - 1, 0};
            return true;
        }
    }
    return false;
}

static snow_status grow(snow_grid *grid, int64_t most, const snow_stop *stop)
{
    aggregate *model = aggregate_of(grid);
    int64_t washed = 0;
    for (int32_t waves = 0; washed < most && waves < AGGREGATE_TURN && !grid->census.full; waves++) {
        snow_stream stream = snow_stream_start(model->params.random_seed, SNOW_RANDOM_WALK, model->walkers++);
        snow_site site;
        if (!send_wave(grid, &stream, &site))
            continue;
        place(grid, site);
        snow_aggregate_join(grid, site);
        grid->census.steps++;
        washed++;
        if (snow_aggregate_stops(grid, stop))
            break;
    }
    return SNOW_OK;
}

static bool inside(const snow_grid *grid, snow_site site)
{
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    return site.x >= 0 && site.x < params->width && site.y >= 0 && site.y < params->height && site.z == 0;
}

uint32_t snow_aggregate_hardness(const snow_grid *grid, snow_site site)
{
    return inside(grid, site) ? *cell_at(grid, site.x, site.y) : 0;
}

static bool filled(const snow_grid *grid, snow_site site)
{
    return inside(grid, site) && *cell_at(grid, site.x, site.y) == 0;
}

static void save_hardness(snow_sink *sink, uint16_t hardness)
{
    snow_sink_u8(sink, (uint8_t)hardness);
    snow_sink_u8(sink, (uint8_t)(hardness >> 8));
}

static uint16_t load_hardness(snow_source *source)
{
    uint16_t low = snow_source_u8(source);
    return (uint16_t)(low | snow_source_u8(source) << 8);
}

/* What the land has left: only where waves have been it is not the hardness of the start. */
static void save(const snow_grid *grid, snow_sink *sink)
{
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    for (int32_t y = 0; y < params->height; y++)
        for (int32_t x = 0; x < params->width; x++)
            save_hardness(sink, *cell_at(grid, x, y));
}

static snow_status load(snow_grid *grid, snow_source *source)
{
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    for (int32_t y = 0; y < params->height; y++) {
        for (int32_t x = 0; x < params->width; x++) {
            uint16_t left = load_hardness(source);
            uint16_t *hardness = cell_at(grid, x, y);
            if (source->truncated)
                return SNOW_ERROR_TRUNCATED;
            if (left > first_hardness(params, x, y) || (left == 0) != (*hardness == 0))
                return SNOW_ERROR_DAMAGED;
            *hardness = left;
        }
    }
    return SNOW_OK;
}

static void destroy(snow_grid *grid)
{
    shore *self = shore_of(grid);
    snow_heap_put(&grid->heap, self->hardness);
    snow_heap_put(&grid->heap, self->land);
    snow_heap_put(&grid->heap, self);
}

const aggregate_scene snow_aggregate_shore = {
    .create = create,
    .place = place,
    .grow = grow,
    .filled = filled,
    .inside = inside,
    .save = save,
    .load = load,
    .destroy = destroy,
};
