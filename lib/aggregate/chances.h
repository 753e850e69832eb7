/* What both ways to growth probabilities share. */
#ifndef SNOW_AGGREGATE_CHANCES_H
#define SNOW_AGGREGATE_CHANCES_H

#include "aggregate/model.h"

static inline snow_status snow_chances_check(const snow_grid *grid, const snow_aggregate_chance *chances,
                                             const size_t *count)
{
    if (grid == NULL || (chances == NULL && count == NULL))
        return SNOW_ERROR_NULL;
    return grid->operations == &snow_aggregate_operations ? SNOW_OK : SNOW_ERROR_UNSUPPORTED;
}

/* Hands out as many as there are, or none. */
static inline snow_status snow_chances_copy(const snow_aggregate_chance *found, size_t there,
                                            snow_aggregate_chance *chances, size_t capacity, size_t *count)
{
    if (count != NULL)
        *count = there;
    if (chances == NULL)
        return SNOW_OK;
    if (capacity < there)
        return SNOW_ERROR_BUFFER;
    for (size_t i = 0; i < there; i++)
        chances[i] = found[i];
    return SNOW_OK;
}

#endif
