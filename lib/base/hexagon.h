/* The hexagonal lattice in axial coordinates, as in snowgrowth/grid.h:
   neighbours, distances, symmetries. */
#ifndef SNOW_BASE_HEXAGON_H
#define SNOW_BASE_HEXAGON_H

#include <snowgrowth/grid.h>

#include <stdbool.h>
#include <stdint.h>

static inline int64_t snow_hexagon_square(int64_t q, int64_t r)
{
    return q * q + q * r + r * r;
}

static inline int64_t snow_hexagon_magnitude(int64_t x)
{
    return x < 0 ? -x : x;
}

/* Steps from the origin. */
static inline int64_t snow_hexagon_distance(int64_t q, int64_t r)
{
    int64_t a = snow_hexagon_magnitude(q);
    int64_t b = snow_hexagon_magnitude(r);
    int64_t c = snow_hexagon_magnitude(q + r);
    int64_t ab = a > b ? a : b;
    return ab > c ? ab : c;
}

static inline snow_hexagon snow_hexagon_empty(void)
{
    return (snow_hexagon){INT64_MAX, INT64_MIN, INT64_MAX, INT64_MIN, INT64_MAX, INT64_MIN};
}

static inline bool snow_hexagon_is_empty(const snow_hexagon *hexagon)
{
    return hexagon->least_q > hexagon->greatest_q;
}

static inline void snow_hexagon_stretch(int64_t *least, int64_t *greatest, int64_t coordinate)
{
    *least = coordinate < *least ? coordinate : *least;
    *greatest = coordinate > *greatest ? coordinate : *greatest;
}

/* Makes the hexagon hold a cell. */
static inline void snow_hexagon_hold(snow_hexagon *hexagon, int64_t q, int64_t r)
{
    snow_hexagon_stretch(&hexagon->least_q, &hexagon->greatest_q, q);
    snow_hexagon_stretch(&hexagon->least_r, &hexagon->greatest_r, r);
    snow_hexagon_stretch(&hexagon->least_s, &hexagon->greatest_s, q + r);
}

enum { SNOW_HEXAGON_SYMMETRIES = 12 };

/* The images of a cell: six turns by 60 degrees, then their mirror images. */
static inline void snow_hexagon_image(int symmetry, int64_t q, int64_t r, int64_t *image_q, int64_t *image_r)
{
    if (symmetry >= 6) {
        int64_t swap = q;
        q = r;
        r = swap;
    }
    for (int turn = symmetry % 6; turn > 0; turn--) {
        int64_t turned = -r;
        r = q + r;
        q = turned;
    }
    *image_q = q;
    *image_r = r;
}

/* One image that all images of a cell share. */
static inline snow_cell snow_hexagon_canonical(int32_t q, int32_t r)
{
    int64_t best_q = q;
    int64_t best_r = r;
    for (int symmetry = 0; symmetry < SNOW_HEXAGON_SYMMETRIES; symmetry++) {
        int64_t x;
        int64_t y;
        snow_hexagon_image(symmetry, q, r, &x, &y);
        if (x > best_q || (x == best_q && y > best_r)) {
            best_q = x;
            best_r = y;
        }
    }
    return (snow_cell){(int32_t)best_q, (int32_t)best_r};
}

#endif
