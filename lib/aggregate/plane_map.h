/* How far the nearest site lies at which something can happen: what a walker
   in the plane asks before each jump.

   A site is special when it is filled, an obstacle, or next to one of these.
   The map answers with a class of exits.h: the whole region of that class round
   the site holds no special site; 0 says that the site itself is special. It
   knows, from near to far:
   - for each site whether the nearest special site is at distance 0, 1, 2 or
     more: two bits a site, a word for a block of 4 x 4 sites, a cache line (a
     "line") for 16 x 16 sites near which there is one;
   - for each block how many blocks away the nearest one with a special site is,
     up to 8: a byte a block, in "pages" of 64 x 64 sites near which there is one;
   - the same for patches, the places of lines, up to 15;
   - the same for tiles, the places of pages, up to 15, where there is no page;
   - the same for squares of 16 x 16 tiles, up to 15.
   Where blocks of b sites are d blocks apart, (d - 1) b sites are free between
   their nearest sites. The map is a function of the set of special sites: the
   order in which they came does not show. */
#ifndef SNOW_AGGREGATE_PLANE_MAP_H
#define SNOW_AGGREGATE_PLANE_MAP_H

#include "aggregate/exits.h"
#include "aggregate/matter.h"
#include "aggregate/pool.h"

enum {
    SNOW_PLANE_NEAR = 8,      /* the greatest distance of blocks that is told apart */
    SNOW_PLANE_TILES_FROM = 5 /* the least distance of tiles that says more than that of patches */
};

/* Three less the distance of each site: the lower bits of the sites of a block
   in the lower half of its word, the upper bits in the upper half. */
typedef struct snow_plane_line {
    _Atomic uint32_t word[16];
} snow_plane_line;

/* The same where it matters which sites are filled and which are obstacles: a bit a site. */
typedef struct snow_plane_matter {
    snow_plane_line line;
    _Atomic uint16_t filled[16];
    _Atomic uint16_t obstacle[16];
} snow_plane_matter;

typedef struct snow_plane_page {
    _Atomic uint8_t near[256];
    snow_plane_line *_Atomic line[16]; /* never NULL: where nothing is near they share one */
} snow_plane_page;

/* The sites that the map covers: whole squares of tiles. */
typedef struct snow_plane_box {
    int32_t x, y;
    uint32_t columns, rows;
} snow_plane_box;

typedef struct snow_plane_map {
    snow_plane_box box;
    _Atomic uintptr_t *tile; /* up to 16: the distance; else the address of a page */
    _Atomic uint8_t *patch;
    _Atomic uint8_t *square;
    uint8_t patch_class[17];
    uint8_t tile_class[17];
    uint8_t square_class[17];
    uint32_t width, height; /* of the box, sites */
    snow_pool pages;
    snow_pool lines; /* with matter, if that is kept */
    bool keeps_matter;
    snow_aggregate_lattice lattice;
    uint32_t print[16][9];     /* for each place in a block: what a filled site does to the words round it */
    uint8_t apart[31][31 + 32]; /* distances up to 15, from the middle; at both sides 16 columns of more */
    uint64_t far_changes;      /* of what is known of patches, tiles and squares, so far */
} snow_plane_map;

snow_status snow_plane_map_start(snow_plane_map *map, snow_heap *heap, const snow_exits *exits, bool keeps_matter,
                                 snow_plane_box box);
void snow_plane_map_end(snow_plane_map *map, snow_heap *heap);

/* Covers another box, which holds the old one. */
snow_status snow_plane_map_widen(snow_plane_map *map, snow_heap *heap, snow_plane_box box);

/* Room for one more filled site, or obstacle: then snow_plane_map_add() cannot fail. */
snow_status snow_plane_map_reserve(snow_plane_map *map, snow_heap *heap);
void snow_plane_map_add(snow_plane_map *map, int32_t x, int32_t y, bool obstacle);

/* Where the nearest special site is too far for a page. */
static inline int snow_plane_map_look_far(const snow_plane_map *map, uintptr_t entry, uint32_t u, uint32_t v)
{
    if (entry < SNOW_PLANE_TILES_FROM || entry > 16)
        return map->patch_class[SNOW_MAP_GET(map->patch[(size_t)(v / 16) * (map->box.columns * 4) + u / 16])];
    if (entry < 16)
        return map->tile_class[entry];
    return map->square_class[SNOW_MAP_GET(map->square[(size_t)(v / 1024) * (map->box.columns / 16) + u / 1024])];
}

/* 0: special; else a class; SNOW_MAP_BEYOND. */
static inline int snow_plane_map_look(const snow_plane_map *map, int32_t x, int32_t y)
{
    uint32_t u = (uint32_t)x - (uint32_t)map->box.x;
    uint32_t v = (uint32_t)y - (uint32_t)map->box.y;
    if (u >= map->width || v >= map->height)
        return SNOW_MAP_BEYOND;
    uintptr_t entry = SNOW_MAP_GET_ADDRESS(map->tile[(size_t)(v / 64) * map->box.columns + u / 64]);
    if (entry <= 16)
        return snow_plane_map_look_far(map, entry, u, v);
    const snow_plane_page *page = (const snow_plane_page *)entry;
    int near = SNOW_MAP_GET(page->near[v / 4 % 16 * 16 + u / 4 % 16]);
    if (near >= 2)
        return near <= SNOW_PLANE_NEAR ? near + 2 : snow_plane_map_look_far(map, entry, u, v);
    const snow_plane_line *line = SNOW_MAP_GET_ADDRESS(page->line[v / 16 % 4 * 4 + u / 16 % 4]);
    uint32_t word = SNOW_MAP_GET(line->word[v / 4 % 4 * 4 + u / 4 % 4]) >> (v % 4 * 4 + u % 4);
    return 3 - (int)((word >> 15 & 2) | (word & 1));
}

/* What is on a site; only where matter is kept. */
static inline int snow_plane_map_matter(const snow_plane_map *map, int32_t x, int32_t y)
{
    uint32_t u = (uint32_t)x - (uint32_t)map->box.x;
    uint32_t v = (uint32_t)y - (uint32_t)map->box.y;
    if (u >= map->width || v >= map->height)
        return 0;
    uintptr_t entry = SNOW_MAP_GET_ADDRESS(map->tile[(size_t)(v / 64) * map->box.columns + u / 64]);
    if (entry <= 16)
        return 0;
    const snow_plane_page *page = (const snow_plane_page *)entry;
    const snow_plane_line *line = SNOW_MAP_GET_ADDRESS(page->line[v / 16 % 4 * 4 + u / 16 % 4]);
    const snow_plane_matter *matter = (const snow_plane_matter *)line;
    uint32_t block = v / 4 % 4 * 4 + u / 4 % 4;
    uint32_t bit = v % 4 * 4 + u % 4;
    return (SNOW_MAP_GET(matter->filled[block]) >> bit & 1) | (SNOW_MAP_GET(matter->obstacle[block]) >> bit & 1) << 1;
}

#endif
