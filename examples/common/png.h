/* Pictures as PNG files, through libpng. */
#ifndef EXAMPLES_PNG_H
#define EXAMPLES_PNG_H

#include "common/output.h"
#include "common/picture.h"

/* Writes a picture and commits the output; false, after a complaint, when that fails: then nothing is left. */
bool png_write(output *self, const picture *image);

#endif
