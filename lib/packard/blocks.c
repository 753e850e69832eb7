/* The frozen cells block by block, so that nobody looks through the space between crystals that stand far apart. */
#include "packard/model.h"

/* To the right of all cells. */
static const int64_t far_right = INT64_C(1) << 62;

bool snow_packard_is_sparse(const snow_grid *grid)
{
    const double bearable = 0x1p26;
    const double bearable_for_frozen = 0x1p10;
    packard_region bounds = snow_packard_bounds(grid);
    double frozen = (double)snow_census_frozen(&grid->census);
    return (double)bounds.width * (double)bounds.height > bearable + bearable_for_frozen * frozen;
}

/* What two runs of cells have in common. */
static void cut(int64_t *first, int64_t *count, int64_t other_first, int64_t other_count)
{
    int64_t end = *first + *count < other_first + other_count ? *first + *count : other_first + other_count;
    *first = *first > other_first ? *first : other_first;
    *count = end > *first ? end - *first : 0;
}

/* The same for an engine that cannot tell: blocks are counted from the corner of the bounds. */
static bool any_next(const packard_region *bounds, int64_t *q, int64_t *r)
{
    int64_t columns = *q > bounds->q ? (*q - bounds->q) / PACKARD_BLOCK : 0;
    int64_t rows = *r > bounds->r ? (*r - bounds->r) / PACKARD_BLOCK : 0;
    if (columns * PACKARD_BLOCK >= bounds->width) {
        columns = 0;
        rows++;
    }
    *q = bounds->q + columns * PACKARD_BLOCK;
    *r = bounds->r + rows * PACKARD_BLOCK;
    return rows * PACKARD_BLOCK < bounds->height;
}

bool snow_packard_block_from(const snow_grid *grid, int64_t q, int64_t r, packard_region *block)
{
    const packard *model = packard_of(grid);
    const packard_region bounds = snow_packard_bounds(grid);
    bool knows = model->engine->next != NULL && !model->fold.possible;
    while (r < bounds.r + bounds.height) {
        q = q < bounds.q + bounds.width ? q : far_right;
        if (!(knows ? model->engine->next(model->cells, &q, &r) : any_next(&bounds, &q, &r)))
            return false;
        *block = (packard_region){q, r, PACKARD_BLOCK, PACKARD_BLOCK};
        cut(&block->q, &block->width, bounds.q, bounds.width);
        cut(&block->r, &block->height, bounds.r, bounds.height);
        if (block->width > 0 && block->height > 0)
            return true;
        q += PACKARD_BLOCK;
    }
    return false;
}

bool snow_packard_first_block(const snow_grid *grid, packard_region *block)
{
    const packard_region bounds = snow_packard_bounds(grid);
    return snow_packard_block_from(grid, bounds.q, bounds.r, block);
}

bool snow_packard_next_block(const snow_grid *grid, packard_region *block)
{
    return snow_packard_block_from(grid, block->q + block->width, block->r, block);
}

bool snow_packard_next_in_row(const snow_grid *grid, int64_t q, int64_t r, int64_t most, packard_region *part)
{
    const packard_region bounds = snow_packard_bounds(grid);
    packard_region block;
    q = q > bounds.q ? q : bounds.q;
    if (!snow_packard_block_from(grid, q, r, &block) || block.r > r)
        return false;
    *part = (packard_region){q > block.q ? q : block.q, r, most, 1};
    cut(&part->q, &part->width, bounds.q, bounds.width);
    return part->width > 0;
}

/* A crystal that is not sparse is one part: long rows are read faster. */
bool snow_packard_next_frozen(const snow_grid *grid, snow_rect *part)
{
    packard_region block = {part->q, part->r, part->width, part->height};
    bool first = part->width == 0;
    bool more;
    if (snow_packard_is_sparse(grid)) {
        more = first ? snow_packard_first_block(grid, &block) : snow_packard_next_block(grid, &block);
    } else {
        block = snow_packard_bounds(grid);
        more = first && block.width > 0;
    }
    *part = (snow_rect){(int32_t)block.q, (int32_t)block.r, (int32_t)block.width, (int32_t)block.height};
    return more;
}
