#include "crack_range.h"
#include "../../../../preprocess/domain/domain_rows.h"
#include "../../../base/ranks.h"
#include <math.h>
#include <stdlib.h>

/* Elements through a thickness or a ligament, as a crack's zone takes; along a notch, where peak loads of uneven cells
 * were +11 to +13 % off, and where +4 % (docs/notebook/fracture.md, "Notched specimens"). */
static const double least_through = 4, least_notch = 15, good_notch = 30;
static const double slack = 0.03; /* of these: the mean size is not quite that of a row */

static int ascending(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

static double size_of(const brc_domain *d, int64_t e)
{
    return d->element_kind == BRC_ELEMENT_SPHERE ? 2 * d->radius[e] : cbrt(d->volume[e]);
}

brc_status brc_crack_lengths_find(brc_simulation *s, const brc_strengths *strengths, double asked,
                                  brc_crack_lengths *out)
{
    const brc_domain *d = s->domain;
    const double bound[3] = {asked, 2 * asked, 1};
    *out = (brc_crack_lengths){0};
    BRC_TRY(BRC_ALLOCATE(s->context, &out->ratio, d->n_bonds, "lengths of cracks"));
    for (int64_t e = 0; e < d->n_elements; ++e)
        out->size += size_of(d, e) / (double)d->n_elements;
    for (int64_t b = 0; b < d->n_bonds; ++b) {
        if (!(strengths->energy[b] > 0) || !(strengths->tension[b] > 0)) continue;
        const int64_t h = d->bond_half_edge[b], i = d->neighbour[d->twin[h]], j = d->neighbour[h];
        const int32_t one = s->material_of_element[i], other = s->material_of_element[j],
                      softer = s->elastic[one].young < s->elastic[other].young ? one : other;
        const double length = s->elastic[softer].young * strengths->energy[b] /
                              (strengths->tension[b] * strengths->tension[b]),
                     ratio = length / (0.5 * (size_of(d, i) + size_of(d, j)));
        if (one != other && ratio < 1 && !strengths->joint[b] &&
            !brc_material_breaks(s->scene, s->scene->model.kind, &s->scene->materials[softer])) {
            if (out->n_lent++ == 0 || length < out->lent)
                out->lent = length, out->softer = softer, out->lender = softer == one ? other : one;
            continue;
        }
        for (int k = 0; k < 3; ++k)
            out->n_below[k] += ratio < bound[k];
        out->ratio[out->n++] = ratio;
    }
    if (out->n > 0) qsort(out->ratio, (size_t)out->n, sizeof *out->ratio, ascending);
    return BRC_OK;
}

void brc_crack_lengths_tell(brc_simulation *s, const brc_crack_lengths *l)
{
    if (l->n_lent == 0) return;
    const char *lender = s->scene->materials[l->lender].name, *softer = s->scene->materials[l->softer].name;
    brc_log(
        s->context, BRC_LOG_WARNING,
        "fracture_energy: %lld bonds between '%s' and the softer '%s', which has no strength, bear as much as '%s' and "
        "open at once: E G_c / sigma_f^2 is %.2g mm there; give the joint a tension and a fracture energy of its own, "
        "as in `interactions: {interfaces: [{materials: {first: %s, second: %s, tension: ..., fracture_energy: "
        "...}}]}`",
        (long long)l->n_lent, lender, softer, lender, 1e3 * l->lent, lender, softer);
}

void brc_crack_lengths_free(brc_crack_lengths *lengths)
{
    brc_memory_free(lengths->ratio);
    *lengths = (brc_crack_lengths){0};
}

double brc_crack_lengths_size(const brc_crack_lengths *l, double ratio)
{
    return l->size * fmin(l->ratio[l->n / 2] / ratio, l->ratio[l->n / 100]);
}

/* ---- bodies and their cracks ---- */

typedef struct extent {
    double low[3], high[3], size; /* box of the body, mean size of its elements [m] */
    int64_t n;
} extent;

static void stretch(extent *x, const double *point, double reach)
{
    for (int c = 0; c < 3; ++c) {
        x->low[c] = fmin(x->low[c], point[c] - reach);
        x->high[c] = fmax(x->high[c], point[c] + reach);
    }
}

/* All ranks. */
static brc_status extent_of(brc_context *context, const brc_domain *d, int32_t body, extent *x)
{
    *x = (extent){.low = {INFINITY, INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY, -INFINITY}};
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const bool corners = d->vertex && brc_domain_mine(d, e);
        if (d->body[e] != body) continue;
        x->size += size_of(d, e);
        ++x->n;
        if (d->element_kind == BRC_ELEMENT_SPHERE) stretch(x, d->position + 3 * e, d->radius[e]);
        for (int64_t v = corners ? d->vertex_start[e] : 0; corners && v < d->vertex_start[e + 1]; ++v)
            stretch(x, d->vertex + 3 * v, 0);
    }
    x->size /= (double)(x->n > 0 ? x->n : 1);
    if (!d->here) return BRC_OK;
    BRC_TRY(brc_ranks_least(context, 3, x->low));
    return brc_ranks_most(context, 3, x->high);
}

/* Box of a crack inside that of its body; false where it lies aslant the axes. */
static bool crack_box(const brc_crack *crack, const extent *x, double low[3], double high[3])
{
    int n_thin = 0;
    for (int c = 0; c < 3; ++c) {
        const double *a = crack->edge[0], *b = crack->edge[1],
                     square = crack->normal[0] * crack->normal[0] + crack->normal[1] * crack->normal[1] +
                              crack->normal[2] * crack->normal[2];
        const double reach = crack->kind == BRC_CRACK_DISC
                                 ? crack->radius * sqrt(fmax(0, 1 - crack->normal[c] * crack->normal[c] / square))
                                 : 0;
        low[c] = crack->point[c] + (crack->kind == BRC_CRACK_DISC ? -reach : fmin(0, a[c]) + fmin(0, b[c]));
        high[c] = crack->point[c] + (crack->kind == BRC_CRACK_DISC ? reach : fmax(0, a[c]) + fmax(0, b[c]));
        n_thin += high[c] - low[c] < 1e-6 * x->size;
        low[c] = fmax(low[c], x->low[c]);
        high[c] = fmin(high[c], x->high[c]);
    }
    return n_thin == 1;
}

/* Along the axis in which it leaves most of the body whole: its length, and what is left on the side where less is but
 * for none. */
static bool crack_lengths(const brc_crack *crack, const extent *x, double *length, double *left)
{
    double low[3], high[3];
    int axis = -1;
    if (!crack_box(crack, x, low, high)) return false;
    *left = 0;
    for (int c = 0; c < 3; ++c) {
        const double whole = x->high[c] - x->low[c] - (high[c] - low[c]);
        if (high[c] - low[c] < 1e-6 * x->size || whole < 0.5 * x->size || (axis >= 0 && high[c] - low[c] > *length))
            continue;
        const double below = low[c] - x->low[c], above = x->high[c] - high[c];
        axis = c;
        *length = high[c] - low[c];
        *left = below < 0.5 * x->size ? above : above < 0.5 * x->size ? below : fmin(below, above);
    }
    return axis >= 0;
}

static void tell_crack(brc_simulation *s, const brc_body *body, const brc_crack *crack, const extent *x,
                       const char *elements)
{
    double length, left;
    if (!crack_lengths(crack, x, &length, &left)) return;
    if (length < (1 - slack) * least_notch * x->size)
        brc_log(s->context, BRC_LOG_WARNING,
                "fracture_energy: crack '%s' of body '%s' is about %.1f %s long and leaves %.1f: notched parts of "
                "uneven cells bear some 5 to 11 %% too much with %g along it, 4 %% with %g; use %s of "
                "%.3g mm for %g, %.3g mm for %g",
                crack->name, body->name, length / x->size, elements, left / x->size, least_notch, good_notch, elements,
                1e3 * length / least_notch, least_notch, 1e3 * length / good_notch, good_notch);
    if (left < (1 - slack) * least_through * x->size)
        brc_log(s->context, BRC_LOG_WARNING,
                "fracture_energy: crack '%s' of body '%s' leaves about %.1f %s whole, expected %g or more; use %s of "
                "%.3g mm",
                crack->name, body->name, left / x->size, elements, least_through, elements, 1e3 * left / least_through);
}

/* Is there a fracture energy in the body? */
static bool softens(const brc_scene *scene, const brc_body *body)
{
    for (int32_t m = 0; m < scene->n_materials; ++m)
        if (scene->materials[m].fracture_energy > 0 && brc_body_uses(body, m)) return true;
    for (int32_t k = 0; k < scene->n_interfaces; ++k)
        if (scene->interfaces[k].fracture_energy > 0) return true;
    return false;
}

brc_status brc_crack_range_tell(brc_simulation *s, const char *elements)
{
    for (int32_t b = 0; b < s->scene->n_bodies; ++b) {
        const brc_body *body = &s->scene->bodies[b];
        if (!softens(s->scene, body)) continue;
        extent x;
        BRC_TRY(extent_of(s->context, s->domain, b, &x));
        double thinnest = INFINITY;
        int axis = 0;
        for (int c = 0; c < 3 && x.n > 0; ++c)
            if (x.high[c] - x.low[c] < thinnest) thinnest = x.high[c] - x.low[c], axis = c;
        if (x.n > 0 && thinnest < (1 - slack) * least_through * x.size)
            brc_log(s->context, BRC_LOG_WARNING,
                    "fracture_energy: body '%s' is about %.1f %s thick along %c, expected %g or more where a crack "
                    "runs through it (a plane of symmetry doubles them); use %s of %.3g mm",
                    body->name, thinnest / x.size, elements, "xyz"[axis], least_through, elements,
                    1e3 * thinnest / least_through);
        for (int c = 0; c < body->n_cracks; ++c)
            tell_crack(s, body, &body->cracks[c], &x, elements);
    }
    return BRC_OK;
}
