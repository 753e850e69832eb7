#include "packard/quadtree_nodes.h"

enum { SIDE = 64, LEVEL = 6 /* of nodes with that side */ };

typedef struct square {
    int64_t q, r; /* its first cell */
} square;

static bool is_before(square a, square b)
{
    return a.r < b.r || (a.r == b.r && a.q < b.q);
}

static int64_t square_from(int64_t x)
{
    return (int64_t)((uint64_t)x & ~(uint64_t)(SIDE - 1));
}

/* Looks for a square from `from` on that comes before the best one so far. */
static void search(const snow_quadtree *tree, int level, quadtree_ref ref, quadtree_place middle, square from,
                   square *best)
{
    int64_t half = quadtree_half_side(level);
    square first = {middle.q - half, middle.r - half};
    square last = {middle.q + (half - SIDE), middle.r + (half - SIDE)};
    square earliest = {first.q, first.r > from.r ? first.r : from.r};
    if (ref == tree->empty[level] || is_before(last, from) || !is_before(earliest, *best))
        return;
    if (level == LEVEL) {
        *best = is_before(first, from) ? *best : first;
        return;
    }
    quadtree_ref child[4];
    quadtree_split(tree, ref, child);
    for (int i = 0; i < 4; i++)
        search(tree, level - 1, child[i], quadtree_child_place(middle, level, i), from, best);
}

bool snow_quadtree_next(const snow_quadtree *tree, int64_t *q, int64_t *r)
{
    const quadtree_crystal *now = &tree->now;
    const square none = {INT64_MAX, INT64_MAX};
    square from = {square_from(*q), square_from(*r)};
    square best = none;
    quadtree_ref child[4];
    quadtree_split(tree, now->root, child);
    for (int i = 0; i < 4; i++) {
        quadtree_place at = quadtree_child_place((quadtree_place){0, 0}, now->level, i);
        if (now->level > LEVEL) {
            search(tree, now->level - 1, child[i], at, from, &best);
            continue;
        }
        square around = {at.q < 0 ? -SIDE : 0, at.r < 0 ? -SIDE : 0}; /* the whole root is less than that */
        best = is_before(around, from) || !is_before(around, best) ? best : around;
    }
    *q = best.q;
    *r = best.r;
    return is_before(best, none);
}
