#include "base/digest.h"
#include "base/floating.h"
#include "base/model.h"

enum { SLICE = 256 };

static void add_row(const snow_grid *grid, int32_t r, snow_digest_state *digest)
{
    snow_run_of_cells run = snow_domain_row(&grid->domain, r);
    double values[SLICE];
    for (int64_t q = run.first; q < run.end; q += SLICE) {
        size_t count = run.end - q < SLICE ? (size_t)(run.end - q) : SLICE;
        grid->operations->read(grid, SNOW_FIELD_VALUE, q, r, count, values);
        for (size_t i = 0; i < count; i++)
            snow_digest_add_double(digest, values[i]);
    }
}

static void add_rows(const snow_grid *grid, snow_digest_state *digest)
{
    for (int32_t row = 0; row < grid->domain.rows; row++)
        add_row(grid, grid->domain.top + row, digest);
}

snow_status snow_digest(const snow_grid *grid, uint64_t *digest)
{
    if (grid == NULL || digest == NULL)
        return SNOW_ERROR_NULL;
    if (grid->domain.too_large)
        return SNOW_ERROR_TOO_LARGE;
    snow_floating floating;
    snow_floating_enter(&floating);
    snow_digest_state state;
    snow_digest_start(&state);
    snow_digest_add(&state, (uint64_t)grid->operations->model, 8);
    snow_digest_add(&state, (uint64_t)grid->census.steps, 8);
    if (grid->operations->digest != NULL)
        grid->operations->digest(grid, &state);
    else
        add_rows(grid, &state);
    snow_floating_leave(&floating);
    *digest = snow_digest_end(&state);
    return SNOW_OK;
}
