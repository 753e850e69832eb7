#include "plain.h"

#include <stdlib.h>
#include <string.h>

/* The interior of one row: cells first to end - 1 of the padded arrays. */
typedef struct row_span {
    size_t first;
    size_t end;
} row_span;

/*
 * The arrays cover the bounds of the domain and one more cell on each side. Cells outside the interior keep the
 * background in value and vapour for ever.
 */
struct plain_crystal {
    double *value;
    double *vapour;
    double *kept; /* What a receptive cell has, with this step's addition; 0 elsewhere. */
    row_span *rows;
    size_t *rim; /* The cells that end a run when they are ice. */
    size_t rim_count;
    snow_rect bounds;
    size_t stride;
    double addition;
    double diffusion;
    int64_t steps;
};

bool plain_supports(const snow_reiter_params *params)
{
    return params->addition_at == NULL;
}

static size_t padded_index(const plain_crystal *crystal, int32_t column, int32_t row)
{
    return (size_t)(row + 1) * crystal->stride + (size_t)(column + 1);
}

static size_t padded_count(const plain_crystal *crystal)
{
    return ((size_t)crystal->bounds.height + 2) * crystal->stride;
}

/* The rim rules, cell by cell; a rectangle is counted in its drawn rows and columns. */
static bool near_rim(const snow_reiter_params *params, int64_t q, int64_t r)
{
    if (params->domain == SNOW_REITER_DISC) {
        int64_t reach = params->radius > 2 ? params->radius - 2 : 0;
        return q * q + q * r + r * r >= reach * reach;
    }
    if (params->domain == SNOW_REITER_HEXAGON)
        return llabs(q) >= params->radius - 2 || llabs(r) >= params->radius - 2 || llabs(q + r) >= params->radius - 2;
    int64_t middle_row = params->height / 2;
    int64_t row = r + middle_row;
    if (params->rim == SNOW_REITER_RIM_ROW)
        return row < params->height / 35;
    int64_t column = q + params->width / 2 - middle_row / 2 + row / 2;
    return row < 2 || row >= params->height - 2 || column < 2 || column >= params->width - 2;
}

/* Reads the interior's rows and its rim from the mask of the domain. */
static bool find_rows(plain_crystal *crystal, const snow_reiter_params *params, const double *inside)
{
    int32_t width = crystal->bounds.width;
    size_t capacity = (size_t)width * (size_t)crystal->bounds.height;
    crystal->rim = malloc(capacity * sizeof *crystal->rim);
    if (crystal->rim == NULL)
        return false;
    for (int32_t row = 0; row < crystal->bounds.height; row++) {
        row_span *span = &crystal->rows[row];
        for (int32_t column = 0; column < width; column++) {
            if (inside[(size_t)row * (size_t)width + (size_t)column] == 0.0)
                continue;
            size_t index = padded_index(crystal, column, row);
            if (span->end == 0)
                span->first = index;
            span->end = index + 1;
            if (near_rim(params, crystal->bounds.q + column, crystal->bounds.r + row))
                crystal->rim[crystal->rim_count++] = index;
        }
    }
    return true;
}

static bool read_start(plain_crystal *crystal, const snow_reiter_params *params, const snow_grid *start)
{
    size_t count = padded_count(crystal);
    snow_rect padded = {crystal->bounds.q - 1, crystal->bounds.r - 1, crystal->bounds.width + 2,
                        crystal->bounds.height + 2};
    if (snow_field_copy(start, SNOW_FIELD_VALUE, &padded, crystal->value, count, NULL) != SNOW_OK)
        return false;
    memcpy(crystal->vapour, crystal->value, count * sizeof *crystal->vapour);
    size_t cells = (size_t)crystal->bounds.width * (size_t)crystal->bounds.height;
    double *inside = malloc(cells * sizeof *inside);
    bool done = inside != NULL &&
                snow_field_copy(start, SNOW_FIELD_INSIDE, &crystal->bounds, inside, cells, NULL) == SNOW_OK &&
                find_rows(crystal, params, inside);
    free(inside);
    return done;
}

plain_crystal *plain_create(const snow_reiter_params *params, const snow_grid *start)
{
    plain_crystal *crystal = calloc(1, sizeof *crystal);
    if (crystal == NULL)
        return NULL;
    if (snow_domain_bounds(start, &crystal->bounds) == SNOW_OK) {
        crystal->addition = params->addition;
        crystal->diffusion = params->diffusion;
        crystal->stride = (size_t)crystal->bounds.width + 2;
        crystal->value = malloc(padded_count(crystal) * sizeof(double));
        crystal->vapour = malloc(padded_count(crystal) * sizeof(double));
        crystal->kept = calloc(padded_count(crystal), sizeof(double));
        crystal->rows = calloc((size_t)crystal->bounds.height, sizeof *crystal->rows);
    }
    if (crystal->value == NULL || crystal->vapour == NULL || crystal->kept == NULL || crystal->rows == NULL ||
        !read_start(crystal, params, start)) {
        plain_destroy(crystal);
        return NULL;
    }
    return crystal;
}

void plain_destroy(plain_crystal *crystal)
{
    if (crystal == NULL)
        return;
    free(crystal->value);
    free(crystal->vapour);
    free(crystal->kept);
    free(crystal->rows);
    free(crystal->rim);
    free(crystal);
}

static double greater(double a, double b)
{
    return a > b ? a : b;
}

/* First pass: v, and what receptive cells keep. One comparison a cell, for seven in a row are not vectorised. */
static void split_row(size_t first, size_t end, size_t stride, double addition, const double *restrict value,
                      double *restrict vapour, double *restrict kept)
{
    for (size_t i = first; i < end; i++) {
        double row = greater(greater(value[i - 1], value[i]), value[i + 1]);
        double above = greater(value[i - stride], value[i - stride + 1]);
        double below = greater(value[i + stride - 1], value[i + stride]);
        double most = greater(row, greater(above, below));
        double gained = value[i] + addition;
        vapour[i] = most < 1.0 ? value[i] : 0.0;
        kept[i] = most < 1.0 ? 0.0 : gained;
    }
}

/* Second pass: u' = kept + v + (alpha / 12) (sum of the six neighbours' v - 6 v). */
static void update_row(size_t first, size_t end, size_t stride, double rate, double *restrict value,
                       const double *restrict vapour, const double *restrict kept)
{
    for (size_t i = first; i < end; i++) {
        double sum = vapour[i + 1] + vapour[i - 1] + vapour[i + stride] + vapour[i - stride] +
                     vapour[i - stride + 1] + vapour[i + stride - 1];
        value[i] = kept[i] + vapour[i] + rate * (sum - 6.0 * vapour[i]);
    }
}

static bool rim_reached(const plain_crystal *crystal)
{
    for (size_t i = 0; i < crystal->rim_count; i++) {
        if (crystal->value[crystal->rim[i]] >= 1.0)
            return true;
    }
    return false;
}

void plain_run(plain_crystal *crystal, int64_t max_steps, bool rim)
{
    size_t stride = crystal->stride;
    double rate = crystal->diffusion / 12.0;
    while (crystal->steps < max_steps && !(rim && rim_reached(crystal))) {
        for (int32_t row = 0; row < crystal->bounds.height; row++) {
            row_span span = crystal->rows[row];
            split_row(span.first, span.end, stride, crystal->addition, crystal->value, crystal->vapour,
                      crystal->kept);
        }
        for (int32_t row = 0; row < crystal->bounds.height; row++) {
            row_span span = crystal->rows[row];
            update_row(span.first, span.end, stride, rate, crystal->value, crystal->vapour, crystal->kept);
        }
        crystal->steps++;
    }
}

int64_t plain_steps(const plain_crystal *crystal)
{
    return crystal->steps;
}

uint64_t plain_memory(const plain_crystal *crystal)
{
    return 3 * sizeof(double) * (uint64_t)padded_count(crystal);
}

uint64_t plain_frozen(const plain_crystal *crystal)
{
    uint64_t frozen = 0;
    for (int32_t row = 0; row < crystal->bounds.height; row++) {
        for (size_t i = crystal->rows[row].first; i < crystal->rows[row].end; i++)
            frozen += crystal->value[i] >= 1.0;
    }
    return frozen;
}

void plain_copy_frozen(const plain_crystal *crystal, double *frozen)
{
    for (int32_t row = 0; row < crystal->bounds.height; row++) {
        for (int32_t column = 0; column < crystal->bounds.width; column++)
            *frozen++ = crystal->value[padded_index(crystal, column, row)] >= 1.0 ? 1.0 : 0.0;
    }
}

static bool is_receptive(const double *cell, size_t stride)
{
    const double *above = cell - stride;
    const double *below = cell + stride;
    return cell[0] >= 1.0 || cell[1] >= 1.0 || cell[-1] >= 1.0 || above[0] >= 1.0 || above[1] >= 1.0 ||
           below[0] >= 1.0 || below[-1] >= 1.0;
}

void plain_copy_vapour(const plain_crystal *crystal, double *vapour)
{
    for (int32_t row = 0; row < crystal->bounds.height; row++) {
        for (int32_t column = 0; column < crystal->bounds.width; column++) {
            const double *cell = &crystal->value[padded_index(crystal, column, row)];
            *vapour++ = is_receptive(cell, crystal->stride) ? 0.0 : *cell;
        }
    }
}
