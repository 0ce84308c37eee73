/* Cells of dlsm that have lost all their bonds: rigid bodies about their places, where their mass is. momentum: of turning [n][3]; turned: quaternions since the reference
 * [n][4]; inertia: of the polyhedron about its mass centre xx yy zz yz xz xy [n][6]; rigid [n]: 1, else 0; way [n]: the sum over the steps of how far turning can have moved any point
 * of the cell, no less [m] (contact_rests). reach [n]: radius about the place that holds the cell [m]. */

/* The rotation nearest to I + H, by Newton's iteration R <- (R + R^-T) / 2; unity where there is none. */
LAW smat3 contact_polar(smat3 f)
{
    if (!(smat3_det(f) > 0)) return (smat3){1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (int round = 0; round < 12; ++round) f = smat3_scale(STATE(0.5), smat3_add(f, smat3_transpose(smat3_inverse(f))));
    return f;
}
/* The quaternion of a rotation matrix, from its largest component. */
LAW squat contact_quaternion(smat3 r)
{
    const state ww = STATE(1) + r.xx + r.yy + r.zz, xx = STATE(1) + r.xx - r.yy - r.zz, yy = STATE(1) - r.xx + r.yy - r.zz, zz = STATE(1) - r.xx - r.yy + r.zz;
    if (ww >= xx && ww >= yy && ww >= zz) return squat_normalised((squat){ww, r.zy - r.yz, r.xz - r.zx, r.yx - r.xy});
    if (xx >= yy && xx >= zz) return squat_normalised((squat){r.zy - r.yz, xx, r.yx + r.xy, r.xz + r.zx});
    if (yy >= zz) return squat_normalised((squat){r.xz - r.zx, r.yx + r.xy, yy, r.zy + r.yz});
    return squat_normalised((squat){r.yx - r.xy, r.xz + r.zx, r.zy + r.yz, zz});
}

/* Cells without bonds, which are exposed, become rigid: they keep the rotation of their deformation and begin without spin, since a cell's mass is a point. found [n]: rigid ones. */
KERNEL void contact_detach(int n, GLOBAL const int *restrict exposed, GLOBAL const int *restrict id, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                           GLOBAL const coeff *restrict gradient, GLOBAL int *restrict rigid, GLOBAL state *restrict turned, GLOBAL state *restrict found)
{
    FOR_EACH_ITEM(e, n) {
        int bonds = 0;
        if (exposed[e] && !rigid[e] && id[e] >= 0) {
            for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) bonds += neighbour[(brc_size)slot * C + e % C] != e;
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

/* Rigid cells have no bonds that could be near their limit: room for any stress (cells.cl, spare). */
KERNEL void contact_no_bonds(int n, GLOBAL const int *restrict rigid, GLOBAL coeff *restrict spare)
{
    FOR_EACH_ITEM(e, n) {
        if (rigid[e]) spare[e] = REAL(1e30);
    }
}

/* H of rigid cells: their rotation, so that everything that reads H sees where they are, and no strain. */
KERNEL void contact_pose(int n, GLOBAL const int *restrict rigid, GLOBAL const state *restrict turned, GLOBAL coeff *restrict gradient)
{
    FOR_EACH_ITEM(e, n) {
        if (rigid[e]) {
            const smat3 r = squat_matrix_minus_identity(squat_load(turned, e));
            GLOBAL coeff *restrict to = gradient + (brc_size)e * 9;
            to[0] = (coeff)r.xx, to[1] = (coeff)r.xy, to[2] = (coeff)r.xz, to[3] = (coeff)r.yx, to[4] = (coeff)r.yy, to[5] = (coeff)r.yz;
            to[6] = (coeff)r.zx, to[7] = (coeff)r.zy, to[8] = (coeff)r.zz;
        }
    }
}

LAW ssym3 ssym3_load(GLOBAL const state *restrict p, int e)
{
    GLOBAL const state *restrict q = p + (brc_size)e * 6;
    return (ssym3){q[0], q[1], q[2], q[3], q[4], q[5]};
}

/* How far a turn from one rotation to another moves a point at distance 1, no less than that beside rounding [-]: the chord, 2 sin of half the angle. */
LAW state contact_chord(squat from, squat to)
{
    const squat turn = squat_mul(rigid_back(from), to);
    return STATE(2.000002) * SQRT_STATE(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z) + STATE(8) * convex_rounding();
}

/* momentum += kick torque, then free turning for drift with what extra torque adds (advance_rotation, rigid.h). */
KERNEL void contact_turn(int n, state kick, state drift, state extra, GLOBAL const int *restrict rigid, GLOBAL const state *restrict inertia,
                         GLOBAL const state *restrict torque, GLOBAL const state *restrict reach, GLOBAL state *restrict momentum, GLOBAL state *restrict turned,
                         GLOBAL state *restrict way)
{
    FOR_EACH_ITEM(e, n) {
        if (rigid[e]) {
            const svec3 t = svec3_load(torque, (brc_size)e * 3), l = svec3_add_scaled(svec3_load(momentum, (brc_size)e * 3), kick, t);
            svec3_store(momentum, (brc_size)e * 3, l);
            if (drift != 0) {
                const squat was = squat_load(turned, e), q = rigid_drift(was, ssym3_load(inertia, e), svec3_add_scaled(l, extra / drift, t), drift);
                GLOBAL state *restrict to = turned + (brc_size)e * 4;
                way[e] += reach[e] * contact_chord(was, q) + STATE(2) * convex_rounding() * way[e]; /* and no less for the rounding of the sum */
                to[0] = q.w, to[1] = q.x, to[2] = q.y, to[3] = q.z;
            }
        }
    }
}

/* l.I^-1 l / 2 [J]; 0 of cells that are not rigid. */
KERNEL void contact_spin_energy(int n, GLOBAL const int *restrict rigid, GLOBAL const state *restrict inertia, GLOBAL const state *restrict momentum,
                                GLOBAL const state *restrict turned, GLOBAL state *restrict out)
{
    FOR_EACH_ITEM(e, n) {
        out[e] = 0;
        if (rigid[e]) {
            const svec3 p = rigid_rotate(rigid_back(squat_load(turned, e)), svec3_load(momentum, (brc_size)e * 3));
            const svec3 w = rigid_solve(ssym3_load(inertia, e), p);
            out[e] = STATE(0.5) * svec3_dot(w, p);
        }
    }
}
