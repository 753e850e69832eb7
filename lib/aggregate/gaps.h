/* When few clusters are left in a plane box: for each two of them, by which
   displacements near their own they would touch. A step is then a bit to look
   at for each other cluster, whatever their masses, and the box's bits rest. */
#ifndef SNOW_AGGREGATE_GAPS_H
#define SNOW_AGGREGATE_GAPS_H

#include "aggregate/clusters.h"

/* Whether there are few, in a box that has room for the windows. */
bool snow_gaps_apply(const clusters *self);

/* Lists in `touched` the clusters that one touches when it takes a step; *count: how many. No two touch now. */
snow_status snow_gaps_find_touched(clusters *self, snow_heap *heap, uint32_t number, int direction, uint32_t *count);

void snow_gaps_end(clusters *self, snow_heap *heap);

#endif
