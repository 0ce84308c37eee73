/* Reading and writing the state from outside, in the order of element ids. */
#include "closed_faces.h"
#include "contact.h"
#include "simulation_internal.h"
#include <math.h>
#include <string.h>

const brc_scene *brc_simulation_scene(const brc_simulation *s)
{
    return s->scene;
}
const brc_domain *brc_simulation_domain(const brc_simulation *s)
{
    return s->domain;
}
const brc_device *brc_simulation_device(const brc_simulation *s)
{
    return s->device;
}
int32_t brc_simulation_stage(const brc_simulation *s)
{
    return s->stage;
}
int64_t brc_simulation_step(const brc_simulation *s)
{
    return s->step;
}
int64_t brc_simulation_total_steps(const brc_simulation *s)
{
    return s->total_steps;
}
double brc_simulation_setup_seconds(const brc_simulation *s)
{
    return s->setup_seconds;
}
double brc_simulation_step_seconds(const brc_simulation *s)
{
    return s->step_seconds;
}
double brc_simulation_phase_seconds(const brc_simulation *s, brc_step_phase phase)
{
    return phase == BRC_PHASE_NONE ? 0 : s->watch.seconds[phase];
}
brc_time_step brc_simulation_time_step(const brc_simulation *s)
{
    return s->time_step;
}
brc_static_report brc_simulation_static_report(const brc_simulation *s)
{
    return s->static_report;
}
const char *const *brc_simulation_effects_in(const brc_simulation *s)
{
    return s->effects_in;
}
const char *const *brc_simulation_effects_out(const brc_simulation *s)
{
    return s->effects_out;
}

double brc_simulation_time(const brc_simulation *s)
{
    return s->stage >= 0 && brc_current_stage(s)->solver != BRC_SOLVER_DYNAMIC ? s->load_factor : s->time;
}

double brc_simulation_total_time(const brc_simulation *s)
{
    return s->total_time_before + s->time;
}

const double *brc_simulation_modes(const brc_simulation *s, int32_t *n)
{
    *n = s->n_modes;
    return s->modes;
}

brc_status brc_simulation_displacement(brc_simulation *s, double *out)
{
    return brc_state_from_rows(s, s->displacement, out, 3);
}
brc_status brc_simulation_velocity(brc_simulation *s, double *out)
{
    return brc_state_from_rows(s, s->velocity, out, 3);
}
brc_status brc_simulation_force(brc_simulation *s, double *out)
{
    return brc_state_from_rows(s, s->force, out, 3);
}

brc_status brc_simulation_set_state(brc_simulation *s, const double *displacement, const double *velocity)
{
    if (displacement) BRC_TRY(brc_state_to_rows(s, s->displacement, displacement, 3, 0));
    if (velocity) BRC_TRY(brc_state_to_rows(s, s->velocity, velocity, 3, 0));
    if (s->contact && brc_is_dlsm(s))
        BRC_TRY(brc_force_fluxes_of_state(s, NULL, true)); /* H of this state, by which cells reach */
    BRC_TRY(brc_contact_restart(s));
    brc_closed_faces_restart(s);
    return brc_force_of_state(s, BRC_BOOK_START);
}

brc_status brc_simulation_orientation(brc_simulation *s, double *orientation, double *spin)
{
    if (!s->model->turns)
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "model dlsm has no orientations of its own; ask for strains instead");
    BRC_TRY(brc_state_from_rows(s, s->orientation, orientation, 4));
    return spin ? brc_state_from_rows(s, s->spin, spin, 3) : BRC_OK;
}

/* G = F - I of every element [n_elements][9]. */
static brc_status deformation(brc_simulation *s, double *out)
{
    /* B is dead between force evaluations: its buffer takes G */
    BRC_TRY(BRC_RUN(s->pass.deformation, s->n_groups, {"face_loads", BRC_INT(s->loads.held.n_faces > 0 ? 1 : 0)},
                    {"deformation", BRC_BUF(s->flux)}));
    return brc_coeff_from_rows(s, s->flux, out, 9);
}

/* Green strain of G. */
static void green(const double g[9], double e[6])
{
    static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    for (int c = 0; c < 6; ++c) {
        const int i = pair[c][0], j = pair[c][1];
        e[c] = 0.5 * (g[3 * i + j] + g[3 * j + i]);
        for (int k = 0; k < 3; ++k)
            e[c] += 0.5 * g[3 * k + i] * g[3 * k + j];
    }
}

/* F Sigma F^T / det F, F = I + G */
static void cauchy_of(const double g[9], const double sigma[6], double out[6])
{
    static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    const double m[3][3] = {
        {sigma[0], sigma[5], sigma[4]}, {sigma[5], sigma[1], sigma[3]}, {sigma[4], sigma[3], sigma[2]}};
    double f[3][3], t[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            f[i][j] = g[3 * i + j] + (i == j);
    const double det = f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) -
                       f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0]) +
                       f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            t[i][j] = f[i][0] * m[0][j] + f[i][1] * m[1][j] + f[i][2] * m[2][j];
    for (int c = 0; c < 6; ++c) {
        const int i = pair[c][0], j = pair[c][1];
        out[c] = (t[i][0] * f[j][0] + t[i][1] * f[j][1] + t[i][2] * f[j][2]) / det;
    }
}

static void hooke(const brc_elastic *m, const double e[6], double out[6])
{
    const double pressure = m->lambda * (e[0] + e[1] + e[2]);
    for (int c = 0; c < 6; ++c)
        out[c] = 2 * m->mu * e[c] + (c < 3 ? pressure : 0);
}

/* Strain that Hooke's law of the material gives for a stress. */
static void hooke_inverse(const brc_elastic *m, const double sigma[6], double out[6])
{
    const double nu = m->lambda / (2 * (m->lambda + m->mu)), trace = sigma[0] + sigma[1] + sigma[2];
    for (int c = 0; c < 6; ++c)
        out[c] = c < 3 ? ((1 + nu) * sigma[c] - nu * trace) / m->young : sigma[c] / (2 * m->mu);
}

/* cbm: virial stress over an element and its neighbours, and the strain it means. */
static brc_status beams_strain_stress(brc_simulation *s, double *strain, double *stress, double *cauchy)
{
    const int64_t n = s->domain->n_elements;
    double *sigma = NULL;
    BRC_TRY(BRC_ALLOCATE(s->context, &sigma, 6 * n, "virial stress"));
    const brc_status status = brc_beams_stress(s, 1, sigma);
    for (int64_t e = 0; status == BRC_OK && e < n; ++e) {
        if (strain) hooke_inverse(s->elastic + s->material_of_element[e], sigma + 6 * e, strain + 6 * e);
        if (stress) memcpy(stress + 6 * e, sigma + 6 * e, 6 * sizeof *sigma);
        if (cauchy) memcpy(cauchy + 6 * e, sigma + 6 * e, 6 * sizeof *sigma);
    }
    brc_memory_free(sigma);
    return status;
}

brc_status brc_simulation_virial_stress(brc_simulation *s, int level, double *stress)
{
    if (!brc_is_beams(s) || level < 0 || level > 2)
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "virial stress of level %d in model %s: expected level 0, 1 or 2 and model cbm", level,
                        brc_model_name(s->scene->model.kind));
    return brc_beams_stress(s, level, stress);
}

brc_status brc_simulation_strain_stress(brc_simulation *s, double *strain, double *stress, double *cauchy)
{
    const int64_t n = s->domain->n_elements;
    const bool published = brc_is_published(s);
    if (brc_is_beams(s)) return beams_strain_stress(s, strain, stress, cauchy);
    double *g = NULL;
    BRC_TRY(BRC_ALLOCATE(s->context, &g, 9 * n, "deformation"));
    brc_status status = published ? brc_coeff_from_rows(s, s->gradient, g, 6) : deformation(s, g);
    for (int64_t e = 0; status == BRC_OK && e < n; ++e) {
        double own[6], sigma[6], turned[6];
        if (published)
            memcpy(own, g + 6 * e, sizeof own);
        else
            green(g + 9 * e, own);
        hooke(s->elastic + s->material_of_element[e], own, sigma);
        if (published)
            memcpy(turned, sigma, sizeof turned);
        else
            cauchy_of(g + 9 * e, sigma, turned);
        if (strain) memcpy(strain + 6 * e, own, sizeof own);
        if (stress) memcpy(stress + 6 * e, sigma, sizeof sigma);
        if (cauchy) memcpy(cauchy + 6 * e, turned, sizeof turned);
    }
    brc_memory_free(g);
    return status;
}

/* dlsm-published: a face moves rigidly with its element. */
static brc_status published_faces(brc_simulation *s, int64_t n, const int32_t *faces, double *out)
{
    const brc_domain *d = s->domain;
    double *u = NULL, *q = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &u, 3 * d->n_elements, "displacements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &q, 4 * d->n_elements, "orientations"));
    BRC_TRY_OR(cleanup, brc_state_from_rows(s, s->displacement, u, 3));
    BRC_TRY_OR(cleanup, brc_state_from_rows(s, s->orientation, q, 4));
    for (int64_t i = 0; i < n; ++i) {
        const int64_t f = faces[i], e = d->free_element[f];
        double a[3], once[3], twice[3];
        const double w = q[4 * e], *v = q + 4 * e + 1;
        for (int c = 0; c < 3; ++c)
            a[c] = d->free_centroid[3 * f + c] - d->position[3 * e + c];
        for (int c = 0; c < 3; ++c)
            once[c] = v[(c + 1) % 3] * a[(c + 2) % 3] - v[(c + 2) % 3] * a[(c + 1) % 3];
        for (int c = 0; c < 3; ++c)
            twice[c] = v[(c + 1) % 3] * once[(c + 2) % 3] - v[(c + 2) % 3] * once[(c + 1) % 3];
        for (int c = 0; c < 3; ++c)
            out[3 * i + c] = u[3 * e + c] + 2 * (w * once[c] + twice[c]);
    }
cleanup:
    brc_memory_free(u);
    brc_memory_free(q);
    return status;
}

brc_status brc_simulation_face_displacement(brc_simulation *s, int64_t n, const int32_t *faces, double *out)
{
    if (n == 0) return BRC_OK;
    if (brc_is_published(s)) return published_faces(s, n, faces, out);
    const brc_domain *d = s->domain;
    brc_buffer *element = NULL, *arm = NULL, *result = NULL;
    int32_t *rows = NULL;
    double *arms = NULL, *held = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &rows, n, "faces"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &arms, 3 * n, "faces"));
    for (int64_t i = 0; i < n; ++i) {
        const int64_t f = faces[i], e = d->free_element[f];
        rows[i] = s->layout->row_of_element[e];
        for (int c = 0; c < 3; ++c)
            arms[3 * i + c] = d->free_centroid[3 * f + c] - d->position[3 * e + c];
    }
    BRC_TRY_OR(cleanup, brc_new_int(s, &element, rows, n, "faces"));
    BRC_TRY_OR(cleanup, brc_new_coeff(s, &arm, 3 * n, "faces"));
    BRC_TRY_OR(cleanup, brc_upload_coeff(s, arm, arms, 3 * n));
    BRC_TRY_OR(cleanup, brc_new_state(s, &result, 3 * n, "faces"));
    BRC_TRY_OR(cleanup, BRC_RUN(s->pass.face_displacement, n, {"element", BRC_BUF(element)}, {"arm", BRC_BUF(arm)},
                                {"out", BRC_BUF(result)}));
    const int bytes = brc_precision_state_bytes(brc_device_get_precision(s->device));
    BRC_TRY_OR(cleanup, brc_download(s, result, bytes, out, 3 * n));
    const brc_held_faces *h = &s->loads.held;
    if (h->n_faces && h->value) {
        BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &held, 3 * (int64_t)h->n_faces, "held faces"));
        BRC_TRY_OR(cleanup, brc_download(s, h->value, bytes, held, 3 * (int64_t)h->n_faces));
        for (int64_t i = 0; i < n; ++i) {
            const int64_t at = h->index_of_free_face[faces[i]];
            for (int c = 0; at >= 0 && c < 3; ++c)
                if (h->component_of_face[at] >> c & 1) out[3 * i + c] = held[3 * at + c];
        }
    }
cleanup:
    brc_buffer_free(&element);
    brc_buffer_free(&arm);
    brc_buffer_free(&result);
    brc_memory_free(rows);
    brc_memory_free(arms);
    brc_memory_free(held);
    return status;
}

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
    const brc_held_faces *h = &s->loads.held;
    const int bytes = brc_precision_state_bytes(brc_device_get_precision(s->device));
    double *values = NULL, *u = NULL;
    brc_status status = BRC_OK;
    if (set->kind != BRC_SET_FACES || h->n_faces == 0) return BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &values, 3 * (int64_t)h->n_faces, "reactions"));
    BRC_TRY_OR(cleanup, brc_download(s, h->reaction, bytes, values, 3 * (int64_t)h->n_faces));
    if (sum->moments) {
        BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &u, 3 * set->n_members, "reactions"));
        BRC_TRY_OR(cleanup, brc_simulation_face_displacement(s, set->n_members, set->members, u));
    }
    for (int64_t m = 0; m < set->n_members; ++m) {
        const int64_t f = set->members[m], at = h->index_of_free_face[f];
        if (at >= 0) add_reaction(sum, values + 3 * at, d->free_centroid + 3 * f, u ? u + 3 * m : NULL);
    }
cleanup:
    brc_memory_free(values);
    brc_memory_free(u);
    return status;
}

static brc_status element_reactions(brc_simulation *s, const brc_set *set, reaction_sum *sum)
{
    const brc_domain *d = s->domain;
    const int bytes = brc_precision_state_bytes(brc_device_get_precision(s->device));
    double *values = NULL, *u = NULL;
    bool *member = NULL;
    brc_status status = BRC_OK;
    if (s->loads.n_imposed + s->loads.n_turns == 0) return BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &values, 3 * d->n_elements, "reactions"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &member, d->n_elements, "members"));
    for (int64_t m = 0; m < set->n_members; ++m)
        member[set->kind == BRC_SET_ELEMENTS ? set->members[m] : d->free_element[set->members[m]]] = true;
    if (sum->moments) {
        BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &u, 3 * d->n_elements, "reactions"));
        BRC_TRY_OR(cleanup, brc_state_from_rows(s, s->displacement, u, 3));
    }
    for (int32_t i = 0; i < s->loads.n_imposed; ++i) {
        const brc_imposed_load *m = s->loads.imposed + i;
        BRC_TRY_OR(cleanup, brc_download(s, m->reaction, bytes, values, 3 * (int64_t)m->n));
        for (int32_t k = 0; k < m->n; ++k) {
            const int64_t e = m->element_id[k];
            if (member[e]) add_reaction(sum, values + 3 * (int64_t)k, d->position + 3 * e, u ? u + 3 * e : NULL);
        }
    }
    for (int32_t i = 0; sum->moments && i < s->loads.n_turns; ++i) {
        const brc_turn_load *m = s->loads.turns + i;
        BRC_TRY_OR(cleanup, brc_download(s, m->reaction, bytes, values, 3 * (int64_t)m->n));
        for (int32_t k = 0; k < m->n; ++k)
            for (int c = 0; member[m->element_id[k]] && c < 3; ++c)
                sum->moment[c] += values[3 * (int64_t)k + c];
    }
cleanup:
    brc_memory_free(values);
    brc_memory_free(u);
    brc_memory_free(member);
    return status;
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
    for (int32_t i = 0; i < s->loads.n_pushes; ++i) {
        const brc_push_load *p = s->loads.pushes + i;
        for (int32_t k = 0; k < p->n; ++k)
            for (int c = 0; c < 3; ++c)
                out[3 * (int64_t)p->element_id[k] + c] += p->factor * p->total_of[3 * (int64_t)k + c];
    }
    return BRC_OK;
}
