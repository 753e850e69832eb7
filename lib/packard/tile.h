/* A tile, and what its neighbours show it. */
#ifndef SNOW_PACKARD_TILE_H
#define SNOW_PACKARD_TILE_H

#include "packard/tiles.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A vector of eight words holds every eighth row of a tile, so that the row
   above and the row below stand in the vectors before and after it, and only
   the first and the last vector need their words moved. */
enum { TILE_STRIPS = 8, TILE_STRIP_ROWS = SNOW_TILE_SIDE / TILE_STRIPS };

/* Where a row is stored. */
static inline size_t tile_word(size_t row)
{
    return row % TILE_STRIP_ROWS * TILE_STRIPS + row / TILE_STRIP_ROWS;
}

/* The outermost cells of a tile, as its neighbours read them: rows have a bit
   for each q, columns one for each r. */
typedef struct tile_edges {
    uint64_t top, bottom, left, right;
} tile_edges;

enum { NORTH, NORTHEAST, EAST, SOUTH, SOUTHWEST, WEST, TILE_DIRECTIONS };

/* Why a tile's neighbours are not simply those beside it. The folded plane is
   the sector q >= r >= 0; tiles that its mirrors q = r and r = 0 cross hold
   whole squares. On a torus the last tiles may be cut short. */
enum {
    TILE_DIAGONAL = 1,     /* the mirror q = r crosses it from corner to corner */
    TILE_OFF_DIAGONAL = 2, /* its southwest neighbour is its own mirror image */
    TILE_BASE = 4,         /* its first row is the mirror r = 0 */
    TILE_CUT = 8           /* fewer than 64 columns or rows */
};

enum {
    TILE_CHANGED = 1,  /* in the list of those that changed in the last step, or were set since */
    TILE_UNCOUNTED = 2 /* in the list of those that changed since the last count */
};

/* How a freeze step is kept; steps later than can be kept are kept as the last that can. */
static inline uint32_t tile_date(int64_t step)
{
    return step < UINT32_MAX ? (uint32_t)(step + 1) : UINT32_MAX;
}

/* What few tiles have. */
typedef struct tile_extra {
    uint64_t allowed[SNOW_TILE_SIDE]; /* in row order */
    uint64_t priority[SNOW_TILE_SIDE];
    uint32_t *dates; /* NULL: not kept; else in row order: step + 1, 0 for cells that are not frozen */
    uint8_t columns; /* of a tile that is cut short; else 64 */
    uint8_t rows;
    bool masked; /* a mask demands something here */
} tile_extra;

/* Each step reads the edges that the step before wrote, and writes the others:
   so a step can change tiles in place, in any order and at the same time. */
typedef struct snow_tile {
    _Alignas(64) uint64_t cells[SNOW_TILE_SIDE];
    tile_edges edge[2];
    struct snow_tile *beside[TILE_DIRECTIONS]; /* never NULL: a tile without cells stands for those that do not exist */
    tile_extra *extra;                         /* NULL: none */
    int32_t q, r;                              /* in tiles */
    uint16_t counted;                          /* frozen cells when it was last counted */
    uint8_t kind;
    uint8_t state;
    _Atomic uint8_t active; /* 1: in the list of those that the next step visits; threads may want to put it there at
                               the same time */
} snow_tile;

/* The cells around a tile; `northeast` and `southwest` are one cell each. */
typedef struct tile_halo {
    uint64_t top, bottom, left, right;
    uint64_t northeast, southwest;
} tile_halo;

/* What stands beyond a mirror is read from what stands before it. */
static inline void tile_reflect(const snow_tile *tile, unsigned phase, tile_halo *halo)
{
    if (tile->kind & TILE_BASE) {
        uint64_t second = tile->cells[tile_word(1)];
        bool centre = (tile->kind & TILE_DIAGONAL) != 0;
        uint64_t before = centre ? tile->cells[0] >> 1 : tile->beside[WEST]->edge[phase].right >> 1;
        halo->top = second << 1 | (before & 1);
        halo->northeast = second >> (SNOW_TILE_SIDE - 1);
    }
    if (tile->kind & TILE_DIAGONAL) {
        halo->left = halo->top;
        halo->bottom = halo->right;
        halo->southwest = halo->northeast;
    }
    if (tile->kind & TILE_OFF_DIAGONAL)
        halo->southwest = tile->edge[phase].bottom & 1;
}

static inline tile_halo tile_surroundings(const snow_tile *tile, unsigned phase)
{
    snow_tile *const *beside = tile->beside;
    tile_halo halo = {
        .top = beside[NORTH]->edge[phase].bottom,
        .bottom = beside[SOUTH]->edge[phase].top,
        .left = beside[WEST]->edge[phase].right,
        .right = beside[EAST]->edge[phase].left,
        .northeast = beside[NORTHEAST]->edge[phase].bottom & 1,
        .southwest = beside[SOUTHWEST]->edge[phase].right & 1,
    };
    if (tile->kind != 0)
        tile_reflect(tile, phase, &halo);
    return halo;
}

#endif
