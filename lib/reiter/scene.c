/* The start of a scene: background, noise, seeds. */
#include "base/hexagon.h"
#include "base/random.h"
#include "reiter/model.h"

static double noise_at(const snow_reiter_params *params, int32_t q, int32_t r)
{
    snow_cell cell = params->noise_symmetric ? snow_hexagon_canonical(q, r) : (snow_cell){q, r};
    return params->noise * (2 * snow_random_at(params->random_seed, SNOW_RANDOM_NOISE, cell.q, cell.r, 0) - 1);
}

static snow_status start_value(const snow_grid *grid, const snow_reiter_params *params, int32_t q, int32_t r,
                               double *value)
{
    *value = params->background;
    if (params->background_at != NULL)
        *value = params->background_at(params->field_context, q, r);
    if (!isfinite(*value))
        return SNOW_ERROR_NOT_FINITE;
    if (!reiter_is_vapour(*value))
        return SNOW_ERROR_REITER_BACKGROUND;
    if (!reiter_is_vapour(*value - params->noise) || !reiter_is_vapour(*value + params->noise))
        return SNOW_ERROR_REITER_NOISE;
    if (params->noise > 0 && snow_domain_has(&grid->domain, q, r))
        *value += noise_at(params, q, r);
    return SNOW_OK;
}

static snow_status fill(snow_grid *grid, const snow_reiter_params *params)
{
    const reiter *model = reiter_of(grid);
    const snow_domain *hull = &model->hull;
    for (int32_t row = 0; row < hull->rows; row++) {
        for (int32_t q = hull->run[row].first; q < hull->run[row].end; q++) {
            reiter_cell cell = {0};
            snow_status status = start_value(grid, params, q, hull->top + row, &cell.value);
            if (status != SNOW_OK)
                return status;
            model->engine->put(grid, q, hull->top + row, &cell);
        }
    }
    return SNOW_OK;
}

static snow_status fill_additions(snow_grid *grid, const snow_reiter_params *params)
{
    reiter *model = reiter_of(grid);
    const snow_domain *hull = &model->hull;
    if (params->addition_at == NULL)
        return SNOW_OK;
    model->addition_at = snow_heap_get(&grid->heap, hull->cells, sizeof *model->addition_at);
    if (model->addition_at == NULL)
        return grid->heap.refusal;
    for (int32_t row = 0; row < hull->rows; row++) {
        const snow_run_of_cells *run = &hull->run[row];
        for (int32_t q = run->first; q < run->end; q++) {
            double addition = params->addition_at(params->field_context, q, hull->top + row);
            if (!isfinite(addition))
                return SNOW_ERROR_NOT_FINITE;
            if (addition < 0 || addition > 1)
                return SNOW_ERROR_REITER_ADDITION;
            model->addition_at[run->number + (size_t)(q - run->first)] = addition;
        }
    }
    return SNOW_OK;
}

static snow_status plant(snow_grid *grid, int64_t q, int64_t r)
{
    const reiter *model = reiter_of(grid);
    if (!snow_domain_has(&grid->domain, q, r))
        return SNOW_ERROR_REITER_SEED;
    bool planted = model->engine->get(grid, (int32_t)q, (int32_t)r).frozen;
    reiter_cell seed = {.value = 1, .frozen = true};
    model->engine->put(grid, (int32_t)q, (int32_t)r, &seed);
    if (!planted)
        snow_reiter_freeze(grid, (int32_t)q, (int32_t)r);
    return SNOW_OK;
}

/* A patch of side rows of side cells, odd rows half a cell to the right, the
   origin in its middle. */
static snow_status plant_patch(snow_grid *grid, const snow_reiter_params *params, uint32_t turn, bool *planted)
{
    int32_t half = params->cluster / 2;
    for (int32_t row = 0; row < params->cluster; row++) {
        for (int32_t column = 0; column < params->cluster; column++) {
            if (snow_random_at(params->random_seed, SNOW_RANDOM_CLUSTER, column, row, turn) >= 0.5)
                continue;
            snow_status status = plant(grid, column - half + half / 2 - row / 2, row - half);
            if (status != SNOW_OK)
                return status;
            *planted = true;
        }
    }
    return SNOW_OK;
}

/* An empty patch is drawn again. */
static snow_status plant_cluster(snow_grid *grid, const snow_reiter_params *params)
{
    bool planted = false;
    snow_status status = SNOW_OK;
    for (uint32_t turn = 0; !planted && status == SNOW_OK; turn++)
        status = plant_patch(grid, params, turn, &planted);
    return status;
}

static snow_status plant_seeds(snow_grid *grid, const snow_reiter_params *params)
{
    if (params->cluster > 0)
        return plant_cluster(grid, params);
    if (params->seeds == NULL)
        return plant(grid, 0, 0);
    snow_status status = SNOW_OK;
    for (size_t i = 0; i < params->seed_count && status == SNOW_OK; i++)
        status = plant(grid, params->seeds[i].q, params->seeds[i].r);
    return status;
}

snow_status snow_reiter_scene(snow_grid *grid, const snow_reiter_params *params)
{
    snow_status status = fill_additions(grid, params);
    if (status == SNOW_OK)
        status = fill(grid, params);
    if (status == SNOW_OK)
        status = plant_seeds(grid, params);
    if (status != SNOW_OK)
        return status;
    snow_reiter_choose_bound(grid);
    reiter_of(grid)->engine->settle(grid);
    return SNOW_OK;
}
