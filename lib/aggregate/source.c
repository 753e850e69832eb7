#include "aggregate/source.h"

#include "aggregate/blur.h"

#include <math.h>

#define HALF_SQRT_3 0.86602540378443864676

typedef struct point {
    double x, y, z;
} point;

static bool is_in_space(const snow_source_of_walkers *source)
{
    return source->lattice == SNOW_AGGREGATE_CUBIC;
}

/* In -1 ... 1. */
static double centred(uint64_t number)
{
    return ((double)(number >> 32) + 0.5) * 0x1p-31 - 1;
}

/* By its height, which is uniform. */
static point unit_sphere(const uint64_t number[2])
{
    double z = centred(number[1]);
    double across = sqrt(1 - z * z);
    snow_vector round = snow_direction_of(number[0]);
    return (point){across * round.x, across * round.y, z};
}

/* Beyond 2^52 doubles are whole. */
static double nearest(double x)
{
    return (x + 0x1.8p52) - 0x1.8p52;
}

/* Each site has its own cell of points, all of one size. */
static snow_site site_at(snow_aggregate_lattice lattice, point p)
{
    if (lattice != SNOW_AGGREGATE_HEXAGONAL)
        return (snow_site){(int32_t)nearest(p.x), (int32_t)nearest(p.y), (int32_t)nearest(p.z)};
    double row = nearest(p.y * (1 / HALF_SQRT_3));
    return (snow_site){(int32_t)nearest(p.x - row * 0.5), (int32_t)row, 0};
}

static point point_of(snow_aggregate_lattice lattice, snow_site site)
{
    if (lattice != SNOW_AGGREGATE_HEXAGONAL)
        return (point){site.x, site.y, site.z};
    return (point){site.x + site.y * 0.5, site.y * HALF_SQRT_3, 0};
}

static double squared(point p)
{
    return p.x * p.x + p.y * p.y + p.z * p.z;
}

/* The least number of a fixed sequence, steps of about 1/128, that is at least `wanted`. */
static int64_t in_steps(int64_t wanted)
{
    int64_t step = 1;
    while (wanted > 256 * step)
        step *= 2;
    return (wanted + step - 1) / step * step;
}

static int64_t root_above(int64_t square)
{
    int64_t root = (int64_t)sqrt((double)square);
    while (root * root < square)
        root++;
    return root;
}

/* Walkers that come back are put on the circle of half this radius, r. What the
   lattice's kernel differs by there, cos(4 phi)/(6 pi r^2), matters by its
   change across the cluster and by how far the arrival is from uniform: about
   0.13 R/r^3 of a hit, which is less than 10^-9. */
static int64_t far_in_plane(int64_t rim)
{
    int64_t circle = 2048;
    for (int64_t most = 64; most < rim && circle < 16384; most *= 8)
        circle *= 2;
    return 2 * (rim > circle ? rim : circle);
}

/* In the same way, with (5 (x^4 + y^4 + z^4)/r^4 - 3)/(8 r^3) beside 1/r:
   R^2/far^4 of a hit. */
static int64_t far_in_space(int64_t rim)
{
    int64_t least = root_above(32768 * rim);
    return least > 4 * rim ? least : 4 * rim;
}

void snow_source_fit(snow_source_of_walkers *source, int64_t farthest)
{
    if (source->width > 0) {
        int64_t widest = source->width > source->depth ? source->width : source->depth;
        source->rim = (int32_t)in_steps(farthest + 2); /* one more row is special */
        source->reach = source->rim - 1;
        source->far = source->rim + 10 * widest;
        source->safe = source->far - source->reach;
        return;
    }
    int64_t rim = in_steps(root_above(farthest) + 3);
    source->rim = (int32_t)rim;
    source->reach = (int32_t)(source->lattice == SNOW_AGGREGATE_HEXAGONAL ? rim * 37 / 32 + 1 : rim);
    source->far = is_in_space(source) ? far_in_space(rim) : far_in_plane(rim);
    source->safe = source->far - source->reach;
}

/* A row of the vessel; on the hexagonal lattice a site on a mirror stands for one, each other for two. */
static int32_t column_in_row(const snow_source_of_walkers *source, int32_t row, snow_draws *draws)
{
    if (source->lattice != SNOW_AGGREGATE_HEXAGONAL)
        return (int32_t)snow_draws_below(draws, (uint32_t)source->width);
    int32_t last = 2 * source->width - 1;
    int32_t twice = 2 * (int32_t)snow_draws_below(draws, (uint32_t)last) + row % 2;
    if (twice > last)
        twice = 2 * last - twice;
    return (twice - row) / 2;
}

static snow_site launch_in_vessel(const snow_source_of_walkers *source, snow_draws *draws)
{
    int32_t row = source->lid >= 0 && source->rim > source->lid ? source->lid : source->rim;
    if (!is_in_space(source))
        return (snow_site){column_in_row(source, row, draws), row, 0};
    int32_t x = (int32_t)snow_draws_below(draws, (uint32_t)source->width);
    int32_t y = (int32_t)snow_draws_below(draws, (uint32_t)source->depth);
    return (snow_site){x, y, row};
}

bool snow_source_is_at_infinity(snow_site site)
{
    return site.x == SNOW_SOURCE_INFINITY;
}

/* The disc |w| < 1 is turned so that 0 goes to a, where the walker's mirror image
   in the circle is: a uniform point of the circle then goes where a Brownian
   walker would arrive. */
static point return_to_circle(double radius, point from, snow_vector u)
{
    double square = squared(from);
    double ax = radius * from.x / square;
    double ay = radius * from.y / square;
    double top_x = u.x + ax;
    double top_y = u.y + ay;
    double bottom_x = 1 + ax * u.x + ay * u.y;
    double bottom_y = ax * u.y - ay * u.x;
    double scale = radius / (bottom_x * bottom_x + bottom_y * bottom_y);
    return (point){(top_x * bottom_x + top_y * bottom_y) * scale, (top_y * bottom_x - top_x * bottom_y) * scale, 0};
}

static snow_site come_in_plane(const snow_source_of_walkers *source, snow_site site, uint64_t number)
{
    snow_vector unit = snow_direction_of(number);
    if (snow_source_is_at_infinity(site)) {
        double radius = source->rim + snow_blur(number);
        return site_at(source->lattice, (point){radius * unit.x, radius * unit.y, 0});
    }
    double radius = (double)(source->far / 2) + snow_blur(number);
    return site_at(source->lattice, return_to_circle(radius, point_of(source->lattice, site), unit));
}

/* The cosine of the angle at the centre between start and arrival has a simple
   inverse distribution; the direction round the axis is uniform. */
static point return_to_sphere(double radius, point from, double distance, const uint64_t number[2])
{
    double g = radius / distance;
    double u = (centred(number[1]) + 1) * 0.5;
    double ratio = (1 - g * g) / (1 - g + 2 * g * u);
    double cosine = (1 + g * g - ratio * ratio) / (2 * g);
    double sine = cosine * cosine < 1 ? sqrt(1 - cosine * cosine) : 0;
    snow_vector around = snow_direction_of(number[0]);
    point axis = {from.x / distance, from.y / distance, from.z / distance};
    /* Two unit vectors across the axis; T. Duff et al., J. Comput. Graph. Tech. 6 (2017) 1. */
    double sign = axis.z < 0 ? -1 : 1;
    double a = -1 / (sign + axis.z);
    double b = axis.x * axis.y * a;
    point first = {1 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x};
    point second = {b, sign + axis.y * axis.y * a, -axis.y};
    double c = sine * around.x;
    double d = sine * around.y;
    return (point){radius * (cosine * axis.x + c * first.x + d * second.x),
                   radius * (cosine * axis.y + c * first.y + d * second.y),
                   radius * (cosine * axis.z + c * first.z + d * second.z)};
}

/* Uniform: what of a block neither directions nor blurs use. */
static double level_of(const uint64_t number[2])
{
    return (double)(number[1] & 0xFFFFFFFF) * 0x1p-32;
}

static snow_site come_in_space(const snow_source_of_walkers *source, snow_site site, const uint64_t number[2])
{
    point from = point_of(source->lattice, site);
    double distance = sqrt(squared(from));
    double radius = (double)(source->far / 2) + snow_blur(number[0]);
    if (!snow_source_is_at_infinity(site) && level_of(number) * distance < radius)
        return site_at(source->lattice, return_to_sphere(radius, from, distance, number));
    radius = source->rim + snow_blur(number[0]);
    point unit = unit_sphere(number);
    return site_at(source->lattice, (point){radius * unit.x, radius * unit.y, radius * unit.z});
}

snow_site snow_source_come_in(const snow_source_of_walkers *source, snow_site site, snow_draws *draws)
{
    if (source->width > 0)
        return launch_in_vessel(source, draws);
    if (!is_in_space(source))
        return come_in_plane(source, site, snow_draws_next(draws));
    uint64_t number[2];
    snow_draws_take_block(draws, number);
    return come_in_space(source, site, number);
}

double snow_source_clear_ball(const snow_source_of_walkers *source, snow_site site)
{
    if (source->width > 0)
        return site.z - source->reach;
    return sqrt(squared(point_of(source->lattice, site))) - source->rim;
}

double snow_source_sphere_density(double radius, double x, double y, double z)
{
    double a = 1 / (radius * radius);
    double p = x * x;
    double q = y * y;
    double r = z * z;
    double pairs = p * q + q * r + r * p;
    double product = p * q * r;
    double fourth = 1 - 5 * pairs;
    double sixth = 1 - 10.5 * pairs + 115.5 * product;
    double eighth = 1 - 18 * pairs - 52 * product + 65 * pairs * pairs;
    return 1 + 5.25 * a * (1 + 0.275 * a) * fourth + a * a * (1.625 * sixth - 11.15625 * eighth);
}

/* Most numbers need no density, and hardly any is rejected. */
static bool is_accepted(double radius, point unit, double level)
{
    double most = 5.5 / (radius * radius); /* what the density differs from 1 by */
    level *= 1 + most;
    return level < 1 - most || level < snow_source_sphere_density(radius, unit.x, unit.y, unit.z);
}

snow_site snow_source_sphere(snow_site site, double ball, snow_draws *draws)
{
    uint64_t number[2];
    snow_draws_take_block(draws, number);
    double inside = ball - 1 - snow_blur(number[0]);
    point unit = unit_sphere(number);
    if (!is_accepted(inside, unit, level_of(number)))
        return site;
    snow_site step = site_at(SNOW_AGGREGATE_CUBIC, (point){inside * unit.x, inside * unit.y, inside * unit.z});
    return (snow_site){site.x + step.x, site.y + step.y, site.z + step.z};
}

snow_site snow_source_circle(snow_site site, int32_t radius, uint64_t number)
{
    double inside = radius * HALF_SQRT_3 - (1 + SNOW_BLUR_WIDTH) + snow_blur(number);
    snow_vector unit = snow_direction_of(number);
    snow_site step = site_at(SNOW_AGGREGATE_HEXAGONAL, (point){inside * unit.x, inside * unit.y, 0});
    return (snow_site){site.x + step.x, site.y + step.y, 0};
}
