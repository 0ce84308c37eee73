/* Every cell is closed: each edge is gone along once in both directions. Edges that a cell's faces go along once only,
 * because a face was dropped when the domain was built or its corners do not outline it, are made into the faces that
 * are missing. Then corners are joined across the faces of whole bonds. */
#include "tessellation.h"

#include "../../host/base/memory.h"
#include "order.h"
#include "outline.h"

#include <math.h>
#include <omp.h>
#include <string.h>

enum { BLOCK = 4096 }; /* cells outlined between two looks at the room for all */

/* What a thread needs to outline a cell. */
typedef struct worker {
    brc_outline_corner *room; /* [2 most] */
    int32_t *out;             /* [most] */
    int32_t *same;            /* [most] corner that stands for each of the cell's */
    int8_t *balance;          /* [most][most] how often an edge is gone along, less the times it is gone back */
    int64_t most;
} worker;

/* Faces of a cell as they are found: for each the number of its corners, then these, counted within the cell. */
typedef struct found {
    int32_t *stream;
    int64_t room, length, n_faces, n_corners;
} found;

static double near_square(const brc_domain *d, int64_t e)
{
    const double near = BRC_TESSELLATION_NEAR * cbrt(d->volume[e]);
    return near * near;
}

static double distance_square(const brc_domain *d, int64_t v, int64_t w)
{
    const double *x = d->vertex + 3 * v, *y = d->vertex + 3 * w;
    return (x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1]) + (x[2] - y[2]) * (x[2] - y[2]);
}

/* A polygon without the corners that repeat the one before. Returns their number, 0 where fewer than three are left. */
static int64_t without_repeats(int64_t n, int32_t *corner)
{
    int64_t kept = 0;
    for (int64_t k = 0; k < n; ++k)
        if (corner[k] != corner[(k + n - 1) % n]) corner[kept++] = corner[k];
    return kept < 3 ? 0 : kept;
}

static void add_face(found *f, int64_t n, const int32_t *corner)
{
    if (f->length + n + 1 > f->room) n = 0;
    if (f->length + n + 1 > f->room) return;
    f->stream[f->length++] = (int32_t)n;
    memcpy(f->stream + f->length, corner, (size_t)n * sizeof *corner);
    f->length += n;
    f->n_corners += n;
    ++f->n_faces;
}

/* The polygon in w->out, in indices into domain->vertex. */
static void take_face(const brc_domain *d, int64_t e, worker *w, int64_t n, found *f)
{
    const int64_t n_corners = d->vertex_start[e + 1] - d->vertex_start[e];
    for (int64_t k = 0; k < n; ++k)
        w->out[k] = w->same[w->out[k] - d->vertex_start[e]];
    n = without_repeats(n, w->out);
    add_face(f, n, w->out);
    for (int64_t k = 0; k < n; ++k) {
        const int32_t a = w->out[k], b = w->out[(k + 1) % n];
        ++w->balance[a * n_corners + b];
        --w->balance[b * n_corners + a];
    }
}

/* The faces that are missing, from edges that are gone along in one direction only. As many of these end in a corner as
 * begin there, so every way along them comes back. */
static void close_cell(int64_t n_corners, worker *w, found *f)
{
    for (int64_t begin = 0; begin < n_corners; ++begin)
        for (int64_t other = 0; other < n_corners; ++other)
            while (w->balance[other * n_corners + begin] > 0) {
                int64_t n = 0, at = begin;
                do {
                    int64_t next = 0;
                    while (next < n_corners && w->balance[next * n_corners + at] <= 0)
                        ++next;
                    if (next == n_corners || n == w->most) return;
                    --w->balance[next * n_corners + at];
                    ++w->balance[at * n_corners + next];
                    w->out[n++] = (int32_t)at;
                    at = next;
                } while (at != begin);
                add_face(f, n, w->out);
            }
}

static void outline_cell(const brc_domain *d, int64_t e, worker *w, found *f)
{
    const int64_t first = d->vertex_start[e], n = d->vertex_start[e + 1] - first;
    const double near = near_square(d, e);
    for (int64_t k = 0; k < n; ++k) {
        int64_t m = 0;
        while (m < k && (w->same[m] != m || distance_square(d, first + m, first + k) > near))
            ++m;
        w->same[k] = (int32_t)m;
    }
    memset(w->balance, 0, (size_t)(n * n));
    f->length = f->n_faces = f->n_corners = 0;
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h)
        take_face(d, e, w, brc_outline(d, e, h, w->room, w->out), f);
    for (int64_t face = d->free_start[e]; face < d->free_start[e + 1]; ++face) {
        const int64_t corners = d->free_polygon_start[face + 1] - d->free_polygon_start[face];
        memcpy(w->out, d->free_polygon + d->free_polygon_start[face], (size_t)corners * sizeof *w->out);
        take_face(d, e, w, corners, f);
    }
    close_cell(n, w, f);
}

/* Room for the faces of a cell: a closed one has at most 6 n - 12 corners of faces and 2 n - 4 faces; and those that
 * are of no use. */
static int64_t room_for(const brc_domain *d, int64_t e)
{
    return 9 * (d->vertex_start[e + 1] - d->vertex_start[e]) + d->row_start[e + 1] - d->row_start[e] +
           d->free_start[e + 1] - d->free_start[e];
}

static int64_t most_corners(const brc_domain *d)
{
    int64_t most = 0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        most = d->vertex_start[e + 1] - d->vertex_start[e] > most ? d->vertex_start[e + 1] - d->vertex_start[e] : most;
    return most;
}

static void free_workers(int n, worker *w)
{
    for (int k = 0; w && k < n; ++k) {
        void *const block[] = {w[k].room, w[k].out, w[k].same, w[k].balance};
        for (size_t m = 0; m < sizeof block / sizeof *block; ++m)
            brc_memory_free(block[m]);
    }
    brc_memory_free(w);
}

static brc_status make_workers(brc_context *context, int n, int64_t most, worker **out)
{
    BRC_TRY(BRC_ALLOCATE(context, out, n, "outlines"));
    for (int k = 0; k < n; ++k) {
        worker *w = *out + k;
        w->most = most;
        BRC_TRY(BRC_ALLOCATE(context, &w->room, 2 * most, "corners of a cell"));
        BRC_TRY(BRC_ALLOCATE(context, &w->out, most, "corners of a face"));
        BRC_TRY(BRC_ALLOCATE(context, &w->same, most, "corners of a cell"));
        BRC_TRY(BRC_ALLOCATE(context, &w->balance, most * most, "edges of a cell"));
    }
    return BRC_OK;
}

/* Append the faces of n cells from element `first` on; *room: of corner_start and of corner, which grow. */
static brc_status append(brc_context *context, const found *f, int64_t first, int64_t n, int64_t room[2],
                         brc_tessellation *t)
{
    int64_t faces = t->outline_start[first], corners = 0;
    for (int64_t k = 0; k < n; ++k)
        t->outline_start[first + k + 1] = t->outline_start[first + k] + f[k].n_faces;
    for (int64_t k = 0; k < n; ++k)
        corners += f[k].n_corners;
    const int64_t need[2] = {t->outline_start[first + n] + 1, t->corner_start[faces] + corners};
    for (int k = 0; k < 2; ++k) {
        if (need[k] <= room[k]) continue;
        room[k] = need[k] + need[k] / 4;
        void **block = k == 0 ? (void **)&t->corner_start : (void **)&t->corner;
        BRC_TRY(brc_memory_resize(context, block, room[k], k == 0 ? sizeof *t->corner_start : sizeof *t->corner,
                                  "faces of cells"));
    }
    for (int64_t k = 0; k < n; ++k)
        for (int64_t at = 0; at < f[k].length; at += f[k].stream[at] + 1, ++faces) {
            const int64_t to = t->corner_start[faces], m = f[k].stream[at];
            for (int64_t c = 0; c < m; ++c)
                t->corner[to + c] = (int32_t)(t->domain->vertex_start[first + k] + f[k].stream[at + 1 + c]);
            t->corner_start[faces + 1] = to + m;
        }
    return BRC_OK;
}

static brc_status outline_all(brc_context *context, int n_threads, brc_tessellation *t)
{
    const brc_domain *d = t->domain;
    worker *workers = NULL;
    found *f = NULL;
    int32_t *stream = NULL;
    int64_t stream_room = 0, room[2] = {1, 0};
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &t->outline_start, d->n_elements + 1, "faces of cells"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &t->corner_start, room[0], "faces of cells"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &f, BLOCK, "faces of cells"));
    BRC_TRY_OR(cleanup, make_workers(context, n_threads, most_corners(d), &workers));
    for (int64_t first = 0; first < d->n_elements; first += BLOCK) {
        const int64_t n = d->n_elements - first < BLOCK ? d->n_elements - first : BLOCK;
        int64_t length = 0;
        for (int64_t k = 0; k < n; ++k)
            length += room_for(d, first + k);
        if (length > stream_room) {
            brc_memory_free(stream);
            stream = NULL;
            BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &stream, length, "faces of cells"));
            stream_room = length;
        }
        length = 0;
        for (int64_t k = 0; k < n; length += f[k++].room)
            f[k] = (found){.stream = stream + length, .room = room_for(d, first + k)};
#pragma omp parallel for schedule(dynamic, 32) num_threads(n_threads)
        for (int64_t k = 0; k < n; ++k)
            outline_cell(d, first + k, workers + omp_get_thread_num(), f + k);
        BRC_TRY_OR(cleanup, append(context, f, first, n, room, t));
    }
cleanup:
    free_workers(n_threads, workers);
    brc_memory_free(f);
    brc_memory_free(stream);
    return status;
}

/* ---- corners of neighbours that are one ---- */

/* A face from one of its sides. */
typedef struct side {
    int64_t n;
    const int32_t *corner;
} side;

static side side_of(const brc_tessellation *t, int64_t h)
{
    const brc_domain *d = t->domain;
    const int64_t e = d->neighbour[d->twin[h]], f = t->outline_start[e] + h - d->row_start[e],
                  first = t->corner_start[f];
    return (side){t->corner_start[f + 1] - first, t->corner + first};
}

/* The corner of a side nearest to corner v; -1: none is near enough. */
static int64_t nearest(const brc_domain *d, int32_t v, const side *s, double near)
{
    int64_t best = -1;
    for (int64_t k = 0; k < s->n; ++k) {
        const double square = distance_square(d, v, s->corner[k]);
        if (square > near) continue;
        near = square;
        best = k;
    }
    return best;
}

static int8_t turn_of(const brc_tessellation *t, int64_t b)
{
    const brc_domain *d = t->domain;
    const int64_t h = d->bond_half_edge[b];
    const side one = side_of(t, h), other = side_of(t, d->twin[h]);
    const double near = near_square(d, d->neighbour[d->twin[h]]);
    if (one.n != other.n || one.n == 0 || one.n > INT8_MAX) return -1;
    const int64_t turn = nearest(d, one.corner[0], &other, near);
    for (int64_t k = 0; turn >= 0 && k < one.n; ++k)
        if (distance_square(d, one.corner[k], other.corner[(turn - k + one.n) % one.n]) > near) return -1;
    return (int8_t)turn;
}

brc_status brc_tessellation_create(brc_context *context, const brc_domain *domain, int n_threads, brc_tessellation *out)
{
    const int threads = n_threads > 0 ? n_threads : omp_get_max_threads();
    brc_tessellation t = {.domain = domain};
    brc_status status = BRC_OK;
    *out = t;
    if (domain->element_kind != BRC_ELEMENT_CELL) return BRC_OK;
    BRC_TRY_OR(cleanup, outline_all(context, threads, &t));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &t.turn, domain->n_bonds, "faces of cells"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &t.order, domain->n_elements, "points of cells"));
    BRC_TRY_OR(cleanup,
               brc_order_hilbert(context, domain->position, domain->n_elements, domain->bounds, threads, t.order));
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int64_t b = 0; b < domain->n_bonds; ++b)
        t.turn[b] = turn_of(&t, b);
    *out = t;
    return BRC_OK;
cleanup:
    brc_tessellation_free(&t);
    return status;
}

/* The first of the corners that are one with v, with halved paths. */
static int32_t root_of(int32_t *parent, int32_t v)
{
    while (parent[v] != v)
        v = parent[v] = parent[parent[v]];
    return v;
}

static void unite(int32_t *parent, int32_t v, int32_t w)
{
    const int32_t a = root_of(parent, v), b = root_of(parent, w);
    if (a < b)
        parent[b] = a;
    else
        parent[a] = b;
}

/* Join the corners of all whole faces: parent[v] of corners, -1 of those that no face has. */
static void unite_all(const brc_tessellation *t, const uint8_t *whole, int32_t *parent)
{
    const brc_domain *d = t->domain;
    memset(parent, -1, (size_t)d->vertex_start[d->n_elements] * sizeof *parent);
    for (int64_t k = 0; k < t->corner_start[t->outline_start[d->n_elements]]; ++k)
        parent[t->corner[k]] = t->corner[k];
    for (int64_t b = 0; b < d->n_bonds; ++b) {
        const int64_t h = d->bond_half_edge[b];
        if (whole && !whole[h]) continue;
        const side one = side_of(t, h), other = side_of(t, d->twin[h]);
        const double near = near_square(d, d->neighbour[d->twin[h]]);
        for (int64_t k = 0; k < one.n; ++k) {
            const int64_t m =
                t->turn[b] >= 0 ? (t->turn[b] - k + one.n) % one.n : nearest(d, one.corner[k], &other, near);
            if (m >= 0) unite(parent, one.corner[k], other.corner[m]);
        }
    }
}

/* Points along the curve, each numbered by the first of its corners there. parent: as unite_all leaves it. Returns how
 * many corners are of some face. */
static int64_t number_points(int32_t *parent, brc_tessellation *t)
{
    const brc_domain *d = t->domain;
    int64_t n_used = 0;
    t->n_points = 0;
    for (int64_t v = 0; v < d->vertex_start[d->n_elements]; ++v)
        t->point[v] = -1;
    for (int64_t k = 0; k < d->n_elements; ++k)
        for (int64_t v = d->vertex_start[t->order[k]]; v < d->vertex_start[t->order[k] + 1]; ++v) {
            if (parent[v] < 0) continue;
            const int32_t root = root_of(parent, (int32_t)v);
            if (t->point[root] < 0) t->point[root] = (int32_t)t->n_points++;
            t->point[v] = t->point[root];
            ++n_used;
        }
    return n_used;
}

brc_status brc_tessellation_join(brc_context *context, const uint8_t *whole, int n_threads, brc_tessellation *t)
{
    const brc_domain *d = t->domain;
    const int threads = n_threads > 0 ? n_threads : omp_get_max_threads();
    const int64_t n = d->n_elements, n_corners = d->vertex_start[n];
    int64_t **const start[] = {&t->point_start, &t->face_start, &t->loop_start};
    int32_t *parent = NULL, *room = NULL;
    brc_status status = BRC_OK;
    const int64_t most = 3 * most_corners(d), rooms = 13 * most; /* as room_for, of each thread */
    if (!t->point) BRC_TRY(BRC_ALLOCATE(context, &t->point, n_corners, "points of cells"));
    for (int k = 0; k < 3; ++k)
        if (!*start[k]) BRC_TRY(BRC_ALLOCATE(context, start[k], n + 1, "points of cells"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &parent, n_corners, "points of cells"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &room, rooms * threads, "points of cells"));
    unite_all(t, whole, parent);
    const int64_t n_used = number_points(parent, t);
    BRC_TRY_OR(cleanup,
               brc_memory_resize(context, (void **)&t->first, t->n_points, sizeof *t->first, "points of cells"));
    for (int64_t v = n_corners - 1; v >= 0; --v)
        if (t->point[v] >= 0) t->first[t->point[v]] = (int32_t)v;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int64_t e = 0; e < n; ++e) {
        int32_t *mine = room + rooms * omp_get_thread_num();
        t->point_start[e + 1] = brc_tessellation_points(t, e, mine);
        const int64_t faces = brc_tessellation_faces(t, e, mine, mine + 4 * most);
        t->face_start[e + 1] = faces;
        t->loop_start[e + 1] = 0;
        for (int64_t f = 0; f < faces; ++f)
            t->loop_start[e + 1] += mine[f];
    }
    for (int k = 0; k < 3; ++k)
        for (int64_t e = 0; e < n; ++e)
            (*start[k])[e + 1] += (*start[k])[e];
    t->plain = t->point_start[n] == n_used && t->loop_start[n] == t->corner_start[t->outline_start[n]];
cleanup:
    brc_memory_free(parent);
    brc_memory_free(room);
    return status;
}

int64_t brc_tessellation_points(const brc_tessellation *t, int64_t e, int32_t *out)
{
    int64_t n = 0;
    for (int64_t v = t->domain->vertex_start[e]; v < t->domain->vertex_start[e + 1]; ++v) {
        int64_t k = 0;
        while (k < n && out[k] != t->point[v])
            ++k;
        if (k == n && t->point[v] >= 0) out[n++] = t->point[v];
    }
    return n;
}

int64_t brc_tessellation_faces(const brc_tessellation *t, int64_t e, int32_t *n_corners, int32_t *points)
{
    int64_t faces = 0, at = 0;
    for (int64_t f = t->outline_start[e]; f < t->outline_start[e + 1]; ++f) {
        const int64_t n = t->corner_start[f + 1] - t->corner_start[f];
        for (int64_t k = 0; k < n; ++k)
            points[at + k] = t->point[t->corner[t->corner_start[f] + k]];
        const int64_t kept = n > 0 ? without_repeats(n, points + at) : 0;
        if (kept == 0) continue;
        n_corners[faces++] = (int32_t)kept;
        at += kept;
    }
    return faces;
}

void brc_tessellation_most(const brc_tessellation *t, int64_t *points, int64_t *faces, int64_t *corners)
{
    int64_t *const out[] = {points, faces, corners}, *const start[] = {t->point_start, t->face_start, t->loop_start};
    for (int k = 0; k < 3; ++k) {
        *out[k] = 0;
        for (int64_t e = 0; e < t->domain->n_elements; ++e)
            if (start[k][e + 1] - start[k][e] > *out[k]) *out[k] = start[k][e + 1] - start[k][e];
    }
}

void brc_tessellation_free(brc_tessellation *t)
{
    void *const block[] = {t->outline_start, t->corner_start, t->corner,      t->turn,       t->order,
                           t->point,         t->first,        t->point_start, t->face_start, t->loop_start};
    for (size_t k = 0; k < sizeof block / sizeof *block; ++k)
        brc_memory_free(block[k]);
    *t = (brc_tessellation){.domain = NULL};
}
