/* Brittle beams of an interface that hold on alone (cbm; docs/notebook/fracture.md "Fracture energy of beams"). An
 * element loses a beam by its mean stress, which the last beam of a plane turns along itself: it never stands across
 * that beam's interface. Such a beam breaks where it carries HOLD_ALONE times its part of the plane's strength
 * (beam_onset.cl), the sides parting as its own ends do. (Beams that soften begin to at three times: brittle ones throw
 * all that they bore on their neighbours.)
 *
 * hold [slot][HOLD][C]: strength times area [N] and area [m^2] of beams that may; zeros: none. holds [n / W]: 1 where
 * the group has some. */
#define HOLD 2
#define HOLD_ALONE REAL(4)

/* How an interface of this normal, out of the own element, lies to a beam along axis0 whose sides slide along it; beams
 * that lean back over a plane that is not quite theirs lie in it. */
LAW beam_lean beam_lean_in(lane_vec3 axis0, lane_vec3 plane)
{
    const lane zero = LANE_ZERO, one = zero + REAL(1), cosine = lane_vec3_dot(axis0, plane),
               c = lane_min(lane_max(cosine, zero), one);
    const lane_vec3 side = lane_vec3_sub(plane, lane_vec3_scale(cosine, axis0));
    const lane per = one / LANE_SQRT(lane_max(lane_vec3_dot(side, side), zero + REAL(1e-12)));
    return (beam_lean){lane_vec3_scale(per, side), c, zero - one, zero, one};
}

/* A whole beam: its pull over HOLD_ALONE times its part, and its stress [Pa]. */
typedef struct {
    coeff over, stress;
} beam_lone;
LAW beam_lone beam_lone_of(OWN(coeff) hold, int slot, int at, coeff y, coeff k, soft_vector beam, soft_vector way,
                           soft_vector plane, coeff kappa)
{
    GLOBAL const coeff *own = hold + (brc_size)slot * HOLD * C + at;
    const coeff push = soft_dot(way, plane), pull = SQRT(REAL(2) * k * (y > 0 ? y : 0));
    const soft_vector parts = push < 0 ? soft_add(way, -push, plane) : way;
    const beam_laid share = beam_share(beam, parts, plane, kappa);
    return (beam_lone){pull / (HOLD_ALONE * share.part * own[0]), pull / own[C]};
}

/* After the elements chose: those that chose no beam choose the one farthest above. */
KERNEL void beam_alone_choose(int n_groups, int step, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch,
                              OWN(coeff) inv_length, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                              coeff bend, coeff twist, GATHER(coeff) beam_of, OWN(coeff) plane, OWN(int) holds,
                              OWN(coeff) hold, UPDATE(int) choice, PUT(coeff) measure, SCATTER(int) mark)
{
    FOR_EACH_ITEM(group, n_groups) {
        if (holds[group]) {
            const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
            const cbm_own own = cbm_own_of(group, displacement, orientation, 1);
            coeff most[W];
            for (int l = 0; l < W; ++l) most[l] = REAL(1);
            for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
                const brc_size entry = (brc_size)slot * C + (brc_size)lane0;
                int any = 0;
                for (int l = 0; l < W; ++l)
                    any |= hold[(brc_size)slot * HOLD * C + (brc_size)(lane0 + l)] > 0 &&
                           neighbour[entry + (brc_size)l] != first + l;
                if (!any) continue;
                const cbm_bond bond = cbm_bond_at(slot, lane0, own, neighbour, branch, inv_length, displacement,
                                                  orientation, axial, bend, twist, beam_of, 1);
                const lane k = bond.stiffness.axial * bond.inv_length0, kappa = beam_kappa(bond),
                           whole = cbm_beam_energy(bond.shape, bond.inv_length0, bond.stiffness, 1);
                /* No part is below b sqrt(kappa), that of a beam across sides that part along the normal, and a pull
                 * is not above the root of the beam's energy. */
                const lane capacity = lane_block(hold, slot, HOLD, 0, lane0),
                           least = REAL(4) * HOLD_ALONE * LANE_SQRT(kappa) / (REAL(3) + REAL(3) * kappa) * capacity,
                           room = least * least - REAL(2) * k * whole;
                int some = 0;
#define SOME(l)                                                                                                        \
    some |= LANE_ITEM(capacity, l) > 0 && LANE_ITEM(room, l) < 0 && neighbour[entry + 0x##l] != first + 0x##l;
                LANE_EACH(SOME)
#undef SOME
                if (!some) continue;
                const lane_quat q_j = lane_gather4(orientation, int_block(neighbour, slot, lane0));
                const lane_vec3 axis0 = lane_vec3_scale(bond.inv_length0, lane_block3(branch, slot, lane0)),
                                normal = lane_block3(plane, slot, lane0);
                const beam_lean lean = beam_lean_in(axis0, normal);
                const beam_part part = beam_part_of(bond, axis0, own, q_j, lean);
                const lane y = part.energy;
                const lane_vec3 opening = beam_opening(bond.shape);
                const lane_vec3 back =
                    lane_vec3_add(opening, quat_rotate_minus_identity(quat_conjugate(own.orientation), opening, 1));
#define CHOOSE(l)                                                                                                      \
    if (LANE_ITEM(capacity, l) > 0 && neighbour[entry + 0x##l] != first + 0x##l) {                                     \
        const beam_lone lone =                                                                                         \
            beam_lone_of(hold, slot, lane0 + 0x##l, LANE_ITEM(y, l), LANE_ITEM(k, l),                                  \
                         (soft_vector){LANE_ITEM(axis0.x, l), LANE_ITEM(axis0.y, l), LANE_ITEM(axis0.z, l)},           \
                         (soft_vector){LANE_ITEM(back.x, l), LANE_ITEM(back.y, l), LANE_ITEM(back.z, l)},              \
                         (soft_vector){LANE_ITEM(normal.x, l), LANE_ITEM(normal.y, l), LANE_ITEM(normal.z, l)},        \
                         LANE_ITEM(kappa, l));                                                                         \
        const int e = first + 0x##l, j = neighbour[entry + 0x##l];                                                     \
        if (lone.over > most[0x##l] && (choice[e] < 0 || most[0x##l] > REAL(1))) {                                     \
            most[0x##l] = lone.over;                                                                                   \
            choice[e] = 4 * j + FAILURE_TENSION;                                                                       \
            measure[e] = lone.stress;                                                                                  \
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
