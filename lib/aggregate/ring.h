/* Leaps of the laboratory's walkers over regions where nothing is, inside the
   circle beyond which they are dropped. Where a leap leads is drawn from the
   exact law of where single steps would leave the region, so that the sheet's
   rules are kept to the letter. */
#ifndef SNOW_AGGREGATE_RING_H
#define SNOW_AGGREGATE_RING_H

#include "aggregate/cells.h"
#include "aggregate/model.h"

enum { SNOW_RING_LEVELS = 11 };

/* Sites at distance `radius` on one side of a region, as columns of an alias table. */
typedef struct snow_ring_exit {
    uint32_t threshold;
    int16_t along[2][2]; /* offsets on the side: below the threshold, and from it on */
} snow_ring_exit;

typedef struct snow_ring {
    snow_aggregate_lattice lattice;
    int levels; /* 1 ... levels − 1: regions of radius 2^level */
    double radius;
    snow_ring_exit *exit[SNOW_RING_LEVELS];
    uint32_t columns[SNOW_RING_LEVELS];
    snow_cells near[SNOW_RING_LEVELS]; /* cells of side 2^level: marked where one of those round it has matter */
} snow_ring;

/* Walkers are dropped beyond the radius. */
snow_status snow_ring_start(snow_ring *self, snow_heap *heap, snow_aggregate_lattice lattice, double radius);
void snow_ring_end(snow_ring *self, snow_heap *heap);

/* Room for matter from here to there; then it can be added. */
snow_status snow_ring_cover(snow_ring *self, snow_heap *heap, snow_site low, snow_site high);
void snow_ring_add(snow_ring *self, snow_site site);

/* Leaps where a region of radius 2 or more is empty; looks for it from the latest level on. False: it is not. */
bool snow_ring_leap(const snow_ring *self, snow_stream *stream, snow_site *site, int *level);

#endif
