/**
 * @file aggregate.h
 * @brief Diffusion-limited aggregation and erosion on lattices.
 *
 * Walkers come one after the other, wander, and stay where they touch: T. A.
 * Witten and L. M. Sander, "Diffusion-limited aggregation, a kinetic critical
 * phenomenon", Phys. Rev. Lett. 47 (1981) 1400–1403. Beside their model stand
 * the scenes of A. Shipilevsky's program ("Fractal clusters", 1989: shore,
 * electrolysis, chimney, snowflake), those of a laboratory sheet on fractal
 * clusters (point and line seeds), the cluster–cluster model of P. Meakin and
 * of M. Kolb, R. Botet and R. Jullien (Phys. Rev. Lett. 51 (1983) 1119 and
 * 1123), and aggregation off the lattice.
 *
 * **Step.** A step is one particle: a walker or several that end with one more
 * site filled; in the shore scene one cell washed away; in the cluster–cluster
 * scene one merging of two clusters or more. snow_run() ends at a mass
 * (`frozen`), a radius (`tip_radius`), a height (`height`), a number of steps
 * (`max_steps`), where the scene itself ends (`rim`), when one cluster is left
 * (`still`), and in any case when nothing more can join (::SNOW_STOP_FULL). By default it ends after 10,000 steps.
 *
 * **Sites.** A ::snow_site is (x, y) in the plane, with z = 0, and (x, y, z) in
 * space. On the square and the cubic lattice these are Cartesian; on the
 * hexagonal one they are axial, as in grid.h. The last axis (y in the plane, z
 * in space) points up. Where a call of grid.h speaks of a cell (q, r), q is x
 * and r is y; a site of the cubic lattice has no such cell.
 *
 * **Law.** With ::SNOW_AGGREGATE_WITTEN_SANDER the next site is drawn from the
 * harmonic measure of the cluster on its lattice, as if each walker came from
 * infinity. How closely is said in doc/aggregate.md, and tested.
 *
 * **Random numbers.** Each walker has its own counter-based stream, chosen by
 * `random_seed` and by how many walkers came before it. The same numbers give
 * the same cluster on every platform, with any number of threads and any
 * instruction set.
 */
#ifndef SNOWGROWTH_AGGREGATE_H
#define SNOWGROWTH_AGGREGATE_H

#include <snowgrowth/export.h>
#include <snowgrowth/grid.h>
#include <snowgrowth/options.h>
#include <snowgrowth/status.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @brief Where walkers start, how they move and what stops them. */
typedef enum snow_aggregate_scene {
    SNOW_AGGREGATE_WITTEN_SANDER = 1,   /**< Seeds in the unbounded plane or space; walkers come from infinity. Square, hexagonal, cubic. */
    SNOW_AGGREGATE_LABORATORY = 2,      /**< The same with the sheet's rules: launched on the circle (sphere) of `launch_radius` round the origin, dropped beyond three times that, at the rim when the cluster reaches `end_radius`, full when it comes within one site of that circle. Square, hexagonal, cubic. */
    SNOW_AGGREGATE_LINE = 3,            /**< Trees on the floor of a vessel of `width` × (`depth` ×) `height` sites; walkers start uniformly on its top row (layer), walls and lid reflect. Square, hexagonal, cubic. */
    SNOW_AGGREGATE_ELECTROLYSIS = 4,    /**< Ions fall from the top row of a `width` × `height` bath towards the cathode below it, down-left, down or down-right with equal chance. Square. */
    SNOW_AGGREGATE_SHORE = 5,           /**< Waves come down in the same three moves and wash away land: `width` × `height` cells, each with its own hardness. Square. */
    SNOW_AGGREGATE_CHIMNEY = 6,         /**< Soot rises in the three moves upwards between two walls and stays on walls and soot. Square. */
    SNOW_AGGREGATE_SNOWFLAKE = 7,       /**< Eight moves in a window one cell wider than the cluster, which reflects and widens; walkers start on its perimeter. Square. */
    SNOW_AGGREGATE_CLUSTER_CLUSTER = 8, /**< `particles` in a periodic box at a given `density`; clusters move as rigid bodies and merge on contact. Square, cubic. */
    SNOW_AGGREGATE_OFF_LATTICE = 9      /**< Discs of diameter 1 in the plane, Brownian walkers from infinity, contact at distance 1. `lattice` is not looked at. */
} snow_aggregate_scene;

/** @brief Lattices. */
typedef enum snow_aggregate_lattice {
    SNOW_AGGREGATE_SQUARE = 1,    /**< (x, y), four neighbours. */
    SNOW_AGGREGATE_HEXAGONAL = 2, /**< Axial (q, r), six neighbours: the triangular lattice of the literature. */
    SNOW_AGGREGATE_CUBIC = 3      /**< (x, y, z), six neighbours. */
} snow_aggregate_lattice;

/** @brief What "touching the cluster" means; both are called lattice DLA in the literature. */
typedef enum snow_aggregate_contact {
    SNOW_AGGREGATE_ARRIVAL = 1, /**< The walker stays on the first site that it reaches next to the cluster (Witten and Sander). */
    SNOW_AGGREGATE_ENTRY = 2    /**< It stays where it stands when it tries to step onto a site of the cluster (the dielectric breakdown model with η = 1). */
} snow_aggregate_contact;

/** @brief What moves the walkers. */
typedef enum snow_aggregate_engine {
    SNOW_AGGREGATE_ENGINE_AUTO = 0,  /**< The fastest that the scene has. */
    SNOW_AGGREGATE_ENGINE_JUMPS = 1, /**< Jumps over empty regions with the exact exit laws of the lattice: Witten–Sander, laboratory and line. */
    SNOW_AGGREGATE_ENGINE_STEPS = 2  /**< Plain single steps: the reference. Another engine, other random numbers: the same law, not the same cluster. */
} snow_aggregate_engine;

/** @brief A site. */
typedef struct snow_site {
    int32_t x; /**< First coordinate (q on the hexagonal lattice). */
    int32_t y; /**< Second coordinate (r on the hexagonal lattice). */
    int32_t z; /**< Third coordinate, 0 in the plane. */
} snow_site;

/** @brief A point of the plane or of space, in lattice spacings (disc diameters). */
typedef struct snow_point {
    double x; /**< To the right. */
    double y; /**< In the plane: up. */
    double z; /**< In space: up; 0 in the plane. */
} snow_point;

/**
 * @brief A scene.
 *
 * Write the defaults with snow_aggregate_params_init(), then change what you
 * need. Members that a scene does not use are not looked at.
 */
typedef struct snow_aggregate_params {
    size_t struct_size;             /**< Set by snow_aggregate_params_init(). */
    snow_aggregate_scene scene;     /**< SNOW_AGGREGATE_WITTEN_SANDER by default. */
    snow_aggregate_lattice lattice; /**< SNOW_AGGREGATE_SQUARE by default. */
    snow_aggregate_contact contact; /**< Of Witten–Sander, laboratory and line; SNOW_AGGREGATE_ARRIVAL by default. */
    snow_aggregate_engine engine;   /**< SNOW_AGGREGATE_ENGINE_AUTO by default. */
    uint64_t random_seed;           /**< Chooses every random number; 0 by default. */
    double sticking;                /**< p, the chance that a contact sticks, 0 < p <= 1; 1 by default. See snow_aggregate_create(). */
    int32_t hits;                   /**< Noise reduction: a site is filled by the m-th walker that ends on it, 1 (default) to 2^16. Scenes on a lattice except shore and cluster–cluster. */
    int32_t record_order;           /**< 1: keep a table from sites to particles, at most 16 bytes a particle, for snow_aggregate_order_at() and ::SNOW_FIELD_FREEZE_STEP; 0 by default. */

    const snow_site *seeds;     /**< Sites that are filled at the start, copied; NULL (default): the origin, or where the scene has a floor, cathode or walls: none beside them. */
    size_t seed_count;          /**< How many. */
    const snow_site *obstacles; /**< Sites that can be neither entered nor filled, copied: a step onto one is refused and costs its time. None by default. Witten–Sander, laboratory and line. */
    size_t obstacle_count;      /**< How many. */

    double kill_radius; /**< Witten–Sander with ENGINE_STEPS: walkers are dropped beyond this multiple (> 1) of the launch radius, which biases the law; 0 (default): none is dropped. For comparisons. */
    int32_t launch_radius; /**< Laboratory: R0, 2 to 2^20; 100 by default. */
    int32_t end_radius;    /**< Laboratory: R < R0, where the growth is at its rim; 90 by default. */

    int32_t width;    /**< Columns of vessel, bath, shore or shaft: 1 to 2^20; 256 by default. */
    int32_t height;   /**< Rows, counted upwards from 0: 1 to 2^20; 256 by default. */
    int32_t depth;    /**< The vessel's second horizontal extent on the cubic lattice (y): 1 to 2^10; 64 by default. */
    int32_t periodic; /**< Line, electrolysis, shore: 1: the sides are joined; 0 (default): they reflect: a step through one is refused, or of the three moves only its sideways part. */

    int32_t launch_first;  /**< Electrolysis: first column that ions start in; INT32_MIN by default. */
    int32_t launch_last;   /**< The last one; INT32_MAX by default. What lies outside the bath is cut off. */
    int32_t cathode_first; /**< Electrolysis: first column of the cathode, which lies in row −1; INT32_MIN by default. */
    int32_t cathode_last;  /**< The last one; INT32_MAX by default. Less than the first: no cathode but the seeds. */
    double interaction;    /**< Electrolysis: ρ, 0 to 1024; 0 (default): ions must touch. */

    int32_t hardness_least;    /**< Shore: the least hardness of a cell, at least 1; 1 by default. */
    int32_t hardness_greatest; /**< Shore: the greatest, at most 2^16 − 1; 3 by default. */

    int32_t wall_left;      /**< Chimney: column of the left wall in row 0; 0 by default. */
    int32_t wall_left_top;  /**< In the top row; 0 by default. */
    int32_t wall_right;     /**< Chimney: column of the right wall in row 0; 255 by default. */
    int32_t wall_right_top; /**< In the top row; 255 by default. */

    uint64_t particles; /**< Cluster–cluster: how many, 1 to 2^24; 10,000 by default. */
    double density;     /**< Cluster–cluster: particles per site, 0 < density <= 1/2; 0.05 by default. The box is the smallest square or cube with at least particles/density sites. */
    double mobility;    /**< Cluster–cluster: a cluster of s particles moves with a chance proportional to s^−mobility, 0 to 4; 0 by default. */
} snow_aggregate_params;

/**
 * @brief Writes the default scene: one seed on the square lattice, walkers from infinity, arrival, p = 1.
 * @param params where to; nothing happens when it is NULL.
 * @param struct_size sizeof(snow_aggregate_params) as the caller was compiled.
 */
SNOW_API void snow_aggregate_params_init(snow_aggregate_params *params, size_t struct_size);

/**
 * @brief Sets the scene of a figure of the sources.
 * @param params an initialised scene; random_seed and record_order are kept,
 *        all else is set.
 * @param name a name that snow_aggregate_preset_name() gives.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL, ::SNOW_ERROR_STRUCT_SIZE;
 *         ::SNOW_ERROR_AGGREGATE_PRESET when there is no such preset.
 */
SNOW_API snow_status snow_aggregate_params_preset(snow_aggregate_params *params, const char *name);

/**
 * @brief The names of the presets, one by one ("snowflake").
 * @param index from 0 on.
 * @return A constant string that the library owns; NULL after the last.
 */
SNOW_API const char *snow_aggregate_preset_name(size_t index);

/**
 * @brief Where the presets come from ("Shipilevsky 1989, fig. 6: snowflake").
 * @param index from 0 on.
 * @return A constant string that the library owns; NULL after the last.
 */
SNOW_API const char *snow_aggregate_preset_source(size_t index);

/**
 * @brief Makes a grid that grows by aggregation or wears by erosion.
 *
 * What sticks when p < 1: there is one trial in every time step that a walker
 * spends on a site where it touches, and (entry) one at every attempt to step
 * onto a filled site. A step onto a filled site does not take place and costs
 * its time. In the shore scene a hit wears with chance p; clusters that a move
 * brings together, or that stop it, merge with chance p; a disc that does not
 * stick tries to step off by one diameter in a random direction, and stays for
 * another trial where it would overlap. A walker makes about 1/p trials, and
 * nothing interrupts it before it has ended.
 *
 * Fields that can be read in the plane, but not off the lattice:
 * ::SNOW_FIELD_FROZEN (1 where a site is filled; in the shore scene where a cell
 * was washed away), ::SNOW_FIELD_INSIDE, ::SNOW_FIELD_VALUE (as frozen; in the
 * shore scene the hardness that is left), ::SNOW_FIELD_RECEPTIVE (1 where a site
 * is filled or next to one), ::SNOW_FIELD_FREEZE_STEP (the step in which the
 * site was filled, 0 for seeds). The last needs record_order; with
 * ::SNOW_AGGREGATE_ENGINE_JUMPS all need it but inside. None can be set. The
 * mass follows from them; symmetry defect and pictures (render.h) are for the
 * hexagonal lattice. Tip radius and bounds are those of all particles; bounds
 * in space of their x and y, off the lattice of the squares that hold their
 * centres. In the cluster–cluster scene snow_frozen() is the mass of the largest
 * cluster.
 *
 * Memory: 8 bytes a particle, and for the walk about 4 more with
 * ::SNOW_AGGREGATE_ENGINE_JUMPS, else a byte for each site of the box about the
 * particles (the vessel, up to their height). Shores take 2 bytes a cell; off
 * the lattice about 60 bytes a particle; the cluster–cluster scene 160 bytes a
 * particle and 5 for each site of its box. Stepping asks for memory as the
 * cluster grows; beyond some 10^9 particles by jumps it ends with
 * ::SNOW_ERROR_TOO_LARGE.
 *
 * @param params the scene.
 * @param options memory, threads, instruction set; NULL: the defaults.
 * @param grid receives the grid; the caller destroys it.
 * @return ::SNOW_OK; ::SNOW_ERROR_NULL; ::SNOW_ERROR_STRUCT_SIZE,
 *         ::SNOW_ERROR_STRUCT_TAIL; ::SNOW_ERROR_ENUM; ::SNOW_ERROR_RANGE for
 *         a flag that is neither 0 nor 1 or an option out of range;
 *         ::SNOW_ERROR_NOT_FINITE; ::SNOW_ERROR_AGGREGATE_LATTICE to
 *         ::SNOW_ERROR_AGGREGATE_ENGINE for the scene; ::SNOW_ERROR_TOO_LARGE
 *         for obstacles in whose box, cluster included, there are more than 2^28
 *         sites, or a scene that no address space holds;
 *         ::SNOW_ERROR_NO_MEMORY, ::SNOW_ERROR_MEMORY_LIMIT,
 *         ::SNOW_ERROR_THREADS, ::SNOW_ERROR_ISA. Cost: that of the seeds and,
 *         with ::SNOW_AGGREGATE_ENGINE_JUMPS, some milliseconds for tables; with
 *         obstacles, of the box round them; of all cells of a shore.
 */
SNOW_API snow_status snow_aggregate_create(const snow_aggregate_params *params, const snow_options *options,
                                           snow_grid **grid);

/**
 * @brief Reads the scene of a grid: as it was given, without the lists of seeds and obstacles.
 *
 * Seeds are the first of the particles; snow_aggregate_obstacles() tells the
 * obstacles.
 *
 * @param grid a grid of this model.
 * @param params initialised; filled in.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL, ::SNOW_ERROR_STRUCT_SIZE,
 *         ::SNOW_ERROR_STRUCT_TAIL; ::SNOW_ERROR_UNSUPPORTED for another model.
 */
SNOW_API snow_status snow_aggregate_params_of(const snow_grid *grid, snow_aggregate_params *params);

/**
 * @name Particles
 *
 * Particles are numbered in the order in which they joined, from 0; seeds come
 * first. In the shore scene they are the cells that were washed away. In the
 * cluster–cluster scene the numbers have no order, and sites change.
 *
 * snow_aggregate_parents(), snow_aggregate_growth() and snow_aggregate_sample()
 * ask the grid's allocator for memory, and give it back before they return.
 * @{
 */

/**
 * @brief How many particles there are, seeds included.
 * @param grid a grid of this model.
 * @param count receives the number.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_UNSUPPORTED for another
 *         model. Cost: constant.
 */
SNOW_API snow_status snow_aggregate_particles(const snow_grid *grid, uint64_t *count);

/**
 * @brief How many walkers have ended: on a site, or, in scenes where they can leave, outside.
 * @param grid a grid of this model.
 * @param count receives the number; in the cluster–cluster scene the moves that were tried.
 * @return as snow_aggregate_particles().
 */
SNOW_API snow_status snow_aggregate_walkers(const snow_grid *grid, uint64_t *count);

/**
 * @brief The sites of particles.
 * @param grid a grid of this model.
 * @param first the number of the first particle that is wanted.
 * @param sites receives them.
 * @param count how many are wanted.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_RANGE when there are fewer
 *         particles; ::SNOW_ERROR_UNSUPPORTED for another model and off the
 *         lattice. Cost: proportional to count.
 */
SNOW_API snow_status snow_aggregate_sites(const snow_grid *grid, uint64_t first, snow_site *sites, size_t count);

/**
 * @brief The sites of the obstacles, in the order in which they were given.
 * @param grid a grid of this model.
 * @param sites receives them; NULL: only the count is wanted.
 * @param capacity how many the array holds.
 * @param count receives how many there are; may be NULL unless sites is.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_BUFFER when capacity is
 *         too small; ::SNOW_ERROR_UNSUPPORTED for another model. Cost:
 *         proportional to their number.
 */
SNOW_API snow_status snow_aggregate_obstacles(const snow_grid *grid, snow_site *sites, size_t capacity,
                                              size_t *count);

/**
 * @brief Where particles are.
 *
 * In the cluster–cluster scene the particles of a cluster are given as they hang
 * together, across the sides of the box.
 *
 * @param grid a grid of this model.
 * @param first the number of the first particle that is wanted.
 * @param points receives their centres.
 * @param count how many are wanted.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_RANGE when there are fewer
 *         particles; ::SNOW_ERROR_UNSUPPORTED for another model. Cost:
 *         proportional to count.
 */
SNOW_API snow_status snow_aggregate_points(const snow_grid *grid, uint64_t first, snow_point *points, size_t count);

/**
 * @brief On which particle each particle sits.
 *
 * On a lattice: the oldest of its neighbours that were there before it (in the
 * scenes of the eight neighbours, of those); off the lattice: the one that it
 * touched.
 *
 * @param grid a grid of this model.
 * @param parents receives a number for each particle: −1 for seeds and for what
 *        sits on a floor, cathode or wall; NULL: only the count is wanted.
 * @param capacity how many numbers the array holds.
 * @param count receives the number of particles; may be NULL unless parents is.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_BUFFER when capacity is
 *         too small; ::SNOW_ERROR_UNSUPPORTED for another model and in the shore
 *         and cluster–cluster scenes; ::SNOW_ERROR_NO_MEMORY,
 *         ::SNOW_ERROR_MEMORY_LIMIT. Cost: proportional to the number of
 *         particles; without record_order a table of at most 16 bytes a particle
 *         is made and given back.
 */
SNOW_API snow_status snow_aggregate_parents(const snow_grid *grid, int64_t *parents, size_t capacity, size_t *count);

/**
 * @brief The particle that sits on a site.
 * @param grid a grid of this model, with record_order.
 * @param site any site.
 * @param order receives the particle's number, −1 where there is none.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_UNSUPPORTED for another
 *         model, off the lattice and in the cluster–cluster scene;
 *         ::SNOW_ERROR_NOT_RECORDED without record_order. Cost: constant.
 */
SNOW_API snow_status snow_aggregate_order_at(const snow_grid *grid, snow_site site, int64_t *order);

/**
 * @brief The smallest box that holds every particle.
 * @param grid a grid of this model.
 * @param low receives the least coordinates.
 * @param high receives the greatest.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_UNSUPPORTED for another
 *         model; ::SNOW_ERROR_RANGE when there is no particle. Cost: one pass
 *         over the particles.
 */
SNOW_API snow_status snow_aggregate_bounds(const snow_grid *grid, snow_point *low, snow_point *high);

/** @} */

/**
 * @name Measures
 * @{
 */

/**
 * @brief Radius of gyration of the first N particles, for each N of a list.
 *
 * The root of the mean squared distance from the centre of mass, in lattice
 * spacings.
 *
 * @param grid a grid of this model.
 * @param masses the N, ascending, each from 1 to the number of particles.
 * @param radii receives a radius for each.
 * @param count how many.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_RANGE when the masses do
 *         not ascend or pass the number of particles; ::SNOW_ERROR_UNSUPPORTED
 *         for another model and the cluster–cluster scene. Cost: one pass over
 *         the first particles, as many as the last mass.
 */
SNOW_API snow_status snow_aggregate_gyration(const snow_grid *grid, const uint64_t *masses, double *radii, size_t count);

/**
 * @brief N(R): how many particles lie within a distance of the origin, for each R of a list.
 * @param grid a grid of this model.
 * @param radii the R, ascending, 0 or more; the distance itself counts as within.
 * @param masses receives a number for each.
 * @param count how many.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_NOT_FINITE;
 *         ::SNOW_ERROR_RANGE when the radii do not ascend or are negative;
 *         ::SNOW_ERROR_UNSUPPORTED for another model. Cost: one pass over the
 *         particles.
 */
SNOW_API snow_status snow_aggregate_mass(const snow_grid *grid, const double *radii, uint64_t *masses, size_t count);

/**
 * @brief The height of the deposit in each column.
 *
 * Line (also on the hexagonal lattice, where column x of row y is the site
 * (x − ⌊y/2⌋, y)), electrolysis: 1 + the row of the highest filled site, 0 where
 * there is none. Shore: 1 + the row of the highest land. On the cubic lattice
 * the columns stand in row order: column (x, y) at index y · width + x.
 *
 * @param grid a grid of this model.
 * @param heights receives a number for each column; NULL: only the count is
 *        wanted.
 * @param capacity how many numbers the array holds.
 * @param count receives the number of columns; may be NULL unless heights is.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_BUFFER when capacity is
 *         too small; ::SNOW_ERROR_UNSUPPORTED for another model and for scenes
 *         without a floor. Cost: proportional to the columns and the particles.
 */
SNOW_API snow_status snow_aggregate_profile(const snow_grid *grid, int32_t *heights, size_t capacity, size_t *count);

/** @brief One cluster of the cluster–cluster scene. */
typedef struct snow_aggregate_cluster {
    uint64_t mass;   /**< Particles. */
    double gyration; /**< Radius of gyration. */
} snow_aggregate_cluster;

/**
 * @brief The clusters that there are.
 * @param grid a grid of the cluster–cluster scene.
 * @param clusters receives them, in no order; NULL: only the count is wanted.
 * @param capacity how many the array holds.
 * @param count receives how many there are; may be NULL unless clusters is.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_BUFFER when capacity is
 *         too small; ::SNOW_ERROR_UNSUPPORTED for another model or scene. Cost:
 *         proportional to the clusters.
 */
SNOW_API snow_status snow_aggregate_clusters(const snow_grid *grid, snow_aggregate_cluster *clusters, size_t capacity,
                                             size_t *count);

/** @brief The chance that the next walker ends on a site. */
typedef struct snow_aggregate_chance {
    snow_site site;     /**< The site. */
    double probability; /**< The chance: the growth probability, for p = 1 the harmonic measure. */
    double error;       /**< One standard error; of an exact chance: a bound of the rounding error. */
} snow_aggregate_chance;

/**
 * @brief Growth probabilities, solved exactly by the lattice's potential kernel.
 *
 * For both contact rules, p = 1, in the Witten–Sander scene without obstacles.
 *
 * @param grid a grid of this model.
 * @param chances receives every site that can be reached, by y, then x (in
 *        space by z first); NULL: only the count is wanted.
 * @param capacity how many the array holds.
 * @param count receives how many there are; may be NULL unless chances is.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL; ::SNOW_ERROR_BUFFER when capacity is
 *         too small; ::SNOW_ERROR_TOO_LARGE for more than 4,096 unknowns, or a
 *         box round the cluster of more than 2^24 sites;
 *         ::SNOW_ERROR_UNSUPPORTED for other scenes; ::SNOW_ERROR_NO_MEMORY,
 *         ::SNOW_ERROR_MEMORY_LIMIT. Cost: the third power of the perimeter.
 */
SNOW_API snow_status snow_aggregate_growth(const snow_grid *grid, snow_aggregate_chance *chances, size_t capacity,
                                           size_t *count);

/**
 * @brief Growth probabilities, sampled by walks that change nothing.
 *
 * Every scene in which single walkers stick, on a lattice. The grid's engine,
 * contact rule and sticking hold; noise reduction is not looked at.
 *
 * @param grid a grid of this model.
 * @param walks how many, 1 to 2^32 − 1.
 * @param random_seed chooses the walks; streams never meet those of the growth.
 * @param chances receives the sites that were hit, by y, then x (in space by z
 *        first); NULL: only the count is wanted, the walks are taken all the same.
 * @param capacity how many the array holds.
 * @param count receives how many there are; may be NULL unless chances is.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL, ::SNOW_ERROR_RANGE; ::SNOW_ERROR_BUFFER
 *         when capacity is too small; ::SNOW_ERROR_UNSUPPORTED for other scenes;
 *         ::SNOW_ERROR_AGGREGATE_PATH when 2^24 walkers in a row are lost;
 *         ::SNOW_ERROR_FULL; ::SNOW_ERROR_NO_MEMORY,
 *         ::SNOW_ERROR_MEMORY_LIMIT. Cost: that of growing as many particles.
 */
SNOW_API snow_status snow_aggregate_sample(const snow_grid *grid, uint64_t walks, uint64_t random_seed,
                                           snow_aggregate_chance *chances, size_t capacity, size_t *count);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
