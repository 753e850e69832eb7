#include "aggregate/pool.h"

#include <string.h>

enum { CHUNK = 128 }; /* items */

static snow_status widen(snow_pool *pool, snow_heap *heap)
{
    size_t room = pool->room == 0 ? 8 : 2 * pool->room;
    char **chunk = snow_heap_get_raw(heap, room, sizeof *chunk);
    if (chunk == NULL)
        return heap->refusal;
    if (pool->chunks > 0)
        memcpy(chunk, pool->chunk, pool->chunks * sizeof *chunk);
    snow_heap_put(heap, pool->chunk);
    pool->chunk = chunk;
    pool->room = room;
    return SNOW_OK;
}

snow_status snow_pool_fill(snow_pool *pool, snow_heap *heap, size_t more)
{
    while (pool->ready < pool->count + more) {
        snow_status status = pool->chunks == pool->room ? widen(pool, heap) : SNOW_OK;
        if (status != SNOW_OK)
            return status;
        char *chunk = snow_heap_get(heap, CHUNK, pool->item);
        if (chunk == NULL)
            return heap->refusal;
        pool->chunk[pool->chunks++] = chunk;
        pool->ready += CHUNK;
    }
    return SNOW_OK;
}

void *snow_pool_take(snow_pool *pool)
{
    size_t number = pool->count++;
    return pool->chunk[number / CHUNK] + number % CHUNK * pool->item;
}

void snow_pool_end(snow_pool *pool, snow_heap *heap)
{
    for (size_t i = 0; i < pool->chunks; i++)
        snow_heap_put(heap, pool->chunk[i]);
    snow_heap_put(heap, pool->chunk);
    *pool = (snow_pool){.item = pool->item};
}
