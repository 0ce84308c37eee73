#include "report_skin.h"
#include "../../base/memory.h"
#include <math.h>

/* Faces by the points that they have, in whatever order: open addressing, a face that two cells share counts two. */
typedef struct face_table {
    uint64_t mask, *key; /* [mask + 1]; 0: free */
    uint8_t *count;
} face_table;

static uint64_t mix(uint64_t x) /* splitmix64 */
{
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

/* Equal for equal sets of points. */
static uint64_t key_of(int64_t n, const int64_t *point)
{
    uint64_t key = 0;
    for (int64_t k = 0; k < n; ++k)
        key += mix((uint64_t)point[k]);
    return key ? key : 1;
}

static uint64_t slot_of(const face_table *t, uint64_t key)
{
    uint64_t slot = key & t->mask;
    while (t->key[slot] && t->key[slot] != key)
        slot = (slot + 1) & t->mask;
    return slot;
}

static brc_status count_faces(brc_context *context, const brc_report_frame *f, face_table *t)
{
    const char *what = "faces of a frame";
    t->mask = 1;
    while (t->mask < (uint64_t)f->n_faces * 2)
        t->mask = 2 * t->mask + 1;
    BRC_TRY(BRC_ALLOCATE(context, &t->key, t->mask + 1, what));
    BRC_TRY(BRC_ALLOCATE(context, &t->count, t->mask + 1, what));
    for (int64_t k = 0; k < f->n_faces; ++k) {
        const uint64_t key = key_of(f->face_start[k + 1] - f->face_start[k], f->face_point + f->face_start[k]);
        const uint64_t slot = slot_of(t, key);
        t->key[slot] = key;
        if (t->count[slot] < 2) ++t->count[slot];
    }
    return BRC_OK;
}

static void free_table(face_table *t)
{
    brc_memory_free(t->key);
    brc_memory_free(t->count);
}

static bool is_open(const face_table *t, const brc_report_frame *f, int64_t k)
{
    const int64_t n = f->face_start[k + 1] - f->face_start[k];
    return n >= 3 && t->count[slot_of(t, key_of(n, f->face_point + f->face_start[k]))] == 1;
}

/* Made in two rounds: counted while its arrays are NULL, then written. */
typedef struct making {
    brc_report_skin *skin;
    const brc_report_frame *frame;
    const face_table *table;
    int32_t *seen_point; /* [points of the frame] place in the skin, -1: not yet */
    int64_t n_corners;
} making;

static int32_t add_point(making *m, int64_t point, int32_t owner)
{
    brc_report_skin *s = m->skin;
    if (m->seen_point[point] >= 0) return m->seen_point[point];
    if (s->point) {
        s->point[s->n_points] = point;
        s->point_owner[s->n_points] = owner;
    }
    return m->seen_point[point] = (int32_t)s->n_points++;
}

static void add_face(making *m, int64_t face, int32_t owner)
{
    const brc_report_frame *f = m->frame;
    brc_report_skin *s = m->skin;
    for (int64_t k = f->face_start[face]; k < f->face_start[face + 1]; ++k, ++m->n_corners) {
        const int32_t place = add_point(m, f->face_point[k], owner);
        if (s->face_corner) s->face_corner[m->n_corners] = place;
    }
    if (s->face_owner) {
        s->face_owner[s->n_faces] = owner;
        s->face_start[s->n_faces + 1] = m->n_corners;
        s->birth[s->n_faces] = -1;
    }
    ++s->n_faces;
}

static void add_all(making *m)
{
    const brc_report_frame *f = m->frame;
    brc_report_skin *s = m->skin;
    s->n_elements = s->n_points = s->n_faces = m->n_corners = 0;
    for (int64_t k = 0; k < f->n_points; ++k)
        m->seen_point[k] = -1;
    for (int64_t e = 0; e < f->n_elements; ++e) {
        const int64_t faces_before = s->n_faces, points_before = s->n_points;
        const int32_t owner = (int32_t)s->n_elements;
        if (f->cell_start[e] == f->cell_start[e + 1]) continue;
        if (brc_report_frame_is_sphere(f, e))
            add_point(m, f->cell_point[f->cell_start[e]], owner);
        else
            for (int64_t k = f->cell_face[e]; k < f->cell_face[e + 1]; ++k)
                if (is_open(m->table, f, k)) add_face(m, k, owner);
        if (s->n_faces == faces_before && s->n_points == points_before) continue;
        if (s->element) s->element[s->n_elements] = (int32_t)e;
        ++s->n_elements;
    }
}

brc_status brc_report_skin_make(brc_context *context, const brc_report_frame *last, brc_report_skin *out)
{
    const char *what = "faces of the report";
    face_table table = {0};
    making m = {.skin = out, .frame = last, .table = &table};
    brc_status status = BRC_OK;
    *out = (brc_report_skin){0};
    BRC_TRY_OR(cleanup, count_faces(context, last, &table));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &m.seen_point, last->n_points, what));
    add_all(&m);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->element, out->n_elements, what));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->point, out->n_points, what));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->point_owner, out->n_points, what));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->face_owner, out->n_faces, what));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->face_start, out->n_faces + 1, what));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->face_corner, m.n_corners, what));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->birth, out->n_faces, what));
    add_all(&m);
cleanup:
    free_table(&table);
    brc_memory_free(m.seen_point);
    if (status != BRC_OK) brc_report_skin_free(out);
    return status;
}

void brc_report_skin_free(brc_report_skin *s)
{
    void *const all[] = {s->element, s->point, s->point_owner, s->face_owner, s->face_start, s->face_corner, s->birth};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k)
        brc_memory_free(all[k]);
    *s = (brc_report_skin){0};
}

void brc_report_skin_places(const brc_report_skin *s, const brc_report_frame *last, const brc_report_frame *frame,
                            int64_t *place)
{
    for (int64_t p = 0; p < s->n_points; ++p) {
        const float *x = last->point + 3 * s->point[p];
        const int32_t e = s->element[s->point_owner[p]];
        float nearest = INFINITY;
        for (int64_t k = frame->cell_start[e]; k < frame->cell_start[e + 1]; ++k) {
            const float *y = frame->point + 3 * frame->cell_point[k];
            const float far =
                (x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1]) + (x[2] - y[2]) * (x[2] - y[2]);
            if (!(far < nearest)) continue;
            nearest = far;
            place[p] = frame->cell_point[k];
        }
    }
}

brc_status brc_report_skin_births(brc_context *context, brc_report_skin *s, const brc_report_frame *frame,
                                  const int64_t *place, int32_t shown)
{
    face_table table = {0};
    brc_status status = count_faces(context, frame, &table);
    for (int64_t f = 0; status == BRC_OK && f < s->n_faces; ++f) {
        uint64_t key = 0;
        if (s->birth[f] >= 0) continue;
        for (int64_t k = s->face_start[f]; k < s->face_start[f + 1]; ++k)
            key += mix((uint64_t)place[s->face_corner[k]]);
        if (table.count[slot_of(&table, key ? key : 1)] == 1) s->birth[f] = shown;
    }
    free_table(&table);
    return status;
}
