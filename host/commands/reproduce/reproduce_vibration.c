/* Modes of a free solid of cells against Rayleigh-Ritz. */
#include "../references/reference_vibration.h"
#include "operators.h"
#include <math.h>
#include <string.h>

#define MODES_MOST 24
#define DEGREE 14 /* four digits at any nu (docs/notebook/theory.md T7) */
#define ROUND_DEGREE 12

static bool solid_of(const brc_body *body, const brc_material *material, brc_reference_solid *out)
{
    const brc_shape *shape = &body->shape;
    const double d = 2 * shape->radius;
    *out = (brc_reference_solid){.young = material->young, .poisson = material->poisson, .density = material->density};
    if (shape->kind == BRC_SHAPE_BOX) {
        memcpy(out->size, shape->size, sizeof out->size);
    } else if (shape->kind == BRC_SHAPE_CYLINDER) {
        out->shape = BRC_REFERENCE_CYLINDER;
        memcpy(out->size, (double[3]){shape->length, d, d}, sizeof out->size);
    } else {
        out->shape = BRC_REFERENCE_SPHERE;
        memcpy(out->size, (double[3]){d, d, d}, sizeof out->size);
    }
    return shape->kind == BRC_SHAPE_BOX || shape->kind == BRC_SHAPE_CYLINDER || shape->kind == BRC_SHAPE_SPHERE;
}

static brc_status finished(brc_context *context, brc_simulation *simulation, brc_outcome *outcome)
{
    int32_t n;
    const double *omega = brc_simulation_modes(simulation, &n);
    const brc_scene *scene = brc_simulation_scene(simulation);
    const brc_body *body = &scene->bodies[0];
    brc_reference_solid solid;
    if (!solid_of(body, &scene->materials[body->material], &solid) || n < 1)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "run %s: vibration needs a box, a cylinder or a sphere, and a modes stage at the end",
                        outcome->run->name);
    if (n > MODES_MOST) n = MODES_MOST;
    double exact[MODES_MOST], squares = 0;
    BRC_TRY(
        brc_reference_vibration(context, &solid, solid.shape == BRC_REFERENCE_BOX ? DEGREE : ROUND_DEGREE, n, exact));
    for (int32_t k = 0; k < n; ++k) {
        char name[BRC_NAME];
        snprintf(name, sizeof name, "mode_%d", (int)k + 1);
        brc_outcome_add(outcome, name, "rad/s", omega[k], exact[k]);
        squares += (omega[k] / exact[k] - 1) * (omega[k] / exact[k] - 1);
    }
    brc_outcome_add(outcome, "rms", "-", sqrt(squares / n), 0);
    return BRC_OK;
}

/* The vibration operator: rms of the relative errors of the modes, and each mode [rad/s] with its exact value. */
const brc_operator brc_operator_vibration = {.name = "vibration", .one_run = true, .finished = finished};
