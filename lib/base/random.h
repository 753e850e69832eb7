/* Counter-based random numbers: Philox4x32-10 of J. K. Salmon, M. A. Moraes,
   R. O. Dror and D. E. Shaw, "Parallel random numbers: as easy as 1, 2, 3",
   SC'11 (2011). The number is a function of key and counter alone, so it does
   not matter who draws it, or when. */
#ifndef SNOW_BASE_RANDOM_H
#define SNOW_BASE_RANDOM_H

#include <stdint.h>

typedef struct snow_random_block {
    uint32_t word[4];
} snow_random_block;

/* Philox's constants, for those who compute several blocks at a time. */
enum { SNOW_RANDOM_ROUNDS = 10 };
#define SNOW_RANDOM_MULTIPLIER_0 0xD2511F53u
#define SNOW_RANDOM_MULTIPLIER_1 0xCD9E8D57u
#define SNOW_RANDOM_WEYL_0 0x9E3779B9u
#define SNOW_RANDOM_WEYL_1 0xBB67AE85u

snow_random_block snow_random_draw(uint64_t key, snow_random_block counter);

/* What the numbers are for: streams of different use never meet. */
typedef enum snow_random_use {
    SNOW_RANDOM_NOISE = 1,
    SNOW_RANDOM_CLUSTER = 2,
    SNOW_RANDOM_SCATTER = 3,
    SNOW_RANDOM_SAMPLE = 4,
    SNOW_RANDOM_HARDNESS = 5,
    SNOW_RANDOM_WALK = 6,
    SNOW_RANDOM_JUMPS = 7
} snow_random_use;

/* Uniform in [0, 1), a multiple of 2^-53, for one cell. */
double snow_random_at(uint64_t key, snow_random_use use, int32_t q, int32_t r, uint32_t turn);

#endif
