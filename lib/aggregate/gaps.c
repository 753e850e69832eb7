#include "aggregate/gaps.h"

#include <string.h>

enum { FEW = 64, WINDOW = 64, FAR_OFF = WINDOW / 4 };

/* Displacements of the smaller cluster's corner from the larger one's; bit x of row y: x and y more than `first`.
   What is on the edge is not known: its neighbours are not. */
typedef struct gap_window {
    uint32_t masses[2]; /* it was made for; clusters that merge have others */
    snow_site first;
    uint64_t touching[WINDOW];
} gap_window;

/* The sites of one cluster, as it was when it was drawn. */
typedef struct drawing {
    torus set;
    const cluster *of;
    uint32_t mass;
    snow_site corner;
} drawing;

struct snow_gaps {
    drawing drawing[2]; /* of the largest cluster, and of another one */
    uint32_t count;
    uint32_t number[FEW]; /* clusters when this was made; some are gone since */
    gap_window window[FEW * (FEW - 1) / 2];
};

bool snow_gaps_apply(const clusters *self)
{
    return self->lives <= FEW && self->box.axes == 2 && self->box.side >= WINDOW;
}

static void end(struct snow_gaps *gaps, snow_heap *heap)
{
    for (int i = 0; i < 2 && gaps != NULL; i++)
        snow_box_end(&gaps->drawing[i].set, heap);
    snow_heap_put(heap, gaps);
}

static snow_status make(clusters *self, snow_heap *heap)
{
    if (self->gaps != NULL)
        return SNOW_OK;
    struct snow_gaps *gaps = snow_heap_get(heap, 1, sizeof *gaps);
    if (gaps == NULL)
        return heap->refusal;
    snow_status status = SNOW_OK;
    for (int i = 0; i < 2 && status == SNOW_OK; i++)
        status = snow_box_start(&gaps->drawing[i].set, heap, self->box.side, self->box.axes);
    if (status != SNOW_OK) {
        end(gaps, heap);
        return status;
    }
    gaps->count = self->lives;
    memcpy(gaps->number, self->live, self->lives * sizeof *self->live);
    self->gaps = gaps;
    return SNOW_OK;
}

void snow_gaps_end(clusters *self, snow_heap *heap)
{
    end(self->gaps, heap);
    self->gaps = NULL;
}

static const cluster *cluster_of(const clusters *self, uint32_t seat)
{
    return &self->cluster[self->gaps->number[seat]];
}

static gap_window *window_of(const clusters *self, uint32_t a, uint32_t b)
{
    return &self->gaps->window[a > b ? a * (a - 1) / 2 + b : b * (b - 1) / 2 + a];
}

/* Of each two clusters one is the larger. */
static bool is_larger(const cluster *a, const cluster *b)
{
    return a->mass != b->mass ? a->mass > b->mass : a < b;
}

static snow_site difference(const torus *box, snow_site a, snow_site b)
{
    return snow_box_site(box, (snow_site){a.x - b.x, a.y - b.y, 0});
}

static snow_site corner_of(const clusters *self, const cluster *of)
{
    return snow_clusters_site(self, of, of->least);
}

static snow_site displacement(const clusters *self, const cluster *large, const cluster *small)
{
    return difference(&self->box, corner_of(self, small), corner_of(self, large));
}

static bool is_known(const gap_window *window, const cluster *large, const cluster *small)
{
    return window->masses[0] == large->mass && window->masses[1] == small->mass;
}

/* Whether it is time to make a window anew, when that is cheap. */
static bool is_old(const clusters *self, const gap_window *window, const cluster *large, const cluster *small)
{
    if (!is_known(window, large, small))
        return true;
    snow_site at = difference(&self->box, displacement(self, large, small), window->first);
    return at.x < FAR_OFF || at.x >= WINDOW - FAR_OFF || at.y < FAR_OFF || at.y >= WINDOW - FAR_OFF;
}

/* It takes long to draw a large cluster, and the largest one is asked for most often. */
static const drawing *drawn(const clusters *self, const cluster *large)
{
    drawing *it = &self->gaps->drawing[large->mass == self->largest ? 0 : 1];
    if (it->of == large && it->mass == large->mass)
        return it;
    snow_box_clear(&it->set);
    snow_clusters_flip(self, large, &it->set);
    it->of = large;
    it->mass = large->mass;
    it->corner = corner_of(self, large);
    return it;
}

/* Whether a window of sites has some within a cluster's bounds. */
static bool comes_near(const torus *box, snow_site at, snow_site corner, snow_site extent)
{
    snow_site from = difference(box, at, corner);
    return (from.x <= extent.x || from.x + WINDOW > box->side) && (from.y <= extent.y || from.y + WINDOW > box->side);
}

/* Adds the displacements by which one site of the smaller cluster comes onto the larger one's; from the first one on. */
static void add_site(const torus *larger, snow_site at, uint64_t *overlaps)
{
    uint32_t shift = (uint32_t)at.x % 64;
    for (int32_t y = 0, run; y < WINDOW; y += run, at.y = 0) {
        run = larger->side - at.y < WINDOW - y ? larger->side - at.y : WINDOW - y;
        const uint64_t *left = snow_box_word(larger, at);
        const uint64_t *right = left + larger->side;
        for (int32_t i = 0; i < run; i++)
            overlaps[y + i] |= left[i] >> shift | right[i] << 1 << (63 - shift);
    }
}

static void make_window(const clusters *self, const drawing *drawn, const cluster *small, gap_window *window)
{
    uint64_t overlaps[WINDOW] = {0};
    const cluster *large = drawn->of;
    snow_site extent = {large->greatest.x - large->least.x, large->greatest.y - large->least.y, 0};
    snow_site since = difference(&self->box, drawn->corner, corner_of(self, large));
    for (uint32_t i = 0; i < small->mass; i++) {
        snow_site at = self->position[self->member[small->first + i]];
        at = (snow_site){at.x + since.x - WINDOW / 2, at.y + since.y - WINDOW / 2, 0};
        at = snow_clusters_site(self, small, at);
        if (comes_near(&self->box, at, drawn->corner, extent))
            add_site(&drawn->set, at, overlaps);
    }
    snow_site now = displacement(self, large, small);
    window->masses[0] = large->mass;
    window->masses[1] = small->mass;
    window->first = snow_box_site(&self->box, (snow_site){now.x - WINDOW / 2, now.y - WINDOW / 2, 0});
    for (int32_t y = 1; y < WINDOW - 1; y++)
        window->touching[y] = overlaps[y] << 1 | overlaps[y] >> 1 | overlaps[y - 1] | overlaps[y + 1];
}

/* The windows of a cluster with smaller ones, as far as they are old. */
static void make_windows(const clusters *self, uint32_t seat)
{
    const cluster *large = cluster_of(self, seat);
    const drawing *large_drawn = drawn(self, large);
    for (uint32_t other = 0; other < self->gaps->count; other++) {
        const cluster *small = cluster_of(self, other);
        if (other == seat || small->mass == 0 || is_larger(small, large))
            continue;
        gap_window *window = window_of(self, seat, other);
        if (is_old(self, window, large, small))
            make_window(self, large_drawn, small, window);
    }
}

static bool is_within(snow_site at)
{
    return at.x > 0 && at.x < WINDOW - 1 && at.y > 0 && at.y < WINDOW - 1;
}

static bool would_touch(const clusters *self, uint32_t seat, uint32_t other, snow_site step)
{
    const cluster *moving = cluster_of(self, seat);
    const cluster *resting = cluster_of(self, other);
    bool larger = is_larger(moving, resting);
    const cluster *large = larger ? moving : resting;
    const cluster *small = larger ? resting : moving;
    snow_site by = larger ? (snow_site){-step.x, -step.y, 0} : step;
    const gap_window *window = window_of(self, seat, other);
    snow_site wanted = aggregate_moved(displacement(self, large, small), by);
    snow_site at = difference(&self->box, wanted, window->first);
    if (!is_known(window, large, small) || !is_within(at)) {
        make_windows(self, larger ? seat : other);
        at = difference(&self->box, wanted, window->first);
    }
    return (window->touching[at.y] >> at.x & 1) != 0;
}

snow_status snow_gaps_find_touched(clusters *self, snow_heap *heap, uint32_t number, int direction, uint32_t *count)
{
    snow_status status = make(self, heap);
    if (status != SNOW_OK)
        return status;
    uint32_t seat = 0;
    while (self->gaps->number[seat] != number)
        seat++;
    *count = 0;
    for (uint32_t other = 0; other < self->gaps->count; other++)
        if (other != seat && cluster_of(self, other)->mass > 0 &&
            would_touch(self, seat, other, snow_box_steps[direction]))
            *count = snow_clusters_list(self, *count, self->gaps->number[other]);
    return SNOW_OK;
}
