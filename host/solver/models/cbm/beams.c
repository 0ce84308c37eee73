/* Model cbm on the host: beams of each material and body, their diagonal blocks, and the time step that follows from
 * them. */
#include "../../laws/beam_law.h"
#include "cbm_internal.h"
#include "beam_closure.h"
#include "beam_softening.h"
#include "../../effects/fracture/breaking.h"
#include "../../core/sym6.h"
#include <lapacke.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Mean radius and half width of the spread of each body's spheres. */
typedef struct body_radii {
    double sum, least, most;
    int64_t n;
} body_radii;

static brc_status find_radii(brc_simulation *s, body_radii *radii)
{
    const brc_domain *d = s->domain;
    for (int32_t b = 0; b < s->scene->n_bodies; ++b)
        radii[b] = (body_radii){.least = INFINITY};
    for (int64_t e = 0; e < d->n_elements; ++e) {
        body_radii *r = &radii[d->body[e] < s->scene->n_bodies ? d->body[e] : 0];
        r->sum += d->radius[e];
        r->least = fmin(r->least, d->radius[e]);
        r->most = fmax(r->most, d->radius[e]);
        r->n += 1;
    }
    return BRC_OK;
}

/* r_m and E_m of a material: as given, or by the law for the sample. */
static brc_status micro_parameters(brc_simulation *s, const brc_material *material, int32_t body, const body_radii *r,
                                   double *ratio, double *young)
{
    brc_beam_body bonds;
    *ratio = material->beam_radius;
    *young = material->beam_young;
    if (*ratio > 0) return BRC_OK;
    const double mean = r->sum / (double)r->n;
    const brc_beam_law *law = brc_beam_law_for((r->most - r->least) / (2 * mean));
    bool outside = false;
    BRC_TRY(brc_beam_body_of(s->context, s->domain, body, &bonds));
    BRC_TRY(brc_beam_law_invert(s->context, law, &bonds, material->poisson, material->young, ratio, young, &outside));
    brc_log(s->context, outside ? BRC_LOG_WARNING : BRC_LOG_INFO,
            "material '%s': r_m = %.4f, E_m = %.5g Pa by the law for %s at coordination number %.4g, as of cubes of 10 "
            "000 spheres with %.4g%s",
            material->name, *ratio, *young, law->name, bonds.coordination, brc_beam_law_coordination(law, &bonds),
            outside ? "; r_m is outside the range the law was fitted in" : "");
    return BRC_OK;
}

static brc_status refuse_isolated(brc_simulation *s)
{
    const brc_domain *d = s->domain;
    int64_t n = 0;
    char ids[160] = "";
    for (int64_t e = 0; e < d->n_elements; ++e) {
        if (d->row_start[e + 1] > d->row_start[e]) continue;
        const size_t at = strlen(ids);
        if (n++ < 8) snprintf(ids + at, sizeof ids - at, "%s%lld", n > 1 ? ", " : "", (long long)e);
    }
    if (n == 0) return BRC_OK;
    if (s->scene->has_contact && !s->scene->model.keep_isolated) {
        brc_log(s->context, BRC_LOG_INFO,
                "%lld elements have no bond: they are loose, and meet the others by contact alone", (long long)n);
        return BRC_OK;
    }
    if (!s->scene->model.keep_isolated)
        return BRC_FAIL(
            s->context, BRC_BAD_INPUT,
            "model cbm: %lld elements have no bond (%s%s); raise the coordination number under `beams`, or set "
            "model: {cbm: {keep_isolated: true}} to hold them still",
            (long long)n, ids, n > 8 ? ", ..." : "");
    brc_log(s->context, BRC_LOG_WARNING, "%lld elements have no bond and stay where they are (%s%s)", (long long)n, ids,
            n > 8 ? ", ..." : "");
    return BRC_OK;
}

brc_status brc_beams_create(brc_simulation *s)
{
    const brc_scene *scene = s->scene;
    BRC_FREED body_radii *radii = NULL;
    if (s->domain->element_kind != BRC_ELEMENT_SPHERE)
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "model cbm needs spheres joined by beams, the bodies are cells; add `beams: {coordination: 8}` "
                        "and a fill with radii "
                        "to each body");
    BRC_TRY(refuse_isolated(s));
    BRC_TRY(BRC_ALLOCATE(s->context, &radii, scene->n_bodies, "radii of bodies"));
    BRC_TRY(BRC_ALLOCATE(s->context, &brc_cbm_own_of(s)->beam, (int64_t)scene->n_bodies * scene->n_materials, "beams"));
    BRC_TRY(find_radii(s, radii));
    for (int32_t b = 0; b < scene->n_bodies; ++b)
        for (int32_t m = 0; m < scene->n_materials; ++m) {
            brc_beam *beam = &brc_cbm_own_of(s)->beam[b * scene->n_materials + m];
            double ratio, young;
            if (!brc_body_uses(&scene->bodies[b], m) || radii[b].n == 0)
                continue; /* a material that the body lacks may be out of reach of its law */
            BRC_TRY(micro_parameters(s, &scene->materials[m], b, &radii[b], &ratio, &young));
            beam->radius = ratio * radii[b].sum / (double)radii[b].n;
            const double square = beam->radius * beam->radius, bending = M_PI * square * square / 4;
            beam->axial = young * M_PI * square;
            beam->bend = 2 * young * bending;
            beam->twist = young / (2 * (1 + scene->model.beam_poisson)) * 2 * bending;
        }
    return BRC_OK;
}

const brc_beam *brc_beam_of_element(const brc_simulation *s, int64_t e)
{
    const int32_t b = s->domain->body[e] < s->scene->n_bodies ? s->domain->body[e] : 0;
    return &brc_cbm_own_of(s)->beam[b * s->scene->n_materials + s->material_of_element[e]];
}

brc_status brc_beams_upload(brc_simulation *s)
{
    if (!brc_device_has_many_materials(s->device)) return BRC_OK;
    const brc_layout *layout = s->layout;
    BRC_FREED double *rows = NULL;
    brc_status status = BRC_ALLOCATE(s->context, &rows, 3 * (int64_t)layout->n_rows, "beams of elements");
    for (int32_t r = 0; status == BRC_OK && r < layout->n_rows; ++r) {
        const int32_t e = layout->element_of_row[r];
        const brc_beam *beam = brc_beam_of_element(s, e < 0 ? 0 : e);
        rows[3 * (int64_t)r] = beam->axial;
        rows[3 * (int64_t)r + 1] = beam->bend;
        rows[3 * (int64_t)r + 2] = beam->twist;
    }
    return status == BRC_OK ? brc_upload_coeff(s, brc_beam_array_of(s), rows, 3 * (int64_t)layout->n_rows) : status;
}

/* Diagonal block of element e (docs/notebook/beams.md), full, u before theta: sum over its beams of
 * translation ka n n^T + (6 A / l^2)(1 - n n^T), rotation 2 A (1 - n n^T) + kt n n^T, coupling (3 A / l) [n]x. */
static void diagonal_block(const brc_simulation *s, int64_t e, double k[6][6])
{
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    const brc_domain *d = s->domain;
    const brc_beam *own = brc_beam_of_element(s, e), *before = NULL;
    double moved[6] = {0}, turned[6] = {0}, coupled[3] = {0}, axial = 0, bend = 0, twist = 0;
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        const int64_t j = d->neighbour[h];
        const brc_beam *other = brc_beam_of_element(s, j);
        double n[3], square = 0;
        for (int c = 0; c < 3; ++c) {
            n[c] = d->position[3 * j + c] - d->position[3 * e + c];
            square += n[c] * n[c];
        }
        const double length = sqrt(square);
        for (int c = 0; c < 3; ++c)
            n[c] /= length;
        if (other != before) {
            axial = brc_in_series(own->axial, other->axial);
            bend = brc_in_series(own->bend, other->bend);
            twist = brc_in_series(own->twist, other->twist);
            before = other;
        }
        const double ka = axial / length, a = bend / length, kt = twist / length;
        const double across = 6 * a / square, couple = 3 * a / length;
        for (int c = 0; c < 6; ++c) {
            const double nn = n[row[c]] * n[column[c]], rest = (c < 3) - nn;
            moved[c] += ka * nn + across * rest;
            turned[c] += 2 * a * rest + kt * nn;
        }
        for (int c = 0; c < 3; ++c)
            coupled[c] += couple * n[c];
    }
    memset(k, 0, 36 * sizeof(double));
    for (int c = 0; c < 6; ++c) {
        k[row[c]][column[c]] = k[column[c]][row[c]] = moved[c];
        k[row[c] + 3][column[c] + 3] = k[column[c] + 3][row[c] + 3] = turned[c];
    }
    for (int p = 0; p < 3; ++p) { /* energy of (u, theta): the end leans by -u/l across */
        const int q = (p + 1) % 3, r = (p + 2) % 3;
        k[p][q + 3] = k[q + 3][p] = coupled[r];
        k[p][r + 3] = k[r + 3][p] = -coupled[q];
    }
}

brc_status brc_beams_precondition_blocks(brc_simulation *s, double *out)
{
    const brc_layout *layout = s->layout;
    int failed = 0;
#pragma omp parallel for schedule(static) reduction(+ : failed)
    for (int32_t r = 0; r < layout->n_rows; ++r) {
        const int32_t e = layout->element_of_row[r];
        double k[6][6], *to = out + 21 * (int64_t)r;
        memset(to, 0, 21 * sizeof *to);
        if (e < 0 || s->domain->row_start[e + 1] == s->domain->row_start[e]) continue;
        diagonal_block(s, e, k);
        if (!brc_sym6_invert(k)) {
            ++failed;
            continue;
        }
        for (int a = 0, at = 0; a < 6; ++a)
            for (int b = a; b < 6; ++b)
                to[at++] = k[a][b];
    }
    if (failed) return BRC_FAIL(s->context, BRC_INTERNAL, "%d elements have a singular beam stiffness", failed);
    return BRC_OK;
}

brc_status brc_beams_node_bound(brc_simulation *s, double *out)
{
    const brc_domain *d = s->domain;
    double largest = 0;
    int failed = 0;
#pragma omp parallel for schedule(static) reduction(max : largest) reduction(+ : failed)
    for (int64_t e = 0; e < d->n_elements; ++e) {
        double k[6][6], values[6], work[64];
        const double density = s->elastic[s->material_of_element[e]].density, mass = d->volume[e] * density;
        const double inertia = density * (d->inertia[6 * e] + d->inertia[6 * e + 1] + d->inertia[6 * e + 2]) / 3;
        if (d->row_start[e + 1] == d->row_start[e]) continue;
        diagonal_block(s, e, k);
        for (int a = 0; a < 6; ++a)
            for (int b = 0; b < 6; ++b)
                k[a][b] /= sqrt((a < 3 ? mass : inertia) * (b < 3 ? mass : inertia));
        failed += LAPACKE_dsyev_work(LAPACK_ROW_MAJOR, 'N', 'U', 6, &k[0][0], 6, values, work, 64) != 0;
        if (values[5] > largest) largest = values[5];
    }
    if (failed) return BRC_FAIL(s->context, BRC_INTERNAL, "the eigenvalues of %d elements did not converge", failed);
    *out = largest > 0 ? 2 / sqrt(2 * largest) : INFINITY;
    return BRC_OK;
}

static brc_status virial(brc_simulation *s, double *out)
{
    brc_buffer *rows = NULL; /* asked for at samples and frames only: not kept */
    BRC_TRY(brc_new_coeff(s, &rows, 6 * (int64_t)s->layout->n_rows, "virial"));
    brc_status status = BRC_RUN(brc_cbm_own_of(s)->virial, s->n_groups, {"virial", BRC_BUF(rows)});
    if (status == BRC_OK) status = brc_beam_softening_virial(s, rows);
    if (status == BRC_OK) status = brc_beam_closure_virial(s, rows);
    if (status == BRC_OK) status = brc_coeff_from_rows(s, rows, out, 6);
    brc_buffer_free(&rows);
    return status;
}

/* Members of the average around element e: itself and `level` shells of neighbours, each once. mark[k] == e + 1:
 * already in. whole: unbroken half-edges, NULL: all. */
static int64_t collect(const brc_domain *d, const uint8_t *whole, int64_t e, int level, int32_t *mark, int32_t *member)
{
    int64_t n = 1, begin = 0;
    member[0] = (int32_t)e;
    mark[e] = (int32_t)e + 1;
    for (int shell = 0; shell < level; ++shell) {
        const int64_t end = n;
        for (; begin < end; ++begin)
            for (int64_t h = d->row_start[member[begin]]; h < d->row_start[member[begin] + 1]; ++h) {
                const int32_t j = d->neighbour[h];
                if (mark[j] == (int32_t)e + 1 || (whole && !whole[h])) continue;
                mark[j] = (int32_t)e + 1;
                member[n++] = j;
            }
    }
    return n;
}

brc_status brc_beams_stress(brc_simulation *s, int level, double *out)
{
    const brc_domain *d = s->domain;
    BRC_FREED uint8_t *whole = NULL;
    if (s->fracture) BRC_TRY(brc_fracture_whole(s, &whole));
    BRC_LOCAL(s->context, 6 * d->n_elements, double, sum, "virial");
    BRC_LOCAL(s->context, d->n_elements, int32_t, mark, "virial");
    BRC_LOCAL(s->context, d->n_elements, int32_t, member, "virial");
    BRC_TRY(virial(s, sum));
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const int64_t n = collect(d, whole, e, level, mark, member);
        double total[6] = {0}, volume = 0;
        for (int64_t k = 0; k < n; ++k) {
            volume += d->volume[member[k]];
            for (int c = 0; c < 6; ++c)
                total[c] += sum[6 * (int64_t)member[k] + c];
        }
        for (int c = 0; c < 6; ++c)
            out[6 * e + c] = total[c] / (2 * volume);
    }
    return BRC_OK;
}
