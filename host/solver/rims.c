#include "rims.h"
#include "cell_breaks_internal.h"
#include "cell_softening.h"

bool brc_rims_energies_apart(const brc_simulation *s) { return brc_is_dlsm(s) && !brc_softening_is_on(s); }

bool brc_rims_may_gain(const brc_simulation *s, const brc_rings *rings) { return brc_rims_energies_apart(s) && !s->contact && !rings->whole_force; }

/* Gains take the room of the stresses of marked bonds, which nobody wants once these broke: of P, then of B, 9 numbers an element of the rings 0 to 2 and one more record each. */
int32_t brc_rims_records(const brc_rings *rings) { return rings->around.n[2] + 1; }
bool brc_rims_gain(const brc_simulation *s, const brc_rings *rings)
{
    return rings->placed && !brc_pass_is_whole(s, &rings->around, 2) && 2 * 9 * (int64_t)brc_rims_records(rings) <= s->layout->n_slots * s->layout->slice;
}

brc_status brc_rims_stress(brc_simulation *s, const brc_force_request *r, bool face_loads)
{
    const brc_elastic *m = s->elastic + s->material_of_element[0];
    const brc_cell_breaks *c = s->fracture->cells;
    return BRC_PASS(s, NULL, c->rim_stress, &r->rings->around, 1, BRC_BUF(s->row_start), BRC_BUF(s->neighbour), BRC_BUF(s->area), BRC_BUF(s->offset), BRC_BUF(s->gradient),
                    BRC_BUF(s->inv_volume), BRC_BUF(s->boundary), BRC_BUF(s->held_gradient), BRC_INT(face_loads ? 1 : 0), BRC_COEFF(m->lambda), BRC_COEFF(m->mu),
                    BRC_BUF(s->material), BRC_INT(r->finite ? 1 : 0), BRC_BUF(s->stress), BRC_BUF(s->elastic_energy), BRC_INT(brc_rims_gain(s, r->rings) ? 1 : 0),
                    BRC_BUF(r->rings->level), BRC_BUF(c->measure));
}

brc_status brc_rims_flux(brc_simulation *s, const brc_rings *rings, int n_args, brc_arg *args)
{
    const brc_cell_breaks *c = s->fracture->cells;
    args[n_args] = BRC_INT(brc_rims_records(rings)), args[n_args + 1] = BRC_BUF(rings->level), args[n_args + 2] = BRC_BUF(c->measure);
    BRC_TRY(brc_pass_launch(s, NULL, c->rim_inner_flux, &rings->around, 1, n_args + BRC_RIM_ARGS, args));
    return BRC_PASS(s, NULL, c->rim_flux, &rings->around, 2, BRC_INT(brc_rims_records(rings)), BRC_BUF(s->row_start), BRC_BUF(s->neighbour), BRC_BUF(s->area), BRC_BUF(s->offset),
                    BRC_BUF(s->inv_shape), BRC_BUF(rings->level), BRC_BUF(c->measure), BRC_BUF(s->flux));
}

brc_status brc_rims_force(brc_simulation *s, const brc_rings *rings)
{
    const brc_cell_breaks *c = s->fracture->cells;
    if (!brc_rims_gain(s, rings)) return BRC_OK;
    return BRC_PASS(s, NULL, c->rim_force, &rings->around, 3, BRC_INT(brc_rims_records(rings)), BRC_BUF(s->row_start), BRC_BUF(s->neighbour), BRC_BUF(s->area),
                      BRC_BUF(rings->level), BRC_BUF(c->measure), BRC_STATE(rings->half_kick), BRC_BUF(s->mass), BRC_BUF(s->force), BRC_BUF(s->velocity), BRC_BUF(rings->force));
}
