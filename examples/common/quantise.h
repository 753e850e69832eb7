/* 256 colours that suit a picture. */
#ifndef EXAMPLES_QUANTISE_H
#define EXAMPLES_QUANTISE_H

#include "common/picture.h"

#include <stdbool.h>

enum { MOST_COLOURS = 256 };

/* Chooses a palette for an RGB picture and names each pixel's colour in it; false when there is no memory. */
bool quantise(const picture *image, colour palette[MOST_COLOURS], unsigned char *indices);

#endif
