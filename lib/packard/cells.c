/* The frozen cells of a grid, whatever engine keeps them. */
#include "base/hexagon.h"
#include "packard/model.h"

enum { BLOCK_ROWS = 64 };

snow_status snow_packard_put(snow_grid *grid, const packard_region *region, const uint64_t *words)
{
    const packard *model = packard_of(grid);
    return model->engine->put(model->cells, region, words);
}

packard_region snow_packard_bounds(const snow_grid *grid)
{
    const snow_hexagon *hexagon = &grid->census.hexagon;
    if (snow_hexagon_is_empty(hexagon))
        return (packard_region){0, 0, 0, 0};
    return (packard_region){hexagon->least_q, hexagon->least_r, hexagon->greatest_q - hexagon->least_q + 1,
                            hexagon->greatest_r - hexagon->least_r + 1};
}

snow_status snow_packard_count(snow_grid *grid)
{
    const packard *model = packard_of(grid);
    snow_status status = model->engine->count(model->cells, &grid->census);
    if (status == SNOW_OK && packard_is_plane(model))
        snow_domain_follow(&grid->domain, &grid->census.hexagon);
    if (status == SNOW_OK)
        grid->census.rim = snow_packard_is_at_rim(grid);
    return status;
}

/* The rotation by 60 degrees and a mirror generate all symmetries. */
static bool images_are_frozen(const packard *model, int64_t q, int64_t r)
{
    const packard_region turned = {-r, q + r, 1, 1};
    const packard_region mirrored = {r, q, 1, 1};
    uint64_t word[2];
    model->engine->copy(model->cells, &turned, &word[0]);
    model->engine->copy(model->cells, &mirrored, &word[1]);
    return word[0] != 0 && word[1] != 0;
}

static bool is_symmetric_row(const packard *model, const packard_region *row)
{
    for (int64_t x = 0; x < row->width; x += PACKARD_WORD) {
        int64_t width = row->width - x < PACKARD_WORD ? row->width - x : PACKARD_WORD;
        uint64_t word;
        model->engine->copy(model->cells, &(packard_region){row->q + x, row->r, width, 1}, &word);
        for (int64_t bit = 0; word != 0; bit++, word >>= 1)
            if ((word & 1) != 0 && !images_are_frozen(model, row->q + x + bit, row->r))
                return false;
    }
    return true;
}

bool snow_packard_is_symmetric(const snow_grid *grid)
{
    const packard *model = packard_of(grid);
    snow_packard_domain domain = model->params.domain;
    if (domain != SNOW_PACKARD_PLANE && domain != SNOW_PACKARD_DISC && domain != SNOW_PACKARD_HEXAGON)
        return false;
    packard_region bounds = snow_packard_bounds(grid);
    const snow_hexagon *hexagon = &grid->census.hexagon;
    bool centred = bounds.width == bounds.height && hexagon->least_q + hexagon->greatest_q == 0 &&
                   hexagon->least_r == hexagon->least_q && hexagon->least_s == hexagon->least_q;
    if (!snow_packard_zones_are_symmetric(model) || bounds.width == 0 || !centred)
        return false;
    for (int64_t y = 0; y < bounds.height; y++)
        if (!is_symmetric_row(model, &(packard_region){bounds.q, bounds.r + y, bounds.width, 1}))
            return false;
    return true;
}

/* Cells with their freeze steps. */
static snow_status put_dates(const packard *from, const packard *to, const packard_region *block, const uint64_t *words)
{
    size_t stride = packard_words((uint64_t)block->width);
    for (int64_t y = 0; y < block->height; y++) {
        for (int64_t x = 0; x < block->width; x++) {
            if ((words[(size_t)y * stride + (size_t)x / PACKARD_WORD] >> (x % PACKARD_WORD) & 1) == 0)
                continue;
            int64_t step = from->engine->date(from->cells, block->q + x, block->r + y);
            snow_status status = to->engine->put_dated(to->cells, block->q + x, block->r + y, step);
            if (status != SNOW_OK)
                return status;
        }
    }
    return SNOW_OK;
}

static snow_status copy_cells(snow_grid *grid, const packard *from, const packard *to)
{
    packard_region bounds = snow_packard_bounds(grid);
    size_t stride = packard_words((uint64_t)bounds.width);
    if (bounds.height == 0)
        return SNOW_OK;
    uint64_t *words = snow_heap_get_raw(&grid->heap, stride, BLOCK_ROWS * sizeof *words);
    if (words == NULL)
        return grid->heap.refusal;
    snow_status status = SNOW_OK;
    for (int64_t y = 0; y < bounds.height && status == SNOW_OK; y += BLOCK_ROWS) {
        int64_t rows = bounds.height - y < BLOCK_ROWS ? bounds.height - y : BLOCK_ROWS;
        packard_region block = {bounds.q, bounds.r + y, bounds.width, rows};
        from->engine->copy(from->cells, &block, words);
        status = from->params.record_freeze_steps ? put_dates(from, to, &block, words)
                                                  : to->engine->put(to->cells, &block, words);
    }
    snow_heap_put(&grid->heap, words);
    return status;
}

snow_status snow_packard_convert(snow_grid *grid, const packard_engine *engine, bool folded)
{
    packard *model = packard_of(grid);
    packard next = *model;
    next.engine = engine;
    next.folded = folded;
    next.zones_last = 0; /* it has none yet */
    snow_status status = engine->create(grid, folded, &next.cells);
    if (status != SNOW_OK)
        return status;
    status = copy_cells(grid, model, &next);
    if (status != SNOW_OK) {
        engine->destroy(grid, next.cells);
        return status;
    }
    model->engine->destroy(grid, model->cells);
    *model = next;
    return SNOW_OK;
}

snow_status snow_packard_unfold(snow_grid *grid)
{
    packard *model = packard_of(grid);
    if (model->folded && model->engine == &snow_packard_tiles)
        return snow_packard_convert(grid, model->engine, false);
    model->folded = false;
    return SNOW_OK;
}

snow_status snow_packard_settle(snow_grid *grid)
{
    packard *model = packard_of(grid);
    snow_status status = snow_packard_count(grid);
    if (status != SNOW_OK || model->engine != &snow_packard_tiles)
        return status;
    bool folds = model->params.rule % 2 == 0; /* a rule that freezes lonely cells needs all of them */
    return folds && snow_packard_is_symmetric(grid) ? snow_packard_convert(grid, &snow_packard_tiles, true) : SNOW_OK;
}
