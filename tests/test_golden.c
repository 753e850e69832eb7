/* The shared scenes, to their end: step count, ice and digest are known. */
#include "support/grids.h"
#include "support/scenes.h"

static void assert_known_end(const snow_scene *scene, const snow_grid *grid)
{
    bool known = scene->steps == steps_of(grid) && scene->frozen == frozen_of(grid) &&
                 scene->digest == digest_of(grid);
    if (!known)
        print_error("%s: steps %lld, frozen %llu, digest %016llx\n", scene->name, (long long)steps_of(grid),
                    (unsigned long long)frozen_of(grid), (unsigned long long)digest_of(grid));
    assert_int_equal(scene->steps, steps_of(grid));
    assert_int_equal(scene->frozen, frozen_of(grid));
    assert_true(scene->digest == digest_of(grid));
}

static void every_scene_that_is_not_slow(void **state)
{
    (void)state;
    snow_isa isas[8];
    size_t isa_count = available_isas(isas);
    snow_scene scene;
    for (size_t i = 0; scene_get(i, &scene); i++) {
        if (scene.slow)
            continue;
        snow_options options = default_options();
        options.isa = isas[i % isa_count];
        snow_grid *grid = make_grid(&scene.params, &options);
        run_grid(grid, &scene.stop);
        assert_known_end(&scene, grid);
        snow_destroy(grid);
    }
}

/* The same ends by the plain reading, where it is fast enough. */
static void some_scenes_by_the_reference(void **state)
{
    (void)state;
    static const char *const names[] = {"sector", "alpha-2.6", "near-tie", "per-cell"};
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        snow_scene scene;
        assert_true(scene_find(names[i], &scene));
        scene.params.engine = SNOW_REITER_ENGINE_REFERENCE;
        snow_grid *grid = make_grid(&scene.params, NULL);
        run_grid(grid, &scene.stop);
        assert_known_end(&scene, grid);
        snow_destroy(grid);
    }
}

static void the_small_dendrite_on_its_way(void **state)
{
    (void)state;
    static const struct {
        int64_t steps;
        uint64_t frozen;
    } stations[] = {{500, 697}, {1000, 2197}, {2010, 7957}, {2011, 7975}};
    snow_reiter_params params = disc_scene(0.4, 0.001, 1, 100);
    snow_grid *grid = make_grid(&params, NULL);
    for (size_t i = 0; i < COUNT_OF(stations); i++) {
        assert_ok(snow_step(grid, stations[i].steps - steps_of(grid)));
        assert_int_equal(stations[i].frozen, frozen_of(grid));
        assert_int_equal(1, frozen_of(grid) % 6);
        assert_same_double(0.0, defect_of(grid));
    }
    assert_int_equal(SNOW_STOP_RIM, run_grid(grid, NULL).reason);
    assert_int_equal(2011, steps_of(grid));
    assert_same_double(98, tip_of(grid));
    snow_destroy(grid);
}

static void the_thin_dendrite_ends_two_cells_from_the_rim(void **state)
{
    (void)state;
    snow_reiter_params params = disc_scene(0.4, 0.0001, 1, 200);
    snow_options options = default_options();
    options.threads = 2;
    snow_grid *grid = make_grid(&params, &options);
    snow_summary summary = run_grid(grid, NULL);
    assert_int_equal(SNOW_STOP_RIM, summary.reason);
    assert_int_equal(4304, summary.steps);
    assert_int_equal(18607, summary.frozen);
    assert_same_double(198, summary.tip_radius);
    assert_same_double(0.0, defect_of(grid));
    snow_destroy(grid);
}

/* Bounds of the table itself. */
static void scenes_are_found_by_index_and_name(void **state)
{
    (void)state;
    snow_scene scene = {.name = "untouched"};
    assert_false(scene_get(scene_count(), &scene));
    assert_false(scene_find("no such scene", &scene));
    assert_string_equal("untouched", scene.name);
    for (size_t i = 0; i < scene_count(); i++) {
        snow_scene by_index, by_name;
        assert_true(scene_get(i, &by_index));
        assert_true(scene_find(by_index.name, &by_name));
        assert_ptr_equal(by_index.name, by_name.name);
        assert_true(by_index.steps > 0);
        assert_true(by_index.digest != 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_are_found_by_index_and_name),
        cmocka_unit_test(every_scene_that_is_not_slow),
        cmocka_unit_test(some_scenes_by_the_reference),
        cmocka_unit_test(the_small_dendrite_on_its_way),
        cmocka_unit_test(the_thin_dendrite_ends_two_cells_from_the_rim),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
