/* A 64-bit fingerprint of a stream of bytes. Each step is a bijection of the
   state, so a change of any one word always changes the result. Guards against
   accidents, not against forgery. */
#ifndef SNOW_BASE_DIGEST_H
#define SNOW_BASE_DIGEST_H

#include <stddef.h>
#include <stdint.h>

typedef struct snow_digest_state {
    uint64_t hash;
    uint64_t word; /* the bytes that do not fill a word yet */
    unsigned held; /* how many they are */
    uint64_t total;
} snow_digest_state;

void snow_digest_start(snow_digest_state *state);

/* Adds the lowest `size` <= 8 bytes of a value, lowest first. */
void snow_digest_add(snow_digest_state *state, uint64_t value, size_t size);

void snow_digest_add_double(snow_digest_state *state, double value);

/* The digest of all that was added; the state stays as it is. */
uint64_t snow_digest_end(const snow_digest_state *state);

#endif
