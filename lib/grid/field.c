#include "base/floating.h"
#include "base/model.h"

static bool is_field(snow_field field)
{
    return field >= SNOW_FIELD_VALUE && field <= SNOW_FIELD_BACKGROUND;
}

static bool is_sound(const snow_rect *rect)
{
    return rect->width >= 0 && rect->height >= 0 && (int64_t)rect->q + rect->width <= (int64_t)INT32_MAX + 1 &&
           (int64_t)rect->r + rect->height <= (int64_t)INT32_MAX + 1;
}

/* The number of cells, of which an array in memory must be able to hold the values. */
static snow_status check_rectangle(const snow_rect *rect, size_t *count)
{
    if (!is_sound(rect))
        return SNOW_ERROR_RECTANGLE;
    uint64_t cells = (uint64_t)rect->width * (uint64_t)rect->height;
    *count = (size_t)cells;
    return cells <= SIZE_MAX / sizeof(double) ? SNOW_OK : SNOW_ERROR_TOO_LARGE;
}

static snow_status can_read(const snow_grid *grid, snow_field field)
{
    return is_field(field) ? grid->operations->can_read(grid, field) : SNOW_ERROR_ENUM;
}

static void read_rows(const snow_grid *grid, snow_field field, const snow_rect *rect, double *values)
{
    size_t width = (size_t)rect->width;
    snow_floating floating;
    snow_floating_enter(&floating);
    for (int32_t row = 0; row < rect->height && width > 0; row++)
        grid->operations->read(grid, field, rect->q, (int64_t)rect->r + row, width, values + (size_t)row * width);
    snow_floating_leave(&floating);
}

snow_status snow_cell_value(const snow_grid *grid, snow_field field, int32_t q, int32_t r, double *value)
{
    if (grid == NULL || value == NULL)
        return SNOW_ERROR_NULL;
    snow_status status = can_read(grid, field);
    if (status == SNOW_OK)
        read_rows(grid, field, &(snow_rect){q, r, 1, 1}, value);
    return status;
}

snow_status snow_field_copy(const snow_grid *grid, snow_field field, const snow_rect *rect, double *values,
                            size_t capacity, size_t *count)
{
    if (grid == NULL || (values == NULL && count == NULL))
        return SNOW_ERROR_NULL;
    snow_status status = can_read(grid, field);
    if (status != SNOW_OK)
        return status;
    if (rect == NULL && grid->domain.too_large)
        return SNOW_ERROR_TOO_LARGE;
    rect = rect != NULL ? rect : &grid->domain.bounds;
    size_t cells;
    status = check_rectangle(rect, &cells);
    if (status != SNOW_OK)
        return status;
    if (count != NULL)
        *count = cells;
    if (values == NULL)
        return SNOW_OK;
    if (capacity < cells)
        return SNOW_ERROR_BUFFER;
    read_rows(grid, field, rect, values);
    return SNOW_OK;
}

snow_status snow_field_set(snow_grid *grid, snow_field field, const snow_rect *rect, const double *values,
                           size_t count)
{
    if (grid == NULL || values == NULL)
        return SNOW_ERROR_NULL;
    if (!is_field(field))
        return SNOW_ERROR_ENUM;
    if (grid->busy)
        return SNOW_ERROR_BUSY;
    if (rect == NULL && grid->domain.too_large)
        return SNOW_ERROR_TOO_LARGE;
    rect = rect != NULL ? rect : &grid->domain.bounds;
    size_t cells;
    snow_status status = check_rectangle(rect, &cells);
    if (status != SNOW_OK)
        return status;
    if (count != cells)
        return SNOW_ERROR_BUFFER;
    snow_floating floating;
    snow_floating_enter(&floating);
    status = grid->operations->set(grid, field, rect, values);
    snow_floating_leave(&floating);
    return status;
}
