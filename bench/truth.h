/* What a scene is in double-double arithmetic, about 31 digits, and how far from that a variant of it goes. */
#ifndef BENCH_TRUTH_H
#define BENCH_TRUTH_H

#include "scenes.h"
#include "variant.h"

#include <stddef.h>
#include <stdint.h>

enum { MOST_MARKS = 16 };

/* Steps at which vapour is compared, ascending. */
typedef struct mark_list {
    int64_t steps[MOST_MARKS + 1];
    size_t count;
} mark_list;

typedef struct truth {
    outcome result;
    mark_list marks; /* those asked for that come before the stop, and the stop */
    size_t size;
    double *inside;
    double *vapour; /* one field for each mark */
    double *freeze_steps;
} truth;

typedef struct distance {
    double max_error[MOST_MARKS + 1];  /* of the vapour of any cell, mark by mark */
    double mean_error[MOST_MARKS + 1]; /* over the interior */
    int64_t first_difference;          /* first step with another ice set; -1: none */
    uint64_t differing_cells;          /* ice in only one of the two at the truth's stop */
} distance;

/* Grows the scene to its end with the quad engine. NULL, or what went wrong; truth_free() in any case. */
const char *truth_find(truth *exact, const snow_scene *scene, const mark_list *marks);
void truth_free(truth *exact);

/* Grows the scene to the truth's stop, watching it. NULL, or what went wrong. */
const char *truth_compare(const truth *exact, const variant *way, const snow_scene *scene, distance *from);

#endif
