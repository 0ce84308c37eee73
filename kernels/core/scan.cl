/* Running sums and a stable sort of integers, in fixed blocks of 1024 in order, so that neither device nor threads
 * change a bit. */

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

/* One work-item: sum[b] becomes the sum of those before it, sum[n_blocks] that of all. n_items: 1. */
KERNEL void scan_tops(int n_items, int n_blocks, SCATTER(int) sum)
{
    FOR_EACH_ITEM(k, n_items) {
        int before = k;
        LOADS_TOGETHER(16)
        for (int b = 0; b < n_blocks; ++b) {
            const int own = sum[b];
            sum[b] = before;
            before += own;
        }
        sum[n_blocks] = before;
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

/* count[bin][block]: keys of the block whose digit is bin. */
KERNEL void sort_count(int n_blocks, int n, int shift, OWN(int) key, SCATTER(int) count)
{
    FOR_EACH_ITEM(b, n_blocks) {
        const int begin = b * SCAN_BLOCK, end = begin + SCAN_BLOCK < n ? begin + SCAN_BLOCK : n;
        for (int bin = 0; bin < SORT_BINS; ++bin) count[(brc_size)bin * (brc_size)n_blocks + (brc_size)b] = 0;
        for (int i = begin; i < end; ++i)
            count[(brc_size)(key[i] >> shift & (SORT_BINS - 1)) * (brc_size)n_blocks + (brc_size)b] += 1;
    }
}

/* Keys with their values to where the running sums of count say; next is used up. */
KERNEL void sort_move(int n_blocks, int n, int shift, OWN(int) key, OWN(int) value, SCATTER(int) next,
                      SCATTER(int) key_out, SCATTER(int) value_out)
{
    FOR_EACH_ITEM(b, n_blocks) {
        const int begin = b * SCAN_BLOCK, end = begin + SCAN_BLOCK < n ? begin + SCAN_BLOCK : n;
        for (int i = begin; i < end; ++i) {
            const brc_size bin = (brc_size)(key[i] >> shift & (SORT_BINS - 1)) * (brc_size)n_blocks + (brc_size)b;
            const int to = next[bin];
            next[bin] = to + 1;
            key_out[to] = key[i];
            value_out[to] = value[i];
        }
    }
}
