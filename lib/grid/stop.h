/* The caller's stop conditions, checked. */
#ifndef SNOW_GRID_STOP_H
#define SNOW_GRID_STOP_H

#include <snowgrowth/grid.h>

/* The defaults where the caller is NULL. */
snow_status snow_stop_read(const snow_stop *caller, snow_stop *stop);

#endif
