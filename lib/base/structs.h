/* Structs that cross the ABI: each begins with its size as the caller was compiled. */
#ifndef SNOW_BASE_STRUCTS_H
#define SNOW_BASE_STRUCTS_H

#include <snowgrowth/status.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Members that stand for yes and no hold nothing else. */
static inline bool snow_is_flag(int32_t value)
{
    return value == 0 || value == 1;
}

/* A caller's struct is refused when it is smaller than in the first release
   (or was never initialised), or sets a member that lies beyond ours. */
snow_status snow_struct_check(const void *caller, size_t smallest, size_t ours);

/* Copies what the caller knows over the defaults that `ours` already holds. */
void snow_struct_read(void *ours, size_t our_size, const void *caller);

/* Both, for a struct that has not grown since the first release. */
snow_status snow_struct_take(void *ours, size_t our_size, const void *caller);

/* Copies to the caller what it knows; its struct_size stays. */
void snow_struct_write(void *caller, const void *ours, size_t our_size);

/* Gives the caller the defaults, zeroes beyond ours, and its struct_size. */
void snow_struct_init(void *caller, size_t struct_size, const void *defaults, size_t our_size);

#endif
