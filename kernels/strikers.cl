/* Motion of strikers, rigid bodies beside the elements: one work-item does one striker. Arrays: displacement, velocity, momentum (of turning, about the mass centre,
 * in the frame of space), spin, force and torque (of contact) [n][3]; orientation since the start of the scene, quaternions w x y z [n][4]; mass [n];
 * inertia about the mass centre as the scene starts xx yy zz yz xz xy [n][6]. freedom [n]: bits 1 2 4 free to move along x y z, 8 free to turn; 0 for
 * strikers that stand still or are driven. moved [n][6]: how far each moved and turned since the last booking. */

LAW rigid_vec striker_vec(GLOBAL const state *restrict p, int i) { return (rigid_vec){p[3 * i], p[3 * i + 1], p[3 * i + 2]}; }
LAW rigid_sym striker_inertia(GLOBAL const state *restrict p, int i)
{
    return (rigid_sym){p[6 * i], p[6 * i + 1], p[6 * i + 2], p[6 * i + 3], p[6 * i + 4], p[6 * i + 5]};
}
LAW rigid_quat striker_quat(GLOBAL const state *restrict p, int i) { return (rigid_quat){p[4 * i], p[4 * i + 1], p[4 * i + 2], p[4 * i + 3]}; }
LAW void striker_put(GLOBAL state *restrict p, int i, rigid_vec a)
{
    p[3 * i] = a.x;
    p[3 * i + 1] = a.y;
    p[3 * i + 2] = a.z;
}
LAW void striker_put_quat(GLOBAL state *restrict p, int i, rigid_quat q)
{
    p[4 * i] = q.w;
    p[4 * i + 1] = q.x;
    p[4 * i + 2] = q.y;
    p[4 * i + 3] = q.z;
}
/* 1 where a bit of freedom is set. */
LAW state striker_free(int freedom, int bit) { return freedom & bit ? STATE(1) : STATE(0); }

/* Free strikers: v += kick f / m, l += kick T; moved by drift with v + extra f / m and l + extra T. As elements: extra is (phi - 1) dt for Tchamwa-Wielgosz,
 * whose own loss begins to be booked here (numerical 1, motion.cl), else 0. g: gravity [m/s^2]. */
KERNEL void striker_advance(int n, state kick, state drift, state extra, int numerical, state gx, state gy, state gz, GLOBAL const int *restrict freedom,
                            GLOBAL const state *restrict mass, GLOBAL const state *restrict inertia, GLOBAL const state *restrict force,
                            GLOBAL const state *restrict torque, GLOBAL state *restrict velocity, GLOBAL state *restrict momentum,
                            GLOBAL state *restrict spin, GLOBAL state *restrict displacement, GLOBAL state *restrict orientation,
                            GLOBAL state *restrict moved, GLOBAL state *restrict lost)
{
    FOR_EACH_ITEM(i, n) {
        const int bits = freedom[i];
        if (bits & 7) {
            const rigid_vec f = striker_vec(force, i);
            const rigid_vec a = {striker_free(bits, 1) * (f.x / mass[i] + gx), striker_free(bits, 2) * (f.y / mass[i] + gy),
                                 striker_free(bits, 4) * (f.z / mass[i] + gz)};
            const rigid_vec v = rigid_add(striker_vec(velocity, i), rigid_scale(kick, a)), u = rigid_scale(drift, rigid_add(v, rigid_scale(extra, a)));
            striker_put(velocity, i, v);
            striker_put(displacement, i, rigid_add(striker_vec(displacement, i), u));
            moved[6 * i] += u.x;
            moved[6 * i + 1] += u.y;
            moved[6 * i + 2] += u.z;
            if (numerical) lost[i] += mass[i] * ((extra + STATE(0.5) * drift) * drift * rigid_dot(a, a) - STATE(0.5) * rigid_dot(u, a));
        }
        if (bits & 8) {
            const rigid_sym own = striker_inertia(inertia, i);
            const rigid_vec t = striker_vec(torque, i), l = rigid_add(striker_vec(momentum, i), rigid_scale(kick, t));
            const rigid_vec drifting = rigid_add(l, rigid_scale(extra, t));
            const rigid_quat before = striker_quat(orientation, i), q = rigid_drift(before, own, drifting, drift);
            striker_put(momentum, i, l);
            striker_put_quat(orientation, i, q);
            striker_put(spin, i, rigid_spin(q, own, l));
            if (numerical) {
                const rigid_vec turn = rigid_scale(drift, rigid_spin(before, own, drifting));
                lost[i] += (extra + STATE(0.5) * drift) * drift * rigid_dot(rigid_spin(before, own, t), t) - STATE(0.5) * rigid_dot(turn, t);
                moved[6 * i + 3] += turn.x;
                moved[6 * i + 4] += turn.y;
                moved[6 * i + 5] += turn.z;
            }
        }
    }
}

/* Put driven striker `which` where it is: displacement u, orientation q, velocity v, spin w; it moved by m and turned by t (a rotation vector) since the last
 * booking. */
KERNEL void striker_place(int n, int which, state ux, state uy, state uz, state qw, state qx, state qy, state qz, state vx, state vy, state vz,
                          state wx, state wy, state wz, state mx, state my, state mz, state tx, state ty, state tz,
                          GLOBAL state *restrict displacement, GLOBAL state *restrict orientation, GLOBAL state *restrict velocity,
                          GLOBAL state *restrict spin, GLOBAL state *restrict moved)
{
    FOR_EACH_ITEM(k, n) {
        const int i = which + k;
        striker_put(displacement, i, (rigid_vec){ux, uy, uz});
        striker_put_quat(orientation, i, (rigid_quat){qw, qx, qy, qz});
        striker_put(velocity, i, (rigid_vec){vx, vy, vz});
        striker_put(spin, i, (rigid_vec){wx, wy, wz});
        moved[6 * i] += mx;
        moved[6 * i + 1] += my;
        moved[6 * i + 2] += mz;
        moved[6 * i + 3] += tx;
        moved[6 * i + 4] += ty;
        moved[6 * i + 5] += tz;
    }
}

/* After the forces of a step. Strikers that are not free do work on what they touch, - (force . way + torque . turn) by the trapezoidal rule as impose_book
 * (motion.cl); free ones end the booking of the integrator's own loss (numerical 1). g: gravity. book: 0 nothing; 1 add; 2 start here. last [n][6]: force and torque at
 * the last booking. */
KERNEL void striker_book(int n, int book, int numerical, state gx, state gy, state gz, GLOBAL const int *restrict freedom, GLOBAL const state *restrict mass,
                         GLOBAL const state *restrict force, GLOBAL const state *restrict torque, GLOBAL state *restrict moved,
                         GLOBAL state *restrict last, GLOBAL state *restrict work, GLOBAL state *restrict lost)
{
    FOR_EACH_ITEM(i, n) {
        if (book) {
            const state g[3] = {mass[i] * gx, mass[i] * gy, mass[i] * gz};
            state sum = 0, now_sum = 0;
            for (int c = 0; c < 6; ++c) {
                const state now = c < 3 ? force[3 * i + c] : torque[3 * i + c - 3];
                const state pull = now + (c < 3 ? g[c] : STATE(0));
                sum -= STATE(0.5) * (last[6 * i + c] + now) * moved[6 * i + c];
                now_sum += (freedom[i] >> (c < 3 ? c : 3) & 1) ? STATE(0.5) * pull * moved[6 * i + c] : STATE(0);
                last[6 * i + c] = now;
                moved[6 * i + c] = 0;
            }
            if (book == 1 && freedom[i] == 0) work[i] += sum;
            if (book == 1 && numerical && freedom[i] != 0) lost[i] += now_sum;
        }
    }
}
