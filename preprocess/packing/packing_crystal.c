/* Has a packing crystallised? Spheres in ordered surroundings by the coherence of bond-orientational order (Steinhardt,
 * Nelson, Ronchetti, Phys. Rev. B 28, 784, 1983; ten Wolde, Ruiz-Montero, Frenkel, J. Chem. Phys. 104, 9932, 1996): q6
 * of a sphere is the sum of the spherical harmonics Y_6m of the directions to its neighbours, normalised. Two
 * neighbours are connected when the product of their q6 is above 0.7, and a sphere with at least seven connections is
 * ordered. In a crystal all neighbours are connected, in a random packing few. */
#include "packing_internal.h"

#include "../../host/base/memory.h"

#include <math.h>

/* Neighbours: nearer than this [of R_i + R_j], between the first and second shell of crystals (1 and 1.41). */
#define NEIGHBOUR_REACH 1.3
#define COHERENCE_LEAST 0.7
#define CONNECTIONS_LEAST 7

/* m = 0 .. 6; real and imaginary parts for m > 0, times sqrt(2) for the harmonics of -m. */
enum { N_PARTS = 13 };

/* Adds the harmonics of degree 6 (but for a common factor) of the unit vector u. */
static void add_harmonics(const double u[3], double q[N_PARTS])
{
    /* sqrt(2 (6 - m)! / (6 + m)!); 1 at m = 0 */
    static const double norm[7] = {1.0,
                                   0.21821789023599236,
                                   0.03450327796711771,
                                   0.005750546327852952,
                                   0.00104990131391452,
                                   0.00022383971222927231,
                                   6.461695905544936e-05};
    const double z = u[2], z2 = z * z;
    const double slope[7] = {(((231.0 * z2 - 315.0) * z2 + 105.0) * z2 - 5.0) / 16.0, /* m-th derivative of P_6(z) */
                             ((1386.0 * z2 - 1260.0) * z2 + 210.0) * z / 16.0,
                             ((6930.0 * z2 - 3780.0) * z2 + 210.0) / 16.0,
                             (27720.0 * z2 - 7560.0) * z / 16.0,
                             (83160.0 * z2 - 7560.0) / 16.0,
                             10395.0 * z,
                             10395.0};
    double re = u[0], im = u[1];
    q[0] += slope[0];
    for (int m = 1; m <= 6; ++m) {
        q[2 * m - 1] += norm[m] * slope[m] * re;
        q[2 * m] += norm[m] * slope[m] * im;
        const double next = re * u[0] - im * u[1];
        im = re * u[1] + im * u[0];
        re = next;
    }
}

typedef float order_vector[N_PARTS];

/* Visits the neighbours of sphere i. With sum: adds their harmonics; without: counts those connected to it. */
static int visit(const brc_pack *pack, int64_t i, double *sum, const order_vector *order)
{
    const double *const a = pack->sphere[i];
    int32_t begin[9], end[9];
    const int n_runs = brc_pack_cells_around(pack, a, begin, end);
    int n_connected = 0;
    for (int run = 0; run < n_runs; ++run)
        for (int32_t k = begin[run]; k < end[run]; ++k) {
            const int32_t j = pack->member[k];
            const double *const b = pack->sphere[j];
            double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
            const double square = u[0] * u[0] + u[1] * u[1] + u[2] * u[2], reach = NEIGHBOUR_REACH * (a[3] + b[3]);
            if (j == i || square >= reach * reach || square == 0.0) continue;
            if (sum) {
                const double inv = 1.0 / sqrt(square);
                for (int c = 0; c < 3; ++c)
                    u[c] *= inv;
                add_harmonics(u, sum);
                continue;
            }
            double product = 0.0;
            for (int p = 0; p < N_PARTS; ++p)
                product += (double)order[i][p] * (double)order[j][p];
            n_connected += product > COHERENCE_LEAST;
        }
    return n_connected;
}

brc_status brc_pack_crystal(brc_pack *pack, double *share)
{
    order_vector *order = NULL;
    int64_t n_ordered = 0;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(pack->context, &order, pack->n, "order of the packing"));
    BRC_TRY_OR(cleanup, brc_pack_sort_cells(pack, NEIGHBOUR_REACH * 2.0 * pack->largest_radius));
#pragma omp parallel for schedule(static) num_threads(pack->n_threads)
    for (int64_t i = 0; i < pack->n; ++i) {
        double q[N_PARTS] = {0.0}, square = 0.0;
        visit(pack, i, q, NULL);
        for (int p = 0; p < N_PARTS; ++p)
            square += q[p] * q[p];
        for (int p = 0; p < N_PARTS; ++p)
            order[i][p] = (float)(square > 0.0 ? q[p] / sqrt(square) : 0.0);
    }
#pragma omp parallel for schedule(static) num_threads(pack->n_threads) reduction(+ : n_ordered)
    for (int64_t i = 0; i < pack->n; ++i)
        n_ordered += visit(pack, i, NULL, (const order_vector *)order) >= CONNECTIONS_LEAST;
    *share = (double)n_ordered / (double)pack->n;
cleanup:
    brc_memory_free(order);
    return status;
}
