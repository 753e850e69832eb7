#include "aggregate/plane_line.h"

#include "aggregate/plane_halo.h"

enum { REACH = 3 /* of what a filled site says about sites */ };

/* Of sites: the radius of the largest region round one that does not hold the other. */
static int distance(snow_aggregate_lattice lattice, int x, int y)
{
    int by_column = snow_halo_gap(0, 1, x, 1);
    int by_row = snow_halo_gap(0, 1, y, 1);
    int by_sum = lattice == SNOW_AGGREGATE_HEXAGONAL ? snow_halo_gap(0, 1, x + y, 1) : 0;
    int most = by_column > by_row ? by_column : by_row;
    return most > by_sum ? most : by_sum;
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

int64_t snow_plane_print_first(int64_t v)
{
    return v - REACH - (v % 2 == 0 ? 1 : 0);
}

void snow_plane_prints_make(snow_plane_prints *prints, snow_aggregate_lattice lattice)
{
    for (int odd = 0; odd < 2; odd++)
        for (int place = 0; place < 16; place++)
            for (int line = 0; line < SNOW_PLANE_LINES; line++)
                for (int row = 0; row < SNOW_PLANE_PRINT; row++)
                    prints->of[odd][place][line].row[row] =
                        print_of(lattice, place, row + (int)snow_plane_print_first(odd) - odd, line - 1);
}

/* The greater code of each site. */
static uint64_t greater(uint64_t a, uint64_t b)
{
    const uint64_t lower_bits = UINT64_C(0x5555555555555555);
    uint64_t upper_a = a >> 1 & lower_bits;
    uint64_t upper_b = b >> 1 & lower_bits;
    uint64_t lower = (a & (upper_a | ~upper_b)) | (b & (upper_b | ~upper_a));
    return (upper_a | upper_b) << 1 | (lower & lower_bits);
}

bool snow_plane_line_lower(snow_plane_line *line, uint32_t v, uint32_t pairs, const uint64_t *print)
{
    _Atomic uint64_t *row = &line->two_rows[v % 16 / 2];
    uint64_t changed = 0;
    for (uint32_t i = 0; i < pairs; i++) {
        uint64_t known = SNOW_MAP_GET(row[i]);
        uint64_t now = greater(known, print[i]);
        SNOW_MAP_PUT(row[i], now);
        changed |= now ^ known;
    }
    return changed != 0;
}
