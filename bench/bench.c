/*
 * snowgrowth-bench: how fast the engines grow the scenes that the tests check, and whether they still grow them
 * right. README.md tells how to read the figures.
 */
#include "arguments.h"
#include "copy.h"
#include "csv.h"
#include "plan.h"
#include "timing.h"
#include "variant.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

const char *const program_name = "snowgrowth-bench";

/* What one update of a cell must at least move when the field does not fit a cache: one value read, one written. */
static double update_bytes(const variant *way)
{
    return way->precision == SNOW_REITER_PRECISION_SINGLE ? 2 * sizeof(float) : 2 * sizeof(double);
}

static const char csv_columns[] =
    "scene,engine,precision,symmetry,tolerance,isa,threads,cells,steps,frozen,rounds,mcells_min,mcells_median,"
    "mcells_max,ratio,bytes_per_cell,copy_gb_per_s,copy_share,digest,check";

/* What one variant did with one scene. */
typedef struct figure {
    variant way;
    outcome wanted; /* what the pilot with the same bits gave; of no use where there is none */
    outcome result;
    bool wrong;
    double *rates; /* cell updates a second, round by round */
} figure;

/* Copy bandwidth by number of threads, in bytes a second; 0: not measured. */
typedef double copy_table[MOST_THREADS + 1];

static void measure_copies(const plan *work, copy_table copies)
{
    for (size_t i = 0; i < work->variants.count; i++) {
        int32_t threads = work->variants.ways[i].threads;
        if (copies[threads] > 0.0)
            continue;
        copies[threads] = copy_bandwidth(threads);
        if (copies[threads] > 0.0)
            printf("copy bandwidth, %d thread%s: %.1f GB/s\n", (int)threads, threads > 1 ? "s" : "",
                   1e-9 * copies[threads]);
        else
            fprintf(stderr, "%s: the copy bandwidth of %d threads cannot be measured\n", program_name, (int)threads);
    }
}

static void complain(const snow_scene *scene, const variant *way, const char *trouble)
{
    fprintf(stderr, "%s: %s: ", program_name, scene->name);
    settings_print(stderr, way);
    fprintf(stderr, ": %s\n", trouble);
}

static bool same_result(const outcome *result, const outcome *wanted)
{
    return result->steps == wanted->steps && result->frozen == wanted->frozen && result->digest == wanted->digest;
}

static void complain_result(const snow_scene *scene, const variant *way, const outcome *result,
                            const outcome *wanted)
{
    char text[256];
    snprintf(text, sizeof text,
             "WRONG RESULT: step %" PRId64 ", %" PRIu64 " frozen, digest %016" PRIx64 "; wanted: step %" PRId64
             ", %" PRIu64 " frozen, digest %016" PRIx64,
             result->steps, result->frozen, result->digest, wanted->steps, wanted->frozen, wanted->digest);
    complain(scene, way, text);
}

/*
 * Grows the scene once, untimed, with the automatic engine on one thread: it warms the machine up and is what all
 * variants of the same bits are held against. It must itself give what the scene records.
 */
static bool run_pilot(snow_scene *scene, const variant *way, outcome *pilot)
{
    const char *trouble = variant_run(way, scene, pilot);
    if (trouble != NULL) {
        complain(scene, way, trouble);
        return false;
    }
    outcome wanted = {
        .steps = scene->steps != 0 ? scene->steps : pilot->steps,
        .frozen = scene->frozen != 0 ? scene->frozen : pilot->frozen,
        .digest = scene->digest != 0 ? scene->digest : pilot->digest,
    };
    if (!same_result(pilot, &wanted)) {
        complain_result(scene, way, pilot, &wanted);
        return false;
    }
    if (pilot->reason == SNOW_STOP_STILL)
        scene->stop.max_steps = pilot->steps; /* the plain program cannot tell that nothing will change */
    return true;
}

/* Whether the variant's bits are promised at all. */
static bool is_checked(const variant *way)
{
    return variant_same_bits(way, way);
}

/* What the last of the figures must give. Other bits than the pilot's need a pilot of their own. */
static bool find_wanted(const snow_scene *scene, const variant *pilot_way, const outcome *pilot, figure *figures,
                        size_t last)
{
    figure *entry = &figures[last];
    entry->wanted = *pilot;
    if (!is_checked(&entry->way) || variant_same_bits(&entry->way, pilot_way))
        return true;
    for (size_t i = 0; i < last; i++) {
        entry->wanted = figures[i].wanted;
        if (variant_same_bits(&entry->way, &figures[i].way))
            return true;
    }
    variant own = *pilot_way;
    own.precision = entry->way.precision;
    own.symmetry = entry->way.symmetry;
    own.tolerance = entry->way.tolerance;
    const char *trouble = variant_run(&own, scene, &entry->wanted);
    if (trouble != NULL)
        complain(scene, &own, trouble);
    return trouble == NULL;
}

/* One measurement: as many runs as fill the least time, each held against the pilot. */
static bool measure(const plan *work, const snow_scene *scene, figure *entry, size_t round)
{
    double seconds = 0.0;
    double updates = 0.0;
    do {
        const char *trouble = variant_run(&entry->way, scene, &entry->result);
        if (trouble != NULL) {
            complain(scene, &entry->way, trouble);
            return false;
        }
        if (is_checked(&entry->way) && !same_result(&entry->result, &entry->wanted)) {
            complain_result(scene, &entry->way, &entry->result, &entry->wanted);
            return false;
        }
        seconds += entry->result.seconds;
        updates += (double)entry->result.cells * (double)entry->result.steps;
    } while (seconds < work->least_seconds);
    entry->rates[round] = updates / seconds;
    return true;
}

/* All variants one after the other, round after round: what disturbs the machine disturbs each alike. */
static bool measure_rounds(const plan *work, const snow_scene *scene, figure *figures, size_t count)
{
    bool right = true;
    for (size_t round = 0; round < work->rounds; round++) {
        for (size_t i = 0; i < count; i++) {
            if (!figures[i].wrong)
                figures[i].wrong = !measure(work, scene, &figures[i], round);
            right = right && !figures[i].wrong;
        }
    }
    return right;
}

/* The rounds of a variant, put together. */
typedef struct spread {
    double least; /* million cell updates a second */
    double median;
    double greatest;
    double ratio; /* to the first variant: the median of the rounds' ratios */
} spread;

static spread spread_of(const figure *entry, const figure *first, size_t rounds)
{
    double values[MOST_ROUNDS];
    for (size_t round = 0; round < rounds; round++)
        values[round] = entry->rates[round] / first->rates[round];
    spread over = {.ratio = timing_median(values, rounds)};
    for (size_t round = 0; round < rounds; round++)
        values[round] = 1e-6 * entry->rates[round];
    over.median = timing_median(values, rounds);
    over.least = values[0];
    over.greatest = values[rounds - 1];
    return over;
}

static const char *check_label(const snow_scene *scene, const figure *entry)
{
    if (!is_checked(&entry->way))
        return "none";
    return entry->wanted.digest == scene->digest ? "recorded" : "pilot";
}

static double bytes_per_cell(const outcome *result)
{
    return (double)result->memory / (double)result->cells;
}

static double copy_share(const figure *entry, const spread *over, double bandwidth)
{
    return 1e6 * over->median * update_bytes(&entry->way) / bandwidth;
}

static void print_heading(const snow_scene *scene, const outcome *pilot)
{
    printf("\n%s: %s\n%" PRIu64 " cells, %" PRId64 " steps, %" PRIu64 " frozen, end: %s\n", scene->name, scene->what,
           pilot->cells, pilot->steps, pilot->frozen, snow_stop_name(pilot->reason));
    printf("  %s | Mcells/s: min    median       max   ratio |  B/cell  %% copy |    steps   frozen  check\n",
           settings_heading);
}

static void print_figure(const snow_scene *scene, const figure *entry, const spread *over, double bandwidth)
{
    char share[16] = "-";
    if (bandwidth > 0.0)
        snprintf(share, sizeof share, "%.1f", 100.0 * copy_share(entry, over, bandwidth));
    printf("  ");
    settings_print(stdout, &entry->way);
    printf(" | %13.1f %9.1f %9.1f %7.2f | %7.1f %7s | %8" PRId64 " %8" PRIu64 "  %s\n", over->least, over->median,
           over->greatest, over->ratio, bytes_per_cell(&entry->result), share, entry->result.steps,
           entry->result.frozen, check_label(scene, entry));
}

static void write_figure(FILE *csv, const snow_scene *scene, const figure *entry, const spread *over, size_t rounds,
                         double bandwidth)
{
    const outcome *result = &entry->result;
    fprintf(csv, "%s,", scene->name);
    settings_write(csv, &entry->way);
    fprintf(csv, "%" PRIu64 ",%" PRId64 ",%" PRIu64 ",%zu,%.2f,%.2f,%.2f,%.3f,%.2f,", result->cells, result->steps,
            result->frozen, rounds, over->least, over->median, over->greatest, over->ratio, bytes_per_cell(result));
    if (bandwidth > 0.0)
        fprintf(csv, "%.2f,%.4f", 1e-9 * bandwidth, copy_share(entry, over, bandwidth));
    else
        fprintf(csv, ",");
    if (entry->way.plain)
        fprintf(csv, ",,%s\n", check_label(scene, entry));
    else
        fprintf(csv, ",%016" PRIx64 ",%s\n", result->digest, check_label(scene, entry));
}

static void report(const plan *work, const snow_scene *scene, const figure *figures, size_t count,
                   const copy_table copies, FILE *csv)
{
    for (size_t i = 0; i < count; i++) {
        if (figures[i].wrong || figures[0].wrong)
            continue;
        spread over = spread_of(&figures[i], &figures[0], work->rounds);
        double bandwidth = copies[figures[i].way.threads];
        print_figure(scene, &figures[i], &over, bandwidth);
        if (csv != NULL)
            write_figure(csv, scene, &figures[i], &over, work->rounds, bandwidth);
    }
    fflush(stdout);
}

static bool bench_scene(const plan *work, snow_scene scene, const copy_table copies, FILE *csv)
{
    if (work->steps > 0) {
        scene.stop.max_steps = work->steps;
        scene.steps = 0;
        scene.frozen = 0;
        scene.digest = 0;
    }
    variant pilot_way;
    variant_find("auto", &pilot_way);
    outcome pilot;
    if (!run_pilot(&scene, &pilot_way, &pilot))
        return false;
    static figure figures[MOST_VARIANTS];
    double *rates = calloc(work->variants.count * work->rounds, sizeof *rates);
    if (rates == NULL)
        arguments_fail("no memory");
    size_t count = 0;
    for (size_t i = 0; i < work->variants.count; i++) {
        if (!variant_can_grow(&work->variants.ways[i], &scene))
            continue;
        figures[count] = (figure){.way = work->variants.ways[i], .rates = rates + count * work->rounds};
        figures[count].wrong = !find_wanted(&scene, &pilot_way, &pilot, figures, count);
        count++;
    }
    bool right = measure_rounds(work, &scene, figures, count);
    print_heading(&scene, &pilot);
    report(work, &scene, figures, count, copies, csv);
    free(rates);
    return right;
}

int main(int argument_count, char **arguments)
{
    static plan work;
    static copy_table copies;
    plan_read(&work, argument_count, arguments);
    FILE *csv = csv_open(work.csv_path, csv_columns, argument_count, arguments, work.date);
    if (work.copies)
        measure_copies(&work, copies);
    bool right = true;
    for (size_t i = 0; i < work.scene_count; i++)
        right = bench_scene(&work, work.scenes[i], copies, csv) && right;
    if (!csv_close(csv))
        arguments_fail("%s could not be written", work.csv_path);
    return right ? 0 : 1;
}
