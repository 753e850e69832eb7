/* The particles of a grid, out of the library, into pictures and files. */
#ifndef EXAMPLES_PARTICLES_H
#define EXAMPLES_PARTICLES_H

#include "common/output.h"

#include <snowgrowth/snowgrowth.h>

typedef struct particles {
    size_t count;
    snow_point *points; /* in the order in which they joined */
} particles;

/* Fetches them; complains and returns false when that fails. */
bool particles_fetch(particles *self, const snow_grid *grid);
void particles_destroy(particles *self);

/* Each draws or writes, commits the output and returns true; or complains, and nothing is left. */

/* A PNG picture: colour by age, columns and rows of a vessel to its brim; what has grown in space is seen along a diagonal. */
bool particles_draw(const particles *self, const snow_grid *grid, int32_t size, output *file);

/* A line a particle: its coordinates in joining order, whole numbers on a lattice. */
bool particles_list(const particles *self, const snow_grid *grid, output *file);

/* A point cloud with ages that ParaView and others open: Stanford PLY, binary, or legacy VTK. */
bool particles_write_ply(const particles *self, output *file);
bool particles_write_vtk(const particles *self, output *file);

#endif
