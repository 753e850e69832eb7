#include "aggregate/vessel.h"

const aggregate_neighbours snow_aggregate_four = {4, {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}};

const aggregate_neighbours snow_aggregate_eight = {
    8, {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}, {0, -1, 0}, {1, -1, 0}}};

const aggregate_neighbours snow_aggregate_six = {
    6, {{1, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {1, -1, 0}}};

const aggregate_neighbours snow_aggregate_six_in_space = {
    6, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};

const aggregate_neighbours *snow_aggregate_steps(snow_aggregate_lattice lattice)
{
    switch (lattice) {
    case SNOW_AGGREGATE_SQUARE: break;
    case SNOW_AGGREGATE_HEXAGONAL: return &snow_aggregate_six;
    case SNOW_AGGREGATE_CUBIC: return &snow_aggregate_six_in_space;
    }
    return &snow_aggregate_four;
}

snow_site snow_aggregate_beside(const snow_aggregate_params *params, snow_site site, snow_site step)
{
    snow_site next = aggregate_moved(site, step);
    if (!params->periodic || !snow_aggregate_has_floor(params) || params->scene == SNOW_AGGREGATE_CHIMNEY)
        return next;
    if (params->scene == SNOW_AGGREGATE_LINE)
        return snow_vessel_keep(params, next);
    next.x = (next.x + params->width) % params->width;
    return next;
}

const aggregate_neighbours *snow_aggregate_contacts(const snow_aggregate_params *params)
{
    switch (params->scene) {
    case SNOW_AGGREGATE_ELECTROLYSIS:
    case SNOW_AGGREGATE_CHIMNEY:
    case SNOW_AGGREGATE_SNOWFLAKE: return &snow_aggregate_eight;
    case SNOW_AGGREGATE_WITTEN_SANDER:
    case SNOW_AGGREGATE_LABORATORY:
    case SNOW_AGGREGATE_LINE:
    case SNOW_AGGREGATE_SHORE:
    case SNOW_AGGREGATE_CLUSTER_CLUSTER:
    case SNOW_AGGREGATE_OFF_LATTICE: break;
    }
    return snow_aggregate_steps(params->lattice);
}

static const double half_root_of_three = 0x1.bb67ae8584caap-1;

snow_point snow_aggregate_point_of(snow_aggregate_lattice lattice, snow_site site)
{
    snow_point point = {site.x, site.y, site.z};
    if (lattice == SNOW_AGGREGATE_HEXAGONAL)
        point = (snow_point){point.x + point.y / 2, point.y * half_root_of_three, 0};
    return point;
}

static int32_t nearest(double x)
{
    return (int32_t)(x < 0 ? x - 0.5 : x + 0.5);
}

/* Rounds the three hexagonal coordinates, whose sum is 0, and corrects the one that was rounded most. */
static snow_site nearest_hexagon(snow_point point)
{
    double r = point.y / half_root_of_three;
    double q = point.x - r / 2;
    int32_t whole_q = nearest(q);
    int32_t whole_r = nearest(r);
    int32_t whole_s = nearest(-q - r);
    double error_q = fabs(whole_q - q);
    double error_r = fabs(whole_r - r);
    double error_s = fabs(whole_s + q + r);
    if (error_q > error_r && error_q > error_s)
        whole_q = -whole_r - whole_s;
    else if (error_r > error_s)
        whole_r = -whole_q - whole_s;
    return (snow_site){whole_q, whole_r, 0};
}

snow_site snow_aggregate_site_of(snow_aggregate_lattice lattice, snow_point point)
{
    if (lattice == SNOW_AGGREGATE_HEXAGONAL)
        return nearest_hexagon(point);
    return (snow_site){nearest(point.x), nearest(point.y), nearest(point.z)};
}
