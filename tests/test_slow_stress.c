/* A million steps: mass is kept, symmetry too, what is untouched stays untouched, and no number becomes subnormal.
   Slow: some minutes. */
#include "support/grids.h"

#include <math.h>
#include <stdlib.h>

enum { STEPS = 1000000, LOOKS = 10 };

static const snow_reiter_precision precisions[] = {SNOW_REITER_PRECISION_DOUBLE, SNOW_REITER_PRECISION_SINGLE};

/* high·2^-20 + low·2^-62, 0 <= low < 2^42: sums of doubles that are whole multiples of 2^-62, without any rounding. */
typedef struct exact {
    int64_t high, low;
} exact;

static const int64_t low_end = INT64_C(1) << 42;

static void exact_add(exact *sum, double value)
{
    double high = floor(value * 0x1p20);
    double low = (value - high * 0x1p-20) * 0x1p62;
    assert_true(low == floor(low));
    sum->high += (int64_t)high;
    sum->low += (int64_t)low;
    if (sum->low >= low_end) {
        sum->low -= low_end;
        sum->high++;
    }
}

/* a·x − b·y, rounded once; the factors are small. */
static double exact_difference(int64_t a, exact x, int64_t b, exact y)
{
    return ldexp((double)(a * x.high - b * y.high), -20) + ldexp((double)(a * x.low - b * y.low), -62);
}

static double quantum_of(const snow_reiter_params *params)
{
    double bound = 0x1p-64;
    while (bound < params->background + params->noise)
        bound *= 2;
    bound *= params->diffusion > 2 ? 8 : 1;
    return bound * (params->precision == SNOW_REITER_PRECISION_SINGLE ? 0x1p-28 : 0x1p-50);
}

static int32_t ring_of(int32_t q, int32_t r)
{
    return (abs(q) + abs(r) + abs(q + r)) / 2;
}

/* Fields over the bounds, to be asked by cell. */
typedef struct plane {
    snow_rect bounds;
    double *values;
} plane;

static plane read_plane(const snow_grid *grid, snow_field field)
{
    snow_rect bounds = widened(bounds_of(grid));
    return (plane){bounds, copy_field(grid, field, &bounds, NULL)};
}

static double at(const plane *field, int32_t q, int32_t r)
{
    return field->values[(size_t)(r - field->bounds.r) * (size_t)field->bounds.width + (size_t)(q - field->bounds.q)];
}

/* What all the cells up to a ring hold. */
static exact mass_within(const snow_grid *grid, int32_t ring)
{
    plane value = read_plane(grid, SNOW_FIELD_VALUE);
    exact mass = {0, 0};
    for (int32_t r = -ring; r <= ring; r++)
        for (int32_t q = -ring; q <= ring; q++)
            if (ring_of(q, r) <= ring)
                exact_add(&mass, at(&value, q, r));
    free(value.values);
    return mass;
}

static double most_vapour_within(const snow_grid *grid, int32_t ring)
{
    plane vapour = read_plane(grid, SNOW_FIELD_VAPOUR);
    double most = 0;
    for (int32_t r = -ring; r <= ring; r++)
        for (int32_t q = -ring; q <= ring; q++)
            if (ring_of(q, r) <= ring)
                most = fmax(most, at(&vapour, q, r));
    free(vapour.values);
    return most;
}

/* Neither subnormal nor negative zero, and vapour in whole quanta; beyond `reach`, and outside, not a bit has changed
   since the start. */
static void assert_sound(const snow_grid *grid, double quantum, double background, int32_t reach)
{
    plane value = read_plane(grid, SNOW_FIELD_VALUE);
    plane vapour = read_plane(grid, SNOW_FIELD_VAPOUR);
    for (int32_t r = value.bounds.r; r < value.bounds.r + value.bounds.height; r++) {
        for (int32_t q = value.bounds.q; q < value.bounds.q + value.bounds.width; q++) {
            double u = at(&value, q, r);
            double v = at(&vapour, q, r);
            assert_true(isnormal(u) || (u == 0 && !signbit(u)));
            assert_true(isnormal(v) || (v == 0 && !signbit(v)));
            assert_true(v / quantum == rint(v / quantum));
            if (ring_of(q, r) >= reach)
                assert_same_double(background, u);
        }
    }
    free(value.values);
    free(vapour.values);
}

/* Six sides of `radius` cells: the vapour beside the fixed cells, as often as it touches one. */
static void add_rim(const snow_grid *grid, int32_t radius, exact *sum)
{
    double side[64];
    snow_rect rect = {0, 1 - radius, radius, 1};
    assert_ok(snow_field_copy(grid, SNOW_FIELD_VAPOUR, &rect, side, COUNT_OF(side), NULL));
    for (int touch = 0; touch < 3; touch++)
        exact_add(sum, side[0]);
    for (int32_t i = 1; i < radius - 1; i++)
        exact_add(sum, 2 * side[i]);
}

/* In quanta a cell and step. The roundings alone allow 1/2, and in thin air a receptive cell rounds what it collects
   as well; this is what they come to. */
static double drift_a_cell(const snow_grid *grid, double drift, double cells, double quantum)
{
    return fabs(drift) / quantum / cells / (double)steps_of(grid);
}

/* γ = 0: what a crystal in thin air gains is what flows in over the rim, summed up here from the cells beside it. */
static void feed_through_the_rim(double background, int32_t sixteenths, int32_t radius, snow_reiter_precision precision)
{
    snow_reiter_params params = hexagon_scene(background, 0, sixteenths / 16.0, radius);
    params.precision = precision;
    double quantum = quantum_of(&params);
    snow_grid *grid = make_grid(&params, NULL);
    exact start = mass_within(grid, radius - 1);
    exact full = {0, 0};
    exact rim = {0, 0};
    double fixed = value_at(grid, SNOW_FIELD_VALUE, radius, 0);
    for (int look = 0; look < LOOKS; look++) {
        for (int64_t step = 0; step < STEPS / LOOKS; step++) {
            exact_add(&full, fixed);
            add_rim(grid, radius, &rim);
            assert_ok(snow_step(grid, 1));
        }
        exact mass = mass_within(grid, radius - 1);
        double gained = exact_difference(192, mass, 192, start);
        double flowed = 6 * sixteenths * exact_difference(2 * radius - 1, full, 1, rim);
        double drift = drift_a_cell(grid, (gained - flowed) / 192, (double)cells_of(grid), quantum);
        assert_true(drift < (precision == SNOW_REITER_PRECISION_SINGLE ? 0.35 : 0.2));
        assert_same_double(0, defect_of(grid));
        assert_sound(grid, quantum, fixed, radius);
    }
    assert_true(frozen_of(grid) > 500);
    snow_destroy(grid);
}

static void mass_comes_in_through_the_rim(void **state)
{
    (void)state;
    for (size_t p = 0; p < COUNT_OF(precisions); p++) {
        feed_through_the_rim(0.001, 16, 40, precisions[p]);
        feed_through_the_rim(0.0005, 40, 40, precisions[p]);
    }
}

/* Walls of ice round triangles with `side` − 1 cells along each side, up to the ring 3·side. */
static size_t build_walls(int32_t side, snow_cell *walls, size_t room)
{
    size_t count = 0;
    for (int32_t r = -3 * side; r <= 3 * side; r++) {
        for (int32_t q = -3 * side; q <= 3 * side; q++) {
            if (ring_of(q, r) > 3 * side || (q % side != 0 && r % side != 0 && (q + r) % side != 0))
                continue;
            assert_true(count < room);
            walls[count++] = (snow_cell){q, r};
        }
    }
    return count;
}

/* What is gained by γ: a cell gains from the step on after it, or its first neighbour, has frozen. */
static exact additions_within(const snow_grid *grid, double addition, int32_t ring)
{
    plane frozen_in = read_plane(grid, SNOW_FIELD_FREEZE_STEP);
    exact gained = {0, 0};
    for (int32_t r = -ring; r <= ring; r++) {
        for (int32_t q = -ring; q <= ring; q++) {
            if (ring_of(q, r) > ring)
                continue;
            double first = at(&frozen_in, q, r);
            for (size_t i = 0; i < COUNT_OF(neighbours); i++) {
                double beside = at(&frozen_in, q + neighbours[i].q, r + neighbours[i].r);
                if (beside >= 0 && (first < 0 || beside < first))
                    first = beside;
            }
            if (first >= 0)
                exact_add(&gained, addition * ((double)steps_of(grid) - first));
        }
    }
    free(frozen_in.values);
    return gained;
}

/* Slow diffusion: the news of the crystal comes 40 cells far, in single precision 23, and beyond nothing has changed.
   Mass grows by γ a step and receptive cell, and nothing crosses the rim. */
static void what_is_far_stays_untouched(void **state)
{
    (void)state;
    for (size_t p = 0; p < COUNT_OF(precisions); p++) {
        snow_reiter_params params = hexagon_scene(0.4, 0x1p-21, 0x1p-13, 60);
        params.record_freeze_steps = 1;
        params.precision = precisions[p];
        double quantum = quantum_of(&params);
        snow_grid *grid = make_grid(&params, NULL);
        double fixed = value_at(grid, SNOW_FIELD_VALUE, params.radius, 0);
        exact start = mass_within(grid, params.radius - 1);
        for (int look = 0; look < LOOKS; look++) {
            assert_ok(snow_step(grid, STEPS / LOOKS));
            assert_sound(grid, quantum, fixed, precisions[p] == SNOW_REITER_PRECISION_SINGLE ? 28 : 45);
            assert_same_double(0, defect_of(grid));
            exact mass = mass_within(grid, params.radius - 1);
            exact gained = additions_within(grid, params.addition, params.radius - 1);
            double drift = exact_difference(1, mass, 1, start) - exact_difference(1, gained, 0, gained);
            assert_true(drift_a_cell(grid, drift, (double)cells_of(grid), quantum) < 0.01);
        }
        assert_true(frozen_of(grid) > 100);
        snow_destroy(grid);
    }
}

/* Nothing gets in or out: all mass stays, but for γ, in the pockets, which end with a few quanta that flow no more. */
static void starve_in_pockets(int32_t side, double addition, int32_t noise_symmetric, snow_reiter_precision precision)
{
    snow_cell walls[2000];
    snow_reiter_params params = hexagon_scene(0.4, addition, 1, 3 * side + 4);
    params.seed_count = build_walls(side, walls, COUNT_OF(walls));
    params.seeds = walls;
    params.noise = 0.1;
    params.noise_symmetric = noise_symmetric;
    params.record_freeze_steps = 1;
    params.precision = precision;
    double quantum = quantum_of(&params);
    int32_t last = 3 * side - 1;
    double cells = 3 * last * (last + 1) + 1;
    snow_grid *grid = make_grid(&params, NULL);
    double fixed = value_at(grid, SNOW_FIELD_VALUE, params.radius, 0);
    exact start = mass_within(grid, last);
    for (int look = 0; look < LOOKS; look++) {
        assert_ok(snow_step(grid, STEPS / LOOKS));
        exact mass = mass_within(grid, last);
        exact gained = additions_within(grid, addition, last);
        double drift = exact_difference(1, mass, 1, start) - exact_difference(1, gained, 0, gained);
        assert_true(drift_a_cell(grid, drift, cells, quantum) < 0.06);
        assert_true(most_vapour_within(grid, last) <= side * side / 9.0 * quantum);
        assert_sound(grid, quantum, fixed, params.radius);
        if (noise_symmetric)
            assert_same_double(0, defect_of(grid));
    }
    snow_destroy(grid);
}

static void pockets_run_dry(void **state)
{
    (void)state;
    for (size_t p = 0; p < COUNT_OF(precisions); p++) {
        starve_in_pockets(12, 0, 0, precisions[p]);
        starve_in_pockets(12, 0x1p-30, 1, precisions[p]);
        starve_in_pockets(6, 0, 1, precisions[p]);
    }
}

/* A crystal with noise grows to the rim and beyond, and shuts pockets on its way: folded and whole, on the slowest and
   on the fastest instruction set, the same bits after a million steps. */
static void crystals_grow_shut(void **state)
{
    (void)state;
    snow_isa isas[8];
    size_t count = available_isas(isas);
    for (size_t p = 0; p < COUNT_OF(precisions); p++) {
        snow_reiter_params params = hexagon_scene(0.4, 0x1p-30, 1, 30);
        params.noise = 0.1;
        params.noise_symmetric = 1;
        params.precision = precisions[p];
        snow_options options = default_options();
        options.isa = isas[count - 1];
        snow_grid *folded = make_grid(&params, &options);
        double fixed = value_at(folded, SNOW_FIELD_VALUE, params.radius, 0);
        params.symmetry = SNOW_REITER_SYMMETRY_NONE;
        options.isa = isas[0];
        snow_grid *whole = make_grid(&params, &options);
        for (int look = 0; look < LOOKS; look++) {
            assert_ok(snow_step(folded, STEPS / LOOKS));
            assert_ok(snow_step(whole, STEPS / LOOKS));
            assert_same_grids(whole, folded);
            assert_same_double(0, defect_of(folded));
            assert_sound(folded, quantum_of(&params), fixed, params.radius);
        }
        snow_destroy(folded);
        snow_destroy(whole);
    }
}

/* The plain reading takes a million steps as well, in a small pocket. */
static void the_reference_ends_there_too(void **state)
{
    (void)state;
    for (size_t p = 0; p < COUNT_OF(precisions); p++) {
        snow_cell walls[200];
        snow_reiter_params params = hexagon_scene(0.3, 0x1p-30, 0.3, 8);
        params.seed_count = build_walls(2, walls, COUNT_OF(walls));
        params.seeds = walls;
        params.noise = 0.1;
        params.precision = precisions[p];
        snow_grid *fast = make_grid(&params, NULL);
        params.engine = SNOW_REITER_ENGINE_REFERENCE;
        snow_grid *plain = make_grid(&params, NULL);
        assert_ok(snow_step(fast, STEPS));
        assert_ok(snow_step(plain, STEPS));
        assert_same_grids(plain, fast);
        snow_destroy(fast);
        snow_destroy(plain);
    }
}

static double farthest_from(const snow_grid *grid, double level)
{
    size_t count;
    double *values = copy_field(grid, SNOW_FIELD_VALUE, NULL, &count);
    double farthest = 0;
    for (size_t i = 0; i < count; i++)
        farthest = fmax(farthest, fabs(values[i] - level));
    free(values);
    return farthest;
}

/* At 8/3 the worst wave of the plane neither grows nor fades. In a disc all waves fade, until what flows is less than
   half a quantum; then nothing moves any more, and no rounding feeds a wave. */
static void the_limit_of_stability_holds(void **state)
{
    (void)state;
    for (size_t p = 0; p < COUNT_OF(precisions); p++) {
        snow_reiter_params params = disc_scene(0.4, 0, 8.0 / 3.0, 24);
        params.noise = 0.1;
        params.precision = precisions[p];
        without_seeds(&params);
        snow_grid *grid = make_grid(&params, NULL);
        double fixed = value_at(grid, SNOW_FIELD_VALUE, params.radius, 0);
        assert_ok(snow_step(grid, STEPS / 10));
        double left = farthest_from(grid, fixed);
        assert_true(left <= 1000 * quantum_of(&params));
        assert_ok(snow_step(grid, STEPS - STEPS / 10));
        assert_same_double(left, farthest_from(grid, fixed));
        assert_int_equal(0, frozen_of(grid));
        snow_destroy(grid);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_far_stays_untouched),
        cmocka_unit_test(the_limit_of_stability_holds),
        cmocka_unit_test(the_reference_ends_there_too),
        cmocka_unit_test(crystals_grow_shut),
        cmocka_unit_test(mass_comes_in_through_the_rim),
        cmocka_unit_test(pockets_run_dry),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
