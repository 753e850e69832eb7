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

static bool bit_at(const uint64_t *words, size_t i)
{
    return (words[i / PACKARD_WORD] >> (i % PACKARD_WORD) & 1) != 0;
}

static void read_inside(const snow_grid *grid, const packard_region *row, double *values)
{
    const snow_run_of_cells inside = snow_domain_row(&grid->domain, row->r);
    for (int64_t i = 0; i < row->width; i++)
        values[i] = row->q + i >= inside.first && row->q + i < inside.end;
}

static double read_cell(const snow_grid *grid, snow_field field, int64_t q, int64_t r, bool frozen)
{
    const packard *model = packard_of(grid);
    if (field == SNOW_FIELD_FREEZE_STEP)
        return frozen ? (double)model->engine->date(model->cells, q, r) : -1;
    if (!packard_has_cell(grid, q, r))
        return 0;
    return field == SNOW_FIELD_VAPOUR ? !frozen : is_receptive(grid, q, r);
}

/* Nothing is frozen outside the domain, whatever an engine says of a torus. */
static void keep_inside(const snow_grid *grid, const packard_region *row, uint64_t *words)
{
    for (int64_t i = 0; i < row->width; i++)
        if (!packard_has_cell(grid, row->q + i, row->r))
            words[i / PACKARD_WORD] &= ~(UINT64_C(1) << (i % PACKARD_WORD));
}

static void read_row(const snow_grid *grid, snow_field field, const packard_region *row, double *values)
{
    const packard *model = packard_of(grid);
    uint64_t words[CHUNK / PACKARD_WORD];
    model->engine->copy(model->cells, row, words);
    if (!packard_is_plane(model))
        keep_inside(grid, row, words);
    bool bits = field == SNOW_FIELD_VALUE || field == SNOW_FIELD_FROZEN;
    for (size_t i = 0; i < (size_t)row->width; i++)
        values[i] = bits ? bit_at(words, i)
                         : read_cell(grid, field, row->q + (int64_t)i, row->r, bit_at(words, i));
}

void snow_packard_read(const snow_grid *grid, snow_field field, int64_t q, int64_t r, size_t count, double *values)
{
    for (size_t i = 0; i < count; i += CHUNK) {
        size_t left = count - i;
        packard_region row = {q + (int64_t)i, r, left < CHUNK ? (int64_t)left : CHUNK, 1};
        if (field == SNOW_FIELD_INSIDE)
            read_inside(grid, &row, values + i);
        else
            read_row(grid, field, &row, values + i);
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

static bool is_in(const snow_rect *rect, int64_t q, int64_t r)
{
    return q >= rect->q && q < (int64_t)rect->q + rect->width && r >= rect->r && r < (int64_t)rect->r + rect->height;
}

static snow_status put_cell(const packard *to, int64_t q, int64_t r, int64_t step)
{
    static const uint64_t one = 1;
    return to->params.record_freeze_steps ? to->engine->put_dated(to->cells, q, r, step)
                                          : to->engine->put(to->cells, &(packard_region){q, r, 1, 1}, &one);
}

/* The frozen cells outside the rectangle stay as they are. */
static snow_status put_others(const snow_grid *grid, const packard *to, const snow_rect *rect)
{
    const packard *model = packard_of(grid);
    packard_region block;
    snow_status status = SNOW_OK;
    for (bool more = snow_packard_first_block(grid, &block); more && status == SNOW_OK;
         more = snow_packard_next_block(grid, &block)) {
        uint64_t words[PACKARD_BLOCK];
        model->engine->copy(model->cells, &block, words);
        for (int64_t y = 0; y < block.height; y++)
            for (int64_t x = 0; x < block.width; x++)
                if (is_in(rect, block.q + x, block.r + y))
                    words[y] &= ~(UINT64_C(1) << x);
        status = snow_packard_put_block(model, to, &block, words);
    }
    return status;
}

static int64_t step_of(const snow_grid *grid, int64_t q, int64_t r)
{
    const packard *model = packard_of(grid);
    bool dated = model->params.record_freeze_steps && is_frozen(grid, q, r);
    return dated ? model->engine->date(model->cells, q, r) : grid->census.steps;
}

/* Those of the rectangle that are to be frozen; those that were so keep their freeze steps. */
static snow_status put_values(const snow_grid *grid, const packard *to, const snow_rect *rect, const double *values)
{
    for (int64_t y = 0; y < rect->height; y++) {
        for (int64_t x = 0; x < rect->width; x++) {
            int64_t q = rect->q + x;
            int64_t r = rect->r + y;
            if (values[(size_t)y * (size_t)rect->width + (size_t)x] == 0 || !packard_has_cell(grid, q, r))
                continue;
            snow_status status = put_cell(to, q, r, step_of(grid, q, r));
            if (status != SNOW_OK)
                return status;
        }
    }
    return SNOW_OK;
}

/* An engine whose cells cannot melt is replaced by a new one. */
static snow_status set_anew(snow_grid *grid, const snow_rect *rect, const double *values)
{
    packard *model = packard_of(grid);
    packard next = *model;
    next.fold = (packard_fold){.possible = false};
    next.zones_last = 0;
    snow_status status = next.engine->create(grid, &next.fold, &next.cells);
    if (status != SNOW_OK)
        return status;
    status = put_others(grid, &next, rect);
    if (status == SNOW_OK)
        status = put_values(grid, &next, rect, values);
    if (status != SNOW_OK) {
        next.engine->destroy(grid, next.cells);
        return status;
    }
    model->engine->destroy(grid, model->cells);
    *model = next;
    return snow_packard_count(grid);
}

/* A part of a row becomes what the values say. */
static snow_status set_part(const snow_grid *grid, const packard_region *part, const double *values)
{
    const packard *model = packard_of(grid);
    uint64_t words[CHUNK / PACKARD_WORD] = {0};
    for (size_t x = 0; x < (size_t)part->width; x++)
        words[x / PACKARD_WORD] |= (uint64_t)(values[x] != 0) << x % PACKARD_WORD;
    return model->engine->put(model->cells, part, words);
}

/* An engine whose cells can melt takes them as they come. */
static snow_status set_in_place(snow_grid *grid, const snow_rect *rect, const double *values)
{
    packard *model = packard_of(grid);
    snow_status status = SNOW_OK;
    model->engine->keep(model->cells);
    for (int64_t y = 0; y < rect->height; y++) {
        for (int64_t x = 0; x < rect->width && status == SNOW_OK; x += CHUNK) {
            packard_region part = {rect->q + x, rect->r + y, rect->width - x < CHUNK ? rect->width - x : CHUNK, 1};
            status = set_part(grid, &part, values + (size_t)y * (size_t)rect->width + (size_t)x);
        }
    }
    if (status == SNOW_OK)
        status = snow_packard_count(grid);
    if (status != SNOW_OK)
        model->engine->restore(model->cells);
    else
        model->fold.possible = false;
    return status;
}

static snow_status set_frozen(snow_grid *grid, const snow_rect *rect, const double *values)
{
    snow_status status = packard_of(grid)->engine->melts ? set_in_place(grid, rect, values)
                                                         : set_anew(grid, rect, values);
    if (status == SNOW_OK)
        grid->census.still = false;
    return status;
}

snow_status snow_packard_set(snow_grid *grid, snow_field field, const snow_rect *rect, const double *values)
{
    if (field != SNOW_FIELD_VALUE && field != SNOW_FIELD_FROZEN)
        return SNOW_ERROR_UNSUPPORTED;
    snow_status status = check_values(rect, values);
    return status == SNOW_OK ? set_frozen(grid, rect, values) : status;
}
