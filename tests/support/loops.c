#include "loops.h"

#include "check.h"

#include <pthread.h>

static void run_in_order(void *context, size_t count, snow_task task, void *argument)
{
    (void)context;
    for (size_t i = 0; i < count; i++)
        task(argument, i);
}

static void run_reversed(void *context, size_t count, snow_task task, void *argument)
{
    (void)context;
    for (size_t i = count; i-- > 0;)
        task(argument, i);
}

typedef struct job {
    snow_task task;
    void *argument;
    size_t index;
} job;

static void *run_job(void *context)
{
    const job *mine = context;
    mine->task(mine->argument, mine->index);
    return NULL;
}

static void run_on_threads(void *context, size_t count, snow_task task, void *argument)
{
    (void)context;
    pthread_t threads[64];
    job jobs[64];
    assert_true(count <= COUNT_OF(threads));
    for (size_t i = 0; i < count; i++) {
        jobs[i] = (job){task, argument, i};
        assert_int_equal(0, pthread_create(&threads[i], NULL, run_job, &jobs[i]));
    }
    for (size_t i = 0; i < count; i++)
        assert_int_equal(0, pthread_join(threads[i], NULL));
}

const test_loop test_loops[] = {
    {"in order", run_in_order},
    {"reversed", run_reversed},
    {"threads", run_on_threads},
};
const size_t test_loop_count = COUNT_OF(test_loops);
