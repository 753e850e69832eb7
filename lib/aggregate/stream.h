/* One walker's own random numbers: a Philox stream chosen by the grid's seed,
   what it is for, and the walker's number. Nothing here needs libm. One draw an
   expression: compilers may take two in any order. */
#ifndef SNOW_AGGREGATE_STREAM_H
#define SNOW_AGGREGATE_STREAM_H

#include "base/random.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct snow_stream {
    uint64_t key;
    snow_random_block counter;
    snow_random_block drawn;
    unsigned left; /* words of drawn that are not used yet */
} snow_stream;

static inline snow_stream snow_stream_start(uint64_t key, snow_random_use use, uint64_t walker)
{
    return (snow_stream){key, {{0, (uint32_t)walker, (uint32_t)(walker >> 32), (uint32_t)use}}, {{0}}, 0};
}

static inline uint32_t snow_stream_u32(snow_stream *stream)
{
    if (stream->left == 0) {
        stream->drawn = snow_random_draw(stream->key, stream->counter);
        stream->counter.word[0]++;
        stream->left = 4;
    }
    return stream->drawn.word[--stream->left];
}

static inline uint64_t snow_stream_u64(snow_stream *stream)
{
    uint64_t high = snow_stream_u32(stream);
    return high << 32 | snow_stream_u32(stream);
}

/* Uniform in 0 ... count - 1; count > 0. D. Lemire, ACM Trans. Model. Comput. Simul. 29 (2019) 3. */
static inline uint32_t snow_stream_below(snow_stream *stream, uint32_t count)
{
    uint64_t product = (uint64_t)snow_stream_u32(stream) * count;
    if ((uint32_t)product < count) {
        uint32_t least = (0u - count) % count;
        while ((uint32_t)product < least)
            product = (uint64_t)snow_stream_u32(stream) * count;
    }
    return (uint32_t)(product >> 32);
}

/* Uniform in [0, 1), a multiple of 2^-53. */
static inline double snow_stream_uniform(snow_stream *stream)
{
    return (double)(snow_stream_u64(stream) >> 11) * 0x1p-53;
}

/* True with this chance. No number is drawn for a sure thing. */
static inline bool snow_stream_chance(snow_stream *stream, double chance)
{
    return chance >= 1 || snow_stream_uniform(stream) < chance;
}

typedef struct snow_direction {
    double x;
    double y;
} snow_direction;

/* A uniform point of the unit circle: the square of a uniform point of the disc, made a unit number. */
static inline snow_direction snow_stream_direction(snow_stream *stream)
{
    for (;;) {
        double a = (double)(int32_t)snow_stream_u32(stream) * 0x1p-31;
        double b = (double)(int32_t)snow_stream_u32(stream) * 0x1p-31;
        double square = a * a + b * b;
        if (square <= 1 && square > 0x1p-40)
            return (snow_direction){(a * a - b * b) / square, 2 * a * b / square};
    }
}

#endif
