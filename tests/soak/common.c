#include "soak.h"

#include "../support/loops.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

bool soak_talks;

void say(const char *format, ...)
{
    if (!soak_talks)
        return;
    va_list values;
    va_start(values, format);
    (void)vprintf(format, values);
    va_end(values);
    (void)putchar('\n');
    (void)fflush(stdout);
}

bool one_in(uint64_t *random, uint32_t times)
{
    return next_below(random, times) == 0;
}

int32_t between(uint64_t *random, int32_t least, int32_t greatest)
{
    return least + (int32_t)next_below(random, (uint32_t)(greatest - least + 1));
}

double fraction(uint64_t *random)
{
    return next_below(random, UINT32_MAX) / 4294967296.0;
}

snow_options any_options(uint64_t *random, const snow_options *memory)
{
    snow_options options = *memory;
    snow_isa isas[8];
    size_t count = available_isas(isas);
    options.isa = one_in(random, 4) ? SNOW_ISA_AUTO : isas[next_below(random, (uint32_t)count)];
    options.threads = one_in(random, 3) ? between(random, 2, 8) : 1;
    if (one_in(random, 4))
        options.parallel_for = test_loops[next_below(random, (uint32_t)test_loop_count)].run;
    return options;
}

snow_stop any_stop(uint64_t *random, int64_t most_steps, int64_t steps_now)
{
    snow_stop stop = default_stop();
    stop.max_steps = steps_now + (int64_t)next_below(random, (uint32_t)most_steps + 1);
    stop.rim = between(random, 0, 1);
    stop.still = between(random, 0, 1);
    if (one_in(random, 3))
        stop.tip_radius = 30 * fraction(random);
    if (one_in(random, 3))
        stop.frozen = next_below(random, 500);
    return stop;
}

void run_alike(snow_grid *const *grids, size_t count, const snow_stop *stop)
{
    say("run: rim %d, still %d, radius %g, frozen %" PRIu64 ", up to step %" PRId64, stop->rim, stop->still,
        stop->tip_radius, stop->frozen, stop->max_steps);
    snow_summary expected;
    snow_summary_init(&expected, sizeof expected);
    snow_status status = snow_run(grids[0], stop, &expected);
    for (size_t i = 1; i < count; i++) {
        snow_summary got;
        snow_summary_init(&got, sizeof got);
        assert_status(status, snow_run(grids[i], stop, &got));
        assert_int_equal(expected.reason, got.reason);
        assert_int_equal(expected.steps, got.steps);
        assert_int_equal(expected.frozen, got.frozen);
        assert_same_double(expected.tip_radius, got.tip_radius);
    }
}

void save_and_load(snow_grid **grid, const snow_options *options)
{
    size_t size = 0;
    assert_ok(snow_save(*grid, NULL, 0, &size));
    void *bytes = malloc(size);
    assert_non_null(bytes);
    assert_ok(snow_save(*grid, bytes, size, &size));
    snow_grid *loaded = NULL;
    assert_ok(snow_load(bytes, size, options, &loaded));
    free(bytes);
    assert_int_equal(steps_of(*grid), steps_of(loaded));
    assert_true(digest_of(*grid) == digest_of(loaded));
    snow_destroy(*grid);
    *grid = loaded;
}

static void assert_same_picture(const snow_grid *expected, const snow_grid *got, uint64_t *random)
{
    enum { SIDE = 40, BYTES = SIDE * SIDE * 4 };
    static unsigned char left[BYTES], right[BYTES];
    snow_view view;
    snow_view_init(&view, sizeof view);
    if (snow_view_fit(expected, SIDE, &view) != SNOW_OK)
        return;
    view.palette = (snow_palette)between(random, SNOW_PALETTE_PAPER, SNOW_PALETTE_PHASE);
    view.pixel = (snow_pixel)between(random, SNOW_PIXEL_GREY, SNOW_PIXEL_RGBA);
    view.samples = between(random, 1, 3);
    size_t size = 0;
    snow_status status = snow_render(expected, &view, left, sizeof left, &size);
    assert_status(status, snow_render(got, &view, right, sizeof right, &size));
    if (status == SNOW_OK)
        assert_memory_equal(left, right, size);
}

void assert_same_measures(const snow_grid *expected, const snow_grid *got, uint64_t *random)
{
    const double radii[] = {0, 1, 3 * fraction(random) + 1, 7, 40};
    uint64_t left[COUNT_OF(radii)], right[COUNT_OF(radii)];
    assert_ok(snow_mass_radius(expected, radii, COUNT_OF(radii), left));
    assert_ok(snow_mass_radius(got, radii, COUNT_OF(radii), right));
    assert_memory_equal(left, right, sizeof left);

    int32_t side = between(random, 1, 20);
    assert_ok(snow_box_count(expected, side, left));
    assert_ok(snow_box_count(got, side, right));
    assert_int_equal(left[0], right[0]);

    double one = 0, other = 0;
    assert_ok(snow_density(expected, &one));
    assert_ok(snow_density(got, &other));
    assert_same_double(one, other);
    one = other = 0;
    assert_status(snow_dimension(expected, &one), snow_dimension(got, &other));
    assert_same_double(one, other);
    assert_same_double(defect_of(expected), defect_of(got));

    double vapour[2], ice[2];
    assert_ok(snow_mass(expected, &vapour[0], &ice[0]));
    assert_ok(snow_mass(got, &vapour[1], &ice[1]));
    assert_same_double(vapour[0], vapour[1]);
    assert_same_double(ice[0], ice[1]);
    assert_same_picture(expected, got, random);
}
