#include "aggregate/sites.h"

#include <string.h>

static snow_status widen(snow_sites *sites, snow_heap *heap, size_t chunks)
{
    size_t capacity = sites->capacity == 0 ? 16 : sites->capacity;
    while (capacity < chunks)
        capacity *= 2;
    uint64_t **wider = snow_heap_get(heap, capacity, sizeof *wider);
    if (wider == NULL)
        return heap->refusal;
    if (sites->chunks > 0)
        memcpy(wider, sites->chunk, sites->chunks * sizeof *wider);
    snow_heap_put(heap, sites->chunk);
    sites->chunk = wider;
    sites->capacity = capacity;
    return SNOW_OK;
}

snow_status snow_sites_reserve(snow_sites *sites, snow_heap *heap, uint64_t more)
{
    uint64_t chunks = (sites->count + more + SNOW_SITES_CHUNK - 1) / SNOW_SITES_CHUNK;
    if (chunks > SIZE_MAX / 2 / sizeof *sites->chunk)
        return SNOW_ERROR_TOO_LARGE;
    snow_status status = SNOW_OK;
    if (chunks > sites->capacity)
        status = widen(sites, heap, (size_t)chunks);
    while (status == SNOW_OK && sites->chunks < chunks) {
        uint64_t *chunk = snow_heap_get_raw(heap, SNOW_SITES_CHUNK, sizeof *chunk);
        if (chunk == NULL)
            return heap->refusal;
        sites->chunk[sites->chunks++] = chunk;
    }
    return status;
}

void snow_sites_end(snow_sites *sites, snow_heap *heap)
{
    for (size_t i = 0; i < sites->chunks; i++)
        snow_heap_put(heap, sites->chunk[i]);
    snow_heap_put(heap, sites->chunk);
    *sites = (snow_sites){.space = sites->space};
}
