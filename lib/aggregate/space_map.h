/* What a walker in space asks before each jump: plane_map.h on the cubic
   lattice. Blocks are 4 x 4 x 4 sites, lines 2 x 2 x 2 blocks, tiles and pages
   16 x 16 x 16 sites; cubes of 4 x 4 x 4 tiles stand above them. Distances go
   up to 4 blocks and 5 tiles or cubes. */
#ifndef SNOW_AGGREGATE_SPACE_MAP_H
#define SNOW_AGGREGATE_SPACE_MAP_H

#include "aggregate/exits.h"
#include "aggregate/matter.h"
#include "aggregate/pool.h"

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
    _Atomic uint8_t near[64];
    snow_space_line *_Atomic line[8]; /* never NULL: where nothing is near they share one */
} snow_space_page;

/* The sites that the map covers: whole cubes of tiles. */
typedef struct snow_space_box {
    int32_t x, y, z;
    uint32_t columns, rows, layers; /* tiles */
} snow_space_box;

typedef struct snow_space_map {
    snow_space_box box;
    _Atomic uintptr_t *tile; /* up to 6: the distance; else the address of a page */
    _Atomic uint8_t *cube;
    uint8_t tile_class[7];
    uint8_t cube_class[7];
    snow_pool pages;
    snow_pool lines; /* with matter, if that is kept */
    bool keeps_matter;
    uint8_t apart[16][9][16]; /* in a layer: from a place in a page to those of the pages round it */
    uint64_t far_changes;     /* of what is known of tiles and cubes, so far */
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

static inline uintptr_t snow_space_map_tile(const snow_space_map *map, uint32_t column, uint32_t row, uint32_t layer)
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

/* 0: special; else a class; SNOW_MAP_BEYOND. */
static inline int snow_space_map_look(const snow_space_map *map, int32_t x, int32_t y, int32_t z)
{
    uint32_t u = (uint32_t)x - (uint32_t)map->box.x;
    uint32_t v = (uint32_t)y - (uint32_t)map->box.y;
    uint32_t w = (uint32_t)z - (uint32_t)map->box.z;
    if (!snow_space_map_has(map, u / 16, v / 16, w / 16))
        return SNOW_MAP_BEYOND;
    uintptr_t entry = snow_space_map_tile(map, u / 16, v / 16, w / 16);
    if (entry < 6)
        return map->tile_class[entry];
    if (entry == 6) {
        size_t row = (size_t)(w / 64) * (map->box.rows / 4) + v / 64;
        return map->cube_class[SNOW_MAP_GET(map->cube[row * (map->box.columns / 4) + u / 64])];
    }
    const snow_space_page *page = (const snow_space_page *)entry;
    int near = SNOW_MAP_GET(page->near[snow_space_place(u / 4, v / 4, w / 4)]);
    if (near >= 2)
        return near + 2;
    const snow_space_line *line = SNOW_MAP_GET_ADDRESS(page->line[snow_space_octant(u / 8, v / 8, w / 8)]);
    const snow_space_shared_word *word = &line->word[snow_space_octant(u / 4, v / 4, w / 4)];
    uint32_t half = w / 2 % 2;
    uint32_t bit = snow_space_place(u, v, w) % 32;
    return 3 - (int)((SNOW_MAP_GET(word->upper[half]) >> bit & 1) << 1 | (SNOW_MAP_GET(word->lower[half]) >> bit & 1));
}

/* What is on a site; only where matter is kept. */
static inline int snow_space_map_matter(const snow_space_map *map, int32_t x, int32_t y, int32_t z)
{
    uint32_t u = (uint32_t)x - (uint32_t)map->box.x;
    uint32_t v = (uint32_t)y - (uint32_t)map->box.y;
    uint32_t w = (uint32_t)z - (uint32_t)map->box.z;
    if (!snow_space_map_has(map, u / 16, v / 16, w / 16))
        return 0;
    uintptr_t entry = snow_space_map_tile(map, u / 16, v / 16, w / 16);
    if (entry <= 6)
        return 0;
    const snow_space_page *page = (const snow_space_page *)entry;
    const snow_space_line *line = SNOW_MAP_GET_ADDRESS(page->line[snow_space_octant(u / 8, v / 8, w / 8)]);
    const snow_space_matter *matter = (const snow_space_matter *)line;
    uint32_t block = snow_space_octant(u / 4, v / 4, w / 4);
    uint32_t half = w / 2 % 2;
    uint32_t bit = snow_space_place(u, v, w) % 32;
    uint32_t filled = SNOW_MAP_GET(matter->filled[block][half]) >> bit & 1;
    return (int)(filled | (SNOW_MAP_GET(matter->obstacle[block][half]) >> bit & 1) << 1);
}

#endif
