/* What a scene and its domain want of a device. */
#include "../core/fields.h"
#include "../effects/fracture/strengths.h"

static void ask_stages(const brc_scene *scene, brc_wants *out)
{
    for (int32_t i = 0; i < scene->n_stages; ++i) {
        const brc_stage *stage = &scene->stages[i];
        const bool dynamic = stage->solver == BRC_SOLVER_DYNAMIC;
        out->tchamwa |= dynamic && stage->integrator == BRC_TCHAMWA_WIELGOSZ;
        out->noise |= dynamic && stage->noise_damping > 0;
        out->damping |= dynamic && (stage->mass_damping > 0 || stage->noise_damping > 0);
        for (int32_t l = 0; l < stage->n_loads; ++l) {
            const brc_load_kind kind = stage->loads[l].kind;
            out->face_loads |= kind == BRC_LOAD_FACE_DISPLACEMENT || kind == BRC_LOAD_FACE_VELOCITY ||
                               kind == BRC_LOAD_TRACTION || kind == BRC_LOAD_PRESSURE;
        }
    }
}

void brc_wants_make(const brc_scene *scene, const brc_domain *domain, const brc_layout *layout,
                    const brc_device *device, const int32_t *material, brc_wants *out)
{
    const brc_precision precision = brc_device_get_precision(device);
    *out = (brc_wants){.scene = scene,
                       .model = brc_bond_model_of(scene->model.kind),
                       .domain = domain,
                       .layout = layout,
                       .n_groups = layout->n_slices * (brc_device_slice(device) / brc_device_lanes(device)),
                       .state_bytes = brc_precision_state_bytes(precision),
                       .coeff_bytes = brc_precision_coeff_bytes(precision),
                       .many_materials = brc_device_has_many_materials(device),
                       .by_element = !brc_scene_breaks_by_bond(scene, scene->model.kind),
                       .loose = scene->has_fracture};
    ask_stages(scene, out);
    if (scene->has_fracture) brc_strengths_ask(scene, domain, material, &out->weighted, &out->softens);
    for (int64_t e = 0; e < domain->n_elements && !out->loose; ++e)
        out->loose = domain->row_start[e + 1] == domain->row_start[e];
}

brc_wants brc_wants_listed(const brc_wants *wants, int64_t n)
{
    brc_wants listed = *wants;
    listed.n_listed = n;
    return listed;
}
