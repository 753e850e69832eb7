/* Reiter's fig. 5: tiny changes of the diffusion, great changes of the crystal. */
#include "common/message.h"
#include "common/sheet.h"

#include <stdio.h>

typedef struct sweep {
    sheet picture;
    number_list alphas;
    double beta;
    double gamma;
    int32_t radius;
    double tip;
    int64_t max_steps;
} sweep;

/* Rows of three. */
static bool set_panels(sweep *self)
{
    int32_t count = (int32_t)self->alphas.count;
    if (!sheet_set_panels(&self->picture, count < 3 ? count : 3, count, false))
        return false;
    for (int32_t i = 0; i < count; i++) {
        panel *it = &self->picture.panels[i];
        it->params.background = self->beta;
        it->params.addition = self->gamma;
        it->params.diffusion = self->alphas.numbers[i];
        it->params.allow_unstable = 1;
        it->params.radius = self->radius;
        it->stop.tip_radius = self->tip;
        it->stop.max_steps = self->max_steps;
        snprintf(it->caption, sizeof it->caption, "α = %g", it->params.diffusion);
    }
    self->picture.reach = self->tip > 0 && self->tip < self->radius ? self->tip + 4 : 0;
    snprintf(self->picture.footer, sizeof self->picture.footer,
             "β = %g, γ = %g, disc of radius %d, until tips are at %g", self->beta, self->gamma, (int)self->radius,
             self->tip);
    return true;
}

int main(int argc, char **argv)
{
    /* The arms of the printed figure end 170 to 172 cells from the centre. */
    sweep self = {.alphas = {6, {.5, .501, .502, 1, 2.003, 2.69}}, .beta = 0.4, .gamma = 0.0001, .radius = 200,
                  .tip = 171, .max_steps = 40000};
    sheet_init(&self.picture);
    self.picture.panel_size = 480;
    option_row rows[] = {
        OPTION_GROUP("The sweep"),
        OPTION_LIST("alphas", &self.alphas, "diffusions, up to 4 (0.5,0.501,0.502,1,2.003,2.69)"),
        OPTION_NUMBER("beta", &self.beta, "background (0.4)"),
        OPTION_NUMBER("gamma", &self.gamma, "addition (0.0001)"),
        OPTION_INTEGER("radius", "CELLS", &self.radius, INT32_MIN, INT32_MAX, "of the discs (200)"),
        OPTION_NUMBER("tip", &self.tip, "end when the arms are so long; 0: at the rim (171)"),
        OPTION_LONG("max-steps", "STEPS", &self.max_steps, 0, INT64_MAX, "end there at the latest (40000)"),
        SHEET_ROWS(&self.picture, "480", "paper"),
        OPTION_END,
    };
    program command = {"alpha_sweep",
                       "Draws Reiter's fig. 5: how the crystal hangs on the diffusion alpha. Past 8/3 the vapour\n"
                       "is unstable; the crystal is then drawn as it stood at the last sound step.",
                       "alpha_sweep --alphas 0.99,1,1.01 --out alpha.png", rows};
    int exit_code;

    if (!options_read(&command, argc, argv, &exit_code))
        return exit_code;
    exit_code = set_panels(&self) ? sheet_run(&self.picture) : EXIT_FAILED;
    sheet_destroy(&self.picture);
    return exit_code;
}
