/* Which symmetries a scene has, and what happens when it loses them. */
#include "base/hexagon.h"
#include "base/sort.h"
#include "reiter/model.h"

#include <stdlib.h>

static int compare_cells(const void *a, const void *b)
{
    const snow_cell *x = a;
    const snow_cell *y = b;
    if (x->r != y->r)
        return x->r < y->r ? -1 : 1;
    return (x->q > y->q) - (x->q < y->q);
}

static bool has_symmetry(const snow_cell *seeds, size_t count, int symmetry)
{
    for (size_t i = 0; i < count; i++) {
        int64_t q;
        int64_t r;
        snow_hexagon_image(symmetry, seeds[i].q, seeds[i].r, &q, &r);
        snow_cell image = {(int32_t)q, (int32_t)r};
        if (bsearch(&image, seeds, count, sizeof image, compare_cells) == NULL)
            return false;
    }
    return true;
}

snow_group snow_reiter_group_of_seeds(snow_cell *seeds, size_t count)
{
    if (count == 0)
        return SNOW_GROUP_FULL;
    snow_sort(seeds, count, sizeof *seeds, compare_cells);
    snow_group group = 0;
    for (int symmetry = 0; symmetry < SNOW_HEXAGON_SYMMETRIES; symmetry++)
        if (has_symmetry(seeds, count, symmetry))
            group |= (snow_group)1 << symmetry;
    return group;
}

/* What depends on how the engine keeps the cells. */
typedef struct keeping {
    snow_group group;
    void *cells;
    double *addition_at;
    uint32_t *freeze_step;
} keeping;

static keeping exchange(reiter *model, keeping with)
{
    keeping old = {model->group, model->cells, model->addition_at, model->freeze_step};
    model->group = with.group;
    model->cells = with.cells;
    model->addition_at = with.addition_at;
    model->freeze_step = with.freeze_step;
    return old;
}

static void discard(snow_grid *grid)
{
    reiter *model = reiter_of(grid);
    if (model->cells != NULL)
        model->engine->destroy(grid);
    snow_heap_put(&grid->heap, model->addition_at);
    snow_heap_put(&grid->heap, model->freeze_step);
}

static void copy_cell(snow_grid *grid, keeping *folded, snow_cell at)
{
    reiter *model = reiter_of(grid);
    keeping unfolded = exchange(model, *folded);
    reiter_cell cell = model->engine->get(grid, at.q, at.r);
    size_t from = snow_domain_has(&grid->domain, at.q, at.r) ? model->engine->number(grid, at.q, at.r) : 0;
    exchange(model, unfolded);
    model->engine->put(grid, at.q, at.r, &cell);
    if (model->freeze_step != NULL && snow_domain_has(&grid->domain, at.q, at.r))
        model->freeze_step[model->engine->number(grid, at.q, at.r)] = folded->freeze_step[from];
}

static snow_status give_own_additions(snow_grid *grid)
{
    reiter *model = reiter_of(grid);
    size_t numbers = model->engine->numbers(grid);
    double *addition_at = snow_heap_get_raw(&grid->heap, numbers, sizeof *addition_at);
    if (addition_at == NULL)
        return grid->heap.refusal;
    for (size_t i = 0; i < numbers; i++)
        addition_at[i] = model->params.addition;
    model->addition_at = addition_at;
    return SNOW_OK;
}

/* A folded scene has no additions that differ from cell to cell. */
snow_status snow_reiter_unfold(snow_grid *grid, bool own_additions)
{
    reiter *model = reiter_of(grid);
    if (model->group == SNOW_GROUP_TRIVIAL)
        return own_additions && model->addition_at == NULL ? give_own_additions(grid) : SNOW_OK;
    keeping folded = exchange(model, (keeping){.group = SNOW_GROUP_TRIVIAL});
    snow_status status = snow_reiter_equip(grid, SNOW_GROUP_TRIVIAL);
    if (status == SNOW_OK && own_additions)
        status = give_own_additions(grid);
    if (status != SNOW_OK) {
        discard(grid);
        exchange(model, folded);
        return status;
    }
    for (snow_walk walk = snow_walk_over(&model->hull, NULL); snow_walk_next(&walk);)
        copy_cell(grid, &folded, walk.cell);
    model->engine->settle(grid);
    keeping unfolded = exchange(model, folded);
    discard(grid);
    exchange(model, unfolded);
    return SNOW_OK;
}
