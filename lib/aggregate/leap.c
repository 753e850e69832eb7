#include "aggregate/leap.h"

static size_t places(int size)
{
    return ((size_t)2 << size) + 1;
}

/* The law of twice as many steps. Sums and products of positive numbers keep their relative error small. */
static void convolve(const double *law, size_t count, double *twice)
{
    for (size_t i = 0; i < 2 * count - 1; i++) {
        size_t first = i < count ? 0 : i - count + 1;
        size_t last = i < count ? i : count - 1;
        double sum = 0;
        for (size_t j = first; j <= last; j++)
            sum += law[j] * law[i - j];
        twice[i] = sum;
    }
}

/* Places that are less likely than the average are filled up by one that is more likely. */
static void make_alias(const snow_leap *leap, const double *law, size_t count, uint16_t *stack)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += law[i];
    size_t small = 0;
    size_t large = count;
    for (size_t i = 0; i < count; i++) {
        leap->keep[i] = law[i] / sum * (double)count;
        leap->alias[i] = (uint16_t)i;
        if (leap->keep[i] < 1)
            stack[small++] = (uint16_t)i;
        else
            stack[--large] = (uint16_t)i;
    }
    while (small > 0 && large < count) {
        uint16_t poor = stack[--small];
        uint16_t rich = stack[large];
        leap->alias[poor] = rich;
        leap->keep[rich] -= 1 - leap->keep[poor];
        if (leap->keep[rich] < 1) {
            large++;
            stack[small++] = rich;
        }
    }
    while (small > 0)
        leap->keep[stack[--small]] = 1;
}

static snow_status make_leaps(snow_leaps *leaps, snow_heap *heap, double *law, double *twice, uint16_t *stack)
{
    law[0] = law[1] = law[2] = 1.0 / 3.0;
    for (int size = 0; size < SNOW_LEAP_SIZES; size++) {
        snow_leap *leap = &leaps->leap[size];
        size_t count = places(size);
        leap->keep = snow_heap_get(heap, count, sizeof *leap->keep);
        if (leap->keep == NULL)
            return heap->refusal;
        leap->alias = snow_heap_get(heap, count, sizeof *leap->alias);
        if (leap->alias == NULL)
            return heap->refusal;
        make_alias(leap, law, count, stack);
        convolve(law, count, twice);
        double *swap = law;
        law = twice;
        twice = swap;
    }
    return SNOW_OK;
}

snow_status snow_leaps_start(snow_leaps *leaps, snow_heap *heap)
{
    size_t count = places(SNOW_LEAP_SIZES);
    *leaps = (snow_leaps){{{0}}};
    double *law = snow_heap_get(heap, 2 * count, sizeof *law);
    if (law == NULL)
        return heap->refusal;
    uint16_t *stack = snow_heap_get(heap, count, sizeof *stack);
    snow_status status = stack != NULL ? make_leaps(leaps, heap, law, law + count, stack) : heap->refusal;
    snow_heap_put(heap, stack);
    snow_heap_put(heap, law);
    return status;
}

void snow_leaps_end(snow_leaps *leaps, snow_heap *heap)
{
    for (int size = 0; size < SNOW_LEAP_SIZES; size++) {
        snow_heap_put(heap, leaps->leap[size].keep);
        snow_heap_put(heap, leaps->leap[size].alias);
    }
    *leaps = (snow_leaps){{{0}}};
}

static int64_t draw(const snow_leap *leap, snow_stream *stream, int size)
{
    uint32_t place = snow_stream_below(stream, (uint32_t)places(size));
    if (snow_stream_uniform(stream) >= leap->keep[place])
        place = leap->alias[place];
    return (int64_t)place - (INT64_C(1) << size);
}

int64_t snow_leaps_draw(const snow_leaps *leaps, snow_stream *stream, int64_t steps)
{
    int64_t sum = 0;
    for (int size = SNOW_LEAP_SIZES - 1; size >= 0; size--) {
        int64_t length = INT64_C(1) << size;
        for (; steps >= length; steps -= length)
            sum += draw(&leaps->leap[size], stream, size);
    }
    return sum;
}
