/* Which engine takes the next steps. */
#include "packard/model.h"

/* Crystals farther out are not taken from the quadtree to the tiles. */
static const int64_t greatest_reach = INT64_C(1) << 22;

static bool fits_tiles(const snow_grid *grid)
{
    packard_region bounds = snow_packard_bounds(grid);
    return bounds.width <= 2 * greatest_reach && bounds.height <= 2 * greatest_reach;
}

static snow_status use(snow_grid *grid, const packard_engine *engine)
{
    const packard *model = packard_of(grid);
    if (model->engine == engine)
        return SNOW_OK;
    if (engine == &snow_packard_tiles && !fits_tiles(grid))
        return SNOW_ERROR_TOO_LARGE;
    return snow_packard_convert(grid, engine, model->folded);
}

snow_status snow_packard_choose(snow_grid *grid, int64_t *steps)
{
    const packard *model = packard_of(grid);
    bool zones = snow_packard_zones_apply(model, grid->census.steps + 1);
    switch (model->params.engine) {
    case SNOW_PACKARD_ENGINE_REFERENCE: return SNOW_OK;
    case SNOW_PACKARD_ENGINE_TILES: return SNOW_OK;
    case SNOW_PACKARD_ENGINE_QUADTREE: return use(grid, zones ? &snow_packard_tiles : &snow_packard_quadtree);
    case SNOW_PACKARD_ENGINE_AUTO: break;
    }
    (void)steps;
    return SNOW_OK;
}
