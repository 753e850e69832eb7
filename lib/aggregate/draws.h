/* The numbers of one walker of the jump engine: its own Philox stream, computed
   many blocks at a time, so that compilers can do it in vectors. */
#ifndef SNOW_AGGREGATE_DRAWS_H
#define SNOW_AGGREGATE_DRAWS_H

#include "base/random.h"

#include <stdint.h>

enum { SNOW_DRAWS_BLOCKS = 16, SNOW_DRAWS_NUMBERS = 2 * SNOW_DRAWS_BLOCKS };

typedef struct snow_draws {
    uint64_t number[SNOW_DRAWS_NUMBERS];
    uint32_t next;
    uint32_t block; /* counter of the first block to come */
    uint64_t key;
    uint64_t walker;
} snow_draws;

static inline void snow_draws_start(snow_draws *draws, uint64_t key, uint64_t walker)
{
    draws->next = SNOW_DRAWS_NUMBERS;
    draws->block = 0;
    draws->key = key;
    draws->walker = walker;
}

void snow_draws_refill(snow_draws *draws);

static inline uint64_t snow_draws_next(snow_draws *draws)
{
    if (draws->next == SNOW_DRAWS_NUMBERS)
        snow_draws_refill(draws);
    return draws->number[draws->next++];
}

/* Uniform in 0 … count − 1, each as likely as the others to count/2^64. */
static inline uint32_t snow_draws_below(snow_draws *draws, uint32_t count)
{
    uint64_t bits = snow_draws_next(draws);
    uint64_t low = (bits & 0xFFFFFFFF) * count;
    return (uint32_t)(((bits >> 32) * count + (low >> 32)) >> 32);
}

/* Uniform in [0, 1), a multiple of 2^-53. */
static inline double snow_draws_uniform(snow_draws *draws)
{
    return (double)(snow_draws_next(draws) >> 11) * 0x1p-53;
}

#endif
