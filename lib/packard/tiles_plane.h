/* The engine's own: the plane that the tiles make up. */
#ifndef SNOW_PACKARD_TILES_PLANE_H
#define SNOW_PACKARD_TILES_PLANE_H

#include "packard/tile_kernel.h"
#include "packard/tiles_index.h"

typedef struct tile_list {
    snow_tile **tile;
    size_t count, capacity;
} tile_list;

/* Memory for many tiles. */
typedef struct tile_slab {
    struct tile_slab *before;
    size_t tiles;
} tile_slab;

struct snow_tiles {
    snow_heap *heap;
    snow_tiles_plan plan;
    snow_isa isa;
    const tile_kernel *kernel;
    int64_t steps;
    unsigned phase; /* which edges are those of now */

    snow_tile **directory; /* open addressing by tile coordinates */
    size_t directory_size; /* a power of two */
    size_t tiles;
    tile_index index; /* of an unfolded plane */
    tile_slab *slab; /* the newest */
    size_t slab_used;
    snow_tile *nothing; /* stands for tiles that do not exist */

    tile_list changed;
    tile_list active;
    tile_list uncounted;

    uint64_t visits;
    snow_tiles_census census;
};

/* A cell's place. */
typedef struct tile_place {
    int32_t q, r; /* of the tile */
    unsigned x, y;
} tile_place;

/* Moves a cell, seen from the centre of the symmetries, to its image in the sector q >= r >= 0. */
void snow_tiles_fold(int64_t *q, int64_t *r);
tile_place snow_tiles_place(int64_t q, int64_t r);
/* Where the cell, or the image of it that is kept, is. */
tile_place snow_tiles_locate(const snow_tiles *tiles, int64_t q, int64_t r);

/* NULL: there is none. */
snow_tile *snow_tiles_find(const snow_tiles *tiles, int32_t q, int32_t r);
/* Makes it when there is none; NULL: the heap refused. */
snow_tile *snow_tiles_provide(snow_tiles *tiles, int32_t q, int32_t r);
/* Makes the tile in that direction when there is none, unless the plane ends there. OK, or the heap's refusal. */
snow_status snow_tiles_provide_beside(snow_tiles *tiles, snow_tile *tile, int direction);

bool snow_tile_list_lengthen(snow_heap *heap, tile_list *list, size_t more);

/* Makes room; false: the heap refused. */
static inline bool tile_list_reserve(snow_heap *heap, tile_list *list, size_t more)
{
    return list->count + more <= list->capacity || snow_tile_list_lengthen(heap, list, more);
}
/* Puts a tile into the list of the changed ones; false: the heap refused. */
bool snow_tiles_note_change(snow_tiles *tiles, snow_tile *tile);

static inline unsigned tile_columns(const snow_tile *tile)
{
    return tile->kind & TILE_CUT ? tile->extra->columns : SNOW_TILE_SIDE;
}

static inline unsigned tile_rows(const snow_tile *tile)
{
    return tile->kind & TILE_CUT ? tile->extra->rows : SNOW_TILE_SIDE;
}

#endif
