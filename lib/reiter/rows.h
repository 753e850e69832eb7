/* The ROWS engine: vapour in two dense arrays that take turns, everything
   about ice beside them. */
#ifndef SNOW_REITER_ROWS_H
#define SNOW_REITER_ROWS_H

#include "reiter/kernel.h"
#include "reiter/model.h"

typedef enum cell_state {
    CELL_VAPOUR = 0,
    CELL_FRONT = 1, /* receptive, not frozen */
    CELL_FROZEN = 2,
    CELL_FIXED = 3
} cell_state;

/* Rows that one task computes. Its cells have as much room in `listed` as
   there are of them: the front from `first` up, what has just frozen from
   `end` down. The two never meet, so that a step needs no memory. */
typedef struct row_block {
    int32_t first_row; /* of the interior */
    int32_t end_row;
    size_t first;
    size_t end;
    size_t front;   /* listed cells of the front, ice at the rim included */
    size_t fresh;   /* cells that froze in this step */
    bool collected; /* a cell of the front collected vapour in this step */
    bool unstable;   /* a cell is beyond the bound */
    bool overshoots; /* a cell is, perhaps, ice without ice beside it */
} row_block;

/* Cells are numbered as in the hull. */
typedef struct rows {
    const reiter_kernel *kernel;
    double *vapour[2]; /* 0 where receptive */
    int now;           /* which of the two holds the present step */
    double *collected; /* of receptive cells: what they had and collected, without additions */
    uint32_t *since;   /* of receptive cells: the step since which they gain, modulo 2^32 */
    unsigned char *state;
    uint32_t *listed;
    row_block *block;
    size_t blocks;
    int64_t *offset; /* of row r of the hull: number of (q, r) is offset + q */
} rows;

static inline rows *rows_of(const snow_grid *grid)
{
    return reiter_of(grid)->cells;
}

static inline size_t rows_number(const snow_grid *grid, int32_t q, int32_t r)
{
    const reiter *model = reiter_of(grid);
    return (size_t)(rows_of(grid)->offset[r - model->hull.top] + q);
}

/* Whether a neighbour of an interior cell is in a state. */
static inline bool rows_is_by(const snow_grid *grid, int32_t q, int32_t r, cell_state state)
{
    const unsigned char *all = rows_of(grid)->state;
    const unsigned char *row = all + rows_number(grid, q, r);
    const unsigned char *above = all + rows_number(grid, q, r - 1);
    const unsigned char *below = all + rows_number(grid, q, r + 1);
    return row[-1] == state || row[1] == state || above[0] == state || above[1] == state || below[-1] == state ||
           below[0] == state;
}

/* rows_front.c */

/* Gives the front cells of a block what has diffused into them, and lists
   those that freeze. */
void snow_rows_collect(const snow_grid *grid, row_block *block, double *next);
/* Lists the cells of a block that freeze although no ice is next to them. */
void snow_rows_overshoot(const snow_grid *grid, row_block *block, const double *next);
/* Turns the listed cells into ice and their neighbours into the front. */
bool snow_rows_freeze(snow_grid *grid, double *next);
/* Whether a cell of the front has an addition that will freeze it. */
bool snow_rows_front_gains(const snow_grid *grid);
/* Lists the front of every block anew. */
void snow_rows_list_front(snow_grid *grid);

#endif
