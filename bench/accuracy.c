/*
 * snowgrowth-accuracy: work against precision. Every setting grows a scene as fast as it can; its vapour and its ice
 * are then held, step by step, against the same scene in double-double arithmetic. README.md tells how to read the
 * figures.
 */
#include "arguments.h"
#include "course.h"
#include "csv.h"
#include "variant.h"

#include <errno.h>
#include <getopt.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const program_name = "snowgrowth-accuracy";

static const double patience = 5.0; /* seconds after which a run is not repeated */

enum { MOST_SCENES = 64, MOST_MARKS = 16 };

static const char *const usual_scenes[] = {"dendrite-r100", "star",      "sector",      "plate",
                                           "near-tie",      "alpha-0.5", "alpha-2.003", "alpha-2.6"};
static const char *const settings[] = {"reference", "rows", "plain"};

static const char csv_columns[] = "scene,setting,seconds,mcells,stop_step,stop_difference,frozen,first_difference,"
                                  "differing_cells,step,max_error,mean_error";

typedef struct plan {
    snow_scene scenes[MOST_SCENES];
    size_t scene_count;
    int64_t marks[MOST_MARKS]; /* steps to compare at, ascending */
    size_t mark_count;
    int64_t repeats;
    const char *csv_path;
    const char *date;
} plan;

/* A scene in double-double arithmetic. */
typedef struct truth {
    outcome result;
    size_t size;
    uint64_t cells;
    int64_t marks[MOST_MARKS + 1]; /* those before the stop, and the stop */
    size_t mark_count;
    double *inside;
    double *vapour; /* one field for each mark */
    double *freeze_steps;
} truth;

/* How far a setting is from the truth. */
typedef struct distance {
    outcome result;
    double max_error[MOST_MARKS + 1];
    double mean_error[MOST_MARKS + 1];
    int64_t first_difference; /* first step with another ice set; -1: none */
    uint64_t differing_cells; /* at the truth's stop */
} distance;

static void print_help(void)
{
    printf("usage: %s [options]\n"
           "Grows named scenes with each engine and with the plain program, and reports their time and their\n"
           "distance from double-double arithmetic: greatest and mean error of the vapour at chosen steps and at\n"
           "the stop, first step in which the ice differs, cells that differ at the stop, difference of the stop.\n\n"
           "  --list          the scenes, one a line\n"
           "  --scene NAME    only this scene; may be repeated\n"
           "  --at LIST       steps to compare at, ascending (default: 1,10,100,1000)\n"
           "  --repeat N      timed runs of each setting, the shortest counts; none begins after 5 s (default: 3)\n"
           "  --csv FILE      append the figures to FILE\n"
           "  --date TEXT     date to note in FILE\n"
           "  --help          this text\n",
           program_name);
}

static void add_scene(plan *work, const char *name)
{
    if (work->scene_count == MOST_SCENES)
        arguments_fail("more than %d scenes", MOST_SCENES);
    work->scenes[work->scene_count++] = arguments_scene(name);
}

static void read_marks(plan *work, const char *list)
{
    char word[32];
    work->mark_count = 0;
    while (arguments_next_word(&list, word, sizeof word)) {
        if (work->mark_count == MOST_MARKS)
            arguments_fail("--at takes at most %d steps", MOST_MARKS);
        int64_t least = work->mark_count == 0 ? 1 : work->marks[work->mark_count - 1] + 1;
        work->marks[work->mark_count++] = arguments_integer("--at", word, least, INT64_MAX);
    }
}

static void read_arguments(plan *work, int count, char **arguments)
{
    enum { LIST, SCENE, AT, REPEAT, CSV, DATE, HELP };
    static const struct option options[] = {
        {"list", no_argument, NULL, LIST},
        {"scene", required_argument, NULL, SCENE},
        {"at", required_argument, NULL, AT},
        {"repeat", required_argument, NULL, REPEAT},
        {"csv", required_argument, NULL, CSV},
        {"date", required_argument, NULL, DATE},
        {"help", no_argument, NULL, HELP},
        {NULL, 0, NULL, 0},
    };
    work->repeats = 3;
    read_marks(work, "1,10,100,1000");
    for (int option = 0; (option = getopt_long(count, arguments, "", options, NULL)) != -1;) {
        switch (option) {
        case LIST:
            arguments_list_scenes();
            exit(0);
        case SCENE:
            add_scene(work, optarg);
            break;
        case AT:
            read_marks(work, optarg);
            break;
        case REPEAT:
            work->repeats = arguments_integer("--repeat", optarg, 1, 1000);
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
            exit(2); /* getopt_long has told why */
        }
    }
    if (optind < count)
        arguments_fail("'%s' is not an option", arguments[optind]);
    if (work->scene_count > 0)
        return;
    for (size_t i = 0; i < sizeof usual_scenes / sizeof usual_scenes[0]; i++)
        add_scene(work, usual_scenes[i]);
}

/* The shortest of so many runs; of fewer when they take long. */
static const char *time_runs(const variant *way, const snow_scene *scene, int64_t repeats, outcome *best)
{
    double spent = 0.0;
    for (int64_t i = 0; i < repeats && spent < patience; i++) {
        outcome result;
        const char *trouble = variant_run(way, scene, &result);
        if (trouble != NULL)
            return trouble;
        if (i == 0 || result.seconds < best->seconds)
            *best = result;
        spent += result.seconds;
    }
    return NULL;
}

static void choose_marks(truth *exact, const plan *work)
{
    exact->mark_count = 0;
    for (size_t i = 0; i < work->mark_count && work->marks[i] < exact->result.steps; i++)
        exact->marks[exact->mark_count++] = work->marks[i];
    exact->marks[exact->mark_count++] = exact->result.steps;
}

static const char *watch_truth(truth *exact, course *watched)
{
    exact->size = course_size(watched);
    exact->cells = course_cells(watched);
    exact->inside = calloc(exact->size, sizeof *exact->inside);
    exact->vapour = calloc(exact->mark_count * exact->size, sizeof *exact->vapour);
    exact->freeze_steps = calloc(exact->size, sizeof *exact->freeze_steps);
    if (exact->inside == NULL || exact->vapour == NULL || exact->freeze_steps == NULL)
        return "no memory";
    const char *trouble = course_copy_inside(watched, exact->inside);
    for (size_t mark = 0; mark < exact->mark_count && trouble == NULL; mark++) {
        trouble = course_advance(watched, exact->marks[mark]);
        if (trouble == NULL)
            trouble = course_copy_vapour(watched, exact->vapour + mark * exact->size);
    }
    return trouble != NULL ? trouble : course_copy_freeze_steps(watched, exact->freeze_steps);
}

static void compare_vapour(const truth *exact, size_t mark, const double *vapour, distance *from)
{
    const double *wanted = exact->vapour + mark * exact->size;
    double greatest = 0.0;
    double sum = 0.0;
    for (size_t i = 0; i < exact->size; i++) {
        double error = exact->inside[i] * fabs(vapour[i] - wanted[i]);
        greatest = error > greatest ? error : greatest;
        sum += error;
    }
    from->max_error[mark] = greatest;
    from->mean_error[mark] = sum / (double)exact->cells;
}

/* Two ice sets differ first in the earlier of the steps in which a cell froze in the one, and in the other. */
static void compare_ice(const truth *exact, const double *freeze_steps, distance *from)
{
    from->first_difference = -1;
    for (size_t i = 0; i < exact->size; i++) {
        double here = freeze_steps[i];
        double there = exact->freeze_steps[i];
        if (here == there)
            continue;
        from->differing_cells += (here < 0.0) != (there < 0.0);
        double first = here < 0.0 || (there >= 0.0 && there < here) ? there : here;
        if (from->first_difference < 0 || first < (double)from->first_difference)
            from->first_difference = (int64_t)first;
    }
}

static const char *watch_setting(const truth *exact, course *watched, double *field, distance *from)
{
    const char *trouble = NULL;
    for (size_t mark = 0; mark < exact->mark_count && trouble == NULL; mark++) {
        trouble = course_advance(watched, exact->marks[mark]);
        if (trouble == NULL)
            trouble = course_copy_vapour(watched, field);
        if (trouble == NULL)
            compare_vapour(exact, mark, field, from);
    }
    if (trouble == NULL)
        trouble = course_copy_freeze_steps(watched, field);
    if (trouble == NULL)
        compare_ice(exact, field, from);
    return trouble;
}

static double rate_of(const outcome *result)
{
    return 1e-6 * (double)result->cells * (double)result->steps / result->seconds;
}

static void print_truth(const snow_scene *scene, const truth *exact)
{
    printf("\n%s: %s\n%" PRIu64 " cells; quad: %" PRId64 " steps, %" PRIu64 " frozen, %.3f s, %.1f Mcells/s\n",
           scene->name, scene->what, exact->cells, exact->result.steps, exact->result.frozen, exact->result.seconds,
           rate_of(&exact->result));
}

static void print_distance(const char *name, const truth *exact, const distance *from)
{
    printf("  %-9s  %.3f s, %.1f Mcells/s; stop %+" PRId64 " steps; %" PRIu64 " cells differ at the stop",
           name, from->result.seconds, rate_of(&from->result), from->result.steps - exact->result.steps,
           from->differing_cells);
    if (from->first_difference >= 0)
        printf(", ice first in step %" PRId64 "\n", from->first_difference);
    else
        printf("\n");
    for (size_t mark = 0; mark < exact->mark_count; mark++)
        printf("             step %6" PRId64 ": vapour off by at most %.2e, on average %.2e\n", exact->marks[mark],
               from->max_error[mark], from->mean_error[mark]);
}

static void write_distance(FILE *csv, const snow_scene *scene, const char *name, const truth *exact,
                           const distance *from)
{
    for (size_t mark = 0; mark < exact->mark_count; mark++)
        fprintf(csv,
                "%s,%s,%.6f,%.2f,%" PRId64 ",%" PRId64 ",%" PRIu64 ",%" PRId64 ",%" PRIu64 ",%" PRId64 ",%.3e,%.3e\n",
                scene->name, name, from->result.seconds, rate_of(&from->result), from->result.steps,
                from->result.steps - exact->result.steps, from->result.frozen, from->first_difference,
                from->differing_cells, exact->marks[mark], from->max_error[mark], from->mean_error[mark]);
}

static bool complain(const snow_scene *scene, const variant *way, const char *trouble)
{
    if (trouble != NULL)
        fprintf(stderr, "%s: %s: %s: %s\n", program_name, scene->name, way->name, trouble);
    return trouble == NULL;
}

static bool find_truth(const plan *work, const snow_scene *scene, truth *exact)
{
    variant quad;
    variant_find("quad", &quad);
    if (!complain(scene, &quad, time_runs(&quad, scene, 1, &exact->result)))
        return false;
    choose_marks(exact, work);
    course *watched = course_start(&quad, scene);
    const char *trouble = watched != NULL ? watch_truth(exact, watched) : "no memory";
    course_end(watched);
    return complain(scene, &quad, trouble);
}

static bool measure_setting(const plan *work, const snow_scene *scene, const variant *way, const truth *exact,
                            distance *from)
{
    *from = (distance){.first_difference = -1};
    if (!complain(scene, way, time_runs(way, scene, work->repeats, &from->result)))
        return false;
    course *watched = course_start(way, scene);
    double *field = calloc(exact->size, sizeof *field);
    const char *trouble =
        watched != NULL && field != NULL ? watch_setting(exact, watched, field, from) : "no memory";
    free(field);
    course_end(watched);
    return complain(scene, way, trouble);
}

static bool bench_scene(const plan *work, const snow_scene *scene, FILE *csv)
{
    truth exact = {0};
    bool done = find_truth(work, scene, &exact);
    if (done) {
        print_truth(scene, &exact);
        distance none = {.result = exact.result, .first_difference = -1};
        if (csv != NULL)
            write_distance(csv, scene, "quad", &exact, &none);
    }
    for (size_t i = 0; done && i < sizeof settings / sizeof settings[0]; i++) {
        variant way;
        variant_find(settings[i], &way);
        if (!variant_can_grow(&way, scene))
            continue;
        distance from;
        done = measure_setting(work, scene, &way, &exact, &from);
        if (done)
            print_distance(way.name, &exact, &from);
        if (done && csv != NULL)
            write_distance(csv, scene, way.name, &exact, &from);
    }
    fflush(stdout);
    free(exact.inside);
    free(exact.vapour);
    free(exact.freeze_steps);
    return done;
}

int main(int argument_count, char **arguments)
{
    static plan work;
    read_arguments(&work, argument_count, arguments);
    FILE *csv = NULL;
    if (work.csv_path != NULL) {
        csv = csv_open(work.csv_path, csv_columns, argument_count, arguments, work.date);
        if (csv == NULL)
            arguments_fail("%s: %s", work.csv_path, strerror(errno));
    }
    bool done = true;
    for (size_t i = 0; i < work.scene_count; i++)
        done = bench_scene(&work, &work.scenes[i], csv) && done;
    if (csv != NULL && !csv_close(csv))
        arguments_fail("%s could not be written", work.csv_path);
    return done ? 0 : 1;
}
