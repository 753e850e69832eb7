#include "check.h"

#include <math.h>
#include <string.h>

void check_status(snow_status expected, snow_status got, const char *text, const char *file, int line)
{
    if (expected == got)
        return;
    print_error("%s\n  answered %d (%s)\n  instead of %d (%s)\n", text, (int)got, snow_strerror(got), (int)expected,
                snow_strerror(expected));
    _fail(file, line);
}

static void fail_double(double expected, double got, const char *text, const char *file, int line)
{
    print_error("%s\n  is %a (%.17g)\n  instead of %a (%.17g)\n", text, got, got, expected, expected);
    _fail(file, line);
}

void check_same_double(double expected, double got, const char *text, const char *file, int line)
{
    if (memcmp(&expected, &got, sizeof expected) != 0)
        fail_double(expected, got, text, file, line);
}

void check_near(double expected, double got, double tolerance, const char *text, const char *file, int line)
{
    if (!(fabs(expected - got) <= tolerance))
        fail_double(expected, got, text, file, line);
}
