/* Faces of cells that open against cohesion (dlsm; docs/notebook/fracture.md "Fracture energy", softening.h).
 * The displacement jump J = u_j - u_i over an open face is elastic but for the opening w: every law reads J - w in
 * place of J. So the gradients of the two cells do not see the crack, A and the time step stay those of the whole body
 * while the face holds, and -dW/dw is the very force of the bond. The elastic passes run over the whole body as ever;
 * here, cells with open faces take the part of w back out of their sums (all of them are linear in J). Records of
 * faces: softening_record.cl. */

/* Takes the openings out of H. listed: only of the n elements of the list. */
KERNEL void soft_gradient(int n, int listed, OWN(int) list, OWN(int) row_start, OWN(coeff) alive, OWN(int) n_open,
                          OWN(int) open, OWN(coeff) crack, OWN(coeff) area, OWN(coeff) inv_shape,
                          UPDATE(coeff) gradient)
{
    FOR_EACH_ITEM(item, n) {
        const int e = listed ? list[item] : item;
        for (int slot = row_start[e / C]; n_open[e] && slot < row_start[e / C + 1]; ++slot) {
            const brc_size entry = SOFT_ENTRY;
            if (!open[entry] || !(alive[entry] > 0)) continue;
            const soft_vector w =
                soft_add(soft_part(crack, entry, SOFT_OPENING), REAL(1), soft_part(crack, entry, SOFT_SIDE));
            const soft_vector a = soft_pull_of(inv_shape, e, soft_area(area, entry));
            GLOBAL coeff *h = gradient + (brc_size)e * 9;
            h[0] -= w.x * a.x, h[1] -= w.x * a.y, h[2] -= w.x * a.z;
            h[3] -= w.y * a.x, h[4] -= w.y * a.y, h[5] -= w.y * a.z;
            h[6] -= w.z * a.x, h[7] -= w.z * a.y, h[8] -= w.z * a.z;
        }
    }
}

/* Takes them out of B, whose sum of r (x) s is that of J - w. With several materials it reads J. With one it reads
 * gradients alone, which are those of J - w - v: v comes back in. */
KERNEL void soft_flux(int n, int listed, OWN(int) list, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) alive,
                      OWN(int) n_open, OWN(int) open, OWN(coeff) crack, OWN(coeff) area, OWN(coeff) inv_shape,
                      OWN(coeff) gradient, coeff k_one, coeff ell_one, GATHER(coeff) modulus, OWN(coeff) ell_of,
                      coeff beta, coeff one_plus_tau, UPDATE(coeff) flux)
{
    FOR_EACH_ITEM(item, n) {
        const int e = listed ? list[item] : item;
        if (n_open[e]) {
            lane_mat3 rs = lane_mat3_zero(); /* k sum c w (x) s [N m] */
            for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
                const brc_size entry = SOFT_ENTRY;
                if (!open[entry] || !(alive[entry] > 0)) continue;
#if BRC_MANY_MATERIALS
                const soft_vector w =
                    soft_scale(SOFT_BOND_MODULUS(e, neighbour[entry]), soft_part(crack, entry, SOFT_OPENING));
#else
                const soft_vector w = soft_scale(-k_one, soft_part(crack, entry, SOFT_SIDE));
#endif
                const soft_vector s = soft_area(area, entry);
                rs = lane_add_outer(rs, (lane_vec3){LANE_ZERO + w.x, LANE_ZERO + w.y, LANE_ZERO + w.z},
                                    (lane_vec3){LANE_ZERO + s.x, LANE_ZERO + s.y, LANE_ZERO + s.z});
            }
            GLOBAL const coeff *p = inv_shape + (brc_size)(e / C) * 6 * C + e % C, *h = gradient + (brc_size)e * 9;
            const lane_sym3 inverse = {LANE_ZERO + p[0],     LANE_ZERO + p[C],     LANE_ZERO + p[2 * C],
                                       LANE_ZERO + p[3 * C], LANE_ZERO + p[4 * C], LANE_ZERO + p[5 * C]};
            const lane_mat3 own = {LANE_ZERO + h[0], LANE_ZERO + h[1], LANE_ZERO + h[2],
                                   LANE_ZERO + h[3], LANE_ZERO + h[4], LANE_ZERO + h[5],
                                   LANE_ZERO + h[6], LANE_ZERO + h[7], LANE_ZERO + h[8]};
            const lane half_tau = LANE_ZERO + REAL(0.5) * one_plus_tau, half_beta = LANE_ZERO + REAL(0.5) * beta,
                       ell = LANE_ZERO + SOFT_ELL(e);
            const lane_mat3 q = lane_mat3_sub(lane_mat3_scale(half_tau, rs),
                                              dlsm_compaction_adjoint(own, lane_mat3_scale(half_beta, rs), ell, 1));
            const lane_mat3 b = lane_mat3_mul_sym(q, inverse);
            GLOBAL coeff *to = flux + (brc_size)e * 9;
            to[0] += LANE_ITEM(b.xx, 0), to[1] += LANE_ITEM(b.xy, 0), to[2] += LANE_ITEM(b.xz, 0);
            to[3] += LANE_ITEM(b.yx, 0), to[4] += LANE_ITEM(b.yy, 0), to[5] += LANE_ITEM(b.yz, 0);
            to[6] += LANE_ITEM(b.zx, 0), to[7] += LANE_ITEM(b.zy, 0), to[8] += LANE_ITEM(b.zz, 0);
        }
    }
}

/* Takes them out of the forces. */
KERNEL void soft_take_force(int n, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) alive, OWN(int) n_open,
                            OWN(int) open, OWN(coeff) crack, OWN(coeff) ratio, coeff k_one, coeff one_plus_tau,
                            GATHER(coeff) modulus, UPDATE(state) force)
{
    FOR_EACH_ITEM(e, n) {
        if (n_open[e]) {
            soft_vector f = {0, 0, 0};
            for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
                const brc_size entry = SOFT_ENTRY;
                if (!open[entry] || !(alive[entry] > 0)) continue;
                f = soft_add(f, SOFT_BOND_MODULUS(e, neighbour[entry]) * one_plus_tau / ratio[entry],
                             soft_part(crack, entry, SOFT_OPENING));
            }
            GLOBAL state *to = force + (brc_size)e * 3;
            to[0] -= (state)f.x, to[1] -= (state)f.y, to[2] -= (state)f.z;
        }
    }
}

/* Force of a bond on its own element [N]: dlsm_bond_force. */
LAW soft_vector soft_bond_force(GATHER(coeff) flux, GATHER(coeff) bond_part, int e, int j, soft_vector s, coeff spring,
                                coeff ratio, soft_vector elastic_jump)
{
    soft_vector f = soft_add(soft_times(flux, e, s), REAL(1), soft_times(flux, j, s));
#if BRC_MANY_MATERIALS
    f = soft_add(f, spring, soft_add(soft_times(bond_part, e, s), REAL(1), soft_times(bond_part, j, s)));
#endif
    return soft_add(f, spring / ratio, elastic_jump);
}

/* How unevenly the two sides of a face pull [N]: what the opening of either side alone does work against; the same seen
 * from both. With one material the flux holds the bond's own part too, which depends on what both sides open. */
LAW soft_vector soft_uneven(GATHER(coeff) flux, GATHER(coeff) gradient, int e, int j, soft_vector s, coeff k_one,
                            coeff ell_one, coeff beta, coeff one_plus_tau)
{
    soft_vector d = soft_add(soft_times(flux, e, s), REAL(-1), soft_times(flux, j, s));
#if BRC_MANY_MATERIALS
    (void)gradient, (void)k_one, (void)ell_one, (void)beta, (void)one_plus_tau;
#else
    const lane_vec3 face = {LANE_ZERO + s.x, LANE_ZERO + s.y, LANE_ZERO + s.z};
    const lane ell = LANE_ZERO + ell_one;
    for (int side = 0; side < 2; ++side) {
        GLOBAL const coeff *p = gradient + (brc_size)(side ? j : e) * 9;
        const lane_mat3 h = {LANE_ZERO + p[0], LANE_ZERO + p[1], LANE_ZERO + p[2], LANE_ZERO + p[3], LANE_ZERO + p[4],
                             LANE_ZERO + p[5], LANE_ZERO + p[6], LANE_ZERO + p[7], LANE_ZERO + p[8]};
        const lane_vec3 along = lane_mat3_mul_vec(h, face), compact = dlsm_compaction_along(h, along, face, ell, 1);
        const coeff half_k = side ? REAL(0.5) * k_one : REAL(-0.5) * k_one;
        const soft_vector m = {LANE_ITEM(compact.x, 0), LANE_ITEM(compact.y, 0), LANE_ITEM(compact.z, 0)};
        const soft_vector g = {LANE_ITEM(along.x, 0), LANE_ITEM(along.y, 0), LANE_ITEM(along.z, 0)};
        d = soft_add(d, half_k, soft_add(soft_scale(beta, m), -one_plus_tau, g));
    }
#endif
    return d;
}

/* Mean of the two cells' stress in the present frame, sym(P F_H^T) [Pa]. */
LAW failure_stress soft_mean_stress(GATHER(coeff) gradient, GATHER(coeff) stress, int i, int j)
{
    failure_stress sum = {0, 0, 0, 0, 0, 0};
    for (int side = 0; side < 2; ++side) {
        GLOBAL const coeff *h = gradient + (brc_size)(side ? j : i) * 9, *p = stress + (brc_size)(side ? j : i) * 9;
        coeff t[9];
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
                t[3 * a + b] =
                    p[3 * a + b] + p[3 * a] * h[3 * b] + p[3 * a + 1] * h[3 * b + 1] + p[3 * a + 2] * h[3 * b + 2];
        sum.xx += REAL(0.5) * t[0], sum.yy += REAL(0.5) * t[4], sum.zz += REAL(0.5) * t[8];
        sum.yz += REAL(0.25) * (t[5] + t[7]), sum.xz += REAL(0.25) * (t[2] + t[6]),
            sum.xy += REAL(0.25) * (t[1] + t[3]);
    }
    return sum;
}

/* Area vector in the present frame [m^2], and the axis of the crack, from what it was in the undeformed body. */
LAW soft_vector soft_turned(GATHER(coeff) gradient, int i, int j, soft_vector a)
{
    return soft_add(a, REAL(0.5), soft_add(soft_times(gradient, i, a), REAL(1), soft_times(gradient, j, a)));
}
/* Back again, of a direction and small strains: by the transpose. */
LAW soft_vector soft_turned_back(GATHER(coeff) gradient, int i, int j, soft_vector a)
{
    GLOBAL const coeff *p = gradient + (brc_size)i * 9, *q = gradient + (brc_size)j * 9;
    const soft_vector sum = {(p[0] + q[0]) * a.x + (p[3] + q[3]) * a.y + (p[6] + q[6]) * a.z,
                             (p[1] + q[1]) * a.x + (p[4] + q[4]) * a.y + (p[7] + q[7]) * a.z,
                             (p[2] + q[2]) * a.x + (p[5] + q[5]) * a.y + (p[8] + q[8]) * a.z};
    return soft_add(a, REAL(0.5), sum);
}
LAW soft_vector soft_unit(soft_vector a) { return soft_scale(REAL(1) / SQRT(soft_dot(a, a)), a); }

/* Before the sweeps of a step: faces that nothing holds go on opening as in the last step, so that what the sweeps
 * leave of the balance is no drag on sides that fly apart. */
KERNEL void soft_coast(int n, OWN(int) row_start, OWN(int) neighbour, OWN(int) twin, OWN(coeff) alive, OWN(int) n_open,
                       OWN(int) open, OWN(int) lead, GATHER(coeff) gradient, SCATTER(coeff) crack)
{
    FOR_EACH_ITEM(e, n) {
        for (int slot = row_start[e / C]; n_open[e] && slot < row_start[e / C + 1]; ++slot) {
            const brc_size entry = SOFT_ENTRY, other = (brc_size)twin[entry];
            if (!open[entry] || !lead[entry] || !(alive[entry] > 0)) continue;
            const soft_vector none = {0, 0, 0};
            soft_vector shift = none;
            if (open[entry] == SOFT_APART) {
                const soft_vector axis =
                    soft_unit(soft_turned(gradient, e, neighbour[entry], soft_part(crack, entry, SOFT_AXIS)));
                const soft_vector before = soft_part(crack, entry, SOFT_OPENING),
                                  last = soft_part(crack, entry, SOFT_SHIFT), now = soft_add(before, REAL(1), last);
                if (soft_dot(before, axis) > 0 && soft_dot(now, axis) > 0) {
                    shift = last;
                    soft_put(crack, entry, SOFT_OPENING, now),
                        soft_put(crack, other, SOFT_OPENING, soft_scale(REAL(-1), now));
                }
            }
            soft_put(crack, entry, SOFT_SHIFT, shift), soft_put(crack, other, SOFT_SHIFT, soft_scale(REAL(-1), shift));
            soft_put(crack, entry, SOFT_SIDE_SHIFT, none), soft_put(crack, other, SOFT_SIDE_SHIFT, none);
        }
    }
}

/* A face is open wider than ever, by w and v together (both): its cohesion has worn, and its crack leans as it opens.
 * edge: |v|^2. */
LAW void soft_wear(SCATTER(coeff) crack, brc_size entry, brc_size other, soft_vector now, soft_vector normal,
                   coeff edge, coeff both, coeff steepest)
{
    const coeff across = soft_dot(now, normal) / SQRT(soft_dot(normal, normal));
    const coeff tilt = SOFT_IS_SLIDING(entry)
                           ? REAL(1)
                           : soft_tilt(SOFT_NUMBER(entry, COSINE),
                                       (across < 0 ? SQRT(edge) : SQRT(across * across + edge)) / both, steepest);
    SOFT_NUMBER(entry, WIDEST) = both, SOFT_NUMBER(other, WIDEST) = both;
    SOFT_NUMBER(entry, TILT) = tilt, SOFT_NUMBER(other, TILT) = tilt;
}

/* The openings of the step whose motion has just been done, by the fluxes at the new place and the old openings: each
 * goes where its cohesion balances what the bond would pull with, by the stiffness of the two cells, along their axes
 * and across; so a sweep over all faces at once comes nearer to the balance of all. is_last: of the sweeps of this
 * step; only the last one wears the cohesion, what went too far before comes back for nothing. A face that would close
 * further than shut only slides. */
KERNEL void soft_move(int n, int is_last, coeff stiffen, coeff steepest, coeff friction, coeff retention, coeff release,
                      OWN(int) row_start, OWN(int) neighbour, OWN(int) twin, OWN(coeff) alive, OWN(int) n_open,
                      OWN(int) open, OWN(int) lead, SCATTER(coeff) crack, OWN(coeff) area, OWN(coeff) ratio,
                      GATHER(coeff) inv_shape, GATHER(coeff) inv_volume, GATHER(coeff) plane, GATHER(coeff) shear,
                      GATHER(coeff) reach, coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau,
                      GATHER(coeff) modulus, GATHER(state) displacement, GATHER(coeff) gradient, GATHER(coeff) stress,
                      GATHER(coeff) flux, GATHER(coeff) bond_part)
{
    FOR_EACH_ITEM(e, n) {
        for (int slot = row_start[e / C]; n_open[e] && slot < row_start[e / C + 1]; ++slot) {
            const brc_size entry = SOFT_ENTRY, other = (brc_size)twin[entry];
            if (!open[entry] || !lead[entry] || !(alive[entry] > 0)) continue;
            const int j = neighbour[entry];
            const coeff bond_modulus = SOFT_BOND_MODULUS(e, j);
            const soft_face face = {SOFT_NUMBER(entry, START), SOFT_NUMBER(entry, ENERGY) * SOFT_NUMBER(entry, TILT),
                                    SOFT_NUMBER(entry, EXPONENTIAL) > 0};
            const soft_vector s = soft_area(area, entry), before = soft_part(crack, entry, SOFT_OPENING);
            const soft_vector own = soft_pull_of(inv_shape, e, s), theirs = soft_pull_of(inv_shape, j, s);
            const soft_vector pull =
                soft_bond_force(flux, bond_part, e, j, s, bond_modulus * one_plus_tau, ratio[entry],
                                soft_add(soft_jump(displacement, e, j), REAL(-1), before));
            const coeff share = REAL(0.5) * ratio[entry] * soft_dot(s, soft_add(own, REAL(1), theirs));
            const coeff bond = stiffen * soft_bond_stiffness(bond_modulus, ratio[entry], share, beta, one_plus_tau);
            const soft_tensor nothing = {0, 0, 0, 0, 0, 0}, spring = {bond, bond, bond, 0, 0, 0};
            const soft_tensor here = soft_add_cell(nothing, own, reach[e], stiffen / inv_volume[e], plane[e], shear[e]);
            const soft_tensor there =
                soft_add_cell(nothing, theirs, reach[j], stiffen / inv_volume[j], plane[j], shear[j]);
            const soft_tensor sides = soft_tensor_add(here, REAL(1), there),
                              stiffness = soft_tensor_add(sides, REAL(1), spring);
            const soft_vector normal = soft_turned(gradient, e, j, s),
                              axis = soft_unit(soft_turned(gradient, e, j, soft_part(crack, entry, SOFT_AXIS)));
            const int slides = SOFT_IS_SLIDING(entry);
            const soft_vector none = {0, 0, 0};
            const coeff keeps = soft_keeps(SOFT_NUMBER(entry, WIDEST), release * ratio[entry] * SQRT(soft_dot(s, s)));
            const failure_stress mean = soft_mean_stress(gradient, stress, e, j);
            const coeff whole = slides ? soft_force(face, SOFT_NUMBER(entry, WIDEST)) / face.start : 0;
            const soft_vector carried =
                soft_scale(slides ? keeps * (REAL(1) - whole) : keeps, soft_carried(mean, axis, normal));
            const soft_vector passed = slides ? soft_scale(whole, soft_passed(mean, axis, normal)) : none;
            const soft_vector drive =
                soft_add(soft_add(pull, REAL(1), soft_tensor_times(stiffness, before)), REAL(-1), passed);
            const coeff wide = SOFT_NUMBER(entry, WIDEST), was = SQRT(soft_dot(before, before)),
                        at = was > wide ? was : wide;
            const soft_vector found = soft_balance(
                face, wide, drive, stiffness, at > 0 ? soft_force(face, at) / at : 0, axis, before, friction, carried,
                retention * soft_keeps(wide, REAL(2) * soft_end(face)) * SQRT(soft_dot(carried, carried)));
            const soft_vector now = slides ? found : soft_outside(found, normal);
            const coeff w = SQRT(soft_dot(now, now)), push = -soft_dot(pull, axis), least = w > wide ? w : wide;
            const coeff even = SOFT_UNEVEN_HELD * (SQRT(soft_dot(carried, carried)) + (push > 0 ? push : 0));
            const soft_vector side_before = soft_part(crack, entry, SOFT_SIDE);
            const soft_vector uneven =
                soft_add(soft_uneven(flux, gradient, e, j, s, k_one, ell_one, beta, one_plus_tau), REAL(-1),
                         soft_tensor_times(soft_tensor_add(here, REAL(-1), there), soft_add(now, REAL(-1), before)));
            const int rests =
                slides || (open[entry] == SOFT_APART && soft_dot(side_before, side_before) < SOFT_UNEVEN_RESTS * w * w);
            const soft_vector turn =
                rests ? none : soft_side(face, least, uneven, stiffness, side_before, even, normal);
            const soft_vector side = soft_add(side_before, REAL(1), turn),
                              turned = soft_add(soft_part(crack, entry, SOFT_SIDE_SHIFT), REAL(1), turn);
            const coeff edge = soft_dot(side, side), both = SQRT(w * w + edge);
            soft_put(crack, entry, SOFT_SIDE, side), soft_put(crack, other, SOFT_SIDE, side);
            soft_put(crack, entry, SOFT_SIDE_SHIFT, turned), soft_put(crack, other, SOFT_SIDE_SHIFT, turned);
            const soft_vector added =
                soft_add(soft_part(crack, entry, SOFT_SHIFT), REAL(1), soft_add(now, REAL(-1), before));
            soft_put(crack, entry, SOFT_OPENING, now), soft_put(crack, other, SOFT_OPENING, soft_scale(REAL(-1), now));
            soft_put(crack, entry, SOFT_SHIFT, added), soft_put(crack, other, SOFT_SHIFT, soft_scale(REAL(-1), added));
            if (is_last && both > wide) soft_wear(crack, entry, other, now, normal, edge, both, steepest);
        }
    }
}

/* Forces of the open bonds as they are now. book: 1: the work of the last openings (trapezoidal rule, each side half)
 * goes to spent and, but for what is still held, to lost [n]; bonds at the end of their cohesion are marked. found [n].
 * release: gap over the length of the bond from which on sides that carry pushes along the crack, more than a tenth of
 * what they held at the onset, stand clear; a fifth of it where they do not: opened by that, the two cells only hinder
 * each other's turning. */
KERNEL void soft_measure(int n, int book, coeff release, OWN(int) row_start, OWN(int) neighbour, OWN(int) twin,
                         OWN(coeff) alive, OWN(int) n_open, SCATTER(int) open, OWN(int) lead, SCATTER(coeff) crack,
                         OWN(coeff) area, OWN(coeff) ratio, coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau,
                         GATHER(coeff) modulus, GATHER(state) displacement, GATHER(coeff) gradient,
                         GATHER(coeff) stress, GATHER(coeff) flux, GATHER(coeff) bond_part, SCATTER(int) mark,
                         SCATTER(coeff) measure, SCATTER(int) touched, PUT(state) found)
{
    FOR_EACH_ITEM(e, n) {
        int count = 0;
        for (int slot = row_start[e / C]; n_open[e] && slot < row_start[e / C + 1]; ++slot) {
            const brc_size entry = SOFT_ENTRY, other = (brc_size)twin[entry];
            if (!lead[entry] || !open[entry] || !(alive[entry] > 0)) continue; /* the leading side writes both */
            const int j = neighbour[entry];
            const coeff spring = SOFT_BOND_MODULUS(e, j) * one_plus_tau;
            const soft_face face = {SOFT_NUMBER(entry, START), SOFT_NUMBER(entry, ENERGY) * SOFT_NUMBER(entry, TILT),
                                    SOFT_NUMBER(entry, EXPONENTIAL) > 0};
            const soft_vector w = soft_part(crack, entry, SOFT_OPENING), jump = soft_jump(displacement, e, j);
            const soft_vector force = soft_bond_force(flux, bond_part, e, j, soft_area(area, entry), spring,
                                                      ratio[entry], soft_add(jump, REAL(-1), w));
            const soft_vector uneven =
                soft_uneven(flux, gradient, e, j, soft_area(area, entry), k_one, ell_one, beta, one_plus_tau);
            const int slides = SOFT_IS_SLIDING(entry), mode = slides ? CELLS_SHEAR : CELLS_TENSION;
            coeff given = 0, rubs = 0, holds = SOFT_NUMBER(entry, HELD);
            if (book) {
                const coeff turning = slides
                                          ? 0
                                          : soft_dot(soft_add(uneven, REAL(1), soft_part(crack, entry, SOFT_SIDE_PULL)),
                                                     soft_part(crack, entry, SOFT_SIDE_SHIFT));
                const coeff work = REAL(0.5) * (soft_dot(soft_add(force, REAL(1), soft_part(crack, entry, SOFT_PULL)),
                                                         soft_part(crack, entry, SOFT_SHIFT)) +
                                                turning);
                const soft_vector side = soft_part(crack, entry, SOFT_SIDE);
                holds = soft_held(face, SOFT_NUMBER(entry, WIDEST), SQRT(soft_dot(w, w) + soft_dot(side, side)));
                given = work - (holds - SOFT_NUMBER(entry, HELD));
                if (slides) { /* the rest is friction */
                    rubs = given;
                    given = soft_spent(face, SOFT_NUMBER(entry, WIDEST)) - SOFT_NUMBER(entry, SPENT);
                    rubs -= given;
                }
                if (open[entry] != SOFT_APART) SOFT_NUMBER(entry, SPENT) += given, SOFT_NUMBER(other, SPENT) += given;
                SOFT_NUMBER(entry, HELD) = holds, SOFT_NUMBER(other, HELD) = holds;
                const soft_vector s = soft_area(area, entry);
                if (!(SOFT_NUMBER(entry, WIDEST) < soft_end(face)))
                    STORE_SAME(open + entry, SOFT_APART), STORE_SAME(open + other, SOFT_APART);
                int clear = open[entry] == SOFT_APART;
                if (clear) {
                    const soft_vector axis = soft_unit(soft_turned(gradient, e, j, soft_part(crack, entry, SOFT_AXIS)));
                    const soft_vector push =
                        soft_carried(soft_mean_stress(gradient, stress, e, j), axis, soft_turned(gradient, e, j, s));
                    const coeff much = REAL(0.1) * SOFT_NUMBER(entry, START),
                                far = release * ratio[entry] * SQRT(soft_dot(s, s));
                    clear =
                        soft_is_clear(w, axis, slides || soft_dot(push, push) > much * much ? far : REAL(0.2) * far);
                }
                if (clear) {
                    mark[entry] = mode, mark[other] = mode;
                    measure[entry] = SOFT_NUMBER(entry, ONSET), measure[other] = SOFT_NUMBER(entry, ONSET);
                    STORE_SAME(touched + e, 1);
                    STORE_SAME(touched + j, 1);
                    count += 1;
                }
            }
            SOFT_NUMBER(entry, BOOKED) = given, SOFT_NUMBER(other, BOOKED) = given;
            soft_put(crack, entry, SOFT_PULL, force), soft_put(crack, other, SOFT_PULL, soft_scale(REAL(-1), force));
            const soft_vector last = slides ? (soft_vector){rubs, 0, 0} : uneven;
            soft_put(crack, entry, SOFT_SIDE_PULL, last), soft_put(crack, other, SOFT_SIDE_PULL, last);
        }
        found[e] = (state)count;
    }
}

/* Each element's half of what its open bonds booked, rubbed [n] what broken ones do to each other; bonds whose cohesion
 * ended are broken from then on, though their sides still bear on each other. */
KERNEL void soft_book(int n, int step, OWN(int) row_start, OWN(coeff) alive, OWN(int) n_open, OWN(int) open,
                      OWN(coeff) crack, UPDATE(int) break_step, PUT(int) break_mode, PUT(coeff) break_stress,
                      PUT(coeff) break_energy, UPDATE(state) lost, UPDATE(state) rubbed, UPDATE(state) broken)
{
    FOR_EACH_ITEM(e, n) {
        for (int slot = row_start[e / C]; n_open[e] && slot < row_start[e / C + 1]; ++slot) {
            const brc_size entry = SOFT_ENTRY;
            if (!open[entry] || !(alive[entry] > 0)) continue;
            const int slides = SOFT_IS_SLIDING(entry);
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
    }
}

/* After dlsm_energy: the bonds' energy of J - w in place of that of J, and what the cohesion holds; half to each side
 * [J] [n]. */
KERNEL void soft_energy(int n, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) alive, OWN(int) n_open, OWN(int) open,
                        OWN(coeff) crack, OWN(coeff) area, OWN(coeff) ratio, GATHER(state) displacement,
                        GATHER(coeff) gradient, coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau,
                        GATHER(coeff) modulus, GATHER(coeff) ell_of, UPDATE(state) stabilisation)
{
    FOR_EACH_ITEM(e, n) {
        for (int slot = row_start[e / C]; n_open[e] && slot < row_start[e / C + 1]; ++slot) {
            const brc_size entry = SOFT_ENTRY;
            if (!open[entry] || !(alive[entry] > 0)) continue;
            const int j = neighbour[entry];
            GLOBAL const coeff *a = gradient + (brc_size)e * 9, *b = gradient + (brc_size)j * 9;
            const lane_mat3 h = {LANE_ZERO + a[0], LANE_ZERO + a[1], LANE_ZERO + a[2],
                                 LANE_ZERO + a[3], LANE_ZERO + a[4], LANE_ZERO + a[5],
                                 LANE_ZERO + a[6], LANE_ZERO + a[7], LANE_ZERO + a[8]};
            const lane_mat3 h_j = {LANE_ZERO + b[0], LANE_ZERO + b[1], LANE_ZERO + b[2],
                                   LANE_ZERO + b[3], LANE_ZERO + b[4], LANE_ZERO + b[5],
                                   LANE_ZERO + b[6], LANE_ZERO + b[7], LANE_ZERO + b[8]};
#if BRC_MANY_MATERIALS
            const lane ell = LANE_ZERO + ell_of[e], ell_j = LANE_ZERO + ell_of[j];
#else
            const lane ell = LANE_ZERO + ell_one, ell_j = ell;
#endif
            const lane k = LANE_ZERO + SOFT_BOND_MODULUS(e, j), half_one = LANE_ZERO + REAL(0.5);
            const lane_mat3 mean = lane_mat3_scale(half_one, lane_mat3_add(h, h_j));
            const lane_mat3 compaction =
                lane_mat3_scale(half_one, lane_mat3_add(dlsm_compaction(h, ell, 1), dlsm_compaction(h_j, ell_j, 1)));
            const soft_vector s = soft_area(area, entry), jump = soft_jump(displacement, e, j),
                              elastic = soft_add(jump, REAL(-1), soft_part(crack, entry, SOFT_OPENING));
            const lane_vec3 face = {LANE_ZERO + s.x, LANE_ZERO + s.y, LANE_ZERO + s.z};
            const lane_vec3 with = {LANE_ZERO + jump.x, LANE_ZERO + jump.y, LANE_ZERO + jump.z};
            const lane_vec3 without = {LANE_ZERO + elastic.x, LANE_ZERO + elastic.y, LANE_ZERO + elastic.z};
            const lane q = LANE_ZERO + ratio[entry];
            const lane more = dlsm_bond_energy(with, mean, compaction, face, q, k, beta, one_plus_tau);
            const lane less = dlsm_bond_energy(without, mean, compaction, face, q, k, beta, one_plus_tau);
            stabilisation[e] +=
                STATE(0.5) * (state)(LANE_ITEM(less, 0) - LANE_ITEM(more, 0) + SOFT_NUMBER(entry, HELD));
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
