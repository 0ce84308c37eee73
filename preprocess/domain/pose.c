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

/* Elements [first, end) of which all is here; while a domain is built they are a range. */
typedef struct range {
    int64_t first, end;
} range;

static range range_here(const brc_domain *domain)
{
    range r = {0, domain->n_elements};
    while (r.first < r.end && !brc_domain_has(domain, r.first))
        ++r.first;
    while (r.end > r.first && !brc_domain_has(domain, r.end - 1))
        --r.end;
    return r;
}

/* From the corners of cells, or the spheres. */
static void set_bounds(brc_domain *domain, range here)
{
    const bool cells = domain->element_kind == BRC_ELEMENT_CELL;
    const double *x = cells ? domain->vertex : domain->position;
    const int64_t first = cells ? domain->vertex_start[here.first] : 0,
                  end = cells ? domain->vertex_start[here.end] : domain->n_elements;
    for (int d = 0; d < 3; ++d) {
        domain->bounds[0][d] = HUGE_VAL;
        domain->bounds[1][d] = -HUGE_VAL;
    }
    for (int64_t p = first; p < end; ++p)
        for (int d = 0; d < 3; ++d) {
            const double r = cells ? 0.0 : domain->radius[p];
            domain->bounds[0][d] = fmin(domain->bounds[0][d], x[3 * p + d] - r);
            domain->bounds[1][d] = fmax(domain->bounds[1][d], x[3 * p + d] + r);
        }
    for (int d = 0; d < 6; ++d)
        domain->bounds[d / 3][d % 3] += 0.0; /* 0 of either sign: which one is met first depends on the ranks */
}

/* Corners and shared faces of cells that are here. */
static void pose_cells(const double m[3][3], const double origin[3], const double translation[3], range here,
                       bool rotate, brc_domain *d)
{
    const int64_t h = d->row_start[here.first], n = d->row_start[here.end] - h, v = d->vertex_start[here.first];
    move(m, origin, translation, d->face_centroid + 3 * h, n, rotate);
    move(m, origin, translation, d->vertex + 3 * v, d->vertex_start[here.end] - v, rotate);
    if (rotate) turn(m, d->area_vector + 3 * h, n);
}

void brc_pose_apply(const double origin[3], const double rotation[3], const double translation[3], brc_domain *domain)
{
    const bool cells = domain->element_kind == BRC_ELEMENT_CELL;
    const int64_t n = domain->n_elements;
    const range here = range_here(domain);
    const bool rotate = rotation[0] != 0.0 || rotation[1] != 0.0 || rotation[2] != 0.0;
    const bool translate = translation[0] != 0.0 || translation[1] != 0.0 || translation[2] != 0.0;
    double m[3][3];
    brc_pose_matrix(rotation, m);
    if (rotate || translate) {
        move(m, origin, translation, domain->position, n, rotate);
        move(m, origin, translation, domain->centroid + 3 * here.first, here.end - here.first, rotate);
    }
    if ((rotate || translate) && cells) {
        pose_cells(m, origin, translation, here, rotate, domain);
        move(m, origin, translation, domain->free_centroid, domain->n_free_faces, rotate);
    }
    if (rotate && cells) { /* the inertia of a sphere is the same whichever way it is turned */
        turn(m, domain->free_area_vector, domain->n_free_faces);
        for (int64_t e = here.first; e < here.end; ++e)
            turn_tensor(m, domain->inertia + 6 * e);
    }
    set_bounds(domain, here);
}
