/* Matrices of round solids by quadrature: Gauss-Legendre points along straight coordinates, equal angles around, an
 * eighth of the solid. Products of two functions of one class are even along x, y and z, and polynomials; as many
 * points are taken as integrate them exactly. */
#include "reference_gauss.h"
#include "reference_vibration_internal.h"
#include "../../base/memory.h"
#include <math.h>
#include <string.h>

enum { ORDER = 24, DEGREES = 21, STRAINS = 7 };
static const double pi = 3.14159265358979323846;

/* What a point of the solid adds to both matrices. at: in [-1, 1] of the bounding box. */
typedef struct filling {
    const brc_reference_solid *solid;
    int degree, size;
    const brc_reference_function *basis;
    double *stiffness, *mass;
    double *strain; /* [STRAINS][size] of every function: divergence, xx, yy, zz, yz, xz, xy */
    double *value;  /* [size] */
} filling;

static void add_point(const filling *f, const double at[3], double weight)
{
    static const int shear[3][3] = {{-1, 6, 5}, {6, -1, 4}, {5, 4, -1}};
    double p[3][DEGREES], d[3][DEGREES];
    const brc_reference_solid *solid = f->solid;
    const double mu = solid->young / (2 * (1 + solid->poisson)) / solid->density,
                 lambda = 2 * mu * solid->poisson / (1 - 2 * solid->poisson);
    const double stiff[STRAINS] = {lambda, 2 * mu, 2 * mu, 2 * mu, mu, mu, mu};
    for (int c = 0; c < 3; ++c)
        for (int k = 0; k <= f->degree; ++k) {
            brc_reference_legendre(k, at[c], &p[c][k], &d[c][k]);
            p[c][k] *= sqrt(k + 0.5);
            d[c][k] *= sqrt(k + 0.5) * 2 / solid->size[c];
        }
    memset(f->strain, 0, (size_t)STRAINS * (size_t)f->size * sizeof *f->strain);
    for (int r = 0; r < f->size; ++r) {
        const int *n = f->basis[r].degree, i = f->basis[r].component;
        const double slope[3] = {d[0][n[0]] * p[1][n[1]] * p[2][n[2]], p[0][n[0]] * d[1][n[1]] * p[2][n[2]],
                                 p[0][n[0]] * p[1][n[1]] * d[2][n[2]]};
        f->value[r] = p[0][n[0]] * p[1][n[1]] * p[2][n[2]];
        f->strain[r] = slope[i];
        for (int j = 0; j < 3; ++j)
            f->strain[(int64_t)(j == i ? 1 + i : shear[i][j]) * f->size + r] = slope[j];
    }
    for (int r = 0; r < f->size; ++r) {
        double *row = f->stiffness + (int64_t)r * f->size;
        for (int s = 0; s < STRAINS; ++s) {
            const double *strain = f->strain + (int64_t)s * f->size, factor = weight * stiff[s] * strain[r];
            for (int c = r; factor != 0 && c < f->size; ++c)
                row[c] += factor * strain[c];
        }
        for (int c = r; c < f->size; ++c)
            if (f->basis[c].component == f->basis[r].component)
                f->mass[(int64_t)r * f->size + c] += weight * f->value[r] * f->value[c];
    }
}

/* Weights are those of the box mapped to [-1, 1]^3; a common factor of both matrices does not matter. */
static void add_cylinder(const filling *f, int n, const double *x, const double *w)
{
    for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b) /* in the square of the radius: only even powers are left around the axis */
            for (int k = 0; k < n; ++k) {
                const double angle = pi / 2 * (k + 0.5) / n, radius = sqrt(x[b]);
                add_point(f, (double[3]){x[a], radius * cos(angle), radius * sin(angle)}, w[a] * w[b] / n);
            }
}

static void add_sphere(const filling *f, int n, const double *x, const double *w)
{
    for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b)
            for (int k = 0; k < n; ++k) {
                const double angle = pi / 2 * (k + 0.5) / n, across = x[b] * sqrt(1 - x[a] * x[a]);
                add_point(f, (double[3]){x[b] * x[a], across * cos(angle), across * sin(angle)},
                          w[a] * w[b] * x[b] * x[b] / n);
            }
}

brc_status brc_reference_round_fill(brc_context *context, const brc_reference_solid *solid, int degree, int size,
                                    const brc_reference_function *basis, double *stiffness, double *mass)
{
    double x[ORDER], w[ORDER];
    const int n = degree + 2; /* degree 2 degree + 2 in the radius of a sphere */
    filling f = {.solid = solid, .degree = degree, .size = size, .basis = basis, .stiffness = stiffness, .mass = mass};
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup,
               BRC_ALLOCATE(context, &f.strain, (int64_t)STRAINS * size, "strains of the vibration of a solid"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &f.value, size, "vibration of a solid"));
    brc_reference_gauss(n, x, w);
    if (solid->shape == BRC_REFERENCE_SPHERE)
        add_sphere(&f, n, x, w);
    else
        add_cylinder(&f, n, x, w);
cleanup:
    brc_memory_free(f.strain);
    brc_memory_free(f.value);
    return status;
}
