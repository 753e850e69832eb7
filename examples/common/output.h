/*
 * A file that appears under its name only when it is complete: it is written
 * beside its place under another name, flushed to the disk, then renamed.
 */
#ifndef EXAMPLES_OUTPUT_H
#define EXAMPLES_OUTPUT_H

#include <stdbool.h>
#include <stdio.h>

typedef struct output {
    const char *name; /* as the user calls it; NULL: there is no such output */
    FILE *file;
    char *final;     /* where it will be; NULL: written in place (a device, a pipe) */
    char *temporary; /* where it is until then */
} output;

/* Each complains and returns false when it fails; then nothing is left. A NULL name opens nothing, with success. */
bool output_open(output *self, const char *name);
bool output_commit(output *self);

/* Both files, or none. */
bool output_open_both(output *first, const char *first_name, output *second, const char *second_name);

/* Gives up: nothing is left. Fine for an output that was committed or never opened. */
void output_discard(output *self);

/* Complains that writing failed, for the reason in errno. */
void output_complain(const output *self);

#endif
