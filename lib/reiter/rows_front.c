/* The front of the ROWS engine: the receptive cells that are not frozen yet,
   and, because the fixed cells feed it for ever, ice at the very rim. */
#include "reiter/rows.h"

#include <string.h>

/* The vapour of a receptive cell counts as zero, so what the kernel computed
   for it is just what has diffused into it. */
static inline void collect(const snow_grid *grid, row_block *block, double *restrict next, const double *addition_at)
{
    const reiter *model = reiter_of(grid);
    rows *cells = rows_of(grid);
    double *restrict held = cells->collected;
    const uint32_t *since = cells->since;
    const unsigned char *state = cells->state;
    uint32_t step = (uint32_t)grid->census.steps + 1;
    const double addition = model->params.addition;
    const double threshold = reiter_threshold();
    uint32_t *restrict front = cells->listed + block->first;
    size_t left = 0;
    bool collected = false;
    for (size_t k = 0; k < block->front; k++) {
        uint32_t i = front[k];
        double inflow = next[i];
        next[i] = 0;
        double now = held[i] + inflow;
        held[i] = now;
        double value = now + (addition_at != NULL ? addition_at[i] : addition) * (step - since[i]);
        bool open = value < threshold;
        collected |= open & (inflow * REITER_STILL_STEPS >= threshold - value);
        if (open || state[i] == CELL_FROZEN) {
            front[k] = front[left];
            front[left++] = i;
        }
    }
    block->fresh = block->front - left;
    block->front = left;
    block->collected = collected;
    memmove(cells->listed + block->end - block->fresh, front + left, block->fresh * sizeof *front);
}

void snow_rows_collect(const snow_grid *grid, row_block *block, double *next)
{
    const double *addition_at = reiter_of(grid)->addition_at;
    if (addition_at == NULL)
        collect(grid, block, next, NULL);
    else
        collect(grid, block, next, addition_at);
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

/* The row of a stored cell, by halving: 0 is the one above the part. */
static int32_t row_of(const rows *cells, size_t i, int32_t first, int32_t end)
{
    while (end - first > 1) {
        int32_t middle = first + (end - first) / 2;
        if ((size_t)(cells->offset[middle] + cells->first[middle]) <= i)
            first = middle;
        else
            end = middle;
    }
    return first;
}

static snow_cell locate(const rows *cells, const row_block *block, size_t i)
{
    int32_t row = row_of(cells, i, block->first_row + 1, block->end_row + 1);
    return (snow_cell){(int32_t)((int64_t)i - cells->offset[row]), cells->part.top + row - 1};
}

static void list(rows *cells, size_t i)
{
    row_block *block = cells->block;
    while (i >= block->end)
        block++;
    cells->listed[block->first + block->front++] = (uint32_t)i;
}

/* What a cell held as vapour it keeps; the place is zero from now on. */
static void take_vapour(const snow_grid *grid, double *next, snow_cell cell, bool looking)
{
    rows *cells = rows_of(grid);
    size_t i = rows_number(cells, cell.q, cell.r);
    cells->collected[i] = next[i];
    cells->since[i] = (uint32_t)grid->census.steps;
    if (next[i] != 0)
        snow_rows_wake(grid, cell.q, cell.r, looking);
    next[i] = 0;
}

static void join_front(snow_grid *grid, double *next, int32_t q, int32_t r, bool looking)
{
    rows *cells = rows_of(grid);
    if (!snow_domain_has(&grid->domain, q, r))
        return;
    snow_cell cell = snow_group_representative(reiter_of(grid)->group, q, r);
    size_t i = rows_number(cells, cell.q, cell.r);
    if (cells->state[i] != CELL_VAPOUR)
        return;
    take_vapour(grid, next, cell, looking);
    cells->state[i] = CELL_FRONT;
    list(cells, i);
}

static void freeze_cell(snow_grid *grid, double *next, snow_cell cell, bool looking)
{
    rows *cells = rows_of(grid);
    size_t i = rows_number(cells, cell.q, cell.r);
    if (cells->state[i] == CELL_VAPOUR)
        take_vapour(grid, next, cell, looking);
    cells->state[i] = CELL_FROZEN;
    snow_reiter_freeze(grid, cell.q, cell.r);
}

static void extend_front(snow_grid *grid, double *next, snow_cell cell, bool looking)
{
    if (snow_rows_touches_fixed(grid, cell.q, cell.r))
        list(rows_of(grid), rows_number(rows_of(grid), cell.q, cell.r));
    join_front(grid, next, cell.q - 1, cell.r, looking);
    join_front(grid, next, cell.q + 1, cell.r, looking);
    join_front(grid, next, cell.q, cell.r - 1, looking);
    join_front(grid, next, cell.q + 1, cell.r - 1, looking);
    join_front(grid, next, cell.q - 1, cell.r + 1, looking);
    join_front(grid, next, cell.q, cell.r + 1, looking);
}

/* All cells freeze before any front grows: a cell that freezes never joins the front. */
bool snow_rows_freeze(snow_grid *grid, double *next, bool looking)
{
    const rows *cells = rows_of(grid);
    bool any = false;
    for (size_t b = 0; b < cells->blocks; b++) {
        const row_block *block = &cells->block[b];
        any = any || block->fresh > 0;
        for (size_t k = block->end - block->fresh; k < block->end; k++)
            freeze_cell(grid, next, locate(cells, block, cells->listed[k]), looking);
    }
    for (size_t b = 0; b < cells->blocks; b++) {
        const row_block *block = &cells->block[b];
        for (size_t k = block->end - block->fresh; k < block->end; k++)
            extend_front(grid, next, locate(cells, block, cells->listed[k]), looking);
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
    const snow_domain *part = &cells->part;
    for (int32_t row = 0; row < part->rows; row++) {
        for (int32_t q = part->run[row].first; q < part->run[row].end; q++) {
            int32_t r = part->top + row;
            size_t i = rows_number(cells, q, r);
            if (cells->state[i] == CELL_FRONT ||
                (cells->state[i] == CELL_FROZEN && snow_rows_touches_fixed(grid, q, r)))
                list(cells, i);
        }
    }
}
