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

static snow_status fill_cells(snow_grid *grid, const snow_reiter_params *params, snow_walk walk)
{
    while (snow_walk_next(&walk)) {
        reiter_cell cell = {0};
        snow_status status = start_value(grid, params, walk.cell.q, walk.cell.r, &cell.value);
        if (status != SNOW_OK)
            return status;
        reiter_of(grid)->engine->put(grid, walk.cell.q, walk.cell.r, &cell);
    }
    return SNOW_OK;
}

static snow_status fill_additions(snow_grid *grid, const snow_reiter_params *params)
{
    reiter *model = reiter_of(grid);
    if (params->addition_at == NULL)
        return SNOW_OK;
    model->addition_at = snow_heap_get(&grid->heap, model->engine->numbers(grid), sizeof *model->addition_at);
    if (model->addition_at == NULL)
        return grid->heap.refusal;
    for (snow_walk walk = reiter_walk_part(grid); snow_walk_next(&walk);) {
        double addition = params->addition_at(params->field_context, walk.cell.q, walk.cell.r);
        if (!isfinite(addition))
            return SNOW_ERROR_NOT_FINITE;
        if (addition < 0 || addition > 1)
            return SNOW_ERROR_REITER_ADDITION;
        model->addition_at[model->engine->number(grid, walk.cell.q, walk.cell.r)] = addition;
    }
    return SNOW_OK;
}

/* The cells that are ice at the start. */
typedef struct seed_list {
    snow_cell *cell;
    size_t count;
} seed_list;

static snow_status copy_seeds(snow_grid *grid, const snow_cell *cells, size_t count, seed_list *seeds)
{
    seeds->cell = snow_heap_get_raw(&grid->heap, count, sizeof *seeds->cell);
    if (seeds->cell == NULL)
        return grid->heap.refusal;
    for (size_t i = 0; i < count; i++)
        seeds->cell[i] = cells[i];
    seeds->count = count;
    return SNOW_OK;
}

/* A patch of side rows of side cells, odd rows half a cell to the right, the
   origin in its middle. */
static void draw_patch(const snow_reiter_params *params, uint32_t turn, seed_list *seeds)
{
    int32_t half = params->cluster / 2;
    for (int32_t row = 0; row < params->cluster; row++) {
        for (int32_t column = 0; column < params->cluster; column++) {
            if (snow_random_at(params->random_seed, SNOW_RANDOM_CLUSTER, column, row, turn) < 0.5)
                seeds->cell[seeds->count++] = (snow_cell){column - half + half / 2 - row / 2, row - half};
        }
    }
}

/* An empty patch is drawn again. */
static snow_status draw_cluster(snow_grid *grid, const snow_reiter_params *params, seed_list *seeds)
{
    size_t side = (size_t)params->cluster;
    seeds->cell = snow_heap_get_raw(&grid->heap, side * side, sizeof *seeds->cell);
    if (seeds->cell == NULL)
        return grid->heap.refusal;
    for (uint32_t turn = 0; seeds->count == 0; turn++)
        draw_patch(params, turn, seeds);
    return SNOW_OK;
}

static snow_status list_seeds(snow_grid *grid, const snow_reiter_params *params, seed_list *seeds)
{
    static const snow_cell origin = {0, 0};
    snow_status status;
    if (params->cluster > 0)
        status = draw_cluster(grid, params, seeds);
    else if (params->seeds == NULL)
        status = copy_seeds(grid, &origin, 1, seeds);
    else
        status = copy_seeds(grid, params->seeds, params->seed_count, seeds);
    for (size_t i = 0; i < seeds->count && status == SNOW_OK; i++)
        if (!snow_domain_has(&grid->domain, seeds->cell[i].q, seeds->cell[i].r))
            status = SNOW_ERROR_REITER_SEED;
    return status;
}

/* Fields that the caller gives cell by cell are taken to have no symmetry. */
static snow_group group_of(const snow_grid *grid, const snow_reiter_params *params, seed_list *seeds)
{
    bool asymmetric = params->symmetry == SNOW_REITER_SYMMETRY_NONE || params->background_at != NULL ||
                      params->addition_at != NULL || (params->noise > 0 && !params->noise_symmetric);
    if (asymmetric)
        return SNOW_GROUP_TRIVIAL;
    return snow_group_of_domain(&grid->domain) & snow_reiter_group_of_seeds(seeds->cell, seeds->count);
}

/* Seeds that are images of each other are one cell of the part. */
static void plant(snow_grid *grid, const seed_list *seeds)
{
    const reiter *model = reiter_of(grid);
    for (size_t i = 0; i < seeds->count; i++) {
        snow_cell at = snow_group_representative(model->group, seeds->cell[i].q, seeds->cell[i].r);
        bool planted = model->engine->get(grid, at.q, at.r).frozen;
        reiter_cell seed = {.value = 1, .frozen = true};
        model->engine->put(grid, at.q, at.r, &seed);
        if (!planted)
            snow_reiter_freeze(grid, at.q, at.r);
    }
}

static snow_status set_scene(snow_grid *grid, const snow_reiter_params *params, seed_list *seeds)
{
    snow_status status = list_seeds(grid, params, seeds);
    if (status == SNOW_OK)
        status = snow_reiter_equip(grid, group_of(grid, params, seeds));
    if (status == SNOW_OK)
        status = fill_additions(grid, params);
    if (status == SNOW_OK)
        status = fill_cells(grid, params, reiter_walk_part(grid));
    if (status == SNOW_OK)
        status = fill_cells(grid, params, reiter_walk_fixed(grid));
    if (status != SNOW_OK)
        return status;
    plant(grid, seeds);
    snow_reiter_choose_bound(grid);
    reiter_of(grid)->engine->settle(grid);
    return SNOW_OK;
}

snow_status snow_reiter_scene(snow_grid *grid, const snow_reiter_params *params)
{
    seed_list seeds = {NULL, 0};
    snow_status status = set_scene(grid, params, &seeds);
    snow_heap_put(&grid->heap, seeds.cell);
    return status;
}
