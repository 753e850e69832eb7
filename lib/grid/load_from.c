#include "base/model.h"
#include "base/options.h"
#include "base/stream.h"

snow_status snow_load_from(snow_reader read, void *context, const snow_options *options, snow_grid **grid)
{
    if (read == NULL || grid == NULL)
        return SNOW_ERROR_NULL;
    snow_text text;
    snow_options settled;
    snow_status status = snow_options_settle(options, &settled);
    if (status == SNOW_OK)
        status = snow_text_read(&text, read, context, &settled);
    if (status != SNOW_OK)
        return status;
    snow_options rest = snow_options_beside(&settled, text.heap.used);
    status = snow_load(text.bytes, text.size, &rest, grid);
    snow_text_end(&text);
    if (status == SNOW_OK)
        (*grid)->heap.limit = settled.memory_limit;
    return status;
}
