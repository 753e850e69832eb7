/* A walker from infinity first meets a set of sites with chances h that solve

       sum over y of K(x - y) h(y) = V for all x of the set,   sum of h = 1:

   in space K is Green's function, in the plane a constant less the potential
   kernel. Arrival: the set is all sites next to the cluster. Entry: it is the
   cluster itself; with u = V - sum of K h, the chance that a walker steps from
   the site s onto the cluster is u(s) times the share of its steps that do. */
#include "aggregate/harmonic.h"

#include "aggregate/cells.h"
#include "aggregate/model.h"
#include "aggregate/potential.h"
#include "aggregate/spd.h"

#include <math.h>

enum { MOST_UNKNOWNS = 4096, MOST_CELLS = 1 << 24 };

/* Marks beside those of cells.h. */
enum { OPEN = 16, MET = 32 }; /* walkers come here; they end here */

typedef struct harmonic {
    snow_heap *heap;
    const aggregate_neighbours *steps;
    bool space;
    bool arrival;
    snow_cells cells;
    snow_site *met; /* the unknowns */
    size_t count;
    snow_potential potential;
    double highest;  /* in the plane the constant of K, else 0 */
    double *matrix;  /* upper triangle: K; lower one: its factor */
    double *chance;  /* h */
    double level;    /* V */
    double greatest; /* bounds of the errors of u and h */
    double bound;
} harmonic;

/* A box with the cluster and two free sites round it: there walkers go about freely. */
static snow_status cover(harmonic *self, const snow_site *sites, size_t count)
{
    enum { RIM = 2 };
    snow_site low = sites[0];
    snow_site high = sites[0];
    for (size_t i = 1; i < count; i++) {
        low = snow_site_least(low, sites[i]);
        high = snow_site_greatest(high, sites[i]);
    }
    int32_t deep = self->space ? RIM : 0;
    low = (snow_site){low.x - RIM, low.y - RIM, low.z - deep};
    high = (snow_site){high.x + RIM, high.y + RIM, high.z + deep};
    uint64_t across = ((uint64_t)(high.x - low.x) + 1) * ((uint64_t)(high.y - low.y) + 1);
    if (across > MOST_CELLS || across * ((uint64_t)(high.z - low.z) + 1) > MOST_CELLS)
        return SNOW_ERROR_TOO_LARGE;
    return snow_cells_cover(&self->cells, self->heap, low, high);
}

static void mark_cluster(harmonic *self, const snow_site *sites, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        *snow_cells_at(&self->cells, sites[i]) |= SNOW_CELL_FILLED;
        for (int k = 0; k < self->steps->count; k++)
            snow_cells_mark(&self->cells, aggregate_moved(sites[i], self->steps->step[k]), SNOW_CELL_NEAR);
    }
}

static size_t volume_of(const snow_cells *cells)
{
    return (size_t)cells->extent.x * (size_t)cells->extent.y * (size_t)cells->extent.z;
}

/* Follows walkers in from a corner: where they go, and what they meet. */
static snow_status flood(harmonic *self)
{
    const snow_cells *cells = &self->cells;
    const uint8_t met = self->arrival ? SNOW_CELL_FILLED | SNOW_CELL_NEAR : SNOW_CELL_FILLED;
    uint64_t *front = snow_heap_get_raw(self->heap, volume_of(cells), sizeof *front);
    if (front == NULL)
        return self->heap->refusal;
    size_t waiting = 1;
    front[0] = snow_site_pack(self->space, cells->low);
    *snow_cells_at(cells, cells->low) |= OPEN;
    while (waiting > 0) {
        snow_site site = snow_site_unpack(self->space, front[--waiting]);
        for (int k = 0; k < self->steps->count; k++) {
            snow_site next = aggregate_moved(site, self->steps->step[k]);
            if (!snow_cells_has(cells, next) || (*snow_cells_at(cells, next) & (OPEN | MET)))
                continue;
            bool ends = (*snow_cells_at(cells, next) & met) != 0;
            *snow_cells_at(cells, next) |= ends ? MET : OPEN;
            if (!ends)
                front[waiting++] = snow_site_pack(self->space, next);
        }
    }
    snow_heap_put(self->heap, front);
    return SNOW_OK;
}

static snow_site site_at(const snow_cells *cells, size_t index)
{
    size_t width = (size_t)cells->extent.x;
    size_t height = (size_t)cells->extent.y;
    return (snow_site){cells->low.x + (int32_t)(index % width), cells->low.y + (int32_t)(index / width % height),
                       cells->low.z + (int32_t)(index / width / height)};
}

/* Whether a walker can end on a cell of the box. */
static bool is_end(const harmonic *self, size_t index)
{
    const uint8_t entry = OPEN | SNOW_CELL_NEAR;
    uint8_t mark = self->cells.mark[index];
    return self->arrival ? (mark & MET) != 0 : (mark & entry) == entry;
}

static snow_status list_unknowns(harmonic *self)
{
    const snow_cells *cells = &self->cells;
    size_t volume = volume_of(cells);
    for (size_t i = 0; i < volume; i++)
        self->count += (cells->mark[i] & MET) != 0;
    if (self->count > MOST_UNKNOWNS)
        return SNOW_ERROR_TOO_LARGE;
    self->met = snow_heap_get_raw(self->heap, self->count, sizeof *self->met);
    if (self->met == NULL)
        return self->heap->refusal;
    size_t listed = 0;
    for (size_t i = 0; i < volume; i++)
        if (cells->mark[i] & MET)
            self->met[listed++] = site_at(cells, i);
    return SNOW_OK;
}

static double kernel(const harmonic *self, snow_site a, snow_site b)
{
    double value = snow_potential_at(&self->potential, a.x - b.x, a.y - b.y, a.z - b.z);
    return self->space ? value : self->highest - value;
}

/* In the plane any constant above all values of the kernel makes the matrix positive definite. */
static snow_status start_kernel(harmonic *self, snow_aggregate_lattice lattice)
{
    snow_site extent = self->cells.extent;
    snow_status status = snow_potential_start(&self->potential, self->heap, lattice,
                                              (int64_t)extent.x + extent.y + extent.z);
    if (status == SNOW_OK && !self->space)
        self->highest = 1 + snow_potential_at(&self->potential, extent.x, extent.y, 0);
    return status;
}

/* Solves K w = 1; then h = V w, V = 1/sum of w. */
static void solve_equations(harmonic *self)
{
    size_t count = self->count;
    for (size_t i = 0; i < count; i++)
        for (size_t j = i; j < count; j++)
            self->matrix[i * count + j] = kernel(self, self->met[i], self->met[j]);
    snow_spd_factor(self->matrix, count);
    for (size_t i = 0; i < count; i++)
        self->chance[i] = 1;
    snow_spd_solve(self->matrix, count, self->chance);
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += self->chance[i];
    self->level = 1 / sum;
    for (size_t i = 0; i < count; i++)
        self->chance[i] *= self->level;
}

/* u at a site: V less the sum of K h, added up in parts, which keeps the error small. */
static double excess_at(const harmonic *self, snow_site site)
{
    enum { PART = 64 };
    double excess = self->level;
    for (size_t first = 0; first < self->count; first += PART) {
        double sum = 0;
        for (size_t i = first; i < self->count && i < first + PART; i++)
            sum += kernel(self, site, self->met[i]) * self->chance[i];
        excess -= sum;
    }
    return excess;
}

/* What the chances leave of the equations, the error of the kernel itself and of these sums included. On
   sets of sum 0 the kernel's eigenvalues are 1/2 at least, for those of the walk less 1 are between -2 and 0:
   so the error of h is at most twice the root of the sum of squares. Outside the set that of u is at most the
   greatest residual (maximum principle). */
static void bound_errors(harmonic *self)
{
    double unit = 0x1p-52 * (64 + (double)self->count / 64) * (self->highest + 2);
    double squares = 0;
    for (size_t i = 0; i < self->count; i++) {
        double left = fabs(excess_at(self, self->met[i])) + snow_potential_error + unit;
        self->greatest = fmax(self->greatest, left);
        squares += left * left;
    }
    self->bound = 2 * sqrt(squares);
}

static int filled_neighbours(const harmonic *self, snow_site site)
{
    int filled = 0;
    for (int k = 0; k < self->steps->count; k++) {
        snow_site next = aggregate_moved(site, self->steps->step[k]);
        filled += (snow_cells_get(&self->cells, next) & SNOW_CELL_FILLED) != 0;
    }
    return filled;
}

static snow_aggregate_chance entry_at(const harmonic *self, snow_site site)
{
    double share = (double)filled_neighbours(self, site) / self->steps->count;
    return (snow_aggregate_chance){site, share * excess_at(self, site), share * 2 * self->greatest};
}

/* By z, y, x: the order of the cells. */
static snow_status list_chances(const harmonic *self, snow_aggregate_chance **chances, size_t *chance_count)
{
    size_t volume = volume_of(&self->cells);
    size_t count = 0;
    for (size_t i = 0; i < volume; i++)
        count += is_end(self, i);
    snow_aggregate_chance *list = snow_heap_get_raw(self->heap, count, sizeof *list);
    if (list == NULL)
        return self->heap->refusal;
    size_t listed = 0;
    for (size_t i = 0; i < volume; i++)
        if (is_end(self, i)) {
            snow_site site = site_at(&self->cells, i);
            list[listed] = self->arrival ? (snow_aggregate_chance){site, self->chance[listed], self->bound}
                                         : entry_at(self, site);
            listed++;
        }
    *chances = list;
    *chance_count = count;
    return SNOW_OK;
}

static snow_status solve(harmonic *self, snow_aggregate_lattice lattice)
{
    snow_status status = list_unknowns(self);
    if (status == SNOW_OK)
        status = start_kernel(self, lattice);
    if (status != SNOW_OK)
        return status;
    self->matrix = snow_heap_get_raw(self->heap, self->count * self->count, sizeof *self->matrix);
    if (self->matrix != NULL)
        self->chance = snow_heap_get_raw(self->heap, self->count, sizeof *self->chance);
    if (self->matrix == NULL || self->chance == NULL)
        return self->heap->refusal;
    solve_equations(self);
    bound_errors(self);
    return SNOW_OK;
}

snow_status snow_harmonic_solve(snow_heap *heap, snow_aggregate_lattice lattice, snow_aggregate_contact contact,
                                const snow_site *sites, size_t count, snow_aggregate_chance **chances,
                                size_t *chance_count)
{
    harmonic self = {
        .heap = heap,
        .steps = snow_aggregate_steps(lattice),
        .space = lattice == SNOW_AGGREGATE_CUBIC,
        .arrival = contact == SNOW_AGGREGATE_ARRIVAL,
    };
    snow_status status = cover(&self, sites, count);
    if (status == SNOW_OK) {
        mark_cluster(&self, sites, count);
        status = flood(&self);
    }
    if (status == SNOW_OK)
        status = solve(&self, lattice);
    if (status == SNOW_OK)
        status = list_chances(&self, chances, chance_count);
    snow_heap_put(heap, self.chance);
    snow_heap_put(heap, self.matrix);
    snow_potential_end(&self.potential, heap);
    snow_heap_put(heap, self.met);
    snow_cells_end(&self.cells, heap);
    return status;
}
