/* Lists of sites in text files, as `aggregate --sites` writes them. */
#ifndef EXAMPLES_PLACES_H
#define EXAMPLES_PLACES_H

#include <snowgrowth/snowgrowth.h>

#include <stdbool.h>

typedef struct place_list {
    snow_site *sites;
    size_t count;
} place_list;

/* Reads a site a line, two or three whole numbers. The option names the file; without a name
   there is no list, and sites is NULL. Complains and returns false when that fails. */
bool places_read(place_list *self, const char *option, const char *name);
void places_destroy(place_list *self);

#endif
