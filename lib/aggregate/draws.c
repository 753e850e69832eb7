#include "aggregate/draws.h"

snow_draws_refill snow_draws_choose(snow_isa isa)
{
    switch (isa) {
#ifdef SNOW_HAVE_X86_KERNELS
    case SNOW_ISA_AVX2:
    case SNOW_ISA_AVX512: return snow_draws_refill_avx2;
#else
    case SNOW_ISA_AVX2:
    case SNOW_ISA_AVX512:
#endif
    case SNOW_ISA_AUTO:
    case SNOW_ISA_BASELINE: break;
    }
    return snow_draws_refill_baseline;
}

void snow_draws_start(snow_draws *draws, snow_draws_refill refill, uint64_t key, uint64_t walker, uint32_t used)
{
    draws->key = key;
    draws->walker = walker;
    draws->refill = refill;
    snow_draws_move(draws, used);
}

void snow_draws_move(snow_draws *draws, uint32_t used)
{
    draws->used = used - used % SNOW_DRAWS_AT_ONCE;
    if (draws->used != used)
        draws->refill(draws);
    draws->used = used;
}
