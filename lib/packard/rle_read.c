/* Patterns in run-length encoding, in. */
#include "base/floating.h"
#include "base/stream.h"
#include "base/structs.h"
#include "packard/rle.h"

#include <string.h>

enum { RULE_LENGTH = 64, CHUNK = 64 /* words of cells that are put at a time */ };

typedef struct rle_reader {
    const char *next;
    const char *end;
    bool placed;      /* the text says where the pattern lies */
    int64_t x, y;     /* of its first cell */
    int64_t steps;
    snow_packard_params params;
} rle_reader;

static void skip_blanks(rle_reader *reader)
{
    while (reader->next < reader->end && (*reader->next == ' ' || *reader->next == '\t'))
        reader->next++;
}

static const char *end_of_line(const rle_reader *reader)
{
    const char *end = reader->next;
    while (end < reader->end && *end != '\n' && *end != '\r')
        end++;
    return end;
}

static bool is_digit(const rle_reader *reader)
{
    return reader->next < reader->end && *reader->next >= '0' && *reader->next <= '9';
}

/* A number, or something beyond 2^62 for one that is greater. */
static bool read_magnitude(rle_reader *reader, int64_t *number)
{
    if (!is_digit(reader))
        return false;
    for (*number = 0; is_digit(reader); reader->next++)
        *number = *number <= (INT64_C(1) << 62) / 10 ? 10 * *number + (*reader->next - '0') : INT64_MAX;
    return true;
}

static bool read_number(rle_reader *reader, int64_t *number)
{
    bool negative = reader->next < reader->end && *reader->next == '-';
    reader->next += negative;
    if (!read_magnitude(reader, number))
        return false;
    *number = negative ? -*number : *number;
    return true;
}

static bool read_word(rle_reader *reader, const char *word)
{
    size_t length = strlen(word);
    if ((size_t)(reader->end - reader->next) < length || memcmp(reader->next, word, length) != 0)
        return false;
    reader->next += length;
    return true;
}

/* "#CXRLE Pos=-3,4 Gen=10": parts that are not understood are passed over. */
static snow_status read_place(rle_reader *reader, const char *end)
{
    while (reader->next < end) {
        bool sound = true;
        if (read_word(reader, "Pos=")) {
            sound = read_number(reader, &reader->x) && read_word(reader, ",") && read_number(reader, &reader->y);
            reader->placed = true;
        } else if (read_word(reader, "Gen=")) {
            sound = read_magnitude(reader, &reader->steps);
        } else {
            reader->next++;
        }
        if (!sound)
            return SNOW_ERROR_PACKARD_RLE;
    }
    return SNOW_OK;
}

static snow_status read_comments(rle_reader *reader)
{
    snow_status status = SNOW_OK;
    while (status == SNOW_OK && reader->next < reader->end) {
        char c = *reader->next;
        if (c == '#') {
            const char *end = end_of_line(reader);
            if (read_word(reader, "#CXRLE"))
                status = read_place(reader, end);
            reader->next = end;
        } else if (c == '\n' || c == '\r' || c == ' ' || c == '\t') {
            reader->next++;
        } else {
            return SNOW_OK;
        }
    }
    return status;
}

/* "x = 3" */
static bool read_extent(rle_reader *reader, const char *name, int64_t *extent)
{
    skip_blanks(reader);
    if (!read_word(reader, name))
        return false;
    skip_blanks(reader);
    if (!read_word(reader, "="))
        return false;
    skip_blanks(reader);
    bool sound = read_magnitude(reader, extent);
    skip_blanks(reader);
    return sound;
}

static snow_status read_rule(rle_reader *reader)
{
    char rule[RULE_LENGTH];
    if (!read_word(reader, ","))
        return SNOW_ERROR_PACKARD_RLE;
    skip_blanks(reader);
    if (!read_word(reader, "rule"))
        return SNOW_ERROR_PACKARD_RLE;
    skip_blanks(reader);
    if (!read_word(reader, "="))
        return SNOW_ERROR_PACKARD_RLE;
    const char *end = end_of_line(reader);
    size_t length = (size_t)(end - reader->next);
    if (length >= RULE_LENGTH)
        return SNOW_ERROR_PACKARD_RULE;
    memcpy(rule, reader->next, length);
    rule[length] = '\0';
    reader->next = end;
    return snow_packard_rule_read(rule, &reader->params);
}

/* "x = 3, y = 4, rule = B1/S0123456H" */
static snow_status read_header(rle_reader *reader)
{
    int64_t width, height;
    if (!read_extent(reader, "x", &width) || !read_word(reader, ",") || !read_extent(reader, "y", &height))
        return reader->next < reader->end ? SNOW_ERROR_PACKARD_RLE : SNOW_ERROR_TRUNCATED;
    if (!reader->placed) {
        reader->x = -(width / 2);
        reader->y = -(height / 2);
    }
    if (reader->next == end_of_line(reader))
        return SNOW_OK;
    return read_rule(reader);
}

/* Freezes a run of cells of a row of the pattern. */
static snow_status put_run(snow_grid *grid, const packard_axes *axes, int64_t x, int64_t y, int64_t count)
{
    uint64_t words[CHUNK];
    int64_t q = packard_q_of(axes, x, y);
    int64_t r = packard_y_of(axes, y);
    if (!packard_rle_reaches(x) || !packard_rle_reaches(y) || !packard_rle_reaches(x + count))
        return SNOW_ERROR_TOO_LARGE;
    if (!packard_has_cell(grid, q, r) || !packard_has_cell(grid, q + count - 1, r))
        return SNOW_ERROR_PACKARD_SEED;
    memset(words, 0xFF, sizeof words);
    snow_status status = SNOW_OK;
    for (int64_t done = 0; done < count && status == SNOW_OK; done += CHUNK * PACKARD_WORD) {
        int64_t part = count - done < CHUNK * PACKARD_WORD ? count - done : CHUNK * PACKARD_WORD;
        if (part % PACKARD_WORD != 0)
            words[part / PACKARD_WORD] = (UINT64_C(1) << (part % PACKARD_WORD)) - 1;
        status = snow_packard_put(grid, &(packard_region){q + done, r, part, 1}, words);
    }
    return status;
}

static snow_status read_cells(rle_reader *reader, snow_grid *grid)
{
    const packard_axes axes = packard_axes_of(&reader->params);
    int64_t x = reader->x;
    int64_t y = reader->y;
    uint64_t cells = 0;
    snow_status status = SNOW_OK;
    while (status == SNOW_OK) {
        int64_t count = 1;
        if (is_digit(reader) && read_magnitude(reader, &count) && (count < 1 || count > 2 * PACKARD_RLE_REACH))
            return count < 1 ? SNOW_ERROR_PACKARD_RLE : SNOW_ERROR_TOO_LARGE;
        if (reader->next == reader->end)
            return SNOW_ERROR_TRUNCATED;
        if (!packard_rle_reaches(x) || !packard_rle_reaches(y))
            return SNOW_ERROR_TOO_LARGE;
        char c = *reader->next++;
        switch (c) {
        case '!': return SNOW_OK;
        case 'b':
        case '.': x += count; break;
        case '$':
            x = reader->x;
            y += count;
            break;
        case 'o':
        case 'A':
            cells += (uint64_t)count;
            status = cells <= PACKARD_RLE_CELLS ? put_run(grid, &axes, x, y, count) : SNOW_ERROR_TOO_LARGE;
            x += count;
            break;
        case ' ':
        case '\t':
        case '\r':
        case '\n': break;
        default:
            return (c >= 'B' && c <= 'X') || (c >= 'p' && c <= 'y') ? SNOW_ERROR_PACKARD_RLE_STATES
                                                                    : SNOW_ERROR_PACKARD_RLE;
        }
    }
    return status;
}

static snow_status load(rle_reader *reader, const snow_options *options, snow_grid **result)
{
    snow_status status = read_comments(reader);
    if (status == SNOW_OK)
        status = read_header(reader);
    if (status == SNOW_OK && (!packard_rle_reaches(reader->x) || !packard_rle_reaches(reader->y) || reader->steps > INT64_C(1) << 62))
        status = SNOW_ERROR_TOO_LARGE;
    snow_grid *grid = NULL;
    if (status == SNOW_OK)
        status = snow_packard_build(&reader->params, options, reader->steps, &grid);
    if (status == SNOW_OK)
        status = read_cells(reader, grid);
    if (status == SNOW_OK)
        status = snow_packard_settle(grid);
    return snow_grid_hand_over(grid, status, result);
}

/* The scene without what the pattern stands for. */
static snow_status read_params(const snow_packard_params *caller, snow_packard_params *params)
{
    snow_packard_params_init(params, sizeof *params);
    if (caller == NULL)
        return SNOW_OK;
    snow_status status = snow_struct_take(params, sizeof *params, caller);
    if (status != SNOW_OK)
        return status;
    params->seeds = NULL;
    params->seed_count = 0;
    params->cluster = params->scatter = 0;
    return SNOW_OK;
}

snow_status snow_packard_load_rle(const void *text, size_t size, const snow_packard_params *params,
                                  const snow_options *options, snow_grid **grid)
{
    if (text == NULL || grid == NULL)
        return SNOW_ERROR_NULL;
    rle_reader reader = {.next = text, .end = (const char *)text + size};
    snow_status status = read_params(params, &reader.params);
    if (status != SNOW_OK)
        return status;
    snow_floating floating;
    snow_floating_enter(&floating);
    status = load(&reader, options, grid);
    snow_floating_leave(&floating);
    return status;
}

snow_status snow_packard_load_rle_from(snow_reader read, void *context, const snow_packard_params *params,
                                       const snow_options *options, snow_grid **grid)
{
    if (read == NULL || grid == NULL)
        return SNOW_ERROR_NULL;
    snow_text text;
    snow_status status = snow_text_read(&text, read, context, options);
    if (status != SNOW_OK)
        return status;
    status = snow_packard_load_rle(text.bytes, text.size, params, options, grid);
    snow_text_end(&text);
    return status;
}
