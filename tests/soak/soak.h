/*
 * Random scenes that every engine must grow alike. One number, the scene's seed, decides all that happens in it.
 */
#ifndef TESTS_SOAK_SOAK_H
#define TESTS_SOAK_SOAK_H

#include "../support/grids.h"

/* Makes a scene, grows it in all ways, compares; ends the program where they differ. Leaves nothing behind. */
typedef void (*soak_scene)(uint64_t *random);

void soak_reiter(uint64_t *random);
void soak_packard(uint64_t *random);
void soak_aggregate(uint64_t *random);

/* Prints how far apart the engines of aggregation are that follow one law, and fails where that is no chance. */
void soak_judge_law(void);

/* Told what is done, for --verbose. */
extern bool soak_talks;
void say(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* One time in `times`. */
bool one_in(uint64_t *random, uint32_t times);

/* In [least, greatest]. */
int32_t between(uint64_t *random, int32_t least, int32_t greatest);

/* In [0, 1), with 32 bits. */
double fraction(uint64_t *random);

/* Threads, loop and instruction set of any kind; memory from the options given. */
snow_options any_options(uint64_t *random, const snow_options *memory);

/* Any stop conditions that end within so many steps. */
snow_stop any_stop(uint64_t *random, int64_t most_steps, int64_t steps_now);

/* Runs all grids to the same conditions, which must end all alike. */
void run_alike(snow_grid *const *grids, size_t count, const snow_stop *stop);

/* Puts what is loaded from the grid's saved bytes in its place; nothing of it has changed. */
void save_and_load(snow_grid **grid, const snow_options *options);

/* Masses, boxes, density, dimension and a picture are the same. */
void assert_same_measures(const snow_grid *expected, const snow_grid *got, uint64_t *random);

#endif
