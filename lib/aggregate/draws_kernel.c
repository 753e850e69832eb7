/* Compiled once for each instruction set, with SNOW_KERNEL naming it. */
#include "aggregate/draws.h"

#define PASTE(a, b) a##b
#define NAME(a, b) PASTE(a, b)
#define REFILL(isa) NAME(snow_draws_refill_, isa)

enum { BLOCKS = SNOW_DRAWS_AT_ONCE / 2 };

/* Lanes of 64 bits, each with a word of a block in its lower half; what stands
   in the upper half does not matter. */
#if defined(__AVX2__)
#include <immintrin.h>
typedef __m256i lanes;
enum { LANES = 4 };
#define ALL(x) _mm256_set1_epi64x((long long)(x))
#define PLUS(a, b) _mm256_add_epi64(a, b)
#define FROM(x) PLUS(ALL(x), _mm256_set_epi64x(3, 2, 1, 0))
#define PRODUCT(a, b) _mm256_mul_epu32(a, b)
#define UPPER(a) _mm256_srli_epi64(a, 32)
#define XOR(a, b) _mm256_xor_si256(a, b)
#define JOIN(upper, lower) _mm256_blend_epi32(_mm256_slli_epi64(upper, 32), lower, 0x55)
#define STORE(to, a) _mm256_storeu_si256((__m256i *)(to), a)
static inline void store_pairs(uint64_t *to, lanes first, lanes second)
{
    lanes even = _mm256_unpacklo_epi64(first, second);
    lanes odd = _mm256_unpackhi_epi64(first, second);
    STORE(to, _mm256_permute2x128_si256(even, odd, 0x20));
    STORE(to + 4, _mm256_permute2x128_si256(even, odd, 0x31));
}
#elif defined(__SSE2__)
#include <emmintrin.h>
typedef __m128i lanes;
enum { LANES = 2 };
#define ALL(x) _mm_set1_epi64x((long long)(x))
#define PLUS(a, b) _mm_add_epi64(a, b)
#define FROM(x) PLUS(ALL(x), _mm_set_epi64x(1, 0))
#define PRODUCT(a, b) _mm_mul_epu32(a, b)
#define UPPER(a) _mm_srli_epi64(a, 32)
#define XOR(a, b) _mm_xor_si128(a, b)
#define JOIN(upper, lower) XOR(_mm_slli_epi64(upper, 32), _mm_and_si128(lower, ALL(0xFFFFFFFF)))
#define STORE(to, a) _mm_storeu_si128((__m128i *)(to), a)
static inline void store_pairs(uint64_t *to, lanes first, lanes second)
{
    STORE(to, _mm_unpacklo_epi64(first, second));
    STORE(to + 2, _mm_unpackhi_epi64(first, second));
}
#else
typedef uint64_t lanes;
enum { LANES = 1 };
#define ALL(x) ((uint64_t)(x))
#define PLUS(a, b) ((a) + (b))
#define FROM(x) ((uint64_t)(x))
#define PRODUCT(a, b) (((a) & 0xFFFFFFFF) * (b))
#define UPPER(a) ((a) >> 32)
#define XOR(a, b) ((a) ^ (b))
#define JOIN(upper, lower) ((upper) << 32 | ((lower) & 0xFFFFFFFF))
static inline void store_pairs(uint64_t *to, lanes first, lanes second)
{
    to[0] = first;
    to[1] = second;
}
#endif

enum { VECTORS = BLOCKS / LANES };

/* snow_random_draw() for a block in each lane: its words make two numbers. */
void REFILL(SNOW_KERNEL)(snow_draws *draws)
{
    lanes a[VECTORS];
    lanes b[VECTORS];
    lanes c[VECTORS];
    lanes d[VECTORS];
    for (int i = 0; i < VECTORS; i++) {
        a[i] = FROM(draws->used / 2 + (uint32_t)i * LANES);
        b[i] = ALL((uint32_t)draws->walker);
        c[i] = ALL(draws->walker >> 32);
        d[i] = ALL(SNOW_RANDOM_JUMPS);
    }
    lanes key_0 = ALL((uint32_t)draws->key);
    lanes key_1 = ALL(draws->key >> 32);
    for (int round = 0; round < SNOW_RANDOM_ROUNDS; round++) {
        for (int i = 0; i < VECTORS; i++) {
            lanes product_0 = PRODUCT(a[i], ALL(SNOW_RANDOM_MULTIPLIER_0));
            lanes product_1 = PRODUCT(c[i], ALL(SNOW_RANDOM_MULTIPLIER_1));
            a[i] = XOR(XOR(UPPER(product_1), b[i]), key_0);
            c[i] = XOR(XOR(UPPER(product_0), d[i]), key_1);
            b[i] = product_1;
            d[i] = product_0;
        }
        key_0 = PLUS(key_0, ALL(SNOW_RANDOM_WEYL_0));
        key_1 = PLUS(key_1, ALL(SNOW_RANDOM_WEYL_1));
    }
    for (size_t i = 0; i < VECTORS; i++)
        store_pairs(draws->number + 2 * i * LANES, JOIN(b[i], a[i]), JOIN(d[i], c[i]));
}
