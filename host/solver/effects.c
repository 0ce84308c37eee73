/* Which effects a run contains and leaves out, and the least bytes a step must move. */
#include "beam_softening.h"
#include "cell_softening.h"
#include "noise_damping.h"

static void list(brc_simulation *s, const char *name, bool in)
{
    const char **next = in ? s->effects_in : s->effects_out;
    while (*next)
        ++next;
    *next = name;
}

static void list_models(brc_simulation *s)
{
    int n;
    const brc_bond_model *const *models = brc_bond_models(&n);
    for (int m = 0; m < n; ++m)
        for (int k = 0; k < 2 && models[m]->effect[k].name; ++k) {
            const brc_model_effect *e = &models[m]->effect[k];
            list(s, e->name, models[m] == s->model && (!e->in || e->in(s->scene)));
        }
}

void brc_effects_list(brc_simulation *s)
{
    const brc_scene *scene = s->scene;
    bool held = false, traction = false, imposed = false, pushed = false, turned = false, tchamwa = false,
         damped = false, statics = false, modes = false;
    for (int32_t i = 0; i < scene->n_stages; ++i) {
        const brc_stage *stage = scene->stages + i;
        statics = statics || stage->solver == BRC_SOLVER_STATIC;
        modes = modes || stage->solver == BRC_SOLVER_MODES;
        tchamwa = tchamwa || (stage->solver == BRC_SOLVER_DYNAMIC && stage->integrator == BRC_TCHAMWA_WIELGOSZ);
        damped = damped || (stage->solver == BRC_SOLVER_DYNAMIC && stage->mass_damping > 0);
        for (int32_t l = 0; l < stage->n_loads; ++l) {
            const brc_load_kind kind = stage->loads[l].kind;
            held = held || kind == BRC_LOAD_FACE_DISPLACEMENT || kind == BRC_LOAD_FACE_VELOCITY;
            imposed = imposed || kind == BRC_LOAD_ELEMENT_DISPLACEMENT || kind == BRC_LOAD_ELEMENT_VELOCITY;
            traction = traction || kind == BRC_LOAD_TRACTION || kind == BRC_LOAD_PRESSURE;
            pushed = pushed || kind == BRC_LOAD_ELEMENT_FORCE;
            turned = turned || kind == BRC_LOAD_ELEMENT_ROTATION;
        }
    }
    const struct {
        const char *name;
        bool in;
    } effects[] = {{"several materials", brc_device_has_many_materials(s->device)},
                   {"prescribed faces", held},
                   {"tractions", traction},
                   {"imposed elements", imposed},
                   {"forces on elements", pushed},
                   {"prescribed rotations", turned},
                   {"gravity", scene->has_gravity},
                   {"mass damping", damped},
                   {"noise damping", s->wants.noise},
                   {"numerical damping (Tchamwa-Wielgosz)", tchamwa},
                   {"static solver", statics},
                   {"free vibration modes", modes},
                   {"fracture", s->fracture != NULL},
                   {"fracture energy", brc_softening_is_on(s) || brc_beam_softening_is_on(s)},
                   {"walls and strikers", s->strikers != NULL},
                   {"contact", s->contact != NULL}};
    list_models(s);
    for (size_t i = 0; i < sizeof effects / sizeof *effects; ++i)
        list(s, effects[i].name, effects[i].in);
}

double brc_simulation_floor_bytes(const brc_simulation *s)
{
    const brc_precision precision = brc_device_get_precision(s->device);
    const double state = brc_precision_state_bytes(precision), coeff = brc_precision_coeff_bytes(precision);
    const double half_edges = (double)s->domain->n_half_edges, n = (double)s->domain->n_elements;
    const double many = brc_device_has_many_materials(s->device) ? 1 : 0;
    if (brc_is_published(s)) {
        /* strain pass: neighbour, R (S with area weights); u, q, A^-1 read, strain written */
        const double strain =
            half_edges * (4 + (3 + (s->scene->model.area_weights ? 1 : 0)) * coeff) + n * (7 * state + 12 * coeff);
        /* force pass: neighbour, R, S; u, q, strain read, f and t written */
        const double force = half_edges * (4 + 4 * coeff) + n * (7 * state + (6 + 3 * many) * coeff + 6 * state);
        /* motion: f, v, u, m and t, w, q, I read; v, u, w, q written */
        return strain + force + n * (3 + 3 + 3 + 1 + 3 + 3 + 4 + 1 + 3 + 3 + 3 + 4) * state;
    }
    if (brc_is_beams(s)) {
        /* force pass: neighbour, branch, 1/length; u, q read, f and t written; motion as above */
        const double force = half_edges * (4 + 4 * coeff) + n * (7 * state + 3 * many * coeff + 6 * state);
        return force + n * (3 + 3 + 3 + 1 + 3 + 3 + 4 + 1 + 3 + 3 + 3 + 4) * state;
    }
    const double pass1 = half_edges * (4 + 3 * coeff) + n * (3 * state + (6 + 9) * coeff);
    const double pass2 = half_edges * (4 + 6 * coeff) + n * (9 + 1 + 9 + 2 * many) * coeff;
    const double pass3 =
        half_edges * (4 + 7 * coeff) + n * ((9 + 9 + 6 + 1 + 9 + (9 + 4) * many) * coeff + 3 * many * state);
    const double pass4 = half_edges * (4 + 4 * coeff) + n * ((9 + (9 + 1) * many) * coeff + (3 + 3) * state);
    const double motion = n * (3 + 3 + 3 + 1 + 3 + 3) * state;
    return pass1 + pass2 + pass3 + pass4 + motion;
}
