/*
 * snowgrowth-quadtree-bench: what the quadtree engine of Packard's model does within: nodes, leaves and memory, and
 * what a memory limit costs. README.md tells how to read the figures.
 */
#include "arguments.h"
#include "timing.h"

#include "packard/quadtree_nodes.h"

#include <inttypes.h>
#include <stdio.h>

const char *const program_name = "snowgrowth-quadtree-bench";

enum { ROUNDS = 5 };

/* One seed, 2^exponent steps, and the population that must come out. */
static const struct {
    const char *name;
    uint8_t rule;
    bool in_short;
    int exponent;
    quadtree_count population;
} runs[] = {
    {"0100000", 0x02, true, 16, {0, UINT64_C(8186583625)}},
    {"0100000", 0x02, false, 20, {0, UINT64_C(2095753148245)}},
    {"0100000", 0x02, false, 24, {0, UINT64_C(536512602096793)}},
    {"0101010", 0x2a, true, 60, {UINT64_C(0x27fffffffffffff), UINT64_C(0xd000000000000009)}},
    {"0101100", 0x1a, true, 60, {UINT64_C(0x2dd1745d1745d17), UINT64_C(0x15d1768e315045ed)}},
};
enum { RUNS = sizeof runs / sizeof runs[0] };

typedef struct outcome {
    double seconds;
    snow_status status;
    uint32_t nodes, leaves;
    uint64_t memory;
    int collections;
} outcome;

static void must(snow_status status)
{
    if (status != SNOW_OK)
        arguments_fail("%s", snow_strerror(status));
}

static void check(int run, snow_quadtree *tree)
{
    quadtree_measures measures;
    must(snow_quadtree_measure(tree, &measures));
    if (measures.population.high != runs[run].population.high || measures.population.low != runs[run].population.low)
        arguments_fail("WRONG RESULT: %s, 2^%d steps", runs[run].name, runs[run].exponent);
}

static outcome grow(int run, uint64_t limit)
{
    const uint64_t seed = 1;
    snow_options options;
    snow_options_init(&options, sizeof options);
    options.memory_limit = limit;
    snow_heap heap;
    snow_heap_start(&heap, &options);
    snow_quadtree *tree;
    double start = timing_processor();
    must(snow_quadtree_create(&heap, runs[run].rule, &tree));
    must(snow_quadtree_put(tree, 0, 0, 1, 1, &seed, 1));
    outcome result = {.status = snow_quadtree_advance(tree, UINT64_C(1) << runs[run].exponent)};
    result.seconds = timing_processor() - start;
    if (result.status == SNOW_OK)
        check(run, tree);
    result.nodes = tree->nodes.used;
    result.leaves = tree->leaves.used;
    result.memory = heap.used;
    result.collections = tree->collections;
    snow_quadtree_destroy(tree);
    return result;
}

static uint64_t bench_run(int run)
{
    double seconds[ROUNDS];
    outcome result = {0};
    for (int round = 0; round < ROUNDS; round++) {
        result = grow(run, 0);
        must(result.status);
        seconds[round] = result.seconds;
    }
    double median = timing_median(seconds, ROUNDS);
    uint32_t patterns = result.nodes + result.leaves;
    printf("  %s 2^%d | %9.4f %9.4f | %9" PRIu32 " %7" PRIu32 " | %7.1f | %8.2f %6.1f\n", runs[run].name,
           runs[run].exponent, seconds[0], median, result.nodes, result.leaves, 1e9 * median / patterns,
           1e-6 * (double)result.memory, (double)result.memory / patterns);
    fflush(stdout);
    return result.memory;
}

static void bench_limits(int run, uint64_t memory)
{
    printf("\n%s to 2^%d with less memory\n  limit, %% | seconds | collections | result\n", runs[run].name,
           runs[run].exponent);
    for (unsigned percent = 90; percent >= 30; percent -= 15) {
        outcome result = grow(run, memory / 100 * percent);
        printf("  %8u | %7.3f | %11d | %s\n", percent, result.seconds, result.collections,
               result.status == SNOW_OK ? "exact" : snow_strerror(result.status));
        fflush(stdout);
    }
}

int main(int argument_count, char **arguments)
{
    if (argument_count > 2 || (argument_count == 2 && strcmp(arguments[1], "--short") != 0))
        arguments_fail("usage: %s [--short]", program_name);
    uint64_t memory[RUNS] = {0};
    printf("one seed\n  rule    steps |     least    median |     nodes  leaves | ns/node |       MB B/node\n");
    for (int run = 0; run < RUNS; run++) {
        if (argument_count == 1 || runs[run].in_short)
            memory[run] = bench_run(run);
    }
    bench_limits(0, memory[0]);
    return 0;
}
