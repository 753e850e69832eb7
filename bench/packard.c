/*
 * snowgrowth-packard-bench: how fast the engines of Packard's model grow crystals, beside bgolly, the command-line
 * program of Golly, where that is installed. README.md tells how to read the figures.
 */
#include "arguments.h"
#include "child.h"
#include "csv.h"
#include "timing.h"

#include <snowgrowth/snowgrowth.h>

#include <errno.h>
#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char *const program_name = "snowgrowth-packard-bench";

enum { MOST_SCENES = 64, MOST_ROUNDS = 1000, WORD = 64 };

/* What can grow a scene, in the order of the bits below. */
static const char *const engine_names[] = {"quicklife", "hashlife", "auto", "tiles", "quadtree", "reference"};
enum { ENGINES = sizeof engine_names / sizeof engine_names[0], FIRST_OF_OURS = 2 };
enum { QUICKLIFE = 1, HASHLIFE = 2, AUTO = 4, TILES = 8, QUADTREE = 16, REFERENCE = 32 };
enum { BY_TILES = QUICKLIFE | AUTO | TILES, BY_TREES = HASHLIFE | AUTO | QUADTREE };

typedef struct packard_scene {
    const char *name;
    const char *what;
    const char *rule;
    int64_t steps;
    unsigned engines; /* those that end in reasonable time */
    int32_t scatter;  /* seeds in a rhombus of that side; 0: one seed */
    int32_t side;
    const snow_cell *seeds; /* NULL: the origin */
    size_t seed_count;
    const char *population; /* where it is known from elsewhere */
    bool slow;              /* only when named */
} packard_scene;

static const snow_cell aside[] = {{1, 0}};
static const snow_cell three[] = {{0, 0}, {3, 1}, {-2, 7}};

static const packard_scene scenes[] = {
    {.name = "one-4000", .what = "0100000 from one seed", .rule = "0100000", .steps = 4000,
     .engines = BY_TILES | QUADTREE},
    {.name = "one-8000", .what = "the same", .rule = "0100000", .steps = 8000, .engines = BY_TILES | QUADTREE},
    {.name = "one-16000", .what = "the same", .rule = "0100000", .steps = 16000, .engines = BY_TILES | QUADTREE},
    {.name = "parity-4000", .what = "0101010 from one seed", .rule = "0101010", .steps = 4000,
     .engines = BY_TILES | QUADTREE},
    {.name = "parity-8000", .what = "the same", .rule = "0101010", .steps = 8000, .engines = BY_TILES | QUADTREE},
    {.name = "parity-16000", .what = "the same", .rule = "0101010", .steps = 16000, .engines = BY_TILES | QUADTREE},
    {.name = "aside-4000", .what = "0100000 from one seed off the origin", .rule = "0100000", .steps = 4000,
     .engines = BY_TILES | QUADTREE, .seeds = aside, .seed_count = 1},
    {.name = "three-4000", .what = "0100000 from three seeds: no symmetry", .rule = "0100000", .steps = 4000,
     .engines = BY_TILES | QUADTREE, .seeds = three, .seed_count = 3},
    {.name = "three-8000", .what = "the same", .rule = "0100000", .steps = 8000, .engines = BY_TILES | QUADTREE,
     .seeds = three, .seed_count = 3},
    {.name = "scatter", .what = "0100000 from 4000 seeds in 4096 x 4096", .rule = "0100000", .steps = 500,
     .engines = BY_TILES | BY_TREES, .scatter = 4000, .side = 4096},
    {.name = "one-2^20", .what = "0100000 from one seed", .rule = "0100000", .steps = INT64_C(1) << 20,
     .engines = BY_TREES, .population = "2095753148245"},
    {.name = "parity-2^60", .what = "0101010 from one seed", .rule = "0101010", .steps = INT64_C(1) << 60,
     .engines = BY_TREES},
    {.name = "0101100-2^60", .what = "0101100 from one seed", .rule = "0101100", .steps = INT64_C(1) << 60,
     .engines = AUTO | QUADTREE},
    {.name = "one-2^24", .what = "0100000 from one seed", .rule = "0100000", .steps = INT64_C(1) << 24,
     .engines = BY_TREES, .slow = true},
    {.name = "one-2^30", .what = "0100000 from one seed", .rule = "0100000", .steps = INT64_C(1) << 30,
     .engines = AUTO | QUADTREE, .population = "2197555564353457333", .slow = true},
    {.name = "one-100", .what = "0100000 from one seed, by all engines", .rule = "0100000", .steps = 100,
     .engines = BY_TILES | BY_TREES | REFERENCE, .population = "16381"},
};
enum { SCENES = sizeof scenes / sizeof scenes[0] };

typedef struct plan {
    const packard_scene *chosen[MOST_SCENES];
    size_t count;
    unsigned engines;
    snow_isa isa;
    int32_t threads;
    size_t rounds;
    const char *csv_path;
    const char *date;
} plan;

/* What one of them did with a scene. */
typedef struct figure {
    int engine;
    char population[WORD];
    bool wrong;
    double seconds[MOST_ROUNDS];
    double elapsed[MOST_ROUNDS];
    double peak[MOST_ROUNDS]; /* in MB */
} figure;

/* ---- our engines ---- */

typedef struct run {
    const packard_scene *scene;
    snow_packard_engine engine;
    snow_isa isa;
    int32_t threads;
} run;

static snow_status make(const run *wanted, snow_grid **grid)
{
    const packard_scene *scene = wanted->scene;
    snow_packard_params params;
    snow_packard_params_init(&params, sizeof params);
    snow_status status = snow_packard_params_rule(&params, scene->rule);
    params.seeds = scene->seeds;
    params.seed_count = scene->seed_count;
    if (scene->scatter > 0) {
        params.scatter = scene->scatter;
        params.scatter_side = scene->side;
        params.random_seed = 1;
    }
    params.engine = wanted->engine;
    snow_options options;
    snow_options_init(&options, sizeof options);
    options.isa = wanted->isa;
    options.threads = wanted->threads;
    return status == SNOW_OK ? snow_packard_create(&params, &options, grid) : status;
}

static void print_population(uint64_t high, uint64_t low)
{
    char digits[40];
    size_t at = sizeof digits - 1;
    digits[at] = '\0';
    do { /* long division by ten, 32 bits at a time */
        uint64_t parts[4] = {high >> 32, high & UINT32_MAX, low >> 32, low & UINT32_MAX};
        uint64_t rest = 0;
        for (int i = 0; i < 4; i++) {
            uint64_t part = rest << 32 | parts[i];
            parts[i] = part / 10;
            rest = part % 10;
        }
        high = parts[0] << 32 | parts[1];
        low = parts[2] << 32 | parts[3];
        digits[--at] = (char)('0' + rest);
    } while ((high | low) != 0);
    printf("%s\n", digits + at);
}

/* A child_work. */
static int grow(const void *argument)
{
    const run *wanted = argument;
    snow_grid *grid = NULL;
    snow_status status = make(wanted, &grid);
    snow_stop stop;
    snow_stop_init(&stop, sizeof stop);
    stop.max_steps = wanted->scene->steps;
    if (status == SNOW_OK)
        status = snow_run(grid, &stop, NULL);
    uint64_t high = 0;
    uint64_t low = 0;
    if (status == SNOW_OK)
        status = snow_packard_population(grid, &high, &low);
    if (status != SNOW_OK) {
        fprintf(stderr, "%s: %s\n", program_name, snow_strerror(status));
        return 1;
    }
    print_population(high, low);
    return 0; /* the process ends: nothing is freed, as bgolly frees nothing */
}

/* ---- bgolly ---- */

static bool bgolly_is_here(void)
{
    char *const words[] = {"bgolly", "--version", NULL};
    child_report report;
    child_run(child_exec, words, &report); /* it has no such option, and says so with its name */
    return strstr(report.answer, "bgolly") != NULL;
}

static int write_to_file(void *context, const void *bytes, size_t size)
{
    return fwrite(bytes, 1, size, context) == size ? 0 : 1;
}

/* The scene before its first step, as a file that Golly reads. */
static void write_pattern(const packard_scene *scene, FILE *file)
{
    snow_grid *grid = NULL;
    snow_status status = make(&(run){scene, SNOW_PACKARD_ENGINE_TILES, SNOW_ISA_AUTO, 1}, &grid);
    if (status == SNOW_OK)
        status = snow_packard_save_rle_to(grid, write_to_file, file);
    if (status != SNOW_OK || fflush(file) != 0)
        arguments_fail("%s: no pattern could be written: %s", scene->name, snow_strerror(status));
    snow_destroy(grid);
}

/* The number after the last colon, without its commas: "4,000: 28,915,873". */
static void last_number(const char *text, char *number)
{
    const char *from = strrchr(text, ':');
    size_t length = 0;
    for (; from != NULL && *from != '\0' && length < WORD - 1; from++)
        if (*from >= '0' && *from <= '9')
            number[length++] = *from;
    number[length] = '\0';
}

static bool run_bgolly(const packard_scene *scene, const char *algorithm, const char *pattern, child_report *report)
{
    char steps[WORD];
    snprintf(steps, sizeof steps, "%" PRId64, scene->steps);
    const char *const words[] = {"bgolly", "-a", algorithm, "-M", "20000", "-m", steps, "-i", steps, pattern, NULL};
    return child_run(child_exec, words, report);
}

/* ---- measuring ---- */

static bool run_engine(const plan *work, const packard_scene *scene, int engine, const char *pattern,
                       child_report *report)
{
    if (engine < FIRST_OF_OURS)
        return run_bgolly(scene, engine == 0 ? "QuickLife" : "HashLife", pattern, report);
    static const snow_packard_engine ours[] = {SNOW_PACKARD_ENGINE_AUTO, SNOW_PACKARD_ENGINE_TILES,
                                               SNOW_PACKARD_ENGINE_QUADTREE, SNOW_PACKARD_ENGINE_REFERENCE};
    run wanted = {scene, ours[engine - FIRST_OF_OURS], work->isa, work->threads};
    return child_run(grow, &wanted, report);
}

static void measure(const plan *work, const packard_scene *scene, const char *pattern, size_t round, figure *entry)
{
    child_report report;
    if (!run_engine(work, scene, entry->engine, pattern, &report)) {
        fprintf(stderr, "%s: %s: %s failed\n", program_name, scene->name, engine_names[entry->engine]);
        entry->wrong = true;
        return;
    }
    entry->seconds[round] = report.seconds;
    entry->elapsed[round] = report.elapsed;
    entry->peak[round] = 1e-6 * (double)report.peak;
    if (entry->engine < FIRST_OF_OURS)
        last_number(report.answer, entry->population);
    else
        snprintf(entry->population, WORD, "%.*s", (int)strcspn(report.answer, "\n"), report.answer);
}

/* Every population must be the one that is known, or else that of the first engine. */
static bool check(const packard_scene *scene, figure *figures, size_t count)
{
    bool right = true;
    const char *wanted = scene->population != NULL ? scene->population : figures[0].population;
    for (size_t i = 0; i < count; i++) {
        if (!figures[i].wrong && strcmp(figures[i].population, wanted) != 0) {
            fprintf(stderr, "%s: %s: WRONG RESULT: %s counts %s, wanted %s\n", program_name, scene->name,
                    engine_names[figures[i].engine], figures[i].population, wanted);
            figures[i].wrong = true;
        }
        right = right && !figures[i].wrong;
    }
    return right;
}

/* How many times faster than the first: the median of the rounds' ratios. */
static double ratio_of(const figure *entry, const figure *first, size_t rounds)
{
    static double values[MOST_ROUNDS];
    for (size_t round = 0; round < rounds; round++)
        values[round] = first->seconds[round] / entry->seconds[round];
    return timing_median(values, rounds);
}

static void report(const plan *work, const packard_scene *scene, figure *figures, size_t count, FILE *csv)
{
    printf("\n%s: %s, %" PRId64 " steps, population %s\n", scene->name, scene->what, scene->steps,
           figures[0].population);
    printf("  engine    | seconds: min    median       max   ratio |  elapsed |  peak MB\n");
    static double ratios[ENGINES];
    for (size_t i = 0; i < count; i++)
        ratios[i] = ratio_of(&figures[i], &figures[0], work->rounds);
    for (size_t i = 0; i < count; i++) {
        if (figures[i].wrong || figures[0].wrong)
            continue;
        double median = timing_median(figures[i].seconds, work->rounds);
        double elapsed = timing_median(figures[i].elapsed, work->rounds);
        double peak = timing_median(figures[i].peak, work->rounds);
        double least = figures[i].seconds[0];
        double greatest = figures[i].seconds[work->rounds - 1];
        printf("  %-9s | %12.4f %9.4f %9.4f %7.2f | %8.4f | %8.1f\n", engine_names[figures[i].engine], least, median,
               greatest, ratios[i], elapsed, peak);
        if (csv != NULL)
            fprintf(csv, "%s,%s,%s,%d,%" PRId64 ",%s,%zu,%.4f,%.4f,%.4f,%.3f,%.4f,%.1f\n", scene->name,
                    engine_names[figures[i].engine], snow_isa_name(work->isa), (int)work->threads, scene->steps,
                    figures[i].population, work->rounds, least, median, greatest, ratios[i], elapsed, peak);
    }
    fflush(stdout);
}

static bool bench_scene(const plan *work, const packard_scene *scene, FILE *csv)
{
    static figure figures[ENGINES];
    size_t count = 0;
    memset(figures, 0, sizeof figures);
    for (int engine = 0; engine < ENGINES; engine++)
        if (scene->engines & work->engines & 1u << engine)
            figures[count++].engine = engine;
    if (count == 0)
        return true;
    char pattern[] = "/tmp/snowgrowth-XXXXXX";
    int descriptor = mkstemp(pattern);
    FILE *file = descriptor >= 0 ? fdopen(descriptor, "w") : NULL;
    if (file == NULL)
        arguments_fail("%s: %s", pattern, strerror(errno));
    write_pattern(scene, file);
    fclose(file);
    for (size_t round = 0; round < work->rounds; round++)
        for (size_t i = 0; i < count; i++)
            if (!figures[i].wrong)
                measure(work, scene, pattern, round, &figures[i]);
    unlink(pattern);
    bool right = check(scene, figures, count);
    report(work, scene, figures, count, csv);
    return right;
}

/* ---- the command line ---- */

static void print_help(void)
{
    printf("usage: %s [options]\n"
           "Grows named scenes of Packard's model with each engine, each run in a process of its own, one after the\n"
           "other, round after round, and reports processor time and peak memory. bgolly's algorithms come first\n"
           "where it is installed. A wrong count of frozen cells fails with exit status 1.\n\n"
           "  --list             the scenes, one a line\n"
           "  --scene NAME       only this scene; may be repeated (default: all that are not slow)\n"
           "  --engine LIST      of quicklife, hashlife, auto, tiles, quadtree, reference (default: all)\n"
           "  --isa NAME         auto, baseline, avx2 or avx512 (default: auto)\n"
           "  --threads N        of our engines (default: 1)\n"
           "  --repeat N         rounds (default: 5)\n"
           "  --csv FILE         append the figures to FILE\n"
           "  --date TEXT        date to note in FILE\n"
           "  --help             this text\n",
           program_name);
}

static void list_scenes(void)
{
    for (size_t i = 0; i < SCENES; i++)
        printf("%-14s %s, %" PRId64 " steps%s\n", scenes[i].name, scenes[i].what, scenes[i].steps,
               scenes[i].slow ? " (slow: only when named)" : "");
}

static void add_scene(plan *work, const char *name)
{
    for (size_t i = 0; i < SCENES; i++) {
        if (strcmp(scenes[i].name, name) != 0)
            continue;
        if (work->count == MOST_SCENES)
            arguments_fail("more than %d scenes", MOST_SCENES);
        work->chosen[work->count++] = &scenes[i];
        return;
    }
    arguments_fail("there is no scene '%s'; --list shows them all", name);
}

static unsigned read_engines(const char *list)
{
    unsigned engines = 0;
    char word[WORD];
    while (arguments_next_word(&list, word, sizeof word)) {
        int engine = 0;
        while (engine < ENGINES && strcmp(engine_names[engine], word) != 0)
            engine++;
        if (engine == ENGINES)
            arguments_fail("there is no engine '%s'", word);
        engines |= 1u << engine;
    }
    return engines;
}

static snow_isa read_isa(const char *name)
{
    static const snow_isa isas[] = {SNOW_ISA_AUTO, SNOW_ISA_BASELINE, SNOW_ISA_AVX2, SNOW_ISA_AVX512};
    for (size_t i = 0; i < sizeof isas / sizeof isas[0]; i++)
        if (strcmp(snow_isa_name(isas[i]), name) == 0 && snow_isa_available(isas[i]))
            return isas[i];
    arguments_fail("instruction set '%s' cannot be used here", name);
}

static void plan_read(plan *work, int count, char **arguments)
{
    enum { LIST, SCENE, ENGINE, ISA, THREADS, REPEAT, CSV, DATE, HELP };
    static const struct option options[] = {
        {"list", no_argument, NULL, LIST},          {"scene", required_argument, NULL, SCENE},
        {"engine", required_argument, NULL, ENGINE}, {"isa", required_argument, NULL, ISA},
        {"threads", required_argument, NULL, THREADS}, {"repeat", required_argument, NULL, REPEAT},
        {"csv", required_argument, NULL, CSV},       {"date", required_argument, NULL, DATE},
        {"help", no_argument, NULL, HELP},           {NULL, 0, NULL, 0},
    };
    *work = (plan){.engines = (1u << ENGINES) - 1, .isa = SNOW_ISA_AUTO, .threads = 1, .rounds = 5};
    for (int option = 0; (option = getopt_long(count, arguments, "", options, NULL)) != -1;) {
        switch (option) {
        case LIST: list_scenes(); exit(0);
        case SCENE: add_scene(work, optarg); break;
        case ENGINE: work->engines = read_engines(optarg); break;
        case ISA: work->isa = read_isa(optarg); break;
        case THREADS: work->threads = (int32_t)arguments_integer("--threads", optarg, 1, 256); break;
        case REPEAT: work->rounds = (size_t)arguments_integer("--repeat", optarg, 1, MOST_ROUNDS); break;
        case CSV: work->csv_path = optarg; break;
        case DATE: work->date = optarg; break;
        case HELP: print_help(); exit(0);
        default: exit(2); /* getopt_long has told why */
        }
    }
    if (optind < count)
        arguments_fail("'%s' is not an option", arguments[optind]);
    bool all = work->count == 0;
    for (size_t i = 0; all && i < SCENES; i++)
        if (!scenes[i].slow)
            add_scene(work, scenes[i].name);
}

int main(int argument_count, char **arguments)
{
    static plan work;
    plan_read(&work, argument_count, arguments);
    if ((work.engines & (QUICKLIFE | HASHLIFE)) && !bgolly_is_here()) {
        printf("bgolly is not installed: nothing to compare with\n");
        work.engines &= ~(unsigned)(QUICKLIFE | HASHLIFE);
    }
    FILE *csv = csv_open(work.csv_path, "scene,engine,isa,threads,steps,population,rounds,seconds_min,seconds_median,"
                         "seconds_max,ratio,elapsed,peak_mb", argument_count, arguments, work.date);
    bool right = true;
    for (size_t i = 0; i < work.count; i++)
        right = bench_scene(&work, work.chosen[i], csv) && right;
    if (!csv_close(csv))
        arguments_fail("%s could not be written", work.csv_path);
    return right ? 0 : 1;
}
