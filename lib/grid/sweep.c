#include "base/heap.h"
#include "base/options.h"
#include "base/parallel.h"
#include "grid/stop.h"

#include <snowgrowth/sweep.h>

#include <stdatomic.h>

typedef struct sweep {
    snow_sweep_create create;
    snow_sweep_result result;
    void *context;
    const snow_stop *stop; /* the caller's conditions */
    snow_options options;  /* of each grid */
    atomic_bool cancelled;
} sweep;

/* One run, with the caller's own progress callback. */
typedef struct watched_run {
    sweep *all;
    snow_progress progress;
    void *progress_context;
} watched_run;

/* Stands in for the caller's progress callback, so that a cancelled sweep ends soon. */
static int watch(void *context, const snow_grid *grid, const snow_summary *summary)
{
    const watched_run *run = context;
    if (run->progress != NULL && run->progress(run->progress_context, grid, summary) != 0)
        atomic_store(&run->all->cancelled, true);
    return atomic_load(&run->all->cancelled);
}

static snow_status run_watched(sweep *all, snow_grid *grid, snow_stop stop, snow_summary *summary)
{
    watched_run run = {all, stop.progress, stop.progress_context};
    stop.progress = watch;
    stop.progress_context = &run;
    return snow_run(grid, &stop, summary);
}

static void run_one(void *argument, size_t index)
{
    sweep *all = argument;
    if (atomic_load(&all->cancelled))
        return;
    snow_summary summary;
    snow_summary_init(&summary, sizeof summary);
    snow_stop stop = *all->stop;
    snow_grid *grid = NULL;
    snow_status status = all->create(all->context, index, &all->options, &stop, &grid);
    if (status == SNOW_OK)
        status = run_watched(all, grid, stop, &summary);
    if (all->result(all->context, index, status, grid, &summary) != 0)
        atomic_store(&all->cancelled, true);
    snow_destroy(grid);
}

static snow_status run_all(sweep *all, size_t count, const snow_options *settled)
{
    if (settled->parallel_for != NULL && count > 0) {
        settled->parallel_for(settled->parallel_context, count, run_one, all);
        return SNOW_OK;
    }
    snow_heap heap;
    snow_heap_start(&heap, settled);
    snow_team *team = NULL;
    snow_status status = snow_team_start(&team, &heap, settled->threads);
    if (status != SNOW_OK)
        return status;
    snow_team_for(team, count, run_one, all);
    snow_team_end(team, &heap);
    return SNOW_OK;
}

snow_status snow_sweep(size_t count, snow_sweep_create create, snow_sweep_result result, void *context,
                       const snow_stop *caller_stop, const snow_options *caller_options)
{
    if (create == NULL || result == NULL)
        return SNOW_ERROR_NULL;
    if (count > SNOW_TEAM_MOST_TASKS)
        return SNOW_ERROR_RANGE;
    snow_stop stop;
    snow_options settled;
    snow_status status = snow_stop_read(caller_stop, &stop);
    if (status == SNOW_OK)
        status = snow_options_settle(caller_options, &settled);
    if (status != SNOW_OK)
        return status;
    sweep all = {.create = create, .result = result, .context = context, .stop = &stop, .options = settled};
    all.options.threads = 1;
    all.options.parallel_for = NULL;
    all.options.parallel_context = NULL;
    atomic_init(&all.cancelled, false);
    return run_all(&all, count, &settled);
}
