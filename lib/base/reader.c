#include "base/reader.h"

#include <string.h>

typedef struct growing_buffer {
    unsigned char *bytes;
    size_t size;
    size_t capacity;
} growing_buffer;

static snow_status make_room(growing_buffer *buffer, snow_heap *heap)
{
    if (buffer->size < buffer->capacity)
        return SNOW_OK;
    size_t capacity = buffer->capacity == 0 ? 65536 : buffer->capacity;
    unsigned char *larger = snow_heap_get_raw(heap, capacity, 2);
    if (larger == NULL)
        return heap->refusal;
    if (buffer->size > 0)
        memcpy(larger, buffer->bytes, buffer->size);
    snow_heap_put(heap, buffer->bytes);
    buffer->bytes = larger;
    buffer->capacity = 2 * capacity;
    return SNOW_OK;
}

/* The buffer grows with what has arrived, never with what the data promise. */
static snow_status read_all(growing_buffer *buffer, snow_heap *heap, snow_reader read, void *context)
{
    for (;;) {
        snow_status status = make_room(buffer, heap);
        if (status != SNOW_OK)
            return status;
        size_t room = buffer->capacity - buffer->size;
        size_t got = 0;
        if (read(context, buffer->bytes + buffer->size, room, &got) != 0 || got > room)
            return SNOW_ERROR_READ;
        if (got == 0)
            return SNOW_OK;
        buffer->size += got;
    }
}

snow_status snow_reader_all(snow_reader read, void *context, snow_heap *heap, unsigned char **bytes, size_t *size)
{
    growing_buffer buffer = {NULL, 0, 0};
    snow_status status = read_all(&buffer, heap, read, context);
    *bytes = buffer.bytes;
    *size = buffer.size;
    return status;
}
