/* What a cell of the plane, a square of 2, 4, 8 ... 512 sites a side that holds a
   special site, says about the places round it: how large a region is at least
   free round each of their sites.

   Places are blocks (4 x 4 sites), about which cells of 2, 4 and 8 sites tell, and
   tiles (32 x 32), about which those of 16 and more tell: the larger ones farther,
   and nothing where the next smaller ones do. So what is lost by their size is
   about the same part of each distance, and what is said far away is said seldom,
   since few large cells ever get their first special site.

   The distance between a place and a cell is that of their nearest sites; it is
   told as a class of exits.h. */
#ifndef SNOW_AGGREGATE_PLANE_HALO_H
#define SNOW_AGGREGATE_PLANE_HALO_H

#include "aggregate/exits.h"

#include <string.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

enum {
    SNOW_HALO_BLOCK_SIZES = 3, /* of cells: 2, 4, 8 */
    SNOW_HALO_TILE_SIZES = 6,  /* 16 ... 512 */
    SNOW_HALO_SIZES = SNOW_HALO_BLOCK_SIZES + SNOW_HALO_TILE_SIZES,
    SNOW_HALO_REACH = 8192,    /* of the largest ones, sites */
    SNOW_HALO_GROUP = 16,      /* places that are told at once */
    SNOW_HALO_MARGIN = SNOW_HALO_GROUP - 1, /* of tables */
    /* Tiles from one end of the halo of the largest cell to the other. */
    SNOW_HALO_MOST = 2 * (SNOW_HALO_REACH / 32 + 1) + 512 / 32
};

/* Sites a side. */
static inline uint32_t snow_halo_size(int kind)
{
    return 2u << kind;
}

/* How far cells of a kind are seen, in sites. */
uint32_t snow_halo_reach(int kind);

/* The greatest of three classes: by columns, by rows, and on the hexagonal
   lattice by the sum of both. Places are counted from the one that the cell
   begins in. */
typedef struct snow_halo {
    int first, last;                                       /* columns, and rows, that it tells about */
    int8_t column[SNOW_HALO_MOST + 2 * SNOW_HALO_MARGIN];  /* the first stands behind the margin */
    uint64_t row[SNOW_HALO_MOST + 2 * SNOW_HALO_MARGIN];   /* the same for eight places side by side */
    int8_t sum[2 * SNOW_HALO_MOST + 4 * SNOW_HALO_MARGIN]; /* behind two margins */
    bool is_hexagonal;
} snow_halo;

typedef struct snow_halos {
    snow_halo half_block[2][2]; /* of the smallest cells, for each quarter of a block, by y and x */
    snow_halo block[SNOW_HALO_BLOCK_SIZES - 1];
    snow_halo half_tile[2][2];
    snow_halo tile[SNOW_HALO_TILE_SIZES - 1];
    uint8_t beyond_blocks, beyond_tiles; /* classes of places that no cell tells about */
} snow_halos;

void snow_halos_make(snow_halos *halos, const snow_exits *exits);

/* That of the cell of a kind round the site (u, v). */
const snow_halo *snow_halos_find(const snow_halos *halos, int kind, uint32_t u, uint32_t v);

/* The distance between two ranges of sites, along an axis; each begins there and is so wide. */
int snow_halo_gap(int from, int width, int to, int other_width);

/* A row of sixteen places, or two rows of eight. */
typedef int8_t snow_halo_group __attribute__((vector_size(SNOW_HALO_GROUP)));
typedef uint64_t snow_halo_halves __attribute__((vector_size(SNOW_HALO_GROUP)));

static inline uint64_t snow_halo_eight(const int8_t *classes)
{
    uint64_t eight;
    memcpy(&eight, classes, sizeof eight);
    return eight;
}

static inline snow_halo_group snow_halo_group_of(uint64_t first, uint64_t second)
{
    return (snow_halo_group)(snow_halo_halves){first, second};
}

#if defined(__SSE2__)
static inline snow_halo_group snow_halo_greater(snow_halo_group a, snow_halo_group b)
{
    return (snow_halo_group)_mm_max_epu8((__m128i)a, (__m128i)b);
}

static inline snow_halo_group snow_halo_lesser(snow_halo_group a, snow_halo_group b)
{
    return (snow_halo_group)_mm_min_epu8((__m128i)a, (__m128i)b);
}
#else
static inline snow_halo_group snow_halo_greater(snow_halo_group a, snow_halo_group b)
{
    snow_halo_group choose = a > b;
    return (a & choose) | (b & ~choose);
}

static inline snow_halo_group snow_halo_lesser(snow_halo_group a, snow_halo_group b)
{
    snow_halo_group choose = a < b;
    return (a & choose) | (b & ~choose);
}
#endif

/* Whether one of them is not 0. */
static inline bool snow_halo_has_any(snow_halo_group group)
{
    snow_halo_halves half = (snow_halo_halves)group;
    return (half[0] | half[1]) != 0;
}

/* What it says about a row of places that begins with place (x, y), counted from its corner. */
static inline snow_halo_group snow_halo_row(const snow_halo *halo, int x, int y)
{
    const int8_t *column = &halo->column[x + SNOW_HALO_MARGIN];
    const int8_t *sum = &halo->sum[x + y + 2 * SNOW_HALO_MARGIN];
    uint64_t row = halo->row[y + SNOW_HALO_MARGIN];
    snow_halo_group by_column = snow_halo_group_of(snow_halo_eight(column), snow_halo_eight(column + 8));
    snow_halo_group said = snow_halo_greater(by_column, snow_halo_group_of(row, row));
    return halo->is_hexagonal ?
        snow_halo_greater(said, snow_halo_group_of(snow_halo_eight(sum), snow_halo_eight(sum + 8))) : said;
}

/* The same about two rows. */
static inline snow_halo_group snow_halo_rows(const snow_halo *halo, int x, int y)
{
    uint64_t column = snow_halo_eight(&halo->column[x + SNOW_HALO_MARGIN]);
    const int8_t *sum = &halo->sum[x + y + 2 * SNOW_HALO_MARGIN];
    const uint64_t *row = &halo->row[y + SNOW_HALO_MARGIN];
    snow_halo_group said = snow_halo_greater(snow_halo_group_of(column, column), snow_halo_group_of(row[0], row[1]));
    return halo->is_hexagonal ?
        snow_halo_greater(said, snow_halo_group_of(snow_halo_eight(sum), snow_halo_eight(sum + 1))) : said;
}

#endif
