/* Squads in the lanes of vectors: eight walkers take each step of a question together.
   Compiled for AVX2 and for AVX-512, with SNOW_KERNEL naming it.

   Looking something up is a gather. Nothing branches, but for circles (lanes_circle.h):
   lanes whose walker has landed stand still, and are looked after when a block of
   two numbers is used up. What is done is flight.c's, and so are the results.

   One question is a chain of six gathers, each of which waits for the one before:
   so several squads do each link of the chain after one another. */
#include "aggregate/lanes_circle.h"

/* What a question needs from one link of the chain to the next. */
typedef struct question {
    lanes x, y;
    lanes u, v; /* from the corner of the map; 0 outside */
    lanes inside;
    lanes tile; /* 0 outside */
    lanes page, near, is_close, line;
    lanes seen; /* 0, a class, or SNOW_MAP_BEYOND */
    lanes class, radius, first;
    wide pick, exit;
    lanes is_thrown; /* onto a circle */
} question;

/* What follows is snow_plane_map_tile(), snow_plane_map_find() and snow_plane_map_look(). */
INLINE void find_tile(const snow_plane_map *map, question *q)
{
    lanes u = _mm256_sub_epi32(q->x, all((uint32_t)map->box.x));
    lanes v = _mm256_sub_epi32(q->y, all((uint32_t)map->box.y));
    lanes inside_u = _mm256_cmpeq_epi32(_mm256_min_epu32(u, all(map->width - 1)), u);
    lanes inside_v = _mm256_cmpeq_epi32(_mm256_min_epu32(v, all(map->height - 1)), v);
    q->inside = _mm256_and_si256(inside_u, inside_v);
    q->u = _mm256_and_si256(u, q->inside);
    q->v = _mm256_and_si256(v, q->inside);
    /* Row and column in the halves of a lane. */
    lanes place = _mm256_blend_epi16(_mm256_srli_epi32(q->v, 5), _mm256_slli_epi32(q->u, 11), 0xAA);
    q->tile = _mm256_madd_epi16(place, all(map->box.columns | 1u << 16));
}

/* For diaries: negative outside. */
INLINE lanes told_by(const question *q)
{
    return _mm256_or_si256(q->tile, _mm256_xor_si256(q->inside, all(UINT32_MAX)));
}

INLINE void find_page(const snow_plane_map *map, question *q)
{
    q->page = look_up((const void *)map->tile, q->tile);
}

INLINE void look_near(const snow_plane_map *map, question *q)
{
    lanes row = _mm256_and_si256(_mm256_slli_epi32(q->v, 1), all(56));
    lanes column = _mm256_and_si256(_mm256_srli_epi32(q->u, 2), all(7));
    lanes place = _mm256_or_si256(_mm256_slli_epi32(q->page, 6), _mm256_or_si256(row, column));
    lanes bytes = _mm256_i32gather_epi32((const int *)map->page, place, 1);
    q->near = _mm256_and_si256(bytes, all(255));
    q->is_close = _mm256_cmpgt_epi32(all(2), q->near);
}

INLINE void find_line(const snow_plane_map *map, question *q)
{
    lanes row = _mm256_and_si256(_mm256_srli_epi32(q->v, 3), all(2));
    lanes column = _mm256_and_si256(_mm256_srli_epi32(q->u, 4), all(1));
    lanes place = _mm256_or_si256(_mm256_slli_epi32(q->page, 2), _mm256_or_si256(row, column));
    q->line = look_up_some(map->quarters, place, q->is_close);
}

INLINE void look_closely(const snow_plane_map *map, question *q)
{
    lanes row = _mm256_or_si256(_mm256_slli_epi32(q->line, 4), _mm256_and_si256(q->v, all(15)));
    lanes column = _mm256_slli_epi32(_mm256_and_si256(q->u, all(15)), 1);
    lanes code = _mm256_srlv_epi32(look_up_some(map->line, row, q->is_close), column);
    lanes exact = _mm256_and_si256(_mm256_andnot_si256(code, all(3)), q->is_close);
    q->seen = choose(q->inside, _mm256_max_epu32(q->near, exact), all(SNOW_MAP_BEYOND));
}

INLINE void look(const snow_plane_map *map, question *q)
{
    find_tile(map, q);
    find_page(map, q);
    look_near(map, q);
    find_line(map, q);
    look_closely(map, q);
}

INLINE lanes class_outside(const snow_ground *ground, bool hexagonal, const question *q)
{
    lanes most = _mm256_max_epi32(_mm256_abs_epi32(q->x), _mm256_abs_epi32(q->y));
    if (hexagonal)
        most = _mm256_max_epi32(most, _mm256_abs_epi32(_mm256_add_epi32(q->x, q->y)));
    lanes clear = _mm256_sub_epi32(most, all((uint32_t)ground->source.reach));
    lanes is_beyond = _mm256_cmpgt_epi32(clear, all((uint32_t)ground->source.safe));
    lanes outside = _mm256_xor_si256(q->inside, all(UINT32_MAX));
    return choose(is_beyond, all(SNOW_MAP_BEYOND), class_near(&ground->exits, clear, outside));
}

INLINE void find_table(const snow_ground *ground, bool hexagonal, question *q)
{
    q->class = choose(q->inside, q->seen, class_outside(ground, hexagonal, q));
    lanes place = look_up(ground->exits.place, q->class);
    q->radius = _mm256_and_si256(place, all((1u << SNOW_EXIT_RADIUS_BITS) - 1));
    q->first = _mm256_srli_epi32(place, SNOW_EXIT_RADIUS_BITS);
}

/* snow_exit_table_pick() */
INLINE void find_exit(const snow_exits *exits, question *q, wide number)
{
    wide columns = widened(q->radius);
    q->pick = plus(product(upper_to_lower(number), columns), upper_to_lower(product(number, columns)));
    q->exit = fetch_from(exits->exit, plus(upper_to_lower(q->pick), widened(q->first)));
}

INLINE void jump_square(question *q, wide number)
{
    lanes symmetry = lower_halves(number);
    lanes along = signed_by(outcome_of(q->pick, q->exit), _mm256_slli_epi32(symmetry, 31));
    lanes across = signed_by(q->radius, _mm256_slli_epi32(symmetry, 30));
    lanes swaps = _mm256_srai_epi32(_mm256_slli_epi32(symmetry, 29), 31);
    q->x = _mm256_add_epi32(q->x, choose(swaps, across, along));
    q->y = _mm256_add_epi32(q->y, choose(swaps, along, across));
}

/* a times the element of a table of -1, 0 and 1. */
INLINE lanes directed(lanes a, lanes table, lanes side)
{
    return _mm256_sign_epi32(a, _mm256_permutevar8x32_epi32(table, side));
}

INLINE void jump_hexagonal(question *q, wide number)
{
    const lanes corner_q = _mm256_setr_epi32(1, 0, -1, -1, 0, 1, 0, 0);
    const lanes corner_r = _mm256_setr_epi32(0, 1, 1, 0, -1, -1, 0, 0);
    const lanes side_q = _mm256_setr_epi32(-1, -1, 0, 1, 1, 0, 0, 0);
    const lanes side_r = _mm256_setr_epi32(1, 0, -1, -1, 0, 1, 0, 0);
    lanes side = lower_halves(upper_to_lower(product(number, every(6))));
    lanes offset = outcome_of(q->pick, q->exit);
    lanes x = _mm256_add_epi32(directed(q->radius, corner_q, side), directed(offset, side_q, side));
    q->x = _mm256_add_epi32(q->x, x);
    lanes y = _mm256_add_epi32(directed(q->radius, corner_r, side), directed(offset, side_r, side));
    q->y = _mm256_add_epi32(q->y, y);
}

INLINE void jump(bool hexagonal, question *q, wide number)
{
    if (hexagonal)
        jump_hexagonal(q, number);
    else
        jump_square(q, number);
}

/* Some come in; some leave a hexagon through a circle. */
INLINE void throw_some(const snow_ground *ground, bool hexagonal, question *q, wide number)
{
    lanes first = all(hexagonal ? (uint32_t)ground->exits.circles : SNOW_MAP_BEYOND);
    q->is_thrown = _mm256_cmpeq_epi32(_mm256_max_epu32(q->class, first), q->class);
    if (!any(q->is_thrown))
        return;
    lanes comes_in = _mm256_cmpeq_epi32(q->class, all(SNOW_MAP_BEYOND));
    lanes hexagon = hexagonal ? _mm256_i32gather_epi32(ground->exits.circle, q->class, 4) : _mm256_setzero_si256();
    sites to = throw_all(&ground->source, hexagonal, (sites){q->x, q->y}, comes_in, hexagon, number);
    q->x = choose(q->is_thrown, to.x, q->x);
    q->y = choose(q->is_thrown, to.y, q->y);
}

#define EACH(i) _Pragma("GCC unroll 4") for (int i = 0; i < count; i++)

/* All ask a question, each with its half of a block of numbers, and jump. Who has landed has a radius of 0. */
INLINE void go_on(const snow_ground *ground, bool hexagonal, question *q, snow_squad *squads,
                         wide (*block)[2], uint32_t half, int count)
{
    EACH(i) {
        snow_row *row = snow_squad_row(&squads[i], squads[i].next);
        store(row->x, q[i].x);
        store(row->y, q[i].y);
        store(row->drawn, _mm256_add_epi32(load(squads[i].lanes.drawn), all(half)));
    }
    EACH(i) {
        find_tile(&ground->plane, &q[i]);
        store(snow_squad_tiles(&squads[i], squads[i].next)->tile, told_by(&q[i]));
    }
    EACH(i) find_page(&ground->plane, &q[i]);
    EACH(i) look_near(&ground->plane, &q[i]);
    EACH(i) find_line(&ground->plane, &q[i]);
    EACH(i) look_closely(&ground->plane, &q[i]);
    EACH(i) store(snow_squad_row(&squads[i], squads[i].next++)->answer, q[i].seen);
    EACH(i) find_table(ground, hexagonal, &q[i]);
    EACH(i) find_exit(&ground->exits, &q[i], block[i][half]);
    EACH(i) jump(hexagonal, &q[i], block[i][half]);
    EACH(i) throw_some(ground, hexagonal, &q[i], block[i][half]);
}

INLINE lanes has_landed(const question *q)
{
    return _mm256_cmpeq_epi32(_mm256_or_si256(q->radius, q->is_thrown), _mm256_setzero_si256());
}

/* Two questions of each. */
INLINE void use_block(const snow_ground *ground, bool hexagonal, const uint64_t *key, snow_squad *squads,
                             int count)
{
    question q[SNOW_SQUADS];
    wide block[SNOW_SQUADS][2];
    lanes at_once[SNOW_SQUADS];
    EACH(i) draw(key, &squads[i].lanes, block[i]);
    EACH(i) q[i].x = load(squads[i].lanes.x);
    EACH(i) q[i].y = load(squads[i].lanes.y);
    go_on(ground, hexagonal, q, squads, block, 0, count);
    EACH(i) at_once[i] = has_landed(&q[i]);
    go_on(ground, hexagonal, q, squads, block, 1, count);
    EACH(i) {
        snow_lanes *walkers = &squads[i].lanes;
        store(walkers->x, q[i].x);
        store(walkers->y, q[i].y);
        /* Those who had landed at once have not used the block. */
        store(walkers->drawn, _mm256_add_epi32(load(walkers->drawn), _mm256_andnot_si256(at_once[i], all(2))));
        squads[i].landed = (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(has_landed(&q[i])));
    }
}

INLINE void walk(const snow_ground *ground, bool hexagonal, snow_squad *squads, int count)
{
    uint64_t key[2 * SNOW_RANDOM_ROUNDS];
    make_keys(key, squads[0].key);
    uint32_t landed = 0;
    for (uint32_t blocks = blocks_left(squads, count); blocks > 0 && landed == 0; blocks--) {
        use_block(ground, hexagonal, key, squads, count);
        for (int i = 0; i < count; i++)
            landed |= squads[i].landed & squads[i].busy;
    }
}

INLINE void walk_together(const snow_ground *ground, bool hexagonal, snow_squad *squads, int count)
{
    switch (count) {
    case 2: walk(ground, hexagonal, squads, 2); break;
    case 3: walk(ground, hexagonal, squads, 3); break;
    default: walk(ground, hexagonal, squads, SNOW_SQUADS); break;
    }
}

void SNOW_NAME(snow_squads_walk_, SNOW_KERNEL)(const snow_ground *ground, snow_squad *squads, int count)
{
    if (ground->exits.lattice == SNOW_AGGREGATE_HEXAGONAL)
        walk_together(ground, true, squads, count);
    else
        walk_together(ground, false, squads, count);
}

/* Which of them are answered as they were. */
INLINE uint32_t find_lasting(const snow_ground *ground, const snow_squad *squad, int lane, lanes row)
{
    enum { ROW_BITS = 5 };
    _Static_assert(sizeof(snow_row) == sizeof(int32_t) << ROW_BITS, "rows are found by shifts");
    lanes at = _mm256_slli_epi32(row, ROW_BITS);
    question q = {.x = look_up(squad->rows->x + lane, at),
                  .y = look_up(squad->rows->y + lane, at)};
    lanes answer = look_up(squad->rows->answer + lane, at);
    look(&ground->plane, &q);
    return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpeq_epi32(q.seen, answer)));
}

uint32_t SNOW_NAME(snow_squad_outdated_, SNOW_KERNEL)(const snow_ground *ground, const snow_squad *squad, int lane,
                                                 uint32_t first, uint32_t end, uint64_t since)
{
    const lanes eight = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    for (uint32_t done = 0; done < end - first; done += SNOW_LANES) {
        lanes row = _mm256_and_si256(_mm256_add_epi32(all(first + done), eight), all(squad->room - 1));
        lanes counts = _mm256_cmpgt_epi32(all(end - first - done), eight);
        uint32_t changed = find_changed(ground->plane.changed, squad, lane, row, counts, (uint32_t)since);
        if (changed != 0)
            changed &= ~find_lasting(ground, squad, lane, row);
        if (changed != 0)
            return first + done + (uint32_t)__builtin_ctz(changed);
    }
    return end;
}
