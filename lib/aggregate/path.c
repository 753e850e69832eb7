/* Whether walkers can come to the cluster at all: obstacles may shut it in.
   Once they can, they always can: a particle joins where a walker has come. */
#include "aggregate/cells.h"
#include "aggregate/vessel.h"

enum { MOST_CELLS = 1 << 28, REACHED = 128 };

typedef struct flood {
    snow_cells cells;
    uint64_t *front; /* sites that were reached */
    size_t count;
    const snow_aggregate_params *params;
    bool space;
} flood;

/* A box that holds cluster and obstacles, with a free rim all round or, in a vessel, above. */
static void find_box(const aggregate *model, snow_site *low, snow_site *high)
{
    bool space = aggregate_is_space(&model->params);
    bool none = model->sites.count == 0;
    *low = none ? snow_sites_at(&model->obstacles, 0) : model->low;
    *high = none ? *low : model->high;
    for (uint64_t i = 0; i < model->obstacles.count; i++) {
        *low = snow_site_least(*low, snow_sites_at(&model->obstacles, i));
        *high = snow_site_greatest(*high, snow_sites_at(&model->obstacles, i));
    }
    if (model->params.scene == SNOW_AGGREGATE_LINE) {
        const snow_aggregate_params *params = &model->params;
        bool hexagonal = params->lattice == SNOW_AGGREGATE_HEXAGONAL;
        int32_t top = space ? high->z + 1 : high->y + 1;
        *low = (snow_site){hexagonal ? -top / 2 - 1 : 0, 0, 0};
        *high = (snow_site){params->width - 1, space ? params->depth - 1 : top, space ? top : 0};
        return;
    }
    *low = (snow_site){low->x - 1, low->y - 1, space ? low->z - 1 : 0};
    *high = (snow_site){high->x + 1, high->y + 1, space ? high->z + 1 : 0};
}

static void reach(flood *self, snow_site site)
{
    uint8_t *mark = snow_cells_at(&self->cells, site);
    if (*mark != 0)
        return;
    *mark = REACHED;
    self->front[self->count++] = snow_site_pack(self->space, site);
}

/* Goes on from a site; true when the cluster or the floor is met. */
static bool spread(flood *self, snow_site site)
{
    bool vessel = self->params->scene == SNOW_AGGREGATE_LINE;
    const aggregate_neighbours *steps = snow_aggregate_steps(self->params->lattice);
    for (int i = 0; i < steps->count; i++) {
        snow_site next = aggregate_moved(site, steps->step[i]);
        if (vessel && (self->space ? next.z : next.y) < 0)
            return true;
        if (vessel)
            next = snow_vessel_keep(self->params, next);
        if (!snow_cells_has(&self->cells, next))
            continue;
        if (*snow_cells_at(&self->cells, next) & SNOW_CELL_FILLED)
            return true;
        reach(self, next);
    }
    return false;
}

static void mark_all(flood *self, const snow_sites *sites, uint8_t mark)
{
    for (uint64_t i = 0; i < sites->count; i++)
        *snow_cells_at(&self->cells, snow_sites_at(sites, i)) = mark;
}

/* Walkers come from the free rim: its lowest corner, or the vessel's row above everything. */
static void begin(flood *self)
{
    const snow_cells *cells = &self->cells;
    snow_site corner = cells->low;
    if (self->params->scene == SNOW_AGGREGATE_LINE) {
        int32_t top = (self->space ? cells->extent.z : cells->extent.y) - 1;
        corner = self->space ? (snow_site){0, 0, top} : (snow_site){0, top, 0};
        if (self->params->lattice == SNOW_AGGREGATE_HEXAGONAL)
            corner.x = -(top / 2);
    }
    reach(self, corner);
}

static bool reaches_cluster(flood *self, const aggregate *model)
{
    mark_all(self, &model->obstacles, SNOW_CELL_BARRED);
    mark_all(self, &model->sites, SNOW_CELL_FILLED);
    begin(self);
    for (size_t next = 0; next < self->count; next++)
        if (spread(self, snow_site_unpack(self->space, self->front[next])))
            return true;
    return false;
}

snow_status snow_aggregate_find_path(snow_grid *grid)
{
    const aggregate *model = aggregate_of(grid);
    if (model->obstacles.count == 0)
        return SNOW_OK;
    flood self = {.params = &model->params, .space = aggregate_is_space(&model->params)};
    snow_site low;
    snow_site high;
    find_box(model, &low, &high);
    uint64_t across = ((uint64_t)(high.x - low.x) + 1) * ((uint64_t)(high.y - low.y) + 1);
    if (across > MOST_CELLS || across * ((uint64_t)(high.z - low.z) + 1) > MOST_CELLS)
        return SNOW_ERROR_TOO_LARGE;
    size_t cells = (size_t)(across * ((uint64_t)(high.z - low.z) + 1));
    snow_status status = snow_cells_cover(&self.cells, &grid->heap, low, high);
    if (status == SNOW_OK) {
        self.front = snow_heap_get_raw(&grid->heap, cells, sizeof *self.front);
        status = self.front != NULL ? SNOW_OK : grid->heap.refusal;
    }
    if (self.front != NULL && !reaches_cluster(&self, model))
        status = SNOW_ERROR_AGGREGATE_PATH;
    snow_heap_put(&grid->heap, self.front);
    snow_cells_end(&self.cells, &grid->heap);
    return status;
}
