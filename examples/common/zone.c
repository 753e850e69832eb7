#include "common/zone.h"

#include "common/message.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

bool zone_of_name(const char *name, size_t length, snow_packard_zone *zone)
{
    static const struct {
        const char *name;
        snow_packard_zone_kind kind;
        snow_packard_zone_shape shape;
        double half_width;
        int32_t inverted;
    } names[] = {
        {"clefts", SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_SIDES, 1, 0},
        {"corners", SNOW_PACKARD_PRIORITY, SNOW_PACKARD_CORNERS, 0, 0},
        {"tips", SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_CORNERS, 0, 1},
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (strlen(names[i].name) != length || strncmp(names[i].name, name, length) != 0)
            continue;
        snow_packard_zone_init(zone, sizeof *zone, names[i].kind, names[i].shape);
        zone->half_width = names[i].half_width;
        zone->inverted = names[i].inverted;
        return true;
    }
    return false;
}

/* "4", "4-5" or "4-", up to the text's end or a colon. */
static bool read_steps(const char **text, snow_packard_zone *zone)
{
    char *end;
    errno = 0;
    if (**text < '0' || **text > '9')
        return false;
    zone->first_step = zone->last_step = strtoimax(*text, &end, 10);
    if (*end == '-') {
        const char *last = end + 1;
        zone->last_step = SNOW_PACKARD_FOREVER;
        if (*last >= '0' && *last <= '9')
            zone->last_step = strtoimax(last, &end, 10);
        else
            end++;
    }
    *text = end;
    return errno == 0;
}

/* "2.5" cells or "12d" degrees. */
static bool read_width(const char *text, snow_packard_zone *zone)
{
    char *end;
    double width = strtod(text, &end);
    if (end == text)
        return false;
    if (*end == 'd') {
        zone->half_angle = width;
        end++;
    } else {
        zone->half_width = width;
    }
    return *end == '\0';
}

static bool read_zone(const char *text, snow_packard_zone *zone)
{
    size_t length = strcspn(text, ":");
    const char *rest = text + length;
    if (!zone_of_name(text, length, zone) || *rest++ != ':' || !read_steps(&rest, zone))
        return false;
    return *rest == '\0' || (*rest == ':' && read_width(rest + 1, zone));
}

bool zone_take(void *list, const char *text)
{
    zone_list *zones = list;
    if (zones->count == MOST_ZONES) {
        complain("--zone: there can be %d of them", MOST_ZONES);
        return false;
    }
    if (read_zone(text, &zones->zones[zones->count])) {
        zones->count++;
        return true;
    }
    complain("--zone: '%s' is not like clefts:1-16 or corners:4-5", text);
    return false;
}

snow_status zones_add(const zone_list *list, snow_grid *grid)
{
    snow_status status = SNOW_OK;
    for (size_t i = 0; i < list->count && status == SNOW_OK; i++)
        status = snow_packard_add_zone(grid, &list->zones[i]);
    return status;
}
