#include "common/scene.h"

#include "common/message.h"
#include "common/progress.h"

const option_choice domain_names[] = {
    {"disc", SNOW_REITER_DISC}, {"hexagon", SNOW_REITER_HEXAGON}, {"rectangle", SNOW_REITER_RECTANGLE}, {NULL, 0}};
const option_choice rim_names[] = {{"near", SNOW_REITER_RIM_NEAR}, {"row", SNOW_REITER_RIM_ROW}, {NULL, 0}};
const option_choice engine_names[] = {{"auto", SNOW_REITER_ENGINE_AUTO},
                                      {"rows", SNOW_REITER_ENGINE_ROWS},
                                      {"reference", SNOW_REITER_ENGINE_REFERENCE},
                                      {"quad", SNOW_REITER_ENGINE_QUAD},
                                      {NULL, 0}};
const option_choice isa_names[] = {{"auto", SNOW_ISA_AUTO},
                                   {"baseline", SNOW_ISA_BASELINE},
                                   {"avx2", SNOW_ISA_AVX2},
                                   {"avx512", SNOW_ISA_AVX512},
                                   {NULL, 0}};
const option_choice palette_names[] = {{"paper", SNOW_PALETTE_PAPER},
                                       {"frost", SNOW_PALETTE_FROST},
                                       {"ink", SNOW_PALETTE_INK},
                                       {"age", SNOW_PALETTE_AGE},
                                       {"phase", SNOW_PALETTE_PHASE},
                                       {NULL, 0}};

bool scene_take_preset(void *params, const char *name)
{
    snow_status status = snow_reiter_params_preset(params, name);
    if (status != SNOW_OK)
        complain("--preset: %s: %s", name, snow_strerror(status));
    return status == SNOW_OK;
}

void scene_init(scene *self)
{
    snow_reiter_params_init(&self->params, sizeof self->params);
    snow_options_init(&self->options, sizeof self->options);
    snow_stop_init(&self->stop, sizeof self->stop);
    self->stop.progress = progress_of_run;
    self->stop.progress_steps = 10;
}

bool scene_check(const scene *self, const program *command)
{
    bool rectangle = self->params.domain == SNOW_REITER_RECTANGLE;
    if (rectangle && option_given(command, "radius"))
        complain("--radius does not go with --domain rectangle; give --width and --height");
    else if (!rectangle && (option_given(command, "width") || option_given(command, "height")))
        complain("--width and --height go with --domain rectangle only");
    else if (self->params.noise_symmetric && !option_given(command, "noise"))
        complain("--symmetric-noise goes with --noise only");
    else
        return true;
    return false;
}

int scene_create(const scene *self, snow_grid **grid)
{
    snow_status status = snow_reiter_create(&self->params, &self->options, grid);
    return status == SNOW_OK ? EXIT_DONE : complain_status(NULL, status);
}

int scene_run(snow_grid *grid, const snow_stop *stop, snow_summary *summary)
{
    snow_summary_init(summary, sizeof *summary);
    snow_status status = snow_run(grid, stop, summary);
    return status == SNOW_OK || status == SNOW_ERROR_UNSTABLE ? EXIT_DONE : complain_status(NULL, status);
}
