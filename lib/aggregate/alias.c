#include "aggregate/alias.h"

snow_status snow_alias_start(snow_alias *alias, snow_heap *heap, uint32_t most)
{
    alias->weight = snow_heap_get_raw(heap, most, sizeof *alias->weight);
    alias->threshold = snow_heap_get_raw(heap, most, sizeof *alias->threshold);
    alias->other = snow_heap_get_raw(heap, most, sizeof *alias->other);
    alias->queue = snow_heap_get_raw(heap, most, sizeof *alias->queue);
    if (alias->weight != NULL && alias->threshold != NULL && alias->other != NULL && alias->queue != NULL)
        return SNOW_OK;
    snow_alias_end(alias, heap);
    return heap->refusal;
}

void snow_alias_end(snow_alias *alias, snow_heap *heap)
{
    snow_heap_put(heap, alias->queue);
    snow_heap_put(heap, alias->other);
    snow_heap_put(heap, alias->threshold);
    snow_heap_put(heap, alias->weight);
    *alias = (snow_alias){NULL, NULL, NULL, NULL};
}

static void scale(double *weight, uint32_t outcomes)
{
    double total = 0;
    for (uint32_t i = 0; i < outcomes; i++)
        total += weight[i];
    for (uint32_t i = 0; i < outcomes; i++)
        weight[i] *= outcomes / total;
}

/* M. D. Vose, IEEE Trans. Softw. Eng. 17 (1991) 972: whoever has too much fills up whoever lacks. */
void snow_alias_cut(snow_alias *alias, uint32_t outcomes)
{
    uint32_t lacking = 0;
    uint32_t rich = outcomes;
    scale(alias->weight, outcomes);
    for (uint32_t i = 0; i < outcomes; i++) {
        alias->queue[alias->weight[i] < 1 ? lacking++ : --rich] = i;
        alias->threshold[i] = UINT32_MAX;
        alias->other[i] = i;
    }
    while (lacking > 0 && rich < outcomes) {
        uint32_t poor = alias->queue[--lacking];
        uint32_t giver = alias->queue[rich];
        alias->threshold[poor] = (uint32_t)(alias->weight[poor] * 0x1p32);
        alias->other[poor] = giver;
        alias->weight[giver] -= 1 - alias->weight[poor];
        if (alias->weight[giver] < 1) {
            alias->queue[lacking++] = giver;
            rich++;
        }
    }
}
