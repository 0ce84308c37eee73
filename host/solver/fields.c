/* Counts, and what is done with a table of fields. */
#include "fields.h"
#include "strengths.h"

/* Room for LANE_SPARE numbers of kernels/portable.h: gathers read whole vectors. */
enum { SPARE = 8 };

int64_t brc_each_row(const brc_wants *w)
{
    return w->layout->n_rows;
}
int64_t brc_each_block(const brc_wants *w)
{
    return w->layout->n_rows;
}
int64_t brc_each_row_end(const brc_wants *w)
{
    return (int64_t)w->layout->n_rows + 1;
}
int64_t brc_each_entry(const brc_wants *w)
{
    return w->layout->n_slots * w->layout->slice;
}
int64_t brc_each_slice(const brc_wants *w)
{
    return w->layout->n_slices;
}
int64_t brc_each_slice_end(const brc_wants *w)
{
    return (int64_t)w->layout->n_slices + 1;
}
int64_t brc_each_boundary(const brc_wants *w)
{
    return (int64_t)w->layout->n_boundary * w->layout->slice;
}
int64_t brc_each_group(const brc_wants *w)
{
    return w->n_groups;
}
int64_t brc_each_striker(const brc_wants *w)
{
    return w->scene->n_strikers;
}
int64_t brc_each_listed(const brc_wants *w)
{
    return w->n_listed;
}
int64_t brc_each_listed_end(const brc_wants *w)
{
    return w->n_listed + 1;
}
int64_t brc_each_once(const brc_wants *w)
{
    return (void)w, 1;
}

bool brc_wants_cells(const brc_wants *w)
{
    return w->model->element == BRC_ELEMENT_CELL;
}
bool brc_wants_spheres(const brc_wants *w)
{
    return w->model->element == BRC_ELEMENT_SPHERE;
}
bool brc_wants_turning(const brc_wants *w)
{
    return w->model->turns;
}
bool brc_wants_deforming(const brc_wants *w)
{
    return w->model->deforms;
}
bool brc_wants_rigid_cells(const brc_wants *w)
{
    return brc_wants_cells(w) && !w->model->deforms;
}
bool brc_wants_many(const brc_wants *w)
{
    return w->many_materials;
}

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

int64_t brc_field_bytes(const brc_field_row *field, const brc_wants *wants)
{
    if (field->wanted && !field->wanted(wants)) return 0;
    const int64_t n = field->count(wants) * field->width;
    if (field->number == BRC_FIELD_INT) return n * (int64_t)sizeof(int32_t);
    return (n + SPARE) * (field->number == BRC_FIELD_STATE ? wants->state_bytes : wants->coeff_bytes);
}

int64_t brc_fields_bytes(const brc_field_table *table, const brc_wants *wants)
{
    int64_t bytes = 0;
    for (int k = 0; k < table->n && (!table->wanted || table->wanted(wants)); ++k)
        bytes += brc_field_bytes(&table->fields[k], wants);
    return bytes;
}

static brc_buffer **buffer_of(const brc_field_row *field, void *owner)
{
    return (brc_buffer **)(void *)((char *)owner + field->at);
}

brc_buffer *brc_field_buffer(const brc_field_row *field, const void *owner)
{
    return *(brc_buffer *const *)(const void *)((const char *)owner + field->at);
}

brc_status brc_fields_create(brc_device *device, const brc_field_table *table, const brc_wants *wants, void *owner)
{
    brc_fields_free(table, owner);
    for (int k = 0; k < table->n; ++k) {
        const brc_field_row *field = &table->fields[k];
        if (field->wanted && !field->wanted(wants)) continue;
        BRC_TRY(brc_buffer_create(device, buffer_of(field, owner), brc_field_bytes(field, wants), field->what));
    }
    return BRC_OK;
}

void brc_fields_free(const brc_field_table *table, void *owner)
{
    for (int k = 0; k < table->n; ++k)
        brc_buffer_free(buffer_of(&table->fields[k], owner));
}
