/* Reiter's fig. 7: crystals that fall into other air while they grow. */
#include "common/message.h"
#include "common/sheet.h"

#include <stdio.h>

typedef struct story {
    double beta;
    double gamma;
    double then_beta;
    double then_gamma;
} story;

/* A plate that grows dendrites; a dendrite that grows sectors. */
static const story stories[] = {{0.4, 0.5, 0.4, 0.001}, {0.35, 0.0001, 0.9, 0.08}};

enum { STORIES = sizeof stories / sizeof stories[0] };

typedef struct changes {
    sheet picture;
    double turn; /* tip radius at the change */
    int32_t radius;
    int64_t max_steps;
} changes;

/* Left before the change, right at the end. */
static void set_panel(const changes *self, int32_t column, int32_t row)
{
    const story *told = &stories[row];
    panel *it = sheet_panel(&self->picture, column, row);
    it->params.background = told->beta;
    it->params.addition = told->gamma;
    it->params.radius = self->radius;
    it->stop.max_steps = self->max_steps;
    it->stop_again.max_steps = self->max_steps;
    it->stop.tip_radius = self->turn;
    it->changes = column == 1;
    it->conditions.background = told->then_beta;
    it->conditions.addition = told->then_gamma;
    if (it->changes)
        snprintf(it->caption, sizeof it->caption, "then β = %g, γ = %g", told->then_beta, told->then_gamma);
    else
        snprintf(it->caption, sizeof it->caption, "β = %g, γ = %g", told->beta, told->gamma);
}

static bool set_panels(changes *self)
{
    if (!sheet_set_panels(&self->picture, 2, 2 * STORIES, false))
        return false;
    for (int32_t row = 0; row < STORIES; row++)
        for (int32_t column = 0; column < 2; column++)
            set_panel(self, column, row);
    return true;
}

int main(int argc, char **argv)
{
    changes self = {.turn = 70, .radius = 200, .max_steps = 10000};
    sheet_init(&self.picture);
    self.picture.panel_size = 480;
    option_row rows[] = {
        OPTION_GROUP("The crystals"),
        OPTION_NUMBER("turn", &self.turn, "the conditions change when the arms are so long (70)"),
        OPTION_INTEGER("radius", "CELLS", &self.radius, INT32_MIN, INT32_MAX, "of the discs (200)"),
        OPTION_LONG("max-steps", "STEPS", &self.max_steps, 0, INT64_MAX, "end there at the latest (10000)"),
        SHEET_ROWS(&self.picture, "480", "paper"),
        OPTION_END,
    };
    program command = {"changing_conditions",
                       "Draws Reiter's fig. 7: crystals before and after a change of the conditions. With a new\n"
                       "background, all vapour is rescaled in proportion.",
                       "changing_conditions --turn 100 --palette frost --out conditions.png", rows};
    int exit_code;

    if (!options_read(&command, argc, argv, &exit_code))
        return exit_code;
    exit_code = set_panels(&self) ? sheet_run(&self.picture) : EXIT_FAILED;
    sheet_destroy(&self.picture);
    return exit_code;
}
