/* Items of one size that never move, in chunks. */
#ifndef SNOW_AGGREGATE_POOL_H
#define SNOW_AGGREGATE_POOL_H

#include "base/heap.h"

#include <stdint.h>

typedef struct snow_pool {
    char **chunk;
    size_t item; /* bytes */
    size_t count;
    size_t ready; /* in chunks */
    size_t chunks;
    size_t room; /* for addresses of chunks */
} snow_pool;

/* Makes `more` items ready. */
snow_status snow_pool_fill(snow_pool *pool, snow_heap *heap, size_t more);

/* Makes sure that `more` items can be taken. */
static inline snow_status snow_pool_reserve(snow_pool *pool, snow_heap *heap, size_t more)
{
    return pool->ready - pool->count >= more ? SNOW_OK : snow_pool_fill(pool, heap, more);
}

/* The next item, zeroed; it was reserved. */
void *snow_pool_take(snow_pool *pool);

/* Gives all items back. */
void snow_pool_end(snow_pool *pool, snow_heap *heap);

#endif
