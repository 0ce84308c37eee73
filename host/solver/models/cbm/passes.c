/* Passes of cbm. */
#include "../../core/awake.h"
#include "cbm_internal.h"

brc_status brc_cbm_create(brc_simulation *s)
{
    BRC_TRY(brc_memory_allocate(s->context, &s->of_model, 1, sizeof(brc_cbm_own), "model cbm"));
    return brc_beams_create(s);
}

void brc_cbm_free(brc_simulation *s)
{
    if (s->of_model) brc_memory_free(brc_cbm_own_of(s)->beam);
    brc_memory_free(s->of_model);
}

static void set_beam(brc_simulation *s)
{
    const brc_beam *beam = brc_beam_of_element(s, 0);
    brc_set_beam(s, beam->axial, beam->bend, beam->twist);
}

brc_status brc_cbm_renew(brc_simulation *s)
{
    brc_memory_free(brc_cbm_own_of(s)->beam);
    brc_cbm_own_of(s)->beam = NULL;
    BRC_TRY(brc_beams_create(s));
    set_beam(s);
    return brc_beams_upload(s);
}

brc_status brc_cbm_make_passes(brc_simulation *s, const brc_scope *run, const brc_scope *request)
{
    brc_cbm_own *p = brc_cbm_own_of(s);
    set_beam(s);
    BRC_TRY(BRC_PASSES(s, request, BRC_PASS(&p->force, "cbm_force_pass", NULL)));
    BRC_TRY(brc_awake_passes(s, 1, (const brc_pass *const[]){p->force}));
    return BRC_PASSES(s, run, BRC_PASS(&p->energy, "cbm_energy", NULL), BRC_PASS(&p->virial, "cbm_virial", "virial"));
}
