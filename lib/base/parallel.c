#define _POSIX_C_SOURCE 200809L
#include "base/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <unistd.h>

/* How often a helper looks for work before it goes to sleep, and the caller
   for the end of the loop before it yields its processor. Some ten microseconds. */
enum { LOOKS_BEFORE_SLEEP = 4000, LOOKS_BEFORE_YIELD = 2000 };

/* The ticket of a loop: its turn, the number of its tasks, the next task, in
   one word, so that a helper that comes late can never take a task of another
   loop than the one it saw. */
enum { TASK_BITS = 20 };
#define TASK_MASK SNOW_TEAM_MOST_TASKS

struct snow_team {
    _Atomic uint64_t ticket;
    _Atomic size_t finished;
    _Atomic bool closing;
    _Atomic int sleepers;
    snow_task task; /* these two are read only by who holds a task of the loop */
    void *argument;
    pthread_mutex_t mutex;
    pthread_cond_t wake;
    pid_t process;
    int helpers;
    pthread_t thread[];
};

static uint64_t next_task(uint64_t ticket)
{
    return ticket & TASK_MASK;
}

static uint64_t task_count(uint64_t ticket)
{
    return ticket >> TASK_BITS & TASK_MASK;
}

static uint64_t new_ticket(uint64_t last, size_t count)
{
    uint64_t turn = (last >> (2 * TASK_BITS)) + 1;
    return turn << (2 * TASK_BITS) | (uint64_t)count << TASK_BITS;
}

static void breathe(void)
{
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

/* Works as long as the loop has tasks that nobody has taken. */
static void work(snow_team *team)
{
    uint64_t ticket = atomic_load(&team->ticket);
    while (next_task(ticket) < task_count(ticket)) {
        if (!atomic_compare_exchange_weak(&team->ticket, &ticket, ticket + 1))
            continue;
        team->task(team->argument, (size_t)next_task(ticket));
        atomic_fetch_add(&team->finished, 1);
        ticket = atomic_load(&team->ticket);
    }
}

static bool is_idle(snow_team *team)
{
    uint64_t ticket = atomic_load(&team->ticket);
    return next_task(ticket) >= task_count(ticket) && !atomic_load(&team->closing);
}

static void sleep_until_woken(snow_team *team)
{
    pthread_mutex_lock(&team->mutex);
    atomic_fetch_add(&team->sleepers, 1);
    while (is_idle(team))
        pthread_cond_wait(&team->wake, &team->mutex);
    atomic_fetch_sub(&team->sleepers, 1);
    pthread_mutex_unlock(&team->mutex);
}

static void wake_sleepers(snow_team *team)
{
    if (atomic_load(&team->sleepers) == 0)
        return;
    pthread_mutex_lock(&team->mutex);
    pthread_cond_broadcast(&team->wake);
    pthread_mutex_unlock(&team->mutex);
}

static void *helper(void *argument)
{
    snow_team *team = argument;
    while (!atomic_load(&team->closing)) {
        for (int look = 0; look < LOOKS_BEFORE_SLEEP && is_idle(team); look++)
            breathe();
        if (is_idle(team))
            sleep_until_woken(team);
        work(team);
    }
    return NULL;
}

snow_status snow_team_start(snow_team **result, snow_heap *heap, int threads)
{
    int wanted = threads - 1;
    snow_team *team = snow_heap_get(heap, 1, sizeof *team + (size_t)wanted * sizeof team->thread[0]);
    if (team == NULL)
        return heap->refusal;
    team->process = getpid();
    pthread_mutex_init(&team->mutex, NULL);
    pthread_cond_init(&team->wake, NULL);
    while (team->helpers < wanted) {
        if (pthread_create(&team->thread[team->helpers], NULL, helper, team) != 0) {
            snow_team_end(team, heap);
            return SNOW_ERROR_THREADS;
        }
        team->helpers++;
    }
    *result = team;
    return SNOW_OK;
}

void snow_team_end(snow_team *team, snow_heap *heap)
{
    if (team == NULL)
        return;
    if (team->process == getpid()) {
        atomic_store(&team->closing, true);
        pthread_mutex_lock(&team->mutex);
        pthread_cond_broadcast(&team->wake);
        pthread_mutex_unlock(&team->mutex);
        for (int i = 0; i < team->helpers; i++)
            pthread_join(team->thread[i], NULL);
        pthread_cond_destroy(&team->wake);
        pthread_mutex_destroy(&team->mutex);
    }
    snow_heap_put(heap, team);
}

void snow_team_for(void *context, size_t count, snow_task task, void *argument)
{
    snow_team *team = context;
    if (team->helpers == 0 || count < 2 || count > TASK_MASK || team->process != getpid()) {
        for (size_t i = 0; i < count; i++)
            task(argument, i);
        return;
    }
    team->task = task;
    team->argument = argument;
    atomic_store(&team->finished, 0);
    atomic_store(&team->ticket, new_ticket(atomic_load(&team->ticket), count));
    wake_sleepers(team);
    work(team);
    for (int look = 0; atomic_load(&team->finished) < count; look++) {
        if (look < LOOKS_BEFORE_YIELD)
            breathe();
        else
            sched_yield();
    }
}
