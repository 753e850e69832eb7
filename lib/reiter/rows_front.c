/* The front of the ROWS engine: the receptive cells that are not frozen yet,
   and, because the fixed cells feed it for ever, ice at the very rim. */
#include "reiter/rows_vapour.h"

static void put_into_list(rows *cells, size_t place, receptive_cell cell)
{
    cells->listed[place] = cell;
    cells->place[cell.number] = (uint32_t)place;
}

static void add_to_ice(rows *cells, row_block *block, receptive_cell cell)
{
    block->ice++;
    put_into_list(cells, block->end - block->ice, cell);
}

/* The last cell of the front takes the place of one that freezes. */
static void move_to_ice(rows *cells, row_block *block, size_t place)
{
    receptive_cell cell = cells->listed[place];
    block->front--;
    put_into_list(cells, place, cells->listed[block->first + block->front]);
    add_to_ice(cells, block, cell);
    block->fresh++;
}

/* The vapour of a receptive cell counts as zero, so what the kernel computed
   for it is just what has diffused into it. */
static inline void collect(const snow_grid *grid, row_block *block, void *next, bool single, const double *addition_at)
{
    rows *cells = rows_of(grid);
    receptive_cell *listed = cells->listed;
    uint32_t step = (uint32_t)grid->census.steps + 1;
    const double addition = reiter_of(grid)->params.addition;
    const double threshold = reiter_threshold(reiter_of(grid));
    const double quantum = cells->quantum;
    bool collected = false;
    block->fresh = 0;
    for (size_t place = block->first; place < block->first + block->front;) {
        receptive_cell *cell = &listed[place];
        uint32_t number = cell->number;
        double inflow = rows_take_from(next, number, single, quantum);
        double own = addition_at != NULL ? addition_at[number] : addition;
        if (rows_collect_inflow(cell, inflow, own, step, threshold, &collected) && cells->state[number] != CELL_FED)
            move_to_ice(cells, block, place);
        else
            place++;
    }
    block->collected = collected;
}

void snow_rows_collect(const snow_grid *grid, row_block *block, void *next)
{
    const double *addition_at = reiter_of(grid)->addition_at;
    if (rows_of(grid)->single)
        collect(grid, block, next, true, addition_at);
    else if (addition_at == NULL)
        collect(grid, block, next, false, NULL);
    else
        collect(grid, block, next, false, addition_at);
}

void snow_rows_overshoot(const snow_grid *grid, row_block *block, const void *next)
{
    rows *cells = rows_of(grid);
    for (size_t i = block->first; i < block->end; i++) {
        if (cells->state[i] == CELL_VAPOUR && rows_value_in(cells, next, i) >= reiter_threshold(reiter_of(grid))) {
            add_to_ice(cells, block, (receptive_cell){.number = (uint32_t)i});
            block->fresh++;
        }
    }
}

/* The band of the part that a cell of a block is stored in, by halving. */
static int32_t band_of(const rows *cells, const row_block *block, size_t i)
{
    int32_t first = block->first_band;
    int32_t end = block->end_band;
    while (end - first > 1) {
        int32_t middle = first + (end - first) / 2;
        if (cells->band[middle + 1].base <= i)
            first = middle;
        else
            end = middle;
    }
    return first;
}

snow_cell snow_rows_locate(const rows *cells, const row_block *block, size_t i)
{
    int32_t band = band_of(cells, block, i);
    const stored_band *stored = &cells->band[band + 1];
    uint32_t within = (uint32_t)(i - stored->base);
    int32_t row = band * REITER_BAND + (int32_t)(within / stored->stride);
    return (snow_cell){stored->first + (int32_t)(within % stored->stride), cells->part.top + row};
}

static row_block *block_of(const rows *cells, uint32_t number)
{
    row_block *block = cells->block;
    while (number >= block->end)
        block++;
    return block;
}

static void add_to_front(rows *cells, receptive_cell cell)
{
    row_block *block = block_of(cells, cell.number);
    put_into_list(cells, block->first + block->front++, cell);
}

/* What a cell held as vapour it keeps; the place is zero from now on. */
static receptive_cell take_vapour(const snow_grid *grid, void *next, snow_cell at, bool looking)
{
    const rows *cells = rows_of(grid);
    size_t i = rows_number(cells, at.q, at.r);
    double vapour = rows_take_from(next, i, cells->single, cells->quantum);
    if (vapour != 0)
        snow_rows_wake(grid, at.q, at.r, looking);
    return (receptive_cell){(uint32_t)i, (uint32_t)grid->census.steps, vapour};
}

static void join_front(snow_grid *grid, void *next, int32_t q, int32_t r, bool looking)
{
    rows *cells = rows_of(grid);
    if (!snow_domain_has(&grid->domain, q, r))
        return;
    snow_cell at = rows_representative(grid, q, r);
    size_t i = rows_number(cells, at.q, at.r);
    if (cells->state[i] != CELL_VAPOUR)
        return;
    cells->state[i] = CELL_FRONT;
    add_to_front(cells, take_vapour(grid, next, at, looking));
}

static void freeze_cell(snow_grid *grid, void *next, receptive_cell *fresh, snow_cell at, bool looking)
{
    rows *cells = rows_of(grid);
    if (cells->state[fresh->number] == CELL_VAPOUR)
        *fresh = take_vapour(grid, next, at, looking);
    cells->state[fresh->number] = CELL_FROZEN;
    snow_reiter_freeze(grid, at.q, at.r);
}

static void extend_front(snow_grid *grid, void *next, snow_cell at, bool looking)
{
    join_front(grid, next, at.q - 1, at.r, looking);
    join_front(grid, next, at.q + 1, at.r, looking);
    join_front(grid, next, at.q, at.r - 1, looking);
    join_front(grid, next, at.q + 1, at.r - 1, looking);
    join_front(grid, next, at.q - 1, at.r + 1, looking);
    join_front(grid, next, at.q, at.r + 1, looking);
}

/* The last of the ice takes the place of a cell that goes on collecting. */
static void feed_if_at_rim(const snow_grid *grid, row_block *block, size_t place, snow_cell at)
{
    rows *cells = rows_of(grid);
    if (!snow_rows_touches_fixed(grid, at.q, at.r))
        return;
    receptive_cell cell = cells->listed[place];
    cells->state[cell.number] = CELL_FED;
    put_into_list(cells, place, cells->listed[block->end - block->ice]);
    block->ice--;
    add_to_front(cells, cell);
}

/* All cells freeze before any front grows: a cell that freezes never joins the front. */
bool snow_rows_freeze(snow_grid *grid, void *next, bool looking)
{
    rows *cells = rows_of(grid);
    bool any = false;
    for (size_t b = 0; b < cells->blocks; b++) {
        const row_block *block = &cells->block[b];
        receptive_cell *fresh = cells->listed + block->end - block->ice;
        any = any || block->fresh > 0;
        for (size_t i = 0; i < block->fresh; i++)
            freeze_cell(grid, next, &fresh[i], snow_rows_locate(cells, block, fresh[i].number), looking);
    }
    for (size_t b = 0; b < cells->blocks; b++) {
        row_block *block = &cells->block[b];
        size_t first = block->end - block->ice;
        for (size_t place = first; place < first + block->fresh; place++) {
            snow_cell at = snow_rows_locate(cells, block, cells->listed[place].number);
            extend_front(grid, next, at, looking);
            feed_if_at_rim(grid, block, place, at);
        }
    }
    return any;
}

void snow_rows_freeze_cell(snow_grid *grid, uint32_t number, snow_cell at)
{
    rows *cells = rows_of(grid);
    bool fed = snow_rows_touches_fixed(grid, at.q, at.r);
    cells->state[number] = fed ? CELL_FED : CELL_FROZEN;
    if (!fed)
        move_to_ice(cells, block_of(cells, number), cells->place[number]);
    snow_reiter_freeze(grid, at.q, at.r);
}

void snow_rows_join(const snow_grid *grid, void *next, snow_cell at, bool looking)
{
    rows *cells = rows_of(grid);
    receptive_cell cell = take_vapour(grid, next, at, looking);
    cells->state[cell.number] = CELL_FRONT;
    add_to_front(cells, cell);
}

bool snow_rows_front_gains(const snow_grid *grid)
{
    const rows *cells = rows_of(grid);
    for (size_t b = 0; b < cells->blocks; b++) {
        const row_block *block = &cells->block[b];
        for (size_t place = block->first; place < block->first + block->front; place++) {
            uint32_t number = cells->listed[place].number;
            if (cells->state[number] == CELL_FRONT && reiter_addition(reiter_of(grid), number) > 0)
                return true;
        }
    }
    return false;
}

static void list_settled(const snow_grid *grid, snow_cell at)
{
    rows *cells = rows_of(grid);
    uint32_t number = (uint32_t)rows_number(cells, at.q, at.r);
    if (cells->state[number] == CELL_VAPOUR)
        return;
    receptive_cell cell = {number, cells->place[number], rows_vapour(cells, number)};
    if (cells->state[number] == CELL_FROZEN && snow_rows_touches_fixed(grid, at.q, at.r))
        cells->state[number] = CELL_FED;
    if (cells->state[number] == CELL_FROZEN)
        add_to_ice(cells, block_of(cells, number), cell);
    else
        add_to_front(cells, cell);
}

void snow_rows_list(snow_grid *grid)
{
    rows *cells = rows_of(grid);
    for (snow_walk walk = snow_walk_over(&cells->part, NULL); snow_walk_next(&walk);)
        list_settled(grid, walk.cell);
}

static void unlist(rows *cells, size_t first, size_t count)
{
    for (size_t place = first; place < first + count; place++) {
        const receptive_cell *cell = &cells->listed[place];
        rows_put_vapour(cells, cell->number, cell->collected);
        cells->place[cell->number] = cell->since;
        if (cells->state[cell->number] == CELL_FED)
            cells->state[cell->number] = CELL_FROZEN;
    }
}

void snow_rows_unlist(rows *cells)
{
    for (size_t b = 0; b < cells->blocks; b++) {
        row_block *block = &cells->block[b];
        unlist(cells, block->first, block->front);
        unlist(cells, block->end - block->ice, block->ice);
        block->front = 0;
        block->ice = 0;
        block->fresh = 0;
    }
}
