/* What a saved grid of this model holds: the scene, the obstacles, the particles
   in their order, the hits so far, and what the scene keeps beside them. */
#include "aggregate/model.h"
#include "base/options.h"

static void save_params(const snow_aggregate_params *params, snow_sink *sink)
{
    const int32_t numbers[] = {
        (int32_t)params->scene, (int32_t)params->lattice, (int32_t)params->contact, (int32_t)params->engine,
        params->hits, params->record_order, params->launch_radius, params->end_radius, params->width, params->height,
        params->depth, params->periodic, params->launch_first, params->launch_last, params->cathode_first,
        params->cathode_last, params->hardness_least, params->hardness_greatest, params->wall_left,
        params->wall_left_top, params->wall_right, params->wall_right_top,
    };
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        snow_sink_u32(sink, (uint32_t)numbers[i]);
    snow_sink_u64(sink, params->random_seed);
    snow_sink_u64(sink, params->particles);
    snow_sink_double(sink, params->sticking);
    snow_sink_double(sink, params->kill_radius);
    snow_sink_double(sink, params->interaction);
    snow_sink_double(sink, params->density);
    snow_sink_double(sink, params->mobility);
}

static int32_t load_number(snow_source *source)
{
    return (int32_t)snow_source_u32(source);
}

static void load_params(snow_source *source, snow_aggregate_params *params)
{
    snow_aggregate_params_init(params, sizeof *params);
    params->scene = (snow_aggregate_scene)load_number(source);
    params->lattice = (snow_aggregate_lattice)load_number(source);
    params->contact = (snow_aggregate_contact)load_number(source);
    params->engine = (snow_aggregate_engine)load_number(source);
    int32_t *const numbers[] = {
        &params->hits, &params->record_order, &params->launch_radius, &params->end_radius, &params->width,
        &params->height, &params->depth, &params->periodic, &params->launch_first, &params->launch_last,
        &params->cathode_first, &params->cathode_last, &params->hardness_least, &params->hardness_greatest,
        &params->wall_left, &params->wall_left_top, &params->wall_right, &params->wall_right_top,
    };
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        *numbers[i] = load_number(source);
    params->random_seed = snow_source_u64(source);
    params->particles = snow_source_u64(source);
    params->sticking = snow_source_double(source);
    params->kill_radius = snow_source_double(source);
    params->interaction = snow_source_double(source);
    params->density = snow_source_double(source);
    params->mobility = snow_source_double(source);
}

static void save_sites(const snow_sites *sites, uint64_t first, snow_sink *sink)
{
    snow_sink_u64(sink, sites->count - first);
    for (uint64_t i = first; i < sites->count; i++)
        snow_sink_u64(sink, snow_sites_packed(sites, i));
}

static void save_hits(const snow_table *hits, snow_sink *sink)
{
    snow_sink_u64(sink, hits->used);
    for (uint64_t i = 0; i < hits->slots; i++) {
        if (hits->count[i] == 0)
            continue;
        snow_sink_u64(sink, hits->key[i]);
        snow_sink_u32(sink, hits->count[i]);
    }
}

void snow_aggregate_save(const snow_grid *grid, snow_sink *sink)
{
    const aggregate *model = aggregate_of(grid);
    save_params(&model->params, sink);
    snow_sink_u64(sink, model->walkers);
    snow_sink_u64(sink, (uint64_t)grid->census.steps);
    snow_sink_u64(sink, model->seeds);
    save_sites(&model->obstacles, 0, sink);
    save_sites(&model->sites, 0, sink);
    save_hits(&model->hits, sink);
    if (model->scene->save != NULL)
        model->scene->save(grid, sink);
}

/* Sizes are compared with the data before anything is allocated for them. */
static snow_status load_count(snow_source *source, size_t size, uint64_t *count)
{
    *count = snow_source_u64(source);
    if (source->truncated || *count > snow_source_left(source) / size)
        return SNOW_ERROR_TRUNCATED;
    return SNOW_OK;
}

static snow_status load_sites(snow_source *source, bool space, snow_heap *heap, snow_site **sites, size_t *count)
{
    uint64_t saved;
    snow_status status = load_count(source, sizeof(uint64_t), &saved);
    if (status != SNOW_OK)
        return status;
    *sites = snow_heap_get_raw(heap, (size_t)saved + 1, sizeof **sites);
    if (*sites == NULL)
        return heap->refusal;
    *count = (size_t)saved;
    for (size_t i = 0; i < *count; i++)
        (*sites)[i] = snow_site_unpack(space, snow_source_u64(source));
    return SNOW_OK;
}

typedef struct saved_scene {
    snow_aggregate_params params;
    uint64_t walkers;
    uint64_t steps;
    uint64_t seeds;
    snow_site *obstacles;
    size_t obstacle_count;
    snow_site *sites;
    size_t site_count;
} saved_scene;

static bool has_seeds(const snow_aggregate_params *params)
{
    return params->scene != SNOW_AGGREGATE_SHORE && params->scene != SNOW_AGGREGATE_CLUSTER_CLUSTER;
}

static snow_status load_scene(snow_source *source, snow_heap *heap, saved_scene *saved)
{
    load_params(source, &saved->params);
    saved->walkers = snow_source_u64(source);
    saved->steps = snow_source_u64(source);
    saved->seeds = snow_source_u64(source);
    if (source->truncated)
        return SNOW_ERROR_TRUNCATED;
    if (snow_aggregate_params_check(&saved->params) != SNOW_OK || saved->steps > UINT64_C(1) << 62)
        return SNOW_ERROR_DAMAGED;
    bool space = aggregate_is_space(&saved->params);
    snow_status status = load_sites(source, space, heap, &saved->obstacles, &saved->obstacle_count);
    if (status == SNOW_OK)
        status = load_sites(source, space, heap, &saved->sites, &saved->site_count);
    if (status == SNOW_OK && (saved->seeds > saved->site_count || saved->site_count > AGGREGATE_MOST_PARTICLES))
        status = SNOW_ERROR_DAMAGED;
    if (status == SNOW_OK && saved->seeds > 0 && !has_seeds(&saved->params))
        status = SNOW_ERROR_DAMAGED;
    return status;
}

/* The scene begins anew with its seeds; statuses of a scene that cannot be are those of damaged data. */
static snow_status begin(const saved_scene *saved, const snow_options *options, snow_grid **grid)
{
    snow_aggregate_params params = saved->params;
    params.seeds = has_seeds(&params) ? saved->sites : NULL;
    params.seed_count = (size_t)saved->seeds;
    params.obstacles = saved->obstacle_count > 0 ? saved->obstacles : NULL;
    params.obstacle_count = saved->obstacle_count;
    snow_status status = snow_aggregate_build(&params, options, true, grid);
    return status >= SNOW_ERROR_AGGREGATE_LATTICE || status == SNOW_ERROR_NULL ? SNOW_ERROR_DAMAGED : status;
}

static bool fits(const snow_grid *grid, const saved_scene *saved, snow_site site)
{
    const aggregate *model = aggregate_of(grid);
    int32_t reach = aggregate_reach(&saved->params) - 2;
    bool near = site.x > -reach && site.x < reach && site.y > -reach && site.y < reach && site.z > -reach &&
                site.z < reach;
    return near && (model->scene->inside == NULL || model->scene->inside(grid, site));
}

/* Particles join as they did; `placed` finds two on one site. */
static snow_status rejoin(snow_grid *grid, const saved_scene *saved)
{
    aggregate *model = aggregate_of(grid);
    if (model->scene->place == NULL) /* its particles are in its own part of the data */
        return saved->site_count == 0 ? SNOW_OK : SNOW_ERROR_DAMAGED;
    snow_order placed = {0};
    snow_status status = snow_aggregate_reserve(grid, saved->site_count - saved->seeds);
    if (status == SNOW_OK)
        status = snow_order_reserve(&placed, &grid->heap, &model->sites, saved->site_count);
    for (uint64_t i = 0; i < model->sites.count && status == SNOW_OK; i++)
        snow_order_add(&placed, &model->sites, i);
    for (size_t i = (size_t)saved->seeds; i < saved->site_count && status == SNOW_OK; i++) {
        snow_site site = saved->sites[i];
        if (!fits(grid, saved, site) || snow_order_find(&placed, &model->sites, site) >= 0) {
            status = SNOW_ERROR_DAMAGED;
            break;
        }
        status = model->scene->place(grid, site);
        if (status == SNOW_OK) {
            snow_aggregate_join(grid, site);
            snow_order_add(&placed, &model->sites, model->sites.count - 1);
        }
    }
    snow_order_end(&placed, &grid->heap);
    return status;
}

static snow_status load_hits(snow_grid *grid, snow_source *source)
{
    aggregate *model = aggregate_of(grid);
    uint64_t count;
    snow_status status = load_count(source, sizeof(uint64_t) + sizeof(uint32_t), &count);
    if (status == SNOW_OK)
        status = snow_table_reserve(&model->hits, &grid->heap, count);
    for (; count > 0 && status == SNOW_OK; count--) {
        uint64_t key = snow_source_u64(source);
        uint32_t hits = snow_source_u32(source);
        if (hits < 1 || hits >= (uint32_t)model->params.hits)
            return SNOW_ERROR_DAMAGED;
        *snow_table_at(&model->hits, key) = hits;
    }
    return status;
}

static snow_status load_rest(snow_grid *grid, snow_source *source, const saved_scene *saved)
{
    aggregate *model = aggregate_of(grid);
    snow_status status = rejoin(grid, saved);
    if (status == SNOW_OK)
        status = load_hits(grid, source);
    if (status == SNOW_OK && model->scene->load != NULL)
        status = model->scene->load(grid, source);
    if (status != SNOW_OK)
        return status;
    model->walkers = saved->walkers;
    model->loading = false;
    grid->census.steps = (int64_t)saved->steps;
    snow_aggregate_follow(grid);
    return SNOW_OK;
}

snow_status snow_aggregate_load(snow_source *source, const snow_options *options, snow_grid **result)
{
    snow_options settled;
    snow_status status = snow_options_settle(options, &settled);
    if (status != SNOW_OK)
        return status;
    snow_heap heap;
    snow_heap_start(&heap, &settled);
    saved_scene saved = {.obstacles = NULL};
    snow_grid *grid = NULL;
    status = load_scene(source, &heap, &saved);
    if (status == SNOW_OK)
        status = begin(&saved, options, &grid);
    if (status == SNOW_OK)
        status = load_rest(grid, source, &saved);
    snow_heap_put(&heap, saved.obstacles);
    snow_heap_put(&heap, saved.sites);
    if (status != SNOW_OK) {
        snow_destroy(grid);
        return status;
    }
    *result = grid;
    return SNOW_OK;
}

static int feed(void *context, const void *bytes, size_t size)
{
    snow_digest_state *state = context;
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < size; i++)
        snow_digest_add(state, byte[i], 1);
    return 0;
}

/* All that is saved, less the order in which tables happen to stand. */
void snow_aggregate_digest(const snow_grid *grid, snow_digest_state *state)
{
    const aggregate *model = aggregate_of(grid);
    snow_digest_add(state, model->walkers, 8);
    for (uint64_t i = 0; i < model->sites.count; i++)
        snow_digest_add(state, snow_sites_packed(&model->sites, i), 8);
    if (model->scene->save == NULL)
        return;
    snow_sink sink;
    snow_sink_start(&sink, feed, state);
    model->scene->save(grid, &sink);
    snow_sink_end(&sink);
}
