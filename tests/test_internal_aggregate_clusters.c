/* Drifting clusters against a plain account of who is on which site: every move must come to touch the clusters that
   the account tells, whatever way it is found by: site by site, by shapes, or by the gaps between the last clusters. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "aggregate/gaps.h"

enum { MOST_PARTICLES = 4000 };

typedef struct account {
    clusters self;
    snow_heap heap;
    uint32_t *owner; /* by site: 1 + cluster, 0: nobody */
    snow_stream random;
} account;

static uint32_t *owner_at(account *all, snow_site site)
{
    return &all->owner[snow_box_number(&all->self.box, snow_box_site(&all->self.box, site))];
}

static snow_site site_of(const account *all, const cluster *of, uint32_t member)
{
    const clusters *self = &all->self;
    return snow_clusters_site(self, of, self->position[self->member[of->first + member]]);
}

static void write_owners(account *all, uint32_t number)
{
    const cluster *it = &all->self.cluster[number];
    for (uint32_t i = 0; i < it->mass; i++)
        *owner_at(all, site_of(all, it, i)) = number + 1;
}

static void merge(account *all, uint32_t number, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        number = snow_clusters_merge(&all->self, &all->heap, number, all->self.touched[i], 0);
    write_owners(all, number);
}

static void scatter(account *all)
{
    clusters *self = &all->self;
    uint32_t side = (uint32_t)self->box.side;
    for (uint32_t particle = 0; particle < self->particles;) {
        snow_site site = {(int32_t)snow_stream_below(&all->random, side),
                          (int32_t)snow_stream_below(&all->random, side), 0};
        site.z = self->box.axes == 3 ? (int32_t)snow_stream_below(&all->random, side) : 0;
        if (*owner_at(all, site) != 0)
            continue;
        snow_clusters_add(self, particle, site);
        write_owners(all, particle);
        merge(all, particle, snow_clusters_find_neighbours(self, particle));
        assert_true(self->filled <= 3 * self->particles); /* the list of members has no more room */
        particle++;
    }
}

/* Moves the cluster in the account; marks whom it touches then. */
static void move_account(account *all, uint32_t number, snow_site step, bool *touched)
{
    static snow_site sites[MOST_PARTICLES];
    clusters *self = &all->self;
    const cluster *it = &self->cluster[number];
    memset(touched, 0, self->particles * sizeof *touched);
    for (uint32_t i = 0; i < it->mass; i++) {
        sites[i] = site_of(all, it, i);
        *owner_at(all, sites[i]) = 0;
    }
    for (uint32_t i = 0; i < it->mass; i++) {
        snow_site site = aggregate_moved(sites[i], step);
        assert_int_equal(0, *owner_at(all, site));
        for (int side = 0; side < snow_box_directions(&self->box); side++) {
            uint32_t there = *owner_at(all, aggregate_moved(site, snow_box_steps[side]));
            if (there != 0)
                touched[there - 1] = true;
        }
    }
    for (uint32_t i = 0; i < it->mass; i++)
        *owner_at(all, aggregate_moved(sites[i], step)) = number + 1;
}

static void move_one(account *all, bool *touched)
{
    clusters *self = &all->self;
    uint32_t number = self->live[snow_stream_below(&all->random, self->lives)];
    int direction = (int)snow_stream_below(&all->random, (uint32_t)snow_box_directions(&self->box));
    move_account(all, number, snow_box_steps[direction], touched);
    uint32_t count;
    snow_status status = snow_gaps_apply(self)
                             ? snow_clusters_move_few(self, &all->heap, number, direction, &count)
                             : snow_clusters_move(self, &all->heap, number, direction, false, &count);
    assert_int_equal(SNOW_OK, status);
    uint32_t expected = 0;
    for (uint32_t i = 0; i < self->particles; i++)
        expected += touched[i];
    assert_int_equal(expected, count);
    for (uint32_t i = 0; i < count; i++)
        assert_true(touched[self->touched[i]] && (i == 0 || self->touched[i - 1] < self->touched[i]));
    if (count > 0)
        merge(all, number, count);
}

static void check_box(account *all)
{
    clusters *self = &all->self;
    snow_clusters_show(self);
    int32_t layers = self->box.axes == 3 ? self->box.side : 1;
    for (int32_t z = 0; z < layers; z++)
        for (int32_t y = 0; y < self->box.side; y++)
            for (int32_t x = 0; x < self->box.side; x++) {
                snow_site site = {x, y, z};
                assert_int_equal(*owner_at(all, site) != 0, snow_box_has(&self->box, site));
                if (!snow_gaps_apply(self))
                    assert_int_equal(*owner_at(all, site), snow_clusters_at(self, site));
            }
}

static void drift(uint32_t particles, double density, int axes, uint64_t seed, int64_t moves)
{
    account all = {.random = snow_stream_start(seed, SNOW_RANDOM_WALK, 0)};
    snow_options options;
    snow_options_init(&options, sizeof options);
    snow_heap_start(&all.heap, &options);
    assert_int_equal(SNOW_OK, snow_clusters_start(&all.self, &all.heap, particles, density, axes));
    size_t side = (size_t)all.self.box.side;
    all.owner = calloc(side * side * (axes == 3 ? side : 1), sizeof *all.owner);
    bool *touched = calloc(particles, sizeof *touched);
    assert_true(all.owner != NULL && touched != NULL);
    scatter(&all);
    check_box(&all);
    int64_t move = 0;
    for (; move < moves && all.self.lives > 1; move++)
        move_one(&all, touched);
    assert_true(move == moves || all.self.lives == 1);
    check_box(&all);
    free(touched);
    free(all.owner);
    snow_clusters_end(&all.self, &all.heap);
}

/* So many merge while they are scattered that the room for members is spent before all have come. */
static void crowded_from_the_start(void **state)
{
    (void)state;
    for (uint32_t particles = 1; particles < 60; particles++)
        for (uint64_t seed = 0; seed < 10; seed++)
            drift(particles, 0.5, 2 + (int)(seed % 2), seed, 0);
}

static void few_in_a_wide_box(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 4; seed++)
        drift(400, 0.05, 2, seed, 200000);
}

/* Clusters that reach round the box. */
static void many_in_a_small_box(void **state)
{
    (void)state;
    drift(800, 800.0 / (64 * 64), 2, 5, 50000);
    drift(1500, 1500.0 / (77 * 77), 2, 6, 50000);
    drift(3000, 0.2, 2, 7, 50000);
}

static void in_a_box_that_is_too_small_for_words(void **state)
{
    (void)state;
    drift(100, 0.05, 2, 8, 50000);
    drift(200, 0.1, 3, 9, 20000);
}

static void in_space(void **state)
{
    (void)state;
    drift(2700, 0.01, 3, 10, 30000);
    drift(MOST_PARTICLES, 0.014, 3, 11, 30000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crowded_from_the_start),
        cmocka_unit_test(few_in_a_wide_box),
        cmocka_unit_test(many_in_a_small_box),
        cmocka_unit_test(in_a_box_that_is_too_small_for_words),
        cmocka_unit_test(in_space),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
