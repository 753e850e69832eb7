/* The maps of plane and space against distances counted site by site, and what they say about their own changes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "aggregate/plane_map.h"
#include "aggregate/space_map.h"
#include "base/hexagon.h"
#include "base/random.h"

enum { PLACES = 400, FILLED = 120 };

static snow_heap new_heap(void)
{
    snow_options options;
    snow_options_init(&options, sizeof options);
    snow_heap heap;
    snow_heap_start(&heap, &options);
    return heap;
}

static int32_t draw(uint32_t *number, int32_t least, int32_t most)
{
    snow_random_block counter = {{(*number)++, 0, 0, 0}};
    uint32_t bits = snow_random_draw(7, counter).word[0];
    return least + (int32_t)(bits % (uint32_t)(most - least + 1));
}

static int64_t greater(int64_t a, int64_t b)
{
    return a > b ? a : b;
}

/* The radius of the largest region round 0 without this site. */
static int64_t distance(snow_aggregate_lattice lattice, snow_site s)
{
    if (lattice == SNOW_AGGREGATE_HEXAGONAL)
        return snow_hexagon_distance(s.x, s.y);
    return greater(greater(llabs(s.x), llabs(s.y)), llabs(s.z));
}

/* To the nearest site that is filled or next to one that is. */
static int64_t free_distance(snow_aggregate_lattice lattice, snow_site from, const snow_site *filled, int count)
{
    static const snow_site step[3][7] = {
        {{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}},
        {{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {1, -1, 0}, {-1, 1, 0}},
        {{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
    };
    int64_t least = INT64_MAX;
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 7; k++) {
            const snow_site *s = &step[lattice - 1][k];
            snow_site way = {filled[i].x + s->x - from.x, filled[i].y + s->y - from.y, filled[i].z + s->z - from.z};
            int64_t d = distance(lattice, way);
            least = d < least ? d : least;
        }
    }
    return least;
}

/* What the map of the plane may lose: where a block lies in its cells, and a site in its block; the same by tiles.
   Both count twice along the third axis of the hexagonal lattice. */
static int64_t least_told(snow_aggregate_lattice lattice, int64_t free)
{
    static const struct {
        int64_t most, cell, place;
    } told[] = {{8, 2, 4}, {32, 4, 4}, {64, 8, 4}, {256, 16, 32}, {512, 32, 32}, {1024, 64, 32}, {2048, 128, 32}, {4096, 256, 32}};
    int64_t times = lattice == SNOW_AGGREGATE_HEXAGONAL ? 2 : 1;
    int64_t least = 1;
    for (size_t i = 0; i < sizeof told / sizeof told[0]; i++) {
        int64_t loss = times * (told[i].cell + told[i].place - 2);
        int64_t told_so = free - loss < told[i].most ? free - loss : told[i].most;
        least = greater(least, told_so);
    }
    return least;
}

/* One map or the other. */
typedef struct world {
    snow_aggregate_lattice lattice;
    snow_heap heap;
    snow_exits exits;
    snow_plane_map plane;
    snow_space_map space;
} world;

static const snow_plane_box small_plane = {-512, -512, 32, 32};
static const snow_plane_box large_plane = {-1536, -1536, 96, 96};
static const snow_space_box small_space = {-128, -128, -128, 16, 16, 16};
static const snow_space_box large_space = {-256, -256, -256, 32, 32, 32};

static void start_keeping(world *self, snow_aggregate_lattice lattice, bool matter)
{
    self->lattice = lattice;
    self->heap = new_heap();
    assert_int_equal(SNOW_OK, snow_exits_start(&self->exits, &self->heap, lattice));
    if (lattice == SNOW_AGGREGATE_CUBIC)
        assert_int_equal(SNOW_OK, snow_space_map_start(&self->space, &self->heap, &self->exits, matter, small_space,
                                                     SNOW_ISA_BASELINE));
    else
        assert_int_equal(SNOW_OK, snow_plane_map_start(&self->plane, &self->heap, &self->exits, matter, small_plane));
}

static void start(world *self, snow_aggregate_lattice lattice)
{
    start_keeping(self, lattice, false);
}

static void widen(world *self)
{
    if (self->lattice == SNOW_AGGREGATE_CUBIC)
        assert_int_equal(SNOW_OK, snow_space_map_widen(&self->space, &self->heap, large_space));
    else
        assert_int_equal(SNOW_OK, snow_plane_map_widen(&self->plane, &self->heap, large_plane));
}

static void end(world *self)
{
    if (self->lattice == SNOW_AGGREGATE_CUBIC)
        snow_space_map_end(&self->space, &self->heap);
    else
        snow_plane_map_end(&self->plane, &self->heap);
    snow_exits_end(&self->exits, &self->heap);
    assert_int_equal(0, self->heap.used);
}

static void add(world *self, snow_site site, uint64_t landing)
{
    if (self->lattice == SNOW_AGGREGATE_CUBIC) {
        assert_int_equal(SNOW_OK, snow_space_map_reserve(&self->space, &self->heap));
        self->space.landing = landing;
        snow_space_map_add(&self->space, site.x, site.y, site.z, false);
    } else {
        assert_int_equal(SNOW_OK, snow_plane_map_reserve(&self->plane, &self->heap));
        self->plane.landing = landing;
        snow_plane_map_add(&self->plane, site.x, site.y, false);
    }
}

static int32_t tile_of(const world *self, snow_site site)
{
    if (self->lattice == SNOW_AGGREGATE_CUBIC)
        return snow_space_map_tile(&self->space, site.x, site.y, site.z);
    return snow_plane_map_tile(&self->plane, site.x, site.y);
}

static uint32_t look(const world *self, snow_site site)
{
    if (self->lattice == SNOW_AGGREGATE_CUBIC)
        return snow_space_map_look(&self->space, snow_space_map_find(&self->space, tile_of(self, site)), site.x, site.y,
                                   site.z);
    return snow_plane_map_look(&self->plane, snow_plane_map_find(&self->plane, tile_of(self, site)), site.x, site.y);
}

static bool has_changed(const world *self, snow_site site, uint64_t since)
{
    if (self->lattice == SNOW_AGGREGATE_CUBIC)
        return snow_space_map_has_changed(&self->space, tile_of(self, site), since);
    return snow_plane_map_has_changed(&self->plane, tile_of(self, site), since);
}

static snow_site place(const world *self, uint32_t *number, int32_t reach)
{
    bool in_space = self->lattice == SNOW_AGGREGATE_CUBIC;
    int32_t x = draw(number, -reach, reach - 1);
    int32_t y = draw(number, -reach, reach - 1);
    return (snow_site){x, y, in_space ? draw(number, -reach, reach - 1) : 0};
}

/* Some far apart, most close to the one before; as far inside the small box as the maps ask for. */
static void choose_filled(const world *self, snow_site *filled, uint32_t *number)
{
    bool in_space = self->lattice == SNOW_AGGREGATE_CUBIC;
    for (int i = 0; i < FILLED; i++) {
        filled[i] = place(self, number, i % 12 == 0 ? (in_space ? 16 : 340) : (in_space ? 2 : 4));
        if (i % 12 != 0) {
            filled[i].x += filled[i - 1].x;
            filled[i].y += filled[i - 1].y;
            filled[i].z += filled[i - 1].z;
        }
    }
}

/* Places anywhere, and close to filled sites. */
static void choose_places(const world *self, const snow_site *filled, snow_site *places, uint32_t *number)
{
    for (int i = 0; i < PLACES; i++) {
        places[i] = place(self, number, i % 2 == 0 ? (self->lattice == SNOW_AGGREGATE_CUBIC ? 64 : 512) : 12);
        if (i % 2 != 0) {
            const snow_site *near = &filled[draw(number, 0, FILLED - 1)];
            places[i] = (snow_site){places[i].x + near->x, places[i].y + near->y, places[i].z + near->z};
        }
    }
}

static void check_answer(const world *self, snow_site site, const snow_site *filled, int count)
{
    uint32_t seen = look(self, site);
    int64_t free = free_distance(self->lattice, site, filled, count);
    if (seen == SNOW_MAP_BEYOND)
        return;
    if (free < 3) /* sites tell so much themselves */
        assert_int_equal(free, seen);
    assert_true(seen < (uint32_t)self->exits.classes);
    assert_true(seen == 0 || self->exits.table[seen].radius <= free);
    if (seen > 0 && self->lattice != SNOW_AGGREGATE_CUBIC)
        assert_true((int)seen >= snow_exits_class(&self->exits, least_told(self->lattice, free)));
}

static void regions_of_a_lattice_are_free(snow_aggregate_lattice lattice)
{
    world self;
    uint32_t number = 0;
    snow_site filled[FILLED];
    static snow_site places[PLACES];
    start(&self, lattice);
    choose_filled(&self, filled, &number);
    choose_places(&self, filled, places, &number);
    for (int count = 1; count <= FILLED; count++) {
        uint32_t seen[PLACES];
        for (int i = 0; i < PLACES; i++)
            seen[i] = look(&self, places[i]);
        add(&self, filled[count - 1], (uint64_t)count);
        for (int i = 0; i < PLACES; i++) {
            check_answer(&self, places[i], filled, count);
            assert_true(has_changed(&self, places[i], (uint64_t)count - 1) || look(&self, places[i]) == seen[i]);
        }
    }
    end(&self);
}

static void regions_are_free(void **state)
{
    (void)state;
    regions_of_a_lattice_are_free(SNOW_AGGREGATE_SQUARE);
    regions_of_a_lattice_are_free(SNOW_AGGREGATE_HEXAGONAL);
    regions_of_a_lattice_are_free(SNOW_AGGREGATE_CUBIC);
}

/* Round a corner of tiles, where soon no class changes any more. */
static void what_is_around_changes_for(snow_aggregate_lattice lattice)
{
    enum { SIDE = 6, SITES = SIDE * SIDE, STEP = 17 /* shares no divisor with them */ };
    static const snow_site around[4] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    world self;
    start_keeping(&self, lattice, true);
    for (int count = 1; count <= SITES; count++) {
        int place = count * STEP % SITES;
        snow_site site = {place % SIDE - SIDE / 2, place / SIDE - SIDE / 2, 0};
        add(&self, site, (uint64_t)count);
        for (int k = 0; k < 4; k++) {
            snow_site beside = {site.x + around[k].x, site.y + around[k].y, 0};
            assert_true(has_changed(&self, beside, (uint64_t)count - 1));
        }
    }
    end(&self);
}

/* Walkers that may go on from special sites are told what is filled round them. */
static void what_is_around_changes(void **state)
{
    (void)state;
    what_is_around_changes_for(SNOW_AGGREGATE_SQUARE);
    what_is_around_changes_for(SNOW_AGGREGATE_HEXAGONAL);
    what_is_around_changes_for(SNOW_AGGREGATE_CUBIC);
}

static void neither_order_nor_widening_shows_for(snow_aggregate_lattice lattice)
{
    world one;
    world other;
    uint32_t number = 0;
    snow_site filled[FILLED];
    static snow_site places[PLACES];
    start(&one, lattice);
    start(&other, lattice);
    choose_filled(&one, filled, &number);
    choose_places(&one, filled, places, &number);
    widen(&one);
    for (int i = 0; i < FILLED; i++)
        add(&one, filled[i], 0);
    for (int i = 0; i < FILLED; i++) {
        add(&other, filled[FILLED - 1 - i], 0);
        if (i == FILLED / 2)
            widen(&other);
    }
    for (int i = 0; i < PLACES; i++)
        assert_int_equal(look(&one, places[i]), look(&other, places[i]));
    end(&other);
    end(&one);
}

static void neither_order_nor_widening_shows(void **state)
{
    (void)state;
    neither_order_nor_widening_shows_for(SNOW_AGGREGATE_SQUARE);
    neither_order_nor_widening_shows_for(SNOW_AGGREGATE_HEXAGONAL);
    neither_order_nor_widening_shows_for(SNOW_AGGREGATE_CUBIC);
}

/* A few sites in a wide plane, which is widened once more: what the largest cells tell. */
static void far_regions_of_a_lattice_are_free(snow_aggregate_lattice lattice)
{
    static const snow_plane_box wide = {-8192, -8192, 512, 512};
    static const snow_plane_box wider = {-12288, -12288, 768, 768};
    world self = {.lattice = lattice, .heap = new_heap()};
    uint32_t number = 0;
    snow_site filled[12];
    assert_int_equal(SNOW_OK, snow_exits_start(&self.exits, &self.heap, lattice));
    assert_int_equal(SNOW_OK, snow_plane_map_start(&self.plane, &self.heap, &self.exits, false, wide));
    for (int count = 1; count <= 12; count++) {
        filled[count - 1] = place(&self, &number, count < 6 ? 400 : 8000);
        add(&self, filled[count - 1], (uint64_t)count);
        if (count == 8)
            assert_int_equal(SNOW_OK, snow_plane_map_widen(&self.plane, &self.heap, wider));
        for (int i = 0; i < PLACES; i++)
            check_answer(&self, place(&self, &number, 12288), filled, count);
    }
    end(&self);
}

static void far_regions_are_free(void **state)
{
    (void)state;
    far_regions_of_a_lattice_are_free(SNOW_AGGREGATE_SQUARE);
    far_regions_of_a_lattice_are_free(SNOW_AGGREGATE_HEXAGONAL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(regions_are_free),
        cmocka_unit_test(what_is_around_changes),
        cmocka_unit_test(far_regions_are_free),
        cmocka_unit_test(neither_order_nor_widening_shows),
    };
    return cmocka_run_group_tests_name("the maps of aggregation", tests, NULL, NULL);
}
