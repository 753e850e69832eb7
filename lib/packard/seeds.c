/* The cells that are frozen at the start. */
#include "base/random.h"
#include "packard/model.h"

static snow_status put_cell(snow_grid *grid, int64_t q, int64_t r)
{
    static const uint64_t one = 1;
    return snow_packard_put(grid, &(packard_region){q, r, 1, 1}, &one);
}

static bool is_frozen(const snow_grid *grid, int64_t q, int64_t r)
{
    const packard *model = packard_of(grid);
    uint64_t word;
    model->engine->copy(model->cells, &(packard_region){q, r, 1, 1}, &word);
    return word != 0;
}

static snow_status plant_list(snow_grid *grid, const snow_cell *seeds, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!packard_has_cell(grid, seeds[i].q, seeds[i].r))
            return SNOW_ERROR_PACKARD_SEED;
    snow_status status = SNOW_OK;
    for (size_t i = 0; i < count && status == SNOW_OK; i++)
        status = put_cell(grid, seeds[i].q, seeds[i].r);
    return status;
}

static snow_status plant_row(snow_grid *grid, const snow_packard_params *params, int32_t row, uint32_t turn,
                             bool *planted)
{
    int32_t half = params->cluster / 2;
    for (int32_t column = 0; column < params->cluster; column++) {
        if (snow_random_at(params->random_seed, SNOW_RANDOM_CLUSTER, column, row, turn) >= 0.5)
            continue;
        if (!packard_has_cell(grid, column - half, row - half))
            return SNOW_ERROR_PACKARD_SEED;
        snow_status status = put_cell(grid, column - half, row - half);
        if (status != SNOW_OK)
            return status;
        *planted = true;
    }
    return SNOW_OK;
}

/* An empty patch is drawn again. */
static snow_status plant_cluster(snow_grid *grid, const snow_packard_params *params)
{
    snow_status status = SNOW_OK;
    bool planted = false;
    for (uint32_t turn = 0; !planted && status == SNOW_OK; turn++)
        for (int32_t row = 0; row < params->cluster && status == SNOW_OK; row++)
            status = plant_row(grid, params, row, turn, &planted);
    return status;
}

static int64_t lesser(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static int64_t greater(int64_t a, int64_t b)
{
    return a > b ? a : b;
}

/* Cells of the rhombus that belong to the interior. */
static int64_t cells_of_rhombus(const snow_grid *grid, int64_t side)
{
    if (packard_is_plane(packard_of(grid)))
        return side * side;
    int64_t first = -(side / 2);
    int64_t cells = 0;
    for (int64_t r = first; r < first + side; r++) {
        snow_run_of_cells run = snow_domain_row(&grid->domain, r);
        cells += greater(0, lesser(run.end, first + side) - greater(run.first, first));
    }
    return cells;
}

/* Cells that are frozen already, or outside, are drawn again. */
static snow_status plant_scatter(snow_grid *grid, const snow_packard_params *params)
{
    int32_t side = params->scatter_side;
    if (params->scatter > (cells_of_rhombus(grid, side) + 1) / 2)
        return SNOW_ERROR_PACKARD_SCATTER;
    for (int32_t i = 0; i < params->scatter; i++) {
        int32_t q, r;
        uint32_t turn = 0;
        do {
            q = (int32_t)(snow_random_at(params->random_seed, SNOW_RANDOM_SCATTER, i, 0, turn) * side) - side / 2;
            r = (int32_t)(snow_random_at(params->random_seed, SNOW_RANDOM_SCATTER, i, 1, turn) * side) - side / 2;
            turn++;
        } while (!packard_has_cell(grid, q, r) || is_frozen(grid, q, r));
        snow_status status = put_cell(grid, q, r);
        if (status != SNOW_OK)
            return status;
    }
    return SNOW_OK;
}

snow_status snow_packard_plant(snow_grid *grid, const snow_packard_params *params)
{
    static const snow_cell origin = {0, 0};
    if (params->cluster > 0)
        return plant_cluster(grid, params);
    if (params->scatter > 0)
        return plant_scatter(grid, params);
    return params->seeds == NULL ? plant_list(grid, &origin, 1) : plant_list(grid, params->seeds, params->seed_count);
}
