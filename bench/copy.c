#include "copy.h"

#include "machine.h"
#include "timing.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* One thread's part of the two arrays. */
typedef struct copy_part {
    char *from;
    char *to;
    size_t size;
    pthread_t thread;
} copy_part;

static void *touch_part(void *argument)
{
    copy_part *part = argument;
    memset(part->from, 1, part->size);
    memset(part->to, 2, part->size);
    return NULL;
}

static void *copy_part_once(void *argument)
{
    copy_part *part = argument;
    memcpy(part->to, part->from, part->size);
    return NULL;
}

static bool on_all_parts(copy_part *parts, int32_t threads, void *(*work)(void *))
{
    int32_t started = 0;
    while (started < threads && pthread_create(&parts[started].thread, NULL, work, &parts[started]) == 0)
        started++;
    for (int32_t i = 0; i < started; i++)
        pthread_join(parts[i].thread, NULL);
    return started == threads;
}

static double best_copy(copy_part *parts, int32_t threads)
{
    enum { PASSES = 7 };
    size_t moved = 2 * (size_t)threads * parts[0].size;
    if (!on_all_parts(parts, threads, touch_part))
        return 0.0;
    double best = 0.0;
    for (int pass = 0; pass < PASSES; pass++) {
        double start = timing_now();
        if (!on_all_parts(parts, threads, copy_part_once))
            return 0.0;
        double bandwidth = (double)moved / (timing_now() - start);
        best = bandwidth > best ? bandwidth : best;
    }
    return best;
}

double copy_bandwidth(int32_t threads)
{
    size_t part = 4 * machine_last_cache() / (size_t)threads;
    char *from = malloc((size_t)threads * part);
    char *to = malloc((size_t)threads * part);
    copy_part *parts = calloc((size_t)threads, sizeof *parts);
    double bandwidth = 0.0;
    if (from != NULL && to != NULL && parts != NULL) {
        for (size_t i = 0; i < (size_t)threads; i++)
            parts[i] = (copy_part){.from = from + i * part, .to = to + i * part, .size = part};
        bandwidth = best_copy(parts, threads);
    }
    free(parts);
    free(to);
    free(from);
    return bandwidth;
}
