/*
 * From cells to pixels.
 *
 * A sample of a pixel belongs to the cell whose centre is nearest: that is what
 * makes the cells regular hexagons. The samples of a pixel are averaged as
 * light, not as bytes, so that a fine branch keeps its brightness when it is
 * drawn small; the sums are whole numbers, so no order of adding matters.
 *
 * No memory is asked for: the picture is drawn in blocks of columns, narrow
 * enough for the cells of two rows of the lattice to stand on the stack. A
 * grid's allocator may belong to one thread, but several may draw it at once.
 */
#include "base/floating.h"
#include "base/model.h"
#include "render/palette.h"
#include "render/view.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum {
    BLOCK = 512,  /* Columns of samples in a block, at most. */
    STRIP = 1024, /* Cells of a row that a block shows, at most. */
    SPARSE = 4    /* Where samples stand more than so many cells apart, cells are read one by one. */
};

/* Farther out than any grid reaches, and still safe to count in cells. */
#define FAR_AWAY 1073741824.0

/* The shades of cells of row r. */
typedef struct strip {
    bool filled;
    int32_t r;
    uint16_t shades[STRIP];
} strip;

/* The nearest cell to a column of samples in an even row [0] and in an odd row [1]. */
typedef struct column {
    double distance[2]; /* How far away its centre is, along the row. */
    uint16_t place[2];  /* Where its shade stands in the strip. */
} column;

/*
 * A line of samples lies between two rows of the lattice, `inner` and, farther
 * from y = 0, `outer`. A sample belongs to the nearest cell of the inner row
 * when that is no farther than `reach` along the line, else to the outer row.
 */
typedef struct sample_line {
    int32_t inner;
    int32_t outer;
    double reach;
} sample_line;

/* What the samples of a pixel add up to. */
typedef struct light_sum {
    uint32_t red;
    uint32_t green;
    uint32_t blue;
    uint32_t ice; /* How many samples fell on ice. */
} light_sum;

typedef struct drawing {
    const snow_grid *grid;
    snow_view view;
    snow_field field;
    bool cut_out; /* Whatever is not ice is transparent. */
    bool sparse;
    snow_paint paint;

    /* The block that is being drawn: the pixels begin <= x < end of each row. */
    int32_t begin;
    int32_t end;
    column columns[BLOCK];
    double first_centre[2]; /* Where the strip of an even row and that of an odd row begin. */
    int32_t cells[2];       /* How many cells each of them has. */
    strip strips[2];
} drawing;

static int parity(int32_t r)
{
    return r % 2 != 0;
}

/*
 * Where sample `index` of a row or column of `pixels` lies. It is counted from
 * the middle of the picture in whole numbers, so that both halves mirror exactly.
 */
static double coordinate_of(const snow_view *view, double centre, int32_t pixels, int32_t index)
{
    int32_t from_middle = 2 * index + 1 - pixels * view->samples;
    double coordinate = centre + from_middle / (2.0 * view->samples * view->scale);
    return fmin(fmax(coordinate, -FAR_AWAY), FAR_AWAY);
}

static double x_of(const snow_view *view, int32_t index)
{
    return coordinate_of(view, view->centre_x, view->width, index);
}

static sample_line line_at(const snow_view *view, int32_t index)
{
    double y = coordinate_of(view, view->centre_y, view->height, index);
    int32_t row = (int32_t)(fabs(y) / SNOW_ROW_DISTANCE);
    int32_t side = y < 0.0 ? -1 : 1;
    double beyond = fabs(y) - row * SNOW_ROW_DISTANCE;
    /* The points as near to (0, 0) as to (1/2, √3/2), a cell of the next row, are those with x = 1 − √3·y. */
    return (sample_line){side * row, side * (row + 1), 1.0 - 2.0 * SNOW_ROW_DISTANCE * beyond};
}

/*
 * The x nearest to `x` among the centres of a row, which stand at the integers
 * or, in odd rows, half-way between. Of two as near, the farther from x = 0 is
 * taken: then mirror images take mirror images.
 */
static double nearest_centre(double x, int odd)
{
    double shift = 0.5 * odd;
    return copysign((int32_t)(fabs(x) + 0.5 - shift) + shift, x);
}

/* Begins a block: which cells its samples can fall on is the same in all even rows, and in all odd ones. */
static void lay_columns(drawing *picture)
{
    const snow_view *view = &picture->view;
    int32_t first = picture->begin * view->samples;
    int32_t count = picture->end * view->samples - first;

    for (int odd = 0; odd < 2; odd++) {
        double begin = nearest_centre(x_of(view, first), odd);
        double end = nearest_centre(x_of(view, first + count - 1), odd);
        for (int32_t i = 0; i < count; i++) {
            double x = x_of(view, first + i);
            double centre = nearest_centre(x, odd);
            picture->columns[i].distance[odd] = fabs(x - centre);
            picture->columns[i].place[odd] = (uint16_t)(picture->sparse ? i : (int32_t)(centre - begin));
        }
        picture->first_centre[odd] = begin;
        picture->cells[odd] = picture->sparse ? count : (int32_t)(end - begin) + 1;
        picture->strips[odd].filled = false;
    }
}

static void read_field(const drawing *picture, int32_t q, int32_t r, int32_t count, double *numbers)
{
    picture->grid->operations->read(picture->grid, picture->field, q, r, (size_t)count, numbers);
}

/* Reads the field of the cells of row r that the columns can fall on. */
static void read_cells(const drawing *picture, int32_t r, double *numbers)
{
    int odd = parity(r);
    if (!picture->sparse) {
        int32_t q = (int32_t)(picture->first_centre[odd] - 0.5 * r);
        read_field(picture, q, r, picture->cells[odd], numbers);
        return;
    }
    for (int32_t i = 0; i < picture->cells[odd]; i++) {
        double x = x_of(&picture->view, picture->begin * picture->view.samples + i);
        int32_t q = (int32_t)(nearest_centre(x, odd) - 0.5 * r);
        read_field(picture, q, r, 1, &numbers[i]);
    }
}

static void fill_strip(drawing *picture, int32_t r)
{
    strip *strip_of_row = &picture->strips[parity(r)];
    if (strip_of_row->filled && strip_of_row->r == r)
        return;
    double numbers[STRIP];
    read_cells(picture, r, numbers);
    for (int32_t i = 0; i < picture->cells[parity(r)]; i++)
        strip_of_row->shades[i] = snow_paint_shade(&picture->paint, numbers[i]);
    strip_of_row->filled = true;
    strip_of_row->r = r;
}

/* Adds the light of a line of samples to the pixels of the block. */
static void add_line(drawing *picture, sample_line line, light_sum *sums)
{
    const column *next = picture->columns;
    int inner = parity(line.inner);

    if (line.reach >= 0.0)
        fill_strip(picture, line.inner);
    if (line.reach < 0.5)
        fill_strip(picture, line.outer);
    for (int32_t x = picture->begin; x < picture->end; x++, sums++) {
        light_sum sum = *sums;
        for (int32_t i = 0; i < picture->view.samples; i++, next++) {
            int odd = next->distance[inner] <= line.reach ? inner : 1 - inner;
            unsigned shade = picture->strips[odd].shades[next->place[odd]];
            bool ice = shade >= SNOW_SHADES;
            if (picture->cut_out && !ice)
                continue;
            sum.red += picture->paint.shade[shade].red;
            sum.green += picture->paint.shade[shade].green;
            sum.blue += picture->paint.shade[shade].blue;
            sum.ice += ice;
        }
        *sums = sum;
    }
}

static uint32_t divide(uint32_t sum, uint32_t parts)
{
    return (sum + parts / 2) / parts;
}

static void put_pixel(const drawing *picture, const light_sum *sum, unsigned char *pixel)
{
    uint32_t samples = (uint32_t)(picture->view.samples * picture->view.samples);
    uint32_t parts = picture->cut_out ? sum->ice : samples;
    if (parts == 0) {
        memset(pixel, 0, 4);
        return;
    }
    uint32_t red = divide(sum->red, parts);
    uint32_t green = divide(sum->green, parts);
    uint32_t blue = divide(sum->blue, parts);

    if (picture->view.pixel == SNOW_PIXEL_GREY) {
        /* Luminance, as ITU-R BT.709 weights the primaries of sRGB. */
        pixel[0] = snow_paint_byte(&picture->paint, divide(2126 * red + 7152 * green + 722 * blue, 10000));
        return;
    }
    pixel[0] = snow_paint_byte(&picture->paint, red);
    pixel[1] = snow_paint_byte(&picture->paint, green);
    pixel[2] = snow_paint_byte(&picture->paint, blue);
    if (picture->view.pixel == SNOW_PIXEL_RGBA)
        pixel[3] = (unsigned char)divide(255 * parts, samples);
}

static size_t bytes_of(snow_pixel pixel)
{
    switch (pixel) {
    case SNOW_PIXEL_GREY:
        return 1;
    case SNOW_PIXEL_RGB:
        return 3;
    default:
        return 4;
    }
}

static void draw_block(drawing *picture, unsigned char *pixels)
{
    const snow_view *view = &picture->view;
    size_t bytes = bytes_of(view->pixel);

    lay_columns(picture);
    for (int32_t y = 0; y < view->height; y++) {
        light_sum sums[BLOCK] = {{0, 0, 0, 0}};
        for (int32_t i = 0; i < view->samples; i++)
            add_line(picture, line_at(view, y * view->samples + i), sums);
        unsigned char *row = pixels + (size_t)y * (size_t)view->width * bytes;
        for (int32_t x = picture->begin; x < picture->end; x++)
            put_pixel(picture, &sums[x - picture->begin], row + (size_t)x * bytes);
    }
}

static void find_greatest_in(const snow_grid *grid, snow_field field, const snow_rect *part, double *greatest)
{
    double numbers[STRIP];
    for (int32_t r = part->r; r < part->r + part->height; r++)
        for (int32_t done = 0; done < part->width; done += STRIP) {
            int32_t length = part->width - done < STRIP ? part->width - done : STRIP;
            grid->operations->read(grid, field, part->q + done, r, (size_t)length, numbers);
            for (int32_t i = 0; i < length; i++)
                *greatest = fmax(*greatest, numbers[i]);
        }
}

/* The greatest number of a field on ice: everywhere else it is less. */
static snow_status find_greatest(const snow_grid *grid, snow_field field, double *greatest)
{
    snow_rect ice;
    snow_status status = snow_frozen_bounds(grid, &ice);
    bool known = grid->operations->binary && field == SNOW_FIELD_VALUE;

    *greatest = known ? 1.0 : 0.0;
    snow_rect part = {0, 0, 0, 0};
    while (!known && status == SNOW_OK && snow_frozen_next(grid, &part))
        find_greatest_in(grid, field, &part, greatest);
    return status;
}

static snow_status draw(const snow_grid *grid, const snow_view *view, unsigned char *pixels)
{
    drawing picture;
    double greatest;

    picture.grid = grid;
    picture.view = *view;
    picture.field = snow_palette_field(view->palette);
    picture.cut_out = view->transparent && view->pixel == SNOW_PIXEL_RGBA;
    picture.sparse = SPARSE * view->samples * view->scale < 1.0;
    snow_status status = find_greatest(grid, picture.field, &greatest);
    if (status != SNOW_OK)
        return status;
    snow_paint_mix(&picture.paint, view->palette, greatest);

    /* Less than a cell can be added at each end, and rounding may add one. */
    int32_t width = BLOCK / view->samples;
    if (!picture.sparse && (STRIP - 4) * view->scale < width)
        width = (int32_t)((STRIP - 4) * view->scale);
    for (int32_t x = 0; x < view->width; x += width) {
        picture.begin = x;
        picture.end = view->width - x < width ? view->width : x + width;
        draw_block(&picture, pixels);
    }
    return SNOW_OK;
}

snow_status snow_render(const snow_grid *grid, const snow_view *view, void *pixels, size_t capacity, size_t *size)
{
    if (grid == NULL || view == NULL || (pixels == NULL && size == NULL))
        return SNOW_ERROR_NULL;
    snow_view checked;
    snow_status status = snow_view_read(view, &checked);
    double number;
    if (status == SNOW_OK)
        status = snow_view_check_lattice(grid);
    if (status == SNOW_OK)
        status = snow_cell_value(grid, snow_palette_field(checked.palette), 0, 0, &number);
    if (status != SNOW_OK)
        return status;

    uint64_t bytes = (uint64_t)checked.width * (uint64_t)checked.height * bytes_of(checked.pixel);
    if (bytes > SIZE_MAX)
        return SNOW_ERROR_RANGE;
    if (size != NULL)
        *size = (size_t)bytes;
    if (pixels == NULL)
        return SNOW_OK;
    if (capacity < bytes)
        return SNOW_ERROR_BUFFER;

    snow_floating floating;
    snow_floating_enter(&floating);
    status = draw(grid, &checked, pixels);
    snow_floating_leave(&floating);
    return status;
}
