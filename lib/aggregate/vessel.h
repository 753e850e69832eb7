/* The vessel of the line scene: its walls and lid as mirrors of the lattice. */
#ifndef SNOW_AGGREGATE_VESSEL_H
#define SNOW_AGGREGATE_VESSEL_H

#include "aggregate/model.h"

/* Where a step that may lead through walls or lid ends; the floor is left to the caller. */
snow_site snow_vessel_keep(const snow_aggregate_params *params, snow_site site);

/* A site of the top row (layer). */
snow_site snow_vessel_launch(const snow_aggregate_params *params, snow_stream *stream);

bool snow_vessel_has(const snow_aggregate_params *params, snow_site site);

/* The same for a grid; where the scene has no vessel, every site is inside. */
bool snow_vessel_inside(const snow_grid *grid, snow_site site);

#endif
