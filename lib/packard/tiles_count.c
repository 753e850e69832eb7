/* Counts and extents of the frozen cells, of those tiles that changed since they were last asked for. */
#include "base/hexagon.h"
#include "packard/tiles_plane.h"

/* How many cells of the plane a tile stands for: twelve for each of its own in
   a folded plane, six for those on a mirror, one for the centre. A tile on the
   diagonal holds both halves. */
static unsigned weighted_population(const snow_tiles *tiles, const snow_tile *tile)
{
    unsigned cells = tiles->kernel->population(tile->cells);
    if (!tiles->plan.folded)
        return cells;
    bool diagonal = (tile->kind & TILE_DIAGONAL) != 0;
    bool base = (tile->kind & TILE_BASE) != 0;
    if (!base)
        return (diagonal ? 6 : 12) * cells;
    unsigned on_mirror = (unsigned)__builtin_popcountll(tile->cells[tile_word(0)]);
    if (!diagonal)
        return 12 * cells - 6 * on_mirror;
    return 6 * (cells - on_mirror) + (unsigned)(tile->cells[tile_word(0)] & 1);
}

/* Right, unlike its terms, for all cells within 2^31 of the centre. */
static uint64_t square_of(int64_t q, int64_t r)
{
    uint64_t a = (uint64_t)q;
    uint64_t b = (uint64_t)r;
    return a * a + a * b + b * b;
}

/* A cell of the folded plane stands for its images. */
static int images(const snow_tiles *tiles)
{
    return tiles->plan.folded ? SNOW_HEXAGON_SYMMETRIES : 1;
}

static void widen(int64_t *least, int64_t *greatest, int64_t value)
{
    *least = value < *least ? value : *least;
    *greatest = value > *greatest ? value : *greatest;
}

static snow_tiles_census widened(const snow_tiles *tiles, snow_tiles_census census, int64_t kept_q, int64_t kept_r)
{
    const snow_tiles_plan *plan = &tiles->plan;
    for (int image = 0; image < images(tiles); image++) {
        int64_t q, r;
        snow_hexagon_image(image, kept_q, kept_r, &q, &r);
        q += plan->folded ? plan->fold_q : 0;
        r += plan->folded ? plan->fold_r : 0;
        widen(&census.least_q, &census.greatest_q, q);
        widen(&census.least_r, &census.greatest_r, r);
        widen(&census.least_s, &census.greatest_s, q + r);
        uint64_t square = square_of(q - plan->centre_q, r - plan->centre_r);
        census.tip_square = square > census.tip_square ? square : census.tip_square;
    }
    return census;
}

/* Whether the tile may hold a cell beyond what is known: whatever is measured
   is extreme in a corner. */
static bool may_extend(const snow_tiles *tiles, int64_t q, int64_t r)
{
    int64_t far_q = q + SNOW_TILE_SIDE - 1;
    int64_t far_r = r + SNOW_TILE_SIDE - 1;
    const snow_tiles_census *known = &tiles->census;
    snow_tiles_census possible = widened(tiles, *known, q, r);
    possible = widened(tiles, possible, far_q, r);
    possible = widened(tiles, possible, q, far_r);
    possible = widened(tiles, possible, far_q, far_r);
    return possible.least_q < known->least_q || possible.greatest_q > known->greatest_q ||
           possible.least_r < known->least_r || possible.greatest_r > known->greatest_r ||
           possible.least_s < known->least_s || possible.greatest_s > known->greatest_s ||
           possible.tip_square > known->tip_square;
}

/* The ends of its rows are enough: between them nothing is farther out. */
static void measure(snow_tiles *tiles, const snow_tile *tile)
{
    int64_t q = (int64_t)tile->q * SNOW_TILE_SIDE;
    int64_t r = (int64_t)tile->r * SNOW_TILE_SIDE;
    for (unsigned y = 0; y < SNOW_TILE_SIDE; y++) {
        uint64_t row = tile->cells[tile_word(y)];
        if (row == 0)
            continue;
        tiles->census = widened(tiles, tiles->census, q + __builtin_ctzll(row), r + y);
        tiles->census = widened(tiles, tiles->census, q + 63 - __builtin_clzll(row), r + y);
    }
}

static void count_tile(snow_tiles *tiles, snow_tile *tile)
{
    unsigned cells = weighted_population(tiles, tile);
    tiles->census.frozen += cells - tile->counted;
    tile->counted = (uint16_t)cells;
    tile->state &= (uint8_t)~TILE_UNCOUNTED;
    if (may_extend(tiles, (int64_t)tile->q * SNOW_TILE_SIDE, (int64_t)tile->r * SNOW_TILE_SIDE))
        measure(tiles, tile);
}

void snow_tiles_count(snow_tiles *tiles, snow_tiles_census *census)
{
    for (size_t i = 0; i < tiles->uncounted.count; i++)
        count_tile(tiles, tiles->uncounted.tile[i]);
    tiles->uncounted.count = 0;
    for (size_t i = 0; i < tiles->changed.count; i++)
        count_tile(tiles, tiles->changed.tile[i]);
    *census = tiles->census;
}
