#include "base/structs.h"
#include "reiter/model.h"

#include <string.h>

typedef struct preset {
    const char *name;
    const char *source;
    double background;
    double addition;
    double diffusion;
    int32_t cluster;
    snow_reiter_domain domain;
} preset;

#define REITER "Reiter 2005, "
#define REPORT "Poluszejko and Grabinski, "

static const preset presets[] = {
    {"plate", REITER "fig. 3: plate", 0, 0.01, 1, 0, SNOW_REITER_DISC},
    {"thin-dendrite", REITER "fig. 4: thin dendrite", 0.3, 0.0001, 1, 0, SNOW_REITER_DISC},
    {"thick-dendrite", REITER "fig. 4: thick dendrite", 0.35, 0.001, 1, 0, SNOW_REITER_DISC},
    {"star", REITER "fig. 4: dendrite closing to a star", 0.6, 0.01, 1, 0, SNOW_REITER_DISC},
    {"sector", REITER "fig. 4: sector", 0.9, 0.05, 1, 0, SNOW_REITER_DISC},
    {"alpha-0.5", REITER "fig. 5: alpha 0.500", 0.4, 0.0001, 0.5, 0, SNOW_REITER_DISC},
    {"alpha-0.501", REITER "fig. 5: alpha 0.501", 0.4, 0.0001, 0.501, 0, SNOW_REITER_DISC},
    {"alpha-0.502", REITER "fig. 5: alpha 0.502", 0.4, 0.0001, 0.502, 0, SNOW_REITER_DISC},
    {"alpha-1", REITER "fig. 5: alpha 1", 0.4, 0.0001, 1, 0, SNOW_REITER_DISC},
    {"alpha-2.003", REITER "fig. 5: alpha 2.003", 0.4, 0.0001, 2.003, 0, SNOW_REITER_DISC},
    {"alpha-2.69", REITER "fig. 5: alpha 2.69, unstable", 0.4, 0.0001, 2.69, 0, SNOW_REITER_DISC},
    {"cluster-3", REITER "fig. 6: random cluster on a 3 x 3 patch", 0.4, 0.001, 1, 3, SNOW_REITER_DISC},
    {"cluster-5", REITER "fig. 6: random cluster on a 5 x 5 patch", 0.4, 0.001, 1, 5, SNOW_REITER_DISC},
    {"report", REPORT "600 x 600 cells, stop at row F/35", 0.4, 0.001, 1, 0, SNOW_REITER_RECTANGLE},
};

enum { PRESETS = sizeof presets / sizeof presets[0], PAPER_RADIUS = 200, REPORT_SIDE = 600 };

const char *snow_reiter_preset_name(size_t index)
{
    return index < PRESETS ? presets[index].name : NULL;
}

const char *snow_reiter_preset_source(size_t index)
{
    return index < PRESETS ? presets[index].source : NULL;
}

static void apply(const preset *chosen, snow_reiter_params *params)
{
    bool rectangle = chosen->domain == SNOW_REITER_RECTANGLE;
    params->background = chosen->background;
    params->addition = chosen->addition;
    params->diffusion = chosen->diffusion;
    params->allow_unstable = chosen->diffusion > SNOW_REITER_STABLE_DIFFUSION;
    params->cluster = chosen->cluster;
    params->domain = chosen->domain;
    params->radius = PAPER_RADIUS;
    params->width = REPORT_SIDE;
    params->height = REPORT_SIDE;
    params->rim = rectangle ? SNOW_REITER_RIM_ROW : SNOW_REITER_RIM_NEAR;
}

snow_status snow_reiter_params_preset(snow_reiter_params *caller, const char *name)
{
    if (caller == NULL || name == NULL)
        return SNOW_ERROR_NULL;
    snow_reiter_params params;
    snow_status status = snow_struct_check(caller, sizeof params, SIZE_MAX);
    if (status != SNOW_OK)
        return status;
    snow_struct_read(&params, sizeof params, caller);
    for (size_t i = 0; i < PRESETS; i++) {
        if (strcmp(presets[i].name, name) == 0) {
            apply(&presets[i], &params);
            snow_struct_write(caller, &params, sizeof params);
            return SNOW_OK;
        }
    }
    return SNOW_ERROR_REITER_PRESET;
}
