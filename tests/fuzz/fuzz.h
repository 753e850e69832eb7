/*
 * What the fuzz targets share: values out of any bytes, and questions to any grid. A promise that is broken ends the
 * program with abort(), which the fuzzer notes as a finding.
 */
#ifndef TESTS_FUZZ_FUZZ_H
#define TESTS_FUZZ_FUZZ_H

#include <snowgrowth/snowgrowth.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The entry of every target; the fuzzer's name for it. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define COUNT_OF(array) (sizeof(array) / sizeof(array)[0])

/* The input, taken from its front. Beyond its end everything is zero. */
typedef struct fuzz_input {
    const uint8_t *next;
    const uint8_t *end;
} fuzz_input;

fuzz_input fuzz_start(const uint8_t *data, size_t size);
size_t fuzz_left(const fuzz_input *input);
void fuzz_fill(fuzz_input *input, void *object, size_t size);
uint8_t fuzz_byte(fuzz_input *input);
uint32_t fuzz_u32(fuzz_input *input);
uint64_t fuzz_u64(fuzz_input *input);

/* 0 to limit − 1, of one byte. */
uint32_t fuzz_below(fuzz_input *input, uint32_t limit);

/* Mostly from −8 to 7, at times anything. */
int32_t fuzz_coordinate(fuzz_input *input);

/* Mostly between 0 and 4, at times any double. */
double fuzz_number(fuzz_input *input);

/* Ends the program when a promise is broken. */
void fuzz_require(bool holds, const char *promise);
#define REQUIRE(holds) fuzz_require(holds, #holds)

/* Options with little memory; the input chooses the rest. */
snow_options fuzz_options(fuzz_input *input);

/* Whether the whole of the grid can be read in little time. */
bool fuzz_is_small(const snow_grid *grid);

/* Whether a step takes little time: walkers may come from far, and stick seldom. */
bool fuzz_is_quick(const snow_grid *grid);

/* Asks the grid whatever every model can be asked; the answers must fit each other. */
void fuzz_query(const snow_grid *grid);

/* Draws a small grid. */
void fuzz_draw(const snow_grid *grid);

/* Saves, loads, compares, and takes some steps with both. Only of small grids. */
void fuzz_save_and_load(snow_grid *grid, int64_t steps);

#endif
