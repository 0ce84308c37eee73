/* The loads of one stage: held faces, tractions, imposed elements. Lists are sorted by storage row, then by id. */
#include "element_loads.h"
#include "load_fields.h"
#include "loaded_faces.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

double brc_load_rate(const brc_load *load, double t)
{
    const brc_table *table = &load->table;
    if (load->kind == BRC_LOAD_FACE_VELOCITY || load->kind == BRC_LOAD_ELEMENT_VELOCITY)
        return brc_table_value(table, t);
    /* derivative of the piecewise linear table; the later piece at a corner */
    for (int32_t i = 0; i + 1 < table->n; ++i)
        if (t >= table->time[i] && t < table->time[i + 1])
            return (table->value[i + 1] - table->value[i]) / (table->time[i + 1] - table->time[i]);
    return 0;
}

double brc_table_integral(const brc_table *table, double t)
{
    if (table->n == 0) return t;
    /* exact by trapezoids between the table's own points */
    double sum = 0, from = 0, value = brc_table_value(table, 0);
    for (int32_t i = 0; i < table->n; ++i) {
        if (table->time[i] <= 0 || table->time[i] >= t) continue;
        sum += 0.5 * (value + table->value[i]) * (table->time[i] - from);
        from = table->time[i];
        value = table->value[i];
    }
    return sum + 0.5 * (value + brc_table_value(table, t)) * (t - from);
}

double brc_load_factor(const brc_load *load, double t, bool is_static)
{
    const brc_table *table = &load->table;
    const bool velocity = load->kind == BRC_LOAD_FACE_VELOCITY || load->kind == BRC_LOAD_ELEMENT_VELOCITY;
    if (!velocity && is_static && table->n > 0 && t > 1)
        return t * brc_table_value(table, 1); /* beyond the whole load: to_failure */
    if (!velocity) return is_static && table->n == 0 ? t : brc_table_value(table, t);
    return brc_table_integral(table, t);
}

/* value + gradient (x - origin) */
static void direction_at(const brc_load *load, const double *x, double out[3])
{
    for (int i = 0; i < 3; ++i) {
        out[i] = load->value[i];
        for (int j = 0; j < 3; ++j)
            out[i] += load->gradient[i][j] * (x[j] - load->origin[j]);
    }
}

/* The set a load names, with or without members. */
static const brc_set *find_named(brc_simulation *s, const brc_stage *stage, const brc_load *load, brc_set_kind kind,
                                 brc_status *status)
{
    const int32_t index = brc_domain_find_set(s->domain, load->set);
    if (index < 0) {
        *status =
            BRC_FAIL(s->context, BRC_BAD_INPUT, "stage '%s': a load names the set '%s', which the domain does not have",
                     stage->name, load->set);
        return NULL;
    }
    const brc_set *set = s->domain->sets + index;
    if (set->kind != kind && kind == BRC_SET_FACES) {
        *status = BRC_FAIL(s->context, BRC_BAD_INPUT,
                           "stage '%s': a face load names the set '%s', which is of elements; name a set of faces",
                           stage->name, load->set);
        return NULL;
    }
    return set;
}

static brc_status refuse_empty(brc_simulation *s, const brc_stage *stage, const brc_load *load)
{
    return BRC_FAIL(s->context, BRC_BAD_INPUT, "stage '%s': the set '%s' is empty; widen its predicate", stage->name,
                    load->set);
}

const brc_set *brc_load_find_set(brc_simulation *s, const brc_stage *stage, const brc_load *load, brc_set_kind kind,
                                 brc_status *status)
{
    const brc_set *set = find_named(s, stage, load, kind, status);
    if (!set || set->n_members > 0) return set;
    *status = refuse_empty(s, stage, load);
    return NULL;
}

bool brc_load_holds_faces(const brc_load *load)
{
    return load->kind == BRC_LOAD_FACE_DISPLACEMENT || load->kind == BRC_LOAD_FACE_VELOCITY;
}
bool brc_load_pulls_faces(const brc_load *load)
{
    return load->kind == BRC_LOAD_TRACTION || load->kind == BRC_LOAD_PRESSURE;
}
static bool is_element_motion(const brc_load *load)
{
    return load->kind == BRC_LOAD_ELEMENT_DISPLACEMENT || load->kind == BRC_LOAD_ELEMENT_VELOCITY;
}
static int component_bits(const brc_load *load)
{
    return (load->component[0] ? 1 : 0) | (load->component[1] ? 2 : 0) | (load->component[2] ? 4 : 0);
}

typedef struct row_item {
    int32_t row, id;
} row_item;
static int compare_rows(const void *left, const void *right)
{
    const row_item *a = left, *b = right;
    if (a->row != b->row) return a->row < b->row ? -1 : 1;
    return a->id < b->id ? -1 : a->id > b->id;
}

/* Temporary host arrays of a list of n entries, uploaded in one go. */
static brc_status upload_components(brc_simulation *s, brc_buffer *out, const int32_t *bits, int32_t n)
{
    double *flags = NULL;
    BRC_TRY(BRC_ALLOCATE(s->context, &flags, 3 * (int64_t)n, "component flags"));
    for (int32_t i = 0; i < n; ++i)
        for (int c = 0; c < 3; ++c)
            flags[3 * (int64_t)i + c] = bits[i] >> c & 1;
    const brc_status status = brc_upload_coeff(s, out, flags, 3 * (int64_t)n);
    brc_memory_free(flags);
    return status;
}

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
            if (bits[set->members[m]] & component_bits(load)) ++twice;
            bits[set->members[m]] |= component_bits(load);
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

static brc_status create_held(brc_simulation *s, const brc_stage *stage, brc_held_faces *held)
{
    const brc_domain *d = s->domain;
    int32_t *bits = NULL, *element = NULL, *place = NULL, *face_start = NULL, *face_of = NULL;
    double *area = NULL, *arm = NULL, *spring = NULL, *now = NULL;
    row_item *items = NULL;
    brc_status status = BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &held->index_of_free_face, d->n_free_faces, "held faces"));
    memset(held->index_of_free_face, -1, (size_t)d->n_free_faces * sizeof *held->index_of_free_face);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &bits, d->n_free_faces, "held faces"));
    BRC_TRY_OR(cleanup, collect_held(s, stage, bits));
    int32_t n = 0;
    for (int64_t f = 0; f < d->n_free_faces; ++f)
        n += bits[f] != 0;
    held->n_faces = n;
    if (n == 0) goto cleanup;
    if (!s->model->deforms) {
        status =
            BRC_FAIL(s->context, BRC_BAD_INPUT,
                     "stage '%s': dlsm-published moves whole elements; use element_displacement or element_velocity",
                     stage->name);
        goto cleanup;
    }
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &items, n, "held faces"));
    n = 0;
    for (int64_t f = 0; f < d->n_free_faces; ++f)
        if (bits[f]) items[n++] = (row_item){s->layout->row_of_element[d->free_element[f]], (int32_t)f};
    qsort(items, (size_t)n, sizeof *items, compare_rows);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &element, n, "held elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &place, 2 * (int64_t)n, "held elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &face_start, n + 1, "held elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &face_of, n, "held faces"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &held->component_of_face, n, "held faces"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &area, 3 * (int64_t)n, "held faces"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &arm, 3 * (int64_t)n, "held faces"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &spring, n, "held faces"));
    for (int32_t i = 0; i < n; ++i) {
        const int32_t f = items[i].id, row = items[i].row, e = d->free_element[f];
        if (i == 0 || items[i - 1].row != row) {
            element[held->n_elements] = row;
            place[2 * held->n_elements] = s->layout->boundary[row / s->layout->slice];
            place[2 * held->n_elements + 1] = row % s->layout->slice;
            face_start[held->n_elements++] = i;
        }
        held->index_of_free_face[f] = i;
        face_of[i] = f;
        held->component_of_face[i] = bits[f];
        double reach = 0, surface = 0;
        for (int c = 0; c < 3; ++c) {
            area[3 * i + c] = d->free_area_vector[3 * (int64_t)f + c];
            arm[3 * i + c] = d->free_centroid[3 * (int64_t)f + c] - d->position[3 * (int64_t)e + c];
            reach += arm[3 * i + c] * arm[3 * i + c];
            surface += area[3 * i + c] * area[3 * i + c];
        }
        spring[i] = s->elastic[s->material_of_element[e]].k * sqrt(surface / reach);
    }
    face_start[held->n_elements] = n;
    BRC_TRY_OR(cleanup, brc_load_fields_create(s, &brc_held_element_fields, held->n_elements, held));
    BRC_TRY_OR(cleanup, brc_upload_int(held->element, element, held->n_elements));
    BRC_TRY_OR(cleanup, brc_upload_int(held->place, place, 2 * (int64_t)held->n_elements));
    BRC_TRY_OR(cleanup, brc_upload_int(held->face_start, face_start, held->n_elements + 1));
    /* one entry list per load; velocity loads start from where the face is now, which holds only while this stage has
     * no values yet */
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &held->loads, stage->n_loads, "held loads"));
    for (int32_t l = 0; l < stage->n_loads; ++l) {
        const brc_load *load = stage->loads + l;
        if (!brc_load_holds_faces(load)) continue;
        const brc_set *set = brc_load_find_set(s, stage, load, BRC_SET_FACES, &status);
        if (!set) goto cleanup;
        brc_held_load *entry = held->loads + held->n_loads++;
        const int64_t count = set->n_members;
        entry->load = l;
        entry->n = (int32_t)count;
        int32_t *face = NULL, *flag = NULL;
        double *base = NULL, *direction = NULL;
        brc_memory_free(now);
        now = NULL;
        BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &now, 3 * count, "face positions"));
        status = BRC_ALLOCATE(s->context, &face, count, "held load");
        if (status == BRC_OK) status = BRC_ALLOCATE(s->context, &flag, count, "held load");
        if (status == BRC_OK) status = BRC_ALLOCATE(s->context, &base, 3 * count, "held load");
        if (status == BRC_OK) status = BRC_ALLOCATE(s->context, &direction, 3 * count, "held load");
        if (status == BRC_OK && load->kind == BRC_LOAD_FACE_VELOCITY)
            status = brc_simulation_face_displacement(s, count, set->members, now);
        if (status == BRC_OK) {
            for (int64_t m = 0; m < count; ++m) {
                face[m] = held->index_of_free_face[set->members[m]];
                flag[m] = component_bits(load);
                direction_at(load, d->free_centroid + 3 * (int64_t)set->members[m], direction + 3 * m);
                for (int c = 0; c < 3; ++c)
                    base[3 * m + c] = now[3 * m + c];
            }
            status = brc_load_fields_create(s, &brc_held_load_fields, count, entry);
        }
        if (status == BRC_OK) status = brc_upload_int(entry->face, face, count);
        if (status == BRC_OK) status = upload_components(s, entry->component, flag, (int32_t)count);
        if (status == BRC_OK) status = brc_upload_state(s, entry->base, base, 3 * count);
        if (status == BRC_OK) status = brc_upload_state(s, entry->direction, direction, 3 * count);
        brc_memory_free(face);
        brc_memory_free(flag);
        brc_memory_free(base);
        brc_memory_free(direction);
        if (status != BRC_OK) goto cleanup;
    }
    BRC_TRY_OR(cleanup, brc_load_fields_create(s, &brc_held_face_fields, n, held));
    BRC_TRY_OR(cleanup, brc_upload_coeff(s, held->area, area, 3 * (int64_t)n));
    BRC_TRY_OR(cleanup, brc_upload_coeff(s, held->arm, arm, 3 * (int64_t)n));
    BRC_TRY_OR(cleanup, brc_upload_coeff(s, held->spring, spring, n));
    BRC_TRY_OR(cleanup, upload_components(s, held->held, held->component_of_face, n));
cleanup:
    brc_memory_free(bits);
    brc_memory_free(items);
    brc_memory_free(element);
    brc_memory_free(place);
    brc_memory_free(face_start);
    brc_memory_free(face_of);
    brc_memory_free(area);
    brc_memory_free(arm);
    brc_memory_free(spring);
    brc_memory_free(now);
    return status;
}

/* Tractions of one load, summed per element over the components that are not held. */
static brc_status create_traction(brc_simulation *s, const brc_stage *stage, int32_t l, const brc_held_faces *held,
                                  brc_traction_load *out)
{
    const brc_domain *d = s->domain;
    const brc_load *load = stage->loads + l;
    brc_status status = BRC_OK;
    const brc_set *set = find_named(s, stage, load, BRC_SET_FACES, &status);
    if (!set) return status;
    int64_t count = 0;
    brc_loaded_face *loaded = NULL;
    row_item *items = NULL;
    int32_t *element = NULL, *place = NULL, n = 0;
    double *total = NULL, *moment = NULL;
    BRC_TRY_OR(cleanup, brc_loaded_faces(s->context, s->scene, d, set, &loaded, &count));
    if (count == 0) { /* of a part without whole faces of the set, those that its region cuts */
        status = refuse_empty(s, stage, load);
        goto cleanup;
    }
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &items, count, "traction"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &element, count, "traction"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &place, 2 * count, "traction"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &total, 3 * count, "traction"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &moment, 9 * count, "traction"));
    for (int64_t m = 0; m < count; ++m)
        items[m] = (row_item){s->layout->row_of_element[d->free_element[loaded[m].face]], (int32_t)m};
    qsort(items, (size_t)count, sizeof *items, compare_rows);
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
        direction_at(load, face->centroid, varying);
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
    BRC_TRY_OR(cleanup, brc_load_fields_create(s, &brc_traction_fields, n, out));
    BRC_TRY_OR(cleanup, brc_upload_int(out->element, element, n));
    BRC_TRY_OR(cleanup, brc_upload_int(out->place, place, 2 * (int64_t)n));
    BRC_TRY_OR(cleanup, brc_upload_coeff(s, out->total, total, 3 * (int64_t)n));
    BRC_TRY_OR(cleanup, brc_upload_coeff(s, out->moment, moment, 9 * (int64_t)n));
cleanup:
    brc_memory_free(loaded);
    brc_memory_free(items);
    brc_memory_free(element);
    brc_memory_free(place);
    brc_memory_free(total);
    brc_memory_free(moment);
    return status;
}

brc_status brc_loads_refuse_twice(brc_simulation *s, const brc_stage *stage, const brc_load *load, int64_t n)
{
    return BRC_FAIL(s->context, BRC_BAD_INPUT,
                    "stage '%s': the %s of '%s' prescribes components of %lld elements that another load of the stage "
                    "prescribes too; give each "
                    "component of an element to one load",
                    stage->name, load->kind == BRC_LOAD_ELEMENT_ROTATION ? "rotation" : "motion", load->set,
                    (long long)n);
}

static brc_status upload_imposed(brc_simulation *s, brc_imposed_load *out, const int32_t *row, const int32_t *bits,
                                 const double *base)
{
    BRC_TRY(brc_load_fields_create(s, &brc_imposed_fields, out->n, out));
    BRC_TRY(brc_upload_int(out->element, row, out->n));
    BRC_TRY(upload_components(s, out->component, bits, out->n));
    return brc_upload_state(s, out->base, base, 3 * (int64_t)out->n);
}

/* Imposed elements: the members of an element set, or the owners of a face set. taken: bits per element. */
static brc_status create_imposed(brc_simulation *s, const brc_stage *stage, int32_t l, int32_t *taken,
                                 brc_imposed_load *out)
{
    const brc_domain *d = s->domain;
    const brc_load *load = stage->loads + l;
    brc_status status = BRC_OK;
    brc_load_member *items = NULL;
    int32_t *element = NULL, *flag = NULL, n = 0;
    int64_t twice = 0;
    double *base = NULL, *direction = NULL, *now = NULL;
    BRC_TRY_OR(cleanup, brc_load_members(s, stage, load, &items, &n));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &out->element_id, n, "imposed elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &element, n, "imposed elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &flag, n, "imposed elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &base, 3 * (int64_t)n, "imposed elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &direction, 3 * (int64_t)n, "imposed elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &now, 3 * d->n_elements, "imposed elements"));
    if (load->kind == BRC_LOAD_ELEMENT_VELOCITY) BRC_TRY_OR(cleanup, brc_simulation_displacement(s, now));
    out->load = l;
    out->n = n;
    out->component_bits = component_bits(load);
    for (int32_t i = 0; i < n; ++i) {
        const int64_t e = items[i].id;
        element[i] = items[i].row;
        out->element_id[i] = items[i].id;
        flag[i] = out->component_bits;
        if (taken[e] & flag[i]) ++twice;
        taken[e] |= flag[i];
        direction_at(load, d->position + 3 * e, direction + 3 * (int64_t)i);
        for (int c = 0; c < 3; ++c)
            base[3 * (int64_t)i + c] = now[3 * e + c];
    }
    if (twice) {
        status = brc_loads_refuse_twice(s, stage, load, twice);
        goto cleanup;
    }
    BRC_TRY_OR(cleanup, upload_imposed(s, out, element, flag, base));
    BRC_TRY_OR(cleanup, brc_upload_state(s, out->direction, direction, 3 * (int64_t)n));
cleanup:
    brc_memory_free(items);
    brc_memory_free(element);
    brc_memory_free(flag);
    brc_memory_free(base);
    brc_memory_free(direction);
    brc_memory_free(now);
    return status;
}

const brc_load *brc_imposed_of(const brc_stage *stage, const brc_imposed_load *imposed)
{
    static const brc_load still = {.kind = BRC_LOAD_ELEMENT_DISPLACEMENT};
    return imposed->load < 0 ? &still : stage->loads + imposed->load;
}

/* Elements that no beam holds stay where they are, in the components that no load of the stage prescribes. */
static brc_status create_still(brc_simulation *s, const brc_stage *stage, const int32_t *taken, brc_imposed_load *out,
                               bool *any)
{
    const brc_domain *d = s->domain;
    int32_t *element = NULL, *flag = NULL, n = 0;
    double *base = NULL, *now = NULL;
    brc_status status = BRC_OK;
    const bool meets = s->scene->has_contact && stage->solver == BRC_SOLVER_DYNAMIC;
    *any = false;
    if (!brc_has_spheres(s) || (meets && !s->scene->model.keep_isolated))
        return BRC_OK; /* loose ones are for contact */
    for (int64_t e = 0; e < d->n_elements; ++e)
        n += d->row_start[e + 1] == d->row_start[e];
    if (n == 0) return BRC_OK;
    *any = true;
    *out = (brc_imposed_load){.load = -1, .n = n, .component_bits = 7};
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &out->element_id, n, "isolated elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &element, n, "isolated elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &flag, n, "isolated elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &base, 3 * (int64_t)n, "isolated elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &now, 3 * d->n_elements, "isolated elements"));
    BRC_TRY_OR(cleanup, brc_simulation_displacement(s, now));
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
    status = upload_imposed(s, out, element, flag, base);
cleanup:
    brc_memory_free(element);
    brc_memory_free(flag);
    brc_memory_free(base);
    brc_memory_free(now);
    return status;
}

brc_status brc_loads_create(brc_simulation *s, const brc_stage *stage, brc_loads *out)
{
    int32_t *taken = NULL, *turned = NULL;
    brc_status status = create_held(s, stage, &out->held), first = status;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &taken, s->domain->n_elements, "imposed elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &turned, s->domain->n_elements, "turned elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &out->pushes, stage->n_loads, "forces on elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &out->turns, stage->n_loads, "turned elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &out->tractions, stage->n_loads, "tractions"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &out->imposed, stage->n_loads + 1, "imposed elements"));
    for (int32_t l = 0; l < stage->n_loads; ++l) { /* go on after an error: all in one pass */
        const brc_load *load = stage->loads + l;
        status = BRC_OK;
        if (is_element_motion(load)) {
            status = create_imposed(s, stage, l, taken, out->imposed + out->n_imposed++);
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
        status = create_still(s, stage, taken, out->imposed + out->n_imposed, &any);
        out->n_imposed += any;
    }
    out->on_faces = out->held.n_faces > 0 || out->n_tractions > 0;
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
    for (int32_t i = 0; i < loads->n_imposed; ++i) {
        brc_memory_free(loads->imposed[i].element_id);
        brc_fields_free(&brc_imposed_fields, loads->imposed + i);
    }
    brc_memory_free(loads->tractions);
    brc_memory_free(loads->imposed);
    brc_element_loads_free(loads);
    memset(loads, 0, sizeof *loads);
}

brc_status brc_loads_prescribe(brc_simulation *s, double t)
{
    const brc_stage *stage = brc_current_stage(s);
    const bool is_static = stage->solver == BRC_SOLVER_STATIC;
    for (int32_t i = 0; i < s->loads.held.n_loads; ++i) {
        brc_held_load *e = s->loads.held.loads + i;
        BRC_TRY(BRC_RUN_ON(s->pass.held_prescribe, e->n, NULL, e,
                           {"factor", BRC_STATE(brc_load_factor(stage->loads + e->load, t, is_static))}));
    }
    for (int32_t i = 0; i < s->loads.n_imposed; ++i) {
        brc_imposed_load *m = s->loads.imposed + i;
        const brc_load *load = brc_imposed_of(stage, m);
        BRC_TRY(
            BRC_RUN_ON(s->pass.impose_motion, m->n, NULL, m, {"factor", BRC_STATE(brc_load_factor(load, t, is_static))},
                       {"rate", BRC_STATE(is_static ? 0 : brc_load_rate(load, t))}, {"set_displacement", BRC_INT(1)}));
    }
    return brc_turns_prescribe(s, t);
}

brc_status brc_imposed_book(brc_simulation *s, const brc_force_request *r)
{
    const brc_stage *stage = s->stage >= 0 ? brc_current_stage(s) : NULL;
    for (int32_t i = 0; i < s->loads.n_imposed; ++i) {
        brc_imposed_load *m = s->loads.imposed + i;
        const double rate = stage->solver == BRC_SOLVER_STATIC ? 0 : brc_load_rate(brc_imposed_of(stage, m), r->t);
        BRC_TRY(BRC_RUN_ON(s->pass.impose_book, m->n, r, m, {"rate", BRC_STATE(rate)}));
        if (r->book != BRC_BOOK_NOTHING) m->last_rate = rate;
    }
    return BRC_OK;
}

brc_status brc_loads_impose_velocity(brc_simulation *s, double t)
{
    const brc_stage *stage = brc_current_stage(s);
    for (int32_t i = 0; i < s->loads.n_imposed; ++i) {
        brc_imposed_load *m = s->loads.imposed + i;
        BRC_TRY(BRC_RUN_ON(s->pass.impose_motion, m->n, NULL, m, {"factor", BRC_STATE(0)},
                           {"rate", BRC_STATE(brc_load_rate(brc_imposed_of(stage, m), t))},
                           {"set_displacement", BRC_INT(0)}));
    }
    return brc_turns_prescribe(s, t);
}

brc_status brc_loads_zero_imposed(brc_simulation *s, brc_buffer *vector)
{
    for (int32_t i = 0; i < s->loads.n_imposed; ++i) {
        brc_imposed_load *m = s->loads.imposed + i;
        BRC_TRY(BRC_RUN_ON(s->pass.zero_imposed, m->n, NULL, m, {"vector", BRC_BUF(vector)}));
    }
    return BRC_OK;
}

brc_status brc_loads_zero_turned(brc_simulation *s, brc_buffer *vector)
{
    for (int32_t i = 0; i < s->loads.n_turns; ++i) {
        brc_turn_load *m = s->loads.turns + i;
        BRC_TRY(BRC_RUN_ON(s->pass.zero_turned, m->n, NULL, m, {"vector", BRC_BUF(vector)}));
    }
    return BRC_OK;
}

brc_status brc_loads_work(brc_simulation *s, double *out)
{
    double sum = 0, part = 0;
    if (s->loads.held.n_faces) {
        BRC_TRY(brc_vector_sum(s, s->loads.held.work, s->loads.held.n_faces, &part));
        sum += part;
    }
    for (int32_t i = 0; i < s->loads.n_tractions; ++i) {
        BRC_TRY(brc_vector_sum(s, s->loads.tractions[i].work, s->loads.tractions[i].n, &part));
        sum += part;
    }
    for (int32_t i = 0; i < s->loads.n_imposed; ++i) {
        BRC_TRY(brc_vector_sum(s, s->loads.imposed[i].work, s->loads.imposed[i].n, &part));
        sum += part;
    }
    for (int32_t i = 0; i < s->loads.n_pushes; ++i) {
        BRC_TRY(brc_vector_sum(s, s->loads.pushes[i].work, s->loads.pushes[i].n, &part));
        sum += part;
    }
    for (int32_t i = 0; i < s->loads.n_turns; ++i) {
        BRC_TRY(brc_vector_sum(s, s->loads.turns[i].work, s->loads.turns[i].n, &part));
        sum += part;
    }
    *out = sum;
    return BRC_OK;
}
