#include "report_rigid.h"
#include "report_pack.h"
#include "../frames/vtu_read.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include <stdio.h>
#include <string.h>

static brc_status path_of(brc_context *context, const char *folder, int64_t number, char **out)
{
    char name[48];
    snprintf(name, sizeof name, "frames/%06lld.strikers.vtu", (long long)number);
    return brc_file_join(context, folder, name, out);
}

static int64_t integer_at(const char *numbers, int64_t k)
{
    int64_t value;
    memcpy(&value, numbers + 8 * k, sizeof value);
    return value;
}

/* Polygons as fans of triangles. */
static brc_status pack_triangles(const brc_vtu_read *vtu, int64_t n_points, brc_report_pack *pack, int64_t *n_triangles)
{
    int64_t n_corners, n_faces;
    const char *corner, *end;
    BRC_TRY(brc_vtu_read_array(vtu, "connectivity", 8, &n_corners, &corner));
    BRC_TRY(brc_vtu_read_array(vtu, "offsets", 8, &n_faces, &end));
    *n_triangles = 0;
    for (int64_t f = 0, first = 0; f < n_faces; ++f) {
        const int64_t last = integer_at(end, f);
        if (last < first || last > n_corners)
            return BRC_FAIL(vtu->context, BRC_BAD_INPUT, "%s: polygon %lld ends at %lld of %lld corners", vtu->path,
                            (long long)f, (long long)last, (long long)n_corners);
        for (int64_t k = first + 1; k + 1 < last; ++k, ++*n_triangles) {
            const int64_t id[3] = {integer_at(corner, first), integer_at(corner, k), integer_at(corner, k + 1)};
            for (int i = 0; i < 3; ++i) {
                const int32_t small = id[i] >= 0 && id[i] < n_points ? (int32_t)id[i] : 0;
                brc_report_pack_bytes(pack, sizeof small, &small);
            }
        }
        first = last;
    }
    return BRC_OK;
}

static brc_status add_shape(const brc_vtu_read *vtu, brc_text *page, brc_json *json, int64_t *n_points)
{
    const char *point;
    int64_t n, n_triangles;
    brc_report_pack pack = {.context = vtu->context};
    BRC_TRY(brc_vtu_read_array(vtu, "Points", 4, &n, &point));
    *n_points = n / 3;
    brc_report_pack_bytes(&pack, 4 * n, point);
    brc_status status = pack_triangles(vtu, *n_points, &pack, &n_triangles);
    if (status == BRC_OK) status = pack.status;
    if (status == BRC_OK) {
        brc_json_begin_object(json, "rigid");
        brc_json_integer(json, "n_points", *n_points);
        brc_json_integer(json, "n_triangles", n_triangles);
        brc_json_end(json);
        status = brc_html_array(page, "view-rigid", pack.data, pack.n);
    }
    brc_report_pack_free(&pack);
    return status;
}

static brc_status add_moment(const brc_vtu_read *vtu, int64_t k, int64_t n_points, brc_text *page)
{
    char id[40];
    const char *moved;
    int64_t n;
    BRC_TRY(brc_vtu_read_array(vtu, "displacement", 4, &n, &moved));
    if (n != 3 * n_points)
        return BRC_FAIL(vtu->context, BRC_BAD_INPUT, "%s: %lld displacements of %lld points", vtu->path,
                        (long long)n / 3, (long long)n_points);
    snprintf(id, sizeof id, "view-rigid-%lld", (long long)k);
    return brc_html_array(page, id, moved, 4 * n);
}

brc_status brc_report_rigid(brc_context *context, const char *folder, int64_t n, const int64_t *number, brc_text *page,
                            brc_json *json)
{
    int64_t n_points = 0;
    for (int64_t k = 0; k < n; ++k) {
        char *path;
        brc_vtu_read vtu = {0};
        BRC_TRY(path_of(context, folder, number[k], &path));
        const bool there = brc_file_exists(path);
        brc_status status = there ? brc_vtu_read_open(context, path, &vtu) : BRC_OK;
        if (there && status == BRC_OK && k == 0) status = add_shape(&vtu, page, json, &n_points);
        if (there && status == BRC_OK) status = add_moment(&vtu, k, n_points, page);
        brc_vtu_read_close(&vtu);
        if (!there && n_points > 0)
            status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: missing, unlike those of earlier frames", path);
        brc_memory_free(path);
        BRC_TRY(status);
        if (!there) break;
    }
    return BRC_OK;
}
