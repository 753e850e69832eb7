#include "aggregate/plane_halo.h"

enum {
    BLOCK = 4,
    TILE = 32,
    SITES_TELL = 3, /* nearer places are as good as touched: the map knows better for each of their sites */
    NOTHING = 127   /* greater than all classes */
};

/* How far cells of 2, 4, 8 ... sites are seen. */
static const int reach_of[SNOW_HALO_SIZES] = {8, 32, 64, 256, 512, 1024, 2048, 4096, SNOW_HALO_REACH};

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
    int least; /* of nearer places smaller cells tell; these are at least so far away */
    int most;
} telling;

static telling telling_of(int kind)
{
    int place = kind < SNOW_HALO_BLOCK_SIZES ? BLOCK : TILE;
    int least = kind == 0 ? 0 : reach_of[kind - 1] + 2;
    return (telling){place, (int)snow_halo_size(kind), least, reach_of[kind] + 1};
}

static int8_t class_of(const snow_exits *exits, telling what, int distance)
{
    if (distance > what.most)
        return NOTHING;
    if (distance == 0 && what.cell <= what.place)
        return 0; /* the cell lies in the place */
    int at_least = distance > what.least ? distance : what.least;
    return at_least < SITES_TELL ? 1 : (int8_t)snow_exits_class(exits, at_least);
}

/* The cell begins at the site (x, y) of its place. */
static void make(snow_halo *halo, const snow_exits *exits, telling what, int x, int y)
{
    const uint64_t each = UINT64_C(0x0101010101010101);
    int reach = what.most / what.place + 1;
    int count = 2 * reach + 1 + (what.cell - 1) / what.place;
    halo->first = -reach;
    halo->last = count - 1 - reach;
    halo->is_hexagonal = exits->lattice == SNOW_AGGREGATE_HEXAGONAL;
    memset(halo->column, NOTHING, sizeof halo->column);
    memset(halo->row, NOTHING, sizeof halo->row);
    memset(halo->sum, NOTHING, sizeof halo->sum);
    for (int i = 0; i < count; i++) {
        int place = (i - reach) * what.place;
        halo->column[i + SNOW_HALO_MARGIN] = class_of(exits, what, snow_halo_gap(x, what.cell, place, what.place));
        halo->row[i + SNOW_HALO_MARGIN] =
            each * (uint64_t)class_of(exits, what, snow_halo_gap(y, what.cell, place, what.place));
    }
    for (int i = 0; halo->is_hexagonal && i < 2 * count - 1; i++) {
        int place = (i - 2 * reach) * what.place;
        int gap = snow_halo_gap(x + y, 2 * what.cell - 1, place, 2 * what.place - 1);
        halo->sum[i + 2 * SNOW_HALO_MARGIN] = class_of(exits, what, gap);
    }
}

/* Cells half as large as a place. */
static void make_halves(snow_halo halo[2][2], const snow_exits *exits, int kind)
{
    telling what = telling_of(kind);
    for (int y = 0; y < 2; y++)
        for (int x = 0; x < 2; x++)
            make(&halo[y][x], exits, what, x * what.cell, y * what.cell);
}

void snow_halos_make(snow_halos *halos, const snow_exits *exits)
{
    enum { HALF_BLOCK, BLOCKS, HALF_TILE = SNOW_HALO_BLOCK_SIZES, TILES };
    make_halves(halos->half_block, exits, HALF_BLOCK);
    for (int kind = BLOCKS; kind < HALF_TILE; kind++)
        make(&halos->block[kind - BLOCKS], exits, telling_of(kind), 0, 0);
    make_halves(halos->half_tile, exits, HALF_TILE);
    for (int kind = TILES; kind < SNOW_HALO_SIZES; kind++)
        make(&halos->tile[kind - TILES], exits, telling_of(kind), 0, 0);
    halos->beyond_blocks = (uint8_t)snow_exits_class(exits, reach_of[HALF_TILE - 1] + 2);
    halos->beyond_tiles = (uint8_t)snow_exits_class(exits, SNOW_HALO_REACH + 2);
}

uint32_t snow_halo_reach(int kind)
{
    return (uint32_t)reach_of[kind];
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
