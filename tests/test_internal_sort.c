/* Sorting in place: every count and size, with equal elements, against a plain sort. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/sort.h"

enum { MOST = 80, LARGEST = 40 };

/* The first byte decides. */
static int compare(const void *a, const void *b)
{
    const unsigned char *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static void fill(unsigned char *elements, size_t bytes, unsigned values)
{
    uint32_t number = 1 + values;
    for (size_t i = 0; i < bytes; i++) {
        number = number * 1664525 + 1013904223;
        elements[i] = (unsigned char)((number >> 16) % values);
    }
}

/* How often an element is in a list. */
static size_t occurrences(const unsigned char *list, size_t count, size_t size, const unsigned char *wanted)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++)
        found += memcmp(list + i * size, wanted, size) == 0;
    return found;
}

static void check_sort(size_t count, size_t size, unsigned values)
{
    unsigned char elements[MOST * LARGEST + 1], before[MOST * LARGEST + 1];
    fill(elements, count * size, values);
    elements[count * size] = 0xA7;
    memcpy(before, elements, sizeof before);
    snow_sort(elements, count, size, compare);
    assert_int_equal(0xA7, elements[count * size]);
    for (size_t i = 0; i < count; i++) {
        const unsigned char *element = elements + i * size;
        assert_true(i == 0 || compare(element - size, element) <= 0);
        assert_int_equal(occurrences(before, count, size, element), occurrences(elements, count, size, element));
    }
}

static void elements_are_sorted_and_none_is_lost(void **state)
{
    (void)state;
    static const size_t sizes[] = {1, 3, 8, 12, LARGEST};
    static const unsigned values[] = {1, 2, 7, 256};
    for (size_t count = 0; count <= MOST; count++)
        for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
            for (size_t k = 0; k < sizeof values / sizeof values[0]; k++)
                check_sort(count, sizes[i], values[k]);
}

/* Orders that are bad for some ways to sort. */
static void sorted_and_reversed_lists_are_sorted(void **state)
{
    (void)state;
    unsigned char up[MOST], down[MOST];
    for (size_t i = 0; i < MOST; i++) {
        up[i] = (unsigned char)i;
        down[MOST - 1 - i] = (unsigned char)i;
    }
    snow_sort(down, MOST, 1, compare);
    assert_memory_equal(up, down, MOST);
    snow_sort(up, MOST, 1, compare);
    assert_memory_equal(down, up, MOST);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elements_are_sorted_and_none_is_lost),
        cmocka_unit_test(sorted_and_reversed_lists_are_sorted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
