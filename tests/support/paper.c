#include "paper.h"

#include "grids.h"

#include <stdlib.h>

struct paper {
    int32_t reach; /* cells with |q|, |r| <= reach have a place */
    long double alpha;
    long double *u, *v, *gamma;
    bool *inside, *receptive;
};

static size_t place(const paper *model, int32_t q, int32_t r)
{
    size_t side = (size_t)(2 * model->reach + 1);
    return (size_t)(r + model->reach) * side + (size_t)(q + model->reach);
}

static bool belongs(const snow_reiter_params *params, int32_t q, int32_t r)
{
    switch (params->domain) {
    case SNOW_REITER_DISC:
        return q * q + q * r + r * r < params->radius * params->radius;
    case SNOW_REITER_HEXAGON:
        return abs(q) < params->radius && abs(r) < params->radius && abs(q + r) < params->radius;
    case SNOW_REITER_RECTANGLE: {
        int32_t middle = params->height / 2;
        int32_t row = r + middle;
        if (row < 0 || row >= params->height)
            return false;
        /* x = q + r/2, less the half cell of odd rows, counted in half cells. */
        int32_t halves = 2 * q + r - row % 2 + middle % 2;
        int32_t column = params->width / 2 + halves / 2;
        return column >= 0 && column < params->width;
    }
    }
    return false;
}

static bool is_ice(long double u)
{
    return u >= 1 - (long double)SNOW_REITER_SLACK;
}

static void *zeroed(size_t count, size_t size)
{
    void *block = calloc(count, size);
    assert_non_null(block);
    return block;
}

static void fill(paper *model, const snow_reiter_params *params)
{
    for (int32_t r = -model->reach; r <= model->reach; r++) {
        for (int32_t q = -model->reach; q <= model->reach; q++) {
            size_t at = place(model, q, r);
            model->inside[at] = belongs(params, q, r);
            model->u[at] = params->background_at != NULL
                               ? (long double)params->background_at(params->field_context, q, r)
                               : (long double)params->background;
            model->gamma[at] = params->addition_at != NULL
                                   ? (long double)params->addition_at(params->field_context, q, r)
                                   : (long double)params->addition;
        }
    }
    if (params->seeds == NULL)
        model->u[place(model, 0, 0)] = 1;
    for (size_t i = 0; params->seeds != NULL && i < params->seed_count; i++)
        model->u[place(model, params->seeds[i].q, params->seeds[i].r)] = 1;
}

paper *paper_new(const snow_reiter_params *params)
{
    bool rectangle = params->domain == SNOW_REITER_RECTANGLE;
    paper *model = zeroed(1, sizeof *model);
    model->reach = rectangle ? params->width + params->height + 2 : 2 * params->radius + 2;
    model->alpha = (long double)params->diffusion;
    size_t side = (size_t)(2 * model->reach + 1);
    model->u = zeroed(side * side, sizeof *model->u);
    model->v = zeroed(side * side, sizeof *model->v);
    model->gamma = zeroed(side * side, sizeof *model->gamma);
    model->inside = zeroed(side * side, sizeof *model->inside);
    model->receptive = zeroed(side * side, sizeof *model->receptive);
    fill(model, params);
    return model;
}

void paper_delete(paper *model)
{
    free(model->u);
    free(model->v);
    free(model->gamma);
    free(model->inside);
    free(model->receptive);
    free(model);
}

static bool is_receptive(const paper *model, int32_t q, int32_t r)
{
    if (!paper_inside(model, q, r))
        return false;
    bool receptive = paper_is_ice(model, q, r);
    for (int i = 0; i < 6; i++)
        receptive = receptive || paper_is_ice(model, q + neighbours[i].q, r + neighbours[i].r);
    return receptive;
}

static void split(paper *model)
{
    for (int32_t r = -model->reach; r <= model->reach; r++) {
        for (int32_t q = -model->reach; q <= model->reach; q++) {
            size_t at = place(model, q, r);
            model->receptive[at] = is_receptive(model, q, r);
            model->v[at] = model->receptive[at] ? 0 : model->u[at];
        }
    }
}

static void step_once(paper *model)
{
    split(model);
    for (int32_t r = 1 - model->reach; r < model->reach; r++) {
        for (int32_t q = 1 - model->reach; q < model->reach; q++) {
            size_t at = place(model, q, r);
            if (!model->inside[at])
                continue;
            long double sum = -6 * model->v[at];
            for (int i = 0; i < 6; i++)
                sum += model->v[place(model, q + neighbours[i].q, r + neighbours[i].r)];
            long double kept = model->receptive[at] ? model->u[at] + model->gamma[at] : 0;
            model->u[at] = kept + model->v[at] + model->alpha / 12 * sum;
        }
    }
}

void paper_step(paper *model, int64_t steps)
{
    for (int64_t i = 0; i < steps; i++)
        step_once(model);
}

bool paper_inside(const paper *model, int32_t q, int32_t r)
{
    return abs(q) <= model->reach && abs(r) <= model->reach && model->inside[place(model, q, r)];
}

bool paper_is_ice(const paper *model, int32_t q, int32_t r)
{
    return paper_inside(model, q, r) && is_ice(model->u[place(model, q, r)]);
}

long double paper_value(const paper *model, int32_t q, int32_t r)
{
    return model->u[place(model, q, r)];
}
