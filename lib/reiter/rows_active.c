/* What need not be computed. Vapour is kept in whole quanta, so where nothing
   flows, nothing at all changes: a chunk whose cells, and all cells within n
   steps of them, were the same after a step as before it, stays the same for n
   steps more. Every ROWS_LOOK_STEPS steps the kernel looks in which chunks
   anything flows; until the next look only those are computed and the ones
   within reach. Ice far inside, dry pockets between the branches and the
   untouched field outside drop out, and come back by themselves.

   With a tolerance, flows up to it count as none. Small flows can add up unseen
   where nothing is computed, so that every ROWS_FULL_LOOK_STEPS steps the kernel
   looks at everything. */
#include "reiter/rows.h"

#include <string.h>

void snow_rows_wake_all(rows *cells)
{
    memcpy(cells->active, cells->valid, cells->map_words * sizeof *cells->active);
    cells->stale = true;
}

static bool has_bit(map_band band, int32_t chunk)
{
    int32_t bit = chunk - 64 * band.first_word;
    return bit >= 0 && bit < 64 * band.words && (band.word[bit / 64] >> bit % 64 & 1) != 0;
}

static void wake_around(rows *cells, int32_t band, int32_t chunk)
{
    int32_t reach = ROWS_REACH * cells->reaches;
    for (int32_t near = band - reach; near <= band + reach; near++) {
        if (near < 0 || near >= cells->bands)
            continue;
        map_band active = rows_map(cells, cells->active, near);
        map_band valid = rows_map(cells, cells->valid, near);
        for (int32_t at = chunk - cells->reaches; at <= chunk + cells->reaches; at++) {
            if (!has_bit(valid, at) || has_bit(active, at))
                continue;
            rows_set_bit(active, at);
            cells->band[near + 1].stale = true;
            cells->stale = true;
        }
    }
}

void snow_rows_wake(const snow_grid *grid, int32_t q, int32_t r, bool looking)
{
    rows *cells = rows_of(grid);
    int32_t band = (r - cells->part.top) / REITER_BAND;
    int32_t chunk = rows_chunk_floor(q) / REITER_CHUNK;
    if (looking)
        rows_set_bit(rows_map(cells, cells->flowing, band), chunk);
    else
        wake_around(cells, band, chunk);
}

/* Each chunk and the ones beside it in its band. */
static void spread_sideways(map_band band)
{
    uint64_t from_left = 0;
    for (int32_t i = 0; i < band.words; i++) {
        uint64_t here = band.word[i];
        uint64_t from_right = i + 1 < band.words ? band.word[i + 1] << 63 : 0;
        band.word[i] = here | here << 1 | here >> 1 | from_left | from_right;
        from_left = here >> 63;
    }
}

static uint64_t word_at(map_band band, int32_t word)
{
    int32_t i = word - band.first_word;
    return i >= 0 && i < band.words ? band.word[i] : 0;
}

/* What stands still from now on must be the same in both steps. */
static void still_chunks(const rows *cells, int32_t band, int32_t first_chunk, uint64_t bits)
{
    size_t size = rows_vapour_size(cells);
    for (; bits != 0; bits &= bits - 1) {
        int32_t q = (first_chunk + __builtin_ctzll(bits)) * REITER_CHUNK;
        for (int32_t row = 0; row < REITER_BAND; row++) {
            size_t at = rows_number(cells, q, cells->part.top + band * REITER_BAND + row) * size;
            memcpy((char *)cells->vapour[cells->now] + at, (char *)cells->vapour[1 - cells->now] + at,
                   REITER_CHUNK * size);
        }
    }
}

static void gather_bands(rows *cells, int32_t band, bool tolerant)
{
    map_band active = rows_map(cells, cells->active, band);
    map_band valid = rows_map(cells, cells->valid, band);
    int32_t first = band > ROWS_REACH ? band - ROWS_REACH : 0;
    int32_t end = band + ROWS_REACH + 1;
    end = end < cells->bands ? end : cells->bands;
    for (int32_t i = 0; i < active.words; i++) {
        uint64_t any = 0;
        for (int32_t near = first; near < end; near++)
            any |= word_at(rows_map(cells, cells->flowing, near), active.first_word + i);
        uint64_t chosen = any & valid.word[i];
        if (tolerant)
            still_chunks(cells, band, (active.first_word + i) * 64, active.word[i] & ~chosen);
        cells->stale = cells->stale || active.word[i] != chosen;
        active.word[i] = chosen;
    }
}

/* What is within reach of what flows. */
static void spread(rows *cells, bool tolerant)
{
    for (int32_t band = 0; band < cells->bands; band++)
        spread_sideways(rows_map(cells, cells->flowing, band));
    for (int32_t band = 0; band < cells->bands; band++)
        gather_bands(cells, band, tolerant);
}

/* Where the part is cut off without a mirror, what leaves on one side comes in on
   the other: then all is computed, always. */
static bool skips(const snow_grid *grid)
{
    snow_group group = reiter_of(grid)->group;
    return group == SNOW_GROUP_TRIVIAL || snow_group_reflects(group);
}

void snow_rows_choose_active(const snow_grid *grid)
{
    if (skips(grid))
        spread(rows_of(grid), reiter_of(grid)->params.tolerance > 0);
}

void snow_rows_widen_active(const snow_grid *grid)
{
    rows *cells = rows_of(grid);
    if (!skips(grid))
        return;
    memcpy(cells->flowing, cells->active, cells->map_words * sizeof *cells->flowing);
    spread(cells, false);
}

/* The cells of a row that lie in the chunk from column q on. */
static uint8_t mask_of(const snow_run_of_cells *run, int32_t q)
{
    int32_t first = run->first > q ? run->first - q : 0;
    int32_t end = run->end < q + REITER_CHUNK ? run->end - q : REITER_CHUNK;
    unsigned mask = first < end ? (0xFFu << first) & (0xFFu >> (REITER_CHUNK - end)) : 0;
    return (uint8_t)mask;
}

static reiter_segment chunk_at(const rows *cells, int32_t band, int32_t chunk)
{
    const stored_band *stored = &cells->band[band + 1];
    int32_t q = chunk * REITER_CHUNK;
    int32_t row = band * REITER_BAND;
    int32_t r = cells->part.top + row;
    reiter_segment segment = {
        .row = (uint32_t)rows_number(cells, q, r),
        .above = (uint32_t)rows_number(cells, q, r - 1),
        .below = (uint32_t)rows_number(cells, q, r + REITER_BAND),
        .stride = stored->stride,
        .chunks = 1,
        .bit = (uint32_t)(stored->map * 64) + (uint32_t)(chunk - 64 * stored->first_word),
    };
    for (int32_t own = 0; own < REITER_BAND && row + own < cells->part.rows; own++)
        segment.mask[own] = mask_of(&cells->part.run[row + own], q);
    return segment;
}

static bool is_full(const reiter_segment *segment)
{
    bool full = true;
    for (int own = 0; own < REITER_BAND; own++)
        full = full && segment->mask[own] == 0xFF;
    return full;
}

/* Full chunks side by side make one segment. */
static uint32_t list_band(const rows *cells, int32_t band, size_t first_segment)
{
    stored_band *stored = &cells->band[band + 1];
    reiter_segment *room = cells->segment + first_segment;
    map_band active = rows_map(cells, cells->active, band);
    uint32_t listed = 0;
    int32_t joins = INT32_MIN; /* the chunk that would continue the last segment */
    for (int32_t i = 0; i < active.words; i++) {
        for (uint64_t bits = active.word[i]; bits != 0; bits &= bits - 1) {
            int32_t chunk = (active.first_word + i) * 64 + __builtin_ctzll(bits);
            reiter_segment segment = chunk_at(cells, band, chunk);
            bool full = is_full(&segment);
            if (full && chunk == joins)
                room[listed - 1].chunks++;
            else
                room[listed++] = segment;
            joins = full ? chunk + 1 : INT32_MIN;
        }
    }
    stored->first_segment = first_segment;
    stored->segments = listed;
    stored->stale = false;
    return listed;
}

static size_t count_chunks(const reiter_segment *segments, size_t count)
{
    size_t chunks = 0;
    for (size_t i = 0; i < count; i++)
        chunks += segments[i].chunks;
    return chunks;
}

void snow_rows_list_segments(rows *cells)
{
    size_t listed = 0;
    for (size_t b = 0; b < cells->blocks; b++) {
        row_block *block = &cells->block[b];
        block->first_segment = listed;
        for (int32_t band = block->first_band; band < block->end_band; band++)
            listed += list_band(cells, band, listed);
        block->segments = listed - block->first_segment;
    }
    cells->listed_chunks = count_chunks(cells->segment, listed);
    cells->stale = false;
}

/* Behind the others while there is room; then all are listed again. */
void snow_rows_list_band(rows *cells, int32_t band)
{
    row_block *block = &cells->block[0];
    map_band valid = rows_map(cells, cells->valid, band);
    if (block->segments + (size_t)valid.words * 64 > cells->segment_room) {
        snow_rows_list_segments(cells);
        return;
    }
    block->segments += list_band(cells, band, block->segments);
    cells->stale = true;
}
