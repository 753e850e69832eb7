/* A saved crystal: the number of its nodes above the leaves; each node after its
   quadrants, as its level and then the 17 rows of cells of a lowest one, or the
   four quadrants; the root. A quadrant is the number of its node times four, plus its turn. */
#include "packard/quadtree_nodes.h"

/* --- saving --- */

/* Numbers the nodes below, where `result` was; those that have a number are marked. */
static void save_nodes(snow_quadtree *tree, int level, quadtree_ref ref, snow_sink *sink, uint32_t *count)
{
    uint32_t index = quadtree_index(ref);
    uint8_t *state = quadtree_state(tree, index);
    if (*state & QUADTREE_MARKED)
        return;
    quadtree_node *node = quadtree_at(tree, index);
    for (int i = 0; level > QUADTREE_BASE_LEVEL && i < 4; i++)
        save_nodes(tree, level - 1, node->child[i], sink, count);
    *state |= QUADTREE_MARKED;
    node->result = (*count)++;
    if (sink == NULL)
        return;
    snow_sink_u8(sink, (uint8_t)level);
    if (level == QUADTREE_BASE_LEVEL) {
        quadtree_base cells = snow_quadtree_base_cells(tree, index);
        for (int y = 0; y < QUADTREE_BASE_SIDE; y++)
            snow_sink_u32(sink, cells.row[y]);
        return;
    }
    for (int i = 0; i < 4; i++) {
        uint32_t number = quadtree_at(tree, quadtree_index(node->child[i]))->result;
        snow_sink_u32(sink, number << 2 | quadtree_turn_of(node->child[i]));
    }
}

static void forget_numbers(const snow_quadtree *tree)
{
    for (uint32_t index = 1; index < tree->next_fresh; index++) {
        uint8_t *state = quadtree_state(tree, index);
        if ((*state & QUADTREE_MARKED) == 0)
            continue;
        *state &= (uint8_t)~QUADTREE_MARKED;
        quadtree_at(tree, index)->result = QUADTREE_NONE;
    }
}

void snow_quadtree_save(snow_quadtree *tree, snow_sink *sink)
{
    const quadtree_crystal *now = &tree->now;
    uint32_t count = 0;
    pthread_mutex_lock(&tree->saving);
    save_nodes(tree, now->level, now->root, NULL, &count);
    forget_numbers(tree);
    snow_sink_u32(sink, count);
    uint32_t root = 0;
    save_nodes(tree, now->level, now->root, sink, &root);
    forget_numbers(tree);
    pthread_mutex_unlock(&tree->saving);
    snow_sink_u32(sink, (count - 1) << 2 | quadtree_turn_of(now->root));
}

/* --- loading --- */

/* The sides of a pattern, each in the direction of growing q or r. A turn takes
   side i to side i ^ turn, and a reflection reverses it. */
enum { TOP, LEFT, BOTTOM, RIGHT, SIDES };

/* A side as a pattern whose rows are all alike: so equal sides are equal references. */
typedef struct loaded_node {
    quadtree_ref ref;
    quadtree_ref side[SIDES];
} loaded_node;

typedef struct loading {
    snow_quadtree *tree;
    snow_source *source;
    loaded_node *nodes;
    uint32_t count; /* loaded so far */
} loading;

static int level_of(const loading *with, const loaded_node *node)
{
    return (*quadtree_state(with->tree, quadtree_index(node->ref)) & QUADTREE_HEIGHT) + QUADTREE_LEAF_LEVEL;
}

static bool join_side(snow_quadtree *tree, int level, quadtree_ref first, quadtree_ref second, quadtree_ref *side)
{
    *side = snow_quadtree_join(tree, level, (quadtree_ref[4]){first, second, first, second});
    return *side != QUADTREE_NONE;
}

static bool base_side(snow_quadtree *tree, uint32_t cells, quadtree_ref *side)
{
    quadtree_base alike;
    for (int y = 0; y < QUADTREE_BASE_SIDE; y++)
        alike.row[y] = cells;
    quadtree_leaf first = snow_quadtree_base_part(&alike, 0, 0);
    quadtree_leaf second = snow_quadtree_base_part(&alike, QUADTREE_LEAF_SIDE - 1, 0);
    quadtree_ref left = snow_quadtree_find_leaf(tree, &first);
    quadtree_ref right = left == QUADTREE_NONE ? left : snow_quadtree_find_leaf(tree, &second);
    return right != QUADTREE_NONE && join_side(tree, QUADTREE_BASE_LEVEL, left, right, side);
}

static snow_status load_base(loading *with, loaded_node *node)
{
    enum { LAST = QUADTREE_BASE_SIDE - 1 };
    quadtree_base cells;
    uint32_t left = 0, right = 0, beyond = 0;
    for (int y = 0; y < QUADTREE_BASE_SIDE; y++) {
        cells.row[y] = snow_source_u32(with->source);
        left |= (cells.row[y] & 1) << y;
        right |= (cells.row[y] >> LAST & 1) << y;
        beyond |= cells.row[y] >> LAST >> 1;
    }
    if (beyond != 0)
        return SNOW_ERROR_DAMAGED;
    quadtree_ref child[4];
    for (int i = 0; i < 4; i++) {
        quadtree_leaf leaf =
            snow_quadtree_base_part(&cells, i % 2 * (QUADTREE_LEAF_SIDE - 1), i / 2 * (QUADTREE_LEAF_SIDE - 1));
        child[i] = snow_quadtree_find_leaf(with->tree, &leaf);
        if (child[i] == QUADTREE_NONE)
            return with->tree->failure;
    }
    node->ref = snow_quadtree_join(with->tree, QUADTREE_BASE_LEVEL, child);
    bool made = node->ref != QUADTREE_NONE && base_side(with->tree, cells.row[0], &node->side[TOP]) &&
                base_side(with->tree, left, &node->side[LEFT]) &&
                base_side(with->tree, cells.row[LAST], &node->side[BOTTOM]) &&
                base_side(with->tree, right, &node->side[RIGHT]);
    return made ? SNOW_OK : with->tree->failure;
}

/* A node that was loaded before, turned. */
static snow_status load_turned(loading *with, int level, loaded_node *turned)
{
    uint32_t name = snow_source_u32(with->source);
    uint32_t number = name >> 2;
    unsigned turn = name & 3;
    if (number >= with->count || level_of(with, &with->nodes[number]) != level)
        return SNOW_ERROR_DAMAGED;
    const loaded_node *node = &with->nodes[number];
    turned->ref = quadtree_turned(node->ref, turn);
    for (unsigned i = 0; i < SIDES; i++)
        turned->side[i] = quadtree_turned(node->side[i ^ turn], turn & QUADTREE_REFLECT);
    return SNOW_OK;
}

static snow_status load_upper(loading *with, int level, loaded_node *node)
{
    loaded_node part[4];
    quadtree_ref child[4];
    for (int i = 0; i < 4; i++) {
        snow_status status = load_turned(with, level - 1, &part[i]);
        if (status != SNOW_OK)
            return status;
        child[i] = part[i].ref;
    }
    /* Neighbours must agree on the line that they share. */
    if (part[0].side[RIGHT] != part[1].side[LEFT] || part[2].side[RIGHT] != part[3].side[LEFT] ||
        part[0].side[BOTTOM] != part[2].side[TOP] || part[1].side[BOTTOM] != part[3].side[TOP])
        return SNOW_ERROR_DAMAGED;
    static const uint8_t ends[SIDES][2] = {[TOP] = {0, 1}, [LEFT] = {0, 2}, [BOTTOM] = {2, 3}, [RIGHT] = {1, 3}};
    node->ref = snow_quadtree_join(with->tree, level, child);
    bool made = node->ref != QUADTREE_NONE;
    for (int i = 0; made && i < SIDES; i++)
        made = join_side(with->tree, level, part[ends[i][0]].side[i], part[ends[i][1]].side[i], &node->side[i]);
    return made ? SNOW_OK : with->tree->failure;
}

static snow_status load_nodes(loading *with, uint32_t count)
{
    for (; with->count < count; with->count++) {
        int level = snow_source_u8(with->source);
        if (level < QUADTREE_BASE_LEVEL || level >= QUADTREE_TOP_LEVEL)
            return with->source->truncated ? SNOW_ERROR_TRUNCATED : SNOW_ERROR_DAMAGED;
        loaded_node *node = &with->nodes[with->count];
        snow_status status = level == QUADTREE_BASE_LEVEL ? load_base(with, node) : load_upper(with, level, node);
        if (with->source->truncated)
            return SNOW_ERROR_TRUNCATED;
        if (status != SNOW_OK)
            return status;
    }
    return SNOW_OK;
}

/* The root, whose rim is empty, becomes the crystal. */
static snow_status load_root(loading *with)
{
    snow_quadtree *tree = with->tree;
    loaded_node root;
    int level = level_of(with, &with->nodes[with->count - 1]);
    snow_status status = load_turned(with, level, &root);
    if (with->source->truncated)
        return SNOW_ERROR_TRUNCATED;
    if (status != SNOW_OK)
        return status;
    bool sound = true;
    for (int i = 0; i < SIDES; i++)
        sound = sound && root.side[i] == tree->empty[level];
    if (!sound)
        return SNOW_ERROR_DAMAGED;
    tree->now = (quadtree_crystal){.root = root.ref, .level = level};
    if (!snow_quadtree_find_measures(tree))
        return tree->failure;
    const quadtree_measures *measures = &tree->now.measures;
    for (int i = 0; i < 2; i++) {
        int64_t farthest = measures->greatest[i] > -measures->least[i] ? measures->greatest[i] : -measures->least[i];
        tree->now.reach = farthest > tree->now.reach ? farthest : tree->now.reach;
    }
    return tree->now.reach <= SNOW_QUADTREE_REACH ? SNOW_OK : SNOW_ERROR_DAMAGED;
}

snow_status snow_quadtree_load(snow_heap *heap, uint8_t rule, snow_source *source, snow_quadtree **tree)
{
    enum { LEAST_NODE_SIZE = 17 };
    uint32_t count = snow_source_u32(source);
    if (source->truncated || count > snow_source_left(source) / LEAST_NODE_SIZE)
        return SNOW_ERROR_TRUNCATED;
    if (count == 0)
        return SNOW_ERROR_DAMAGED;
    loading with = {.source = source};
    snow_status status = snow_quadtree_create(heap, rule, &with.tree);
    if (status != SNOW_OK)
        return status;
    with.nodes = snow_heap_get_raw(heap, count, sizeof with.nodes[0]);
    /* No node is part of a crystal yet, so a collection would lose them all. */
    with.tree->collections = QUADTREE_COLLECTIONS;
    status = with.nodes == NULL ? heap->refusal : load_nodes(&with, count);
    if (with.nodes != NULL && status == SNOW_OK)
        status = load_root(&with);
    snow_heap_put(heap, with.nodes);
    if (status != SNOW_OK) {
        snow_quadtree_destroy(with.tree);
        return status;
    }
    snow_quadtree_collect(with.tree);
    *tree = with.tree;
    return SNOW_OK;
}
