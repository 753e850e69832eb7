/* Many of the three moves at once: 2^j sideways steps of −1, 0 or 1, equally
   likely, drawn from their exact sum. */
#ifndef SNOW_AGGREGATE_LEAP_H
#define SNOW_AGGREGATE_LEAP_H

#include "aggregate/stream.h"
#include "base/heap.h"

enum { SNOW_LEAP_SIZES = 10 }; /* the longest is of 2^9 steps */

/* A. J. Walker's alias method (ACM Trans. Math. Softw. 3 (1977) 253). */
typedef struct snow_leap {
    double *keep;    /* the chance to keep a place that was drawn */
    uint16_t *alias; /* else this one is taken */
} snow_leap;

typedef struct snow_leaps {
    snow_leap leap[SNOW_LEAP_SIZES];
} snow_leaps;

snow_status snow_leaps_start(snow_leaps *leaps, snow_heap *heap);
void snow_leaps_end(snow_leaps *leaps, snow_heap *heap);

/* How far sideways `steps` moves lead. */
int64_t snow_leaps_draw(const snow_leaps *leaps, snow_stream *stream, int64_t steps);

/* Keeps a position between walls halfway between sites, or round a ring. */
static inline int32_t snow_leap_fold(int64_t x, int32_t width, bool periodic)
{
    int64_t period = periodic ? width : 2 * (int64_t)width;
    x %= period;
    x = x < 0 ? x + period : x;
    return (int32_t)(x < width ? x : period - 1 - x);
}

#endif
