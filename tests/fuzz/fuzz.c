#include "fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MEMORY = 1 << 18, MOST_CELLS = 160, MOST_BYTES = 1 << 15 };

fuzz_input fuzz_start(const uint8_t *data, size_t size)
{
    return (fuzz_input){data, size > 0 ? data + size : data};
}

size_t fuzz_left(const fuzz_input *input)
{
    return (size_t)(input->end - input->next);
}

void fuzz_fill(fuzz_input *input, void *object, size_t size)
{
    size_t left = fuzz_left(input);
    size_t some = size < left ? size : left;
    memset(object, 0, size);
    if (some > 0)
        memcpy(object, input->next, some);
    input->next += some;
}

uint8_t fuzz_byte(fuzz_input *input)
{
    return input->next < input->end ? *input->next++ : 0;
}

uint32_t fuzz_u32(fuzz_input *input)
{
    uint32_t value;
    fuzz_fill(input, &value, sizeof value);
    return value;
}

uint64_t fuzz_u64(fuzz_input *input)
{
    uint64_t value;
    fuzz_fill(input, &value, sizeof value);
    return value;
}

uint32_t fuzz_below(fuzz_input *input, uint32_t limit)
{
    return fuzz_byte(input) % limit;
}

int32_t fuzz_coordinate(fuzz_input *input)
{
    uint8_t byte = fuzz_byte(input);
    return byte < 0xF0 ? byte % 16 - 8 : (int32_t)fuzz_u32(input);
}

double fuzz_number(fuzz_input *input)
{
    uint8_t byte = fuzz_byte(input);
    if (byte < 0xF0)
        return (byte + fuzz_byte(input) / 256.0) / 64.0;
    double number;
    fuzz_fill(input, &number, sizeof number);
    return number;
}

void fuzz_require(bool holds, const char *promise)
{
    if (holds)
        return;
    fprintf(stderr, "broken: %s\n", promise);
    abort();
}

static void run_reversed(void *context, size_t count, snow_task task, void *argument)
{
    (void)context;
    while (count-- > 0)
        task(argument, count);
}

snow_options fuzz_options(fuzz_input *input)
{
    snow_options options;
    snow_options_init(&options, sizeof options);
    options.memory_limit = MEMORY;
    uint8_t byte = fuzz_byte(input);
    if ((byte & 1) != 0)
        options.isa = SNOW_ISA_BASELINE;
    if ((byte & 6) == 6) {
        options.threads = 3;
        options.parallel_for = run_reversed;
    }
    if (byte >= 0xF8)
        options.memory_limit = 1 + 64 * (uint64_t)fuzz_byte(input);
    return options;
}

bool fuzz_is_small(const snow_grid *grid)
{
    uint64_t cells = UINT64_MAX;
    snow_rect frozen;
    return snow_domain_cells(grid, &cells) == SNOW_OK && cells <= MOST_CELLS &&
           snow_frozen_bounds(grid, &frozen) == SNOW_OK &&
           (int64_t)frozen.width * frozen.height <= MOST_CELLS;
}

bool fuzz_is_quick(const snow_grid *grid)
{
    enum { FAR = 256, OFTEN = 16 };
    snow_aggregate_params params;
    snow_aggregate_params_init(&params, sizeof params);
    if (snow_aggregate_params_of(grid, &params) != SNOW_OK)
        return true;
    return params.launch_radius <= FAR && params.kill_radius <= 4 && params.width <= FAR && params.height <= FAR &&
           params.depth <= FAR && params.sticking >= 1.0 / 64 && params.hits <= OFTEN &&
           params.hardness_greatest <= OFTEN && params.interaction <= FAR;
}

static void query_fields(const snow_grid *grid)
{
    static const snow_rect rects[] = {{-2, -1, 5, 4}, {INT32_MIN, INT32_MIN, 2, 1}, {INT32_MAX, INT32_MAX, 1, 1}};
    for (int field = SNOW_FIELD_VALUE - 1; field <= SNOW_FIELD_BACKGROUND + 1; field++) {
        double values[20];
        double value;
        size_t count = 0;
        snow_status status = snow_cell_value(grid, (snow_field)field, -2, -1, &value);
        for (size_t i = 0; i < COUNT_OF(rects); i++)
            REQUIRE(snow_field_copy(grid, (snow_field)field, &rects[i], values, COUNT_OF(values), &count) == status);
        REQUIRE(status != SNOW_OK || count == 1);
        if (status == SNOW_OK && snow_field_copy(grid, (snow_field)field, &rects[0], values, 20, NULL) == SNOW_OK)
            REQUIRE(memcmp(&value, values, sizeof value) == 0);
    }
}

/* Some models have no such measure, or one that needs what they did not record. */
static bool answers(snow_status status)
{
    return status == SNOW_OK || status == SNOW_ERROR_UNSUPPORTED || status == SNOW_ERROR_NOT_RECORDED;
}

/* Scenes of many clusters count the largest as frozen, and fill the cells of all. */
static bool is_one_crystal(const snow_grid *grid)
{
    snow_aggregate_params params;
    snow_aggregate_params_init(&params, sizeof params);
    return snow_aggregate_params_of(grid, &params) != SNOW_OK || params.scene != SNOW_AGGREGATE_CLUSTER_CLUSTER;
}

static void query_whole(const snow_grid *grid)
{
    bool one = is_one_crystal(grid);
    double vapour, ice, defect = 0, dimension;
    uint64_t digest, again, boxes, frozen, masses[3];
    REQUIRE(answers(snow_mass(grid, &vapour, &ice)));
    REQUIRE(answers(snow_symmetry_defect(grid, &defect)) && defect >= 0);
    REQUIRE(snow_digest(grid, &digest) == SNOW_OK && snow_digest(grid, &again) == SNOW_OK && digest == again);
    REQUIRE(snow_frozen(grid, &frozen) == SNOW_OK);
    snow_status status = snow_box_count(grid, 1, &boxes);
    REQUIRE(answers(status) && (status != SNOW_OK || !one || boxes == frozen));
    status = snow_mass_radius(grid, (double[]){0, 2, 1e30}, 3, masses);
    REQUIRE(answers(status) && (status != SNOW_OK || !one || masses[2] == frozen));
    (void)snow_dimension(grid, &dimension);
}

void fuzz_draw(const snow_grid *grid)
{
    if (!fuzz_is_small(grid))
        return;
    snow_view view;
    unsigned char pixels[8 * 8 * 4];
    size_t size;
    snow_view_init(&view, sizeof view);
    (void)snow_view_fit(grid, 8, &view);
    view.width = view.height = 8;
    view.samples = 1;
    view.pixel = SNOW_PIXEL_RGBA;
    snow_status status = snow_render(grid, &view, pixels, sizeof pixels, &size);
    REQUIRE(answers(status) && (status != SNOW_OK || size == sizeof pixels));
}

void fuzz_query(const snow_grid *grid)
{
    snow_model model;
    int64_t steps;
    uint64_t cells, bytes;
    double radius, density = 0;
    snow_rect rect;
    snow_hexagon hexagon;
    snow_isa isa;
    REQUIRE(snow_model_of(grid, &model) == SNOW_OK);
    REQUIRE(snow_steps(grid, &steps) == SNOW_OK && steps >= 0);
    REQUIRE(snow_memory(grid, &bytes) == SNOW_OK && bytes > 0 && bytes <= MEMORY);
    REQUIRE(snow_isa_of(grid, &isa) == SNOW_OK && snow_isa_available(isa));
    REQUIRE(snow_tip_radius(grid, &radius) == SNOW_OK && radius >= 0);
    REQUIRE(answers(snow_density(grid, &density)) && density >= 0 && density <= 1);
    REQUIRE(snow_frozen_hexagon(grid, &hexagon) == SNOW_OK);
    (void)snow_frozen(grid, &cells);
    (void)snow_frozen_bounds(grid, &rect);
    (void)snow_domain_bounds(grid, &rect);
    query_fields(grid);
    if (fuzz_is_small(grid))
        query_whole(grid);
}

static unsigned char *save(const snow_grid *grid, size_t *size)
{
    REQUIRE(snow_save(grid, NULL, 0, size) == SNOW_OK);
    if (*size > MOST_BYTES)
        return NULL;
    unsigned char *bytes = malloc(*size);
    REQUIRE(bytes != NULL && snow_save(grid, bytes, *size, size) == SNOW_OK);
    return bytes;
}

static uint64_t digest_of(const snow_grid *grid)
{
    uint64_t digest = 0;
    (void)snow_digest(grid, &digest);
    return digest;
}

void fuzz_save_and_load(snow_grid *grid, int64_t steps)
{
    size_t size;
    unsigned char *bytes = fuzz_is_small(grid) ? save(grid, &size) : NULL;
    if (bytes == NULL)
        return;
    snow_options options;
    snow_options_init(&options, sizeof options);
    options.memory_limit = 4 * MEMORY;
    snow_grid *copy = NULL;
    REQUIRE(snow_load(bytes, size, &options, &copy) == SNOW_OK);
    free(bytes);
    REQUIRE(digest_of(grid) == digest_of(copy));
    if (fuzz_is_quick(grid) && snow_step(grid, steps) == SNOW_OK && snow_step(copy, steps) == SNOW_OK &&
        fuzz_is_small(grid))
        REQUIRE(digest_of(grid) == digest_of(copy));
    snow_destroy(copy);
}
