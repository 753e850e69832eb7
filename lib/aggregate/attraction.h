/* Who feels the deposit: sites within a distance of it, marked as it grows.
   A new particle next to an older one adds only the rim of its disc to what is
   marked, so the cost grows with the distance, not with its square. */
#ifndef SNOW_AGGREGATE_ATTRACTION_H
#define SNOW_AGGREGATE_ATTRACTION_H

#include "aggregate/cells.h"
#include "aggregate/model.h"

typedef struct attraction {
    snow_site *offset;  /* of a disc, by distance */
    size_t offsets;
    uint32_t *start;    /* start[d]: the first offset at distance d or more */
    snow_site *rim[8];  /* the disc less the disc round the particle that lies against this direction */
    size_t rims[8];
    double distance;
    int32_t reach; /* the distance, rounded down */
    int32_t width; /* columns */
    bool periodic;
} attraction;

snow_status snow_attraction_start(attraction *self, snow_heap *heap, double distance, int32_t width, bool periodic);
void snow_attraction_end(attraction *self, snow_heap *heap);

/* Marks what feels a particle or electrode, the cells of which are marked already. */
void snow_attraction_mark(const attraction *self, snow_cells *cells, snow_site site);

/* Where a walker ends that feels the deposit, the nearest cell of which is no nearer than `bound`: next to
   that cell, on the walker's side. Of cells that are equally near one is drawn. */
snow_site snow_attraction_end_of(const attraction *self, const snow_cells *cells, snow_stream *stream, snow_site site,
                                 double bound);

/* A site with its column within the width; false when there is none. */
static inline bool snow_attraction_wrap(const attraction *self, snow_site *site)
{
    if (self->periodic)
        site->x = (site->x % self->width + self->width) % self->width;
    return site->x >= 0 && site->x < self->width;
}

#endif
