/* Bonds of dlsm-published that break by their normal stress (AGH19 section 5.3, eq. 35-36): passes of
 * published_breaks.cl. */
#include "../../core/awake.h"
#include "../../core/sym3.h"
#include "published_internal.h"
#include <math.h>

/* An element whose bonds span less than this share of what they spanned in its weakest direction in the whole body has
 * no strain any more, as one of fewer than three contacts (AGH19 section 2.2): its strain would answer its neighbours
 * more stiffly than the time step bears. */
static const double support_share = 0.2, span_least = 1e-6;

/* Of the whole body: the least eigenvalue that A = sum w R (x) R must keep, and the projector on the directions spanned
 * (geometry.c). */
static double support_of(const brc_simulation *s, int64_t e, double projector[6])
{
    static const int of_component[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    const brc_domain *d = s->domain;
    double a[6] = {0}, value[3], axis[3][3];
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        const int64_t j = d->neighbour[h];
        double r[3], length = 0, surface = 0;
        for (int c = 0; c < 3; ++c) {
            r[c] = d->position[3 * j + c] - d->position[3 * e + c];
            length += r[c] * r[c];
            surface += d->area_vector[3 * h + c] * d->area_vector[3 * h + c];
        }
        const double w = s->scene->model.area_weights ? sqrt(surface / length) : 1;
        const double six[6] = {r[0] * r[0], r[1] * r[1], r[2] * r[2], r[1] * r[2], r[0] * r[2], r[0] * r[1]};
        for (int c = 0; c < 6; ++c)
            a[c] += w * six[c];
    }
    brc_sym3_eigen(a, value, axis);
    for (int k = 0; k < 3; ++k)
        for (int c = 0; value[k] > span_least * value[2] && c < 6; ++c)
            projector[c] += axis[k][of_component[c][0]] * axis[k][of_component[c][1]];
    return fmax(support_share * value[0], span_least * value[2]);
}

static brc_status make_passes(brc_simulation *s)
{
    brc_published_own *c = brc_published_own_of(s);
    const brc_scope run = brc_scope_of_run(s);
    brc_cell_scopes scopes;
    const brc_scope *cells = brc_cell_scopes_make(s, &run, &scopes), request = brc_scope_of_request(cells);
    const bool by_element = !brc_cell_breaks_by_bond(s);
    const brc_pass_wanted of_request[] = {
        BRC_PASS(&c->breaking_strain, "published_breaking_strain", NULL),
        BRC_PASS(&c->breaking_strain_listed, "published_breaking_strain_listed", BRC_LISTED),
        {&c->breaking_force, "published_breaking_force", NULL, by_element},
        {&c->breaking_force_listed, "published_breaking_force_listed", BRC_LISTED, by_element}};
    BRC_TRY(BRC_PASSES_MAKE(s, &request, of_request));
    return BRC_PASSES(s, cells, BRC_PASS(&c->rebuild, "published_rebuild", NULL),
                      {&c->check, "published_check", "share", by_element});
}

brc_status brc_published_breaks_create(brc_simulation *s)
{
    const brc_layout *layout = s->layout;
    BRC_TRY(make_passes(s));
    BRC_LOCAL(s->context, layout->n_rows, double, support, "supports");
    BRC_LOCAL(s->context, 6 * (int64_t)layout->n_rows, double, spanned, "supports");
#pragma omp parallel for schedule(static)
    for (int32_t r = 0; r < layout->n_rows; ++r) {
        double projector[6] = {0};
        const int32_t e = layout->element_of_row[r];
        if (e >= 0 && brc_domain_has(s->domain, e)) support[r] = support_of(s, e, projector);
        for (int k = 0; k < 6; ++k)
            spanned[(int64_t)(r / layout->slice * 6 + k) * layout->slice + r % layout->slice] = projector[k];
    }
    BRC_TRY(brc_upload_coeff(s, brc_cell_breaks_array(s, "spanned"), spanned, 6 * (int64_t)layout->n_rows));
    return brc_upload_coeff(s, brc_cell_breaks_array(s, "support"), support, layout->n_rows);
}

brc_status brc_published_breaks_strains(brc_simulation *s, const brc_force_request *r)
{
    const brc_published_own *c = brc_published_own_of(s);
    return brc_pass_over(s, c->breaking_strain, c->breaking_strain_listed, r->rings ? brc_rings_around(r->rings) : NULL,
                         0, r, NULL);
}

brc_status brc_published_breaks_force(brc_simulation *s, const brc_force_request *r)
{
    const brc_published_own *c = brc_published_own_of(s);
    const brc_ring_list *list = brc_request_list(r);
    return brc_pass_over(s, c->breaking_force, c->breaking_force_listed, list, 2, r, NULL);
}

brc_status brc_published_mark(brc_simulation *s, double share)
{
    return brc_pass_look_awake(s, brc_published_own_of(s)->check, BRC_GIVEN({"share", BRC_COEFF(share)}));
}

brc_status brc_published_rebuild(brc_simulation *s)
{
    return brc_pass_run(brc_published_own_of(s)->rebuild, s->layout->n_rows);
}

brc_status brc_published_ratio(brc_simulation *s, double *out)
{
    return brc_largest_coeff(s, brc_cell_breaks_array(s, "bond_ratio"), out);
}

brc_status brc_published_branches(brc_simulation *s, brc_buffer **out)
{
    *out = brc_offset_of(s);
    return BRC_OK;
}
