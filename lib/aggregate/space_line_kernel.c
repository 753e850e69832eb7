/* Compiled once for each instruction set, with SNOW_KERNEL naming it. */
#include "aggregate/space_line.h"

#include <string.h>

#define PASTE(a, b) a##b
#define NAME(a, b) PASTE(a, b)

enum { PAIRS = SNOW_SPACE_PAIRS, ROWS = SNOW_SPACE_ROWS };

/* Pairs of some rows of a layer. */
#if defined(__AVX2__)
#include <immintrin.h>
enum { BYTES = 32 };
#else
enum { BYTES = 16 };
#endif
enum { WORDS = BYTES / sizeof(uintptr_t), TIMES = 32 / BYTES };
typedef int16_t pairs __attribute__((vector_size(BYTES)));

/* Nobody else writes, so all may be read as plain numbers. */
static inline pairs get(const void *from)
{
    pairs numbers;
    memcpy(&numbers, from, sizeof numbers);
    return numbers;
}

static inline void put(_Atomic uintptr_t *to, pairs numbers)
{
    uintptr_t word[WORDS];
    memcpy(word, &numbers, sizeof word);
    for (int i = 0; i < WORDS; i++)
        SNOW_MAP_PUT(to[i], word[i]);
}

static inline bool has_any(pairs numbers)
{
#if defined(__AVX2__)
    return _mm256_testz_si256((__m256i)numbers, (__m256i)numbers) == 0;
#else
    uint64_t half[2];
    memcpy(half, &numbers, sizeof half);
    return (half[0] | half[1]) != 0;
#endif
}

/* Where the least distances of a pair are equal, so are those of the sites that are so near to either; else the
   nearer one has it all: distances differ by at most 1. */
static inline pairs nearer(pairs known, pairs print)
{
    pairs not_further = print <= (known | 255);
    pairs further = (print | 255) < known;
    return (known & (print | ~not_further) & ~further) | (print & further);
}

static int greater(int a, int b)
{
    return a > b ? a : b;
}

static int lesser(int a, int b)
{
    return a < b ? a : b;
}

bool NAME(snow_space_line_lower_, SNOW_KERNEL)(snow_space_line *line, const snow_space_print *print, int lines,
                                               int rows, int layers)
{
    int first = greater(0, -PAIRS / 2 - layers);
    int end = lesser(4, PAIRS / 2 + 1 - layers);
    const int16_t(*across)[ROWS][4] = print->pair[lines + 1];
    pairs any = {0};
    for (int layer = first; layer < end; layer++) {
        const int16_t *from = across[PAIRS / 2 + layers + layer][rows + ROWS / 2];
        _Atomic uintptr_t *word = &line->word[layer * TIMES * WORDS];
        for (int i = 0; i < TIMES; i++, word += WORDS, from += BYTES / 2) {
            pairs known = get(word);
            pairs now = nearer(known, get(from));
            any |= now ^ known;
            if (has_any(now ^ known))
                put(word, now);
        }
    }
    return has_any(any);
}
