/* Where a million walks end on each cluster whose exact chances are known, and on larger ones that are solved. */
#include "support/aggregates.h"

static void a_million_walks_end_as_they_should(void **state)
{
    (void)state;
    check_known_clusters(SNOW_AGGREGATE_ENGINE_JUMPS, 1000000, 1000000);
    check_grown_cluster(SNOW_AGGREGATE_ENGINE_JUMPS, 1000000, 1000000);
}

static void many_single_steps_end_as_they_should(void **state)
{
    (void)state;
    check_known_clusters(SNOW_AGGREGATE_ENGINE_STEPS, 30000, 2000);
    check_grown_cluster(SNOW_AGGREGATE_ENGINE_STEPS, 10000, 2000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_million_walks_end_as_they_should),
        cmocka_unit_test(many_single_steps_end_as_they_should),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
