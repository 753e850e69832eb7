/* The quadtree as the model sees it. It knows no zones: steps in which they
   apply are not given to it. */
#include "packard/model.h"
#include "packard/quadtree.h"

/* The root stands about the middle of the crystal: the symmetries that it may have are about there, and then its
   quarters are alike. */
typedef struct tree_cells {
    snow_quadtree *tree;
    int64_t q, r; /* where the tree's origin lies */
} tree_cells;

static void destroy(snow_grid *grid, void *engine)
{
    tree_cells *cells = engine;
    snow_quadtree_destroy(cells->tree);
    snow_heap_put(&grid->heap, cells);
}

static uint8_t rule_of(const snow_grid *grid)
{
    return (uint8_t)packard_of(grid)->params.rule;
}

/* Takes over the tree, if it could be made. */
static snow_status wrap(snow_grid *grid, snow_status status, snow_quadtree *tree, int64_t q, int64_t r, void **result)
{
    if (status != SNOW_OK)
        return status;
    tree_cells *cells = snow_heap_get(&grid->heap, 1, sizeof *cells);
    if (cells == NULL) {
        snow_quadtree_destroy(tree);
        return grid->heap.refusal;
    }
    *cells = (tree_cells){tree, q, r};
    snow_quadtree_set_centre(tree, -q, -r);
    *result = cells;
    return SNOW_OK;
}

static snow_status create(snow_grid *grid, const packard_fold *fold, void **result)
{
    (void)fold; /* it finds out what is alike by itself */
    packard_region bounds = snow_packard_bounds(grid);
    snow_quadtree *tree = NULL;
    snow_status status = snow_quadtree_create(&grid->heap, rule_of(grid), &tree);
    return wrap(grid, status, tree, bounds.q + bounds.width / 2, bounds.r + bounds.height / 2, result);
}

static snow_status put(void *engine, const packard_region *region, const uint64_t *words)
{
    const tree_cells *cells = engine;
    return snow_quadtree_put(cells->tree, region->q - cells->q, region->r - cells->r, region->width, region->height,
                             words, packard_words((uint64_t)region->width));
}

static void copy(const void *engine, const packard_region *region, uint64_t *words)
{
    const tree_cells *cells = engine;
    snow_quadtree_copy(cells->tree, region->q - cells->q, region->r - cells->r, region->width, region->height, words,
                       packard_words((uint64_t)region->width));
}

static bool next(const void *engine, int64_t *q, int64_t *r)
{
    const tree_cells *cells = engine;
    int64_t tree_q = *q - cells->q;
    int64_t tree_r = *r - cells->r;
    bool found = snow_quadtree_next(cells->tree, &tree_q, &tree_r);
    *q = tree_q + (found ? cells->q : 0);
    *r = tree_r + (found ? cells->r : 0);
    return found;
}

static snow_status advance(void *engine, int64_t steps, int64_t *taken)
{
    const tree_cells *cells = engine;
    snow_status status = snow_quadtree_advance(cells->tree, (uint64_t)steps);
    *taken = status == SNOW_OK ? steps : 0;
    return status;
}

static double as_double(quadtree_count number)
{
    return (double)number.high * 0x1p64 + (double)number.low;
}

static snow_status count(void *engine, snow_census *census)
{
    const tree_cells *cells = engine;
    quadtree_measures measures;
    snow_status status = snow_quadtree_measure(cells->tree, &measures);
    if (status != SNOW_OK)
        return status;
    census->frozen = measures.population.low;
    census->frozen_high = measures.population.high;
    bool empty = measures.population.low == 0 && measures.population.high == 0;
    census->tip_square = empty ? -1 : as_double(measures.tip_square);
    int64_t sum = cells->q + cells->r;
    census->hexagon = empty ? snow_hexagon_empty()
                            : (snow_hexagon){measures.least[0] + cells->q, measures.greatest[0] + cells->q,
                                             measures.least[1] + cells->r, measures.greatest[1] + cells->r,
                                             measures.least[2] + sum,      measures.greatest[2] + sum};
    return SNOW_OK;
}

static bool is_still(void *engine)
{
    return snow_quadtree_is_still(((tree_cells *)engine)->tree);
}

static void keep(void *engine)
{
    snow_quadtree_keep(((tree_cells *)engine)->tree);
}

static void restore(void *engine)
{
    snow_quadtree_restore(((tree_cells *)engine)->tree);
}

uint64_t snow_packard_tree_work(const void *engine)
{
    return snow_quadtree_work(((const tree_cells *)engine)->tree);
}

bool snow_packard_tree_is_shifted(const void *engine)
{
    const tree_cells *cells = engine;
    return cells->q != 0 || cells->r != 0;
}

void snow_packard_tree_save(const void *engine, snow_sink *sink)
{
    const tree_cells *cells = engine;
    if (snow_packard_tree_is_shifted(cells)) {
        snow_sink_u64(sink, (uint64_t)cells->q);
        snow_sink_u64(sink, (uint64_t)cells->r);
    }
    snow_quadtree_save(cells->tree, sink);
}

snow_status snow_packard_tree_load(snow_grid *grid, snow_source *source, bool shifted, void **result)
{
    /* The middle of a crystal in 32 bits, and what its growth can have made of that. */
    const int64_t limit = INT64_C(1) << 36;
    int64_t q = shifted ? (int64_t)snow_source_u64(source) : 0;
    int64_t r = shifted ? (int64_t)snow_source_u64(source) : 0;
    if (q < -limit || q > limit || r < -limit || r > limit)
        return SNOW_ERROR_DAMAGED;
    snow_quadtree *tree = NULL;
    snow_status status = snow_quadtree_load(&grid->heap, rule_of(grid), source, &tree);
    return wrap(grid, status, tree, q, r, result);
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
