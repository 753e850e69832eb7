/* Where walkers come from: infinity.

   A walker from infinity first meets a circle round the cluster at a uniform
   point. On a lattice the circle must be blurred: walkers start on a circle of
   random radius (blur.h), and at the nearest site. The
   potential of such a source on the lattice's own walk is constant inside: the
   terms by which the lattice's kernel differs from a logarithm are powers of z
   and its conjugate, whose mean over a circle round them is 0, to every order;
   what is left of the rounding is the Fourier transform of the blur at the
   lattice's frequencies. In space the same holds for spheres.

   A walker that goes far beyond comes back where Brownian motion would (through
   an automorphism of the disc; in space with chance R / rho). There the
   lattice's kernel is the continuum's but for cos(4 phi)/(6 pi r^2), r >= 2^14.

   Over a floor between mirrors a walker from infinity first meets each row above
   the cluster at a uniform place; higher than some widths it has forgotten
   where it was. */
#ifndef SNOW_AGGREGATE_SOURCE_H
#define SNOW_AGGREGATE_SOURCE_H

#include "aggregate/draws.h"

#include <snowgrowth/aggregate.h>

#include <stdbool.h>

typedef struct snow_source_of_walkers {
    snow_aggregate_lattice lattice;
    int32_t width, depth, lid; /* of a vessel; width 0: none, walkers come from all around; lid negative: none */
    int32_t rim;               /* all special sites are nearer to the origin, or lower, than this */
    int32_t reach;             /* the same in lattice distance */
    int64_t far;               /* beyond this, in lattice distance, a walker is sent back */
    int64_t safe;              /* so far it is from `reach` to there */
} snow_source_of_walkers;

/* Sets the distances for a cluster whose filled sites lie at squared distances
   up to `farthest` (in a vessel: in rows up to `farthest`). They move in steps
   of about one percent, so that most particles do not change them. */
void snow_source_fit(snow_source_of_walkers *source, int64_t farthest);

/* Where a walker is that has not set out: outside every map, and beyond `far`. */
enum { SNOW_SOURCE_INFINITY = 1 << 30 };

static inline snow_site snow_source_infinity(const snow_source_of_walkers *source)
{
    bool space = source->lattice == SNOW_AGGREGATE_CUBIC;
    return (snow_site){SNOW_SOURCE_INFINITY, SNOW_SOURCE_INFINITY, space ? SNOW_SOURCE_INFINITY : 0};
}

bool snow_source_is_at_infinity(snow_site site);

/* Where a walker from infinity, or one that is beyond `far`, comes in. It takes one
   number in the plane, in space a block of two. */
snow_site snow_source_come_in(const snow_source_of_walkers *source, snow_site site, snow_draws *draws);

/* Hexagonal lattice: from the middle of an empty hexagon to a site of a blurred
   circle inside. The lattice's kernel differs from a logarithm by terms of
   cos(6 phi)/r^4 there: less than 10^-9 for the radii used, 257 and more. */
snow_site snow_source_circle(snow_site site, int32_t radius, uint64_t number);

/* The radius of the ball round a walker outside the map that is free. */
double snow_source_clear_ball(const snow_source_of_walkers *source, snow_site site);

enum { SNOW_SOURCE_LEAST_BALL = 130 };

/* Cubic lattice: from the middle of an empty ball to a site of a blurred sphere
   inside. A measure has the potential of its middle, as seen from outside, if the
   mean of each polynomial that is harmonic for the lattice's walk is the value
   there. The first one whose mean over a sphere is not, with each site's cell, is
   x^4 + y^4 + z^4 - 3 (x^2 y^2 + y^2 z^2 + z^2 x^2) - r^2: the density is not
   constant. With what its harmonics of degree 4, 6 and 8 must be, all such means
   up to degree 12 are right but for 1530/r^6 of the density: less than 10^-9 for
   the radii used, 113 and more. By rejection, with a block of two numbers: one walker
   in 10^4 stays where it is for this time. */
snow_site snow_source_sphere(snow_site site, double ball, snow_draws *draws);

/* Of the point of a unit vector; uniform: 1. */
double snow_source_sphere_density(double radius, double x, double y, double z);

#endif
