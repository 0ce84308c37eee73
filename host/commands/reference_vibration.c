/* Rayleigh-Ritz for a free box. With Legendre polynomials normalised on [-1, 1] the mass matrix is the density times the
 * unit matrix, so the eigenproblem is a plain symmetric one; reflections split it into eight blocks. */
#include "reference_vibration.h"
#include "../base/memory.h"
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>

#define HIGHEST_DEGREE 20
#define SIZE (HIGHEST_DEGREE + 1)

/* Integrals over [-1, 1] of normalised polynomials p_m. */
typedef struct integrals {
    double slope[SIZE][SIZE];  /* of p_m p_n' */
    double slopes[SIZE][SIZE]; /* of p_m' p_n' */
} integrals;

/* One function of the basis: component of the displacement and degrees along x, y, z. */
typedef struct function {
    int component, degree[3];
} function;

static void integrate(integrals *table)
{
    for (int m = 0; m < SIZE; ++m)
        for (int n = 0; n < SIZE; ++n) /* P_n' = sum of (2 k + 1) P_k over k = n - 1, n - 3, ... */
            table->slope[m][n] = n > m && (n - m) % 2 == 1 ? sqrt((2.0 * m + 1) * (2.0 * n + 1)) : 0;
    for (int m = 0; m < SIZE; ++m)
        for (int n = 0; n < SIZE; ++n) {
            table->slopes[m][n] = 0;
            for (int k = 0; k < SIZE; ++k)
                table->slopes[m][n] += table->slope[k][m] * table->slope[k][n];
        }
}

/* Integral of d_j a d_l b over the box mapped to [-1, 1]^3 [1/m^2]. */
static double product(const integrals *table, const double size[3], const function *a, int j, const function *b, int l)
{
    double value = 4 / (size[j] * size[l]);
    for (int d = 0; d < 3; ++d) {
        const int m = a->degree[d], n = b->degree[d];
        if (d == j && d == l)
            value *= table->slopes[m][n];
        else if (d == j)
            value *= table->slope[n][m];
        else if (d == l)
            value *= table->slope[m][n];
        else
            value *= m == n;
    }
    return value;
}

/* Functions of one reflection class: a motion of class (px, py, pz) has a component whose parity is turned round along
 * its own direction. */
static int collect(function *basis, int degree, int symmetry)
{
    int n = 0;
    for (int component = 0; component < 3; ++component)
        for (int x = 0; x <= degree; ++x)
            for (int y = 0; x + y <= degree; ++y)
                for (int z = 0; x + y + z <= degree; ++z)
                    if (((x % 2) | (y % 2) << 1 | (z % 2) << 2) == (symmetry ^ 1 << component))
                        basis[n++] = (function){component, {x, y, z}};
    return n;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

brc_status brc_reference_vibration(brc_context *context, const brc_reference_box *box, int degree, int n, double *omega)
{
    if (degree < 1 || degree > HIGHEST_DEGREE)
        return BRC_FAIL(context, BRC_BAD_INPUT, "vibration of a box: degree %d, expected 1 to %d", degree, HIGHEST_DEGREE);
    const int n_functions = (degree + 1) * (degree + 2) * (degree + 3) / 2;
    if (n < 1 || n > n_functions - 6)
        return BRC_FAIL(context, BRC_BAD_INPUT, "vibration of a box: %d modes asked, degree %d has %d", n, degree,
                        n_functions - 6);
    const double mu = box->young / (2 * (1 + box->poisson));
    const double lambda = 2 * mu * box->poisson / (1 - 2 * box->poisson);
    brc_status status = BRC_OK;
    integrals table;
    integrate(&table);
    function *basis = NULL;
    double *squares = NULL, *matrix = NULL;
    int found = 0;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &basis, n_functions, "basis of the vibration of a box"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &squares, n_functions, "squared frequencies of a box"));
    for (int symmetry = 0; symmetry < 8; ++symmetry) {
        const int size = collect(basis, degree, symmetry);
        if (size == 0) continue;
        brc_memory_free(matrix);
        BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &matrix, (int64_t)size * size, "stiffness of the vibration of a box"));
        for (int r = 0; r < size; ++r)
            for (int c = r; c < size; ++c) {
                const int i = basis[r].component, k = basis[c].component;
                double sum = lambda * product(&table, box->size, &basis[r], i, &basis[c], k) +
                             mu * product(&table, box->size, &basis[r], k, &basis[c], i);
                for (int j = 0; i == k && j < 3; ++j)
                    sum += mu * product(&table, box->size, &basis[r], j, &basis[c], j);
                matrix[(int64_t)r * size + c] = sum / box->density;
            }
        const lapack_int info = LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'N', 'U', size, matrix, size, squares + found);
        if (info != 0) {
            status = BRC_FAIL(context, BRC_INTERNAL, "vibration of a box: dsyev gave %d for %d functions", (int)info, size);
            goto cleanup;
        }
        found += size;
    }
    qsort(squares, (size_t)found, sizeof *squares, ascending);
    for (int k = 0; k < n; ++k)
        omega[k] = sqrt(squares[k + 6]);
cleanup:
    brc_memory_free(matrix);
    brc_memory_free(squares);
    brc_memory_free(basis);
    return status;
}
