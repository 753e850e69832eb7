#include "base/floating.h"
#include "base/model.h"
#include "base/options.h"
#include "base/stream.h"
#include "grid/models.h"

#include <string.h>

/* "SNOWGRID", format version, model, what the model saves, checksum of all
   before it. Numbers are little-endian. */
static const char magic[8] = "SNOWGRID";
enum { FORMAT = 1, HEADER_SIZE = 16, CHECKSUM_SIZE = 8 };

static void save(const snow_grid *grid, snow_sink *sink)
{
    for (size_t i = 0; i < sizeof magic; i++)
        snow_sink_u8(sink, (uint8_t)magic[i]);
    snow_sink_u32(sink, FORMAT);
    snow_sink_u32(sink, (uint32_t)grid->operations->model);
    grid->operations->save(grid, sink);
    snow_sink_end(sink);
}

snow_status snow_save_to(const snow_grid *grid, snow_writer write, void *context)
{
    if (grid == NULL || write == NULL)
        return SNOW_ERROR_NULL;
    snow_sink sink;
    snow_sink_start(&sink, write, context);
    save(grid, &sink);
    return sink.failed ? SNOW_ERROR_WRITE : SNOW_OK;
}

snow_status snow_save(const snow_grid *grid, void *buffer, size_t capacity, size_t *size)
{
    if (grid == NULL || size == NULL)
        return SNOW_ERROR_NULL;
    return snow_save_whole(grid, snow_save_to, buffer, capacity, size);
}

static uint64_t checksum_of(const unsigned char *bytes, size_t size)
{
    snow_digest_state state;
    snow_digest_start(&state);
    for (size_t i = 0; i < size; i++)
        snow_digest_add(&state, bytes[i], 1);
    return snow_digest_end(&state);
}

/* Format and version are told apart before the checksum is looked at, so that
   a later version's file is called that and not damaged. */
static snow_status check_envelope(const unsigned char *bytes, size_t size)
{
    size_t known = size < sizeof magic ? size : sizeof magic;
    if (memcmp(bytes, magic, known) != 0)
        return SNOW_ERROR_FORMAT;
    if (size < HEADER_SIZE + CHECKSUM_SIZE)
        return SNOW_ERROR_TRUNCATED;
    snow_source header = {bytes + sizeof magic, bytes + HEADER_SIZE, false};
    if (snow_source_u32(&header) > FORMAT)
        return SNOW_ERROR_FORMAT_VERSION;
    return SNOW_OK;
}

/* Data whose checksum is wrong are read only to say what is wrong with them: a wrong number in them must not ask
   for much memory. */
static void limit_memory(snow_options *options, size_t size)
{
    enum { TIMES = 64, LEAST = 1 << 20 };
    uint64_t enough = (uint64_t)size * TIMES + LEAST;
    if (options->memory_limit == 0 || options->memory_limit > enough)
        options->memory_limit = enough;
}

static snow_status load(const unsigned char *bytes, size_t size, const snow_options *options, snow_grid **result)
{
    snow_status status = check_envelope(bytes, size);
    if (status != SNOW_OK)
        return status;
    snow_source source = {bytes + sizeof magic, bytes + size - CHECKSUM_SIZE, false};
    snow_source checksum = {bytes + size - CHECKSUM_SIZE, bytes + size, false};
    bool intact = snow_source_u64(&checksum) == checksum_of(bytes, size - CHECKSUM_SIZE);
    if (snow_source_u32(&source) != FORMAT)
        return SNOW_ERROR_DAMAGED;
    const snow_model_operations *operations = snow_models_find(snow_source_u32(&source));
    if (operations == NULL)
        return intact ? SNOW_ERROR_FORMAT_VERSION : SNOW_ERROR_DAMAGED;

    snow_options settled;
    status = snow_options_settle(options, &settled);
    if (status != SNOW_OK)
        return status;
    if (!intact)
        limit_memory(&settled, size);
    snow_grid *grid = NULL;
    status = operations->load(&source, &settled, &grid);
    if (status == SNOW_OK && (!intact || snow_source_left(&source) > 0))
        status = SNOW_ERROR_DAMAGED;
    if (!intact && status != SNOW_ERROR_TRUNCATED)
        status = SNOW_ERROR_DAMAGED;
    return snow_grid_hand_over(grid, status, result);
}

snow_status snow_load(const void *buffer, size_t size, const snow_options *options, snow_grid **grid)
{
    if (buffer == NULL || grid == NULL)
        return SNOW_ERROR_NULL;
    snow_floating floating;
    snow_floating_enter(&floating);
    snow_status status = load(buffer, size, options, grid);
    snow_floating_leave(&floating);
    return status;
}
