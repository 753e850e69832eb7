/*
 * Parallel loops that a caller might hand to the library.
 */
#ifndef TESTS_SUPPORT_LOOPS_H
#define TESTS_SUPPORT_LOOPS_H

#include <snowgrowth/snowgrowth.h>

#include <stddef.h>

typedef struct test_loop {
    const char *name;
    snow_parallel_for run;
} test_loop;

/* In order, in reversed order, and on one thread for each task. */
extern const test_loop test_loops[];
extern const size_t test_loop_count;

#endif
