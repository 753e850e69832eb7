#include "aggregate/shape.h"

#include <string.h>

/* A strip's sites are STRIP of its 64; the first lies FIRST sites left of the cluster. */
enum { STRIP = 60, MARGIN = 2, FIRST = 2 };

snow_status snow_shape_maker_start(shape_maker *self, snow_heap *heap, const torus *box)
{
    *self = (shape_maker){.front = NULL};
    snow_status status = snow_box_start(&self->own, heap, box->side, box->axes);
    if (status != SNOW_OK)
        return status;
    size_t rows = (size_t)box->side + 2;
    self->front = snow_heap_get(heap, 3 * rows, sizeof *self->front);
    if (self->front == NULL)
        return heap->refusal;
    self->beside = self->front + rows;
    self->mask = self->beside + rows;
    return SNOW_OK;
}

void snow_shape_maker_end(shape_maker *self, snow_heap *heap)
{
    snow_box_end(&self->own, heap);
    snow_heap_put(heap, self->front);
}

static int32_t lesser(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

/* From the corner to the lowest site that the first strip shows, and is asked about. */
static snow_site first_shown(const torus *box, int32_t strip)
{
    return (snow_site){strip * STRIP - FIRST - MARGIN, -FIRST - MARGIN, box->axes == 3 ? -FIRST - MARGIN : 0};
}

static snow_site moved_round(const torus *box, snow_site site, snow_site by)
{
    return snow_box_site(box, aggregate_moved(site, by));
}

/* Layers are read from the set of sites as they stand there. */
static void read_words(const shape_maker *self, shape *into)
{
    const torus *own = &self->own;
    int32_t rows = into->extent.y + 2 * MARGIN;
    int32_t layers = into->layer > 0 ? into->extent.z + 2 * MARGIN : 1;
    uint64_t *word = into->word;
    for (int32_t z = 0; z < layers; z++)
        for (int32_t strip = 0; strip < into->strips; strip++)
            for (int32_t y = 0; y < rows; y++)
                *word++ = snow_box_read(own, moved_round(own, first_shown(own, strip), (snow_site){0, y, z}));
}

snow_status snow_shape_make(shape_maker *self, snow_heap *heap, const torus *box, const snow_site *sites,
                            uint32_t count, snow_site extent, shape **made)
{
    shape form = {.extent = {lesser(extent.x + 2 * FIRST, box->side), lesser(extent.y + 2 * FIRST, box->side),
                             box->axes == 3 ? lesser(extent.z + 2 * FIRST, box->side) : 1}};
    form.strips = (form.extent.x + STRIP - 1) / STRIP;
    size_t words = (size_t)form.strips * ((size_t)form.extent.y + 2 * MARGIN);
    form.layer = box->axes == 3 ? words : 0;
    words *= box->axes == 3 ? (size_t)form.extent.z + 2 * MARGIN : 1;
    *made = snow_heap_get_raw(heap, sizeof form + words * sizeof form.word[0], 1);
    if (*made == NULL)
        return heap->refusal;
    **made = form;
    for (uint32_t i = 0; i < count; i++)
        snow_box_flip_site(&self->own, sites[i]);
    read_words(self, *made);
    for (uint32_t i = 0; i < count; i++)
        snow_box_flip_site(&self->own, sites[i]);
    return SNOW_OK;
}

/* A strip of a layer, from the first row that is asked about on. */
static const uint64_t *strip_of(const shape *self, int32_t strip, int32_t z)
{
    size_t rows = (size_t)self->extent.y + 2 * MARGIN;
    return self->word + (self->layer > 0 ? self->layer * ((size_t)z + MARGIN) : 0) + (size_t)strip * rows + MARGIN;
}

/* Sites of a strip that are asked about. */
static uint64_t asked(const shape *self, int32_t strip)
{
    int32_t sites = lesser(self->extent.x - strip * STRIP, STRIP);
    return (UINT64_MAX >> (64 - sites)) << MARGIN;
}

/* Where the cluster is after the step, rows −1 to `rows`. */
static void find_moved(const shape *self, const uint64_t *own, int direction, int32_t rows, uint64_t *moved)
{
    if (direction < 2) {
        for (int32_t y = -1; y <= rows; y++)
            moved[y] = direction == 0 ? own[y] << 1 : own[y] >> 1;
        return;
    }
    const uint64_t *from = direction < 4 ? own : direction == 4 ? own - self->layer : own + self->layer;
    int32_t up = direction == 2 ? -1 : direction == 3 ? 1 : 0;
    for (int32_t y = -1; y <= rows; y++)
        moved[y] = from[y + up];
}

/* The sites that the step takes. */
static void find_front(const shape *self, const uint64_t *own, int direction, int32_t rows, uint64_t *front)
{
    find_moved(self, own, direction, rows, front);
    for (int32_t y = -1; y <= rows; y++)
        front[y] &= ~own[y];
}

/* What stands before the front, and round that. */
static void find_touching(const shape *self, const shape_maker *maker, const uint64_t *own, int direction)
{
    int32_t rows = self->extent.y;
    uint64_t *front = maker->front + 1;
    uint64_t *beside = maker->beside + 1;
    uint64_t *mask = maker->mask;
    find_front(self, own, direction, rows, front);
    for (int32_t y = 0; y < rows; y++)
        mask[y] = front[y] | front[y] << 1 | front[y] >> 1 | front[y - 1] | front[y + 1];
    for (int layer = -1; layer <= 1 && self->layer > 0; layer += 2) {
        find_front(self, layer < 0 ? own - self->layer : own + self->layer, direction, rows, beside);
        for (int32_t y = 0; y < rows; y++)
            mask[y] |= beside[y];
    }
    for (int32_t y = 0; y < rows; y++)
        mask[y] &= ~own[y];
}

/* The site of the box where a strip's rows begin. */
static snow_site place_of(const shape *self, const torus *box, snow_site corner, int32_t strip, int32_t z)
{
    snow_site from = {strip * STRIP - FIRST - MARGIN, -FIRST, self->layer > 0 ? z - FIRST : 0};
    return moved_round(box, corner, from);
}

/* Rows from one on that follow each other in the box. */
static int32_t run_of(const shape *self, const torus *box, int32_t y, int32_t row)
{
    return lesser(self->extent.y - y, box->side - row);
}

static void list_hits(const torus *box, snow_site at, uint64_t hits, snow_shape_touch touch, void *context)
{
    for (int bit = 0; hits != 0; bit++, hits >>= 1)
        if (hits & 1)
            touch(context, (snow_site){snow_box_wrap(box, at.x + bit), at.y, at.z});
}

static void look(const shape *self, const shape_maker *maker, const torus *box, snow_site at, uint64_t asked_about,
                 snow_shape_touch touch, void *context)
{
    for (int32_t y = 0, run; y < self->extent.y; y += run, at.y = 0) {
        run = run_of(self, box, y, at.y);
        const uint64_t *left = snow_box_word(box, at);
        const uint64_t *right = left + box->side;
        const uint64_t *mask = maker->mask + y;
        uint32_t shift = (uint32_t)at.x % 64;
        uint64_t any = 0;
        for (int32_t i = 0; i < run; i++)
            any |= mask[i] & (left[i] >> shift | right[i] << 1 << (63 - shift));
        for (int32_t i = 0; i < run && (any & asked_about) != 0; i++) {
            snow_site here = {at.x, at.y + i, at.z};
            list_hits(box, here, mask[i] & asked_about & snow_box_read(box, here), touch, context);
        }
    }
}

void snow_shape_find_touched(const shape *self, const shape_maker *maker, const torus *box, snow_site corner,
                             int direction, snow_shape_touch touch, void *context)
{
    for (int32_t z = 0; z < self->extent.z; z++)
        for (int32_t strip = 0; strip < self->strips; strip++) {
            find_touching(self, maker, strip_of(self, strip, z), direction);
            look(self, maker, box, place_of(self, box, corner, strip, z), asked(self, strip), touch, context);
        }
}

/* A step frees some sites and takes others. */
static void flip_strip(const shape *self, const shape_maker *maker, const torus *box, snow_site at, int32_t strip,
                       int32_t z, int direction)
{
    const uint64_t *own = strip_of(self, strip, z);
    uint64_t *moved = maker->front + 1;
    find_moved(self, own, direction, self->extent.y, moved);
    uint64_t asked_about = asked(self, strip);
    for (int32_t y = 0; y < self->extent.y; y++)
        maker->mask[y] = (moved[y] ^ own[y]) & asked_about;
    for (int32_t y = 0, run; y < self->extent.y; y += run, at.y = 0) {
        run = run_of(self, box, y, at.y);
        snow_box_flip(box, at, maker->mask + y, run);
    }
}

void snow_shape_step(const shape *self, const shape_maker *maker, const torus *box, snow_site corner, int direction)
{
    for (int32_t z = 0; z < self->extent.z; z++)
        for (int32_t strip = 0; strip < self->strips; strip++)
            flip_strip(self, maker, box, place_of(self, box, corner, strip, z), strip, z, direction);
}
