#include "arguments.h"

#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void arguments_fail(const char *format, ...)
{
    va_list values;
    va_start(values, format);
    fprintf(stderr, "%s: ", program_name);
    vfprintf(stderr, format, values);
    fprintf(stderr, "\n");
    va_end(values);
    exit(2);
}

int64_t arguments_integer(const char *option, const char *text, int64_t least, int64_t greatest)
{
    char *end = NULL;
    errno = 0;
    long long value = strtoll(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0 || value < least || value > greatest)
        arguments_fail("%s wants a whole number from %" PRId64 " to %" PRId64 ", not '%s'", option, least, greatest,
                       text);
    return value;
}

double arguments_number(const char *option, const char *text, double least, double greatest)
{
    char *end = NULL;
    double value = strtod(text, &end);
    if (end == text || *end != '\0' || !(value >= least && value <= greatest))
        arguments_fail("%s wants a number from %g to %g, not '%s'", option, least, greatest, text);
    return value;
}

bool arguments_next_word(const char **list, char *word, size_t size)
{
    if (**list == '\0')
        return false;
    size_t length = strcspn(*list, ",");
    snprintf(word, size, "%.*s", (int)length, *list);
    *list += length + ((*list)[length] == ',');
    return true;
}

snow_scene arguments_scene(const char *name)
{
    snow_scene scene;
    if (!scene_find(name, &scene))
        arguments_fail("there is no scene '%s'; --list shows them all", name);
    return scene;
}

void arguments_list_scenes(void)
{
    snow_scene scene;
    for (size_t i = 0; scene_get(i, &scene); i++)
        printf("%-20s %s%s\n", scene.name, scene.what, scene.slow ? " (slow: only when named)" : "");
}
