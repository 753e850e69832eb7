/* The fast engine's ice is that of arithmetic with 31 digits: every cell freezes in the same step, up to the same end.
   Slow: a quarter of an hour on two processors. */
#include "support/grids.h"

#include <stdlib.h>

typedef struct triple {
    double background, addition, diffusion;
    int32_t radius;
} triple;

/* Dendrites, stars, sectors and plates; decimal ties; every regime of the diffusion. */
static const triple matrix[] = {
    /* The longest first, so that the threads end together. */
    {.4, .0001, 1, 200},     {.35, .001, 1, 200},     {.4, .0001, 2.003, 200}, {.4, .001, 1, 200},
    {.6, .01, 1, 200},       {.9, .05, 1, 200},       {0, .01, 1, 100},        {.1, .01, 1, 100},
    {.2, .0035, 1, 100},     {.2, .01, 1, 100},       {.3, 0, 1, 100},         {.3, .0001, 1, 100},
    {.3, .001, 1, 100},      {.3, .0035, 1, 100},     {.3, .01, 1, 100},       {.35, .001, 1, 100},
    {.4, 0, 1, 100},         {.4, .0001, 1, 100},     {.4, .001, 1, 100},      {.4, .002, 1, 100},
    {.4, .0035, 1, 100},     {.4, .01, 1, 100},       {.4, .05, 1, 100},       {.5, 0, 1, 100},
    {.5, .0001, 1, 100},     {.5, .001, 1, 100},      {.5, .0035, 1, 100},     {.5, .01, 1, 100},
    {.6, 0, 1, 100},         {.6, .0001, 1, 100},     {.6, .001, 1, 100},      {.6, .01, 1, 100},
    {.7, .0001, 1, 100},     {.7, .001, 1, 100},      {.7, .0035, 1, 100},     {.8, 0, 1, 100},
    {.8, .002, 1, 100},      {.8, .01, 1, 100},       {.9, .0001, 1, 100},     {.9, .001, 1, 100},
    {.9, .1, 1, 100},        {.9, .05, 1, 100},       {.95, 0, 1, 100},        {.95, .05, 1, 100},
    {.95, .025, 1, 100},     {0, .1, 1, 100},         {.4, .0001, .5, 100},    {.4, .0001, .501, 100},
    {.4, .0001, .502, 100},  {.6, .001, .5, 100},     {.4, .0001, 2.003, 100}, {.5, .001, 2.003, 100},
    {.8, .0001, 2.003, 100}, {.4, .0001, 2.6, 100},   {.6, .001, 2.6, 100},    {.9, .0001, 2.6, 100},
    {.4, .001, 8. / 3, 100}, {.5, .0035, 1.5, 100},   {.3, .001, 2, 100},      {.7, .01, .1, 100},
};

/* cmocka's assertions hold in its own thread only, so the others leave notes. */
typedef struct outcome {
    snow_status status;
    snow_summary quad;
    snow_summary fast;
    size_t different; /* cells that freeze in another step, or in one of the two only */
} outcome;

static snow_reiter_params scene_of(const triple *it, snow_reiter_engine engine)
{
    snow_reiter_params params = disc_scene(it->background, it->addition, it->diffusion, it->radius);
    params.record_freeze_steps = 1;
    params.engine = engine;
    return params;
}

static snow_status create_quad(void *context, size_t index, const snow_options *options, snow_stop *stop,
                               snow_grid **grid)
{
    (void)context;
    (void)stop;
    snow_reiter_params params = scene_of(&matrix[index], SNOW_REITER_ENGINE_QUAD);
    return snow_reiter_create(&params, options, grid);
}

static snow_status count_differences(const snow_grid *a, const snow_grid *b, size_t *different)
{
    size_t count = 0;
    snow_status status = snow_field_copy(a, SNOW_FIELD_FREEZE_STEP, NULL, NULL, 0, &count);
    double *steps = malloc(2 * count * sizeof *steps);
    if (steps == NULL)
        return SNOW_ERROR_NO_MEMORY;
    if (status == SNOW_OK)
        status = snow_field_copy(a, SNOW_FIELD_FREEZE_STEP, NULL, steps, count, NULL);
    if (status == SNOW_OK)
        status = snow_field_copy(b, SNOW_FIELD_FREEZE_STEP, NULL, steps + count, count, NULL);
    *different = 0;
    for (size_t i = 0; i < count && status == SNOW_OK; i++)
        *different += steps[i] != steps[count + i];
    free(steps);
    return status;
}

static int compare_with_fast(void *context, size_t index, snow_status status, snow_grid *quad,
                             const snow_summary *summary)
{
    outcome *it = (outcome *)context + index;
    snow_reiter_params params = scene_of(&matrix[index], SNOW_REITER_ENGINE_AUTO);
    snow_grid *fast = NULL;
    it->quad = *summary;
    snow_summary_init(&it->fast, sizeof it->fast);
    if (status == SNOW_OK)
        status = snow_reiter_create(&params, NULL, &fast);
    if (status == SNOW_OK)
        status = snow_run(fast, NULL, &it->fast);
    if (status == SNOW_OK)
        status = count_differences(quad, fast, &it->different);
    it->status = status;
    snow_destroy(fast);
    return 0;
}

static void every_cell_freezes_when_it_should(void **state)
{
    (void)state;
    static outcome outcomes[COUNT_OF(matrix)];
    snow_options options = default_options();
    options.threads = 0;
    assert_ok(snow_sweep(COUNT_OF(matrix), create_quad, compare_with_fast, outcomes, NULL, &options));
    for (size_t i = 0; i < COUNT_OF(matrix); i++) {
        const triple *scene = &matrix[i];
        const outcome *it = &outcomes[i];
        print_message("beta %g gamma %g alpha %g R %d: %s, %lld steps, %llu cells, %zu differ\n", scene->background,
                      scene->addition, scene->diffusion, (int)scene->radius, snow_stop_name(it->fast.reason),
                      (long long)it->fast.steps, (unsigned long long)it->fast.frozen, it->different);
        assert_ok(it->status);
        assert_int_equal(it->quad.steps, it->fast.steps);
        assert_int_equal(it->quad.reason, it->fast.reason);
        assert_int_equal(0, it->different);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_cell_freezes_when_it_should),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
