#include "base/structs.h"

#include <string.h>

/* No struct of any version is larger: a greater size is an uninitialised one,
   and its tail must not be read. */
enum { GREATEST_STRUCT = 1024 };

static size_t size_of(const void *caller)
{
    size_t size;
    memcpy(&size, caller, sizeof size);
    return size;
}

snow_status snow_struct_check(const void *caller, size_t smallest, size_t ours)
{
    size_t size = size_of(caller);
    if (size < smallest || size > GREATEST_STRUCT)
        return SNOW_ERROR_STRUCT_SIZE;
    const unsigned char *bytes = caller;
    for (size_t i = ours; i < size; i++)
        if (bytes[i] != 0)
            return SNOW_ERROR_STRUCT_TAIL;
    return SNOW_OK;
}

void snow_struct_read(void *ours, size_t our_size, const void *caller)
{
    size_t size = size_of(caller);
    memcpy(ours, caller, size < our_size ? size : our_size);
    memcpy(ours, &our_size, sizeof our_size);
}

snow_status snow_struct_take(void *ours, size_t our_size, const void *caller)
{
    snow_status status = snow_struct_check(caller, our_size, our_size);
    if (status == SNOW_OK)
        snow_struct_read(ours, our_size, caller);
    return status;
}

void snow_struct_write(void *caller, const void *ours, size_t our_size)
{
    size_t size = size_of(caller);
    memcpy(caller, ours, size < our_size ? size : our_size);
    memcpy(caller, &size, sizeof size);
}

void snow_struct_init(void *caller, size_t struct_size, const void *defaults, size_t our_size)
{
    if (caller == NULL || struct_size < sizeof struct_size)
        return;
    memset(caller, 0, struct_size);
    memcpy(caller, defaults, struct_size < our_size ? struct_size : our_size);
    memcpy(caller, &struct_size, sizeof struct_size);
}
