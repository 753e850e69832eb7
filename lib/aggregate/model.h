/* A grid of the aggregation model: what its files share. The scenes and their
   rules are in snowgrowth/aggregate.h and doc/aggregate.md. */
#ifndef SNOW_AGGREGATE_MODEL_H
#define SNOW_AGGREGATE_MODEL_H

#include "aggregate/order.h"
#include "aggregate/sites.h"
#include "aggregate/stream.h"
#include "aggregate/table.h"
#include "base/model.h"

#include <snowgrowth/aggregate.h>

extern const snow_model_operations snow_aggregate_operations;

/* Told where a sampling walk has ended; false: none comes after it. */
typedef bool (*aggregate_ends)(void *context, snow_site site);

/* What a scene must be able to do. Functions that may be NULL say so. */
typedef struct aggregate_scene {
    /* Makes the scene's own state; seeds are placed afterwards, obstacles are in the model. */
    snow_status (*create)(snow_grid *grid);
    /* Whether walkers can come to what is there; after the seeds. NULL: they can. */
    snow_status (*check)(const snow_grid *grid);
    /* Makes room for one more particle, wherever it may join. NULL: there always is. */
    snow_status (*prepare)(snow_grid *grid);
    /* Fills a site; after prepare() it does not fail. NULL: particles are not in the list of sites. */
    snow_status (*place)(snow_grid *grid, snow_site site);
    /* One walker against the cluster as it stands: where it ends, or false when
       it is lost. NULL: the scene has its own grow(). */
    bool (*walk)(const snow_grid *grid, snow_stream *stream, snow_site *end);
    /* So many walks that change nothing; what is taken from the heap goes back. NULL: by walk(). */
    snow_status (*sample)(const snow_grid *grid, snow_heap *heap, uint64_t key, uint64_t walks, aggregate_ends ends,
                          void *context);
    /* Takes at most `most` steps, until the crystal meets `stop`; there is room
       in the lists. NULL: walkers one by one. */
    snow_status (*grow)(snow_grid *grid, int64_t most, const snow_stop *stop);
    /* Marks of a site, for fields: filled, within the domain, hardness. NULL: filled is what order or list say. */
    bool (*filled)(const snow_grid *grid, snow_site site);
    bool (*inside)(const snow_grid *grid, snow_site site);
    /* What the scene keeps beyond params, sites and counters. NULL: nothing. */
    void (*save)(const snow_grid *grid, snow_sink *sink);
    snow_status (*load)(snow_grid *grid, snow_source *source);
    /* Particles that are not in the list of sites: how many, and where. NULL: those of the list. */
    uint64_t (*count)(const snow_grid *grid);
    void (*sites)(const snow_grid *grid, uint64_t first, snow_site *sites, size_t count);
    /* Where particles are, where that is not their sites. NULL: on their sites. */
    void (*points)(const snow_grid *grid, uint64_t first, snow_point *points, size_t count);
    /* As that of snow_model_operations. */
    void (*survey)(const snow_grid *grid, snow_census *census);
    /* On which particle one sits, −1: on none. NULL: on the oldest neighbour. */
    int64_t (*parent)(const snow_grid *grid, uint64_t number);
    void (*destroy)(snow_grid *grid);
} aggregate_scene;

extern const aggregate_scene snow_aggregate_jumps;
extern const aggregate_scene snow_aggregate_walker;
extern const aggregate_scene snow_aggregate_electrolysis;
extern const aggregate_scene snow_aggregate_chimney;
extern const aggregate_scene snow_aggregate_shore;
extern const aggregate_scene snow_aggregate_snowflake;
extern const aggregate_scene snow_aggregate_cluster_cluster;
extern const aggregate_scene snow_aggregate_off_lattice;

typedef struct aggregate {
    snow_aggregate_params params; /* checked; lists cleared after creation */
    const aggregate_scene *scene;
    void *state; /* the scene's own */
    snow_sites sites;     /* the particles, seeds first */
    snow_sites obstacles;
    double obstacle_tip; /* the farthest one's distance from the origin */
    uint64_t seeds;
    snow_order order; /* where it is recorded */
    snow_table hits;  /* walkers that ended on sites that are not filled yet */
    uint64_t walkers; /* that have ended: the number of the next stream */
    snow_site low;    /* of the particles, where there are any */
    snow_site high;
    bool loading;     /* the scene is made for a saved grid */
} aggregate;

static inline aggregate *aggregate_of(const snow_grid *grid)
{
    return grid->state;
}

/* Sites farther out than this are not filled: coordinates and their squares stay in range. */
enum { AGGREGATE_REACH_PLANE = 1 << 26, AGGREGATE_REACH_SPACE = 1 << 19, AGGREGATE_MOST_SEEDS = 1 << 26 };

/* One more particle than this can be numbered. */
#define AGGREGATE_MOST_PARTICLES (UINT64_C(0xFFFFFFFF) - 1)

static inline bool aggregate_is_space(const snow_aggregate_params *params)
{
    return params->lattice == SNOW_AGGREGATE_CUBIC && params->scene != SNOW_AGGREGATE_OFF_LATTICE;
}

static inline int32_t aggregate_reach(const snow_aggregate_params *params)
{
    return aggregate_is_space(params) ? AGGREGATE_REACH_SPACE : AGGREGATE_REACH_PLANE;
}

/* Height of a site above the floor's first row. */
static inline int32_t aggregate_height(const aggregate *model, snow_site site)
{
    return aggregate_is_space(&model->params) ? site.z : site.y;
}

static inline int64_t aggregate_square(const aggregate *model, snow_site site)
{
    int64_t x = site.x;
    int64_t y = site.y;
    int64_t z = site.z;
    int64_t mixed = model->params.lattice == SNOW_AGGREGATE_HEXAGONAL ? x * y : 0;
    return x * x + y * y + z * z + mixed;
}

static inline snow_site aggregate_moved(snow_site site, snow_site by)
{
    return (snow_site){site.x + by.x, site.y + by.y, site.z + by.z};
}

/* lattice.c: the steps from a site, and the point of the plane or of space where it is. */
typedef struct aggregate_neighbours {
    int count;
    snow_site step[8];
} aggregate_neighbours;

extern const aggregate_neighbours snow_aggregate_four;
extern const aggregate_neighbours snow_aggregate_eight;
extern const aggregate_neighbours snow_aggregate_six;
extern const aggregate_neighbours snow_aggregate_six_in_space;

/* The steps of a walker on a lattice. */
const aggregate_neighbours *snow_aggregate_steps(snow_aggregate_lattice lattice);
/* The site one step away, round the box where its sides are joined. */
snow_site snow_aggregate_beside(const snow_aggregate_params *params, snow_site site, snow_site step);
/* The sites that a particle of the scene can sit on. */
const aggregate_neighbours *snow_aggregate_contacts(const snow_aggregate_params *params);
snow_point snow_aggregate_point_of(snow_aggregate_lattice lattice, snow_site site);
/* The site nearest to a point. */
snow_site snow_aggregate_site_of(snow_aggregate_lattice lattice, snow_point point);

/* params.c */
snow_status snow_aggregate_params_check(const snow_aggregate_params *params);
bool snow_aggregate_has_floor(const snow_aggregate_params *params);

/* join.c: a particle joins; there is room. */
void snow_aggregate_join(snow_grid *grid, snow_site site);
/* Room for so many particles more. */
snow_status snow_aggregate_reserve(snow_grid *grid, uint64_t more);
/* Counts a walker that ended on a site; whether the site is to be filled now. There is room for a hit. */
bool snow_aggregate_hit(snow_grid *grid, snow_site site);

/* start.c: obstacles and seeds. */
snow_status snow_aggregate_start(snow_grid *grid, const snow_aggregate_params *params);

/* path.c: AGGREGATE_PATH when obstacles keep walkers from the cluster. */
snow_status snow_aggregate_find_path(snow_grid *grid);

/* create.c */
/* The cells that generic queries walk over follow the particles, or are the box. */
void snow_aggregate_follow(snow_grid *grid);
/* A grid with its seeds; `loading`: for a saved one, whose particles follow. */
snow_status snow_aggregate_build(const snow_aggregate_params *params, const snow_options *options, bool loading,
                                 snow_grid **grid);

/* A scene that walks step by step sends out so many walkers at the most before whoever runs the grid may look at
   the clock: each can take milliseconds, and many can be lost before one stays. */
enum { AGGREGATE_TURN = 64 };

/* advance.c */
/* Whether the crystal is at its end, or meets a condition; stop may be NULL. */
bool snow_aggregate_stops(const snow_grid *grid, const snow_stop *stop);
snow_status snow_aggregate_advance(snow_grid *grid, int64_t most, const snow_stop *stop);

/* fields.c, snapshot.c */
snow_status snow_aggregate_can_read(const snow_grid *grid, snow_field field);
void snow_aggregate_read(const snow_grid *grid, snow_field field, int64_t q, int64_t r, size_t count, double *values);
snow_status snow_aggregate_set(snow_grid *grid, snow_field field, const snow_rect *rect, const double *values);
void snow_aggregate_digest(const snow_grid *grid, snow_digest_state *state);
void snow_aggregate_save(const snow_grid *grid, snow_sink *sink);
snow_status snow_aggregate_load(snow_source *source, const snow_options *options, snow_grid **grid);

/* The clusters of the cluster–cluster scene; returns how many. list may be NULL. */
size_t snow_aggregate_list_clusters(const snow_grid *grid, snow_aggregate_cluster *list);

/* particles.c */
uint64_t snow_aggregate_count(const snow_grid *grid);
void snow_aggregate_list_points(const snow_grid *grid, uint64_t first, snow_point *points, size_t count);

/* The side of the cluster–cluster scene's box. */
int32_t snow_aggregate_box(const snow_grid *grid);

/* The shore's hardness, for fields. */
uint32_t snow_aggregate_hardness(const snow_grid *grid, snow_site site);

#endif
