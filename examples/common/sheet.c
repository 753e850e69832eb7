#include "common/sheet.h"

#include "common/label.h"
#include "common/message.h"
#include "common/output.h"
#include "common/png.h"
#include "common/progress.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

static const colour paper = {255, 255, 255};
static const colour empty = {232, 232, 232};
static const colour words = {24, 24, 24};
static const colour small_words = {96, 96, 96};

enum { SAMPLES = 4 };

/* Pixels: where things stand on the sheet. */
typedef struct layout {
    int32_t left;
    int32_t top;
    int32_t column; /* from one panel to the next */
    int32_t row;
    int32_t width;
    int32_t height;
    double text;
    double caption;
} layout;

/* What the threads share. */
typedef struct work {
    sheet *self;
    picture image;
    layout place;
    pthread_mutex_t lock;
    int32_t done;
    snow_status failure;
} work;

void sheet_init(sheet *self)
{
    *self = (sheet){.panel_size = 320, .threads = 1, .palette = SNOW_PALETTE_PAPER};
}

static snow_status create_reiter(const panel *self, bool dated, const snow_options *options, snow_grid **grid)
{
    snow_reiter_params params = self->params;
    params.record_freeze_steps = dated;
    return snow_reiter_create(&params, options, grid);
}

static void set_defaults(panel *self)
{
    self->create = create_reiter;
    snow_reiter_params_init(&self->params, sizeof self->params);
    snow_reiter_conditions_init(&self->conditions, sizeof self->conditions);
    snow_summary_init(&self->summary, sizeof self->summary);
    snow_stop_init(&self->stop, sizeof self->stop);
    self->stop.progress = progress_of_panel;
    self->stop.progress_steps = 10;
    self->stop_again = self->stop;
}

bool sheet_set_panels(sheet *self, int32_t columns, int32_t count, bool labels)
{
    self->columns = columns;
    self->rows = (count + columns - 1) / columns;
    self->count = count;
    self->panels = calloc((size_t)count, sizeof *self->panels);
    self->column_labels = labels ? calloc((size_t)columns, sizeof *self->column_labels) : NULL;
    self->row_labels = labels ? calloc((size_t)self->rows, sizeof *self->row_labels) : NULL;
    if (self->panels == NULL || (labels && (self->column_labels == NULL || self->row_labels == NULL))) {
        complain("no memory for %d panels", (int)count);
        return false;
    }
    for (int32_t i = 0; i < count; i++)
        set_defaults(&self->panels[i]);
    return true;
}

panel *sheet_panel(const sheet *self, int32_t column, int32_t row)
{
    return &self->panels[(size_t)row * (size_t)self->columns + (size_t)column];
}

void sheet_destroy(sheet *self)
{
    free(self->panels);
    free(self->column_labels);
    free(self->row_labels);
}

static bool any_caption(const sheet *self)
{
    for (int32_t i = 0; i < self->count; i++)
        if (self->panels[i].caption[0])
            return true;
    return false;
}

static double widest_row_label(const sheet *self, double text)
{
    double widest = 0;
    for (int32_t i = 0; self->row_labels && i < self->rows; i++)
        widest = fmax(widest, label_width(self->row_labels[i], text));
    return widest;
}

/* The greatest height up to a wanted one at which every caption fits under its panel, and is apart from the next. */
static double caption_height(const sheet *self, double wanted)
{
    double height = wanted;
    double room = self->panel_size - wanted;
    for (int32_t i = 0; i < self->count; i++)
        height = fmin(height, wanted * room / fmax(1, label_width(self->panels[i].caption, wanted)));
    return height;
}

static layout lay_out(const sheet *self)
{
    int32_t size = self->panel_size;
    int32_t gap = size / 40 + 1;
    double text = fmax(7, size / (self->column_labels ? 12.0 : 16.0));
    int32_t line = (int32_t)(2.2 * text);
    double caption = caption_height(self, 0.7 * text);
    layout place = {.text = text, .caption = caption};
    place.column = size + gap;
    place.row = size + gap + (any_caption(self) ? (int32_t)(2.6 * caption) : 0);
    place.left = 2 * gap + (self->row_labels ? (int32_t)(widest_row_label(self, text) + text) + gap : 0);
    place.top = 2 * gap + (self->column_labels ? line : 0);
    place.width = place.left + self->columns * place.column + gap;
    place.height = place.top + self->rows * place.row + gap + (self->footer[0] ? line : 0);
    return place;
}

/* Columns from a label to the next, so that none covers another. */
static int32_t label_interval(const sheet *self, const layout *place)
{
    double widest = 0;
    for (int32_t i = 0; i < self->columns; i++)
        widest = fmax(widest, label_width(self->column_labels[i], place->text));
    return (int32_t)((widest + place->text) / place->column) + 1;
}

static void write_words(const sheet *self, const picture *image, const layout *place)
{
    picture target = *image;
    double text = place->text;
    double half = self->panel_size / 2.0;
    for (int32_t i = 0; self->column_labels && i < self->columns; i += label_interval(self, place))
        label_draw(&target, self->column_labels[i], text,
                   place->left + i * place->column + half - label_width(self->column_labels[i], text) / 2,
                   place->top - text, words);
    for (int32_t i = 0; self->row_labels && i < self->rows; i += (int32_t)(1.5 * text / place->row) + 1)
        label_draw(&target, self->row_labels[i], text,
                   place->left - text - label_width(self->row_labels[i], text),
                   place->top + i * place->row + half + text / 2, words);
    for (int32_t i = 0; i < self->count; i++)
        label_draw(&target, self->panels[i].caption, place->caption, place->left + i % self->columns * place->column,
                   place->top + i / self->columns * place->row + self->panel_size + place->caption * 1.6, words);
    label_draw(&target, self->footer, place->caption, place->left, place->height - text, small_words);
}

/* Panels do not overlap, so that several threads may draw at the same time. */
static snow_status draw(work *shared, const panel *it, const snow_grid *grid)
{
    const sheet *self = shared->self;
    int32_t index = (int32_t)(it - self->panels);
    look appearance = {self->palette, self->panel_size, SAMPLES, 0};
    snow_view view;
    picture image;
    snow_status status = look_view(&appearance, grid, &view);
    view.width = self->panel_size;
    view.height = self->panel_size;
    if (self->reach > 0)
        view.scale = self->panel_size / (2 * self->reach);
    if (status == SNOW_OK)
        status = picture_of_grid(&image, grid, &view);
    if (status != SNOW_OK)
        return status;
    picture_paste(&shared->image, &image, shared->place.left + index % self->columns * shared->place.column,
                  shared->place.top + index / self->columns * shared->place.row);
    picture_destroy(&image);
    return SNOW_OK;
}

static void note_instability(panel *it)
{
    size_t length = strlen(it->caption);
    if (it->summary.reason == SNOW_STOP_UNSTABLE)
        snprintf(it->caption + length, sizeof it->caption - length, ", unstable at step %lld",
                 (long long)it->summary.steps);
}

/* The second half of a growth under changing conditions. */
static snow_status go_on(panel *it, snow_grid *grid)
{
    if (!it->changes || it->summary.reason == SNOW_STOP_CANCELLED)
        return SNOW_OK;
    snow_status status = snow_reiter_change(grid, &it->conditions);
    return status == SNOW_OK ? snow_run(grid, &it->stop_again, &it->summary) : status;
}

static snow_status start_panel(void *context, size_t index, const snow_options *options, snow_stop *stop,
                               snow_grid **grid)
{
    const work *shared = context;
    const panel *it = &shared->self->panels[index];
    *stop = it->stop;
    return it->create(it, palette_shows_age(shared->self->palette), options, grid);
}

/* What an unstable field leaves is worth drawing, too. */
static int finish_panel(void *context, size_t index, snow_status status, snow_grid *grid, const snow_summary *summary)
{
    work *shared = context;
    panel *it = &shared->self->panels[index];
    it->summary = *summary;
    if (status == SNOW_OK)
        status = go_on(it, grid);
    note_instability(it);
    status = status == SNOW_ERROR_UNSTABLE ? SNOW_OK : status;
    bool finished = status == SNOW_OK && it->summary.reason != SNOW_STOP_CANCELLED;
    if (finished && shared->self->out)
        status = draw(shared, it, grid);
    it->done = finished && status == SNOW_OK;

    pthread_mutex_lock(&shared->lock);
    shared->failure = status != SNOW_OK ? status : shared->failure;
    shared->done += it->done;
    progress_show("%d of %d panels are done", (int)shared->done, (int)shared->self->count);
    pthread_mutex_unlock(&shared->lock);
    return status != SNOW_OK || progress_cancelled();
}

static void grow_all(work *shared)
{
    snow_options options;
    snow_options_init(&options, sizeof options);
    options.threads = shared->self->threads;
    progress_show("0 of %d panels are done", (int)shared->self->count);
    snow_status status =
        snow_sweep((size_t)shared->self->count, start_panel, finish_panel, shared, NULL, &options);
    shared->failure = status != SNOW_OK ? status : shared->failure;
}

static bool start_picture(work *shared)
{
    if (shared->self->out == NULL)
        return true;
    const layout *place = &shared->place;
    if (!picture_create(&shared->image, place->width, place->height, 3))
        return false;
    picture_fill(&shared->image, paper);
    picture blank;
    if (!picture_create(&blank, shared->self->panel_size, shared->self->panel_size, 3))
        return false;
    picture_fill(&blank, empty);
    for (int32_t i = 0; i < shared->self->count; i++)
        picture_paste(&shared->image, &blank, place->left + i % shared->self->columns * place->column,
                      place->top + i / shared->self->columns * place->row);
    picture_destroy(&blank);
    return true;
}

static int finish(work *shared, output *file, double seconds)
{
    const sheet *self = shared->self;
    progress_clear();
    if (shared->failure != SNOW_OK) {
        output_discard(file);
        return complain_status(NULL, shared->failure);
    }
    if (self->out) {
        write_words(self, &shared->image, &shared->place);
        if (!png_write(file, &shared->image))
            return EXIT_FAILED;
    }
    if (shared->done < self->count)
        complain("stopped; %d of %d panels are done", (int)shared->done, (int)self->count);
    return print_line("panels=%d done=%d seconds=%.1f\n", (int)self->count, (int)shared->done, seconds);
}

/* Wrong numbers are found before hours are spent on the right ones. */
static int check_panels(const sheet *self)
{
    for (int32_t i = 0; i < self->count; i++) {
        snow_grid *grid = NULL;
        snow_status status = self->panels[i].create(&self->panels[i], false, NULL, &grid);
        snow_destroy(grid);
        if (status != SNOW_OK)
            return complain_status(NULL, status);
    }
    return EXIT_DONE;
}

int sheet_run(sheet *self)
{
    work shared = {.self = self, .place = lay_out(self), .lock = PTHREAD_MUTEX_INITIALIZER};
    output file;
    int exit_code = EXIT_FAILED;
    double start = progress_clock();
    progress_start();
    int wrong = check_panels(self);
    if (wrong != EXIT_DONE)
        return wrong;
    if (!output_open(&file, self->out))
        return EXIT_FAILED;
    if (start_picture(&shared)) {
        grow_all(&shared);
        exit_code = finish(&shared, &file, progress_clock() - start);
    }
    output_discard(&file);
    picture_destroy(&shared.image);
    return exit_code;
}
