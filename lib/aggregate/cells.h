/* What plain walkers look at: a box of sites, a byte of marks each, that grows.
   Beyond it there are no marks. */
#ifndef SNOW_AGGREGATE_CELLS_H
#define SNOW_AGGREGATE_CELLS_H

#include "base/heap.h"

#include <snowgrowth/aggregate.h>

#include <stdbool.h>
#include <stdint.h>

enum {
    SNOW_CELL_FILLED = 1,  /* a particle */
    SNOW_CELL_NEAR = 2,    /* a walker here touches */
    SNOW_CELL_BARRED = 4,  /* an obstacle */
    SNOW_CELL_ELECTRODE = 8 /* what particles stick to without being one: floor, cathode, wall */
};

typedef struct snow_cells {
    uint8_t *mark;
    snow_site low;
    snow_site extent;
} snow_cells;

/* Holds from now on at least low ... high, both inclusive. */
snow_status snow_cells_cover(snow_cells *cells, snow_heap *heap, snow_site low, snow_site high);
void snow_cells_end(snow_cells *cells, snow_heap *heap);

static inline bool snow_cells_has(const snow_cells *cells, snow_site site)
{
    return (uint32_t)site.x - (uint32_t)cells->low.x < (uint32_t)cells->extent.x &&
           (uint32_t)site.y - (uint32_t)cells->low.y < (uint32_t)cells->extent.y &&
           (uint32_t)site.z - (uint32_t)cells->low.z < (uint32_t)cells->extent.z;
}

/* A site that the box has. */
static inline uint8_t *snow_cells_at(const snow_cells *cells, snow_site site)
{
    size_t x = (size_t)(site.x - cells->low.x);
    size_t y = (size_t)(site.y - cells->low.y);
    size_t z = (size_t)(site.z - cells->low.z);
    return &cells->mark[(z * (size_t)cells->extent.y + y) * (size_t)cells->extent.x + x];
}

static inline uint8_t snow_cells_get(const snow_cells *cells, snow_site site)
{
    return snow_cells_has(cells, site) ? *snow_cells_at(cells, site) : 0;
}

/* Sites beyond the box are passed over. */
static inline void snow_cells_mark(snow_cells *cells, snow_site site, uint8_t mark)
{
    if (snow_cells_has(cells, site))
        *snow_cells_at(cells, site) |= mark;
}

/* Marks a cell of the plane and the eight round it. */
static inline void snow_cells_mark_round(snow_cells *cells, snow_site site)
{
    for (int i = 0; i < 9; i++)
        snow_cells_mark(cells, (snow_site){site.x + i % 3 - 1, site.y + i / 3 - 1, 0}, SNOW_CELL_NEAR);
}

#endif
