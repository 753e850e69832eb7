/* What a walker in space asks before each jump: plane_map.h on the cubic
   lattice. Lines are 8 x 8 x 8 sites, blocks 4 x 4 x 4 of them, tiles and pages
   16 x 16 x 16; cubes of 4 x 4 x 4 tiles stand above them. Near the cluster the
   lines tell each site's own distance; further away that of its block, up to 8
   blocks, or of its tile, up to 8 tiles, or of its cube.

   Two neighbours differ by at most 1 in their distance. So 16 bits tell those of
   2 x 2 x 2 sites, a pair in each direction: the least of them, and one bit each. */
#ifndef SNOW_AGGREGATE_SPACE_MAP_H
#define SNOW_AGGREGATE_SPACE_MAP_H

#include "aggregate/exits.h"
#include "aggregate/matter.h"
#include "aggregate/pool.h"

enum {
    SNOW_SPACE_SITES = 5,  /* the greatest distance that lines tell apart */
    SNOW_SPACE_NEAR = 8,   /* the same of blocks */
    SNOW_SPACE_FAR = 8,    /* of tiles */
    SNOW_SPACE_CUBES = 5,  /* of cubes */
    SNOW_SPACE_MARGIN = 36 /* of sites that are not special, on sides where the map may be widened */
};

/* Of a pair of sites in each direction: the least distance times 256, and a bit
   for each site that is one further away. */
typedef union snow_space_line {
    _Atomic uint16_t pair[64];
    _Atomic uintptr_t word[128 / sizeof(uintptr_t)]; /* several at a time */
} snow_space_line;

typedef struct snow_space_matter {
    snow_space_line line;
    _Atomic uint32_t filled[8][2]; /* a bit for each site of a block */
    _Atomic uint32_t obstacle[8][2];
} snow_space_matter;

enum { SNOW_SPACE_LOOK = 3 };

/* For each block: below SNOW_SPACE_LOOK: so many blocks away, ask the line; else the class. */
typedef union snow_space_near {
    _Atomic uint8_t block[64];
    _Atomic uintptr_t word[64 / sizeof(uintptr_t)];
} snow_space_near;

typedef struct snow_space_page {
    snow_space_near near;
    snow_space_line *_Atomic line[8]; /* never NULL: where nothing is near they share one */
    uint64_t changed;                 /* what this page says: last, by the landing of this number */
    uint8_t most;                     /* nothing in near is greater */
    uint8_t distance;                 /* of the tiles that share this page; 0: it is a tile's own */
} snow_space_page;

/* The sites that the map covers: whole cubes of tiles; x, y and z are multiples of 16. */
typedef struct snow_space_box {
    int32_t x, y, z;
    uint32_t columns, rows, layers; /* tiles */
} snow_space_box;

enum {
    SNOW_SPACE_SIDES = 2 * (SNOW_SPACE_NEAR / 4) + 1,        /* pages in a row that a block may change */
    SNOW_SPACE_LINES = 3,                                    /* lines in a row that a filled site may change */
    SNOW_SPACE_PAIRS = 2 * ((SNOW_SPACE_SITES + 2) / 2) + 1, /* rows of pairs that it may change, side by side */
    SNOW_SPACE_ROWS = SNOW_SPACE_PAIRS + 6                   /* with those of whole lines */
};

/* What a filled site does to the pairs round it, in rows of a line each. */
typedef struct snow_space_print {
    int16_t pair[SNOW_SPACE_LINES][SNOW_SPACE_PAIRS][SNOW_SPACE_ROWS][4];
} snow_space_print;

typedef struct snow_space_map {
    snow_space_box box;
    snow_space_page *_Atomic *tile;
    snow_space_page *cube; /* for tiles that are far from all special ones */
    uint8_t *cube_distance;
    snow_space_page far[SNOW_SPACE_FAR + 1]; /* for tiles at this distance */
    uint8_t cube_class[SNOW_SPACE_CUBES + 2];
    snow_pool pages;
    snow_pool lines; /* with matter, if that is kept */
    bool keeps_matter;
    uint8_t near[SNOW_SPACE_NEAR + 2]; /* the number for each distance of blocks */
    /* What a block with a special site does to a layer of a page: by its place in the layer, and the page. */
    uint8_t near_in_layer[16][SNOW_SPACE_SIDES * SNOW_SPACE_SIDES][16];
    snow_space_print *print;   /* by the place in a row of a line, and by parity in y and z */
    uint64_t landing;          /* for pages that change now */
    snow_space_page outside;   /* stands for all places where the map ends */
    snow_space_matter nothing; /* the line where nothing is near, and nothing is */
} snow_space_map;

snow_status snow_space_map_start(snow_space_map *map, snow_heap *heap, const snow_exits *exits, bool keeps_matter,
                                 snow_space_box box);
void snow_space_map_end(snow_space_map *map, snow_heap *heap);

/* Covers another box, which holds the old one. */
snow_status snow_space_map_widen(snow_space_map *map, snow_heap *heap, snow_space_box box);

/* Room for one more filled site, or obstacle: then snow_space_map_add() cannot fail. */
snow_status snow_space_map_reserve(snow_space_map *map, snow_heap *heap);
void snow_space_map_add(snow_space_map *map, int32_t x, int32_t y, int32_t z, bool obstacle);

static inline const snow_space_page *snow_space_map_page(const snow_space_map *map, uint32_t column, uint32_t row,
                                                         uint32_t layer)
{
    return SNOW_MAP_GET_ADDRESS(map->tile[((size_t)layer * map->box.rows + row) * map->box.columns + column]);
}

static inline bool snow_space_map_has(const snow_space_map *map, uint32_t column, uint32_t row, uint32_t layer)
{
    return column < map->box.columns && row < map->box.rows && layer < map->box.layers;
}

/* The site of a pair, the block of a line, the line of a page: x lowest. */
static inline uint32_t snow_space_octant(uint32_t x, uint32_t y, uint32_t z)
{
    return (z & 1) << 2 | (y & 1) << 1 | (x & 1);
}

/* The pair of a line, the site of a block, the block of a page. */
static inline uint32_t snow_space_place(uint32_t x, uint32_t y, uint32_t z)
{
    return (z & 3) << 4 | (y & 3) << 2 | (x & 3);
}

/* The number of the tile that a site lies in; negative outside the box. */
static inline int32_t snow_space_map_tile(const snow_space_map *map, int32_t x, int32_t y, int32_t z)
{
    uint32_t u = ((uint32_t)x - (uint32_t)map->box.x) / 16;
    uint32_t v = ((uint32_t)y - (uint32_t)map->box.y) / 16;
    uint32_t w = ((uint32_t)z - (uint32_t)map->box.z) / 16;
    bool inside = (u < map->box.columns) & (v < map->box.rows) & (w < map->box.layers);
    return inside ? (int32_t)((w * map->box.rows + v) * map->box.columns + u) : -1;
}

/* The page that tells about a tile. */
static inline const snow_space_page *snow_space_map_find(const snow_space_map *map, int32_t tile)
{
    const snow_space_page *page = SNOW_MAP_GET_ADDRESS(map->tile[tile < 0 ? 0 : tile]);
    return tile < 0 ? &map->outside : page;
}

/* Whether an answer there may have changed since that landing. */
static inline bool snow_space_map_has_changed(const snow_space_map *map, int32_t tile, uint64_t since)
{
    return snow_space_map_find(map, tile)->changed > since;
}

/* 0: special; else a class; SNOW_MAP_BEYOND. */
static inline snow_map_answer snow_space_page_look(const snow_space_page *page, int32_t x, int32_t y, int32_t z)
{
    uint32_t u = (uint32_t)x; /* boxes begin at multiples of 16 */
    uint32_t v = (uint32_t)y;
    uint32_t w = (uint32_t)z;
    uint32_t near = SNOW_MAP_GET(page->near.block[snow_space_place(u / 4, v / 4, w / 4)]);
    if (near >= SNOW_SPACE_LOOK)
        return (snow_map_answer){near, &page->changed};
    const snow_space_line *line = SNOW_MAP_GET_ADDRESS(page->line[snow_space_octant(u / 8, v / 8, w / 8)]);
    uint32_t pair = SNOW_MAP_GET(line->pair[snow_space_place(u / 2, v / 2, w / 2)]);
    return (snow_map_answer){(pair >> 8) + (pair >> snow_space_octant(u, v, w) & 1), &page->changed};
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
