/* Areas of bonds from the domain alone, so that they never depend on device, order or state. */
#include "bond_area.h"
#include "../../core/sym3.h"
#include "strengths.h"
#include <lapacke.h>
#include <math.h>

double brc_bond_area(const brc_domain *d, int64_t bond)
{
    const int64_t h = d->bond_half_edge[bond], j = d->neighbour[h], i = d->neighbour[d->twin[h]];
    if (d->element_kind != BRC_ELEMENT_SPHERE) return brc_norm3(d->area_vector + 3 * h);
    const double branch[3] = {d->position[3 * j] - d->position[3 * i], d->position[3 * j + 1] - d->position[3 * i + 1],
                              d->position[3 * j + 2] - d->position[3 * i + 2]};
    return 3 * brc_strengths_volume(d, bond) / brc_norm3(branch);
}

/* n (x) n as a vector whose products are those of the tensors. */
static void dyad(const double n[3], double q[6])
{
    const double root = 1.4142135623730951;
    const double value[6] = {n[0] * n[0],        n[1] * n[1],        n[2] * n[2],
                             root * n[1] * n[2], root * n[0] * n[2], root * n[0] * n[1]};
    for (int k = 0; k < 6; ++k)
        q[k] = value[k];
}

static void direction(const brc_domain *d, int64_t e, int64_t h, double n[3])
{
    for (int k = 0; k < 3; ++k)
        n[k] = d->position[3 * (int64_t)d->neighbour[h] + k] - d->position[3 * e + k];
    const double length = brc_norm3(n);
    for (int k = 0; k < 3; ++k)
        n[k] /= length;
}

/* m of the shares 1 + m.q of element e: as small as they must be, with a little room for what its bonds cannot
 * close. */
static void closing(const brc_domain *d, int64_t e, double m[6])
{
    const double room = 0.1, each = 1 / (double)(d->row_start[e + 1] - d->row_start[e]);
    double gram[36] = {0}, mean[3] = {0}, q[6];
    for (int k = 0; k < 6; ++k)
        gram[7 * k] = room, m[k] = k < 3 ? 1 : 0;
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        double n[3];
        direction(d, e, h, n);
        dyad(n, q);
        for (int k = 0; k < 3; ++k)
            mean[k] += each * n[k];
        for (int k = 0; k < 6; ++k)
            m[k] -= 3 * each * q[k];
        for (int k = 0; k < 36; ++k)
            gram[k] += 3 * each * q[k / 6] * q[k % 6];
    }
    dyad(mean, q);
    for (int k = 0; k < 6; ++k)
        m[k] -= 2 * q[k];
    if (LAPACKE_dposv_work(LAPACK_COL_MAJOR, 'U', 6, 1, gram, 6, m, 6) != 0) /* gram is positive definite by `room` */
        for (int k = 0; k < 6; ++k)
            m[k] = 0;
}

brc_status brc_bond_areas_closed(brc_context *context, const brc_domain *d, double *area)
{
    const double least = 0.2, most = 3; /* of an equal share */
    if (d->element_kind != BRC_ELEMENT_SPHERE)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "areas that close the volumes are for spheres; the bonds of cells have faces");
    for (int64_t b = 0; b < d->n_bonds; ++b)
        area[b] = 0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const int64_t degree = d->row_start[e + 1] - d->row_start[e];
        double m[6], n[3], q[6];
        if (degree == 0) continue;
        closing(d, e, m);
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
            const double *from = d->position + 3 * e, *to = d->position + 3 * (int64_t)d->neighbour[h];
            const double branch[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
            double share = 1;
            direction(d, e, h, n);
            dyad(n, q);
            for (int k = 0; k < 6; ++k)
                share += m[k] * q[k];
            area[d->bond[h]] +=
                3 * fmin(fmax(share, least), most) * d->volume[e] / ((double)degree * brc_norm3(branch));
        }
    }
    return BRC_OK;
}
