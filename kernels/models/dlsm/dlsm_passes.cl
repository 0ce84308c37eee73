/* dlsm: its four passes and the ledger's, over all elements or over a list (PASS, kernels.h); laws in dlsm.cl. */

/* Pass 1: least-squares displacement gradient H [-] [n][9]. area [slot][3][C], inv_shape A^-1 [slice][6][C]. */
KERNEL void PASS(dlsm_gradient)(PASS_ITEMS, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) area,
                                GATHER(state) displacement, OWN(coeff) inv_shape, PUT(coeff) gradient)
{
    FOR_EACH_GROUP(item, n_items)
    {
        dlsm_gradient_of(PASS_MEMBERS(item, row_start), neighbour, ahead, area, displacement, inv_shape, gradient);
    }
}

/* Pass 2: first Piola-Kirchhoff stress P [Pa] [n][9]. offset d [slot][3][C]. */
KERNEL void PASS(dlsm_stress)(PASS_ITEMS, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) area,
                              OWN(coeff) offset, GATHER(coeff) gradient, OWN(coeff) inv_volume, OWN(int) boundary,
                              OWN(coeff) held_gradient, int face_loads, coeff lambda_one, coeff mu_one,
                              OWN(coeff) material, int finite, PUT(coeff) stress)
{
    FOR_EACH_GROUP(item, n_items)
    {
        dlsm_stress_of(PASS_MEMBERS(item, row_start), neighbour, ahead, area, offset, gradient, inv_volume, boundary,
                       held_gradient, face_loads, lambda_one, mu_one, material, finite, stress);
    }
}

/* Pass 3: B [Pa] [n][9] and, with many materials, the bond part. */
KERNEL void PASS(dlsm_flux_pass)(PASS_ITEMS, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) area,
                                 OWN(coeff) offset, OWN(coeff) ratio, GATHER(state) displacement,
                                 GATHER(coeff) gradient, GATHER(coeff) stress, OWN(coeff) inv_shape,
                                 OWN(coeff) inv_volume, OWN(int) boundary, OWN(coeff) held_moment, int face_loads,
                                 coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau, OWN(coeff) material,
                                 GATHER(coeff) modulus, GATHER(coeff) ell_of, int finite, PUT(coeff) flux,
                                 PUT(coeff) bond_part)
{
    ASIDE(room, ASIDE_FLUX);
    FOR_EACH_GROUP(item, n_items)
    {
        const members who = PASS_MEMBERS(item, row_start);
        members_later(who, gradient, 9, ahead), members_later(who, stress, 9, ahead);
        members_store9(who, flux,
                       dlsm_flux_of(who, room, neighbour, area, offset, ratio, displacement, gradient, stress,
                                    inv_shape, inv_volume, boundary, held_moment, face_loads, k_one, ell_one, beta,
                                    one_plus_tau, material, modulus, ell_of, finite, bond_part));
    }
}

/* Pass 4: force f [N] [n][3] on every element. */
KERNEL void PASS(dlsm_force)(PASS_ITEMS, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) area,
                             OWN(coeff) ratio, GATHER(state) displacement, GATHER(coeff) flux, GATHER(coeff) bond_part,
                             coeff k_one, coeff one_plus_tau, GATHER(coeff) modulus, PUT(state) force)
{
    FOR_EACH_GROUP(item, n_items)
    {
        dlsm_force_of(PASS_MEMBERS(item, row_start), neighbour, ahead, area, ratio, displacement, flux, bond_part,
                      k_one, one_plus_tau, modulus, force);
    }
}

/* As dlsm_force, which has what it takes at hand: and where some bond of a group has no room (cell_normal.h), look [n /
 * W] is 1; cells_check puts it back to 0. */
KERNEL void PASS(cells_force)(PASS_ITEMS, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) area,
                              OWN(coeff) ratio, GATHER(state) displacement, GATHER(coeff) flux, GATHER(coeff) bond_part,
                              coeff k_one, coeff one_plus_tau, GATHER(coeff) modulus, OWN(coeff) gradient,
                              OWN(coeff) stress, OWN(coeff) plane, OWN(coeff) limit, int finite, PUT(state) force,
                              PUT(int) look)
{
    FOR_EACH_GROUP(item, n_items)
    {
        cells_force_of(PASS_MEMBERS(item, row_start), neighbour, ahead, area, ratio, displacement, flux, bond_part,
                       k_one, one_plus_tau, modulus, gradient, stress, plane, limit, finite, force, look);
    }
}

/* Ledger: elastic energy V psi and half of the stabilisation energy of its bonds, of every element [J] [n]. */
KERNEL void PASS(dlsm_energy)(PASS_ITEMS, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) area, OWN(coeff) offset,
                              OWN(coeff) ratio, GATHER(state) displacement, GATHER(coeff) gradient,
                              OWN(coeff) inv_volume, OWN(int) boundary, OWN(coeff) held_gradient, int face_loads,
                              coeff lambda_one, coeff mu_one, coeff k_one, coeff ell_one, coeff beta,
                              coeff one_plus_tau, OWN(coeff) material, GATHER(coeff) modulus, GATHER(coeff) ell_of,
                              int finite, PUT(state) elastic, PUT(state) stabilisation)
{
    FOR_EACH_GROUP(item, n_items)
    {
        const members who = PASS_MEMBERS(item, row_start);
        members_store1(who, elastic,
                       dlsm_elastic_of(who, neighbour, area, offset, gradient, inv_volume, boundary, held_gradient,
                                       face_loads, lambda_one, mu_one, material, finite));
        members_store1(who, stabilisation,
                       dlsm_bonds_of(who, neighbour, area, ratio, displacement, gradient, k_one, ell_one, beta,
                                     one_plus_tau, material, modulus, ell_of, finite, 0, neighbour));
    }
}
