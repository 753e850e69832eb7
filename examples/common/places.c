#include "common/places.h"

#include "common/crystal.h"
#include "common/message.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_ROOM = 64 };

static bool add(place_list *self, size_t *room, snow_site site)
{
    if (self->count == *room) {
        snow_site *larger = realloc(self->sites, 2 * *room * sizeof *larger);
        if (larger == NULL)
            return false;
        self->sites = larger;
        *room *= 2;
    }
    self->sites[self->count++] = site;
    return true;
}

/* One coordinate, in the range of the library's sites. */
static bool take_coordinate(char **text, int32_t *coordinate)
{
    char *end;
    errno = 0;
    intmax_t number = strtoimax(*text, &end, 10);
    if (end == *text || errno != 0 || number < INT32_MIN || number > INT32_MAX)
        return false;
    *coordinate = (int32_t)number;
    *text = end;
    return true;
}

static bool take_site(char *line, snow_site *site)
{
    *site = (snow_site){0, 0, 0};
    if (!take_coordinate(&line, &site->x) || !take_coordinate(&line, &site->y))
        return false;
    take_coordinate(&line, &site->z);
    return line[strspn(line, " \t\r\n")] == '\0';
}

static bool read_lines(place_list *self, FILE *file, const char *name)
{
    char line[128];
    size_t room = FIRST_ROOM;
    self->sites = malloc(room * sizeof *self->sites);
    bool kept = self->sites != NULL;
    for (size_t number = 1; kept && fgets(line, sizeof line, file) != NULL; number++) {
        snow_site site;
        if (!take_site(line, &site)) {
            complain("%s, line %zu: a site is two or three whole numbers", name, number);
            return false;
        }
        kept = add(self, &room, site);
    }
    if (!kept)
        complain("no memory for the sites of %s", name);
    else if (ferror(file))
        complain("%s: %s", name, strerror(errno));
    return kept && !ferror(file);
}

bool places_read(place_list *self, const char *option, const char *name)
{
    *self = (place_list){NULL, 0};
    if (name == NULL)
        return true;
    FILE *file = file_open(option, name);
    if (file == NULL)
        return false;
    bool read = read_lines(self, file, name);
    fclose(file);
    return read;
}

void places_destroy(place_list *self)
{
    free(self->sites);
    self->sites = NULL;
}
