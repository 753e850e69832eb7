#include "base/stream.h"

#include "base/options.h"

#include <string.h>

static snow_status make_room(snow_text *text, size_t *capacity)
{
    if (text->size < *capacity)
        return SNOW_OK;
    size_t half = *capacity == 0 ? 65536 : *capacity;
    unsigned char *larger = snow_heap_get_raw(&text->heap, half, 2);
    if (larger == NULL)
        return text->heap.refusal;
    if (text->size > 0)
        memcpy(larger, text->bytes, text->size);
    snow_heap_put(&text->heap, text->bytes);
    text->bytes = larger;
    *capacity = 2 * half;
    return SNOW_OK;
}

/* The text grows with what has arrived, never with what the data promise. */
static snow_status read_all(snow_text *text, snow_reader read, void *context)
{
    size_t capacity = 0;
    for (;;) {
        snow_status status = make_room(text, &capacity);
        if (status != SNOW_OK)
            return status;
        size_t room = capacity - text->size;
        size_t got = 0;
        if (read(context, text->bytes + text->size, room, &got) != 0 || got > room)
            return SNOW_ERROR_READ;
        if (got == 0)
            return SNOW_OK;
        text->size += got;
    }
}

snow_status snow_text_read(snow_text *text, snow_reader read, void *context, const snow_options *options)
{
    snow_options settled;
    snow_status status = snow_options_settle(options, &settled);
    *text = (snow_text){.bytes = NULL};
    if (status != SNOW_OK)
        return status;
    snow_heap_start(&text->heap, &settled);
    status = read_all(text, read, context);
    if (status != SNOW_OK)
        snow_text_end(text);
    return status;
}

void snow_text_end(snow_text *text)
{
    snow_heap_put(&text->heap, text->bytes);
    text->bytes = NULL;
    text->size = 0;
}

static int count(void *context, const void *bytes, size_t size)
{
    (void)bytes;
    *(uint64_t *)context += size;
    return 0;
}

static int append(void *context, const void *bytes, size_t size)
{
    unsigned char **end = context;
    memcpy(*end, bytes, size);
    *end += size;
    return 0;
}

snow_status snow_save_whole(const snow_grid *grid, snow_saver save, void *buffer, size_t capacity, size_t *size)
{
    uint64_t total = 0;
    snow_status status = save(grid, count, &total);
    if (status != SNOW_OK)
        return status;
    if (total > SIZE_MAX)
        return SNOW_ERROR_TOO_LARGE;
    *size = (size_t)total;
    if (buffer == NULL)
        return SNOW_OK;
    if (capacity < *size)
        return SNOW_ERROR_BUFFER;
    unsigned char *end = buffer;
    return save(grid, append, &end);
}
