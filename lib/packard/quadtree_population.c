#include "packard/quadtree_nodes.h"

enum { SIDE = QUADTREE_LEAF_SIDE };

static int count_bits(uint32_t bits)
{
    int count = 0;
    for (; bits != 0; bits &= bits - 1)
        count++;
    return count;
}

/* Nodes share their rims. So a cell inside counts four quarters, one on a side
   two, one in a corner one, and the counts of quadrants add up. */
static quadtree_count leaf_quarters(const quadtree_leaf *leaf)
{
    const uint32_t inside = (1U << (SIDE - 1)) - 2;
    int quarters = 0;
    for (int y = 0; y < SIDE; y++) {
        int row = count_bits(leaf->row[y]) + count_bits(leaf->row[y] & inside);
        quarters += y == 0 || y == SIDE - 1 ? row : 2 * row;
    }
    return (quadtree_count){0, (uint64_t)quarters};
}

/* What the count of a node takes, as a place of the pool that its `result` leads
   to while a count is under way. The node is marked meanwhile. */
typedef struct record {
    uint32_t high[2], low[2];
    quadtree_ref result; /* the node's own */
} record;

_Static_assert(sizeof(record) == sizeof(quadtree_node), "a record takes the place of a node");

static bool count_quarters(snow_quadtree *tree, int level, quadtree_ref ref, quadtree_count *count)
{
    uint32_t index = quadtree_index(ref);
    quadtree_node *node = quadtree_at(tree, index);
    if (level == QUADTREE_LEAF_LEVEL) {
        *count = leaf_quarters(&node->leaf);
        return true;
    }
    uint8_t *state = quadtree_state(tree, index);
    record kept;
    if (*state & QUADTREE_MARKED) {
        memcpy(&kept, quadtree_at(tree, node->result), sizeof kept);
    } else {
        quadtree_count sum = {0, 0};
        for (int i = 0; i < 4; i++) {
            quadtree_count part;
            if (!count_quarters(tree, level - 1, node->child[i], &part))
                return false;
            sum = quadtree_sum(sum, part);
        }
        uint32_t taken = snow_quadtree_take(tree);
        if (taken == 0)
            return false;
        memcpy(kept.high, &sum.high, sizeof kept.high);
        memcpy(kept.low, &sum.low, sizeof kept.low);
        kept.result = node->result;
        memcpy(quadtree_at(tree, taken), &kept, sizeof kept);
        node->result = taken;
        *state |= QUADTREE_MARKED;
    }
    memcpy(&count->high, kept.high, sizeof kept.high);
    memcpy(&count->low, kept.low, sizeof kept.low);
    return true;
}

static void forget_records(snow_quadtree *tree)
{
    for (uint32_t index = 1; index < tree->next_fresh; index++) {
        uint8_t *state = quadtree_state(tree, index);
        if ((*state & QUADTREE_MARKED) == 0)
            continue;
        quadtree_node *node = quadtree_at(tree, index);
        uint32_t taken = node->result;
        record kept;
        memcpy(&kept, quadtree_at(tree, taken), sizeof kept);
        node->result = kept.result;
        *state &= (uint8_t)~QUADTREE_MARKED;
        snow_quadtree_give(tree, taken);
    }
}

bool snow_quadtree_find_population(snow_quadtree *tree, quadtree_measures *measures)
{
    quadtree_count quarters;
    bool counted = count_quarters(tree, tree->now.level, tree->now.root, &quarters);
    forget_records(tree);
    if (!counted) {
        snow_quadtree_collect(tree);
        counted = count_quarters(tree, tree->now.level, tree->now.root, &quarters);
        forget_records(tree);
    }
    if (counted)
        measures->population = (quadtree_count){quarters.high >> 2, quarters.high << 62 | quarters.low >> 2};
    return counted;
}
