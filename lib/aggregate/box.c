#include "aggregate/box.h"

const snow_site snow_box_steps[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

snow_status snow_box_start(torus *self, snow_heap *heap, int32_t side, int axes)
{
    *self = (torus){.side = side, .axes = axes};
    size_t rows = (size_t)side * (axes == 3 ? (size_t)side : 1);
    self->row_words = ((size_t)side + 2 * SNOW_BOX_WORD) / 64 + 2;
    self->bits = snow_heap_get(heap, rows, self->row_words * sizeof *self->bits);
    return self->bits != NULL ? SNOW_OK : heap->refusal;
}

void snow_box_end(torus *self, snow_heap *heap)
{
    snow_heap_put(heap, self->bits);
    *self = (torus){.bits = NULL};
}
