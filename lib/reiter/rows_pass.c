/* Several steps in one pass over the cells, for fields that no cache holds.

   The plane is cut into strips of chunks. A strip is swept from the first band
   to the last; behind the first step follows the second, PASS_LAG bands later,
   and so on, so that a band is still in the cache when its next step comes. From
   step to step a strip moves PASS_SKEW chunks to the left: what it needs on its
   right it has computed itself, what it needs on its left the strip before has.
   The two arrays take turns as ever, no cell is computed twice, and the bits are
   those of single steps.

   Receptive cells are visited chunk by chunk. When one of them freezes, those
   of its neighbours that have been computed in this step join the front at
   once; the others are marked, and join when they have. Ghosts are copied one
   band and one chunk behind, when nothing can change what they are images of. */
#include "base/hexagon.h"
#include "reiter/rows_vapour.h"

#include <string.h>

enum {
    PASS_MOST = 2 * ROWS_LOOK_STEPS, /* steps */
    PASS_LEAST = 4,
    PASS_LAG = 2,
    PASS_SKEW = 2,
    PASS_STRIP_BYTES = 1 << 20, /* of vapour, that a strip keeps in use */
    PASS_LEAST_BYTES = 1 << 22  /* of vapour in motion; less than that stays near in single steps, too */
};

typedef struct pass {
    snow_grid *grid;
    rows *cells;
    int64_t start; /* step count */
    int32_t last;  /* step of the pass, counted from 0 */
    bool looks;    /* in the last step */
    int32_t strip; /* its chunks in the first step */
    int32_t width;
    reiter_flow flow[PASS_MOST];
    double threshold;
    bool collected; /* in the last step */
    bool froze;
} pass;

/* Chunks of a strip in one step. */
typedef struct chunk_range {
    int32_t first;
    int32_t end;
} chunk_range;

static bool looks_in(const pass *all, int32_t step)
{
    return all->looks && step == all->last;
}

static chunk_range range_in(const pass *all, int32_t step)
{
    int32_t first = all->strip - PASS_SKEW * step;
    return (chunk_range){first, first + all->width};
}

static size_t chunk_bytes(const rows *cells)
{
    return 2 * REITER_BAND * REITER_CHUNK * rows_vapour_size(cells);
}

/* Bands in use at once: those between the first step and the last, and one beside each. */
static int32_t strip_width(const rows *cells, int32_t steps)
{
    size_t bands_in_use = PASS_LAG * ((size_t)steps - 1) + 3;
    return (int32_t)(PASS_STRIP_BYTES / (bands_in_use * chunk_bytes(cells)));
}

static size_t active_bytes(const rows *cells)
{
    size_t active = 0;
    for (size_t i = 0; i < cells->map_words; i++)
        active += (size_t)__builtin_popcountll(cells->active[i]);
    return active * chunk_bytes(cells);
}

/* The step count at which a pass from here may end. Looks that others rely on
   come at an end: those for stillness, in step 1 and each 64th, and those at
   everything, which only single steps take. With a tolerance the bits depend on
   when it is looked, so that no look is left out. */
static int64_t farthest_end(const snow_grid *grid)
{
    int64_t start = grid->census.steps;
    bool tolerates = reiter_of(grid)->params.tolerance > 0;
    int64_t span = tolerates ? ROWS_LOOK_STEPS : PASS_MOST;
    int64_t end = start - start % span + span;
    if (start == 0)
        return 1;
    return tolerates && end % ROWS_FULL_LOOK_STEPS == 0 ? end - 1 : end;
}

int64_t snow_rows_pass_steps(const snow_grid *grid, int64_t most)
{
    const rows *cells = rows_of(grid);
    int64_t steps = farthest_end(grid) - grid->census.steps;
    steps = steps < most ? steps : most;
    bool whole = cells->blocks == 1 && cells->ghosts_are_near && !reiter_overshoots(reiter_of(grid));
    return whole && steps >= PASS_LEAST && active_bytes(cells) > PASS_LEAST_BYTES ? steps : 0;
}

/* What is left of a segment within so many bits of the map. */
static bool clip(const reiter_segment *segment, int64_t first_bit, int64_t end_bit, reiter_segment *clipped)
{
    int64_t first = segment->bit > first_bit ? segment->bit : first_bit;
    int64_t end = (int64_t)segment->bit + segment->chunks;
    end = end < end_bit ? end : end_bit;
    if (first >= end)
        return false;
    uint32_t shift = (uint32_t)(first - segment->bit) * REITER_CHUNK;
    *clipped = *segment;
    clipped->row += shift;
    clipped->above += shift;
    clipped->below += shift;
    clipped->bit = (uint32_t)first;
    clipped->chunks = (uint32_t)(end - first);
    return true;
}

static void diffuse(const pass *all, int32_t step, int32_t band)
{
    rows *cells = all->cells;
    const stored_band *stored = &cells->band[band + 1];
    if (stored->stale)
        snow_rows_list_band(cells, band);
    chunk_range range = range_in(all, step);
    int64_t origin = (int64_t)stored->map * 64 - 64 * (int64_t)stored->first_word;
    const reiter_segment *segments = cells->segment + stored->first_segment;
    for (uint32_t i = 0; i < stored->segments; i++) {
        reiter_segment clipped;
        if (!clip(&segments[i], origin + range.first, origin + range.end, &clipped))
            continue;
        if (looks_in(all, step))
            cells->kernel->diffuse_and_look(&all->flow[step], &clipped, 1, cells->flowing);
        else
            cells->kernel->diffuse(&all->flow[step], &clipped, 1);
    }
}

static void note_visit(rows *cells, snow_cell at)
{
    int32_t band = (at.r - cells->part.top) / REITER_BAND;
    rows_set_bit(rows_map(cells, cells->visited, band), rows_chunk_floor(at.q) / REITER_CHUNK);
}

/* Whether the step has reached a cell: all that is left of the strip, and the strip down to the band. */
static bool is_computed(const pass *all, int32_t step, int32_t band, snow_cell at)
{
    int32_t own = (at.r - all->cells->part.top) / REITER_BAND;
    int32_t chunk = rows_chunk_floor(at.q) / REITER_CHUNK;
    chunk_range range = range_in(all, step);
    return chunk < range.first || (chunk < range.end && own <= band);
}

static void reach(const pass *all, int32_t step, int32_t band, int32_t q, int32_t r)
{
    rows *cells = all->cells;
    if (!snow_domain_has(&all->grid->domain, q, r))
        return;
    snow_cell at = rows_representative(all->grid, q, r);
    size_t i = rows_number(cells, at.q, at.r);
    if (cells->state[i] != CELL_VAPOUR)
        return;
    note_visit(cells, at);
    if (is_computed(all, step, band, at))
        snow_rows_join(all->grid, all->flow[step].next, at, looks_in(all, step));
    else
        cells->state[i] = CELL_JOINING;
}

static void freeze(pass *all, int32_t step, int32_t band, uint32_t number, snow_cell at)
{
    snow_rows_freeze_cell(all->grid, number, at);
    all->froze = all->froze || step == all->last;
    reach(all, step, band, at.q - 1, at.r);
    reach(all, step, band, at.q + 1, at.r);
    reach(all, step, band, at.q, at.r - 1);
    reach(all, step, band, at.q + 1, at.r - 1);
    reach(all, step, band, at.q - 1, at.r + 1);
    reach(all, step, band, at.q, at.r + 1);
}

/* A receptive cell, or one that joins them now. */
static void visit_cell(pass *all, int32_t step, int32_t band, uint32_t number, snow_cell at)
{
    const rows *cells = all->cells;
    void *next = all->flow[step].next;
    if (cells->state[number] == CELL_JOINING) {
        snow_rows_join(all->grid, next, at, looks_in(all, step));
        return;
    }
    bool collected = false;
    double inflow = rows_take_from(next, number, cells->single, cells->quantum);
    double addition = reiter_addition(reiter_of(all->grid), number);
    if (rows_collect_inflow(&cells->listed[cells->place[number]], inflow, addition, (uint32_t)(all->start + step + 1),
                            all->threshold, &collected) &&
        cells->state[number] != CELL_FED)
        freeze(all, step, band, number, at);
    all->collected = all->collected || (collected && step == all->last);
}

/* A bit for each of eight states, set where the state is odd. */
static uint32_t odd_ones(const unsigned char *state)
{
    uint32_t odd = 0;
    for (int column = 0; column < REITER_CHUNK; column++)
        odd |= (uint32_t)(state[column] & 1) << column;
    return odd;
}

/* Cells that join while the chunk is visited are not of this visit. */
static void visit_chunk(pass *all, int32_t step, int32_t band, int32_t chunk)
{
    const rows *cells = all->cells;
    snow_cell corner = {chunk * REITER_CHUNK, cells->part.top + band * REITER_BAND};
    for (int32_t own = 0; own < REITER_BAND; own++) {
        uint32_t first = (uint32_t)rows_number(cells, corner.q, corner.r + own);
        for (uint32_t odd = odd_ones(cells->state + first); odd != 0; odd &= odd - 1) {
            uint32_t column = (uint32_t)__builtin_ctz(odd);
            visit_cell(all, step, band, first + column, (snow_cell){corner.q + (int32_t)column, corner.r + own});
        }
    }
}

static void visit(pass *all, int32_t step, int32_t band)
{
    map_band visited = rows_map(all->cells, all->cells->visited, band);
    chunk_range range = range_in(all, step);
    all->grid->census.steps = all->start + step + 1;
    for (int32_t i = 0; i < visited.words; i++) {
        int32_t first = (visited.first_word + i) * 64;
        if (first >= range.end || first + 64 <= range.first)
            continue;
        for (uint64_t bits = visited.word[i]; bits != 0; bits &= bits - 1) {
            int32_t chunk = first + __builtin_ctzll(bits);
            if (chunk >= range.first && chunk < range.end)
                visit_chunk(all, step, band, chunk);
        }
    }
}

static void copy_ghosts(const pass *all, int32_t step, int32_t band)
{
    const rows *cells = all->cells;
    chunk_range range = range_in(all, step);
    const ghost_cell *end = cells->ghost + cells->band[band + 2].first_ghost;
    for (const ghost_cell *ghost = cells->ghost + cells->band[band + 1].first_ghost; ghost < end; ghost++) {
        if (ghost->chunk < range.first - 1 || ghost->chunk >= range.end - 1)
            continue;
        if (cells->single)
            ((int32_t *)all->flow[step].next)[ghost->to] = ((int32_t *)all->flow[step].next)[ghost->from];
        else
            ((double *)all->flow[step].next)[ghost->to] = ((double *)all->flow[step].next)[ghost->from];
    }
}

static void sweep_strip(pass *all)
{
    int32_t bands = all->cells->bands;
    for (int32_t wave = 0; wave <= bands + PASS_LAG * all->last; wave++) {
        for (int32_t step = 0; step <= all->last; step++) {
            int32_t band = wave - PASS_LAG * step;
            if (band >= 0 && band < bands) {
                diffuse(all, step, band);
                visit(all, step, band);
            }
            if (band >= 1 && band <= bands)
                copy_ghosts(all, step, band - 1);
        }
    }
}

static void note_front(rows *cells)
{
    memset(cells->visited, 0, cells->map_words * sizeof *cells->visited);
    const row_block *block = &cells->block[0];
    for (size_t place = block->first; place < block->first + block->front; place++)
        note_visit(cells, snow_rows_locate(cells, block, cells->listed[place].number));
}

/* The chunks of all bands. */
static chunk_range widest_range(const rows *cells)
{
    chunk_range widest = {INT32_MAX, INT32_MIN};
    for (int32_t band = 0; band < cells->bands; band++) {
        int32_t first;
        int32_t end;
        snow_rows_columns(cells, band, &first, &end);
        widest.first = first / REITER_CHUNK < widest.first ? first / REITER_CHUNK : widest.first;
        widest.end = end / REITER_CHUNK > widest.end ? end / REITER_CHUNK : widest.end;
    }
    return widest;
}

static void sweep(pass *all)
{
    chunk_range widest = widest_range(all->cells);
    /* One chunk more, for the ghosts. */
    for (all->strip = widest.first; range_in(all, all->last).first <= widest.end; all->strip += all->width)
        sweep_strip(all);
}

/* What is active holds until the next look; a pass that leaves looks out needs more. */
static void prepare_active(pass *all)
{
    rows *cells = all->cells;
    int64_t ahead = all->start % ROWS_LOOK_STEPS + all->last;
    while (cells->reaches <= ahead / ROWS_LOOK_STEPS) {
        snow_rows_widen_active(all->grid);
        cells->reaches++;
    }
    if (cells->stale)
        snow_rows_list_segments(cells);
    if (all->looks)
        memset(cells->flowing, 0, cells->map_words * sizeof *cells->flowing);
}

void snow_rows_pass(snow_grid *grid, int64_t steps)
{
    rows *cells = rows_of(grid);
    int64_t start = grid->census.steps;
    pass all = {.grid = grid, .cells = cells, .start = start, .last = (int32_t)steps - 1,
                .looks = (start + steps) % ROWS_LOOK_STEPS == 0, .width = strip_width(cells, (int32_t)steps),
                .threshold = reiter_threshold(reiter_of(grid))};
    for (int32_t step = 0; step <= all.last; step++)
        all.flow[step] = snow_rows_flow(grid, (cells->now + step) % 2);
    prepare_active(&all);
    note_front(cells);
    sweep(&all);
    cells->now = (cells->now + all.last) % 2;
    cells->reaches = 1;
    if (all.looks)
        snow_rows_choose_active(grid);
    cells->now = 1 - cells->now;
    cells->block[0].collected = all.collected;
    grid->census.steps = start + steps;
    if (snow_census_looks(grid->census.steps))
        grid->census.still = snow_rows_is_still(grid, all.froze);
}
