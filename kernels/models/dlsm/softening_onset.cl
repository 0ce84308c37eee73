/* Which faces open, and how: what a face bears before it softens (softening.cl). A face opens by tension, by a moment
 * about its edge, or, where there are limits of shear, by sliding along the plane it stands for
 * (docs/notebook/theory.md T10, T11). shear_limit [n_slots][C]: 2 c cos phi of the bond, below 0 along an interface,
 * whose faces slide on their own planes [Pa]; shear_energy: G_II S [J]; both are read only where `shears`. */

/* The stress at a bond [Pa]: the mean of its cells, but with the traction that the bond itself carries: mean + t (x) n
 * + n (x) t - (t.n) n (x) n, t that traction less that of the mean. So a bond that bridges an open crack, between cells
 * without stress, is seen to be pulled. n: unit normal. */
LAW failure_stress soft_stress(failure_stress mean, soft_vector traction, soft_vector n)
{
    const soft_vector t = {traction.x - (mean.xx * n.x + mean.xy * n.y + mean.xz * n.z),
                           traction.y - (mean.xy * n.x + mean.yy * n.y + mean.yz * n.z),
                           traction.z - (mean.xz * n.x + mean.yz * n.y + mean.zz * n.z)};
    const soft_vector m = soft_add(t, REAL(-0.5) * soft_dot(t, n), n);
    return (failure_stress){mean.xx + REAL(2) * m.x * n.x,   mean.yy + REAL(2) * m.y * n.y,
                            mean.zz + REAL(2) * m.z * n.z,   mean.yz + m.y * n.z + m.z * n.y,
                            mean.xz + m.x * n.z + m.z * n.x, mean.xy + m.x * n.y + m.y * n.x};
}

/* Stress at the edge of a face that turns about the other edge [Pa], its traction even: of the moment that the uneven
 * pulls of the two cells make over the length of the bond, as far as it turns the sides the way they are apart, and of
 * the force across it. Nothing in the middle of a face shows that a crack, which has come to one side of it, bends it.
 * apart: soft_sides_apart; n: unit normal. */
LAW coeff soft_edge(soft_vector uneven, soft_vector apart, soft_vector force, soft_vector n, soft_vector s, coeff ratio)
{
    const coeff area = SQRT(soft_dot(s, s));
    const soft_vector turn = soft_add(apart, -soft_dot(apart, n), n);
    const coeff size = SQRT(soft_dot(turn, turn)), along = size > 0 ? soft_dot(uneven, turn) / size : REAL(0);
    return (along > 0 ? along : REAL(0)) * ratio / SQRT(area) + soft_dot(force, n) / area;
}

/* 0: the bond stays shut, known without principal values: none of its stress is above the limit, nor its edge's, and no
 * plane slides, nor the face (whose sum of Mohr and Coulomb is at most that of all planes). limit, shear_limit: as much
 * of the bond's as counts [Pa]; shear_limit 0: none slides. */
LAW int soft_possible(failure_stress stress, coeff edge, coeff limit, coeff shear_limit, coeff slope)
{
    const coeff shear = SOFT_ABS(shear_limit);
    return !(edge < REAL(0.999) * limit) ||
           failure_possible(stress, (failure_limits){limit, 0, shear}, (failure_shear){0, slope, slope});
}

/* The same number in every lane; that of the first. */
LAW lane_vec3 soft_lanes(soft_vector a) { return (lane_vec3){LANE_ZERO + a.x, LANE_ZERO + a.y, LANE_ZERO + a.z}; }
LAW failure_stress soft_first(lane_sym3 a)
{
    return (failure_stress){LANE_ITEM(a.xx, 0), LANE_ITEM(a.yy, 0), LANE_ITEM(a.zz, 0),
                            LANE_ITEM(a.yz, 0), LANE_ITEM(a.xz, 0), LANE_ITEM(a.xy, 0)};
}
LAW lane_sym3 soft_spread(failure_stress a)
{
    return (lane_sym3){LANE_ZERO + a.xx, LANE_ZERO + a.yy, LANE_ZERO + a.zz,
                       LANE_ZERO + a.yz, LANE_ZERO + a.xz, LANE_ZERO + a.xy};
}
/* One face whose openings are all 0: the force of the bond and how unevenly its sides pull [N], soft_sides_apart, its
 * area vector and the mean stress in the present frame. */
typedef struct {
    soft_vector force, uneven, apart, normal;
    failure_stress mean;
} soft_whole;
LAW soft_whole soft_whole_at(soft_faces f, coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau,
                             GATHER(coeff) modulus, GATHER(state) displacement, GATHER(coeff) gradient,
                             GATHER(coeff) stress, GATHER(coeff) flux, GATHER(coeff) bond_part)
{
    const soft_cell own = soft_cell_of(f.e, f.area, f.area, flux, bond_part, gradient, stress, k_one, ell_one, beta,
                                       one_plus_tau),
                    beside = soft_cell_of(f.j, f.area, f.area, flux, bond_part, gradient, stress, k_one, ell_one, beta,
                                          one_plus_tau);
    const lane_vec3 force = soft_bond_force(own.pulls, beside.pulls, soft_modulus(f, modulus, k_one) * one_plus_tau,
                                            f.ratio, soft_jump(f, displacement)),
                    uneven = soft_uneven(own.pulls, beside.pulls), apart = soft_sides_apart(f, own, beside),
                    normal = soft_turned(f.area, own.along_area, beside.along_area);
    return (soft_whole){SOFT_LANE(force, 0), SOFT_LANE(uneven, 0), SOFT_LANE(apart, 0), SOFT_LANE(normal, 0),
                        soft_first(soft_mean_stress(own, beside))};
}

LAW lane_mat3 soft_spread9(GLOBAL const coeff *p)
{
    return (lane_mat3){LANE_ZERO + p[0], LANE_ZERO + p[1], LANE_ZERO + p[2], LANE_ZERO + p[3], LANE_ZERO + p[4],
                       LANE_ZERO + p[5], LANE_ZERO + p[6], LANE_ZERO + p[7], LANE_ZERO + p[8]};
}
/* The sum and the present stresses of an element's neighbours [Pa] (what points home has no face). */
LAW failure_stress soft_add_around(failure_stress sum, int e, OWN(int) row_start, OWN(int) neighbour,
                                   GATHER(coeff) gradient, GATHER(coeff) stress)
{
    lane_sym3 all = soft_spread(sum);
    for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
        const int j = neighbour[SOFT_ENTRY];
        if (j != e)
            all = lane_sym3_add(all, soft_present_stress(soft_spread9(gradient + (brc_size)j * 9),
                                                         soft_spread9(stress + (brc_size)j * 9)));
    }
    return soft_first(all);
}

/* Components of a unit vector along the three principal axes. */
typedef struct {
    coeff first, second, third;
} soft_cosines;
LAW soft_cosines soft_cosines_of(failure_principal at, soft_vector a)
{
    return (soft_cosines){a.x * at.first_axis.x + a.y * at.first_axis.y + a.z * at.first_axis.z,
                          a.x * at.second_axis.x + a.y * at.second_axis.y + a.z * at.second_axis.z,
                          a.x * at.third_axis.x + a.y * at.third_axis.y + a.z * at.third_axis.z};
}
/* Cosine of the normal of a face to the axis of its crack. `axis`, of the stress at the bond, leans towards the normal;
 * the mean of the two cells, T, does not: the axis is that of T T axis. A pull along the crack counts for no more than
 * that along `axis`, so that it does not tilt the crack, and a push for nothing. Where the largest of that mean is less
 * than half of what opens the face, a bond that bridges a crack, to `axis` itself: `size`. */
LAW coeff soft_cosine(failure_stress mean, soft_vector normal, soft_vector axis, coeff worst, coeff size,
                      coeff steepest)
{
    const failure_principal whole = failure_principal_of(mean);
    if (whole.first < REAL(0.5) * worst) return size;
    const soft_cosines n = soft_cosines_of(whole, normal), a = soft_cosines_of(whole, axis);
    const coeff one = failure_larger(whole.first, 0), two = failure_larger(whole.second, 0),
                three = failure_larger(whole.third, 0),
                most = one * a.first * a.first + two * a.second * a.second + three * a.third * a.third;
    const coeff per = most > 0 ? REAL(1) / most : REAL(0), x = one < most ? per * one : REAL(1),
                y = two < most ? per * two : REAL(1), z = three < most ? per * three : REAL(1);
    const soft_vector pulled = {x * x * a.first, y * y * a.second, z * z * a.third};
    const coeff length = SQRT(soft_dot(pulled, pulled)),
                across = SOFT_ABS(pulled.x * n.first + pulled.y * n.second + pulled.z * n.third);
    return failure_larger(length > 0 ? across / length : REAL(0), steepest);
}

/* What a stress lays on the plane across n [Pa]. */
LAW soft_vector soft_on_plane(failure_principal at, soft_vector n)
{
    const soft_cosines c = soft_cosines_of(at, n);
    const coeff x = at.first * c.first, y = at.second * c.second, z = at.third * c.third;
    return (soft_vector){x * at.first_axis.x + y * at.second_axis.x + z * at.third_axis.x,
                         x * at.first_axis.y + y * at.second_axis.y + z * at.third_axis.y,
                         x * at.first_axis.z + y * at.second_axis.z + z * at.third_axis.z};
}

/* Pull along an axis on the projection of a face across it [Pa]: in an even stress, and its axis, the largest principal
 * value, and more where the stress at the face leans from the axis towards the normal. Pushes count for nothing, as
 * they go on along a crack; nor do faces more than 45 degrees off, on which a slide along the crack counts for more
 * than a pull across it. at: stress at the face. */
#define SOFT_LEANS REAL(0.7071067811865476)
LAW coeff soft_pull_along(failure_principal at, soft_vector normal, soft_vector axis)
{
    const soft_cosines n = soft_cosines_of(at, normal), a = soft_cosines_of(at, axis);
    const coeff pull = failure_larger(at.first, 0) * n.first * a.first +
                       failure_larger(at.second, 0) * n.second * a.second +
                       failure_larger(at.third, 0) * n.third * a.third;
    const coeff c = soft_dot(normal, axis);
    return SOFT_ABS(c) < SOFT_LEANS ? REAL(0) : pull / c;
}
/* Of the pull along an axis on the projection of a face, whatever the axis is: at 45 degrees to the normal n all of
 * what the pulls T lay on the face beside n adds to n.T n. */
LAW coeff soft_pull_at_most(failure_principal at, soft_vector normal)
{
    const soft_cosines n = soft_cosines_of(at, normal);
    const coeff one = failure_larger(at.first, 0) * n.first, two = failure_larger(at.second, 0) * n.second,
                three = failure_larger(at.third, 0) * n.third;
    const coeff across = one * n.first + two * n.second + three * n.third,
                beside = one * one + two * two + three * three - across * across;
    return across + SQRT(failure_larger(beside, 0));
}
/* Square of what the pushes at a face lay on the plane across an axis [Pa^2]. */
LAW coeff soft_pushed(failure_principal at, soft_vector axis)
{
    const soft_cosines a = soft_cosines_of(at, axis);
    const coeff one = failure_larger(-at.first, 0) * a.first, two = failure_larger(-at.second, 0) * a.second,
                three = failure_larger(-at.third, 0) * a.third;
    return one * one + two * two + three * three;
}
#define SOFT_PUSHED_MOST REAL(0.1) /* of the limit */
/* A bond that bridges a crack, between cells without stress (mean); it bears `most` [Pa]. */
LAW int soft_bridges(failure_stress mean, coeff most) { return failure_all_below(mean, REAL(1), REAL(0.5) * most); }
/* What draws a face open that bears `most` [Pa], as a piece of a crack that is wider than it: along the axis of the
 * stress around, `wide`. 0 where that axis would have what presses let go, as next to a platen. */
LAW coeff soft_drawn(failure_stress wide, failure_principal at, soft_vector normal, coeff most)
{
    const failure_axis first = failure_principal_of(wide).first_axis;
    const soft_vector axis = {first.x, first.y, first.z};
    return soft_pushed(at, axis) > SOFT_PUSHED_MOST * SOFT_PUSHED_MOST * most * most
               ? REAL(0)
               : soft_pull_along(at, normal, axis);
}

/* Of a stress at a face, the largest principal value whose axis stands within the angle of `steepest` to the normal
 * [Pa]; some axis always stands within 55 degrees of it. A larger pull that lies along the face does not open it, nor
 * keep it shut. cosine: of normal and axis. */
typedef struct {
    coeff stress, cosine;
    soft_vector axis;
    int is_first;
} soft_tension;
LAW soft_tension soft_across(failure_principal at, soft_vector normal, coeff steepest)
{
    const soft_cosines n = soft_cosines_of(at, normal);
    if (!(SOFT_ABS(n.first) < steepest))
        return (soft_tension){at.first, n.first, {at.first_axis.x, at.first_axis.y, at.first_axis.z}, 1};
    if (!(SOFT_ABS(n.second) < steepest))
        return (soft_tension){at.second, n.second, {at.second_axis.x, at.second_axis.y, at.second_axis.z}, 0};
    return (soft_tension){at.third, n.third, {at.third_axis.x, at.third_axis.y, at.third_axis.z}, 0};
}

/* The bond of one entry of an element, which may have a stress above its limit: 1 where it is marked. */
LAW int soft_check_bond(int e, brc_size entry, coeff share, coeff steepest, int shears, coeff slope, OWN(int) row_start,
                        OWN(int) neighbour, GATHER(int) n_open, OWN(coeff) area, OWN(coeff) ratio, coeff k_one,
                        coeff ell_one, coeff beta, coeff one_plus_tau, GATHER(coeff) modulus,
                        GATHER(state) displacement, GATHER(coeff) gradient, GATHER(coeff) stress, GATHER(coeff) flux,
                        GATHER(coeff) bond_part, OWN(coeff) limit, OWN(coeff) shear_limit, PUT(int) mark,
                        PUT(coeff) measure, UPDATE(coeff) crack)
{
    if (!(limit[entry] < CELLS_NEVER)) return 0;
    const int both = n_open[e] && n_open[neighbour[entry]];
    const soft_vector s = soft_row(area, entry);
    const soft_whole now = soft_whole_at(soft_face_of(e, entry, neighbour, area, ratio), k_one, ell_one, beta,
                                         one_plus_tau, modulus, displacement, gradient, stress, flux, bond_part);
    const soft_vector force = now.force, own = soft_unit(now.normal);
    const soft_vector traction = soft_scale(REAL(1) / SQRT(soft_dot(s, s)), force);
    const failure_stress whole = soft_stress(now.mean, traction, own);
    const coeff edge = both ? soft_edge(now.uneven, now.apart, force, own, s, ratio[entry]) : REAL(0);
    if (!soft_possible(whole, edge, SOFT_DRAWN_LEAST * share * limit[entry],
                       shears ? share * shear_limit[entry] : REAL(0), slope))
        return 0;
    const failure_principal largest = failure_principal_of(whole);
    const soft_vector normal = /* of what may crack */
        SOFT_IN_INTERFACE(entry) ? soft_interface_at(crack, entry, gradient, e, neighbour[entry]) : own;
    const soft_tension across = soft_across(largest, normal, steepest);
    const soft_vector axis = across.axis;
    const coeff c = across.cosine, size = SOFT_ABS(c);
    const coeff most = share * limit[entry];
    const coeff drawn = /* only where it may be more than both, and not along an interface, whose plane is known */
        SOFT_IN_INTERFACE(entry) || !across.is_first ||
                soft_pull_at_most(largest, normal) < REAL(0.999) * failure_larger(most, largest.first) ||
                soft_bridges(now.mean, most)
            ? REAL(0)
            : soft_drawn(soft_add_around(now.mean, e, row_start, neighbour, gradient, stress), largest, normal, most);
    const coeff first = failure_larger(across.stress, drawn);
    const int bends = edge > first;
    const coeff worst = bends ? edge : first;
    if (shears) {
        const failure_state slip =
            soft_slip(largest, soft_on_plane(largest, normal), normal, share * shear_limit[entry], slope);
        const soft_vector plane = soft_slip_plane(slip, normal);
        const coeff leans = soft_dot(plane, normal);
        const int nearer = slip.ratio * most >= worst;
        if (slip.ratio > REAL(1) && nearer && !(leans < steepest)) {
            mark[entry] = SOFT_WISH;
            measure[entry] = slip.stress;
            SOFT_NUMBER(entry, TURNS) = SOFT_SLIDES;
            if (!SOFT_IN_INTERFACE(entry)) SOFT_NUMBER(entry, COSINE) = leans;
            soft_put(crack, (int)entry, SOFT_AXIS, plane);
            return 1;
        }
    }
    if (!(worst > most)) return 0;
    const int turned = across.stress < REAL(0.5) * worst;
    mark[entry] = SOFT_WISH;
    measure[entry] = worst;
    SOFT_NUMBER(entry, TURNS) = turned ? REAL(1) : REAL(0);
    if (!SOFT_IN_INTERFACE(entry))
        SOFT_NUMBER(entry, COSINE) = turned ? REAL(1) : soft_cosine(now.mean, normal, axis, worst, size, steepest);
    soft_put(crack, (int)entry, SOFT_AXIS, turned ? normal : soft_scale(c < 0 ? REAL(-1) : REAL(1), axis));
    return 1;
}

/* Whole bonds whose largest principal stress, or what draws them open, is above share * limit and that stand across it
 * (the cosine of normal and axis is at least steepest) are marked SOFT_WISH, measure: that stress. Elements without
 * open faces whose own stress is well below the limit of their weakest bond do not look (soft_looking); shear_least:
 * the smallest limit of shear [Pa]. found [n]. */
KERNEL void soft_check(int n_groups, coeff share, coeff steepest, coeff screen, int shears, coeff slope,
                       coeff shear_least, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, GATHER(int) n_open,
                       OWN(coeff) area, OWN(coeff) ratio, coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau,
                       GATHER(coeff) modulus, GATHER(state) displacement, GATHER(coeff) gradient, GATHER(coeff) stress,
                       GATHER(coeff) flux, GATHER(coeff) bond_part, OWN(coeff) least, OWN(coeff) limit,
                       OWN(coeff) shear_limit, PUT(int) mark, PUT(coeff) measure, UPDATE(coeff) crack, PUT(state) found)
{
    FOR_EACH_ITEM(group, n_groups) {
        const members who = members_of_group(group, row_start);
        const lane_mat3 h = lane_gather9(gradient, who.own), p = lane_gather9(stress, who.own);
        const lane_sym3 own = soft_present_stress(h, p);
        const soft_members which =
            soft_looking(who, h, p, own, share, screen, shears, slope, shear_least, n_open, least);
        const dlsm_end end = dlsm_end_of(who, displacement, flux, bond_part, k_one, one_plus_tau, modulus);
        if (which.looking) members_later(who, gradient, 9, ahead), members_later(who, stress, 9, ahead);
        if (which.looking) members_later(who, flux, 9, ahead);
        int count[W];
        for (int l = 0; l < W; ++l) count[l] = 0;
        for (int slot = who.begin; which.looking && slot < who.end; ++slot) {
            const lane_int j = members_neighbour(who, neighbour, slot);
            members_ahead1(who, limit, slot);
            const dlsm_pull pull = dlsm_pull_at(dlsm_row_at(who, slot, neighbour, area, ratio, DLSM_RATIO), end,
                                                displacement, flux, bond_part, one_plus_tau, modulus);
            const lane_mat3 beside = lane_gather9(gradient, j);
            const soft_bounds below = {SOFT_DRAWN_LEAST * share * members_row1(who, limit, slot),
                                       shears ? share * soft_size_of(members_row1(who, shear_limit, slot)) : LANE_ZERO,
                                       shears, slope, steepest};
            int near = soft_near(lane_mat3_add(h, beside),
                                 lane_sym3_add(own, soft_present_stress(beside, lane_gather9(stress, j))), pull, below),
                both = 0;
#define EDGES(l) both |= (which.open >> 0x##l & 1 && n_open[LANE_ITEM(j, l)] > 0) << 0x##l;
            if (which.open) { LANE_EACH(EDGES) }
#undef EDGES
            if (both & ~near)
                near |= both & soft_near_edge(h, beside, end.b, lane_gather9(flux, j), pull, below.limit, k_one,
                                              ell_one, beta, one_plus_tau);
            near &= which.looking;
            for (int l = 0; near >> l; ++l)
                if (near >> l & 1)
                    count[l] += soft_check_bond(who.first + l, (brc_size)slot * C + (brc_size)(who.lane0 + l), share,
                                                steepest, shears, slope, row_start, neighbour, n_open, area, ratio,
                                                k_one, ell_one, beta, one_plus_tau, modulus, displacement, gradient,
                                                stress, flux, bond_part, limit, shear_limit, mark, measure, crack);
        }
        for (int l = 0; l < W; ++l) found[who.first + l] = (state)count[l];
    }
}

/* Wishes of either side come true: the bond opens at the force it carries; without a fracture energy it is marked to
 * break. */
KERNEL void soft_begin(int n, OWN(int) row_start, OWN(int) neighbour, OWN(int) twin, OWN(int) lead, OWN(coeff) area,
                       OWN(coeff) ratio, coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau,
                       GATHER(coeff) modulus, GATHER(state) displacement, GATHER(coeff) flux, GATHER(coeff) bond_part,
                       GATHER(coeff) gradient, GATHER(coeff) stress, coeff friction, OWN(coeff) shear_energy,
                       SCATTER(int) mark, SCATTER(coeff) measure, SCATTER(coeff) crack, SCATTER(coeff) limit,
                       SCATTER(int) open, SCATTER(int) touched, PUT(state) found)
{
    FOR_EACH_ITEM(e, n) {
        int breaks = 0;
        for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
            const brc_size entry = SOFT_ENTRY, other = (brc_size)twin[entry];
            if (!lead[entry] || !(mark[entry] == SOFT_WISH || mark[other] == SOFT_WISH)) continue;
            const brc_size from = mark[entry] == SOFT_WISH ? entry : other;
            const int j = neighbour[entry];
            const coeff onset = measure[from], c = SOFT_NUMBER(from, COSINE);
            mark[entry] = 0, mark[other] = 0;
            limit[entry] = CELLS_NEVER, limit[other] = CELLS_NEVER;
            const int slides = SOFT_IS_SLIDING(from), mode = slides ? CELLS_SHEAR : CELLS_TENSION;
            if (!(SOFT_NUMBER(entry, ENERGY) > 0)) {
                mark[entry] = mode, mark[other] = mode;
                measure[entry] = onset, measure[other] = onset;
                STORE_SAME(touched + e, 1);
                STORE_SAME(touched + j, 1);
                breaks += 1;
                continue;
            }
            const soft_whole at = soft_whole_at(soft_face_of(e, entry, neighbour, area, ratio), k_one, ell_one, beta,
                                                one_plus_tau, modulus, displacement, gradient, stress, flux, bond_part);
            const soft_vector force = at.force, uneven = at.uneven;
            const soft_vector wished = soft_scale(from == entry ? REAL(1) : REAL(-1),
                                                  soft_part(crack, from, SOFT_AXIS)); /* seen from this side */
            const int along = SOFT_IN_INTERFACE(entry) && !slides, turned = SOFT_NUMBER(from, TURNS) > 0 && !slides;
            const soft_vector now = along ? soft_interface_at(crack, entry, gradient, e, j) : wished;
            const lane_vec3 axis_now = soft_lanes(now), normal = soft_lanes(at.normal);
            const lane_vec3 goes_on = slides || along ? soft_passed(soft_spread(at.mean), axis_now, normal)
                                                      : soft_carried(soft_spread(at.mean), axis_now, normal);
            const soft_vector released = soft_add(force, REAL(-1), SOFT_LANE(goes_on, 0));
            const soft_vector axis = soft_unit(SOFT_TURNED_BACK(gradient, e, j, now));
            const coeff across = soft_dot(released, now), pulled = across > 0 ? across : 0;
            const coeff carried = turned            ? SQRT(pulled * pulled + soft_dot(uneven, uneven))
                                  : slides || along ? soft_slide_start(released, now, friction)
                                                    : SQRT(soft_dot(released, released));
            const coeff least = along ? soft_least_start(SOFT_NUMBER(from, START), onset, at.normal, c) : REAL(0);
            const coeff size = carried > least ? carried : least;
            const coeff whole = slides ? shear_energy[entry] : SOFT_NUMBER(entry, ENERGY);
            const coeff turns = along ? SOFT_ALONG : SOFT_NUMBER(from, TURNS);
            const int mine = (int)entry, its = (int)other;
            const soft_vector side = slides ? (soft_vector){0, 0, 0} : uneven;
            open[entry] = SOFT_OPENS, open[other] = SOFT_OPENS;
            soft_put(crack, mine, SOFT_AXIS, axis);
            soft_put(crack, mine, SOFT_SHIFT, (soft_vector){0, 0, 0});
            soft_put_number(crack, mine, SOFT_START, size);
            soft_put_number(crack, mine, SOFT_ENERGY, whole * SOFT_ABS(c));
            soft_put_number(crack, mine, SOFT_COSINE, c);
            soft_put_number(crack, mine, SOFT_TILT, REAL(1));
            soft_put_numbers(crack, mine, its, SOFT_TURNS, turns);
            soft_put_numbers(crack, mine, its, SOFT_ONSET, onset);
            soft_put(crack, mine, SOFT_PULL, force);
            soft_put(crack, mine, SOFT_SIDE_PULL, side);
        }
        found[e] = (state)breaks;
    }
}

/* p = A^-1 s of a face [1/m]. */
LAW soft_vector soft_pull_at(int e, OWN(coeff) inv_shape, soft_vector s)
{
    GLOBAL const coeff *p = inv_shape + (brc_size)(e / C) * 6 * C + e % C;
    const coeff xx = p[0], yy = p[C], zz = p[2 * C], yz = p[3 * C], xz = p[4 * C], xy = p[5 * C];
    return (soft_vector){xx * s.x + xy * s.y + xz * s.z, xy * s.x + yy * s.y + yz * s.z,
                         xz * s.x + yz * s.y + zz * s.z};
}
/* sum + part a (x) a */
LAW failure_stress soft_add_square(failure_stress sum, coeff part, soft_vector a)
{
    return (failure_stress){sum.xx + part * a.x * a.x, sum.yy + part * a.y * a.y, sum.zz + part * a.z * a.z,
                            sum.yz + part * a.y * a.z, sum.xz + part * a.x * a.z, sum.xy + part * a.x * a.y};
}
/* What w (x) p more in the gradient H of a cell takes of energy, p.M p times |w|^2 V: M [-], of its own G and of those
 * around, which its faces' centroids beside the branches strain too (docs/notebook/theory.md T2): G by w (x) (p - sum
 * of s (d.p) / 2V), each of theirs by w (x) s (d.p) / 2V_j. */
LAW failure_stress soft_sways(int e, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) alive, OWN(coeff) area,
                              OWN(coeff) offset, GATHER(coeff) inv_volume, GATHER(coeff) plane, GATHER(coeff) modulus)
{
    soft_vector x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1}; /* rows of 1 - sum of s (x) d / 2V */
    failure_stress m = {0, 0, 0, 0, 0, 0};
    for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
        const brc_size entry = SOFT_ENTRY;
        const int j = neighbour[entry];
        if (!(alive[entry] > 0)) continue;
        const soft_vector s = soft_row(area, entry), d = soft_row(offset, entry);
        const coeff own = REAL(0.5) * inv_volume[e];
        x = soft_add(x, -own * s.x, d), y = soft_add(y, -own * s.y, d), z = soft_add(z, -own * s.z, d);
#if BRC_MANY_MATERIALS
        const coeff weight = modulus[e] / modulus[j], part = weight * weight * plane[j] / plane[e];
#else
        const coeff part = REAL(1);
        (void)plane, (void)modulus;
#endif
        const coeff size = SQRT(soft_dot(s, s)); /* volumes of small cells, squared, may not fit single precision */
        m = soft_add_square(m, own * size * (REAL(0.5) * inv_volume[j] * size) * part, d);
    }
    return soft_add_square(soft_add_square(soft_add_square(m, REAL(1), x), REAL(1), y), REAL(1), z);
}
/* The largest eigenvalue of M T, T the sum of p (x) p / |p| over the open faces of a cell, p = A^-1 s: |w|^2 |p| V
 * times it is not below the energy that openings w of its faces take together [1/m]. */
LAW coeff soft_together(int e, failure_stress m, OWN(int) row_start, OWN(coeff) alive, OWN(int) open, OWN(coeff) area,
                        OWN(coeff) inv_shape)
{
    const coeff xx = SQRT(m.xx), xy = m.xy / xx, xz = m.xz / xx, yy = SQRT(m.yy - xy * xy), yz = (m.yz - xy * xz) / yy,
                zz = SQRT(failure_larger(m.zz - xz * xz - yz * yz, 0)); /* M = R^T R: of R T R^T */
    failure_stress sum = {0, 0, 0, 0, 0, 0};
    for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
        const brc_size entry = SOFT_ENTRY;
        if (!open[entry] || !(alive[entry] > 0)) continue;
        const soft_vector p = soft_pull_at(e, inv_shape, soft_row(area, entry));
        sum = soft_add_square(sum, REAL(1) / SQRT(soft_dot(p, p)),
                              (soft_vector){xx * p.x + xy * p.y + xz * p.z, yy * p.y + yz * p.z, zz * p.z});
    }
    return failure_principal_of(sum).first;
}

/* Open faces of every element, those that it leads, and their reach: the sum of |A^-1 s| over them (softening.h), and
 * not below soft_together; and the weakest limit of those still whole. */
KERNEL void soft_count(int n, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) alive, OWN(int) open, OWN(int) lead,
                       OWN(coeff) limit, OWN(coeff) area, OWN(coeff) offset, OWN(coeff) inv_shape,
                       GATHER(coeff) inv_volume, GATHER(coeff) plane, GATHER(coeff) modulus, PUT(int) n_open,
                       PUT(int) n_lead, PUT(coeff) reach, PUT(coeff) least)
{
    FOR_EACH_ITEM(e, n) {
        int count = 0, leads = 0;
        coeff sum = 0, weakest = CELLS_NEVER;
        for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
            const brc_size entry = SOFT_ENTRY;
            weakest = limit[entry] < weakest ? limit[entry] : weakest;
            if (!open[entry] || !(alive[entry] > 0)) continue;
            const soft_vector p = soft_pull_at(e, inv_shape, soft_row(area, entry));
            sum += SQRT(soft_dot(p, p));
            count += 1;
            leads += lead[entry] != 0;
        }
        n_open[e] = count;
        n_lead[e] = leads;
        least[e] = weakest;
        reach[e] = sum;
        if (count) {
            const failure_stress sways =
                soft_sways(e, row_start, neighbour, alive, area, offset, inv_volume, plane, modulus);
            const coeff together = soft_together(e, sways, row_start, alive, open, area, inv_shape);
            reach[e] = together > sum ? together : sum; /* sum where directions that nothing spans leave no number */
        }
    }
}

/* The list of softening_face.cl. first [n]: faces that the elements before lead. */
KERNEL void soft_list(int n, OWN(int) row_start, OWN(coeff) alive, OWN(int) open, OWN(int) lead, OWN(int) n_lead,
                      OWN(int) first, SCATTER(int) face_row, SCATTER(int) face_entry)
{
    FOR_EACH_ITEM(e, n) {
        int to = first[e];
        for (int slot = row_start[e / C]; n_lead[e] && slot < row_start[e / C + 1]; ++slot) {
            const brc_size entry = SOFT_ENTRY;
            if (!open[entry] || !lead[entry] || !(alive[entry] > 0)) continue;
            face_row[to] = e;
            face_entry[to] = (int)entry;
            to += 1;
        }
    }
}

#undef SOFT_LANE
#undef SOFT_ENTRY
#undef SOFT_NUMBER
#undef SOFT_IS_SLIDING
