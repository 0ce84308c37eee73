/* Plain vector loops over n numbers of the state, one work-item each. */

/* y += a x */
KERNEL void vector_axpy(int n, state a, GLOBAL const state *restrict x, GLOBAL state *restrict y)
{
    FOR_EACH_ITEM(i, n) {
        y[i] += a * x[i];
    }
}

/* y = x */
KERNEL void vector_copy(int n, GLOBAL const state *restrict x, GLOBAL state *restrict y)
{
    FOR_EACH_ITEM(i, n) {
        y[i] = x[i];
    }
}

/* y[i] = x[index[i]] */
KERNEL void vector_gather(int n, GLOBAL const int *restrict index, GLOBAL const state *restrict x,
                          GLOBAL state *restrict y)
{
    FOR_EACH_ITEM(i, n) {
        y[i] = x[index[i]];
    }
}
