/* Threads, for every model: their number changes no bit, grids share nothing, a child process may go on with its
   parent's grid, and a grid that is destroyed leaves no thread behind. */
#define _POSIX_C_SOURCE 200809L
#include "support/grids.h"
#include "support/lives.h"

#include <dirent.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static snow_options options_of(int32_t threads)
{
    snow_options options = default_options();
    options.threads = threads;
    return options;
}

/* Grown, changed and grown again, as every model can be: by a set field, or by nothing. */
static saved_life live(const test_life *life, bool large, int32_t threads, int64_t steps)
{
    snow_options options = options_of(threads);
    snow_grid *grid = start_life(life, large, &options);
    assert_ok(snow_step(grid, steps));
    (void)snow_field_set(grid, SNOW_FIELD_VALUE, &(snow_rect){2, 3, 1, 1}, &(double){1}, 1);
    assert_ok(snow_step(grid, steps / 2));
    saved_life saved = save_life(grid);
    snow_destroy(grid);
    return saved;
}

static void any_number_of_threads_gives_the_same_bits(void **state)
{
    (void)state;
    static const int32_t counts[] = {2, 3, 8, 64};
    for (size_t i = 0; i < test_life_count; i++) {
        saved_life expected = live(&test_lives[i], true, 1, 12);
        for (size_t k = 0; k < COUNT_OF(counts); k++) {
            saved_life got = live(&test_lives[i], true, counts[k], 12);
            assert_same_lives(&expected, &got, test_lives[i].name);
            free_life(&got);
        }
        free_life(&expected);
    }
}

/* --- many grids in many threads; cmocka's assertions are for one thread only --- */

enum { LIVES = 24 };

typedef struct apart {
    const test_life *life;
    int32_t threads;
    snow_status status;
    uint64_t digest;
} apart;

static void *live_apart(void *context)
{
    apart *mine = context;
    snow_options options;
    snow_options_init(&options, sizeof options);
    options.threads = mine->threads;
    for (int round = 0; round < 3 && mine->status == SNOW_OK; round++) {
        snow_grid *grid = NULL;
        mine->status = mine->life->create(false, &options, &grid);
        if (mine->status == SNOW_OK)
            mine->status = snow_step(grid, 40);
        if (mine->status == SNOW_OK)
            mine->status = snow_digest(grid, &mine->digest);
        snow_destroy(grid);
    }
    return NULL;
}

static void grids_share_nothing(void **state)
{
    (void)state;
    apart lives[LIVES];
    pthread_t threads[LIVES];
    for (size_t i = 0; i < LIVES; i++) {
        lives[i] = (apart){&test_lives[i % test_life_count], 1 + (int32_t)i % 3, SNOW_OK, 0};
        assert_int_equal(0, pthread_create(&threads[i], NULL, live_apart, &lives[i]));
    }
    for (size_t i = 0; i < LIVES; i++)
        assert_int_equal(0, pthread_join(threads[i], NULL));
    for (size_t i = 0; i < LIVES; i++) {
        snow_grid *plain = start_life(lives[i].life, false, NULL);
        assert_ok(snow_step(plain, 40));
        assert_ok(lives[i].status);
        assert_true(lives[i].digest == digest_of(plain));
        snow_destroy(plain);
    }
}

typedef struct reading {
    const snow_grid *grid;
    uint64_t digest;
    size_t size;
    uint64_t frozen;
} reading;

static void *read_apart(void *context)
{
    reading *mine = context;
    static const snow_rect rect = {-3, -3, 7, 7};
    double values[49], defect;
    (void)snow_digest(mine->grid, &mine->digest);
    (void)snow_save(mine->grid, NULL, 0, &mine->size);
    (void)snow_symmetry_defect(mine->grid, &defect);
    (void)snow_field_copy(mine->grid, SNOW_FIELD_FROZEN, &rect, values, 49, NULL);
    (void)snow_frozen(mine->grid, &mine->frozen);
    return NULL;
}

/* Calls that take the grid as const may run at the same time. */
static void a_grid_may_be_read_by_many_threads(void **state)
{
    (void)state;
    enum { READERS = 6 };
    for (size_t i = 0; i < test_life_count; i++) {
        snow_grid *grid = start_life(&test_lives[i], false, NULL);
        assert_ok(snow_step(grid, 30));
        reading readings[READERS], expected = {.grid = grid};
        pthread_t threads[READERS];
        for (size_t k = 0; k < READERS; k++) {
            readings[k] = (reading){.grid = grid};
            assert_int_equal(0, pthread_create(&threads[k], NULL, read_apart, &readings[k]));
        }
        for (size_t k = 0; k < READERS; k++)
            assert_int_equal(0, pthread_join(threads[k], NULL));
        read_apart(&expected);
        for (size_t k = 0; k < READERS; k++) {
            assert_true(readings[k].digest == expected.digest);
            assert_int_equal(expected.size, readings[k].size);
            assert_int_equal(expected.frozen, readings[k].frozen);
        }
        snow_destroy(grid);
    }
}

/* A grid may wander from thread to thread, as long as one at a time uses it. */
static void *step_apart(void *context)
{
    return snow_step(context, 5) == SNOW_OK ? context : NULL;
}

static void a_grid_may_change_its_thread(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_life_count; i++) {
        snow_options options = options_of(3);
        snow_grid *plain = start_life(&test_lives[i], false, NULL);
        snow_grid *grid = start_life(&test_lives[i], false, &options);
        for (int round = 0; round < 3; round++) {
            pthread_t thread;
            void *answer = NULL;
            assert_int_equal(0, pthread_create(&thread, NULL, step_apart, grid));
            assert_int_equal(0, pthread_join(thread, &answer));
            assert_ptr_equal(grid, answer);
            assert_ok(snow_step(grid, 2));
            assert_ok(snow_step(plain, 7));
            assert_true(digest_of(plain) == digest_of(grid));
        }
        snow_destroy(grid);
        snow_destroy(plain);
    }
}

/* --- processes --- */

static void a_child_process_goes_on_with_the_same_bits(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_life_count; i++) {
        snow_options options = options_of(4);
        snow_grid *grid = start_life(&test_lives[i], true, &options);
        assert_ok(snow_step(grid, 6));
        int ends[2];
        assert_int_equal(0, pipe(ends));
        pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) {
            uint64_t digest = 0;
            bool told = snow_step(grid, 6) == SNOW_OK && snow_digest(grid, &digest) == SNOW_OK &&
                        write(ends[1], &digest, sizeof digest) == (ssize_t)sizeof digest;
            snow_destroy(grid);
            _exit(told ? 0 : 1);
        }
        assert_ok(snow_step(grid, 6));
        uint64_t digest = 0;
        assert_int_equal(sizeof digest, read(ends[0], &digest, sizeof digest));
        int status = -1;
        assert_int_equal(child, waitpid(child, &status, 0));
        assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
        assert_true(digest == digest_of(grid));
        close(ends[0]);
        close(ends[1]);
        snow_destroy(grid);
    }
}

/* Threads of this process; −1: it cannot be told here. */
static int count_threads(void)
{
    DIR *folder = opendir("/proc/self/task");
    if (folder == NULL)
        return -1;
    int count = 0;
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;)
        count += entry->d_name[0] != '.';
    closedir(folder);
    return count;
}

/* A thread that was joined stays in the list for a moment. */
static int count_threads_soon(int wanted)
{
    int count = count_threads();
    for (int look = 0; look < 5000 && count != wanted; look++) {
        nanosleep(&(struct timespec){0, 1000000}, NULL);
        count = count_threads();
    }
    return count;
}

static void no_thread_is_left_behind(void **state)
{
    (void)state;
    int before = count_threads();
    if (before < 0)
        skip();
    for (size_t i = 0; i < test_life_count; i++) {
        for (int32_t threads = 1; threads <= 64; threads *= 8) {
            snow_options options = options_of(threads);
            snow_grid *grid = start_life(&test_lives[i], false, &options);
            assert_int_equal(before + threads - 1, count_threads());
            assert_ok(snow_step(grid, 5));
            assert_int_equal(before + threads - 1, count_threads());
            snow_destroy(grid);
            assert_int_equal(before, count_threads_soon(before));
        }
        /* Nor by one that could not be made. */
        snow_options options = options_of(8);
        options.memory_limit = 6000;
        snow_grid *grid = NULL;
        snow_status status = test_lives[i].create(true, &options, &grid);
        assert_true(status == SNOW_ERROR_MEMORY_LIMIT);
        assert_int_equal(before, count_threads_soon(before));
    }
}

/* A sanitizer's own memory counts as the program's. */
#ifdef __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED
#endif

#ifndef SANITIZED
/* Room for so many bytes more than the process has. */
static bool limit_memory(unsigned long long more)
{
    unsigned long long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file == NULL)
        return false;
    bool known = fscanf(file, "%llu", &pages) == 1;
    fclose(file);
    struct rlimit limit = {0, 0};
    limit.rlim_cur = limit.rlim_max = (rlim_t)(pages * (unsigned long long)sysconf(_SC_PAGESIZE) + more);
    return known && setrlimit(RLIMIT_AS, &limit) == 0;
}

/* In a child process, for its memory stays limited. */
static int ask_for_too_many_threads(void)
{
    snow_options options;
    snow_options_init(&options, sizeof options);
    options.threads = 1024; /* with a stack of 100 kB or more each */
    if (!limit_memory(50 << 20))
        return 2;
    for (size_t i = 0; i < test_life_count; i++) {
        snow_grid *grid = NULL;
        snow_status status = test_lives[i].create(false, &options, &grid);
        if (status != SNOW_ERROR_THREADS || grid != NULL || count_threads_soon(1) != 1)
            return 1;
    }
    return 0;
}
#endif

static void threads_that_cannot_be_had_are_told(void **state)
{
    (void)state;
#ifdef SANITIZED
    skip();
#else
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0)
        _exit(ask_for_too_many_threads());
    int status = -1;
    assert_int_equal(child, waitpid(child, &status, 0));
    assert_true(WIFEXITED(status));
    if (WEXITSTATUS(status) == 2)
        skip();
    assert_int_equal(0, WEXITSTATUS(status));
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_number_of_threads_gives_the_same_bits),
        cmocka_unit_test(grids_share_nothing),
        cmocka_unit_test(a_grid_may_be_read_by_many_threads),
        cmocka_unit_test(a_grid_may_change_its_thread),
        cmocka_unit_test(a_child_process_goes_on_with_the_same_bits),
        cmocka_unit_test(no_thread_is_left_behind),
        cmocka_unit_test(threads_that_cannot_be_had_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
