/* Equilibrium of cbm: bonds of multigrid. */
#include "cbm_internal.h"

void brc_cbm_bond(const brc_simulation *s, int64_t e, int64_t other, double length, double square, double stiffness[4])
{
    const brc_beam *a = brc_beam_of_element(s, e), *b = brc_beam_of_element(s, other);
    const double bend = brc_in_series(a->bend, b->bend) / length;
    stiffness[0] = brc_in_series(a->axial, b->axial) / length;
    stiffness[1] = 6 * bend / square;
    stiffness[2] = 0.5 * bend;
    stiffness[3] = brc_in_series(a->twist, b->twist) / length;
}
