/*
 * A program of the first release: it knows no header of today. The structs, numbers and functions below are those of
 * version 0.1.0, copied once and never to be changed; a later library must serve it without its being compiled again.
 * It also loads the crystals that the first release saved.
 *
 *     first_release FOLDER            runs; FOLDER holds the saved crystals
 *     first_release --save FOLDER     writes them: only before a release, or for a new model
 */
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- the first release's contract, frozen --- */

typedef struct grid grid;

typedef struct cell {
    int32_t q, r;
} cell;

typedef struct rect {
    int32_t q, r, width, height;
} rect;

typedef struct hexagon {
    int64_t least_q, greatest_q, least_r, greatest_r, least_s, greatest_s;
} hexagon;

typedef struct options {
    size_t struct_size;
    void *(*allocate)(void *, size_t);
    void (*release)(void *, void *);
    void *allocator_context;
    uint64_t memory_limit;
    int32_t threads;
    int isa;
    void (*parallel_for)(void *, size_t, void (*)(void *, size_t), void *);
    void *parallel_context;
} options;

typedef struct summary {
    size_t struct_size;
    int reason;
    int64_t steps;
    uint64_t frozen;
    double tip_radius;
    double seconds;
} summary;

typedef struct stop {
    size_t struct_size;
    int64_t max_steps;
    int32_t rim;
    int32_t still;
    double tip_radius;
    uint64_t frozen;
    double seconds;
    int (*progress)(void *, const grid *, const summary *);
    void *progress_context;
    int64_t progress_steps;
    int64_t height;
} stop;

typedef struct reiter_params {
    size_t struct_size;
    double background;
    double addition;
    double diffusion;
    int domain;
    int32_t radius;
    int32_t width;
    int32_t height;
    int rim;
    const cell *seeds;
    size_t seed_count;
    int32_t cluster;
    int32_t noise_symmetric;
    double noise;
    uint64_t random_seed;
    double (*background_at)(void *, int32_t, int32_t);
    double (*addition_at)(void *, int32_t, int32_t);
    void *field_context;
    int32_t record_freeze_steps;
    int32_t allow_unstable;
    int engine;
    int symmetry;
    int precision;
    double tolerance;
} reiter_params;

typedef struct reiter_conditions {
    size_t struct_size;
    double background;
    double addition;
    double diffusion;
    int32_t rescale;
} reiter_conditions;

typedef struct packard_params {
    size_t struct_size;
    uint32_t rule;
    int domain;
    int32_t radius;
    int32_t width;
    int32_t height;
    const cell *seeds;
    size_t seed_count;
    int32_t cluster;
    int32_t scatter;
    int32_t scatter_side;
    uint64_t random_seed;
    int32_t record_freeze_steps;
    int engine;
} packard_params;

typedef struct packard_zone {
    size_t struct_size;
    int kind;
    int shape;
    int64_t first_step;
    int64_t last_step;
    cell centre;
    double half_width;
    double half_angle;
    int32_t inner;
    int32_t outer;
    int32_t inverted;
    rect rect;
    const uint8_t *mask;
    int (*contains)(void *, int32_t, int32_t);
    void *contains_context;
} packard_zone;

typedef struct site {
    int32_t x, y, z;
} site;

typedef struct aggregate_params {
    size_t struct_size;
    int scene;
    int lattice;
    int contact;
    int engine;
    uint64_t random_seed;
    double sticking;
    int32_t hits;
    int32_t record_order;
    const site *seeds;
    size_t seed_count;
    const site *obstacles;
    size_t obstacle_count;
    double kill_radius;
    int32_t launch_radius;
    int32_t end_radius;
    int32_t width;
    int32_t height;
    int32_t depth;
    int32_t periodic;
    int32_t launch_first;
    int32_t launch_last;
    int32_t cathode_first;
    int32_t cathode_last;
    double interaction;
    int32_t hardness_least;
    int32_t hardness_greatest;
    int32_t wall_left;
    int32_t wall_left_top;
    int32_t wall_right;
    int32_t wall_right_top;
    uint64_t particles;
    double density;
    double mobility;
} aggregate_params;

typedef struct view {
    size_t struct_size;
    int32_t width;
    int32_t height;
    double scale;
    double centre_x;
    double centre_y;
    int palette;
    int pixel;
    int32_t samples;
    int32_t transparent;
} view;

enum {
    OK = 0,
    ERROR_STRUCT_SIZE = 101,
    ERROR_TRUNCATED = 302,
    STOP_STEPS = 1,
    STOP_RIM = 2,
    FIELD_FROZEN = 3,
    FIELD_FREEZE_STEP = 6,
    REITER_HEXAGON = 2,
    REITER_SINGLE = 1,
    PACKARD_TORUS = 6,
    PACKARD_TILES = 2,
    PACKARD_QUADTREE = 3,
    PACKARD_RESTRICTION = 1,
    PACKARD_SIDES = 2,
    AGGREGATE_WITTEN_SANDER = 1,
    AGGREGATE_SHORE = 5,
    AGGREGATE_CLUSTER_CLUSTER = 8,
    AGGREGATE_OFF_LATTICE = 9,
    AGGREGATE_SQUARE = 1,
    AGGREGATE_HEXAGONAL = 2,
    AGGREGATE_CUBIC = 3,
    AGGREGATE_ARRIVAL = 1,
    AGGREGATE_ENTRY = 2,
    AGGREGATE_STEPS = 2,
    PALETTE_AGE = 4,
    PIXEL_GREY = 1
};

void snow_options_init(options *, size_t);
void snow_stop_init(stop *, size_t);
void snow_summary_init(summary *, size_t);
void snow_view_init(view *, size_t);
void snow_reiter_params_init(reiter_params *, size_t);
void snow_reiter_conditions_init(reiter_conditions *, size_t);
void snow_packard_params_init(packard_params *, size_t);
void snow_packard_zone_init(packard_zone *, size_t, int, int);
int snow_reiter_create(const reiter_params *, const options *, grid **);
int snow_reiter_change(grid *, const reiter_conditions *);
int snow_packard_create(const packard_params *, const options *, grid **);
int snow_packard_add_zone(grid *, const packard_zone *);
void snow_aggregate_params_init(aggregate_params *, size_t);
int snow_aggregate_create(const aggregate_params *, const options *, grid **);
int snow_aggregate_particles(const grid *, uint64_t *);
int snow_aggregate_sites(const grid *, uint64_t, site *, size_t);
int snow_step(grid *, int64_t);
int snow_run(grid *, const stop *, summary *);
void snow_destroy(grid *);
int snow_steps(const grid *, int64_t *);
int snow_frozen(const grid *, uint64_t *);
int snow_frozen_hexagon(const grid *, hexagon *);
int snow_cell_value(const grid *, int, int32_t, int32_t, double *);
int snow_field_copy(const grid *, int, const rect *, double *, size_t, size_t *);
int snow_digest(const grid *, uint64_t *);
int snow_save(const grid *, void *, size_t, size_t *);
int snow_load(const void *, size_t, const options *, grid **);
int snow_view_fit(const grid *, int32_t, view *);
int snow_render(const grid *, const view *, void *, size_t, size_t *);
const char *snow_strerror(int);

/* --- the program --- */

static int failures;

static void check(int holds, const char *text, int line)
{
    if (holds)
        return;
    printf("line %d: %s\n", line, text);
    failures++;
}
#define CHECK(condition) check(condition, #condition, __LINE__)

static void *count_and_allocate(void *context, size_t size)
{
    ++*(int *)context;
    return malloc(size);
}

static void count_and_release(void *context, void *block)
{
    --*(int *)context;
    free(block);
}

static options counting_options(int *blocks)
{
    options with;
    memset(&with, 0xA7, sizeof with);
    snow_options_init(&with, sizeof with);
    CHECK(with.struct_size == sizeof with && with.threads == 1 && with.isa == 0 && with.allocate == NULL);
    with.allocate = count_and_allocate;
    with.release = count_and_release;
    with.allocator_context = blocks;
    with.threads = 2;
    return with;
}

static uint64_t digest_of(const grid *crystal)
{
    uint64_t digest = 0;
    CHECK(snow_digest(crystal, &digest) == OK);
    return digest;
}

static void draw(const grid *crystal)
{
    unsigned char pixels[32 * 32];
    size_t size = 0;
    view seen;
    snow_view_init(&seen, sizeof seen);
    CHECK(seen.width == 512 && seen.samples == 2 && seen.transparent == 0);
    CHECK(snow_view_fit(crystal, 32, &seen) == OK && seen.width <= 32 && seen.height <= 32);
    seen.palette = PALETTE_AGE;
    seen.pixel = PIXEL_GREY;
    CHECK(snow_render(crystal, &seen, pixels, sizeof pixels, &size) == OK);
    CHECK(size == (size_t)seen.width * (size_t)seen.height);
}

static int see_progress(void *context, const grid *crystal, const summary *so_far)
{
    int64_t steps = -1;
    CHECK(snow_steps(crystal, &steps) == OK && steps == so_far->steps && so_far->struct_size == sizeof *so_far);
    ++*(int *)context;
    return 0;
}

/* The paper's first crystal in a small disc: its steps and cells are known. */
static void grow_reiter(const options *with)
{
    reiter_params params;
    snow_reiter_params_init(&params, sizeof params);
    CHECK(params.struct_size == sizeof params && params.radius == 200 && params.tolerance == 0);
    params.radius = 100;
    params.record_freeze_steps = 1;
    grid *crystal = NULL;
    CHECK(snow_reiter_create(&params, with, &crystal) == OK);
    stop end;
    int calls = 0;
    snow_stop_init(&end, sizeof end);
    CHECK(end.max_steps == 10000 && end.rim == 1 && end.still == 1 && end.progress_steps == 100);
    end.progress = see_progress;
    end.progress_context = &calls;
    summary result;
    snow_summary_init(&result, sizeof result);
    CHECK(snow_run(crystal, &end, &result) == OK);
    CHECK(result.reason == STOP_RIM && result.steps == 2011 && result.frozen == 7975 && calls == 20);
    double value = -1;
    CHECK(snow_cell_value(crystal, FIELD_FREEZE_STEP, 0, 0, &value) == OK && value == 0);
    draw(crystal);
    reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    CHECK(conditions.rescale == 1 && conditions.background == 0.4);
    conditions.background = 0.3;
    CHECK(snow_reiter_change(crystal, &conditions) == OK);
    snow_destroy(crystal);
}

static void grow_packard(const options *with)
{
    packard_params params;
    snow_packard_params_init(&params, sizeof params);
    CHECK(params.rule == 0x2A && params.radius == 200 && params.scatter_side == 400);
    grid *crystal = NULL;
    CHECK(snow_packard_create(&params, with, &crystal) == OK);
    packard_zone zone;
    snow_packard_zone_init(&zone, sizeof zone, PACKARD_RESTRICTION, PACKARD_SIDES);
    CHECK(zone.first_step == 1 && zone.last_step == INT64_MAX && zone.outer == INT32_MAX);
    zone.last_step = 8;
    CHECK(snow_packard_add_zone(crystal, &zone) == OK);
    CHECK(snow_step(crystal, 15) == OK);
    uint64_t frozen = 0;
    hexagon bounds;
    rect row = {-1, 0, 3, 1};
    double values[3] = {-1, -1, -1};
    CHECK(snow_frozen(crystal, &frozen) == OK && frozen == 595);
    CHECK(snow_frozen_hexagon(crystal, &bounds) == OK && bounds.greatest_q == 15 && bounds.least_s == -15);
    CHECK(snow_field_copy(crystal, FIELD_FROZEN, &row, values, 3, NULL) == OK && values[0] == 1 && values[2] == 1);
    snow_destroy(crystal);
}

static void grow_aggregate(const options *with)
{
    aggregate_params params;
    snow_aggregate_params_init(&params, sizeof params);
    CHECK(params.scene == AGGREGATE_WITTEN_SANDER && params.lattice == AGGREGATE_SQUARE && params.hits == 1);
    CHECK(params.contact == AGGREGATE_ARRIVAL && params.sticking == 1 && params.launch_first == INT32_MIN);
    CHECK(params.hardness_greatest == 3 && params.wall_right_top == 255 && params.density == 0.05);
    params.record_order = 1;
    grid *cluster = NULL;
    CHECK(snow_aggregate_create(&params, with, &cluster) == OK);
    CHECK(snow_step(cluster, 40) == OK);
    uint64_t particles = 0;
    site first = {7, 7, 7};
    double step = -1;
    CHECK(snow_aggregate_particles(cluster, &particles) == OK && particles == 41);
    CHECK(snow_aggregate_sites(cluster, 0, &first, 1) == OK && first.x == 0 && first.y == 0 && first.z == 0);
    CHECK(snow_aggregate_sites(cluster, 40, &first, 1) == OK);
    CHECK(snow_cell_value(cluster, FIELD_FREEZE_STEP, first.x, first.y, &step) == OK && step == 40);
    snow_destroy(cluster);
}

/* A program of a later release, on this library: its structs are longer. Their new members are 0 unless it sets them. */
static void hand_over_longer_structs(void)
{
    struct {
        packard_params known;
        uint64_t later;
    } newer;
    grid *crystal = NULL;
    memset(&newer, 0xA7, sizeof newer);
    snow_packard_params_init(&newer.known, sizeof newer);
    CHECK(newer.known.struct_size == sizeof newer);
    CHECK(snow_packard_create(&newer.known, NULL, &crystal) == OK);
    snow_destroy(crystal);
    crystal = NULL;
    newer.known.struct_size = offsetof(packard_params, engine); /* no release had that */
    CHECK(snow_packard_create(&newer.known, NULL, &crystal) == ERROR_STRUCT_SIZE);
    CHECK(crystal == NULL);
}

/* --- saved crystals --- */

typedef struct saved {
    const char *name;
    grid *(*grow)(void);
    uint64_t digest;
    uint64_t later; /* ten steps on */
} saved;

static grid *grown(int status, grid *crystal, int64_t steps)
{
    CHECK(status == OK && snow_step(crystal, steps) == OK);
    return crystal;
}

static grid *grow_rows(void)
{
    reiter_params params;
    grid *crystal = NULL;
    snow_reiter_params_init(&params, sizeof params);
    params.radius = 7;
    params.addition = 0.01;
    params.record_freeze_steps = 1;
    int status = snow_reiter_create(&params, NULL, &crystal);
    return grown(status, crystal, 30);
}

static grid *grow_single(void)
{
    static const cell seeds[2] = {{0, 0}, {2, 1}};
    reiter_params params;
    grid *crystal = NULL;
    snow_reiter_params_init(&params, sizeof params);
    params.domain = REITER_HEXAGON;
    params.radius = 6;
    params.precision = REITER_SINGLE;
    params.seeds = seeds;
    params.seed_count = 2;
    int status = snow_reiter_create(&params, NULL, &crystal);
    return grown(status, crystal, 30);
}

static grid *grow_zoned(void)
{
    packard_params params;
    packard_zone zone;
    grid *crystal = NULL;
    snow_packard_params_init(&params, sizeof params);
    params.engine = PACKARD_TILES;
    int status = snow_packard_create(&params, NULL, &crystal);
    snow_packard_zone_init(&zone, sizeof zone, PACKARD_RESTRICTION, PACKARD_SIDES);
    zone.half_angle = 10;
    zone.first_step = 4;
    CHECK(snow_packard_add_zone(crystal, &zone) == OK);
    return grown(status, crystal, 20);
}

static grid *grow_tree(void)
{
    packard_params params;
    grid *crystal = NULL;
    snow_packard_params_init(&params, sizeof params);
    params.engine = PACKARD_QUADTREE;
    int status = snow_packard_create(&params, NULL, &crystal);
    return grown(status, crystal, 300);
}

static grid *grow_torus(void)
{
    packard_params params;
    grid *crystal = NULL;
    snow_packard_params_init(&params, sizeof params);
    params.domain = PACKARD_TORUS;
    params.width = 13;
    params.height = 11;
    params.cluster = 5;
    params.record_freeze_steps = 1;
    int status = snow_packard_create(&params, NULL, &crystal);
    return grown(status, crystal, 5);
}

static grid *grow_scene(int scene, int lattice, int contact, int engine)
{
    aggregate_params params;
    grid *cluster = NULL;
    snow_aggregate_params_init(&params, sizeof params);
    params.scene = scene;
    params.lattice = lattice;
    params.contact = contact;
    params.engine = engine;
    params.random_seed = 11;
    params.width = 24;
    params.height = 30;
    params.particles = 90;
    int status = snow_aggregate_create(&params, NULL, &cluster);
    return grown(status, cluster, 60);
}

static grid *grow_jumps(void)
{
    return grow_scene(AGGREGATE_WITTEN_SANDER, AGGREGATE_HEXAGONAL, AGGREGATE_ENTRY, 0);
}

static grid *grow_space(void)
{
    return grow_scene(AGGREGATE_WITTEN_SANDER, AGGREGATE_CUBIC, AGGREGATE_ARRIVAL, 0);
}

static grid *grow_steps(void)
{
    return grow_scene(AGGREGATE_WITTEN_SANDER, AGGREGATE_SQUARE, AGGREGATE_ARRIVAL, AGGREGATE_STEPS);
}

static grid *grow_shore(void)
{
    return grow_scene(AGGREGATE_SHORE, AGGREGATE_SQUARE, AGGREGATE_ARRIVAL, 0);
}

static grid *grow_drifting(void)
{
    return grow_scene(AGGREGATE_CLUSTER_CLUSTER, AGGREGATE_SQUARE, AGGREGATE_ARRIVAL, 0);
}

static grid *grow_discs(void)
{
    return grow_scene(AGGREGATE_OFF_LATTICE, AGGREGATE_SQUARE, AGGREGATE_ARRIVAL, 0);
}

static const saved crystals[] = {
    {"reiter", grow_rows, UINT64_C(0xcb25e56995a05bea), UINT64_C(0x6e94abca1b229d71)},
    {"reiter-single", grow_single, UINT64_C(0x5419ffbcea1dc69c), UINT64_C(0x65d17c1d5f2c16af)},
    {"packard-zone", grow_zoned, UINT64_C(0xd379b73b0f14dbf2), UINT64_C(0xfb772cf894169279)},
    {"packard-quadtree", grow_tree, UINT64_C(0xf5beaa223feaf2ab), UINT64_C(0x979fbb0e815621d0)},
    {"packard-torus", grow_torus, UINT64_C(0x119da0ca84bdafae), UINT64_C(0x3a0951240c74e0d5)},
    {"aggregate-jumps", grow_jumps, UINT64_C(0x8b3bcaaacca64495), UINT64_C(0x57fb50214a367e1f)},
    {"aggregate-space", grow_space, UINT64_C(0xa4999cb3791c2c6c), UINT64_C(0x5584eb508e4a7eac)},
    {"aggregate-steps", grow_steps, UINT64_C(0x825265e0dbf711d4), UINT64_C(0x3d36b9b21aa219aa)},
    {"aggregate-shore", grow_shore, UINT64_C(0x37f96f66901b4ced), UINT64_C(0xd6d78872b83ce73f)},
    {"aggregate-drifting", grow_drifting, UINT64_C(0x1604d54a4f9beff3), UINT64_C(0xa11aaa4ef22a9c9e)},
    {"aggregate-discs", grow_discs, UINT64_C(0x9cc74efbc0aac1b6), UINT64_C(0x45c91de432a3cb7a)},
};
enum { CRYSTALS = sizeof crystals / sizeof crystals[0], MOST_BYTES = 1 << 18 };

static unsigned char bytes[MOST_BYTES];

static FILE *open_crystal(const char *folder, const saved *crystal, const char *mode)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s.snow", folder, crystal->name);
    FILE *file = fopen(path, mode);
    if (file == NULL)
        perror(path);
    return file;
}

static void save_crystal(const char *folder, const saved *crystal)
{
    grid *grown_now = crystal->grow();
    size_t size = 0;
    CHECK(snow_save(grown_now, bytes, sizeof bytes, &size) == OK);
    FILE *file = open_crystal(folder, crystal, "wb");
    CHECK(file != NULL && fwrite(bytes, 1, size, file) == size && fclose(file) == 0);
    uint64_t digest = digest_of(grown_now);
    CHECK(snow_step(grown_now, 10) == OK);
    printf("%s: 0x%016llx, 0x%016llx\n", crystal->name, (unsigned long long)digest,
           (unsigned long long)digest_of(grown_now));
    snow_destroy(grown_now);
}

/* Loaded, it is the same crystal, and grows on to the same one. */
static void load_crystal(const char *folder, const saved *crystal)
{
    FILE *file = open_crystal(folder, crystal, "rb");
    CHECK(file != NULL);
    if (file == NULL)
        return;
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    grid *loaded = NULL;
    int status = snow_load(bytes, size, NULL, &loaded);
    if (status != OK)
        printf("%s: %s\n", crystal->name, snow_strerror(status));
    CHECK(status == OK);
    if (status != OK)
        return;
    CHECK(digest_of(loaded) == crystal->digest);
    CHECK(snow_step(loaded, 10) == OK);
    CHECK(digest_of(loaded) == crystal->later);
    snow_destroy(loaded);
    CHECK(snow_load(bytes, size / 2, NULL, &loaded) == ERROR_TRUNCATED);
}

int main(int argc, char **argv)
{
    if (argc == 3 && strcmp(argv[1], "--save") == 0) {
        for (int i = 0; i < CRYSTALS; i++)
            save_crystal(argv[2], &crystals[i]);
        return failures != 0;
    }
    if (argc != 2) {
        fprintf(stderr, "usage: first_release [--save] FOLDER\n");
        return 2;
    }
    int blocks = 0;
    options with = counting_options(&blocks);
    grow_reiter(&with);
    grow_packard(&with);
    grow_aggregate(&with);
    CHECK(blocks == 0);
    hand_over_longer_structs();
    for (int i = 0; i < CRYSTALS; i++)
        load_crystal(argv[1], &crystals[i]);
    printf("%d failures\n", failures);
    return failures != 0;
}
