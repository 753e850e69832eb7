#include "base/floating.h"
#include "base/hexagon.h"
#include "base/model.h"

#include <math.h>

static double value_of(const snow_grid *grid, int32_t q, int32_t r)
{
    double value;
    grid->operations->read(grid, SNOW_FIELD_VALUE, q, r, 1, &value);
    return value;
}

static double defect_of(const snow_grid *grid, int32_t q, int32_t r)
{
    double defect = 0;
    double value = value_of(grid, q, r);
    for (int symmetry = 1; symmetry < SNOW_HEXAGON_SYMMETRIES; symmetry++) {
        int64_t image_q;
        int64_t image_r;
        snow_hexagon_image(symmetry, q, r, &image_q, &image_r);
        if (snow_domain_has(&grid->domain, image_q, image_r))
            defect = fmax(defect, fabs(value - value_of(grid, (int32_t)image_q, (int32_t)image_r)));
    }
    return defect;
}

snow_status snow_symmetry_defect(const snow_grid *grid, double *defect)
{
    if (grid == NULL || defect == NULL)
        return SNOW_ERROR_NULL;
    if (grid->domain.too_large)
        return SNOW_ERROR_TOO_LARGE;
    snow_status status = grid->squares ? SNOW_ERROR_UNSUPPORTED
                                       : grid->operations->can_read(grid, SNOW_FIELD_VALUE);
    if (status != SNOW_OK)
        return status;
    snow_floating floating;
    snow_floating_enter(&floating);
    double greatest = 0;
    for (int32_t row = 0; row < grid->domain.rows; row++) {
        snow_run_of_cells run = snow_domain_row(&grid->domain, grid->domain.top + row);
        for (int32_t q = run.first; q < run.end; q++)
            greatest = fmax(greatest, defect_of(grid, q, grid->domain.top + row));
    }
    *defect = greatest;
    snow_floating_leave(&floating);
    return SNOW_OK;
}
