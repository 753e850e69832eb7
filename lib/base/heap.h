/* All memory of a grid: the caller's allocator, with a limit and an account. */
#ifndef SNOW_BASE_HEAP_H
#define SNOW_BASE_HEAP_H

#include <snowgrowth/options.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct snow_heap {
    snow_allocate allocate;
    snow_release release;
    void *context;
    uint64_t limit; /* 0: none */
    uint64_t used;
    snow_status refusal; /* why the last snow_heap_get() returned NULL */
} snow_heap;

void snow_heap_start(snow_heap *heap, const snow_options *options);

/* Zeroed, aligned to 64 bytes. NULL when count * size overflows, passes the
   limit, or the allocator has none: `refusal` then says which. */
void *snow_heap_get(snow_heap *heap, size_t count, size_t size);

/* The same, not zeroed. */
void *snow_heap_get_raw(snow_heap *heap, size_t count, size_t size);

void snow_heap_put(snow_heap *heap, void *block);

/* A block of another size that begins with the first items of this one, which is
   given back (NULL: there is none). NULL as above: then the old one stays. */
void *snow_heap_move(snow_heap *heap, void *block, size_t kept, size_t count, size_t size);

#endif
