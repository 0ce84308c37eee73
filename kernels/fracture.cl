/* Fracture of cbm (NAH19 section 2.2): forces with the virial, its mean over neighbours, elements that fail and the bond each loses, and
 * what goes with a lost bond. The passes run in this order in every step; each writes arrays of its own element only.
 *
 * record [n][8]: sum over the beams of an element of the symmetric part of x_ij (x) f_ij, xx yy zz yz xz xy [J]; twice its volume with its
 * share of the voids [m^3]; one unused. choice [n]: 4 * (row of the neighbour that loses the bond) + mode of failure, or -1. */

#define RECORD 8

/* As cbm_force_pass with the full law, and the records. */
KERNEL void fracture_force(int n_groups, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                           GLOBAL const coeff *restrict branch, GLOBAL const coeff *restrict inv_length, GLOBAL const coeff *restrict alive,
                           GLOBAL const state *restrict displacement, GLOBAL const state *restrict orientation, coeff axial, coeff bend,
                           coeff twist, GLOBAL const coeff *restrict beam_of, GLOBAL state *restrict force, GLOBAL state *restrict torque,
                           GLOBAL coeff *restrict record)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), last = row_start[slice + 1];
        const cbm_own own = cbm_own_of(group, displacement, orientation, 1);
        const lane zero = LANE_ZERO;
        cbm_end sum = {{zero, zero, zero}, {zero, zero, zero}};
        lane_sym3 virial = {zero, zero, zero, zero, zero, zero};
        for (int slot = row_start[slice]; slot < last; ++slot) {
            const cbm_bond bond = cbm_bond_at(slot, last, lane0, own, neighbour, branch, inv_length, alive, 1, displacement, orientation, axial,
                                              bend, twist, beam_of, 1);
            const cbm_end end = cbm_beam_law(bond.shape, bond.inv_length0, bond.stiffness, 1);
            sum.force = lane_vec3_add(sum.force, end.force);
            sum.torque = lane_vec3_add(sum.torque, end.torque);
            virial = cbm_add_virial(virial, bond.branch, end.force);
        }
        state_store3(force, group * W, sum.force);
        state_store3(torque, group * W, sum.torque);
        GLOBAL coeff *to = record + (brc_size)(group * W) * RECORD;
#define PUT(l)                                                                                                         \
    to[0x##l * RECORD] = LANE_ITEM(virial.xx, l), to[0x##l * RECORD + 1] = LANE_ITEM(virial.yy, l),                    \
                    to[0x##l * RECORD + 2] = LANE_ITEM(virial.zz, l), to[0x##l * RECORD + 3] = LANE_ITEM(virial.yz, l), \
                    to[0x##l * RECORD + 4] = LANE_ITEM(virial.xz, l), to[0x##l * RECORD + 5] = LANE_ITEM(virial.xy, l);
        LANE_EACH(PUT)
#undef PUT
    }
}

/* Stress of every element [n][6], over itself (level 0) or itself and its neighbours over unbroken bonds (level 1). */
KERNEL void fracture_stress(int n_groups, int level, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                            GLOBAL const coeff *restrict alive, GLOBAL const coeff *restrict record, GLOBAL coeff *restrict stress)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group);
        lane_int at = lane_own(group * W) * RECORD;
        lane sum[7];
        for (int c = 0; c < 7; ++c) sum[c] = gather_component(record + c, at);
        for (int slot = row_start[slice]; level > 0 && slot < row_start[slice + 1]; ++slot) {
            const lane whole = lane_load(alive, (brc_size)slot * C + (brc_size)lane0);
            at = int_block(neighbour, slot, lane0) * RECORD;
#ifdef LANE_SHUFFLE
            const lane_columns near = lane_gather_columns(record, at);
            sum[0] += whole * near.c0, sum[1] += whole * near.c1, sum[2] += whole * near.c2, sum[3] += whole * near.c3;
            sum[4] += whole * near.c4, sum[5] += whole * near.c5, sum[6] += whole * near.c6;
#else
            for (int c = 0; c < 7; ++c) sum[c] += whole * gather_component(record + c, at);
#endif
        }
        const lane inverse = REAL(1) / sum[6];
        lane_store6(stress, group * W, (lane_sym3){inverse * sum[0], inverse * sum[1], inverse * sum[2], inverse * sum[3],
                                                   inverse * sum[4], inverse * sum[5]});
    }
}

/* Level 2: the neighbours' neighbours too, each element once. SECOND_SHELL: places of the table that knows who was counted; the host refuses
 * samples with elements that have more members. */
#define SECOND_SHELL 512
KERNEL void fracture_stress_second(int n, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                                   GLOBAL const coeff *restrict alive, GLOBAL const coeff *restrict record, GLOBAL coeff *restrict stress)
{
    FOR_EACH_ITEM(e, n) {
        int seen[SECOND_SHELL];
        coeff sum[7];
        for (int k = 0; k < SECOND_SHELL; ++k) seen[k] = -1;
        seen[e % SECOND_SHELL] = e;
        for (int c = 0; c < 7; ++c) sum[c] = record[(brc_size)e * RECORD + c];
        for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
            const brc_size entry = (brc_size)slot * C + e % C;
            if (!(alive[entry] > 0)) continue;
            const int j = neighbour[entry];
            for (int next = row_start[j / C] - 1; next < row_start[j / C + 1]; ++next) { /* first j itself, then its neighbours */
                const brc_size there = (brc_size)next * C + j % C;
                const int itself = next < row_start[j / C];
                if (!itself && !(alive[there] > 0)) continue;
                const int k = itself ? j : neighbour[there];
                int place = k % SECOND_SHELL;
                while (seen[place] != -1 && seen[place] != k) place = (place + 1) % SECOND_SHELL;
                if (seen[place] == k) continue;
                seen[place] = k;
                for (int c = 0; c < 7; ++c) sum[c] += record[(brc_size)k * RECORD + c];
            }
        }
        for (int c = 0; c < 6; ++c) stress[(brc_size)e * 6 + c] = sum[c] / sum[6];
    }
}

LAW failure_stress fracture_stress_of(GLOBAL const coeff *restrict stress, int e)
{
    GLOBAL const coeff *s = stress + (brc_size)e * 6;
    return (failure_stress){s[0], s[1], s[2], s[3], s[4], s[5]};
}
/* limits [n][3]: tension, compression, shear [Pa]. */
LAW failure_limits fracture_limits_of(GLOBAL const coeff *restrict limits, int e)
{
    GLOBAL const coeff *l = limits + (brc_size)e * 3;
    return (failure_limits){l[0], l[1], l[2]};
}

/* Elements at a limit choose the unbroken bond nearest to the direction of failure, the first of equals; measure [n]: their stress then [Pa]. */
KERNEL void fracture_choose(int n, int drucker_prager, coeff slope, coeff friction, GLOBAL const int *restrict row_start,
                            GLOBAL const int *restrict neighbour, GLOBAL const coeff *restrict branch, GLOBAL const coeff *restrict alive,
                            GLOBAL const state *restrict displacement, GLOBAL const coeff *restrict limits,
                            GLOBAL const coeff *restrict stress, GLOBAL int *restrict choice, GLOBAL coeff *restrict measure)
{
    FOR_EACH_ITEM(e, n) {
        const failure_shear shear = {drucker_prager, slope, friction};
        const failure_stress s = fracture_stress_of(stress, e);
        const failure_limits limit = fracture_limits_of(limits, e);
        choice[e] = -1;
        if (failure_possible(s, limit, shear)) {
            const failure_state failed = failure_of(failure_principal_of(s), limit, shear);
            coeff best = REAL(-1);
            for (int slot = row_start[e / C]; failed.ratio >= REAL(1) && slot < row_start[e / C + 1]; ++slot) {
                const brc_size entry = (brc_size)slot * C + e % C;
                if (!(alive[entry] > 0)) continue;
                const int j = neighbour[entry];
                failure_axis x;
                x.x = branch[(brc_size)slot * 3 * C + e % C] + (coeff)(displacement[(brc_size)j * 3] - displacement[(brc_size)e * 3]);
                x.y = branch[((brc_size)slot * 3 + 1) * C + e % C] + (coeff)(displacement[(brc_size)j * 3 + 1] - displacement[(brc_size)e * 3 + 1]);
                x.z = branch[((brc_size)slot * 3 + 2) * C + e % C] + (coeff)(displacement[(brc_size)j * 3 + 2] - displacement[(brc_size)e * 3 + 2]);
                const coeff aligned = failure_alignment(failed, x, REAL(1) / SQRT(x.x * x.x + x.y * x.y + x.z * x.z));
                if (!(aligned > best)) continue;
                best = aligned;
                choice[e] = 4 * j + failed.mode;
                measure[e] = failed.stress;
            }
        }
    }
}

/* How far every element is on its way to failure [n]. */
KERNEL void fracture_ratio(int n, int drucker_prager, coeff slope, coeff friction, GLOBAL const coeff *restrict limits,
                           GLOBAL const coeff *restrict stress, GLOBAL coeff *restrict ratio)
{
    FOR_EACH_ITEM(e, n) {
        const failure_shear shear = {drucker_prager, slope, friction};
        const failure_state failed = failure_of(failure_principal_of(fracture_stress_of(stress, e)), fracture_limits_of(limits, e), shear);
        ratio[e] = failed.ratio; /* of a name: clang's target reading cannot map a member of a call's value */
    }
}

/* The bond of an entry is unbroken and chosen by one of its two elements. */
LAW int fracture_dies(GLOBAL const int *restrict neighbour, GLOBAL const coeff *restrict alive, GLOBAL const int *restrict choice, int e,
                      brc_size entry)
{
    if (!(alive[entry] > 0)) return 0;
    const int j = neighbour[entry], own = choice[e], other = choice[j];
    return (own >= 0 && own / 4 == j) || (other >= 0 && other / 4 == e);
}

/* x = (x, y, z) of one element: force -= f, velocity += half_kick f / m. */
LAW void fracture_take(GLOBAL state *restrict force, GLOBAL state *restrict velocity, state mass, state half_kick, int e, coeff x, coeff y, coeff z)
{
    const coeff part[3] = {x, y, z};
    for (int c = 0; c < 3; ++c) {
        force[(brc_size)e * 3 + c] -= part[c];
        velocity[(brc_size)e * 3 + c] += half_kick * part[c] / mass;
    }
}

/* Bonds chosen by either of their elements break. What they carried leaves the forces, which then are those of the step to come; half_kick
 * dt/2 gives the step that ends its share of them back (velocity Verlet closes with the old force and opens with the new one), 0 none.
 * Of every entry that breaks: step, stress [Pa] and mode of the element that chose it (its own if both did), energy of the bond [J].
 * lost, broken [n]: half the energy and the number of bonds of each element, added up. */
KERNEL void fracture_break(int n_groups, int step, state half_kick, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                           GLOBAL const coeff *restrict branch, GLOBAL const coeff *restrict inv_length, GLOBAL coeff *restrict alive,
                           GLOBAL const int *restrict choice, GLOBAL const coeff *restrict measure,
                           GLOBAL const state *restrict displacement, GLOBAL const state *restrict orientation, coeff axial, coeff bend,
                           coeff twist, GLOBAL const coeff *restrict beam_of, GLOBAL const state *restrict mass,
                           GLOBAL const state *restrict inertia, GLOBAL state *restrict force, GLOBAL state *restrict torque,
                           GLOBAL state *restrict velocity, GLOBAL state *restrict spin, GLOBAL int *restrict break_step,
                           GLOBAL int *restrict break_mode, GLOBAL coeff *restrict break_stress, GLOBAL coeff *restrict break_energy,
                           GLOBAL state *restrict lost, GLOBAL state *restrict broken)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
        for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
            const brc_size entry = (brc_size)slot * C + (brc_size)lane0;
            int any = 0;
            for (int l = 0; l < W; ++l) any |= fracture_dies(neighbour, alive, choice, first + l, entry + l);
            if (!any) continue;
            const lane_int own = lane_own(first), j = int_block(neighbour, slot, lane0);
            const state_vec3 u = state_gather3(displacement, own);
            const lane_vec3 jump = state_vec3_difference(state_gather3(displacement, j), u);
            const lane inverse = lane_load(inv_length, entry);
            const cbm_stiffness k = cbm_stiffness_of(beam_of, own, j, axial, bend, twist);
            const cbm_shape shape = cbm_beam_shape(lane_block3(branch, slot, lane0), inverse, jump, lane_gather4(orientation, own),
                                                   lane_gather4(orientation, j), 1);
            const cbm_end end = cbm_beam_law(shape, inverse, k, 1);
            const lane energy = cbm_beam_energy(shape, inverse, k);
#define TAKE(l)                                                                                                        \
    if (fracture_dies(neighbour, alive, choice, first + 0x##l, entry + 0x##l)) {                                       \
        const int e = first + 0x##l, other = neighbour[entry + 0x##l];                                                 \
        const int by = choice[e] >= 0 && choice[e] / 4 == other ? e : other;                                           \
        alive[entry + 0x##l] = 0;                                                                                      \
        break_step[entry + 0x##l] = step;                                                                              \
        break_mode[entry + 0x##l] = choice[by] % 4;                                                                    \
        break_stress[entry + 0x##l] = measure[by];                                                                     \
        break_energy[entry + 0x##l] = LANE_ITEM(energy, l);                                                            \
        lost[e] += STATE(0.5) * (state)LANE_ITEM(energy, l);                                                           \
        broken[e] += 1;                                                                                                \
        fracture_take(force, velocity, mass[e], half_kick, e, LANE_ITEM(end.force.x, l), LANE_ITEM(end.force.y, l),    \
                      LANE_ITEM(end.force.z, l));                                                                      \
        fracture_take(torque, spin, inertia[e], half_kick, e, LANE_ITEM(end.torque.x, l), LANE_ITEM(end.torque.y, l),  \
                      LANE_ITEM(end.torque.z, l));                                                                     \
    }
            LANE_EACH(TAKE)
#undef TAKE
        }
    }
}
