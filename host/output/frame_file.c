/* Frames as VTKHDF. */
#include "frame_file.h"
#include "cracks.h"
#include "deform.h"
#include "h5.h"
#include "text.h"
#include "../base/memory.h"
#include <stdio.h>
#include <string.h>

#define BLOCK_POINTS ((int64_t)1 << 17)
enum { VERTEX = 1, CONVEX_POINT_SET = 41 }; /* VTK's cell types */

static bool is_sphere(const brc_domain *d)
{
    return d->element_kind == BRC_ELEMENT_SPHERE;
}

/* Points, Connectivity, PointData/displacement and radius of spheres: each is one point. */
static brc_status write_centres(brc_context *context, brc_h5 *h5, const brc_domain *d, const double *displacement)
{
    const int64_t n = d->n_elements;
    int64_t *id = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &id, n, "spheres of a frame"));
    for (int64_t e = 0; e < n; ++e) id[e] = e;
    brc_h5_dataset(h5, "VTKHDF/Connectivity", H5T_NATIVE_INT64, n, 0, id);
    brc_memory_free(id);
    const char *const name[2] = {"VTKHDF/Points", "VTKHDF/PointData/displacement"};
    float *block = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &block, 3 * n, "spheres of a frame"));
    for (int k = 0; k < 2; ++k) {
        for (int64_t c = 0; c < 3 * n; ++c) block[c] = (float)(k == 0 ? d->position : displacement)[c];
        brc_h5_dataset(h5, name[k], H5T_NATIVE_FLOAT, n, 3, block);
    }
    brc_memory_free(block);
    brc_h5_dataset(h5, "VTKHDF/PointData/radius", H5T_NATIVE_DOUBLE, n, 0, d->radius);
    brc_h5_attribute_text(h5, "VTKHDF/PointData/radius", "unit", "m");
    return BRC_OK;
}

static int64_t largest_cell(const brc_domain *d)
{
    int64_t most = 0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        if (d->vertex_start[e + 1] - d->vertex_start[e] > most) most = d->vertex_start[e + 1] - d->vertex_start[e];
    return most;
}

/* Points, Connectivity and PointData/displacement, a block of whole cells at a time. */
static brc_status write_points(brc_context *context, brc_h5 *h5, const brc_domain *d, const double *displacement)
{
    if (is_sphere(d)) return write_centres(context, h5, d, displacement);
    const int64_t n_points = d->vertex_start[d->n_elements];
    const int64_t room = BLOCK_POINTS + largest_cell(d);
    float *corner = NULL, *moved = NULL;
    int64_t *id = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &corner, 3 * room, "corners of a frame"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &moved, 3 * room, "corners of a frame"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &id, room, "corners of a frame"));
    brc_h5_dataset(h5, "VTKHDF/Points", H5T_NATIVE_FLOAT, n_points, 3, NULL);
    brc_h5_dataset(h5, "VTKHDF/Connectivity", H5T_NATIVE_INT64, n_points, 0, NULL);
    brc_h5_dataset(h5, "VTKHDF/PointData/displacement", H5T_NATIVE_FLOAT, n_points, 3, NULL);
    for (int64_t e = 0, first = 0; e < d->n_elements && h5->status == BRC_OK; ++e) {
        double gradient[3][3], u[3];
        brc_deform_gradient(d, displacement, e, gradient);
        for (int64_t v = d->vertex_start[e]; v < d->vertex_start[e + 1]; ++v) {
            brc_deform_point(d, displacement, e, (const double(*)[3])gradient, d->vertex + 3 * v, u);
            for (int c = 0; c < 3; ++c) {
                corner[3 * (v - first) + c] = (float)d->vertex[3 * v + c];
                moved[3 * (v - first) + c] = (float)u[c];
            }
            id[v - first] = v;
        }
        const int64_t end = d->vertex_start[e + 1];
        if (end - first < BLOCK_POINTS && e + 1 < d->n_elements) continue;
        brc_h5_rows(h5, "VTKHDF/Points", H5T_NATIVE_FLOAT, first, end - first, corner);
        brc_h5_rows(h5, "VTKHDF/Connectivity", H5T_NATIVE_INT64, first, end - first, id);
        brc_h5_rows(h5, "VTKHDF/PointData/displacement", H5T_NATIVE_FLOAT, first, end - first, moved);
        first = end;
    }
cleanup:
    brc_memory_free(corner);
    brc_memory_free(moved);
    brc_memory_free(id);
    return status;
}

static void write_field(brc_h5 *h5, const char *name, const char *unit, int64_t n, int64_t columns, const double *data)
{
    char path[64];
    snprintf(path, sizeof path, "VTKHDF/CellData/%s", name);
    brc_h5_dataset(h5, path, H5T_NATIVE_DOUBLE, n, columns, data);
    brc_h5_attribute_text(h5, path, "unit", unit);
}

static brc_status write_cells(brc_context *context, brc_h5 *h5, const brc_domain *d)
{
    const int64_t n = d->n_elements, n_points = is_sphere(d) ? n : d->vertex_start[n];
    uint8_t *type = NULL;
    int64_t *id = NULL; /* 0 .. n: ids, and where each sphere's one point begins */
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &type, n, "cell types of a frame"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &id, n + 1, "element ids of a frame"));
    memset(type, is_sphere(d) ? VERTEX : CONVEX_POINT_SET, (size_t)n);
    for (int64_t e = 0; e <= n; ++e) id[e] = e;
    brc_h5_dataset(h5, "VTKHDF/NumberOfPoints", H5T_NATIVE_INT64, 1, 0, &n_points);
    brc_h5_dataset(h5, "VTKHDF/NumberOfCells", H5T_NATIVE_INT64, 1, 0, &n);
    brc_h5_dataset(h5, "VTKHDF/NumberOfConnectivityIds", H5T_NATIVE_INT64, 1, 0, &n_points);
    brc_h5_dataset(h5, "VTKHDF/Types", H5T_NATIVE_UINT8, n, 0, type);
    brc_h5_dataset(h5, "VTKHDF/Offsets", H5T_NATIVE_INT64, n + 1, 0, is_sphere(d) ? id : d->vertex_start);
    brc_h5_dataset(h5, "VTKHDF/CellData/element_id", H5T_NATIVE_INT64, n, 0, id);
    write_field(h5, "position", "m", n, 3, d->position);
cleanup:
    brc_memory_free(type);
    brc_memory_free(id);
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

static brc_status write_tensors(brc_context *context, brc_h5 *h5, brc_simulation *simulation, int64_t n)
{
    double *strain = NULL, *stress = NULL, *mises = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &strain, 6 * n, "strain of a frame"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &stress, 6 * n, "stress of a frame"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &mises, n, "stress of a frame"));
    BRC_TRY_OR(cleanup, brc_simulation_strain_stress(simulation, strain, NULL, stress));
    for (int64_t e = 0; e < n; ++e)
        mises[e] = brc_deform_von_mises(stress + 6 * e);
    to_vtk_order(n, strain);
    to_vtk_order(n, stress);
    write_field(h5, "stress", "Pa", n, 6, stress);
    write_field(h5, "strain", "-", n, 6, strain);
    write_field(h5, "von_mises", "Pa", n, 0, mises);
cleanup:
    brc_memory_free(strain);
    brc_memory_free(stress);
    brc_memory_free(mises);
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

static brc_status write_content(brc_context *context, brc_h5 *h5, brc_simulation *simulation)
{
    static const int64_t vtk_version[2] = {1, 0}, format_version = BRC_FRAME_FORMAT_VERSION;
    const brc_domain *d = brc_simulation_domain(simulation);
    const int64_t n = d->n_elements;
    double *vector = NULL, *orientation = NULL;
    brc_status status = BRC_OK;
    brc_h5_group(h5, "VTKHDF");
    brc_h5_attribute_integers(h5, "VTKHDF", "Version", 2, vtk_version);
    brc_h5_attribute_text(h5, "VTKHDF", "Type", "UnstructuredGrid");
    brc_h5_attribute_integers(h5, "VTKHDF", "breccia_format", 1, &format_version);
    brc_h5_group(h5, "VTKHDF/CellData");
    brc_h5_group(h5, "VTKHDF/PointData");
    brc_h5_group(h5, "VTKHDF/FieldData");
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &vector, 3 * n, "displacement of a frame"));
    BRC_TRY_OR(cleanup, write_cells(context, h5, d));
    BRC_TRY_OR(cleanup, brc_simulation_displacement(simulation, vector));
    BRC_TRY_OR(cleanup, write_points(context, h5, d, vector));
    write_field(h5, "displacement", "m", n, 3, vector);
    BRC_TRY_OR(cleanup, brc_simulation_velocity(simulation, vector));
    write_field(h5, "velocity", "m/s", n, 3, vector);
    if (is_sphere(d)) {
        BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &orientation, 4 * n, "orientation of a frame"));
        BRC_TRY_OR(cleanup, brc_simulation_orientation(simulation, orientation, NULL));
        write_field(h5, "orientation", "-", n, 4, orientation);
    }
    BRC_TRY_OR(cleanup, write_tensors(context, h5, simulation, n));
    if (brc_simulation_has_fracture(simulation)) BRC_TRY_OR(cleanup, brc_cracks_write_frame(context, h5, simulation));
    write_moment(h5, simulation);
cleanup:
    brc_memory_free(vector);
    brc_memory_free(orientation);
    return status;
}

brc_status brc_frame_write(brc_context *context, brc_simulation *simulation, const char *path)
{
    brc_h5 h5;
    BRC_TRY(brc_h5_create(context, path, &h5));
    const brc_status status = write_content(context, &h5, simulation);
    if (status == BRC_OK) return brc_h5_commit(&h5);
    brc_h5_discard(&h5);
    return status;
}

brc_status brc_frame_write_series(brc_context *context, int64_t n, const double *time, const char *path)
{
    brc_json json = {.text = {.context = context}};
    brc_json_begin_object(&json, NULL);
    brc_json_string(&json, "file-series-version", "1.0");
    brc_json_begin_array(&json, "files");
    for (int64_t k = 0; k < n; ++k) {
        char name[48];
        snprintf(name, sizeof name, "frames/%06lld.vtkhdf", (long long)k);
        brc_json_begin_object(&json, NULL);
        brc_json_string(&json, "name", name);
        brc_json_number(&json, "time", time[k]);
        brc_json_end(&json);
    }
    return brc_json_write(&json, path);
}
