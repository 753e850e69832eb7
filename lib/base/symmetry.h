/* The symmetries that a scene has, and the part of the plane that decides the
   rest of it. A group is a set of the twelve symmetries of the hexagon, as
   snow_hexagon_image() numbers them: bit s stands for symmetry s. */
#ifndef SNOW_BASE_SYMMETRY_H
#define SNOW_BASE_SYMMETRY_H

#include "base/domain.h"

#include <stdint.h>

typedef uint32_t snow_group;

#define SNOW_GROUP_TRIVIAL ((snow_group)1)
#define SNOW_GROUP_FULL ((snow_group)0xFFF)

static inline bool snow_group_has(snow_group group, int symmetry)
{
    return (group >> symmetry & 1) != 0;
}

/* Number of symmetries in it. */
int snow_group_order(snow_group group);

/* Whether it is closed under composition and holds the identity. */
bool snow_group_is_closed(snow_group group);

/* Whether a mirror lies in it: images of a cell of the fundamental part are
   then never nearer to that part than the cell. */
bool snow_group_reflects(snow_group group);

/* The symmetries that a domain has. */
snow_group snow_group_of_domain(const snow_domain *domain);

/* The one image of a cell, under the group, that lies in the fundamental part. */
snow_cell snow_group_representative(snow_group group, int32_t q, int32_t r);

/* The different images of a cell, itself among them; returns how many. */
size_t snow_group_images(snow_group group, int32_t q, int32_t r, snow_cell image[12]);

/* The cells of a domain that lie in the fundamental part: a convex sector, so
   that rows stay runs. The domain must have the group. */
snow_status snow_group_fundamental(snow_group group, const snow_domain *domain, snow_heap *heap, snow_domain *part);

#endif
