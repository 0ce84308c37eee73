#include "interfaces.h"
#include "../../../../preprocess/domain/domain_rows.h"
#include "../../../base/memory.h"
#include "../../core/sym3.h"
#include <math.h>
#include <string.h>

int32_t brc_interface_of(const brc_scene *scene, const brc_domain *d, const int32_t *material, int32_t i, int32_t j)
{
    for (int32_t k = scene->n_interfaces - 1; k >= 0; --k) {
        const brc_interface *at = &scene->interfaces[k];
        if (at->kind == BRC_INTERFACE_GRAINS) {
            if (d->grain && d->grain[i] != d->grain[j]) return k;
        } else if ((at->material[0] == material[i] && at->material[1] == material[j]) ||
                   (at->material[0] == material[j] && at->material[1] == material[i])) {
            return k;
        }
    }
    return -1;
}

/* ---- how its faces stand ---- */

/* Faces of interfaces. */
typedef struct {
    const brc_scene *scene;
    const brc_domain *domain;
    const int32_t *material;
    const int32_t *face; /* [n_bonds] index into the arrays below; -1: the bond lies in no interface */
    int32_t n_faces;
    double *vector; /* [n_faces][3] area vectors of bond_half_edge; later normals of that length [m^2] */
    double *flat;   /* [n_faces] of the last mean: length of the sum over the sum of lengths [-] */
} interface_faces;

/* What the faces around one say of its normal. */
typedef enum {
    MEAN_OF_ALL, /* their mean */
    MEAN_NEAR,   /* that of those which stand near to what is known of it */
    FLATTEST     /* that of the face around which they agree best */
} which_normal;

/* The faces around one of normal `own`, out of one side of an interface and towards the other. */
typedef struct {
    int32_t interface, other; /* and what is on the other side */
    const double *own;
    double sum[3], area, near[3]; /* of all vectors, of their lengths, of those near to own */
    double best[3], score;        /* the normal of the flattest, and how flat [-] */
    double best_flat;
} surroundings;

/* What is on the side of an element: its material or, between grains, its grain. */
static int32_t side_of(const interface_faces *f, int32_t interface, int32_t e)
{
    return f->scene->interfaces[interface].kind == BRC_INTERFACE_GRAINS ? f->domain->grain[e] : f->material[e];
}

/* Element e's half-edge h leads across the interface to the side `other`. */
static bool leads_across(const interface_faces *f, int32_t interface, int32_t e, int64_t h, int32_t other)
{
    const int32_t j = f->domain->neighbour[h];
    return f->face[f->domain->bond[h]] >= 0 && brc_interface_of(f->scene, f->domain, f->material, e, j) == interface &&
           side_of(f, interface, j) == other;
}

/* Between normals that stand further apart than this lies an edge of the interface: the cosine. */
static const double same_side = 0.866;

/* Adds the faces of element e that look at the other side. */
static void add_faces(const interface_faces *f, int32_t e, surroundings *a)
{
    const brc_domain *d = f->domain;
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        if (!leads_across(f, a->interface, e, h, a->other)) continue;
        const int32_t at = f->face[d->bond[h]];
        const double sign = d->bond_half_edge[d->bond[h]] == h ? 1 : -1;
        const double *v = f->vector + 3 * (int64_t)at, size = brc_norm3(v);
        const double cosine = sign * brc_dot3(v, a->own) / (size * brc_norm3(a->own)), score = f->flat[at] * cosine;
        for (int c = 0; c < 3; ++c) {
            a->sum[c] += sign * v[c];
            if (cosine > same_side) a->near[c] += sign * v[c];
            if (score > a->score) a->best[c] = sign * v[c] / size;
        }
        a->area += size;
        if (score > a->score) a->score = score, a->best_flat = f->flat[at];
    }
}

/* Adds the faces of the elements on one side of a bond that share one of the other side with its own. seen:
 * [n_elements] the last bond that counted an element, and one. */
static void add_around(const interface_faces *f, int64_t bond, int64_t *seen, surroundings *a)
{
    const brc_domain *d = f->domain;
    const int64_t out = d->bond_half_edge[bond];
    const int32_t i = d->neighbour[d->twin[out]], j = d->neighbour[out];
    a->interface = brc_interface_of(f->scene, d, f->material, i, j);
    a->other = side_of(f, a->interface, j);
    const int32_t side = side_of(f, a->interface, i);
    for (int64_t h = d->row_start[i]; h < d->row_start[i + 1]; ++h) {
        if (!leads_across(f, a->interface, i, h, a->other)) continue;
        const int32_t across = d->neighbour[h];
        for (int64_t back = d->row_start[across]; back < d->row_start[across + 1]; ++back) {
            const int32_t e = d->neighbour[back];
            if (!leads_across(f, a->interface, across, back, side) || seen[e] == bond + 1) continue;
            seen[e] = bond + 1;
            add_faces(f, e, a);
        }
    }
}

/* Of the sum of their vectors over that of their areas: the faces look too many ways for a plane, as those of a grain
 * of one cell do, or those on both sides of a layer. A stair of whole cells has 0.5. */
static const double least_flat = 0.3;

/* The normal at a face, as long as the face's vector, and how flat the interface is there. */
static void find_normal(const interface_faces *f, int64_t bond, which_normal which, int64_t *seen, double out[3],
                        double *flat)
{
    const double *own = f->vector + 3 * (int64_t)f->face[bond];
    surroundings a = {.own = own};
    add_around(f, bond, seen, &a);
    const bool is_plane = brc_norm3(a.sum) > least_flat * a.area;
    const double *along = which == MEAN_NEAR || !is_plane ? a.near : a.sum;
    *flat = is_plane ? brc_norm3(a.sum) / a.area : 0;
    if (which == FLATTEST) along = a.score > 0 ? a.best : own, *flat = a.best_flat;
    const double length = brc_norm3(along);
    for (int k = 0; k < 3; ++k)
        out[k] = brc_norm3(own) / length * along[k];
}

static brc_status take_normals(brc_context *context, interface_faces *f, which_normal which)
{
    const brc_domain *d = f->domain;
    int short_of_memory = 0;
    BRC_LOCAL(context, 3 * (int64_t)f->n_faces, double, vector, "interfaces");
    BRC_LOCAL(context, f->n_faces, double, flat, "interfaces");
#pragma omp parallel reduction(+ : short_of_memory)
    {
        int64_t *seen = NULL;
        if (BRC_ALLOCATE(context, &seen, d->n_elements, "interfaces") != BRC_OK) short_of_memory = 1;
#pragma omp for schedule(static)
        for (int64_t b = 0; b < d->n_bonds; ++b)
            if (f->face[b] >= 0 && seen)
                find_normal(f, b, which, seen, vector + 3 * (int64_t)f->face[b], flat + f->face[b]);
        brc_memory_free(seen);
    }
    if (short_of_memory) return BRC_NO_MEMORY;
    memcpy(f->vector, vector, 24 * (size_t)f->n_faces);
    memcpy(f->flat, flat, 8 * (size_t)f->n_faces);
    return BRC_OK;
}

/* Area vectors out of the elements of half_edge [n][3]: of faces, or along beams, as large as their length squared. */
static brc_status area_vectors(brc_context *context, const brc_domain *d, int32_t n, const int32_t *half_edge,
                               double *out)
{
    BRC_LOCAL(context, 6 * (int64_t)n, double, face, "interfaces");
    if (d->element_kind == BRC_ELEMENT_CELL) BRC_TRY(brc_domain_faces(context, d, n, half_edge, face));
    for (int32_t k = 0; k < n; ++k) {
        const int32_t h = half_edge[k];
        double *v = face + 6 * (int64_t)k;
        if (d->element_kind != BRC_ELEMENT_CELL) {
            const double *from = d->position + 3 * (int64_t)d->neighbour[d->twin[h]],
                         *to = d->position + 3 * (int64_t)d->neighbour[h];
            const double branch[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
            for (int c = 0; c < 3; ++c)
                v[c] = brc_norm3(branch) * branch[c];
        }
        memcpy(out + 3 * (int64_t)k, v, 24);
    }
    return BRC_OK;
}

/* Two normals of every face: of means of means over all faces around, among which steps of whole cells cancel, but an
 * edge is rounded off; and of the flattest of them, sharp beside an edge, but a plane is dented. The former where they
 * agree, and then once more the mean of what is on the same side. */
static brc_status smooth(brc_context *context, interface_faces *f)
{
    const size_t bytes = 24 * (size_t)f->n_faces;
    BRC_LOCAL(context, 3 * (int64_t)f->n_faces, double, first, "interfaces");
    BRC_LOCAL(context, 3 * (int64_t)f->n_faces, double, sharp, "interfaces");
    BRC_TRY(take_normals(context, f, MEAN_OF_ALL));
    memcpy(first, f->vector, bytes);
    BRC_TRY(take_normals(context, f, FLATTEST));
    BRC_TRY(take_normals(context, f, MEAN_NEAR));
    BRC_TRY(take_normals(context, f, MEAN_NEAR));
    memcpy(sharp, f->vector, bytes);
    memcpy(f->vector, first, bytes);
    BRC_TRY(take_normals(context, f, MEAN_OF_ALL));
    for (int64_t k = 0; k < f->n_faces; ++k) {
        double *v = f->vector + 3 * k;
        const double *s = sharp + 3 * k;
        if (brc_dot3(v, s) < same_side * brc_norm3(v) * brc_norm3(s)) memcpy(v, s, 24);
    }
    return take_normals(context, f, MEAN_NEAR);
}

static brc_status find_normals(brc_context *context, interface_faces *f, double least, double **out)
{
    const brc_domain *d = f->domain;
    const int32_t n = f->n_faces;
    BRC_LOCAL(context, n, int32_t, half_edge, "interfaces");
    BRC_LOCAL(context, 3 * (int64_t)n, double, own, "interfaces");
    BRC_LOCAL(context, 3 * (int64_t)n, double, vector, "interfaces");
    BRC_LOCAL(context, n, double, flat, "interfaces");
    for (int64_t b = 0; b < d->n_bonds; ++b)
        if (f->face[b] >= 0) half_edge[f->face[b]] = d->bond_half_edge[b];
    BRC_TRY(area_vectors(context, d, n, half_edge, own));
    memcpy(vector, own, 24 * (size_t)n);
    f->vector = vector, f->flat = flat;
    BRC_TRY(smooth(context, f));
    BRC_TRY(BRC_ALLOCATE(context, out, 3 * d->n_bonds, "interfaces"));
    for (int64_t b = 0; b < d->n_bonds; ++b) {
        if (f->face[b] < 0) continue;
        const double *s = own + 3 * (int64_t)f->face[b], *along = vector + 3 * (int64_t)f->face[b];
        const double size = brc_norm3(s), c = brc_dot3(s, along) / (size * size);
        for (int k = 0; k < 3; ++k)
            (*out)[3 * b + k] = fmax(c, least) / size * along[k];
    }
    return BRC_OK;
}

brc_status brc_interface_normals(brc_context *context, const brc_scene *scene, const brc_domain *d,
                                 const int32_t *material, double least, double **out)
{
    int32_t n_faces = 0;
    *out = NULL;
    if (scene->n_interfaces == 0) return BRC_OK;
    BRC_LOCAL(context, d->n_bonds, int32_t, face, "interfaces");
    for (int64_t b = 0; b < d->n_bonds; ++b) {
        const int64_t h = d->bond_half_edge[b];
        const int32_t i = d->neighbour[d->twin[h]], j = d->neighbour[h];
        face[b] = brc_interface_of(scene, d, material, i, j) >= 0 ? n_faces++ : -1;
    }
    interface_faces f = {.scene = scene, .domain = d, .material = material, .face = face, .n_faces = n_faces};
    return n_faces > 0 ? find_normals(context, &f, least, out) : BRC_OK;
}
