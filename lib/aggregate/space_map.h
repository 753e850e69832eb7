/* What a walker in space asks before each jump: plane_map.h on the cubic
   lattice. Lines are 8 x 8 x 8 sites, blocks 4 x 4 x 4 of them, tiles and pages
   16 x 16 x 16. Near the cluster the lines tell each site's own distance
   (space_line.h); further away that of its block, up to 8 blocks, or of its
   tile, up to 7 tiles: there is no larger table of exits.

   Pages and lines have numbers of 32 bits, not addresses: that is half the size,
   and what vectors look up for eight walkers at once. */
#ifndef SNOW_AGGREGATE_SPACE_MAP_H
#define SNOW_AGGREGATE_SPACE_MAP_H

#include "aggregate/exits.h"
#include "aggregate/matter.h"
#include "aggregate/space_line.h"

#include "base/heap.h"

enum {
    SNOW_SPACE_NEAR = 8,   /* the greatest distance that pages tell apart, in blocks */
    SNOW_SPACE_FAR = 7,    /* the same of tiles */
    SNOW_SPACE_MARGIN = 36 /* of sites that are not special, on sides where the map may be widened */
};

/* Tiles near which nothing is share pages: their distance is the number of the page. */
enum { SNOW_SPACE_OUTSIDE, SNOW_SPACE_SHARED = SNOW_SPACE_FAR + 2 /* so many */ };

enum { SNOW_SPACE_LOOK = 3 };

/* For each block: below SNOW_SPACE_LOOK: so many blocks away, ask the line; else the class. */
typedef union snow_space_near {
    _Alignas(64) _Atomic uint8_t block[64];
    _Atomic uintptr_t word[64 / sizeof(uintptr_t)];
} snow_space_near;

/* What is on the sites of a line: a bit for each site of a block. */
typedef struct snow_space_matter {
    _Atomic uint32_t filled[8][2];
    _Atomic uint32_t obstacle[8][2];
} snow_space_matter;

/* The sites that the map covers; x, y and z are multiples of 16. */
typedef struct snow_space_box {
    int32_t x, y, z;
    uint32_t columns, rows, layers; /* tiles */
} snow_space_box;

enum { SNOW_SPACE_SIDES = 2 * (SNOW_SPACE_NEAR / 4) + 1 /* pages in a row that a block may change */ };

typedef struct snow_space_map {
    snow_space_box box;
    _Atomic uint32_t *tile; /* its page */
    uint32_t *changed;      /* what is known of each tile: last by the landing of this number (its last 32 bits) */
    uint8_t *most;          /* nothing is greater in a tile's own page; 255 if it has none */
    /* Pages. */
    snow_space_near *near;
    _Atomic uint32_t *first_line; /* of the eight of a page; where nothing is near pages share eight */
    uint32_t pages, page_room;
    /* Lines. */
    snow_space_line *line;
    snow_space_matter *matter; /* NULL if that is not kept */
    uint32_t lines, line_room;
    bool keeps_matter;
    uint8_t near_number[SNOW_SPACE_NEAR + 2]; /* for each distance of blocks */
    /* What a block with a special site does to a layer of a page: by its place in the layer, and the page. */
    int8_t near_in_layer[16][SNOW_SPACE_SIDES * SNOW_SPACE_SIDES][16];
    snow_space_print *prints;
    snow_space_lower lower;
    uint64_t landing; /* for what changes now */
} snow_space_map;

snow_status snow_space_map_start(snow_space_map *map, snow_heap *heap, const snow_exits *exits, bool keeps_matter,
                                 snow_space_box box, snow_isa isa);
void snow_space_map_end(snow_space_map *map, snow_heap *heap);

/* Covers another box, which holds the old one. */
snow_status snow_space_map_widen(snow_space_map *map, snow_heap *heap, snow_space_box box);

/* Whether there is room for one more filled site, or obstacle: then snow_space_map_add() cannot fail. If there is none,
   snow_space_map_reserve() moves the map in memory. */
bool snow_space_map_has_room(const snow_space_map *map);
snow_status snow_space_map_reserve(snow_space_map *map, snow_heap *heap);
void snow_space_map_add(snow_space_map *map, int32_t x, int32_t y, int32_t z, bool obstacle);

static inline uint32_t snow_space_map_number(const snow_space_map *map, uint32_t column, uint32_t row, uint32_t layer)
{
    return (layer * map->box.rows + row) * map->box.columns + column;
}

/* The number of the tile with a site; negative outside. */
static inline int32_t snow_space_map_tile(const snow_space_map *map, int32_t x, int32_t y, int32_t z)
{
    uint32_t u = ((uint32_t)x - (uint32_t)map->box.x) / 16;
    uint32_t v = ((uint32_t)y - (uint32_t)map->box.y) / 16;
    uint32_t w = ((uint32_t)z - (uint32_t)map->box.z) / 16;
    bool inside = (u < map->box.columns) & (v < map->box.rows) & (w < map->box.layers);
    return inside ? (int32_t)snow_space_map_number(map, u, v, w) : -1;
}

/* The page that tells about a tile. */
static inline uint32_t snow_space_map_find(const snow_space_map *map, int32_t tile)
{
    uint32_t page = SNOW_MAP_GET_ADDRESS(map->tile[tile < 0 ? 0 : tile]);
    return tile < 0 ? SNOW_SPACE_OUTSIDE : page;
}

/* The line of a page that tells about a site. */
static inline uint32_t snow_space_map_line(const snow_space_map *map, uint32_t page, uint32_t u, uint32_t v, uint32_t w)
{
    return SNOW_MAP_GET_ADDRESS(map->first_line[page]) + snow_space_octant(u / 8, v / 8, w / 8);
}

/* Whether an answer there may have changed since that landing, one of the last 2^31. */
static inline bool snow_space_map_has_changed(const snow_space_map *map, int32_t tile, uint64_t since)
{
    return tile >= 0 && (int32_t)(map->changed[tile] - (uint32_t)since) > 0;
}

/* 0: special; else a class; SNOW_MAP_BEYOND. */
static inline uint32_t snow_space_map_look(const snow_space_map *map, uint32_t page, int32_t x, int32_t y, int32_t z)
{
    uint32_t u = (uint32_t)x; /* boxes begin at multiples of 16 */
    uint32_t v = (uint32_t)y;
    uint32_t w = (uint32_t)z;
    uint32_t near = SNOW_MAP_GET(map->near[page].block[snow_space_place(u / 4, v / 4, w / 4)]);
    if (near >= SNOW_SPACE_LOOK)
        return near;
    uint32_t line = snow_space_map_line(map, page, u, v, w);
    return snow_space_line_look(&map->line[line], u, v, w);
}

/* What is on a site; only where matter is kept. */
static inline int snow_space_map_matter(const snow_space_map *map, int32_t x, int32_t y, int32_t z)
{
    uint32_t u = (uint32_t)x;
    uint32_t v = (uint32_t)y;
    uint32_t w = (uint32_t)z;
    uint32_t page = snow_space_map_find(map, snow_space_map_tile(map, x, y, z));
    uint32_t line = snow_space_map_line(map, page, u, v, w);
    const snow_space_matter *matter = &map->matter[line];
    uint32_t block = snow_space_octant(u / 4, v / 4, w / 4);
    uint32_t half = w / 2 % 2;
    uint32_t bit = snow_space_place(u, v, w) % 32;
    uint32_t filled = SNOW_MAP_GET(matter->filled[block][half]) >> bit & 1;
    return (int)(filled | (SNOW_MAP_GET(matter->obstacle[block][half]) >> bit & 1) << 1);
}

#endif
