/**
 * @file reiter.h
 * @brief Reiter's two-parameter model of snow crystal growth.
 *
 * C. A. Reiter, "A local cellular model for snow crystal growth", Chaos,
 * Solitons & Fractals 23 (2005) 1111–1119. Each cell holds a real u; it is ice
 * where u >= 1, and receptive where it or one of its six neighbours is ice.
 * With v = 0 on receptive cells and v = u elsewhere, one step is
 *
 *     u′(P) = [P receptive]·(u(P) + γ) + v(P) + (α/12)·(Σ v(N) − 6·v(P)),
 *
 * the sum taken over the six neighbours N of P (paper, section 2 and, for α,
 * section 3). Cells outside the interior hold u = β for ever.
 *
 * Decisions of this library, argued in doc/reiter.md: a cell is ice where
 * u >= 1 − 2^−40 (in single precision 1 − 2 quanta of the vapour); vapour is kept in whole multiples of a power of two, so that
 * sums are exact and no result depends on the order of additions.
 */
#ifndef SNOWGROWTH_REITER_H
#define SNOWGROWTH_REITER_H

#include <snowgrowth/export.h>
#include <snowgrowth/grid.h>
#include <snowgrowth/options.h>
#include <snowgrowth/status.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @brief How far below 1 a value may be and still be ice: 2^−40.
 *
 * Parameters are decimal numbers: 0.95 + 0.05 = 1 and ten times 0.1 = 1 must
 * freeze in every precision.
 */
#define SNOW_REITER_SLACK (1.0 / 1099511627776.0)

/**
 * @brief The greatest diffusion at which the free field is stable: 8/3.
 *
 * A Fourier mode is multiplied by 1 − (α/12)(6 − Σ cos) in each step, and the
 * sum of the six cosines runs from −3 to 6.
 */
#define SNOW_REITER_STABLE_DIFFUSION (8.0 / 3.0)

/** @brief Shapes of the interior. */
typedef enum snow_reiter_domain {
    SNOW_REITER_DISC = 1,     /**< Cells with q² + q·r + r² < radius², the paper's. */
    SNOW_REITER_HEXAGON = 2,  /**< Cells with max(|q|, |r|, |q + r|) < radius. */
    SNOW_REITER_RECTANGLE = 3 /**< width × height cells, odd rows half a cell to the right; the origin is column width/2 of row height/2. */
} snow_reiter_domain;

/** @brief When ice counts as within reach of the rim. */
typedef enum snow_reiter_rim {
    SNOW_REITER_RIM_NEAR = 1, /**< Less than two cells are left: at distance >= radius − 2 (disc: Euclidean; hexagon: in hexagonal steps), or in the outer two rows or columns of a rectangle. */
    SNOW_REITER_RIM_ROW = 2   /**< Rectangle only: ice in row ⌊height/35⌋, counted from 1, or above it: the rule of Połuszejko and Grabiński's program. */
} snow_reiter_rim;

/** @brief What computes the steps. */
typedef enum snow_reiter_engine {
    SNOW_REITER_ENGINE_AUTO = 0,      /**< The fastest that the scene allows. */
    SNOW_REITER_ENGINE_ROWS = 1,      /**< Vectorised rows of the part of the plane that decides the rest; what does not change is not computed. */
    SNOW_REITER_ENGINE_REFERENCE = 2, /**< A plain reading of the paper; slow; the same bits as the fast engines. */
    SNOW_REITER_ENGINE_QUAD = 3       /**< The plain reading in double-double arithmetic (about 31 digits), very slow: the truth that errors are measured against. */
} snow_reiter_engine;

/** @brief Whether a scene is computed by its symmetry. */
typedef enum snow_reiter_symmetry {
    SNOW_REITER_SYMMETRY_AUTO = 0, /**< The largest group that domain, seeds and noise share: one fundamental part is computed, queries see the whole. */
    SNOW_REITER_SYMMETRY_NONE = 1  /**< Every cell is computed. The bits are the same. */
} snow_reiter_symmetry;

/**
 * @brief How finely vapour is kept.
 *
 * B is the smallest power of two that no vapour of the scene passes: 1/2 for
 * β = 0.4. What receptive cells collect is kept in double precision in any case.
 */
typedef enum snow_reiter_precision {
    SNOW_REITER_PRECISION_DOUBLE = 0, /**< In multiples of 2^−50·B, 8 bytes: ice as in exact arithmetic in every scene tried. */
    SNOW_REITER_PRECISION_SINGLE = 1  /**< In multiples of 2^−28·B, 4 bytes: about twice as fast; ice from two multiples below 1 on; close calls may fall otherwise (doc/accuracy.md). */
} snow_reiter_precision;

/**
 * @brief A number for each cell, asked for once when the grid is created.
 * @param context the caller's own pointer.
 * @param q,r the cell: of the interior, or next to it.
 * @return The number.
 */
typedef double (*snow_reiter_field)(void *context, int32_t q, int32_t r);

/**
 * @brief A scene of Reiter's model.
 *
 * Write the defaults with snow_reiter_params_init(), then change what you need.
 */
typedef struct snow_reiter_params {
    size_t struct_size; /**< Set by snow_reiter_params_init(). */

    double background; /**< β, the value of every cell at the start, 0 <= β < 1 − 2^−40; 0.4 by default. */
    double addition;   /**< γ, what a receptive cell gains in a step, 0 <= γ <= 1; 0.001 by default. */
    double diffusion;  /**< α, 0 <= α <= 8/3; 1 by default. */

    snow_reiter_domain domain; /**< Shape of the interior; a disc by default. */
    int32_t radius;            /**< Of a disc or hexagon, 1 to 2^20; 200 by default. */
    int32_t width;             /**< Of a rectangle, 1 to 2^21; 600 by default. */
    int32_t height;            /**< Of a rectangle, 1 to 2^21; 600 by default. */
    snow_reiter_rim rim;       /**< Rim rule; SNOW_REITER_RIM_NEAR by default. */

    const snow_cell *seeds; /**< Cells that are ice (u = 1) at the start, copied; NULL (default): the origin. */
    size_t seed_count;      /**< How many seeds; with a list of 0 cells nothing is ice at the start. */
    int32_t cluster;        /**< q > 0: a random cluster on a q × q patch of rows round the origin in place of seeds, each cell ice with probability 1/2, an empty patch drawn again (paper, fig. 6); 0 by default. */
    int32_t noise_symmetric; /**< 1: the noise has the symmetry of the hexagon; 0 by default. */
    double noise;            /**< Amplitude: each cell starts at β + noise·x, x uniform in [−1, 1), and β ± noise must both be a background; 0 by default. */
    uint64_t random_seed;    /**< Chooses the random cluster and the noise; 0 by default. */

    snow_reiter_field background_at; /**< β of each cell in place of background, the fixed cells included; NULL by default. */
    snow_reiter_field addition_at;   /**< γ of each cell in place of addition; NULL by default. */
    void *field_context;             /**< Handed to both. */

    int32_t record_freeze_steps; /**< 1: keep the step in which each cell froze, 4 bytes a cell; 0 by default. */
    int32_t allow_unstable;      /**< 1: diffusion up to 4 is allowed; 0 by default. */
    snow_reiter_engine engine;   /**< SNOW_REITER_ENGINE_AUTO by default. */
    snow_reiter_symmetry symmetry; /**< SNOW_REITER_SYMMETRY_AUTO by default. */
    snow_reiter_precision precision; /**< SNOW_REITER_PRECISION_DOUBLE by default; SINGLE not with the engine QUAD. */

    /**
     * τ, 0 <= τ <= 1; 0 by default: every change is computed. Above 0, pieces of
     * the plane (8 × 4 cells) in which, and around which, no cell changes by
     * more than τ in a step stand still until the next look at all of the plane;
     * one step in 64 is such a look. After t steps the vapour is wrong by at most
     * t·(1 + 32·α)·τ as long as the ice is the same, for α <= 2; what is measured is far
     * less (doc/accuracy.md). Bits then depend on `symmetry`, but still on no
     * instruction set or thread count; and a grid that is loaded looks at all of
     * the plane anew, so that its bits part from those of the one that was saved,
     * within the same bound. Only with the engine ROWS or AUTO.
     */
    double tolerance;
} snow_reiter_params;

/**
 * @brief Writes the default scene: one seed in a disc of radius 200, β = 0.4, γ = 0.001, α = 1.
 * @param params where to; nothing happens when it is NULL.
 * @param struct_size sizeof(snow_reiter_params) as the caller was compiled.
 */
SNOW_API void snow_reiter_params_init(snow_reiter_params *params, size_t struct_size);

/**
 * @brief Sets the scene of a figure of the sources.
 * @param params an initialised scene; β, γ, α, domain, sizes, rim rule and
 *        cluster are set, the rest is kept.
 * @param name a name that snow_reiter_preset_name() gives.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL, ::SNOW_ERROR_STRUCT_SIZE;
 *         ::SNOW_ERROR_REITER_PRESET when there is no such preset.
 */
SNOW_API snow_status snow_reiter_params_preset(snow_reiter_params *params, const char *name);

/**
 * @brief The names of the presets, one by one ("thin-dendrite").
 * @param index from 0 on.
 * @return A constant string that the library owns; NULL after the last.
 */
SNOW_API const char *snow_reiter_preset_name(size_t index);

/**
 * @brief Where the presets come from ("Reiter 2005, fig. 4: thin dendrite").
 * @param index from 0 on.
 * @return A constant string that the library owns; NULL after the last.
 */
SNOW_API const char *snow_reiter_preset_source(size_t index);

/**
 * @brief Makes a grid of Reiter's model.
 *
 * Fields that can be read: all. Fields that can be set: ::SNOW_FIELD_VALUE
 * (0 <= u; u >= 1 − 2^−40 makes ice, also of cells that were not, and less melts
 * it; freeze steps are then those of the call), ::SNOW_FIELD_VAPOUR
 * (0 <= v < 1 − 2^−40, of the cells that are not receptive; others are passed
 * over; above α = 2, where the field itself passes below 0, from −1 on),
 * ::SNOW_FIELD_ADDITION (of the interior) and ::SNOW_FIELD_BACKGROUND (of the
 * fixed cells next to the interior; others are passed over). A set vapour is
 * rounded to the grid's quantum (doc/reiter.md).
 *
 * Setting a field of a scene that is computed by its symmetry unfolds it for good.
 *
 * Memory: about 41 bytes for each cell that is computed, 45 with freeze steps;
 * a scene with all twelve symmetries computes one cell in twelve. Stepping asks
 * for none.
 *
 * @param params the scene.
 * @param options memory, threads, instruction set; NULL: the defaults.
 * @param grid receives the grid; the caller destroys it.
 * @return ::SNOW_OK; ::SNOW_ERROR_NULL; ::SNOW_ERROR_STRUCT_SIZE,
 *         ::SNOW_ERROR_STRUCT_TAIL; ::SNOW_ERROR_ENUM; ::SNOW_ERROR_RANGE for
 *         a flag that is neither 0 nor 1, a thread count out of range, or one
 *         of allocate and release without the other; ::SNOW_ERROR_NOT_FINITE;
 *         ::SNOW_ERROR_REITER_BACKGROUND to ::SNOW_ERROR_REITER_RIM,
 *         ::SNOW_ERROR_REITER_PRECISION and ::SNOW_ERROR_REITER_TOLERANCE for the
 *         scene; ::SNOW_ERROR_NO_MEMORY, ::SNOW_ERROR_TOO_LARGE,
 *         ::SNOW_ERROR_MEMORY_LIMIT, ::SNOW_ERROR_THREADS, ::SNOW_ERROR_ISA.
 */
SNOW_API snow_status snow_reiter_create(const snow_reiter_params *params, const snow_options *options,
                                        snow_grid **grid);

/** @brief The conditions that a crystal grows in, which may change as it grows (paper, section 4 and fig. 7). */
typedef struct snow_reiter_conditions {
    size_t struct_size; /**< Set by snow_reiter_conditions_init(). */
    double background;  /**< β. */
    double addition;    /**< γ. */
    double diffusion;   /**< α. */
    int32_t rescale;    /**< 1 (default): a new β multiplies all vapour, the fixed cells included, by β_new/β_old; 0: it sets the fixed cells and leaves the vapour. */
} snow_reiter_conditions;

/**
 * @brief Prepares conditions: those of snow_reiter_params_init(), with rescale.
 * @param conditions where to; nothing happens when it is NULL.
 * @param struct_size sizeof(snow_reiter_conditions) as the caller was compiled.
 */
SNOW_API void snow_reiter_conditions_init(snow_reiter_conditions *conditions, size_t struct_size);

/**
 * @brief Reads the conditions that a grid grows in.
 * @param grid a grid of Reiter's model.
 * @param conditions initialised; β, γ and α are filled in, rescale is kept.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL, ::SNOW_ERROR_STRUCT_SIZE,
 *         ::SNOW_ERROR_STRUCT_TAIL; ::SNOW_ERROR_UNSUPPORTED for another model.
 */
SNOW_API snow_status snow_reiter_conditions_of(const snow_grid *grid, snow_reiter_conditions *conditions);

/**
 * @brief Changes the conditions between two steps.
 *
 * A new γ replaces the additions of all cells; where γ is not changed,
 * additions that differ from cell to cell stay. Ice and what receptive cells
 * have collected stay as they are.
 *
 * @param grid a grid of Reiter's model.
 * @param conditions the new conditions.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL, ::SNOW_ERROR_STRUCT_SIZE,
 *         ::SNOW_ERROR_STRUCT_TAIL, ::SNOW_ERROR_RANGE, ::SNOW_ERROR_BUSY;
 *         ::SNOW_ERROR_UNSUPPORTED for another model; ::SNOW_ERROR_NOT_FINITE;
 *         ::SNOW_ERROR_REITER_BACKGROUND, ::SNOW_ERROR_REITER_ADDITION,
 *         ::SNOW_ERROR_REITER_DIFFUSION; ::SNOW_ERROR_REITER_RESCALE when β
 *         was 0 and is to be another; ::SNOW_ERROR_REITER_VAPOUR when a
 *         rescaled vapour would reach 1. Cost: proportional to the domain.
 */
SNOW_API snow_status snow_reiter_change(snow_grid *grid, const snow_reiter_conditions *conditions);

#ifdef __cplusplus
}
#endif

#endif
