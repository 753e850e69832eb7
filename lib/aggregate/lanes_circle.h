/* Points of blurred circles (blur.h) for eight walkers at once: those who come in
   from far away, and those who leave hexagons through circles.
   The same operations on doubles as in source.c, and so the same sites. */
#ifndef SNOW_AGGREGATE_LANES_CIRCLE_H
#define SNOW_AGGREGATE_LANES_CIRCLE_H

#include "aggregate/blur.h"
#include "aggregate/lanes.h"

#include <string.h>

#define HALF_SQRT_3 0.86602540378443864676

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

typedef struct point {
    reals x, y;
} point;

/* snow_direction_of() */
INLINE point direction_of(words number)
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
    return (point){(reals)x, (reals)y};
}

INLINE point point_of(bool hexagonal, words x, words y)
{
    reals from_x = real_of(x) - 0x1p31;
    reals from_y = real_of(y) - 0x1p31;
    if (hexagonal)
        return (point){from_x + from_y * 0.5, from_y * HALF_SQRT_3};
    return (point){from_x, from_y};
}

typedef struct cell {
    words x, y; /* in the lower halves */
} cell;

INLINE cell site_at(bool hexagonal, point p)
{
    if (!hexagonal)
        return (cell){whole_of(p.x), whole_of(p.y)};
    reals row = nearest(p.y * (1 / HALF_SQRT_3));
    return (cell){whole_of(p.x - row * 0.5), whole_of(row)};
}

/* return_to_circle() */
INLINE point return_to_circle(reals radius, point from, point u)
{
    reals square = from.x * from.x + from.y * from.y;
    reals ax = radius * from.x / square;
    reals ay = radius * from.y / square;
    reals top_x = u.x + ax;
    reals top_y = u.y + ay;
    reals bottom_x = 1 + ax * u.x + ay * u.y;
    reals bottom_y = ax * u.y - ay * u.x;
    reals scale = radius / (bottom_x * bottom_x + bottom_y * bottom_y);
    return (point){(top_x * bottom_x + top_y * bottom_y) * scale, (top_y * bottom_x - top_x * bottom_y) * scale};
}

/* Those who are thrown onto a circle, each to a lane of 64 bits. */
typedef struct thrown {
    words x, y;     /* + 2^31 */
    words comes_in; /* masks; from infinity, or not */
    words is_back;
    words hexagon; /* the radius of that which another leaves */
} thrown;

/* snow_source_come_in(), and snow_source_circle() from the origin */
INLINE cell throw_from(const snow_source_of_walkers *source, bool hexagonal, bool some_are_back, thrown who, words number)
{
    reals blur = blur_of(number);
    point unit = direction_of(number);
    reals inside = (reals){0} + (double)source->rim;
    if (hexagonal)
        inside = chosen(who.comes_in, inside, real_of(who.hexagon) * HALF_SQRT_3 - (1 + SNOW_BLUR_WIDTH));
    reals radius = inside + blur;
    point to = {radius * unit.x, radius * unit.y};
    if (some_are_back) {
        point back = return_to_circle(blur + (double)(source->far / 2), point_of(hexagonal, who.x, who.y), unit);
        to.x = chosen(who.is_back, back.x, to.x);
        to.y = chosen(who.is_back, back.y, to.y);
    }
    return site_at(hexagonal, to);
}

typedef struct sites {
    lanes x, y;
} sites;

/* `comes_in` is a mask; the others leave hexagons of these radii. */
INLINE sites throw_all(const snow_source_of_walkers *source, bool hexagonal, sites from, lanes comes_in, lanes hexagon,
                       wide number)
{
    lanes is_back = _mm256_andnot_si256(_mm256_cmpeq_epi32(from.x, all(SNOW_SOURCE_INFINITY)), comes_in);
    bool some_are_back = !_mm256_testz_si256(is_back, is_back);
    wide x = widened(_mm256_add_epi32(from.x, all(UINT32_C(1) << 31)));
    wide y = widened(_mm256_add_epi32(from.y, all(UINT32_C(1) << 31)));
    wide in = widened_mask(comes_in);
    wide back = widened_mask(is_back);
    wide radius = widened(hexagon);
#if defined(__AVX512F__)
    thrown who = {(words)x, (words)y, (words)in, (words)back, (words)radius};
    cell to = throw_from(source, hexagonal, some_are_back, who, (words)number);
    wide to_x = (wide)to.x;
    wide to_y = (wide)to.y;
#else
    thrown even = {(words)x.even, (words)y.even, (words)in.even, (words)back.even, (words)radius.even};
    thrown odd = {(words)x.odd, (words)y.odd, (words)in.odd, (words)back.odd, (words)radius.odd};
    cell even_to = throw_from(source, hexagonal, some_are_back, even, (words)number.even);
    cell odd_to = throw_from(source, hexagonal, some_are_back, odd, (words)number.odd);
    wide to_x = {(lanes)even_to.x, (lanes)odd_to.x};
    wide to_y = {(lanes)even_to.y, (lanes)odd_to.y};
#endif
    return (sites){_mm256_add_epi32(lower_halves(to_x), _mm256_andnot_si256(comes_in, from.x)),
                   _mm256_add_epi32(lower_halves(to_y), _mm256_andnot_si256(comes_in, from.y))};
}

#endif
