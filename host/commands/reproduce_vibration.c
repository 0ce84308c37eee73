/* Modes of a free box of cells against Rayleigh-Ritz. */
#include "reference_vibration.h"
#include "reproduce.h"
#include <math.h>
#include <string.h>

#define MODES_MOST 24
#define DEGREE 14 /* four digits at any nu (design: section 5 of the law) */

brc_status brc_vibration_values(brc_context *context, brc_simulation *simulation, brc_outcome *outcome)
{
    int32_t n;
    const double *omega = brc_simulation_modes(simulation, &n);
    const brc_scene *scene = brc_simulation_scene(simulation);
    const brc_body *body = &scene->bodies[0];
    if (n < 1 || body->shape.kind != BRC_SHAPE_BOX)
        return BRC_FAIL(context, BRC_BAD_INPUT, "run %s: vibration needs a box and a modes stage at the end", outcome->run->name);
    if (n > MODES_MOST) n = MODES_MOST;
    const brc_material *material = &scene->materials[body->material];
    brc_reference_box box = {.young = material->young, .poisson = material->poisson, .density = material->density};
    memcpy(box.size, body->shape.size, sizeof box.size);
    double exact[MODES_MOST], squares = 0;
    BRC_TRY(brc_reference_vibration(context, &box, DEGREE, n, exact));
    for (int32_t k = 0; k < n; ++k) {
        char name[BRC_NAME];
        snprintf(name, sizeof name, "mode_%d", (int)k + 1);
        brc_outcome_add(outcome, name, "rad/s", omega[k], exact[k]);
        squares += (omega[k] / exact[k] - 1) * (omega[k] / exact[k] - 1);
    }
    brc_outcome_add(outcome, "rms", "-", sqrt(squares / n), 0);
    return BRC_OK;
}
