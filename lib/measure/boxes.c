#include "base/floating.h"
#include "measure/frozen.h"

#include <snowgrowth/measure.h>

static bool any_frozen(const snow_grid *grid, int64_t q, int64_t end, int64_t r)
{
    double frozen[SNOW_FROZEN_SLICE];
    for (; q < end; q += SNOW_FROZEN_SLICE) {
        size_t cells = snow_frozen_slice(grid, q, end, r, frozen);
        for (size_t i = 0; i < cells; i++)
            if (frozen[i] != 0)
                return true;
    }
    return false;
}

static int64_t lesser(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static int64_t greater(int64_t a, int64_t b)
{
    return a > b ? a : b;
}

/* The first cell of the box that a cell is in. */
static int64_t box_of(int64_t x, int64_t side)
{
    int64_t rest = x % side;
    return x - (rest < 0 ? rest + side : rest);
}

/* Whether the box that begins at (q, r) holds a frozen cell; cells outside the rectangle are not looked at. */
static bool is_full(const snow_grid *grid, const snow_rect *rect, int64_t side, int64_t q, int64_t r)
{
    int64_t first = greater(q, rect->q);
    int64_t end = lesser(q + side, (int64_t)rect->q + rect->width);
    int64_t end_row = lesser(r + side, (int64_t)rect->r + rect->height);
    for (int64_t row = greater(r, rect->r); row < end_row; row++)
        if (any_frozen(grid, first, end, row))
            return true;
    return false;
}

snow_status snow_box_count(const snow_grid *grid, int32_t side, uint64_t *boxes)
{
    if (grid == NULL || boxes == NULL)
        return SNOW_ERROR_NULL;
    if (side < 1)
        return SNOW_ERROR_RANGE;
    snow_rect rect;
    snow_status status = snow_frozen_rect(grid, &rect);
    if (status != SNOW_OK)
        return status;
    uint64_t count = 0;
    for (int64_t r = box_of(rect.r, side); r < (int64_t)rect.r + rect.height; r += side)
        for (int64_t q = box_of(rect.q, side); q < (int64_t)rect.q + rect.width; q += side)
            count += is_full(grid, &rect, side, q, r);
    *boxes = count;
    return SNOW_OK;
}

/* Cells at the ends of a rhombus that the third pair of sides cuts off. */
static double triangle(double side)
{
    return side > 0 ? side * (side + 1) / 2 : 0;
}

static SNOW_APART double density_of(const snow_census *census)
{
    const snow_hexagon *hexagon = &census->hexagon;
    if (snow_hexagon_is_empty(hexagon))
        return 0;
    double width = (double)hexagon->greatest_q - (double)hexagon->least_q + 1;
    double height = (double)hexagon->greatest_r - (double)hexagon->least_r + 1;
    double low = (double)hexagon->least_s - (double)hexagon->least_q - (double)hexagon->least_r;
    double high = (double)hexagon->greatest_q + (double)hexagon->greatest_r - (double)hexagon->greatest_s;
    double frozen = (double)census->frozen_high * 0x1p64 + (double)census->frozen;
    return frozen / (width * height - triangle(low) - triangle(high));
}

snow_status snow_density(const snow_grid *grid, double *density)
{
    if (grid == NULL || density == NULL)
        return SNOW_ERROR_NULL;
    snow_status status = grid->operations->can_read(grid, SNOW_FIELD_INSIDE);
    if (status != SNOW_OK)
        return status;
    snow_floating floating;
    snow_floating_enter(&floating);
    snow_census census = snow_census_of(grid);
    *density = density_of(&census);
    snow_floating_leave(&floating);
    return SNOW_OK;
}
