#include "base/domain.h"

#include "base/hexagon.h"

/* Greatest q in [low, high] with q² + q·r + r² < square; the squares grow with q there. */
static int64_t last_inside(int64_t low, int64_t high, int64_t r, int64_t square)
{
    while (low < high) {
        int64_t middle = low + (high - low + 1) / 2;
        if (snow_hexagon_square(middle, r) < square)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

/* The row of a disc: the cells nearest to the row's middle, q = −r/2, are
   ⌊−r/2⌋ and ⌈−r/2⌉, and the row is symmetric about it: q ↔ −r − q. */
static snow_run_of_cells disc_row(int64_t radius, int64_t r)
{
    int64_t square = radius * radius;
    int64_t middle = r >= 0 ? -(r / 2) : (-r + 1) / 2;
    if (snow_hexagon_square(middle, r) >= square)
        return (snow_run_of_cells){0, 0, 0};
    int64_t last = last_inside(middle, middle + 2 * radius, r, square);
    return (snow_run_of_cells){(int32_t)(-r - last), (int32_t)(last + 1), 0};
}

static snow_run_of_cells hexagon_row(int64_t radius, int64_t r)
{
    int64_t reach = radius - 1;
    int64_t first = r < 0 ? -reach - r : -reach;
    int64_t last = r < 0 ? reach : reach - r;
    return (snow_run_of_cells){(int32_t)first, (int32_t)(last + 1), 0};
}

/* Odd rows, counted from the top, stand half a cell to the right. */
static snow_run_of_cells rectangle_row(int32_t width, int32_t height, int32_t row)
{
    int32_t middle_row = height / 2;
    int32_t first = -(width / 2) + middle_row / 2 - row / 2;
    return (snow_run_of_cells){first, first + width, 0};
}

snow_status snow_domain_start(snow_domain *domain, snow_heap *heap, int32_t top, int32_t rows)
{
    *domain = (snow_domain){.top = top, .rows = rows};
    domain->run = snow_heap_get(heap, (size_t)rows, sizeof *domain->run);
    return domain->run != NULL ? SNOW_OK : heap->refusal;
}

void snow_domain_number_cells(snow_domain *domain)
{
    int32_t first = INT32_MAX;
    int32_t end = INT32_MIN;
    for (int32_t row = 0; row < domain->rows; row++) {
        snow_run_of_cells *run = &domain->run[row];
        run->number = (size_t)domain->cells;
        domain->cells += (uint64_t)(run->end - run->first);
        first = run->first < first ? run->first : first;
        end = run->end > end ? run->end : end;
    }
    domain->bounds = (snow_rect){first, domain->top, end - first, domain->rows};
}

/* Rows beyond this one hold no cell of the disc: (3/4)·r² < radius². */
static int32_t disc_last_row(int32_t radius)
{
    int32_t r = (int32_t)((int64_t)radius * 7 / 6);
    while (disc_row(radius, r).first == disc_row(radius, r).end)
        r--;
    return r;
}

snow_status snow_domain_disc(snow_domain *domain, snow_heap *heap, int32_t radius)
{
    int32_t last = disc_last_row(radius);
    snow_status status = snow_domain_start(domain, heap, -last, 2 * last + 1);
    if (status != SNOW_OK)
        return status;
    for (int32_t row = 0; row < domain->rows; row++)
        domain->run[row] = disc_row(radius, domain->top + row);
    snow_domain_number_cells(domain);
    return SNOW_OK;
}

snow_status snow_domain_hexagon(snow_domain *domain, snow_heap *heap, int32_t radius)
{
    snow_status status = snow_domain_start(domain, heap, 1 - radius, 2 * radius - 1);
    if (status != SNOW_OK)
        return status;
    for (int32_t row = 0; row < domain->rows; row++)
        domain->run[row] = hexagon_row(radius, domain->top + row);
    snow_domain_number_cells(domain);
    return SNOW_OK;
}

snow_status snow_domain_rectangle(snow_domain *domain, snow_heap *heap, int32_t width, int32_t height)
{
    snow_status status = snow_domain_start(domain, heap, -(height / 2), height);
    if (status != SNOW_OK)
        return status;
    for (int32_t row = 0; row < domain->rows; row++)
        domain->run[row] = rectangle_row(width, height, row);
    snow_domain_number_cells(domain);
    return SNOW_OK;
}

static void stretch(snow_run_of_cells *run, int32_t first, int32_t end)
{
    bool empty = run->first == run->end;
    run->first = empty || first < run->first ? first : run->first;
    run->end = empty || end > run->end ? end : run->end;
}

snow_status snow_domain_hull(snow_domain *hull, snow_heap *heap, const snow_domain *interior)
{
    snow_status status = snow_domain_start(hull, heap, interior->top - 1, interior->rows + 2);
    if (status != SNOW_OK)
        return status;
    for (int32_t row = 0; row < interior->rows; row++) {
        const snow_run_of_cells *run = &interior->run[row];
        stretch(&hull->run[row], run->first, run->end + 1);
        stretch(&hull->run[row + 1], run->first - 1, run->end + 1);
        stretch(&hull->run[row + 2], run->first - 1, run->end);
    }
    snow_domain_number_cells(hull);
    return SNOW_OK;
}

bool snow_domain_reaches(const snow_hexagon *hexagon)
{
    const int64_t limit = INT64_C(1) << 30;
    return snow_hexagon_is_empty(hexagon) || (hexagon->least_q > -limit && hexagon->greatest_q < limit &&
                                              hexagon->least_r > -limit && hexagon->greatest_r < limit);
}

snow_rect snow_domain_rect(const snow_hexagon *hexagon)
{
    if (snow_hexagon_is_empty(hexagon))
        return (snow_rect){0, 0, 0, 0};
    return (snow_rect){(int32_t)hexagon->least_q, (int32_t)hexagon->least_r,
                       (int32_t)(hexagon->greatest_q - hexagon->least_q + 1),
                       (int32_t)(hexagon->greatest_r - hexagon->least_r + 1)};
}

/* Cells at the upper or lower end of a hexagon that a side cuts off. */
static uint64_t triangle(int64_t side)
{
    uint64_t n = side > 0 ? (uint64_t)side : 0;
    return n % 2 == 0 ? n / 2 * (n + 1) : (n + 1) / 2 * n;
}

void snow_domain_fill(snow_domain *domain, const snow_hexagon *hexagon)
{
    *domain = (snow_domain){.hexagon = *hexagon, .too_large = !snow_domain_reaches(hexagon)};
    if (domain->too_large)
        return;
    domain->bounds = snow_domain_rect(hexagon);
    domain->top = domain->bounds.r;
    domain->rows = domain->bounds.height;
    domain->cells = (uint64_t)domain->bounds.width * (uint64_t)domain->bounds.height -
                    triangle(hexagon->least_s - hexagon->least_q - hexagon->least_r) -
                    triangle(hexagon->greatest_q + hexagon->greatest_r - hexagon->greatest_s);
}

void snow_domain_follow(snow_domain *domain, const snow_hexagon *crystal)
{
    snow_hexagon hexagon = snow_hexagon_is_empty(crystal) ? (snow_hexagon){0, 0, 0, 0, 0, 0} : *crystal;
    hexagon.least_q--, hexagon.least_r--, hexagon.least_s--;
    hexagon.greatest_q++, hexagon.greatest_r++, hexagon.greatest_s++;
    snow_domain_fill(domain, &hexagon);
}

void snow_domain_end(snow_domain *domain, snow_heap *heap)
{
    snow_heap_put(heap, domain->run);
    domain->run = NULL;
}

uint64_t snow_domain_disc_cells(int32_t radius)
{
    uint64_t cells = 0;
    for (int32_t r = disc_last_row(radius); r >= 0; r--) {
        snow_run_of_cells run = disc_row(radius, r);
        cells += (uint64_t)(run.end - run.first) * (r == 0 ? 1 : 2);
    }
    return cells;
}

uint64_t snow_domain_hexagon_cells(int32_t radius)
{
    uint64_t n = (uint64_t)radius;
    return 3 * n * (n - 1) + 1;
}
