/* The zones that the paper of Liu and Zhang grows its snowflakes with, by name. */
#ifndef EXAMPLES_ZONE_H
#define EXAMPLES_ZONE_H

#include <snowgrowth/snowgrowth.h>

#include <stdbool.h>

enum { MOST_ZONES = 16 };

typedef struct zone_list {
    size_t count;
    snow_packard_zone zones[MOST_ZONES];
} zone_list;

/*
 * An option_action on a zone_list: "clefts:1-16" restricts the middles of the
 * six sides, "corners:4-5" gives priority to the six corners, "tips:4-5" lets
 * nothing but the corners grow; "tips:4" is one step, "clefts:5-" has no end. A
 * third part is the half-width in cells or degrees: "clefts:1-16:2.5",
 * "clefts:1-16:12d".
 */
bool zone_take(void *list, const char *text);

/* The zone of this name in these steps; false when there is none. */
bool zone_of_name(const char *name, size_t length, snow_packard_zone *zone);

/* Adds all zones of a list to a grid. */
snow_status zones_add(const zone_list *list, snow_grid *grid);

#endif
