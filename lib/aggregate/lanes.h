/* What the lanes kernels are written in: eight numbers of 32 bits, eight of 64, what
   is looked up for all eight at once, and their walkers' random numbers.

   Included where the compiler may use AVX2, or AVX-512. */
#ifndef SNOW_AGGREGATE_LANES_H
#define SNOW_AGGREGATE_LANES_H

#include "aggregate/squad.h"

#include <immintrin.h>

#include <stddef.h>

#define SNOW_PASTE(a, b) a##b
#define SNOW_NAME(a, b) SNOW_PASTE(a, b)

/* Copies for one lattice and number of squads hold no loops and no calls. */
#define INLINE static inline __attribute__((always_inline))

typedef __m256i lanes;

INLINE lanes all(uint32_t x)
{
    return _mm256_set1_epi32((int)x);
}

INLINE lanes load(const void *from)
{
    return _mm256_load_si256(from);
}

INLINE void store(void *to, lanes a)
{
    _mm256_store_si256(to, a);
}

INLINE lanes choose(lanes mask, lanes yes, lanes no)
{
    return _mm256_blendv_epi8(no, yes, mask);
}

/* a where the sign is clear, -a where it is set. */
INLINE lanes signed_by(lanes a, lanes sign)
{
    return _mm256_sign_epi32(a, _mm256_or_si256(sign, all(1)));
}

/* Addresses and random numbers have 64 bits: a wide is one for each lane. */
#if defined(__AVX512F__)
typedef __m512i wide;

INLINE wide every(uint64_t x)
{
    return _mm512_set1_epi64((long long)x);
}

INLINE wide widened(lanes a)
{
    return _mm512_cvtepu32_epi64(a);
}

INLINE wide widened_mask(lanes a)
{
    return _mm512_cvtepi32_epi64(a);
}

INLINE lanes lower_halves(wide a)
{
    return _mm512_cvtepi64_epi32(a);
}

INLINE wide plus(wide a, wide b)
{
    return _mm512_add_epi64(a, b);
}

/* Of lower halves. */
INLINE wide product(wide a, wide b)
{
    return _mm512_mul_epu32(a, b);
}

INLINE wide shifted_down(wide a, wide bits)
{
    return _mm512_srlv_epi64(a, bits);
}

INLINE wide upper_to_lower(wide a)
{
    return _mm512_srli_epi64(a, 32);
}

/* Of their lower halves. */
INLINE wide joined(wide upper, wide lower)
{
    return _mm512_mask_blend_epi32(0xAAAA, lower, _mm512_slli_epi64(upper, 32));
}

INLINE wide xor(wide a, wide b, wide c)
{
    return _mm512_ternarylogic_epi64(a, b, c, 0x96);
}

/* Eight bytes from each address. */
INLINE wide fetch(wide address)
{
    return _mm512_i64gather_epi64(address, NULL, 1);
}

/* The same where a lane's mask is set; 0 elsewhere. */
INLINE wide fetch_some(wide address, lanes mask)
{
    return _mm512_mask_i64gather_epi64(_mm512_setzero_si512(), _mm256_movepi32_mask(mask), address, NULL, 1);
}

/* The elements of an array of 64 bits each. */
INLINE wide fetch_from(const void *array, wide index)
{
    return _mm512_i64gather_epi64(index, array, 8);
}
#else
/* Two vectors: lanes with even and with odd numbers. */
typedef struct wide {
    lanes even, odd;
} wide;

INLINE wide every(uint64_t x)
{
    return (wide){_mm256_set1_epi64x((long long)x), _mm256_set1_epi64x((long long)x)};
}

INLINE wide widened(lanes a)
{
    return (wide){_mm256_blend_epi32(a, _mm256_setzero_si256(), 0xAA), _mm256_srli_epi64(a, 32)};
}

INLINE wide widened_mask(lanes a)
{
    return (wide){_mm256_shuffle_epi32(a, 0xA0), _mm256_shuffle_epi32(a, 0xF5)};
}

INLINE lanes lower_halves(wide a)
{
    return _mm256_blend_epi32(a.even, _mm256_slli_epi64(a.odd, 32), 0xAA);
}

INLINE wide plus(wide a, wide b)
{
    return (wide){_mm256_add_epi64(a.even, b.even), _mm256_add_epi64(a.odd, b.odd)};
}

/* Of lower halves. */
INLINE wide product(wide a, wide b)
{
    return (wide){_mm256_mul_epu32(a.even, b.even), _mm256_mul_epu32(a.odd, b.odd)};
}

INLINE wide shifted_down(wide a, wide bits)
{
    return (wide){_mm256_srlv_epi64(a.even, bits.even), _mm256_srlv_epi64(a.odd, bits.odd)};
}

INLINE wide upper_to_lower(wide a)
{
    return (wide){_mm256_srli_epi64(a.even, 32), _mm256_srli_epi64(a.odd, 32)};
}

/* Of their lower halves. */
INLINE wide joined(wide upper, wide lower)
{
    return (wide){_mm256_blend_epi32(lower.even, _mm256_slli_epi64(upper.even, 32), 0xAA),
                  _mm256_blend_epi32(lower.odd, _mm256_slli_epi64(upper.odd, 32), 0xAA)};
}

INLINE wide xor(wide a, wide b, wide c)
{
    return (wide){_mm256_xor_si256(_mm256_xor_si256(a.even, b.even), c.even),
                  _mm256_xor_si256(_mm256_xor_si256(a.odd, b.odd), c.odd)};
}

/* Eight bytes from each address. */
INLINE wide fetch(wide address)
{
    return (wide){_mm256_i64gather_epi64(NULL, address.even, 1), _mm256_i64gather_epi64(NULL, address.odd, 1)};
}

/* The same where a lane's mask is set; 0 elsewhere. */
INLINE wide fetch_some(wide address, lanes mask)
{
    const lanes none = _mm256_setzero_si256();
    return (wide){_mm256_mask_i64gather_epi64(none, NULL, address.even, _mm256_slli_epi64(mask, 32), 1),
                  _mm256_mask_i64gather_epi64(none, NULL, address.odd, mask, 1)};
}

/* The elements of an array of 64 bits each. */
INLINE wide fetch_from(const void *array, wide index)
{
    return (wide){_mm256_i64gather_epi64(array, index.even, 8), _mm256_i64gather_epi64(array, index.odd, 8)};
}
#endif

/* The elements of an array of 32 bits each. */
INLINE lanes look_up(const void *array, lanes index)
{
    return _mm256_i32gather_epi32(array, index, 4);
}

/* The same where a lane's mask is set; 0 elsewhere. */
INLINE lanes look_up_some(const void *array, lanes index, lanes mask)
{
    return _mm256_mask_i32gather_epi32(_mm256_setzero_si256(), array, index, mask, 4);
}

/* Philox, as in draws_kernel.c: the block that each comes to. */
INLINE void draw(const uint64_t *key, const snow_lanes *walkers, wide number[2])
{
    wide a = widened(_mm256_srli_epi32(load(walkers->drawn), 1));
    wide b = widened(load(walkers->low));
    wide c = widened(load(walkers->high));
    wide d = every(SNOW_RANDOM_JUMPS);
    for (int round = 0; round < SNOW_RANDOM_ROUNDS; round++) {
        wide product_0 = product(a, every(SNOW_RANDOM_MULTIPLIER_0));
        wide product_1 = product(c, every(SNOW_RANDOM_MULTIPLIER_1));
        a = xor(upper_to_lower(product_1), b, every(key[2 * round]));
        c = xor(upper_to_lower(product_0), d, every(key[2 * round + 1]));
        b = product_1;
        d = product_0;
    }
    number[0] = joined(b, a);
    number[1] = joined(d, c);
}

static inline void make_keys(uint64_t key[2 * SNOW_RANDOM_ROUNDS], uint64_t first)
{
    for (uint32_t round = 0; round < SNOW_RANDOM_ROUNDS; round++) {
        key[2 * round] = (uint32_t)first + round * SNOW_RANDOM_WEYL_0;
        key[2 * round + 1] = (uint32_t)(first >> 32) + round * SNOW_RANDOM_WEYL_1;
    }
}

/* snow_exits_class_near(), where a lane's mask is set; 0 elsewhere. */
INLINE lanes class_near(const snow_exits *exits, lanes clear, lanes where)
{
    /* The exponent and three more bits. */
    lanes bits = _mm256_srli_epi32(_mm256_castps_si256(_mm256_cvtepi32_ps(clear)), 20);
    lanes part = _mm256_min_epu32(_mm256_sub_epi32(bits, all(127 << 3)), all(SNOW_EXIT_OCTAVES * SNOW_EXIT_PARTS - 1));
    lanes four = _mm256_mask_i32gather_epi32(_mm256_setzero_si256(), (const void *)exits->class_from, part, where, 1);
    return _mm256_and_si256(four, all(255));
}

/* Of the column that a pick has found: snow_exit_table_pick(). */
INLINE lanes outcome_of(wide pick, wide exit)
{
    lanes place = lower_halves(pick);
    lanes is_from = _mm256_cmpeq_epi32(_mm256_max_epu32(place, lower_halves(exit)), place);
    lanes outcome = _mm256_srlv_epi32(lower_halves(upper_to_lower(exit)), _mm256_and_si256(is_from, all(16)));
    return _mm256_and_si256(outcome, all(0xFFFF));
}

/* So many blocks can be used before a ring is full. */
static inline uint32_t blocks_left(const snow_squad *squads, int count)
{
    uint32_t least = UINT32_MAX;
    for (int i = 0; i < count; i++) {
        uint32_t rows = squads[i].stop - squads[i].next;
        least = rows < least ? rows : least;
    }
    return least / 2;
}

/* Eight rows of a column: which of them may have changed, as the stamps of tiles say. */
INLINE uint32_t find_changed(const uint32_t *stamp, const snow_squad *squad, int lane, lanes row, lanes counts,
                             uint32_t since)
{
    lanes tile = look_up(squad->tiles->tile + lane, _mm256_slli_epi32(row, 3));
    lanes can_change = _mm256_andnot_si256(tile, counts); /* the sign tells */
    lanes changed = _mm256_mask_i32gather_epi32(all(since), (const int *)stamp, tile, can_change, 4);
    lanes is_newer = _mm256_cmpgt_epi32(_mm256_sub_epi32(changed, all(since)), _mm256_setzero_si256());
    return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(is_newer));
}

#endif
