/* The queries that only this model has. */
#include "packard/model.h"

#include <string.h>

snow_status snow_packard_rule_of(const snow_grid *grid, uint32_t *rule)
{
    snow_status status = packard_check(grid);
    if (status != SNOW_OK)
        return status;
    if (rule == NULL)
        return SNOW_ERROR_NULL;
    *rule = packard_of(grid)->params.rule;
    return SNOW_OK;
}

snow_status snow_packard_engine_of(const snow_grid *grid, snow_packard_engine *engine)
{
    snow_status status = packard_check(grid);
    if (status != SNOW_OK)
        return status;
    if (engine == NULL)
        return SNOW_ERROR_NULL;
    *engine = packard_of(grid)->engine->name;
    return SNOW_OK;
}

snow_status snow_packard_population(const snow_grid *grid, uint64_t *high, uint64_t *low)
{
    snow_status status = packard_check(grid);
    if (status != SNOW_OK)
        return status;
    if (high == NULL || low == NULL)
        return SNOW_ERROR_NULL;
    *high = grid->census.frozen_high;
    *low = grid->census.frozen;
    return SNOW_OK;
}

static bool is_sound(int64_t first, int64_t count)
{
    const int64_t limit = INT64_C(1) << 62;
    return first >= -limit && count >= 0 && count <= limit && first <= limit - count;
}

static bool meet(const packard_region *a, const packard_region *b)
{
    return a->q < b->q + b->width && b->q < a->q + a->width && a->r < b->r + b->height && b->r < a->r + a->height;
}

/* What an engine says of cells beyond the edges of a torus does not count. */
static void clip(const snow_grid *grid, const packard_region *region, uint64_t *words)
{
    size_t stride = packard_words((uint64_t)region->width);
    for (int64_t y = 0; y < region->height; y++)
        for (int64_t x = 0; x < region->width; x++)
            if (!packard_has_cell(grid, region->q + x, region->r + y))
                words[(size_t)y * stride + (size_t)x / PACKARD_WORD] &= ~(UINT64_C(1) << (x % PACKARD_WORD));
}

snow_status snow_packard_copy_bits(const snow_grid *grid, int64_t q, int64_t r, int64_t width, int64_t height,
                                   uint64_t *words, size_t capacity)
{
    snow_status status = packard_check(grid);
    if (status != SNOW_OK)
        return status;
    if (words == NULL)
        return SNOW_ERROR_NULL;
    if (!is_sound(q, width) || !is_sound(r, height))
        return SNOW_ERROR_RECTANGLE;
    if (width == 0 || height == 0)
        return SNOW_OK;
    /* Rows can be longer than any array of this machine. */
    uint64_t stride = ((uint64_t)width + PACKARD_WORD - 1) / PACKARD_WORD;
    if ((uint64_t)height > capacity / stride || (uint64_t)width > SIZE_MAX)
        return SNOW_ERROR_BUFFER;
    const packard *model = packard_of(grid);
    const packard_region region = {q, r, width, height};
    const packard_region bounds = snow_packard_bounds(grid);
    if (!meet(&region, &bounds)) { /* not every engine can look as far */
        memset(words, 0, (size_t)height * (size_t)stride * sizeof *words);
        return SNOW_OK;
    }
    model->engine->copy(model->cells, &region, words);
    if (!packard_is_plane(model))
        clip(grid, &region, words);
    return SNOW_OK;
}
