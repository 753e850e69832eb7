#define _POSIX_C_SOURCE 200809L
#include "base/floating.h"
#include "base/model.h"
#include "base/structs.h"
#include "grid/stop.h"

#include <math.h>
#include <time.h>

static const int64_t greatest_step = INT64_C(1) << 62;

static const snow_stop stop_defaults = {
    .struct_size = sizeof(snow_stop),
    .max_steps = 10000,
    .rim = 1,
    .still = 1,
    .progress_steps = 100,
};

void snow_stop_init(snow_stop *stop, size_t struct_size)
{
    snow_struct_init(stop, struct_size, &stop_defaults, sizeof stop_defaults);
}

void snow_summary_init(snow_summary *summary, size_t struct_size)
{
    static const snow_summary empty = {.struct_size = sizeof empty};
    snow_struct_init(summary, struct_size, &empty, sizeof empty);
}

void snow_destroy(snow_grid *grid)
{
    if (grid != NULL)
        snow_grid_end(grid);
}

static int64_t lesser(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

/* One step or more; `until` is a step count. */
static snow_status advance(snow_grid *grid, int64_t until, const snow_stop *stop)
{
    int64_t steps = grid->census.steps;
    if (steps >= greatest_step)
        return SNOW_ERROR_STEP_LIMIT;
    return grid->operations->advance(grid, lesser(until, greatest_step) - steps, stop);
}

snow_status snow_step(snow_grid *grid, int64_t steps)
{
    if (grid == NULL)
        return SNOW_ERROR_NULL;
    if (steps < 0)
        return SNOW_ERROR_RANGE;
    if (grid->busy)
        return SNOW_ERROR_BUSY;
    snow_floating floating;
    snow_floating_enter(&floating);
    snow_status status = SNOW_OK;
    int64_t until = steps < INT64_MAX - grid->census.steps ? grid->census.steps + steps : INT64_MAX;
    while (grid->census.steps < until && status == SNOW_OK)
        status = advance(grid, until, NULL);
    snow_floating_leave(&floating);
    return status;
}

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static SNOW_APART snow_summary summarise(const snow_grid *grid, snow_stop_reason reason, double started)
{
    snow_census census = snow_census_of(grid);
    return (snow_summary){
        .struct_size = sizeof(snow_summary),
        .reason = reason,
        .steps = grid->census.steps,
        .frozen = snow_census_frozen(&grid->census),
        .tip_radius = snow_census_tip(&census),
        .seconds = now() - started,
    };
}

/* The next step count after which something other than the crystal may end the run. */
static int64_t next_look(const snow_grid *grid, const snow_stop *stop)
{
    int64_t until = stop->max_steps >= 0 ? stop->max_steps : greatest_step;
    if (stop->progress != NULL) {
        int64_t interval = stop->progress_steps;
        int64_t to_next = interval - grid->census.steps % interval;
        until = lesser(until, grid->census.steps + lesser(to_next, greatest_step));
    }
    return until;
}

/* The callback runs in the caller's own floating-point state. */
static bool is_cancelled(snow_grid *grid, const snow_stop *stop, double started, const snow_floating *floating)
{
    if (stop->progress == NULL)
        return false;
    snow_summary summary = summarise(grid, SNOW_STOP_NONE, started);
    snow_floating again;
    snow_floating_leave(floating);
    grid->busy = true;
    int answer = stop->progress(stop->progress_context, grid, &summary);
    grid->busy = false;
    snow_floating_enter(&again);
    return answer != 0;
}

static snow_status run(snow_grid *grid, const snow_stop *stop, double started, const snow_floating *floating,
                       snow_stop_reason *reason)
{
    for (*reason = snow_crystal_stops(grid, stop); *reason == SNOW_STOP_NONE;) {
        int64_t before = grid->census.steps;
        snow_status status = advance(grid, next_look(grid, stop), stop);
        if (status != SNOW_OK) {
            *reason = SNOW_STOP_UNSTABLE;
            return status;
        }
        *reason = snow_crystal_stops(grid, stop);
        /* A model can work without a step: then whoever waits is told more often. */
        bool due = grid->census.steps == before || grid->census.steps % stop->progress_steps == 0;
        if (due && is_cancelled(grid, stop, started, floating) && *reason == SNOW_STOP_NONE)
            *reason = SNOW_STOP_CANCELLED;
        if (*reason == SNOW_STOP_NONE && stop->seconds > 0 && now() - started >= stop->seconds)
            *reason = SNOW_STOP_TIME;
    }
    return SNOW_OK;
}

static SNOW_APART snow_status check_stop(const snow_stop *stop)
{
    if (!isfinite(stop->tip_radius) || !isfinite(stop->seconds))
        return SNOW_ERROR_NOT_FINITE;
    if (stop->max_steps < -1 || !snow_is_flag(stop->rim) || !snow_is_flag(stop->still) || stop->tip_radius < 0 ||
        stop->seconds < 0 || stop->progress_steps < 1 || stop->height < 0)
        return SNOW_ERROR_RANGE;
    return SNOW_OK;
}

snow_status snow_stop_read(const snow_stop *caller, snow_stop *stop)
{
    *stop = stop_defaults;
    if (caller == NULL)
        return SNOW_OK;
    snow_status status = snow_struct_take(stop, sizeof *stop, caller);
    if (status != SNOW_OK)
        return status;
    snow_floating floating;
    snow_floating_enter(&floating);
    status = check_stop(stop);
    snow_floating_leave(&floating);
    return status;
}

snow_status snow_run(snow_grid *grid, const snow_stop *caller_stop, snow_summary *caller_summary)
{
    if (grid == NULL)
        return SNOW_ERROR_NULL;
    if (grid->busy)
        return SNOW_ERROR_BUSY;
    snow_stop stop;
    snow_status status = snow_stop_read(caller_stop, &stop);
    if (status == SNOW_OK && caller_summary != NULL)
        status = snow_struct_check(caller_summary, sizeof(snow_summary), sizeof(snow_summary));
    if (status != SNOW_OK)
        return status;

    snow_floating floating;
    snow_floating_enter(&floating);
    double started = now();
    snow_stop_reason reason;
    status = run(grid, &stop, started, &floating, &reason);
    snow_summary summary = summarise(grid, reason, started);
    snow_floating_leave(&floating);
    if (caller_summary != NULL && (status == SNOW_OK || status == SNOW_ERROR_UNSTABLE))
        snow_struct_write(caller_summary, &summary, sizeof summary);
    return status;
}
