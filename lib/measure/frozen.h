/* The frozen cells of a grid, row by row. */
#ifndef SNOW_MEASURE_FROZEN_H
#define SNOW_MEASURE_FROZEN_H

#include "base/model.h"

enum { SNOW_FROZEN_SLICE = 256 };

/* Whether the cells can be read and gone through, with the rectangle that holds them. */
static inline snow_status snow_frozen_rect(const snow_grid *grid, snow_rect *rect)
{
    snow_status status = grid->operations->can_read(grid, SNOW_FIELD_FROZEN);
    if (status != SNOW_OK)
        return status;
    snow_census census = snow_census_of(grid);
    if (!snow_domain_reaches(&census.hexagon))
        return SNOW_ERROR_TOO_LARGE;
    *rect = snow_domain_rect(&census.hexagon);
    return SNOW_OK;
}

/* Up to SNOW_FROZEN_SLICE cells of a row, not 0 where frozen; returns how many lie before `end`. */
static inline size_t snow_frozen_slice(const snow_grid *grid, int64_t q, int64_t end, int64_t r, double *frozen)
{
    size_t count = end - q < SNOW_FROZEN_SLICE ? (size_t)(end - q) : SNOW_FROZEN_SLICE;
    grid->operations->read(grid, SNOW_FIELD_FROZEN, q, r, count, frozen);
    return count;
}

#endif
