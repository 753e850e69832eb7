#include "aggregate/box.h"

#include <string.h>

const snow_site snow_box_steps[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

/* Words to a row, in all layers. */
static size_t columns_of(const torus *self)
{
    return self->columns * (self->axes == 3 ? (size_t)self->side : 1);
}

snow_status snow_box_start(torus *self, snow_heap *heap, int32_t side, int axes)
{
    *self = (torus){.side = side, .axes = axes, .columns = ((size_t)side + 2 * (size_t)SNOW_BOX_WORD) / 64 + 2};
    self->bits = snow_heap_get(heap, columns_of(self), (size_t)side * sizeof *self->bits);
    return self->bits != NULL ? SNOW_OK : heap->refusal;
}

void snow_box_end(torus *self, snow_heap *heap)
{
    snow_heap_put(heap, self->bits);
    *self = (torus){.bits = NULL};
}

void snow_box_clear(torus *self)
{
    memset(self->bits, 0, columns_of(self) * (size_t)self->side * sizeof *self->bits);
}

static void flip(const torus *self, snow_site site, const uint64_t *masks, int32_t rows, uint32_t skip)
{
    uint64_t *left = snow_box_word(self, site);
    uint64_t *right = left + self->side;
    uint32_t shift = (uint32_t)site.x % 64;
    for (int32_t y = 0; y < rows; y++)
        left[y] ^= masks[y] >> skip << shift;
    for (int32_t y = 0; y < rows && shift > 0; y++)
        right[y] ^= masks[y] >> skip >> (64 - shift);
}

/* What repeats the beginning of a row is flipped with it. */
void snow_box_flip(const torus *self, snow_site site, const uint64_t *masks, int32_t rows)
{
    flip(self, site, masks, rows, 0);
    if (site.x < SNOW_BOX_WORD)
        flip(self, (snow_site){site.x + self->side, site.y, site.z}, masks, rows, 0);
    if (site.x + SNOW_BOX_WORD > self->side)
        flip(self, (snow_site){0, site.y, site.z}, masks, rows, (uint32_t)(self->side - site.x));
}
