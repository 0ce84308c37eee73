/* Passes of cbm. */
#include "cbm.h"

brc_status brc_cbm_make_passes(brc_simulation *s, const brc_scope *run, const brc_scope *request)
{
    brc_run_passes *p = &s->pass;
    const brc_beam *beam = brc_beam_of_element(s, 0);
    s->constant.axial = beam->axial;
    s->constant.bend = beam->bend;
    s->constant.twist = beam->twist;
    BRC_TRY(BRC_PASSES(s, request, BRC_PASS(&p->cbm_force, "cbm_force_pass", NULL)));
    return BRC_PASSES(s, run, BRC_PASS(&p->cbm_energy, "cbm_energy", NULL),
                      BRC_PASS(&p->cbm_virial, "cbm_virial", "virial"));
}
