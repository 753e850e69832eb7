/* Parallel loops over a few tasks, thousands of times a second. */
#ifndef SNOW_BASE_PARALLEL_H
#define SNOW_BASE_PARALLEL_H

#include "base/heap.h"

#include <snowgrowth/options.h>

typedef struct snow_team snow_team;

/* A loop with more tasks is not shared out. */
#define SNOW_TEAM_MOST_TASKS ((UINT64_C(1) << 20) - 1)

/* Starts threads − 1 helpers that wait for work. */
snow_status snow_team_start(snow_team **team, snow_heap *heap, int threads);
void snow_team_end(snow_team *team, snow_heap *heap);

/* A ::snow_parallel_for whose context is a team. The caller works too. In a
   process that was forked off, where the helpers do not live, it works alone. */
void snow_team_for(void *team, size_t count, snow_task task, void *argument);

#endif
