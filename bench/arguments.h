/* What the programs' command lines have in common. A wrong argument ends the program: one line, exit 2. */
#ifndef BENCH_ARGUMENTS_H
#define BENCH_ARGUMENTS_H

#include "scenes.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Each program defines its name, for its messages. */
extern const char *const program_name;

/* Prints one line and exits with 2. */
_Noreturn void arguments_fail(const char *format, ...) __attribute__((format(printf, 1, 2)));

int64_t arguments_integer(const char *option, const char *text, int64_t least, int64_t greatest);
double arguments_number(const char *option, const char *text, double least, double greatest);

/* Copies the next word of a list "a,b,c" and moves the list past it; false at the end. */
bool arguments_next_word(const char **list, char *word, size_t size);

snow_scene arguments_scene(const char *name);

/* The scenes on standard output, one a line. */
void arguments_list_scenes(void);

#endif
