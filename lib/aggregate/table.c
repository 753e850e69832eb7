#include "aggregate/table.h"

static uint64_t place_of(const snow_table *table, uint64_t key)
{
    uint64_t place = snow_table_hash(key) & (table->slots - 1);
    while (table->count[place] != 0 && table->key[place] != key)
        place = (place + 1) & (table->slots - 1);
    return place;
}

uint32_t *snow_table_at(snow_table *table, uint64_t key)
{
    uint64_t place = place_of(table, key);
    if (table->count[place] == 0) {
        table->key[place] = key;
        table->used++;
    }
    return &table->count[place];
}

uint32_t snow_table_get(const snow_table *table, uint64_t key)
{
    return table->slots == 0 ? 0 : table->count[place_of(table, key)];
}

/* Keys behind the hole that belong before it move up, so that no search ends early. */
void snow_table_remove(snow_table *table, uint64_t key)
{
    uint64_t mask = table->slots - 1;
    uint64_t hole = place_of(table, key);
    if (table->count[hole] == 0)
        return;
    for (uint64_t next = (hole + 1) & mask; table->count[next] != 0; next = (next + 1) & mask) {
        uint64_t home = snow_table_hash(table->key[next]) & mask;
        if (((next - home) & mask) >= ((next - hole) & mask)) {
            table->key[hole] = table->key[next];
            table->count[hole] = table->count[next];
            hole = next;
        }
    }
    table->count[hole] = 0;
    table->used--;
}

static snow_status move_to(snow_table *table, snow_heap *heap, uint64_t slots)
{
    if (slots > SIZE_MAX / sizeof *table->key)
        return SNOW_ERROR_TOO_LARGE;
    snow_table larger = {snow_heap_get_raw(heap, (size_t)slots, sizeof *larger.key), NULL, slots, 0};
    if (larger.key == NULL)
        return heap->refusal;
    larger.count = snow_heap_get(heap, (size_t)slots, sizeof *larger.count);
    if (larger.count == NULL) {
        snow_heap_put(heap, larger.key);
        return heap->refusal;
    }
    for (uint64_t i = 0; i < table->slots; i++)
        if (table->count[i] != 0)
            *snow_table_at(&larger, table->key[i]) = table->count[i];
    snow_table_end(table, heap);
    *table = larger;
    return SNOW_OK;
}

snow_status snow_table_reserve(snow_table *table, snow_heap *heap, uint64_t more)
{
    uint64_t slots = table->slots == 0 ? 64 : table->slots;
    while ((table->used + more) * 4 > slots * 3)
        slots *= 2;
    return slots == table->slots ? SNOW_OK : move_to(table, heap, slots);
}

void snow_table_end(snow_table *table, snow_heap *heap)
{
    snow_heap_put(heap, table->key);
    snow_heap_put(heap, table->count);
    *table = (snow_table){0};
}
