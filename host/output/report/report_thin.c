#include "report_thin.h"
#include "../../base/memory.h"

/* Before they are packed: a place, its owner and two displacements; owner and number of corners; a corner. */
enum { POINT_BYTES = 22, FACE_BYTES = 8, CORNER_BYTES = 4 };

int64_t brc_report_skin_bytes(const brc_report_skin *s)
{
    return POINT_BYTES * s->n_points + FACE_BYTES * s->n_faces + CORNER_BYTES * s->face_start[s->n_faces];
}

typedef struct thinning {
    brc_report_skin *skin;
    int64_t *first_face; /* [n_elements + 1] of an element: faces stand by owners */
    bool *kept;          /* [n_faces] */
    int32_t *used;       /* [n_points] 1: by a face that is kept, or a sphere's; later its new place */
    int64_t bytes;       /* so far */
} thinning;

static void use(thinning *t, int32_t point)
{
    if (t->used[point]) return;
    t->used[point] = 1;
    t->bytes += POINT_BYTES;
}

static void keep(thinning *t, int64_t face)
{
    const brc_report_skin *s = t->skin;
    t->kept[face] = true;
    t->bytes += FACE_BYTES + CORNER_BYTES * (s->face_start[face + 1] - s->face_start[face]);
    for (int64_t k = s->face_start[face]; k < s->face_start[face + 1]; ++k)
        use(t, s->face_corner[k]);
}

/* Faces of the first frame, and points of spheres, which no face has. */
static void keep_first(thinning *t)
{
    const brc_report_skin *s = t->skin;
    int64_t f = 0;
    for (int64_t e = 0; e < s->n_elements; ++e) {
        t->first_face[e] = f;
        while (f < s->n_faces && s->face_owner[f] == e)
            ++f;
    }
    t->first_face[s->n_elements] = f;
    for (f = 0; f < s->n_faces; ++f)
        if (s->birth[f] == 0) keep(t, f);
    for (int64_t p = 0; p < s->n_points; ++p)
        if (t->first_face[s->point_owner[p]] == t->first_face[s->point_owner[p] + 1]) use(t, (int32_t)p);
}

static int64_t divisor(int64_t a, int64_t b)
{
    return b == 0 ? a : divisor(b, a % b);
}

/* All other faces of cells that have some of the first frame, or none of it, while there is room; cells a golden
 * section of their number apart, so that they lie everywhere. */
static void keep_cells(thinning *t, bool outside, int64_t bytes)
{
    const brc_report_skin *s = t->skin;
    const int64_t n = s->n_elements;
    int64_t step = (int64_t)(0.6180339887 * (double)n);
    while (step < 1 || divisor(n, step) != 1)
        ++step;
    for (int64_t k = 0, e = 0; k < n && t->bytes < bytes; ++k, e = (e + step) % n) {
        bool first = false;
        for (int64_t f = t->first_face[e]; f < t->first_face[e + 1]; ++f)
            first |= s->birth[f] == 0;
        for (int64_t f = t->first_face[e]; first == outside && f < t->first_face[e + 1]; ++f)
            if (!t->kept[f]) keep(t, f);
    }
}

/* What is kept moves together; a point belongs to the first face that has it. */
static void move_together(thinning *t, int32_t *new_element)
{
    brc_report_skin *s = t->skin;
    int64_t n_points = 0, n_faces = 0, n_elements = 0, corner = 0;
    for (int64_t e = 0; e < s->n_elements; ++e)
        new_element[e] = -1;
    for (int64_t f = 0; f < s->n_faces; ++f)
        if (t->kept[f]) new_element[s->face_owner[f]] = 0;
    for (int64_t p = 0; p < s->n_points; ++p)
        if (t->used[p]) new_element[s->point_owner[p]] = 0; /* whose places it is looked for with */
    for (int64_t e = 0; e < s->n_elements; ++e) {
        if (new_element[e] < 0) continue;
        s->element[n_elements] = s->element[e];
        new_element[e] = (int32_t)n_elements++;
    }
    for (int64_t p = 0; p < s->n_points; ++p) {
        if (!t->used[p]) continue;
        s->point[n_points] = s->point[p];
        s->point_owner[n_points] = new_element[s->point_owner[p]];
        t->used[p] = (int32_t)n_points++;
    }
    for (int64_t f = 0; f < s->n_faces; ++f) {
        const int64_t begin = s->face_start[f], end = s->face_start[f + 1];
        if (!t->kept[f]) continue;
        s->face_owner[n_faces] = new_element[s->face_owner[f]];
        s->birth[n_faces] = s->birth[f];
        s->face_start[n_faces++] = corner;
        for (int64_t k = begin; k < end; ++k)
            s->face_corner[corner++] = t->used[s->face_corner[k]];
    }
    s->face_start[n_faces] = corner;
    s->n_points = n_points;
    s->n_faces = n_faces;
    s->n_elements = n_elements;
}

brc_status brc_report_skin_thin(brc_context *context, brc_report_skin *skin, int64_t bytes, int64_t *n_dropped)
{
    const char *what = "faces of the report";
    const int64_t n_faces = skin->n_faces;
    thinning t = {.skin = skin};
    int32_t *new_element = NULL;
    brc_status status = BRC_OK;
    *n_dropped = 0;
    if (brc_report_skin_bytes(skin) <= bytes) return BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &t.first_face, skin->n_elements + 1, what));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &t.kept, n_faces, what));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &t.used, skin->n_points, what));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &new_element, skin->n_elements, what));
    keep_first(&t);
    keep_cells(&t, true, bytes);
    keep_cells(&t, false, bytes);
    move_together(&t, new_element);
    *n_dropped = n_faces - skin->n_faces;
cleanup:
    brc_memory_free(t.first_face);
    brc_memory_free(t.kept);
    brc_memory_free(t.used);
    brc_memory_free(new_element);
    return status;
}
