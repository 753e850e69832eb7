/* What draw.c needs of a caller's view, and of the plane that it frames. */
#ifndef SNOW_RENDER_VIEW_H
#define SNOW_RENDER_VIEW_H

#include <snowgrowth/render.h>

/* Distance of two rows of the lattice: half the root of 3. */
#define SNOW_ROW_DISTANCE 0.86602540378443864676

/* UNSUPPORTED for a grid whose cells are no hexagons. */
snow_status snow_view_check_lattice(const snow_grid *grid);

/* Copies a caller's view, defaults in place of what an older caller lacks, and checks every member. */
snow_status snow_view_read(const snow_view *caller, snow_view *view);

#endif
