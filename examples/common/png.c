#include "common/png.h"

#include "common/message.h"

#include <errno.h>
#include <png.h>

bool png_write(output *self, const picture *image)
{
    png_image png = {
        .version = PNG_IMAGE_VERSION,
        .width = (png_uint_32)image->width,
        .height = (png_uint_32)image->height,
        .format = image->channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB,
    };
    errno = 0;
    if (png_image_write_to_stdio(&png, self->file, 0, image->pixels, 0, NULL))
        return output_commit(self);
    if (errno)
        output_complain(self);
    else
        complain("%s: %s", self->name, png.message);
    output_discard(self);
    return false;
}
