#include "aggregate/fall.h"

enum { BLOCK = 64, LEAP = 32, NONE = -2 };

static const double diagonal = 0x1.6a09e667f3bcdp+0;

snow_status snow_fall_create(snow_grid *grid, int32_t rise, double interaction, int32_t launch_first,
                             int32_t launch_last)
{
    aggregate *model = aggregate_of(grid);
    const snow_aggregate_params *params = &model->params;
    bool periodic = params->scene == SNOW_AGGREGATE_ELECTROLYSIS && params->periodic;
    fall *self = snow_heap_get(&grid->heap, 1, sizeof *self);
    if (self == NULL)
        return grid->heap.refusal;
    model->state = self;
    self->rise = rise;
    self->top = NONE;
    self->launch_row = rise < 0 ? params->height - 1 : 0;
    self->launch_first = launch_first;
    self->launch_last = launch_last;
    self->launch_free = launch_last - launch_first + 1;
    size_t blocks = (size_t)params->width / BLOCK + 1;
    self->canopy = snow_heap_get(&grid->heap, blocks, sizeof *self->canopy);
    if (self->canopy == NULL)
        return grid->heap.refusal;
    for (size_t i = 0; i < blocks; i++)
        self->canopy[i] = NONE;
    snow_status status = snow_attraction_start(&self->attraction, &grid->heap, interaction, params->width, periodic);
    if (status == SNOW_OK)
        status = snow_leaps_start(&self->leaps, &grid->heap);
    return status;
}

/* Room for what feels a deposit up to this row. */
static snow_status cover(snow_grid *grid, int32_t row)
{
    fall *self = fall_of(grid);
    snow_site low = {0, -1, 0};
    snow_site high = {self->attraction.width - 1, row + self->attraction.reach + 2, 0};
    return snow_cells_cover(&self->cells, &grid->heap, low, high);
}

/* Particles join within one row of those that are there, or of what holds them. */
snow_status snow_fall_prepare(snow_grid *grid)
{
    const aggregate *model = aggregate_of(grid);
    return cover(grid, model->sites.count > 0 ? model->high.y + 1 : 0);
}

static void raise_canopy(fall *self, snow_site site)
{
    int32_t reach = self->attraction.reach;
    int32_t row = site.y + reach;
    self->top = row > self->top ? row : self->top;
    for (int32_t x = site.x - reach; x <= site.x + reach; x++) {
        snow_site column = {x, 0, 0};
        if (!snow_attraction_wrap(&self->attraction, &column))
            continue;
        int32_t *block = &self->canopy[column.x / BLOCK];
        *block = row > *block ? row : *block;
    }
}

static snow_status add(snow_grid *grid, snow_site site, uint8_t mark)
{
    fall *self = fall_of(grid);
    snow_status status = cover(grid, site.y);
    if (status != SNOW_OK)
        return status;
    *snow_cells_at(&self->cells, site) |= mark;
    snow_attraction_mark(&self->attraction, &self->cells, site);
    raise_canopy(self, site);
    if (site.y == self->launch_row && site.x >= self->launch_first && site.x <= self->launch_last)
        self->launch_free--;
    grid->census.full |= self->launch_free == 0;
    return SNOW_OK;
}

snow_status snow_fall_add_electrode(snow_grid *grid, snow_site site)
{
    return add(grid, site, SNOW_CELL_ELECTRODE);
}

snow_status snow_fall_place(snow_grid *grid, snow_site site)
{
    return add(grid, site, SNOW_CELL_FILLED);
}

static snow_site launch(const fall *self, snow_stream *stream)
{
    uint32_t columns = (uint32_t)(self->launch_last - self->launch_first + 1);
    for (;;) {
        snow_site site = {self->launch_first + (int32_t)snow_stream_below(stream, columns), self->launch_row, 0};
        if (!(snow_cells_get(&self->cells, site) & (SNOW_CELL_FILLED | SNOW_CELL_ELECTRODE)))
            return site;
    }
}

static void leap(const fall *self, snow_stream *stream, snow_site *at, int32_t steps)
{
    int64_t x = at->x + snow_leaps_draw(&self->leaps, stream, steps);
    at->x = snow_leap_fold(x, self->attraction.width, self->attraction.periodic);
    at->y -= steps;
}

/* Whether a leap leads to rows that feel nothing of the deposit, whichever way it goes. Over the seam of a ring
   none is taken. */
static bool can_leap(const fall *self, snow_site at)
{
    int32_t last = self->attraction.width - 1;
    int32_t left = at.x - LEAP;
    int32_t right = at.x + LEAP;
    int32_t lowest = at.y - LEAP;
    if (lowest < 0 || (self->attraction.periodic && (left < 0 || right > last)))
        return false;
    left = left < 0 ? 0 : left;
    right = right > last ? last : right;
    return self->canopy[left / BLOCK] < lowest && self->canopy[at.x / BLOCK] < lowest &&
           self->canopy[right / BLOCK] < lowest;
}

static bool has_left(const fall *self, const aggregate *model, snow_site site)
{
    return self->rise < 0 ? site.y < 0 : site.y >= model->params.height;
}

bool snow_fall_walk(const snow_grid *grid, snow_stream *stream, snow_site *end)
{
    const aggregate *model = aggregate_of(grid);
    const fall *self = fall_of(grid);
    snow_site at = launch(self, stream);
    double bound = 0; /* no cell of the deposit is nearer than this */
    if (self->rise < 0 && at.y - 1 > self->top)
        leap(self, stream, &at, at.y - 1 - (self->top >= 0 ? self->top : 0));
    for (;;) {
        bool near = (snow_cells_get(&self->cells, at) & SNOW_CELL_NEAR) != 0;
        bound = near ? bound - diagonal : self->attraction.distance;
        if (near && snow_stream_chance(stream, model->params.sticking))
            break;
        if (self->rise < 0 && !near && can_leap(self, at)) {
            leap(self, stream, &at, LEAP);
            continue;
        }
        int32_t x = at.x + (int32_t)snow_stream_below(stream, 3) - 1;
        snow_site next = {snow_leap_fold(x, self->attraction.width, self->attraction.periodic), at.y + self->rise, 0};
        if (!(snow_cells_get(&self->cells, next) & (SNOW_CELL_FILLED | SNOW_CELL_ELECTRODE)))
            at = next;
        if (has_left(self, model, at))
            return false;
    }
    *end = snow_attraction_end_of(&self->attraction, &self->cells, stream, at, bound);
    return true;
}

bool snow_fall_filled(const snow_grid *grid, snow_site site)
{
    return (snow_cells_get(&fall_of(grid)->cells, site) & SNOW_CELL_FILLED) != 0;
}

void snow_fall_destroy(snow_grid *grid)
{
    fall *self = fall_of(grid);
    snow_cells_end(&self->cells, &grid->heap);
    snow_attraction_end(&self->attraction, &grid->heap);
    snow_leaps_end(&self->leaps, &grid->heap);
    snow_heap_put(&grid->heap, self->canopy);
    snow_heap_put(&grid->heap, self);
}
