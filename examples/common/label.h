/*
 * Words in pictures, drawn with a pen: letters, digits, some punctuation and
 * the Greek letters of the model, in UTF-8. A stroke font is clean at any size.
 */
#ifndef EXAMPLES_LABEL_H
#define EXAMPLES_LABEL_H

#include "common/picture.h"

/* How wide a text is whose capitals are so many pixels high. */
double label_width(const char *text, double height);

/* Draws a text; (x, y) is the left end of its base line. */
void label_draw(picture *self, const char *text, double height, double x, double y, colour paint);

#endif
