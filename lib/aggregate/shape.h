/* The form of a large cluster as words of bits in its own frame, made once and
   used for every step until the cluster grows. */
#ifndef SNOW_AGGREGATE_SHAPE_H
#define SNOW_AGGREGATE_SHAPE_H

#include "aggregate/box.h"

/* The sites that a step can change or come to touch: two more than the cluster on each side, at most the whole
   box. They are kept in strips of 60 sites along x, with two more on each side, so that a site's neighbours and
   theirs stand in its own word; with two more rows below and on top, and in space two more layers. */
typedef struct shape {
    snow_site extent;  /* of the sites in question; the first is the corner less 2 on each axis */
    int32_t strips;
    size_t layer;      /* words from a layer to the next; 0: there is one layer */
    uint64_t word[];
} shape;

/* Scratch. */
typedef struct shape_maker {
    torus own;        /* a set of sites of the box, empty between two uses */
    uint64_t *front;  /* a strip each: sites before the front in this layer, */
    uint64_t *beside; /* and in the two next to it */
    uint64_t *mask;   /* sites to look at, or to change */
} shape_maker;

snow_status snow_shape_maker_start(shape_maker *self, snow_heap *heap, const torus *box);
void snow_shape_maker_end(shape_maker *self, snow_heap *heap);

/* The shape of sites that are given from the cluster's corner, within the box; extent: of the cluster. */
snow_status snow_shape_make(shape_maker *self, snow_heap *heap, const torus *box, const snow_site *sites,
                            uint32_t count, snow_site extent, shape **made);

/* Calls for each site that the front of a step would come to touch or run into, where something is. */
typedef void (*snow_shape_touch)(void *context, snow_site site);
void snow_shape_find_touched(const shape *self, const shape_maker *maker, const torus *box, snow_site corner,
                             int direction, snow_shape_touch touch, void *context);

/* Takes the step in the box's bits. */
void snow_shape_step(const shape *self, const shape_maker *maker, const torus *box, snow_site corner, int direction);

#endif
