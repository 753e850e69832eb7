/* The frozen cells of a grid, whatever engine keeps them. */
#include "base/hexagon.h"
#include "packard/model.h"

#include <string.h>

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

/* Where the centre of all symmetries is, if domain, zones and the crystal's extents have them. */
static packard_fold possible_fold(const snow_grid *grid)
{
    const packard *model = packard_of(grid);
    const packard_fold none = {.possible = false};
    const snow_hexagon *hexagon = &grid->census.hexagon;
    bool anywhere = packard_is_plane(model);
    bool bounded = model->params.domain == SNOW_PACKARD_DISC || model->params.domain == SNOW_PACKARD_HEXAGON;
    bool lonely = model->params.rule % 2 != 0; /* such a rule needs all cells, those that nothing touches too */
    if ((!anywhere && !bounded) || lonely || snow_hexagon_is_empty(hexagon) || snow_packard_is_sparse(grid))
        return none;
    int64_t reach = (hexagon->greatest_q - hexagon->least_q) / 2;
    packard_fold fold = {true, hexagon->least_q + reach, hexagon->least_r + reach};
    bool regular = hexagon->greatest_q == fold.q + reach && hexagon->greatest_r == fold.r + reach &&
                   hexagon->least_s == fold.q + fold.r - reach && hexagon->greatest_s == fold.q + fold.r + reach;
    bool fits = anywhere || (fold.q == 0 && fold.r == 0);
    return regular && fits && snow_packard_zones_are_symmetric(model, fold.q, fold.r) ? fold : none;
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

/* Rows of the crystal that are copied at a time, and room for them. */
typedef struct row_block {
    packard_region bounds, block;
    uint64_t *words;
} row_block;

static snow_status block_start(snow_grid *grid, row_block *rows)
{
    rows->bounds = snow_packard_bounds(grid);
    rows->block = (packard_region){rows->bounds.q, rows->bounds.r, rows->bounds.width, 0};
    rows->words = snow_heap_get_raw(&grid->heap, packard_words((uint64_t)rows->bounds.width) + 1,
                                    BLOCK_ROWS * sizeof *rows->words);
    return rows->words != NULL ? SNOW_OK : grid->heap.refusal;
}

/* The next rows; false: there are no more. */
static bool block_next(row_block *rows)
{
    rows->block.r += rows->block.height;
    int64_t left = rows->bounds.r + rows->bounds.height - rows->block.r;
    rows->block.height = left < BLOCK_ROWS ? left : BLOCK_ROWS;
    return left > 0;
}

snow_status snow_packard_put_block(const packard *from, const packard *to, const packard_region *block,
                                   const uint64_t *words)
{
    return from->params.record_freeze_steps ? put_dates(from, to, block, words)
                                            : to->engine->put(to->cells, block, words);
}

static snow_status copy_blocks(const snow_grid *grid, const packard *from, const packard *to)
{
    uint64_t words[PACKARD_BLOCK];
    packard_region block;
    snow_status status = SNOW_OK;
    for (bool more = snow_packard_first_block(grid, &block); more && status == SNOW_OK;
         more = snow_packard_next_block(grid, &block)) {
        from->engine->copy(from->cells, &block, words);
        status = snow_packard_put_block(from, to, &block, words);
    }
    return status;
}

static snow_status copy_rows(snow_grid *grid, const packard *from, const packard *to)
{
    row_block rows;
    snow_status status = block_start(grid, &rows);
    while (status == SNOW_OK && block_next(&rows)) {
        from->engine->copy(from->cells, &rows.block, rows.words);
        status = snow_packard_put_block(from, to, &rows.block, rows.words);
    }
    snow_heap_put(&grid->heap, rows.words);
    return status;
}

/* Rows are long, and that is what the quadtree likes. */
static snow_status copy_cells(snow_grid *grid, const packard *from, const packard *to)
{
    return snow_packard_is_sparse(grid) ? copy_blocks(grid, from, to) : copy_rows(grid, from, to);
}

/* The grid with a new engine, or another fold. */
static snow_status copy_model(snow_grid *grid, const packard_engine *engine, const packard_fold *fold, packard *copy)
{
    const packard *model = packard_of(grid);
    *copy = *model;
    copy->engine = engine;
    copy->fold = *fold;
    copy->zones_last = 0; /* it has none yet */
    snow_status status = engine->create(grid, fold, &copy->cells);
    if (status != SNOW_OK)
        return status;
    status = copy_cells(grid, model, copy);
    if (status != SNOW_OK)
        engine->destroy(grid, copy->cells);
    return status;
}

static void replace(snow_grid *grid, const packard *copy)
{
    packard *model = packard_of(grid);
    model->engine->destroy(grid, model->cells);
    *model = *copy;
}

snow_status snow_packard_convert(snow_grid *grid, const packard_engine *engine)
{
    packard copy;
    snow_status status = copy_model(grid, engine, &packard_of(grid)->fold, &copy);
    if (status == SNOW_OK)
        replace(grid, &copy);
    return status;
}

snow_status snow_packard_unfold(snow_grid *grid)
{
    packard *model = packard_of(grid);
    const packard_fold none = {.possible = false};
    if (!model->fold.possible || model->engine != &snow_packard_tiles) {
        model->fold = none;
        return SNOW_OK;
    }
    packard copy;
    snow_status status = copy_model(grid, model->engine, &none, &copy);
    if (status == SNOW_OK)
        replace(grid, &copy);
    return status;
}

static bool are_same_dates(const packard *a, const packard *b, const packard_region *block)
{
    for (int64_t r = block->r; r < block->r + block->height; r++)
        for (int64_t q = block->q; q < block->q + block->width; q++)
            if (a->engine->date(a->cells, q, r) != b->engine->date(b->cells, q, r))
                return false;
    return true;
}

/* Whether a folded copy shows what is there: then the crystal is symmetric. */
static bool are_same(const packard *a, const packard *b, row_block *rows, row_block *others)
{
    while (block_next(rows) && block_next(others)) {
        size_t words = packard_words((uint64_t)rows->block.width) * (size_t)rows->block.height;
        a->engine->copy(a->cells, &rows->block, rows->words);
        b->engine->copy(b->cells, &rows->block, others->words);
        if (memcmp(rows->words, others->words, words * sizeof *rows->words) != 0 ||
            (a->params.record_freeze_steps && !are_same_dates(a, b, &rows->block)))
            return false;
    }
    return true;
}

static snow_status fold_if_same(snow_grid *grid, const packard *copy, bool *folded)
{
    row_block rows, others = {.words = NULL};
    snow_status status = block_start(grid, &rows);
    if (status == SNOW_OK)
        status = block_start(grid, &others);
    *folded = status == SNOW_OK && are_same(packard_of(grid), copy, &rows, &others);
    snow_heap_put(&grid->heap, rows.words);
    snow_heap_put(&grid->heap, others.words);
    if (*folded)
        replace(grid, copy);
    return status;
}

snow_status snow_packard_settle(snow_grid *grid)
{
    const packard *model = packard_of(grid);
    snow_status status = snow_packard_count(grid);
    packard_fold fold = possible_fold(grid);
    if (status != SNOW_OK || model->engine != &snow_packard_tiles || !fold.possible)
        return status;
    packard copy;
    status = copy_model(grid, model->engine, &fold, &copy);
    if (status != SNOW_OK)
        return status;
    bool folded;
    status = fold_if_same(grid, &copy, &folded);
    if (!folded)
        copy.engine->destroy(grid, copy.cells);
    return status;
}
