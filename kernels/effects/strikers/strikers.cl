/* Motion of strikers, rigid bodies beside the elements: one work-item does one striker. What contact reads and writes:
 * pose [n][12], the place of the mass centre [m] and the rotation matrix by rows; motion [n][6], velocity of the centre
 * and angular velocity; load [n][6], force of the elements on it and their torque about the centre; all in the frame of
 * space. Besides: displacement [n][3] of the centre, centre [n][3] as the scene starts; orientation since then,
 * quaternions w x y z [n][4]; momentum of turning about the centre [n][3]; mass [n]; inertia about the centre as the
 * scene starts, xx yy zz yz xz xy [n][6]. freedom [n]: bits 1 2 4 free to move along x y z, 8 free to turn, 16 pushed
 * by a prescribed force; 0 for strikers that stand still or are driven. push [n][3]: that force, on the mass centre,
 * not in load; read of pushed ones only. moved [n][6]: how far each moved and turned since the last booking. */

LAW svec3 striker_vec(OWN(state) p, int at) { return (svec3){p[at], p[at + 1], p[at + 2]}; }
LAW ssym3 striker_inertia(OWN(state) p, int i)
{
    return (ssym3){p[6 * i], p[6 * i + 1], p[6 * i + 2], p[6 * i + 3], p[6 * i + 4], p[6 * i + 5]};
}
LAW squat striker_quat(OWN(state) p, int i) { return (squat){p[4 * i], p[4 * i + 1], p[4 * i + 2], p[4 * i + 3]}; }
LAW void striker_put(PUT(state) p, int at, svec3 a)
{
    p[at] = a.x;
    p[at + 1] = a.y;
    p[at + 2] = a.z;
}
LAW void striker_add(UPDATE(state) p, int at, svec3 a)
{
    p[at] += a.x;
    p[at + 1] += a.y;
    p[at + 2] += a.z;
}
LAW void striker_put_pose(PUT(state) pose, PUT(state) orientation, int i, svec3 place, squat q)
{
    const smat3 r = squat_matrix(q);
    orientation[4 * i] = q.w;
    orientation[4 * i + 1] = q.x;
    orientation[4 * i + 2] = q.y;
    orientation[4 * i + 3] = q.z;
    striker_put(pose, 12 * i, place);
    striker_put(pose, 12 * i + 3, (svec3){r.xx, r.xy, r.xz});
    striker_put(pose, 12 * i + 6, (svec3){r.yx, r.yy, r.yz});
    striker_put(pose, 12 * i + 9, (svec3){r.zx, r.zy, r.zz});
}
/* 1 where a bit of freedom is set. */
LAW state striker_free(int freedom, int bit) { return freedom & bit ? STATE(1) : STATE(0); }

/* What moves the mass centre of a free striker but gravity. */
LAW svec3 striker_force(OWN(state) load, OWN(state) push, int bits, int i)
{
    const svec3 f = striker_vec(load, 6 * i);
    return bits & 16 ? svec3_add(f, striker_vec(push, 3 * i)) : f;
}

/* Free strikers: v += kick f / m, l += kick T; moved by drift with v + extra f / m and l + extra T. As elements: extra
 * is (phi - 1) dt for Tchamwa-Wielgosz, whose own loss begins to be booked here (numerical 1, motion.cl), else 0. g:
 * gravity [m/s^2]. */
KERNEL void striker_advance(int n, state kick, state drift, state extra, int numerical, state gx, state gy, state gz,
                            OWN(int) freedom, OWN(state) mass, OWN(state) inertia, OWN(state) centre, OWN(state) load,
                            OWN(state) push, UPDATE(state) motion, UPDATE(state) momentum, UPDATE(state) displacement,
                            UPDATE(state) orientation, PUT(state) striker_pose, UPDATE(state) moved, UPDATE(state) lost)
{
    FOR_EACH_ITEM(i, n) {
        const int bits = freedom[i];
        if (bits) {
            const svec3 f = striker_force(load, push, bits, i),
                        t = svec3_scale(striker_free(bits, 8), striker_vec(load, 6 * i + 3));
            const svec3 a = {striker_free(bits, 1) * (f.x / mass[i] + gx), striker_free(bits, 2) * (f.y / mass[i] + gy),
                             striker_free(bits, 4) * (f.z / mass[i] + gz)};
            const svec3 v = svec3_add(striker_vec(motion, 6 * i), svec3_scale(kick, a));
            const svec3 step = svec3_scale(drift, svec3_add(v, svec3_scale(extra, a))),
                        u = svec3_add(striker_vec(displacement, 3 * i), step);
            const ssym3 own = striker_inertia(inertia, i);
            const svec3 l = svec3_add(striker_vec(momentum, 3 * i), svec3_scale(kick, t)),
                        drifting = svec3_add(l, svec3_scale(extra, t));
            const squat before = striker_quat(orientation, i);
            squat q = before;
            if (bits & 8) q = rigid_drift(before, own, drifting, drift);
            if (numerical) {
                const svec3 turn = svec3_scale(drift * striker_free(bits, 8), rigid_spin(before, own, drifting));
                lost[i] += (extra + STATE(0.5) * drift) * drift *
                               (mass[i] * svec3_dot(a, a) + svec3_dot(rigid_spin(before, own, t), t)) -
                           STATE(0.5) * (mass[i] * svec3_dot(step, a) + svec3_dot(turn, t));
                striker_add(moved, 6 * i + 3, turn);
            }
            striker_add(moved, 6 * i, step);
            striker_put(displacement, 3 * i, u);
            striker_put(motion, 6 * i, v);
            if (bits & 8) striker_put(motion, 6 * i + 3, rigid_spin(q, own, l));
            striker_put(momentum, 3 * i, l);
            striker_put_pose(striker_pose, orientation, i, svec3_add(striker_vec(centre, 3 * i), u), q);
        }
    }
}

/* Put driven striker `which` where it is: displacement u, orientation q, velocity v, spin w; it moved by m and turned
 * by t (a rotation vector) since it was put last. */
KERNEL void striker_place(int n, int which, state ux, state uy, state uz, state qw, state qx, state qy, state qz,
                          state vx, state vy, state vz, state wx, state wy, state wz, state mx, state my, state mz,
                          state tx, state ty, state tz, OWN(state) centre, PUT(state) motion, PUT(state) displacement,
                          PUT(state) orientation, PUT(state) striker_pose, UPDATE(state) moved)
{
    FOR_EACH_ITEM(k, n) {
        const int i = which + k;
        const svec3 u = {ux, uy, uz};
        striker_put(displacement, 3 * i, u);
        striker_put(motion, 6 * i, (svec3){vx, vy, vz});
        striker_put(motion, 6 * i + 3, (svec3){wx, wy, wz});
        striker_put_pose(striker_pose, orientation, i, svec3_add(striker_vec(centre, 3 * i), u),
                         (squat){qw, qx, qy, qz});
        striker_add(moved, 6 * i, (svec3){mx, my, mz});
        striker_add(moved, 6 * i + 3, (svec3){tx, ty, tz});
    }
}

/* The prescribed force on striker `which`, from here on [N]. */
KERNEL void striker_push(int n, int which, state fx, state fy, state fz, PUT(state) push)
{
    FOR_EACH_ITEM(k, n) striker_put(push, 3 * (which + k), (svec3){fx, fy, fz});
}

/* After the forces of a step. Strikers that are driven do work on what they touch, - (force . way + torque . turn) by
 * the trapezoidal rule as impose_book (motion.cl), and so do prescribed forces on free ones, push . way; free ones end
 * the booking of the integrator's own loss (numerical 1). g: gravity. book: 0 nothing; 1 add; 2 start here. last
 * [n][6]: the load at the last booking; pushed [n][3]: the push then. */
KERNEL void striker_book(int n, int book, int numerical, state gx, state gy, state gz, OWN(int) freedom,
                         OWN(state) mass, OWN(state) load, OWN(state) push, UPDATE(state) moved, UPDATE(state) last,
                         UPDATE(state) pushed, UPDATE(state) work, UPDATE(state) lost)
{
    FOR_EACH_ITEM(i, n) {
        if (book) {
            const int bits = freedom[i];
            const svec3 way = striker_vec(moved, 6 * i), turn = striker_vec(moved, 6 * i + 3),
                        f = striker_vec(load, 6 * i), t = striker_vec(load, 6 * i + 3);
            const svec3 weight = {mass[i] * gx, mass[i] * gy, mass[i] * gz}, none = {STATE(0), STATE(0), STATE(0)};
            if (book == 1 && bits == 0)
                work[i] -= STATE(0.5) * (svec3_dot(svec3_add(striker_vec(last, 6 * i), f), way) +
                                         svec3_dot(svec3_add(striker_vec(last, 6 * i + 3), t), turn));
            if (book == 1 && numerical && bits)
                lost[i] += STATE(0.5) *
                           (svec3_dot(svec3_add(striker_force(load, push, bits, i), weight), way) + svec3_dot(t, turn));
            if (bits & 16) {
                const svec3 p = striker_vec(push, 3 * i);
                if (book == 1) work[i] += STATE(0.5) * svec3_dot(svec3_add(striker_vec(pushed, 3 * i), p), way);
                striker_put(pushed, 3 * i, p);
            }
            striker_put(last, 6 * i, f);
            striker_put(last, 6 * i + 3, t);
            striker_put(moved, 6 * i, none);
            striker_put(moved, 6 * i + 3, none);
        }
    }
}
