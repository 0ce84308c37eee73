/* Pressed discs and pulled rings. */
#include "operators.h"
#include "../references/reference_plane.h"
#include "../bench/sweep.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DISC_PART 0.6
#define RING_PART 3.0
#define NEAR_PART 1.25

typedef struct plane {
    bool ring;
    double outer, inner, half_angle;
    double nominal; /* [Pa] */
    brc_reference_ring exact;
} plane;

static brc_status find_ring(brc_context *context, const brc_scene *scene, plane *out)
{
    const brc_material *m = &scene->materials[scene->bodies[0].material];
    const brc_stage *stage = &scene->stages[scene->n_stages - 1];
    for (int32_t l = 0; l < stage->n_loads; ++l) {
        const double xx = stage->loads[l].gradient[0][0], zz = stage->loads[l].gradient[2][2];
        const double mu = m->young / (2 * (1 + m->poisson)), lambda = 2 * mu * m->poisson / (1 - 2 * m->poisson);
        if (xx == 0) continue;
        out->nominal = fabs(lambda * (xx + zz) + 2 * mu * xx);
        return brc_reference_ring_solve(context, out->inner, out->outer, m->young, m->poisson, xx, zz, &out->exact);
    }
    return BRC_FAIL(context, BRC_BAD_INPUT, "`with: field` expects a load with a gradient on the outside of a ring");
}

static brc_status find_plane(brc_context *context, brc_simulation *simulation, const brc_outcome *outcome, plane *out)
{
    const brc_scene *scene = brc_simulation_scene(simulation);
    const brc_domain *domain = brc_simulation_domain(simulation);
    const brc_shape *shape = &scene->bodies[0].shape;
    *out = (plane){.half_angle = outcome->run->half_angle};
    if (shape->kind != BRC_SHAPE_PARTS || shape->parts[0].shape.kind != BRC_SHAPE_CYLINDER ||
        shape->parts[0].shape.axis != 1)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "run %s: `with: field` expects a body whose first part is a cylinder about y",
                        outcome->run->name);
    out->outer = shape->parts[0].shape.radius;
    for (int32_t p = 1; p < shape->n_parts; ++p)
        if (shape->parts[p].role == BRC_PART_REMOVE && shape->parts[p].shape.kind == BRC_SHAPE_CYLINDER)
            out->inner = shape->parts[p].shape.radius;
    out->ring = out->inner > 0;
    if (out->ring) return find_ring(context, scene, out);
    double force[3];
    const int32_t middle = brc_domain_find_set(domain, "middle");
    if (middle < 0 || !(out->half_angle > 0))
        return BRC_FAIL(context, BRC_BAD_INPUT, "run %s: `with: field` expects a set `middle` and a half_angle",
                        outcome->run->name);
    BRC_TRY(brc_simulation_reaction(simulation, middle, force));
    out->nominal = 2 * fabs(force[2]) / (M_PI * shape->parts[0].shape.length * out->outer);
    return BRC_OK;
}

/* Exact stress over the nominal one at a place of the plane. */
static void exact_at(const plane *p, double x, double z, double out[3])
{
    if (!p->ring) {
        brc_reference_disc(p->half_angle, x / p->outer, z / p->outer, out);
        return;
    }
    brc_reference_ring_at(&p->exact, x, z, out, NULL);
    for (int c = 0; c < 3; ++c)
        out[c] /= p->nominal;
}

/* Larger principal stress in the plane. */
static double principal(const double s[3])
{
    return (s[0] + s[1]) / 2 + sqrt((s[0] - s[1]) * (s[0] - s[1]) / 4 + s[2] * s[2]);
}

/* Of beams: over as many shells of neighbours as the run's label `level` says. */
static brc_status stresses(brc_simulation *simulation, const brc_case_run *run, double *out)
{
    const char *level = brc_sweep_value(run, "level");
    return level ? brc_simulation_virial_stress(simulation, (int)strtol(level, NULL, 10), out)
                 : brc_simulation_strain_stress(simulation, NULL, out, NULL);
}

static brc_status finished(brc_context *context, brc_simulation *simulation, brc_outcome *outcome)
{
    const brc_domain *domain = brc_simulation_domain(simulation);
    plane p;
    double *stress = NULL, squares = 0, volume = 0, largest = 0, exact_largest = 0;
    brc_status status = BRC_OK;
    BRC_TRY(find_plane(context, simulation, outcome, &p));
    BRC_TRY(BRC_ALLOCATE(context, &stress, 6 * domain->n_elements, "stresses of a field"));
    BRC_TRY_OR(cleanup, stresses(simulation, outcome->run, stress));
    const double within = p.ring ? RING_PART * p.inner : DISC_PART * p.outer;
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        const double *at = domain->centroid + 3 * e, *s = stress + 6 * e, radius = sqrt(at[0] * at[0] + at[2] * at[2]);
        double exact[3];
        const double ours[3] = {s[0] / p.nominal, s[2] / p.nominal, s[4] / p.nominal};
        if (radius > within) continue;
        exact_at(&p, at[0], at[2], exact);
        for (int c = 0; c < 3; ++c)
            squares += domain->volume[e] * (c == 2 ? 2 : 1) * (ours[c] - exact[c]) * (ours[c] - exact[c]);
        volume += domain->volume[e];
        if (radius > NEAR_PART * p.inner) continue;
        largest = fmax(largest, principal(ours));
        exact_largest = fmax(exact_largest, principal(exact));
    }
    if (!(volume > 0))
        BRC_TRY_OR(cleanup,
                   BRC_FAIL(context, BRC_BAD_INPUT, "run %s: no element in the part of the field that is compared",
                            outcome->run->name));
    brc_outcome_add(outcome, "field_error", "-", sqrt(squares / volume), 0);
    if (exact_largest > 0) brc_outcome_add(outcome, "peak_error", "-", largest / exact_largest - 1, 0);
cleanup:
    brc_memory_free(stress);
    return status;
}

/* The field operator, once a run ended. The first body is a cylinder about y through the origin, cut by boxes: a
 * quarter of a disc pressed along z over arcs of run->half_angle (its set `middle`, the cut across the load, gives the
 * load); or with a cylinder removed from it, a quarter of a ring, or all of it, whose outside moves by the gradient of
 * a load. Adds field_error: root of the volume mean of |stress - exact|^2 (in-plane components, at the elements'
 * centroids) over the nominal stress, within 0.6 of the disc's radius or three radii of the hole; and, of a ring,
 * peak_error: the largest principal stress of the elements within 1.25 radii of the hole over the exact one at their
 * centroids, minus 1. Of beams the stress is the virial one, over as many shells of neighbours as the run's label
 * `level` says (1 without it). BRC_BAD_INPUT: no such scene. */
const brc_operator brc_operator_field = {.name = "field", .finished = finished};
