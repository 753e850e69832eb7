#include "aggregate/exits.h"

#include <stddef.h>

/* The radii. The small ones are those that the map of clearances gives
   (clearance.h); of the large ones few are enough, and stay in the cache. */
static const int32_t radii_square[] = {1,  2,  3,   5,   9,   13,  17,  21,   25,   29,   33,
                                       65, 129, 193, 257, 385, 513, 769, 1025, 2049, 4097, 8193};
static const int32_t radii_hexagonal[] = {1, 2, 3, 5, 9, 13, 17, 21, 25, 29, 33, 65, 129};
static const int32_t radii_cubic[] = {1, 2, 3, 5, 9, 13, 17, 33, 49, 65, 129, 256};

#define COUNT_OF(array) ((int)(sizeof(array) / sizeof(array)[0]))

static int32_t columns_for(int64_t outcomes)
{
    int32_t columns = 1;
    while (columns < outcomes)
        columns *= 2;
    return columns;
}

static int32_t outcomes_of(snow_aggregate_lattice lattice, int32_t radius)
{
    return lattice == SNOW_AGGREGATE_CUBIC ? radius * (radius + 1) / 2 : radius;
}

/* What the columns are cut from while a table is made. */
typedef struct bench {
    double *weight;
    uint32_t *queue; /* columns that lack from the front, those that have too much from the back */
} bench;

static uint16_t value_of(snow_aggregate_lattice lattice, int32_t outcome, int32_t a)
{
    return (uint16_t)(lattice == SNOW_AGGREGATE_CUBIC ? a * 256 + outcome - a * (a + 1) / 2 : outcome);
}

/* M. D. Vose, IEEE Trans. Softw. Eng. 17 (1991) 972: columns of equal weight,
   each with at most two outcomes. */
static void cut_columns(bench *work, snow_exit *exit, int32_t columns)
{
    int32_t lacking = 0;
    int32_t rich = columns;
    for (int32_t i = 0; i < columns; i++) {
        if (work->weight[i] < 1)
            work->queue[lacking++] = (uint32_t)i;
        else
            work->queue[--rich] = (uint32_t)i;
        exit[i].threshold = UINT32_MAX;
        exit[i].other = exit[i].own;
    }
    while (lacking > 0 && rich < columns) {
        uint32_t poor = work->queue[--lacking];
        uint32_t giver = work->queue[rich];
        exit[poor].threshold = (uint32_t)(work->weight[poor] * 0x1p32);
        exit[poor].other = exit[giver].own;
        work->weight[giver] -= 1 - work->weight[poor];
        if (work->weight[giver] < 1) {
            work->queue[lacking++] = giver;
            rich++;
        }
    }
}

/* Weights of the columns: an outcome's chance times the number of sites that it stands for. */
static void weigh_plane(double *weight, int32_t radius, int32_t columns, double mirrored)
{
    double total = 0;
    for (int32_t x = 1; x < radius; x++)
        weight[x] *= mirrored;
    for (int32_t x = 0; x < radius; x++)
        total += weight[x];
    for (int32_t x = 0; x < columns; x++)
        weight[x] = x < radius ? weight[x] * columns / total : 0;
}

static void weigh_space(double *weight, int32_t radius, int32_t columns)
{
    double total = 0;
    for (int32_t a = 0, i = 0; a < radius; a++) {
        for (int32_t b = 0; b <= a; b++, i++) {
            weight[i] *= a == 0 ? 1 : b == 0 || b == a ? 4 : 8;
            total += weight[i];
        }
    }
    int32_t outcomes = outcomes_of(SNOW_AGGREGATE_CUBIC, radius);
    for (int32_t i = 0; i < columns; i++)
        weight[i] = i < outcomes ? weight[i] * columns / total : 0;
}

static snow_status make_table(snow_aggregate_lattice lattice, int32_t radius, bench *work, snow_exit *exit,
                              snow_heap *heap)
{
    int32_t columns = columns_for(outcomes_of(lattice, radius));
    snow_status status = SNOW_OK;
    if (lattice == SNOW_AGGREGATE_SQUARE)
        snow_exits_square(radius, work->weight);
    else if (lattice == SNOW_AGGREGATE_HEXAGONAL)
        status = snow_exits_hexagonal(radius, work->weight, heap);
    else
        status = snow_exits_cubic(radius, work->weight, heap);
    if (status != SNOW_OK)
        return status;
    if (lattice == SNOW_AGGREGATE_CUBIC)
        weigh_space(work->weight, radius, columns);
    else
        weigh_plane(work->weight, radius, columns, lattice == SNOW_AGGREGATE_SQUARE ? 2 : 1);
    for (int32_t i = 0, a = 0; i < columns; i++) {
        while ((a + 1) * (a + 2) / 2 <= i)
            a++;
        exit[i].own = value_of(lattice, i, a);
    }
    cut_columns(work, exit, columns);
    return SNOW_OK;
}

static snow_status make_tables(snow_exits *exits, const int32_t *radii, int count, snow_heap *heap)
{
    int32_t total = 0;
    for (int i = 0; i < count; i++)
        total += columns_for(outcomes_of(exits->lattice, radii[i]));
    int32_t most = columns_for(outcomes_of(exits->lattice, radii[count - 1]));
    bench work = {snow_heap_get_raw(heap, (size_t)most, sizeof *work.weight),
                  snow_heap_get_raw(heap, (size_t)most, sizeof *work.queue)};
    exits->storage = snow_heap_get_raw(heap, (size_t)total, sizeof *exits->storage);
    snow_status status = work.weight == NULL || work.queue == NULL || exits->storage == NULL ? heap->refusal : SNOW_OK;
    snow_exit *exit = exits->storage;
    for (int i = 0; i < count && status == SNOW_OK; i++) {
        int32_t columns = columns_for(outcomes_of(exits->lattice, radii[i]));
        exits->table[i + 1] = (snow_exit_table){exit, (uint32_t)columns - 1, radii[i]};
        status = make_table(exits->lattice, radii[i], &work, exit, heap);
        exit += columns;
    }
    exits->classes = count + 1;
    snow_heap_put(heap, work.queue);
    snow_heap_put(heap, work.weight);
    return status;
}

/* Hexagonal: from here on circles are left; see flight.c. */
static const int32_t radii_of_circles[] = {385, 513, 769, 1025, 2049, 4097, 8193};

static void add_circles(snow_exits *exits)
{
    for (int i = 0; i < COUNT_OF(radii_of_circles); i++)
        exits->table[exits->classes++] = (snow_exit_table){NULL, 0, radii_of_circles[i]};
}

snow_status snow_exits_start(snow_exits *exits, snow_heap *heap, snow_aggregate_lattice lattice)
{
    *exits = (snow_exits){.lattice = lattice};
    snow_status status;
    if (lattice == SNOW_AGGREGATE_SQUARE)
        status = make_tables(exits, radii_square, COUNT_OF(radii_square), heap);
    else if (lattice == SNOW_AGGREGATE_HEXAGONAL)
        status = make_tables(exits, radii_hexagonal, COUNT_OF(radii_hexagonal), heap);
    else
        status = make_tables(exits, radii_cubic, COUNT_OF(radii_cubic), heap);
    if (status != SNOW_OK)
        snow_exits_end(exits, heap);
    else if (lattice == SNOW_AGGREGATE_HEXAGONAL)
        add_circles(exits);
    return status;
}

void snow_exits_end(snow_exits *exits, snow_heap *heap)
{
    snow_heap_put(heap, exits->storage);
    exits->storage = NULL;
}

int snow_exits_class(const snow_exits *exits, int64_t radius)
{
    int class = exits->classes - 1;
    while (class > 1 && exits->table[class].radius > radius)
        class--;
    return class;
}
