/* Drawing from a finite law with one number: A. J. Walker, ACM Trans. Math.
   Softw. 3 (1977) 253. */
#ifndef SNOW_AGGREGATE_ALIAS_H
#define SNOW_AGGREGATE_ALIAS_H

#include "base/heap.h"

#include <stdint.h>

/* Columns of equal weight: column i stands for outcome i below its threshold
   (in 2^-32), for outcome other[i] above. */
typedef struct snow_alias {
    double *weight; /* of the outcomes; used up */
    uint32_t *threshold;
    uint32_t *other;
    uint32_t *queue;
} snow_alias;

/* For laws of at most `most` outcomes. */
snow_status snow_alias_start(snow_alias *alias, snow_heap *heap, uint32_t most);
void snow_alias_end(snow_alias *alias, snow_heap *heap);

/* Cuts as many columns from the first `outcomes` weights, whatever they add up to. */
void snow_alias_cut(snow_alias *alias, uint32_t outcomes);

#endif
