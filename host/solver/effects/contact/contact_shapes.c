/* Polyhedra of the elements and of the strikers' pieces on the device, and where the pieces are. */
#include "../../../../preprocess/shapes/convex_ranks.h"
#include "../../../base/ranks.h"
#include "contact_internal.h"
#include "../strikers/striker_contact.h"
#include <math.h>
#include <string.h>

/* Numbers that the ranks of a machine have together, which are given back. */
static brc_status upload(brc_buffer *out, brc_common_memory *numbers)
{
    BRC_TRY(brc_buffer_write_common(out, numbers));
    brc_common_memory_free(numbers);
    return BRC_OK;
}

static brc_status upload_state(brc_simulation *s, brc_buffer *out, brc_common_memory *numbers)
{
    const double *wide = numbers->data;
    const int64_t n = numbers->bytes / (int64_t)sizeof *wide;
    BRC_ENDS_WITH(brc_common_memory_free) brc_common_memory narrow = {.data = NULL};
    if (brc_state_bytes(s) == sizeof *wide) return upload(out, numbers);
    BRC_TRY(brc_common_memory_begin(s->context, n * (int64_t)sizeof(float), &narrow));
    for (int64_t k = n * narrow.part / narrow.parts; k < n * (narrow.part + 1) / narrow.parts; ++k)
        ((float *)narrow.data)[k] = (float)wide[k];
    BRC_TRY(brc_ranks_agree(s->context, BRC_OK)); /* all have written theirs */
    brc_common_memory_free(numbers);
    return upload(out, &narrow);
}

static brc_status upload_shapes(brc_simulation *s, brc_convex_common *shapes)
{
    brc_contact_state *c = s->contact;
    BRC_TRY(upload_state(s, c->corner, &shapes->memory[BRC_CONVEX_CORNER]));
    BRC_TRY(upload_state(s, c->plane, &shapes->memory[BRC_CONVEX_PLANE]));
    BRC_TRY(upload_state(s, c->radius, &shapes->memory[BRC_CONVEX_RADIUS]));
    BRC_TRY(upload(c->corner_start, &shapes->memory[BRC_CONVEX_CORNER_START]));
    BRC_TRY(upload(c->face_start, &shapes->memory[BRC_CONVEX_FACE_START]));
    BRC_TRY(upload(c->loop_start, &shapes->memory[BRC_CONVEX_LOOP_START]));
    return upload(c->loop, &shapes->memory[BRC_CONVEX_LOOP]);
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
    BRC_ENDS_WITH(brc_convex_common_free) brc_convex_common shapes = {.all = {.n = 0}};
    BRC_TRY(brc_convex_share(s->context, s->domain, c->n_pieces ? s->wants.pieces : NULL, 0, &shapes));
    if (!brc_has_spheres(s) && c->n_pieces) BRC_TRY(brc_strikers_check_edges(s, &shapes.all));
    BRC_TRY(upload_shapes(s, &shapes));
    return upload_pieces(s);
}
