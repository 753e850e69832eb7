/* Packard's rules against what is known of them: the numbers of frozen cells after n steps from one seed on the plane,
   p(n). Formulas for powers of two are those that J. Gravner and D. Griffeath's work on these rules led to (Modeling
   snow crystal growth I, Experimental Mathematics 15 (2006) 421–444); they hold as far as they are tested here. */
#include "support/packard.h"

static const snow_packard_engine fast[] = {SNOW_PACKARD_ENGINE_TILES, SNOW_PACKARD_ENGINE_QUADTREE};

/* A151723 of the On-Line Encyclopedia of Integer Sequences, from its second term on. */
static void rule_0100000_is_a_known_sequence(void **state)
{
    (void)state;
    static const uint64_t terms[] = {1,    7,    13,   31,   37,   55,   85,   127,  133,  151,  181,  235,
                                     289,  331,  409,  499,  505,  523,  553,  607,  661,  715,  817,  967,
                                     1069, 1111, 1189, 1327, 1489, 1603, 1789, 1975, 1981, 1999, 2029, 2083,
                                     2137, 2191, 2293, 2443, 2545, 2599, 2701, 2875, 3097, 3295};
    for (int engine = SNOW_PACKARD_ENGINE_AUTO; engine <= SNOW_PACKARD_ENGINE_QUADTREE; engine++) {
        snow_packard_params params = packard_scene("0100000");
        params.engine = (snow_packard_engine)engine;
        snow_grid *grid = make_packard(&params, NULL);
        for (size_t n = 0; n < COUNT_OF(terms); n++) {
            assert_int_equal(terms[n], frozen_of(grid));
            assert_ok(snow_step(grid, 1));
        }
        snow_destroy(grid);
    }
}

static void known_counts_come_out(void **state)
{
    (void)state;
    static const struct {
        const char *rule;
        int64_t steps;
        uint64_t population;
    } known[] = {
        {"0100000", 100, 16381},   {"0100000", 1000, 1818877}, {"0101010", 100, 20629},
        {"0101010", 1000, 2355193}, {"0100010", 1000, 2282893}, {"0101100", 1000, 2738131},
    };
    for (size_t i = 0; i < COUNT_OF(known); i++)
        for (size_t k = 0; k < COUNT_OF(fast); k++)
            assert_int_equal(known[i].population, population_after(known[i].rule, fast[k], known[i].steps));
    assert_int_equal(UINT64_C(2095753148245),
                     population_after("0100000", SNOW_PACKARD_ENGINE_QUADTREE, INT64_C(1) << 20));
}

static void every_population_is_1_modulo_6(void **state)
{
    (void)state;
    for (uint32_t rule = 0; rule < 128; rule += 2) {
        snow_packard_params params = packard_scene("0000000");
        params.rule = rule;
        snow_grid *grid = make_packard(&params, NULL);
        for (int n = 0; n < 130; n++) {
            assert_int_equal(1, frozen_of(grid) % 6);
            assert_ok(snow_step(grid, 1));
        }
        assert_ok(snow_step(grid, 500));
        assert_int_equal(1, frozen_of(grid) % 6);
        snow_destroy(grid);
    }
}

/* With d1 = d2 = 1 every cell at distance n freezes in step n. */
static void rules_011_fill_the_hexagon(void **state)
{
    (void)state;
    for (uint32_t rest = 0; rest < 16; rest++) {
        snow_packard_params params = packard_scene("0110000");
        params.rule |= rest << 3;
        snow_grid *grid = make_packard(&params, NULL);
        for (uint64_t n = 0; n < 300; n += 3) {
            assert_int_equal(3 * n * n + 3 * n + 1, frozen_of(grid));
            assert_ok(snow_step(grid, 3));
        }
        snow_destroy(grid);
    }
}

static int one_bits(uint32_t n)
{
    int count = 0;
    for (; n > 0; n >>= 1)
        count += (int)(n & 1);
    return count;
}

/* With d1 = 1 and d2 = 0, 6·(2^w − 1) cells at distance n freeze in step n, n having w one bits. */
static void fronts_of_rules_010_follow_the_one_bits(void **state)
{
    (void)state;
    for (uint32_t rest = 0; rest < 16; rest += 5) {
        snow_packard_params params = packard_scene("0100000");
        params.rule |= rest << 3;
        params.record_freeze_steps = 1;
        snow_grid *grid = make_packard(&params, NULL);
        const int32_t reach = 70;
        assert_ok(snow_step(grid, reach));
        for (int32_t n = 1; n <= reach; n++) {
            int fresh = 0;
            for (int32_t i = 0; i < n; i++) /* one side of the hexagon, six times */
                fresh += value_at(grid, SNOW_FIELD_FREEZE_STEP, n - i, i) == n;
            assert_int_equal((1 << one_bits((uint32_t)n)) - 1, fresh);
        }
        snow_destroy(grid);
    }
}

/* a·4^k + b·2^k + c + d·F(k) + e·F(k + 1), divided; numbers of 128 bits as two of 64. */
typedef struct wide {
    uint64_t high, low;
} wide;

static wide plus(wide a, wide b)
{
    uint64_t low = a.low + b.low;
    return (wide){a.high + b.high + (low < a.low), low};
}

static wide times(wide a, uint32_t factor)
{
    wide product = {0, 0};
    for (uint32_t i = 0; i < factor; i++)
        product = plus(product, a);
    return product;
}

static wide negative(wide a)
{
    return plus((wide){~a.high, ~a.low}, (wide){0, 1});
}

static wide power_of_two(unsigned exponent)
{
    return exponent < 64 ? (wide){0, UINT64_C(1) << exponent} : (wide){UINT64_C(1) << (exponent - 64), 0};
}

static wide population_of(const char *rule, unsigned k)
{
    snow_packard_params params = packard_scene(rule);
    params.engine = SNOW_PACKARD_ENGINE_QUADTREE;
    snow_grid *grid = make_packard(&params, NULL);
    assert_ok(snow_step(grid, INT64_C(1) << k));
    wide population;
    assert_ok(snow_packard_population(grid, &population.high, &population.low));
    snow_destroy(grid);
    return population;
}

static void assert_wide(wide expected, wide got)
{
    assert_int_equal(expected.high, got.high);
    assert_int_equal(expected.low, got.low);
}

/* 2·p(2^k) = 5·4^k − 6·2^k + 18, for rules 13 and 135. */
static void powers_of_two_of_13_and_135(void **state)
{
    (void)state;
    for (unsigned k = 1; k <= 60; k++) {
        wide expected = plus(times(power_of_two(2 * k), 5), plus(negative(times(power_of_two(k), 6)), (wide){0, 18}));
        assert_wide(expected, times(population_of("B13/S0123456H", k), 2));
        assert_wide(expected, times(population_of("B135/S0123456H", k), 2));
    }
}

/* 3·4^k − 3·2^k + 7. */
static wide nearly_full(unsigned k)
{
    return plus(times(power_of_two(2 * k), 3), plus(negative(times(power_of_two(k), 3)), (wide){0, 7}));
}

/* p(2^k) is that for rules 136, 1346, 1356, 13456; for 1456 up to k = 20; 146 falls 24 short at 20. */
static void powers_of_two_of_136_and_its_kin(void **state)
{
    (void)state;
    static const char *const rules[] = {"B136/S0123456H", "B1346/S0123456H", "B1356/S0123456H", "B13456/S0123456H",
                                        "B1456/S0123456H", "B146/S0123456H"};
    for (size_t i = 0; i < COUNT_OF(rules); i++) {
        bool slow = i >= 4;
        for (unsigned k = 1; k <= (slow ? 16 : 60); k += slow ? 1 : 4)
            assert_wide(nearly_full(k), population_of(rules[i], k));
    }
    assert_wide(nearly_full(20), population_of("B1456/S0123456H", 20));
    assert_wide(nearly_full(19), population_of("B146/S0123456H", 19));
    assert_wide((wide){0, UINT64_C(3298531737583)}, population_of("B146/S0123456H", 20));
}

/* 22·p(2^k) = 63·4^k − 66·2^k + 154 − 24·F(k) + 36·F(k + 1), for rules 134 and 1345. */
static void powers_of_two_of_134_and_1345(void **state)
{
    (void)state;
    wide before = {0, 0}, fibonacci = {0, 1}; /* F(k − 1), F(k) */
    for (unsigned k = 1; k <= 60; k++) {
        wide next = plus(before, fibonacci);
        wide expected = plus(times(power_of_two(2 * k), 63), negative(times(power_of_two(k), 66)));
        expected = plus(expected, plus((wide){0, 154}, plus(negative(times(fibonacci, 24)), times(next, 36))));
        assert_wide(expected, times(population_of("B134/S0123456H", k), 22));
        assert_wide(expected, times(population_of("B1345/S0123456H", k), 22));
        before = fibonacci;
        fibonacci = next;
    }
}

static void bounded_planes_give_known_counts(void **state)
{
    (void)state;
    static const struct {
        const char *rule;
        uint64_t population;
    } known[] = {{"B1/S0123456H:T20,13", 165}, {"B1/S0123456H:P20,13", 175}};
    for (size_t i = 0; i < COUNT_OF(known); i++) {
        for (int engine = SNOW_PACKARD_ENGINE_REFERENCE; engine <= SNOW_PACKARD_ENGINE_TILES; engine++) {
            snow_packard_params params = packard_scene(known[i].rule);
            params.engine = (snow_packard_engine)engine;
            snow_grid *grid = make_packard(&params, NULL);
            assert_ok(snow_step(grid, 40));
            assert_int_equal(known[i].population, frozen_of(grid));
            snow_destroy(grid);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rule_0100000_is_a_known_sequence),
        cmocka_unit_test(known_counts_come_out),
        cmocka_unit_test(every_population_is_1_modulo_6),
        cmocka_unit_test(rules_011_fill_the_hexagon),
        cmocka_unit_test(fronts_of_rules_010_follow_the_one_bits),
        cmocka_unit_test(powers_of_two_of_13_and_135),
        cmocka_unit_test(powers_of_two_of_136_and_its_kin),
        cmocka_unit_test(powers_of_two_of_134_and_1345),
        cmocka_unit_test(bounded_planes_give_known_counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
