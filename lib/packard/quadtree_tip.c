#include "packard/quadtree_nodes.h"

static uint64_t magnitude(int64_t x)
{
    return x < 0 ? -(uint64_t)x : (uint64_t)x;
}

static quadtree_count square(uint64_t x)
{
    uint64_t upper = x >> 32, lower = x & UINT32_MAX, cross = upper * lower;
    return quadtree_sum((quadtree_count){cross >> 31, cross << 33},
                        (quadtree_count){upper * upper, lower * lower});
}

/* q² + qr + r², as seen from the centre, exactly: half the sum of the squares of q, r and q + r. */
static quadtree_count distance_square(const snow_quadtree *tree, int64_t q, int64_t r)
{
    q -= tree->centre.q;
    r -= tree->centre.r;
    uint64_t a = magnitude(q), b = magnitude(r);
    uint64_t sum = (q < 0) == (r < 0) ? a + b : a > b ? a - b : b - a;
    quadtree_count twice = quadtree_sum(quadtree_sum(square(a), square(b)), square(sum));
    return (quadtree_count){twice.high >> 1, twice.high << 63 | twice.low >> 1};
}

static bool is_greater(quadtree_count a, quadtree_count b)
{
    return a.high > b.high || (a.high == b.high && a.low > b.low);
}

/* The ends of a node's lines, or those of the frozen cells where these come first. */
static void line_ends(int64_t middle, int level, int64_t least, int64_t greatest, int64_t ends[2])
{
    /* One cell short of the rim and one on again: 2^63 has no place in the type. */
    int64_t half = quadtree_half_side(level) - 1;
    ends[0] = (middle - half > least + 1 ? middle - half : least + 1) - 1;
    ends[1] = (middle + half < greatest - 1 ? middle + half : greatest - 1) + 1;
}

/* No cell of the node is farther out than this: the distance of a corner, for on each line it falls and then grows. */
static quadtree_count farthest_corner(const snow_quadtree *tree, quadtree_place middle, int level, const quadtree_measures *measures)
{
    int64_t q[2], r[2];
    line_ends(middle.q, level, measures->least[0], measures->greatest[0], q);
    line_ends(middle.r, level, measures->least[1], measures->greatest[1], r);
    quadtree_count farthest = {0, 0};
    for (int i = 0; i < 4; i++) {
        quadtree_count corner = distance_square(tree, q[i % 2], r[i / 2]);
        farthest = is_greater(corner, farthest) ? corner : farthest;
    }
    return farthest;
}

static void search_leaf(const snow_quadtree *tree, const quadtree_leaf *leaf, quadtree_place middle,
                        quadtree_count *tip)
{
    int64_t half = quadtree_half_side(QUADTREE_LEAF_LEVEL);
    for (int y = 0; y < QUADTREE_LEAF_SIDE; y++) {
        for (int x = 0; x < QUADTREE_LEAF_SIDE; x++) {
            if ((leaf->row[y] >> x & 1) == 0)
                continue;
            quadtree_count square_here = distance_square(tree, middle.q + x - half, middle.r + y - half);
            *tip = is_greater(square_here, *tip) ? square_here : *tip;
        }
    }
}

/* Looks for cells beyond the tip, first where there is most space for them. */
static void search(const snow_quadtree *tree, int level, quadtree_ref ref, quadtree_place middle,
                   quadtree_measures *measures)
{
    if (level == QUADTREE_LEAF_LEVEL) {
        quadtree_leaf leaf = snow_quadtree_cells(tree, ref);
        search_leaf(tree, &leaf, middle, &measures->tip_square);
        return;
    }
    quadtree_ref child[4];
    quadtree_count farthest[4];
    quadtree_split(tree, ref, child);
    for (int i = 0; i < 4; i++) {
        bool empty = child[i] == tree->empty[level - 1];
        quadtree_place at = quadtree_child_place(middle, level, i);
        farthest[i] = empty ? (quadtree_count){0, 0} : farthest_corner(tree, at, level - 1, measures);
    }
    for (int turn = 0; turn < 4; turn++) {
        int next = 0;
        for (int i = 1; i < 4; i++)
            next = is_greater(farthest[i], farthest[next]) ? i : next;
        if (!is_greater(farthest[next], measures->tip_square))
            return;
        search(tree, level - 1, child[next], quadtree_child_place(middle, level, next), measures);
        farthest[next] = (quadtree_count){0, 0};
    }
}

void snow_quadtree_find_tip(const snow_quadtree *tree, quadtree_measures *measures)
{
    measures->tip_square = (quadtree_count){0, 0};
    search(tree, tree->now.level, tree->now.root, (quadtree_place){0, 0}, measures);
}
