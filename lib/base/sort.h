/* Sorting in place: the C library's qsort() may take memory of its own, which the caller's allocator would not see. */
#ifndef SNOW_BASE_SORT_H
#define SNOW_BASE_SORT_H

#include <stddef.h>

/* Ascending by `compare`, which answers as for qsort(). Equal elements end in any order. Cost: count log count. */
void snow_sort(void *elements, size_t count, size_t size, int (*compare)(const void *, const void *));

#endif
