/* What a walker in space asks before each jump: plane_map.h on the cubic
   lattice. Blocks are 4 x 4 x 4 sites, lines 2 x 2 x 2 blocks, tiles and pages
   16 x 16 x 16 sites; cubes of 4 x 4 x 4 tiles stand above them. Distances go
   up to 4 blocks and 5 tiles or cubes. */
#ifndef SNOW_AGGREGATE_SPACE_MAP_H
#define SNOW_AGGREGATE_SPACE_MAP_H

#include "aggregate/exits.h"
#include "aggregate/matter.h"
#include "aggregate/pool.h"

enum {
    SNOW_SPACE_NEAR = 4,   /* the greatest distance of blocks that is told apart */
    SNOW_SPACE_FAR = 5,    /* of tiles, of cubes */
    SNOW_SPACE_MARGIN = 24 /* of sites that are not special, on sides where the map may be widened */
};

/* Upper and lower bits of 3 − distance, for the sites of a block. */
typedef struct snow_space_word {
    uint64_t upper;
    uint64_t lower;
} snow_space_word;

/* The same with 32 sites each in numbers that threads can share on every platform. */
typedef struct snow_space_shared_word {
    _Atomic uint32_t upper[2];
    _Atomic uint32_t lower[2];
} snow_space_shared_word;

typedef struct snow_space_line {
    snow_space_shared_word word[8];
} snow_space_line;

typedef struct snow_space_matter {
    snow_space_line line;
    _Atomic uint32_t filled[8][2];
    _Atomic uint32_t obstacle[8][2];
} snow_space_matter;

typedef struct snow_space_page {
    _Atomic uint8_t near[64];         /* 0, 1: so many blocks away; else the class */
    snow_space_line *_Atomic line[8]; /* never NULL: where nothing is near they share one */
    uint64_t changed;                 /* what this page says: last, by the landing of this number */
} snow_space_page;

/* The sites that the map covers: whole cubes of tiles; x, y and z are multiples of 16. */
typedef struct snow_space_box {
    int32_t x, y, z;
    uint32_t columns, rows, layers; /* tiles */
} snow_space_box;

typedef struct snow_space_map {
    snow_space_box box;
    snow_space_page *_Atomic *tile;
    snow_space_page *cube; /* for tiles that are far from all special ones */
    uint8_t *cube_distance;
    snow_space_page far[SNOW_SPACE_FAR + 1]; /* for tiles at this distance */
    uint8_t cube_class[SNOW_SPACE_FAR + 2];
    snow_pool pages;
    snow_pool lines; /* with matter, if that is kept */
    bool keeps_matter;
    uint8_t near[SNOW_SPACE_NEAR + 2]; /* the class at each distance of blocks */
    uint8_t near_in_layer[16][9][16];  /* from a place in a page to those of the pages round it */
    uint64_t landing;                  /* for pages that change now */
    snow_space_page outside;           /* stands for all places where the map ends */
    snow_space_word (*print)[27]; /* for each place in a block: what a filled site does to the words round it */
} snow_space_map;

snow_status snow_space_map_start(snow_space_map *map, snow_heap *heap, const snow_exits *exits, bool keeps_matter,
                                 snow_space_box box);
void snow_space_map_end(snow_space_map *map, snow_heap *heap);

/* Covers another box, which holds the old one. */
snow_status snow_space_map_widen(snow_space_map *map, snow_heap *heap, snow_space_box box);

/* Room for one more filled site, or obstacle: then snow_space_map_add() cannot fail. */
snow_status snow_space_map_reserve(snow_space_map *map, snow_heap *heap);
void snow_space_map_add(snow_space_map *map, int32_t x, int32_t y, int32_t z, bool obstacle);

static inline const snow_space_page *snow_space_map_page(const snow_space_map *map, uint32_t column, uint32_t row, uint32_t layer)
{
    return SNOW_MAP_GET_ADDRESS(map->tile[((size_t)layer * map->box.rows + row) * map->box.columns + column]);
}

static inline bool snow_space_map_has(const snow_space_map *map, uint32_t column, uint32_t row, uint32_t layer)
{
    return column < map->box.columns && row < map->box.rows && layer < map->box.layers;
}

/* The block of a line, and the line of a page: x lowest. */
static inline uint32_t snow_space_octant(uint32_t x, uint32_t y, uint32_t z)
{
    return (z & 1) << 2 | (y & 1) << 1 | (x & 1);
}

static inline uint32_t snow_space_place(uint32_t x, uint32_t y, uint32_t z)
{
    return (z & 3) << 4 | (y & 3) << 2 | (x & 3);
}

/* Where nothing is near, and nothing is. */
extern snow_space_matter snow_space_nothing;

/* The page that tells about a site. */
static inline const snow_space_page *snow_space_map_find(const snow_space_map *map, int32_t x, int32_t y, int32_t z)
{
    uint32_t u = ((uint32_t)x - (uint32_t)map->box.x) / 16;
    uint32_t v = ((uint32_t)y - (uint32_t)map->box.y) / 16;
    uint32_t w = ((uint32_t)z - (uint32_t)map->box.z) / 16;
    bool inside = (u < map->box.columns) & (v < map->box.rows) & (w < map->box.layers);
    const snow_space_page *page = snow_space_map_page(map, inside ? u : 0, inside ? v : 0, inside ? w : 0);
    return inside ? page : &map->outside;
}

/* 0: special; else a class; SNOW_MAP_BEYOND. */
static inline snow_map_answer snow_space_page_look(const snow_space_page *page, int32_t x, int32_t y, int32_t z)
{
    uint32_t u = (uint32_t)x; /* boxes begin at multiples of 16 */
    uint32_t v = (uint32_t)y;
    uint32_t w = (uint32_t)z;
    uint32_t near = SNOW_MAP_GET(page->near[snow_space_place(u / 4, v / 4, w / 4)]);
    if (near >= 2)
        return (snow_map_answer){near, &page->changed};
    const snow_space_line *line = SNOW_MAP_GET_ADDRESS(page->line[snow_space_octant(u / 8, v / 8, w / 8)]);
    const snow_space_shared_word *word = &line->word[snow_space_octant(u / 4, v / 4, w / 4)];
    uint32_t half = w / 2 % 2;
    uint32_t bit = snow_space_place(u, v, w) % 32;
    uint32_t upper = SNOW_MAP_GET(word->upper[half]) >> bit & 1;
    uint32_t lower = SNOW_MAP_GET(word->lower[half]) >> bit & 1;
    return (snow_map_answer){3 - 2 * upper - lower, &page->changed};
}

/* What is on a site; only where matter is kept. */
static inline int snow_space_map_matter(const snow_space_map *map, int32_t x, int32_t y, int32_t z)
{
    uint32_t u = (uint32_t)x - (uint32_t)map->box.x;
    uint32_t v = (uint32_t)y - (uint32_t)map->box.y;
    uint32_t w = (uint32_t)z - (uint32_t)map->box.z;
    if (!snow_space_map_has(map, u / 16, v / 16, w / 16))
        return 0;
    const snow_space_page *page = snow_space_map_page(map, u / 16, v / 16, w / 16);
    const snow_space_line *line = SNOW_MAP_GET_ADDRESS(page->line[snow_space_octant(u / 8, v / 8, w / 8)]);
    const snow_space_matter *matter = (const snow_space_matter *)line;
    uint32_t block = snow_space_octant(u / 4, v / 4, w / 4);
    uint32_t half = w / 2 % 2;
    uint32_t bit = snow_space_place(u, v, w) % 32;
    uint32_t filled = SNOW_MAP_GET(matter->filled[block][half]) >> bit & 1;
    return (int)(filled | (SNOW_MAP_GET(matter->obstacle[block][half]) >> bit & 1) << 1);
}

#endif
