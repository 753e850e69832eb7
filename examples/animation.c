/* A crystal as it grows: an animated GIF, or frames for a video encoder. */
#include "common/gif.h"
#include "common/message.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/scene.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

typedef struct animation {
    scene it;
    look appearance;
    const char *out;
    const char *frames;
    int64_t every;
    int32_t delay;
    int32_t hold;

    output gif_file;
    output frame_file;
    gif encoder;
    int64_t count;
} animation;

static bool frames_to_standard_output(const animation *self)
{
    return self->frames && strcmp(self->frames, "-") == 0;
}

static bool open_outputs(animation *self)
{
    self->encoder.target = &self->gif_file;
    if (!output_open(&self->gif_file, self->out))
        return false;
    if (!frames_to_standard_output(self))
        return output_open(&self->frame_file, self->frames);
    self->frame_file = (output){.name = "standard output", .file = stdout};
    return true;
}

static bool commit_outputs(animation *self)
{
    return gif_end(&self->encoder) && output_commit(&self->gif_file) && output_commit(&self->frame_file);
}

static void discard_outputs(animation *self)
{
    gif_discard(&self->encoder);
    output_discard(&self->gif_file);
    output_discard(&self->frame_file);
}

/* A binary portable pixmap; encoders take a stream of them. */
static bool write_pixmap(const output *file, const picture *frame)
{
    size_t size = (size_t)frame->width * (size_t)frame->height * 3;
    errno = 0;
    if (fprintf(file->file, "P6\n%d %d\n255\n", (int)frame->width, (int)frame->height) > 0 &&
        fwrite(frame->pixels, 1, size, file->file) == size)
        return true;
    output_complain(file);
    return false;
}

static int add_frame(animation *self, const snow_grid *grid, int32_t delay)
{
    snow_view view;
    picture frame;
    snow_status status = look_view(&self->appearance, grid, &view);
    view.width += view.width % 2; /* most video formats want even sides */
    view.height += view.height % 2;
    if (status == SNOW_OK)
        status = picture_of_grid(&frame, grid, &view);
    if (status != SNOW_OK)
        return complain_status("the picture", status);
    bool written = (self->out == NULL || gif_add(&self->encoder, &frame, delay)) &&
                   (self->frames == NULL || write_pixmap(&self->frame_file, &frame));
    picture_destroy(&frame);
    self->count++;
    return written ? EXIT_DONE : EXIT_FAILED;
}

/* A frame of the seed, one after each slice of the run, and the last one at the end. */
static int grow(animation *self, snow_grid *grid, snow_summary *summary)
{
    int64_t end = self->it.stop.max_steps;
    int64_t next = 0;
    int exit_code = add_frame(self, grid, self->delay);
    while (exit_code == EXIT_DONE) {
        next += self->every < end - next ? self->every : end - next;
        self->it.stop.max_steps = next;
        exit_code = scene_run(grid, &self->it.stop, summary);
        if (exit_code == EXIT_DONE && summary->reason == SNOW_STOP_STEPS && next < end && progress_cancelled())
            summary->reason = SNOW_STOP_CANCELLED; /* slices may be too short for the run to notice */
        bool more = exit_code == EXIT_DONE && summary->reason == SNOW_STOP_STEPS && next < end;
        if (exit_code == EXIT_DONE)
            exit_code = add_frame(self, grid, more ? self->delay : self->hold);
        if (!more)
            break;
    }
    return exit_code;
}

static int run(animation *self)
{
    snow_grid *grid = NULL;
    snow_summary summary;
    int exit_code = scene_create(&self->it, &grid);
    if (exit_code == EXIT_DONE)
        exit_code = open_outputs(self) ? grow(self, grid, &summary) : EXIT_FAILED;
    snow_destroy(grid);
    progress_clear();
    if (exit_code == EXIT_DONE && !commit_outputs(self))
        exit_code = EXIT_FAILED;
    discard_outputs(self);
    if (exit_code != EXIT_DONE || frames_to_standard_output(self))
        return exit_code;
    return print_line("frames=%lld steps=%lld frozen=%llu reason=%s\n", (long long)self->count,
                      (long long)summary.steps, (unsigned long long)summary.frozen, snow_stop_name(summary.reason));
}

int main(int argc, char **argv)
{
    animation self = {.appearance = {SNOW_PALETTE_FROST, 480, 3, 0}, .every = 60, .delay = 8, .hold = 200};
    scene_init(&self.it);
    option_row rows[] = {
        OPTION_GROUP("The animation"),
        OPTION_TEXT("out", "FILE.gif", &self.out, "where the animated GIF goes"),
        OPTION_TEXT("frames", "FILE", &self.frames, "where the frames go, as PPM pictures; -: standard output"),
        OPTION_LONG("every", "STEPS", &self.every, 1, INT64_MAX, "from one frame to the next (60)"),
        OPTION_INTEGER("delay", "TIME", &self.delay, 1, 65535, "a frame of the GIF, in 1/100 s (8)"),
        OPTION_INTEGER("hold", "TIME", &self.hold, 1, 65535, "the last frame, in 1/100 s (200)"),
        OPTION_CHOICE("palette", palette_names, &self.appearance.palette, "colours (frost)"),
        OPTION_INTEGER("size", "PIXELS", &self.appearance.size, 0, 65534, "longer side; 0: one pixel a cell (480)"),
        OPTION_INTEGER("samples", "COUNT", &self.appearance.samples, 1, 8, "samples along a pixel's side (3)"),
        SCENE_ROWS(&self.it),
        RUN_ROWS(&self.it),
        OPTION_END,
    };
    program command = {"animation", "Shows a snow crystal as it grows. Ctrl-C ends the growth early.",
                       "animation --preset thick-dendrite --out growth.gif\n"
                       "  animation --frames - | ffmpeg -f image2pipe -framerate 25 -i - -pix_fmt yuv420p growth.mp4",
                       rows};
    int exit_code;

    if (!options_read(&command, argc, argv, &exit_code))
        return exit_code;
    if (self.out == NULL && self.frames == NULL) {
        complain("nothing to do: give --out, --frames or both");
        return EXIT_WRONG;
    }
    if (!scene_check(&self.it, &command))
        return EXIT_WRONG;
    self.it.params.record_freeze_steps = palette_shows_age(self.appearance.palette);
    signal(SIGPIPE, SIG_IGN); /* an encoder that ends is told as a failed write */
    progress_start();
    return run(&self);
}
