#include "base/floating.h"
#include "base/hexagon.h"
#include "measure/frozen.h"

#include <snowgrowth/measure.h>

#include <math.h>

/* The number of radii that are too small for a cell at this squared distance. */
static size_t first_holding(const double *radii, size_t count, double square)
{
    size_t low = 0;
    size_t high = count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (radii[middle] * radii[middle] < square)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static double square_of(const snow_grid *grid, int64_t q, int64_t r)
{
    return grid->squares ? (double)(q * q + r * r) : (double)snow_hexagon_square(q, r);
}

static void add_row(const snow_grid *grid, const snow_rect *rect, int64_t r, const double *radii, size_t count,
                    uint64_t *masses)
{
    double frozen[SNOW_FROZEN_SLICE];
    int64_t end = (int64_t)rect->q + rect->width;
    for (int64_t q = rect->q; q < end; q += SNOW_FROZEN_SLICE) {
        size_t cells = snow_frozen_slice(grid, q, end, r, frozen);
        for (size_t i = 0; i < cells; i++) {
            if (frozen[i] == 0)
                continue;
            size_t ring = first_holding(radii, count, square_of(grid, q + (int64_t)i, r));
            if (ring < count)
                masses[ring]++;
        }
    }
}

static snow_status count_masses(const snow_grid *grid, const double *radii, size_t count, uint64_t *masses)
{
    snow_rect rect;
    snow_status status = snow_frozen_rect(grid, &rect);
    if (status != SNOW_OK)
        return status;
    for (size_t i = 0; i < count; i++)
        masses[i] = 0;
    for (snow_rect part = {0, 0, 0, 0}; snow_frozen_next(grid, &part);)
        for (int32_t y = 0; y < part.height; y++)
            add_row(grid, &part, (int64_t)part.r + y, radii, count, masses);
    for (size_t i = 1; i < count; i++)
        masses[i] += masses[i - 1];
    return SNOW_OK;
}

static snow_status check(const double *radii, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(radii[i]))
            return SNOW_ERROR_NOT_FINITE;
        if (radii[i] < 0 || (i > 0 && radii[i] < radii[i - 1]))
            return SNOW_ERROR_RANGE;
    }
    return SNOW_OK;
}

snow_status snow_mass_radius(const snow_grid *grid, const double *radii, size_t count, uint64_t *masses)
{
    if (grid == NULL || radii == NULL || masses == NULL)
        return SNOW_ERROR_NULL;
    snow_floating floating;
    snow_floating_enter(&floating);
    snow_status status = check(radii, count);
    if (status == SNOW_OK)
        status = count_masses(grid, radii, count, masses);
    snow_floating_leave(&floating);
    return status;
}

enum { MOST_RADII = 64 };

/* Of those that are at least 4, the least first; returns how many. */
static size_t choose_radii(double tip, double radii[MOST_RADII])
{
    const double root_of_half = 0.70710678118654752;
    size_t count = 0;
    for (double radius = tip / 2; radius >= 4 && count < MOST_RADII; radius *= root_of_half)
        count++;
    double radius = tip / 2;
    for (size_t i = count; i > 0; i--, radius *= root_of_half)
        radii[i - 1] = radius;
    return count;
}

static double slope(const double *radii, const uint64_t *masses, size_t count)
{
    double x = 0, y = 0, xx = 0, xy = 0;
    for (size_t i = 0; i < count; i++) {
        double u = log(radii[i]);
        double v = log((double)masses[i]);
        x += u;
        y += v;
        xx += u * u;
        xy += u * v;
    }
    double n = (double)count;
    return (n * xy - x * y) / (n * xx - x * x);
}

static SNOW_APART snow_status find_dimension(const snow_grid *grid, double *dimension)
{
    double radii[MOST_RADII] = {0};
    uint64_t masses[MOST_RADII];
    snow_census census = snow_census_of(grid);
    double tip = snow_census_tip(&census);
    double origin;
    snow_status status = grid->operations->can_read(grid, SNOW_FIELD_FROZEN);
    if (status != SNOW_OK)
        return status;
    grid->operations->read(grid, SNOW_FIELD_FROZEN, 0, 0, 1, &origin);
    if (tip < 32 || origin == 0)
        return SNOW_ERROR_RANGE;
    size_t count = choose_radii(tip, radii);
    status = count_masses(grid, radii, count, masses);
    if (status == SNOW_OK)
        *dimension = slope(radii, masses, count);
    return status;
}

snow_status snow_dimension(const snow_grid *grid, double *dimension)
{
    if (grid == NULL || dimension == NULL)
        return SNOW_ERROR_NULL;
    snow_floating floating;
    snow_floating_enter(&floating);
    snow_status status = find_dimension(grid, dimension);
    snow_floating_leave(&floating);
    return status;
}
