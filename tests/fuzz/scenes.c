#include "scenes.h"

enum { MOST_SEEDS = 4 };

/* struct_size: mostly right. */
static size_t size_of(fuzz_input *input, size_t right)
{
    uint8_t byte = fuzz_byte(input);
    return byte < 0xF8 ? right : byte < 0xFC ? (size_t)fuzz_below(input, 255) : (size_t)fuzz_u64(input);
}

/* Mostly one of 0 to limit − 1, at times anything. */
static int32_t choice_of(fuzz_input *input, uint32_t limit)
{
    uint8_t byte = fuzz_byte(input);
    return byte < 0xF8 ? (int32_t)(byte % limit) : (int32_t)fuzz_u32(input);
}

static size_t seeds_of(fuzz_input *input, snow_cell seeds[MOST_SEEDS])
{
    size_t count = fuzz_below(input, MOST_SEEDS + 1);
    for (size_t i = 0; i < count; i++)
        seeds[i] = (snow_cell){fuzz_coordinate(input), fuzz_coordinate(input)};
    return count;
}

static double uneven(void *context, int32_t q, int32_t r)
{
    double number = *(const double *)context;
    return q == r ? number : (double)((q ^ r) & 7) / 16;
}

static snow_status create_reiter(fuzz_input *input, const snow_options *options, snow_grid **grid)
{
    snow_reiter_params params;
    snow_cell seeds[MOST_SEEDS];
    snow_reiter_params_init(&params, sizeof params);
    uint32_t set = fuzz_u32(input);
    params.background = set & 1 ? fuzz_number(input) / 4 : 0.4;
    params.addition = set & 2 ? fuzz_number(input) / 4 : 0.01;
    params.diffusion = set & 4 ? fuzz_number(input) : 1;
    params.domain = (snow_reiter_domain)choice_of(input, 4);
    params.radius = choice_of(input, 12);
    params.width = choice_of(input, 24);
    params.height = choice_of(input, 24);
    params.rim = (snow_reiter_rim)(1 + choice_of(input, 2));
    if (set & 8) {
        params.seed_count = seeds_of(input, seeds);
        params.seeds = set & 16 ? seeds : NULL;
    }
    if (set & 32)
        params.cluster = choice_of(input, 8);
    if (set & 64) {
        params.noise_symmetric = choice_of(input, 2);
        params.noise = fuzz_number(input) / 16;
    }
    params.random_seed = set & 128 ? fuzz_u64(input) : 0;
    double number = set & 256 ? fuzz_number(input) / 4 : 0.1;
    params.background_at = set & 512 ? uneven : NULL;
    params.addition_at = set & 1024 ? uneven : NULL;
    params.field_context = &number;
    params.record_freeze_steps = set & 2048 ? choice_of(input, 2) : 0;
    params.allow_unstable = set & 4096 ? choice_of(input, 2) : 0;
    params.engine = (snow_reiter_engine)choice_of(input, 4);
    params.symmetry = (snow_reiter_symmetry)choice_of(input, 2);
    params.precision = (snow_reiter_precision)choice_of(input, 2);
    params.tolerance = set & 8192 ? fuzz_number(input) / 4096 : 0;
    params.struct_size = size_of(input, sizeof params);
    if (params.struct_size > sizeof params) /* nothing stands behind the struct here */
        params.struct_size = sizeof params - 1;
    return snow_reiter_create(&params, options, grid);
}

static snow_status create_packard(fuzz_input *input, const snow_options *options, snow_grid **grid)
{
    snow_packard_params params;
    snow_cell seeds[MOST_SEEDS];
    snow_packard_params_init(&params, sizeof params);
    uint32_t set = fuzz_u32(input);
    params.rule = set & 1 ? (uint32_t)choice_of(input, 128) : params.rule;
    params.domain = (snow_packard_domain)choice_of(input, 7);
    params.radius = choice_of(input, 16);
    params.width = choice_of(input, 24);
    params.height = choice_of(input, 24);
    if (set & 8) {
        params.seed_count = seeds_of(input, seeds);
        params.seeds = set & 16 ? seeds : NULL;
    }
    if (set & 32)
        params.cluster = choice_of(input, 8);
    if (set & 64) {
        params.scatter = choice_of(input, 16);
        params.scatter_side = choice_of(input, 32);
    }
    params.random_seed = set & 128 ? fuzz_u64(input) : 0;
    params.record_freeze_steps = set & 2048 ? choice_of(input, 2) : 0;
    params.engine = (snow_packard_engine)choice_of(input, 4);
    params.struct_size = size_of(input, sizeof params);
    if (params.struct_size > sizeof params)
        params.struct_size = sizeof params - 1;
    return snow_packard_create(&params, options, grid);
}

static size_t sites_of(fuzz_input *input, snow_site sites[MOST_SEEDS])
{
    size_t count = fuzz_below(input, MOST_SEEDS + 1);
    for (size_t i = 0; i < count; i++)
        sites[i] = (snow_site){fuzz_coordinate(input), fuzz_coordinate(input), fuzz_below(input, 4) == 0};
    return count;
}

static snow_status create_aggregate(fuzz_input *input, const snow_options *options, snow_grid **grid)
{
    snow_aggregate_params params;
    snow_site seeds[MOST_SEEDS], obstacles[MOST_SEEDS];
    snow_aggregate_params_init(&params, sizeof params);
    uint32_t set = fuzz_u32(input);
    params.scene = (snow_aggregate_scene)choice_of(input, 11);
    params.lattice = (snow_aggregate_lattice)choice_of(input, 5);
    params.contact = (snow_aggregate_contact)choice_of(input, 4);
    params.engine = (snow_aggregate_engine)choice_of(input, 3);
    params.random_seed = fuzz_byte(input);
    params.launch_radius = choice_of(input, 24);
    params.end_radius = choice_of(input, 16);
    params.width = choice_of(input, 24);
    params.height = choice_of(input, 24);
    params.depth = choice_of(input, 8);
    params.wall_right = choice_of(input, 24);
    params.wall_right_top = choice_of(input, 24);
    params.particles = fuzz_byte(input);
    if (set & 1)
        params.sticking = (1 + fuzz_below(input, 100)) / 64.0; /* less takes its time */
    if (set & 2)
        params.hits = choice_of(input, 8);
    if (set & 4)
        params.record_order = choice_of(input, 2);
    if (set & 8) {
        params.seed_count = sites_of(input, seeds);
        params.seeds = set & 16 ? seeds : NULL;
    }
    if (set & 32) {
        params.obstacle_count = sites_of(input, obstacles);
        params.obstacles = set & 64 ? obstacles : NULL;
    }
    if (set & 128)
        params.kill_radius = fuzz_number(input);
    if (set & 256)
        params.periodic = choice_of(input, 2);
    if (set & 512) {
        params.launch_first = choice_of(input, 24);
        params.launch_last = choice_of(input, 24);
        params.cathode_first = choice_of(input, 24);
        params.cathode_last = choice_of(input, 24);
        params.interaction = fuzz_number(input);
    }
    if (set & 1024) {
        params.hardness_least = choice_of(input, 8);
        params.hardness_greatest = choice_of(input, 8);
    }
    if (set & 2048) {
        params.density = fuzz_number(input) / 4;
        params.mobility = fuzz_number(input);
    }
    params.struct_size = size_of(input, sizeof params);
    if (params.struct_size > sizeof params)
        params.struct_size = sizeof params - 1;
    return snow_aggregate_create(&params, options, grid);
}

typedef snow_status (*create_call)(fuzz_input *input, const snow_options *options, snow_grid **grid);

static const create_call creates[] = {create_reiter, create_packard, create_aggregate};

size_t fuzz_models(void)
{
    return COUNT_OF(creates);
}

snow_status fuzz_create(size_t model, fuzz_input *input, const snow_options *options, snow_grid **grid)
{
    return creates[model](input, options, grid);
}

static void change_conditions(fuzz_input *input, snow_grid *grid)
{
    snow_reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    snow_status known = snow_reiter_conditions_of(grid, &conditions);
    uint8_t set = fuzz_byte(input);
    if (set & 1)
        conditions.background = fuzz_number(input) / 4;
    if (set & 2)
        conditions.addition = fuzz_number(input) / 4;
    if (set & 4)
        conditions.diffusion = fuzz_number(input);
    conditions.rescale = choice_of(input, 2);
    snow_status status = snow_reiter_change(grid, &conditions);
    REQUIRE(known == SNOW_OK || status != SNOW_OK);
}

static void add_zone(fuzz_input *input, snow_grid *grid)
{
    snow_packard_zone zone;
    snow_packard_zone_init(&zone, sizeof zone, (snow_packard_zone_kind)(1 + fuzz_below(input, 2)),
                           (snow_packard_zone_shape)(1 + fuzz_below(input, 3)));
    zone.first_step = fuzz_below(input, 32);
    zone.last_step = zone.first_step + fuzz_below(input, 32);
    zone.half_width = fuzz_number(input);
    zone.inner = fuzz_coordinate(input);
    zone.rect = (snow_rect){fuzz_coordinate(input), fuzz_coordinate(input), choice_of(input, 16), choice_of(input, 16)};
    (void)snow_packard_add_zone(grid, &zone);
}

void fuzz_change(fuzz_input *input, snow_grid *grid)
{
    if (fuzz_below(input, 2) == 0)
        change_conditions(input, grid);
    else
        add_zone(input, grid);
}

static void ask_packard(fuzz_input *input, const snow_grid *grid)
{
    uint32_t rule;
    uint64_t high, low, words[4];
    snow_packard_engine engine;
    snow_status status = snow_packard_rule_of(grid, &rule);
    REQUIRE(snow_packard_engine_of(grid, &engine) == status);
    REQUIRE(snow_packard_population(grid, &high, &low) == status);
    int64_t q = fuzz_byte(input) < 0xF0 ? fuzz_coordinate(input) : (int64_t)fuzz_u64(input);
    int64_t r = fuzz_byte(input) < 0xF0 ? fuzz_coordinate(input) : (int64_t)fuzz_u64(input);
    (void)snow_packard_copy_bits(grid, q, r, choice_of(input, 65), choice_of(input, 5), words, COUNT_OF(words));
    size_t size = 0;
    if (fuzz_is_small(grid))
        REQUIRE(snow_packard_save_rle(grid, NULL, 0, &size) == status);
}

static void ask_aggregate(const snow_grid *grid)
{
    uint64_t particles;
    int64_t order;
    double radius;
    snow_point corners[2];
    snow_aggregate_params params;
    snow_aggregate_params_init(&params, sizeof params);
    snow_status status = snow_aggregate_particles(grid, &particles);
    REQUIRE(snow_aggregate_params_of(grid, &params) == status);
    (void)snow_aggregate_bounds(grid, &corners[0], &corners[1]);
    (void)snow_aggregate_order_at(grid, (snow_site){0, 0, 0}, &order);
    (void)snow_aggregate_gyration(grid, (const uint64_t[]){1}, &radius, 1);
}

void fuzz_ask(fuzz_input *input, const snow_grid *grid)
{
    ask_aggregate(grid);
    snow_reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    (void)snow_reiter_conditions_of(grid, &conditions);
    ask_packard(input, grid);
}
