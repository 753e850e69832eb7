/* All engines of Packard's model give the same cells, for every rule, domain, seed and zone. */
#include "support/packard.h"

#include <stdlib.h>

static const snow_packard_engine engines[] = {SNOW_PACKARD_ENGINE_REFERENCE, SNOW_PACKARD_ENGINE_TILES,
                                              SNOW_PACKARD_ENGINE_AUTO, SNOW_PACKARD_ENGINE_QUADTREE};
enum { ENGINES = COUNT_OF(engines) };

/* A grid for each engine; returns how many. The quadtree is left out where it cannot compute the scene. */
static size_t make_grids(snow_packard_params params, const snow_options *options, snow_grid *grids[ENGINES])
{
    size_t count = 0;
    for (size_t i = 0; i < ENGINES; i++) {
        params.engine = engines[i];
        bool quadtree = engines[i] == SNOW_PACKARD_ENGINE_QUADTREE;
        if (quadtree && (params.domain != SNOW_PACKARD_PLANE || params.record_freeze_steps))
            continue;
        grids[count++] = make_packard(&params, options);
    }
    return count;
}

static void step_and_compare(snow_grid **grids, size_t count, int64_t steps)
{
    for (size_t i = 0; i < count; i++)
        assert_ok(snow_step(grids[i], steps));
    for (size_t i = 1; i < count; i++)
        assert_same_crystals(grids[0], grids[i]);
}

static void destroy_grids(snow_grid **grids, size_t count)
{
    for (size_t i = 0; i < count; i++)
        snow_destroy(grids[i]);
}

static void all_rules_agree_on_the_plane(void **state)
{
    (void)state;
    static const snow_cell seeds[] = {{0, 0}, {2, 0}, {-1, 3}, {4, -2}, {4, -3}};
    for (uint32_t rule = 0; rule < 128; rule += 2) {
        snow_packard_params params = packard_scene("0000000");
        params.rule = rule;
        params.seeds = rule % 4 == 0 ? seeds : NULL; /* with d1 = 0 one seed stays alone */
        params.seed_count = params.seeds != NULL ? COUNT_OF(seeds) : 0;
        snow_grid *grids[ENGINES];
        size_t count = make_grids(params, NULL, grids);
        step_and_compare(grids, count, 1);
        step_and_compare(grids, count, 11);
        step_and_compare(grids, count, 37);
        destroy_grids(grids, count);
    }
}

static void all_rules_agree_on_bounded_domains(void **state)
{
    (void)state;
    for (uint32_t rule = 0; rule < 128; rule++) {
        snow_packard_params params = packard_scene("0000000");
        params.rule = rule;
        params.domain = (snow_packard_domain)(SNOW_PACKARD_DISC + (int)(rule * 7 % 5));
        params.radius = 23;
        params.width = 65;
        params.height = 37;
        params.cluster = 5;
        params.random_seed = rule;
        params.record_freeze_steps = rule % 2 == 0;
        snow_grid *grids[ENGINES];
        size_t count = make_grids(params, NULL, grids);
        step_and_compare(grids, count, 2);
        step_and_compare(grids, count, 60);
        destroy_grids(grids, count);
    }
}

static void random_scenes_with_zones_agree(void **state)
{
    (void)state;
    uint64_t random = 2026;
    for (int scene = 0; scene < 150; scene++) {
        snow_cell seeds[8];
        snow_packard_params params = random_packard_scene(&random, seeds);
        params.record_freeze_steps = scene % 3 == 0;
        snow_grid *grids[ENGINES];
        size_t count = make_grids(params, NULL, grids);
        add_random_zones(&random, grids, count);
        for (int part = 0; part < 4; part++)
            step_and_compare(grids, count, 1 + next_below(&random, 15));
        add_random_zones(&random, grids, count); /* also while it grows */
        step_and_compare(grids, count, 20);
        destroy_grids(grids, count);
    }
}

static void steps_add_up(void **state)
{
    (void)state;
    uint64_t random = 7;
    for (int scene = 0; scene < 40; scene++) {
        snow_cell seeds[8];
        snow_packard_params params = random_packard_scene(&random, seeds);
        snow_grid *grids[2 * ENGINES];
        size_t count = make_grids(params, NULL, grids);
        make_grids(params, NULL, grids + count);
        add_random_zones(&random, grids, 2 * count);
        int64_t a = next_below(&random, 40), b = next_below(&random, 40);
        for (size_t i = 0; i < count; i++) {
            assert_ok(snow_step(grids[i], a));
            assert_ok(snow_step(grids[i], b));
            assert_ok(snow_step(grids[count + i], a + b));
            assert_same_crystals(grids[i], grids[count + i]);
        }
        destroy_grids(grids, 2 * count);
    }
}

static void threads_and_instruction_sets_change_nothing(void **state)
{
    (void)state;
    snow_isa isas[8];
    size_t isa_count = available_isas(isas);
    for (int scene = 0; scene < 3; scene++) {
        snow_packard_params params = packard_scene(scene == 0 ? "0100000" : scene == 1 ? "0101010" : "0010110");
        params.engine = SNOW_PACKARD_ENGINE_TILES;
        params.scatter = 60;
        params.scatter_side = 500;
        snow_grid *expected = make_packard(&params, NULL);
        assert_ok(snow_step(expected, 70));
        for (size_t i = 0; i < isa_count; i++) {
            snow_options options = default_options();
            options.isa = isas[i];
            options.threads = 1 + (int32_t)i;
            snow_grid *got = make_packard(&params, &options);
            assert_ok(snow_step(got, 70));
            snow_isa isa = SNOW_ISA_AUTO;
            assert_ok(snow_isa_of(got, &isa));
            assert_int_equal(isas[i], isa);
            assert_true(digest_of(expected) == digest_of(got));
            snow_destroy(got);
        }
        snow_destroy(expected);
    }
}

static void one_seed_gives_exact_sixfold_symmetry(void **state)
{
    (void)state;
    for (uint32_t rule = 2; rule < 128; rule += 4) {
        snow_packard_params params = packard_scene("0000000");
        params.rule = rule;
        snow_grid *grid = make_packard(&params, NULL);
        assert_ok(snow_step(grid, 50));
        assert_same_double(0, defect_of(grid));
        snow_destroy(grid);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_rules_agree_on_the_plane),
        cmocka_unit_test(all_rules_agree_on_bounded_domains),
        cmocka_unit_test(random_scenes_with_zones_agree),
        cmocka_unit_test(steps_add_up),
        cmocka_unit_test(threads_and_instruction_sets_change_nothing),
        cmocka_unit_test(one_seed_gives_exact_sixfold_symmetry),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
