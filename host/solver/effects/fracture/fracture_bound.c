/* What lets fracture_check pass by elements far from failure (fracture.cl): limits in common, volumes and
 * marks; and the factors of bonds that scatter or lie in an interface. */
#include "fracture_internal.h"
#include "interfaces.h"
#include "strengths.h"
#include "../../../device/shares.h"
#include <math.h>

/* Room for the rounding of the bound and of what it bounds, as in failure_possible (failure.h). */
static const double MARGIN = 0.999;
/* Share of an element's own margin which the smallest of its neighbours' must keep where elements are screened: bonds
 * of very different strength would have nearly all of them looked at. */
static const double ALIKE = 0.5;

/* Smallest limit of every kind over all elements; 0: none has one. */
static void smallest_limits(const brc_simulation *s, double smallest[3])
{
    smallest[0] = smallest[1] = smallest[2] = 0;
    for (int64_t k = 0; k < 3 * s->domain->n_elements; ++k) {
        const double limit = s->fracture->limit[k];
        if (limit > 0 && (!(smallest[k % 3] > 0) || limit < smallest[k % 3])) smallest[k % 3] = limit;
    }
}

/* How many times as far as the smallest an element's own limits are; an element without limits is never near. */
static double margin_of(const double *limit, const double smallest[3])
{
    double margin_of_limit = 1e30;
    for (int c = 0; c < 3; ++c)
        if (limit[c] > 0) margin_of_limit = fmin(margin_of_limit, limit[c] / smallest[c]);
    return margin_of_limit;
}

/* The smallest limit_margin of each row and its neighbours, and whether to screen by it. */
static brc_status upload_near(brc_simulation *s, const double *margin, const double *weakest)
{
    brc_breaking *f = s->fracture;
    const brc_domain *d = s->domain;
    int64_t alike = 0;
    BRC_LOCAL(s->context, s->layout->n_rows, double, near_margin, "bounds of stress");
    for (int64_t r = 0; r < s->layout->n_rows; ++r) {
        const int64_t e = s->layout->element_of_row[r];
        near_margin[r] = margin[r];
        for (int64_t h = e < 0 ? 0 : d->row_start[e]; e >= 0 && h < d->row_start[e + 1]; ++h)
            near_margin[r] = fmin(near_margin[r], margin[s->layout->row_of_element[d->neighbour[h]]]);
        alike += e >= 0 && near_margin[r] >= ALIKE * margin[r] / (weakest ? weakest[r] : 1);
    }
    f->screened = brc_device_get_info(s->device)->kind == BRC_DEVICE_CPU && !brc_device_is_shared(s->device) &&
                  s->scene->fracture.level == 1 && 2 * alike > d->n_elements;
    return brc_upload_coeff(s, f->near_margin, near_margin, s->layout->n_rows);
}

/* limit_margin of every row. */
static void find_margins(const brc_simulation *s, const double *weakest, double *out)
{
    double smallest[3];
    smallest_limits(s, smallest);
    for (int64_t r = 0; r < s->layout->n_rows; ++r) {
        const int64_t e = s->layout->element_of_row[r];
        out[r] = e < 0 ? 1e30 /* rows of no element never fail */
                       : MARGIN * (weakest ? weakest[r] : 1) * margin_of(s->fracture->limit + 3 * e, smallest);
    }
}

static brc_status upload_bounds(brc_simulation *s, const double *weakest)
{
    brc_breaking *f = s->fracture;
    const brc_domain *d = s->domain;
    const int64_t n = s->layout->n_rows;
    double smallest[3];
    smallest_limits(s, smallest);
    for (int c = 0; c < 3; ++c)
        f->scale[c] = smallest[c] > 0 ? 1 / smallest[c] : 0;
    BRC_LOCAL(s->context, n, double, margin_of_limit, "bounds of stress");
    BRC_LOCAL(s->context, n, double, weight, "bounds of stress");
    find_margins(s, weakest, margin_of_limit);
    for (int64_t r = 0; r < n; ++r) {
        const int64_t e = s->layout->element_of_row[r];
        weight[r] = 1;
        if (e < 0) continue;
        weight[r] = brc_fracture_volume(d, e);
        for (int64_t h = d->row_start[e]; s->scene->fracture.level > 0 && h < d->row_start[e + 1]; ++h)
            weight[r] += brc_fracture_volume(d, d->neighbour[h]);
    }
    BRC_TRY(upload_near(s, margin_of_limit, weakest));
    BRC_TRY(brc_upload_coeff(s, f->limit_margin, margin_of_limit, n));
    return brc_upload_coeff(s, f->weight, weight, n);
}

/* Beams of an interface that open one by one (models/cbm/beam_softening.c). */
static bool opens_alone(const brc_strengths *strengths, int64_t bond)
{
    return strengths->joint[bond] && strengths->energy[bond] > 0;
}

/* Factors by entries, and the smallest of every row in *weakest [n_rows], the caller's. opens: beams of an interface
 * with a fracture energy open one by one, so that their element's limit is the interface's strength itself, where that
 * of solids, which their weakest place decides, is above it (models/cbm/breaks.c). */
static brc_status upload_factors(brc_simulation *s, const brc_strengths *strengths, bool opens, double **weakest)
{
    brc_breaking *f = s->fracture;
    const int64_t n = s->layout->n_rows, entries = s->layout->n_slots * s->layout->slice;
    BRC_LOCAL(s->context, entries, double, factor, "factors of bonds");
    BRC_TRY(BRC_ALLOCATE(s->context, weakest, n, "factors of bonds"));
    for (int64_t r = 0; r < n; ++r)
        (*weakest)[r] = INFINITY;
    for (int64_t slice = 0; slice < n / s->layout->slice; ++slice)
        for (int64_t k = (int64_t)s->layout->slot_start[slice] * s->layout->slice;
             k < (int64_t)s->layout->slot_start[slice + 1] * s->layout->slice; ++k) {
            const int64_t h = s->layout->half_edge[k], r = slice * s->layout->slice + k % s->layout->slice;
            const int32_t bond = h < 0 ? -1 : s->domain->bond[h];
            const double limit = bond < 0 ? 0 : f->limit[3 * s->layout->element_of_row[r]];
            factor[k] = bond < 0 ? 1 : strengths->factor[bond];
            if (limit > 0 && opens && opens_alone(strengths, bond) && strengths->tension[bond] > 0)
                factor[k] = strengths->tension[bond] / limit;
            if (h >= 0 && factor[k] < (*weakest)[r]) (*weakest)[r] = factor[k];
        }
    for (int64_t r = 0; r < n; ++r)
        if (!isfinite((*weakest)[r])) (*weakest)[r] = 1; /* no bonds */
    BRC_TRY(brc_upload_coeff(s, f->factor, factor, entries));
    return brc_upload_coeff(s, f->weakest, *weakest, n);
}

brc_status brc_fracture_raise_bounds(brc_simulation *s)
{
    const brc_breaking *f = s->fracture;
    const int64_t n = s->layout->n_rows, slice = s->layout->slice, entries = s->layout->n_slots * slice;
    if (!f->record || !f->weighted) return BRC_OK;
    BRC_LOCAL(s->context, entries, int32_t, neighbour, "bounds of stress");
    BRC_LOCAL(s->context, entries, double, factor, "bounds of stress");
    BRC_LOCAL(s->context, n, double, weakest, "bounds of stress");
    BRC_LOCAL(s->context, n, double, margin, "bounds of stress");
    BRC_TRY(brc_buffer_read(brc_neighbour_of(s), 0, neighbour, 4 * entries));
    BRC_TRY(brc_download(s, f->factor, brc_coeff_bytes(s), factor, entries));
    BRC_TRY(brc_download(s, f->weakest, brc_coeff_bytes(s), weakest, n)); /* stays where no bond is left */
    for (int64_t r = 0; r < n; ++r) {
        double least = INFINITY;
        for (int64_t slot = s->layout->slot_start[r / slice]; slot < s->layout->slot_start[r / slice + 1]; ++slot)
            if (neighbour[slot * slice + r % slice] != r) least = fmin(least, factor[slot * slice + r % slice]);
        if (isfinite(least)) weakest[r] = least;
    }
    find_margins(s, weakest, margin);
    BRC_TRY(brc_upload_coeff(s, f->weakest, weakest, n));
    return brc_upload_coeff(s, f->limit_margin, margin, n);
}

brc_status brc_fracture_planes(brc_simulation *s, const uint8_t *lies, double *plane)
{
    const brc_layout *layout = s->layout;
    const brc_domain *d = s->domain;
    BRC_FREED double *normal = NULL;
    BRC_TRY(brc_interface_normals(s->context, s->scene, d, s->material_of_element, 1, &normal));
    for (int64_t k = 0; normal && k < layout->n_slots * layout->slice; ++k) {
        const int32_t h = layout->half_edge[k];
        if (h < 0 || !lies[d->bond[h]]) continue;
        const double out = d->neighbour[d->twin[h]] < d->neighbour[h] ? 1 : -1; /* normal: of the smaller element */
        double *own = plane + (k / layout->slice) * 3 * layout->slice + k % layout->slice;
        for (int c = 0; c < 3; ++c)
            own[c * layout->slice] = out * normal[3 * (int64_t)d->bond[h] + c];
    }
    return BRC_OK;
}

/* Of brittle bonds weaker than their solids, and of beams that open one by one. */
static brc_status upload_planes(brc_simulation *s, const brc_strengths *strengths, bool opens)
{
    const int64_t n_entries = s->layout->n_slots * s->layout->slice, n_bonds = s->domain->n_bonds;
    BRC_LOCAL(s->context, n_bonds, uint8_t, lies, "normals of interfaces");
    BRC_LOCAL(s->context, 3 * n_entries, double, plane, "normals of interfaces");
    for (int64_t b = 0; b < n_bonds; ++b)
        lies[b] = strengths->factor[b] < 1 || (opens && opens_alone(strengths, b));
    BRC_TRY(brc_fracture_planes(s, lies, plane));
    s->fracture->turned = brc_orientation_of(s);
    return brc_upload_coeff(s, s->fracture->plane, plane, 3 * n_entries);
}

brc_status brc_fracture_bound(brc_simulation *s)
{
    brc_breaking *f = s->fracture;
    BRC_ENDS_WITH(brc_strengths_free) brc_strengths strengths = {0};
    BRC_FREED double *weakest = NULL;
    BRC_TRY(brc_strengths_create(s->context, s->scene, s->domain, s->material_of_element, &strengths));
    const bool softens = s->wants.softens && brc_has_spheres(s); /* cells: cell_breaks.c */
    f->weighted = f->factor != NULL; /* beams that opened are not chosen again, by their factors */
    f->joined = !f->plane ? 0 : s->model->turns ? 3 : 1;
    if (f->joined) BRC_TRY(upload_planes(s, &strengths, softens));
    if (f->weighted) BRC_TRY(upload_factors(s, &strengths, softens, &weakest));
    if (softens) BRC_TRY(s->model->cohesion->create(s, &strengths));
    return upload_bounds(s, weakest);
}

bool brc_wants_lost_beams(const brc_wants *w)
{
    return w->scene->has_fracture && brc_wants_spheres(w) && (brc_scene_shuts(w->scene) || w->softens);
}

double brc_fracture_volume(const brc_domain *d, int64_t e)
{
    return 2 * d->volume[e];
}
