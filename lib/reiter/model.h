/* A grid of Reiter's model: what its files share. The paper and the decisions
   behind the arithmetic are in snowgrowth/reiter.h and doc/reiter.md. */
#ifndef SNOW_REITER_MODEL_H
#define SNOW_REITER_MODEL_H

#include "base/model.h"
#include "base/symmetry.h"

#include <snowgrowth/reiter.h>

#include <math.h>

extern const snow_model_operations snow_reiter_operations;

/* A cell as the engines give and take it. */
typedef struct reiter_cell {
    double value;     /* its vapour; where receptive, what it had and collected, without additions */
    double low;       /* what QUAD keeps beyond the double */
    uint32_t additions; /* steps since it became receptive, or since they were last merged into value */
    bool frozen;
    bool receptive;
} reiter_cell;

/* What computes the steps. An engine that folds keeps only the fundamental part
   of the plane under the scene's group, and cells are then put there only. */
typedef struct reiter_engine {
    bool folds;
    snow_status (*create)(snow_grid *grid);
    /* One step of the cells; tells newly frozen cells to snow_reiter_freeze().
       On failure nothing has changed. */
    snow_status (*step)(snow_grid *grid);
    /* How many steps, up to `most`, the engine would rather take together from
       here, 0: none; and takes them. NULL: it never does. */
    int64_t (*pass_steps)(const snow_grid *grid, int64_t most);
    void (*pass)(snow_grid *grid, int64_t steps);
    /* The interior cells that it keeps. */
    const snow_domain *(*part)(const snow_grid *grid);
    /* How the engine numbers its cells, for arrays beside it: 0 to numbers − 1.
       Images of a cell share its number. */
    size_t (*numbers)(const snow_grid *grid);
    size_t (*number)(const snow_grid *grid, int32_t q, int32_t r);
    /* Any interior or fixed cell. */
    reiter_cell (*get)(const snow_grid *grid, int32_t q, int32_t r);
    /* get then gives what was put; settle must follow before the next step. */
    void (*put)(snow_grid *grid, int32_t q, int32_t r, const reiter_cell *cell);
    /* Finds the receptive cells anew and rounds vapour to the quantum. */
    void (*settle)(snow_grid *grid);
    void (*destroy)(snow_grid *grid);
} reiter_engine;

extern const reiter_engine snow_reiter_rows;
extern const reiter_engine snow_reiter_reference;
extern const reiter_engine snow_reiter_quad;

typedef struct reiter {
    snow_reiter_params params; /* checked; pointers cleared after creation */
    snow_domain hull;          /* the interior and the fixed cells round it */
    double bound;              /* vapour beyond ±bound is unstable; a power of two */
    snow_group group;          /* the symmetries that the scene has and the engine folds by */
    double *addition_at;       /* as the engine numbers; NULL: params.addition everywhere */
    uint32_t *freeze_step;     /* as the engine numbers; NULL: not recorded */
    const reiter_engine *engine;
    void *cells; /* the engine's own */
} reiter;

#define REITER_NEVER UINT32_MAX

/* A step count as freeze_step holds it. */
static inline uint32_t reiter_freeze_stamp(int64_t step)
{
    return step < REITER_NEVER ? (uint32_t)step : REITER_NEVER - 1;
}

/* Additions are merged into the values whenever the step count is a multiple
   of this, so that 32 bits are enough for their number. */
#define REITER_MERGE_STEPS (INT64_C(1) << 31)

/* A cell that would need more steps than this to freeze counts as one that
   never will: a starved pocket can lose a quantum a step for ever. */
#define REITER_STILL_STEPS 0x1p40

static inline reiter *reiter_of(const snow_grid *grid)
{
    return grid->state;
}

/* Of any precision. */
static inline bool reiter_is_vapour(double value)
{
    return value >= 0 && value < 1 - SNOW_REITER_SLACK;
}

/* Whether values beyond [0, 1) can arise where no ice is near: only then are they looked for. */
static inline bool reiter_overshoots(const reiter *model)
{
    return model->params.diffusion > 2;
}

static inline bool reiter_is_single(const reiter *model)
{
    return model->params.precision == SNOW_REITER_PRECISION_SINGLE;
}

/* Every sum of a step is less than 2^53 of these, in single precision 2^31: up
   to 6 times the bound where vapour has one sign, 12 times where it has both. */
static inline double reiter_quantum(const reiter *model)
{
    double finest = reiter_is_single(model) ? 0x1p-28 : 0x1p-50;
    return model->bound * (reiter_overshoots(model) ? 2 * finest : finest);
}

/* α/12 in single precision. Two roundings follow, so that α = 2 needs some room
   below 1/6 for the vapour to stay between its neighbours (doc/reiter.md). */
static inline float reiter_single_weight(const reiter *model)
{
    const float greatest = 0x1.55555p-3f;
    float weight = (float)(model->params.diffusion / 12);
    return weight > greatest && !reiter_overshoots(model) ? greatest : weight;
}

/* From here on u is ice. A single vapour differs from its decimal number by up
   to half a quantum, more than the slack: ties are kept within two quanta. */
static inline double reiter_threshold(const reiter *model)
{
    double slack = reiter_is_single(model) ? 2 * reiter_quantum(model) : 0;
    return 1 - (slack > SNOW_REITER_SLACK ? slack : SNOW_REITER_SLACK);
}

/* Adding and subtracting this rounds a smaller number to the quantum. */
static inline double reiter_rounder(const reiter *model)
{
    return reiter_quantum(model) * 0x1.8p52;
}

static inline double reiter_round(double value, double rounder)
{
    return (value + rounder) - rounder;
}

/* A vapour as the grid holds it: a multiple of the quantum that is not ice. */
static inline double reiter_settled(const reiter *model, double value)
{
    double quantum = reiter_quantum(model);
    double rounded = reiter_round(value, reiter_rounder(model));
    double threshold = reiter_threshold(model);
    return rounded < threshold ? rounded : (ceil(threshold / quantum) - 1) * quantum;
}

/* β as the vapour holds it, so that no edge shows between the fixed cells and what is beyond. */
static inline double reiter_background(const reiter *model)
{
    bool exact = model->engine == &snow_reiter_quad;
    return exact ? model->params.background : reiter_settled(model, model->params.background);
}

static inline double reiter_addition(const reiter *model, size_t number)
{
    return model->addition_at != NULL ? model->addition_at[number] : model->params.addition;
}

/* Reiter's u of a cell that the engine gave. */
static inline double reiter_value(const reiter_cell *cell, double addition)
{
    return cell->low + cell->value + addition * cell->additions;
}

/* params.c */
snow_status snow_reiter_params_check(const snow_reiter_params *params);
snow_status snow_reiter_conditions_check(double background, double addition, double diffusion, bool allow_unstable);

/* scene.c: fills the engine with the start of the scene. */
snow_status snow_reiter_scene(snow_grid *grid, const snow_reiter_params *params);

/* The interior cells that the engine keeps. */
static inline snow_walk reiter_walk_part(const snow_grid *grid)
{
    return snow_walk_over(reiter_of(grid)->engine->part(grid), NULL);
}

/* The fixed cells that the engine keeps: one for all where it folds, for they are alike. */
static inline snow_walk reiter_walk_fixed(const snow_grid *grid)
{
    snow_walk walk = snow_walk_over(&reiter_of(grid)->hull, &grid->domain);
    if (reiter_of(grid)->group != SNOW_GROUP_TRIVIAL)
        walk.most = 1;
    return walk;
}

/* create.c */
/* How many interior cells a scene has, without building it. */
uint64_t snow_reiter_cells(const snow_reiter_params *params);
/* A grid with its domain and hull. */
snow_status snow_reiter_build(const snow_reiter_params *params, const snow_options *options, snow_grid **grid);
/* Gives it its engine and arrays, every cell empty; folds by the group where the engine can. */
snow_status snow_reiter_equip(snow_grid *grid, snow_group group);

/* fold.c */
/* The symmetries that a set of frozen cells has; sorts the cells. */
snow_group snow_reiter_group_of_seeds(snow_cell *seeds, size_t count);
/* From here on every cell is kept by itself, and, if wanted, has its own
   addition. On failure nothing has changed. */
snow_status snow_reiter_unfold(snow_grid *grid, bool own_additions);

/* cells.c */
void snow_reiter_freeze(snow_grid *grid, int32_t q, int32_t r);
/* Whether so many steps can bring ice near the rim for the first time. */
bool snow_reiter_may_reach_rim(const snow_grid *grid, int64_t steps);
/* Counts the frozen cells anew. */
void snow_reiter_recount(snow_grid *grid);
/* Chooses bound, and with it the quantum, from the greatest vapour; before settle. */
void snow_reiter_choose_bound(snow_grid *grid);
/* Whether every cell that is called receptive is, and no other; before settle. */
bool snow_reiter_receptive_are_sound(const snow_grid *grid);
/* Merges the additions of receptive cells into their values, exact to one rounding; before settle. */
void snow_reiter_merge_additions(snow_grid *grid);

/* fields.c, snapshot.c */
snow_status snow_reiter_can_read(const snow_grid *grid, snow_field field);
void snow_reiter_read(const snow_grid *grid, snow_field field, int64_t q, int64_t r, size_t count, double *values);
snow_status snow_reiter_set(snow_grid *grid, snow_field field, const snow_rect *rect, const double *values);
void snow_reiter_save(const snow_grid *grid, snow_sink *sink);
snow_status snow_reiter_load(snow_source *source, const snow_options *options, snow_grid **grid);

#endif
