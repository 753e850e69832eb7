/* Compiled once for each instruction set, with SNOW_KERNEL naming it. Vectors
   are those of gcc and clang, as wide as the instruction set has them. */
#include "packard/tile_kernel.h"

#include <string.h>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#define JOIN(a, b) a##b
#define TABLE(isa) JOIN(snow_tile_kernel_, isa)

#if defined(__AVX512F__)
#define LANES 8
#elif defined(__AVX2__)
#define LANES 4
#else
#define LANES 2
#endif
#define PARTS (TILE_STRIPS / LANES)

typedef uint64_t vector __attribute__((vector_size(LANES * 8)));
typedef uint64_t stored_vector __attribute__((vector_size(LANES * 8), may_alias));

#define UNROLL _Pragma("GCC unroll 8")

static inline vector load(const uint64_t *from)
{
    return (vector) * (const stored_vector *)from;
}

static inline void store(uint64_t *to, vector value)
{
    *(stored_vector *)to = value;
}

static inline vector spread(uint64_t x)
{
    return x - (vector){0};
}

#if defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector)
#define SHUFFLE(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#endif
#endif
#ifndef SHUFFLE
#define SHUFFLE(a, b, ...) __builtin_shuffle(a, b, (vector){__VA_ARGS__})
#endif

/* The last word of `before`, then all but the last of `here`. */
static inline vector moved_up(vector before, vector here)
{
#if LANES == 8
    return SHUFFLE(before, here, 7, 8, 9, 10, 11, 12, 13, 14);
#elif LANES == 4
    return SHUFFLE(before, here, 3, 4, 5, 6);
#else
    return SHUFFLE(before, here, 1, 2);
#endif
}

/* All but the first word of `here`, then the first of `after`. */
static inline vector moved_down(vector here, vector after)
{
#if LANES == 8
    return SHUFFLE(here, after, 1, 2, 3, 4, 5, 6, 7, 8);
#elif LANES == 4
    return SHUFFLE(here, after, 1, 2, 3, 4);
#else
    return SHUFFLE(here, after, 1, 2);
#endif
}

/* The bits of a column that belong to a part of the rows. */
enum { PART_BITS = SNOW_TILE_SIDE / PARTS };

/* The first and last cells of the rows of a part, or the cells to the left and right of them: what row i of each strip
   has there is taken out and put in as bits 0 and 63 of its words. */
#if LANES == 4

/* Row i's bit 0 stands in bit 0 of byte i, and its bit 63 in bit 7 of the byte before: so one shuffle of bytes, as all
   bytes go round by i, brings both to their places. */
typedef struct ends {
    vector bytes;
} ends;

enum { FIRST_BIT = 1 };
#define LAST_BIT (UINT64_C(1) << (SNOW_TILE_SIDE - 1))

/* In each word byte j becomes what byte j + i was. */
static inline vector go_round(vector words, int i)
{
    const uint64_t bytes = UINT64_C(0x0706050403020100);
    uint64_t from = i == 0 ? bytes : bytes >> 8 * i | bytes << (64 - 8 * i);
    const vector order = {from, from + UINT64_C(0x0808080808080808), from, from + UINT64_C(0x0808080808080808)};
    return (vector)_mm256_shuffle_epi8((__m256i)words, (__m256i)order);
}

/* Bytes of ones where a column has its bit, strip by strip: in byte j for row j, or for row j + 1. */
static inline vector bytes_of(uint64_t column, int part, uint64_t bit_of_byte)
{
    const vector strip = {0, UINT64_C(0x0101010101010101), UINT64_C(0x0202020202020202),
                          UINT64_C(0x0303030303030303)};
    __m256i bits = _mm256_shuffle_epi8((__m256i)spread(column >> PART_BITS * part), (__m256i)strip);
    __m256i wanted = (__m256i)spread(bit_of_byte);
    return (vector)_mm256_cmpeq_epi8(_mm256_and_si256(bits, wanted), wanted);
}

static inline ends ends_of(uint64_t left, uint64_t right, int part)
{
    const uint64_t row_j = UINT64_C(0x8040201008040201), row_after_j = UINT64_C(0x0180402010080402);
    return (ends){(bytes_of(left, part, row_j) & UINT64_C(0x0101010101010101)) |
                  (bytes_of(right, part, row_after_j) & UINT64_C(0x8080808080808080))};
}

static inline vector first_bit(const ends *part, int i)
{
    return go_round(part->bytes, i) & FIRST_BIT;
}

static inline vector last_bit(const ends *part, int i)
{
    return go_round(part->bytes, i) & LAST_BIT;
}

static inline void add_ends(ends *part, vector row, int i)
{
    part->bytes |= go_round(row & (LAST_BIT | FIRST_BIT), (8 - i) % 8);
}

static inline uint64_t column_of(vector signs, int part)
{
    return (uint64_t)(uint32_t)_mm256_movemask_epi8((__m256i)signs) << PART_BITS * part;
}

static inline uint64_t left_column(const ends *rows, int part)
{
    return column_of(rows->bytes << 7, part);
}

static inline uint64_t right_column(const ends *rows, int part)
{
    return column_of(go_round(rows->bytes, 7), part);
}

#else

/* Strip by strip the eight bits of a column, in the lowest bits of the words. */
typedef struct ends {
    vector left, right;
} ends;

static inline vector strips_of(uint64_t column, int part)
{
    column >>= PART_BITS * part;
#if LANES == 8
    return spread(column) >> (vector){0, 8, 16, 24, 32, 40, 48, 56};
#else
    return (vector){column, column >> 8};
#endif
}

/* And back: the words hold nothing but these bits. */
static inline uint64_t column_of(vector strips, int part)
{
#if LANES == 8
    uint64_t column = (uint64_t)_mm_cvtsi128_si64(_mm512_cvtepi64_epi8((__m512i)strips));
#else
    uint64_t column = strips[0] | strips[1] << 8;
#endif
    return column << PART_BITS * part;
}

static inline ends ends_of(uint64_t left, uint64_t right, int part)
{
    return (ends){strips_of(left, part), strips_of(right, part)};
}

static inline vector first_bit(const ends *part, int i)
{
    return part->left >> i & 1;
}

static inline vector last_bit(const ends *part, int i)
{
    return part->right >> i << (SNOW_TILE_SIDE - 1);
}

static inline void add_ends(ends *part, vector row, int i)
{
    part->left |= (row & 1) << i;
    part->right |= row >> (SNOW_TILE_SIDE - 1) << i;
}

static inline uint64_t left_column(const ends *rows, int part)
{
    return column_of(rows->left, part);
}

static inline uint64_t right_column(const ends *rows, int part)
{
    return column_of(rows->right, part);
}

#endif

static inline bool any(vector bits)
{
#if LANES == 8
    return _mm512_test_epi64_mask((__m512i)bits, (__m512i)bits) != 0;
#elif LANES == 4
    return !_mm256_testz_si256((__m256i)bits, (__m256i)bits);
#else
    return (bits[0] | bits[1]) != 0;
#endif
}

#if LANES == 8
#define TERNARY(a, b, c, table) ((vector)_mm512_ternarylogic_epi64((__m512i)(a), (__m512i)(b), (__m512i)(c), table))
#endif

static inline vector odd_of(vector a, vector b, vector c)
{
#if LANES == 8
    return TERNARY(a, b, c, 0x96);
#else
    return a ^ b ^ c;
#endif
}

static inline vector most_of(vector a, vector b, vector c)
{
#if LANES == 8
    return TERNARY(a, b, c, 0xE8);
#else
    return (a & b) | ((a ^ b) & c);
#endif
}

static inline vector choose(vector which, vector yes, vector no)
{
#if LANES == 8
    return TERNARY(which, yes, no, 0xCA);
#else
    return no ^ (which & (yes ^ no));
#endif
}

/* The number of frozen neighbours of each cell, in binary. */
typedef struct neighbours {
    vector ones, twos, fours;
    vector pairs; /* where it is odd: whether it is more than one */
} neighbours;

static inline neighbours add_up(const vector n[6])
{
    vector ones_a = odd_of(n[0], n[1], n[2]);
    vector twos_a = most_of(n[0], n[1], n[2]);
    vector ones_b = odd_of(n[3], n[4], n[5]);
    vector twos_b = most_of(n[3], n[4], n[5]);
    vector twos_c = ones_a & ones_b;
    return (neighbours){
        .ones = ones_a ^ ones_b,
        .twos = odd_of(twos_a, twos_b, twos_c),
        .fours = most_of(twos_a, twos_b, twos_c),
        .pairs = twos_a | twos_b,
    };
}

/* All ones where the rule freezes a cell with so many frozen neighbours. */
static inline vector digit(unsigned freezes, int number)
{
    return spread(0 - (uint64_t)(freezes >> number & 1));
}

/* Any rule. */
static inline vector apply_any(unsigned freezes, const neighbours *sum)
{
    vector few = choose(sum->twos, choose(sum->ones, digit(freezes, 3), digit(freezes, 2)),
                        choose(sum->ones, digit(freezes, 1), digit(freezes, 0)));
    vector many = choose(sum->twos, digit(freezes, 6), choose(sum->ones, digit(freezes, 5), digit(freezes, 4)));
    return choose(sum->fours, many, few);
}

/* What a table of bits says for a number of one, two or three binary digits.
   With a table that the compiler knows, only what is needed is left of it. */
static inline __attribute__((always_inline)) vector look_up_1(unsigned table, vector ones)
{
    return table == 0 ? spread(0) : table == 1 ? ~ones : table == 2 ? ones : ~spread(0);
}

static inline __attribute__((always_inline)) vector look_up_2(unsigned table, vector twos, vector ones)
{
    unsigned low = table & 3;
    unsigned high = table >> 2;
    vector if_low = look_up_1(low, ones);
    vector if_high = look_up_1(high, ones);
    return low == high ? if_low
           : high == 0 ? if_low & ~twos
           : low == 0  ? if_high & twos
                       : choose(twos, if_high, if_low);
}

static inline __attribute__((always_inline)) vector look_up_3(unsigned table, const neighbours *sum)
{
    unsigned low = table & 15;
    unsigned high = table >> 4;
    vector if_low = look_up_2(low, sum->twos, sum->ones);
    vector if_high = look_up_2(high, sum->twos, sum->ones);
    return low == high ? if_low
           : high == 0 ? if_low & ~sum->fours
           : low == 0  ? if_high & sum->fours
                       : choose(sum->fours, if_high, if_low);
}

/* No cell has seven neighbours: that digit may be what makes the table simple. */
static inline __attribute__((always_inline)) unsigned completed(unsigned freezes)
{
    bool repeats = ((freezes >> 4 ^ freezes) & 7) == 0;
    return freezes | (repeats ? freezes << 4 & 0x80 : freezes << 1 & 0x80);
}

static inline __attribute__((always_inline)) vector apply(unsigned freezes, const neighbours *sum)
{
    if (!__builtin_constant_p(freezes))
        return apply_any(freezes, sum);
    return freezes == 0x02 ? sum->ones & ~sum->pairs : look_up_3(completed(freezes), sum);
}

/* Rows of a tile with the cells to their left and right, and what the first
   and the last vector of each part have above and below. */
typedef struct view {
    const uint64_t *cells;
    ends beside[PARTS];
    vector above[PARTS], above_right[PARTS];
    vector below[PARTS], below_left[PARTS];
} view;

static inline vector row_at(const view *tile, int part, int i)
{
    return load(tile->cells + i * TILE_STRIPS + part * LANES);
}

static inline vector left_of(const view *tile, int part, int i)
{
    return row_at(tile, part, i) << 1 | first_bit(&tile->beside[part], i);
}

static inline vector right_of(const view *tile, int part, int i)
{
    return row_at(tile, part, i) >> 1 | last_bit(&tile->beside[part], i);
}

static inline __attribute__((always_inline)) void view_start(view *tile, const uint64_t *cells, const tile_halo *halo)
{
    tile->cells = cells;
    UNROLL
    for (int part = 0; part < PARTS; part++)
        tile->beside[part] = ends_of(halo->left, halo->right, part);
    enum { LAST = TILE_STRIP_ROWS - 1 };
    vector row = spread(halo->top);
    vector right = spread(halo->top >> 1 | halo->northeast << (SNOW_TILE_SIDE - 1));
    UNROLL
    for (int part = 0; part < PARTS; part++) {
        vector next_row = row_at(tile, part, LAST);
        vector next_right = right_of(tile, part, LAST);
        tile->above[part] = moved_up(row, next_row);
        tile->above_right[part] = moved_up(right, next_right);
        row = next_row;
        right = next_right;
    }
    row = spread(halo->bottom);
    vector left = spread(halo->bottom << 1 | halo->southwest);
    UNROLL
    for (int part = PARTS - 1; part >= 0; part--) {
        vector next_row = row_at(tile, part, 0);
        vector next_left = left_of(tile, part, 0);
        tile->below[part] = moved_down(next_row, row);
        tile->below_left[part] = moved_down(next_left, left);
        row = next_row;
        left = next_left;
    }
}

/* Goes down the rows of a part: what one row shares with the next. */
typedef struct window {
    vector above, above_right;
    vector row, left, right;
} window;

static inline window window_start(const view *tile, int part)
{
    return (window){tile->above[part], tile->above_right[part], row_at(tile, part, 0), left_of(tile, part, 0),
                    right_of(tile, part, 0)};
}

static inline __attribute__((always_inline)) neighbours window_next(window *at, const view *tile, int part, int i)
{
    bool last = i == TILE_STRIP_ROWS - 1;
    window next = {.above = at->row, .above_right = at->right};
    next.row = last ? tile->below[part] : row_at(tile, part, i + 1);
    next.left = last ? tile->below_left[part] : left_of(tile, part, i + 1);
    next.right = last ? next.row : right_of(tile, part, i + 1);
    neighbours sum = add_up((vector[6]){at->left, at->right, at->above, at->above_right, next.row, next.left});
    *at = next;
    return sum;
}

static inline __attribute__((always_inline)) bool advance_tile(snow_tile *tile, unsigned phase, unsigned freezes)
{
    tile_halo halo = tile_surroundings(tile, phase);
    view before;
    view_start(&before, tile->cells, &halo);
    vector fresh = {0};
    tile_edges edges = {0};
    for (int part = 0; part < PARTS; part++) {
        window at = window_start(&before, part);
        ends after = ends_of(0, 0, part);
        UNROLL
        for (int i = 0; i < TILE_STRIP_ROWS; i++) {
            vector row = at.row;
            neighbours sum = window_next(&at, &before, part, i);
            vector freezing = apply(freezes, &sum) & ~row;
            fresh |= freezing;
            row |= freezing;
            store(tile->cells + i * TILE_STRIPS + part * LANES, row);
            add_ends(&after, row, i);
        }
        edges.left |= left_column(&after, part);
        edges.right |= right_column(&after, part);
    }
    edges.top = tile->cells[tile_word(0)];
    edges.bottom = tile->cells[tile_word(SNOW_TILE_SIDE - 1)];
    tile->edge[1 - phase] = edges;
    return any(fresh);
}

/* How many bits are set: of pairs, fours, bytes, and so on. */
static unsigned population(const uint64_t *cells)
{
    vector sums = {0};
    for (int i = 0; i < SNOW_TILE_SIDE; i += LANES) {
        vector bits = load(cells + i);
        bits -= bits >> 1 & 0x5555555555555555;
        bits = (bits & 0x3333333333333333) + (bits >> 2 & 0x3333333333333333);
        bits = (bits + (bits >> 4)) & 0x0F0F0F0F0F0F0F0F;
        sums += (bits + (bits >> 8)) & 0x00FF00FF00FF00FF;
    }
    uint64_t sum = 0;
    for (int lane = 0; lane < LANES; lane++)
        sum += sums[lane];
    sum = (sum & 0x0000FFFF0000FFFF) + (sum >> 16 & 0x0000FFFF0000FFFF);
    return (unsigned)(sum + (sum >> 32)) & 0xFFFF;
}

/* Tiles of a list lie anywhere; the processor cannot guess where. */
static inline void fetch_ahead(snow_tile *const *list, size_t count, size_t i)
{
    enum { LINE = 64, TILES = 2 };
    if (i + 2 * TILES < count)
        __builtin_prefetch(list[i + 2 * TILES]->beside);
    if (i + TILES >= count)
        return;
    const snow_tile *tile = list[i + TILES];
    UNROLL
    for (size_t word = 0; word < SNOW_TILE_SIDE; word += LINE / sizeof(uint64_t))
        __builtin_prefetch(tile->cells + word, 1);
    UNROLL
    for (int direction = 0; direction < TILE_DIRECTIONS; direction++)
        __builtin_prefetch(tile->beside[direction]->edge);
}

static inline __attribute__((always_inline)) size_t advance_list(const tile_pass *pass, snow_tile **list, size_t count,
                                                                 unsigned freezes)
{
    size_t changed = 0;
    for (size_t i = 0; i < count; i++) {
        snow_tile *tile = list[i];
        fetch_ahead(list, count, i);
        bool changes =
            tile->extra != NULL ? snow_tile_advance_slowly(pass, tile) : advance_tile(tile, pass->phase, freezes);
        tile->state = (uint8_t)((tile->state & ~TILE_CHANGED) | (changes ? TILE_CHANGED : 0));
        atomic_store_explicit(&tile->active, 0, memory_order_relaxed);
        list[changed] = tile;
        changed += changes;
    }
    return changed;
}

/* Rules that are asked for most get code of their own. */
#define POPULAR_RULES(RULE)                                                                                            \
    RULE(0x02) /* 0100000 */                                                                                           \
    RULE(0x06) /* 0110000 */                                                                                           \
    RULE(0x0A) /* 0101000 */                                                                                           \
    RULE(0x16) /* 0110100 */                                                                                           \
    RULE(0x1A) /* 0101100 */                                                                                           \
    RULE(0x22) /* 0100010 */                                                                                           \
    RULE(0x2A) /* 0101010 */

static size_t advance(const tile_pass *pass, snow_tile **list, size_t count)
{
    switch (pass->freezes) {
#define RULE(freezes) \
    case freezes: return advance_list(pass, list, count, freezes);
        POPULAR_RULES(RULE)
#undef RULE
    default: return advance_list(pass, list, count, pass->freezes);
    }
}

static void look(const uint64_t *cells, const tile_halo *halo, uint8_t freezes, uint64_t *fresh, uint64_t *touched)
{
    view tile;
    view_start(&tile, cells, halo);
    for (int part = 0; part < PARTS; part++) {
        window at = window_start(&tile, part);
        UNROLL
        for (int i = 0; i < TILE_STRIP_ROWS; i++) {
            vector row = at.row;
            neighbours sum = window_next(&at, &tile, part, i);
            store(fresh + i * TILE_STRIPS + part * LANES, apply(freezes, &sum) & ~row);
            store(touched + i * TILE_STRIPS + part * LANES, sum.ones | sum.twos | sum.fours);
        }
    }
}

const tile_kernel TABLE(SNOW_KERNEL) = {
    .advance = advance,
    .look = look,
    .population = population,
};
