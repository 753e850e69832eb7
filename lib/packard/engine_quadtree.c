/* The quadtree as the model sees it. It knows no zones: steps in which they
   apply are not given to it. */
#include "packard/model.h"
#include "packard/quadtree.h"

static void destroy(snow_grid *grid, void *cells)
{
    (void)grid;
    snow_quadtree_destroy(cells);
}

static uint8_t rule_of(const snow_grid *grid)
{
    return (uint8_t)packard_of(grid)->params.rule;
}

static snow_status create(snow_grid *grid, const packard_fold *fold, void **result)
{
    (void)fold; /* it finds out what is alike by itself */
    snow_quadtree *tree;
    snow_status status = snow_quadtree_create(&grid->heap, rule_of(grid), &tree);
    if (status == SNOW_OK)
        *result = tree;
    return status;
}

static snow_status put(void *cells, const packard_region *region, const uint64_t *words)
{
    return snow_quadtree_put(cells, region->q, region->r, region->width, region->height, words,
                             packard_words((uint64_t)region->width));
}

static void copy(const void *cells, const packard_region *region, uint64_t *words)
{
    snow_quadtree_copy(cells, region->q, region->r, region->width, region->height, words,
                       packard_words((uint64_t)region->width));
}

static bool next(const void *cells, int64_t *q, int64_t *r)
{
    return snow_quadtree_next(cells, q, r);
}

static snow_status advance(void *cells, int64_t steps, int64_t *taken)
{
    snow_status status = snow_quadtree_advance(cells, (uint64_t)steps);
    *taken = status == SNOW_OK ? steps : 0;
    return status;
}

static double as_double(quadtree_count number)
{
    return (double)number.high * 0x1p64 + (double)number.low;
}

static snow_status count(void *cells, snow_census *census)
{
    quadtree_measures measures;
    snow_status status = snow_quadtree_measure(cells, &measures);
    if (status != SNOW_OK)
        return status;
    census->frozen = measures.population.low;
    census->frozen_high = measures.population.high;
    bool empty = measures.population.low == 0 && measures.population.high == 0;
    census->tip_square = empty ? -1 : as_double(measures.tip_square);
    census->hexagon = empty ? snow_hexagon_empty()
                            : (snow_hexagon){measures.least[0], measures.greatest[0], measures.least[1],
                                             measures.greatest[1], measures.least[2], measures.greatest[2]};
    return SNOW_OK;
}

static bool is_still(void *cells)
{
    return snow_quadtree_is_still(cells);
}

static void keep(void *cells)
{
    snow_quadtree_keep(cells);
}

static void restore(void *cells)
{
    snow_quadtree_restore(cells);
}

uint64_t snow_packard_tree_work(const void *cells)
{
    return snow_quadtree_work(cells);
}

void snow_packard_tree_save(void *cells, snow_sink *sink)
{
    snow_quadtree_save(cells, sink);
}

snow_status snow_packard_tree_load(snow_grid *grid, snow_source *source, void **result)
{
    snow_quadtree *tree;
    snow_status status = snow_quadtree_load(&grid->heap, rule_of(grid), source, &tree);
    if (status == SNOW_OK)
        *result = tree;
    return status;
}

const packard_engine snow_packard_quadtree = {
    .name = SNOW_PACKARD_ENGINE_QUADTREE,
    .create = create,
    .destroy = destroy,
    .melts = true,
    .put = put,
    .copy = copy,
    .next = next,
    .advance = advance,
    .count = count,
    .is_still = is_still,
    .keep = keep,
    .restore = restore,
};
