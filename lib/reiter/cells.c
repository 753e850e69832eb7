/* Whole-grid passes that every engine shares, through its get and put. */
#include "base/hexagon.h"
#include "reiter/model.h"

/* The quantum stays far above the subnormal numbers. */
static const double least_bound = 0x1p-64;

enum { REACH = 2, REPORT_FRACTION = 35 };

static bool is_near_rim(const snow_grid *grid, int32_t q, int32_t r)
{
    const snow_reiter_params *params = &reiter_of(grid)->params;
    int64_t reach = (int64_t)params->radius - REACH;
    int32_t row = r - grid->domain.top;
    const snow_run_of_cells *run = &grid->domain.run[row];
    switch (params->domain) {
    case SNOW_REITER_DISC: return reach <= 0 || snow_hexagon_square(q, r) >= reach * reach;
    case SNOW_REITER_HEXAGON: return snow_hexagon_distance(q, r) >= reach;
    case SNOW_REITER_RECTANGLE: break;
    }
    if (params->rim == SNOW_REITER_RIM_ROW)
        return row + 1 <= params->height / REPORT_FRACTION;
    return row < REACH || row >= params->height - REACH || q < run->first + REACH || q >= run->end - REACH;
}

/* Ice advances by one cell in a step. In a rectangle the rows' ends move by half a cell from row to row. */
static bool may_leave_middle(const snow_grid *grid, int64_t steps)
{
    const snow_hexagon *ice = &grid->census.hexagon;
    const snow_domain *domain = &grid->domain;
    int64_t margin = 2 * steps + REACH + 1;
    snow_run_of_cells upper = snow_domain_row(domain, ice->least_r);
    snow_run_of_cells lower = snow_domain_row(domain, ice->greatest_r);
    return ice->least_r - domain->top < margin || domain->top + domain->rows - ice->greatest_r < margin ||
           ice->least_q - upper.first < margin || lower.end - ice->greatest_q < margin;
}

bool snow_reiter_may_reach_rim(const snow_grid *grid, int64_t steps)
{
    const snow_reiter_params *params = &reiter_of(grid)->params;
    const snow_census *census = &grid->census;
    double reach = (double)params->radius - REACH;
    double tip = snow_census_tip(census);
    if (census->rim || census->frozen == 0)
        return false;
    switch (params->domain) {
    case SNOW_REITER_DISC: return tip + (double)steps >= reach;
    case SNOW_REITER_HEXAGON: return 1.1548 * tip + (double)steps >= reach; /* 2/√3 */
    case SNOW_REITER_RECTANGLE: break;
    }
    if (params->rim == SNOW_REITER_RIM_ROW)
        return census->hexagon.least_r - grid->domain.top - steps < params->height / REPORT_FRACTION;
    return may_leave_middle(grid, steps);
}

static void count(snow_grid *grid, int32_t q, int32_t r)
{
    snow_census_add(&grid->census, q, r);
    grid->census.rim = grid->census.rim || is_near_rim(grid, q, r);
}

/* A cell counts with its images. */
static void count_images(snow_grid *grid, int32_t q, int32_t r)
{
    snow_cell image[SNOW_HEXAGON_SYMMETRIES];
    size_t images = snow_group_images(reiter_of(grid)->group, q, r, image);
    for (size_t i = 0; i < images; i++)
        count(grid, image[i].q, image[i].r);
}

void snow_reiter_freeze(snow_grid *grid, int32_t q, int32_t r)
{
    reiter *model = reiter_of(grid);
    count_images(grid, q, r);
    if (model->freeze_step != NULL)
        model->freeze_step[model->engine->number(grid, q, r)] = reiter_freeze_stamp(grid->census.steps);
}

void snow_reiter_recount(snow_grid *grid)
{
    int64_t steps = grid->census.steps;
    snow_census_start(&grid->census);
    grid->census.steps = steps;
    for (snow_walk walk = reiter_walk_part(grid); snow_walk_next(&walk);)
        if (reiter_of(grid)->engine->get(grid, walk.cell.q, walk.cell.r).frozen)
            count_images(grid, walk.cell.q, walk.cell.r);
}

static bool is_frozen(const snow_grid *grid, int32_t q, int32_t r)
{
    return snow_domain_has(&grid->domain, q, r) && reiter_of(grid)->engine->get(grid, q, r).frozen;
}

/* Asked while cells are being put, when the engine does not know it yet. */
static bool is_receptive(const snow_grid *grid, int32_t q, int32_t r)
{
    return snow_domain_has(&grid->domain, q, r) &&
           (is_frozen(grid, q, r) || is_frozen(grid, q + 1, r) || is_frozen(grid, q - 1, r) ||
            is_frozen(grid, q, r + 1) || is_frozen(grid, q, r - 1) || is_frozen(grid, q + 1, r - 1) ||
            is_frozen(grid, q - 1, r + 1));
}

/* How far the vapour of the cells that are not receptive goes, fixed ones too. */
typedef struct vapour_range {
    double least; /* at most 0 */
    double greatest;
} vapour_range;

static void widen(vapour_range *range, const snow_grid *grid, snow_cell cell)
{
    double vapour = reiter_of(grid)->engine->get(grid, cell.q, cell.r).value;
    if ((vapour < range->least || vapour > range->greatest) && !is_receptive(grid, cell.q, cell.r)) {
        range->least = fmin(range->least, vapour);
        range->greatest = fmax(range->greatest, vapour);
    }
}

static vapour_range find_range(const snow_grid *grid)
{
    vapour_range range = {0, 0};
    for (snow_walk walk = reiter_walk_part(grid); snow_walk_next(&walk);)
        widen(&range, grid, walk.cell);
    for (snow_walk walk = reiter_walk_fixed(grid); snow_walk_next(&walk);)
        widen(&range, grid, walk.cell);
    return range;
}

void snow_reiter_choose_bound(snow_grid *grid)
{
    reiter *model = reiter_of(grid);
    vapour_range range = find_range(grid);
    double greatest = fmax(range.greatest, -range.least);
    double bound = least_bound;
    while (bound < greatest)
        bound *= 2;
    if (model->params.diffusion > SNOW_REITER_STABLE_DIFFUSION)
        bound = fmin(bound, 1) * 1024;
    else if (reiter_overshoots(model))
        bound *= 4;
    else if (range.least < 0)
        bound *= 2; /* of a diffusion above 2; sums of both signs are twice as large */
    model->bound = bound;
}

bool snow_reiter_receptive_are_sound(const snow_grid *grid)
{
    for (snow_walk walk = reiter_walk_part(grid); snow_walk_next(&walk);) {
        int32_t q = walk.cell.q;
        int32_t r = walk.cell.r;
        if (reiter_of(grid)->engine->get(grid, q, r).receptive != is_receptive(grid, q, r))
            return false;
    }
    return true;
}

/* value + low + addition · additions, to one rounding, or exactly in two
   doubles where the engine keeps a low part. */
static void merge(reiter_cell *cell, double addition, bool keeps_low)
{
    double gained = addition * cell->additions;
    double sum = cell->value + gained;
    if (keeps_low) {
        double gained_low = fma(addition, cell->additions, -gained);
        double part = sum - cell->value;
        double sum_low = (cell->value - (sum - part)) + (gained - part);
        double low = cell->low + (gained_low + sum_low);
        cell->value = sum + low;
        cell->low = low - (cell->value - sum);
    } else {
        cell->value = sum;
    }
    cell->additions = 0;
}

void snow_reiter_merge_additions(snow_grid *grid)
{
    const reiter *model = reiter_of(grid);
    bool keeps_low = model->engine == &snow_reiter_quad;
    for (snow_walk walk = reiter_walk_part(grid); snow_walk_next(&walk);) {
        int32_t q = walk.cell.q;
        int32_t r = walk.cell.r;
        reiter_cell cell = model->engine->get(grid, q, r);
        if (cell.additions == 0)
            continue;
        merge(&cell, reiter_addition(model, model->engine->number(grid, q, r)), keeps_low);
        model->engine->put(grid, q, r, &cell);
    }
}
