/* Structs of any bytes: options, scenes, conditions to stop, views, summaries. The first byte chooses how much of it is
   any bytes and how much a scene that could be meant. */
#include "scenes.h"

#include <stdlib.h>
#include <string.h>

/* As much memory as the struct's size tells, so that a sanitizer sees a read beyond it; any bytes in it. */
static void *any_struct(fuzz_input *input, size_t right)
{
    uint8_t choice = fuzz_byte(input);
    size_t size = choice < 0xE0 ? right : choice < 0xF0 ? right + fuzz_below(input, 24) : fuzz_below(input, 255);
    size_t room = size > sizeof(size_t) ? size : sizeof(size_t);
    unsigned char *bytes = malloc(room);
    REQUIRE(bytes != NULL);
    fuzz_fill(input, bytes, room);
    memcpy(bytes, &size, sizeof size);
    return bytes;
}

/* The sign may stay, and so may everything that is wrong with it. */
static int32_t with_bits(int32_t value, uint32_t bits)
{
    return (int32_t)((uint32_t)value & bits);
}

static snow_status create_reiter(fuzz_input *input, const snow_options *options, snow_grid **grid)
{
    snow_reiter_params *params = any_struct(input, sizeof *params);
    if (params->struct_size >= sizeof *params) {
        params->seeds = NULL;
        params->background_at = params->addition_at = NULL;
        params->radius = with_bits(params->radius, 0x800003FF); /* what is larger takes long before memory runs out */
    }
    snow_status status = snow_reiter_create(params, options, grid);
    free(params);
    return status;
}

static snow_status create_packard(fuzz_input *input, const snow_options *options, snow_grid **grid)
{
    snow_packard_params *params = any_struct(input, sizeof *params);
    if (params->struct_size >= sizeof *params) {
        params->seeds = NULL;
        params->scatter_side &= 0x1F;
    }
    snow_status status = snow_packard_create(params, options, grid);
    free(params);
    return status;
}

/* Sound scenes in which walkers walk long are cut down to some that end soon. */
static snow_status create_aggregate(fuzz_input *input, const snow_options *options, snow_grid **grid)
{
    snow_aggregate_params *params = any_struct(input, sizeof *params);
    if (params->struct_size >= sizeof *params) {
        params->seeds = params->obstacles = NULL;
        params->scene = (snow_aggregate_scene)with_bits((int32_t)params->scene, 0x8000000F);
        params->lattice = (snow_aggregate_lattice)with_bits((int32_t)params->lattice, 0x80000007);
        params->launch_radius = with_bits(params->launch_radius, 0x8000003F);
        params->width = with_bits(params->width, 0x8000003F);
        params->height = with_bits(params->height, 0x8000001F);
        params->depth = with_bits(params->depth, 0x8000000F);
        params->hits = with_bits(params->hits, 0x80000007);
        params->hardness_greatest = with_bits(params->hardness_greatest, 0x8000000F);
        if (params->sticking > 0 && params->sticking < 1.0 / 64)
            params->sticking = 1.0 / 64;
        if (params->kill_radius > 4 && params->kill_radius < 1e30)
            params->kill_radius = 4;
    }
    snow_status status = snow_aggregate_create(params, options, grid);
    free(params);
    return status;
}

static snow_status create_of_any_bytes(fuzz_input *input, const snow_options *options, snow_grid **grid)
{
    switch (fuzz_below(input, 3)) {
    case 0: return create_reiter(input, options, grid);
    case 1: return create_packard(input, options, grid);
    default: return create_aggregate(input, options, grid);
    }
}

static int end_soon(void *context, const snow_grid *grid, const snow_summary *summary)
{
    int *calls = context;
    REQUIRE(snow_step((snow_grid *)(uintptr_t)grid, 1) == SNOW_ERROR_BUSY);
    REQUIRE(summary->reason == SNOW_STOP_NONE);
    return ++*calls >= 3;
}

static void run_to_any_end(fuzz_input *input, snow_grid *grid)
{
    snow_stop *stop = any_struct(input, sizeof *stop);
    snow_summary *summary = any_struct(input, sizeof *summary);
    int calls = 0;
    int64_t before = 0;
    (void)snow_steps(grid, &before);
    if (stop->struct_size >= sizeof *stop) {
        stop->progress = end_soon;
        stop->progress_context = &calls;
        stop->progress_steps &= ~INT64_C(0xFC);
        if (stop->progress_steps > 4)
            stop->progress_steps = 4;
        if (stop->max_steps > before + 16)
            stop->max_steps = before + 16;
    }
    snow_status status = snow_run(grid, stop, summary);
    if (status == SNOW_OK)
        REQUIRE(summary->reason > SNOW_STOP_NONE && summary->reason <= SNOW_STOP_HEIGHT &&
                summary->reason != SNOW_STOP_UNSTABLE);
    free(summary);
    free(stop);
}

static void draw_any_view(fuzz_input *input, const snow_grid *grid)
{
    enum { ROOM = 4096 };
    snow_view *view = any_struct(input, sizeof *view);
    size_t size = 0;
    if (view->struct_size >= sizeof *view && fuzz_below(input, 4) != 0) {
        view->width = with_bits(view->width, 0x8000001F);
        view->height = with_bits(view->height, 0x8000001F);
        view->samples = with_bits(view->samples, 0x80000003);
        view->palette = (snow_palette)(fuzz_byte(input) % 7);
        view->pixel = (snow_pixel)(fuzz_byte(input) % 5);
        view->transparent &= 1;
        view->scale = fuzz_number(input);
        view->centre_x = fuzz_number(input);
        view->centre_y = fuzz_number(input);
    }
    unsigned char *pixels = malloc(ROOM);
    REQUIRE(pixels != NULL);
    (void)snow_render(grid, view, pixels, ROOM, &size);
    (void)snow_view_fit(grid, (int32_t)fuzz_u32(input), view);
    free(pixels);
    free(view);
}

static void use_any_options(fuzz_input *input)
{
    snow_options *options = any_struct(input, sizeof *options);
    if (options->struct_size >= sizeof *options) {
        options->allocate = NULL;
        if (options->threads != -1)
            options->threads = with_bits(options->threads, 0x80000401); /* none is started: two threads cost more than all the rest */
        options->parallel_for = NULL;
        options->memory_limit &= 0xFFFF;
        options->memory_limit |= 1;
        options->release = fuzz_below(input, 4) == 0 ? options->release : NULL;
        if (options->threads == 0 || options->threads == 1024)
            options->threads = 1;
    }
    snow_packard_params params;
    snow_packard_params_init(&params, sizeof params);
    snow_grid *grid = NULL;
    if (snow_packard_create(&params, options, &grid) == SNOW_OK)
        snow_destroy(grid);
    free(options);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input input = fuzz_start(data, size);
    uint8_t choice = fuzz_byte(&input);
    if (choice >= 0xF8)
        use_any_options(&input);
    snow_options options = fuzz_options(&input);
    snow_grid *grid = NULL;
    snow_status status = choice >= 0x80 ? create_of_any_bytes(&input, &options, &grid)
                                        : fuzz_create(choice % fuzz_models(), &input, &options, &grid);
    REQUIRE((status == SNOW_OK) == (grid != NULL));
    if (status != SNOW_OK)
        return 0;
    run_to_any_end(&input, grid);
    if (fuzz_is_small(grid))
        draw_any_view(&input, grid);
    fuzz_query(grid);
    snow_destroy(grid);
    return 0;
}
