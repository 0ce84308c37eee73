#include "report_frame.h"
#include "../h5_read.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdio.h>

static brc_status path_of(brc_context *context, const char *folder, int64_t number, char **out)
{
    char name[40];
    snprintf(name, sizeof name, "frames/%06lld.vtkhdf", (long long)number);
    return brc_file_join(context, folder, name, out);
}

brc_status brc_report_frame_exists(brc_context *context, const char *folder, int64_t number, bool *exists)
{
    char *path;
    BRC_TRY(path_of(context, folder, number, &path));
    *exists = brc_file_exists(path);
    brc_memory_free(path);
    return BRC_OK;
}

/* A whole dataset of numbers of `bytes` bytes each; rows < 0: any number of rows, which *out_rows tells. */
static brc_status read_whole(const brc_h5_read *h5, const char *name, hid_t type, int64_t rows, int64_t columns,
                             void *out, int64_t *out_rows)
{
    int64_t found_rows, found_columns;
    BRC_TRY(brc_h5_read_size(h5, name, &found_rows, &found_columns));
    if ((rows >= 0 && found_rows != rows) || found_columns != columns)
        return BRC_FAIL(h5->context, BRC_BAD_INPUT, "%s: %s is %lld x %lld; expected %lld x %lld", h5->path, name,
                        (long long)found_rows, (long long)found_columns, (long long)(rows < 0 ? found_rows : rows),
                        (long long)columns);
    BRC_TRY(brc_memory_allocate(h5->context, out, found_rows * columns, H5Tget_size(type), name));
    if (out_rows) *out_rows = found_rows;
    return brc_h5_read_rows(h5, name, type, 0, found_rows, *(void **)out);
}

static brc_status read_one(const brc_h5_read *h5, const char *name, hid_t type, void *out)
{
    return brc_h5_read_rows(h5, name, type, 0, 1, out);
}

static brc_status read_moment(const brc_h5_read *h5, brc_report_frame *f)
{
    BRC_TRY(read_one(h5, "VTKHDF/FieldData/time", H5T_NATIVE_DOUBLE, &f->time));
    BRC_TRY(read_one(h5, "VTKHDF/FieldData/stage_time", H5T_NATIVE_DOUBLE, &f->stage_time));
    BRC_TRY(read_one(h5, "VTKHDF/FieldData/stage", H5T_NATIVE_INT64, &f->stage));
    BRC_TRY(read_one(h5, "VTKHDF/FieldData/step", H5T_NATIVE_INT64, &f->step));
    f->n_broken = -1;
    if (!brc_h5_read_has(h5, "VTKHDF/FieldData/n_broken")) return BRC_OK;
    BRC_TRY(read_one(h5, "VTKHDF/FieldData/n_fragments", H5T_NATIVE_INT64, &f->n_fragments));
    return read_one(h5, "VTKHDF/FieldData/n_broken", H5T_NATIVE_INT64, &f->n_broken);
}

/* Indices that lead outside are those of a damaged file. */
static bool are_below(int64_t n, const int64_t *index, int64_t end)
{
    for (int64_t k = 0; k < n; ++k)
        if (index[k] < 0 || index[k] >= end) return false;
    return true;
}

static bool rise_to(int64_t n, const int64_t *start, int64_t end)
{
    if (start[0] != 0 || start[n] != end) return false;
    for (int64_t k = 0; k < n; ++k)
        if (start[k] > start[k + 1]) return false;
    return true;
}

static brc_status read_cells(const brc_h5_read *h5, brc_report_frame *f)
{
    int64_t n_ids, n_starts, n_face_ids, n_face_starts = 1;
    const hid_t type = H5T_NATIVE_INT64;
    BRC_TRY(read_whole(h5, "VTKHDF/Points", H5T_NATIVE_FLOAT, -1, 3, &f->point, &f->n_points));
    BRC_TRY(read_whole(h5, "VTKHDF/Offsets", type, -1, 1, &f->cell_start, &n_starts));
    BRC_TRY(read_whole(h5, "VTKHDF/Connectivity", type, -1, 1, &f->cell_point, &n_ids));
    f->n_elements = n_starts - 1;
    bool good =
        n_starts > 1 && rise_to(f->n_elements, f->cell_start, n_ids) && are_below(n_ids, f->cell_point, f->n_points);
    if (brc_h5_read_has(h5, "VTKHDF/FaceOffsets")) {
        BRC_TRY(read_whole(h5, "VTKHDF/FaceOffsets", type, -1, 1, &f->face_start, &n_face_starts));
        f->n_faces = n_face_starts - 1;
        BRC_TRY(read_whole(h5, "VTKHDF/FaceConnectivity", type, -1, 1, &f->face_point, &n_face_ids));
        BRC_TRY(read_whole(h5, "VTKHDF/PolyhedronOffsets", type, n_starts, 1, &f->cell_face, NULL));
        good = good && n_face_starts > 0 && rise_to(f->n_faces, f->face_start, n_face_ids) &&
               rise_to(f->n_elements, f->cell_face, f->n_faces) && are_below(n_face_ids, f->face_point, f->n_points);
    }
    if (brc_h5_read_has(h5, "VTKHDF/PointData/radius"))
        BRC_TRY(read_whole(h5, "VTKHDF/PointData/radius", H5T_NATIVE_FLOAT, f->n_points, 1, &f->radius, NULL));
    if (good) return BRC_OK;
    return BRC_FAIL(h5->context, BRC_BAD_INPUT,
                    "%s: its cells refer to points or faces that are not there; the file is damaged", h5->path);
}

static brc_status read_fields(const brc_h5_read *h5, brc_report_frame *f)
{
    float *velocity = NULL;
    brc_status status = BRC_OK;
    const hid_t type = H5T_NATIVE_FLOAT;
    BRC_TRY(read_whole(h5, "VTKHDF/PointData/displacement", type, f->n_points, 3, &f->displacement, NULL));
    BRC_TRY(read_whole(h5, "VTKHDF/CellData/von_mises", type, f->n_elements, 1, &f->von_mises, NULL));
    BRC_TRY(BRC_ALLOCATE(h5->context, &f->speed, f->n_elements, "speed of elements"));
    BRC_TRY_OR(cleanup, read_whole(h5, "VTKHDF/CellData/velocity", type, f->n_elements, 3, &velocity, NULL));
    for (int64_t e = 0; e < f->n_elements; ++e)
        f->speed[e] = hypotf(hypotf(velocity[3 * e], velocity[3 * e + 1]), velocity[3 * e + 2]);
    if (f->n_broken < 0) goto cleanup;
    BRC_TRY_OR(cleanup, read_whole(h5, "VTKHDF/CellData/damage", type, f->n_elements, 1, &f->damage, NULL));
    status = read_whole(h5, "VTKHDF/CellData/fragment", H5T_NATIVE_INT32, f->n_elements, 1, &f->fragment, NULL);
cleanup:
    brc_memory_free(velocity);
    return status;
}

brc_status brc_report_frame_read(brc_context *context, const char *folder, int64_t number, brc_report_frame *out)
{
    char *path = NULL;
    brc_h5_read h5;
    *out = (brc_report_frame){0};
    BRC_TRY(path_of(context, folder, number, &path));
    brc_status status = brc_h5_read_open(context, path, &h5);
    if (status == BRC_OK) {
        status = read_moment(&h5, out);
        if (status == BRC_OK) status = read_cells(&h5, out);
        if (status == BRC_OK) status = read_fields(&h5, out);
        brc_h5_read_close(&h5);
    }
    brc_memory_free(path);
    if (status != BRC_OK) brc_report_frame_free(out);
    return status;
}

void brc_report_frame_free(brc_report_frame *f)
{
    void *const all[] = {f->point,      f->displacement, f->radius,    f->cell_start, f->cell_point, f->cell_face,
                         f->face_start, f->face_point,   f->von_mises, f->speed,      f->damage,     f->fragment};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k)
        brc_memory_free(all[k]);
    *f = (brc_report_frame){0};
}

bool brc_report_frame_is_sphere(const brc_report_frame *f, int64_t e)
{
    return !f->cell_face || f->cell_face[e] == f->cell_face[e + 1];
}
