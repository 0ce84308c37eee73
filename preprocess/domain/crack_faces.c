/* A domain keeps polygons of free faces only; those of the opened ones are found again (outline.h), by the rank that
 * has the cell, as are their places. */
#include "crack_faces.h"

#include "../../host/base/memory.h"
#include "../../host/base/ranks.h"
#include "../cells/outline.h"
#include "domain_rows.h"

#include <string.h>

/* The faces that become free, by element, wall and neighbour. */
typedef struct opened {
    int64_t n;
    int32_t *half_edge;       /* [n] */
    double *face;             /* [n][6] area vectors and centroids */
    int64_t *polygon_start;   /* [n + 1] */
    int32_t *polygon;         /* indices into the domain's vertex */
    brc_outline_corner *room; /* for the corners of any cell */
} opened;

/* Place of half-edge h among the opened ones of its element: by wall, then neighbour (which half-edges already
 * follow). */
static void insert(opened *o, int64_t first, int32_t h, const int32_t *wall, const brc_domain *d)
{
    int64_t k = o->n++;
    for (; k > first && wall[d->bond[o->half_edge[k - 1]]] > wall[d->bond[h]]; --k)
        o->half_edge[k] = o->half_edge[k - 1];
    o->half_edge[k] = h;
}

static brc_status list_opened(brc_context *context, const int32_t *wall, const brc_domain *d, opened *o)
{
    int64_t n = 0, n_corners = 0, most = 0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const int64_t corners = d->vertex_start[e + 1] - d->vertex_start[e];
        most = corners > most ? corners : most;
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
            if (wall[d->bond[h]] < 0) continue;
            ++n;
            n_corners += corners;
        }
    }
    BRC_TRY(BRC_ALLOCATE(context, &o->half_edge, n, "opened faces"));
    BRC_TRY(BRC_ALLOCATE(context, &o->face, 6 * n, "opened faces"));
    BRC_TRY(BRC_ALLOCATE(context, &o->polygon_start, n + 1, "polygons of opened faces"));
    BRC_TRY(BRC_ALLOCATE(context, &o->polygon, n_corners, "corners of opened faces"));
    BRC_TRY(BRC_ALLOCATE(context, &o->room, 2 * most, "corners of a cell"));
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const int64_t first = o->n;
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h)
            if (wall[d->bond[h]] >= 0) insert(o, first, (int32_t)h, wall, d);
    }
    return BRC_OK;
}

static int64_t element_of(const brc_domain *d, const opened *o, int64_t k)
{
    return d->neighbour[d->twin[o->half_edge[k]]];
}

/* Polygons of the faces of cells that are this rank's, one after another from the beginning of `polygon`, with their
 * lengths in polygon_start, behind their place. */
static brc_status outline_mine(brc_context *context, const brc_domain *d, opened *o)
{
    int64_t to = 0;
    for (int64_t k = 0; k < o->n; ++k) {
        const int64_t e = element_of(d, o, k);
        if (!brc_domain_mine(d, e)) continue;
        const int64_t count = brc_outline(d, e, o->half_edge[k], o->room, o->polygon + to);
        if (count == 0)
            return BRC_FAIL(context, BRC_INTERNAL,
                            "the corners of element %lld do not outline its face with element %d", (long long)e,
                            d->neighbour[o->half_edge[k]]);
        o->polygon_start[k + 1] = count;
        to += count;
    }
    return BRC_OK;
}

/* The polygons of all ranks, in the order of faces, which is that of their cells, and so of ranks. */
static brc_status bring_polygons(brc_context *context, const brc_domain *d, opened *o)
{
    const int32_t count = brc_ranks_count(), mine = brc_ranks_mine();
    int64_t n = 0;
    BRC_LOCAL(context, count + 1, int64_t, first, "opened faces of ranks");
    BRC_LOCAL(context, count, int64_t, n_of, "opened faces of ranks");
    for (int32_t k = 0; k < count; first[++k] = n) {
        while (n < o->n && element_of(d, o, n) < d->home[k + 1])
            ++n;
        n_of[k] = n - first[k];
    }
    int64_t *const length = o->polygon_start + 1;
    BRC_TRY(brc_ranks_gather_all(context, length + first[mine], sizeof *length, n_of, length));
    for (int32_t k = 0; k < count; ++k) {
        n_of[k] = 0;
        for (int64_t f = first[k]; f < first[k + 1]; ++f)
            n_of[k] += length[f];
    }
    BRC_LOCAL(context, n_of[mine], int32_t, own, "corners of opened faces");
    memcpy(own, o->polygon, (size_t)n_of[mine] * sizeof *own);
    return brc_ranks_gather_all(context, own, sizeof *own, n_of, o->polygon);
}

static brc_status find_opened(brc_context *context, const int32_t *wall, const brc_domain *d, opened *o)
{
    BRC_TRY(list_opened(context, wall, d, o));
    const brc_status status = outline_mine(context, d, o);
    BRC_TRY(d->here ? brc_ranks_agree(context, status) : status);
    if (d->here) BRC_TRY(bring_polygons(context, d, o));
    for (int64_t k = 0; k < o->n; ++k)
        o->polygon_start[k + 1] += o->polygon_start[k];
    return brc_domain_faces(context, d, o->n, o->half_edge, o->face);
}

/* The arrays of free faces that grow. */
typedef struct free_faces {
    int64_t *start, *polygon_start;
    int32_t *element, *wall, *polygon;
    double *area_vector, *centroid;
} free_faces;

static brc_status allocate_faces(brc_context *context, const brc_domain *d, const opened *o, free_faces *f)
{
    const int64_t n = d->n_free_faces + o->n;
    BRC_TRY(BRC_ALLOCATE(context, &f->start, d->n_elements + 1, "rows of free faces"));
    BRC_TRY(BRC_ALLOCATE(context, &f->element, n, "elements of free faces"));
    BRC_TRY(BRC_ALLOCATE(context, &f->wall, n, "walls of free faces"));
    BRC_TRY(BRC_ALLOCATE(context, &f->area_vector, 3 * n, "free area vectors"));
    BRC_TRY(BRC_ALLOCATE(context, &f->centroid, 3 * n, "free face centroids"));
    BRC_TRY(BRC_ALLOCATE(context, &f->polygon_start, n + 1, "free polygons"));
    return BRC_ALLOCATE(context, &f->polygon, d->free_polygon_start[d->n_free_faces] + o->polygon_start[o->n],
                        "corners of free polygons");
}

/* Append one face at place `to`. */
static void put_face(free_faces *f, int64_t to, int64_t e, int32_t wall, const double *area_vector,
                     const double *centroid, const int32_t *polygon, int64_t n_polygon)
{
    f->element[to] = (int32_t)e;
    f->wall[to] = wall;
    memcpy(f->area_vector + 3 * to, area_vector, 3 * sizeof(double));
    memcpy(f->centroid + 3 * to, centroid, 3 * sizeof(double));
    memcpy(f->polygon + f->polygon_start[to], polygon, (size_t)n_polygon * sizeof *polygon);
    f->polygon_start[to + 1] = f->polygon_start[to] + n_polygon;
}

static void merge_faces(const brc_domain *d, const opened *o, const int32_t *wall, free_faces *f)
{
    int64_t to = 0, k = 0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        for (int64_t a = d->free_start[e]; a < d->free_start[e + 1]; ++a, ++to)
            put_face(f, to, e, d->free_wall[a], d->free_area_vector + 3 * a, d->free_centroid + 3 * a,
                     d->free_polygon + d->free_polygon_start[a],
                     d->free_polygon_start[a + 1] - d->free_polygon_start[a]);
        for (; k < o->n && o->half_edge[k] < d->row_start[e + 1]; ++k, ++to) {
            put_face(f, to, e, wall[d->bond[o->half_edge[k]]], o->face + 6 * k, o->face + 6 * k + 3,
                     o->polygon + o->polygon_start[k], o->polygon_start[k + 1] - o->polygon_start[k]);
        }
        f->start[e + 1] = to;
    }
}

static void free_arrays(free_faces *f)
{
    void *const block[] = {f->start, f->element, f->wall, f->area_vector, f->centroid, f->polygon_start, f->polygon};
    for (size_t k = 0; k < sizeof block / sizeof *block; ++k)
        brc_memory_free(block[k]);
}

/* Give the domain the new arrays; f holds the old ones afterwards. */
static void exchange(brc_domain *d, free_faces *f, int64_t n)
{
    const free_faces old = {.start = d->free_start,
                            .element = d->free_element,
                            .wall = d->free_wall,
                            .area_vector = d->free_area_vector,
                            .centroid = d->free_centroid,
                            .polygon_start = d->free_polygon_start,
                            .polygon = d->free_polygon};
    d->free_start = f->start;
    d->free_element = f->element;
    d->free_wall = f->wall;
    d->free_area_vector = f->area_vector;
    d->free_centroid = f->centroid;
    d->free_polygon_start = f->polygon_start;
    d->free_polygon = f->polygon;
    d->n_free_faces = n;
    *f = old;
}

/* Close the gaps in the half-edges. place: [n_half_edges] new index of every half-edge that stays. */
static void remove_bonds(const int32_t *wall, int32_t *place, brc_domain *d)
{
    int32_t to = 0, b = 0;
    for (int64_t h = 0; h < d->n_half_edges; ++h)
        if (wall[d->bond[h]] < 0) place[h] = to++;
    int64_t h = 0;
    to = 0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const int64_t end = d->row_start[e + 1]; /* h is the old start of the row */
        for (; h < end; ++h) {
            if (wall[d->bond[h]] >= 0) continue;
            d->neighbour[to] = d->neighbour[h];
            d->twin[to] = place[d->twin[h]];
            if (d->area_vector && brc_domain_has(d, e)) {
                memmove(d->area_vector + 3 * (int64_t)to, d->area_vector + 3 * h, 3 * sizeof(double));
                memmove(d->face_centroid + 3 * (int64_t)to, d->face_centroid + 3 * h, 3 * sizeof(double));
            }
            ++to;
        }
        d->row_start[e + 1] = to;
    }
    d->n_half_edges = to;
    d->n_bonds = to / 2;
    for (int64_t e = 0; e < d->n_elements; ++e)
        for (h = d->row_start[e]; h < d->row_start[e + 1]; ++h)
            if (d->neighbour[h] > e) {
                d->bond_half_edge[b] = (int32_t)h;
                d->bond[h] = d->bond[d->twin[h]] = b++;
            }
}

brc_status brc_crack_faces_open(brc_context *context, const int32_t *wall, brc_domain *domain)
{
    opened o = {.n = 0};
    free_faces faces = {.start = NULL};
    int32_t *place = NULL;
    brc_status status = BRC_ALLOCATE(context, &place, domain->n_half_edges, "places of half-edges");
    if (status != BRC_OK) goto cleanup;
    if (domain->element_kind == BRC_ELEMENT_CELL) {
        BRC_TRY_OR(cleanup, find_opened(context, wall, domain, &o));
        BRC_TRY_OR(cleanup, allocate_faces(context, domain, &o, &faces));
        merge_faces(domain, &o, wall, &faces);
        exchange(domain, &faces, domain->n_free_faces + o.n);
    }
    remove_bonds(wall, place, domain);
cleanup:
    brc_memory_free(place);
    brc_memory_free(o.half_edge);
    brc_memory_free(o.face);
    brc_memory_free(o.polygon_start);
    brc_memory_free(o.polygon);
    brc_memory_free(o.room);
    free_arrays(&faces);
    return status;
}
