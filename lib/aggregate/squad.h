/* Eight walkers abreast, a question each at a time, and what they were told.

   They do not know of each other; side by side, what one waits for does not hold
   up the others. What all eight asked at a time is a row; rows follow each other
   round a ring, so that a walker's diary is a column of some of them. */
#ifndef SNOW_AGGREGATE_SQUAD_H
#define SNOW_AGGREGATE_SQUAD_H

#include "aggregate/flight.h"

enum { SNOW_LANES = 8, SNOW_SQUADS = 4 /* that walk together, at most */ };

/* What they asked, what they were told, and how many numbers they had used: while
   the same questions have the same answers, walkers walk the same way. */
typedef struct snow_row {
    _Alignas(64) int32_t x[SNOW_LANES]; /* x and y are in one cache line */
    int32_t y[SNOW_LANES];
    uint32_t answer[SNOW_LANES];
    uint32_t drawn[SNOW_LANES];
} snow_row;

/* Where they were told so: what may have changed is found by tiles, so these are close together. */
typedef struct snow_tiles {
    _Alignas(32) int32_t tile[SNOW_LANES]; /* negative: outside the map, where nothing changes */
} snow_tiles;

/* The third coordinate. */
typedef struct snow_heights {
    _Alignas(32) int32_t z[SNOW_LANES];
} snow_heights;

/* Where walkers are that walk in the lanes of vectors, and their numbers, in halves. */
typedef struct snow_lanes {
    _Alignas(32) int32_t x[SNOW_LANES];
    int32_t y[SNOW_LANES];
    int32_t z[SNOW_LANES];
    uint32_t drawn[SNOW_LANES];
    uint32_t low[SNOW_LANES];
    uint32_t high[SNOW_LANES];
} snow_lanes;

struct snow_squad {
    snow_lanes lanes;
    snow_flight flight[SNOW_LANES]; /* those who walk in turn; the others where they set out */
    uint32_t busy;                  /* lanes in which somebody walks, as bits */
    uint32_t landed;                /* lanes in which somebody has landed */
    uint64_t key;                   /* of all their streams */
    snow_row *rows;
    snow_tiles *tiles;     /* as many */
    snow_heights *heights; /* as many; NULL in the plane */
    uint32_t room; /* so many rows: a power of two */
    uint32_t next; /* the row that is written next */
    uint32_t stop; /* here the ring is full */
};

static inline snow_row *snow_squad_row(const snow_squad *squad, uint32_t row)
{
    return &squad->rows[row & (squad->room - 1)];
}

static inline snow_tiles *snow_squad_tiles(const snow_squad *squad, uint32_t row)
{
    return &squad->tiles[row & (squad->room - 1)];
}

static inline snow_heights *snow_squad_heights(const snow_squad *squad, uint32_t row)
{
    return &squad->heights[row & (squad->room - 1)];
}

/* How they walk on this ground, until somebody has landed, or a ring is full; and how diaries are looked through. */
void snow_squads_choose(snow_ground *ground, snow_isa isa);
void snow_squads_walk_in_turn(const snow_ground *ground, snow_squad *squads, int count);
void snow_squads_walk_avx2(const snow_ground *ground, snow_squad *squads, int count);
void snow_squads_walk_avx512(const snow_ground *ground, snow_squad *squads, int count);
void snow_squads_walk_space_avx2(const snow_ground *ground, snow_squad *squads, int count);
void snow_squads_walk_space_avx512(const snow_ground *ground, snow_squad *squads, int count);

/* The walker of flight[lane] sets out. */
void snow_squad_enter(snow_squad *squad, int lane);

/* The walker of a lane leaves it: where it is. */
snow_stay snow_squad_leave(const snow_ground *ground, snow_squad *squad, int lane);

/* Where the walker of a column was when it asked. */
snow_stay snow_squad_asked(const snow_squad *squad, int lane, uint32_t row);

/* The first of a column's rows that would be answered otherwise now, if what was
   told by then changed last by landing number `since`; `end` if there is none. */
uint32_t snow_squad_outdated(const snow_ground *ground, const snow_squad *squad, int lane, uint32_t first, uint32_t end,
                             uint64_t since);
uint32_t snow_squad_outdated_avx2(const snow_ground *ground, const snow_squad *squad, int lane, uint32_t first,
                                  uint32_t end, uint64_t since);
uint32_t snow_squad_outdated_avx512(const snow_ground *ground, const snow_squad *squad, int lane, uint32_t first,
                                    uint32_t end, uint64_t since);
uint32_t snow_squad_outdated_space_avx2(const snow_ground *ground, const snow_squad *squad, int lane, uint32_t first,
                                        uint32_t end, uint64_t since);
uint32_t snow_squad_outdated_space_avx512(const snow_ground *ground, const snow_squad *squad, int lane, uint32_t first,
                                          uint32_t end, uint64_t since);

#endif
