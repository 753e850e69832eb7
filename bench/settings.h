/* Choosing variants on a command line, and naming them in reports: what the two programs have in common. */
#ifndef BENCH_SETTINGS_H
#define BENCH_SETTINGS_H

#include "variant.h"

#include <stddef.h>
#include <stdio.h>

enum { MOST_VARIANTS = 512, MOST_THREADS = 1024 };

typedef struct variant_list {
    variant ways[MOST_VARIANTS];
    size_t count;
} variant_list;

/* Words with commas between them, as the options have them. */
typedef struct setting_lists {
    const char *engines;    /* plain, auto, rows, reference, quad */
    const char *precisions; /* double, single */
    const char *symmetries; /* auto, none */
    const char *tolerances; /* numbers from 0 to 1 */
    const char *isas;       /* auto, baseline, avx2, avx512, or all that run here */
    const char *threads;    /* whole numbers, 0: one per processor */
} setting_lists;

/* The options that fill all of them but the threads, as getopt_long takes them, and their help. A program's own
   options are numbered from SETTINGS on. */
enum { SETTING_ENGINE, SETTING_PRECISION, SETTING_SYMMETRY, SETTING_TOLERANCE, SETTING_ISA, SETTINGS };
#define SETTING_OPTIONS \
    {"engine", required_argument, NULL, SETTING_ENGINE}, \
    {"precision", required_argument, NULL, SETTING_PRECISION}, \
    {"symmetry", required_argument, NULL, SETTING_SYMMETRY}, \
    {"tolerance", required_argument, NULL, SETTING_TOLERANCE}, \
    {"isa", required_argument, NULL, SETTING_ISA}
extern const char settings_help[];

/* Takes the text of such an option; false: it is another one. */
bool settings_take(setting_lists *words, int option, const char *text);

/* Adds each engine in each combination of the settings that it knows. A wrong word ends the program with status 2. */
void settings_add(variant_list *list, const setting_lists *words);

/* One line of a report: the settings as columns, "-" where the engine does not know one. */
extern const char settings_heading[];
void settings_print(FILE *report, const variant *way);

/* The same as fields of a CSV line, each with a comma behind it: engine,precision,symmetry,tolerance,isa,threads, */
void settings_write(FILE *csv, const variant *way);

#endif
