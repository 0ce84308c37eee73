/* Fracture of dlsm-published (AGH19 section 5.3): the forces with how far each element's bonds are, the bonds that
 * break, and the least squares that are left. Arrays of entries as in kernels/cells.cl, whose cells_break removes the
 * bonds. */

/* As published_strain_pass where bonds may be missing. spanned: projector on the directions that an element's bonds
 * span [slice][6][C]. */
LAW void published_breaking_strain_of(members who, OWN(int) neighbour, OWN(coeff) branch, OWN(coeff) area,
                                      int area_weights, GATHER(state) displacement, OWN(state) orientation,
                                      OWN(coeff) inv_shape, OWN(coeff) spanned, int finite, PUT(coeff) strain)
{
    const lane_mat3 fitted = published_fit(who, neighbour, branch, area, area_weights, displacement, inv_shape);
    const lane_quat q = quat_conjugate(lane_gather4(orientation, who.own));
    const lane_mat3 turn = finite ? quat_matrix_minus_identity(q, 1) : quat_matrix_minus_identity(q, 0);
    const lane_mat3 seen = lane_mat3_mul_sym(turn, members_block6(who, spanned));
    members_store6(who, strain,
                   finite ? published_strain_seen(fitted, turn, seen, 1)
                          : published_strain_seen(fitted, turn, seen, 0));
}
KERNEL void published_breaking_strain(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch,
                                      OWN(coeff) area, int area_weights, GATHER(state) displacement,
                                      OWN(state) orientation, OWN(coeff) inv_shape, OWN(coeff) spanned, int finite,
                                      PUT(coeff) strain)
{
    FOR_EACH_ITEM(group, n_groups) {
        published_breaking_strain_of(members_of_group(group, row_start), neighbour, branch, area, area_weights,
                                     displacement, orientation, inv_shape, spanned, finite, strain);
    }
}
KERNEL void published_breaking_strain_listed(int n_items, int n, OWN(int) list, OWN(int) row_start, OWN(int) neighbour,
                                             OWN(coeff) branch, OWN(coeff) area, int area_weights,
                                             GATHER(state) displacement, OWN(state) orientation, OWN(coeff) inv_shape,
                                             OWN(coeff) spanned, int finite, PUT(coeff) strain)
{
    FOR_EACH_ITEM(item, n_items) {
        published_breaking_strain_of(members_of_list(item, n, list, row_start), neighbour, branch, area, area_weights,
                                     displacement, orientation, inv_shape, spanned, finite, strain);
    }
}

/* As published_force_pass with the full law; reach [n]: the largest normal stress over limit of each element's bonds
 * [-]. */
LAW void published_breaking_force_of(members who, OWN(int) neighbour, OWN(coeff) branch, OWN(coeff) area,
                                     GATHER(state) displacement, GATHER(state) orientation, GATHER(coeff) strain,
                                     coeff lambda_one, coeff mu_one, coeff young_one, coeff rotation_factor,
                                     coeff couple, GATHER(coeff) lame_of, OWN(coeff) limit, PUT(state) force,
                                     PUT(state) torque, PUT(coeff) reach)
{
    const published_own own = published_own_of(who.own, displacement, orientation, strain);
    lane_vec3 f = {LANE_ZERO, LANE_ZERO, LANE_ZERO}, t = {LANE_ZERO, LANE_ZERO, LANE_ZERO};
    lane largest = LANE_ZERO;
    for (int slot = who.begin; slot < who.end; ++slot) {
        const published_bond b =
            published_bond_at(who, slot, own, neighbour, branch, area, displacement, orientation, strain, lambda_one,
                              mu_one, young_one, rotation_factor, couple, lame_of, 1);
        f = lane_vec3_add(f, b.force);
        t = lane_vec3_add(t, b.torque);
        const lane ratio = b.stress / members_row1(who, limit, slot);
        largest = lane_max(largest, who.listed ? members_there(who, slot) * ratio : ratio);
    }
    members_store3(who, force, f);
    members_store3(who, torque, t);
    members_put1(who, reach, largest);
}
KERNEL void published_breaking_force(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch,
                                     OWN(coeff) area, GATHER(state) displacement, GATHER(state) orientation,
                                     GATHER(coeff) strain, coeff lambda_one, coeff mu_one, coeff young_one,
                                     coeff rotation_factor, coeff couple, GATHER(coeff) lame_of, OWN(coeff) limit,
                                     PUT(state) force, PUT(state) torque, PUT(coeff) reach)
{
    FOR_EACH_ITEM(group, n_groups) {
        published_breaking_force_of(members_of_group(group, row_start), neighbour, branch, area, displacement,
                                    orientation, strain, lambda_one, mu_one, young_one, rotation_factor, couple,
                                    lame_of, limit, force, torque, reach);
    }
}
KERNEL void published_breaking_force_listed(int n_items, int n, OWN(int) list, OWN(int) row_start, OWN(int) neighbour,
                                            OWN(coeff) branch, OWN(coeff) area, GATHER(state) displacement,
                                            GATHER(state) orientation, GATHER(coeff) strain, coeff lambda_one,
                                            coeff mu_one, coeff young_one, coeff rotation_factor, coeff couple,
                                            GATHER(coeff) lame_of, OWN(coeff) limit, PUT(state) force,
                                            PUT(state) torque, PUT(coeff) reach)
{
    FOR_EACH_ITEM(item, n_items) {
        published_breaking_force_of(members_of_list(item, n, list, row_start), neighbour, branch, area, displacement,
                                    orientation, strain, lambda_one, mu_one, young_one, rotation_factor, couple,
                                    lame_of, limit, force, torque, reach);
    }
}

/* Bonds whose normal stress is above share * limit are marked; measure: that stress [Pa]; found [n_groups]: how many.
 * Only groups of elements where one may be look. */
KERNEL void published_check(int n_groups, coeff share, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch,
                            OWN(coeff) area, GATHER(state) displacement, GATHER(state) orientation,
                            GATHER(coeff) strain, coeff lambda_one, coeff mu_one, coeff young_one,
                            coeff rotation_factor, coeff couple, GATHER(coeff) lame_of, OWN(coeff) limit,
                            OWN(coeff) reach, PUT(int) mark, PUT(coeff) measure, SCATTER(int) touched, PUT(state) found)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group);
        int look = 0, marked = 0;
        for (int l = 0; l < W; ++l) look |= !(reach[group * W + l] < REAL(0.99999) * share);
        if (look) {
            const members who = members_of_group(group, row_start);
            const published_own own = published_own_of(who.own, displacement, orientation, strain);
            for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
                const brc_size entry = (brc_size)slot * C + (brc_size)lane0;
                const published_bond b =
                    published_bond_at(who, slot, own, neighbour, branch, area, displacement, orientation, strain,
                                      lambda_one, mu_one, young_one, rotation_factor, couple, lame_of, 1);
                const lane bound = share * lane_load(limit, entry);
#define MARK(l)                                                                                                        \
    if (LANE_ITEM(b.stress, l) > LANE_ITEM(bound, l)) {                                                                \
        mark[entry + 0x##l] = CELLS_TENSION;                                                                           \
        measure[entry + 0x##l] = LANE_ITEM(b.stress, l);                                                               \
        STORE_SAME(touched + group * W + 0x##l, 1);                                                                    \
        STORE_SAME(touched + neighbour[entry + 0x##l], 1);                                                             \
        marked += 1;                                                                                                   \
    }
                LANE_EACH(MARK)
#undef MARK
            }
        }
        found[group] = (state)marked;
    }
}

/* Elements that lost a bond: the inverse of their least-squares matrix sum w R (x) R over the bonds that are left.
 * Where its smallest eigenvalue is not above support [n] the element has no strain any more (AGH19 section 2.2: fewer
 * than three contacts); keeping the directions that are spanned makes what is left run away. Marks are cleared.
 * area_weights: w = S/|R| instead of 1. */
KERNEL void published_rebuild(int n, int area_weights, OWN(int) row_start, OWN(coeff) branch, OWN(coeff) area,
                              OWN(coeff) alive, OWN(coeff) support, UPDATE(int) changed, PUT(coeff) inv_shape,
                              PUT(coeff) spanned, PUT(int) mark)
{
    FOR_EACH_ITEM(e, n) {
        if (changed[e]) {
            cells_sym a = {0, 0, 0, 0, 0, 0}, inverse = {0, 0, 0, 0, 0, 0}, projector = {1, 1, 1, 0, 0, 0};
            changed[e] = 0;
            for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
                const brc_size entry = (brc_size)slot * C + e % C, at = (brc_size)slot * 3 * C + e % C;
                mark[entry] = 0;
                if (!(alive[entry] > 0)) continue;
                const state x = (state)branch[at], y = (state)branch[at + C], z = (state)branch[at + 2 * C];
                a = cells_add_square(
                    a, area_weights ? (state)area[entry] / SQRT_STATE(x * x + y * y + z * z) : STATE(1), x, y, z);
            }
            const failure_principal spans = failure_principal_of(cells_narrow(a));
            if (spans.third > support[e])
                inverse = cells_inverse(a);
            else
                projector = inverse;
            cells_put(spanned, e, projector);
            cells_put(inv_shape, e, inverse);
        }
    }
}
