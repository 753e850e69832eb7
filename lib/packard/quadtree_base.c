#include "packard/quadtree_nodes.h"

enum { SIDE = QUADTREE_BASE_SIDE, HALF = QUADTREE_LEAF_SIDE - 1 };

quadtree_base snow_quadtree_base_cells(const snow_quadtree *tree, uint32_t index)
{
    const quadtree_node *node = quadtree_at(tree, index);
    quadtree_base cells = {{0}};
    for (int i = 0; i < 4; i++) {
        quadtree_leaf leaf = snow_quadtree_cells(tree, node->child[i]);
        for (int y = 0; y < QUADTREE_LEAF_SIDE; y++)
            cells.row[y + i / 2 * HALF] |= (uint32_t)leaf.row[y] << i % 2 * HALF;
    }
    return cells;
}

quadtree_leaf snow_quadtree_base_part(const quadtree_base *cells, int x, int y)
{
    const uint32_t all = (1U << QUADTREE_LEAF_SIDE) - 1;
    quadtree_leaf leaf;
    for (int i = 0; i < QUADTREE_LEAF_SIDE; i++)
        leaf.row[i] = (uint16_t)(cells->row[y + i] >> x & all);
    return leaf;
}

quadtree_base snow_quadtree_base_step(const quadtree_base *cells, const uint32_t rule[7])
{
    const uint32_t inside = (UINT32_C(1) << (SIDE - 1)) - 2;
    quadtree_base next = *cells;
    for (int y = 1; y < SIDE - 1; y++) {
        uint32_t above = cells->row[y - 1];
        uint32_t here = cells->row[y];
        uint32_t below = cells->row[y + 1];
        /* The neighbours in two threes, then their count in binary. */
        uint32_t a = here << 1, b = here >> 1, c = above;
        uint32_t d = above >> 1, e = below, f = below << 1;
        uint32_t one_abc = a ^ b ^ c, two_abc = (a & b) | (c & (a ^ b));
        uint32_t one_def = d ^ e ^ f, two_def = (d & e) | (f & (d ^ e));
        uint32_t one = one_abc ^ one_def, carry = one_abc & one_def;
        uint32_t two = two_abc ^ two_def ^ carry;
        uint32_t four = (two_abc & two_def) | (carry & (two_abc ^ two_def));
        uint32_t freezing = (one & ~two & ~four & rule[1]) | (~one & two & ~four & rule[2]) |
                            (one & two & ~four & rule[3]) | (~one & ~two & four & rule[4]) |
                            (one & ~two & four & rule[5]) | (~one & two & four & rule[6]);
        next.row[y] = here | (freezing & inside);
    }
    return next;
}
