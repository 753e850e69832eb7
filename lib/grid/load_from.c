#include "base/stream.h"

snow_status snow_load_from(snow_reader read, void *context, const snow_options *options, snow_grid **grid)
{
    if (read == NULL || grid == NULL)
        return SNOW_ERROR_NULL;
    snow_text text;
    snow_status status = snow_text_read(&text, read, context, options);
    if (status != SNOW_OK)
        return status;
    status = snow_load(text.bytes, text.size, options, grid);
    snow_text_end(&text);
    return status;
}
