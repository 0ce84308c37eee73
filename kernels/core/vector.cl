/* Vectors of state numbers for the static solver and the power iteration. Sums are taken over fixed blocks of 1024
 * numbers, in order, so that they do not depend on the number of threads. */

KERNEL void vector_axpy(int n_numbers, state a, OWN(state) x, UPDATE(state) y)
{
    FOR_EACH_ITEM(i, n_numbers) { y[i] += a * x[i]; }
}

/* y = x */
KERNEL void vector_copy(int n_numbers, OWN(state) x, PUT(state) y)
{
    FOR_EACH_ITEM(i, n_numbers) { y[i] = x[i]; }
}

/* y = x + a y */
KERNEL void vector_xpay(int n_numbers, state a, OWN(state) x, UPDATE(state) y)
{
    FOR_EACH_ITEM(i, n_numbers) { y[i] = x[i] + a * y[i]; }
}

/* The whole blocks among up to ABREAST from the first; their end. Those that are not there count the first again. */
LAW int dot_abreast(int first, int behind, int n, GLOBAL const state *x, GLOBAL const state *y, GLOBAL state *partial)
{
#if ABREAST > 1
    const int end = behind < n / SCAN_BLOCK ? behind : n / SCAN_BLOCK;
    state sum[ABREAST];
    brc_size at[ABREAST];
    if (end < first + 2) return first;
    for (int j = 0; j < ABREAST; ++j) {
        sum[j] = 0;
        at[j] = (brc_size)(first + j < end ? first + j : first) * SCAN_BLOCK;
    }
    for (int k = 0; k < SCAN_BLOCK; ++k) WRITTEN_OUT(8)
    for (int j = 0; j < ABREAST; ++j) sum[j] = STATE_ADD_PRODUCT(sum[j], x[at[j] + k], y[at[j] + k]);
    for (int b = first; b < end; ++b) partial[b] = sum[b - first];
    return end;
#else
    (void)behind, (void)n, (void)x, (void)y, (void)partial;
    return first;
#endif
}

/* partial[b] = sum of x y over block b of n numbers in all. */
KERNEL void vector_dot(int n_crews, int n, OWN(state) x, OWN(state) y, PUT(state) partial)
{
    CREW_STAGE(state, product);
    FOR_EACH_CREWS(first, n_crews)
    {
        const int behind = first + ABREAST < n_crews ? first + ABREAST : n_crews;
        for (int b = dot_abreast(first, behind, n, x, y, partial); b < behind; ++b) {
            const int begin = b * SCAN_BLOCK, end = begin + SCAN_BLOCK < n ? begin + SCAN_BLOCK : n;
            state sum = 0;
            CREW_STAGED(product, begin, end, k, x[k] * y[k]);
            for (int i = begin; CREW_FIRST && i < end; ++i) sum += CREW_NUMBER(product, i - begin, x[i] * y[i]);
            if (CREW_FIRST) partial[b] = sum;
        }
    }
}

/* partial[at + b] = sum of x over block b. */
KERNEL void vector_sum(int n_crews, int n, int at, OWN(state) x, PUT(state) partial)
{
    CREW_STAGE(state, number);
    FOR_EACH_CREW(b, n_crews) {
        const int begin = b * SCAN_BLOCK, end = begin + SCAN_BLOCK < n ? begin + SCAN_BLOCK : n;
        state sum = 0;
        CREW_STAGED(number, begin, end, k, x[k]);
        for (int i = begin; CREW_FIRST && i < end; ++i) sum += CREW_NUMBER(number, i - begin, x[i]);
        if (CREW_FIRST) partial[at + b] = sum;
    }
}
/* The same over the n rows of a list. */
KERNEL void vector_sum_listed(int n_crew_parts, int n, int at, OWN(int) list, OWN(state) x, PUT(state) partial)
{
    CREW_STAGE(state, number);
    FOR_EACH_CREW(b, n_crew_parts) {
        const int begin = b * SCAN_BLOCK, end = begin + SCAN_BLOCK < n ? begin + SCAN_BLOCK : n;
        state sum = 0;
        CREW_STAGED(number, begin, end, k, x[list[k]]);
        for (int i = begin; CREW_FIRST && i < end; ++i) sum += CREW_NUMBER(number, i - begin, x[list[i]]);
        if (CREW_FIRST) partial[at + b] = sum;
    }
}

/* v /= m, element by element: M^-1 of a force. */
KERNEL void divide_by_mass(int n_rows, OWN(state) mass, UPDATE(state) vector)
{
    FOR_EACH_ROW(e, n_rows) {
        for (int c = 0; c < 3; ++c) vector[(brc_size)e * 3 + c] /= mass[e];
    }
}
