#include "reiter/rows.h"

#include <string.h>

static const reiter_kernel *choose_kernel(snow_isa isa)
{
    switch (isa) {
#ifdef SNOW_HAVE_X86_KERNELS
    case SNOW_ISA_AVX2: return &snow_reiter_kernel_avx2;
    case SNOW_ISA_AVX512: return &snow_reiter_kernel_avx512;
#else
    case SNOW_ISA_AVX2:
    case SNOW_ISA_AVX512:
#endif
    case SNOW_ISA_AUTO:
    case SNOW_ISA_BASELINE: break;
    }
    return &snow_reiter_kernel_baseline;
}

/* Blocks of whole rows with about the same number of cells. */
static void cut_blocks(const snow_grid *grid, rows *cells)
{
    const snow_domain *domain = &grid->domain;
    const snow_domain *hull = &reiter_of(grid)->hull;
    int32_t row = 0;
    for (size_t i = 0; i < cells->blocks; i++) {
        row_block *block = &cells->block[i];
        uint64_t target = (uint64_t)domain->cells * (i + 1) / cells->blocks;
        block->first_row = row;
        int32_t rows_to_leave = (int32_t)(cells->blocks - 1 - i);
        do
            row++;
        while (row < domain->rows - rows_to_leave && domain->run[row].number < target);
        block->end_row = row;
        /* Row n of the interior is row n + 1 of the hull. */
        block->first = hull->run[block->first_row + 1].number;
        block->end = hull->run[block->end_row + 1].number;
    }
}

static void find_offsets(const snow_domain *hull, rows *cells)
{
    for (int32_t row = 0; row < hull->rows; row++)
        cells->offset[row] = (int64_t)hull->run[row].number - hull->run[row].first;
}

static void destroy(snow_grid *grid)
{
    rows *cells = rows_of(grid);
    snow_heap *heap = &grid->heap;
    snow_heap_put(heap, cells->vapour[0]);
    snow_heap_put(heap, cells->vapour[1]);
    snow_heap_put(heap, cells->collected);
    snow_heap_put(heap, cells->since);
    snow_heap_put(heap, cells->state);
    snow_heap_put(heap, cells->listed);
    snow_heap_put(heap, cells->block);
    snow_heap_put(heap, cells->offset);
    snow_heap_put(heap, cells);
}

static void mark_interior(const snow_grid *grid)
{
    rows *cells = rows_of(grid);
    const snow_domain *domain = &grid->domain;
    memset(cells->state, CELL_FIXED, reiter_of(grid)->hull.cells);
    for (int32_t row = 0; row < domain->rows; row++) {
        const snow_run_of_cells *run = &domain->run[row];
        memset(cells->state + rows_number(grid, run->first, domain->top + row), CELL_VAPOUR,
               (size_t)(run->end - run->first));
    }
}

static snow_status create(snow_grid *grid)
{
    reiter *model = reiter_of(grid);
    snow_heap *heap = &grid->heap;
    rows *cells = snow_heap_get(heap, 1, sizeof *cells);
    if (cells == NULL)
        return heap->refusal;
    model->cells = cells;
    size_t count = model->hull.cells;
    size_t threads = (size_t)grid->options.threads;
    size_t interior_rows = (size_t)grid->domain.rows;
    cells->kernel = choose_kernel(grid->options.isa);
    cells->blocks = threads < interior_rows ? threads : interior_rows;
    bool complete = (cells->vapour[0] = snow_heap_get(heap, count, sizeof(double))) != NULL &&
                    (cells->vapour[1] = snow_heap_get(heap, count, sizeof(double))) != NULL &&
                    (cells->collected = snow_heap_get_raw(heap, count, sizeof(double))) != NULL &&
                    (cells->since = snow_heap_get_raw(heap, count, sizeof *cells->since)) != NULL &&
                    (cells->state = snow_heap_get_raw(heap, count, sizeof *cells->state)) != NULL &&
                    (cells->listed = snow_heap_get_raw(heap, count, sizeof *cells->listed)) != NULL &&
                    (cells->block = snow_heap_get(heap, cells->blocks, sizeof *cells->block)) != NULL &&
                    (cells->offset = snow_heap_get(heap, (size_t)model->hull.rows, sizeof *cells->offset)) != NULL;
    if (!complete)
        return heap->refusal;
    cut_blocks(grid, cells);
    find_offsets(&model->hull, cells);
    mark_interior(grid);
    return SNOW_OK;
}

static reiter_cell get(const snow_grid *grid, int32_t q, int32_t r)
{
    const rows *cells = rows_of(grid);
    size_t i = rows_number(grid, q, r);
    if (cells->state[i] == CELL_VAPOUR || cells->state[i] == CELL_FIXED)
        return (reiter_cell){.value = cells->vapour[cells->now][i]};
    return (reiter_cell){
        .value = cells->collected[i],
        .additions = (uint32_t)grid->census.steps - cells->since[i],
        .frozen = cells->state[i] == CELL_FROZEN,
        .receptive = true,
    };
}

static void put(snow_grid *grid, int32_t q, int32_t r, const reiter_cell *cell)
{
    rows *cells = rows_of(grid);
    size_t i = rows_number(grid, q, r);
    if (cells->state[i] != CELL_FIXED)
        cells->state[i] = cell->frozen ? CELL_FROZEN : cell->receptive ? CELL_FRONT : CELL_VAPOUR;
    cells->vapour[cells->now][i] = cell->value;
    cells->collected[i] = cell->value;
    cells->since[i] = (uint32_t)grid->census.steps - cell->additions;
}

/* A cell that was put may have become receptive, or no longer be. */
static void settle_state(const snow_grid *grid, int32_t q, int32_t r)
{
    rows *cells = rows_of(grid);
    size_t i = rows_number(grid, q, r);
    if (cells->state[i] == CELL_FROZEN)
        return;
    bool was_front = cells->state[i] == CELL_FRONT;
    bool is_front = rows_is_by(grid, q, r, CELL_FROZEN);
    if (is_front && !was_front) {
        cells->collected[i] = cells->vapour[cells->now][i];
        cells->since[i] = (uint32_t)grid->census.steps;
    } else if (was_front && !is_front) {
        cells->vapour[cells->now][i] = cells->collected[i];
    }
    cells->state[i] = is_front ? CELL_FRONT : CELL_VAPOUR;
}

static void settle(snow_grid *grid)
{
    rows *cells = rows_of(grid);
    const snow_domain *domain = &grid->domain;
    const reiter *model = reiter_of(grid);
    for (int32_t row = 0; row < domain->rows; row++)
        for (int32_t q = domain->run[row].first; q < domain->run[row].end; q++)
            settle_state(grid, q, domain->top + row);
    for (size_t i = 0; i < model->hull.cells; i++) {
        bool holds_vapour = cells->state[i] == CELL_VAPOUR || cells->state[i] == CELL_FIXED;
        double vapour = holds_vapour ? reiter_settled(model, cells->vapour[cells->now][i]) : 0;
        cells->vapour[0][i] = vapour;
        cells->vapour[1][i] = vapour;
    }
    snow_rows_list_front(grid);
}

static void diffuse_block(const snow_grid *grid, row_block *block, double *next)
{
    const reiter *model = reiter_of(grid);
    const rows *cells = rows_of(grid);
    const double *vapour = cells->vapour[cells->now];
    const double weight = model->params.diffusion / 12;
    const double rounder = reiter_rounder(model);
    bool watch = reiter_overshoots(model);
    const double highest_vapour = reiter_threshold() - 0x1p-53;
    block->unstable = false;
    block->overshoots = false;
    for (int32_t row = block->first_row; row < block->end_row; row++) {
        const snow_run_of_cells *run = &grid->domain.run[row];
        int32_t r = grid->domain.top + row;
        size_t first = rows_number(grid, run->first, r);
        size_t count = (size_t)(run->end - run->first);
        cells->kernel->diffuse(next + first, vapour + rows_number(grid, run->first, r - 1), vapour + first,
                               vapour + rows_number(grid, run->first, r + 1), count, weight, rounder);
        if (watch) {
            block->unstable = block->unstable || cells->kernel->exceeds(next + first, count, model->bound);
            block->overshoots = block->overshoots || cells->kernel->exceeds(next + first, count, highest_vapour);
        }
    }
}

static double *next_of(const rows *cells)
{
    return cells->vapour[1 - cells->now];
}

/* Where nothing can go wrong, a block is computed in one go. */
static void step_block(void *argument, size_t index)
{
    const snow_grid *grid = argument;
    rows *cells = rows_of(grid);
    diffuse_block(grid, &cells->block[index], next_of(cells));
    snow_rows_collect(grid, &cells->block[index], next_of(cells));
}

static void diffuse_only(void *argument, size_t index)
{
    const snow_grid *grid = argument;
    rows *cells = rows_of(grid);
    diffuse_block(grid, &cells->block[index], next_of(cells));
}

static void collect_only(void *argument, size_t index)
{
    const snow_grid *grid = argument;
    rows *cells = rows_of(grid);
    snow_rows_collect(grid, &cells->block[index], next_of(cells));
    if (cells->block[index].overshoots)
        snow_rows_overshoot(grid, &cells->block[index], next_of(cells));
}

/* Where the field may grow without bound, that is known before anything is changed. */
static snow_status diffuse_and_collect(snow_grid *grid)
{
    const rows *cells = rows_of(grid);
    if (!reiter_overshoots(reiter_of(grid))) {
        snow_grid_for(grid, cells->blocks, step_block, grid);
        return SNOW_OK;
    }
    snow_grid_for(grid, cells->blocks, diffuse_only, grid);
    for (size_t i = 0; i < cells->blocks; i++)
        if (cells->block[i].unstable)
            return SNOW_ERROR_UNSTABLE;
    snow_grid_for(grid, cells->blocks, collect_only, grid);
    return SNOW_OK;
}

static bool is_still(const snow_grid *grid, bool froze)
{
    const rows *cells = rows_of(grid);
    for (size_t i = 0; i < cells->blocks; i++)
        if (cells->block[i].collected)
            return false;
    return !froze && !snow_rows_front_gains(grid) &&
           memcmp(cells->vapour[0], cells->vapour[1], reiter_of(grid)->hull.cells * sizeof(double)) == 0;
}

static snow_status step(snow_grid *grid)
{
    rows *cells = rows_of(grid);
    snow_status status = diffuse_and_collect(grid);
    if (status != SNOW_OK)
        return status;
    snow_census *census = &grid->census;
    census->steps++;
    bool froze = snow_rows_freeze(grid, next_of(cells));
    cells->now = 1 - cells->now;
    if (snow_census_looks(census->steps))
        census->still = is_still(grid, froze);
    return SNOW_OK;
}

const reiter_engine snow_reiter_rows = {
    .create = create,
    .step = step,
    .get = get,
    .put = put,
    .settle = settle,
    .destroy = destroy,
};
