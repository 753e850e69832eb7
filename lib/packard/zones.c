/* Zones: which cells they have, and in which steps they apply. */
#include "base/floating.h"
#include "base/hexagon.h"
#include "base/structs.h"
#include "packard/model.h"

#include <string.h>

/* How far beyond its angle a cell may lie, as a part of 1: corners and middles
   of sides lie at angles that no double holds. */
static const double slack = 1.0 + 0x1p-40;

static const double root_of_three = 1.7320508075688772;

void snow_packard_zone_init(snow_packard_zone *zone, size_t struct_size, snow_packard_zone_kind kind,
                            snow_packard_zone_shape shape)
{
    const snow_packard_zone defaults = {
        .struct_size = sizeof defaults,
        .kind = kind,
        .shape = shape,
        .first_step = 1,
        .last_step = SNOW_PACKARD_FOREVER,
        .outer = INT32_MAX,
    };
    snow_struct_init(zone, struct_size, &defaults, sizeof defaults);
}

/* Of an angle up to 30 degrees, by the power series of sine and cosine: the
   same bits everywhere, which libm does not promise. */
static double tangent_of(double degrees)
{
    double angle = degrees * (3.14159265358979324 / 180.0);
    double sine = 0;
    double cosine = 0;
    double term = 1;
    for (int n = 0; n < 20; n += 2) {
        cosine += n % 4 == 0 ? term : -term;
        term = term * angle / (n + 1);
        sine += n % 4 == 0 ? term : -term;
        term = term * angle / (n + 2);
    }
    return sine / cosine;
}

/* The image of a cell, relative to the centre, in the sector 0 <= r <= q
   between a corner's direction (r = 0) and a side's middle (r = q). */
static void fold(int64_t *q, int64_t *r)
{
    int64_t part[3] = {snow_hexagon_magnitude(*q), snow_hexagon_magnitude(*r), snow_hexagon_magnitude(*q + *r)};
    int64_t distance = snow_hexagon_distance(*q, *r);
    int64_t least = part[0] < part[1] ? part[0] : part[1];
    least = part[2] < least ? part[2] : least;
    *q = distance - least;
    *r = least;
}

static bool is_in_sector(const packard_zone *zone, int64_t q, int64_t r)
{
    q -= zone->centre.q;
    r -= zone->centre.r;
    fold(&q, &r);
    if (q + r < zone->inner || q + r > zone->outer)
        return false;
    bool corner = zone->shape == SNOW_PACKARD_CORNERS;
    if (zone->half_cells >= 0)
        return (corner ? 2 * r : q - r) <= zone->half_cells;
    double across = corner ? root_of_three * (double)r : (double)(q - r);
    double along = corner ? (double)(2 * q + r) : root_of_three * (double)(q + r);
    return across <= zone->tangent * along * slack;
}

static bool is_in_cells(const packard_zone *zone, int64_t q, int64_t r)
{
    const snow_rect *rect = &zone->rect;
    int64_t x = q - rect->q;
    int64_t y = r - rect->r;
    if (x < 0 || x >= rect->width || y < 0 || y >= rect->height)
        return false;
    if (zone->cells == NULL)
        return true;
    const uint64_t *row = zone->cells + (size_t)y * packard_words((uint64_t)rect->width);
    return (row[x / PACKARD_WORD] >> (x % PACKARD_WORD) & 1) != 0;
}

/* The least and the greatest magnitude in a range of numbers. */
static void magnitudes(int64_t first, int64_t last, int64_t *least, int64_t *greatest)
{
    int64_t a = snow_hexagon_magnitude(first);
    int64_t b = snow_hexagon_magnitude(last);
    *greatest = a > b ? a : b;
    *least = first <= 0 && last >= 0 ? 0 : a < b ? a : b;
}

/* Whether cells of a region may be in a zone; where it says no, none is. */
static bool may_meet(const packard_zone *zone, const packard_region *region)
{
    int64_t end_q = region->q + region->width;
    int64_t end_r = region->r + region->height;
    const snow_rect *rect = &zone->rect;
    if (zone->inverted)
        return true;
    if (zone->shape == SNOW_PACKARD_CELLS)
        return region->q < (int64_t)rect->q + rect->width && end_q > rect->q &&
               region->r < (int64_t)rect->r + rect->height && end_r > rect->r;
    int64_t q = region->q - zone->centre.q;
    int64_t r = region->r - zone->centre.r;
    int64_t least[3], greatest[3];
    magnitudes(q, q + region->width - 1, &least[0], &greatest[0]);
    magnitudes(r, r + region->height - 1, &least[1], &greatest[1]);
    magnitudes(q + r, q + r + region->width + region->height - 2, &least[2], &greatest[2]);
    bool beyond = false;
    bool reaches = false;
    bool axis = zone->shape == SNOW_PACKARD_SIDES || zone->half_cells < 0;
    for (int i = 0; i < 3; i++) {
        beyond = beyond || least[i] > zone->outer;
        reaches = reaches || greatest[i] >= zone->inner;
        axis = axis || 2 * least[i] <= zone->half_cells;
    }
    return !beyond && reaches && axis;
}

static bool applies(const packard_zone *zone, int64_t step)
{
    return step >= zone->first_step && step <= zone->last_step;
}

unsigned snow_packard_zones_at(const packard *model, int64_t step, int64_t q, int64_t r)
{
    unsigned demands = 0;
    for (size_t i = 0; i < model->zone_count; i++) {
        const packard_zone *zone = &model->zones[i];
        if (!applies(zone, step))
            continue;
        bool named = zone->shape == SNOW_PACKARD_CELLS ? is_in_cells(zone, q, r) : is_in_sector(zone, q, r);
        if (named != zone->inverted)
            demands |= zone->kind == SNOW_PACKARD_RESTRICTION ? PACKARD_RESTRICTED : PACKARD_PREFERRED;
    }
    return demands;
}

bool snow_packard_zones_touch(const packard *model, int64_t step, const packard_region *region)
{
    for (size_t i = 0; i < model->zone_count; i++)
        if (applies(&model->zones[i], step) && may_meet(&model->zones[i], region))
            return true;
    return false;
}

bool snow_packard_zones_apply(const packard *model, int64_t step)
{
    for (size_t i = 0; i < model->zone_count; i++)
        if (applies(&model->zones[i], step))
            return true;
    return false;
}

int64_t snow_packard_zones_last(const packard *model, int64_t step)
{
    int64_t last = SNOW_PACKARD_FOREVER;
    for (size_t i = 0; i < model->zone_count; i++) {
        const packard_zone *zone = &model->zones[i];
        int64_t change = step < zone->first_step ? zone->first_step - 1 : zone->last_step;
        if (step <= zone->last_step && change < last)
            last = change;
    }
    return last;
}

/* Where nothing freezes any more, only the end of a restriction or the
   beginning of a priority can change that. */
bool snow_packard_zones_pend(const packard *model, int64_t step)
{
    for (size_t i = 0; i < model->zone_count; i++) {
        const packard_zone *zone = &model->zones[i];
        bool ends = zone->kind == SNOW_PACKARD_RESTRICTION && applies(zone, step) &&
                    zone->last_step != SNOW_PACKARD_FOREVER;
        bool begins = zone->kind == SNOW_PACKARD_PRIORITY && step < zone->first_step;
        if (ends || begins)
            return true;
    }
    return false;
}

bool snow_packard_zones_are_symmetric(const packard *model, int64_t q, int64_t r)
{
    for (size_t i = 0; i < model->zone_count; i++) {
        const packard_zone *zone = &model->zones[i];
        if (zone->shape == SNOW_PACKARD_CELLS || zone->centre.q != q || zone->centre.r != r)
            return false;
    }
    return true;
}

static snow_status check(const snow_packard_zone *zone)
{
    if (zone->kind < SNOW_PACKARD_RESTRICTION || zone->kind > SNOW_PACKARD_PRIORITY ||
        zone->shape < SNOW_PACKARD_CORNERS || zone->shape > SNOW_PACKARD_CELLS)
        return SNOW_ERROR_ENUM;
    if (!snow_is_flag(zone->inverted))
        return SNOW_ERROR_RANGE;
    if (!isfinite(zone->half_width) || !isfinite(zone->half_angle))
        return SNOW_ERROR_NOT_FINITE;
    if (zone->rect.width < 0 || zone->rect.height < 0 ||
        (int64_t)zone->rect.q + zone->rect.width > (int64_t)INT32_MAX + 1 ||
        (int64_t)zone->rect.r + zone->rect.height > (int64_t)INT32_MAX + 1)
        return SNOW_ERROR_RECTANGLE;
    bool sound = zone->half_width >= 0 && zone->half_angle >= 0 && zone->half_angle <= 30 && zone->inner >= 0 &&
                 zone->outer >= 0 && zone->first_step >= 1 && zone->first_step <= zone->last_step &&
                 (zone->mask == NULL || zone->contains == NULL);
    return sound ? SNOW_OK : SNOW_ERROR_PACKARD_ZONE;
}

static bool is_named(const snow_packard_zone *zone, int32_t x, int32_t y)
{
    if (zone->mask != NULL)
        return zone->mask[(size_t)y * (size_t)zone->rect.width + (size_t)x] != 0;
    return zone->contains(zone->contains_context, zone->rect.q + x, zone->rect.r + y) != 0;
}

static snow_status copy_cells(const snow_packard_zone *zone, snow_heap *heap, packard_zone *copy)
{
    if (zone->shape != SNOW_PACKARD_CELLS || (zone->mask == NULL && zone->contains == NULL))
        return SNOW_OK;
    size_t words = packard_words((uint64_t)zone->rect.width);
    size_t rows = (size_t)zone->rect.height;
    if (words == 0 || rows == 0)
        return SNOW_OK;
    if (rows > SIZE_MAX / words)
        return SNOW_ERROR_TOO_LARGE;
    copy->cells = snow_heap_get(heap, rows * words, sizeof *copy->cells);
    if (copy->cells == NULL)
        return heap->refusal;
    for (int32_t y = 0; y < zone->rect.height; y++)
        for (int32_t x = 0; x < zone->rect.width; x++)
            if (is_named(zone, x, y))
                copy->cells[(size_t)y * words + (size_t)x / PACKARD_WORD] |= UINT64_C(1) << (x % PACKARD_WORD);
    return SNOW_OK;
}

/* Wider than any crystal is as good as without end. */
static int64_t half_cells_of(double half_width)
{
    return half_width < 0x1p61 ? (int64_t)(2 * half_width) : INT64_MAX;
}

snow_status snow_packard_zone_read(const snow_packard_zone *zone, snow_heap *heap, packard_zone *copy)
{
    snow_status status = check(zone);
    if (status != SNOW_OK)
        return status;
    *copy = (packard_zone){
        .kind = zone->kind,
        .shape = zone->shape,
        .first_step = zone->first_step,
        .last_step = zone->last_step,
        .centre = zone->centre,
        .half_cells = zone->half_angle > 0 ? -1 : half_cells_of(zone->half_width),
        .half_angle = zone->half_angle,
        .tangent = tangent_of(zone->half_angle),
        .inner = zone->inner,
        .outer = zone->outer == INT32_MAX ? INT64_MAX : zone->outer,
        .inverted = zone->inverted != 0,
        .rect = zone->rect,
    };
    return copy_cells(zone, heap, copy);
}

static snow_status make_room(snow_grid *grid)
{
    packard *model = packard_of(grid);
    if (model->zone_count < model->zone_room)
        return SNOW_OK;
    size_t room = model->zone_room == 0 ? 4 : 2 * model->zone_room;
    packard_zone *zones = snow_heap_get(&grid->heap, room, sizeof *zones);
    if (zones == NULL)
        return grid->heap.refusal;
    if (model->zone_count > 0)
        memcpy(zones, model->zones, model->zone_count * sizeof *zones);
    snow_heap_put(&grid->heap, model->zones);
    model->zones = zones;
    model->zone_room = room;
    return SNOW_OK;
}

snow_status snow_packard_zone_keep(snow_grid *grid, const packard_zone *zone)
{
    packard *model = packard_of(grid);
    snow_status status = make_room(grid);
    if (status != SNOW_OK)
        return status;
    model->zones[model->zone_count++] = *zone;
    if (!snow_packard_zones_are_symmetric(model, model->fold.q, model->fold.r))
        status = snow_packard_unfold(grid);
    if (status != SNOW_OK) {
        model->zone_count--;
        return status;
    }
    model->zones_last = 0; /* the engine's are out of date */
    grid->census.still = false;
    return SNOW_OK;
}

void snow_packard_zones_end(snow_grid *grid)
{
    packard *model = packard_of(grid);
    for (size_t i = 0; i < model->zone_count; i++)
        snow_heap_put(&grid->heap, model->zones[i].cells);
    snow_heap_put(&grid->heap, model->zones);
}

snow_status snow_packard_add_zone(snow_grid *grid, const snow_packard_zone *caller)
{
    snow_status status = packard_check(grid);
    if (status != SNOW_OK)
        return status;
    if (caller == NULL)
        return SNOW_ERROR_NULL;
    if (grid->busy)
        return SNOW_ERROR_BUSY;
    snow_packard_zone zone;
    status = snow_struct_take(&zone, sizeof zone, caller);
    if (status != SNOW_OK)
        return status;
    packard_zone copy = {.cells = NULL};
    snow_floating floating;
    snow_floating_enter(&floating);
    status = snow_packard_zone_read(&zone, &grid->heap, &copy);
    snow_floating_leave(&floating);
    if (status == SNOW_OK)
        status = snow_packard_zone_keep(grid, &copy);
    if (status != SNOW_OK)
        snow_heap_put(&grid->heap, copy.cells);
    return status;
}
