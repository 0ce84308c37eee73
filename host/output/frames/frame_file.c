/* Frames as VTKHDF. */
#include "frame_file.h"
#include "../cracks/cracks.h"
#include "deform.h"
#include "frame_cells.h"
#include "../h5_pack.h"
#include "../text.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include <stdio.h>
#include <string.h>

struct brc_frames {
    brc_frame_cells cells;
};

/* A part of the whole and its place in the frame. */
typedef struct frame_part {
    brc_context *context;
    brc_h5 *h5;
    const brc_frame_cells *cells;
    int32_t index;
    brc_simulation *simulation;
    const brc_domain *domain;
    brc_frame_rows elements, points;
} frame_part;

/* The part's rows of a dataset, which the first part makes. */
static void put(const frame_part *p, const char *path, hid_t type, brc_frame_rows r, int64_t columns, const void *data)
{
    if (p->index == 0) brc_h5_packed(p->h5, path, type, r.all, columns);
    brc_h5_pack_rows(p->h5, path, type, r.first, r.n, data, p->cells->n_threads);
}

static frame_part make_part(brc_h5 *h5, const brc_frame_cells *cells, int32_t index)
{
    brc_simulation *simulation = cells->assembly->part[index];
    return (frame_part){.context = cells->context,
                        .h5 = h5,
                        .cells = cells,
                        .index = index,
                        .simulation = simulation,
                        .domain = brc_simulation_domain(simulation),
                        .elements = brc_frame_element_rows(cells, index),
                        .points = brc_frame_point_rows(cells, index)};
}

/* Displacement of shared corners: the mean of what the gradients of their cells say, which is the same where the field
 * is linear. */
static brc_status move_corners(const frame_part *p, const double *displacement, double *sum)
{
    const brc_domain *d = p->domain;
    const int32_t *point = p->cells->part[p->index].point;
    uint8_t *whole = NULL, *cells = NULL; /* cells of each point */
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, brc_simulation_whole(p->simulation, &whole));
    if (!brc_file_writes()) goto cleanup; /* this rank has no points */
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(p->context, &cells, p->points.n, "corners of a frame"));
    for (int64_t e = 0; e < d->n_elements; ++e) {
        double gradient[3][3], u[3];
        brc_deform_gradient(d, whole, displacement, e, gradient);
        for (int64_t v = d->vertex_start[e]; v < d->vertex_start[e + 1]; ++v) {
            if (point[v] < 0 || cells[point[v]] == UINT8_MAX) continue;
            brc_deform_point(d, displacement, e, (const double(*)[3])gradient, d->vertex + 3 * v, u);
            ++cells[point[v]];
            for (int c = 0; c < 3; ++c)
                sum[3 * (int64_t)point[v] + c] += u[c];
        }
    }
    for (int64_t k = 0; k < p->points.n; ++k)
        for (int c = 0; c < 3; ++c)
            sum[3 * k + c] /= cells[k];
cleanup:
    brc_memory_free(whole);
    brc_memory_free(cells);
    return status;
}

/* PointData/displacement of spheres, each of which is one point, or of corners. */
static brc_status write_displacement(const frame_part *p, const double *displacement)
{
    double *moved = NULL;
    float *out = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(p->context, &moved, 3 * p->points.n, "corners of a frame"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(p->context, &out, 3 * p->points.n, "corners of a frame"));
    if (!brc_frame_is_sphere(p->domain)) BRC_TRY_OR(cleanup, move_corners(p, displacement, moved));
    for (int64_t k = 0; k < 3 * p->points.n; ++k)
        out[k] = (float)(brc_frame_is_sphere(p->domain) ? displacement : moved)[k];
    put(p, "VTKHDF/PointData/displacement", H5T_NATIVE_FLOAT, p->points, 3, out);
cleanup:
    brc_memory_free(moved);
    brc_memory_free(out);
    return status;
}

static bool is_single(const frame_part *p)
{
    return brc_simulation_scene(p->simulation)->output.frame_numbers == BRC_FRAME_SINGLE;
}

/* In the precision that the scene asks for. */
static brc_status write_field(const frame_part *p, const char *name, int64_t columns, const double *data)
{
    const int64_t n = p->elements.n * (columns > 0 ? columns : 1);
    float *single = NULL;
    char path[64];
    snprintf(path, sizeof path, "VTKHDF/CellData/%s", name);
    if (!is_single(p)) {
        put(p, path, H5T_NATIVE_DOUBLE, p->elements, columns, data);
        return BRC_OK;
    }
    BRC_TRY(BRC_ALLOCATE(p->context, &single, n, "field of a frame"));
    for (int64_t k = 0; k < n; ++k)
        single[k] = (float)data[k];
    put(p, path, H5T_NATIVE_FLOAT, p->elements, columns, single);
    brc_memory_free(single);
    return BRC_OK;
}

/* Of spheres alone in single precision it is what their points have, under another name. */
static brc_status write_own_displacement(const frame_part *p, const double *displacement)
{
    if (!is_single(p) || brc_frame_has_cells(p->cells->assembly))
        return write_field(p, "displacement", 3, displacement);
    if (p->index == 0) brc_h5_link(p->h5, "VTKHDF/CellData/displacement", "VTKHDF/PointData/displacement");
    return BRC_OK;
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
    BRC_TRY_OR(cleanup, write_field(p, "stress", 6, stress));
    BRC_TRY_OR(cleanup, write_field(p, "strain", 6, strain));
    status = write_field(p, "von_mises", 0, mises);
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
    if (!brc_frame_has_spheres(p->cells->assembly)) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(p->context, &orientation, 4 * p->elements.n, "orientation of a frame"));
    for (int64_t e = 0; e < p->elements.n; ++e)
        orientation[4 * e] = 1;
    if (brc_frame_is_sphere(p->domain) ||
        !brc_model_traits_of(brc_simulation_scene(p->simulation)->model.kind)->deforms)
        status = brc_simulation_orientation(p->simulation, orientation, NULL);
    if (status == BRC_OK) status = write_field(p, "orientation", 4, orientation);
    brc_memory_free(orientation);
    return status;
}

static brc_status write_part(const frame_part *p)
{
    const int64_t n = p->elements.n;
    double *vector = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(p->context, &vector, 3 * n, "displacement of a frame"));
    BRC_TRY_OR(cleanup, brc_simulation_displacement(p->simulation, vector));
    BRC_TRY_OR(cleanup, write_displacement(p, vector));
    BRC_TRY_OR(cleanup, write_own_displacement(p, vector));
    BRC_TRY_OR(cleanup, brc_simulation_velocity(p->simulation, vector));
    BRC_TRY_OR(cleanup, write_field(p, "velocity", 3, vector));
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

static brc_status write_content(brc_frame_cells *cells, brc_h5 *h5, int64_t number)
{
    const brc_assembly *assembly = cells->assembly;
    const bool polyhedra = brc_frame_has_cells(assembly);
    const int64_t vtk_version[2] = {polyhedra ? 2 : 1, polyhedra ? 5 : 0}, format_version = BRC_FRAME_FORMAT_VERSION;
    brc_h5_group(h5, "VTKHDF");
    brc_h5_attribute_integers(h5, "VTKHDF", "Version", 2, vtk_version);
    brc_h5_attribute_text(h5, "VTKHDF", "Type", "UnstructuredGrid");
    brc_h5_attribute_integers(h5, "VTKHDF", "breccia_format", 1, &format_version);
    brc_h5_group(h5, "VTKHDF/CellData");
    brc_h5_group(h5, "VTKHDF/PointData");
    brc_h5_group(h5, "VTKHDF/FieldData");
    BRC_TRY(brc_frame_cells_write(cells, h5, number));
    for (int32_t k = 0; k < assembly->n; ++k) {
        const frame_part part = make_part(h5, cells, k);
        BRC_TRY(write_part(&part));
    }
    if (brc_simulation_has_fracture(assembly->part[0]))
        BRC_TRY(brc_cracks_write_frame(cells->context, h5, assembly, cells->n_threads));
    write_moment(h5, assembly->part[0]);
    return BRC_OK;
}

brc_status brc_frames_create(brc_context *context, const brc_assembly *assembly, int n_threads, brc_frames **out)
{
    *out = NULL;
    BRC_TRY(BRC_ALLOCATE(context, out, 1, "frames"));
    const brc_status status = brc_frame_cells_create(context, assembly, n_threads, &(*out)->cells);
    if (status != BRC_OK) brc_frames_free(out);
    return status;
}

void brc_frames_free(brc_frames **frames)
{
    if (!frames || !*frames) return;
    brc_frame_cells_free(&(*frames)->cells);
    brc_memory_free(*frames);
    *frames = NULL;
}

brc_status brc_frames_store(brc_frames *frames, brc_state_store *store)
{
    return brc_frame_cells_store(&frames->cells, store);
}

brc_status brc_frames_write(brc_frames *frames, const char *folder, int64_t number)
{
    brc_context *context = frames->cells.context;
    char name[32], *path = NULL;
    brc_h5 h5;
    snprintf(name, sizeof name, "%06lld.vtkhdf", (long long)number);
    BRC_TRY(brc_file_join(context, folder, name, &path));
    brc_status status = brc_h5_create(context, path, &h5);
    brc_memory_free(path);
    BRC_TRY(status);
    status = write_content(&frames->cells, &h5, number);
    if (status == BRC_OK) return brc_h5_commit(&h5);
    brc_h5_discard(&h5);
    return status;
}

brc_status brc_frame_write_series(brc_context *context, int64_t n, const double *time, const char *suffix,
                                  const char *path)
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
