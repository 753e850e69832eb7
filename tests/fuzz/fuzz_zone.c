/* Zones of any bytes, on small grids of all engines: the same answer from all, and the same crystal. */
#include "fuzz.h"

#include <string.h>

enum { MOST_GRIDS = 3, MOST_MASK = 256 };

typedef struct engines {
    snow_grid *grid[MOST_GRIDS];
    size_t count;
} engines;

static bool add_engine(engines *all, const snow_packard_params *scene, snow_packard_engine engine)
{
    snow_packard_params params = *scene;
    params.engine = engine;
    snow_options options;
    snow_options_init(&options, sizeof options);
    options.memory_limit = 1 << 20;
    snow_status status = snow_packard_create(&params, &options, &all->grid[all->count]);
    if (status != SNOW_OK)
        return false;
    all->count++;
    return true;
}

static snow_packard_params scene_of(fuzz_input *input)
{
    snow_packard_params params;
    snow_packard_params_init(&params, sizeof params);
    uint32_t choice = fuzz_below(input, 12); /* seldom the plane: its tiles have 4096 cells each to ask zones for */
    params.domain = choice == 0 ? SNOW_PACKARD_PLANE : (snow_packard_domain)(SNOW_PACKARD_DISC + choice % 5);
    params.rule = fuzz_below(input, 128);
    if (params.domain == SNOW_PACKARD_PLANE)
        params.rule &= 0x7E;
    params.radius = 1 + (int32_t)fuzz_below(input, 12);
    params.width = 1 + (int32_t)fuzz_below(input, 20);
    params.height = 1 + (int32_t)fuzz_below(input, 20);
    params.record_freeze_steps = (int32_t)fuzz_below(input, 2);
    return params;
}

static int checkered(void *context, int32_t q, int32_t r)
{
    (void)context;
    return (q ^ r) & 1;
}

/* Any bytes, save for pointers: those are NULL, or lead to a mask of the size that the zone names. */
static snow_packard_zone zone_of(fuzz_input *input, uint8_t mask[MOST_MASK])
{
    snow_packard_zone zone;
    snow_packard_zone_init(&zone, sizeof zone, (snow_packard_zone_kind)(1 + fuzz_below(input, 2)),
                           (snow_packard_zone_shape)(1 + fuzz_below(input, 3)));
    uint8_t choice = fuzz_byte(input);
    if ((choice & 1) != 0) {
        fuzz_fill(input, &zone, sizeof zone);
        zone.mask = NULL;
        zone.contains = NULL;
        if ((choice & 2) != 0)
            zone.struct_size = sizeof zone;
        if (zone.struct_size > sizeof zone) /* nothing stands behind it here */
            zone.struct_size = sizeof zone - 1;
    } else {
        zone.first_step = 1 + fuzz_below(input, 4);
        zone.last_step = zone.first_step + (choice & 2 ? fuzz_below(input, 4) : (int64_t)fuzz_u32(input));
        zone.centre.q = fuzz_coordinate(input);
        zone.centre.r = fuzz_coordinate(input);
        zone.half_width = fuzz_number(input);
        zone.half_angle = choice & 4 ? 10 * fuzz_number(input) : 0;
        zone.inner = fuzz_coordinate(input);
        zone.outer = choice & 8 ? fuzz_coordinate(input) : INT32_MAX;
        zone.inverted = choice >> 4 & 1;
    }
    if ((choice & 32) != 0)
        zone.rect = (snow_rect){fuzz_coordinate(input), fuzz_coordinate(input), (int32_t)fuzz_below(input, 17),
                                (int32_t)fuzz_below(input, 17)};
    /* The caller's own loop over a large rectangle would take long, and find nothing. */
    bool small = (int64_t)zone.rect.width * zone.rect.height <= MOST_MASK;
    if ((choice & 64) != 0 && small) {
        fuzz_fill(input, mask, MOST_MASK);
        zone.mask = mask;
    }
    if ((choice & 128) != 0 && small)
        zone.contains = checkered;
    return zone;
}

static snow_status add_zone(const engines *all, const snow_packard_zone *zone)
{
    snow_status status = snow_packard_add_zone(all->grid[0], zone);
    for (size_t i = 1; i < all->count; i++) {
        snow_status other = snow_packard_add_zone(all->grid[i], zone);
        REQUIRE(other == status);
    }
    return status;
}

static void compare(const engines *all)
{
    uint64_t digest[MOST_GRIDS];
    for (size_t i = 0; i < all->count; i++) {
        REQUIRE(snow_digest(all->grid[i], &digest[i]) == SNOW_OK);
        REQUIRE(digest[i] == digest[0]);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input input = fuzz_start(data, size);
    snow_packard_params params = scene_of(&input);
    uint32_t zones = 1 + fuzz_below(&input, 3);
    engines all = {.count = 0};
    bool made = add_engine(&all, &params, SNOW_PACKARD_ENGINE_REFERENCE) &&
                add_engine(&all, &params, SNOW_PACKARD_ENGINE_TILES);
    if (made && params.domain == SNOW_PACKARD_PLANE && !params.record_freeze_steps && fuzz_below(&input, 8) == 1)
        (void)add_engine(&all, &params, SNOW_PACKARD_ENGINE_QUADTREE);
    for (uint32_t i = 0; made && i < zones; i++) {
        uint8_t mask[MOST_MASK];
        snow_packard_zone zone = zone_of(&input, mask);
        (void)add_zone(&all, &zone);
        uint32_t steps = fuzz_below(&input, 6);
        for (size_t k = 0; k < all.count; k++)
            made = made && snow_step(all.grid[k], steps) == SNOW_OK;
    }
    if (made) {
        compare(&all);
        fuzz_save_and_load(all.grid[all.count - 1], 2);
    }
    for (size_t i = 0; i < all.count; i++)
        snow_destroy(all.grid[i]);
    return 0;
}
