#include "aggregate/model.h"
#include "base/structs.h"

#include <math.h>

enum {
    GREATEST_SIDE = 1 << 20,
    GREATEST_DEPTH = 1 << 10,
    GREATEST_RADIUS = 1 << 20,
    GREATEST_HITS = 1 << 16,
    GREATEST_HARDNESS = (1 << 16) - 1,
    GREATEST_INTERACTION = 1024,
    GREATEST_MOBILITY = 4,
    MOST_FREE_PARTICLES = 1 << 24
};

static const snow_aggregate_params params_defaults = {
    .struct_size = sizeof(snow_aggregate_params),
    .scene = SNOW_AGGREGATE_WITTEN_SANDER,
    .lattice = SNOW_AGGREGATE_SQUARE,
    .contact = SNOW_AGGREGATE_ARRIVAL,
    .engine = SNOW_AGGREGATE_ENGINE_AUTO,
    .sticking = 1,
    .hits = 1,
    .launch_radius = 100,
    .end_radius = 90,
    .width = 256,
    .height = 256,
    .depth = 64,
    .launch_first = INT32_MIN,
    .launch_last = INT32_MAX,
    .cathode_first = INT32_MIN,
    .cathode_last = INT32_MAX,
    .hardness_least = 1,
    .hardness_greatest = 3,
    .wall_right = 255,
    .wall_right_top = 255,
    .particles = 10000,
    .density = 0.05,
};

void snow_aggregate_params_init(snow_aggregate_params *params, size_t struct_size)
{
    snow_struct_init(params, struct_size, &params_defaults, sizeof params_defaults);
}

static bool is_within(int64_t number, int64_t least, int64_t greatest)
{
    return number >= least && number <= greatest;
}

bool snow_aggregate_has_floor(const snow_aggregate_params *params)
{
    return params->scene == SNOW_AGGREGATE_LINE || params->scene == SNOW_AGGREGATE_ELECTROLYSIS ||
           params->scene == SNOW_AGGREGATE_SHORE || params->scene == SNOW_AGGREGATE_CHIMNEY;
}

static snow_status check_enumerations(const snow_aggregate_params *params)
{
    bool known = is_within(params->scene, SNOW_AGGREGATE_WITTEN_SANDER, SNOW_AGGREGATE_OFF_LATTICE) &&
                 is_within(params->lattice, SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_CUBIC) &&
                 is_within(params->contact, SNOW_AGGREGATE_ARRIVAL, SNOW_AGGREGATE_ENTRY) &&
                 is_within(params->engine, SNOW_AGGREGATE_ENGINE_AUTO, SNOW_AGGREGATE_ENGINE_STEPS);
    return known ? SNOW_OK : SNOW_ERROR_ENUM;
}

static bool is_finite(const snow_aggregate_params *params)
{
    return isfinite(params->sticking) && isfinite(params->kill_radius) && isfinite(params->interaction) &&
           isfinite(params->density) && isfinite(params->mobility);
}

/* The scenes whose walkers take the steps of any lattice. */
static bool is_general(const snow_aggregate_params *params)
{
    return params->scene == SNOW_AGGREGATE_WITTEN_SANDER || params->scene == SNOW_AGGREGATE_LABORATORY ||
           params->scene == SNOW_AGGREGATE_LINE;
}

static bool has_lattice(const snow_aggregate_params *params)
{
    if (is_general(params) || params->scene == SNOW_AGGREGATE_OFF_LATTICE)
        return true;
    if (params->scene == SNOW_AGGREGATE_CLUSTER_CLUSTER)
        return params->lattice != SNOW_AGGREGATE_HEXAGONAL;
    return params->lattice == SNOW_AGGREGATE_SQUARE;
}

static bool has_engine(const snow_aggregate_params *params)
{
    bool can_jump = params->scene == SNOW_AGGREGATE_WITTEN_SANDER || params->scene == SNOW_AGGREGATE_LABORATORY ||
                    (params->scene == SNOW_AGGREGATE_LINE && !params->periodic);
    switch (params->engine) {
    case SNOW_AGGREGATE_ENGINE_AUTO: return true;
    case SNOW_AGGREGATE_ENGINE_JUMPS: return can_jump && params->kill_radius == 0;
    case SNOW_AGGREGATE_ENGINE_STEPS: break;
    }
    return is_general(params);
}

static snow_status check_contact(const snow_aggregate_params *params)
{
    bool alone = params->scene == SNOW_AGGREGATE_SHORE || params->scene == SNOW_AGGREGATE_CLUSTER_CLUSTER ||
                 params->scene == SNOW_AGGREGATE_OFF_LATTICE;
    if (!has_lattice(params))
        return SNOW_ERROR_AGGREGATE_LATTICE;
    if (params->contact != SNOW_AGGREGATE_ARRIVAL && !is_general(params))
        return SNOW_ERROR_AGGREGATE_CONTACT;
    if (!(params->sticking > 0 && params->sticking <= 1))
        return SNOW_ERROR_AGGREGATE_STICKING;
    if (!is_within(params->hits, 1, GREATEST_HITS) || (params->hits > 1 && alone))
        return SNOW_ERROR_AGGREGATE_HITS;
    if (params->kill_radius != 0 &&
        !(params->kill_radius > 1 && params->kill_radius <= GREATEST_RADIUS &&
          params->scene == SNOW_AGGREGATE_WITTEN_SANDER && params->engine == SNOW_AGGREGATE_ENGINE_STEPS))
        return SNOW_ERROR_AGGREGATE_KILL;
    return has_engine(params) ? SNOW_OK : SNOW_ERROR_AGGREGATE_ENGINE;
}

static snow_status check_lists(const snow_aggregate_params *params)
{
    if ((params->seeds == NULL && params->seed_count > 0) || (params->obstacles == NULL && params->obstacle_count > 0))
        return SNOW_ERROR_NULL;
    if (params->seed_count > AGGREGATE_MOST_SEEDS || params->obstacle_count > AGGREGATE_MOST_SEEDS)
        return SNOW_ERROR_AGGREGATE_PARTICLES;
    if (params->obstacle_count > 0 && !is_general(params))
        return SNOW_ERROR_AGGREGATE_OBSTACLE;
    bool own_matter = params->scene == SNOW_AGGREGATE_SHORE || params->scene == SNOW_AGGREGATE_CLUSTER_CLUSTER;
    return params->seed_count > 0 && own_matter ? SNOW_ERROR_AGGREGATE_SEED : SNOW_OK;
}

static snow_status check_box(const snow_aggregate_params *params)
{
    bool space = aggregate_is_space(params);
    if (!is_within(params->width, 1, GREATEST_SIDE) || !is_within(params->height, 1, GREATEST_SIDE) ||
        (space && !is_within(params->depth, 1, GREATEST_DEPTH)))
        return SNOW_ERROR_AGGREGATE_SIDES;
    if (space && (params->width >= AGGREGATE_REACH_SPACE || params->height >= AGGREGATE_REACH_SPACE))
        return SNOW_ERROR_AGGREGATE_SIDES;
    return SNOW_OK;
}

static snow_status check_laboratory(const snow_aggregate_params *params)
{
    int32_t greatest = aggregate_is_space(params) ? GREATEST_RADIUS / 8 : GREATEST_RADIUS;
    bool sound = is_within(params->launch_radius, 2, greatest) &&
                 is_within(params->end_radius, 1, params->launch_radius - 1);
    return sound ? SNOW_OK : SNOW_ERROR_AGGREGATE_RADIUS;
}

static snow_status check_electrolysis(const snow_aggregate_params *params)
{
    if (params->interaction < 0 || params->interaction > GREATEST_INTERACTION)
        return SNOW_ERROR_AGGREGATE_INTERACTION;
    if (params->launch_first > params->launch_last || params->launch_last < 0 || params->launch_first >= params->width)
        return SNOW_ERROR_AGGREGATE_LAUNCH;
    return SNOW_OK;
}

static snow_status check_shore(const snow_aggregate_params *params)
{
    bool sound = params->hardness_least >= 1 && params->hardness_greatest <= GREATEST_HARDNESS &&
                 params->hardness_least <= params->hardness_greatest;
    return sound ? SNOW_OK : SNOW_ERROR_AGGREGATE_HARDNESS;
}

static snow_status check_chimney(const snow_aggregate_params *params)
{
    bool inside = params->wall_left >= 0 && params->wall_left_top >= 0 && params->wall_right < params->width &&
                  params->wall_right_top < params->width;
    bool apart = (int64_t)params->wall_right - params->wall_left >= 2 &&
                 (int64_t)params->wall_right_top - params->wall_left_top >= 2;
    return inside && apart ? SNOW_OK : SNOW_ERROR_AGGREGATE_WALLS;
}

static snow_status check_clusters(const snow_aggregate_params *params)
{
    if (params->particles < 1 || params->particles > MOST_FREE_PARTICLES)
        return SNOW_ERROR_AGGREGATE_PARTICLES;
    if (!(params->density > 0 && params->density <= 0.5))
        return SNOW_ERROR_AGGREGATE_DENSITY;
    return params->mobility >= 0 && params->mobility <= GREATEST_MOBILITY ? SNOW_OK : SNOW_ERROR_AGGREGATE_MOBILITY;
}

static snow_status check_scene(const snow_aggregate_params *params)
{
    snow_status status = snow_aggregate_has_floor(params) ? check_box(params) : SNOW_OK;
    if (status != SNOW_OK)
        return status;
    switch (params->scene) {
    case SNOW_AGGREGATE_LABORATORY: return check_laboratory(params);
    case SNOW_AGGREGATE_ELECTROLYSIS: return check_electrolysis(params);
    case SNOW_AGGREGATE_SHORE: return check_shore(params);
    case SNOW_AGGREGATE_CHIMNEY: return check_chimney(params);
    case SNOW_AGGREGATE_CLUSTER_CLUSTER: return check_clusters(params);
    case SNOW_AGGREGATE_WITTEN_SANDER:
    case SNOW_AGGREGATE_LINE:
    case SNOW_AGGREGATE_SNOWFLAKE:
    case SNOW_AGGREGATE_OFF_LATTICE: break;
    }
    return SNOW_OK;
}

snow_status snow_aggregate_params_check(const snow_aggregate_params *params)
{
    if (!snow_is_flag(params->record_order) || !snow_is_flag(params->periodic))
        return SNOW_ERROR_RANGE;
    snow_status status = check_enumerations(params);
    if (status == SNOW_OK && !is_finite(params))
        status = SNOW_ERROR_NOT_FINITE;
    if (status == SNOW_OK)
        status = check_contact(params);
    if (status == SNOW_OK)
        status = check_lists(params);
    if (status == SNOW_OK)
        status = check_scene(params);
    return status;
}
