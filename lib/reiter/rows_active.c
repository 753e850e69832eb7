/* What need not be computed. Vapour is kept in whole quanta, so where nothing
   flows, nothing at all changes: a chunk whose cells, and all cells within n
   steps of them, were the same after a step as before it, stays the same for n
   steps more. Every ROWS_LOOK_STEPS steps the kernel looks in which chunks
   anything flows; until the next look only those are computed and the ones
   within reach. Ice far inside, dry pockets between the branches and the
   untouched field outside drop out, and come back by themselves. */
#include "reiter/rows.h"

#include <string.h>

static uint64_t *map_row(const rows *cells, uint64_t *map, int32_t row)
{
    return map + (size_t)row * cells->words;
}

void snow_rows_wake_all(rows *cells)
{
    memcpy(cells->active, cells->valid, (size_t)cells->part.rows * cells->words * sizeof *cells->active);
    cells->stale = true;
}

static void set_bit(uint64_t *row, int64_t chunk)
{
    row[chunk / 64] |= UINT64_C(1) << chunk % 64;
}

static void wake_around(rows *cells, int32_t row, int64_t chunk)
{
    int64_t last_chunk = (int64_t)cells->words * 64 - 1;
    for (int32_t near = row - ROWS_LOOK_STEPS; near <= row + ROWS_LOOK_STEPS; near++) {
        if (near < 0 || near >= cells->part.rows)
            continue;
        for (int64_t at = chunk - 1; at <= chunk + 1; at++) {
            uint64_t *active = map_row(cells, cells->active, near);
            const uint64_t *valid = map_row(cells, cells->valid, near);
            if (at < 0 || at > last_chunk || !(valid[at / 64] >> at % 64 & 1) || (active[at / 64] >> at % 64 & 1))
                continue;
            set_bit(active, at);
            cells->stale = true;
        }
    }
}

void snow_rows_wake(const snow_grid *grid, int32_t q, int32_t r, bool looking)
{
    rows *cells = rows_of(grid);
    int32_t row = r - cells->part.top;
    int64_t chunk = (q - cells->first_column) / REITER_CHUNK;
    if (looking)
        set_bit(map_row(cells, cells->flowing, row), chunk);
    else
        wake_around(cells, row, chunk);
}

/* Each chunk and the ones beside it in its row. */
static void spread_sideways(const rows *cells, uint64_t *row)
{
    uint64_t from_left = 0;
    for (size_t i = 0; i < cells->words; i++) {
        uint64_t here = row[i];
        uint64_t from_right = i + 1 < cells->words ? row[i + 1] << 63 : 0;
        row[i] = here | here << 1 | here >> 1 | from_left | from_right;
        from_left = here >> 63;
    }
}

static void gather_rows(const rows *cells, int32_t row)
{
    uint64_t *active = map_row(cells, cells->active, row);
    const uint64_t *valid = map_row(cells, cells->valid, row);
    int32_t first = row > ROWS_LOOK_STEPS ? row - ROWS_LOOK_STEPS : 0;
    int32_t end = row + ROWS_LOOK_STEPS + 1;
    end = end < cells->part.rows ? end : cells->part.rows;
    for (size_t i = 0; i < cells->words; i++) {
        uint64_t any = 0;
        for (int32_t near = first; near < end; near++)
            any |= cells->flowing[(size_t)near * cells->words + i];
        active[i] = any & valid[i];
    }
}

void snow_rows_choose_active(const snow_grid *grid)
{
    rows *cells = rows_of(grid);
    for (int32_t row = 0; row < cells->part.rows; row++)
        spread_sideways(cells, map_row(cells, cells->flowing, row));
    for (int32_t row = 0; row < cells->part.rows; row++)
        gather_rows(cells, row);
    /* Where the part is cut off without a mirror, what leaves on one side comes
       in on the other: then all is computed. */
    snow_group group = reiter_of(grid)->group;
    if (group != SNOW_GROUP_TRIVIAL && !snow_group_reflects(group))
        snow_rows_wake_all(cells);
    cells->stale = true;
}

/* The cells of the part in a chunk. */
static uint8_t mask_of(const rows *cells, const snow_run_of_cells *run, int64_t chunk)
{
    int64_t q = cells->first_column + chunk * REITER_CHUNK;
    unsigned mask = 0xFF;
    if (run->first > q)
        mask &= 0xFFu << (run->first - q);
    if (run->end < q + REITER_CHUNK)
        mask &= 0xFFu >> (q + REITER_CHUNK - run->end);
    return (uint8_t)mask;
}

static reiter_segment segment_of(const rows *cells, int32_t row, int64_t first, int64_t end)
{
    const snow_run_of_cells *run = &cells->part.run[row];
    int32_t q = (int32_t)(cells->first_column + first * REITER_CHUNK);
    int32_t r = cells->part.top + row;
    uint8_t first_mask = mask_of(cells, run, first);
    uint8_t last_mask = mask_of(cells, run, end - 1);
    return (reiter_segment){
        .row = (uint32_t)rows_number(cells, q, r),
        .above = (uint32_t)rows_number(cells, q, r - 1),
        .below = (uint32_t)rows_number(cells, q, r + 1),
        .chunks = (uint32_t)(end - first),
        .bit = (uint32_t)((size_t)row * cells->words * 64 + (size_t)first),
        .first_mask = first_mask,
        .last_mask = last_mask,
    };
}

/* Runs of ones in a word, each a segment. */
static size_t list_word(const rows *cells, int32_t row, size_t word, reiter_segment *room)
{
    uint64_t bits = map_row(cells, cells->active, row)[word];
    int64_t base = (int64_t)word * 64;
    size_t listed = 0;
    int at = 0;
    while (at < 64 && bits >> at != 0) {
        while (!(bits >> at & 1))
            at++;
        int end = at;
        while (end < 64 && (bits >> end & 1))
            end++;
        room[listed++] = segment_of(cells, row, base + at, base + end);
        at = end;
    }
    return listed;
}

void snow_rows_list_segments(rows *cells)
{
    for (size_t b = 0; b < cells->blocks; b++) {
        row_block *block = &cells->block[b];
        reiter_segment *room = cells->segment + block->first_segment;
        block->segments = 0;
        for (int32_t row = block->first_row; row < block->end_row; row++)
            for (size_t word = 0; word < cells->words; word++)
                block->segments += list_word(cells, row, word, room + block->segments);
    }
    cells->stale = false;
}
