/* Where a walker leaves an empty region that it starts in the middle of:
   tables of the exact exit laws of the lattice's own walk, drawn from by
   A. J. Walker's alias method (ACM Trans. Math. Softw. 3 (1977) 253).

   The region of radius r is the square |x|, |y| < r, the hexagon of distances
   below r, the cube |x|, |y|, |z| < r. The walk leaves it through a site at
   distance r. */
#ifndef SNOW_AGGREGATE_EXITS_H
#define SNOW_AGGREGATE_EXITS_H

#include "base/heap.h"

#include <snowgrowth/aggregate.h>

#include <stdbool.h>
#include <stdint.h>

/* A column of an alias table: `own` where the number drawn is below the
   threshold, else `other`. In the plane a site's offset along its side, in
   space the greater offset on its face times 256 plus the smaller one. */
typedef struct snow_exit {
    uint32_t threshold;
    uint16_t own;
    uint16_t other;
} snow_exit;

typedef struct snow_exit_table {
    const snow_exit *exit;
    uint32_t mask; /* columns - 1, a power of two less one */
    int32_t radius;
} snow_exit_table;

/* The tables of a lattice, by ascending radius. Hexagonal: the largest entries
   have no table (exit is NULL): their region is left through a circle. */
enum { SNOW_EXIT_CLASSES = 24 };

typedef struct snow_exits {
    snow_aggregate_lattice lattice;
    int classes; /* table[1] … table[classes - 1]; 0 is no region */
    snow_exit_table table[SNOW_EXIT_CLASSES];
    snow_exit *storage;
} snow_exits;

snow_status snow_exits_start(snow_exits *exits, snow_heap *heap, snow_aggregate_lattice lattice);
void snow_exits_end(snow_exits *exits, snow_heap *heap);

/* The largest class whose radius is at most this; at least 1. */
int snow_exits_class(const snow_exits *exits, int64_t radius);

/* The laws themselves, for each radius from 1 on.
   Square: chance[x], x < radius, of each of the eight sites at offset x of a
   side (four at x = 0): the four sides hold 4 chance[0] + 8 (chance[1] + …) = 1.
   At most snow_exits_square_scratch() doubles are used beside it: none. */
void snow_exits_square(int32_t radius, double *chance);

/* Hexagonal: chance[t], t < radius, of each of the six sites t steps from a
   corner, t = 0 is the corner: 6 (chance[0] + …) = 1. */
snow_status snow_exits_hexagonal(int32_t radius, double *chance, snow_heap *heap);

/* Cubic: chance[a * (a + 1) / 2 + b], b <= a < radius, of each site with
   offsets a and b on its face. */
snow_status snow_exits_cubic(int32_t radius, double *chance, snow_heap *heap);

#endif
