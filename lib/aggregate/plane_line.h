/* The distances of 16 x 16 sites to the nearest special one, up to 3, in 64
   bytes: a "line" of the map of the plane. */
#ifndef SNOW_AGGREGATE_PLANE_LINE_H
#define SNOW_AGGREGATE_PLANE_LINE_H

#include "aggregate/matter.h"

#include <snowgrowth/aggregate.h>

/* Three less the distance of each site, two bits each. */
typedef union snow_plane_line {
    _Alignas(64) _Atomic uint32_t row[16];
    _Atomic uint64_t two_rows[8];
} snow_plane_line;

enum {
    SNOW_PLANE_LINES = 3, /* side by side, that a filled site may change */
    SNOW_PLANE_PRINT = 8  /* rows that it may change, from an even one on */
};

/* What a filled site does to so many rows of a line. */
typedef union snow_plane_print {
    uint32_t row[SNOW_PLANE_PRINT];
    uint64_t two_rows[SNOW_PLANE_PRINT / 2];
} snow_plane_print;

/* For sites in even and in odd rows, at each place of a row: to the lines left of them, round them, right of them. */
typedef struct snow_plane_prints {
    snow_plane_print of[2][16][SNOW_PLANE_LINES];
} snow_plane_prints;

/* 0, 1, 2, or 3, where the special sites are not nearer than that. */
static inline uint32_t snow_plane_line_look(const snow_plane_line *line, uint32_t u, uint32_t v)
{
    return ~SNOW_MAP_GET(line->row[v % 16]) >> (u % 16 * 2) & 3;
}

/* Whether one of the 2 x 2 sites round a site is special; they begin at even u and v. */
static inline bool snow_plane_line_holds_special(const snow_plane_line *line, uint32_t u, uint32_t v)
{
    uint32_t even = SNOW_MAP_GET(line->row[v % 16 / 2 * 2]);
    uint32_t odd = SNOW_MAP_GET(line->row[v % 16 / 2 * 2 + 1]);
    uint32_t special = (even & even >> 1) | (odd & odd >> 1);
    return (special >> u % 16 / 2 * 4 & 5) != 0;
}

void snow_plane_prints_make(snow_plane_prints *prints, snow_aggregate_lattice lattice);

/* The first row that a filled site in row v may change. */
int64_t snow_plane_print_first(int64_t v);

/* Which lines beside its own a filled site may change. */
static inline bool snow_plane_print_reaches(uint32_t u, int line)
{
    return line == 1 || (line == 0 ? u % 16 < 3 : u % 16 >= 13);
}

/* Lays pairs of rows of a print over those of a line, from row v on. True: distances change. */
bool snow_plane_line_lower(snow_plane_line *line, uint32_t v, uint32_t pairs, const uint64_t *print);

#endif
