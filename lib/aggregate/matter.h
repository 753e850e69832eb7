/* What the maps of plane and space share. */
#ifndef SNOW_AGGREGATE_MATTER_H
#define SNOW_AGGREGATE_MATTER_H

/* What is on a site, as bits. */
enum { SNOW_MATTER_FILLED = 1, SNOW_MATTER_OBSTACLE = 2 };

/* The answer of a map where it ends: no class. */
enum { SNOW_MAP_BEYOND = 255 };

#endif
