/* The view: its defaults, its checks, and the frame that fits a grid. */
#include "render/view.h"

#include "base/floating.h"
#include "base/model.h"
#include "base/structs.h"

#include <snowgrowth/aggregate.h>

#include <math.h>
#include <stdbool.h>

#define LEAST_SCALE (1.0 / 1024.0)
#define GREATEST_SCALE 1024.0

enum {
    GREATEST_SIDE = 65535,
    GREATEST_SAMPLES = 8,
    CHUNK = 256 /* Cells looked at in one query. */
};

static const snow_view default_view = {
    .struct_size = sizeof(snow_view),
    .width = 512,
    .height = 512,
    .scale = 1.0,
    .palette = SNOW_PALETTE_PAPER,
    .pixel = SNOW_PIXEL_RGB,
    .samples = 2,
};

void snow_view_init(snow_view *view, size_t struct_size)
{
    if (view)
        snow_struct_init(view, struct_size, &default_view, sizeof default_view);
}

snow_status snow_view_check_lattice(const snow_grid *grid)
{
    snow_aggregate_params params;
    snow_aggregate_params_init(&params, sizeof params);
    bool aggregate = snow_aggregate_params_of(grid, &params) == SNOW_OK;
    return aggregate && params.lattice != SNOW_AGGREGATE_HEXAGONAL ? SNOW_ERROR_UNSUPPORTED : SNOW_OK;
}

static snow_status copy_in(const snow_view *caller, snow_view *view)
{
    *view = default_view;
    return snow_struct_take(view, sizeof *view, caller);
}

static int within(int32_t number, int32_t least, int32_t greatest)
{
    return number >= least && number <= greatest;
}

static SNOW_APART snow_status check(const snow_view *view)
{
    if (!within((int32_t)view->palette, SNOW_PALETTE_PAPER, SNOW_PALETTE_PHASE) ||
        !within((int32_t)view->pixel, SNOW_PIXEL_GREY, SNOW_PIXEL_RGBA))
        return SNOW_ERROR_ENUM;
    if (!isfinite(view->scale) || !isfinite(view->centre_x) || !isfinite(view->centre_y))
        return SNOW_ERROR_NOT_FINITE;
    if (!within(view->width, 1, GREATEST_SIDE) || !within(view->height, 1, GREATEST_SIDE) ||
        !within(view->samples, 1, GREATEST_SAMPLES) || !within(view->transparent, 0, 1) ||
        view->scale < LEAST_SCALE || view->scale > GREATEST_SCALE)
        return SNOW_ERROR_RANGE;
    return SNOW_OK;
}

snow_status snow_view_read(const snow_view *caller, snow_view *view)
{
    snow_floating floating;
    snow_status status = copy_in(caller, view);

    if (status != SNOW_OK)
        return status;
    snow_floating_enter(&floating);
    status = check(view);
    snow_floating_leave(&floating);
    return status;
}

/*
 * Counts the cells of row r from column q on that are not inside, up to the
 * first that is, and at most `most`; forward (direction 1) or backward (−1).
 */
static int32_t count_outside(const snow_grid *grid, int32_t q, int32_t r, int32_t direction, int32_t most)
{
    double inside[CHUNK];
    int32_t passed = 0;

    while (passed < most) {
        int32_t length = most - passed < CHUNK ? most - passed : CHUNK;
        int32_t begin = q + direction * passed;
        int32_t first = direction > 0 ? begin : begin - length + 1;

        grid->operations->read(grid, SNOW_FIELD_INSIDE, first, r, (size_t)length, inside);
        for (int32_t i = 0; i < length; i++, passed++)
            if (inside[direction > 0 ? i : length - 1 - i] != 0.0)
                return passed;
    }
    return most;
}

/*
 * The least and the greatest x of the cells of the interior. The bounds do not
 * tell: they are a parallelogram. In each row only those cells are looked at
 * that would lie farther out than what was found before.
 */
static void find_ends(const snow_grid *grid, const snow_rect *bounds, double *left, double *right)
{
    *left = HUGE_VAL;
    *right = -HUGE_VAL;
    for (int32_t r = bounds->r; r < bounds->r + bounds->height; r++) {
        int32_t last = bounds->q + bounds->width - 1;
        double farther_left = ceil(*left - 0.5 * r) - bounds->q;
        double farther_right = last - floor(*right - 0.5 * r);
        int32_t most_left = farther_left < bounds->width ? (int32_t)farther_left : bounds->width;
        int32_t most_right = farther_right < bounds->width ? (int32_t)farther_right : bounds->width;
        int32_t outside = count_outside(grid, bounds->q, r, 1, most_left);

        if (outside < most_left)
            *left = bounds->q + outside + 0.5 * r;
        outside = count_outside(grid, last, r, -1, most_right);
        if (outside < most_right)
            *right = last - outside + 0.5 * r;
    }
}

/* Pixels that a length of so many pixels needs; the rounding errors of the scale need none. */
static double whole_pixels(double length)
{
    return fmax(1.0, ceil(length - 1e-6));
}

static snow_status fit(const snow_grid *grid, int32_t side, snow_view *view)
{
    snow_rect bounds;
    double left, right, width, height;
    snow_status status = snow_domain_bounds(grid, &bounds);

    if (status == SNOW_OK)
        status = grid->operations->can_read(grid, SNOW_FIELD_INSIDE);
    if (status != SNOW_OK)
        return status;

    /* The hexagon round a cell reaches 1/2 to the sides and 1/√3, two thirds of a row distance, up and down. */
    height = (bounds.height - 1 + 4.0 / 3.0) * SNOW_ROW_DISTANCE;
    if (height * LEAST_SCALE > GREATEST_SIDE) /* too many rows to be looked through */
        return SNOW_ERROR_RANGE;
    find_ends(grid, &bounds, &left, &right);
    width = right - left + 1.0;
    view->scale = side == 0 ? 1.0 : side / fmax(width, height);
    width = whole_pixels(width * view->scale);
    height = whole_pixels(height * view->scale);
    if (!(view->scale >= LEAST_SCALE && view->scale <= GREATEST_SCALE && fmax(width, height) <= GREATEST_SIDE))
        return SNOW_ERROR_RANGE;
    view->width = (int32_t)width;
    view->height = (int32_t)height;
    view->centre_x = 0.5 * (left + right);
    view->centre_y = (bounds.r + 0.5 * (bounds.height - 1)) * SNOW_ROW_DISTANCE;
    return SNOW_OK;
}

snow_status snow_view_fit(const snow_grid *grid, int32_t side, snow_view *view)
{
    snow_floating floating;
    snow_view fitted;
    snow_status status;

    if (!grid || !view)
        return SNOW_ERROR_NULL;
    status = copy_in(view, &fitted);
    if (status != SNOW_OK)
        return status;
    if (side < 0 || side > GREATEST_SIDE)
        return SNOW_ERROR_RANGE;
    status = snow_view_check_lattice(grid);
    if (status != SNOW_OK)
        return status;

    snow_floating_enter(&floating);
    status = fit(grid, side, &fitted);
    snow_floating_leave(&floating);
    if (status == SNOW_OK)
        snow_struct_write(view, &fitted, sizeof fitted);
    return status;
}
