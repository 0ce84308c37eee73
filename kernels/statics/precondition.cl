/* Diagonal blocks as preconditioner of static solves. */

/* z = P r with a symmetric 3 x 3 block (xx yy zz yz xz xy) per element. */
KERNEL void block_precondition(int n_rows, OWN(state) block, OWN(state) r, PUT(state) z)
{
    FOR_EACH_ITEM(e, n_rows) {
        GLOBAL const state *p = block + (brc_size)e * 6;
        const state x = r[(brc_size)e * 3], y = r[(brc_size)e * 3 + 1], w = r[(brc_size)e * 3 + 2];
        z[(brc_size)e * 3] = p[0] * x + p[5] * y + p[4] * w;
        z[(brc_size)e * 3 + 1] = p[5] * x + p[1] * y + p[3] * w;
        z[(brc_size)e * 3 + 2] = p[4] * x + p[3] * y + p[2] * w;
    }
}

/* z = P r with a symmetric 6 x 6 block per element, upper triangle by rows [n][21]; r and z are split into forces or
 * displacements [n][3] and torques or rotations [n][3]. */
KERNEL void block6_precondition(int n_rows, OWN(state) block, OWN(state) force, OWN(state) torque, PUT(state) move,
                                PUT(state) turn)
{
    FOR_EACH_ITEM(e, n_rows) {
        GLOBAL const state *p = block + (brc_size)e * 21;
        state r[6], z[6];
        for (int c = 0; c < 3; ++c) {
            r[c] = force[(brc_size)e * 3 + c];
            r[c + 3] = torque[(brc_size)e * 3 + c];
        }
        for (int a = 0; a < 6; ++a) z[a] = 0;
        WRITTEN_OUT(6)
        for (int a = 0; a < 6; ++a) WRITTEN_OUT(6)
        for (int b = 0; b < 6; ++b) {
            if (b < a) continue;
            const state entry = p[a * (11 - a) / 2 + b];
            z[a] += entry * r[b];
            if (b > a) z[b] += entry * r[a];
        }
        for (int c = 0; c < 3; ++c) {
            move[(brc_size)e * 3 + c] = z[c];
            turn[(brc_size)e * 3 + c] = z[c + 3];
        }
    }
}
