/* Running sums and a stable sort of integers, in fixed blocks of 1024 in order, so that neither device nor threads
 * change a bit. */

/* The sum of x over those of a crew before this one, or with `all` over the whole crew. */
LAW int crew_sum(crew_room room, int x, int all)
{
#if CREW > 1
    int sum = 0;
    room[CREW_PLACE] = x;
    CREW_WAIT();
    for (int t = 0; t < (all ? CREW : CREW_PLACE); ++t) sum += room[t];
    CREW_WAIT();
    return sum;
#else
    (void)room;
    return all ? x : 0;
#endif
}
#define CREW_ALL(room, x) crew_sum(room, x, 1)
#define CREW_BEFORE(room, x) crew_sum(room, x, 0)
/* How many of those before this one, or with `all` of the whole crew, have x too. */
LAW int crew_alike(crew_room room, int x, int all)
{
#if CREW > 1
    int alike = 0;
    room[CREW_PLACE] = x;
    CREW_WAIT();
    for (int t = 0; t < (all ? CREW : CREW_PLACE); ++t) alike += room[t] == x;
    CREW_WAIT();
    return alike;
#else
    (void)room, (void)x;
    return all;
#endif
}

#define SORT_BINS 256

/* sum[b] = sum of x over block b. */
KERNEL void scan_sums(int n_crews, int n, OWN(int) x, PUT(int) sum)
{
    CREW_ROOM(room);
    FOR_EACH_CREW(b, n_crews) {
        const int begin = b * SCAN_BLOCK, end = begin + SCAN_BLOCK < n ? begin + SCAN_BLOCK : n;
        const int from = CREW_BEGIN(begin, end), to = CREW_END(begin, end);
        int total = 0;
        LOADS_TOGETHER(16)
        for (int i = from; i < to; ++i) total += x[i];
        total = CREW_ALL(room, total);
        if (CREW_FIRST) sum[b] = total;
    }
}

/* sum[b] becomes the sum of those before it, sum[at] that of all. n_crew_parts: 1. */
KERNEL void scan_tops(int n_crew_parts, int n_blocks, int at, SCATTER(int) sum)
{
    CREW_ROOM(room);
    FOR_EACH_CREW(k, n_crew_parts) {
        const int share = CREW_SHARE(n_blocks), from = CREW_PLACE * share,
                  to = from + share < n_blocks ? from + share : n_blocks;
        int own = 0;
        LOADS_TOGETHER(16)
        for (int b = from; CREW > 1 && b < to; ++b) own += sum[b];
        int before = CREW_BEFORE(room, own);
        LOADS_TOGETHER(16)
        for (int b = from; b < to; ++b) {
            const int x = sum[b];
            sum[b] = before;
            before += x;
        }
        if (CREW_PLACE == CREW - 1) sum[at] = before;
    }
}

/* start[i] = sum of x before i; start[n] that of all. */
KERNEL void scan_fill(int n_crews, int n, OWN(int) x, OWN(int) sum, SCATTER(int) start)
{
    CREW_ROOM(room);
    FOR_EACH_CREW(b, n_crews) {
        const int begin = b * SCAN_BLOCK, end = begin + SCAN_BLOCK < n ? begin + SCAN_BLOCK : n,
                  from = CREW_BEGIN(begin, end), to = CREW_END(begin, end);
        int own = 0;
        for (int i = from; CREW > 1 && i < to; ++i) own += x[i];
        int before = sum[b] + CREW_BEFORE(room, own);
        LOADS_TOGETHER(16)
        for (int i = from; i < to; ++i) {
            start[i] = before;
            before += x[i];
        }
        if (from < to && to == n) start[n] = before;
    }
}

LAW int sort_digit(int key, int shift) { return key >> shift & (SORT_BINS - 1); }

/* count[bin][block]: keys of the block whose digit is bin. */
KERNEL void sort_count(int n_crews, int n, int shift, OWN(int) key, SCATTER(int) count)
{
    CREW_ROOM(room);
    CREW_STAGE(int, bin);
    FOR_EACH_CREW(b, n_crews) {
        const int begin = b * SCAN_BLOCK, end = begin + SCAN_BLOCK < n ? begin + SCAN_BLOCK : n;
        GLOBAL int *const own = count + b;
        for (int d = CREW_PLACE; d < SORT_BINS; d += CREW)
            CREW_NUMBER(bin, d, own[(brc_size)d * (brc_size)n_crews]) = 0;
        for (int first = begin; first < end; first += CREW) {
            const int i = first + CREW_PLACE, d = i < end ? sort_digit(key[i], shift) : SORT_BINS;
            const int before = crew_alike(room, d, 0), alike = crew_alike(room, d, 1);
            if (d < SORT_BINS && before == 0) CREW_NUMBER(bin, d, own[(brc_size)d * (brc_size)n_crews]) += alike;
        }
        CREW_WAIT();
        for (int d = CREW_PLACE; CREW > 1 && d < SORT_BINS; d += CREW)
            own[(brc_size)d * (brc_size)n_crews] = CREW_NUMBER(bin, d, own[(brc_size)d * (brc_size)n_crews]);
    }
}

/* Keys with their values to where the running sums of count say; next is used up. */
KERNEL void sort_move(int n_crews, int n, int shift, OWN(int) key, OWN(int) value, SCATTER(int) next,
                      SCATTER(int) key_out, SCATTER(int) value_out)
{
    CREW_ROOM(room);
    CREW_STAGE(int, bin);
    FOR_EACH_CREW(b, n_crews) {
        const int begin = b * SCAN_BLOCK, end = begin + SCAN_BLOCK < n ? begin + SCAN_BLOCK : n;
        GLOBAL int *const own = next + b;
        CREW_STAGED(bin, 0, SORT_BINS, d, own[(brc_size)d * (brc_size)n_crews]);
        for (int first = begin; first < end; first += CREW) {
            const int i = first + CREW_PLACE, d = i < end ? sort_digit(key[i], shift) : SORT_BINS;
            const int before = crew_alike(room, d, 0);
            const int to = d < SORT_BINS ? CREW_NUMBER(bin, d, own[(brc_size)d * (brc_size)n_crews]) + before : 0;
            const int alike = crew_alike(room, d, 1);
            if (d < SORT_BINS) {
                if (before == 0) CREW_NUMBER(bin, d, own[(brc_size)d * (brc_size)n_crews]) += alike;
                key_out[to] = key[i];
                value_out[to] = value[i];
            }
        }
    }
}
