/*
 * Making grids and asking them, where any failure fails the test.
 */
#ifndef TESTS_SUPPORT_GRIDS_H
#define TESTS_SUPPORT_GRIDS_H

#include "check.h"

#include <stdbool.h>

/* The six neighbours of a cell, anticlockwise. */
extern const snow_cell neighbours[6];

/* One seed in a disc. */
snow_reiter_params disc_scene(double background, double addition, double diffusion, int32_t radius);

/* The same in a hexagon and in a rectangle. */
snow_reiter_params hexagon_scene(double background, double addition, double diffusion, int32_t radius);
snow_reiter_params rectangle_scene(double background, double addition, double diffusion, int32_t width,
                                   int32_t height);

/* Takes the seed away. */
void without_seeds(snow_reiter_params *params);

snow_options default_options(void);
snow_stop default_stop(void);

/* Steps and no other condition. */
snow_stop stop_after(int64_t steps);

snow_grid *make_grid(const snow_reiter_params *params, const snow_options *options);

/* Runs under the conditions; the summary agrees with what the grid says. */
snow_summary run_grid(snow_grid *grid, const snow_stop *stop);

int64_t steps_of(const snow_grid *grid);
uint64_t frozen_of(const snow_grid *grid);
uint64_t cells_of(const snow_grid *grid);
uint64_t digest_of(const snow_grid *grid);
double tip_of(const snow_grid *grid);
double defect_of(const snow_grid *grid);
double value_at(const snow_grid *grid, snow_field field, int32_t q, int32_t r);
snow_rect bounds_of(const snow_grid *grid);

/* One ring of cells more on each side. */
snow_rect widened(snow_rect rect);

/* The field over the rectangle (NULL: the domain's bounds) in memory for free(). */
double *copy_field(const snow_grid *grid, snow_field field, const snow_rect *rect, size_t *count);

void set_cell(snow_grid *grid, snow_field field, int32_t q, int32_t r, double value);

/* One field, the cells around the interior included, has the same bits in both. */
void assert_same_field(const snow_grid *expected, const snow_grid *got, snow_field field);

/* Every field, the fixed cells included, has the same bits in both; freeze steps where both record them. */
void assert_same_grids(const snow_grid *expected, const snow_grid *got);

/* The same cells are ice in both. */
void assert_same_ice(const snow_grid *expected, const snow_grid *got);

/* Whether the grid keeps the step in which each cell froze. */
bool records_freeze_steps(const snow_grid *grid);

/* Which instruction sets can be forced here, SNOW_ISA_AUTO aside. */
size_t available_isas(snow_isa isas[8]);

/* The next number of a simple random stream, for choosing scenes: in [0, limit). */
uint32_t next_below(uint64_t *state, uint32_t limit);

#endif
