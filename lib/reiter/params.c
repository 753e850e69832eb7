#include "base/structs.h"
#include "reiter/model.h"

enum { GREATEST_RADIUS = 1 << 20, GREATEST_SIDE = 1 << 21, GREATEST_CLUSTER = 1024 };

static const double greatest_unstable_diffusion = 4;

static const snow_reiter_params params_defaults = {
    .struct_size = sizeof(snow_reiter_params),
    .background = 0.4,
    .addition = 0.001,
    .diffusion = 1,
    .domain = SNOW_REITER_DISC,
    .radius = 200,
    .width = 600,
    .height = 600,
    .rim = SNOW_REITER_RIM_NEAR,
};

void snow_reiter_params_init(snow_reiter_params *params, size_t struct_size)
{
    snow_struct_init(params, struct_size, &params_defaults, sizeof params_defaults);
}

void snow_reiter_conditions_init(snow_reiter_conditions *conditions, size_t struct_size)
{
    static const snow_reiter_conditions defaults = {
        .struct_size = sizeof defaults, .background = 0.4, .addition = 0.001, .diffusion = 1, .rescale = 1};
    snow_struct_init(conditions, struct_size, &defaults, sizeof defaults);
}

snow_status snow_reiter_conditions_check(double background, double addition, double diffusion, bool allow_unstable)
{
    if (!isfinite(background) || !isfinite(addition) || !isfinite(diffusion))
        return SNOW_ERROR_NOT_FINITE;
    if (!reiter_is_vapour(background))
        return SNOW_ERROR_REITER_BACKGROUND;
    if (addition < 0 || addition > 1)
        return SNOW_ERROR_REITER_ADDITION;
    if (diffusion < 0 || diffusion > (allow_unstable ? greatest_unstable_diffusion : SNOW_REITER_STABLE_DIFFUSION))
        return SNOW_ERROR_REITER_DIFFUSION;
    return SNOW_OK;
}

static snow_status check_enumerations(const snow_reiter_params *params)
{
    bool known = params->domain >= SNOW_REITER_DISC && params->domain <= SNOW_REITER_RECTANGLE &&
                 params->rim >= SNOW_REITER_RIM_NEAR && params->rim <= SNOW_REITER_RIM_ROW &&
                 params->engine >= SNOW_REITER_ENGINE_AUTO && params->engine <= SNOW_REITER_ENGINE_QUAD &&
                 params->symmetry >= SNOW_REITER_SYMMETRY_AUTO && params->symmetry <= SNOW_REITER_SYMMETRY_NONE &&
                 params->precision >= SNOW_REITER_PRECISION_DOUBLE && params->precision <= SNOW_REITER_PRECISION_SINGLE;
    return known ? SNOW_OK : SNOW_ERROR_ENUM;
}

static bool is_side(int32_t side)
{
    return side >= 1 && side <= GREATEST_SIDE;
}

static snow_status check_domain(const snow_reiter_params *params)
{
    bool rectangle = params->domain == SNOW_REITER_RECTANGLE;
    if (rectangle && (!is_side(params->width) || !is_side(params->height)))
        return SNOW_ERROR_REITER_SIDES;
    if (!rectangle && (params->radius < 1 || params->radius > GREATEST_RADIUS))
        return SNOW_ERROR_REITER_RADIUS;
    if (params->rim == SNOW_REITER_RIM_ROW && !rectangle)
        return SNOW_ERROR_REITER_RIM;
    return SNOW_OK;
}

static snow_status check_start(const snow_reiter_params *params)
{
    if (!isfinite(params->noise))
        return SNOW_ERROR_NOT_FINITE;
    if (params->noise < 0 || params->noise >= 1)
        return SNOW_ERROR_REITER_NOISE;
    if (params->seeds == NULL && params->seed_count > 0)
        return SNOW_ERROR_NULL;
    if (params->cluster < 0 || params->cluster > GREATEST_CLUSTER || (params->cluster > 0 && params->seeds != NULL))
        return SNOW_ERROR_REITER_CLUSTER;
    return SNOW_OK;
}

static snow_status check_exactness(const snow_reiter_params *params)
{
    if (params->precision == SNOW_REITER_PRECISION_SINGLE && params->engine == SNOW_REITER_ENGINE_QUAD)
        return SNOW_ERROR_REITER_PRECISION;
    if (!isfinite(params->tolerance))
        return SNOW_ERROR_NOT_FINITE;
    bool skips = params->engine == SNOW_REITER_ENGINE_AUTO || params->engine == SNOW_REITER_ENGINE_ROWS;
    if (params->tolerance < 0 || params->tolerance > (skips ? 1 : 0))
        return SNOW_ERROR_REITER_TOLERANCE;
    return SNOW_OK;
}

snow_status snow_reiter_params_check(const snow_reiter_params *params)
{
    if (!snow_is_flag(params->record_freeze_steps) || !snow_is_flag(params->allow_unstable) || !snow_is_flag(params->noise_symmetric))
        return SNOW_ERROR_RANGE;
    snow_status status = check_enumerations(params);
    if (status == SNOW_OK)
        status = snow_reiter_conditions_check(params->background, params->addition, params->diffusion,
                                              params->allow_unstable != 0);
    if (status == SNOW_OK)
        status = check_domain(params);
    if (status == SNOW_OK)
        status = check_start(params);
    if (status == SNOW_OK)
        status = check_exactness(params);
    return status;
}
