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

enum {
    SNOW_HALO_BLOCK_SIZES = 3, /* of cells: 2, 4, 8 */
    SNOW_HALO_TILE_SIZES = 6,  /* 16 ... 512 */
    SNOW_HALO_SIZES = SNOW_HALO_BLOCK_SIZES + SNOW_HALO_TILE_SIZES,
    SNOW_HALO_REACH = 8192,    /* of the largest ones, sites */
    SNOW_HALO_GROUP = 8,       /* places side by side that are told at once */
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
    int first, last; /* columns, and rows, that it tells about */
    uint8_t column[SNOW_HALO_MOST + 2 * SNOW_HALO_MARGIN]; /* the first stands behind the margin */
    uint8_t row[SNOW_HALO_MOST];
    uint8_t sum[2 * SNOW_HALO_MOST + 2 * SNOW_HALO_MARGIN];
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

/* Classes of a group of places, from memory. */
static inline uint64_t snow_halo_group(const uint8_t *class)
{
    uint64_t group;
    memcpy(&group, class, sizeof group);
    return group;
}

/* The lesser of what is known of a group of places and what the halo says. Their
   first one is place (x, y), counted from the halo's corner. */
static inline uint64_t snow_halo_lower(uint64_t known, const snow_halo *halo, int x, int y)
{
    uint8_t class[SNOW_HALO_GROUP];
    uint8_t by_column[SNOW_HALO_GROUP];
    uint8_t by_sum[SNOW_HALO_GROUP];
    uint8_t by_row = halo->row[y];
    memcpy(class, &known, sizeof class); /* together: compilers make vectors of these */
    memcpy(by_column, &halo->column[x + SNOW_HALO_MARGIN], sizeof by_column);
    memcpy(by_sum, &halo->sum[x + y + SNOW_HALO_MARGIN], sizeof by_sum);
    for (int i = 0; i < SNOW_HALO_GROUP; i++) {
        uint8_t said = by_column[i] > by_row ? by_column[i] : by_row;
        said = by_sum[i] > said ? by_sum[i] : said;
        class[i] = said < class[i] ? said : class[i];
    }
    return snow_halo_group(class);
}

#endif
