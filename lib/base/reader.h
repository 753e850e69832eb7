/* All that a caller's reader gives. */
#ifndef SNOW_BASE_READER_H
#define SNOW_BASE_READER_H

#include "base/heap.h"

#include <snowgrowth/grid.h>

/* The bytes are to be given back to the heap, also on failure; they may be NULL. */
snow_status snow_reader_all(snow_reader read, void *context, snow_heap *heap, unsigned char **bytes, size_t *size);

#endif
