#include "packard/quadtree_nodes.h"

enum { FIRST_SLOTS = 256, FRONT_ROOM = 512 };

/* A rectangle of cells, and where its bits are. */
typedef struct region {
    int64_t first_q, last_q, first_r, last_r;
    size_t stride;
} region;

/* No cell of the run is within half a side of the middle. Free of overflow: the
   run is within the reach, the node within 2^63 and not the root. */
static bool is_apart(int64_t first, int64_t last, int64_t middle, int64_t half)
{
    return first - 1 > middle + (half - 1) || last + 1 < middle - (half - 1);
}

static bool misses(const region *of, quadtree_place middle, int level)
{
    int64_t half = quadtree_half_side(level);
    return is_apart(of->first_q, of->last_q, middle.q, half) || is_apart(of->first_r, of->last_r, middle.r, half);
}

static bool allocate_table(snow_quadtree *tree, quadtree_table *table)
{
    table->slots = snow_heap_get(tree->heap, FIRST_SLOTS, sizeof table->slots[0]);
    table->size = FIRST_SLOTS;
    return table->slots != NULL;
}

static bool make_empty(snow_quadtree *tree)
{
    quadtree_leaf leaf = {{0}};
    quadtree_ref empty = snow_quadtree_find_leaf(tree, &leaf);
    for (int level = QUADTREE_LEAF_LEVEL; empty != QUADTREE_NONE; level++) {
        tree->empty[level] = empty;
        if (level == QUADTREE_TOP_LEVEL)
            return true;
        empty = snow_quadtree_join(tree, level + 1, (quadtree_ref[4]){empty, empty, empty, empty});
    }
    return false;
}

snow_status snow_quadtree_create(snow_heap *heap, uint8_t rule, snow_quadtree **tree)
{
    snow_quadtree *made = snow_heap_get(heap, 1, sizeof *made);
    if (made == NULL)
        return heap->refusal;
    if (pthread_mutex_init(&made->saving, NULL) != 0) {
        snow_heap_put(heap, made);
        return SNOW_ERROR_NO_MEMORY;
    }
    made->heap = heap;
    made->next_fresh = 1;
    for (int k = 0; k < 7; k++)
        made->rule_masks[k] = rule >> k & 1 ? UINT32_MAX : 0;
    /* Enough for most crystals, so that bounds can be found when the nodes have taken all other memory. */
    made->front = snow_heap_get_raw(heap, FRONT_ROOM, sizeof made->front[0]);
    made->front_room = FRONT_ROOM;
    if (made->front == NULL || !allocate_table(made, &made->leaves) || !allocate_table(made, &made->nodes) ||
        !make_empty(made)) {
        snow_status refusal = heap->refusal;
        snow_quadtree_destroy(made);
        return refusal;
    }
    made->now = (quadtree_crystal){made->empty[QUADTREE_LEAST_ROOT], QUADTREE_LEAST_ROOT, .measured = true};
    made->kept = made->now;
    *tree = made;
    return SNOW_OK;
}

void snow_quadtree_destroy(snow_quadtree *tree)
{
    if (tree == NULL)
        return;
    snow_heap *heap = tree->heap;
    for (uint32_t i = 0; i < tree->chunk_count; i++)
        snow_heap_put(heap, tree->chunks[i]);
    snow_heap_put(heap, tree->chunks);
    snow_heap_put(heap, tree->leaves.slots);
    snow_heap_put(heap, tree->nodes.slots);
    snow_heap_put(heap, tree->front);
    pthread_mutex_destroy(&tree->saving);
    snow_heap_put(heap, tree);
}

/* The root with empty space round it. */
static bool pad(snow_quadtree *tree)
{
    quadtree_crystal *now = &tree->now;
    size_t held = tree->live_count;
    quadtree_ref empty = tree->empty[now->level - 1];
    quadtree_ref child[4];
    quadtree_split(tree, now->root, child);
    for (int i = 0; i < 4; i++) {
        quadtree_ref padded[4] = {empty, empty, empty, empty};
        padded[3 - i] = child[i];
        child[i] = snow_quadtree_join(tree, now->level, padded);
        if (child[i] == QUADTREE_NONE)
            break;
        quadtree_hold(tree, now->level, child[i]);
    }
    bool complete = tree->live_count == held + 4;
    quadtree_ref root = complete ? snow_quadtree_join(tree, now->level + 1, child) : QUADTREE_NONE;
    tree->live_count = held;
    if (root == QUADTREE_NONE)
        return false;
    now->root = root;
    now->level++;
    return true;
}

bool snow_quadtree_grow(snow_quadtree *tree, int level)
{
    while (tree->now.level < level) {
        if (!pad(tree))
            return false;
    }
    return true;
}

void snow_quadtree_keep(snow_quadtree *tree)
{
    tree->kept = tree->now;
}

void snow_quadtree_restore(snow_quadtree *tree)
{
    tree->now = tree->kept;
}

/* Which of the nine lines round a leaf's middle a run of lines has, at least one; bit b: line b. */
static uint32_t common_lines(int64_t first, int64_t last, int64_t middle)
{
    int64_t from = middle - quadtree_half_side(QUADTREE_LEAF_LEVEL);
    int64_t end = last - from < QUADTREE_LEAF_SIDE ? last - from + 1 : QUADTREE_LEAF_SIDE;
    int64_t begin = first > from ? first - from : 0;
    return (UINT32_C(1) << end) - (UINT32_C(1) << begin);
}

/* What a leaf and a region have in common, not empty. */
typedef struct overlap {
    uint32_t columns, rows; /* of the leaf */
    int first_column;
    uint64_t bit;           /* where that column is in the region's rows */
    int64_t row;            /* where the leaf's row 0 is in the region; may be negative */
} overlap;

static overlap overlap_of(const region *of, quadtree_place middle)
{
    int64_t half = quadtree_half_side(QUADTREE_LEAF_LEVEL);
    overlap common = {
        .columns = common_lines(of->first_q, of->last_q, middle.q),
        .rows = common_lines(of->first_r, of->last_r, middle.r),
        .row = middle.r - half - of->first_r,
    };
    common.first_column = __builtin_ctz(common.columns);
    common.bit = (uint64_t)(middle.q - half + common.first_column - of->first_q);
    return common;
}

static quadtree_leaf read_leaf(quadtree_leaf leaf, const region *from, const uint64_t *bits, quadtree_place middle)
{
    overlap common = overlap_of(from, middle);
    unsigned shift = common.bit % 64;
    bool divided = shift > 64 - QUADTREE_LEAF_SIDE && common.columns >> common.first_column >> (64 - shift) != 0;
    for (int y = 0; y < QUADTREE_LEAF_SIDE; y++) {
        if ((common.rows >> y & 1) == 0)
            continue;
        const uint64_t *word = bits + (size_t)(common.row + y) * from->stride + common.bit / 64;
        uint64_t cells = word[0] >> shift | (divided ? word[1] << (64 - shift) : 0);
        cells = cells << common.first_column & common.columns;
        leaf.row[y] = (uint16_t)((leaf.row[y] & ~common.columns) | cells);
    }
    return leaf;
}

static void write_cells(uint32_t row, const overlap *common, uint64_t *word)
{
    unsigned shift = common->bit % 64;
    uint64_t cells = (row & common->columns) >> common->first_column;
    word[0] |= cells << shift;
    if (shift > 64 - QUADTREE_LEAF_SIDE && cells >> (64 - shift) != 0)
        word[1] |= cells >> (64 - shift);
}

static void write_leaf(const snow_quadtree *tree, quadtree_ref ref, const region *to, uint64_t *bits,
                       quadtree_place middle)
{
    const overlap common = overlap_of(to, middle);
    const quadtree_leaf *leaf = &quadtree_at(tree, quadtree_index(ref))->leaf;
    for (int y = 0; y < QUADTREE_LEAF_SIDE; y++) {
        if ((common.rows >> y & 1) == 0)
            continue;
        write_cells(snow_quadtree_leaf_row(leaf, quadtree_turn_of(ref), y), &common,
                    bits + (size_t)(common.row + y) * to->stride + common.bit / 64);
    }
}

/* The pattern with the region's cells in it. */
static quadtree_ref put_region(snow_quadtree *tree, int level, quadtree_ref ref, quadtree_place middle,
                               const region *from, const uint64_t *bits)
{
    if (level == QUADTREE_LEAF_LEVEL) {
        quadtree_leaf leaf = read_leaf(snow_quadtree_cells(tree, ref), from, bits, middle);
        return snow_quadtree_find_leaf(tree, &leaf);
    }
    size_t held = tree->live_count;
    quadtree_hold(tree, level, ref);
    quadtree_ref child[4];
    quadtree_split(tree, ref, child);
    for (int i = 0; i < 4; i++) {
        quadtree_place at = quadtree_child_place(middle, level, i);
        if (misses(from, at, level - 1))
            continue;
        child[i] = put_region(tree, level - 1, child[i], at, from, bits);
        if (child[i] == QUADTREE_NONE)
            break;
        quadtree_hold(tree, level - 1, child[i]);
    }
    bool failed = false;
    for (int i = 0; i < 4; i++)
        failed = failed || child[i] == QUADTREE_NONE;
    ref = failed ? QUADTREE_NONE : snow_quadtree_join(tree, level, child);
    tree->live_count = held;
    return ref;
}

snow_status snow_quadtree_put(snow_quadtree *tree, int64_t q, int64_t r, int64_t width, int64_t height,
                              const uint64_t *bits, size_t stride)
{
    if (width == 0 || height == 0)
        return SNOW_OK;
    region from = {q, q + width - 1, r, r + height - 1, stride};
    if (from.first_q < -SNOW_QUADTREE_REACH || from.last_q > SNOW_QUADTREE_REACH ||
        from.first_r < -SNOW_QUADTREE_REACH || from.last_r > SNOW_QUADTREE_REACH)
        return SNOW_ERROR_TOO_LARGE;
    quadtree_crystal *now = &tree->now;
    tree->collections = 0;
    int64_t reach = now->reach;
    const int64_t ends[4] = {-from.first_q, from.last_q, -from.first_r, from.last_r};
    for (int i = 0; i < 4; i++)
        reach = ends[i] > reach ? ends[i] : reach;
    int level = QUADTREE_LEAST_ROOT;
    while (reach >> (level - 1) != 0)
        level++;
    if (!snow_quadtree_grow(tree, level))
        return tree->failure;
    quadtree_ref root = put_region(tree, now->level, now->root, (quadtree_place){0, 0}, &from, bits);
    if (root == QUADTREE_NONE)
        return tree->failure;
    now->measured = now->measured && root == now->root;
    now->root = root;
    now->reach = reach;
    return SNOW_OK;
}

static void copy_region(const snow_quadtree *tree, int level, quadtree_ref ref, quadtree_place middle, const region *to,
                        uint64_t *bits)
{
    if (ref == tree->empty[level])
        return;
    if (level == QUADTREE_LEAF_LEVEL) {
        write_leaf(tree, ref, to, bits, middle);
        return;
    }
    quadtree_ref child[4];
    quadtree_split(tree, ref, child);
    for (int i = 0; i < 4; i++) {
        quadtree_place at = quadtree_child_place(middle, level, i);
        if (!misses(to, at, level - 1))
            copy_region(tree, level - 1, child[i], at, to, bits);
    }
}

void snow_quadtree_copy(const snow_quadtree *tree, int64_t q, int64_t r, int64_t width, int64_t height,
                        uint64_t *bits, size_t stride)
{
    for (int64_t y = 0; y < height; y++)
        memset(bits + (size_t)y * stride, 0, (size_t)((width + 63) / 64) * sizeof bits[0]);
    region to = {q, q + width - 1, r, r + height - 1, stride};
    if (width > 0 && height > 0)
        copy_region(tree, tree->now.level, tree->now.root, (quadtree_place){0, 0}, &to, bits);
}

bool snow_quadtree_find_measures(snow_quadtree *tree)
{
    quadtree_measures measures = {0};
    if (tree->now.root != tree->empty[tree->now.level] &&
        (!snow_quadtree_find_population(tree, &measures) || !snow_quadtree_find_bounds(tree, &measures)))
        return false;
    snow_quadtree_find_tip(tree, &measures);
    tree->now.measures = measures;
    tree->now.measured = true;
    return true;
}

void snow_quadtree_set_centre(snow_quadtree *tree, int64_t q, int64_t r)
{
    if (q == tree->centre.q && r == tree->centre.r)
        return;
    tree->centre = (quadtree_place){q, r};
    tree->now.measured = tree->kept.measured = false;
}

snow_status snow_quadtree_measure(snow_quadtree *tree, quadtree_measures *measures)
{
    if (!tree->now.measured && !snow_quadtree_find_measures(tree))
        return tree->failure;
    *measures = tree->now.measures;
    return SNOW_OK;
}

uint64_t snow_quadtree_work(const snow_quadtree *tree)
{
    return tree->work;
}

bool snow_quadtree_get(const snow_quadtree *tree, int64_t q, int64_t r)
{
    int64_t reach = tree->now.reach;
    if (q < -reach || q > reach || r < -reach || r > reach)
        return false;
    quadtree_ref ref = tree->now.root;
    quadtree_place middle = {0, 0};
    for (int level = tree->now.level; level > QUADTREE_LEAF_LEVEL; level--) {
        quadtree_ref child[4];
        quadtree_split(tree, ref, child);
        int i = (q > middle.q) + 2 * (r > middle.r);
        ref = child[i];
        middle = quadtree_child_place(middle, level, i);
    }
    quadtree_leaf leaf = snow_quadtree_cells(tree, ref);
    int64_t half = quadtree_half_side(QUADTREE_LEAF_LEVEL);
    return leaf.row[r - middle.r + half] >> (q - middle.q + half) & 1;
}
