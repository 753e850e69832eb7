/* What can be asked of an aggregate, each against a plain count of its particles. */
#include "support/aggregates.h"
#include "support/grids.h"

#include <math.h>
#include <stdlib.h>

static snow_grid *reloaded(const snow_grid *grid)
{
    size_t size = 0;
    assert_ok(snow_save(grid, NULL, 0, &size));
    void *bytes = malloc(size);
    assert_non_null(bytes);
    assert_ok(snow_save(grid, bytes, size, &size));
    snow_grid *copy = NULL;
    assert_ok(snow_load(bytes, size, NULL, &copy));
    free(bytes);
    return copy;
}

static const snow_site steps_of_four[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
static const snow_site steps_of_six[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {1, -1, 0}, {-1, 1, 0}};
static const snow_site steps_in_space[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
static const snow_site steps_of_eight[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},  {0, -1, 0},
                                           {1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}};

/* A grown scene, and what its neighbours are. */
typedef struct family {
    snow_aggregate_params params;
    const snow_site *steps;
    size_t count;
    bool joined; /* column 0 is beside the last one */
} family;

enum { FAMILIES = 7, WIDTH = 24, HEIGHT = 80 };

static family family_number(int number)
{
    family found = {aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER), steps_of_four, 4, false};
    snow_aggregate_params *params = &found.params;
    params->width = WIDTH;
    params->height = HEIGHT;
    params->random_seed = 3;
    switch (number) {
    case 1:
        params->lattice = SNOW_AGGREGATE_HEXAGONAL;
        found.steps = steps_of_six;
        found.count = 6;
        break;
    case 2:
        params->lattice = SNOW_AGGREGATE_CUBIC;
        found.steps = steps_in_space;
        found.count = 6;
        break;
    case 3: params->scene = SNOW_AGGREGATE_LINE; break;
    case 4:
        params->scene = SNOW_AGGREGATE_LINE;
        params->periodic = found.joined = true;
        break;
    case 5:
        params->scene = SNOW_AGGREGATE_SNOWFLAKE;
        found.steps = steps_of_eight;
        found.count = 8;
        break;
    case 6:
        params->scene = SNOW_AGGREGATE_ELECTROLYSIS;
        params->periodic = found.joined = true;
        found.steps = steps_of_eight;
        found.count = 8;
        break;
    default: break;
    }
    return found;
}

static bool is_beside(const family *self, snow_site a, snow_site b)
{
    for (size_t k = 0; k < self->count; k++) {
        snow_site next = {a.x + self->steps[k].x, a.y + self->steps[k].y, a.z + self->steps[k].z};
        if (self->joined)
            next.x = (next.x + self->params.width) % self->params.width;
        if (next.x == b.x && next.y == b.y && next.z == b.z)
            return true;
    }
    return false;
}

static void parents_are_the_oldest_neighbours(void **state)
{
    (void)state;
    enum { PARTICLES = 200 };
    for (int number = 0; number < FAMILIES; number++) {
        family self = family_number(number);
        bool seeded = self.params.scene == SNOW_AGGREGATE_WITTEN_SANDER || self.params.scene == SNOW_AGGREGATE_SNOWFLAKE;
        for (int32_t record = 0; record <= 1; record++) {
            self.params.record_order = record;
            snow_grid *grid = make_aggregate(&self.params, NULL);
            assert_ok(snow_step(grid, PARTICLES - seeded));
            size_t count = 0;
            int64_t parents[PARTICLES];
            snow_site *sites = copy_sites(grid, &count);
            assert_int_equal(PARTICLES, count);
            assert_status(SNOW_ERROR_BUFFER, snow_aggregate_parents(grid, parents, PARTICLES - 1, &count));
            assert_ok(snow_aggregate_parents(grid, parents, PARTICLES, NULL));
            for (int64_t i = 0; i < PARTICLES; i++) {
                int64_t oldest = 0;
                while (oldest < i && !is_beside(&self, sites[i], sites[oldest]))
                    oldest++;
                assert_int_equal(oldest < i ? oldest : -1, parents[i]);
                assert_true(parents[i] >= 0 || i == 0 || sites[i].y == 0); /* a seed, or on the floor */
            }
            free(sites);
            snow_destroy(grid);
        }
    }
}

static void sites_are_found_by_order_and_order_by_sites(void **state)
{
    (void)state;
    for (int number = 0; number < FAMILIES; number++) {
        family self = family_number(number);
        self.params.record_order = 1;
        snow_grid *grid = make_aggregate(&self.params, NULL);
        assert_ok(snow_step(grid, 199));
        size_t count = 0;
        snow_site *sites = copy_sites(grid, &count);
        int64_t order;
        for (size_t i = 0; i < count; i++) {
            snow_site one;
            assert_ok(snow_aggregate_sites(grid, i, &one, 1));
            assert_memory_equal(&sites[i], &one, sizeof one);
            assert_ok(snow_aggregate_order_at(grid, one, &order));
            assert_int_equal(i, order);
        }
        static const snow_site nowhere[] = {{INT32_MAX, INT32_MIN, 0}, {0, -5, 0}, {0, 0, 77}, {-1000, 4000, 0}};
        for (size_t i = 0; i < COUNT_OF(nowhere) && number != 2; i++) {
            bool there = false;
            for (size_t k = 0; k < count; k++)
                there |= sites[k].x == nowhere[i].x && sites[k].y == nowhere[i].y && nowhere[i].z == 0;
            if (there)
                continue;
            assert_ok(snow_aggregate_order_at(grid, nowhere[i], &order));
            assert_int_equal(-1, order);
        }
        snow_site more[2];
        assert_ok(snow_aggregate_sites(grid, count, NULL, 0));
        assert_status(SNOW_ERROR_RANGE, snow_aggregate_sites(grid, count + 1, NULL, 0));
        assert_status(SNOW_ERROR_RANGE, snow_aggregate_sites(grid, count - 1, more, 2));
        assert_status(SNOW_ERROR_RANGE, snow_aggregate_sites(grid, UINT64_MAX, more, 2));
        free(sites);
        snow_destroy(grid);
    }
}

/* Centre of mass first, then distances. */
static double plain_gyration(const snow_point *points, uint64_t mass)
{
    double x = 0, y = 0, z = 0, sum = 0;
    for (uint64_t i = 0; i < mass; i++) {
        x += points[i].x / (double)mass;
        y += points[i].y / (double)mass;
        z += points[i].z / (double)mass;
    }
    for (uint64_t i = 0; i < mass; i++)
        sum += pow(points[i].x - x, 2) + pow(points[i].y - y, 2) + pow(points[i].z - z, 2);
    return sqrt(sum / (double)mass);
}

static uint64_t plain_mass(const snow_point *points, size_t count, double radius)
{
    uint64_t mass = 0;
    for (size_t i = 0; i < count; i++)
        mass += sqrt(pow(points[i].x, 2) + pow(points[i].y, 2) + pow(points[i].z, 2)) <= radius * (1 + 1e-12);
    return mass;
}

static void check_measures(const snow_aggregate_params *params)
{
    snow_grid *grid = make_aggregate(params, NULL);
    assert_ok(snow_step(grid, 199));
    uint64_t count = 0;
    assert_ok(snow_aggregate_particles(grid, &count));
    snow_point *points = calloc(count, sizeof *points);
    assert_non_null(points);
    assert_ok(snow_aggregate_points(grid, 0, points, (size_t)count));

    const uint64_t masses[] = {1, 2, 2, 17, 150, count};
    double gyration[COUNT_OF(masses)];
    assert_ok(snow_aggregate_gyration(grid, masses, gyration, COUNT_OF(masses)));
    for (size_t i = 0; i < COUNT_OF(masses); i++)
        assert_near(plain_gyration(points, masses[i]), gyration[i], 1e-12 * (1 + gyration[i]));

    static const double radii[] = {0, 1, 1, 1.5, 5, 8.25, 1000};
    uint64_t within[COUNT_OF(radii)];
    assert_ok(snow_aggregate_mass(grid, radii, within, COUNT_OF(radii)));
    for (size_t i = 0; i < COUNT_OF(radii); i++)
        assert_int_equal(plain_mass(points, (size_t)count, radii[i]), within[i]);

    snow_point low, high, least = points[0], greatest = points[0];
    assert_ok(snow_aggregate_bounds(grid, &low, &high));
    for (size_t i = 0; i < count; i++) {
        least = (snow_point){fmin(least.x, points[i].x), fmin(least.y, points[i].y), fmin(least.z, points[i].z)};
        greatest = (snow_point){fmax(greatest.x, points[i].x), fmax(greatest.y, points[i].y),
                                fmax(greatest.z, points[i].z)};
    }
    assert_memory_equal(&least, &low, sizeof low);
    assert_memory_equal(&greatest, &high, sizeof high);
    free(points);
    snow_destroy(grid);
}

static void radii_and_masses_are_those_of_the_points(void **state)
{
    (void)state;
    for (int number = 0; number < FAMILIES; number++) {
        family self = family_number(number);
        check_measures(&self.params);
    }
    snow_aggregate_params discs = aggregate_scene(SNOW_AGGREGATE_OFF_LATTICE);
    check_measures(&discs);
}

static void lists_that_make_no_sense_are_refused(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    snow_grid *grid = make_aggregate(&params, NULL);
    assert_ok(snow_step(grid, 9));
    static const uint64_t falling[] = {5, 4};
    static const uint64_t none[] = {0, 5};
    static const uint64_t many[] = {5, 11};
    double radii[2] = {-1, -1};
    assert_status(SNOW_ERROR_RANGE, snow_aggregate_gyration(grid, falling, radii, 2));
    assert_status(SNOW_ERROR_RANGE, snow_aggregate_gyration(grid, none, radii, 2));
    assert_status(SNOW_ERROR_RANGE, snow_aggregate_gyration(grid, many, radii, 2));
    assert_same_double(-1, radii[0]);
    static const double inwards[] = {2, 1};
    static const double negative[] = {-1, 1};
    static const double endless[] = {1, INFINITY};
    uint64_t masses[2] = {7, 7};
    assert_status(SNOW_ERROR_RANGE, snow_aggregate_mass(grid, inwards, masses, 2));
    assert_status(SNOW_ERROR_RANGE, snow_aggregate_mass(grid, negative, masses, 2));
    assert_status(SNOW_ERROR_NOT_FINITE, snow_aggregate_mass(grid, endless, masses, 2));
    assert_int_equal(7, masses[0]);
    snow_destroy(grid);

    params.scene = SNOW_AGGREGATE_LINE; /* nothing there yet */
    grid = make_aggregate(&params, NULL);
    snow_point low, high;
    assert_status(SNOW_ERROR_RANGE, snow_aggregate_bounds(grid, &low, &high));
    snow_destroy(grid);
}

static void check_profile(const snow_aggregate_params *params, size_t columns)
{
    enum { MOST = 256 };
    int32_t heights[MOST];
    int32_t expected[MOST] = {0};
    snow_grid *grid = make_aggregate(params, NULL);
    assert_ok(snow_step(grid, 60));
    size_t count = 0;
    snow_site *sites = copy_sites(grid, &count);
    for (size_t i = 0; i < count; i++) {
        int32_t half = params->lattice == SNOW_AGGREGATE_HEXAGONAL ? sites[i].y / 2 : 0;
        bool space = params->lattice == SNOW_AGGREGATE_CUBIC;
        int32_t column = space ? sites[i].y * params->width + sites[i].x : sites[i].x + half;
        int32_t height = (space ? sites[i].z : sites[i].y) + 1;
        assert_true(column >= 0 && (size_t)column < columns);
        expected[column] = height > expected[column] ? height : expected[column];
    }
    assert_ok(snow_aggregate_profile(grid, NULL, 0, &count));
    assert_int_equal(columns, count);
    assert_status(SNOW_ERROR_BUFFER, snow_aggregate_profile(grid, heights, columns - 1, &count));
    assert_ok(snow_aggregate_profile(grid, heights, MOST, NULL));
    for (size_t i = 0; i < columns; i++)
        assert_int_equal(expected[i], heights[i]);
    free(sites);
    snow_destroy(grid);
}

static void profiles_are_the_highest_particles(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_LINE);
    params.width = 20;
    params.depth = 6;
    params.height = 40;
    for (int lattice = SNOW_AGGREGATE_SQUARE; lattice <= SNOW_AGGREGATE_CUBIC; lattice++) {
        params.lattice = (snow_aggregate_lattice)lattice;
        check_profile(&params, lattice == SNOW_AGGREGATE_CUBIC ? 120 : 20);
    }
    params.lattice = SNOW_AGGREGATE_SQUARE;
    params.scene = SNOW_AGGREGATE_ELECTROLYSIS;
    check_profile(&params, 20);
}

static void the_shores_profile_and_fields_are_its_land(void **state)
{
    (void)state;
    enum { COLUMNS = 20, ROWS = 10 };
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_SHORE);
    params.width = COLUMNS;
    params.height = ROWS;
    snow_grid *grid = make_aggregate(&params, NULL);
    int32_t heights[COLUMNS];
    assert_ok(snow_aggregate_profile(grid, heights, COLUMNS, NULL));
    for (int32_t x = 0; x < COLUMNS; x++)
        assert_int_equal(ROWS, heights[x]);
    assert_ok(snow_step(grid, 60));
    assert_ok(snow_aggregate_profile(grid, heights, COLUMNS, NULL));
    uint64_t washed = 0;
    for (int32_t x = 0; x < COLUMNS; x++) {
        int32_t highest = 0;
        for (int32_t y = 0; y < ROWS; y++) {
            bool land = value_at(grid, SNOW_FIELD_VALUE, x, y) > 0;
            assert_same_double(land ? 0 : 1, value_at(grid, SNOW_FIELD_FROZEN, x, y));
            washed += !land;
            highest = land ? y + 1 : highest;
        }
        assert_int_equal(highest, heights[x]);
    }
    assert_int_equal(60, washed);
    snow_destroy(grid);
}

static void fields_are_those_of_the_particles(void **state)
{
    (void)state;
    for (int number = 0; number < FAMILIES; number++) {
        family self = family_number(number);
        if (self.params.lattice == SNOW_AGGREGATE_CUBIC)
            continue;
        self.params.record_order = 1;
        snow_grid *grid = make_aggregate(&self.params, NULL);
        assert_ok(snow_step(grid, 50));
        size_t count = 0;
        snow_site *sites = copy_sites(grid, &count);
        bool seeded = count == 51;
        snow_rect box = widened(widened(bounds_of(grid)));
        for (int32_t y = box.r; y < box.r + box.height; y++) {
            for (int32_t x = box.q; x < box.q + box.width; x++) {
                snow_site here = {x, y, 0};
                size_t order = 0;
                bool near = false;
                for (size_t i = 0; i < count; i++)
                    near |= is_beside(&self, here, sites[i]);
                while (order < count && (sites[order].x != x || sites[order].y != y))
                    order++;
                bool filled = order < count;
                bool inside = value_at(grid, SNOW_FIELD_INSIDE, x, y) > 0;
                assert_same_double(filled, value_at(grid, SNOW_FIELD_FROZEN, x, y));
                assert_same_double(filled, value_at(grid, SNOW_FIELD_VALUE, x, y));
                assert_same_double(filled || (near && inside), value_at(grid, SNOW_FIELD_RECEPTIVE, x, y));
                double step = filled ? (double)order + !seeded : -1;
                assert_same_double(step, value_at(grid, SNOW_FIELD_FREEZE_STEP, x, y));
                bool vessel = self.params.scene == SNOW_AGGREGATE_LINE ||
                              self.params.scene == SNOW_AGGREGATE_ELECTROLYSIS;
                assert_int_equal(!vessel || (x >= 0 && x < WIDTH && y >= 0 && y < HEIGHT), inside);
            }
        }
        double zero = 0;
        snow_rect one = {0, 0, 1, 1};
        assert_status(SNOW_ERROR_UNSUPPORTED, snow_field_set(grid, SNOW_FIELD_VALUE, &one, &zero, 1));
        free(sites);
        snow_destroy(grid);
    }
}

static void fields_that_are_not_kept_are_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < aggregate_kind_count; i++) {
        snow_aggregate_params params = aggregate_kind(i);
        snow_grid *grid = make_aggregate(&params, NULL);
        bool flat = params.lattice != SNOW_AGGREGATE_CUBIC && params.scene != SNOW_AGGREGATE_OFF_LATTICE;
        bool moves = params.scene == SNOW_AGGREGATE_CLUSTER_CLUSTER;
        bool jumps = params.engine == SNOW_AGGREGATE_ENGINE_AUTO &&
                     (params.scene == SNOW_AGGREGATE_WITTEN_SANDER || params.scene == SNOW_AGGREGATE_LINE);
        double value, density = -1;
        snow_status frozen = !flat ? SNOW_ERROR_UNSUPPORTED : jumps ? SNOW_ERROR_NOT_RECORDED : SNOW_OK;
        snow_status step = !flat || moves ? SNOW_ERROR_UNSUPPORTED : SNOW_ERROR_NOT_RECORDED;
        assert_status(frozen, snow_cell_value(grid, SNOW_FIELD_FROZEN, 0, 0, &value));
        assert_status(step, snow_cell_value(grid, SNOW_FIELD_FREEZE_STEP, 0, 0, &value));
        assert_status(flat ? SNOW_OK : SNOW_ERROR_UNSUPPORTED, snow_cell_value(grid, SNOW_FIELD_INSIDE, 0, 0, &value));
        assert_status(SNOW_ERROR_UNSUPPORTED, snow_cell_value(grid, SNOW_FIELD_VAPOUR, 0, 0, &value));
        assert_status(flat ? SNOW_OK : SNOW_ERROR_UNSUPPORTED, snow_density(grid, &density));
        assert_true(flat ? density >= 0 && density <= 1 : density == -1);
        snow_destroy(grid);
    }
}

static void obstacles_are_those_that_were_given(void **state)
{
    (void)state;
    static const snow_site plane[] = {{3, 0, 0}, {0, -3, 0}, {-3, 0, 0}};
    static const snow_site space[] = {{3, 0, -2}, {0, -3, 5}, {-3, 0, 0}};
    for (int lattice = SNOW_AGGREGATE_SQUARE; lattice <= SNOW_AGGREGATE_CUBIC; lattice++) {
        const snow_site *given = lattice == SNOW_AGGREGATE_CUBIC ? space : plane;
        snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
        params.lattice = (snow_aggregate_lattice)lattice;
        params.obstacles = given;
        params.obstacle_count = COUNT_OF(plane);
        snow_grid *grid = make_aggregate(&params, NULL);
        assert_ok(snow_step(grid, 50));
        snow_grid *copy = reloaded(grid);
        snow_site got[COUNT_OF(plane)] = {{7, 7, 7}};
        size_t count = 0;
        assert_status(SNOW_ERROR_NULL, snow_aggregate_obstacles(copy, NULL, 0, NULL));
        assert_status(SNOW_ERROR_BUFFER, snow_aggregate_obstacles(copy, got, COUNT_OF(got) - 1, &count));
        assert_int_equal(COUNT_OF(got), count);
        assert_int_equal(7, got[0].x);
        assert_ok(snow_aggregate_obstacles(copy, got, COUNT_OF(got), NULL));
        assert_memory_equal(given, got, sizeof got);
        snow_destroy(copy);
        snow_destroy(grid);
    }
}

static void scenes_say_what_they_have_not(void **state)
{
    (void)state;
    for (size_t i = 0; i < aggregate_kind_count; i++) {
        snow_aggregate_params params = aggregate_kind(i);
        bool discs = params.scene == SNOW_AGGREGATE_OFF_LATTICE;
        bool moves = params.scene == SNOW_AGGREGATE_CLUSTER_CLUSTER;
        bool shore = params.scene == SNOW_AGGREGATE_SHORE;
        bool floor = shore || params.scene == SNOW_AGGREGATE_LINE || params.scene == SNOW_AGGREGATE_ELECTROLYSIS;
        bool single = !discs && !moves && !shore;
        snow_grid *grid = make_aggregate(&params, NULL);
        assert_ok(snow_step(grid, 5));
        const uint64_t mass = 1;
        double radius;
        size_t count = 0;
        int64_t order;
        snow_site site = {0, 0, 0};
#define HAS(has) ((has) ? SNOW_OK : SNOW_ERROR_UNSUPPORTED)
        assert_status(HAS(!moves), snow_aggregate_gyration(grid, &mass, &radius, 1));
        assert_status(HAS(!discs), snow_aggregate_sites(grid, 0, &site, 1));
        assert_status(HAS(!moves && !shore), snow_aggregate_parents(grid, NULL, 0, &count));
        assert_status(HAS(floor), snow_aggregate_profile(grid, NULL, 0, &count));
        assert_status(HAS(moves), snow_aggregate_clusters(grid, NULL, 0, &count));
        assert_status(HAS(single), snow_aggregate_sample(grid, 10, 1, NULL, 0, &count));
        assert_status(discs || moves ? SNOW_ERROR_UNSUPPORTED : SNOW_ERROR_NOT_RECORDED,
                      snow_aggregate_order_at(grid, site, &order));
        snow_destroy(grid);
    }
}

static void walkers_are_counted(void **state)
{
    (void)state;
    for (size_t i = 0; i < aggregate_kind_count; i++) {
        snow_aggregate_params params = aggregate_kind(i);
        snow_grid *grid = make_aggregate(&params, NULL);
        assert_ok(snow_step(grid, 40));
        uint64_t walkers = 0;
        assert_ok(snow_aggregate_walkers(grid, &walkers));
        bool sure = params.scene == SNOW_AGGREGATE_WITTEN_SANDER || params.scene == SNOW_AGGREGATE_LINE ||
                    params.scene == SNOW_AGGREGATE_SNOWFLAKE || params.scene == SNOW_AGGREGATE_OFF_LATTICE;
        if (sure && params.hits == 1)
            assert_int_equal(40, walkers);
        else
            assert_true(walkers >= 40 * (uint64_t)(params.hits > 1 ? 2 : 1) - 1);
        snow_destroy(grid);
    }
}

static void clusters_hold_all_particles(void **state)
{
    (void)state;
    enum { PARTICLES = 300 };
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_CLUSTER_CLUSTER);
    params.particles = PARTICLES;
    for (int lattice = 0; lattice < 2; lattice++) {
        params.lattice = lattice == 0 ? SNOW_AGGREGATE_SQUARE : SNOW_AGGREGATE_CUBIC;
        snow_grid *grid = make_aggregate(&params, NULL);
        assert_ok(snow_step(grid, 100));
        snow_aggregate_cluster list[PARTICLES];
        size_t count = 0;
        assert_ok(snow_aggregate_clusters(grid, list, PARTICLES, &count));
        assert_status(SNOW_ERROR_BUFFER, snow_aggregate_clusters(grid, list, count - 1, NULL));
        uint64_t sum = 0, largest = 0;
        for (size_t i = 0; i < count; i++) {
            sum += list[i].mass;
            largest = list[i].mass > largest ? list[i].mass : largest;
            if (list[i].mass <= 2)
                assert_near(list[i].mass == 1 ? 0 : 0.5, list[i].gyration, 1e-12);
        }
        assert_int_equal(PARTICLES, sum);
        assert_int_equal(frozen_of(grid), largest);
        snow_destroy(grid);
    }
}

static void sampled_chances_state_their_error(void **state)
{
    (void)state;
    enum { WALKS = 200 };
    for (size_t kind = 0; kind < aggregate_kind_count; kind++) {
        snow_aggregate_params params = aggregate_kind(kind);
        snow_grid *grid = make_aggregate(&params, NULL);
        assert_ok(snow_step(grid, 20));
        size_t count = 0;
        uint64_t before = digest_of(grid);
        if (snow_aggregate_sample(grid, 1, 1, NULL, 0, &count) == SNOW_ERROR_UNSUPPORTED) {
            snow_destroy(grid);
            continue;
        }
        snow_aggregate_chance *list = sample_chances(grid, WALKS, 4, &count);
        double sum = 0;
        for (size_t i = 0; i < count; i++) {
            double chance = list[i].probability;
            sum += chance;
            assert_near(sqrt(chance * (1 - chance) / WALKS), list[i].error, 1e-15);
        }
        assert_near(1, sum, 1e-12);
        assert_int_equal(before, digest_of(grid)); /* nothing has changed */
        size_t wanted = 0;
        assert_status(count > 1 ? SNOW_ERROR_BUFFER : SNOW_OK, snow_aggregate_sample(grid, WALKS, 4, list, 1, &wanted));
        assert_int_equal(count, wanted);
        free(list);
        snow_destroy(grid);
    }
}

/* Whatever walks: lanes of vectors, or one after the other. */
static void samples_are_the_same_by_every_instruction_set(void **state)
{
    (void)state;
    enum { WALKS = 500 };
    snow_isa isas[8];
    size_t sets = available_isas(isas);
    for (int variant = 0; variant < 6; variant++) {
        snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
        params.lattice = (snow_aggregate_lattice)(variant / 2 + 1);
        params.contact = variant & 1 ? SNOW_AGGREGATE_ENTRY : SNOW_AGGREGATE_ARRIVAL;
        snow_aggregate_chance *first = NULL;
        size_t expected = 0;
        for (size_t k = 0; k < sets; k++) {
            snow_options options = default_options();
            options.isa = isas[k];
            snow_grid *grid = make_aggregate(&params, &options);
            assert_ok(snow_step(grid, 200));
            size_t count = 0;
            snow_aggregate_chance *list = sample_chances(grid, WALKS, 9, &count);
            if (k == 0) {
                first = list;
                expected = count;
            } else {
                assert_int_equal(expected, count);
                for (size_t i = 0; i < count; i++) {
                    assert_memory_equal(&first[i].site, &list[i].site, sizeof list[i].site);
                    assert_same_double(first[i].probability, list[i].probability);
                }
                free(list);
            }
            snow_destroy(grid);
        }
        free(first);
    }
}

/* With the same seed value: were the streams the same, each sample would be the particle that joins next. */
static void samples_have_streams_of_their_own(void **state)
{
    (void)state;
    static const snow_aggregate_engine engines[] = {SNOW_AGGREGATE_ENGINE_JUMPS, SNOW_AGGREGATE_ENGINE_STEPS};
    for (size_t k = 0; k < COUNT_OF(engines); k++) {
        enum { SEEDS = 40 };
        int same = 0;
        for (uint64_t seed = 0; seed < SEEDS; seed++) {
            snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
            params.engine = engines[k];
            params.random_seed = seed;
            snow_grid *grid = make_aggregate(&params, NULL);
            snow_aggregate_chance sample;
            snow_site joined;
            assert_ok(snow_aggregate_sample(grid, 1, seed, &sample, 1, NULL));
            assert_ok(snow_step(grid, 1));
            assert_ok(snow_aggregate_sites(grid, 1, &joined, 1));
            same += sample.site.x == joined.x && sample.site.y == joined.y;
            snow_destroy(grid);
        }
        assert_true(same < SEEDS / 2); /* a quarter is expected */
    }
}

static void a_full_domain_has_no_chances(void **state)
{
    (void)state;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_CHIMNEY);
    params.width = 3;
    params.height = 10;
    params.wall_right = params.wall_right_top = 2;
    snow_grid *grid = make_aggregate(&params, NULL);
    assert_ok(snow_step(grid, 1));
    size_t count = 0;
    assert_status(SNOW_ERROR_FULL, snow_aggregate_sample(grid, 10, 1, NULL, 0, &count));
    snow_destroy(grid);
}

static void nothing_is_asked_of_nothing_or_of_another_model(void **state)
{
    (void)state;
    snow_reiter_params crystal = disc_scene(0.4, 0.001, 1, 10);
    snow_grid *other = make_grid(&crystal, NULL);
    for (int round = 0; round < 2; round++) {
        snow_status expected = round == 0 ? SNOW_ERROR_NULL : SNOW_ERROR_UNSUPPORTED;
        const snow_grid *grid = round == 0 ? NULL : other;
        uint64_t number = 1;
        double radius = 1;
        size_t count = 7;
        int64_t order;
        snow_site site = {0, 0, 0};
        snow_point low, high;
        assert_status(expected, snow_aggregate_particles(grid, &number));
        assert_status(expected, snow_aggregate_walkers(grid, &number));
        assert_status(expected, snow_aggregate_sites(grid, 0, &site, 1));
        assert_status(expected, snow_aggregate_points(grid, 0, &low, 1));
        assert_status(expected, snow_aggregate_parents(grid, NULL, 0, &count));
        assert_status(expected, snow_aggregate_order_at(grid, site, &order));
        assert_status(expected, snow_aggregate_obstacles(grid, &site, 1, &count));
        assert_status(expected, snow_aggregate_bounds(grid, &low, &high));
        assert_status(expected, snow_aggregate_gyration(grid, &number, &radius, 1));
        assert_status(expected, snow_aggregate_mass(grid, &radius, &number, 1));
        assert_status(expected, snow_aggregate_profile(grid, NULL, 0, &count));
        assert_status(expected, snow_aggregate_clusters(grid, NULL, 0, &count));
        assert_status(expected, snow_aggregate_growth(grid, NULL, 0, &count));
        assert_status(expected, snow_aggregate_sample(grid, 1, 1, NULL, 0, &count));
        assert_int_equal(7, count);
    }
    snow_destroy(other);
}

/* Measures of the cells need the table of sites as the cells themselves do; on the square lattice they go by its
   distances. */
static void measures_of_cells_need_the_cells(void **state)
{
    (void)state;
    static const snow_site seeds[2] = {{0, 0, 0}, {1, 1, 0}};
    static const double radii[2] = {0, 1.5};
    uint64_t masses[2] = {7, 7}, boxes = 7;
    double dimension = 7;
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    params.seeds = seeds;
    params.seed_count = COUNT_OF(seeds);
    snow_grid *grid = make_aggregate(&params, NULL);
    assert_status(SNOW_ERROR_NOT_RECORDED, snow_mass_radius(grid, radii, COUNT_OF(radii), masses));
    assert_status(SNOW_ERROR_NOT_RECORDED, snow_box_count(grid, 1, &boxes));
    assert_status(SNOW_ERROR_NOT_RECORDED, snow_dimension(grid, &dimension));
    assert_true(masses[0] == 7 && boxes == 7 && dimension == 7);
    snow_destroy(grid);
    params.record_order = 1;
    grid = make_aggregate(&params, NULL);
    assert_ok(snow_mass_radius(grid, radii, COUNT_OF(radii), masses));
    assert_ok(snow_box_count(grid, 1, &boxes));
    assert_int_equal(1, masses[0]);
    assert_int_equal(2, masses[1]);
    assert_int_equal(2, boxes);
    snow_destroy(grid);
}

/* What grid.h and measure.h say of all frozen cells, in every scene, against its particles one by one. */
static void check_census(const snow_grid *grid)
{
    uint64_t count = 0;
    assert_ok(snow_aggregate_particles(grid, &count));
    snow_site *sites = calloc((size_t)count, sizeof *sites);
    snow_point *points = calloc((size_t)count, sizeof *points);
    assert_true(sites != NULL && points != NULL);
    assert_ok(snow_aggregate_points(grid, 0, points, (size_t)count));
    bool discs = snow_aggregate_sites(grid, 0, sites, (size_t)count) == SNOW_ERROR_UNSUPPORTED;
    bool drift = snow_aggregate_clusters(grid, NULL, 0, &(size_t){0}) == SNOW_OK;
    snow_hexagon held = {INT64_MAX, INT64_MIN, INT64_MAX, INT64_MIN, INT64_MAX, INT64_MIN};
    double tip = 0;
    for (size_t i = 0; i < count; i++) {
        int64_t q = discs ? (int64_t)floor(points[i].x) : sites[i].x;
        int64_t r = discs ? (int64_t)floor(points[i].y) : sites[i].y;
        snow_point at = drift ? (snow_point){sites[i].x, sites[i].y, sites[i].z} : points[i];
        held.least_q = q < held.least_q ? q : held.least_q;
        held.greatest_q = q > held.greatest_q ? q : held.greatest_q;
        held.least_r = r < held.least_r ? r : held.least_r;
        held.greatest_r = r > held.greatest_r ? r : held.greatest_r;
        held.least_s = q + r < held.least_s ? q + r : held.least_s;
        held.greatest_s = q + r > held.greatest_s ? q + r : held.greatest_s;
        tip = fmax(tip, sqrt(at.x * at.x + at.y * at.y + at.z * at.z));
    }
    double radius;
    snow_hexagon hexagon;
    assert_ok(snow_tip_radius(grid, &radius));
    assert_near(tip, radius, 1e-12 * (1 + tip));
    assert_ok(snow_frozen_hexagon(grid, &hexagon));
    assert_memory_equal(&held, &hexagon, sizeof held);
    snow_rect bounds;
    assert_ok(snow_frozen_bounds(grid, &bounds));
    assert_int_equal(held.least_q, bounds.q);
    assert_int_equal(held.least_r, bounds.r);
    assert_int_equal(held.greatest_q - held.least_q + 1, bounds.width);
    assert_int_equal(held.greatest_r - held.least_r + 1, bounds.height);
    uint64_t boxes;
    if (snow_box_count(grid, 1, &boxes) == SNOW_OK) {
        uint64_t mass;
        assert_int_equal(count, boxes);
        assert_ok(snow_mass_radius(grid, &(double){tip + 1}, 1, &mass));
        assert_int_equal(count, mass);
    }
    double inside;
    double density = 1;
    snow_status cells = snow_cell_value(grid, SNOW_FIELD_INSIDE, 0, 0, &inside); /* there are cells to count */
    assert_status(cells, snow_density(grid, &density));
    assert_true(density > 0 && density <= 1);
    free(points);
    free(sites);
}

static void every_scene_knows_its_bounds(void **state)
{
    (void)state;
    for (size_t i = 0; i < aggregate_kind_count; i++) {
        snow_aggregate_params params = aggregate_kind(i);
        params.record_order = params.scene != SNOW_AGGREGATE_OFF_LATTICE;
        snow_grid *grid = make_aggregate(&params, NULL);
        for (int round = 0; round < 3; round++) {
            assert_ok(snow_step(grid, 40));
            check_census(grid);
        }
        snow_destroy(grid);
    }
}

/* Each site of the periodic box, those at its sides too. */
static void check_box_fields(const snow_grid *grid)
{
    snow_rect box;
    assert_ok(snow_domain_bounds(grid, &box));
    assert_int_equal(box.width, box.height);
    for (int32_t y = -1; y <= box.height; y++) {
        for (int32_t x = -1; x <= box.width; x++) {
            bool inside = x >= 0 && x < box.width && y >= 0 && y < box.height;
            bool receptive = inside && value_at(grid, SNOW_FIELD_FROZEN, x, y) > 0;
            for (size_t i = 0; inside && i < COUNT_OF(steps_of_four); i++)
                receptive |= value_at(grid, SNOW_FIELD_FROZEN, (x + steps_of_four[i].x + box.width) % box.width,
                                      (y + steps_of_four[i].y + box.height) % box.height) > 0;
            assert_same_double(receptive, value_at(grid, SNOW_FIELD_RECEPTIVE, x, y));
        }
    }
}

/* Particles that drift are everywhere in their box from the start, also in a saved one. */
static void drifting_clusters_are_measured_where_they_are(void **state)
{
    (void)state;
    enum { PARTICLES = 400 };
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_CLUSTER_CLUSTER);
    params.particles = PARTICLES;
    params.density = 0.1; /* a box of 64 x 64, or of 16 x 16 x 16 */
    for (int lattice = 0; lattice < 2; lattice++) {
        params.lattice = lattice == 0 ? SNOW_AGGREGATE_SQUARE : SNOW_AGGREGATE_CUBIC;
        snow_grid *grid = make_aggregate(&params, NULL);
        check_census(grid);
        assert_ok(snow_step(grid, 120));
        check_census(grid);
        snow_grid *copy = reloaded(grid);
        check_census(copy);
        snow_destroy(copy);
        uint64_t boxes = 7;
        double value;
        snow_status plane = lattice == 0 ? SNOW_OK : SNOW_ERROR_UNSUPPORTED;
        assert_status(plane, snow_box_count(grid, 64, &boxes));
        assert_int_equal(lattice == 0 ? 1 : 7, boxes);
        assert_status(plane, snow_mass(grid, NULL, &value));
        if (lattice == 0) {
            snow_rect bounds;
            assert_same_double(PARTICLES, value);
            check_box_fields(grid);
            assert_ok(snow_frozen_bounds(grid, &bounds));
            assert_ok(snow_density(grid, &value));
            assert_true(value >= (double)PARTICLES / bounds.width / bounds.height && value < 0.15);
        }
        snow_stop stop = default_stop();
        stop.tip_radius = 40; /* of 90: some particle is there by chance */
        snow_summary summary = run_grid(grid, &stop);
        assert_int_equal(lattice == 0 ? SNOW_STOP_RADIUS : SNOW_STOP_STILL, summary.reason);
        assert_ok(snow_tip_radius(grid, &value));
        assert_same_double(value, summary.tip_radius);
        snow_destroy(grid);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parents_are_the_oldest_neighbours),
        cmocka_unit_test(sites_are_found_by_order_and_order_by_sites),
        cmocka_unit_test(radii_and_masses_are_those_of_the_points),
        cmocka_unit_test(lists_that_make_no_sense_are_refused),
        cmocka_unit_test(profiles_are_the_highest_particles),
        cmocka_unit_test(the_shores_profile_and_fields_are_its_land),
        cmocka_unit_test(fields_are_those_of_the_particles),
        cmocka_unit_test(fields_that_are_not_kept_are_refused),
        cmocka_unit_test(obstacles_are_those_that_were_given),
        cmocka_unit_test(scenes_say_what_they_have_not),
        cmocka_unit_test(measures_of_cells_need_the_cells),
        cmocka_unit_test(every_scene_knows_its_bounds),
        cmocka_unit_test(drifting_clusters_are_measured_where_they_are),
        cmocka_unit_test(walkers_are_counted),
        cmocka_unit_test(clusters_hold_all_particles),
        cmocka_unit_test(sampled_chances_state_their_error),
        cmocka_unit_test(samples_are_the_same_by_every_instruction_set),
        cmocka_unit_test(samples_have_streams_of_their_own),
        cmocka_unit_test(a_full_domain_has_no_chances),
        cmocka_unit_test(nothing_is_asked_of_nothing_or_of_another_model),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
