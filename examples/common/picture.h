/* Pixels in memory: 3 (RGB) or 4 (RGBA) bytes each, row after row. */
#ifndef EXAMPLES_PICTURE_H
#define EXAMPLES_PICTURE_H

#include <snowgrowth/snowgrowth.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct colour {
    unsigned char red;
    unsigned char green;
    unsigned char blue;
} colour;

typedef struct picture {
    int32_t width;
    int32_t height;
    int32_t channels;
    unsigned char *pixels;
} picture;

/* How a grid is drawn. */
typedef struct look {
    snow_palette palette;
    int32_t size; /* pixels on the longer side; 0: one a cell */
    int32_t samples;
    int32_t transparent;
} look;

/* Whether a palette shows when cells froze, so that the grid must record it. */
bool palette_shows_age(snow_palette palette);

/* False, after a complaint, when there is no memory for it. The pixels are zero. */
bool picture_create(picture *self, int32_t width, int32_t height, int32_t channels);
void picture_destroy(picture *self);

/* The pixel in column x of row y, which must exist. */
unsigned char *picture_at(const picture *self, int32_t x, int32_t y);

void picture_fill(picture *self, colour paint);

/* Copies a picture that has as many channels and fits. */
void picture_paste(picture *self, const picture *other, int32_t x, int32_t y);

/* The view of a grid that a look asks for, RGB or, when transparent, RGBA. */
snow_status look_view(const look *self, const snow_grid *grid, snow_view *view);

/* Draws a grid as a view says into a new picture; SNOW_ERROR_NO_MEMORY when there is none for it. */
snow_status picture_of_grid(picture *self, const snow_grid *grid, const snow_view *view);

#endif
