/* Which tiles there are, where they are found, and how they hang together. */
#include "packard/tiles_plane.h"

#include "base/cpu.h"

#include <string.h>

static const struct {
    int q, r, opposite;
} directions[TILE_DIRECTIONS] = {
    [NORTH] = {0, -1, SOUTH}, [NORTHEAST] = {1, -1, SOUTHWEST}, [EAST] = {1, 0, WEST},
    [SOUTH] = {0, 1, NORTH},  [SOUTHWEST] = {-1, 1, NORTHEAST}, [WEST] = {-1, 0, EAST},
};

static int64_t wrapped(int64_t x, int64_t size)
{
    int64_t rest = x % size;
    return rest < 0 ? rest + size : rest;
}

static int32_t tiles_across(int64_t cells)
{
    return (int32_t)((cells + SNOW_TILE_SIDE - 1) / SNOW_TILE_SIDE);
}

static bool is_torus(const snow_tiles *tiles)
{
    return tiles->plan.width != 0;
}

void snow_tiles_fold(int64_t *q, int64_t *r)
{
    int64_t a = *q < 0 ? -*q : *q;
    int64_t b = *r < 0 ? -*r : *r;
    int64_t c = *q + *r < 0 ? -(*q + *r) : *q + *r;
    int64_t greatest = a > b ? (a > c ? a : c) : (b > c ? b : c);
    int64_t least = a < b ? (a < c ? a : c) : (b < c ? b : c);
    *q = greatest - least;
    *r = least;
}

/* Where no tile can be, farther out than seeds and steps lead, all tiles are one. */
static int32_t tile_number(int64_t first_cell)
{
    int64_t number = first_cell / SNOW_TILE_SIDE;
    return number > INT32_MAX ? INT32_MAX : number < INT32_MIN ? INT32_MIN : (int32_t)number;
}

tile_place snow_tiles_place(int64_t q, int64_t r)
{
    int64_t x = wrapped(q, SNOW_TILE_SIDE);
    int64_t y = wrapped(r, SNOW_TILE_SIDE);
    return (tile_place){tile_number(q - x), tile_number(r - y), (unsigned)x, (unsigned)y};
}

tile_place snow_tiles_locate(const snow_tiles *tiles, int64_t q, int64_t r)
{
    if (is_torus(tiles)) {
        q = wrapped(q, tiles->plan.width);
        r = wrapped(r, tiles->plan.height);
    } else if (tiles->plan.folded) {
        q -= tiles->plan.fold_q;
        r -= tiles->plan.fold_r;
        snow_tiles_fold(&q, &r);
    }
    return snow_tiles_place(q, r);
}

static size_t slot_of(const snow_tiles *tiles, int32_t q, int32_t r)
{
    uint64_t key = (uint64_t)(uint32_t)q << 32 | (uint32_t)r;
    key ^= key >> 32;
    key *= UINT64_C(0x9E3779B97F4A7C15);
    key ^= key >> 29;
    key *= UINT64_C(0xBF58476D1CE4E5B9);
    return (size_t)(key >> 32) & (tiles->directory_size - 1);
}

/* The slot that holds the tile, or the one where it would be put. */
static snow_tile **search(const snow_tiles *tiles, int32_t q, int32_t r)
{
    size_t slot = slot_of(tiles, q, r);
    while (tiles->directory[slot] != NULL && (tiles->directory[slot]->q != q || tiles->directory[slot]->r != r))
        slot = (slot + 1) & (tiles->directory_size - 1);
    return &tiles->directory[slot];
}

snow_tile *snow_tiles_find(const snow_tiles *tiles, int32_t q, int32_t r)
{
    return *search(tiles, q, r);
}

static bool widen_directory(snow_tiles *tiles)
{
    size_t old_size = tiles->directory_size;
    snow_tile **old = tiles->directory;
    if ((tiles->tiles + 1) * 4 <= old_size * 3)
        return true;
    snow_tile **wider = snow_heap_get(tiles->heap, 2 * old_size, sizeof(snow_tile *));
    if (wider == NULL)
        return false;
    tiles->directory = wider;
    tiles->directory_size = 2 * old_size;
    for (size_t i = 0; i < old_size; i++)
        if (old[i] != NULL)
            *search(tiles, old[i]->q, old[i]->r) = old[i];
    snow_heap_put(tiles->heap, old);
    return true;
}

static snow_tile *slab_tile(tile_slab *slab, size_t index)
{
    return (snow_tile *)((char *)slab + sizeof(snow_tile)) + index;
}

/* A slab is as large as a quarter of all before it, within limits. */
static bool widen_slab(snow_tiles *tiles)
{
    enum { LEAST = 7, MOST = 3000 };
    if (tiles->slab != NULL && tiles->slab_used < tiles->slab->tiles)
        return true;
    size_t size = tiles->tiles / 4 < LEAST ? LEAST : tiles->tiles / 4 > MOST ? MOST : tiles->tiles / 4;
    tile_slab *slab = snow_heap_get_raw(tiles->heap, size + 1, sizeof(snow_tile));
    if (slab == NULL)
        return false;
    *slab = (tile_slab){tiles->slab, size};
    tiles->slab = slab;
    tiles->slab_used = 0;
    return true;
}

/* Tile coordinates in a direction; false: the plane ends there. */
static bool coordinates_beside(const snow_tiles *tiles, const snow_tile *tile, int direction, int32_t *q, int32_t *r)
{
    *q = tile->q + directions[direction].q;
    *r = tile->r + directions[direction].r;
    if (is_torus(tiles)) {
        *q = (int32_t)wrapped(*q, tiles_across(tiles->plan.width));
        *r = (int32_t)wrapped(*r, tiles_across(tiles->plan.height));
    }
    return !tiles->plan.folded || (*r >= 0 && *r <= *q);
}

static void link_tile(snow_tiles *tiles, snow_tile *tile)
{
    for (int direction = 0; direction < TILE_DIRECTIONS; direction++) {
        int32_t q, r;
        snow_tile *beside = NULL;
        if (coordinates_beside(tiles, tile, direction, &q, &r))
            beside = snow_tiles_find(tiles, q, r);
        tile->beside[direction] = beside != NULL ? beside : tiles->nothing;
        if (beside != NULL)
            beside->beside[directions[direction].opposite] = tile;
    }
}

static unsigned extent(int64_t size, int32_t tile)
{
    int64_t left = size - (int64_t)tile * SNOW_TILE_SIDE;
    return size == 0 || left > SNOW_TILE_SIDE ? SNOW_TILE_SIDE : (unsigned)left;
}

static uint8_t kind_of(const snow_tiles *tiles, int32_t q, int32_t r)
{
    if (extent(tiles->plan.width, q) < SNOW_TILE_SIDE || extent(tiles->plan.height, r) < SNOW_TILE_SIDE)
        return TILE_CUT;
    if (!tiles->plan.folded)
        return 0;
    return (uint8_t)((q == r ? TILE_DIAGONAL : 0) | (q == r + 1 ? TILE_OFF_DIAGONAL : 0) | (r == 0 ? TILE_BASE : 0));
}

static uint64_t lowest_bits(unsigned count)
{
    return count < 64 ? (UINT64_C(1) << count) - 1 : UINT64_MAX;
}

static void allow_all(const snow_tiles *tiles, const snow_tile *tile, uint64_t *allowed)
{
    uint64_t columns = lowest_bits(extent(tiles->plan.width, tile->q));
    unsigned rows = extent(tiles->plan.height, tile->r);
    for (unsigned y = 0; y < SNOW_TILE_SIDE; y++)
        allowed[y] = y < rows ? columns : 0;
}

static bool needs_extra(const snow_tiles *tiles, const snow_tile *tile)
{
    return tiles->plan.dated || (tile->kind & TILE_CUT);
}

static bool provide_extra(snow_tiles *tiles, snow_tile *tile)
{
    if (tile->extra != NULL)
        return true;
    tile_extra *extra = snow_heap_get(tiles->heap, 1, sizeof *extra);
    if (extra == NULL)
        return false;
    if (tiles->plan.dated) {
        extra->dates = snow_heap_get(tiles->heap, (size_t)SNOW_TILE_SIDE * SNOW_TILE_SIDE, sizeof *extra->dates);
        if (extra->dates == NULL) {
            snow_heap_put(tiles->heap, extra);
            return false;
        }
    }
    extra->columns = (uint8_t)extent(tiles->plan.width, tile->q);
    extra->rows = (uint8_t)extent(tiles->plan.height, tile->r);
    allow_all(tiles, tile, extra->allowed);
    tile->extra = extra;
    return true;
}

static void end_extra(snow_tiles *tiles, snow_tile *tile)
{
    if (tile->extra != NULL)
        snow_heap_put(tiles->heap, tile->extra->dates);
    snow_heap_put(tiles->heap, tile->extra);
    tile->extra = NULL;
}

/* What a mask demands of a tile. */
typedef struct demands {
    bool any;
    uint64_t allowed[SNOW_TILE_SIDE];
    uint64_t priority[SNOW_TILE_SIDE];
} demands;

static void ask(const snow_tiles *tiles, const snow_tile *tile, snow_tile_mask mask, const void *context,
                demands *answer)
{
    memset(answer->allowed, 0xFF, sizeof answer->allowed);
    memset(answer->priority, 0, sizeof answer->priority);
    int64_t q = (int64_t)tile->q * SNOW_TILE_SIDE + (tiles->plan.folded ? tiles->plan.fold_q : 0);
    int64_t r = (int64_t)tile->r * SNOW_TILE_SIDE + (tiles->plan.folded ? tiles->plan.fold_r : 0);
    answer->any = mask != NULL && mask(context, q, r, answer->allowed, answer->priority);
}

static bool is_masked(const snow_tile *tile)
{
    return tile->extra != NULL && tile->extra->masked;
}

/* A tile that has what it needs: nothing can fail. */
static void obey(snow_tiles *tiles, snow_tile *tile, const demands *demanded)
{
    tile_extra *extra = tile->extra;
    if (extra == NULL)
        return;
    if (!demanded->any && !needs_extra(tiles, tile)) {
        end_extra(tiles, tile);
        return;
    }
    extra->masked = demanded->any;
    allow_all(tiles, tile, extra->allowed);
    for (unsigned y = 0; y < SNOW_TILE_SIDE; y++) {
        extra->allowed[y] &= demanded->allowed[y];
        extra->priority[y] = demanded->priority[y];
    }
}

static bool mask_tile(snow_tiles *tiles, snow_tile *tile)
{
    demands answer;
    ask(tiles, tile, tiles->plan.mask, tiles->plan.mask_context, &answer);
    if (answer.any && !provide_extra(tiles, tile))
        return false;
    obey(tiles, tile, &answer);
    return true;
}

snow_status snow_tiles_set_mask(snow_tiles *tiles, snow_tile_mask mask, const void *context)
{
    demands answer;
    for (size_t i = 0; i < tiles->directory_size; i++) {
        snow_tile *tile = tiles->directory[i];
        if (tile == NULL)
            continue;
        ask(tiles, tile, mask, context, &answer);
        if (answer.any && !provide_extra(tiles, tile))
            return tiles->heap->refusal;
        if ((answer.any || is_masked(tile)) && !snow_tiles_note_change(tiles, tile))
            return tiles->heap->refusal;
    }
    tiles->plan.mask = mask;
    tiles->plan.mask_context = context;
    for (size_t i = 0; i < tiles->directory_size; i++)
        if (tiles->directory[i] != NULL)
            mask_tile(tiles, tiles->directory[i]);
    return SNOW_OK;
}

static snow_tile *new_tile(snow_tiles *tiles, int32_t q, int32_t r)
{
    if (!widen_directory(tiles) || !widen_slab(tiles) ||
        (!tiles->plan.folded && !snow_tile_index_add(&tiles->index, q, r)))
        return NULL;
    snow_tile *tile = slab_tile(tiles->slab, tiles->slab_used);
    *tile = (snow_tile){.q = q, .r = r, .kind = kind_of(tiles, q, r)};
    if (needs_extra(tiles, tile) && !provide_extra(tiles, tile))
        return NULL;
    if (tiles->plan.mask != NULL && !mask_tile(tiles, tile)) {
        end_extra(tiles, tile);
        return NULL;
    }
    *search(tiles, q, r) = tile;
    tiles->slab_used++;
    tiles->tiles++;
    link_tile(tiles, tile);
    return tile;
}

snow_tile *snow_tiles_provide(snow_tiles *tiles, int32_t q, int32_t r)
{
    snow_tile *tile = snow_tiles_find(tiles, q, r);
    return tile != NULL ? tile : new_tile(tiles, q, r);
}

snow_status snow_tiles_provide_beside(snow_tiles *tiles, snow_tile *tile, int direction)
{
    int32_t q, r;
    if (tile->beside[direction] != tiles->nothing || !coordinates_beside(tiles, tile, direction, &q, &r))
        return SNOW_OK;
    return new_tile(tiles, q, r) != NULL ? SNOW_OK : tiles->heap->refusal;
}

snow_status snow_tiles_cover(snow_tiles *tiles, int64_t q, int64_t r, int64_t width, int64_t height)
{
    tile_place first = snow_tiles_locate(tiles, q, r);
    tile_place last = snow_tiles_locate(tiles, q + width - 1, r + height - 1);
    for (int32_t row = first.r; row <= last.r; row++) {
        for (int32_t column = first.q; column <= last.q; column++) {
            snow_tile *tile = snow_tiles_provide(tiles, column, row);
            if (tile == NULL || !snow_tiles_note_change(tiles, tile))
                return tiles->heap->refusal;
        }
    }
    return SNOW_OK;
}

bool snow_tile_list_lengthen(snow_heap *heap, tile_list *list, size_t more)
{
    size_t capacity = list->count + list->count / 2 + more;
    snow_tile **longer = snow_heap_get_raw(heap, capacity, sizeof *longer);
    if (longer == NULL)
        return false;
    if (list->count != 0)
        memcpy(longer, list->tile, list->count * sizeof *longer);
    snow_heap_put(heap, list->tile);
    list->tile = longer;
    list->capacity = capacity;
    return true;
}

bool snow_tiles_note_change(snow_tiles *tiles, snow_tile *tile)
{
    if (tile->state & TILE_CHANGED)
        return true;
    if (!tile_list_reserve(tiles->heap, &tiles->changed, 1))
        return false;
    tiles->changed.tile[tiles->changed.count++] = tile;
    tile->state |= TILE_CHANGED;
    return true;
}

static const tile_kernel *kernel_for(snow_isa isa)
{
#ifdef SNOW_HAVE_X86_KERNELS
    if (isa == SNOW_ISA_AVX2)
        return &snow_tile_kernel_avx2;
    if (isa == SNOW_ISA_AVX512)
        return &snow_tile_kernel_avx512;
#endif
    (void)isa;
    return &snow_tile_kernel_baseline;
}

snow_status snow_tiles_create(snow_tiles **tiles, snow_heap *heap, const snow_tiles_plan *plan)
{
    enum { DIRECTORY_START = 16 };
    snow_tiles *made = snow_heap_get(heap, 1, sizeof *made);
    if (made == NULL)
        return heap->refusal;
    made->heap = heap;
    made->plan = *plan;
    made->isa = plan->isa == SNOW_ISA_AUTO ? snow_cpu_best() : plan->isa;
    made->kernel = kernel_for(made->isa);
    made->directory_size = DIRECTORY_START;
    made->census = (snow_tiles_census){
        .least_q = INT64_MAX, .least_r = INT64_MAX, .least_s = INT64_MAX,
        .greatest_q = INT64_MIN, .greatest_r = INT64_MIN, .greatest_s = INT64_MIN,
    };
    made->directory = snow_heap_get(heap, DIRECTORY_START, sizeof(snow_tile *));
    made->nothing = snow_heap_get(heap, 1, sizeof *made->nothing);
    if (made->directory == NULL || made->nothing == NULL || !snow_tile_index_start(&made->index, heap)) {
        snow_status refusal = heap->refusal;
        snow_tiles_destroy(made);
        return refusal;
    }
    made->nothing->active = 1; /* never to be put into the list */
    *tiles = made;
    return SNOW_OK;
}

void snow_tiles_destroy(snow_tiles *tiles)
{
    if (tiles == NULL)
        return;
    snow_heap *heap = tiles->heap;
    for (size_t i = 0; tiles->directory != NULL && i < tiles->directory_size; i++)
        if (tiles->directory[i] != NULL)
            end_extra(tiles, tiles->directory[i]);
    while (tiles->slab != NULL) {
        tile_slab *slab = tiles->slab;
        tiles->slab = slab->before;
        snow_heap_put(heap, slab);
    }
    snow_heap_put(heap, tiles->changed.tile);
    snow_heap_put(heap, tiles->active.tile);
    snow_heap_put(heap, tiles->uncounted.tile);
    snow_tile_index_end(&tiles->index);
    snow_heap_put(heap, tiles->directory);
    snow_heap_put(heap, tiles->nothing);
    snow_heap_put(heap, tiles);
}
