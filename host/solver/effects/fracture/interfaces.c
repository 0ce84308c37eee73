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
    int32_t *face;  /* [n_bonds] index into `vector`; -1: the bond lies in no interface */
    double *vector; /* [n_faces][3] area vectors of bond_half_edge; later normals of that length [m^2] */
    int64_t *seen;  /* [n_elements] turn in which this element's faces were taken last */
    int64_t turn;
    bool is_smooth; /* the vectors are normals of the interface */
} interface_faces;

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

/* Of the normals around one, those that stand further from it than this, beyond an edge of the interface, are not
 * taken: the cosine. */
static const double same_side = 0.866;

/* Adds the faces of element e that look at the side `other`: as vectors, and their areas. own: the vector of the face
 * that they are around. */
static void add_faces(const interface_faces *f, int32_t interface, int32_t e, int32_t other, const double own[3],
                      double sum[3], double *area)
{
    const brc_domain *d = f->domain;
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        if (!leads_across(f, interface, e, h, other)) continue;
        const double *s = f->vector + 3 * (int64_t)f->face[d->bond[h]], size = brc_norm3(s);
        const double sign = d->bond_half_edge[d->bond[h]] == h ? 1 : -1;
        const double along = sign * (s[0] * own[0] + s[1] * own[1] + s[2] * own[2]);
        if (f->is_smooth && along < same_side * size * brc_norm3(own)) continue;
        for (int c = 0; c < 3; ++c)
            sum[c] += sign * s[c];
        *area += size;
    }
}

/* Sum of the faces around one, out of its smaller element's side [m^2]; area: of theirs. */
static void add_around(interface_faces *f, int64_t bond, double sum[3], double *area)
{
    const brc_domain *d = f->domain;
    const int64_t out = d->bond_half_edge[bond];
    const int32_t i = d->neighbour[d->twin[out]], j = d->neighbour[out];
    const int32_t interface = brc_interface_of(f->scene, d, f->material, i, j);
    const int32_t own = side_of(f, interface, i), other = side_of(f, interface, j);
    f->turn += 1;
    for (int64_t h = d->row_start[i]; h < d->row_start[i + 1]; ++h) {
        if (!leads_across(f, interface, i, h, other)) continue;
        const int32_t across = d->neighbour[h];
        for (int64_t back = d->row_start[across]; back < d->row_start[across + 1]; ++back) {
            const int32_t e = d->neighbour[back];
            if (!leads_across(f, interface, across, back, own) || f->seen[e] == f->turn) continue;
            f->seen[e] = f->turn;
            add_faces(f, interface, e, other, f->vector + 3 * (int64_t)f->face[bond], sum, area);
        }
    }
}

/* Of the sum of their vectors over that of their areas: the faces look too many ways for a plane, as those of a grain
 * of one cell do. */
static const double least_flat = 0.5;

/* The mean normal around a face, as long as the face's vector; that itself where there is no plane. */
static void find_mean(interface_faces *f, int64_t bond, double out[3])
{
    const double *s = f->vector + 3 * (int64_t)f->face[bond];
    double sum[3] = {0, 0, 0}, area = 0;
    add_around(f, bond, sum, &area);
    const double length = brc_norm3(sum);
    const bool is_plane = length > least_flat * area;
    for (int k = 0; k < 3; ++k)
        out[k] = is_plane ? brc_norm3(s) / length * sum[k] : s[k];
}

/* Means of means are smoother: of cells of 90 % spread one stands 6.4 degrees askew, two 3.1, three 2.5. */
enum { N_MEANS = 3 };

static brc_status find_means(brc_context *context, interface_faces *f, int32_t n_faces)
{
    const brc_domain *d = f->domain;
    BRC_LOCAL(context, 3 * (int64_t)n_faces, double, mean, "interfaces");
    for (int turn = 0; turn < N_MEANS; ++turn) {
        for (int64_t b = 0; b < d->n_bonds; ++b)
            if (f->face[b] >= 0) find_mean(f, b, mean + 3 * (int64_t)f->face[b]);
        memcpy(f->vector, mean, 24 * (size_t)n_faces);
        f->is_smooth = true;
    }
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

static brc_status find_normals(brc_context *context, interface_faces *f, int32_t n_faces, double least, double **out)
{
    const brc_domain *d = f->domain;
    BRC_LOCAL(context, n_faces, int32_t, half_edge, "interfaces");
    BRC_LOCAL(context, 3 * (int64_t)n_faces, double, own, "interfaces");
    BRC_LOCAL(context, 3 * (int64_t)n_faces, double, vector, "interfaces");
    BRC_LOCAL(context, d->n_elements, int64_t, seen, "interfaces");
    for (int64_t b = 0; b < d->n_bonds; ++b)
        if (f->face[b] >= 0) half_edge[f->face[b]] = d->bond_half_edge[b];
    BRC_TRY(area_vectors(context, d, n_faces, half_edge, own));
    memcpy(vector, own, 24 * (size_t)n_faces);
    f->vector = vector, f->seen = seen;
    BRC_TRY(find_means(context, f, n_faces));
    BRC_TRY(BRC_ALLOCATE(context, out, 3 * d->n_bonds, "interfaces"));
    for (int64_t b = 0; b < d->n_bonds; ++b) {
        if (f->face[b] < 0) continue;
        const double *s = own + 3 * (int64_t)f->face[b], *along = vector + 3 * (int64_t)f->face[b];
        const double size = brc_norm3(s), c = (s[0] * along[0] + s[1] * along[1] + s[2] * along[2]) / (size * size);
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
    interface_faces f = {.scene = scene, .domain = d, .material = material, .face = face};
    return n_faces > 0 ? find_normals(context, &f, n_faces, least, out) : BRC_OK;
}
