#include "aggregates.h"

#include "chance.h"

#include <stdlib.h>

snow_aggregate_params aggregate_scene(snow_aggregate_scene scene)
{
    snow_aggregate_params params;
    snow_aggregate_params_init(&params, sizeof params);
    params.scene = scene;
    return params;
}

static const struct {
    snow_aggregate_scene scene;
    snow_aggregate_lattice lattice;
    snow_aggregate_contact contact;
    snow_aggregate_engine engine;
    double sticking;
    int32_t hits;
} kinds[] = {
    {SNOW_AGGREGATE_WITTEN_SANDER, SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 0, 1, 1},
    {SNOW_AGGREGATE_WITTEN_SANDER, SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ENTRY, 0, 1, 1},
    {SNOW_AGGREGATE_WITTEN_SANDER, SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 0, 0.3, 1},
    {SNOW_AGGREGATE_WITTEN_SANDER, SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 0, 1, 3},
    {SNOW_AGGREGATE_WITTEN_SANDER, SNOW_AGGREGATE_HEXAGONAL, SNOW_AGGREGATE_ARRIVAL, 0, 1, 1},
    {SNOW_AGGREGATE_WITTEN_SANDER, SNOW_AGGREGATE_CUBIC, SNOW_AGGREGATE_ENTRY, 0, 1, 1},
    {SNOW_AGGREGATE_WITTEN_SANDER, SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL,
     SNOW_AGGREGATE_ENGINE_STEPS, 1, 1},
    {SNOW_AGGREGATE_LABORATORY, SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 0, 1, 1},
    {SNOW_AGGREGATE_LINE, SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 0, 1, 1},
    {SNOW_AGGREGATE_LINE, SNOW_AGGREGATE_HEXAGONAL, SNOW_AGGREGATE_ENTRY, 0, 1, 1},
    {SNOW_AGGREGATE_LINE, SNOW_AGGREGATE_CUBIC, SNOW_AGGREGATE_ARRIVAL, 0, 1, 1},
    {SNOW_AGGREGATE_ELECTROLYSIS, SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 0, 0.5, 1},
    {SNOW_AGGREGATE_SHORE, SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 0, 1, 1},
    {SNOW_AGGREGATE_CHIMNEY, SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 0, 1, 1},
    {SNOW_AGGREGATE_SNOWFLAKE, SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 0, 1, 1},
    {SNOW_AGGREGATE_CLUSTER_CLUSTER, SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 0, 1, 1},
    {SNOW_AGGREGATE_OFF_LATTICE, SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 0, 1, 1},
};

const size_t aggregate_kind_count = COUNT_OF(kinds);

snow_aggregate_params aggregate_kind(size_t number)
{
    snow_aggregate_params params = aggregate_scene(kinds[number].scene);
    params.lattice = kinds[number].lattice;
    params.contact = kinds[number].contact;
    params.engine = kinds[number].engine;
    params.sticking = kinds[number].sticking;
    params.hits = kinds[number].hits;
    params.random_seed = 5;
    params.launch_radius = 40;
    params.end_radius = 30;
    params.width = 64;
    params.height = 64;
    params.depth = 16;
    params.wall_right = params.wall_right_top = 63;
    params.interaction = 3;
    params.particles = 400;
    return params;
}

snow_grid *make_aggregate(const snow_aggregate_params *params, const snow_options *options)
{
    snow_grid *grid = NULL;
    assert_ok(snow_aggregate_create(params, options, &grid));
    assert_non_null(grid);
    return grid;
}

snow_site *copy_sites(const snow_grid *grid, size_t *count)
{
    uint64_t particles = 0;
    assert_ok(snow_aggregate_particles(grid, &particles));
    *count = (size_t)particles;
    snow_site *sites = calloc(*count + 1, sizeof *sites);
    assert_non_null(sites);
    assert_ok(snow_aggregate_sites(grid, 0, sites, *count));
    return sites;
}

snow_aggregate_chance *solve_chances(const snow_grid *grid, size_t *count)
{
    assert_ok(snow_aggregate_growth(grid, NULL, 0, count));
    snow_aggregate_chance *chances = calloc(*count, sizeof *chances);
    assert_non_null(chances);
    assert_ok(snow_aggregate_growth(grid, chances, *count, count));
    return chances;
}

snow_aggregate_chance *sample_chances(const snow_grid *grid, uint64_t walks, uint64_t random_seed, size_t *count)
{
    const size_t most = 1 << 14;
    snow_aggregate_chance *chances = calloc(most, sizeof *chances);
    assert_non_null(chances);
    assert_ok(snow_aggregate_sample(grid, walks, random_seed, chances, most, count));
    return chances;
}

static bool is_same_site(snow_site a, snow_site b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

void count_hits(const snow_grid *grid, uint64_t walks, uint64_t random_seed, const snow_aggregate_chance *list,
                size_t count, double *hits)
{
    size_t there = 0;
    snow_aggregate_chance *sample = sample_chances(grid, walks, random_seed, &there);
    size_t next = 0; /* both are in one order */
    for (size_t i = 0; i < count; i++) {
        bool hit = next < there && is_same_site(sample[next].site, list[i].site);
        hits[i] = hit ? sample[next].probability * (double)walks : 0;
        next += hit;
    }
    assert_int_equal(there, next);
    free(sample);
}

#define PLANE(x, y) {(x), (y), 0}

/* Sites of one kind by the symmetry of cluster and lattice have one entry. */
const known_cluster known_clusters[] = {
    {"square site", SNOW_AGGREGATE_SQUARE, 1, {PLANE(0, 0)}, {{PLANE(1, 0), 1.0 / 4, 1.0 / 4}}},
    {"square dimer", SNOW_AGGREGATE_SQUARE, 2, {PLANE(0, 0), PLANE(1, 0)},
     {{PLANE(-1, 0), 0.2136562554558108, 0.1816901138162093}, {PLANE(0, 1), 0.1431718722720946, 0.1591549430918953}}},
    {"square I3", SNOW_AGGREGATE_SQUARE, 3, {PLANE(-1, 0), PLANE(0, 0), PLANE(1, 0)},
     {{PLANE(2, 0), 0.190488506967499, 0.148778391029867},
      {PLANE(1, 1), 0.1223529244174486, 0.1219603453344286},
      {PLANE(0, 1), 0.0648056441976037, 0.1073009183012758}}},
    {"square L3", SNOW_AGGREGATE_SQUARE, 3, {PLANE(0, 0), PLANE(1, 0), PLANE(0, 1)},
     {{PLANE(2, 0), 0.1897738472046154, 0.146954658691146},
      {PLANE(1, -1), 0.1325150637700694, 0.1349421103182582},
      {PLANE(0, -1), 0.1300154173942353, 0.133264448268935},
      {PLANE(1, 1), 0.09539134326215966, 0.1696775654433215}}},
    {"square 2x2", SNOW_AGGREGATE_SQUARE, 4, {PLANE(0, 0), PLANE(1, 0), PLANE(0, 1), PLANE(1, 1)},
     {{PLANE(2, 0), 1.0 / 8, 1.0 / 8}}},
    {"square plus", SNOW_AGGREGATE_SQUARE, 5, {PLANE(0, 0), PLANE(1, 0), PLANE(-1, 0), PLANE(0, 1), PLANE(0, -1)},
     {{PLANE(2, 0), 0.1641408928227162, 0.1133802276324187}, {PLANE(1, 1), 0.08585910717728382, 0.1366197723675813}}},
    {"hexagonal site", SNOW_AGGREGATE_HEXAGONAL, 1, {PLANE(0, 0)}, {{PLANE(1, 0), 1.0 / 6, 1.0 / 6}}},
    {"hexagonal dimer", SNOW_AGGREGATE_HEXAGONAL, 2, {PLANE(0, 0), PLANE(1, 0)},
     {{PLANE(2, 0), 0.1452190527099949, 0.1153377712448746},
      {PLANE(1, 1), 0.137899175930754, 0.1089977810442294},
      {PLANE(0, 1), 0.07898259542849706, 1.0 / 6}}},
    {"hexagonal I3", SNOW_AGGREGATE_HEXAGONAL, 3, {PLANE(-1, 0), PLANE(0, 0), PLANE(1, 0)},
     {{PLANE(2, 0), 0.130778442811982, 0.09309199173565607},
      {PLANE(1, 1), 0.1208888378286079, 0.08572478311031534},
      {PLANE(0, 1), 0.06372194076540106, 0.1177292210218566}}},
    {"hexagonal triangle", SNOW_AGGREGATE_HEXAGONAL, 3, {PLANE(0, 0), PLANE(1, 0), PLANE(0, 1)},
     {{PLANE(2, 0), 0.1293378415446453, 0.09400147930384709}, {PLANE(1, 1), 0.07465765024404278, 0.1453303747256391}}},
    {"hexagon of 7", SNOW_AGGREGATE_HEXAGONAL, 7,
     {PLANE(0, 0), PLANE(1, 0), PLANE(0, 1), PLANE(-1, 1), PLANE(-1, 0), PLANE(0, -1), PLANE(1, -1)},
     {{PLANE(2, 0), 0.1041147422691494, 0.06400887582308257}, {PLANE(1, 1), 0.06255192439751731, 0.1026577908435841}}},
    {"cubic site", SNOW_AGGREGATE_CUBIC, 1, {{0, 0, 0}}, {{{0, 0, 1}, 1.0 / 6, 1.0 / 6}}},
    {"cubic dimer", SNOW_AGGREGATE_CUBIC, 2, {{0, 0, 0}, {1, 0, 0}},
     {{{2, 0, 0}, 0.1244265083279, 0.1049208476581}, {{0, 1, 0}, 0.09389337291803, 0.09876978808546}}},
    {"cubic I3", SNOW_AGGREGATE_CUBIC, 3, {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}},
     {{{2, 0, 0}, 0.1014498348198, 0.07807562871197},
      {{1, 1, 0}, 0.0742424311013, 0.07169035080872},
      {{0, 0, 1}, 0.05079022038748, 0.06758148402658}}},
};
const size_t known_cluster_count = COUNT_OF(known_clusters);

snow_grid *make_known(const known_cluster *cluster, snow_aggregate_contact contact, snow_aggregate_engine engine)
{
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    params.lattice = cluster->lattice;
    params.contact = contact;
    params.engine = engine;
    params.seeds = cluster->sites;
    params.seed_count = cluster->size;
    return make_aggregate(&params, NULL);
}

snow_grid *grow_cluster(snow_aggregate_lattice lattice, snow_aggregate_contact contact,
                               snow_aggregate_engine engine, int64_t particles, double sticking)
{
    snow_aggregate_params params = aggregate_scene(SNOW_AGGREGATE_WITTEN_SANDER);
    params.lattice = lattice;
    params.random_seed = 7;
    snow_grid *first = make_aggregate(&params, NULL);
    assert_ok(snow_step(first, particles - 1));
    size_t count = 0;
    snow_site *sites = copy_sites(first, &count);
    snow_destroy(first);
    params.contact = contact;
    params.engine = engine;
    params.sticking = sticking;
    params.seeds = sites;
    params.seed_count = count;
    snow_grid *grid = make_aggregate(&params, NULL);
    free(sites);
    return grid;
}

/* Fails when the walks of an engine do not follow the solved chances. */
static void check_walks(const snow_grid *grid, uint64_t walks, uint64_t random_seed)
{
    size_t count = 0;
    snow_aggregate_chance *list = solve_chances(grid, &count);
    double *expected = calloc(count, sizeof *expected);
    double *hits = calloc(count, sizeof *hits);
    assert_true(expected != NULL && hits != NULL);
    for (size_t i = 0; i < count; i++)
        expected[i] = list[i].probability * (double)walks;
    count_hits(grid, walks, random_seed, list, count, hits);
    assert_counts(expected, hits, count);
    free(hits);
    free(expected);
    free(list);
}

static void check_known(const known_cluster *cluster, snow_aggregate_contact contact, snow_aggregate_engine engine,
                        uint64_t walks)
{
    snow_grid *grid = make_known(cluster, contact, engine);
    check_walks(grid, walks, 1000);
    snow_destroy(grid);
}

static uint64_t walks_on(snow_aggregate_lattice lattice, uint64_t plane, uint64_t space)
{
    return lattice == SNOW_AGGREGATE_CUBIC ? space : plane;
}

void check_known_clusters(snow_aggregate_engine engine, uint64_t plane, uint64_t space)
{
    for (size_t i = 0; i < known_cluster_count; i++) {
        uint64_t walks = walks_on(known_clusters[i].lattice, plane, space);
        check_known(&known_clusters[i], SNOW_AGGREGATE_ARRIVAL, engine, walks);
        check_known(&known_clusters[i], SNOW_AGGREGATE_ENTRY, engine, walks);
    }
}

void check_grown_cluster(snow_aggregate_engine engine, uint64_t plane, uint64_t space)
{
    static const snow_aggregate_lattice lattices[] = {SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_HEXAGONAL,
                                                      SNOW_AGGREGATE_CUBIC};
    for (size_t i = 0; i < COUNT_OF(lattices); i++) {
        for (int entry = 0; entry < 2; entry++) {
            snow_grid *grid = grow_cluster(lattices[i], entry ? SNOW_AGGREGATE_ENTRY : SNOW_AGGREGATE_ARRIVAL, engine,
                                           300, 1);
            check_walks(grid, walks_on(lattices[i], plane, space), 11);
            snow_destroy(grid);
        }
    }
}
