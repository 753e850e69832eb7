#include "aggregate/exits.h"

#include "aggregate/alias.h"

#include <stddef.h>

/* The small radii are those that the maps give; of the large ones few are
   enough, and stay in the cache. */
static const int32_t radii_square[] = {1,   2,   3,   5,   7,   9,   11,   13,   15,   17,   19,   21,   25,
                                       29,  33,  37,  41,  45,  49,  57,   65,   73,   81,   89,   97,   113,
                                       128, 160, 192, 224, 256, 288, 320,  352,  384,  448,  512,  576,  640,
                                       704, 768, 896, 1024, 1280, 1536, 1792, 2048, 2560, 3072, 4096, 6144, 8192};
static const int32_t radii_hexagonal[] = {1,  2,  3,  5,  7,  9,  11, 13, 15, 17, 19, 21, 25,
                                          29, 33, 37, 41, 49, 57, 65, 81, 97, 113, 129};
static const int32_t radii_cubic[] = {1,  2,  3,  4,  5,  6,  7,  8,  9,  13, 17,
                                      21, 25, 29, 33, 41, 49, 57, 65, 81, 97, 113};
/* Hexagonal: regions that are left through circles. They need no tables. */
static const int32_t radii_of_circles[] = {257,  288,  320,  352,  384,  416,  448,  480,  512,  576,  640,  704,  768,
                                           832,  896,  960,  1024, 1152, 1280, 1408, 1536, 1664, 1792, 1920, 2048, 2304,
                                           2560, 2816, 3072, 3584, 4096, 5120, 6144, 7168, 8192, 10240, 12288, 14336};

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

snow_status snow_exits_law(snow_aggregate_lattice lattice, int32_t radius, double *chance, snow_heap *heap)
{
    if (lattice == SNOW_AGGREGATE_HEXAGONAL)
        return snow_exits_hexagonal(radius, chance, heap);
    if (lattice == SNOW_AGGREGATE_CUBIC)
        return snow_exits_cubic(radius, chance, heap);
    snow_exits_square(radius, chance);
    return SNOW_OK;
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
    for (uint32_t i = 0; i < outcomes; i++) {
        exit[i].threshold = alias->threshold[i];
        exit[i].outcome[1] = exit[alias->other[i]].outcome[0];
    }
}

static snow_status make_room(snow_exits *exits, snow_heap *heap, catalogue laws)
{
    uint32_t columns = 0;
    for (int i = 0; i < laws.count; i++)
        columns += outcomes_of(exits->lattice, laws.radius[i]);
    exits->exit = snow_heap_get(heap, columns, sizeof *exits->exit);
    return exits->exit == NULL ? heap->refusal : SNOW_OK;
}

static snow_status make_tables(snow_exits *exits, snow_heap *heap, catalogue laws, double *chance, snow_alias *alias)
{
    snow_exit *exit = exits->exit;
    for (int i = 0; i < laws.count; i++) {
        int32_t radius = laws.radius[i];
        snow_status status = snow_exits_law(exits->lattice, radius, chance, heap);
        if (status != SNOW_OK)
            return status;
        uint32_t columns = outcomes_of(exits->lattice, radius);
        exits->table[++exits->classes] = (snow_exit_table){exit, columns, radius};
        exits->place[exits->classes] = (uint32_t)(exit - exits->exit) << SNOW_EXIT_RADIUS_BITS | (uint32_t)radius;
        make_exits(exits->lattice, radius, chance, alias, exit);
        exit += columns;
    }
    exits->classes++;
    return SNOW_OK;
}

static snow_status make_all(snow_exits *exits, snow_heap *heap)
{
    catalogue laws = catalogue_of(exits->lattice);
    uint32_t most = outcomes_of(exits->lattice, laws.radius[laws.count - 1]);
    snow_alias alias;
    snow_status status = snow_alias_start(&alias, heap, most);
    if (status != SNOW_OK)
        return status;
    double *chance = snow_heap_get_raw(heap, most, sizeof *chance);
    if (chance == NULL) {
        snow_alias_end(&alias, heap);
        return heap->refusal;
    }
    status = make_room(exits, heap, laws);
    if (status == SNOW_OK)
        status = make_tables(exits, heap, laws, chance, &alias);
    snow_heap_put(heap, chance);
    snow_alias_end(&alias, heap);
    return status;
}

static void sort_classes(snow_exits *exits)
{
    int class = 1;
    for (int octave = 0; octave < SNOW_EXIT_OCTAVES; octave++) {
        for (int part = 0; part < SNOW_EXIT_PARTS; part++) {
            while (class + 1 < exits->classes &&
                   exits->table[class + 1].radius * SNOW_EXIT_PARTS <= (SNOW_EXIT_PARTS + part) << octave)
                class++;
            exits->class_from[octave][part] = (uint8_t)class;
        }
    }
}

snow_status snow_exits_start(snow_exits *exits, snow_heap *heap, snow_aggregate_lattice lattice)
{
    *exits = (snow_exits){.lattice = lattice};
    snow_status status = make_all(exits, heap);
    for (int class = 0; class <= SNOW_EXIT_CLASSES; class++)
        if (exits->table[class].exit == NULL)
            exits->table[class].exit = exits->exit;
    if (status != SNOW_OK) {
        snow_exits_end(exits, heap);
        return status;
    }
    exits->circles = exits->classes;
    for (int i = 0; lattice == SNOW_AGGREGATE_HEXAGONAL && i < COUNT_OF(radii_of_circles); i++) {
        exits->circle[exits->classes] = radii_of_circles[i];
        exits->table[exits->classes++].radius = radii_of_circles[i];
    }
    sort_classes(exits);
    return SNOW_OK;
}

void snow_exits_end(snow_exits *exits, snow_heap *heap)
{
    snow_heap_put(heap, exits->exit);
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

int snow_exits_class_near(const snow_exits *exits, int64_t radius)
{
    enum { LAST = SNOW_EXIT_OCTAVES - 1 };
    int octave = octave_of(radius);
    if (octave > LAST)
        return exits->class_from[LAST][SNOW_EXIT_PARTS - 1];
    return exits->class_from[octave][(radius * SNOW_EXIT_PARTS >> octave) % SNOW_EXIT_PARTS];
}

int snow_exits_class(const snow_exits *exits, int64_t radius)
{
    int class = snow_exits_class_near(exits, radius);
    while (class + 1 < exits->classes && exits->table[class + 1].radius <= radius)
        class++;
    return class;
}
