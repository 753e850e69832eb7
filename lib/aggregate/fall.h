/* Scenes whose walkers take three moves: electrolysis downwards, chimney upwards. */
#ifndef SNOW_AGGREGATE_FALL_H
#define SNOW_AGGREGATE_FALL_H

#include "aggregate/attraction.h"
#include "aggregate/leap.h"

typedef struct fall {
    snow_cells cells;
    attraction attraction;
    snow_leaps leaps;
    int32_t *canopy;    /* for each block of columns the highest row that feels the deposit */
    int32_t top;        /* of all blocks */
    int32_t rise;       /* −1: walkers fall, 1: they rise */
    int32_t launch_row;
    int32_t launch_first;
    int32_t launch_last;
    int32_t launch_free; /* sites where walkers can start */
} fall;

static inline fall *fall_of(const snow_grid *grid)
{
    return aggregate_of(grid)->state;
}

/* Makes the state; launch_first to launch_last are columns of the bath. */
snow_status snow_fall_create(snow_grid *grid, int32_t rise, double interaction, int32_t launch_first,
                             int32_t launch_last);

/* Marks a cell that is none of the particles but holds them. */
snow_status snow_fall_add_electrode(snow_grid *grid, snow_site site);

snow_status snow_fall_prepare(snow_grid *grid);
snow_status snow_fall_place(snow_grid *grid, snow_site site);
bool snow_fall_walk(const snow_grid *grid, snow_stream *stream, snow_site *end);
bool snow_fall_filled(const snow_grid *grid, snow_site site);
void snow_fall_destroy(snow_grid *grid);

#endif
