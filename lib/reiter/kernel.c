/* Compiled once for each precision and instruction set, with SNOW_KERNEL naming
   the table. Vectors are those of gcc and clang, as wide as the instruction set
   has them, but not wider than a chunk. */
#include "reiter/kernel.h"

#include <string.h>

#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

#ifdef SNOW_SINGLE
#include "reiter/kernel_single.h"
#else
#include "reiter/kernel_double.h"
#endif

#define LANES (VECTOR_BYTES / (int)sizeof(element))

static inline vector load(const element *from)
{
    return (vector) * (const loose_vector *)from;
}

static inline vector load_aligned(const element *from)
{
    return (vector) * (const tight_vector *)from;
}

static inline void store_aligned(element *to, vector value)
{
    *(tight_vector *)to = value;
}

/* Keeps a loaded vector in its register; compilers would rather load it again. */
#if defined(__x86_64__) || defined(__i386__)
#define KEEP(x) __asm__("" : "+x"(x))
#else
#define KEEP(x) ((void)0)
#endif

/* A row's cells at one place: themselves, and shifted by one. */
typedef struct row_cells {
    vector left;
    vector here;
    vector right;
} row_cells;

static inline row_cells load_row(const element *at)
{
    row_cells cells = {load(at - 1), load_aligned(at), load(at + 1)};
    KEEP(cells.left);
    KEEP(cells.here);
    KEEP(cells.right);
    return cells;
}

/* What flows into a cell, a multiple of the quantum, from the four cells above it
   and the four below it: each of the two groups holds two neighbours on the
   outside, then the cell itself and one beside it. So six neighbours and twice
   the cell. The sums are exact (doc/reiter.md), so their order is free. */
static inline vector inflow(vector above_group, vector below_group, vector here, const constants *with)
{
    return flow_of(less_eight(above_group + below_group, here, with), with);
}

/* All ones in the lanes of a chunk that a mask names, from lane `first` on. */
static inline lanes lanes_of(uint8_t mask, int first)
{
    static const _Alignas(64) lane bit[REITER_CHUNK] = {1, 2, 4, 8, 16, 32, 64, 128};
    lanes bits = (lanes) * (const tight_lanes *)(bit + first);
    return (bits & mask) != (lanes){0};
}

static inline bool any(lanes flags)
{
#if VECTOR_BYTES == 64
    return _mm512_test_epi64_mask((__m512i)flags, (__m512i)flags) != 0;
#elif VECTOR_BYTES == 32
    return !_mm256_testz_si256((__m256i)flags, (__m256i)flags);
#else
    _Alignas(VECTOR_BYTES) lane each[LANES];
    *(tight_lanes *)each = flags;
    lane all = 0;
    for (int i = 0; i < LANES; i++)
        all |= each[i];
    return all != 0;
#endif
}

/* Where the band of a segment stands, in the field that is read and in the one that is written. */
typedef struct band_place {
    const element *row;
    const element *above, *below; /* the rows next to it */
    element *next;
    size_t stride; /* from row to row */
} band_place;

static inline band_place place_of(const reiter_flow *flow, const reiter_segment *segment)
{
    const element *vapour = flow->vapour;
    element *next = flow->next;
    return (band_place){vapour + segment->row, vapour + segment->above, vapour + segment->below, next + segment->row,
                        segment->stride};
}

/* The four rows of a band at one place, each with the flow that it gets. */
typedef struct band_flow {
    vector here[REITER_BAND];
    vector flow[REITER_BAND];
} band_flow;

/* A row's group below is the group above of the next. */
static inline band_flow flow_at(const band_place *band, size_t i, const constants *with)
{
    const element *row = band->row + i;
    const element *above = band->above + i;
    const element *below = band->below + i;
    size_t stride = band->stride;
    row_cells r0 = load_row(row);
    vector g0 = (load_aligned(above) + load(above + 1)) + (r0.left + r0.here);
    row_cells r1 = load_row(row + stride);
    vector g1 = (r0.here + r0.right) + (r1.left + r1.here);
    vector f0 = inflow(g0, g1, r0.here, with);
    row_cells r2 = load_row(row + 2 * stride);
    vector g2 = (r1.here + r1.right) + (r2.left + r2.here);
    vector f1 = inflow(g1, g2, r1.here, with);
    row_cells r3 = load_row(row + 3 * stride);
    vector g3 = (r2.here + r2.right) + (r3.left + r3.here);
    vector f2 = inflow(g2, g3, r2.here, with);
    vector g4 = (r3.here + r3.right) + (load(below - 1) + load_aligned(below));
    vector f3 = inflow(g3, g4, r3.here, with);
    return (band_flow){{r0.here, r1.here, r2.here, r3.here}, {f0, f1, f2, f3}};
}

static inline bool is_full(const reiter_segment *segment)
{
    uint32_t masks;
    memcpy(&masks, segment->mask, sizeof masks);
    return masks == UINT32_MAX;
}

static void full_segment(const reiter_flow *flow, const reiter_segment *segment)
{
    const band_place band = place_of(flow, segment);
    constants with = constants_of(flow);
    for (size_t i = 0; i < (size_t)segment->chunks * REITER_CHUNK; i += LANES) {
        band_flow at = flow_at(&band, i, &with);
        for (size_t own = 0; own < REITER_BAND; own++)
            store_aligned(band.next + own * band.stride + i, at.here[own] + at.flow[own]);
    }
}

/* The chunk of a segment of which the masks name the cells; says whether anything flows. */
static inline bool masked_chunk(const reiter_flow *flow, const reiter_segment *segment)
{
    const band_place band = place_of(flow, segment);
    constants with = constants_of(flow);
    lanes flowing = {0};
    for (int i = 0; i < REITER_CHUNK; i += LANES) {
        band_flow at = flow_at(&band, (size_t)i, &with);
        for (int own = 0; own < REITER_BAND; own++) {
            vector flowed = (vector)((lanes)at.flow[own] & lanes_of(segment->mask[own], i));
            flowing |= is_beyond(flowed, with.tolerance);
            store_aligned(band.next + (size_t)own * band.stride + i, at.here[own] + flowed);
        }
    }
    return any(flowing);
}

/* A chunk of which all cells are computed; says whether anything flows. */
static inline bool full_chunk(const band_place *band, size_t shift, const constants *with, bool tolerates)
{
    lanes flowing = {0};
    for (size_t i = shift; i < shift + REITER_CHUNK; i += LANES) {
        band_flow at = flow_at(band, i, with);
        for (size_t own = 0; own < REITER_BAND; own++) {
            /* A flow of nothing has no bit set. */
            flowing |= tolerates ? is_beyond(at.flow[own], with->tolerance) : (lanes)at.flow[own];
            store_aligned(band->next + own * band->stride + i, at.here[own] + at.flow[own]);
        }
    }
    return any(flowing);
}

static inline void look_at_full(const reiter_flow *flow, const reiter_segment *segment, uint64_t *flowing,
                                bool tolerates)
{
    const band_place band = place_of(flow, segment);
    const constants with = constants_of(flow);
    const size_t first = segment->bit;
    const size_t end = first + segment->chunks;
    for (size_t bit = first; bit < end; bit++) {
        bool flows = full_chunk(&band, (bit - first) * REITER_CHUNK, &with, tolerates);
        flowing[bit / 64] |= (uint64_t)flows << bit % 64;
    }
}

static inline const reiter_segment *segment_at(const reiter_flow *flow, const reiter_segment *segments, size_t count,
                                               size_t turn)
{
    return &segments[flow->backward ? count - 1 - turn : turn];
}

static void diffuse(const reiter_flow *flow, const reiter_segment *segments, size_t count)
{
    for (size_t turn = 0; turn < count; turn++) {
        const reiter_segment *segment = segment_at(flow, segments, count, turn);
        if (is_full(segment))
            full_segment(flow, segment);
        else
            masked_chunk(flow, segment);
    }
}

static void diffuse_and_look(const reiter_flow *flow, const reiter_segment *segments, size_t count, uint64_t *flowing)
{
    for (size_t turn = 0; turn < count; turn++) {
        const reiter_segment *segment = segment_at(flow, segments, count, turn);
        if (!is_full(segment))
            flowing[segment->bit / 64] |= (uint64_t)masked_chunk(flow, segment) << segment->bit % 64;
        else if (flow->tolerance > 0)
            look_at_full(flow, segment, flowing, true);
        else
            look_at_full(flow, segment, flowing, false);
    }
}

static bool exceeds(const void *field, const reiter_segment *segments, size_t count, double limit)
{
    const element *cells = field;
    lanes beyond = {0};
    vector greatest = spread(element_of(limit));
    for (const reiter_segment *segment = segments; segment < segments + count; segment++) {
        for (size_t own = 0; own < REITER_BAND; own++) {
            const element *row = cells + segment->row + own * segment->stride;
            for (size_t i = 0; i < (size_t)segment->chunks * REITER_CHUNK; i += LANES)
                beyond |= is_beyond(load_aligned(row + i), greatest);
        }
    }
    return any(beyond);
}

const reiter_kernel SNOW_KERNEL = {
    .diffuse = diffuse,
    .diffuse_and_look = diffuse_and_look,
    .exceeds = exceeds,
};
