#include "aggregate/growth.h"

#include "aggregate/ahead.h"
#include "aggregate/flight.h"

#include "base/hexagon.h"

struct snow_growth {
    snow_growth_rules rules;
    snow_ground ground;
    int64_t farthest; /* squared distance, or row, of the farthest filled site or obstacle */
    snow_ahead ahead;
};

static bool is_in_space(const snow_growth *growth)
{
    return growth->rules.lattice == SNOW_AGGREGATE_CUBIC;
}

static int64_t distance_of(const snow_growth *growth, snow_site site)
{
    int64_t x = site.x;
    int64_t y = site.y;
    int64_t z = site.z;
    if (growth->rules.width > 0)
        return is_in_space(growth) ? z : y;
    if (growth->rules.lattice == SNOW_AGGREGATE_HEXAGONAL)
        return snow_hexagon_square(x, y);
    return x * x + y * y + z * z;
}

static int64_t whole(int64_t sites, int64_t unit)
{
    return (sites + unit - 1) / unit * unit;
}

/* A quarter more than wanted, and the margin that the maps need, in steps of a sixteenth to an eighth. */
static int64_t extent(int64_t wanted, int64_t unit, int64_t margin)
{
    int64_t needed = wanted + wanted / 4 + margin;
    int64_t step = unit;
    while (16 * step < needed)
        step *= 2;
    return whole(needed, step);
}

static snow_plane_box plane_box(const snow_source_of_walkers *source)
{
    enum { UNIT = 512, TILE = 32 };
    int64_t up = extent(source->reach, UNIT, SNOW_PLANE_MARGIN);
    if (source->width == 0)
        return (snow_plane_box){(int32_t)-up, (int32_t)-up, (uint32_t)(2 * up / TILE), (uint32_t)(2 * up / TILE)};
    int64_t left = source->lattice == SNOW_AGGREGATE_HEXAGONAL ? whole((up + 1) / 2, UNIT) : 0;
    int64_t right = whole(source->width + 1, UNIT);
    return (snow_plane_box){(int32_t)-left, 0, (uint32_t)((left + right) / TILE), (uint32_t)(up / TILE)};
}

static snow_space_box space_box(const snow_source_of_walkers *source)
{
    enum { UNIT = 64, TILE = 16 };
    int64_t up = extent(source->reach, UNIT, SNOW_SPACE_MARGIN);
    if (source->width == 0) {
        uint32_t tiles = (uint32_t)(2 * up / TILE);
        return (snow_space_box){(int32_t)-up, (int32_t)-up, (int32_t)-up, tiles, tiles, tiles};
    }
    return (snow_space_box){0, 0, 0, (uint32_t)(whole(source->width, UNIT) / TILE),
                            (uint32_t)(whole(source->depth, UNIT) / TILE), (uint32_t)(up / TILE)};
}

static snow_status widen(snow_growth *growth, snow_heap *heap, const snow_source_of_walkers *source)
{
    snow_ground *ground = &growth->ground;
    if (is_in_space(growth)) {
        snow_space_box box = space_box(source);
        return box.layers == ground->space.box.layers ? SNOW_OK : snow_space_map_widen(&ground->space, heap, box);
    }
    snow_plane_box box = plane_box(source);
    return box.rows == ground->plane.box.rows ? SNOW_OK : snow_plane_map_widen(&ground->plane, heap, box);
}

/* Source and map for a cluster that reaches so far. */
static snow_status fit(snow_growth *growth, snow_heap *heap, int64_t farthest)
{
    snow_source_of_walkers source = growth->ground.source;
    snow_source_fit(&source, farthest);
    snow_status status = SNOW_OK;
    if (source.rim != growth->ground.source.rim) {
        snow_ahead_pause(&growth->ahead);
        status = widen(growth, heap, &source);
        if (status == SNOW_OK)
            growth->ground.source = source;
        snow_squads_choose(&growth->ground, growth->rules.isa);
        snow_ahead_call_back(&growth->ahead);
        snow_ahead_resume(&growth->ahead);
    }
    if (status == SNOW_OK)
        growth->farthest = farthest;
    return status;
}

static snow_status reserve(snow_growth *growth, snow_heap *heap)
{
    snow_ground *ground = &growth->ground;
    bool space = is_in_space(growth);
    if (space ? snow_space_map_has_room(&ground->space) : snow_plane_map_has_room(&ground->plane))
        return SNOW_OK;
    snow_ahead_pause(&growth->ahead);
    snow_status status =
        space ? snow_space_map_reserve(&ground->space, heap) : snow_plane_map_reserve(&ground->plane, heap);
    snow_ahead_resume(&growth->ahead);
    return status;
}

/* What can fail comes before what shows: a walker that has to come again must find what it found. */
static snow_status add(snow_growth *growth, snow_heap *heap, snow_site site, bool obstacle)
{
    int64_t distance = distance_of(growth, site);
    snow_status status = reserve(growth, heap);
    if (status == SNOW_OK && distance > growth->farthest)
        status = fit(growth, heap, distance);
    if (status != SNOW_OK)
        return status;
    if (is_in_space(growth))
        snow_space_map_add(&growth->ground.space, site.x, site.y, site.z, obstacle);
    else
        snow_plane_map_add(&growth->ground.plane, site.x, site.y, obstacle);
    return SNOW_OK;
}

static snow_status add_floor(snow_growth *growth, snow_heap *heap)
{
    const snow_growth_rules *rules = &growth->rules;
    int32_t depth = is_in_space(growth) ? rules->depth : 1;
    /* Row -1 of the hexagonal vessel starts at X = 1: q = 1. */
    int32_t first = rules->lattice == SNOW_AGGREGATE_HEXAGONAL ? 1 : 0;
    snow_status status = SNOW_OK;
    for (int32_t y = 0; y < depth && status == SNOW_OK; y++) {
        for (int32_t x = first; x < first + rules->width && status == SNOW_OK; x++)
            status = add(growth, heap, is_in_space(growth) ? (snow_site){x, y, -1} : (snow_site){x, -1, 0}, false);
    }
    return status;
}

/* An empty map. */
static snow_status start_map(snow_growth *growth, snow_heap *heap)
{
    snow_ground *ground = &growth->ground;
    const snow_growth_rules *rules = &growth->rules;
    growth->farthest = rules->width > 0 ? -1 : 0;
    snow_source_fit(&ground->source, growth->farthest);
    snow_status status;
    if (is_in_space(growth))
        status = snow_space_map_start(&ground->space, heap, &ground->exits, ground->careful,
                                      space_box(&ground->source), rules->isa);
    else
        status = snow_plane_map_start(&ground->plane, heap, &ground->exits, ground->careful,
                                      plane_box(&ground->source));
    snow_squads_choose(ground, rules->isa);
    return status == SNOW_OK && rules->width > 0 ? add_floor(growth, heap) : status;
}

static void end_map(snow_growth *growth, snow_heap *heap)
{
    if (is_in_space(growth))
        snow_space_map_end(&growth->ground.space, heap);
    else
        snow_plane_map_end(&growth->ground.plane, heap);
}

snow_status snow_growth_start(snow_growth **result, snow_heap *heap, const snow_growth_rules *rules)
{
    snow_growth *growth = snow_heap_get(heap, 1, sizeof *growth);
    if (growth == NULL)
        return heap->refusal;
    growth->rules = *rules;
    growth->ground = (snow_ground){
        .contact = rules->contact,
        .stick = rules->stick,
        .refill = snow_draws_choose(rules->isa),
        .careful = rules->contact == SNOW_AGGREGATE_ENTRY || rules->stick < 1 || rules->has_obstacles,
        .source = {.lattice = rules->lattice, .width = rules->width, .depth = rules->depth, .lid = rules->lid},
    };
    snow_status status = snow_exits_start(&growth->ground.exits, heap, rules->lattice);
    if (status == SNOW_OK)
        status = start_map(growth, heap);
    if (status != SNOW_OK) {
        snow_growth_end(growth, heap);
        return status;
    }
    *result = growth;
    return SNOW_OK;
}

void snow_growth_end(snow_growth *growth, snow_heap *heap)
{
    if (growth == NULL)
        return;
    snow_ahead_end(&growth->ahead, heap);
    end_map(growth, heap);
    snow_exits_end(&growth->ground.exits, heap);
    snow_heap_put(heap, growth);
}

snow_status snow_growth_clear(snow_growth *growth, snow_heap *heap, uint64_t seed)
{
    end_map(growth, heap);
    growth->rules.seed = seed;
    return start_map(growth, heap);
}

snow_status snow_growth_fill(snow_growth *growth, snow_heap *heap, const snow_site *sites, size_t count)
{
    snow_status status = SNOW_OK;
    for (size_t i = 0; i < count && status == SNOW_OK; i++)
        status = add(growth, heap, sites[i], false);
    return status;
}

snow_status snow_growth_obstruct(snow_growth *growth, snow_heap *heap, const snow_site *sites, size_t count)
{
    snow_status status = SNOW_OK;
    for (size_t i = 0; i < count && status == SNOW_OK; i++)
        status = add(growth, heap, sites[i], true);
    return status;
}

/* The walkers of one call. */
typedef struct passage {
    snow_growth *growth;
    snow_heap *heap;
    const snow_growth_port *port;
    uint64_t left; /* to fill a site */
    snow_status status;
} passage;

/* Room is made before anyone hears of the walker: one that fails leaves no trace.
   True: another one may come. */
static bool land(void *context, uint64_t walker, snow_site site)
{
    passage *all = context;
    const snow_growth_port *port = all->port;
    snow_ground *ground = &all->growth->ground;
    *(is_in_space(all->growth) ? &ground->space.landing : &ground->plane.landing) = walker + 1;
    bool fills = port->fills == NULL || port->fills(port->context, site);
    if (fills)
        all->status = add(all->growth, all->heap, site, false);
    if (all->status != SNOW_OK)
        return false;
    all->left -= fills;
    if (!fills)
        snow_ahead_extend(&all->growth->ahead);
    return port->arrives(port->context, site, fills) && all->left > 0;
}

snow_status snow_growth_run(snow_growth *growth, snow_heap *heap, const snow_growth_crew *crew, uint64_t most,
                            uint64_t *walker, const snow_growth_port *port)
{
    passage all = {growth, heap, port, most, SNOW_OK};
    snow_ahead *ahead = &growth->ahead;
    ahead->ground = &growth->ground;
    snow_status status = snow_ahead_start(ahead, heap, crew->threads, is_in_space(growth));
    if (status != SNOW_OK || most == 0)
        return status;
    ahead->key = growth->rules.seed;
    ahead->land = land;
    ahead->context = &all;
    uint64_t next = snow_ahead_run(ahead, crew->loop, crew->context, *walker, most);
    *walker = all.status == SNOW_OK ? next : next - 1;
    return all.status;
}

/* Walkers that fill nothing. */
typedef struct sample {
    snow_growth_ends ends;
    void *context;
    uint64_t left;
} sample;

static bool end(void *context, uint64_t walker, snow_site site)
{
    (void)walker;
    sample *self = context;
    return self->ends(self->context, site) && --self->left > 0;
}

snow_status snow_growth_sample(const snow_growth *growth, snow_heap *heap, uint64_t key, uint64_t first, uint64_t count,
                               snow_growth_ends ends, void *context)
{
    sample self = {ends, context, count};
    snow_ahead ahead = {
        .ground = &growth->ground, .fills_nothing = true, .land = end, .context = &self, .key = key};
    snow_status status = snow_ahead_start(&ahead, heap, 1, is_in_space(growth));
    if (status == SNOW_OK && count > 0)
        snow_ahead_run(&ahead, NULL, NULL, first, count);
    snow_ahead_end(&ahead, heap);
    return status;
}

uint64_t snow_growth_probe_jumps(const snow_growth *growth, uint64_t key, uint64_t walker)
{
    snow_flight flight;
    snow_flight_start(&growth->ground, &flight, key, walker);
    snow_flight_finish(&growth->ground, &flight);
    return flight.asked;
}

uint64_t snow_growth_repeats(const snow_growth *growth)
{
    return growth->ahead.repeats;
}
