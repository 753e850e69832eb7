#include "aggregate/exits.h"

#include "aggregate/alias.h"

#include <stddef.h>

/* The small radii are those that the maps give; of the large ones few are
   enough, and stay in the cache. */
static const int32_t radii_square[] = {1,  2,  3,  5,   9,   13,  17,  21,  25,  29,   33,   49,
                                       65, 97, 129, 193, 257, 385, 513, 769, 1025, 2049, 4097, 8193};
static const int32_t radii_hexagonal[] = {1, 2, 3, 5, 9, 13, 17, 21, 25, 29, 33, 49, 65, 97, 129};
static const int32_t radii_cubic[] = {1, 2, 3, 5, 9, 13, 17, 33, 49, 65, 97, 129, 193, 256};
/* Hexagonal: regions that are left through circles. */
static const int32_t radii_of_circles[] = {257, 321, 385,  449,  513,  577,  641,  705,  769,
                                           833, 897, 1025, 2049, 3073, 4097, 6145, 8193, 14337};

enum { MOST_STEPS = 512 }; /* columns of a small table */

#define COUNT_OF(array) ((int)(sizeof(array) / sizeof(array)[0]))

/* The laws of one lattice. */
typedef struct catalogue {
    const int32_t *radius;
    int count;
} catalogue;

static catalogue catalogue_of(snow_aggregate_lattice lattice)
{
    if (lattice == SNOW_AGGREGATE_SQUARE)
        return (catalogue){radii_square, COUNT_OF(radii_square)};
    if (lattice == SNOW_AGGREGATE_HEXAGONAL)
        return (catalogue){radii_hexagonal, COUNT_OF(radii_hexagonal)};
    return (catalogue){radii_cubic, COUNT_OF(radii_cubic)};
}

/* Sites of one side that symmetry tells apart. */
static uint32_t outcomes_of(snow_aggregate_lattice lattice, int32_t radius)
{
    uint32_t r = (uint32_t)radius;
    return lattice == SNOW_AGGREGATE_CUBIC ? r * (r + 1) / 2 : r;
}

/* Sites of all sides. */
static uint32_t sites_of(snow_aggregate_lattice lattice, int32_t radius)
{
    uint32_t side = 2 * (uint32_t)radius - 1;
    if (lattice == SNOW_AGGREGATE_SQUARE)
        return 4 * side;
    return 6 * (lattice == SNOW_AGGREGATE_HEXAGONAL ? (uint32_t)radius : side * side);
}

static bool is_small(snow_aggregate_lattice lattice, int32_t radius)
{
    return snow_alias_columns(sites_of(lattice, radius)) <= MOST_STEPS;
}

static snow_status law_of(snow_aggregate_lattice lattice, int32_t radius, double *chance, snow_heap *heap)
{
    if (lattice == SNOW_AGGREGATE_HEXAGONAL)
        return snow_exits_hexagonal(radius, chance, heap);
    if (lattice == SNOW_AGGREGATE_CUBIC)
        return snow_exits_cubic(radius, chance, heap);
    snow_exits_square(radius, chance);
    return SNOW_OK;
}

/* The way to the site at offsets a and b of a side. */
static snow_exit_step step_to(snow_aggregate_lattice lattice, int32_t radius, int side, int32_t a, int32_t b)
{
    static const int corner[6][2] = {{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}};
    int32_t way[3] = {0, 0, 0};
    if (lattice == SNOW_AGGREGATE_HEXAGONAL) {
        const int *from = corner[side];
        const int *along = corner[(side + 2) % 6];
        way[0] = radius * from[0] + a * along[0];
        way[1] = radius * from[1] + a * along[1];
    } else {
        int axis = side / 2;
        way[axis] = side % 2 == 0 ? radius : -radius;
        way[lattice == SNOW_AGGREGATE_SQUARE ? 1 - axis : (axis + 1) % 3] = a;
        if (lattice == SNOW_AGGREGATE_CUBIC)
            way[(axis + 2) % 3] = b;
    }
    return (snow_exit_step){.way = {{(int8_t)way[0], (int8_t)way[1], (int8_t)way[2]}}};
}

static int32_t magnitude(int32_t x)
{
    return x < 0 ? -x : x;
}

static double chance_at(snow_aggregate_lattice lattice, const double *chance, int32_t a, int32_t b)
{
    if (lattice == SNOW_AGGREGATE_HEXAGONAL)
        return chance[a];
    int32_t major = magnitude(a) > magnitude(b) ? magnitude(a) : magnitude(b);
    int32_t minor = magnitude(a) + magnitude(b) - major;
    return lattice == SNOW_AGGREGATE_SQUARE ? chance[major] : chance[major * (major + 1) / 2 + minor];
}

/* Every site, and its chance into `weight`. */
static uint32_t list_sites(snow_aggregate_lattice lattice, int32_t radius, const double *chance, double *weight,
                           snow_exit_step *step)
{
    bool is_hexagonal = lattice == SNOW_AGGREGATE_HEXAGONAL;
    int32_t least_a = is_hexagonal ? 0 : 1 - radius;
    int32_t least_b = lattice == SNOW_AGGREGATE_CUBIC ? 1 - radius : 0;
    uint32_t count = 0;
    for (int side = 0; side < (lattice == SNOW_AGGREGATE_SQUARE ? 4 : 6); side++) {
        for (int32_t a = least_a; a < radius; a++) {
            for (int32_t b = least_b; b <= -least_b; b++) {
                weight[count] = chance_at(lattice, chance, a, b);
                step[count++] = step_to(lattice, radius, side, a, b);
            }
        }
    }
    return count;
}

static void make_steps(snow_aggregate_lattice lattice, int32_t radius, const double *chance, snow_alias *alias,
                       snow_exit_step *step)
{
    uint32_t outcomes = list_sites(lattice, radius, chance, alias->weight, step);
    uint32_t columns = snow_alias_columns(outcomes);
    snow_alias_cut(alias, outcomes);
    for (uint32_t i = 0; i < columns; i++) {
        const snow_exit_step *other = &step[alias->other[i]];
        step[i].threshold = alias->threshold[i];
        for (int axis = 0; axis < 3; axis++)
            step[i].way[1][axis] = other->way[0][axis];
    }
}

/* How many sites of a side an outcome stands for: its images under the mirrors that the walk draws. */
static double images(snow_aggregate_lattice lattice, int32_t a, int32_t b)
{
    if (lattice == SNOW_AGGREGATE_HEXAGONAL)
        return 1;
    if (lattice == SNOW_AGGREGATE_SQUARE)
        return a == 0 ? 1 : 2;
    return a == 0 ? 1 : b == 0 || b == a ? 4 : 8;
}

static void make_exits(snow_aggregate_lattice lattice, int32_t radius, const double *chance, snow_alias *alias,
                       snow_exit *exit)
{
    bool is_cubic = lattice == SNOW_AGGREGATE_CUBIC;
    uint32_t outcomes = 0;
    for (int32_t a = 0; a < radius; a++) {
        for (int32_t b = 0; b <= (is_cubic ? a : 0); b++) {
            alias->weight[outcomes] = chance[outcomes] * images(lattice, a, b);
            exit[outcomes++].outcome[0] = (uint16_t)(is_cubic ? 256 * a + b : a);
        }
    }
    snow_alias_cut(alias, outcomes);
    uint32_t columns = snow_alias_columns(outcomes);
    for (uint32_t i = 0; i < columns; i++) {
        exit[i].threshold = alias->threshold[i];
        exit[i].outcome[1] = exit[alias->other[i]].outcome[0];
    }
}

static snow_status make_room(snow_exits *exits, snow_heap *heap, catalogue laws)
{
    uint32_t exit_columns = 0;
    uint32_t step_columns = 0;
    for (int i = 0; i < laws.count; i++) {
        exit_columns += snow_alias_columns(outcomes_of(exits->lattice, laws.radius[i]));
        if (is_small(exits->lattice, laws.radius[i]))
            step_columns += snow_alias_columns(sites_of(exits->lattice, laws.radius[i]));
    }
    exits->exit = snow_heap_get(heap, exit_columns, sizeof *exits->exit);
    exits->step = snow_heap_get(heap, step_columns, sizeof *exits->step);
    return exits->exit == NULL || exits->step == NULL ? heap->refusal : SNOW_OK;
}

static snow_status make_tables(snow_exits *exits, snow_heap *heap, catalogue laws, double *chance, snow_alias *alias)
{
    snow_aggregate_lattice lattice = exits->lattice;
    snow_exit *exit = exits->exit;
    snow_exit_step *step = exits->step;
    for (int i = 0; i < laws.count; i++) {
        int32_t radius = laws.radius[i];
        snow_status status = law_of(lattice, radius, chance, heap);
        if (status != SNOW_OK)
            return status;
        uint32_t columns = snow_alias_columns(outcomes_of(lattice, radius));
        snow_exit_table *table = &exits->table[++exits->classes];
        *table = (snow_exit_table){.exit = exit, .exit_mask = columns - 1, .radius = radius};
        make_exits(lattice, radius, chance, alias, exit);
        exit += columns;
        if (!is_small(lattice, radius))
            continue;
        columns = snow_alias_columns(sites_of(lattice, radius));
        table->step = step;
        table->step_mask = columns - 1;
        make_steps(lattice, radius, chance, alias, step);
        step += columns;
        exits->small = exits->classes;
    }
    exits->classes++;
    return SNOW_OK;
}

static snow_status make_all(snow_exits *exits, snow_heap *heap)
{
    catalogue laws = catalogue_of(exits->lattice);
    uint32_t most = snow_alias_columns(outcomes_of(exits->lattice, laws.radius[laws.count - 1]));
    most = most > MOST_STEPS ? most : MOST_STEPS;
    snow_alias alias;
    snow_status status = snow_alias_start(&alias, heap, most);
    if (status != SNOW_OK)
        return status;
    double *chance = snow_heap_get_raw(heap, most, sizeof *chance);
    status = chance == NULL ? heap->refusal : make_room(exits, heap, laws);
    if (status == SNOW_OK)
        status = make_tables(exits, heap, laws, chance, &alias);
    snow_heap_put(heap, chance);
    snow_alias_end(&alias, heap);
    return status;
}

static void sort_octaves(snow_exits *exits)
{
    for (int octave = 0; octave < SNOW_EXIT_OCTAVES; octave++) {
        int class = exits->classes - 1;
        while (exits->table[class].radius > 1 << octave)
            class--;
        exits->class_of_octave[octave] = (uint8_t)class;
    }
}

snow_status snow_exits_start(snow_exits *exits, snow_heap *heap, snow_aggregate_lattice lattice)
{
    *exits = (snow_exits){.lattice = lattice};
    snow_status status = make_all(exits, heap);
    if (status != SNOW_OK) {
        snow_exits_end(exits, heap);
        return status;
    }
    if (lattice == SNOW_AGGREGATE_HEXAGONAL)
        for (int i = 0; i < COUNT_OF(radii_of_circles); i++)
            exits->table[exits->classes++] = (snow_exit_table){.radius = radii_of_circles[i]};
    sort_octaves(exits);
    return SNOW_OK;
}

void snow_exits_end(snow_exits *exits, snow_heap *heap)
{
    snow_heap_put(heap, exits->step);
    snow_heap_put(heap, exits->exit);
    exits->step = NULL;
    exits->exit = NULL;
}

static int octave_of(int64_t radius)
{
#if defined(__GNUC__)
    return 63 - __builtin_clzll((unsigned long long)radius);
#else
    int octave = 0;
    while (radius >>= 1)
        octave++;
    return octave;
#endif
}

int snow_exits_class(const snow_exits *exits, int64_t radius)
{
    enum { LAST = SNOW_EXIT_OCTAVES - 1 };
    int octave = octave_of(radius);
    int class = exits->class_of_octave[octave < LAST ? octave : LAST];
    while (class + 1 < exits->classes && exits->table[class + 1].radius <= radius)
        class++;
    return class;
}
