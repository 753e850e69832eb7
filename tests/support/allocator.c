#include "allocator.h"

#include "check.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define LIVE UINT64_C(0x4c495645424c4f4b)
#define DEAD UINT64_C(0x44454144424c4f4b)

/* Stands before each block; keeps the alignment of malloc(). */
typedef union header {
    struct {
        size_t size;
        uint64_t mark;
        void *raw;
    } block;
    max_align_t alignment;
} header;

static void *allocate(void *context, size_t size)
{
    test_allocator *allocator = context;
    assert_true(size > 0);
    allocator->calls++;
    bool later = allocator->fail_after && allocator->calls > allocator->fail_at;
    if (allocator->fail_at > 0 && (allocator->calls == allocator->fail_at || later))
        return NULL;
    char *raw = malloc(allocator->shift + sizeof(header) + size);
    if (raw == NULL)
        return NULL;
    header *block = (header *)(void *)(raw + allocator->shift);
    block->block.raw = raw;
    block->block.size = size;
    block->block.mark = LIVE;
    memset(block + 1, 0xa5, size);
    allocator->live_blocks++;
    allocator->live_bytes += size;
    if (allocator->live_bytes > allocator->peak_bytes)
        allocator->peak_bytes = allocator->live_bytes;
    return block + 1;
}

static void release(void *context, void *memory)
{
    test_allocator *allocator = context;
    assert_non_null(memory);
    header *block = (header *)memory - 1;
    assert_true(block->block.mark == LIVE);
    block->block.mark = DEAD;
    allocator->live_blocks--;
    allocator->live_bytes -= block->block.size;
    free(block->block.raw);
}

snow_options allocator_options(test_allocator *allocator)
{
    snow_options options;
    snow_options_init(&options, sizeof options);
    options.allocate = allocate;
    options.release = release;
    options.allocator_context = allocator;
    return options;
}
