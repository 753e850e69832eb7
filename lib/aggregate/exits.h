/* Where a walker leaves an empty region that it starts in the middle of:
   tables of the exact exit laws of the lattice's own walk.

   The region of radius r is the square |x|, |y| < r, the hexagon of distances
   below r, the cube |x|, |y|, |z| < r. The walk leaves it through a site at
   distance r. */
#ifndef SNOW_AGGREGATE_EXITS_H
#define SNOW_AGGREGATE_EXITS_H

#include "base/heap.h"

#include <snowgrowth/aggregate.h>

#include <stdbool.h>
#include <stdint.h>

/* A column of an alias table for one side of the region. An outcome is the
   offset of a site along the side; in space the greater offset on the face
   times 256 plus the smaller one. */
typedef struct snow_exit {
    uint32_t threshold;
    uint16_t outcome[2]; /* below it, and from it on: an index costs no branch */
} snow_exit;

typedef struct snow_exit_table {
    const snow_exit *exit; /* never NULL */
    uint32_t columns;
    int32_t radius;
} snow_exit_table;

/* What a number points to: a column, and a place in it. */
typedef struct snow_exit_pick {
    const snow_exit *exit;
    uint32_t place;
} snow_exit_pick;

enum { SNOW_EXIT_CLASSES = 64, SNOW_EXIT_OCTAVES = 15, SNOW_EXIT_PARTS = 8, SNOW_EXIT_RADIUS_BITS = 14 };

/* The tables of a lattice, by ascending radius. */
typedef struct snow_exits {
    snow_aggregate_lattice lattice;
    int classes; /* table[1] ... table[classes - 1]; 0 is no region */
    int circles; /* those from this class on are left through circles, see source.h */
    snow_exit_table table[SNOW_EXIT_CLASSES + 1];
    snow_exit *exit;
    uint8_t class_from[SNOW_EXIT_OCTAVES][SNOW_EXIT_PARTS]; /* for radius 2^n (1 + part/8), rounded up */
    uint32_t place[SNOW_EXIT_CLASSES + 1]; /* for vectors: first column << SNOW_EXIT_RADIUS_BITS | radius */
    int32_t circle[SNOW_EXIT_CLASSES + 1]; /* the same for circles: their radius */
} snow_exits;

snow_status snow_exits_start(snow_exits *exits, snow_heap *heap, snow_aggregate_lattice lattice);
void snow_exits_end(snow_exits *exits, snow_heap *heap);

/* The largest class whose radius is at most this; radius >= 1. */
int snow_exits_class(const snow_exits *exits, int64_t radius);

/* One of the classes up to that, found without a search. */
int snow_exits_class_near(const snow_exits *exits, int64_t radius);

/* The number, taken as a fraction of 1, times the columns. What follows the
   place, 32 bits and more, is left for the symmetries of the region. */
static inline snow_exit_pick snow_exit_table_pick(const snow_exit_table *table, uint64_t number)
{
    uint64_t product = (number >> 32) * table->columns + ((number & 0xFFFFFFFF) * table->columns >> 32);
    return (snow_exit_pick){&table->exit[product >> 32], (uint32_t)product};
}

/* The laws themselves, for any radius from 1 on.
   Square: chance[x], x < radius, of each site at offset x of a side:
   4 chance[0] + 8 (chance[1] + ...) = 1. */
void snow_exits_square(int32_t radius, double *chance);

/* Hexagonal: chance[t], t < radius, of each of the six sites t steps from a
   corner: 6 (chance[0] + ...) = 1. */
snow_status snow_exits_hexagonal(int32_t radius, double *chance, snow_heap *heap);

/* Cubic: chance[a * (a + 1) / 2 + b], b <= a < radius, of each site with
   offsets a and b on its face. */
snow_status snow_exits_cubic(int32_t radius, double *chance, snow_heap *heap);

/* The one of these that is for the lattice. */
snow_status snow_exits_law(snow_aggregate_lattice lattice, int32_t radius, double *chance, snow_heap *heap);

#endif
