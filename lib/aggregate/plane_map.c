#include "aggregate/plane_map.h"

#include "base/floating.h"
#include "base/hexagon.h"

#include <string.h>

enum {
    NEAR_REACH = SNOW_PLANE_NEAR,
    PATCH_REACH = SNOW_PLANE_PATCHES,
    FAR_REACH = SNOW_PLANE_FAR, /* tiles, squares */
    MARGIN = 8,                 /* of the tables of classes, in blocks */
    SITE_REACH = 3              /* of what a filled site says about sites */
};

snow_plane_matter snow_plane_nothing;

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

static int64_t at_least(int64_t x, int64_t least)
{
    return x < least ? least : x;
}

static int64_t at_most(int64_t x, int64_t most)
{
    return x > most ? most : x;
}

/* A word holds 3 − distance for sixteen sites of a row. */
static uint32_t print_of(snow_aggregate_lattice lattice, int place, int row, int word)
{
    uint32_t print = 0;
    for (int site = 0; site < 16; site++) {
        int d = distance_to_contact(lattice, site + 16 * word - place, row);
        print |= (uint32_t)(d < 3 ? 3 - d : 0) << (2 * site);
    }
    return print;
}

/* The greater code of each site. */
static uint32_t greater(uint32_t a, uint32_t b)
{
    const uint32_t lower_bits = 0x55555555;
    uint32_t upper_a = a >> 1 & lower_bits;
    uint32_t upper_b = b >> 1 & lower_bits;
    uint32_t lower = (a & (upper_a | ~upper_b)) | (b & (upper_b | ~upper_a));
    return (upper_a | upper_b) << 1 | (lower & lower_bits);
}

static size_t squares_of(snow_plane_box box)
{
    return (size_t)(box.columns / 16) * (box.rows / 16);
}

static size_t tiles_of(snow_plane_box box)
{
    return (size_t)box.columns * box.rows;
}

static void start_page(snow_plane_page *page, uint8_t class, int distance, uint64_t landing)
{
    page->distance = (uint8_t)distance;
    page->changed = landing;
    for (int i = 0; i < 64; i++)
        atomic_init(&page->near[i], class);
    for (int i = 0; i < 4; i++)
        atomic_init(&page->line[i], &snow_plane_nothing.line);
}

static snow_status cover(snow_plane_map *map, snow_heap *heap, snow_plane_box box)
{
    snow_plane_page *_Atomic *tile = snow_heap_get_raw(heap, tiles_of(box), sizeof *tile);
    snow_plane_page *square = snow_heap_get_raw(heap, squares_of(box), sizeof *square);
    uint8_t *square_distance = snow_heap_get_raw(heap, squares_of(box), 1);
    if (tile == NULL || square == NULL || square_distance == NULL) {
        snow_heap_put(heap, square_distance);
        snow_heap_put(heap, square);
        snow_heap_put(heap, tile);
        return heap->refusal;
    }
    memset(square_distance, FAR_REACH + 1, squares_of(box));
    for (size_t i = 0; i < squares_of(box); i++)
        start_page(&square[i], map->square_class[FAR_REACH + 1], FAR_REACH + 1, 0);
    for (size_t row = 0; row < box.rows; row++)
        for (size_t column = 0; column < box.columns; column++)
            atomic_init(&tile[row * box.columns + column], &square[row / 16 * (box.columns / 16) + column / 16]);
    map->box = box;
    map->width = box.columns * 32;
    map->height = box.rows * 32;
    map->tile = tile;
    map->square = square;
    map->square_distance = square_distance;
    return SNOW_OK;
}

static void uncover(const snow_plane_map *map, snow_heap *heap)
{
    snow_heap_put(heap, map->square_distance);
    snow_heap_put(heap, map->square);
    snow_heap_put(heap, map->tile);
}

static bool patch_holds_special(const snow_plane_page *page, uint32_t u, uint32_t v)
{
    bool found = false;
    for (uint32_t row = 0; row < 4; row++)
        for (uint32_t column = 0; column < 4; column++)
            found |= SNOW_MAP_GET(page->near[(v / 16 % 2 * 4 + row) * 8 + u / 16 % 2 * 4 + column]) == 0;
    return found;
}

static bool holds_special(const snow_plane_page *page)
{
    return memchr((const void *)page->near, 0, sizeof page->near) != NULL;
}

static uint8_t class_of(const snow_exits *exits, int64_t free)
{
    return (uint8_t)snow_exits_class(exits, free + 1);
}

/* What each distance leaves free, at least. */
static void make_classes(snow_plane_map *map, const snow_exits *exits)
{
    for (int d = 0; d <= NEAR_REACH + 1; d++)
        map->near_class[d] = d < 2 ? (uint8_t)d : class_of(exits, 4 * (d - 1));
    for (int d = 1; d <= FAR_REACH; d++)
        start_page(&map->far[d], class_of(exits, 32 * (d - 1)), d, 0);
    for (int d = 0; d <= FAR_REACH + 1; d++)
        map->square_class[d] = class_of(exits, d <= 1 ? 32 * FAR_REACH : 512 * (d - 1));
}

/* Whatever stands in the way: what is nearer than a page tells it tells by blocks. */
static void make_rows(snow_plane_map *map, const snow_exits *exits)
{
    for (int j = -NEAR_REACH; j <= NEAR_REACH; j++) {
        for (int i = -NEAR_REACH - MARGIN; i <= NEAR_REACH + MARGIN; i++) {
            int64_t d = at_most(apart(map->lattice, i, j), NEAR_REACH + 1);
            map->near[j + NEAR_REACH][i + NEAR_REACH + MARGIN] = map->near_class[d];
        }
    }
    for (int j = -PATCH_REACH; j <= PATCH_REACH; j++) {
        for (int i = -4 * PATCH_REACH - MARGIN; i < 4 * (PATCH_REACH + 1) + MARGIN; i++) {
            int patch = (i + 4 * PATCH_REACH + MARGIN) / 4 - PATCH_REACH - MARGIN / 4;
            int64_t d = at_most(apart(map->lattice, patch, j), PATCH_REACH + 1);
            map->patch[j + PATCH_REACH][i + 4 * PATCH_REACH + MARGIN] =
                class_of(exits, at_least(16 * (d - 1), 4 * NEAR_REACH));
        }
    }
}

static void make_prints(snow_plane_map *map)
{
    for (int place = 0; place < 16; place++)
        for (int row = -SITE_REACH; row <= SITE_REACH; row++)
            for (int word = -1; word <= 1; word++)
                map->print[place][row + SITE_REACH][word + 1] = print_of(map->lattice, place, row, word);
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
    start_page(&map->outside, SNOW_MAP_BEYOND, FAR_REACH + 1, 0);
    make_classes(map, exits);
    make_rows(map, exits);
    make_prints(map);
    return cover(map, heap, box);
}

void snow_plane_map_end(snow_plane_map *map, snow_heap *heap)
{
    snow_pool_end(&map->lines, heap);
    snow_pool_end(&map->pages, heap);
    uncover(map, heap);
    map->square_distance = NULL;
    map->square = NULL;
    map->tile = NULL;
}

static snow_plane_page *page_of(snow_plane_map *map, int64_t column, int64_t row)
{
    snow_plane_page *_Atomic *entry = &map->tile[(size_t)row * map->box.columns + (size_t)column];
    snow_plane_page *page = SNOW_MAP_GET(*entry);
    if (page->distance == 0)
        return page;
    page = snow_pool_take(&map->pages);
    start_page(page, map->patch[0][0], 0, map->landing);
    SNOW_MAP_PUT_ADDRESS(*entry, page);
    return page;
}

static snow_plane_page *known_page(const snow_plane_map *map, uint32_t u, uint32_t v)
{
    return SNOW_MAP_GET(map->tile[(size_t)(v / 32) * map->box.columns + u / 32]);
}

static snow_plane_line *line_of(snow_plane_map *map, uint32_t u, uint32_t v)
{
    uint32_t place = v / 16 % 2 * 2 + u / 16 % 2;
    snow_plane_page *page = known_page(map, u, v);
    page->changed = map->landing;
    snow_plane_line *line = SNOW_MAP_GET(page->line[place]);
    if (line == &snow_plane_nothing.line) {
        line = snow_pool_take(&map->lines);
        SNOW_MAP_PUT_ADDRESS(page_of(map, u / 32, v / 32)->line[place], line);
    }
    return line;
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
static void lower(_Atomic uint8_t *known, const uint8_t *bound)
{
    for (int i = 0; i < 8; i++)
        if (bound[i] < SNOW_MAP_GET(known[i]))
            SNOW_MAP_PUT(known[i], bound[i]);
}

static void lower_row(snow_plane_map *map, snow_plane_page *page, int64_t row, const uint8_t *bound)
{
    _Atomic uint8_t *known = &page->near[row % 8 * 8];
    if (are_known(known, bound))
        return;
    lower(known, bound);
    page->changed = map->landing;
}

/* The block (i, j) has got its first special site. */
static void spread_near(snow_plane_map *map, int64_t i, int64_t j)
{
    int64_t first_row = at_least(j - NEAR_REACH, 0);
    int64_t last_row = at_most(j + NEAR_REACH, (int64_t)map->box.rows * 8 - 1);
    int64_t last_tile = at_most(i + NEAR_REACH, (int64_t)map->box.columns * 8 - 1) / 8;
    for (int64_t tile = at_least(i - NEAR_REACH, 0) / 8; tile <= last_tile; tile++) {
        for (int64_t row = first_row; row <= last_row;) {
            snow_plane_page *page = page_of(map, tile, row / 8);
            int64_t end = at_most(row - row % 8 + 8, last_row + 1);
            for (; row < end; row++)
                lower_row(map, page, row, &map->near[row - j + NEAR_REACH][8 * tile - i + NEAR_REACH + MARGIN]);
        }
    }
}

/* The patch (i, j) has got its first special site. */
static void spread_patch(snow_plane_map *map, int64_t i, int64_t j)
{
    int64_t first_row = at_least(j - PATCH_REACH, 0) * 4;
    int64_t last_row = at_most(j + PATCH_REACH, (int64_t)map->box.rows * 2 - 1) * 4 + 3;
    int64_t last_tile = at_most(i + PATCH_REACH, (int64_t)map->box.columns * 2 - 1) / 2;
    for (int64_t tile = at_least(i - PATCH_REACH, 0) / 2; tile <= last_tile; tile++) {
        for (int64_t row = first_row; row <= last_row;) {
            snow_plane_page *page = page_of(map, tile, row / 8);
            int64_t end = at_most(row - row % 8 + 8, last_row + 1);
            for (; row < end; row++)
                lower_row(map, page, row, &map->patch[row / 4 - j + PATCH_REACH][4 * (2 * tile - i + PATCH_REACH) + MARGIN]);
        }
    }
}

static void spread_square(snow_plane_map *map, int64_t i, int64_t j)
{
    int64_t columns = map->box.columns / 16;
    int64_t last_row = at_most(j + FAR_REACH, map->box.rows / 16 - 1);
    int64_t last = at_most(i + FAR_REACH, columns - 1);
    for (int64_t y = at_least(j - FAR_REACH, 0); y <= last_row; y++) {
        for (int64_t x = at_least(i - FAR_REACH, 0); x <= last; x++) {
            int64_t d = apart(map->lattice, (int)(x - i), (int)(y - j));
            uint8_t *known = &map->square_distance[y * columns + x];
            if (d >= *known)
                continue;
            *known = (uint8_t)d;
            snow_plane_page *page = &map->square[y * columns + x];
            for (int k = 0; k < 64; k++)
                SNOW_MAP_PUT(page->near[k], map->square_class[d]);
            page->changed = map->landing;
        }
    }
}

/* The tile (i, j) has got its first special site. */
static void spread_tile(snow_plane_map *map, int64_t i, int64_t j)
{
    int64_t last_row = at_most(j + FAR_REACH, (int64_t)map->box.rows - 1);
    int64_t last = at_most(i + FAR_REACH, (int64_t)map->box.columns - 1);
    for (int64_t y = at_least(j - FAR_REACH, 0); y <= last_row; y++) {
        for (int64_t x = at_least(i - FAR_REACH, 0); x <= last; x++) {
            snow_plane_page *_Atomic *entry = &map->tile[(size_t)y * map->box.columns + (size_t)x];
            snow_plane_page *page = SNOW_MAP_GET(*entry);
            int d = apart(map->lattice, (int)(x - i), (int)(y - j));
            if (d >= page->distance)
                continue;
            map->far[d].changed = map->landing;
            SNOW_MAP_PUT_ADDRESS(*entry, &map->far[d]);
        }
    }
    if (map->square_distance[j / 16 * (map->box.columns / 16) + i / 16] != 0)
        spread_square(map, i / 16, j / 16);
}

/* Pages move to the new box. */
static void copy_in(snow_plane_map *map, const snow_plane_map *old)
{
    int64_t shift_x = ((int64_t)old->box.x - map->box.x) / 32;
    int64_t shift_y = ((int64_t)old->box.y - map->box.y) / 32;
    for (int64_t y = 0; y < old->box.rows; y++) {
        for (int64_t x = 0; x < old->box.columns; x++) {
            snow_plane_page *page = SNOW_MAP_GET(old->tile[(size_t)y * old->box.columns + (size_t)x]);
            if (page->distance == 0)
                SNOW_MAP_PUT(map->tile[(size_t)(y + shift_y) * map->box.columns + (size_t)(x + shift_x)], page);
        }
    }
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
            const snow_plane_page *page = SNOW_MAP_GET(map->tile[(size_t)y * box.columns + (size_t)x]);
            if (page->distance == 0 && holds_special(page))
                spread_tile(map, x, y);
        }
    }
    return SNOW_OK;
}

snow_status snow_plane_map_reserve(snow_plane_map *map, snow_heap *heap)
{
    enum { LINES = 4, TILES = 64 };
    snow_status status = snow_pool_reserve(&map->pages, heap, TILES);
    return status == SNOW_OK ? snow_pool_reserve(&map->lines, heap, LINES) : status;
}

/* In a block that had none. */
static SNOW_APART void add_first_special(snow_plane_map *map, uint32_t u, uint32_t v)
{
    const snow_plane_page *page = page_of(map, u / 32, v / 32);
    bool is_first_of_tile = !holds_special(page);
    bool is_first_of_patch = !patch_holds_special(page, u, v);
    spread_near(map, u / 4, v / 4);
    if (is_first_of_patch)
        spread_patch(map, u / 16, v / 16);
    if (is_first_of_tile)
        spread_tile(map, u / 32, v / 32);
}

static void add_special(snow_plane_map *map, uint32_t u, uint32_t v)
{
    if (u < map->width && v < map->height && SNOW_MAP_GET(known_page(map, u, v)->near[v / 4 % 8 * 8 + u / 4 % 8]) != 0)
        add_first_special(map, u, v);
}

/* The rows of one line, `first` to `last` of the map. */
static void add_print(snow_plane_map *map, uint32_t u, uint32_t first, uint32_t last, const uint32_t *print)
{
    snow_plane_line *line = line_of(map, u, first);
    for (uint32_t v = first; v <= last; v++, print += 3) {
        _Atomic uint32_t *row = &line->row[v % 16];
        SNOW_MAP_PUT(*row, greater(SNOW_MAP_GET(*row), *print));
    }
}

/* What a site says about those up to three away. */
static void add_prints(snow_plane_map *map, int64_t u, int64_t v)
{
    const uint32_t *print = map->print[(u + 16) % 16][0];
    int64_t least = at_least(v - SITE_REACH, 0);
    int64_t most = at_most(v + SITE_REACH, (int64_t)map->height - 1);
    for (int word = 0; word < 3; word++) {
        int64_t column = u + 16 * (word - 1);
        if (column < 0 || column >= (int64_t)map->width || (word == 0 && u % 16 >= 3) || (word == 2 && u % 16 < 13))
            continue;
        for (int64_t first = least; first <= most; first = first - first % 16 + 16) {
            int64_t last = at_most(first - first % 16 + 15, most);
            add_print(map, (uint32_t)column, (uint32_t)first, (uint32_t)last, print + 3 * (first - v + SITE_REACH) + word);
        }
    }
}

void snow_plane_map_add(snow_plane_map *map, int32_t x, int32_t y, bool obstacle)
{
    uint32_t u = (uint32_t)x - (uint32_t)map->box.x; /* in a floor v is −1 */
    uint32_t v = (uint32_t)y - (uint32_t)map->box.y;
    add_special(map, u, v);
    for (int k = 0; k < (map->lattice == SNOW_AGGREGATE_HEXAGONAL ? 6 : 4); k++)
        add_special(map, u + (uint32_t)neighbour_x[k], v + (uint32_t)neighbour_y[k]);
    add_prints(map, (int64_t)x - map->box.x, (int64_t)y - map->box.y);
    if (!map->keeps_matter || u >= map->width || v >= map->height)
        return;
    snow_plane_matter *matter = (snow_plane_matter *)line_of(map, u, v);
    _Atomic uint16_t *row = &(obstacle ? matter->obstacle : matter->filled)[v % 16];
    SNOW_MAP_PUT(*row, (uint16_t)(SNOW_MAP_GET(*row) | 1u << u % 16));
}
