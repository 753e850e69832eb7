/* Powers without libm, and whole numbers below a limit. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "aggregate/power.h"
#include "aggregate/stream.h"

static void powers_are_those_of_the_exponents_digits(void **state)
{
    (void)state;
    static const double exponents[] = {0, 0.25, 0.5, 0.7, 1, 1.5, 2, 2.75, 3, 4};
    for (double x = 1.0 / 16; x <= 1 << 20; x *= 3.7) {
        for (size_t i = 0; i < sizeof exponents / sizeof exponents[0]; i++) {
            double expected = pow(x, exponents[i]);
            assert_true(fabs(snow_power(x, exponents[i]) - expected) <= 1e-13 * expected);
        }
        assert_true(snow_power(x, 0) == 1 && snow_power(x, 1) == x);
        assert_true(snow_power(x, 2) == x * x && snow_power(x, 0.5) == sqrt(x));
    }
}

/* Limits of which 2^32 is no multiple, the greatest of them above half of it: draws that would favour some numbers are
   thrown away. */
static void numbers_below_a_limit_are_even(void **state)
{
    (void)state;
    enum { DRAWS = 60000, PARTS = 12 };
    static const uint32_t limits[] = {12, 1000000, UINT32_C(3) << 30, UINT32_MAX};
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        snow_stream stream = snow_stream_start(i, 0, 1);
        double chi_square = 0;
        double got[PARTS] = {0};
        for (int draw = 0; draw < DRAWS; draw++) {
            uint32_t number = snow_stream_below(&stream, limits[i]);
            assert_true(number < limits[i]);
            got[(uint64_t)number * PARTS / limits[i]]++;
        }
        for (int part = 0; part < PARTS; part++)
            chi_square += (got[part] - DRAWS / PARTS) * (got[part] - DRAWS / PARTS) / (DRAWS / PARTS);
        assert_true(chi_square < 38); /* 11 degrees of freedom: once in ten thousand */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_are_those_of_the_exponents_digits),
        cmocka_unit_test(numbers_below_a_limit_are_even),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
