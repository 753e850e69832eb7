/* What doc/accuracy.md states: additions in closed form, the error of single precision, the bound of the tolerance. */
#include "support/grids.h"

#include <math.h>
#include <stdlib.h>

/* How far a value is from start + addition·count, worked out without a rounding that matters. */
static double error_of(double value, double start, double addition, double count)
{
    double product = addition * count;
    double product_lost = fma(addition, count, -product);
    double sum = start + product;
    double added = sum - start;
    double sum_lost = (start - (sum - added)) + (product - added);
    return fabs((value - sum) - (sum_lost + product_lost));
}

/* The seed has 1 + γ·k after k steps. In air of β = 0 nothing flows into it. */
static void additions_in_closed_form_beat_summing(void **state)
{
    (void)state;
    static const double additions[] = {0.0001, 0.001, 0.0035, 0.01, 0.05, 0.1, 1.0 / 3, 0.7};
    for (size_t i = 0; i < COUNT_OF(additions); i++) {
        snow_reiter_params params = disc_scene(0, additions[i], 1, 3);
        snow_grid *grid = make_grid(&params, NULL);
        double summed = 1;
        double greatest = 0;
        double greatest_summed = 0;
        for (int32_t count = 1; count <= 10000; count++) {
            assert_ok(snow_step(grid, 1));
            summed += additions[i];
            double value = value_at(grid, SNOW_FIELD_VALUE, 0, 0);
            double error = error_of(value, 1, additions[i], count);
            assert_true(error <= 0x1p-53 * (additions[i] * count + value)); /* two roundings, however many steps */
            greatest = fmax(greatest, error);
            greatest_summed = fmax(greatest_summed, error_of(summed, 1, additions[i], count));
        }
        assert_true(greatest < greatest_summed);
        snow_destroy(grid);
    }
}

static double sum_of(double addition, int64_t count)
{
    double sum = 0;
    for (int64_t i = 0; i < count; i++)
        sum += addition;
    return sum;
}

/* A plate in air of β = 0: the ring at distance n begins to gain when the ring before it is ice, so that each of its
   cells has γ·k, and k is known. */
static void interior_ice_is_right_to_one_rounding(void **state)
{
    (void)state;
    enum { RINGS = 12, STEPS = 1300, RING_STEPS = 100 };
    const double addition = 0.01;
    snow_reiter_params params = hexagon_scene(0, addition, 1, 20);
    snow_grid *grid = make_grid(&params, NULL);
    assert_ok(snow_step(grid, STEPS));
    double greatest = 0;
    double greatest_summed = 0;
    for (int32_t ring = 1; ring <= RINGS; ring++) {
        int64_t count = STEPS - (ring - 1) * RING_STEPS;
        for (size_t side = 0; side < 6; side++) {
            double value = value_at(grid, SNOW_FIELD_VALUE, ring * neighbours[side].q, ring * neighbours[side].r);
            assert_same_double(addition * (double)count, value);
            greatest = fmax(greatest, error_of(value, 0, addition, (double)count));
        }
        double summed = sum_of(addition, count);
        greatest_summed = fmax(greatest_summed, error_of(summed, 0, addition, (double)count));
    }
    assert_true(greatest < greatest_summed);
    snow_destroy(grid);
}

/* How far two grids of the same domain are apart. */
typedef struct difference {
    size_t freeze_steps; /* cells that froze in another step, or in one of the two only */
    double vapour;       /* the greatest */
} difference;

static difference difference_of(const snow_grid *a, const snow_grid *b)
{
    difference found = {0};
    size_t count = 0;
    double *steps[2] = {copy_field(a, SNOW_FIELD_FREEZE_STEP, NULL, &count),
                        copy_field(b, SNOW_FIELD_FREEZE_STEP, NULL, &count)};
    double *vapour[2] = {copy_field(a, SNOW_FIELD_VAPOUR, NULL, &count),
                         copy_field(b, SNOW_FIELD_VAPOUR, NULL, &count)};
    for (size_t i = 0; i < count; i++) {
        found.freeze_steps += steps[0][i] != steps[1][i];
        found.vapour = fmax(found.vapour, fabs(vapour[0][i] - vapour[1][i]));
    }
    for (size_t i = 0; i < 2; i++) {
        free(steps[i]);
        free(vapour[i]);
    }
    return found;
}

/* The scene in double precision, and otherwise. The caller destroys both. */
static void start_both(snow_reiter_params params, snow_reiter_precision precision, double tolerance,
                      snow_grid *grown[2])
{
    params.record_freeze_steps = 1;
    grown[0] = make_grid(&params, NULL);
    params.precision = precision;
    params.tolerance = tolerance;
    grown[1] = make_grid(&params, NULL);
}

static void destroy_both(snow_grid *grown[2])
{
    snow_destroy(grown[0]);
    snow_destroy(grown[1]);
}

/* What was seen of two that grow side by side. */
typedef struct sighting {
    bool same_ice; /* to the last step */
    double vapour; /* the greatest difference, as long as the ice was the same */
} sighting;

/* Steps both and finds no difference greater than `each` for every step, as long as the ice is the same. */
static sighting watch_both(snow_grid *grown[2], int64_t steps, double each)
{
    enum { STRIDE = 45 };
    sighting seen = {.same_ice = true};
    for (int64_t step = STRIDE; step <= steps && seen.same_ice; step += STRIDE) {
        assert_ok(snow_step(grown[0], STRIDE));
        assert_ok(snow_step(grown[1], STRIDE));
        difference found = difference_of(grown[0], grown[1]);
        seen.same_ice = found.freeze_steps == 0;
        if (seen.same_ice) {
            assert_true(found.vapour <= each * (double)step);
            seen.vapour = fmax(seen.vapour, found.vapour);
        }
    }
    return seen;
}

static const double contracting[] = {0.1, 0.5, 1, 1.5, 2}; /* diffusions for which errors do not grow */

static void a_tolerance_keeps_its_bound(void **state)
{
    (void)state;
    static const double tolerances[] = {1e-12, 1e-9, 1e-6, 1e-4};
    for (size_t i = 0; i < COUNT_OF(contracting) * COUNT_OF(tolerances) * 2; i++) {
        double tolerance = tolerances[i / 2 % COUNT_OF(tolerances)];
        double diffusion = contracting[i / 2 / COUNT_OF(tolerances)];
        snow_reiter_params params = disc_scene(0.4, 0.001, diffusion, 40);
        params.symmetry = i % 2 == 0 ? SNOW_REITER_SYMMETRY_AUTO : SNOW_REITER_SYMMETRY_NONE;
        snow_grid *grown[2];
        start_both(params, SNOW_REITER_PRECISION_DOUBLE, tolerance, grown);
        /* Each step rounds by at most 0.69·2^-51 in both. */
        double each = (1 + 32 * diffusion) * tolerance + 2 * 0.69 * 0x1p-51;
        sighting seen = watch_both(grown, 600, each);
        assert_true(seen.same_ice || tolerance > 1e-9);
        assert_true(seen.vapour > 1e-12 || tolerance < 1e-6); /* something was left out */
        destroy_both(grown);
    }
}

/* The quantum is 2^-51 here. */
static void a_tolerance_below_the_quantum_changes_no_bit(void **state)
{
    (void)state;
    snow_grid *grown[2];
    start_both(disc_scene(0.4, 0.001, 1, 40), SNOW_REITER_PRECISION_DOUBLE, 0x1p-52, grown);
    for (int i = 0; i < 10; i++) {
        assert_ok(snow_step(grown[0], 83));
        assert_ok(snow_step(grown[1], 83));
        assert_same_grids(grown[0], grown[1]);
    }
    destroy_both(grown);
}

/* A flow of at most α/2·2^28 quanta is rounded thrice to 24 bits, then to a quantum. */
static void single_precision_keeps_its_bound(void **state)
{
    (void)state;
    static const double backgrounds[] = {0.2, 0.4, 0.6, 0.8};
    for (size_t i = 0; i < COUNT_OF(contracting) * COUNT_OF(backgrounds); i++) {
        double diffusion = contracting[i / COUNT_OF(backgrounds)];
        double background = backgrounds[i % COUNT_OF(backgrounds)];
        snow_grid *grown[2];
        start_both(disc_scene(background, 0.001, diffusion, 40), SNOW_REITER_PRECISION_SINGLE, 0, grown);
        double quantum = background <= 0.25 ? 0x1p-30 : background <= 0.5 ? 0x1p-29 : 0x1p-28;
        sighting seen = watch_both(grown, 600, (25 * diffusion + 1) * quantum);
        assert_true(seen.same_ice);
        assert_true(seen.vapour > 0);
        destroy_both(grown);
    }
}

/* The pairs of the paper's fig. 3 and a few more, and other diffusions. */
static snow_reiter_params scene_of_the_table(size_t index)
{
    static const double backgrounds[] = {0, .1, .2, .3, .35, .4, .5, .6, .7, .8, .9, .95};
    static const double additions[] = {0, .0001, .001, .0035, .01, .05, .1};
    static const double diffusions[] = {.1, .5, 1.5, 2, 2.003, 2.6};
    size_t pairs = COUNT_OF(backgrounds) * COUNT_OF(additions);
    if (index >= pairs)
        return disc_scene(.4, .0001, diffusions[index - pairs], 60);
    return disc_scene(backgrounds[index / COUNT_OF(additions)], additions[index % COUNT_OF(additions)], 1, 60);
}

static void most_crystals_in_single_precision_are_those_in_double(void **state)
{
    (void)state;
    enum { SCENES = 90, SAME_STOP = 90, SAME_STEPS = 87 }; /* as doc/accuracy.md says */
    int same_stop = 0;
    int same_steps = 0;
    for (size_t i = 0; i < SCENES; i++) {
        snow_reiter_params params = scene_of_the_table(i);
        snow_grid *grown[2];
        start_both(params, SNOW_REITER_PRECISION_SINGLE, 0, grown);
        snow_summary ends[2] = {run_grid(grown[0], NULL), run_grid(grown[1], NULL)};
        size_t others = difference_of(grown[0], grown[1]).freeze_steps;
        if (others > 0)
            print_message("beta %g gamma %g alpha %g: %zu cells freeze in another step\n", params.background,
                          params.addition, params.diffusion, others);
        same_stop += ends[0].steps == ends[1].steps && ends[0].frozen == ends[1].frozen;
        same_steps += ends[0].steps == ends[1].steps && others == 0;
        destroy_both(grown);
    }
    assert_int_equal(SAME_STOP, same_stop);
    assert_int_equal(SAME_STEPS, same_steps);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(additions_in_closed_form_beat_summing),
        cmocka_unit_test(interior_ice_is_right_to_one_rounding),
        cmocka_unit_test(a_tolerance_keeps_its_bound),
        cmocka_unit_test(a_tolerance_below_the_quantum_changes_no_bit),
        cmocka_unit_test(single_precision_keeps_its_bound),
        cmocka_unit_test(most_crystals_in_single_precision_are_those_in_double),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
