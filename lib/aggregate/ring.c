#include "aggregate/ring.h"

#include "aggregate/alias.h"
#include "aggregate/exits.h"

/* Larger regions cost much time to solve: their laws have no closed form. */
enum { PLANE_LEVELS = 11, HEXAGONAL_LEVELS = 7, SPACE_LEVELS = 6 };

static bool is_space(const snow_ring *self)
{
    return self->lattice == SNOW_AGGREGATE_CUBIC;
}

static int32_t magnitude(int32_t x)
{
    return x < 0 ? -x : x;
}

static double chance_at(snow_aggregate_lattice lattice, const double *chance, int32_t a, int32_t b)
{
    a = magnitude(a);
    b = magnitude(b);
    if (lattice != SNOW_AGGREGATE_CUBIC)
        return chance[a];
    return a > b ? chance[a * (a + 1) / 2 + b] : chance[b * (b + 1) / 2 + a];
}

/* All sites of a side, and their chances. */
static uint32_t list_side(snow_aggregate_lattice lattice, int32_t radius, const double *chance, double *weight,
                          snow_ring_exit *exit)
{
    int32_t first_a = lattice == SNOW_AGGREGATE_HEXAGONAL ? 0 : 1 - radius;
    int32_t last_b = lattice == SNOW_AGGREGATE_CUBIC ? radius - 1 : 0;
    uint32_t count = 0;
    for (int32_t a = first_a; a < radius; a++)
        for (int32_t b = -last_b; b <= last_b; b++) {
            weight[count] = chance_at(lattice, chance, a, b);
            exit[count].along[0][0] = (int16_t)a;
            exit[count++].along[0][1] = (int16_t)b;
        }
    return count;
}

static uint32_t sites_of_side(snow_aggregate_lattice lattice, int32_t radius)
{
    uint32_t row = 2 * (uint32_t)radius - 1;
    return lattice == SNOW_AGGREGATE_CUBIC ? row * row : row;
}

static snow_status make_law(snow_ring *self, snow_heap *heap, int level, double *chance, snow_alias *alias)
{
    int32_t radius = 1 << level;
    snow_ring_exit *exit = snow_heap_get(heap, sites_of_side(self->lattice, radius), sizeof *exit);
    self->exit[level] = exit;
    if (exit == NULL)
        return heap->refusal;
    snow_status status = snow_exits_law(self->lattice, radius, chance, heap);
    if (status != SNOW_OK)
        return status;
    uint32_t sites = list_side(self->lattice, radius, chance, alias->weight, exit);
    snow_alias_cut(alias, sites);
    self->columns[level] = sites;
    for (uint32_t i = 0; i < self->columns[level]; i++) {
        exit[i].threshold = alias->threshold[i];
        exit[i].along[1][0] = exit[alias->other[i]].along[0][0];
        exit[i].along[1][1] = exit[alias->other[i]].along[0][1];
    }
    return SNOW_OK;
}

static snow_status make_laws(snow_ring *self, snow_heap *heap)
{
    uint32_t most = sites_of_side(self->lattice, 1 << (self->levels - 1));
    snow_alias alias;
    snow_status status = snow_alias_start(&alias, heap, most);
    if (status != SNOW_OK)
        return status;
    double *chance = snow_heap_get(heap, most, sizeof *chance);
    status = chance != NULL ? SNOW_OK : heap->refusal;
    for (int level = 1; chance != NULL && level < self->levels && status == SNOW_OK; level++)
        status = make_law(self, heap, level, chance, &alias);
    snow_heap_put(heap, chance);
    snow_alias_end(&alias, heap);
    return status;
}

snow_status snow_ring_start(snow_ring *self, snow_heap *heap, snow_aggregate_lattice lattice, double radius)
{
    int most = lattice == SNOW_AGGREGATE_HEXAGONAL ? HEXAGONAL_LEVELS
               : lattice == SNOW_AGGREGATE_CUBIC   ? SPACE_LEVELS
                                                   : PLANE_LEVELS;
    *self = (snow_ring){.lattice = lattice, .levels = 1, .radius = radius};
    while (self->levels < most && (double)(1 << self->levels) < radius)
        self->levels++;
    return self->levels > 1 ? make_laws(self, heap) : SNOW_OK;
}

void snow_ring_end(snow_ring *self, snow_heap *heap)
{
    for (int level = 1; level < self->levels; level++) {
        snow_cells_end(&self->near[level], heap);
        snow_heap_put(heap, self->exit[level]);
    }
}

/* The cell of a level that holds a site; rounds down. */
static int32_t down(int32_t x, int level)
{
    return x >= 0 ? x >> level : -((-x - 1) >> level) - 1;
}

static snow_site cell_of(snow_site site, int level)
{
    return (snow_site){down(site.x, level), down(site.y, level), down(site.z, level)};
}

snow_status snow_ring_cover(snow_ring *self, snow_heap *heap, snow_site low, snow_site high)
{
    int32_t deep = is_space(self) ? 1 : 0;
    snow_status status = SNOW_OK;
    for (int level = 1; level < self->levels && status == SNOW_OK; level++)
        status = snow_cells_cover(&self->near[level], heap,
                                  aggregate_moved(cell_of(low, level), (snow_site){-1, -1, -deep}),
                                  aggregate_moved(cell_of(high, level), (snow_site){1, 1, deep}));
    return status;
}

void snow_ring_add(snow_ring *self, snow_site site)
{
    int round = is_space(self) ? 27 : 9;
    for (int level = 1; level < self->levels; level++)
        for (int i = 0; i < round; i++)
            snow_cells_mark(&self->near[level],
                            aggregate_moved(cell_of(site, level),
                                            (snow_site){i % 3 - 1, i / 3 % 3 - 1, is_space(self) ? i / 9 - 1 : 0}),
                            SNOW_CELL_NEAR);
}

static bool is_free(const snow_ring *self, snow_site site, int level)
{
    return snow_cells_get(&self->near[level], cell_of(site, level)) == 0;
}

/* Whether no site of a region, its edge included, lies beyond the ring. The corners of a square and a cube are the
   farthest; no site of a hexagon is farther from its middle than the radius, which is less than what is asked here. */
static bool is_inside(const snow_ring *self, snow_site site, int32_t radius)
{
    snow_point at = snow_aggregate_point_of(self->lattice, site);
    double x = fabs(at.x) + radius;
    double y = fabs(at.y) + radius;
    double z = is_space(self) ? fabs(at.z) + radius : 0;
    return x * x + y * y + z * z <= self->radius * self->radius;
}

/* From the middle of a region to one of its sides, and along it. */
static snow_site leave(const snow_ring *self, snow_stream *stream, snow_site site, int level)
{
    static const snow_site corner[6] = {{1, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {1, -1, 0}};
    int32_t radius = 1 << level;
    const snow_ring_exit *exit = &self->exit[level][snow_stream_below(stream, self->columns[level])];
    const int16_t *along = exit->along[snow_stream_u32(stream) >= exit->threshold];
    uint32_t side = snow_stream_below(stream, self->lattice == SNOW_AGGREGATE_SQUARE ? 4 : 6);
    if (self->lattice == SNOW_AGGREGATE_HEXAGONAL) {
        snow_site from = corner[side];
        snow_site next = corner[(side + 2) % 6]; /* the way from a corner to the next one */
        return (snow_site){site.x + radius * from.x + along[0] * next.x, site.y + radius * from.y + along[0] * next.y, 0};
    }
    int32_t across = side % 2 == 0 ? radius : -radius;
    switch (side / 2) {
    case 0: return (snow_site){site.x + across, site.y + along[0], site.z + along[1]};
    case 1: return (snow_site){site.x + along[0], site.y + across, site.z + along[1]};
    default: return (snow_site){site.x + along[0], site.y + along[1], site.z + across};
    }
}

bool snow_ring_leap(const snow_ring *self, snow_stream *stream, snow_site *site, int *level)
{
    int found = *level > 0 ? *level : 1;
    if (self->levels <= 1)
        return false;
    while (found > 0 && !(is_free(self, *site, found) && is_inside(self, *site, 1 << found)))
        found--;
    *level = found;
    if (found == 0)
        return false;
    while (found + 1 < self->levels && is_free(self, *site, found + 1) && is_inside(self, *site, 2 << found))
        found++;
    *level = found;
    *site = leave(self, stream, *site, found);
    return true;
}
