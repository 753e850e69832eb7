#include "common/crystal.h"

#include "common/message.h"
#include "common/png.h"

#include <errno.h>
#include <string.h>

int file_read(void *file, void *bytes, size_t size, size_t *got)
{
    *got = fread(bytes, 1, size, file);
    return ferror((FILE *)file);
}

int file_write(void *file, const void *bytes, size_t size)
{
    return fwrite(bytes, 1, size, file) != size;
}

FILE *file_open(const char *option, const char *name)
{
    FILE *file = fopen(name, "rb");
    if (file == NULL)
        complain("--%s: %s: %s", option, name, strerror(errno));
    return file;
}

int crystal_draw(const snow_grid *grid, const look *appearance, output *file)
{
    if (file->name == NULL)
        return EXIT_DONE;
    snow_view view;
    picture image;
    snow_status status = look_view(appearance, grid, &view);
    if (status == SNOW_OK)
        status = picture_of_grid(&image, grid, &view);
    if (status != SNOW_OK)
        return complain_status("the picture", status);
    bool written = png_write(file, &image);
    picture_destroy(&image);
    return written ? EXIT_DONE : EXIT_FAILED;
}
