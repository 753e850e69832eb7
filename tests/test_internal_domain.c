/* The domain that follows a crystal: a hexagon without a table. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/domain.h"

enum { REACH = 12 };

static bool holds(const snow_hexagon *hexagon, int64_t q, int64_t r)
{
    return q >= hexagon->least_q && q <= hexagon->greatest_q && r >= hexagon->least_r && r <= hexagon->greatest_r &&
           q + r >= hexagon->least_s && q + r <= hexagon->greatest_s;
}

/* Every way to ask agrees with the six bounds, cell by cell. */
static void check_domain(const snow_hexagon *crystal)
{
    snow_domain domain;
    snow_domain_follow(&domain, crystal);
    const snow_hexagon wider = {crystal->least_q - 1,    crystal->greatest_q + 1, crystal->least_r - 1,
                                crystal->greatest_r + 1, crystal->least_s - 1,    crystal->greatest_s + 1};
    uint64_t cells = 0;
    for (int64_t r = -2 * REACH; r <= 2 * REACH; r++) {
        snow_run_of_cells run = snow_domain_row(&domain, r);
        for (int64_t q = -2 * REACH; q <= 2 * REACH; q++) {
            bool inside = holds(&wider, q, r);
            assert_int_equal(inside, snow_domain_has(&domain, q, r));
            assert_int_equal(inside, q >= run.first && q < run.end);
            cells += inside;
        }
    }
    assert_false(domain.too_large);
    assert_true(cells == domain.cells);
}

static void a_followed_crystal_gives_its_hexagon(void **state)
{
    (void)state;
    static const snow_cell corners[][3] = {
        {{0, 0}, {0, 0}, {0, 0}}, {{3, -1}, {-2, 5}, {0, 0}}, {{-4, -4}, {5, 5}, {1, 0}}, {{7, -7}, {-7, 7}, {2, 2}}};
    for (size_t i = 0; i < sizeof corners / sizeof corners[0]; i++) {
        snow_hexagon crystal = snow_hexagon_empty();
        for (size_t k = 0; k < 3; k++)
            snow_hexagon_hold(&crystal, corners[i][k].q, corners[i][k].r);
        check_domain(&crystal);
    }
}

static void an_empty_crystal_gives_the_origin_and_its_neighbours(void **state)
{
    (void)state;
    snow_hexagon empty = snow_hexagon_empty();
    snow_domain domain;
    snow_domain_follow(&domain, &empty);
    assert_true(domain.cells == 7);
    assert_true(snow_domain_has(&domain, 0, 0) && snow_domain_has(&domain, -1, 1));
    assert_false(snow_domain_has(&domain, 1, 1));
}

static void a_crystal_that_reaches_too_far_is_told(void **state)
{
    (void)state;
    snow_hexagon crystal = snow_hexagon_empty();
    snow_domain domain;
    snow_hexagon_hold(&crystal, (INT64_C(1) << 30) - 2, 0);
    snow_domain_follow(&domain, &crystal);
    assert_false(domain.too_large);
    assert_int_equal((1 << 30) - 3, domain.bounds.q);
    snow_hexagon_hold(&crystal, (INT64_C(1) << 30) - 1, 0);
    snow_domain_follow(&domain, &crystal);
    assert_true(domain.too_large);
    assert_false(snow_domain_has(&domain, 0, 0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_followed_crystal_gives_its_hexagon),
        cmocka_unit_test(an_empty_crystal_gives_the_origin_and_its_neighbours),
        cmocka_unit_test(a_crystal_that_reaches_too_far_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
