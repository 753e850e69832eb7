#include "variant.h"

#include "plain.h"
#include "timing.h"

#include <string.h>

/* The plain program starts from a grid of the quad engine, which does not round the start. */
static const variant ways[] = {
    {.name = "plain", .plain = true, .engine = SNOW_REITER_ENGINE_QUAD, .threads = 1},
    {.name = "auto", .engine = SNOW_REITER_ENGINE_AUTO, .threads = 1},
    {.name = "rows", .engine = SNOW_REITER_ENGINE_ROWS, .threads = 1},
    {.name = "reference", .engine = SNOW_REITER_ENGINE_REFERENCE, .threads = 1},
    {.name = "quad", .engine = SNOW_REITER_ENGINE_QUAD, .threads = 1},
};

bool variant_find(const char *name, variant *found)
{
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++) {
        if (strcmp(ways[i].name, name) == 0) {
            *found = ways[i];
            return true;
        }
    }
    return false;
}

bool variant_has_precisions(const variant *way)
{
    return way->plain || way->engine != SNOW_REITER_ENGINE_QUAD;
}

bool variant_has_settings(const variant *way)
{
    return !way->plain &&
           (way->engine == SNOW_REITER_ENGINE_AUTO || way->engine == SNOW_REITER_ENGINE_ROWS);
}

static bool has_common_bits(const variant *way)
{
    return !way->plain && way->engine != SNOW_REITER_ENGINE_QUAD;
}

bool variant_same_bits(const variant *a, const variant *b)
{
    return has_common_bits(a) && has_common_bits(b) && a->precision == b->precision &&
           a->tolerance == b->tolerance && (a->tolerance == 0.0 || a->symmetry == b->symmetry);
}

bool variant_can_grow(const variant *way, const snow_scene *scene)
{
    return !way->plain || plain_supports(&scene->params);
}

snow_status variant_make_grid(const variant *way, const snow_scene *scene, bool freeze_steps, snow_grid **grid)
{
    snow_reiter_params params = scene->params;
    params.engine = way->engine;
    params.record_freeze_steps = freeze_steps;
    params.symmetry = way->symmetry;
    params.precision = way->plain ? SNOW_REITER_PRECISION_DOUBLE : way->precision;
    params.tolerance = way->tolerance;
    snow_options options;
    snow_options_init(&options, sizeof options);
    options.isa = way->isa;
    options.threads = way->threads;
    return snow_reiter_create(&params, &options, grid);
}

static const char *run_plain(const variant *way, const snow_scene *scene, const snow_grid *grid, outcome *result)
{
    plain_crystal *crystal = plain_create(&scene->params, way->precision == SNOW_REITER_PRECISION_SINGLE, grid);
    if (crystal == NULL)
        return "no memory";
    int64_t limit = scene->stop.max_steps >= 0 ? scene->stop.max_steps : INT64_MAX;
    double start = timing_now();
    plain_run(crystal, limit, scene->stop.rim != 0);
    result->seconds = timing_now() - start;
    result->steps = plain_steps(crystal);
    result->frozen = plain_frozen(crystal);
    result->memory = plain_memory(crystal);
    plain_destroy(crystal);
    return NULL;
}

static snow_status run_library(const snow_scene *scene, snow_grid *grid, outcome *result)
{
    snow_summary summary;
    snow_summary_init(&summary, sizeof summary);
    double start = timing_now();
    snow_status status = snow_run(grid, &scene->stop, &summary);
    result->seconds = timing_now() - start;
    if (status != SNOW_OK)
        return status;
    result->steps = summary.steps;
    result->frozen = summary.frozen;
    result->reason = summary.reason;
    status = snow_memory(grid, &result->memory);
    return status == SNOW_OK ? snow_digest(grid, &result->digest) : status;
}

const char *variant_run(const variant *way, const snow_scene *scene, outcome *result)
{
    snow_grid *grid = NULL;
    snow_status status = variant_make_grid(way, scene, false, &grid);
    if (status != SNOW_OK)
        return snow_strerror(status);
    *result = (outcome){.reason = SNOW_STOP_NONE};
    const char *trouble = NULL;
    status = snow_domain_cells(grid, &result->cells);
    if (status == SNOW_OK && way->plain)
        trouble = run_plain(way, scene, grid, result);
    else if (status == SNOW_OK)
        status = run_library(scene, grid, result);
    snow_destroy(grid);
    return status != SNOW_OK ? snow_strerror(status) : trouble;
}
