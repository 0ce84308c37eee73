/* The effects that are there, of effects.def, and those that need nothing of their own. */
#include "effect.h"

#define BRC_EFFECT(descriptor) extern const brc_effect descriptor;
#include "effects.def"
#undef BRC_EFFECT

#define BRC_EFFECT(descriptor) &descriptor,
static const brc_effect *const effects[] = {
#include "effects.def"
};
#undef BRC_EFFECT

const brc_effect *const *brc_effects(int *n)
{
    *n = (int)(sizeof effects / sizeof *effects);
    return effects;
}

BRC_WANTED(many, w->many_materials)
BRC_WANTED(tchamwa, w->tchamwa)
static void ask_tchamwa(brc_wants *w, const int32_t *material)
{
    (void)material;
    for (int32_t i = 0; i < w->scene->n_stages; ++i)
        w->tchamwa |=
            w->scene->stages[i].solver == BRC_SOLVER_DYNAMIC && w->scene->stages[i].integrator == BRC_TCHAMWA_WIELGOSZ;
}
BRC_WANTED(statics, brc_wants_solver(w, BRC_SOLVER_STATIC))
BRC_WANTED(modes, brc_wants_solver(w, BRC_SOLVER_MODES))

const brc_effect brc_several_materials_effect = {.name = "several materials", .in = many};
const brc_effect brc_numerical_damping_effect = {
    .name = "numerical damping (Tchamwa-Wielgosz)", .in = tchamwa, .ask = ask_tchamwa};
const brc_effect brc_static_solver_effect = {.name = "static solver", .in = statics};
const brc_effect brc_free_modes_effect = {.name = "free vibration modes", .in = modes};
