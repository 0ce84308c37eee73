/* How soft surfaces of cells touch that would want a smaller time step than contact counts for
 * (bench/results/2026-11-30-slots.md). A point of a cell moves by u + H X = sum of c_j u_j over the cell and its
 * neighbours, so springs k on faces f press on the elements with M^-1 K = M^-1 sum of k_f c_f c_f^T, whose largest
 * eigenvalue is at most the largest row sum of (k_f k_g)^1/2 |c_f.M^-1 c_g|. */
#include "../../../../preprocess/domain/domain_rows.h"
#include "../../core/sym3.h"
#include "contact_internal.h"
#include <math.h>

static const double least_left = 0.05; /* of what holds a cell along a branch without its bond: less, and breaks take
                                          the cell off (models/dlsm/breaks.c) */
static const double endless = 3e38;    /* a limit that nothing reaches; finite in single precision [N/m, N/m^5] */

/* Surfaces count as those of regular cells up to the first of these, and are as soft as the second if they are stiffer:
 * their omega^2 over the 4 k / m of the time step, times the square of the step's safety (the 5 k / m of regular cells
 * are 0.8 at the default). Springs that act on one side only feed on each other long before they alone would be too
 * fast (bench/results/2026-11-30-slots.md). */
static const double regular = 0.83, soft = 0.35;

/* And of any, over that of a whole face of a cube that is as stiff as the solid, or stiffer by the laws given:
 * at safeties up to 0.8, and above. On rigid strikers no others: pressed flat against them, softer ones press unevenly.
 */
static const double at_most[] = {2, 1};

enum { BORNE = 4 }; /* c->bears of an element */

static void times(const double g[6], const double a[3], double out[3])
{
    out[0] = g[0] * a[0] + g[5] * a[1] + g[4] * a[2];
    out[1] = g[5] * a[0] + g[1] * a[1] + g[3] * a[2];
    out[2] = g[4] * a[0] + g[3] * a[1] + g[2] * a[2];
}

/* Of half-edge h of cell e the branch R and S / L. */
static double branch(const brc_domain *d, int64_t e, int64_t h, double r[3])
{
    for (int c = 0; c < 3; ++c)
        r[c] = d->position[3 * (int64_t)d->neighbour[h] + c] - d->position[3 * e + c];
    return brc_norm3(d->area_vector + 3 * h) / brc_norm3(r);
}

/* Inverse of the least-squares matrix A = sum (S / L) R (x) R of cell e. */
static void inverse_shape(const brc_simulation *s, int64_t e, double g[6])
{
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    const brc_domain *d = s->domain;
    double shape[6] = {0, 0, 0, 0, 0, 0}, r[3];
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        const double ratio = branch(d, e, h, r);
        for (int c = 0; c < 6; ++c)
            shape[c] += ratio * r[row[c]] * r[column[c]];
    }
    brc_sym3_pseudo_inverse(shape, brc_geometry_least_span(s), g);
}

/* 1 / m of a point of cell e at `arm` from its place, which moves by u_e + H arm = sum of c_j u_j: sum of c_j^2 / m_j,
 * c_j = arm . A^-1 s_j, c_e = 1 - sum of c_j [1/kg]. g: A^-1; lost: a half-edge whose bond is gone, or -1. 0: without
 * it the cell does not hold. */
static double yields(const brc_simulation *s, int64_t e, const double g[6], int64_t lost, const double arm[3])
{
    const brc_domain *d = s->domain;
    double p[3], own = 1, sum = 0;
    times(g, arm, p);
    if (lost >= 0) { /* (A - w R (x) R)^-1 = A^-1 + w q (x) q / (1 - w R.q), q = A^-1 R */
        double r[3], q[3];
        const double ratio = branch(d, e, lost, r);
        times(g, r, q);
        const double left = 1 - ratio * brc_dot3(r, q), more = ratio * brc_dot3(q, arm) / left;
        if (left < least_left) return 0;
        for (int c = 0; c < 3; ++c)
            p[c] += more * q[c];
    }
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        if (h == lost) continue;
        const double c = brc_dot3(p, d->area_vector + 3 * h);
        own -= c;
        sum += c * c / brc_mass_of_element(s, d->neighbour[h]);
    }
    return sum + own * own / brc_mass_of_element(s, e);
}

/* ---- springs ---- */

/* Stiffest springs of a face of cell e, along its normal and along it [N/m]. */
typedef struct {
    double normal, along;
} face_springs;
static face_springs springs_of(const brc_simulation *s, int64_t e, double area)
{
    const double h = cbrt(s->domain->volume[e]), part = area * area / (h * h * h * h);
    face_springs out = {0, 0};
    for (int32_t other = 0; other < s->scene->n_materials; ++other) {
        const double *law = brc_contact_law_of(s, s->material_of_element[e], other);
        const double k = brc_contact_stiffest_normal(s, e, other);
        out.normal = fmax(out.normal, k * part);
        out.along = fmax(out.along, law[4] > 0 ? law[3] * k : 0);
    }
    return out;
}

/* Largest safety of a time step that breccia chooses; of others 0.8. */
static double safety_of(const brc_simulation *s)
{
    double safety = 0;
    for (int32_t k = 0; k < s->scene->n_stages; ++k) {
        const brc_stage *stage = &s->scene->stages[k];
        if (stage->solver == BRC_SOLVER_DYNAMIC)
            safety = fmax(safety, stage->time_step_rule == BRC_TIME_STEP_AUTO ? stage->safety : 0.8);
    }
    return safety > 0 ? safety : 0.8;
}

/* Of omega^2 of the fastest cube, over the square of the safety, the least of all stages whose time step breccia
 * chooses or the papers' rule does; one that is given is the scene's own care [1/s^2]. */
static double per_safety(const brc_simulation *s, double cube)
{
    double least = INFINITY;
    for (int32_t k = 0; k < s->scene->n_stages; ++k) {
        const brc_stage *stage = &s->scene->stages[k];
        const double safety = stage->time_step_rule == BRC_TIME_STEP_AUTO ? stage->safety : 0.8;
        if (stage->solver == BRC_SOLVER_DYNAMIC && stage->time_step_rule != BRC_TIME_STEP_FIXED)
            least = fmin(least, cube / (safety * safety));
    }
    return least;
}

/* omega^2 of the whole face of a cube: element e, as stiff as contact or as `modulus` makes it [1/s^2]. */
static double cube_of(const brc_simulation *s, int64_t e, double modulus)
{
    double k = modulus * cbrt(s->domain->volume[e]);
    for (int32_t other = 0; other < s->scene->n_materials; ++other)
        k = fmax(k, brc_contact_stiffest_normal(s, e, other));
    return 4 * k / brc_mass_of_element(s, e);
}

/* Of the fastest cube, as stiff as contact of its stuff is by itself, over the square of the safety [1/s^2]. */
static double fastest_cube(const brc_simulation *s)
{
    double most = 0;
    for (int64_t e = 0; e < s->domain->n_elements; ++e) {
        const brc_material *own = s->scene->materials + s->material_of_element[e];
        most = fmax(most, cube_of(s, e, 0.5 * own->young / (1 - own->poisson * own->poisson)));
    }
    return per_safety(s, most);
}

/* omega^2 that no surface may have more of [1/s^2]. */
static double fastest_allowed(const brc_simulation *s)
{
    const double part = at_most[safety_of(s) > 0.8];
    double most = 0;
    for (int64_t e = 0; e < s->domain->n_elements; ++e)
        most = fmax(most, part * cube_of(s, e, s->elastic[s->material_of_element[e]].young));
    return most;
}

/* Part of a spring that its face keeps. sum: of its row [1/s^2]; two like faces meet: twice it. */
static double kept(double sum, double cube)
{
    return 2 * sum > regular * cube ? soft * cube / (2 * sum) : 1;
}
/* What a face makes of what its cell bears: of an overlap's energy over V^2 / 2 and of the tangential spring. */
static void bear(double area, face_springs springs, face_springs sums, double cube, double out[BORNE])
{
    const double normal = kept(sums.normal, cube), along = kept(sums.along, cube);
    if (normal < 1) out[0] = fmin(out[0], normal * springs.normal / (area * area));
    if (along < 1) out[1] = fmin(out[1], along * springs.along);
}

/* ---- faces that are free as built ---- */

/* Coefficients c_j of the middles of free faces: of face f entries start[f] to start[f + 1], its own cell first; the
 * entries of an element, again: at[first[e]] to at[first[e + 1]]. */
typedef struct {
    int64_t *start, *first, *at;
    int32_t *element, *face; /* [entries] */
    double *share;           /* [entries] */
    face_springs *springs;   /* [n_free_faces] */
    double *yields;          /* [n_free_faces] c_f.M^-1 c_g of one f; 0 between two [1/kg] */
    int64_t *near, *row; /* [n_free_faces] those that share elements with it; 1 + the last that a face was near to */
} free_faces;

static void free_faces_free(free_faces *f)
{
    void *const all[] = {f->start, f->first,   f->at,     f->element, f->face,
                         f->share, f->springs, f->yields, f->near,    f->row};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k)
        brc_memory_free(all[k]);
}

static brc_status allocate(const brc_simulation *s, free_faces *f)
{
    static const char what[] = "stiffness that surfaces bear";
    const brc_domain *d = s->domain;
    const int64_t n = d->n_free_faces;
    BRC_TRY(BRC_ALLOCATE(s->context, &f->start, n + 1, what));
    BRC_TRY(BRC_ALLOCATE(s->context, &f->first, d->n_elements + 2, what));
    for (int64_t e = 0; e < d->n_elements; ++e)
        for (int64_t k = d->free_start[e]; k < d->free_start[e + 1]; ++k)
            f->start[k + 1] = f->start[k] + (brc_domain_has(d, e) ? 1 + d->row_start[e + 1] - d->row_start[e] : 0);
    BRC_TRY(BRC_ALLOCATE(s->context, &f->at, f->start[n], what));
    BRC_TRY(BRC_ALLOCATE(s->context, &f->element, f->start[n], what));
    BRC_TRY(BRC_ALLOCATE(s->context, &f->face, f->start[n], what));
    BRC_TRY(BRC_ALLOCATE(s->context, &f->share, f->start[n], what));
    BRC_TRY(BRC_ALLOCATE(s->context, &f->springs, n, what));
    BRC_TRY(BRC_ALLOCATE(s->context, &f->yields, n, what));
    BRC_TRY(BRC_ALLOCATE(s->context, &f->near, n, what));
    return BRC_ALLOCATE(s->context, &f->row, n, what);
}

static void fill_cell(const brc_simulation *s, free_faces *f, int64_t e)
{
    const brc_domain *d = s->domain;
    const double *x = d->position + 3 * e;
    double g[6], p[3];
    if (d->free_start[e] == d->free_start[e + 1] || !brc_domain_has(d, e)) return;
    inverse_shape(s, e, g);
    for (int64_t k = d->free_start[e]; k < d->free_start[e + 1]; ++k) {
        const double *c = d->free_centroid + 3 * k, arm[3] = {c[0] - x[0], c[1] - x[1], c[2] - x[2]};
        int64_t to = f->start[k];
        f->springs[k] = springs_of(s, e, brc_norm3(d->free_area_vector + 3 * k));
        f->element[to] = (int32_t)e, f->share[to] = 1, f->face[to] = (int32_t)k;
        times(g, arm, p);
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
            f->share[++to] = brc_dot3(p, d->area_vector + 3 * h);
            f->element[to] = d->neighbour[h], f->face[to] = (int32_t)k;
            f->share[f->start[k]] -= f->share[to];
        }
    }
}

static void sort_by_element(const brc_domain *d, free_faces *f)
{
    const int64_t n = f->start[d->n_free_faces];
    for (int64_t k = 0; k < n; ++k)
        ++f->first[f->element[k] + 2];
    for (int64_t e = 0; e < d->n_elements; ++e)
        f->first[e + 2] += f->first[e + 1];
    for (int64_t k = 0; k < n; ++k)
        f->at[f->first[f->element[k] + 1]++] = k;
}

/* Row sums of face k over all that look the same way: those on other sides of a body seldom touch at once. Springs
 * along normals count as these stand to each other, those in planes as what two planes have in common. */
static face_springs row_of(const brc_simulation *s, free_faces *f, int64_t k)
{
    const double *area = s->domain->free_area_vector;
    face_springs sum = {0, 0};
    int64_t n_near = 0;
    for (int64_t own = f->start[k]; own < f->start[k + 1]; ++own) {
        const int32_t e = f->element[own];
        const double per_mass = f->share[own] / brc_mass_of_element(s, e);
        for (int64_t at = f->first[e]; at < f->first[e + 1]; ++at) {
            const int32_t other = f->face[f->at[at]];
            if (f->row[other] != k + 1) f->near[n_near++] = other, f->row[other] = k + 1;
            f->yields[other] += per_mass * f->share[f->at[at]];
        }
    }
    for (int64_t i = 0; i < n_near; ++i) {
        const int64_t other = f->near[i];
        const double *m = area + 3 * k, *n = area + 3 * other, c = brc_dot3(m, n) / (brc_norm3(m) * brc_norm3(n));
        const face_springs a = f->springs[k], b = f->springs[other];
        const double yields = fabs(f->yields[other]);
        f->yields[other] = 0;
        if (!(c > 1e-6)) continue;
        sum.normal += c * yields * sqrt(a.normal * b.normal);
        sum.along += 0.5 * (1 + c * c) * yields * sqrt(a.along * b.along);
    }
    return sum;
}

/* bears: as c->bears, of elements. Rigid cells have no neighbours to move them: thin ones want 2.8 times a cube's. */
static brc_status bear_free_faces(const brc_simulation *s, double cube, double *bears)
{
    const brc_domain *d = s->domain;
    free_faces f = {0};
    brc_status status = allocate(s, &f);
    for (int64_t e = 0; e < d->n_elements && status == BRC_OK; ++e)
        fill_cell(s, &f, e);
    if (status == BRC_OK) sort_by_element(d, &f);
    for (int64_t e = 0; e < d->n_elements && status == BRC_OK; ++e) {
        if (!brc_domain_mine(d, e) || d->row_start[e] == d->row_start[e + 1]) continue;
        for (int64_t k = d->free_start[e]; k < d->free_start[e + 1]; ++k)
            bear(brc_norm3(d->free_area_vector + 3 * k), f.springs[k], row_of(s, &f, k), cube, bears + BORNE * e);
    }
    free_faces_free(&f);
    return status;
}

/* ---- faces alone ---- */

/* Beside strikers, which do not give way, and faces that are free once their bond is lost: what its neighbours will
 * have lost then is not known. most: fastest_allowed. */
static void bear_face(const brc_simulation *s, int64_t e, const double g[6], int64_t lost, const double *area,
                      const double *centroid, double cube, double most, double out[BORNE])
{
    const double *x = s->domain->position + 3 * e, size = brc_norm3(area);
    const double arm[3] = {centroid[0] - x[0], centroid[1] - x[1], centroid[2] - x[2]};
    const double yielding = yields(s, e, g, lost, arm);
    if (!(yielding > 0)) return;
    const double limit = most / (2 * yielding);
    for (int k = 0; k < BORNE; k += 2) {
        out[k] = fmin(out[k], limit / (size * size));
        out[k + 1] = fmin(out[k + 1], limit);
    }
    if (lost < 0) return;
    const face_springs springs = springs_of(s, e, size);
    bear(size, springs, (face_springs){springs.normal * yielding, springs.along * yielding}, cube, out);
}

static void bear_cell(const brc_simulation *s, int64_t e, double cube, double most, double out[BORNE])
{
    const brc_domain *d = s->domain;
    double g[6];
    inverse_shape(s, e, g);
    for (int64_t f = d->free_start[e]; f < d->free_start[e + 1]; ++f)
        bear_face(s, e, g, -1, d->free_area_vector + 3 * f, d->free_centroid + 3 * f, cube, most, out);
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1] && s->scene->has_fracture; ++h)
        bear_face(s, e, g, h, d->area_vector + 3 * h, d->face_centroid + 3 * h, cube, most, out);
}

static void bear_faces_alone(const brc_simulation *s, double cube, double *bears)
{
    const brc_domain *d = s->domain;
    const double most = fastest_allowed(s);
#pragma omp parallel for schedule(static)
    for (int64_t e = 0; e < d->n_elements; ++e)
        if (brc_domain_mine(d, e) && d->row_start[e + 1] > d->row_start[e])
            bear_cell(s, e, cube, most, bears + BORNE * e);
}

/* ---- all ---- */

/* Of several ranks: cells whose faces share elements with those of this one's. */
static brc_status bring_near(const brc_simulation *s)
{
    const brc_domain *d = s->domain;
    if (!d->here) return BRC_OK;
    BRC_LOCAL(s->context, d->n_elements, uint8_t, wanted, "stiffness that surfaces bear");
    for (int64_t e = 0; e < d->n_elements; ++e)
        wanted[e] = brc_domain_mine(d, e) && d->free_start[e] < d->free_start[e + 1];
    for (uint8_t ring = 1; ring <= 2; ++ring)
        for (int64_t e = 0; e < d->n_elements; ++e)
            for (int64_t h = d->row_start[e]; h < d->row_start[e + 1] && wanted[e] == ring; ++h)
                if (!wanted[d->neighbour[h]]) wanted[d->neighbour[h]] = ring + 1;
    return brc_domain_bring(s->context, d, wanted);
}

static brc_status find_bearing(const brc_simulation *s, double *bears)
{
    const double cube = fastest_cube(s);
    BRC_TRY(bring_near(s));
    BRC_TRY(bear_free_faces(s, cube, bears));
    bear_faces_alone(s, cube, bears);
    return s->domain->here ? brc_domain_elements(s->context, s->domain, BORNE, bears) : BRC_OK;
}

brc_status brc_contact_set_bearing(brc_simulation *s)
{
    const brc_contact_state *c = s->contact;
    const int64_t n = s->layout->n_rows, solids = n + c->n_pieces;
    if (!c->bears) return BRC_OK;
    BRC_LOCAL(s->context, BORNE * s->domain->n_elements, double, bears, "stiffness that surfaces bear");
    BRC_LOCAL(s->context, BORNE * solids, double, value, "stiffness that surfaces bear");
    for (int64_t k = 0; k < BORNE * s->domain->n_elements; ++k)
        bears[k] = endless;
    if (c->affine) BRC_TRY(find_bearing(s, bears));
    for (int64_t r = 0; r < solids; ++r) {
        const int32_t e = r < n ? s->layout->element_of_row[r] : -1;
        for (int k = 0; k < BORNE; ++k)
            value[BORNE * r + k] = e >= 0 && c->affine ? bears[BORNE * (int64_t)e + k] : endless;
    }
    return brc_upload_state(s, c->bears, value, BORNE * solids);
}
