/* The inner loops of the tile engine, one table for each instruction set. */
#ifndef SNOW_PACKARD_TILE_KERNEL_H
#define SNOW_PACKARD_TILE_KERNEL_H

#include "packard/tile.h"

/* One step. */
typedef struct tile_pass {
    const struct tile_kernel *kernel;
    int64_t step;    /* the number of the step that is taken */
    unsigned phase;  /* which edges are read; the others are written */
    uint8_t freezes; /* the rule */
} tile_pass;

typedef struct tile_kernel {
    /* Takes the step for the tiles of a list; moves those that changed to its
       front and returns how many. */
    size_t (*advance)(const tile_pass *pass, snow_tile **list, size_t count);
    /* The cells that freeze, unmasked, where words are stored; and those that
       have a frozen neighbour. Changes nothing else. */
    void (*look)(const uint64_t *cells, const tile_halo *halo, uint8_t freezes, uint64_t *fresh, uint64_t *touched);
    /* Number of frozen cells of a tile. */
    unsigned (*population)(const uint64_t *cells);
} tile_kernel;

extern const tile_kernel snow_tile_kernel_baseline;
extern const tile_kernel snow_tile_kernel_avx2;
extern const tile_kernel snow_tile_kernel_avx512;

/* A step of a tile that has extras; whether it changed. */
bool snow_tile_advance_slowly(const tile_pass *pass, snow_tile *tile);

#endif
