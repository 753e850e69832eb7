/* A sheet: one picture of many crystals in rows and columns, with words round them. */
#ifndef EXAMPLES_SHEET_H
#define EXAMPLES_SHEET_H

#include "common/options.h"
#include "common/picture.h"
#include "common/scene.h"

#include <snowgrowth/snowgrowth.h>

enum { LONGEST_LABEL = 96 };

typedef struct panel {
    /* Makes its grid: of Reiter's model from `params`, or what a program of another model puts here. */
    snow_status (*create)(const struct panel *self, bool dated, const snow_options *options, snow_grid **grid);
    const void *crystal; /* for such a program */
    snow_reiter_params params;
    snow_stop stop;
    bool changes; /* goes on under other conditions until `stop_again` */
    snow_reiter_conditions conditions;
    snow_stop stop_again;
    char caption[LONGEST_LABEL]; /* stands under it; "" where no panel has one */

    bool done; /* then the summary says how it ended */
    snow_summary summary;
} panel;

typedef struct sheet {
    int32_t columns;
    int32_t rows;
    int32_t count; /* of panels; the last row may be short */
    panel *panels; /* row after row */
    char (*column_labels)[LONGEST_LABEL]; /* NULL: none */
    char (*row_labels)[LONGEST_LABEL];
    char footer[2 * LONGEST_LABEL]; /* "": none */
    double reach; /* cells from the centre to the side of a panel; 0: panels show the whole interior */

    /* From the command line. */
    const char *out;
    int32_t panel_size;
    int32_t threads;
    snow_palette palette;
} sheet;

#define SHEET_ROWS(it, size, colours) \
    OPTION_GROUP("The picture"), \
    OPTION_TEXT("out", "FILE.png", &(it)->out, "write a picture there; without this option, none"), \
    OPTION_INTEGER("panel", "PIXELS", &(it)->panel_size, 16, 4096, "side of a panel (" size ")"), \
    OPTION_CHOICE("palette", palette_names, &(it)->palette, "colours (" colours ")"), \
    OPTION_INTEGER("threads", "COUNT", &(it)->threads, 0, 1024, "panels that grow at once; 0: one a processor (1)")

/* Writes the defaults of the options. */
void sheet_init(sheet *self);

/* Sets so many panels, each with the library's defaults; false, after a complaint, without memory. */
bool sheet_set_panels(sheet *self, int32_t columns, int32_t count, bool labels);

panel *sheet_panel(const sheet *self, int32_t column, int32_t row);

/*
 * Grows all panels, writes the picture and prints one line about it. After
 * Ctrl-C the finished panels are drawn. Returns the exit code.
 */
int sheet_run(sheet *self);

void sheet_destroy(sheet *self);

#endif
