/* A hash table from 64-bit keys to 32-bit counts. */
#ifndef SNOW_AGGREGATE_TABLE_H
#define SNOW_AGGREGATE_TABLE_H

#include "base/heap.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct snow_table {
    uint64_t *key;
    uint32_t *count; /* 0: the slot is free */
    uint64_t slots;  /* 0 or a power of two */
    uint64_t used;
} snow_table;

static inline uint64_t snow_table_hash(uint64_t key)
{
    key ^= key >> 32;
    key *= UINT64_C(0xD6E8FEB86659FD93);
    key ^= key >> 32;
    key *= UINT64_C(0xD6E8FEB86659FD93);
    return key ^ key >> 32;
}

/* Makes room for so many more keys; on failure nothing has changed. */
snow_status snow_table_reserve(snow_table *table, snow_heap *heap, uint64_t more);

/* Whether there is room for one more. */
static inline bool snow_table_has_room(const snow_table *table)
{
    return (table->used + 1) * 4 <= table->slots * 3;
}

/* The count of a key, to be raised above 0; there must be room. */
uint32_t *snow_table_at(snow_table *table, uint64_t key);

/* 0 when it is not there. */
uint32_t snow_table_get(const snow_table *table, uint64_t key);

/* Takes a key out. */
void snow_table_remove(snow_table *table, uint64_t key);

void snow_table_end(snow_table *table, snow_heap *heap);

#endif
