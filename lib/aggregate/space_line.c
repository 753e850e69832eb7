#include "aggregate/space_line.h"

enum {
    REACH = SNOW_SPACE_SITES,
    PAIRS = SNOW_SPACE_PAIRS,
    ROWS = SNOW_SPACE_ROWS,
    UNKNOWN = (REACH + 1) << 8 /* of a pair that is further away */
};

static int magnitude(int x)
{
    return x < 0 ? -x : x;
}

static int greater(int a, int b)
{
    return a > b ? a : b;
}

static int lesser(int a, int b)
{
    return a < b ? a : b;
}

static int apart(int x, int y, int z)
{
    return greater(greater(magnitude(x), magnitude(y)), magnitude(z));
}

/* Distance to the special sites that a filled site at 0 makes. */
static int distance_to_contact(int x, int y, int z)
{
    int least = apart(x, y, z);
    for (int step = -1; step <= 1; step += 2) {
        least = lesser(least, apart(x - step, y, z));
        least = lesser(least, apart(x, y - step, z));
        least = lesser(least, apart(x, y, z - step));
    }
    return least;
}

/* What a line says of a pair, where the filled site lies so far from the pair's first one. */
static int16_t print_of_pair(int x, int y, int z)
{
    int distance[8];
    int least = REACH + 1;
    for (int site = 0; site < 8; site++) {
        distance[site] = distance_to_contact(x - site % 2, y - site / 2 % 2, z - site / 4);
        least = lesser(least, distance[site]);
    }
    int print = least << 8;
    for (int site = 0; site < 8 && least <= REACH; site++)
        print |= (distance[site] > least) << site;
    return (int16_t)print;
}

static void make_print(snow_space_print *print, int place)
{
    for (int line = 0; line < SNOW_SPACE_LINES; line++) {
        for (int layer = 0; layer < PAIRS; layer++) {
            for (int row = 0; row < ROWS; row++) {
                for (int i = 0; i < 4; i++) {
                    int x = place % 8 - 2 * (4 * (line - 1) + i);
                    int y = place / 8 % 2 - 2 * (row - ROWS / 2);
                    int z = place / 16 - 2 * (layer - PAIRS / 2);
                    print->pair[line][layer][row][i] = print_of_pair(x, y, z);
                }
            }
        }
    }
}

void snow_space_prints_make(snow_space_print print[SNOW_SPACE_PRINTS])
{
    for (int place = 0; place < SNOW_SPACE_PRINTS; place++)
        make_print(&print[place], place);
}

void snow_space_line_start(snow_space_line *line)
{
    for (int i = 0; i < 64; i++)
        atomic_init(&line->pair[i], UNKNOWN);
}

snow_space_lower snow_space_line_choose(snow_isa isa)
{
#ifdef SNOW_HAVE_X86_KERNELS
    if (isa == SNOW_ISA_AVX2 || isa == SNOW_ISA_AVX512)
        return snow_space_line_lower_avx2;
#else
    (void)isa;
#endif
    return snow_space_line_lower_baseline;
}
