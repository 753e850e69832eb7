/* Saved grids: any bytes. The first byte chooses the model whose envelope, with a sound checksum, is put round the
   rest, so that the model's own checks are reached; or that the rest is taken as it is. */
#include "fuzz.h"

#include "base/bytes.h"

#include <string.h>

enum { MOST = 8192 };

typedef struct wrapped {
    unsigned char bytes[MOST];
    size_t size;
} wrapped;

static int append(void *context, const void *bytes, size_t size)
{
    wrapped *all = context;
    if (all->size + size > MOST)
        return 1;
    memcpy(all->bytes + all->size, bytes, size);
    all->size += size;
    return 0;
}

static void wrap(wrapped *all, uint32_t model, fuzz_input *input)
{
    snow_sink sink;
    snow_sink_start(&sink, append, all);
    for (const char *c = "SNOWGRID"; *c != '\0'; c++)
        snow_sink_u8(&sink, (uint8_t)*c);
    snow_sink_u32(&sink, 1);
    snow_sink_u32(&sink, model);
    while (fuzz_left(input) > 0)
        snow_sink_u8(&sink, fuzz_byte(input));
    snow_sink_end(&sink);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size > MOST - 64)
        return 0;
    fuzz_input input = fuzz_start(data, size);
    uint8_t choice = fuzz_byte(&input);
    snow_options options = fuzz_options(&input);
    snow_grid *grid = NULL;
    snow_status status;
    if (choice % 8 == 0) {
        status = snow_load(input.next, fuzz_left(&input), &options, &grid);
    } else {
        wrapped all = {.size = 0};
        wrap(&all, choice % 8, &input);
        status = snow_load(all.bytes, all.size, &options, &grid);
    }
    REQUIRE((status == SNOW_OK) == (grid != NULL));
    if (status != SNOW_OK)
        return 0;
    fuzz_query(grid);
    fuzz_save_and_load(grid, 1 + choice / 8 % 4);
    if (fuzz_is_quick(grid))
        (void)snow_step(grid, 1);
    fuzz_draw(grid);
    snow_destroy(grid);
    return 0;
}
