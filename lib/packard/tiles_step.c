/* Steps: which tiles to visit, and the visits. */
#include "packard/tiles_plane.h"

/* In which neighbours a tile's last change is seen. */
typedef struct tile_views {
    bool seen[TILE_DIRECTIONS];
} tile_views;

static inline tile_views views_of(const snow_tile *tile, unsigned phase)
{
    const tile_edges *now = &tile->edge[phase];
    const tile_edges *before = &tile->edge[1 - phase];
    uint64_t bottom = now->bottom ^ before->bottom;
    uint64_t right = now->right ^ before->right;
    return (tile_views){{
        [NORTH] = now->top != before->top,
        [NORTHEAST] = (right & 1) != 0,
        [EAST] = right != 0,
        [SOUTH] = bottom != 0,
        [SOUTHWEST] = (bottom & 1) != 0,
        [WEST] = now->left != before->left,
    }};
}

static snow_status provide_viewers(snow_tiles *tiles, snow_tile *tile, const tile_views *views)
{
    snow_status status = SNOW_OK;
    for (int direction = 0; status == SNOW_OK && direction < TILE_DIRECTIONS; direction++)
        if (views->seen[direction])
            status = snow_tiles_provide_beside(tiles, tile, direction);
    return status;
}

/* Puts a tile that is not in a list yet at its end. There are no branches here,
   nor in what calls it: nobody could foretell them. */
static inline void enlist(tile_list *list, snow_tile *tile, bool wanted, unsigned listed)
{
    list->tile[list->count] = tile;
    bool add = wanted & !(tile->state & listed);
    list->count += add;
    tile->state |= (uint8_t)(add ? listed : 0);
}

/* Wakes a tile that changed, and those neighbours that see it. */
static snow_status wake_around(snow_tiles *tiles, snow_tile *tile)
{
    tile_views views = views_of(tile, tiles->phase);
    bool missing = false;
    for (int direction = 0; direction < TILE_DIRECTIONS; direction++)
        missing |= views.seen[direction] & (tile->beside[direction] == tiles->nothing);
    if (missing) {
        snow_status status = provide_viewers(tiles, tile, &views);
        if (status != SNOW_OK)
            return status;
    }
    if (!tile_list_reserve(tiles->heap, &tiles->active, 1 + TILE_DIRECTIONS) ||
        !tile_list_reserve(tiles->heap, &tiles->uncounted, 1))
        return tiles->heap->refusal;
    enlist(&tiles->uncounted, tile, true, TILE_UNCOUNTED);
    enlist(&tiles->active, tile, true, TILE_ACTIVE);
    for (int direction = 0; direction < TILE_DIRECTIONS; direction++)
        enlist(&tiles->active, tile->beside[direction], views.seen[direction], TILE_ACTIVE);
    return SNOW_OK;
}

/* May be repeated after a failure. */
static snow_status wake(snow_tiles *tiles)
{
    for (size_t i = 0; i < tiles->changed.count; i++) {
        snow_status status = wake_around(tiles, tiles->changed.tile[i]);
        if (status != SNOW_OK)
            return status;
    }
    for (size_t i = 0; i < tiles->changed.count; i++)
        tiles->changed.tile[i]->state &= (uint8_t)~TILE_CHANGED;
    tiles->changed.count = 0;
    return SNOW_OK;
}

/* Parts of the list of active tiles, each one thread's. */
enum { MOST_PARTS = 256, LEAST_TILES_A_PART = 128 };

typedef struct shared_pass {
    tile_pass pass;
    snow_tile **list;
    size_t count, parts;
    size_t changed[MOST_PARTS];
} shared_pass;

static size_t part_start(const shared_pass *shared, size_t part)
{
    return shared->count * part / shared->parts;
}

static void advance_part(void *argument, size_t part)
{
    shared_pass *shared = argument;
    size_t start = part_start(shared, part);
    shared->changed[part] =
        shared->pass.kernel->advance(&shared->pass, shared->list + start, part_start(shared, part + 1) - start);
}

static size_t advance_together(const snow_tiles *tiles, const tile_pass *pass)
{
    shared_pass shared = {.pass = *pass, .list = tiles->active.tile, .count = tiles->active.count};
    size_t most = 4 * (size_t)tiles->plan.threads < MOST_PARTS ? 4 * (size_t)tiles->plan.threads : MOST_PARTS;
    shared.parts = shared.count / LEAST_TILES_A_PART < most ? shared.count / LEAST_TILES_A_PART : most;
    tiles->plan.loop(tiles->plan.loop_context, shared.parts, advance_part, &shared);
    size_t changed = 0;
    for (size_t part = 0; part < shared.parts; part++) {
        snow_tile **from = shared.list + part_start(&shared, part);
        for (size_t i = 0; i < shared.changed[part]; i++)
            shared.list[changed++] = from[i];
    }
    return changed;
}

static void take_step(snow_tiles *tiles)
{
    tile_pass pass = {tiles->kernel, tiles->steps + 1, tiles->phase, tiles->plan.freezes};
    tile_list visited = tiles->active;
    tiles->visits += visited.count;
    if (tiles->plan.loop != NULL && visited.count >= 2 * LEAST_TILES_A_PART)
        visited.count = advance_together(tiles, &pass);
    else
        visited.count = tiles->kernel->advance(&pass, visited.tile, visited.count);
    tiles->active = tiles->changed;
    tiles->changed = visited;
    tiles->phase = 1 - tiles->phase;
    tiles->steps++;
}

snow_status snow_tiles_advance(snow_tiles *tiles, int64_t steps)
{
    int64_t end = tiles->steps + steps;
    while (tiles->steps < end) {
        snow_status status = wake(tiles);
        if (status != SNOW_OK)
            return status;
        if (tiles->active.count == 0)
            tiles->steps = end;
        else
            take_step(tiles);
    }
    return SNOW_OK;
}

bool snow_tiles_still(const snow_tiles *tiles)
{
    return tiles->changed.count == 0 && tiles->active.count == 0;
}
