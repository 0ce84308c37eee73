/* Polyhedra of the elements and of the strikers' pieces on the device, and where the pieces are. */
#include "../../../../preprocess/shapes/convex.h"
#include "contact_internal.h"
#include "../strikers/striker_contact.h"
#include <math.h>
#include <string.h>

/* Numbers of one kind, first those of the elements and then those of the pieces. */
static brc_status upload_both(brc_simulation *s, brc_buffer *out, const double *first, int64_t n_first,
                              const double *second, int64_t n_second, const char *what)
{
    BRC_LOCAL(s->context, n_first + n_second, double, all, what);
    if (n_first) memcpy(all, first, (size_t)n_first * sizeof *all);
    if (n_second) memcpy(all + n_first, second, (size_t)n_second * sizeof *all);
    return brc_upload_state(s, out, all, n_first + n_second);
}

/* Starts [n + 1] of the elements and of the pieces after them; NULL: elements have none. */
static brc_status upload_starts(brc_simulation *s, brc_buffer *out, const int32_t *first, int64_t n_first,
                                const int32_t *second, int64_t n_second, const char *what)
{
    const int32_t before = first ? first[n_first] : 0;
    BRC_LOCAL(s->context, n_first + n_second + 1, int32_t, all, what);
    for (int64_t k = 0; first && k <= n_first; ++k)
        all[k] = first[k];
    for (int64_t k = 0; k <= n_second; ++k)
        all[n_first + k] = before + (second ? second[k] : 0);
    return brc_upload_int(out, all, n_first + n_second + 1);
}

static brc_status upload_shapes(brc_simulation *s, const brc_convex *cells, const brc_convex *pieces)
{
    brc_contact_state *c = s->contact;
    const char *what = "polyhedra";
    const int64_t n = s->domain->n_elements, np = pieces->n;
    const int64_t corners = cells->n ? cells->corner_start[n] : 0, faces = cells->n ? cells->face_start[n] : 0,
                  loops = cells->n ? cells->loop_start[faces] : 0;
    const int64_t more_corners = np ? pieces->corner_start[np] : 0, more_faces = np ? pieces->face_start[np] : 0,
                  more_loops = np ? pieces->loop_start[more_faces] : 0;
    BRC_FREED double *nothing = NULL;
    BRC_TRY(upload_both(s, c->corner, cells->corner, 3 * corners, pieces->corner, 3 * more_corners, what));
    BRC_TRY(upload_both(s, c->plane, cells->plane, 4 * faces, pieces->plane, 4 * more_faces, what));
    if (!cells->n) BRC_TRY(BRC_ALLOCATE(s->context, &nothing, n, what));
    BRC_TRY(upload_both(s, c->radius, cells->n ? cells->radius : nothing, n, pieces->radius, np, what));
    BRC_TRY(
        upload_starts(s, c->corner_start, cells->n ? cells->corner_start : NULL, n, pieces->corner_start, np, what));
    BRC_TRY(upload_starts(s, c->face_start, cells->n ? cells->face_start : NULL, n, pieces->face_start, np, what));
    BRC_TRY(upload_starts(s, c->loop_start, cells->n ? cells->loop_start : NULL, faces, pieces->loop_start, more_faces,
                          what));
    BRC_LOCAL(s->context, loops + more_loops, int32_t, loop, what);
    if (loops) memcpy(loop, cells->loop, (size_t)loops * sizeof *loop);
    if (more_loops) memcpy(loop + loops, pieces->loop, (size_t)more_loops * sizeof *loop);
    return brc_upload_int(c->loop, loop, loops + more_loops);
}

/* Of each piece a ball that holds it, about the middle of its corners; of a plane its normal and height. */
static void outline(const brc_convex *v, int32_t p, brc_striker_piece piece, double out[4])
{
    const int32_t begin = v->corner_start[p], end = v->corner_start[p + 1];
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, most = 0;
    if (piece.kind == BRC_PIECE_PLANE) {
        memcpy(out, v->plane + 4 * (int64_t)v->face_start[p], 4 * sizeof *out);
        return;
    }
    for (int64_t k = begin; k < end; ++k)
        for (int c = 0; c < 3; ++c) {
            low[c] = fmin(low[c], v->corner[3 * k + c]);
            high[c] = fmax(high[c], v->corner[3 * k + c]);
        }
    for (int c = 0; c < 3; ++c)
        out[c] = 0.5 * (low[c] + high[c]);
    for (int64_t k = begin; k < end; ++k) {
        double square = 0;
        for (int c = 0; c < 3; ++c)
            square += (v->corner[3 * k + c] - out[c]) * (v->corner[3 * k + c] - out[c]);
        most = fmax(most, square);
    }
    out[3] = fmax(sqrt(most), piece.radius);
}

static brc_status upload_pieces(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const int32_t n = c->n_pieces;
    BRC_LOCAL(s->context, n, int32_t, striker, "pieces of strikers");
    BRC_LOCAL(s->context, n, int32_t, kind, "pieces of strikers");
    BRC_LOCAL(s->context, n, double, radius, "pieces of strikers");
    BRC_LOCAL(s->context, 4 * (int64_t)n, double, own, "pieces of strikers");
    for (int32_t p = 0; p < n; ++p) {
        const brc_striker_piece piece = brc_striker_piece_of(s, p);
        outline(s->wants.pieces, p, piece, own + 4 * (int64_t)p);
        striker[p] = piece.striker;
        kind[p] = (int32_t)piece.kind;
        radius[p] = piece.radius;
    }
    BRC_TRY(brc_upload_int(c->piece_striker, striker, n));
    BRC_TRY(brc_upload_int(c->piece_kind, kind, n));
    BRC_TRY(brc_upload_state(s, c->piece_own, own, 4 * (int64_t)n));
    if (n) BRC_TRY(brc_upload_state(s, c->piece_radius, radius, n));
    return BRC_OK;
}

brc_status brc_contact_shapes(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    BRC_ENDS_WITH(brc_convex_free) brc_convex cells = {0};
    brc_convex none = {0};
    if (!brc_has_spheres(s)) BRC_TRY(brc_convex_of_domain(s->context, s->domain, 0, &cells));
    if (cells.n && c->n_pieces) BRC_TRY(brc_strikers_check_edges(s, &cells));
    BRC_TRY(upload_shapes(s, &cells, c->n_pieces ? s->wants.pieces : &none));
    return upload_pieces(s);
}
