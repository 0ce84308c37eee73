#include "rims.h"
#include "cell_softening.h"
#include "dlsm_internal.h"

BRC_READ(bool, brc_rims_energies_apart, !brc_softening_is_on(s))

bool brc_rims_may_add(const brc_simulation *s, const brc_rings *rings)
{
    return brc_rims_energies_apart(s) && !s->contact && !brc_rings_are_whole(rings);
}

/* Gains take the room of the stresses of marked bonds, which nobody wants once these broke: of P, then of B, 9 numbers
 * an element of the rings 0 to 2 and one more record each. */
int32_t brc_rims_records(const brc_rings *rings)
{
    return brc_rings_around(rings)->n[2] + 1;
}
bool brc_rims_add(const brc_simulation *s, const brc_rings *rings)
{
    return brc_rings_are_placed(rings) && !brc_pass_is_whole(s, brc_rings_around(rings), 2) &&
           2 * 9 * (int64_t)brc_rims_records(rings) <= s->layout->n_slots * s->layout->slice;
}

brc_status brc_rims_make_passes(brc_simulation *s, const brc_scope *cells)
{
    brc_dlsm_own *c = brc_dlsm_own_of(s);
    const brc_scope deltas = brc_scope_of_deltas(s, cells), request = brc_scope_of_request(&deltas);
    const brc_pass_wanted of_request[] = {
        BRC_PASS(&c->rim_stress, "rim_stress", BRC_LISTED " deltas"),
        BRC_PASS(&c->rim_inner_flux, "rim_inner_flux", BRC_LISTED " face_loads fluxes")};
    BRC_TRY(BRC_PASSES_MAKE(s, &request, of_request));
    const brc_pass_wanted of_deltas[] = {BRC_PASS(&c->rim_flux, "rim_flux", BRC_LISTED " fluxes"),
                                         BRC_PASS(&c->rim_force, "rim_force", BRC_LISTED " fluxes")};
    return BRC_PASSES_MAKE(s, &deltas, of_deltas);
}

brc_status brc_rims_stress(brc_simulation *s, const brc_force_request *r)
{
    const brc_dlsm_own *c = brc_dlsm_own_of(s);
    return brc_pass_over(s, NULL, c->rim_stress, brc_rings_around(r->rings), 1, r,
                         BRC_GIVEN({"deltas", BRC_INT(brc_rims_add(s, r->rings) ? 1 : 0)}));
}

brc_status brc_rims_flux(brc_simulation *s, const brc_force_request *r, bool moments)
{
    const brc_dlsm_own *c = brc_dlsm_own_of(s);
    const brc_rings *rings = r->rings;
    const brc_arg records = BRC_INT(brc_rims_records(rings));
    BRC_TRY(brc_pass_over(s, NULL, c->rim_inner_flux, brc_rings_around(rings), 1, r,
                          BRC_GIVEN({"face_loads", BRC_INT(moments ? 1 : 0)}, {"fluxes", records})));
    return brc_pass_over(s, NULL, c->rim_flux, brc_rings_around(rings), 2, NULL, BRC_GIVEN({"fluxes", records}));
}

brc_status brc_rims_force(brc_simulation *s, const brc_rings *rings)
{
    const brc_dlsm_own *c = brc_dlsm_own_of(s);
    if (!brc_rims_add(s, rings)) return BRC_OK;
    return brc_pass_over(s, NULL, c->rim_force, brc_rings_around(rings), 3, NULL,
                         BRC_GIVEN({"fluxes", BRC_INT(brc_rims_records(rings))}));
}
