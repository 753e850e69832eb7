#include "base/heap.h"
#include "base/options.h"
#include "base/reader.h"

#include <snowgrowth/grid.h>

snow_status snow_load_from(snow_reader read, void *context, const snow_options *options, snow_grid **grid)
{
    if (read == NULL || grid == NULL)
        return SNOW_ERROR_NULL;
    snow_options settled;
    snow_status status = snow_options_settle(options, &settled);
    if (status != SNOW_OK)
        return status;
    snow_heap heap;
    snow_heap_start(&heap, &settled);
    unsigned char *bytes;
    size_t size;
    status = snow_reader_all(read, context, &heap, &bytes, &size);
    if (status == SNOW_OK)
        status = snow_load(bytes, size, options, grid);
    snow_heap_put(&heap, bytes);
    return status;
}
