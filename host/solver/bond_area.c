/* Areas of bonds from the domain alone, so that they never depend on device, order or state. */
#include "bond_area.h"
#include "strengths.h"
#include <math.h>

static double length_of(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

double brc_bond_area(const brc_domain *d, int64_t bond)
{
    const int64_t h = d->bond_half_edge[bond], j = d->neighbour[h], i = d->neighbour[d->twin[h]];
    if (d->element_kind != BRC_ELEMENT_SPHERE) return length_of(d->area_vector + 3 * h);
    const double branch[3] = {d->position[3 * j] - d->position[3 * i], d->position[3 * j + 1] - d->position[3 * i + 1],
                              d->position[3 * j + 2] - d->position[3 * i + 2]};
    return 3 * brc_strengths_volume(d, bond) / length_of(branch);
}
