#include "base/floating.h"

void snow_floating_enter(snow_floating *state)
{
    fegetenv(&state->saved);
    fesetenv(FE_DFL_ENV);
}

void snow_floating_leave(const snow_floating *state)
{
    fesetenv(&state->saved);
}
