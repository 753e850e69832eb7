#include "common/gif.h"

#include "common/message.h"
#include "common/quantise.h"

#include <errno.h>
#include <gif_lib.h>
#include <stdlib.h>

enum { COLOUR_BITS = 8 };

static int write_bytes(GifFileType *file, const GifByteType *bytes, int size)
{
    output *target = file->UserData;
    return (int)fwrite(bytes, 1, (size_t)size, target->file);
}

static bool fail(const gif *self, int error)
{
    const char *reason = GifErrorString(error);
    if (errno)
        output_complain(self->target);
    else
        complain("%s: %s", self->target->name, reason ? reason : "writing failed");
    return false;
}

/* The application block that browsers take as "for ever". */
static bool repeat_for_ever(GifFileType *file)
{
    static const char name[] = "NETSCAPE2.0";
    static const unsigned char times[] = {1, 0, 0};
    return EGifPutExtensionLeader(file, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
           EGifPutExtensionBlock(file, sizeof name - 1, name) == GIF_OK &&
           EGifPutExtensionBlock(file, sizeof times, times) == GIF_OK && EGifPutExtensionTrailer(file) == GIF_OK;
}

static bool begin(gif *self, const picture *frame)
{
    int error = 0;
    self->file = EGifOpen(self->target, write_bytes, &error);
    if (self->file == NULL)
        return fail(self, error);
    EGifSetGifVersion(self->file, true);
    if (EGifPutScreenDesc(self->file, frame->width, frame->height, COLOUR_BITS, 0, NULL) != GIF_OK ||
        !repeat_for_ever(self->file))
        return fail(self, self->file->Error);
    return true;
}

static bool put_delay(GifFileType *file, int32_t delay)
{
    GraphicsControlBlock control = {DISPOSE_DO_NOT, false, delay, NO_TRANSPARENT_COLOR};
    GifByteType bytes[4];
    size_t size = EGifGCBToExtension(&control, bytes);
    return EGifPutExtension(file, GRAPHICS_EXT_FUNC_CODE, (int)size, bytes) == GIF_OK;
}

/* Each frame has the 256 colours that suit it best. */
static bool put_frame(gif *self, const picture *frame, ColorMapObject *map, GifByteType *indices)
{
    colour palette[MOST_COLOURS] = {{0, 0, 0}};
    if (!quantise(frame, palette, indices))
        return fail(self, E_GIF_ERR_NOT_ENOUGH_MEM);
    for (int i = 0; i < MOST_COLOURS; i++)
        map->Colors[i] = (GifColorType){palette[i].red, palette[i].green, palette[i].blue};
    if (EGifPutImageDesc(self->file, 0, 0, frame->width, frame->height, false, map) != GIF_OK)
        return fail(self, self->file->Error);
    for (int32_t y = 0; y < frame->height; y++)
        if (EGifPutLine(self->file, indices + (size_t)y * (size_t)frame->width, frame->width) != GIF_OK)
            return fail(self, self->file->Error);
    return true;
}

bool gif_add(gif *self, const picture *frame, int32_t delay)
{
    errno = 0;
    if (self->file == NULL && !begin(self, frame))
        return false;
    if (!put_delay(self->file, delay))
        return fail(self, self->file->Error);
    GifByteType *indices = malloc((size_t)frame->width * (size_t)frame->height);
    ColorMapObject *map = GifMakeMapObject(MOST_COLOURS, NULL);
    bool written = indices && map ? put_frame(self, frame, map, indices) : fail(self, E_GIF_ERR_NOT_ENOUGH_MEM);
    GifFreeMapObject(map);
    free(indices);
    return written;
}

bool gif_end(gif *self)
{
    int error = 0;
    GifFileType *file = self->file;
    errno = 0;
    self->file = NULL;
    return file == NULL || EGifCloseFile(file, &error) == GIF_OK || fail(self, error);
}

void gif_discard(gif *self)
{
    if (self->file)
        EGifCloseFile(self->file, NULL);
    self->file = NULL;
}
