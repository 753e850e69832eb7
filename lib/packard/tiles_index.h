/* Where tiles are, in row order: so that a sparse plane can be gone through. */
#ifndef SNOW_PACKARD_TILES_INDEX_H
#define SNOW_PACKARD_TILES_INDEX_H

#include "base/heap.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A tree in which a node is a word, and each of its 64 bits says whether there is
   something below. Places are 64-bit numbers: six bits choose the bit of a node
   on each level. Nodes stand in a table by their level and the bits above. */
typedef struct tile_index_node {
    uint64_t name; /* 0: free */
    uint64_t bits;
} tile_index_node;

typedef struct tile_index {
    snow_heap *heap;
    tile_index_node *nodes;
    size_t size; /* a power of two */
    size_t used;
} tile_index;

/* False: the heap refused. */
bool snow_tile_index_start(tile_index *index, snow_heap *heap);
void snow_tile_index_end(tile_index *index);

/* False: the heap refused, and nothing has changed. */
bool snow_tile_index_add(tile_index *index, int32_t q, int32_t r);

/* Moves on to the first tile that was added, row by row, and not before this place. False: there is none. */
bool snow_tile_index_next(const tile_index *index, int32_t *q, int32_t *r);

#endif
