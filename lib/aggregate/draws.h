/* The numbers of one walker of the jump engine: its own Philox stream, computed
   four blocks at a time, in vectors, while the numbers before are used. */
#ifndef SNOW_AGGREGATE_DRAWS_H
#define SNOW_AGGREGATE_DRAWS_H

#include "base/random.h"

#include <snowgrowth/options.h>

#include <stdint.h>

enum { SNOW_DRAWS_HALF = 8 };

typedef struct snow_draws snow_draws;

/* The next eight numbers, in place of those from `first` on. */
typedef void (*snow_draws_refill)(snow_draws *draws, uint32_t first);

struct snow_draws {
    uint64_t number[2 * SNOW_DRAWS_HALF];
    uint32_t next;
    uint32_t block; /* counter of the first block to come */
    uint64_t key;
    uint64_t walker;
    snow_draws_refill refill;
};

/* All give the same numbers. */
void snow_draws_refill_baseline(snow_draws *draws, uint32_t first);
void snow_draws_refill_avx2(snow_draws *draws, uint32_t first);
snow_draws_refill snow_draws_choose(snow_isa isa);

/* The first numbers of a stream. */
void snow_draws_start(snow_draws *draws, snow_draws_refill refill, uint64_t key, uint64_t walker);

static inline uint64_t snow_draws_next(snow_draws *draws)
{
    uint32_t here = draws->next;
    uint64_t number = draws->number[here];
    draws->next = (here + 1) % (2 * SNOW_DRAWS_HALF);
    if (draws->next % SNOW_DRAWS_HALF == 0)
        draws->refill(draws, draws->next ^ SNOW_DRAWS_HALF);
    return number;
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
