/* Each scene's own rules: walks of the library against a tiny program of the same rules that is written here and
   shares nothing with it. */
#include "support/aggregates.h"
#include "support/chance.h"
#include "support/grids.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A small world of cells with a margin, a random number generator of its own (xorshift), and matter. */
enum { SIDE = 200, MARGIN = 16 };

typedef struct world {
    bool filled[SIDE][SIDE];
    int32_t low_x, low_y, high_x, high_y; /* where walkers may end */
    uint64_t random;
    double sticking;
} world;

static double uniform(world *self)
{
    self->random ^= self->random << 13;
    self->random ^= self->random >> 7;
    self->random ^= self->random << 17;
    return (double)(self->random >> 11) * 0x1p-53;
}

static int32_t below(world *self, int32_t limit)
{
    return (int32_t)(uniform(self) * limit);
}

static bool *cell(world *self, int32_t x, int32_t y)
{
    static bool nothing;
    nothing = false;
    bool there = x >= -MARGIN && y >= -MARGIN && x < SIDE - MARGIN && y < SIDE - MARGIN;
    return there ? &self->filled[y + MARGIN][x + MARGIN] : &nothing;
}

static bool touches_four(world *self, int32_t x, int32_t y)
{
    return *cell(self, x + 1, y) || *cell(self, x - 1, y) || *cell(self, x, y + 1) || *cell(self, x, y - 1);
}

static bool touches_eight(world *self, int32_t x, int32_t y)
{
    return touches_four(self, x, y) || *cell(self, x + 1, y + 1) || *cell(self, x - 1, y + 1) ||
           *cell(self, x + 1, y - 1) || *cell(self, x - 1, y - 1);
}

static void fill(world *self, const snow_site *sites, size_t count)
{
    for (size_t i = 0; i < count; i++)
        *cell(self, sites[i].x, sites[i].y) = true;
}

typedef bool (*rules)(world *self, int32_t *x, int32_t *y); /* one walk; false: it was lost */

/* Equally many walks of both kinds. */
static void compare(const snow_aggregate_params *params, world *self, rules walk, uint64_t walks)
{
    size_t width = (size_t)(self->high_x - self->low_x + 1);
    size_t cells = width * (size_t)(self->high_y - self->low_y + 1);
    snow_aggregate_chance *list = calloc(cells, sizeof *list);
    double *got = calloc(cells, sizeof *got);
    double *modelled = calloc(cells, sizeof *modelled);
    assert_true(list != NULL && got != NULL && modelled != NULL);
    for (size_t i = 0; i < cells; i++)
        list[i].site = (snow_site){self->low_x + (int32_t)(i % width), self->low_y + (int32_t)(i / width), 0};
    snow_grid *grid = make_aggregate(params, NULL);
    count_hits(grid, walks, 17, list, cells, got);
    snow_destroy(grid);
    self->random = 88172645463325252;
    self->sticking = params->sticking;
    for (uint64_t i = 0; i < walks;) {
        int32_t x;
        int32_t y;
        if (!walk(self, &x, &y))
            continue;
        assert_true(x >= self->low_x && x <= self->high_x && y >= self->low_y && y <= self->high_y);
        modelled[(size_t)(y - self->low_y) * width + (size_t)(x - self->low_x)]++;
        i++;
    }
    assert_alike(modelled, got, cells);
    free(modelled);
    free(got);
    free(list);
}

/* Electrolysis. */

typedef struct bath {
    world world; /* first: the rules get a pointer to it */
    int32_t width, height, first, last;
    double interaction;
    bool periodic;
    int32_t rise;
} bath;

/* Of the nearest matter within reach any: whether there is some, and the step to it. */
static bool find_nearest(bath *self, int32_t x, int32_t y, int32_t *to_x, int32_t *to_y)
{
    double reach = fmax(self->interaction * self->interaction, 2);
    int32_t nearest = 1 << 20;
    int32_t ties = 0;
    for (int32_t dy = -12; dy <= 12; dy++) {
        for (int32_t dx = -12; dx <= 12; dx++) {
            int32_t at = x + dx;
            if (self->periodic)
                at = ((at % self->width) + self->width) % self->width;
            else if (at < 0 || at >= self->width)
                continue;
            int32_t square = dx * dx + dy * dy;
            if (square > reach || square > nearest || !*cell(&self->world, at, y + dy))
                continue;
            ties = square < nearest ? 1 : ties + 1;
            nearest = square;
            if (below(&self->world, ties) == 0) {
                *to_x = dx;
                *to_y = dy;
            }
        }
    }
    return ties > 0;
}

static int32_t kept(const bath *self, int32_t x)
{
    if (self->periodic)
        return (x + self->width) % self->width;
    return x < 0 ? 0 : x >= self->width ? self->width - 1 : x; /* the sideways part of the step is refused */
}

static int32_t sign(int32_t x)
{
    return (x > 0) - (x < 0);
}

static bool fall(world *around, int32_t *x, int32_t *y)
{
    bath *self = (bath *)(void *)around;
    *y = self->rise < 0 ? self->height - 1 : 0;
    do
        *x = self->first + below(around, self->last - self->first + 1);
    while (*cell(around, *x, *y));
    for (;;) {
        int32_t to_x = 0;
        int32_t to_y = 0;
        if (find_nearest(self, *x, *y, &to_x, &to_y) && uniform(around) < around->sticking) {
            *x = kept(self, *x + to_x - sign(to_x));
            *y += to_y - sign(to_y);
            return true;
        }
        int32_t next = kept(self, *x + below(around, 3) - 1);
        if (*cell(around, next, *y + self->rise))
            continue;
        *x = next;
        *y += self->rise;
        if (*y < 0 || *y >= self->height)
            return false;
    }
}

static const snow_site heap_of_ions[] = {{4, 0, 0}, {4, 1, 0}, {5, 2, 0}, {5, 3, 0}, {9, 0, 0}};

static void check_electrolysis(double interaction, bool periodic, double sticking, int32_t cathode_last)
{
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_ELECTROLYSIS);
    params.width = 14;
    params.height = 16;
    params.launch_first = 2;
    params.launch_last = 11;
    params.cathode_first = 3;
    params.cathode_last = cathode_last;
    params.interaction = interaction;
    params.periodic = periodic;
    params.sticking = sticking;
    params.seeds = heap_of_ions;
    params.seed_count = COUNT_OF(heap_of_ions);
    bath self = {.width = 14, .height = 16, .first = 2, .last = 11, .interaction = interaction,
                 .periodic = periodic, .rise = -1};
    self.world.high_x = 13;
    self.world.high_y = 15;
    fill(&self.world, heap_of_ions, COUNT_OF(heap_of_ions));
    for (int32_t x = 3; x <= cathode_last && x < 14; x++)
        *cell(&self.world, x, -1) = true;
    compare(&params, &self.world, fall, 10000);
}

static void ions_fall_as_the_rules_say(void **state)
{
    (void)state;
    check_electrolysis(0, false, 1, 10);
    check_electrolysis(3, false, 1, 10);
    check_electrolysis(2.5, true, 1, INT32_MAX);
    check_electrolysis(0, true, 0.3, 10);
    check_electrolysis(4, false, 0.3, 2); /* no cathode but the seeds */
}

/* High above the deposit the library takes many steps at once. */
static void ions_fall_far_as_the_rules_say(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_ELECTROLYSIS);
    params.width = 14;
    params.height = 150;
    params.launch_first = 0;
    params.launch_last = 3;
    params.seeds = heap_of_ions;
    params.seed_count = COUNT_OF(heap_of_ions);
    bath self = {.width = 14, .height = 150, .first = 0, .last = 3, .rise = -1};
    self.world.high_x = 13;
    self.world.high_y = 15;
    fill(&self.world, heap_of_ions, COUNT_OF(heap_of_ions));
    for (int32_t x = 0; x < 14; x++)
        *cell(&self.world, x, -1) = true;
    compare(&params, &self.world, fall, 4000);
}

/* Beside a tower they fall past it in leaps, some of them along the wall, and none through the tower. */
static void ions_fall_past_a_tower_as_the_rules_say(void **state)
{
    (void)state;
    enum { WIDTH = 160, HEIGHT = 120, TOWER = 10 };
    snow_site tower[TOWER];
    for (int32_t i = 0; i < TOWER; i++)
        tower[i] = (snow_site){2, HEIGHT - 15 + i, 0};
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_ELECTROLYSIS);
    params.width = WIDTH;
    params.height = HEIGHT;
    params.launch_first = 90;
    params.seeds = tower;
    params.seed_count = TOWER;
    static bath self;
    self = (bath){.width = WIDTH, .height = HEIGHT, .first = 90, .last = WIDTH - 1, .rise = -1};
    self.world.high_x = WIDTH - 1;
    self.world.high_y = HEIGHT - 1;
    fill(&self.world, tower, TOWER);
    for (int32_t x = 0; x < WIDTH; x++)
        *cell(&self.world, x, -1) = true;
    compare(&params, &self.world, fall, 10000);
}

/* The chimney. */

static void check_chimney(int32_t left, int32_t left_top, int32_t right, int32_t right_top, double sticking)
{
    enum { HEIGHT = 13, WIDTH = 20 };
    static const snow_site soot[] = {{9, 5, 0}, {10, 6, 0}, {9, 6, 0}};
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_CHIMNEY);
    params.width = WIDTH;
    params.height = HEIGHT;
    params.wall_left = left;
    params.wall_left_top = left_top;
    params.wall_right = right;
    params.wall_right_top = right_top;
    params.sticking = sticking;
    params.seeds = soot;
    params.seed_count = COUNT_OF(soot);
    bath self = {.width = WIDTH, .height = HEIGHT, .first = left + 1, .last = right - 1, .rise = 1};
    self.world.high_x = WIDTH - 1;
    self.world.high_y = HEIGHT - 1;
    fill(&self.world, soot, COUNT_OF(soot));
    for (int32_t y = 0; y < HEIGHT; y++) { /* solid behind the walls */
        int32_t to = (int32_t)lround(left + (double)(left_top - left) * y / (HEIGHT - 1));
        int32_t from = (int32_t)lround(right + (double)(right_top - right) * y / (HEIGHT - 1));
        for (int32_t x = 0; x < WIDTH; x++)
            if (x <= to || x >= from)
                *cell(&self.world, x, y) = true;
    }
    compare(&params, &self.world, fall, 10000);
}

static void soot_rises_as_the_rules_say(void **state)
{
    (void)state;
    check_chimney(0, 0, 19, 19, 0.5);
    check_chimney(1, 5, 18, 14, 0.2);
    check_chimney(4, 0, 15, 19, 0.3);
    check_chimney(2, 2, 17, 17, 1);
}

/* The snowflake. */

static bool drift(world *self, int32_t *x, int32_t *y)
{
    int32_t wide = self->high_x - self->low_x;
    int32_t high = self->high_y - self->low_y;
    do { /* uniform on the perimeter */
        *x = self->low_x + below(self, wide + 1);
        *y = self->low_y + below(self, high + 1);
    } while (*x != self->low_x && *x != self->high_x && *y != self->low_y && *y != self->high_y);
    for (;;) {
        int32_t step = below(self, 8);
        step += step >= 4;
        int32_t dx = step % 3 - 1;
        int32_t dy = step / 3 - 1;
        dx = *x + dx < self->low_x || *x + dx > self->high_x ? -dx : dx;
        dy = *y + dy < self->low_y || *y + dy > self->high_y ? -dy : dy;
        if (!*cell(self, *x + dx, *y + dy)) {
            *x += dx;
            *y += dy;
        }
        if (touches_eight(self, *x, *y) && uniform(self) < self->sticking)
            return true;
    }
}

static void flakes_drift_as_the_rules_say(void **state)
{
    (void)state;
    static const snow_site flake[] = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 1, 0}, {4, 1, 0}, {0, -1, 0}, {-1, -2, 0},
                                      {5, 2, 0}, {6, 2, 0}, {2, 2, 0}, {2, 3, 0}, {3, 4, 0}};
    static const double sticking[] = {1, 0.25};
    for (size_t i = 0; i < COUNT_OF(sticking); i++) {
        snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_SNOWFLAKE);
        params.seeds = flake;
        params.seed_count = COUNT_OF(flake);
        params.sticking = sticking[i];
        world self = {.low_x = -2, .low_y = -3, .high_x = 7, .high_y = 5}; /* one cell round the flake */
        fill(&self, flake, COUNT_OF(flake));
        compare(&params, &self, drift, 20000);
    }
}

/* The laboratory sheet: launched at R0 = 9, dropped beyond 27. */

static bool wander(world *self, int32_t *x, int32_t *y)
{
    static const int32_t steps[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    double angle = 6.283185307179586 * uniform(self);
    *x = (int32_t)lround(9 * cos(angle));
    *y = (int32_t)lround(9 * sin(angle));
    for (;;) {
        if (touches_four(self, *x, *y) && uniform(self) < self->sticking)
            return true;
        const int32_t *step = steps[below(self, 4)];
        if (!*cell(self, *x + step[0], *y + step[1])) {
            *x += step[0];
            *y += step[1];
        }
        if (*x * *x + *y * *y > 27 * 27)
            return false;
    }
}

static void the_sheets_walkers_wander_as_the_rules_say(void **state)
{
    (void)state;
    static const snow_site cluster[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}, {-1, 0, 0}, {-1, -1, 0}, {0, 2, 0},
                                        {0, 1, 0}, {3, 1, 0}, {-2, -1, 0}};
    static const double sticking[] = {1, 0.25};
    for (size_t i = 0; i < COUNT_OF(sticking); i++) {
        snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_LABORATORY);
        params.launch_radius = 9;
        params.end_radius = 8;
        params.seeds = cluster;
        params.seed_count = COUNT_OF(cluster);
        params.sticking = sticking[i];
        world self = {.low_x = -12, .low_y = -12, .high_x = 12, .high_y = 12};
        fill(&self, cluster, COUNT_OF(cluster));
        compare(&params, &self, wander, 10000);
        params.engine = SNOW_AGGREGATE_ENGINE_STEPS;
        compare(&params, &self, wander, 10000);
    }
}

/* Leaps and single steps, on each lattice and by both rules of contact, near the ring and off the middle. */
static void both_engines_agree_in_the_ring(void **state)
{
    (void)state;
    enum { MOST = 4096, REACH = 7 };
    static const snow_site cluster[] = {{3, 0, 0}, {4, 0, 0}, {4, 1, 0}, {4, -1, 0}, {2, 0, 0}, {0, -3, 0}};
    static const snow_site obstacles[] = {{0, 2, 0}, {1, 2, 0}, {-1, 2, 0}};
    static const snow_aggregate_lattice lattices[] = {SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_HEXAGONAL,
                                                      SNOW_AGGREGATE_CUBIC};
    for (int variant = 0; variant < 6; variant++) {
        snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_LABORATORY);
        params.lattice = lattices[variant / 2];
        params.contact = variant & 1 ? SNOW_AGGREGATE_ENTRY : SNOW_AGGREGATE_ARRIVAL;
        params.sticking = variant & 1 ? 0.5 : 1;
        params.launch_radius = 9;
        params.end_radius = 8;
        params.seeds = cluster;
        params.seed_count = COUNT_OF(cluster);
        params.obstacles = obstacles;
        params.obstacle_count = COUNT_OF(obstacles);
        static snow_aggregate_chance list[MOST];
        static double hits[2][MOST];
        size_t count = 0;
        int32_t deep = params.lattice == SNOW_AGGREGATE_CUBIC ? REACH : 0;
        for (int32_t z = -deep; z <= deep; z++)
            for (int32_t y = -REACH; y <= REACH; y++)
                for (int32_t x = -REACH; x <= REACH; x++)
                    list[count++].site = (snow_site){x, y, z};
        for (int steps = 0; steps < 2; steps++) {
            params.engine = steps ? SNOW_AGGREGATE_ENGINE_STEPS : SNOW_AGGREGATE_ENGINE_JUMPS;
            snow_grid *grid = make_aggregate(&params, NULL);
            count_hits(grid, 10000, 31 + (uint64_t)steps, list, count, hits[steps]);
            snow_destroy(grid);
        }
        assert_alike(hits[0], hits[1], count);
    }
}

/* The vessel: sides and lid refuse, obstacles too, the floor takes. */

enum { VESSEL_WIDTH = 11, VESSEL_HEIGHT = 9 };

typedef struct vessel {
    world world; /* first: the rules get a pointer to it */
    const snow_site *obstacles;
    size_t obstacle_count;
    bool entry;
    bool periodic;
} vessel;

static bool can_be_entered(const vessel *self, int32_t x, int32_t y)
{
    for (size_t i = 0; i < self->obstacle_count; i++)
        if (self->obstacles[i].x == x && self->obstacles[i].y == y)
            return false;
    return x >= 0 && x < VESSEL_WIDTH && y < VESSEL_HEIGHT;
}

static bool sink(world *around, int32_t *x, int32_t *y)
{
    static const int32_t steps[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const vessel *self = (const vessel *)(const void *)around;
    *x = below(around, VESSEL_WIDTH);
    *y = VESSEL_HEIGHT - 1;
    for (;;) {
        bool touches = false;
        for (int i = 0; i < 4; i++) {
            int32_t beside = *x + steps[i][0];
            beside = self->periodic ? (beside + VESSEL_WIDTH) % VESSEL_WIDTH : beside;
            touches |= *cell(around, beside, *y + steps[i][1]);
        }
        if (!self->entry && touches && uniform(around) < around->sticking)
            return true;
        const int32_t *step = steps[below(around, 4)];
        int32_t next_x = *x + step[0];
        int32_t next_y = *y + step[1];
        if (self->periodic)
            next_x = (next_x + VESSEL_WIDTH) % VESSEL_WIDTH;
        if (*cell(around, next_x, next_y)) {
            if (self->entry && uniform(around) < around->sticking)
                return true;
        } else if (can_be_entered(self, next_x, next_y)) {
            *x = next_x;
            *y = next_y;
        }
    }
}

static void check_vessel(snow_aggregate_params params, const snow_site *obstacles, size_t obstacle_count)
{
    static const snow_site trees[] = {{2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {3, 2, 0}, {8, 0, 0}, {8, 1, 0}, {10, 0, 0}};
    params.width = VESSEL_WIDTH;
    params.height = VESSEL_HEIGHT;
    params.seeds = trees;
    params.seed_count = COUNT_OF(trees);
    params.obstacles = obstacles;
    params.obstacle_count = obstacle_count;
    static vessel self;
    self = (vessel){.obstacles = obstacles,
                    .obstacle_count = obstacle_count,
                    .entry = params.contact == SNOW_AGGREGATE_ENTRY,
                    .periodic = params.periodic};
    self.world.high_x = VESSEL_WIDTH - 1;
    self.world.high_y = VESSEL_HEIGHT - 1;
    fill(&self.world, trees, COUNT_OF(trees));
    for (int32_t x = 0; x < VESSEL_WIDTH; x++)
        *cell(&self.world, x, -1) = true;
    compare(&params, &self.world, sink, 20000);
}

static snow_aggregate_params vessel_variant(int variant)
{
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_LINE);
    params.contact = variant & 1 ? SNOW_AGGREGATE_ENTRY : SNOW_AGGREGATE_ARRIVAL;
    params.engine = variant & 2 ? SNOW_AGGREGATE_ENGINE_JUMPS : SNOW_AGGREGATE_ENGINE_STEPS;
    params.sticking = variant & 4 ? 0.3 : 1;
    return params;
}

static void walkers_sink_in_the_vessel_as_the_rules_say(void **state)
{
    (void)state;
    for (int variant = 0; variant < 8; variant++)
        check_vessel(vessel_variant(variant), NULL, 0);
}

static void walkers_sink_round_the_vessel_as_the_rules_say(void **state)
{
    (void)state;
    for (int variant = 0; variant < 2; variant++) {
        snow_aggregate_params params = vessel_variant(variant);
        params.periodic = 1;
        check_vessel(params, NULL, 0);
    }
}

/* A roof with a hole, and a pillar. */
static void walkers_sink_past_obstacles_as_the_rules_say(void **state)
{
    (void)state;
    static const snow_site obstacles[] = {{0, 5, 0}, {1, 5, 0}, {2, 5, 0}, {3, 5, 0}, {4, 5, 0}, {6, 5, 0},
                                          {7, 5, 0}, {8, 5, 0}, {9, 5, 0}, {6, 1, 0}, {6, 2, 0}};
    for (int variant = 0; variant < 8; variant++)
        check_vessel(vessel_variant(variant), obstacles, COUNT_OF(obstacles));
}

/* Half a ring of obstacles: jumps and single steps are each other's model, on each lattice and by both rules of contact. */
static void both_engines_agree_about_obstacles(void **state)
{
    (void)state;
    enum { MOST = 4096, REACH = 6 };
    static const snow_site cluster[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
    for (int variant = 0; variant < 6; variant++) {
        snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
        params.lattice = (snow_aggregate_lattice)(variant / 2 + 1);
        params.contact = variant & 1 ? SNOW_AGGREGATE_ENTRY : SNOW_AGGREGATE_ARRIVAL;
        params.sticking = variant & 1 ? 0.5 : 1;
        bool space = params.lattice == SNOW_AGGREGATE_CUBIC;
        int32_t deep = space ? REACH : 0;
        static snow_aggregate_chance list[MOST];
        static double hits[2][MOST];
        static snow_site ring[MOST];
        size_t count = 0;
        size_t barred = 0;
        for (int32_t z = -deep; z <= deep; z++) {
            for (int32_t y = -REACH; y <= REACH; y++) {
                for (int32_t x = -REACH; x <= REACH; x++) {
                    int32_t square = x * x + y * y + z * z;
                    list[count++].site = (snow_site){x, y, z};
                    if (square >= 16 && square < 25 && x + y >= -1)
                        ring[barred++] = (snow_site){x, y, z};
                }
            }
        }
        params.seeds = cluster;
        params.seed_count = COUNT_OF(cluster);
        params.obstacles = ring;
        params.obstacle_count = barred;
        for (int steps = 0; steps < 2; steps++) {
            params.engine = steps ? SNOW_AGGREGATE_ENGINE_STEPS : SNOW_AGGREGATE_ENGINE_JUMPS;
            snow_grid *grid = make_aggregate(&params, NULL);
            count_hits(grid, space ? 400 : 4000, 41 + (uint64_t)steps, list, count, hits[steps]);
            snow_destroy(grid);
        }
        assert_alike(hits[0], hits[1], count);
    }
}

/* Noise reduction: round a single site the four chances are the same, and the m-th hit of any one ends the wait. With
   m = 2 that is the 2nd, 3rd, 4th, 5th walker with chances 1/4, 3/8, 9/32, 3/32. */
static void the_second_hit_fills_a_site(void **state)
{
    (void)state;
    enum { GRIDS = 600, MOST_WALKERS = 5 };
    static const double chance[MOST_WALKERS + 1] = {0, 0, 1.0 / 4, 3.0 / 8, 9.0 / 32, 3.0 / 32};
    for (int engine = SNOW_AGGREGATE_ENGINE_JUMPS; engine <= SNOW_AGGREGATE_ENGINE_STEPS; engine++) {
        double expected[MOST_WALKERS + 1];
        double got[MOST_WALKERS + 1] = {0};
        for (int i = 0; i <= MOST_WALKERS; i++)
            expected[i] = GRIDS * chance[i];
        snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
        params.engine = (snow_aggregate_engine)engine;
        params.hits = 2;
        for (uint64_t i = 0; i < GRIDS; i++) {
            params.random_seed = i;
            snow_grid *grid = make_aggregate(&params, NULL);
            uint64_t walkers;
            assert_ok(snow_step(grid, 1));
            assert_ok(snow_aggregate_walkers(grid, &walkers));
            assert_true(walkers <= MOST_WALKERS);
            got[walkers]++;
            snow_destroy(grid);
        }
        assert_counts(expected, got, MOST_WALKERS + 1);
    }
}

/* On the other lattices the two engines are each other's model. */
static void both_engines_agree_in_every_vessel(void **state)
{
    (void)state;
    enum { MOST = 4096 };
    static const snow_site trees[] = {{2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {6, 0, 0}};
    static const snow_site columns[] = {{2, 1, 0}, {2, 1, 1}, {2, 2, 1}, {4, 3, 0}};
    for (int variant = 0; variant < 4; variant++) {
        bool space = variant & 2;
        snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_LINE);
        params.width = 8;
        params.height = 7;
        params.depth = 5;
        params.lattice = space ? SNOW_AGGREGATE_CUBIC : SNOW_AGGREGATE_HEXAGONAL;
        params.contact = variant & 1 ? SNOW_AGGREGATE_ENTRY : SNOW_AGGREGATE_ARRIVAL;
        params.seeds = space ? columns : trees;
        params.seed_count = 4;
        static snow_aggregate_chance list[MOST];
        static double hits[2][MOST];
        size_t count = 0;
        for (int32_t z = 0; z < (space ? 7 : 1); z++)
            for (int32_t y = 0; y < 7; y++)
                for (int32_t x = -4; x < 8; x++)
                    list[count++].site = (snow_site){x, y, z};
        for (int steps = 0; steps < 2; steps++) {
            params.engine = steps ? SNOW_AGGREGATE_ENGINE_STEPS : SNOW_AGGREGATE_ENGINE_JUMPS;
            snow_grid *grid = make_aggregate(&params, NULL);
            count_hits(grid, 10000, 23 + (uint64_t)steps, list, count, hits[steps]);
            snow_destroy(grid);
        }
        assert_alike(hits[0], hits[1], count);
    }
}

/* The shore. */

enum { BEACH_WIDTH = 5, BEACH_HEIGHT = 3, WASHED = 4 };

/* The cell that is washed away as the fourth. */
static size_t erode(world *self)
{
    int hardness[BEACH_HEIGHT][BEACH_WIDTH];
    int land = BEACH_WIDTH * BEACH_HEIGHT;
    for (int y = 0; y < BEACH_HEIGHT; y++)
        for (int x = 0; x < BEACH_WIDTH; x++)
            hardness[y][x] = 2;
    for (;;) {
        int highest = BEACH_HEIGHT - 1;
        for (bool any = false; !any; highest -= !any)
            for (int x = 0; x < BEACH_WIDTH; x++)
                any |= hardness[highest][x] > 0;
        int y = highest + 1;
        int x = below(self, BEACH_WIDTH);
        while (y > 0) {
            int next = x + below(self, 3) - 1;
            next = next < 0 ? 0 : next >= BEACH_WIDTH ? BEACH_WIDTH - 1 : next;
            if (hardness[y - 1][next] == 0) {
                x = next;
                y--;
            } else if (--hardness[y - 1][next] == 0) {
                if (--land == BEACH_WIDTH * BEACH_HEIGHT - WASHED)
                    return (size_t)((y - 1) * BEACH_WIDTH + next);
                break;
            }
        }
    }
}

static void waves_wear_the_shore_as_the_rules_say(void **state)
{
    (void)state;
    enum { SHORES = 5000 };
    double modelled[BEACH_WIDTH * BEACH_HEIGHT] = {0};
    double got[BEACH_WIDTH * BEACH_HEIGHT] = {0};
    world self = {.random = 1234567};
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_SHORE);
    params.width = BEACH_WIDTH;
    params.height = BEACH_HEIGHT;
    params.hardness_least = params.hardness_greatest = 2;
    for (uint64_t i = 0; i < SHORES; i++) {
        modelled[erode(&self)]++;
        params.random_seed = i;
        snow_grid *grid = make_aggregate(&params, NULL);
        assert_ok(snow_step(grid, WASHED));
        snow_site site;
        assert_ok(snow_aggregate_sites(grid, WASHED - 1, &site, 1));
        got[site.y * BEACH_WIDTH + site.x]++;
        snow_destroy(grid);
    }
    assert_alike(modelled, got, COUNT_OF(got));
}

static void hardness_is_uniform_in_its_range(void **state)
{
    (void)state;
    enum { SIDES = 100, LEAST_HARDNESS = 3, RANGE = 7 };
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_SHORE);
    params.width = params.height = SIDES;
    params.hardness_least = LEAST_HARDNESS;
    params.hardness_greatest = LEAST_HARDNESS + RANGE - 1;
    snow_grid *grid = make_aggregate(&params, NULL);
    double expected[RANGE];
    double got[RANGE] = {0};
    for (int32_t y = 0; y < SIDES; y++)
        for (int32_t x = 0; x < SIDES; x++) {
            double hardness = value_at(grid, SNOW_FIELD_VALUE, x, y);
            assert_true(hardness >= LEAST_HARDNESS && hardness < LEAST_HARDNESS + RANGE);
            got[(int)hardness - LEAST_HARDNESS]++;
        }
    for (int i = 0; i < RANGE; i++)
        expected[i] = (double)SIDES * SIDES / RANGE;
    assert_counts(expected, got, RANGE);
    snow_destroy(grid);
}

/* Clusters of clusters: three particles in a box of 5 x 5. */

enum { BOX = 5, FREE = 3 };

typedef struct piece {
    int x, y;   /* in the plane, not folded */
    int belongs;
} piece;

static int folded(int x)
{
    return ((x % BOX) + BOX) % BOX;
}

/* Hangs the second particle's cluster where it touches the first one's. */
static void hang(piece *pieces, const piece *to, piece *from, int dx, int dy)
{
    int move_x = to->x + dx - from->x;
    int move_y = to->y + dy - from->y;
    int old = from->belongs;
    for (int i = 0; i < FREE; i++)
        if (pieces[i].belongs == old) {
            pieces[i].x += move_x;
            pieces[i].y += move_y;
            pieces[i].belongs = to->belongs;
        }
}

static bool merge_once(piece *pieces)
{
    static const int steps[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (int i = 0; i < FREE; i++)
        for (int k = 0; k < FREE; k++)
            for (int d = 0; d < 4; d++)
                if (pieces[i].belongs != pieces[k].belongs &&
                    folded(pieces[i].x + steps[d][0] - pieces[k].x) == 0 &&
                    folded(pieces[i].y + steps[d][1] - pieces[k].y) == 0) {
                    hang(pieces, &pieces[i], &pieces[k], steps[d][0], steps[d][1]);
                    return true;
                }
    return false;
}

/* Whether the three hang together straight (1) or bent (0). */
static size_t aggregate_pieces(world *self)
{
    piece pieces[FREE];
    for (int i = 0; i < FREE; i++) {
        bool taken;
        do {
            pieces[i] = (piece){below(self, BOX), below(self, BOX), i};
            taken = false;
            for (int k = 0; k < i; k++)
                taken |= pieces[i].x == pieces[k].x && pieces[i].y == pieces[k].y;
        } while (taken);
    }
    for (;;) {
        while (merge_once(pieces))
            continue;
        int clusters = 0;
        int names[FREE];
        for (int i = 0; i < FREE; i++) {
            bool known = false;
            for (int k = 0; k < clusters; k++)
                known |= names[k] == pieces[i].belongs;
            if (!known)
                names[clusters++] = pieces[i].belongs;
        }
        if (clusters == 1)
            break;
        int chosen = names[below(self, clusters)];
        int direction = below(self, 4);
        for (int i = 0; i < FREE; i++)
            if (pieces[i].belongs == chosen) {
                pieces[i].x += (direction == 0) - (direction == 1);
                pieces[i].y += (direction == 2) - (direction == 3);
            }
    }
    int moment = 0;
    for (int i = 0; i < FREE; i++)
        for (int k = 0; k < i; k++)
            moment += (pieces[i].x - pieces[k].x) * (pieces[i].x - pieces[k].x) +
                      (pieces[i].y - pieces[k].y) * (pieces[i].y - pieces[k].y);
    return moment == 6;
}

static void clusters_move_as_the_rules_say(void **state)
{
    (void)state;
    enum { BOXES = 5000 };
    double modelled[2] = {0};
    double got[2] = {0};
    world self = {.random = 7654321};
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_CLUSTER_CLUSTER);
    params.particles = FREE;
    params.density = (double)FREE / (BOX * BOX);
    for (uint64_t i = 0; i < BOXES; i++) {
        modelled[aggregate_pieces(&self)]++;
        params.random_seed = i;
        snow_grid *grid = make_aggregate(&params, NULL);
        assert_ok(snow_run(grid, NULL, NULL));
        snow_aggregate_cluster cluster;
        size_t count = 0;
        assert_ok(snow_aggregate_clusters(grid, &cluster, 1, &count));
        assert_int_equal(1, count);
        bool straight = fabs(cluster.gyration * cluster.gyration * 9 - 6) < 1e-9;
        assert_true(straight || fabs(cluster.gyration * cluster.gyration * 9 - 4) < 1e-9);
        got[straight]++;
        snow_destroy(grid);
    }
    assert_alike(modelled, got, 2);
}

/* Off the lattice: discs touch the one they met, and overlap none. */
static void check_discs(double sticking)
{
    enum { DISCS = 500 };
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_OFF_LATTICE);
    params.sticking = sticking;
    snow_grid *grid = make_aggregate(&params, NULL);
    assert_ok(snow_step(grid, DISCS - 1));
    static snow_point points[DISCS];
    static int64_t parents[DISCS];
    size_t count = 0;
    assert_ok(snow_aggregate_points(grid, 0, points, DISCS));
    assert_ok(snow_aggregate_parents(grid, parents, DISCS, &count));
    assert_int_equal(DISCS, count);
    for (int i = 1; i < DISCS; i++) {
        assert_true(parents[i] >= 0 && parents[i] < i);
        for (int k = 0; k < i; k++) {
            double distance = hypot(points[i].x - points[k].x, points[i].y - points[k].y);
            if (k == parents[i])
                assert_near(1, distance, 1e-6);
            assert_true(distance > 1 - 1e-6);
        }
    }
    snow_destroy(grid);
}

static void discs_touch_and_do_not_overlap(void **state)
{
    (void)state;
    check_discs(1);
    check_discs(0.1);
}

/* The second one's side is any. */
static void the_second_disc_comes_from_any_side(void **state)
{
    (void)state;
    enum { GRIDS = 5000, SECTORS = 12 };
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_OFF_LATTICE);
    double expected[SECTORS];
    double got[SECTORS] = {0};
    for (uint64_t i = 0; i < GRIDS; i++) {
        params.random_seed = i;
        snow_grid *grid = make_aggregate(&params, NULL);
        assert_ok(snow_step(grid, 1));
        snow_point point;
        assert_ok(snow_aggregate_points(grid, 1, &point, 1));
        double turn = atan2(point.y, point.x) / 6.283185307179586 + 0.5;
        got[(int)(turn * SECTORS) % SECTORS]++;
        snow_destroy(grid);
    }
    for (int i = 0; i < SECTORS; i++)
        expected[i] = (double)GRIDS / SECTORS;
    assert_counts(expected, got, SECTORS);
}

/* Where a third disc meets two that touch is known: z -> (z - is)/(z + is), s = sqrt(3)/2, takes what is outside of all
   contacts to a wedge of 120 degrees, and the power 3/2 that to a half-plane, on whose edge the harmonic measure is
   Cauchy's law. */
static void the_third_disc_meets_a_pair_as_it_should(void **state)
{
    (void)state;
    enum { GRIDS = 20000, PARTS = 20 };
    static const snow_site pair[] = {{0, 0, 0}, {1, 0, 0}};
    const double s = sqrt(0.75);
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_OFF_LATTICE);
    params.seeds = pair;
    params.seed_count = COUNT_OF(pair);
    double expected[2 * PARTS];
    double got[2 * PARTS] = {0};
    for (uint64_t i = 0; i < GRIDS; i++) {
        params.random_seed = i;
        snow_grid *grid = make_aggregate(&params, NULL);
        assert_ok(snow_step(grid, 1));
        snow_point point;
        assert_ok(snow_aggregate_points(grid, 2, &point, 1));
        double x = point.x - 0.5;
        double share = 2 / 3.141592653589793 * atan(pow(hypot(x, point.y - s) / hypot(x, point.y + s), 1.5));
        got[(x > 0 ? PARTS : 0) + (int)(share * PARTS)]++;
        snow_destroy(grid);
    }
    for (size_t i = 0; i < COUNT_OF(expected); i++)
        expected[i] = (double)GRIDS / (2 * PARTS);
    assert_counts(expected, got, COUNT_OF(expected));
}

/* Mean square radii of gyration: that of three discs is exactly 5/9, the others are means of 400,000 clusters of an
   independent program (circles up to the nearest disc, found by looking at each). */
static void discs_have_their_radius_of_gyration(void **state)
{
    (void)state;
    enum { GRIDS = 8000 };
    static const uint64_t masses[] = {2, 3, 4, 5, 10};
    static const double known[] = {0.25, 5.0 / 9, 0.895395, 1.260530, 3.313556};
    static const double error[] = {0, 0, 0.000293, 0.000442, 0.001203};
    double sum[COUNT_OF(masses)] = {0};
    double squares[COUNT_OF(masses)] = {0};
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_OFF_LATTICE);
    for (uint64_t i = 0; i < GRIDS; i++) {
        params.random_seed = i;
        snow_grid *grid = make_aggregate(&params, NULL);
        assert_ok(snow_step(grid, 9));
        double radius[COUNT_OF(masses)];
        assert_ok(snow_aggregate_gyration(grid, masses, radius, COUNT_OF(masses)));
        for (size_t k = 0; k < COUNT_OF(masses); k++) {
            sum[k] += radius[k] * radius[k];
            squares[k] += pow(radius[k], 4);
        }
        snow_destroy(grid);
    }
    for (size_t k = 0; k < COUNT_OF(masses); k++) {
        double mean = sum[k] / GRIDS;
        double own = fmax(squares[k] / GRIDS - mean * mean, 0) / GRIDS;
        assert_near(known[k], mean, 4 * sqrt(own + error[k] * error[k]) + 1e-9);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ions_fall_as_the_rules_say),
        cmocka_unit_test(ions_fall_far_as_the_rules_say),
        cmocka_unit_test(ions_fall_past_a_tower_as_the_rules_say),
        cmocka_unit_test(soot_rises_as_the_rules_say),
        cmocka_unit_test(flakes_drift_as_the_rules_say),
        cmocka_unit_test(the_sheets_walkers_wander_as_the_rules_say),
        cmocka_unit_test(both_engines_agree_in_the_ring),
        cmocka_unit_test(walkers_sink_in_the_vessel_as_the_rules_say),
        cmocka_unit_test(walkers_sink_round_the_vessel_as_the_rules_say),
        cmocka_unit_test(walkers_sink_past_obstacles_as_the_rules_say),
        cmocka_unit_test(both_engines_agree_about_obstacles),
        cmocka_unit_test(the_second_hit_fills_a_site),
        cmocka_unit_test(both_engines_agree_in_every_vessel),
        cmocka_unit_test(waves_wear_the_shore_as_the_rules_say),
        cmocka_unit_test(hardness_is_uniform_in_its_range),
        cmocka_unit_test(clusters_move_as_the_rules_say),
        cmocka_unit_test(discs_touch_and_do_not_overlap),
        cmocka_unit_test(the_second_disc_comes_from_any_side),
        cmocka_unit_test(the_third_disc_meets_a_pair_as_it_should),
        cmocka_unit_test(discs_have_their_radius_of_gyration),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
