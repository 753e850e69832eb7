#include "common/quantise.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/*
 * The colours of the picture are put into boxes: at first all into one; then
 * the box whose colours vary most is cut at its mean, across the channel in
 * which they vary most, until there are as many boxes as the palette has places.
 */
typedef struct shade {
    uint32_t key; /* 0xRRGGBB */
    uint32_t pixels;
    unsigned char channels[3];
    unsigned char box;
} shade;

typedef struct box {
    shade *shades;
    size_t count;
    int channel;    /* in which its colours vary most, */
    double varying; /* how much, */
    double mean;    /* and round what */
} box;

static uint32_t key_at(const picture *image, size_t pixel)
{
    const unsigned char *channels = image->pixels + 3 * pixel;
    return (uint32_t)channels[0] << 16 | (uint32_t)channels[1] << 8 | channels[2];
}

static int by_key(const void *left, const void *right)
{
    uint32_t a = ((const shade *)left)->key;
    uint32_t b = ((const shade *)right)->key;
    return (a > b) - (a < b);
}

static shade shade_of(uint32_t key, uint32_t pixels)
{
    return (shade){key, pixels, {(unsigned char)(key >> 16), (unsigned char)(key >> 8), (unsigned char)key}, 0};
}

/* The different colours in the order of their keys, each once. */
static size_t collect(const picture *image, size_t pixels, shade *shades)
{
    size_t runs = 0;
    size_t count = 0;
    for (size_t i = 0; i < pixels; i++) {
        uint32_t key = key_at(image, i);
        if (runs > 0 && shades[runs - 1].key == key)
            shades[runs - 1].pixels++;
        else
            shades[runs++] = shade_of(key, 1);
    }
    qsort(shades, runs, sizeof *shades, by_key);
    for (size_t i = 0; i < runs; i++) {
        if (count > 0 && shades[count - 1].key == shades[i].key)
            shades[count - 1].pixels += shades[i].pixels;
        else
            shades[count++] = shades[i];
    }
    return count;
}

static double mean_of(const box *self, int channel)
{
    double sum = 0;
    double pixels = 0;
    for (size_t i = 0; i < self->count; i++) {
        sum += (double)self->shades[i].pixels * self->shades[i].channels[channel];
        pixels += self->shades[i].pixels;
    }
    return sum / pixels;
}

static colour mean_colour(const box *self)
{
    return (colour){(unsigned char)lround(mean_of(self, 0)), (unsigned char)lround(mean_of(self, 1)),
                    (unsigned char)lround(mean_of(self, 2))};
}

static box make_box(shade *shades, size_t count)
{
    box made = {shades, count, 0, 0, 0};
    for (int channel = 0; channel < 3; channel++) {
        double mean = mean_of(&made, channel);
        double varying = 0;
        for (size_t i = 0; i < count; i++)
            varying += shades[i].pixels * pow(shades[i].channels[channel] - mean, 2);
        if (varying > made.varying) {
            made.channel = channel;
            made.varying = varying;
            made.mean = mean;
        }
    }
    return made;
}

/* Keeps the shades below the mean and gives the others to a new box. */
static box cut(box *self)
{
    size_t below = 0;
    for (size_t i = 0; i < self->count; i++) {
        if (self->shades[i].channels[self->channel] <= self->mean) {
            shade lower = self->shades[i];
            self->shades[i] = self->shades[below];
            self->shades[below++] = lower;
        }
    }
    box above = make_box(self->shades + below, self->count - below);
    *self = make_box(self->shades, below);
    return above;
}

static box *most_varying(box *boxes, size_t count)
{
    box *most = boxes;
    for (size_t i = 1; i < count; i++)
        if (boxes[i].varying > most->varying)
            most = &boxes[i];
    return most;
}

static void choose(shade *shades, size_t count, colour palette[MOST_COLOURS])
{
    box boxes[MOST_COLOURS];
    size_t made = 1;
    boxes[0] = make_box(shades, count);
    for (box *next; made < MOST_COLOURS && (next = most_varying(boxes, made))->varying > 0; made++)
        boxes[made] = cut(next);
    for (size_t i = 0; i < made; i++) {
        palette[i] = mean_colour(&boxes[i]);
        for (size_t j = 0; j < boxes[i].count; j++)
            boxes[i].shades[j].box = (unsigned char)i;
    }
}

bool quantise(const picture *image, colour palette[MOST_COLOURS], unsigned char *indices)
{
    size_t pixels = (size_t)image->width * (size_t)image->height;
    shade *shades = calloc(pixels, sizeof *shades);
    if (shades == NULL)
        return false;
    size_t count = collect(image, pixels, shades);
    choose(shades, count, palette);
    qsort(shades, count, sizeof *shades, by_key);
    const shade *found = shades;
    for (size_t i = 0; i < pixels; i++) {
        shade wanted = {.key = key_at(image, i)};
        if (found->key != wanted.key)
            found = bsearch(&wanted, shades, count, sizeof *shades, by_key);
        indices[i] = found->box;
    }
    free(shades);
    return true;
}
