#include "common/picture.h"

#include "common/message.h"

#include <stdlib.h>
#include <string.h>

bool palette_shows_age(snow_palette palette)
{
    return palette == SNOW_PALETTE_AGE || palette == SNOW_PALETTE_PHASE;
}

static bool allocate(picture *self, int32_t width, int32_t height, int32_t channels)
{
    *self = (picture){width, height, channels, NULL};
    if (width > 0 && height > 0 && (size_t)height <= SIZE_MAX / 4 / (size_t)width)
        self->pixels = calloc((size_t)width * (size_t)height, (size_t)channels);
    return self->pixels != NULL;
}

bool picture_create(picture *self, int32_t width, int32_t height, int32_t channels)
{
    if (allocate(self, width, height, channels))
        return true;
    complain("no memory for a picture of %d x %d pixels", (int)width, (int)height);
    return false;
}

void picture_destroy(picture *self)
{
    free(self->pixels);
    self->pixels = NULL;
}

unsigned char *picture_at(const picture *self, int32_t x, int32_t y)
{
    return self->pixels + ((size_t)y * (size_t)self->width + (size_t)x) * (size_t)self->channels;
}

void picture_fill(picture *self, colour paint)
{
    for (int32_t y = 0; y < self->height; y++)
        for (int32_t x = 0; x < self->width; x++)
            memcpy(picture_at(self, x, y), (unsigned char[]){paint.red, paint.green, paint.blue, 255},
                   (size_t)self->channels);
}

void picture_paste(picture *self, const picture *other, int32_t x, int32_t y)
{
    for (int32_t row = 0; row < other->height; row++)
        memcpy(picture_at(self, x, y + row), picture_at(other, 0, row),
               (size_t)other->width * (size_t)other->channels);
}

snow_status look_view(const look *self, const snow_grid *grid, snow_view *view)
{
    snow_view_init(view, sizeof *view);
    snow_status status = snow_view_fit(grid, self->size, view);
    view->palette = self->palette;
    view->samples = self->samples;
    view->transparent = self->transparent;
    view->pixel = self->transparent ? SNOW_PIXEL_RGBA : SNOW_PIXEL_RGB;
    return status;
}

snow_status picture_of_grid(picture *self, const snow_grid *grid, const snow_view *view)
{
    size_t size = 0;
    *self = (picture){0};
    snow_status status = snow_render(grid, view, NULL, 0, &size);
    if (status == SNOW_OK && !allocate(self, view->width, view->height, view->pixel == SNOW_PIXEL_RGBA ? 4 : 3))
        status = SNOW_ERROR_NO_MEMORY;
    if (status == SNOW_OK)
        status = snow_render(grid, view, self->pixels, size, &size);
    if (status != SNOW_OK)
        picture_destroy(self);
    return status;
}
