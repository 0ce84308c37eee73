/* Beams that open against cohesion (cbm; docs/notebook/fracture.md "Fracture energy of beams", softening.h). A
 * beam that its element would lose (fracture.cl) keeps (1 - D) of its energy instead, but for what a crack leaves to it
 * (beam_carried.h), which it keeps whole; and so of its force and moments: what D takes is taken back here after the
 * elastic passes, which run over whole beams as ever. At fixed D the force is the gradient of the energy, and both ends
 * feel the same.
 *
 * D follows from the one law of all softening bonds: the energy Y of the whole beam, less what a crack leaves to it, is
 * that of a spring of stiffness k = E S / l0, stretched by sqrt(2 Y / k); in series with it the beam opens, and the
 * cohesion balances the spring (soft_opening). D is the secant to where it stood at its widest.
 *
 * crack [n_slots][BEAM_WIDTH][C], of an entry: DAMAGE D [-]; START, ENERGY: soft_face (START before it opens:
 * beam_least; ENERGY: G_c area, of a crack across the beam) [N] [J]; EXPONENTIAL: 1, else linear; WIDEST: largest
 * opening [m]; HELD: Y as of the last step [J]; SPENT: energy that the opening took so far, BOOKED: by the last step
 * [J]; ONSET: stress of the element that failed [Pa], MODE of it; TILT: |cos| of the beam and its opening, not less
 * than the steepest [-]; CAPACITY: strength times area [N]; PER_AREA: one over the area [1/m^2]; SIDE (3 components),
 * ALONG, COSINE, SINE, KEEPS: beam_lean; LATERAL: nu / E [1/Pa]. Entries: open: 0 whole, 1 opens, 2 its cohesion ended
 * in this step, 3 broken; lead: BEAM_LEADS on the side with the lower id, which computes for both, BEAM_JOINED of an
 * interface; twin: the other entry. active [n / W], touched [n]: 1 from the first opening of the group and of the
 * element on, active also with beams of an interface; raised [n / W]: the same, of openings that beam_soft_keep has not
 * seen yet too.
 */

#define BEAM_DAMAGE 0
#define BEAM_START 1
#define BEAM_ENERGY 2
#define BEAM_EXPONENTIAL 3
#define BEAM_WIDEST 4
#define BEAM_HELD 5
#define BEAM_SPENT 6
#define BEAM_BOOKED 7
#define BEAM_ONSET 8
#define BEAM_MODE 9
#define BEAM_TILT 10
#define BEAM_CAPACITY 11
#define BEAM_PER_AREA 12
#define BEAM_SIDE 13
#define BEAM_ALONG 16
#define BEAM_COSINE 17
#define BEAM_SINE 18
#define BEAM_KEEPS 19
#define BEAM_LATERAL 20
#define BEAM_WIDTH 21
#define BEAM_WHOLE 0
#define BEAM_OPENS 1
#define BEAM_ENDED 2
#define BEAM_BROKEN 3
#define BEAM_LEADS 1
#define BEAM_JOINED 2
#define BEAM_NEVER REAL(1e30) /* factor of a bond that is not chosen again */

#define BEAM_COMPONENT(entry, c) crack[(((entry) / C) * BEAM_WIDTH + (c)) * C + (entry) % C]
#define BEAM_NUMBER(entry, what) BEAM_COMPONENT(entry, BEAM_##what)

LAW beam_lean beam_lean_at(OWN(coeff) crack, int slot, int lane0)
{
    return (beam_lean){{lane_block(crack, slot, BEAM_WIDTH, BEAM_SIDE, lane0),
                        lane_block(crack, slot, BEAM_WIDTH, BEAM_SIDE + 1, lane0),
                        lane_block(crack, slot, BEAM_WIDTH, BEAM_SIDE + 2, lane0)},
                       lane_block(crack, slot, BEAM_WIDTH, BEAM_ALONG, lane0),
                       lane_block(crack, slot, BEAM_WIDTH, BEAM_COSINE, lane0),
                       lane_block(crack, slot, BEAM_WIDTH, BEAM_SINE, lane0),
                       lane_block(crack, slot, BEAM_WIDTH, BEAM_KEEPS, lane0)};
}

/* What D takes a share of: all of a beam but what a crack leaves to it. */
typedef struct {
    cbm_end end;
    lane energy; /* Y [J] */
} beam_part;
LAW beam_part beam_part_of(cbm_bond bond, lane_vec3 axis0, cbm_own own, lane_quat q_j, beam_lean lean)
{
    const cbm_end end = cbm_beam_law(bond.shape, bond.inv_length0, bond.stiffness, 1);
    const beam_carry left =
        beam_carried(bond.shape, bond.inv_length0, bond.stiffness, bond.branch, axis0, own.orientation, q_j, lean);
    return (beam_part){{lane_vec3_sub(end.force, left.end.force), lane_vec3_sub(end.torque, left.end.torque)},
                       cbm_beam_energy(bond.shape, bond.inv_length0, bond.stiffness, 1) - left.energy};
}

/* |cos| between the axis and the opening. */
LAW lane beam_cosine(cbm_bond bond)
{
    const lane_vec3 opening = beam_opening(bond.shape);
    const lane along = lane_vec3_dot(opening, cbm_axis(bond.shape)) * bond.inv_length0;
    return LANE_SQRT(along * along /
                     (lane_vec3_dot(opening, opening) + REAL(1e-30) * bond.shape.length0 * bond.shape.length0));
}

/* Any lane of a slot: open has one of the two states. */
LAW int beam_any(OWN(int) open, brc_size entry, int one, int other)
{
    int any = 0;
    for (int l = 0; l < W; ++l) any |= open[entry + (brc_size)l] == one || open[entry + (brc_size)l] == other;
    return any;
}

/* Sums over the beams of a group of what D takes. */
typedef struct {
    lane_vec3 force, torque;
    lane_sym3 virial; /* its parts off the diagonal twice, cbm_virial_of */
    lane energy;
} beam_loss;
LAW beam_loss beam_group_loss(int group, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch,
                              OWN(coeff) inv_length, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                              coeff bend, coeff twist, GATHER(coeff) beam_of, OWN(int) open, OWN(coeff) crack)
{
    const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), last = row_start[slice + 1];
    const cbm_own own = cbm_own_of(group, displacement, orientation, 1);
    const lane zero = LANE_ZERO;
    beam_loss sum = {{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero, zero, zero, zero}, zero};
    for (int slot = row_start[slice]; slot < last; ++slot) {
        if (!beam_any(open, (brc_size)slot * C + (brc_size)lane0, BEAM_OPENS, BEAM_ENDED)) continue;
        const cbm_bond bond = cbm_bond_at(slot, lane0, own, neighbour, branch, inv_length, displacement, orientation,
                                          axial, bend, twist, beam_of, 1);
        const lane_quat q_j = lane_gather4(orientation, int_block(neighbour, slot, lane0));
        const beam_part part = beam_part_of(bond, lane_vec3_scale(bond.inv_length0, lane_block3(branch, slot, lane0)),
                                            own, q_j, beam_lean_at(crack, slot, lane0));
        const lane damage = lane_block(crack, slot, BEAM_WIDTH, BEAM_DAMAGE, lane0);
        const lane_vec3 f = lane_vec3_scale(damage, part.end.force);
        sum.force = lane_vec3_add(sum.force, f);
        sum.torque = lane_vec3_add(sum.torque, lane_vec3_scale(damage, part.end.torque));
        sum.virial = cbm_add_virial(sum.virial, bond.branch, f);
        sum.energy += damage * part.energy;
    }
    return sum;
}

LAW void beam_take(UPDATE(state) to, int e, coeff x, coeff y, coeff z)
{
    to[(brc_size)e * 3] -= (state)x, to[(brc_size)e * 3 + 1] -= (state)y, to[(brc_size)e * 3 + 2] -= (state)z;
}

/* After fracture_force: forces, torques and records of what the beams still carry. */
KERNEL void beam_soft_force(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch,
                            OWN(coeff) inv_length, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                            coeff bend, coeff twist, GATHER(coeff) beam_of, coeff inv_tension, coeff inv_compression,
                            coeff inv_shear, int drucker_prager, coeff slope, OWN(int) active, OWN(int) open,
                            OWN(coeff) crack, UPDATE(state) force, UPDATE(state) torque, UPDATE(coeff) record,
                            PUT(coeff) stress_bound)
{
    FOR_EACH_ITEM(group, n_groups) {
        if (active[group]) {
            const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
            const beam_loss loss = beam_group_loss(group, row_start, neighbour, branch, inv_length, displacement,
                                                   orientation, axial, bend, twist, beam_of, open, crack);
            const lane_vec3 f = loss.force, t = loss.torque;
#define TAKE(l)                                                                                                        \
    beam_take(force, first + 0x##l, LANE_ITEM(f.x, l), LANE_ITEM(f.y, l), LANE_ITEM(f.z, l));                          \
    beam_take(torque, first + 0x##l, LANE_ITEM(t.x, l), LANE_ITEM(t.y, l), LANE_ITEM(t.z, l));
            LANE_EACH(TAKE)
#undef TAKE
            const lane_sym3 v = cbm_virial_of(loss.virial);
            const lane_sym3 left = {
                lane_block(record, slice, RECORD, 0, lane0) - v.xx, lane_block(record, slice, RECORD, 1, lane0) - v.yy,
                lane_block(record, slice, RECORD, 2, lane0) - v.zz, lane_block(record, slice, RECORD, 3, lane0) - v.yz,
                lane_block(record, slice, RECORD, 4, lane0) - v.xz, lane_block(record, slice, RECORD, 5, lane0) - v.xy};
            const failure_scale scale = {inv_tension, inv_compression, inv_shear, drucker_prager, slope};
            fracture_put_record(group, left, scale, record, stress_bound);
        }
    }
}

/* After cbm_energy [J] [n], half to each side. */
KERNEL void beam_soft_energy(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch,
                             OWN(coeff) inv_length, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                             coeff bend, coeff twist, GATHER(coeff) beam_of, OWN(int) active, OWN(int) open,
                             OWN(coeff) crack, UPDATE(state) elastic)
{
    FOR_EACH_ITEM(group, n_groups) {
        if (active[group]) {
            const beam_loss loss = beam_group_loss(group, row_start, neighbour, branch, inv_length, displacement,
                                                   orientation, axial, bend, twist, beam_of, open, crack);
            const lane energy = REAL(0.5) * loss.energy;
#define TAKE(l) elastic[group * W + 0x##l] -= (state)LANE_ITEM(energy, l);
            LANE_EACH(TAKE)
#undef TAKE
        }
    }
}

/* After cbm_virial [J] [n][6]. */
KERNEL void beam_soft_virial(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch,
                             OWN(coeff) inv_length, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                             coeff bend, coeff twist, GATHER(coeff) beam_of, OWN(int) active, OWN(int) open,
                             OWN(coeff) crack, UPDATE(coeff) virial)
{
    FOR_EACH_ITEM(group, n_groups) {
        if (active[group]) {
            const beam_loss loss = beam_group_loss(group, row_start, neighbour, branch, inv_length, displacement,
                                                   orientation, axial, bend, twist, beam_of, open, crack);
            const lane_sym3 v = cbm_virial_of(loss.virial), whole = lane_gather6(virial, lane_own(group * W));
            lane_store6(virial, group * W,
                        (lane_sym3){whole.xx - v.xx, whole.yy - v.yy, whole.zz - v.zz, whole.yz - v.yz, whole.xz - v.xz,
                                    whole.xy - v.xy});
        }
    }
}

/* One beam after the motion of a step: y: Y [J], k [N/m], w: opening that the cohesion balances [m], left: force there
 * [N], tilt: share of its energy that it costs; keeps, faded: beam_fades, and what that costs the push along the crack
 * [J]. The work of the opening is the mean of Y times what D grew by, as velocity Verlet's own work is the mean of the
 * forces at both ends of the step. */
ROUTINE void beam_follow(SCATTER(coeff) crack, SCATTER(int) open, brc_size entry, brc_size other, coeff y, coeff k,
                         coeff w, coeff left, coeff tilt, coeff keeps, coeff faded)
{
    const coeff wide = BEAM_NUMBER(entry, WIDEST), before = BEAM_NUMBER(entry, DAMAGE), y_now = y > 0 ? y : 0;
    coeff damage = before;
    if (w > wide) {
        const coeff now = k * w / (left + k * w);
        damage = now > before ? now : before;
        if (!(left > 0)) damage = REAL(1), open[entry] = BEAM_ENDED, open[other] = BEAM_ENDED;
        BEAM_NUMBER(entry, WIDEST) = w, BEAM_NUMBER(other, WIDEST) = w;
        BEAM_NUMBER(entry, TILT) = tilt, BEAM_NUMBER(other, TILT) = tilt;
    }
    const coeff booked = REAL(0.5) * (damage - before) * (y_now + BEAM_NUMBER(entry, HELD)) + before * faded;
    BEAM_NUMBER(entry, KEEPS) = keeps, BEAM_NUMBER(other, KEEPS) = keeps;
    BEAM_NUMBER(entry, DAMAGE) = damage, BEAM_NUMBER(other, DAMAGE) = damage;
    BEAM_NUMBER(entry, HELD) = y_now, BEAM_NUMBER(other, HELD) = y_now;
    BEAM_NUMBER(entry, BOOKED) = booked, BEAM_NUMBER(other, BOOKED) = booked;
    BEAM_NUMBER(entry, SPENT) += booked, BEAM_NUMBER(other, SPENT) += booked;
}

/* Between the motion of a step and its forces. */
KERNEL void beam_soft_move(int n_groups, coeff steepest, coeff clear, OWN(int) row_start, OWN(int) neighbour,
                           OWN(int) twin, OWN(int) lead, OWN(coeff) branch, OWN(coeff) inv_length,
                           GATHER(state) displacement, GATHER(state) orientation, coeff axial, coeff bend, coeff twist,
                           GATHER(coeff) beam_of, OWN(int) active, SCATTER(int) open, SCATTER(coeff) crack)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), last = row_start[slice + 1];
        if (active[group]) {
            const cbm_own own = cbm_own_of(group, displacement, orientation, 1);
            for (int slot = row_start[slice]; slot < last; ++slot) {
                const brc_size entry = (brc_size)slot * C + (brc_size)lane0;
                int any = 0;
                for (int l = 0; l < W; ++l)
                    any |= (lead[entry + (brc_size)l] & BEAM_LEADS) && open[entry + (brc_size)l] == BEAM_OPENS;
                if (!any) continue;
                const cbm_bond bond = cbm_bond_at(slot, lane0, own, neighbour, branch, inv_length, displacement,
                                                  orientation, axial, bend, twist, beam_of, 1);
                const lane_quat q_j = lane_gather4(orientation, int_block(neighbour, slot, lane0));
                beam_lean lean = beam_lean_at(crack, slot, lane0);
                const beam_part before = beam_part_of(
                    bond, lane_vec3_scale(bond.inv_length0, lane_block3(branch, slot, lane0)), own, q_j, lean);
                lean.keeps = beam_fades(lean, beam_opening(bond.shape), bond.inv_length0, clear);
                const beam_part part = beam_part_of(
                    bond, lane_vec3_scale(bond.inv_length0, lane_block3(branch, slot, lane0)), own, q_j, lean);
                const lane y = part.energy, faded = part.energy - before.energy,
                           k = bond.stiffness.axial * bond.inv_length0,
                           cosine = lane_max(beam_cosine(bond), LANE_ZERO + steepest), keeps = lean.keeps;
                const soft_face face = {lane_block(crack, slot, BEAM_WIDTH, BEAM_START, lane0),
                                        lane_block(crack, slot, BEAM_WIDTH, BEAM_ENERGY, lane0) *
                                            lane_block(crack, slot, BEAM_WIDTH, BEAM_TILT, lane0),
                                        lane_block(crack, slot, BEAM_WIDTH, BEAM_EXPONENTIAL, lane0)};
                const lane w = soft_opening(face, lane_block(crack, slot, BEAM_WIDTH, BEAM_WIDEST, lane0),
                                            LANE_SQRT(REAL(2) * k * soft_above(y, 0)), k,
                                            LANE_LESS(LANE_ZERO, face.start)),
                           left = soft_force(face, w);
#define FOLLOW(l)                                                                                                      \
    if ((lead[entry + 0x##l] & BEAM_LEADS) && open[entry + 0x##l] == BEAM_OPENS)                                       \
        beam_follow(crack, open, entry + 0x##l, (brc_size)twin[entry + 0x##l], LANE_ITEM(y, l), LANE_ITEM(k, l),       \
                    LANE_ITEM(w, l), LANE_ITEM(left, l),                                                               \
                    lead[entry + 0x##l] & BEAM_JOINED ? BEAM_NUMBER(entry + 0x##l, TILT) : LANE_ITEM(cosine, l),       \
                    LANE_ITEM(keeps, l), LANE_ITEM(faded, l));
                LANE_EACH(FOLLOW)
#undef FOLLOW
            }
        }
    }
}

/* Books the step's openings, half to each side, and takes off beams at the end of their cohesion, which carry nothing
 * any more: as fracture_break. */
KERNEL void beam_soft_end(int n_groups, int level, int step, OWN(int) row_start, UPDATE(int) neighbour,
                          PUT(coeff) inv_length, PUT(int) mark, GATHER(coeff) record, PUT(coeff) weight,
                          OWN(int) active, UPDATE(int) open, OWN(coeff) crack, PUT(int) break_step, PUT(int) break_mode,
                          PUT(coeff) break_stress, PUT(coeff) break_energy, UPDATE(state) lost, UPDATE(state) broken)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group);
        for (int e = group * W; active[group] && e < (group + 1) * W; ++e) {
            for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
                const brc_size entry = (brc_size)slot * C + (brc_size)(e % C);
                if (open[entry] != BEAM_OPENS && open[entry] != BEAM_ENDED) continue;
                lost[e] += STATE(0.5) * (state)BEAM_NUMBER(entry, BOOKED);
                if (open[entry] != BEAM_ENDED) continue;
                open[entry] = BEAM_BROKEN;
                neighbour[entry] = e;
                inv_length[entry] = 0;
                if (level == 1) weight[e] = fracture_weight(e, row_start, neighbour, record);
                mark[group] = step;
                break_step[entry] = step;
                break_mode[entry] = (int)BEAM_NUMBER(entry, MODE);
                break_stress[entry] = BEAM_NUMBER(entry, ONSET);
                break_energy[entry] = BEAM_NUMBER(entry, SPENT);
                broken[e] += 1;
            }
        }
    }
}
