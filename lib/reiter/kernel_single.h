/* Vapour in 32-bit multiples of the quantum: what kernel.c needs to know of its
   numbers. Only a flow, the product of a sum and α/12, is a float for a moment.
   Sums of eight cells may wrap round, what is left when eight times a cell is
   taken away does not; so vectors are unsigned, and signed where that matters. */
#ifndef SNOW_REITER_KERNEL_SINGLE_H
#define SNOW_REITER_KERNEL_SINGLE_H

#if defined(__AVX2__)
#define VECTOR_BYTES 32
#else
#define VECTOR_BYTES 16
#endif

typedef int32_t element;
typedef int32_t lane;
typedef uint32_t vector __attribute__((vector_size(VECTOR_BYTES)));
typedef int32_t lanes __attribute__((vector_size(VECTOR_BYTES)));
typedef float float_vector __attribute__((vector_size(VECTOR_BYTES)));
typedef uint32_t loose_vector __attribute__((vector_size(VECTOR_BYTES), aligned(4), may_alias));
typedef uint32_t tight_vector __attribute__((vector_size(VECTOR_BYTES), may_alias));
typedef int32_t tight_lanes __attribute__((vector_size(VECTOR_BYTES), may_alias));

/* The greatest number of quanta that is not above a value >= 0. */
static inline element element_of(double value)
{
    return value < INT32_MAX ? (element)value : INT32_MAX;
}

static inline vector spread(element x)
{
    return (uint32_t)x - (vector){0};
}

/* Lane by lane: where floats are computed as doubles (FLT_EVAL_METHOD 1, s390x) a float less a vector is none. */
static inline float_vector spread_float(float x)
{
    float_vector all;
    for (size_t i = 0; i < sizeof all / sizeof x; i++)
        all[i] = x;
    return all;
}

/* What stays the same for all cells of a step. */
typedef struct constants {
    float_vector weight;
    vector tolerance;
} constants;

static inline constants constants_of(const reiter_flow *flow)
{
    return (constants){spread_float((float)flow->weight), spread(element_of(flow->tolerance))};
}

static inline vector less_eight(vector sum, vector here, const constants *with)
{
    (void)with;
    return sum - (here << 3);
}

/* To the nearest whole number, ties to even. */
static inline vector round_all(float_vector x)
{
#if defined(__AVX2__)
    return (vector)_mm256_cvtps_epi32((__m256)x);
#elif defined(__SSE2__)
    return (vector)_mm_cvtps_epi32((__m128)x);
#else
    typedef double wide_vector __attribute__((vector_size(2 * VECTOR_BYTES)));
    const wide_vector rounder = 0x1.8p52 - (wide_vector){0};
    wide_vector rounded = (__builtin_convertvector(x, wide_vector) + rounder) - rounder;
    return (vector)__builtin_convertvector(rounded, lanes);
#endif
}

static inline vector flow_of(vector sum, const constants *with)
{
    return round_all(with->weight * __builtin_convertvector((lanes)sum, float_vector));
}

static inline lanes is_beyond(vector value, vector limit)
{
    return ~(((lanes)value <= (lanes)limit) & ((lanes)value >= -(lanes)limit));
}

#endif
