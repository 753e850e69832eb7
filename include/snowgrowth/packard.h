/**
 * @file packard.h
 * @brief Packard's snow crystals: Boolean rules on the hexagonal lattice, with
 * zones where they are restricted or given priority.
 *
 * N. H. Packard, "Lattice models for solidification and aggregation" (1986),
 * and S. Wolfram, "Computer software in science and mathematics", Scientific
 * American 251(3) (1984) 188–203. A cell is frozen or not. A rule is seven
 * digits d0…d6: a cell with k frozen cells among its six neighbours freezes if
 * and only if d_k = 1. Frozen cells never melt. 0101010 is the parity rule.
 *
 * The zones are those of Liu Shida and Zhang Ziguo, who grew snowflakes with
 * them (figs. 4 and 5 of their paper of 1987; doc/packard.md): in a
 * *restriction* nothing freezes, in a *priority* zone one frozen neighbour is
 * enough.
 *
 * Decisions of this library are argued in doc/packard.md.
 */
#ifndef SNOWGROWTH_PACKARD_H
#define SNOWGROWTH_PACKARD_H

#include <snowgrowth/export.h>
#include <snowgrowth/grid.h>
#include <snowgrowth/options.h>
#include <snowgrowth/status.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @brief Room for every text that snow_packard_rule_text() writes, the final zero included. */
#define SNOW_PACKARD_RULE_SIZE 24

/** @brief Shapes of the interior. Cells outside it are never frozen. */
typedef enum snow_packard_domain {
    SNOW_PACKARD_PLANE = 1,     /**< Unbounded: it grows as the crystal does. */
    SNOW_PACKARD_DISC = 2,      /**< Cells with q² + q·r + r² < radius². */
    SNOW_PACKARD_HEXAGON = 3,   /**< Cells with max(|q|, |r|, |q + r|) < radius. */
    SNOW_PACKARD_RECTANGLE = 4, /**< width × height cells, odd rows half a cell to the right; the origin is column width/2 of row height/2. */
    SNOW_PACKARD_RHOMBUS = 5,   /**< −⌊width/2⌋ <= q < width − ⌊width/2⌋, and r likewise with height. */
    SNOW_PACKARD_TORUS = 6      /**< The same cells, opposite sides joined: q = width − ⌊width/2⌋ is q = −⌊width/2⌋, whatever the sides. */
} snow_packard_domain;

/** @brief What computes the steps. All give the same cells. */
typedef enum snow_packard_engine {
    SNOW_PACKARD_ENGINE_AUTO = 0,      /**< The library chooses, and chooses again as the crystal grows. */
    SNOW_PACKARD_ENGINE_REFERENCE = 1, /**< A byte a cell, a plain reading of the rule; slow. */
    SNOW_PACKARD_ENGINE_TILES = 2,     /**< A bit a cell, in tiles; only tiles in which something changes are visited. */
    SNOW_PACKARD_ENGINE_QUADTREE = 3   /**< Equal squares are kept and computed once; 2^k steps at a time. Only on the plane, without freeze steps; steps in which a zone applies are taken by tiles. */
} snow_packard_engine;

/**
 * @brief The name of an engine ("auto", "reference", "tiles", "quadtree").
 * @param engine the engine.
 * @return A constant string that the library owns; NULL for an unknown value.
 */
SNOW_API const char *snow_packard_engine_name(snow_packard_engine engine);

/** @brief How a rule is written. */
typedef enum snow_packard_notation {
    SNOW_PACKARD_DIGITS = 1, /**< Seven digits, d0 first: "0101010". */
    SNOW_PACKARD_BIRTHS = 2  /**< That of cellular automata: "B135/S0123456H". */
} snow_packard_notation;

/**
 * @brief A scene of Packard's model.
 *
 * Write the defaults with snow_packard_params_init(), then change what you need.
 */
typedef struct snow_packard_params {
    size_t struct_size; /**< Set by snow_packard_params_init(). */

    uint32_t rule; /**< Bit k is the digit d_k; 0x2A, the parity rule 0101010, by default. See snow_packard_params_rule(). */

    snow_packard_domain domain; /**< Shape of the interior; the plane by default. */
    int32_t radius;             /**< Of a disc or hexagon, 1 to 2^20; 200 by default. */
    int32_t width;              /**< Of a rectangle, rhombus or torus, 1 to 2^21; 400 by default. */
    int32_t height;             /**< Likewise. */

    const snow_cell *seeds; /**< Cells that are frozen at the start, copied; NULL (default): the origin. */
    size_t seed_count;      /**< How many seeds; with a list of 0 cells nothing is frozen at the start. */
    int32_t cluster;        /**< q > 0: a random patch in place of seeds, q × q cells round the origin (those of a rhombus), each frozen with probability 1/2, an empty patch drawn again; at most 1024; 0 by default. */
    int32_t scatter;        /**< n > 0: so many different cells in place of seeds, drawn from a rhombus round the origin; at most half of its cells, rounded up; 0 by default. */
    int32_t scatter_side;   /**< Sides of that rhombus, of which only the interior counts; 1 to 2^21; 400 by default. */
    uint64_t random_seed;   /**< Chooses patch and scatter; 0 by default. */

    int32_t record_freeze_steps; /**< 1: keep the step in which each cell froze; 0 by default. */
    snow_packard_engine engine;  /**< SNOW_PACKARD_ENGINE_AUTO by default. */
} snow_packard_params;

/**
 * @brief Writes the default scene: the parity rule on the plane, one seed.
 * @param params where to; nothing happens when it is NULL.
 * @param struct_size sizeof(snow_packard_params) as the caller was compiled.
 */
SNOW_API void snow_packard_params_init(snow_packard_params *params, size_t struct_size);

/**
 * @brief Sets the rule from its text, in any of the usual spellings.
 *
 * Seven digits ("0101010"); "B135/S0123456H", also in lower case, as
 * "B135S0123456H" or "0123456/135H"; and with the bounded universes that RLE
 * files name: "…:T20,13" makes the domain a torus of 20 × 13, "…:P20,13" a
 * rhombus, "…:T20" and "…:P20" ones with equal sides.
 *
 * @param params an initialised scene; rule, and with a suffix domain, width
 *        and height are set, the rest is kept.
 * @param text the rule; spaces around it do not matter.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL, ::SNOW_ERROR_STRUCT_SIZE,
 *         ::SNOW_ERROR_STRUCT_TAIL; ::SNOW_ERROR_PACKARD_RULE when it is none of the spellings;
 *         ::SNOW_ERROR_PACKARD_RULE_LENGTH when it has another number of
 *         digits than seven; ::SNOW_ERROR_PACKARD_RULE_DIGIT for digits that
 *         no rule of six neighbours has; ::SNOW_ERROR_PACKARD_RULE_MELTS when
 *         frozen cells would melt: a number from 0 to 6 is missing after S;
 *         ::SNOW_ERROR_PACKARD_RULE_LATTICE without the H of the hexagonal
 *         lattice; ::SNOW_ERROR_PACKARD_RULE_DOMAIN for a suffix that is not
 *         one of those; ::SNOW_ERROR_PACKARD_SIDES for its numbers.
 */
SNOW_API snow_status snow_packard_params_rule(snow_packard_params *params, const char *text);

/**
 * @brief Writes a rule as text.
 * @param rule bit k is the digit d_k; less than 128.
 * @param notation how.
 * @param text receives the text and a final zero.
 * @param capacity bytes that text holds; ::SNOW_PACKARD_RULE_SIZE is always enough.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL, ::SNOW_ERROR_ENUM, ::SNOW_ERROR_RANGE;
 *         ::SNOW_ERROR_BUFFER when capacity is too small, nothing is written.
 */
SNOW_API snow_status snow_packard_rule_text(uint32_t rule, snow_packard_notation notation, char *text,
                                            size_t capacity);

/**
 * @brief Makes a grid of Packard's model.
 *
 * ::SNOW_FIELD_VALUE and ::SNOW_FIELD_FROZEN read 1 where a cell is frozen,
 * else 0; ::SNOW_FIELD_VAPOUR the reverse; ::SNOW_FIELD_RECEPTIVE,
 * ::SNOW_FIELD_INSIDE and ::SNOW_FIELD_FREEZE_STEP as in grid.h; the others
 * are not there. ::SNOW_FIELD_VALUE and ::SNOW_FIELD_FROZEN can be set, to 0
 * or 1 in the interior (others are passed over): a cell that froze is then
 * dated with the step count, and zones do not hinder it.
 *
 * A frozen cell next to one outside the interior is within reach of the rim;
 * the plane and a torus have no rim.
 *
 * On the plane the number of cells, bounds beyond 2^30 and fields over the
 * whole interior can be too large to be told; see grid.h. Freeze steps later
 * than 2^32 − 2 are told as that.
 *
 * Memory: the tiles need about 0.2 bytes for each cell of the region that the
 * crystal has reached, a twelfth of that while the scene has all symmetries of
 * the hexagon, and four bytes more a cell with freeze steps; the quadtree about
 * 28 bytes for each different square. Both grow as the crystal does: a step can
 * answer ::SNOW_ERROR_NO_MEMORY, ::SNOW_ERROR_MEMORY_LIMIT or
 * ::SNOW_ERROR_TOO_LARGE; the grid then stands where snow_steps() says, between
 * two steps, and can be asked, saved and continued.
 *
 * A time limit (snow_stop.seconds) is looked at after each few milliseconds of
 * work of the tiles, longer with zones and many cells; the quadtree then takes
 * at most as many steps at once as were taken before.
 *
 * @param params the scene.
 * @param options memory, threads, instruction set; NULL: the defaults.
 * @param grid receives the grid; the caller destroys it.
 * @return ::SNOW_OK; ::SNOW_ERROR_NULL; ::SNOW_ERROR_STRUCT_SIZE,
 *         ::SNOW_ERROR_STRUCT_TAIL; ::SNOW_ERROR_ENUM; ::SNOW_ERROR_RANGE for a
 *         flag that is neither 0 nor 1 or a rule of 128 or more, a thread count
 *         out of range, or one of allocate and release without the other;
 *         ::SNOW_ERROR_PACKARD_BIRTH for d0 = 1 on the plane, which would
 *         freeze at once; ::SNOW_ERROR_PACKARD_RADIUS to
 *         ::SNOW_ERROR_PACKARD_ENGINE for the scene; ::SNOW_ERROR_NO_MEMORY,
 *         ::SNOW_ERROR_TOO_LARGE, ::SNOW_ERROR_MEMORY_LIMIT,
 *         ::SNOW_ERROR_THREADS, ::SNOW_ERROR_ISA. Cost: that of the seeds; on a
 *         disc or rectangle also that of its rows, and where d0 = 1 that of the
 *         whole domain.
 */
SNOW_API snow_status snow_packard_create(const snow_packard_params *params, const snow_options *options,
                                         snow_grid **grid);

/** @brief What a zone does in its steps. Where both apply, restriction wins. */
typedef enum snow_packard_zone_kind {
    SNOW_PACKARD_RESTRICTION = 1, /**< No cell of the zone freezes, whatever the rule says. */
    SNOW_PACKARD_PRIORITY = 2     /**< A cell of the zone with at least one frozen neighbour freezes, whatever the rule says. */
} snow_packard_zone_kind;

/** @brief Which cells are in a zone. */
typedef enum snow_packard_zone_shape {
    SNOW_PACKARD_CORNERS = 1, /**< Six sectors about the directions of the corners of a hexagonal plate: the lattice's axes. */
    SNOW_PACKARD_SIDES = 2,   /**< Six sectors about the directions half-way between: the middles of the plate's sides. */
    SNOW_PACKARD_CELLS = 3    /**< The cells of `rect` that `contains` or `mask` names; without either all of them. */
} snow_packard_zone_shape;

/** @brief The last step of a zone that never ends. */
#define SNOW_PACKARD_FOREVER INT64_MAX

/**
 * @brief Whether a cell is in a zone. Asked once for each cell of the zone's
 * rectangle, when the zone is added.
 * @param context the caller's own pointer.
 * @param q,r the cell.
 * @return 0: it is not; anything else: it is.
 */
typedef int (*snow_packard_contains)(void *context, int32_t q, int32_t r);

/**
 * @brief Cells, a span of steps, and what happens to them then.
 *
 * Write the defaults with snow_packard_zone_init(), then change what you need.
 * Steps are counted from 1: step t is the one after which snow_steps() says t.
 *
 * Sectors lie round `centre`. The cells at hexagonal distance n from it make a
 * hexagon with sides of n + 1 cells; a cell is in a sector if its distance is
 * from `inner` to `outer`, and it lies, along its side, no farther than
 * `half_width` cells from the corner (or from the middle of the side), or, if
 * `half_angle` is not 0, in a direction no farther than that many degrees from
 * that of the corner (the middle), up to 2^−40.
 */
typedef struct snow_packard_zone {
    size_t struct_size;           /**< Set by snow_packard_zone_init(). */
    snow_packard_zone_kind kind;  /**< What it does. */
    snow_packard_zone_shape shape; /**< Which cells. */
    int64_t first_step;           /**< The first step in which it applies; 1 by default. */
    int64_t last_step;            /**< The last one; SNOW_PACKARD_FOREVER by default. */

    snow_cell centre;  /**< Of the sectors; the origin by default. */
    double half_width; /**< In cells, 0 (default) or more; halves make sense at the middles of sides. */
    double half_angle; /**< In degrees, 0 (default: the width is meant) to 30. */
    int32_t inner;     /**< Least distance from the centre; 0 by default. */
    int32_t outer;     /**< Greatest distance from the centre; INT32_MAX (default): no limit. */
    int32_t inverted;  /**< 1: the zone is all other cells of the plane; 0 by default. */

    snow_rect rect;                 /**< Of ::SNOW_PACKARD_CELLS: where its cells lie; empty by default. */
    const uint8_t *mask;            /**< width * height bytes in row order, copied; not 0: in the zone. NULL by default. */
    snow_packard_contains contains; /**< Asked in place of the mask; NULL by default. */
    void *contains_context;         /**< Handed to contains. */
} snow_packard_zone;

/**
 * @brief Prepares a zone: the cells on the six axes, for ever.
 * @param zone where to; nothing happens when it is NULL.
 * @param struct_size sizeof(snow_packard_zone) as the caller was compiled.
 * @param kind what it does.
 * @param shape which cells.
 */
SNOW_API void snow_packard_zone_init(snow_packard_zone *zone, size_t struct_size, snow_packard_zone_kind kind,
                                     snow_packard_zone_shape shape);

/**
 * @brief Adds a zone to a grid, before its first step or between two steps.
 *
 * Steps that were taken are not taken back: it applies from the next step on.
 * There may be any number of zones. A zone costs nothing in steps in which it
 * does not apply, and nothing where it has no cells; when one begins or ends,
 * the tiles are looked through once.
 *
 * @param grid a grid of Packard's model.
 * @param zone the zone, copied.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL, ::SNOW_ERROR_STRUCT_SIZE,
 *         ::SNOW_ERROR_STRUCT_TAIL, ::SNOW_ERROR_ENUM, ::SNOW_ERROR_BUSY;
 *         ::SNOW_ERROR_UNSUPPORTED for another model;
 *         ::SNOW_ERROR_NOT_FINITE; ::SNOW_ERROR_RECTANGLE;
 *         ::SNOW_ERROR_RANGE for a flag that is neither 0 nor 1;
 *         ::SNOW_ERROR_PACKARD_ZONE when a width, angle, distance or step is
 *         out of range, the last step comes before the first, or both mask and
 *         contains are given; ::SNOW_ERROR_NO_MEMORY,
 *         ::SNOW_ERROR_MEMORY_LIMIT, ::SNOW_ERROR_TOO_LARGE. Cost: that of the
 *         rectangle; a bit a cell of it is kept.
 */
SNOW_API snow_status snow_packard_add_zone(snow_grid *grid, const snow_packard_zone *zone);

/**
 * @brief The rule of a grid.
 * @param grid a grid of Packard's model.
 * @param rule receives it: bit k is the digit d_k.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_UNSUPPORTED for another model.
 */
SNOW_API snow_status snow_packard_rule_of(const snow_grid *grid, uint32_t *rule);

/**
 * @brief The engine that computes the steps at present.
 * @param grid a grid of Packard's model.
 * @param engine receives it; never ::SNOW_PACKARD_ENGINE_AUTO.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_UNSUPPORTED for another model.
 */
SNOW_API snow_status snow_packard_engine_of(const snow_grid *grid, snow_packard_engine *engine);

/**
 * @brief The exact number of frozen cells, high · 2^64 + low.
 * @param grid a grid of Packard's model.
 * @param high receives the multiples of 2^64.
 * @param low receives the rest.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_UNSUPPORTED for another
 *         model. Cost: constant.
 */
SNOW_API snow_status snow_packard_population(const snow_grid *grid, uint64_t *high, uint64_t *low);

/**
 * @brief Copies which cells of a region are frozen, a bit a cell, however far away it is.
 *
 * Each row takes ⌈width/64⌉ words: cell (q + i, r + j) is bit i mod 64 of word
 * ⌊i/64⌋ of row j. Bits beyond a row's end are 0.
 *
 * @param grid a grid of Packard's model.
 * @param q,r the first cell.
 * @param width,height extents, 0 or more.
 * @param words receives height * ⌈width/64⌉ words.
 * @param capacity how many words the array holds.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_UNSUPPORTED for another
 *         model; ::SNOW_ERROR_RECTANGLE when an extent is negative or the region
 *         reaches farther than 2^62; ::SNOW_ERROR_BUFFER when capacity is too
 *         small, nothing is copied. Cost: that of the region.
 */
SNOW_API snow_status snow_packard_copy_bits(const snow_grid *grid, int64_t q, int64_t r, int64_t width,
                                            int64_t height, uint64_t *words, size_t capacity);

/**
 * @brief Makes a grid from a pattern in run-length encoding (RLE), as Golly and
 * other programs for cellular automata exchange them.
 *
 * Cell (x, y) of the pattern, x to the right and y down, becomes q = x − y,
 * r = y: Golly's hexagonal neighbourhood is the cell's row and column
 * neighbours and those to its upper left and lower right. On a rhombus or
 * torus it becomes q = x, r = −y, or −1 − y where the height is even: there the
 * sides must be those of the pattern, and that makes it a mirror image. A rule
 * in the header is taken, with its bounded universe if it names one. The line
 * CXRLE gives position and step count ("Pos=", "Gen="); without a position the
 * middle of the extents that the header names comes to lie on the origin.
 *
 * Nothing in the text is trusted: a few bytes of it can stand for at most 2^32
 * frozen cells, and their memory counts against the limit. Cost: that of the
 * text and of the frozen cells.
 *
 * @param text the pattern; need not end with a zero.
 * @param size bytes of text.
 * @param params the scene, for all that the text does not say; its seeds,
 *        cluster and scatter are not looked at. NULL: the defaults.
 * @param options memory, threads, instruction set; NULL: the defaults.
 * @param grid receives the grid; the caller destroys it.
 * @return as snow_packard_create() and snow_packard_params_rule();
 *         ::SNOW_ERROR_PACKARD_RLE when it is no such pattern;
 *         ::SNOW_ERROR_PACKARD_RLE_STATES when it has cells of more than two
 *         states; ::SNOW_ERROR_TRUNCATED when it ends before its final "!";
 *         ::SNOW_ERROR_PACKARD_SEED for frozen cells outside the domain;
 *         ::SNOW_ERROR_TOO_LARGE for more frozen cells than that, a row or
 *         column beyond ±2^30, or a step count beyond 2^62.
 */
SNOW_API snow_status snow_packard_load_rle(const void *text, size_t size, const snow_packard_params *params,
                                           const snow_options *options, snow_grid **grid);

/**
 * @brief The same from what a reader gives.
 * @param read the reader; it is read until it says that the end is reached.
 * @param context handed to it.
 * @param params as in snow_packard_load_rle().
 * @param options likewise; the memory limit holds for the text while it is
 *        read, and for the grid, each by itself.
 * @param grid receives the grid; the caller destroys it.
 * @return as snow_packard_load_rle(); and ::SNOW_ERROR_READ when the reader failed.
 */
SNOW_API snow_status snow_packard_load_rle_from(snow_reader read, void *context, const snow_packard_params *params,
                                                const snow_options *options, snow_grid **grid);

/**
 * @brief Writes the frozen cells as a pattern in run-length encoding.
 *
 * The header names the rule, for torus and rhombus also the universe; CXRLE
 * tells position and step count. What snow_packard_load_rle() makes of it has
 * the same cells in the same places, without zones, freeze steps and other
 * domains.
 *
 * @param grid a grid of Packard's model.
 * @param buffer where to; NULL: only the size is wanted.
 * @param capacity bytes that the buffer holds.
 * @param size receives the size in bytes, also when the buffer is too small.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_UNSUPPORTED for another
 *         model; ::SNOW_ERROR_BUFFER, nothing is written;
 *         ::SNOW_ERROR_TOO_LARGE for what snow_packard_load_rle() would not
 *         read: a row or column of the pattern beyond ±2^30, or more than 2^32
 *         frozen cells. Cost: that of the parts of the plane that hold frozen
 *         cells, twice with a buffer; what lies between them is written as numbers.
 */
SNOW_API snow_status snow_packard_save_rle(const snow_grid *grid, void *buffer, size_t capacity, size_t *size);

/**
 * @brief The same through the caller's writer.
 * @param grid a grid of Packard's model.
 * @param write the writer.
 * @param context handed to it.
 * @return as snow_packard_save_rle(); ::SNOW_ERROR_WRITE when the writer
 *         failed, it is not called again.
 */
SNOW_API snow_status snow_packard_save_rle_to(const snow_grid *grid, snow_writer write, void *context);

#ifdef __cplusplus
}
#endif

#endif
