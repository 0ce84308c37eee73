/* What a scene and its domain want of a device. */
#include "fields.h"
#include "../effects/effect.h"

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
    int n;
    const brc_effect *const *effects = brc_effects(&n);
    for (int k = 0; k < n; ++k)
        if (effects[k]->ask) effects[k]->ask(out, material);
    for (int64_t e = 0; e < domain->n_elements && !out->loose; ++e)
        out->loose = domain->row_start[e + 1] == domain->row_start[e];
}

brc_wants brc_wants_listed(const brc_wants *wants, int64_t n)
{
    brc_wants listed = *wants;
    listed.n_listed = n;
    return listed;
}
