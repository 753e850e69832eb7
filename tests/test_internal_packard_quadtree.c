/* The quadtree engine against a byte a cell, against the known populations of the rules, and with little memory. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "packard/quadtree.h"

#include <stdlib.h>
#include <string.h>

/* --- memory that can be refused --- */

typedef struct memory {
    size_t calls, fail_at; /* refuses this call and all later ones; 0: none */
    size_t blocks;
} memory;

static void *allocate(void *context, size_t size)
{
    memory *from = context;
    from->calls++;
    if (from->fail_at != 0 && from->calls >= from->fail_at)
        return NULL;
    void *block = malloc(size);
    from->blocks += block != NULL;
    return block;
}

static void release(void *context, void *block)
{
    memory *to = context;
    to->blocks--;
    free(block);
}

static snow_heap heap_of(memory *from, uint64_t limit)
{
    snow_options options;
    snow_options_init(&options, sizeof options);
    options.allocate = allocate;
    options.release = release;
    options.allocator_context = from;
    options.memory_limit = limit;
    snow_heap heap;
    snow_heap_start(&heap, &options);
    return heap;
}

/* --- a tree on a heap of its own --- */

typedef struct scene {
    memory memory;
    snow_heap heap;
    snow_quadtree *tree;
} scene;

static void open_scene(scene *with, uint8_t rule, uint64_t limit)
{
    with->memory = (memory){0};
    with->heap = heap_of(&with->memory, limit);
    with->tree = NULL;
    assert_int_equal(SNOW_OK, snow_quadtree_create(&with->heap, rule, &with->tree));
}

static void close_scene(scene *with)
{
    snow_quadtree_destroy(with->tree);
    assert_int_equal(0, with->memory.blocks);
    assert_int_equal(0, with->heap.used);
}

static void put_cell(snow_quadtree *tree, int64_t q, int64_t r)
{
    const uint64_t one = 1;
    assert_int_equal(SNOW_OK, snow_quadtree_put(tree, q, r, 1, 1, &one, 1));
}

static void open_seed(scene *with, uint8_t rule, uint64_t limit)
{
    open_scene(with, rule, limit);
    put_cell(with->tree, 0, 0);
}

static quadtree_measures measures_of(snow_quadtree *tree)
{
    quadtree_measures measures;
    assert_int_equal(SNOW_OK, snow_quadtree_measure(tree, &measures));
    return measures;
}

/* --- numbers of 128 bits --- */

static quadtree_count number(uint64_t low)
{
    return (quadtree_count){0, low};
}

static quadtree_count plus(quadtree_count a, quadtree_count b)
{
    uint64_t low = a.low + b.low;
    return (quadtree_count){a.high + b.high + (low < a.low), low};
}

static quadtree_count minus(quadtree_count a, quadtree_count b)
{
    return (quadtree_count){a.high - b.high - (a.low < b.low), a.low - b.low};
}

static quadtree_count times(uint64_t factor, quadtree_count a)
{
    quadtree_count product = {0, 0};
    for (; factor != 0; factor >>= 1) {
        if (factor & 1)
            product = plus(product, a);
        a = plus(a, a);
    }
    return product;
}

static quadtree_count power(int exponent)
{
    return exponent < 64 ? (quadtree_count){0, UINT64_C(1) << exponent}
                         : (quadtree_count){UINT64_C(1) << (exponent - 64), 0};
}

static void assert_count(quadtree_count expected, quadtree_count got)
{
    assert_int_equal(expected.high, got.high);
    assert_int_equal(expected.low, got.low);
}

/* --- the plain reading: a byte a cell --- */

enum { SPAN = 96, MIDDLE = SPAN / 2, SPAN_WORDS = (SPAN + 63) / 64 };

typedef struct plain {
    uint8_t frozen[SPAN][SPAN]; /* [r + MIDDLE][q + MIDDLE]; the rim stays empty */
} plain;

static void plain_step(plain *cells, uint8_t rule)
{
    static plain before;
    before = *cells;
    for (int r = 1; r < SPAN - 1; r++) {
        for (int q = 1; q < SPAN - 1; q++) {
            int neighbours = before.frozen[r][q - 1] + before.frozen[r][q + 1] + before.frozen[r - 1][q] +
                             before.frozen[r + 1][q] + before.frozen[r - 1][q + 1] + before.frozen[r + 1][q - 1];
            if (rule >> neighbours & 1) {
                cells->frozen[r][q] = 1;
            }
        }
    }
}

static uint32_t next_below(uint64_t *state, uint32_t limit)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)((*state >> 32) * limit >> 32);
}

/* A patch of random cells, put in both; somewhere, of some density. */
static void scatter(plain *cells, snow_quadtree *tree, uint64_t *random)
{
    enum { PATCH = 20 };
    uint64_t rows[PATCH] = {0};
    uint32_t width = 1 + next_below(random, PATCH);
    uint32_t height = 1 + next_below(random, PATCH);
    int q = (int)next_below(random, 10) - (int)width;
    int r = (int)next_below(random, 10) - (int)height;
    uint32_t density = 1 + next_below(random, 8);
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            bool frozen = next_below(random, 8) < density;
            rows[y] |= (uint64_t)frozen << x;
            cells->frozen[r + (int)y + MIDDLE][q + (int)x + MIDDLE] = frozen;
        }
    }
    assert_int_equal(SNOW_OK, snow_quadtree_put(tree, q, r, width, height, rows, 1));
}

static void assert_same_cells(const plain *expected, const snow_quadtree *tree)
{
    uint64_t rows[SPAN][SPAN_WORDS];
    memset(rows, 0xff, sizeof rows);
    snow_quadtree_copy(tree, -MIDDLE, -MIDDLE, SPAN, SPAN, rows[0], SPAN_WORDS);
    for (int r = 0; r < SPAN; r++) {
        for (int q = 0; q < SPAN; q++)
            assert_int_equal(expected->frozen[r][q], rows[r][q / 64] >> q % 64 & 1);
    }
}

static void assert_same_measures(const plain *expected, const quadtree_measures *got)
{
    uint64_t population = 0, tip_square = 0;
    int64_t least[3] = {SPAN, SPAN, 2 * SPAN}, greatest[3] = {-SPAN, -SPAN, -2 * SPAN};
    for (int r = -MIDDLE; r < MIDDLE; r++) {
        for (int q = -MIDDLE; q < MIDDLE; q++) {
            if (!expected->frozen[r + MIDDLE][q + MIDDLE])
                continue;
            const int64_t along[3] = {q, r, q + r};
            for (int i = 0; i < 3; i++) {
                least[i] = along[i] < least[i] ? along[i] : least[i];
                greatest[i] = along[i] > greatest[i] ? along[i] : greatest[i];
            }
            uint64_t square = (uint64_t)(q * q + q * r + r * r);
            tip_square = square > tip_square ? square : tip_square;
            population++;
        }
    }
    assert_count(number(population), got->population);
    for (int i = 0; population != 0 && i < 3; i++) {
        assert_int_equal(least[i], got->least[i]);
        assert_int_equal(greatest[i], got->greatest[i]);
    }
    assert_count(number(tip_square), got->tip_square);
}

static void assert_like_plain(const plain *expected, snow_quadtree *got)
{
    quadtree_measures measures = measures_of(got);
    assert_same_cells(expected, got);
    assert_same_measures(expected, &measures);
}

enum { RULES = 128 }; /* those with d0 = 0 are even */

static void every_rule_grows_as_the_plain_reading_says(void **state)
{
    (void)state;
    uint64_t random = 4;
    for (int rule = 0; rule < RULES; rule += 2) {
        for (int pass = 0; pass < 3; pass++) {
            static plain cells;
            scene with;
            memset(&cells, 0, sizeof cells);
            open_scene(&with, (uint8_t)rule, 0);
            scatter(&cells, with.tree, &random);
            for (int left = 26; left > 0;) {
                int steps = 1 + (int)next_below(&random, (uint32_t)left);
                left -= steps;
                assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, (uint64_t)steps));
                for (int step = 0; step < steps; step++)
                    plain_step(&cells, (uint8_t)rule);
                assert_like_plain(&cells, with.tree);
            }
            close_scene(&with);
        }
    }
}

static void seeds_may_be_put_while_the_crystal_grows(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (int pass = 0; pass < 20; pass++) {
        static plain cells;
        scene with;
        uint8_t rule = (uint8_t)(2 * next_below(&random, RULES / 2));
        memset(&cells, 0, sizeof cells);
        open_scene(&with, rule, 0);
        for (int turn = 0; turn < 5; turn++) {
            scatter(&cells, with.tree, &random);
            uint32_t steps = next_below(&random, 5);
            assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, steps));
            for (uint32_t step = 0; step < steps; step++)
                plain_step(&cells, rule);
            assert_like_plain(&cells, with.tree);
        }
        close_scene(&with);
    }
}

/* --- what is known of the rules --- */

static uint8_t rule_of(const char *digits)
{
    uint8_t rule = 0;
    for (; *digits != '\0'; digits++)
        rule |= (uint8_t)(1U << (*digits - '0'));
    return rule;
}

/* The population of one seed after so many steps. */
static quadtree_count population_after(uint8_t rule, uint64_t steps)
{
    scene with;
    open_seed(&with, rule, 0);
    assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, steps));
    quadtree_count population = measures_of(with.tree).population;
    close_scene(&with);
    return population;
}

static void populations_are_one_more_than_a_multiple_of_six(void **state)
{
    (void)state;
    for (int rule = 0; rule < RULES; rule += 2) {
        for (uint64_t steps = 1; steps < 300; steps = steps * 3 + 1)
            assert_int_equal(1, population_after((uint8_t)rule, steps).low % 6);
    }
}

static void one_and_two_neighbours_fill_the_hexagon(void **state)
{
    (void)state;
    for (int more = 0; more < RULES; more += 8) {
        uint8_t rule = (uint8_t)(6 + more);
        for (int k = 0; k <= 61; k += 3) {
            /* 3n² + 3n + 1 */
            quadtree_count expected = plus(times(3, plus(power(2 * k), power(k))), number(1));
            assert_count(expected, population_after(rule, UINT64_C(1) << k));
        }
    }
}

static void one_and_not_two_freezes_rings(void **state)
{
    (void)state;
    for (int more = 0; more < RULES; more += 8) {
        scene with;
        open_seed(&with, (uint8_t)(2 + more), 0);
        for (int64_t n = 1; n <= 70; n++) {
            /* At hex distance n: 6·(2^w − 1) cells, w = number of one bits of n. */
            int64_t expected = 1;
            for (int64_t bits = n; bits != 0; bits &= bits - 1)
                expected *= 2;
            assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, 1));
            int64_t ring = 0;
            for (int64_t q = -n; q <= n; q++) {
                for (int64_t r = -n; r <= n; r++) {
                    int64_t distance = (llabs(q) + llabs(r) + llabs(q + r)) / 2;
                    ring += distance == n && snow_quadtree_get(with.tree, q, r);
                }
            }
            assert_int_equal(6 * (expected - 1), ring);
        }
        close_scene(&with);
    }
}

/* Holds a rule's populations after 2^k steps, k = 1 to `last`, against a formula:
   each from the one before, and some from the seed at one go. */
static void assert_powers(const char *digits, int last, void (*check)(int k, quadtree_count population))
{
    scene with;
    open_seed(&with, rule_of(digits), 0);
    assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, 1));
    for (int k = 1; k <= last; k++) {
        assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, UINT64_C(1) << (k - 1)));
        check(k, measures_of(with.tree).population);
        if (k % 12 == 0)
            check(k, population_after(rule_of(digits), UINT64_C(1) << k));
    }
    close_scene(&with);
}

/* (5/2)·4^k − 3·2^k + 9 */
static void check_five_sixths(int k, quadtree_count population)
{
    assert_count(plus(minus(times(5, power(2 * k - 1)), times(3, power(k))), number(9)), population);
}

/* 22·p = 63·4^k − 66·2^k + 154 − 24·F(k) + 36·F(k + 1) */
static void check_fibonacci(int k, quadtree_count population)
{
    uint64_t fibonacci = 0, next = 1;
    for (int i = 0; i < k; i++) {
        uint64_t sum = fibonacci + next;
        fibonacci = next;
        next = sum;
    }
    quadtree_count positive = plus(plus(times(63, power(2 * k)), number(154)), times(36, number(next)));
    quadtree_count negative = plus(times(66, power(k)), times(24, number(fibonacci)));
    assert_count(minus(positive, negative), times(22, population));
}

/* 3·4^k − 3·2^k + 7 */
static void check_nearly_full(int k, quadtree_count population)
{
    assert_count(plus(minus(times(3, power(2 * k)), times(3, power(k))), number(7)), population);
}

static void populations_at_powers_of_two(void **state)
{
    (void)state;
    assert_powers("13", 60, check_five_sixths);
    assert_powers("135", 60, check_five_sixths);
    assert_powers("134", 60, check_fibonacci);
    assert_powers("1345", 60, check_fibonacci);
    assert_powers("136", 60, check_nearly_full);
    assert_powers("1346", 60, check_nearly_full);
    assert_powers("1356", 60, check_nearly_full);
    assert_powers("13456", 60, check_nearly_full);
    assert_powers("146", 14, check_nearly_full);
    assert_powers("1456", 14, check_nearly_full);
}

static void rule_1_is_the_known_sequence(void **state)
{
    (void)state;
    /* OEIS A151723, from its second term on. */
    static const uint64_t terms[] = {1,   7,   13,  31,  37,  55,  85,  127, 133, 151, 181, 235, 289,
                                     331, 409, 499, 505};
    for (uint64_t n = 0; n < sizeof terms / sizeof terms[0]; n++)
        assert_count(number(terms[n]), population_after(rule_of("1"), n));
    assert_count(number(16381), population_after(rule_of("1"), 100));
    assert_count(number(1818877), population_after(rule_of("1"), 1000));
    assert_count(number(8186583625), population_after(rule_of("1"), 1 << 16));
    assert_count(number(20629), population_after(rule_of("135"), 100));
    assert_count(number(2355193), population_after(rule_of("135"), 1000));
    assert_count(number(2282893), population_after(rule_of("15"), 1000));
    assert_count(number(2738131), population_after(rule_of("134"), 1000));
}

/* --- how the run is divided does not matter --- */

static void steps_add_up(void **state)
{
    (void)state;
    uint64_t random = 6;
    for (int pass = 0; pass < 30; pass++) {
        uint8_t rule = (uint8_t)(2 * next_below(&random, RULES / 2));
        uint64_t first = next_below(&random, 300), second = next_below(&random, 300);
        scene once, twice;
        open_seed(&once, rule, 0);
        open_seed(&twice, rule, 0);
        put_cell(once.tree, 5, 9);
        put_cell(twice.tree, 5, 9);
        assert_int_equal(SNOW_OK, snow_quadtree_advance(once.tree, first + second));
        assert_int_equal(SNOW_OK, snow_quadtree_advance(twice.tree, first));
        assert_int_equal(SNOW_OK, snow_quadtree_advance(twice.tree, second));
        enum { WORDS = 20, SIDE = WORDS * 64 };
        static uint64_t a[SIDE][WORDS], b[SIDE][WORDS];
        snow_quadtree_copy(once.tree, -SIDE / 2, -SIDE / 2, SIDE, SIDE, a[0], WORDS);
        snow_quadtree_copy(twice.tree, -SIDE / 2, -SIDE / 2, SIDE, SIDE, b[0], WORDS);
        assert_memory_equal(a, b, sizeof a);
        close_scene(&once);
        close_scene(&twice);
    }
}

static void stillness_is_found_by_looking_ahead(void **state)
{
    (void)state;
    uint64_t random = 10;
    int still = 0;
    for (int rule = 0; rule < RULES; rule += 2) {
        static plain cells, next;
        scene with;
        memset(&cells, 0, sizeof cells);
        open_scene(&with, (uint8_t)rule, 0);
        scatter(&cells, with.tree, &random);
        for (int step = 0; step < 20; step++) {
            next = cells;
            plain_step(&next, (uint8_t)rule);
            bool expected = memcmp(&cells, &next, sizeof next) == 0;
            assert_int_equal(expected, snow_quadtree_is_still(with.tree));
            assert_same_cells(&cells, with.tree);
            assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, 1));
            cells = next;
            still += expected;
        }
        close_scene(&with);
    }
    assert_true(still > 0);
}

static void stillness_ends_at_the_root(void **state)
{
    (void)state;
    /* The next cell lies beyond all nodes of the root. */
    for (int64_t q = 1; q < 40; q++) {
        scene with;
        open_scene(&with, rule_of("1"), 0);
        assert_true(snow_quadtree_is_still(with.tree));
        put_cell(with.tree, q, -q);
        assert_false(snow_quadtree_is_still(with.tree));
        close_scene(&with);
    }
}

static void known_results_are_no_work(void **state)
{
    (void)state;
    scene with;
    open_seed(&with, rule_of("1"), 0);
    snow_quadtree_keep(with.tree);
    uint64_t before = snow_quadtree_work(with.tree);
    assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, 1024));
    uint64_t after = snow_quadtree_work(with.tree);
    assert_true(after > before);
    snow_quadtree_restore(with.tree);
    assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, 1024));
    assert_int_equal(after, snow_quadtree_work(with.tree));
    close_scene(&with);
}

static void what_was_kept_comes_back(void **state)
{
    (void)state;
    scene with;
    open_seed(&with, rule_of("1"), 0);
    snow_quadtree_restore(with.tree);
    assert_count(number(0), measures_of(with.tree).population);
    assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, 7));
    assert_count(number(0), measures_of(with.tree).population);
    put_cell(with.tree, 0, 0);
    snow_quadtree_keep(with.tree);
    for (uint64_t steps = 100; steps <= 1000; steps *= 10) {
        assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, steps));
        assert_count(number(steps == 100 ? 16381 : 1818877), measures_of(with.tree).population);
        snow_quadtree_restore(with.tree);
        assert_count(number(1), measures_of(with.tree).population);
    }
    close_scene(&with);
}

/* --- coordinates --- */

static void regions_are_put_and_copied_at_any_place(void **state)
{
    (void)state;
    static const int64_t corners[] = {0, -70, 1000003, -(INT64_C(1) << 40) - 5, INT64_C(1) << 60,
                                      SNOW_QUADTREE_REACH - 300, -SNOW_QUADTREE_REACH};
    enum { WORDS = 4, HEIGHT = 90 };
    uint64_t random = 7;
    for (size_t i = 0; i < sizeof corners / sizeof corners[0]; i++) {
        for (int64_t width = 1; width <= 200; width += 33) {
            int64_t q = corners[i], r = corners[(i + 3) % 7];
            uint64_t bits[HEIGHT][WORDS] = {{0}}, got[HEIGHT + 2][WORDS];
            uint64_t population = 0;
            for (int y = 0; y < HEIGHT; y++) {
                for (int x = 0; x < width; x++) {
                    uint64_t frozen = next_below(&random, 2);
                    bits[y][x / 64] |= frozen << x % 64;
                    population += frozen;
                }
            }
            scene with;
            open_scene(&with, 0, 0);
            assert_int_equal(SNOW_OK, snow_quadtree_put(with.tree, q, r, width, HEIGHT, bits[0], WORDS));
            assert_count(number(population), measures_of(with.tree).population);
            memset(got, 0xff, sizeof got);
            snow_quadtree_copy(with.tree, q, r, width, HEIGHT, got[1], WORDS);
            for (int y = 0; y < HEIGHT; y++) {
                assert_memory_equal(bits[y], got[y + 1], (size_t)(width + 63) / 64 * 8);
                assert_int_equal(bits[y][0] & 1, snow_quadtree_get(with.tree, q, r + y));
            }
            assert_int_equal(UINT64_MAX, got[0][0]);
            assert_int_equal(UINT64_MAX, got[HEIGHT + 1][0]);
            /* Cleared again, but for its first row. */
            memset(got, 0, sizeof got);
            assert_int_equal(SNOW_OK, snow_quadtree_put(with.tree, q, r + 1, width, HEIGHT - 1, got[0], WORDS));
            for (int64_t x = 0; x < width; x++) {
                assert_int_equal(bits[0][x / 64] >> x % 64 & 1, snow_quadtree_get(with.tree, q + x, r));
                assert_false(snow_quadtree_get(with.tree, q + x, r + 1));
            }
            close_scene(&with);
        }
    }
}

/* From 0 to a number that may have 63 bits. */
static int64_t far_below(uint64_t *random, int64_t greatest)
{
    uint64_t upper = next_below(random, UINT32_MAX), lower = next_below(random, UINT32_MAX);
    return (int64_t)((upper << 31 | lower) % ((uint64_t)greatest + 1));
}

/* Squares that are passed over hold nothing, and each that is shown comes once, in its order. */
static void squares_with_cells_are_found_in_order(void **state)
{
    (void)state;
    static const int64_t sizes[] = {5, 20, 40, 300, 5000, 1 << 20, SNOW_QUADTREE_REACH};
    uint64_t stream = 77;
    for (size_t size = 0; size < sizeof sizes / sizeof sizes[0]; size++) {
        enum { CELLS = 40 };
        scene with;
        int64_t cells[CELLS][2];
        bool seen[CELLS] = {false};
        open_scene(&with, rule_of("1"), 0);
        for (int i = 0; i < CELLS; i++) {
            for (int axis = 0; axis < 2; axis++)
                cells[i][axis] = (next_below(&stream, 2) == 0 ? 1 : -1) * far_below(&stream, sizes[size]);
            put_cell(with.tree, cells[i][0], cells[i][1]);
        }
        int64_t last_q = INT64_MIN, last_r = INT64_MIN;
        int64_t q = -SNOW_QUADTREE_REACH, r = -SNOW_QUADTREE_REACH;
        for (; snow_quadtree_next(with.tree, &q, &r); q += 64) {
            assert_true(q % 64 == 0 && r % 64 == 0);
            assert_true(r > last_r || (r == last_r && q > last_q));
            last_q = q;
            last_r = r;
            for (int i = 0; i < CELLS; i++)
                seen[i] = seen[i] || (cells[i][0] >= q && cells[i][0] < q + 64 && cells[i][1] >= r &&
                                      cells[i][1] < r + 64);
        }
        for (int i = 0; i < CELLS; i++)
            assert_true(seen[i]);
        close_scene(&with);
    }
}

static void distances_are_measured_from_the_centre(void **state)
{
    (void)state;
    scene with;
    open_scene(&with, rule_of("1"), 0);
    put_cell(with.tree, 10, 0);
    put_cell(with.tree, -4, 2);
    assert_count(number(100), measures_of(with.tree).tip_square);
    snow_quadtree_set_centre(with.tree, 10, 0);
    assert_count(number(14 * 14 - 14 * 2 + 2 * 2), measures_of(with.tree).tip_square);
    snow_quadtree_keep(with.tree);
    snow_quadtree_set_centre(with.tree, -(INT64_C(1) << 40), 0);
    snow_quadtree_restore(with.tree);
    assert_count(times((UINT64_C(1) << 40) + 10, number((UINT64_C(1) << 40) + 10)), measures_of(with.tree).tip_square);
    close_scene(&with);
}

static void the_reach_is_kept(void **state)
{
    (void)state;
    const uint64_t one = 1;
    const int64_t reach = SNOW_QUADTREE_REACH;
    scene with;
    open_seed(&with, rule_of("135"), 0);
    assert_int_equal(SNOW_ERROR_TOO_LARGE, snow_quadtree_put(with.tree, reach + 1, 0, 1, 1, &one, 1));
    assert_int_equal(SNOW_ERROR_TOO_LARGE, snow_quadtree_put(with.tree, 0, -reach - 1, 1, 1, &one, 1));
    assert_int_equal(SNOW_ERROR_TOO_LARGE, snow_quadtree_advance(with.tree, (uint64_t)reach + 1));
    assert_int_equal(SNOW_ERROR_TOO_LARGE, snow_quadtree_advance(with.tree, UINT64_MAX));
    assert_count(number(1), measures_of(with.tree).population);
    assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, UINT64_C(1) << 62));
    quadtree_measures measures = measures_of(with.tree);
    assert_count(plus(minus(times(5, power(123)), times(3, power(62))), number(9)), measures.population);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(-(INT64_C(1) << 62), measures.least[i]);
        assert_int_equal(INT64_C(1) << 62, measures.greatest[i]);
    }
    assert_count(power(124), measures.tip_square);
    assert_true(snow_quadtree_get(with.tree, INT64_C(1) << 62, 0));
    assert_false(snow_quadtree_get(with.tree, (INT64_C(1) << 62) + 1, 0));
    assert_false(snow_quadtree_get(with.tree, INT64_MIN, INT64_MAX));
    close_scene(&with);
}

static void far_cells_are_measured_exactly(void **state)
{
    (void)state;
    const int64_t far = SNOW_QUADTREE_REACH;
    static const int signs[4][2] = {{1, 1}, {-1, -1}, {1, -1}, {-1, 1}};
    for (int i = 0; i < 4; i++) {
        scene with;
        open_scene(&with, rule_of("1"), 0);
        int64_t q = signs[i][0] * far, r = signs[i][1] * far;
        put_cell(with.tree, q, r);
        quadtree_measures measures = measures_of(with.tree);
        assert_count(number(1), measures.population);
        assert_int_equal(q, measures.least[0]);
        assert_int_equal(q, measures.greatest[0]);
        assert_int_equal(r, measures.least[1]);
        assert_int_equal(r, measures.greatest[1]);
        /* 5·2^60 squared, once or three times. */
        assert_count(times(i < 2 ? 75 : 25, power(120)), measures.tip_square);
        close_scene(&with);
    }
}

/* --- little memory --- */

static void a_limit_is_kept_and_the_result_exact(void **state)
{
    (void)state;
    enum { STEPS = 1 << 10, LEAST = 48000 };
    scene with;
    open_seed(&with, rule_of("1"), 0);
    assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, STEPS));
    quadtree_measures expected = measures_of(with.tree);
    uint64_t needed = with.heap.used;
    close_scene(&with);

    int exact = 0, refused = 0;
    for (uint64_t part = 1; part <= 40; part += 2) {
        uint64_t limit = LEAST + (needed - LEAST) / 41 * part;
        open_seed(&with, rule_of("1"), limit);
        snow_status status = snow_quadtree_advance(with.tree, STEPS);
        assert_true(with.heap.used <= limit);
        quadtree_measures measures = measures_of(with.tree);
        if (status == SNOW_OK) {
            assert_memory_equal(&expected, &measures, sizeof measures);
            exact++;
        } else {
            assert_int_equal(SNOW_ERROR_MEMORY_LIMIT, status);
            assert_count(number(1), measures.population);
            /* And it still works. */
            assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, 1));
            assert_count(number(7), measures_of(with.tree).population);
            refused++;
        }
        close_scene(&with);
    }
    /* Some limits were met by collecting, some were too small. */
    assert_true(exact > 3);
    assert_true(refused > 3);
}

static void collections_change_nothing(void **state)
{
    (void)state;
    uint64_t random = 8;
    for (int pass = 0; pass < 40; pass++) {
        static plain cells;
        scene with;
        uint8_t rule = (uint8_t)(2 * next_below(&random, RULES / 2));
        memset(&cells, 0, sizeof cells);
        open_scene(&with, rule, 50000);
        scatter(&cells, with.tree, &random);
        for (int turn = 0; turn < 26; turn++) {
            snow_status status = snow_quadtree_advance(with.tree, 1);
            if (status != SNOW_OK) {
                assert_int_equal(SNOW_ERROR_MEMORY_LIMIT, status);
                assert_same_cells(&cells, with.tree);
                break;
            }
            plain_step(&cells, rule);
            assert_like_plain(&cells, with.tree);
        }
        close_scene(&with);
    }
}

static void any_allocation_may_fail(void **state)
{
    (void)state;
    static plain start;
    uint64_t random = 9;
    for (size_t fail_at = 1;; fail_at++) {
        scene with = {.memory = {.fail_at = fail_at}};
        with.heap = heap_of(&with.memory, 0);
        snow_status status = snow_quadtree_create(&with.heap, rule_of("1"), &with.tree);
        if (status != SNOW_OK) {
            assert_int_equal(SNOW_ERROR_NO_MEMORY, status);
            assert_null(with.tree);
            assert_int_equal(0, with.memory.blocks);
            continue;
        }
        memset(&start, 0, sizeof start);
        scatter(&start, with.tree, &random);
        status = snow_quadtree_advance(with.tree, 200);
        if (status != SNOW_OK) {
            assert_int_equal(SNOW_ERROR_NO_MEMORY, status);
            assert_same_cells(&start, with.tree);
        }
        close_scene(&with);
        if (with.memory.calls < fail_at)
            break;
    }
}

/* --- saving --- */

typedef struct bytes {
    unsigned char data[1 << 17];
    size_t size;
} bytes;

static int write_bytes(void *context, const void *data, size_t size)
{
    bytes *to = context;
    assert_true(size <= sizeof to->data - to->size);
    memcpy(to->data + to->size, data, size);
    to->size += size;
    return 0;
}

/* The eight bytes at the end are the sink's checksum. */
static void save_tree(snow_quadtree *tree, bytes *to)
{
    enum { CHECKSUM = 8 };
    snow_sink sink;
    to->size = 0;
    snow_sink_start(&sink, write_bytes, to);
    snow_quadtree_save(tree, &sink);
    snow_sink_end(&sink);
    assert_false(sink.failed);
    to->size -= CHECKSUM;
}

static snow_status load_tree(scene *with, uint8_t rule, const bytes *from, size_t size)
{
    with->memory = (memory){0};
    with->heap = heap_of(&with->memory, 0);
    with->tree = NULL;
    snow_source source = {.next = from->data, .end = from->data + size};
    snow_status status = snow_quadtree_load(&with->heap, rule, &source, &with->tree);
    if (status == SNOW_OK)
        assert_ptr_equal(from->data + size, source.next);
    else
        assert_int_equal(0, with->memory.blocks);
    return status;
}

static void what_was_saved_goes_on(void **state)
{
    (void)state;
    static const struct {
        const char *digits;
        uint64_t first, second;
        int64_t aside; /* where a second seed makes the crystal irregular */
    } runs[] = {{"1", 0, 5, 0}, {"1", 100, 100, 7}, {"1", 3000, 500, 0}, {"135", UINT64_C(1) << 62, 100, 0},
                {"146", 777, 50, -40}};
    static bytes saved, again;
    for (size_t i = 0; i < sizeof runs / sizeof runs[0]; i++) {
        scene first, second;
        uint8_t rule = rule_of(runs[i].digits);
        open_seed(&first, rule, 0);
        put_cell(first.tree, runs[i].aside, -2 * runs[i].aside);
        assert_int_equal(SNOW_OK, snow_quadtree_advance(first.tree, runs[i].first));
        save_tree(first.tree, &saved);
        assert_int_equal(SNOW_OK, load_tree(&second, rule, &saved, saved.size));
        for (int turn = 0; turn < 2; turn++) {
            quadtree_measures expected = measures_of(first.tree), got = measures_of(second.tree);
            assert_memory_equal(&expected, &got, sizeof expected);
            enum { WORDS = 8, SIDE = 64 * WORDS };
            static uint64_t a[SIDE][WORDS], b[SIDE][WORDS];
            snow_quadtree_copy(first.tree, -SIDE / 2, -SIDE / 2, SIDE, SIDE, a[0], WORDS);
            snow_quadtree_copy(second.tree, -SIDE / 2, -SIDE / 2, SIDE, SIDE, b[0], WORDS);
            assert_memory_equal(a, b, sizeof a);
            save_tree(second.tree, &again);
            assert_int_equal(SNOW_OK, snow_quadtree_advance(first.tree, runs[i].second));
            assert_int_equal(SNOW_OK, snow_quadtree_advance(second.tree, runs[i].second));
        }
        close_scene(&first);
        close_scene(&second);
    }
}

static void cut_data_are_truncated(void **state)
{
    (void)state;
    static bytes saved;
    scene with;
    open_seed(&with, rule_of("1"), 0);
    assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, 20));
    save_tree(with.tree, &saved);
    close_scene(&with);
    for (size_t size = 0; size < saved.size; size++)
        assert_int_equal(SNOW_ERROR_TRUNCATED, load_tree(&with, rule_of("1"), &saved, size));
}

/* Any byte changed: refused, or a crystal whose counts agree with its cells. */
static void changed_data_are_refused_or_sound(void **state)
{
    (void)state;
    static bytes saved;
    scene with;
    open_seed(&with, rule_of("1"), 0);
    assert_int_equal(SNOW_OK, snow_quadtree_advance(with.tree, 20));
    save_tree(with.tree, &saved);
    close_scene(&with);
    int damaged = 0, sound = 0;
    for (size_t at = 0; at < saved.size; at++) {
        for (int bit = 0; bit < 8; bit++) {
            saved.data[at] ^= (unsigned char)(1U << bit);
            snow_status status = load_tree(&with, rule_of("1"), &saved, saved.size);
            saved.data[at] ^= (unsigned char)(1U << bit);
            if (status != SNOW_OK) {
                assert_true(status == SNOW_ERROR_DAMAGED || status == SNOW_ERROR_TRUNCATED);
                damaged++;
                continue;
            }
            static plain cells;
            uint64_t rows[SPAN][SPAN_WORDS];
            snow_quadtree_copy(with.tree, -MIDDLE, -MIDDLE, SPAN, SPAN, rows[0], SPAN_WORDS);
            for (int r = 0; r < SPAN; r++) {
                for (int q = 0; q < SPAN; q++)
                    cells.frozen[r][q] = rows[r][q / 64] >> q % 64 & 1;
            }
            quadtree_measures measures = measures_of(with.tree);
            assert_same_measures(&cells, &measures);
            sound++;
            close_scene(&with);
        }
    }
    assert_true(damaged > 0 && sound > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_rule_grows_as_the_plain_reading_says),
        cmocka_unit_test(seeds_may_be_put_while_the_crystal_grows),
        cmocka_unit_test(populations_are_one_more_than_a_multiple_of_six),
        cmocka_unit_test(one_and_two_neighbours_fill_the_hexagon),
        cmocka_unit_test(one_and_not_two_freezes_rings),
        cmocka_unit_test(populations_at_powers_of_two),
        cmocka_unit_test(rule_1_is_the_known_sequence),
        cmocka_unit_test(steps_add_up),
        cmocka_unit_test(stillness_is_found_by_looking_ahead),
        cmocka_unit_test(stillness_ends_at_the_root),
        cmocka_unit_test(known_results_are_no_work),
        cmocka_unit_test(what_was_kept_comes_back),
        cmocka_unit_test(regions_are_put_and_copied_at_any_place),
        cmocka_unit_test(squares_with_cells_are_found_in_order),
        cmocka_unit_test(distances_are_measured_from_the_centre),
        cmocka_unit_test(the_reach_is_kept),
        cmocka_unit_test(far_cells_are_measured_exactly),
        cmocka_unit_test(a_limit_is_kept_and_the_result_exact),
        cmocka_unit_test(collections_change_nothing),
        cmocka_unit_test(any_allocation_may_fail),
        cmocka_unit_test(what_was_saved_goes_on),
        cmocka_unit_test(cut_data_are_truncated),
        cmocka_unit_test(changed_data_are_refused_or_sound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
