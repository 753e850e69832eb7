/* The caller's floating-point state is neither relied on nor left changed:
   rounding mode, flush-to-zero, traps and flags. */
#ifndef SNOW_BASE_FLOATING_H
#define SNOW_BASE_FLOATING_H

#include <fenv.h>

#if defined(__GNUC__)
#define SNOW_APART __attribute__((noinline))
#else
#define SNOW_APART
#endif

typedef struct snow_floating {
    fenv_t saved;
} snow_floating;

/* From here on: round to nearest, subnormals kept, no traps. Compilers do not
   know that arithmetic must stay before snow_floating_leave(): results go
   through pointers before it, or come from a function that is SNOW_APART. */
void snow_floating_enter(snow_floating *state);

void snow_floating_leave(const snow_floating *state);

#endif
