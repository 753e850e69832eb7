/*
 * The models side by side: scenes of each engine, and every public call that takes a grid, for tests of what holds for
 * all of them. A new model adds its scenes to test_lives, a new call a line to test_acts.
 */
#ifndef TESTS_SUPPORT_LIVES_H
#define TESTS_SUPPORT_LIVES_H

#include "check.h"

#include <snowgrowth/snowgrowth.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A scene: small, or so large that its steps are worth several threads. */
typedef struct test_life {
    const char *name;
    snow_status (*create)(bool large, const snow_options *options, snow_grid **grid);
} test_life;

extern const test_life test_lives[];
extern const size_t test_life_count;

snow_grid *start_life(const test_life *life, bool large, const snow_options *options);

/* What a call wrote for its caller: the bytes of all results, one after the other. */
enum { ANSWER_SIZE = 1 << 16 };
typedef struct test_answer {
    unsigned char bytes[ANSWER_SIZE];
} test_answer;

/* A public call. One that the grid's model does not have answers SNOW_ERROR_UNSUPPORTED. */
typedef struct test_act {
    const char *name;
    snow_status (*call)(snow_grid *grid, test_answer *answer);
    bool steps; /* it may fail between two of its steps */
} test_act;

extern const test_act test_acts[];
extern const size_t test_act_count;

/* The saved grid, which holds all that its future depends on. */
typedef struct saved_life {
    unsigned char *bytes;
    size_t size;
    size_t next; /* for readers */
} saved_life;

saved_life save_life(const snow_grid *grid);
void assert_same_lives(const saved_life *expected, const saved_life *got, const char *name);
void free_life(saved_life *saved);

#endif
