#include "aggregate/plane_map.h"

#include "base/hexagon.h"

#include <string.h>

enum {
    NEAR_REACH = SNOW_PLANE_NEAR,
    FAR_REACH = 15, /* patches, tiles, squares */
    BEYOND = FAR_REACH + 1,
    MARGIN = 16 /* of the table of distances */
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

static size_t tiles_of(snow_plane_box box)
{
    return (size_t)box.columns * box.rows;
}

static snow_status cover(snow_plane_map *map, snow_heap *heap, snow_plane_box box)
{
    _Atomic uintptr_t *tile = snow_heap_get_raw(heap, tiles_of(box), sizeof *tile);
    _Atomic uint8_t *patch = snow_heap_get_raw(heap, tiles_of(box), 16);
    _Atomic uint8_t *square = snow_heap_get_raw(heap, squares_of(box), 1);
    if (tile == NULL || patch == NULL || square == NULL) {
        snow_heap_put(heap, square);
        snow_heap_put(heap, patch);
        snow_heap_put(heap, tile);
        return heap->refusal;
    }
    for (size_t i = 0; i < tiles_of(box); i++)
        atomic_init(&tile[i], BEYOND);
    for (size_t i = 0; i < 16 * tiles_of(box); i++)
        atomic_init(&patch[i], BEYOND);
    for (size_t i = 0; i < squares_of(box); i++)
        atomic_init(&square[i], BEYOND);
    map->box = box;
    map->width = box.columns * 64;
    map->height = box.rows * 64;
    map->tile = tile;
    map->patch = patch;
    map->square = square;
    return SNOW_OK;
}

static void uncover(const snow_plane_map *map, snow_heap *heap)
{
    snow_heap_put(heap, map->square);
    snow_heap_put(heap, map->patch);
    snow_heap_put(heap, map->tile);
}

/* Where nothing is near, and nothing is. */
static snow_plane_matter nothing;

static snow_plane_line *line_with(snow_plane_map *map, snow_plane_page *page, uint32_t i, uint32_t j)
{
    uint32_t place = j / 4 * 4 + i / 4;
    snow_plane_line *line = SNOW_MAP_GET(page->line[place]);
    if (line == &nothing.line) {
        line = snow_pool_take(&map->lines);
        SNOW_MAP_PUT_ADDRESS(page->line[place], line);
    }
    return line;
}

static bool holds_special(const snow_plane_page *page)
{
    return memchr((const void *)page->near, 0, sizeof page->near) != NULL;
}

/* What each distance leaves free, at least. */
static void make_classes(snow_plane_map *map, const snow_exits *exits)
{
    for (int d = 0; d <= BEYOND; d++) {
        int64_t patch = d <= 2 ? 4 * NEAR_REACH + 1 : 16 * (d - 1) + 1;
        int64_t tile = 64 * (d - 1) + 1;
        int64_t square = d <= 1 ? 64 * FAR_REACH + 1 : 1024 * (d - 1) + 1;
        map->patch_class[d] = (uint8_t)snow_exits_class(exits, patch);
        map->tile_class[d] = (uint8_t)snow_exits_class(exits, tile);
        map->square_class[d] = (uint8_t)snow_exits_class(exits, square);
    }
}

static void make_distances(snow_plane_map *map)
{
    memset(map->apart, 127, sizeof map->apart);
    for (int j = -FAR_REACH; j <= FAR_REACH; j++)
        for (int i = -FAR_REACH; i <= FAR_REACH; i++)
            map->apart[j + FAR_REACH][i + FAR_REACH + MARGIN] = (uint8_t)apart(map->lattice, i, j);
}

snow_status snow_plane_map_start(snow_plane_map *map, snow_heap *heap, const snow_exits *exits, bool keeps_matter,
                                 snow_plane_box box)
{
    *map = (snow_plane_map){
        .pages = {.item = sizeof(snow_plane_page)},
        .lines = {.item = keeps_matter ? sizeof(snow_plane_matter) : sizeof(snow_plane_line)},
        .keeps_matter = keeps_matter,
        .lattice = exits->lattice,
    };
    make_classes(map, exits);
    make_distances(map);
    for (int place = 0; place < 16; place++)
        for (int block = 0; block < 9; block++)
            map->print[place][block] = print_of(map->lattice, place, block);
    return cover(map, heap, box);
}

void snow_plane_map_end(snow_plane_map *map, snow_heap *heap)
{
    snow_pool_end(&map->lines, heap);
    snow_pool_end(&map->pages, heap);
    uncover(map, heap);
    map->square = NULL;
    map->patch = NULL;
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
    _Atomic uintptr_t *entry = &map->tile[(size_t)row * map->box.columns + (size_t)column];
    uintptr_t known = SNOW_MAP_GET(*entry);
    if (known > BEYOND)
        return (snow_plane_page *)known;
    snow_plane_page *page = snow_pool_take(&map->pages);
    for (int i = 0; i < 256; i++)
        atomic_init(&page->near[i], NEAR_REACH + 1);
    for (int i = 0; i < 16; i++)
        atomic_init(&page->line[i], &nothing.line);
    SNOW_MAP_PUT_ADDRESS(*entry, (uintptr_t)page);
    return page;
}

/* Whether none of eight bounds is below what is known; all are less than 128. */
static bool are_known(const _Atomic uint8_t *known, const uint8_t *bound)
{
    const uint64_t tops = UINT64_C(0x8080808080808080);
    uint64_t a;
    uint64_t b;
    memcpy(&a, (const void *)known, sizeof a); /* nobody else writes */
    memcpy(&b, bound, sizeof b);
    return (((b | tops) - a) & tops) == tops;
}

/* The lesser of each two. */
static void lower(_Atomic uint8_t *known, const uint8_t *bound, int64_t count)
{
    for (int64_t i = 0; i < count; i++)
        if (bound[i] < SNOW_MAP_GET(known[i]))
            SNOW_MAP_PUT(known[i], bound[i]);
}

static void lower_eights(_Atomic uint8_t *known, const uint8_t *bound, int64_t count)
{
    for (int64_t i = 0; i < count; i += 8)
        if (!are_known(known + i, bound + i))
            lower(known + i, bound + i, 8);
}

/* The block (i, j) has got its first special site. */
static void spread_near(snow_plane_map *map, int64_t i, int64_t j)
{
    int64_t first_row = at_least(j - NEAR_REACH, 0);
    int64_t last_row = at_most(j + NEAR_REACH, (int64_t)map->box.rows * 16 - 1);
    int64_t first_tile = at_least(i - NEAR_REACH, 0) / 16;
    int64_t last_tile = at_most(i + NEAR_REACH, (int64_t)map->box.columns * 16 - 1) / 16;
    for (int64_t tile = first_tile; tile <= last_tile; tile++) {
        for (int64_t row = first_row; row <= last_row;) {
            snow_plane_page *page = page_of(map, tile, row / 16);
            int64_t end = at_most(row - row % 16 + 16, last_row + 1);
            for (; row < end; row++) {
                const uint8_t *bound = &map->apart[row - j + FAR_REACH][tile * 16 - i + FAR_REACH + MARGIN];
                lower_eights(&page->near[row % 16 * 16], bound, 16);
            }
        }
    }
}

/* The patch (i, j) has got its first special site. */
static void spread_patch(snow_plane_map *map, int64_t i, int64_t j)
{
    int64_t columns = map->box.columns * 4;
    int64_t first = at_least(i - FAR_REACH, 0);
    int64_t last = at_most(i + FAR_REACH, columns - 1);
    int64_t last_row = at_most(j + FAR_REACH, (int64_t)map->box.rows * 4 - 1);
    for (int64_t y = at_least(j - FAR_REACH, 0); y <= last_row; y++) {
        const uint8_t *bound = &map->apart[y - j + FAR_REACH][first - i + FAR_REACH + MARGIN];
        int64_t eights = (last + 1 - first) / 8 * 8;
        lower_eights(&map->patch[y * columns + first], bound, eights);
        lower(&map->patch[y * columns + first + eights], bound + eights, last + 1 - first - eights);
    }
    map->far_changes++;
}

static void spread_square(snow_plane_map *map, int64_t i, int64_t j)
{
    int64_t columns = map->box.columns / 16;
    int64_t rows = map->box.rows / 16;
    int64_t first = at_least(i - FAR_REACH, 0);
    int64_t last = at_most(i + FAR_REACH, columns - 1);
    for (int64_t y = at_least(j - FAR_REACH, 0); y <= at_most(j + FAR_REACH, rows - 1); y++) {
        const uint8_t *bound = &map->apart[y - j + FAR_REACH][first - i + FAR_REACH + MARGIN];
        lower(&map->square[y * columns + first], bound, last + 1 - first);
    }
}

/* The tile (i, j) has got its first special site. */
static void spread_tile(snow_plane_map *map, int64_t i, int64_t j)
{
    for (int64_t y = at_least(j - FAR_REACH, 0); y <= at_most(j + FAR_REACH, (int64_t)map->box.rows - 1); y++) {
        for (int64_t x = at_least(i - FAR_REACH, 0); x <= at_most(i + FAR_REACH, (int64_t)map->box.columns - 1); x++) {
            _Atomic uintptr_t *entry = &map->tile[(size_t)y * map->box.columns + (size_t)x];
            uintptr_t known = SNOW_MAP_GET(*entry);
            uintptr_t d = map->apart[y - j + FAR_REACH][x - i + FAR_REACH + MARGIN];
            if (known <= BEYOND && d < known)
                SNOW_MAP_PUT(*entry, d);
        }
    }
    map->far_changes++;
    int64_t columns = map->box.columns / 16;
    if (SNOW_MAP_GET(map->square[j / 16 * columns + i / 16]) != 0)
        spread_square(map, i / 16, j / 16);
}

/* Pages and patches move to the new box. */
static void copy_in(snow_plane_map *map, const snow_plane_map *old)
{
    int64_t shift_x = ((int64_t)old->box.x - map->box.x) / 64;
    int64_t shift_y = ((int64_t)old->box.y - map->box.y) / 64;
    for (int64_t y = 0; y < old->box.rows; y++) {
        for (int64_t x = 0; x < old->box.columns; x++) {
            uintptr_t entry = SNOW_MAP_GET(old->tile[(size_t)y * old->box.columns + (size_t)x]);
            if (entry > BEYOND)
                SNOW_MAP_PUT(map->tile[(size_t)(y + shift_y) * map->box.columns + (size_t)(x + shift_x)], entry);
        }
    }
    for (int64_t y = 0; y < (int64_t)old->box.rows * 4; y++)
        memcpy((void *)(map->patch + (size_t)(y + 4 * shift_y) * (map->box.columns * 4) + 4 * shift_x),
               (const void *)(old->patch + (size_t)y * (old->box.columns * 4)), old->box.columns * 4);
}

snow_status snow_plane_map_widen(snow_plane_map *map, snow_heap *heap, snow_plane_box box)
{
    snow_plane_map old = *map;
    snow_status status = cover(map, heap, box);
    if (status != SNOW_OK)
        return status;
    copy_in(map, &old);
    uncover(&old, heap);
    for (int64_t y = 0; y < box.rows; y++) {
        for (int64_t x = 0; x < box.columns; x++) {
            uintptr_t entry = SNOW_MAP_GET(map->tile[(size_t)y * box.columns + (size_t)x]);
            if (entry > BEYOND && holds_special((const snow_plane_page *)entry))
                spread_tile(map, x, y);
        }
    }
    for (int64_t y = 0; y < (int64_t)box.rows * 4; y++)
        for (int64_t x = 0; x < (int64_t)box.columns * 4; x++)
            if (SNOW_MAP_GET(map->patch[y * box.columns * 4 + x]) == 0)
                spread_patch(map, x, y);
    return SNOW_OK;
}

snow_status snow_plane_map_reserve(snow_plane_map *map, snow_heap *heap)
{
    enum { BLOCKS = 9, TILES = 9 };
    snow_status status = snow_pool_reserve(&map->pages, heap, TILES);
    return status == SNOW_OK ? snow_pool_reserve(&map->lines, heap, BLOCKS) : status;
}

static void add_special(snow_plane_map *map, snow_plane_page *page, int32_t i, int32_t j)
{
    if (SNOW_MAP_GET(page->near[j % 16 * 16 + i % 16]) == 0)
        return;
    bool is_first = !holds_special(page);
    spread_near(map, i, j);
    if (SNOW_MAP_GET(map->patch[(size_t)(j / 4) * (map->box.columns * 4) + (size_t)(i / 4)]) != 0)
        spread_patch(map, i / 4, j / 4);
    if (is_first)
        spread_tile(map, i / 16, j / 16);
}

static void add_print(snow_plane_map *map, int32_t i, int32_t j, uint32_t print)
{
    if ((uint32_t)i >= map->box.columns * 16 || (uint32_t)j >= map->box.rows * 16)
        return;
    snow_plane_page *page = page_of(map, i / 16, j / 16);
    if (has_special(print))
        add_special(map, page, i, j);
    snow_plane_line *line = line_with(map, page, (uint32_t)i % 16, (uint32_t)j % 16);
    _Atomic uint32_t *word = &line->word[j % 4 * 4 + i % 4];
    SNOW_MAP_PUT(*word, greater(SNOW_MAP_GET(*word), print));
}

static void add_matter(snow_plane_map *map, uint32_t u, uint32_t v, bool obstacle)
{
    snow_plane_page *page = page_of(map, u / 64, v / 64);
    snow_plane_matter *matter = (snow_plane_matter *)line_with(map, page, u / 4 % 16, v / 4 % 16);
    _Atomic uint16_t *word = &(obstacle ? matter->obstacle : matter->filled)[v / 4 % 4 * 4 + u / 4 % 4];
    SNOW_MAP_PUT(*word, (uint16_t)(SNOW_MAP_GET(*word) | 1u << (v % 4 * 4 + u % 4)));
}

void snow_plane_map_add(snow_plane_map *map, int32_t x, int32_t y, bool obstacle)
{
    int32_t u = x - map->box.x;
    int32_t v = y - map->box.y;
    int32_t i = (u + 4) / 4 - 1; /* u and v may be -1: a floor */
    int32_t j = (v + 4) / 4 - 1;
    const uint32_t *print = map->print[(v + 4) % 4 * 4 + (u + 4) % 4];
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++)
            if (print[3 * row + column] != 0)
                add_print(map, i + column - 1, j + row - 1, print[3 * row + column]);
    if (map->keeps_matter && (uint32_t)u < map->width && (uint32_t)v < map->height)
        add_matter(map, (uint32_t)u, (uint32_t)v, obstacle);
}
