/* Grids that are kept in files, to go on with. */
#ifndef EXAMPLES_KEPT_H
#define EXAMPLES_KEPT_H

#include "common/output.h"

#include <snowgrowth/snowgrowth.h>

/* Returns EXIT_DONE; or complains, and returns what the program is to end with. */
int kept_load(const char *name, const snow_options *options, snow_grid **grid);

/* Saves into an output and commits it; one without a name is left alone. Complains when it returns false. */
bool kept_save(const snow_grid *grid, output *file);

#endif
