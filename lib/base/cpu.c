#define _DEFAULT_SOURCE
#define _DARWIN_C_SOURCE
#include "base/cpu.h"

#include <stddef.h>
#ifdef _WIN32
#include <windows.h>
#else
#include <unistd.h>
#endif

int snow_isa_available(snow_isa isa)
{
    switch (isa) {
    case SNOW_ISA_AUTO:
    case SNOW_ISA_BASELINE:
        return 1;
#ifdef SNOW_HAVE_X86_KERNELS
    case SNOW_ISA_AVX2:
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case SNOW_ISA_AVX512:
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
               __builtin_cpu_supports("avx512dq");
#else
    case SNOW_ISA_AVX2:
    case SNOW_ISA_AVX512:
        return 0;
#endif
    }
    return 0;
}

const char *snow_isa_name(snow_isa isa)
{
    switch (isa) {
    case SNOW_ISA_AUTO: return "auto";
    case SNOW_ISA_BASELINE: return "baseline";
    case SNOW_ISA_AVX2: return "avx2";
    case SNOW_ISA_AVX512: return "avx512";
    }
    return NULL;
}

snow_isa snow_cpu_best(void)
{
    if (snow_isa_available(SNOW_ISA_AVX512))
        return SNOW_ISA_AVX512;
    if (snow_isa_available(SNOW_ISA_AVX2))
        return SNOW_ISA_AVX2;
    return SNOW_ISA_BASELINE;
}

static long processors(void)
{
#ifdef _WIN32
    SYSTEM_INFO system;
    GetSystemInfo(&system);
    return (long)system.dwNumberOfProcessors;
#else
    return sysconf(_SC_NPROCESSORS_ONLN);
#endif
}

int snow_cpu_count(void)
{
    long count = processors();
    return count < 1 ? 1 : count > 1024 ? 1024 : (int)count;
}
