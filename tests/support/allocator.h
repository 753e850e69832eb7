/*
 * An allocator that counts, checks what it gets back, and can fail on demand.
 */
#ifndef TESTS_SUPPORT_ALLOCATOR_H
#define TESTS_SUPPORT_ALLOCATOR_H

#include <snowgrowth/snowgrowth.h>

#include <stdbool.h>
#include <stddef.h>

typedef struct test_allocator {
    size_t calls;       /* allocations asked for, the refused ones included */
    size_t fail_at;     /* refuses this call; 0: none */
    bool fail_after;    /* and all later ones */
    size_t shift;       /* moves every block by so many bytes, a multiple of 16 */
    size_t live_blocks; /* given and not yet released */
    size_t live_bytes;
    size_t peak_bytes;
} test_allocator;

/* Default options whose memory comes from the allocator. */
snow_options allocator_options(test_allocator *allocator);

#endif
