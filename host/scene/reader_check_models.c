/* What stages ask of models that none of the scene's can do. Which of several models a set's elements have is seen when
 * the domain is there. */
#include "reader_internal.h"

typedef bool (*is_able)(const brc_model_traits *traits);

static bool deforms(const brc_model_traits *t)
{
    return t->deforms;
}
static bool turns(const brc_model_traits *t)
{
    return !t->deforms;
}
static bool has_spheres(const brc_model_traits *t)
{
    return t->spheres;
}
static bool has_cells(const brc_model_traits *t)
{
    return !t->spheres;
}

static brc_model_kind model_of(const brc_scene *scene, int body)
{
    return scene->bodies[body].has_model ? scene->bodies[body].model.kind : scene->model.kind;
}

/* Some body's model can. */
static bool any(const brc_scene *scene, is_able can)
{
    for (int b = 0; b < scene->n_bodies; ++b)
        if (can(brc_model_traits_of(model_of(scene, b)))) return true;
    return false;
}

static void check_load(brc_reader *reader, const brc_stage *stage, const brc_load *load)
{
    const brc_scene *scene = reader->scene;
    const bool moves_faces = load->kind == BRC_LOAD_FACE_DISPLACEMENT || load->kind == BRC_LOAD_FACE_VELOCITY;
    if (moves_faces && any(scene, has_cells) && !any(scene, deforms))
        COMPLAIN(reader, NULL, load, "model %s moves whole elements; use %s, of a set of elements",
                 brc_model_name(model_of(scene, 0)),
                 load->kind == BRC_LOAD_FACE_VELOCITY ? "element_velocity" : "element_displacement");
    if (load->kind != BRC_LOAD_ELEMENT_ROTATION) return;
    if (!any(scene, turns))
        COMPLAIN(reader, NULL, load,
                 "element_rotation: elements of model %s have no rotations of their own; use model cbm, or "
                 "dlsm-published in a dynamic stage, or turn faces by their displacements",
                 brc_model_name(model_of(scene, 0)));
    else if (stage->solver != BRC_SOLVER_DYNAMIC && !any(scene, has_spheres))
        COMPLAIN(
            reader, NULL, load,
            "element_rotation: the rotations of model %s are not solved for in this stage; use a dynamic stage, or "
            "model cbm",
            brc_model_name(model_of(scene, 0)));
}

void brc_reader_check_models(brc_reader *reader)
{
    const brc_scene *scene = reader->scene;
    if (scene->n_bodies == 0) return; /* which is told of already */
    for (int k = 0; k < scene->n_stages; ++k) {
        const brc_stage *stage = &scene->stages[k];
        for (int l = 0; l < stage->n_loads; ++l)
            check_load(reader, stage, &stage->loads[l]);
        if (stage->solver == BRC_SOLVER_DYNAMIC && stage->time_step_rule == BRC_TIME_STEP_PUBLISHED &&
            any(scene, has_spheres) && !any(scene, has_cells))
            COMPLAIN(reader, &stage->time_step_rule, stage,
                     "time_step: the published rule is one for cells, model %s has none; use time_step: auto",
                     brc_model_name(model_of(scene, 0)));
        if (stage->solver == BRC_SOLVER_STATIC && stage->most_events > 0 && scene->has_gravity)
            COMPLAIN(reader, &stage->most_events, stage,
                     "events: scale the load, which gravity does not follow; leave out gravity");
    }
}
