#include "common/message.h"

#include "common/progress.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const char *program = "example";

void message_program(const char *name)
{
    program = name;
}

const char *message_program_name(void)
{
    return program;
}

void complain(const char *format, ...)
{
    va_list arguments;
    progress_clear();
    fprintf(stderr, "%s: ", program);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

/* Whether other arguments or other data could have made the call succeed. */
static bool callers_fault(snow_status status)
{
    return (status >= SNOW_ERROR_NULL && status < SNOW_ERROR_NO_MEMORY) || status == SNOW_ERROR_TOO_LARGE ||
           status == SNOW_ERROR_ISA || (status >= SNOW_ERROR_FORMAT && status <= SNOW_ERROR_DAMAGED) ||
           status >= SNOW_ERROR_REITER_BACKGROUND;
}

int complain_status(const char *subject, snow_status status)
{
    if (subject)
        complain("%s: %s", subject, snow_strerror(status));
    else
        complain("%s", snow_strerror(status));
    return callers_fault(status) ? EXIT_WRONG : EXIT_FAILED;
}

int print_line(const char *format, ...)
{
    va_list arguments;
    progress_clear();
    va_start(arguments, format);
    int printed = vprintf(format, arguments);
    va_end(arguments);
    if (printed < 0 || fflush(stdout) != 0) {
        complain("standard output: %s", strerror(errno));
        return EXIT_FAILED;
    }
    return EXIT_DONE;
}
