#include "aggregate/order.h"

#include "aggregate/table.h"

static uint64_t place_of(const snow_order *order, const snow_sites *sites, uint64_t packed)
{
    uint64_t place = snow_table_hash(packed) & (order->slots - 1);
    while (order->slot[place] != 0 && snow_sites_packed(sites, order->slot[place] - 1) != packed)
        place = (place + 1) & (order->slots - 1);
    return place;
}

void snow_order_add(snow_order *order, const snow_sites *sites, uint64_t number)
{
    uint64_t place = place_of(order, sites, snow_sites_packed(sites, number));
    if (order->slot[place] != 0)
        return;
    order->slot[place] = (uint32_t)number + 1;
    order->count++;
}

int64_t snow_order_find(const snow_order *order, const snow_sites *sites, snow_site site)
{
    if (order->slots == 0)
        return -1;
    return (int64_t)order->slot[place_of(order, sites, snow_site_pack(sites->space, site))] - 1;
}

snow_status snow_order_reserve(snow_order *order, snow_heap *heap, const snow_sites *sites, uint64_t more)
{
    uint64_t slots = order->slots == 0 ? 1024 : order->slots;
    while ((order->count + more) * 4 > slots * 3)
        slots *= 2;
    if (slots == order->slots)
        return SNOW_OK;
    if (slots > SIZE_MAX / sizeof *order->slot)
        return SNOW_ERROR_TOO_LARGE;
    snow_order larger = {snow_heap_get(heap, (size_t)slots, sizeof *larger.slot), slots, 0};
    if (larger.slot == NULL)
        return heap->refusal;
    for (uint64_t i = 0; i < order->slots; i++)
        if (order->slot[i] != 0)
            snow_order_add(&larger, sites, order->slot[i] - 1);
    snow_order_end(order, heap);
    *order = larger;
    return SNOW_OK;
}

void snow_order_end(snow_order *order, snow_heap *heap)
{
    snow_heap_put(heap, order->slot);
    *order = (snow_order){0};
}
