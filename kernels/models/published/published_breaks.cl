/* Fracture of dlsm-published (AGH19 section 5.3): the forces with how far each element's bonds are, the bonds that
 * break, and the least squares that are left. Arrays of entries as in cells.cl, whose cells_break removes the
 * bonds. */

/* Bonds whose normal stress is above share * limit are marked; measure: that stress [Pa]; n_marked [n_groups]: how
 * many. Only groups of elements where one may be look. */
KERNEL void published_check(int n_groups, coeff share, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch,
                            OWN(coeff) area, GATHER(state) displacement, GATHER(state) orientation,
                            GATHER(coeff) strain, coeff lambda_one, coeff mu_one, coeff young_one,
                            coeff rotation_factor, coeff couple, GATHER(coeff) lame_of, int finite, OWN(coeff) limit,
                            OWN(coeff) bond_ratio, PUT(int) mark, PUT(coeff) measure, FLAG(int) touched,
                            PUT(state) n_marked)
{
    FOR_EACH_GROUP(group, n_groups)
    {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group);
        int look = 0, marked = 0;
        for (int l = 0; l < W; ++l) look |= !(bond_ratio[group * W + l] < REAL(0.99999) * share);
        if (look) {
            const members who = members_of_group(group, row_start);
            const published_own own = published_own_of(who.own, displacement, orientation, strain);
            for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
                const brc_size entry = (brc_size)slot * C + (brc_size)lane0;
                const published_bond b = published_bond_at(who, slot, members_neighbour(who, neighbour, slot), own,
                                                           branch, area, displacement, orientation, strain, lambda_one,
                                                           mu_one, young_one, rotation_factor, couple, lame_of, finite);
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
        n_marked[group] = (state)marked;
    }
}

/* Elements that lost a bond: the inverse of their least-squares matrix sum w R (x) R over the bonds that are left.
 * Where its smallest eigenvalue is not above support [n] the element has no strain any more (AGH19 section 2.2: fewer
 * than three contacts); keeping the directions that are spanned makes what is left run away. Marks are cleared.
 * area_weights: w = S/|R| instead of 1. */
KERNEL void published_rebuild(int n_rows, int area_weights, OWN(int) row_start, OWN(coeff) branch, OWN(coeff) area,
                              OWN(coeff) alive, OWN(coeff) support, UPDATE(int) changed, PUT(coeff) inv_shape,
                              PUT(coeff) spanned, PUT(int) mark)
{
    FOR_EACH_ITEM(e, n_rows) {
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

/* Records of dlsm-published, of the strains [n][6] as they stand, in the global frame. */
KERNEL void cells_record_published(int n_groups, OWN(coeff) strain, coeff lambda_one, coeff mu_one, coeff young_one,
                                   OWN(coeff) lame_of, coeff inv_tension, coeff inv_compression, coeff inv_shear,
                                   int drucker_prager, coeff slope, UPDATE(coeff) record, PUT(coeff) stress_bound)
{
    FOR_EACH_ITEM(group, n_groups) {
        const failure_scale scale = {inv_tension, inv_compression, inv_shear, drucker_prager, slope};
        const lane_int own = lane_own(group * W);
        const published_moduli m = published_moduli_of(own, own, lambda_one, mu_one, young_one, lame_of);
        const lane_sym3 e = lane_gather6(strain, own);
        const lane_sym3 hooke = lane_sym3_scale_shift(REAL(2) * m.mu, e, m.lambda * lane_sym3_trace(e));
        cells_put_record(group, hooke, scale, record, stress_bound);
    }
}
