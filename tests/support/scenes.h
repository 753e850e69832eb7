/*
 * Named scenes that the tests and the benchmarks share, each with the result
 * that it must give.
 */
#ifndef TESTS_SUPPORT_SCENES_H
#define TESTS_SUPPORT_SCENES_H

#include <snowgrowth/snowgrowth.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* One scene: snow_reiter_create(&params), snow_run(&stop), then compare. */
typedef struct snow_scene {
    const char *name;
    const char *what;
    snow_reiter_params params; /* engine is SNOW_REITER_ENGINE_AUTO; the caller may choose another */
    snow_stop stop;            /* no progress callback */
    int64_t steps;             /* step count at the end */
    uint64_t frozen;           /* ice cells at the end */
    uint64_t digest;           /* snow_digest() at the end; 0: not recorded */
    bool slow;                 /* too long for every test run */
} snow_scene;

size_t scene_count(void);

/* False, and *scene untouched, when the index is too great. */
bool scene_get(size_t index, snow_scene *scene);

/* False, and *scene untouched, when no scene has this name. */
bool scene_find(const char *name, snow_scene *scene);

#endif
