/* Squads in the lanes of vectors: eight walkers take each step of a question together.

   Looking something up is a gather. Addresses have 64 bits, so that lanes with
   even and odd numbers are gathered apart; a `pair` holds both, each lane in the
   lower half of 64 bits. Nothing branches: lanes whose walker has landed, or
   needs more than one number, stand still, and are looked after when a block of
   two numbers is used up. What is done is flight.c's, and so are the results. */
#include "aggregate/squad.h"

#include <immintrin.h>

#include <stddef.h>

typedef __m256i lanes;

typedef struct pair {
    lanes even, odd;
} pair;

static inline lanes all(uint32_t x)
{
    return _mm256_set1_epi32((int)x);
}

static inline lanes load(const void *from)
{
    return _mm256_load_si256(from);
}

static inline void store(void *to, lanes a)
{
    _mm256_store_si256(to, a);
}

/* Upper halves are left as they come. */
static inline pair apart(lanes a)
{
    return (pair){a, _mm256_srli_epi64(a, 32)};
}

/* Upper halves are zero. */
static inline pair apart_clean(lanes a)
{
    return (pair){_mm256_blend_epi32(a, _mm256_setzero_si256(), 0xAA), _mm256_srli_epi64(a, 32)};
}

static inline lanes lower_halves(pair a)
{
    return _mm256_blend_epi32(a.even, _mm256_slli_epi64(a.odd, 32), 0xAA);
}

static inline lanes upper_halves(pair a)
{
    return _mm256_blend_epi32(_mm256_srli_epi64(a.even, 32), a.odd, 0xAA);
}

static inline pair plus(pair a, pair b)
{
    return (pair){_mm256_add_epi64(a.even, b.even), _mm256_add_epi64(a.odd, b.odd)};
}

/* Of lower halves. */
static inline pair product(pair a, pair b)
{
    return (pair){_mm256_mul_epu32(a.even, b.even), _mm256_mul_epu32(a.odd, b.odd)};
}

static inline pair upper_to_lower(pair a)
{
    return (pair){_mm256_srli_epi64(a.even, 32), _mm256_srli_epi64(a.odd, 32)};
}

/* Eight bytes from each address. */
static inline pair fetch(pair address)
{
    return (pair){_mm256_i64gather_epi64(NULL, address.even, 1), _mm256_i64gather_epi64(NULL, address.odd, 1)};
}

/* The elements of an array of 64 bits each. */
static inline pair fetch_from(const void *array, pair index)
{
    return (pair){_mm256_i64gather_epi64(array, index.even, 8), _mm256_i64gather_epi64(array, index.odd, 8)};
}

/* The same where a lane's mask is set; 0 elsewhere. */
static inline pair fetch_some(pair address, lanes mask)
{
    lanes none = _mm256_setzero_si256();
    return (pair){_mm256_mask_i64gather_epi64(none, NULL, address.even, _mm256_slli_epi64(mask, 32), 1),
                  _mm256_mask_i64gather_epi64(none, NULL, address.odd, mask, 1)};
}

static inline lanes choose(lanes mask, lanes yes, lanes no)
{
    return _mm256_blendv_epi8(no, yes, mask);
}

/* a where the sign is clear, -a where it is set. */
static inline lanes signed_by(lanes a, lanes sign)
{
    return _mm256_sign_epi32(a, _mm256_or_si256(sign, all(1)));
}

/* A number of 64 bits for each lane. */
typedef pair numbers;

enum { ROUNDS = 10 };

/* Philox, see draws_kernel.c: two numbers for each lane. */
static inline void draw(lanes key[ROUNDS][2], const snow_lanes *walkers, lanes block, numbers drawn[2])
{
    pair multiplier_0 = {_mm256_set1_epi64x(0xD2511F53), _mm256_set1_epi64x(0xD2511F53)};
    pair multiplier_1 = {_mm256_set1_epi64x(0xCD9E8D57), _mm256_set1_epi64x(0xCD9E8D57)};
    pair a = apart(block);
    pair b = apart(load(walkers->low));
    pair c = apart(load(walkers->high));
    pair d = {_mm256_set1_epi64x(SNOW_RANDOM_JUMPS), _mm256_set1_epi64x(SNOW_RANDOM_JUMPS)};
    for (int round = 0; round < ROUNDS; round++) {
        pair product_0 = product(a, multiplier_0);
        pair product_1 = product(c, multiplier_1);
        pair upper_0 = upper_to_lower(product_0);
        pair upper_1 = upper_to_lower(product_1);
        a.even = _mm256_xor_si256(_mm256_xor_si256(upper_1.even, b.even), key[round][0]);
        a.odd = _mm256_xor_si256(_mm256_xor_si256(upper_1.odd, b.odd), key[round][0]);
        c.even = _mm256_xor_si256(_mm256_xor_si256(upper_0.even, d.even), key[round][1]);
        c.odd = _mm256_xor_si256(_mm256_xor_si256(upper_0.odd, d.odd), key[round][1]);
        b = product_1;
        d = product_0;
    }
    drawn[0].even = _mm256_blend_epi32(a.even, _mm256_slli_epi64(b.even, 32), 0xAA);
    drawn[0].odd = _mm256_blend_epi32(a.odd, _mm256_slli_epi64(b.odd, 32), 0xAA);
    drawn[1].even = _mm256_blend_epi32(c.even, _mm256_slli_epi64(d.even, 32), 0xAA);
    drawn[1].odd = _mm256_blend_epi32(c.odd, _mm256_slli_epi64(d.odd, 32), 0xAA);
}

static void make_keys(lanes key[ROUNDS][2], uint64_t first)
{
    uint32_t key_0 = (uint32_t)first;
    uint32_t key_1 = (uint32_t)(first >> 32);
    for (int round = 0; round < ROUNDS; round++) {
        key[round][0] = _mm256_set1_epi64x(key_0);
        key[round][1] = _mm256_set1_epi64x(key_1);
        key_0 += 0x9E3779B9u;
        key_1 += 0xBB67AE85u;
    }
}

/* What the map answers: snow_plane_map_find(), snow_plane_page_look(). */
static inline lanes ask(const snow_plane_map *map, lanes x, lanes y, lanes *inside)
{
    lanes u = _mm256_sub_epi32(x, all((uint32_t)map->box.x));
    lanes v = _mm256_sub_epi32(y, all((uint32_t)map->box.y));
    lanes inside_u = _mm256_cmpeq_epi32(_mm256_min_epu32(u, all(map->width - 1)), u);
    lanes inside_v = _mm256_cmpeq_epi32(_mm256_min_epu32(v, all(map->height - 1)), v);
    *inside = _mm256_and_si256(inside_u, inside_v);
    u = _mm256_and_si256(u, *inside);
    v = _mm256_and_si256(v, *inside);

    /* Row and column of the tile in the halves of a lane. */
    lanes place = _mm256_blend_epi16(_mm256_srli_epi32(v, 5), _mm256_slli_epi32(u, 11), 0xAA);
    lanes tile = _mm256_madd_epi16(place, all(map->box.columns | 1u << 16));
    pair page = fetch_from((const void *)map->tile, apart_clean(tile));

    lanes block = _mm256_or_si256(_mm256_and_si256(_mm256_slli_epi32(v, 1), all(56)),
                                  _mm256_and_si256(_mm256_srli_epi32(u, 2), all(7)));
    lanes near = _mm256_and_si256(lower_halves(fetch(plus(page, apart_clean(block)))), all(255));

    lanes is_close = _mm256_cmpgt_epi32(all(2), near);
    lanes quarter = _mm256_or_si256(_mm256_and_si256(v, all(16)), _mm256_and_si256(_mm256_srli_epi32(u, 1), all(8)));
    lanes at = _mm256_add_epi32(quarter, all(offsetof(snow_plane_page, line)));
    pair line = fetch_some(plus(page, apart_clean(at)), is_close);
    lanes two_rows = _mm256_slli_epi32(_mm256_and_si256(v, all(14)), 2);
    pair rows = fetch_some(plus(line, apart_clean(two_rows)), is_close);
    lanes bit = _mm256_or_si256(_mm256_slli_epi32(_mm256_and_si256(v, all(1)), 5),
                                _mm256_slli_epi32(_mm256_and_si256(u, all(15)), 1));
    pair shift = apart_clean(bit);
    rows.even = _mm256_srlv_epi64(rows.even, shift.even);
    rows.odd = _mm256_srlv_epi64(rows.odd, shift.odd);
    lanes exact = _mm256_andnot_si256(lower_halves(rows), all(3));
    return _mm256_max_epu32(near, _mm256_and_si256(exact, is_close));
}

/* The class of what is free outside the map: snow_exits_class_near(). */
static inline lanes outside_class(const snow_ground *ground, bool hexagonal, lanes x, lanes y, lanes outside)
{
    lanes most = _mm256_max_epi32(_mm256_abs_epi32(x), _mm256_abs_epi32(y));
    if (hexagonal)
        most = _mm256_max_epi32(most, _mm256_abs_epi32(_mm256_add_epi32(x, y)));
    lanes clear = _mm256_sub_epi32(most, all((uint32_t)ground->source.reach));
    lanes bits = _mm256_castps_si256(_mm256_cvtepi32_ps(clear));
    lanes part = _mm256_sub_epi32(_mm256_srli_epi32(bits, 20), all(127 << 3));
    part = _mm256_min_epu32(part, all(SNOW_EXIT_OCTAVES * SNOW_EXIT_PARTS - 1));
    lanes class = _mm256_mask_i32gather_epi32(_mm256_setzero_si256(), (const void *)ground->exits.class_from, part,
                                              outside, 1);
    lanes is_beyond = _mm256_cmpgt_epi32(clear, all((uint32_t)ground->source.safe));
    return choose(is_beyond, all(SNOW_MAP_BEYOND), _mm256_and_si256(class, all(255)));
}

typedef struct position {
    lanes x, y;
} position;

/* jump() of flight.c; classes without a table have radius 0, and lanes stay where they are. */
static inline position jump(const snow_exits *exits, bool hexagonal, position from, lanes class, numbers number,
                            lanes *stays)
{
    lanes place = _mm256_i32gather_epi32((const int *)exits->place, class, 4);
    lanes radius = _mm256_and_si256(place, all((1u << SNOW_EXIT_RADIUS_BITS) - 1));
    lanes first = _mm256_srli_epi32(place, SNOW_EXIT_RADIUS_BITS);
    *stays = _mm256_cmpeq_epi32(radius, _mm256_setzero_si256());

    pair columns = apart(radius);
    pair pick = plus(product(upper_to_lower(number), columns), upper_to_lower(product(number, columns)));
    pair exit = fetch_from(exits->exit, plus(upper_to_lower(pick), apart_clean(first)));
    lanes in_column = lower_halves(pick);
    lanes threshold = lower_halves(exit);
    lanes is_from = _mm256_cmpeq_epi32(_mm256_max_epu32(in_column, threshold), in_column);
    lanes outcome = _mm256_srlv_epi32(upper_halves(exit), _mm256_and_si256(is_from, all(16)));
    lanes offset = _mm256_and_si256(outcome, all(0xFFFF));

    if (hexagonal) {
        const lanes corner_q = _mm256_setr_epi32(1, 0, -1, -1, 0, 1, 0, 0);
        const lanes corner_r = _mm256_setr_epi32(0, 1, 1, 0, -1, -1, 0, 0);
        const lanes side_q = _mm256_setr_epi32(-1, -1, 0, 1, 1, 0, 0, 0);
        const lanes side_r = _mm256_setr_epi32(1, 0, -1, -1, 0, 1, 0, 0);
        pair six = {all(6), all(6)};
        lanes side = upper_halves(product(number, six));
        lanes along_q = _mm256_sign_epi32(offset, _mm256_permutevar8x32_epi32(side_q, side));
        lanes along_r = _mm256_sign_epi32(offset, _mm256_permutevar8x32_epi32(side_r, side));
        lanes across_q = _mm256_sign_epi32(radius, _mm256_permutevar8x32_epi32(corner_q, side));
        lanes across_r = _mm256_sign_epi32(radius, _mm256_permutevar8x32_epi32(corner_r, side));
        return (position){_mm256_add_epi32(from.x, _mm256_add_epi32(along_q, across_q)),
                          _mm256_add_epi32(from.y, _mm256_add_epi32(along_r, across_r))};
    }
    lanes symmetry = lower_halves(number);
    lanes along = signed_by(offset, _mm256_slli_epi32(symmetry, 31));
    lanes across = signed_by(radius, _mm256_slli_epi32(symmetry, 30));
    lanes swaps = _mm256_srai_epi32(_mm256_slli_epi32(symmetry, 29), 31);
    return (position){_mm256_add_epi32(from.x, choose(swaps, across, along)),
                      _mm256_add_epi32(from.y, choose(swaps, along, across))};
}

/* One question of each. */
static inline position step(const snow_ground *ground, bool hexagonal, position at, numbers number, lanes drawn,
                            snow_row *row, lanes *stays)
{
    lanes inside;
    lanes seen = ask(&ground->plane, at.x, at.y, &inside);
    lanes answer = choose(inside, seen, all(SNOW_MAP_BEYOND));
    store(row->x, at.x);
    store(row->y, at.y);
    store(row->answer, answer);
    store(row->drawn, drawn);
    lanes outside = _mm256_xor_si256(inside, all(UINT32_MAX));
    lanes class = choose(inside, seen, outside_class(ground, hexagonal, at.x, at.y, outside));
    return jump(&ground->exits, hexagonal, at, class, number, stays);
}

/* Two questions of each, with a block of numbers: the lanes that have stood still. */
static inline uint32_t take_block(const snow_ground *ground, bool hexagonal, lanes key[ROUNDS][2],
                                  snow_squad *squad)
{
    snow_lanes *walkers = &squad->lanes;
    position at = {load(walkers->x), load(walkers->y)};
    lanes drawn = load(walkers->drawn);
    numbers number[2];
    lanes stays[2];
    draw(key, walkers, _mm256_srli_epi32(drawn, 1), number);
    at = step(ground, hexagonal, at, number[0], drawn, snow_squad_row(squad, squad->next), &stays[0]);
    lanes one_more = _mm256_add_epi32(drawn, all(1));
    at = step(ground, hexagonal, at, number[1], one_more, snow_squad_row(squad, squad->next + 1), &stays[1]);
    squad->next += 2;
    store(walkers->x, at.x);
    store(walkers->y, at.y);
    /* Those who stood still at once have not used the block. */
    store(walkers->drawn, _mm256_add_epi32(drawn, _mm256_andnot_si256(stays[0], all(2))));
    return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(stays[1])) & squad->busy;
}

static inline void walk(const snow_ground *ground, bool hexagonal, snow_squad *squads, int count)
{
    lanes key[ROUNDS][2];
    make_keys(key, squads[0].key);
    for (uint32_t ready = 0; ready == 0;) {
        for (int i = 0; i < count; i++) {
            snow_squad *squad = &squads[i];
            if (squad->busy == 0)
                continue;
            uint32_t still = squad->stop - squad->next < 2 ? 0 : take_block(ground, hexagonal, key, squad);
            if (still != 0)
                snow_squad_help(ground, squad, still);
            ready |= squad->landed & squad->busy;
            ready |= squad->stop - squad->next < 2;
        }
    }
}

void snow_squads_walk_avx2(const snow_ground *ground, snow_squad *squads, int count)
{
    if (ground->exits.lattice == SNOW_AGGREGATE_HEXAGONAL)
        walk(ground, true, squads, count);
    else
        walk(ground, false, squads, count);
}
