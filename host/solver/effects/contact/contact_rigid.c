/* Cells of dlsm that have lost all their bonds, as rigid bodies (contact_rigid.cl). */
#include "../../../../preprocess/domain/domain_rows.h"
#include "../fracture/breaking.h"
#include "../loads/loads.h"
#include "contact_internal.h"
#include "../../core/loaded_faces.h"

/* Elements with a face that a load holds or pulls. */
static brc_status mark_loaded(brc_simulation *s, const brc_load *load, int32_t *loaded)
{
    const brc_domain *d = s->domain;
    const int32_t at =
        brc_load_holds_faces(load) || brc_load_pulls_faces(load) ? brc_domain_find_set(d, load->set) : -1;
    BRC_FREED brc_loaded_face *pulled = NULL;
    int64_t n = 0;
    if (at < 0 || d->sets[at].kind != BRC_SET_FACES) return BRC_OK; /* refused where the stage begins */
    if (brc_load_pulls_faces(load))
        BRC_TRY(brc_loaded_faces(s->context, s->scene, d, d->sets + at, &pulled, &n));
    else
        n = d->sets[at].n_members;
    for (int64_t m = 0; m < n; ++m)
        loaded[s->layout->row_of_element[d->free_element[pulled ? pulled[m].face : d->sets[at].members[m]]]] = 1;
    return BRC_OK;
}

/* Those of the loads of all stages. */
static brc_status find_loaded(brc_simulation *s)
{
    BRC_LOCAL(s->context, s->layout->n_rows, int32_t, loaded, "elements with loaded faces");
    for (int32_t k = 0; k < s->scene->n_stages; ++k)
        for (int32_t l = 0; l < s->scene->stages[k].n_loads; ++l)
            BRC_TRY(mark_loaded(s, s->scene->stages[k].loads + l, loaded));
    return brc_upload_int(s->contact->loaded, loaded, s->layout->n_rows);
}

static brc_status make_passes(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    brc_contact_scopes in;
    brc_contact_scopes_make(s, &in);
    const brc_scope sums = brc_scope_of_sums(s, &in.now);
    BRC_TRY(BRC_PASSES(s, &in.now, BRC_PASS(&c->pass.pose, "contact_pose", NULL),
                       BRC_PASS(&c->pass.turn, "contact_turn", "kick drift extra")));
    return BRC_PASSES(s, &sums, BRC_PASS(&c->pass.detach, "contact_detach", NULL),
                      BRC_PASS(&c->pass.spin_energy, "contact_spin_energy", NULL));
}

brc_status brc_contact_rigid_create(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const brc_domain *d = s->domain;
    c->detaches = c->turned != NULL;
    if (!c->detaches) return BRC_OK;
    BRC_TRY(find_loaded(s));
    BRC_TRY(make_passes(s));
    BRC_LOCAL(s->context, 6 * d->n_elements, double, inertia, "inertia of cells");
    BRC_LOCAL(s->context, 4 * d->n_elements, double, upright, "orientations of cells");
    for (int64_t e = 0; e < d->n_elements; ++e) {
        for (int k = 0; k < 6 && brc_domain_mine(d, e); ++k)
            inertia[6 * e + k] = d->inertia[6 * e + k] * s->elastic[s->material_of_element[e]].density;
        upright[4 * e] = 1;
    }
    if (d->here) BRC_TRY(brc_domain_elements(s->context, d, 6, inertia));
    BRC_TRY(brc_state_to_rows(s, c->inertia, inertia, 6, 1));
    return brc_state_to_rows(s, c->turned, upright, 4, 0);
}

brc_status brc_contact_detach(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const int32_t n = s->layout->n_rows;
    if (!c->detaches) return BRC_OK;
    BRC_TRY(brc_pass_run(c->pass.detach, n));
    BRC_TRY(brc_vector_sum(s, brc_kinetic_of(s), n, &c->n_rigid));
    return brc_contact_pose(s);
}

brc_status brc_contact_list_bonded(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    if (!c || !c->detaches || !s->fracture || !(2 * c->n_rigid > (double)s->domain->n_elements)) return BRC_OK;
    if (!c->bonded) {
        BRC_TRY(BRC_ALLOCATE(s->context, &c->bonded, 1, "cells with bonds"));
        BRC_TRY(brc_fields_create(s->device, &brc_bonded_list_fields, &s->wants, c->bonded));
    }
    return brc_rings_without(s, brc_cell_breaks_rings(s), c->rigid, c->bonded);
}

BRC_READ(const brc_ring_list *, brc_contact_bonded, s->contact ? s->contact->bonded : NULL)

brc_status brc_contact_pose(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    if (!c || !(c->n_rigid > 0)) return BRC_OK;
    return brc_pass_run(c->pass.pose, s->layout->n_rows);
}

brc_status brc_contact_turn(brc_simulation *s, double kick, double drift, double extra)
{
    brc_contact_state *c = s->contact;
    if (!c || !(c->n_rigid > 0) || !s->scene->contact.rotation) return BRC_OK;
    return BRC_RUN(c->pass.turn, s->n_groups, {"kick", BRC_STATE(kick)}, {"drift", BRC_STATE(drift)},
                   {"extra", BRC_STATE(extra)});
}

brc_status brc_contact_spin_energy(brc_simulation *s, double *out)
{
    brc_contact_state *c = s->contact;
    const int32_t n = s->layout->n_rows;
    *out = 0;
    if (!(c->n_rigid > 0)) return BRC_OK;
    BRC_TRY(brc_pass_run(c->pass.spin_energy, n));
    return brc_vector_sum(s, brc_kinetic_of(s), n, out);
}
