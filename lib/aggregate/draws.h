/* The numbers of one walker of the jump engine: its own Philox stream, two
   numbers a block, computed eight blocks at a time, in vectors. */
#ifndef SNOW_AGGREGATE_DRAWS_H
#define SNOW_AGGREGATE_DRAWS_H

#include "base/random.h"

#include <snowgrowth/options.h>

#include <stdint.h>

enum { SNOW_DRAWS_AT_ONCE = 16 };

typedef struct snow_draws snow_draws;

/* The sixteen numbers from the one that comes next on. */
typedef void (*snow_draws_refill)(snow_draws *draws);

struct snow_draws {
    uint64_t number[SNOW_DRAWS_AT_ONCE];
    uint32_t used; /* so far */
    uint64_t key;
    uint64_t walker;
    snow_draws_refill refill;
};

/* All give the same numbers. */
void snow_draws_refill_baseline(snow_draws *draws);
void snow_draws_refill_avx2(snow_draws *draws);
snow_draws_refill snow_draws_choose(snow_isa isa);

/* The stream of a walker that has used so many. */
void snow_draws_start(snow_draws *draws, snow_draws_refill refill, uint64_t key, uint64_t walker, uint32_t used);

/* Back, or on, to when so many were used. */
void snow_draws_move(snow_draws *draws, uint32_t used);

/* The number that comes next. */
static inline uint64_t snow_draws_next(snow_draws *draws)
{
    if (draws->used % SNOW_DRAWS_AT_ONCE == 0)
        draws->refill(draws);
    return draws->number[draws->used++ % SNOW_DRAWS_AT_ONCE];
}

/* What is left of a block is not used. */
static inline void snow_draws_end_block(snow_draws *draws)
{
    if (draws->used % 2 != 0)
        (void)snow_draws_next(draws);
}

/* The next block that nothing is used of. */
static inline void snow_draws_take_block(snow_draws *draws, uint64_t number[2])
{
    snow_draws_end_block(draws);
    number[0] = snow_draws_next(draws);
    number[1] = snow_draws_next(draws);
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
