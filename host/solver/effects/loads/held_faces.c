/* Faces whose motion a stage prescribes, grouped by element, and the loads that do. */
#include "loads_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Host arrays that are uploaded: of faces [n_faces], of elements [n_elements]. */
typedef struct held_arrays {
    brc_load_member *items; /* faces by row of their element */
    int32_t *bits;          /* [n_free_faces] components */
    int32_t *element, *place, *face_start;
    int32_t *held_of; /* [n_boundary][slice] */
    double *area, *arm, *spring, *value;
} held_arrays;

/* Which components of which free faces are held; refuses overlaps. bits: [n_free_faces], zeroed. */
static brc_status collect_held(brc_simulation *s, const brc_stage *stage, int32_t *bits)
{
    brc_status status = BRC_OK;
    for (int32_t l = 0; l < stage->n_loads; ++l) {
        const brc_load *load = stage->loads + l;
        if (!brc_load_holds_faces(load)) continue;
        const brc_set *set = brc_load_find_set(s, stage, load, BRC_SET_FACES, &status);
        if (!set) continue;
        int64_t twice = 0;
        for (int64_t m = 0; m < set->n_members; ++m) {
            if (bits[set->members[m]] & brc_load_components(load)) ++twice;
            bits[set->members[m]] |= brc_load_components(load);
        }
        if (twice)
            status = BRC_FAIL(
                s->context, BRC_BAD_INPUT,
                "stage '%s': the load on '%s' prescribes components of %lld faces that another load of the stage "
                "prescribes too; give each component of a face to one load",
                stage->name, load->set, (long long)twice);
    }
    return status;
}

static brc_status allocate(brc_simulation *s, int32_t n, held_arrays *a)
{
    const int64_t n_places = (int64_t)s->layout->n_boundary * s->layout->slice;
    BRC_TRY(BRC_ALLOCATE(s->context, &a->held_of, n_places, "held elements"));
    memset(a->held_of, -1, (size_t)n_places * sizeof *a->held_of);
    BRC_TRY(BRC_ALLOCATE(s->context, &a->items, n, "held faces"));
    BRC_TRY(BRC_ALLOCATE(s->context, &a->element, n, "held elements"));
    BRC_TRY(BRC_ALLOCATE(s->context, &a->place, 2 * (int64_t)n, "held elements"));
    BRC_TRY(BRC_ALLOCATE(s->context, &a->face_start, n + 1, "held elements"));
    BRC_TRY(BRC_ALLOCATE(s->context, &a->area, 3 * (int64_t)n, "held faces"));
    BRC_TRY(BRC_ALLOCATE(s->context, &a->arm, 3 * (int64_t)n, "held faces"));
    BRC_TRY(BRC_ALLOCATE(s->context, &a->value, 3 * (int64_t)n, "held faces"));
    return BRC_ALLOCATE(s->context, &a->spring, n, "held faces");
}

/* Face f of element e at place i of the list. */
static void put_face(const brc_simulation *s, int32_t f, int32_t i, held_arrays *a)
{
    const brc_domain *d = s->domain;
    const int32_t e = d->free_element[f];
    double reach = 0, surface = 0;
    for (int c = 0; c < 3; ++c) {
        a->area[3 * i + c] = d->free_area_vector[3 * (int64_t)f + c];
        a->arm[3 * i + c] = d->free_centroid[3 * (int64_t)f + c] - d->position[3 * (int64_t)e + c];
        reach += a->arm[3 * i + c] * a->arm[3 * i + c];
        surface += a->area[3 * i + c] * a->area[3 * i + c];
    }
    a->spring[i] = s->elastic[s->material_of_element[e]].k * sqrt(surface / reach);
}

static void group(const brc_simulation *s, brc_held_faces *held, held_arrays *a)
{
    const brc_domain *d = s->domain;
    int32_t n = 0;
    for (int64_t f = 0; f < d->n_free_faces; ++f)
        if (a->bits[f]) a->items[n++] = (brc_load_member){s->layout->row_of_element[d->free_element[f]], (int32_t)f};
    qsort(a->items, (size_t)n, sizeof *a->items, brc_load_compare_members);
    for (int32_t i = 0; i < n; ++i) {
        const int32_t f = a->items[i].id, row = a->items[i].row;
        if (i == 0 || a->items[i - 1].row != row) {
            a->element[held->n_elements] = row;
            a->place[2 * held->n_elements] = s->layout->boundary[row / s->layout->slice];
            a->place[2 * held->n_elements + 1] = row % s->layout->slice;
            a->held_of[a->place[2 * held->n_elements] * s->layout->slice + row % s->layout->slice] = held->n_elements;
            a->face_start[held->n_elements++] = i;
        }
        held->index_of_free_face[f] = i;
        held->component_of_face[i] = a->bits[f];
        put_face(s, f, i, a);
    }
    a->face_start[held->n_elements] = n;
}

brc_status brc_held_faces_places(brc_simulation *s, double **out)
{
    const brc_held_faces *h = &s->loads->held;
    const int64_t n = s->domain->n_free_faces;
    BRC_FREED double *value = NULL;
    *out = NULL;
    if (h->n_faces == 0 || !h->value) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &value, 3 * (int64_t)h->n_faces, "held faces"));
    BRC_LOCAL(s->context, 3 * n, double, place, "held faces");
    BRC_TRY(brc_download(s, h->value, brc_state_bytes(s), value, 3 * (int64_t)h->n_faces));
    for (int64_t f = 0; f < n; ++f) {
        const int32_t at = h->index_of_free_face[f];
        for (int c = 0; c < 3; ++c)
            place[3 * f + c] = at >= 0 && h->component_of_face[at] >> c & 1 ? value[3 * (int64_t)at + c] : NAN;
    }
    *out = place;
    place = NULL;
    return BRC_OK;
}

/* Where the faces of a load are as its stage begins: where they were held, else where their cells put them, which holds
 * only while this stage has no values yet. */
static brc_status find_places(brc_simulation *s, const brc_set *set, const brc_held_faces *held, double *out)
{
    BRC_TRY(brc_simulation_face_displacement(s, set->n_members, set->members, out));
    for (int64_t m = 0; held->left && m < set->n_members; ++m)
        for (int c = 0; c < 3; ++c) {
            const double left = held->left[3 * (int64_t)set->members[m] + c];
            if (!isnan(left)) out[3 * m + c] = left;
        }
    return BRC_OK;
}

/* Entries of one load, whose faces begin where they stand; velocity loads start from there. value: [n_faces][3] */
static brc_status create_load(brc_simulation *s, const brc_load *load, const brc_set *set, const brc_held_faces *held,
                              double *value, brc_held_load *entry)
{
    const bool moves = load->kind == BRC_LOAD_FACE_VELOCITY;
    const int64_t count = set->n_members;
    BRC_FREED int32_t *face = NULL;
    entry->n = (int32_t)count;
    entry->factor = NAN;
    BRC_LOCAL(s->context, 3 * count, double, now, "face positions");
    BRC_TRY(BRC_ALLOCATE(s->context, &face, count, "held load"));
    BRC_LOCAL(s->context, count, int32_t, flag, "held load");
    BRC_LOCAL(s->context, 3 * count, double, direction, "held load");
    BRC_TRY(find_places(s, set, held, now));
    for (int64_t m = 0; m < count; ++m) {
        face[m] = held->index_of_free_face[set->members[m]];
        flag[m] = brc_load_components(load);
        brc_load_direction(load, s->domain->free_centroid + 3 * (int64_t)set->members[m], direction + 3 * m);
        if (!moves) entry->jump = fmax(entry->jump, brc_load_jump(load, direction + 3 * m, now + 3 * m));
        for (int c = 0; c < 3; ++c) {
            if (load->component[c]) value[3 * (int64_t)face[m] + c] = now[3 * m + c];
            if (!moves) now[3 * m + c] = 0;
        }
    }
    BRC_TRY(brc_load_fields_create(s, &brc_held_load_fields, count, entry));
    BRC_TRY(brc_upload_int(entry->face, face, count));
    BRC_TRY(brc_load_upload_components(s, entry->component, flag, (int32_t)count));
    BRC_TRY(brc_upload_state(s, entry->base, now, 3 * count));
    return brc_upload_state(s, entry->direction, direction, 3 * count);
}

static brc_status create_loads(brc_simulation *s, const brc_stage *stage, brc_held_faces *held, double *value)
{
    brc_status status = BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &held->loads, stage->n_loads, "held loads"));
    for (int32_t l = 0; l < stage->n_loads; ++l) {
        if (!brc_load_holds_faces(stage->loads + l)) continue;
        const brc_set *set = brc_load_find_set(s, stage, stage->loads + l, BRC_SET_FACES, &status);
        if (!set) return status;
        brc_held_load *entry = held->loads + held->n_loads++;
        entry->load = l;
        BRC_TRY(create_load(s, stage->loads + l, set, held, value, entry));
    }
    return BRC_OK;
}

static brc_status upload(brc_simulation *s, const held_arrays *a, brc_held_faces *held)
{
    const int64_t n = held->n_faces, n_elements = held->n_elements;
    BRC_TRY(brc_load_fields_create(s, &brc_held_element_fields, n_elements, held));
    BRC_TRY(brc_upload_int(held->element, a->element, n_elements));
    BRC_TRY(brc_upload_int(held->place, a->place, 2 * n_elements));
    BRC_TRY(brc_upload_int(held->face_start, a->face_start, n_elements + 1));
    BRC_TRY(brc_upload_int(held->held_of, a->held_of, (int64_t)s->layout->n_boundary * s->layout->slice));
    BRC_TRY(brc_load_fields_create(s, &brc_held_face_fields, n, held));
    BRC_TRY(brc_upload_coeff(s, held->face_area, a->area, 3 * n));
    BRC_TRY(brc_upload_coeff(s, held->arm, a->arm, 3 * n));
    BRC_TRY(brc_upload_coeff(s, held->spring, a->spring, n));
    BRC_TRY(brc_upload_state(s, held->value, a->value, 3 * n));
    return brc_load_upload_components(s, held->held, held->component_of_face, (int32_t)n);
}

brc_status brc_held_faces_create(brc_simulation *s, const brc_stage *stage, brc_held_faces *held)
{
    const brc_domain *d = s->domain;
    held_arrays a = {0};
    brc_status status = BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &held->index_of_free_face, d->n_free_faces, "held faces"));
    memset(held->index_of_free_face, -1, (size_t)d->n_free_faces * sizeof *held->index_of_free_face);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &a.bits, d->n_free_faces, "held faces"));
    BRC_TRY_OR(cleanup, collect_held(s, stage, a.bits));
    for (int64_t f = 0; f < d->n_free_faces; ++f)
        held->n_faces += a.bits[f] != 0;
    if (held->n_faces == 0) goto cleanup;
    if (!s->model->deforms) {
        status =
            BRC_FAIL(s->context, BRC_BAD_INPUT,
                     "stage '%s': dlsm-published moves whole elements; use element_displacement or element_velocity",
                     stage->name);
        goto cleanup;
    }
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &held->component_of_face, held->n_faces, "held faces"));
    BRC_TRY_OR(cleanup, allocate(s, held->n_faces, &a));
    group(s, held, &a);
    BRC_TRY_OR(cleanup, create_loads(s, stage, held, a.value));
    BRC_TRY_OR(cleanup, upload(s, &a, held));
cleanup:
    brc_memory_free(a.items);
    brc_memory_free(a.bits);
    brc_memory_free(a.element);
    brc_memory_free(a.place);
    brc_memory_free(a.face_start);
    brc_memory_free(a.held_of);
    brc_memory_free(a.area);
    brc_memory_free(a.arm);
    brc_memory_free(a.spring);
    brc_memory_free(a.value);
    return status;
}
