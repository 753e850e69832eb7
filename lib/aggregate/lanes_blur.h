/* blur.h for eight walkers at once: the same operations on doubles, and so the same bits. */
#ifndef SNOW_AGGREGATE_LANES_BLUR_H
#define SNOW_AGGREGATE_LANES_BLUR_H

#include "aggregate/blur.h"
#include "aggregate/lanes.h"

#include <string.h>

/* Vectors as compilers know them: of numbers of 64 bits, and of doubles. */
#if defined(__AVX512F__)
enum { WORDS = 8 };
#else
enum { WORDS = 4 };
#endif
typedef uint64_t words __attribute__((vector_size(8 * WORDS)));
typedef int64_t signed_words __attribute__((vector_size(8 * WORDS)));
typedef double reals __attribute__((vector_size(8 * WORDS)));

INLINE words mask_of_sign(words a)
{
    return (words)((signed_words)a < 0);
}

INLINE reals chosen(words mask, reals yes, reals no)
{
    return (reals)(((words)yes & mask) | ((words)no & ~mask));
}

/* Whole numbers below 2^52. */
INLINE reals real_of(words a)
{
    const uint64_t exponent = UINT64_C(0x433) << 52;
    return (reals)(a | exponent) - 0x1p52;
}

INLINE reals nearest(reals a)
{
    return (a + 0x1.8p52) - 0x1.8p52;
}

/* The nearest whole number. */
INLINE words whole_of(reals a)
{
    return (words)(a + 0x1.8p52);
}

INLINE lanes blur_sums(lanes number)
{
    const lanes nibble = _mm256_set1_epi8(15);
    int64_t weight[2];
    int64_t scale;
    memcpy(weight, snow_blur_weight, sizeof weight);
    memcpy(&scale, snow_blur_scale, sizeof scale);
    lanes lower = _mm256_maddubs_epi16(_mm256_and_si256(number, nibble), _mm256_set1_epi64x(weight[0]));
    lanes upper = _mm256_maddubs_epi16(_mm256_and_si256(_mm256_srli_epi16(number, 4), nibble),
                                       _mm256_set1_epi64x(weight[1]));
    lanes halves = _mm256_madd_epi16(_mm256_add_epi16(lower, upper), _mm256_set1_epi64x(scale));
    return _mm256_add_epi32(halves, _mm256_srli_epi64(halves, 32));
}

/* snow_blur() */
INLINE reals blur_of(words number)
{
#if defined(__AVX512F__)
    lanes lower = blur_sums(_mm512_castsi512_si256((__m512i)number));
    lanes upper = blur_sums(_mm512_extracti64x4_epi64((__m512i)number, 1));
    words sum = (words)_mm512_inserti64x4(_mm512_castsi256_si512(lower), upper, 1);
#else
    words sum = (words)blur_sums((lanes)number);
#endif
    return real_of(sum & UINT32_MAX) * (1.0 / (1 << SNOW_BLUR_BITS));
}

INLINE reals power_series(const double *term, int terms, reals x)
{
    reals sum = x * term[terms - 1] + term[terms - 2];
    _Pragma("GCC unroll 8") for (int i = terms - 3; i >= 0; i--)
        sum = sum * x + term[i];
    return sum;
}

typedef struct vector {
    reals x, y;
} vector;

/* snow_direction_of() */
INLINE vector direction_of(words number)
{
    const uint64_t places = UINT64_C(1) << SNOW_DIRECTION_BITS;
    const uint64_t sign = UINT64_C(1) << 63;
    reals t = (real_of(number >> SNOW_DIRECTION_SHIFT & (places - 1)) + 0.5) * (1.0 / (double)places);
    reals square = t * t;
    reals cosine = power_series(snow_cosine, SNOW_COSINE_TERMS, square);
    reals sine = t * power_series(snow_sine, SNOW_SINE_TERMS, square);
    words swaps = mask_of_sign(number << 2);
    words x = (words)chosen(swaps, sine, cosine) ^ (number & sign);
    words y = (words)chosen(swaps, cosine, sine) ^ (number << 1 & sign);
    return (vector){(reals)x, (reals)y};
}

/* Coordinates to which 2^31 was added. */
INLINE reals coordinate_of(words a)
{
    return real_of(a) - 0x1p31;
}

INLINE wide lifted(lanes coordinate)
{
    return widened(_mm256_add_epi32(coordinate, all(UINT32_C(1) << 31)));
}

INLINE bool any(lanes mask)
{
    return !_mm256_testz_si256(mask, mask);
}

/* Those who come in, and not from infinity. */
INLINE lanes is_back_from_afar(lanes x, lanes comes_in)
{
    return _mm256_andnot_si256(_mm256_cmpeq_epi32(x, all(SNOW_SOURCE_INFINITY)), comes_in);
}

#endif
