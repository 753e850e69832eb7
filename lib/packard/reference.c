/* The plain reading of the rule, a byte a cell, every cell in every step. It
   is there to be read, and to be compared with: it shares no code of a step
   with the other engines. */
#include "base/hexagon.h"
#include "packard/model.h"

#include <string.h>

/* Cells of a rectangle that holds all frozen cells; of bounded domains, all of them. */
typedef struct reference {
    snow_grid *grid;
    int64_t q, r; /* its first cell */
    int64_t width, height;
    unsigned char *frozen;
    unsigned char *next;
    int64_t *date; /* NULL: not recorded; −1: not frozen */
    snow_hexagon hexagon; /* of the frozen cells */
    bool changed; /* in the last step, or since */
} reference;

static size_t cells_of(const reference *cells)
{
    return (size_t)(cells->width * cells->height);
}

static size_t place(const reference *cells, int64_t q, int64_t r)
{
    return (size_t)((r - cells->r) * cells->width + (q - cells->q));
}

static bool holds(const reference *cells, int64_t q, int64_t r)
{
    return q >= cells->q && q < cells->q + cells->width && r >= cells->r && r < cells->r + cells->height;
}

static int64_t wrap(int64_t x, int64_t first, int64_t count)
{
    int64_t rest = (x - first) % count;
    return first + (rest < 0 ? rest + count : rest);
}

static unsigned frozen_at(const reference *cells, int64_t q, int64_t r)
{
    if (holds(cells, q, r))
        return cells->frozen[place(cells, q, r)];
    if (packard_of(cells->grid)->params.domain != SNOW_PACKARD_TORUS)
        return 0;
    return cells->frozen[place(cells, wrap(q, cells->q, cells->width), wrap(r, cells->r, cells->height))];
}

static void release(reference *cells)
{
    snow_heap *heap = &cells->grid->heap;
    snow_heap_put(heap, cells->frozen);
    snow_heap_put(heap, cells->next);
    snow_heap_put(heap, cells->date);
}

static void destroy(snow_grid *grid, void *engine)
{
    release(engine);
    snow_heap_put(&grid->heap, engine);
}

static snow_status allocate(reference *cells)
{
    if ((uint64_t)cells->width * (uint64_t)cells->height > SIZE_MAX / sizeof *cells->date)
        return SNOW_ERROR_TOO_LARGE;
    snow_heap *heap = &cells->grid->heap;
    size_t count = cells_of(cells);
    cells->frozen = snow_heap_get(heap, count, 1);
    cells->next = cells->frozen != NULL ? snow_heap_get(heap, count, 1) : NULL;
    bool dated = packard_of(cells->grid)->params.record_freeze_steps != 0;
    if (dated && cells->next != NULL)
        cells->date = snow_heap_get_raw(heap, count, sizeof *cells->date);
    if (cells->next == NULL || (dated && cells->date == NULL)) {
        snow_status refusal = heap->refusal;
        release(cells);
        return refusal;
    }
    for (size_t i = 0; dated && i < count; i++)
        cells->date[i] = -1;
    return SNOW_OK;
}

/* Of the plane, a few cells to begin with. */
static snow_rect first_rectangle(const snow_grid *grid)
{
    return packard_is_plane(packard_of(grid)) ? (snow_rect){-8, -8, 16, 16} : grid->domain.bounds;
}

static snow_status create(snow_grid *grid, const packard_fold *fold, void **result)
{
    (void)fold; /* every cell is kept all the same */
    reference *cells = snow_heap_get(&grid->heap, 1, sizeof *cells);
    if (cells == NULL)
        return grid->heap.refusal;
    snow_rect rect = first_rectangle(grid);
    *cells = (reference){.grid = grid, .q = rect.q, .r = rect.r, .width = rect.width, .height = rect.height,
                         .hexagon = snow_hexagon_empty(), .changed = true};
    snow_status status = allocate(cells);
    if (status != SNOW_OK) {
        snow_heap_put(&grid->heap, cells);
        return status;
    }
    *result = cells;
    return SNOW_OK;
}

/* Copies what it holds into the larger rectangle of another. */
static void move(const reference *from, reference *to)
{
    for (int64_t r = from->r; r < from->r + from->height; r++) {
        size_t width = (size_t)from->width;
        memcpy(to->frozen + place(to, from->q, r), from->frozen + place(from, from->q, r), width);
        if (to->date != NULL)
            memcpy(to->date + place(to, from->q, r), from->date + place(from, from->q, r), width * sizeof *from->date);
    }
}

/* Makes room for a cell of the plane, with a margin that keeps growing rare. */
static snow_status reach(reference *cells, int64_t q, int64_t r)
{
    if (holds(cells, q, r))
        return SNOW_OK;
    int64_t margin = cells->width / 2;
    int64_t end_q = cells->q + cells->width;
    int64_t end_r = cells->r + cells->height;
    reference larger = *cells;
    larger.q = q < cells->q ? q - margin : cells->q;
    larger.r = r < cells->r ? r - margin : cells->r;
    larger.width = (q >= end_q ? q + margin : end_q) - larger.q;
    larger.height = (r >= end_r ? r + margin : end_r) - larger.r;
    if (larger.width > INT32_MAX || larger.height > INT32_MAX)
        return SNOW_ERROR_TOO_LARGE;
    larger.frozen = larger.next = NULL;
    larger.date = NULL;
    snow_status status = allocate(&larger);
    if (status != SNOW_OK)
        return status;
    move(cells, &larger);
    release(cells);
    *cells = larger;
    return SNOW_OK;
}

static snow_status put_dated(void *engine, int64_t q, int64_t r, int64_t step)
{
    reference *cells = engine;
    snow_status status = reach(cells, q, r);
    if (status != SNOW_OK)
        return status;
    size_t i = place(cells, q, r);
    if (cells->date != NULL && !cells->frozen[i])
        cells->date[i] = step;
    cells->frozen[i] = 1;
    snow_hexagon_hold(&cells->hexagon, q, r);
    cells->changed = true;
    return SNOW_OK;
}

static snow_status put(void *engine, const packard_region *region, const uint64_t *words)
{
    reference *cells = engine;
    size_t stride = packard_words((uint64_t)region->width);
    for (int64_t y = 0; y < region->height; y++) {
        for (int64_t x = 0; x < region->width; x++) {
            uint64_t word = words[(size_t)y * stride + (size_t)x / PACKARD_WORD];
            if ((word >> (x % PACKARD_WORD) & 1) == 0)
                continue;
            snow_status status = put_dated(cells, region->q + x, region->r + y, cells->grid->census.steps);
            if (status != SNOW_OK)
                return status;
        }
    }
    return SNOW_OK;
}

static void copy(const void *engine, const packard_region *region, uint64_t *words)
{
    const reference *cells = engine;
    size_t stride = packard_words((uint64_t)region->width);
    memset(words, 0, (size_t)region->height * stride * sizeof *words);
    for (int64_t y = 0; y < region->height; y++)
        for (int64_t x = 0; x < region->width; x++)
            if (holds(cells, region->q + x, region->r + y) &&
                cells->frozen[place(cells, region->q + x, region->r + y)])
                words[(size_t)y * stride + (size_t)x / PACKARD_WORD] |= UINT64_C(1) << (x % PACKARD_WORD);
}

static int64_t date(const void *engine, int64_t q, int64_t r)
{
    const reference *cells = engine;
    return holds(cells, q, r) ? cells->date[place(cells, q, r)] : -1;
}

static bool freezes(const reference *cells, int64_t step, int64_t q, int64_t r)
{
    const packard *model = packard_of(cells->grid);
    if (!packard_has_cell(cells->grid, q, r))
        return false;
    unsigned neighbours = frozen_at(cells, q + 1, r) + frozen_at(cells, q - 1, r) + frozen_at(cells, q, r + 1) +
                          frozen_at(cells, q, r - 1) + frozen_at(cells, q + 1, r - 1) + frozen_at(cells, q - 1, r + 1);
    unsigned demands = snow_packard_zones_at(model, step, q, r);
    if (demands & PACKARD_RESTRICTED)
        return false;
    if ((demands & PACKARD_PREFERRED) && neighbours > 0)
        return true;
    return (model->params.rule >> neighbours & 1) != 0;
}

/* A cell of the plane next to the edge of the rectangle may freeze in the next step. */
static snow_status make_room(reference *cells)
{
    const snow_hexagon *hexagon = &cells->hexagon;
    if (!packard_is_plane(packard_of(cells->grid)) || snow_hexagon_is_empty(hexagon))
        return SNOW_OK;
    snow_status status = reach(cells, hexagon->least_q - 1, hexagon->least_r - 1);
    if (status == SNOW_OK)
        status = reach(cells, hexagon->greatest_q + 1, hexagon->greatest_r + 1);
    return status;
}

static snow_status take_step(reference *cells, int64_t step)
{
    snow_status status = make_room(cells);
    if (status != SNOW_OK)
        return status;
    cells->changed = false;
    for (int64_t r = cells->r; r < cells->r + cells->height; r++) {
        for (int64_t q = cells->q; q < cells->q + cells->width; q++) {
            size_t i = place(cells, q, r);
            bool fresh = !cells->frozen[i] && freezes(cells, step, q, r);
            cells->next[i] = cells->frozen[i] || fresh;
            if (!fresh)
                continue;
            cells->changed = true;
            snow_hexagon_hold(&cells->hexagon, q, r);
            if (cells->date != NULL)
                cells->date[i] = step;
        }
    }
    unsigned char *old = cells->frozen;
    cells->frozen = cells->next;
    cells->next = old;
    return SNOW_OK;
}

static snow_status advance(void *engine, int64_t steps, int64_t *taken)
{
    const int64_t enough_cells = 1 << 22;
    reference *cells = engine;
    int64_t before = cells->grid->census.steps;
    int64_t visited = 0;
    snow_status status = SNOW_OK;
    for (*taken = 0; *taken < steps && visited < enough_cells && status == SNOW_OK; *taken += status == SNOW_OK) {
        status = take_step(cells, before + *taken + 1);
        visited += cells->width * cells->height;
    }
    return status;
}

static snow_status change_zones(void *engine)
{
    reference *cells = engine;
    cells->changed = true; /* they are looked up in each step */
    return SNOW_OK;
}

static snow_status count(void *engine, snow_census *census)
{
    const reference *cells = engine;
    int64_t steps = census->steps;
    bool still = census->still;
    bool rim = census->rim;
    snow_census_start(census);
    census->steps = steps;
    census->still = still;
    census->rim = rim;
    for (int64_t r = cells->r; r < cells->r + cells->height; r++)
        for (int64_t q = cells->q; q < cells->q + cells->width; q++)
            if (cells->frozen[place(cells, q, r)])
                snow_census_add(census, (int32_t)q, (int32_t)r);
    return SNOW_OK;
}

static bool is_still(void *engine)
{
    return !((reference *)engine)->changed;
}

const packard_engine snow_packard_reference = {
    .name = SNOW_PACKARD_ENGINE_REFERENCE,
    .create = create,
    .destroy = destroy,
    .put = put,
    .put_dated = put_dated,
    .copy = copy,
    .date = date,
    .advance = advance,
    .change_zones = change_zones,
    .count = count,
    .is_still = is_still,
};
