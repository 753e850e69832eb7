#include "scenes.h"

#include <string.h>

/* A row of the table: what differs from the defaults of the library. */
typedef struct recipe {
    const char *name;
    const char *what;
    double background, addition, diffusion;
    snow_reiter_domain domain;
    int32_t radius, width, height; /* radius, or width and height */
    snow_reiter_rim rim;
    const snow_cell *seeds;
    size_t seed_count;
    int32_t cluster;
    double noise;
    int32_t noise_symmetric;
    snow_reiter_field background_at, addition_at;
    int64_t exactly; /* > 0: so many steps, no other condition; else until rim, still or at_most */
    int64_t at_most;
    int64_t steps;
    uint64_t frozen, digest;
    bool slow;
} recipe;

static const snow_cell off_axis[] = {{0, 0}, {23, 11}};
static const snow_cell no_seeds[] = {{0, 0}};

/* A medium that thins out to one side, in steps that are exact in binary. */
static double thinning_background(void *context, int32_t q, int32_t r)
{
    (void)context;
    (void)r;
    return 0.5 + q / 512.0;
}

/* Six sectors that differ: cells with q·r > 0 gain twice as much. */
static double sector_addition(void *context, int32_t q, int32_t r)
{
    (void)context;
    return (int64_t)q * r > 0 ? 0.002 : 0.001;
}

static const recipe recipes[] = {
    {.name = "dendrite-r100", .what = "paper's dendrite in a small disc",
     .background = 0.4, .addition = 0.001, .diffusion = 1, .radius = 100,
     .steps = 2011, .frozen = 7975, .digest = UINT64_C(0xd586f1192b626a41)},
    {.name = "thin-r200", .what = "thin dendrite, the acceptance scene",
     .background = 0.4, .addition = 0.0001, .diffusion = 1, .radius = 200,
     .steps = 4304, .frozen = 18607, .digest = UINT64_C(0x610da904242b1a1f)},
    {.name = "thin-r200-offaxis", .what = "the same with a second seed that breaks every symmetry",
     .background = 0.4, .addition = 0.0001, .diffusion = 1, .radius = 200, .seeds = off_axis, .seed_count = 2,
     .steps = 3683, .frozen = 17811, .digest = UINT64_C(0xbb249234907c7c5a)},
    {.name = "star", .what = "dendrite that closes to a star (paper, fig. 4)",
     .background = 0.6, .addition = 0.01, .diffusion = 1, .radius = 100,
     .steps = 487, .frozen = 14821, .digest = UINT64_C(0x8a3c4a6a24c464ed)},
    {.name = "plate", .what = "no vapour: ring k freezes at step 100 k",
     .background = 0, .addition = 0.01, .diffusion = 1, .radius = 110,
     .steps = 10000, .frozen = 30301, .digest = UINT64_C(0xd5be9ab22ceb1b27)},
    {.name = "sector", .what = "sectored plate (paper, fig. 4)",
     .background = 0.9, .addition = 0.05, .diffusion = 1, .radius = 100,
     .steps = 98, .frozen = 27307, .digest = UINT64_C(0xe13754599ff16790)},
    {.name = "alpha-0.5", .what = "slow diffusion (paper, fig. 5)",
     .background = 0.4, .addition = 0.0001, .diffusion = 0.5, .radius = 60,
     .steps = 2389, .frozen = 2293, .digest = UINT64_C(0x6393c9e482df08c9)},
    {.name = "alpha-2.003", .what = "negative centre weight (paper, fig. 5)",
     .background = 0.4, .addition = 0.0001, .diffusion = 2.003, .radius = 60,
     .steps = 617, .frozen = 2149, .digest = UINT64_C(0xb8d0ebb14b44cd0b)},
    {.name = "alpha-2.6", .what = "just inside the stable range",
     .background = 0.4, .addition = 0.0001, .diffusion = 2.6, .radius = 60,
     .steps = 505, .frozen = 2233, .digest = UINT64_C(0x74b0ed5a356dcd05)},
    {.name = "near-tie", .what = "0.95 + 0.05 = 1 must freeze",
     .background = 0.95, .addition = 0.05, .diffusion = 1, .radius = 100,
     .steps = 98, .frozen = 29107, .digest = UINT64_C(0xeb3f38577bab753a)},
    {.name = "polish-600", .what = "600 x 600 rectangle, rim rule of the program of Połuszejko and Grabiński",
     .background = 0.4, .addition = 0.001, .diffusion = 1, .domain = SNOW_REITER_RECTANGLE, .width = 600, .height = 600,
     .rim = SNOW_REITER_RIM_ROW, .at_most = 3000,
     .steps = 3000, .frozen = 20083, .digest = UINT64_C(0x9f164299ba365756), .slow = true},
    {.name = "hexagon", .what = "hexagonal domain",
     .background = 0.4, .addition = 0.001, .diffusion = 1, .domain = SNOW_REITER_HEXAGON, .radius = 80,
     .steps = 1581, .frozen = 4999, .digest = UINT64_C(0x8ed8a61f8532ee93)},
    {.name = "noise", .what = "noise that breaks every symmetry",
     .background = 0.4, .addition = 0.001, .diffusion = 1, .radius = 80, .noise = 0.1,
     .steps = 1590, .frozen = 5195, .digest = UINT64_C(0x803ce2240cd6d374)},
    {.name = "noise-symmetric", .what = "noise with the symmetry of the hexagon",
     .background = 0.4, .addition = 0.001, .diffusion = 1, .radius = 80, .noise = 0.1, .noise_symmetric = 1,
     .steps = 1666, .frozen = 5515, .digest = UINT64_C(0x6aedc0f24f4f2c46)},
    {.name = "cluster", .what = "random 5 x 5 patch (paper, fig. 6)",
     .background = 0.35, .addition = 0.001, .diffusion = 1, .radius = 80, .cluster = 5,
     .steps = 2108, .frozen = 5015, .digest = UINT64_C(0x03651cc60560702f)},
    {.name = "per-cell", .what = "background and addition that differ from cell to cell",
     .background = 0.5, .addition = 0.001, .diffusion = 1, .radius = 80, .background_at = thinning_background,
     .addition_at = sector_addition,
     .steps = 621, .frozen = 3927, .digest = UINT64_C(0xafc559fa4e1aaa52)},
    {.name = "kernel-l2", .what = "no ice, dense noise, fits a second-level cache",
     .background = 0.4, .addition = 0.001, .diffusion = 1, .domain = SNOW_REITER_RECTANGLE, .width = 128, .height = 96,
     .seeds = no_seeds, .noise = 0.3, .exactly = 2000,
     .steps = 2000, .frozen = 0, .digest = UINT64_C(0x28ac8dd997f1f9df)},
    {.name = "kernel-ram", .what = "no ice, dense noise, larger than every cache",
     .background = 0.4, .addition = 0.001, .diffusion = 1, .domain = SNOW_REITER_RECTANGLE, .width = 4096,
     .height = 2048, .seeds = no_seeds, .noise = 0.3, .exactly = 20,
     .steps = 20, .frozen = 0, .digest = UINT64_C(0x241b2ba113ac833d), .slow = true},
    {.name = "dendrite-r1000", .what = "large dendrite to the rim",
     .background = 0.4, .addition = 0.001, .diffusion = 1, .radius = 1000, .at_most = -1,
     .steps = 20911, .frozen = 2149513, .digest = UINT64_C(0x3c46e19a84612c0a), .slow = true},
    {.name = "kernel-huge", .what = "no ice, dense noise, 2 GB of vapour: twenty times most last-level caches",
     .background = 0.4, .addition = 0.001, .diffusion = 1, .domain = SNOW_REITER_RECTANGLE, .width = 16384,
     .height = 8192, .seeds = no_seeds, .noise = 0.3, .exactly = 48,
     .steps = 48, .frozen = 0, .digest = UINT64_C(0xc144b5c721d7e1a6), .slow = true},
    {.name = "plate-r60", .what = "the plate in a smaller disc, for engines that are slow",
     .background = 0, .addition = 0.01, .diffusion = 1, .radius = 60,
     .steps = 5800, .frozen = 10267, .digest = UINT64_C(0xf0c59498d9eef35c)},
};

static void cook(const recipe *from, snow_scene *scene)
{
    snow_reiter_params params;
    snow_reiter_params_init(&params, sizeof params);
    params.background = from->background;
    params.addition = from->addition;
    params.diffusion = from->diffusion;
    if (from->domain != 0)
        params.domain = from->domain;
    if (from->radius > 0)
        params.radius = from->radius;
    if (from->width > 0) {
        params.width = from->width;
        params.height = from->height;
    }
    if (from->rim != 0)
        params.rim = from->rim;
    params.seeds = from->seeds;
    params.seed_count = from->seed_count;
    params.cluster = from->cluster;
    params.noise = from->noise;
    params.noise_symmetric = from->noise_symmetric;
    params.random_seed = 2005;
    params.background_at = from->background_at;
    params.addition_at = from->addition_at;

    snow_stop stop;
    snow_stop_init(&stop, sizeof stop);
    if (from->exactly > 0) {
        stop.max_steps = from->exactly;
        stop.rim = 0;
        stop.still = 0;
    } else if (from->at_most != 0) {
        stop.max_steps = from->at_most;
    }

    *scene = (snow_scene){
        .name = from->name,
        .what = from->what,
        .params = params,
        .stop = stop,
        .steps = from->steps,
        .frozen = from->frozen,
        .digest = from->digest,
        .slow = from->slow,
    };
}

size_t scene_count(void)
{
    return sizeof recipes / sizeof recipes[0];
}

bool scene_get(size_t index, snow_scene *scene)
{
    if (index >= scene_count())
        return false;
    cook(&recipes[index], scene);
    return true;
}

bool scene_find(const char *name, snow_scene *scene)
{
    for (size_t i = 0; i < scene_count(); i++)
        if (strcmp(recipes[i].name, name) == 0)
            return scene_get(i, scene);
    return false;
}
