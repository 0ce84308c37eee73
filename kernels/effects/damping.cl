/* Drags of dynamic stages. One work-item does one element; velocities are [n][3]. */

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
