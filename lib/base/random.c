#include "base/random.h"

snow_random_block snow_random_draw(uint64_t key, snow_random_block counter)
{
    uint32_t key_0 = (uint32_t)key;
    uint32_t key_1 = (uint32_t)(key >> 32);
    for (int round = 0; round < SNOW_RANDOM_ROUNDS; round++) {
        uint64_t product_0 = (uint64_t)SNOW_RANDOM_MULTIPLIER_0 * counter.word[0];
        uint64_t product_1 = (uint64_t)SNOW_RANDOM_MULTIPLIER_1 * counter.word[2];
        counter = (snow_random_block){{
            (uint32_t)(product_1 >> 32) ^ counter.word[1] ^ key_0,
            (uint32_t)product_1,
            (uint32_t)(product_0 >> 32) ^ counter.word[3] ^ key_1,
            (uint32_t)product_0,
        }};
        key_0 += SNOW_RANDOM_WEYL_0;
        key_1 += SNOW_RANDOM_WEYL_1;
    }
    return counter;
}

double snow_random_at(uint64_t key, snow_random_use use, int32_t q, int32_t r, uint32_t turn)
{
    snow_random_block counter = {{(uint32_t)q, (uint32_t)r, turn, (uint32_t)use}};
    snow_random_block drawn = snow_random_draw(key, counter);
    uint64_t bits = (uint64_t)drawn.word[1] << 32 | drawn.word[0];
    return (double)(bits >> 11) * 0x1p-53;
}
