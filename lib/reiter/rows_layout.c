/* Where the cells of the ROWS engine are stored. */
#include "base/hexagon.h"
#include "base/sort.h"
#include "reiter/rows.h"

#include <string.h>

static int32_t chunk_ceiling(int32_t q)
{
    return rows_chunk_floor(q + REITER_CHUNK - 1);
}

static const int neighbour_q[6] = {1, -1, 0, 0, 1, -1};
static const int neighbour_r[6] = {0, 0, 1, -1, -1, 1};

void snow_rows_columns(const rows *cells, int32_t band, int32_t *first, int32_t *end)
{
    *first = INT32_MAX;
    *end = INT32_MIN;
    for (int32_t row = band * REITER_BAND; row < (band + 1) * REITER_BAND; row++) {
        if (row < 0 || row >= cells->part.rows)
            continue;
        const snow_run_of_cells *run = &cells->part.run[row];
        int32_t left = rows_chunk_floor(run->first);
        int32_t right = chunk_ceiling(run->end);
        *first = left < *first ? left : *first;
        *end = right > *end ? right : *end;
    }
}

/* The same for a band and those around it, and one chunk more on each side. */
static void columns_around(const rows *cells, int32_t band, int32_t reach, int32_t *first, int32_t *end)
{
    *first = INT32_MAX;
    *end = INT32_MIN;
    for (int32_t from = band - reach; from <= band + reach; from++) {
        int32_t left;
        int32_t right;
        snow_rows_columns(cells, from, &left, &right);
        if (left >= right)
            continue;
        *first = left - REITER_CHUNK < *first ? left - REITER_CHUNK : *first;
        *end = right + REITER_CHUNK > *end ? right + REITER_CHUNK : *end;
    }
}

static int32_t word_floor(int32_t q)
{
    enum { COLUMNS = 64 * REITER_CHUNK };
    return q >= 0 ? q / COLUMNS : -((-q + COLUMNS - 1) / COLUMNS);
}

/* A map has room for what comes from the bands within reach. */
static void place_in_maps(rows *cells, int32_t band)
{
    stored_band *stored = &cells->band[band + 1];
    int32_t first;
    int32_t end;
    columns_around(cells, band, ROWS_REACH, &first, &end);
    stored->first_word = word_floor(first);
    stored->words = word_floor(end - 1) + 1 - stored->first_word;
    stored->map = cells->map_words;
    cells->map_words += (size_t)stored->words;
}

static snow_status place_bands(rows *cells, snow_heap *heap)
{
    cells->bands = (cells->part.rows + REITER_BAND - 1) / REITER_BAND;
    size_t stored = (size_t)cells->bands + 2;
    cells->band = snow_heap_get(heap, stored + 1, sizeof *cells->band);
    cells->offset = snow_heap_get(heap, stored * REITER_BAND, sizeof *cells->offset);
    if (cells->band == NULL || cells->offset == NULL)
        return heap->refusal;
    size_t count = 0;
    for (size_t i = 0; i < stored; i++) {
        int32_t first;
        int32_t end;
        /* Every chunk is computed whole, from all neighbours of its cells, also
           those in the bands beside it. */
        columns_around(cells, (int32_t)i - 1, 1, &first, &end);
        uint32_t stride = (uint32_t)(end - first);
        cells->band[i] = (stored_band){.first = first, .stride = stride, .base = count};
        for (size_t row = 0; row < REITER_BAND; row++)
            cells->offset[i * REITER_BAND + row] = (int64_t)(count + row * stride) - first;
        count += (size_t)REITER_BAND * stride;
    }
    cells->band[stored].base = count;
    cells->count = count;
    return count < UINT32_MAX ? SNOW_OK : SNOW_ERROR_TOO_LARGE;
}

/* The two arrays lie half a page apart, less whole pages: where they lie alike, a
   processor takes what it loads from one for what it has just stored into the
   other, and waits. */
static bool place_vapour(rows *cells, snow_heap *heap)
{
    enum { PAGE = 4096 };
    size_t size = rows_vapour_size(cells);
    size_t page = PAGE / size;
    size_t apart = cells->count / page * page + page + page / 2;
    cells->vapour[0] = snow_heap_get(heap, apart + cells->count, size);
    cells->vapour[1] = cells->vapour[0] != NULL ? (char *)cells->vapour[0] + apart * size : NULL;
    return cells->vapour[0] != NULL;
}

static snow_status place_cells(rows *cells, snow_heap *heap)
{
    size_t count = cells->count;
    bool complete = place_vapour(cells, heap) &&
                    (cells->state = snow_heap_get_raw(heap, count, sizeof *cells->state)) != NULL &&
                    (cells->place = snow_heap_get_raw(heap, count, sizeof *cells->place)) != NULL &&
                    (cells->listed = snow_heap_get_raw(heap, count, sizeof *cells->listed)) != NULL;
    if (!complete)
        return heap->refusal;
    memset(cells->state, CELL_OTHER, count);
    for (int32_t row = 0; row < cells->part.rows; row++) {
        const snow_run_of_cells *run = &cells->part.run[row];
        memset(cells->state + rows_number(cells, run->first, cells->part.top + row), CELL_VAPOUR,
               (size_t)(run->end - run->first));
    }
    return SNOW_OK;
}

static bool is_ghost(const snow_grid *grid, int64_t q, int64_t r)
{
    return snow_domain_has(&grid->domain, q, r) && !snow_domain_has(&rows_of(grid)->part, q, r);
}

typedef struct ghost_list {
    ghost_cell *room; /* NULL: only counts */
    size_t count;
} ghost_list;

static void note_ghosts(const snow_grid *grid, int32_t first, int32_t end, int32_t r, ghost_list *ghosts)
{
    rows *cells = rows_of(grid);
    for (int32_t q = first; q < end; q++) {
        if (!is_ghost(grid, q, r))
            continue;
        if (ghosts->room != NULL) {
            snow_cell from = snow_group_representative(reiter_of(grid)->group, q, r);
            ghosts->room[ghosts->count] =
                (ghost_cell){(uint32_t)rows_number(cells, q, r), (uint32_t)rows_number(cells, from.q, from.r),
                             rows_chunk_floor(from.q) / REITER_CHUNK};
            cells->ghosts_are_near = cells->ghosts_are_near && snow_hexagon_distance(from.q - q, from.r - r) <= 2;
        }
        ghosts->count++;
    }
}

/* Neighbours of the cells of a row, in it or in one beside it, that are not of the part. */
static void note_ghosts_by_row(const snow_grid *grid, int32_t row, int32_t beside, ghost_list *ghosts)
{
    const snow_domain *part = &rows_of(grid)->part;
    int32_t r = part->top + row + beside;
    int32_t first = part->run[row].first - (beside >= 0 ? 1 : 0);
    int32_t end = part->run[row].end + (beside <= 0 ? 1 : 0);
    snow_run_of_cells own = snow_domain_row(part, r);
    if (part->run[row].first >= part->run[row].end)
        return;
    if (own.first >= own.end) {
        note_ghosts(grid, first, end, r, ghosts);
        return;
    }
    note_ghosts(grid, first, end < own.first ? end : own.first, r, ghosts);
    note_ghosts(grid, first > own.end ? first : own.end, end, r, ghosts);
}

/* Finds each ghost once or several times. */
static size_t find_ghosts(const snow_grid *grid, ghost_cell *room)
{
    ghost_list ghosts = {room, 0};
    for (int32_t row = 0; row < rows_of(grid)->part.rows; row++)
        for (int32_t beside = -1; beside <= 1; beside++)
            note_ghosts_by_row(grid, row, beside, &ghosts);
    return ghosts.count;
}

static int compare_origins(const void *a, const void *b)
{
    uint32_t from_a = ((const ghost_cell *)a)->from;
    uint32_t from_b = ((const ghost_cell *)b)->from;
    return (from_a > from_b) - (from_a < from_b);
}

static int compare_ghosts(const void *a, const void *b)
{
    uint32_t to_a = ((const ghost_cell *)a)->to;
    uint32_t to_b = ((const ghost_cell *)b)->to;
    return (to_a > to_b) - (to_a < to_b);
}

static void sort_ghosts(rows *cells, size_t found)
{
    snow_sort(cells->ghost, found, sizeof *cells->ghost, compare_ghosts);
    for (size_t i = 0; i < found; i++)
        if (i == 0 || cells->ghost[i].to != cells->ghost[i - 1].to)
            cells->ghost[cells->ghosts++] = cells->ghost[i];
    snow_sort(cells->ghost, cells->ghosts, sizeof *cells->ghost, compare_origins);
    size_t ghost = 0;
    for (int32_t i = 0; i < cells->bands + 3; i++) {
        while (ghost < cells->ghosts && cells->ghost[ghost].from < cells->band[i].base)
            ghost++;
        cells->band[i].first_ghost = ghost;
    }
}

static snow_status place_ghosts(const snow_grid *grid, snow_heap *heap)
{
    rows *cells = rows_of(grid);
    cells->ghosts_are_near = true;
    if (reiter_of(grid)->group == SNOW_GROUP_TRIVIAL)
        return SNOW_OK;
    size_t found = find_ghosts(grid, NULL);
    cells->ghost = snow_heap_get(heap, found, sizeof *cells->ghost);
    if (cells->ghost == NULL)
        return heap->refusal;
    find_ghosts(grid, cells->ghost);
    sort_ghosts(cells, found);
    return SNOW_OK;
}

/* More tasks than threads, of equal size: what is active moves outwards. */
static size_t count_blocks(const snow_grid *grid, const rows *cells)
{
    enum { BLOCKS_PER_THREAD = 4, LEAST_CELLS = 4096 };
    size_t threads = (size_t)grid->options.threads;
    size_t blocks = threads > 1 ? threads * BLOCKS_PER_THREAD : 1;
    size_t most = (size_t)(cells->part.cells / LEAST_CELLS + 1);
    blocks = blocks < most ? blocks : most;
    return blocks < (size_t)cells->bands ? blocks : (size_t)cells->bands;
}

/* At most a segment for each chunk. */
static size_t most_segments(const rows *cells, int32_t band)
{
    int32_t first;
    int32_t end;
    snow_rows_columns(cells, band, &first, &end);
    return (size_t)(end - first) / REITER_CHUNK;
}

static void cut_blocks(rows *cells)
{
    const snow_domain *part = &cells->part;
    int32_t band = 0;
    for (size_t i = 0; i < cells->blocks; i++) {
        row_block *block = &cells->block[i];
        uint64_t target = (uint64_t)part->cells * (i + 1) / cells->blocks;
        int32_t bands_to_leave = (int32_t)(cells->blocks - 1 - i);
        block->first_band = band;
        do
            band++;
        while (band < cells->bands - bands_to_leave && part->run[band * REITER_BAND].number < target);
        block->end_band = band;
        block->first = cells->band[block->first_band + 1].base;
        block->end = cells->band[block->end_band + 1].base;
    }
}

static snow_status place_blocks(const snow_grid *grid, snow_heap *heap)
{
    rows *cells = rows_of(grid);
    cells->blocks = count_blocks(grid, cells);
    cells->block = snow_heap_get(heap, cells->blocks, sizeof *cells->block);
    if (cells->block == NULL)
        return heap->refusal;
    cut_blocks(cells);
    return SNOW_OK;
}

static void mark_valid(rows *cells, int32_t band)
{
    int32_t q;
    int32_t end;
    for (snow_rows_columns(cells, band, &q, &end); q < end; q += REITER_CHUNK)
        rows_set_bit(rows_map(cells, cells->valid, band), q / REITER_CHUNK);
}

static snow_status place_maps(rows *cells, snow_heap *heap)
{
    size_t segments = 0;
    for (int32_t band = 0; band < cells->bands; band++) {
        place_in_maps(cells, band);
        segments += most_segments(cells, band);
    }
    cells->segment_room = segments;
    bool complete = (cells->valid = snow_heap_get(heap, cells->map_words, sizeof(uint64_t))) != NULL &&
                    (cells->active = snow_heap_get(heap, cells->map_words, sizeof(uint64_t))) != NULL &&
                    (cells->flowing = snow_heap_get(heap, cells->map_words, sizeof(uint64_t))) != NULL &&
                    (cells->visited = snow_heap_get(heap, cells->map_words, sizeof(uint64_t))) != NULL &&
                    (cells->segment = snow_heap_get_raw(heap, segments, sizeof *cells->segment)) != NULL;
    if (!complete)
        return heap->refusal;
    for (int32_t band = 0; band < cells->bands; band++)
        mark_valid(cells, band);
    return SNOW_OK;
}

static snow_status place_part(snow_grid *grid)
{
    reiter *model = reiter_of(grid);
    rows *cells = rows_of(grid);
    snow_status status = snow_group_fundamental(model->group, &grid->domain, &grid->heap, &cells->part);
    if (status == SNOW_OK)
        status = place_bands(cells, &grid->heap);
    return status;
}

snow_status snow_rows_create(snow_grid *grid)
{
    reiter *model = reiter_of(grid);
    snow_heap *heap = &grid->heap;
    model->cells = snow_heap_get(heap, 1, sizeof(rows));
    if (model->cells == NULL)
        return heap->refusal;
    rows *cells = model->cells;
    cells->single = reiter_is_single(model);
    cells->reaches = 1;
    snow_status status = place_part(grid);
    if (status == SNOW_OK)
        status = place_cells(cells, heap);
    if (status == SNOW_OK)
        status = place_ghosts(grid, heap);
    if (status == SNOW_OK)
        status = place_maps(cells, heap);
    if (status == SNOW_OK)
        status = place_blocks(grid, heap);
    return status;
}

void snow_rows_destroy(snow_grid *grid)
{
    rows *cells = rows_of(grid);
    snow_heap *heap = &grid->heap;
    snow_domain_end(&cells->part, heap);
    snow_heap_put(heap, cells->offset);
    snow_heap_put(heap, cells->band);
    snow_heap_put(heap, cells->vapour[0]);
    snow_heap_put(heap, cells->state);
    snow_heap_put(heap, cells->place);
    snow_heap_put(heap, cells->listed);
    snow_heap_put(heap, cells->ghost);
    snow_heap_put(heap, cells->block);
    snow_heap_put(heap, cells->valid);
    snow_heap_put(heap, cells->active);
    snow_heap_put(heap, cells->flowing);
    snow_heap_put(heap, cells->visited);
    snow_heap_put(heap, cells->segment);
    snow_heap_put(heap, cells);
}

bool snow_rows_touches_fixed(const snow_grid *grid, int32_t q, int32_t r)
{
    for (int which = 0; which < 6; which++)
        if (!snow_domain_has(&grid->domain, q + neighbour_q[which], r + neighbour_r[which]))
            return true;
    return false;
}

void snow_rows_copy_ghosts(const rows *cells, void *vapour)
{
    double *doubles = vapour;
    int32_t *singles = vapour;
    for (size_t i = 0; i < cells->ghosts && !cells->single; i++)
        doubles[cells->ghost[i].to] = doubles[cells->ghost[i].from];
    for (size_t i = 0; i < cells->ghosts && cells->single; i++)
        singles[cells->ghost[i].to] = singles[cells->ghost[i].from];
}
