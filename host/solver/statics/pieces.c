#include "pieces.h"
#include "../effects/fracture/breaking.h"
#include "../effects/loads/loads.h"

/* Elements by piece, each piece's in the order of their ids. */
static brc_status sort_elements(brc_simulation *s, const int32_t *piece, brc_pieces *p)
{
    const int64_t n = s->domain->n_elements;
    BRC_TRY(BRC_ALLOCATE(s->context, &p->start, p->n + 1, "pieces"));
    BRC_TRY(BRC_ALLOCATE(s->context, &p->element, n, "pieces"));
    BRC_TRY(BRC_ALLOCATE(s->context, &p->place, 3 * n, "pieces"));
    BRC_TRY(BRC_ALLOCATE(s->context, &p->free, p->n, "pieces"));
    for (int64_t e = 0; e < n; ++e)
        p->start[piece[e] + 1] += 1;
    for (int64_t i = 0; i < p->n; ++i)
        p->start[i + 1] += p->start[i];
    for (int64_t e = 0; e < n; ++e) {
        const int64_t at = p->start[piece[e]]++;
        p->element[at] = (int32_t)e;
        for (int c = 0; c < 3; ++c)
            p->place[3 * at + c] = s->domain->position[3 * e + c];
    }
    for (int64_t i = p->n; i > 0; --i)
        p->start[i] = p->start[i - 1];
    p->start[0] = 0;
    return BRC_OK;
}

typedef struct piece_holds {
    const brc_domain *domain;
    const int32_t *piece;
    brc_pieces *p;
} piece_holds;

static void hold(void *self, const brc_prescribed *one)
{
    const piece_holds *h = self;
    const brc_domain *d = h->domain;
    const double *x =
        one->face < 0 ? d->position + 3 * (int64_t)one->element : d->free_centroid + 3 * (int64_t)one->face;
    for (int c = 0; one->by_load && c < 3; ++c) {
        if (one->motion >> c & 1) brc_free_motions_hold(&h->p->free[h->piece[one->element]], x, c);
        if (one->rotation >> c & 1) brc_free_motions_clamp(&h->p->free[h->piece[one->element]], c);
    }
}

static brc_status find_free(brc_simulation *s, const int32_t *piece, brc_pieces *p)
{
    for (int64_t i = 0; i < p->n; ++i)
        brc_free_motions_begin(&p->free[i], p->start[i + 1] - p->start[i], p->place + 3 * p->start[i]);
    brc_loads_each_prescribed(s, hold, &(piece_holds){s->domain, piece, p});
    for (int64_t i = 0; i < p->n; ++i) {
        if (!brc_free_motions_find(&p->free[i]))
            return BRC_FAIL(s->context, BRC_INTERNAL, "the free motions of the stage were not found");
        p->any |= p->free[i].n > 0;
    }
    return BRC_OK;
}

brc_status brc_pieces_number(brc_context *context, const brc_domain *d, int32_t *piece, int64_t *n)
{
    BRC_LOCAL(context, d->n_elements, int32_t, stack, "pieces");
    *n = 0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        piece[e] = -1;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        int64_t top = 0;
        if (piece[e] >= 0) continue;
        piece[e] = (int32_t)*n;
        stack[top++] = (int32_t)e;
        while (top > 0) {
            const int32_t now = stack[--top];
            for (int64_t h = d->row_start[now]; h < d->row_start[now + 1]; ++h) {
                if (piece[d->neighbour[h]] >= 0) continue;
                piece[d->neighbour[h]] = (int32_t)*n;
                stack[top++] = d->neighbour[h];
            }
        }
        ++*n;
    }
    return BRC_OK;
}

brc_status brc_pieces_find(brc_simulation *s, brc_pieces *out)
{
    brc_pieces_free(out);
    BRC_LOCAL(s->context, s->domain->n_elements, int32_t, piece, "pieces");
    if (s->fracture)
        BRC_TRY(brc_simulation_fragments(s, piece, &out->n));
    else
        BRC_TRY(brc_pieces_number(s->context, s->domain, piece, &out->n));
    BRC_TRY(sort_elements(s, piece, out));
    return find_free(s, piece, out);
}

void brc_pieces_free(brc_pieces *pieces)
{
    brc_memory_free(pieces->start);
    brc_memory_free(pieces->element);
    brc_memory_free(pieces->place);
    brc_memory_free(pieces->free);
    *pieces = (brc_pieces){0};
}

brc_status brc_pieces_project(brc_context *context, const brc_pieces *p, double *force, double *torque)
{
    BRC_LOCAL(context, 6 * p->start[p->n], double, part, "pieces");
    for (int64_t i = 0; i < p->n; ++i) {
        const int64_t first = p->start[i], n = p->start[i + 1] - first;
        if (p->free[i].n == 0) continue;
        for (int64_t k = 0; k < 3 * n; ++k) {
            const int64_t of = 3 * (int64_t)p->element[first + k / 3] + k % 3;
            part[k] = force[of];
            if (torque) part[3 * n + k] = torque[of];
        }
        brc_free_motions_project(&p->free[i], n, p->place + 3 * first, part, torque ? part + 3 * n : NULL);
        for (int64_t k = 0; k < 3 * n; ++k) {
            const int64_t of = 3 * (int64_t)p->element[first + k / 3] + k % 3;
            force[of] = part[k];
            if (torque) torque[of] = part[3 * n + k];
        }
    }
    return BRC_OK;
}
