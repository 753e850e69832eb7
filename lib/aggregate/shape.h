/* What a step of a large cluster changes and comes to touch, as words of bits
   in the cluster's own frame: made once, used for every step until it grows. */
#ifndef SNOW_AGGREGATE_SHAPE_H
#define SNOW_AGGREGATE_SHAPE_H

#include "aggregate/box.h"

/* 64 sites of a row, from a multiple of 64 on. */
typedef struct shape_word {
    uint64_t mask;
    int32_t x;
    int32_t y;
    int32_t z;
} shape_word;

/* For each direction: the sites that a step frees or takes, and those that its front then touches or
   runs into. All in the box's coordinates, less the cluster's corner. */
typedef struct shape {
    uint32_t change_end[6];
    uint32_t touch_end[6];
    shape_word word[];
} shape;

/* Scratch to make shapes with. */
typedef struct shape_maker {
    uint64_t *own;  /* a box of bits: a set of sites */
    uint64_t *list; /* a box of bits: the list that is being made */
    uint32_t *used; /* words of `own` that are not 0 */
    uint32_t *hit;  /* words of `list` that are not 0 */
    uint32_t used_count;
    uint32_t hit_count;
    size_t row_words;
    size_t words; /* in a box */
    shape_word *word; /* the words so far */
    size_t count;
    size_t capacity;
} shape_maker;

snow_status snow_shape_maker_start(shape_maker *self, snow_heap *heap, const torus *box);
void snow_shape_maker_end(shape_maker *self, snow_heap *heap);

/* A set of sites of the box, empty between two uses. */
void snow_shape_maker_add(shape_maker *self, const torus *box, snow_site site);
bool snow_shape_maker_has(const shape_maker *self, const torus *box, snow_site site);
void snow_shape_maker_clear(shape_maker *self);

/* The shape of sites that are given from the cluster's corner, within the box. */
snow_status snow_shape_make(shape_maker *self, snow_heap *heap, const torus *box, const snow_site *sites,
                            uint32_t count, shape **made);

/* Calls for each site that is touched; returns whether there is any. */
typedef void (*snow_shape_touch)(void *context, snow_site site);
bool snow_shape_find_touched(const shape *self, const torus *box, snow_site corner, int direction,
                             snow_shape_touch touch, void *context);

/* Takes the step in the box's bits. */
void snow_shape_step(const shape *self, const torus *box, snow_site corner, int direction);

#endif
