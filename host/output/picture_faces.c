#include "picture_faces.h"
#include "crack_surface.h"
#include "../base/memory.h"

enum { MOST_CORNERS = 256 };

bool brc_picture_hides(const brc_picture_cut *cut, const double place[3])
{
    double front = 0;
    for (int c = 0; cut && c < 3; ++c) front += cut->normal[c] * (place[c] - cut->point[c]);
    return front > 0;
}

typedef struct room {
    brc_context *context;
    int64_t faces, corners;
} room;

/* Room for one more face of n corners. */
static brc_status grow(room *r, brc_picture_faces *f, int64_t n)
{
    const char *what = "faces of the picture";
    const int64_t used = f->n > 0 ? f->start[f->n] : 0;
    if (f->n + 1 >= r->faces) {
        r->faces = 2 * r->faces + 1024;
        BRC_TRY(brc_memory_resize(r->context, (void **)&f->element, r->faces, sizeof *f->element, what));
        BRC_TRY(brc_memory_resize(r->context, (void **)&f->start, r->faces + 1, sizeof *f->start, what));
        f->start[0] = 0;
    }
    if (used + n > r->corners) {
        r->corners = 2 * r->corners + n + 4096;
        BRC_TRY(brc_memory_resize(r->context, (void **)&f->corner, r->corners, sizeof *f->corner, what));
    }
    return BRC_OK;
}

static void close_face(brc_picture_faces *f, int64_t element, int64_t n)
{
    f->element[f->n] = (int32_t)element;
    f->start[f->n + 1] = f->start[f->n] + n;
    f->n += 1;
}

static brc_status add_free(room *r, const brc_domain *d, int64_t face, int64_t element, brc_picture_faces *out)
{
    const int64_t begin = d->free_polygon_start[face], n = d->free_polygon_start[face + 1] - begin;
    BRC_TRY(grow(r, out, n));
    for (int64_t k = 0; k < n; ++k) out->corner[out->start[out->n] + k] = d->free_polygon[begin + k];
    close_face(out, element, n);
    return BRC_OK;
}

static brc_status add_shared(room *r, const brc_domain *d, int64_t half_edge, int64_t element, brc_picture_faces *out)
{
    int64_t corner[MOST_CORNERS];
    const int n = brc_crack_surface_corners(d, half_edge, MOST_CORNERS, corner);
    if (n == 0) return BRC_OK;
    BRC_TRY(grow(r, out, n));
    for (int k = 0; k < n; ++k) out->corner[out->start[out->n] + k] = (int32_t)corner[k];
    close_face(out, element, n);
    return BRC_OK;
}

brc_status brc_picture_faces_make(brc_context *context, const brc_domain *d, const uint8_t *whole, const brc_picture_cut *cut, brc_picture_faces *out)
{
    room r = {.context = context};
    brc_status status = BRC_OK;
    *out = (brc_picture_faces){0};
    BRC_TRY_OR(cleanup, grow(&r, out, 0)); /* start[0] is there also where no face is */
    for (int64_t e = 0; e < d->n_elements; ++e) {
        if (brc_picture_hides(cut, d->position + 3 * e)) continue;
        for (int64_t f = d->free_start[e]; f < d->free_start[e + 1]; ++f) BRC_TRY_OR(cleanup, add_free(&r, d, f, e, out));
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h)
            if ((whole && !whole[h]) || brc_picture_hides(cut, d->position + 3 * (int64_t)d->neighbour[h])) BRC_TRY_OR(cleanup, add_shared(&r, d, h, e, out));
    }
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
