/* The loads of one stage: tractions, prescribed elements, and what the other files of this folder make. Lists are
 * sorted by storage row, then by id. */
#include "loads_internal.h"
#include "../../core/loaded_faces.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_element_motion(const brc_load *load)
{
    return load->kind == BRC_LOAD_ELEMENT_DISPLACEMENT || load->kind == BRC_LOAD_ELEMENT_VELOCITY;
}

/* Tractions of one load, summed per element over the components that are not held. */
static brc_status create_traction(brc_simulation *s, const brc_stage *stage, int32_t l, const brc_held_faces *held,
                                  brc_traction_load *out)
{
    const brc_domain *d = s->domain;
    const brc_load *load = stage->loads + l;
    brc_status status = BRC_OK;
    const brc_set *set = brc_load_find_named(s, stage, load, BRC_SET_FACES, &status);
    if (!set) return status;
    int64_t count = 0;
    BRC_FREED brc_loaded_face *loaded = NULL;
    int32_t n = 0;
    BRC_TRY(brc_loaded_faces(s->context, s->scene, d, set, &loaded, &count));
    if (count == 0) /* of a part without whole faces of the set, those that its region cuts */
        return brc_load_refuse_empty(s, stage, load);
    BRC_LOCAL(s->context, count, brc_load_member, items, "traction");
    BRC_LOCAL(s->context, count, int32_t, element, "traction");
    BRC_LOCAL(s->context, 2 * count, int32_t, place, "traction");
    BRC_LOCAL(s->context, 3 * count, double, total, "traction");
    BRC_LOCAL(s->context, 9 * count, double, moment, "traction");
    for (int64_t m = 0; m < count; ++m)
        items[m] = (brc_load_member){s->layout->row_of_element[d->free_element[loaded[m].face]], (int32_t)m};
    qsort(items, (size_t)count, sizeof *items, brc_load_compare_members);
    for (int64_t m = 0; m < count; ++m) {
        const brc_loaded_face *face = &loaded[items[m].id];
        const int32_t f = face->face, row = items[m].row, e = d->free_element[f];
        if (m == 0 || items[m - 1].row != row) {
            element[n] = row;
            place[2 * n] = s->layout->boundary[row / s->layout->slice];
            place[2 * n + 1] = row % s->layout->slice;
            ++n;
        }
        const double *area = face->area;
        const double surface = sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
        const int32_t at = held->index_of_free_face[f];
        const int bits = at < 0 ? 0 : held->component_of_face[at];
        double push[3], varying[3];
        brc_load_direction(load, face->centroid, varying);
        for (int c = 0; c < 3; ++c) {
            push[c] = load->kind == BRC_LOAD_PRESSURE ? -varying[0] * area[c] : varying[c] * surface;
            if (bits >> c & 1) push[c] = 0;
            total[3 * (n - 1) + c] += push[c];
        }
        for (int c = 0; c < 3; ++c)
            for (int k = 0; k < 3; ++k)
                moment[9 * (n - 1) + 3 * c + k] += push[c] * (face->centroid[k] - d->position[3 * (int64_t)e + k]);
    }
    *out = (brc_traction_load){.load = l, .n = n};
    BRC_TRY(brc_load_fields_create(s, &brc_traction_fields, n, out));
    BRC_TRY(brc_upload_int(out->element, element, n));
    BRC_TRY(brc_upload_int(out->place, place, 2 * (int64_t)n));
    BRC_TRY(brc_upload_coeff(s, out->total, total, 3 * (int64_t)n));
    return brc_upload_coeff(s, out->moment, moment, 9 * (int64_t)n);
}

static brc_status upload_prescribed(brc_simulation *s, brc_prescribed_load *out, const int32_t *row,
                                    const int32_t *bits, const double *base)
{
    BRC_TRY(brc_load_fields_create(s, &brc_prescribed_fields, out->n, out));
    BRC_TRY(brc_upload_int(out->element, row, out->n));
    BRC_TRY(brc_load_upload_components(s, out->component, bits, out->n));
    return brc_upload_state(s, out->base, base, 3 * (int64_t)out->n);
}

/* Imposed elements: the members of an element set, or the owners of a face set. taken: bits per element. */
static brc_status create_prescribed(brc_simulation *s, const brc_stage *stage, int32_t l, int32_t *taken,
                                    brc_prescribed_load *out)
{
    const brc_domain *d = s->domain;
    const brc_load *load = stage->loads + l;
    BRC_FREED brc_load_member *items = NULL;
    int32_t n = 0;
    int64_t twice = 0;
    BRC_TRY(brc_load_members(s, stage, load, &items, &n));
    BRC_TRY(BRC_ALLOCATE(s->context, &out->element_id, n, "imposed elements"));
    BRC_LOCAL(s->context, n, int32_t, element, "imposed elements");
    BRC_LOCAL(s->context, n, int32_t, flag, "imposed elements");
    BRC_LOCAL(s->context, 3 * (int64_t)n, double, base, "imposed elements");
    BRC_LOCAL(s->context, 3 * (int64_t)n, double, direction, "imposed elements");
    BRC_LOCAL(s->context, 3 * d->n_elements, double, now, "imposed elements");
    const bool moves = load->kind == BRC_LOAD_ELEMENT_VELOCITY;
    BRC_TRY(brc_simulation_displacement(s, now));
    out->load = l;
    out->n = n;
    out->component_bits = brc_load_components(load);
    for (int32_t i = 0; i < n; ++i) {
        const int64_t e = items[i].id;
        element[i] = items[i].row;
        out->element_id[i] = items[i].id;
        flag[i] = out->component_bits;
        if (taken[e] & flag[i]) ++twice;
        taken[e] |= flag[i];
        brc_load_direction(load, d->position + 3 * e, direction + 3 * (int64_t)i);
        if (!moves) out->jump = fmax(out->jump, brc_load_jump(load, direction + 3 * (int64_t)i, now + 3 * e));
        for (int c = 0; c < 3; ++c)
            base[3 * (int64_t)i + c] = moves ? now[3 * e + c] : 0;
    }
    if (twice) return brc_loads_refuse_twice(s, stage, load, twice);
    BRC_TRY(upload_prescribed(s, out, element, flag, base));
    return brc_upload_state(s, out->direction, direction, 3 * (int64_t)n);
}

const brc_load *brc_prescribed_of(const brc_stage *stage, const brc_prescribed_load *prescribed)
{
    static const brc_load still = {.kind = BRC_LOAD_ELEMENT_DISPLACEMENT};
    return prescribed->load < 0 ? &still : stage->loads + prescribed->load;
}

/* Elements that no beam holds stay where they are, in the components that no load of the stage prescribes. */
static brc_status create_still(brc_simulation *s, const brc_stage *stage, const int32_t *taken,
                               brc_prescribed_load *out, bool *any)
{
    const brc_domain *d = s->domain;
    int32_t n = 0;
    const bool meets = s->scene->has_contact && stage->solver == BRC_SOLVER_DYNAMIC;
    *any = false;
    if (!brc_has_spheres(s) || (meets && !s->scene->model.keep_isolated))
        return BRC_OK; /* loose ones are for contact */
    for (int64_t e = 0; e < d->n_elements; ++e)
        n += d->row_start[e + 1] == d->row_start[e];
    if (n == 0) return BRC_OK;
    *any = true;
    *out = (brc_prescribed_load){.load = -1, .n = n, .component_bits = 7};
    BRC_TRY(BRC_ALLOCATE(s->context, &out->element_id, n, "isolated elements"));
    BRC_LOCAL(s->context, n, int32_t, element, "isolated elements");
    BRC_LOCAL(s->context, n, int32_t, flag, "isolated elements");
    BRC_LOCAL(s->context, 3 * (int64_t)n, double, base, "isolated elements");
    BRC_LOCAL(s->context, 3 * d->n_elements, double, now, "isolated elements");
    BRC_TRY(brc_simulation_displacement(s, now));
    n = 0;
    for (int32_t r = 0; r < s->layout->n_rows; ++r) {
        const int32_t e = s->layout->element_of_row[r];
        if (e < 0 || d->row_start[e + 1] > d->row_start[e]) continue;
        element[n] = r;
        out->element_id[n] = e;
        flag[n] = 7 & ~taken[e];
        for (int c = 0; c < 3; ++c)
            base[3 * (int64_t)n + c] = now[3 * (int64_t)e + c];
        ++n;
    }
    return upload_prescribed(s, out, element, flag, base);
}

brc_status brc_loads_create(brc_simulation *s, const brc_stage *stage, brc_loads *out)
{
    int32_t *taken = NULL, *turned = NULL;
    brc_status status = brc_held_faces_create(s, stage, &out->held), first = status;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &taken, s->domain->n_elements, "imposed elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &turned, s->domain->n_elements, "turned elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &out->pushes, stage->n_loads, "forces on elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &out->turns, stage->n_loads, "turned elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &out->tractions, stage->n_loads, "tractions"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &out->prescribed, stage->n_loads + 1, "imposed elements"));
    for (int32_t l = 0; l < stage->n_loads; ++l) { /* go on after an error: all in one pass */
        const brc_load *load = stage->loads + l;
        status = BRC_OK;
        if (is_element_motion(load)) {
            status = create_prescribed(s, stage, l, taken, out->prescribed + out->n_prescribed++);
        } else if (load->kind == BRC_LOAD_ELEMENT_FORCE) {
            status = brc_push_create(s, stage, l, out->pushes + out->n_pushes++);
        } else if (load->kind == BRC_LOAD_ELEMENT_ROTATION) {
            status = brc_turn_create(s, stage, l, turned, out->turns + out->n_turns++);
        } else if (!brc_load_holds_faces(load)) {
            if (brc_has_spheres(s))
                status =
                    BRC_FAIL(s->context, BRC_BAD_INPUT,
                             "stage '%s': cbm takes no tractions; use model dlsm, element_force, or prescribe elements",
                             stage->name);
            else if (first == BRC_OK)
                status = create_traction(s, stage, l, &out->held, out->tractions + out->n_tractions++);
        }
        if (status != BRC_OK) first = status;
    }
    if (first == BRC_OK) {
        bool any;
        status = create_still(s, stage, taken, out->prescribed + out->n_prescribed, &any);
        out->n_prescribed += any;
    }
    out->on_faces = out->held.n_faces > 0 || out->n_tractions > 0;
    if (first == BRC_OK && status == BRC_OK) status = brc_set_face_loads(s, out->on_faces);
cleanup:
    brc_memory_free(taken);
    brc_memory_free(turned);
    return first != BRC_OK ? first : status;
}

void brc_loads_free(brc_loads *loads)
{
    brc_held_faces *h = &loads->held;
    brc_memory_free(h->index_of_free_face);
    brc_memory_free(h->component_of_face);
    brc_fields_free(&brc_held_element_fields, h);
    brc_fields_free(&brc_held_face_fields, h);
    for (int32_t i = 0; i < h->n_loads; ++i)
        brc_fields_free(&brc_held_load_fields, h->loads + i);
    brc_memory_free(h->loads);
    for (int32_t i = 0; i < loads->n_tractions; ++i)
        brc_fields_free(&brc_traction_fields, loads->tractions + i);
    for (int32_t i = 0; i < loads->n_prescribed; ++i) {
        brc_memory_free(loads->prescribed[i].element_id);
        brc_fields_free(&brc_prescribed_fields, loads->prescribed + i);
    }
    brc_memory_free(loads->tractions);
    brc_memory_free(loads->prescribed);
    brc_element_loads_free(loads);
    *loads = (brc_loads){.pass = loads->pass, .work_before = loads->work_before};
}
