/* The figures of Liu and Zhang's paper of 1987 as one sheet. */
#include "common/message.h"
#include "common/sheet.h"
#include "common/zone.h"

#include <stdio.h>

typedef struct figure {
    const char *name;
    const char *rule;
    const char *zone; /* NULL: none */
    int64_t steps;    /* where the paper says nothing, those at which it shows what the text describes */
} figure;

static const figure figures[] = {
    {"3a", "0101010", NULL, 27},
    {"3b", "0100010", NULL, 27},
    {"4a", "0100000", "clefts:1-16:8d", 16},
    {"4b", "0110100", "clefts:5-22:8d", 22},
    {"5a", "0101010", "tips:4-5", 23},
    {"5b", "0101010", "tips:4", 23},
    {"5c", "0110000", "tips:7-8", 12},
    {"6", "0101010", NULL, 19},
    {"6", "0101010", NULL, 23},
    {"6", "0101010", NULL, 27},
};

enum { FIGURES = sizeof figures / sizeof figures[0], COLUMNS = 5 };

static snow_status create(const panel *self, bool dated, const snow_options *options, snow_grid **grid)
{
    const figure *it = self->crystal;
    snow_packard_params params;
    zone_list zones = {0};
    snow_packard_params_init(&params, sizeof params);
    params.record_freeze_steps = dated;
    snow_status status = snow_packard_params_rule(&params, it->rule);
    if (status == SNOW_OK && it->zone != NULL && !zone_take(&zones, it->zone))
        status = SNOW_ERROR_PACKARD_ZONE;
    if (status == SNOW_OK)
        status = snow_packard_create(&params, options, grid);
    return status == SNOW_OK ? zones_add(&zones, *grid) : status;
}

static bool set_panels(sheet *self)
{
    if (!sheet_set_panels(self, COLUMNS, FIGURES, false))
        return false;
    for (int32_t i = 0; i < FIGURES; i++) {
        panel *it = &self->panels[i];
        const figure *shown = &figures[i];
        it->create = create;
        it->crystal = shown;
        it->stop.max_steps = shown->steps;
        snprintf(it->caption, sizeof it->caption, "%s: %s%s%s, step %d", shown->name, shown->rule,
                 shown->zone != NULL ? ", " : "", shown->zone != NULL ? shown->zone : "", (int)shown->steps);
    }
    return true;
}

int main(int argc, char **argv)
{
    sheet it;
    sheet_init(&it);
    it.palette = SNOW_PALETTE_INK;
    option_row rows[] = {SHEET_ROWS(&it, "320", "ink"), OPTION_END};
    program command = {"packard_figures",
                       "Draws figs. 3 to 6 of the paper in which Liu Shida and Zhang Ziguo grew snowflakes by\n"
                       "Boolean rules, some of them with zones.",
                       "packard_figures --palette age --out figures.png", rows};
    int exit_code;

    if (!options_read(&command, argc, argv, &exit_code))
        return exit_code;
    exit_code = set_panels(&it) ? sheet_run(&it) : EXIT_FAILED;
    sheet_destroy(&it);
    return exit_code;
}
