#include "common/options.h"

#include "common/message.h"

#include <errno.h>
#include <getopt.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_OPTIONS = 64, HELP_COLUMN = 34, FIRST_VALUE = 256 };

static bool is_option(const option_row *row)
{
    return row->kind != KIND_GROUP;
}

static bool complain_about(const option_row *row, const char *text, const char *wanted)
{
    complain("--%s: '%s' is not %s", row->name, text, wanted);
    return false;
}

/* Whole texts only: strtod() and its kin pass over leading space and stop at trailing rubbish. */
static bool starts_well(const char *text)
{
    return *text != '\0' && strchr(" \t\n\v\f\r", *text) == NULL;
}

static bool read_number(const char *text, char **end, double *number)
{
    errno = 0;
    *number = strtod(text, end);
    return starts_well(text) && *end != text && errno == 0 && isfinite(*number);
}

static bool take_number(const option_row *row, const char *text)
{
    char *end;
    double number;
    if (!read_number(text, &end, &number) || *end != '\0')
        return complain_about(row, text, "a number");
    *(double *)row->target = number;
    return true;
}

/* What follows the first number of a range: ":last:count" or ":last:countlog". Appends all but the first. */
static bool read_range(const char *text, char **end, number_list *list)
{
    double first = list->numbers[list->count - 1];
    double last;
    double count;
    if (!read_number(text + 1, end, &last) || **end != ':' || !read_number(*end + 1, end, &count))
        return false;
    bool logarithmic = strncmp(*end, "log", 3) == 0;
    *end += logarithmic ? 3 : 0;
    if (count != floor(count) || count < 2 || count - 1 > (double)(LONGEST_LIST - list->count) ||
        (logarithmic && !(first > 0 && last > 0)))
        return false;
    for (double i = 1; i < count; i++) {
        double share = i / (count - 1);
        list->numbers[list->count++] =
            logarithmic ? first * pow(last / first, share) : first + (last - first) * share;
    }
    return true;
}

static bool take_list(const option_row *row, const char *text)
{
    number_list list = {0};
    const char *rest = text;
    for (;;) {
        char *end;
        if (list.count == LONGEST_LIST || !read_number(rest, &end, &list.numbers[list.count++]))
            break;
        if (*end == ':' && !read_range(end, &end, &list))
            break;
        if (*end == '\0') {
            *(number_list *)row->target = list;
            return true;
        }
        if (*end != ',')
            break;
        rest = end + 1;
    }
    return complain_about(row, text, "a list of at most 256 numbers, or of ranges first:last:count, with commas between them");
}

static bool take_integer(const option_row *row, const char *text)
{
    char *end;
    errno = 0;
    intmax_t number = strtoimax(text, &end, 10);
    if (!starts_well(text) || *end != '\0')
        return complain_about(row, text, "a whole number");
    if (errno != 0 || number < row->least || number > row->greatest) {
        complain("--%s: %s is not between %" PRId64 " and %" PRId64, row->name, text, row->least, row->greatest);
        return false;
    }
    if (row->kind == KIND_INTEGER)
        *(int32_t *)row->target = (int32_t)number;
    else
        *(int64_t *)row->target = number;
    return true;
}

static bool take_unsigned(const option_row *row, const char *text)
{
    char *end;
    errno = 0;
    uintmax_t number = strtoumax(text, &end, 10);
    if (!starts_well(text) || strchr(text, '-') || *end != '\0' || errno != 0 || number > UINT64_MAX)
        return complain_about(row, text, "a whole number from 0 to 2^64 - 1");
    *(uint64_t *)row->target = number;
    return true;
}

/* "disc|hexagon|rectangle" */
static const char *names_of(const option_choice *choices, char *text, size_t size)
{
    size_t length = 0;
    for (; choices->name && length < size; choices++)
        length += (size_t)snprintf(text + length, size - length, "%s%s", length ? "|" : "", choices->name);
    return text;
}

static bool take_choice(const option_row *row, const char *text)
{
    char wanted[128] = "one of ";
    for (const option_choice *choice = row->choices; choice->name; choice++) {
        if (strcmp(choice->name, text) == 0) {
            memcpy(row->target, &choice->value, sizeof choice->value); /* an enumeration has the size of int */
            return true;
        }
    }
    names_of(row->choices, wanted + strlen(wanted), sizeof wanted - strlen(wanted));
    return complain_about(row, text, wanted);
}

static bool take(option_row *row, const char *text)
{
    row->given = true;
    switch (row->kind) {
    case KIND_FLAG: *(int32_t *)row->target = 1; return true;
    case KIND_NUMBER: return take_number(row, text);
    case KIND_INTEGER:
    case KIND_LONG: return take_integer(row, text);
    case KIND_UNSIGNED: return take_unsigned(row, text);
    case KIND_TEXT: *(const char **)row->target = text; return true;
    case KIND_CHOICE: return take_choice(row, text);
    case KIND_LIST: return take_list(row, text);
    case KIND_ACTION: return row->action(row->target, text);
    default: return true;
    }
}

static void print_row(const char *name, const char *argument, const char *help)
{
    char start[160];
    snprintf(start, sizeof start, "  --%s%s%s", name, argument ? " " : "", argument ? argument : "");
    if (strlen(start) < HELP_COLUMN)
        printf("%-*s%s\n", HELP_COLUMN, start, help);
    else
        printf("%s\n%*s%s\n", start, HELP_COLUMN, "", help);
}

static int print_help(const program *self)
{
    char names[128];
    printf("usage: %s [OPTION]...\n\n%s\n", self->name, self->summary);
    for (const option_row *row = self->rows; row->kind != KIND_END; row++) {
        if (row->kind == KIND_GROUP)
            printf("\n%s:\n", row->name);
        else
            print_row(row->name, row->choices ? names_of(row->choices, names, sizeof names) : row->argument, row->help);
    }
    print_row("help", NULL, "print this and end");
    return print_line("\nExample:\n  %s\n", self->example);
}

/* A row's number travels as the value that getopt_long() returns for it. */
static void fill_long_options(const program *self, struct option *options)
{
    size_t count = 0;
    for (int i = 0; self->rows[i].kind != KIND_END && count < MOST_OPTIONS; i++) {
        const option_row *row = &self->rows[i];
        int argument = row->kind == KIND_FLAG ? no_argument : required_argument;
        if (is_option(row))
            options[count++] = (struct option){row->name, argument, NULL, FIRST_VALUE + i};
    }
    options[count++] = (struct option){"help", no_argument, NULL, 'h'};
    options[count] = (struct option){NULL, 0, NULL, 0};
}

static bool complain_about_command(int answer, char **argv)
{
    if (answer == ':')
        complain("%s needs an argument; see --help", argv[optind - 1]);
    else if (optopt > 0 && optopt < FIRST_VALUE)
        complain("-%c is no option of this program; see --help", optopt);
    else
        complain("%s is no option of this program; see --help", argv[optind - 1]);
    return false;
}

/* Goes through the command line once and takes either the actions or the other options. */
static bool read_pass(const program *self, int argc, char **argv, bool actions, bool *help)
{
    struct option options[MOST_OPTIONS + 2];
    fill_long_options(self, options);
    optind = 1;
    opterr = 0;
    int answer;
    while ((answer = getopt_long(argc, argv, ":h", options, NULL)) != -1) {
        if (answer == 'h') {
            *help = true;
            return true;
        }
        if (answer == '?' || answer == ':')
            return complain_about_command(answer, argv);
        option_row *row = &self->rows[answer - FIRST_VALUE];
        if ((row->kind == KIND_ACTION) == actions && !take(row, optarg))
            return false;
    }
    if (optind < argc) {
        complain("unexpected argument '%s'; see --help", argv[optind]);
        return false;
    }
    return true;
}

bool options_read(const program *self, int argc, char **argv, int *exit_code)
{
    bool help = false;
    message_program(self->name);
    bool fine = read_pass(self, argc, argv, true, &help) && (help || read_pass(self, argc, argv, false, &help));
    if (help)
        *exit_code = print_help(self);
    else
        *exit_code = EXIT_WRONG;
    return fine && !help;
}

bool option_given(const program *self, const char *name)
{
    for (const option_row *row = self->rows; row->kind != KIND_END; row++)
        if (is_option(row) && strcmp(row->name, name) == 0)
            return row->given;
    return false;
}

const char *option_given_of(const program *self, const char *heading)
{
    bool within = false;
    for (const option_row *row = self->rows; row->kind != KIND_END; row++) {
        if (row->kind == KIND_GROUP)
            within = strcmp(row->name, heading) == 0;
        else if (within && row->given)
            return row->name;
    }
    return NULL;
}
