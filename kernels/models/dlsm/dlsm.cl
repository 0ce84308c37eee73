/* dlsm: what the four passes over elements and their bonds (dlsm_passes.cl; docs/notebook/theory.md T2) are made of.
 * Each gathers, calls the laws, and writes its own elements; nothing is scattered. One work-item does W elements: a
 * group of all, or in the kernels named `listed` those of a list (members.cl). boundary[slice]: the slice's block of
 * the face-load arrays, -1 when none of its elements has a free face; only read in scenes with face loads. */

/* What the rows of a slot say of the bonds in it: neighbour, area s [m^2], offset d [m], ratio q = L/S [1/m]; the last
 * two where a pass reads them (with). */
typedef struct {
    lane_int j;
    lane_vec3 area, offset;
    lane ratio;
} dlsm_row;
enum { DLSM_OFFSET = 1, DLSM_RATIO = 2 };
LAW dlsm_row dlsm_row_of(members who, lane_int j, int slot, OWN(coeff) area, OWN(coeff) more, int with)
{
    dlsm_row row = {j, members_face3(who, area, slot), {LANE_ZERO, LANE_ZERO, LANE_ZERO}, LANE_ZERO};
    members_ahead3(who, area, slot);
    if (with == DLSM_OFFSET) members_ahead3(who, more, slot), row.offset = members_row3(who, more, slot);
    if (with == DLSM_RATIO) members_ahead1(who, more, slot), row.ratio = members_row1(who, more, slot);
    return row;
}
LAW dlsm_row dlsm_row_at(members who, int slot, OWN(int) neighbour, OWN(coeff) area, OWN(coeff) more, int with)
{
    return dlsm_row_of(who, members_neighbour(who, neighbour, slot), slot, area, more, with);
}
/* A GPU asks for the rows of the next slot before it waits for what this one gathers. */
LAW dlsm_row dlsm_first_row(members who, OWN(int) neighbour, OWN(coeff) area, OWN(coeff) more, int with)
{
    if (SPLIT_LOOPS && who.begin < who.end) return dlsm_row_at(who, who.begin, neighbour, area, more, with);
    return (dlsm_row){who.own, {LANE_ZERO, LANE_ZERO, LANE_ZERO}, {LANE_ZERO, LANE_ZERO, LANE_ZERO}, LANE_ZERO};
}
LAW dlsm_row dlsm_next_row(members who, int slot, dlsm_row *ahead, OWN(int) neighbour, OWN(coeff) area, OWN(coeff) more,
                           int with)
{
    if (!SPLIT_LOOPS) return dlsm_row_at(who, slot, neighbour, area, more, with);
    const dlsm_row row = *ahead;
    *ahead = dlsm_row_at(who, slot + 1 < who.end ? slot + 1 : slot, neighbour, area, more, with);
    return row;
}
/* In loops of several turns only neighbours are asked for ahead. Behind the last slot the last: those turns are left
 * out. */
LAW dlsm_row dlsm_turn_row(members who, int slot, lane_int *next, OWN(int) neighbour, OWN(coeff) area, OWN(coeff) more,
                           int with)
{
    const lane_int j = members_next_neighbour(who, neighbour, slot, TURNS, next);
    return dlsm_row_of(who, j, TURNS > 1 ? members_slot(who, slot) : slot, area, more, with);
}

/* G = F - I [-], from H and, where faces are held, from their part [boundary block][9][C] of V G. */
LAW lane_mat3 dlsm_deformation_of(members who, OWN(int) neighbour, OWN(coeff) area, OWN(coeff) offset,
                                  GATHER(coeff) gradient, OWN(coeff) inv_volume, OWN(int) boundary,
                                  OWN(coeff) held_gradient, int face_loads)
{
    const lane_mat3 h = lane_gather9(gradient, who.own);
    lane_mat3 sum = lane_mat3_zero();
    lane_int next[TURNS];
    EACH_TURN(k) next[k] = members_first_neighbour(who, neighbour, k);
    for (int slot = who.begin; slot < who.end; slot += TURNS) {
        dlsm_row row[TURNS];
        lane_mat3 there[TURNS];
        EACH_TURN(k)
        row[k] = dlsm_turn_row(who, slot + k, &next[k], neighbour, area, offset, DLSM_OFFSET);
        EACH_TURN(k) there[k] = lane_gather9(gradient, row[k].j);
        EACH_TURN(k)
        if (!k || slot + k < who.end)
            sum = dlsm_add_offset(sum, lane_mat3_sub(there[k], h), row[k].offset, row[k].area);
    }
    const lane inv_v = members_number(who, inv_volume);
    const lane_mat3 g = dlsm_divergence_gradient(h, sum, inv_v);
    return face_loads ? members_add_boundary(who, g, inv_v, boundary, held_gradient) : g;
}

LAW lane_mat3 dlsm_first_piola(lane_mat3 g, lane lambda, lane mu, int finite)
{
    return push_forward(g, svk_stress(green_strain(g, finite), lambda, mu), finite);
}

/* What pass 3 puts aside (portable.h): M and H of the element, and V P - q. */
enum { ASIDE_M = 0, ASIDE_OWN = 9, ASIDE_H = 18, ASIDE_FLUX = 27 };

/* What the bond in one slot adds in pass 3: to the sums of gradients ... */
LAW dlsm_flux_sums dlsm_flux_gradients_at(aside room, dlsm_row row, dlsm_flux_sums sums, GATHER(state) displacement,
                                          lane_mat3 h_j, GATHER(coeff) modulus, GATHER(coeff) ell_of, state_vec3 u,
                                          lane_mat3 h, lane_mat3 m, lane k, coeff ell_one, int finite, int plain)
{
    const lane_vec3 s = row.area;
    const lane_vec3 x = lane_vec3_scale(REAL(0.5) * row.ratio, s); /* R / 2 [m] */
    const lane_vec3 h_x = lane_mat3_mul_vec(aside_get9(room, ASIDE_H, h), x), h_j_x = lane_mat3_mul_vec(h_j, x),
                    m_x = lane_mat3_mul_vec(aside_get9(room, ASIDE_M, m), x);
#if BRC_MANY_MATERIALS
    const lane weight = lane_min(gather_component(modulus, row.j), k) / k;
    const lane_vec3 jump = state_vec3_difference(state_gather3(displacement, row.j), u);
    const lane_vec3 r = lane_vec3_scale(weight, lane_vec3_sub(jump, lane_vec3_add(h_x, h_j_x)));
    const lane_vec3 m_j_x = dlsm_compaction_along(h_j, h_j_x, x, gather_component(ell_of, row.j), finite);
    const lane_vec3 mr = lane_vec3_scale(weight, lane_vec3_add(m_x, m_j_x));
#else
    const lane_vec3 r = lane_vec3_sub(h_x, h_j_x);
    const lane_vec3 m_j_x = plain ? dlsm_compaction_along_plain(h_j, h_j_x, x, finite)
                                  : dlsm_compaction_along(h_j, h_j_x, x, LANE_ZERO + ell_one, finite);
    const lane_vec3 mr = lane_vec3_add(m_x, m_j_x);
#endif
    return dlsm_flux_add_bond(sums, r, mr, s);
}
/* ... and to that of stresses; k: of the element. */
LAW dlsm_flux_sums dlsm_flux_stress_at(dlsm_flux_sums sums, lane_vec3 area, lane_vec3 offset, lane_mat3 p_j,
                                       lane_mat3 p, lane_int j, lane k, GATHER(coeff) modulus)
{
#if BRC_MANY_MATERIALS
    p_j = lane_mat3_scale(k / gather_component(modulus, j), p_j);
#endif
    return dlsm_flux_add_stress(sums, lane_mat3_add(p, p_j), area, offset);
}

/* Bonds of pass 3: those of gradients, and those of stresses in the same loop where rows are read once (SPLIT_LOOPS).
 * Each sum is its own, so that it has the same bits either way. */
LAW dlsm_flux_sums dlsm_flux_sums_of(members who, aside room, OWN(int) neighbour, OWN(coeff) area, OWN(coeff) offset,
                                     OWN(coeff) ratio, GATHER(state) displacement, GATHER(coeff) gradient,
                                     GATHER(coeff) stress, GATHER(coeff) modulus, GATHER(coeff) ell_of, lane_mat3 h,
                                     lane_mat3 p, lane_mat3 m, lane k, coeff ell_one, int finite, int plain)
{
    dlsm_flux_sums sums = {lane_mat3_zero(), lane_mat3_zero(), lane_mat3_zero()};
    const state_vec3 u = state_gather3(displacement, who.own); /* counts with many materials alone */
    lane_int next[TURNS];
    EACH_TURN(t) next[t] = members_first_neighbour(who, neighbour, t);
    for (int slot = who.begin; slot < who.end; slot += TURNS) {
        dlsm_row row[TURNS];
        lane_mat3 there[TURNS];
        EACH_TURN(t) row[t] = dlsm_turn_row(who, slot + t, &next[t], neighbour, area, ratio, DLSM_RATIO);
        EACH_TURN(t) there[t] = lane_gather9(gradient, row[t].j);
        EACH_TURN(t)
        if (!t || slot + t < who.end) {
            sums = dlsm_flux_gradients_at(room, row[t], sums, displacement, there[t], modulus, ell_of, u, h, m, k,
                                          ell_one, finite, plain);
            if (!SPLIT_LOOPS) {
                members_ahead3(who, offset, slot);
                sums = dlsm_flux_stress_at(sums, row[t].area, members_row3(who, offset, slot),
                                           lane_gather9(stress, row[t].j), p, row[t].j, k, modulus);
            }
        }
    }
    return sums;
}

/* V P - q [N m] in a loop of its own. */
LAW lane_mat3 dlsm_flux_own_of(members who, OWN(int) neighbour, OWN(coeff) area, OWN(coeff) offset,
                               GATHER(coeff) stress, OWN(coeff) inv_volume, lane k, GATHER(coeff) modulus)
{
    dlsm_flux_sums sums = {lane_mat3_zero(), lane_mat3_zero(), lane_mat3_zero()};
    const lane_mat3 p = lane_gather9(stress, who.own);
    lane_int next[TURNS];
    EACH_TURN(t) next[t] = members_first_neighbour(who, neighbour, t);
    for (int slot = who.begin; slot < who.end; slot += TURNS) {
        dlsm_row row[TURNS];
        lane_mat3 there[TURNS];
        EACH_TURN(t)
        row[t] = dlsm_turn_row(who, slot + t, &next[t], neighbour, area, offset, DLSM_OFFSET);
        EACH_TURN(t) there[t] = lane_gather9(stress, row[t].j);
        EACH_TURN(t)
        if (!t || slot + t < who.end)
            sums = dlsm_flux_stress_at(sums, row[t].area, row[t].offset, there[t], p, row[t].j, k, modulus);
    }
    return dlsm_flux_own(p, REAL(1) / members_number(who, inv_volume), sums.q);
}

/* Pass 3: B [Pa] [n][9]; with many materials the bond part [beta/(1 + tau) M - H]/2 apart. ratio q = L/S [slot][C];
 * held_moment [block][9][C]: what held faces and tractions add to Q. One loop leaves out the terms of ell, 0 for nu >=
 * 0 (one material). Where loops are split, that of gradients holds its two sums alone: H, M and V P - q are aside, and
 * what the strain of H is made of is not kept for what follows it. */
LAW lane_mat3 dlsm_flux_of(members who, aside room, OWN(int) neighbour, OWN(coeff) area, OWN(coeff) offset,
                           OWN(coeff) ratio, GATHER(state) displacement, GATHER(coeff) gradient, GATHER(coeff) stress,
                           OWN(coeff) inv_shape, OWN(coeff) inv_volume, OWN(int) boundary, OWN(coeff) held_moment,
                           int face_loads, coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau,
                           OWN(coeff) material, GATHER(coeff) modulus, GATHER(coeff) ell_of, int finite,
                           PUT(coeff) bond_part)
{
    const lane k = MEMBERS_MATERIAL(2, k_one), ell = MEMBERS_MATERIAL(3, ell_one);
    if (SPLIT_LOOPS)
        aside_put9(room, ASIDE_OWN, dlsm_flux_own_of(who, neighbour, area, offset, stress, inv_volume, k, modulus));
    lane_mat3 h = lane_gather9(gradient, who.own), m;
    const lane_mat3 p = SPLIT_LOOPS ? lane_mat3_zero() : lane_gather9(stress, who.own);
    dlsm_flux_sums sums;
    dlsm_flux_couples couples;
#define SUMS(finite, plain)                                                                                            \
    m = dlsm_compaction(h, ell, finite), aside_put9(room, ASIDE_M, m), aside_put9(room, ASIDE_H, h),                   \
    sums = dlsm_flux_sums_of(who, room, neighbour, area, offset, ratio, displacement, gradient, stress, modulus,       \
                             ell_of, h, p, m, k, ell_one, finite, plain),                                              \
    h = SPLIT_LOOPS ? lane_gather9_again(gradient, who.own) : h,                                                       \
    couples = dlsm_flux_couple(h, sums, k, beta, one_plus_tau, ell, finite)
    if (!finite)
        SUMS(0, 0);
    else if (!BRC_MANY_MATERIALS && ell_one == 0)
        SUMS(1, 1);
    else
        SUMS(1, 0);
#undef SUMS
    lane_mat3 own = lane_mat3_zero();
    if (!SPLIT_LOOPS) own = dlsm_flux_own(p, REAL(1) / members_number(who, inv_volume), sums.q);
    lane_mat3 moment = dlsm_flux_moment(aside_get9(room, ASIDE_OWN, own), couples);
    if (face_loads) moment = members_add_boundary(who, moment, LANE_ZERO + REAL(1), boundary, held_moment);
    const lane_mat3 b = lane_mat3_mul_sym(moment, members_block6(who, inv_shape));
    if (SPLIT_LOOPS) h = lane_gather9_again(gradient, who.own);
    const lane_mat3 part = dlsm_flux_bond_part(h, aside_get9(room, ASIDE_M, m), beta, one_plus_tau);
#if BRC_MANY_MATERIALS
    members_store9(who, bond_part, part);
    return b;
#else
    (void)bond_part;
    return lane_mat3_add(b, lane_mat3_scale(k * one_plus_tau, part));
#endif
}

/* Pass 3 of all elements by the linear law; the general one is in dlsm_passes.cl. A GPU gives a kernel the registers of
 * its longest loop, and this one is shorter. */
KERNEL void dlsm_flux_linear(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) area,
                             OWN(coeff) offset, OWN(coeff) ratio, GATHER(state) displacement, GATHER(coeff) gradient,
                             GATHER(coeff) stress, OWN(coeff) inv_shape, OWN(coeff) inv_volume, OWN(int) boundary,
                             OWN(coeff) held_moment, int face_loads, coeff k_one, coeff ell_one, coeff beta,
                             coeff one_plus_tau, OWN(coeff) material, GATHER(coeff) modulus, GATHER(coeff) ell_of,
                             PUT(coeff) flux, PUT(coeff) bond_part)
{
    ASIDE(room, ASIDE_FLUX);
    FOR_EACH_ITEM(group, n_groups) {
        const members who = members_of_group(group, row_start);
        members_later(who, gradient, 9, ahead), members_later(who, stress, 9, ahead);
        members_store9(who, flux,
                       dlsm_flux_of(who, room, neighbour, area, offset, ratio, displacement, gradient, stress,
                                    inv_shape, inv_volume, boundary, held_moment, face_loads, k_one, ell_one, beta,
                                    one_plus_tau, material, modulus, ell_of, 0, bond_part));
    }
}

/* What pass 4 knows of its own elements, and of one bond. */
typedef struct {
    state_vec3 u;
    lane_mat3 b, part; /* part, k: with many materials */
    lane k, spring;
} dlsm_end;
typedef struct {
    lane_vec3 force, jump, area; /* [N], u_j - u_i [m], s [m^2] */
    lane ratio;
} dlsm_pull;

LAW dlsm_end dlsm_end_of(members who, OWN(state) displacement, OWN(coeff) flux, OWN(coeff) bond_part, coeff k_one,
                         coeff one_plus_tau, OWN(coeff) modulus)
{
    const state_vec3 u = state_gather3(displacement, who.own);
    const lane_mat3 b = lane_gather9(flux, who.own);
#if BRC_MANY_MATERIALS
    const lane_mat3 part = lane_gather9(bond_part, who.own);
    return (dlsm_end){u, b, part, members_number(who, modulus), LANE_ZERO};
#else
    return (dlsm_end){u, b, b, LANE_ZERO, LANE_ZERO + k_one * one_plus_tau};
#endif
}
LAW dlsm_pull dlsm_pull_at(dlsm_row row, dlsm_end own, GATHER(state) displacement, GATHER(coeff) flux,
                           GATHER(coeff) bond_part, coeff one_plus_tau, GATHER(coeff) modulus)
{
    const lane_int j = row.j;
    const lane_vec3 jump = state_vec3_difference(state_gather3(displacement, j), own.u);
    lane_mat3 sum = lane_mat3_add(own.b, lane_gather9(flux, j));
#if BRC_MANY_MATERIALS
    const lane spring = lane_min(gather_component(modulus, j), own.k) * one_plus_tau;
    sum = lane_mat3_add(sum, lane_mat3_scale(spring, lane_mat3_add(own.part, lane_gather9(bond_part, j))));
#else
    const lane spring = own.spring;
#endif
    return (dlsm_pull){dlsm_bond_force(sum, row.area, spring, row.ratio, jump), jump, row.area, row.ratio};
}

/* V psi [J] of the elements: of G, ... */
LAW lane dlsm_elastic_energy(members who, lane_mat3 g, lane lambda, lane mu, int finite, OWN(coeff) inv_volume)
{
    return svk_energy(green_strain(g, finite), lambda, mu) / members_number(who, inv_volume);
}
/* ... and of H. */
LAW lane dlsm_elastic_of(members who, OWN(int) neighbour, OWN(coeff) area, OWN(coeff) offset, GATHER(coeff) gradient,
                         OWN(coeff) inv_volume, OWN(int) boundary, OWN(coeff) held_gradient, int face_loads,
                         coeff lambda_one, coeff mu_one, OWN(coeff) material, int finite)
{
    const lane_mat3 g =
        dlsm_deformation_of(who, neighbour, area, offset, gradient, inv_volume, boundary, held_gradient, face_loads);
    const lane lambda = MEMBERS_MATERIAL(0, lambda_one), mu = MEMBERS_MATERIAL(1, mu_one);
    return dlsm_elastic_energy(who, g, lambda, mu, finite, inv_volume);
}

/* What of the bonds' stabilisation energies counts with the elements [J]: half. Or, around broken bonds, all of it
 * where the neighbour is not touched, half where it is as the element, and nothing where it was so before (touched [n],
 * cells.cl): each bond of those that are touched once. */
LAW lane dlsm_bonds_of(members who, OWN(int) neighbour, OWN(coeff) area, OWN(coeff) ratio, GATHER(state) displacement,
                       GATHER(coeff) gradient, coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau,
                       OWN(coeff) material, GATHER(coeff) modulus, GATHER(coeff) ell_of, int finite, int by_touch,
                       GATHER(int) touched)
{
    const lane k = MEMBERS_MATERIAL(2, k_one), ell = MEMBERS_MATERIAL(3, ell_one);
    const lane_mat3 h = lane_gather9(gradient, who.own), m = dlsm_compaction(h, ell, finite);
    const state_vec3 u = state_gather3(displacement, who.own);
    lane energy = LANE_ZERO;
    for (int slot = who.begin; slot < who.end; ++slot) {
        const lane_int j = members_neighbour(who, neighbour, slot);
        const lane_mat3 h_j = lane_gather9(gradient, j);
#if BRC_MANY_MATERIALS
        const lane k_bond = lane_min(gather_component(modulus, j), k), ell_j = gather_component(ell_of, j);
#else
        const lane k_bond = k, ell_j = ell;
#endif
        const lane q = members_row1(who, ratio, slot);
        const lane_vec3 x = lane_vec3_scale(REAL(0.5) * q, members_face3(who, area, slot)); /* R / 2 [m] */
        const lane_vec3 h_j_x = lane_mat3_mul_vec(h_j, x),
                        jump = state_vec3_difference(state_gather3(displacement, j), u);
        const lane_vec3 residual = lane_vec3_sub(jump, lane_vec3_add(lane_mat3_mul_vec(h, x), h_j_x));
        const lane_vec3 compact =
            lane_vec3_add(lane_mat3_mul_vec(m, x), dlsm_compaction_along(h_j, h_j_x, x, ell_j, finite));
        lane counts = LANE_ZERO + REAL(0.5);
        if (by_touch) {
#define OWN_LANE(l) touched[LANE_ITEM(who.own, l)]
#define OTHER(l) touched[LANE_ITEM(j, l)]
            const lane_int own = LANE_MAKE(lane_int, OWN_LANE), other = LANE_MAKE(lane_int, OTHER);
#undef OWN_LANE
#undef OTHER
            counts = REAL(1) - LANE_DIFFERENT(other, 0) * (REAL(0.5) + REAL(0.5) * LANE_DIFFERENT(other, own));
        }
        energy += counts * dlsm_residual_energy(residual, compact, q, k_bond, beta, one_plus_tau);
    }
    return energy;
}

/* Around broken bonds: V psi of the elements of a list alone [J] ... */
KERNEL void dlsm_elastic_listed(int n_items, int n, OWN(int) list, OWN(int) row_start, OWN(int) neighbour,
                                OWN(coeff) area, OWN(coeff) offset, GATHER(coeff) gradient, OWN(coeff) inv_volume,
                                OWN(int) boundary, OWN(coeff) held_gradient, int face_loads, coeff lambda_one,
                                coeff mu_one, OWN(coeff) material, int finite, PUT(state) elastic)
{
    FOR_EACH_ITEM(item, n_items) {
        const members who = members_of_list(item, n, list, row_start);
        members_store1(who, elastic,
                       dlsm_elastic_of(who, neighbour, area, offset, gradient, inv_volume, boundary, held_gradient,
                                       face_loads, lambda_one, mu_one, material, finite));
    }
}
/* ... and the bonds of those that are touched, each once. */
KERNEL void dlsm_bonds_listed(int n_items, int n, OWN(int) list, OWN(int) row_start, OWN(int) neighbour,
                              OWN(coeff) area, OWN(coeff) ratio, GATHER(state) displacement, GATHER(coeff) gradient,
                              coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau, OWN(coeff) material,
                              GATHER(coeff) modulus, GATHER(coeff) ell_of, int finite, GATHER(int) touched,
                              PUT(state) stabilisation)
{
    FOR_EACH_ITEM(item, n_items) {
        const members who = members_of_list(item, n, list, row_start);
        members_store1(who, stabilisation,
                       dlsm_bonds_of(who, neighbour, area, ratio, displacement, gradient, k_one, ell_one, beta,
                                     one_plus_tau, material, modulus, ell_of, finite, 1, touched));
    }
}

/* Output: G = F - I [-] [n][9]. */
KERNEL void dlsm_deformation(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) area, OWN(coeff) offset,
                             GATHER(coeff) gradient, OWN(coeff) inv_volume, OWN(int) boundary, OWN(coeff) held_gradient,
                             int face_loads, PUT(coeff) deformation)
{
    FOR_EACH_ITEM(group, n_groups) {
        const members who = members_of_group(group, row_start);
        members_store9(who, deformation,
                       dlsm_deformation_of(who, neighbour, area, offset, gradient, inv_volume, boundary, held_gradient,
                                           face_loads));
    }
}
