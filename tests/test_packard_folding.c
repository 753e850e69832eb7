/* Crystals with all symmetries of the hexagon are computed by one twelfth, wherever they stand: nobody may see it. */
#include "support/packard.h"

#include <stdlib.h>

static const snow_cell centres[] = {{0, 0}, {1, 0}, {-37, 90}, {63, -64}};

/* A ring of six and its centre. */
enum { RING = 7 };

static void make_ring(snow_cell centre, snow_cell seeds[RING])
{
    static const snow_cell ring[RING] = {{0, 0}, {3, 0}, {0, 3}, {-3, 3}, {-3, 0}, {0, -3}, {3, -3}};
    for (int i = 0; i < RING; i++)
        seeds[i] = (snow_cell){centre.q + ring[i].q, centre.r + ring[i].r};
}

/* By the reference, which folds nothing, and by tiles. */
typedef struct couple {
    snow_grid *expected, *got;
} couple;

static couple make_couple(snow_packard_params params)
{
    couple both;
    params.engine = SNOW_PACKARD_ENGINE_REFERENCE;
    both.expected = make_packard(&params, NULL);
    params.engine = SNOW_PACKARD_ENGINE_TILES;
    both.got = make_packard(&params, NULL);
    return both;
}

static couple make_ring_couple(const char *rule, snow_cell centre, bool dated)
{
    snow_cell seeds[RING];
    make_ring(centre, seeds);
    snow_packard_params params = packard_scene(rule);
    params.seeds = seeds;
    params.seed_count = RING;
    params.record_freeze_steps = dated;
    return make_couple(params);
}

static void step_couple(const couple *both, int64_t steps)
{
    assert_ok(snow_step(both->expected, steps));
    assert_ok(snow_step(both->got, steps));
    assert_same_crystals(both->expected, both->got);
}

static void end_couple(const couple *both)
{
    snow_destroy(both->expected);
    snow_destroy(both->got);
}

static uint64_t memory_of(const snow_grid *grid)
{
    uint64_t bytes = 0;
    assert_ok(snow_memory(grid, &bytes));
    return bytes;
}

static void one_seed_grows_the_same_anywhere(void **state)
{
    (void)state;
    static const char *const rules[] = {"0100000", "0101010"};
    for (size_t rule = 0; rule < COUNT_OF(rules); rule++) {
        uint64_t memory = 0;
        for (size_t i = 0; i < COUNT_OF(centres); i++) {
            snow_packard_params params = packard_scene(rules[rule]);
            params.seeds = &centres[i];
            params.seed_count = 1;
            couple both = make_couple(params);
            step_couple(&both, 1);
            step_couple(&both, 110);
            memory = i == 0 ? memory_of(both.got) : memory;
            assert_int_equal(memory, memory_of(both.got)); /* a twelfth of it everywhere */
            end_couple(&both);
        }
    }
}

/* Where the reference cannot go. */
static void one_seed_grows_the_same_far_away(void **state)
{
    (void)state;
    static const snow_cell far[] = {{0, 0}, {1000000007, -5}, {-2000000000, 2000000011}};
    enum { REACH = 150, WORDS = (2 * REACH + 64) / 64 * (2 * REACH + 1) };
    static uint64_t words[COUNT_OF(far)][WORDS];
    uint64_t memory = 0;
    for (size_t i = 0; i < COUNT_OF(far); i++) {
        snow_packard_params params = packard_scene("0100000");
        params.seeds = &far[i];
        params.seed_count = 1;
        params.engine = SNOW_PACKARD_ENGINE_TILES;
        snow_grid *grid = make_packard(&params, NULL);
        assert_ok(snow_step(grid, REACH));
        memory = i == 0 ? memory_of(grid) : memory;
        assert_int_equal(memory, memory_of(grid));
        assert_ok(snow_packard_copy_bits(grid, (int64_t)far[i].q - REACH, (int64_t)far[i].r - REACH, 2 * REACH + 1,
                                         2 * REACH + 1, words[i], WORDS));
        assert_memory_equal(words[0], words[i], sizeof words[0]);
        snow_destroy(grid);
    }
}

/* A ring so wide that nobody can look at all cells between: seven crystals that never meet. */
static void far_seeds_grow_side_by_side(void **state)
{
    (void)state;
    enum { FAR = 1000000000 };
    static const snow_cell ring[RING] = {{0, 0},    {FAR, 0},  {0, FAR},    {-FAR, FAR},
                                         {-FAR, 0}, {0, -FAR}, {FAR, -FAR}};
    for (int engine = SNOW_PACKARD_ENGINE_AUTO; engine <= SNOW_PACKARD_ENGINE_QUADTREE; engine++) {
        if (engine == SNOW_PACKARD_ENGINE_REFERENCE)
            continue;
        snow_packard_params params = packard_scene("0101010");
        params.seeds = ring;
        params.seed_count = RING;
        params.engine = (snow_packard_engine)engine;
        snow_grid *grid = make_packard(&params, NULL);
        assert_ok(snow_step(grid, 1000));
        assert_int_equal(RING * 2355193, frozen_of(grid));
        snow_packard_zone zone = packard_zone_of(SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_SIDES, 1001, 1010);
        assert_ok(snow_packard_add_zone(grid, &zone));
        if (engine != SNOW_PACKARD_ENGINE_QUADTREE) /* it would have to become tiles */
            assert_ok(snow_step(grid, 20));
        snow_destroy(grid);
    }
}

static void symmetric_seeds_are_folded(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(centres); i++) {
        couple both = make_ring_couple("0101010", centres[i], i % 2 != 0);
        step_couple(&both, 120);
        uint64_t folded = memory_of(both.got);
        set_cell(both.got, SNOW_FIELD_FROZEN, centres[i].q, centres[i].r, 1); /* it was: the same cells, unfolded */
        assert_same_crystals(both.expected, both.got);
        assert_in_range(memory_of(both.got), folded + 1, 12 * folded);
        end_couple(&both);
    }
}

static void a_zone_about_the_same_centre_keeps_the_fold(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(centres); i++) {
        couple both = make_ring_couple("0100000", centres[i], false);
        snow_packard_zone zone = packard_zone_of(SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_SIDES, 10, 60);
        zone.half_width = 5;
        zone.centre = centres[i];
        assert_ok(snow_packard_add_zone(both.expected, &zone));
        assert_ok(snow_packard_add_zone(both.got, &zone));
        step_couple(&both, 100);
        uint64_t folded = memory_of(both.got);
        zone.kind = SNOW_PACKARD_PRIORITY;
        zone.first_step = 101;
        zone.last_step = 120;
        zone.centre.q++;
        assert_ok(snow_packard_add_zone(both.expected, &zone));
        assert_ok(snow_packard_add_zone(both.got, &zone));
        assert_same_crystals(both.expected, both.got);
        assert_in_range(memory_of(both.got), folded + 1, 12 * folded);
        step_couple(&both, 30);
        end_couple(&both);
    }
}

static void a_seed_that_breaks_the_symmetry_unfolds(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(centres); i++) {
        couple both = make_ring_couple("0101010", centres[i], i % 2 == 0);
        step_couple(&both, 30);
        set_cell(both.expected, SNOW_FIELD_FROZEN, centres[i].q + 50, centres[i].r - 7, 1);
        set_cell(both.got, SNOW_FIELD_FROZEN, centres[i].q + 50, centres[i].r - 7, 1);
        assert_same_crystals(both.expected, both.got);
        step_couple(&both, 60);
        end_couple(&both);
    }
}

static snow_grid *saved_and_loaded(const snow_grid *grid)
{
    size_t size;
    assert_ok(snow_save(grid, NULL, 0, &size));
    void *bytes = malloc(size);
    assert_non_null(bytes);
    assert_ok(snow_save(grid, bytes, size, &size));
    snow_grid *loaded = NULL;
    assert_ok(snow_load(bytes, size, NULL, &loaded));
    free(bytes);
    return loaded;
}

static void a_saved_grid_is_folded_again(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(centres); i++) {
        couple both = make_ring_couple("0110100", centres[i], i % 2 != 0);
        step_couple(&both, 70);
        snow_grid *loaded = saved_and_loaded(both.got);
        assert_same_crystals(both.expected, loaded);
        assert_in_range(memory_of(loaded), 1, 2 * memory_of(both.got));
        snow_destroy(both.got);
        both.got = loaded;
        step_couple(&both, 50);
        end_couple(&both);
    }
}

/* The cells have the symmetry, the steps in which they froze have not. */
static void freeze_steps_count_for_the_symmetry(void **state)
{
    (void)state;
    static const snow_cell ring[] = {{9, 0}, {0, 9}, {-9, 9}, {-9, 0}, {0, -9}, {9, -9}};
    snow_packard_params params = packard_scene("0001000");
    params.record_freeze_steps = 1;
    couple both = make_couple(params);
    for (size_t i = 0; i < COUNT_OF(ring); i++) {
        step_couple(&both, 1);
        set_cell(both.expected, SNOW_FIELD_FROZEN, ring[i].q, ring[i].r, 1);
        set_cell(both.got, SNOW_FIELD_FROZEN, ring[i].q, ring[i].r, 1);
    }
    snow_grid *loaded = saved_and_loaded(both.got);
    assert_same_crystals(both.expected, loaded);
    snow_destroy(loaded);
    end_couple(&both);
}

static void patterns_in_files_stay_where_they_are(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(centres); i++) {
        couple both = make_ring_couple("0100000", centres[i], false);
        step_couple(&both, 90);
        size_t size, expected_size;
        assert_ok(snow_packard_save_rle(both.expected, NULL, 0, &expected_size));
        assert_ok(snow_packard_save_rle(both.got, NULL, 0, &size));
        assert_int_equal(expected_size, size);
        char *expected = malloc(size), *got = malloc(size);
        assert_non_null(expected);
        assert_non_null(got);
        assert_ok(snow_packard_save_rle(both.expected, expected, size, &size));
        assert_ok(snow_packard_save_rle(both.got, got, size, &size));
        assert_memory_equal(expected, got, size);
        free(expected);
        free(got);
        end_couple(&both);
    }
}

static void bounded_domains_fold_about_the_origin_alone(void **state)
{
    (void)state;
    for (int domain = SNOW_PACKARD_DISC; domain <= SNOW_PACKARD_TORUS; domain++) {
        for (int i = 0; i < 2; i++) {
            snow_packard_params params = packard_scene("0101010");
            params.domain = (snow_packard_domain)domain;
            params.radius = 40;
            params.width = 66;
            params.height = 70;
            params.seeds = &centres[i];
            params.seed_count = 1;
            couple both = make_couple(params);
            step_couple(&both, 60);
            end_couple(&both);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_seed_grows_the_same_anywhere),
        cmocka_unit_test(one_seed_grows_the_same_far_away),
        cmocka_unit_test(far_seeds_grow_side_by_side),
        cmocka_unit_test(symmetric_seeds_are_folded),
        cmocka_unit_test(a_zone_about_the_same_centre_keeps_the_fold),
        cmocka_unit_test(a_seed_that_breaks_the_symmetry_unfolds),
        cmocka_unit_test(a_saved_grid_is_folded_again),
        cmocka_unit_test(freeze_steps_count_for_the_symmetry),
        cmocka_unit_test(patterns_in_files_stay_where_they_are),
        cmocka_unit_test(bounded_domains_fold_about_the_origin_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
