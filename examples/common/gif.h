/* Animated GIF files, through giflib. */
#ifndef EXAMPLES_GIF_H
#define EXAMPLES_GIF_H

#include "common/output.h"
#include "common/picture.h"

#include <stdbool.h>

struct GifFileType;

typedef struct gif {
    output *target;
    struct GifFileType *file; /* NULL until the first frame */
} gif;

/* Adds an RGB picture, to be seen for so many hundredths of a second. Complains and returns false on failure. */
bool gif_add(gif *self, const picture *frame, int32_t delay);

/* Ends the animation; the output is then to be committed. Complains and returns false on failure. */
bool gif_end(gif *self);

/* Gives up; fine after gif_end(). */
void gif_discard(gif *self);

#endif
