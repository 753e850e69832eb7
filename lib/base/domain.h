/* A set of cells without holes: for each row r one run first <= q < end. It is
   built once, with a table of the runs and its cells numbered without gaps row
   by row; or it is a hexagon that follows a crystal, without a table. */
#ifndef SNOW_BASE_DOMAIN_H
#define SNOW_BASE_DOMAIN_H

#include "base/heap.h"
#include "base/hexagon.h"

#include <snowgrowth/grid.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct snow_run_of_cells {
    int32_t first;
    int32_t end;
    size_t number; /* of the cell `first` */
} snow_run_of_cells;

typedef struct snow_domain {
    int32_t top;  /* the first row */
    int32_t rows; /* at least 1 */
    uint64_t cells;
    snow_rect bounds;
    snow_run_of_cells *run; /* run[r - top]; NULL: a hexagon */
    snow_hexagon hexagon;
    bool too_large; /* the hexagon reaches too far for 32 bits; the rest is not known */
} snow_domain;

static inline snow_run_of_cells snow_domain_hexagon_row(const snow_hexagon *hexagon, int64_t r)
{
    int64_t first = hexagon->least_s - r;
    int64_t last = hexagon->greatest_s - r;
    first = first > hexagon->least_q ? first : hexagon->least_q;
    last = last < hexagon->greatest_q ? last : hexagon->greatest_q;
    return (snow_run_of_cells){(int32_t)first, (int32_t)(last + 1), 0};
}

/* The domain becomes a hexagon, which is not empty. */
void snow_domain_fill(snow_domain *domain, const snow_hexagon *hexagon);

/* The domain becomes the smallest hexagon that holds the cells of another one
   and their neighbours; those of the origin, where that is empty. */
void snow_domain_follow(snow_domain *domain, const snow_hexagon *crystal);

/* Whether each cell lies less than 2^30 from the axes; and the smallest rectangle that holds all of them then. */
bool snow_domain_reaches(const snow_hexagon *hexagon);
snow_rect snow_domain_rect(const snow_hexagon *hexagon);

/* Each allocates the runs; on failure nothing is left allocated. */
snow_status snow_domain_disc(snow_domain *domain, snow_heap *heap, int32_t radius);
snow_status snow_domain_hexagon(snow_domain *domain, snow_heap *heap, int32_t radius);
snow_status snow_domain_rectangle(snow_domain *domain, snow_heap *heap, int32_t width, int32_t height);
/* The interior and the cells next to it, each row one run, two rows more. */
snow_status snow_domain_hull(snow_domain *hull, snow_heap *heap, const snow_domain *interior);
void snow_domain_end(snow_domain *domain, snow_heap *heap);

/* For building one's own: first the rows, then, when their runs are known, the rest. */
snow_status snow_domain_start(snow_domain *domain, snow_heap *heap, int32_t top, int32_t rows);
void snow_domain_number_cells(snow_domain *domain);

/* How many interior cells each would have, without building it. */
uint64_t snow_domain_disc_cells(int32_t radius);
uint64_t snow_domain_hexagon_cells(int32_t radius);

static inline snow_run_of_cells snow_domain_row(const snow_domain *domain, int64_t r)
{
    int64_t row = r - domain->top;
    if (row < 0 || row >= domain->rows)
        return (snow_run_of_cells){0, 0, 0};
    return domain->run != NULL ? domain->run[row] : snow_domain_hexagon_row(&domain->hexagon, r);
}

static inline bool snow_domain_has(const snow_domain *domain, int64_t q, int64_t r)
{
    snow_run_of_cells run = snow_domain_row(domain, r);
    return q >= run.first && q < run.end;
}

/* Cell after cell of a domain, less those of another; row by row.

       for (snow_walk walk = snow_walk_over(domain, NULL); snow_walk_next(&walk);)
           use walk.cell */
typedef struct snow_walk {
    const snow_domain *domain;
    const snow_domain *without; /* may be NULL */
    int32_t row;
    int32_t q;
    size_t most; /* cells that are left to be visited, at most */
    snow_cell cell;
} snow_walk;

static inline snow_walk snow_walk_over(const snow_domain *domain, const snow_domain *without)
{
    return (snow_walk){.domain = domain, .without = without, .q = domain->run[0].first, .most = SIZE_MAX};
}

static inline bool snow_walk_next(snow_walk *walk)
{
    const snow_domain *domain = walk->domain;
    while (walk->row < domain->rows && walk->most > 0) {
        int32_t r = domain->top + walk->row;
        if (walk->q >= domain->run[walk->row].end) {
            if (++walk->row < domain->rows)
                walk->q = domain->run[walk->row].first;
        } else if (walk->without != NULL && snow_domain_has(walk->without, walk->q, r)) {
            walk->q = snow_domain_row(walk->without, r).end;
        } else {
            walk->cell = (snow_cell){walk->q++, r};
            walk->most--;
            return true;
        }
    }
    return false;
}

/* The number of a cell of the domain. */
static inline size_t snow_domain_number(const snow_domain *domain, int32_t q, int32_t r)
{
    const snow_run_of_cells *run = &domain->run[r - domain->top];
    return run->number + (size_t)(q - run->first);
}

#endif
