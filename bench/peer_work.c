#include "peer_work.h"
#include "../host/output/text.h"
#include <math.h>

static double mass_of(const brc_peer_work *w, int64_t e)
{
    return w->density * w->domain->volume[e];
}

/* The ends and the length of a bond. */
static double branch_of(const brc_domain *d, int64_t b, int32_t *i, int32_t *j)
{
    const int32_t h = d->bond_half_edge[b];
    double square = 0;
    *j = d->neighbour[h];
    *i = d->neighbour[d->twin[h]];
    for (int c = 0; c < 3; ++c) {
        const double x = d->position[3 * (int64_t)*j + c] - d->position[3 * (int64_t)*i + c];
        square += x * x;
    }
    return sqrt(square);
}

/* Along, across, bending, twisting. */
static void stiffness(const brc_peer_work *w, double length, double out[4])
{
    out[0] = w->axial / length;
    out[1] = 12 * w->bend / (length * length * length);
    out[2] = w->bend / length;
    out[3] = w->twist / length;
}

static void add_numbers(brc_text *text, int n, const double *x, const char *between)
{
    for (int k = 0; k < n; ++k) {
        if (k) brc_text_add(text, "%s", between);
        brc_text_add_number(text, x[k]);
    }
}

brc_status brc_peer_work_write_tables(brc_context *context, const brc_peer_work *work, const char *folder)
{
    const brc_domain *d = work->domain;
    brc_text text = {.context = context};
    int32_t i, j;
    brc_text_add(&text, "x,y,z,radius,mass,inertia,vx,vy,vz\n");
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const double *x = &d->position[3 * e], *v = &work->velocity[3 * e];
        const double row[9] = {x[0], x[1], x[2], d->radius[e], mass_of(work, e), work->density * d->inertia[6 * e],
                               v[0], v[1], v[2]};
        add_numbers(&text, 9, row, ",");
        brc_text_add(&text, "\n");
    }
    BRC_TRY(brc_text_write_into(&text, folder, "elements.csv"));
    text = (brc_text){.context = context};
    brc_text_add(&text, "i,j,kn,ks,kr,ktw,length\n");
    for (int64_t b = 0; b < d->n_bonds; ++b) {
        double row[5];
        row[4] = branch_of(d, b, &i, &j);
        stiffness(work, row[4], row);
        brc_text_add(&text, "%d,%d,", i, j);
        add_numbers(&text, 5, row, ",");
        brc_text_add(&text, "\n");
    }
    return brc_text_write_into(&text, folder, "bonds.csv");
}

/* Shortest and longest branch. */
static void lengths(const brc_domain *d, double *least, double *most)
{
    int32_t i, j;
    *least = INFINITY;
    *most = 0;
    for (int64_t b = 0; b < d->n_bonds; ++b) {
        const double length = branch_of(d, b, &i, &j);
        *least = fmin(*least, length);
        *most = fmax(*most, length);
    }
}

double brc_peer_work_longest(const brc_peer_work *work)
{
    double least, most;
    lengths(work->domain, &least, &most);
    return most;
}

/* The types of bonds. */
typedef struct classes {
    bool each; /* every bond is one */
    int64_t n;
    double least, width; /* of the lengths, where they are classes [m] */
} classes;

static brc_status write_coefficients(brc_context *context, const brc_peer_work *work, bool turning, classes c,
                                     const char *folder)
{
    brc_text text = {.context = context};
    int32_t i, j;
    for (int64_t k = 0; k < c.n; ++k) {
        const double length = c.each ? branch_of(work->domain, k, &i, &j) : c.least + ((double)k + 0.5) * c.width;
        double s[4];
        stiffness(work, length, s);
        brc_text_add(&text, "bond_coeff %lld ", (long long)k + 1);
        if (turning) { /* twisting before bending; then strengths, then damping */
            const double row[4] = {s[0], s[1], s[3], s[2]};
            add_numbers(&text, 4, row, " ");
            brc_text_add(&text, " 1e30 1e30 1e30 1e30 0 0 0 0\n");
        } else { /* K (r - r0)^2 */
            const double row[2] = {0.5 * s[0], length};
            add_numbers(&text, 2, row, " ");
            brc_text_add(&text, "\n");
        }
    }
    return brc_text_write_into(&text, folder, "bonds.in");
}

brc_status brc_peer_work_write_lammps(brc_context *context, const brc_peer_work *work, bool turning, int n_types,
                                      const char *folder)
{
    const brc_domain *d = work->domain;
    brc_text text = {.context = context};
    double least, most;
    int32_t i, j;
    lengths(d, &least, &most);
    const bool each = n_types == 0;
    const classes c = {each, each ? d->n_bonds : n_types, least,
                       each ? 0 : fmax((most - least) / n_types, 1e-9 * most)};
    brc_text_add(&text, "breccia bench peers\n\n%lld atoms\n%lld bonds\n1 atom types\n%lld bond types\n\n",
                 (long long)d->n_elements, (long long)d->n_bonds, (long long)c.n);
    for (int x = 0; x < 3; ++x) /* room around, which nothing leaves */
        brc_text_add(&text, "%.17g %.17g %clo %chi\n", d->bounds[0][x] - most, d->bounds[1][x] + most, "xyz"[x],
                     "xyz"[x]);
    brc_text_add(&text, "\nAtoms # %s\n\n", turning ? "bpm/sphere" : "hybrid");
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const double *x = &d->position[3 * e],
                     sphere[2] = {2 * d->radius[e], mass_of(work, e) / brc_sphere_volume(d->radius[e])};
        brc_text_add(&text, "%lld %s", (long long)e + 1, turning ? "1 1 " : "1 ");
        add_numbers(&text, turning ? 2 : 3, turning ? sphere : x, " ");
        brc_text_add(&text, " ");
        add_numbers(&text, turning ? 3 : 2, turning ? x : sphere, " ");
        brc_text_add(&text, turning ? "\n" : " 1\n");
    }
    brc_text_add(&text, "\nVelocities\n\n");
    for (int64_t e = 0; e < d->n_elements; ++e) {
        brc_text_add(&text, "%lld ", (long long)e + 1);
        add_numbers(&text, 3, &work->velocity[3 * e], " ");
        brc_text_add(&text, " 0 0 0\n");
    }
    brc_text_add(&text, "\nBonds\n\n");
    for (int64_t b = 0; b < d->n_bonds; ++b) {
        const double length = branch_of(d, b, &i, &j);
        const int64_t type = c.each ? b : (int64_t)fmin((length - c.least) / c.width, (double)(c.n - 1));
        brc_text_add(&text, "%lld %lld %d %d\n", (long long)b + 1, (long long)type + 1, i + 1, j + 1);
    }
    BRC_TRY(brc_text_write_into(&text, folder, "packing.data"));
    return write_coefficients(context, work, turning, c, folder);
}
