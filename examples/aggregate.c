/* One growth by aggregation, from a command line to a picture. */
#include "common/kept.h"
#include "common/message.h"
#include "common/options.h"
#include "common/output.h"
#include "common/particles.h"
#include "common/places.h"
#include "common/progress.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct files {
    const char *out;
    const char *sites;
    const char *ply;
    const char *vtk;
    const char *save;
    const char *load;
} files;

typedef struct job {
    snow_aggregate_params params;
    snow_options options;
    snow_stop stop;
    int64_t particles;
    number_list launch;
    number_list cathode;
    number_list hardness;
    number_list walls;
    const char *start;
    const char *obstacles;
    files names;
    int32_t size;
    double checkpoint; /* seconds between two saves; 0: only at the end */
} job;

static const option_choice scene_names[] = {{"witten-sander", SNOW_AGGREGATE_WITTEN_SANDER},
                                            {"laboratory", SNOW_AGGREGATE_LABORATORY},
                                            {"line", SNOW_AGGREGATE_LINE},
                                            {"electrolysis", SNOW_AGGREGATE_ELECTROLYSIS},
                                            {"shore", SNOW_AGGREGATE_SHORE},
                                            {"chimney", SNOW_AGGREGATE_CHIMNEY},
                                            {"snowflake", SNOW_AGGREGATE_SNOWFLAKE},
                                            {"cluster-cluster", SNOW_AGGREGATE_CLUSTER_CLUSTER},
                                            {"off-lattice", SNOW_AGGREGATE_OFF_LATTICE},
                                            {NULL, 0}};
static const option_choice lattice_names[] = {{"square", SNOW_AGGREGATE_SQUARE},
                                              {"hexagonal", SNOW_AGGREGATE_HEXAGONAL},
                                              {"cubic", SNOW_AGGREGATE_CUBIC},
                                              {NULL, 0}};
static const option_choice contact_names[] = {
    {"arrival", SNOW_AGGREGATE_ARRIVAL}, {"entry", SNOW_AGGREGATE_ENTRY}, {NULL, 0}};
static const option_choice engine_names[] = {{"auto", SNOW_AGGREGATE_ENGINE_AUTO},
                                             {"jumps", SNOW_AGGREGATE_ENGINE_JUMPS},
                                             {"steps", SNOW_AGGREGATE_ENGINE_STEPS},
                                             {NULL, 0}};

static bool take_preset(void *params, const char *name)
{
    snow_status status = snow_aggregate_params_preset(params, name);
    if (status != SNOW_OK)
        complain("--preset: %s: %s", name, snow_strerror(status));
    return status == SNOW_OK;
}

static int list_presets(void)
{
    for (size_t i = 0; snow_aggregate_preset_name(i); i++)
        printf("%-16s %s\n", snow_aggregate_preset_name(i), snow_aggregate_preset_source(i));
    return print_line("%s", "");
}

/* A list of whole numbers, as many as there are places for. */
static bool take_integers(const char *name, const number_list *list, int32_t **places, size_t count)
{
    if (list->count == 0)
        return true;
    for (size_t i = 0; i < list->count; i++) {
        double number = list->numbers[i];
        if (list->count != count || number < INT32_MIN || number > INT32_MAX || number != (double)(int32_t)number) {
            complain("--%s takes %zu whole numbers with commas between them", name, count);
            return false;
        }
        *places[i] = (int32_t)number;
    }
    return true;
}

static bool take_lists(job *self)
{
    snow_aggregate_params *to = &self->params;
    return take_integers("launch", &self->launch, (int32_t *[]){&to->launch_first, &to->launch_last}, 2) &&
           take_integers("cathode", &self->cathode, (int32_t *[]){&to->cathode_first, &to->cathode_last}, 2) &&
           take_integers("hardness", &self->hardness, (int32_t *[]){&to->hardness_least, &to->hardness_greatest}, 2) &&
           take_integers("walls", &self->walls,
                         (int32_t *[]){&to->wall_left, &to->wall_right, &to->wall_left_top, &to->wall_right_top}, 4);
}

/* --particles is how many there are, or how many there shall be. */
static void set_end(job *self)
{
    bool drifting = self->params.scene == SNOW_AGGREGATE_CLUSTER_CLUSTER;
    self->stop.max_steps = -1;
    if (drifting && self->particles > 0)
        self->params.particles = (uint64_t)self->particles;
    if (!drifting)
        self->stop.frozen = (uint64_t)self->particles;
}

static bool save(const snow_grid *grid, const char *name)
{
    output file;
    if (!output_open(&file, name))
        return false;
    bool saved = kept_save(grid, &file);
    output_discard(&file);
    return saved;
}

static void show_progress(const snow_grid *grid, const snow_summary *summary, double speed)
{
    size_t clusters;
    if (snow_aggregate_clusters(grid, NULL, 0, &clusters) == SNOW_OK)
        progress_show("%zu clusters, the largest of %" PRIu64 ", %.0f mergings a second", clusters, summary->frozen, speed);
    else
        progress_show("%" PRIu64 " particles, radius %.0f, %.0f a second", summary->frozen, summary->tip_radius, speed);
}

/* Grows in runs of a tenth of a second: between them it shows how it goes, keeps what there is from time to time, and
   ends when Ctrl-C or --seconds ask for it. */
static snow_status run(const job *self, snow_grid *grid, snow_summary *summary)
{
    snow_stop stop = self->stop;
    int64_t steps = 0;
    snow_steps(grid, &steps);
    double started = progress_clock();
    double saved = started;
    snow_status status;
    stop.seconds = 0.1;
    do {
        status = snow_run(grid, &stop, summary);
        double now = progress_clock();
        summary->seconds = now - started;
        show_progress(grid, summary, (double)(summary->steps - steps) / summary->seconds);
        if (self->checkpoint > 0 && now - saved >= self->checkpoint) {
            save(grid, self->names.save);
            saved = now;
        }
    } while (status == SNOW_OK && summary->reason == SNOW_STOP_TIME && !progress_cancelled() &&
             (self->stop.seconds <= 0 || summary->seconds < self->stop.seconds));
    return status;
}

enum { PICTURE, SITES, PLY, VTK, OUTPUTS };

/* The files are opened before the growth, so that it is not in vain. */
static bool open_files(const files *names, output *opened)
{
    const char *const list[OUTPUTS] = {names->out, names->sites, names->ply, names->vtk};
    output kept;
    for (int i = 0; i < OUTPUTS; i++)
        if (!output_open(&opened[i], list[i]))
            return false;
    if (!output_open(&kept, names->save))
        return false;
    output_discard(&kept);
    return true;
}

static bool write_files(const job *self, const snow_grid *grid, output *opened)
{
    const files *names = &self->names;
    if (!names->out && !names->sites && !names->ply && !names->vtk)
        return true;
    particles all;
    bool written = particles_fetch(&all, grid);
    if (written && opened[PICTURE].name)
        written = particles_draw(&all, grid, self->size, &opened[PICTURE]);
    if (written && opened[SITES].name)
        written = particles_list(&all, grid, &opened[SITES]);
    if (written && opened[PLY].name)
        written = particles_write_ply(&all, &opened[PLY]);
    if (written && opened[VTK].name)
        written = particles_write_vtk(&all, &opened[VTK]);
    particles_destroy(&all);
    return written;
}

/* Clusters that drift: the gyration of the largest one; half the diagonal of the box that holds all of them. */
static void measure_drifted(const snow_grid *grid, double *gyration, double *radius)
{
    size_t count = 0;
    snow_aggregate_clusters(grid, NULL, 0, &count);
    snow_aggregate_cluster *clusters = malloc(count * sizeof *clusters);
    snow_aggregate_cluster largest = {0, 0};
    snow_point low;
    snow_point high;
    if (clusters != NULL && snow_aggregate_clusters(grid, clusters, count, NULL) == SNOW_OK)
        for (size_t i = 0; i < count; i++)
            largest = clusters[i].mass > largest.mass ? clusters[i] : largest;
    free(clusters);
    *gyration = largest.gyration;
    if (snow_aggregate_bounds(grid, &low, &high) == SNOW_OK)
        *radius = sqrt(pow(high.x - low.x, 2) + pow(high.y - low.y, 2) + pow(high.z - low.z, 2)) / 2;
}

static int print_result(const snow_grid *grid, const snow_summary *summary)
{
    uint64_t count = 0;
    double gyration = 0;
    double radius = summary->tip_radius;
    snow_aggregate_particles(grid, &count);
    if (snow_aggregate_gyration(grid, &count, &gyration, 1) == SNOW_ERROR_UNSUPPORTED)
        measure_drifted(grid, &gyration, &radius);
    return print_line("particles=%" PRIu64 " rg=%.6g radius=%.6g seconds=%.3f\n", count, gyration, radius,
                      summary->seconds);
}

static int grow(const job *self, snow_grid *grid, output *opened)
{
    snow_summary summary;
    snow_summary_init(&summary, sizeof summary);
    snow_status status = run(self, grid, &summary);
    progress_clear();
    if (status != SNOW_OK)
        return complain_status(NULL, status);
    bool kept = save(grid, self->names.save) && write_files(self, grid, opened);
    return kept ? print_result(grid, &summary) : EXIT_FAILED;
}

static int grow_into_files(const job *self, snow_grid *grid)
{
    output opened[OUTPUTS] = {{0}};
    int exit_code = open_files(&self->names, opened) ? grow(self, grid, opened) : EXIT_FAILED;
    for (int i = 0; i < OUTPUTS; i++)
        output_discard(&opened[i]);
    return exit_code;
}

static void init(job *self)
{
    *self = (job){.particles = 10000, .size = 1000};
    snow_aggregate_params_init(&self->params, sizeof self->params);
    snow_options_init(&self->options, sizeof self->options);
    snow_stop_init(&self->stop, sizeof self->stop);
}

/* The scene, with the seeds and obstacles that files list; returns the exit code. */
static int create(job *self, snow_grid **grid)
{
    place_list seeds = {NULL, 0};
    place_list obstacles = {NULL, 0};
    int exit_code = EXIT_WRONG;
    if (places_read(&seeds, "start", self->start) && places_read(&obstacles, "obstacles", self->obstacles)) {
        self->params.seeds = seeds.sites;
        self->params.seed_count = seeds.count;
        self->params.obstacles = obstacles.sites;
        self->params.obstacle_count = obstacles.count;
        snow_status status = snow_aggregate_create(&self->params, &self->options, grid);
        exit_code = status == SNOW_OK ? EXIT_DONE : complain_status(NULL, status);
    }
    places_destroy(&seeds);
    places_destroy(&obstacles);
    return exit_code;
}

#define SCENE_HEADING "The scene"

static bool check(const program *command, const job *self)
{
    const char *given = option_given_of(command, SCENE_HEADING);
    if (self->names.load && given) {
        complain("--load brings its own scene; --%s cannot be given with it", given);
        return false;
    }
    if (self->checkpoint != 0 && (self->checkpoint < 0 || self->names.save == NULL)) {
        complain("--checkpoint takes seconds, and goes with --save");
        return false;
    }
    return true;
}

int main(int argc, char **argv)
{
    job self;
    int32_t list = 0;
    init(&self);
    snow_aggregate_params *to = &self.params;
    option_row rows[] = {
        OPTION_GROUP(SCENE_HEADING),
        OPTION_ACTION("preset", "NAME", take_preset, to, "a figure of the sources; other options change it"),
        OPTION_CHOICE("scene", scene_names, &to->scene, "where walkers start and how they move (witten-sander)"),
        OPTION_CHOICE("lattice", lattice_names, &to->lattice, "(square)"),
        OPTION_CHOICE("contact", contact_names, &to->contact,
                      "stay next to the cluster, or on trying to enter it (arrival)"),
        OPTION_CHOICE("engine", engine_names, &to->engine, "jumps over empty regions, or plain single steps (auto)"),
        OPTION_UNSIGNED("seed", &to->random_seed, "chooses every random number (0)"),
        OPTION_NUMBER("stick", &to->sticking, "chance that a contact sticks (1)"),
        OPTION_TEXT("start", "FILE", &self.start, "sites that are filled at the start, as --sites writes them"),
        OPTION_TEXT("obstacles", "FILE", &self.obstacles, "likewise sites that are neither entered nor filled"),
        OPTION_INTEGER("hits", "COUNT", &to->hits, INT32_MIN, INT32_MAX, "noise reduction: hits that fill a site (1)"),
        OPTION_NUMBER("kill-radius", &to->kill_radius, "drop walkers beyond so many launch radii; biased (0: never)"),
        OPTION_INTEGER("launch-radius", "SITES", &to->launch_radius, INT32_MIN, INT32_MAX, "laboratory: R0 (100)"),
        OPTION_INTEGER("end-radius", "SITES", &to->end_radius, INT32_MIN, INT32_MAX, "laboratory: R (90)"),
        OPTION_INTEGER("width", "SITES", &to->width, INT32_MIN, INT32_MAX, "of vessel, bath, shore, shaft (256)"),
        OPTION_INTEGER("height", "SITES", &to->height, INT32_MIN, INT32_MAX, "likewise (256)"),
        OPTION_INTEGER("depth", "SITES", &to->depth, INT32_MIN, INT32_MAX, "of a vessel on the cubic lattice (64)"),
        OPTION_FLAG("periodic", &to->periodic, "line, electrolysis, shore: join the sides"),
        OPTION_LIST("launch", &self.launch, "electrolysis: first and last column that ions start in (all)"),
        OPTION_LIST("cathode", &self.cathode, "electrolysis: its first and last column (all)"),
        OPTION_NUMBER("interaction", &to->interaction, "electrolysis: interaction radius (0)"),
        OPTION_LIST("hardness", &self.hardness, "shore: least and greatest (1,3)"),
        OPTION_LIST("walls", &self.walls, "chimney: left and right wall below, left and right on top (0,255,0,255)"),
        OPTION_NUMBER("density", &to->density, "cluster-cluster: particles per site (0.05)"),
        OPTION_NUMBER("mobility", &to->mobility, "cluster-cluster: clusters of mass s move as s^-mobility (0)"),
        OPTION_GROUP("The run"),
        OPTION_LONG("particles", "COUNT", &self.particles, 1, INT64_MAX,
                    "end with so many; cluster-cluster: begin (10000)"),
        OPTION_NUMBER("radius", &self.stop.tip_radius, "end at this radius (0: none)"),
        OPTION_LONG("rows", "ROWS", &self.stop.height, 0, INT64_MAX, "end at this height of the deposit (0: none)"),
        OPTION_NUMBER("seconds", &self.stop.seconds, "end after this time (0: none)"),
        OPTION_INTEGER("threads", "COUNT", &self.options.threads, 0, 1024, "that walk ahead; 0: one a processor (1)"),
        OPTION_GROUP("What is written"),
        OPTION_TEXT("out", "FILE.png", &self.names.out, "a picture, coloured by age"),
        OPTION_INTEGER("size", "PIXELS", &self.size, 16, 16384, "its longer side (1000)"),
        OPTION_TEXT("sites", "FILE", &self.names.sites, "the sites in joining order, a line each"),
        OPTION_TEXT("ply", "FILE.ply", &self.names.ply, "the particles as a point cloud (PLY)"),
        OPTION_TEXT("vtk", "FILE.vtk", &self.names.vtk, "likewise (legacy VTK)"),
        OPTION_TEXT("save", "FILE", &self.names.save, "keep the growth, to go on with --load"),
        OPTION_NUMBER("checkpoint", &self.checkpoint, "also save after every so many seconds (0: at the end)"),
        OPTION_TEXT("load", "FILE", &self.names.load, "go on with a kept growth"),
        OPTION_FLAG("list-presets", &list, "print the presets and end"),
        OPTION_END,
    };
    program command = {"aggregate",
                       "Grows a cluster by diffusion-limited aggregation, or wears a shore, and prints how that\n"
                       "ended, in one line. Ctrl-C ends it early; files and line are then those of what there is.",
                       "aggregate --particles 1000000 --size 2000 --out cluster.png", rows};
    snow_grid *grid = NULL;
    int exit_code;

    if (!options_read(&command, argc, argv, &exit_code))
        return exit_code;
    if (list)
        return list_presets();
    if (!check(&command, &self) || !take_lists(&self))
        return EXIT_WRONG;
    set_end(&self);
    progress_start();
    exit_code = self.names.load ? kept_load(self.names.load, &self.options, &grid) : create(&self, &grid);
    if (exit_code == EXIT_DONE)
        exit_code = grow_into_files(&self, grid);
    snow_destroy(grid);
    return exit_code;
}
