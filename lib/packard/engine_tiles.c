/* The tile engine as the model sees it. */
#include "base/hexagon.h"
#include "packard/model.h"
#include "packard/tiles.h"

#include <string.h>

typedef struct tile_cells {
    snow_grid *grid;
    snow_tiles *tiles;
    int64_t q, r;       /* where the tiles' first cell lies: of a torus, its first cell */
    int64_t zones_step; /* a step of those for which the mask is made */
} tile_cells;

static void keep_inside(const snow_grid *grid, int64_t q, int64_t r, uint64_t *allowed)
{
    for (int64_t y = 0; y < SNOW_TILE_SIDE; y++) {
        snow_run_of_cells run = snow_domain_row(&grid->domain, r + y);
        int64_t first = run.first > q ? run.first - q : 0;
        int64_t end = run.end < q + SNOW_TILE_SIDE ? run.end - q : SNOW_TILE_SIDE;
        if (first >= end) {
            allowed[y] = 0;
            continue;
        }
        uint64_t below_end = end == SNOW_TILE_SIDE ? UINT64_MAX : (UINT64_C(1) << end) - 1;
        allowed[y] = below_end & UINT64_MAX << first;
    }
}

/* Only of cells that are allowed so far: outside the domain nothing freezes, whatever the zones say. */
static void demand(const packard *model, int64_t step, int64_t q, int64_t r, uint64_t *allowed, uint64_t *priority)
{
    for (int64_t y = 0; y < SNOW_TILE_SIDE; y++) {
        for (uint64_t left = allowed[y]; left != 0; left &= left - 1) {
            int x = __builtin_ctzll(left);
            unsigned demands = snow_packard_zones_at(model, step, q + x, r + y);
            if (demands & PACKARD_RESTRICTED)
                allowed[y] &= ~(UINT64_C(1) << x);
            if (demands & PACKARD_PREFERRED)
                priority[y] |= UINT64_C(1) << x;
        }
    }
}

static bool demands_anything(const uint64_t *allowed, const uint64_t *priority)
{
    for (int64_t y = 0; y < SNOW_TILE_SIDE; y++)
        if (allowed[y] != UINT64_MAX || priority[y] != 0)
            return true;
    return false;
}

/* A snow_tile_mask. */
static bool mask(const void *context, int64_t q, int64_t r, uint64_t *allowed, uint64_t *priority)
{
    const tile_cells *cells = context;
    const packard *model = packard_of(cells->grid);
    q += cells->q;
    r += cells->r;
    if (packard_has_rim(model))
        keep_inside(cells->grid, q, r, allowed);
    if (snow_packard_zones_touch(model, cells->zones_step, &(packard_region){q, r, SNOW_TILE_SIDE, SNOW_TILE_SIDE}))
        demand(model, cells->zones_step, q, r, allowed, priority);
    return demands_anything(allowed, priority);
}

/* Without domain and zones no tile is asked for its mask. */
static snow_tile_mask mask_of(const tile_cells *cells)
{
    const packard *model = packard_of(cells->grid);
    return packard_has_rim(model) || snow_packard_zones_apply(model, cells->zones_step) ? mask : NULL;
}

/* Rules with d0 = 1 reach cells that nothing touches. */
static snow_status cover(const tile_cells *cells)
{
    if (packard_of(cells->grid)->params.rule % 2 == 0)
        return SNOW_OK;
    const snow_rect *bounds = &cells->grid->domain.bounds;
    return snow_tiles_cover(cells->tiles, bounds->q - cells->q, bounds->r - cells->r, bounds->width, bounds->height);
}

static void share_work(const snow_grid *grid, snow_tiles_plan *plan)
{
    const snow_options *options = &grid->options;
    plan->threads = options->threads;
    plan->loop = options->parallel_for != NULL ? options->parallel_for : grid->team != NULL ? snow_team_for : NULL;
    plan->loop_context = options->parallel_for != NULL ? options->parallel_context : grid->team;
}

static void destroy(snow_grid *grid, void *engine)
{
    tile_cells *cells = engine;
    if (cells->tiles != NULL)
        snow_tiles_destroy(cells->tiles);
    snow_heap_put(&grid->heap, cells);
}

static snow_status create(snow_grid *grid, const packard_fold *fold, void **result)
{
    const packard *model = packard_of(grid);
    tile_cells *cells = snow_heap_get(&grid->heap, 1, sizeof *cells);
    if (cells == NULL)
        return grid->heap.refusal;
    cells->grid = grid;
    snow_tiles_plan plan = {
        .freezes = (uint8_t)model->params.rule,
        .isa = grid->options.isa,
        .folded = fold->possible,
        .fold_q = fold->q,
        .fold_r = fold->r,
        .dated = model->params.record_freeze_steps != 0,
        .mask = packard_has_rim(model) ? mask : NULL,
        .mask_context = cells,
    };
    if (model->params.domain == SNOW_PACKARD_TORUS) {
        plan.width = model->params.width;
        plan.height = model->params.height;
        cells->q = grid->domain.bounds.q;
        cells->r = grid->domain.bounds.r;
        plan.centre_q = -cells->q;
        plan.centre_r = -cells->r;
    }
    share_work(grid, &plan);
    snow_status status = snow_tiles_create(&cells->tiles, &grid->heap, &plan);
    if (status == SNOW_OK)
        status = cover(cells);
    if (status != SNOW_OK) {
        destroy(grid, cells);
        return status;
    }
    snow_tiles_set_steps(cells->tiles, grid->census.steps);
    *result = cells;
    return SNOW_OK;
}

static snow_status put(void *engine, const packard_region *region, const uint64_t *words)
{
    tile_cells *cells = engine;
    size_t stride = packard_words((uint64_t)region->width);
    snow_status status = SNOW_OK;
    for (int64_t y = 0; y < region->height && status == SNOW_OK; y++)
        status = snow_tiles_put_row(cells->tiles, region->q - cells->q, region->r - cells->r + y,
                                    (size_t)region->width, words + (size_t)y * stride);
    return status;
}

static snow_status put_dated(void *engine, int64_t q, int64_t r, int64_t step)
{
    tile_cells *cells = engine;
    return snow_tiles_set_dated(cells->tiles, q - cells->q, r - cells->r, step);
}

static void copy(const void *engine, const packard_region *region, uint64_t *words)
{
    const tile_cells *cells = engine;
    size_t stride = packard_words((uint64_t)region->width);
    for (int64_t y = 0; y < region->height; y++)
        snow_tiles_row(cells->tiles, region->q - cells->q, region->r - cells->r + y, (size_t)region->width,
                       words + (size_t)y * stride);
}

static bool next(const void *engine, int64_t *q, int64_t *r)
{
    const tile_cells *cells = engine;
    int64_t tile_q = *q - cells->q;
    int64_t tile_r = *r - cells->r;
    bool found = snow_tiles_next(cells->tiles, &tile_q, &tile_r);
    *q = tile_q + cells->q;
    *r = tile_r + cells->r;
    return found;
}

static int64_t date(const void *engine, int64_t q, int64_t r)
{
    const tile_cells *cells = engine;
    return snow_tiles_date(cells->tiles, q - cells->q, r - cells->r);
}

static snow_status advance(void *engine, int64_t steps, int64_t *taken)
{
    enum { ENOUGH_VISITS = 1 << 17 };
    snow_tiles *tiles = ((tile_cells *)engine)->tiles;
    int64_t before = snow_tiles_steps(tiles);
    uint64_t visits = snow_tiles_visits(tiles);
    snow_status status = SNOW_OK;
    *taken = 0;
    while (status == SNOW_OK && *taken < steps && snow_tiles_visits(tiles) - visits < ENOUGH_VISITS) {
        int64_t part = *taken > 0 ? *taken : 1;
        status = snow_tiles_advance(tiles, part < steps - *taken ? part : steps - *taken);
        *taken = snow_tiles_steps(tiles) - before;
    }
    return status;
}

static snow_status change_zones(void *engine)
{
    tile_cells *cells = engine;
    int64_t before = cells->zones_step;
    cells->zones_step = cells->grid->census.steps + 1;
    snow_status status = snow_tiles_set_mask(cells->tiles, mask_of(cells), cells);
    if (status == SNOW_OK)
        status = cover(cells);
    if (status != SNOW_OK)
        cells->zones_step = before;
    return status;
}

static snow_status count(void *engine, snow_census *census)
{
    tile_cells *cells = engine;
    snow_tiles_census tiles;
    snow_tiles_count(cells->tiles, &tiles);
    census->frozen = tiles.frozen;
    census->frozen_high = 0;
    census->tip_square = -1;
    census->hexagon = snow_hexagon_empty();
    if (tiles.frozen == 0)
        return SNOW_OK;
    census->tip_square = (double)tiles.tip_square;
    census->hexagon = (snow_hexagon){
        tiles.least_q + cells->q, tiles.greatest_q + cells->q, tiles.least_r + cells->r, tiles.greatest_r + cells->r,
        tiles.least_s + cells->q + cells->r, tiles.greatest_s + cells->q + cells->r};
    return SNOW_OK;
}

static bool is_still(void *engine)
{
    return snow_tiles_still(((tile_cells *)engine)->tiles);
}

const packard_engine snow_packard_tiles = {
    .name = SNOW_PACKARD_ENGINE_TILES,
    .create = create,
    .destroy = destroy,
    .put = put,
    .put_dated = put_dated,
    .copy = copy,
    .next = next,
    .date = date,
    .advance = advance,
    .change_zones = change_zones,
    .count = count,
    .is_still = is_still,
};
