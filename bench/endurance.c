/*
 * snowgrowth-endurance: does a step late in a long run cost more than an early one? Vapour that is shut in dies out; in
 * plain doubles it ends as subnormal numbers, which slow most processors down. README.md tells how to read the figures.
 */
#include "arguments.h"
#include "csv.h"
#include "plain.h"
#include "timing.h"

#include <getopt.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

const char *const program_name = "snowgrowth-endurance";

static const double greatest_ratio = 1.2;

enum { MOST_WALLS = 8000, STRIDE = 50, STRIDES = 20 };

static const char csv_columns[] = "scene,way,cells,steps,start_ns,end_ns,ratio,frozen_start,frozen_end,vapour_start,"
                                  "vapour_end,subnormal_end";

typedef struct place {
    const char *name;
    const char *what;
    double background, addition, diffusion, noise;
    int32_t radius;
    int32_t wall;    /* cells from wall to wall; 0: one seed in place of walls */
    bool chiral;     /* with seeds that no mirror keeps: then every cell is computed in each step */
    int64_t beyond;  /* -1: timed from the start; else so many steps after its ice has come to the rim */
} place;

/* In pockets the air is so thin that nothing freezes: only the vapour changes. */
static const place places[] = {
    {"pockets", "triangles of ice, noise: nothing to fold", 0.1, 0, 1, 0.05, 37, 12, false, -1},
    {"pockets-folded", "the same without noise: one cell in twelve", 0.1, 0, 1, 0, 37, 12, false, -1},
    {"pockets-all", "turned by seeds that no mirror keeps: nothing is skipped", 0.1, 0, 1, 0, 37, 12, true, -1},
    {"pockets-wide", "wider triangles", 0.05, 0, 1, 0.01, 37, 18, false, -1},
    {"pockets-alpha", "vapour below zero", 0.1, 0, 2.5, 0.05, 37, 12, false, -1},
    {"grown-shut", "a crystal with noise, 3000 steps after it has reached the rim", 0.4, 0, 1, 0.1, 37, 0, false, 3000},
    {"growing", "a crystal in thin air that grows all the time", 0.001, 0, 1, 0, 40, 0, false, -1},
};

/* What grows it. */
typedef struct way {
    const char *name;
    bool plain;
    snow_reiter_precision precision;
    snow_reiter_symmetry symmetry;
} way;

static const way ways[] = {
    {"rows", false, SNOW_REITER_PRECISION_DOUBLE, SNOW_REITER_SYMMETRY_AUTO},
    {"rows-whole", false, SNOW_REITER_PRECISION_DOUBLE, SNOW_REITER_SYMMETRY_NONE},
    {"rows-single", false, SNOW_REITER_PRECISION_SINGLE, SNOW_REITER_SYMMETRY_AUTO},
    {"plain", true, SNOW_REITER_PRECISION_DOUBLE, SNOW_REITER_SYMMETRY_NONE},
};

typedef struct plan {
    const char *place;
    const char *way;
    int64_t steps;
    int64_t plain_steps;
    const char *csv_path;
    const char *date;
} plan;

/* A crystal of the library, or of the plain program. */
typedef struct crystal {
    snow_grid *grid;
    plain_crystal *plain;
} crystal;

/* Cells that hold vapour, and those of them in which it is a subnormal number. */
typedef struct holding {
    uint64_t vapour, subnormal;
} holding;

typedef struct figures {
    int64_t steps;
    uint64_t cells;
    double start, end; /* seconds a step */
    uint64_t frozen_start, frozen_end;
    holding held_start, held_end;
} figures;

static void print_help(void)
{
    printf("usage: %s [options]\n"
           "Takes many steps of scenes whose vapour dies out, and reports what a step costs at the start and at the\n"
           "end. Ends with status 1 when the library's steps have become slower though no cell has frozen.\n\n"
           "  --list            the scenes and the ways of growing them\n"
           "  --scene NAME      only this scene\n"
           "  --way NAME        only this way\n"
           "  --steps N         steps of the library (default: 1000000)\n"
           "  --plain-steps N   steps of the plain program (default: 50000)\n"
           "  --csv FILE        append the figures to FILE\n"
           "  --date TEXT       date to note in FILE\n"
           "  --help            this text\n",
           program_name);
}

static void print_list(void)
{
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++)
        printf("%-20s %s\n", places[i].name, places[i].what);
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++)
        printf("%-20s way\n", ways[i].name);
}

static void read_arguments(plan *work, int count, char **arguments)
{
    enum { LIST, SCENE, WAY, STEPS, PLAIN_STEPS, CSV, DATE, HELP };
    static const struct option options[] = {
        {"list", no_argument, NULL, LIST},
        {"scene", required_argument, NULL, SCENE},
        {"way", required_argument, NULL, WAY},
        {"steps", required_argument, NULL, STEPS},
        {"plain-steps", required_argument, NULL, PLAIN_STEPS},
        {"csv", required_argument, NULL, CSV},
        {"date", required_argument, NULL, DATE},
        {"help", no_argument, NULL, HELP},
        {NULL, 0, NULL, 0},
    };
    *work = (plan){.steps = 1000000, .plain_steps = 50000};
    for (int option = 0; (option = getopt_long(count, arguments, "", options, NULL)) != -1;) {
        switch (option) {
        case LIST: print_list(); exit(0);
        case SCENE: work->place = optarg; break;
        case WAY: work->way = optarg; break;
        case STEPS: work->steps = arguments_integer("--steps", optarg, STRIDE * STRIDES, INT64_MAX); break;
        case PLAIN_STEPS:
            work->plain_steps = arguments_integer("--plain-steps", optarg, STRIDE * STRIDES, INT64_MAX);
            break;
        case CSV: work->csv_path = optarg; break;
        case DATE: work->date = optarg; break;
        case HELP: print_help(); exit(0);
        default: exit(2); /* getopt_long has told why */
        }
    }
    if (optind < count)
        arguments_fail("'%s' is not an option", arguments[optind]);
}

static int32_t ring_of(int32_t q, int32_t r)
{
    return (abs(q) + abs(r) + abs(q + r)) / 2;
}

/* Lines of ice in the three directions of the lattice, up to a ring of ice that shuts all in. */
static size_t build_walls(const place *where, snow_cell walls[MOST_WALLS])
{
    int32_t wall = where->wall;
    int32_t last = (where->radius - 1) / wall * wall;
    size_t count = 0;
    for (int32_t r = -last; r <= last; r++)
        for (int32_t q = -last; q <= last; q++)
            if (ring_of(q, r) <= last && (q % wall == 0 || r % wall == 0 || (q + r) % wall == 0))
                walls[count++] = (snow_cell){q, r};
    snow_cell turned = {wall / 2 + 1, 2};
    for (int turn = 0; where->chiral && turn < 6; turn++) {
        walls[count++] = turned;
        turned = (snow_cell){-turned.r, turned.q + turned.r};
    }
    return count;
}

static snow_reiter_params params_of(const place *where, const way *how, snow_cell walls[MOST_WALLS])
{
    snow_reiter_params params;
    snow_reiter_params_init(&params, sizeof params);
    params.background = where->background;
    params.addition = where->addition;
    params.diffusion = where->diffusion;
    params.noise = where->noise;
    params.domain = SNOW_REITER_HEXAGON;
    params.radius = where->radius;
    params.precision = how->precision;
    params.symmetry = how->symmetry;
    if (where->wall > 0) {
        params.seed_count = build_walls(where, walls);
        params.seeds = walls;
    }
    return params;
}

static bool advance(const crystal *made, int64_t steps)
{
    if (made->plain == NULL)
        return snow_step(made->grid, steps) == SNOW_OK;
    plain_run(made->plain, plain_steps(made->plain) + steps, false);
    return true;
}

static bool grow_to_the_rim(const crystal *made)
{
    snow_stop stop;
    snow_stop_init(&stop, sizeof stop);
    stop.max_steps = -1;
    if (made->plain == NULL)
        return snow_run(made->grid, &stop, NULL) == SNOW_OK;
    plain_run(made->plain, INT64_MAX, true);
    return true;
}

static bool make_crystal(const place *where, const way *how, crystal *made)
{
    static snow_cell walls[MOST_WALLS];
    snow_reiter_params params = params_of(where, how, walls);
    *made = (crystal){NULL, NULL};
    if (snow_reiter_create(&params, NULL, &made->grid) != SNOW_OK)
        return false;
    if (how->plain)
        made->plain = plain_create(&params, false, made->grid);
    if (how->plain && made->plain == NULL)
        return false;
    return where->beyond < 0 || (grow_to_the_rim(made) && advance(made, where->beyond));
}

static void end_crystal(const crystal *made)
{
    plain_destroy(made->plain);
    snow_destroy(made->grid);
}

/* Of the processor, so that a neighbour who takes turns with us does not count. */
static double processor_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Seconds. 0: the crystal cannot be stepped. */
static double time_stride(const crystal *made)
{
    double started = processor_now();
    return advance(made, STRIDE) ? processor_now() - started : 0;
}

/* By turns, so that whatever disturbs the one disturbs the other as well. */
static void time_steps(const crystal *young, const crystal *old, figures *seen)
{
    double start[STRIDES];
    double end[STRIDES];
    for (size_t i = 0; i < STRIDES; i++) {
        start[i] = time_stride(young);
        end[i] = time_stride(old);
    }
    seen->start = timing_median(start, STRIDES) / STRIDE;
    seen->end = timing_median(end, STRIDES) / STRIDE;
}

static const char *count_vapour(const crystal *made, holding *held)
{
    size_t size = 0;
    if (snow_field_copy(made->grid, SNOW_FIELD_VAPOUR, NULL, NULL, 0, &size) != SNOW_OK)
        return "the grid cannot be read";
    double *vapour = calloc(size, sizeof *vapour);
    double *inside = calloc(size, sizeof *inside);
    bool read = vapour != NULL && inside != NULL &&
                snow_field_copy(made->grid, SNOW_FIELD_VAPOUR, NULL, vapour, size, NULL) == SNOW_OK &&
                snow_field_copy(made->grid, SNOW_FIELD_INSIDE, NULL, inside, size, NULL) == SNOW_OK;
    if (read && made->plain != NULL)
        plain_copy_vapour(made->plain, vapour);
    *held = (holding){0, 0};
    for (size_t i = 0; read && i < size; i++) {
        held->vapour += inside[i] == 1 && vapour[i] != 0;
        held->subnormal += fpclassify(vapour[i]) == FP_SUBNORMAL;
    }
    free(vapour);
    free(inside);
    return read ? NULL : "no memory";
}

static uint64_t count_frozen(const crystal *made)
{
    uint64_t frozen = 0;
    if (made->plain != NULL)
        frozen = plain_frozen(made->plain);
    else
        (void)snow_frozen(made->grid, &frozen);
    return frozen;
}

/* NULL, or what went wrong. */
static const char *endure(const crystal *young, const crystal *old, int64_t steps, figures *seen)
{
    *seen = (figures){.steps = steps, .frozen_start = count_frozen(young)};
    if (snow_domain_cells(young->grid, &seen->cells) != SNOW_OK)
        return "the grid cannot be read";
    const char *trouble = count_vapour(young, &seen->held_start);
    if (trouble != NULL)
        return trouble;
    if (!advance(old, steps - STRIDE * STRIDES))
        return "it cannot be stepped";
    time_steps(young, old, seen);
    if (seen->start == 0 || seen->end == 0)
        return "it cannot be stepped";
    seen->frozen_end = count_frozen(old);
    return count_vapour(old, &seen->held_end);
}

static void report(const place *where, const way *how, const figures *seen, FILE *csv)
{
    printf("%-15s %-12s %9.0f %9.0f %7.3f  %6" PRIu64 " %6" PRIu64 "  %6" PRIu64 " %6" PRIu64 " %6" PRIu64 "\n",
           where->name, how->name, 1e9 * seen->start, 1e9 * seen->end, seen->end / seen->start, seen->frozen_start,
           seen->frozen_end, seen->held_start.vapour, seen->held_end.vapour, seen->held_end.subnormal);
    fflush(stdout);
    if (csv != NULL)
        fprintf(csv,
                "%s,%s,%" PRIu64 ",%" PRId64 ",%.1f,%.1f,%.4f,%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%" PRIu64
                "\n",
                where->name, how->name, seen->cells, seen->steps, 1e9 * seen->start, 1e9 * seen->end,
                seen->end / seen->start, seen->frozen_start, seen->frozen_end, seen->held_start.vapour,
                seen->held_end.vapour, seen->held_end.subnormal);
}

/* A crystal that has grown has more to do in a step; one that has not must not become slower. */
static bool is_sound(const way *how, const figures *seen)
{
    return how->plain || seen->frozen_end > seen->frozen_start || seen->end <= greatest_ratio * seen->start;
}

static bool bench_one(const plan *work, const place *where, const way *how, FILE *csv)
{
    crystal young = {NULL, NULL};
    crystal old = {NULL, NULL};
    figures seen = {0};
    bool made = make_crystal(where, how, &young) && make_crystal(where, how, &old);
    const char *trouble = made ? endure(&young, &old, how->plain ? work->plain_steps : work->steps, &seen)
                               : "it cannot be made";
    end_crystal(&young);
    end_crystal(&old);
    if (trouble != NULL) {
        fprintf(stderr, "%s: %s: %s: %s\n", program_name, where->name, how->name, trouble);
        return false;
    }
    report(where, how, &seen, csv);
    if (!is_sound(how, &seen))
        printf("    SLOWER: more than %g times the time of a step at the start\n", greatest_ratio);
    return is_sound(how, &seen);
}

int main(int argument_count, char **arguments)
{
    plan work;
    read_arguments(&work, argument_count, arguments);
    FILE *csv = csv_open(work.csv_path, csv_columns, argument_count, arguments, work.date);
    bool done = true;
    size_t chosen = 0;
    printf("%-15s %-12s %9s %9s %7s  %6s %6s  %6s %6s %6s\n", "scene", "way", "ns/step", "at end", "ratio", "frozen",
           "at end", "vapour", "at end", "subn.");
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        for (size_t k = 0; k < sizeof ways / sizeof ways[0]; k++) {
            if ((work.place != NULL && strcmp(work.place, places[i].name) != 0) ||
                (work.way != NULL && strcmp(work.way, ways[k].name) != 0))
                continue;
            chosen++;
            done = bench_one(&work, &places[i], &ways[k], csv) && done;
        }
    }
    if (!csv_close(csv))
        arguments_fail("%s could not be written", work.csv_path);
    if (chosen == 0)
        arguments_fail("there is no such scene or way; --list shows them all");
    return done ? 0 : 1;
}
