/*
 * The palettes.
 *
 * A ramp of colours is given by a few stops and mixed between them in the cube
 * roots of cone responses. That is the same as mixing linearly in the Oklab
 * colour space (B. Ottosson, "A perceptual color space for image processing",
 * 2020, whose matrices these are), a linear image of those roots: equal steps
 * look about equal, and blues do not drift towards purple.
 */
#include "render/palette.h"

#include <snowgrowth/reiter.h>

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* Red, green, blue as linear light in [0, 1], or the three cone roots. */
typedef struct triple {
    double part[3];
} triple;

typedef struct stop {
    double place; /* In [0, 1]; those of a ramp ascend from 0 to 1. */
    uint8_t red;
    uint8_t green;
    uint8_t blue;
} stop;

enum { MOST_STOPS = 5 };

typedef struct ramp {
    size_t count;
    stop stops[MOST_STOPS];
} ramp;

/* Vapour from 0 to 1; ice from u = 1, or the first cell that froze, to the greatest number on the grid. */
static const ramp frost_sky = {3, {{0.0, 3, 7, 20}, {0.4, 11, 27, 61}, {1.0, 44, 80, 132}}};
static const ramp frost_ice = {
    4, {{0.0, 255, 255, 255}, {0.25, 212, 233, 252}, {0.6, 140, 190, 240}, {1.0, 62, 124, 206}}};
static const ramp ink_paper = {2, {{0.0, 255, 255, 255}, {1.0, 255, 255, 255}}};
static const ramp ink_ice = {3, {{0.0, 56, 98, 164}, {0.4, 26, 58, 120}, {1.0, 10, 22, 58}}};
static const ramp age_ground = {2, {{0.0, 10, 9, 16}, {1.0, 10, 9, 16}}};
static const ramp age_ice = {
    5, {{0.0, 76, 29, 128}, {0.25, 140, 36, 128}, {0.5, 208, 56, 76}, {0.75, 246, 140, 62}, {1.0, 253, 240, 172}}};

static const ramp phase_ice = {
    5, {{0.0, 250, 244, 236}, {0.25, 242, 152, 96}, {0.5, 124, 44, 116}, {0.75, 66, 128, 196}, {1.0, 250, 244, 236}}};

static double decode(double srgb)
{
    return srgb <= 0.04045 ? srgb / 12.92 : pow((srgb + 0.055) / 1.055, 2.4);
}

static uint16_t quantise(double light)
{
    if (!(light > 0.0))
        return 0;
    return light >= 1.0 ? 65535 : (uint16_t)(light * 65535.0 + 0.5);
}

static triple multiply(const double matrix[3][3], triple vector)
{
    triple product;

    for (int i = 0; i < 3; i++)
        product.part[i] = matrix[i][0] * vector.part[0] + matrix[i][1] * vector.part[1] + matrix[i][2] * vector.part[2];
    return product;
}

static triple cone_roots(const stop *colour)
{
    static const double cones_of_light[3][3] = {{0.4122214708, 0.5363325363, 0.0514459929},
                                                {0.2119034982, 0.6806995451, 0.1073969566},
                                                {0.0883024619, 0.2817188376, 0.6299787005}};
    triple light = {{decode(colour->red / 255.0), decode(colour->green / 255.0), decode(colour->blue / 255.0)}};
    triple cones = multiply(cones_of_light, light);

    for (int i = 0; i < 3; i++)
        cones.part[i] = cbrt(cones.part[i]);
    return cones;
}

static snow_light light_of_roots(triple roots)
{
    static const double light_of_cones[3][3] = {{4.0767416621, -3.3077115913, 0.2309699292},
                                                {-1.2684380046, 2.6097574011, -0.3413193965},
                                                {-0.0041960863, -0.7034186147, 1.7076147010}};
    triple light;

    for (int i = 0; i < 3; i++)
        roots.part[i] *= roots.part[i] * roots.part[i];
    light = multiply(light_of_cones, roots);
    return (snow_light){quantise(light.part[0]), quantise(light.part[1]), quantise(light.part[2])};
}

/* The middle of each step, so that rounding to a step and to a byte agree. */
static double middle(int step)
{
    return (step + 0.5) / SNOW_SHADES;
}

static void mix_ramp(snow_light *shades, const ramp *colours)
{
    triple roots[MOST_STOPS];
    size_t next = 1;

    for (size_t i = 0; i < colours->count; i++)
        roots[i] = cone_roots(&colours->stops[i]);
    for (int step = 0; step < SNOW_SHADES; step++) {
        triple mixed;
        double share;

        while (middle(step) > colours->stops[next].place)
            next++;
        share = (middle(step) - colours->stops[next - 1].place) /
                (colours->stops[next].place - colours->stops[next - 1].place);
        for (int i = 0; i < 3; i++)
            mixed.part[i] = (1.0 - share) * roots[next - 1].part[i] + share * roots[next].part[i];
        shades[step] = light_of_roots(mixed);
    }
}

/* Vapour in the darker half of the greys; ice in the lighter one, reversed (Reiter 2005). */
static void mix_paper(snow_light *vapour, snow_light *ice)
{
    for (int step = 0; step < SNOW_SHADES; step++) {
        uint16_t dark = quantise(decode(floor(127.5 * middle(step) + 0.5) / 255.0));
        uint16_t light = quantise(decode(floor(255.5 - 127.5 * middle(step)) / 255.0));

        vapour[step] = (snow_light){dark, dark, dark};
        ice[step] = (snow_light){light, light, light};
    }
}

static void mix_bytes(snow_paint *paint)
{
    uint8_t byte = 0;

    paint->byte_from[0] = 0;
    for (int i = 1; i < 256; i++)
        paint->byte_from[i] = quantise(decode((i - 0.5) / 255.0));
    paint->byte_from[256] = UINT32_MAX;
    for (uint32_t i = 0; i < 4096; i++) {
        if (paint->byte_from[byte + 1] <= 16 * i)
            byte++;
        paint->byte_at[i] = byte;
    }
}

static bool shows_age(snow_palette palette)
{
    return palette == SNOW_PALETTE_AGE || palette == SNOW_PALETTE_PHASE;
}

snow_field snow_palette_field(snow_palette palette)
{
    return shows_age(palette) ? SNOW_FIELD_FREEZE_STEP : SNOW_FIELD_VALUE;
}

void snow_paint_mix(snow_paint *paint, snow_palette palette, double greatest)
{
    snow_light *vapour = paint->shade;
    snow_light *ice = paint->shade + SNOW_SHADES;

    paint->first = shows_age(palette) ? 0.0 : 1.0;
    paint->ice_from = shows_age(palette) ? 0.0 : 1.0 - SNOW_REITER_SLACK;
    paint->period = palette == SNOW_PALETTE_PHASE ? 16.0 : 0.0;
    paint->range = greatest > paint->first ? greatest - paint->first : 0.0;
    if (paint->period > 0.0)
        paint->range = paint->period;
    mix_bytes(paint);
    switch (palette) {
    case SNOW_PALETTE_PAPER:
        mix_paper(vapour, ice);
        break;
    case SNOW_PALETTE_FROST:
        mix_ramp(vapour, &frost_sky);
        mix_ramp(ice, &frost_ice);
        break;
    case SNOW_PALETTE_INK:
        mix_ramp(vapour, &ink_paper);
        mix_ramp(ice, &ink_ice);
        break;
    case SNOW_PALETTE_AGE:
        mix_ramp(vapour, &age_ground);
        mix_ramp(ice, &age_ice);
        break;
    case SNOW_PALETTE_PHASE:
        mix_ramp(vapour, &age_ground);
        mix_ramp(ice, &phase_ice);
        break;
    }
}

static uint16_t step_of(double place)
{
    if (!(place > 0.0))
        return 0;
    return place >= 1.0 ? SNOW_SHADES - 1 : (uint16_t)(place * SNOW_SHADES);
}

uint16_t snow_paint_shade(const snow_paint *paint, double number)
{
    if (!(number >= paint->ice_from))
        return step_of(number);
    if (paint->range == 0.0)
        return SNOW_SHADES;
    if (paint->period > 0.0)
        number = fmod(number, paint->period);
    return (uint16_t)(SNOW_SHADES + step_of((number - paint->first) / paint->range));
}

uint8_t snow_paint_byte(const snow_paint *paint, uint32_t light)
{
    uint8_t byte = paint->byte_at[light / 16];
    return (uint8_t)(byte + (light >= paint->byte_from[byte + 1]));
}
