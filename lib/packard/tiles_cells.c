/* Cells and rows of cells, in and out. */
#include "packard/tiles_plane.h"

/* Freezes cells of a row of a tile, and notes them in the edges that its neighbours read next. */
static void freeze(snow_tiles *tiles, snow_tile *tile, unsigned y, uint64_t bits, int64_t step)
{
    uint64_t *word = &tile->cells[tile_word(y)];
    bits &= ~*word;
    *word |= bits;
    tile_edges *edges = &tile->edge[tiles->phase];
    if (y == 0)
        edges->top |= bits;
    if (y == tile_rows(tile) - 1)
        edges->bottom |= bits;
    edges->left |= (bits & 1) << y;
    edges->right |= (bits >> (tile_columns(tile) - 1) & 1) << y;
    for (; tiles->plan.dated && bits != 0; bits &= bits - 1)
        tile->extra->dates[y * SNOW_TILE_SIDE + (unsigned)__builtin_ctzll(bits)] = tile_date(step);
}

snow_status snow_tiles_set_dated(snow_tiles *tiles, int64_t q, int64_t r, int64_t step)
{
    tile_place place = snow_tiles_locate(tiles, q, r);
    snow_tile *tile = snow_tiles_provide(tiles, place.q, place.r);
    if (tile == NULL || !snow_tiles_note_change(tiles, tile))
        return tiles->heap->refusal;
    freeze(tiles, tile, place.y, UINT64_C(1) << place.x, step);
    if (tile->kind & TILE_DIAGONAL)
        freeze(tiles, tile, place.x, UINT64_C(1) << place.y, step);
    return SNOW_OK;
}

snow_status snow_tiles_set(snow_tiles *tiles, int64_t q, int64_t r)
{
    return snow_tiles_set_dated(tiles, q, r, tiles->steps);
}

bool snow_tiles_get(const snow_tiles *tiles, int64_t q, int64_t r)
{
    tile_place place = snow_tiles_locate(tiles, q, r);
    const snow_tile *tile = snow_tiles_find(tiles, place.q, place.r);
    return tile != NULL && (tile->cells[tile_word(place.y)] >> place.x & 1) != 0;
}

int64_t snow_tiles_date(const snow_tiles *tiles, int64_t q, int64_t r)
{
    tile_place place = snow_tiles_locate(tiles, q, r);
    const snow_tile *tile = snow_tiles_find(tiles, place.q, place.r);
    if (tile == NULL || !tiles->plan.dated)
        return -1;
    return (int64_t)tile->extra->dates[place.y * SNOW_TILE_SIDE + place.x] - 1;
}

static uint64_t lowest_bits(size_t count)
{
    return count < 64 ? (UINT64_C(1) << count) - 1 : UINT64_MAX;
}

/* So many bits of a row of bits, from one on. */
static uint64_t bits_at(const uint64_t *row, size_t first, size_t count)
{
    uint64_t bits = row[first / 64] >> first % 64;
    if (first % 64 + count > 64)
        bits |= row[first / 64 + 1] << (64 - first % 64);
    return bits & lowest_bits(count);
}

static void put_bits_at(uint64_t *row, size_t first, size_t count, uint64_t bits)
{
    row[first / 64] |= bits << first % 64;
    if (first % 64 + count > 64)
        row[first / 64 + 1] |= bits >> (64 - first % 64);
}

/* How many cells a row has from this place to the end of its tile. */
static size_t cells_to_edge(const snow_tiles *tiles, const tile_place *place)
{
    int64_t left = tiles->plan.width - (int64_t)place->q * SNOW_TILE_SIDE;
    unsigned end = tiles->plan.width != 0 && left < SNOW_TILE_SIDE ? (unsigned)left : SNOW_TILE_SIDE;
    return end - place->x;
}

static size_t least_of(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Cells of the part of a folded plane that is kept, one after the other in one direction. */
typedef struct kept_run {
    int64_t q, r;
    int step_q, step_r;
    size_t count;
} kept_run;

/* Where images of a row of cells next leave their line: at a mirror. */
static int64_t next_turn(int64_t q, int64_t r)
{
    const int64_t turns[] = {0, r, -r, -2 * r, -r / 2, (r < 0 ? 1 - r : -1 - r) / 2};
    int64_t next = INT64_MAX;
    for (size_t i = 0; i < sizeof turns / sizeof turns[0]; i++)
        if (turns[i] > q && turns[i] < next)
            next = turns[i];
    return next;
}

/* The images of the cells from (q, r), as seen from the centre of the symmetries, as far as they lie in a line. */
static kept_run run_from(int64_t q, int64_t r, size_t most)
{
    kept_run run = {.q = q, .r = r};
    int64_t next_q = q + 1;
    int64_t next_r = r;
    snow_tiles_fold(&run.q, &run.r);
    snow_tiles_fold(&next_q, &next_r);
    run.step_q = (int)(next_q - run.q);
    run.step_r = (int)(next_r - run.r);
    uint64_t to_turn = (uint64_t)next_turn(q, r) - (uint64_t)q;
    run.count = to_turn < most ? (size_t)to_turn : most;
    return run;
}

static unsigned cells_in_direction(unsigned x, int step)
{
    return step > 0 ? SNOW_TILE_SIDE - x : step < 0 ? x + 1 : SNOW_TILE_SIDE;
}

/* Reads that part of a run that lies in one tile; returns how many cells it is. */
static size_t read_in_tile(const snow_tiles *tiles, const kept_run *run, uint64_t *bits, size_t first)
{
    tile_place place = snow_tiles_place(run->q, run->r);
    size_t count = least_of(run->count, least_of(cells_in_direction(place.x, run->step_q),
                                                 cells_in_direction(place.y, run->step_r)));
    const snow_tile *tile = snow_tiles_find(tiles, place.q, place.r);
    for (size_t i = first; tile != NULL && i < first + count; i++) {
        bits[i / 64] |= (tile->cells[tile_word(place.y)] >> place.x & 1) << i % 64;
        place.x += (unsigned)run->step_q;
        place.y += (unsigned)run->step_r;
    }
    return count;
}

static void folded_row(const snow_tiles *tiles, int64_t q, int64_t r, size_t count, uint64_t *bits)
{
    q -= tiles->plan.fold_q;
    r -= tiles->plan.fold_r;
    for (size_t i = 0; i < count;) {
        kept_run run = run_from(q + (int64_t)i, r, count - i);
        while (run.count > 0) {
            size_t cells = read_in_tile(tiles, &run, bits, i);
            i += cells;
            run.q += run.step_q * (int64_t)cells;
            run.r += run.step_r * (int64_t)cells;
            run.count -= cells;
        }
    }
}

static void plain_row(const snow_tiles *tiles, int64_t q, int64_t r, size_t count, uint64_t *bits)
{
    for (size_t i = 0; i < count;) {
        tile_place place = snow_tiles_locate(tiles, q + (int64_t)i, r);
        const snow_tile *tile = snow_tiles_find(tiles, place.q, place.r);
        size_t cells = least_of(cells_to_edge(tiles, &place), count - i);
        if (tile != NULL)
            put_bits_at(bits, i, cells, tile->cells[tile_word(place.y)] >> place.x & lowest_bits(cells));
        i += cells;
    }
}

void snow_tiles_row(const snow_tiles *tiles, int64_t q, int64_t r, size_t count, uint64_t *bits)
{
    for (size_t i = 0; i < (count + 63) / 64; i++)
        bits[i] = 0;
    if (tiles->plan.folded)
        folded_row(tiles, q, r, count, bits);
    else
        plain_row(tiles, q, r, count, bits);
}

/* Of a folded plane only the cells q >= r >= 0, from the centre of its symmetries, are put. */
static size_t first_to_put(const snow_tiles *tiles, int64_t q, int64_t r, size_t count)
{
    int64_t from_q = q - tiles->plan.fold_q;
    int64_t from_r = r - tiles->plan.fold_r;
    if (!tiles->plan.folded || from_q >= from_r)
        return tiles->plan.folded && from_r < 0 ? count : 0;
    return from_r - from_q < (int64_t)count && from_r >= 0 ? (size_t)(from_r - from_q) : count;
}

static snow_status put_segment(snow_tiles *tiles, const tile_place *place, uint64_t bits)
{
    snow_tile *tile = snow_tiles_provide(tiles, place->q, place->r);
    if (tile == NULL || !snow_tiles_note_change(tiles, tile))
        return tiles->heap->refusal;
    freeze(tiles, tile, place->y, bits << place->x, tiles->steps);
    if (tile->kind & TILE_DIAGONAL)
        for (uint64_t left = bits << place->x; left != 0; left &= left - 1)
            freeze(tiles, tile, (unsigned)__builtin_ctzll(left), UINT64_C(1) << place->y, tiles->steps);
    return SNOW_OK;
}

snow_status snow_tiles_put_row(snow_tiles *tiles, int64_t q, int64_t r, size_t count, const uint64_t *bits)
{
    snow_status status = SNOW_OK;
    for (size_t i = first_to_put(tiles, q, r, count); status == SNOW_OK && i < count;) {
        tile_place place = snow_tiles_locate(tiles, q + (int64_t)i, r);
        size_t cells = least_of(cells_to_edge(tiles, &place), count - i);
        uint64_t segment = bits_at(bits, i, cells);
        if (segment != 0)
            status = put_segment(tiles, &place, segment);
        i += cells;
    }
    return status;
}

bool snow_tiles_next(const snow_tiles *tiles, int64_t *q, int64_t *r)
{
    tile_place place = snow_tiles_place(*q, *r);
    if (!snow_tile_index_next(&tiles->index, &place.q, &place.r))
        return false;
    *q = (int64_t)place.q * SNOW_TILE_SIDE;
    *r = (int64_t)place.r * SNOW_TILE_SIDE;
    return true;
}

int64_t snow_tiles_steps(const snow_tiles *tiles)
{
    return tiles->steps;
}

void snow_tiles_set_steps(snow_tiles *tiles, int64_t steps)
{
    tiles->steps = steps;
}

uint64_t snow_tiles_number(const snow_tiles *tiles)
{
    return tiles->tiles;
}

uint64_t snow_tiles_visits(const snow_tiles *tiles)
{
    return tiles->visits;
}

snow_isa snow_tiles_isa(const snow_tiles *tiles)
{
    return tiles->isa;
}
