#include "common/kept.h"

#include "common/message.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static int read_bytes(void *file, void *bytes, size_t size, size_t *got)
{
    *got = fread(bytes, 1, size, file);
    return ferror((FILE *)file);
}

static int write_bytes(void *file, const void *bytes, size_t size)
{
    return fwrite(bytes, 1, size, file) != size;
}

int kept_load(const char *name, const snow_options *options, snow_grid **grid)
{
    FILE *file = fopen(name, "rb");
    if (file == NULL) {
        complain("--load: %s: %s", name, strerror(errno));
        return EXIT_WRONG;
    }
    snow_status status = snow_load_from(read_bytes, file, options, grid);
    fclose(file);
    return status == SNOW_OK ? EXIT_DONE : complain_status(name, status);
}

bool kept_save(const snow_grid *grid, output *file)
{
    if (file->name == NULL)
        return true;
    errno = 0;
    if (snow_save_to(grid, write_bytes, file->file) == SNOW_OK)
        return output_commit(file);
    output_complain(file);
    return false;
}
