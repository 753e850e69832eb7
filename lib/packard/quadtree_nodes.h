/* The nodes of the quadtree engine: how they are named, found and kept.

   A node of level n covers 2^n + 1 by 2^n + 1 cells, its rim included: nodes
   side by side share a line of cells, and the middle of a node is a cell. So the
   symmetries about a cell map nodes to nodes. Those that map squares of the
   axial lattice to squares are the turns: the swap of q and r, the point
   reflection and both. Patterns that differ by a turn are kept once. */
#ifndef SNOW_PACKARD_QUADTREE_NODES_H
#define SNOW_PACKARD_QUADTREE_NODES_H

#include "packard/quadtree.h"

#include <pthread.h>
#include <string.h>

/* A pattern: its node and how it is turned.
     node without symmetry   0 tt iiiii iiiiiiii iiiiiiii iiiiiiii   t: turn
     node with symmetry      1 gg h iiii iiiiiiii iiiiiiii iiiiiiii  g: the turns that do not change it
                                                                     h: the other turns change it */
typedef uint32_t quadtree_ref;

#define QUADTREE_NONE UINT32_MAX

/* Turns compose by exclusive or. */
enum { QUADTREE_SWAP = 1, QUADTREE_REFLECT = 2, QUADTREE_TURNS = 4 };

enum {
    QUADTREE_LEAF_LEVEL = 3,
    QUADTREE_LEAF_SIDE = 9,
    QUADTREE_BASE_LEVEL = 4,
    QUADTREE_BASE_SIDE = 17,
    QUADTREE_LEAST_ROOT = 5,
    QUADTREE_TOP_LEVEL = 65,
    QUADTREE_LEVELS,
    /* An advance holds 14 for each level. */
    QUADTREE_LIVE = 14 * QUADTREE_LEVELS,
    /* More in one call would hardly finish: most time goes into results that were known once. */
    QUADTREE_COLLECTIONS = 32,
};

typedef struct quadtree_leaf {
    uint16_t row[QUADTREE_LEAF_SIDE]; /* bit b: column b */
} quadtree_leaf;

/* The cells of a pattern of the lowest level above the leaves. */
typedef struct quadtree_base {
    uint32_t row[QUADTREE_BASE_SIDE]; /* bit b: column b */
} quadtree_base;

/* What a place of the pool holds. */
typedef union quadtree_node {
    struct {
        quadtree_ref child[4]; /* row by row */
        quadtree_ref result;   /* the middle half, some steps later; NONE: not known */
    };
    quadtree_leaf leaf;
    uint32_t next_free;
} quadtree_node;

_Static_assert(sizeof(quadtree_node) == 20, "nodes are compact");

enum {
    QUADTREE_CHUNK_BITS = 10,
    QUADTREE_CHUNK = 1 << QUADTREE_CHUNK_BITS,

    /* What a node's state says: its levels above the leaves, and */
    QUADTREE_HEIGHT = 0x3f,
    QUADTREE_FREE = 0x3f, /* no node */
    QUADTREE_MARKED = 0x40,
    QUADTREE_STILL = 0x80, /* no cell inside its rim freezes in the next step */
};

typedef struct quadtree_chunk {
    quadtree_node node[QUADTREE_CHUNK];
    uint8_t state[QUADTREE_CHUNK];
} quadtree_chunk;

/* Nodes by their contents: open addressing. A slot holds three bits of the hash and the node's index; 0: free. */
typedef struct quadtree_table {
    uint32_t *slots;
    uint32_t size, used;
} quadtree_table;

typedef struct quadtree_live {
    quadtree_ref ref;
    int32_t level;
} quadtree_live;

/* Where a pattern stands: its middle cell. */
typedef struct quadtree_place {
    int64_t q, r;
} quadtree_place;

typedef struct quadtree_crystal {
    quadtree_ref root; /* its middle is the origin; nothing is frozen on its rim */
    int level;
    int64_t reach; /* no frozen cell has |q| or |r| beyond */
    bool measured;
    quadtree_measures measures;
} quadtree_crystal;

struct snow_quadtree {
    snow_heap *heap;
    uint32_t rule_masks[7]; /* all ones where the digit is 1 */

    quadtree_chunk **chunks;
    uint32_t chunk_count, chunk_room;
    uint32_t next_fresh; /* indices from here on were never used; index 0 is not used */
    uint32_t first_free, free_count;
    /* Leaves have a table of their own, so that their cells are never taken for
       a node's children. Indices of leaves and nodes are distinct, so that
       children of different levels are. */
    quadtree_table leaves, nodes;

    quadtree_ref empty[QUADTREE_LEVELS];
    quadtree_crystal now, kept;
    quadtree_place centre; /* distances are measured from it */
    int exponent;        /* results of high levels are 2^exponent steps ahead */
    int collections;     /* since the call began */
    uint64_t work;       /* nodes and leaves made, results found, and the like */
    snow_status failure; /* why the last node could not be made */

    uint64_t *front; /* what bounds are found in */
    size_t front_room;

    /* Saving writes numbers into the nodes, and a crystal may be saved by several threads at once. */
    pthread_mutex_t saving;

    /* Patterns that must survive a collection, besides the crystals. */
    size_t live_count;
    quadtree_live live[QUADTREE_LIVE];
};

extern const uint32_t snow_quadtree_flips[QUADTREE_TURNS][16];
extern const uint8_t snow_quadtree_turns[16];

static inline quadtree_ref quadtree_turned(quadtree_ref ref, unsigned turn)
{
    return ref ^ snow_quadtree_flips[turn][ref >> 28];
}

/* How a pattern is turned against its node. */
static inline unsigned quadtree_turn_of(quadtree_ref ref)
{
    return snow_quadtree_turns[ref >> 28];
}

static inline uint32_t quadtree_index(quadtree_ref ref)
{
    return ref & (UINT32_C(0x1fffffff) >> (ref >> 31));
}

static inline quadtree_node *quadtree_at(const snow_quadtree *tree, uint32_t index)
{
    return &tree->chunks[index >> QUADTREE_CHUNK_BITS]->node[index & (QUADTREE_CHUNK - 1)];
}

static inline uint8_t *quadtree_state(const snow_quadtree *tree, uint32_t index)
{
    return &tree->chunks[index >> QUADTREE_CHUNK_BITS]->state[index & (QUADTREE_CHUNK - 1)];
}

/* The quadrants of a pattern above the leaves, row by row. */
static inline void quadtree_split(const snow_quadtree *tree, quadtree_ref ref, quadtree_ref child[4])
{
    static const uint8_t places[QUADTREE_TURNS][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {3, 2, 1, 0}, {3, 1, 2, 0}};
    const quadtree_node *node = quadtree_at(tree, quadtree_index(ref));
    unsigned turn = quadtree_turn_of(ref);
    for (int i = 0; i < 4; i++)
        child[i] = quadtree_turned(node->child[places[turn][i]], turn);
}

static inline void quadtree_hold(snow_quadtree *tree, int level, quadtree_ref ref)
{
    tree->live[tree->live_count++] = (quadtree_live){ref, level};
}

static inline int64_t quadtree_half_side(int level)
{
    return INT64_C(1) << (level - 1);
}

static inline quadtree_place quadtree_child_place(quadtree_place middle, int level, int i)
{
    int64_t shift = quadtree_half_side(level - 1);
    return (quadtree_place){middle.q + (i % 2 ? shift : -shift), middle.r + (i / 2 ? shift : -shift)};
}

static inline quadtree_count quadtree_sum(quadtree_count a, quadtree_count b)
{
    uint64_t low = a.low + b.low;
    return (quadtree_count){a.high + b.high + (low < a.low), low};
}

/* The pattern of `level` with these quadrants. NONE: no memory, `failure` says
   why. May collect: what the caller still needs must be held, or be part of what is. */
quadtree_ref snow_quadtree_join(snow_quadtree *tree, int level, const quadtree_ref child[4]);

/* The same in parts, for several patterns at once: their slots, then their nodes, come into the cache side by side. */
typedef struct quadtree_wanted {
    quadtree_ref child[4]; /* of the node */
    uint64_t hash;
    quadtree_ref kind;
    unsigned turn;
} quadtree_wanted;

quadtree_wanted snow_quadtree_want(const snow_quadtree *tree, const quadtree_ref child[4]);
void snow_quadtree_approach(const snow_quadtree *tree, const quadtree_wanted *wanted);
quadtree_ref snow_quadtree_get_wanted(snow_quadtree *tree, int level, const quadtree_wanted *wanted);

quadtree_ref snow_quadtree_find_leaf(snow_quadtree *tree, const quadtree_leaf *leaf);

/* The middle half of a pattern as it is. */
quadtree_ref snow_quadtree_middle(snow_quadtree *tree, int level, quadtree_ref ref);

/* Forgets all patterns but the crystals, the empty ones and those that are held. */
void snow_quadtree_collect(snow_quadtree *tree);

/* A place of the pool without a collection; 0: there is none, `failure` says why. */
uint32_t snow_quadtree_take(snow_quadtree *tree);
void snow_quadtree_give(snow_quadtree *tree, uint32_t index);

/* Makes the root at least of this level. False: no memory. */
bool snow_quadtree_grow(snow_quadtree *tree, int level);

/* Measures the crystal, which is not empty. The tip needs the bounds. False: no memory, and nothing has changed. */
bool snow_quadtree_find_measures(snow_quadtree *tree);
bool snow_quadtree_find_population(snow_quadtree *tree, quadtree_measures *measures);
bool snow_quadtree_find_bounds(snow_quadtree *tree, quadtree_measures *measures);
void snow_quadtree_find_tip(const snow_quadtree *tree, quadtree_measures *measures);

/* A leaf's cells, turned as the pattern is. */
quadtree_leaf snow_quadtree_cells(const snow_quadtree *tree, quadtree_ref ref);
quadtree_leaf snow_quadtree_turned_leaf(const quadtree_leaf *leaf, unsigned turn);
/* A row of it. */
uint32_t snow_quadtree_leaf_row(const quadtree_leaf *leaf, unsigned turn, int y);

quadtree_base snow_quadtree_base_cells(const snow_quadtree *tree, uint32_t index);
/* The leaf whose first cell is (x, y). */
quadtree_leaf snow_quadtree_base_part(const quadtree_base *cells, int x, int y);
/* One step of all cells but those on the rim. */
quadtree_base snow_quadtree_base_step(const quadtree_base *cells, const uint32_t rule[7]);

#endif
