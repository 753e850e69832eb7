/* The caller's floating-point state is neither relied on nor left changed:
   rounding mode, flush-to-zero, traps and flags. */
#ifndef SNOW_BASE_FLOATING_H
#define SNOW_BASE_FLOATING_H

#include <fenv.h>

typedef struct snow_floating {
    fenv_t saved;
} snow_floating;

/* From here on: round to nearest, subnormals kept, no traps. */
void snow_floating_enter(snow_floating *state);

void snow_floating_leave(const snow_floating *state);

#endif
