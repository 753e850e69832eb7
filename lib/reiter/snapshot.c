/* What a saved grid of Reiter's model holds: the scene, then the cells row by
   row. It does not depend on the engine. */
#include "reiter/model.h"

typedef enum cell_kind {
    KIND_VAPOUR = 0,
    KIND_RECEPTIVE = 1,
    KIND_FROZEN = 2
} cell_kind;

/* The fewest bytes of an interior cell: its kind and its value. */
enum { LEAST_CELL_SIZE = 9 };

static cell_kind kind_of(const reiter_cell *cell)
{
    return cell->frozen ? KIND_FROZEN : cell->receptive ? KIND_RECEPTIVE : KIND_VAPOUR;
}

static void save_scene(const snow_grid *grid, snow_sink *sink)
{
    const reiter *model = reiter_of(grid);
    const snow_reiter_params *params = &model->params;
    snow_sink_double(sink, params->background);
    snow_sink_double(sink, params->addition);
    snow_sink_double(sink, params->diffusion);
    snow_sink_u32(sink, (uint32_t)params->domain);
    snow_sink_u32(sink, (uint32_t)params->radius);
    snow_sink_u32(sink, (uint32_t)params->width);
    snow_sink_u32(sink, (uint32_t)params->height);
    snow_sink_u32(sink, (uint32_t)params->rim);
    snow_sink_u32(sink, (uint32_t)params->engine);
    snow_sink_u32(sink, (uint32_t)params->symmetry);
    snow_sink_u32(sink, (uint32_t)params->precision);
    snow_sink_double(sink, params->tolerance);
    snow_sink_u32(sink, model->group);
    snow_sink_u8(sink, params->record_freeze_steps != 0);
    snow_sink_u8(sink, params->allow_unstable != 0);
    snow_sink_u8(sink, model->addition_at != NULL);
    snow_sink_u8(sink, grid->census.still);
    snow_sink_double(sink, model->bound);
    snow_sink_u64(sink, (uint64_t)grid->census.steps);
}

static void save_value(const reiter *model, snow_sink *sink, const reiter_cell *cell)
{
    snow_sink_double(sink, cell->value);
    if (model->engine == &snow_reiter_quad)
        snow_sink_double(sink, cell->low);
}

static void save_cell(const snow_grid *grid, snow_sink *sink, snow_cell at)
{
    const reiter *model = reiter_of(grid);
    size_t number = model->engine->number(grid, at.q, at.r);
    reiter_cell cell = model->engine->get(grid, at.q, at.r);
    snow_sink_u8(sink, (uint8_t)kind_of(&cell));
    save_value(model, sink, &cell);
    if (cell.receptive)
        snow_sink_u32(sink, cell.additions);
    if (cell.frozen && model->freeze_step != NULL)
        snow_sink_u32(sink, model->freeze_step[number]);
    if (model->addition_at != NULL)
        snow_sink_double(sink, model->addition_at[number]);
}

void snow_reiter_save(const snow_grid *grid, snow_sink *sink)
{
    const reiter *model = reiter_of(grid);
    save_scene(grid, sink);
    for (snow_walk walk = reiter_walk_part(grid); snow_walk_next(&walk);)
        save_cell(grid, sink, walk.cell);
    for (snow_walk walk = reiter_walk_fixed(grid); snow_walk_next(&walk);) {
        reiter_cell cell = model->engine->get(grid, walk.cell.q, walk.cell.r);
        save_value(model, sink, &cell);
    }
}

typedef struct saved_scene {
    snow_reiter_params params;
    snow_group group; /* by which the cells are folded */
    bool own_additions;
    bool still;
    double bound;
    int64_t steps;
} saved_scene;

static snow_status load_scene(snow_source *source, saved_scene *scene)
{
    snow_reiter_params *params = &scene->params;
    snow_reiter_params_init(params, sizeof *params);
    params->background = snow_source_double(source);
    params->addition = snow_source_double(source);
    params->diffusion = snow_source_double(source);
    params->domain = (snow_reiter_domain)snow_source_u32(source);
    params->radius = (int32_t)snow_source_u32(source);
    params->width = (int32_t)snow_source_u32(source);
    params->height = (int32_t)snow_source_u32(source);
    params->rim = (snow_reiter_rim)snow_source_u32(source);
    params->engine = (snow_reiter_engine)snow_source_u32(source);
    params->symmetry = (snow_reiter_symmetry)snow_source_u32(source);
    params->precision = (snow_reiter_precision)snow_source_u32(source);
    params->tolerance = snow_source_double(source);
    scene->group = snow_source_u32(source);
    params->record_freeze_steps = snow_source_u8(source);
    params->allow_unstable = snow_source_u8(source);
    uint8_t own_additions = snow_source_u8(source);
    uint8_t still = snow_source_u8(source);
    scene->own_additions = own_additions == 1;
    scene->still = still == 1;
    scene->bound = snow_source_double(source);
    uint64_t steps = snow_source_u64(source);
    scene->steps = (int64_t)steps;
    if (source->truncated)
        return SNOW_ERROR_TRUNCATED;
    int exponent;
    bool sound = own_additions <= 1 && still <= 1 && steps <= UINT64_C(1) << 62 && scene->bound > 0x1p-65 &&
                 scene->bound < 0x1p11 && frexp(scene->bound, &exponent) == 0.5 && snow_group_is_closed(scene->group) &&
                 snow_reiter_params_check(params) == SNOW_OK;
    if (!sound)
        return SNOW_ERROR_DAMAGED;
    /* Sizes are compared with the data before anything is allocated for them. */
    uint64_t least = snow_reiter_cells(params) / (uint64_t)snow_group_order(scene->group) * LEAST_CELL_SIZE;
    return least <= snow_source_left(source) ? SNOW_OK : SNOW_ERROR_TRUNCATED;
}

/* Above α = 2 cells can collect less than nothing, but not without end. */
static const double greatest_collected = 0x1p20;

static bool is_sound_cell(const reiter *model, const saved_scene *scene, const reiter_cell *cell, double addition)
{
    if (!isfinite(cell->value) || !isfinite(cell->low) || !(addition >= 0 && addition <= 1))
        return false;
    if (cell->additions > REITER_MERGE_STEPS || cell->additions > scene->steps)
        return false;
    if (cell->frozen)
        return true;
    double greatest = cell->receptive ? greatest_collected : scene->bound;
    return fabs(cell->value) <= greatest && reiter_value(cell, addition) < reiter_threshold(model);
}

static void load_value(const reiter *model, snow_source *source, reiter_cell *cell)
{
    cell->value = snow_source_double(source);
    if (model->engine == &snow_reiter_quad)
        cell->low = snow_source_double(source);
}

static snow_status load_cell(snow_grid *grid, snow_source *source, const saved_scene *scene, snow_cell at)
{
    reiter *model = reiter_of(grid);
    size_t number = model->engine->number(grid, at.q, at.r);
    uint8_t kind = snow_source_u8(source);
    reiter_cell cell = {.frozen = kind == KIND_FROZEN, .receptive = kind != KIND_VAPOUR};
    load_value(model, source, &cell);
    if (cell.receptive)
        cell.additions = snow_source_u32(source);
    if (cell.frozen && model->freeze_step != NULL)
        model->freeze_step[number] = snow_source_u32(source);
    double addition = model->params.addition;
    if (model->addition_at != NULL)
        addition = model->addition_at[number] = snow_source_double(source);
    if (source->truncated)
        return SNOW_ERROR_TRUNCATED;
    if (kind > KIND_FROZEN || !is_sound_cell(model, scene, &cell, addition))
        return SNOW_ERROR_DAMAGED;
    model->engine->put(grid, at.q, at.r, &cell);
    return SNOW_OK;
}

static snow_status load_fixed(snow_grid *grid, snow_source *source, const saved_scene *scene)
{
    const reiter *model = reiter_of(grid);
    for (snow_walk walk = reiter_walk_fixed(grid); snow_walk_next(&walk);) {
        reiter_cell cell = {.value = 0};
        load_value(model, source, &cell);
        if (source->truncated)
            return SNOW_ERROR_TRUNCATED;
        if (!is_sound_cell(model, scene, &cell, 0))
            return SNOW_ERROR_DAMAGED;
        model->engine->put(grid, walk.cell.q, walk.cell.r, &cell);
    }
    return SNOW_OK;
}

static snow_status load_part(snow_grid *grid, snow_source *source, const saved_scene *scene)
{
    for (snow_walk walk = reiter_walk_part(grid); snow_walk_next(&walk);) {
        snow_status status = load_cell(grid, source, scene, walk.cell);
        if (status != SNOW_OK)
            return status;
    }
    return SNOW_OK;
}

static snow_status load_cells(snow_grid *grid, snow_source *source, const saved_scene *scene)
{
    reiter *model = reiter_of(grid);
    if ((snow_group_of_domain(&grid->domain) & scene->group) != scene->group)
        return SNOW_ERROR_DAMAGED;
    snow_status status = snow_reiter_equip(grid, scene->group);
    if (status != SNOW_OK)
        return status;
    if (model->group != scene->group)
        return SNOW_ERROR_DAMAGED;
    grid->census.steps = scene->steps;
    model->bound = scene->bound;
    if (scene->own_additions) {
        model->addition_at = snow_heap_get(&grid->heap, model->engine->numbers(grid), sizeof *model->addition_at);
        if (model->addition_at == NULL)
            return grid->heap.refusal;
    }
    status = load_part(grid, source, scene);
    if (status == SNOW_OK)
        status = load_fixed(grid, source, scene);
    if (status != SNOW_OK)
        return status;
    if (!snow_reiter_receptive_are_sound(grid))
        return SNOW_ERROR_DAMAGED;
    model->engine->settle(grid);
    snow_reiter_recount(grid);
    grid->census.still = scene->still;
    return SNOW_OK;
}

snow_status snow_reiter_load(snow_source *source, const snow_options *options, snow_grid **result)
{
    saved_scene scene;
    snow_status status = load_scene(source, &scene);
    snow_grid *grid = NULL;
    if (status == SNOW_OK)
        status = snow_reiter_build(&scene.params, options, &grid);
    if (status == SNOW_OK)
        status = load_cells(grid, source, &scene);
    return snow_grid_hand_over(grid, status, result);
}
