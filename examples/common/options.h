/*
 * A program's options as a table of rows. getopt_long() splits the command
 * line; the rows say where each argument goes and what it may be, and --help
 * is printed from them.
 */
#ifndef EXAMPLES_OPTIONS_H
#define EXAMPLES_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum option_kind {
    KIND_END = 0,
    KIND_GROUP,    /* a heading; the rows up to the next one belong to it */
    KIND_FLAG,     /* int32_t, set to 1 */
    KIND_NUMBER,   /* double, finite */
    KIND_INTEGER,  /* int32_t */
    KIND_LONG,     /* int64_t */
    KIND_UNSIGNED, /* uint64_t */
    KIND_TEXT,     /* const char * */
    KIND_CHOICE,   /* an enumeration */
    KIND_LIST,     /* number_list: numbers, or ranges first:last:count, evenly spaced, count followed by 'log': in their logarithms */
    KIND_ACTION    /* handed to a function, before all other options */
} option_kind;

/* The names that a choice has; the last one is NULL. */
typedef struct option_choice {
    const char *name;
    int value;
} option_choice;

enum { LONGEST_LIST = 256 };

typedef struct number_list {
    size_t count;
    double numbers[LONGEST_LIST];
} number_list;

/* Complains and returns false when it does not like the text. */
typedef bool (*option_action)(void *target, const char *text);

typedef struct option_row {
    option_kind kind;
    const char *name;
    const char *argument; /* what --help calls it */
    const char *help;
    void *target;
    int64_t least;    /* of a KIND_INTEGER or KIND_LONG */
    int64_t greatest;
    const option_choice *choices;
    option_action action;
    bool given; /* set when the option was there */
} option_row;

#define OPTION_GROUP(heading) {.kind = KIND_GROUP, .name = (heading)}
#define OPTION_FLAG(text, where, what) {.kind = KIND_FLAG, .name = (text), .target = (where), .help = (what)}
#define OPTION_NUMBER(text, where, what) \
    {.kind = KIND_NUMBER, .name = (text), .argument = "NUMBER", .target = (where), .help = (what)}
#define OPTION_INTEGER(text, call, where, low, high, what) \
    {.kind = KIND_INTEGER, .name = (text), .argument = (call), .target = (where), .least = (low), .greatest = (high), \
     .help = (what)}
#define OPTION_LONG(text, call, where, low, high, what) \
    {.kind = KIND_LONG, .name = (text), .argument = (call), .target = (where), .least = (low), .greatest = (high), \
     .help = (what)}
#define OPTION_UNSIGNED(text, where, what) \
    {.kind = KIND_UNSIGNED, .name = (text), .argument = "INTEGER", .target = (where), .help = (what)}
#define OPTION_TEXT(text, call, where, what) \
    {.kind = KIND_TEXT, .name = (text), .argument = (call), .target = (where), .help = (what)}
#define OPTION_CHOICE(text, names, where, what) \
    {.kind = KIND_CHOICE, .name = (text), .choices = (names), .target = (where), .help = (what)}
#define OPTION_LIST(text, where, what) \
    {.kind = KIND_LIST, .name = (text), .argument = "A,B,...", .target = (where), .help = (what)}
#define OPTION_ACTION(text, call, function, where, what) \
    {.kind = KIND_ACTION, .name = (text), .argument = (call), .action = (function), .target = (where), .help = (what)}
#define OPTION_END {.kind = KIND_END}

typedef struct program {
    const char *name;
    const char *summary; /* what --help says first */
    const char *example; /* and last */
    option_row *rows;
} program;

/*
 * Reads the command line. False when the program is to end now with *exit_code:
 * after --help, or after one line of complaint.
 */
bool options_read(const program *self, int argc, char **argv, int *exit_code);

bool option_given(const program *self, const char *name);

/* The name of an option of the group that was given; NULL when none was. */
const char *option_given_of(const program *self, const char *heading);

#endif
