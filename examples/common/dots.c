#include "common/dots.h"

#include "common/message.h"

#include <math.h>
#include <stdlib.h>

static float light_of(unsigned char byte)
{
    double value = byte / 255.0;
    return (float)(value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4));
}

static unsigned char byte_of(double light)
{
    double value = light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055;
    return (unsigned char)lround(255 * fmin(fmax(value, 0), 1));
}

static int32_t pixels_of(double extent, double scale)
{
    return (int32_t)fmax(ceil(extent * scale - 1e-9), 1);
}

bool dots_create(dots *self, frame view, int32_t size, colour background)
{
    double longer = fmax(view.right - view.left, view.top - view.bottom);
    *self = (dots){.view = view, .scale = size / longer};
    self->width = pixels_of(view.right - view.left, self->scale);
    self->height = pixels_of(view.top - view.bottom, self->scale);
    size_t pixels = (size_t)self->width * (size_t)self->height;
    self->light = malloc(pixels * 3 * sizeof *self->light);
    if (self->light == NULL) {
        complain("no memory for a picture of %d x %d pixels", (int)self->width, (int)self->height);
        return false;
    }
    for (size_t i = 0; i < pixels; i++) {
        self->light[3 * i] = light_of(background.red);
        self->light[3 * i + 1] = light_of(background.green);
        self->light[3 * i + 2] = light_of(background.blue);
    }
    return true;
}

void dots_destroy(dots *self)
{
    free(self->light);
    self->light = NULL;
}

static int32_t clip(double number, int32_t limit)
{
    return (int32_t)fmin(fmax(number, 0), limit);
}

/* Where a pixel is smaller than half a cell, cells end between pixels, so that neighbours leave no seam. */
static double snapped(const dots *self, double edge)
{
    return self->scale >= 2 ? floor(edge + 0.5) : edge;
}

/* How much of the pixel from `at` on lies between two bounds. */
static double cover(int32_t at, double low, double high)
{
    return fmax(fmin(high, at + 1) - fmax(low, at), 0);
}

void dots_paint(dots *self, double x, double y, double width, double height, colour paint)
{
    const float light[3] = {light_of(paint.red), light_of(paint.green), light_of(paint.blue)};
    double left = snapped(self, (x - width / 2 - self->view.left) * self->scale);
    double right = snapped(self, (x + width / 2 - self->view.left) * self->scale);
    double top = snapped(self, (self->view.top - y - height / 2) * self->scale);
    double bottom = snapped(self, (self->view.top - y + height / 2) * self->scale);
    for (int32_t row = clip(floor(top), self->height); row < clip(ceil(bottom), self->height); row++) {
        for (int32_t column = clip(floor(left), self->width); column < clip(ceil(right), self->width); column++) {
            float *pixel = &self->light[3 * ((size_t)row * (size_t)self->width + (size_t)column)];
            float part = (float)(cover(row, top, bottom) * cover(column, left, right));
            for (int i = 0; i < 3; i++)
                pixel[i] += part * (light[i] - pixel[i]);
        }
    }
}

bool dots_finish(const dots *self, picture *image)
{
    if (!picture_create(image, self->width, self->height, 3))
        return false;
    size_t bytes = (size_t)self->width * (size_t)self->height * 3;
    for (size_t i = 0; i < bytes; i++)
        image->pixels[i] = byte_of(self->light[i]);
    return true;
}

static double between(double from, double to, double part)
{
    return from + part * (to - from);
}

colour dots_age(double age)
{
    static const colour ramp[] = {{72, 52, 212},  {150, 50, 200}, {222, 50, 110},
                                  {250, 110, 50}, {255, 190, 60}, {255, 250, 205}};
    enum { LAST = sizeof ramp / sizeof ramp[0] - 1 };
    double place = fmin(fmax(age, 0), 1) * LAST;
    int i = place < LAST ? (int)place : LAST - 1;
    double part = place - i;
    return (colour){(unsigned char)lround(between(ramp[i].red, ramp[i + 1].red, part)),
                    (unsigned char)lround(between(ramp[i].green, ramp[i + 1].green, part)),
                    (unsigned char)lround(between(ramp[i].blue, ramp[i + 1].blue, part))};
}

colour dots_dimmed(colour paint, double light)
{
    return (colour){byte_of(light * light_of(paint.red)), byte_of(light * light_of(paint.green)),
                    byte_of(light * light_of(paint.blue))};
}
