/* Between the caller's readers and writers, which take turns, and bytes that stand in one place. */
#ifndef SNOW_BASE_STREAM_H
#define SNOW_BASE_STREAM_H

#include "base/heap.h"

#include <snowgrowth/grid.h>

/* All that a reader gave. */
typedef struct snow_text {
    unsigned char *bytes; /* NULL: none */
    size_t size;
    snow_heap heap; /* that the bytes come from */
} snow_text;

/* Reads to the end, into memory as the options want it. On failure the text is empty. */
snow_status snow_text_read(snow_text *text, snow_reader read, void *context, const snow_options *options);
void snow_text_end(snow_text *text);

/* Puts into a buffer what `save` writes, on the terms of snow_save(). */
typedef snow_status (*snow_saver)(const snow_grid *grid, snow_writer write, void *context);
snow_status snow_save_whole(const snow_grid *grid, snow_saver save, void *buffer, size_t capacity, size_t *size);

#endif
