/* Cells of dlsm that have lost all their bonds: rigid bodies about their places, where their mass is. momentum: of
 * turning [n][3]; turned: quaternions since the reference [n][4]; inertia: of the polyhedron about its mass centre xx
 * yy zz yz xz xy [n][6]; rigid [n]: 1, else 0; way [n]: the sum over the steps of how far turning can have moved any
 * point of the cell, no less [m] (contact_rests). bounding_radius [n]: radius about the place that holds the cell [m].
 */

/* The rotation nearest to I + H, by Newton's iteration R <- (R + R^-T) / 2; unity where there is none. */
LAW smat3 contact_polar(smat3 f)
{
    if (!(smat3_det(f) > 0)) return (smat3){1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (int round = 0; round < 12; ++round)
        f = smat3_scale(STATE(0.5), smat3_add(f, smat3_transpose(smat3_inverse(f))));
    return f;
}
/* The quaternion of a rotation matrix, from its largest component. */
LAW squat contact_quaternion(smat3 r)
{
    const state ww = STATE(1) + r.xx + r.yy + r.zz, xx = STATE(1) + r.xx - r.yy - r.zz,
                yy = STATE(1) - r.xx + r.yy - r.zz, zz = STATE(1) - r.xx - r.yy + r.zz;
    if (ww >= xx && ww >= yy && ww >= zz) return squat_normalised((squat){ww, r.zy - r.yz, r.xz - r.zx, r.yx - r.xy});
    if (xx >= yy && xx >= zz) return squat_normalised((squat){r.zy - r.yz, xx, r.yx + r.xy, r.xz + r.zx});
    if (yy >= zz) return squat_normalised((squat){r.xz - r.zx, r.yx + r.xy, yy, r.zy + r.yz});
    return squat_normalised((squat){r.yx - r.xy, r.xz + r.zx, r.zy + r.yz, zz});
}

/* Cells without bonds, which are exposed, become rigid: they keep the rotation of their deformation and begin without
 * spin, since a cell's mass is a point. Those whose faces a load holds or pulls (loaded [n]: 1, else 0) do not turn:
 * their H stays 0, by which held faces and tractions act on them. found [n]: rigid ones. */
KERNEL void contact_detach(int n_rows, OWN(int) exposed, OWN(int) id, OWN(int) loaded, OWN(int) row_start,
                           OWN(int) neighbour, OWN(coeff) gradient, UPDATE(int) rigid, UPDATE(state) turned,
                           PUT(state) found)
{
    FOR_EACH_ITEM(e, n_rows) {
        int bonds = 0;
        if (exposed[e] && !rigid[e] && !loaded[e] && id[e] >= 0) {
            for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot)
                bonds += neighbour[(brc_size)slot * C + e % C] != e;
            if (bonds == 0) {
                const squat q = contact_quaternion(contact_polar(contact_map(1, gradient, turned, e)));
                GLOBAL state *restrict to = turned + (brc_size)e * 4;
                rigid[e] = 1;
                to[0] = q.w, to[1] = q.x, to[2] = q.y, to[3] = q.z;
            }
        }
        found[e] = rigid[e] ? STATE(1) : STATE(0);
    }
}

/* H of rigid cells: their rotation, so that everything that reads H sees where they are, and no strain. */
KERNEL void contact_pose(int n_rows, OWN(int) rigid, OWN(state) turned, PUT(coeff) gradient)
{
    FOR_EACH_ITEM(e, n_rows) {
        if (rigid[e]) {
            const smat3 r = squat_matrix_minus_identity(squat_load(turned, e));
            GLOBAL coeff *restrict to = gradient + (brc_size)e * 9;
            to[0] = (coeff)r.xx, to[1] = (coeff)r.xy, to[2] = (coeff)r.xz, to[3] = (coeff)r.yx, to[4] = (coeff)r.yy,
            to[5] = (coeff)r.yz;
            to[6] = (coeff)r.zx, to[7] = (coeff)r.zy, to[8] = (coeff)r.zz;
        }
    }
}

LAW ssym3 ssym3_load(OWN(state) p, int e)
{
    GLOBAL const state *restrict q = p + (brc_size)e * 6;
    return (ssym3){q[0], q[1], q[2], q[3], q[4], q[5]};
}

/* Numbers of W bodies side by side. */
typedef struct {
    state x[W], y[W], z[W];
} svec_lanes;
typedef struct {
    state xx[W], yy[W], zz[W], yz[W], xz[W], xy[W];
} ssym3_lanes;
LAW svec3 svec_get(const svec_lanes *a, int l) { return (svec3){a->x[l], a->y[l], a->z[l]}; }
LAW void svec_put(svec_lanes *a, int l, svec3 b) { a->x[l] = b.x, a->y[l] = b.y, a->z[l] = b.z; }
LAW ssym3 ssym3_get(const ssym3_lanes *a, int l)
{
    return (ssym3){a->xx[l], a->yy[l], a->zz[l], a->yz[l], a->xz[l], a->xy[l]};
}
LAW void ssym3_put(ssym3_lanes *a, int l, ssym3 b)
{
    a->xx[l] = b.xx, a->yy[l] = b.yy, a->zz[l] = b.zz, a->yz[l] = b.yz, a->xz[l] = b.xz, a->xy[l] = b.xy;
}

/* How far a turn from one rotation to another moves a point at distance 1, no less than that beside rounding [-]: the
 * chord, 2 sin of half the angle. */
LAW state contact_chord(squat from, squat to)
{
    const squat turn = squat_mul(rigid_back(from), to);
    return STATE(2.000002) * SQRT_STATE(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z) +
           STATE(8) * STATE_ROUNDING;
}

/* momentum += kick torque, then free turning for drift with what extra torque adds (rigid_drift, for W cells side by
 * side; cells that are not rigid take part and keep what they have). */
KERNEL void contact_turn(int n_groups, state kick, state drift, state extra, OWN(int) rigid, OWN(state) inertia,
                         OWN(state) torque, OWN(state) bounding_radius, UPDATE(state) momentum, UPDATE(state) turned,
                         UPDATE(state) way)
{
    FOR_EACH_ITEM(group, n_groups) {
        const brc_size begin = (brc_size)group * W;
        svec_lanes p, w, imaginary;
        ssym3_lanes inverse;
        state last[W], real[W], chord[W];
        int goes[W], any = 0;
        FOR_LANES_ANY(l, any) any |= rigid[begin + l];
        if (any && kick != 0) {
            FOR_LANES(l) {
                const svec3 was = svec3_load(momentum, (begin + l) * 3),
                            now = svec3_add_scaled(was, kick, svec3_load(torque, (begin + l) * 3));
                svec3_store(momentum, (begin + l) * 3, svec3_choose(rigid[begin + l], now, was));
            }
        }
        if (any && drift != 0) {
            any = 0;
            FOR_LANES_ANY(l, any) {
                const svec3 spun = svec3_add_scaled(svec3_load(momentum, (begin + l) * 3), extra / drift,
                                                    svec3_load(torque, (begin + l) * 3));
                const svec3 own = rigid_rotate(rigid_back(squat_load(turned, (int)(begin + l))), spun);
                const ssym3 free = rigid_inverse(ssym3_load(inertia, (int)(begin + l)));
                const svec3 first = rigid_mul(free, own);
                svec_put(&p, l, own);
                svec_put(&w, l, first);
                ssym3_put(&inverse, l, free);
                last[l] = svec3_dot(first, first);
                goes[l] = rigid[begin + l];
                any |= goes[l];
            }
            for (int round = 0; round < RIGID_ROUNDS && any; ++round) {
                any = 0;
                FOR_LANES_ANY(l, any) {
                    const svec3 was = svec_get(&w, l),
                                next = rigid_round(ssym3_get(&inverse, l), svec_get(&p, l), was, drift),
                                off = svec3_sub(next, was);
                    const state change = svec3_dot(off, off);
                    const int goes_on = goes[l] & rigid_goes_on(change, last[l], next);
                    svec_put(&w, l, svec3_choose(goes[l], next, was));
                    goes[l] = goes_on;
                    last[l] = change;
                    any |= goes_on;
                }
            }
            FOR_LANES(l) {
                const brc_size at = (begin + l) * 4;
                const squat was = {turned[at], turned[at + 1], turned[at + 2], turned[at + 3]},
                            q = rigid_turned(was, svec_get(&w, l), drift);
                svec_put(&imaginary, l, (svec3){q.x, q.y, q.z});
                real[l] = q.w;
                chord[l] = contact_chord(was, q);
            }
            for (int l = 0; l < W; ++l) {
                const brc_size e = begin + l;
                GLOBAL state *restrict to = turned + e * 4;
                if (rigid[e]) {
                    way[e] += bounding_radius[e] * chord[l] +
                              STATE(2) * STATE_ROUNDING * way[e]; /* and no less for the rounding of the sum */
                    to[0] = real[l], to[1] = imaginary.x[l], to[2] = imaginary.y[l], to[3] = imaginary.z[l];
                }
            }
        }
    }
}

/* l.I^-1 l / 2 [J]; 0 of cells that are not rigid. */
KERNEL void contact_spin_energy(int n_rows, OWN(int) rigid, OWN(state) inertia, OWN(state) momentum, OWN(state) turned,
                                PUT(state) out)
{
    FOR_EACH_ITEM(e, n_rows) {
        out[e] = 0;
        if (rigid[e]) {
            const svec3 p = rigid_rotate(rigid_back(squat_load(turned, e)), svec3_load(momentum, (brc_size)e * 3));
            const svec3 w = rigid_solve(ssym3_load(inertia, e), p);
            out[e] = STATE(0.5) * svec3_dot(w, p);
        }
    }
}
