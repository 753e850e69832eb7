/* The front of the ROWS engine: the receptive cells that are not frozen yet,
   and, because the fixed cells feed it for ever, ice at the very rim. */
#include "reiter/rows.h"

#include <string.h>

/* The vapour of a receptive cell counts as zero, so what the kernel computed
   for it is just what has diffused into it. */
void snow_rows_collect(const snow_grid *grid, row_block *block, double *next)
{
    const reiter *model = reiter_of(grid);
    rows *cells = rows_of(grid);
    uint32_t step = (uint32_t)grid->census.steps + 1;
    const double threshold = reiter_threshold();
    uint32_t *front = cells->listed + block->first;
    size_t left = 0;
    bool collected = false;
    for (size_t k = 0; k < block->front; k++) {
        uint32_t i = front[k];
        double inflow = next[i];
        next[i] = 0;
        cells->collected[i] += inflow;
        double value = cells->collected[i] + reiter_addition(model, i) * (step - cells->since[i]);
        bool open = value < threshold;
        collected = collected || (open && inflow != 0);
        if (open || cells->state[i] == CELL_FROZEN) {
            front[k] = front[left];
            front[left++] = i;
        }
    }
    block->fresh = block->front - left;
    block->front = left;
    block->collected = collected;
    memmove(cells->listed + block->end - block->fresh, front + left, block->fresh * sizeof *front);
}

void snow_rows_overshoot(const snow_grid *grid, row_block *block, const double *next)
{
    const rows *cells = rows_of(grid);
    for (size_t i = block->first; i < block->end; i++) {
        if (cells->state[i] == CELL_VAPOUR && next[i] >= reiter_threshold()) {
            block->fresh++;
            cells->listed[block->end - block->fresh] = (uint32_t)i;
        }
    }
}

/* The row of a cell, by halving. */
static int32_t row_of(const snow_domain *hull, size_t i, int32_t first, int32_t end)
{
    while (end - first > 1) {
        int32_t middle = first + (end - first) / 2;
        if (hull->run[middle].number <= i)
            first = middle;
        else
            end = middle;
    }
    return first;
}

static snow_cell locate(const snow_grid *grid, const row_block *block, size_t i)
{
    const snow_domain *hull = &reiter_of(grid)->hull;
    int32_t row = row_of(hull, i, block->first_row + 1, block->end_row + 1);
    return (snow_cell){(int32_t)((int64_t)i - rows_of(grid)->offset[row]), hull->top + row};
}

static row_block *block_of(rows *cells, size_t i)
{
    row_block *block = cells->block;
    while (i >= block->end)
        block++;
    return block;
}

static void list(rows *cells, size_t i)
{
    row_block *block = block_of(cells, i);
    cells->listed[block->first + block->front++] = (uint32_t)i;
}

static void join_front(snow_grid *grid, double *next, size_t i)
{
    rows *cells = rows_of(grid);
    if (cells->state[i] != CELL_VAPOUR)
        return;
    cells->state[i] = CELL_FRONT;
    cells->collected[i] = next[i];
    cells->since[i] = (uint32_t)grid->census.steps;
    next[i] = 0;
    list(cells, i);
}

static void freeze_cell(snow_grid *grid, double *next, snow_cell cell)
{
    rows *cells = rows_of(grid);
    size_t i = rows_number(grid, cell.q, cell.r);
    if (cells->state[i] == CELL_VAPOUR) {
        cells->collected[i] = next[i];
        cells->since[i] = (uint32_t)grid->census.steps;
        next[i] = 0;
    }
    cells->state[i] = CELL_FROZEN;
    snow_reiter_freeze(grid, cell.q, cell.r);
}

/* Ice at the very rim goes on collecting what the fixed cells give off. */
static bool touches_fixed(const snow_grid *grid, snow_cell cell)
{
    return rows_is_by(grid, cell.q, cell.r, CELL_FIXED);
}

static void extend_front(snow_grid *grid, double *next, snow_cell cell)
{
    size_t i = rows_number(grid, cell.q, cell.r);
    if (touches_fixed(grid, cell))
        list(rows_of(grid), i);
    size_t above = rows_number(grid, cell.q, cell.r - 1);
    size_t below = rows_number(grid, cell.q, cell.r + 1);
    join_front(grid, next, i - 1);
    join_front(grid, next, i + 1);
    join_front(grid, next, above);
    join_front(grid, next, above + 1);
    join_front(grid, next, below - 1);
    join_front(grid, next, below);
}

/* All cells freeze before any front grows: a cell that freezes never joins the front. */
bool snow_rows_freeze(snow_grid *grid, double *next)
{
    const rows *cells = rows_of(grid);
    bool any = false;
    for (size_t b = 0; b < cells->blocks; b++) {
        const row_block *block = &cells->block[b];
        any = any || block->fresh > 0;
        for (size_t k = block->end - block->fresh; k < block->end; k++)
            freeze_cell(grid, next, locate(grid, block, cells->listed[k]));
    }
    for (size_t b = 0; b < cells->blocks; b++) {
        const row_block *block = &cells->block[b];
        for (size_t k = block->end - block->fresh; k < block->end; k++)
            extend_front(grid, next, locate(grid, block, cells->listed[k]));
    }
    return any;
}

bool snow_rows_front_gains(const snow_grid *grid)
{
    const reiter *model = reiter_of(grid);
    const rows *cells = rows_of(grid);
    for (size_t b = 0; b < cells->blocks; b++) {
        const row_block *block = &cells->block[b];
        for (size_t k = block->first; k < block->first + block->front; k++) {
            uint32_t i = cells->listed[k];
            if (cells->state[i] == CELL_FRONT && reiter_addition(model, i) > 0)
                return true;
        }
    }
    return false;
}

void snow_rows_list_front(snow_grid *grid)
{
    rows *cells = rows_of(grid);
    for (size_t b = 0; b < cells->blocks; b++) {
        row_block *block = &cells->block[b];
        block->front = 0;
        block->fresh = 0;
    }
    const snow_domain *domain = &grid->domain;
    for (int32_t row = 0; row < domain->rows; row++) {
        for (int32_t q = domain->run[row].first; q < domain->run[row].end; q++) {
            snow_cell cell = {q, domain->top + row};
            size_t i = rows_number(grid, q, cell.r);
            if (cells->state[i] == CELL_FRONT || (cells->state[i] == CELL_FROZEN && touches_fixed(grid, cell)))
                list(cells, i);
        }
    }
}
