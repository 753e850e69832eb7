#include "aggregate/space_map.h"

#include <string.h>

enum {
    NEAR_REACH = 4, /* blocks; beyond: 5 */
    TILE_REACH = 5, /* tiles, and cubes of tiles */
    BEYOND = 6
};

static int64_t magnitude(int64_t x)
{
    return x < 0 ? -x : x;
}

static int64_t at_least(int64_t x, int64_t least)
{
    return x < least ? least : x;
}

static int64_t at_most(int64_t x, int64_t most)
{
    return x > most ? most : x;
}

static int64_t apart(int64_t i, int64_t j, int64_t k)
{
    return at_least(at_least(magnitude(i), magnitude(j)), magnitude(k));
}

/* Distance to the special sites that a filled site at 0 makes. */
static int64_t distance_to_contact(int64_t x, int64_t y, int64_t z)
{
    int64_t least = apart(x, y, z);
    for (int step = -1; step <= 1; step += 2) {
        least = at_most(least, apart(x - step, y, z));
        least = at_most(least, apart(x, y - step, z));
        least = at_most(least, apart(x, y, z - step));
    }
    return least;
}

static snow_space_word print_of(int place, int block)
{
    snow_space_word word = {0, 0};
    for (int bit = 0; bit < 64; bit++) {
        int x = bit % 4 + 4 * (block % 3 - 1) - place % 4;
        int y = bit / 4 % 4 + 4 * (block / 3 % 3 - 1) - place / 4 % 4;
        int z = bit / 16 + 4 * (block / 9 - 1) - place / 16;
        uint64_t code = (uint64_t)(3 - at_most(distance_to_contact(x, y, z), 3));
        word.upper |= (code >> 1) << bit;
        word.lower |= (code & 1) << bit;
    }
    return word;
}

/* The greater code of each site. */
static snow_space_word greater(snow_space_word a, snow_space_word b)
{
    uint64_t lower = (a.lower & (a.upper | ~b.upper)) | (b.lower & (b.upper | ~a.upper));
    return (snow_space_word){a.upper | b.upper, lower};
}

static size_t tiles_of(snow_space_box box)
{
    return (size_t)box.columns * box.rows * box.layers;
}

static snow_status cover(snow_space_map *map, snow_heap *heap, snow_space_box box)
{
    _Atomic uintptr_t *tile = snow_heap_get_raw(heap, tiles_of(box), sizeof *tile);
    _Atomic uint8_t *cube = snow_heap_get_raw(heap, tiles_of(box) / 64, 1);
    if (tile == NULL || cube == NULL) {
        snow_heap_put(heap, cube);
        snow_heap_put(heap, tile);
        return heap->refusal;
    }
    for (size_t i = 0; i < tiles_of(box); i++)
        atomic_init(&tile[i], BEYOND);
    for (size_t i = 0; i < tiles_of(box) / 64; i++)
        atomic_init(&cube[i], BEYOND);
    map->box = box;
    map->tile = tile;
    map->cube = cube;
    return SNOW_OK;
}

static void make_distances(snow_space_map *map)
{
    for (int from = 0; from < 16; from++) {
        for (int side = 0; side < 9; side++) {
            for (int place = 0; place < 16; place++) {
                int i = place % 4 + 4 * (side % 3 - 1) - from % 4;
                int j = place / 4 + 4 * (side / 3 - 1) - from / 4;
                int64_t d = apart(i, j, 0);
                map->apart[from][side][place] = (uint8_t)at_most(d, NEAR_REACH + 1);
            }
        }
    }
}

snow_status snow_space_map_start(snow_space_map *map, snow_heap *heap, const snow_exits *exits, bool keeps_matter,
                                 snow_space_box box)
{
    *map = (snow_space_map){
        .pages = {.item = sizeof(snow_space_page)},
        .lines = {.item = keeps_matter ? sizeof(snow_space_matter) : sizeof(snow_space_line)},
        .keeps_matter = keeps_matter,
    };
    for (int d = 0; d <= BEYOND; d++) {
        map->tile_class[d] = (uint8_t)snow_exits_class(exits, d <= 1 ? 4 * NEAR_REACH + 1 : 16 * (d - 1) + 1);
        map->cube_class[d] = (uint8_t)snow_exits_class(exits, d <= 1 ? 16 * TILE_REACH + 1 : 64 * (d - 1) + 1);
    }
    make_distances(map);
    map->print = snow_heap_get_raw(heap, 64, sizeof *map->print);
    snow_status status = map->print == NULL ? heap->refusal : cover(map, heap, box);
    if (status != SNOW_OK) {
        snow_space_map_end(map, heap);
        return status;
    }
    for (int place = 0; place < 64; place++)
        for (int block = 0; block < 27; block++)
            map->print[place][block] = print_of(place, block);
    return SNOW_OK;
}

void snow_space_map_end(snow_space_map *map, snow_heap *heap)
{
    snow_pool_end(&map->lines, heap);
    snow_pool_end(&map->pages, heap);
    snow_heap_put(heap, map->print);
    snow_heap_put(heap, map->cube);
    snow_heap_put(heap, map->tile);
    map->print = NULL;
    map->cube = NULL;
    map->tile = NULL;
}

static _Atomic uintptr_t *tile_at(snow_space_map *map, int64_t column, int64_t row, int64_t layer)
{
    return &map->tile[((size_t)layer * map->box.rows + (size_t)row) * map->box.columns + (size_t)column];
}

static _Atomic uint8_t *cube_at(snow_space_map *map, int64_t column, int64_t row, int64_t layer)
{
    size_t line = (size_t)layer * (map->box.rows / 4) + (size_t)row;
    return &map->cube[line * (map->box.columns / 4) + (size_t)column];
}

/* Where nothing is near, and nothing is. */
static snow_space_matter nothing;

static bool holds_special(const snow_space_page *page)
{
    return memchr((const void *)page->near, 0, sizeof page->near) != NULL;
}

/* The page with the block (i, j, k). */
static snow_space_page *page_with(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    _Atomic uintptr_t *entry = tile_at(map, i / 4, j / 4, k / 4);
    uintptr_t known = SNOW_MAP_GET(*entry);
    if (known > BEYOND)
        return (snow_space_page *)known;
    snow_space_page *page = snow_pool_take(&map->pages);
    for (int place = 0; place < 64; place++)
        atomic_init(&page->near[place], NEAR_REACH + 1);
    for (int octant = 0; octant < 8; octant++)
        atomic_init(&page->line[octant], &nothing.line);
    SNOW_MAP_PUT_ADDRESS(*entry, (uintptr_t)page);
    return page;
}

static _Atomic uint8_t *near_at(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    return &page_with(map, i, j, k)->near[snow_space_place((uint32_t)i, (uint32_t)j, (uint32_t)k)];
}

/* A box of blocks, tiles or cubes round one of them, cut off where the map ends. */
typedef struct range {
    int64_t first[3];
    int64_t last[3];
} range;

static range range_round(int64_t i, int64_t j, int64_t k, int64_t reach, const snow_space_box *box, int64_t parts,
                         int64_t wholes)
{
    return (range){{at_least(i - reach, 0), at_least(j - reach, 0), at_least(k - reach, 0)},
                   {at_most(i + reach, box->columns * parts / wholes - 1),
                    at_most(j + reach, box->rows * parts / wholes - 1),
                    at_most(k + reach, box->layers * parts / wholes - 1)}};
}

/* A layer of 4 x 4 blocks at a time: distances in a layer are known, and none is
   less than that of the layers. */
static void lower_page(snow_space_page *page, const uint8_t *apart_in_layer, int64_t first_layer,
                       int64_t k)
{
    for (int layer = 0; layer < 4; layer++) {
        uint8_t least = (uint8_t)magnitude(first_layer + layer - k);
        if (least > NEAR_REACH)
            continue;
        _Atomic uint8_t *near = page->near + 16 * layer;
        for (int place = 0; place < 16; place++) {
            uint8_t d = apart_in_layer[place] > least ? apart_in_layer[place] : least;
            uint8_t known = SNOW_MAP_GET(near[place]);
            SNOW_MAP_PUT(near[place], known < d ? known : d);
        }
    }
}

/* The block (i, j, k) has got its first special site. */
static void spread_near(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    range tiles = range_round(i / 4, j / 4, k / 4, 1, &map->box, 1, 1);
    for (int64_t z = tiles.first[2]; z <= tiles.last[2]; z++) {
        for (int64_t y = tiles.first[1]; y <= tiles.last[1]; y++) {
            for (int64_t x = tiles.first[0]; x <= tiles.last[0]; x++) {
                int64_t side = (y - j / 4 + 1) * 3 + x - i / 4 + 1;
                lower_page(page_with(map, 4 * x, 4 * y, 4 * z), map->apart[j % 4 * 4 + i % 4][side], 4 * z, k);
            }
        }
    }
}

static void spread_cube(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    range all = range_round(i, j, k, TILE_REACH, &map->box, 1, 4);
    for (int64_t z = all.first[2]; z <= all.last[2]; z++) {
        for (int64_t y = all.first[1]; y <= all.last[1]; y++) {
            for (int64_t x = all.first[0]; x <= all.last[0]; x++) {
                _Atomic uint8_t *known = cube_at(map, x, y, z);
                SNOW_MAP_PUT(*known, (uint8_t)at_most(SNOW_MAP_GET(*known), apart(x - i, y - j, z - k)));
            }
        }
    }
}

/* The tile (i, j, k) has got its first special site. */
static void spread_tile(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    range all = range_round(i, j, k, TILE_REACH, &map->box, 1, 1);
    for (int64_t z = all.first[2]; z <= all.last[2]; z++) {
        for (int64_t y = all.first[1]; y <= all.last[1]; y++) {
            for (int64_t x = all.first[0]; x <= all.last[0]; x++) {
                _Atomic uintptr_t *entry = tile_at(map, x, y, z);
                uintptr_t known = SNOW_MAP_GET(*entry);
                uintptr_t d = (uintptr_t)apart(x - i, y - j, z - k);
                if (known <= BEYOND && d < known)
                    SNOW_MAP_PUT(*entry, d);
            }
        }
    }
    map->far_changes++;
    if (SNOW_MAP_GET(*cube_at(map, i / 4, j / 4, k / 4)) != 0)
        spread_cube(map, i / 4, j / 4, k / 4);
}

/* Calls spread_tile() for each tile that holds a special site. */
static void spread_all_tiles(snow_space_map *map)
{
    for (int64_t z = 0; z < map->box.layers; z++) {
        for (int64_t y = 0; y < map->box.rows; y++) {
            for (int64_t x = 0; x < map->box.columns; x++) {
                uintptr_t entry = SNOW_MAP_GET(*tile_at(map, x, y, z));
                if (entry > BEYOND && holds_special((const snow_space_page *)entry))
                    spread_tile(map, x, y, z);
            }
        }
    }
}

snow_status snow_space_map_widen(snow_space_map *map, snow_heap *heap, snow_space_box box)
{
    snow_space_map old = *map;
    snow_status status = cover(map, heap, box);
    if (status != SNOW_OK)
        return status;
    int64_t shift_x = ((int64_t)old.box.x - box.x) / 16;
    int64_t shift_y = ((int64_t)old.box.y - box.y) / 16;
    int64_t shift_z = ((int64_t)old.box.z - box.z) / 16;
    for (int64_t z = 0; z < old.box.layers; z++) {
        for (int64_t y = 0; y < old.box.rows; y++) {
            for (int64_t x = 0; x < old.box.columns; x++) {
                uintptr_t entry = SNOW_MAP_GET(*tile_at(&old, x, y, z));
                if (entry > BEYOND)
                    SNOW_MAP_PUT(*tile_at(map, x + shift_x, y + shift_y, z + shift_z), entry);
            }
        }
    }
    spread_all_tiles(map);
    snow_heap_put(heap, old.cube);
    snow_heap_put(heap, old.tile);
    return SNOW_OK;
}

snow_status snow_space_map_reserve(snow_space_map *map, snow_heap *heap)
{
    enum { BLOCKS = 27, TILES = 27 };
    snow_status status = snow_pool_reserve(&map->pages, heap, TILES);
    return status == SNOW_OK ? snow_pool_reserve(&map->lines, heap, BLOCKS) : status;
}

static void add_special(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    if (SNOW_MAP_GET(*near_at(map, i, j, k)) == 0)
        return;
    bool is_first = !holds_special(page_with(map, i, j, k));
    spread_near(map, i, j, k);
    if (is_first)
        spread_tile(map, i / 4, j / 4, k / 4);
}

/* The line with the block (i, j, k). */
static snow_space_line *line_with(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    snow_space_page *page = page_with(map, i, j, k);
    uint32_t octant = snow_space_octant((uint32_t)i / 2, (uint32_t)j / 2, (uint32_t)k / 2);
    snow_space_line *line = SNOW_MAP_GET(page->line[octant]);
    if (line == &nothing.line) {
        line = snow_pool_take(&map->lines);
        SNOW_MAP_PUT_ADDRESS(page->line[octant], line);
    }
    return line;
}

static void add_print(snow_space_map *map, int64_t i, int64_t j, int64_t k, snow_space_word print)
{
    if ((print.upper | print.lower) == 0 || i < 0 || j < 0 || k < 0 || i >= (int64_t)map->box.columns * 4 ||
        j >= (int64_t)map->box.rows * 4 || k >= (int64_t)map->box.layers * 4)
        return;
    if ((print.upper & print.lower) != 0)
        add_special(map, i, j, k);
    uint32_t octant = snow_space_octant((uint32_t)i, (uint32_t)j, (uint32_t)k);
    snow_space_shared_word *word = &line_with(map, i, j, k)->word[octant];
    for (int half = 0; half < 2; half++) {
        snow_space_word known = {SNOW_MAP_GET(word->upper[half]), SNOW_MAP_GET(word->lower[half])};
        known = greater(known, (snow_space_word){print.upper >> 32 * half, print.lower >> 32 * half});
        SNOW_MAP_PUT(word->upper[half], (uint32_t)known.upper);
        SNOW_MAP_PUT(word->lower[half], (uint32_t)known.lower);
    }
}

void snow_space_map_add(snow_space_map *map, int32_t x, int32_t y, int32_t z, bool obstacle)
{
    int64_t u = (int64_t)x - map->box.x;
    int64_t v = (int64_t)y - map->box.y;
    int64_t w = (int64_t)z - map->box.z;
    int64_t i = (u + 4) / 4 - 1; /* −1: a floor */
    int64_t j = (v + 4) / 4 - 1;
    int64_t k = (w + 4) / 4 - 1;
    uint32_t place = snow_space_place((uint32_t)(u + 4), (uint32_t)(v + 4), (uint32_t)(w + 4));
    for (int block = 0; block < 27; block++)
        add_print(map, i + block % 3 - 1, j + block / 3 % 3 - 1, k + block / 9 - 1, map->print[place][block]);
    if (!map->keeps_matter || u < 0 || v < 0 || w < 0 || u >= (int64_t)map->box.columns * 16 ||
        v >= (int64_t)map->box.rows * 16 || w >= (int64_t)map->box.layers * 16)
        return;
    snow_space_matter *matter = (snow_space_matter *)line_with(map, i, j, k);
    uint32_t octant = snow_space_octant((uint32_t)i, (uint32_t)j, (uint32_t)k);
    _Atomic uint32_t *word = &(obstacle ? matter->obstacle : matter->filled)[octant][place / 32];
    SNOW_MAP_PUT(*word, SNOW_MAP_GET(*word) | UINT32_C(1) << place % 32);
}
