#include "plan.h"

#include "arguments.h"
#include "machine.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void print_help(void)
{
    printf("usage: %s [options]\n"
           "Grows named scenes with each variant asked for, one after the other, round after round, and reports\n"
           "million cell updates a second. A wrong result fails with exit status 1.\n\n"
           "  --list             the scenes, one a line\n"
           "  --scene NAME       only this scene; may be repeated (default: all that are not slow)\n"
           "  --engine LIST      of plain, auto, rows, reference, quad (default: plain,rows)\n"
           "  --isa LIST         of auto, baseline, avx2, avx512, or all that run here (default: auto)\n"
           "  --threads LIST     thread counts, 0: one per processor (default: 1)\n"
           "  --repeat N         rounds (default: 5)\n"
           "  --min-seconds S    least time of one measurement, filled with repeated runs (default: 0.2)\n"
           "  --steps N          end each scene after N steps at the latest\n"
           "  --no-copy          do not measure the copy bandwidth\n"
           "  --csv FILE         append the figures to FILE\n"
           "  --date TEXT        date to note in FILE\n"
           "  --help             this text\n",
           program_name);
}

static void add_way(plan *work, variant way)
{
    if (work->way_count == MOST_VARIANTS)
        arguments_fail("more than %d variants", MOST_VARIANTS);
    work->ways[work->way_count++] = way;
}

static void add_threads(plan *work, variant way, const char *threads)
{
    char word[16];
    while (arguments_next_word(&threads, word, sizeof word)) {
        way.threads = (int32_t)arguments_integer("--threads", word, 0, MOST_THREADS);
        if (way.threads == 0)
            way.threads = machine_processors();
        add_way(work, way);
    }
}

static const snow_isa all_isas[] = {SNOW_ISA_AUTO, SNOW_ISA_BASELINE, SNOW_ISA_AVX2, SNOW_ISA_AVX512};

static snow_isa find_isa(const char *name)
{
    for (size_t i = 0; i < sizeof all_isas / sizeof all_isas[0]; i++) {
        if (strcmp(snow_isa_name(all_isas[i]), name) != 0)
            continue;
        if (!snow_isa_available(all_isas[i]))
            arguments_fail("instruction set %s cannot be used here", name);
        return all_isas[i];
    }
    arguments_fail("there is no instruction set '%s'", name);
}

static void add_isas(plan *work, variant way, const char *isas, const char *threads)
{
    char word[16];
    while (arguments_next_word(&isas, word, sizeof word)) {
        if (strcmp(word, "all") == 0) {
            for (size_t i = 1; i < sizeof all_isas / sizeof all_isas[0]; i++) {
                way.isa = all_isas[i];
                if (snow_isa_available(way.isa))
                    add_threads(work, way, threads);
            }
        } else {
            way.isa = find_isa(word);
            add_threads(work, way, threads);
        }
    }
}

/* Every engine with every instruction set and thread count; those that know neither, once. */
static void add_engines(plan *work, const char *engines, const char *isas, const char *threads)
{
    char word[16];
    while (arguments_next_word(&engines, word, sizeof word)) {
        variant way;
        if (!variant_find(word, &way))
            arguments_fail("there is no engine '%s'", word);
        if (variant_has_settings(&way))
            add_isas(work, way, isas, threads);
        else
            add_way(work, way);
    }
    if (work->way_count == 0)
        arguments_fail("no engine, instruction set or thread count is left to measure");
}

static void add_scene(plan *work, snow_scene scene)
{
    if (work->scene_count == MOST_SCENES)
        arguments_fail("more than %d scenes", MOST_SCENES);
    work->scenes[work->scene_count++] = scene;
}

static void add_quick_scenes(plan *work)
{
    snow_scene scene;
    for (size_t i = 0; scene_get(i, &scene); i++)
        if (!scene.slow)
            add_scene(work, scene);
}

void plan_read(plan *work, int count, char **arguments)
{
    enum { LIST, SCENE, ENGINE, ISA, THREADS, REPEAT, MIN_SECONDS, STEPS, NO_COPY, CSV, DATE, HELP };
    static const struct option options[] = {
        {"list", no_argument, NULL, LIST},
        {"scene", required_argument, NULL, SCENE},
        {"engine", required_argument, NULL, ENGINE},
        {"isa", required_argument, NULL, ISA},
        {"threads", required_argument, NULL, THREADS},
        {"repeat", required_argument, NULL, REPEAT},
        {"min-seconds", required_argument, NULL, MIN_SECONDS},
        {"steps", required_argument, NULL, STEPS},
        {"no-copy", no_argument, NULL, NO_COPY},
        {"csv", required_argument, NULL, CSV},
        {"date", required_argument, NULL, DATE},
        {"help", no_argument, NULL, HELP},
        {NULL, 0, NULL, 0},
    };
    *work = (plan){.rounds = 5, .least_seconds = 0.2, .copies = true};
    const char *engines = "plain,rows";
    const char *isas = "auto";
    const char *threads = "1";
    for (int option = 0; (option = getopt_long(count, arguments, "", options, NULL)) != -1;) {
        switch (option) {
        case LIST:
            arguments_list_scenes();
            exit(0);
        case SCENE:
            add_scene(work, arguments_scene(optarg));
            break;
        case ENGINE:
            engines = optarg;
            break;
        case ISA:
            isas = optarg;
            break;
        case THREADS:
            threads = optarg;
            break;
        case REPEAT:
            work->rounds = (size_t)arguments_integer("--repeat", optarg, 1, MOST_ROUNDS);
            break;
        case MIN_SECONDS:
            work->least_seconds = arguments_seconds("--min-seconds", optarg);
            break;
        case STEPS:
            work->steps = arguments_integer("--steps", optarg, 1, INT64_MAX);
            break;
        case NO_COPY:
            work->copies = false;
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
    add_engines(work, engines, isas, threads);
    if (work->scene_count == 0)
        add_quick_scenes(work);
}
