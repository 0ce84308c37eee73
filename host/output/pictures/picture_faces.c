#include "picture_faces.h"
#include "../cracks/crack_surface.h"
#include "../../base/memory.h"

enum { MOST_CORNERS = 256 };

bool brc_picture_hides(const brc_picture_cut *cut, const double place[3])
{
    double front = 0;
    for (int c = 0; cut && c < 3; ++c)
        front += cut->normal[c] * (place[c] - cut->point[c]);
    return front > 0;
}

/* Faces are gone over twice: counted while their arrays are NULL, then written, so that no more is held than they
 * take. */
typedef struct making {
    brc_picture_faces *faces;
    int64_t n_corners;
} making;

/* One more face of n corners; where these go, NULL while it is only counted. */
static int32_t *next_face(making *m, int64_t element, int64_t n)
{
    brc_picture_faces *f = m->faces;
    int32_t *corners = f->corner ? f->corner + m->n_corners : NULL;
    m->n_corners += n;
    if (corners) {
        f->element[f->n] = (int32_t)element;
        f->start[f->n + 1] = m->n_corners;
    }
    f->n += 1;
    return corners;
}

static void add_free(making *m, const brc_domain *d, int64_t face, int64_t element)
{
    const int64_t begin = d->free_polygon_start[face], n = d->free_polygon_start[face + 1] - begin;
    int32_t *out = next_face(m, element, n);
    for (int64_t k = 0; out && k < n; ++k)
        out[k] = d->free_polygon[begin + k];
}

static void add_shared(making *m, const brc_domain *d, int64_t half_edge, int64_t element)
{
    int64_t corner[MOST_CORNERS];
    const int n = brc_crack_surface_corners(d, half_edge, MOST_CORNERS, corner);
    if (n == 0) return;
    int32_t *out = next_face(m, element, n);
    for (int k = 0; out && k < n; ++k)
        out[k] = (int32_t)corner[k];
}

static void add_all(making *m, const brc_domain *d, const uint8_t *whole, const brc_picture_cut *cut)
{
    for (int64_t e = 0; e < d->n_elements; ++e) {
        if (brc_picture_hides(cut, d->position + 3 * e)) continue;
        for (int64_t f = d->free_start[e]; f < d->free_start[e + 1]; ++f)
            add_free(m, d, f, e);
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h)
            if ((whole && !whole[h]) || brc_picture_hides(cut, d->position + 3 * (int64_t)d->neighbour[h]))
                add_shared(m, d, h, e);
    }
}

brc_status brc_picture_faces_make(brc_context *context, const brc_domain *d, const uint8_t *whole,
                                  const brc_picture_cut *cut, brc_picture_faces *out)
{
    brc_status status = BRC_OK;
    const char *what = "faces of the picture";
    *out = (brc_picture_faces){0};
    making counted = {.faces = out}, written = {.faces = out};
    add_all(&counted, d, whole, cut);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->element, out->n, what));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->start, out->n + 1, what));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->corner, counted.n_corners, what));
    out->n = 0;
    add_all(&written, d, whole, cut);
cleanup:
    if (status != BRC_OK) brc_picture_faces_free(out);
    return status;
}

void brc_picture_faces_free(brc_picture_faces *faces)
{
    brc_memory_free(faces->element);
    brc_memory_free(faces->start);
    brc_memory_free(faces->corner);
    *faces = (brc_picture_faces){0};
}
