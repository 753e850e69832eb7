#include "aggregate/cells.h"

#include <string.h>

/* A side that has to move moves by at least half the extent, so that moving is rare. */
static void stretch(int32_t *low, int32_t *extent, int32_t wanted_low, int32_t wanted_high)
{
    if (*extent == 0) {
        *low = wanted_low;
        *extent = wanted_high - wanted_low + 1;
        return;
    }
    int32_t spare = *extent / 2;
    if (wanted_low < *low) {
        int32_t more = *low - wanted_low > spare ? *low - wanted_low : spare;
        *low -= more;
        *extent += more;
    }
    int32_t high = *low + *extent - 1;
    if (wanted_high > high)
        *extent += wanted_high - high > spare ? wanted_high - high : spare;
}

static void copy_rows(snow_cells *larger, const snow_cells *cells)
{
    for (int32_t z = 0; z < cells->extent.z; z++) {
        for (int32_t y = 0; y < cells->extent.y; y++) {
            snow_site start = {cells->low.x, cells->low.y + y, cells->low.z + z};
            memcpy(snow_cells_at(larger, start), snow_cells_at(cells, start), (size_t)cells->extent.x);
        }
    }
}

snow_status snow_cells_cover(snow_cells *cells, snow_heap *heap, snow_site low, snow_site high)
{
    if (cells->mark != NULL && snow_cells_has(cells, low) && snow_cells_has(cells, high))
        return SNOW_OK;
    snow_cells larger = *cells;
    stretch(&larger.low.x, &larger.extent.x, low.x, high.x);
    stretch(&larger.low.y, &larger.extent.y, low.y, high.y);
    stretch(&larger.low.z, &larger.extent.z, low.z, high.z);
    uint64_t layer = (uint64_t)larger.extent.x * (uint64_t)larger.extent.y;
    if (layer > SIZE_MAX / 4 / (uint64_t)larger.extent.z)
        return SNOW_ERROR_TOO_LARGE;
    larger.mark = snow_heap_get(heap, (size_t)layer, (size_t)larger.extent.z);
    if (larger.mark == NULL)
        return heap->refusal;
    if (cells->mark != NULL)
        copy_rows(&larger, cells);
    snow_heap_put(heap, cells->mark);
    *cells = larger;
    return SNOW_OK;
}

void snow_cells_end(snow_cells *cells, snow_heap *heap)
{
    snow_heap_put(heap, cells->mark);
    *cells = (snow_cells){0};
}
