/* Growth probabilities, solved. */
#include "aggregate/chances.h"
#include "aggregate/harmonic.h"
#include "base/floating.h"

static snow_status solve(const aggregate *model, snow_heap *heap, snow_aggregate_chance **found, size_t *there)
{
    const snow_aggregate_params *params = &model->params;
    snow_site *sites = snow_heap_get_raw(heap, (size_t)model->sites.count, sizeof *sites);
    if (sites == NULL)
        return heap->refusal;
    for (uint64_t i = 0; i < model->sites.count; i++)
        sites[i] = snow_sites_at(&model->sites, i);
    snow_status status = snow_harmonic_solve(heap, params->lattice, params->contact, sites,
                                             (size_t)model->sites.count, found, there);
    snow_heap_put(heap, sites);
    return status;
}

snow_status snow_aggregate_growth(const snow_grid *grid, snow_aggregate_chance *chances, size_t capacity,
                                  size_t *count)
{
    snow_status status = snow_chances_check(grid, chances, count);
    if (status != SNOW_OK)
        return status;
    const aggregate *model = aggregate_of(grid);
    if (model->params.scene != SNOW_AGGREGATE_WITTEN_SANDER || model->obstacles.count > 0 ||
        model->params.sticking < 1)
        return SNOW_ERROR_UNSUPPORTED;
    snow_heap heap = grid->heap; /* all that is taken goes back */
    snow_aggregate_chance *found = NULL;
    size_t there = 0;
    snow_floating floating;
    snow_floating_enter(&floating);
    status = solve(model, &heap, &found, &there);
    snow_floating_leave(&floating);
    if (status == SNOW_OK)
        status = snow_chances_copy(found, there, chances, capacity, count);
    snow_heap_put(&heap, found);
    return status;
}
