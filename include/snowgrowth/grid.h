/**
 * @file grid.h
 * @brief The grid: one handle for every model, with the same verbs.
 *
 * A grid is made by its model's create call (snow_reiter_create()), stepped,
 * asked, saved, loaded and destroyed by the calls of this page.
 *
 * **Cells.** Models live on the hexagonal lattice (aggregation: see aggregate.h)
 * in axial coordinates
 * (q, r); the six neighbours of a cell are (±1, 0), (0, ±1), (1, −1), (−1, 1)
 * and its squared Euclidean distance from the origin, in lattice spacings, is
 * q² + q·r + r². Drawn with x to the right and y down, cell (q, r) stands at
 * x = q + r/2, y = r·√3/2.
 *
 * **Threads.** One thread at a time may use a grid; calls that take it as
 * const may run at the same time as each other. Grids share nothing. The
 * number of threads inside a grid and its instruction set change no bit of any
 * result.
 *
 * **Failure.** A call that fails leaves its out-pointers untouched and the grid
 * as it was, unless it says otherwise.
 */
#ifndef SNOWGROWTH_GRID_H
#define SNOWGROWTH_GRID_H

#include <snowgrowth/export.h>
#include <snowgrowth/options.h>
#include <snowgrowth/status.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @brief A crystal and the medium that it grows in. Opaque. */
typedef struct snow_grid snow_grid;

/** @brief The models that a grid can follow. */
typedef enum snow_model {
    SNOW_MODEL_REITER = 1,   /**< Reiter's two-parameter model of 2005; see reiter.h. */
    SNOW_MODEL_PACKARD = 2,  /**< Packard's Boolean rules, with zones; see packard.h. */
    SNOW_MODEL_AGGREGATE = 3 /**< Aggregation and erosion; see aggregate.h. */
} snow_model;

/** @brief A cell in axial coordinates. */
typedef struct snow_cell {
    int32_t q; /**< First axial coordinate. */
    int32_t r; /**< Second axial coordinate: the row. */
} snow_cell;

/**
 * @brief A parallelogram of cells: q <= x < q + width, r <= y < r + height.
 *
 * Arrays over a rectangle are in row order: the value of cell (q + i, r + j)
 * stands at index j * width + i.
 */
typedef struct snow_rect {
    int32_t q;      /**< First column. */
    int32_t r;      /**< First row. */
    int32_t width;  /**< Number of columns, 0 or more. */
    int32_t height; /**< Number of rows, 0 or more. */
} snow_rect;

/**
 * @brief A hexagon of cells with sides along the lattice's axes: those with
 * least_q <= q <= greatest_q, least_r <= r <= greatest_r and
 * least_s <= q + r <= greatest_s. It is empty where a least is greater.
 */
typedef struct snow_hexagon {
    int64_t least_q;    /**< Least q. */
    int64_t greatest_q; /**< Greatest q. */
    int64_t least_r;    /**< Least r. */
    int64_t greatest_r; /**< Greatest r. */
    int64_t least_s;    /**< Least q + r. */
    int64_t greatest_s; /**< Greatest q + r. */
} snow_hexagon;

/** @brief What can be read from cells, and in part be set. */
typedef enum snow_field {
    SNOW_FIELD_VALUE = 1,       /**< The cell's value: vapour below 1, ice from 1 on (Reiter's u). */
    SNOW_FIELD_VAPOUR = 2,      /**< The part of the value that is free to diffuse; 0 where receptive. */
    SNOW_FIELD_FROZEN = 3,      /**< 1 where the cell is ice, else 0. */
    SNOW_FIELD_RECEPTIVE = 4,   /**< 1 where the cell is ice or next to ice, else 0. */
    SNOW_FIELD_INSIDE = 5,      /**< 1 where the cell belongs to the domain's interior, else 0. */
    SNOW_FIELD_FREEZE_STEP = 6, /**< The step in which the cell froze, 0 for seeds, −1 where it has not. */
    SNOW_FIELD_ADDITION = 7,    /**< What the cell gains in each step while receptive (Reiter's γ). */
    SNOW_FIELD_BACKGROUND = 8   /**< The value that the fixed cells round the interior hold (Reiter's β); inside, the grid's own. */
} snow_field;

/** @brief Why a run ended. */
typedef enum snow_stop_reason {
    SNOW_STOP_NONE = 0,      /**< It has not ended: seen by progress callbacks. */
    SNOW_STOP_STEPS = 1,     /**< The step count reached max_steps. */
    SNOW_STOP_RIM = 2,       /**< Ice came within reach of the domain's rim, as the model defines it. */
    SNOW_STOP_RADIUS = 3,    /**< The tip radius reached tip_radius. */
    SNOW_STOP_FROZEN = 4,    /**< The number of frozen cells reached frozen. */
    SNOW_STOP_STILL = 5,     /**< No cell will freeze again, not in 2^40 steps. */
    SNOW_STOP_TIME = 6,      /**< The wall-clock budget was spent. */
    SNOW_STOP_CANCELLED = 7, /**< The progress callback asked for it. */
    SNOW_STOP_UNSTABLE = 8,  /**< The field grew without bound; the call returns ::SNOW_ERROR_UNSTABLE. */
    SNOW_STOP_FULL = 9,      /**< Nothing more can join: the domain is full. Always looked at. */
    SNOW_STOP_HEIGHT = 10    /**< The deposit reached the height. */
} snow_stop_reason;

/**
 * @brief The short name of a reason ("steps", "rim", "radius", "frozen", "still", "time", "cancelled", "unstable",
 *        "full", "height").
 * @param reason any value.
 * @return A constant string that the library owns; never NULL.
 */
SNOW_API const char *snow_stop_name(snow_stop_reason reason);

/** @brief How a run went, or how far it has come. */
typedef struct snow_summary {
    size_t struct_size;      /**< Set by snow_summary_init(). */
    snow_stop_reason reason; /**< Why the run ended. */
    int64_t steps;           /**< Steps since the grid was created. */
    uint64_t frozen;         /**< Frozen cells; 2^64 − 1 stands for more. */
    double tip_radius;       /**< Greatest distance of a frozen cell from the origin, in lattice spacings. */
    double seconds;          /**< Wall-clock time that this run has taken. */
} snow_summary;

/**
 * @brief Prepares a summary to be filled.
 * @param summary where to; nothing happens when it is NULL.
 * @param struct_size sizeof(snow_summary) as the caller was compiled.
 */
SNOW_API void snow_summary_init(snow_summary *summary, size_t struct_size);

/**
 * @brief Told about a run while it goes on.
 *
 * It may ask the grid anything and save it, but not change it: such a call
 * answers ::SNOW_ERROR_BUSY.
 *
 * @param context the caller's own pointer.
 * @param grid the grid, between two steps.
 * @param summary how far the run has come.
 * @return 0 to go on, anything else to end the run.
 */
typedef int (*snow_progress)(void *context, const snow_grid *grid, const snow_summary *summary);

/**
 * @brief When a run ends: at the first of the conditions that are set.
 *
 * All counts are those of the grid, not of the run: a run that was stopped and
 * is started again with the same conditions goes on to the same end. When
 * several hold after the same step, the reason is the first of: rim, radius,
 * height, frozen, still, full, steps, cancelled, time.
 */
typedef struct snow_stop {
    size_t struct_size;     /**< Set by snow_stop_init(). */
    int64_t max_steps;      /**< Ends when the grid's step count is at least this; 10,000 by default, −1: no limit. */
    int32_t rim;            /**< 1 (default): ends when ice is within reach of the rim. */
    int32_t still;          /**< 1 (default): ends when no cell will freeze again. */
    double tip_radius;      /**< Ends when the tip radius is at least this; 0: no limit. */
    uint64_t frozen;        /**< Ends when at least so many cells are frozen; 0: no limit. */
    double seconds;         /**< Ends after this much wall-clock time; 0: no limit. */
    snow_progress progress; /**< Told about the run, and can end it; may be NULL. */
    void *progress_context; /**< Handed to progress. */
    int64_t progress_steps; /**< Steps between two calls of progress, at least 1; 100 by default. Where work leads to no step (aggregate.h: walkers that are lost), progress is called between them, too. */
    int64_t height;         /**< Ends when a deposit is at least so many rows high; 0: no limit. For models with a floor. */
} snow_stop;

/**
 * @brief Writes the default stop conditions: rim, still, 10,000 steps.
 * @param stop where to; nothing happens when it is NULL.
 * @param struct_size sizeof(snow_stop) as the caller was compiled.
 */
SNOW_API void snow_stop_init(snow_stop *stop, size_t struct_size);

/**
 * @brief Takes exactly so many steps, whatever the crystal does.
 *
 * step(a) and then step(b) gives the same bits as step(a + b).
 *
 * @param grid the grid.
 * @param steps how many, 0 or more.
 * @return ::SNOW_OK; ::SNOW_ERROR_NULL; ::SNOW_ERROR_RANGE when steps is
 *         negative; ::SNOW_ERROR_BUSY from inside a progress callback;
 *         ::SNOW_ERROR_UNSTABLE when the field grows without bound, the grid
 *         then stands at its last sound step; ::SNOW_ERROR_STEP_LIMIT when the
 *         step count would pass 2^62; ::SNOW_ERROR_FULL when nothing more can
 *         join, the grid then stands at its last step.
 */
SNOW_API snow_status snow_step(snow_grid *grid, int64_t steps);

/**
 * @brief Steps until a condition holds.
 *
 * The conditions are looked at before the first step and after each step; time
 * and progress are looked at between steps only. "Still" is looked for in the
 * first step and in each 64th. A run that is cut into slices ends at the same
 * step with the same bits.
 *
 * @param grid the grid.
 * @param stop the conditions; NULL: the defaults of snow_stop_init().
 * @param summary filled when the call returns ::SNOW_OK or
 *        ::SNOW_ERROR_UNSTABLE; may be NULL.
 * @return as snow_step(); and ::SNOW_ERROR_STRUCT_SIZE or
 *         ::SNOW_ERROR_STRUCT_TAIL for a struct that was not initialised or is
 *         newer than the library; ::SNOW_ERROR_NOT_FINITE or
 *         ::SNOW_ERROR_RANGE for a condition that makes no sense.
 */
SNOW_API snow_status snow_run(snow_grid *grid, const snow_stop *stop, snow_summary *summary);

/**
 * @brief Gives back all that the grid holds.
 * @param grid the grid; nothing happens when it is NULL. Not from inside one of
 *        the grid's own callbacks.
 */
SNOW_API void snow_destroy(snow_grid *grid);

/**
 * @brief The model that the grid follows.
 * @param grid the grid.
 * @param model receives it.
 * @return ::SNOW_OK or ::SNOW_ERROR_NULL.
 */
SNOW_API snow_status snow_model_of(const snow_grid *grid, snow_model *model);

/**
 * @brief How many models this library has.
 * @return The number, at least 1.
 */
SNOW_API size_t snow_model_count(void);

/**
 * @brief The models that this library has, one by one.
 * @param index from 0 to snow_model_count() − 1.
 * @param model receives the model; may be NULL.
 * @return Its short name ("reiter"), a constant string that the library owns;
 *         NULL when the index is too great.
 */
SNOW_API const char *snow_model_name(size_t index, snow_model *model);

/**
 * @brief Steps taken since the grid was created.
 * @param grid the grid.
 * @param steps receives the number.
 * @return ::SNOW_OK or ::SNOW_ERROR_NULL. Cost: constant.
 */
SNOW_API snow_status snow_steps(const snow_grid *grid, int64_t *steps);

/**
 * @brief Number of frozen cells.
 * @param grid the grid.
 * @param cells receives the number.
 * @return ::SNOW_OK or ::SNOW_ERROR_NULL; ::SNOW_ERROR_TOO_LARGE for 2^64
 *         cells or more. Cost: constant.
 */
SNOW_API snow_status snow_frozen(const snow_grid *grid, uint64_t *cells);

/**
 * @brief Greatest Euclidean distance of a frozen cell from the origin.
 * @param grid the grid.
 * @param radius receives it, in lattice spacings; 0 when nothing is frozen.
 * @return ::SNOW_OK or ::SNOW_ERROR_NULL. Cost: constant; where frozen cells
 *         move (::SNOW_AGGREGATE_CLUSTER_CLUSTER) one pass over them.
 */
SNOW_API snow_status snow_tip_radius(const snow_grid *grid, double *radius);

/**
 * @brief The smallest rectangle that holds every frozen cell.
 * @param grid the grid.
 * @param bounds receives it; width and height are 0 when nothing is frozen.
 * @return ::SNOW_OK or ::SNOW_ERROR_NULL; ::SNOW_ERROR_TOO_LARGE when a cell
 *         lies 2^30 or more from an axis. Cost: as snow_tip_radius().
 */
SNOW_API snow_status snow_frozen_bounds(const snow_grid *grid, snow_rect *bounds);

/**
 * @brief The smallest hexagon that holds every frozen cell.
 * @param grid the grid.
 * @param hexagon receives it; empty when nothing is frozen.
 * @return ::SNOW_OK or ::SNOW_ERROR_NULL. Cost: as snow_tip_radius().
 */
SNOW_API snow_status snow_frozen_hexagon(const snow_grid *grid, snow_hexagon *hexagon);

/**
 * @brief The smallest rectangle that holds the interior of the domain.
 *
 * The interior of an unbounded plane is as much of it as matters: the smallest
 * hexagon that holds the frozen cells and their neighbours. It grows as the
 * crystal does.
 *
 * @param grid the grid.
 * @param bounds receives it.
 * @return ::SNOW_OK or ::SNOW_ERROR_NULL; ::SNOW_ERROR_TOO_LARGE when a cell
 *         lies 2^30 or more from an axis. Cost: constant.
 */
SNOW_API snow_status snow_domain_bounds(const snow_grid *grid, snow_rect *bounds);

/**
 * @brief Number of cells in the interior of the domain.
 * @param grid the grid.
 * @param cells receives the number.
 * @return as snow_domain_bounds().
 */
SNOW_API snow_status snow_domain_cells(const snow_grid *grid, uint64_t *cells);

/**
 * @brief Reads one cell.
 *
 * A cell outside the interior reads as the fixed medium: its value and vapour
 * are its background, it is neither frozen nor receptive, its freeze step is
 * −1, its addition 0.
 *
 * @param grid the grid.
 * @param field what to read.
 * @param q,r the cell; any integers.
 * @param value receives what the field says.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL, ::SNOW_ERROR_ENUM;
 *         ::SNOW_ERROR_UNSUPPORTED when the model has no such field;
 *         ::SNOW_ERROR_NOT_RECORDED for freeze steps that were not asked for.
 *         Cost: constant.
 */
SNOW_API snow_status snow_cell_value(const snow_grid *grid, snow_field field, int32_t q, int32_t r, double *value);

/**
 * @brief Copies a field over a rectangle into the caller's array.
 *
 * Cells outside the interior read as in snow_cell_value(). To learn the size
 * first, pass NULL for values.
 *
 * @param grid the grid.
 * @param field what to read.
 * @param rect which cells; NULL: snow_domain_bounds().
 * @param values receives width * height numbers in row order; NULL: only the
 *        count is wanted.
 * @param capacity how many numbers the array holds.
 * @param count receives width * height, also when the array is too small; may
 *        be NULL unless values is.
 * @return as snow_cell_value(); ::SNOW_ERROR_RECTANGLE when the rectangle has
 *         a negative extent or leaves the range of int32_t;
 *         ::SNOW_ERROR_TOO_LARGE where snow_domain_bounds() says so, and for more
 *         numbers than an array can have on this machine;
 *         ::SNOW_ERROR_BUFFER when capacity is too small, nothing is copied.
 *         Cost: proportional to the rectangle.
 */
SNOW_API snow_status snow_field_copy(const snow_grid *grid, snow_field field, const snow_rect *rect, double *values,
                                     size_t capacity, size_t *count);

/**
 * @brief Sets a field over a rectangle from the caller's array.
 *
 * What can be set is told by the model: for Reiter's model
 * ::SNOW_FIELD_VALUE, ::SNOW_FIELD_VAPOUR, ::SNOW_FIELD_ADDITION and
 * ::SNOW_FIELD_BACKGROUND (see snow_reiter_create()). Either all cells are set
 * or, on failure, none.
 *
 * @param grid the grid.
 * @param field what to set.
 * @param rect which cells; NULL: snow_domain_bounds().
 * @param values width * height numbers in row order.
 * @param count how many numbers the array holds; must be width * height.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL, ::SNOW_ERROR_ENUM, ::SNOW_ERROR_BUSY,
 *         ::SNOW_ERROR_NO_MEMORY, ::SNOW_ERROR_MEMORY_LIMIT;
 *         ::SNOW_ERROR_UNSUPPORTED when the field cannot be set;
 *         ::SNOW_ERROR_RECTANGLE and ::SNOW_ERROR_TOO_LARGE as in
 *         snow_field_copy(); ::SNOW_ERROR_BUFFER when count is not the
 *         rectangle's; ::SNOW_ERROR_NOT_FINITE or the model's own status when
 *         a number is out of range.
 */
SNOW_API snow_status snow_field_set(snow_grid *grid, snow_field field, const snow_rect *rect, const double *values,
                                    size_t count);

/**
 * @brief The sums of the values of all cells of the interior.
 * @param grid the grid.
 * @param vapour receives the sum over the cells that are not frozen; may be NULL.
 * @param ice receives the sum over the frozen cells; may be NULL.
 * @return ::SNOW_OK; ::SNOW_ERROR_NULL when grid is, or both others are;
 *         what snow_cell_value() says of ::SNOW_FIELD_VALUE;
 *         ::SNOW_ERROR_TOO_LARGE where snow_domain_bounds() says so. Cost:
 *         proportional to the domain. The sums are compensated: their error is
 *         about one unit in the last place.
 */
SNOW_API snow_status snow_mass(const snow_grid *grid, double *vapour, double *ice);

/**
 * @brief How far the grid is from sixfold symmetry.
 * @param grid the grid.
 * @param defect receives the greatest difference between the value of a cell
 *        and that of any of its images under the twelve symmetries of the
 *        hexagon about the origin, over the images that lie in the interior;
 *        exactly 0 for a symmetric crystal.
 * @return ::SNOW_OK or ::SNOW_ERROR_NULL; ::SNOW_ERROR_TOO_LARGE where
 *         snow_domain_bounds() says so; ::SNOW_ERROR_UNSUPPORTED where cells are
 *         no hexagons; what snow_cell_value() says of ::SNOW_FIELD_VALUE. Cost:
 *         twelve reads a cell.
 */
SNOW_API snow_status snow_symmetry_defect(const snow_grid *grid, double *defect);

/**
 * @brief A fingerprint of the step count and of every cell of the interior.
 *
 * Two grids with the same digest hold the same bits, up to chance collisions
 * (2^−64). It does not depend on threads, instruction set or platform, nor on
 * the engine, save for those of another precision.
 *
 * @param grid the grid.
 * @param digest receives it.
 * @return ::SNOW_OK or ::SNOW_ERROR_NULL; ::SNOW_ERROR_TOO_LARGE where
 *         snow_domain_bounds() says so. Cost: one read a cell.
 */
SNOW_API snow_status snow_digest(const snow_grid *grid, uint64_t *digest);

/**
 * @brief How many bytes the grid holds from its allocator.
 * @param grid the grid.
 * @param bytes receives the number.
 * @return ::SNOW_OK or ::SNOW_ERROR_NULL. Cost: constant.
 */
SNOW_API snow_status snow_memory(const snow_grid *grid, uint64_t *bytes);

/**
 * @brief The instruction set that the grid's steps run on.
 * @param grid the grid.
 * @param isa receives it; never ::SNOW_ISA_AUTO.
 * @return ::SNOW_OK or ::SNOW_ERROR_NULL.
 */
SNOW_API snow_status snow_isa_of(const snow_grid *grid, snow_isa *isa);

/**
 * @brief Writes the whole grid into the caller's buffer.
 *
 * The format is versioned, little-endian and checksummed, the same on every
 * platform. A grid that is saved, loaded and continued gives the same bits as
 * one that is continued. To learn the size first, pass NULL for buffer.
 *
 * @param grid the grid.
 * @param buffer where to; NULL: only the size is wanted.
 * @param capacity bytes that the buffer holds.
 * @param size receives the size in bytes, also when the buffer is too small.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_BUFFER, nothing is written.
 */
SNOW_API snow_status snow_save(const snow_grid *grid, void *buffer, size_t capacity, size_t *size);

/**
 * @brief Takes bytes of a grid that is being saved.
 * @param context the caller's own pointer.
 * @param bytes the next bytes.
 * @param size how many, greater than zero.
 * @return 0 when all were taken, anything else on failure.
 */
typedef int (*snow_writer)(void *context, const void *bytes, size_t size);

/**
 * @brief Gives bytes of a grid that is being loaded.
 * @param context the caller's own pointer.
 * @param bytes where to put them.
 * @param size how many are wanted at most, greater than zero.
 * @param got receives how many were put; fewer than wanted is no failure, 0
 *        means the end.
 * @return 0, or anything else on failure.
 */
typedef int (*snow_reader)(void *context, void *bytes, size_t size, size_t *got);

/**
 * @brief Writes the whole grid through the caller's writer, a few kilobytes at a time.
 * @param grid the grid.
 * @param write the writer.
 * @param context handed to it.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_WRITE when the writer
 *         failed, it is not called again.
 */
SNOW_API snow_status snow_save_to(const snow_grid *grid, snow_writer write, void *context);

/**
 * @brief Makes a grid from what snow_save() wrote.
 *
 * Nothing in the data is trusted: damaged, truncated or hostile data give an
 * error, and never more memory is asked for than 64 MB and a hundred times the
 * size of the data, and, for a cluster of aggregation, a map of the air between
 * its particles; options->memory_limit draws the line where you want it. It
 * holds for the grid, and for a list of a cluster's sites that is kept while
 * they are read, each by itself: what was saved under a limit is loaded under it.
 *
 * @param buffer the data.
 * @param size bytes of data; bytes after the end of the grid are an error.
 * @param options allocator, threads and instruction set of the new grid; NULL:
 *        the defaults.
 * @param grid receives the grid; the caller destroys it.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_FORMAT,
 *         ::SNOW_ERROR_FORMAT_VERSION, ::SNOW_ERROR_TRUNCATED or
 *         ::SNOW_ERROR_DAMAGED for the data; what a create call can return for
 *         the options and for want of resources.
 */
SNOW_API snow_status snow_load(const void *buffer, size_t size, const snow_options *options, snow_grid **grid);

/**
 * @brief Makes a grid from what a reader gives.
 * @param read the reader; it is read until it says that the end is reached.
 * @param context handed to it.
 * @param options as in snow_load(); the memory limit holds for the data while
 *        they are read, and for the grid, each by itself.
 * @param grid receives the grid; the caller destroys it.
 * @return as snow_load(); and ::SNOW_ERROR_READ when the reader failed.
 */
SNOW_API snow_status snow_load_from(snow_reader read, void *context, const snow_options *options, snow_grid **grid);

#ifdef __cplusplus
}
#endif

#endif
