/* One-line complaints on standard error, and the exit codes that go with them. */
#ifndef EXAMPLES_MESSAGE_H
#define EXAMPLES_MESSAGE_H

#include <snowgrowth/status.h>

#include <stdbool.h>

enum {
    EXIT_DONE = 0,
    EXIT_FAILED = 1, /* the world refused: memory, disk, … */
    EXIT_WRONG = 2   /* the command was wrong */
};

#if defined(__GNUC__)
#define PRINTF_LIKE(text, first) __attribute__((format(printf, text, first)))
#else
#define PRINTF_LIKE(text, first)
#endif

/* The name that complaints begin with. */
void message_program(const char *name);
const char *message_program_name(void);

void complain(const char *format, ...) PRINTF_LIKE(1, 2);

/* Complains about a status, after "subject: " unless it is NULL; returns the exit code. */
int complain_status(const char *subject, snow_status status);

/* Prints to standard output and makes sure that it arrived; returns the exit code. */
int print_line(const char *format, ...) PRINTF_LIKE(1, 2);

#endif
