/* What the programs that grow one crystal do with it beside growing it. */
#ifndef EXAMPLES_CRYSTAL_H
#define EXAMPLES_CRYSTAL_H

#include "common/output.h"
#include "common/picture.h"

/* A snow_reader and a snow_writer, of a FILE. */
int file_read(void *file, void *bytes, size_t size, size_t *got);
int file_write(void *file, const void *bytes, size_t size);

/* Opens the file that an option names; NULL, after a complaint, when that fails. */
FILE *file_open(const char *option, const char *name);

/* Writes a picture, if one is wanted; returns the exit code. */
int crystal_draw(const snow_grid *grid, const look *appearance, output *file);

#endif
