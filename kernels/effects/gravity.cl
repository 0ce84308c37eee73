/* Gravity. */

/* f += m g. */
KERNEL void gravity(int n_rows, state gx, state gy, state gz, OWN(state) mass, UPDATE(state) force)
{
    FOR_EACH_ROW(e, n_rows) {
        force[(brc_size)e * 3] += mass[e] * gx;
        force[(brc_size)e * 3 + 1] += mass[e] * gy;
        force[(brc_size)e * 3 + 2] += mass[e] * gz;
    }
}
