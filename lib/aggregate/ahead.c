#define _POSIX_C_SOURCE 200809L
#include "aggregate/ahead.h"

#include "base/floating.h"

#include <sched.h>
#include <string.h>

/* How often a thread that has to wait looks before it yields its processor. */
enum { WALKERS_A_THREAD = 4, LOOKS_BEFORE_YIELD = 200 };

/* A filled site changes what is known nearby up to this far, in squares (cubes) of so many sites. */
enum { PLANE_REACH = 44, PLANE_SHIFT = 6, SPACE_REACH = 24, SPACE_SHIFT = 5 };

snow_status snow_ahead_start(snow_ahead *ahead, snow_heap *heap, int threads)
{
    if (ahead->window > 0)
        return SNOW_OK;
    uint64_t window = (uint64_t)threads * WALKERS_A_THREAD;
    ahead->voyage = snow_heap_get(heap, window, sizeof *ahead->voyage);
    ahead->questions = snow_heap_get_raw(heap, window, SNOW_AHEAD_QUESTIONS * sizeof *ahead->questions);
    if (ahead->voyage == NULL || ahead->questions == NULL) {
        snow_ahead_end(ahead, heap);
        return heap->refusal;
    }
    for (uint64_t i = 0; i < window; i++)
        ahead->voyage[i].diary.question = ahead->questions + i * SNOW_AHEAD_QUESTIONS;
    atomic_flag_clear(&ahead->settling);
    ahead->window = window;
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

static void walk(const snow_ahead *ahead, snow_voyage *voyage, uint64_t walker, size_t room)
{
    snow_draws_start(&voyage->draws, ahead->ground->refill, ahead->key, walker);
    voyage->diary.count = 0;
    voyage->diary.room = room;
    voyage->end = snow_flight(ahead->ground, &voyage->draws, &voyage->diary);
}

/* The next number, unless too many are out. */
static bool take(snow_ahead *ahead, uint64_t *walker)
{
    *walker = atomic_load(&ahead->next);
    do {
        if (*walker >= atomic_load(&ahead->settled) + ahead->window)
            return false;
    } while (!atomic_compare_exchange_weak(&ahead->next, walker, *walker + 1));
    return true;
}

/* False: it has to wait. */
static bool walk_next(snow_ahead *ahead)
{
    uint64_t walker;
    atomic_fetch_add(&ahead->walking, 1);
    bool may = !atomic_load(&ahead->paused) && take(ahead, &walker);
    if (may) {
        snow_voyage *voyage = &ahead->voyage[walker % ahead->window];
        voyage->settled = atomic_load(&ahead->settled);
        voyage->epoch = ahead->epoch;
        walk(ahead, voyage, walker, SNOW_AHEAD_QUESTIONS);
        atomic_store(&voyage->done, walker + 1);
    }
    atomic_fetch_sub(&ahead->walking, 1);
    return may;
}

static bool is_in_space(const snow_ahead *ahead)
{
    return ahead->ground->exits.lattice == SNOW_AGGREGATE_CUBIC;
}

/* Place of a square (cube) among the marks. */
static uint32_t mark_of(int32_t x, int32_t y, int32_t z)
{
    return ((uint32_t)x + 32 * (uint32_t)y + 37 * (uint32_t)z) % SNOW_AHEAD_MARKS;
}

/* Arithmetic shift: squares of the plane to the left of and below the origin, too. */
static int32_t square_of(int32_t x, int shift)
{
    return (int32_t)(((int64_t)x + (INT64_C(1) << 32)) >> shift) - (int32_t)(INT64_C(1) << (32 - shift));
}

static void mark_around(snow_ahead *ahead, snow_site site, uint64_t number)
{
    bool space = is_in_space(ahead);
    int shift = space ? SPACE_SHIFT : PLANE_SHIFT;
    int32_t reach = space ? SPACE_REACH : PLANE_REACH;
    int32_t last_x = square_of(site.x + reach, shift);
    int32_t last_y = square_of(site.y + reach, shift);
    int32_t last_z = space ? square_of(site.z + reach, shift) : 0;
    for (int32_t z = space ? square_of(site.z - reach, shift) : 0; z <= last_z; z++)
        for (int32_t y = square_of(site.y - reach, shift); y <= last_y; y++)
            for (int32_t x = square_of(site.x - reach, shift); x <= last_x; x++)
                ahead->mark[mark_of(x, y, z)] = number;
}

/* Whether nothing has changed where the walker has asked. */
static bool is_untouched(const snow_ahead *ahead, const snow_voyage *voyage)
{
    if (ahead->far_changed > voyage->settled)
        return false;
    int shift = is_in_space(ahead) ? SPACE_SHIFT : PLANE_SHIFT;
    for (size_t i = 0; i < voyage->diary.count; i++) {
        snow_site site = voyage->diary.question[i].site;
        uint32_t place = mark_of(square_of(site.x, shift), square_of(site.y, shift), square_of(site.z, shift));
        if (ahead->mark[place] > voyage->settled)
            return false;
    }
    return true;
}

static bool holds(const snow_ahead *ahead, const snow_voyage *voyage, uint64_t walker)
{
    if (voyage->epoch != ahead->epoch || voyage->diary.count > voyage->diary.room)
        return voyage->epoch == ahead->epoch && voyage->settled == walker;
    return voyage->settled == walker || is_untouched(ahead, voyage) || snow_flight_holds(ahead->ground, &voyage->diary);
}

static uint64_t far_changes(const snow_ahead *ahead)
{
    return is_in_space(ahead) ? ahead->ground->space.far_changes : ahead->ground->plane.far_changes;
}

static void settle_one(snow_ahead *ahead, snow_voyage *voyage, uint64_t walker)
{
    if (!holds(ahead, voyage, walker)) {
        ahead->repeats++;
        walk(ahead, voyage, walker, 0);
    }
    uint64_t far = far_changes(ahead);
    bool goes_on = ahead->land(ahead->context, voyage->end);
    mark_around(ahead, voyage->end, walker + 1);
    if (far_changes(ahead) != far)
        ahead->far_changed = walker + 1;
    atomic_store(&ahead->settled, walker + 1);
    if (!goes_on)
        atomic_store(&ahead->ended, true);
}

static void settle(snow_ahead *ahead)
{
    while (!atomic_load(&ahead->ended)) {
        uint64_t walker = atomic_load(&ahead->settled);
        snow_voyage *voyage = &ahead->voyage[walker % ahead->window];
        if (atomic_load(&voyage->done) != walker + 1)
            break;
        settle_one(ahead, voyage, walker);
    }
}

static SNOW_APART void work(snow_ahead *ahead)
{
    for (int looks = 0; !atomic_load(&ahead->ended);) {
        if (!atomic_flag_test_and_set(&ahead->settling)) {
            settle(ahead);
            atomic_flag_clear(&ahead->settling);
        }
        if (!atomic_load(&ahead->ended) && !walk_next(ahead))
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

uint64_t snow_ahead_run(snow_ahead *ahead, snow_parallel_for loop, void *loop_context, int threads, uint64_t first)
{
    for (uint64_t i = 0; i < ahead->window; i++)
        atomic_store(&ahead->voyage[i].done, 0);
    memset(ahead->mark, 0, sizeof ahead->mark);
    ahead->far_changed = 0;
    atomic_store(&ahead->next, first);
    atomic_store(&ahead->settled, first);
    atomic_store(&ahead->ended, false);
    loop(loop_context, (size_t)threads, task, ahead);
    return atomic_load(&ahead->settled);
}
