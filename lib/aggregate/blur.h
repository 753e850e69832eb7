/* A point of a blurred circle, from one number of 64 bits.

   The blur is a sum of ten uniform numbers of 4 bits, each with a width of its own, so
   that their steps fall together nowhere. Its Fourier transform is less than
   2 10^-12 at the least frequency of each lattice (a square's or a cube's, 1;
   a triangle's, 2/sqrt 3), less than 10^-11 f at all others below 16, and at higher ones
   less than 10^-5, where the transforms of a circle and of a site's cell are small
   themselves. All in 40 bits, on a width of 16.

   The direction is one of 2^24: an octant, and a place in it. */
#ifndef SNOW_AGGREGATE_BLUR_H
#define SNOW_AGGREGATE_BLUR_H

#include <stdbool.h>
#include <stdint.h>

enum {
    SNOW_BLUR_WIDTH = 16,
    SNOW_BLUR_BYTES = 5,       /* the lowest of the number */
    SNOW_BLUR_BITS = 24,       /* the widths are multiples of 2^-24 */
    SNOW_DIRECTION_SHIFT = 40, /* above them: the place in the octant */
    SNOW_DIRECTION_BITS = 21   /* and then: which octant */
};

/* A step of the lower four bits of a byte, and of the upper ones, is weight times scale: two factors,
   as vectors multiply bytes first, and then pairs. */
static const int8_t snow_blur_weight[2][8] = {{104, 46, 102, 86, 114}, {35, 73, 126, 78, 35}};
static const int16_t snow_blur_scale[4] = {23005, 20574, 26012};

/* cos(pi t / 4) and sin(pi t / 4) / t by powers of t^2, 0 <= t <= 1: wrong by less than
   10^-16 and 4 10^-15. Interpolated at Chebyshev's points. */
enum { SNOW_COSINE_TERMS = 7, SNOW_SINE_TERMS = 6 };
static const double snow_cosine[SNOW_COSINE_TERMS] = {
    1.0, -0.30842513753403783, 0.015854344243741547, -0.00032599188648354014, 3.590859179850238e-06,
    -2.4609507094028117e-08, 1.1365469207731353e-10};
static const double snow_sine[SNOW_SINE_TERMS] = {
    0.785398163397445, -0.08074551218803863, 0.0024903945673670634, -3.6576192120767256e-05, 3.1333840829093e-07,
    -1.7365167288597578e-09};

typedef struct snow_vector {
    double x, y;
} snow_vector;

/* 0 <= blur < 16. */
static inline double snow_blur(uint64_t number)
{
    int32_t sum = 0;
    for (int i = 0; i < SNOW_BLUR_BYTES; i++) {
        int32_t byte = (int32_t)(number >> (8 * i) & 255);
        sum += (snow_blur_weight[0][i] * (byte & 15) + snow_blur_weight[1][i] * (byte >> 4)) * snow_blur_scale[i / 2];
    }
    return sum * (1.0 / (1 << SNOW_BLUR_BITS));
}

static inline double snow_power_series(const double *term, int terms, double x)
{
    double sum = term[terms - 1];
    for (int i = terms - 2; i >= 0; i--)
        sum = sum * x + term[i];
    return sum;
}

/* A unit vector. */
static inline snow_vector snow_direction_of(uint64_t number)
{
    const uint32_t places = UINT32_C(1) << SNOW_DIRECTION_BITS;
    double t = ((double)(number >> SNOW_DIRECTION_SHIFT & (places - 1)) + 0.5) * (1.0 / places);
    double cosine = snow_power_series(snow_cosine, SNOW_COSINE_TERMS, t * t);
    double sine = t * snow_power_series(snow_sine, SNOW_SINE_TERMS, t * t);
    bool swaps = number >> 61 & 1;
    double x = swaps ? sine : cosine;
    double y = swaps ? cosine : sine;
    return (snow_vector){number >> 63 != 0 ? -x : x, (number >> 62 & 1) != 0 ? -y : y};
}

#endif
