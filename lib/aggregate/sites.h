/* The particles' sites in the order in which they joined: 8 bytes each, in
   chunks that never move. */
#ifndef SNOW_AGGREGATE_SITES_H
#define SNOW_AGGREGATE_SITES_H

#include "base/heap.h"

#include <snowgrowth/aggregate.h>

#include <stdbool.h>
#include <stdint.h>

enum { SNOW_SITES_CHUNK = 1 << 13 };

typedef struct snow_sites {
    uint64_t **chunk;
    size_t chunks;   /* that hold memory */
    size_t capacity; /* of the list of chunks */
    uint64_t count;
    bool space;
} snow_sites;

/* A site as 64 bits: two coordinates of 32 bits, or in space three of 21. */
static inline uint64_t snow_site_pack(bool space, snow_site site)
{
    if (!space)
        return (uint64_t)(uint32_t)site.y << 32 | (uint32_t)site.x;
    const int32_t half = 1 << 20;
    return (uint64_t)(uint32_t)(site.z + half) << 42 | (uint64_t)(uint32_t)(site.y + half) << 21 |
           (uint32_t)(site.x + half);
}

static inline snow_site snow_site_unpack(bool space, uint64_t packed)
{
    if (!space)
        return (snow_site){(int32_t)(uint32_t)packed, (int32_t)(uint32_t)(packed >> 32), 0};
    const int32_t half = 1 << 20;
    const uint64_t mask = (UINT64_C(1) << 21) - 1;
    return (snow_site){(int32_t)(packed & mask) - half, (int32_t)(packed >> 21 & mask) - half,
                       (int32_t)(packed >> 42 & mask) - half};
}

/* The corners of the box that holds both. */
static inline snow_site snow_site_least(snow_site a, snow_site b)
{
    return (snow_site){a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z};
}

static inline snow_site snow_site_greatest(snow_site a, snow_site b)
{
    return (snow_site){a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z};
}

static inline uint64_t snow_sites_packed(const snow_sites *sites, uint64_t number)
{
    return sites->chunk[number / SNOW_SITES_CHUNK][number % SNOW_SITES_CHUNK];
}

static inline snow_site snow_sites_at(const snow_sites *sites, uint64_t number)
{
    return snow_site_unpack(sites->space, snow_sites_packed(sites, number));
}

/* Makes room for so many more; on failure nothing has changed. */
snow_status snow_sites_reserve(snow_sites *sites, snow_heap *heap, uint64_t more);

/* There must be room. */
static inline void snow_sites_add(snow_sites *sites, snow_site site)
{
    sites->chunk[sites->count / SNOW_SITES_CHUNK][sites->count % SNOW_SITES_CHUNK] =
        snow_site_pack(sites->space, site);
    sites->count++;
}

void snow_sites_end(snow_sites *sites, snow_heap *heap);

#endif
