/* Steps: walkers one by one until particles have joined. */
#include "aggregate/model.h"

/* After so many particles whoever runs the grid may look at the clock; after fewer where each takes many walkers, or
   each walker many steps. */
static int64_t slice(const snow_aggregate_params *params)
{
    enum { MOST = 4096, LEAST = 16 };
    int64_t particles = (int64_t)(MOST * params->sticking) / params->hits;
    return particles > LEAST ? particles : LEAST;
}

bool snow_aggregate_stops(const snow_grid *grid, const snow_stop *stop)
{
    return grid->census.full || (stop != NULL && snow_crystal_stops(grid, stop) != SNOW_STOP_NONE);
}

static snow_status make_room(snow_grid *grid)
{
    aggregate *model = aggregate_of(grid);
    snow_status status = model->scene->prepare != NULL ? model->scene->prepare(grid) : SNOW_OK;
    if (status == SNOW_OK && model->params.hits > 1)
        status = snow_table_reserve(&model->hits, &grid->heap, 1);
    return status;
}

/* One walker; *joined: whether a particle came of it. */
static snow_status send_walker(snow_grid *grid, bool *joined)
{
    aggregate *model = aggregate_of(grid);
    snow_status status = make_room(grid);
    if (status != SNOW_OK)
        return status;
    snow_stream stream = snow_stream_start(model->params.random_seed, SNOW_RANDOM_WALK, model->walkers);
    snow_site end;
    *joined = model->scene->walk(grid, &stream, &end);
    model->walkers++;
    *joined = *joined && snow_aggregate_hit(grid, end);
    if (*joined) {
        model->scene->place(grid, end); /* there is room */
        snow_aggregate_join(grid, end);
        grid->census.steps++;
    }
    return SNOW_OK;
}

static snow_status send_walkers(snow_grid *grid, int64_t most, const snow_stop *stop)
{
    int64_t taken = 0;
    for (int32_t walkers = 0; taken < most && walkers < AGGREGATE_TURN; walkers++) {
        bool joined;
        snow_status status = send_walker(grid, &joined);
        if (status != SNOW_OK)
            return status;
        taken += joined;
        if (joined && snow_aggregate_stops(grid, stop))
            break;
    }
    return SNOW_OK;
}

snow_status snow_aggregate_advance(snow_grid *grid, int64_t most, const snow_stop *stop)
{
    const aggregate *model = aggregate_of(grid);
    if (grid->census.full)
        return SNOW_ERROR_FULL;
    int64_t slice_most = slice(&model->params);
    most = most < slice_most ? most : slice_most;
    uint64_t room = AGGREGATE_MOST_PARTICLES - model->sites.count;
    most = (uint64_t)most < room ? most : (int64_t)room;
    snow_status status = model->scene->count == NULL ? snow_aggregate_reserve(grid, (uint64_t)most) : SNOW_OK;
    if (status != SNOW_OK)
        return status;
    status = model->scene->grow != NULL ? model->scene->grow(grid, most, stop) : send_walkers(grid, most, stop);
    snow_aggregate_follow(grid);
    return status;
}
