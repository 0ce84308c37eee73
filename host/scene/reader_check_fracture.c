/* Scenes that break: strengths that fit together, models and stages that know them, and scenes in which nothing can
 * break. */
#include "reader_internal.h"
#include "schema_internal.h"
#include <math.h>
#include <string.h>

/* Strengths that contradict themselves. */
static void check_material(brc_reader *reader, const brc_material *material)
{
    const brc_scatter *scatter = &material->scatter;
    if (material->fracture_energy > 0 && !(material->tension > 0))
        COMPLAIN(reader, &material->fracture_energy, material,
                 "fracture_energy: says how cohesion falls from the strength; expected `tension` beside it");
    if (material->shear_fracture_energy > 0 && !(material->fracture_energy > 0))
        COMPLAIN(reader, &material->shear_fracture_energy, material,
                 "shear_fracture_energy: is of cracks that slide, beside that of cracks that open; expected "
                 "`fracture_energy` beside it");
    if (material->measured_by != BRC_STRENGTH_BY_TENSION && !(material->tension > 0))
        COMPLAIN(reader, &material->measured_by, material,
                 "measured_by: says what test `tension` comes from; expected `tension` beside it");
    if (material->measured_by != BRC_STRENGTH_BY_TENSION && material->beam_strength > 0)
        COMPLAIN(reader, &material->measured_by, material,
                 "measured_by: decides nothing where `beam` gives the strength of beams; leave out one of them");
    if (material->measured_by != BRC_STRENGTH_BY_TENSION && material->fracture_energy > 0)
        COMPLAIN(reader, &material->measured_by, material,
                 "measured_by: what discs read is known of bonds that break at once; with a fracture_energy give the "
                 "strength in tension");
    if (scatter->kind != BRC_SCATTER_TABLE) return;
    for (int q = 0; q < scatter->n_quantiles; ++q) {
        const brc_quantile *now = &scatter->quantiles[q], *before = q ? now - 1 : NULL;
        const bool last = q == scatter->n_quantiles - 1;
        if ((q == 0 && now->below != 0) || (last && now->below != 1) || (before && now->below < before->below))
            COMPLAIN(reader, &now->below, now,
                     "below: expected shares that grow from 0 at the first factor to 1 at the last");
        if (before && now->factor < before->factor)
            COMPLAIN(reader, &now->factor, now, "factor: is smaller than the one before; expected factors that grow");
    }
    if (scatter->n_quantiles == 1)
        COMPLAIN(reader, &scatter->quantiles->below, scatter->quantiles, "table: has one entry; expected two or more");
}

/* Strengths by discs are a law of beams: cells bear what a solid bears. */
static void check_measured_by(brc_reader *reader, int b)
{
    const brc_scene *scene = reader->scene;
    const brc_body *body = &scene->bodies[b];
    if (brc_model_traits_of(brc_body_model(scene, b)->kind)->spheres) return;
    for (int m = 0; m < scene->n_materials; ++m) {
        const brc_material *material = &scene->materials[m];
        if (brc_body_uses(body, m) && material->measured_by != BRC_STRENGTH_BY_TENSION)
            COMPLAIN(reader, &material->measured_by, material,
                     "measured_by: what discs read is a law of beams (model cbm), and body '%s' is made of cells, "
                     "which break at the strength in "
                     "tension; give that",
                     body->name);
    }
}

/* What only scenes with fracture know, and strengths that do not fit together. */
static void check_needs_fracture(brc_reader *reader)
{
    const brc_scene *scene = reader->scene;
    const bool known = scene->has_fracture || brc_reader_is_broken(reader, "fracture");
    static const char *const CURE = "needs `fracture: {}` at the top of the scene";
    for (int m = 0; m < scene->n_materials; ++m)
        check_material(reader, &scene->materials[m]);
    for (int b = 0; b < scene->n_bodies; ++b)
        check_measured_by(reader, b);
    for (int m = 0; m < scene->n_materials; ++m)
        for (int k = 0; k < scene->n_interfaces && scene->materials[m].measured_by != BRC_STRENGTH_BY_TENSION; ++k)
            if (scene->interfaces[k].fracture_energy > 0)
                COMPLAIN(
                    reader, &scene->materials[m].measured_by, &scene->materials[m],
                    "measured_by: what discs read is known of bonds that break at once, and interface number %d has a "
                    "fracture_energy; with one give the strength in tension",
                    k + 1);
    for (int k = 0; k < scene->n_stages && !known; ++k) {
        const brc_stage *stage = &scene->stages[k];
        if (stage->to_failure > 0) COMPLAIN(reader, &stage->to_failure, stage, "to_failure: %s", CURE);
        if (stage->most_events > 0) COMPLAIN(reader, &stage->most_events, stage, "events: %s", CURE);
        if (stage->stop_broken > 0) COMPLAIN(reader, &stage->stop_broken, stage, "stop_when_broken: %s", CURE);
    }
    for (int k = 0; k < scene->n_stages; ++k) {
        const brc_stage *stage = &scene->stages[k];
        if (stage->most_events > 0 && (stage->increments > 1 || stage->to_failure > 0))
            COMPLAIN(reader, &stage->most_events, stage,
                     "events: they find the load themselves; leave out increments and to_failure");
    }
    for (int i = 0; i < scene->n_sensors && !known; ++i) {
        const brc_sensor *sensor = &scene->sensors[i];
        if (sensor->kind == BRC_SENSOR_FRACTURE)
            COMPLAIN(reader, sensor->term, sensor, "fracture: this sensor %s", CURE);
        if (sensor->kind == BRC_SENSOR_CRACK_TIP) COMPLAIN(reader, NULL, sensor, "crack_tip: this sensor %s", CURE);
    }
    for (int i = 0; i < scene->n_measures && !known; ++i)
        if (scene->measures[i].kind == BRC_MEASURE_AT_FIRST_BREAK)
            COMPLAIN(reader, NULL, &scene->measures[i], "at_first_break: this measure %s", CURE);
}

/* Models that their bodies are not made for. What is in a domain file is not known here. */
static void check_models(brc_reader *reader)
{
    const brc_scene *scene = reader->scene;
    for (int b = 0; b < scene->n_bodies; ++b) {
        const brc_body *body = &scene->bodies[b];
        const brc_model *model = brc_body_model(scene, b);
        const bool spheres = brc_model_traits_of(model->kind)->spheres;
        if (body->domain_file[0]) continue;
        if (spheres && !(body->beams > 0))
            COMPLAIN(reader, &model->kind, body,
                     "model cbm needs spheres joined by beams, and body '%s' is made of cells; add `beams: 8` and a "
                     "fill with radii to it, or use model: dlsm",
                     body->name);
        if (!spheres && body->beams > 0)
            COMPLAIN(reader, &body->beams, body,
                     "beams: model %s needs cells, and body '%s' is made of spheres joined by beams; remove `beams`, "
                     "or use model: cbm",
                     brc_model_name(model->kind), body->name);
    }
    for (int k = 0; k < scene->n_stages; ++k) {
        const brc_stage *stage = &scene->stages[k];
        for (int b = 0; b < scene->n_bodies && stage->noise_damping > 0; ++b) {
            if (brc_model_traits_of(brc_body_model(scene, b)->kind)->deforms) continue;
            COMPLAIN(reader, &stage->noise_damping, stage,
                     "noise_damping: it is made of the bonds of model dlsm, and body '%s' is of model %s; use model "
                     "dlsm, mass_damping or integrator tchamwa-wielgosz",
                     scene->bodies[b].name, brc_model_name(brc_body_model(scene, b)->kind));
            break;
        }
    }
}

/* What a criterion or a model of a body cannot have in a scene that breaks. */
static void check_criterion(brc_reader *reader)
{
    const brc_scene *scene = reader->scene;
    static const char *const CURE =
        "bonds soften with model cbm, and with model dlsm by the criteria bond-normal and mohr-coulomb";
    for (int b = 0; b < scene->n_bodies; ++b) {
        const brc_body *body = &scene->bodies[b];
        const brc_model *model = brc_body_model(scene, b);
        const bool by_bond = brc_scene_breaks_by_bond(scene, model->kind);
        const brc_model_traits *traits = brc_model_traits_of(model->kind);
        const bool softens = traits->spheres || (traits->cohesion && by_bond);
        if (traits->spheres && by_bond)
            COMPLAIN(reader, &scene->fracture.kind, scene,
                     "criterion: bond-normal is for cells, and body '%s' is of model cbm; use virial-principal, or "
                     "leave the criterion out",
                     body->name);
        if (!traits->spheres && model->small_rotations)
            COMPLAIN(reader, &model->small_rotations, model,
                     "small_rotations: a linearised law does not break; leave out small_rotations or fracture");
        for (int m = 0; m < scene->n_materials && !softens; ++m)
            if (scene->materials[m].fracture_energy > 0 && brc_body_uses(body, m))
                COMPLAIN(
                    reader, &scene->materials[m].fracture_energy, &scene->materials[m],
                    "fracture_energy: the bonds of body '%s' (model %s%s) break at once; %s: use those, or remove it",
                    body->name, brc_model_name(model->kind), by_bond ? "" : ", a criterion of elements", CURE);
        for (int k = 0; k < scene->n_interfaces && !softens; ++k) {
            const brc_interface *at = &scene->interfaces[k];
            const bool inside = at->kind == BRC_INTERFACE_GRAINS
                                    ? (body->grains.n > 0 || body->grains.size > 0)
                                    : brc_body_uses(body, at->material[0]) && brc_body_uses(body, at->material[1]);
            if (at->fracture_energy > 0 && inside)
                COMPLAIN(
                    reader, &at->fracture_energy, at,
                    "fracture_energy: the bonds of body '%s' (model %s%s) break at once; %s: use those, or remove it",
                    body->name, brc_model_name(model->kind), by_bond ? "" : ", a criterion of elements", CURE);
        }
    }
}

/* Criteria of elements know limits of elements alone: an interface's own tension counts as a share of the weaker
 * side's. */
static void check_interfaces(brc_reader *reader)
{
    const brc_scene *scene = reader->scene;
    for (int k = 0; k < scene->n_interfaces; ++k) {
        const brc_interface *at = &scene->interfaces[k];
        if (at->kind != BRC_INTERFACE_MATERIALS || !(at->tension > 0)) continue;
        const brc_material *first = &scene->materials[at->material[0]], *second = &scene->materials[at->material[1]];
        for (int b = 0; b < scene->n_bodies && !(first->tension > 0) && !(second->tension > 0); ++b) {
            if (brc_scene_breaks_by_bond(scene, brc_body_model(scene, b)->kind)) continue;
            if (!brc_body_uses(&scene->bodies[b], at->material[0]) ||
                !brc_body_uses(&scene->bodies[b], at->material[1]))
                continue;
            COMPLAIN(reader, &at->tension, at,
                     "tension: is compared with that of its materials where elements fail, and neither '%s' nor '%s' "
                     "has one; give one of them `strength: {tension: ...}`",
                     first->name, second->name);
            break;
        }
    }
}

/* Sides of broken faces rub by the law of contact where there is one. */
static void check_sides(brc_reader *reader)
{
    const brc_scene *scene = reader->scene;
    const brc_fracture *fracture = &scene->fracture;
    if (fracture->side_friction < 0) return;
    if (scene->has_contact)
        COMPLAIN(reader, &fracture->side_friction, fracture,
                 "friction: surfaces of this scene rub by `interactions: {contact: {friction: ...}}`, sides of broken "
                 "faces too; give it there and remove it here");
    else if (!fracture->closure)
        COMPLAIN(reader, &fracture->side_friction, fracture,
                 "friction: with `closure: false` the sides of broken faces do not touch; remove friction, or closure");
}

/* Limits that nothing looks at: of compression where bonds break by tension alone or slide, of shear where none
 * slides. */
static void check_limits_of(brc_reader *reader, const brc_body *body, const brc_model *model,
                            const brc_material *material)
{
    const brc_scene *scene = reader->scene;
    const brc_fracture *fracture = &scene->fracture;
    const bool slides = brc_scene_slides(scene, model->kind);
    if (material->shear_fracture_energy > 0 && material->fracture_energy > 0 && !slides)
        COMPLAIN(reader, &material->shear_fracture_energy, material,
                 "shear_fracture_energy: is of cells of model dlsm that fail by mohr-coulomb, and body '%s' (model %s) "
                 "would not look at it; %s",
                 body->name, brc_model_name(model->kind),
                 brc_model_traits_of(model->kind)->cohesion
                     ? "add `fracture: {criterion: {mohr-coulomb: {cohesion: ..., friction: ...}}}`, or remove it"
                     : "beams and others take their fracture_energy whatever the mode: remove it, or use model dlsm");
    if (material->compression > 0 && slides)
        COMPLAIN(reader, &material->compression, material,
                 "compression: cells of body '%s' that soften fail in compression by sliding; this cohesion bears "
                 "2 c cos(phi) / (1 - sin(phi)) = %.4g MPa in uniaxial compression: remove compression and give "
                 "the cohesion that bears yours",
                 body->name, 2e-6 * fracture->cohesion * cos(fracture->friction) / (1 - sin(fracture->friction)));
    else if (material->compression > 0 && brc_scene_breaks_by_bond(scene, model->kind))
        WARN(reader, &material->compression, material,
             "compression: bonds of cells break by tension alone (criterion bond-normal), and body '%s' bears any "
             "compression; use `fracture: {criterion: %s}`, or remove it",
             body->name,
             brc_scene_softens(scene) ? "{mohr-coulomb: {cohesion: ..., friction: ...}}" : "virial-principal");
}

static void check_limits(brc_reader *reader)
{
    const brc_scene *scene = reader->scene;
    const brc_fracture *fracture = &scene->fracture;
    bool slides = false;
    for (int b = 0; b < scene->n_bodies; ++b) {
        const brc_model *model = brc_body_model(scene, b);
        slides = slides || brc_scene_slides(scene, model->kind);
        for (int m = 0; m < scene->n_materials; ++m)
            if (brc_body_uses(&scene->bodies[b], m))
                check_limits_of(reader, &scene->bodies[b], model, &scene->materials[m]);
    }
    if (!slides) return;
    const double rubs = scene->has_contact ? scene->contact.law.friction : brc_scene_side_friction(scene);
    if (rubs > tan(fracture->friction))
        WARN(reader, &fracture->friction, scene,
             "friction: sides that have slid rub by %g, more than the solid's tan(%.3g deg) = %.3g, so that under "
             "pressure a crack holds more than what it broke; give a friction of the sides below that",
             rubs, fracture->friction * 180 / M_PI, tan(fracture->friction));
    for (int i = 0; i < scene->n_sensors; ++i)
        if (scene->sensors[i].kind == BRC_SENSOR_FRACTURE && strcmp(scene->sensors[i].term, "failure_ratio") == 0)
            COMPLAIN(reader, scene->sensors[i].term, &scene->sensors[i],
                     "failure_ratio: is not known of cells that slide by mohr-coulomb with a fracture energy; remove "
                     "the sensor, or the fracture energies");
}

/* Faces and beams that soften open in dynamic stages without noise damping only. */
static void check_softening(brc_reader *reader)
{
    const brc_scene *scene = reader->scene;
    const brc_stage *moving = NULL;
    for (int k = 0; k < scene->n_stages; ++k) {
        const brc_stage *stage = &scene->stages[k];
        if (stage->noise_damping > 0)
            COMPLAIN(reader, &stage->noise_damping, stage,
                     "noise_damping: it would drag on faces that open against cohesion; leave out noise_damping or "
                     "fracture_energy, or use mass_damping");
        if (stage->most_events > 0)
            COMPLAIN(reader, &stage->most_events, stage,
                     "events: they break bonds at once, and those of this scene soften; remove `fracture_energy`, or "
                     "load slowly in a dynamic stage with "
                     "mass_damping");
        else if (stage->solver != BRC_SOLVER_DYNAMIC && moving)
            WARN(reader, &stage->solver, stage,
                 "solver: this stage is refused if a bond has opened against its cohesion in stage '%s' or later, as "
                 "openings follow in dynamic stages only; use a "
                 "dynamic stage with mass_damping",
                 moving->name);
        if (stage->solver == BRC_SOLVER_DYNAMIC) moving = moving ? moving : stage;
    }
}

/* Is there anything that a bond could break by? */
static bool has_strength(const brc_scene *scene)
{
    for (int b = 0; b < scene->n_bodies; ++b)
        for (int m = 0; m < scene->n_materials; ++m)
            if (brc_body_uses(&scene->bodies[b], m) &&
                brc_material_breaks(scene, brc_body_model(scene, b)->kind, &scene->materials[m]))
                return true;
    for (int k = 0; k < scene->n_interfaces; ++k)
        if (scene->interfaces[k].tension > 0) return true;
    return false;
}

static bool any_compression(const brc_scene *scene)
{
    for (int m = 0; m < scene->n_materials; ++m)
        if (scene->materials[m].compression > 0) return true;
    return false;
}

/* Does a stage break bonds, or is a limit looked at without breaking them? */
static bool looks_at_limits(const brc_scene *scene)
{
    for (int k = 0; k < scene->n_stages; ++k)
        if (scene->stages[k].solver == BRC_SOLVER_DYNAMIC || scene->stages[k].most_events > 0 ||
            scene->stages[k].to_failure > 0)
            return true;
    for (int i = 0; i < scene->n_sensors; ++i)
        if (scene->sensors[i].kind == BRC_SENSOR_FRACTURE && strcmp(scene->sensors[i].term, "failure_ratio") == 0)
            return true;
    return false;
}

void brc_reader_check_fracture(brc_reader *reader)
{
    const brc_scene *scene = reader->scene;
    const bool whole = !brc_reader_is_broken(reader, "bodies") && !brc_reader_is_broken(reader, "model") &&
                       !brc_reader_is_broken(reader, "stages");
    check_needs_fracture(reader);
    if (!whole) return;
    check_models(reader);
    if (!scene->has_fracture || brc_reader_is_broken(reader, "fracture") || brc_reader_is_broken(reader, "materials") ||
        brc_reader_is_broken(reader, "interactions"))
        return;
    check_criterion(reader);
    check_interfaces(reader);
    check_sides(reader);
    check_limits(reader);
    if (brc_scene_softens(scene)) check_softening(reader);
    if (!has_strength(scene))
        COMPLAIN(reader, &scene->has_fracture, scene,
                 "fracture: nothing can break: no material of a body has a strength%s; give one `strength: {tension: "
                 "50 MPa}`, or leave fracture out",
                 any_compression(scene) ? " in tension, which bonds of cells break by" : "");
    else if (!looks_at_limits(scene))
        WARN(reader, &scene->has_fracture, scene,
             "fracture: no stage breaks a bond: they are static without `events`, or modes, so the solid stays elastic "
             "whatever its load; %s",
             brc_scene_softens(scene) ? "use a dynamic stage with mass_damping"
                                      : "use a dynamic stage, or `solver: {static: {events: 100}}`");
}
