/* One crystal as the command line describes it: what it is, how it runs, how it looks. */
#ifndef EXAMPLES_SCENE_H
#define EXAMPLES_SCENE_H

#include "common/options.h"
#include "common/picture.h"

#include <snowgrowth/snowgrowth.h>

typedef struct scene {
    snow_reiter_params params;
    snow_options options;
    snow_stop stop;
} scene;

extern const option_choice domain_names[];
extern const option_choice rim_names[];
extern const option_choice engine_names[];
extern const option_choice isa_names[];
extern const option_choice palette_names[];

/* An option_action on a scene's parameters. */
bool scene_take_preset(void *params, const char *name);

/* Rows for an option table; the defaults in the texts are the library's. */
#define SCENE_HEADING "The crystal"
#define SCENE_ROWS(it) \
    OPTION_GROUP(SCENE_HEADING), \
    OPTION_ACTION("preset", "NAME", scene_take_preset, &(it)->params, \
                  "a figure of the sources; other options change it"), \
    OPTION_NUMBER("beta", &(it)->params.background, "background: the vapour at the start (0.4)"), \
    OPTION_NUMBER("gamma", &(it)->params.addition, "addition: what a cell at the ice gains in a step (0.001)"), \
    OPTION_NUMBER("alpha", &(it)->params.diffusion, "diffusion, up to 8/3 (1)"), \
    OPTION_FLAG("allow-unstable", &(it)->params.allow_unstable, "take alpha up to 4"), \
    OPTION_CHOICE("domain", domain_names, &(it)->params.domain, "where it grows (disc)"), \
    OPTION_INTEGER("radius", "CELLS", &(it)->params.radius, INT32_MIN, INT32_MAX, "of a disc or hexagon (200)"), \
    OPTION_INTEGER("width", "CELLS", &(it)->params.width, INT32_MIN, INT32_MAX, "of a rectangle (600)"), \
    OPTION_INTEGER("height", "CELLS", &(it)->params.height, INT32_MIN, INT32_MAX, "of a rectangle (600)"), \
    OPTION_CHOICE("rim", rim_names, &(it)->params.rim, "stop two cells from the rim, or at row height/35 (near)"), \
    OPTION_INTEGER("cluster", "CELLS", &(it)->params.cluster, INT32_MIN, INT32_MAX, \
                   "start from a random patch so many cells wide (0: one cell)"), \
    OPTION_NUMBER("noise", &(it)->params.noise, "amplitude of the background's noise (0)"), \
    OPTION_FLAG("symmetric-noise", &(it)->params.noise_symmetric, "noise with sixfold symmetry"), \
    OPTION_UNSIGNED("random-seed", &(it)->params.random_seed, "chooses patch and noise (0)"), \
    OPTION_CHOICE("engine", engine_names, &(it)->params.engine, "what computes the steps (auto)")
#define RUN_ROWS(it) \
    OPTION_GROUP("The run"), \
    OPTION_LONG("max-steps", "STEPS", &(it)->stop.max_steps, 0, INT64_MAX, "end here at the latest (10000)"), \
    OPTION_INTEGER("threads", "COUNT", &(it)->options.threads, 0, 1024, \
                   "threads that share a step; 0: one a processor (1)"), \
    OPTION_CHOICE("isa", isa_names, &(it)->options.isa, "instruction set (auto)")

/* Writes the defaults; the run shows its progress. */
void scene_init(scene *self);

/* Complains and returns false when options contradict each other. */
bool scene_check(const scene *self, const program *command);

/* Creates the grid, or complains; returns the exit code. */
int scene_create(const scene *self, snow_grid **grid);

/* Runs until stop, or complains; an unstable end is an end like others. Returns the exit code. */
int scene_run(snow_grid *grid, const snow_stop *stop, snow_summary *summary);

#endif
