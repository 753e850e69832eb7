#include "aggregate/squad.h"

#ifdef SNOW_HAVE_X86_KERNELS
/* Lanes find tiles of the plane by products of 16 bits. */
static bool is_for_lanes(const snow_ground *ground)
{
    return !ground->careful && ground->source.width == 0 && ground->plane.box.columns <= INT16_MAX &&
           ground->plane.box.rows <= INT16_MAX;
}

static void choose_lanes(snow_ground *ground, snow_isa isa)
{
    bool space = ground->exits.lattice == SNOW_AGGREGATE_CUBIC;
    if (isa == SNOW_ISA_AVX2) {
        ground->walk = space ? snow_squads_walk_space_avx2 : snow_squads_walk_avx2;
        ground->outdated = space ? snow_squad_outdated_space_avx2 : snow_squad_outdated_avx2;
    } else if (isa == SNOW_ISA_AVX512) {
        ground->walk = space ? snow_squads_walk_space_avx512 : snow_squads_walk_avx512;
        ground->outdated = space ? snow_squad_outdated_space_avx512 : snow_squad_outdated_avx512;
    }
}
#endif

void snow_squads_choose(snow_ground *ground, snow_isa isa)
{
    ground->walk = snow_squads_walk_in_turn;
    ground->outdated = snow_squad_outdated;
#ifdef SNOW_HAVE_X86_KERNELS
    if (is_for_lanes(ground))
        choose_lanes(ground, isa);
#else
    (void)isa;
#endif
}

void snow_squad_enter(snow_squad *squad, int lane)
{
    const snow_flight *flight = &squad->flight[lane];
    snow_lanes *lanes = &squad->lanes;
    lanes->x[lane] = flight->x;
    lanes->y[lane] = flight->y;
    lanes->z[lane] = flight->z;
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
    const snow_lanes *lanes = &squad->lanes;
    return (snow_stay){{lanes->x[lane], lanes->y[lane], lanes->z[lane]}, lanes->drawn[lane], landed};
}

snow_stay snow_squad_asked(const snow_squad *squad, int lane, uint32_t row)
{
    const snow_row *asked = snow_squad_row(squad, row);
    int32_t z = squad->heights != NULL ? snow_squad_heights(squad, row)->z[lane] : 0;
    return (snow_stay){{asked->x[lane], asked->y[lane], z}, asked->drawn[lane], false};
}
