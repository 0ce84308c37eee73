/* Points and polyhedra of a frame. Arrays of integers are long and go out a block at a time. */
#include "frame_cells.h"
#include "../h5_pack.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include "../../solver/effects/fracture/fracture.h"
#include <stdio.h>
#include <string.h>

enum { VERTEX = 1, POLYHEDRON = 42 }; /* VTK's cell types */

/* Rows of an array that go out at once. */
#define ROWS_AT_ONCE (8 * BRC_H5_BLOCK)

static int64_t at_once(int64_t rows)
{
    return rows < ROWS_AT_ONCE ? rows : ROWS_AT_ONCE;
}

bool brc_frame_is_sphere(const brc_domain *domain)
{
    return domain->element_kind == BRC_ELEMENT_SPHERE;
}

static int32_t count_parts_of_spheres(const brc_assembly *a)
{
    int32_t n = 0;
    for (int32_t k = 0; k < a->n; ++k)
        n += brc_frame_is_sphere(brc_simulation_domain(a->part[k]));
    return n;
}

bool brc_frame_has_spheres(const brc_assembly *assembly)
{
    return count_parts_of_spheres(assembly) > 0;
}
bool brc_frame_has_cells(const brc_assembly *assembly)
{
    return count_parts_of_spheres(assembly) < assembly->n;
}

brc_status brc_frame_cells_create(brc_context *context, const brc_assembly *assembly, int n_threads,
                                  brc_frame_cells *out)
{
    brc_status status = BRC_OK;
    *out = (brc_frame_cells){.context = context,
                             .assembly = assembly,
                             .n_threads = n_threads,
                             .elements_frame = -1,
                             .points_frame = -1,
                             .starts_frame = -1};
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->part, assembly->n, "cells of a frame"));
    for (int32_t k = 0; k < assembly->n; ++k) {
        const brc_domain *const domain = brc_simulation_domain(assembly->part[k]);
        out->part[k].domain = domain;
        if (brc_file_writes()) BRC_TRY_OR(cleanup, brc_tessellation_create(context, domain, n_threads, &out->part[k]));
    }
cleanup:
    if (status != BRC_OK) brc_frame_cells_free(out);
    return status;
}

void brc_frame_cells_free(brc_frame_cells *cells)
{
    for (int32_t k = 0; cells->part && k < cells->assembly->n; ++k)
        brc_tessellation_free(&cells->part[k]);
    brc_memory_free(cells->part);
    cells->part = NULL;
}

brc_status brc_frame_cells_store(brc_frame_cells *cells, brc_state_store *store)
{
    BRC_TRY(brc_store_integer(store, "frames.elements", &cells->elements_frame));
    BRC_TRY(brc_store_integer(store, "frames.points", &cells->points_frame));
    BRC_TRY(brc_store_integer(store, "frames.starts", &cells->starts_frame));
    return brc_store_integer(store, "frames.broken", &cells->n_broken);
}

static int64_t points_of(const brc_frame_cells *c, int32_t part)
{
    const brc_domain *d = brc_simulation_domain(c->assembly->part[part]);
    return brc_frame_is_sphere(d) ? d->n_elements : c->part[part].n_points;
}

static int64_t elements_of(const brc_frame_cells *c, int32_t part)
{
    return brc_simulation_domain(c->assembly->part[part])->n_elements;
}

static brc_frame_rows rows_of(const brc_frame_cells *c, int32_t part,
                              int64_t (*count)(const brc_frame_cells *, int32_t))
{
    brc_frame_rows rows = {.n = count(c, part)};
    for (int32_t k = 0; k < c->assembly->n; ++k) {
        if (k < part) rows.first += count(c, k);
        rows.all += count(c, k);
    }
    return rows;
}

brc_frame_rows brc_frame_element_rows(const brc_frame_cells *cells, int32_t part)
{
    return rows_of(cells, part, elements_of);
}
brc_frame_rows brc_frame_point_rows(const brc_frame_cells *cells, int32_t part)
{
    return rows_of(cells, part, points_of);
}

static brc_status join(brc_frame_cells *c)
{
    for (int32_t k = 0; k < c->assembly->n; ++k) {
        uint8_t *whole = NULL;
        if (brc_frame_is_sphere(c->part[k].domain)) continue;
        BRC_TRY(brc_simulation_whole(c->assembly->part[k], &whole));
        brc_status status = BRC_OK;
        if (brc_file_writes()) status = brc_tessellation_join(c->context, whole, c->n_threads, &c->part[k]);
        brc_memory_free(whole);
        BRC_TRY(status);
    }
    c->joined = true;
    return BRC_OK;
}

/* ---- columns that grow ---- */

/* From OFFSETS on: where points and faces begin. */
enum { CONNECTIVITY, FACE_CONNECTIVITY, OFFSETS, FACE_OFFSETS, TO_FACES, POLYHEDRON_OFFSETS, N_COLUMNS };
static const char *const COLUMN_NAME[N_COLUMNS] = {"VTKHDF/Connectivity",      "VTKHDF/FaceConnectivity",
                                                   "VTKHDF/Offsets",           "VTKHDF/FaceOffsets",
                                                   "VTKHDF/PolyhedronToFaces", "VTKHDF/PolyhedronOffsets"};

/* Spheres alone have no faces. */
static bool has_column(int k, bool cells)
{
    return cells || k == CONNECTIVITY || k == OFFSETS;
}

typedef struct column {
    int64_t written, n, room;
    int64_t *data; /* [room] */
} column;

/* All columns of the polyhedra of all parts. */
typedef struct table {
    brc_h5 *h5;
    int n_threads;
    bool kept[N_COLUMNS]; /* columns that the file gets */
    column column[N_COLUMNS];
    int64_t n_points, n_ids, n_faces, n_face_ids; /* so far */
    int32_t *count, *point;                       /* of a cell */
} table;

static void flush(table *t, int k)
{
    column *c = &t->column[k];
    brc_h5_pack_rows(t->h5, COLUMN_NAME[k], H5T_NATIVE_INT64, c->written, c->n, c->data, t->n_threads);
    c->written += c->n;
    c->n = 0;
}

static void push(table *t, int k, int64_t value)
{
    column *c = &t->column[k];
    if (!t->kept[k]) return;
    c->data[c->n++] = value;
    if (c->n == c->room) flush(t, k);
}

/* Offsets begin with 0: of no cell, of no face. */
static void push_starts(table *t)
{
    push(t, OFFSETS, 0);
    push(t, FACE_OFFSETS, 0);
    push(t, POLYHEDRON_OFFSETS, 0);
}

static void push_spheres(table *t, int64_t n)
{
    for (int64_t e = 0; e < n; ++e) {
        push(t, CONNECTIVITY, t->n_points + e);
        push(t, OFFSETS, ++t->n_ids);
        push(t, POLYHEDRON_OFFSETS, t->n_faces);
    }
    t->n_points += n;
}

static brc_status push_cells(brc_context *context, table *t, const brc_tessellation *cells)
{
    int64_t most_points, most_faces, most_corners;
    brc_tessellation_most(cells, &most_points, &most_faces, &most_corners);
    brc_memory_free(t->count);
    brc_memory_free(t->point);
    t->count = t->point = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &t->count, most_faces, "faces of a cell"));
    BRC_TRY(
        BRC_ALLOCATE(context, &t->point, most_points > most_corners ? most_points : most_corners, "points of a cell"));
    for (int64_t e = 0; e < cells->domain->n_elements; ++e) {
        const int64_t n_points = brc_tessellation_points(cells, e, t->point);
        for (int64_t k = 0; k < n_points; ++k)
            push(t, CONNECTIVITY, t->n_points + t->point[k]);
        push(t, OFFSETS, t->n_ids += n_points);
        const int64_t n_faces = brc_tessellation_faces(cells, e, t->count, t->point);
        for (int64_t f = 0, at = 0; f < n_faces; ++f) {
            push(t, TO_FACES, t->n_faces++);
            for (int32_t k = 0; k < t->count[f]; ++k)
                push(t, FACE_CONNECTIVITY, t->n_points + t->point[at++]);
            push(t, FACE_OFFSETS, t->n_face_ids += t->count[f]);
        }
        push(t, POLYHEDRON_OFFSETS, t->n_faces);
    }
    t->n_points += cells->n_points;
    return BRC_OK;
}

/* Datasets of one number: how long the others are. */
static const char *const COUNT_NAME[] = {"NumberOfPoints",
                                         "NumberOfCells",
                                         "NumberOfConnectivityIds",
                                         "NumberOfFaces",
                                         "NumberOfFaceConnectivityIds",
                                         "NumberOfPolyhedronToFaceIds"};
enum { N_COUNTS = sizeof COUNT_NAME / sizeof *COUNT_NAME, N_COUNTS_OF_SPHERES = 3 };

/* Make the columns, as long as they will be, and room for some of their rows. */
static brc_status make_columns(const brc_frame_cells *c, table *t)
{
    brc_h5 *h5 = t->h5;
    const bool cells = brc_frame_has_cells(c->assembly);
    const int64_t n_elements = brc_frame_element_rows(c, 0).all;
    int64_t ids = 0, faces = 0, face_ids = 0;
    for (int32_t k = 0; k < c->assembly->n; ++k) {
        const brc_tessellation *p = &c->part[k];
        const int64_t n = p->domain->n_elements;
        const bool spheres = brc_frame_is_sphere(p->domain);
        ids += spheres ? n : p->point_start[n];
        faces += spheres ? 0 : p->face_start[n];
        face_ids += spheres ? 0 : p->loop_start[n];
    }
    const int64_t rows[N_COLUMNS] = {ids, face_ids, n_elements + 1, faces + 1, faces, n_elements + 1};
    const int64_t count[N_COUNTS] = {brc_frame_point_rows(c, 0).all, n_elements, ids, faces, face_ids, faces};
    for (int k = 0; k < N_COLUMNS; ++k) {
        if (!t->kept[k]) continue;
        t->column[k].room = at_once(rows[k]);
        BRC_TRY(BRC_ALLOCATE(c->context, &t->column[k].data, t->column[k].room, "cells of a frame"));
        brc_h5_packed(h5, COLUMN_NAME[k], H5T_NATIVE_INT64, rows[k], 0);
    }
    for (int k = 0; k < (cells ? N_COUNTS : N_COUNTS_OF_SPHERES); ++k) {
        char path[64];
        snprintf(path, sizeof path, "VTKHDF/%s", COUNT_NAME[k]);
        brc_h5_dataset(h5, path, H5T_NATIVE_INT64, 1, 0, &count[k]);
    }
    return BRC_OK;
}

static void refer(brc_h5 *h5, const char *name, int64_t frame)
{
    char file[32], object[80];
    snprintf(file, sizeof file, "%06lld.vtkhdf", (long long)frame);
    snprintf(object, sizeof object, "/%s", name);
    brc_h5_external_link(h5, name, file, object);
}

/* starts_frame: that has where points and faces begin; -1: this one does. */
static brc_status write_polyhedra(const brc_frame_cells *c, brc_h5 *h5, int64_t starts_frame)
{
    const bool cells = brc_frame_has_cells(c->assembly);
    table t = {.h5 = h5, .n_threads = c->n_threads};
    brc_status status = BRC_OK;
    for (int k = 0; k < N_COLUMNS; ++k) {
        t.kept[k] = has_column(k, cells) && (k < OFFSETS || starts_frame < 0);
        if (has_column(k, cells) && !t.kept[k]) refer(h5, COLUMN_NAME[k], starts_frame);
    }
    BRC_TRY_OR(cleanup, make_columns(c, &t));
    push_starts(&t);
    for (int32_t k = 0; k < c->assembly->n; ++k)
        if (brc_frame_is_sphere(c->part[k].domain))
            push_spheres(&t, c->part[k].domain->n_elements);
        else
            BRC_TRY_OR(cleanup, push_cells(c->context, &t, &c->part[k]));
    for (int k = 0; k < N_COLUMNS; ++k)
        if (t.column[k].n > 0) flush(&t, k);
cleanup:
    for (int k = 0; k < N_COLUMNS; ++k)
        brc_memory_free(t.column[k].data);
    brc_memory_free(t.count);
    brc_memory_free(t.point);
    return status;
}

/* ---- places and what never changes ---- */

/* A point is where its first corner is. Where bonds broke several are in one place. */
static brc_status write_points(const brc_frame_cells *c, brc_h5 *h5)
{
    float *block = NULL;
    const int64_t room = at_once(brc_frame_point_rows(c, 0).all);
    int64_t n = 0, written = 0;
    BRC_TRY(BRC_ALLOCATE(c->context, &block, 3 * room, "points of a frame"));
    brc_h5_packed(h5, "VTKHDF/Points", H5T_NATIVE_FLOAT, brc_frame_point_rows(c, 0).all, 3);
    for (int32_t k = 0; k < c->assembly->n; ++k) {
        const brc_domain *d = c->part[k].domain;
        const bool spheres = brc_frame_is_sphere(d);
        const int64_t n_points = spheres ? d->n_elements : c->part[k].n_points;
        for (int64_t p = 0; p < n_points; ++p) {
            const double *x = spheres ? d->position + 3 * p : d->vertex + 3 * (int64_t)c->part[k].first[p];
            for (int m = 0; m < 3; ++m)
                block[3 * n + m] = (float)x[m];
            if (++n < room) continue;
            brc_h5_pack_rows_either(h5, "VTKHDF/Points", H5T_NATIVE_FLOAT, written, n, block, c->n_threads);
            written += n;
            n = 0;
        }
    }
    brc_h5_pack_rows_either(h5, "VTKHDF/Points", H5T_NATIVE_FLOAT, written, n, block, c->n_threads);
    brc_memory_free(block);
    return BRC_OK;
}

/* PointData/radius, where some part has spheres; 0 at corners of cells. */
static brc_status write_radius(const brc_frame_cells *c, brc_h5 *h5)
{
    brc_h5_packed(h5, "VTKHDF/PointData/radius", H5T_NATIVE_DOUBLE, brc_frame_point_rows(c, 0).all, 0);
    for (int32_t k = 0; k < c->assembly->n; ++k) {
        const brc_frame_rows r = brc_frame_point_rows(c, k);
        double *none = NULL;
        if (!brc_frame_is_sphere(c->part[k].domain)) BRC_TRY(BRC_ALLOCATE(c->context, &none, r.n, "radii of a frame"));
        brc_h5_pack_rows(h5, "VTKHDF/PointData/radius", H5T_NATIVE_DOUBLE, r.first, r.n,
                         none ? none : c->part[k].domain->radius, c->n_threads);
        brc_memory_free(none);
    }
    return BRC_OK;
}

/* element_id, position, types; and, in scenes of several models, which body and which model an element is of. */
static brc_status write_elements(const brc_frame_cells *c, brc_h5 *h5)
{
    const bool several = c->assembly->n > 1;
    const int64_t all = brc_frame_element_rows(c, 0).all;
    brc_status status = BRC_OK;
    brc_h5_packed(h5, "VTKHDF/CellData/element_id", H5T_NATIVE_INT64, all, 0);
    brc_h5_packed(h5, "VTKHDF/CellData/position", H5T_NATIVE_DOUBLE, all, 3);
    brc_h5_packed(h5, "VTKHDF/Types", H5T_NATIVE_UINT8, all, 0);
    if (several) brc_h5_packed(h5, "VTKHDF/CellData/body", H5T_NATIVE_INT32, all, 0);
    if (several) brc_h5_packed(h5, "VTKHDF/CellData/model", H5T_NATIVE_INT32, all, 0);
    for (int32_t k = 0; k < c->assembly->n && status == BRC_OK; ++k) {
        const brc_frame_rows r = brc_frame_element_rows(c, k);
        int64_t *id = NULL;
        int32_t *of = NULL;
        uint8_t *type = NULL;
        BRC_TRY_OR(next, BRC_ALLOCATE(c->context, &id, r.n, "numbers of a frame"));
        BRC_TRY_OR(next, BRC_ALLOCATE(c->context, &of, r.n, "bodies of a frame"));
        BRC_TRY_OR(next, BRC_ALLOCATE(c->context, &type, r.n, "cell types of a frame"));
        for (int64_t e = 0; e < r.n; ++e)
            id[e] = r.first + e;
        memset(type, brc_frame_is_sphere(c->part[k].domain) ? VERTEX : POLYHEDRON, (size_t)r.n);
        brc_h5_pack_rows(h5, "VTKHDF/CellData/element_id", H5T_NATIVE_INT64, r.first, r.n, id, c->n_threads);
        brc_h5_pack_rows(h5, "VTKHDF/CellData/position", H5T_NATIVE_DOUBLE, r.first, r.n, c->part[k].domain->position,
                         c->n_threads);
        brc_h5_pack_rows(h5, "VTKHDF/Types", H5T_NATIVE_UINT8, r.first, r.n, type, c->n_threads);
        if (several) {
            for (int64_t e = 0; e < r.n; ++e)
                of[e] = brc_assembly_body(c->assembly, k, e);
            brc_h5_pack_rows(h5, "VTKHDF/CellData/body", H5T_NATIVE_INT32, r.first, r.n, of, c->n_threads);
            for (int64_t e = 0; e < r.n; ++e)
                of[e] = k;
            brc_h5_pack_rows(h5, "VTKHDF/CellData/model", H5T_NATIVE_INT32, r.first, r.n, of, c->n_threads);
        }
    next:
        brc_memory_free(id);
        brc_memory_free(of);
        brc_memory_free(type);
    }
    return status;
}

static void refer_to_elements(const brc_frame_cells *c, brc_h5 *h5)
{
    static const char *const NAME[] = {"VTKHDF/CellData/element_id", "VTKHDF/CellData/position", "VTKHDF/Types",
                                       "VTKHDF/CellData/body", "VTKHDF/CellData/model"};
    const size_t n = sizeof NAME / sizeof *NAME - (c->assembly->n > 1 ? 0 : 2);
    for (size_t k = 0; k < n; ++k)
        refer(h5, NAME[k], c->elements_frame);
}

static void refer_to_points(const brc_frame_cells *c, brc_h5 *h5)
{
    const bool cells = brc_frame_has_cells(c->assembly);
    for (int k = 0; k < N_COLUMNS; ++k)
        if (has_column(k, cells)) refer(h5, COLUMN_NAME[k], c->points_frame);
    for (int k = 0; k < (cells ? N_COUNTS : N_COUNTS_OF_SPHERES); ++k) {
        char path[64];
        snprintf(path, sizeof path, "VTKHDF/%s", COUNT_NAME[k]);
        refer(h5, path, c->points_frame);
    }
    refer(h5, "VTKHDF/Points", c->points_frame);
    if (brc_frame_has_spheres(c->assembly)) refer(h5, "VTKHDF/PointData/radius", c->points_frame);
}

static bool is_plain(const brc_frame_cells *c)
{
    bool plain = true;
    for (int32_t k = 0; k < c->assembly->n; ++k)
        plain &= brc_frame_is_sphere(c->part[k].domain) || c->part[k].plain;
    return plain;
}

/* known: the points are those of the frame that has them. */
static brc_status write_cells(const brc_frame_cells *c, brc_h5 *h5, bool known)
{
    if (c->elements_frame >= 0)
        refer_to_elements(c, h5);
    else
        BRC_TRY(write_elements(c, h5));
    if (known) {
        refer_to_points(c, h5);
        return BRC_OK;
    }
    BRC_TRY(write_points(c, h5));
    if (brc_frame_has_spheres(c->assembly)) BRC_TRY(write_radius(c, h5));
    return write_polyhedra(c, h5, is_plain(c) ? c->starts_frame : -1);
}

brc_status brc_frame_cells_write(brc_frame_cells *c, brc_h5 *h5, int64_t number)
{
    int64_t n_broken = 0;
    for (int32_t k = 0; k < c->assembly->n && brc_simulation_has_fracture(c->assembly->part[0]); ++k) {
        int64_t broken;
        if (brc_frame_is_sphere(c->part[k].domain)) continue;
        BRC_TRY(brc_simulation_broken(c->assembly->part[k], &broken));
        n_broken += broken;
    }
    const bool known = c->points_frame >= 0 && n_broken == c->n_broken;
    if (!known || !c->joined) BRC_TRY(join(c));
    if (brc_file_writes()) BRC_TRY(write_cells(c, h5, known));
    if (c->elements_frame < 0) c->elements_frame = number;
    if (known) return BRC_OK;
    c->points_frame = number;
    c->n_broken = n_broken;
    if (is_plain(c) && c->starts_frame < 0) c->starts_frame = number;
    return BRC_OK;
}
