/* Fracture of cells by criteria of elements, dlsm and dlsm-published: what fracture.cl asks of an element that
 * has a stress of its own in place of the virial of beams. record holds stress times twice the volume; who fails and
 * which bond it chooses is decided there; chosen bonds become marks of cells.cl. */

/* Cauchy stress [Pa] P F^T / det F with F = I + H (in a uniform state the element's own F; turning with the element in
 * any). */
LAW lane_sym3 cells_cauchy(lane_mat3 gradient, lane_mat3 stress)
{
    lane_mat3 f = gradient;
    f.xx += REAL(1), f.yy += REAL(1), f.zz += REAL(1);
    const lane det =
        f.xx * (f.yy * f.zz - f.yz * f.zy) - f.xy * (f.yx * f.zz - f.yz * f.zx) + f.xz * (f.yx * f.zy - f.yy * f.zx);
    const lane_sym3 pulled = lane_mat3_sym(lane_mat3_mul(stress, lane_mat3_transpose(f)));
    return lane_sym3_scale_shift(REAL(1) / det, pulled, LANE_ZERO);
}

/* The record of a group of elements of this stress [Pa]. */
LAW void cells_put_record(int group, lane_sym3 stress, failure_scale scale, UPDATE(coeff) record,
                          PUT(coeff) stress_bound)
{
    const lane volume = lane_block(record, SLICE_OF(group), RECORD, 6, FIRST_LANE_OF(group));
    const lane_sym3 virial = lane_sym3_scale_shift(volume, stress, LANE_ZERO);
    fracture_put_record(group, virial, scale, record, stress_bound);
}

/* The bonds that elements chose are marked; stress [n]: of the element that chose [Pa]; found [n]: 1 where one did. */
KERNEL void cells_mark_chosen(int n_rows, OWN(int) row_start, OWN(int) neighbour, OWN(int) choice, OWN(coeff) stress,
                              PUT(int) mark, PUT(coeff) measure, FLAG(int) touched, PUT(state) found)
{
    FOR_EACH_ITEM(e, n_rows) {
        const int chosen = choice[e];
        found[e] = chosen < 0 ? STATE(0) : STATE(1);
        for (int slot = row_start[e / C]; chosen >= 0 && slot < row_start[e / C + 1]; ++slot) {
            const brc_size entry = (brc_size)slot * C + e % C;
            if (neighbour[entry] != chosen / 4) continue;
            mark[entry] = chosen % 4;
            measure[entry] = stress[e];
            STORE_SAME(touched + e, 1);
            STORE_SAME(touched + chosen / 4, 1);
        }
    }
}

/* Volume of record over each element and its neighbours over unbroken bonds, weight [n], after bonds broke. */
KERNEL void cells_weigh(int n_rows, OWN(int) row_start, OWN(int) neighbour, GATHER(coeff) record, PUT(coeff) weight)
{
    FOR_EACH_ITEM(e, n_rows) { weight[e] = fracture_weight(e, row_start, neighbour, record); }
}
