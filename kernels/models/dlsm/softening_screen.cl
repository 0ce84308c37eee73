/* Which bonds of a group of elements soft_check (softening_onset.cl) looks at one by one: lanes know the stress at a
 * bond as it does, and that none of it is above the limit, at a twentieth of the price of principal values. Margins are
 * wider than there, for the rounding of both. */

/* Rows of elements as bits of a group: which look at their bonds (soft_looking), and which have open faces. */
typedef struct {
    int looking, open;
} soft_members;

LAW lane soft_square(lane_mat3 a)
{
    return a.xx * a.xx + a.xy * a.xy + a.xz * a.xz + a.yx * a.yx + a.yy * a.yy + a.yz * a.yz + a.zx * a.zx +
           a.zy * a.zy + a.zz * a.zz;
}

/* Room that the largest principal value leaves below a limit, 0 or more where it is not above. */
LAW lane soft_room_below(lane_sym3 s, lane limit)
{
    const lane a = limit - s.xx, b = limit - s.yy, c = limit - s.zz, minor = a * b - s.xy * s.xy;
    return lane_min(lane_min(a, minor), c * minor - s.yz * (a * s.yz + s.xy * s.xz) - s.xz * (s.xy * s.yz + s.xz * b));
}

/* Elements look that have open faces, or whose largest principal stress and a part of the norm of the stress, by which
 * that of their bonds may differ, are above the limit of their weakest bond: that part counts as much as makes a pull
 * look from screen * limit on. Or, where there are limits of shear, whose sum of Mohr and Coulomb and what that part
 * adds to it at most, sqrt(2 + 2 slope^2) of it, are above the weakest of these, `weakest` [Pa]. */
LAW soft_members soft_looking(members who, lane_mat3 gradient, lane_mat3 stress, lane_sym3 present, coeff share,
                              coeff screen, int shears, coeff slope, coeff weakest, OWN(int) n_open, OWN(coeff) least)
{
    const lane norm = LANE_SQRT(soft_square(stress)) * (REAL(1) + LANE_SQRT(soft_square(gradient)));
    const lane limit = share * members_number(who, least), per = REAL(1) / limit; /* no limit, 1e30 Pa */
    const lane_sym3 part = lane_sym3_scale_shift(per, present, LANE_ZERO);
    const lane apart = (REAL(1) / screen - REAL(1)) * per * norm;
    lane room = soft_room_below(part, REAL(1) - apart);
    if (shears) {
        const lane sum = failure_slip_bound(failure_outer_of(part), slope);
        room = lane_min(room, share * weakest * per - (sum + SQRT(REAL(2) + REAL(2) * slope * slope) * apart));
    }
    soft_members out = {0, 0};
#define LOOKING(l)                                                                                                     \
    out.open |= (n_open[LANE_ITEM(who.own, l)] > 0) << 0x##l;                                                          \
    out.looking |= !(LANE_ITEM(room, l) >= 0) << 0x##l;
    LANE_EACH(LOOKING)
#undef LOOKING
    out.looking |= out.open;
    return out;
}

/* The stress of cells in the present frame, sym(P F_H^T) [Pa]. */
LAW lane_sym3 soft_present_stress(lane_mat3 gradient, lane_mat3 stress)
{
    return lane_mat3_sym(lane_mat3_add(stress, lane_mat3_mul(stress, lane_mat3_transpose(gradient))));
}

/* Size of a limit of shear, which is below 0 along interfaces. */
LAW lane soft_size_of(lane shear_limit) { return lane_max(shear_limit, -shear_limit); }

/* Of the bonds in a slot: limit of the largest principal stress, and of Mohr and Coulomb's sum, with its slope, where
 * `shears` [Pa]; least cosine of the normal to the axis of a tension that opens. */
typedef struct {
    lane limit, shear;
    int shears;
    coeff slope, steepest;
} soft_bounds;

/* Of a bond: its normal in the present frame, and 1 / (area limit) [1/N]. */
typedef struct {
    lane_vec3 normal;
    lane per, over; /* 1 / limit, so that no limit, 1e30 Pa, overflows nothing */
} soft_side_of_bond;
LAW soft_side_of_bond soft_side_at(lane_mat3 gradient, dlsm_pull pull, lane limit)
{
    const lane middle = LANE_ZERO + REAL(0.5), tiny = LANE_ZERO + REAL(1e-30), one = LANE_ZERO + REAL(1);
    const lane_vec3 branch = lane_vec3_scale(pull.ratio, pull.area);
    const lane_vec3 turned = lane_vec3_add(branch, lane_vec3_scale(middle, lane_mat3_mul_vec(gradient, branch)));
    const lane per = one / limit;
    return (soft_side_of_bond){lane_vec3_scale(one / LANE_SQRT(lane_vec3_dot(turned, turned) + tiny), turned), per,
                               per * pull.ratio / LANE_SQRT(lane_vec3_dot(branch, branch) + tiny)};
}
LAW int soft_short_of(lane room)
{
    int out = 0;
    if (!LANE_ANY_SHORT(room, LANE_ZERO)) return out;
#define NEAR(l) out |= !(LANE_ITEM(room, l) >= 0) << 0x##l;
    LANE_EACH(NEAR)
#undef NEAR
    return out;
}

/* Of the largest principal value of a bond that soft_drawn draws open, at most 1 / this: (1 + c) / (2 c) at the least
 * cosine c. */
#define SOFT_DRAWN_LEAST REAL(0.828427)
/* What draws a bond open at most, of any axis around (soft_pull_at_most): with T the pulls of the stress,
 * n.T n + |T n - (n.T n) n|, and as T is at most `first`, |T n|^2 is at most first n.T n. across: n.stress n, less than
 * n.T n by the pushes on n, at most `third`; all in one unit. */
LAW lane soft_drawn_bound(lane first, lane third, lane across)
{
    const lane zero = LANE_ZERO, n = lane_max(lane_min(first, across + lane_max(third, zero)), zero);
    return LANE_WHERE(LANE_LESS(n, REAL(0.8535) * first), n + LANE_SQRT(lane_max(n * (first - n), zero)),
                      REAL(1.2072) * first);
}

/* Bits of the bonds in a slot whose stress (soft_stress: the mean of the cells' with the traction of the bond) may be
 * above a limit. By tension alone it is not where the traction, sum of s_k c_k e_k over the principal axes, whose
 * cosines with the normal are c_k, is below steepest times the limit: then s1 c1 is. gradient, stress: sums over the
 * two cells; pull: the bond's. */
LAW int soft_near(lane_mat3 gradient, lane_sym3 stress, dlsm_pull pull, soft_bounds below)
{
    const lane middle = LANE_ZERO + REAL(0.5);
    const soft_side_of_bond side = soft_side_at(gradient, pull, below.limit);
    const lane_vec3 n = side.normal;
    const lane per = side.per, over = side.over;
    const lane_sym3 mean = lane_sym3_scale_shift(middle * per, stress, LANE_ZERO);
    const lane_vec3 own = lane_sym3_mul_vec(mean, n);
    const lane_vec3 t = {over * pull.force.x - own.x, over * pull.force.y - own.y, over * pull.force.z - own.z};
    const lane_vec3 m = lane_vec3_add(t, lane_vec3_scale(-middle * lane_vec3_dot(t, n), n));
    const lane xx = mean.xx + REAL(2) * m.x * n.x, yy = mean.yy + REAL(2) * m.y * n.y,
               zz = mean.zz + REAL(2) * m.z * n.z, yz = mean.yz + m.y * n.z + m.z * n.y,
               xz = mean.xz + m.x * n.z + m.z * n.x, xy = mean.xy + m.x * n.y + m.y * n.x;
    const coeff near = REAL(0.998);
    const lane_sym3 all = {xx, yy, zz, yz, xz, xy};
    lane room = soft_room_below(all, LANE_ZERO + near);
    const lane slide = near * per * below.shear;
    if (below.shears) {
        const lane even = REAL(0.33333333333333333) * lane_sym3_trace(all), left = slide - REAL(2) * below.slope * even;
        const lane_sym3 part = {xx - even, yy - even, zz - even, yz, xz, xy};
        const coeff most = REAL(2) + REAL(0.6667) * below.slope * below.slope; /* as failure_possible */
        room = lane_min(lane_min(room, left), left * left - most * lane_sym3_dot(part, part));
    } else {
        const coeff least = near * below.steepest;
        room = lane_max(room, least * least - over * over * lane_vec3_dot(pull.force, pull.force));
    }
    if (!LANE_ANY_SHORT(room, LANE_ZERO)) return 0;
    const failure_outer of = failure_outer_of(all); /* of few */
    const lane drawn = soft_drawn_bound(of.first, of.third, over * lane_vec3_dot(pull.force, n));
    const lane pulls = near * (REAL(1) / SOFT_DRAWN_LEAST) - lane_max(of.first, drawn);
    room = lane_max(room, below.shears ? lane_min(pulls, slide - failure_slip_bound(of, below.slope)) : pulls);
    return soft_short_of(room);
}

/* Bits of the bonds in a slot whose edge may be above the limit (soft_edge; uneven pulls as soft_uneven has them, of
 * which all counts). gradient, flux: of the own cells and those beside. */
LAW int soft_near_edge(lane_mat3 gradient, lane_mat3 gradient_beside, lane_mat3 flux, lane_mat3 flux_beside,
                       dlsm_pull pull, lane limit, coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau)
{
    const lane_vec3 s = pull.area;
    const soft_side_of_bond side = soft_side_at(lane_mat3_add(gradient, gradient_beside), pull, limit);
    lane_vec3 uneven = lane_mat3_mul_vec(lane_mat3_sub(flux, flux_beside), s);
#if BRC_MANY_MATERIALS
    (void)k_one, (void)ell_one, (void)beta, (void)one_plus_tau;
#else
    const lane ell = LANE_ZERO + ell_one;
    uneven = lane_vec3_sub(uneven, soft_own_part(gradient, s, REAL(0.5) * k_one, ell, beta, one_plus_tau));
    uneven = lane_vec3_add(uneven, soft_own_part(gradient_beside, s, REAL(0.5) * k_one, ell, beta, one_plus_tau));
#endif
    const lane tiny = LANE_ZERO + REAL(1e-30), across = side.over * lane_vec3_dot(pull.force, side.normal);
    const lane turning = LANE_SQRT(lane_vec3_dot(uneven, uneven)) * pull.ratio *
                         LANE_SQRT(LANE_SQRT(lane_vec3_dot(s, s) + tiny)) * side.over; /* ratio / sqrt(area) / limit */
    return soft_short_of(REAL(0.998) - (turning + lane_max(across, LANE_ZERO)));
}
