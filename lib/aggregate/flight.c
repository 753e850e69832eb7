#include "aggregate/flight.h"

/* One body for all lattices and ways of walking: what is constant in a call
   is constant in the copy that the compiler makes for it. */
#if defined(__GNUC__)
#define COPIED static inline __attribute__((always_inline))
#define RARE(condition) __builtin_expect(condition, 0)
#else
#define COPIED static inline
#define RARE(condition) (condition)
#endif

static const int step_x[3][6] = {{1, -1, 0, 0, 0, 0}, {1, 0, -1, -1, 0, 1}, {1, -1, 0, 0, 0, 0}};
static const int step_y[3][6] = {{0, 0, 1, -1, 0, 0}, {0, 1, 1, 0, -1, -1}, {0, 0, 1, -1, 0, 0}};
static const int step_z[3][6] = {{0}, {0}, {0, 0, 0, 0, 1, -1}};

/* From the centre of a hexagon to its corners. */
static const int corner_q[6] = {1, 0, -1, -1, 0, 1};
static const int corner_r[6] = {0, 1, 1, 0, -1, -1};
/* From a corner to the next one. */
static const int side_q[6] = {-1, -1, 0, 1, 1, 0};
static const int side_r[6] = {1, 0, -1, -1, 0, 1};

COPIED int ways(snow_aggregate_lattice lattice)
{
    return lattice == SNOW_AGGREGATE_SQUARE ? 4 : 6;
}

COPIED int look(const snow_ground *ground, snow_aggregate_lattice lattice, snow_site site)
{
    if (lattice == SNOW_AGGREGATE_CUBIC)
        return snow_space_map_look(&ground->space, site.x, site.y, site.z);
    return snow_plane_map_look(&ground->plane, site.x, site.y);
}

COPIED int matter(const snow_ground *ground, snow_aggregate_lattice lattice, snow_site site)
{
    if (lattice == SNOW_AGGREGATE_CUBIC)
        return snow_space_map_matter(&ground->space, site.x, site.y, site.z);
    return snow_plane_map_matter(&ground->plane, site.x, site.y);
}

COPIED int32_t folded(int32_t x, int32_t width)
{
    if ((uint32_t)x < (uint32_t)width)
        return x;
    int32_t period = 2 * width;
    x %= period;
    x += x < 0 ? period : 0;
    return x < width ? x : period - 1 - x;
}

/* Between mirrors at X = 0 and X = 2 width − 1 in X = 2q + r. */
COPIED int32_t folded_hexagonal(int32_t q, int32_t r, int32_t width)
{
    int32_t last = 2 * width - 1;
    int32_t twice = 2 * q + r;
    if (twice < 0 || twice > last) {
        twice %= 2 * last;
        twice += twice < 0 ? 2 * last : 0;
        twice = twice > last ? 2 * last - twice : twice;
    }
    return (twice - r) / 2;
}

/* Back into the vessel through its mirrors. */
COPIED snow_site fold(const snow_source_of_walkers *source, snow_aggregate_lattice lattice, snow_site site)
{
    if (lattice == SNOW_AGGREGATE_HEXAGONAL) {
        int32_t r = source->lid >= 0 && site.y > source->lid ? 2 * source->lid - site.y : site.y;
        /* The mirror through a row takes X, not q, to itself. */
        return (snow_site){folded_hexagonal(site.x + (site.y - r) / 2, r, source->width), r, 0};
    }
    site.x = folded(site.x, source->width);
    int32_t *up = lattice == SNOW_AGGREGATE_CUBIC ? &site.z : &site.y;
    if (lattice == SNOW_AGGREGATE_CUBIC)
        site.y = folded(site.y, source->depth);
    if (source->lid >= 0 && *up > source->lid)
        *up = 2 * source->lid + 1 - *up;
    return site;
}

/* A site at distance `radius`, by the exact law: a small region, */
COPIED snow_site step(const snow_exit_table *table, snow_aggregate_lattice lattice, snow_site site, uint64_t bits)
{
    const snow_exit_step *step = &table->step[(uint32_t)bits & table->step_mask];
    const int8_t *way = step->way[(uint32_t)(bits >> 32) >= step->threshold];
    site.x += way[0];
    site.y += way[1];
    if (lattice == SNOW_AGGREGATE_CUBIC)
        site.z += way[2];
    return site;
}

/* and any other one. */
COPIED snow_site jump(const snow_exit_table *table, snow_aggregate_lattice lattice, snow_site site, uint64_t bits)
{
    uint32_t low = (uint32_t)bits;
    uint32_t high = (uint32_t)(bits >> 32);
    const snow_exit *exit = &table->exit[low & table->exit_mask];
    int32_t radius = table->radius;
    if (lattice == SNOW_AGGREGATE_SQUARE) {
        int32_t along = exit->outcome[high >= exit->threshold];
        int32_t mirror = -(int32_t)(low >> 31);
        int32_t turn = -(int32_t)(low >> 30 & 1);
        int32_t back = -(int32_t)(low >> 29 & 1);
        along = (along ^ mirror) - mirror;
        int32_t across = (radius ^ back) - back;
        int32_t swap = (along ^ across) & turn;
        site.x += along ^ swap;
        site.y += across ^ swap;
        return site;
    }
    uint64_t product = (uint64_t)high * 6;
    uint32_t side = (uint32_t)(product >> 32);
    int32_t offset = exit->outcome[(uint32_t)product >= exit->threshold];
    if (lattice == SNOW_AGGREGATE_HEXAGONAL) {
        site.x += radius * corner_q[side] + offset * side_q[side];
        site.y += radius * corner_r[side] + offset * side_r[side];
        return site;
    }
    int32_t mirror_a = -(int32_t)(low >> 31);
    int32_t mirror_b = -(int32_t)(low >> 30 & 1);
    int32_t swap = -(int32_t)(low >> 29 & 1);
    int32_t a = ((offset >> 8) ^ mirror_a) - mirror_a;
    int32_t b = ((offset & 255) ^ mirror_b) - mirror_b;
    swap &= a ^ b;
    a ^= swap;
    b ^= swap;
    int32_t across = side % 2 == 0 ? radius : -radius;
    site.x += side / 2 == 0 ? across : a;
    site.y += side / 2 == 1 ? across : side / 2 == 0 ? a : b;
    site.z += side / 2 == 2 ? across : b;
    return site;
}

static int64_t magnitude(int64_t x)
{
    return x < 0 ? -x : x;
}

/* Free distance from the cluster, outside the map. */
static int64_t clear_of(const snow_source_of_walkers *source, snow_aggregate_lattice lattice, snow_site site)
{
    if (source->width > 0)
        return (lattice == SNOW_AGGREGATE_CUBIC ? site.z : site.y) - source->reach;
    int64_t a = magnitude(site.x);
    int64_t b = magnitude(site.y);
    int64_t c = lattice == SNOW_AGGREGATE_HEXAGONAL ? magnitude((int64_t)site.x + site.y) : magnitude(site.z);
    int64_t most = a > b ? a : b;
    return (most > c ? most : c) - source->reach;
}

/* Filled neighbours are bits 0 … 5, obstacles bits 6 … 11. */
COPIED uint32_t touched(const snow_ground *ground, snow_aggregate_lattice lattice, snow_site site)
{
    uint32_t found = 0;
    for (int k = 0; k < ways(lattice); k++) {
        snow_site next = {site.x + step_x[lattice - 1][k], site.y + step_y[lattice - 1][k],
                          site.z + step_z[lattice - 1][k]};
        if (ground->source.width > 0)
            next = fold(&ground->source, lattice, next);
        bool floor = ground->source.width > 0 && (lattice == SNOW_AGGREGATE_CUBIC ? next.z : next.y) < 0;
        uint32_t here = floor ? SNOW_MATTER_FILLED : (uint32_t)matter(ground, lattice, next);
        found |= (here & 1) << k | (here >> 1) << (k + 6);
    }
    return found;
}

/* A time step on a special site. True: the walker stays for good. */
COPIED bool trial(const snow_ground *ground, snow_aggregate_lattice lattice, snow_site *site, uint32_t around,
                  snow_draws *draws)
{
    bool arrives = ground->contact == SNOW_AGGREGATE_ARRIVAL;
    if (arrives && (around & 63) != 0 && (ground->stick >= 1 || snow_draws_uniform(draws) < ground->stick))
        return true;
    uint32_t way = snow_draws_below(draws, (uint32_t)ways(lattice));
    if ((around >> way & 1) != 0)
        return !arrives && (ground->stick >= 1 || snow_draws_uniform(draws) < ground->stick);
    if ((around >> (way + 6) & 1) != 0)
        return false;
    site->x += step_x[lattice - 1][way];
    site->y += step_y[lattice - 1][way];
    site->z += step_z[lattice - 1][way];
    if (ground->source.width > 0)
        *site = fold(&ground->source, lattice, *site);
    return false;
}

COPIED void note(snow_diary *diary, snow_site site, uint32_t answer)
{
    if (diary->count < diary->room)
        diary->question[diary->count] = (snow_question){site, answer};
    diary->count++;
}

/* What the walker sees: the class, or, at a special site where it may go on, 256 and what is around. */
COPIED uint32_t see(const snow_ground *ground, snow_aggregate_lattice lattice, bool careful, snow_site site)
{
    uint32_t class = (uint32_t)look(ground, lattice, site);
    if (careful && class == 0)
        return 256 + (touched(ground, lattice, site) << 9);
    return class;
}

COPIED snow_site fly(const snow_ground *ground, snow_draws *draws, snow_diary *diary, snow_aggregate_lattice lattice,
                     bool careful, bool in_vessel, bool noted)
{
    const snow_source_of_walkers *source = &ground->source;
    const uint32_t small = (uint32_t)ground->exits.small;
    snow_site site = snow_source_launch(source, draws);
    for (;;) {
        uint32_t seen = see(ground, lattice, careful, site);
        if (noted)
            note(diary, site, seen);
        if (RARE(seen == SNOW_MAP_BEYOND)) {
            int64_t clear = clear_of(source, lattice, site);
            if (RARE(clear > source->safe) && snow_source_is_beyond(source, site)) {
                site = snow_source_return(source, site, draws);
                continue;
            }
            seen = (uint32_t)snow_exits_class(&ground->exits, clear);
        }
        if (!careful && seen == 0)
            return site;
        if (careful && seen >= 256) {
            if (trial(ground, lattice, &site, seen >> 9, draws))
                return site;
            continue;
        }
        const snow_exit_table *table = &ground->exits.table[seen];
        if (seen <= small)
            site = step(table, lattice, site, snow_draws_next(draws));
        else if (lattice == SNOW_AGGREGATE_HEXAGONAL && RARE(table->exit == NULL))
            site = snow_source_circle(site, table->radius, draws);
        else
            site = jump(table, lattice, site, snow_draws_next(draws));
        if (in_vessel)
            site = fold(source, lattice, site);
    }
}

COPIED snow_site fly_over(const snow_ground *ground, snow_draws *draws, snow_diary *diary,
                          snow_aggregate_lattice lattice)
{
    bool in_vessel = ground->source.width > 0;
    if (in_vessel || ground->careful)
        return fly(ground, draws, diary, lattice, ground->careful, in_vessel, true);
    if (diary->room > 0)
        return fly(ground, draws, diary, lattice, false, false, true);
    return fly(ground, draws, diary, lattice, false, false, false);
}

static snow_site fly_square(const snow_ground *ground, snow_draws *draws, snow_diary *diary)
{
    return fly_over(ground, draws, diary, SNOW_AGGREGATE_SQUARE);
}

static snow_site fly_hexagonal(const snow_ground *ground, snow_draws *draws, snow_diary *diary)
{
    return fly_over(ground, draws, diary, SNOW_AGGREGATE_HEXAGONAL);
}

static snow_site fly_cubic(const snow_ground *ground, snow_draws *draws, snow_diary *diary)
{
    return fly_over(ground, draws, diary, SNOW_AGGREGATE_CUBIC);
}

snow_site snow_flight(const snow_ground *ground, snow_draws *draws, snow_diary *diary)
{
    switch (ground->exits.lattice) {
    case SNOW_AGGREGATE_HEXAGONAL:
        return fly_hexagonal(ground, draws, diary);
    case SNOW_AGGREGATE_CUBIC:
        return fly_cubic(ground, draws, diary);
    default:
        return fly_square(ground, draws, diary);
    }
}

bool snow_flight_holds(const snow_ground *ground, const snow_diary *diary)
{
    snow_aggregate_lattice lattice = ground->exits.lattice;
    for (size_t i = 0; i < diary->count; i++) {
        const snow_question *question = &diary->question[i];
        if (see(ground, lattice, ground->careful, question->site) != question->answer)
            return false;
    }
    return true;
}
