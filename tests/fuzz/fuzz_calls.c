/* Any sequence of calls on one grid, with any arguments: whatever comes, the grid stays sound. Each call is a byte and
   what it takes of the rest. */
#include "scenes.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_CALLS = 24, MOST_BYTES = 1 << 16 };

typedef struct handle {
    snow_grid *grid;
    fuzz_input *input;
    unsigned char *saved; /* by the last save */
    size_t saved_size;
} handle;

static void drop(handle *self)
{
    snow_destroy(self->grid);
    self->grid = NULL;
}

static void create(handle *self)
{
    snow_options options = fuzz_options(self->input);
    snow_grid *grid = NULL;
    snow_status status =
        fuzz_create(fuzz_below(self->input, (uint32_t)fuzz_models()), self->input, &options, &grid);
    REQUIRE((status == SNOW_OK) == (grid != NULL));
    if (grid == NULL)
        return;
    drop(self);
    self->grid = grid;
}

static int64_t steps_of(const snow_grid *grid)
{
    int64_t steps = -1;
    REQUIRE(snow_steps(grid, &steps) == SNOW_OK);
    return steps;
}

static void step(handle *self)
{
    uint8_t byte = fuzz_byte(self->input);
    int64_t steps = byte < 0xFC ? byte % 8 : -(int64_t)fuzz_u32(self->input) - 1;
    int64_t before = steps_of(self->grid);
    snow_status status = snow_step(self->grid, steps);
    REQUIRE((status == SNOW_ERROR_RANGE) == (steps < 0));
    if (status == SNOW_OK)
        REQUIRE(steps_of(self->grid) == before + steps);
}

/* What a callback may not do, and what it may. */
static int progress(void *context, const snow_grid *grid, const snow_summary *summary)
{
    handle *self = context;
    snow_grid *busy = (snow_grid *)(uintptr_t)grid;
    double value = 0.5;
    int64_t steps;
    REQUIRE(snow_step(busy, 1) == SNOW_ERROR_BUSY);
    REQUIRE(snow_run(busy, NULL, NULL) == SNOW_ERROR_BUSY);
    REQUIRE(snow_field_set(busy, SNOW_FIELD_VALUE, &(snow_rect){0, 0, 1, 1}, &value, 1) == SNOW_ERROR_BUSY);
    REQUIRE(snow_steps(grid, &steps) == SNOW_OK && steps == summary->steps);
    return fuzz_byte(self->input) >= 0x80;
}

static void run(handle *self)
{
    snow_stop stop;
    snow_stop_init(&stop, sizeof stop);
    uint8_t set = fuzz_byte(self->input);
    stop.max_steps = steps_of(self->grid) + fuzz_below(self->input, 12);
    stop.rim = set & 1;
    stop.still = set >> 1 & 1;
    stop.tip_radius = set & 4 ? fuzz_number(self->input) : 0;
    stop.frozen = set & 8 ? fuzz_below(self->input, 64) : 0;
    stop.progress = set & 16 ? progress : NULL;
    stop.progress_context = self;
    stop.progress_steps = set & 32 ? 1 : 3;
    snow_summary summary;
    snow_summary_init(&summary, sizeof summary);
    snow_status status = snow_run(self->grid, &stop, &summary);
    if (status == SNOW_OK)
        REQUIRE(summary.reason != SNOW_STOP_NONE && summary.steps == steps_of(self->grid));
}

static void set_field(handle *self)
{
    enum { MOST_VALUES = 16 };
    double values[MOST_VALUES];
    snow_rect rect = {fuzz_coordinate(self->input), fuzz_coordinate(self->input),
                      (int32_t)fuzz_below(self->input, 5), (int32_t)fuzz_below(self->input, 5)};
    snow_field field = (snow_field)fuzz_below(self->input, 10);
    for (size_t i = 0; i < MOST_VALUES; i++)
        values[i] = fuzz_number(self->input) / 4;
    size_t count = (size_t)(rect.width * rect.height) + (fuzz_byte(self->input) >= 0xF0);
    (void)snow_field_set(self->grid, field, &rect, values, count <= MOST_VALUES ? count : MOST_VALUES);
}

static void save(handle *self)
{
    size_t size = 0;
    if (!fuzz_is_small(self->grid))
        return;
    REQUIRE(snow_save(self->grid, NULL, 0, &size) == SNOW_OK);
    if (size > MOST_BYTES)
        return;
    free(self->saved);
    self->saved = malloc(size);
    self->saved_size = size;
    REQUIRE(self->saved != NULL);
    REQUIRE(snow_save(self->grid, self->saved, size - 1, &size) == SNOW_ERROR_BUFFER);
    REQUIRE(snow_save(self->grid, self->saved, size, &size) == SNOW_OK && size == self->saved_size);
}

/* What was saved, perhaps with one byte changed. */
static void load(handle *self)
{
    if (self->saved == NULL)
        return;
    snow_options options = fuzz_options(self->input);
    uint8_t harm = fuzz_byte(self->input);
    size_t place = fuzz_u32(self->input) % self->saved_size;
    self->saved[place] ^= harm < 0xC0 ? 0 : harm;
    snow_grid *grid = NULL;
    snow_status status = snow_load(self->saved, self->saved_size, &options, &grid);
    REQUIRE((status == SNOW_OK) == (grid != NULL));
    self->saved[place] ^= harm < 0xC0 ? 0 : harm;
    REQUIRE(grid == NULL || harm < 0xC0);
    if (grid == NULL)
        return;
    drop(self);
    self->grid = grid;
}

/* A writer that fails after some bytes. */
static int write_some(void *context, const void *bytes, size_t size)
{
    size_t *left = context;
    (void)bytes;
    bool taken = size <= *left;
    *left -= taken ? size : *left;
    return !taken;
}

static void save_badly(handle *self)
{
    size_t room = fuzz_byte(self->input);
    if (fuzz_is_small(self->grid)) {
        snow_status status = snow_save_to(self->grid, write_some, &room);
        REQUIRE(status == SNOW_OK || status == SNOW_ERROR_WRITE);
    }
}

static void query(handle *self)
{
    fuzz_query(self->grid);
    fuzz_draw(self->grid);
}

static void change(handle *self)
{
    fuzz_change(self->input, self->grid);
}

static void ask(handle *self)
{
    fuzz_ask(self->input, self->grid);
}

typedef void (*call)(handle *self);

static const call calls[] = {step, run, change, set_field, save, load, save_badly, ask, query, step, change, create};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input input = fuzz_start(data, size);
    handle self = {.input = &input};
    create(&self);
    for (int i = 0; i < MOST_CALLS && self.grid != NULL && fuzz_left(&input) > 0; i++)
        calls[fuzz_below(&input, COUNT_OF(calls))](&self);
    if (self.grid != NULL)
        fuzz_query(self.grid);
    drop(&self);
    free(self.saved);
    return 0;
}
