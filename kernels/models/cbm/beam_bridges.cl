/* Brittle beams that bridge a crack of a solid (cbm; docs/notebook/fracture.md "Brittle beams across a crack"). An
 * element loses a beam by its mean stress with its neighbours, which the beams that cross a crack behind its tip hardly
 * move: the last ones would bear many times what a plane of the solid asks of each, and the sides would never part.
 * Such a beam breaks where its ends have moved apart by BRIDGE_ENDS times the opening at which the beams across a plane
 * bear the strength, and by as much more as the element is pressed, since pushes shear and bend beams too.
 *
 * Ends that part by s along d load a beam of the stiffness k K by s k sqrt(K), K = kappa + (1 - kappa) (e.d)^2, of
 * which 2/3 over (kappa + (1 - kappa) / 2), times sqrt(K), is its part of a plane across d (beam_onset.cl): so all
 * beams of the plane come to it at the same s.
 *
 * bears [n]: limit in tension times six volumes over the number of beams, what a beam of the element bears times its
 * length (brc_bond_area) [N m]; 0: its beams do not break so. broken [n]: beams that the element lost. */
#define BRIDGE_ENDS REAL(6)
/* Elements beside a crack have lost more than one. */
#define BRIDGE_LOST STATE(1)

/* Largest push on an element, its mean's [Pa]. */
ROUTINE coeff bridge_push(int e, int level, OWN(int) row_start, OWN(int) neighbour, GATHER(coeff) record)
{
    const failure_stress mean = fracture_mean_of(e, level, row_start, neighbour, record);
    const failure_principal p = failure_principal_of(mean);
    return p.third < 0 ? -p.third : REAL(0);
}

/* After the elements chose: those beside a crack that chose none choose the one whose ends are farthest apart. */
KERNEL void beam_bridges_choose(int n_groups, int level, int step, int weighted, OWN(int) row_start, OWN(int) neighbour,
                                OWN(coeff) branch, OWN(coeff) inv_length, GATHER(state) displacement,
                                GATHER(state) orientation, coeff axial, coeff bend, coeff twist, GATHER(coeff) beam_of,
                                OWN(coeff) limits, GATHER(coeff) record, OWN(coeff) factor, OWN(coeff) bears,
                                OWN(state) broken, UPDATE(int) choice, PUT(coeff) measure, SCATTER(int) mark)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
        int looks = 0;
        for (int l = 0; l < W; ++l)
            looks |= (broken[first + l] > BRIDGE_LOST && bears[first + l] > 0 && choice[first + l] < 0) << l;
        if (looks) {
            const cbm_own own = cbm_own_of(group, displacement, orientation, 1);
            const lane capacity = lane_load(bears, (brc_size)first);
            coeff most[W];
            for (int l = 0; l < W; ++l) most[l] = REAL(1);
            for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
                const brc_size entry = (brc_size)slot * C + (brc_size)lane0;
                const cbm_bond bond = cbm_bond_at(slot, lane0, own, neighbour, branch, inv_length, displacement,
                                                  orientation, axial, bend, twist, beam_of, 1);
                const lane_vec3 way = beam_opening(bond.shape);
                const lane apart = LANE_SQRT(lane_vec3_dot(way, way)), along = lane_vec3_dot(way, cbm_axis(bond.shape));
                const lane k = bond.stiffness.axial * bond.inv_length0,
                           load = REAL(0.75) * (k + k * beam_kappa(bond)) * apart,
                           least = BRIDGE_ENDS * bond.inv_length0 * capacity *
                                   (weighted ? lane_load(factor, entry) : LANE_ZERO + REAL(1));
                /* Broken beams have neither. */
#define CHOOSE(l)                                                                                                      \
    if ((looks >> 0x##l & 1) && LANE_ITEM(load, l) > LANE_ITEM(least, l) && LANE_ITEM(along, l) > 0) {                 \
        const int e = first + 0x##l, j = neighbour[entry + 0x##l];                                                     \
        const coeff own_limit = limits[(brc_size)e * 3] * (weighted ? factor[entry + 0x##l] : REAL(1)),                \
                    times = LANE_ITEM(load, l) / LANE_ITEM(least, l);                                                  \
        if (times > most[0x##l] &&                                                                                     \
            (times - REAL(1)) * own_limit > bridge_push(e, level, row_start, neighbour, record)) {                     \
            most[0x##l] = times;                                                                                       \
            choice[e] = 4 * j + FAILURE_TENSION;                                                                       \
            measure[e] = BRIDGE_ENDS * times * own_limit;                                                              \
            STORE_SAME(mark + group, step);                                                                            \
            STORE_SAME(mark + j / W, step);                                                                            \
        }                                                                                                              \
    }
                LANE_EACH(CHOOSE)
#undef CHOOSE
            }
        }
    }
}
