#include "packard/quadtree_nodes.h"

enum { SLOT_INDEX_BITS = 29 };
static const uint32_t slot_index = (UINT32_C(1) << SLOT_INDEX_BITS) - 1;

/* By the top four bits of a reference; see quadtree_ref. */
const uint8_t snow_quadtree_turns[16] = {
    0, 0, QUADTREE_SWAP, QUADTREE_SWAP, QUADTREE_REFLECT, QUADTREE_REFLECT, 3, 3,
    0, QUADTREE_REFLECT, 0, QUADTREE_SWAP, 0, QUADTREE_SWAP, 0, 0,
};

#define H UINT32_C(0x10000000) /* a half turn of a node with symmetry */
#define T UINT32_C(0x20000000)
const uint32_t snow_quadtree_flips[QUADTREE_TURNS][16] = {
    {0},
    {T, T, T, T, T, T, T, T, 0, 0, H, H, H, H, 0, 0},
    {2 * T, 2 * T, 2 * T, 2 * T, 2 * T, 2 * T, 2 * T, 2 * T, H, H, 0, 0, H, H, 0, 0},
    {3 * T, 3 * T, 3 * T, 3 * T, 3 * T, 3 * T, 3 * T, 3 * T, H, H, H, H, 0, 0, 0, 0},
};
#undef H
#undef T

/* The first bits of a reference to a node that these turns do not change, bit t − 1 for turn t. */
static quadtree_ref kind_of(unsigned unchanged)
{
    static const uint8_t kinds[8] = {[0] = 0, [1] = 8, [2] = 10, [4] = 12, [7] = 14};
    return (quadtree_ref)kinds[unchanged] << 28;
}

static uint64_t hash_of(const void *contents, size_t size)
{
    uint64_t words[3] = {0};
    memcpy(words, contents, size);
    uint64_t hash = words[0] * UINT64_C(0x9e3779b97f4a7c15);
    hash = ((hash ^ hash >> 32) + words[1]) * UINT64_C(0xbf58476d1ce4e5b9);
    hash = ((hash ^ hash >> 29) + words[2]) * UINT64_C(0x94d049bb133111eb);
    return hash ^ hash >> 32;
}

static uint32_t slot_tag(uint64_t hash)
{
    return (uint32_t)hash & ~slot_index;
}

static uint32_t first_slot(const quadtree_table *table, uint64_t hash)
{
    return (uint32_t)((hash >> 32) * table->size >> 32);
}

static uint32_t next_slot(const quadtree_table *table, uint32_t slot)
{
    return slot + 1 == table->size ? 0 : slot + 1;
}

/* The node with these contents; 0: there is none. */
static inline uint32_t find(const snow_quadtree *tree, const quadtree_table *table, uint64_t hash,
                            const void *contents, size_t size)
{
    uint32_t tag = slot_tag(hash);
    for (uint32_t slot = first_slot(table, hash);; slot = next_slot(table, slot)) {
        uint32_t held = table->slots[slot];
        if (held == 0)
            return 0;
        uint32_t index = held & slot_index;
        if ((held & ~slot_index) == tag && memcmp(quadtree_at(tree, index), contents, size) == 0)
            return index;
    }
}

static void enter(quadtree_table *table, uint64_t hash, uint32_t index)
{
    uint32_t slot = first_slot(table, hash);
    while (table->slots[slot] != 0)
        slot = next_slot(table, slot);
    table->slots[slot] = slot_tag(hash) | index;
    table->used++;
}

/* Enters all nodes, or all leaves. */
static void fill(const snow_quadtree *tree, quadtree_table *table, bool leaves)
{
    memset(table->slots, 0, table->size * sizeof table->slots[0]);
    table->used = 0;
    for (uint32_t index = 1; index < tree->next_fresh; index++) {
        uint8_t height = *quadtree_state(tree, index) & QUADTREE_HEIGHT;
        if (height != QUADTREE_FREE && (height == 0) == leaves) {
            const quadtree_node *node = quadtree_at(tree, index);
            enter(table, leaves ? hash_of(&node->leaf, sizeof node->leaf) : hash_of(node->child, sizeof node->child),
                  index);
        }
    }
}

static bool grow(snow_quadtree *tree, quadtree_table *table)
{
    uint32_t size = table->size + table->size / 2;
    uint32_t *slots = snow_heap_get_raw(tree->heap, size, sizeof slots[0]);
    if (slots == NULL)
        return false;
    snow_heap_put(tree->heap, table->slots);
    table->slots = slots;
    table->size = size;
    fill(tree, table, table == &tree->leaves);
    return true;
}

/* Looks best three quarters full; bears a little more when it cannot grow. */
static bool has_room(snow_quadtree *tree, quadtree_table *table)
{
    return table->used < table->size - table->size / 4 || grow(tree, table) ||
           table->used < table->size - table->size / 16;
}

static bool add_chunk(snow_quadtree *tree)
{
    enum { FIRST_ROOM = 64, MOST_CHUNKS = 1 << (SLOT_INDEX_BITS - QUADTREE_CHUNK_BITS) };
    if (tree->chunk_count == MOST_CHUNKS) {
        tree->heap->refusal = SNOW_ERROR_TOO_LARGE;
        return false;
    }
    if (tree->chunk_count == tree->chunk_room) {
        uint32_t room = tree->chunk_room == 0 ? FIRST_ROOM : 2 * tree->chunk_room;
        quadtree_chunk **chunks = snow_heap_get_raw(tree->heap, room, sizeof *chunks);
        if (chunks == NULL)
            return false;
        if (tree->chunk_count != 0)
            memcpy(chunks, tree->chunks, tree->chunk_count * sizeof *chunks);
        snow_heap_put(tree->heap, tree->chunks);
        tree->chunks = chunks;
        tree->chunk_room = room;
    }
    quadtree_chunk *chunk = snow_heap_get_raw(tree->heap, 1, sizeof *chunk);
    if (chunk == NULL)
        return false;
    tree->chunks[tree->chunk_count++] = chunk;
    return true;
}

uint32_t snow_quadtree_take(snow_quadtree *tree)
{
    uint32_t index = tree->first_free;
    if (index != 0) {
        tree->first_free = quadtree_at(tree, index)->next_free;
        tree->free_count--;
        return index;
    }
    if (tree->next_fresh >= tree->chunk_count << QUADTREE_CHUNK_BITS && !add_chunk(tree)) {
        tree->failure = tree->heap->refusal;
        return 0;
    }
    index = tree->next_fresh++;
    *quadtree_state(tree, index) = QUADTREE_FREE;
    return index;
}

void snow_quadtree_give(snow_quadtree *tree, uint32_t index)
{
    *quadtree_state(tree, index) = QUADTREE_FREE;
    quadtree_at(tree, index)->next_free = tree->first_free;
    tree->first_free = index;
    tree->free_count++;
}

static void mark(const snow_quadtree *tree, int level, quadtree_ref ref)
{
    uint32_t index = quadtree_index(ref);
    if (index == 0) /* creation gets no memory at all */
        return;
    uint8_t *state = quadtree_state(tree, index);
    if (*state & QUADTREE_MARKED)
        return;
    *state |= QUADTREE_MARKED;
    for (int i = 0; level > QUADTREE_LEAF_LEVEL && i < 4; i++)
        mark(tree, level - 1, quadtree_at(tree, index)->child[i]);
}

/* A result that nothing else needs is found again when it is asked for. */
static void forget_unmarked_results(const snow_quadtree *tree)
{
    for (uint32_t index = 1; index < tree->next_fresh; index++) {
        uint8_t state = *quadtree_state(tree, index);
        quadtree_node *node = quadtree_at(tree, index);
        if (state & QUADTREE_MARKED && (state & QUADTREE_HEIGHT) != 0 && node->result != QUADTREE_NONE &&
            !(*quadtree_state(tree, quadtree_index(node->result)) & QUADTREE_MARKED))
            node->result = QUADTREE_NONE;
    }
}

void snow_quadtree_collect(snow_quadtree *tree)
{
    mark(tree, QUADTREE_TOP_LEVEL, tree->empty[QUADTREE_TOP_LEVEL]);
    mark(tree, tree->now.level, tree->now.root);
    mark(tree, tree->kept.level, tree->kept.root);
    for (size_t i = 0; i < tree->live_count; i++)
        mark(tree, tree->live[i].level, tree->live[i].ref);
    forget_unmarked_results(tree);
    tree->first_free = 0;
    tree->free_count = 0;
    /* Backwards, so that the lowest places are used first. */
    for (uint32_t index = tree->next_fresh - 1; index > 0; index--) {
        uint8_t *state = quadtree_state(tree, index);
        if (*state & QUADTREE_MARKED)
            *state &= (uint8_t)~QUADTREE_MARKED;
        else
            snow_quadtree_give(tree, index);
    }
    fill(tree, &tree->leaves, true);
    fill(tree, &tree->nodes, false);
}

/* A place for one more node and its slot. Goes on after a collection only when
   that freed a good part of the memory, lest there be one collection after the other. */
static uint32_t make_place(snow_quadtree *tree, quadtree_table *table)
{
    uint32_t index = has_room(tree, table) ? snow_quadtree_take(tree) : 0;
    if (index != 0)
        return index;
    tree->failure = tree->heap->refusal;
    if (tree->collections == QUADTREE_COLLECTIONS)
        return 0;
    tree->collections++;
    snow_quadtree_collect(tree);
    bool plenty = tree->free_count >= tree->chunk_count * (QUADTREE_CHUNK / 4);
    return plenty && has_room(tree, table) ? snow_quadtree_take(tree) : 0;
}

static quadtree_ref add(snow_quadtree *tree, quadtree_table *table, uint64_t hash, const void *contents, size_t size,
                        int level, quadtree_ref kind)
{
    uint32_t index = make_place(tree, table);
    if (index == 0)
        return QUADTREE_NONE;
    if (quadtree_index(kind | index) != index) {
        snow_quadtree_give(tree, index);
        tree->failure = SNOW_ERROR_TOO_LARGE;
        return QUADTREE_NONE;
    }
    quadtree_node *node = quadtree_at(tree, index);
    node->result = QUADTREE_NONE;
    memcpy(node, contents, size);
    *quadtree_state(tree, index) = (uint8_t)(level - QUADTREE_LEAF_LEVEL);
    enter(table, hash, index);
    tree->work++;
    return kind | index;
}

quadtree_wanted snow_quadtree_want(const snow_quadtree *tree, const quadtree_ref child[4])
{
    const quadtree_ref turned[QUADTREE_TURNS][4] = {
        {child[0], child[1], child[2], child[3]},
        {quadtree_turned(child[0], 1), quadtree_turned(child[2], 1), quadtree_turned(child[1], 1),
         quadtree_turned(child[3], 1)},
        {quadtree_turned(child[3], 2), quadtree_turned(child[2], 2), quadtree_turned(child[1], 2),
         quadtree_turned(child[0], 2)},
        {quadtree_turned(child[3], 3), quadtree_turned(child[1], 3), quadtree_turned(child[2], 3),
         quadtree_turned(child[0], 3)},
    };
    uint64_t upper[QUADTREE_TURNS], lower[QUADTREE_TURNS];
    unsigned least = 0;
    unsigned unchanged = 0;
    for (unsigned turn = 0; turn < QUADTREE_TURNS; turn++) {
        upper[turn] = (uint64_t)turned[turn][0] << 32 | turned[turn][1];
        lower[turn] = (uint64_t)turned[turn][2] << 32 | turned[turn][3];
        if (upper[turn] < upper[least] || (upper[turn] == upper[least] && lower[turn] < lower[least]))
            least = turn;
        unchanged |= (unsigned)(upper[turn] == upper[0] && lower[turn] == lower[0]) << turn;
    }
    quadtree_wanted wanted = {.kind = kind_of(unchanged >> 1), .turn = least};
    memcpy(wanted.child, turned[least], sizeof wanted.child);
    wanted.hash = hash_of(wanted.child, sizeof wanted.child);
    __builtin_prefetch(&tree->nodes.slots[first_slot(&tree->nodes, wanted.hash)]);
    return wanted;
}

void snow_quadtree_approach(const snow_quadtree *tree, const quadtree_wanted *wanted)
{
    uint32_t index = tree->nodes.slots[first_slot(&tree->nodes, wanted->hash)] & slot_index;
    __builtin_prefetch(quadtree_at(tree, index));
}

quadtree_ref snow_quadtree_get_wanted(snow_quadtree *tree, int level, const quadtree_wanted *wanted)
{
    const quadtree_ref *child = wanted->child;
    uint32_t index = find(tree, &tree->nodes, wanted->hash, child, sizeof wanted->child);
    quadtree_ref ref = index != 0 ? wanted->kind | index
                                  : add(tree, &tree->nodes, wanted->hash, child, sizeof wanted->child, level,
                                        wanted->kind);
    return ref == QUADTREE_NONE ? ref : quadtree_turned(ref, wanted->turn);
}

quadtree_ref snow_quadtree_join(snow_quadtree *tree, int level, const quadtree_ref child[4])
{
    quadtree_wanted wanted = snow_quadtree_want(tree, child);
    return snow_quadtree_get_wanted(tree, level, &wanted);
}

quadtree_ref snow_quadtree_find_leaf(snow_quadtree *tree, const quadtree_leaf *leaf)
{
    quadtree_leaf turned[QUADTREE_TURNS];
    unsigned least = 0;
    unsigned unchanged = 0;
    for (unsigned turn = 0; turn < QUADTREE_TURNS; turn++) {
        turned[turn] = snow_quadtree_turned_leaf(leaf, turn);
        if (memcmp(&turned[turn], &turned[least], sizeof *leaf) < 0)
            least = turn;
        unchanged |= (unsigned)(memcmp(&turned[turn], leaf, sizeof *leaf) == 0) << turn;
    }
    const quadtree_leaf *contents = &turned[least];
    quadtree_ref kind = kind_of(unchanged >> 1);
    uint64_t hash = hash_of(contents, sizeof *contents);
    uint32_t index = find(tree, &tree->leaves, hash, contents, sizeof *contents);
    quadtree_ref node =
        index != 0 ? kind | index
                   : add(tree, &tree->leaves, hash, contents, sizeof *contents, QUADTREE_LEAF_LEVEL, kind);
    return node == QUADTREE_NONE ? node : quadtree_turned(node, least);
}
