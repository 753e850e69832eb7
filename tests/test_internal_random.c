/* Philox4x32-10 against the known answers of its authors' library, Random123 1.09 (file kat_vectors). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/random.h"

static void known_answers(void **state)
{
    (void)state;
    static const struct {
        uint32_t counter[4], key[2], drawn[4];
    } answers[] = {
        {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
        {{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
         {0xffffffff, 0xffffffff},
         {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
        {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
         {0xa4093822, 0x299f31d0},
         {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
    };
    for (size_t i = 0; i < sizeof answers / sizeof answers[0]; i++) {
        const uint32_t *counter = answers[i].counter;
        uint64_t key = (uint64_t)answers[i].key[1] << 32 | answers[i].key[0];
        snow_random_block drawn =
            snow_random_draw(key, (snow_random_block){{counter[0], counter[1], counter[2], counter[3]}});
        for (int k = 0; k < 4; k++)
            assert_int_equal(answers[i].drawn[k], drawn.word[k]);
    }
}

static void numbers_of_a_cell_are_the_upper_bits_of_its_draw(void **state)
{
    (void)state;
    /* Counter (q, r, turn, use), first two words, lowest first. */
    uint64_t key = UINT64_C(0x0123456789abcdef);
    snow_random_block counter = {{(uint32_t)-3, 7, 2, SNOW_RANDOM_CLUSTER}};
    snow_random_block drawn = snow_random_draw(key, counter);
    double expected = (double)(((uint64_t)drawn.word[1] << 32 | drawn.word[0]) >> 11) / 9007199254740992.0;
    assert_true(expected == snow_random_at(key, SNOW_RANDOM_CLUSTER, -3, 7, 2));
}

static void numbers_fill_the_unit_interval_evenly(void **state)
{
    (void)state;
    enum { SIDE = 300, BINS = 16 };
    int counts[BINS] = {0};
    for (int32_t q = -SIDE / 2; q < SIDE / 2; q++) {
        for (int32_t r = -SIDE / 2; r < SIDE / 2; r++) {
            double number = snow_random_at(1, SNOW_RANDOM_NOISE, q, r, 0);
            assert_true(number >= 0 && number < 1);
            counts[(int)(number * BINS)]++;
        }
    }
    /* Chi squared with 15 degrees of freedom exceeds 44 once in ten thousand. */
    double expected = (double)SIDE * SIDE / BINS;
    double chi_squared = 0;
    for (int i = 0; i < BINS; i++)
        chi_squared += (counts[i] - expected) * (counts[i] - expected) / expected;
    assert_true(chi_squared < 44);
}

static void every_argument_matters(void **state)
{
    (void)state;
    double start = snow_random_at(5, SNOW_RANDOM_NOISE, 1, 2, 3);
    assert_true(start == snow_random_at(5, SNOW_RANDOM_NOISE, 1, 2, 3));
    assert_true(start != snow_random_at(6, SNOW_RANDOM_NOISE, 1, 2, 3));
    assert_true(start != snow_random_at(5 + (UINT64_C(1) << 32), SNOW_RANDOM_NOISE, 1, 2, 3));
    assert_true(start != snow_random_at(5, SNOW_RANDOM_CLUSTER, 1, 2, 3));
    assert_true(start != snow_random_at(5, SNOW_RANDOM_NOISE, 2, 1, 3));
    assert_true(start != snow_random_at(5, SNOW_RANDOM_NOISE, -1, 2, 3));
    assert_true(start != snow_random_at(5, SNOW_RANDOM_NOISE, 1, 2, 4));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_answers),
        cmocka_unit_test(numbers_of_a_cell_are_the_upper_bits_of_its_draw),
        cmocka_unit_test(numbers_fill_the_unit_interval_evenly),
        cmocka_unit_test(every_argument_matters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
