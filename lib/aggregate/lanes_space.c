/* Squads in the lanes of vectors, on the cubic lattice: lanes_plane.c in space.

   Pages and lines have numbers, so what is looked up has 32 bits, but for the
   columns of the exit laws. To come in, or to leave a ball, takes a whole block of
   numbers: lanes do it with the first question of one, and stand still in the second. */
#include "aggregate/lanes_ball.h"

/* What a question needs from one link of the chain to the next. */
typedef struct question {
    lanes x, y, z;
    lanes u, v, w; /* from the corner of the map */
    lanes inside;
    lanes tile; /* 0 outside */
    lanes page;
    lanes near, is_close;
    lanes line;
    lanes seen; /* 0, a class, or SNOW_MAP_BEYOND */
    lanes class;
    lanes is_thrown; /* onto a sphere, with this block */
    lanes radius, first;
    wide pick, exit;
} question;

INLINE lanes is_below(lanes a, uint32_t end)
{
    return _mm256_cmpeq_epi32(_mm256_min_epu32(a, all(end - 1)), a);
}

/* The bits of a mask, moved up (down, where negative) to where they are wanted. */
INLINE lanes bits_of(lanes a, int up, uint32_t mask)
{
    lanes shifted = up < 0 ? _mm256_srli_epi32(a, -up) : _mm256_slli_epi32(a, up);
    return _mm256_and_si256(shifted, all(mask));
}

INLINE lanes together(lanes a, lanes b, lanes c)
{
    return _mm256_or_si256(_mm256_or_si256(a, b), c);
}

/* What follows is snow_space_map_tile(), snow_space_map_find() and snow_space_map_look(). */
INLINE void find_tile(const snow_space_map *map, question *q)
{
    const snow_space_box *box = &map->box;
    q->u = _mm256_sub_epi32(q->x, all((uint32_t)box->x));
    q->v = _mm256_sub_epi32(q->y, all((uint32_t)box->y));
    q->w = _mm256_sub_epi32(q->z, all((uint32_t)box->z));
    lanes column = _mm256_srli_epi32(q->u, 4);
    lanes row = _mm256_srli_epi32(q->v, 4);
    lanes layer = _mm256_srli_epi32(q->w, 4);
    q->inside = _mm256_and_si256(_mm256_and_si256(is_below(column, box->columns), is_below(row, box->rows)),
                                 is_below(layer, box->layers));
    lanes rows = _mm256_add_epi32(_mm256_mullo_epi32(layer, all(box->rows)), row);
    lanes tile = _mm256_add_epi32(_mm256_mullo_epi32(rows, all(box->columns)), column);
    q->tile = _mm256_and_si256(tile, q->inside);
}

/* For diaries: negative outside. */
INLINE lanes told_by(const question *q)
{
    return _mm256_or_si256(q->tile, _mm256_xor_si256(q->inside, all(UINT32_MAX)));
}

INLINE void find_page(const snow_space_map *map, question *q)
{
    q->page = look_up_some((const void *)map->tile, q->tile, q->inside);
}

/* Four bytes at once. */
INLINE void look_near(const snow_space_map *map, question *q)
{
    lanes at = together(_mm256_slli_epi32(q->page, 4), bits_of(q->w, 0, 12), bits_of(q->v, -2, 3));
    lanes four = look_up(map->near, at);
    q->near = _mm256_and_si256(_mm256_srlv_epi32(four, bits_of(q->u, 1, 24)), all(255));
    q->is_close = _mm256_cmpgt_epi32(all(SNOW_SPACE_LOOK), q->near);
}

INLINE void find_line(const snow_space_map *map, question *q)
{
    lanes octant = together(bits_of(q->w, -1, 4), bits_of(q->v, -2, 2), bits_of(q->u, -3, 1));
    q->line = _mm256_or_si256(look_up_some((const void *)map->first_line, q->page, q->is_close), octant);
}

/* Two pairs at once. */
INLINE void look_closely(const snow_space_map *map, question *q)
{
    lanes place = together(bits_of(q->w, 2, 24), bits_of(q->v, 0, 6), bits_of(q->u, -2, 1));
    lanes two = look_up_some(map->line, _mm256_or_si256(_mm256_slli_epi32(q->line, 5), place), q->is_close);
    lanes pair = _mm256_srlv_epi32(two, bits_of(q->u, 3, 16));
    lanes octant = together(bits_of(q->w, 2, 4), bits_of(q->v, 1, 2), bits_of(q->u, 0, 1));
    lanes further = _mm256_and_si256(_mm256_srlv_epi32(pair, octant), all(1));
    lanes exact = _mm256_add_epi32(bits_of(pair, -8, 255), further);
    q->seen = choose(q->is_close, exact, q->near);
}

INLINE void look(const snow_space_map *map, question *q)
{
    find_tile(map, q);
    find_page(map, q);
    look_near(map, q);
    find_line(map, q);
    look_closely(map, q);
}

/* Free distance from the cluster, outside the map. */
INLINE lanes clear_of(const snow_source_of_walkers *source, const question *q)
{
    lanes most = _mm256_max_epi32(_mm256_abs_epi32(q->x), _mm256_abs_epi32(q->y));
    return _mm256_sub_epi32(_mm256_max_epi32(most, _mm256_abs_epi32(q->z)), all((uint32_t)source->reach));
}

/* Who is outside is thrown onto a sphere with both numbers of the block, or, next to the
   cluster, jumps with the first one. */
INLINE void go_outside(const snow_ground *ground, question *q, const wide block[2])
{
    lanes outside = _mm256_cmpeq_epi32(q->seen, all(SNOW_MAP_BEYOND));
    q->is_thrown = _mm256_setzero_si256();
    if (!any(outside))
        return;
    lanes clear = clear_of(&ground->source, q);
    lanes is_beyond = _mm256_cmpgt_epi32(clear, all((uint32_t)ground->source.safe));
    outsiders who = {q->x, q->y, q->z, _mm256_and_si256(is_beyond, outside)};
    q->is_thrown = _mm256_and_si256(throw_all(&ground->source, &who, block), outside);
    q->x = choose(q->is_thrown, who.x, q->x);
    q->y = choose(q->is_thrown, who.y, q->y);
    q->z = choose(q->is_thrown, who.z, q->z);
    lanes is_near = _mm256_andnot_si256(q->is_thrown, outside);
    q->class = choose(is_near, class_near(&ground->exits, clear, is_near), q->class);
}

INLINE void find_table(const snow_exits *exits, question *q)
{
    lanes place = look_up(exits->place, q->class);
    q->radius = _mm256_and_si256(place, all((1u << SNOW_EXIT_RADIUS_BITS) - 1));
    q->first = _mm256_srli_epi32(place, SNOW_EXIT_RADIUS_BITS);
}

/* snow_exit_table_pick() */
INLINE void find_exit(const snow_exits *exits, question *q, wide number)
{
    lanes next = _mm256_add_epi32(q->radius, all(1));
    wide columns = widened(_mm256_srli_epi32(_mm256_mullo_epi16(q->radius, next), 1));
    q->pick = plus(product(upper_to_lower(number), columns), upper_to_lower(product(number, columns)));
    q->exit = fetch_from(exits->exit, plus(upper_to_lower(q->pick), widened(q->first)));
}

INLINE lanes is_axis(lanes side, uint32_t axis)
{
    return _mm256_cmpeq_epi32(_mm256_srli_epi32(side, 1), all(axis));
}

/* To one of the 48 images of an exit: as image_of_cube of flight.c has them. */
INLINE void jump(question *q, wide number)
{
    lanes outcome = outcome_of(q->pick, q->exit);
    lanes symmetry = lower_halves(number);
    lanes side = lower_halves(upper_to_lower(product(number, every(6))));
    lanes swaps = _mm256_srai_epi32(_mm256_slli_epi32(symmetry, 29), 31);
    lanes greater = _mm256_srli_epi32(outcome, 8);
    lanes smaller = _mm256_and_si256(outcome, all(255));
    greater = signed_by(greater, _mm256_slli_epi32(symmetry, 31));
    smaller = signed_by(smaller, _mm256_slli_epi32(symmetry, 30));
    lanes across = signed_by(q->radius, _mm256_slli_epi32(side, 31));
    lanes first = choose(swaps, smaller, greater);
    lanes second = choose(swaps, greater, smaller);
    lanes along_x = is_axis(side, 0);
    lanes along_z = is_axis(side, 2);
    lanes middle = choose(along_x, first, choose(along_z, second, across));
    q->x = _mm256_add_epi32(q->x, choose(along_x, across, first));
    q->y = _mm256_add_epi32(q->y, middle);
    q->z = _mm256_add_epi32(q->z, choose(along_z, across, second));
}

#define EACH(i) _Pragma("GCC unroll 4") for (int i = 0; i < count; i++)

/* All ask a question. Who has been thrown with this block asks anew after it. */
INLINE void ask(const snow_ground *ground, question *q, snow_squad *squads, uint32_t half, int count)
{
    const snow_space_map *map = &ground->space;
    EACH(i) {
        snow_row *row = snow_squad_row(&squads[i], squads[i].next);
        store(row->x, q[i].x);
        store(row->y, q[i].y);
        store(snow_squad_heights(&squads[i], squads[i].next)->z, q[i].z);
        lanes used = _mm256_sub_epi32(all(half), q[i].is_thrown);
        store(row->drawn, _mm256_add_epi32(load(squads[i].lanes.drawn), used));
    }
    EACH(i) {
        find_tile(map, &q[i]);
        store(snow_squad_tiles(&squads[i], squads[i].next)->tile, told_by(&q[i]));
    }
    EACH(i) find_page(map, &q[i]);
    EACH(i) look_near(map, &q[i]);
    EACH(i) find_line(map, &q[i]);
    EACH(i) look_closely(map, &q[i]);
    EACH(i) store(snow_squad_row(&squads[i], squads[i].next++)->answer, q[i].seen);
    EACH(i) q[i].class = q[i].seen;
}

/* Each with its half of a block of numbers. Who has landed has a radius of 0, and who is thrown. */
INLINE void jump_all(const snow_ground *ground, question *q, wide (*block)[2], uint32_t half, int count)
{
    EACH(i) find_table(&ground->exits, &q[i]);
    EACH(i) find_exit(&ground->exits, &q[i], block[i][half]);
    EACH(i) jump(&q[i], block[i][half]);
}

INLINE lanes has_landed(const question *q)
{
    return _mm256_cmpeq_epi32(q->seen, _mm256_setzero_si256());
}

/* Two questions of each. */
INLINE void use_block(const snow_ground *ground, const uint64_t *key, snow_squad *squads, int count)
{
    question q[SNOW_SQUADS];
    wide block[SNOW_SQUADS][2];
    lanes at_once[SNOW_SQUADS];
    EACH(i) draw(key, &squads[i].lanes, block[i]);
    EACH(i) q[i].x = load(squads[i].lanes.x);
    EACH(i) q[i].y = load(squads[i].lanes.y);
    EACH(i) q[i].z = load(squads[i].lanes.z);
    EACH(i) q[i].is_thrown = _mm256_setzero_si256();
    ask(ground, q, squads, 0, count);
    EACH(i) at_once[i] = has_landed(&q[i]);
    EACH(i) go_outside(ground, &q[i], block[i]);
    jump_all(ground, q, block, 0, count);
    ask(ground, q, squads, 1, count);
    EACH(i) q[i].class = choose(q[i].is_thrown, all(SNOW_MAP_BEYOND), q[i].class);
    jump_all(ground, q, block, 1, count);
    EACH(i) {
        snow_lanes *walkers = &squads[i].lanes;
        store(walkers->x, q[i].x);
        store(walkers->y, q[i].y);
        store(walkers->z, q[i].z);
        /* Those who had landed at once have not used the block. */
        store(walkers->drawn, _mm256_add_epi32(load(walkers->drawn), _mm256_andnot_si256(at_once[i], all(2))));
        squads[i].landed = (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(has_landed(&q[i])));
    }
}

INLINE void walk(const snow_ground *ground, snow_squad *squads, int count)
{
    uint64_t key[2 * SNOW_RANDOM_ROUNDS];
    make_keys(key, squads[0].key);
    uint32_t landed = 0;
    for (uint32_t blocks = blocks_left(squads, count); blocks > 0 && landed == 0; blocks--) {
        use_block(ground, key, squads, count);
        for (int i = 0; i < count; i++)
            landed |= squads[i].landed & squads[i].busy;
    }
}

void SNOW_NAME(snow_squads_walk_space_, SNOW_KERNEL)(const snow_ground *ground, snow_squad *squads, int count)
{
    switch (count) {
    case 2: walk(ground, squads, 2); break;
    case 3: walk(ground, squads, 3); break;
    default: walk(ground, squads, SNOW_SQUADS); break;
    }
}

/* Which of them are answered as they were. */
INLINE uint32_t find_lasting(const snow_ground *ground, const snow_squad *squad, int lane, lanes row)
{
    enum { ROW_BITS = 5, HEIGHT_BITS = 3 };
    _Static_assert(sizeof(snow_row) == sizeof(int32_t) << ROW_BITS, "rows are found by shifts");
    _Static_assert(sizeof(snow_heights) == sizeof(int32_t) << HEIGHT_BITS, "heights are found by shifts");
    lanes at = _mm256_slli_epi32(row, ROW_BITS);
    question q = {.x = look_up(squad->rows->x + lane, at),
                  .y = look_up(squad->rows->y + lane, at),
                  .z = look_up(squad->heights->z + lane, _mm256_slli_epi32(row, HEIGHT_BITS))};
    lanes answer = look_up(squad->rows->answer + lane, at);
    look(&ground->space, &q);
    return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpeq_epi32(q.seen, answer)));
}

uint32_t SNOW_NAME(snow_squad_outdated_space_, SNOW_KERNEL)(const snow_ground *ground, const snow_squad *squad,
                                                            int lane, uint32_t first, uint32_t end, uint64_t since)
{
    const lanes eight = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    for (uint32_t done = 0; done < end - first; done += SNOW_LANES) {
        lanes row = _mm256_and_si256(_mm256_add_epi32(all(first + done), eight), all(squad->room - 1));
        lanes counts = _mm256_cmpgt_epi32(all(end - first - done), eight);
        uint32_t changed = find_changed(ground->space.changed, squad, lane, row, counts, (uint32_t)since);
        if (changed != 0)
            changed &= ~find_lasting(ground, squad, lane, row);
        if (changed != 0)
            return first + done + (uint32_t)__builtin_ctz(changed);
    }
    return end;
}
