/* The plain reading of the paper, slow and obviously right, for one kind of
   real number. Included by reference_double.c and reference_quad.c, which
   define before it:

     real                      the kind of number
     REAL_KEEPS_LOW            whether it has more digits than a double
     real_make(high, low)      the number high + low
     real_high(x), real_low(x)
     real_add(x, y), real_subtract(x, y), real_multiply(x, y)
     real_flow(model, x)       (α/12)·x as the model keeps it
     real_vapour(model, x)     a vapour as the model keeps it
     REFERENCE_ENGINE          the name of the engine's table

   It shares nothing with the fast engines: whole rectangles of cells, one
   after the other, the neighbours in the order of grid.h. */
#include "reiter/model.h"

typedef struct reference_cell {
    real value;       /* vapour; where receptive, what it had and collected */
    real next;        /* its value after the step that is being taken */
    uint32_t since;   /* where receptive: the step since which it gains, modulo 2^32 */
    bool inside;
    bool frozen;
    bool receptive;
} reference_cell;

static reference_cell *cell_at(const snow_grid *grid, int64_t q, int64_t r)
{
    const reiter *model = reiter_of(grid);
    const snow_rect *box = &model->hull.bounds;
    reference_cell *cells = model->cells;
    return &cells[(size_t)(r - box->r) * (size_t)box->width + (size_t)(q - box->q)];
}

static const snow_domain *reference_part(const snow_grid *grid)
{
    return &grid->domain;
}

static size_t reference_numbers(const snow_grid *grid)
{
    const snow_rect *box = &reiter_of(grid)->hull.bounds;
    return (size_t)box->width * (size_t)box->height;
}

static size_t reference_number(const snow_grid *grid, int32_t q, int32_t r)
{
    const reference_cell *cells = reiter_of(grid)->cells;
    return (size_t)(cell_at(grid, q, r) - cells);
}

static reference_cell *neighbour_of(const snow_grid *grid, int32_t q, int32_t r, int which)
{
    static const int step_q[6] = {1, -1, 0, 0, 1, -1};
    static const int step_r[6] = {0, 0, 1, -1, -1, 1};
    return cell_at(grid, q + step_q[which], r + step_r[which]);
}

static snow_status reference_create(snow_grid *grid)
{
    reiter *model = reiter_of(grid);
    const snow_rect *box = &model->hull.bounds;
    size_t width = (size_t)box->width;
    size_t height = (size_t)box->height;
    if (width > SIZE_MAX / height)
        return SNOW_ERROR_TOO_LARGE;
    model->cells = snow_heap_get(&grid->heap, width * height, sizeof(reference_cell));
    if (model->cells == NULL)
        return grid->heap.refusal;
    const snow_domain *domain = &grid->domain;
    for (int32_t row = 0; row < domain->rows; row++)
        for (int32_t q = domain->run[row].first; q < domain->run[row].end; q++)
            cell_at(grid, q, domain->top + row)->inside = true;
    return SNOW_OK;
}

static void reference_destroy(snow_grid *grid)
{
    snow_heap_put(&grid->heap, reiter_of(grid)->cells);
}

/* Calls a function for each interior cell. */
typedef void (*interior_visitor)(snow_grid *grid, int32_t q, int32_t r);

static void visit_interior(snow_grid *grid, interior_visitor visitor)
{
    const snow_domain *domain = &grid->domain;
    for (int32_t row = 0; row < domain->rows; row++)
        for (int32_t q = domain->run[row].first; q < domain->run[row].end; q++)
            visitor(grid, q, domain->top + row);
}

static real vapour_of(const reference_cell *cell)
{
    return cell->receptive ? real_make(0, 0) : cell->value;
}

/* (α/12)·(Σ v(N) − 6·v(P)) */
static real flow_into(const snow_grid *grid, int32_t q, int32_t r)
{
    const reiter *model = reiter_of(grid);
    real sum = real_make(0, 0);
    for (int which = 0; which < 6; which++)
        sum = real_add(sum, vapour_of(neighbour_of(grid, q, r, which)));
    real centre = real_multiply(real_make(6, 0), vapour_of(cell_at(grid, q, r)));
    return real_flow(model, real_subtract(sum, centre));
}

/* u: value and additions. */
static real total_of(const snow_grid *grid, int32_t q, int32_t r, real value, uint32_t additions)
{
    const reiter *model = reiter_of(grid);
    double addition = reiter_addition(model, reference_number(grid, q, r));
    return real_add(value, real_multiply(real_make(addition, 0), real_make(additions, 0)));
}

static bool is_ice(const reiter *model, real total)
{
    return real_high(real_subtract(total, real_make(reiter_threshold(model), 0))) >= 0;
}

static bool any_beyond_bound(const snow_grid *grid)
{
    const reiter *model = reiter_of(grid);
    const snow_domain *domain = &grid->domain;
    for (int32_t row = 0; row < domain->rows; row++) {
        for (int32_t q = domain->run[row].first; q < domain->run[row].end; q++) {
            int32_t r = domain->top + row;
            real vapour = real_add(vapour_of(cell_at(grid, q, r)), flow_into(grid, q, r));
            if (!(fabs(real_high(vapour)) <= model->bound))
                return true;
        }
    }
    return false;
}

static void find_next(snow_grid *grid, int32_t q, int32_t r)
{
    reference_cell *cell = cell_at(grid, q, r);
    cell->next = real_add(cell->value, flow_into(grid, q, r));
}

static void take_next(snow_grid *grid, int32_t q, int32_t r)
{
    reference_cell *cell = cell_at(grid, q, r);
    cell->value = cell->next;
    if (cell->frozen)
        return;
    uint32_t additions = cell->receptive ? (uint32_t)grid->census.steps - cell->since : 0;
    if (is_ice(reiter_of(grid), total_of(grid, q, r, cell->value, additions))) {
        cell->frozen = true;
        snow_reiter_freeze(grid, q, r);
    }
}

static bool is_by_ice(const snow_grid *grid, int32_t q, int32_t r)
{
    bool by_ice = cell_at(grid, q, r)->frozen;
    for (int which = 0; which < 6; which++)
        by_ice = by_ice || neighbour_of(grid, q, r, which)->frozen;
    return by_ice;
}

static void find_receptive(snow_grid *grid, int32_t q, int32_t r)
{
    reference_cell *cell = cell_at(grid, q, r);
    bool receptive = is_by_ice(grid, q, r);
    if (receptive && !cell->receptive)
        cell->since = (uint32_t)grid->census.steps;
    cell->receptive = receptive;
}

/* Whether a cell changes in a way that may end in ice. */
static bool moves(const snow_grid *grid, int32_t q, int32_t r)
{
    const reference_cell *cell = cell_at(grid, q, r);
    real flow = flow_into(grid, q, r);
    if (cell->frozen)
        return false;
    if (!cell->receptive)
        return real_high(flow) != 0;
    uint32_t additions = (uint32_t)grid->census.steps + 1 - cell->since;
    double total = real_high(total_of(grid, q, r, real_add(cell->value, flow), additions));
    return reiter_addition(reiter_of(grid), reference_number(grid, q, r)) > 0 ||
           real_high(flow) * REITER_STILL_STEPS >= reiter_threshold(reiter_of(grid)) - total;
}

static bool is_still(const snow_grid *grid)
{
    const snow_domain *domain = &grid->domain;
    for (int32_t row = 0; row < domain->rows; row++)
        for (int32_t q = domain->run[row].first; q < domain->run[row].end; q++)
            if (moves(grid, q, domain->top + row))
                return false;
    return true;
}

static snow_status reference_step(snow_grid *grid)
{
    snow_census *census = &grid->census;
    if (reiter_overshoots(reiter_of(grid)) && any_beyond_bound(grid))
        return SNOW_ERROR_UNSTABLE;
    uint64_t frozen = census->frozen;
    bool still = snow_census_looks(census->steps + 1) && is_still(grid);
    visit_interior(grid, find_next);
    census->steps++;
    visit_interior(grid, take_next);
    visit_interior(grid, find_receptive);
    if (snow_census_looks(census->steps))
        census->still = still && census->frozen == frozen;
    return SNOW_OK;
}

static reiter_cell reference_get(const snow_grid *grid, int32_t q, int32_t r)
{
    const reference_cell *cell = cell_at(grid, q, r);
    return (reiter_cell){
        .value = real_high(cell->value),
        .low = real_low(cell->value),
        .additions = cell->receptive ? (uint32_t)grid->census.steps - cell->since : 0,
        .frozen = cell->frozen,
        .receptive = cell->receptive,
    };
}

static void reference_put(snow_grid *grid, int32_t q, int32_t r, const reiter_cell *given)
{
    reference_cell *cell = cell_at(grid, q, r);
    cell->value = real_make(given->value, given->low);
    cell->since = (uint32_t)grid->census.steps - given->additions;
    cell->frozen = given->frozen;
    cell->receptive = given->receptive || given->frozen;
}

static void settle_vapour(snow_grid *grid)
{
    const reiter *model = reiter_of(grid);
    const snow_domain *hull = &model->hull;
    for (int32_t row = 0; row < hull->rows; row++) {
        for (int32_t q = hull->run[row].first; q < hull->run[row].end; q++) {
            reference_cell *cell = cell_at(grid, q, hull->top + row);
            if (!cell->inside || !cell->receptive)
                cell->value = real_vapour(model, cell->value);
        }
    }
}

static void reference_settle(snow_grid *grid)
{
    visit_interior(grid, find_receptive);
    settle_vapour(grid);
}

const reiter_engine REFERENCE_ENGINE = {
    .folds = false,
    .create = reference_create,
    .part = reference_part,
    .numbers = reference_numbers,
    .number = reference_number,
    .step = reference_step,
    .get = reference_get,
    .put = reference_put,
    .settle = reference_settle,
    .destroy = reference_destroy,
};
