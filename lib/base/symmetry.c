#include "base/symmetry.h"

#include "base/hexagon.h"

/* The fundamental part is where this is greatest among the images of a cell:
   a direction inside the sector q > r > 0, where no mirror passes. */
enum { WEIGHT_Q = 4, WEIGHT_R = 3 };

static int64_t height_of(int64_t q, int64_t r)
{
    return WEIGHT_Q * q + WEIGHT_R * r;
}

int snow_group_order(snow_group group)
{
    int order = 0;
    for (int symmetry = 0; symmetry < SNOW_HEXAGON_SYMMETRIES; symmetry++)
        order += snow_group_has(group, symmetry);
    return order;
}

/* Which symmetry takes a generic cell first by b, then by a. */
static int compose(int a, int b)
{
    int64_t q;
    int64_t r;
    snow_hexagon_image(b, 3, 1, &q, &r);
    snow_hexagon_image(a, q, r, &q, &r);
    for (int symmetry = 0; symmetry < SNOW_HEXAGON_SYMMETRIES; symmetry++) {
        int64_t image_q;
        int64_t image_r;
        snow_hexagon_image(symmetry, 3, 1, &image_q, &image_r);
        if (image_q == q && image_r == r)
            return symmetry;
    }
    return 0;
}

bool snow_group_is_closed(snow_group group)
{
    if (!snow_group_has(group, 0) || group > SNOW_GROUP_FULL)
        return false;
    for (int a = 0; a < SNOW_HEXAGON_SYMMETRIES; a++)
        for (int b = 0; b < SNOW_HEXAGON_SYMMETRIES; b++)
            if (snow_group_has(group, a) && snow_group_has(group, b) && !snow_group_has(group, compose(a, b)))
                return false;
    return true;
}

bool snow_group_reflects(snow_group group)
{
    return group >> 6 != 0;
}

/* A symmetry that takes rows to rows: r → ±r. Others are only those of discs
   and hexagons, whose rows say so: row 0 is the longest way through. */
static bool has_symmetry(const snow_domain *domain, int symmetry)
{
    for (int32_t row = 0; row < domain->rows; row++) {
        const snow_run_of_cells *run = &domain->run[row];
        int64_t r = domain->top + row;
        int64_t q;
        int64_t image_r;
        snow_hexagon_image(symmetry, run->first, r, &q, &image_r);
        bool first_inside = snow_domain_has(domain, q, image_r);
        snow_hexagon_image(symmetry, run->end - 1, r, &q, &image_r);
        if (!first_inside || !snow_domain_has(domain, q, image_r))
            return false;
    }
    return true;
}

/* A convex domain has a symmetry if the ends of its rows stay inside. */
snow_group snow_group_of_domain(const snow_domain *domain)
{
    snow_group group = 0;
    for (int symmetry = 0; symmetry < SNOW_HEXAGON_SYMMETRIES; symmetry++)
        if (has_symmetry(domain, symmetry))
            group |= (snow_group)1 << symmetry;
    return group;
}

snow_cell snow_group_representative(snow_group group, int32_t q, int32_t r)
{
    if (group == SNOW_GROUP_TRIVIAL)
        return (snow_cell){q, r};
    int64_t best_q = q;
    int64_t best_r = r;
    for (int symmetry = 1; symmetry < SNOW_HEXAGON_SYMMETRIES; symmetry++) {
        if (!snow_group_has(group, symmetry))
            continue;
        int64_t image_q;
        int64_t image_r;
        snow_hexagon_image(symmetry, q, r, &image_q, &image_r);
        int64_t gain = height_of(image_q, image_r) - height_of(best_q, best_r);
        if (gain > 0 || (gain == 0 && image_q > best_q)) {
            best_q = image_q;
            best_r = image_r;
        }
    }
    return (snow_cell){(int32_t)best_q, (int32_t)best_r};
}

size_t snow_group_images(snow_group group, int32_t q, int32_t r, snow_cell image[12])
{
    size_t images = 0;
    for (int symmetry = 0; symmetry < SNOW_HEXAGON_SYMMETRIES; symmetry++) {
        if (!snow_group_has(group, symmetry))
            continue;
        int64_t image_q;
        int64_t image_r;
        snow_hexagon_image(symmetry, q, r, &image_q, &image_r);
        size_t known = 0;
        while (known < images && (image[known].q != image_q || image[known].r != image_r))
            known++;
        if (known == images)
            image[images++] = (snow_cell){(int32_t)image_q, (int32_t)image_r};
    }
    return images;
}

static bool is_fundamental(snow_group group, int64_t q, int64_t r)
{
    snow_cell cell = snow_group_representative(group, (int32_t)q, (int32_t)r);
    return cell.q == q && cell.r == r;
}

static int64_t floor_divide(int64_t a, int64_t b)
{
    int64_t quotient = a / b;
    return quotient * b > a ? quotient - 1 : quotient;
}

/* Narrows [*first, *end) of row r to where height(P) >= height(image of P),
   which is linear: a·q + b·r >= 0. No unit vector is higher than (1, 0), so that a >= 0. */
static void cut(int symmetry, int64_t r, int64_t *first, int64_t *end)
{
    int64_t q_q, q_r, r_q, r_r;
    snow_hexagon_image(symmetry, 1, 0, &q_q, &q_r);
    snow_hexagon_image(symmetry, 0, 1, &r_q, &r_r);
    int64_t a = WEIGHT_Q - height_of(q_q, q_r);
    int64_t b = (WEIGHT_R - height_of(r_q, r_r)) * r;
    if (a > 0) {
        int64_t least = -floor_divide(b, a);
        *first = least > *first ? least : *first;
    } else if (b < 0) {
        *end = *first;
    }
}

static snow_run_of_cells cut_row(snow_group group, const snow_run_of_cells *run, int64_t r)
{
    int64_t first = run->first;
    int64_t end = run->end;
    for (int symmetry = 1; symmetry < SNOW_HEXAGON_SYMMETRIES; symmetry++)
        if (snow_group_has(group, symmetry))
            cut(symmetry, r, &first, &end);
    /* Of images of equal height, on the borders, one is kept. */
    while (first < end && !is_fundamental(group, first, r))
        first++;
    while (first < end && !is_fundamental(group, end - 1, r))
        end--;
    if (first >= end)
        return (snow_run_of_cells){0, 0, 0};
    return (snow_run_of_cells){(int32_t)first, (int32_t)end, 0};
}

snow_status snow_group_fundamental(snow_group group, const snow_domain *domain, snow_heap *heap, snow_domain *part)
{
    int32_t first_row = domain->rows;
    int32_t last_row = -1;
    for (int32_t row = 0; row < domain->rows; row++) {
        snow_run_of_cells run = cut_row(group, &domain->run[row], domain->top + row);
        if (run.first == run.end)
            continue;
        first_row = row < first_row ? row : first_row;
        last_row = row;
    }
    int32_t rows = last_row - first_row + 1;
    snow_status status = snow_domain_start(part, heap, domain->top + first_row, rows);
    if (status != SNOW_OK)
        return status;
    for (int32_t row = 0; row < rows; row++)
        part->run[row] = cut_row(group, &domain->run[first_row + row], part->top + row);
    snow_domain_number_cells(part);
    return SNOW_OK;
}
