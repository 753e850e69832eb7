#include "base/bytes.h"

#include <string.h>

static void flush(snow_sink *sink)
{
    if (!sink->failed && sink->filled > 0)
        sink->failed = sink->write(sink->context, sink->staged, sink->filled) != 0;
    sink->filled = 0;
}

static void put(snow_sink *sink, uint64_t value, size_t size)
{
    if (sink->filled + size > sizeof sink->staged)
        flush(sink);
    for (size_t i = 0; i < size; i++)
        sink->staged[sink->filled++] = (unsigned char)(value >> (8 * i));
    snow_digest_add(&sink->checksum, value, size);
}

void snow_sink_start(snow_sink *sink, snow_writer write, void *context)
{
    sink->write = write;
    sink->context = context;
    sink->failed = false;
    sink->filled = 0;
    snow_digest_start(&sink->checksum);
}

void snow_sink_u8(snow_sink *sink, uint8_t value)
{
    put(sink, value, 1);
}

void snow_sink_u32(snow_sink *sink, uint32_t value)
{
    put(sink, value, 4);
}

void snow_sink_u64(snow_sink *sink, uint64_t value)
{
    put(sink, value, 8);
}

void snow_sink_double(snow_sink *sink, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(sink, bits, 8);
}

void snow_sink_end(snow_sink *sink)
{
    put(sink, snow_digest_end(&sink->checksum), 8);
    flush(sink);
}

static uint64_t take(snow_source *source, size_t size)
{
    if (snow_source_left(source) < size) {
        source->truncated = true;
        source->next = source->end;
        return 0;
    }
    uint64_t value = 0;
    for (size_t i = 0; i < size; i++)
        value |= (uint64_t)source->next[i] << (8 * i);
    source->next += size;
    return value;
}

uint8_t snow_source_u8(snow_source *source)
{
    return (uint8_t)take(source, 1);
}

uint32_t snow_source_u32(snow_source *source)
{
    return (uint32_t)take(source, 4);
}

uint64_t snow_source_u64(snow_source *source)
{
    return take(source, 8);
}

double snow_source_double(snow_source *source)
{
    uint64_t bits = take(source, 8);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

size_t snow_source_left(const snow_source *source)
{
    return (size_t)(source->end - source->next);
}
