/* A scene that is computed by its symmetry has the same bits as one of which every cell is computed. */
#include "support/grids.h"

#include <stdlib.h>

/* The twelve symmetries of the hexagon: six turns, and each after the mirror q ↔ r. */
static snow_cell image_of(int symmetry, snow_cell cell)
{
    if (symmetry >= 6)
        cell = (snow_cell){cell.r, cell.q};
    for (int turn = 0; turn < symmetry % 6; turn++)
        cell = (snow_cell){-cell.r, cell.q + cell.r};
    return cell;
}

/* A set of symmetries is a bit for each. */
static int composed(int second, int first)
{
    snow_cell generic = {5, 2};
    snow_cell image = image_of(second, image_of(first, generic));
    for (int symmetry = 0; symmetry < 12; symmetry++) {
        snow_cell candidate = image_of(symmetry, generic);
        if (candidate.q == image.q && candidate.r == image.r)
            return symmetry;
    }
    return -1;
}

static unsigned generated_by(int a, int b)
{
    unsigned group = 1u | 1u << a | 1u << b;
    for (unsigned before = 0; before != group;) {
        before = group;
        for (int x = 0; x < 12; x++)
            for (int y = 0; y < 12; y++)
                if ((before >> x & 1) != 0 && (before >> y & 1) != 0)
                    group |= 1u << composed(x, y);
    }
    return group;
}

enum { SUBGROUPS = 16 };

/* Two elements generate any subgroup: one, six mirrors, C2, C3, C6, three D2, two D3, D6. */
static size_t find_subgroups(unsigned groups[SUBGROUPS])
{
    size_t count = 0;
    for (int a = 0; a < 12; a++) {
        for (int b = 0; b < 12; b++) {
            unsigned group = generated_by(a, b);
            size_t known = 0;
            while (known < count && groups[known] != group)
                known++;
            if (known == count) {
                assert_true(count < SUBGROUPS);
                groups[count++] = group;
            }
        }
    }
    return count;
}

/* The images of two cells, and the origin. */
static size_t seeds_of(unsigned group, snow_cell seeds[25])
{
    static const snow_cell generic[] = {{4, 1}, {1, 2}};
    size_t count = 0;
    seeds[count++] = (snow_cell){0, 0};
    for (size_t i = 0; i < COUNT_OF(generic); i++)
        for (int symmetry = 0; symmetry < 12; symmetry++)
            if ((group >> symmetry & 1) != 0)
                seeds[count++] = image_of(symmetry, generic[i]);
    return count;
}

static uint64_t memory_of(const snow_grid *grid)
{
    uint64_t bytes = 0;
    assert_ok(snow_memory(grid, &bytes));
    return bytes;
}

typedef struct pair {
    snow_grid *whole;
    snow_grid *folded;
} pair;

static pair make_pair(const snow_reiter_params *scene, const snow_options *options)
{
    snow_reiter_params params = *scene;
    params.symmetry = SNOW_REITER_SYMMETRY_NONE;
    pair grids = {.whole = make_grid(&params, NULL)};
    params.symmetry = SNOW_REITER_SYMMETRY_AUTO;
    grids.folded = make_grid(&params, options);
    return grids;
}

static void step_pair(const pair *grids, int64_t steps)
{
    snow_status expected = snow_step(grids->whole, steps);
    assert_status(expected, snow_step(grids->folded, steps));
    assert_same_grids(grids->whole, grids->folded);
}

static void destroy_pair(const pair *grids)
{
    snow_destroy(grids->whole);
    snow_destroy(grids->folded);
}

static void assert_same_growth(const snow_reiter_params *scene, const snow_options *options)
{
    static const int64_t strides[] = {0, 1, 2, 7, 40, 60};
    pair grids = make_pair(scene, options);
    for (size_t i = 0; i < COUNT_OF(strides); i++)
        step_pair(&grids, strides[i]);
    destroy_pair(&grids);
}

static snow_options some_options(size_t index)
{
    snow_isa isas[8];
    size_t count = available_isas(isas);
    snow_options options = default_options();
    options.isa = isas[index % count];
    options.threads = (int32_t)(index / count % 3) + 1;
    return options;
}

static void every_subgroup_in_every_domain(void **state)
{
    (void)state;
    unsigned groups[SUBGROUPS];
    assert_int_equal(SUBGROUPS, find_subgroups(groups));
    size_t turn = 0;
    for (size_t i = 0; i < SUBGROUPS; i++) {
        snow_cell seeds[25];
        size_t count = seeds_of(groups[i], seeds);
        snow_reiter_params scenes[] = {
            disc_scene(0.4, 0.01, 1, 17),          hexagon_scene(0.5, 0.02, 0.7, 13),
            rectangle_scene(0.4, 0.02, 1, 25, 21), rectangle_scene(0.4, 0.02, 1, 26, 21),
            rectangle_scene(0.4, 0.02, 1, 25, 22),
        };
        for (size_t k = 0; k < COUNT_OF(scenes); k++) {
            scenes[k].seeds = seeds;
            scenes[k].seed_count = count;
            scenes[k].record_freeze_steps = (int32_t)(turn % 2);
            snow_options options = some_options(turn++);
            assert_same_growth(&scenes[k], &options);
        }
    }
}

/* Half of the seeds would do where the group is larger than theirs; one more seed takes symmetries away. */
static void one_seed_too_many_is_seen(void **state)
{
    (void)state;
    unsigned groups[SUBGROUPS];
    find_subgroups(groups);
    uint64_t random = 3;
    for (size_t i = 0; i < SUBGROUPS; i++) {
        snow_cell seeds[26];
        size_t count = seeds_of(groups[i], seeds);
        seeds[count++] = (snow_cell){(int32_t)next_below(&random, 15) - 7, (int32_t)next_below(&random, 5) - 2};
        snow_reiter_params params = disc_scene(0.4, 0.01, 1, 15);
        params.seeds = seeds;
        params.seed_count = count;
        snow_options options = some_options(i);
        assert_same_growth(&params, &options);
    }
}

static void every_small_domain(void **state)
{
    (void)state;
    for (int32_t radius = 1; radius <= 14; radius++) {
        snow_reiter_params disc = disc_scene(0.4, 0.05, 1, radius);
        snow_reiter_params hexagon = hexagon_scene(0.4, 0.05, 2.3, radius);
        snow_options options = some_options((size_t)radius);
        assert_same_growth(&disc, &options);
        assert_same_growth(&hexagon, &options);
    }
    for (int32_t width = 1; width <= 9; width++) {
        for (int32_t height = 1; height <= 9; height++) {
            snow_reiter_params params = rectangle_scene(0.4, 0.05, 1, width, height);
            snow_options options = some_options((size_t)(width + height));
            assert_same_growth(&params, &options);
        }
    }
}

static void symmetric_noise_and_clusters(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 12; seed++) {
        snow_reiter_params noise = seed % 2 == 0 ? disc_scene(0.4, 0.01, 1, 16) : hexagon_scene(0.4, 0.01, 2.5, 14);
        noise.noise = 0.3;
        noise.noise_symmetric = 1;
        noise.random_seed = seed;
        snow_options options = some_options((size_t)seed);
        assert_same_growth(&noise, &options);

        snow_reiter_params cluster = disc_scene(0.4, 0.01, 1, 16);
        cluster.cluster = (int32_t)(seed % 4) + 1;
        cluster.random_seed = seed;
        assert_same_growth(&cluster, &options);
    }
}

static void folding_saves_memory(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.01, 1, 150);
    pair grids = make_pair(&params, NULL);
    assert_true(memory_of(grids.folded) < memory_of(grids.whole) / 6);
    destroy_pair(&grids);
    params.noise = 0.1;
    grids = make_pair(&params, NULL);
    assert_true(memory_of(grids.folded) > memory_of(grids.whole) / 2);
    destroy_pair(&grids);
}

static void runs_end_at_the_same_step(void **state)
{
    (void)state;
    snow_reiter_params scenes[] = {
        disc_scene(0.4, 0.005, 1, 30), hexagon_scene(0.7, 0.03, 1, 25), disc_scene(0.4, 0.01, 2.6, 25),
        disc_scene(0, 0.1, 1, 20),     disc_scene(0, 0, 1, 20),         rectangle_scene(0.4, 0.02, 1, 41, 41),
        rectangle_scene(0.4, 0.02, 1, 60, 71),
    };
    scenes[6].rim = SNOW_REITER_RIM_ROW;
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        pair grids = make_pair(&scenes[i], NULL);
        snow_summary expected = run_grid(grids.whole, NULL);
        snow_summary got = run_grid(grids.folded, NULL);
        assert_int_equal(expected.reason, got.reason);
        assert_same_grids(grids.whole, grids.folded);
        double vapour[2], ice[2];
        assert_ok(snow_mass(grids.whole, &vapour[0], &ice[0]));
        assert_ok(snow_mass(grids.folded, &vapour[1], &ice[1]));
        assert_same_double(vapour[0], vapour[1]);
        assert_same_double(ice[0], ice[1]);
        assert_same_double(defect_of(grids.whole), defect_of(grids.folded));
        destroy_pair(&grids);
    }
}

/* A pocket of vapour that starves inside a thick ring of ice. */
static void starve_inside(int32_t inner_radius)
{
    snow_cell ring[217];
    size_t count = 0;
    for (int32_t q = -8; q <= 8; q++)
        for (int32_t r = -8; r <= 8; r++)
            if (abs(q + r) <= 8 && (abs(q) + abs(r) + abs(q + r)) / 2 >= inner_radius)
                ring[count++] = (snow_cell){q, r};
    snow_reiter_params params = hexagon_scene(0.4, 0, 1, 9);
    params.seeds = ring;
    params.seed_count = count;
    pair grids = make_pair(&params, NULL);
    params.engine = SNOW_REITER_ENGINE_REFERENCE;
    snow_grid *reference = make_grid(&params, NULL);
    snow_stop stop = default_stop();
    stop.rim = 0;
    snow_summary expected = run_grid(reference, &stop);
    assert_int_equal(SNOW_STOP_STILL, expected.reason);
    assert_int_equal(SNOW_STOP_STILL, run_grid(grids.whole, &stop).reason);
    assert_int_equal(SNOW_STOP_STILL, run_grid(grids.folded, &stop).reason);
    assert_same_grids(reference, grids.whole);
    assert_same_grids(reference, grids.folded);
    snow_destroy(reference);
    destroy_pair(&grids);
}

/* In the larger ones a gradient of a few quanta stands for ever. */
static void all_agree_on_standing_still(void **state)
{
    (void)state;
    for (int32_t inner_radius = 2; inner_radius <= 7; inner_radius++)
        starve_inside(inner_radius);
}

static void change_pair(const pair *grids, double background, double addition, double diffusion, int32_t rescale)
{
    snow_reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    conditions.background = background;
    conditions.addition = addition;
    conditions.diffusion = diffusion;
    conditions.rescale = rescale;
    snow_status expected = snow_reiter_change(grids->whole, &conditions);
    assert_status(expected, snow_reiter_change(grids->folded, &conditions));
    assert_same_grids(grids->whole, grids->folded);
}

static void conditions_change_on_the_way(void **state)
{
    (void)state;
    snow_reiter_params scenes[] = {disc_scene(0.4, 0.02, 1, 17), hexagon_scene(0.4, 0.02, 1, 14),
                                   rectangle_scene(0.4, 0.02, 1, 25, 21)};
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        scenes[i].record_freeze_steps = 1;
        pair grids = make_pair(&scenes[i], NULL);
        step_pair(&grids, 30);
        change_pair(&grids, 0.6, 0.02, 1, 1);
        step_pair(&grids, 10);
        change_pair(&grids, 0.3, 0.01, 1, 0);
        step_pair(&grids, 10);
        change_pair(&grids, 0.3, 0.01, 2.4, 1);
        step_pair(&grids, 10);
        change_pair(&grids, 0.99, 0.01, 2.4, 1);
        step_pair(&grids, 10);
        change_pair(&grids, 0, 0.03, 0.5, 0);
        step_pair(&grids, 40);
        destroy_pair(&grids);
    }
}

static void set_pair(const pair *grids, snow_field field, int32_t q, int32_t r, double value)
{
    set_cell(grids->whole, field, q, r, value);
    set_cell(grids->folded, field, q, r, value);
    assert_same_grids(grids->whole, grids->folded);
}

static void setting_a_field_unfolds(void **state)
{
    (void)state;
    static const struct {
        snow_field field;
        snow_cell at;
        double value;
    } sets[] = {
        {SNOW_FIELD_VALUE, {6, 1}, 1.5},          {SNOW_FIELD_VALUE, {0, 0}, 0.5},
        {SNOW_FIELD_VAPOUR, {-9, 3}, 0.125},      {SNOW_FIELD_ADDITION, {-2, 0}, 0.25},
        {SNOW_FIELD_BACKGROUND, {17, 0}, 0.75},
    };
    for (size_t i = 0; i < COUNT_OF(sets); i++) {
        snow_reiter_params params = disc_scene(0.4, 0.02, 1, 17);
        params.record_freeze_steps = 1;
        snow_options options = some_options(i);
        pair grids = make_pair(&params, &options);
        step_pair(&grids, 35);
        set_pair(&grids, sets[i].field, sets[i].at.q, sets[i].at.r, sets[i].value);
        step_pair(&grids, 1);
        step_pair(&grids, 30);
        set_pair(&grids, SNOW_FIELD_VALUE, 3, 4, 1);
        change_pair(&grids, 0.5, 0.03, 1.5, 1);
        step_pair(&grids, 30);
        destroy_pair(&grids);
    }
}

static void a_set_that_is_refused_keeps_the_fold(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.02, 1, 40);
    pair grids = make_pair(&params, NULL);
    step_pair(&grids, 10);
    uint64_t before = memory_of(grids.folded);
    double bad = -1;
    snow_rect rect = {3, 3, 1, 1};
    assert_status(SNOW_ERROR_REITER_VAPOUR, snow_field_set(grids.folded, SNOW_FIELD_VALUE, &rect, &bad, 1));
    assert_true(memory_of(grids.folded) <= before);
    step_pair(&grids, 10);
    destroy_pair(&grids);
}

static snow_grid *reloaded(const snow_grid *grid)
{
    size_t size = 0;
    assert_ok(snow_save(grid, NULL, 0, &size));
    unsigned char *bytes = malloc(size);
    assert_non_null(bytes);
    assert_ok(snow_save(grid, bytes, size, &size));
    snow_grid *loaded = NULL;
    assert_ok(snow_load(bytes, size, NULL, &loaded));
    free(bytes);
    return loaded;
}

static void folded_grids_are_saved_and_loaded(void **state)
{
    (void)state;
    unsigned groups[SUBGROUPS];
    find_subgroups(groups);
    for (size_t i = 0; i < SUBGROUPS; i++) {
        snow_cell seeds[25];
        snow_reiter_params params = i % 2 == 0 ? disc_scene(0.4, 0.01, 1, 14) : hexagon_scene(0.4, 0.01, 1, 12);
        params.seeds = seeds;
        params.seed_count = seeds_of(groups[i], seeds);
        params.record_freeze_steps = 1;
        pair grids = make_pair(&params, NULL);
        step_pair(&grids, 20);
        uint64_t before = memory_of(grids.folded);
        snow_grid *loaded = reloaded(grids.folded);
        snow_destroy(grids.folded);
        grids.folded = loaded;
        assert_same_grids(grids.whole, grids.folded);
        assert_near((double)before, (double)memory_of(loaded), (double)before / 10);
        step_pair(&grids, 25);
        set_pair(&grids, SNOW_FIELD_VALUE, -5, 2, 1);
        loaded = reloaded(grids.folded);
        snow_destroy(grids.folded);
        grids.folded = loaded;
        step_pair(&grids, 25);
        destroy_pair(&grids);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_subgroup_in_every_domain),
        cmocka_unit_test(one_seed_too_many_is_seen),
        cmocka_unit_test(every_small_domain),
        cmocka_unit_test(symmetric_noise_and_clusters),
        cmocka_unit_test(folding_saves_memory),
        cmocka_unit_test(runs_end_at_the_same_step),
        cmocka_unit_test(all_agree_on_standing_still),
        cmocka_unit_test(conditions_change_on_the_way),
        cmocka_unit_test(setting_a_field_unfolds),
        cmocka_unit_test(a_set_that_is_refused_keeps_the_fold),
        cmocka_unit_test(folded_grids_are_saved_and_loaded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
