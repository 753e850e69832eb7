/* Reiter 2005, fig. 3: how long the arms are after 10,000 steps. Slow: some seconds for each cell of the table. */
#include "support/grids.h"

typedef struct table_cell {
    double background, addition;
    double scanned; /* from the printed figure, ± 3 */
    double computed;
} table_cell;

static const table_cell table[] = {
    {0.1, 0, 27, 29},      {0.1, 0.0001, 29, 30}, {0.1, 0.001, 38, 40},  {0.1, 0.0035, 68, 69},
    {0.1, 0.01, 147, 149}, {0.2, 0, 83, 87},      {0.2, 0.0001, 86, 88}, {0.2, 0.001, 101, 103},
    {0.2, 0.0035, 140, 142},
};

static void grow_table(int32_t radius)
{
    for (size_t i = 0; i < COUNT_OF(table); i++) {
        snow_reiter_params params = disc_scene(table[i].background, table[i].addition, 1, radius);
        snow_grid *grid = make_grid(&params, NULL);
        snow_summary summary = run_grid(grid, NULL);
        assert_int_equal(SNOW_STOP_STEPS, summary.reason);
        assert_int_equal(10000, summary.steps);
        assert_same_double(table[i].computed, summary.tip_radius);
        assert_near(table[i].scanned, summary.tip_radius, 4);
        assert_same_double(0.0, defect_of(grid));
        snow_destroy(grid);
    }
}

/* The arms of the scanned figures end at 171 cells, as they do in a disc of radius 173. */
static void in_the_disc_of_the_scanned_figures(void **state)
{
    (void)state;
    grow_table(173);
}

static void in_the_disc_of_the_paper_s_text(void **state)
{
    (void)state;
    grow_table(200);
}

/* β = 0.2, γ = 0.01 is the first of its row to reach the edge, at 171 cells: when depends a little on the disc. */
static void the_first_arm_that_reaches_the_edge(void **state)
{
    (void)state;
    static const struct {
        int32_t radius;
        snow_stop_reason reason;
        int64_t steps;
    } edges[] = {{173, SNOW_STOP_RIM, 6902}, {175, SNOW_STOP_RADIUS, 6925}, {200, SNOW_STOP_RADIUS, 6939}};
    for (size_t i = 0; i < COUNT_OF(edges); i++) {
        snow_reiter_params params = disc_scene(0.2, 0.01, 1, edges[i].radius);
        snow_grid *grid = make_grid(&params, NULL);
        snow_stop stop = default_stop();
        stop.tip_radius = 171;
        snow_summary summary = run_grid(grid, &stop);
        assert_int_equal(edges[i].reason, summary.reason);
        assert_int_equal(edges[i].steps, summary.steps);
        assert_same_double(171, summary.tip_radius);
        snow_destroy(grid);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(in_the_disc_of_the_scanned_figures),
        cmocka_unit_test(in_the_disc_of_the_paper_s_text),
        cmocka_unit_test(the_first_arm_that_reaches_the_edge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
