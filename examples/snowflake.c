/* One crystal, from a command line to a picture. */
#include "common/crystal.h"
#include "common/kept.h"
#include "common/message.h"
#include "common/progress.h"
#include "common/scene.h"

#include <stdio.h>

typedef struct files {
    const char *out;
    const char *save;
    const char *load;
} files;

static int list_presets(void)
{
    for (size_t i = 0; snow_reiter_preset_name(i); i++)
        printf("%-16s %s\n", snow_reiter_preset_name(i), snow_reiter_preset_source(i));
    return print_line("%s", "");
}

/* The grid stands; grows it and keeps what was done. */
static int grow(snow_grid *grid, const scene *it, const look *appearance, output *picture_file, output *save_file)
{
    snow_summary summary;
    int exit_code = scene_run(grid, &it->stop, &summary);
    progress_clear();
    if (exit_code == EXIT_DONE)
        exit_code = kept_save(grid, save_file) ? EXIT_DONE : EXIT_FAILED;
    if (exit_code == EXIT_DONE)
        exit_code = crystal_draw(grid, appearance, picture_file);
    if (exit_code == EXIT_DONE)
        exit_code = print_line("steps=%lld frozen=%llu tip=%.6g reason=%s\n", (long long)summary.steps,
                               (unsigned long long)summary.frozen, summary.tip_radius,
                               snow_stop_name(summary.reason));
    return exit_code;
}

static int grow_into_files(snow_grid *grid, const scene *it, const look *appearance, const files *names)
{
    output picture_file;
    output save_file;
    if (!output_open_both(&picture_file, names->out, &save_file, names->save))
        return EXIT_FAILED;
    int exit_code = grow(grid, it, appearance, &picture_file, &save_file);
    output_discard(&save_file);
    output_discard(&picture_file);
    return exit_code;
}

static bool check(const program *command, const scene *it, const files *names)
{
    const char *given = option_given_of(command, SCENE_HEADING);
    if (names->load && given) {
        complain("--load brings its own crystal; --%s cannot be given with it", given);
        return false;
    }
    return scene_check(it, command);
}

int main(int argc, char **argv)
{
    scene it;
    look appearance = {SNOW_PALETTE_PAPER, 800, 3, 0};
    files names = {0};
    int32_t list = 0;
    scene_init(&it);
    option_row rows[] = {
        SCENE_ROWS(&it),
        RUN_ROWS(&it),
        OPTION_GROUP("The picture"),
        OPTION_TEXT("out", "FILE.png", &names.out, "write a picture there; without this option, none"),
        OPTION_CHOICE("palette", palette_names, &appearance.palette, "colours (paper)"),
        OPTION_INTEGER("size", "PIXELS", &appearance.size, 0, 65535, "longer side; 0: one pixel a cell (800)"),
        OPTION_INTEGER("samples", "COUNT", &appearance.samples, 1, 8, "samples along a pixel's side (3)"),
        OPTION_FLAG("transparent", &appearance.transparent, "draw the ice only"),
        OPTION_GROUP("Other"),
        OPTION_TEXT("save", "FILE", &names.save, "keep the crystal, to go on with --load"),
        OPTION_TEXT("load", "FILE", &names.load, "go on with a kept crystal"),
        OPTION_FLAG("list-presets", &list, "print the presets and end"),
        OPTION_END,
    };
    program command = {"snowflake",
                       "Grows one snow crystal and prints how that ended, in one line. Ctrl-C ends it early;\n"
                       "picture and line are then those of the crystal as it stands.",
                       "snowflake --beta 0.35 --gamma 0.001 --palette frost --out thick-dendrite.png", rows};
    snow_grid *grid = NULL;
    int exit_code;

    if (!options_read(&command, argc, argv, &exit_code))
        return exit_code;
    if (list)
        return list_presets();
    if (!check(&command, &it, &names))
        return EXIT_WRONG;
    it.params.record_freeze_steps = names.save || palette_shows_age(appearance.palette);
    progress_start();
    exit_code = names.load ? kept_load(names.load, &it.options, &grid) : scene_create(&it, &grid);
    if (exit_code == EXIT_DONE)
        exit_code = grow_into_files(grid, &it, &appearance, &names);
    snow_destroy(grid);
    return exit_code;
}
