#include "aggregate/space_line.h"

#include <string.h>

enum {
    REACH = SNOW_SPACE_SITES,
    PAIRS = SNOW_SPACE_PAIRS,
    ROWS = SNOW_SPACE_ROWS,
    UNKNOWN = (REACH + 1) << 8 /* of a pair that is further away */
};

typedef int16_t eight __attribute__((vector_size(16))); /* pairs of two rows of a line */

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

/* Nobody else writes, so all may be read as plain numbers. */
static eight get(const void *from)
{
    eight numbers;
    memcpy(&numbers, from, sizeof numbers);
    return numbers;
}

static void put(_Atomic uintptr_t *to, eight numbers)
{
    uintptr_t word[16 / sizeof(uintptr_t)];
    memcpy(word, &numbers, sizeof word);
    for (size_t i = 0; i < 16 / sizeof *to; i++)
        SNOW_MAP_PUT(to[i], word[i]);
}

static bool has_any(eight numbers)
{
    uint64_t half[2];
    memcpy(half, &numbers, sizeof half);
    return (half[0] | half[1]) != 0;
}

/* Where the least distances of a pair are equal, so are those of the sites that are so near to either; else the
   nearer one has it all: distances differ by at most 1. */
static eight nearer(eight known, eight print)
{
    eight not_further = print <= (known | 255);
    eight further = (print | 255) < known;
    return (known & (print | ~not_further) & ~further) | (print & further);
}

bool snow_space_line_lower(snow_space_line *line, const snow_space_print *print, int lines, int rows, int layers)
{
    enum { WORDS = 16 / sizeof line->word[0] };
    int first = greater(0, -PAIRS / 2 - layers);
    int end = lesser(4, PAIRS / 2 + 1 - layers);
    const int16_t(*across)[ROWS][4] = &print->pair[lines + 1][PAIRS / 2 + layers];
    eight any = {0};
    for (int layer = first; layer < end; layer++) {
        const int16_t(*row)[4] = &across[layer][rows + ROWS / 2];
        _Atomic uintptr_t *word = &line->word[layer * 2 * WORDS];
        eight now[2] = {nearer(get(word), get(row)), nearer(get(word + WORDS), get(row + 2))};
        eight differs = (now[0] ^ get(word)) | (now[1] ^ get(word + WORDS));
        any |= differs;
        if (has_any(differs)) {
            put(word, now[0]);
            put(word + WORDS, now[1]);
        }
    }
    return has_any(any);
}
