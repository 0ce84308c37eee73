/* Passes of dlsm-published. */
#include "../../core/awake.h"
#include "published_internal.h"

brc_status brc_published_create(brc_simulation *s)
{
    return brc_memory_allocate(s->context, &s->of_model, 1, sizeof(brc_published_own), "model dlsm-published");
}

void brc_published_free(brc_simulation *s)
{
    brc_memory_free(s->of_model);
}

brc_status brc_published_make_passes(brc_simulation *s, const brc_scope *run, const brc_scope *request)
{
    brc_published_own *p = brc_published_own_of(s);
    const bool whole = !s->scene->has_fracture;
    BRC_TRY(BRC_PASSES(s, request, BRC_PASS(&p->strain, "published_strain_pass", NULL),
                       BRC_PASS(&p->force, "published_force_pass", NULL),
                       {&p->force_listed, "published_force_pass_listed", BRC_LISTED, whole}));
    BRC_TRY(brc_awake_passes(s, 2, (const brc_pass *const[]){p->strain, p->force}));
    return BRC_PASSES(s, run, BRC_PASS(&p->energy, "published_energy", NULL),
                      {&p->energy_listed, "published_energy_listed", BRC_LISTED, whole});
}

brc_status brc_published_make_face_passes(brc_simulation *s, const brc_face_scopes *in)
{
    return BRC_PASSES(s, in->traction, BRC_PASS(&brc_published_own_of(s)->traction, "traction_turned_pass", "factor"));
}
