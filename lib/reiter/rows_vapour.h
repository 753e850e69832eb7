/* A cell's vapour in the arrays of the ROWS engine, of either precision. Between
   put and settle a value is kept as it was given; where cells have 32 bits in
   each of the two arrays, the halves of a double lie in both. */
#ifndef SNOW_REITER_ROWS_VAPOUR_H
#define SNOW_REITER_ROWS_VAPOUR_H

#include "reiter/rows.h"

typedef union split_double {
    double value;
    int32_t half[2];
} split_double;

/* In the array of one step. */
static inline double rows_value_in(const rows *cells, const void *field, size_t i)
{
    return cells->single ? ((const int32_t *)field)[i] * cells->quantum : ((const double *)field)[i];
}

/* The same, and leaves 0. */
static inline double rows_take_from(void *field, size_t i, bool single, double quantum)
{
    double *doubles = field;
    int32_t *singles = field;
    double value = single ? singles[i] * quantum : doubles[i];
    if (single)
        singles[i] = 0;
    else
        doubles[i] = 0;
    return value;
}

/* In the present step. */
static inline double rows_vapour(const rows *cells, size_t i)
{
    if (!cells->single || !cells->loose)
        return rows_value_in(cells, cells->vapour[cells->now], i);
    split_double split = {.half = {((const int32_t *)cells->vapour[0])[i], ((const int32_t *)cells->vapour[1])[i]}};
    return split.value;
}

/* While cells are loose. */
static inline void rows_put_vapour(const rows *cells, size_t i, double value)
{
    if (!cells->single) {
        ((double *)cells->vapour[cells->now])[i] = value;
        return;
    }
    split_double split = {.value = value};
    ((int32_t *)cells->vapour[0])[i] = split.half[0];
    ((int32_t *)cells->vapour[1])[i] = split.half[1];
}

/* A multiple of the quantum, for both steps; what was loose is no longer. */
static inline void rows_settle_vapour(const rows *cells, size_t i, double value)
{
    for (int which = 0; which < 2; which++) {
        if (cells->single)
            ((int32_t *)cells->vapour[which])[i] = (int32_t)(value / cells->quantum);
        else
            ((double *)cells->vapour[which])[i] = value;
    }
}

#endif
