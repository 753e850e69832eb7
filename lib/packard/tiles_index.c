#include "packard/tiles_index.h"

enum { DIGIT = 6, LEVELS = 11, FIRST_SIZE = 32 };

/* Grows with r, and in a row with q. */
static uint64_t place_of(int32_t q, int32_t r)
{
    const uint32_t middle = UINT32_C(1) << 31;
    return (uint64_t)((uint32_t)r ^ middle) << 32 | ((uint32_t)q ^ middle);
}

static unsigned bit_of(uint64_t place, int level)
{
    return (unsigned)(place >> DIGIT * level) & 63;
}

/* What of a place lies above a node of this level. */
static uint64_t above(uint64_t place, int level)
{
    return level + 1 < LEVELS ? place >> DIGIT * (level + 1) : 0;
}

static uint64_t name_of(uint64_t above_node, int level)
{
    return above_node | (uint64_t)(level + 1) << 58;
}

/* The node, or the free place where it would be put. */
static tile_index_node *search(const tile_index *index, uint64_t name)
{
    uint64_t hash = name * UINT64_C(0x9E3779B97F4A7C15);
    hash = (hash ^ hash >> 32) * UINT64_C(0xBF58476D1CE4E5B9);
    size_t place = (size_t)(hash >> 32) & (index->size - 1);
    while (index->nodes[place].name != 0 && index->nodes[place].name != name)
        place = (place + 1) & (index->size - 1);
    return &index->nodes[place];
}

bool snow_tile_index_start(tile_index *index, snow_heap *heap)
{
    *index = (tile_index){.heap = heap, .size = FIRST_SIZE};
    index->nodes = snow_heap_get(heap, index->size, sizeof *index->nodes);
    return index->nodes != NULL;
}

void snow_tile_index_end(tile_index *index)
{
    snow_heap_put(index->heap, index->nodes);
}

/* Room for a node of each level. */
static bool make_room(tile_index *index)
{
    if ((index->used + LEVELS) * 4 <= index->size * 3)
        return true;
    tile_index wider = {.heap = index->heap, .size = 2 * index->size, .used = index->used};
    wider.nodes = snow_heap_get(index->heap, wider.size, sizeof *wider.nodes);
    if (wider.nodes == NULL)
        return false;
    for (size_t i = 0; i < index->size; i++)
        if (index->nodes[i].name != 0)
            *search(&wider, index->nodes[i].name) = index->nodes[i];
    snow_heap_put(index->heap, index->nodes);
    *index = wider;
    return true;
}

bool snow_tile_index_add(tile_index *index, int32_t q, int32_t r)
{
    if (!make_room(index))
        return false;
    uint64_t place = place_of(q, r);
    for (int level = 0; level < LEVELS; level++) {
        uint64_t name = name_of(above(place, level), level);
        tile_index_node *node = search(index, name);
        bool known = node->name == name;
        node->name = name;
        node->bits |= UINT64_C(1) << bit_of(place, level);
        if (known) /* and so are those above */
            return true;
        index->used++;
    }
    return true;
}

/* The first place below a node whose bits are not empty. */
static uint64_t first_below(const tile_index *index, uint64_t above_node, uint64_t bits, int level)
{
    for (;; level--) {
        uint64_t place = above_node << DIGIT | (uint64_t)__builtin_ctzll(bits);
        if (level == 0)
            return place;
        above_node = place;
        bits = search(index, name_of(above_node, level - 1))->bits;
    }
}

bool snow_tile_index_next(const tile_index *index, int32_t *q, int32_t *r)
{
    uint64_t place = place_of(*q, *r);
    uint64_t from = UINT64_MAX << bit_of(place, 0);
    for (int level = 0; level < LEVELS; level++) {
        uint64_t bits = search(index, name_of(above(place, level), level))->bits & from;
        if (bits != 0) {
            place = first_below(index, above(place, level), bits, level);
            *q = (int32_t)((int64_t)(place & UINT32_MAX) + INT32_MIN);
            *r = (int32_t)((int64_t)(place >> 32) + INT32_MIN);
            return true;
        }
        if (level + 1 < LEVELS) /* beyond what lies below this node */
            from = UINT64_MAX << bit_of(place, level + 1) << 1;
    }
    return false;
}
