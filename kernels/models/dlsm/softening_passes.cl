/* Cells with open faces take the part of the openings back out of their sums (softening.cl), over all elements or over
 * a list (PASS, kernels.h). Entries that are no open faces have no opening. */

/* Takes the openings out of H: sum of (w + v) (x) A^-1 s. */
KERNEL void PASS(soft_gradient)(PASS_ITEMS, OWN(int) row_start, OWN(coeff) alive, OWN(int) n_open, OWN(int) open,
                                OWN(coeff) opening, OWN(coeff) edge_opening, OWN(coeff) area, OWN(coeff) inv_shape,
                                UPDATE(coeff) gradient)
{
    FOR_EACH_ITEM(item, n_items) {
        const members who = PASS_MEMBERS(item, row_start);
        if (soft_has_open(who, n_open)) {
            const lane_sym3 inverse = members_block6(who, inv_shape);
            lane_mat3 h = lane_gather9_alone(gradient, who.own);
            for (int slot = who.begin; slot < who.end; ++slot) {
                if (!soft_slot_open(who, open, slot)) continue;
                const lane holds = members_row1(who, alive, slot);
                const lane_vec3 w = lane_vec3_add(members_row3(who, opening, slot),
                                                  members_row3(who, edge_opening, slot)),
                                a = lane_sym3_mul_vec(inverse, members_face3(who, area, slot));
                h = soft_less_outer(h, lane_vec3_scale(holds, w), a);
            }
            members_store9(who, gradient, h);
        }
    }
}

/* Takes them out of B, whose sum of r (x) s is that of J - w. With several materials it reads J. With one it reads
 * gradients alone, which are those of J - w - v: v comes back in. */
KERNEL void PASS(soft_flux)(PASS_ITEMS, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) alive, OWN(int) n_open,
                            OWN(int) open, OWN(coeff) opening, OWN(coeff) edge_opening, OWN(coeff) area,
                            OWN(coeff) inv_shape, OWN(coeff) gradient, coeff k_one, coeff ell_one,
                            GATHER(coeff) modulus, OWN(coeff) ell_of, coeff beta, coeff one_plus_tau,
                            UPDATE(coeff) flux)
{
    FOR_EACH_ITEM(item, n_items) {
        const members who = PASS_MEMBERS(item, row_start);
        if (soft_has_open(who, n_open)) {
            lane_mat3 rs = lane_mat3_zero(); /* k sum c w (x) s [N m] */
            for (int slot = who.begin; slot < who.end; ++slot) {
                if (!soft_slot_open(who, open, slot)) continue;
                const lane holds = members_row1(who, alive, slot);
#if BRC_MANY_MATERIALS
                const lane_vec3 w = lane_vec3_scale(soft_bond_modulus(who, neighbour, modulus, k_one, slot),
                                                    members_row3(who, opening, slot));
#else
                const lane_vec3 w = lane_vec3_scale(LANE_ZERO - k_one, members_row3(who, edge_opening, slot));
#endif
                rs = lane_add_outer(rs, lane_vec3_scale(holds, w), members_face3(who, area, slot));
            }
            const lane_mat3 own = lane_gather9(gradient, who.own);
            const lane half_tau = LANE_ZERO + REAL(0.5) * one_plus_tau, half_beta = LANE_ZERO + REAL(0.5) * beta;
#if BRC_MANY_MATERIALS
            const lane ell = members_number(who, ell_of);
#else
            const lane ell = LANE_ZERO + ell_one;
#endif
            const lane_mat3 q = lane_mat3_sub(lane_mat3_scale(half_tau, rs),
                                              dlsm_compaction_adjoint(own, lane_mat3_scale(half_beta, rs), ell, 1));
            const lane_mat3 more = lane_mat3_mul_sym(q, members_block6(who, inv_shape));
            members_store9(who, flux, lane_mat3_add(lane_gather9_alone(flux, who.own), more));
        }
    }
}
