/*
 * The plain program: Reiter's paper read straight into C, in doubles or in floats, with no thought for ties, symmetry
 * or the order of sums. It is no part of the library. It is what a good first program does, so it is what speeds are
 * quoted against and one of the settings that errors are measured for.
 */
#ifndef BENCH_PLAIN_H
#define BENCH_PLAIN_H

#include <snowgrowth/snowgrowth.h>

#include <stdbool.h>
#include <stdint.h>

typedef struct plain_crystal plain_crystal;

/* Whether the plain program can grow this scene: only with one addition for all cells. */
bool plain_supports(const snow_reiter_params *params);

/*
 * Starts from the cells of a grid that was made from the same params; in floats where single is true. NULL: no memory,
 * or the grid cannot be read.
 */
plain_crystal *plain_create(const snow_reiter_params *params, bool single, const snow_grid *start);
void plain_destroy(plain_crystal *crystal);

/* Steps until the step count is max_steps or, where rim is true, ice is within reach of the rim. */
void plain_run(plain_crystal *crystal, int64_t max_steps, bool rim);

int64_t plain_steps(const plain_crystal *crystal);
uint64_t plain_memory(const plain_crystal *crystal);
uint64_t plain_frozen(const plain_crystal *crystal);

/* Copies over snow_domain_bounds() of the start, in row order, as snow_field_copy() does. */
void plain_copy_frozen(const plain_crystal *crystal, double *frozen);
void plain_copy_vapour(const plain_crystal *crystal, double *vapour);

#endif
