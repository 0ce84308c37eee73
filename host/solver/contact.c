/* Contact in the course of a run: when to look for pairs, what they add to forces, energy and the time step. */
#include "contact_internal.h"
#include "fracture_internal.h"
#include <math.h>
#include <string.h>

static const double sphere_depth = 0.1; /* CONTACT_DEPTH of kernels/contact_law.h */

static brc_status check_scene(const brc_simulation *s)
{
    for (int32_t i = 0; i < s->scene->n_stages; ++i)
        if (s->scene->stages[i].solver != BRC_SOLVER_DYNAMIC)
            return BRC_FAIL(s->context, BRC_BAD_INPUT,
                            "stage '%s': contact is for dynamic stages; surfaces that open and close have no linear operator to solve with. Use `solver: {dynamic: ...}` with "
                            "mass damping to find a rest, or leave contact out", s->scene->stages[i].name);
    return BRC_OK;
}

static brc_status find_kernels(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    BRC_TRY(brc_kernel_find(s->device, "contact_spheres", &c->kernel.spheres));
    BRC_TRY(brc_kernel_find(s->device, "contact_marked", &c->kernel.marked));
    return brc_kernel_find(s->device, "contact_gather_turning", &c->kernel.gather_turning);
}

brc_status brc_contact_create(brc_simulation *s)
{
    if (!s->scene->has_contact) return BRC_OK;
    BRC_TRY(check_scene(s));
    if (!brc_is_beams(s))
        return BRC_FAIL(s->context, BRC_BAD_INPUT, "interactions: contact: only spheres (model cbm) touch in this version; leave it out");
    BRC_TRY(BRC_ALLOCATE(s->context, &s->contact, 1, "contact"));
    s->contact->affine = brc_is_dlsm(s);
    s->contact->width = s->contact->affine ? 9 : 3;
    BRC_TRY(find_kernels(s));
    BRC_TRY(brc_contact_setup(s));
    return brc_contact_search_create(s);
}

void brc_contact_free(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    if (!c) return;
    brc_contact_search_free(s);
    brc_buffer **all[] = {&c->place, &c->reach, &c->id, &c->body, &c->material, &c->original, &c->exposed, &c->stored, &c->lost_friction, &c->lost_impact, &c->law, &c->result};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) brc_buffer_free(all[k]);
    brc_memory_free(c->law_of);
    brc_memory_free(c);
    s->contact = NULL;
}

int64_t brc_contact_bytes(const brc_scene *scene, int64_t n, int64_t entries, int64_t state_bytes)
{
    if (!scene->has_contact) return 0;
    return entries * 4 + n * (4 * 4 + 2 * 4 + (3 + 1 + 4 + 3) * state_bytes);
}

/* ---- when to look ---- */

brc_status brc_contact_restart(brc_simulation *s) { return s->contact ? brc_contact_search(s) : BRC_OK; }

brc_status brc_contact_follow(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    bool due;
    if (!c) return BRC_OK;
    if (c->quiet > 0) {
        c->quiet -= 1;
        return BRC_OK;
    }
    BRC_TRY(brc_contact_look(s, &due));
    return due ? brc_contact_search(s) : BRC_OK;
}

/* ---- forces ---- */

bool brc_contact_acts(const brc_simulation *s, const brc_force_request *r)
{
    return s->contact && !r->homogeneous && r->displacement == s->displacement && s->contact->now.n_pairs > 0;
}

brc_status brc_contact_pairs(brc_simulation *s, double dt)
{
    brc_contact_state *c = s->contact;
    const brc_contact_list *l = &c->now;
    const int linear = s->scene->contact.spheres == BRC_SPHERES_LINEAR;
    return BRC_LAUNCH(c->kernel.spheres, l->n_pairs, BRC_INT(l->n_pairs), BRC_STATE(dt), BRC_INT(linear), BRC_INT(s->scene->n_materials), BRC_BUF(l->ends),
                      BRC_BUF(c->place), BRC_BUF(s->displacement), BRC_BUF(s->orientation), BRC_BUF(c->reach), BRC_BUF(s->mass), BRC_BUF(c->material),
                      BRC_BUF(c->body), BRC_BUF(c->law), BRC_BUF(l->history), BRC_BUF(c->result));
}

static brc_status gather_turning(brc_simulation *s, double sign, double kick, int book, brc_buffer *force, brc_buffer *torque)
{
    brc_contact_state *c = s->contact;
    const brc_contact_list *l = &c->now;
    return BRC_LAUNCH(c->kernel.gather_turning, l->n_listed, BRC_INT(l->n_listed), BRC_STATE(sign), BRC_STATE(kick), BRC_INT(book), BRC_BUF(l->list),
                      BRC_BUF(l->start), BRC_BUF(l->used), BRC_BUF(l->pair), BRC_BUF(c->result), BRC_BUF(s->mass), BRC_BUF(s->inertia), BRC_BUF(force),
                      BRC_BUF(torque), BRC_BUF(s->velocity), BRC_BUF(s->spin), BRC_BUF(c->stored), BRC_BUF(c->lost_friction), BRC_BUF(c->lost_impact));
}

brc_status brc_contact_forces(brc_simulation *s, const brc_force_request *r)
{
    const bool step = r->book == BRC_BOOK_WORK;
    BRC_TRY(brc_contact_pairs(s, step ? s->time_step.value : 0));
    return gather_turning(s, 1, 0, step, r->force, r->torque);
}

/* ---- breaks ---- */

/* Did a beam break in this step? */
static brc_status beams_broke(brc_simulation *s, bool *out)
{
    double groups;
    BRC_TRY(BRC_LAUNCH(s->contact->kernel.marked, s->n_groups, BRC_INT(s->n_groups), BRC_INT(brc_fracture_moment(s)), BRC_BUF(s->fracture->mark),
                       BRC_BUF(s->kinetic)));
    BRC_TRY(brc_vector_sum(s, s->kinetic, s->n_groups, &groups));
    *out = groups > 0;
    return BRC_OK;
}

brc_status brc_contact_broken(brc_simulation *s, double half_kick)
{
    brc_contact_state *c = s->contact;
    const int32_t n = s->layout->n_rows;
    double before, after;
    bool any;
    if (!c) return BRC_OK;
    BRC_TRY(beams_broke(s, &any));
    if (!any) return BRC_OK;
    BRC_TRY(brc_contact_stored(s, &before));
    if (c->now.n_pairs > 0) BRC_TRY(gather_turning(s, -1, half_kick, 0, s->force, s->torque));
    BRC_TRY(BRC_LAUNCH(c->kernel.expose, n, BRC_INT(n), BRC_BUF(s->fracture->broken), BRC_BUF(c->exposed)));
    BRC_TRY(brc_contact_search(s));
    if (c->now.n_pairs > 0) {
        BRC_TRY(brc_contact_pairs(s, 0));
        BRC_TRY(gather_turning(s, 1, half_kick, 0, s->force, s->torque));
    }
    BRC_TRY(brc_contact_stored(s, &after));
    c->born += after - before;
    return BRC_OK;
}

/* ---- energy and the time step ---- */

brc_status brc_contact_stored(brc_simulation *s, double *out)
{
    *out = 0;
    return s->contact ? brc_vector_sum(s, s->contact->stored, s->layout->n_rows, out) : BRC_OK;
}

brc_status brc_contact_ledger(brc_simulation *s, brc_ledger *ledger)
{
    const int32_t n = s->layout->n_rows;
    if (!s->contact) return BRC_OK;
    BRC_TRY(brc_contact_stored(s, &ledger->contact));
    BRC_TRY(brc_vector_sum(s, s->contact->lost_friction, n, &ledger->friction));
    BRC_TRY(brc_vector_sum(s, s->contact->lost_impact, n, &ledger->impact));
    ledger->fracture -= s->contact->born; /* what a break leaves in the surfaces it did not take away */
    return BRC_OK;
}

/* Two bodies of mass m pressed together from either side by springs k: omega^2 = 2 k / m at a wall or between two springs and 4 k / m between two equal
 * bodies; the tangential spring also turns spheres, R^2 / I = 5 / (2 m), 7/2 of its stiffness in all. */
brc_status brc_contact_critical_step(brc_simulation *s, double *out)
{
    const brc_domain *d = s->domain;
    double fastest = 0;
    *out = INFINITY;
    if (!s->contact) return BRC_OK;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const int32_t own = s->material_of_element[e];
        const double mass = d->volume[e] * s->elastic[own].density;
        for (int32_t other = 0; other < s->scene->n_materials; ++other) {
            const double *law = brc_contact_law_of(s, own, other);
            const bool linear = s->scene->contact.spheres == BRC_SPHERES_LINEAR || law[2] > 0;
            const double k = law[2] > 0 ? law[2] : linear ? law[0] * d->radius[e] : 2 * law[0] * d->radius[e] * sqrt(sphere_depth);
            fastest = fmax(fastest, 4 * k / mass * fmax(1, law[4] > 0 ? 3.5 * law[3] : 0));
        }
    }
    *out = 2 / sqrt(fastest);
    return BRC_OK;
}
