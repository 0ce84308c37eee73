/* All strikers' faces are put together in memory, then written. */
#include "striker_file.h"
#include "vtu.h"
#include "../../base/memory.h"

enum { POLYGON = 7, N_VECTORS = 4 };
static const char *const VECTOR_NAME[N_VECTORS] = {"velocity", "spin", "force", "torque"};

typedef struct faces {
    int64_t n_points, n_corners, n_faces; /* n_corners: of all polygons */
    float *point, *moved;                 /* [n_points][3] */
    int64_t *id, *end, *striker;          /* [n_corners], [n_faces], [n_faces] */
    uint8_t *type;                        /* [n_faces] */
    double *vector[N_VECTORS];            /* [n_faces][3] */
} faces;

/* u + (R - 1) r = u + 2 w (v x r) + 2 v x (v x r) */
void brc_striker_corner_moved(const brc_striker_surface *surface, const brc_striker_now *now, int32_t k, double out[3])
{
    const double *r = surface->corner + 3 * (int64_t)k, *q = now->orientation;
    double once[3];
    for (int c = 0; c < 3; ++c)
        once[c] = 2 * (q[1 + (c + 1) % 3] * r[(c + 2) % 3] - q[1 + (c + 2) % 3] * r[(c + 1) % 3]);
    for (int c = 0; c < 3; ++c)
        out[c] = now->displacement[c] + q[0] * once[c] + q[1 + (c + 1) % 3] * once[(c + 2) % 3] -
                 q[1 + (c + 2) % 3] * once[(c + 1) % 3];
}

static brc_status allocate(brc_context *context, faces *f)
{
    const char *what = "faces of strikers";
    BRC_TRY(BRC_ALLOCATE(context, &f->point, 3 * f->n_points, what));
    BRC_TRY(BRC_ALLOCATE(context, &f->moved, 3 * f->n_points, what));
    BRC_TRY(BRC_ALLOCATE(context, &f->id, f->n_corners, what));
    BRC_TRY(BRC_ALLOCATE(context, &f->end, f->n_faces, what));
    BRC_TRY(BRC_ALLOCATE(context, &f->striker, f->n_faces, what));
    BRC_TRY(BRC_ALLOCATE(context, &f->type, f->n_faces, what));
    for (int k = 0; k < N_VECTORS; ++k)
        BRC_TRY(BRC_ALLOCATE(context, &f->vector[k], 3 * f->n_faces, what));
    f->n_points = f->n_corners = f->n_faces = 0; /* to be counted again */
    return BRC_OK;
}

static void add_striker(faces *f, const brc_striker_body *body, const brc_striker_now *now, int32_t striker)
{
    const brc_striker_surface *s = &body->surface;
    const double *const vector[N_VECTORS] = {now->velocity, now->spin, now->force, now->torque};
    for (int64_t face = 0; face < s->n_faces; ++face, ++f->n_faces) {
        for (int32_t k = s->loop_start[face]; k < s->loop_start[face + 1]; ++k)
            f->id[f->n_corners++] = f->n_points + s->loop[k];
        f->end[f->n_faces] = f->n_corners;
        f->type[f->n_faces] = POLYGON;
        f->striker[f->n_faces] = striker;
        for (int k = 0; k < N_VECTORS; ++k)
            for (int c = 0; c < 3; ++c)
                f->vector[k][3 * f->n_faces + c] = vector[k][c];
    }
    for (int32_t k = 0; k < s->n_corners; ++k, ++f->n_points) {
        double u[3];
        brc_striker_corner_moved(s, now, k, u);
        for (int c = 0; c < 3; ++c) {
            f->point[3 * f->n_points + c] = (float)(body->centre[c] + s->corner[3 * (int64_t)k + c]);
            f->moved[3 * f->n_points + c] = (float)u[c];
        }
    }
}

static brc_status write_faces(brc_context *context, const faces *f, double time, const char *path)
{
    brc_vtu_array list[16];
    int m = 0;
    list[m++] = (brc_vtu_array){BRC_VTU_FIELD_DATA, "TimeValue", BRC_VTU_FLOAT64, 1, 1, brc_vtu_from_memory, &time, 0};
    list[m++] =
        (brc_vtu_array){BRC_VTU_POINTS, "Points", BRC_VTU_FLOAT32, 3, f->n_points, brc_vtu_from_memory, f->point, 0};
    list[m++] =
        (brc_vtu_array){BRC_VTU_CELLS, "connectivity", BRC_VTU_INT64, 1, f->n_corners, brc_vtu_from_memory, f->id, 0};
    list[m++] = (brc_vtu_array){BRC_VTU_CELLS, "offsets", BRC_VTU_INT64, 1, f->n_faces, brc_vtu_from_memory, f->end, 0};
    list[m++] = (brc_vtu_array){BRC_VTU_CELLS, "types", BRC_VTU_UINT8, 1, f->n_faces, brc_vtu_from_memory, f->type, 0};
    list[m++] = (brc_vtu_array){BRC_VTU_POINT_DATA, "displacement",      BRC_VTU_FLOAT32, 3,
                                f->n_points,        brc_vtu_from_memory, f->moved,        0};
    list[m++] =
        (brc_vtu_array){BRC_VTU_CELL_DATA, "striker", BRC_VTU_INT64, 1, f->n_faces, brc_vtu_from_memory, f->striker, 0};
    for (int k = 0; k < N_VECTORS; ++k)
        list[m++] = (brc_vtu_array){BRC_VTU_CELL_DATA, VECTOR_NAME[k],      BRC_VTU_FLOAT64, 3,
                                    f->n_faces,        brc_vtu_from_memory, f->vector[k],    0};
    return brc_vtu_write(context, path, f->n_points, f->n_faces, m, list);
}

brc_status brc_striker_file_write(brc_context *context, const brc_assembly *assembly, const char *path)
{
    brc_simulation *s = assembly->part[0]; /* strikers and several models are refused together */
    const int32_t n = brc_simulation_n_strikers(s);
    faces f = {0};
    brc_status status = BRC_OK;
    for (int32_t i = 0; i < n; ++i) {
        const brc_striker_surface *surface = &brc_simulation_striker_body(s, i)->surface;
        f.n_points += surface->n_corners;
        f.n_faces += surface->n_faces;
        f.n_corners += surface->n_faces > 0 ? surface->loop_start[surface->n_faces] : 0;
    }
    BRC_TRY_OR(cleanup, allocate(context, &f));
    for (int32_t i = 0; i < n; ++i) {
        brc_striker_now now;
        BRC_TRY_OR(cleanup, brc_simulation_striker_now(s, i, &now));
        add_striker(&f, brc_simulation_striker_body(s, i), &now, i);
    }
    status = write_faces(context, &f, brc_simulation_total_time(s), path);
cleanup:
    brc_memory_free(f.point);
    brc_memory_free(f.moved);
    brc_memory_free(f.id);
    brc_memory_free(f.end);
    brc_memory_free(f.striker);
    brc_memory_free(f.type);
    for (int k = 0; k < N_VECTORS; ++k)
        brc_memory_free(f.vector[k]);
    return status;
}
