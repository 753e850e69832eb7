/* Groups of symmetries, and the part of a domain that decides the rest. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/heap.h"
#include "base/symmetry.h"


static snow_heap plain_heap(void)
{
    snow_options options;
    snow_options_init(&options, sizeof options);
    snow_heap heap;
    snow_heap_start(&heap, &options);
    return heap;
}

enum { SUBGROUPS = 16 };

/* All sets that are closed. */
static size_t find_groups(snow_group groups[SUBGROUPS])
{
    size_t count = 0;
    for (snow_group set = 0; set <= SNOW_GROUP_FULL; set++) {
        if (!snow_group_is_closed(set))
            continue;
        assert_true(count < SUBGROUPS);
        groups[count++] = set;
    }
    return count;
}

static void the_hexagon_has_sixteen_subgroups(void **state)
{
    (void)state;
    snow_group groups[SUBGROUPS];
    assert_int_equal(SUBGROUPS, find_groups(groups));
    int of_order[13] = {0}, with_mirror = 0;
    for (size_t i = 0; i < SUBGROUPS; i++) {
        of_order[snow_group_order(groups[i])]++;
        with_mirror += snow_group_reflects(groups[i]);
    }
    /* Trivial; C2 and six mirrors; C3; three D2; C6 and two D3; D6. */
    assert_int_equal(1, of_order[1]);
    assert_int_equal(7, of_order[2]);
    assert_int_equal(1, of_order[3]);
    assert_int_equal(3, of_order[4]);
    assert_int_equal(3, of_order[6]);
    assert_int_equal(1, of_order[12]);
    assert_int_equal(12, with_mirror);
    assert_false(snow_group_is_closed(0));
    assert_false(snow_group_is_closed(SNOW_GROUP_FULL + 2));
}

static void images_and_representatives_belong_together(void **state)
{
    (void)state;
    snow_group groups[SUBGROUPS];
    find_groups(groups);
    for (size_t g = 0; g < SUBGROUPS; g++) {
        for (int32_t q = -9; q <= 9; q++) {
            for (int32_t r = -9; r <= 9; r++) {
                snow_cell images[12];
                size_t count = snow_group_images(groups[g], q, r, images);
                assert_int_equal(0, snow_group_order(groups[g]) % (int)count);
                snow_cell chosen = snow_group_representative(groups[g], q, r);
                size_t found = 0;
                for (size_t i = 0; i < count; i++) {
                    snow_cell other = snow_group_representative(groups[g], images[i].q, images[i].r);
                    assert_int_equal(chosen.q, other.q);
                    assert_int_equal(chosen.r, other.r);
                    found += images[i].q == chosen.q && images[i].r == chosen.r;
                    for (size_t k = 0; k < i; k++)
                        assert_true(images[k].q != images[i].q || images[k].r != images[i].r);
                }
                assert_int_equal(1, found);
            }
        }
    }
}

/* Each orbit of the domain has just one cell in the part, and the part lies in the domain. */
static void assert_partition(snow_group group, const snow_domain *domain, snow_heap *heap)
{
    snow_domain part;
    assert_int_equal(SNOW_OK, snow_group_fundamental(group, domain, heap, &part));
    size_t covered = 0, cells = 0;
    for (int32_t row = 0; row < part.rows; row++) {
        int32_t r = part.top + row;
        for (int32_t q = part.run[row].first; q < part.run[row].end; q++) {
            assert_true(snow_domain_has(domain, q, r));
            snow_cell images[12];
            covered += snow_group_images(group, q, r, images);
            snow_cell chosen = snow_group_representative(group, q, r);
            assert_true(chosen.q == q && chosen.r == r);
            cells++;
        }
    }
    assert_int_equal(cells, part.cells);
    assert_int_equal(domain->cells, covered);
    snow_domain_end(&part, heap);
}

static void fundamental_parts_partition_discs_and_hexagons(void **state)
{
    (void)state;
    snow_heap heap = plain_heap();
    snow_group groups[SUBGROUPS];
    find_groups(groups);
    for (int32_t radius = 1; radius <= 30; radius++) {
        snow_domain disc, hexagon;
        assert_int_equal(SNOW_OK, snow_domain_disc(&disc, &heap, radius));
        assert_int_equal(SNOW_OK, snow_domain_hexagon(&hexagon, &heap, radius));
        assert_int_equal(SNOW_GROUP_FULL, snow_group_of_domain(&disc));
        assert_int_equal(SNOW_GROUP_FULL, snow_group_of_domain(&hexagon));
        for (size_t g = 0; g < SUBGROUPS; g++) {
            assert_partition(groups[g], &disc, &heap);
            assert_partition(groups[g], &hexagon, &heap);
        }
        snow_domain_end(&disc, &heap);
        snow_domain_end(&hexagon, &heap);
    }
    assert_int_equal(0, heap.used);
}

/* Whether every cell's image lies inside, cell by cell. */
static bool has_symmetry(const snow_domain *domain, int symmetry)
{
    for (int32_t row = 0; row < domain->rows; row++) {
        int32_t r = domain->top + row;
        for (int32_t q = domain->run[row].first; q < domain->run[row].end; q++) {
            int32_t x = symmetry >= 6 ? r : q;
            int32_t y = symmetry >= 6 ? q : r;
            for (int turn = 0; turn < symmetry % 6; turn++) {
                int32_t turned = -y;
                y = x + y;
                x = turned;
            }
            if (!snow_domain_has(domain, x, y))
                return false;
        }
    }
    return true;
}

static void rectangles_have_the_symmetries_that_their_cells_have(void **state)
{
    (void)state;
    snow_heap heap = plain_heap();
    for (int32_t width = 1; width <= 12; width++) {
        for (int32_t height = 1; height <= 12; height++) {
            snow_domain rectangle;
            assert_int_equal(SNOW_OK, snow_domain_rectangle(&rectangle, &heap, width, height));
            snow_group group = snow_group_of_domain(&rectangle);
            for (int symmetry = 0; symmetry < 12; symmetry++)
                assert_int_equal(has_symmetry(&rectangle, symmetry), snow_group_has(group, symmetry));
            assert_true(snow_group_is_closed(group));
            assert_partition(group, &rectangle, &heap);
            snow_domain_end(&rectangle, &heap);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_hexagon_has_sixteen_subgroups),
        cmocka_unit_test(images_and_representatives_belong_together),
        cmocka_unit_test(fundamental_parts_partition_discs_and_hexagons),
        cmocka_unit_test(rectangles_have_the_symmetries_that_their_cells_have),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
