/* The walk of one walker by jumps, from its source to the site where it ends. */
#ifndef SNOW_AGGREGATE_FLIGHT_H
#define SNOW_AGGREGATE_FLIGHT_H

#include "aggregate/draws.h"
#include "aggregate/exits.h"
#include "aggregate/plane_map.h"
#include "aggregate/source.h"
#include "aggregate/space_map.h"

/* What walkers meet. They only read it. */
typedef struct snow_ground {
    snow_aggregate_contact contact;
    double stick;
    bool careful; /* walkers may go on from special sites: stick < 1, entry, or obstacles */
    snow_draws_refill refill;
    snow_source_of_walkers source;
    snow_exits exits;
    snow_plane_map plane; /* the one or the other */
    snow_space_map space;
} snow_ground;

/* What a walker asked, what it was told, and how many numbers it had used: while
   the same questions have the same answers, it walks the same way. */
typedef struct snow_question {
    snow_site site;
    uint32_t answer;
    uint32_t drawn;
} snow_question;

/* A walker on its way. Its coordinates stand apart: compilers would pair them, and take a detour. */
typedef struct snow_flight {
    int32_t x;
    uint32_t asked;
    int32_t y;
    uint32_t room; /* in the diary */
    int32_t z;
    bool landed; /* the site is to be filled */
    snow_question *diary;
    snow_draws draws;
} snow_flight;

/* Launches the walker with these numbers. The diary is kept as it is. */
void snow_flight_start(const snow_ground *ground, snow_flight *flight, uint64_t key, uint64_t walker);

/* Several walkers in turn, a question each, until one has landed or its diary is
   full: which one. They do not know of each other; in turn, what one waits for
   does not hold up the others. */
int snow_flight_share(const snow_ground *ground, snow_flight *const *flights, int count);

/* One alone, until it has landed; nothing more is written into its diary. */
void snow_flight_finish(const snow_ground *ground, snow_flight *flight);

/* The first question of a diary that would be answered otherwise now, if what was
   told by then changed last by landing number `since`; `asked` if there is none. */
uint32_t snow_flight_outdated(const snow_ground *ground, const snow_flight *flight, uint64_t since);

/* Back to where it was when it asked. */
void snow_flight_rewind(snow_flight *flight, uint32_t question);

#endif
