/* Rings of elements around others, by bonds: those that a broken bond or an open face changes, ring 0, their
 * neighbours, ring 1, and so on. Passes over lists of them (members.cl) do what a pass over the whole body would
 * change.
 *
 * touched [n]: 1 for elements of ring 0, set by whoever marks bonds, 2 when these broke, 3 when more of them are marked
 * then (cells_rebuild). level [n]: 0, or the ring that
 * an element was found to be in: RING_FOUND in ring 0 or 1 and not listed yet, then 1 + its ring. Both are 0 again when
 * the last list is made; touched, where that list is kept, by who uses it up (cells_share). Where places are wanted
 * level holds, until ring_forget, the ring, 0 to 3, and four times 1 + the place in the list of the rings 0 to 2; in
 * ring 3 the ring alone. */

#define RING_FOUND 1
#define RING_KINDS 4
/* Of such a level, one or W of them: 1 + the place, 0 in ring 3 and without a ring; 1 in the rings 2 and 3, else 0. */
#define RING_PLACE(level) ((level) >> 2)
#define RING_IS_OUTER(level) (((level) >> 1) & 1)

/* Elements whose level (by_level), or who are touched as, `from`, and their neighbours are given the level `to` where
 * they have none. */
KERNEL void ring_spread(int n_groups, int from, int to, int by_level, OWN(int) row_start, OWN(int) neighbour,
                        OWN(int) touched, SPREAD(int) level)
{
    FOR_EACH_ITEM(group, n_groups) {
        GLOBAL const int *const origin = by_level ? level : touched;
        const lane_int is_from = int_load(origin, (brc_size)group * W) == from;
        for (int e = group * W; LANE_ANY(is_from) && e < group * W + W; ++e) {
            if (origin[e] != from) continue;
            if (level[e] == 0) STORE_SAME(level + e, to);
            for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
                const int
                    j = neighbour[(brc_size)slot * C + e % C],
                    was =
                        level[j]; /* kept where there is one, by a store all the same: whether there is is a toss-up */
                STORE_SAME(level + j, was ? was : to);
            }
        }
    }
}

/* Ring 0 is where some number is above 0, or with above 0 where it is not. */
KERNEL void ring_seed(int n_rows, int above, OWN(int) number, PUT(int) touched)
{
    FOR_EACH_ITEM(e, n_rows) { touched[e] = (number[e] > 0) == above; }
}

/* All bits where an element belongs to one of the lists 0 to k. which 0: what is new, in list 0 those touched that were
 * found before, in 1 those both touched and found, in 2 those only found; 1: all, by ring, for the last time; 2: those
 * touched, in list 0; 3: as 1, and touched stays; 4: as 3, and level holds places. */
LAW lane_int ring_is_upto(int which, int k, lane_int touched, lane_int level)
{
    const lane_int found = LANE_ABOVE(level, 0) & ~LANE_ABOVE(level, RING_FOUND), any = LANE_ABOVE(touched, 0),
                   fresh = any & ~LANE_ABOVE(touched, 1);
    if (which == 0) return k == 0 ? fresh & ~found : k == 1 ? fresh : fresh | found;
    return which == 2 ? any : any | (LANE_ABOVE(level, RING_FOUND) & ~LANE_ABOVE(level, k + 1));
}

/* Whether some of the W elements are touched or have a level: most are far from any break. */
LAW int rings_reach(lane_int touched, lane_int level)
{
    const lane_int some = touched | level;
    return LANE_ANY(some);
}

/* count[list][block]: how many of the lists 0 to `list`, in fixed blocks; behind these RING_KINDS lists how many are
 * touched by marks that did not break yet. n and SCAN_BLOCK are multiples of W. */
KERNEL void ring_count(int n_crew_parts, int n, int which, OWN(int) touched, OWN(int) level, PUT(int) count)
{
    CREW_ROOM(room);
    FOR_EACH_CREW(b, n_crew_parts) {
        const int begin = b * SCAN_BLOCK, end = begin + SCAN_BLOCK < n ? begin + SCAN_BLOCK : n,
                  from = CREW_BEGIN(begin, end), to = CREW_END(begin, end);
#define NONE(l) 0
        const lane_int none = LANE_MAKE(lane_int, NONE);
#undef NONE
        lane_int upto[RING_KINDS + 1] = {none, none, none, none, none};
        LOADS_TOGETHER(8)
        for (int first = from; first < to; first += W) {
            const lane_int t = int_load(touched, (brc_size)first), l = int_load(level, (brc_size)first);
            if (!rings_reach(t, l)) continue;
            for (int k = 0; k < RING_KINDS; ++k) upto[k] -= ring_is_upto(which, k, t, l);
            upto[RING_KINDS] += t & 1;
        }
        for (int k = 0; k <= RING_KINDS; ++k) {
            int sum = 0;
#define ADD(l) sum += LANE_ITEM(upto[k], l);
            LANE_EACH(ADD)
#undef ADD
            sum = CREW_ALL(room, sum);
            if (CREW_FIRST) count[k * n_crew_parts + b] = sum;
        }
    }
}

/* Running sums of the counts of every list, each of the blocks before; behind all of them what each list holds.
 * n_crew_parts: lists. */
KERNEL void ring_tops(int n_crew_parts, int n_blocks, UPDATE(int) count)
{
    CREW_ROOM(room);
    FOR_EACH_CREW(k, n_crew_parts) {
        const int share = CREW_SHARE(n_blocks), first = k * n_blocks, last = first + n_blocks,
                  from = first + CREW_PLACE * share, to = from + share < last ? from + share : last;
        int own = 0;
        LOADS_TOGETHER(16)
        for (int b = from; CREW > 1 && b < to; ++b) own += count[b];
        int before = CREW_BEFORE(room, own);
        LOADS_TOGETHER(16)
        for (int b = from; b < to; ++b) {
            const int x = count[b];
            count[b] = before;
            before += x;
        }
        if (CREW_PLACE == CREW - 1) count[n_crew_parts * n_blocks + k] = before;
    }
}

/* What each list and those before it hold, in the order of the rows: neighbours in the body, whose numbers share places
 * in memory, are done together whatever their ring. next: running sums of count. */
KERNEL void ring_list(int n_crews, int n, int which, UPDATE(int) touched, UPDATE(int) level, OWN(int) next,
                      SCATTER(int) upto_0, SCATTER(int) upto_1, SCATTER(int) upto_2, SCATTER(int) upto_3)
{
    CREW_ROOM(room);
    FOR_EACH_CREW(b, n_crews) {
        const int begin = b * SCAN_BLOCK, end = begin + SCAN_BLOCK < n ? begin + SCAN_BLOCK : n;
        const int row = n_crews, from = CREW_BEGIN(begin, end), to = CREW_END(begin, end);
        int to_0 = next[b], to_1 = next[row + b], to_2 = next[2 * row + b], to_3 = next[3 * row + b];
        int before[RING_KINDS] = {0, 0, 0, 0};
        LOADS_TOGETHER(8)
        for (int first = from; CREW > 1 && first < to; first += W) {
            const lane_int t = int_load(touched, (brc_size)first), l = int_load(level, (brc_size)first);
            for (int k = 0; k < RING_KINDS; ++k) before[k] += lane_count(ring_is_upto(which, k, t, l));
        }
        to_0 += CREW_BEFORE(room, before[0]), to_1 += CREW_BEFORE(room, before[1]);
        to_2 += CREW_BEFORE(room, before[2]), to_3 += CREW_BEFORE(room, before[3]);
        for (int first = from; first < to; first += W) {
            const brc_size at = (brc_size)first;
            const lane_int own = lane_own(first), t = int_load(touched, at), l = int_load(level, at);
            if (!rings_reach(t, l)) continue;
            const lane_int none = t ^ t, is_0 = ring_is_upto(which, 0, t, l), is_1 = ring_is_upto(which, 1, t, l),
                           is_2 = ring_is_upto(which, 2, t, l), is_3 = ring_is_upto(which, 3, t, l);
            if (which == 4)
                int_store(level, at,
                          is_3 &
                              ((is_0 + is_1 + is_2 + RING_KINDS - 1) | (is_2 & (4 * (lane_rank(is_2) + (to_2 + 1))))));
            else if (which != 2)
                int_store(level, at, which == 0 ? (is_3 & (RING_FOUND + 1)) | (~is_3 & l) : none);
            if (which == 1) int_store(touched, at, none);
            lane_pack(upto_0 + to_0, is_0, own), lane_pack(upto_1 + to_1, is_1, own),
                lane_pack(upto_2 + to_2, is_2, own), lane_pack(upto_3 + to_3, is_3, own);
            to_0 += lane_count(is_0), to_1 += lane_count(is_1), to_2 += lane_count(is_2), to_3 += lane_count(is_3);
        }
    }
}

/* Rings 2 and 3, spread in vain, are taken back. */
KERNEL void ring_take_back(int n_rows, UPDATE(int) level)
{
    FOR_EACH_ITEM(e, n_rows) {
        if (level[e] > RING_FOUND + 1) level[e] = 0;
    }
}

KERNEL void ring_forget(int n, OWN(int) list, PUT(int) level)
{
    FOR_EACH_ITEM(k, n) { level[list[k]] = 0; }
}

/* The force of an element becomes `now` [N], and its velocity gains half_kick over mass times what the force loses.
 * delta: what force^2 / mass changed by, in components. */
LAW void ring_take(brc_size at, state half_kick, state per_mass, state now, UPDATE(state) force, UPDATE(state) velocity,
                   PUT(state) delta)
{
    const state was = force[at];
    velocity[at] += half_kick * (was - now) * per_mass;
    force[at] = now;
    delta[at] = (now * now - was * was) * per_mass;
}

/* fresh [n][3] takes the place of the force of the listed elements. Afterwards fresh holds the delta. */
KERNEL void ring_replace(int n, state half_kick, OWN(int) list, OWN(state) mass, UPDATE(state) fresh,
                         UPDATE(state) force, UPDATE(state) velocity)
{
    FOR_EACH_ITEM(k, n) {
        const brc_size e = (brc_size)list[k];
        const state per_mass = STATE(1) / mass[e];
        for (int c = 0; c < 3; ++c) ring_take(e * 3 + c, half_kick, per_mass, fresh[e * 3 + c], force, velocity, fresh);
    }
}

/* The same delta of all elements, whose forces were evaluated in their place: was [n][3] holds the forces from before,
 * then the delta. */
KERNEL void ring_delta(int n_rows, OWN(state) mass, OWN(state) force, UPDATE(state) was)
{
    FOR_EACH_ITEM(e, n_rows) {
        for (int c = 0; c < 3; ++c) {
            const brc_size at = (brc_size)e * 3 + c;
            was[at] = (force[at] * force[at] - was[at] * was[at]) / mass[e];
        }
    }
}

/* What velocity Verlet loses where forces jump. Of a linear system it keeps K + W - dt^2/8 f.M^-1 f, so K + W swings
 * about a mean that lies dt^2/16 (v.K v - f.M^-1 f) above it; where f jumps at rest, that mean falls by dt^2/16 times
 * the delta of f.M^-1 f. per: dt^2/16; delta [n][3] [N^2/kg]; lost [n] [J]. listed: of the n elements of the list, else
 * of all. */
KERNEL void ring_book(int n, int listed, state per, OWN(int) list, OWN(state) delta, UPDATE(state) lost)
{
    FOR_EACH_ITEM(k, n) {
        const brc_size e = (brc_size)(listed ? list[k] : k);
        lost[e] += per * (delta[e * 3] + delta[e * 3 + 1] + delta[e * 3 + 2]);
    }
}
