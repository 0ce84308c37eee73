/* Passes of dlsm-published. */
#include "published.h"

brc_status brc_published_make_passes(brc_simulation *s, const brc_scope *run, const brc_scope *request)
{
    brc_run_passes *p = &s->pass;
    const bool whole = !s->scene->has_fracture;
    BRC_TRY(BRC_PASSES(s, request, BRC_PASS(&p->published_strain, "published_strain_pass", NULL),
                       BRC_PASS(&p->published_force, "published_force_pass", NULL),
                       {&p->published_force_listed, "published_force_pass_listed", BRC_LISTED, whole}));
    return BRC_PASSES(s, run, BRC_PASS(&p->published_energy, "published_energy", NULL),
                      {&p->published_energy_listed, "published_energy_listed", BRC_LISTED, whole});
}

brc_status brc_published_make_face_passes(brc_simulation *s, const brc_face_scopes *in)
{
    return BRC_PASSES(s, in->traction, BRC_PASS(&s->pass.traction_turned, "traction_turned_pass", "factor"));
}
