#include "base/options.h"

#include "base/cpu.h"
#include "base/structs.h"

enum { MOST_THREADS = 1024 };

static const snow_options defaults = {.struct_size = sizeof(snow_options), .threads = 1, .isa = SNOW_ISA_AUTO};

void snow_options_init(snow_options *options, size_t struct_size)
{
    snow_struct_init(options, struct_size, &defaults, sizeof defaults);
}

snow_status snow_options_settle(const snow_options *caller, snow_options *settled)
{
    *settled = defaults;
    if (caller != NULL) {
        snow_status status = snow_struct_take(settled, sizeof *settled, caller);
        if (status != SNOW_OK)
            return status;
    }
    if ((settled->allocate == NULL) != (settled->release == NULL))
        return SNOW_ERROR_RANGE;
    if (settled->threads < 0 || settled->threads > MOST_THREADS)
        return SNOW_ERROR_RANGE;
    if (settled->threads == 0)
        settled->threads = snow_cpu_count();
    if (snow_isa_name(settled->isa) == NULL)
        return SNOW_ERROR_ENUM;
    if (!snow_isa_available(settled->isa))
        return SNOW_ERROR_ISA;
    if (settled->isa == SNOW_ISA_AUTO)
        settled->isa = snow_cpu_best();
    return SNOW_OK;
}
