#include <snowgrowth/grid.h>
#include <snowgrowth/status.h>

const char *snow_strerror(snow_status status)
{
    switch (status) {
    case SNOW_OK: return "no error";
    case SNOW_ERROR_NULL: return "a pointer that must not be NULL is NULL";
    case SNOW_ERROR_STRUCT_SIZE: return "a struct was not initialised by its init function";
    case SNOW_ERROR_STRUCT_TAIL: return "a struct sets a member that this version of the library does not know";
    case SNOW_ERROR_ENUM: return "an enumeration has a value that this library does not know";
    case SNOW_ERROR_BUFFER: return "the buffer does not have the needed size";
    case SNOW_ERROR_RECTANGLE: return "the rectangle has a negative extent or leaves the range of coordinates";
    case SNOW_ERROR_NOT_FINITE: return "a number is not finite";
    case SNOW_ERROR_RANGE: return "a count, limit, flag or size is out of range";
    case SNOW_ERROR_UNSUPPORTED: return "the grid's model has no such field or operation";
    case SNOW_ERROR_NOT_RECORDED: return "freeze steps are not recorded by this grid";
    case SNOW_ERROR_BUSY: return "a progress callback may not change the grid that calls it";
    case SNOW_ERROR_OUTSIDE: return "the cell lies outside the domain";
    case SNOW_ERROR_NO_MEMORY: return "out of memory";
    case SNOW_ERROR_TOO_LARGE: return "the grid is too large, or the answer is";
    case SNOW_ERROR_MEMORY_LIMIT: return "the memory limit would be passed";
    case SNOW_ERROR_THREADS: return "a thread could not be started";
    case SNOW_ERROR_ISA: return "the instruction set is not available";
    case SNOW_ERROR_FORMAT: return "the data are not a saved grid";
    case SNOW_ERROR_FORMAT_VERSION: return "the grid was saved by a later version of the library";
    case SNOW_ERROR_TRUNCATED: return "the saved grid is incomplete";
    case SNOW_ERROR_DAMAGED: return "the saved grid is damaged";
    case SNOW_ERROR_WRITE: return "writing failed";
    case SNOW_ERROR_READ: return "reading failed";
    case SNOW_ERROR_UNSTABLE: return "the vapour grows without bound: the diffusion is too great";
    case SNOW_ERROR_STEP_LIMIT: return "the step count has reached its greatest value";
    case SNOW_ERROR_FULL: return "nothing more can join";
    case SNOW_ERROR_REITER_BACKGROUND: return "the background must be at least 0 and less than 1";
    case SNOW_ERROR_REITER_ADDITION: return "the addition must be between 0 and 1";
    case SNOW_ERROR_REITER_DIFFUSION:
        return "the diffusion must be between 0 and 8/3, or 4 where unstable growth is allowed";
    case SNOW_ERROR_REITER_RADIUS: return "the radius must be between 1 and 1048576";
    case SNOW_ERROR_REITER_SIDES: return "the sides of the rectangle must be between 1 and 2097152";
    case SNOW_ERROR_REITER_SEED: return "a seed lies outside the domain";
    case SNOW_ERROR_REITER_CLUSTER: return "the random cluster must have a side from 0 to 1024 and no seeds beside it";
    case SNOW_ERROR_REITER_NOISE: return "the noise must keep the start between 0 and 1";
    case SNOW_ERROR_REITER_RIM: return "the rim rule does not fit the domain";
    case SNOW_ERROR_REITER_RESCALE: return "a background of 0 cannot be rescaled";
    case SNOW_ERROR_REITER_VAPOUR: return "vapour must be at least 0 and less than 1";
    case SNOW_ERROR_REITER_PRESET: return "there is no preset of this name";
    case SNOW_ERROR_REITER_PRECISION: return "the quad engine has no single precision";
    case SNOW_ERROR_REITER_TOLERANCE:
        return "the tolerance must be between 0 and 1, and 0 where the engine computes every cell";
    case SNOW_ERROR_PACKARD_RULE: return "the rule is neither seven digits nor like B135/S0123456H";
    case SNOW_ERROR_PACKARD_RULE_LENGTH: return "a rule of digits must have seven of them";
    case SNOW_ERROR_PACKARD_RULE_DIGIT: return "a digit of the rule is out of range";
    case SNOW_ERROR_PACKARD_RULE_MELTS: return "the rule would let frozen cells melt: it must end with S0123456H";
    case SNOW_ERROR_PACKARD_RULE_LATTICE: return "the rule is not for the hexagonal lattice: it must end with H";
    case SNOW_ERROR_PACKARD_RULE_DOMAIN: return "the rule's universe must be like T20,13 (torus) or P20,13 (rhombus)";
    case SNOW_ERROR_PACKARD_BIRTH: return "a rule with d0 = 1 (B0) would freeze the unbounded plane at once";
    case SNOW_ERROR_PACKARD_RADIUS: return "the radius of a disc or hexagon must be between 1 and 1048576";
    case SNOW_ERROR_PACKARD_SIDES: return "sides must be between 1 and 2097152";
    case SNOW_ERROR_PACKARD_SEED: return "a cell that is frozen at the start lies outside the domain";
    case SNOW_ERROR_PACKARD_CLUSTER: return "the random patch must have a side from 0 to 1024 and no seeds beside it";
    case SNOW_ERROR_PACKARD_SCATTER:
        return "scattered seeds may fill at most half of their cells, with no other seeds beside them";
    case SNOW_ERROR_PACKARD_ENGINE: return "the forced engine cannot compute this scene";
    case SNOW_ERROR_PACKARD_ZONE: return "a width, angle, distance or step of the zone is out of range";
    case SNOW_ERROR_PACKARD_RLE: return "the text is not a run-length encoded pattern";
    case SNOW_ERROR_PACKARD_RLE_STATES: return "the pattern has cells of more than two states";
    case SNOW_ERROR_AGGREGATE_LATTICE: return "the scene is not for this lattice";
    case SNOW_ERROR_AGGREGATE_CONTACT: return "the scene knows the contact rule of arrival only";
    case SNOW_ERROR_AGGREGATE_STICKING: return "the chance of sticking must be above 0 and at most 1";
    case SNOW_ERROR_AGGREGATE_HITS: return "the hits must be 1 to 65536, and 1 where there is no noise reduction";
    case SNOW_ERROR_AGGREGATE_KILL: return "the kill radius must be above 1 and is for single steps of Witten and Sander";
    case SNOW_ERROR_AGGREGATE_SEED: return "a seed lies outside the domain, or there is none";
    case SNOW_ERROR_AGGREGATE_OBSTACLE: return "an obstacle lies outside the domain, or the scene has none";
    case SNOW_ERROR_AGGREGATE_OVERLAP: return "seeds and obstacles must be on different sites";
    case SNOW_ERROR_AGGREGATE_LAUNCH: return "no walker can start: the launch interval is empty, or seeds or obstacles block the launch";
    case SNOW_ERROR_AGGREGATE_PATH: return "no free path leads from the launch to the cluster";
    case SNOW_ERROR_AGGREGATE_RADIUS: return "the end radius must be at least 1 and less than the launch radius, that at most 1048576 (131072 in space)";
    case SNOW_ERROR_AGGREGATE_SIDES: return "the sides of the box must be between 1 and 1048576, its depth at most 1024";
    case SNOW_ERROR_AGGREGATE_INTERACTION: return "the interaction radius must be between 0 and 1024";
    case SNOW_ERROR_AGGREGATE_HARDNESS: return "the hardness must be between 1 and 65535, the least not above the greatest";
    case SNOW_ERROR_AGGREGATE_WALLS: return "the walls cross, leave no column between them, or lie outside the box";
    case SNOW_ERROR_AGGREGATE_PARTICLES: return "the number of particles is 0 or too great";
    case SNOW_ERROR_AGGREGATE_DENSITY: return "the density must be above 0 and at most 1/2";
    case SNOW_ERROR_AGGREGATE_MOBILITY: return "the mobility exponent must be between 0 and 4";
    case SNOW_ERROR_AGGREGATE_PRESET: return "there is no preset of aggregation of this name";
    case SNOW_ERROR_AGGREGATE_ENGINE: return "the engine does not know the scene";
    }
    return "unknown status";
}

const char *snow_stop_name(snow_stop_reason reason)
{
    switch (reason) {
    case SNOW_STOP_NONE: return "none";
    case SNOW_STOP_STEPS: return "steps";
    case SNOW_STOP_RIM: return "rim";
    case SNOW_STOP_RADIUS: return "radius";
    case SNOW_STOP_FROZEN: return "frozen";
    case SNOW_STOP_STILL: return "still";
    case SNOW_STOP_TIME: return "time";
    case SNOW_STOP_CANCELLED: return "cancelled";
    case SNOW_STOP_UNSTABLE: return "unstable";
    case SNOW_STOP_FULL: return "full";
    case SNOW_STOP_HEIGHT: return "height";
    }
    return "unknown";
}
