/**
 * @file sweep.h
 * @brief Many grids at once: one thread each, results as they finish.
 *
 * For tables of parameters, where a thread for each grid beats several threads
 * in one. Works with every model, for the caller makes the grids.
 */
#ifndef SNOWGROWTH_SWEEP_H
#define SNOWGROWTH_SWEEP_H

#include <snowgrowth/export.h>
#include <snowgrowth/grid.h>
#include <snowgrowth/options.h>
#include <snowgrowth/status.h>

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @brief Makes one grid of a sweep. Called on any of its threads, several at once.
 * @param context the caller's own pointer.
 * @param index which grid, from 0.
 * @param options to be handed to the grid's create call.
 * @param stop when the grid's run ends: that of the sweep, and may be changed
 *        for this grid.
 * @param grid receives the grid; the sweep destroys it.
 * @return the create call's status.
 */
typedef snow_status (*snow_sweep_create)(void *context, size_t index, const snow_options *options, snow_stop *stop,
                                         snow_grid **grid);

/**
 * @brief Takes one result, as soon as its run has ended. Called on the thread
 * that ran it, several at once.
 * @param context the caller's own pointer.
 * @param index which grid.
 * @param status what the create call or snow_run() returned.
 * @param grid the grid, to be asked and drawn; NULL when it could not be made.
 * @param summary how its run went.
 * @return 0 to go on, anything else to cancel the sweep.
 */
typedef int (*snow_sweep_result)(void *context, size_t index, snow_status status, snow_grid *grid,
                                 const snow_summary *summary);

/**
 * @brief Creates, runs and delivers grids until all are done or the sweep is cancelled.
 *
 * options->threads grids run at a time, each on one thread; the bits of a
 * result do not depend on it. When a result or a progress callback cancels, no further grid is started, and those that run are delivered as
 * they stand, with ::SNOW_STOP_CANCELLED, at their next progress step. The
 * callbacks and the caller's allocator are called from several threads.
 *
 * @param count how many grids, at most 2^20 − 1.
 * @param create makes a grid.
 * @param result takes a result.
 * @param context handed to both.
 * @param stop when each run ends; NULL: the defaults of snow_stop_init().
 * @param options how many threads, and what the grids get; NULL: the defaults.
 * @return ::SNOW_OK, also when it was cancelled or single grids failed;
 *         ::SNOW_ERROR_NULL; ::SNOW_ERROR_RANGE for too great a count; what
 *         snow_run() returns for the stop conditions and a create call for the
 *         options: nothing was started then.
 */
SNOW_API snow_status snow_sweep(size_t count, snow_sweep_create create, snow_sweep_result result, void *context,
                                const snow_stop *stop, const snow_options *options);

#ifdef __cplusplus
}
#endif

#endif
