/* The layout that every VTK reads; that of VTKHDF is known to the newest only. */
#include "vtu_faces.h"
#include "../../base/memory.h"

/* Arrays of a frame's polyhedra. */
enum { POINTS, POINT_STARTS, FACES, FACE_STARTS, N_ARRAYS };
static const char *const NAME[N_ARRAYS] = {"VTKHDF/FaceConnectivity", "VTKHDF/FaceOffsets", "VTKHDF/PolyhedronToFaces",
                                           "VTKHDF/PolyhedronOffsets"};

typedef struct frame_faces {
    int64_t n[N_ARRAYS], *data[N_ARRAYS];
} frame_faces;

static brc_status load(const brc_h5_read *h5, frame_faces *f)
{
    for (int k = 0; k < N_ARRAYS; ++k) {
        int64_t columns;
        BRC_TRY(brc_h5_read_size(h5, NAME[k], &f->n[k], &columns));
        BRC_TRY(BRC_ALLOCATE(h5->context, &f->data[k], f->n[k], "faces of a frame"));
        BRC_TRY(brc_h5_read_rows(h5, NAME[k], H5T_NATIVE_INT64, 0, f->n[k], f->data[k]));
    }
    return BRC_OK;
}

/* Starts ascend from 0 to what they are the starts of, and every face is there. */
static bool is_whole(const frame_faces *f)
{
    for (int k = POINT_STARTS; k < N_ARRAYS; k += 2) {
        const int64_t n = f->n[k];
        if (n < 1 || f->data[k][0] != 0 || f->data[k][n - 1] != f->n[k - 1]) return false;
        for (int64_t m = 1; m < n; ++m)
            if (f->data[k][m] < f->data[k][m - 1]) return false;
    }
    for (int64_t m = 0; m < f->n[FACES]; ++m)
        if (f->data[FACES][m] < 0 || f->data[FACES][m] + 1 >= f->n[POINT_STARTS]) return false;
    return true;
}

static void fill(const frame_faces *f, brc_vtu_faces *out)
{
    out->n = 0;
    for (int64_t e = 0; e < out->n_cells; ++e) {
        const int64_t first = f->data[FACE_STARTS][e], end = f->data[FACE_STARTS][e + 1];
        if (out->stream && end > first) out->stream[out->n] = end - first;
        out->n += end > first;
        for (int64_t m = first; m < end; ++m) {
            const int64_t face = f->data[FACES][m], begin = f->data[POINT_STARTS][face],
                          n = f->data[POINT_STARTS][face + 1] - begin;
            for (int64_t k = 0; out->stream && k < n; ++k)
                out->stream[out->n + 1 + k] = f->data[POINTS][begin + k];
            if (out->stream) out->stream[out->n] = n;
            out->n += n + 1;
        }
        out->end[e] = end > first ? out->n : -1;
    }
}

brc_status brc_vtu_faces_of_frame(const brc_h5_read *h5, brc_vtu_faces *out)
{
    frame_faces f = {.n = {0}};
    brc_status status = BRC_OK;
    *out = (brc_vtu_faces){.n = 0};
    if (!brc_h5_read_has(h5, NAME[FACE_STARTS])) return BRC_OK;
    BRC_TRY_OR(cleanup, load(h5, &f));
    if (!is_whole(&f)) {
        status = BRC_FAIL(h5->context, BRC_BAD_INPUT,
                          "%s: the faces of its polyhedra do not fit together; the file is damaged", h5->path);
        goto cleanup;
    }
    out->n_cells = f.n[FACE_STARTS] - 1;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(h5->context, &out->end, out->n_cells, "faces of a frame"));
    fill(&f, out);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(h5->context, &out->stream, out->n, "faces of a frame"));
    fill(&f, out);
cleanup:
    for (int k = 0; k < N_ARRAYS; ++k)
        brc_memory_free(f.data[k]);
    if (status != BRC_OK) brc_vtu_faces_free(out);
    return status;
}

brc_status brc_vtu_faces_of_cells(brc_context *context, const brc_tessellation *cells, brc_vtu_faces *out)
{
    const int64_t n = cells->domain->n_elements;
    int64_t most_points, most_faces, most_corners;
    int32_t *count = NULL, *point = NULL;
    brc_status status = BRC_OK;
    *out = (brc_vtu_faces){.n_cells = n};
    brc_tessellation_most(cells, &most_points, &most_faces, &most_corners);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &count, most_faces, "faces of a cell"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &point, most_corners, "points of a cell"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->end, n, "faces of cells"));
    BRC_TRY_OR(cleanup,
               BRC_ALLOCATE(context, &out->stream, n + cells->face_start[n] + cells->loop_start[n], "faces of cells"));
    for (int64_t e = 0; e < n; ++e) {
        const int64_t n_faces = brc_tessellation_faces(cells, e, count, point);
        out->stream[out->n++] = n_faces;
        for (int64_t f = 0, at = 0; f < n_faces; ++f) {
            out->stream[out->n++] = count[f];
            for (int32_t k = 0; k < count[f]; ++k)
                out->stream[out->n++] = point[at++];
        }
        out->end[e] = out->n;
    }
cleanup:
    brc_memory_free(count);
    brc_memory_free(point);
    if (status != BRC_OK) brc_vtu_faces_free(out);
    return status;
}

void brc_vtu_faces_free(brc_vtu_faces *faces)
{
    brc_memory_free(faces->stream);
    brc_memory_free(faces->end);
    *faces = (brc_vtu_faces){.n = 0};
}

void brc_vtu_faces_arrays(const brc_vtu_faces *faces, brc_vtu_array arrays[BRC_VTU_FACE_ARRAYS])
{
    arrays[0] =
        (brc_vtu_array){BRC_VTU_CELLS, "faces", BRC_VTU_INT64, 1, faces->n, brc_vtu_from_memory, faces->stream, 0};
    arrays[1] = (brc_vtu_array){BRC_VTU_CELLS,  "faceoffsets",       BRC_VTU_INT64, 1,
                                faces->n_cells, brc_vtu_from_memory, faces->end,    0};
}
