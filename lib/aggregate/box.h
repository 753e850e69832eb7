/* A periodic box of sites, a bit each. Rows repeat their beginning after their
   end, so that 64 bits can be read from any bit on. */
#ifndef SNOW_AGGREGATE_BOX_H
#define SNOW_AGGREGATE_BOX_H

#include "aggregate/model.h"

typedef struct torus {
    int32_t side;
    int axes;
    size_t row_words;
    uint64_t *bits;
} torus;

/* Opposite directions differ in the last bit. */
extern const snow_site snow_box_steps[6];

/* Rows shorter than this are not read 64 bits at a time. */
enum { SNOW_BOX_WORD = 64 };

snow_status snow_box_start(torus *self, snow_heap *heap, int32_t side, int axes);
void snow_box_end(torus *self, snow_heap *heap);

static inline int snow_box_directions(const torus *self)
{
    return 2 * self->axes;
}

static inline int32_t snow_box_wrap(const torus *self, int32_t x)
{
    while (x >= self->side)
        x -= self->side;
    while (x < 0)
        x += self->side;
    return x;
}

static inline snow_site snow_box_site(const torus *self, snow_site site)
{
    return (snow_site){snow_box_wrap(self, site.x), snow_box_wrap(self, site.y), snow_box_wrap(self, site.z)};
}

static inline snow_site snow_box_next(const torus *self, snow_site site, int direction)
{
    return snow_box_site(self, aggregate_moved(site, snow_box_steps[direction]));
}

static inline size_t snow_box_number(const torus *self, snow_site site)
{
    size_t side = (size_t)self->side;
    return ((size_t)site.z * side + (size_t)site.y) * side + (size_t)site.x;
}

static inline uint64_t *snow_box_row(const torus *self, int32_t y, int32_t z)
{
    return self->bits + ((size_t)z * (size_t)self->side + (size_t)y) * self->row_words;
}

static inline bool snow_box_has(const torus *self, snow_site site)
{
    return (snow_box_row(self, site.y, site.z)[(uint32_t)site.x / 64] >> ((uint32_t)site.x % 64) & 1) != 0;
}

/* 64 bits of a row from bit x on, round its end. */
static inline uint64_t snow_box_read(const uint64_t *row, int32_t x)
{
    const uint64_t *word = row + (uint32_t)x / 64;
    uint32_t shift = (uint32_t)x % 64;
    return word[0] >> shift | word[1] << 1 << (63 - shift);
}

static inline void snow_box_flip_words(uint64_t *row, int32_t x, uint64_t mask)
{
    uint64_t *word = row + (uint32_t)x / 64;
    uint32_t shift = (uint32_t)x % 64;
    word[0] ^= mask << shift;
    word[1] ^= mask >> 1 >> (63 - shift);
}

/* Flips bits of a row from bit x on, round its end, and what repeats them. */
static inline void snow_box_flip(const torus *self, uint64_t *row, int32_t x, uint64_t mask)
{
    snow_box_flip_words(row, x, mask);
    if (x < SNOW_BOX_WORD)
        snow_box_flip_words(row, x + self->side, mask & (UINT64_MAX >> x));
    if (x + SNOW_BOX_WORD > self->side)
        snow_box_flip_words(row, 0, mask >> (self->side - x));
}

static inline void snow_box_flip_site(const torus *self, snow_site site)
{
    snow_box_flip(self, snow_box_row(self, site.y, site.z), site.x, 1);
}

#endif
