/* One crystal of Packard's model, from a command line to a picture or a pattern. */
#include "common/crystal.h"
#include "common/message.h"
#include "common/progress.h"
#include "common/scene.h"
#include "common/zone.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>

static const option_choice packard_engine_names[] = {{"auto", SNOW_PACKARD_ENGINE_AUTO},
                                                     {"reference", SNOW_PACKARD_ENGINE_REFERENCE},
                                                     {"tiles", SNOW_PACKARD_ENGINE_TILES},
                                                     {"quadtree", SNOW_PACKARD_ENGINE_QUADTREE},
                                                     {NULL, 0}};
static const option_choice packard_domain_names[] = {{"plane", SNOW_PACKARD_PLANE},
                                                     {"disc", SNOW_PACKARD_DISC},
                                                     {"hexagon", SNOW_PACKARD_HEXAGON},
                                                     {"rectangle", SNOW_PACKARD_RECTANGLE},
                                                     {"rhombus", SNOW_PACKARD_RHOMBUS},
                                                     {"torus", SNOW_PACKARD_TORUS},
                                                     {NULL, 0}};

typedef struct crystal {
    snow_packard_params params;
    snow_options options;
    zone_list zones;
    int64_t steps;
    look appearance;
    const char *load;
    const char *out;
    const char *rle;
} crystal;

static bool take_rule(void *params, const char *text)
{
    snow_status status = snow_packard_params_rule(params, text);
    if (status != SNOW_OK)
        complain("--rule: %s: %s", text, snow_strerror(status));
    return status == SNOW_OK;
}

static int load(const crystal *self, snow_grid **grid)
{
    FILE *file = file_open("load-rle", self->load);
    if (file == NULL)
        return EXIT_WRONG;
    snow_status status = snow_packard_load_rle_from(file_read, file, &self->params, &self->options, grid);
    fclose(file);
    return status == SNOW_OK ? EXIT_DONE : complain_status(self->load, status);
}

static int create(const crystal *self, snow_grid **grid)
{
    snow_status status = snow_packard_create(&self->params, &self->options, grid);
    return status == SNOW_OK ? EXIT_DONE : complain_status(NULL, status);
}

static int add_zones(const crystal *self, snow_grid *grid)
{
    snow_status status = zones_add(&self->zones, grid);
    return status == SNOW_OK ? EXIT_DONE : complain_status("--zone", status);
}

/* Takes the steps, a fraction of a second at a time; Ctrl-C ends them early. */
static int take_steps(snow_grid *grid, int64_t steps)
{
    snow_stop stop;
    snow_summary summary;
    int64_t done = 0;
    snow_stop_init(&stop, sizeof stop);
    snow_summary_init(&summary, sizeof summary);
    snow_status status = snow_steps(grid, &done);
    stop.max_steps = steps < INT64_MAX - done ? done + steps : INT64_MAX;
    stop.rim = stop.still = 0;
    stop.seconds = 0.1;
    do {
        if (status == SNOW_OK)
            status = snow_run(grid, &stop, &summary);
        progress_show("step %" PRId64 ", %" PRIu64 " frozen cells", summary.steps, summary.frozen);
    } while (status == SNOW_OK && summary.reason == SNOW_STOP_TIME && !progress_cancelled());
    progress_clear();
    if (status != SNOW_OK)
        return complain_status(NULL, status);
    if (summary.reason == SNOW_STOP_TIME)
        complain("stopped after step %" PRId64, summary.steps);
    return EXIT_DONE;
}

static int save(const snow_grid *grid, output *file)
{
    if (file->name == NULL)
        return EXIT_DONE;
    errno = 0;
    snow_status status = snow_packard_save_rle_to(grid, file_write, file->file);
    if (status == SNOW_ERROR_WRITE) {
        output_complain(file);
        return EXIT_FAILED;
    }
    if (status != SNOW_OK)
        return complain_status("the pattern", status);
    return output_commit(file) ? EXIT_DONE : EXIT_FAILED;
}

/* A number of 128 bits in decimal digits, written from the end of the text. */
static const char *decimal(uint64_t high, uint64_t low, char text[40])
{
    uint32_t part[4] = {(uint32_t)(high >> 32), (uint32_t)high, (uint32_t)(low >> 32), (uint32_t)low};
    char *digit = text + 39;
    *digit = '\0';
    do {
        uint64_t rest = 0;
        for (int i = 0; i < 4; i++) {
            rest = rest << 32 | part[i];
            part[i] = (uint32_t)(rest / 10);
            rest %= 10;
        }
        *--digit = (char)('0' + rest);
    } while ((part[0] | part[1] | part[2] | part[3]) != 0);
    return digit;
}

static int print_result(const snow_grid *grid)
{
    int64_t steps = 0;
    uint64_t high = 0, low = 0;
    snow_packard_engine engine = SNOW_PACKARD_ENGINE_AUTO;
    char text[40];
    snow_status status = snow_steps(grid, &steps);
    if (status == SNOW_OK)
        status = snow_packard_population(grid, &high, &low);
    if (status == SNOW_OK)
        status = snow_packard_engine_of(grid, &engine);
    if (status != SNOW_OK)
        return complain_status(NULL, status);
    return print_line("steps=%" PRId64 " population=%s engine=%s\n", steps, decimal(high, low, text),
                      snow_packard_engine_name(engine));
}

/* The grid stands; grows it and keeps what was done. */
static int grow(const crystal *self, snow_grid *grid, output *picture_file, output *pattern_file)
{
    int exit_code = add_zones(self, grid);
    if (exit_code == EXIT_DONE)
        exit_code = take_steps(grid, self->steps);
    if (exit_code == EXIT_DONE)
        exit_code = save(grid, pattern_file);
    if (exit_code == EXIT_DONE)
        exit_code = crystal_draw(grid, &self->appearance, picture_file);
    return exit_code == EXIT_DONE ? print_result(grid) : exit_code;
}

static int grow_into_files(const crystal *self, snow_grid *grid)
{
    output picture_file, pattern_file;
    if (!output_open_both(&picture_file, self->out, &pattern_file, self->rle))
        return EXIT_FAILED;
    int exit_code = grow(self, grid, &picture_file, &pattern_file);
    output_discard(&pattern_file);
    output_discard(&picture_file);
    return exit_code;
}

int main(int argc, char **argv)
{
    crystal self = {.steps = 100, .appearance = {SNOW_PALETTE_FROST, 800, 3, 0}};
    snow_packard_params_init(&self.params, sizeof self.params);
    snow_options_init(&self.options, sizeof self.options);
    option_row rows[] = {
        OPTION_GROUP("The crystal"),
        OPTION_ACTION("rule", "RULE", take_rule, &self.params, "like 0101010 or B135/S0123456H (0101010)"),
        OPTION_CHOICE("domain", packard_domain_names, &self.params.domain, "where it grows (plane)"),
        OPTION_INTEGER("radius", "CELLS", &self.params.radius, INT32_MIN, INT32_MAX, "of a disc or hexagon (200)"),
        OPTION_INTEGER("width", "CELLS", &self.params.width, INT32_MIN, INT32_MAX, "of the other domains (400)"),
        OPTION_INTEGER("height", "CELLS", &self.params.height, INT32_MIN, INT32_MAX, "of the other domains (400)"),
        OPTION_INTEGER("seeds", "COUNT", &self.params.scatter, 0, INT32_MAX, "scattered at random (0: one seed)"),
        OPTION_INTEGER("side", "CELLS", &self.params.scatter_side, INT32_MIN, INT32_MAX, "of where they lie (400)"),
        OPTION_INTEGER("cluster", "CELLS", &self.params.cluster, INT32_MIN, INT32_MAX,
                       "start from a random patch so many cells wide (0: one seed)"),
        OPTION_UNSIGNED("seed", &self.params.random_seed, "chooses what is random (0)"),
        OPTION_ACTION("zone", "ZONE", zone_take, &self.zones,
                      "like clefts:1-16 or corners:4-5, with :WIDTH in cells; many"),
        OPTION_TEXT("load-rle", "FILE", &self.load, "start from a pattern, and from the rule that it names"),
        OPTION_GROUP("The run"),
        OPTION_LONG("steps", "STEPS", &self.steps, 0, INT64_MAX, "how many (100)"),
        OPTION_CHOICE("engine", packard_engine_names, &self.params.engine, "what computes them (auto)"),
        OPTION_INTEGER("threads", "COUNT", &self.options.threads, 0, 1024,
                       "threads that share a step; 0: one a processor (1)"),
        OPTION_CHOICE("isa", isa_names, &self.options.isa, "instruction set (auto)"),
        OPTION_GROUP("The result"),
        OPTION_TEXT("out", "FILE.png", &self.out, "write a picture there; without this option, none"),
        OPTION_CHOICE("palette", palette_names, &self.appearance.palette, "colours (frost)"),
        OPTION_INTEGER("size", "PIXELS", &self.appearance.size, 0, 65535, "longer side; 0: one pixel a cell (800)"),
        OPTION_INTEGER("samples", "COUNT", &self.appearance.samples, 1, 8, "samples along a pixel's side (3)"),
        OPTION_TEXT("rle", "FILE.rle", &self.rle, "where the pattern goes, for Golly and its kin"),
        OPTION_END,
    };
    program command = {"packard",
                       "Grows one crystal by a Boolean rule: a cell with k frozen neighbours freezes if the rule's\n"
                       "digit d_k is 1. Ctrl-C ends it early; files and line are then those of the crystal as it\n"
                       "stands.",
                       "packard --rule 0110000 --zone corners:7-8 --steps 30 --palette age --out fig5c.png", rows};
    snow_grid *grid = NULL;
    int exit_code;

    if (!options_read(&command, argc, argv, &exit_code))
        return exit_code;
    self.params.record_freeze_steps = self.out != NULL && palette_shows_age(self.appearance.palette);
    progress_start();
    exit_code = self.load != NULL ? load(&self, &grid) : create(&self, &grid);
    if (exit_code == EXIT_DONE)
        exit_code = grow_into_files(&self, grid);
    snow_destroy(grid);
    return exit_code;
}
