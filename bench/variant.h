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
    snow_reiter_precision precision;
    snow_reiter_symmetry symmetry;
    double tolerance;
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

/* False when there is no such engine. It has double precision, one thread, and else the library's defaults. */
bool variant_find(const char *name, variant *found);

/* Whether it can be had in single precision. */
bool variant_has_precisions(const variant *way);

/* Whether symmetry, tolerance, instruction set and threads make a difference to it. */
bool variant_has_settings(const variant *way);

/* Whether the library promises that two variants grow every scene with the same bits. */
bool variant_same_bits(const variant *a, const variant *b);

bool variant_can_grow(const variant *way, const snow_scene *scene);

/* A new grid at the start of the scene. The plain program reads its start from it. */
snow_status variant_make_grid(const variant *way, const snow_scene *scene, bool freeze_steps, snow_grid **grid);

/* NULL, or what went wrong. */
const char *variant_run(const variant *way, const snow_scene *scene, outcome *result);

#endif
