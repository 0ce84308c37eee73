/* Bodies side by side in one domain: every index of a part is shifted by what came before it. */
#include "../../host/base/memory.h"
#include "../cells/cells_ranks.h"
#include "build.h"
#include "domain_rows.h"
#include "overlap.h"
#include "quality.h"
#include "sets.h"

#include <math.h>
#include <omp.h>
#include <string.h>

/* Where the arrays of a part begin in the joined domain. */
typedef struct offsets {
    int64_t elements, half_edges, bonds, free_faces, vertices, polygon, grains;
} offsets;

static bool cells(const brc_domain *d)
{
    return d->element_kind == BRC_ELEMENT_CELL;
}

/* Number of grains: they are numbered from 0 without gaps. */
static int64_t n_grains(const brc_domain *d)
{
    int64_t n = 0;
    for (int64_t e = 0; d->grain && e < d->n_elements; ++e)
        if (d->grain[e] >= n) n = (int64_t)d->grain[e] + 1;
    return n;
}

static offsets after(offsets at, const brc_domain *d)
{
    at.elements += d->n_elements;
    at.half_edges += d->n_half_edges;
    at.bonds += d->n_bonds;
    at.free_faces += d->n_free_faces;
    /* a body without grains among others with them is one grain */
    at.grains += d->grain ? n_grains(d) : 1;
    if (!cells(d)) return at;
    at.vertices += d->vertex_start[d->n_elements];
    at.polygon += d->free_polygon_start[d->n_free_faces];
    return at;
}

/* What only cells have of which all ranks have all. */
static brc_status allocate_faces(brc_context *context, offsets total, brc_domain *d)
{
    const int64_t n = total.elements, f = total.free_faces;
    BRC_TRY(BRC_ALLOCATE(context, &d->free_start, n + 1, "rows of free faces"));
    BRC_TRY(BRC_ALLOCATE(context, &d->free_element, f, "elements of free faces"));
    BRC_TRY(BRC_ALLOCATE(context, &d->free_area_vector, 3 * f, "free area vectors"));
    BRC_TRY(BRC_ALLOCATE(context, &d->free_centroid, 3 * f, "free face centroids"));
    BRC_TRY(BRC_ALLOCATE(context, &d->free_wall, f, "walls of free faces"));
    BRC_TRY(BRC_ALLOCATE(context, &d->vertex_start, n + 1, "rows of corners"));
    BRC_TRY(BRC_ALLOCATE(context, &d->free_polygon_start, f + 1, "free polygons"));
    return BRC_ALLOCATE(context, &d->free_polygon, total.polygon, "corners of free polygons");
}

/* Of which they may have parts: by brc_domain_settle then. */
static brc_status allocate_parts(brc_context *context, offsets total, brc_domain *d)
{
    BRC_TRY(BRC_ALLOCATE(context, &d->centroid, 3 * total.elements, "centroids"));
    BRC_TRY(BRC_ALLOCATE(context, &d->inertia, 6 * total.elements, "inertia"));
    if (!cells(d)) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(context, &d->area_vector, 3 * total.half_edges, "area vectors"));
    BRC_TRY(BRC_ALLOCATE(context, &d->face_centroid, 3 * total.half_edges, "face centroids"));
    return BRC_ALLOCATE(context, &d->vertex, 3 * total.vertices, "cell corners");
}

static brc_status allocate(brc_context *context, offsets total, bool grains, brc_domain *d)
{
    const int64_t n = total.elements, h = total.half_edges;
    if (n > INT32_MAX || h > INT32_MAX || total.free_faces > INT32_MAX || total.vertices > INT32_MAX)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "joined domain: %lld elements, %lld half-edges, %lld free faces, %lld corners, each must be "
                        "below 2^31; use "
                        "fewer elements",
                        (long long)n, (long long)h, (long long)total.free_faces, (long long)total.vertices);
    d->n_elements = n;
    d->n_half_edges = h;
    d->n_bonds = total.bonds;
    d->n_free_faces = total.free_faces;
    BRC_TRY(BRC_ALLOCATE(context, &d->position, 3 * n, "positions"));
    BRC_TRY(BRC_ALLOCATE(context, &d->volume, n, "volumes"));
    BRC_TRY(BRC_ALLOCATE(context, &d->region, n, "regions"));
    BRC_TRY(BRC_ALLOCATE(context, &d->body, n, "bodies"));
    BRC_TRY(BRC_ALLOCATE(context, &d->row_start, n + 1, "rows of half-edges"));
    BRC_TRY(BRC_ALLOCATE(context, &d->neighbour, h, "neighbours"));
    BRC_TRY(BRC_ALLOCATE(context, &d->twin, h, "twins"));
    BRC_TRY(BRC_ALLOCATE(context, &d->bond, h, "bonds of half-edges"));
    BRC_TRY(BRC_ALLOCATE(context, &d->bond_half_edge, total.bonds, "half-edges of bonds"));
    if (grains) BRC_TRY(BRC_ALLOCATE(context, &d->grain, n, "grains"));
    if (cells(d)) return allocate_faces(context, total, d);
    return BRC_ALLOCATE(context, &d->radius, n, "radii");
}

static void copy(double *to, const double *from, int64_t n)
{
    memcpy(to, from, (size_t)n * sizeof *to);
}

static void copy_shifted(int32_t *to, const int32_t *from, int64_t n, int64_t shift)
{
    for (int64_t k = 0; k < n; ++k)
        to[k] = (int32_t)(from[k] + shift);
}

/* Rows of one part: n + 1 starts, the last of which the next part overwrites with the same value. */
static void copy_rows(int64_t *to, const int64_t *from, int64_t n, int64_t shift)
{
    for (int64_t k = 0; k <= n; ++k)
        to[k] = from[k] + shift;
}

static void copy_part(const brc_domain *p, offsets at, const int32_t *wall, brc_domain *d)
{
    const int64_t n = p->n_elements, h = p->n_half_edges, f = p->n_free_faces;
    copy(d->position + 3 * at.elements, p->position, 3 * n);
    copy(d->volume + at.elements, p->volume, n);
    copy_shifted(d->region + at.elements, p->region, n, 0);
    copy_shifted(d->body + at.elements, p->body, n, 0);
    copy_rows(d->row_start + at.elements, p->row_start, n, at.half_edges);
    copy_shifted(d->neighbour + at.half_edges, p->neighbour, h, at.elements);
    copy_shifted(d->twin + at.half_edges, p->twin, h, at.half_edges);
    copy_shifted(d->bond + at.half_edges, p->bond, h, at.bonds);
    copy_shifted(d->bond_half_edge + at.bonds, p->bond_half_edge, p->n_bonds, at.half_edges);
    for (int64_t e = 0; d->grain && e < n; ++e)
        d->grain[at.elements + e] = (int32_t)(at.grains + (p->grain ? p->grain[e] : 0));
    if (!cells(p)) {
        copy(d->radius + at.elements, p->radius, n);
        return;
    }
    copy_rows(d->free_start + at.elements, p->free_start, n, at.free_faces);
    copy_shifted(d->free_element + at.free_faces, p->free_element, f, at.elements);
    copy(d->free_area_vector + 3 * at.free_faces, p->free_area_vector, 3 * f);
    copy(d->free_centroid + 3 * at.free_faces, p->free_centroid, 3 * f);
    for (int64_t k = 0; k < f; ++k)
        d->free_wall[at.free_faces + k] = wall[p->free_wall[k]];
    copy_rows(d->vertex_start + at.elements, p->vertex_start, n, at.vertices);
    copy_rows(d->free_polygon_start + at.free_faces, p->free_polygon_start, f, at.polygon);
    copy_shifted(d->free_polygon + at.polygon, p->free_polygon, p->free_polygon_start[f], at.vertices);
}

static brc_status copy_whole(brc_context *context, int32_t n, const brc_domain *const *parts, offsets total,
                             brc_domain *d)
{
    offsets at = {0};
    BRC_TRY(allocate_parts(context, total, d));
    for (int32_t k = 0; k < n; at = after(at, parts[k++])) {
        const brc_domain *p = parts[k];
        copy(d->centroid + 3 * at.elements, p->centroid, 3 * p->n_elements);
        copy(d->inertia + 6 * at.elements, p->inertia, 6 * p->n_elements);
        if (!cells(p)) continue;
        copy(d->area_vector + 3 * at.half_edges, p->area_vector, 3 * p->n_half_edges);
        copy(d->face_centroid + 3 * at.half_edges, p->face_centroid, 3 * p->n_half_edges);
        copy(d->vertex + 3 * at.vertices, p->vertex, 3 * p->vertex_start[p->n_elements]);
    }
    return BRC_OK;
}

/* Ranks have the cells between them. */
static brc_status copy_apart(brc_context *context, int32_t n, const brc_domain *const *parts, offsets total,
                             brc_domain *d)
{
    offsets at = {0};
    BRC_TRY(brc_domain_make_room(context, d));
    BRC_TRY(brc_cells_mark_apart(context, d));
    BRC_TRY(BRC_ALLOCATE(context, &d->free_corner, 3 * total.polygon, "corners of free faces"));
    for (int32_t k = 0; k < n; at = after(at, parts[k++])) {
        BRC_TRY(brc_domain_settle(context, parts[k], at.elements, d));
        for (int64_t p = 0; p < parts[k]->free_polygon_start[parts[k]->n_free_faces]; ++p)
            copy(d->free_corner + 3 * (at.polygon + p), brc_domain_free_corner(parts[k], p), 3);
    }
    return BRC_OK;
}

/* Index of the wall in the joined domain, which has room for it. */
static brc_status join_wall(brc_context *context, const char *name, brc_domain *d, int32_t *out)
{
    for (int32_t w = 0; w < d->n_walls; ++w)
        if (strcmp(d->wall_name[w], name) == 0) {
            *out = w;
            return BRC_OK;
        }
    *out = d->n_walls;
    return brc_domain_add_wall(context, d, name);
}

/* Append the members of one part's set, shifted, to the joined set of the same name, made at its first part. */
static brc_status join_set(brc_context *context, const brc_set *set, offsets at, brc_domain *d)
{
    const int32_t known = brc_domain_find_set(d, set->name);
    brc_set *to;
    int64_t before = 0;
    if (known < 0) {
        BRC_TRY(brc_sets_append(context, d, set->name, set->kind, set->n_members, &to));
    } else {
        to = &d->sets[known];
        if (to->kind != set->kind)
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "set '%s' holds faces in one body and elements in another; rename one of them", set->name);
        before = to->n_members;
        BRC_TRY(brc_memory_resize(context, (void **)&to->members, before + set->n_members, sizeof *to->members,
                                  "set members"));
        to->n_members = before + set->n_members;
    }
    copy_shifted(to->members + before, set->members, set->n_members,
                 set->kind == BRC_SET_FACES ? at.free_faces : at.elements);
    return BRC_OK;
}

static void join_quality(const brc_domain *part, brc_quality *q)
{
    const brc_quality *p = &part->quality;
    q->n_seeds_requested += p->n_seeds_requested;
    q->n_seeds_duplicate += p->n_seeds_duplicate;
    q->n_seeds_lost += p->n_seeds_lost;
    q->n_tiny_faces_dropped += p->n_tiny_faces_dropped;
    q->tiny_face_threshold = fmax(q->tiny_face_threshold, p->tiny_face_threshold);
    /* by number of bonds, as the total face area is not kept */
    q->tiny_face_area_fraction += p->tiny_face_area_fraction * (double)part->n_bonds;
    q->volume_shape += p->volume_shape;
    q->twin_area_worst = fmax(q->twin_area_worst, p->twin_area_worst);
    q->growth = fmax(q->growth, p->growth);
}

static brc_status check_kinds(brc_context *context, int32_t n, const brc_domain *const *parts, const char *const *name)
{
    char words[2][BRC_OVERLAP_NAME];
    for (int32_t k = 1; k < n; ++k)
        if (parts[k]->element_kind != parts[0]->element_kind)
            return BRC_FAIL(
                context, BRC_BAD_INPUT,
                "body %s is made of %s, body %s of %s, which one domain cannot hold; give `beams` to all bodies "
                "or to none, or each kind a `model` of its own",
                brc_overlap_name(name, 0, words[0]), cells(parts[0]) ? "cells" : "spheres",
                brc_overlap_name(name, k, words[1]), cells(parts[k]) ? "cells" : "spheres");
    return BRC_OK;
}

static brc_status describe(brc_context *context, int32_t n, const brc_domain *const *parts, brc_domain *d)
{
    int64_t room = 1;
    for (int32_t k = 0; k < n; ++k)
        room += (int64_t)strlen(parts[k]->provenance) + 3;
    BRC_TRY(BRC_ALLOCATE(context, &d->provenance, room, "provenance"));
    for (int32_t k = 0; k < n; ++k) {
        if (k > 0) strcat(d->provenance, " | ");
        strcat(d->provenance, parts[k]->provenance);
    }
    return BRC_OK;
}

brc_status brc_domain_join(brc_context *context, int32_t n, const brc_domain *const *parts, const char *const *name,
                           brc_together together, brc_domain **out)
{
    *out = NULL;
    if (n < 1) return BRC_FAIL(context, BRC_BAD_INPUT, "joining %d bodies, there must be at least one", n);
    brc_domain *d = NULL;
    int32_t *wall = NULL;
    offsets total = {0};
    bool grains = false;
    BRC_TRY(check_kinds(context, n, parts, name));
    BRC_TRY(brc_overlap_check(context, n, parts, name));
    int64_t n_walls = 0, n_sets = 0, most_walls = 0;
    for (int32_t k = 0; k < n; ++k) {
        total = after(total, parts[k]);
        n_walls += parts[k]->n_walls;
        n_sets += parts[k]->n_sets;
        grains = grains || parts[k]->grain;
        if (parts[k]->n_walls > most_walls) most_walls = parts[k]->n_walls;
    }
    brc_status status = BRC_ALLOCATE(context, &d, 1, "joined domain");
    if (status != BRC_OK) goto cleanup;
    d->element_kind = parts[0]->element_kind;
    BRC_TRY_OR(cleanup, allocate(context, total, grains, d));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &d->wall_name, n_walls, "wall names"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &d->sets, n_sets, "sets"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &wall, most_walls, "walls of a body"));
    offsets at = {0};
    for (int c = 0; c < 3; ++c) {
        d->bounds[0][c] = HUGE_VAL;
        d->bounds[1][c] = -HUGE_VAL;
    }
    for (int32_t k = 0; k < n; ++k) {
        const brc_domain *p = parts[k];
        for (int32_t w = 0; w < p->n_walls; ++w)
            BRC_TRY_OR(cleanup, join_wall(context, p->wall_name[w], d, &wall[w]));
        copy_part(p, at, wall, d);
        for (int32_t s = 0; s < p->n_sets; ++s)
            BRC_TRY_OR(cleanup, join_set(context, &p->sets[s], at, d));
        join_quality(p, &d->quality);
        for (int c = 0; c < 3; ++c) {
            d->bounds[0][c] = fmin(d->bounds[0][c], p->bounds[0][c]);
            d->bounds[1][c] = fmax(d->bounds[1][c], p->bounds[1][c]);
        }
        at = after(at, p);
    }
    BRC_TRY_OR(cleanup, (together == BRC_APART && cells(d) ? copy_apart : copy_whole)(context, n, parts, total, d));
    if (d->n_bonds > 0) d->quality.tiny_face_area_fraction /= (double)d->n_bonds;
    brc_quality_measure(d, omp_get_max_threads());
    BRC_TRY_OR(cleanup, brc_quality_agree(context, d));
    BRC_TRY_OR(cleanup, describe(context, n, parts, d));
    *out = d;
    d = NULL;
cleanup:
    brc_memory_free(wall);
    brc_domain_free(&d);
    return status;
}
