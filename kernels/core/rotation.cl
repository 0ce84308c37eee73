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
 * (phi - 1) dt^2 for Tchamwa-Wielgosz, else 0. inertia: mean moment of inertia of each cell [kg m^2]. */
KERNEL void advance_rotation(int n_rows, state kick, state drift, state extra, OWN(state) inertia, OWN(state) torque,
                             UPDATE(state) spin, UPDATE(state) orientation)
{
    FOR_EACH_ROW(e, n_rows) {
        state half_turn[3];
        for (int c = 0; c < 3; ++c) {
            const state a = torque[(brc_size)e * 3 + c] / inertia[e];
            const state w = spin[(brc_size)e * 3 + c] + kick * a;
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

/* Turned elements of one load: turn the orientations by the chosen components of angle direction [rad] (finite: 1 q <-
 * exp(turn/2) q; 0 the small rotations of a linear solve are added) unless the angle is 0, and set their spin to rate
 * direction [rad/s]. */
KERNEL void impose_turn(int n, state angle, int finite, state rate, OWN(int) element, OWN(coeff) component,
                        OWN(state) direction, PUT(state) spin, UPDATE(state) orientation)
{
    FOR_EACH_ITEM(i, n) {
        GLOBAL state *q = orientation + (brc_size)element[i] * 4;
        state half_turn[3];
        for (int c = 0; c < 3; ++c) {
            const brc_size at = (brc_size)i * 3 + c;
            const int chosen = component[at] > REAL(0.5);
            half_turn[c] = chosen ? STATE(0.5) * angle * direction[at] : STATE(0);
            if (chosen) spin[(brc_size)element[i] * 3 + c] = rate * direction[at];
        }
        if (angle != 0 && finite)
            orientation_turn(q, half_turn[0], half_turn[1], half_turn[2]);
        else
            for (int c = 0; c < 3; ++c) q[c + 1] += half_turn[c];
    }
}

/* Moment of the load that turns elements, minus the internal torque [N m] [n][3]; the torque it balances becomes zero.
 * step: what the angle's factor grew by since the last booking; book, rate, last_rate, work: as impose_book. */
KERNEL void turn_book(int n, state step, state rate, state last_rate, int book, OWN(int) element, OWN(coeff) component,
                      OWN(state) direction, OWN(state) inertia, UPDATE(state) torque, PUT(state) reaction,
                      UPDATE(state) last_reaction, UPDATE(state) work)
{
    FOR_EACH_ITEM(i, n) {
        for (int c = 0; c < 3; ++c) {
            const brc_size at = (brc_size)i * 3 + c, to = (brc_size)element[i] * 3 + c;
            if (component[at] > REAL(0.5)) {
                const state now = -torque[to];
                if (book == 1) {
                    const state speed = rate * direction[at], old = last_rate * direction[at];
                    work[i] += STATE(0.5) * (last_reaction[at] + now) * (step * direction[at]) +
                               STATE(0.5) * inertia[element[i]] * (speed * speed - old * old);
                }
                reaction[at] = now;
                if (book) last_reaction[at] = now;
                torque[to] = 0;
            }
        }
    }
}

/* z = P r with a symmetric 6 x 6 block per element, upper triangle by rows [n][21]; r and z are split into forces or
 * displacements [n][3] and torques or rotations [n][3]. */
KERNEL void block6_precondition(int n, OWN(state) block, OWN(state) force, OWN(state) torque, PUT(state) move,
                                PUT(state) turn)
{
    FOR_EACH_ITEM(e, n) {
        GLOBAL const state *p = block + (brc_size)e * 21;
        state r[6], z[6];
        for (int c = 0; c < 3; ++c) {
            r[c] = force[(brc_size)e * 3 + c];
            r[c + 3] = torque[(brc_size)e * 3 + c];
        }
        for (int a = 0; a < 6; ++a) z[a] = 0;
        for (int a = 0, at = 0; a < 6; ++a)
            for (int b = a; b < 6; ++b, ++at) {
                z[a] += p[at] * r[b];
                if (b > a) z[b] += p[at] * r[a];
            }
        for (int c = 0; c < 3; ++c) {
            move[(brc_size)e * 3 + c] = z[c];
            turn[(brc_size)e * 3 + c] = z[c + 3];
        }
    }
}
