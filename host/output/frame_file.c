/* Frames as VTKHDF. */
#include "frame_file.h"
#include "cracks.h"
#include "deform.h"
#include "h5.h"
#include "text.h"
#include "../base/memory.h"
#include <stdio.h>
#include <string.h>

#define BLOCK_POINTS ((int64_t)1 << 14)
enum { VERTEX = 1, CONVEX_POINT_SET = 41 }; /* VTK's cell types */

static bool is_sphere(const brc_domain *d)
{
    return d->element_kind == BRC_ELEMENT_SPHERE;
}

/* Where the rows of one part stand among those of all. */
typedef struct rows {
    int64_t first, n, all;
} rows;

/* A part of the whole and its place in the frame. */
typedef struct frame_part {
    brc_context *context;
    brc_h5 *h5;
    const brc_assembly *assembly;
    int32_t index;
    brc_simulation *simulation;
    const brc_domain *domain;
    rows elements, points;
} frame_part;

/* The part's rows of a dataset, which the first part makes. */
static void put(const frame_part *p, const char *path, const char *unit, hid_t type, rows r, int64_t columns, const void *data)
{
    const bool alone = r.n == r.all;
    if (p->index == 0) brc_h5_dataset(p->h5, path, type, r.all, columns, alone ? data : NULL);
    if (!alone && data) brc_h5_rows(p->h5, path, type, r.first, r.n, data);
    if (p->index == 0 && unit) brc_h5_attribute_text(p->h5, path, "unit", unit);
}

static int64_t n_points_of(const brc_domain *d) { return is_sphere(d) ? d->n_elements : d->vertex_start[d->n_elements]; }

static bool any_spheres(const brc_assembly *a)
{
    for (int32_t k = 0; k < a->n; ++k)
        if (is_sphere(brc_simulation_domain(a->part[k]))) return true;
    return false;
}

static frame_part make_part(brc_context *context, brc_h5 *h5, const brc_assembly *a, int32_t index)
{
    frame_part p = {.context = context, .h5 = h5, .assembly = a, .index = index, .simulation = a->part[index],
                    .domain = brc_simulation_domain(a->part[index])};
    for (int32_t k = 0; k < a->n; ++k) {
        const brc_domain *d = brc_simulation_domain(a->part[k]);
        if (k == index) {
            p.elements.first = p.elements.all;
            p.points.first = p.points.all;
        }
        p.elements.all += d->n_elements;
        p.points.all += n_points_of(d);
    }
    p.elements.n = p.domain->n_elements;
    p.points.n = n_points_of(p.domain);
    return p;
}

/* first, first + 1, ...: n of them. */
static brc_status count_up(brc_context *context, int64_t first, int64_t n, int64_t **out)
{
    BRC_TRY(BRC_ALLOCATE(context, out, n, "numbers of a frame"));
    for (int64_t k = 0; k < n; ++k) (*out)[k] = first + k;
    return BRC_OK;
}

/* Points, Connectivity and PointData/displacement of spheres: each is one point. */
static brc_status write_centres(const frame_part *p, const double *displacement)
{
    const brc_domain *d = p->domain;
    const int64_t n = d->n_elements;
    int64_t *id = NULL;
    BRC_TRY(count_up(p->context, p->points.first, n, &id));
    put(p, "VTKHDF/Connectivity", NULL, H5T_NATIVE_INT64, p->points, 0, id);
    brc_memory_free(id);
    const char *const name[2] = {"VTKHDF/Points", "VTKHDF/PointData/displacement"};
    float *block = NULL;
    BRC_TRY(BRC_ALLOCATE(p->context, &block, 3 * n, "spheres of a frame"));
    for (int k = 0; k < 2; ++k) {
        for (int64_t c = 0; c < 3 * n; ++c) block[c] = (float)(k == 0 ? d->position : displacement)[c];
        put(p, name[k], NULL, H5T_NATIVE_FLOAT, p->points, 3, block);
    }
    brc_memory_free(block);
    return BRC_OK;
}

static int64_t largest_cell(const brc_domain *d)
{
    int64_t most = 0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        if (d->vertex_start[e + 1] - d->vertex_start[e] > most) most = d->vertex_start[e + 1] - d->vertex_start[e];
    return most;
}

/* Points, Connectivity and PointData/displacement of cells, a block of whole cells at a time. */
static brc_status write_corners(const frame_part *p, const double *displacement)
{
    const brc_domain *d = p->domain;
    brc_h5 *h5 = p->h5;
    const int64_t room = BLOCK_POINTS + largest_cell(d), before = p->points.first;
    float *corner = NULL, *moved = NULL;
    int64_t *id = NULL;
    uint8_t *whole = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, brc_simulation_whole(p->simulation, &whole));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(p->context, &corner, 3 * room, "corners of a frame"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(p->context, &moved, 3 * room, "corners of a frame"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(p->context, &id, room, "corners of a frame"));
    if (p->index == 0) {
        brc_h5_dataset(h5, "VTKHDF/Points", H5T_NATIVE_FLOAT, p->points.all, 3, NULL);
        brc_h5_dataset(h5, "VTKHDF/Connectivity", H5T_NATIVE_INT64, p->points.all, 0, NULL);
        brc_h5_dataset(h5, "VTKHDF/PointData/displacement", H5T_NATIVE_FLOAT, p->points.all, 3, NULL);
    }
    for (int64_t e = 0, first = 0; e < d->n_elements && h5->status == BRC_OK; ++e) {
        double gradient[3][3], u[3];
        brc_deform_gradient(d, whole, displacement, e, gradient);
        for (int64_t v = d->vertex_start[e]; v < d->vertex_start[e + 1]; ++v) {
            brc_deform_point(d, displacement, e, (const double(*)[3])gradient, d->vertex + 3 * v, u);
            for (int c = 0; c < 3; ++c) {
                corner[3 * (v - first) + c] = (float)d->vertex[3 * v + c];
                moved[3 * (v - first) + c] = (float)u[c];
            }
            id[v - first] = before + v;
        }
        const int64_t end = d->vertex_start[e + 1];
        if (end - first < BLOCK_POINTS && e + 1 < d->n_elements) continue;
        brc_h5_rows(h5, "VTKHDF/Points", H5T_NATIVE_FLOAT, before + first, end - first, corner);
        brc_h5_rows(h5, "VTKHDF/Connectivity", H5T_NATIVE_INT64, before + first, end - first, id);
        brc_h5_rows(h5, "VTKHDF/PointData/displacement", H5T_NATIVE_FLOAT, before + first, end - first, moved);
        first = end;
    }
cleanup:
    brc_memory_free(corner);
    brc_memory_free(moved);
    brc_memory_free(whole);
    brc_memory_free(id);
    return status;
}

/* PointData/radius, where some part has spheres; 0 at corners of cells. */
static brc_status write_radius(const frame_part *p)
{
    double *none = NULL;
    if (!any_spheres(p->assembly)) return BRC_OK;
    if (!is_sphere(p->domain)) BRC_TRY(BRC_ALLOCATE(p->context, &none, p->points.n, "radii of a frame"));
    put(p, "VTKHDF/PointData/radius", "m", H5T_NATIVE_DOUBLE, p->points, 0, none ? none : p->domain->radius);
    brc_memory_free(none);
    return BRC_OK;
}

static void write_field(const frame_part *p, const char *name, const char *unit, int64_t columns, const double *data)
{
    char path[64];
    snprintf(path, sizeof path, "VTKHDF/CellData/%s", name);
    put(p, path, unit, H5T_NATIVE_DOUBLE, p->elements, columns, data);
}

/* Which body and which model an element is of; only in scenes of several models. */
static brc_status write_owners(const frame_part *p)
{
    int32_t *of = NULL;
    if (p->assembly->n == 1) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(p->context, &of, p->elements.n, "bodies of a frame"));
    for (int64_t e = 0; e < p->elements.n; ++e) of[e] = brc_assembly_body(p->assembly, p->index, e);
    put(p, "VTKHDF/CellData/body", NULL, H5T_NATIVE_INT32, p->elements, 0, of);
    for (int64_t e = 0; e < p->elements.n; ++e) of[e] = p->index;
    put(p, "VTKHDF/CellData/model", NULL, H5T_NATIVE_INT32, p->elements, 0, of);
    brc_memory_free(of);
    return BRC_OK;
}

static brc_status write_cells(const frame_part *p)
{
    const brc_domain *d = p->domain;
    const int64_t n = p->elements.n;
    uint8_t *type = NULL;
    int64_t *id = NULL, *offset = NULL; /* where each element's points begin, and where the last one's end */
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(p->context, &type, n, "cell types of a frame"));
    BRC_TRY_OR(cleanup, count_up(p->context, p->elements.first, n, &id));
    BRC_TRY_OR(cleanup, count_up(p->context, p->points.first, n + 1, &offset));
    memset(type, is_sphere(d) ? VERTEX : CONVEX_POINT_SET, (size_t)n);
    for (int64_t e = 0; !is_sphere(d) && e <= n; ++e) offset[e] = p->points.first + d->vertex_start[e];
    if (p->index == 0) {
        brc_h5_dataset(p->h5, "VTKHDF/NumberOfPoints", H5T_NATIVE_INT64, 1, 0, &p->points.all);
        brc_h5_dataset(p->h5, "VTKHDF/NumberOfCells", H5T_NATIVE_INT64, 1, 0, &p->elements.all);
        brc_h5_dataset(p->h5, "VTKHDF/NumberOfConnectivityIds", H5T_NATIVE_INT64, 1, 0, &p->points.all);
    }
    put(p, "VTKHDF/Types", NULL, H5T_NATIVE_UINT8, p->elements, 0, type);
    put(p, "VTKHDF/Offsets", NULL, H5T_NATIVE_INT64, (rows){p->elements.first, n + 1, p->elements.all + 1}, 0, offset);
    put(p, "VTKHDF/CellData/element_id", NULL, H5T_NATIVE_INT64, p->elements, 0, id);
    write_field(p, "position", "m", 3, d->position);
    status = write_owners(p);
cleanup:
    brc_memory_free(type);
    brc_memory_free(id);
    brc_memory_free(offset);
    return status;
}

/* xx yy zz yz xz xy -> XX YY ZZ XY YZ XZ. */
static void to_vtk_order(int64_t n, double *tensor)
{
    for (int64_t e = 0; e < n; ++e) {
        double *t = tensor + 6 * e;
        const double yz = t[3], xz = t[4];
        t[3] = t[5];
        t[4] = yz;
        t[5] = xz;
    }
}

static brc_status write_tensors(const frame_part *p)
{
    const int64_t n = p->elements.n;
    double *strain = NULL, *stress = NULL, *mises = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(p->context, &strain, 6 * n, "strain of a frame"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(p->context, &stress, 6 * n, "stress of a frame"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(p->context, &mises, n, "stress of a frame"));
    BRC_TRY_OR(cleanup, brc_simulation_strain_stress(p->simulation, strain, NULL, stress));
    for (int64_t e = 0; e < n; ++e)
        mises[e] = brc_deform_von_mises(stress + 6 * e);
    to_vtk_order(n, strain);
    to_vtk_order(n, stress);
    write_field(p, "stress", "Pa", 6, stress);
    write_field(p, "strain", "-", 6, strain);
    write_field(p, "von_mises", "Pa", 0, mises);
cleanup:
    brc_memory_free(strain);
    brc_memory_free(stress);
    brc_memory_free(mises);
    return status;
}

/* Where some part has spheres; cells without rotations of their own are upright. */
static brc_status write_orientation(const frame_part *p)
{
    double *orientation = NULL;
    brc_status status = BRC_OK;
    if (!any_spheres(p->assembly)) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(p->context, &orientation, 4 * p->elements.n, "orientation of a frame"));
    for (int64_t e = 0; e < p->elements.n; ++e) orientation[4 * e] = 1;
    if (is_sphere(p->domain) || brc_simulation_scene(p->simulation)->model.kind != BRC_MODEL_DLSM)
        status = brc_simulation_orientation(p->simulation, orientation, NULL);
    if (status == BRC_OK) write_field(p, "orientation", "-", 4, orientation);
    brc_memory_free(orientation);
    return status;
}

static brc_status write_part(const frame_part *p)
{
    const int64_t n = p->elements.n;
    double *vector = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(p->context, &vector, 3 * n, "displacement of a frame"));
    BRC_TRY_OR(cleanup, write_cells(p));
    BRC_TRY_OR(cleanup, brc_simulation_displacement(p->simulation, vector));
    BRC_TRY_OR(cleanup, is_sphere(p->domain) ? write_centres(p, vector) : write_corners(p, vector));
    BRC_TRY_OR(cleanup, write_radius(p));
    write_field(p, "displacement", "m", 3, vector);
    BRC_TRY_OR(cleanup, brc_simulation_velocity(p->simulation, vector));
    write_field(p, "velocity", "m/s", 3, vector);
    BRC_TRY_OR(cleanup, write_orientation(p));
    status = write_tensors(p);
cleanup:
    brc_memory_free(vector);
    return status;
}

static void write_moment(brc_h5 *h5, const brc_simulation *simulation)
{
    const double time = brc_simulation_total_time(simulation), stage_time = brc_simulation_time(simulation);
    const int64_t stage = brc_simulation_stage(simulation), step = brc_simulation_step(simulation);
    brc_h5_dataset(h5, "VTKHDF/FieldData/time", H5T_NATIVE_DOUBLE, 1, 0, &time);
    brc_h5_dataset(h5, "VTKHDF/FieldData/stage_time", H5T_NATIVE_DOUBLE, 1, 0, &stage_time);
    brc_h5_dataset(h5, "VTKHDF/FieldData/stage", H5T_NATIVE_INT64, 1, 0, &stage);
    brc_h5_dataset(h5, "VTKHDF/FieldData/step", H5T_NATIVE_INT64, 1, 0, &step);
}

static brc_status write_content(brc_context *context, brc_h5 *h5, const brc_assembly *assembly)
{
    static const int64_t vtk_version[2] = {1, 0}, format_version = BRC_FRAME_FORMAT_VERSION;
    brc_h5_group(h5, "VTKHDF");
    brc_h5_attribute_integers(h5, "VTKHDF", "Version", 2, vtk_version);
    brc_h5_attribute_text(h5, "VTKHDF", "Type", "UnstructuredGrid");
    brc_h5_attribute_integers(h5, "VTKHDF", "breccia_format", 1, &format_version);
    brc_h5_group(h5, "VTKHDF/CellData");
    brc_h5_group(h5, "VTKHDF/PointData");
    brc_h5_group(h5, "VTKHDF/FieldData");
    for (int32_t k = 0; k < assembly->n; ++k) {
        const frame_part part = make_part(context, h5, assembly, k);
        BRC_TRY(write_part(&part));
    }
    if (brc_simulation_has_fracture(assembly->part[0])) BRC_TRY(brc_cracks_write_frame(context, h5, assembly));
    write_moment(h5, assembly->part[0]);
    return BRC_OK;
}

brc_status brc_frame_write(brc_context *context, const brc_assembly *assembly, const char *path)
{
    brc_h5 h5;
    BRC_TRY(brc_h5_create(context, path, &h5));
    const brc_status status = write_content(context, &h5, assembly);
    if (status == BRC_OK) return brc_h5_commit(&h5);
    brc_h5_discard(&h5);
    return status;
}

brc_status brc_frame_write_series(brc_context *context, int64_t n, const double *time, const char *suffix, const char *path)
{
    brc_json json = {.text = {.context = context}};
    brc_json_begin_object(&json, NULL);
    brc_json_string(&json, "file-series-version", "1.0");
    brc_json_begin_array(&json, "files");
    for (int64_t k = 0; k < n; ++k) {
        char name[48];
        snprintf(name, sizeof name, "frames/%06lld%s", (long long)k, suffix);
        brc_json_begin_object(&json, NULL);
        brc_json_string(&json, "name", name);
        brc_json_number(&json, "time", time[k]);
        brc_json_end(&json);
    }
    return brc_json_write(&json, path);
}
