#include "plan.h"

#include "arguments.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>

static void print_help(void)
{
    printf("usage: %s [options]\n"
           "Grows named scenes with each variant asked for, one after the other, round after round, and reports\n"
           "million cell updates a second. A wrong result fails with exit status 1.\n\n"
           "  --list             the scenes, one a line\n"
           "  --scene NAME       only this scene; may be repeated (default: all that are not slow)\n"
           "%s"
           "  --threads LIST     thread counts, 0: one per processor\n"
           "                     by default plain and rows in double precision, with automatic symmetry and\n"
           "                     instruction set, tolerance 0 and 1 thread\n"
           "  --repeat N         rounds (default: 5)\n"
           "  --min-seconds S    least time of one measurement, filled with repeated runs (default: 0.2)\n"
           "  --steps N          end each scene after N steps at the latest\n"
           "  --no-copy          do not measure the copy bandwidth\n"
           "  --csv FILE         append the figures to FILE\n"
           "  --date TEXT        date to note in FILE\n"
           "  --help             this text\n",
           program_name, settings_help);
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
    enum { LIST = SETTINGS, SCENE, THREADS, REPEAT, MIN_SECONDS, STEPS, NO_COPY, CSV, DATE, HELP };
    static const struct option options[] = {
        {"list", no_argument, NULL, LIST},
        {"scene", required_argument, NULL, SCENE},
        SETTING_OPTIONS,
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
    setting_lists words = {
        .engines = "plain,rows",
        .precisions = "double",
        .symmetries = "auto",
        .tolerances = "0",
        .isas = "auto",
        .threads = "1",
    };
    for (int option = 0; (option = getopt_long(count, arguments, "", options, NULL)) != -1;) {
        switch (option) {
        case LIST:
            arguments_list_scenes();
            exit(0);
        case SCENE:
            add_scene(work, arguments_scene(optarg));
            break;
        case THREADS:
            words.threads = optarg;
            break;
        case REPEAT:
            work->rounds = (size_t)arguments_integer("--repeat", optarg, 1, MOST_ROUNDS);
            break;
        case MIN_SECONDS:
            work->least_seconds = arguments_number("--min-seconds", optarg, 0.0, 3600.0);
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
            if (!settings_take(&words, option, optarg))
                exit(2); /* getopt_long has told why */
        }
    }
    if (optind < count)
        arguments_fail("'%s' is not an option", arguments[optind]);
    settings_add(&work->variants, &words);
    if (work->scene_count == 0)
        add_quick_scenes(work);
}
