/* The walk of one walker by jumps, from its source to the site where it ends. */
#ifndef SNOW_AGGREGATE_FLIGHT_H
#define SNOW_AGGREGATE_FLIGHT_H

#include "aggregate/draws.h"
#include "aggregate/exits.h"
#include "aggregate/plane_map.h"
#include "aggregate/source.h"
#include "aggregate/space_map.h"

typedef struct snow_ground snow_ground;
typedef struct snow_squad snow_squad;

/* See squad.h. */
typedef void (*snow_squads_walk)(const snow_ground *ground, snow_squad *squads, int count);
typedef uint32_t (*snow_squads_outdated)(const snow_ground *ground, const snow_squad *squad, int lane, uint32_t first,
                                         uint32_t end, uint64_t since);

/* What walkers meet. They only read it. */
struct snow_ground {
    snow_aggregate_contact contact;
    double stick;
    bool careful; /* walkers may go on from special sites: stick < 1, entry, or obstacles */
    snow_draws_refill refill;
    snow_squads_walk walk;
    snow_squads_outdated outdated;
    snow_source_of_walkers source;
    snow_exits exits;
    snow_plane_map plane; /* the one or the other */
    snow_space_map space;
};

/* All there is to know of a walker, its number apart. */
typedef struct snow_stay {
    snow_site site;
    uint32_t drawn; /* so many numbers */
    bool landed;    /* the site is to be filled */
} snow_stay;

/* A walker on its way. Its coordinates stand apart: compilers would pair them, and take a detour. */
typedef struct snow_flight {
    int32_t x;
    uint32_t asked; /* questions that are in no diary */
    int32_t y;
    bool landed;
    int32_t z;
    snow_draws draws;
} snow_flight;

/* The walker with these numbers sets out, from infinity. */
void snow_flight_start(const snow_ground *ground, snow_flight *flight, uint64_t key, uint64_t walker);

/* It has been walking before. */
void snow_flight_resume(const snow_ground *ground, snow_flight *flight, uint64_t key, uint64_t walker, snow_stay stay);

/* It walks alone, until it has landed. */
snow_site snow_flight_finish(const snow_ground *ground, snow_flight *flight);

#endif
