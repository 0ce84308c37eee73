/* What loads do on the members of a set. */
#include "loads_internal.h"
#include <string.h>

/* Sum of the loads with prescribed motion on the members of a set; moments about `point` where they are asked for: only
 * they need to know where the members are now. */
typedef struct reaction_sum {
    double force[3], moment[3], point[3];
    bool moments;
} reaction_sum;

/* u: displacement since the place x was taken; NULL without moments. */
static void add_reaction(reaction_sum *sum, const double force[3], const double x[3], const double *u)
{
    double arm[3];
    for (int c = 0; c < 3; ++c)
        sum->force[c] += force[c];
    if (!sum->moments) return;
    for (int c = 0; c < 3; ++c)
        arm[c] = x[c] + u[c] - sum->point[c];
    for (int c = 0; c < 3; ++c)
        sum->moment[c] += arm[(c + 1) % 3] * force[(c + 2) % 3] - arm[(c + 2) % 3] * force[(c + 1) % 3];
}

/* `reaction` of held faces holds the pull of the held face on its element: the force of the load on the solid. */
static brc_status face_reactions(brc_simulation *s, const brc_set *set, reaction_sum *sum)
{
    const brc_domain *d = s->domain;
    const brc_held_faces *h = &s->loads->held;
    const int bytes = brc_state_bytes(s);
    BRC_FREED double *u = NULL;
    if (set->kind != BRC_SET_FACES || h->n_faces == 0) return BRC_OK;
    BRC_LOCAL(s->context, 3 * (int64_t)h->n_faces, double, values, "reactions");
    BRC_TRY(brc_download(s, h->reaction, bytes, values, 3 * (int64_t)h->n_faces));
    if (sum->moments) {
        BRC_TRY(BRC_ALLOCATE(s->context, &u, 3 * set->n_members, "reactions"));
        BRC_TRY(brc_simulation_face_displacement(s, set->n_members, set->members, u));
    }
    for (int64_t m = 0; m < set->n_members; ++m) {
        const int64_t f = set->members[m], at = h->index_of_free_face[f];
        if (at >= 0) add_reaction(sum, values + 3 * at, d->free_centroid + 3 * f, u ? u + 3 * m : NULL);
    }
    return BRC_OK;
}

static brc_status element_reactions(brc_simulation *s, const brc_set *set, reaction_sum *sum)
{
    const brc_domain *d = s->domain;
    const int bytes = brc_state_bytes(s);
    BRC_FREED double *u = NULL;
    if (s->loads->n_prescribed + s->loads->n_turns == 0) return BRC_OK;
    BRC_LOCAL(s->context, 3 * d->n_elements, double, values, "reactions");
    BRC_LOCAL(s->context, d->n_elements, bool, member, "members");
    for (int64_t m = 0; m < set->n_members; ++m)
        member[set->kind == BRC_SET_ELEMENTS ? set->members[m] : d->free_element[set->members[m]]] = true;
    if (sum->moments) {
        BRC_TRY(BRC_ALLOCATE(s->context, &u, 3 * d->n_elements, "reactions"));
        BRC_TRY(brc_state_from_rows(s, brc_displacement_of(s), u, 3));
    }
    for (int32_t i = 0; i < s->loads->n_prescribed; ++i) {
        const brc_prescribed_load *m = s->loads->prescribed + i;
        BRC_TRY(brc_download(s, m->reaction, bytes, values, 3 * (int64_t)m->n));
        for (int32_t k = 0; k < m->n; ++k) {
            const int64_t e = m->element_id[k];
            if (member[e]) add_reaction(sum, values + 3 * (int64_t)k, d->position + 3 * e, u ? u + 3 * e : NULL);
        }
    }
    for (int32_t i = 0; sum->moments && i < s->loads->n_turns; ++i) {
        const brc_turn_load *m = s->loads->turns + i;
        BRC_TRY(brc_download(s, m->reaction, bytes, values, 3 * (int64_t)m->n));
        for (int32_t k = 0; k < m->n; ++k)
            for (int c = 0; member[m->element_id[k]] && c < 3; ++c)
                sum->moment[c] += values[3 * (int64_t)k + c];
    }
    return BRC_OK;
}

static brc_status reactions(brc_simulation *s, int32_t set, reaction_sum *sum)
{
    BRC_TRY(face_reactions(s, s->domain->sets + set, sum));
    return element_reactions(s, s->domain->sets + set, sum);
}

brc_status brc_simulation_reaction(brc_simulation *s, int32_t set, double out[3])
{
    reaction_sum sum = {.force = {0}};
    BRC_TRY(reactions(s, set, &sum));
    memcpy(out, sum.force, sizeof sum.force);
    return BRC_OK;
}

brc_status brc_simulation_reaction_moment(brc_simulation *s, int32_t set, const double point[3], double out[3])
{
    reaction_sum sum = {.point = {point[0], point[1], point[2]}, .moments = true};
    BRC_TRY(reactions(s, set, &sum));
    memcpy(out, sum.moment, sizeof sum.moment);
    return BRC_OK;
}

brc_status brc_simulation_applied_force(brc_simulation *s, double *out)
{
    memset(out, 0, 3 * (size_t)s->domain->n_elements * sizeof *out);
    for (int32_t i = 0; i < s->loads->n_pushes; ++i) {
        const brc_push_load *p = s->loads->pushes + i;
        for (int32_t k = 0; k < p->n; ++k)
            for (int c = 0; c < 3; ++c)
                out[3 * (int64_t)p->element_id[k] + c] += p->factor * p->total_of[3 * (int64_t)k + c];
    }
    return BRC_OK;
}
