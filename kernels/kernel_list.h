/* The name of every KERNEL; the same in every precision and for one or many materials. */
#define BRC_KERNEL_LIST(X)                                                                                             \
    X(vector_axpy)                                                                                                     \
    X(vector_copy)                                                                                                     \
    X(vector_gather)
