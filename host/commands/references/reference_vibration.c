/* Rayleigh-Ritz for a free solid. With Legendre polynomials normalised on [-1, 1] the mass matrix of a box is the
 * density times the unit matrix, so the eigenproblem is a plain symmetric one; round solids have a mass matrix too.
 * Reflections split it into eight blocks. */
#include "reference_vibration_internal.h"
#include "../../base/memory.h"
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>

#define HIGHEST_DEGREE 20
#define HIGHEST_ROUND 12
#define SIZE (HIGHEST_DEGREE + 1)

/* Integrals over [-1, 1] of normalised polynomials p_m. */
typedef struct integrals {
    double slope[SIZE][SIZE];  /* of p_m p_n' */
    double slopes[SIZE][SIZE]; /* of p_m' p_n' */
} integrals;

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
static double product(const integrals *table, const double size[3], const brc_reference_function *a, int j,
                      const brc_reference_function *b, int l)
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
static int collect(brc_reference_function *basis, int degree, int symmetry)
{
    int n = 0;
    for (int component = 0; component < 3; ++component)
        for (int x = 0; x <= degree; ++x)
            for (int y = 0; x + y <= degree; ++y)
                for (int z = 0; x + y + z <= degree; ++z)
                    if (((x % 2) | (y % 2) << 1 | (z % 2) << 2) == (symmetry ^ 1 << component))
                        basis[n++] = (brc_reference_function){component, {x, y, z}};
    return n;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Stiffness over the density of the functions of a box. */
static void fill_box(const integrals *table, const brc_reference_solid *box, int size,
                     const brc_reference_function *basis, double *stiffness)
{
    const double mu = box->young / (2 * (1 + box->poisson));
    const double lambda = 2 * mu * box->poisson / (1 - 2 * box->poisson);
    for (int r = 0; r < size; ++r)
        for (int c = r; c < size; ++c) {
            const int i = basis[r].component, k = basis[c].component;
            double sum = lambda * product(table, box->size, &basis[r], i, &basis[c], k) +
                         mu * product(table, box->size, &basis[r], k, &basis[c], i);
            for (int j = 0; i == k && j < 3; ++j)
                sum += mu * product(table, box->size, &basis[r], j, &basis[c], j);
            stiffness[(int64_t)r * size + c] = sum / box->density;
        }
}

brc_status brc_reference_vibration(brc_context *context, const brc_reference_solid *solid, int degree, int n,
                                   double *omega)
{
    const bool round = solid->shape != BRC_REFERENCE_BOX;
    const int highest = round ? HIGHEST_ROUND : HIGHEST_DEGREE;
    if (degree < 1 || degree > highest)
        return BRC_FAIL(context, BRC_BAD_INPUT, "vibration of a solid: degree %d, expected 1 to %d", degree, highest);
    const int n_functions = (degree + 1) * (degree + 2) * (degree + 3) / 2;
    if (n < 1 || n > n_functions - 6)
        return BRC_FAIL(context, BRC_BAD_INPUT, "vibration of a solid: %d modes asked, degree %d has %d", n, degree,
                        n_functions - 6);
    brc_status status = BRC_OK;
    integrals table;
    brc_reference_function *basis = NULL;
    double *squares = NULL, *stiffness = NULL, *mass = NULL;
    int found = 0;
    integrate(&table);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &basis, n_functions, "basis of the vibration of a solid"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &squares, n_functions, "squared frequencies of a solid"));
    for (int symmetry = 0; symmetry < 8; ++symmetry) {
        const int size = collect(basis, degree, symmetry);
        lapack_int info;
        if (size == 0) continue;
        brc_memory_free(stiffness);
        BRC_TRY_OR(cleanup,
                   BRC_ALLOCATE(context, &stiffness, (int64_t)size * size, "stiffness of the vibration of a solid"));
        if (round) {
            brc_memory_free(mass);
            BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &mass, (int64_t)size * size, "mass of the vibration of a solid"));
            BRC_TRY_OR(cleanup, brc_reference_round_fill(context, solid, degree, size, basis, stiffness, mass));
            info = LAPACKE_dsygv(LAPACK_ROW_MAJOR, 1, 'N', 'U', size, stiffness, size, mass, size, squares + found);
        } else {
            fill_box(&table, solid, size, basis, stiffness);
            info = LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'N', 'U', size, stiffness, size, squares + found);
        }
        if (info != 0) {
            status = BRC_FAIL(context, BRC_INTERNAL, "vibration of a solid: LAPACK gave %d for %d functions", (int)info,
                              size);
            goto cleanup;
        }
        found += size;
    }
    qsort(squares, (size_t)found, sizeof *squares, ascending);
    for (int k = 0; k < n; ++k)
        omega[k] = sqrt(squares[k + 6]);
cleanup:
    brc_memory_free(mass);
    brc_memory_free(stiffness);
    brc_memory_free(squares);
    brc_memory_free(basis);
    return status;
}
