#include "aggregate/space_map.h"

#include <string.h>

enum {
    LINES_REACH = SNOW_SPACE_SITES,
    NEAR_REACH = SNOW_SPACE_NEAR,
    FAR_REACH = SNOW_SPACE_FAR,
    CUBES_REACH = SNOW_SPACE_CUBES,
    SIDES = SNOW_SPACE_SIDES,
    PAIRS = SNOW_SPACE_PAIRS,
    ROWS = SNOW_SPACE_ROWS,
    UNKNOWN = (LINES_REACH + 1) << 8 /* of a pair that is further away */
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

/* What a line says of a pair, where the filled site lies so far from the pair's first one. */
static int16_t print_of_pair(int64_t x, int64_t y, int64_t z)
{
    int64_t distance[8];
    int64_t least = LINES_REACH + 1;
    for (int site = 0; site < 8; site++) {
        distance[site] = distance_to_contact(x - site % 2, y - site / 2 % 2, z - site / 4);
        least = at_most(least, distance[site]);
    }
    int print = (int)least << 8;
    for (int site = 0; site < 8 && least <= LINES_REACH; site++)
        print |= (distance[site] > least) << site;
    return (int16_t)print;
}

static void make_print(snow_space_print *print, int place)
{
    for (int line = 0; line < SNOW_SPACE_LINES; line++) {
        for (int layer = 0; layer < PAIRS; layer++) {
            for (int row = 0; row < ROWS; row++) {
                for (int i = 0; i < 4; i++) {
                    int x = place % 8 - 2 * (4 * (line - 1) + i);
                    int y = place / 8 % 2 - 2 * (row - ROWS / 2);
                    int z = place / 16 - 2 * (layer - PAIRS / 2);
                    print->pair[line][layer][row][i] = print_of_pair(x, y, z);
                }
            }
        }
    }
}

typedef uint8_t sixteen __attribute__((vector_size(16))); /* blocks of a layer of a page */
typedef int16_t eight __attribute__((vector_size(16)));   /* pairs of two rows of a line */

/* Nobody else writes, so all may be read as plain numbers. */
static sixteen get_sixteen(const void *from)
{
    sixteen numbers;
    memcpy(&numbers, from, sizeof numbers);
    return numbers;
}

static eight get_eight(const void *from)
{
    eight numbers;
    memcpy(&numbers, from, sizeof numbers);
    return numbers;
}

static void put(_Atomic uintptr_t *to, const void *sixteen_bytes)
{
    for (size_t i = 0; i < 16 / sizeof *to; i++) {
        uintptr_t word;
        memcpy(&word, (const char *)sixteen_bytes + i * sizeof word, sizeof word);
        SNOW_MAP_PUT(to[i], word);
    }
}

/* Whether any of 16 bytes is not 0. */
static bool has_any(const void *sixteen_bytes)
{
    uint64_t half[2];
    memcpy(half, sixteen_bytes, sizeof half);
    return (half[0] | half[1]) != 0;
}

static sixteen lesser(sixteen a, sixteen b)
{
    sixteen choose = (sixteen)(a < b);
    return (a & choose) | (b & ~choose);
}

static sixteen greater(sixteen a, sixteen b)
{
    sixteen choose = (sixteen)(a < b);
    return (b & choose) | (a & ~choose);
}

/* Where the least distances of a pair are equal, so are those of the sites that are so near to either; else the
   nearer one has it all: distances differ by at most 1. */
static eight nearer(eight known, eight print)
{
    eight not_further = print <= (known | 255);
    eight further = (print | 255) < known;
    return (known & (print | ~not_further) & ~further) | (print & further);
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

static void start_page(snow_space_map *map, snow_space_page *page, uint8_t class, int distance)
{
    page->changed = map->landing;
    page->most = class;
    page->distance = (uint8_t)distance;
    for (int i = 0; i < 64; i++)
        atomic_init(&page->near.block[i], class);
    for (int i = 0; i < 8; i++)
        atomic_init(&page->line[i], &map->nothing.line);
}

static void start_line(snow_space_line *line)
{
    for (int i = 0; i < 64; i++)
        atomic_init(&line->pair[i], UNKNOWN);
}

static snow_status cover(snow_space_map *map, snow_heap *heap, snow_space_box box)
{
    if ((uint64_t)box.columns * box.rows * box.layers > SIZE_MAX / sizeof *map->tile)
        return SNOW_ERROR_TOO_LARGE;
    snow_space_page *_Atomic *tile = snow_heap_get_raw(heap, tiles_of(box), sizeof *tile);
    snow_space_page *cube = snow_heap_get_raw(heap, cubes_of(box), sizeof *cube);
    uint8_t *cube_distance = snow_heap_get_raw(heap, cubes_of(box), 1);
    if (tile == NULL || cube == NULL || cube_distance == NULL) {
        snow_heap_put(heap, cube_distance);
        snow_heap_put(heap, cube);
        snow_heap_put(heap, tile);
        return heap->refusal;
    }
    memset(cube_distance, CUBES_REACH + 1, cubes_of(box));
    for (size_t i = 0; i < cubes_of(box); i++)
        start_page(map, &cube[i], map->cube_class[CUBES_REACH + 1], FAR_REACH + 1);
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

static void make_near(snow_space_map *map)
{
    for (int from = 0; from < 16; from++) {
        for (int side = 0; side < SIDES * SIDES; side++) {
            for (int place = 0; place < 16; place++) {
                int i = place % 4 + 4 * (side % SIDES - SIDES / 2) - from % 4;
                int j = place / 4 + 4 * (side / SIDES - SIDES / 2) - from / 4;
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
        map->near[d] = d < SNOW_SPACE_LOOK ? (uint8_t)d : class_of(exits, 4 * (d - 1));
    for (int d = 1; d <= FAR_REACH; d++)
        start_page(map, &map->far[d], class_of(exits, 16 * (d - 1)), d);
    for (int d = 0; d <= CUBES_REACH + 1; d++)
        map->cube_class[d] = class_of(exits, at_least(64 * (d - 1), 16 * FAR_REACH));
}

snow_status snow_space_map_start(snow_space_map *map, snow_heap *heap, const snow_exits *exits, bool keeps_matter,
                                 snow_space_box box)
{
    enum { PLACES = 32 };
    *map = (snow_space_map){
        .pages = {.item = sizeof(snow_space_page)},
        .lines = {.item = keeps_matter ? sizeof(snow_space_matter) : sizeof(snow_space_line)},
        .keeps_matter = keeps_matter,
    };
    start_line(&map->nothing.line);
    start_page(map, &map->outside, SNOW_MAP_BEYOND, 0);
    make_classes(map, exits);
    make_near(map);
    map->print = snow_heap_get_raw(heap, PLACES, sizeof *map->print);
    snow_status status = map->print == NULL ? heap->refusal : cover(map, heap, box);
    if (status != SNOW_OK) {
        snow_space_map_end(map, heap);
        return status;
    }
    for (int place = 0; place < PLACES; place++)
        make_print(&map->print[place], place);
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
    return memchr((const void *)&page->near, 0, sizeof page->near) != NULL;
}

/* The page with the block (i, j, k). */
static snow_space_page *page_with(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    snow_space_page *_Atomic *entry = tile_at(map, i / 4, j / 4, k / 4);
    snow_space_page *page = SNOW_MAP_GET(*entry);
    if (page->distance == 0)
        return page;
    page = snow_pool_take(&map->pages);
    start_page(map, page, map->near[NEAR_REACH + 1], 0);
    SNOW_MAP_PUT_ADDRESS(*entry, page);
    return page;
}

static _Atomic uint8_t *near_at(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    return &page_with(map, i, j, k)->near.block[snow_space_place((uint32_t)i, (uint32_t)j, (uint32_t)k)];
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

static uint8_t greatest(sixteen numbers)
{
    uint8_t most = 0;
    for (int i = 0; i < 16; i++)
        most = numbers[i] > most ? numbers[i] : most;
    return most;
}

/* A layer of 4 x 4 blocks at a time: numbers in a layer are known, and none is
   less than that of the layers. */
static void lower_page(snow_space_map *map, snow_space_page *page, const uint8_t *near_in_layer, int64_t layers)
{
    sixteen in_layer = get_sixteen(near_in_layer);
    sixteen most = {0};
    sixteen lowers = {0};
    sixteen now[4];
    for (int layer = 0; layer < 4; layer++) {
        sixteen known = get_sixteen((const char *)&page->near + 16 * layer);
        sixteen least = (sixteen){0} + map->near[at_most(magnitude(layers + layer), NEAR_REACH + 1)];
        now[layer] = lesser(known, greater(in_layer, least));
        most = greater(most, now[layer]);
        lowers |= now[layer] ^ known;
    }
    if (!has_any(&lowers))
        return;
    for (size_t layer = 0; layer < 4; layer++)
        put(page->near.word + layer * (16 / sizeof page->near.word[0]), &now[layer]);
    page->most = greatest(most);
    page->changed = map->landing;
}

/* How far a block is from the blocks of a tile, in one direction. */
static int64_t apart_from_tile(int64_t block, int64_t tile)
{
    return at_least(at_least(4 * tile - block, block - 4 * tile - 3), 0);
}

/* The block (i, j, k) has got its first special site. */
static void spread_near(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    range tiles = range_round(i / 4, j / 4, k / 4, SIDES / 2, &map->box, 1, 1);
    for (int64_t z = tiles.first[2]; z <= tiles.last[2]; z++) {
        for (int64_t y = tiles.first[1]; y <= tiles.last[1]; y++) {
            for (int64_t x = tiles.first[0]; x <= tiles.last[0]; x++) {
                int64_t d = apart(apart_from_tile(i, x), apart_from_tile(j, y), apart_from_tile(k, z));
                if (d > NEAR_REACH)
                    continue;
                snow_space_page *page = page_with(map, 4 * x, 4 * y, 4 * z);
                if (page->most <= map->near[d])
                    continue;
                int64_t side = (y - j / 4 + SIDES / 2) * SIDES + x - i / 4 + SIDES / 2;
                lower_page(map, page, map->near_in_layer[j % 4 * 4 + i % 4][side], 4 * z - k);
            }
        }
    }
}

static void spread_cube(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    range all = range_round(i, j, k, CUBES_REACH, &map->box, 1, 4);
    for (int64_t z = all.first[2]; z <= all.last[2]; z++) {
        for (int64_t y = all.first[1]; y <= all.last[1]; y++) {
            for (int64_t x = all.first[0]; x <= all.last[0]; x++) {
                int64_t d = apart(x - i, y - j, z - k);
                size_t index = cube_index(&map->box, 4 * x, 4 * y, 4 * z);
                if (d >= map->cube_distance[index])
                    continue;
                map->cube_distance[index] = (uint8_t)d;
                for (int place = 0; place < 64; place++)
                    SNOW_MAP_PUT(map->cube[index].near.block[place], map->cube_class[d]);
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
                int64_t d = apart(x - i, y - j, z - k);
                if (d >= page->distance)
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
                if (page->distance == 0 && holds_special(page))
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
                if (page->distance == 0)
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
    enum { LINES = 27, TILES = (SIDES + 2) * (SIDES + 2) * (SIDES + 2) };
    snow_status status = snow_pool_reserve(&map->pages, heap, TILES);
    return status == SNOW_OK ? snow_pool_reserve(&map->lines, heap, LINES) : status;
}

static bool is_covered(const snow_space_map *map, int64_t u, int64_t v, int64_t w)
{
    return u >= 0 && v >= 0 && w >= 0 &&
           snow_space_map_has(map, (uint32_t)(u / 16), (uint32_t)(v / 16), (uint32_t)(w / 16));
}

static void add_special(snow_space_map *map, int64_t u, int64_t v, int64_t w)
{
    if (!is_covered(map, u, v, w))
        return;
    int64_t i = u / 4;
    int64_t j = v / 4;
    int64_t k = w / 4;
    if (SNOW_MAP_GET(*near_at(map, i, j, k)) == 0)
        return;
    bool is_first = !holds_special(page_with(map, i, j, k));
    spread_near(map, i, j, k);
    if (is_first)
        spread_tile(map, i / 4, j / 4, k / 4);
}

/* The line (i, j, k), to be written to. */
static snow_space_line *line_with(snow_space_map *map, int64_t i, int64_t j, int64_t k)
{
    snow_space_page *page = page_with(map, 2 * i, 2 * j, 2 * k);
    uint32_t octant = snow_space_octant((uint32_t)i, (uint32_t)j, (uint32_t)k);
    snow_space_line *line = SNOW_MAP_GET(page->line[octant]);
    if (line == &map->nothing.line) {
        line = snow_pool_take(&map->lines);
        start_line(line);
        SNOW_MAP_PUT_ADDRESS(page->line[octant], line);
    }
    return line;
}

/* Rows of 4 pairs, two at a time. The filled site's pair lies so many rows and layers before the first one of the
   line (i, j, k). */
static void lower_line(snow_space_map *map, int64_t i, int64_t j, int64_t k, int rows, int layers,
                       const int16_t (*print)[ROWS][4])
{
    snow_space_line *line = line_with(map, i, j, k);
    int first = 2 * (int)at_least(0, -PAIRS / 2 - layers);
    int end = 2 * (int)at_most(4, PAIRS / 2 + 1 - layers);
    eight lowers = {0};
    eight now[8];
    for (int n = first; n < end; n++) {
        eight known = get_eight((const char *)line + 16 * n);
        now[n] = nearer(known, get_eight(print[layers + n / 2 + PAIRS / 2][rows + n % 2 * 2 + ROWS / 2]));
        lowers |= now[n] ^ known;
    }
    if (!has_any(&lowers))
        return;
    for (int n = first; n < end; n++)
        put(line->word + (size_t)n * (16 / sizeof line->word[0]), &now[n]);
    page_with(map, 2 * i, 2 * j, 2 * k)->changed = map->landing;
}

static int64_t floor_of(int64_t x, int64_t unit)
{
    return (x + unit * 16) / unit - 16; /* a floor lies at −1 */
}

/* The sites next to a filled one, and itself. */
static void add_specials(snow_space_map *map, int64_t u, int64_t v, int64_t w)
{
    add_special(map, u, v, w);
    for (int step = -1; step <= 1; step += 2) {
        add_special(map, u + step, v, w);
        add_special(map, u, v + step, w);
        add_special(map, u, v, w + step);
    }
}

/* What lines say, those that a filled site may change. */
static void lower_lines(snow_space_map *map, int64_t u, int64_t v, int64_t w)
{
    const snow_space_print *print = &map->print[(w & 1) << 4 | (v & 1) << 3 | (u & 7)];
    const int64_t place[3] = {u, v, w};
    const int64_t lines[3] = {2 * (int64_t)map->box.columns, 2 * (int64_t)map->box.rows, 2 * (int64_t)map->box.layers};
    range all;
    for (int i = 0; i < 3; i++) {
        all.first[i] = at_least(floor_of(place[i] - LINES_REACH - 1, 8), 0);
        all.last[i] = at_most(floor_of(place[i] + LINES_REACH + 1, 8), lines[i] - 1);
    }
    for (int64_t k = all.first[2]; k <= all.last[2]; k++)
        for (int64_t j = all.first[1]; j <= all.last[1]; j++)
            for (int64_t i = all.first[0]; i <= all.last[0]; i++)
                lower_line(map, i, j, k, (int)(4 * j - floor_of(v, 2)), (int)(4 * k - floor_of(w, 2)),
                           print->pair[i - floor_of(u, 8) + 1]);
}

void snow_space_map_add(snow_space_map *map, int32_t x, int32_t y, int32_t z, bool obstacle)
{
    int64_t u = (int64_t)x - map->box.x;
    int64_t v = (int64_t)y - map->box.y;
    int64_t w = (int64_t)z - map->box.z;
    add_specials(map, u, v, w);
    lower_lines(map, u, v, w);
    if (!map->keeps_matter || !is_covered(map, u, v, w))
        return;
    snow_space_matter *matter = (snow_space_matter *)line_with(map, u / 8, v / 8, w / 8);
    uint32_t octant = snow_space_octant((uint32_t)(u / 4), (uint32_t)(v / 4), (uint32_t)(w / 4));
    uint32_t place = snow_space_place((uint32_t)u, (uint32_t)v, (uint32_t)w);
    _Atomic uint32_t *word = &(obstacle ? matter->obstacle : matter->filled)[octant][place / 32];
    SNOW_MAP_PUT(*word, SNOW_MAP_GET(*word) | UINT32_C(1) << place % 32);
}
