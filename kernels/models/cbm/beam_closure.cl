/* Broken beams whose ends still bear on each other (cbm; docs/notebook/fracture.md "Beams beside compression"): what a
 * crack leaves to a beam (beam_carried.h), with the beam's own geometry, until its ends stand clear of each other.
 * Passes over all others find the bond broken; these add its force behind them, to groups that have such beams.
 *
 * other [slot][C]: row of the element over the bond there was, own row where there never was one. bears [slot][C]: 1
 * from the break until the ends stand clear. lean [slot][LEAN][C]: SIDE, ALONG, COSINE, SINE, KEEPS as of the
 * softening; of beams that broke at once ALONG 1 and zeros: the push along the axis is all; in an interface the sides
 * slide. slip [slot][SLIP][C]: beam_slip [m], and 1 where friction holds them, else 0. rubs [n / W]: a bit for each
 * slot of the group, from its first such beam on; the last bit for all slots that have none. */

#define LEAN 7
#define LEAN_ALONG 3
#define LEAN_COSINE 4
#define LEAN_KEEPS 6
#define SLIP 5
#define SLIP_GRIPS 4

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

/* What there is of beams that bear: CLOSURE_LEANS lean, CLOSURE_GRIPS slip too. */
#define CLOSURE_LEANS 1
#define CLOSURE_GRIPS 2

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
    beam_slip slip;
    lane grips;
} closure_bond;
LAW beam_slip closure_slip_at(OWN(coeff) slip, int slot, int lane0)
{
    return (beam_slip){lane_block(slip, slot, SLIP, 0, lane0), lane_block(slip, slot, SLIP, 1, lane0),
                       lane_block(slip, slot, SLIP, 2, lane0), lane_block(slip, slot, SLIP, 3, lane0)};
}
LAW closure_bond closure_bond_at(int slot, int lane0, cbm_own own, OWN(int) other, OWN(int) bears, OWN(coeff) branch,
                                 GATHER(state) displacement, GATHER(state) orientation, coeff axial, coeff bend,
                                 coeff twist, GATHER(coeff) beam_of, int leans, OWN(coeff) lean, OWN(coeff) slip)
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
                             lane_block(lean, slot, LEAN, LEAN_KEEPS, lane0)};
    b.slip = (beam_slip){zero, zero, zero, zero}, b.grips = zero;
    if (leans & CLOSURE_GRIPS) {
        b.slip = closure_slip_at(slip, slot, lane0);
        b.grips = lane_block(slip, slot, SLIP, SLIP_GRIPS, lane0);
    }
    return b;
}

LAW beam_carry closure_carry(closure_bond b, cbm_own own, int leans)
{
    if (!leans) return beam_pressed(b.shape, b.inv_length0, b.stiffness);
    beam_carry carry =
        beam_carried(b.shape, b.inv_length0, b.stiffness, b.branch, b.axis0, own.orientation, b.q_j, b.lean);
    if (leans & CLOSURE_GRIPS) {
        const beam_carry rubbed = beam_rubbed(b.shape, b.inv_length0, b.stiffness, b.branch, b.axis0, own.orientation,
                                              b.q_j, b.lean, b.slip, b.grips);
        carry.end.force = lane_vec3_add(carry.end.force, rubbed.end.force);
        carry.end.torque = lane_vec3_add(carry.end.torque, rubbed.end.torque);
        carry.energy += rubbed.energy;
    }
    return carry;
}

LAW beam_slide closure_slipped(closure_bond b, cbm_own own, coeff friction)
{
    return beam_slipped(b.shape, b.inv_length0, b.stiffness, b.axis0, own.orientation, b.q_j, b.lean, b.slip, friction);
}

/* Sums over the beams of a group. */
typedef struct {
    lane_vec3 force, torque;
    lane_sym3 virial; /* its parts off the diagonal twice, cbm_virial_of */
    lane energy;
} closure_sum;
LAW closure_sum closure_sum_of(int group, int bits, cbm_own own, OWN(int) row_start, OWN(int) other, OWN(int) bears,
                               OWN(coeff) branch, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                               coeff bend, coeff twist, GATHER(coeff) beam_of, int leans, OWN(coeff) lean,
                               OWN(coeff) slip)
{
    const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group);
    const lane zero = LANE_ZERO;
    closure_sum sum = {{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero, zero, zero, zero}, zero};
    const int begin = row_start[slice];
    for (int slot = begin; slot < row_start[slice + 1]; ++slot) {
        if (!closure_any(bits, slot - begin, bears, (brc_size)slot * C + (brc_size)lane0)) continue;
        const closure_bond b = closure_bond_at(slot, lane0, own, other, bears, branch, displacement, orientation, axial,
                                               bend, twist, beam_of, leans, lean, slip);
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
                              coeff bend, coeff twist, GATHER(coeff) beam_of, int leans, OWN(coeff) lean,
                              OWN(coeff) slip)
{
    const cbm_own own = cbm_own_of(group, displacement, orientation, 1);
#define SUM(leans)                                                                                                     \
    closure_sum_of(group, bits, own, row_start, other, bears, branch, displacement, orientation, axial, bend, twist,   \
                   beam_of, leans, lean, slip)
    return leans & CLOSURE_GRIPS ? SUM(CLOSURE_LEANS | CLOSURE_GRIPS) : leans ? SUM(CLOSURE_LEANS) : SUM(0);
#undef SUM
}

LAW void closure_add(UPDATE(state) to, int e, coeff x, coeff y, coeff z)
{
    to[(brc_size)e * 3] += (state)x, to[(brc_size)e * 3 + 1] += (state)y, to[(brc_size)e * 3 + 2] += (state)z;
}

/* After fracture_force and beam_soft_force, where broken beams may lean or grip (elsewhere fracture_force adds what
 * they bear): forces, torques and records with it. */
KERNEL void closure_force(int n_groups, OWN(int) row_start, OWN(int) other, OWN(int) bears, OWN(coeff) branch,
                          GATHER(state) displacement, GATHER(state) orientation, coeff axial, coeff bend, coeff twist,
                          GATHER(coeff) beam_of, int leans, OWN(coeff) lean, OWN(coeff) slip, coeff inv_tension,
                          coeff inv_compression, coeff inv_shear, int drucker_prager, coeff slope, OWN(int) rubs,
                          UPDATE(state) force, UPDATE(state) torque, UPDATE(coeff) record, PUT(coeff) stress_bound)
{
    FOR_EACH_ITEM(group, n_groups) {
        closure_ask_ahead(group, n_groups, rubs, row_start, other, bears, branch);
        if (rubs[group]) {
            const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
            const closure_sum sum = closure_group(group, rubs[group], row_start, other, bears, branch, displacement,
                                                  orientation, axial, bend, twist, beam_of, leans, lean, slip);
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
                           GATHER(coeff) beam_of, int leans, OWN(coeff) lean, OWN(coeff) slip, OWN(int) rubs,
                           UPDATE(state) elastic)
{
    FOR_EACH_ITEM(group, n_groups) {
        if (rubs[group]) {
            const closure_sum sum = closure_group(group, rubs[group], row_start, other, bears, branch, displacement,
                                                  orientation, axial, bend, twist, beam_of, leans, lean, slip);
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
                           GATHER(coeff) beam_of, int leans, OWN(coeff) lean, OWN(coeff) slip, OWN(int) rubs,
                           UPDATE(coeff) virial)
{
    FOR_EACH_ITEM(group, n_groups) {
        if (rubs[group]) {
            const closure_sum sum = closure_group(group, rubs[group], row_start, other, bears, branch, displacement,
                                                  orientation, axial, bend, twist, beam_of, leans, lean, slip);
            const lane_sym3 v = cbm_virial_of(sum.virial), all = lane_gather6(virial, lane_own(group * W));
            lane_store6(
                virial, group * W,
                (lane_sym3){all.xx + v.xx, all.yy + v.yy, all.zz + v.zz, all.yz + v.yz, all.xz + v.xz, all.xy + v.xy});
        }
    }
}

/* Of beams that friction holds. */
LAW void closure_stick(UPDATE(coeff) slip, int slot, int lane0, lane grips, beam_slip now)
{
    const beam_slip was = closure_slip_at(slip, slot, lane0);
    const brc_size at = (brc_size)slot * SLIP * C + (brc_size)lane0;
    lane_store(slip, at, was.p + grips * (now.p - was.p));
    lane_store(slip, at + C, was.q + grips * (now.q - was.q));
    lane_store(slip, at + 2 * C, was.held_p + grips * (now.held_p - was.held_p));
    lane_store(slip, at + 3 * C, was.held_q + grips * (now.held_q - was.held_q));
}

/* Beams of an interface that slide are let go at half of their length. */
#define CLOSURE_SLID REAL(0.5)
/* How far the ends stand beyond where they bear no more, over the length: axially; those that slide, across their
 * plane and along it. */
LAW lane closure_apart(closure_bond b, cbm_own own, coeff clear, int leans)
{
    const lane apart = cbm_strain(b.shape) - clear;
    if (!leans) return apart;
    const lane_vec3 o = beam_parts(beam_axes_of(b.shape, b.axis0, own.orientation, b.q_j, b.lean), b.shape);
    const lane slid = LANE_SQRT(o.y * o.y + o.z * o.z) * b.inv_length0 - CLOSURE_SLID,
               off = lane_max(o.x * b.inv_length0 - clear, slid);
    return apart + beam_slides(b.lean) * (off - apart);
}

/* closure_move for a group; whether one of its beams parts. */
LAW int closure_move_group(int group, coeff clear, coeff friction, OWN(int) row_start, OWN(int) other,
                           UPDATE(int) bears, OWN(coeff) branch, GATHER(state) displacement, GATHER(state) orientation,
                           coeff axial, coeff bend, coeff twist, GATHER(coeff) beam_of, int leans, UPDATE(coeff) lean,
                           UPDATE(coeff) slip, OWN(int) rubs, UPDATE(state) lost, UPDATE(state) rubbed,
                           UPDATE(state) gone)
{
    const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
    const cbm_own own = cbm_own_of(group, displacement, orientation, 1);
    int parted = 0;
    for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
        const brc_size entry = (brc_size)slot * C + (brc_size)lane0;
        if (!closure_any(rubs[group], slot - row_start[slice], bears, entry)) continue;
        closure_bond b = closure_bond_at(slot, lane0, own, other, bears, branch, displacement, orientation, axial, bend,
                                         twist, beam_of, leans, lean, slip);
        const lane apart = closure_apart(b, own, clear, leans);
        lane left = LANE_ZERO; /* half of what the beam holds [J] */
        if (leans) {
            const beam_carry before = closure_carry(b, own, leans);
            b.lean.keeps = beam_fades(b.lean, beam_opening(b.shape), b.inv_length0, clear);
            const beam_carry after = closure_carry(b, own, leans);
            const lane share = REAL(0.5) * b.bears * (before.energy - after.energy);
            left = REAL(0.5) * b.bears * after.energy;
            lane_store(lean, ((brc_size)slot * LEAN + LEAN_KEEPS) * C + (brc_size)lane0, b.lean.keeps);
#define LOSE(l) lost[first + 0x##l] += (state)LANE_ITEM(share, l);
            LANE_EACH(LOSE)
#undef LOSE
        }
        if (leans & CLOSURE_GRIPS) {
            const beam_slide now = closure_slipped(b, own, friction);
            const lane rubs_off = REAL(0.5) * b.bears * b.grips * now.spent;
            closure_stick(slip, slot, lane0, b.grips, now.slip);
            b.slip = closure_slip_at(slip, slot, lane0);
            const beam_carry held = closure_carry(b, own, leans);
            left = REAL(0.5) * b.bears * held.energy;
#define RUB(l) rubbed[first + 0x##l] += (state)LANE_ITEM(rubs_off, l);
            LANE_EACH(RUB)
#undef RUB
        }
#define PART(l)                                                                                                        \
    if (bears[entry + 0x##l] && LANE_ITEM(apart, l) > 0) {                                                             \
        bears[entry + 0x##l] = 0, gone[first + 0x##l] += 1, parted = 1;                                                \
        if (leans) lost[first + 0x##l] += (state)LANE_ITEM(left, l);                                                   \
    }
        LANE_EACH(PART)
#undef PART
    }
    return parted;
}

/* Between the motion of a step and its forces: pushes along cracks fade as these open (lost [n]: half of what that
 * costs), sides slide against friction (rubbed [n]: half of what that costs), and beams whose ends stand clear of each
 * other bear no more. Both sides of a beam find the same. gone [n]: beams that do not bear any more; mark: the step,
 * where one is. */
KERNEL void closure_move(int n_groups, int step, coeff clear, coeff friction, OWN(int) row_start, OWN(int) other,
                         UPDATE(int) bears, OWN(coeff) branch, GATHER(state) displacement, GATHER(state) orientation,
                         coeff axial, coeff bend, coeff twist, GATHER(coeff) beam_of, int leans, UPDATE(coeff) lean,
                         UPDATE(coeff) slip, OWN(int) rubs, PUT(int) mark, UPDATE(state) lost, UPDATE(state) rubbed,
                         UPDATE(state) gone)
{
    FOR_EACH_ITEM(group, n_groups) {
        closure_ask_ahead(group, n_groups, rubs, row_start, other, bears, branch);
        if (rubs[group]) {
            int parted = 0;
#define MOVE(leans)                                                                                                    \
    closure_move_group(group, clear, friction, row_start, other, bears, branch, displacement, orientation, axial,      \
                       bend, twist, beam_of, leans, lean, slip, rubs, lost, rubbed, gone)
            if (leans & CLOSURE_GRIPS)
                parted = MOVE(CLOSURE_LEANS | CLOSURE_GRIPS);
            else if (leans)
                parted = MOVE(CLOSURE_LEANS);
            else
                parted = MOVE(0);
#undef MOVE
            if (parted) mark[group] = step;
        }
    }
}

/* What a beam that broke at once joins with: its push along the axis is all; or, in an interface, `slides`, which
 * friction holds (grips). */
ROUTINE void closure_lay(UPDATE(coeff) lean, UPDATE(coeff) slip, int leans, int slot, int at, int lies,
                         soft_vector side, coeff along)
{
    GLOBAL coeff *own = lean + (brc_size)slot * LEAN * C + at;
    const coeff slides[LEAN] = {side.x, side.y, side.z, along, REAL(-1), 0, REAL(1)};
    for (int c = 0; leans && c < LEAN; ++c) own[c * C] = lies ? slides[c] : c == LEAN_ALONG ? REAL(1) : 0;
    if (leans & CLOSURE_GRIPS) slip[((brc_size)slot * SLIP + SLIP_GRIPS) * C + (brc_size)at] = lies ? REAL(1) : 0;
}

/* After the breaks of a step: those of a beam that broke in it bear from now on (closure: 1), or what was left to them
 * is lost (closure: 0, of those that softened). What beams that broke at once bear joins the forces again, but for
 * those that an element which failed by compression chose, which bear nothing, and half_kick as in fracture_break;
 * those that softened bore it before. open, crack: of the softening (softens: 1); plane: of interfaces (joined: 1). */
KERNEL void closure_begin(int n_groups, int step, int closure, int softens, state half_kick, coeff friction,
                          OWN(int) row_start, OWN(int) other, OWN(int) twin, UPDATE(int) bears, OWN(coeff) branch,
                          GATHER(state) displacement, GATHER(state) orientation, coeff axial, coeff bend, coeff twist,
                          GATHER(coeff) beam_of, int leans, UPDATE(coeff) lean, UPDATE(coeff) slip, int joined,
                          OWN(coeff) plane, OWN(int) mark, OWN(int) break_step, GATHER(int) break_mode, OWN(int) open,
                          OWN(coeff) crack, OWN(state) mass, OWN(state) inertia, UPDATE(state) force,
                          UPDATE(state) torque, UPDATE(state) velocity, UPDATE(state) spin, UPDATE(int) rubs,
                          UPDATE(state) lost, UPDATE(state) gone)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
        const int last = mark[group] == step ? row_start[slice + 1] : row_start[slice];
        cbm_own own;
        if (mark[group] == step) own = cbm_own_of(group, displacement, orientation, 1);
        for (int slot = row_start[slice]; slot < last; ++slot) {
            const brc_size entry = (brc_size)slot * C + (brc_size)lane0;
            int any = 0;
            for (int l = 0; l < W; ++l) any |= break_step[entry + (brc_size)l] == step;
            if (!any) continue;
            rubs[group] |= closure_bit(slot - row_start[slice]);
            const lane_vec3 r = lane_block3(branch, slot, lane0),
                            normal = joined ? lane_block3(plane, slot, lane0) : lane_vec3_zero();
            const lane lies = beam_positive(lane_vec3_dot(normal, normal)),
                       per = REAL(1) / LANE_SQRT(lane_max(lane_vec3_dot(r, r), LANE_ZERO + REAL(1e-30)));
            const beam_lean slides = beam_lean_in(lane_vec3_scale(per, r), normal);
#define LAY(l)                                                                                                         \
    if (break_step[entry + 0x##l] == step) {                                                                           \
        bears[entry + 0x##l] = 1;                                                                                      \
        if (softens && open[entry + 0x##l] == BEAM_BROKEN) {                                                           \
            for (int c = 0; c < LEAN; ++c)                                                                             \
                lean[((brc_size)slot * LEAN + (brc_size)c) * C + (brc_size)(lane0 + 0x##l)] =                          \
                    crack[((brc_size)slot * BEAM_WIDTH + (brc_size)(BEAM_SIDE + c)) * C + (brc_size)(lane0 + 0x##l)];  \
        } else {                                                                                                       \
            closure_lay(                                                                                               \
                lean, slip, leans, slot, lane0 + 0x##l, LANE_ITEM(lies, l) > 0,                                        \
                (soft_vector){LANE_ITEM(slides.side.x, l), LANE_ITEM(slides.side.y, l), LANE_ITEM(slides.side.z, l)},  \
                LANE_ITEM(slides.along, l));                                                                           \
        }                                                                                                              \
    }
            LANE_EACH(LAY)
#undef LAY
            closure_bond b = closure_bond_at(slot, lane0, own, other, bears, branch, displacement, orientation, axial,
                                             bend, twist, beam_of, leans, lean, slip);
            if (leans & CLOSURE_GRIPS) { /* they stick as far as friction holds what the beam bore */
                const beam_slide slide = closure_slipped(b, own, friction);
                const beam_slip now = slide.slip;
#define NEW(l) break_step[entry + 0x##l] == step ? LANE_ITEM(b.grips, l) : REAL(0)
                closure_stick(slip, slot, lane0, LANE_MAKE(lane, NEW), now);
#undef NEW
                b.slip = closure_slip_at(slip, slot, lane0);
            }
            const beam_carry carry = closure_carry(b, own, leans);
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
