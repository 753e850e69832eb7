/* The ways of growing a scene that are measured against each other. */
#ifndef BENCH_VARIANT_H
#define BENCH_VARIANT_H

#include "scenes.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct variant {
    const char *name;          /* "rows"; the plain program is "plain" */
    bool plain;                /* plain.h in place of the library */
    snow_reiter_engine engine; /* of the library */
    snow_isa isa;
    int32_t threads;
} variant;

/* One run from the start of the scene to its end. */
typedef struct outcome {
    double seconds; /* of the run alone, without making the grid */
    int64_t steps;
    uint64_t frozen;
    uint64_t cells;
    uint64_t memory; /* bytes */
    uint64_t digest; /* 0 for the plain program */
    snow_stop_reason reason;
} outcome;

/* False when there is no such engine. Instruction set and threads are the automatic one and 1. */
bool variant_find(const char *name, variant *found);

/* Whether the instruction set and the threads make a difference to it. */
bool variant_has_settings(const variant *way);

/* Whether the library promises that it gives the same bits as every other such variant. */
bool variant_is_exact(const variant *way);

bool variant_can_grow(const variant *way, const snow_scene *scene);

/* NULL, or what went wrong. */
const char *variant_run(const variant *way, const snow_scene *scene, outcome *result);

#endif
