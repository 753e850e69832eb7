/* Items of one size that never move, in chunks, numbered from 0. */
#ifndef SNOW_AGGREGATE_POOL_H
#define SNOW_AGGREGATE_POOL_H

#include "base/heap.h"

#include <stdint.h>

enum { SNOW_POOL_SHIFT = 7, SNOW_POOL_CHUNK = 1 << SNOW_POOL_SHIFT };

typedef struct snow_pool {
    char **chunk;
    size_t item; /* bytes */
    uint32_t count;
    uint32_t chunks;
    uint32_t room; /* for chunk pointers */
} snow_pool;

/* Makes sure that `more` items can be taken. */
snow_status snow_pool_reserve(snow_pool *pool, snow_heap *heap, uint32_t more);

/* The next item, zeroed; it was reserved. */
uint32_t snow_pool_take(snow_pool *pool);

/* Gives all items back. */
void snow_pool_end(snow_pool *pool, snow_heap *heap);

static inline void *snow_pool_item(const snow_pool *pool, uint32_t number)
{
    return pool->chunk[number >> SNOW_POOL_SHIFT] + (size_t)(number & (SNOW_POOL_CHUNK - 1)) * pool->item;
}

#endif
