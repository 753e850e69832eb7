/* The tile engine against a plain model: a byte a cell, every cell looked at in every step. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/hexagon.h"
#include "base/parallel.h"
#include "packard/tiles.h"
#include "packard/tiles_index.h"

#include <stdlib.h>
#include <string.h>

static snow_heap heap_with_limit(uint64_t limit)
{
    snow_options options;
    snow_options_init(&options, sizeof options);
    options.memory_limit = limit;
    snow_heap heap;
    snow_heap_start(&heap, &options);
    return heap;
}

/* A plane with one frozen cell. */
static snow_tiles *tiles_from(snow_heap *heap, const snow_tiles_plan *plan, int64_t q, int64_t r)
{
    snow_tiles *tiles = NULL;
    assert_int_equal(SNOW_OK, snow_tiles_create(&tiles, heap, plan));
    assert_int_equal(SNOW_OK, snow_tiles_set(tiles, q, r));
    return tiles;
}

/* xorshift: the same numbers everywhere. */
static uint64_t draw(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state * UINT64_C(0x2545F4914F6CDD1D) >> 32;
}

/* ---- the plain model: a torus, or a window that the crystal must not leave ---- */

typedef struct plain {
    int64_t least, width, height; /* the cells least <= q < least + width, and so for r */
    bool torus;
    uint8_t *frozen;
    int32_t *date;
    snow_tile_mask mask;
    const void *context;
    int32_t steps;
    int64_t first, end; /* rows that may change, counted from the least */
} plain;

static plain plain_start(int64_t least, int64_t width, int64_t height, bool torus)
{
    plain model = {.least = least, .width = width, .height = height, .torus = torus, .first = height};
    model.frozen = calloc((size_t)(width * height), 1);
    model.date = calloc((size_t)(width * height), sizeof *model.date);
    assert_non_null(model.frozen);
    assert_non_null(model.date);
    for (int64_t i = 0; i < width * height; i++)
        model.date[i] = -1;
    return model;
}

static void plain_end(plain *model)
{
    free(model->frozen);
    free(model->date);
}

static int64_t plain_index(const plain *model, int64_t q, int64_t r)
{
    q -= model->least;
    r -= model->least;
    if (model->torus) {
        q = (q % model->width + model->width) % model->width;
        r = (r % model->height + model->height) % model->height;
    }
    return q < 0 || r < 0 || q >= model->width || r >= model->height ? -1 : r * model->width + q;
}

static bool plain_has(const plain *model, int64_t q, int64_t r)
{
    int64_t index = plain_index(model, q, r);
    return index >= 0 && model->frozen[index];
}

static void plain_set(plain *model, int64_t q, int64_t r)
{
    int64_t index = plain_index(model, q, r);
    assert_true(index >= 0);
    if (!model->frozen[index])
        model->date[index] = model->steps;
    model->frozen[index] = 1;
    int64_t row = index / model->width;
    model->first = row < model->first ? row : model->first;
    model->end = row >= model->end ? row + 1 : model->end;
}

static int plain_neighbours(const plain *model, int64_t q, int64_t r)
{
    int64_t x = q - model->least;
    int64_t y = r - model->least;
    if (x > 0 && y > 0 && x < model->width - 1 && y < model->height - 1) { /* the same, without looking for the rim */
        const uint8_t *here = model->frozen + y * model->width + x;
        const uint8_t *above = here - model->width;
        const uint8_t *below = here + model->width;
        return here[-1] + here[1] + above[0] + above[1] + below[-1] + below[0];
    }
    return plain_has(model, q + 1, r) + plain_has(model, q - 1, r) + plain_has(model, q, r + 1) +
           plain_has(model, q, r - 1) + plain_has(model, q + 1, r - 1) + plain_has(model, q - 1, r + 1);
}

/* The mask is asked about a block that begins with the cell. */
static bool plain_obeys(const plain *model, bool freezes, int count, int64_t q, int64_t r)
{
    uint64_t allowed[64];
    uint64_t priority[64] = {0};
    memset(allowed, 0xFF, sizeof allowed);
    model->mask(model->context, q, r, allowed, priority);
    return (freezes || ((priority[0] & 1) && count > 0)) && (allowed[0] & 1);
}

static bool plain_freezes(const plain *model, uint8_t rule, int64_t q, int64_t r)
{
    int count = plain_neighbours(model, q, r);
    bool freezes = (rule >> count & 1) != 0;
    if (model->mask == NULL || (count == 0 && !freezes))
        return freezes;
    return plain_obeys(model, freezes, count, q, r);
}

/* Rows without neighbours of frozen cells are left out where that is plainly right. */
static void plain_widen(plain *model, uint8_t rule)
{
    if (model->torus || (rule & 1)) {
        model->first = 0;
        model->end = model->height;
    }
    model->first -= model->first > 0;
    model->end += model->end < model->height;
}

static void plain_step(plain *model, uint8_t rule)
{
    plain_widen(model, rule);
    size_t cells = (size_t)(model->width * model->height);
    uint8_t *next = malloc(cells);
    assert_non_null(next);
    memcpy(next, model->frozen, cells);
    model->steps++;
    for (int64_t y = model->first; y < model->end; y++) {
        for (int64_t x = 0; x < model->width; x++) {
            int64_t index = y * model->width + x;
            if (model->frozen[index] || !plain_freezes(model, rule, model->least + x, model->least + y))
                continue;
            next[index] = 1;
            model->date[index] = model->steps;
            /* A crystal that reached the window's rim could not be compared. */
            assert_true(model->torus || model->mask != NULL ||
                        (x > 0 && y > 0 && x < model->width - 1 && y < model->height - 1));
        }
    }
    free(model->frozen);
    model->frozen = next;
}

static void widen(int64_t *least, int64_t *greatest, int64_t value)
{
    *least = value < *least ? value : *least;
    *greatest = value > *greatest ? value : *greatest;
}

static void assert_same(const plain *model, snow_tiles *tiles, const snow_tiles_plan *plan)
{
    snow_tiles_census want = {
        .least_q = INT64_MAX, .least_r = INT64_MAX, .least_s = INT64_MAX,
        .greatest_q = INT64_MIN, .greatest_r = INT64_MIN, .greatest_s = INT64_MIN,
    };
    for (int64_t y = 0; y < model->height; y++) {
        uint64_t row[64];
        assert_true(model->width <= 64 * 64);
        snow_tiles_row(tiles, model->least, model->least + y, (size_t)model->width, row);
        for (int64_t x = 0; x < model->width; x++) {
            int64_t q = model->least + x;
            int64_t r = model->least + y;
            bool frozen = model->frozen[y * model->width + x] != 0;
            if ((row[x / 64] >> x % 64 & 1) != frozen)
                fail_msg("cell %lld, %lld differs after %d steps", (long long)q, (long long)r, (int)model->steps);
            if (plan->dated)
                assert_int_equal(model->date[y * model->width + x], snow_tiles_date(tiles, q, r));
            if (!frozen)
                continue;
            want.frozen++;
            widen(&want.least_q, &want.greatest_q, q);
            widen(&want.least_r, &want.greatest_r, r);
            widen(&want.least_s, &want.greatest_s, q + r);
            uint64_t square = (uint64_t)snow_hexagon_square(q - plan->centre_q, r - plan->centre_r);
            want.tip_square = square > want.tip_square ? square : want.tip_square;
        }
    }
    snow_tiles_census got;
    snow_tiles_count(tiles, &got);
    assert_int_equal(want.frozen, got.frozen);
    if (want.frozen == 0)
        return;
    assert_int_equal(want.least_q, got.least_q);
    assert_int_equal(want.greatest_q, got.greatest_q);
    assert_int_equal(want.least_r, got.least_r);
    assert_int_equal(want.greatest_r, got.greatest_r);
    assert_int_equal(want.least_s, got.least_s);
    assert_int_equal(want.greatest_s, got.greatest_s);
    assert_int_equal(want.tip_square, got.tip_square);
}

/* ---- both together ---- */

enum { MOST_PLANES = 4 };

/* One model, and planes of tiles that must be like it: one for each instruction set. */
typedef struct pair {
    snow_heap heap;
    plain model;
    snow_tiles *tiles[MOST_PLANES];
    size_t planes;
    snow_tiles_plan plan;
} pair;

static void pair_start(pair *both, const snow_tiles_plan *plan, plain model)
{
    static const snow_isa isas[] = {SNOW_ISA_BASELINE, SNOW_ISA_AVX2, SNOW_ISA_AVX512};
    *both = (pair){.heap = heap_with_limit(0), .model = model, .plan = *plan};
    both->model.mask = plan->mask;
    both->model.context = plan->mask_context;
    for (size_t i = 0; i < sizeof isas / sizeof isas[0]; i++) {
        if (!snow_isa_available(isas[i]))
            continue;
        both->plan.isa = isas[i];
        assert_int_equal(SNOW_OK, snow_tiles_create(&both->tiles[both->planes], &both->heap, &both->plan));
        assert_int_equal(isas[i], snow_tiles_isa(both->tiles[both->planes]));
        both->planes++;
    }
}

static void pair_set(pair *both, int64_t q, int64_t r)
{
    plain_set(&both->model, q, r);
    for (size_t i = 0; i < both->planes; i++)
        assert_int_equal(SNOW_OK, snow_tiles_set(both->tiles[i], q, r));
}

static void pair_set_mask(pair *both, snow_tile_mask mask, const void *context)
{
    both->model.mask = mask;
    both->model.context = context;
    for (size_t i = 0; i < both->planes; i++)
        assert_int_equal(SNOW_OK, snow_tiles_set_mask(both->tiles[i], mask, context));
}

static void pair_advance(pair *both, int steps)
{
    for (int i = 0; i < steps; i++)
        plain_step(&both->model, both->plan.freezes);
    for (size_t i = 0; i < both->planes; i++) {
        assert_int_equal(SNOW_OK, snow_tiles_advance(both->tiles[i], steps));
        assert_int_equal(both->model.steps, snow_tiles_steps(both->tiles[i]));
        assert_same(&both->model, both->tiles[i], &both->plan);
    }
}

static void pair_end(pair *both)
{
    for (size_t i = 0; i < both->planes; i++)
        snow_tiles_destroy(both->tiles[i]);
    plain_end(&both->model);
    assert_int_equal(0, both->heap.used);
}

static plain window_of(int64_t reach)
{
    return plain_start(-reach, 2 * reach + 1, 2 * reach + 1, false);
}

/* ---- the plane ---- */

static void every_rule_from_random_seeds(void **state)
{
    (void)state;
    uint64_t random = 20261122;
    for (unsigned rule = 0; rule < 128; rule += 2) {
        pair both;
        pair_start(&both, &(snow_tiles_plan){.freezes = (uint8_t)rule}, window_of(170));
        int64_t side = rule % 8 < 4 ? 6 : 160;
        for (int i = 0; i < 12; i++)
            pair_set(&both, (int64_t)(draw(&random) % (uint64_t)side) - side / 2,
                     (int64_t)(draw(&random) % (uint64_t)side) - side / 2);
        pair_advance(&both, 1);
        pair_advance(&both, 30);
        pair_advance(&both, 49);
        pair_end(&both);
    }
}

/* Tiles meet at all their corners, on both sides of the origin. */
static void seeds_at_the_corners_of_tiles(void **state)
{
    (void)state;
    static const int64_t at[] = {-65, -64, -63, -1, 0, 1, 63, 64};
    enum { PLACES = sizeof at / sizeof at[0] };
    for (size_t i = 0; i < PLACES * PLACES; i++) {
        pair both;
        pair_start(&both, &(snow_tiles_plan){.freezes = i % 2 ? 0x2A : 0x12}, window_of(80));
        pair_set(&both, at[i / PLACES], at[i % PLACES]);
        pair_advance(&both, 9);
        pair_end(&both);
    }
}

static void cells_set_between_steps(void **state)
{
    (void)state;
    uint64_t random = 77;
    pair both;
    pair_start(&both, &(snow_tiles_plan){.freezes = 0x0A, .dated = true}, window_of(160));
    for (int i = 0; i < 40; i++) {
        pair_set(&both, (int64_t)(draw(&random) % 200) - 100, (int64_t)(draw(&random) % 200) - 100);
        pair_advance(&both, (int)(draw(&random) % 3));
    }
    pair_end(&both);
}

static void an_empty_plane_stays_empty(void **state)
{
    (void)state;
    pair both;
    pair_start(&both, &(snow_tiles_plan){.freezes = 0x7E}, window_of(5));
    pair_advance(&both, 10);
    assert_true(snow_tiles_still(both.tiles[0]));
    assert_int_equal(0, snow_tiles_number(both.tiles[0]));
    pair_end(&both);
}

static uint64_t frozen_after(uint8_t rule, bool folded, int64_t steps)
{
    snow_heap heap = heap_with_limit(0);
    snow_tiles *tiles = tiles_from(&heap, &(snow_tiles_plan){.freezes = rule, .folded = folded}, 0, 0);
    assert_int_equal(SNOW_OK, snow_tiles_advance(tiles, steps));
    snow_tiles_census census;
    snow_tiles_count(tiles, &census);
    snow_tiles_destroy(tiles);
    return census.frozen;
}

static void known_counts(void **state)
{
    (void)state;
    for (int folded = 0; folded < 2; folded++) {
        assert_int_equal(16381, frozen_after(0x02, folded, 100));
        assert_int_equal(1818877, frozen_after(0x02, folded, 1000));
        assert_int_equal(20629, frozen_after(0x2A, folded, 100));
        assert_int_equal(2355193, frozen_after(0x2A, folded, 1000));
        assert_int_equal(2282893, frozen_after(0x22, folded, 1000));
        assert_int_equal(2738131, frozen_after(0x1A, folded, 1000));
        assert_int_equal(3 * 1000 * 1001 + 1, frozen_after(0x06, folded, 1000));
        for (int k = 1; k <= 10; k++) /* rules 13 and 135 */
            assert_int_equal((5 << (2 * k - 1)) - (3 << k) + 9, frozen_after(0x2A, folded, 1 << k));
    }
}

/* ---- the folded plane ---- */

static void set_images(pair *both, int64_t q, int64_t r)
{
    for (int symmetry = 0; symmetry < SNOW_HEXAGON_SYMMETRIES; symmetry++) {
        int64_t image_q, image_r;
        snow_hexagon_image(symmetry, q, r, &image_q, &image_r);
        plain_set(&both->model, both->plan.fold_q + image_q, both->plan.fold_r + image_r);
    }
    for (size_t i = 0; i < both->planes; i++)
        assert_int_equal(SNOW_OK, snow_tiles_set(both->tiles[i], both->plan.fold_q + q, both->plan.fold_r + r));
}

static void every_rule_folded(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (unsigned rule = 0; rule < 128; rule += 2) {
        snow_tiles_plan plan = {.freezes = (uint8_t)rule, .folded = true, .dated = rule % 16 == 10};
        pair both;
        pair_start(&both, &plan, window_of(215));
        set_images(&both, 0, 0);
        if (rule % 4 == 0) { /* a ring of seeds that reaches other tiles */
            int64_t q = (int64_t)(draw(&random) % 50) + 20;
            int64_t r = (int64_t)(draw(&random) % 50);
            set_images(&both, q, r);
            set_images(&both, 70, 70);
        }
        pair_advance(&both, 3);
        pair_advance(&both, 67);
        pair_end(&both);
    }
}

static void a_folded_plane_anywhere(void **state)
{
    (void)state;
    snow_tiles_plan plan = {.freezes = 0x02, .folded = true, .fold_q = 37, .fold_r = -70, .centre_q = 11};
    pair both;
    pair_start(&both, &plan, window_of(180));
    set_images(&both, 0, 0);
    for (int i = 0; i < 20; i++)
        pair_advance(&both, 5);
    pair_end(&both);
}

/* ---- the torus ---- */

static void a_torus_closes_at_any_size(void **state)
{
    (void)state;
    static const int64_t sizes[][2] = {{1, 1},  {1, 5},   {2, 3},    {3, 2},    {20, 13},  {63, 65},  {64, 64},
                                       {64, 1}, {65, 64}, {66, 129}, {127, 63}, {128, 64}, {130, 70}, {200, 131}};
    uint64_t random = 11;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        for (unsigned rule = 2; rule < 128; rule += 10) {
            snow_tiles_plan plan = {
                .freezes = (uint8_t)rule, .width = sizes[i][0], .height = sizes[i][1], .dated = i % 2 == 0,
                .centre_q = sizes[i][0] / 2};
            pair both;
            pair_start(&both, &plan, plain_start(0, plan.width, plan.height, true));
            pair_set(&both, (int64_t)(draw(&random) % 1000) - 500, (int64_t)(draw(&random) % 1000) - 500);
            pair_set(&both, -1, -1);
            pair_advance(&both, 7);
            pair_advance(&both, 50);
            pair_end(&both);
        }
    }
}

static void a_torus_reads_as_it_repeats(void **state)
{
    (void)state;
    snow_heap heap = heap_with_limit(0);
    snow_tiles_plan plan = {.freezes = 0x02, .width = 70, .height = 5};
    snow_tiles *tiles = tiles_from(&heap, &plan, 69, 2);
    uint64_t row[4];
    snow_tiles_row(tiles, -140, -3, 250, row);
    for (int i = 0; i < 250; i++)
        assert_int_equal(i % 70 == 69, row[i / 64] >> i % 64 & 1);
    assert_int_equal(0, row[3] >> (250 - 192));
    snow_tiles_destroy(tiles);
}

static void known_count_on_a_torus(void **state)
{
    (void)state;
    snow_heap heap = heap_with_limit(0);
    snow_tiles_plan plan = {.freezes = 0x02, .width = 20, .height = 13};
    snow_tiles *tiles = tiles_from(&heap, &plan, 10, 6);
    assert_int_equal(SNOW_OK, snow_tiles_advance(tiles, 40));
    snow_tiles_census census;
    snow_tiles_count(tiles, &census);
    assert_int_equal(165, census.frozen);
    snow_tiles_destroy(tiles);
}

/* ---- masks ---- */

typedef bool (*cell_test)(int64_t q, int64_t r);

typedef struct zones {
    cell_test refused, preferred; /* NULL: none */
} zones;

static bool zone_mask(const void *context, int64_t q, int64_t r, uint64_t *allowed, uint64_t *priority)
{
    const zones *here = context;
    bool any = false;
    for (int y = 0; y < 64; y++) {
        for (int x = 0; x < 64; x++) {
            if (here->refused != NULL && here->refused(q + x, r + y)) {
                allowed[y] &= ~(UINT64_C(1) << x);
                any = true;
            }
            if (here->preferred != NULL && here->preferred(q + x, r + y)) {
                priority[y] |= UINT64_C(1) << x;
                any = true;
            }
        }
    }
    return any;
}

/* The plain model asks about one cell at a time: no need to answer for 4096. */
static bool zone_mask_of_cell(const void *context, int64_t q, int64_t r, uint64_t *allowed, uint64_t *priority)
{
    const zones *here = context;
    allowed[0] = here->refused == NULL || !here->refused(q, r);
    priority[0] = here->preferred != NULL && here->preferred(q, r);
    return true;
}

static bool on_axes(int64_t q, int64_t r)
{
    return q == 0 || r == 0 || q + r == 0;
}

static bool between_axes(int64_t q, int64_t r)
{
    int64_t distance = snow_hexagon_distance(q, r);
    return 4 * snow_hexagon_square(q, r) <= 3 * distance * distance + distance;
}

static bool far_from_origin(int64_t q, int64_t r)
{
    return snow_hexagon_square(q, r) >= 75 * 75;
}

static bool in_specks(int64_t q, int64_t r)
{
    uint64_t hash = (uint64_t)(q * 1000003 + r * 7919) * UINT64_C(0x9E3779B97F4A7C15);
    return hash >> 61 == 0;
}

static void use_zones(pair *both, const zones *here)
{
    pair_set_mask(both, here != NULL ? zone_mask : NULL, here);
    both->model.mask = here != NULL ? zone_mask_of_cell : NULL;
}

static void zones_come_and_go(void **state)
{
    (void)state;
    static const zones clefts = {.refused = between_axes};
    static const zones corners = {.preferred = on_axes};
    static const zones specks = {.refused = in_specks, .preferred = between_axes};
    for (unsigned rule = 2; rule < 128; rule += 12) {
        for (int folded = 0; folded < 2; folded++) {
            snow_tiles_plan plan = {.freezes = (uint8_t)rule, .folded = folded, .dated = rule % 24 == 2};
            pair both;
            pair_start(&both, &plan, window_of(110));
            set_images(&both, 0, 0);
            pair_advance(&both, 3);
            use_zones(&both, &clefts);
            pair_advance(&both, 20);
            use_zones(&both, NULL);
            pair_advance(&both, 1);
            use_zones(&both, &corners);
            pair_advance(&both, 9);
            use_zones(&both, folded ? &clefts : &specks);
            pair_advance(&both, 40);
            use_zones(&both, NULL);
            pair_advance(&both, 20);
            pair_end(&both);
        }
    }
}

/* A mask that never goes makes a bounded domain; there cells may freeze alone. */
static void every_rule_in_a_disc(void **state)
{
    (void)state;
    static const zones disc = {.refused = far_from_origin};
    uint64_t random = 3;
    for (unsigned rule = 0; rule < 128; rule++) {
        if (rule % 2 == 0 && rule % 10 != 0)
            continue;
        snow_tiles_plan plan = {.freezes = (uint8_t)rule, .mask = zone_mask, .mask_context = &disc};
        pair both;
        pair_start(&both, &plan, window_of(90));
        both.model.mask = zone_mask_of_cell;
        for (size_t i = 0; i < both.planes; i++)
            assert_int_equal(SNOW_OK, snow_tiles_cover(both.tiles[i], -90, -90, 181, 181));
        for (int i = 0; i < 5; i++)
            pair_set(&both, (int64_t)(draw(&random) % 60) - 30, (int64_t)(draw(&random) % 60) - 30);
        pair_advance(&both, 1);
        pair_advance(&both, 60);
        pair_end(&both);
    }
}

/* A tile that no mask touches any longer costs what others do. */
static void masks_leave_nothing_behind(void **state)
{
    (void)state;
    static const zones specks = {.refused = in_specks};
    snow_heap heap = heap_with_limit(0);
    snow_tiles *tiles = tiles_from(&heap, &(snow_tiles_plan){.freezes = 0x02}, 0, 0);
    assert_int_equal(SNOW_OK, snow_tiles_advance(tiles, 100));
    uint64_t before = heap.used;
    assert_int_equal(SNOW_OK, snow_tiles_set_mask(tiles, zone_mask, &specks));
    assert_true(heap.used > before);
    assert_int_equal(SNOW_OK, snow_tiles_set_mask(tiles, NULL, NULL));
    assert_int_equal(SNOW_OK, snow_tiles_advance(tiles, 1));
    assert_true(heap.used <= before + before / 2);
    snow_tiles_destroy(tiles);
    assert_int_equal(0, heap.used);
}

/* ---- rows, threads, memory ---- */

enum { REACH = 131, COUNT = 2 * REACH + 1 };

static void copy_rows(const snow_tiles *from, snow_tiles *to)
{
    uint64_t row[COUNT / 64 + 1];
    for (int r = -REACH; r <= REACH; r++) {
        snow_tiles_row(from, -REACH, r, COUNT, row);
        assert_int_equal(SNOW_OK, snow_tiles_put_row(to, -REACH, r, COUNT, row));
    }
}

static void assert_equal_planes(const snow_tiles *one, const snow_tiles *other, int64_t least, int64_t greatest)
{
    uint64_t a[64], b[64];
    size_t count = (size_t)(greatest - least + 1);
    assert_true(count <= 64 * 64);
    for (int64_t r = least; r <= greatest; r++) {
        snow_tiles_row(one, least, r, count, a);
        snow_tiles_row(other, least, r, count, b);
        assert_memory_equal(a, b, (count + 63) / 64 * 8);
    }
}

/* From a folded plane to one that is not, back, and to a torus. */
static void rows_carry_a_plane_over(void **state)
{
    (void)state;
    snow_heap heap = heap_with_limit(0);
    snow_tiles_plan plans[] = {
        {.freezes = 0x2A, .folded = true},
        {.freezes = 0x2A},
        {.freezes = 0x2A, .folded = true, .dated = true},
        {.freezes = 0x2A, .width = COUNT, .height = COUNT + 1},
    };
    enum { PLANES = sizeof plans / sizeof plans[0] };
    snow_tiles *tiles[PLANES];
    for (size_t i = 0; i < PLANES; i++)
        assert_int_equal(SNOW_OK, snow_tiles_create(&tiles[i], &heap, &plans[i]));
    assert_int_equal(SNOW_OK, snow_tiles_set(tiles[0], 0, 0));
    assert_int_equal(SNOW_OK, snow_tiles_advance(tiles[0], 90));
    for (size_t i = 1; i < PLANES; i++) {
        snow_tiles_set_steps(tiles[i], 90);
        copy_rows(tiles[i - 1], tiles[i]);
    }
    for (size_t i = 0; i < PLANES; i++)
        assert_int_equal(SNOW_OK, snow_tiles_advance(tiles[i], 40));
    for (size_t i = 1; i < PLANES; i++) {
        assert_int_equal(130, snow_tiles_steps(tiles[i]));
        assert_equal_planes(tiles[0], tiles[i], -REACH, REACH);
    }
    for (int q = -REACH; q <= REACH; q++)
        assert_int_equal(snow_tiles_get(tiles[0], q, 17), snow_tiles_get(tiles[1], q, 17));
    assert_int_equal(90, snow_tiles_date(tiles[2], 0, -1));
    assert_int_equal(130, snow_tiles_date(tiles[2], 0, -130));
    for (size_t i = 0; i < PLANES; i++)
        snow_tiles_destroy(tiles[i]);
    assert_int_equal(0, heap.used);
}

/* Bits beyond the count are not cells. */
static void a_row_ends_where_it_is_said_to(void **state)
{
    (void)state;
    snow_heap heap = heap_with_limit(0);
    snow_tiles *tiles;
    assert_int_equal(SNOW_OK, snow_tiles_create(&tiles, &heap, &(snow_tiles_plan){.freezes = 0x02}));
    uint64_t row[2] = {UINT64_MAX, UINT64_MAX};
    assert_int_equal(SNOW_OK, snow_tiles_put_row(tiles, -30, 7, 70, row));
    snow_tiles_census census;
    snow_tiles_count(tiles, &census);
    assert_int_equal(70, census.frozen);
    assert_int_equal(-30, census.least_q);
    assert_int_equal(39, census.greatest_q);
    snow_tiles_row(tiles, -31, 7, 2, row);
    assert_int_equal(2, row[0]);
    snow_tiles_destroy(tiles);
}

static void scatter(snow_tiles *tiles, int seeds)
{
    uint64_t random = 99;
    for (int i = 0; i < seeds; i++) {
        int64_t q = (int64_t)(draw(&random) % 3000);
        int64_t r = (int64_t)(draw(&random) % 3000);
        assert_int_equal(SNOW_OK, snow_tiles_set(tiles, q, r));
    }
}

static void threads_change_nothing(void **state)
{
    (void)state;
    snow_heap heap = heap_with_limit(0);
    snow_team *team = NULL;
    assert_int_equal(SNOW_OK, snow_team_start(&team, &heap, 3));
    snow_tiles_plan alone = {.freezes = 0x02};
    snow_tiles_plan shared = {.freezes = 0x02, .loop = snow_team_for, .loop_context = team, .threads = 3};
    snow_tiles *one, *three;
    assert_int_equal(SNOW_OK, snow_tiles_create(&one, &heap, &alone));
    assert_int_equal(SNOW_OK, snow_tiles_create(&three, &heap, &shared));
    scatter(one, 1000);
    scatter(three, 1000);
    assert_int_equal(SNOW_OK, snow_tiles_advance(one, 150));
    assert_int_equal(SNOW_OK, snow_tiles_advance(three, 150));
    assert_equal_planes(one, three, -200, 3200);
    assert_int_equal(snow_tiles_visits(one), snow_tiles_visits(three));
    snow_tiles_destroy(one);
    snow_tiles_destroy(three);
    snow_team_end(team, &heap);
    assert_int_equal(0, heap.used);
}

/* With a limit that is raised a little after each refusal, the plane comes out the same. */
static void refused_memory_leaves_whole_steps(void **state)
{
    (void)state;
    snow_heap free_heap = heap_with_limit(0);
    snow_heap tight = heap_with_limit(60000);
    snow_tiles_plan plan = {.freezes = 0x12, .dated = true};
    snow_tiles *one, *other;
    assert_int_equal(SNOW_OK, snow_tiles_create(&one, &free_heap, &plan));
    assert_int_equal(SNOW_OK, snow_tiles_create(&other, &tight, &plan));
    assert_int_equal(SNOW_OK, snow_tiles_set(one, 3, -2));
    assert_int_equal(SNOW_OK, snow_tiles_set(other, 3, -2));
    int refusals = 0;
    while (snow_tiles_steps(other) < 150) {
        snow_status status = snow_tiles_advance(other, 150 - snow_tiles_steps(other));
        int64_t behind = snow_tiles_steps(other) - snow_tiles_steps(one);
        assert_int_equal(SNOW_OK, snow_tiles_advance(one, behind));
        if (status == SNOW_OK)
            break;
        assert_int_equal(SNOW_ERROR_MEMORY_LIMIT, status);
        assert_equal_planes(one, other, -160, 160);
        tight.limit += 3000;
        refusals++;
    }
    assert_true(refusals > 20);
    assert_equal_planes(one, other, -160, 160);
    snow_tiles_destroy(one);
    snow_tiles_destroy(other);
    assert_int_equal(0, tight.used);
}

static void refused_cells_and_masks_change_nothing(void **state)
{
    (void)state;
    static const zones specks = {.refused = in_specks};
    snow_heap heap = heap_with_limit(0);
    snow_tiles *tiles = tiles_from(&heap, &(snow_tiles_plan){.freezes = 0x02}, 0, 0);
    heap.limit = heap.used;
    snow_status status = SNOW_OK;
    int64_t q = 0;
    while (status == SNOW_OK)
        status = snow_tiles_set(tiles, q += 1000, 0);
    assert_int_equal(SNOW_ERROR_MEMORY_LIMIT, status);
    assert_false(snow_tiles_get(tiles, q, 0));
    assert_int_equal(SNOW_ERROR_MEMORY_LIMIT, snow_tiles_set_mask(tiles, zone_mask, &specks));
    heap.limit = 0;
    assert_int_equal(SNOW_OK, snow_tiles_advance(tiles, 100));
    snow_tiles_census census;
    snow_tiles_count(tiles, &census);
    assert_int_equal((uint64_t)(q / 1000) * 16381, census.frozen);
    snow_tiles_destroy(tiles);
    assert_int_equal(0, heap.used);
}

static void cells_far_away(void **state)
{
    (void)state;
    static const int64_t far[] = {INT32_MIN, -2147483000, 1000000007, INT32_MAX};
    for (size_t i = 0; i < 16; i++) {
        snow_heap heap = heap_with_limit(0);
        int64_t q = far[i / 4];
        int64_t r = far[i % 4];
        snow_tiles *tiles = tiles_from(&heap, &(snow_tiles_plan){.freezes = 0x02}, q, r);
        snow_tiles_census census;
        snow_tiles_count(tiles, &census);
        assert_int_equal(q, census.least_q);
        assert_int_equal(r, census.greatest_r);
        if (q != r || q > 0) /* else 3 q² has no room in 64 signed bits */
            assert_int_equal((uint64_t)q * (uint64_t)q + (uint64_t)q * (uint64_t)r + (uint64_t)r * (uint64_t)r,
                             census.tip_square);
        assert_int_equal(SNOW_OK, snow_tiles_advance(tiles, 100));
        snow_tiles_count(tiles, &census);
        assert_int_equal(16381, census.frozen);
        assert_int_equal(q - 100, census.least_q);
        assert_int_equal(q + 100, census.greatest_q);
        assert_true(snow_tiles_get(tiles, q - 100, r));
        snow_tiles_destroy(tiles);
    }
}

/* Long after nothing changes any more, steps cost nothing. */
static int by_place(const void *a, const void *b)
{
    const int32_t *x = a, *y = b;
    return x[1] != y[1] ? (x[1] > y[1] ? 1 : -1) : (x[0] > y[0]) - (x[0] < y[0]);
}

/* Against a sorted list; places from the ends of the range, and some side by side. */
static void the_index_finds_tiles_in_order(void **state)
{
    (void)state;
    enum { PLACES = 3000 };
    static int32_t places[PLACES][2];
    static const int32_t special[] = {0, -1, 1, 63, 64, -64, INT32_MAX, INT32_MIN, 4095, 4096};
    uint64_t stream = 5;
    snow_heap heap = heap_with_limit(0);
    tile_index index;
    assert_true(snow_tile_index_start(&index, &heap));
    for (int i = 0; i < PLACES; i++) {
        for (int axis = 0; axis < 2; axis++) {
            uint64_t kind = draw(&stream) % 4;
            places[i][axis] = kind == 0   ? special[draw(&stream) % 10]
                              : kind == 1 ? (int32_t)(uint32_t)draw(&stream)
                                          : (int32_t)(draw(&stream) % 200) - 100;
        }
        assert_true(snow_tile_index_add(&index, places[i][0], places[i][1]));
    }
    qsort(places, PLACES, sizeof places[0], by_place);
    int32_t q = INT32_MIN, r = INT32_MIN;
    for (int i = 0; i < PLACES; i++) {
        assert_true(snow_tile_index_next(&index, &q, &r));
        assert_int_equal(places[i][0], q);
        assert_int_equal(places[i][1], r);
        while (i + 1 < PLACES && by_place(places[i], places[i + 1]) == 0)
            i++;
        if (q == INT32_MAX && r == INT32_MAX)
            break;
        r += q == INT32_MAX;
        q = q == INT32_MAX ? INT32_MIN : q + 1;
    }
    snow_tile_index_end(&index);
    assert_int_equal(0, heap.used);
}

static void an_index_without_memory_is_what_it_was(void **state)
{
    (void)state;
    snow_heap heap = heap_with_limit(4000);
    tile_index index;
    assert_true(snow_tile_index_start(&index, &heap));
    int32_t added = 0;
    while (snow_tile_index_add(&index, 1000 * added, added))
        added++;
    assert_in_range(added, 3, 100);
    int32_t q = INT32_MIN, r = INT32_MIN;
    for (int32_t i = 0; i < added; i++, q++) {
        assert_true(snow_tile_index_next(&index, &q, &r));
        assert_int_equal(1000 * i, q);
        assert_int_equal(i, r);
    }
    assert_false(snow_tile_index_next(&index, &q, &r));
    snow_tile_index_end(&index);
}

static void a_still_plane_counts_on(void **state)
{
    (void)state;
    snow_heap heap = heap_with_limit(0);
    snow_tiles_plan plan = {.freezes = 0x02, .width = 40, .height = 40};
    snow_tiles *tiles = tiles_from(&heap, &plan, 0, 0);
    assert_int_equal(SNOW_OK, snow_tiles_advance(tiles, INT64_C(1) << 60));
    assert_int_equal(INT64_C(1) << 60, snow_tiles_steps(tiles));
    assert_true(snow_tiles_still(tiles));
    snow_tiles_destroy(tiles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_rule_from_random_seeds),
        cmocka_unit_test(seeds_at_the_corners_of_tiles),
        cmocka_unit_test(cells_set_between_steps),
        cmocka_unit_test(an_empty_plane_stays_empty),
        cmocka_unit_test(known_counts),
        cmocka_unit_test(every_rule_folded),
        cmocka_unit_test(a_folded_plane_anywhere),
        cmocka_unit_test(a_torus_closes_at_any_size),
        cmocka_unit_test(a_torus_reads_as_it_repeats),
        cmocka_unit_test(known_count_on_a_torus),
        cmocka_unit_test(zones_come_and_go),
        cmocka_unit_test(every_rule_in_a_disc),
        cmocka_unit_test(masks_leave_nothing_behind),
        cmocka_unit_test(rows_carry_a_plane_over),
        cmocka_unit_test(a_row_ends_where_it_is_said_to),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(refused_memory_leaves_whole_steps),
        cmocka_unit_test(refused_cells_and_masks_change_nothing),
        cmocka_unit_test(cells_far_away),
        cmocka_unit_test(the_index_finds_tiles_in_order),
        cmocka_unit_test(an_index_without_memory_is_what_it_was),
        cmocka_unit_test(a_still_plane_counts_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
