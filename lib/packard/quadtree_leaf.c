#include "packard/quadtree_nodes.h"

enum { SIDE = QUADTREE_LEAF_SIDE, LAST = SIDE - 1 };

/* Bits exchanged across the diagonal of a block of 8 by 8: in single bits, then in pairs, then in fours. */
static uint64_t transposed(uint64_t block)
{
    uint64_t change = (block ^ block >> 7) & UINT64_C(0x00aa00aa00aa00aa);
    block ^= change ^ change << 7;
    change = (block ^ block >> 14) & UINT64_C(0x0000cccc0000cccc);
    block ^= change ^ change << 14;
    change = (block ^ block >> 28) & UINT64_C(0x00000000f0f0f0f0);
    return block ^ change ^ change << 28;
}

static quadtree_leaf swapped(const quadtree_leaf *leaf)
{
    uint64_t block = 0;
    uint32_t last_column = 0;
    for (int i = 0; i < LAST; i++) {
        block |= (uint64_t)(leaf->row[i] & 0xff) << 8 * i;
        last_column |= (uint32_t)(leaf->row[i] >> LAST) << i;
    }
    last_column |= leaf->row[LAST] & 1U << LAST;
    block = transposed(block);
    quadtree_leaf turned;
    for (int i = 0; i < LAST; i++)
        turned.row[i] = (uint16_t)((block >> 8 * i & 0xff) | (leaf->row[LAST] >> i & 1U) << LAST);
    turned.row[LAST] = (uint16_t)last_column;
    return turned;
}

static uint32_t reversed(uint32_t row)
{
    row = (row & 0x5555) << 1 | (row >> 1 & 0x5555);
    row = (row & 0x3333) << 2 | (row >> 2 & 0x3333);
    row = (row & 0x0f0f) << 4 | (row >> 4 & 0x0f0f);
    row = (row & 0x00ff) << 8 | row >> 8;
    return row >> (16 - SIDE);
}

static quadtree_leaf reflected(const quadtree_leaf *leaf)
{
    quadtree_leaf turned;
    for (int i = 0; i < SIDE; i++)
        turned.row[i] = (uint16_t)reversed(leaf->row[LAST - i]);
    return turned;
}

quadtree_leaf snow_quadtree_turned_leaf(const quadtree_leaf *leaf, unsigned turn)
{
    quadtree_leaf turned = turn & QUADTREE_SWAP ? swapped(leaf) : *leaf;
    return turn & QUADTREE_REFLECT ? reflected(&turned) : turned;
}

static uint32_t column(const quadtree_leaf *leaf, int x)
{
    uint32_t cells = 0;
    for (int y = 0; y < SIDE; y++)
        cells |= (uint32_t)(leaf->row[y] >> x & 1) << y;
    return cells;
}

uint32_t snow_quadtree_leaf_row(const quadtree_leaf *leaf, unsigned turn, int y)
{
    int line = turn & QUADTREE_REFLECT ? LAST - y : y;
    uint32_t cells = turn & QUADTREE_SWAP ? column(leaf, line) : leaf->row[line];
    return turn & QUADTREE_REFLECT ? reversed(cells) : cells;
}

quadtree_leaf snow_quadtree_cells(const snow_quadtree *tree, quadtree_ref ref)
{
    return snow_quadtree_turned_leaf(&quadtree_at(tree, quadtree_index(ref))->leaf, quadtree_turn_of(ref));
}
