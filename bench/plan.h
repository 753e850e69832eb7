/* What snowgrowth-bench is asked to measure. */
#ifndef BENCH_PLAN_H
#define BENCH_PLAN_H

#include "scenes.h"
#include "settings.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { MOST_SCENES = 64, MOST_ROUNDS = 1000 };

typedef struct plan {
    snow_scene scenes[MOST_SCENES];
    size_t scene_count;
    variant_list variants;
    size_t rounds;
    double least_seconds; /* of one measurement */
    int64_t steps;        /* 0: those of the scene */
    bool copies;          /* measure the copy bandwidth */
    const char *csv_path; /* NULL: none */
    const char *date;     /* NULL: none */
} plan;

/* Reads the command line. --list and --help end the program, and so does a wrong argument, with exit status 2. */
void plan_read(plan *work, int count, char **arguments);

#endif
