/* dlsm: the four passes over elements and their bonds (design-dlsm.md section 2). Each gathers, calls the laws, and
 * writes its own elements; nothing is scattered. One work-item does one group of W elements.
 * boundary[slice]: the slice's block of the face-load arrays, -1 when none of its elements has a free face; only read in
 * scenes with face loads. */

/* Material constants of a group: scalars, or gathered from [slice][4][C] (lambda, mu, k, ell). */
#if BRC_MANY_MATERIALS
#define MATERIAL(component, scalar) lane_block(material, slice, 4, component, lane0)
#else
#define MATERIAL(component, scalar) (LANE_ZERO + (scalar))
#endif

/* Pass 1: least-squares displacement gradient H [-] [n][9]. area [slot][3][C], inv_shape A^-1 [slice][6][C]. */
KERNEL void dlsm_gradient(int n_groups, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                          GLOBAL const coeff *restrict area, GLOBAL const state *restrict displacement,
                          GLOBAL const coeff *restrict inv_shape, GLOBAL coeff *restrict gradient)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
        const state_vec3 u = state_gather3(displacement, lane_own(first));
        lane_mat3 a = lane_mat3_zero();
        for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
            const lane_int j = int_block(neighbour, slot, lane0);
            rows_ahead3(area, slot);
            a = dlsm_add_jump(a, state_vec3_difference(state_gather3(displacement, j), u), lane_block3(area, slot, lane0));
        }
        lane_store9(gradient, first, lane_mat3_mul_sym(a, lane_block6(inv_shape, slice, lane0)));
    }
}

/* G = F - I [-] of a group, from H and, where faces are held, from their part [boundary block][9][C] of V G. */
LAW lane_mat3 dlsm_group_deformation(int group, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                                     GLOBAL const coeff *restrict area, GLOBAL const coeff *restrict offset,
                                     GLOBAL const coeff *restrict gradient, GLOBAL const coeff *restrict inv_volume,
                                     GLOBAL const int *restrict boundary, GLOBAL const coeff *restrict held_gradient,
                                     int face_loads)
{
    const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
    const lane_mat3 h = lane_gather9(gradient, lane_own(first));
    lane_mat3 sum = lane_mat3_zero();
    for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
        const lane_int j = int_block(neighbour, slot, lane0);
        rows_ahead3(area, slot);
        rows_ahead3(offset, slot);
        gathers_ahead9(gradient, neighbour, slot, row_start[slice + 1], lane0);
        sum = dlsm_add_offset(sum, lane_mat3_sub(lane_gather9(gradient, j), h), lane_block3(offset, slot, lane0),
                              lane_block3(area, slot, lane0));
    }
    const lane inv_v = lane_load(inv_volume, (brc_size)first);
    lane_mat3 g = dlsm_divergence_gradient(h, sum, inv_v);
    if (face_loads && boundary[slice] >= 0)
        g = lane_mat3_add(g, lane_mat3_scale(inv_v, lane_block9(held_gradient, boundary[slice], lane0)));
    return g;
}

LAW lane_mat3 dlsm_first_piola(lane_mat3 g, lane lambda, lane mu, int finite)
{
    return push_forward(g, svk_stress(green_strain(g, finite), lambda, mu), finite);
}

/* Pass 2: first Piola-Kirchhoff stress P [Pa] [n][9]. offset d [slot][3][C]. */
KERNEL void dlsm_stress(int n_groups, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                        GLOBAL const coeff *restrict area, GLOBAL const coeff *restrict offset,
                        GLOBAL const coeff *restrict gradient, GLOBAL const coeff *restrict inv_volume, GLOBAL const int *restrict boundary,
                        GLOBAL const coeff *restrict held_gradient, int face_loads, coeff lambda_one, coeff mu_one,
                        GLOBAL const coeff *restrict material, int finite, GLOBAL coeff *restrict stress)
{
    FOR_EACH_ITEM(group, n_groups) {
        const lane_mat3 g = dlsm_group_deformation(group, row_start, neighbour, area, offset, gradient, inv_volume,
                                                   boundary, held_gradient, face_loads);
#if BRC_MANY_MATERIALS
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group);
#endif
        const lane lambda = MATERIAL(0, lambda_one), mu = MATERIAL(1, mu_one);
        lane_store9(stress, group * W, finite ? dlsm_first_piola(g, lambda, mu, 1) : dlsm_first_piola(g, lambda, mu, 0));
    }
}

/* Bonds of pass 3. */
LAW dlsm_flux_sums dlsm_group_flux_sums(int group, GLOBAL const int *restrict row_start,
                                        GLOBAL const int *restrict neighbour, GLOBAL const coeff *restrict area,
                                        GLOBAL const coeff *restrict offset, GLOBAL const coeff *restrict ratio,
                                        GLOBAL const state *restrict displacement, GLOBAL const coeff *restrict gradient,
                                        GLOBAL const coeff *restrict stress, GLOBAL const coeff *restrict modulus,
                                        GLOBAL const coeff *restrict ell_of,
                                        lane_mat3 h, lane_mat3 p, lane_mat3 m, lane k, coeff ell_one, int finite)
{
    const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group);
    dlsm_flux_sums sums = {lane_mat3_zero(), lane_mat3_zero(), lane_mat3_zero()};
#if BRC_MANY_MATERIALS
    const state_vec3 u = state_gather3(displacement, lane_own(group * W));
#endif
    for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
        const lane_int j = int_block(neighbour, slot, lane0);
        rows_ahead3(area, slot);
        rows_ahead3(offset, slot);
        rows_ahead1(ratio, slot);
        gathers_ahead9(gradient, neighbour, slot, row_start[slice + 1], lane0);
        gathers_ahead9(stress, neighbour, slot, row_start[slice + 1], lane0);
        const lane_vec3 s = lane_block3(area, slot, lane0);
        const lane q = lane_load(ratio, (brc_size)slot * C + (brc_size)lane0);
        const lane_mat3 h_j = lane_gather9(gradient, j);
        const lane_vec3 x = lane_vec3_scale(REAL(0.5) * q, s); /* R / 2 [m] */
        const lane_vec3 h_x = lane_mat3_mul_vec(h, x), h_j_x = lane_mat3_mul_vec(h_j, x), m_x = lane_mat3_mul_vec(m, x);
#if BRC_MANY_MATERIALS
        const lane weight = lane_min(gather_component(modulus, j), k) / k;
        const lane_vec3 jump = state_vec3_difference(state_gather3(displacement, j), u);
        const lane_vec3 r = lane_vec3_scale(weight, lane_vec3_sub(jump, lane_vec3_add(h_x, h_j_x)));
        const lane_vec3 m_j_x = dlsm_compaction_along(h_j, h_j_x, x, gather_component(ell_of, j), finite);
        const lane_vec3 mr = lane_vec3_scale(weight, lane_vec3_add(m_x, m_j_x));
#else
        const lane_vec3 r = lane_vec3_sub(h_x, h_j_x);
        const lane_vec3 mr = lane_vec3_add(m_x, dlsm_compaction_along(h_j, h_j_x, x, LANE_ZERO + ell_one, finite));
#endif
        sums = dlsm_flux_add_bond(sums, r, mr, lane_mat3_add(p, lane_gather9(stress, j)), s, lane_block3(offset, slot, lane0));
    }
    return sums;
}

/* Pass 3: B [Pa] [n][9]; with many materials the bond part [beta/(1 + tau) M - H]/2 apart. ratio q = L/S [slot][C];
 * held_moment [block][9][C]: what held faces and tractions add to Q. */
KERNEL void dlsm_flux_pass(int n_groups, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                           GLOBAL const coeff *restrict area, GLOBAL const coeff *restrict offset,
                           GLOBAL const coeff *restrict ratio, GLOBAL const state *restrict displacement,
                           GLOBAL const coeff *restrict gradient, GLOBAL const coeff *restrict stress,
                           GLOBAL const coeff *restrict inv_shape, GLOBAL const coeff *restrict inv_volume,
                           GLOBAL const int *restrict boundary, GLOBAL const coeff *restrict held_moment, int face_loads,
                           coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau,
                           GLOBAL const coeff *restrict material, GLOBAL const coeff *restrict modulus,
                           GLOBAL const coeff *restrict ell_of, int finite, GLOBAL coeff *restrict flux,
                           GLOBAL coeff *restrict bond_part)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
        const lane_int own = lane_own(first);
        const lane_mat3 h = lane_gather9(gradient, own), p = lane_gather9(stress, own);
        const lane k = MATERIAL(2, k_one), ell = MATERIAL(3, ell_one);
        const lane volume = REAL(1) / lane_load(inv_volume, (brc_size)first);
        lane_mat3 m, moment;
        dlsm_flux_sums sums;
        if (finite) {
            m = dlsm_compaction(h, ell, 1);
            sums = dlsm_group_flux_sums(group, row_start, neighbour, area, offset, ratio, displacement, gradient, stress,
                                        modulus, ell_of, h, p, m, k, ell_one, 1);
            moment = dlsm_flux_moment(h, p, volume, sums, k, beta, one_plus_tau, ell, 1);
        } else {
            m = dlsm_compaction(h, ell, 0);
            sums = dlsm_group_flux_sums(group, row_start, neighbour, area, offset, ratio, displacement, gradient, stress,
                                        modulus, ell_of, h, p, m, k, ell_one, 0);
            moment = dlsm_flux_moment(h, p, volume, sums, k, beta, one_plus_tau, ell, 0);
        }
        if (face_loads && boundary[slice] >= 0)
            moment = lane_mat3_add(moment, lane_block9(held_moment, boundary[slice], lane0));
        const lane_mat3 b = lane_mat3_mul_sym(moment, lane_block6(inv_shape, slice, lane0));
        const lane_mat3 part = dlsm_flux_bond_part(h, m, beta, one_plus_tau);
#if BRC_MANY_MATERIALS
        lane_store9(flux, first, b);
        lane_store9(bond_part, first, part);
#else
        lane_store9(flux, first, lane_mat3_add(b, lane_mat3_scale(k * one_plus_tau, part)));
#endif
    }
}

/* Pass 4: force f [N] [n][3] on every element. */
KERNEL void dlsm_force(int n_groups, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                       GLOBAL const coeff *restrict area, GLOBAL const coeff *restrict ratio,
                       GLOBAL const state *restrict displacement, GLOBAL const coeff *restrict flux,
                       GLOBAL const coeff *restrict bond_part, coeff k_one, coeff one_plus_tau,
                       GLOBAL const coeff *restrict modulus, GLOBAL state *restrict force)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
        const lane_int own = lane_own(first);
        const state_vec3 u = state_gather3(displacement, own);
        const lane_mat3 b = lane_gather9(flux, own);
#if BRC_MANY_MATERIALS
        const lane_mat3 part = lane_gather9(bond_part, own);
        const lane k = lane_load(modulus, (brc_size)first);
#else
        const lane spring = LANE_ZERO + k_one * one_plus_tau;
#endif
        lane_vec3 f = {LANE_ZERO, LANE_ZERO, LANE_ZERO};
        for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
            const lane_int j = int_block(neighbour, slot, lane0);
            rows_ahead3(area, slot);
            rows_ahead1(ratio, slot);
            gathers_ahead9(flux, neighbour, slot, row_start[slice + 1], lane0);
            const lane_vec3 jump = state_vec3_difference(state_gather3(displacement, j), u);
            lane_mat3 sum = lane_mat3_add(b, lane_gather9(flux, j));
#if BRC_MANY_MATERIALS
            const lane k_bond = lane_min(gather_component(modulus, j), k);
            const lane spring = k_bond * one_plus_tau;
            sum = lane_mat3_add(sum, lane_mat3_scale(spring, lane_mat3_add(part, lane_gather9(bond_part, j))));
#endif
            f = lane_vec3_add(f, dlsm_bond_force(sum, lane_block3(area, slot, lane0), spring,
                                                 lane_load(ratio, (brc_size)slot * C + (brc_size)lane0), jump));
        }
        state_store3(force, first, f);
    }
}

/* Ledger: elastic energy V psi and half of the stabilisation energy of its bonds, of every element [J] [n]. */
KERNEL void dlsm_energy(int n_groups, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                        GLOBAL const coeff *restrict area, GLOBAL const coeff *restrict offset,
                        GLOBAL const coeff *restrict ratio, GLOBAL const state *restrict displacement,
                        GLOBAL const coeff *restrict gradient, GLOBAL const coeff *restrict inv_volume, GLOBAL const int *restrict boundary,
                        GLOBAL const coeff *restrict held_gradient, int face_loads, coeff lambda_one, coeff mu_one,
                        coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau, GLOBAL const coeff *restrict material,
                        GLOBAL const coeff *restrict modulus, GLOBAL const coeff *restrict ell_of, int finite,
                        GLOBAL state *restrict elastic, GLOBAL state *restrict stabilisation)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
        const lane_mat3 g = dlsm_group_deformation(group, row_start, neighbour, area, offset, gradient, inv_volume,
                                                   boundary, held_gradient, face_loads);
        const lane lambda = MATERIAL(0, lambda_one), mu = MATERIAL(1, mu_one);
        const lane k = MATERIAL(2, k_one), ell = MATERIAL(3, ell_one);
        const lane_mat3 h = lane_gather9(gradient, lane_own(first)), m = dlsm_compaction(h, ell, finite);
        const state_vec3 u = state_gather3(displacement, lane_own(first));
        lane energy = LANE_ZERO;
        for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
            const lane_int j = int_block(neighbour, slot, lane0);
            const lane_mat3 h_j = lane_gather9(gradient, j);
#if BRC_MANY_MATERIALS
            const lane k_bond = lane_min(gather_component(modulus, j), k), ell_j = gather_component(ell_of, j);
#else
            const lane k_bond = k, ell_j = ell;
#endif
            const lane_mat3 m_j = dlsm_compaction(h_j, ell_j, finite);
            const lane one_half = LANE_ZERO + REAL(0.5);
            energy += REAL(0.5) * dlsm_bond_energy(state_vec3_difference(state_gather3(displacement, j), u),
                                                   lane_mat3_scale(one_half, lane_mat3_add(h, h_j)),
                                                   lane_mat3_scale(one_half, lane_mat3_add(m, m_j)),
                                                   lane_block3(area, slot, lane0),
                                                   lane_load(ratio, (brc_size)slot * C + (brc_size)lane0), k_bond, beta,
                                                   one_plus_tau);
        }
        state_store1(elastic, first, svk_energy(green_strain(g, finite), lambda, mu) / lane_load(inv_volume, (brc_size)first));
        state_store1(stabilisation, first, energy);
    }
}

/* Output: G = F - I [-] [n][9]. */
KERNEL void dlsm_deformation(int n_groups, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                             GLOBAL const coeff *restrict area, GLOBAL const coeff *restrict offset,
                             GLOBAL const coeff *restrict gradient, GLOBAL const coeff *restrict inv_volume, GLOBAL const int *restrict boundary,
                             GLOBAL const coeff *restrict held_gradient, int face_loads, GLOBAL coeff *restrict deformation)
{
    FOR_EACH_ITEM(group, n_groups) {
        lane_store9(deformation, group * W,
                    dlsm_group_deformation(group, row_start, neighbour, area, offset, gradient, inv_volume, boundary,
                                           held_gradient, face_loads));
    }
}
#undef MATERIAL
