#include "aggregate/plane_halo.h"

enum { BLOCK = 4, TILE = 32, LARGEST = 512, LARGEST_OF_BLOCKS = 8 };

enum {
    SITES_TELL = 3, /* nearer places are as good as touched: the map knows better for each of their sites */
    BEYOND_BLOCKS = LARGEST_OF_BLOCKS * SNOW_HALO_BLOCK_REACH + 2,
    BEYOND_TILES = LARGEST * SNOW_HALO_TILE_REACH + 2,
    NOTHING = 127 /* greater than all classes */
};

int snow_halo_gap(int from, int width, int to, int other_width)
{
    int after = to - (from + width - 1);
    int before = from - (to + other_width - 1);
    return after > 0 ? after : before > 0 ? before : 0;
}

/* What cells of a size tell about places of a size. */
typedef struct telling {
    int place; /* sites a side */
    int cell;
    int least; /* of nearer places others tell; these are at least so far away */
    int most;
} telling;

static uint8_t class_of(const snow_exits *exits, telling what, int distance)
{
    if (distance > what.most)
        return NOTHING;
    if (distance == 0 && what.cell <= what.place)
        return 0; /* the cell lies in the place */
    int at_least = distance > what.least ? distance : what.least;
    return at_least < SITES_TELL ? 1 : (uint8_t)snow_exits_class(exits, at_least);
}

/* The cell begins at the site (x, y) of its place. */
static void make(snow_halo *halo, const snow_exits *exits, telling what, int x, int y)
{
    bool hexagonal = exits->lattice == SNOW_AGGREGATE_HEXAGONAL;
    int reach = what.most / what.place + 1;
    int count = 2 * reach + 1 + (what.cell - 1) / what.place;
    halo->first = -reach;
    halo->last = count - 1 - reach;
    memset(halo->column, NOTHING, sizeof halo->column);
    memset(halo->sum, hexagonal ? NOTHING : 0, sizeof halo->sum);
    for (int i = 0; i < count; i++) {
        int place = (i - reach) * what.place;
        halo->column[i + SNOW_HALO_MARGIN] = class_of(exits, what, snow_halo_gap(x, what.cell, place, what.place));
        halo->row[i] = class_of(exits, what, snow_halo_gap(y, what.cell, place, what.place));
    }
    for (int i = 0; hexagonal && i < 2 * count - 1; i++) {
        int place = (i - 2 * reach) * what.place;
        int gap = snow_halo_gap(x + y, 2 * what.cell - 1, place, 2 * what.place - 1);
        halo->sum[i + SNOW_HALO_MARGIN] = class_of(exits, what, gap);
    }
}

/* Cells at least as large as a place. Those half as large tell what is nearer. */
static void make_row(snow_halo *halo, const snow_exits *exits, int place, int count, int reach)
{
    for (int i = 0; i < count; i++) {
        int cell = place << i;
        make(&halo[i], exits, (telling){place, cell, cell / 2 * reach + 2, cell * reach + 1}, 0, 0);
    }
}

/* Cells half as large as a place. */
static void make_halves(snow_halo halo[2][2], const snow_exits *exits, int place, int least, int reach)
{
    telling what = {place, place / 2, least, place / 2 * reach + 1};
    for (int y = 0; y < 2; y++)
        for (int x = 0; x < 2; x++)
            make(&halo[y][x], exits, what, x * place / 2, y * place / 2);
}

void snow_halos_make(snow_halos *halos, const snow_exits *exits)
{
    make_halves(halos->half_block, exits, BLOCK, 0, SNOW_HALO_BLOCK_REACH);
    make_row(halos->block, exits, BLOCK, SNOW_HALO_BLOCK_SIZES - 1, SNOW_HALO_BLOCK_REACH);
    make_halves(halos->half_tile, exits, TILE, BEYOND_BLOCKS, SNOW_HALO_TILE_REACH);
    make_row(halos->tile, exits, TILE, SNOW_HALO_TILE_SIZES - 1, SNOW_HALO_TILE_REACH);
    halos->beyond_blocks = (uint8_t)snow_exits_class(exits, BEYOND_BLOCKS);
    halos->beyond_tiles = (uint8_t)snow_exits_class(exits, BEYOND_TILES);
}

const snow_halo *snow_halos_find(const snow_halos *halos, int kind, uint32_t u, uint32_t v)
{
    if (kind == 0)
        return &halos->half_block[v / 2 % 2][u / 2 % 2];
    if (kind < SNOW_HALO_BLOCK_SIZES)
        return &halos->block[kind - 1];
    if (kind == SNOW_HALO_BLOCK_SIZES)
        return &halos->half_tile[v / 16 % 2][u / 16 % 2];
    return &halos->tile[kind - SNOW_HALO_BLOCK_SIZES - 1];
}
