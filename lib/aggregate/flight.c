#include "aggregate/flight.h"

#include "aggregate/squad.h"

/* Pairs of coordinates are not worth the way through vector registers. */
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("no-tree-slp-vectorize")
#endif

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

/* The eight symmetries of a square. */
static const int32_t image_of_square[8][4] = {{1, 0, 0, 1},  {-1, 0, 0, 1},  {1, 0, 0, -1},  {-1, 0, 0, -1},
                                              {0, 1, 1, 0},  {0, 1, -1, 0},  {0, -1, 1, 0},  {0, -1, -1, 0}};

/* The 48 symmetries of a cube: what one step across a face, and one along each
   offset on it, add to three numbers of 16 bits each. */
#define X INT64_C(0x1)
#define Y INT64_C(0x10000)
#define Z INT64_C(0x100000000)
#define FACE(across, a, b)                                                                            \
    {across, a, b}, {across, -(a), b}, {across, a, -(b)}, {across, -(a), -(b)},                       \
    {across, b, a}, {across, -(b), a}, {across, b, -(a)}, {across, -(b), -(a)}
static const int64_t image_of_cube[48][3] = {FACE(X, Y, Z),  FACE(-X, Y, Z), FACE(Y, X, Z),
                                             FACE(-Y, X, Z), FACE(Z, X, Y),  FACE(-Z, X, Y)};
#undef X
#undef Y
#undef Z
#undef FACE

COPIED int ways(snow_aggregate_lattice lattice)
{
    return lattice == SNOW_AGGREGATE_SQUARE ? 4 : 6;
}

COPIED int32_t tile_at(const snow_ground *ground, snow_aggregate_lattice lattice, snow_site site)
{
    if (lattice == SNOW_AGGREGATE_CUBIC)
        return snow_space_map_tile(&ground->space, site.x, site.y, site.z);
    return snow_plane_map_tile(&ground->plane, site.x, site.y);
}

COPIED uint32_t look(const snow_ground *ground, snow_aggregate_lattice lattice, int32_t tile, snow_site site)
{
    if (lattice == SNOW_AGGREGATE_CUBIC)
        return snow_space_map_look(&ground->space, snow_space_map_find(&ground->space, tile), site.x, site.y, site.z);
    return snow_plane_map_look(&ground->plane, snow_plane_map_find(&ground->plane, tile), site.x, site.y);
}

COPIED bool has_changed(const snow_ground *ground, snow_aggregate_lattice lattice, int32_t tile, uint64_t since)
{
    if (lattice == SNOW_AGGREGATE_CUBIC)
        return snow_space_map_has_changed(&ground->space, tile, since);
    return snow_plane_map_has_changed(&ground->plane, tile, since);
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

/* To a site at distance `radius`, by the exact law. */
COPIED snow_site jump(const snow_exit_table *table, snow_aggregate_lattice lattice, snow_site site, uint64_t number)
{
    int32_t radius = table->radius;
    snow_exit_pick pick = snow_exit_table_pick(table, number);
    int32_t offset = pick.exit->outcome[pick.place >= pick.exit->threshold];
    if (lattice == SNOW_AGGREGATE_SQUARE) {
        const int32_t *image = image_of_square[number & 7];
        site.x += image[0] * offset + image[1] * radius;
        site.y += image[2] * offset + image[3] * radius;
        return site;
    }
    uint32_t side = (uint32_t)((number & 0xFFFFFFFF) * 6 >> 32);
    if (lattice == SNOW_AGGREGATE_HEXAGONAL) {
        site.x += radius * corner_q[side] + offset * side_q[side];
        site.y += radius * corner_r[side] + offset * side_r[side];
        return site;
    }
    const int64_t *image = image_of_cube[8 * side + (number & 7)];
    int64_t sum = image[0] * radius + image[1] * (offset >> 8) + image[2] * (offset & 255);
    uint64_t shifted = (uint64_t)sum + UINT64_C(0x800080008000);
    site.x += (int32_t)(shifted & 0xFFFF) - 0x8000;
    site.y += (int32_t)(shifted >> 16 & 0xFFFF) - 0x8000;
    site.z += (int32_t)(shifted >> 32 & 0xFFFF) - 0x8000;
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

/* What the walker sees: the class, or, at a special site where it may go on, 256 and what is around. */
COPIED uint32_t see(const snow_ground *ground, snow_aggregate_lattice lattice, bool careful, int32_t tile,
                    snow_site site)
{
    uint32_t seen = look(ground, lattice, tile, site);
    return careful && seen == 0 ? 256 + (touched(ground, lattice, site) << 9) : seen;
}

/* What is constant for all walkers of a ground. */
typedef struct manner {
    snow_aggregate_lattice lattice;
    bool careful;
    bool in_vessel;
} manner;

/* From the middle of the region of a class to where the walker leaves it. */
COPIED snow_site leave(const snow_ground *ground, manner how, snow_site site, uint32_t class, snow_draws *draws)
{
    const snow_exit_table *table = &ground->exits.table[class];
    if (how.lattice == SNOW_AGGREGATE_HEXAGONAL && RARE(class >= (uint32_t)ground->exits.circles))
        site = snow_source_circle(site, table->radius, snow_draws_next(draws));
    else
        site = jump(table, how.lattice, site, snow_draws_next(draws));
    return how.in_vessel ? fold(&ground->source, how.lattice, site) : site;
}

/* From the middle of the ball that is free. */
COPIED snow_site leave_ball(const snow_source_of_walkers *source, manner how, snow_site site, double ball,
                            snow_draws *draws)
{
    site = snow_source_sphere(site, ball, draws);
    return how.in_vessel ? fold(source, how.lattice, site) : site;
}

/* A turn outside the map. In space it begins with a block, as lanes want it. */
COPIED snow_site drift(const snow_ground *ground, manner how, snow_site site, snow_draws *draws)
{
    if (how.lattice == SNOW_AGGREGATE_CUBIC)
        snow_draws_end_block(draws);
    int64_t clear = clear_of(&ground->source, how.lattice, site);
    if (RARE(clear > ground->source.safe))
        return snow_source_come_in(&ground->source, site, draws);
    if (how.lattice == SNOW_AGGREGATE_CUBIC) {
        double ball = snow_source_clear_ball(&ground->source, site);
        if (ball >= SNOW_SOURCE_LEAST_BALL)
            return leave_ball(&ground->source, how, site, ball, draws);
    }
    return leave(ground, how, site, (uint32_t)snow_exits_class_near(&ground->exits, clear), draws);
}

/* From outside the map until it is inside again. No cluster can change that. */
COPIED snow_site come_in(const snow_ground *ground, manner how, snow_site site, snow_draws *draws)
{
    do
        site = drift(ground, how, site, draws);
    while (tile_at(ground, how.lattice, site) < 0);
    return site;
}

/* What the walker does when it has seen this. True: it has landed. */
COPIED bool advance(const snow_ground *ground, manner how, snow_site *site, snow_draws *draws, uint32_t seen)
{
    if (RARE(seen == SNOW_MAP_BEYOND)) {
        *site = come_in(ground, how, *site, draws);
        return false;
    }
    if (!how.careful && RARE(seen == 0))
        return true;
    if (how.careful && seen >= 256)
        return trial(ground, how.lattice, site, seen >> 9, draws);
    *site = leave(ground, how, *site, seen, draws);
    return false;
}

COPIED snow_site site_of(const snow_flight *flight, manner how)
{
    return (snow_site){flight->x, flight->y, how.lattice == SNOW_AGGREGATE_CUBIC ? flight->z : 0};
}

COPIED void put_at(snow_flight *flight, manner how, snow_site site)
{
    flight->x = site.x;
    flight->y = site.y;
    if (how.lattice == SNOW_AGGREGATE_CUBIC)
        flight->z = site.z;
}

COPIED void note(const snow_squad *squad, int lane, manner how, const snow_flight *flight, int32_t tile,
                 uint32_t answer)
{
    snow_squad_tiles(squad, squad->next)->tile[lane] = tile;
    snow_row *row = snow_squad_row(squad, squad->next);
    row->x[lane] = flight->x;
    row->y[lane] = flight->y;
    row->answer[lane] = answer;
    row->drawn[lane] = flight->draws.used;
    if (how.lattice == SNOW_AGGREGATE_CUBIC)
        snow_squad_heights(squad, squad->next)->z[lane] = flight->z;
}

/* A turn of each. */
COPIED void all_go_on(const snow_ground *ground, manner how, snow_squad *squad)
{
    for (int lane = 0; lane < SNOW_LANES; lane++) {
        if (RARE((squad->busy >> lane & 1) == 0))
            continue;
        snow_flight *flight = &squad->flight[lane];
        snow_site site = site_of(flight, how);
        int32_t tile = tile_at(ground, how.lattice, site);
        uint32_t answer = see(ground, how.lattice, how.careful, tile, site);
        note(squad, lane, how, flight, tile, answer);
        if (RARE(advance(ground, how, &site, &flight->draws, answer)))
            squad->landed |= 1u << lane;
        put_at(flight, how, site);
    }
    squad->next++;
}

COPIED void walk_in_turn(const snow_ground *ground, manner how, snow_squad *squads, int count)
{
    uint32_t ready = 0; /* landed, or without rows */
    while (ready == 0) {
        for (int i = 0; i < count; i++) {
            if (squads[i].next != squads[i].stop)
                all_go_on(ground, how, &squads[i]);
            ready |= squads[i].landed;
            ready |= squads[i].next == squads[i].stop;
        }
    }
}

static manner manner_of(const snow_ground *ground)
{
    return (manner){ground->exits.lattice, ground->careful, ground->source.width > 0};
}

/* The plain scenes have copies of their own. */
void snow_squads_walk_in_turn(const snow_ground *ground, snow_squad *squads, int count)
{
    manner how = manner_of(ground);
    if (how.careful || how.in_vessel)
        walk_in_turn(ground, how, squads, count);
    else if (how.lattice == SNOW_AGGREGATE_HEXAGONAL)
        walk_in_turn(ground, (manner){SNOW_AGGREGATE_HEXAGONAL, false, false}, squads, count);
    else if (how.lattice == SNOW_AGGREGATE_CUBIC)
        walk_in_turn(ground, (manner){SNOW_AGGREGATE_CUBIC, false, false}, squads, count);
    else
        walk_in_turn(ground, (manner){SNOW_AGGREGATE_SQUARE, false, false}, squads, count);
}

snow_site snow_flight_finish(const snow_ground *ground, snow_flight *flight)
{
    manner how = manner_of(ground);
    snow_site site = site_of(flight, how);
    while (!flight->landed) {
        uint32_t answer = see(ground, how.lattice, how.careful, tile_at(ground, how.lattice, site), site);
        flight->asked++;
        flight->landed = advance(ground, how, &site, &flight->draws, answer);
    }
    put_at(flight, how, site);
    return site;
}

static void set_down(snow_flight *flight, snow_site site, bool landed)
{
    flight->x = site.x;
    flight->y = site.y;
    flight->z = site.z;
    flight->landed = landed;
    flight->asked = 0;
}

void snow_flight_start(const snow_ground *ground, snow_flight *flight, uint64_t key, uint64_t walker)
{
    snow_draws_start(&flight->draws, ground->refill, key, walker, 0);
    set_down(flight, snow_source_infinity(&ground->source), false);
}

void snow_flight_resume(const snow_ground *ground, snow_flight *flight, uint64_t key, uint64_t walker, snow_stay stay)
{
    snow_draws_start(&flight->draws, ground->refill, key, walker, stay.drawn);
    set_down(flight, stay.site, stay.landed);
}

static bool is_outdated(const snow_ground *ground, const snow_squad *squad, int lane, uint32_t row)
{
    manner how = manner_of(ground);
    int32_t tile = snow_squad_tiles(squad, row)->tile[lane];
    snow_site site = snow_squad_asked(squad, lane, row).site;
    return see(ground, how.lattice, how.careful, tile, site) != snow_squad_row(squad, row)->answer[lane];
}

uint32_t snow_squad_outdated(const snow_ground *ground, const snow_squad *squad, int lane, uint32_t first, uint32_t end,
                             uint64_t since)
{
    for (uint32_t row = first; row != end; row++)
        if (RARE(has_changed(ground, ground->exits.lattice, snow_squad_tiles(squad, row)->tile[lane], since)) &&
            is_outdated(ground, squad, lane, row))
            return row;
    return end;
}
