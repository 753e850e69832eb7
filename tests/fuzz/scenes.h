/*
 * Scenes out of any bytes, for every model. Pointers are NULL or lead to something real, and sizes are mostly small;
 * everything else is what the input says.
 */
#ifndef TESTS_FUZZ_SCENES_H
#define TESTS_FUZZ_SCENES_H

#include "fuzz.h"

/* How many models there are to choose from. */
size_t fuzz_models(void);

/* Creates a grid of one of the models, or refuses. */
snow_status fuzz_create(size_t model, fuzz_input *input, const snow_options *options, snow_grid **grid);

/* The model's own calls that change a grid; called on grids of other models too, which must refuse. */
void fuzz_change(fuzz_input *input, snow_grid *grid);

/* The model's own questions, likewise. */
void fuzz_ask(fuzz_input *input, const snow_grid *grid);

#endif
