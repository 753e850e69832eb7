#include "base/digest.h"

#include <string.h>

/* The finaliser's constants of G. L. Steele, D. Lea and C. H. Flood, "Fast
   splittable pseudorandom number generators", OOPSLA 2014 (variant 13 of D. Stafford). */
static uint64_t stir(uint64_t hash, uint64_t word)
{
    hash ^= word;
    hash = (hash ^ hash >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    hash = (hash ^ hash >> 27) * UINT64_C(0x94D049BB133111EB);
    return hash ^ hash >> 31;
}

void snow_digest_start(snow_digest_state *state)
{
    *state = (snow_digest_state){.hash = UINT64_C(0x9E3779B97F4A7C15)};
}

void snow_digest_add(snow_digest_state *state, uint64_t value, size_t size)
{
    state->total += size;
    if (state->held == 0 && size == 8) {
        state->hash = stir(state->hash, value);
        return;
    }
    for (size_t i = 0; i < size; i++) {
        state->word |= (value >> (8 * i) & 0xFF) << (8 * state->held);
        if (++state->held == 8) {
            state->hash = stir(state->hash, state->word);
            state->word = 0;
            state->held = 0;
        }
    }
}

void snow_digest_add_double(snow_digest_state *state, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    snow_digest_add(state, bits, 8);
}

uint64_t snow_digest_end(const snow_digest_state *state)
{
    return stir(stir(state->hash, state->word), state->total);
}
