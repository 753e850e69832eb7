#include "base/floating.h"
#include "base/model.h"

#include <math.h>

/* A. Neumaier's compensated sum (ZAMM 54, 1974, 39–51). */
typedef struct long_sum {
    double sum;
    double rest;
} long_sum;

static void add(long_sum *total, double value)
{
    double sum = total->sum + value;
    if (fabs(total->sum) >= fabs(value))
        total->rest += (total->sum - sum) + value;
    else
        total->rest += (value - sum) + total->sum;
    total->sum = sum;
}

static void add_row(const snow_grid *grid, int32_t r, long_sum *vapour, long_sum *ice)
{
    snow_run_of_cells run = snow_domain_row(&grid->domain, r);
    for (int32_t q = run.first; q < run.end; q++) {
        double value;
        double frozen;
        grid->operations->read(grid, SNOW_FIELD_VALUE, q, r, 1, &value);
        grid->operations->read(grid, SNOW_FIELD_FROZEN, q, r, 1, &frozen);
        add(frozen != 0 ? ice : vapour, value);
    }
}

snow_status snow_mass(const snow_grid *grid, double *vapour, double *ice)
{
    if (grid == NULL || (vapour == NULL && ice == NULL))
        return SNOW_ERROR_NULL;
    if (grid->domain.too_large)
        return SNOW_ERROR_TOO_LARGE;
    snow_status status = grid->operations->can_read(grid, SNOW_FIELD_VALUE);
    if (status != SNOW_OK)
        return status;
    snow_floating floating;
    snow_floating_enter(&floating);
    long_sum vapour_sum = {0, 0};
    long_sum ice_sum = {0, 0};
    for (int32_t row = 0; row < grid->domain.rows; row++)
        add_row(grid, grid->domain.top + row, &vapour_sum, &ice_sum);
    if (vapour != NULL)
        *vapour = vapour_sum.sum + vapour_sum.rest;
    if (ice != NULL)
        *ice = ice_sum.sum + ice_sum.rest;
    snow_floating_leave(&floating);
    return SNOW_OK;
}
