/* Walkers that walk at the same time against the same cluster, each with a diary. */
#ifndef SNOW_AGGREGATE_AHEAD_H
#define SNOW_AGGREGATE_AHEAD_H

#include "aggregate/flight.h"

#include <snowgrowth/options.h>

enum { SNOW_AHEAD_QUESTIONS = 384 };

typedef struct snow_voyage {
    snow_draws draws;
    snow_site end;
    snow_diary diary;
} snow_voyage;

typedef struct snow_ahead {
    snow_voyage *voyage;
    snow_question *questions;
    size_t most;  /* voyages that there is room for; 0: not started */
    size_t least; /* that keep all threads busy */
    size_t batch; /* that are out at a time */
    size_t again; /* of the batch, that had to walk again */
    uint64_t repeats;
    uint64_t epoch; /* changes when the source does */
    /* What the tasks need. */
    const snow_ground *ground;
    uint64_t key;
    uint64_t first;
} snow_ahead;

/* Nothing happens when it was started before. */
snow_status snow_ahead_start(snow_ahead *ahead, snow_heap *heap, int threads);
void snow_ahead_end(snow_ahead *ahead, snow_heap *heap);

/* Sends out a batch of walkers, from this number on. */
void snow_ahead_walk(snow_ahead *ahead, const snow_ground *ground, snow_parallel_for loop, void *context, uint64_t key,
                     uint64_t first);

/* Where walker number i of the batch ends now. The source may have changed. */
snow_site snow_ahead_settle(snow_ahead *ahead, const snow_ground *ground, size_t i, bool same_source);

/* Larger batches cost less, but more of their walkers have to walk again. */
void snow_ahead_adapt(snow_ahead *ahead);

#endif
