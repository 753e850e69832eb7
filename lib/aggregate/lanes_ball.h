/* Points of blurred spheres for eight walkers at once: those who come in from far away, and
   those who leave balls. As in source.c, and so to the same sites. */
#ifndef SNOW_AGGREGATE_LANES_BALL_H
#define SNOW_AGGREGATE_LANES_BALL_H

#include "aggregate/lanes_blur.h"

typedef struct solid {
    reals x, y, z;
} solid;

INLINE reals root_of(reals a)
{
#if defined(__AVX512F__)
    return (reals)_mm512_sqrt_pd((__m512d)a);
#else
    return (reals)_mm256_sqrt_pd((__m256d)a);
#endif
}

INLINE reals distance_of(solid p)
{
    return root_of(p.x * p.x + p.y * p.y + p.z * p.z);
}

/* In -1 ... 1. */
INLINE reals centred(words number)
{
    return (real_of(number >> 32) + 0.5) * 0x1p-31 - 1.0;
}

/* Those who are thrown onto a sphere, each to a lane of 64 bits. */
typedef struct thrown {
    words x, y, z;  /* + 2^31 */
    words comes_in; /* masks; from infinity, or not */
    words is_back;
} thrown;

INLINE solid place_of(thrown who)
{
    return (solid){coordinate_of(who.x), coordinate_of(who.y), coordinate_of(who.z)};
}

/* unit_sphere() */
INLINE solid unit_sphere(words first, words second)
{
    reals z = centred(second);
    reals across = root_of(1.0 - z * z);
    vector round = direction_of(first);
    return (solid){across * round.x, across * round.y, z};
}

/* snow_source_sphere_density() */
INLINE reals density_of(reals radius, solid unit)
{
    reals a = 1.0 / (radius * radius);
    reals p = unit.x * unit.x;
    reals q = unit.y * unit.y;
    reals r = unit.z * unit.z;
    reals pairs = p * q + q * r + r * p;
    reals product = p * q * r;
    reals fourth = 1.0 - 5.0 * pairs;
    reals sixth = 1.0 - 10.5 * pairs + 115.5 * product;
    reals eighth = 1.0 - 18.0 * pairs - 52.0 * product + 65.0 * pairs * pairs;
    return 1.0 + 5.25 * a * (1.0 + 0.275 * a) * fourth + a * a * (1.625 * sixth - 11.15625 * eighth);
}

INLINE bool is_any(words mask)
{
#if defined(__AVX512F__)
    return _mm512_test_epi64_mask((__m512i)mask, (__m512i)mask) != 0;
#else
    return any((lanes)mask);
#endif
}

/* is_accepted(): hardly ever a density is needed. */
INLINE words is_refused(reals radius, solid unit, reals level)
{
    reals most = 5.5 / (radius * radius);
    level = level * (1.0 + most);
    words is_open = (words)(level >= 1.0 - most);
    return is_any(is_open) ? is_open & (words)(level >= density_of(radius, unit)) : is_open;
}

/* return_to_sphere() */
INLINE solid return_to_sphere(reals radius, solid from, reals distance, words first, words second)
{
    reals g = radius / distance;
    reals u = (centred(second) + 1.0) * 0.5;
    reals ratio = (1.0 - g * g) / (1.0 - g + 2.0 * g * u);
    reals cosine = (1.0 + g * g - ratio * ratio) / (2.0 * g);
    reals left = 1.0 - cosine * cosine;
    reals sine = root_of(chosen((words)(left > 0.0), left, left - left));
    vector around = direction_of(first);
    solid axis = {from.x / distance, from.y / distance, from.z / distance};
    reals one = (reals){0} + 1.0;
    reals sign = chosen((words)(axis.z < 0.0), -one, one);
    reals a = -1.0 / (sign + axis.z);
    reals b = axis.x * axis.y * a;
    solid across = {1.0 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x};
    solid along = {b, sign + axis.y * axis.y * a, -axis.y};
    reals c = sine * around.x;
    reals d = sine * around.y;
    return (solid){radius * (cosine * axis.x + c * across.x + d * along.x),
                   radius * (cosine * axis.y + c * across.y + d * along.y),
                   radius * (cosine * axis.z + c * across.z + d * along.z)};
}

INLINE solid chosen_solid(words mask, solid yes, solid no)
{
    return (solid){chosen(mask, yes.x, no.x), chosen(mask, yes.y, no.y), chosen(mask, yes.z, no.z)};
}

typedef struct cell {
    words x, y, z; /* in the lower halves */
    words stays;   /* mask: no ball is large enough */
} cell;

/* snow_source_come_in(), and snow_source_sphere() from the origin */
INLINE cell throw_from(const snow_source_of_walkers *source, bool some_are_back, thrown who, words first, words second)
{
    reals blur = blur_of(first);
    reals level = real_of(second & UINT32_MAX) * 0x1p-32;
    solid from = place_of(who);
    reals distance = distance_of(from);
    reals ball = distance - (double)source->rim;
    reals radius = chosen(who.comes_in, blur + (double)source->rim, ball - 1.0 - blur);
    solid unit = unit_sphere(first, second);
    words is_kept = is_refused(radius, unit, level) & ~who.comes_in;
    radius = chosen(is_kept, radius - radius, radius);
    solid to = {radius * unit.x, radius * unit.y, radius * unit.z};
    if (some_are_back) {
        radius = blur + (double)(source->far / 2);
        words returns = (words)(level * distance < radius) & who.is_back;
        to = chosen_solid(returns, return_to_sphere(radius, from, distance, first, second), to);
    }
    words stays = (words)(ball < (double)SNOW_SOURCE_LEAST_BALL) & ~who.comes_in;
    return (cell){whole_of(to.x), whole_of(to.y), whole_of(to.z), stays};
}

/* Eight walkers outside the map, and who of them is beyond all that a map may hold. */
typedef struct outsiders {
    lanes x, y, z;
    lanes comes_in; /* a mask */
} outsiders;

/* The others leave the balls round them, if these are large enough. The mask of those who have moved. */
static __attribute__((noinline)) lanes throw_all(const snow_source_of_walkers *source, outsiders *who,
                                                 const wide number[2])
{
    lanes is_back = is_back_from_afar(who->x, who->comes_in);
    bool some_are_back = any(is_back);
    wide x = lifted(who->x);
    wide y = lifted(who->y);
    wide z = lifted(who->z);
    wide in = widened_mask(who->comes_in);
    wide back = widened_mask(is_back);
#if defined(__AVX512F__)
    thrown from = {(words)x, (words)y, (words)z, (words)in, (words)back};
    cell to = throw_from(source, some_are_back, from, (words)number[0], (words)number[1]);
    wide to_x = (wide)to.x;
    wide to_y = (wide)to.y;
    wide to_z = (wide)to.z;
    wide stays = (wide)to.stays;
#else
    thrown even = {(words)x.even, (words)y.even, (words)z.even, (words)in.even, (words)back.even};
    thrown odd = {(words)x.odd, (words)y.odd, (words)z.odd, (words)in.odd, (words)back.odd};
    cell even_to = throw_from(source, some_are_back, even, (words)number[0].even, (words)number[1].even);
    cell odd_to = throw_from(source, some_are_back, odd, (words)number[0].odd, (words)number[1].odd);
    wide to_x = {(lanes)even_to.x, (lanes)odd_to.x};
    wide to_y = {(lanes)even_to.y, (lanes)odd_to.y};
    wide to_z = {(lanes)even_to.z, (lanes)odd_to.z};
    wide stays = {(lanes)even_to.stays, (lanes)odd_to.stays};
#endif
    who->x = _mm256_add_epi32(lower_halves(to_x), _mm256_andnot_si256(who->comes_in, who->x));
    who->y = _mm256_add_epi32(lower_halves(to_y), _mm256_andnot_si256(who->comes_in, who->y));
    who->z = _mm256_add_epi32(lower_halves(to_z), _mm256_andnot_si256(who->comes_in, who->z));
    return _mm256_xor_si256(lower_halves(stays), all(UINT32_MAX));
}

#endif
