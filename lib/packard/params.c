#include "base/structs.h"
#include "packard/model.h"

enum { GREATEST_RADIUS = 1 << 20, GREATEST_SIDE = 1 << 21, GREATEST_CLUSTER = 1024 };

static const snow_packard_params params_defaults = {
    .struct_size = sizeof(snow_packard_params),
    .rule = 0x2A,
    .domain = SNOW_PACKARD_PLANE,
    .radius = 200,
    .width = 400,
    .height = 400,
    .scatter_side = 400,
};

void snow_packard_params_init(snow_packard_params *params, size_t struct_size)
{
    snow_struct_init(params, struct_size, &params_defaults, sizeof params_defaults);
}

const char *snow_packard_engine_name(snow_packard_engine engine)
{
    switch (engine) {
    case SNOW_PACKARD_ENGINE_AUTO: return "auto";
    case SNOW_PACKARD_ENGINE_REFERENCE: return "reference";
    case SNOW_PACKARD_ENGINE_TILES: return "tiles";
    case SNOW_PACKARD_ENGINE_QUADTREE: return "quadtree";
    }
    return NULL;
}

bool snow_packard_is_side(int32_t side)
{
    return side >= 1 && side <= GREATEST_SIDE;
}

static snow_status check_domain(const snow_packard_params *params)
{
    switch (params->domain) {
    case SNOW_PACKARD_PLANE: return params->rule % 2 == 0 ? SNOW_OK : SNOW_ERROR_PACKARD_BIRTH;
    case SNOW_PACKARD_DISC:
    case SNOW_PACKARD_HEXAGON:
        return params->radius >= 1 && params->radius <= GREATEST_RADIUS ? SNOW_OK : SNOW_ERROR_PACKARD_RADIUS;
    case SNOW_PACKARD_RECTANGLE:
    case SNOW_PACKARD_RHOMBUS:
    case SNOW_PACKARD_TORUS: break;
    }
    return snow_packard_is_side(params->width) && snow_packard_is_side(params->height) ? SNOW_OK : SNOW_ERROR_PACKARD_SIDES;
}

static snow_status check_start(const snow_packard_params *params)
{
    if (params->seeds == NULL && params->seed_count > 0)
        return SNOW_ERROR_NULL;
    if (params->cluster < 0 || params->cluster > GREATEST_CLUSTER || (params->cluster > 0 && params->seeds != NULL))
        return SNOW_ERROR_PACKARD_CLUSTER;
    if (params->scatter < 0 || (params->scatter > 0 && (params->seeds != NULL || params->cluster > 0)))
        return SNOW_ERROR_PACKARD_SCATTER;
    if (params->scatter > 0 && !snow_packard_is_side(params->scatter_side))
        return SNOW_ERROR_PACKARD_SIDES;
    return SNOW_OK;
}

static snow_status check_engine(const snow_packard_params *params)
{
    if (params->engine != SNOW_PACKARD_ENGINE_QUADTREE)
        return SNOW_OK;
    bool can = params->domain == SNOW_PACKARD_PLANE && !params->record_freeze_steps;
    return can ? SNOW_OK : SNOW_ERROR_PACKARD_ENGINE;
}

snow_status snow_packard_params_check(const snow_packard_params *params)
{
    if (!snow_is_flag(params->record_freeze_steps) || params->rule >= PACKARD_RULES)
        return SNOW_ERROR_RANGE;
    if (params->domain < SNOW_PACKARD_PLANE || params->domain > SNOW_PACKARD_TORUS ||
        params->engine < SNOW_PACKARD_ENGINE_AUTO || params->engine > SNOW_PACKARD_ENGINE_QUADTREE)
        return SNOW_ERROR_ENUM;
    snow_status status = check_domain(params);
    if (status == SNOW_OK)
        status = check_start(params);
    if (status == SNOW_OK)
        status = check_engine(params);
    return status;
}
