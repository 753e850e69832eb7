/* What a grid of Packard's model answers, and what can be set. */
#include "base/hexagon.h"
#include "packard/model.h"

enum { CHUNK = 1024 /* cells of a row that are read at a time */ };

snow_status snow_packard_can_read(const snow_grid *grid, snow_field field)
{
    switch (field) {
    case SNOW_FIELD_VALUE:
    case SNOW_FIELD_VAPOUR:
    case SNOW_FIELD_FROZEN:
    case SNOW_FIELD_RECEPTIVE:
    case SNOW_FIELD_INSIDE: return SNOW_OK;
    case SNOW_FIELD_FREEZE_STEP:
        return packard_of(grid)->params.record_freeze_steps ? SNOW_OK : SNOW_ERROR_NOT_RECORDED;
    case SNOW_FIELD_ADDITION:
    case SNOW_FIELD_BACKGROUND: break;
    }
    return SNOW_ERROR_UNSUPPORTED;
}

/* What lies beyond the edge of a torus is what lies at the other edge. */
static void wrap(const snow_grid *grid, int64_t *q, int64_t *r)
{
    const snow_rect *bounds = &grid->domain.bounds;
    if (packard_of(grid)->params.domain != SNOW_PACKARD_TORUS)
        return;
    *q += *q < bounds->q ? bounds->width : *q >= bounds->q + bounds->width ? -bounds->width : 0;
    *r += *r < bounds->r ? bounds->height : *r >= bounds->r + bounds->height ? -bounds->height : 0;
}

static bool is_frozen(const snow_grid *grid, int64_t q, int64_t r)
{
    const packard *model = packard_of(grid);
    uint64_t word;
    if (!packard_has_cell(grid, q, r))
        return false;
    model->engine->copy(model->cells, &(packard_region){q, r, 1, 1}, &word);
    return word != 0;
}

static bool is_receptive(const snow_grid *grid, int64_t q, int64_t r)
{
    static const int offsets[7][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, -1}, {-1, 1}};
    for (int i = 0; i < 7; i++) {
        int64_t x = q + offsets[i][0];
        int64_t y = r + offsets[i][1];
        wrap(grid, &x, &y);
        if (is_frozen(grid, x, y))
            return true;
    }
    return false;
}

static double read_cell(const snow_grid *grid, snow_field field, int64_t q, int64_t r, bool frozen)
{
    const packard *model = packard_of(grid);
    switch (field) {
    case SNOW_FIELD_VALUE:
    case SNOW_FIELD_FROZEN: return frozen;
    case SNOW_FIELD_VAPOUR: return !frozen;
    case SNOW_FIELD_RECEPTIVE: return is_receptive(grid, q, r);
    case SNOW_FIELD_INSIDE: return snow_domain_has(&grid->domain, q, r);
    case SNOW_FIELD_FREEZE_STEP: return frozen ? (double)model->engine->date(model->cells, q, r) : -1;
    case SNOW_FIELD_ADDITION:
    case SNOW_FIELD_BACKGROUND: break;
    }
    return 0;
}

void snow_packard_read(const snow_grid *grid, snow_field field, int64_t q, int64_t r, size_t count, double *values)
{
    const packard *model = packard_of(grid);
    uint64_t words[CHUNK / PACKARD_WORD];
    for (size_t i = 0; i < count; i++, q++) {
        size_t left = count - i;
        packard_region row = {q, r, left < CHUNK ? (int64_t)left : CHUNK, 1};
        if (i % CHUNK == 0)
            model->engine->copy(model->cells, &row, words);
        bool frozen = (words[i % CHUNK / PACKARD_WORD] >> (i % PACKARD_WORD) & 1) != 0;
        bool outside = !packard_has_cell(grid, q, r);
        values[i] = !outside ? read_cell(grid, field, q, r, frozen) : field == SNOW_FIELD_FREEZE_STEP ? -1 : 0;
    }
}

static snow_status check_values(const snow_rect *rect, const double *values)
{
    size_t count = (size_t)rect->width * (size_t)rect->height;
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(values[i]))
            return SNOW_ERROR_NOT_FINITE;
        if (values[i] != 0 && values[i] != 1)
            return SNOW_ERROR_RANGE;
    }
    return SNOW_OK;
}

/* Every cell that is to be frozen, with the step in which it froze. */
static snow_status put_row(snow_grid *grid, const packard *old, packard *next, int64_t r, const packard_region *bounds,
                           const snow_rect *rect, const double *values)
{
    for (int64_t q = bounds->q; q < bounds->q + bounds->width; q++) {
        bool set = q >= rect->q && q < (int64_t)rect->q + rect->width && r >= rect->r &&
                   r < (int64_t)rect->r + rect->height && packard_has_cell(grid, q, r);
        bool was = is_frozen(grid, q, r);
        bool frozen = set ? values[(size_t)(r - rect->r) * (size_t)rect->width + (size_t)(q - rect->q)] != 0 : was;
        if (!frozen)
            continue;
        static const uint64_t one = 1;
        snow_status status;
        if (old->params.record_freeze_steps)
            status = next->engine->put_dated(next->cells, q, r,
                                             was ? old->engine->date(old->cells, q, r) : grid->census.steps);
        else
            status = next->engine->put(next->cells, &(packard_region){q, r, 1, 1}, &one);
        if (status != SNOW_OK)
            return status;
    }
    return SNOW_OK;
}

static packard_region joined(packard_region a, const snow_rect *rect)
{
    packard_region b = {rect->q, rect->r, rect->width, rect->height};
    if (a.width == 0 || b.width == 0 || b.height == 0)
        return a.width == 0 ? b : a;
    int64_t q = a.q < b.q ? a.q : b.q;
    int64_t r = a.r < b.r ? a.r : b.r;
    int64_t end_q = a.q + a.width > b.q + b.width ? a.q + a.width : b.q + b.width;
    int64_t end_r = a.r + a.height > b.r + b.height ? a.r + a.height : b.r + b.height;
    return (packard_region){q, r, end_q - q, end_r - r};
}

/* Frozen cells cannot melt in any engine, so the grid gets a new one. */
static snow_status set_frozen(snow_grid *grid, const snow_rect *rect, const double *values)
{
    packard *model = packard_of(grid);
    packard next = *model;
    next.fold = (packard_fold){.possible = false};
    next.zones_last = 0;
    next.engine = model->engine == &snow_packard_reference ? model->engine : &snow_packard_tiles;
    packard_region bounds = joined(snow_packard_bounds(grid), rect);
    if (bounds.width > INT32_MAX || bounds.height > INT32_MAX)
        return SNOW_ERROR_TOO_LARGE;
    snow_status status = next.engine->create(grid, &next.fold, &next.cells);
    if (status != SNOW_OK)
        return status;
    for (int64_t y = 0; y < bounds.height && status == SNOW_OK; y++)
        status = put_row(grid, model, &next, bounds.r + y, &bounds, rect, values);
    if (status != SNOW_OK) {
        next.engine->destroy(grid, next.cells);
        return status;
    }
    model->engine->destroy(grid, model->cells);
    *model = next;
    grid->census.still = false;
    return snow_packard_count(grid);
}

snow_status snow_packard_set(snow_grid *grid, snow_field field, const snow_rect *rect, const double *values)
{
    if (field != SNOW_FIELD_VALUE && field != SNOW_FIELD_FROZEN)
        return SNOW_ERROR_UNSUPPORTED;
    snow_status status = check_values(rect, values);
    return status == SNOW_OK ? set_frozen(grid, rect, values) : status;
}
