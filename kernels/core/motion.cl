/* Time stepping, common to all models. One work-item does one element; arrays are [n][3]. */

/* Rest: a component of a velocity that is 0 stays so while a step would bring it to less than `still` [m/s]
 * (docs/notebook/theory.md T5). */
LAW int stays_at_rest(state was, state now, state still) { return was == 0 && now < still && now > -still; }

/* v += kick f / m, u += drift v. A full Verlet or symplectic Euler step has kick = drift = dt; a half kick has drift
 * 0. */
KERNEL void advance(int n_rows, state kick, state drift, state still, OWN(state) mass, OWN(state) force,
                    UPDATE(state) velocity, UPDATE(state) displacement)
{
    FOR_EACH_COMPONENT(e, c, n_rows)
    {
        const brc_size at = (brc_size)e * 3 + c;
        const state was = velocity[at], now = was + kick / mass[e] * force[at];
        const state v = stays_at_rest(was, now, still) ? was : now;
        velocity[at] = v;
        displacement[at] += drift * v;
    }
}

/* Tchamwa-Wielgosz: u += dt v + phi dt^2 a; v += dt a (docs/notebook/theory.md T3). lost accumulates, per element, the
 * part (phi - 1/2) dt^2 m a^2 - (dt v + phi dt^2 a).f_old / 2 of the scheme's own dissipation; numerical_close adds the
 * rest. */
KERNEL void advance_tchamwa(int n_rows, state dt, state phi, state still, OWN(state) mass, OWN(state) force,
                            UPDATE(state) velocity, UPDATE(state) displacement, PUT(state) moved, UPDATE(state) lost)
{
    FOR_EACH_ROW(e, n_rows) {
        state sum = 0;
        for (int c = 0; c < 3; ++c) {
            const brc_size at = (brc_size)e * 3 + c;
            const state push = force[at] / mass[e];
            const int rests = stays_at_rest(velocity[at], velocity[at] + dt * push, still);
            const state f = rests ? STATE(0) : force[at], a = rests ? STATE(0) : push;
            const state du = dt * velocity[at] + phi * dt * dt * a;
            sum += (phi - STATE(0.5)) * dt * dt * a * f - STATE(0.5) * du * f;
            moved[at] = du;
            displacement[at] += du;
            velocity[at] += dt * a;
        }
        lost[e] += sum;
    }
}

/* ... + du.f_new / 2, so that the sum is (phi - 1/2) dt^2 a.M a - du.K du / 2 on a linear system. */
KERNEL void numerical_close(int n_rows, OWN(state) force, OWN(state) moved, UPDATE(state) lost)
{
    FOR_EACH_ROW(e, n_rows) {
        state sum = 0;
        for (int c = 0; c < 3; ++c) sum += STATE(0.5) * moved[(brc_size)e * 3 + c] * force[(brc_size)e * 3 + c];
        lost[e] += sum;
    }
}

/* Kinetic energy [J] [n]. */
KERNEL void kinetic_energy(int n_rows, OWN(state) mass, OWN(state) velocity, PUT(state) out)
{
    FOR_EACH_ROW(e, n_rows) {
        const state x = velocity[(brc_size)e * 3], y = velocity[(brc_size)e * 3 + 1], z = velocity[(brc_size)e * 3 + 2];
        out[e] = STATE(0.5) * mass[e] * (x * x + y * y + z * z);
    }
}
