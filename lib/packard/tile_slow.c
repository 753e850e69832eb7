/* Tiles with masks, with dates, or cut short: cell by cell where need be. */
#include "packard/tile_kernel.h"

#include <string.h>

/* Puts the cells to the right of a cut tile, and those below it, where the
   kernel looks for them: into its first column and row that are not used. */
static void surround(const tile_extra *extra, uint64_t *cells, tile_halo *halo)
{
    if (extra->columns < SNOW_TILE_SIDE) {
        for (unsigned y = 0; y < extra->rows; y++)
            cells[tile_word(y)] |= (halo->right >> y & 1) << extra->columns;
        halo->top |= halo->northeast << extra->columns;
    }
    if (extra->rows < SNOW_TILE_SIDE) {
        cells[tile_word(extra->rows)] = halo->bottom;
        halo->left |= halo->southwest << extra->rows;
    }
}

static void date(uint32_t *dates, uint64_t cells, int64_t step)
{
    for (; cells != 0; cells &= cells - 1)
        dates[__builtin_ctzll(cells)] = tile_date(step);
}

bool snow_tile_advance_slowly(const tile_pass *pass, snow_tile *tile)
{
    const tile_extra *extra = tile->extra;
    tile_halo halo = tile_surroundings(tile, pass->phase);
    _Alignas(64) uint64_t cells[SNOW_TILE_SIDE];
    _Alignas(64) uint64_t fresh[SNOW_TILE_SIDE];
    _Alignas(64) uint64_t touched[SNOW_TILE_SIDE];
    memcpy(cells, tile->cells, sizeof cells);
    if (tile->kind & TILE_CUT)
        surround(extra, cells, &halo);
    pass->kernel->look(cells, &halo, pass->freezes, fresh, touched);

    tile_edges edges = {0};
    uint64_t changed = 0;
    for (unsigned y = 0; y < extra->rows; y++) {
        size_t word = tile_word(y);
        uint64_t row = tile->cells[word];
        uint64_t freezing = (fresh[word] | (touched[word] & extra->priority[y])) & extra->allowed[y] & ~row;
        if (freezing != 0 && extra->dates != NULL)
            date(extra->dates + (size_t)y * SNOW_TILE_SIDE, freezing, pass->step);
        changed |= freezing;
        row |= freezing;
        tile->cells[word] = row;
        edges.left |= (row & 1) << y;
        edges.right |= (row >> (extra->columns - 1) & 1) << y;
    }
    edges.top = tile->cells[tile_word(0)];
    edges.bottom = tile->cells[tile_word(extra->rows - 1u)];
    tile->edge[1 - pass->phase] = edges;
    return changed != 0;
}
