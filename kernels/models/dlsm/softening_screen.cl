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

/* Elements look whose own stress is above screen * share * limit of their weakest bond, as the largest principal value
 * is not above the Frobenius norm, or that have open faces. */
LAW soft_members soft_looking(members who, lane_mat3 gradient, lane_mat3 stress, coeff screen, coeff weakest,
                              OWN(int) n_open, OWN(coeff) least)
{
    const lane none = LANE_ZERO;
    const lane strain = soft_square(gradient), square = soft_square(stress);
    const lane bound = screen * lane_min(members_number(who, least), none + weakest) / (REAL(1) + LANE_SQRT(strain));
    const lane room = bound * bound - square;
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

/* Half of a limit of shear, which is below 0 along interfaces. */
LAW lane soft_half_of(lane shear_limit) { return REAL(0.5) * lane_max(shear_limit, -shear_limit); }

/* Of the bonds in a slot: limit of the largest principal stress [Pa]; no plane slides where reach times the norm is
 * below shear [Pa] (reach 0: none slides at all). */
typedef struct {
    lane limit, shear;
    coeff reach;
} soft_bounds;

/* Bits of the bonds in a slot whose stress (soft_stress: the mean of the cells' with the traction of the bond) may be
 * above a limit. gradient, stress: sums over the two cells; pull: the bond's. */
LAW int soft_near(lane_mat3 gradient, lane_sym3 stress, dlsm_pull pull, soft_bounds below)
{
    const lane middle = LANE_ZERO + REAL(0.5), tiny = LANE_ZERO + REAL(1e-30), one = LANE_ZERO + REAL(1);
    const lane per = one / below.limit; /* so that no limit, 1e30 Pa, overflows nothing */
    const lane_vec3 branch = lane_vec3_scale(pull.ratio, pull.area);
    const lane_vec3 turned = lane_vec3_add(branch, lane_vec3_scale(middle, lane_mat3_mul_vec(gradient, branch)));
    const lane_vec3 n = lane_vec3_scale(one / LANE_SQRT(lane_vec3_dot(turned, turned) + tiny), turned);
    const lane over = per * pull.ratio / LANE_SQRT(lane_vec3_dot(branch, branch) + tiny); /* 1 / (area limit) */
    const lane_sym3 mean = lane_sym3_scale_shift(middle * per, stress, LANE_ZERO);
    const lane_vec3 own = lane_sym3_mul_vec(mean, n);
    const lane_vec3 t = {over * pull.force.x - own.x, over * pull.force.y - own.y, over * pull.force.z - own.z};
    const lane_vec3 m = lane_vec3_add(t, lane_vec3_scale(-middle * lane_vec3_dot(t, n), n));
    const lane xx = mean.xx + REAL(2) * m.x * n.x, yy = mean.yy + REAL(2) * m.y * n.y,
               zz = mean.zz + REAL(2) * m.z * n.z, yz = mean.yz + m.y * n.z + m.z * n.y,
               xz = mean.xz + m.x * n.z + m.z * n.x, xy = mean.xy + m.x * n.y + m.y * n.x;
    const coeff near = REAL(0.998);
    const lane a = near - xx, b = near - yy, c = near - zz; /* failure_all_below */
    const lane minor = a * b - xy * xy;
    lane room = lane_min(lane_min(a, minor), c * minor - yz * (a * yz + xy * xz) - xz * (xy * yz + xz * b));
    if (below.reach > 0) {
        const lane square = xx * xx + yy * yy + zz * zz + REAL(2) * (yz * yz + xz * xz + xy * xy);
        room = lane_min(room, near * per * below.shear - below.reach * LANE_SQRT(square));
    }
    int out = 0;
    if (!LANE_ANY_SHORT(room, LANE_ZERO)) return out;
#define NEAR(l) out |= !(LANE_ITEM(room, l) >= 0) << 0x##l;
    LANE_EACH(NEAR)
#undef NEAR
    return out;
}
