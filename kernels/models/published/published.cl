/* dlsm-published: the two passes over elements and their bonds (AGH19), that of forces in published_passes.cl.
 * branch R = X_j - X_i [slot][3][C] (missing neighbours: a unit branch home with zero area), area S [slot][C]. */

/* a = sum (u_j - u_i) (x) w R [m^2], times inv_shape. */
LAW lane_mat3 published_fit(members who, OWN(int) neighbour, OWN(coeff) branch, OWN(coeff) area, int area_weights,
                            GATHER(state) displacement, OWN(coeff) inv_shape)
{
    const state_vec3 u = state_gather3(displacement, who.own);
    lane_mat3 a = lane_mat3_zero();
    lane_int next = members_first_neighbour(who, neighbour, 0);
    for (int slot = who.begin; slot < who.end; ++slot) {
        const lane_int j = members_next_neighbour(who, neighbour, slot, 1, &next);
        members_ahead3(who, branch, slot);
        lane_vec3 r = members_row3(who, branch, slot);
        const lane_vec3 jump = state_vec3_difference(state_gather3(displacement, j), u);
        if (area_weights) r = lane_vec3_scale(members_face1(who, area, slot) / LANE_SQRT(lane_vec3_dot(r, r)), r);
        a = lane_add_outer(a, jump, r);
    }
    return lane_mat3_mul_sym(a, members_block6(who, inv_shape));
}

/* Strain of every element in the global frame [-] [n][6] (xx yy zz yz xz xy). inv_shape: (sum w R (x) R)^-1
 * [slice][6][C]; area_weights: w = S/|R| instead of 1; orientation: unit quaternions (w x y z) [n][4]. */
KERNEL void published_strain_pass(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead,
                                  OWN(coeff) branch, OWN(coeff) area, int area_weights, GATHER(state) displacement,
                                  OWN(state) orientation, OWN(coeff) inv_shape, int finite, PUT(coeff) strain)
{
    FOR_EACH_GROUP(group, n_groups)
    {
        const members who = members_of_group(group, row_start);
        members_states_later(who, displacement, 3, ahead);
        const lane_mat3 fitted = published_fit(who, neighbour, branch, area, area_weights, displacement, inv_shape);
        const lane_quat q = lane_gather4(orientation, who.own);
        lane_store6(strain, group * W, finite ? published_strain(fitted, q, 1) : published_strain(fitted, q, 0));
    }
}

/* One bond's part of the force pass; only called with a constant `finite`. */
LAW published_bond published_one_bond(lane_vec3 r, lane_vec3 jump, lane area, lane_sym3 e_i, lane_sym3 e_j,
                                      lane_quat q_i, lane_quat q_j, lane lambda, lane mu, lane young,
                                      coeff rotation_factor, coeff couple, int finite)
{
    const lane_sym3 sum = lane_sym3_add(e_i, e_j);
    const lane_sym3 mean = lane_sym3_scale_shift(LANE_ZERO + REAL(0.5), sum, LANE_ZERO);
    lane_quat turn;
    if (finite)
        turn = quat_mul(q_j, quat_conjugate(q_i));
    else
        turn = (lane_quat){LANE_ZERO, q_j.x - q_i.x, q_j.y - q_i.y, q_j.z - q_i.z};
    const published_bond b = published_bond_law(r, jump, area, mean, quat_rotation_vector(turn, finite), lambda, mu,
                                                young, rotation_factor, finite);
    if (couple == REAL(0)) return b;
    return published_coupled(b, r, jump, couple * mu * area, mean, q_i, q_j, finite);
}

/* Moduli of a bond: the mean of its two ends. lame_of [n][3]: lambda, mu, E of each element; only read with several
 * materials. */
typedef struct {
    lane lambda, mu, young;
} published_moduli;
LAW published_moduli published_moduli_of(lane_int own, lane_int j, coeff lambda_one, coeff mu_one, coeff young_one,
                                         GATHER(coeff) lame_of)
{
#if BRC_MANY_MATERIALS
    const lane_int at = j * 3, at_own = own * 3;
    return (published_moduli){REAL(0.5) * (gather_component(lame_of, at_own) + gather_component(lame_of, at)),
                              REAL(0.5) * (gather_component(lame_of + 1, at_own) + gather_component(lame_of + 1, at)),
                              REAL(0.5) * (gather_component(lame_of + 2, at_own) + gather_component(lame_of + 2, at))};
#else
    return (published_moduli){LANE_ZERO + lambda_one, LANE_ZERO + mu_one, LANE_ZERO + young_one};
#endif
}

/* What elements bring to their bonds. */
typedef struct {
    lane_int row;
    state_vec3 displacement;
    lane_sym3 strain;
    lane_quat orientation;
} published_own;
LAW published_own published_own_of(lane_int own, OWN(state) displacement, OWN(state) orientation, OWN(coeff) strain)
{
    return (published_own){own, state_gather3(displacement, own), lane_gather6(strain, own),
                           lane_gather4(orientation, own)};
}

/* The bonds in one slot of the rows. */
LAW published_bond published_bond_at(members who, int slot, lane_int j, published_own own, OWN(coeff) branch,
                                     OWN(coeff) area, GATHER(state) displacement, GATHER(state) orientation,
                                     GATHER(coeff) strain, coeff lambda_one, coeff mu_one, coeff young_one,
                                     coeff rotation_factor, coeff couple, GATHER(coeff) lame_of, int finite)
{
    members_ahead3(who, branch, slot);
    members_ahead1(who, area, slot);
    const lane_vec3 r = members_row3(who, branch, slot);
    const lane s = members_face1(who, area, slot);
    const lane_vec3 jump = state_vec3_difference(state_gather3(displacement, j), own.displacement);
#if SPLIT_LOOPS
    own.strain = lane_gather6_again(strain, own.row); /* not kept in registers from bond to bond */
#endif
    const lane_sym3 e_j = lane_gather6(strain, j);
    const lane_quat q_j = lane_gather4(orientation, j);
    const published_moduli m = published_moduli_of(own.row, j, lambda_one, mu_one, young_one, lame_of);
    return finite ? published_one_bond(r, jump, s, own.strain, e_j, own.orientation, q_j, m.lambda, m.mu, m.young,
                                       rotation_factor, couple, 1)
                  : published_one_bond(r, jump, s, own.strain, e_j, own.orientation, q_j, m.lambda, m.mu, m.young,
                                       rotation_factor, couple, 0);
}

/* What the bonds of elements do to them [N], [N m], and their largest normal stress over limit [-]; only called with a
 * constant `finite`. */
typedef struct {
    lane_vec3 force, torque;
    lane largest;
} published_sums;
LAW published_sums published_sums_of(members who, OWN(int) neighbour, OWN(coeff) branch, OWN(coeff) area,
                                     GATHER(state) displacement, GATHER(state) orientation, GATHER(coeff) strain,
                                     coeff lambda_one, coeff mu_one, coeff young_one, coeff rotation_factor,
                                     coeff couple, GATHER(coeff) lame_of, OWN(coeff) limit, int finite)
{
    const published_own own = published_own_of(who.own, displacement, orientation, strain);
    const lane zero = LANE_ZERO;
    published_sums sums = {{zero, zero, zero}, {zero, zero, zero}, zero};
    lane_int next = members_first_neighbour(who, neighbour, 0);
    for (int slot = who.begin; slot < who.end; ++slot) {
        const lane_int j = members_next_neighbour(who, neighbour, slot, 1, &next);
        const published_bond b =
            published_bond_at(who, slot, j, own, branch, area, displacement, orientation, strain, lambda_one, mu_one,
                              young_one, rotation_factor, couple, lame_of, finite);
        sums.force = lane_vec3_add(sums.force, b.force);
        sums.torque = lane_vec3_add(sums.torque, b.torque);
        const lane ratio = b.stress / members_row1(who, limit, slot);
        sums.largest = lane_max(sums.largest, who.listed ? members_there(who, slot) * ratio : ratio);
    }
    return sums;
}

/* Strain energy V sigma:e / 2 of the least-squares strain [J] [n]. Not the potential of the forces (there is none). */
LAW state published_energy_of(int e, OWN(coeff) strain, OWN(state) volume, coeff lambda_one, coeff mu_one,
                              OWN(coeff) lame_of)
{
    GLOBAL const coeff *s = strain + (brc_size)e * 6;
#if BRC_MANY_MATERIALS
    const coeff lambda = lame_of[(brc_size)e * 3], mu = lame_of[(brc_size)e * 3 + 1];
#else
    const coeff lambda = lambda_one, mu = mu_one;
#endif
    const coeff trace = s[0] + s[1] + s[2];
    const coeff square = s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + REAL(2) * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
    return volume[e] * (state)(REAL(0.5) * lambda * trace * trace + mu * square);
}

/* R - I of an orientation (finite), or of the rotation vector it stands for: twice its vector part. out [9] by rows. */
LAW void published_turn(OWN(state) orientation, int e, int finite, state out[9])
{
    const state w = finite ? orientation[(brc_size)e * 4] : STATE(1), x = orientation[(brc_size)e * 4 + 1],
                y = orientation[(brc_size)e * 4 + 2], z = orientation[(brc_size)e * 4 + 3],
                square = finite ? STATE(2) : STATE(0);
    out[0] = -square * (y * y + z * z), out[1] = square * x * y - STATE(2) * w * z,
    out[2] = square * x * z + STATE(2) * w * y;
    out[3] = square * x * y + STATE(2) * w * z, out[4] = -square * (x * x + z * z),
    out[5] = square * y * z - STATE(2) * w * x;
    out[6] = square * x * z - STATE(2) * w * y, out[7] = square * y * z + STATE(2) * w * x,
    out[8] = -square * (x * x + y * y);
}

/* Dead tractions of one load on cells that turn: total [N] = sum t S, moment [N m] = sum t S (x) (C - X), at unit
 * factor. f_i += factor total, torque_i += what it turns the cell by, at the arms R (C - X) (small rotations: C - X).
 * total.u + moment:(R - I) is what the traction works on [J]. book, last_path: as in traction_force_pass. */
KERNEL void traction_turned_pass(int n, state factor, OWN(int) element, OWN(coeff) total, OWN(coeff) moment,
                                 OWN(state) displacement, OWN(state) orientation, int finite, int book,
                                 state last_factor, UPDATE(state) force, UPDATE(state) torque, UPDATE(state) last_path,
                                 UPDATE(state) work)
{
    FOR_EACH_ITEM(i, n) {
        const int e = element[i];
        state turn[9], arm[9], sum = 0; /* arm[3 k + j]: sum of the k-th component of t S times the j-th of the arm */
        published_turn(orientation, e, finite, turn);
        for (int k = 0; k < 3; ++k) {
            const state t = (state)total[(brc_size)i * 3 + k];
            force[(brc_size)e * 3 + k] += factor * t;
            sum += t * displacement[(brc_size)e * 3 + k];
            for (int j = 0; j < 3; ++j) {
                state turned = 0;
                for (int l = 0; l < 3; ++l) turned += turn[3 * j + l] * (state)moment[(brc_size)i * 9 + 3 * k + l];
                arm[3 * k + j] = (state)moment[(brc_size)i * 9 + 3 * k + j] + (finite ? turned : STATE(0));
                if (j == k) sum += turned;
            }
        }
        torque[(brc_size)e * 3] += factor * (arm[7] - arm[5]);
        torque[(brc_size)e * 3 + 1] += factor * (arm[2] - arm[6]);
        torque[(brc_size)e * 3 + 2] += factor * (arm[3] - arm[1]);
        if (book == 1) work[i] += STATE(0.5) * (factor + last_factor) * (sum - last_path[i]);
        if (book) last_path[i] = sum;
    }
}
