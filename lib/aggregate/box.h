/* A periodic box of sites, a bit each. Words hold 64 sites of a row; those of
   the rows above follow them in memory, so that a block of sites is a run of
   words. Rows repeat their beginning after their end, so that 64 bits can be
   read from any bit on. */
#ifndef SNOW_AGGREGATE_BOX_H
#define SNOW_AGGREGATE_BOX_H

#include "aggregate/model.h"

typedef struct torus {
    int32_t side;
    int axes;
    size_t columns; /* of words, in a layer */
    uint64_t *bits;
} torus;

/* Opposite directions differ in the last bit. */
extern const snow_site snow_box_steps[6];

/* Rows shorter than this are not read 64 bits at a time. */
enum { SNOW_BOX_WORD = 64 };

snow_status snow_box_start(torus *self, snow_heap *heap, int32_t side, int axes);
void snow_box_end(torus *self, snow_heap *heap);

/* Takes all sites out. */
void snow_box_clear(torus *self);

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

/* The word that holds a site; that of the site above is the next one, that of the 64 sites to the right lies
   `side` words on. */
static inline uint64_t *snow_box_word(const torus *self, snow_site site)
{
    size_t column = (size_t)site.z * self->columns + (uint32_t)site.x / 64;
    return self->bits + column * (size_t)self->side + (uint32_t)site.y;
}

static inline bool snow_box_has(const torus *self, snow_site site)
{
    return (*snow_box_word(self, site) >> ((uint32_t)site.x % 64) & 1) != 0;
}

/* A site and the 63 to its right, round the end of the row. */
static inline uint64_t snow_box_read(const torus *self, snow_site site)
{
    const uint64_t *word = snow_box_word(self, site);
    uint32_t shift = (uint32_t)site.x % 64;
    return word[0] >> shift | word[self->side] << 1 << (63 - shift);
}

/* Flips sites of `rows` rows, one above the other and not round the top: a mask each for the site in the lowest row
   and those to its right. */
void snow_box_flip(const torus *self, snow_site site, const uint64_t *masks, int32_t rows);

static inline void snow_box_flip_site(const torus *self, snow_site site)
{
    const uint64_t mask = 1;
    snow_box_flip(self, site, &mask, 1);
}

#endif
