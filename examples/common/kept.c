#include "common/kept.h"

#include "common/crystal.h"
#include "common/message.h"

#include <errno.h>

int kept_load(const char *name, const snow_options *options, snow_grid **grid)
{
    FILE *file = file_open("load", name);
    if (file == NULL)
        return EXIT_WRONG;
    snow_status status = snow_load_from(file_read, file, options, grid);
    fclose(file);
    return status == SNOW_OK ? EXIT_DONE : complain_status(name, status);
}

bool kept_save(const snow_grid *grid, output *file)
{
    if (file->name == NULL)
        return true;
    errno = 0;
    if (snow_save_to(grid, file_write, file->file) == SNOW_OK)
        return output_commit(file);
    output_complain(file);
    return false;
}
