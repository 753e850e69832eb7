/* Where walkers end: the exact growth probabilities of small clusters, and walks counted against them. */
#include "support/aggregates.h"
#include "support/chance.h"

#include <math.h>
#include <stdlib.h>

static const snow_aggregate_contact contacts[] = {SNOW_AGGREGATE_ARRIVAL, SNOW_AGGREGATE_ENTRY};
static const snow_aggregate_engine engines[] = {SNOW_AGGREGATE_ENGINE_JUMPS, SNOW_AGGREGATE_ENGINE_STEPS};

static const snow_aggregate_chance *find_chance(const snow_aggregate_chance *list, size_t count, snow_site site)
{
    for (size_t i = 0; i < count; i++)
        if (list[i].site.x == site.x && list[i].site.y == site.y && list[i].site.z == site.z)
            return &list[i];
    return NULL;
}

static void solved_chances_are_those_of_the_reference(void **state)
{
    (void)state;
    for (size_t i = 0; i < known_cluster_count; i++) {
        const known_cluster *cluster = &known_clusters[i];
        for (size_t rule = 0; rule < COUNT_OF(contacts); rule++) {
            snow_grid *grid = make_known(cluster, contacts[rule], SNOW_AGGREGATE_ENGINE_AUTO);
            size_t count = 0;
            snow_aggregate_chance *list = solve_chances(grid, &count);
            for (size_t k = 0; k < COUNT_OF(cluster->chance) && cluster->chance[k].arrival > 0; k++) {
                const snow_aggregate_chance *chance = find_chance(list, count, cluster->chance[k].site);
                assert_non_null(chance);
                double known = rule == 0 ? cluster->chance[k].arrival : cluster->chance[k].entry;
                assert_near(known, chance->probability, 1e-12);
            }
            free(list);
            snow_destroy(grid);
        }
    }
}

static void solved_chances_add_up_and_keep_their_bounds(void **state)
{
    (void)state;
    static const snow_aggregate_lattice lattices[] = {SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_HEXAGONAL,
                                                      SNOW_AGGREGATE_CUBIC};
    for (size_t i = 0; i < COUNT_OF(lattices); i++) {
        for (size_t rule = 0; rule < COUNT_OF(contacts); rule++) {
            snow_grid *grid = grow_cluster(lattices[i], contacts[rule], SNOW_AGGREGATE_ENGINE_AUTO, 300, 1);
            size_t count = 0;
            snow_aggregate_chance *list = solve_chances(grid, &count);
            double sum = 0;
            double errors = 0;
            for (size_t k = 0; k < count; k++) {
                assert_true(list[k].error > 0 && list[k].error < 1e-10);
                assert_true(list[k].probability > -list[k].error);
                sum += list[k].probability;
                errors += list[k].error;
            }
            assert_near(1, sum, errors);
            free(list);
            snow_destroy(grid);
        }
    }
}

/* Far apart, so that the series of the kernel is used: two sites share the walkers evenly, and far from each
   other each is a single site but for the side from which walkers come. */
static void solved_chances_of_far_sites_are_even(void **state)
{
    (void)state;
    static const known_cluster pairs[] = {
        {"square", SNOW_AGGREGATE_SQUARE, 2, {{0, 0, 0}, {700, 300, 0}}, {{{0, 0, 0}, 0, 0}}},
        {"hexagonal", SNOW_AGGREGATE_HEXAGONAL, 2, {{0, 0, 0}, {700, 300, 0}}, {{{0, 0, 0}, 0, 0}}},
        {"cubic", SNOW_AGGREGATE_CUBIC, 2, {{0, 0, 0}, {90, 80, 70}}, {{{0, 0, 0}, 0, 0}}},
    };
    for (size_t i = 0; i < COUNT_OF(pairs); i++) {
        for (size_t rule = 0; rule < COUNT_OF(contacts); rule++) {
            snow_grid *grid = make_known(&pairs[i], contacts[rule], SNOW_AGGREGATE_ENGINE_AUTO);
            size_t count = 0;
            snow_aggregate_chance *list = solve_chances(grid, &count);
            assert_int_equal(pairs[i].lattice == SNOW_AGGREGATE_SQUARE ? 8 : 12, count);
            for (size_t k = 0; k < count; k++) {
                assert_near(1.0 / (double)count, list[k].probability, 0.003);
                assert_near(list[count - 1 - k].probability, list[k].probability, 1e-11); /* half a turn */
            }
            free(list);
            snow_destroy(grid);
        }
    }
}

/* A ring with a site inside: what is inside is not reached, and closed sites cost nothing. */
static void sites_that_are_shut_in_have_no_chance(void **state)
{
    (void)state;
    snow_site ring[] = {{-2, 0, 0}, {-1, 1, 0}, {-1, -1, 0}, {0, 2, 0}, {0, -2, 0}, {1, 1, 0}, {1, -1, 0}, {2, 0, 0},
                        {-2, 1, 0}, {-2, -1, 0}, {2, 1, 0}, {2, -1, 0}, {-1, 2, 0}, {1, 2, 0}, {-1, -2, 0}, {1, -2, 0}};
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    params.seeds = ring;
    params.seed_count = COUNT_OF(ring);
    for (size_t rule = 0; rule < COUNT_OF(contacts); rule++) {
        params.contact = contacts[rule];
        snow_grid *grid = make_aggregate(&params, NULL);
        size_t count = 0;
        snow_aggregate_chance *list = solve_chances(grid, &count);
        double sum = 0;
        for (size_t k = 0; k < count; k++) {
            assert_true(abs(list[k].site.x) + abs(list[k].site.y) >= 3);
            sum += list[k].probability;
        }
        assert_near(1, sum, 1e-12);
        free(list);
        snow_destroy(grid);
    }
}

static void walks_end_on_known_clusters_as_they_should(void **state)
{
    (void)state;
    check_known_clusters(SNOW_AGGREGATE_ENGINE_JUMPS, 10000, 1000);
    check_known_clusters(SNOW_AGGREGATE_ENGINE_STEPS, 300, 100);
}

static void walks_end_on_a_grown_cluster_as_they_should(void **state)
{
    (void)state;
    check_grown_cluster(SNOW_AGGREGATE_ENGINE_JUMPS, 20000, 2000);
    check_grown_cluster(SNOW_AGGREGATE_ENGINE_STEPS, 500, 200);
}

/* With p < 1 there is no closed form: jumps against single steps. */
static void both_agree_where_contacts_seldom_stick(void **state)
{
    (void)state;
    enum { MOST = 4096 };
    const uint64_t walks = 2000;
    for (int lattice = SNOW_AGGREGATE_SQUARE; lattice <= SNOW_AGGREGATE_HEXAGONAL; lattice++) {
        for (size_t rule = 0; rule < COUNT_OF(contacts); rule++) {
            static double hits[2][MOST];
            size_t count = 0;
            snow_aggregate_chance *list = NULL;
            for (size_t engine = 0; engine < COUNT_OF(engines); engine++) {
                snow_grid *grid =
                    grow_cluster((snow_aggregate_lattice)lattice, contacts[rule], engines[engine], 60, 0.25);
                if (engine == 0) {
                    snow_grid *sure = grow_cluster((snow_aggregate_lattice)lattice, SNOW_AGGREGATE_ENTRY,
                                                   SNOW_AGGREGATE_ENGINE_AUTO, 60, 1);
                    list = solve_chances(sure, &count); /* every site that can be reached */
                    snow_destroy(sure);
                    assert_true(count < MOST);
                }
                count_hits(grid, walks, 3 + engine, list, count, hits[engine]);
                snow_destroy(grid);
            }
            assert_alike(hits[0], hits[1], count);
            free(list);
        }
    }
}

/* The tests above can tell: walks by the other contact rule are found out. */
static void a_biased_law_is_found_out(void **state)
{
    (void)state;
    const known_cluster *dimer = &known_clusters[1];
    snow_grid *arrival = make_known(dimer, SNOW_AGGREGATE_ARRIVAL, SNOW_AGGREGATE_ENGINE_JUMPS);
    snow_grid *entry = make_known(dimer, SNOW_AGGREGATE_ENTRY, SNOW_AGGREGATE_ENGINE_JUMPS);
    size_t count = 0;
    snow_aggregate_chance *list = solve_chances(arrival, &count);
    double hits[6];
    assert_int_equal(6, count);
    const double walks = 20000;
    count_hits(entry, (uint64_t)walks, 1, list, count, hits);
    double chi_square = 0;
    for (size_t i = 0; i < count; i++) {
        double expected = walks * list[i].probability;
        chi_square += (hits[i] - expected) * (hits[i] - expected) / expected;
    }
    assert_true(chance_of_chi_square(chi_square, 5) < 1e-20);
    free(list);
    snow_destroy(entry);
    snow_destroy(arrival);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solved_chances_are_those_of_the_reference),
        cmocka_unit_test(solved_chances_add_up_and_keep_their_bounds),
        cmocka_unit_test(solved_chances_of_far_sites_are_even),
        cmocka_unit_test(sites_that_are_shut_in_have_no_chance),
        cmocka_unit_test(walks_end_on_known_clusters_as_they_should),
        cmocka_unit_test(walks_end_on_a_grown_cluster_as_they_should),
        cmocka_unit_test(both_agree_where_contacts_seldom_stick),
        cmocka_unit_test(a_biased_law_is_found_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
