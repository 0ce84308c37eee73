/* A rotated area vector and its twin stay exactly opposite, and equal centroids stay equal: both sides go through the
 * same operations. */
#include "pose.h"

#include <math.h>

/* Rodrigues' formula. */
void brc_pose_matrix(const double v[3], double m[3][3])
{
    const double angle = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const double s = angle > 0.0 ? sin(angle) / angle : 1.0;
    const double half = sin(0.5 * angle), c = angle > 0.0 ? 2.0 * half * half / (angle * angle) : 0.5;
    const double k[3][3] = {{0.0, -v[2], v[1]}, {v[2], 0.0, -v[0]}, {-v[1], v[0], 0.0}};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            double square = 0.0;
            for (int l = 0; l < 3; ++l)
                square += k[i][l] * k[l][j];
            m[i][j] = (i == j) + s * k[i][j] + c * square;
        }
}

static void turn(const double m[3][3], double *vector, int64_t n)
{
    for (double *x = vector; x < vector + 3 * n; x += 3) {
        const double y[3] = {x[0], x[1], x[2]};
        for (int i = 0; i < 3; ++i)
            x[i] = m[i][0] * y[0] + m[i][1] * y[1] + m[i][2] * y[2];
    }
}

static void move(const double m[3][3], const double origin[3], const double translation[3], double *point, int64_t n,
                 bool rotate)
{
    for (double *x = point; x < point + 3 * n; x += 3) {
        if (rotate) {
            for (int i = 0; i < 3; ++i)
                x[i] -= origin[i];
            turn(m, x, 1);
            for (int i = 0; i < 3; ++i)
                x[i] += origin[i];
        }
        for (int i = 0; i < 3; ++i)
            x[i] += translation[i];
    }
}

/* I' = M I M^T for the tensor xx yy zz yz xz xy. */
static void turn_tensor(const double m[3][3], double t[6])
{
    const double a[3][3] = {{t[0], t[5], t[4]}, {t[5], t[1], t[3]}, {t[4], t[3], t[2]}};
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    for (int q = 0; q < 6; ++q) {
        t[q] = 0.0;
        for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l)
                t[q] += m[row[q]][k] * a[k][l] * m[column[q]][l];
    }
}

/* From the corners of cells, or the spheres. */
static void set_bounds(brc_domain *domain, int64_t n_vertices)
{
    const bool cells = domain->element_kind == BRC_ELEMENT_CELL;
    const double *x = cells ? domain->vertex : domain->position;
    for (int d = 0; d < 3; ++d) {
        domain->bounds[0][d] = HUGE_VAL;
        domain->bounds[1][d] = -HUGE_VAL;
    }
    for (int64_t p = 0; p < (cells ? n_vertices : domain->n_elements); ++p)
        for (int d = 0; d < 3; ++d) {
            const double r = cells ? 0.0 : domain->radius[p];
            domain->bounds[0][d] = fmin(domain->bounds[0][d], x[3 * p + d] - r);
            domain->bounds[1][d] = fmax(domain->bounds[1][d], x[3 * p + d] + r);
        }
}

void brc_pose_apply(const double origin[3], const double rotation[3], const double translation[3], brc_domain *domain)
{
    const bool cells = domain->element_kind == BRC_ELEMENT_CELL;
    const int64_t n = domain->n_elements, n_vertices = cells ? domain->vertex_start[n] : 0;
    const bool rotate = rotation[0] != 0.0 || rotation[1] != 0.0 || rotation[2] != 0.0;
    const bool translate = translation[0] != 0.0 || translation[1] != 0.0 || translation[2] != 0.0;
    double m[3][3];
    brc_pose_matrix(rotation, m);
    if (rotate || translate) {
        move(m, origin, translation, domain->position, n, rotate);
        move(m, origin, translation, domain->centroid, n, rotate);
    }
    if ((rotate || translate) && cells) {
        move(m, origin, translation, domain->face_centroid, domain->n_half_edges, rotate);
        move(m, origin, translation, domain->free_centroid, domain->n_free_faces, rotate);
        move(m, origin, translation, domain->vertex, n_vertices, rotate);
    }
    if (rotate && cells) { /* the inertia of a sphere is the same whichever way it is turned */
        turn(m, domain->area_vector, domain->n_half_edges);
        turn(m, domain->free_area_vector, domain->n_free_faces);
        for (int64_t e = 0; e < n; ++e)
            turn_tensor(m, domain->inertia + 6 * e);
    }
    set_bounds(domain, n_vertices);
}
