#include "aggregate/clusters.h"

#include "aggregate/gaps.h"
#include "aggregate/power.h"

#include <string.h>

static int32_t side_of_box(double sites, int axes)
{
    int32_t side = 1;
    while ((double)side * side * (axes == 3 ? side : 1) < sites)
        side++;
    return side;
}

static bool is_large(const clusters *self, uint32_t mass)
{
    return mass >= SNOW_LARGE_CLUSTER && self->box.side >= SNOW_BOX_WORD;
}

/* Each touched site of a large cluster's step is listed once, those of small ones once for each particle. */
static size_t most_hits(const clusters *self)
{
    size_t particles = self->particles;
    return self->box.side < SNOW_BOX_WORD ? 6 * particles : particles + 6 * (size_t)SNOW_LARGE_CLUSTER;
}

static snow_status get_lists(clusters *self, snow_heap *heap)
{
    size_t particles = self->particles;
    struct {
        void **list;
        size_t count;
        size_t size;
    } lists[] = {
        {(void **)&self->position, particles, sizeof *self->position},
        {(void **)&self->home, particles, sizeof *self->home},
        {(void **)&self->member, 3 * particles, sizeof *self->member},
        {(void **)&self->spare, 3 * particles, sizeof *self->spare},
        {(void **)&self->cluster, particles, sizeof *self->cluster},
        {(void **)&self->measures, particles, sizeof *self->measures},
        {(void **)&self->live, particles, sizeof *self->live},
        {(void **)&self->large, particles, sizeof *self->large},
        {(void **)&self->touched, particles + 6, sizeof *self->touched},
        {(void **)&self->scratch, particles, sizeof *self->scratch},
        {(void **)&self->hit, most_hits(self), sizeof *self->hit},
    };
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++) {
        *lists[i].list = snow_heap_get(heap, lists[i].count, lists[i].size);
        if (*lists[i].list == NULL)
            return heap->refusal;
    }
    return SNOW_OK;
}

snow_status snow_clusters_start(clusters *self, snow_heap *heap, uint32_t particles, double density, int axes)
{
    *self = (clusters){.particles = particles, .least_drag = 1};
    double wanted = (double)particles / density;
    if (wanted > 0x1p31)
        return SNOW_ERROR_TOO_LARGE;
    size_t side = (size_t)side_of_box(wanted, axes);
    snow_status status = snow_box_start(&self->box, heap, (int32_t)side, axes);
    if (status == SNOW_OK) {
        self->owner = snow_heap_get(heap, side * side, (axes == 3 ? side : 1) * sizeof *self->owner);
        status = self->owner != NULL ? get_lists(self, heap) : heap->refusal;
    }
    if (status == SNOW_OK)
        status = snow_shape_maker_start(&self->maker, heap, &self->box);
    return status;
}

void snow_clusters_end(clusters *self, snow_heap *heap)
{
    for (uint32_t i = 0; self->cluster != NULL && i < self->particles; i++)
        snow_heap_put(heap, self->cluster[i].shape);
    snow_gaps_end(self, heap);
    snow_shape_maker_end(&self->maker, heap);
    snow_heap_put(heap, self->owner);
    snow_heap_put(heap, self->position);
    snow_heap_put(heap, self->home);
    snow_heap_put(heap, self->member);
    snow_heap_put(heap, self->spare);
    snow_heap_put(heap, self->cluster);
    snow_heap_put(heap, self->measures);
    snow_heap_put(heap, self->live);
    snow_heap_put(heap, self->large);
    snow_heap_put(heap, self->touched);
    snow_heap_put(heap, self->scratch);
    snow_heap_put(heap, self->hit);
    snow_box_end(&self->box, heap);
}

snow_site snow_clusters_site(const clusters *self, const cluster *of, snow_site position)
{
    return snow_box_site(&self->box, aggregate_moved(position, of->origin));
}

static uint32_t *owner_at(const clusters *self, snow_site site)
{
    return &self->owner[snow_box_number(&self->box, site)];
}

static bool is_same(snow_site a, snow_site b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* The member on a site of the box, as its place among the members; the mass when there is none. */
static uint32_t find_member(const clusters *self, const cluster *of, snow_site site)
{
    uint32_t i = 0;
    while (i < of->mass &&
           !is_same(site, snow_clusters_site(self, of, self->position[self->member[of->first + i]])))
        i++;
    return i;
}

/* Whether a cluster's bounds hold a site of the box. */
static bool may_hold(const clusters *self, const cluster *of, snow_site site)
{
    snow_site corner = snow_clusters_site(self, of, of->least);
    snow_site from = snow_box_site(&self->box, (snow_site){site.x - corner.x, site.y - corner.y, site.z - corner.z});
    return from.x <= of->greatest.x - of->least.x && from.y <= of->greatest.y - of->least.y &&
           from.z <= of->greatest.z - of->least.z;
}

uint32_t snow_clusters_at(const clusters *self, snow_site site)
{
    if (!snow_box_has(&self->box, site))
        return 0;
    if (*owner_at(self, site) != 0)
        return *owner_at(self, site);
    for (uint32_t i = 0; i < self->larges; i++) {
        const cluster *it = &self->cluster[self->large[i]];
        if (may_hold(self, it, site) && find_member(self, it, site) < it->mass)
            return self->large[i] + 1;
    }
    return 0;
}

static int32_t lesser(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static int32_t greater(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

void snow_clusters_count(clusters *self, cluster *to, uint32_t particle)
{
    snow_site at = self->position[particle];
    bool first = to->mass == 0;
    snow_site low = first ? at : to->least;
    snow_site high = first ? at : to->greatest;
    to->least = (snow_site){lesser(low.x, at.x), lesser(low.y, at.y), lesser(low.z, at.z)};
    to->greatest = (snow_site){greater(high.x, at.x), greater(high.y, at.y), greater(high.z, at.z)};
    int64_t x = at.x;
    int64_t y = at.y;
    int64_t z = at.z;
    cluster_measures *measures = &self->measures[to - self->cluster];
    measures->sum[0] += x;
    measures->sum[1] += y;
    measures->sum[2] += z;
    measures->squares += (uint64_t)(x * x + y * y + z * z);
    self->member[to->first + to->mass++] = particle;
    self->home[particle] = (uint32_t)(to - self->cluster);
}

static void settle_origin(const clusters *self, cluster *of)
{
    snow_site corner = snow_clusters_site(self, of, of->least);
    of->origin = (snow_site){corner.x - of->least.x, corner.y - of->least.y, corner.z - of->least.z};
}

static uint32_t room_for_members(const clusters *self)
{
    return 3 * self->particles;
}

/* Closes the gaps between the members of the clusters that there are. */
static void compact(clusters *self)
{
    uint32_t filled = 0;
    for (uint32_t i = 0; i < self->lives; i++) {
        cluster *it = &self->cluster[self->live[i]];
        memcpy(self->spare + filled, self->member + it->first, it->mass * sizeof *self->spare);
        it->first = filled;
        it->capacity = it->mass;
        filled += it->mass;
    }
    uint32_t *swap = self->member;
    self->member = self->spare;
    self->spare = swap;
    self->filled = filled;
}

cluster *snow_clusters_open(clusters *self, uint32_t number, uint32_t mass, snow_site origin, double mobility)
{
    if (self->filled + mass > room_for_members(self))
        compact(self); /* those that merged before the last particle came have taken room beyond their need */
    cluster *it = &self->cluster[number];
    *it = (cluster){.first = self->filled, .capacity = mass, .place = self->lives, .origin = origin};
    self->measures[number] = (cluster_measures){.drag = snow_power(mass, mobility)};
    self->filled += mass;
    self->live[self->lives++] = number;
    return it;
}

/* Marks the sites of a small cluster, lists a large one. */
void snow_clusters_close(clusters *self, cluster *it)
{
    uint32_t number = (uint32_t)(it - self->cluster);
    bool large = is_large(self, it->mass);
    for (uint32_t i = 0; i < it->mass; i++) {
        snow_site site = snow_clusters_site(self, it, self->position[self->member[it->first + i]]);
        *owner_at(self, site) = large ? 0 : number + 1;
    }
    if (large) {
        it->rank = self->larges;
        self->large[self->larges++] = number;
    }
    settle_origin(self, it);
    self->largest = it->mass > self->largest ? it->mass : self->largest;
}

void snow_clusters_add(clusters *self, uint32_t particle, snow_site site)
{
    cluster *it = snow_clusters_open(self, particle, 1, site, 0);
    self->position[particle] = (snow_site){0, 0, 0};
    snow_clusters_count(self, it, particle);
    snow_box_flip_site(&self->box, site);
    snow_clusters_close(self, it);
}

/* In ascending order. */
uint32_t snow_clusters_list(clusters *self, uint32_t count, uint32_t number)
{
    uint32_t place = count;
    while (place > 0 && self->touched[place - 1] > number)
        place--;
    if (place > 0 && self->touched[place - 1] == number)
        return count;
    memmove(self->touched + place + 1, self->touched + place, (count - place) * sizeof *self->touched);
    self->touched[place] = number;
    return count + 1;
}

uint32_t snow_clusters_find_neighbours(clusters *self, uint32_t number)
{
    const cluster *it = &self->cluster[number];
    snow_site site = snow_clusters_site(self, it, it->least);
    uint32_t count = 0;
    for (int side = 0; side < snow_box_directions(&self->box); side++) {
        uint32_t there = snow_clusters_at(self, snow_box_next(&self->box, site, side));
        if (there != 0 && there != number + 1)
            count = snow_clusters_list(self, count, there - 1);
    }
    return count;
}

static void note_hit(void *context, snow_site site)
{
    clusters *self = context;
    self->hit[self->hits++] = site;
}

/* Sites of others before the front of a small cluster and round that. */
static void find_hits(clusters *self, const cluster *moving, uint32_t mark, int direction)
{
    for (uint32_t i = 0; i < moving->mass; i++) {
        snow_site site = snow_clusters_site(self, moving, self->position[self->member[moving->first + i]]);
        snow_site next = snow_box_next(&self->box, site, direction);
        if (snow_box_has(&self->box, next)) {
            if (*owner_at(self, next) == mark)
                continue;
            note_hit(self, next);
        }
        for (int side = 0; side < snow_box_directions(&self->box); side++) {
            snow_site beside = snow_box_next(&self->box, next, side);
            if (snow_box_has(&self->box, beside) && *owner_at(self, beside) != mark)
                note_hit(self, beside);
        }
    }
}

/* Only those hits that stand in the way, if any does. */
static bool keep_obstructions(clusters *self, uint32_t mark, int direction)
{
    size_t kept = 0;
    for (size_t i = 0; i < self->hits; i++) {
        snow_site behind = snow_box_next(&self->box, self->hit[i], direction ^ 1);
        if (snow_clusters_at(self, behind) != mark)
            continue;
        snow_site swap = self->hit[kept];
        self->hit[kept++] = self->hit[i];
        self->hit[i] = swap;
    }
    self->hits = kept > 0 ? kept : self->hits;
    return kept > 0;
}

static void shift_small(clusters *self, const cluster *moving, uint32_t mark, int direction)
{
    for (uint32_t i = 0; i < moving->mass; i++) {
        self->scratch[i] = snow_clusters_site(self, moving, self->position[self->member[moving->first + i]]);
        *owner_at(self, self->scratch[i]) = 0;
        snow_box_flip_site(&self->box, self->scratch[i]);
    }
    for (uint32_t i = 0; i < moving->mass; i++) {
        snow_site next = snow_box_next(&self->box, self->scratch[i], direction);
        *owner_at(self, next) = mark;
        snow_box_flip_site(&self->box, next);
    }
}

void snow_clusters_flip(const clusters *self, const cluster *of, const torus *set)
{
    for (uint32_t i = 0; i < of->mass; i++)
        snow_box_flip_site(set, snow_clusters_site(self, of, self->position[self->member[of->first + i]]));
}

static snow_status give_shape(clusters *self, snow_heap *heap, cluster *it)
{
    if (it->shape != NULL)
        return SNOW_OK;
    for (uint32_t i = 0; i < it->mass; i++) {
        snow_site at = self->position[self->member[it->first + i]];
        self->scratch[i] = snow_box_site(
            &self->box, (snow_site){at.x - it->least.x, at.y - it->least.y, at.z - it->least.z});
    }
    snow_site extent = {it->greatest.x - it->least.x + 1, it->greatest.y - it->least.y + 1,
                        it->greatest.z - it->least.z + 1};
    return snow_shape_make(&self->maker, heap, &self->box, self->scratch, it->mass, extent, &it->shape);
}

static void take_step(const clusters *self, cluster *moving, int direction)
{
    moving->origin = aggregate_moved(moving->origin, snow_box_steps[direction]);
    settle_origin(self, moving);
}

snow_status snow_clusters_move(clusters *self, snow_heap *heap, uint32_t number, int direction, bool may_rest,
                               uint32_t *count)
{
    cluster *moving = &self->cluster[number];
    uint32_t mark = number + 1;
    bool large = is_large(self, moving->mass);
    snow_status status = large ? give_shape(self, heap, moving) : SNOW_OK;
    if (status != SNOW_OK)
        return status;
    snow_site corner = snow_clusters_site(self, moving, moving->least);
    self->hits = 0;
    if (large)
        snow_shape_find_touched(moving->shape, &self->maker, &self->box, corner, direction, note_hit, self);
    else
        find_hits(self, moving, mark, direction);
    bool blocked = may_rest && self->hits > 0 && keep_obstructions(self, mark, direction);
    *count = 0;
    for (size_t i = 0; i < self->hits; i++)
        *count = snow_clusters_list(self, *count, snow_clusters_at(self, self->hit[i]) - 1);
    if (blocked)
        return SNOW_OK;
    if (large)
        snow_shape_step(moving->shape, &self->maker, &self->box, corner, direction);
    else
        shift_small(self, moving, mark, direction);
    take_step(self, moving, direction);
    return SNOW_OK;
}

snow_status snow_clusters_move_few(clusters *self, snow_heap *heap, uint32_t number, int direction, uint32_t *count)
{
    snow_status status = snow_gaps_find_touched(self, heap, number, direction, count);
    if (status != SNOW_OK)
        return status;
    take_step(self, &self->cluster[number], direction);
    self->stale = true;
    if (*count > 0)
        snow_clusters_show(self);
    return SNOW_OK;
}

void snow_clusters_show(clusters *self)
{
    if (!self->stale)
        return;
    snow_box_clear(&self->box);
    for (uint32_t i = 0; i < self->lives; i++)
        snow_clusters_flip(self, &self->cluster[self->live[i]], &self->box);
    self->stale = false;
}

/* Room for so many members more, twice what is needed where there is that much. */
static void widen(clusters *self, cluster *it, uint32_t more)
{
    uint32_t wanted = it->mass + more;
    if (wanted <= it->capacity)
        return;
    uint32_t end = room_for_members(self);
    if (self->filled + wanted > end)
        compact(self);
    uint32_t capacity = wanted <= (end - self->filled) / 2 ? 2 * wanted : wanted;
    memmove(self->member + self->filled, self->member + it->first, it->mass * sizeof *self->member);
    it->first = self->filled;
    it->capacity = capacity;
    self->filled += capacity;
}

/* A member of the large cluster beside a particle of the small one. */
typedef struct contact {
    snow_site position; /* of that particle */
    uint32_t member;
    int direction; /* from it to the member */
} contact;

/* The small cluster's own sites are in the scratch set. */
static contact find_contact(const clusters *self, const cluster *large, const cluster *small)
{
    for (uint32_t i = 0; i < small->mass; i++) {
        snow_site position = self->position[self->member[small->first + i]];
        snow_site site = snow_clusters_site(self, small, position);
        for (int side = 0; side < snow_box_directions(&self->box); side++) {
            snow_site next = snow_box_next(&self->box, site, side);
            if (!snow_box_has(&self->box, next) || snow_box_has(&self->maker.own, next) ||
                !may_hold(self, large, next))
                continue;
            uint32_t member = find_member(self, large, next);
            if (member < large->mass)
                return (contact){position, member, side};
        }
    }
    return (contact){small->least, large->mass, 0};
}

/* What must be added to the small cluster's positions to have them in the large one's frame. */
static snow_site find_shift(const clusters *self, const cluster *large, const cluster *small)
{
    snow_clusters_flip(self, small, &self->maker.own);
    contact found = find_contact(self, large, small);
    snow_clusters_flip(self, small, &self->maker.own);
    if (found.member == large->mass)
        return (snow_site){0, 0, 0};
    snow_site there = self->position[self->member[large->first + found.member]];
    snow_site step = snow_box_steps[found.direction];
    return (snow_site){there.x - step.x - found.position.x, there.y - step.y - found.position.y,
                       there.z - step.z - found.position.z};
}

static void strike_out(clusters *self, cluster *it, bool large)
{
    uint32_t last = self->live[--self->lives];
    self->live[it->place] = last;
    self->cluster[last].place = it->place;
    if (large) {
        last = self->large[--self->larges];
        self->large[it->rank] = last;
        self->cluster[last].rank = it->rank;
    }
    it->mass = 0;
}

static void take_over(clusters *self, cluster *large, cluster *small)
{
    snow_site by = find_shift(self, large, small);
    for (uint32_t i = 0; i < small->mass; i++) {
        uint32_t particle = self->member[small->first + i];
        self->position[particle] = aggregate_moved(self->position[particle], by);
        snow_clusters_count(self, large, particle);
    }
}

/* Owners of the sites of a cluster that was small until now, or takes over another small one. */
static void renew_owners(clusters *self, cluster *it, uint32_t first, bool large)
{
    uint32_t number = (uint32_t)(it - self->cluster);
    for (uint32_t i = first; i < it->mass; i++) {
        snow_site site = snow_clusters_site(self, it, self->position[self->member[it->first + i]]);
        *owner_at(self, site) = large ? 0 : number + 1;
    }
}

uint32_t snow_clusters_merge(clusters *self, snow_heap *heap, uint32_t a, uint32_t b, double mobility)
{
    uint32_t number = self->cluster[a].mass >= self->cluster[b].mass ? a : b;
    cluster *large = &self->cluster[number];
    cluster *small = &self->cluster[number == a ? b : a];
    uint32_t before = large->mass;
    bool was_large = is_large(self, before);
    bool lost_large = is_large(self, small->mass);
    widen(self, large, small->mass);
    take_over(self, large, small);
    bool now_large = is_large(self, large->mass);
    renew_owners(self, large, was_large == now_large ? before : 0, now_large);
    snow_heap_put(heap, large->shape);
    snow_heap_put(heap, small->shape);
    large->shape = NULL;
    small->shape = NULL;
    strike_out(self, small, lost_large);
    if (now_large && !was_large) {
        large->rank = self->larges;
        self->large[self->larges++] = number;
    }
    settle_origin(self, large);
    self->measures[number].drag = snow_power(large->mass, mobility);
    self->largest = large->mass > self->largest ? large->mass : self->largest;
    return number;
}
