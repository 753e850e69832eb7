#include "aggregate/draws.h"

enum { ROUNDS = 10 };

/* snow_random_draw() for consecutive counters, side by side. */
void snow_draws_refill(snow_draws *draws)
{
    uint32_t a[SNOW_DRAWS_BLOCKS];
    uint32_t b[SNOW_DRAWS_BLOCKS];
    uint32_t c[SNOW_DRAWS_BLOCKS];
    uint32_t d[SNOW_DRAWS_BLOCKS];
    for (uint32_t i = 0; i < SNOW_DRAWS_BLOCKS; i++) {
        a[i] = draws->block + i;
        b[i] = (uint32_t)draws->walker;
        c[i] = (uint32_t)(draws->walker >> 32);
        d[i] = SNOW_RANDOM_JUMPS;
    }
    uint32_t key_0 = (uint32_t)draws->key;
    uint32_t key_1 = (uint32_t)(draws->key >> 32);
    for (int round = 0; round < ROUNDS; round++) {
#pragma GCC unroll 1
        for (int i = 0; i < SNOW_DRAWS_BLOCKS; i++) {
            uint64_t product_0 = (uint64_t)0xD2511F53u * a[i];
            uint64_t product_1 = (uint64_t)0xCD9E8D57u * c[i];
            a[i] = (uint32_t)(product_1 >> 32) ^ b[i] ^ key_0;
            c[i] = (uint32_t)(product_0 >> 32) ^ d[i] ^ key_1;
            b[i] = (uint32_t)product_1;
            d[i] = (uint32_t)product_0;
        }
        key_0 += 0x9E3779B9u;
        key_1 += 0xBB67AE85u;
    }
    for (int i = 0; i < SNOW_DRAWS_BLOCKS; i++) {
        draws->number[2 * i] = (uint64_t)b[i] << 32 | a[i];
        draws->number[2 * i + 1] = (uint64_t)d[i] << 32 | c[i];
    }
    draws->block += SNOW_DRAWS_BLOCKS;
    draws->next = 0;
}
