/* Colours: from the value of a cell to light, and from light to bytes. */
#ifndef SNOW_RENDER_PALETTE_H
#define SNOW_RENDER_PALETTE_H

#include <snowgrowth/grid.h>
#include <snowgrowth/render.h>

#include <stdint.h>

/*
 * Steps of each of the two ramps, vapour and ice. A multiple of 255: then no
 * step holds values that the paper's mapping sends to two different greys.
 */
enum { SNOW_SHADES = 510 };

/* Linear light, so that samples can be averaged: 65,535 is full. */
typedef struct snow_light {
    uint16_t red;
    uint16_t green;
    uint16_t blue;
} snow_light;

/* A palette made ready for one picture of one grid. */
typedef struct snow_paint {
    double ice_from; /* A number from here on is ice. */
    double first;    /* The number at the beginning of the ice ramp. */
    double range;    /* From there to its end; 0 where all ice looks like the first. */
    double period;   /* Numbers of ice that differ by it look alike; 0: none do. */
    snow_light shade[2 * SNOW_SHADES]; /* The vapour's ramp, then that of the ice. */
    uint32_t byte_from[257];           /* The least light that is shown as each byte, and what none reaches. */
    uint8_t byte_at[4096];             /* The byte of each sixteenth light; no two bytes begin within sixteen. */
} snow_paint;

/* The field that a palette shows. */
snow_field snow_palette_field(snow_palette palette);

/* Makes a palette ready; greatest is the greatest number of the field on ice. */
void snow_paint_mix(snow_paint *paint, snow_palette palette, double greatest);

/* The index into paint->shade of a number of the field; SNOW_SHADES or more for ice. */
uint16_t snow_paint_shade(const snow_paint *paint, double number);

/* The sRGB byte nearest to an amount of light. */
uint8_t snow_paint_byte(const snow_paint *paint, uint32_t light);

#endif
