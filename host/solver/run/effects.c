/* Which effects a run contains and leaves out, and the least bytes a step must move. */
#include "../models/cbm/beam_softening.h"
#include "../models/dlsm/cell_softening.h"
#include "../effects/noise_damping.h"

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
    return s->model->floor_bytes(s);
}
