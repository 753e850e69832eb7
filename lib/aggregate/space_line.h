/* The distances of 8 x 8 x 8 sites to the nearest special one, up to 5, in 128
   bytes: a "line" of the map of space.

   Two neighbours differ by at most 1. So 16 bits tell the distances of 2 x 2 x 2
   sites, a pair in each direction: the least of them, and one bit each. */
#ifndef SNOW_AGGREGATE_SPACE_LINE_H
#define SNOW_AGGREGATE_SPACE_LINE_H

#include "aggregate/matter.h"

#include <snowgrowth/options.h>

enum {
    SNOW_SPACE_SITES = 5,                                    /* the greatest distance that lines tell apart */
    SNOW_SPACE_LINES = 3,                                    /* lines in a row that a filled site may change */
    SNOW_SPACE_PAIRS = 2 * ((SNOW_SPACE_SITES + 2) / 2) + 1, /* rows of pairs that it may change, side by side */
    SNOW_SPACE_ROWS = SNOW_SPACE_PAIRS + 6,                  /* with those of whole lines */
    SNOW_SPACE_PRINTS = 32
};

/* Of a pair of sites in each direction: the least distance times 256, and a bit
   for each site that is one further away. */
typedef union snow_space_line {
    _Atomic uint16_t pair[64];
    _Atomic uintptr_t word[128 / sizeof(uintptr_t)]; /* several at a time */
} snow_space_line;

/* What a filled site does to the pairs round it, in rows of a line each. */
typedef struct snow_space_print {
    int16_t pair[SNOW_SPACE_LINES][SNOW_SPACE_PAIRS][SNOW_SPACE_ROWS][4];
} snow_space_print;

/* The site of a pair, the line of a page: x lowest. */
static inline uint32_t snow_space_octant(uint32_t x, uint32_t y, uint32_t z)
{
    return (z & 1) << 2 | (y & 1) << 1 | (x & 1);
}

/* The pair of a line, the site of a block, the block of a page. */
static inline uint32_t snow_space_place(uint32_t x, uint32_t y, uint32_t z)
{
    return (z & 3) << 4 | (y & 3) << 2 | (x & 3);
}

/* The distance of a site of the line. */
static inline uint32_t snow_space_line_look(const snow_space_line *line, uint32_t u, uint32_t v, uint32_t w)
{
    uint32_t pair = SNOW_MAP_GET(line->pair[snow_space_place(u / 2, v / 2, w / 2)]);
    return (pair >> 8) + (pair >> snow_space_octant(u, v, w) & 1);
}

/* Nothing is near. */
void snow_space_line_start(snow_space_line *line);

/* The prints of sites, by their place in a row of a line and by parity in y and z: see snow_space_print_of(). */
void snow_space_prints_make(snow_space_print print[SNOW_SPACE_PRINTS]);

static inline const snow_space_print *snow_space_print_of(const snow_space_print *prints, uint32_t u, uint32_t v,
                                                          uint32_t w)
{
    return &prints[(w & 1) << 4 | (v & 1) << 3 | (u & 7)];
}

/* The line learns of a filled site. It lies so many lines after the site's in a row
   (-1, 0 or 1), its first pair so many rows and layers after the site's. True: it
   says something else now. */
typedef bool (*snow_space_lower)(snow_space_line *line, const snow_space_print *print, int lines, int rows,
                                 int layers);

/* All do the same. */
bool snow_space_line_lower_baseline(snow_space_line *line, const snow_space_print *print, int lines, int rows,
                                    int layers);
bool snow_space_line_lower_avx2(snow_space_line *line, const snow_space_print *print, int lines, int rows, int layers);
snow_space_lower snow_space_line_choose(snow_isa isa);

#endif
