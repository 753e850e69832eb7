/* Vapour in doubles: what kernel.c needs to know of its numbers. */
#ifndef SNOW_REITER_KERNEL_DOUBLE_H
#define SNOW_REITER_KERNEL_DOUBLE_H

#if defined(__AVX512F__)
#define VECTOR_BYTES 64
#elif defined(__AVX2__)
#define VECTOR_BYTES 32
#else
#define VECTOR_BYTES 16
#endif

typedef double element;
typedef int64_t lane;
typedef double vector __attribute__((vector_size(VECTOR_BYTES)));
typedef int64_t lanes __attribute__((vector_size(VECTOR_BYTES)));
typedef double loose_vector __attribute__((vector_size(VECTOR_BYTES), aligned(8), may_alias));
typedef double tight_vector __attribute__((vector_size(VECTOR_BYTES), may_alias));
typedef int64_t tight_lanes __attribute__((vector_size(VECTOR_BYTES), may_alias));

static inline element element_of(double value)
{
    return value;
}

static inline vector spread(element x)
{
    return x - (vector){0};
}

/* What stays the same for all cells of a step. */
typedef struct constants {
    vector weight;
    vector rounder;
    vector minus_eight;
    vector tolerance;
} constants;

static inline constants constants_of(const reiter_flow *flow)
{
    return (constants){spread(flow->weight), spread(flow->rounder), spread(-8), spread(flow->tolerance)};
}

/* sum − 8·here, exact: the same with and without a fused instruction. */
static inline vector less_eight(vector sum, vector here, const constants *with)
{
#if defined(__AVX512F__)
    return _mm512_fmadd_pd(here, with->minus_eight, sum);
#elif defined(__AVX2__) && defined(__FMA__)
    return _mm256_fmadd_pd(here, with->minus_eight, sum);
#else
    return here * with->minus_eight + sum;
#endif
}

static inline vector flow_of(vector sum, const constants *with)
{
    return (with->weight * sum + with->rounder) - with->rounder;
}

static inline lanes is_beyond(vector value, vector limit)
{
    return ~((value <= limit) & (value >= -limit));
}

#endif
