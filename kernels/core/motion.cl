/* Time stepping and single-element loads, common to all models. One work-item does one element; arrays are [n][3]. */

/* v += kick f / m, u += drift v. A full Verlet or symplectic Euler step has kick = drift = dt; a half kick has drift
 * 0. */
KERNEL void advance(int n_rows, state kick, state drift, OWN(state) mass, OWN(state) force, UPDATE(state) velocity,
                    UPDATE(state) displacement)
{
    FOR_EACH_ROW(e, n_rows) {
        const state per_mass = kick / mass[e];
        for (int c = 0; c < 3; ++c) {
            const brc_size at = (brc_size)e * 3 + c;
            const state v = velocity[at] + per_mass * force[at];
            velocity[at] = v;
            displacement[at] += drift * v;
        }
    }
}

/* Tchamwa-Wielgosz: u += dt v + phi dt^2 a; v += dt a (docs/notebook/theory.md T3). lost accumulates, per element, the
 * part (phi - 1/2) dt^2 m a^2 - (dt v + phi dt^2 a).f_old / 2 of the scheme's own dissipation; numerical_close adds the
 * rest. */
KERNEL void advance_tchamwa(int n_rows, state dt, state phi, OWN(state) mass, OWN(state) force, UPDATE(state) velocity,
                            UPDATE(state) displacement, PUT(state) moved, UPDATE(state) lost)
{
    FOR_EACH_ROW(e, n_rows) {
        state sum = 0;
        for (int c = 0; c < 3; ++c) {
            const brc_size at = (brc_size)e * 3 + c;
            const state f = force[at], a = f / mass[e];
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

/* Mass damping over one step, exact for the drag alone: v *= factor = exp(-c dt); lost gains the energy [J]. */
KERNEL void damp_mass(int n_rows, state factor, OWN(state) mass, UPDATE(state) velocity, UPDATE(state) lost)
{
    FOR_EACH_ROW(e, n_rows) {
        state square = 0;
        for (int c = 0; c < 3; ++c) {
            const brc_size at = (brc_size)e * 3 + c;
            square += velocity[at] * velocity[at];
            velocity[at] *= factor;
        }
        lost[e] += STATE(0.5) * mass[e] * (STATE(1) - factor * factor) * square;
    }
}

/* v += factor f / m with f the drag on noise of velocities v [N/s of stiffness times velocity]; lost gains the energy
 * [J]. */
KERNEL void damp_noise(int n_rows, state factor, OWN(state) mass, OWN(state) drag, UPDATE(state) velocity,
                       UPDATE(state) lost)
{
    FOR_EACH_ROW(e, n_rows) {
        const state per_mass = factor / mass[e];
        state gone = 0;
        for (int c = 0; c < 3; ++c) {
            const brc_size at = (brc_size)e * 3 + c;
            const state v = velocity[at], change = per_mass * drag[at];
            gone -= change * (STATE(2) * v + change);
            velocity[at] = v + change;
        }
        lost[e] += STATE(0.5) * mass[e] * gone;
    }
}

/* f += m g. */
KERNEL void gravity(int n_rows, state gx, state gy, state gz, OWN(state) mass, UPDATE(state) force)
{
    FOR_EACH_ROW(e, n_rows) {
        force[(brc_size)e * 3] += mass[e] * gx;
        force[(brc_size)e * 3 + 1] += mass[e] * gy;
        force[(brc_size)e * 3 + 2] += mass[e] * gz;
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

/* Imposed elements of one load: u = base + factor direction, v = rate direction on the chosen components. */
KERNEL void impose_motion(int n, state factor, state rate, int set_displacement, OWN(int) element, OWN(coeff) component,
                          OWN(state) base, OWN(state) direction, PUT(state) velocity, PUT(state) displacement)
{
    FOR_EACH_ITEM(i, n) {
        for (int c = 0; c < 3; ++c) {
            const brc_size at = (brc_size)i * 3 + c, to = (brc_size)element[i] * 3 + c;
            if (component[at] > REAL(0.5)) {
                if (set_displacement) displacement[to] = base[at] + factor * direction[at];
                velocity[to] = rate * direction[at];
            }
        }
    }
}

/* Reaction of imposed elements, minus the internal force [N] [n][3]. book: 0 no more; 1 adds the work of the load since
 * the last booking: reaction over the path by the trapezoidal rule plus the change of the imposed components' own
 * kinetic energy [J]; 2 starts booking here. last, last_reaction [n][3]: u and reaction at the last booking. */
KERNEL void impose_book(int n, state rate, state last_rate, int book, OWN(int) element, OWN(coeff) component,
                        OWN(state) direction, OWN(state) mass, OWN(state) displacement, OWN(state) force,
                        PUT(state) reaction, UPDATE(state) last, UPDATE(state) last_reaction, UPDATE(state) work)
{
    FOR_EACH_ITEM(i, n) {
        for (int c = 0; c < 3; ++c) {
            const brc_size at = (brc_size)i * 3 + c, to = (brc_size)element[i] * 3 + c;
            if (component[at] > REAL(0.5)) {
                const state now = -force[to];
                if (book == 1) {
                    const state speed = rate * direction[at], old = last_rate * direction[at];
                    work[i] += STATE(0.5) * (last_reaction[at] + now) * (displacement[to] - last[at]) +
                               STATE(0.5) * mass[element[i]] * (speed * speed - old * old);
                }
                reaction[at] = now;
                if (book) {
                    last[at] = displacement[to];
                    last_reaction[at] = now;
                }
            }
        }
    }
}

/* Zero the chosen components of a vector: imposed elements in linear solves. */
KERNEL void impose_zero(int n, OWN(int) element, OWN(coeff) component, PUT(state) vector)
{
    FOR_EACH_ITEM(i, n) {
        for (int c = 0; c < 3; ++c)
            if (component[(brc_size)i * 3 + c] > REAL(0.5)) vector[(brc_size)element[i] * 3 + c] = 0;
    }
}

/* Dead forces of one load on elements: f += factor total. total [n][3]: force per element at factor 1 [N]; book,
 * last_factor, reach, work: the work of the load by the trapezoidal rule, as impose_book; reach [n]: total.u at the
 * last booking. */
KERNEL void push_elements(int n, state factor, state last_factor, int book, OWN(int) element, OWN(state) total,
                          OWN(state) displacement, UPDATE(state) force, UPDATE(state) reach, UPDATE(state) work)
{
    FOR_EACH_ITEM(i, n) {
        state sum = 0;
        for (int c = 0; c < 3; ++c) {
            const brc_size at = (brc_size)i * 3 + c, to = (brc_size)element[i] * 3 + c;
            force[to] += factor * total[at];
            sum += total[at] * displacement[to];
        }
        if (book == 1) work[i] += STATE(0.5) * (factor + last_factor) * (sum - reach[i]);
        if (book) reach[i] = sum;
    }
}
