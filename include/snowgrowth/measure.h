/**
 * @file measure.h
 * @brief How a crystal fills the plane: mass and radius, boxes, density, the
 * fractal dimension.
 */
#ifndef SNOWGROWTH_MEASURE_H
#define SNOWGROWTH_MEASURE_H

#include <snowgrowth/export.h>
#include <snowgrowth/grid.h>
#include <snowgrowth/status.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @brief The mass M(l) within radius l, for many radii: how many frozen cells
 * lie at a Euclidean distance of at most l from the origin.
 * @param grid the grid.
 * @param radii l, in lattice spacings, not negative, ascending.
 * @param count how many.
 * @param masses receives M(l) for each.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_NOT_FINITE;
 *         ::SNOW_ERROR_RANGE for radii that are negative or do not ascend;
 *         ::SNOW_ERROR_TOO_LARGE where snow_frozen_bounds() says so; what
 *         snow_cell_value() says of ::SNOW_FIELD_FROZEN. Cost: one read for each
 *         cell of snow_frozen_bounds().
 */
SNOW_API snow_status snow_mass_radius(const snow_grid *grid, const double *radii, size_t count, uint64_t *masses);

/**
 * @brief The dimension D of M(l) ~ l^D.
 *
 * It is the slope of the line of least squares through (log l, log M(l)) at
 * l = R/2, R/2^(3/2), R/4, …, down to 4, where R is the tip radius: the outermost
 * part, which still grows, is left out. D says most for a crystal that grew
 * from the origin.
 *
 * @param grid the grid.
 * @param dimension receives D: 2 for a plate, 1 for a needle.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_RANGE when the tip radius
 *         is less than 32 or the origin is not frozen;
 *         ::SNOW_ERROR_TOO_LARGE where snow_frozen_bounds() says so; what
 *         snow_cell_value() says of ::SNOW_FIELD_FROZEN. Cost: that
 *         of snow_mass_radius().
 */
SNOW_API snow_status snow_dimension(const snow_grid *grid, double *dimension);

/**
 * @brief How many boxes of a size hold a frozen cell: for the dimension by
 * box counting, N(side) ~ side^−D.
 *
 * The boxes are rhombi of side × side cells that tile the plane; one of them
 * has its first cell at the origin.
 *
 * @param grid the grid.
 * @param side their sides, in cells, at least 1.
 * @param boxes receives the number.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_RANGE for a side below 1;
 *         ::SNOW_ERROR_TOO_LARGE where snow_frozen_bounds() says so; what
 *         snow_cell_value() says of ::SNOW_FIELD_FROZEN. Cost: at
 *         most one read for each cell of snow_frozen_bounds().
 */
SNOW_API snow_status snow_box_count(const snow_grid *grid, int32_t side, uint64_t *boxes);

/**
 * @brief Which part of the smallest hexagon that holds the crystal is frozen.
 * @param grid the grid.
 * @param density receives frozen cells by cells, 1 for a full hexagon; 0 when
 *        nothing is frozen.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_UNSUPPORTED where there
 *         are no cells to count: in space and off the lattice. Cost: as
 *         snow_tip_radius().
 */
SNOW_API snow_status snow_density(const snow_grid *grid, double *density);

#ifdef __cplusplus
}
#endif

#endif
