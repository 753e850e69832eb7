#include "aggregate/attraction.h"

static const uint8_t matter = SNOW_CELL_FILLED | SNOW_CELL_ELECTRODE;

static int32_t square_of(snow_site offset)
{
    return offset.x * offset.x + offset.y * offset.y;
}

/* Touching counts at any distance: the eight neighbours. */
static int32_t greatest_square(double distance)
{
    double square = distance * distance;
    return square > 2 ? (int32_t)square : 2;
}

/* Sorts the disc by counting squares. */
static snow_status list_disc(attraction *self, snow_heap *heap, int32_t greatest)
{
    uint32_t *count = snow_heap_get(heap, (size_t)greatest + 2, sizeof *count);
    if (count == NULL)
        return heap->refusal;
    for (int32_t y = -self->reach; y <= self->reach; y++)
        for (int32_t x = -self->reach; x <= self->reach; x++)
            if (x * x + y * y <= greatest)
                count[x * x + y * y + 1]++;
    for (int32_t square = 0; square <= greatest; square++)
        count[square + 1] += count[square];
    self->offsets = count[greatest + 1];
    for (int32_t d = 0; d <= self->reach + 1; d++) {
        int32_t square = d * d;
        self->start[d] = square <= greatest ? count[square] : (uint32_t)self->offsets;
    }
    self->offset = snow_heap_get(heap, self->offsets, sizeof *self->offset);
    for (int32_t y = -self->reach; y <= self->reach && self->offset != NULL; y++)
        for (int32_t x = -self->reach; x <= self->reach; x++)
            if (x * x + y * y <= greatest)
                self->offset[count[x * x + y * y]++] = (snow_site){x, y, 0};
    snow_heap_put(heap, count);
    return self->offset != NULL ? SNOW_OK : heap->refusal;
}

static snow_status list_rim(attraction *self, snow_heap *heap, int direction, int32_t greatest)
{
    snow_site step = snow_aggregate_eight.step[direction];
    self->rim[direction] = snow_heap_get(heap, self->offsets, sizeof *self->rim[direction]);
    if (self->rim[direction] == NULL)
        return heap->refusal;
    for (size_t i = 0; i < self->offsets; i++)
        if (square_of(aggregate_moved(self->offset[i], step)) > greatest)
            self->rim[direction][self->rims[direction]++] = self->offset[i];
    return SNOW_OK;
}

snow_status snow_attraction_start(attraction *self, snow_heap *heap, double distance, int32_t width, bool periodic)
{
    *self = (attraction){.distance = distance, .width = width, .periodic = periodic};
    self->reach = distance > 1 ? (int32_t)distance : 1;
    self->start = snow_heap_get(heap, (size_t)self->reach + 2, sizeof *self->start);
    if (self->start == NULL)
        return heap->refusal;
    int32_t greatest = greatest_square(distance);
    snow_status status = list_disc(self, heap, greatest);
    for (int direction = 0; direction < 8 && status == SNOW_OK; direction++)
        status = list_rim(self, heap, direction, greatest);
    return status;
}

void snow_attraction_end(attraction *self, snow_heap *heap)
{
    for (int direction = 0; direction < 8; direction++)
        snow_heap_put(heap, self->rim[direction]);
    snow_heap_put(heap, self->offset);
    snow_heap_put(heap, self->start);
    *self = (attraction){0};
}

static void mark(const attraction *self, snow_cells *cells, snow_site site, const snow_site *offset, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        snow_site near = aggregate_moved(site, offset[i]);
        if (snow_attraction_wrap(self, &near))
            snow_cells_mark(cells, near, SNOW_CELL_NEAR);
    }
}

void snow_attraction_mark(const attraction *self, snow_cells *cells, snow_site site)
{
    for (int direction = 0; direction < 8; direction++) {
        snow_site step = snow_aggregate_eight.step[direction];
        snow_site older = {site.x - step.x, site.y - step.y, 0};
        if (snow_attraction_wrap(self, &older) && (snow_cells_get(cells, older) & matter)) {
            mark(self, cells, site, self->rim[direction], self->rims[direction]);
            return;
        }
    }
    mark(self, cells, site, self->offset, self->offsets);
}

static int32_t sign(int32_t x)
{
    return (x > 0) - (x < 0);
}

snow_site snow_attraction_end_of(const attraction *self, const snow_cells *cells, snow_stream *stream, snow_site site,
                                 double bound)
{
    size_t first = self->start[bound > 0 ? (int32_t)bound : 0];
    int32_t nearest = INT32_MAX;
    uint32_t ties = 0;
    snow_site chosen = {0, 0, 0};
    for (size_t i = first; i < self->offsets && square_of(self->offset[i]) <= nearest; i++) {
        snow_site cell = aggregate_moved(site, self->offset[i]);
        if (!snow_attraction_wrap(self, &cell) || !(snow_cells_get(cells, cell) & matter))
            continue;
        nearest = square_of(self->offset[i]);
        if (ties == 0 || snow_stream_below(stream, ties + 1) == 0)
            chosen = self->offset[i];
        ties++;
    }
    snow_site end = {site.x + chosen.x - sign(chosen.x), site.y + chosen.y - sign(chosen.y), 0};
    snow_attraction_wrap(self, &end);
    return end;
}
