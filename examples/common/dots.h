/* Pictures of particles: rectangles of the plane that cover parts of pixels, painted one over the other as light. */
#ifndef EXAMPLES_DOTS_H
#define EXAMPLES_DOTS_H

#include "common/picture.h"

typedef struct frame {
    double left;
    double bottom;
    double right;
    double top;
} frame;

typedef struct dots {
    int32_t width;
    int32_t height;
    frame view;
    double scale; /* pixels a unit */
    float *light; /* three a pixel */
} dots;

/* A picture of part of the plane with so many pixels on its longer side; complains and returns false when there is no
   memory for it. */
bool dots_create(dots *self, frame view, int32_t size, colour background);
void dots_destroy(dots *self);

/* Paints a rectangle of this width and height about a point. */
void dots_paint(dots *self, double x, double y, double width, double height, colour paint);

/* The picture as pixels. */
bool dots_finish(const dots *self, picture *image);

/* A colour for 0 <= age <= 1: violet, red, orange, yellow, white. */
colour dots_age(double age);

/* A colour with so much of its light. */
colour dots_dimmed(colour paint, double light);

#endif
