/* What need not be computed. Vapour is kept in whole quanta, so where nothing
   flows, nothing at all changes: a chunk whose cells, and all cells within n
   steps of them, were the same after a step as before it, stays the same for n
   steps more. Every ROWS_LOOK_STEPS steps the kernel looks in which chunks
   anything flows; until the next look only those are computed and the ones
   within reach. Ice far inside, dry pockets between the branches and the
   untouched field outside drop out, and come back by themselves. */
#include "reiter/rows.h"

#include <string.h>

/* How far something may come until the next look, in bands; in chunks it is one. */
enum { REACH_IN_BANDS = (ROWS_LOOK_STEPS + REITER_BAND - 1) / REITER_BAND };

static uint64_t *map_band(const rows *cells, uint64_t *map, int32_t band)
{
    return map + (size_t)band * cells->words;
}

void snow_rows_wake_all(rows *cells)
{
    memcpy(cells->active, cells->valid, (size_t)cells->bands * cells->words * sizeof *cells->active);
    cells->stale = true;
}

static void set_bit(uint64_t *band, int64_t chunk)
{
    band[chunk / 64] |= UINT64_C(1) << chunk % 64;
}

static bool has_bit(const uint64_t *band, int64_t chunk)
{
    return (band[chunk / 64] >> chunk % 64 & 1) != 0;
}

static void wake_around(rows *cells, int32_t band, int64_t chunk)
{
    int64_t last_chunk = (int64_t)cells->words * 64 - 1;
    for (int32_t near = band - REACH_IN_BANDS; near <= band + REACH_IN_BANDS; near++) {
        if (near < 0 || near >= cells->bands)
            continue;
        uint64_t *active = map_band(cells, cells->active, near);
        const uint64_t *valid = map_band(cells, cells->valid, near);
        for (int64_t at = chunk - 1; at <= chunk + 1; at++) {
            if (at < 0 || at > last_chunk || !has_bit(valid, at) || has_bit(active, at))
                continue;
            set_bit(active, at);
            cells->stale = true;
        }
    }
}

void snow_rows_wake(const snow_grid *grid, int32_t q, int32_t r, bool looking)
{
    rows *cells = rows_of(grid);
    int32_t band = (r - cells->part.top) / REITER_BAND;
    int64_t chunk = (q - cells->first_column) / REITER_CHUNK;
    if (looking)
        set_bit(map_band(cells, cells->flowing, band), chunk);
    else
        wake_around(cells, band, chunk);
}

/* Each chunk and the ones beside it in its band. */
static void spread_sideways(const rows *cells, uint64_t *band)
{
    uint64_t from_left = 0;
    for (size_t i = 0; i < cells->words; i++) {
        uint64_t here = band[i];
        uint64_t from_right = i + 1 < cells->words ? band[i + 1] << 63 : 0;
        band[i] = here | here << 1 | here >> 1 | from_left | from_right;
        from_left = here >> 63;
    }
}

static void gather_bands(rows *cells, int32_t band)
{
    uint64_t *active = map_band(cells, cells->active, band);
    const uint64_t *valid = map_band(cells, cells->valid, band);
    int32_t first = band > REACH_IN_BANDS ? band - REACH_IN_BANDS : 0;
    int32_t end = band + REACH_IN_BANDS + 1;
    end = end < cells->bands ? end : cells->bands;
    for (size_t i = 0; i < cells->words; i++) {
        uint64_t any = 0;
        for (int32_t near = first; near < end; near++)
            any |= cells->flowing[(size_t)near * cells->words + i];
        cells->stale = cells->stale || active[i] != (any & valid[i]);
        active[i] = any & valid[i];
    }
}

void snow_rows_choose_active(const snow_grid *grid)
{
    rows *cells = rows_of(grid);
    /* Where the part is cut off without a mirror, what leaves on one side comes
       in on the other: then all is computed, always. */
    snow_group group = reiter_of(grid)->group;
    if (group != SNOW_GROUP_TRIVIAL && !snow_group_reflects(group))
        return;
    for (int32_t band = 0; band < cells->bands; band++)
        spread_sideways(cells, map_band(cells, cells->flowing, band));
    for (int32_t band = 0; band < cells->bands; band++)
        gather_bands(cells, band);
}

/* The cells of a row that lie in the chunk from column q on. */
static uint8_t mask_of(const snow_run_of_cells *run, int32_t q)
{
    int32_t first = run->first > q ? run->first - q : 0;
    int32_t end = run->end < q + REITER_CHUNK ? run->end - q : REITER_CHUNK;
    return first < end ? (uint8_t)((0xFFu << first) & (0xFFu >> (REITER_CHUNK - end))) : 0;
}

static reiter_segment chunk_at(const rows *cells, int32_t band, int64_t chunk)
{
    const stored_band *stored = &cells->band[band + 1];
    int32_t q = (int32_t)(cells->first_column + chunk * REITER_CHUNK);
    int32_t row = band * REITER_BAND;
    int32_t r = cells->part.top + row;
    reiter_segment segment = {
        .row = (uint32_t)rows_number(cells, q, r),
        .above = (uint32_t)rows_number(cells, q, r - 1),
        .below = (uint32_t)rows_number(cells, q, r + REITER_BAND),
        .stride = stored->stride,
        .chunks = 1,
        .bit = (uint32_t)((size_t)band * cells->words * 64 + (size_t)chunk),
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
static size_t list_band(const rows *cells, int32_t band, reiter_segment *room)
{
    const uint64_t *active = map_band(cells, cells->active, band);
    size_t listed = 0;
    int64_t joins = -1; /* the chunk that would continue the last segment */
    for (size_t word = 0; word < cells->words; word++) {
        for (uint64_t bits = active[word]; bits != 0; bits &= bits - 1) {
            int64_t chunk = (int64_t)word * 64 + __builtin_ctzll(bits);
            reiter_segment segment = chunk_at(cells, band, chunk);
            bool full = is_full(&segment);
            if (full && chunk == joins)
                room[listed - 1].chunks++;
            else
                room[listed++] = segment;
            joins = full ? chunk + 1 : -1;
        }
    }
    return listed;
}

void snow_rows_list_segments(rows *cells)
{
    for (size_t b = 0; b < cells->blocks; b++) {
        row_block *block = &cells->block[b];
        reiter_segment *room = cells->segment + block->first_segment;
        block->segments = 0;
        for (int32_t band = block->first_band; band < block->end_band; band++)
            block->segments += list_band(cells, band, room + block->segments);
    }
    cells->stale = false;
}
