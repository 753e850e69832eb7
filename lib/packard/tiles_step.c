/* Steps: which tiles to visit, and the visits. */
#include "packard/tiles_plane.h"

#include <string.h>

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

static bool sees_nothing(const snow_tiles *tiles, const snow_tile *tile, const tile_views *views)
{
    bool missing = false;
    for (int direction = 0; direction < TILE_DIRECTIONS; direction++)
        missing |= views->seen[direction] & (tile->beside[direction] == tiles->nothing);
    return missing;
}

/* Puts a tile that is not in a list yet at its end, and tells how much longer the list is. There are no branches in
   these two, nor in what calls them: nobody could foretell them. */
static inline size_t enlist_active(snow_tile **end, snow_tile *tile, bool wanted)
{
    *end = tile;
    uint8_t active = atomic_load_explicit(&tile->active, memory_order_relaxed);
    atomic_store_explicit(&tile->active, (uint8_t)(active | wanted), memory_order_relaxed);
    return wanted & !active;
}

static inline size_t enlist_uncounted(snow_tile **end, snow_tile *tile)
{
    *end = tile;
    bool add = !(tile->state & TILE_UNCOUNTED);
    tile->state |= TILE_UNCOUNTED;
    return add;
}

/* Wakes a tile that changed, and those neighbours that see it. */
static snow_status wake_around(snow_tiles *tiles, snow_tile *tile)
{
    tile_views views = views_of(tile, tiles->phase);
    if (sees_nothing(tiles, tile, &views)) {
        snow_status status = provide_viewers(tiles, tile, &views);
        if (status != SNOW_OK)
            return status;
    }
    tile_list *active = &tiles->active;
    tile_list *uncounted = &tiles->uncounted;
    if (!tile_list_reserve(tiles->heap, active, 1 + TILE_DIRECTIONS) || !tile_list_reserve(tiles->heap, uncounted, 1))
        return tiles->heap->refusal;
    uncounted->count += enlist_uncounted(uncounted->tile + uncounted->count, tile);
    active->count += enlist_active(active->tile + active->count, tile, true);
    for (int direction = 0; direction < TILE_DIRECTIONS; direction++)
        active->count +=
            enlist_active(active->tile + active->count, tile->beside[direction], views.seen[direction]);
    return SNOW_OK;
}

/* Parts of a list of tiles, each one thread's. Few and always the same: so a tile stays in the caches of one. */
enum { MOST_PARTS = 256, LEAST_TILES_A_PART = 128 };

static size_t parts_of(const snow_tiles *tiles, const tile_list *list)
{
    size_t most = (size_t)tiles->plan.threads < MOST_PARTS ? (size_t)tiles->plan.threads : MOST_PARTS;
    size_t parts = list->count / LEAST_TILES_A_PART < most ? list->count / LEAST_TILES_A_PART : most;
    return tiles->plan.loop != NULL && parts > 1 ? parts : 1;
}

static size_t part_begin(const tile_list *list, size_t parts, size_t part)
{
    return list->count * part / parts;
}

/* Changed tiles that are woken together. Each part has places of its own at the ends of the other lists, as many as
   it may need. */
typedef struct shared_wake {
    snow_tiles *tiles;
    size_t parts;
    size_t lonely[MOST_PARTS]; /* tiles at the front of the part that show a change where there is no tile */
    size_t active[MOST_PARTS], uncounted[MOST_PARTS]; /* how many were put there */
} shared_wake;

enum { MOST_WOKEN = 1 + TILE_DIRECTIONS };

/* The same for a list that other threads lengthen by the same tiles. */
static inline size_t claim_active(snow_tile **end, snow_tile *tile)
{
    if (atomic_load_explicit(&tile->active, memory_order_relaxed) != 0 ||
        atomic_exchange_explicit(&tile->active, 1, memory_order_relaxed) != 0)
        return 0;
    *end = tile;
    return 1;
}

/* A snow_task. */
static void wake_part(void *argument, size_t part)
{
    shared_wake *shared = argument;
    snow_tiles *tiles = shared->tiles;
    size_t begin = part_begin(&tiles->changed, shared->parts, part);
    size_t end = part_begin(&tiles->changed, shared->parts, part + 1);
    snow_tile **list = tiles->changed.tile;
    snow_tile **active = tiles->active.tile + tiles->active.count + MOST_WOKEN * begin;
    snow_tile **uncounted = tiles->uncounted.tile + tiles->uncounted.count + begin;
    size_t lonely = 0, woken = 0, noted = 0;
    for (size_t i = begin; i < end; i++) {
        snow_tile *tile = list[i];
        tile_views views = views_of(tile, tiles->phase);
        if (sees_nothing(tiles, tile, &views)) {
            list[i] = list[begin + lonely];
            list[begin + lonely++] = tile;
            continue;
        }
        noted += enlist_uncounted(uncounted + noted, tile);
        woken += claim_active(active + woken, tile);
        for (int direction = 0; direction < TILE_DIRECTIONS; direction++)
            if (views.seen[direction])
                woken += claim_active(active + woken, tile->beside[direction]);
    }
    shared->lonely[part] = lonely;
    shared->active[part] = woken;
    shared->uncounted[part] = noted;
}

/* Moves what the parts put at the end of a list together; each had so many places for each of its tiles. */
static void close_gaps(const snow_tiles *tiles, tile_list *list, const size_t *counts, size_t parts, size_t places)
{
    snow_tile **from = list->tile + list->count;
    for (size_t part = 0; part < parts; part++) {
        snow_tile **put = from + places * part_begin(&tiles->changed, parts, part);
        memmove(list->tile + list->count, put, counts[part] * sizeof *put);
        list->count += counts[part];
    }
}

static snow_status wake_together(snow_tiles *tiles, size_t parts)
{
    shared_wake shared = {.tiles = tiles, .parts = parts};
    size_t changed = tiles->changed.count;
    if (!tile_list_reserve(tiles->heap, &tiles->active, MOST_WOKEN * changed) ||
        !tile_list_reserve(tiles->heap, &tiles->uncounted, changed))
        return tiles->heap->refusal;
    tiles->plan.loop(tiles->plan.loop_context, parts, wake_part, &shared);
    close_gaps(tiles, &tiles->active, shared.active, parts, MOST_WOKEN);
    close_gaps(tiles, &tiles->uncounted, shared.uncounted, parts, 1);
    for (size_t part = 0; part < parts; part++) {
        snow_tile **lonely = tiles->changed.tile + part_begin(&tiles->changed, parts, part);
        for (size_t i = 0; i < shared.lonely[part]; i++) {
            snow_status status = wake_around(tiles, lonely[i]);
            if (status != SNOW_OK)
                return status;
        }
    }
    return SNOW_OK;
}

/* May be repeated after a failure. The next step visits the tiles that changed, and takes note of those that do again. */
static snow_status wake(snow_tiles *tiles)
{
    size_t parts = parts_of(tiles, &tiles->changed);
    snow_status status = parts > 1 ? wake_together(tiles, parts) : SNOW_OK;
    for (size_t i = 0; parts == 1 && status == SNOW_OK && i < tiles->changed.count; i++)
        status = wake_around(tiles, tiles->changed.tile[i]);
    if (status == SNOW_OK)
        tiles->changed.count = 0;
    return status;
}

/* Active tiles that take a step together. */
typedef struct shared_pass {
    tile_pass pass;
    const tile_list *list;
    size_t parts;
    size_t changed[MOST_PARTS];
} shared_pass;

/* A snow_task. */
static void advance_part(void *argument, size_t part)
{
    shared_pass *shared = argument;
    size_t begin = part_begin(shared->list, shared->parts, part);
    size_t end = part_begin(shared->list, shared->parts, part + 1);
    shared->changed[part] =
        shared->pass.kernel->advance(&shared->pass, shared->list->tile + begin, end - begin);
}

static size_t advance_together(const snow_tiles *tiles, const tile_pass *pass, size_t parts)
{
    const tile_list *list = &tiles->active;
    shared_pass shared = {.pass = *pass, .list = list, .parts = parts};
    tiles->plan.loop(tiles->plan.loop_context, parts, advance_part, &shared);
    size_t changed = 0;
    for (size_t part = 0; part < parts; part++) {
        memmove(list->tile + changed, list->tile + part_begin(list, parts, part),
                shared.changed[part] * sizeof *list->tile);
        changed += shared.changed[part];
    }
    return changed;
}

static void take_step(snow_tiles *tiles)
{
    tile_pass pass = {tiles->kernel, tiles->steps + 1, tiles->phase, tiles->plan.freezes};
    tile_list visited = tiles->active;
    tiles->visits += visited.count;
    size_t parts = parts_of(tiles, &visited);
    visited.count = parts > 1 ? advance_together(tiles, &pass, parts)
                              : tiles->kernel->advance(&pass, visited.tile, visited.count);
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
