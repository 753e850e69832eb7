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

/* What a walker asked and was told: if the same questions still have the same
   answers, it would walk the same way. */
typedef struct snow_question {
    snow_site site;
    uint32_t answer;
} snow_question;

typedef struct snow_diary {
    snow_question *question; /* NULL: none is kept */
    size_t count;
    size_t room; /* questions beyond are counted only */
} snow_diary;

/* Where the walker with these numbers ends: the site to be filled. */
snow_site snow_flight(const snow_ground *ground, snow_draws *draws, snow_diary *diary);

/* Whether all answers of a diary that is complete still hold. */
bool snow_flight_holds(const snow_ground *ground, const snow_diary *diary);

#endif
