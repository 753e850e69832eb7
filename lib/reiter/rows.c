#include "reiter/rows_vapour.h"

#include <string.h>

static const reiter_kernel *choose_kernel(snow_isa isa, bool single)
{
    switch (isa) {
#ifdef SNOW_HAVE_X86_KERNELS
    case SNOW_ISA_AVX2: return single ? &snow_reiter_single_avx2 : &snow_reiter_double_avx2;
    case SNOW_ISA_AVX512: return single ? &snow_reiter_single_avx512 : &snow_reiter_double_avx512;
#else
    case SNOW_ISA_AVX2:
    case SNOW_ISA_AVX512:
#endif
    case SNOW_ISA_AUTO:
    case SNOW_ISA_BASELINE: break;
    }
    return single ? &snow_reiter_single_baseline : &snow_reiter_double_baseline;
}

static snow_status create(snow_grid *grid)
{
    snow_status status = snow_rows_create(grid);
    if (status == SNOW_OK)
        rows_of(grid)->kernel = choose_kernel(grid->options.isa, rows_of(grid)->single);
    return status;
}

static const snow_domain *part(const snow_grid *grid)
{
    return &rows_of(grid)->part;
}

static size_t numbers(const snow_grid *grid)
{
    return rows_of(grid)->count;
}

static size_t number(const snow_grid *grid, int32_t q, int32_t r)
{
    snow_cell cell = rows_representative(grid, q, r);
    return rows_number(rows_of(grid), cell.q, cell.r);
}

/* Fixed cells of a folded scene are all alike, and not all of them are stored. */
static bool is_fixed_and_folded(const snow_grid *grid, int32_t q, int32_t r)
{
    return reiter_of(grid)->group != SNOW_GROUP_TRIVIAL && !snow_domain_has(&grid->domain, q, r);
}

static reiter_cell get(const snow_grid *grid, int32_t q, int32_t r)
{
    const rows *cells = rows_of(grid);
    if (is_fixed_and_folded(grid, q, r))
        return (reiter_cell){.value = cells->fixed};
    size_t i = number(grid, q, r);
    cell_state state = (cell_state)cells->state[i];
    if (state == CELL_VAPOUR || state == CELL_OTHER)
        return (reiter_cell){.value = rows_vapour(cells, i)};
    receptive_cell loose = {(uint32_t)i, cells->place[i], rows_vapour(cells, i)};
    const receptive_cell *cell = cells->loose ? &loose : &cells->listed[cells->place[i]];
    return (reiter_cell){
        .value = cell->collected,
        .additions = (uint32_t)grid->census.steps - cell->since,
        .frozen = state != CELL_FRONT,
        .receptive = true,
    };
}

/* From here on, until they are settled, cells hold what they are given, unrounded. */
static void loosen(rows *cells)
{
    if (cells->loose)
        return;
    for (size_t i = 0; i < cells->count && cells->single; i++)
        rows_put_vapour(cells, i, rows_vapour(cells, i));
    cells->loose = true;
    snow_rows_unlist(cells);
}

static void put(snow_grid *grid, int32_t q, int32_t r, const reiter_cell *cell)
{
    rows *cells = rows_of(grid);
    loosen(cells);
    if (is_fixed_and_folded(grid, q, r)) {
        cells->fixed = cell->value;
        return;
    }
    size_t i = number(grid, q, r);
    if (cells->state[i] != CELL_OTHER)
        cells->state[i] = cell->frozen ? CELL_FROZEN : cell->receptive ? CELL_FRONT : CELL_VAPOUR;
    rows_put_vapour(cells, i, cell->value);
    if (cell->frozen || cell->receptive) /* elsewhere the memory need not even be touched */
        cells->place[i] = (uint32_t)grid->census.steps - cell->additions;
}

static bool is_frozen(const snow_grid *grid, int32_t q, int32_t r)
{
    return snow_domain_has(&grid->domain, q, r) && rows_of(grid)->state[number(grid, q, r)] == CELL_FROZEN;
}

static bool is_by_ice(const snow_grid *grid, int32_t q, int32_t r)
{
    return is_frozen(grid, q + 1, r) || is_frozen(grid, q - 1, r) || is_frozen(grid, q, r + 1) ||
           is_frozen(grid, q, r - 1) || is_frozen(grid, q + 1, r - 1) || is_frozen(grid, q - 1, r + 1);
}

/* A cell that was put may have become receptive, or no longer be. */
static void settle_state(const snow_grid *grid, int32_t q, int32_t r)
{
    rows *cells = rows_of(grid);
    size_t i = rows_number(cells, q, r);
    if (cells->state[i] == CELL_FROZEN)
        return;
    bool was_front = cells->state[i] == CELL_FRONT;
    bool is_front = is_by_ice(grid, q, r);
    cells->state[i] = is_front ? CELL_FRONT : CELL_VAPOUR;
    if (is_front && !was_front)
        cells->place[i] = (uint32_t)grid->census.steps;
}

/* Padding that is never read may hold anything, so all that is not of the part is fixed. */
static double settled_vapour(const snow_grid *grid, size_t i)
{
    const reiter *model = reiter_of(grid);
    const rows *cells = rows_of(grid);
    switch (cells->state[i]) {
    case CELL_VAPOUR: return reiter_settled(model, rows_vapour(cells, i));
    case CELL_OTHER:
        return reiter_settled(model, model->group == SNOW_GROUP_TRIVIAL ? rows_vapour(cells, i) : cells->fixed);
    default: return 0;
    }
}

static void settle(snow_grid *grid)
{
    rows *cells = rows_of(grid);
    loosen(cells);
    for (snow_walk walk = snow_walk_over(&cells->part, NULL); snow_walk_next(&walk);)
        settle_state(grid, walk.cell.q, walk.cell.r);
    snow_rows_list(grid);
    cells->fixed = reiter_settled(reiter_of(grid), cells->fixed);
    cells->quantum = reiter_quantum(reiter_of(grid));
    for (size_t i = 0; i < cells->count; i++)
        rows_settle_vapour(cells, i, settled_vapour(grid, i));
    cells->loose = false;
    snow_rows_copy_ghosts(cells, cells->vapour[0]);
    snow_rows_copy_ghosts(cells, cells->vapour[1]);
    snow_rows_wake_all(cells);
}

static void *next_of(const rows *cells)
{
    return cells->vapour[1 - cells->now];
}

/* In the units of the vapour. */
static double stored(const rows *cells, double value)
{
    return cells->single ? value / cells->quantum : value;
}

/* Whether the step that is being taken looks at what flows. */
static bool looks(const snow_grid *grid)
{
    return grid->census.steps % ROWS_LOOK_STEPS == ROWS_LOOK_STEPS - 1;
}

reiter_flow snow_rows_flow(const snow_grid *grid, int now)
{
    const reiter *model = reiter_of(grid);
    const rows *cells = rows_of(grid);
    return (reiter_flow){
        .vapour = cells->vapour[now],
        .next = cells->vapour[1 - now],
        .weight = cells->single ? reiter_single_weight(model) : model->params.diffusion / 12,
        .rounder = reiter_rounder(model),
        .tolerance = stored(cells, model->params.tolerance),
        .backward = now == 1, /* there and back: a step begins with what the one before has left in the cache */
    };
}

static void diffuse(const snow_grid *grid, const row_block *block)
{
    const rows *cells = rows_of(grid);
    reiter_flow flow = snow_rows_flow(grid, cells->now);
    const reiter_segment *segments = cells->segment + block->first_segment;
    if (looks(grid))
        cells->kernel->diffuse_and_look(&flow, segments, block->segments, cells->flowing);
    else
        cells->kernel->diffuse(&flow, segments, block->segments);
}

/* Whether any cell that was computed is beyond ±limit. */
static bool exceeds(const rows *cells, const row_block *block, double limit)
{
    const reiter_segment *segments = cells->segment + block->first_segment;
    return cells->kernel->exceeds(next_of(cells), segments, block->segments, stored(cells, limit));
}

/* Where nothing can go wrong, a block is computed in one go. */
static void step_block(void *argument, size_t index)
{
    const snow_grid *grid = argument;
    rows *cells = rows_of(grid);
    diffuse(grid, &cells->block[index]);
    snow_rows_collect(grid, &cells->block[index], next_of(cells));
}

static void diffuse_and_watch(void *argument, size_t index)
{
    const snow_grid *grid = argument;
    rows *cells = rows_of(grid);
    row_block *block = &cells->block[index];
    const double highest_vapour = reiter_threshold(reiter_of(grid)) - 0x1p-53;
    diffuse(grid, block);
    block->unstable = exceeds(cells, block, reiter_of(grid)->bound);
    block->overshoots = exceeds(cells, block, highest_vapour);
}

static void collect_only(void *argument, size_t index)
{
    const snow_grid *grid = argument;
    rows *cells = rows_of(grid);
    snow_rows_collect(grid, &cells->block[index], next_of(cells));
    if (cells->block[index].overshoots)
        snow_rows_overshoot(grid, &cells->block[index], next_of(cells));
}

/* Our own threads only where a step takes longer than it takes them to meet. */
static void for_blocks(snow_grid *grid, snow_task task)
{
    enum { LEAST_CHUNKS = 512 }; /* some 10 µs */
    const rows *cells = rows_of(grid);
    if (grid->options.parallel_for != NULL || cells->listed_chunks >= LEAST_CHUNKS) {
        snow_grid_for(grid, cells->blocks, task, grid);
        return;
    }
    for (size_t i = 0; i < cells->blocks; i++)
        task(grid, i);
}

/* Where the field may grow without bound, that is known before anything is changed. */
static snow_status diffuse_and_collect(snow_grid *grid)
{
    const rows *cells = rows_of(grid);
    if (!reiter_overshoots(reiter_of(grid))) {
        for_blocks(grid, step_block);
        return SNOW_OK;
    }
    for_blocks(grid, diffuse_and_watch);
    for (size_t i = 0; i < cells->blocks; i++)
        if (cells->block[i].unstable)
            return SNOW_ERROR_UNSTABLE;
    for_blocks(grid, collect_only);
    return SNOW_OK;
}

bool snow_rows_is_still(const snow_grid *grid, bool froze)
{
    const rows *cells = rows_of(grid);
    for (size_t i = 0; i < cells->blocks; i++)
        if (cells->block[i].collected)
            return false;
    return !froze && !snow_rows_front_gains(grid) &&
           memcmp(cells->vapour[0], cells->vapour[1], cells->count * rows_vapour_size(cells)) == 0;
}

static snow_status step(snow_grid *grid)
{
    rows *cells = rows_of(grid);
    bool looking = looks(grid);
    if (rows_looks_at_all(grid))
        snow_rows_wake_all(cells);
    if (cells->stale)
        snow_rows_list_segments(cells);
    if (looking)
        memset(cells->flowing, 0, cells->map_words * sizeof *cells->flowing);
    snow_status status = diffuse_and_collect(grid);
    if (status != SNOW_OK)
        return status;
    snow_census *census = &grid->census;
    census->steps++;
    bool froze = snow_rows_freeze(grid, next_of(cells), looking);
    snow_rows_copy_ghosts(cells, next_of(cells));
    if (looking)
        snow_rows_choose_active(grid);
    cells->now = 1 - cells->now;
    if (snow_census_looks(census->steps))
        census->still = snow_rows_is_still(grid, froze);
    return SNOW_OK;
}

const reiter_engine snow_reiter_rows = {
    .folds = true,
    .create = create,
    .part = part,
    .numbers = numbers,
    .number = number,
    .step = step,
    .pass_steps = snow_rows_pass_steps,
    .pass = snow_rows_pass,
    .get = get,
    .put = put,
    .settle = settle,
    .destroy = snow_rows_destroy,
};
