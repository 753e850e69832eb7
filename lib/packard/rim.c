/* When frozen cells come near the edge of the interior. */
#include "base/hexagon.h"
#include "packard/model.h"

static int64_t lesser(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static int64_t greater(int64_t a, int64_t b)
{
    return a > b ? a : b;
}

/* Rows, and columns across them, stand √3/2 apart: more than 6/7. */
int64_t snow_packard_rim_distance(const snow_packard_params *params)
{
    int64_t half = lesser(params->width, params->height) / 2 - 1;
    switch (params->domain) {
    case SNOW_PACKARD_PLANE:
    case SNOW_PACKARD_TORUS: return INT64_MAX;
    case SNOW_PACKARD_DISC: return params->radius - 1;
    case SNOW_PACKARD_HEXAGON: half = params->radius - 1; break;
    case SNOW_PACKARD_RECTANGLE:
    case SNOW_PACKARD_RHOMBUS: break;
    }
    return half * 6 / 7;
}

/* The cells of a row all of whose neighbours lie inside. */
static snow_run_of_cells sheltered(const snow_domain *domain, int64_t r)
{
    snow_run_of_cells above = snow_domain_row(domain, r - 1);
    snow_run_of_cells row = snow_domain_row(domain, r);
    snow_run_of_cells below = snow_domain_row(domain, r + 1);
    int64_t first = greater(row.first + 1, greater(above.first, below.first + 1));
    int64_t end = lesser(row.end - 1, lesser(above.end - 1, below.end));
    return (snow_run_of_cells){(int32_t)first, (int32_t)greater(first, end), 0};
}

static bool any_frozen(const snow_grid *grid, int64_t r, int64_t first, int64_t end)
{
    const packard *model = packard_of(grid);
    enum { WORDS = 64 };
    uint64_t words[WORDS];
    for (int64_t q = first; q < end; q += WORDS * PACKARD_WORD) {
        packard_region part = {q, r, lesser(end - q, WORDS * PACKARD_WORD), 1};
        model->engine->copy(model->cells, &part, words);
        for (size_t i = 0; i < packard_words((uint64_t)part.width); i++)
            if (words[i] != 0)
                return true;
    }
    return false;
}

bool snow_packard_is_at_rim(const snow_grid *grid)
{
    const packard *model = packard_of(grid);
    const snow_census *census = &grid->census;
    if (!packard_has_rim(model) || snow_hexagon_is_empty(&census->hexagon) ||
        census->tip_square < (double)(model->rim_distance * model->rim_distance))
        return false;
    for (int64_t r = census->hexagon.least_r; r <= census->hexagon.greatest_r; r++) {
        snow_run_of_cells row = snow_domain_row(&grid->domain, r);
        snow_run_of_cells inner = sheltered(&grid->domain, r);
        if (any_frozen(grid, r, row.first, lesser(inner.first, row.end)) || any_frozen(grid, r, inner.end, row.end))
            return true;
    }
    return false;
}
