#include "base/sort.h"
#include "packard/quadtree_nodes.h"

enum { SIDE = QUADTREE_LEAF_SIDE, HALF = SIDE / 2 };

/* Whose greatest value over the frozen cells is looked for. */
typedef enum direction { ALONG_Q = 1, ALONG_SUM = 2 } direction;

/* Patterns that might hold the greatest value, and by how many of their sides
   their middles fall short of the foremost one's. Kept sorted, each once. */
static uint64_t candidate(quadtree_ref ref, unsigned deficit)
{
    return (uint64_t)deficit << 32 | ref;
}

static int by_value(const void *a, const void *b)
{
    uint64_t x, y;
    memcpy(&x, a, sizeof x);
    memcpy(&y, b, sizeof y);
    return (x > y) - (x < y);
}

static bool has_front_room(snow_quadtree *tree, size_t count)
{
    if (count <= tree->front_room)
        return true;
    size_t room = 2 * count;
    uint64_t *front = snow_heap_get_raw(tree->heap, room, sizeof front[0]);
    if (front == NULL) {
        tree->failure = tree->heap->refusal;
        return false;
    }
    memcpy(front, tree->front, tree->front_room * sizeof front[0]);
    snow_heap_put(tree->heap, tree->front);
    tree->front = front;
    tree->front_room = room;
    return true;
}

/* Replaces the candidates of a level by those of their quadrants that are still
   in question. Tells the least deficit, which has been taken off. */
static bool descend(snow_quadtree *tree, int level, direction along, size_t *count, unsigned *least)
{
    static const uint8_t cost[3][4] = {[ALONG_Q] = {1, 0, 1, 0}, [ALONG_SUM] = {2, 1, 1, 0}};
    if (!has_front_room(tree, 5 * *count))
        return false;
    uint64_t *parts = tree->front + *count;
    size_t part_count = 0;
    *least = UINT32_MAX;
    for (size_t i = 0; i < *count; i++) {
        quadtree_ref child[4];
        quadtree_split(tree, (quadtree_ref)tree->front[i], child);
        unsigned deficit = 2 * (unsigned)(tree->front[i] >> 32);
        for (int j = 0; j < 4; j++) {
            if (child[j] == tree->empty[level - 1])
                continue;
            parts[part_count++] = candidate(child[j], deficit + cost[along][j]);
            *least = deficit + cost[along][j] < *least ? deficit + cost[along][j] : *least;
        }
    }
    snow_sort(parts, part_count, sizeof parts[0], by_value);
    *count = 0;
    for (size_t i = 0; i < part_count; i++) {
        unsigned deficit = (unsigned)(parts[i] >> 32) - *least;
        if (deficit < along && (i == 0 || parts[i] != parts[i - 1]))
            tree->front[(*count)++] = candidate((quadtree_ref)parts[i], deficit);
    }
    return true;
}

/* The greatest value of a leaf that is not empty, against its middle. */
static int leaf_greatest(const quadtree_leaf *leaf, direction along)
{
    int greatest = -2 * SIDE;
    for (int y = 0; y < SIDE; y++) {
        for (int x = 0; x < SIDE; x++) {
            int value = x - HALF + (along == ALONG_SUM ? y - HALF : 0);
            if ((leaf->row[y] >> x & 1) != 0 && value > greatest)
                greatest = value;
        }
    }
    return greatest;
}

/* The greatest q or q + r of the turned root's cells. */
static bool find_greatest(snow_quadtree *tree, unsigned turn, direction along, int64_t *greatest)
{
    tree->front[0] = candidate(quadtree_turned(tree->now.root, turn), 0);
    size_t count = 1;
    uint64_t foremost = 0; /* where that middle is; modulo 2^64, for it may be far out */
    for (int level = tree->now.level; level > QUADTREE_LEAF_LEVEL; level--) {
        unsigned least;
        if (!descend(tree, level, along, &count, &least))
            return false;
        foremost += ((uint64_t)along << (level - 2)) - ((uint64_t)least << (level - 1));
    }
    int best = -4 * SIDE;
    for (size_t i = 0; i < count; i++) {
        quadtree_leaf leaf = snow_quadtree_cells(tree, (quadtree_ref)tree->front[i]);
        int value = leaf_greatest(&leaf, along) - (SIDE - 1) * (int)(tree->front[i] >> 32);
        best = value > best ? value : best;
    }
    foremost += (uint64_t)(int64_t)best;
    *greatest = foremost <= INT64_MAX ? (int64_t)foremost : -(int64_t)(UINT64_MAX - foremost) - 1;
    return true;
}

bool snow_quadtree_find_bounds(snow_quadtree *tree, quadtree_measures *measures)
{
    static const struct {
        unsigned turn;
        direction along;
    } ways[3] = {{0, ALONG_Q}, {QUADTREE_SWAP, ALONG_Q}, {0, ALONG_SUM}};
    for (int i = 0; i < 3; i++) {
        int64_t opposite;
        if (!find_greatest(tree, ways[i].turn, ways[i].along, &measures->greatest[i]) ||
            !find_greatest(tree, ways[i].turn ^ QUADTREE_REFLECT, ways[i].along, &opposite))
            return false;
        measures->least[i] = -opposite;
    }
    return true;
}
