#include "base/heap.h"

#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 64 };

/* Stands right before each block. */
typedef struct block_header {
    void *raw;
    size_t size;
} block_header;

static void *default_allocate(void *context, size_t size)
{
    (void)context;
    return malloc(size);
}

static void default_release(void *context, void *block)
{
    (void)context;
    free(block);
}

void snow_heap_start(snow_heap *heap, const snow_options *options)
{
    bool own = options->allocate == NULL;
    *heap = (snow_heap){
        .allocate = own ? default_allocate : options->allocate,
        .release = own ? default_release : options->release,
        .context = options->allocator_context,
        .limit = options->memory_limit,
    };
}

void *snow_heap_get_raw(snow_heap *heap, size_t count, size_t size)
{
    size_t overhead = sizeof(block_header) + ALIGNMENT;
    if (size != 0 && count > (SIZE_MAX / 2 - overhead) / size) {
        heap->refusal = SNOW_ERROR_TOO_LARGE;
        return NULL;
    }
    size_t bytes = count * size + overhead;
    if (heap->limit != 0 && (heap->used > heap->limit || bytes > heap->limit - heap->used)) {
        heap->refusal = SNOW_ERROR_MEMORY_LIMIT;
        return NULL;
    }
    char *raw = heap->allocate(heap->context, bytes);
    if (raw == NULL) {
        heap->refusal = SNOW_ERROR_NO_MEMORY;
        return NULL;
    }
    heap->used += bytes;
    char *lowest = raw + sizeof(block_header);
    char *block = lowest + (ALIGNMENT - (uintptr_t)lowest % ALIGNMENT) % ALIGNMENT;
    block_header header = {raw, bytes};
    memcpy(block - sizeof header, &header, sizeof header);
    return block;
}

void *snow_heap_get(snow_heap *heap, size_t count, size_t size)
{
    void *block = snow_heap_get_raw(heap, count, size);
    if (block != NULL)
        memset(block, 0, count * size);
    return block;
}

void snow_heap_put(snow_heap *heap, void *block)
{
    if (block == NULL)
        return;
    block_header header;
    memcpy(&header, (char *)block - sizeof header, sizeof header);
    heap->used -= header.size;
    heap->release(heap->context, header.raw);
}

void *snow_heap_move(snow_heap *heap, void *block, size_t kept, size_t count, size_t size)
{
    void *moved = snow_heap_get_raw(heap, count, size);
    if (moved == NULL)
        return NULL;
    if (kept > 0)
        memcpy(moved, block, kept * size);
    snow_heap_put(heap, block);
    return moved;
}
