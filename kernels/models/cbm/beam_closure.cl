/* Broken beams whose ends still bear on each other (cbm; docs/notebook/fracture.md "Beams beside compression"): what a
 * crack leaves to a beam (beam_carried.h), with the beam's own geometry, until its ends stand clear of each other.
 * Passes over all others find the bond broken; these add its force behind them, to groups that have such beams.
 *
 * other [slot][C]: row of the element over the bond there was, own row where there never was one. bears [slot][C]: 1
 * from the break until the ends stand clear. lean [slot][LEAN][C]: SIDE, ALONG, COSINE, SINE, KEEPS as of the
 * softening; of beams that broke at once ALONG 1 and zeros: the push along the axis is all. rubs [n / W]: a bit
 * for each slot of the group, from its first such beam on; the last bit for all slots that have none. */

#define LEAN 7
#define LEAN_ALONG 3

#define CLOSURE_BITS 31
LAW int closure_bit(int turn) { return 1 << (turn < CLOSURE_BITS ? turn : CLOSURE_BITS - 1); }
/* Whether beams of a slot bear, the turn-th of its group's. */
LAW int closure_any(int rubs, int turn, OWN(int) bears, brc_size entry)
{
    int any = 0;
    if (!(rubs & closure_bit(turn))) return 0;
    for (int l = 0; l < W; ++l) any |= bears[entry + (brc_size)l];
    return any;
}

/* Asks for the rows of the first such slot of a group that comes later: few groups have one, so no processor guesses
 * where. */
LAW void closure_ask_ahead(int group, int n_groups, OWN(int) rubs, OWN(int) row_start, OWN(int) other, OWN(int) bears,
                           OWN(coeff) branch)
{
#ifdef ROWS_AHEAD
    enum { GROUPS_AHEAD = 4 };
    const int later = group + GROUPS_AHEAD < n_groups ? group + GROUPS_AHEAD : group, bits = rubs[later];
    if (!bits) return;
    const brc_size slot = (brc_size)(row_start[SLICE_OF(later)] + __builtin_ctz((unsigned)bits)),
                   lane0 = (brc_size)FIRST_LANE_OF(later);
    PREFETCH(other, slot * C + lane0);
    PREFETCH(bears, slot * C + lane0);
    PREFETCH(branch, slot * 3 * C + lane0);
    PREFETCH(branch, (slot * 3 + 1) * C + lane0);
    PREFETCH(branch, (slot * 3 + 2) * C + lane0);
#else
    (void)group, (void)n_groups, (void)rubs, (void)row_start, (void)other, (void)bears, (void)branch;
#endif
}

/* The beams of a slot as they were before they broke; lanes whose beams do not bear are bonds home. Called with a
 * constant `leans`, here and below, so that beams that broke at once ask for no turn of their neighbours. */
typedef struct {
    lane bears; /* 1 or 0 */
    lane inv_length0;
    cbm_stiffness stiffness;
    cbm_shape shape;
    lane_vec3 branch, axis0; /* now [m]; as it was [-] */
    lane_quat q_j;
    beam_lean lean;
} closure_bond;
LAW closure_bond closure_bond_at(int slot, int lane0, cbm_own own, OWN(int) other, OWN(int) bears, OWN(coeff) branch,
                                 GATHER(state) displacement, GATHER(state) orientation, coeff axial, coeff bend,
                                 coeff twist, GATHER(coeff) beam_of, int leans, OWN(coeff) lean)
{
    closure_bond b;
    const lane_int j = int_block(other, slot, lane0), on = int_block(bears, slot, lane0);
    const lane zero = LANE_ZERO;
    const lane_vec3 r = lane_block3(branch, slot, lane0),
                    jump = state_vec3_difference(state_gather3(displacement, j), own.displacement);
    b.bears = LANE_DIFFERENT(on, on - on);
    b.inv_length0 = b.bears / LANE_SQRT(lane_vec3_dot(r, r));
    b.stiffness = cbm_stiffness_of(beam_of, own.row, j, axial, bend, twist);
    b.q_j = lane_gather4(orientation, j);
    b.shape = cbm_beam_shape_turned(r, b.inv_length0, jump, own.back, own.turn, b.q_j, 1);
    b.branch = lane_vec3_add(r, jump);
    b.axis0 = lane_vec3_scale(b.inv_length0, r);
    b.lean = (beam_lean){{zero, zero, zero}, zero + REAL(1), zero, zero, zero};
    if (leans)
        b.lean = (beam_lean){{lane_block(lean, slot, LEAN, 0, lane0), lane_block(lean, slot, LEAN, 1, lane0),
                              lane_block(lean, slot, LEAN, 2, lane0)},
                             lane_block(lean, slot, LEAN, 3, lane0),
                             lane_block(lean, slot, LEAN, 4, lane0),
                             lane_block(lean, slot, LEAN, 5, lane0),
                             lane_block(lean, slot, LEAN, 6, lane0)};
    return b;
}

LAW beam_carry closure_carry(closure_bond b, cbm_own own, int leans)
{
    if (!leans) return beam_pressed(b.shape, b.inv_length0, b.stiffness);
    return beam_carried(b.shape, b.inv_length0, b.stiffness, b.branch, b.axis0, own.orientation, b.q_j, b.lean);
}

/* Sums over the beams of a group. */
typedef struct {
    lane_vec3 force, torque;
    lane_sym3 virial; /* its parts off the diagonal twice, cbm_virial_of */
    lane energy;
} closure_sum;
LAW closure_sum closure_sum_of(int group, int bits, OWN(int) row_start, OWN(int) other, OWN(int) bears,
                               OWN(coeff) branch, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                               coeff bend, coeff twist, GATHER(coeff) beam_of, int leans, OWN(coeff) lean)
{
    const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group);
    const cbm_own own = cbm_own_of(group, displacement, orientation, 1);
    const lane zero = LANE_ZERO;
    closure_sum sum = {{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero, zero, zero, zero}, zero};
    const int begin = row_start[slice];
    for (int slot = begin; slot < row_start[slice + 1]; ++slot) {
        if (!closure_any(bits, slot - begin, bears, (brc_size)slot * C + (brc_size)lane0)) continue;
        const closure_bond b = closure_bond_at(slot, lane0, own, other, bears, branch, displacement, orientation, axial,
                                               bend, twist, beam_of, leans, lean);
        const beam_carry carry = closure_carry(b, own, leans);
        sum.force = lane_vec3_add(sum.force, carry.end.force);
        sum.torque = lane_vec3_add(sum.torque, carry.end.torque);
        sum.virial = cbm_add_virial(sum.virial, b.branch, carry.end.force);
        sum.energy += carry.energy;
    }
    return sum;
}

LAW closure_sum closure_group(int group, int bits, OWN(int) row_start, OWN(int) other, OWN(int) bears,
                              OWN(coeff) branch, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                              coeff bend, coeff twist, GATHER(coeff) beam_of, int leans, OWN(coeff) lean)
{
    return leans ? closure_sum_of(group, bits, row_start, other, bears, branch, displacement, orientation, axial, bend,
                                  twist, beam_of, 1, lean)
                 : closure_sum_of(group, bits, row_start, other, bears, branch, displacement, orientation, axial, bend,
                                  twist, beam_of, 0, lean);
}

LAW void closure_add(UPDATE(state) to, int e, coeff x, coeff y, coeff z)
{
    to[(brc_size)e * 3] += (state)x, to[(brc_size)e * 3 + 1] += (state)y, to[(brc_size)e * 3 + 2] += (state)z;
}

/* After fracture_force and beam_soft_force: forces, torques and records with what broken beams bear. */
KERNEL void closure_force(int n_groups, OWN(int) row_start, OWN(int) other, OWN(int) bears, OWN(coeff) branch,
                          GATHER(state) displacement, GATHER(state) orientation, coeff axial, coeff bend, coeff twist,
                          GATHER(coeff) beam_of, int leans, OWN(coeff) lean, coeff inv_tension, coeff inv_compression,
                          coeff inv_shear, int drucker_prager, coeff slope, OWN(int) rubs, UPDATE(state) force,
                          UPDATE(state) torque, UPDATE(coeff) record, PUT(coeff) stress_bound)
{
    FOR_EACH_ITEM(group, n_groups) {
        closure_ask_ahead(group, n_groups, rubs, row_start, other, bears, branch);
        if (rubs[group]) {
            const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
            const closure_sum sum = closure_group(group, rubs[group], row_start, other, bears, branch, displacement,
                                                  orientation, axial, bend, twist, beam_of, leans, lean);
            const lane_vec3 f = sum.force, t = sum.torque;
#define ADD(l)                                                                                                         \
    closure_add(force, first + 0x##l, LANE_ITEM(f.x, l), LANE_ITEM(f.y, l), LANE_ITEM(f.z, l));                        \
    closure_add(torque, first + 0x##l, LANE_ITEM(t.x, l), LANE_ITEM(t.y, l), LANE_ITEM(t.z, l));
            LANE_EACH(ADD)
#undef ADD
            const lane_sym3 v = cbm_virial_of(sum.virial);
            const lane_sym3 all = {
                lane_block(record, slice, RECORD, 0, lane0) + v.xx, lane_block(record, slice, RECORD, 1, lane0) + v.yy,
                lane_block(record, slice, RECORD, 2, lane0) + v.zz, lane_block(record, slice, RECORD, 3, lane0) + v.yz,
                lane_block(record, slice, RECORD, 4, lane0) + v.xz, lane_block(record, slice, RECORD, 5, lane0) + v.xy};
            const failure_scale scale = {inv_tension, inv_compression, inv_shear, drucker_prager, slope};
            fracture_put_record(group, all, scale, record, stress_bound);
        }
    }
}

/* After cbm_energy [J] [n], half to each side. */
KERNEL void closure_energy(int n_groups, OWN(int) row_start, OWN(int) other, OWN(int) bears, OWN(coeff) branch,
                           GATHER(state) displacement, GATHER(state) orientation, coeff axial, coeff bend, coeff twist,
                           GATHER(coeff) beam_of, int leans, OWN(coeff) lean, OWN(int) rubs, UPDATE(state) elastic)
{
    FOR_EACH_ITEM(group, n_groups) {
        if (rubs[group]) {
            const closure_sum sum = closure_group(group, rubs[group], row_start, other, bears, branch, displacement,
                                                  orientation, axial, bend, twist, beam_of, leans, lean);
            const lane energy = REAL(0.5) * sum.energy;
#define ADD(l) elastic[group * W + 0x##l] += (state)LANE_ITEM(energy, l);
            LANE_EACH(ADD)
#undef ADD
        }
    }
}

/* After cbm_virial [J] [n][6]. */
KERNEL void closure_virial(int n_groups, OWN(int) row_start, OWN(int) other, OWN(int) bears, OWN(coeff) branch,
                           GATHER(state) displacement, GATHER(state) orientation, coeff axial, coeff bend, coeff twist,
                           GATHER(coeff) beam_of, int leans, OWN(coeff) lean, OWN(int) rubs, UPDATE(coeff) virial)
{
    FOR_EACH_ITEM(group, n_groups) {
        if (rubs[group]) {
            const closure_sum sum = closure_group(group, rubs[group], row_start, other, bears, branch, displacement,
                                                  orientation, axial, bend, twist, beam_of, leans, lean);
            const lane_sym3 v = cbm_virial_of(sum.virial), all = lane_gather6(virial, lane_own(group * W));
            lane_store6(
                virial, group * W,
                (lane_sym3){all.xx + v.xx, all.yy + v.yy, all.zz + v.zz, all.yz + v.yz, all.xz + v.xz, all.xy + v.xy});
        }
    }
}

/* closure_move for a group; whether one of its beams parts. */
LAW int closure_move_group(int group, coeff clear, OWN(int) row_start, OWN(int) other, UPDATE(int) bears,
                           OWN(coeff) branch, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                           coeff bend, coeff twist, GATHER(coeff) beam_of, int leans, UPDATE(coeff) lean, OWN(int) rubs,
                           UPDATE(state) lost, UPDATE(state) gone)
{
    const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
    const cbm_own own = cbm_own_of(group, displacement, orientation, 1);
    int parted = 0;
    for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
        const brc_size entry = (brc_size)slot * C + (brc_size)lane0;
        if (!closure_any(rubs[group], slot - row_start[slice], bears, entry)) continue;
        closure_bond b = closure_bond_at(slot, lane0, own, other, bears, branch, displacement, orientation, axial, bend,
                                         twist, beam_of, leans, lean);
        const lane apart = cbm_strain(b.shape) - clear;
        if (leans) {
            const beam_carry before = closure_carry(b, own, leans);
            b.lean.keeps = beam_fades(b.lean, beam_opening(b.shape), b.inv_length0, clear);
            const beam_carry after = closure_carry(b, own, leans);
            const lane share = REAL(0.5) * b.bears * (before.energy - after.energy);
            lane_store(lean, ((brc_size)slot * LEAN + 6) * C + (brc_size)lane0, b.lean.keeps);
#define LOSE(l) lost[first + 0x##l] += (state)LANE_ITEM(share, l);
            LANE_EACH(LOSE)
#undef LOSE
        }
#define PART(l)                                                                                                        \
    if (bears[entry + 0x##l] && LANE_ITEM(apart, l) > 0) bears[entry + 0x##l] = 0, gone[first + 0x##l] += 1, parted = 1;
        LANE_EACH(PART)
#undef PART
    }
    return parted;
}

/* Between the motion of a step and its forces: pushes along cracks fade as these open (lost [n]: half of what that
 * costs), and beams whose ends stand clear of each other bear no more. Both sides of a beam find the same. gone [n]:
 * beams that do not bear any more; mark: the step, where one is. */
KERNEL void closure_move(int n_groups, int step, coeff clear, OWN(int) row_start, OWN(int) other, UPDATE(int) bears,
                         OWN(coeff) branch, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                         coeff bend, coeff twist, GATHER(coeff) beam_of, int leans, UPDATE(coeff) lean, OWN(int) rubs,
                         PUT(int) mark, UPDATE(state) lost, UPDATE(state) gone)
{
    FOR_EACH_ITEM(group, n_groups) {
        closure_ask_ahead(group, n_groups, rubs, row_start, other, bears, branch);
        if (rubs[group]) {
            int parted = 0;
            if (leans)
                parted = closure_move_group(group, clear, row_start, other, bears, branch, displacement, orientation,
                                            axial, bend, twist, beam_of, 1, lean, rubs, lost, gone);
            else
                parted = closure_move_group(group, clear, row_start, other, bears, branch, displacement, orientation,
                                            axial, bend, twist, beam_of, 0, lean, rubs, lost, gone);
            if (parted) mark[group] = step;
        }
    }
}

/* After the breaks of a step: those of a beam that broke in it bear from now on (closure: 1), or what was left to them
 * is lost (closure: 0, of those that softened). What beams that broke at once bear joins the forces again, but for
 * those that an element which failed by compression chose, which bear nothing, and half_kick as in fracture_break;
 * those that softened bore it before. open, crack: of the softening (softens: 1). */
KERNEL void closure_begin(int n_groups, int step, int closure, int softens, state half_kick, OWN(int) row_start,
                          OWN(int) other, OWN(int) twin, UPDATE(int) bears, OWN(coeff) branch,
                          GATHER(state) displacement, GATHER(state) orientation, coeff axial, coeff bend, coeff twist,
                          GATHER(coeff) beam_of, UPDATE(coeff) lean, OWN(int) mark, OWN(int) break_step,
                          GATHER(int) break_mode, OWN(int) open, OWN(coeff) crack, OWN(state) mass, OWN(state) inertia,
                          UPDATE(state) force, UPDATE(state) torque, UPDATE(state) velocity, UPDATE(state) spin,
                          UPDATE(int) rubs, UPDATE(state) lost, UPDATE(state) gone)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
        const int last = mark[group] == step ? row_start[slice + 1] : row_start[slice];
        cbm_own own;
        if (mark[group] == step) own = cbm_own_of(group, displacement, orientation, 1);
        for (int slot = row_start[slice]; slot < last; ++slot) {
            const brc_size entry = (brc_size)slot * C + (brc_size)lane0;
            int any = 0;
            for (int l = 0; l < W; ++l) {
                const brc_size at = entry + (brc_size)l;
                if (break_step[at] != step) continue;
                any = 1;
                bears[at] = 1;
                for (int c = 0; softens && c < LEAN; ++c)
                    lean[((brc_size)slot * LEAN + (brc_size)c) * C + (brc_size)(lane0 + l)] =
                        open[at] == BEAM_BROKEN ? crack[((brc_size)slot * BEAM_WIDTH + (brc_size)(BEAM_SIDE + c)) * C +
                                                        (brc_size)(lane0 + l)]
                        : c == LEAN_ALONG       ? REAL(1)
                                                : 0;
            }
            if (!any) continue;
            rubs[group] |= closure_bit(slot - row_start[slice]);
            const closure_bond b = closure_bond_at(slot, lane0, own, other, bears, branch, displacement, orientation,
                                                   axial, bend, twist, beam_of, softens, lean);
            const beam_carry carry = closure_carry(b, own, softens);
#define JOIN(l)                                                                                                        \
    if (break_step[entry + 0x##l] == step) {                                                                           \
        const int softened = softens && open[entry + 0x##l] == BEAM_BROKEN, e = first + 0x##l;                         \
        const int crushed = break_mode[entry + 0x##l] == FAILURE_COMPRESSION ||                                        \
                            break_mode[twin[entry + 0x##l]] == FAILURE_COMPRESSION;                                    \
        const int keeps = closure && !(crushed && !softened);                                                          \
        const coeff sign = softened == keeps ? 0 : keeps ? REAL(-1) : REAL(1);                                         \
        lost[e] += STATE(0.5) * (state)(sign * LANE_ITEM(carry.energy, l));                                            \
        fracture_take(force, velocity, mass[e], half_kick, e, sign *LANE_ITEM(carry.end.force.x, l),                   \
                      sign *LANE_ITEM(carry.end.force.y, l), sign *LANE_ITEM(carry.end.force.z, l));                   \
        fracture_take(torque, spin, inertia[e], half_kick, e, sign *LANE_ITEM(carry.end.torque.x, l),                  \
                      sign *LANE_ITEM(carry.end.torque.y, l), sign *LANE_ITEM(carry.end.torque.z, l));                 \
        if (!keeps) bears[entry + 0x##l] = 0, gone[e] += 1;                                                            \
    }
            LANE_EACH(JOIN)
#undef JOIN
        }
    }
}
