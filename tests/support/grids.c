#include "grids.h"

#include <stdlib.h>
#include <string.h>

const snow_cell neighbours[6] = {{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}};

snow_reiter_params disc_scene(double background, double addition, double diffusion, int32_t radius)
{
    snow_reiter_params params;
    snow_reiter_params_init(&params, sizeof params);
    params.background = background;
    params.addition = addition;
    params.diffusion = diffusion;
    params.radius = radius;
    return params;
}

snow_reiter_params hexagon_scene(double background, double addition, double diffusion, int32_t radius)
{
    snow_reiter_params params = disc_scene(background, addition, diffusion, radius);
    params.domain = SNOW_REITER_HEXAGON;
    return params;
}

snow_reiter_params rectangle_scene(double background, double addition, double diffusion, int32_t width,
                                   int32_t height)
{
    snow_reiter_params params = disc_scene(background, addition, diffusion, 1);
    params.domain = SNOW_REITER_RECTANGLE;
    params.width = width;
    params.height = height;
    return params;
}

void without_seeds(snow_reiter_params *params)
{
    static const snow_cell none[1] = {{0, 0}};
    params->seeds = none;
    params->seed_count = 0;
}

snow_options default_options(void)
{
    snow_options options;
    snow_options_init(&options, sizeof options);
    return options;
}

snow_stop default_stop(void)
{
    snow_stop stop;
    snow_stop_init(&stop, sizeof stop);
    return stop;
}

snow_stop stop_after(int64_t steps)
{
    snow_stop stop = default_stop();
    stop.max_steps = steps;
    stop.rim = 0;
    stop.still = 0;
    return stop;
}

snow_grid *make_grid(const snow_reiter_params *params, const snow_options *options)
{
    snow_grid *grid = NULL;
    assert_ok(snow_reiter_create(params, options, &grid));
    assert_non_null(grid);
    return grid;
}

snow_summary run_grid(snow_grid *grid, const snow_stop *stop)
{
    snow_summary summary;
    snow_summary_init(&summary, sizeof summary);
    assert_ok(snow_run(grid, stop, &summary));
    assert_int_equal(steps_of(grid), summary.steps);
    assert_int_equal(frozen_of(grid), summary.frozen);
    assert_same_double(tip_of(grid), summary.tip_radius);
    assert_true(summary.seconds >= 0);
    return summary;
}

int64_t steps_of(const snow_grid *grid)
{
    int64_t steps = -1;
    assert_ok(snow_steps(grid, &steps));
    return steps;
}

uint64_t frozen_of(const snow_grid *grid)
{
    uint64_t cells = UINT64_MAX;
    assert_ok(snow_frozen(grid, &cells));
    return cells;
}

uint64_t cells_of(const snow_grid *grid)
{
    uint64_t cells = UINT64_MAX;
    assert_ok(snow_domain_cells(grid, &cells));
    return cells;
}

uint64_t digest_of(const snow_grid *grid)
{
    uint64_t digest = 0;
    assert_ok(snow_digest(grid, &digest));
    return digest;
}

double tip_of(const snow_grid *grid)
{
    double radius = -1;
    assert_ok(snow_tip_radius(grid, &radius));
    return radius;
}

double defect_of(const snow_grid *grid)
{
    double defect = -1;
    assert_ok(snow_symmetry_defect(grid, &defect));
    return defect;
}

double value_at(const snow_grid *grid, snow_field field, int32_t q, int32_t r)
{
    double value = -1;
    assert_ok(snow_cell_value(grid, field, q, r, &value));
    return value;
}

snow_rect bounds_of(const snow_grid *grid)
{
    snow_rect bounds = {0, 0, -1, -1};
    assert_ok(snow_domain_bounds(grid, &bounds));
    return bounds;
}

snow_rect widened(snow_rect rect)
{
    return (snow_rect){rect.q - 1, rect.r - 1, rect.width + 2, rect.height + 2};
}

double *copy_field(const snow_grid *grid, snow_field field, const snow_rect *rect, size_t *count)
{
    size_t wanted = 0;
    assert_ok(snow_field_copy(grid, field, rect, NULL, 0, &wanted));
    double *values = malloc((wanted > 0 ? wanted : 1) * sizeof *values);
    assert_non_null(values);
    size_t got = 0;
    assert_ok(snow_field_copy(grid, field, rect, values, wanted, &got));
    assert_int_equal(wanted, got);
    if (count != NULL)
        *count = wanted;
    return values;
}

void set_cell(snow_grid *grid, snow_field field, int32_t q, int32_t r, double value)
{
    assert_ok(snow_field_set(grid, field, &(snow_rect){q, r, 1, 1}, &value, 1));
}

void assert_same_field(const snow_grid *expected, const snow_grid *got, snow_field field)
{
    snow_rect rect = widened(bounds_of(expected));
    size_t count;
    double *left = copy_field(expected, field, &rect, &count);
    double *right = copy_field(got, field, &rect, NULL);
    for (size_t i = 0; i < count; i++) {
        if (memcmp(&left[i], &right[i], sizeof left[i]) != 0) {
            print_error("field %d of cell (%d, %d) after step %lld is %a, not %a\n", (int)field,
                        rect.q + (int32_t)(i % (size_t)rect.width), rect.r + (int32_t)(i / (size_t)rect.width),
                        (long long)steps_of(expected), right[i], left[i]);
            fail();
        }
    }
    free(left);
    free(right);
}

void assert_same_grids(const snow_grid *expected, const snow_grid *got)
{
    static const snow_field fields[] = {SNOW_FIELD_INSIDE,   SNOW_FIELD_FROZEN,   SNOW_FIELD_RECEPTIVE,
                                        SNOW_FIELD_VALUE,    SNOW_FIELD_VAPOUR,   SNOW_FIELD_ADDITION,
                                        SNOW_FIELD_BACKGROUND};
    assert_int_equal(steps_of(expected), steps_of(got));
    for (size_t i = 0; i < COUNT_OF(fields); i++)
        assert_same_field(expected, got, fields[i]);
    if (records_freeze_steps(expected) && records_freeze_steps(got))
        assert_same_field(expected, got, SNOW_FIELD_FREEZE_STEP);
    assert_int_equal(frozen_of(expected), frozen_of(got));
    assert_same_double(tip_of(expected), tip_of(got));
    snow_rect left, right;
    assert_ok(snow_frozen_bounds(expected, &left));
    assert_ok(snow_frozen_bounds(got, &right));
    assert_memory_equal(&left, &right, sizeof left);
    assert_true(digest_of(expected) == digest_of(got));
}

void assert_same_ice(const snow_grid *expected, const snow_grid *got)
{
    assert_int_equal(steps_of(expected), steps_of(got));
    assert_same_field(expected, got, SNOW_FIELD_FROZEN);
}

bool records_freeze_steps(const snow_grid *grid)
{
    double step;
    return snow_cell_value(grid, SNOW_FIELD_FREEZE_STEP, 0, 0, &step) == SNOW_OK;
}

size_t available_isas(snow_isa isas[8])
{
    size_t count = 0;
    for (int isa = SNOW_ISA_BASELINE; isa < 8; isa++)
        if (snow_isa_available((snow_isa)isa))
            isas[count++] = (snow_isa)isa;
    assert_true(count >= 1);
    return count;
}

/* The linear congruential generator of Knuth's MMIX, upper bits. */
uint32_t next_below(uint64_t *state, uint32_t limit)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)(((*state >> 32) * limit) >> 32);
}
