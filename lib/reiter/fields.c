/* Reading and setting cells. */
#include "reiter/model.h"

snow_status snow_reiter_can_read(const snow_grid *grid, snow_field field)
{
    if (field == SNOW_FIELD_FREEZE_STEP && reiter_of(grid)->freeze_step == NULL)
        return SNOW_ERROR_NOT_RECORDED;
    return SNOW_OK;
}

/* A cell that belongs to the medium round the interior. */
static double read_outside(const snow_grid *grid, snow_field field, int64_t q, int64_t r)
{
    const reiter *model = reiter_of(grid);
    switch (field) {
    case SNOW_FIELD_VALUE:
    case SNOW_FIELD_VAPOUR:
    case SNOW_FIELD_BACKGROUND:
        return snow_domain_has(&model->hull, q, r) ? model->engine->get(grid, (int32_t)q, (int32_t)r).value
                                                   : reiter_background(model);
    case SNOW_FIELD_FREEZE_STEP: return -1;
    case SNOW_FIELD_FROZEN:
    case SNOW_FIELD_RECEPTIVE:
    case SNOW_FIELD_INSIDE:
    case SNOW_FIELD_ADDITION: break;
    }
    return 0;
}

static double read_freeze_step(const reiter *model, size_t number)
{
    uint32_t step = model->freeze_step[number];
    return step == REITER_NEVER ? -1 : (double)step;
}

static double read_inside(const snow_grid *grid, snow_field field, int32_t q, int32_t r)
{
    const reiter *model = reiter_of(grid);
    size_t number = model->engine->number(grid, q, r);
    reiter_cell cell = model->engine->get(grid, q, r);
    switch (field) {
    case SNOW_FIELD_VALUE: return reiter_value(&cell, reiter_addition(model, number));
    case SNOW_FIELD_VAPOUR: return cell.receptive ? 0 : cell.value;
    case SNOW_FIELD_FROZEN: return cell.frozen;
    case SNOW_FIELD_RECEPTIVE: return cell.receptive;
    case SNOW_FIELD_INSIDE: return 1;
    case SNOW_FIELD_FREEZE_STEP: return read_freeze_step(model, number);
    case SNOW_FIELD_ADDITION: return reiter_addition(model, number);
    case SNOW_FIELD_BACKGROUND: break;
    }
    return model->params.background;
}

void snow_reiter_read(const snow_grid *grid, snow_field field, int64_t q, int64_t r, size_t count, double *values)
{
    snow_run_of_cells run = snow_domain_row(&grid->domain, r);
    for (size_t i = 0; i < count; i++, q++)
        values[i] = q >= run.first && q < run.end ? read_inside(grid, field, (int32_t)q, (int32_t)r)
                                                    : read_outside(grid, field, q, r);
}

/* Calls visit for each cell of the domain that lies in the rectangle, until it fails. */
typedef snow_status (*cell_visitor)(snow_grid *grid, int32_t q, int32_t r, double value);

static snow_status visit(snow_grid *grid, const snow_domain *domain, const snow_rect *rect, const double *values,
                         cell_visitor visitor)
{
    int64_t first_row = rect->r > domain->top ? rect->r : domain->top;
    int64_t end_row = (int64_t)rect->r + rect->height;
    end_row = end_row < domain->top + domain->rows ? end_row : domain->top + domain->rows;
    for (int64_t r = first_row; r < end_row; r++) {
        snow_run_of_cells run = snow_domain_row(domain, r);
        const double *row = values + (size_t)(r - rect->r) * (size_t)rect->width;
        int64_t first = rect->q > run.first ? rect->q : run.first;
        int64_t end = (int64_t)rect->q + rect->width;
        end = end < run.end ? end : run.end;
        for (int64_t q = first; q < end; q++) {
            snow_status status = visitor(grid, (int32_t)q, (int32_t)r, row[q - rect->q]);
            if (status != SNOW_OK)
                return status;
        }
    }
    return SNOW_OK;
}

/* Free diffusion beyond α = 2 itself makes values below zero. */
static snow_status check_sign(const snow_grid *grid, double value)
{
    if (!isfinite(value))
        return SNOW_ERROR_NOT_FINITE;
    bool sound = value >= 0 || (reiter_overshoots(reiter_of(grid)) && value > -1);
    return sound ? SNOW_OK : SNOW_ERROR_REITER_VAPOUR;
}

static snow_status check_value(snow_grid *grid, int32_t q, int32_t r, double value)
{
    (void)q;
    (void)r;
    return check_sign(grid, value);
}

static snow_status put_value(snow_grid *grid, int32_t q, int32_t r, double value)
{
    reiter *model = reiter_of(grid);
    bool was_frozen = model->engine->get(grid, q, r).frozen;
    reiter_cell cell = {.value = value, .frozen = value >= reiter_threshold(model)};
    model->engine->put(grid, q, r, &cell);
    if (model->freeze_step != NULL && was_frozen != cell.frozen)
        model->freeze_step[model->engine->number(grid, q, r)] =
            cell.frozen ? reiter_freeze_stamp(grid->census.steps) : REITER_NEVER;
    return SNOW_OK;
}

static snow_status check_vapour(snow_grid *grid, int32_t q, int32_t r, double value)
{
    if (reiter_of(grid)->engine->get(grid, q, r).receptive)
        return SNOW_OK;
    snow_status status = check_sign(grid, value);
    if (status == SNOW_OK && value >= reiter_threshold(reiter_of(grid)))
        status = SNOW_ERROR_REITER_VAPOUR;
    return status;
}

static snow_status put_vapour(snow_grid *grid, int32_t q, int32_t r, double value)
{
    const reiter *model = reiter_of(grid);
    reiter_cell cell = {.value = value};
    if (!model->engine->get(grid, q, r).receptive)
        model->engine->put(grid, q, r, &cell);
    return SNOW_OK;
}

static snow_status check_background(snow_grid *grid, int32_t q, int32_t r, double value)
{
    if (snow_domain_has(&grid->domain, q, r))
        return SNOW_OK;
    if (!isfinite(value))
        return SNOW_ERROR_NOT_FINITE;
    return reiter_is_vapour(value) ? SNOW_OK : SNOW_ERROR_REITER_BACKGROUND;
}

static snow_status put_background(snow_grid *grid, int32_t q, int32_t r, double value)
{
    reiter_cell cell = {.value = value};
    if (!snow_domain_has(&grid->domain, q, r))
        reiter_of(grid)->engine->put(grid, q, r, &cell);
    return SNOW_OK;
}

static snow_status check_addition(snow_grid *grid, int32_t q, int32_t r, double value)
{
    (void)grid;
    (void)q;
    (void)r;
    if (!isfinite(value))
        return SNOW_ERROR_NOT_FINITE;
    return value >= 0 && value <= 1 ? SNOW_OK : SNOW_ERROR_REITER_ADDITION;
}

static snow_status put_addition(snow_grid *grid, int32_t q, int32_t r, double value)
{
    reiter *model = reiter_of(grid);
    model->addition_at[model->engine->number(grid, q, r)] = value;
    return SNOW_OK;
}

static snow_status set_values(snow_grid *grid, const snow_domain *domain, const snow_rect *rect, const double *values,
                              cell_visitor check, cell_visitor put)
{
    snow_status status = visit(grid, domain, rect, values, check);
    if (status == SNOW_OK)
        status = snow_reiter_unfold(grid, false);
    if (status != SNOW_OK)
        return status;
    if (put == put_value)
        snow_reiter_merge_additions(grid); /* a neighbour that is receptive no more keeps what it had gained */
    visit(grid, domain, rect, values, put);
    snow_reiter_choose_bound(grid);
    reiter_of(grid)->engine->settle(grid);
    snow_reiter_recount(grid);
    return SNOW_OK;
}

/* What was gained so far is merged before the gains change. */
static snow_status set_additions(snow_grid *grid, const snow_rect *rect, const double *values)
{
    snow_status status = visit(grid, &grid->domain, rect, values, check_addition);
    if (status == SNOW_OK)
        status = snow_reiter_unfold(grid, true);
    if (status != SNOW_OK)
        return status;
    snow_reiter_merge_additions(grid);
    reiter_of(grid)->engine->settle(grid);
    visit(grid, &grid->domain, rect, values, put_addition);
    grid->census.still = false;
    return SNOW_OK;
}

snow_status snow_reiter_set(snow_grid *grid, snow_field field, const snow_rect *rect, const double *values)
{
    switch (field) {
    case SNOW_FIELD_VALUE: return set_values(grid, &grid->domain, rect, values, check_value, put_value);
    case SNOW_FIELD_VAPOUR: return set_values(grid, &grid->domain, rect, values, check_vapour, put_vapour);
    case SNOW_FIELD_BACKGROUND:
        return set_values(grid, &reiter_of(grid)->hull, rect, values, check_background, put_background);
    case SNOW_FIELD_ADDITION: return set_additions(grid, rect, values);
    case SNOW_FIELD_FROZEN:
    case SNOW_FIELD_RECEPTIVE:
    case SNOW_FIELD_INSIDE:
    case SNOW_FIELD_FREEZE_STEP: break;
    }
    return SNOW_ERROR_UNSUPPORTED;
}
