/*
 * snowgrowth-aggregation: run time against error of hit probabilities, and growth of large clusters. README.md tells
 * how to read the figures.
 */
#include "aggregate/growth.h"
#include "arguments.h"
#include "csv.h"
#include "timing.h"
#include "walks.h"

#include <errno.h>
#include <getopt.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

const char *const program_name = "snowgrowth-aggregation";

static const char csv_columns[] = "part,way,lattice,particles,walks,seconds,microseconds_a_particle,bias,bias_seen,"
                                  "bytes_a_particle,jumps_a_particle,threads";

typedef struct plan {
    bool law;
    bool growth;
    bool scenes;
    int64_t cluster; /* particles of the fixed cluster */
    double seconds;  /* for each way of walking */
    int64_t most;    /* particles of the largest growth */
    int32_t threads;
    FILE *csv;
} plan;

static void require(snow_status status, const char *what)
{
    if (status == SNOW_OK)
        return;
    fprintf(stderr, "%s: %s: %s\n", program_name, what, snow_strerror(status));
    exit(1);
}

static void *get(size_t count, size_t size)
{
    void *memory = calloc(count, size);
    if (memory == NULL)
        require(SNOW_ERROR_NO_MEMORY, "figures");
    return memory;
}

/* Time of this process, which neighbours on the machine disturb less. */
static double processor_seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

static snow_grid *make(snow_aggregate_lattice lattice, snow_aggregate_engine engine, const snow_site *seeds,
                       size_t count, int32_t threads)
{
    snow_aggregate_params params;
    snow_aggregate_params_init(&params, sizeof params);
    params.lattice = lattice;
    params.engine = engine;
    params.seeds = seeds;
    params.seed_count = count;
    snow_options options;
    snow_options_init(&options, sizeof options);
    options.threads = threads;
    snow_grid *grid = NULL;
    require(snow_aggregate_create(&params, &options, &grid), "a cluster");
    return grid;
}

static snow_site *sites_of(const snow_grid *grid, size_t *count)
{
    uint64_t particles = 0;
    require(snow_aggregate_particles(grid, &particles), "particles");
    *count = (size_t)particles;
    snow_site *sites = get(*count, sizeof *sites);
    require(snow_aggregate_sites(grid, 0, sites, *count), "sites");
    return sites;
}

/* The law: one cluster, its exact chances, and walks in many ways. */

typedef struct law {
    snow_site *sites;
    size_t count;
    snow_aggregate_chance *chances;
    size_t ends;
    double *hits;
    walks *own;
} law;

static law start_law(int64_t particles)
{
    law self = {0};
    snow_grid *grid = make(SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ENGINE_AUTO, NULL, 0, 1);
    require(snow_step(grid, particles - 1), "growing");
    self.sites = sites_of(grid, &self.count);
    require(snow_aggregate_growth(grid, NULL, 0, &self.ends), "exact chances");
    self.chances = get(self.ends, sizeof *self.chances);
    self.hits = get(self.ends, sizeof *self.hits);
    require(snow_aggregate_growth(grid, self.chances, self.ends, &self.ends), "exact chances");
    snow_destroy(grid);
    self.own = walks_start(self.sites, self.count);
    if (self.own == NULL)
        require(SNOW_ERROR_NO_MEMORY, "walks");
    return self;
}

static void end_law(law *self)
{
    walks_end(self->own);
    free(self->hits);
    free(self->chances);
    free(self->sites);
}

static void count_hit(law *self, snow_site site, double hits)
{
    size_t low = 0;
    size_t high = self->ends;
    while (low < high) {
        size_t middle = (low + high) / 2;
        snow_site there = self->chances[middle].site;
        if (there.y < site.y || (there.y == site.y && there.x < site.x))
            low = middle + 1;
        else
            high = middle;
    }
    if (low == self->ends || self->chances[low].site.x != site.x || self->chances[low].site.y != site.y)
        require(SNOW_ERROR_OUTSIDE, "a walk ended away from the cluster");
    self->hits[low] += hits;
}

static void sample(law *self, const snow_grid *grid, uint64_t number, uint64_t count)
{
    static snow_aggregate_chance found[1 << 14];
    size_t there = 0;
    require(snow_aggregate_sample(grid, count, number, found, sizeof found / sizeof found[0], &there), "walks");
    for (size_t i = 0; i < there; i++)
        count_hit(self, found[i].site, found[i].probability * (double)count);
}

/* Root mean square of the relative error, each site weighted by its chance, less what chance alone brings; and what
   would have been seen at two standard errors. Sites that are hardly ever hit are left out. */
static double find_bias(const law *self, double walked, double *seen)
{
    const double least = 10;
    double sum = 0;
    double degrees = 0;
    for (size_t i = 0; i < self->ends; i++) {
        double expected = self->chances[i].probability * walked;
        if (expected < least)
            continue;
        sum += (self->hits[i] - expected) * (self->hits[i] - expected) / expected;
        degrees++;
    }
    *seen = sqrt(2 * sqrt(2 * degrees) / walked);
    return sum > degrees ? sqrt((sum - degrees) / walked) : 0;
}

typedef struct way {
    const char *name;
    double kill;                  /* own single steps; 0: own jumps */
    snow_aggregate_engine engine; /* AUTO: not the library */
} way;

static const way ways[] = {
    {"steps, kill 1.5 R", 1.5, SNOW_AGGREGATE_ENGINE_AUTO},
    {"steps, kill 2 R", 2, SNOW_AGGREGATE_ENGINE_AUTO},
    {"steps, kill 3 R", 3, SNOW_AGGREGATE_ENGINE_AUTO},
    {"steps, kill 10 R", 10, SNOW_AGGREGATE_ENGINE_AUTO},
    {"continuum jumps", 0, SNOW_AGGREGATE_ENGINE_AUTO},
    {"steps, exact return", 0, SNOW_AGGREGATE_ENGINE_STEPS},
    {"exact jumps", 0, SNOW_AGGREGATE_ENGINE_JUMPS},
};

static void run_way(const plan *work, law *self, const way *one)
{
    enum { BATCH = 1000, LONG_BATCH = 1000000 };
    snow_grid *grid = NULL;
    if (one->engine != SNOW_AGGREGATE_ENGINE_AUTO)
        grid = make(SNOW_AGGREGATE_SQUARE, one->engine, self->sites, self->count, 1);
    memset(self->hits, 0, self->ends * sizeof *self->hits);
    uint64_t walked = 0;
    double seconds = 0;
    for (uint64_t number = 0; seconds < work->seconds; number++) {
        uint64_t batch = number < 2 ? BATCH : walked / 4 + BATCH;
        batch = batch < LONG_BATCH ? batch : LONG_BATCH;
        double start = processor_seconds();
        if (grid != NULL)
            sample(self, grid, number, batch);
        for (uint64_t i = 0; grid == NULL && i < batch; i++)
            count_hit(self, one->kill > 0 ? walks_step(self->own, one->kill) : walks_jump(self->own), 1);
        seconds += processor_seconds() - start;
        walked += batch;
    }
    snow_destroy(grid);
    double seen;
    double bias = find_bias(self, (double)walked, &seen);
    double each = 1e6 * seconds / (double)walked;
    printf("%-22s %12" PRIu64 " walks %10.3f us each   bias %.5f (seen from %.5f on)\n", one->name, walked, each, bias,
           seen);
    fflush(stdout);
    if (work->csv != NULL)
        fprintf(work->csv, "law,\"%s\",square,%zu,%" PRIu64 ",%.3f,%.4f,%.6f,%.6f,,,1\n", one->name, self->count,
                walked, seconds, each, bias, seen);
}

static void measure_law(const plan *work)
{
    law self = start_law(work->cluster);
    printf("hit probabilities of a square cluster of %zu particles, %zu sites to end on\n", self.count, self.ends);
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++)
        run_way(work, &self, &ways[i]);
    end_law(&self);
}

/* Growth. */

static double count_jumps(snow_aggregate_lattice lattice, const snow_grid *grid)
{
    enum { PROBES = 5000 };
    size_t count = 0;
    snow_site *sites = sites_of(grid, &count);
    snow_options options;
    snow_options_init(&options, sizeof options);
    snow_heap heap;
    snow_heap_start(&heap, &options);
    const snow_growth_rules rules = {.lattice = lattice, .contact = SNOW_AGGREGATE_ARRIVAL, .stick = 1, .lid = -1,
                                     .isa = SNOW_ISA_BASELINE};
    snow_growth *growth = NULL;
    require(snow_growth_start(&growth, &heap, &rules), "jumps");
    require(snow_growth_fill(growth, &heap, sites, count), "jumps");
    double jumps = 0;
    for (uint64_t walker = 0; walker < PROBES; walker++)
        jumps += (double)snow_growth_probe_jumps(growth, 1, walker);
    snow_growth_end(growth, &heap);
    free(sites);
    return jumps / PROBES;
}

static void grow(const plan *work, snow_aggregate_lattice lattice, const char *name)
{
    snow_grid *grid = make(lattice, SNOW_AGGREGATE_ENGINE_JUMPS, NULL, 0, work->threads);
    double seconds = 0;
    int64_t grown = 1;
    for (int64_t particles = 10000; particles <= work->most; particles *= 10) {
        double start = timing_now();
        require(snow_step(grid, particles - grown), "growing");
        seconds += timing_now() - start;
        grown = particles;
        uint64_t bytes = 0;
        require(snow_memory(grid, &bytes), "memory");
        double jumps = count_jumps(lattice, grid);
        double each = 1e6 * seconds / (double)particles;
        printf("%-10s %10" PRId64 " particles %9.2f s %8.3f us each %7.2f bytes each %7.1f jumps each at the end\n",
               name, particles, seconds, each, (double)bytes / (double)particles, jumps);
        fflush(stdout);
        if (work->csv != NULL)
            fprintf(work->csv, "growth,\"exact jumps\",%s,%" PRId64 ",,%.3f,%.4f,,,%.2f,%.1f,%d\n", name, particles,
                    seconds, each, (double)bytes / (double)particles, jumps, (int)work->threads);
    }
    snow_destroy(grid);
}

/* The other scenes. */

typedef struct scene_run {
    const char *name;
    snow_aggregate_scene scene;
    snow_aggregate_lattice lattice;
    int64_t particles; /* 0: to the end */
    double interaction;
} scene_run;

static const scene_run scene_runs[] = {
    {"electrolysis, 4096 columns, radius 0", SNOW_AGGREGATE_ELECTROLYSIS, SNOW_AGGREGATE_SQUARE, 1000000, 0},
    {"electrolysis, 4096 columns, radius 3", SNOW_AGGREGATE_ELECTROLYSIS, SNOW_AGGREGATE_SQUARE, 1000000, 3},
    {"electrolysis, 4096 columns, radius 10", SNOW_AGGREGATE_ELECTROLYSIS, SNOW_AGGREGATE_SQUARE, 1000000, 10},
    {"electrolysis, 4096 columns, radius 30", SNOW_AGGREGATE_ELECTROLYSIS, SNOW_AGGREGATE_SQUARE, 1000000, 30},
    {"cluster-cluster, density 0.05", SNOW_AGGREGATE_CLUSTER_CLUSTER, SNOW_AGGREGATE_SQUARE, 10000, 0},
    {"cluster-cluster, density 0.05", SNOW_AGGREGATE_CLUSTER_CLUSTER, SNOW_AGGREGATE_SQUARE, 100000, 0},
    {"cluster-cluster, density 0.05", SNOW_AGGREGATE_CLUSTER_CLUSTER, SNOW_AGGREGATE_CUBIC, 100000, 0},
    {"off the lattice", SNOW_AGGREGATE_OFF_LATTICE, SNOW_AGGREGATE_SQUARE, 10000, 0},
    {"off the lattice", SNOW_AGGREGATE_OFF_LATTICE, SNOW_AGGREGATE_SQUARE, 100000, 0},
    {"laboratory, R0 = 120, R = 100", SNOW_AGGREGATE_LABORATORY, SNOW_AGGREGATE_SQUARE, 0, 0},
    {"laboratory, R0 = 1200, R = 1000", SNOW_AGGREGATE_LABORATORY, SNOW_AGGREGATE_SQUARE, 0, 0},
};

static snow_aggregate_params params_of(const scene_run *run)
{
    snow_aggregate_params params;
    snow_aggregate_params_init(&params, sizeof params);
    params.scene = run->scene;
    params.lattice = run->lattice;
    params.interaction = run->interaction;
    if (run->scene == SNOW_AGGREGATE_CLUSTER_CLUSTER)
        params.particles = (uint64_t)run->particles;
    if (run->scene == SNOW_AGGREGATE_ELECTROLYSIS) {
        params.width = 4096;
        params.height = 20000;
    }
    if (run->scene == SNOW_AGGREGATE_LABORATORY) {
        params.launch_radius = strstr(run->name, "1200") != NULL ? 1200 : 120;
        params.end_radius = params.launch_radius / 12 * 10;
    }
    return params;
}

static void run_scene(const plan *work, const scene_run *run)
{
    snow_aggregate_params params = params_of(run);
    snow_grid *grid = NULL;
    double start = processor_seconds();
    require(snow_aggregate_create(&params, NULL, &grid), run->name);
    snow_stop stop;
    snow_stop_init(&stop, sizeof stop);
    stop.max_steps = -1; /* the particles or the rim end it */
    if (run->scene != SNOW_AGGREGATE_CLUSTER_CLUSTER && run->particles > 0)
        stop.frozen = (uint64_t)run->particles;
    require(snow_run(grid, &stop, NULL), run->name);
    double seconds = processor_seconds() - start;
    uint64_t particles = 0;
    uint64_t bytes = 0;
    require(snow_aggregate_particles(grid, &particles), run->name);
    require(snow_memory(grid, &bytes), run->name);
    const char *lattice = run->lattice == SNOW_AGGREGATE_CUBIC ? "cubic" : "square";
    double each = 1e6 * seconds / (double)particles;
    printf("%-38s %-6s %8" PRIu64 " particles %8.2f s %8.2f us each %8.1f bytes each\n", run->name, lattice, particles,
           seconds, each, (double)bytes / (double)particles);
    fflush(stdout);
    if (work->csv != NULL)
        fprintf(work->csv, "scenes,\"%s\",%s,%" PRIu64 ",,%.3f,%.4f,,,%.2f,,1\n", run->name, lattice, particles, seconds,
                each, (double)bytes / (double)particles);
    snow_destroy(grid);
}

static void print_help(void)
{
    printf("usage: %s [options]\n"
           "Walks against a fixed cluster in several ways, and reports time a walk and error of the hit\n"
           "probabilities; then grows clusters, and reports time, memory and jumps a particle; then the\n"
           "other scenes.\n\n"
           "  --part law|growth|scenes  only this\n"
           "  --cluster N        particles of the fixed cluster, 2 to 1000 (default: 200)\n"
           "  --seconds S        processor time for each way of walking (default: 20)\n"
           "  --most N           grow to 10^4, 10^5, ... at most N particles (default: 1000000)\n"
           "  --threads N        threads for growth (default: 1)\n"
           "  --csv FILE         append the figures to FILE\n"
           "  --date TEXT        date to note in FILE\n"
           "  --help             this text\n",
           program_name);
}

static void read_part(plan *work, const char *name)
{
    work->law = strcmp(name, "law") == 0;
    work->growth = strcmp(name, "growth") == 0;
    work->scenes = strcmp(name, "scenes") == 0;
    if (!work->law && !work->growth && !work->scenes)
        arguments_fail("'%s' is no part: law, growth, scenes", name);
}

static void read_arguments(plan *work, int count, char **arguments, const char **csv_path, const char **date)
{
    enum { PART, CLUSTER, SECONDS, MOST, THREADS, CSV, DATE, HELP };
    static const struct option options[] = {
        {"part", required_argument, NULL, PART},       {"cluster", required_argument, NULL, CLUSTER},
        {"seconds", required_argument, NULL, SECONDS}, {"most", required_argument, NULL, MOST},
        {"threads", required_argument, NULL, THREADS}, {"csv", required_argument, NULL, CSV},
        {"date", required_argument, NULL, DATE},       {"help", no_argument, NULL, HELP},
        {NULL, 0, NULL, 0},
    };
    for (int option = 0; (option = getopt_long(count, arguments, "", options, NULL)) != -1;) {
        switch (option) {
        case PART: read_part(work, optarg); break;
        case CLUSTER: work->cluster = arguments_integer("--cluster", optarg, 2, 1000); break;
        case SECONDS: work->seconds = arguments_number("--seconds", optarg, 0.001, 1e6); break;
        case MOST: work->most = arguments_integer("--most", optarg, 10000, 1000000000); break;
        case THREADS: work->threads = (int32_t)arguments_integer("--threads", optarg, 1, 1024); break;
        case CSV: *csv_path = optarg; break;
        case DATE: *date = optarg; break;
        case HELP: print_help(); exit(0);
        default: exit(2); /* getopt_long has told why */
        }
    }
    if (optind < count)
        arguments_fail("'%s' is not an option", arguments[optind]);
}

int main(int count, char **arguments)
{
    plan work = {true, true, true, 200, 20, 1000000, 1, NULL};
    const char *csv_path = NULL;
    const char *date = NULL;
    read_arguments(&work, count, arguments, &csv_path, &date);
    if (csv_path != NULL) {
        work.csv = csv_open(csv_path, csv_columns, count, arguments, date);
        if (work.csv == NULL)
            arguments_fail("%s: %s", csv_path, strerror(errno));
    }
    if (work.law)
        measure_law(&work);
    if (work.growth) {
        grow(&work, SNOW_AGGREGATE_SQUARE, "square");
        grow(&work, SNOW_AGGREGATE_HEXAGONAL, "hexagonal");
        grow(&work, SNOW_AGGREGATE_CUBIC, "cubic");
    }
    for (size_t i = 0; work.scenes && i < sizeof scene_runs / sizeof scene_runs[0]; i++)
        run_scene(&work, &scene_runs[i]);
    if (work.csv != NULL && !csv_close(work.csv)) {
        fprintf(stderr, "%s: %s: the figures were not written\n", program_name, csv_path);
        return 1;
    }
    return 0;
}
