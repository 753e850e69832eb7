/* Reiter's fig. 3: the forms of growth over background and addition, as one picture. */
#include "common/message.h"
#include "common/output.h"
#include "common/sheet.h"

#include <inttypes.h>
#include <stdio.h>

static const number_list paper_betas = {11, {0, .1, .2, .3, .4, .5, .6, .7, .8, .9, .95}};
static const number_list paper_gammas = {7, {0, .0001, .001, .0035, .01, .05, 1}};

/* The additions are the report's; it leaves the backgrounds open. */
static const number_list report_betas = {9, {.1, .2, .3, .4, .5, .6, .7, .8, .9}};
static const number_list report_gammas = {6, {.0001, .001, .0025, .004, .05, 1}};

#define TITLE "forms of growth over background β and addition γ"

enum { PAPER_STEPS = 10000, REPORT_STEPS = 3000 };

typedef struct table {
    sheet picture;
    number_list betas;
    number_list gammas;
    int32_t radius;
    int64_t max_steps;
    int32_t polish;
    const char *csv;
} table;

static void set_panel(const table *self, int32_t column, int32_t row)
{
    panel *it = sheet_panel(&self->picture, column, row);
    it->params.background = self->betas.numbers[column];
    it->params.addition = self->gammas.numbers[row];
    it->params.radius = self->radius;
    it->stop.max_steps = self->max_steps;
    if (self->polish) {
        it->params.domain = SNOW_REITER_RECTANGLE; /* 600 x 600, as the library's defaults are */
        it->params.rim = SNOW_REITER_RIM_ROW;
    }
}

static bool set_panels(table *self)
{
    sheet *it = &self->picture;
    int32_t columns = (int32_t)self->betas.count;
    int32_t rows = (int32_t)self->gammas.count;
    if (!sheet_set_panels(it, columns, columns * rows, true))
        return false;
    for (int32_t column = 0; column < columns; column++)
        snprintf(it->column_labels[column], LONGEST_LABEL, "β = %.4g", self->betas.numbers[column]);
    for (int32_t row = 0; row < rows; row++) {
        snprintf(it->row_labels[row], LONGEST_LABEL, "γ = %.4g", self->gammas.numbers[row]);
        for (int32_t column = 0; column < columns; column++)
            set_panel(self, column, row);
    }
    if (self->polish)
        snprintf(it->footer, sizeof it->footer,
                 TITLE "; 600 x 600 cells, until ice is in row 17 or step %" PRId64 "; α = 1", self->max_steps);
    else
        snprintf(it->footer, sizeof it->footer, TITLE "; disc of radius %d, until ice nears its rim or step %" PRId64
                 "; α = 1", (int)self->radius, self->max_steps);
    return true;
}

static bool write_csv(const table *self, output *csv)
{
    if (csv->name == NULL)
        return true;
    fputs("beta,gamma,steps,frozen,tip,reason\n", csv->file);
    for (int32_t i = 0; i < self->picture.count; i++) {
        const panel *it = &self->picture.panels[i];
        if (it->done)
            fprintf(csv->file, "%g,%g,%" PRId64 ",%" PRIu64 ",%.6g,%s\n", it->params.background, it->params.addition,
                    it->summary.steps, it->summary.frozen, it->summary.tip_radius,
                    snow_stop_name(it->summary.reason));
    }
    return output_commit(csv);
}

/* What was not given on the command line is the paper's or, with --polish, the report's. */
static bool set_defaults(table *self, const program *command)
{
    if (self->polish && option_given(command, "radius")) {
        complain("--radius does not go with --polish, whose crystals grow in a rectangle");
        return false;
    }
    if (self->betas.count == 0)
        self->betas = self->polish ? report_betas : paper_betas;
    if (self->gammas.count == 0)
        self->gammas = self->polish ? report_gammas : paper_gammas;
    if (!option_given(command, "max-steps"))
        self->max_steps = self->polish ? REPORT_STEPS : PAPER_STEPS;
    return true;
}

int main(int argc, char **argv)
{
    table self = {.radius = 200};
    sheet_init(&self.picture);
    option_row rows[] = {
        OPTION_GROUP("The table"),
        OPTION_LIST("betas", &self.betas, "backgrounds, a column each (the paper's 11); 0:0.95:20 stands for 20 numbers"),
        OPTION_LIST("gammas", &self.gammas, "additions, a row each (the paper's 7); 0.0001:1:20log for 20 with equal ratios"),
        OPTION_INTEGER("radius", "CELLS", &self.radius, INT32_MIN, INT32_MAX, "of the discs (200)"),
        OPTION_LONG("max-steps", "STEPS", &self.max_steps, 0, INT64_MAX, "end there (10000; with --polish 3000)"),
        OPTION_FLAG("polish", &self.polish, "the rows of the report of Połuszejko and Grabiński"),
        OPTION_TEXT("csv", "FILE", &self.csv, "how each crystal ended, as a table of numbers"),
        SHEET_ROWS(&self.picture, "320", "paper"),
        OPTION_END,
    };
    program command = {"table",
                       "Draws the table of Reiter's fig. 3: a snow crystal for each background (beta) and\n"
                       "addition (gamma). Ctrl-C ends it early; the finished panels are drawn.",
                       "table --threads 4 --out table.png", rows};
    output csv;
    int exit_code;

    if (!options_read(&command, argc, argv, &exit_code))
        return exit_code;
    if (!set_defaults(&self, &command))
        return EXIT_WRONG;
    exit_code = EXIT_FAILED;
    if (output_open(&csv, self.csv)) {
        if (set_panels(&self))
            exit_code = sheet_run(&self.picture);
        if (exit_code == EXIT_DONE && !write_csv(&self, &csv))
            exit_code = EXIT_FAILED;
        output_discard(&csv);
    }
    sheet_destroy(&self.picture);
    return exit_code;
}
