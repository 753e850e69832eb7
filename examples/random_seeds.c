/* Reiter's fig. 6: crystals that begin with a random patch. */
#include "common/message.h"
#include "common/sheet.h"

#include <inttypes.h>
#include <stdio.h>

typedef struct patches {
    sheet picture;
    uint64_t first;
    int32_t count;
    int32_t radius;
    int64_t max_steps;
} patches;

/* A row of the sheet: the thin and the thick dendrite of fig. 4, on small and larger patches. */
static const struct {
    const char *name;
    int32_t cluster;
} kinds[] = {{"thin-dendrite", 3}, {"thick-dendrite", 3}, {"thin-dendrite", 5}, {"thick-dendrite", 5}};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

static snow_status set_panel(const patches *self, int32_t column, int32_t row)
{
    panel *it = sheet_panel(&self->picture, column, row);
    snow_status status = snow_reiter_params_preset(&it->params, kinds[row].name);
    it->params.cluster = kinds[row].cluster;
    it->params.random_seed = self->first + (uint64_t)column;
    it->params.radius = self->radius;
    it->stop.max_steps = self->max_steps;
    snprintf(it->caption, sizeof it->caption, "β = %g, γ = %g, q = %d, seed %" PRIu64, it->params.background,
             it->params.addition, (int)it->params.cluster, it->params.random_seed);
    return status;
}

static int set_panels(patches *self)
{
    if (!sheet_set_panels(&self->picture, self->count, self->count * KINDS, false))
        return EXIT_FAILED;
    for (int32_t row = 0; row < KINDS; row++) {
        for (int32_t column = 0; column < self->count; column++) {
            snow_status status = set_panel(self, column, row);
            if (status != SNOW_OK)
                return complain_status(kinds[row].name, status);
        }
    }
    return EXIT_DONE;
}

int main(int argc, char **argv)
{
    patches self = {.first = 1, .count = 4, .radius = 200, .max_steps = 10000};
    sheet_init(&self.picture);
    option_row rows[] = {
        OPTION_GROUP("The crystals"),
        OPTION_UNSIGNED("random-seed", &self.first, "of the first column (1)"),
        OPTION_INTEGER("count", "COUNT", &self.count, 1, 64, "columns, a random seed each (4)"),
        OPTION_INTEGER("radius", "CELLS", &self.radius, INT32_MIN, INT32_MAX, "of the discs (200)"),
        OPTION_LONG("max-steps", "STEPS", &self.max_steps, 0, INT64_MAX, "end there at the latest (10000)"),
        SHEET_ROWS(&self.picture, "320", "paper"),
        OPTION_END,
    };
    program command = {"random_seeds",
                       "Draws crystals like those of Reiter's fig. 6, which begin with a random patch of q x q cells.",
                       "random_seeds --random-seed 7 --count 3 --palette frost --out random.png", rows};
    int exit_code;

    if (!options_read(&command, argc, argv, &exit_code))
        return exit_code;
    exit_code = set_panels(&self);
    if (exit_code == EXIT_DONE)
        exit_code = sheet_run(&self.picture);
    sheet_destroy(&self.picture);
    return exit_code;
}
