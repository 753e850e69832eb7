/* Little-endian bytes in and out, the same on every platform, with a running checksum. */
#ifndef SNOW_BASE_BYTES_H
#define SNOW_BASE_BYTES_H

#include "base/digest.h"

#include <snowgrowth/grid.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Collects bytes and hands them to a writer. */
typedef struct snow_sink {
    snow_writer write;
    void *context;
    bool failed;
    snow_digest_state checksum;
    size_t filled;
    unsigned char staged[4096];
} snow_sink;

void snow_sink_start(snow_sink *sink, snow_writer write, void *context);
void snow_sink_u8(snow_sink *sink, uint8_t value);
void snow_sink_u32(snow_sink *sink, uint32_t value);
void snow_sink_u64(snow_sink *sink, uint64_t value);
void snow_sink_double(snow_sink *sink, double value);
/* Writes the checksum of all before it, and the last bytes. */
void snow_sink_end(snow_sink *sink);

/* Reads bytes from memory; past the end it reads zeros and remembers that. */
typedef struct snow_source {
    const unsigned char *next;
    const unsigned char *end;
    bool truncated;
} snow_source;

uint8_t snow_source_u8(snow_source *source);
uint32_t snow_source_u32(snow_source *source);
uint64_t snow_source_u64(snow_source *source);
double snow_source_double(snow_source *source);
size_t snow_source_left(const snow_source *source);

#endif
