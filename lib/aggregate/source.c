#include "aggregate/source.h"

#include <math.h>

#define HALF_SQRT_3 0.86602540378443864676

enum { BLUR_PARTS = 8, BLUR_PART = 8 };

typedef struct point {
    double x, y, z;
} point;

static bool is_in_space(const snow_source_of_walkers *source)
{
    return source->lattice == SNOW_AGGREGATE_CUBIC;
}

/* Uniform numbers of 16 bits, eight of them: 0 to 64, smooth at both ends. */
static double blur(snow_draws *draws)
{
    uint32_t sum = 0;
    for (int half = 0; half < 2; half++) {
        uint64_t bits = snow_draws_next(draws);
        for (int part = 0; part < BLUR_PARTS / 2; part++)
            sum += (uint32_t)(bits >> (16 * part) & 0xFFFF);
    }
    return sum * (BLUR_PART / 65536.0);
}

static double centred(uint64_t bits)
{
    return (double)(int64_t)(bits >> 32) * 0x1p-31 - 1;
}

/* A uniform point of the disc, squared as a complex number, has a uniform direction. */
static point unit_circle(snow_draws *draws)
{
    for (;;) {
        uint64_t bits = snow_draws_next(draws);
        double a = centred(bits);
        double b = centred(bits << 32);
        double square = a * a + b * b;
        if (square <= 1 && square > 0x1p-20)
            return (point){(a * a - b * b) / square, 2 * a * b / square, 0};
    }
}

/* G. Marsaglia, Ann. Math. Stat. 43 (1972) 645. */
static point unit_sphere(snow_draws *draws)
{
    for (;;) {
        uint64_t bits = snow_draws_next(draws);
        double a = centred(bits);
        double b = centred(bits << 32);
        double square = a * a + b * b;
        if (square < 1) {
            double root = 2 * sqrt(1 - square);
            return (point){a * root, b * root, 1 - 2 * square};
        }
    }
}

static int32_t nearest(double x)
{
    int32_t truncated = (int32_t)(x + 0.5);
    return truncated - (truncated > x + 0.5);
}

/* Each site has its own cell of points, all of one size. */
static snow_site site_at(snow_aggregate_lattice lattice, point p)
{
    if (lattice != SNOW_AGGREGATE_HEXAGONAL)
        return (snow_site){nearest(p.x), nearest(p.y), nearest(p.z)};
    int32_t r = nearest(p.y / HALF_SQRT_3);
    return (snow_site){nearest(p.x - r * 0.5), r, 0};
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

static snow_site launch(const snow_source_of_walkers *source, snow_draws *draws)
{
    if (source->width > 0)
        return launch_in_vessel(source, draws);
    double radius = source->rim + blur(draws) * (is_in_space(source) ? 0.5 : 1);
    point unit = is_in_space(source) ? unit_sphere(draws) : unit_circle(draws);
    return site_at(source->lattice, (point){radius * unit.x, radius * unit.y, radius * unit.z});
}

snow_site snow_source_launch(const snow_source_of_walkers *source, snow_draws *draws)
{
    snow_draws_end_block(draws);
    snow_site site = launch(source, draws);
    snow_draws_end_block(draws);
    return site;
}

/* The disc |w| < 1 is turned so that 0 goes to a, where the walker's mirror image
   in the circle is: a uniform point of the circle then goes where a Brownian
   walker would arrive. */
static point return_to_circle(double radius, point from, snow_draws *draws)
{
    double square = squared(from);
    double ax = radius * from.x / square;
    double ay = radius * from.y / square;
    point u = unit_circle(draws);
    double top_x = u.x + ax;
    double top_y = u.y + ay;
    double bottom_x = 1 + ax * u.x + ay * u.y;
    double bottom_y = ax * u.y - ay * u.x;
    double scale = radius / (bottom_x * bottom_x + bottom_y * bottom_y);
    return (point){(top_x * bottom_x + top_y * bottom_y) * scale, (top_y * bottom_x - top_x * bottom_y) * scale, 0};
}

/* The cosine of the angle at the centre between start and arrival has a simple
   inverse distribution; the direction round the axis is uniform. */
static point return_to_sphere(double radius, point from, double distance, snow_draws *draws)
{
    double g = radius / distance;
    double u = snow_draws_uniform(draws);
    double ratio = (1 - g * g) / (1 - g + 2 * g * u);
    double cosine = (1 + g * g - ratio * ratio) / (2 * g);
    double sine = cosine * cosine < 1 ? sqrt(1 - cosine * cosine) : 0;
    point around = unit_circle(draws);
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

static snow_site come_back(const snow_source_of_walkers *source, snow_site site, snow_draws *draws)
{
    if (source->width > 0)
        return launch_in_vessel(source, draws);
    point from = point_of(source->lattice, site);
    double radius = (double)(source->far / 2) + blur(draws);
    if (!is_in_space(source))
        return site_at(source->lattice, return_to_circle(radius, from, draws));
    double distance = sqrt(squared(from));
    if (snow_draws_uniform(draws) * distance >= radius)
        return launch(source, draws);
    return site_at(source->lattice, return_to_sphere(radius, from, distance, draws));
}

snow_site snow_source_return(const snow_source_of_walkers *source, snow_site site, snow_draws *draws)
{
    snow_draws_end_block(draws);
    site = come_back(source, site, draws);
    snow_draws_end_block(draws);
    return site;
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

/* By rejection: most numbers need no density, and hardly any is rejected. */
static point unit_sphere_of_lattice(double radius, snow_draws *draws)
{
    double most = 5.5 / (radius * radius); /* what the density differs from 1 by */
    for (;;) {
        point unit = unit_sphere(draws);
        double level = snow_draws_uniform(draws) * (1 + most);
        if (level < 1 - most || level < snow_source_sphere_density(radius, unit.x, unit.y, unit.z))
            return unit;
    }
}

snow_site snow_source_sphere(snow_site site, double ball, snow_draws *draws)
{
    double inside = ball - 1 - blur(draws) * 0.5;
    point unit = unit_sphere_of_lattice(inside, draws);
    point from = point_of(SNOW_AGGREGATE_CUBIC, site);
    return site_at(SNOW_AGGREGATE_CUBIC,
                   (point){from.x + inside * unit.x, from.y + inside * unit.y, from.z + inside * unit.z});
}

snow_site snow_source_circle(snow_site site, int32_t radius, snow_draws *draws)
{
    snow_draws_end_block(draws);
    double inside = radius * HALF_SQRT_3 - 2 - blur(draws);
    point unit = unit_circle(draws);
    snow_draws_end_block(draws);
    point from = point_of(SNOW_AGGREGATE_HEXAGONAL, site);
    return site_at(SNOW_AGGREGATE_HEXAGONAL, (point){from.x + inside * unit.x, from.y + inside * unit.y, 0});
}
