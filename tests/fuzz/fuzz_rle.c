/* Patterns in run-length encoding: any text, and what is written reads the same again. The first two bytes choose the
   options and how the text arrives. */
#include "fuzz.h"

#include <stdlib.h>
#include <string.h>

typedef struct slow_text {
    fuzz_input rest;
    size_t piece;
} slow_text;

static int read_piece(void *context, void *bytes, size_t size, size_t *got)
{
    slow_text *text = context;
    size_t left = fuzz_left(&text->rest);
    *got = text->piece < left ? text->piece : left;
    *got = size < *got ? size : *got;
    fuzz_fill(&text->rest, bytes, *got);
    return 0;
}

static uint64_t digest_of(const snow_grid *grid)
{
    uint64_t digest = 0;
    (void)snow_digest(grid, &digest);
    return digest;
}

/* Patterns hold no domain but torus and rhombus, so the parameters tell it again. */
static void write_and_read(const snow_grid *grid, const snow_packard_params *params, const snow_options *options)
{
    size_t size = 0;
    if (!fuzz_is_small(grid) || snow_packard_save_rle(grid, NULL, 0, &size) != SNOW_OK || size > 65536)
        return;
    char *text = malloc(size);
    snow_grid *again = NULL;
    REQUIRE(text != NULL && snow_packard_save_rle(grid, text, size, &size) == SNOW_OK);
    snow_status status = snow_packard_load_rle(text, size, params, options, &again);
    REQUIRE(status == SNOW_OK || status == SNOW_ERROR_MEMORY_LIMIT);
    if (status == SNOW_OK)
        REQUIRE(digest_of(grid) == digest_of(again));
    snow_destroy(again);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input input = fuzz_start(data, size);
    snow_options options = fuzz_options(&input);
    uint8_t choice = fuzz_byte(&input);
    bool in_pieces = choice >= 224;
    snow_packard_params params;
    snow_packard_params_init(&params, sizeof params);
    if (choice % 7 != 0 && !in_pieces) {
        params.domain = (snow_packard_domain)(choice % 7);
        params.engine = (snow_packard_engine)(choice / 7 % 4);
        params.record_freeze_steps = choice / 28 % 2;
        params.radius = 9;
        params.width = 17;
        params.height = 13;
    }
    snow_grid *grid = NULL;
    snow_status status;
    if (in_pieces) {
        slow_text text = {input, (size_t)choice - 223};
        status = snow_packard_load_rle_from(read_piece, &text, NULL, &options, &grid);
    } else {
        status = snow_packard_load_rle(input.next, fuzz_left(&input), &params, &options, &grid);
    }
    REQUIRE((status == SNOW_OK) == (grid != NULL));
    if (status != SNOW_OK)
        return 0;
    write_and_read(grid, &params, &options);
    (void)snow_step(grid, 2);
    fuzz_query(grid);
    snow_destroy(grid);
    return 0;
}
