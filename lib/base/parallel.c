#define _POSIX_C_SOURCE 200809L
#include "base/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <unistd.h>

/* How often a helper looks for work before it goes to sleep, and the caller
   for the end of the loop before it yields its processor. Some ten microseconds. */
enum { LOOKS_BEFORE_SLEEP = 4000, LOOKS_BEFORE_YIELD = 2000 };

/* A thread's share of a loop: the loop's turn, the share's next task and its end,
   in one word, so that a helper that comes late can never take a task of another
   loop than the one it saw. The owner takes tasks from the front, others from the
   back: in each loop over the same tasks a thread has the same ones, as far as the
   work is even, and finds their data in its own cache. */
enum { TASK_BITS = 20 };
#define TASK_MASK SNOW_TEAM_MOST_TASKS

typedef struct share {
    _Atomic uint64_t word;
    char apart[64 - sizeof(uint64_t)]; /* on a cache line of its own */
} share;

/* Who takes part: the caller, number 0, and the helpers. */
typedef struct member {
    struct snow_team *team;
    pthread_t thread;
    int number;
    share share;
} member;

struct snow_team {
    _Atomic uint64_t turn; /* of the loop that runs, or of the last one */
    _Atomic size_t finished;
    _Atomic bool closing;
    _Atomic int sleepers;
    snow_task task; /* these two are read only by who holds a task of the loop */
    void *argument;
    pthread_mutex_t mutex;
    pthread_cond_t wake;
    pid_t process;
    int members;
    member member[];
};

static uint64_t next_task(uint64_t word)
{
    return word & TASK_MASK;
}

static uint64_t end_task(uint64_t word)
{
    return word >> TASK_BITS & TASK_MASK;
}

static uint64_t make_share(uint64_t turn, size_t next, size_t end)
{
    return turn << (2 * TASK_BITS) | (uint64_t)end << TASK_BITS | (uint64_t)next;
}

static void breathe(void)
{
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

/* False: the share has none left. */
static bool take(share *from, bool is_own, size_t *task)
{
    uint64_t word = atomic_load(&from->word);
    while (next_task(word) < end_task(word)) {
        uint64_t rest = is_own ? word + 1 : word - (UINT64_C(1) << TASK_BITS);
        if (atomic_compare_exchange_weak(&from->word, &word, rest)) {
            *task = (size_t)(is_own ? next_task(word) : end_task(rest));
            return true;
        }
    }
    return false;
}

/* Works as long as the loop has tasks that nobody has taken: its own first. */
static void work(snow_team *team, int number)
{
    for (int i = 0; i < team->members; i++) {
        member *owner = &team->member[(number + i) % team->members];
        for (size_t task; take(&owner->share, i == 0, &task);) {
            team->task(team->argument, task);
            atomic_fetch_add(&team->finished, 1);
        }
    }
}

static bool is_idle(snow_team *team, uint64_t turn)
{
    return atomic_load(&team->turn) == turn && !atomic_load(&team->closing);
}

static void sleep_until_woken(snow_team *team, uint64_t turn)
{
    pthread_mutex_lock(&team->mutex);
    atomic_fetch_add(&team->sleepers, 1);
    while (is_idle(team, turn))
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
    const member *self = argument;
    snow_team *team = self->team;
    for (uint64_t turn = 0; !atomic_load(&team->closing);) {
        for (int look = 0; look < LOOKS_BEFORE_SLEEP && is_idle(team, turn); look++)
            breathe();
        if (is_idle(team, turn))
            sleep_until_woken(team, turn);
        turn = atomic_load(&team->turn);
        work(team, self->number);
    }
    return NULL;
}

snow_status snow_team_start(snow_team **result, snow_heap *heap, int threads)
{
    snow_team *team = snow_heap_get(heap, 1, sizeof *team + (size_t)threads * sizeof team->member[0]);
    if (team == NULL)
        return heap->refusal;
    team->process = getpid();
    pthread_mutex_init(&team->mutex, NULL);
    pthread_cond_init(&team->wake, NULL);
    for (team->members = 1; team->members < threads; team->members++) {
        member *next = &team->member[team->members];
        next->team = team;
        next->number = team->members;
        if (pthread_create(&next->thread, NULL, helper, next) != 0) {
            snow_team_end(team, heap);
            return SNOW_ERROR_THREADS;
        }
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
        for (int i = 1; i < team->members; i++)
            pthread_join(team->member[i].thread, NULL);
        pthread_cond_destroy(&team->wake);
        pthread_mutex_destroy(&team->mutex);
    }
    snow_heap_put(heap, team);
}

static void share_out(snow_team *team, size_t count)
{
    uint64_t turn = atomic_load(&team->turn) + 1;
    size_t members = (size_t)team->members;
    for (size_t i = 0; i < members; i++)
        atomic_store(&team->member[i].share.word, make_share(turn, i * count / members, (i + 1) * count / members));
    atomic_store(&team->turn, turn);
}

void snow_team_for(void *context, size_t count, snow_task task, void *argument)
{
    snow_team *team = context;
    if (team->members == 1 || count < 2 || count > TASK_MASK || team->process != getpid()) {
        for (size_t i = 0; i < count; i++)
            task(argument, i);
        return;
    }
    team->task = task;
    team->argument = argument;
    atomic_store(&team->finished, 0);
    share_out(team, count);
    wake_sleepers(team);
    work(team, 0);
    for (int look = 0; atomic_load(&team->finished) < count; look++) {
        if (look < LOOKS_BEFORE_YIELD)
            breathe();
        else
            sched_yield();
    }
}
