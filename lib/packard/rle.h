/* Patterns in run-length encoding. */
#ifndef SNOW_PACKARD_RLE_H
#define SNOW_PACKARD_RLE_H

#include "packard/model.h"

/* Where a cell stands in a pattern. Its neighbours there are those in its row
   and column and those to its upper left and lower right. Drawn as hexagons, a
   pattern looks like the crystal; but where opposite sides of a rhombus are
   joined, or end the world, its sides must be those of the pattern, and that
   can only be had as a mirror image. */
typedef struct packard_axes {
    bool mirrored;
    int64_t shift; /* y = shift − r */
} packard_axes;

static inline packard_axes packard_axes_of(const snow_packard_params *params)
{
    bool rhombic = params->domain == SNOW_PACKARD_RHOMBUS || params->domain == SNOW_PACKARD_TORUS;
    return (packard_axes){rhombic, rhombic ? params->height % 2 - 1 : 0};
}

static inline int64_t packard_x_of(const packard_axes *axes, int64_t q, int64_t r)
{
    return axes->mirrored ? q : q + r;
}

/* And, for the same map backwards, r of a row y. */
static inline int64_t packard_y_of(const packard_axes *axes, int64_t r)
{
    return axes->mirrored ? axes->shift - r : r;
}

static inline int64_t packard_q_of(const packard_axes *axes, int64_t x, int64_t y)
{
    return axes->mirrored ? x : x - y;
}

#endif
