/* From sites to particles: a table of numbers whose keys are in the list of sites. */
#ifndef SNOW_AGGREGATE_ORDER_H
#define SNOW_AGGREGATE_ORDER_H

#include "aggregate/sites.h"

typedef struct snow_order {
    uint32_t *slot; /* 1 + a particle's number; 0: free */
    uint64_t slots; /* 0 or a power of two */
    uint64_t count;
} snow_order;

/* Makes room for so many more; on failure nothing has changed. */
snow_status snow_order_reserve(snow_order *order, snow_heap *heap, const snow_sites *sites, uint64_t more);

/* Adds a particle of the list; there must be room. A site that is there already keeps its older particle. */
void snow_order_add(snow_order *order, const snow_sites *sites, uint64_t number);

/* The number of the particle on a site; −1: none. */
int64_t snow_order_find(const snow_order *order, const snow_sites *sites, snow_site site);

void snow_order_end(snow_order *order, snow_heap *heap);

#endif
