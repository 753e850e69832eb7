#include "aggregate/plane_map.h"

#include "base/hexagon.h"

#include <string.h>

enum {
    NEAR_REACH = 8,  /* blocks; beyond: 9 */
    TILE_REACH = 15, /* tiles, and squares of tiles; beyond: 16 */
    BEYOND = 16
};

/* Blocks apart: a block d away leaves (d − 1) blocks free between. */
static int apart(snow_aggregate_lattice lattice, int i, int j)
{
    int magnitude_i = i < 0 ? -i : i;
    int magnitude_j = j < 0 ? -j : j;
    int most = magnitude_i > magnitude_j ? magnitude_i : magnitude_j;
    if (lattice != SNOW_AGGREGATE_HEXAGONAL)
        return most;
    int sum = (i + j < 0 ? -(i + j) : i + j) - 1;
    return sum > most ? sum : most;
}

/* Of sites: the radius of the largest region round one that does not hold the other. */
static int distance(snow_aggregate_lattice lattice, int x, int y)
{
    return lattice == SNOW_AGGREGATE_HEXAGONAL ? (int)snow_hexagon_distance(x, y) : apart(lattice, x, y);
}

static const int neighbour_x[6] = {1, -1, 0, 0, 1, -1};
static const int neighbour_y[6] = {0, 0, 1, -1, -1, 1};

/* Distance to the special sites that a filled site at 0 makes. */
static int distance_to_contact(snow_aggregate_lattice lattice, int x, int y)
{
    int least = distance(lattice, x, y);
    for (int k = 0; k < (lattice == SNOW_AGGREGATE_HEXAGONAL ? 6 : 4); k++) {
        int other = distance(lattice, x - neighbour_x[k], y - neighbour_y[k]);
        least = other < least ? other : least;
    }
    return least;
}

/* A word holds 3 − distance for each site: the upper bit in its upper half. */
static uint32_t print_of(snow_aggregate_lattice lattice, int place, int block)
{
    uint32_t word = 0;
    for (int bit = 0; bit < 16; bit++) {
        int x = bit % 4 + 4 * (block % 3 - 1) - place % 4;
        int y = bit / 4 + 4 * (block / 3 - 1) - place / 4;
        int d = distance_to_contact(lattice, x, y);
        int code = d < 3 ? 3 - d : 0;
        word |= (uint32_t)(code & 1) << bit | (uint32_t)(code >> 1) << (bit + 16);
    }
    return word;
}

/* The greater code of each site. */
static uint32_t greater(uint32_t a, uint32_t b)
{
    uint32_t upper_a = a >> 16;
    uint32_t upper_b = b >> 16;
    uint32_t lower = (a & (upper_a | ~upper_b)) | (b & (upper_b | ~upper_a));
    return (upper_a | upper_b) << 16 | (lower & 0xFFFF);
}

static bool has_special(uint32_t print)
{
    return (print & print >> 16 & 0xFFFF) != 0;
}

static size_t squares_of(snow_plane_box box)
{
    return (size_t)(box.columns / 16) * (box.rows / 16);
}

static snow_status cover(snow_plane_map *map, snow_heap *heap, snow_plane_box box)
{
    size_t tiles = (size_t)box.columns * box.rows;
    uintptr_t *tile = snow_heap_get_raw(heap, tiles, sizeof *tile);
    uint8_t *square = snow_heap_get_raw(heap, squares_of(box), 1);
    if (tile == NULL || square == NULL) {
        snow_heap_put(heap, square);
        snow_heap_put(heap, tile);
        return heap->refusal;
    }
    for (size_t i = 0; i < tiles; i++)
        tile[i] = BEYOND;
    memset(square, BEYOND, squares_of(box));
    map->box = box;
    map->tile = tile;
    map->square = square;
    return SNOW_OK;
}

static uint32_t *line_word(snow_plane_map *map, snow_plane_page *page, uint32_t i, uint32_t j)
{
    uint32_t *number = &page->line[j / 4 * 4 + i / 4];
    if (*number == 0) {
        *number = snow_pool_take(&map->lines);
        if (map->keeps_matter)
            snow_pool_take(&map->matter);
    }
    uint32_t *line = snow_pool_item(&map->lines, *number);
    return &line[j % 4 * 4 + i % 4];
}

snow_status snow_plane_map_start(snow_plane_map *map, snow_heap *heap, const snow_exits *exits, bool keeps_matter,
                                 snow_plane_box box)
{
    *map = (snow_plane_map){
        .pages = {.item = sizeof(snow_plane_page)},
        .lines = {.item = 16 * sizeof(uint32_t)},
        .matter = {.item = sizeof(snow_plane_matter)},
        .keeps_matter = keeps_matter,
        .lattice = exits->lattice,
    };
    for (int d = 0; d <= BEYOND; d++) {
        int64_t free = d <= 1 ? 4 * NEAR_REACH + 1 : 64 * (d - 1) + 1;
        map->tile_class[d] = (uint8_t)snow_exits_class(exits, free);
        free = d <= 1 ? 64 * TILE_REACH + 1 : 1024 * (d - 1) + 1;
        map->square_class[d] = (uint8_t)snow_exits_class(exits, free);
    }
    for (int place = 0; place < 16; place++)
        for (int block = 0; block < 9; block++)
            map->print[place][block] = print_of(map->lattice, place, block);
    snow_status status = cover(map, heap, box);
    if (status == SNOW_OK)
        status = snow_pool_reserve(&map->lines, heap, 1);
    if (status == SNOW_OK && keeps_matter)
        status = snow_pool_reserve(&map->matter, heap, 1);
    if (status != SNOW_OK) {
        snow_plane_map_end(map, heap);
        return status;
    }
    snow_pool_take(&map->lines); /* line 0: nothing is near */
    if (keeps_matter)
        snow_pool_take(&map->matter);
    return SNOW_OK;
}

void snow_plane_map_end(snow_plane_map *map, snow_heap *heap)
{
    snow_pool_end(&map->matter, heap);
    snow_pool_end(&map->lines, heap);
    snow_pool_end(&map->pages, heap);
    snow_heap_put(heap, map->square);
    snow_heap_put(heap, map->tile);
    map->square = NULL;
    map->tile = NULL;
}

static int64_t at_least(int64_t x, int64_t least)
{
    return x < least ? least : x;
}

static int64_t at_most(int64_t x, int64_t most)
{
    return x > most ? most : x;
}

static snow_plane_page *page_of(snow_plane_map *map, int64_t column, int64_t row)
{
    uintptr_t *entry = &map->tile[(size_t)row * map->box.columns + (size_t)column];
    if (*entry <= BEYOND) {
        snow_plane_page *page = snow_pool_item(&map->pages, snow_pool_take(&map->pages));
        memset(page->near, NEAR_REACH + 1, sizeof page->near);
        *entry = (uintptr_t)page;
    }
    return (snow_plane_page *)*entry;
}

/* The block (i, j) has got its first special site. */
static void spread_near(snow_plane_map *map, int64_t i, int64_t j)
{
    int64_t first_i = at_least(i - NEAR_REACH, 0);
    int64_t last_i = at_most(i + NEAR_REACH, (int64_t)map->box.columns * 16 - 1);
    int64_t first_j = at_least(j - NEAR_REACH, 0);
    int64_t last_j = at_most(j + NEAR_REACH, (int64_t)map->box.rows * 16 - 1);
    for (int64_t y = first_j; y <= last_j; y++) {
        for (int64_t x = first_i; x <= last_i;) {
            uint8_t *near = page_of(map, x / 16, y / 16)->near + y % 16 * 16;
            int64_t end = at_most(x - x % 16 + 16, last_i + 1);
            for (; x < end; x++) {
                int d = apart(map->lattice, (int)(x - i), (int)(y - j));
                near[x % 16] = (uint8_t)at_most(near[x % 16], d);
            }
        }
    }
}

static void spread_square(snow_plane_map *map, int64_t i, int64_t j)
{
    int64_t columns = map->box.columns / 16;
    int64_t rows = map->box.rows / 16;
    for (int64_t y = at_least(j - TILE_REACH, 0); y <= at_most(j + TILE_REACH, rows - 1); y++) {
        for (int64_t x = at_least(i - TILE_REACH, 0); x <= at_most(i + TILE_REACH, columns - 1); x++) {
            uint8_t *known = &map->square[y * columns + x];
            *known = (uint8_t)at_most(*known, apart(map->lattice, (int)(x - i), (int)(y - j)));
        }
    }
}

/* The tile (i, j) has got its first special site. */
static void spread_tile(snow_plane_map *map, int64_t i, int64_t j)
{
    for (int64_t y = at_least(j - TILE_REACH, 0); y <= at_most(j + TILE_REACH, (int64_t)map->box.rows - 1); y++) {
        for (int64_t x = at_least(i - TILE_REACH, 0); x <= at_most(i + TILE_REACH, (int64_t)map->box.columns - 1); x++) {
            uintptr_t *entry = &map->tile[(size_t)y * map->box.columns + (size_t)x];
            uintptr_t d = (uintptr_t)apart(map->lattice, (int)(x - i), (int)(y - j));
            if (*entry <= BEYOND && d < *entry)
                *entry = d;
        }
    }
    int64_t columns = map->box.columns / 16;
    if (map->square[j / 16 * columns + i / 16] != 0)
        spread_square(map, i / 16, j / 16);
}

snow_status snow_plane_map_widen(snow_plane_map *map, snow_heap *heap, snow_plane_box box)
{
    snow_plane_map old = *map;
    snow_status status = cover(map, heap, box);
    if (status != SNOW_OK)
        return status;
    int64_t shift_x = ((int64_t)old.box.x - box.x) / 64;
    int64_t shift_y = ((int64_t)old.box.y - box.y) / 64;
    for (int64_t y = 0; y < old.box.rows; y++) {
        for (int64_t x = 0; x < old.box.columns; x++) {
            uintptr_t entry = old.tile[(size_t)y * old.box.columns + (size_t)x];
            if (entry > BEYOND)
                map->tile[(size_t)(y + shift_y) * box.columns + (size_t)(x + shift_x)] = entry;
        }
    }
    for (int64_t y = 0; y < box.rows; y++) {
        for (int64_t x = 0; x < box.columns; x++) {
            uintptr_t entry = map->tile[(size_t)y * box.columns + (size_t)x];
            if (entry > BEYOND && ((const snow_plane_page *)entry)->holds_special)
                spread_tile(map, x, y);
        }
    }
    snow_heap_put(heap, old.square);
    snow_heap_put(heap, old.tile);
    return SNOW_OK;
}

snow_status snow_plane_map_reserve(snow_plane_map *map, snow_heap *heap)
{
    enum { BLOCKS = 9, TILES = 9 };
    snow_status status = snow_pool_reserve(&map->pages, heap, TILES);
    if (status == SNOW_OK)
        status = snow_pool_reserve(&map->lines, heap, BLOCKS);
    if (status == SNOW_OK && map->keeps_matter)
        status = snow_pool_reserve(&map->matter, heap, BLOCKS);
    return status;
}

static void add_special(snow_plane_map *map, int64_t i, int64_t j)
{
    snow_plane_page *page = page_of(map, i / 16, j / 16);
    if (page->near[j % 16 * 16 + i % 16] == 0)
        return;
    spread_near(map, i, j);
    if (page->holds_special)
        return;
    page->holds_special = 1;
    spread_tile(map, i / 16, j / 16);
}

static void add_matter(snow_plane_map *map, int64_t u, int64_t v, bool obstacle)
{
    snow_plane_page *page = page_of(map, u / 64, v / 64);
    snow_plane_matter *matter = snow_pool_item(&map->matter, page->line[v / 16 % 4 * 4 + u / 16 % 4]);
    uint16_t *word = &(obstacle ? matter->obstacle : matter->filled)[v / 4 % 4 * 4 + u / 4 % 4];
    *word = (uint16_t)(*word | 1u << (v % 4 * 4 + u % 4));
}

void snow_plane_map_add(snow_plane_map *map, int32_t x, int32_t y, bool obstacle)
{
    int64_t u = (int64_t)x - map->box.x;
    int64_t v = (int64_t)y - map->box.y;
    int64_t block_i = (u + 4) / 4 - 1; /* u and v may be −1: a floor */
    int64_t block_j = (v + 4) / 4 - 1;
    const uint32_t *print = map->print[(v + 4) % 4 * 4 + (u + 4) % 4];
    for (int block = 0; block < 9; block++) {
        int64_t i = block_i + block % 3 - 1;
        int64_t j = block_j + block / 3 - 1;
        if (print[block] == 0 || i < 0 || j < 0 || i >= (int64_t)map->box.columns * 16 ||
            j >= (int64_t)map->box.rows * 16)
            continue;
        if (has_special(print[block]))
            add_special(map, i, j);
        snow_plane_page *page = page_of(map, i / 16, j / 16);
        uint32_t *word = line_word(map, page, (uint32_t)(i % 16), (uint32_t)(j % 16));
        *word = greater(*word, print[block]);
    }
    bool inside = u >= 0 && v >= 0 && u < (int64_t)map->box.columns * 64 && v < (int64_t)map->box.rows * 64;
    if (map->keeps_matter && inside)
        add_matter(map, u, v, obstacle);
}
