/* The library's own threads: each task runs exactly once, and what it wrote is seen after the loop. */
#define _POSIX_C_SOURCE 200809L
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/heap.h"
#include "base/parallel.h"

#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static snow_heap plain_heap(void)
{
    snow_options options;
    snow_options_init(&options, sizeof options);
    snow_heap heap;
    snow_heap_start(&heap, &options);
    return heap;
}

enum { MOST_TASKS = 300 };

typedef struct tally {
    int runs[MOST_TASKS];
} tally;

static void count_run(void *argument, size_t index)
{
    tally *all = argument;
    all->runs[index]++;
}

static void each_task_runs_once(void **state)
{
    (void)state;
    for (int threads = 1; threads <= 9; threads++) {
        snow_heap heap = plain_heap();
        snow_team *team = NULL;
        assert_int_equal(SNOW_OK, snow_team_start(&team, &heap, threads));
        for (size_t count = 0; count <= MOST_TASKS; count += count < 20 ? 1 : 35) {
            tally all = {{0}};
            snow_team_for(team, count, count_run, &all);
            for (size_t i = 0; i < MOST_TASKS; i++)
                assert_int_equal(i < count, all.runs[i]);
        }
        snow_team_end(team, &heap);
        assert_int_equal(0, heap.used);
    }
}

/* Thousands of short loops one after another, now and then with a rest in which helpers go to sleep. */
static void loops_follow_one_another(void **state)
{
    (void)state;
    snow_heap heap = plain_heap();
    snow_team *team = NULL;
    assert_int_equal(SNOW_OK, snow_team_start(&team, &heap, 4));
    tally all = {{0}};
    enum { LOOPS = 3000 };
    for (int loop = 0; loop < LOOPS; loop++) {
        snow_team_for(team, 4, count_run, &all);
        if (loop % 500 == 250)
            nanosleep(&(struct timespec){0, 2000000}, NULL);
    }
    for (size_t i = 0; i < 4; i++)
        assert_int_equal(LOOPS, all.runs[i]);
    snow_team_end(team, &heap);
}

typedef struct relay {
    int cells[2][64];
    int turn;
} relay;

/* Each task reads what its neighbours wrote in the loop before. */
static void pass_on(void *argument, size_t index)
{
    relay *all = argument;
    const int *from = all->cells[all->turn % 2];
    all->cells[1 - all->turn % 2][index] = from[index] + from[(index + 1) % 64] % 2 + 1;
}

static void a_loop_sees_what_the_last_one_wrote(void **state)
{
    (void)state;
    snow_heap heap = plain_heap();
    snow_team *team = NULL;
    assert_int_equal(SNOW_OK, snow_team_start(&team, &heap, 5));
    relay alone = {.turn = 0}, together = {.turn = 0};
    for (; alone.turn < 500; alone.turn++, together.turn++) {
        for (size_t i = 0; i < 64; i++)
            pass_on(&alone, i);
        snow_team_for(team, 64, pass_on, &together);
        assert_memory_equal(&alone, &together, sizeof alone);
    }
    snow_team_end(team, &heap);
}

static void teams_do_not_disturb_each_other(void **state)
{
    (void)state;
    snow_heap heap = plain_heap();
    snow_team *teams[4];
    tally all[4] = {{{0}}};
    for (int i = 0; i < 4; i++)
        assert_int_equal(SNOW_OK, snow_team_start(&teams[i], &heap, i + 1));
    for (int loop = 0; loop < 200; loop++)
        for (int i = 0; i < 4; i++)
            snow_team_for(teams[i], 7, count_run, &all[i]);
    for (int i = 0; i < 4; i++) {
        for (size_t k = 0; k < 7; k++)
            assert_int_equal(200, all[i].runs[k]);
        snow_team_end(teams[i], &heap);
    }
    assert_int_equal(0, heap.used);
}

static void a_team_may_end_unused(void **state)
{
    (void)state;
    snow_heap heap = plain_heap();
    for (int threads = 1; threads <= 16; threads++) {
        snow_team *team = NULL;
        assert_int_equal(SNOW_OK, snow_team_start(&team, &heap, threads));
        snow_team_end(team, &heap);
    }
    snow_team_end(NULL, &heap);
    assert_int_equal(0, heap.used);
}

static void a_child_process_works_alone(void **state)
{
    (void)state;
    snow_heap heap = plain_heap();
    snow_team *team = NULL;
    assert_int_equal(SNOW_OK, snow_team_start(&team, &heap, 4));
    tally all = {{0}};
    snow_team_for(team, 4, count_run, &all);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        snow_team_for(team, 9, count_run, &all);
        int runs = 0;
        for (size_t i = 0; i < 9; i++)
            runs += all.runs[i];
        snow_team_end(team, &heap);
        _exit(runs == 13 && heap.used == 0 ? 0 : 1);
    }
    int status = -1;
    assert_int_equal(child, waitpid(child, &status, 0));
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    snow_team_for(team, 4, count_run, &all);
    for (size_t i = 0; i < 4; i++)
        assert_int_equal(2, all.runs[i]);
    snow_team_end(team, &heap);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_task_runs_once),
        cmocka_unit_test(loops_follow_one_another),
        cmocka_unit_test(a_loop_sees_what_the_last_one_wrote),
        cmocka_unit_test(teams_do_not_disturb_each_other),
        cmocka_unit_test(a_team_may_end_unused),
        cmocka_unit_test(a_child_process_works_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
