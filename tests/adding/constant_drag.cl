/* Speeds lose `slower` [m/s], down to nothing; lost gains the energy [J]. */
KERNEL void constant_drag(int n, state slower, OWN(state) mass, UPDATE(state) velocity, UPDATE(state) lost)
{
    FOR_EACH_ITEM(e, n) {
        state square = 0;
        for (int c = 0; c < 3; ++c)
            square += velocity[(brc_size)e * 3 + c] * velocity[(brc_size)e * 3 + c];
        const state speed = SQRT_STATE(square), left = speed > slower ? 1 - slower / speed : 0;
        for (int c = 0; c < 3; ++c)
            velocity[(brc_size)e * 3 + c] *= left;
        lost[e] += STATE(0.5) * mass[e] * (STATE(1) - left * left) * square;
    }
}
