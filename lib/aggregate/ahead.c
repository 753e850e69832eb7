#define _POSIX_C_SOURCE 200809L
#include "aggregate/ahead.h"

#include "base/floating.h"

#include <sched.h>

/* How often a thread that has to wait looks before it yields its processor. */
enum { LOOKS_BEFORE_YIELD = 200 };

/* A thread has so many walkers on their way; as many again may wait for those before them. */
enum { ABREAST = 6, WALKERS_A_THREAD = 2 * ABREAST };

/* Walkers with longer diaries wait for their turn to land. */
enum { PLANE_QUESTIONS = 256, SPACE_QUESTIONS = 640 };

snow_status snow_ahead_start(snow_ahead *ahead, snow_heap *heap, int threads, bool space)
{
    if (ahead->window > 0)
        return SNOW_OK;
    uint64_t window = (uint64_t)threads * WALKERS_A_THREAD;
    uint32_t room = space ? SPACE_QUESTIONS : PLANE_QUESTIONS;
    ahead->voyage = snow_heap_get(heap, window, sizeof *ahead->voyage);
    ahead->questions = snow_heap_get_raw(heap, window, room * sizeof *ahead->questions);
    if (ahead->voyage == NULL || ahead->questions == NULL) {
        snow_ahead_end(ahead, heap);
        return heap->refusal;
    }
    for (uint64_t i = 0; i < window; i++) {
        ahead->voyage[i].flight.diary = ahead->questions + i * room;
        ahead->voyage[i].flight.room = room;
    }
    atomic_flag_clear(&ahead->settling);
    ahead->window = window;
    ahead->threads = threads;
    return SNOW_OK;
}

void snow_ahead_end(snow_ahead *ahead, snow_heap *heap)
{
    snow_heap_put(heap, ahead->questions);
    snow_heap_put(heap, ahead->voyage);
    ahead->questions = NULL;
    ahead->voyage = NULL;
    ahead->window = 0;
}

static void wait_a_little(int *looks)
{
    if (++*looks >= LOOKS_BEFORE_YIELD) {
        sched_yield();
        *looks = 0;
    }
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

void snow_ahead_pause(snow_ahead *ahead)
{
    atomic_store(&ahead->paused, true);
    for (int looks = 0; atomic_load(&ahead->walking) > 0;)
        wait_a_little(&looks);
}

void snow_ahead_resume(snow_ahead *ahead)
{
    ahead->epoch++;
    atomic_store(&ahead->paused, false);
}

void snow_ahead_extend(snow_ahead *ahead)
{
    atomic_fetch_add(&ahead->end, 1);
}

/* Those whom one thread walks. */
typedef struct squad {
    snow_voyage *voyage[ABREAST];
    snow_flight *flight[ABREAST];
    int count;
} squad;

/* The next number, unless too many are out. */
static bool take(snow_ahead *ahead, uint64_t *walker)
{
    *walker = atomic_load(&ahead->next);
    do {
        if (*walker >= atomic_load(&ahead->end) || *walker >= atomic_load(&ahead->settled) + ahead->window)
            return false;
    } while (!atomic_compare_exchange_weak(&ahead->next, walker, *walker + 1));
    return true;
}

static void set_out(snow_ahead *ahead, snow_voyage *voyage, uint64_t walker)
{
    voyage->walker = walker;
    voyage->settled = atomic_load(&ahead->settled);
    voyage->epoch = ahead->epoch;
    snow_flight_start(ahead->ground, &voyage->flight, ahead->key, walker);
}

static void fill_up(snow_ahead *ahead, squad *own)
{
    uint64_t walker;
    while (own->count < ABREAST && take(ahead, &walker)) {
        snow_voyage *voyage = &ahead->voyage[walker % ahead->window];
        set_out(ahead, voyage, walker);
        own->voyage[own->count] = voyage;
        own->flight[own->count++] = &voyage->flight;
    }
}

static void walk_on(const snow_ahead *ahead, squad *own)
{
    int i = snow_flight_share(ahead->ground, own->flight, own->count);
    snow_voyage *voyage = own->voyage[i];
    own->voyage[i] = own->voyage[--own->count];
    own->flight[i] = own->flight[own->count];
    atomic_store(&voyage->done, voyage->walker + 1);
}

/* False: it has to wait. */
static bool walk(snow_ahead *ahead, squad *own)
{
    atomic_fetch_add(&ahead->walking, 1);
    bool may = !atomic_load(&ahead->paused);
    if (may) {
        fill_up(ahead, own);
        may = own->count > 0;
        if (may)
            walk_on(ahead, own);
    }
    atomic_fetch_sub(&ahead->walking, 1);
    return may;
}

/* Undoes what the walker would not have done on the cluster as it stands. */
static void correct(snow_ahead *ahead, snow_voyage *voyage)
{
    if (voyage->epoch != ahead->epoch) {
        ahead->repeats++;
        snow_flight_start(ahead->ground, &voyage->flight, ahead->key, voyage->walker);
    } else if (voyage->settled < voyage->walker) {
        uint32_t outdated = snow_flight_outdated(ahead->ground, &voyage->flight, voyage->settled);
        if (outdated < voyage->flight.asked) {
            ahead->repeats++;
            snow_flight_rewind(&voyage->flight, outdated);
        }
    }
}

static void settle_one(snow_ahead *ahead, snow_voyage *voyage, uint64_t walker)
{
    snow_flight *flight = &voyage->flight;
    correct(ahead, voyage);
    snow_flight_finish(ahead->ground, flight);
    bool goes_on = ahead->land(ahead->context, walker, (snow_site){flight->x, flight->y, flight->z});
    atomic_store(&ahead->settled, walker + 1);
    if (!goes_on)
        atomic_store(&ahead->ended, true);
}

/* The next one to land, if it has come so far. */
static snow_voyage *due(const snow_ahead *ahead, uint64_t walker)
{
    snow_voyage *voyage = &ahead->voyage[walker % ahead->window];
    return atomic_load(&voyage->done) == walker + 1 ? voyage : NULL;
}

static void settle(snow_ahead *ahead)
{
    if (due(ahead, atomic_load(&ahead->settled)) == NULL || atomic_flag_test_and_set(&ahead->settling))
        return;
    while (!atomic_load(&ahead->ended)) {
        uint64_t walker = atomic_load(&ahead->settled);
        snow_voyage *voyage = due(ahead, walker);
        if (voyage == NULL)
            break;
        settle_one(ahead, voyage, walker);
    }
    atomic_flag_clear(&ahead->settling);
}

static SNOW_APART void work(snow_ahead *ahead)
{
    squad own = {.count = 0};
    for (int looks = 0; !atomic_load(&ahead->ended);) {
        settle(ahead);
        if (!atomic_load(&ahead->ended) && !walk(ahead, &own))
            wait_a_little(&looks);
    }
}

static void task(void *argument, size_t index)
{
    (void)index;
    snow_floating state;
    snow_floating_enter(&state);
    work(argument);
    snow_floating_leave(&state);
}

uint64_t snow_ahead_run(snow_ahead *ahead, snow_parallel_for loop, void *loop_context, uint64_t first, uint64_t count)
{
    for (uint64_t i = 0; i < ahead->window; i++)
        atomic_store(&ahead->voyage[i].done, 0);
    atomic_store(&ahead->end, first + count);
    atomic_store(&ahead->next, first);
    atomic_store(&ahead->settled, first);
    atomic_store(&ahead->ended, false);
    if (ahead->threads > 1)
        loop(loop_context, (size_t)ahead->threads, task, ahead);
    else
        work(ahead);
    return atomic_load(&ahead->settled);
}
