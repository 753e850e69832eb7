#include "aggregate/vessel.h"

/* A vessel's site as its walkers see it: the position across counts half columns on the
   hexagonal lattice, whose odd rows stand half a column to the right. */
static int32_t across_of(const snow_aggregate_params *params, snow_site site)
{
    return params->lattice == SNOW_AGGREGATE_HEXAGONAL ? 2 * site.x + site.y : site.x;
}

/* Walls and lid as mirrors of the lattice. On the square and cubic lattice they stand halfway between
   sites, and a step through one is as good as refused; on the hexagonal one they go through sites. */
static int32_t mirrored(int32_t x, int32_t last, bool through_sites)
{
    if (x < 0)
        return through_sites ? -x : -1 - x;
    if (x > last)
        return through_sites ? 2 * last - x : 2 * last + 1 - x;
    return x;
}

static int32_t joined(int32_t x, int32_t extent)
{
    return x < 0 ? x + extent : x >= extent ? x - extent : x;
}

snow_site snow_vessel_keep(const snow_aggregate_params *params, snow_site site)
{
    bool hexagonal = params->lattice == SNOW_AGGREGATE_HEXAGONAL;
    bool space = params->lattice == SNOW_AGGREGATE_CUBIC;
    int32_t columns = hexagonal ? 2 * params->width : params->width;
    int32_t *up = space ? &site.z : &site.y;
    int32_t across = across_of(params, site);
    int32_t kept = params->periodic ? joined(across, columns) : mirrored(across, columns - 1, hexagonal);
    site.x += hexagonal ? (kept - across) / 2 : kept - across;
    if (space)
        site.y = params->periodic ? joined(site.y, params->depth) : mirrored(site.y, params->depth - 1, false);
    int32_t height = mirrored(*up, params->height - 1, hexagonal);
    if (*up >= 0 && hexagonal)
        site.x += (*up - height) / 2; /* straight down */
    if (*up >= 0)
        *up = height;
    return site;
}

/* Uniform over the unfolded top row: on the hexagonal lattice a site on a mirror counts half. */
snow_site snow_vessel_launch(const snow_aggregate_params *params, snow_stream *stream)
{
    int32_t top = params->height - 1;
    if (params->lattice == SNOW_AGGREGATE_CUBIC) {
        int32_t x = (int32_t)snow_stream_below(stream, (uint32_t)params->width);
        return (snow_site){x, (int32_t)snow_stream_below(stream, (uint32_t)params->depth), top};
    }
    if (params->lattice == SNOW_AGGREGATE_SQUARE)
        return (snow_site){(int32_t)snow_stream_below(stream, (uint32_t)params->width), top, 0};
    uint32_t sites = (uint32_t)(params->periodic ? params->width : 2 * params->width - 1);
    int32_t across = (top & 1) + 2 * (int32_t)snow_stream_below(stream, sites);
    if (!params->periodic)
        across = mirrored(across, 2 * params->width - 1, true);
    return (snow_site){(across - top) / 2, top, 0};
}

bool snow_vessel_has(const snow_aggregate_params *params, snow_site site)
{
    bool space = params->lattice == SNOW_AGGREGATE_CUBIC;
    bool hexagonal = params->lattice == SNOW_AGGREGATE_HEXAGONAL;
    int32_t height = space ? site.z : site.y;
    int64_t across = hexagonal ? 2 * (int64_t)site.x + site.y : site.x;
    int64_t columns = (hexagonal ? 2 : 1) * (int64_t)params->width;
    return height >= 0 && height < params->height && across >= 0 && across < columns &&
           (!space || (site.y >= 0 && site.y < params->depth));
}

bool snow_vessel_inside(const snow_grid *grid, snow_site site)
{
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    return params->scene != SNOW_AGGREGATE_LINE || snow_vessel_has(params, site);
}
