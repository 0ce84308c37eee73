/* Elements that turn: motion of orientations (unit quaternions w x y z [n][4]) and spins, for models whose elements
 * have rotations of their own. One work-item does one element. */

/* q <- exp(h) q, normalised; |h|, the half turn, is far below 1: cos and sin(|h|)/|h| by their series. */
LAW void orientation_turn(UPDATE(state) q, state hx, state hy, state hz)
{
    const state hh = hx * hx + hy * hy + hz * hz;
    const state c0 = STATE(1) - hh * (STATE(0.5) - hh * (STATE(1.0 / 24) - hh * STATE(1.0 / 720)));
    const state s0 = STATE(1) - hh * (STATE(1.0 / 6) - hh * (STATE(1.0 / 120) - hh * STATE(1.0 / 5040)));
    const state w = q[0], x = q[1], y = q[2], z = q[3], p = s0 * hx, r = s0 * hy, t = s0 * hz;
    const state nw = c0 * w - p * x - r * y - t * z, nx = c0 * x + p * w + r * z - t * y;
    const state ny = c0 * y - p * z + r * w + t * x, nz = c0 * z + p * y - r * x + t * w;
    const state scale = STATE(1) / SQRT_STATE(nw * nw + nx * nx + ny * ny + nz * nz);
    q[0] = scale * nw, q[1] = scale * nx, q[2] = scale * ny, q[3] = scale * nz;
}

/* Rotation: w += kick T / I [rad/s], then q <- exp(turn/2) q with turn = drift w_new + extra T / I [rad]; extra is
 * (phi - 1) dt^2 for Tchamwa-Wielgosz, else 0. inertia: mean moment of inertia of each cell [kg m^2]. still: as in
 * motion.cl [rad/s]. */
KERNEL void advance_rotation(int n_rows, state kick, state drift, state extra, state still, OWN(state) inertia,
                             OWN(state) torque, UPDATE(state) spin, UPDATE(state) orientation)
{
    FOR_EACH_ROW(e, n_rows) {
        state half_turn[3];
        for (int c = 0; c < 3; ++c) {
            const state was = spin[(brc_size)e * 3 + c], push = torque[(brc_size)e * 3 + c] / inertia[e];
            const state now = was + kick * push;
            const int rests = stays_at_rest(was, now, still);
            const state a = rests ? STATE(0) : push, w = rests ? was : now;
            spin[(brc_size)e * 3 + c] = w;
            half_turn[c] = STATE(0.5) * (drift * w + extra * a);
        }
        orientation_turn(orientation + (brc_size)e * 4, half_turn[0], half_turn[1], half_turn[2]);
    }
}

/* Rotational kinetic energy I w^2 / 2, added [J] [n]. */
KERNEL void add_spin_energy(int n_rows, OWN(state) inertia, OWN(state) spin, UPDATE(state) out)
{
    FOR_EACH_ROW(e, n_rows) {
        const state x = spin[(brc_size)e * 3], y = spin[(brc_size)e * 3 + 1], z = spin[(brc_size)e * 3 + 2];
        out[e] += STATE(0.5) * inertia[e] * (x * x + y * y + z * z);
    }
}

/* Linear solves: quaternions (1, theta/2) of small rotation vectors theta [n][3]. */
KERNEL void small_rotation(int n_rows, OWN(state) theta, PUT(state) orientation)
{
    FOR_EACH_ROW(e, n_rows) {
        GLOBAL state *q = orientation + (brc_size)e * 4;
        q[0] = STATE(1);
        for (int c = 0; c < 3; ++c) q[c + 1] = STATE(0.5) * theta[(brc_size)e * 3 + c];
    }
}

/* q <- exp(theta/2) q for finite rotation vectors theta [n][3] [rad], each far below a turn; normalised. */
KERNEL void turn_orientation(int n_rows, OWN(state) theta, UPDATE(state) orientation)
{
    FOR_EACH_ROW(e, n_rows) {
        GLOBAL const state *t = theta + (brc_size)e * 3;
        orientation_turn(orientation + (brc_size)e * 4, STATE(0.5) * t[0], STATE(0.5) * t[1], STATE(0.5) * t[2]);
    }
}
