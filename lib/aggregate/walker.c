/* Walkers that take one step at a time: the reference for Witten–Sander and
   line, and the laboratory sheet's own rules. Nothing here is shared with the
   engine that jumps, but for the laboratory's leaps (ring.h). */
#include "aggregate/cells.h"
#include "aggregate/circle.h"
#include "aggregate/model.h"
#include "aggregate/ring.h"
#include "aggregate/vessel.h"

typedef struct walker {
    snow_cells cells;
    const aggregate_neighbours *steps;
    bool vessel; /* floor, walls and lid */
    bool leaps;  /* over what is empty in the laboratory's ring */
    snow_ring ring;
} walker;

static walker *walker_of(const snow_grid *grid)
{
    return aggregate_of(grid)->state;
}

/* Unbounded scenes: where walkers start, and what happens far out.
   A circle of sites would over-weight some of them, so the radius is drawn from
   a smooth window several sites wide. Close to a small cluster the lattice
   still shows in the launch, hence the least radius. */
enum { LEAST_LAUNCH = 24, LAUNCH_GAP = 8, WINDOW = 8 };

/* Farther out than so many launch radii a walker is brought back. */
static const double return_ratio = 1.5;

static double launch_radius(const snow_grid *grid)
{
    double tip = snow_census_tip(&grid->census);
    double reach = aggregate_of(grid)->obstacle_tip;
    double radius = 1.25 * (tip > reach ? tip : reach) + LAUNCH_GAP;
    return radius > LEAST_LAUNCH ? radius : LEAST_LAUNCH;
}

static double in_window(snow_stream *stream, double radius)
{
    double sum = 0;
    for (int part = 0; part < 3; part++)
        sum += snow_stream_uniform(stream);
    return radius + sum * (WINDOW / 3.0);
}

/* A uniform point of the unit sphere (G. Marsaglia, Ann. Math. Stat. 43 (1972) 645) or circle. */
static snow_point direction(snow_stream *stream, bool space)
{
    if (!space) {
        snow_direction plane = snow_stream_direction(stream);
        return (snow_point){plane.x, plane.y, 0};
    }
    for (;;) {
        double a = 2 * snow_stream_uniform(stream) - 1;
        double b = 2 * snow_stream_uniform(stream) - 1;
        double square = a * a + b * b;
        if (square < 1) {
            double root = 2 * sqrt(1 - square);
            return (snow_point){a * root, b * root, 1 - 2 * square};
        }
    }
}

static snow_site scaled_site(snow_aggregate_lattice lattice, snow_point point, double radius)
{
    return snow_aggregate_site_of(lattice, (snow_point){point.x * radius, point.y * radius, point.z * radius});
}

/* Where Brownian motion from outside first meets the sphere, which a walker at distance d ever does with chance
   radius/d; otherwise it is gone, and another one comes from infinity. */
static snow_point hit_sphere(snow_stream *stream, snow_point from, double radius)
{
    double distance = sqrt(from.x * from.x + from.y * from.y + from.z * from.z);
    double g = radius / distance;
    if (snow_stream_uniform(stream) >= g)
        return direction(stream, true);
    double ratio = (1 - g * g) / (1 - g + 2 * g * snow_stream_uniform(stream));
    double cosine = (1 + g * g - ratio * ratio) / (2 * g);
    double sine = sqrt(cosine < 1 && cosine > -1 ? 1 - cosine * cosine : 0);
    snow_point axis = {from.x / distance, from.y / distance, from.z / distance};
    snow_point side = direction(stream, true); /* its part across the axis is uniform round it */
    double along = side.x * axis.x + side.y * axis.y + side.z * axis.z;
    snow_point across = {side.x - along * axis.x, side.y - along * axis.y, side.z - along * axis.z};
    double length = sqrt(across.x * across.x + across.y * across.y + across.z * across.z);
    double factor = length > 0 ? sine / length : 0;
    return (snow_point){cosine * axis.x + factor * across.x, cosine * axis.y + factor * across.y,
                        cosine * axis.z + factor * across.z};
}

static snow_site brought_back(snow_stream *stream, const snow_aggregate_params *params, snow_site from, double radius)
{
    double target = in_window(stream, radius);
    snow_point point = snow_aggregate_point_of(params->lattice, from);
    if (params->lattice == SNOW_AGGREGATE_CUBIC)
        return scaled_site(params->lattice, hit_sphere(stream, point, target), target);
    snow_direction hit = snow_circle_hit(stream, point.x, point.y, target);
    return scaled_site(params->lattice, (snow_point){hit.x, hit.y, 0}, target);
}

static bool is_beyond(const aggregate *model, snow_site site, double radius)
{
    return (double)aggregate_square(model, site) > radius * radius;
}

/* What becomes of a walker that has gone far: true when it is lost. */
static bool look_after(const aggregate *model, snow_stream *stream, double radius, snow_site *site)
{
    const snow_aggregate_params *params = &model->params;
    if (params->scene == SNOW_AGGREGATE_LABORATORY)
        return is_beyond(model, *site, 3.0 * params->launch_radius);
    if (params->kill_radius > 0)
        return is_beyond(model, *site, params->kill_radius * radius);
    if (is_beyond(model, *site, return_ratio * (radius + WINDOW)))
        *site = brought_back(stream, params, *site, radius);
    return false;
}

static snow_site launched(const snow_grid *grid, snow_stream *stream, double *radius)
{
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    if (params->scene == SNOW_AGGREGATE_LINE)
        return snow_vessel_launch(params, stream);
    bool space = params->lattice == SNOW_AGGREGATE_CUBIC;
    if (params->scene == SNOW_AGGREGATE_LABORATORY)
        return scaled_site(params->lattice, direction(stream, space), params->launch_radius);
    *radius = launch_radius(grid);
    double distance = in_window(stream, *radius);
    return scaled_site(params->lattice, direction(stream, space), distance);
}

static bool walk(const snow_grid *grid, snow_stream *stream, snow_site *end)
{
    const aggregate *model = aggregate_of(grid);
    const walker *self = walker_of(grid);
    bool arrival = model->params.contact == SNOW_AGGREGATE_ARRIVAL;
    double radius = 0;
    snow_site at = launched(grid, stream, &radius);
    uint8_t here = snow_cells_get(&self->cells, at);
    int level = 0; /* of the latest leap */
    for (;;) {
        while (self->leaps && snow_ring_leap(&self->ring, stream, &at, &level))
            here = snow_cells_get(&self->cells, at);
        if (arrival && (here & SNOW_CELL_NEAR) && snow_stream_chance(stream, model->params.sticking))
            break;
        snow_site next =
            aggregate_moved(at, self->steps->step[snow_stream_below(stream, (uint32_t)self->steps->count)]);
        if (self->vessel)
            next = snow_vessel_keep(&model->params, next);
        else if (look_after(model, stream, radius, &next))
            return false;
        uint8_t there = snow_cells_get(&self->cells, next);
        if (there & (SNOW_CELL_FILLED | SNOW_CELL_ELECTRODE)) {
            if (!arrival && snow_stream_chance(stream, model->params.sticking))
                break;
        } else if (!(there & SNOW_CELL_BARRED)) {
            at = next;
            here = there;
        }
    }
    *end = at;
    return true;
}

/* The floor of a vessel lies below its lowest row. */
static void mark_floor(snow_grid *grid)
{
    walker *self = walker_of(grid);
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    bool space = params->lattice == SNOW_AGGREGATE_CUBIC;
    snow_site low = self->cells.low;
    for (int32_t x = low.x; x < low.x + self->cells.extent.x; x++) {
        for (int32_t y = space ? low.y : -1; y < (space ? low.y + self->cells.extent.y : 0); y++) {
            snow_site below = {x, y, space ? -1 : 0};
            snow_site first = {x, space ? y : 0, 0};
            *snow_cells_at(&self->cells, below) |= SNOW_CELL_ELECTRODE;
            *snow_cells_at(&self->cells, first) |= SNOW_CELL_NEAR;
        }
    }
}

static snow_status cover(snow_grid *grid, snow_site low, snow_site high)
{
    walker *self = walker_of(grid);
    snow_status status = snow_cells_cover(&self->cells, &grid->heap, low, high);
    if (status == SNOW_OK && self->leaps)
        status = snow_ring_cover(&self->ring, &grid->heap, low, high);
    return status;
}

/* Particles can join within one site of those that are there, and touch one farther. */
static snow_status prepare(snow_grid *grid)
{
    enum { MARGIN = 3 };
    const aggregate *model = aggregate_of(grid);
    const snow_aggregate_params *params = &model->params;
    walker *self = walker_of(grid);
    bool space = params->lattice == SNOW_AGGREGATE_CUBIC;
    snow_site low = {model->low.x - MARGIN, model->low.y - MARGIN, space ? model->low.z - MARGIN : 0};
    snow_site high = {model->high.x + MARGIN, model->high.y + MARGIN, space ? model->high.z + MARGIN : 0};
    if (self->vessel) {
        int32_t top = (model->sites.count > 0 ? aggregate_height(model, model->high) : 0) + MARGIN;
        bool hexagonal = params->lattice == SNOW_AGGREGATE_HEXAGONAL;
        low = (snow_site){-1 - (hexagonal ? params->height / 2 : 0), -1, space ? -1 : 0};
        high = (snow_site){params->width, space ? params->depth : top, space ? top : 0};
    }
    return cover(grid, low, high);
}

static snow_status create(snow_grid *grid)
{
    aggregate *model = aggregate_of(grid);
    walker *self = snow_heap_get(&grid->heap, 1, sizeof *self);
    if (self == NULL)
        return grid->heap.refusal;
    model->state = self;
    self->steps = snow_aggregate_steps(model->params.lattice);
    self->vessel = model->params.scene == SNOW_AGGREGATE_LINE;
    self->leaps = model->params.scene == SNOW_AGGREGATE_LABORATORY && model->params.engine != SNOW_AGGREGATE_ENGINE_STEPS;
    snow_status status = self->vessel ? prepare(grid) : SNOW_OK;
    if (self->leaps)
        status = snow_ring_start(&self->ring, &grid->heap, model->params.lattice, 3.0 * model->params.launch_radius);
    for (uint64_t i = 0; i < model->obstacles.count && status == SNOW_OK; i++) {
        snow_site obstacle = snow_sites_at(&model->obstacles, i);
        status = cover(grid, obstacle, obstacle);
        if (status != SNOW_OK)
            break;
        *snow_cells_at(&self->cells, obstacle) |= SNOW_CELL_BARRED;
        if (self->leaps)
            snow_ring_add(&self->ring, obstacle);
    }
    if (status == SNOW_OK && self->vessel)
        mark_floor(grid);
    return status;
}

static snow_status place(snow_grid *grid, snow_site site)
{
    walker *self = walker_of(grid);
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    bool space = params->lattice == SNOW_AGGREGATE_CUBIC;
    snow_site low = {site.x - 1, site.y - 1, space ? site.z - 1 : 0};
    snow_site high = {site.x + 1, site.y + 1, space ? site.z + 1 : 0};
    snow_status status = cover(grid, low, high);
    if (status != SNOW_OK)
        return status;
    *snow_cells_at(&self->cells, site) |= SNOW_CELL_FILLED;
    if (self->leaps)
        snow_ring_add(&self->ring, site);
    for (int i = 0; i < self->steps->count; i++) {
        snow_site next = aggregate_moved(site, self->steps->step[i]);
        snow_cells_mark(&self->cells, self->vessel ? snow_vessel_keep(params, next) : next, SNOW_CELL_NEAR);
    }
    return SNOW_OK;
}

static bool filled(const snow_grid *grid, snow_site site)
{
    return (snow_cells_get(&walker_of(grid)->cells, site) & SNOW_CELL_FILLED) != 0;
}

static void destroy(snow_grid *grid)
{
    walker *self = walker_of(grid);
    snow_cells_end(&self->cells, &grid->heap);
    snow_ring_end(&self->ring, &grid->heap);
    snow_heap_put(&grid->heap, self);
}

const aggregate_scene snow_aggregate_walker = {
    .create = create,
    .prepare = prepare,
    .place = place,
    .walk = walk,
    .filled = filled,
    .inside = snow_vessel_inside,
    .destroy = destroy,
};
