/* Points of blurred circles for eight walkers at once: those who come in from far away, and
   those who leave large hexagons. As in source.c, and so to the same sites. */
#ifndef SNOW_AGGREGATE_LANES_CIRCLE_H
#define SNOW_AGGREGATE_LANES_CIRCLE_H

#include "aggregate/lanes_blur.h"

#define HALF_SQRT_3 0.86602540378443864676

INLINE vector point_of(bool hexagonal, words x, words y)
{
    reals q = coordinate_of(x);
    reals r = coordinate_of(y);
    if (hexagonal)
        return (vector){q + r * 0.5, r * HALF_SQRT_3};
    return (vector){q, r};
}

typedef struct cell {
    words x, y; /* in the lower halves */
} cell;

INLINE cell site_at(bool hexagonal, vector p)
{
    if (!hexagonal)
        return (cell){whole_of(p.x), whole_of(p.y)};
    reals row = nearest(p.y * (1 / HALF_SQRT_3));
    return (cell){whole_of(p.x - row * 0.5), whole_of(row)};
}

/* return_to_circle() */
INLINE vector return_to_circle(reals radius, vector from, vector u)
{
    reals square = from.x * from.x + from.y * from.y;
    reals ax = radius * from.x / square;
    reals ay = radius * from.y / square;
    reals top_x = u.x + ax;
    reals top_y = u.y + ay;
    reals bottom_x = 1 + ax * u.x + ay * u.y;
    reals bottom_y = ax * u.y - ay * u.x;
    reals scale = radius / (bottom_x * bottom_x + bottom_y * bottom_y);
    return (vector){(top_x * bottom_x + top_y * bottom_y) * scale, (top_y * bottom_x - top_x * bottom_y) * scale};
}

/* Those who are thrown onto a circle, each to a lane of 64 bits. */
typedef struct thrown {
    words x, y;     /* + 2^31 */
    words comes_in; /* masks; from infinity, or not */
    words is_back;
    words hexagon; /* the radius of that which another leaves */
} thrown;

/* snow_source_come_in(), and snow_source_circle() from the origin */
INLINE cell throw_from(const snow_source_of_walkers *source, bool hexagonal, bool some_are_back, thrown who,
                       words number)
{
    reals blur = blur_of(number);
    vector unit = direction_of(number);
    reals inside = (reals){0} + (double)source->rim;
    if (hexagonal)
        inside = chosen(who.comes_in, inside, real_of(who.hexagon) * HALF_SQRT_3 - (1 + SNOW_BLUR_WIDTH));
    reals radius = inside + blur;
    vector to = {radius * unit.x, radius * unit.y};
    if (some_are_back) {
        vector back = return_to_circle(blur + (double)(source->far / 2), point_of(hexagonal, who.x, who.y), unit);
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
    lanes is_back = is_back_from_afar(from.x, comes_in);
    bool some_are_back = any(is_back);
    wide x = lifted(from.x);
    wide y = lifted(from.y);
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
