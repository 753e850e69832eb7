/* Patterns in run-length encoding. */
#ifndef SNOW_PACKARD_RLE_H
#define SNOW_PACKARD_RLE_H

#include "packard/model.h"

/* What is farther out, or more than that, is neither written nor read. */
#define PACKARD_RLE_REACH (INT64_C(1) << 30)
#define PACKARD_RLE_CELLS (UINT64_C(1) << 32)

static inline bool packard_rle_reaches(int64_t coordinate)
{
    return coordinate >= -PACKARD_RLE_REACH && coordinate <= PACKARD_RLE_REACH;
}

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

/* y of a row r, and r of a row y. */
static inline int64_t packard_y_of(const packard_axes *axes, int64_t r)
{
    return axes->mirrored ? axes->shift - r : r;
}

static inline int64_t packard_q_of(const packard_axes *axes, int64_t x, int64_t y)
{
    return axes->mirrored ? x : x - y;
}

#endif
