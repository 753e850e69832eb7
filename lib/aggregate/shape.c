#include "aggregate/shape.h"

#include <string.h>

snow_status snow_shape_maker_start(shape_maker *self, snow_heap *heap, const torus *box)
{
    size_t rows = (size_t)box->side * (box->axes == 3 ? (size_t)box->side : 1);
    *self = (shape_maker){.row_words = (size_t)box->side / 64 + 1};
    self->words = rows * self->row_words;
    self->own = snow_heap_get(heap, self->words, sizeof *self->own);
    if (self->own == NULL)
        return heap->refusal;
    self->list = snow_heap_get(heap, self->words, sizeof *self->list);
    if (self->list == NULL)
        return heap->refusal;
    self->used = snow_heap_get_raw(heap, self->words, sizeof *self->used);
    if (self->used == NULL)
        return heap->refusal;
    self->hit = snow_heap_get_raw(heap, self->words, sizeof *self->hit);
    return self->hit != NULL ? SNOW_OK : heap->refusal;
}

void snow_shape_maker_end(shape_maker *self, snow_heap *heap)
{
    snow_heap_put(heap, self->own);
    snow_heap_put(heap, self->list);
    snow_heap_put(heap, self->used);
    snow_heap_put(heap, self->hit);
    snow_heap_put(heap, self->word);
    *self = (shape_maker){.own = NULL};
}

static size_t word_of(const shape_maker *self, const torus *box, snow_site site)
{
    return ((size_t)site.z * (size_t)box->side + (size_t)site.y) * self->row_words + (size_t)site.x / 64;
}

static uint64_t bit_of(snow_site site)
{
    return UINT64_C(1) << (site.x % 64);
}

bool snow_shape_maker_has(const shape_maker *self, const torus *box, snow_site site)
{
    return (self->own[word_of(self, box, site)] & bit_of(site)) != 0;
}

static void note(shape_maker *self, const torus *box, snow_site site)
{
    size_t word = word_of(self, box, site);
    if (self->list[word] == 0)
        self->hit[self->hit_count++] = (uint32_t)word;
    self->list[word] |= bit_of(site);
}

void snow_shape_maker_add(shape_maker *self, const torus *box, snow_site site)
{
    size_t word = word_of(self, box, site);
    if (self->own[word] == 0)
        self->used[self->used_count++] = (uint32_t)word;
    self->own[word] |= bit_of(site);
}

void snow_shape_maker_clear(shape_maker *self)
{
    for (; self->used_count > 0; self->used_count--)
        self->own[self->used[self->used_count - 1]] = 0;
}

/* A step takes the sites before the front and frees those at the rear. */
static void note_changes(shape_maker *self, const torus *box, snow_site site, int direction)
{
    snow_site before = snow_box_next(box, site, direction);
    if (!snow_shape_maker_has(self, box, before))
        note(self, box, before);
    if (!snow_shape_maker_has(self, box, snow_box_next(box, site, direction ^ 1)))
        note(self, box, site);
}

/* What stands before the front, and round that. */
static void note_touched(shape_maker *self, const torus *box, snow_site site, int direction)
{
    snow_site before = snow_box_next(box, site, direction);
    if (snow_shape_maker_has(self, box, before))
        return;
    note(self, box, before);
    for (int side = 0; side < snow_box_directions(box); side++) {
        snow_site beside = snow_box_next(box, before, side);
        if (!snow_shape_maker_has(self, box, beside))
            note(self, box, beside);
    }
}

static snow_status make_words_room(shape_maker *self, snow_heap *heap)
{
    size_t wanted = self->count + self->hit_count;
    if (wanted <= self->capacity)
        return SNOW_OK;
    shape_word *larger = snow_heap_get_raw(heap, 2 * wanted, sizeof *larger);
    if (larger == NULL)
        return heap->refusal;
    if (self->count > 0)
        memcpy(larger, self->word, self->count * sizeof *larger);
    snow_heap_put(heap, self->word);
    self->word = larger;
    self->capacity = 2 * wanted;
    return SNOW_OK;
}

/* Moves the list that was noted behind the words so far; without room it is lost. */
static snow_status take_list(shape_maker *self, snow_heap *heap, const torus *box)
{
    snow_status status = make_words_room(self, heap);
    for (uint32_t i = 0; i < self->hit_count; i++) {
        size_t word = self->hit[i];
        size_t row = word / self->row_words;
        if (status == SNOW_OK)
            self->word[self->count++] =
                (shape_word){self->list[word], (int32_t)(word % self->row_words) * 64,
                             (int32_t)(row % (size_t)box->side), (int32_t)(row / (size_t)box->side)};
        self->list[word] = 0;
    }
    self->hit_count = 0;
    return status;
}

static snow_status make_lists(shape_maker *self, snow_heap *heap, const torus *box, const snow_site *sites,
                              uint32_t count, shape *ends)
{
    snow_status status = SNOW_OK;
    for (int direction = 0; direction < snow_box_directions(box) && status == SNOW_OK; direction++) {
        for (uint32_t i = 0; i < count; i++)
            note_changes(self, box, sites[i], direction);
        status = take_list(self, heap, box);
        ends->change_end[direction] = (uint32_t)self->count;
        for (uint32_t i = 0; i < count && status == SNOW_OK; i++)
            note_touched(self, box, sites[i], direction);
        if (status == SNOW_OK)
            status = take_list(self, heap, box);
        ends->touch_end[direction] = (uint32_t)self->count;
    }
    return status;
}

snow_status snow_shape_make(shape_maker *self, snow_heap *heap, const torus *box, const snow_site *sites,
                            uint32_t count, shape **made)
{
    shape ends = {{0}, {0}};
    for (uint32_t i = 0; i < count; i++)
        snow_shape_maker_add(self, box, sites[i]);
    self->count = 0;
    snow_status status = make_lists(self, heap, box, sites, count, &ends);
    snow_shape_maker_clear(self);
    if (status != SNOW_OK)
        return status;
    size_t size = sizeof **made + self->count * sizeof(shape_word);
    *made = snow_heap_get_raw(heap, size, 1);
    if (*made == NULL)
        return heap->refusal;
    **made = ends;
    memcpy((*made)->word, self->word, self->count * sizeof(shape_word));
    return SNOW_OK;
}

/* Where a word of the shape lies in the box. */
static snow_site place_of(const torus *box, const shape_word *word, snow_site corner)
{
    int32_t x = word->x + corner.x;
    int32_t y = word->y + corner.y;
    int32_t z = word->z + corner.z;
    return (snow_site){x >= box->side ? x - box->side : x, y >= box->side ? y - box->side : y,
                       z >= box->side ? z - box->side : z};
}

bool snow_shape_find_touched(const shape *self, const torus *box, snow_site corner, int direction,
                             snow_shape_touch touch, void *context)
{
    bool any = false;
    for (uint32_t i = self->change_end[direction]; i < self->touch_end[direction]; i++) {
        snow_site at = place_of(box, &self->word[i], corner);
        uint64_t hits = snow_box_read(snow_box_row(box, at.y, at.z), at.x) & self->word[i].mask;
        for (int bit = 0; hits != 0; bit++, hits >>= 1) {
            if (!(hits & 1))
                continue;
            any = true;
            touch(context, (snow_site){snow_box_wrap(box, at.x + bit), at.y, at.z});
        }
    }
    return any;
}

void snow_shape_step(const shape *self, const torus *box, snow_site corner, int direction)
{
    uint32_t first = direction > 0 ? self->touch_end[direction - 1] : 0;
    for (uint32_t i = first; i < self->change_end[direction]; i++) {
        snow_site at = place_of(box, &self->word[i], corner);
        snow_box_flip(box, snow_box_row(box, at.y, at.z), at.x, self->word[i].mask);
    }
}
