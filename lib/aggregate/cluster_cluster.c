/* Cluster–cluster aggregation (P. Meakin; M. Kolb, R. Botet and R. Jullien,
   1983): all particles and clusters drift in a periodic box and merge. */
#include "aggregate/gaps.h"

static clusters *clusters_of(const snow_grid *grid)
{
    return aggregate_of(grid)->state;
}

static void tell(snow_grid *grid)
{
    const clusters *self = clusters_of(grid);
    grid->census.frozen = self->largest;
    grid->census.still = self->lives <= 1;
    grid->census.full = self->lives <= 1;
}

/* Merges a cluster with those that are listed as touched, each with the chance of sticking; returns how
   many were merged. */
static uint32_t merge_touched(snow_grid *grid, snow_stream *stream, uint32_t number, uint32_t count)
{
    clusters *self = clusters_of(grid);
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    uint32_t merged = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (!snow_stream_chance(stream, params->sticking))
            continue;
        number = snow_clusters_merge(self, &grid->heap, number, self->touched[i], params->mobility);
        merged++;
    }
    return merged;
}

/* Particles on random sites; those that touch may belong together from the start. */
static void scatter(snow_grid *grid)
{
    clusters *self = clusters_of(grid);
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    snow_stream stream = snow_stream_start(params->random_seed, SNOW_RANDOM_SCATTER, 0);
    uint32_t side = (uint32_t)self->box.side;
    for (uint32_t particle = 0; particle < self->particles;) {
        snow_site site = {(int32_t)snow_stream_below(&stream, side), 0, 0};
        site.y = (int32_t)snow_stream_below(&stream, side);
        if (self->box.axes == 3)
            site.z = (int32_t)snow_stream_below(&stream, side);
        if (snow_box_has(&self->box, site))
            continue;
        snow_clusters_add(self, particle, site);
        merge_touched(grid, &stream, particle, snow_clusters_find_neighbours(self, particle));
        particle++;
    }
    tell(grid);
}

static snow_status create(snow_grid *grid)
{
    aggregate *model = aggregate_of(grid);
    const snow_aggregate_params *params = &model->params;
    clusters *self = snow_heap_get(&grid->heap, 1, sizeof *self);
    if (self == NULL)
        return grid->heap.refusal;
    model->state = self;
    int axes = params->lattice == SNOW_AGGREGATE_CUBIC ? 3 : 2;
    snow_status status =
        snow_clusters_start(self, &grid->heap, (uint32_t)params->particles, params->density, axes);
    if (status == SNOW_OK && !model->loading)
        scatter(grid);
    return status;
}

/* Chances are taken relative to the most mobile cluster; which that is, is looked for after every so many mergings. */
static void follow_drag(clusters *self)
{
    if (++self->merged < self->lives / 2)
        return;
    self->merged = 0;
    self->least_drag = self->measures[self->live[0]].drag;
    for (uint32_t i = 1; i < self->lives; i++) {
        double drag = self->measures[self->live[i]].drag;
        self->least_drag = drag < self->least_drag ? drag : self->least_drag;
    }
}

static uint32_t choose(const clusters *self, snow_stream *stream, double mobility)
{
    for (;;) {
        uint32_t number = self->live[snow_stream_below(stream, self->lives)];
        if (mobility == 0 || snow_stream_uniform(stream) * self->measures[number].drag < self->least_drag)
            return number;
    }
}

/* Clusters that may touch without merging would need more than gaps. */
static bool knows_gaps(const snow_grid *grid)
{
    return aggregate_of(grid)->params.sticking == 1 && snow_gaps_apply(clusters_of(grid));
}

/* One move; *merged: whether clusters merged. */
static snow_status move_one(snow_grid *grid, bool *merged)
{
    aggregate *model = aggregate_of(grid);
    clusters *self = clusters_of(grid);
    snow_stream stream = snow_stream_start(model->params.random_seed, SNOW_RANDOM_WALK, model->walkers);
    uint32_t number = choose(self, &stream, model->params.mobility);
    int direction = (int)snow_stream_below(&stream, (uint32_t)snow_box_directions(&self->box));
    uint32_t count;
    snow_status status = knows_gaps(grid)
                             ? snow_clusters_move_few(self, &grid->heap, number, direction, &count)
                             : snow_clusters_move(self, &grid->heap, number, direction, model->params.sticking < 1,
                                                  &count);
    if (status != SNOW_OK)
        return status;
    model->walkers++;
    uint32_t mergings = merge_touched(grid, &stream, number, count);
    for (uint32_t i = 0; i < mergings; i++)
        follow_drag(self);
    *merged = mergings > 0;
    return SNOW_OK;
}

/* About what a move costs, in sites. */
static uint64_t effort(const snow_grid *grid)
{
    const clusters *self = clusters_of(grid);
    return 16 + (knows_gaps(grid) ? 4 * self->lives : self->largest);
}

/* Moves of large clusters take long: whoever runs the grid may look at the clock between them. */
static snow_status move_many(snow_grid *grid, int64_t most, const snow_stop *stop)
{
    enum { PATIENCE = 1 << 26 };
    const clusters *self = clusters_of(grid);
    int64_t merged = 0;
    for (uint64_t work = 0; merged < most && work < PATIENCE && self->lives > 1; work += effort(grid)) {
        bool joined;
        snow_status status = move_one(grid, &joined);
        if (status != SNOW_OK)
            return status;
        if (!joined)
            continue;
        merged++;
        grid->census.steps++;
        tell(grid);
        if (snow_aggregate_stops(grid, stop))
            break;
    }
    return SNOW_OK;
}

static snow_status grow(snow_grid *grid, int64_t most, const snow_stop *stop)
{
    snow_status status = move_many(grid, most, stop);
    snow_clusters_show(clusters_of(grid));
    return status;
}

static uint64_t count(const snow_grid *grid)
{
    return clusters_of(grid)->particles;
}

static bool filled(const snow_grid *grid, snow_site site)
{
    const clusters *self = clusters_of(grid);
    bool in_box = site.x >= 0 && site.x < self->box.side && site.y >= 0 && site.y < self->box.side;
    return in_box && snow_box_has(&self->box, site);
}

static bool inside(const snow_grid *grid, snow_site site)
{
    const clusters *self = clusters_of(grid);
    return site.x >= 0 && site.x < self->box.side && site.y >= 0 && site.y < self->box.side;
}

static void sites(const snow_grid *grid, uint64_t first, snow_site *result, size_t wanted)
{
    const clusters *self = clusters_of(grid);
    for (size_t i = 0; i < wanted; i++)
        result[i] = snow_clusters_site(self, &self->cluster[self->home[first + i]], self->position[first + i]);
}

static void points(const snow_grid *grid, uint64_t first, snow_point *result, size_t wanted)
{
    const clusters *self = clusters_of(grid);
    for (size_t i = 0; i < wanted; i++) {
        snow_site at = aggregate_moved(self->position[first + i], self->cluster[self->home[first + i]].origin);
        result[i] = (snow_point){at.x, at.y, at.z};
    }
}

/* Every particle is frozen, and is looked for where it has drifted. */
static void survey(const snow_grid *grid, snow_census *census)
{
    snow_site site;
    census->frozen = count(grid);
    for (uint64_t i = 0; i < census->frozen; i++) {
        sites(grid, i, &site, 1);
        double square = (double)aggregate_square(aggregate_of(grid), site);
        census->tip_square = square > census->tip_square ? square : census->tip_square;
        snow_hexagon_hold(&census->hexagon, site.x, site.y);
    }
}

int32_t snow_aggregate_box(const snow_grid *grid)
{
    return clusters_of(grid)->box.side;
}

static double gyration_of(const cluster_measures *it, double mass)
{
    double x = (double)it->sum[0] / mass;
    double y = (double)it->sum[1] / mass;
    double z = (double)it->sum[2] / mass;
    double square = (double)it->squares / mass - (x * x + y * y + z * z);
    return square > 0 ? sqrt(square) : 0;
}

size_t snow_aggregate_list_clusters(const snow_grid *grid, snow_aggregate_cluster *list)
{
    const clusters *self = clusters_of(grid);
    for (uint32_t i = 0; i < self->lives && list != NULL; i++) {
        uint32_t mass = self->cluster[self->live[i]].mass;
        list[i] = (snow_aggregate_cluster){mass, gyration_of(&self->measures[self->live[i]], mass)};
    }
    return self->lives;
}

static void save_site(snow_sink *sink, snow_site site)
{
    snow_sink_u32(sink, (uint32_t)site.x);
    snow_sink_u32(sink, (uint32_t)site.y);
    snow_sink_u32(sink, (uint32_t)site.z);
}

static snow_site load_site(snow_source *source)
{
    int32_t x = (int32_t)snow_source_u32(source);
    int32_t y = (int32_t)snow_source_u32(source);
    return (snow_site){x, y, (int32_t)snow_source_u32(source)};
}

/* Clusters and members in their order: it decides which is chosen next. */
static void save(const snow_grid *grid, snow_sink *sink)
{
    const clusters *self = clusters_of(grid);
    snow_sink_u32(sink, self->lives);
    snow_sink_u32(sink, self->merged);
    snow_sink_double(sink, self->least_drag);
    for (uint32_t i = 0; i < self->lives; i++) {
        const cluster *it = &self->cluster[self->live[i]];
        snow_sink_u32(sink, self->live[i]);
        snow_sink_u32(sink, it->mass);
        save_site(sink, it->origin);
        for (uint32_t k = 0; k < it->mass; k++) {
            uint32_t particle = self->member[it->first + k];
            snow_sink_u32(sink, particle);
            save_site(sink, self->position[particle]);
        }
    }
}

static bool is_near(snow_site site)
{
    const int32_t far = 1 << 26;
    return site.x > -far && site.x < far && site.y > -far && site.y < far && site.z > -far && site.z < far;
}

/* A member on a free site of the box; positions of the members hang together, or the measures would be wrong. */
static snow_status load_member(clusters *self, snow_source *source, uint32_t number, uint8_t *seen)
{
    cluster *it = &self->cluster[number];
    uint32_t particle = snow_source_u32(source);
    snow_site position = load_site(source);
    if (source->truncated)
        return SNOW_ERROR_TRUNCATED;
    if (particle >= self->particles || seen[particle] || !is_near(position) || (self->box.axes == 2 && position.z != 0))
        return SNOW_ERROR_DAMAGED;
    seen[particle] = 1;
    self->position[particle] = position;
    snow_site site = snow_clusters_site(self, it, position);
    if (snow_box_has(&self->box, site))
        return SNOW_ERROR_DAMAGED;
    snow_box_flip_site(&self->box, site);
    snow_clusters_count(self, it, particle);
    return SNOW_OK;
}

static snow_status load_cluster(clusters *self, snow_source *source, uint8_t *seen, double mobility)
{
    uint32_t number = snow_source_u32(source);
    uint32_t mass = snow_source_u32(source);
    snow_site origin = load_site(source);
    if (source->truncated)
        return SNOW_ERROR_TRUNCATED;
    if (number >= self->particles || self->cluster[number].mass != 0 || mass == 0 ||
        mass > self->particles - self->filled || !is_near(origin) || (self->box.axes == 2 && origin.z != 0))
        return SNOW_ERROR_DAMAGED;
    cluster *it = snow_clusters_open(self, number, mass, origin, mobility);
    snow_status status = SNOW_OK;
    for (uint32_t k = 0; k < mass && status == SNOW_OK; k++)
        status = load_member(self, source, number, seen);
    if (status == SNOW_OK)
        snow_clusters_close(self, it);
    return status;
}

static snow_status load_clusters(snow_grid *grid, snow_source *source, uint8_t *seen)
{
    clusters *self = clusters_of(grid);
    uint32_t lives = snow_source_u32(source);
    self->merged = snow_source_u32(source);
    self->least_drag = snow_source_double(source);
    snow_status status = lives >= 1 && lives <= self->particles ? SNOW_OK : SNOW_ERROR_DAMAGED;
    for (uint32_t i = 0; i < lives && status == SNOW_OK; i++)
        status = load_cluster(self, source, seen, aggregate_of(grid)->params.mobility);
    if (status != SNOW_OK)
        return status;
    double least = self->measures[self->live[0]].drag;
    for (uint32_t i = 0; i < self->lives; i++)
        least = fmin(least, self->measures[self->live[i]].drag);
    tell(grid);
    bool sound = self->filled == self->particles && self->least_drag >= 1 && self->least_drag <= least;
    return sound ? SNOW_OK : SNOW_ERROR_DAMAGED;
}

static snow_status load(snow_grid *grid, snow_source *source)
{
    uint8_t *seen = snow_heap_get(&grid->heap, clusters_of(grid)->particles, sizeof *seen);
    if (seen == NULL)
        return grid->heap.refusal;
    snow_status status = load_clusters(grid, source, seen);
    snow_heap_put(&grid->heap, seen);
    return status;
}

static void destroy(snow_grid *grid)
{
    snow_clusters_end(clusters_of(grid), &grid->heap);
    snow_heap_put(&grid->heap, clusters_of(grid));
}

const aggregate_scene snow_aggregate_cluster_cluster = {
    .create = create,
    .grow = grow,
    .filled = filled,
    .inside = inside,
    .count = count,
    .sites = sites,
    .points = points,
    .survey = survey,
    .save = save,
    .load = load,
    .destroy = destroy,
};
