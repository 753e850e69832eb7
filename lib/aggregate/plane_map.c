#include "aggregate/plane_map.h"

#include "base/floating.h"

#include <string.h>

enum {
    BLOCK = 4,
    TILE = 32,
    PAGES_OF_A_SITE = 64, /* so many it may need */
    LINES_OF_A_SITE = 4,
    MOST_PAGES = 1 << 25, /* lanes look things up by 32 bits with a sign */
    MOST_LINES = 1 << 27
};

static int64_t at_least(int64_t x, int64_t least)
{
    return x < least ? least : x;
}

static int64_t at_most(int64_t x, int64_t most)
{
    return x > most ? most : x;
}

static size_t tiles_of(snow_plane_box box)
{
    return (size_t)box.columns * box.rows;
}

static void start_page(snow_plane_map *map, uint32_t page, uint8_t class)
{
    for (int i = 0; i < 64; i++)
        atomic_init(&map->page[page].near[i], class);
    for (int i = 0; i < 4; i++)
        atomic_init(&map->quarters[page].line[i], 0);
}

static snow_status cover(snow_plane_map *map, snow_heap *heap, snow_plane_box box)
{
    if ((uint64_t)box.columns * box.rows > INT32_MAX)
        return SNOW_ERROR_TOO_LARGE;
    _Atomic uint32_t *tile = snow_heap_get_raw(heap, tiles_of(box), sizeof *tile);
    uint8_t *tile_class = snow_heap_get_raw(heap, tiles_of(box), 1);
    uint32_t *changed = snow_heap_get(heap, tiles_of(box), sizeof *changed);
    if (tile == NULL || tile_class == NULL || changed == NULL) {
        snow_heap_put(heap, changed);
        snow_heap_put(heap, tile_class);
        snow_heap_put(heap, tile);
        return heap->refusal;
    }
    memset(tile_class, map->halos->beyond_tiles, tiles_of(box));
    for (size_t i = 0; i < tiles_of(box); i++)
        atomic_init(&tile[i], map->halos->beyond_tiles);
    map->box = box;
    map->width = box.columns * 32;
    map->height = box.rows * 32;
    map->tile = tile;
    map->tile_class = tile_class;
    map->changed = changed;
    return SNOW_OK;
}

static void uncover(const snow_plane_map *map, snow_heap *heap)
{
    snow_heap_put(heap, map->changed);
    snow_heap_put(heap, map->tile_class);
    snow_heap_put(heap, map->tile);
}

/* Small steps waste little memory; each stops all walkers. */
static uint32_t more_than(uint32_t room)
{
    enum { STEP = 256 };
    return room + room / 8 + STEP;
}

static snow_status add_pages(snow_plane_map *map, snow_heap *heap)
{
    enum { READ_TOO = 1 }; /* lanes read the bytes behind the one that they want */
    uint32_t room = more_than(map->pages + PAGES_OF_A_SITE);
    if (room > MOST_PAGES)
        return SNOW_ERROR_TOO_LARGE;
    snow_plane_page *page = snow_heap_move(heap, map->page, map->pages, room + READ_TOO, sizeof *page);
    if (page == NULL)
        return heap->refusal;
    map->page = page;
    snow_plane_quarters *quarters = snow_heap_move(heap, map->quarters, map->pages, room, sizeof *quarters);
    if (quarters == NULL)
        return heap->refusal;
    map->quarters = quarters;
    map->page_room = room;
    return SNOW_OK;
}

static snow_status add_lines(snow_plane_map *map, snow_heap *heap)
{
    uint32_t room = more_than(map->lines + LINES_OF_A_SITE);
    if (room > MOST_LINES)
        return SNOW_ERROR_TOO_LARGE;
    snow_plane_line *line = snow_heap_move(heap, map->line, map->lines, room, sizeof *line);
    if (line == NULL)
        return heap->refusal;
    map->line = line;
    if (map->keeps_matter) {
        snow_plane_matter *matter = snow_heap_move(heap, map->matter, map->lines, room, sizeof *matter);
        if (matter == NULL)
            return heap->refusal;
        map->matter = matter;
    }
    map->line_room = room;
    return SNOW_OK;
}

static bool has_pages(const snow_plane_map *map)
{
    return map->pages + PAGES_OF_A_SITE <= map->page_room;
}

static bool has_lines(const snow_plane_map *map)
{
    return map->lines + LINES_OF_A_SITE <= map->line_room;
}

bool snow_plane_map_has_room(const snow_plane_map *map)
{
    return has_pages(map) && has_lines(map);
}

snow_status snow_plane_map_reserve(snow_plane_map *map, snow_heap *heap)
{
    snow_status status = has_pages(map) ? SNOW_OK : add_pages(map, heap);
    if (status == SNOW_OK && !has_lines(map))
        status = add_lines(map, heap);
    return status;
}

static uint32_t take_page(snow_plane_map *map, uint8_t class)
{
    start_page(map, map->pages, class);
    return map->pages++;
}

static uint32_t take_line(snow_plane_map *map)
{
    memset((void *)&map->line[map->lines], 0, sizeof map->line[0]);
    if (map->keeps_matter)
        memset((void *)&map->matter[map->lines], 0, sizeof map->matter[0]);
    return map->lines++;
}

snow_status snow_plane_map_start(snow_plane_map *map, snow_heap *heap, const snow_exits *exits, bool keeps_matter,
                                 snow_plane_box box)
{
    *map = (snow_plane_map){.keeps_matter = keeps_matter, .lattice = exits->lattice};
    snow_status status = snow_plane_map_reserve(map, heap);
    if (status != SNOW_OK)
        return status;
    map->halos = snow_heap_get_raw(heap, 1, sizeof *map->halos);
    if (map->halos == NULL)
        return heap->refusal;
    snow_halos_make(map->halos, exits);
    for (uint32_t page = 0; page < SNOW_PLANE_SHARED_PAGES; page++)
        take_page(map, (uint8_t)page);
    for (uint32_t line = 0; line < SNOW_PLANE_SHARED_LINES; line++)
        take_line(map);
    snow_plane_prints_make(&map->prints, exits->lattice);
    return cover(map, heap, box);
}

void snow_plane_map_end(snow_plane_map *map, snow_heap *heap)
{
    uncover(map, heap);
    snow_heap_put(heap, map->halos);
    snow_heap_put(heap, map->matter);
    snow_heap_put(heap, map->line);
    snow_heap_put(heap, map->quarters);
    snow_heap_put(heap, map->page);
    *map = (snow_plane_map){.lattice = map->lattice};
}

static void stamp(const snow_plane_map *map, size_t tile)
{
    map->changed[tile] = (uint32_t)map->landing;
}

static size_t tile_at(const snow_plane_map *map, int64_t column, int64_t row)
{
    return (size_t)row * map->box.columns + (size_t)column;
}

static bool has_own_page(const snow_plane_map *map, size_t tile)
{
    return SNOW_MAP_GET(map->tile[tile]) >= SNOW_PLANE_SHARED_PAGES;
}

static uint32_t page_of(snow_plane_map *map, size_t tile)
{
    if (!has_own_page(map, tile)) {
        uint32_t page = take_page(map, map->halos->beyond_blocks);
        stamp(map, tile);
        SNOW_MAP_PUT_ADDRESS(map->tile[tile], page);
    }
    return SNOW_MAP_GET(map->tile[tile]);
}

static uint32_t line_of(snow_plane_map *map, size_t tile, uint32_t u, uint32_t v)
{
    uint32_t page = page_of(map, tile);
    uint32_t line = snow_plane_map_line(map, page, u, v);
    if (line == 0) {
        line = take_line(map);
        SNOW_MAP_PUT_ADDRESS(map->quarters[page].line[v / 16 % 2 * 2 + u / 16 % 2], line);
    }
    return line;
}

static uint32_t known_page(const snow_plane_map *map, uint32_t u, uint32_t v)
{
    return SNOW_MAP_GET(map->tile[tile_at(map, u / TILE, v / TILE)]);
}

/* The cell of 2 sites a side round a site. */
static bool pair_holds_special(const snow_plane_map *map, uint32_t u, uint32_t v)
{
    uint32_t line = snow_plane_map_line(map, known_page(map, u, v), u, v);
    return snow_plane_line_holds_special(&map->line[line], u, v);
}

/* One of 4, 8, 16: kinds 1, 2, 3. */
static bool blocks_hold_special(const snow_plane_page *page, uint32_t u, uint32_t v, int kind)
{
    uint32_t side = 1u << (kind - 1);
    uint32_t first_row = v % TILE / BLOCK & ~(side - 1);
    uint32_t first_column = u % TILE / BLOCK & ~(side - 1);
    bool found = false;
    for (uint32_t row = first_row; row < first_row + side; row++)
        for (uint32_t column = first_column; column < first_column + side; column++)
            found |= SNOW_MAP_GET(page->near[row * 8 + column]) == 0;
    return found;
}

/* One of 32, 64 ... */
static bool tiles_hold_special(const snow_plane_map *map, uint32_t u, uint32_t v, int kind)
{
    uint32_t side = 1u << (kind - 4);
    size_t first_row = v / TILE & ~(side - 1);
    size_t first_column = u / TILE & ~(side - 1);
    for (size_t row = first_row; row < first_row + side; row++)
        if (memchr(map->tile_class + row * map->box.columns + first_column, 0, side) != NULL)
            return true;
    return false;
}

/* Of a kind from 1 on. */
static bool cell_holds_special(const snow_plane_map *map, uint32_t u, uint32_t v, int kind)
{
    if (kind <= 3)
        return blocks_hold_special(&map->page[known_page(map, u, v)], u, v, kind);
    return tiles_hold_special(map, u, v, kind);
}

/* Some places of a map. */
typedef struct part {
    int64_t first_column, last_column, first_row, last_row;
} part;

/* On which sides of a cell the next one of its size is known to hold a special site. */
typedef struct company {
    bool left, right, below, above;
} company;

/* What is known of the smallest cell is true of all that begin to hold special sites with it: the next one is
   that of the same site beside it. For larger ones it pays to look. */
static company company_of(const snow_plane_map *map, uint32_t u, uint32_t v, int kind, company known)
{
    uint32_t size = snow_halo_size(kind);
    return (company){known.left || (u >= size && cell_holds_special(map, u - size, v, kind)),
                     known.right || (u + size < map->width && cell_holds_special(map, u + size, v, kind)),
                     known.below || (v >= size && cell_holds_special(map, u, v - size, kind)),
                     known.above || (v + size < map->height && cell_holds_special(map, u, v + size, kind))};
}

/* The places that may learn something from a cell that begins in place (i, j). To
   all those left of it a cell on its left that holds a special site is as near, or
   nearer; and so on each side. */
static part part_of(const snow_halo *halo, company beside, int64_t i, int64_t j)
{
    int64_t last = halo->first + halo->last; /* of the cell's own places */
    return (part){i + (beside.left ? 0 : halo->first), i + (beside.right ? last : halo->last),
                  j + (beside.below ? 0 : halo->first), j + (beside.above ? last : halo->last)};
}

static part clip(part all, int64_t columns, int64_t rows)
{
    return (part){at_least(all.first_column, 0), at_most(all.last_column, columns - 1),
                  at_least(all.first_row, 0), at_most(all.last_row, rows - 1)};
}

/* The blocks of a page, the first of which is block (x, y) counted from the halo's corner. True: some change. */
static bool lower_page(snow_plane_page *page, const snow_halo *halo, int x, int y)
{
    enum { GROUPS = 4 };
    snow_halo_group now[GROUPS];
    snow_halo_group changed = {0};
    for (int i = 0; i < GROUPS; i++) {
        snow_halo_group known;
        memcpy(&known, (const void *)&page->near_row[2 * i], sizeof known); /* nobody else writes */
        now[i] = snow_halo_lesser(known, snow_halo_rows(halo, x, y + 2 * i));
        changed |= now[i] ^ known;
    }
    if (!snow_halo_has_any(changed))
        return false;
    for (int i = 0; i < GROUPS; i++) {
        snow_halo_halves rows = (snow_halo_halves)now[i];
        SNOW_MAP_PUT(page->near_row[2 * i], rows[0]);
        SNOW_MAP_PUT(page->near_row[2 * i + 1], rows[1]);
    }
    return true;
}

/* A cell that begins in the block (i, j) has got its first special site. */
static void spread_to_blocks(snow_plane_map *map, const snow_halo *halo, company beside, int64_t i, int64_t j)
{
    part near = clip(part_of(halo, beside, i, j), (int64_t)map->box.columns * 8, (int64_t)map->box.rows * 8);
    for (int64_t y = near.first_row / 8; y <= near.last_row / 8; y++)
        for (int64_t x = near.first_column / 8; x <= near.last_column / 8; x++)
            if (lower_page(&map->page[page_of(map, tile_at(map, x, y))], halo, (int)(8 * x - i - halo->first),
                           (int)(8 * y - j - halo->first)))
                stamp(map, tile_at(map, x, y));
}

static void set_tile_class(snow_plane_map *map, size_t tile, uint8_t class)
{
    if (!has_own_page(map, tile)) {
        stamp(map, tile);
        SNOW_MAP_PUT(map->tile[tile], class);
    }
    map->tile_class[tile] = class;
}

/* A group of tiles. */
static void set_tile_classes(snow_plane_map *map, size_t tile, snow_halo_group known, snow_halo_group now)
{
    for (int i = 0; i < SNOW_HALO_GROUP; i++)
        if (now[i] != known[i])
            set_tile_class(map, tile + (size_t)i, (uint8_t)now[i]);
}

/* A cell that begins in the tile (i, j) has got its first special site. */
static void spread_to_tiles(snow_plane_map *map, const snow_halo *halo, company beside, int64_t i, int64_t j)
{
    part near = clip(part_of(halo, beside, i, j), map->box.columns, map->box.rows);
    for (int64_t row = near.first_row; row <= near.last_row; row++) {
        int y = (int)(row - j - halo->first);
        int64_t first = near.first_column / SNOW_HALO_GROUP * SNOW_HALO_GROUP;
        for (int64_t column = first; column <= near.last_column; column += SNOW_HALO_GROUP) {
            int x = (int)(column - i - halo->first);
            size_t tile = tile_at(map, column, row);
            snow_halo_group known;
            memcpy(&known, &map->tile_class[tile], sizeof known);
            snow_halo_group now = snow_halo_lesser(known, snow_halo_row(halo, x, y));
            if (snow_halo_has_any(now ^ known))
                set_tile_classes(map, tile, known, now);
        }
    }
}

/* The cell of a kind round a site has got its first special one. */
static void spread(snow_plane_map *map, uint32_t u, uint32_t v, int kind, company beside)
{
    const snow_halo *halo = snow_halos_find(map->halos, kind, u, v);
    uint32_t first_u = u & ~(snow_halo_size(kind) - 1);
    uint32_t first_v = v & ~(snow_halo_size(kind) - 1);
    if (kind < SNOW_HALO_BLOCK_SIZES)
        spread_to_blocks(map, halo, beside, first_u / BLOCK, first_v / BLOCK);
    else
        spread_to_tiles(map, halo, beside, first_u / TILE, first_v / TILE);
}

/* The smallest cell had none, and perhaps larger ones had none. */
static SNOW_APART void add_first_special(snow_plane_map *map, uint32_t u, uint32_t v, company known)
{
    int kinds = 1;
    while (kinds < SNOW_HALO_SIZES && !cell_holds_special(map, u, v, kinds))
        kinds++;
    spread(map, u, v, 0, known);
    for (int kind = 1; kind < kinds; kind++)
        spread(map, u, v, kind, company_of(map, u, v, kind, known));
}

static void add_special(snow_plane_map *map, uint32_t u, uint32_t v, company known)
{
    if (u < map->width && v < map->height && !pair_holds_special(map, u, v))
        add_first_special(map, u, v, known);
}

/* Tiles move to the new box. */
static void copy_in(snow_plane_map *map, const snow_plane_map *old, size_t shift_x, size_t shift_y)
{
    for (size_t row = 0; row < old->box.rows; row++) {
        size_t from = row * old->box.columns;
        size_t to = (row + shift_y) * map->box.columns + shift_x;
        memcpy(map->tile_class + to, old->tile_class + from, old->box.columns);
        for (size_t column = 0; column < old->box.columns; column++)
            SNOW_MAP_PUT(map->tile[to + column], SNOW_MAP_GET(old->tile[from + column]));
    }
}

/* Cells say round the old box what they say inside. */
static void spread_out(snow_plane_map *map, const snow_plane_map *old, uint32_t shift_u, uint32_t shift_v)
{
    for (int kind = SNOW_HALO_BLOCK_SIZES; kind < SNOW_HALO_SIZES; kind++) {
        uint32_t size = snow_halo_size(kind);
        uint32_t reach = snow_halo_reach(kind) + size + TILE;
        for (uint32_t v = 0; v < old->height; v += size) {
            for (uint32_t u = 0; u < old->width; u += size) {
                bool sees_out = u < reach || v < reach || u + reach >= old->width || v + reach >= old->height;
                if (sees_out && cell_holds_special(map, u + shift_u, v + shift_v, kind))
                    spread(map, u + shift_u, v + shift_v, kind, (company){false, false, false, false});
            }
        }
    }
}

snow_status snow_plane_map_widen(snow_plane_map *map, snow_heap *heap, snow_plane_box box)
{
    snow_plane_map old = *map;
    snow_status status = cover(map, heap, box);
    if (status != SNOW_OK)
        return status;
    uint32_t shift_u = (uint32_t)old.box.x - (uint32_t)box.x;
    uint32_t shift_v = (uint32_t)old.box.y - (uint32_t)box.y;
    copy_in(map, &old, shift_u / TILE, shift_v / TILE);
    uncover(&old, heap);
    spread_out(map, &old, shift_u, shift_v);
    return SNOW_OK;
}

/* Some pairs of rows of a line, from row v of the map on. */
static void add_print(snow_plane_map *map, uint32_t u, uint32_t v, uint32_t pairs, const uint64_t *print)
{
    size_t tile = tile_at(map, u / TILE, v / TILE);
    bool lowered = snow_plane_line_lower(&map->line[line_of(map, tile, u, v)], v, pairs, print);
    /* Where matter is kept walkers are told of what is filled, too. */
    if (lowered || map->keeps_matter)
        stamp(map, tile);
}

/* What a site says about those up to three away. */
static void add_prints(snow_plane_map *map, int64_t u, int64_t v)
{
    const snow_plane_print *print = map->prints.of[v & 1][u & 15];
    int64_t least = at_least(snow_plane_print_first(v), 0);
    int64_t end = at_most(snow_plane_print_first(v) + SNOW_PLANE_PRINT, map->height);
    for (int line = 0; line < SNOW_PLANE_LINES; line++) {
        int64_t column = u + 16 * (line - 1);
        if (column < 0 || column >= (int64_t)map->width || !snow_plane_print_reaches((uint32_t)u, line))
            continue;
        for (int64_t row = least; row < end; row = row - row % 16 + 16) {
            int64_t rows = at_most(row - row % 16 + 16, end) - row;
            const uint64_t *rest = &print[line].two_rows[(row - snow_plane_print_first(v)) / 2];
            add_print(map, (uint32_t)column, (uint32_t)row, (uint32_t)rows / 2, rest);
        }
    }
}

/* A filled site and its neighbours lie in its own smallest cell, one beside it, and one above or below; on the
   hexagonal lattice perhaps in the one beside both. */
static void add_contacts(snow_plane_map *map, uint32_t u, uint32_t v)
{
    bool is_left = u % 2 != 0; /* its own cell is left of the other */
    bool is_below = v % 2 != 0;
    uint32_t other_u = is_left ? u + 1 : u - 1;
    uint32_t other_v = is_below ? v + 1 : v - 1;
    add_special(map, u, v, (company){false, false, false, false});
    add_special(map, other_u, v, (company){is_left, !is_left, false, false});
    add_special(map, u, other_v, (company){false, false, is_below, !is_below});
    if (map->lattice == SNOW_AGGREGATE_HEXAGONAL && is_left != is_below)
        add_special(map, other_u, other_v, (company){is_left, !is_left, is_below, !is_below});
}

void snow_plane_map_add(snow_plane_map *map, int32_t x, int32_t y, bool obstacle)
{
    uint32_t u = (uint32_t)x - (uint32_t)map->box.x; /* in a floor v is −1 */
    uint32_t v = (uint32_t)y - (uint32_t)map->box.y;
    add_contacts(map, u, v);
    add_prints(map, (int64_t)x - map->box.x, (int64_t)y - map->box.y);
    if (!map->keeps_matter || u >= map->width || v >= map->height)
        return;
    snow_plane_matter *matter = &map->matter[line_of(map, tile_at(map, u / TILE, v / TILE), u, v)];
    _Atomic uint16_t *row = &(obstacle ? matter->obstacle : matter->filled)[v % 16];
    SNOW_MAP_PUT(*row, (uint16_t)(SNOW_MAP_GET(*row) | 1u << u % 16));
}
