/* Algebra of vectors on the device (vector.cl). */
#ifndef BRC_SOLVER_UTILITIES_VECTORS_H
#define BRC_SOLVER_UTILITIES_VECTORS_H

#include "../../device/device.h"

typedef struct brc_simulation brc_simulation;

/* Their kernels, in s->vectors. */
brc_status brc_vector_kernels_find(brc_simulation *s);
void brc_vector_kernels_free(brc_simulation *s);
/* Sum of count state numbers, and dot product, in fixed blocks. */
brc_status brc_vector_sum(brc_simulation *s, brc_buffer *x, int64_t count, double *out);
/* Sums that one read brings: of count state numbers, of the n rows of a list. Now or later, at the latest after
 * brc_vector_sums, what each comes to is in its *out, which must live until then. */
brc_status brc_vector_sum_later(brc_simulation *s, brc_buffer *x, int64_t count, double *out);
brc_status brc_vector_sum_listed_later(brc_simulation *s, brc_buffer *list, int32_t n, brc_buffer *x, double *out);
brc_status brc_vector_sums(brc_simulation *s);
/* After a failure: nobody waits for them. */
void brc_vector_sums_forget(brc_simulation *s);
brc_status brc_vector_dot(brc_simulation *s, brc_buffer *x, brc_buffer *y, int64_t count, double *out);
/* y = a x + y, of count state numbers. */
brc_status brc_vector_axpy(brc_simulation *s, int64_t count, double a, brc_buffer *x, brc_buffer *y);
/* Orientations (quaternions) of small rotations theta [n_rows][3]. */
brc_status brc_vector_small_rotation(brc_simulation *s, brc_buffer *theta, brc_buffer *orientation);
/* The same, added to what they are: orientation turned by theta. */
brc_status brc_vector_turn(brc_simulation *s, brc_buffer *theta, brc_buffer *orientation);
/* y = x + a y, of count state numbers. */
brc_status brc_vector_xpay(brc_simulation *s, int64_t count, brc_buffer *x, double a, brc_buffer *y);
/* y = D x, with a symmetric block of each row: [n_rows][6] of 3 numbers, [n_rows][21] of 3 and 3. */
brc_status brc_vector_blocks(brc_simulation *s, brc_buffer *blocks, brc_buffer *x, brc_buffer *y);
brc_status brc_vector_blocks6(brc_simulation *s, brc_buffer *blocks, brc_buffer *x, brc_buffer *x_turn, brc_buffer *y,
                              brc_buffer *y_turn);

#endif
