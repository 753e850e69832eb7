/* Growth probabilities, sampled by walks that change nothing. */
#include "aggregate/chances.h"
#include "base/floating.h"
#include "base/sort.h"

typedef struct tally {
    snow_heap *heap;
    snow_table *hits;
    bool space;
    snow_status status;
} tally;

static bool count_end(void *context, snow_site end)
{
    tally *self = context;
    self->status = snow_table_reserve(self->hits, self->heap, 1);
    if (self->status != SNOW_OK)
        return false;
    ++*snow_table_at(self->hits, snow_site_pack(self->space, end));
    return true;
}

/* One walk by single steps; lost walkers send another one with the next number. */
static snow_status walk_once(const snow_grid *grid, uint64_t key, uint64_t *walker, snow_site *end)
{
    enum { PATIENCE = 1 << 24 };
    for (int32_t lost = 0; lost < PATIENCE; lost++) {
        snow_stream stream = snow_stream_start(key, SNOW_RANDOM_SAMPLE, (*walker)++);
        if (aggregate_of(grid)->scene->walk(grid, &stream, end))
            return SNOW_OK;
    }
    return SNOW_ERROR_AGGREGATE_PATH;
}

static snow_status count_walks(const snow_grid *grid, uint64_t walks, uint64_t key, snow_heap *heap, snow_table *hits)
{
    const aggregate *model = aggregate_of(grid);
    tally counted = {heap, hits, aggregate_is_space(&model->params), SNOW_OK};
    if (model->scene->sample != NULL) {
        snow_status status = model->scene->sample(grid, heap, key, walks, count_end, &counted);
        return status != SNOW_OK ? status : counted.status;
    }
    uint64_t walker = 0;
    for (uint64_t i = 0; i < walks; i++) {
        snow_site end;
        snow_status status = walk_once(grid, key, &walker, &end);
        if (status != SNOW_OK)
            return status;
        if (!count_end(&counted, end))
            return counted.status;
    }
    return SNOW_OK;
}

static int compare_sites(const void *a, const void *b)
{
    snow_site x = ((const snow_aggregate_chance *)a)->site;
    snow_site y = ((const snow_aggregate_chance *)b)->site;
    if (x.z != y.z)
        return x.z < y.z ? -1 : 1;
    if (x.y != y.y)
        return x.y < y.y ? -1 : 1;
    return (x.x > y.x) - (x.x < y.x);
}

static snow_status list_hits(const snow_table *hits, bool space, double walks, snow_heap *heap,
                             snow_aggregate_chance **found)
{
    *found = snow_heap_get_raw(heap, (size_t)hits->used, sizeof **found);
    if (*found == NULL)
        return heap->refusal;
    size_t there = 0;
    for (uint64_t i = 0; i < hits->slots; i++) {
        if (hits->count[i] == 0)
            continue;
        double chance = hits->count[i] / walks;
        (*found)[there++] = (snow_aggregate_chance){snow_site_unpack(space, hits->key[i]), chance,
                                                    sqrt(chance * (1 - chance) / walks)};
    }
    snow_sort(*found, there, sizeof **found, compare_sites);
    return SNOW_OK;
}

static snow_status sample(const snow_grid *grid, uint64_t walks, uint64_t key, snow_heap *heap, snow_table *hits,
                          snow_aggregate_chance **found)
{
    snow_floating floating;
    snow_floating_enter(&floating);
    snow_status status = count_walks(grid, walks, key, heap, hits);
    if (status == SNOW_OK)
        status = list_hits(hits, aggregate_is_space(&aggregate_of(grid)->params), (double)walks, heap, found);
    snow_floating_leave(&floating);
    return status;
}

snow_status snow_aggregate_sample(const snow_grid *grid, uint64_t walks, uint64_t random_seed,
                                  snow_aggregate_chance *chances, size_t capacity, size_t *count)
{
    snow_status status = snow_chances_check(grid, chances, count);
    if (status != SNOW_OK)
        return status;
    const aggregate *model = aggregate_of(grid);
    if (model->scene->sample == NULL && model->scene->walk == NULL)
        return SNOW_ERROR_UNSUPPORTED;
    if (walks < 1 || walks > UINT32_MAX)
        return SNOW_ERROR_RANGE;
    if (grid->census.full)
        return SNOW_ERROR_FULL;
    snow_heap heap = grid->heap; /* all that is taken goes back */
    snow_table hits = {0};
    snow_aggregate_chance *found = NULL;
    status = sample(grid, walks, random_seed, &heap, &hits, &found);
    if (status == SNOW_OK)
        status = snow_chances_copy(found, (size_t)hits.used, chances, capacity, count);
    snow_heap_put(&heap, found);
    snow_table_end(&hits, &heap);
    return status;
}
