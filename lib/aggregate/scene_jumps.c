/* Witten–Sander and line by jumps: growth.h does the walking. */
#include "aggregate/growth.h"
#include "aggregate/model.h"
#include "aggregate/vessel.h"

typedef struct jumps {
    snow_growth *growth;
    int64_t wanted; /* of the present call */
    const snow_stop *stop;
} jumps;

static jumps *jumps_of(const snow_grid *grid)
{
    return aggregate_of(grid)->state;
}

static snow_growth_rules rules_of(const snow_grid *grid)
{
    const aggregate *model = aggregate_of(grid);
    const snow_aggregate_params *params = &model->params;
    snow_growth_rules rules = {
        .lattice = params->lattice,
        .contact = params->contact,
        .stick = params->sticking,
        .has_obstacles = model->obstacles.count > 0,
        .seed = params->random_seed,
        .isa = grid->options.isa,
    };
    if (params->scene == SNOW_AGGREGATE_LINE) {
        rules.width = params->width;
        rules.depth = params->depth;
        rules.lid = params->height - 1;
    }
    return rules;
}

static snow_status create(snow_grid *grid)
{
    aggregate *model = aggregate_of(grid);
    jumps *self = snow_heap_get(&grid->heap, 1, sizeof *self);
    if (self == NULL)
        return grid->heap.refusal;
    model->state = self;
    snow_growth_rules rules = rules_of(grid);
    snow_status status = snow_growth_start(&self->growth, &grid->heap, &rules);
    for (uint64_t i = 0; i < model->obstacles.count && status == SNOW_OK; i++) {
        snow_site obstacle = snow_sites_at(&model->obstacles, i);
        status = snow_growth_obstruct(self->growth, &grid->heap, &obstacle, 1);
    }
    return status;
}

static snow_status place(snow_grid *grid, snow_site site)
{
    return snow_growth_fill(jumps_of(grid)->growth, &grid->heap, &site, 1);
}

static bool fills(const void *context, snow_site site)
{
    const aggregate *model = aggregate_of(context);
    uint32_t hits = snow_table_get(&model->hits, snow_site_pack(model->sites.space, site));
    return hits + 1 >= (uint32_t)model->params.hits;
}

/* The last walker of a call is the one after which there is no room in the table of hits. */
static bool arrives(void *context, snow_site site, bool filled)
{
    snow_grid *grid = context;
    aggregate *model = aggregate_of(grid);
    jumps *self = jumps_of(grid);
    if (model->params.hits > 1)
        snow_aggregate_hit(grid, site);
    if (filled) {
        snow_aggregate_join(grid, site);
        grid->census.steps++;
        self->wanted--;
        if (snow_aggregate_stops(grid, self->stop))
            return false;
    }
    return model->params.hits == 1 || snow_table_has_room(&model->hits);
}

static void loop(void *context, size_t count, snow_task task, void *argument)
{
    snow_grid_for(context, count, task, argument);
}

static snow_status grow(snow_grid *grid, int64_t most, const snow_stop *stop)
{
    aggregate *model = aggregate_of(grid);
    jumps *self = jumps_of(grid);
    self->wanted = most;
    self->stop = stop;
    snow_growth_port port = {model->params.hits > 1 ? fills : NULL, arrives, grid};
    snow_growth_crew crew = {loop, grid, grid->options.threads};
    snow_status status = SNOW_OK;
    while (status == SNOW_OK && self->wanted > 0 && !snow_aggregate_stops(grid, stop)) {
        if (model->params.hits > 1)
            status = snow_table_reserve(&model->hits, &grid->heap, (uint64_t)self->wanted);
        if (status == SNOW_OK)
            status = snow_growth_run(self->growth, &grid->heap, &crew, (uint64_t)self->wanted, &model->walkers, &port);
    }
    return status;
}

static snow_status sample(const snow_grid *grid, snow_heap *heap, uint64_t key, uint64_t walks, aggregate_ends ends,
                          void *context)
{
    const uint64_t other_streams = UINT64_C(1) << 63; /* than those of the growth, also where the keys are the same */
    return snow_growth_sample(jumps_of(grid)->growth, heap, key, other_streams, walks, ends, context);
}

static void destroy(snow_grid *grid)
{
    jumps *self = jumps_of(grid);
    if (self->growth != NULL)
        snow_growth_end(self->growth, &grid->heap);
    snow_heap_put(&grid->heap, self);
}

const aggregate_scene snow_aggregate_jumps = {
    .create = create,
    .place = place,
    .sample = sample,
    .grow = grow,
    .inside = snow_vessel_inside,
    .destroy = destroy,
};
