/* Interfaces of cells that break at once (dlsm, bond-normal; docs/notebook/fracture.md "Strengths of bonds"). A face's
 * own normal knows nothing of the plane that it is a step of: a plane that is slid along itself has no normal stress.
 * So a face of an interface breaks too where the largest principal value of the mean stress of its cells is above its
 * limit and the interface's normal stands within 60 degrees of it, as one that softens opens there.
 *
 * A face that stands across the way of a slide is pushed by it, and would hold both sides for ever: it breaks where
 * others of its cell in the same plane broke, and their sides have come apart by what it could not bear.
 *
 * along, across [n_slots][3][C]: normal of the interface, out of the own element, and branch of the bond [m], 0 of
 * other bonds; nearest [n]: smallest limit of the element's bonds in an interface, CELLS_NEVER: it has none [Pa]. */

/* Largest principal value across an interface over its limit at the face of an entry; 0: of none [-]. */
LAW coeff interface_load(int e, brc_size entry, OWN(int) neighbour, OWN(coeff) along, OWN(coeff) limit,
                         GATHER(coeff) gradient, GATHER(coeff) stress, failure_stress own)
{
    const soft_vector n = soft_row(along, entry);
    const int j = neighbour[entry];
    if (!(soft_dot(n, n) > 0) || j == e || !(limit[entry] < CELLS_NEVER)) return 0;
    const failure_stress its = soft_first(
        soft_present_stress(soft_spread9(gradient + (brc_size)j * 9), soft_spread9(stress + (brc_size)j * 9)));
    const failure_principal mean = failure_principal_of(
        (failure_stress){REAL(0.5) * (own.xx + its.xx), REAL(0.5) * (own.yy + its.yy), REAL(0.5) * (own.zz + its.zz),
                         REAL(0.5) * (own.yz + its.yz), REAL(0.5) * (own.xz + its.xz), REAL(0.5) * (own.xy + its.xy)});
    const soft_vector normal = soft_unit(SOFT_TURNED_ON(gradient, e, j, n)),
                      axis = {mean.first_axis.x, mean.first_axis.y, mean.first_axis.z};
    return SOFT_ABS(soft_dot(axis, normal)) < FRACTURE_ACROSS ? REAL(0) : mean.first / limit[entry];
}

LAW failure_stress interface_stress_of(int e, GATHER(coeff) gradient, GATHER(coeff) stress)
{
    return soft_first(
        soft_present_stress(soft_spread9(gradient + (brc_size)e * 9), soft_spread9(stress + (brc_size)e * 9)));
}

/* How far the sides of an element's broken faces have come apart at most that lie in an interface as one with this
 * normal does [m]. A broken bond points home, and so does its twin: that is the other cell. */
LAW coeff interface_apart(int e, soft_vector normal, OWN(int) row_start, GATHER(int) neighbour, OWN(int) twin,
                          OWN(coeff) along, OWN(coeff) across, GATHER(state) displacement, GATHER(coeff) gradient)
{
    coeff most = 0;
    for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
        const brc_size entry = (brc_size)slot * C + (brc_size)(e % C);
        const soft_vector n = soft_row(along, entry);
        if (neighbour[entry] != e || !(soft_dot(n, normal) > SOFT_SAME_PLANE)) continue;
        const int j = neighbour[twin[entry]];
        GLOBAL const state *p = displacement + (brc_size)e * 3, *q = displacement + (brc_size)j * 3;
        const soft_vector r = soft_row(across, entry),
                          jump = {(coeff)(q[0] - p[0]), (coeff)(q[1] - p[1]), (coeff)(q[2] - p[2])};
        const soft_vector bent = soft_add(SOFT_TURNED_ON(gradient, e, j, r), REAL(-1), r),
                          apart = soft_add(jump, REAL(-1), bent);
        most = failure_larger(most, soft_dot(apart, apart));
    }
    return SQRT(most);
}

/* After cells_check: more marks. Of the two cells of a face above its limit one has a principal value above it. plane
 * [n]: lambda + 2 mu [Pa]; broken [n]: bonds that broke; by_element: elements are judged by their own stress, only
 * faces that others push are looked at, and n_marked is of elements. */
KERNEL void interface_check(int n_groups, coeff share, int by_element, OWN(int) row_start, GATHER(int) neighbour,
                            OWN(int) twin, OWN(coeff) along, OWN(coeff) across, OWN(coeff) nearest, OWN(coeff) limit,
                            OWN(coeff) plane, OWN(state) broken, GATHER(state) displacement, GATHER(coeff) gradient,
                            GATHER(coeff) stress, UPDATE(int) mark, PUT(coeff) measure, FLAG(int) touched,
                            UPDATE(state) n_marked)
{
    FOR_EACH_GROUP(group, n_groups)
    {
        const int first = group * W;
        const lane least = lane_load(nearest, (brc_size)first), never = LANE_ZERO + REAL(0.5) * CELLS_NEVER;
        if (LANE_SOME(LANE_LESS(least, never))) {
            const lane_int own = lane_own(first);
            const lane_sym3 present = soft_present_stress(lane_gather9(gradient, own), lane_gather9(stress, own));
            const lane per = LANE_ZERO + REAL(1) / share;
            const lane room =
                soft_room_below(lane_sym3_scale_shift(per / least, present, LANE_ZERO), LANE_ZERO + REAL(0.9999));
            int looks = by_element ? 0 : soft_short_of(room);
            for (int l = 0; l < W; ++l) looks |= (broken[first + l] > 0) << l;
            for (int l = 0; looks && l < W; ++l) {
                const int e = first + l;
                if (!(looks >> l & 1)) continue;
                const failure_stress s = interface_stress_of(e, gradient, stress);
                for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
                    const brc_size entry = ((brc_size)slot * C + (brc_size)(e % C));
                    const soft_vector n = soft_row(along, entry), r = soft_row(across, entry);
                    if (!(soft_dot(n, n) > 0) || neighbour[entry] == e || mark[entry] || !(limit[entry] < CELLS_NEVER))
                        continue;
                    const coeff load = by_element
                                           ? REAL(0)
                                           : interface_load(e, entry, neighbour, along, limit, gradient, stress, s),
                                far = share * limit[entry] * SQRT(soft_dot(r, r));
                    if (!(load > share) &&
                        !(broken[e] > 0 && plane[e] * interface_apart(e, n, row_start, neighbour, twin, along, across,
                                                                      displacement, gradient) >
                                               far))
                        continue;
                    mark[entry] = CELLS_TENSION;
                    measure[entry] = failure_larger(load, share) * limit[entry];
                    STORE_SAME(touched + e, 1);
                    STORE_SAME(touched + neighbour[entry], 1);
                    n_marked[by_element ? e : group] += STATE(1);
                }
            }
        }
    }
}

/* After cells_ratio: the same of interfaces, where that is more [n] [-]. */
KERNEL void interface_ratio(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) along, OWN(coeff) nearest,
                            OWN(coeff) limit, GATHER(coeff) gradient, GATHER(coeff) stress, UPDATE(coeff) out)
{
    FOR_EACH_ITEM(group, n_groups) {
        for (int e = group * W; e < group * W + W; ++e) {
            if (!(nearest[e] < CELLS_NEVER)) continue;
            const failure_stress s = interface_stress_of(e, gradient, stress);
            for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot)
                out[e] = failure_larger(out[e], interface_load(e, ((brc_size)slot * C + (brc_size)(e % C)), neighbour,
                                                               along, limit, gradient, stress, s));
        }
    }
}
