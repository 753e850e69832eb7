/*
 * snowgrowth-accuracy: work against precision. Every variant grows a scene as fast as it can; its vapour and its ice
 * are then held, step by step, against the same scene in double-double arithmetic. README.md tells how to read the
 * figures.
 */
#include "arguments.h"
#include "csv.h"
#include "settings.h"
#include "truth.h"

#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

const char *const program_name = "snowgrowth-accuracy";

static const double patience = 5.0;       /* seconds after which a variant is not timed again */
static const double least_seconds = 0.02; /* of one variant in one round */

enum { MOST_SCENES = 64 };

static const char *const usual_scenes[] = {"dendrite-r100", "star",        "plate-r60",   "sector",
                                           "near-tie",      "alpha-0.5", "alpha-2.003", "alpha-2.6"};

static const char csv_columns[] =
    "scene,engine,precision,symmetry,tolerance,isa,threads,mcells,seconds,stop_step,stop_difference,frozen,"
    "first_difference,differing_cells,step,max_error,mean_error";

typedef struct plan {
    snow_scene scenes[MOST_SCENES];
    size_t scene_count;
    variant_list variants;
    mark_list marks; /* steps to compare at */
    int64_t rounds;
    const char *csv_path;
    const char *date;
} plan;

/* What one variant did with one scene. */
typedef struct figure {
    variant way;
    outcome result; /* of the shortest run */
    double spent;   /* seconds */
    bool failed;
    distance from;
} figure;

static void print_help(void)
{
    printf("usage: %s [options]\n"
           "Grows named scenes with each variant asked for, and reports its time and its distance from\n"
           "double-double arithmetic: greatest and mean error of the vapour at chosen steps and at the stop,\n"
           "first step in which the ice differs, cells that differ at the stop, difference of the stop.\n\n"
           "  --list             the scenes, one a line\n"
           "  --scene NAME       only this scene; may be repeated\n"
           "%s"
           "                     by default plain, reference and rows in all their settings, with tolerances\n"
           "                     0, 1e-16, 1e-15 ... 1e-4; those above 0 with the automatic instruction set only\n"
           "  --at LIST          steps to compare at, ascending (default: 10,100,1000)\n"
           "  --repeat N         timed rounds over all variants, the shortest run counts; a variant that took\n"
           "                     5 s is not timed again (default: 5)\n"
           "  --csv FILE         append the figures to FILE\n"
           "  --date TEXT        date to note in FILE\n"
           "  --help             this text\n",
           program_name, settings_help);
}

static void add_scene(plan *work, const char *name)
{
    if (work->scene_count == MOST_SCENES)
        arguments_fail("more than %d scenes", MOST_SCENES);
    work->scenes[work->scene_count++] = arguments_scene(name);
}

static void read_marks(mark_list *marks, const char *list)
{
    marks->count = 0;
    for (char word[32]; arguments_next_word(&list, word, sizeof word);) {
        if (marks->count == MOST_MARKS)
            arguments_fail("--at takes at most %d steps", MOST_MARKS);
        int64_t least = marks->count == 0 ? 1 : marks->steps[marks->count - 1] + 1;
        marks->steps[marks->count++] = arguments_integer("--at", word, least, INT64_MAX);
    }
}

/* Tolerances give the same bits with every instruction set, so one is enough for them. */
static void add_variants(variant_list *variants, const setting_lists *words)
{
    variant_list all = {0};
    setting_lists automatic = *words;
    automatic.isas = "auto";
    settings_add(&all, words);
    size_t with_isas = all.count;
    settings_add(&all, &automatic);
    for (size_t i = 0; i < all.count; i++) {
        bool tolerant = all.ways[i].tolerance > 0.0;
        if (tolerant == (i >= with_isas))
            variants->ways[variants->count++] = all.ways[i];
    }
}

static void read_arguments(plan *work, int count, char **arguments)
{
    enum { LIST = SETTINGS, SCENE, AT, REPEAT, CSV, DATE, HELP };
    static const struct option options[] = {
        {"list", no_argument, NULL, LIST},
        {"scene", required_argument, NULL, SCENE},
        SETTING_OPTIONS,
        {"at", required_argument, NULL, AT},
        {"repeat", required_argument, NULL, REPEAT},
        {"csv", required_argument, NULL, CSV},
        {"date", required_argument, NULL, DATE},
        {"help", no_argument, NULL, HELP},
        {NULL, 0, NULL, 0},
    };
    setting_lists words = {
        .engines = "plain,reference,rows",
        .precisions = "double,single",
        .symmetries = "none,auto",
        .tolerances = "0,1e-16,1e-15,1e-14,1e-13,1e-12,1e-11,1e-10,1e-9,1e-8,1e-7,1e-6,1e-5,1e-4",
        .isas = "all",
        .threads = "1",
    };
    work->rounds = 5;
    read_marks(&work->marks, "10,100,1000");
    for (int option = 0; (option = getopt_long(count, arguments, "", options, NULL)) != -1;) {
        switch (option) {
        case LIST:
            arguments_list_scenes();
            exit(0);
        case SCENE:
            add_scene(work, optarg);
            break;
        case AT:
            read_marks(&work->marks, optarg);
            break;
        case REPEAT:
            work->rounds = arguments_integer("--repeat", optarg, 1, 1000);
            break;
        case CSV:
            work->csv_path = optarg;
            break;
        case DATE:
            work->date = optarg;
            break;
        case HELP:
            print_help();
            exit(0);
        default:
            if (!settings_take(&words, option, optarg))
                exit(2); /* getopt_long has told why */
        }
    }
    if (optind < count)
        arguments_fail("'%s' is not an option", arguments[optind]);
    add_variants(&work->variants, &words);
    if (work->scene_count > 0)
        return;
    for (size_t i = 0; i < sizeof usual_scenes / sizeof usual_scenes[0]; i++)
        add_scene(work, usual_scenes[i]);
}

static void complain(const snow_scene *scene, const variant *way, const char *trouble)
{
    fprintf(stderr, "%s: %s: ", program_name, scene->name);
    settings_print(stderr, way);
    fprintf(stderr, ": %s\n", trouble);
}

/* As many runs as fill the least time. NULL, or what went wrong. */
static const char *time_runs(const snow_scene *scene, figure *entry)
{
    double until = entry->spent + least_seconds;
    do {
        outcome result;
        const char *trouble = variant_run(&entry->way, scene, &result);
        if (trouble != NULL)
            return trouble;
        if (entry->spent == 0.0 || result.seconds < entry->result.seconds)
            entry->result = result;
        entry->spent += result.seconds;
    } while (entry->spent < until);
    return NULL;
}

/* All variants one after the other, round after round: what disturbs the machine disturbs each alike. */
static bool measure(const plan *work, const snow_scene *scene, const truth *exact, figure *figures, size_t count)
{
    bool done = true;
    for (int64_t round = 0; round < work->rounds; round++) {
        for (size_t i = 0; i < count; i++) {
            figure *entry = &figures[i];
            if (entry->failed || entry->spent > patience)
                continue;
            const char *trouble = time_runs(scene, entry);
            if (trouble == NULL && round == 0)
                trouble = truth_compare(exact, &entry->way, scene, &entry->from);
            entry->failed = trouble != NULL;
            done = done && !entry->failed;
            if (entry->failed)
                complain(scene, &entry->way, trouble);
        }
    }
    return done;
}

static double rate_of(const outcome *result)
{
    return 1e-6 * (double)result->cells * (double)result->steps / result->seconds;
}

static void print_heading(const snow_scene *scene, const truth *exact)
{
    printf("\n%s: %s\n%" PRIu64 " cells; quad: %" PRId64 " steps, %" PRIu64 " frozen, %.3f s, %.1f Mcells/s\n",
           scene->name, scene->what, exact->result.cells, exact->result.steps, exact->result.frozen,
           exact->result.seconds, rate_of(&exact->result));
    printf("  %s |  Mcells/s | max error  mean error at the stop | ice differs from step  cells   stop\n",
           settings_heading);
}

static void print_figure(const truth *exact, const figure *entry)
{
    const distance *from = &entry->from;
    size_t stop = exact->marks.count - 1;
    printf("  ");
    settings_print(stdout, &entry->way);
    printf(" | %9.1f | %9.2e  %10.2e             |", rate_of(&entry->result), from->max_error[stop],
           from->mean_error[stop]);
    if (from->first_difference < 0)
        printf("%22s", "never");
    else
        printf("%22" PRId64, from->first_difference);
    printf(" %6" PRIu64 "  %+5" PRId64 "\n", from->differing_cells, entry->result.steps - exact->result.steps);
}

static void write_figure(FILE *csv, const snow_scene *scene, const truth *exact, const figure *entry)
{
    const distance *from = &entry->from;
    for (size_t mark = 0; mark < exact->marks.count; mark++) {
        fprintf(csv, "%s,", scene->name);
        settings_write(csv, &entry->way);
        fprintf(csv,
                "%.2f,%.6f,%" PRId64 ",%" PRId64 ",%" PRIu64 ",%" PRId64 ",%" PRIu64 ",%" PRId64 ",%.3e,%.3e\n",
                rate_of(&entry->result), entry->result.seconds, entry->result.steps,
                entry->result.steps - exact->result.steps, entry->result.frozen, from->first_difference,
                from->differing_cells, exact->marks.steps[mark], from->max_error[mark], from->mean_error[mark]);
    }
}

static void report(const snow_scene *scene, const truth *exact, const figure *figures, size_t count, FILE *csv)
{
    print_heading(scene, exact);
    for (size_t i = 0; i < count; i++) {
        if (figures[i].failed)
            continue;
        print_figure(exact, &figures[i]);
        if (csv != NULL)
            write_figure(csv, scene, exact, &figures[i]);
    }
    fflush(stdout);
    if (csv != NULL)
        fflush(csv); /* the next scene may take minutes */
}

static bool bench_scene(const plan *work, const snow_scene *scene, FILE *csv)
{
    static figure figures[MOST_VARIANTS + 1];
    figure quad = {.from.first_difference = -1};
    variant_find("quad", &quad.way);
    truth exact;
    const char *trouble = truth_find(&exact, scene, &work->marks);
    if (trouble != NULL) {
        complain(scene, &quad.way, trouble);
        truth_free(&exact);
        return false;
    }
    quad.result = exact.result;
    size_t count = 0;
    figures[count++] = quad;
    for (size_t i = 0; i < work->variants.count; i++)
        if (variant_can_grow(&work->variants.ways[i], scene))
            figures[count++] = (figure){.way = work->variants.ways[i]};
    bool done = measure(work, scene, &exact, figures + 1, count - 1);
    report(scene, &exact, figures, count, csv);
    truth_free(&exact);
    return done;
}

int main(int argument_count, char **arguments)
{
    static plan work;
    read_arguments(&work, argument_count, arguments);
    FILE *csv = csv_open(work.csv_path, csv_columns, argument_count, arguments, work.date);
    bool done = true;
    for (size_t i = 0; i < work.scene_count; i++)
        done = bench_scene(&work, &work.scenes[i], csv) && done;
    if (!csv_close(csv))
        arguments_fail("%s could not be written", work.csv_path);
    return done ? 0 : 1;
}
