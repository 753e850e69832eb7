#include "walks.h"

#include <math.h>
#include <stdlib.h>

struct walks {
    int32_t half;  /* the maps' half side */
    double radius; /* of the cluster */
    double launch;
    uint8_t *ends;    /* next to the cluster */
    float *clearance; /* distance to the nearest site where a walk ends */
    uint64_t random;
};

static const double turn = 6.28318530717958647693;

static size_t index_of(const walks *self, int32_t x, int32_t y)
{
    size_t side = 2 * (size_t)self->half + 1;
    return (size_t)(y + self->half) * side + (size_t)(x + self->half);
}

static void measure_clearance(walks *self, int32_t x, int32_t y)
{
    int32_t reach = (int32_t)self->radius + 1;
    double nearest = HUGE_VAL;
    for (int32_t v = -reach; v <= reach; v++)
        for (int32_t u = -reach; u <= reach; u++)
            if (self->ends[index_of(self, u, v)])
                nearest = fmin(nearest, hypot(x - u, y - v));
    self->clearance[index_of(self, x, y)] = (float)nearest;
}

walks *walks_start(const snow_site *sites, size_t count)
{
    walks *self = calloc(1, sizeof *self);
    if (self == NULL)
        return NULL;
    self->random = UINT64_C(88172645463325252);
    for (size_t i = 0; i < count; i++)
        self->radius = fmax(self->radius, hypot(sites[i].x, sites[i].y));
    self->launch = self->radius + 2;
    self->half = 2 * (int32_t)self->launch + 4;
    size_t cells = index_of(self, self->half, self->half) + 1;
    self->ends = calloc(cells, sizeof *self->ends);
    self->clearance = calloc(cells, sizeof *self->clearance);
    if (self->ends == NULL || self->clearance == NULL) {
        walks_end(self);
        return NULL;
    }
    for (size_t i = 0; i < count; i++) {
        self->ends[index_of(self, sites[i].x + 1, sites[i].y)] = 1;
        self->ends[index_of(self, sites[i].x - 1, sites[i].y)] = 1;
        self->ends[index_of(self, sites[i].x, sites[i].y + 1)] = 1;
        self->ends[index_of(self, sites[i].x, sites[i].y - 1)] = 1;
    }
    for (int32_t y = -self->half; y <= self->half; y++)
        for (int32_t x = -self->half; x <= self->half; x++)
            measure_clearance(self, x, y);
    return self;
}

void walks_end(walks *self)
{
    if (self == NULL)
        return;
    free(self->clearance);
    free(self->ends);
    free(self);
}

/* G. Marsaglia, Xorshift RNGs, J. Stat. Softw. 8 (2003) 14; times an odd number. */
static uint64_t draw(walks *self)
{
    self->random ^= self->random >> 12;
    self->random ^= self->random << 25;
    self->random ^= self->random >> 27;
    return self->random * UINT64_C(2685821657736338717);
}

static double uniform(walks *self)
{
    return (double)(draw(self) >> 11) * 0x1p-53;
}

static snow_site on_circle(walks *self, double x, double y, double radius)
{
    double angle = turn * uniform(self);
    return (snow_site){(int32_t)lrint(x + radius * cos(angle)), (int32_t)lrint(y + radius * sin(angle)), 0};
}

static snow_site step_from(walks *self, snow_site site)
{
    switch (draw(self) >> 62) {
    case 0: site.x++; break;
    case 1: site.x--; break;
    case 2: site.y++; break;
    default: site.y--; break;
    }
    return site;
}

static double square_of(snow_site site)
{
    return (double)site.x * site.x + (double)site.y * site.y;
}

static int is_mapped(const walks *self, snow_site site)
{
    return abs(site.x) <= self->half && abs(site.y) <= self->half;
}

snow_site walks_step(walks *self, double kill)
{
    double farthest = kill * self->radius * kill * self->radius;
    snow_site at = on_circle(self, 0, 0, self->launch);
    while (!is_mapped(self, at) || !self->ends[index_of(self, at.x, at.y)]) {
        at = step_from(self, at);
        if (square_of(at) > farthest)
            at = on_circle(self, 0, 0, self->launch);
    }
    return at;
}

/* Poisson's kernel of the circle's outside, by its inverse. */
static snow_site brought_back(walks *self, snow_site from)
{
    double ratio = sqrt(square_of(from)) / self->launch;
    double angle = 2 * atan((ratio - 1) / (ratio + 1) * tan(turn / 2 * (uniform(self) - 0.5)));
    angle += atan2(from.y, from.x);
    return (snow_site){(int32_t)lrint(self->launch * cos(angle)), (int32_t)lrint(self->launch * sin(angle)), 0};
}

snow_site walks_jump(walks *self)
{
    snow_site at = on_circle(self, 0, 0, self->launch);
    for (;;) {
        if (!is_mapped(self, at) || square_of(at) > 4 * self->launch * self->launch) {
            at = brought_back(self, at);
            continue;
        }
        size_t index = index_of(self, at.x, at.y);
        if (self->ends[index])
            return at;
        double clearance = self->clearance[index];
        at = clearance >= 3 ? on_circle(self, at.x, at.y, clearance - 1) : step_from(self, at);
    }
}
