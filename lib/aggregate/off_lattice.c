/* Aggregation off the lattice: discs of diameter 1 in the plane. A walker
   leaps to a uniform point of a circle that is sure to be free, until it is as
   good as in contact (M. E. Muller's walk on spheres, Ann. Math. Stat. 27 (1956)
   569), and comes back from outside by the exact law of the circle. */
#include "aggregate/cells.h"
#include "aggregate/circle.h"
#include "aggregate/model.h"

enum { LEVELS = 24, FINEST_SIDE = 2 };

/* Walkers as near to contact as this are in contact. */
static const double slack = 0x1p-16;

/* Farther out than this no disc is placed. */
static const double reach = 0x1p22;

typedef struct disc {
    double x;
    double y;
    uint32_t parent; /* 1 + the disc that it touched; 0: none */
    uint32_t next;   /* 1 + another disc in its cell */
} disc;

typedef struct off_lattice {
    disc *disc;
    uint64_t count;
    uint64_t capacity;
    snow_table cells;         /* 1 + the latest disc in a cell of the finest level */
    snow_cells level[LEVELS]; /* cells of sides 2, 4, 8 ...: marked where one of the nine round it has a disc */
    int levels;
} off_lattice;

static off_lattice *off_lattice_of(const snow_grid *grid)
{
    return aggregate_of(grid)->state;
}

static snow_site cell_of(double x, double y, int level)
{
    double side = (double)(FINEST_SIDE << level);
    return (snow_site){(int32_t)floor(x / side), (int32_t)floor(y / side), 0};
}

static snow_status create(snow_grid *grid)
{
    aggregate_of(grid)->state = snow_heap_get(&grid->heap, 1, sizeof(off_lattice));
    return aggregate_of(grid)->state != NULL ? SNOW_OK : grid->heap.refusal;
}

static snow_status widen(snow_grid *grid)
{
    off_lattice *self = off_lattice_of(grid);
    if (self->count < self->capacity)
        return SNOW_OK;
    uint64_t capacity = self->capacity == 0 ? 1024 : self->capacity + self->capacity / 2;
    if (capacity > SIZE_MAX / sizeof *self->disc)
        return SNOW_ERROR_TOO_LARGE;
    disc *larger = snow_heap_get_raw(&grid->heap, (size_t)capacity, sizeof *larger);
    if (larger == NULL)
        return grid->heap.refusal;
    for (uint64_t i = 0; i < self->count; i++)
        larger[i] = self->disc[i];
    snow_heap_put(&grid->heap, self->disc);
    self->disc = larger;
    self->capacity = capacity;
    return SNOW_OK;
}

/* Room for a disc within this distance of the origin. Levels are added until the coarsest is a handful of cells. */
static snow_status make_room(snow_grid *grid, double farthest)
{
    off_lattice *self = off_lattice_of(grid);
    snow_status status = widen(grid);
    if (status == SNOW_OK)
        status = snow_table_reserve(&self->cells, &grid->heap, 1);
    int levels = 1;
    while (levels < LEVELS && (double)(FINEST_SIDE << levels) < farthest)
        levels++;
    for (int i = 0; i < levels && status == SNOW_OK; i++) {
        snow_site low = cell_of(-farthest, -farthest, i);
        snow_site high = cell_of(farthest, farthest, i);
        status = snow_cells_cover(&self->level[i], &grid->heap, (snow_site){low.x - 1, low.y - 1, 0},
                                  (snow_site){high.x + 1, high.y + 1, 0});
    }
    if (status != SNOW_OK)
        return status;
    for (; self->levels < levels; self->levels++)
        for (uint64_t i = 0; i < self->count; i++)
            snow_cells_mark_round(&self->level[self->levels], cell_of(self->disc[i].x, self->disc[i].y, self->levels));
    return SNOW_OK;
}

static uint64_t key_of(snow_site cell)
{
    return snow_site_pack(false, cell);
}

/* There is room. */
static void add(snow_grid *grid, double x, double y, uint32_t parent)
{
    off_lattice *self = off_lattice_of(grid);
    snow_census *census = &grid->census;
    uint32_t *head = snow_table_at(&self->cells, key_of(cell_of(x, y, 0)));
    self->disc[self->count] = (disc){x, y, parent, *head};
    *head = (uint32_t)++self->count;
    for (int i = 0; i < self->levels; i++)
        snow_cells_mark_round(&self->level[i], cell_of(x, y, i));
    double square = x * x + y * y;
    census->tip_square = square > census->tip_square ? square : census->tip_square;
    census->frozen = self->count;
    census->full = census->tip_square >= reach * reach || self->count >= AGGREGATE_MOST_PARTICLES;
    snow_hexagon_hold(&census->hexagon, (int64_t)floor(x), (int64_t)floor(y));
}

/* A seed. Its site joins the model's list as well, which holds the seeds. */
static snow_status place(snow_grid *grid, snow_site site)
{
    double farthest = sqrt((double)aggregate_square(aggregate_of(grid), site));
    farthest = fmax(farthest, snow_census_tip(&grid->census));
    snow_status status = make_room(grid, farthest);
    if (status == SNOW_OK)
        add(grid, site.x, site.y, 0);
    return status;
}

typedef struct nearest_disc {
    double distance; /* of the centres; 2: none is nearer */
    uint32_t number;
} nearest_disc;

static nearest_disc find_nearest(const off_lattice *self, double x, double y)
{
    snow_site middle = cell_of(x, y, 0);
    double least = 4;
    uint32_t number = 0;
    for (int i = 0; i < 9; i++) {
        snow_site cell = {middle.x + i % 3 - 1, middle.y + i / 3 - 1, 0};
        for (uint32_t k = snow_table_get(&self->cells, key_of(cell)); k != 0; k = self->disc[k - 1].next) {
            double dx = self->disc[k - 1].x - x;
            double dy = self->disc[k - 1].y - y;
            double square = dx * dx + dy * dy;
            number = square < least ? k - 1 : number;
            least = square < least ? square : least;
        }
    }
    return (nearest_disc){sqrt(least), number};
}

static bool is_near(const off_lattice *self, double x, double y, int level)
{
    return snow_cells_get(&self->level[level], cell_of(x, y, level)) != 0;
}

/* The coarsest level at which nothing is near, −1: none; looked for from the latest one. */
static int free_level(const off_lattice *self, double x, double y, int level)
{
    level = level < 0 ? 0 : level;
    if (is_near(self, x, y, level)) {
        do
            level--;
        while (level >= 0 && is_near(self, x, y, level));
        return level;
    }
    while (level + 1 < self->levels && !is_near(self, x, y, level + 1))
        level++;
    return level;
}

typedef struct wanderer {
    double x;
    double y;
    uint32_t parent;
} wanderer;

static void leap(wanderer *at, snow_stream *stream, double distance)
{
    snow_direction direction = snow_stream_direction(stream);
    at->x += distance * direction.x;
    at->y += distance * direction.y;
}

/* A walker that does not stick tries to step off by one diameter. A step that would overlap does not take
   place, and costs its time: another trial follows. True when it sticks. */
static bool stay_or_leave(const off_lattice *self, snow_stream *stream, double sticking, wanderer *at)
{
    for (;;) {
        if (snow_stream_chance(stream, sticking))
            return true;
        wanderer next = *at;
        leap(&next, stream, 1);
        if (find_nearest(self, next.x, next.y).distance >= 1) {
            *at = next;
            return false;
        }
    }
}

/* Moved onto the exact distance of contact. */
static void touch(const off_lattice *self, wanderer *at, nearest_disc found)
{
    const disc *held = &self->disc[found.number];
    at->x = held->x + (at->x - held->x) / found.distance;
    at->y = held->y + (at->y - held->y) / found.distance;
    at->parent = found.number + 1;
}

static wanderer wander(const snow_grid *grid, snow_stream *stream)
{
    const off_lattice *self = off_lattice_of(grid);
    double radius = snow_census_tip(&grid->census) + 1;
    snow_direction start = snow_stream_direction(stream);
    wanderer at = {radius * start.x, radius * start.y, 0};
    int level = 0;
    for (;;) {
        if (at.x * at.x + at.y * at.y > radius * radius * (1 + 0x1p-40)) {
            snow_direction back = snow_circle_hit(stream, at.x, at.y, radius);
            at.x = radius * back.x;
            at.y = radius * back.y;
        }
        level = free_level(self, at.x, at.y, level);
        if (level >= 0) {
            leap(&at, stream, (double)(FINEST_SIDE << level) - 1);
            continue;
        }
        nearest_disc found = find_nearest(self, at.x, at.y);
        if (found.distance > 1 + slack) {
            leap(&at, stream, found.distance - 1);
            continue;
        }
        touch(self, &at, found);
        if (stay_or_leave(self, stream, aggregate_of(grid)->params.sticking, &at))
            return at;
    }
}

static snow_status grow(snow_grid *grid, int64_t most, const snow_stop *stop)
{
    aggregate *model = aggregate_of(grid);
    for (int64_t taken = 0; taken < most; taken++) {
        snow_status status = make_room(grid, snow_census_tip(&grid->census) + 2);
        if (status != SNOW_OK)
            return status;
        snow_stream stream = snow_stream_start(model->params.random_seed, SNOW_RANDOM_WALK, model->walkers++);
        wanderer end = wander(grid, &stream);
        add(grid, end.x, end.y, end.parent);
        grid->census.steps++;
        if (snow_aggregate_stops(grid, stop))
            break;
    }
    return SNOW_OK;
}

static uint64_t count(const snow_grid *grid)
{
    return off_lattice_of(grid)->count;
}

static void points(const snow_grid *grid, uint64_t first, snow_point *result, size_t wanted)
{
    const off_lattice *self = off_lattice_of(grid);
    for (size_t i = 0; i < wanted; i++)
        result[i] = (snow_point){self->disc[first + i].x, self->disc[first + i].y, 0};
}

static int64_t parent(const snow_grid *grid, uint64_t number)
{
    return (int64_t)off_lattice_of(grid)->disc[number].parent - 1;
}

static void save(const snow_grid *grid, snow_sink *sink)
{
    const off_lattice *self = off_lattice_of(grid);
    uint64_t seeds = aggregate_of(grid)->seeds;
    snow_sink_u64(sink, self->count - seeds);
    for (uint64_t i = seeds; i < self->count; i++) {
        snow_sink_double(sink, self->disc[i].x);
        snow_sink_double(sink, self->disc[i].y);
        snow_sink_u32(sink, self->disc[i].parent);
    }
}

static snow_status load(snow_grid *grid, snow_source *source)
{
    const off_lattice *self = off_lattice_of(grid);
    uint64_t more = snow_source_u64(source);
    if (more > snow_source_left(source))
        return SNOW_ERROR_TRUNCATED;
    for (; more > 0; more--) {
        double x = snow_source_double(source);
        double y = snow_source_double(source);
        uint32_t held_by = snow_source_u32(source);
        if (source->truncated)
            return SNOW_ERROR_TRUNCATED;
        if (!isfinite(x) || !isfinite(y) || fabs(x) > 2 * reach || fabs(y) > 2 * reach || held_by > self->count)
            return SNOW_ERROR_DAMAGED;
        /* A disc lies within one diameter of the others, or a few numbers would ask for much memory. */
        double farthest = fmax(snow_census_tip(&grid->census) + 2, 2);
        if (x * x + y * y > farthest * farthest)
            return SNOW_ERROR_DAMAGED;
        snow_status status = make_room(grid, farthest);
        if (status != SNOW_OK)
            return status;
        add(grid, x, y, held_by);
    }
    return SNOW_OK;
}

static void destroy(snow_grid *grid)
{
    off_lattice *self = off_lattice_of(grid);
    for (int i = 0; i < LEVELS; i++)
        snow_cells_end(&self->level[i], &grid->heap);
    snow_table_end(&self->cells, &grid->heap);
    snow_heap_put(&grid->heap, self->disc);
    snow_heap_put(&grid->heap, self);
}

const aggregate_scene snow_aggregate_off_lattice = {
    .create = create,
    .place = place,
    .grow = grow,
    .count = count,
    .points = points,
    .parent = parent,
    .save = save,
    .load = load,
    .destroy = destroy,
};
