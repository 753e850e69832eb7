/* Patterns in run-length encoding, out. */
#include "base/stream.h"
#include "packard/rle.h"

#include <string.h>

enum { STAGED = 4096, LINE = 70, TOKEN = 24, CHUNK = 64 /* words of a row that are read at a time */ };

typedef struct rle_writer {
    snow_writer write;
    void *context;
    bool failed;
    size_t filled;
    char staged[STAGED];
    size_t column;
    uint64_t ends;  /* of rows that are not written yet */
    uint64_t blank; /* dead cells that are not written yet */
    uint64_t alive; /* living ones after them */
} rle_writer;

static void flush(rle_writer *writer)
{
    if (!writer->failed && writer->filled > 0)
        writer->failed = writer->write(writer->context, writer->staged, writer->filled) != 0;
    writer->filled = 0;
}

static void put_text(rle_writer *writer, const char *text)
{
    for (; *text != '\0'; text++) {
        if (writer->filled == STAGED)
            flush(writer);
        writer->staged[writer->filled++] = *text;
    }
}

/* Writes a number at the end of the text. */
static char *number_before(char *end, int64_t number)
{
    uint64_t magnitude = number < 0 ? 0 - (uint64_t)number : (uint64_t)number;
    do
        *--end = (char)('0' + magnitude % 10);
    while ((magnitude /= 10) > 0);
    if (number < 0)
        *--end = '-';
    return end;
}

static void put_number(rle_writer *writer, int64_t number)
{
    char text[TOKEN] = {0};
    put_text(writer, number_before(text + TOKEN - 1, number));
}

/* Lines are kept short, as the format asks. */
static void put_run(rle_writer *writer, uint64_t count, char what)
{
    char text[TOKEN] = {0};
    text[TOKEN - 2] = what;
    char *token = count == 1 ? text + TOKEN - 2 : number_before(text + TOKEN - 2, (int64_t)count);
    size_t length = strlen(token);
    if (count == 0)
        return;
    if (writer->column + length > LINE) {
        put_text(writer, "\n");
        writer->column = 0;
    }
    put_text(writer, token);
    writer->column += length;
}

static void end_run(rle_writer *writer)
{
    if (writer->alive == 0)
        return;
    put_run(writer, writer->ends, '$');
    put_run(writer, writer->blank, 'b');
    put_run(writer, writer->alive, 'o');
    writer->ends = writer->blank = writer->alive = 0;
}

static void put_cell(rle_writer *writer, bool alive)
{
    if (alive) {
        writer->alive++;
        return;
    }
    end_run(writer);
    writer->blank++;
}

static void put_blank(rle_writer *writer, int64_t count)
{
    if (count > 0)
        end_run(writer);
    writer->blank += (uint64_t)count;
}

/* Row r; its cells up to q stand left of the pattern's box, and none of them is frozen. */
static void put_row(rle_writer *writer, const snow_grid *grid, int64_t q, int64_t r)
{
    const packard *model = packard_of(grid);
    packard_region part;
    for (; snow_packard_next_in_row(grid, q, r, CHUNK * PACKARD_WORD, &part); q = part.q + part.width) {
        uint64_t words[CHUNK];
        put_blank(writer, part.q - q);
        model->engine->copy(model->cells, &part, words);
        for (int64_t i = 0; i < part.width; i++)
            put_cell(writer, (words[i / PACKARD_WORD] >> (i % PACKARD_WORD) & 1) != 0);
    }
    end_run(writer);
    writer->blank = 0;
    writer->ends++;
}

/* How many rows from r on have nothing that may be frozen. */
static int64_t empty_rows(const snow_grid *grid, int64_t r)
{
    packard_region block;
    const packard_region bounds = snow_packard_bounds(grid);
    return snow_packard_block_from(grid, bounds.q, r, &block) && block.r > r ? block.r - r : 0;
}

/* The pattern's box: its least x and y, and its extents. */
static packard_region box_of(const snow_grid *grid, const packard_axes *axes)
{
    const snow_hexagon *hexagon = &grid->census.hexagon;
    if (snow_hexagon_is_empty(hexagon))
        return (packard_region){0, 0, 0, 0};
    int64_t least_x = axes->mirrored ? hexagon->least_q : hexagon->least_s;
    int64_t greatest_x = axes->mirrored ? hexagon->greatest_q : hexagon->greatest_s;
    int64_t least_y = packard_y_of(axes, axes->mirrored ? hexagon->greatest_r : hexagon->least_r);
    int64_t greatest_y = packard_y_of(axes, axes->mirrored ? hexagon->least_r : hexagon->greatest_r);
    return (packard_region){least_x, least_y, greatest_x - least_x + 1, greatest_y - least_y + 1};
}

static void put_header(rle_writer *writer, const snow_grid *grid, const packard_region *box)
{
    const snow_packard_params *params = &packard_of(grid)->params;
    char rule[SNOW_PACKARD_RULE_SIZE];
    snow_packard_rule_text(params->rule, SNOW_PACKARD_BIRTHS, rule, sizeof rule);
    put_text(writer, "#CXRLE Pos=");
    put_number(writer, box->q);
    put_text(writer, ",");
    put_number(writer, box->r);
    put_text(writer, " Gen=");
    put_number(writer, grid->census.steps);
    put_text(writer, "\nx = ");
    put_number(writer, box->width);
    put_text(writer, ", y = ");
    put_number(writer, box->height);
    put_text(writer, ", rule = ");
    put_text(writer, rule);
    if (params->domain == SNOW_PACKARD_TORUS || params->domain == SNOW_PACKARD_RHOMBUS) {
        put_text(writer, params->domain == SNOW_PACKARD_TORUS ? ":T" : ":P");
        put_number(writer, params->width);
        put_text(writer, ",");
        put_number(writer, params->height);
    }
    put_text(writer, "\n");
}

static void write_pattern(rle_writer *writer, const snow_grid *grid)
{
    const packard *model = packard_of(grid);
    const packard_axes axes = packard_axes_of(&model->params);
    const packard_region box = box_of(grid, &axes);
    put_header(writer, grid, &box);
    for (int64_t y = box.r; y < box.r + box.height; y++) {
        int64_t skipped = axes.mirrored ? 0 : empty_rows(grid, y); /* worlds with sides are not that large */
        y += skipped;
        writer->ends += (uint64_t)skipped;
        put_row(writer, grid, packard_q_of(&axes, box.q, y), packard_y_of(&axes, y));
    }
    put_text(writer, "!\n");
    flush(writer);
}

static snow_status check(const snow_grid *grid)
{
    snow_status status = packard_check(grid);
    if (status != SNOW_OK)
        return status;
    const packard_axes axes = packard_axes_of(&packard_of(grid)->params);
    const packard_region box = box_of(grid, &axes);
    bool fits = packard_rle_reaches(box.q) && packard_rle_reaches(box.q + box.width) && packard_rle_reaches(box.r) &&
                packard_rle_reaches(box.r + box.height) && snow_census_frozen(&grid->census) <= PACKARD_RLE_CELLS;
    return fits ? SNOW_OK : SNOW_ERROR_TOO_LARGE;
}

snow_status snow_packard_save_rle_to(const snow_grid *grid, snow_writer write, void *context)
{
    snow_status status = check(grid);
    if (status != SNOW_OK)
        return status;
    if (write == NULL)
        return SNOW_ERROR_NULL;
    rle_writer writer = {.write = write, .context = context};
    write_pattern(&writer, grid);
    return writer.failed ? SNOW_ERROR_WRITE : SNOW_OK;
}

snow_status snow_packard_save_rle(const snow_grid *grid, void *buffer, size_t capacity, size_t *size)
{
    snow_status status = check(grid);
    if (status != SNOW_OK)
        return status;
    if (size == NULL)
        return SNOW_ERROR_NULL;
    return snow_save_whole(grid, snow_packard_save_rle_to, buffer, capacity, size);
}
