/**
 * @file status.h
 * @brief What a call answers.
 *
 * Every call that can fail returns a ::snow_status. Zero is success. Results
 * travel through out-pointers, which a failing call leaves untouched. The
 * values are grouped in families and are never renumbered or reused.
 */
#ifndef SNOWGROWTH_STATUS_H
#define SNOWGROWTH_STATUS_H

#include <snowgrowth/export.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @brief The answer of a fallible call. */
typedef enum snow_status {
    /** The call did what it promises. */
    SNOW_OK = 0,

    /* 1xx: the call itself is wrong; nothing was changed. */

    /** A pointer that must not be NULL is NULL. */
    SNOW_ERROR_NULL = 100,
    /** A struct was not initialised: its struct_size is zero or too small. */
    SNOW_ERROR_STRUCT_SIZE = 101,
    /** A struct of a newer version sets a member that this library does not know. */
    SNOW_ERROR_STRUCT_TAIL = 102,
    /** An enumeration has a value that this library does not know. */
    SNOW_ERROR_ENUM = 103,
    /** The caller's buffer is too small; the needed size was written where the call says so. */
    SNOW_ERROR_BUFFER = 104,
    /** A rectangle has a negative extent or reaches beyond the range of coordinates. */
    SNOW_ERROR_RECTANGLE = 105,
    /** A number is NaN or infinite. */
    SNOW_ERROR_NOT_FINITE = 106,
    /** A count, limit or size is negative or out of its stated range. */
    SNOW_ERROR_RANGE = 107,
    /** The grid's model has no such field or operation. */
    SNOW_ERROR_UNSUPPORTED = 108,
    /** What was asked for is not recorded; ask for it when the grid is created. */
    SNOW_ERROR_NOT_RECORDED = 109,
    /** A progress callback tried to change the grid that calls it. */
    SNOW_ERROR_BUSY = 110,
    /** The cell lies outside the grid's domain. */
    SNOW_ERROR_OUTSIDE = 111,

    /* 2xx: resources. */

    /** The allocator returned NULL. */
    SNOW_ERROR_NO_MEMORY = 200,
    /** The grid is too large: for what it is made of, or for the type or the cost of the answer. */
    SNOW_ERROR_TOO_LARGE = 201,
    /** The caller's memory limit would be passed. */
    SNOW_ERROR_MEMORY_LIMIT = 202,
    /** A thread could not be started. */
    SNOW_ERROR_THREADS = 203,
    /** The forced instruction set is not available on this processor or in this build. */
    SNOW_ERROR_ISA = 204,

    /* 3xx: saved grids. */

    /** The data do not begin like a saved grid. */
    SNOW_ERROR_FORMAT = 300,
    /** The data were written by a later version of the format. */
    SNOW_ERROR_FORMAT_VERSION = 301,
    /** The data end too early. */
    SNOW_ERROR_TRUNCATED = 302,
    /** The checksum or the contents of the data are wrong. */
    SNOW_ERROR_DAMAGED = 303,
    /** The caller's writer failed. */
    SNOW_ERROR_WRITE = 304,
    /** The caller's reader failed. */
    SNOW_ERROR_READ = 305,

    /* 4xx: the course of a run. */

    /** The vapour field grows without bound; the grid stands at its last sound step. */
    SNOW_ERROR_UNSTABLE = 400,
    /** The step count has reached its greatest value. */
    SNOW_ERROR_STEP_LIMIT = 401,
    /** Nothing more can join: the domain is full, or one cluster is left. */
    SNOW_ERROR_FULL = 420,

    /* 1xxx: Reiter's model. */

    /** The background is not in 0 <= background < 1. */
    SNOW_ERROR_REITER_BACKGROUND = 1000,
    /** The addition is not in 0 <= addition <= 1. */
    SNOW_ERROR_REITER_ADDITION = 1001,
    /** The diffusion is not in 0 <= diffusion <= 8/3 (<= 4 with allow_unstable). */
    SNOW_ERROR_REITER_DIFFUSION = 1002,
    /** The radius of the disc or hexagon is not in 1 <= radius <= 2^20. */
    SNOW_ERROR_REITER_RADIUS = 1003,
    /** The sides of the rectangle are not in 1 <= side <= 2^21. */
    SNOW_ERROR_REITER_SIDES = 1004,
    /** A seed lies outside the domain. */
    SNOW_ERROR_REITER_SEED = 1005,
    /** The side of the random cluster is not in 0 <= side <= 1024, or seeds are given as well. */
    SNOW_ERROR_REITER_CLUSTER = 1006,
    /** The noise is negative, or takes the background out of 0 <= background < 1. */
    SNOW_ERROR_REITER_NOISE = 1007,
    /** The rim rule does not fit the domain. */
    SNOW_ERROR_REITER_RIM = 1008,
    /** A background of zero cannot be rescaled to another one. */
    SNOW_ERROR_REITER_RESCALE = 1009,
    /** A value of vapour that a caller set is not in 0 <= vapour < 1. */
    SNOW_ERROR_REITER_VAPOUR = 1010,
    /** No preset has this name. */
    SNOW_ERROR_REITER_PRESET = 1011,
    /** The engine does not keep vapour in this precision. */
    SNOW_ERROR_REITER_PRECISION = 1012,
    /** The tolerance is not in 0 <= tolerance <= 1, or the engine has none. */
    SNOW_ERROR_REITER_TOLERANCE = 1013,

    /* 2xxx: Packard's model. */

    /** The text is not a rule in any of the known spellings. */
    SNOW_ERROR_PACKARD_RULE = 2000,
    /** A rule of digits does not have seven of them. */
    SNOW_ERROR_PACKARD_RULE_LENGTH = 2001,
    /** A rule has a digit that is not allowed there: neither 0 nor 1, or a number of neighbours beyond 6. */
    SNOW_ERROR_PACKARD_RULE_DIGIT = 2002,
    /** Frozen cells would melt: not all numbers from 0 to 6 follow the S. */
    SNOW_ERROR_PACKARD_RULE_MELTS = 2003,
    /** The rule is for another lattice: it lacks the final H. */
    SNOW_ERROR_PACKARD_RULE_LATTICE = 2004,
    /** The rule's bounded universe is neither a torus (T) nor a rhombus (P). */
    SNOW_ERROR_PACKARD_RULE_DOMAIN = 2005,
    /** With d0 = 1 cells without frozen neighbours freeze: on the unbounded plane all at once. */
    SNOW_ERROR_PACKARD_BIRTH = 2006,
    /** The radius of the disc or hexagon is not in 1 <= radius <= 2^20. */
    SNOW_ERROR_PACKARD_RADIUS = 2007,
    /** The sides of rectangle, rhombus, torus or scatter are not in 1 <= side <= 2^21. */
    SNOW_ERROR_PACKARD_SIDES = 2008,
    /** A seed lies outside the domain. */
    SNOW_ERROR_PACKARD_SEED = 2009,
    /** The side of the random patch is not in 0 <= side <= 1024, or seeds are given as well. */
    SNOW_ERROR_PACKARD_CLUSTER = 2010,
    /** The scatter asks for more than half of the cells, or is given beside seeds or a patch. */
    SNOW_ERROR_PACKARD_SCATTER = 2011,
    /** The forced engine cannot compute the scene: the quadtree is for the plane and keeps no freeze steps. */
    SNOW_ERROR_PACKARD_ENGINE = 2012,
    /** A zone's width, angle, distance or step is out of range, or it has both a mask and a predicate. */
    SNOW_ERROR_PACKARD_ZONE = 2013,
    /** The text is not a pattern in run-length encoding. */
    SNOW_ERROR_PACKARD_RLE = 2014,
    /** The pattern has cells that are neither dead nor alive. */
    SNOW_ERROR_PACKARD_RLE_STATES = 2015,

    /* 3xxx: aggregation and erosion. */

    /** The scene is not for this lattice. */
    SNOW_ERROR_AGGREGATE_LATTICE = 3000,
    /** The scene knows the contact rule of arrival only. */
    SNOW_ERROR_AGGREGATE_CONTACT = 3001,
    /** The chance of sticking is not in 0 < sticking <= 1. */
    SNOW_ERROR_AGGREGATE_STICKING = 3002,
    /** The hits are not in 1 <= hits <= 2^16, or the scene has no noise reduction. */
    SNOW_ERROR_AGGREGATE_HITS = 3003,
    /** The kill radius is not above 1, or the scene or engine has none. */
    SNOW_ERROR_AGGREGATE_KILL = 3004,
    /** A seed lies outside the domain, or there is none where one is needed. */
    SNOW_ERROR_AGGREGATE_SEED = 3005,
    /** An obstacle lies outside the domain, or the scene has none. */
    SNOW_ERROR_AGGREGATE_OBSTACLE = 3006,
    /** Two seeds, two obstacles, or a seed and an obstacle are on the same site. */
    SNOW_ERROR_AGGREGATE_OVERLAP = 3007,
    /** No walker can start: the launch interval is empty, or seeds or obstacles block the launch. */
    SNOW_ERROR_AGGREGATE_LAUNCH = 3008,
    /** No way leads from the launch to anything that holds a walker. */
    SNOW_ERROR_AGGREGATE_PATH = 3009,
    /** The radii of the laboratory are not in 1 <= end < launch <= 2^20 (2^17 in space). */
    SNOW_ERROR_AGGREGATE_RADIUS = 3010,
    /** The sides of the box are out of their range. */
    SNOW_ERROR_AGGREGATE_SIDES = 3011,
    /** The interaction radius is not in 0 <= interaction <= 1024. */
    SNOW_ERROR_AGGREGATE_INTERACTION = 3012,
    /** The hardness is not in 1 <= least <= greatest < 2^16. */
    SNOW_ERROR_AGGREGATE_HARDNESS = 3013,
    /** The walls cross, leave no column between them, or lie outside the box. */
    SNOW_ERROR_AGGREGATE_WALLS = 3014,
    /** The number of particles is 0 or too great. */
    SNOW_ERROR_AGGREGATE_PARTICLES = 3015,
    /** The density is not in 0 < density <= 1/2. */
    SNOW_ERROR_AGGREGATE_DENSITY = 3016,
    /** The mobility exponent is not in 0 <= mobility <= 4. */
    SNOW_ERROR_AGGREGATE_MOBILITY = 3017,
    /** No preset has this name. */
    SNOW_ERROR_AGGREGATE_PRESET = 3018,
    /** The engine does not know the scene. */
    SNOW_ERROR_AGGREGATE_ENGINE = 3019
} snow_status;

/**
 * @brief One line of English that says what a status means.
 * @param status any value, known or not.
 * @return A constant string that the library owns; never NULL.
 */
SNOW_API const char *snow_strerror(snow_status status);

#ifdef __cplusplus
}
#endif

#endif
