/* Faces of cells that open against cohesion (dlsm; docs/notebook/fracture.md "Fracture energy", softening.h).
 * The displacement jump J = u_j - u_i over an open face is elastic but for the opening w: every law reads J - w in
 * place of J. So the gradients of the two cells do not see the crack, A and the time step stay those of the whole body
 * while the face holds, and -dW/dw is the very force of the bond. The elastic passes run over the whole body as ever;
 * here, cells with open faces take the part of w back out of their sums (all of them are linear in J). Records of
 * faces: softening_record.cl. */

/* Takes them out of the forces. */
KERNEL void soft_take_force(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) alive, OWN(int) n_open,
                            OWN(int) open, OWN(coeff) opening, OWN(coeff) ratio, coeff k_one, coeff one_plus_tau,
                            GATHER(coeff) modulus, UPDATE(state) force)
{
    FOR_EACH_ITEM(group, n_groups) {
        const members who = members_of_group(group, row_start);
        if (soft_has_open(who, n_open)) {
            lane_vec3 f = {LANE_ZERO, LANE_ZERO, LANE_ZERO};
            for (int slot = who.begin; slot < who.end; ++slot) {
                if (!soft_slot_open(who, open, slot)) continue;
                const lane_vec3 w = lane_vec3_scale(members_row1(who, alive, slot), members_row3(who, opening, slot));
                const lane k = soft_bond_modulus(who, neighbour, modulus, k_one, slot) * one_plus_tau /
                               members_row1(who, ratio, slot);
                f = lane_vec3_add(f, lane_vec3_scale(k, w));
            }
            GLOBAL state *to = force + (brc_size)who.first * 3;
#define TAKE(l)                                                                                                        \
    to[0x##l * 3] -= (state)LANE_ITEM(f.x, l), to[0x##l * 3 + 1] -= (state)LANE_ITEM(f.y, l),                          \
        to[0x##l * 3 + 2] -= (state)LANE_ITEM(f.z, l);
            LANE_EACH(TAKE)
#undef TAKE
        }
    }
}

/* Before the sweeps of a step: faces that nothing holds go on opening as in the last step, so that what the sweeps
 * leave of the balance is no drag on sides that fly apart. What is pushed along the crack goes on along the axis alone:
 * its sides slide against what they carry, which coasting would take back. */
KERNEL void soft_coast(int n_items, int n_faces, OWN(int) face_row, OWN(int) face_entry, GATHER(int) neighbour,
                       GATHER(int) twin, GATHER(int) open, GATHER(coeff) area, GATHER(coeff) ratio,
                       GATHER(coeff) gradient, GATHER(coeff) stress, SCATTER(coeff) crack, SCATTER(coeff) opening)
{
    FOR_EACH_ITEM(item, n_items) {
        const soft_faces f = soft_faces_at(item, n_faces, face_row, face_entry, neighbour, area, ratio);
        const lane_int other = soft_ints(twin, f.entry);
        const lane_vec3 none = lane_vec3_zero(), before = soft_rows(opening, f.entry);
        lane_mask flies = soft_apart(f, open);
        lane_vec3 shift = none;
        if (LANE_SOME(flies)) {
            const soft_record r = soft_record_of(crack, f.entry);
            const lane_mat3 h = lane_gather9(gradient, f.e), beside = lane_gather9(gradient, f.j);
            const lane_vec3 axis = soft_unit_of(
                                soft_turned(r.axis, lane_mat3_mul_vec(h, r.axis), lane_mat3_mul_vec(beside, r.axis))),
                            normal =
                                soft_turned(f.area, lane_mat3_mul_vec(h, f.area), lane_mat3_mul_vec(beside, f.area));
            const lane_sym3 mean = lane_sym3_add(soft_half_stress(h, lane_gather9(stress, f.e)),
                                                 soft_half_stress(beside, lane_gather9(stress, f.j)));
            const lane along = lane_vec3_dot(r.shift, axis);
            const lane_vec3 on = lane_vec3_where(soft_is_pushed(r, soft_carried(mean, axis, normal)),
                                                 lane_vec3_scale(along, axis), r.shift);
            const lane gap = lane_vec3_dot(before, axis);
            flies = flies & LANE_LESS(LANE_ZERO, gap) & LANE_LESS(LANE_ZERO, gap + along);
            shift = lane_vec3_where(flies, on, none);
        }
        const lane_vec3 now = lane_vec3_add(before, shift);
#define COAST(l)                                                                                                       \
    if (item * W + 0x##l < n_faces) {                                                                                  \
        const int own = LANE_ITEM(f.entry, l), its = LANE_ITEM(other, l);                                              \
        soft_put_rows(opening, own, its, REAL(-1), SOFT_LANE(now, l));                                                 \
        soft_put(crack, own, SOFT_SHIFT, SOFT_LANE(shift, l));                                                         \
        soft_put(crack, own, SOFT_SIDE_SHIFT, SOFT_LANE(none, l));                                                     \
    }
        LANE_EACH(COAST)
#undef COAST
    }
}

/* What is left of the energy of a face that opens by `now`, edge: |v|^2, both: of w and v together; its crack leans as
 * it opens. */
LAW lane soft_leans(lane cosine, lane_vec3 now, lane_vec3 normal, lane edge, lane both, coeff steepest)
{
    const lane across = lane_vec3_dot(now, normal) / soft_size(normal);
    const lane far = LANE_WHERE(LANE_LESS(across, LANE_ZERO), edge, across * across + edge);
    return soft_tilt(cosine, LANE_SQRT(far) / both, steepest);
}

/* A face slides more than it opens. */
LAW lane_mask soft_slides_more(lane_vec3 w, lane_vec3 axis)
{
    const lane gap = lane_vec3_dot(w, axis);
    return LANE_LESS(REAL(2) * gap * gap, lane_vec3_dot(w, w));
}

/* The openings of the step whose motion has just been done, by the fluxes at the new place and the old openings: each
 * goes where its cohesion balances what the bond would pull with, by the stiffness of the two cells, along their axes
 * and across; so a sweep over all faces at once comes nearer to the balance of all. is_last: of the sweeps of this
 * step; only the last one wears the cohesion of a face that is open wider than ever, by w and v together: what went
 * too far before comes back for nothing. A face that would close further than shut only slides. */
KERNEL void soft_move(int n_items, int n_faces, OWN(int) face_row, OWN(int) face_entry, int is_last, coeff stiffen,
                      coeff steepest, coeff friction, coeff retention, coeff release, GATHER(int) neighbour,
                      GATHER(int) twin, GATHER(int) open, SCATTER(coeff) crack, SCATTER(coeff) opening,
                      SCATTER(coeff) edge_opening, GATHER(coeff) area, GATHER(coeff) ratio, GATHER(coeff) inv_shape,
                      GATHER(coeff) inv_volume, GATHER(coeff) plane, GATHER(coeff) shear, GATHER(coeff) reach,
                      coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau, GATHER(coeff) modulus,
                      GATHER(state) displacement, GATHER(coeff) gradient, GATHER(coeff) stress, GATHER(coeff) flux,
                      GATHER(coeff) bond_part)
{
    FOR_EACH_ITEM(item, n_items) {
        const soft_faces f = soft_faces_at(item, n_faces, face_row, face_entry, neighbour, area, ratio);
        const lane_vec3 s = f.area, none = lane_vec3_zero();
        soft_faces_ahead(item, n_faces, face_entry, crack, opening, edge_opening, area);
        const soft_record r = soft_record_of(crack, f.entry);
        const soft_cell own = soft_cell_of(f.e, s, r.axis, flux, bond_part, gradient, stress, k_one, ell_one, beta,
                                           one_plus_tau),
                        beside = soft_cell_of(f.j, s, r.axis, flux, bond_part, gradient, stress, k_one, ell_one, beta,
                                              one_plus_tau);
        const lane_vec3 normal = soft_turned(s, own.along_area, beside.along_area),
                        axis = soft_unit_of(soft_turned(r.axis, own.along_axis, beside.along_axis));
        const lane k = soft_modulus(f, modulus, k_one);
        const lane_vec3 before = soft_rows(opening, f.entry),
                        pull = soft_bond_force(own.pulls, beside.pulls, k * one_plus_tau, f.ratio,
                                               lane_vec3_sub(soft_jump(f, displacement), before));
        const lane_vec3 given = soft_pull_of(f.e, s, inv_shape), taken = soft_pull_of(f.j, s, inv_shape);
        const lane share = REAL(0.5) * f.ratio * lane_vec3_dot(s, lane_vec3_add(given, taken));
        const lane bond = stiffen * soft_bond_stiffness(k, f.ratio, share, beta, one_plus_tau);
        const lane_sym3 here = soft_draws_back(f.e, given, stiffen, inv_volume, plane, shear, reach),
                        there = soft_draws_back(f.j, taken, stiffen, inv_volume, plane, shear, reach),
                        stiffness = lane_sym3_scale_shift(lane_number(1), lane_sym3_add(here, there), bond);
        const soft_face law = soft_law_of(r);
        const lane_mask slides = soft_slides(r), passes = soft_passes(r);
        lane keeps = soft_keeps(r.widest, release * f.ratio * soft_size(s));
        const lane_sym3 mean = soft_mean_stress(own, beside);
        lane_vec3 drive = lane_vec3_add(pull, lane_sym3_mul_vec(stiffness, before));
        if (LANE_SOME(passes)) {
            const lane stays = soft_stays(f, r, before, axis, soft_number(crack, f.entry, SOFT_ONSET), k),
                       whole = stays * LANE_WHERE(passes, soft_force(law, r.widest) / law.start, LANE_ZERO);
            keeps = keeps * (stays - whole);
            drive = lane_vec3_sub(
                drive, lane_vec3_where(passes, lane_vec3_scale(whole, soft_passed(mean, axis, normal)), none));
        }
        const lane_vec3 push = soft_carried(mean, axis, normal), carried = lane_vec3_scale(keeps, push);
        const lane_vec3 found = soft_balance(
            law, r.widest, drive, stiffness, soft_secant(law, lane_max(soft_size(before), r.widest)), axis, before,
            friction, carried, retention * soft_keeps(r.widest, REAL(2) * soft_end(law)) * soft_size(carried));
        const lane_vec3 now = lane_vec3_where(slides | soft_in_interface(r), found, soft_outside(found, normal));
        const lane w = soft_size(now),
                   even = soft_above(-lane_vec3_dot(pull, axis), 0) / (f.ratio * LANE_SQRT(soft_size(s)));
        const lane_vec3 side_before = soft_rows(edge_opening, f.entry), moved = lane_vec3_sub(now, before),
                        lacks = soft_sides_lack(f, own, beside, lane_vec3_dot(lane_vec3_sub(given, taken), s), share,
                                                moved, side_before);
        const lane_vec3 uneven =
            lane_vec3_sub(soft_uneven(own.pulls, beside.pulls), lane_sym3_mul_vec(lane_sym3_sub(here, there), moved));
        const lane_mask small = LANE_LESS(lane_vec3_dot(side_before, side_before), SOFT_SIDES_EVEN * w * w),
                        rests = soft_apart(f, open) & small & ~soft_is_pushed(r, push);
        const lane_mask along = passes & soft_slides_more(now, axis);
        const lane_vec3 turn = soft_side(law, lane_max(w, r.widest), uneven, stiffness, side_before, lacks, even,
                                         normal, ~(slides | along | rests));
        const lane_vec3 side = lane_vec3_add(side_before, turn), edge_shift = lane_vec3_add(r.edge_shift, turn),
                        shift = lane_vec3_add(r.shift, moved);
        const lane edge = lane_vec3_dot(side, side), both = LANE_SQRT(w * w + edge);
        const lane_mask wears = LANE_LESS(r.widest, both);
        const lane leans = LANE_WHERE(slides, lane_number(1), soft_leans(r.cosine, now, normal, edge, both, steepest));
        const lane widest = LANE_WHERE(wears, both, r.widest), tilt = LANE_WHERE(wears, leans, r.tilt);
        const lane_int other = soft_ints(twin, f.entry);
#define MOVE(l)                                                                                                        \
    if (item * W + 0x##l < n_faces) {                                                                                  \
        const int mine = LANE_ITEM(f.entry, l), its = LANE_ITEM(other, l);                                             \
        soft_put_rows(opening, mine, its, REAL(-1), SOFT_LANE(now, l));                                                \
        soft_put_rows(edge_opening, mine, its, REAL(1), SOFT_LANE(side, l));                                           \
        soft_put(crack, mine, SOFT_SHIFT, SOFT_LANE(shift, l));                                                        \
        soft_put(crack, mine, SOFT_SIDE_SHIFT, SOFT_LANE(edge_shift, l));                                              \
        if (is_last) soft_put_number(crack, mine, SOFT_WIDEST, LANE_ITEM(widest, l));                                  \
        if (is_last) soft_put_number(crack, mine, SOFT_TILT, LANE_ITEM(tilt, l));                                      \
    }
        LANE_EACH(MOVE)
#undef MOVE
    }
}

/* Sides of faces without cohesion that stand clear of each other. release: gap over the length of the bond from which
 * on sides that are pushed along the crack (soft_is_pushed) do; a fifth of it where they are not: opened by that, the
 * two cells only hinder each other's turning. */
LAW lane_mask soft_parts(soft_faces f, soft_record r, soft_cell own, soft_cell beside, lane_vec3 w, coeff release)
{
    const lane_vec3 axis = soft_unit_of(soft_turned(r.axis, own.along_axis, beside.along_axis)),
                    push = soft_carried(soft_mean_stress(own, beside), axis,
                                        soft_turned(f.area, own.along_area, beside.along_area));
    const lane far = release * f.ratio * soft_size(f.area);
    const lane_mask bears = soft_slides(r) | soft_is_pushed(r, push);
    return soft_is_clear(w, axis, LANE_WHERE(bears, far, REAL(0.2) * far));
}

/* Forces of the open bonds as they are now. book: 1: the work of the last openings (trapezoidal rule, each side half)
 * goes to spent and, but for what is still held, to lost [n]; bonds at the end of their cohesion are marked, those
 * whose sides part (soft_parts, release) to break. */
KERNEL void soft_measure(int n_items, int n_faces, OWN(int) face_row, OWN(int) face_entry, int book, coeff release,
                         GATHER(int) neighbour, GATHER(int) twin, SCATTER(int) open, SCATTER(coeff) crack,
                         GATHER(coeff) opening, GATHER(coeff) edge_opening, GATHER(coeff) area, GATHER(coeff) ratio,
                         coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau, GATHER(coeff) modulus,
                         GATHER(state) displacement, GATHER(coeff) gradient, GATHER(coeff) stress, GATHER(coeff) flux,
                         GATHER(coeff) bond_part, SCATTER(int) mark, SCATTER(coeff) measure, SCATTER(int) touched)
{
    FOR_EACH_ITEM(item, n_items) {
        const soft_faces f = soft_faces_at(item, n_faces, face_row, face_entry, neighbour, area, ratio);
        const soft_record r = soft_record_of(crack, f.entry);
        const soft_cell own = soft_cell_of(f.e, f.area, r.axis, flux, bond_part, gradient, stress, k_one, ell_one, beta,
                                           one_plus_tau),
                        beside = soft_cell_of(f.j, f.area, r.axis, flux, bond_part, gradient, stress, k_one, ell_one,
                                              beta, one_plus_tau);
        const lane_vec3 w = soft_rows(opening, f.entry);
        const lane_vec3 force = soft_bond_force(own.pulls, beside.pulls, soft_modulus(f, modulus, k_one) * one_plus_tau,
                                                f.ratio, lane_vec3_sub(soft_jump(f, displacement), w));
        const lane_vec3 uneven = soft_uneven(own.pulls, beside.pulls);
        const soft_face law = soft_law_of(r);
        const lane_mask slides = soft_slides(r);
        const lane onset = soft_number(crack, f.entry, SOFT_ONSET);
        lane given = LANE_ZERO, rubs = LANE_ZERO, holds = soft_number(crack, f.entry, SOFT_HELD),
             spent = soft_number(crack, f.entry, SOFT_SPENT);
        lane apart = LANE_ZERO, clear = LANE_ZERO;
        if (book) {
            const lane_vec3 side = soft_rows(edge_opening, f.entry);
            const lane turning = LANE_WHERE(
                slides, LANE_ZERO,
                lane_vec3_dot(lane_vec3_add(uneven, soft_vector_of(crack, f.entry, SOFT_SIDE_PULL)), r.edge_shift));
            const lane work =
                REAL(0.5) *
                (lane_vec3_dot(lane_vec3_add(force, soft_vector_of(crack, f.entry, SOFT_PULL)), r.shift) + turning);
            const lane before = holds;
            holds = soft_held(law, r.widest, LANE_SQRT(lane_vec3_dot(w, w) + lane_vec3_dot(side, side)));
            given = work - (holds - before);
            if (LANE_SOME(slides)) { /* the rest is friction */
                const lane took = soft_spent(law, r.widest) - spent;
                rubs = LANE_WHERE(slides, given - took, rubs);
                given = LANE_WHERE(slides, took, given);
            }
            const lane_mask was = soft_apart(f, open), ends = was | ~LANE_LESS(r.widest, soft_end(law));
            spent = LANE_WHERE(was, spent, spent + given);
            if (LANE_SOME(ends)) {
                apart = LANE_WHERE(ends, lane_number(1), apart);
                clear = LANE_WHERE(ends & soft_parts(f, r, own, beside, w, release), lane_number(1), clear);
            }
        }
        const lane_vec3 last = lane_vec3_where(slides, (lane_vec3){rubs, LANE_ZERO, LANE_ZERO}, uneven);
        const lane_int other = soft_ints(twin, f.entry);
#define MEASURE(l)                                                                                                     \
    if (item * W + 0x##l < n_faces) {                                                                                  \
        const int mine = LANE_ITEM(f.entry, l), its = LANE_ITEM(other, l);                                             \
        soft_put_numbers(crack, mine, its, SOFT_SPENT, LANE_ITEM(spent, l));                                           \
        soft_put_numbers(crack, mine, its, SOFT_HELD, LANE_ITEM(holds, l));                                            \
        soft_put_numbers(crack, mine, its, SOFT_BOOKED, LANE_ITEM(given, l));                                          \
        soft_put_numbers(crack, mine, its, SOFT_RUBS, LANE_ITEM(last.x, l));                                           \
        soft_put(crack, mine, SOFT_SIDE_PULL, SOFT_LANE(last, l));                                                     \
        soft_put(crack, mine, SOFT_PULL, SOFT_LANE(force, l));                                                         \
        if (LANE_ITEM(apart, l) > 0) STORE_SAME(open + mine, SOFT_APART), STORE_SAME(open + its, SOFT_APART);          \
        if (LANE_ITEM(clear, l) > 0) {                                                                                 \
            const int mode = LANE_ITEM(r.turns, l) > REAL(1) ? CELLS_SHEAR : CELLS_TENSION;                            \
            mark[mine] = mode, mark[its] = mode;                                                                       \
            measure[mine] = LANE_ITEM(onset, l), measure[its] = LANE_ITEM(onset, l);                                   \
            STORE_SAME(touched + LANE_ITEM(f.e, l), 1);                                                                \
            STORE_SAME(touched + LANE_ITEM(f.j, l), 1);                                                                \
        }                                                                                                              \
    }
        LANE_EACH(MEASURE)
#undef MEASURE
    }
}

/* Each element's half of what its open bonds booked, rubbed [n] what broken ones do to each other; bonds whose cohesion
 * ended are broken from then on, though their sides still bear on each other. found [n]: bonds that are marked. */
KERNEL void soft_book(int n, int step, OWN(int) row_start, OWN(coeff) alive, OWN(int) n_open, OWN(int) open,
                      OWN(int) lead, OWN(int) mark, PUT(state) found, OWN(coeff) crack, UPDATE(int) break_step,
                      PUT(int) break_mode, PUT(coeff) break_stress, PUT(coeff) break_energy, UPDATE(state) lost,
                      UPDATE(state) rubbed, UPDATE(state) broken)
{
    FOR_EACH_ITEM(e, n) {
        int count = 0;
        for (int slot = row_start[e / C]; n_open[e] && slot < row_start[e / C + 1]; ++slot) {
            const brc_size entry = SOFT_ENTRY;
            if (!open[entry] || !(alive[entry] > 0)) continue;
            const int slides = SOFT_IS_SLIDING(entry);
            count += lead[entry] && mark[entry];
            GLOBAL state *to = break_step[entry] && !slides ? rubbed : lost;
            to[e] += STATE(0.5) * (state)SOFT_NUMBER(entry, BOOKED);
            if (slides) rubbed[e] += STATE(0.5) * (state)SOFT_NUMBER(entry, RUBS);
            if (open[entry] != SOFT_APART || break_step[entry]) continue;
            break_step[entry] = step;
            break_mode[entry] = slides ? CELLS_SHEAR : CELLS_TENSION;
            break_stress[entry] = SOFT_NUMBER(entry, ONSET);
            break_energy[entry] = SOFT_NUMBER(entry, SPENT);
            broken[e] += 1;
        }
        found[e] = (state)count;
    }
}

/* After dlsm_energy: the bonds' energy of J - w in place of that of J, and what the cohesion holds; half to each side
 * [J] [n]. */
KERNEL void soft_energy(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) alive, OWN(int) n_open,
                        OWN(int) open, OWN(coeff) crack, OWN(coeff) opening, OWN(coeff) area, OWN(coeff) ratio,
                        GATHER(state) displacement, GATHER(coeff) gradient, coeff k_one, coeff ell_one, coeff beta,
                        coeff one_plus_tau, GATHER(coeff) modulus, GATHER(coeff) ell_of, UPDATE(state) stabilisation)
{
    FOR_EACH_ITEM(group, n_groups) {
        const members who = members_of_group(group, row_start);
        if (soft_has_open(who, n_open)) {
            const lane_mat3 h = lane_gather9(gradient, who.own);
            const state_vec3 u = state_gather3(displacement, who.own);
            const lane half_one = lane_number(REAL(0.5));
            lane_state sum = state_load(stabilisation, (brc_size)who.first);
            for (int slot = who.begin; slot < who.end; ++slot) {
                if (!soft_slot_open(who, open, slot)) continue;
                const lane_int j = members_neighbour(who, neighbour, slot);
                const lane_mat3 h_j = lane_gather9(gradient, j);
#if BRC_MANY_MATERIALS
                const lane ell = members_number(who, ell_of), ell_j = gather_component(ell_of, j);
#else
                const lane ell = lane_number(ell_one), ell_j = ell;
#endif
                const lane k = soft_bond_modulus(who, neighbour, modulus, k_one, slot);
                const lane_mat3 mean = lane_mat3_scale(half_one, lane_mat3_add(h, h_j));
                const lane_mat3 compaction = lane_mat3_scale(
                    half_one, lane_mat3_add(dlsm_compaction(h, ell, 1), dlsm_compaction(h_j, ell_j, 1)));
                const lane_vec3 s = members_face3(who, area, slot),
                                jump = state_vec3_difference(state_gather3(displacement, j), u),
                                elastic = lane_vec3_sub(jump, members_row3(who, opening, slot));
                const lane q = members_row1(who, ratio, slot);
                const lane more = dlsm_bond_energy(jump, mean, compaction, s, q, k, beta, one_plus_tau),
                           less = dlsm_bond_energy(elastic, mean, compaction, s, q, k, beta, one_plus_tau);
                const lane held = soft_number(crack, lane_own(slot * C + who.lane0), SOFT_HELD);
                sum += STATE(0.5) * STATE_FROM_LANE(members_row1(who, alive, slot) * (less - more + held));
            }
#define PUT_LANE(l) stabilisation[who.first + 0x##l] = LANE_ITEM(sum, l);
            LANE_EACH(PUT_LANE)
#undef PUT_LANE
        }
    }
}

/* Bonds of the listed elements that broke at the end of their cohesion, after cells_share: the energy their openings
 * took is theirs too [J]. */
KERNEL void soft_settle(int n, int step, OWN(int) list, OWN(int) row_start, OWN(int) break_step, OWN(int) open,
                        OWN(coeff) crack, UPDATE(coeff) break_energy)
{
    FOR_EACH_ITEM(k, n) {
        const int e = list[k];
        for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
            const brc_size entry = SOFT_ENTRY;
            if (break_step[entry] != step || !open[entry]) continue;
            if (open[entry] == SOFT_APART)
                break_energy[entry] = SOFT_NUMBER(entry, SPENT);
            else
                break_energy[entry] += SOFT_NUMBER(entry, SPENT);
        }
    }
}
