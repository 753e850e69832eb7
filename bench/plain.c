#include "plain.h"

#include <stdlib.h>
#include <string.h>

/* The interior of one row: cells first to end - 1 of the padded arrays. */
typedef struct row_span {
    size_t first;
    size_t end;
} row_span;

/* What depends on the type of the numbers: plain_passes.h. */
typedef struct arithmetic {
    size_t size; /* bytes of a number */
    void (*load)(plain_crystal *crystal, const double *values);
    double (*read)(const plain_crystal *crystal, size_t index);
    bool (*rim_reached)(const plain_crystal *crystal);
    void (*step)(plain_crystal *crystal);
} arithmetic;

/*
 * The arrays cover the bounds of the domain and one more cell on each side. Cells outside the interior keep the
 * background in value and vapour for ever.
 */
struct plain_crystal {
    const arithmetic *numbers;
    void *value;
    void *vapour;
    void *kept; /* What a receptive cell has, with this step's addition; 0 elsewhere. */
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

#define REAL double
#define NAMED(x) x##_double
#include "plain_passes.h"
#undef REAL
#undef NAMED

#define REAL float
#define NAMED(x) x##_single
#include "plain_passes.h"

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

static bool read_values(plain_crystal *crystal, const snow_grid *start)
{
    snow_rect padded = {crystal->bounds.q - 1, crystal->bounds.r - 1, crystal->bounds.width + 2,
                        crystal->bounds.height + 2};
    size_t count = padded_count(crystal);
    double *values = malloc(count * sizeof *values);
    bool done = values != NULL &&
                snow_field_copy(start, SNOW_FIELD_VALUE, &padded, values, count, NULL) == SNOW_OK;
    if (done)
        crystal->numbers->load(crystal, values);
    free(values);
    return done;
}

static bool read_domain(plain_crystal *crystal, const snow_reiter_params *params, const snow_grid *start)
{
    size_t cells = (size_t)crystal->bounds.width * (size_t)crystal->bounds.height;
    double *inside = malloc(cells * sizeof *inside);
    bool done = inside != NULL &&
                snow_field_copy(start, SNOW_FIELD_INSIDE, &crystal->bounds, inside, cells, NULL) == SNOW_OK &&
                find_rows(crystal, params, inside);
    free(inside);
    return done;
}

plain_crystal *plain_create(const snow_reiter_params *params, bool single, const snow_grid *start)
{
    plain_crystal *crystal = calloc(1, sizeof *crystal);
    if (crystal == NULL)
        return NULL;
    if (snow_domain_bounds(start, &crystal->bounds) == SNOW_OK) {
        crystal->numbers = single ? &arithmetic_single : &arithmetic_double;
        crystal->addition = params->addition;
        crystal->diffusion = params->diffusion;
        crystal->stride = (size_t)crystal->bounds.width + 2;
        crystal->value = malloc(padded_count(crystal) * crystal->numbers->size);
        crystal->vapour = malloc(padded_count(crystal) * crystal->numbers->size);
        crystal->kept = calloc(padded_count(crystal), crystal->numbers->size);
        crystal->rows = calloc((size_t)crystal->bounds.height, sizeof *crystal->rows);
    }
    if (crystal->value == NULL || crystal->vapour == NULL || crystal->kept == NULL || crystal->rows == NULL ||
        !read_values(crystal, start) || !read_domain(crystal, params, start)) {
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

void plain_run(plain_crystal *crystal, int64_t max_steps, bool rim)
{
    const arithmetic *numbers = crystal->numbers;
    while (crystal->steps < max_steps && !(rim && numbers->rim_reached(crystal))) {
        numbers->step(crystal);
        crystal->steps++;
    }
}

int64_t plain_steps(const plain_crystal *crystal)
{
    return crystal->steps;
}

uint64_t plain_memory(const plain_crystal *crystal)
{
    return 3 * (uint64_t)crystal->numbers->size * (uint64_t)padded_count(crystal);
}

static bool is_ice(const plain_crystal *crystal, size_t index)
{
    return crystal->numbers->read(crystal, index) >= 1.0;
}

uint64_t plain_frozen(const plain_crystal *crystal)
{
    uint64_t frozen = 0;
    for (int32_t row = 0; row < crystal->bounds.height; row++) {
        for (size_t i = crystal->rows[row].first; i < crystal->rows[row].end; i++)
            frozen += is_ice(crystal, i);
    }
    return frozen;
}

void plain_copy_frozen(const plain_crystal *crystal, double *frozen)
{
    for (int32_t row = 0; row < crystal->bounds.height; row++) {
        for (int32_t column = 0; column < crystal->bounds.width; column++)
            *frozen++ = is_ice(crystal, padded_index(crystal, column, row)) ? 1.0 : 0.0;
    }
}

static bool is_receptive(const plain_crystal *crystal, size_t i)
{
    size_t stride = crystal->stride;
    return is_ice(crystal, i) || is_ice(crystal, i + 1) || is_ice(crystal, i - 1) || is_ice(crystal, i - stride) ||
           is_ice(crystal, i - stride + 1) || is_ice(crystal, i + stride) || is_ice(crystal, i + stride - 1);
}

void plain_copy_vapour(const plain_crystal *crystal, double *vapour)
{
    for (int32_t row = 0; row < crystal->bounds.height; row++) {
        for (int32_t column = 0; column < crystal->bounds.width; column++) {
            size_t i = padded_index(crystal, column, row);
            *vapour++ = is_receptive(crystal, i) ? 0.0 : crystal->numbers->read(crystal, i);
        }
    }
}
