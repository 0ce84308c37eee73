/* The guard of a run: which element is the first to leave what physics allows, in each block of rows. Nothing is
 * reduced over blocks, so that a number that is not finite cannot be lost in a maximum. */

#define GUARD_BLOCK 128

/* x is within (-most, most); false for what is not a number. */
LAW int guard_within(state x, state most) { return x < most && x > -most; }

/* first[b]: the lowest row of block b with a velocity component beyond most_v [m/s], a displacement component beyond
 * most_u [m], or not finite, -1 before there was one; when[b]: the probe at which it was found. turns: spins [rad/s]
 * are looked at too, finite below most_u. What was found stays. */
KERNEL void guard_probe(int n_crews, int n, int probe, state most_u, state most_v, int turns, OWN(state) displacement,
                        OWN(state) velocity, OWN(state) spin, UPDATE(int) first, PUT(int) when)
{
    CREW_STAGE(int, row);
    FOR_EACH_CREW(b, n_crews) {
        const int begin = b * GUARD_BLOCK, end = begin + GUARD_BLOCK < n ? begin + GUARD_BLOCK : n, before = first[b];
        if (before < 0) {
            int found = -1;
            LOADS_TOGETHER(4)
            for (int e = end - 1 - CREW_PLACE; e >= begin; e -= CREW) {
                int within = 1;
                for (int c = 0; c < 3; ++c) {
                    const brc_size at = (brc_size)e * 3 + c;
                    within &= guard_within(velocity[at], most_v) & guard_within(displacement[at], most_u);
                    if (turns) within &= guard_within(spin[at], most_u);
                }
                found = within ? found : e;
            }
            CREW_PUT(row, CREW_PLACE, found);
            CREW_WAIT();
            for (int t = 0; t < CREW; ++t) {
                const int other = CREW_NUMBER(row, t, found);
                found = other >= 0 && (found < 0 || other < found) ? other : found;
            }
            if (CREW_FIRST && found >= 0) {
                first[b] = found;
                when[b] = probe;
            }
        }
    }
}
