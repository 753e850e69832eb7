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

/* The cells of the rhombus that belong to the interior. */
typedef struct scatter_place {
    int64_t side;        /* of the rhombus */
    int64_t top, height; /* rows that both have */
    int64_t longest;     /* row */
    int64_t cells;
} scatter_place;

static snow_run_of_cells row_of_place(const snow_grid *grid, int64_t side, int64_t r)
{
    int32_t first = (int32_t)-(side / 2);
    snow_run_of_cells run = {first, (int32_t)(first + side), 0};
    if (packard_is_plane(packard_of(grid)))
        return run;
    snow_run_of_cells inside = snow_domain_row(&grid->domain, r);
    run.first = (int32_t)greater(run.first, inside.first);
    run.end = (int32_t)greater(run.first, lesser(run.end, inside.end));
    return run;
}

static scatter_place find_place(const snow_grid *grid, int64_t side)
{
    scatter_place place = {.side = side, .top = -(side / 2), .height = side, .longest = side, .cells = side * side};
    if (packard_is_plane(packard_of(grid)))
        return place;
    int64_t end = lesser(place.top + side, (int64_t)grid->domain.top + grid->domain.rows);
    place.top = greater(place.top, grid->domain.top);
    place.height = greater(0, end - place.top);
    place.longest = place.cells = 0;
    for (int64_t r = place.top; r < end; r++) {
        snow_run_of_cells run = row_of_place(grid, side, r);
        place.longest = greater(place.longest, run.end - run.first);
        place.cells += run.end - run.first;
    }
    return place;
}

/* Rows and columns that both have are drawn, so that no draw takes long, however little that is of the rhombus. Cells
   that are frozen already, and columns beyond the end of a shorter row, are drawn again. */
static snow_status scatter_cell(snow_grid *grid, uint64_t seed, const scatter_place *place, int32_t i)
{
    for (uint32_t turn = 0;; turn++) {
        double column = snow_random_at(seed, SNOW_RANDOM_SCATTER, i, 0, turn);
        double row = snow_random_at(seed, SNOW_RANDOM_SCATTER, i, 1, turn);
        int64_t r = place->top + (int64_t)(row * (double)place->height);
        snow_run_of_cells run = row_of_place(grid, place->side, r);
        int64_t q = run.first + (int64_t)(column * (double)place->longest);
        if (q < run.end && !is_frozen(grid, q, r))
            return put_cell(grid, q, r);
    }
}

static snow_status plant_scatter(snow_grid *grid, const snow_packard_params *params)
{
    scatter_place place = find_place(grid, params->scatter_side);
    if (params->scatter > (place.cells + 1) / 2)
        return SNOW_ERROR_PACKARD_SCATTER;
    snow_status status = SNOW_OK;
    for (int32_t i = 0; i < params->scatter && status == SNOW_OK; i++)
        status = scatter_cell(grid, params->random_seed, &place, i);
    return status;
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
