/* How far the nearest site lies at which something can happen: what a walker
   in the plane asks before each jump.

   A site is special when it is filled, an obstacle, or next to one of these.
   The map answers with a class of exits.h: the whole region of that class round
   the site holds no special site; 0 says that the site itself is special. It
   knows, from near to far:
   - for each site whether the nearest special site is at distance 0, 1, 2 or
     more: two bits a site, a word for 16 sites of a row, a cache line (a "line")
     for 16 x 16 sites near which there is one;
   - for each block of 4 x 4 sites what the cells of plane_halo.h up to 8 sites wide
     say: a byte a block, in "pages" of 32 x 32 sites near which there is one;
   - for each tile, the place of a page, what larger cells say.
   Pages and lines have numbers: a vector looks up eight at a time.
   Bytes hold classes: the least that cells say, 0 where a special site lies in the
   place. Where there is no page of a tile's own one stands that says the same
   everywhere, so that each question takes the same way: which branch it would
   take nobody could foretell. The map is a function of the set of special sites:
   the order in which they came does not show. */
#ifndef SNOW_AGGREGATE_PLANE_MAP_H
#define SNOW_AGGREGATE_PLANE_MAP_H

#include "aggregate/matter.h"
#include "aggregate/plane_halo.h"
#include "aggregate/plane_line.h"

/* Between special sites and those sides where the map may be widened: more than cells of blocks see. */
enum { SNOW_PLANE_MARGIN = 96 };

/* What is on the sites of a line, where that matters: a bit a site. */
typedef struct snow_plane_matter {
    _Alignas(64) _Atomic uint16_t filled[16];
    _Atomic uint16_t obstacle[16];
} snow_plane_matter;

/* What is said of a tile's blocks. */
typedef union snow_plane_page {
    _Alignas(64) _Atomic uint8_t near[64];
    _Atomic uint64_t near_row[8];
} snow_plane_page;

/* The numbers of its lines. */
typedef struct snow_plane_quarters {
    _Atomic uint32_t line[4];
} snow_plane_quarters;

/* Pages that say the same everywhere have the number of that class, one that stands for all places where the map
   ends is SNOW_MAP_BEYOND; the line that says that nothing is near has number 0. */
enum { SNOW_PLANE_SHARED_PAGES = SNOW_MAP_BEYOND + 1, SNOW_PLANE_SHARED_LINES = 1 };

/* The sites that the map covers: whole cells of the largest size; x and y are multiples of 512. */
typedef struct snow_plane_box {
    int32_t x, y;
    uint32_t columns, rows;
} snow_plane_box;

typedef struct snow_plane_map {
    snow_plane_box box;
    uint32_t width, height;  /* of the box, sites */
    _Atomic uint32_t *tile;  /* numbers of pages */
    uint8_t *tile_class;
    uint32_t *changed;       /* what is known of each tile: last by the landing of this number (its last 32 bits) */
    snow_plane_page *page;
    snow_plane_quarters *quarters;
    snow_plane_line *line;
    snow_plane_matter *matter; /* of each line, if that is kept */
    uint32_t pages, page_room;
    uint32_t lines, line_room;
    bool keeps_matter;
    snow_aggregate_lattice lattice;
    snow_plane_prints prints;
    snow_halos *halos;
    uint64_t landing; /* for pages that change now */
} snow_plane_map;

snow_status snow_plane_map_start(snow_plane_map *map, snow_heap *heap, const snow_exits *exits, bool keeps_matter,
                                 snow_plane_box box);
void snow_plane_map_end(snow_plane_map *map, snow_heap *heap);

/* Covers another box, which holds the old one. */
snow_status snow_plane_map_widen(snow_plane_map *map, snow_heap *heap, snow_plane_box box);

/* Whether there is room for one more filled site, or obstacle: then snow_plane_map_add() cannot fail. If there is none,
   snow_plane_map_reserve() moves the map in memory: nobody may look at it. */
bool snow_plane_map_has_room(const snow_plane_map *map);
snow_status snow_plane_map_reserve(snow_plane_map *map, snow_heap *heap);
void snow_plane_map_add(snow_plane_map *map, int32_t x, int32_t y, bool obstacle);

/* The number of the tile that a site lies in; negative outside the box. */
static inline int32_t snow_plane_map_tile(const snow_plane_map *map, int32_t x, int32_t y)
{
    uint32_t u = (uint32_t)x - (uint32_t)map->box.x;
    uint32_t v = (uint32_t)y - (uint32_t)map->box.y;
    bool inside = (u < map->width) & (v < map->height);
    return inside ? (int32_t)(v / 32 * map->box.columns + u / 32) : -1;
}

/* The page that tells about a tile. */
static inline uint32_t snow_plane_map_find(const snow_plane_map *map, int32_t tile)
{
    uint32_t page = SNOW_MAP_GET_ADDRESS(map->tile[tile < 0 ? 0 : tile]);
    return tile < 0 ? SNOW_MAP_BEYOND : page;
}

/* The line of a page that tells about a site. */
static inline uint32_t snow_plane_map_line(const snow_plane_map *map, uint32_t page, uint32_t u, uint32_t v)
{
    return SNOW_MAP_GET_ADDRESS(map->quarters[page].line[v / 16 % 2 * 2 + u / 16 % 2]);
}

/* Whether an answer there may have changed since that landing, one of the last 2^31. */
static inline bool snow_plane_map_has_changed(const snow_plane_map *map, int32_t tile, uint64_t since)
{
    return tile >= 0 && (int32_t)(map->changed[tile] - (uint32_t)since) > 0;
}

/* 0: special; else a class; SNOW_MAP_BEYOND. */
static inline uint32_t snow_plane_map_look(const snow_plane_map *map, uint32_t page, int32_t x, int32_t y)
{
    uint32_t u = (uint32_t)x; /* boxes begin at multiples of 32 */
    uint32_t v = (uint32_t)y;
    uint32_t near = SNOW_MAP_GET(map->page[page].near[v / 4 % 8 * 8 + u / 4 % 8]);
    uint32_t line = snow_plane_map_line(map, page, u, v);
    uint32_t exact = snow_plane_line_look(&map->line[line], u, v);
    return near > exact ? near : exact; /* neither is more than what is free */
}

/* What is on a site; only where matter is kept. */
static inline int snow_plane_map_matter(const snow_plane_map *map, int32_t x, int32_t y)
{
    int32_t tile = snow_plane_map_tile(map, x, y);
    if (tile < 0)
        return 0;
    uint32_t u = (uint32_t)x;
    uint32_t v = (uint32_t)y;
    const snow_plane_matter *matter = &map->matter[snow_plane_map_line(map, snow_plane_map_find(map, tile), u, v)];
    uint32_t bit = u % 16;
    return (SNOW_MAP_GET(matter->filled[v % 16]) >> bit & 1) | (SNOW_MAP_GET(matter->obstacle[v % 16]) >> bit & 1) << 1;
}

#endif
