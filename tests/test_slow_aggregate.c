/* Aggregates, many of them: their radii of gyration against those of the reference, and their dimensions. */
#include "support/aggregates.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_MASSES = 16 };

/* Radii of gyration, their means over clusters, and the errors of the means. */
typedef struct curve {
    size_t masses;
    uint64_t mass[MOST_MASSES];
    double mean[MOST_MASSES];
    double error[MOST_MASSES];
} curve;

static void measure(curve *measured, const snow_aggregate_params *scene, int clusters)
{
    double sum[MOST_MASSES] = {0};
    double squares[MOST_MASSES] = {0};
    snow_aggregate_params params = *scene;
    for (int i = 0; i < clusters; i++) {
        params.random_seed = (uint64_t)i;
        snow_grid *grid = make_aggregate(&params, NULL);
        assert_ok(snow_step(grid, (int64_t)measured->mass[measured->masses - 1] - 1));
        double radii[MOST_MASSES];
        assert_ok(snow_aggregate_gyration(grid, measured->mass, radii, measured->masses));
        for (size_t k = 0; k < measured->masses; k++) {
            sum[k] += radii[k];
            squares[k] += radii[k] * radii[k];
        }
        snow_destroy(grid);
    }
    for (size_t k = 0; k < measured->masses; k++) {
        double mean = sum[k] / clusters;
        measured->mean[k] = mean;
        measured->error[k] = sqrt((squares[k] / clusters - mean * mean) / (clusters - 1));
    }
}

static snow_aggregate_params growth(snow_aggregate_lattice lattice, snow_aggregate_contact contact, double sticking)
{
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    params.lattice = lattice;
    params.contact = contact;
    params.sticking = sticking;
    return params;
}

/* Fails where a mean differs from the known one by more than four standard errors of the difference. */
static void assert_radii(const curve *measured, const double *known, const double *error)
{
    for (size_t k = 0; k < measured->masses; k++)
        assert_near(known[k], measured->mean[k], 4 * hypot(measured->error[k], error[k]));
}

/* Means of an independent single-step program with exact return, and their errors. */
static void radii_of_gyration_are_those_of_the_reference(void **state)
{
    (void)state;
    static const struct {
        snow_aggregate_lattice lattice;
        snow_aggregate_contact contact;
        double sticking;
        double radius[7];
        double error[7];
    } rows[] = {
        {SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 1,
         {1.7475, 2.7075, 4.7224, 7.1169, 10.676, 18.249, 27.345},
         {0.0033, 0.0045, 0.0065, 0.0082, 0.010, 0.014, 0.018}},
        {SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ENTRY, 1,
         {1.617, 2.410, 3.958, 5.794, 8.511, 14.299, 21.304},
         {0.013, 0.018, 0.021, 0.026, 0.031, 0.042, 0.053}},
        {SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 0.5,
         {1.699, 2.584, 4.436, 6.624, 9.853, 16.699, 24.862},
         {0.014, 0.019, 0.027, 0.035, 0.043, 0.057, 0.073}},
        {SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 0.01,
         {1.547, 2.221, 3.475, 4.821, 6.749, 10.583, 14.932},
         {0.017, 0.020, 0.021, 0.020, 0.027, 0.026, 0.027}},
        {SNOW_AGGREGATE_HEXAGONAL, SNOW_AGGREGATE_ARRIVAL, 1,
         {1.809, 2.814, 4.900, 7.357, 11.027, 18.870, 28.334},
         {0.015, 0.021, 0.030, 0.034, 0.042, 0.055, 0.066}},
        {SNOW_AGGREGATE_HEXAGONAL, SNOW_AGGREGATE_ENTRY, 1,
         {1.541, 2.281, 3.776, 5.544, 8.203, 13.804, 20.466},
         {0.012, 0.016, 0.023, 0.028, 0.034, 0.045, 0.056}},
        {SNOW_AGGREGATE_CUBIC, SNOW_AGGREGATE_ARRIVAL, 1,
         {1.455, 2.057, 3.095, 4.140, 5.490, 7.945, 10.498},
         {0.020, 0.023, 0.026, 0.029, 0.032, 0.035, 0.041}},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        snow_aggregate_params params = growth(rows[i].lattice, rows[i].contact, rows[i].sticking);
        curve measured = {7, {10, 20, 50, 100, 200, 500, 1000}, {0}, {0}};
        measure(&measured, &params, 100);
        assert_radii(&measured, rows[i].radius, rows[i].error);
    }
}

/* The slope of ln N against ln Rg, by least squares. */
static double dimension(const curve *measured, size_t first, size_t end)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (size_t k = first; k < end; k++) {
        double radius = log(measured->mean[k]);
        double mass = log((double)measured->mass[k]);
        n++;
        x += radius;
        y += mass;
        xx += radius * radius;
        xy += radius * mass;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

/* Between 200 and 50,000 particles, where the arms along the axes do not show yet; the radii are means of 200 clusters. */
static void square_aggregates_have_their_dimension(void **state)
{
    (void)state;
    static const double known[] = {10.676, 18.249, 27.345, 40.94, 69.96, 104.89, 270.92};
    static const double error[] = {0.010, 0.014, 0.018, 0.10, 0.13, 0.18, 0.43};
    snow_aggregate_params params = growth(SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 1);
    curve measured = {7, {200, 500, 1000, 2000, 5000, 10000, 50000}, {0}, {0}};
    measure(&measured, &params, 60);
    assert_radii(&measured, known, error);
    assert_near(1.71, dimension(&measured, 0, measured.masses), 0.03);
}

static void rare_sticking_raises_the_dimension(void **state)
{
    (void)state;
    static const double sticking[] = {1, 0.1, 0.01};
    double before = 0;
    for (size_t i = 0; i < COUNT_OF(sticking); i++) {
        snow_aggregate_params params = growth(SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, sticking[i]);
        curve measured = {4, {50, 100, 200, 400}, {0}, {0}};
        measure(&measured, &params, 60);
        double found = dimension(&measured, 0, 4);
        assert_true(found > before + 0.02 && found < 2.1);
        before = found;
    }
}

/* All clusters that a box has seen, one point each. At a mass the radius scatters, so that the slope of ln Rg against ln
   mass is right, and the one of ln mass against ln Rg too small. */
static void clusters_of_clusters_have_their_dimension(void **state)
{
    (void)state;
    enum { BOXES = 4, MOST_CLUSTERS = 20000 };
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    snow_aggregate_cluster *list = calloc(MOST_CLUSTERS, sizeof *list);
    assert_non_null(list);
    for (uint64_t seed = 0; seed < BOXES; seed++) {
        snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_CLUSTER_CLUSTER);
        params.particles = 10000;
        params.density = 0.01;
        params.random_seed = seed;
        snow_grid *grid = make_aggregate(&params, NULL);
        for (;;) {
            size_t count = 0;
            assert_ok(snow_aggregate_clusters(grid, list, MOST_CLUSTERS, &count));
            if (count < 20)
                break;
            for (size_t i = 0; i < count; i++) {
                if (list[i].mass < 30)
                    continue;
                double mass = log((double)list[i].mass);
                double radius = log(list[i].gyration);
                n++;
                x += mass;
                y += radius;
                xx += mass * mass;
                xy += mass * radius;
            }
            assert_ok(snow_step(grid, (int64_t)count / 3));
        }
        snow_destroy(grid);
    }
    free(list);
    assert_true(n > 200);
    assert_near(1.44, (n * xx - x * x) / (n * xy - x * y), 0.07);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(radii_of_gyration_are_those_of_the_reference),
        cmocka_unit_test(square_aggregates_have_their_dimension),
        cmocka_unit_test(rare_sticking_raises_the_dimension),
        cmocka_unit_test(clusters_of_clusters_have_their_dimension),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
