#include "aggregate/model.h"
#include "base/structs.h"

#include <string.h>

#define SHIPILEVSKY "Shipilevsky 1989, "
#define SHEET "Laboratory sheet on fractal clusters, "

typedef struct preset {
    const char *name;
    const char *source;
    snow_aggregate_params scene; /* what differs from the defaults */
} preset;

/* The program's screen was 256 dots wide; its figures do not say their sizes. */
static const preset presets[] = {
    {"witten-sander", "Witten and Sander 1981: one seed, walkers from infinity",
     {.scene = SNOW_AGGREGATE_WITTEN_SANDER}},
    {"shore", SHIPILEVSKY "fig. 1: shore line",
     {.scene = SNOW_AGGREGATE_SHORE, .height = 192, .hardness_least = 1, .hardness_greatest = 8}},
    {"segment", SHIPILEVSKY "fig. 2: electrolysis on a short cathode",
     {.scene = SNOW_AGGREGATE_ELECTROLYSIS, .height = 192, .cathode_first = 124, .cathode_last = 131}},
    {"electrolysis", SHIPILEVSKY "fig. 3: electrolysis, no interaction radius",
     {.scene = SNOW_AGGREGATE_ELECTROLYSIS, .height = 192}},
    {"forest", SHIPILEVSKY "fig. 4: electrolysis, interaction radius 10",
     {.scene = SNOW_AGGREGATE_ELECTROLYSIS, .height = 192, .interaction = 10}},
    {"chimney", SHIPILEVSKY "fig. 5: chimney",
     {.scene = SNOW_AGGREGATE_CHIMNEY, .height = 192, .wall_right = 255, .wall_right_top = 223, .wall_left_top = 32}},
    {"snowflake", SHIPILEVSKY "fig. 6: snowflake", {.scene = SNOW_AGGREGATE_SNOWFLAKE}},
    {"laboratory", SHEET "fig. 18a: point seed",
     {.scene = SNOW_AGGREGATE_LABORATORY, .launch_radius = 120, .end_radius = 100}},
    {"line", SHEET "fig. 18b: trees on the floor of a vessel", {.scene = SNOW_AGGREGATE_LINE, .height = 192}},
};

enum { PRESETS = sizeof presets / sizeof presets[0] };

const char *snow_aggregate_preset_name(size_t index)
{
    return index < PRESETS ? presets[index].name : NULL;
}

const char *snow_aggregate_preset_source(size_t index)
{
    return index < PRESETS ? presets[index].source : NULL;
}

static int32_t given(int32_t number, int32_t otherwise)
{
    return number != 0 ? number : otherwise;
}

static void apply(const snow_aggregate_params *scene, snow_aggregate_params *params)
{
    snow_aggregate_params fresh;
    snow_aggregate_params_init(&fresh, sizeof fresh);
    fresh.scene = scene->scene;
    fresh.random_seed = params->random_seed;
    fresh.record_order = params->record_order;
    fresh.height = given(scene->height, fresh.height);
    fresh.launch_radius = given(scene->launch_radius, fresh.launch_radius);
    fresh.end_radius = given(scene->end_radius, fresh.end_radius);
    fresh.hardness_greatest = given(scene->hardness_greatest, fresh.hardness_greatest);
    fresh.cathode_first = given(scene->cathode_first, fresh.cathode_first);
    fresh.cathode_last = given(scene->cathode_last, fresh.cathode_last);
    fresh.interaction = scene->interaction;
    fresh.wall_left_top = scene->wall_left_top;
    fresh.wall_right_top = given(scene->wall_right_top, fresh.wall_right_top);
    *params = fresh;
}

snow_status snow_aggregate_params_preset(snow_aggregate_params *caller, const char *name)
{
    if (caller == NULL || name == NULL)
        return SNOW_ERROR_NULL;
    snow_aggregate_params params;
    snow_status status = snow_struct_check(caller, sizeof params, SIZE_MAX);
    if (status != SNOW_OK)
        return status;
    snow_struct_read(&params, sizeof params, caller);
    for (size_t i = 0; i < PRESETS; i++) {
        if (strcmp(presets[i].name, name) == 0) {
            apply(&presets[i].scene, &params);
            snow_struct_write(caller, &params, sizeof params);
            return SNOW_OK;
        }
    }
    return SNOW_ERROR_AGGREGATE_PRESET;
}
