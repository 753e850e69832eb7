#define _POSIX_C_SOURCE 200809L
#include "aggregate/ahead.h"

#include "base/floating.h"

#include <sched.h>

/* How often a thread that has to wait looks before it yields its processor. */
enum { LOOKS_BEFORE_YIELD = 200 };

/* Walkers of a thread: so many are on their way, in squads, and so many more may have landed and wait for those
   before them. A squad has so many rows for diaries; a walker that asks more waits for its turn to land. */
typedef struct formation {
    int squads, abreast, waiting;
    uint32_t rows;
} formation;

enum { ROWS = 256, ROWS_IN_TURN = 64 /* they stay next to the processor */ };

static const formation in_turn = {1, 6, 6, ROWS_IN_TURN};
static const formation small = {2, SNOW_LANES, 16, ROWS};
static const formation medium = {2, SNOW_LANES, 32, ROWS};
static const formation large = {3, SNOW_LANES, 48, ROWS};
static const formation largest = {SNOW_SQUADS, SNOW_LANES, 64, ROWS};

/* The larger the cluster the longer each waits for memory, and the less they walk in vain. */
static const formation *formation_for(const snow_ground *ground)
{
    int32_t rim = ground->source.rim;
    if (ground->walk == snow_squads_walk_in_turn)
        return &in_turn;
    if (ground->exits.lattice == SNOW_AGGREGATE_CUBIC)
        return rim < 150 ? &small : &large;
    return rim < 320 ? &small : rim < 1024 ? &medium : rim < 4096 ? &large : &largest;
}

static uint64_t window_of(const formation *walkers, int threads)
{
    return (uint64_t)threads * (uint64_t)(walkers->squads * walkers->abreast + walkers->waiting);
}

/* When nobody is out. */
static void arrange(snow_ahead *ahead)
{
    const formation *walkers = formation_for(ahead->ground);
    ahead->squads = walkers->squads;
    ahead->abreast = walkers->abreast;
    ahead->window = window_of(walkers, ahead->threads);
}

snow_status snow_ahead_start(snow_ahead *ahead, snow_heap *heap, int threads, bool space)
{
    const formation *most = ahead->ground->walk == snow_squads_walk_in_turn ? &in_turn : &largest;
    if (ahead->most_squads >= most->squads)
        return SNOW_OK;
    snow_ahead_end(ahead, heap);
    uint32_t room = most->rows;
    size_t rings = (size_t)threads * (size_t)most->squads;
    ahead->threads = threads;
    ahead->voyages = window_of(most, threads);
    ahead->voyage = snow_heap_get(heap, (size_t)ahead->voyages, sizeof *ahead->voyage);
    ahead->party = snow_heap_get(heap, (size_t)threads, sizeof *ahead->party);
    ahead->rows = snow_heap_get(heap, rings * room, sizeof *ahead->rows);
    ahead->tiles = snow_heap_get(heap, rings * room, sizeof *ahead->tiles);
    ahead->heights = space ? snow_heap_get(heap, rings * room, sizeof *ahead->heights) : NULL;
    if (ahead->voyage == NULL || ahead->party == NULL || ahead->rows == NULL || ahead->tiles == NULL ||
        (space && ahead->heights == NULL)) {
        snow_ahead_end(ahead, heap);
        return heap->refusal;
    }
    for (size_t i = 0; i < rings; i++) {
        snow_squad *squad = &ahead->party[i / (size_t)most->squads].squad[i % (size_t)most->squads];
        squad->rows = ahead->rows + i * room;
        squad->tiles = ahead->tiles + i * room;
        squad->heights = space ? ahead->heights + i * room : NULL;
        squad->room = room;
    }
    atomic_flag_clear(&ahead->settling);
    ahead->most_squads = most->squads;
    arrange(ahead);
    return SNOW_OK;
}

void snow_ahead_end(snow_ahead *ahead, snow_heap *heap)
{
    snow_heap_put(heap, ahead->heights);
    snow_heap_put(heap, ahead->tiles);
    snow_heap_put(heap, ahead->rows);
    snow_heap_put(heap, ahead->party);
    snow_heap_put(heap, ahead->voyage);
    ahead->heights = NULL;
    ahead->tiles = NULL;
    ahead->rows = NULL;
    ahead->party = NULL;
    ahead->voyage = NULL;
    ahead->voyages = 0;
    ahead->threads = 0;
    ahead->most_squads = 0;
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

/* Nobody is out any more. */
static void forget_all(snow_ahead *ahead)
{
    for (uint64_t i = 0; i < ahead->voyages; i++)
        atomic_store_explicit(&ahead->voyage[i].done, 0, memory_order_relaxed);
    for (int thread = 0; thread < ahead->threads; thread++) {
        snow_party *party = &ahead->party[thread];
        for (int i = 0; i < ahead->most_squads; i++) {
            party->squad[i].busy = 0;
            party->squad[i].key = ahead->key;
            party->queue[i].oldest = party->queue[i].next;
        }
    }
    if (ahead->threads > 0)
        arrange(ahead);
}

void snow_ahead_call_back(snow_ahead *ahead)
{
    forget_all(ahead);
    atomic_store(&ahead->next, atomic_load(&ahead->settled) + 1); /* that one is landing */
}

void snow_ahead_resume(snow_ahead *ahead)
{
    atomic_store(&ahead->paused, false);
}

void snow_ahead_extend(snow_ahead *ahead)
{
    atomic_fetch_add(&ahead->end, 1);
}

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

static void set_out(snow_ahead *ahead, snow_party *own, int i, int lane, uint64_t walker)
{
    snow_voyage *voyage = &ahead->voyage[walker % ahead->voyages];
    snow_squad *squad = &own->squad[i];
    snow_queue *queue = &own->queue[i];
    voyage->walker = walker;
    voyage->settled = atomic_load(&ahead->settled);
    voyage->squad = squad;
    voyage->lane = lane;
    voyage->first = squad->next;
    own->voyage[i][lane] = voyage;
    queue->walker[queue->next % SNOW_QUEUE] = walker;
    queue->first[queue->next++ % SNOW_QUEUE] = squad->next;
    snow_flight_start(ahead->ground, &squad->flight[lane], ahead->key, walker);
    snow_squad_enter(squad, lane);
}

/* Fills the lanes of a squad that are free. False: too many are out. */
static bool fill_squad(snow_ahead *ahead, snow_party *own, int i)
{
    const uint32_t lanes = (1u << ahead->abreast) - 1;
    const snow_queue *queue = &own->queue[i];
    for (uint32_t free = lanes & ~own->squad[i].busy; free != 0; free &= free - 1) {
        uint64_t walker;
        if (queue->next - queue->oldest == SNOW_QUEUE || !take(ahead, &walker))
            return false;
        set_out(ahead, own, i, __builtin_ctz(free), walker);
    }
    return true;
}

/* True: somebody walks. */
static bool fill_up(snow_ahead *ahead, snow_party *own)
{
    uint32_t busy = 0;
    for (int i = 0; i < ahead->squads && fill_squad(ahead, own, i); i++) {}
    for (int i = 0; i < ahead->squads; i++)
        busy |= own->squad[i].busy;
    return busy != 0;
}

/* Rows that nobody needs any more may be written anew. */
static void free_rows(const snow_ahead *ahead, snow_squad *squad, snow_queue *queue)
{
    uint64_t settled = atomic_load(&ahead->settled);
    while (queue->oldest != queue->next && queue->walker[queue->oldest % SNOW_QUEUE] < settled)
        queue->oldest++;
    uint32_t needed = queue->oldest == queue->next ? squad->next : queue->first[queue->oldest % SNOW_QUEUE];
    squad->stop = needed + squad->room;
}

static void finish(const snow_ahead *ahead, snow_party *own, int i, int lane)
{
    snow_voyage *voyage = own->voyage[i][lane];
    voyage->end = own->squad[i].next;
    voyage->stay = snow_squad_leave(ahead->ground, &own->squad[i], lane);
    atomic_store_explicit(&voyage->done, voyage->walker + 1, memory_order_release);
}

/* Those who have landed, and one whose diary has filled the ring. */
static bool finish_some(const snow_ahead *ahead, snow_party *own, int i)
{
    const snow_squad *squad = &own->squad[i];
    const snow_queue *queue = &own->queue[i];
    uint32_t ready = squad->landed & squad->busy;
    if (squad->stop - squad->next < 2) {
        uint64_t oldest = queue->walker[queue->oldest % SNOW_QUEUE];
        for (int lane = 0; lane < SNOW_LANES; lane++)
            if ((squad->busy >> lane & 1) != 0 && own->voyage[i][lane]->walker == oldest)
                ready |= 1u << lane;
    }
    for (uint32_t left = ready; left != 0; left &= left - 1)
        finish(ahead, own, i, __builtin_ctz(left));
    return ready != 0;
}

static bool walk_on(const snow_ahead *ahead, snow_party *own)
{
    bool some = false;
    for (int i = 0; i < ahead->squads; i++)
        free_rows(ahead, &own->squad[i], &own->queue[i]);
    ahead->ground->walk(ahead->ground, own->squad, ahead->squads);
    for (int i = 0; i < ahead->squads; i++)
        some |= finish_some(ahead, own, i);
    return some;
}

/* False: it has to wait. */
static bool walk(snow_ahead *ahead, snow_party *own)
{
    atomic_fetch_add(&ahead->walking, 1);
    bool may = !atomic_load(&ahead->paused) && fill_up(ahead, own) && walk_on(ahead, own);
    atomic_fetch_sub(&ahead->walking, 1);
    return may;
}

/* Back to where the walker did what it would not have done on the cluster as it stands. */
static void correct(snow_ahead *ahead, snow_voyage *voyage)
{
    if (ahead->fills_nothing || voyage->settled == voyage->walker)
        return;
    uint32_t row = ahead->ground->outdated(ahead->ground, voyage->squad, voyage->lane, voyage->first, voyage->end,
                                           voyage->settled);
    if (row == voyage->end)
        return;
    ahead->repeats++;
    voyage->stay = snow_squad_asked(voyage->squad, voyage->lane, row);
}

/* Where the walker lands on the cluster as it stands. */
static snow_site arrive(snow_ahead *ahead, snow_voyage *voyage)
{
    correct(ahead, voyage);
    if (voyage->stay.landed)
        return voyage->stay.site;
    snow_flight_resume(ahead->ground, &ahead->flight, ahead->key, voyage->walker, voyage->stay);
    return snow_flight_finish(ahead->ground, &ahead->flight);
}

static void settle_one(snow_ahead *ahead, snow_voyage *voyage, uint64_t walker)
{
    snow_site site = arrive(ahead, voyage);
    bool goes_on = ahead->land(ahead->context, walker, site);
    atomic_store_explicit(&ahead->settled, walker + 1, memory_order_release);
    if (!goes_on)
        atomic_store(&ahead->ended, true);
}

/* The next one to land, if it has come so far. */
static snow_voyage *due(const snow_ahead *ahead, uint64_t walker)
{
    snow_voyage *voyage = &ahead->voyage[walker % ahead->voyages];
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
    atomic_flag_clear_explicit(&ahead->settling, memory_order_release);
}

static SNOW_APART void work(snow_ahead *ahead, snow_party *own)
{
    for (int looks = 0; !atomic_load(&ahead->ended);) {
        settle(ahead);
        if (!atomic_load(&ahead->ended) && !walk(ahead, own))
            wait_a_little(&looks);
    }
}

static void task(void *argument, size_t index)
{
    snow_ahead *ahead = argument;
    snow_floating state;
    snow_floating_enter(&state);
    work(ahead, &ahead->party[index]);
    snow_floating_leave(&state);
}

uint64_t snow_ahead_run(snow_ahead *ahead, snow_parallel_for loop, void *loop_context, uint64_t first, uint64_t count)
{
    forget_all(ahead);
    atomic_store(&ahead->end, first + count);
    atomic_store(&ahead->next, first);
    atomic_store(&ahead->settled, first);
    atomic_store(&ahead->ended, false);
    if (ahead->threads > 1)
        loop(loop_context, (size_t)ahead->threads, task, ahead);
    else
        work(ahead, ahead->party);
    return atomic_load(&ahead->settled);
}
