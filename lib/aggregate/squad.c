#include "aggregate/squad.h"

#ifdef SNOW_HAVE_X86_KERNELS
/* Lanes find tiles by products of 16 bits. */
static bool is_for_lanes(const snow_ground *ground)
{
    return ground->exits.lattice != SNOW_AGGREGATE_CUBIC && !ground->careful && ground->source.width == 0 &&
           ground->plane.box.columns <= INT16_MAX && ground->plane.box.rows <= INT16_MAX;
}
#endif

snow_squads_walk snow_squads_choose(const snow_ground *ground, snow_isa isa)
{
#ifdef SNOW_HAVE_X86_KERNELS
    if ((isa == SNOW_ISA_AVX2 || isa == SNOW_ISA_AVX512) && is_for_lanes(ground))
        return snow_squads_walk_avx2;
#else
    (void)ground;
    (void)isa;
#endif
    return snow_squads_walk_in_turn;
}

void snow_squad_enter(snow_squad *squad, int lane)
{
    const snow_flight *flight = &squad->flight[lane];
    snow_lanes *lanes = &squad->lanes;
    lanes->x[lane] = flight->x;
    lanes->y[lane] = flight->y;
    lanes->drawn[lane] = flight->draws.used;
    lanes->low[lane] = (uint32_t)flight->draws.walker;
    lanes->high[lane] = (uint32_t)(flight->draws.walker >> 32);
    squad->busy |= 1u << lane;
    squad->landed &= ~(1u << lane);
}

snow_stay snow_squad_leave(const snow_ground *ground, snow_squad *squad, int lane)
{
    squad->busy &= ~(1u << lane);
    bool landed = squad->landed >> lane & 1;
    const snow_flight *flight = &squad->flight[lane];
    if (ground->walk == snow_squads_walk_in_turn)
        return (snow_stay){{flight->x, flight->y, flight->z}, flight->draws.used, landed};
    return (snow_stay){{squad->lanes.x[lane], squad->lanes.y[lane], 0}, squad->lanes.drawn[lane], landed};
}

snow_stay snow_squad_asked(const snow_squad *squad, int lane, uint32_t row)
{
    const snow_row *asked = snow_squad_row(squad, row);
    return (snow_stay){{asked->x[lane], asked->y[lane], asked->z[lane]}, asked->drawn[lane], false};
}
