/* A simulation that knows nothing of mechanics: u = value + gradient x of every point at full load, scaled by the load
 * factor. Included by one source file of a test program, whose definitions then stand in for the solver's. */
#ifndef BRC_TEST_OUTPUT_FAKE_SIMULATION_H
#define BRC_TEST_OUTPUT_FAKE_SIMULATION_H

#include "../../host/solver/effects/guard.h"
#include "../../host/base/memory.h"
#include "../../host/solver/effects/fracture/fragments.h"
#include "../../host/solver/core/phases.h"
#include "../../host/solver/core/regime.h"
#include "../../host/solver/run/stage_end.h"
#include "../../host/solver/effects/strikers/strikers.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

struct brc_simulation {
    const brc_scene *scene;
    const brc_domain *domain;
    brc_device *device;
    brc_observer observer;
    int32_t stage;
    int64_t step;
    double factor; /* load factor */
    double time;   /* of all stages [s] */
    double value[3], gradient[3][3];
    double rotation; /* [rad] about x through `rotation_point`, before the above; at factor 1 */
    double rotation_point[3];
    double stress[6];   /* of element e at factor 1: stress * (1 + graded * x) */
    double graded;      /* [1/m] */
    double reaction[3]; /* at factor 1 */
    brc_ledger ledger;
    const double *modes; /* [n_modes] [rad/s] */
    int32_t n_modes;
    const brc_break *breaks; /* [n_breaks]; NULL: nothing can break */
    int64_t n_breaks;
    const uint8_t *whole;                 /* [n_half_edges] 1: unbroken; NULL: all are */
    const brc_striker_now *strikers;      /* [n_strikers] now */
    const brc_striker_body *striker_body; /* [n_strikers] */
    int32_t n_strikers;
    int displacement_reads, ledger_reads; /* counted */
    brc_status end;                       /* what the run returns after its last increment */
    bool ended;                           /* an observer ended the stage */
    char reason[192];
};

static void fake_point(const brc_simulation *s, const double *x, double *u)
{
    const double a = s->rotation * s->factor, c = cos(a), t = sin(a);
    const double y = x[1] - s->rotation_point[1], z = x[2] - s->rotation_point[2];
    for (int i = 0; i < 3; ++i)
        u[i] =
            s->factor * (s->value[i] + s->gradient[i][0] * x[0] + s->gradient[i][1] * x[1] + s->gradient[i][2] * x[2]);
    u[1] += c * y - t * z - y;
    u[2] += t * y + c * z - z;
}

brc_status brc_simulation_observe(brc_simulation *s, const brc_observer *observer)
{
    s->observer = *observer;
    return BRC_OK;
}

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
    return s->step;
}

double brc_simulation_time(const brc_simulation *s)
{
    return s->factor;
}

double brc_simulation_total_time(const brc_simulation *s)
{
    return s->time;
}

brc_status brc_simulation_displacement(brc_simulation *s, double *out)
{
    ++s->displacement_reads;
    for (int64_t e = 0; e < s->domain->n_elements; ++e)
        fake_point(s, s->domain->position + 3 * e, out + 3 * e);
    return BRC_OK;
}

brc_status brc_simulation_velocity(brc_simulation *s, double *out)
{
    for (int64_t k = 0; k < 3 * s->domain->n_elements; ++k)
        out[k] = 10 * s->domain->position[k];
    return BRC_OK;
}

brc_status brc_simulation_face_displacement(brc_simulation *s, int64_t n, const int32_t *faces, double *out)
{
    for (int64_t k = 0; k < n; ++k)
        fake_point(s, s->domain->free_centroid + 3 * (int64_t)faces[k], out + 3 * k);
    return BRC_OK;
}

brc_status brc_simulation_strain_stress(brc_simulation *s, double *strain, double *stress, double *cauchy)
{
    for (int64_t e = 0; e < s->domain->n_elements; ++e)
        for (int c = 0; c < 6; ++c) {
            const double value = s->factor * s->stress[c] * (1 + s->graded * s->domain->position[3 * e]);
            if (strain) strain[6 * e + c] = value * 1e-9;
            if (stress) stress[6 * e + c] = value;
            if (cauchy) cauchy[6 * e + c] = value;
        }
    return BRC_OK;
}

brc_status brc_simulation_reaction(brc_simulation *s, int32_t set, double out[3])
{
    const double sign = strcmp(s->domain->sets[set].name, "x-") == 0 ? -1 : 1;
    for (int c = 0; c < 3; ++c)
        out[c] = sign * s->factor * s->reaction[c];
    return BRC_OK;
}

/* As if it all acted at (1, 2, 3) m. */
brc_status brc_simulation_reaction_moment(brc_simulation *s, int32_t set, const double point[3], double out[3])
{
    double force[3];
    const double arm[3] = {1 - point[0], 2 - point[1], 3 - point[2]};
    brc_simulation_reaction(s, set, force);
    for (int c = 0; c < 3; ++c)
        out[c] = arm[(c + 1) % 3] * force[(c + 2) % 3] - arm[(c + 2) % 3] * force[(c + 1) % 3];
    return BRC_OK;
}

/* Half a radian about z, times the factor. */
brc_status brc_simulation_orientation(brc_simulation *s, double *orientation, double *spin)
{
    for (int64_t e = 0; e < s->domain->n_elements; ++e) {
        const double q[4] = {cos(0.25 * s->factor), 0, 0, sin(0.25 * s->factor)};
        for (int c = 0; c < 4; ++c)
            orientation[4 * e + c] = q[c];
        for (int c = 0; spin && c < 3; ++c)
            spin[3 * e + c] = 0;
    }
    return BRC_OK;
}

/* 2 N along each position vector's direction from the origin, times its length in metres. */
brc_status brc_simulation_applied_force(brc_simulation *s, double *out)
{
    for (int64_t k = 0; k < 3 * s->domain->n_elements; ++k)
        out[k] = 2 * s->factor * s->domain->position[k];
    return BRC_OK;
}

brc_status brc_simulation_ledger(brc_simulation *s, brc_ledger *out)
{
    ++s->ledger_reads;
    *out = s->ledger;
    return BRC_OK;
}

double brc_ledger_term(const brc_ledger *l, const char *term)
{
    if (strcmp(term, "kinetic") == 0) return l->kinetic;
    if (strcmp(term, "elastic") == 0) return l->elastic;
    return NAN;
}

brc_time_step brc_simulation_time_step(const brc_simulation *s)
{
    (void)s;
    return (brc_time_step){.value = 1e-6, .critical = 1.25e-6, .safety = 0.8, .governed_by = "auto: power iteration"};
}

const double *brc_simulation_modes(const brc_simulation *s, int32_t *n)
{
    *n = s->n_modes;
    return s->modes;
}

brc_static_report brc_simulation_static_report(const brc_simulation *s)
{
    (void)s;
    return (brc_static_report){.iterations = 12, .corrections = 3, .residual = 1e-11};
}

const char *const *brc_simulation_effects_in(const brc_simulation *s)
{
    static const char *const in[] = {"dlsm elasticity", "prescribed faces", NULL};
    (void)s;
    return in;
}

const char *const *brc_simulation_effects_out(const brc_simulation *s)
{
    static const char *const out[] = {"gravity", NULL};
    (void)s;
    return out;
}

bool brc_simulation_has_fracture(const brc_simulation *s)
{
    return s->breaks != NULL;
}

brc_status brc_simulation_broken(brc_simulation *s, int64_t *out)
{
    *out = s->n_breaks;
    return BRC_OK;
}

brc_status brc_simulation_breaks(brc_simulation *s, int64_t *n, const brc_break **out)
{
    *n = s->n_breaks;
    *out = s->breaks;
    return BRC_OK;
}

/* Element e: e / n. */
brc_status brc_simulation_damage(brc_simulation *s, double *out)
{
    for (int64_t e = 0; e < s->domain->n_elements; ++e)
        out[e] = (double)e / (double)s->domain->n_elements;
    return BRC_OK;
}

/* The last element is one of its own. */
brc_status brc_simulation_fragments(brc_simulation *s, int32_t *fragment, int64_t *n_fragments)
{
    for (int64_t e = 0; e < s->domain->n_elements; ++e)
        fragment[e] = e + 1 == s->domain->n_elements;
    *n_fragments = 2;
    return BRC_OK;
}

/* What the fragments above are: all mass in the first, but for a hundredth. */
brc_status brc_simulation_fragment_list(brc_simulation *s, int64_t *n, brc_fragment **out)
{
    brc_context *none = NULL;
    *n = 2;
    BRC_TRY(BRC_ALLOCATE(none, out, 2, "fragments"));
    (*out)[0] = (brc_fragment){
        .n_elements = s->domain->n_elements - 1, .mass = 99, .inertia = {1, 2, 3, 4, 5, 6}, .translation = 7};
    (*out)[1] = (brc_fragment){
        .first_element = (int32_t)s->domain->n_elements - 1, .n_elements = 1, .mass = 1, .velocity = {1, 0, 0}};
    return BRC_OK;
}

/* Set i spins with (i, 2 i, 3 i). */
brc_status brc_simulation_set_motion(brc_simulation *s, int32_t set, brc_fragment *out)
{
    *out = (brc_fragment){.n_elements = s->domain->n_elements, .spin = {set, 2 * set, 3 * set}};
    return BRC_OK;
}

double brc_simulation_implied_fracture_energy(const brc_simulation *s)
{
    (void)s;
    return 0;
}
brc_status brc_simulation_softening(brc_simulation *s, brc_softening_report *out)
{
    (void)s;
    *out = (brc_softening_report){0};
    return BRC_OK;
}
brc_guard_report brc_simulation_guard_report(const brc_simulation *s)
{
    (void)s;
    return (brc_guard_report){0};
}
int32_t brc_simulation_n_strikers(const brc_simulation *s)
{
    return s->n_strikers;
}
const brc_striker_body *brc_simulation_striker_body(const brc_simulation *s, int32_t striker)
{
    return s->striker_body + striker;
}
brc_status brc_simulation_striker_now(brc_simulation *s, int32_t striker, brc_striker_now *out)
{
    *out = s->strikers[striker];
    return BRC_OK;
}

brc_status brc_simulation_whole(brc_simulation *s, uint8_t **out)
{
    brc_context *none = NULL;
    const int64_t n = s->domain->row_start[s->domain->n_elements];
    *out = NULL;
    if (!s->whole) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(none, out, n, "whole bonds"));
    memcpy(*out, s->whole, (size_t)n);
    return BRC_OK;
}

double brc_simulation_beam_radius(const brc_simulation *s, int64_t e)
{
    (void)s, (void)e;
    return 0.1;
}

/* The load factor. */
brc_status brc_simulation_failure_ratio(brc_simulation *s, double *out)
{
    *out = s->factor;
    return BRC_OK;
}

brc_regime brc_simulation_regime(const brc_simulation *s)
{
    (void)s;
    return (brc_regime){.broke = true, .at_first_break = 0.01, .at_peak = 0.02, .until_peak = 0.03};
}

void brc_simulation_end_stage(brc_simulation *s, const char *reason)
{
    s->ended = true;
    snprintf(s->reason, sizeof s->reason, "%s", reason);
}

const char *brc_simulation_stage_reason(const brc_simulation *s, int32_t stage)
{
    return stage == s->stage ? s->reason : "";
}

const char *brc_break_mode_name(int32_t mode)
{
    return mode == BRC_BREAK_TENSION ? "tension" : mode == BRC_BREAK_COMPRESSION ? "compression" : "shear";
}

double brc_simulation_setup_seconds(const brc_simulation *s)
{
    (void)s;
    return 0.25;
}

double brc_simulation_step_seconds(const brc_simulation *s)
{
    (void)s;
    return 2;
}

brc_rest_account brc_simulation_at_rest(const brc_simulation *s)
{
    (void)s;
    return (brc_rest_account){.left_out = 1, .all = 4};
}

double brc_simulation_phase_seconds(const brc_simulation *s, brc_step_phase phase)
{
    (void)s;
    return phase == BRC_PHASE_SEARCH ? 0.25 : 0;
}

/* Four increments with a sample each, frames at the start and at the end. */
brc_status brc_simulation_run(brc_simulation *s)
{
    s->stage = 0;
    for (s->step = 0; s->step <= 4; ++s->step) {
        s->factor = (double)s->step / 4;
        BRC_TRY(s->observer.sample(s->observer.self, s));
        if (s->step == 0 || s->step == 4) BRC_TRY(s->observer.frame(s->observer.self, s));
    }
    s->step = 4;
    return s->end;
}

#endif
