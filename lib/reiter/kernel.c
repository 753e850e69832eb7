/* Compiled once for each instruction set, with SNOW_KERNEL naming it. Vectors
   are those of gcc and clang, as wide as the instruction set has them. */
#include "reiter/kernel.h"

#if defined(__AVX2__) || defined(__FMA__)
#include <immintrin.h>
#endif

#define JOIN(a, b) a##b
#define TABLE(isa) JOIN(snow_reiter_kernel_, isa)

#if defined(__AVX512F__)
#define VECTOR_BYTES 64
#elif defined(__AVX2__)
#define VECTOR_BYTES 32
#else
#define VECTOR_BYTES 16
#endif
#define LANES (VECTOR_BYTES / (int)sizeof(double))

typedef double vector __attribute__((vector_size(VECTOR_BYTES)));
typedef int64_t lanes __attribute__((vector_size(VECTOR_BYTES)));
typedef double loose_vector __attribute__((vector_size(VECTOR_BYTES), aligned(8), may_alias));
typedef double tight_vector __attribute__((vector_size(VECTOR_BYTES), may_alias));
typedef int64_t tight_lanes __attribute__((vector_size(VECTOR_BYTES), may_alias));

static inline vector load(const double *from)
{
    return (vector) * (const loose_vector *)from;
}

static inline vector load_aligned(const double *from)
{
    return (vector) * (const tight_vector *)from;
}

static inline void store_aligned(double *to, vector value)
{
    *(tight_vector *)to = value;
}

static inline vector spread(double x)
{
    return x - (vector){0};
}

/* x·y + z where x·y is exact: the same with and without a fused instruction. */
static inline vector combine(vector x, vector y, vector z)
{
#if defined(__AVX512F__)
    return _mm512_fmadd_pd(x, y, z);
#elif defined(__AVX2__) && defined(__FMA__)
    return _mm256_fmadd_pd(x, y, z);
#else
    return x * y + z;
#endif
}

/* x + z, where there are fused instructions on their units: those for plain
   additions are the ones that the kernel runs out of. */
static inline vector plus(vector x, vector z, vector one)
{
#if defined(__AVX2__) && defined(__FMA__) && !defined(__AVX512F__)
    return combine(x, one, z);
#else
    (void)one;
    return x + z;
#endif
}

/* What stays the same for all cells of a step. */
typedef struct constants {
    vector weight;
    vector rounder;
    vector minus_six;
    vector one;
} constants;

static inline constants constants_of(const reiter_flow *flow)
{
    return (constants){spread(flow->weight), spread(flow->rounder), spread(-6), spread(flow->one)};
}

/* What flows into the cells at row, rounded to the quantum. The sum is exact
   (doc/reiter.md), so its order is free. */
static inline vector inflow(const double *row, const double *above, const double *below, vector centre,
                            const constants *with)
{
    vector level = load(row - 1) + load(row + 1);
    vector up = load_aligned(above) + load(above + 1);
    vector down = load(below - 1) + load_aligned(below);
    vector sum = plus(level, combine(centre, with->minus_six, plus(up, down, with->one)), with->one);
    return (with->weight * sum + with->rounder) - with->rounder;
}

/* All ones in the lanes of a chunk that a mask names, from lane `first` on. */
static inline lanes lanes_of(uint8_t mask, int first)
{
    static const _Alignas(64) int64_t bit[REITER_CHUNK] = {1, 2, 4, 8, 16, 32, 64, 128};
    lanes bits = (lanes) * (const tight_lanes *)(bit + first);
    return (bits & mask) != (lanes){0};
}

static inline bool any(lanes flags)
{
#if defined(__AVX512F__)
    return _mm512_test_epi64_mask((__m512i)flags, (__m512i)flags) != 0;
#elif defined(__AVX2__)
    return !_mm256_testz_si256((__m256i)flags, (__m256i)flags);
#else
    _Alignas(VECTOR_BYTES) int64_t lane[LANES];
    *(tight_lanes *)lane = flags;
    int64_t all = 0;
    for (int i = 0; i < LANES; i++)
        all |= lane[i];
    return all != 0;
#endif
}

/* One chunk, of which the mask names the cells; says whether anything flows. */
static inline bool border_chunk(const reiter_flow *flow, size_t row, size_t above, size_t below, uint8_t mask)
{
    const double *vapour = flow->vapour;
    constants with = constants_of(flow);
    lanes flowing = {0};
    for (int i = 0; i < REITER_CHUNK; i += LANES) {
        vector centre = load_aligned(vapour + row + i);
        vector flowed = inflow(vapour + row + i, vapour + above + i, vapour + below + i, centre, &with);
        flowed = (vector)((lanes)flowed & lanes_of(mask, i));
        flowing |= flowed != (vector){0};
        store_aligned(flow->next + row + i, centre + flowed);
    }
    return any(flowing);
}

/* Whole chunks from the one at `row` on. */
static inline void inner_chunks(const reiter_flow *flow, size_t row, size_t above, size_t below, size_t chunks)
{
    const double *row_cells = flow->vapour + row;
    const double *up = flow->vapour + above;
    const double *down = flow->vapour + below;
    double *next = flow->next + row;
    constants with = constants_of(flow);
    for (size_t i = 0; i < chunks * REITER_CHUNK; i += LANES) {
        vector vapour = load_aligned(row_cells + i);
        vector flowed = inflow(row_cells + i, up + i, down + i, vapour, &with);
        store_aligned(next + i, plus(flowed, vapour, with.one));
    }
}

static void diffuse(const reiter_flow *flow, const reiter_segment *segments, size_t count)
{
    for (const reiter_segment *segment = segments; segment < segments + count; segment++) {
        size_t row = segment->row;
        size_t above = segment->above;
        size_t below = segment->below;
        size_t first = segment->first_mask != 0xFF;
        size_t end = segment->chunks;
        if (first)
            border_chunk(flow, row, above, below, segment->first_mask);
        if (end > first && segment->last_mask != 0xFF) {
            end--;
            size_t shift = end * REITER_CHUNK;
            border_chunk(flow, row + shift, above + shift, below + shift, segment->last_mask);
        }
        size_t shift = first * REITER_CHUNK;
        inner_chunks(flow, row + shift, above + shift, below + shift, end - first);
    }
}

static void diffuse_and_look(const reiter_flow *flow, const reiter_segment *segments, size_t count, uint64_t *flowing)
{
    for (const reiter_segment *segment = segments; segment < segments + count; segment++) {
        for (size_t chunk = 0; chunk < segment->chunks; chunk++) {
            uint8_t mask = chunk == 0 ? segment->first_mask : 0xFF;
            mask &= chunk == segment->chunks - 1 ? segment->last_mask : 0xFF;
            size_t shift = chunk * REITER_CHUNK;
            size_t bit = segment->bit + chunk;
            if (border_chunk(flow, segment->row + shift, segment->above + shift, segment->below + shift, mask))
                flowing[bit / 64] |= UINT64_C(1) << bit % 64;
        }
    }
}

static bool exceeds(const double *cells, const reiter_segment *segments, size_t count, double limit)
{
    lanes beyond = {0};
    vector greatest = spread(limit);
    for (const reiter_segment *segment = segments; segment < segments + count; segment++) {
        const double *row = cells + segment->row;
        for (size_t i = 0; i < (size_t)segment->chunks * REITER_CHUNK; i += LANES) {
            vector value = load_aligned(row + i);
            beyond |= ~((value <= greatest) & (value >= -greatest));
        }
    }
    return any(beyond);
}

const reiter_kernel TABLE(SNOW_KERNEL) = {
    .diffuse = diffuse,
    .diffuse_and_look = diffuse_and_look,
    .exceeds = exceeds,
};
