#include "base/model.h"

#include "base/hexagon.h"
#include "base/options.h"

snow_status snow_grid_new(const snow_model_operations *operations, const snow_options *options, snow_grid **result)
{
    snow_options settled;
    snow_status status = snow_options_settle(options, &settled);
    if (status != SNOW_OK)
        return status;
    snow_heap heap;
    snow_heap_start(&heap, &settled);
    snow_grid *grid = snow_heap_get(&heap, 1, sizeof *grid);
    if (grid == NULL)
        return heap.refusal;
    grid->operations = operations;
    grid->heap = heap;
    grid->options = settled;
    snow_census_start(&grid->census);
    if (settled.threads > 1 && settled.parallel_for == NULL)
        status = snow_team_start(&grid->team, &grid->heap, settled.threads);
    return snow_grid_hand_over(grid, status, result);
}

void snow_grid_end(snow_grid *grid)
{
    if (grid->state != NULL)
        grid->operations->destroy(grid);
    snow_team_end(grid->team, &grid->heap);
    snow_domain_end(&grid->domain, &grid->heap);
    snow_heap heap = grid->heap; /* outlives the block that it stands in */
    snow_heap_put(&heap, grid);
}

snow_status snow_grid_hand_over(snow_grid *grid, snow_status status, snow_grid **result)
{
    if (status == SNOW_OK)
        *result = grid;
    else if (grid != NULL)
        snow_grid_end(grid);
    return status;
}

void snow_grid_for(const snow_grid *grid, size_t count, snow_task task, void *argument)
{
    if (grid->options.parallel_for != NULL && count > 1)
        grid->options.parallel_for(grid->options.parallel_context, count, task, argument);
    else if (grid->team != NULL)
        snow_team_for(grid->team, count, task, argument);
    else
        for (size_t i = 0; i < count; i++)
            task(argument, i);
}

void snow_census_start(snow_census *census)
{
    *census = (snow_census){
        .tip_square = -1,
        .hexagon = snow_hexagon_empty(),
    };
}

void snow_census_add(snow_census *census, int32_t q, int32_t r)
{
    double square = (double)snow_hexagon_square(q, r);
    census->frozen++;
    census->tip_square = square > census->tip_square ? square : census->tip_square;
    snow_hexagon_hold(&census->hexagon, q, r);
}

snow_census snow_census_of(const snow_grid *grid)
{
    snow_census census = grid->census;
    if (grid->operations->survey != NULL)
        grid->operations->survey(grid, &census);
    return census;
}

static bool tip_has_reached(const snow_grid *grid, double radius)
{
    snow_census census = snow_census_of(grid);
    return snow_census_tip(&census) >= radius;
}

snow_stop_reason snow_crystal_stops(const snow_grid *grid, const snow_stop *stop)
{
    const snow_census *census = &grid->census;
    if (stop->rim && census->rim)
        return SNOW_STOP_RIM;
    if (stop->tip_radius > 0 && tip_has_reached(grid, stop->tip_radius))
        return SNOW_STOP_RADIUS;
    if (stop->height > 0 && census->height >= stop->height)
        return SNOW_STOP_HEIGHT;
    if (stop->frozen > 0 && snow_census_frozen(census) >= stop->frozen)
        return SNOW_STOP_FROZEN;
    if (stop->still && census->still)
        return SNOW_STOP_STILL;
    if (census->full)
        return SNOW_STOP_FULL;
    if (stop->max_steps >= 0 && census->steps >= stop->max_steps)
        return SNOW_STOP_STEPS;
    return SNOW_STOP_NONE;
}

bool snow_frozen_next(const snow_grid *grid, snow_rect *part)
{
    if (grid->operations->next_frozen != NULL)
        return grid->operations->next_frozen(grid, part);
    if (part->width > 0)
        return false;
    snow_census census = snow_census_of(grid);
    *part = snow_domain_rect(&census.hexagon);
    return part->width > 0;
}
