#include "aggregate/space_map.h"

#include <string.h>

enum {
    NEAR_REACH = SNOW_SPACE_NEAR,
    FAR_REACH = SNOW_SPACE_FAR /* tiles, and cubes of tiles */
};

snow_space_matter snow_space_nothing;

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

static size_t cubes_of(snow_space_box box)
{
    return tiles_of(box) / 64;
}

static size_t tile_index(const snow_space_box *box, int64_t column, int64_t row, int64_t layer)
{
    return ((size_t)layer * box->rows + (size_t)row) * box->columns + (size_t)column;
}

/* Of the cube with a tile. */
static size_t cube_index(const snow_space_box *box, int64_t column, int64_t row, int64_t layer)
{
    return ((size_t)(layer / 4) * (box->rows / 4) + (size_t)(row / 4)) * (box->columns / 4) + (size_t)(column / 4);
}

static void start_page(snow_space_page *page, uint8_t class, uint64_t landing)
{
    page->changed = landing;
    for (int i = 0; i < 64; i++)
        atomic_init(&page->near[i], class);
    for (int i = 0; i < 8; i++)
        atomic_init(&page->line[i], &snow_space_nothing.line);
}

static snow_status cover(snow_space_map *map, snow_heap *heap, snow_space_box box)
{
    snow_space_page *_Atomic *tile = snow_heap_get_raw(heap, tiles_of(box), sizeof *tile);
    snow_space_page *cube = snow_heap_get_raw(heap, cubes_of(box), sizeof *cube);
    uint8_t *cube_distance = snow_heap_get_raw(heap, cubes_of(box), 1);
    if (tile == NULL || cube == NULL || cube_distance == NULL) {
        snow_heap_put(heap, cube_distance);
        snow_heap_put(heap, cube);
        snow_heap_put(heap, tile);
        return heap->refusal;
    }
    memset(cube_distance, FAR_REACH + 1, cubes_of(box));
    for (size_t i = 0; i < cubes_of(box); i++)
        start_page(&cube[i], map->cube_class[FAR_REACH + 1], 0);
    for (uint32_t layer = 0; layer < box.layers; layer++)
        for (uint32_t row = 0; row < box.rows; row++)
            for (uint32_t column = 0; column < box.columns; column++)
                atomic_init(&tile[tile_index(&box, column, row, layer)], &cube[cube_index(&box, column, row, layer)]);
    map->box = box;
    map->tile = tile;
    map->cube = cube;
    map->cube_distance = cube_distance;
    return SNOW_OK;
}

static void uncover(const snow_space_map *map, snow_heap *heap)
{
    snow_heap_put(heap, map->cube_distance);
    snow_heap_put(heap, map->cube);
    snow_heap_put(heap, map->tile);
}

/* How far the tile is that such a page stands for; 0: a page of its own. */
static uintptr_t distance_of(const snow_space_map *map, const snow_space_page *page)
{
    uintptr_t far = ((uintptr_t)page - (uintptr_t)map->far) / sizeof *page;
    uintptr_t cube = ((uintptr_t)page - (uintptr_t)map->cube) / sizeof *page;
    return far <= FAR_REACH ? far : cube < cubes_of(map->box) ? FAR_REACH + 1 : 0;
}

static void make_near(snow_space_map *map)
{
    for (int from = 0; from < 16; from++) {
        for (int side = 0; side < 9; side++) {
            for (int place = 0; place < 16; place++) {
                int i = place % 4 + 4 * (side % 3 - 1) - from % 4;
                int j = place / 4 + 4 * (side / 3 - 1) - from / 4;
                map->near_in_layer[from][side][place] = map->near[at_most(apart(i, j, 0), NEAR_REACH + 1)];
            }
        }
    }
}

static uint8_t class_of(const snow_exits *exits, int64_t free)
{
    return (uint8_t)snow_exits_class(exits, free + 1);
}

/* What each distance leaves free, at least. */
static void make_classes(snow_space_map *map, const snow_exits *exits)
{
    for (int d = 0; d <= NEAR_REACH + 1; d++)
        map->near[d] = d < 2 ? (uint8_t)d : class_of(exits, 4 * (d - 1));
    for (int d = 1; d <= FAR_REACH; d++)
        start_page(&map->far[d], class_of(exits, 16 * (d - 1)), 0);
    for (int d = 0; d <= FAR_REACH + 1; d++)
        map->cube_class[d] = class_of(exits, d <= 1 ? 16 * FAR_REACH : 64 * (d - 1));
}

snow_status snow_space_map_start(snow_space_map *map, snow_heap *heap, const snow_exits *exits, bool keeps_matter,
                                 snow_space_box box)
{
    *map = (snow_space_map){
        .pages = {.item = sizeof(snow_space_page)},
        .lines = {.item = keeps_matter ? sizeof(snow_space_matter) : sizeof(snow_space_line)},
        .keeps_matter = keeps_matter,
    };
    start_page(&map->outside, SNOW_MAP_BEYOND, 0);
    make_classes(map, exits);
    make_near(map);
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
    uncover(map, heap);
    map->print = NULL;
    map->cube_distance = NULL;
    map->cube = NULL;
    map->tile = NULL;
}

static snow_space_page *_Atomic *tile_at(snow_space_map *map, int64_t column, int64_t row, int64_t layer)
{
    return &map->tile[tile_index(&map->box, column, row, layer)];
}

static bool holds_special(const snow_space_page *page)
{
    return memchr((const void *)page->near, 0, sizeof page->near) != NULL;
}

/* The page with the block (i, j, k). */
static snow_space_page *page_with(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    snow_space_page *_Atomic *entry = tile_at(map, i / 4, j / 4, k / 4);
    snow_space_page *page = SNOW_MAP_GET(*entry);
    if (distance_of(map, page) == 0)
        return page;
    page = snow_pool_take(&map->pages);
    start_page(page, map->near[NEAR_REACH + 1], map->landing);
    SNOW_MAP_PUT_ADDRESS(*entry, page);
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

/* A layer of 4 x 4 blocks at a time: classes in a layer are known, and none is
   less than that of the layers. */
static void lower_page(snow_space_map *map, snow_space_page *page, const uint8_t *near_in_layer, int64_t layers)
{
    bool lowers = false;
    for (int layer = 0; layer < 4; layer++) {
        int64_t d = magnitude(layers + layer);
        if (d > NEAR_REACH)
            continue;
        uint8_t least = map->near[d];
        _Atomic uint8_t *near = page->near + 16 * layer;
        for (int place = 0; place < 16; place++) {
            uint8_t bound = near_in_layer[place] > least ? near_in_layer[place] : least;
            uint8_t known = SNOW_MAP_GET(near[place]);
            lowers |= bound < known;
            SNOW_MAP_PUT(near[place], known < bound ? known : bound);
        }
    }
    if (lowers)
        page->changed = map->landing;
}

/* The block (i, j, k) has got its first special site. */
static void spread_near(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    range tiles = range_round(i / 4, j / 4, k / 4, 1, &map->box, 1, 1);
    for (int64_t z = tiles.first[2]; z <= tiles.last[2]; z++) {
        for (int64_t y = tiles.first[1]; y <= tiles.last[1]; y++) {
            for (int64_t x = tiles.first[0]; x <= tiles.last[0]; x++) {
                int64_t side = (y - j / 4 + 1) * 3 + x - i / 4 + 1;
                snow_space_page *page = page_with(map, 4 * x, 4 * y, 4 * z);
                lower_page(map, page, map->near_in_layer[j % 4 * 4 + i % 4][side], 4 * z - k);
            }
        }
    }
}

static void spread_cube(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    range all = range_round(i, j, k, FAR_REACH, &map->box, 1, 4);
    for (int64_t z = all.first[2]; z <= all.last[2]; z++) {
        for (int64_t y = all.first[1]; y <= all.last[1]; y++) {
            for (int64_t x = all.first[0]; x <= all.last[0]; x++) {
                int64_t d = apart(x - i, y - j, z - k);
                size_t index = cube_index(&map->box, 4 * x, 4 * y, 4 * z);
                if (d >= map->cube_distance[index])
                    continue;
                map->cube_distance[index] = (uint8_t)d;
                for (int place = 0; place < 64; place++)
                    SNOW_MAP_PUT(map->cube[index].near[place], map->cube_class[d]);
                map->cube[index].changed = map->landing;
            }
        }
    }
}

/* The tile (i, j, k) has got its first special site. */
static void spread_tile(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    range all = range_round(i, j, k, FAR_REACH, &map->box, 1, 1);
    for (int64_t z = all.first[2]; z <= all.last[2]; z++) {
        for (int64_t y = all.first[1]; y <= all.last[1]; y++) {
            for (int64_t x = all.first[0]; x <= all.last[0]; x++) {
                snow_space_page *_Atomic *entry = tile_at(map, x, y, z);
                snow_space_page *page = SNOW_MAP_GET(*entry);
                uintptr_t d = (uintptr_t)apart(x - i, y - j, z - k);
                if (d >= distance_of(map, page))
                    continue;
                map->far[d].changed = map->landing;
                SNOW_MAP_PUT_ADDRESS(*entry, &map->far[d]);
            }
        }
    }
    if (map->cube_distance[cube_index(&map->box, i, j, k)] != 0)
        spread_cube(map, i / 4, j / 4, k / 4);
}

/* Calls spread_tile() for each tile that holds a special site. */
static void spread_all_tiles(snow_space_map *map)
{
    for (int64_t z = 0; z < map->box.layers; z++) {
        for (int64_t y = 0; y < map->box.rows; y++) {
            for (int64_t x = 0; x < map->box.columns; x++) {
                const snow_space_page *page = SNOW_MAP_GET(*tile_at(map, x, y, z));
                if (distance_of(map, page) == 0 && holds_special(page))
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
                snow_space_page *page = SNOW_MAP_GET(*tile_at(&old, x, y, z));
                if (distance_of(&old, page) == 0)
                    SNOW_MAP_PUT(*tile_at(map, x + shift_x, y + shift_y, z + shift_z), page);
            }
        }
    }
    uncover(&old, heap);
    spread_all_tiles(map);
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
    if (line == &snow_space_nothing.line) {
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
    page_with(map, i, j, k)->changed = map->landing;
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
