#include "lives.h"

#include "aggregates.h"
#include "grids.h"
#include "packard.h"

#include <stdlib.h>
#include <string.h>

static snow_status create_reiter(snow_reiter_params params, bool large, const snow_options *options, snow_grid **grid)
{
    if (large) {
        params.radius = params.engine == SNOW_REITER_ENGINE_QUAD ? 30 : 90;
        params.noise = 0.1; /* work everywhere */
    }
    return snow_reiter_create(&params, options, grid);
}

static snow_status reiter_rows(bool large, const snow_options *options, snow_grid **grid)
{
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 9);
    params.engine = SNOW_REITER_ENGINE_ROWS;
    return create_reiter(params, large, options, grid);
}

static snow_status reiter_single(bool large, const snow_options *options, snow_grid **grid)
{
    snow_reiter_params params = hexagon_scene(0.5, 0.02, 1, 8);
    params.precision = SNOW_REITER_PRECISION_SINGLE;
    params.record_freeze_steps = 1;
    return create_reiter(params, large, options, grid);
}

static double uneven(void *context, int32_t q, int32_t r)
{
    (void)context;
    return 0.01 + ((q ^ r) & 3) / 256.0;
}

static snow_status reiter_uneven(bool large, const snow_options *options, snow_grid **grid)
{
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 8);
    params.addition_at = uneven;
    params.record_freeze_steps = 1;
    return create_reiter(params, large, options, grid);
}

static snow_status reiter_reference(bool large, const snow_options *options, snow_grid **grid)
{
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 8);
    params.engine = SNOW_REITER_ENGINE_REFERENCE;
    return create_reiter(params, large, options, grid);
}

static snow_status reiter_quad(bool large, const snow_options *options, snow_grid **grid)
{
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 7);
    params.engine = SNOW_REITER_ENGINE_QUAD;
    return create_reiter(params, large, options, grid);
}

static snow_status create_packard(const char *rule, snow_packard_engine engine, bool large, const snow_options *options,
                                  snow_grid **grid)
{
    snow_packard_params params = packard_scene(rule);
    params.engine = engine;
    if (large) {
        params.scatter = 80;
        params.scatter_side = 500;
    }
    return snow_packard_create(&params, options, grid);
}

static snow_status packard_tiles(bool large, const snow_options *options, snow_grid **grid)
{
    return create_packard("0100000", SNOW_PACKARD_ENGINE_TILES, large, options, grid);
}

static snow_status packard_quadtree(bool large, const snow_options *options, snow_grid **grid)
{
    return create_packard("0101010", SNOW_PACKARD_ENGINE_QUADTREE, large, options, grid);
}

static snow_status packard_reference(bool large, const snow_options *options, snow_grid **grid)
{
    return create_packard("0101010", SNOW_PACKARD_ENGINE_REFERENCE, large, options, grid);
}

static snow_status packard_torus(bool large, const snow_options *options, snow_grid **grid)
{
    snow_packard_params params = packard_scene("0101111");
    params.domain = SNOW_PACKARD_TORUS;
    params.width = large ? 700 : 21;
    params.height = large ? 600 : 17;
    params.record_freeze_steps = 1;
    params.cluster = large ? 90 : 5;
    return snow_packard_create(&params, options, grid);
}

/* The number of a scene in aggregate_kind(), with an order of the particles. */
static snow_status create_aggregate(size_t kind, bool large, const snow_options *options, snow_grid **grid)
{
    snow_aggregate_params params = aggregate_kind(kind);
    params.record_order = params.scene != SNOW_AGGREGATE_SHORE && params.scene != SNOW_AGGREGATE_CLUSTER_CLUSTER &&
                          params.scene != SNOW_AGGREGATE_OFF_LATTICE;
    params.particles = large ? 4000 : 400;
    return snow_aggregate_create(&params, options, grid);
}

static snow_status aggregate_jumps(bool large, const snow_options *options, snow_grid **grid)
{
    return create_aggregate(0, large, options, grid);
}

static snow_status aggregate_steps(bool large, const snow_options *options, snow_grid **grid)
{
    return create_aggregate(6, large, options, grid);
}

static snow_status aggregate_laboratory(bool large, const snow_options *options, snow_grid **grid)
{
    return create_aggregate(7, large, options, grid);
}

static snow_status aggregate_space(bool large, const snow_options *options, snow_grid **grid)
{
    return create_aggregate(5, large, options, grid);
}

static snow_status aggregate_electrolysis(bool large, const snow_options *options, snow_grid **grid)
{
    return create_aggregate(11, large, options, grid);
}

static snow_status aggregate_chimney(bool large, const snow_options *options, snow_grid **grid)
{
    return create_aggregate(13, large, options, grid);
}

static snow_status aggregate_snowflake(bool large, const snow_options *options, snow_grid **grid)
{
    return create_aggregate(14, large, options, grid);
}

static snow_status aggregate_line(bool large, const snow_options *options, snow_grid **grid)
{
    return create_aggregate(8, large, options, grid);
}

static snow_status aggregate_shore(bool large, const snow_options *options, snow_grid **grid)
{
    return create_aggregate(12, large, options, grid);
}

static snow_status aggregate_clusters(bool large, const snow_options *options, snow_grid **grid)
{
    return create_aggregate(15, large, options, grid);
}

static snow_status aggregate_discs(bool large, const snow_options *options, snow_grid **grid)
{
    return create_aggregate(16, large, options, grid);
}

const test_life test_lives[] = {
    {"aggregate, jumps", aggregate_jumps},
    {"aggregate, steps", aggregate_steps},
    {"aggregate, laboratory", aggregate_laboratory},
    {"aggregate, space", aggregate_space},
    {"aggregate, line", aggregate_line},
    {"aggregate, electrolysis", aggregate_electrolysis},
    {"aggregate, chimney", aggregate_chimney},
    {"aggregate, snowflake", aggregate_snowflake},
    {"aggregate, shore", aggregate_shore},
    {"aggregate, clusters", aggregate_clusters},
    {"aggregate, discs", aggregate_discs},
    {"reiter, rows", reiter_rows},
    {"reiter, single precision", reiter_single},
    {"reiter, uneven additions", reiter_uneven},
    {"reiter, reference", reiter_reference},
    {"reiter, quad", reiter_quad},
    {"packard, tiles", packard_tiles},
    {"packard, quadtree", packard_quadtree},
    {"packard, reference", packard_reference},
    {"packard, torus", packard_torus},
};
const size_t test_life_count = COUNT_OF(test_lives);

snow_grid *start_life(const test_life *life, bool large, const snow_options *options)
{
    snow_grid *grid = NULL;
    assert_ok(life->create(large, options, &grid));
    assert_non_null(grid);
    return grid;
}

/* --- calls that change the grid --- */

static snow_status step(snow_grid *grid, test_answer *answer)
{
    (void)answer;
    return snow_step(grid, 70);
}

static snow_status run(snow_grid *grid, test_answer *answer)
{
    snow_stop stop = stop_after(50);
    (void)answer;
    return snow_run(grid, &stop, NULL);
}

static snow_status set_field(snow_grid *grid, snow_field field, double value)
{
    return snow_field_set(grid, field, &(snow_rect){3, 1, 2, 1}, (const double[]){value, value}, 2);
}

static snow_status set_value(snow_grid *grid, test_answer *answer)
{
    (void)answer;
    return set_field(grid, SNOW_FIELD_VALUE, 1);
}

static snow_status set_frozen(snow_grid *grid, test_answer *answer)
{
    (void)answer;
    return set_field(grid, SNOW_FIELD_FROZEN, 1);
}

static snow_status set_vapour(snow_grid *grid, test_answer *answer)
{
    (void)answer;
    return set_field(grid, SNOW_FIELD_VAPOUR, 0.25);
}

static snow_status set_addition(snow_grid *grid, test_answer *answer)
{
    (void)answer;
    return set_field(grid, SNOW_FIELD_ADDITION, 0.25);
}

static snow_status set_background(snow_grid *grid, test_answer *answer)
{
    (void)answer;
    return set_field(grid, SNOW_FIELD_BACKGROUND, 0.25);
}

static snow_status reiter_change(snow_grid *grid, test_answer *answer)
{
    (void)answer;
    snow_reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    conditions.background = 0.3;
    conditions.addition = 0.02;
    return snow_reiter_change(grid, &conditions);
}

static snow_status add_sectors(snow_grid *grid, test_answer *answer)
{
    (void)answer;
    snow_packard_zone zone = packard_zone_of(SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_SIDES, 2, 60);
    return snow_packard_add_zone(grid, &zone);
}

static snow_status add_mask(snow_grid *grid, test_answer *answer)
{
    static const uint8_t mask[12] = {1, 0, 1, 1, 0, 1};
    (void)answer;
    snow_packard_zone zone = packard_zone_of(SNOW_PACKARD_PRIORITY, SNOW_PACKARD_CELLS, 2, 60);
    zone.rect = (snow_rect){1, 1, 4, 3};
    zone.mask = mask;
    return snow_packard_add_zone(grid, &zone);
}

/* --- calls that tell what is kept: none may need memory --- */

static snow_status steps(snow_grid *grid, test_answer *answer)
{
    return snow_steps(grid, (int64_t *)(void *)answer);
}

static snow_status frozen(snow_grid *grid, test_answer *answer)
{
    return snow_frozen(grid, (uint64_t *)(void *)answer);
}

static snow_status tip_radius(snow_grid *grid, test_answer *answer)
{
    return snow_tip_radius(grid, (double *)(void *)answer);
}

static snow_status frozen_bounds(snow_grid *grid, test_answer *answer)
{
    return snow_frozen_bounds(grid, (snow_rect *)(void *)answer);
}

static snow_status domain_bounds(snow_grid *grid, test_answer *answer)
{
    return snow_domain_bounds(grid, (snow_rect *)(void *)answer);
}

static snow_status domain_cells(snow_grid *grid, test_answer *answer)
{
    return snow_domain_cells(grid, (uint64_t *)(void *)answer);
}

static snow_status model_of(snow_grid *grid, test_answer *answer)
{
    return snow_model_of(grid, (snow_model *)(void *)answer);
}

static snow_status isa_of(snow_grid *grid, test_answer *answer)
{
    return snow_isa_of(grid, (snow_isa *)(void *)answer);
}

static snow_status packard_rule(snow_grid *grid, test_answer *answer)
{
    return snow_packard_rule_of(grid, (uint32_t *)(void *)answer);
}

static snow_status packard_engine(snow_grid *grid, test_answer *answer)
{
    return snow_packard_engine_of(grid, (snow_packard_engine *)(void *)answer);
}

static snow_status params_of(snow_grid *grid, test_answer *answer)
{
    snow_aggregate_params params;
    snow_aggregate_params_init(&params, sizeof params);
    snow_status status = snow_aggregate_params_of(grid, &params);
    const double some[] = {params.scene, params.sticking, params.width, params.depth, (double)params.particles};
    if (status == SNOW_OK)
        memcpy(answer, some, sizeof some);
    return status;
}

static snow_status particles(snow_grid *grid, test_answer *answer)
{
    return snow_aggregate_particles(grid, (uint64_t *)(void *)answer);
}

static snow_status walkers(snow_grid *grid, test_answer *answer)
{
    return snow_aggregate_walkers(grid, (uint64_t *)(void *)answer);
}

static snow_status sites(snow_grid *grid, test_answer *answer)
{
    return snow_aggregate_sites(grid, 0, (snow_site *)(void *)answer, 1);
}

static snow_status points(snow_grid *grid, test_answer *answer)
{
    return snow_aggregate_points(grid, 0, (snow_point *)(void *)answer, 1);
}

/* --- calls that ask --- */

static snow_status field_copy(snow_grid *grid, test_answer *answer)
{
    return snow_field_copy(grid, SNOW_FIELD_VALUE, &(snow_rect){-5, -5, 11, 11}, (double *)(void *)answer, 121, NULL);
}

static snow_status cell_value(snow_grid *grid, test_answer *answer)
{
    return snow_cell_value(grid, SNOW_FIELD_FROZEN, 1, 0, (double *)(void *)answer);
}

static snow_status mass(snow_grid *grid, test_answer *answer)
{
    return snow_mass(grid, (double *)(void *)answer, (double *)(void *)answer + 1);
}

static snow_status symmetry_defect(snow_grid *grid, test_answer *answer)
{
    return snow_symmetry_defect(grid, (double *)(void *)answer);
}

static snow_status digest(snow_grid *grid, test_answer *answer)
{
    return snow_digest(grid, (uint64_t *)(void *)answer);
}

static snow_status frozen_hexagon(snow_grid *grid, test_answer *answer)
{
    return snow_frozen_hexagon(grid, (snow_hexagon *)(void *)answer);
}

static snow_status mass_radius(snow_grid *grid, test_answer *answer)
{
    return snow_mass_radius(grid, (const double[]){0, 1, 4}, 3, (uint64_t *)(void *)answer);
}

static snow_status box_count(snow_grid *grid, test_answer *answer)
{
    return snow_box_count(grid, 2, (uint64_t *)(void *)answer);
}

static snow_status density(snow_grid *grid, test_answer *answer)
{
    return snow_density(grid, (double *)(void *)answer);
}

static snow_status save(snow_grid *grid, test_answer *answer)
{
    size_t size = 0;
    snow_status status = snow_save(grid, NULL, 0, &size);
    if (status != SNOW_OK || size > sizeof answer->bytes)
        return status;
    return snow_save(grid, answer, sizeof answer->bytes, &size);
}

/* What has been written, in a row. */
typedef struct written {
    test_answer bytes;
    size_t size;
} written;

static int write_behind(void *context, const void *bytes, size_t size)
{
    written *so_far = context;
    if (size <= sizeof so_far->bytes - so_far->size) {
        memcpy(so_far->bytes.bytes + so_far->size, bytes, size);
        so_far->size += size;
    }
    return 0;
}

/* A writer's caller has what came before a failure; the answer is what came to the end. */
static snow_status save_by(snow_status (*call)(const snow_grid *grid, snow_writer write, void *context),
                           const snow_grid *grid, test_answer *answer)
{
    static written so_far;
    so_far.size = 0;
    snow_status status = call(grid, write_behind, &so_far);
    if (status == SNOW_OK)
        memcpy(answer, &so_far.bytes, so_far.size);
    return status;
}

static snow_status save_to(snow_grid *grid, test_answer *answer)
{
    return save_by(snow_save_to, grid, answer);
}

static snow_status save_rle_to(snow_grid *grid, test_answer *answer)
{
    return save_by(snow_packard_save_rle_to, grid, answer);
}

static snow_status dimension(snow_grid *grid, test_answer *answer)
{
    return snow_dimension(grid, (double *)(void *)answer);
}

static snow_status render(snow_grid *grid, test_answer *answer)
{
    snow_view view;
    snow_view_init(&view, sizeof view);
    snow_status status = snow_view_fit(grid, 40, &view);
    return status != SNOW_OK ? status : snow_render(grid, &view, answer, sizeof answer->bytes, NULL);
}

static snow_status save_rle(snow_grid *grid, test_answer *answer)
{
    size_t size;
    return snow_packard_save_rle(grid, answer, sizeof answer->bytes, &size);
}

static snow_status copy_bits(snow_grid *grid, test_answer *answer)
{
    return snow_packard_copy_bits(grid, -20, -20, 70, 40, (uint64_t *)(void *)answer, 80);
}

static snow_status population(snow_grid *grid, test_answer *answer)
{
    return snow_packard_population(grid, (uint64_t *)(void *)answer, (uint64_t *)(void *)answer + 1);
}

static snow_status conditions_of(snow_grid *grid, test_answer *answer)
{
    snow_reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    snow_status status = snow_reiter_conditions_of(grid, &conditions);
    if (status == SNOW_OK)
        memcpy(answer, &conditions, sizeof conditions);
    return status;
}

static snow_status aggregate_gyration(snow_grid *grid, test_answer *answer)
{
    return snow_aggregate_gyration(grid, (const uint64_t[]){1, 2, 3}, (double *)(void *)answer, 3);
}

static snow_status aggregate_mass(snow_grid *grid, test_answer *answer)
{
    return snow_aggregate_mass(grid, (const double[]){0, 1, 4}, (uint64_t *)(void *)answer, 3);
}

static snow_status aggregate_profile(snow_grid *grid, test_answer *answer)
{
    size_t count;
    return snow_aggregate_profile(grid, (int32_t *)(void *)answer, 4096, &count);
}

static snow_status aggregate_clusters_of(snow_grid *grid, test_answer *answer)
{
    size_t count;
    return snow_aggregate_clusters(grid, (snow_aggregate_cluster *)(void *)answer, 1024, &count);
}

static snow_status aggregate_parents(snow_grid *grid, test_answer *answer)
{
    size_t count;
    return snow_aggregate_parents(grid, (int64_t *)(void *)answer, 4096, &count);
}

static snow_status aggregate_order_at(snow_grid *grid, test_answer *answer)
{
    return snow_aggregate_order_at(grid, (snow_site){0, 0, 0}, (int64_t *)(void *)answer);
}

static snow_status aggregate_obstacles(snow_grid *grid, test_answer *answer)
{
    size_t count;
    return snow_aggregate_obstacles(grid, (snow_site *)(void *)answer, 1024, &count);
}

static snow_status aggregate_bounds(snow_grid *grid, test_answer *answer)
{
    snow_point *corners = (snow_point *)(void *)answer;
    return snow_aggregate_bounds(grid, &corners[0], &corners[1]);
}

enum { MOST_CHANCES = 1024 };

/* Without what stands between the members. */
static snow_status put_chances(snow_status status, const snow_aggregate_chance *chances, size_t count,
                               test_answer *answer)
{
    double *numbers = (double *)(void *)answer;
    for (size_t i = 0; status == SNOW_OK && i < count; i++) {
        const double row[] = {chances[i].site.x, chances[i].site.y, chances[i].probability, chances[i].error};
        memcpy(numbers + COUNT_OF(row) * i, row, sizeof row);
    }
    return status;
}

static snow_status aggregate_growth(snow_grid *grid, test_answer *answer)
{
    static snow_aggregate_chance chances[MOST_CHANCES];
    size_t count = 0;
    snow_status status = snow_aggregate_growth(grid, chances, MOST_CHANCES, &count);
    return put_chances(status, chances, count, answer);
}

static snow_status aggregate_sample(snow_grid *grid, test_answer *answer)
{
    static snow_aggregate_chance chances[MOST_CHANCES];
    size_t count = 0;
    snow_status status = snow_aggregate_sample(grid, 20, 1, chances, MOST_CHANCES, &count);
    return put_chances(status, chances, count, answer);
}

const test_act test_acts[] = {
    {"step", step, true},
    {"run", run, true},
    {"set value", set_value, false},
    {"set frozen", set_frozen, false},
    {"set vapour", set_vapour, false},
    {"set addition", set_addition, false},
    {"set background", set_background, false},
    {"reiter_change", reiter_change, false},
    {"packard_add_zone, sectors", add_sectors, false},
    {"packard_add_zone, mask", add_mask, false},
    {"steps", steps, false},
    {"frozen", frozen, false},
    {"tip_radius", tip_radius, false},
    {"frozen_bounds", frozen_bounds, false},
    {"domain_bounds", domain_bounds, false},
    {"domain_cells", domain_cells, false},
    {"model_of", model_of, false},
    {"isa_of", isa_of, false},
    {"packard_rule_of", packard_rule, false},
    {"packard_engine_of", packard_engine, false},
    {"aggregate_params_of", params_of, false},
    {"aggregate_particles", particles, false},
    {"aggregate_walkers", walkers, false},
    {"aggregate_sites", sites, false},
    {"aggregate_points", points, false},
    {"field_copy", field_copy, false},
    {"cell_value", cell_value, false},
    {"mass", mass, false},
    {"symmetry_defect", symmetry_defect, false},
    {"digest", digest, false},
    {"frozen_hexagon", frozen_hexagon, false},
    {"mass_radius", mass_radius, false},
    {"box_count", box_count, false},
    {"density", density, false},
    {"dimension", dimension, false},
    {"save", save, false},
    {"save_to", save_to, false},
    {"render", render, false},
    {"packard_save_rle", save_rle, false},
    {"packard_save_rle_to", save_rle_to, false},
    {"packard_copy_bits", copy_bits, false},
    {"packard_population", population, false},
    {"reiter_conditions_of", conditions_of, false},
    {"aggregate_gyration", aggregate_gyration, false},
    {"aggregate_mass", aggregate_mass, false},
    {"aggregate_profile", aggregate_profile, false},
    {"aggregate_clusters", aggregate_clusters_of, false},
    {"aggregate_parents", aggregate_parents, false},
    {"aggregate_order_at", aggregate_order_at, false},
    {"aggregate_obstacles", aggregate_obstacles, false},
    {"aggregate_bounds", aggregate_bounds, false},
    {"aggregate_growth", aggregate_growth, false},
    {"aggregate_sample", aggregate_sample, false},
};
const size_t test_act_count = COUNT_OF(test_acts);

/* --- saved --- */

saved_life save_life(const snow_grid *grid)
{
    saved_life saved = {NULL, 0, 0};
    assert_ok(snow_save(grid, NULL, 0, &saved.size));
    saved.bytes = malloc(saved.size);
    assert_non_null(saved.bytes);
    assert_ok(snow_save(grid, saved.bytes, saved.size, &saved.size));
    return saved;
}

void assert_same_lives(const saved_life *expected, const saved_life *got, const char *name)
{
    if (expected->size == got->size && memcmp(expected->bytes, got->bytes, got->size) == 0)
        return;
    print_error("%s: the grids are not the same\n", name);
    fail();
}

void free_life(saved_life *saved)
{
    free(saved->bytes);
    *saved = (saved_life){NULL, 0, 0};
}
