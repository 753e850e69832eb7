#include "aggregate/space_map.h"

#include <string.h>

enum {
    NEAR_REACH = SNOW_SPACE_NEAR,
    FAR_REACH = SNOW_SPACE_FAR,
    SIDES = SNOW_SPACE_SIDES,
    LINES_OF_A_PAGE = 8,
    MOST_PAGES = 1 << 26, /* vectors look things up by 32 bits with a sign */
    MOST_LINES = 1 << 26
};

/* One more site may need so many. */
enum { PAGES_OF_A_SITE = (SIDES + 1) * (SIDES + 1) * (SIDES + 1), LINES_OF_A_SITE = 8 * LINES_OF_A_PAGE };

static int32_t magnitude(int32_t x)
{
    return x < 0 ? -x : x;
}

static int32_t at_least(int32_t x, int32_t least)
{
    return x < least ? least : x;
}

static int32_t at_most(int32_t x, int32_t most)
{
    return x > most ? most : x;
}

static int32_t apart(int32_t i, int32_t j, int32_t k)
{
    return at_least(at_least(magnitude(i), magnitude(j)), magnitude(k));
}

typedef int8_t sixteen __attribute__((vector_size(16))); /* blocks of a layer of a page */

/* Nobody else writes, so all may be read as plain numbers. */
static sixteen get(const void *from)
{
    sixteen numbers;
    memcpy(&numbers, from, sizeof numbers);
    return numbers;
}

static void put(_Atomic uintptr_t *to, sixteen numbers)
{
    uintptr_t word[16 / sizeof(uintptr_t)];
    memcpy(word, &numbers, sizeof word);
    for (size_t i = 0; i < 16 / sizeof *to; i++)
        SNOW_MAP_PUT(to[i], word[i]);
}

/* Whether any of 16 bytes is not 0. */
static bool has_any(sixteen bytes)
{
    uint64_t half[2];
    memcpy(half, &bytes, sizeof half);
    return (half[0] | half[1]) != 0;
}

static sixteen lesser(sixteen a, sixteen b)
{
    sixteen choose = a < b;
    return (a & choose) | (b & ~choose);
}

static sixteen greater(sixteen a, sixteen b)
{
    sixteen choose = a < b;
    return (b & choose) | (a & ~choose);
}

static size_t tiles_of(snow_space_box box)
{
    return (size_t)box.columns * box.rows * box.layers;
}

static snow_status cover(snow_space_map *map, snow_heap *heap, snow_space_box box)
{
    if ((uint64_t)box.columns * box.rows * box.layers > INT32_MAX)
        return SNOW_ERROR_TOO_LARGE;
    _Atomic uint32_t *tile = snow_heap_get_raw(heap, tiles_of(box), sizeof *tile);
    uint32_t *changed = snow_heap_get_raw(heap, tiles_of(box), sizeof *changed);
    uint8_t *most = snow_heap_get_raw(heap, tiles_of(box), sizeof *most);
    if (tile == NULL || changed == NULL || most == NULL) {
        snow_heap_put(heap, most);
        snow_heap_put(heap, changed);
        snow_heap_put(heap, (void *)tile);
        return heap->refusal;
    }
    memset(most, UINT8_MAX, tiles_of(box));
    for (size_t i = 0; i < tiles_of(box); i++) {
        atomic_init(&tile[i], SNOW_SPACE_SHARED - 1);
        changed[i] = (uint32_t)map->landing;
    }
    map->box = box;
    map->tile = tile;
    map->changed = changed;
    map->most = most;
    return SNOW_OK;
}

static void uncover(const snow_space_map *map, snow_heap *heap)
{
    snow_heap_put(heap, map->most);
    snow_heap_put(heap, map->changed);
    snow_heap_put(heap, (void *)map->tile);
}

static uint32_t more_than(uint32_t room)
{
    return room + room / 4;
}

static snow_status add_pages(snow_space_map *map, snow_heap *heap)
{
    uint32_t room = more_than(map->pages + PAGES_OF_A_SITE);
    if (room > MOST_PAGES)
        return SNOW_ERROR_TOO_LARGE;
    snow_space_near *near = snow_heap_move(heap, map->near, map->pages, room, sizeof *near);
    if (near == NULL)
        return heap->refusal;
    map->near = near;
    _Atomic uint32_t *first_line =
        snow_heap_move(heap, (void *)map->first_line, map->pages, room, sizeof *first_line);
    if (first_line == NULL)
        return heap->refusal;
    map->first_line = first_line;
    map->page_room = room;
    return SNOW_OK;
}

static snow_status add_lines(snow_space_map *map, snow_heap *heap)
{
    uint32_t room = more_than(map->lines + LINES_OF_A_SITE);
    if (room > MOST_LINES)
        return SNOW_ERROR_TOO_LARGE;
    snow_space_line *line = snow_heap_move(heap, map->line, map->lines, room, sizeof *line);
    if (line == NULL)
        return heap->refusal;
    map->line = line;
    snow_space_matter *matter = NULL;
    if (map->keeps_matter) {
        matter = snow_heap_move(heap, map->matter, map->lines, room, sizeof *matter);
        if (matter == NULL)
            return heap->refusal;
    }
    map->matter = matter;
    map->line_room = room;
    return SNOW_OK;
}

static bool has_pages(const snow_space_map *map)
{
    return map->pages + PAGES_OF_A_SITE <= map->page_room;
}

static bool has_lines(const snow_space_map *map)
{
    return map->lines + LINES_OF_A_SITE <= map->line_room;
}

bool snow_space_map_has_room(const snow_space_map *map)
{
    return has_pages(map) && has_lines(map);
}

snow_status snow_space_map_reserve(snow_space_map *map, snow_heap *heap)
{
    snow_status status = has_pages(map) ? SNOW_OK : add_pages(map, heap);
    if (status == SNOW_OK && !has_lines(map))
        status = add_lines(map, heap);
    return status;
}

/* There is room. */
static uint32_t take_page(snow_space_map *map, uint8_t class)
{
    for (int i = 0; i < 64; i++)
        atomic_init(&map->near[map->pages].block[i], class);
    atomic_init(&map->first_line[map->pages], 0);
    return map->pages++;
}

/* Those of a page. */
static uint32_t take_lines(snow_space_map *map)
{
    uint32_t first = map->lines;
    for (int i = 0; i < LINES_OF_A_PAGE; i++)
        snow_space_line_start(&map->line[first + (uint32_t)i]);
    if (map->keeps_matter)
        memset(&map->matter[first], 0, LINES_OF_A_PAGE * sizeof *map->matter);
    map->lines += LINES_OF_A_PAGE;
    return first;
}

static uint8_t class_of(const snow_exits *exits, int32_t free)
{
    return (uint8_t)snow_exits_class(exits, free + 1);
}

/* What each distance leaves free, at least. */
static void make_classes(snow_space_map *map, const snow_exits *exits)
{
    for (int d = 0; d <= NEAR_REACH + 1; d++)
        map->near_number[d] = d < SNOW_SPACE_LOOK ? (uint8_t)d : class_of(exits, 4 * (d - 1));
    take_page(map, SNOW_MAP_BEYOND);
    for (int d = 1; d <= FAR_REACH + 1; d++)
        take_page(map, class_of(exits, 16 * (d - 1)));
}

static void make_near(snow_space_map *map)
{
    for (int from = 0; from < 16; from++) {
        for (int side = 0; side < SIDES * SIDES; side++) {
            for (int place = 0; place < 16; place++) {
                int i = place % 4 + 4 * (side % SIDES - SIDES / 2) - from % 4;
                int j = place / 4 + 4 * (side / SIDES - SIDES / 2) - from / 4;
                map->near_in_layer[from][side][place] =
                    (int8_t)map->near_number[at_most(apart(i, j, 0), NEAR_REACH + 1)];
            }
        }
    }
}

snow_status snow_space_map_start(snow_space_map *map, snow_heap *heap, const snow_exits *exits, bool keeps_matter,
                                 snow_space_box box, snow_isa isa)
{
    *map = (snow_space_map){.keeps_matter = keeps_matter, .lower = snow_space_line_choose(isa)};
    map->prints = snow_heap_get_raw(heap, SNOW_SPACE_PRINTS, sizeof *map->prints);
    snow_status status = map->prints == NULL ? heap->refusal : cover(map, heap, box);
    if (status == SNOW_OK)
        status = snow_space_map_reserve(map, heap);
    if (status != SNOW_OK) {
        snow_space_map_end(map, heap);
        return status;
    }
    take_lines(map); /* where nothing is near */
    make_classes(map, exits);
    make_near(map);
    snow_space_prints_make(map->prints);
    return SNOW_OK;
}

void snow_space_map_end(snow_space_map *map, snow_heap *heap)
{
    snow_heap_put(heap, map->matter);
    snow_heap_put(heap, map->line);
    snow_heap_put(heap, (void *)map->first_line);
    snow_heap_put(heap, map->near);
    snow_heap_put(heap, map->prints);
    uncover(map, heap);
    *map = (snow_space_map){.landing = 0};
}

/* A box of tiles or lines round one of them, cut off where the map ends. */
typedef struct range {
    int32_t first[3];
    int32_t last[3];
} range;

static range tiles_round(const snow_space_box *box, int32_t i, int32_t j, int32_t k, int32_t reach)
{
    return (range){{at_least(i - reach, 0), at_least(j - reach, 0), at_least(k - reach, 0)},
                   {at_most(i + reach, (int32_t)box->columns - 1), at_most(j + reach, (int32_t)box->rows - 1),
                    at_most(k + reach, (int32_t)box->layers - 1)}};
}

static uint32_t tile_at(const snow_space_map *map, int32_t column, int32_t row, int32_t layer)
{
    return snow_space_map_number(map, (uint32_t)column, (uint32_t)row, (uint32_t)layer);
}

static void has_changed(snow_space_map *map, uint32_t tile)
{
    map->changed[tile] = (uint32_t)map->landing;
}

/* A tile's own page. */
static uint32_t page_of(snow_space_map *map, uint32_t tile)
{
    uint32_t page = SNOW_MAP_GET(map->tile[tile]);
    if (page >= SNOW_SPACE_SHARED)
        return page;
    page = take_page(map, map->near_number[NEAR_REACH + 1]);
    map->most[tile] = map->near_number[NEAR_REACH + 1];
    has_changed(map, tile);
    SNOW_MAP_PUT_ADDRESS(map->tile[tile], page);
    return page;
}

/* The first line of a tile's own page, to be written to. */
static uint32_t lines_of(snow_space_map *map, uint32_t tile)
{
    uint32_t page = page_of(map, tile);
    uint32_t first = SNOW_MAP_GET(map->first_line[page]);
    if (first == 0) {
        first = take_lines(map);
        SNOW_MAP_PUT_ADDRESS(map->first_line[page], first);
    }
    return first;
}

static bool holds_special(const snow_space_map *map, uint32_t tile)
{
    uint32_t page = SNOW_MAP_GET(map->tile[tile]);
    return page >= SNOW_SPACE_SHARED && memchr((const void *)&map->near[page], 0, sizeof *map->near) != NULL;
}

static uint8_t greatest(sixteen numbers)
{
    int8_t most = 0;
    for (int i = 0; i < 16; i++)
        most = numbers[i] > most ? numbers[i] : most;
    return (uint8_t)most;
}

/* A layer of 4 x 4 blocks at a time: numbers in a layer are known, and none is
   less than that of the layers. */
static void lower_page(snow_space_map *map, uint32_t tile, const int8_t *near_in_layer, int32_t layers)
{
    snow_space_near *near = &map->near[page_of(map, tile)];
    enum { WORDS = 16 / sizeof near->word[0] };
    sixteen in_layer = get(near_in_layer);
    sixteen most = {0};
    sixteen lowers = {0};
    sixteen now[4];
    for (int layer = 0; layer < 4; layer++) {
        sixteen known = get(&near->word[layer * WORDS]);
        int8_t number = (int8_t)map->near_number[at_most(magnitude(layers + layer), NEAR_REACH + 1)];
        sixteen least = (sixteen){0} + number;
        now[layer] = lesser(known, greater(in_layer, least));
        most = greater(most, now[layer]);
        lowers |= now[layer] ^ known;
    }
    if (!has_any(lowers))
        return;
    for (int layer = 0; layer < 4; layer++)
        put(&near->word[layer * WORDS], now[layer]);
    map->most[tile] = greatest(most);
    has_changed(map, tile);
}

/* How far a block is from the blocks of a tile, in one direction. */
static int32_t apart_from_tile(int32_t block, int32_t tile)
{
    return at_least(at_least(4 * tile - block, block - 4 * tile - 3), 0);
}

/* The block (i, j, k) has got its first special site. */
static void spread_near(snow_space_map *map, int32_t i, int32_t j, int32_t k)
{
    range tiles = tiles_round(&map->box, i / 4, j / 4, k / 4, SIDES / 2);
    for (int32_t z = tiles.first[2]; z <= tiles.last[2]; z++) {
        for (int32_t y = tiles.first[1]; y <= tiles.last[1]; y++) {
            int32_t across = at_least(apart_from_tile(j, y), apart_from_tile(k, z));
            uint32_t tile = tile_at(map, tiles.first[0], y, z);
            for (int32_t x = tiles.first[0]; x <= tiles.last[0]; x++, tile++) {
                int32_t side = (y - j / 4 + SIDES / 2) * SIDES + x - i / 4 + SIDES / 2;
                if (map->most[tile] > map->near_number[at_least(apart_from_tile(i, x), across)])
                    lower_page(map, tile, map->near_in_layer[j % 4 * 4 + i % 4][side], 4 * z - k);
            }
        }
    }
}

/* The tile (i, j, k) has got its first special site. */
static void spread_tile(snow_space_map *map, int32_t i, int32_t j, int32_t k)
{
    range all = tiles_round(&map->box, i, j, k, FAR_REACH);
    for (int32_t z = all.first[2]; z <= all.last[2]; z++) {
        for (int32_t y = all.first[1]; y <= all.last[1]; y++) {
            int32_t across = apart(0, y - j, z - k);
            uint32_t tile = tile_at(map, all.first[0], y, z);
            for (int32_t x = all.first[0]; x <= all.last[0]; x++, tile++) {
                uint32_t distance = (uint32_t)at_least(magnitude(x - i), across);
                uint32_t page = SNOW_MAP_GET(map->tile[tile]);
                if (page > distance && page < SNOW_SPACE_SHARED) {
                    SNOW_MAP_PUT(map->tile[tile], distance);
                    has_changed(map, tile);
                }
            }
        }
    }
}

/* The old box as tiles of the new one. */
static range place_of(const snow_space_map *map, const snow_space_box *old)
{
    int32_t x = (old->x - map->box.x) / 16;
    int32_t y = (old->y - map->box.y) / 16;
    int32_t z = (old->z - map->box.z) / 16;
    return (range){{x, y, z},
                   {x + (int32_t)old->columns - 1, y + (int32_t)old->rows - 1, z + (int32_t)old->layers - 1}};
}

/* What was known stays true. */
static void take_over(snow_space_map *map, const snow_space_map *old)
{
    range inner = place_of(map, &old->box);
    for (uint32_t k = 0; k < old->box.layers; k++) {
        for (uint32_t j = 0; j < old->box.rows; j++) {
            uint32_t from = snow_space_map_number(old, 0, j, k);
            uint32_t to = tile_at(map, inner.first[0], inner.first[1] + (int32_t)j, inner.first[2] + (int32_t)k);
            memcpy(&map->most[to], &old->most[from], old->box.columns);
            for (uint32_t i = 0; i < old->box.columns; i++)
                SNOW_MAP_PUT(map->tile[to + i], SNOW_MAP_GET(old->tile[from + i]));
        }
    }
}

static bool is_near_side(const range *inner, int32_t i, int32_t j, int32_t k)
{
    const int32_t place[3] = {i, j, k};
    int32_t least = FAR_REACH;
    for (int side = 0; side < 3; side++)
        least = at_most(least, at_most(place[side] - inner->first[side], inner->last[side] - place[side]));
    return least < FAR_REACH;
}

/* What special tiles near the old sides say about what lies beyond. */
static void spread_beyond(snow_space_map *map, const snow_space_box *old)
{
    range inner = place_of(map, old);
    for (int32_t z = inner.first[2]; z <= inner.last[2]; z++)
        for (int32_t y = inner.first[1]; y <= inner.last[1]; y++)
            for (int32_t x = inner.first[0]; x <= inner.last[0]; x++)
                if (is_near_side(&inner, x, y, z) && holds_special(map, tile_at(map, x, y, z)))
                    spread_tile(map, x, y, z);
}

snow_status snow_space_map_widen(snow_space_map *map, snow_heap *heap, snow_space_box box)
{
    snow_space_map old = *map;
    snow_status status = cover(map, heap, box);
    if (status != SNOW_OK)
        return status;
    take_over(map, &old);
    uncover(&old, heap);
    spread_beyond(map, &old.box);
    return SNOW_OK;
}

static bool is_covered(const snow_space_map *map, int32_t u, int32_t v, int32_t w)
{
    return (uint32_t)u / 16 < map->box.columns && (uint32_t)v / 16 < map->box.rows &&
           (uint32_t)w / 16 < map->box.layers;
}

static void add_special(snow_space_map *map, int32_t u, int32_t v, int32_t w)
{
    if (!is_covered(map, u, v, w))
        return;
    int32_t i = u / 4;
    int32_t j = v / 4;
    int32_t k = w / 4;
    uint32_t tile = tile_at(map, i / 4, j / 4, k / 4);
    uint32_t page = SNOW_MAP_GET(map->tile[tile]);
    if (SNOW_MAP_GET(map->near[page].block[snow_space_place((uint32_t)i, (uint32_t)j, (uint32_t)k)]) == 0)
        return;
    bool is_first = !holds_special(map, tile);
    spread_near(map, i, j, k);
    if (is_first)
        spread_tile(map, i / 4, j / 4, k / 4);
}

/* The step that leads into another block; 0 if there is none. */
static int32_t to_next_block(int32_t u)
{
    uint32_t place = (uint32_t)u % 4;
    return place == 0 ? -1 : place == 3 ? 1 : 0;
}

/* The filled site, and those next to it where that is another block. */
static void add_specials(snow_space_map *map, int32_t u, int32_t v, int32_t w)
{
    add_special(map, u, v, w);
    if (to_next_block(u) != 0)
        add_special(map, u + to_next_block(u), v, w);
    if (to_next_block(v) != 0)
        add_special(map, u, v + to_next_block(v), w);
    if (to_next_block(w) != 0)
        add_special(map, u, v, w + to_next_block(w));
}

static int32_t floor_of(int32_t x, int32_t unit)
{
    return (x + unit * 16) / unit - 16; /* a floor lies at −1 */
}

static range lines_round(const snow_space_map *map, int32_t u, int32_t v, int32_t w)
{
    enum { REACH = SNOW_SPACE_SITES + 1 };
    const snow_space_box *box = &map->box;
    return (range){{at_least(floor_of(u - REACH, 8), 0), at_least(floor_of(v - REACH, 8), 0),
                    at_least(floor_of(w - REACH, 8), 0)},
                   {at_most(floor_of(u + REACH, 8), 2 * (int32_t)box->columns - 1),
                    at_most(floor_of(v + REACH, 8), 2 * (int32_t)box->rows - 1),
                    at_most(floor_of(w + REACH, 8), 2 * (int32_t)box->layers - 1)}};
}

/* What lines say, those that a filled site may change. */
static void lower_lines(snow_space_map *map, int32_t u, int32_t v, int32_t w)
{
    const snow_space_print *print = snow_space_print_of(map->prints, (uint32_t)u, (uint32_t)v, (uint32_t)w);
    range all = lines_round(map, u, v, w);
    for (int32_t k = all.first[2]; k <= all.last[2]; k++) {
        int layers = 4 * k - floor_of(w, 2);
        for (int32_t j = all.first[1]; j <= all.last[1]; j++) {
            int rows = 4 * j - floor_of(v, 2);
            uint32_t row = tile_at(map, 0, j / 2, k / 2);
            for (int32_t i = all.first[0]; i <= all.last[0]; i++) {
                uint32_t tile = row + (uint32_t)i / 2;
                uint32_t line = lines_of(map, tile) + snow_space_octant((uint32_t)i, (uint32_t)j, (uint32_t)k);
                /* Where matter is kept walkers are told of what is filled, too. */
                if (map->lower(&map->line[line], print, i - floor_of(u, 8), rows, layers) || map->keeps_matter)
                    has_changed(map, tile);
            }
        }
    }
}

static void keep_matter(snow_space_map *map, uint32_t u, uint32_t v, uint32_t w, bool obstacle)
{
    uint32_t tile = snow_space_map_number(map, u / 16, v / 16, w / 16);
    snow_space_matter *matter = &map->matter[lines_of(map, tile) + snow_space_octant(u / 8, v / 8, w / 8)];
    uint32_t place = snow_space_place(u, v, w);
    uint32_t block = snow_space_octant(u / 4, v / 4, w / 4);
    _Atomic uint32_t *word = &(obstacle ? matter->obstacle : matter->filled)[block][place / 32];
    SNOW_MAP_PUT(*word, SNOW_MAP_GET(*word) | UINT32_C(1) << place % 32);
}

void snow_space_map_add(snow_space_map *map, int32_t x, int32_t y, int32_t z, bool obstacle)
{
    int32_t u = x - map->box.x;
    int32_t v = y - map->box.y;
    int32_t w = z - map->box.z;
    add_specials(map, u, v, w);
    lower_lines(map, u, v, w);
    if (map->keeps_matter && is_covered(map, u, v, w))
        keep_matter(map, (uint32_t)u, (uint32_t)v, (uint32_t)w, obstacle);
}
