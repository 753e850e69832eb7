/*
 * snowgrowth-soak: random scenes of all models, one after the other, for as long as it is told to. The fast engines
 * must give the bits of the references, every byte must come back, and the process must not grow.
 */
#include "soak.h"

#include "../../bench/arguments.h"

#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

const char *const program_name = "snowgrowth-soak";

static const struct {
    const char *name;
    soak_scene grow;
} models[] = {{"reiter", soak_reiter}, {"packard", soak_packard}, {"aggregate", soak_aggregate}};

enum { MODELS = COUNT_OF(models), QUARTERS = 4, MEGABYTE = 1 << 20 };

/* What is left in the process after a scene may grow by this much from the first quarter to the last. The address
 * sanitizer keeps up to 256 MB of what is freed, to see it used; there its own report of leaks has to do. */
#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define ADDRESS_SANITIZER
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(ADDRESS_SANITIZER)
static const uint64_t growth_allowed = (uint64_t)1024 * MEGABYTE;
#else
static const uint64_t growth_allowed = 16 * MEGABYTE;
#endif

typedef struct plan {
    int64_t seconds;
    int64_t scenes;
    uint64_t seed;
    const char *model; /* NULL: all in turn */
} plan;

/* What the process that grows tells the one that watches it, in shared memory. */
typedef struct record {
    plan work;
    uint64_t seed; /* of the scene that is being grown */
    uint64_t scenes[MODELS];
    uint64_t least_left[QUARTERS]; /* bytes that were in memory after a scene, at least */
    uint64_t most_left;
    double slowest; /* seconds of one scene */
    uint64_t slowest_seed;
} record;

static double now(void)
{
    struct timespec time;
    (void)clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + (double)time.tv_nsec / 1e9;
}

static void print_help(void)
{
    printf("usage: %s [options]\n"
           "Grows random scenes with all engines and compares them. A scene that fails is named by its seed.\n\n"
           "  --seconds N     for so long (default: 60)\n"
           "  --scenes N      at most so many scenes (default: no limit)\n"
           "  --seed N        seed of the first scene; the next have the next numbers (default: 1)\n"
           "  --model NAME    only this model: reiter, packard, aggregate\n"
           "  --verbose       say what is done\n"
           "  --help          this text\n\n"
           "To grow one scene again: %s --model NAME --scenes 1 --seed N --verbose\n",
           program_name, program_name);
}

static void read_arguments(plan *work, int count, char **arguments)
{
    enum { SECONDS, SCENES, SEED, MODEL, VERBOSE, HELP };
    static const struct option options[] = {
        {"seconds", required_argument, NULL, SECONDS},
        {"scenes", required_argument, NULL, SCENES},
        {"seed", required_argument, NULL, SEED},
        {"model", required_argument, NULL, MODEL},
        {"verbose", no_argument, NULL, VERBOSE},
        {"help", no_argument, NULL, HELP},
        {NULL, 0, NULL, 0},
    };
    *work = (plan){.seconds = 60, .scenes = INT64_MAX, .seed = 1};
    for (int option = 0; (option = getopt_long(count, arguments, "", options, NULL)) != -1;) {
        switch (option) {
        case SECONDS: work->seconds = arguments_integer("--seconds", optarg, 1, INT32_MAX); break;
        case SCENES: work->scenes = arguments_integer("--scenes", optarg, 1, INT64_MAX); break;
        case SEED: work->seed = (uint64_t)arguments_integer("--seed", optarg, 0, INT64_MAX); break;
        case MODEL: work->model = optarg; break;
        case VERBOSE: soak_talks = true; break;
        case HELP: print_help(); exit(0);
        default: exit(2); /* getopt_long has told why */
        }
    }
    if (optind < count)
        arguments_fail("'%s' is not an option", arguments[optind]);
    bool known = work->model == NULL;
    for (size_t i = 0; i < MODELS; i++)
        known = known || strcmp(work->model, models[i].name) == 0;
    if (!known)
        arguments_fail("there is no model '%s'", work->model);
}

/* Bytes of this process that are in memory; 0 where the system does not tell. */
static uint64_t resident_bytes(void)
{
    unsigned long long total = 0, resident = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file == NULL)
        return 0;
    if (fscanf(file, "%llu %llu", &total, &resident) != 2)
        resident = 0;
    (void)fclose(file);
    return (uint64_t)resident * (uint64_t)sysconf(_SC_PAGESIZE);
}

static size_t model_of(const plan *work, uint64_t seed)
{
    for (size_t i = 0; work->model != NULL && i < MODELS; i++)
        if (strcmp(work->model, models[i].name) == 0)
            return i;
    return (size_t)(seed % MODELS);
}

/* Neighbouring seeds give unrelated streams: Steele, Lea and Flood's finaliser (SplitMix64). */
static uint64_t stream_of(uint64_t seed)
{
    uint64_t mixed = (seed + 1) * UINT64_C(0x9e3779b97f4a7c15);
    mixed = (mixed ^ mixed >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    mixed = (mixed ^ mixed >> 27) * UINT64_C(0x94d049bb133111eb);
    return mixed ^ mixed >> 31;
}

static void note_memory(record *shared, double part)
{
    size_t quarter = part < 1 ? (size_t)(part * QUARTERS) : QUARTERS - 1;
    uint64_t left = resident_bytes();
    if (shared->least_left[quarter] == 0 || left < shared->least_left[quarter])
        shared->least_left[quarter] = left;
    if (left > shared->most_left)
        shared->most_left = left;
}

static void grow_scenes(void **state)
{
    record *shared = *state;
    const plan *work = &shared->work;
    double start = now(), before = start;
    for (int64_t i = 0; i < work->scenes && before - start < (double)work->seconds; i++) {
        shared->seed = work->seed + (uint64_t)i;
        size_t model = model_of(work, shared->seed);
        say("seed %" PRIu64 ", %s", shared->seed, models[model].name);
        uint64_t random = stream_of(shared->seed);
        models[model].grow(&random);
        shared->scenes[model]++;

        double after = now();
        if (after - before > shared->slowest) {
            shared->slowest = after - before;
            shared->slowest_seed = shared->seed;
        }
        before = after;
        double by_count = (double)(i + 1) / (double)work->scenes, by_time = (after - start) / (double)work->seconds;
        note_memory(shared, by_count > by_time ? by_count : by_time);
    }
    soak_judge_law();
}

static bool report(const record *shared, int how)
{
    const plan *work = &shared->work;
    for (size_t i = 0; i < MODELS; i++)
        printf("%-9s %" PRIu64 " scenes\n", models[i].name, shared->scenes[i]);
    printf("memory    at least %.1f, %.1f, %.1f, %.1f MB left after a scene in the four quarters, at most %.1f MB\n",
           (double)shared->least_left[0] / MEGABYTE, (double)shared->least_left[1] / MEGABYTE,
           (double)shared->least_left[2] / MEGABYTE, (double)shared->least_left[3] / MEGABYTE,
           (double)shared->most_left / MEGABYTE);
    printf("slowest   %.1f s, seed %" PRIu64 "\n", shared->slowest, shared->slowest_seed);
    if (!WIFEXITED(how) || WEXITSTATUS(how) != 0) {
        if (WIFSIGNALED(how))
            printf("signal    %d\n", WTERMSIG(how));
        printf("FAILED    %s --model %s --scenes 1 --seed %" PRIu64 "\n", program_name,
               models[model_of(work, shared->seed)].name, shared->seed);
        return false;
    }
    if (shared->least_left[0] != 0 && shared->least_left[QUARTERS - 1] > shared->least_left[0] + growth_allowed) {
        printf("FAILED    the process grows\n");
        return false;
    }
    printf("passed    seeds %" PRIu64 " to %" PRIu64 "\n", work->seed, shared->seed);
    return true;
}

int main(int count, char **arguments)
{
    plan work;
    read_arguments(&work, count, arguments);
    record *shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED)
        arguments_fail("no shared memory");
    shared->work = work;
    fflush(NULL);
    pid_t child = fork();
    if (child < 0)
        arguments_fail("no second process");
    if (child == 0) {
        const struct CMUnitTest scenes[] = {cmocka_unit_test_prestate(grow_scenes, shared)};
        exit(cmocka_run_group_tests(scenes, NULL, NULL));
    }
    int how = 0;
    if (waitpid(child, &how, 0) != child)
        arguments_fail("the process that grew is lost");
    return report(shared, how) ? 0 : 1;
}
