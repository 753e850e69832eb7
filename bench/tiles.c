/*
 * snowgrowth-tiles-bench: what the tile engine of Packard's model does within: tiles visited, cells computed, and
 * its inner loop alone. README.md tells how to read the figures.
 */
#include "arguments.h"
#include "timing.h"

#include "packard/tiles_plane.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const program_name = "snowgrowth-tiles-bench";

enum { ROUNDS = 5, TILE_CELLS = SNOW_TILE_SIDE * SNOW_TILE_SIDE };

static const snow_isa isas[] = {SNOW_ISA_BASELINE, SNOW_ISA_AVX2, SNOW_ISA_AVX512};
enum { ISAS = sizeof isas / sizeof isas[0] };

/* 0100000 and 0101010 have code of their own, 0100100 has not. */
static const struct {
    const char *name;
    uint8_t freezes;
} rules[] = {{"0100000", 0x02}, {"0101010", 0x2A}, {"0100100", 0x12}};
enum { RULES = sizeof rules / sizeof rules[0] };

static snow_heap start_heap(void)
{
    snow_options options;
    snow_options_init(&options, sizeof options);
    snow_heap heap;
    snow_heap_start(&heap, &options);
    return heap;
}

static void must(snow_status status)
{
    if (status != SNOW_OK)
        arguments_fail("%s", snow_strerror(status));
}

/* ---- the inner loop: a torus whose tiles are all visited in every step ---- */

static double seconds_a_tile(snow_isa isa, uint8_t freezes, int64_t tiles_across)
{
    enum { VISITS = 400000 };
    snow_heap heap = start_heap();
    snow_tiles *tiles;
    int64_t side = tiles_across * SNOW_TILE_SIDE;
    snow_tiles_plan plan = {.freezes = freezes, .isa = isa, .width = side, .height = side};
    must(snow_tiles_create(&tiles, &heap, &plan));
    must(snow_tiles_cover(tiles, 0, 0, side, side));
    must(snow_tiles_set(tiles, side / 2, side / 2));
    size_t count = tiles->changed.count;
    snow_tile **list = malloc(count * sizeof *list);
    if (list == NULL)
        arguments_fail("no memory");
    tile_pass pass = {.kernel = tiles->kernel, .freezes = freezes};
    double start = timing_processor();
    for (size_t visits = 0; visits < VISITS; visits += count) {
        memcpy(list, tiles->changed.tile, count * sizeof *list);
        pass.kernel->advance(&pass, list, count);
        pass.phase = 1 - pass.phase;
    }
    double seconds = timing_processor() - start;
    free(list);
    snow_tiles_destroy(tiles);
    return seconds / VISITS;
}

static void bench_kernel(int64_t tiles_across)
{
    static double times[ISAS][RULES][ROUNDS];
    printf("\nkernel, %d x %d tiles, every tile in every step\n  isa      rule    | ns/tile: min  median | Gcells/s\n",
           (int)tiles_across, (int)tiles_across);
    for (int round = 0; round < ROUNDS; round++)
        for (int isa = 0; isa < ISAS; isa++)
            for (int rule = 0; rule < RULES; rule++)
                if (snow_isa_available(isas[isa]))
                    times[isa][rule][round] = seconds_a_tile(isas[isa], rules[rule].freezes, tiles_across);
    for (int isa = 0; isa < ISAS; isa++) {
        for (int rule = 0; rule < RULES && snow_isa_available(isas[isa]); rule++) {
            double median = timing_median(times[isa][rule], ROUNDS);
            printf("  %-8s %s | %12.1f %7.1f | %8.1f\n", snow_isa_name(isas[isa]), rules[rule].name,
                   1e9 * times[isa][rule][0], 1e9 * median, 1e-9 * TILE_CELLS / median);
        }
    }
}

/* ---- crystals ---- */

typedef struct crystal {
    double seconds;
    uint64_t frozen, tiles, visits, memory;
} crystal;

static crystal grow(uint8_t freezes, int64_t steps, bool folded)
{
    snow_heap heap = start_heap();
    snow_tiles *plane;
    double start = timing_processor();
    must(snow_tiles_create(&plane, &heap, &(snow_tiles_plan){.freezes = freezes, .folded = folded}));
    must(snow_tiles_set(plane, 0, 0));
    must(snow_tiles_advance(plane, steps));
    snow_tiles_census census;
    snow_tiles_count(plane, &census);
    double seconds = timing_processor() - start;
    crystal grown = {seconds, census.frozen, snow_tiles_number(plane), snow_tiles_visits(plane), heap.used};
    snow_tiles_destroy(plane);
    return grown;
}

static void bench_crystal(uint8_t freezes, int64_t steps, bool folded)
{
    double seconds[ROUNDS];
    crystal grown;
    for (int round = 0; round < ROUNDS; round++) {
        grown = grow(freezes, steps, folded);
        seconds[round] = grown.seconds;
    }
    double median = timing_median(seconds, ROUNDS);
    double visits = (double)grown.visits;
    printf("  %6" PRId64 " %-6s | %9.4f | %10" PRIu64 " %8" PRIu64 " %9" PRIu64 " | %8.1f %8.1f %9.1f | %7.2f\n", steps,
           folded ? "yes" : "no", median, grown.frozen, grown.tiles, grown.visits, 1e9 * median / visits,
           1e-9 * TILE_CELLS * visits / median, 1e-6 * (double)grown.frozen / median, 1e-6 * (double)grown.memory);
    fflush(stdout);
}

int main(int argument_count, char **arguments)
{
    if (argument_count > 2 || (argument_count == 2 && strcmp(arguments[1], "--short") != 0))
        arguments_fail("usage: %s [--short]", program_name);
    int64_t most = argument_count == 2 ? 2000 : 16000;
    bench_kernel(4);
    bench_kernel(32);
    for (int rule = 0; rule < 2; rule++) {
        printf("\n%s from one seed\n   steps folded |   seconds |     frozen    tiles    visits | ns/visit Gcells/s "
               "Mfrozen/s |      MB\n", rules[rule].name);
        for (int64_t steps = 1000; steps <= most; steps *= 2)
            for (int folded = 1; folded >= 0; folded--)
                bench_crystal(rules[rule].freezes, steps, folded);
    }
    return 0;
}
