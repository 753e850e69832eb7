#include "aggregate/ahead.h"

enum {
    WALKERS_A_TASK = 4,
    TASKS_A_THREAD = 2,
    GROWTH = 8 /* the largest batch, in smallest ones */
};

snow_status snow_ahead_start(snow_ahead *ahead, snow_heap *heap, int threads)
{
    if (ahead->most > 0)
        return SNOW_OK;
    size_t least = (size_t)threads * TASKS_A_THREAD * WALKERS_A_TASK;
    size_t most = least * GROWTH;
    ahead->voyage = snow_heap_get(heap, most, sizeof *ahead->voyage);
    ahead->questions = snow_heap_get_raw(heap, most, SNOW_AHEAD_QUESTIONS * sizeof *ahead->questions);
    if (ahead->voyage == NULL || ahead->questions == NULL) {
        snow_ahead_end(ahead, heap);
        return heap->refusal;
    }
    for (size_t i = 0; i < most; i++)
        ahead->voyage[i].diary.question = ahead->questions + i * SNOW_AHEAD_QUESTIONS;
    ahead->most = most;
    ahead->least = least;
    ahead->batch = least;
    return SNOW_OK;
}

void snow_ahead_end(snow_ahead *ahead, snow_heap *heap)
{
    snow_heap_put(heap, ahead->questions);
    snow_heap_put(heap, ahead->voyage);
    ahead->questions = NULL;
    ahead->voyage = NULL;
    ahead->most = 0;
}

static void walk(snow_ahead *ahead, const snow_ground *ground, size_t i, size_t room)
{
    snow_voyage *voyage = &ahead->voyage[i];
    snow_draws_start(&voyage->draws, ground->refill, ahead->key, ahead->first + i);
    voyage->diary.count = 0;
    voyage->diary.room = room;
    voyage->end = snow_flight(ground, &voyage->draws, &voyage->diary);
}

static void task(void *argument, size_t index)
{
    snow_ahead *ahead = argument;
    for (size_t i = index * WALKERS_A_TASK; i < (index + 1) * WALKERS_A_TASK; i++)
        walk(ahead, ahead->ground, i, SNOW_AHEAD_QUESTIONS);
}

void snow_ahead_walk(snow_ahead *ahead, const snow_ground *ground, snow_parallel_for loop, void *context, uint64_t key,
                     uint64_t first)
{
    ahead->ground = ground;
    ahead->key = key;
    ahead->first = first;
    ahead->again = 0;
    loop(context, ahead->batch / WALKERS_A_TASK, task, ahead);
}

snow_site snow_ahead_settle(snow_ahead *ahead, const snow_ground *ground, size_t i, bool same_source)
{
    const snow_diary *diary = &ahead->voyage[i].diary;
    bool holds = i == 0 || (same_source && diary->count <= diary->room && snow_flight_holds(ground, diary));
    if (!holds) {
        ahead->again++;
        ahead->repeats++;
        walk(ahead, ground, i, 0);
    }
    return ahead->voyage[i].end;
}

void snow_ahead_adapt(snow_ahead *ahead)
{
    if (ahead->again * 8 > ahead->batch && ahead->batch > ahead->least)
        ahead->batch /= 2;
    else if (ahead->again * 16 < ahead->batch && ahead->batch < ahead->most)
        ahead->batch *= 2;
}
