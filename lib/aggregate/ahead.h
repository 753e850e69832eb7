/* Walkers on their way at the same time, against one cluster that grows meanwhile.

   Each thread takes the next numbers and walks some of them abreast (squad.h).
   Whoever finds nobody at it settles: walkers land in their order, one thread at
   a time. One whose diary would read otherwise by then goes back to the first
   answer that has changed and walks on from there. So each has walked on the
   cluster that those before it have left, as one by one.

   Settling changes the map while others read it. They may read a mixture of old
   and new; then the diary does not hold. Only what moves in memory, or moves
   the source, waits until nobody walks; when the source has moved, all who are
   out set out anew. */
#ifndef SNOW_AGGREGATE_AHEAD_H
#define SNOW_AGGREGATE_AHEAD_H

#include "aggregate/squad.h"

#include <snowgrowth/options.h>

#include <stdatomic.h>

typedef struct snow_voyage {
    _Atomic uint64_t done; /* 1 + the walker that this is, when it needs no more turns */
    uint64_t walker;
    uint64_t settled; /* how many had landed when it set out */
    /* Its diary: the rows from `first` to `end` of a lane. */
    const snow_squad *squad;
    int lane;
    uint32_t first, end;
    snow_stay stay; /* when it is done */
} snow_voyage;

enum { SNOW_QUEUE = 64 };

/* A squad's walkers that have not landed yet, in their order. */
typedef struct snow_queue {
    uint64_t walker[SNOW_QUEUE];
    uint32_t first[SNOW_QUEUE]; /* row of its diary */
    uint32_t oldest, next;
} snow_queue;

/* Those whom one thread walks. */
typedef struct snow_party {
    snow_squad squad[SNOW_SQUADS];
    snow_queue queue[SNOW_SQUADS];
    snow_voyage *voyage[SNOW_SQUADS][SNOW_LANES];
} snow_party;

/* Lands a walker; true: it is not the last one. */
typedef bool (*snow_landing)(void *context, uint64_t walker, snow_site site);

typedef struct snow_ahead {
    snow_voyage *voyage; /* a ring */
    uint64_t voyages;
    snow_row *rows;
    snow_tiles *tiles;
    snow_heights *heights;
    snow_party *party;
    int threads;
    int most_squads; /* there is room for so many of each thread; 0: not started */
    int squads;      /* so many of them walk */
    int abreast;     /* so many of a squad */
    uint64_t window; /* so many walkers are out at a time */
    _Atomic uint64_t next;
    _Atomic uint64_t settled;
    _Atomic int walking;
    _Atomic bool paused;
    _Atomic bool ended;
    atomic_flag settling;
    _Atomic uint64_t end; /* no walker from this number on sets out */
    bool fills_nothing; /* walkers land and leave no trace, so that every diary holds */
    /* What follows is for who settles. */
    uint64_t repeats;
    snow_landing land;
    void *context;
    snow_flight flight; /* of one that has to walk again */
    /* What walkers need. */
    const snow_ground *ground;
    uint64_t key;
} snow_ahead;

/* Nothing happens when there is room from before. */
snow_status snow_ahead_start(snow_ahead *ahead, snow_heap *heap, int threads, bool space);
void snow_ahead_end(snow_ahead *ahead, snow_heap *heap);

/* Sends out walkers from number `first` on, so many at first, until one is the
   last; returns the number after it. One thread does not use the loop. */
uint64_t snow_ahead_run(snow_ahead *ahead, snow_parallel_for loop, void *loop_context, uint64_t first, uint64_t count);

/* For who lands a walker that is not the last: one more may set out. */
void snow_ahead_extend(snow_ahead *ahead);

/* For who lands a walker: from pause to resume nobody else walks. */
void snow_ahead_pause(snow_ahead *ahead);
/* Between them: the source has moved, or the map's box. */
void snow_ahead_call_back(snow_ahead *ahead);
void snow_ahead_resume(snow_ahead *ahead);

#endif
